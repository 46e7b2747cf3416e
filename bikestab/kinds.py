"""What an interval of stable speeds ends with, and why an answer may be uncertain: by number and in words."""

KINDS = ("none", "weave", "capsize", "rest", "unbounded")  # value k of ``lower`` and ``upper``
NONE, WEAVE, CAPSIZE, REST, UNBOUNDED = range(5)
# Why it may be otherwise: what is within rounding of the inputs' products in twice double precision.
REASONS = (
    "",
    "whether there is a capsize speed is within rounding",
    "how many weave speeds there are is within rounding",
    "the order of two critical speeds is within rounding",
    "whether p1 … p4 are positive is within rounding",
    "the interval is narrower than two neighbouring doubles",
)
