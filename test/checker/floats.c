/* SPDX-License-Identifier: BSD-3-Clause */
/* Points that float (floats.h).
 *
 * In water that is accelerated by a the gradient of the pressure is rho (g - a), so that a body of
 * the volume V in it, small beside the waves, has the force rho V (a - g) = D (e_z + a/|g|). Where
 * it is partly in the water, it has that of its part, if all of it is to move along the same
 * direction; the surface across it then is a plane. */
#include "floats.h"

#include <math.h>

Afloat floats_at_rest(double surface) { return (Afloat){{0, 0, surface}, {0, 0, 1}}; }

Afloat floats_in_waves(const Sea *sea, Real g, Real time, const PointMotion *motion) {
    static const Real LEAST = 0.1L; /* of gravity, in water that falls: of waves that break */
    Real x[3], velocity[3] = {0, 0, 0}, acceleration[3] = {0, 0, 0};
    Sea full = *sea;
    const Real share = sea_growth(sea, time);
    full.ramp = 0;
    for (int a = 0; a < 3; a++)
        x[a] = motion->reference[a] + (Real)motion->span * motion->rest_velocity[a];
    sea_motion(&full, time, x, velocity, acceleration);
    Afloat out = {{x[0], x[1], sea->surface + sea_elevation(sea, time, x)}, {0, 0, 1}};
    for (int a = 0; a < 3; a++) out.n[a] += share * acceleration[a] / g;
    if (out.n[2] < LEAST) out.n[2] = LEAST;
    return out;
}

static Real rise(const Afloat *surface, const double *x) {
    return -(surface->n[0] * (x[0] - surface->at[0]) + surface->n[1] * (x[1] - surface->at[1])) /
           surface->n[2];
}

Real floats_level(const Afloat *surface, const double *x) {
    return surface->at[2] + rise(surface, x);
}

Real floats_height(const Afloat *surface, const double *x) {
    return surface->n[2] * (x[2] - floats_level(surface, x));
}

void floats_wet(Real extent, Real height, Real touch, Real share[2]) {
    const Real low = height - extent / 2, high = height + extent / 2;
    if (extent > 0) {
        share[0] = share[1] = low >= 0 ? 0 : high <= 0 ? 1 : -low / extent;
        return;
    }
    share[0] = height < -touch ? 1 : 0;
    share[1] = height > touch ? 0 : 1;
}

/* The buoyancy is linear in each piece: all in, partly in. */
Real floats_energy(Real displaced, Real extent, Real height) {
    const Real dry = extent / 2, whole = -extent / 2;
    Real sum = 0, from = height;
    if (from < whole) {
        sum += displaced * (whole - from);
        from = whole;
    }
    if (from < dry && extent > 0) {
        Real first[2], last[2];
        floats_wet(extent, from, 0, first);
        floats_wet(extent, dry, 0, last);
        sum += displaced * (dry - from) * (first[0] + last[0]) / 2;
    }
    return sum;
}
