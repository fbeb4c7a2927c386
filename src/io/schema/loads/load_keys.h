/* SPDX-License-Identifier: BSD-3-Clause */
/* What acts on lines and members of bodies beside their weight, and the water: the structs into
 * which its keys of a scene file are read, and their tables. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_LOADS_LOAD_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_LOADS_LOAD_KEYS_H

#include "capstan/scene.h"
#include "io/schema/keys.h"

typedef struct CpsiSpringValues {
    const CpsiYaml *node;
    double at, from, to; /* NaN: not given */
    double stiffness[3], coupling[3];
    double place[3]; /* NaN: not given */
} CpsiSpringValues;

typedef struct CpsiForceValues {
    const CpsiYaml *node;
    double from, to; /* NaN: not given */
    double force[3];
} CpsiForceValues;

typedef struct CpsiDragValues {
    const CpsiYaml *node; /* NULL: none */
    CpsDrag drag;
} CpsiDragValues;

/* A member of a body. */
typedef struct CpsiMemberValues {
    const CpsiYaml *node;
    CpsMember member;
} CpsiMemberValues;

typedef struct CpsiCurrentValues {
    const CpsiYaml *node;
    CpsCurrentRow row;
} CpsiCurrentValues;

/* A wave: its period or its frequency, the other one is NaN. */
typedef struct CpsiWaveValues {
    const CpsiYaml *node;
    double amplitude, period, frequency; /* [m], [s], [Hz] */
    double direction, phase;             /* [degree] */
} CpsiWaveValues;

typedef struct CpsiWavesValues {
    const CpsiYaml *node; /* NULL: none */
    double depth, ramp;   /* [m], [s] */
    CpsiList components;  /* CpsiWaveValues; or */
    const char *file;     /* of a CSV file with them */
} CpsiWavesValues;

extern const CpsiMapping cpsi_spring_keys, cpsi_force_keys, cpsi_drag_keys, cpsi_current_keys,
    cpsi_waves_keys, cpsi_member_keys;

#endif
