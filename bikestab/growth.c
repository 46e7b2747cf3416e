/* Tables of characteristic polynomials, speeds and the factors at some speeds -> growth rates.

   From speed to speed the two real quadratics of each polynomial are extrapolated and brought nearer by Newton's
   method on the product's coefficients (Bairstow), as bikestab/bairstow.py has it. Cells stand side by side in
   LANES, so that compilers make vectors of them. Nothing here may be contracted to fused multiply-adds: the bits
   are then the same on every machine. */

#include <math.h>

#define LANES 16

#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GNUC__) && !defined(__clang__)
#define CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define CLONES
#endif

#define SECOND_ORDER 0x1p-40 /* relative: what one step leaves of the coefficients */
#define COMMON 0x1p-24       /* as in bairstow.py */
#define NEAR 0x1p-26         /* as in quartic.py */

#define MOST 12              /* steps, where some lane is not good */

typedef double Lanes[LANES];

typedef struct {
    Lanes p, q, r, t;
} Factors; /* s^4 + ... = (s^2 + p s + q)(s^2 + r s + t) */

static inline double larger(double a, double b) { return a > b ? a : b; }

/* The coefficients of s^k at a speed; rows are (power of V, cell). */
static inline void value(const double *row, long cells, int degree, double V, double *restrict out)
{
    for (int l = 0; l < LANES; l++)
        out[l] = row[degree * cells + l];
    for (int j = degree - 1; j >= 0; j--)
        for (int l = 0; l < LANES; l++)
            out[l] = out[l] * V + row[j * cells + l];
}

/* One step of Newton's method where it is not good yet; good is where what a step leaves is small and no root is
   nearly in common. A lane's result does not depend on the others. */
static inline void step(Factors *restrict f, const double *restrict a, const double *restrict b,
                        const double *restrict c, const double *restrict d, double *restrict good)
{
    for (int l = 0; l < LANES; l++) {
        double p = f->p[l], q = f->q[l], r = f->r[l], t = f->t[l];
        double pr = p * r, pt = p * t, qr = q * r, qt = q * t;
        double g0 = a[l] - p - r;
        double g1 = b[l] - q - t - pr - p * g0;
        double g2 = c[l] - pt - qr - q * g0 - p * g1;
        double g3 = d[l] - qt - q * g1;
        double m = p - r, n = q - t;
        double x11 = p * m - n, x21 = q * m;
        double det = m * x21 - n * x11;
        double inverse = 1 / det;
        double dp = (m * g3 - n * g2) * inverse;
        double dq = (x11 * g3 - x21 * g2) * inverse;
        double dr = g0 - dp, dt = g1 + m * dp - dq;
        int done = good[l] > 0.0;
        double size = fabs(pr) + fabs(q) + fabs(t);
        double okay = fabs(det) >= COMMON * size * size ? 1.0 : 0.0;
        okay = fabs(dp * dr) <= SECOND_ORDER * size ? okay : 0.0;
        okay = fabs(dp * dt + dq * dr) <= SECOND_ORDER * (fabs(pt) + fabs(qr)) ? okay : 0.0;
        okay = fabs(dq * dt) <= SECOND_ORDER * fabs(qt) ? okay : 0.0;
        good[l] = done ? 1.0 : okay;
        f->p[l] = done ? p : p + dp;
        f->q[l] = done ? q : q + dq;
        f->r[l] = done ? r : r + dr;
        f->t[l] = done ? t : t + dt;
    }
}

/* The largest real part of the roots, NaN where it is not good. */
static inline void largest(const Factors *restrict f, const double *restrict good, float *restrict out)
{
    for (int l = 0; l < LANES; l++) {
        double h1 = 0.5 * f->p[l], h2 = 0.5 * f->r[l];
        double s1 = h1 * h1 - f->q[l], s2 = h2 * h2 - f->t[l];
        double okay = fabs(s1) >= NEAR * (h1 * h1) ? good[l] : 0.0;
        okay = fabs(s2) >= NEAR * (h2 * h2) ? okay : 0.0;
        double one = sqrt(larger(s1, 0.0)) - h1, other = sqrt(larger(s2, 0.0)) - h2;
        out[l] = (float)(okay > 0.0 ? larger(one, other) : NAN);
    }
}

static inline int all(const double *good)
{
    double least = 1.0;
    for (int l = 0; l < LANES; l++)
        least *= good[l];
    return least > 0.0;
}

static inline void extrapolate(const Factors *restrict f, const double *w, Factors *restrict out)
{
    const double *from = (const double *)f;
    double *to = (double *)out;
    for (int l = 0; l < 4 * LANES; l++)
        to[l] = w[0] * from[l] + w[1] * from[4 * LANES + l] + w[2] * from[8 * LANES + l] +
                w[3] * from[12 * LANES + l];
}

/* table (4, 4, cells): the coefficients of s^0 ... s^3 over that of s^4, with their highest powers of V, degree (4);
   start (4, cells): the factors at the first speed; V (speeds); weights (speeds, 4) of the factors at the last four
   speeds; out: growth rates (cells, speeds), rows `stride` apart, NaN where they are not good. cells is a multiple
   of LANES. */
CLONES void growth(const double *table, const int *degree, const double *start, const double *V, const double *weights,
                   float *out, long cells, long speeds, long stride)
{
    for (long i = 0; i < cells; i += LANES) {
        Factors last[4] = {0}, f;
        for (int l = 0; l < LANES; l++) {
            last[0].p[l] = start[i + l];
            last[0].q[l] = start[cells + i + l];
            last[0].r[l] = start[2 * cells + i + l];
            last[0].t[l] = start[3 * cells + i + l];
        }
        for (long k = 0; k < speeds; k++) {
            Lanes a, b, c, d, good = {0};
            float rate[LANES];
            value(table + 0 * 4 * cells + i, cells, degree[0], V[k], d);
            value(table + 1 * 4 * cells + i, cells, degree[1], V[k], c);
            value(table + 2 * 4 * cells + i, cells, degree[2], V[k], b);
            value(table + 3 * 4 * cells + i, cells, degree[3], V[k], a);
            extrapolate(last, weights + 4 * k, &f);
            for (int n = 0; n < MOST && !all(good); n++)
                step(&f, a, b, c, d, good);
            last[3] = last[2];
            last[2] = last[1];
            last[1] = last[0];
            last[0] = f;
            largest(&f, good, rate);
            for (int l = 0; l < LANES; l++)
                out[(i + l) * stride + k] = rate[l];
        }
    }
}
