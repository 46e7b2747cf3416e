/* Tables of characteristic polynomials -> intervals of stable speeds in double precision.

   A cell for which rounding might decide anything is left to bikestab/speeds.py. The critical speeds are the positive
   zeros of p0 and hurwitz3; those of hurwitz3, of degree 6 with damping, lie between those of its derivative, and so
   on. Nothing here may be contracted to fused multiply-adds. */

#include <math.h>

#define MOST 4             /* intervals of a cell */
#define DEGREE 6           /* of hurwitz3 */
#define ROUNDING 0x1p-48   /* share of the sizes of its terms that a polynomial's value may be off by */
#define APART 0x1p-36      /* relative: zeros and extreme values nearer than that are left alone */
#define KNOWN 0x1p-31      /* relative: how far rounding may move a zero */
#define ROUGH 0x1p-20      /* relative error of the zeros of derivatives */
#define FINE 0x1p-36         /* of the last step to a zero, which squares it */

typedef struct {
    double c[DEGREE + 1], size[DEGREE + 1]; /* of V^j, and of the terms that they are the sum of */
    int degree;
} Polynomial;

static double value(const double *c, int degree, double x)
{
    double f = c[degree];
    for (int j = degree - 1; j >= 0; j--)
        f = f * x + c[j];
    return f;
}

static double value_and_slope(const double *c, int degree, double x, double *slope)
{
    double f = c[degree], d = 0;
    for (int j = degree - 1; j >= 0; j--) {
        d = d * x + f;
        f = f * x + c[j];
    }
    *slope = d;
    return f;
}

/* The zero between two ends with values of different signs: Newton's method, or halves. */
static double zero(const double *c, int degree, double low, double high, int rising, double share)
{
    double x = 0.5 * (low + high);
    for (int n = 0; n < 200; n++) {
        double slope, f = value_and_slope(c, degree, x, &slope);
        if ((f < 0) == rising)
            low = x;
        else
            high = x;
        double move = f / slope;
        if (fabs(move) <= share * x)
            return x - move;
        x -= move;
        if (!(x > low && x < high))
            x = 0.5 * (low + high);
    }
    return NAN;
}

static int sign_changes(const double *c, int degree)
{
    int changes = 0;
    double last = 0;
    for (int j = 0; j <= degree; j++) {
        changes += c[j] * last < 0;
        last = c[j] != 0 ? (c[j] > 0 ? 1.0 : -1.0) : last;
    }
    return changes;
}

/* The positive zeros of c0 + c1 x + c2 x^2, without subtracting nearly equal numbers. */
static int zeros_of_quadratic(const double *c, double *found)
{
    double square = c[1] * c[1] - 4 * c[0] * c[2];
    if (!(square > 0))
        return 0;
    double q = -0.5 * (c[1] + copysign(sqrt(square), c[1])), one = q / c[2], other = c[0] / q;
    int number = 0;
    if (fmin(one, other) > 0)
        found[number++] = fmin(one, other);
    if (fmax(one, other) > 0)
        found[number++] = fmax(one, other);
    return number;
}

static int zeros(const double *c, int degree, double most, double share, double *found);

/* The positive zeros of the derivative, roughly. */
static int extremes(const double *c, int degree, double most, double *found)
{
    double derivative[DEGREE];
    for (int j = 0; j < degree; j++)
        derivative[j] = (j + 1) * c[j + 1];
    return zeros(derivative, degree - 1, most, ROUGH, found);
}

/* The zeros between given ends, the first and the last of them rest and a speed above all zeros. */
static int zeros_between(const double *c, int degree, const double *ends, int parts, double share, double *found)
{
    int number = 0, positive = c[0] > 0;
    for (int i = 1; i <= parts; i++) {
        int then = i == parts ? c[degree] > 0 : value(c, degree, ends[i]) > 0;
        if (then != positive)
            found[number++] = zero(c, degree, ends[i - 1], ends[i], then, share);
        positive = then;
    }
    return number;
}

