"""The 1981 paper computed again: its box, its conclusions, its report."""
