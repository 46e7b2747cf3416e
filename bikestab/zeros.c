/* Polynomials with damping -> doubles near their positive zeros, where a certain number of these is known.

   The same operations in the same order as bikestab/isolation.py and roots.py, a cell at a time: the same bits. The
   means of coefficients and of their sizes go side by side. Nothing here may be contracted to fused multiply-adds. */

#include <math.h>

#define INLINE inline __attribute__((always_inline)) /* so that loops over a number of powers are unrolled */
#define POWERS 7 /* at most, of hurwitz3 */
#define TOGETHER 8 /* cells */
#define WORK 64  /* intervals of a cell at a time: twice as many as are left open */

typedef double Both __attribute__((vector_size(16))); /* a number and its size */

typedef struct {
    double low, high;
    int inverse;
    Both b[POWERS]; /* Bernstein coefficients */
} Interval;

typedef struct {
    double middle, share, narrow, close, many, depth; /* as there */
} Limits;

typedef struct {
    int number;
    double low[POWERS], high[POWERS], sign[POWERS]; /* at the upper end */
} Brackets;

/* How often the signs of coefficients change, -1 where that is not clear, and the signs of the outer ones. */
static INLINE int sign_changes(const Both *b, int n, double share, int *first, int *last)
{
    int sign[POWERS], uncertain[POWERS], before[POWERS], after[POWERS], changes = 0, clear = 1;
    for (int i = 0; i < n; i++) {
        double bound = share * b[i][1];
        int positive = b[i][0] > -bound, negative = b[i][0] < bound;
        uncertain[i] = positive & negative;
        sign[i] = positive - negative;
    }
    before[0] = after[n - 1] = 0;
    for (int i = 1; i < n; i++) {
        before[i] = sign[i - 1] ? sign[i - 1] : before[i - 1];
        changes += before[i] * sign[i] < 0;
        after[n - 1 - i] = sign[n - i] ? sign[n - i] : after[n - i];
    }
    for (int i = 0; i < n; i++) {
        int alone = before[i] * after[i] < 0 && !(i && uncertain[i - 1]);
        clear &= !uncertain[i] || alone;
    }
    *first = sign[0] ? sign[0] : after[0];
    *last = sign[n - 1] ? sign[n - 1] : before[n - 1];
    return clear ? changes : -1;
}

/* The coefficients left and right of a place by de Casteljau's means. */
static INLINE void cut(const Both *b, int n, double at, Both *left, Both *right)
{
    Both means[POWERS], place = {at, at};
    for (int i = 0; i < n; i++)
        means[i] = b[i];
    for (int k = 0; k < n; k++) {
        left[k] = means[0];
        right[n - 1 - k] = means[n - 1 - k];
        for (int i = 0; i < n - 1 - k; i++)
            means[i] = means[i] + place * (means[i + 1] - means[i]);
    }
}

/* Both parts of an interval; the cut is moved where a zero may lie on it. */
static INLINE void halve(const Interval *whole, int n, double share, Interval *left, Interval *right)
{
    double at = whole->low == 0 ? 0.125 : 0.5;
    cut(whole->b, n, at, left->b, right->b);
    if (fabs(left->b[n - 1][0]) <= share * left->b[n - 1][1])
        cut(whole->b, n, at *= 0.75, left->b, right->b);
    left->low = whole->low;
    left->high = right->low = whole->low + at * (whole->high - whole->low);
    right->high = whole->high;
    left->inverse = right->inverse = whole->inverse;
}

/* 0 < x <= 1 of V = M x and of V = M/x, from powers over binomials. */
static INLINE void begin(const Both *powers, int n, Interval *work)
{
    for (int inverse = 0; inverse < 2; inverse++) {
        Both sums[POWERS];
        for (int i = 0; i < n; i++)
            sums[i] = powers[inverse ? n - 1 - i : i];
        for (int i = 0; i < n; i++) {
            work[inverse].b[i] = sums[0];
            for (int j = 0; j < n - 1 - i; j++)
                sums[j] = sums[j] + sums[j + 1];
        }
        work[inverse].low = 0;
        work[inverse].high = 1;
        work[inverse].inverse = inverse;
    }
}

/* Intervals with one zero each; whether that leaves any undecided. */
static INLINE int isolate(const Both *powers, int n, const Limits *is, Brackets *found)
{
    Interval one[WORK], other[WORK], *work = one, *next = other;
    int number = 2, open[WORK];
    begin(powers, n, work);
    found->number = 0;
    for (int pass = 0; pass < is->depth; pass++) {
        int left = 0, undecided = 0, first, last;
        for (int i = 0; i < number; i++) {
            const Interval *w = work + i;
            int changes = sign_changes(w->b, n, is->share, &first, &last), k = found->number;
            if (changes == 1 && k < POWERS) {
                found->low[k] = w->inverse ? is->middle / w->high : is->middle * w->low;
                found->high[k] = w->inverse ? is->middle / w->low : is->middle * w->high;
                found->sign[k] = w->inverse ? first : last;
                found->number++;
            }
            if (changes < 0 || changes > 1) {
                open[left++] = i;
                undecided |= w->high - w->low <= is->narrow * w->high;
            }
        }
        if (undecided || left > is->many || 2 * left > WORK)
            return 1;
        if (!left)
            return 0;
        for (int i = 0; i < left; i++)
            halve(work + open[i], n, is->share, next + i, next + left + i);
        number = 2 * left;
        Interval *done = work;
        work = next;
        next = done;
    }
    return 1;
}

