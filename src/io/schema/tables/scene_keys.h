/* SPDX-License-Identifier: BSD-3-Clause */
/* The structs into which a scene file is read (scene_keys.c has the table of its keys): the scene's
 * own structs where they can hold the values directly, and others that scene_build.c converts. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_TABLES_SCENE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_TABLES_SCENE_KEYS_H

#include "capstan/scene.h"
#include "io/schema/history_values.h"
#include "io/schema/loads/load_keys.h"

typedef struct CpsiSceneValues {
    const CpsiYaml *node;
    int version;
    CpsScene scene;   /* without its lists */
    double water;     /* [kg/m3] 0: in air */
    CpsiList types;   /* CpsiTypeValues */
    CpsiList current; /* CpsiCurrentValues */
    CpsiWavesValues waves;
    CpsiList obstacles; /* CpsiObstacleValues */
    CpsiList bodies;    /* CpsiSceneBodyValues */
    CpsiList points;    /* CpsiScenePointValues */
    CpsiList lines;     /* CpsiLineValues */
    CpsiList history;   /* CpsiStageValues */
} CpsiSceneValues;

typedef struct CpsiObstacleValues {
    const CpsiYaml *node; /* the key is the name */
    CpsObstacle obstacle;
    const CpsiYaml *set; /* set of friction forces */
    /* of ground: files beside the scene, their form in the order of CpsiGridForm, and the name of a
     * netCDF file's variable */
    const char *grid, *factors, *variable;
    int form;
    bool are_depths, extends;
    double cone_angle;           /* [degrees] */
    CpsiRotationValues rotation; /* of a box or a mesh */
    /* of a mesh: the file beside the scene, its form in the order of CpsiMeshForm, and its place */
    const char *triangles;
    int mesh_form;
    double scale;
    bool two_sided;
} CpsiObstacleValues;

/* A point at which lines end. */
/* A set that an end or a point is held to. */
typedef struct CpsiOnValues {
    const CpsiYaml *node; /* NULL: none */
    int kind;             /* as the CpsConstraintKind after NONE */
    CpsConstraint on;     /* without its kind */
    int rail;             /* 0: to a place, 1: without ends */
    double to[3], force[3];
    CpsiRotationValues rotation;
    const CpsiYaml *set; /* an expression */
} CpsiOnValues;

typedef struct CpsiScenePointValues {
    const CpsiYaml *node; /* the key is the name */
    CpsPoint point;
    double mass, volume; /* mass: NaN: not given */
    double inertia;      /* NaN: not given */
    const char *body;    /* name of the body that it is on */
    double at[3];        /* [m] in its axes */
    CpsiOnValues on;
} CpsiScenePointValues;

/* A hydrostatic stiffness without coupling. */
typedef struct CpsiDiagonalValues {
    const CpsiYaml *node;
    double k[CPS_BODY_DIRECTIONS]; /* [N/m], [N m] */
} CpsiDiagonalValues;

/* The force of waves of one period and direction on a body. */
typedef struct CpsiExcitationValues {
    const CpsiYaml *node;
    double period, frequency;                                          /* NaN: not given */
    double direction;                                                  /* [degree] */
    double amplitude[CPS_BODY_DIRECTIONS], phase[CPS_BODY_DIRECTIONS]; /* [N/m, N], [degree] */
} CpsiExcitationValues;

/* A rigid body of the scene. */
typedef struct CpsiSceneBodyValues {
    const CpsiYaml *node; /* the key is the name */
    CpsBody body;
    double mass, volume; /* NaN: not given */
    CpsiRotationValues rotation;
    CpsiNumberRows hydrostatics;                   /* (6, 6) */
    CpsiDiagonalValues diagonal;                   /* .. or these */
    CpsiNumberRows added_mass, damping, quadratic; /* (6, 6) .. or these */
    CpsiList excitation;                           /* CpsiExcitationValues */
    CpsiList members;                              /* CpsiMemberValues */
    const char *radiation;                         /* file of a table; NULL: none */
    CpsiDiagonalValues added_diagonal, damping_diagonal, quadratic_diagonal;
    double moments[3], products[3];   /* [kg m2] */
    double velocity[3], turn_rate[3]; /* [m/s], [rad/s] */
    double arm[3];                    /* [m] of the force */
} CpsiSceneBodyValues;

typedef struct CpsiZoneValues {
    const CpsiYaml *node;
    CpsFrictionZone zone;
} CpsiZoneValues;

