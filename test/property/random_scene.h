/* SPDX-License-Identifier: BSD-3-Clause */
/* Seeded random scenes, by class. The same (class, seed) gives the same scene, up to the last
 * digits of the C library's cos and pow. */
#ifndef CAPSTAN_TEST_RANDOM_SCENE_H
#define CAPSTAN_TEST_RANDOM_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "capstan/evolve.h"

enum {
    SCENE_LINES = 4,
    SCENE_POINTS = 6,
    SCENE_ELEMENTS = 60,
    SCENE_STAGES = 20,
    SCENE_EA_CLASSES = 12,
    SCENE_OBSTACLES = 2,
    SCENE_SECTIONS_MOST = 4,
    SCENE_POINT_WEIGHTS_MOST = 3,
    SCENE_ROWS_MOST = 6
};

/* What a class is about; ea_0 ... ea_11 come first: EA / T from 10^k to 10^(k + 1). */
#define SCENE_CLASS_LIST(X)                                                                        \
    X(SCENE_INEXTENSIBLE, "inextensible")                                                          \
    X(SCENE_SLOPE, "slope")             /* plane tilted up to and beyond the friction angle */     \
    X(SCENE_SLACK, "slack")             /* parts without tension */                                \
    X(SCENE_FULLY_SLACK, "fully_slack") /* no tension at the end of a step */                      \
    X(SCENE_LONG_HISTORY, "long_history")                                                          \
    X(SCENE_IMPOSED, "imposed_ends")                                                               \
    X(SCENE_NEAR_FULL, "near_full_length") /* inextensible, 1e-9 to 1e-3 short of straight */      \
    X(SCENE_GRADED, "graded")              /* element lengths 1 to 1e4 */                          \
    X(SCENE_FEW, "few_elements")           /* 1 to 3 */                                            \
    X(SCENE_SEVERAL, "several_lines")                                                              \
    X(SCENE_HANGING, "hanging") /* no obstacle */                                                  \
    X(SCENE_INFEASIBLE, "infeasible")                                                              \
    X(SCENE_UNBOUNDED, "unbounded")                                                                \
    X(SCENE_TAUT, "taut")                                                                          \
    X(SCENE_CONSISTENT, "consistent") /* common, slope, imposed or history, consistent friction */ \
    X(SCENE_CYLINDER, "cylinder")     /* consistent from here on; round it, pulled at the end */   \
    X(SCENE_PIPE, "pipe")             /* over a lying cylinder, the ends moved about */            \
    X(SCENE_SPHERE, "sphere")         /* along a circle on a ball */                               \
    X(SCENE_TWO, "two_obstacles")     /* a bed and a pipe or ball on it */                         \
    X(SCENE_DRUM, "drum")             /* a cylinder that turns under the line */                   \
    X(SCENE_ELLIPSE, "ellipse")       /* on a plane, axial and lateral friction along the line */  \
    X(SCENE_BOX, "box")                                                                            \
    X(SCENE_GRAIN, "grain")          /* on a plane, coefficients in directions of the plane */     \
    X(SCENE_WINCH, "winch")          /* a drum with a force on both ends: nothing is held */       \
    X(SCENE_WILD, "wild_directions") /* on a plane, steps so large that its direction turns */     \
    X(SCENE_SECTIONS, "sections")    /* any with sections, point weights and buoys */              \
    X(SCENE_TABLES, "tables")        /* likewise, elastic, with tables of strain and tension */

enum {
    SCENE_BEFORE_FIRST = SCENE_EA_CLASSES - 1,
#define SCENE_CLASS_ENUM(name, text) name,
    SCENE_CLASS_LIST(SCENE_CLASS_ENUM)
#undef SCENE_CLASS_ENUM
        SCENE_CLASSES
};

/* A scene and the arrays it points into; must not be moved after random_scene_make. */
typedef struct RandomScene {
    CpsScene scene;
    CpsOutcome expected; /* of the last step; those before are solved */
    CpsObstacle obstacle[SCENE_OBSTACLES];
    CpsLine line[SCENE_LINES];
    char line_name[SCENE_LINES][8], stage_name[SCENE_STAGES][8];
    double point[SCENE_LINES][3 * SCENE_POINTS], element_length[SCENE_LINES][SCENE_ELEMENTS];
    CpsStage stage[SCENE_STAGES];
    CpsChange change[SCENE_STAGES][2 * SCENE_LINES];
    CpsTurn turn[SCENE_STAGES][1];
    CpsSection section[SCENE_LINES][SCENE_SECTIONS_MOST];
    CpsPointWeight point_weight[SCENE_LINES][SCENE_POINT_WEIGHTS_MOST];
    CpsStiffnessRow row[SCENE_LINES][SCENE_SECTIONS_MOST][SCENE_ROWS_MOST];
} RandomScene;

const char *random_scene_class_name(int class_index);
void random_scene_make(int class_index, uint64_t seed, RandomScene *out);

/* Which scenes a program takes: number k is of class k modulo SCENE_CLASSES and has seed + k. */
typedef struct RandomSceneRange {
    int count;
    uint64_t seed;
} RandomSceneRange;

/* The range that the arguments `--scenes COUNT --seed SEED` give; 200 and 1 without them. */
RandomSceneRange random_scene_range(int argc, char **argv);

#endif