/* The positive zeros of a polynomial in ascending order, and how many they are; all are below `most`. */
static int zeros(const double *c, int degree, double most, double share, double *found)
{
    double ends[DEGREE + 2];
    int inner = 0, changes = sign_changes(c, degree);
    if (changes == 0)
        return 0;
    if (degree == 2)
        return zeros_of_quadratic(c, found);
    if (changes > 1)
        inner = extremes(c, degree, most, ends + 1);
    ends[0] = 0;
    ends[inner + 1] = most;
    return zeros_between(c, degree, ends, inner + 1, share, found);
}

/* A power of two above the size of all zeros (Fujiwara). */
static double above_zeros(const double *c, int degree)
{
    int last, exponent, most = -1000;
    frexp(c[degree], &last);
    for (int j = 0; j < degree; j++)
        if (c[j] != 0) {
            frexp(c[j], &exponent);
            int share = (exponent - last + 1) / (degree - j) + 1;
            most = share > most ? share : most;
        }
    return ldexp(1.0, most + 1);
}

/* The same where rounding decides nothing; -1 where it might. */
static int certain_zeros(const Polynomial *p, double *found)
{
    const double *c = p->c, *size = p->size;
    int low = 0, high = p->degree, changes;
    while (high > 0 && size[high] == 0)
        high--;
    while (low < high && size[low] == 0)
        low++;
    if (fabs(c[low]) <= ROUNDING * size[low] || fabs(c[high]) <= ROUNDING * size[high])
        return -1;
    int degree = high - low, inner = 0;
    c += low;
    size += low;
    if (!(changes = sign_changes(c, degree)))
        return 0;
    double most = above_zeros(c, degree), ends[DEGREE + 2];
    if (!(most < 1e100 && most > 1e-100))
        return -1;
    if (changes > 1)
        inner = extremes(c, degree, most, ends + 1);
    for (int i = 1; i <= inner; i++) /* zeros must not be missed in pairs */
        if (!(fabs(value(c, degree, ends[i])) > APART * value(size, degree, ends[i])))
            return -1;
    ends[0] = 0;
    ends[inner + 1] = most;
    int number = degree == 2 ? zeros_of_quadratic(c, found) : zeros_between(c, degree, ends, inner + 1, FINE, found);
    for (int i = 0; i < number; i++) {
        double slope;
        value_and_slope(c, degree, found[i], &slope);
        if (!(ROUNDING * value(size, degree, found[i]) <= KNOWN * found[i] * fabs(slope)))
            return -1;
        if (i && !(found[i] - found[i - 1] > APART * found[i]))
            return -1;
    }
    return number;
}

typedef struct {
    double f0, f, d1, e0, e, q0, q, d3, k, m; /* p0 = f0 + f V^2, p1 = d1 + e0 V + e V^3, p2, p3 = d3 + k V, p4 */
} Entries;

static void hurwitz3(const Entries *n, Polynomial *h)
{
    double a[4] = {n->d1, n->e0, 0, n->e};
    double b[4] = {n->q0 * n->d3 - n->m * n->d1, n->q0 * n->k - n->m * n->e0, n->q * n->d3, n->q * n->k - n->m * n->e};
    double s[4] = {fabs(n->q0 * n->d3) + fabs(n->m * n->d1), fabs(n->q0 * n->k) + fabs(n->m * n->e0),
                   fabs(n->q * n->d3), fabs(n->q * n->k) + fabs(n->m * n->e)};
    double square[3] = {n->d3 * n->d3, 2 * n->d3 * n->k, n->k * n->k}, p0[3] = {n->f0, 0, n->f};
    for (int j = 0; j <= DEGREE; j++)
        h->c[j] = h->size[j] = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) {
            h->c[i + j] += a[i] * b[j];
            h->size[i + j] += fabs(a[i]) * s[j];
        }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            h->c[i + j] -= p0[i] * square[j];
            h->size[i + j] += fabs(p0[i] * square[j]);
        }
    h->degree = DEGREE;
}