/* A table of strains and tensions. */
typedef struct CpsiStiffnessValues {
    const CpsiYaml *node; /* NULL: none */
    CpsiNumberRows strain, tension;
} CpsiStiffnessValues;

/* A dynamic stiffness; NaN without a table: not given. */
typedef struct CpsiDynamicValues {
    double stiffness;
    CpsiStiffnessValues table;
} CpsiDynamicValues;

/* What a metre of line weighs: `mass`, in water with its `diameter`, or `weight`; NaN: not given.
 */
typedef struct CpsiTypeValues {
    const CpsiYaml *node; /* the key is the name */
    double mass, diameter, weight, stiffness, friction;
    double inertia;            /* NaN: not given */
    CpsiStiffnessValues table; /* in place of `stiffness` */
    CpsiDynamicValues dynamic;
    double breaking_load; /* NaN: not given */
    double break_at;      /* NaN: not given */
} CpsiTypeValues;

/* Elements that become shorter towards an end, or towards both. */
typedef enum CpsiTowards { CPSI_TOWARDS_A, CPSI_TOWARDS_B, CPSI_TOWARDS_BOTH } CpsiTowards;
typedef struct CpsiGradeValues {
    const CpsiYaml *node; /* NULL: all are equal */
    int towards;          /* CpsiTowards */
    double ratio;         /* longest over shortest */
} CpsiGradeValues;

/* What a length is found for; NaN: not given. */
typedef struct CpsiPretensionValues {
    const CpsiYaml *node; /* NULL: lengths are as written */
    int end;
    double tension, horizontal, section;
} CpsiPretensionValues;

typedef struct CpsiSectionValues {
    const CpsiYaml *node;
    const char *type;
    double length, count, element_length; /* count and element_length: NaN: not given */
    CpsiGradeValues grade;
} CpsiSectionValues;

typedef struct CpsiPointWeightValues {
    const CpsiYaml *node;
    double at, mass, volume, weight, inertia; /* mass and inertia: NaN: not given */
    bool floats;
} CpsiPointWeightValues;

typedef struct CpsiStraightValues {
    const CpsiYaml *node;
    double from[3], to[3];
} CpsiStraightValues;

typedef struct CpsiArcValues {
    const CpsiYaml *node;
    double from[3], centre[3], axis[3];
} CpsiArcValues;

typedef struct CpsiStartValues {
    const CpsiYaml *node; /* NULL: a word */
    int word;             /* that of `static` */
    CpsiStraightValues straight;
    CpsiNumberRows polyline;
    CpsiArcValues arc;
    const char *nodes; /* name of a file */
} CpsiStartValues;

/* An end of a line: `held` or `free` as a word, or with its position or force; or at a point. */
typedef enum CpsiEndWord {
    CPSI_END_HELD,
    CPSI_END_FREE,
    CPSI_END_AT_POINT,
    CPSI_END_ON_SET
} CpsiEndWord;

typedef struct CpsiEndValues {
    const CpsiYaml *node; /* NULL: a word */
    int word;             /* CpsiEndWord, in either form */
    double value[3];
    const char *point; /* its name */
    CpsiOnValues on;
    double stored; /* [m] NaN: no winch */
} CpsiEndValues;

typedef struct CpsiLineValues {
    const CpsiYaml *node; /* the key is the name */
    CpsLine line;
    double mass, count, diameter; /* count: number of elements; NaN: not given */
    double inertia;               /* NaN: not given */
    double breaking_load;         /* NaN: not given */
    double break_at;              /* NaN: not given */
    CpsiStiffnessValues table;    /* in place of line.stiffness */
    CpsiDynamicValues dynamic;
    CpsiPretensionValues pretension;
    CpsiList sections;        /* CpsiSectionValues */
    CpsiList point_weights;   /* CpsiPointWeightValues */
    const CpsiYaml *elements; /* a list of them */
    double element_length;    /* NaN: not given */
    CpsiGradeValues grade;
    CpsiList zones;          /* CpsiZoneValues */
    CpsiList springs, loads; /* CpsiSpringValues, CpsiForceValues */
    CpsiDragValues drag;
    CpsiStartValues start;
    CpsiEndValues end[2];
} CpsiLineValues;

extern const CpsiMapping cpsi_scene_file;
extern const CpsiMapping cpsi_stage_keys;    /* an entry of the history: history_keys.c */
extern const CpsiMapping cpsi_rotation_keys; /* a rotation of a body, there and where it begins */

#endif
