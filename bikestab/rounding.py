"""How far rounding reaches: every limit that decides whether a computed number is certain.

Each is a share of the summed sizes of the terms that formed the number; u = 2^−53.
"""

EPS = 2.0**-52

# Twice double precision. An entry of the table: up to 40 operations of 8 u² each lie between the parameters
# and the entry, four times as many where 25 parameters are reduced first.
ENTRY = 2.0**-95
# A coefficient of a condition as a polynomial in V: a product of three entries, and some operations.
COEFFICIENT = 2.0**-92
# Where entries cancel, a product of three is known better than by the sizes of all terms. With LEFT of an
# entry's size, which is 2^71 of its error, and its value as its size: to three times 2^−71 of these sizes'
# product, and what operations do, which does not count beside it.
LEFT = 2.0**-24
CANCELLED = 2.0**-68

# A value of a condition in numbers of 79 bits: 76 · 2^−79 from operations, and three times CLOSE from
# entries, whose sizes are then themselves and 2^76 of their errors.
CLOSE = 2.0**-76
CONDITION_AT = 2.0**-72

# Double precision. A coefficient of a condition as a polynomial in V: a product of three entries, which are
# rounded themselves, and up to ten more roundings.
POLYNOMIAL = 2.0**-49
# A value of p0 … p4 at a speed, and a slope of a condition.
VALUE = 2.0**-50
SLOPE = 2.0**-48
# A Bernstein coefficient after all cuts, relative to the mean sizes of the terms.
CUT = 2.0**-39
# A sum of products of entries in a function whose zeros are the skeleton's curves, where what cancels
# identically leaves this much.
PRODUCTS = 64 * EPS
# A condition as it stands at a point of the grid, as the scan's checks evaluate it; below the second one its
# sign says nothing.
CONDITION = 16 * EPS
NO_SIGN = 128 * EPS
