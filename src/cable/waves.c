/* SPDX-License-Identifier: BSD-3-Clause */
/* The motion of the water in waves (waves.h). */
#include "cable/waves.h"

#include <float.h>
#include <math.h>

#include "base/math.h"
#include "cable/wave_origin.h"

/* Steps of Newton's method for a wave number, which converges quadratically from either limit. */
enum { MOST = 100 };

double cps_wave_number(double period, double depth, double g) {
    if (!(period > 0 && depth > 0 && g > 0)) return NAN;
    const double frequency = 2 * CPSI_PI / period, deep = frequency * frequency / g;
    if (!isfinite(depth)) return deep;
    /* x tanh x = c with x = k d: sqrt(c) in the limit of shallow water, c in that of deep water */
    const double c = deep * depth;
    double x = c < 1 ? sqrt(c) : c, step = x;
    for (int i = 0; i < MOST && fabs(step) > DBL_EPSILON * x; i++) {
        const double t = tanh(x);
        step = (x * t - c) / (t + x * (1 - t) * (1 + t));
        x -= step;
    }
    return x / depth;
}

double cps_breaking_height(double k, double depth) {
    return 0.142 * (2 * CPSI_PI / k) * tanh(k * depth);
}

CpsiWave cpsi_wave(const CpsWave *given, double depth, double g, const double origin[3]) {
    const double number = cps_wave_number(given->period, depth, g),
                 along[2] = {cos(given->direction), sin(given->direction)};
    return (CpsiWave){.amplitude = given->amplitude,
                      .frequency = 2 * CPSI_PI / given->period,
                      .number = number,
                      .along = {along[0], along[1]},
                      .phase = fmod(given->phase, 2 * CPSI_PI) +
                               cpsi_wave_way(given, number, depth, g, origin)};
}

double cpsi_wave_phase(const CpsiWaves *waves, int wave, Vec3 x) {
    const CpsiWave *of = &waves->wave[wave];
    return of->number * (of->along[0] * x.x + of->along[1] * x.y) - of->frequency * waves->time +
           of->phase;
}

double cpsi_waves_share(const CpsiWaves *waves) {
    if (!(waves->time < waves->ramp)) return 1;
    const double half = sin(0.5 * CPSI_PI * waves->time / waves->ramp);
    return half * half;
}

/* cosh(k (z + d)) / sinh(k d) and sinh(k (z + d)) / sinh(k d), which no depth makes overflow. */
static void decay(double k, double z, double d, double share[2]) {
    const double sink = exp(k * z), twice = -2 * k * d, above = -2 * k * (z + d);
    share[0] = sink * (1 + exp(above)) / -expm1(twice);
    share[1] = sink * -expm1(above) / -expm1(twice);
}

/* Add a wave at the height z <= 0 above the surface at rest. */
static void add_wave(const CpsiWaves *waves, int index, Vec3 x, double z, CpsiWaterMotion *out,
                     double *elevation) {
    const CpsiWave *wave = &waves->wave[index];
    const double w = wave->frequency, speed = wave->amplitude * w,
                 p = cpsi_wave_phase(waves, index, x), c = cos(p), s = sin(p);
    double share[2];
    decay(wave->number, z, waves->depth, share);
    const double u = speed * share[0] * c, du = speed * w * share[0] * s;
    out->velocity =
        vec3_add(out->velocity, vec3(u * wave->along[0], u * wave->along[1], speed * share[1] * s));
    out->acceleration = vec3_add(out->acceleration, vec3(du * wave->along[0], du * wave->along[1],
                                                         -speed * w * share[1] * c));
    *elevation += wave->amplitude * c;
}

CpsiWaterMotion cpsi_waves_at(const CpsiWaves *waves, Vec3 x, double *elevation) {
    CpsiWaterMotion out = {.velocity = {0, 0, 0}, .acceleration = {0, 0, 0}};
    const double z = fmax(fmin(x.z - waves->surface, 0), -waves->depth), t = waves->time;
    double lift = 0;
    for (int i = 0; i < waves->count; i++) add_wave(waves, i, x, z, &out, &lift);
    if (t < waves->ramp) {
        const double share = cpsi_waves_share(waves), turn = CPSI_PI / waves->ramp,
                     rate = 0.5 * turn * sin(turn * t);
        out.acceleration = vec3_axpy(rate, out.velocity, vec3_scale(share, out.acceleration));
        out.velocity = vec3_scale(share, out.velocity);
        lift *= share;
    }
    if (elevation) *elevation = lift;
    return out;
}
