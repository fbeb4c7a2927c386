/* SPDX-License-Identifier: BSD-3-Clause */
/* Waves about the lines of a scene, and the motion of their water (capstan/waves.h). */
#ifndef CAPSTAN_SRC_CABLE_WAVES_H
#define CAPSTAN_SRC_CABLE_WAVES_H

#include "base/vec3.h"
#include "capstan/waves.h"

typedef struct CpsiWave {
    double amplitude; /* [m] */
    double frequency; /* [rad/s] w */
    double number;    /* [1/m] k */
    double along[2];  /* [-] direction */
    double phase;     /* [rad] at the origin of the places asked for */
} CpsiWave;

typedef struct CpsiWaves {
    double surface; /* [m] z of the surface at rest */
    double depth;   /* [m], may be infinite */
    double ramp;    /* [s] */
    double time;    /* [s] of the motion asked for */
    int count;
    const CpsiWave *wave; /* (count) */
} CpsiWaves;

/* A wave, for places relative to an origin. */
CpsiWave cpsi_wave(const CpsWave *given, double depth, double g, const double origin[3]);

/* The phase of a wave at x, and the share of its motion that has grown. */
double cpsi_wave_phase(const CpsiWaves *waves, int wave, Vec3 x);
double cpsi_waves_share(const CpsiWaves *waves);

/* Of the water; `elevation` of the surface may be NULL. */
typedef struct CpsiWaterMotion {
    Vec3 velocity, acceleration;
} CpsiWaterMotion;
CpsiWaterMotion cpsi_waves_at(const CpsiWaves *waves, Vec3 x, double *elevation);

#endif
