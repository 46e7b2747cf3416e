"""The 1981 paper computed again: its box, its conclusions, its report."""

import bikestab.plot  # noqa: F401  # imported first, it sees to matplotlib's settings