static int floor_of(int a, int b)
{
    return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

/* k with all zeros below 2^k in size (Fujiwara 1916), of coefficients one stride after the other. */
static int exponent_above(const double *c, int n, int stride)
{
    int degree = n - 1, lead = -(1 << 20), exponent, most = -1000;
    for (int j = n - 1; j >= 0; j--)
        if (c[j * stride] != 0) {
            degree = j;
            frexp(c[j * stride], &lead);
            break;
        }
    for (int j = 0; j < degree; j++)
        if (c[j * stride] != 0) {
            frexp(c[j * stride], &exponent);
            int below = -floor_of(lead - 1 - exponent, degree - j);
            most = below > most ? below : most;
        }
    most += 2;
    return most < -1000 ? -1000 : most > 1000 ? 1000 : most;
}

/* The search for the one zero of a polynomial between two ends. */
typedef struct {
    const double *c;
    double a, b, x, sign; /* at b */
} Search;

static Search begun(const double *c, int n, double low, double high, double sign)
{
    double a = low == 0 ? ldexp(1.0, -exponent_above(c + n - 1, n, -1)) : low;
    double b = high == INFINITY ? ldexp(1.0, exponent_above(c, n, 1)) : high;
    return (Search){c, fmin(a, b), fmax(a, b), sqrt(a * b), sign};
}

/* One of Halley's steps, halving in the logarithm where it fails; whether others are needed. */
static INLINE int stepped(Search *s, int n, double close)
{
    const double *c = s->c;
    double x = s->x, f = c[n - 1] * x + c[n - 2], slope = c[n - 1], bend = 0;
    for (int j = n - 3; j >= 0; j--) {
        bend = bend * x + slope;
        slope = slope * x + f;
        f = f * x + c[j];
    }
    if (f * s->sign > 0)
        s->b = x;
    else
        s->a = x;
    double new = f == 0 ? x : x - f / (slope - f * bend / slope);
    if (!((new > s->a && new < s->b) || new == x))
        new = sqrt(s->a * s->b);
    s->x = new;
    return fabs(new - x) > close * x && s->b - s->a > 0x1p-51 * s->b;
}

/* Zeros in ascending order, filled up with NaN. */
static void put(const Search *found, int number, int n, double *V, int cells)
{
    for (int k = 0; k < n; k++) {
        int i = k;
        for (; i > 0 && k < number && V[(long)(i - 1) * cells] > found[k].x; i--)
            V[(long)i * cells] = V[(long)(i - 1) * cells];
        V[(long)i * cells] = k < number ? found[k].x : NAN;
    }
}

/* The zeros of several cells are searched for side by side, so that a step need not wait for the one before. */
static INLINE int zeros(int n, int cells, const double *coefficients, const double *values, const double *sizes,
                        const Limits *limits, double *V, unsigned char *undecided)
{
    int most = 0;
    for (int from = 0; from < cells; from += TOGETHER) {
        int some = cells - from < TOGETHER ? cells - from : TOGETHER;
        double c[TOGETHER][POWERS];
        Search searches[TOGETHER * POWERS];
        int first[TOGETHER + 1], busy[TOGETHER * POWERS], number = 0;
        for (int i = 0; i < some; i++) {
            Both p[POWERS];
            Brackets found;
            for (int j = 0; j < n; j++) {
                c[i][j] = coefficients[(long)j * cells + from + i];
                p[j] = (Both){values[(long)j * cells + from + i], sizes[(long)j * cells + from + i]};
            }
            undecided[from + i] = (unsigned char)isolate(p, n, limits, &found);
            first[i] = number;
            for (int k = 0; k < found.number; k++, number++)
                searches[number] = begun(c[i], n, found.low[k], found.high[k], found.sign[k]);
        }
        first[some] = number;
        for (int k = 0; k < number; k++)
            busy[k] = k;
        for (int left; number; number = left) {
            left = 0;
            for (int k = 0; k < number; k++)
                if (stepped(searches + busy[k], n, limits->close))
                    busy[left++] = busy[k];
        }
        for (int i = 0; i < some; i++) {
            number = first[i + 1] - first[i];
            most = number > most ? number : most;
            put(searches + first[i], number, n, V + from + i, cells);
        }
    }
    return most;
}

/* n is 4 or 7; coefficients (n, cells), and (n, cells) each of what Bernstein coefficients are made of and of their
   sizes -> V (n, cells), ascending, filled up with NaN, and undecided (cells). Returns how many a cell has at most. */
int zeros_near(int n, int cells, const double *coefficients, const double *values, const double *sizes,
               const Limits *limits, double *V, unsigned char *undecided)
{
    if (n == 4) /* p1 */
        return zeros(4, cells, coefficients, values, sizes, limits, V, undecided);
    return zeros(7, cells, coefficients, values, sizes, limits, V, undecided); /* hurwitz3 */
}
