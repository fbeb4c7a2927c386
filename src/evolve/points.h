/* SPDX-License-Identifier: BSD-3-Clause */
/* Points where lines meet (capstan/point.h): their data, their check, and what a step imposes on
 * them. The places of free ones are found by balance.c. */
#ifndef CAPSTAN_SRC_EVOLVE_POINTS_H
#define CAPSTAN_SRC_EVOLVE_POINTS_H

#include "base/arena.h"
#include "base/vec3.h"
#include "cable/in_set.h"
#include "capstan/evolve.h"
#include "evolve/bodies.h"
#include "evolve/joint_inertia.h"
#include "evolve/ties.h"

/* What the ends at a point press on it after a step, along the normal of what it touches. */
typedef struct CpsiPressed {
    double weight; /* [N] of their half elements and of the point */
    double force;  /* [N] of the ends that press; others pull */
    double on,
        off; /* [m] half elements of lines that touch the obstacle beside the point, or not */
} CpsiPressed;

/* The surface of the water about a point in a step: a place x is at the height n.(x - at) above it
 * (water.h). */
typedef struct CpsiSurface {
    Vec3 at, n;
} CpsiSurface;

/* A point; positions are relative to the origin of the evolution. */
typedef struct CpsiPoint {
    const char *name;
    CpsPointKind kind;      /* now */
    double position[3];     /* [m] now */
    double force[3];        /* [N] on it while it is free, beside its weight */
    double from[3];         /* [m] or [N] what the stage under way changes, when it began */
    double before[3];       /* [m] the place where the step began */
    double move[3];         /* [m] of the last step */
    double reaction_before; /* [N] on it where the step began */
    bool is_moving;         /* the step under way goes on as the last one did */
    double mass;            /* [kg] weight per gravity, in air where it may leave the water */
    double dragged;         /* [m] as an anchor, since the start */
    double displaced_mass;  /* [kg] of water; 0 where it cannot leave the water */
    double extent;          /* [m] of the float, upwards */
    CpsiSurface surface;    /* of the last step, or of the one under way */
    double height_before;   /* [m] above that of the step before, where the step began */
    double length;          /* [m] of the longest line that ends here */
    double area;            /* [m2] with which it bears on what gives, in the step (soft_point.h) */
    CpsiEndSet on;          /* the set that it is held to as a free one */
    CpsPointReport report;  /* its position relative to the origin */
    CpsiPressed pressed;
    CpsiPointInertia inertia;
} CpsiPoint;

/* Memory of the search for the places of free points. */
typedef struct CpsiBalance CpsiBalance;

typedef struct CpsiPoints {
    int count;
    CpsiPoint *point;     /* (count) */
    CpsPoint *given;      /* (count) names and kinds, against which stages are checked */
    int *tie;             /* (lines, 2) the point of an end now, or CPSI_NO_POINT */
    int *tie_given;       /* ... and in the scene */
    int *group;           /* (count) first point of a free one's group, else CPSI_NO_POINT */
    CpsiBalance *balance; /* NULL: no point is ever free */
    bool has_surface;
    double surface; /* [m] z of the water's surface */
} CpsiPoints;

/* The surface of water at rest. */
static inline CpsiSurface cpsi_surface_at_rest(const CpsiPoints *points) {
    return (CpsiSurface){vec3(0, 0, points->surface), vec3(0, 0, 1)};
}

/* Check the points, and which ends are at which. */
CpsStatus cpsi_points_check(const CpsScene *scene, CpsError *err);
/* ... and what a stage changes at them. */
CpsStatus cpsi_point_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                   CpsError *err);

/* [m] Where a point of the scene begins. */
Vec3 cpsi_point_begin(const CpsScene *scene, int index);

/* The scene in which every end at a point is held where the point begins. Its lines lie in `block`,
 * to be freed by the caller; NULL where no end is at a point. Returns CPS_OK or CPS_ERR_MEMORY. */
typedef struct CpsiHeldScene {
    CpsScene scene;
    void *block;
} CpsiHeldScene;
CpsStatus cpsi_held_scene(const CpsScene *scene, CpsiHeldScene *out, CpsError *err);

/* Place the arrays; `scene` may have ends at points. */
void cpsi_points_layout(CpsiPoints *points, CpsiArena *arena, const CpsScene *scene);
/* Fill them but for names; positions are those of `local`, relative to the origin. */
void cpsi_points_fill(CpsiPoints *points, const CpsScene *scene, const CpsScene *local);

/* Find the groups: free points that lines connect, also by way of other free ones, are one. Groups
 * have nothing to do with each other in a step, and their forces may differ by any factor. */
void cpsi_points_group(CpsiPoints *points, const CpsiBodies *bodies, int lines);

/* The first point of the group of a point, `group` (points) a way towards it of each point that is
 * in any, else CPSI_NO_POINT. And: make the groups of two points one, where both are in any. */
int cpsi_group_first(int *group, int point);
void cpsi_group_unite(int *group, int a, int b);

/* The group that a line is at, or CPSI_NO_POINT. */
static inline int cpsi_group_of_line(const CpsiPoints *points, int line) {
    for (int end = 0; end < 2; end++) {
        const int point = points->tie[2 * line + end];
        if (point != CPSI_NO_POINT && points->group[point] != CPSI_NO_POINT)
            return points->group[point];
    }
    return CPSI_NO_POINT;
}

/* The set that holds a point, which is free; else NULL. */
static inline CpsiEndSet *cpsi_set_of_point(const CpsiPoints *points, int point) {
    CpsiPoint *of = &points->point[point];
    return of->on.is_there && of->kind == CPS_POINT_KIND_FREE ? &of->on : NULL;
}

/* Is it held, and an anchor that drags? */
static inline bool cpsi_point_drags(const CpsiPoints *points, int point) {
    return points->given[point].drags && points->point[point].kind == CPS_POINT_KIND_HELD;
}

/* [N] Weight and force on a free point; without a buoyancy that depends on its place. */
static inline void cpsi_point_load(const CpsiPoint *point, const double gravity[3],
                                   double load[3]) {
    for (int a = 0; a < 3; a++) load[a] = point->force[a] + point->mass * gravity[a];
}

#endif
