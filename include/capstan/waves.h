/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/waves.h: waves of small height (Airy) in the water of a scene, one or a sum of many,
 * which move the water about lines with drag, and lift points that float (point.h), in steps in
 * time (motion.h).
 *
 *     CpsWave wave = {.amplitude = 3, .period = 12};
 *     CpsWaves waves = {.depth = 320, .wave_count = 1, .wave = &wave};
 *     current.waves = &waves;
 *     scene.has_water_surface = true;
 *
 * With the phase p = k (x cos D + y sin D) - w t + phase, w = 2 pi / period and w^2 = g k tanh(k
 * d), a wave lifts the surface by amplitude cos(p), and at the height z above the surface at rest,
 * -d <= z <= 0, the water has the velocity
 *
 *     along D   amplitude w cosh(k (z + d)) / sinh(k d) cos(p)
 *     upwards   amplitude w sinh(k (z + d)) / sinh(k d) sin(p)
 *
 * beside that of the current, and the acceleration that is its derivative by the time in a fixed
 * place. Above the surface at rest the motion is that at the surface at rest, below the bottom that
 * at the bottom: the theory knows no others, and what they would change is of second order in the
 * amplitude. The time is that since the history began. */
#ifndef CAPSTAN_WAVES_H
#define CAPSTAN_WAVES_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

struct CpsScene;

enum { CPS_MAX_WAVES = 1000 };

typedef struct CpsWave {
    double amplitude; /* [m] > 0, half of a height at most cps_breaking_height */
    double period;    /* [s] > 0 */
    double direction; /* [rad] D in which it goes, from x towards y; default 0 */
    double phase;     /* [rad] default 0: a crest over the origin at the time 0 */
} CpsWave;

/* All is 0 in a struct that is initialised so. They need a scene with a water surface, gravity
 * (0, 0, -g) that does not change, g > 0, a line with drag, a point with a displaced weight or a
 * body with excitation or members (body.h), and a step in time. */
typedef struct CpsWaves {
    double depth;        /* [m] d > 0 of the water at rest; INFINITY: deep */
    int wave_count;      /* 1..CPS_MAX_WAVES; their motions add up */
    const CpsWave *wave; /* (wave_count) */
    /* [s] >= 0, default 0: velocities are multiplied by sin^2(pi t / (2 ramp)) until then, and the
     * accelerations are those of that */
    double ramp;
} CpsWaves;

/* The motion of the water in waves, without that of a current. */
typedef struct CpsWaterMotion {
    double velocity[3];     /* [m/s] */
    double acceleration[3]; /* [m/s2] */
    double elevation;       /* [m] of the surface above that at rest */
} CpsWaterMotion;

/* [1/m] k of a wave with this period [s] in water of this depth [m] under gravity g [m/s2], to
 * rounding; NaN where one of them is not positive. */
CPS_API double cps_wave_number(double period, double depth, double g);

/* [m] The greatest height of a wave with the wave number k in this depth, above which it breaks:
 * 0.142 (2 pi / k) tanh(k depth) (Miche 1944). */
CPS_API double cps_breaking_height(double k, double depth);

/* What the waves of a scene do at the time [s] in the place x [m]; of a scene without any, of one
 * without a water surface and of NULL zeros. The scene need not be checked. */
CPS_API CpsWaterMotion cps_waves_at(const struct CpsScene *scene, double time, const double x[3]);

#ifdef __cplusplus
}
#endif
#endif
