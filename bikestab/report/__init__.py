"""One interactive page of volumes, for a browser without any network."""

import bikestab.plot  # noqa: F401  # imported first, it sees to matplotlib's settings
