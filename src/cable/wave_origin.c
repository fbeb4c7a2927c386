/* SPDX-License-Identifier: BSD-3-Clause */
/* The phase of a wave far from 0 (wave_origin.h).
 *
 * A short wave makes 1e6 rad on the way to an origin 200 km away, of which the rounding of its
 * number and of its direction are 1e-10 each. So both are computed with twice the digits: the
 * exponential and the rotation by their series, after the argument has been halved until it is
 * small, and the number by a last step of Newton's method. */
#include "cable/wave_origin.h"

#include <math.h>

#include "base/twofold.h"

/* Terms of a series at an argument below SMALL: 2^-90/15! is below 1e-38. */
enum { TERMS = 15 };
static const double SMALL = 0x1p-6;
/* tanh is 1 to 31 digits beyond this. */
static const double DEEP = 40;

/* How often x is to be halved until it is small. */
static int halvings(double x) {
    int count = 0;
    for (double size = fabs(x); size > SMALL; size *= 0.5) count++;
    return count;
}

static Twofold scaled(Twofold x, double power) { return (Twofold){power * x.high, power * x.low}; }

/* e^x */
static Twofold exponential(Twofold x) {
    const int count = halvings(x.high);
    const Twofold small = scaled(x, ldexp(1, -count));
    Twofold sum = twofold(1);
    for (int k = TERMS; k > 0; k--)
        sum = twofold_add(twofold(1), twofold_divide(twofold_multiply(small, sum), twofold(k)));
    for (int k = 0; k < count; k++) sum = twofold_multiply(sum, sum);
    return sum;
}

/* The cosine and the sine of an angle [rad]. */
static void rotation(double angle, Twofold out[2]) {
    const int count = halvings(angle);
    const Twofold small = twofold(ldexp(angle, -count));
    const Twofold square = twofold_negative(twofold_multiply(small, small));
    Twofold c = twofold(1), s = twofold(1);
    for (int k = TERMS; k > 0; k--) {
        const double even = 2.0 * k * (2.0 * k - 1), odd = 2.0 * k * (2.0 * k + 1);
        c = twofold_add(twofold(1), twofold_divide(twofold_multiply(square, c), twofold(even)));
        s = twofold_add(twofold(1), twofold_divide(twofold_multiply(square, s), twofold(odd)));
    }
    s = twofold_multiply(small, s);
    for (int k = 0; k < count; k++) {
        const Twofold both = twofold_multiply(c, s);
        c = twofold_subtract(twofold_multiply(c, c), twofold_multiply(s, s));
        s = scaled(both, 2);
    }
    out[0] = c;
    out[1] = s;
}

/* k of k tanh(k d) = w^2/g: at `first`, which is that to rounding, f = k t - w^2/g is small and f'
 * = t + k d (1 - t^2). */
static Twofold number_of(double first, double period, double depth, double g) {
    const Twofold rate = twofold_divide(TWOFOLD_TURN, twofold(period)),
                  deep = twofold_divide(twofold_multiply(rate, rate), twofold(g));
    const double x = first * depth;
    if (!(x < DEEP)) return deep;
    const Twofold one = twofold(1), e = exponential(scaled(twofold_product(first, depth), -2)),
                  t = twofold_divide(twofold_subtract(one, e), twofold_add(one, e)),
                  f = twofold_subtract(twofold_multiply(twofold(first), t), deep);
    const double slope = t.high + x * (1 - t.high) * (1 + t.high);
    return twofold_subtract(twofold(first), twofold(f.high / slope));
}

double cpsi_wave_way(const CpsWave *given, double number, double depth, double g,
                     const double origin[3]) {
    if (origin[0] == 0 && origin[1] == 0) return 0;
    Twofold along[2];
    rotation(given->direction, along);
    const Twofold way = twofold_add(twofold_multiply(along[0], twofold(origin[0])),
                                    twofold_multiply(along[1], twofold(origin[1]))),
                  all = twofold_multiply(number_of(number, given->period, depth, g), way),
                  turns = twofold(nearbyint(all.high / TWOFOLD_TURN.high)),
                  left = twofold_subtract(all, twofold_multiply(turns, TWOFOLD_TURN));
    return left.high + left.low;
}
