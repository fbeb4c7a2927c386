/* SPDX-License-Identifier: BSD-3-Clause */
/* Numbers of twice the digits, as unevaluated sums of two (Dekker 1971, A floating-point technique
 * for extending the available precision): about 31 digits, and no overflow below 1e290. For what is
 * computed once, and must keep the digits that a difference of large numbers would lose. */
#ifndef CAPSTAN_SRC_BASE_TWOFOLD_H
#define CAPSTAN_SRC_BASE_TWOFOLD_H

#include <math.h>

typedef struct Twofold {
    double high, low; /* |low| <= ulp(high)/2 */
} Twofold;

static inline Twofold twofold(double a) { return (Twofold){a, 0}; }

/* a + b exactly, for any two; and where |a| >= |b|. */
static inline Twofold twofold_sum(double a, double b) {
    const double s = a + b, part = s - a;
    return (Twofold){s, (a - (s - part)) + (b - part)};
}
static inline Twofold twofold_renormal(double a, double b) {
    const double s = a + b;
    return (Twofold){s, b - (s - a)};
}

/* a b exactly, by halves of 26 bits. */
static inline Twofold twofold_product(double a, double b) {
    const double split = 134217729; /* 2^27 + 1 */
    const double ca = split * a, a1 = ca - (ca - a), a2 = a - a1, cb = split * b,
                 b1 = cb - (cb - b), b2 = b - b1, p = a * b;
    return (Twofold){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

static inline Twofold twofold_add(Twofold a, Twofold b) {
    const Twofold s = twofold_sum(a.high, b.high);
    return twofold_renormal(s.high, s.low + (a.low + b.low));
}

static inline Twofold twofold_negative(Twofold a) { return (Twofold){-a.high, -a.low}; }

static inline Twofold twofold_subtract(Twofold a, Twofold b) {
    return twofold_add(a, twofold_negative(b));
}

static inline Twofold twofold_multiply(Twofold a, Twofold b) {
    const Twofold p = twofold_product(a.high, b.high);
    return twofold_renormal(p.high, p.low + (a.high * b.low + a.low * b.high));
}

static inline Twofold twofold_divide(Twofold a, Twofold b) {
    const double first = a.high / b.high;
    const Twofold left = twofold_subtract(a, twofold_multiply(b, twofold(first)));
    return twofold_renormal(first, (left.high + left.low) / b.high);
}

/* 2 pi */
#define TWOFOLD_TURN ((Twofold){6.283185307179586232, 2.4492935982947064e-16})

#endif