/* Without damping hurwitz3 / V^2 is a quadratic in V^2. */
static int weave_speeds(const Entries *n, double *V, int *positive)
{
    Polynomial h, even = {.degree = 2};
    hurwitz3(n, &h);
    const Polynomial *p = &h;
    int undamped = n->d1 == 0 && n->d3 == 0;
    if (undamped) {
        for (int j = 0; j < 3; j++) {
            even.c[j] = h.c[2 * j + 2];
            even.size[j] = h.size[2 * j + 2];
        }
        p = &even;
    }
    int number = certain_zeros(p, V);
    if (undamped)
        for (int i = 0; i < number; i++)
            V[i] = sqrt(V[i]);
    int low = 0;
    while (low < p->degree && p->size[low] == 0)
        low++;
    *positive = p->c[low] > 0;
    return number;
}

/* Whether p1, p3 and p4 are positive at a speed: 1 or 0, or -1 where rounding might decide. */
static int others_positive(const Entries *n, double V)
{
    double p[3] = {n->d1 + (n->e0 + n->e * V * V) * V, n->d3 + n->k * V, n->m};
    double size[3] = {fabs(n->d1) + (fabs(n->e0) + fabs(n->e) * V * V) * V, fabs(n->d3) + fabs(n->k) * V, fabs(n->m)};
    int all = 1;
    for (int i = 0; i < 3; i++) {
        if (fabs(p[i]) <= ROUNDING * size[i])
            return -1;
        all &= p[i] > 0;
    }
    return all;
}

/* The intervals of one cell; 0 where rounding might decide. */
static int intervals_of(const Entries *n, double *V1, double *V2)
{
    double end[DEGREE + 2];
    int weave, number = weave_speeds(n, end, &weave), capsize = (n->f0 != 0 ? n->f0 : n->f) > 0, is_capsize = -1;
    if (number < 0 || (n->f0 == 0 && n->f == 0))
        return 0;
    if ((n->f0 > 0 && n->f < 0) || (n->f0 < 0 && n->f > 0)) {
        double V = sqrt(-n->f0 / n->f);
        int i = number;
        for (; i > 0 && end[i - 1] > V; i--)
            end[i] = end[i - 1];
        end[i] = V;
        is_capsize = i;
        number++;
        if ((i > 0 && !(V - end[i - 1] > APART * V)) || (i + 1 < number && !(end[i + 1] - V > APART * V)))
            return 0;
    }
    int found = 0;
    for (int i = 0; i <= number; i++) {
        double low = i ? end[i - 1] : 0, high = i < number ? end[i] : INFINITY;
        if (i && i - 1 == is_capsize)
            capsize = !capsize;
        else if (i)
            weave = !weave;
        if (!weave || !capsize)
            continue;
        int stable = others_positive(n, i < number ? low + 0.5 * (high - low) : 2 * low + 1);
        if (stable < 0 || (stable && found == MOST))
            return 0;
        if (stable) {
            V1[found] = low;
            V2[found++] = high;
        }
    }
    return 1;
}

/* The text that this was made of, as its builder tells: an older library is not taken. */
unsigned long long sources(void)
{
    return SOURCES;
}

/* table (5, 4, cells) -> V1, V2 (cells, MOST), filled up with NaN, and sure (cells), 0 where rounding might decide. */
void intervals(const double *table, long cells, double *V1, double *V2, unsigned char *sure)
{
    for (long i = 0; i < cells; i++) {
#define ENTRY(k, j) table[(4 * (k) + (j)) * cells + i]
        Entries n = {ENTRY(0, 0), ENTRY(0, 2), ENTRY(1, 0), ENTRY(1, 1), ENTRY(1, 3),
                     ENTRY(2, 0), ENTRY(2, 2), ENTRY(3, 0), ENTRY(3, 1), ENTRY(4, 0)};
        for (int k = 0; k < MOST; k++)
            V1[MOST * i + k] = V2[MOST * i + k] = NAN;
        sure[i] = (unsigned char)intervals_of(&n, V1 + MOST * i, V2 + MOST * i);
    }
}
