/* SPDX-License-Identifier: BSD-3-Clause */
/* Waves of small height by their potential (sea.h): with p = k (x - c t) along the heading and s
 * the height above the bottom,
 *
 *     P = amplitude c cosh(k s)/sinh(k d) sin(p),   velocity = grad P,   c = w/k,
 *
 * and w^2 = g k tanh(k d) by bisection. Everything is in long double, with exponentials that never
 * grow. */
#include "sea.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

#include "water.h"

static const Real TAU = 6.283185307179586476925286766559L;

static int complain(FILE *log, const char *what) {
    if (log) fprintf(log, "%s: waves\n", what);
    return -1;
}

/* tanh(k d) is at most 1, so k is at least w^2/g. */
Real sea_number(Real frequency, Real g, Real depth) {
    Real low = frequency * frequency / g, high = low;
    if (!isfinite((double)depth)) return low;
    while (g * high * tanhl(high * depth) < frequency * frequency) high *= 2;
    for (int i = 0; i < 200; i++) {
        const Real middle = (low + high) / 2;
        if (g * middle * tanhl(middle * depth) < frequency * frequency)
            low = middle;
        else
            high = middle;
    }
    return low;
}

int sea_read(const Source *source, Sea *out, FILE *log) {
    size_t numbers;
    *out = (Sea){.waves = 0};
    if (nc_inq_attlen(source->nc, NC_GLOBAL, "waves", &numbers) != NC_NOERR) return 0;
    double *row = calloc(numbers + 1, sizeof *row);
    out->wave = calloc(numbers + 1, sizeof *out->wave);
    out->depth = INFINITY;
    size_t one = 1;
    const bool finite = nc_inq_attlen(source->nc, NC_GLOBAL, "wave_depth", &one) == NC_NOERR;
    const bool bad =
        !row || !out->wave || numbers % 4 != 0 || one != 1 ||
        nc_get_att_double(source->nc, NC_GLOBAL, "waves", row) ||
        nc_get_att_double(source->nc, NC_GLOBAL, "wave_ramp", &out->ramp) ||
        !water_surface(source, &out->surface) ||
        (finite && nc_get_att_double(source->nc, NC_GLOBAL, "wave_depth", &out->depth));
    if (bad || !(out->depth > 0) || !(out->ramp >= 0) || !(source->gravity[2] < 0) ||
        !isfinite(out->ramp)) {
        free(row);
        return complain(log, "cannot read");
    }
    for (int a = 0; a < 3; a++) out->origin[a] = source->origin[a];
    out->waves = numbers / 4;
    bool sound = true;
    for (size_t i = 0; i < out->waves; i++) {
        const double *of = &row[4 * i];
        sound = sound && of[0] > 0 && of[1] > 0 && isfinite(of[0] * of[1]) && isfinite(of[2]) &&
                isfinite(of[3]);
        if (!sound) continue;
        const Real frequency = TAU / of[1];
        out->wave[i] =
            (Wave){.amplitude = of[0],
                   .frequency = frequency,
                   .number = sea_number(frequency, -(Real)source->gravity[2], out->depth),
                   .heading = {cosl(of[2]), sinl(of[2])},
                   .phase = of[3]};
    }
    free(row);
    return sound ? 0 : complain(log, "senseless numbers");
}

void sea_free(Sea *sea) {
    free(sea->wave);
    sea->wave = NULL;
}

Real sea_growth(const Sea *sea, Real time) {
    return time < sea->ramp ? (1 - cosl(TAU / 2 * time / sea->ramp)) / 2 : 1;
}

/* The pressure of the moving water, rho dP/dt, is that of the water above the surface at rest. */
Real sea_elevation(const Sea *sea, Real time, const Real *x) {
    Real sum = 0;
    for (size_t i = 0; i < sea->waves; i++) {
        const Wave *w = &sea->wave[i];
        const Real way =
            w->heading[0] * (x[0] + sea->origin[0]) + w->heading[1] * (x[1] + sea->origin[1]);
        sum += w->amplitude * cosl(w->number * way - w->frequency * time + w->phase);
    }
    return sea_growth(sea, time) * sum;
}

void sea_motion(const Sea *sea, Real time, const Real *x, Real *velocity, Real *acceleration) {
    Real u[3] = {0, 0, 0}, a[3] = {0, 0, 0};
    Real z = x[2] - sea->surface, grown = 1, growth = 0;
    if (z > 0) z = 0;
    if (z < -sea->depth) z = -(Real)sea->depth;
    if (time < sea->ramp) {
        grown = (1 - cosl(TAU / 2 * time / sea->ramp)) / 2;
        growth = TAU / 4 / sea->ramp * sinl(TAU / 2 * time / sea->ramp);
    }
    for (size_t i = 0; i < sea->waves; i++) {
        const Wave *w = &sea->wave[i];
        const Real k = w->number,
                   way = w->heading[0] * (x[0] + sea->origin[0]) +
                         w->heading[1] * (x[1] + sea->origin[1]),
                   p = k * way - w->frequency * time + w->phase;
        /* e^(kz) and its mirror image at the bottom, over 1 - e^(-2kd) */
        const Real down = expl(k * z), up = expl(-k * z - 2 * k * sea->depth),
                   whole = -expm1l(-2 * k * sea->depth),
                   even = isinf(sea->depth) ? down : (down + up) / whole,
                   odd = isinf(sea->depth) ? down : (down - up) / whole;
        const Real size = w->amplitude * w->frequency;
        for (int b = 0; b < 2; b++) {
            u[b] += size * even * cosl(p) * w->heading[b];
            a[b] += size * even * w->frequency * sinl(p) * w->heading[b];
        }
        u[2] += size * odd * sinl(p);
        a[2] -= size * odd * w->frequency * cosl(p);
    }
    for (int b = 0; b < 3; b++) {
        velocity[b] += grown * u[b];
        acceleration[b] += grown * a[b] + growth * u[b];
    }
}
