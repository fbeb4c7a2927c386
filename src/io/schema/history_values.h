/* SPDX-License-Identifier: BSD-3-Clause */
/* What the reader fills of an entry of a scene's history, by the table of
 * tables/history_keys.c. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_HISTORY_VALUES_H
#define CAPSTAN_SRC_IO_SCHEMA_HISTORY_VALUES_H

#include "capstan/scene.h"
#include "io/schema/keys.h"

/* A rotation, in one of two forms. */
typedef enum CpsiRotationForm { CPSI_ROTATION_QUATERNION, CPSI_ROTATION_ANGLES } CpsiRotationForm;

typedef struct CpsiRotationValues {
    const CpsiYaml *node; /* NULL: not given */
    int form;             /* CpsiRotationForm */
    double quaternion[4];
    double angle[3]; /* [degrees] roll, pitch, yaw */
} CpsiRotationValues;

/* Kinds of changes at an end of a line, or at a point. */
typedef enum CpsiChangeKind {
    CPSI_CHANGE_POSITION,
    CPSI_CHANGE_MOVE,
    CPSI_CHANGE_FORCE,
    CPSI_CHANGE_RELEASE /* of an end only */
} CpsiChangeKind;

/* An oscillation; what is not given is 0. */
typedef struct CpsiSwayValues {
    const CpsiYaml *node;
    double sine[3], cosine[3];
    double rotation_sine[3], rotation_cosine[3]; /* [degrees] of a held body */
    double moment_sine[3], moment_cosine[3];     /* [N m] of a free body */
    double period;                               /* [s] NaN: not given */
} CpsiSwayValues;

typedef struct CpsiChangeValues {
    const CpsiYaml *node; /* the key is LINE.END or POINT.point */
    int kind;             /* CpsiChangeKind */
    double value[3];
    CpsiSwayValues sway;   /* given beside the value; of an end or point */
    CpsiList oscillations; /* CpsiSwayValues */
    const char *series;    /* file of a time series; NULL: none */
    bool yes;              /* of `release` */
} CpsiChangeValues;

/* A change of a body: its pose, or the load on it. A key is given where the mapping has it. */
typedef struct CpsiBodyChangeValues {
    const CpsiYaml *node; /* the key is BODY.body */
    double position[3], move[3];
    CpsiRotationValues rotation;
    double force[3], moment[3], arm[3];
    CpsiList oscillations; /* CpsiSwayValues */
    const char *series;    /* as of an end */
} CpsiBodyChangeValues;

/* A shift of an obstacle. */
typedef struct CpsiShiftValues {
    const CpsiYaml *node; /* the key is OBSTACLE.obstacle */
    double move[3];
    double turn; /* [degrees] NaN: not given */
    double axis[3], about[3];
} CpsiShiftValues;

/* Which of its keys a grasp of a node has. */
typedef enum CpsiGraspKind {
    CPSI_GRASP_POSITION,
    CPSI_GRASP_HOLD,
    CPSI_GRASP_FORCE,
    CPSI_GRASP_RELEASE
} CpsiGraspKind;

typedef struct CpsiGraspValues {
    const CpsiYaml *node; /* the key is LINE.node */
    int kind;             /* CpsiGraspKind */
    double at;            /* [m] */
    double value[3];
    bool yes; /* of `hold` and `release` */
} CpsiGraspValues;

typedef struct CpsiStageValues {
    const CpsiYaml *node;
    CpsStage stage;         /* gravity is NaN where not given */
    double time_step;       /* [s] NaN: not given */
    int stiffness;          /* in the order of its words */
    CpsiList changes;       /* CpsiChangeValues */
    CpsiList point_changes; /* CpsiChangeValues, with the key POINT.point */
    CpsiList body_changes;  /* CpsiBodyChangeValues */
    CpsiList grasps;        /* CpsiGraspValues, with the key LINE.node */
    CpsiList turns;         /* CpsiNumberItem, with the key OBSTACLE.turn */
    CpsiList shifts;        /* CpsiShiftValues */
    CpsiList pay_outs;      /* CpsiNumberItem, with the key LINE.pay_out_A or LINE.pay_out_B */
} CpsiStageValues;

#endif
