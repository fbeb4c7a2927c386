/* SPDX-License-Identifier: BSD-3-Clause */
/* One line and its last step: the data that a step reads and the fields that it leaves. World axes, SI units. */
#ifndef CAPSTAN_SRC_CABLE_LINE_H
#define CAPSTAN_SRC_CABLE_LINE_H

#include <stdbool.h>

#include "base/arena.h"
#include "cable/ahead.h"
#include "capstan/evolve.h"
#include "geometry/obstacle.h"

typedef struct CpsiLine {
    const char *name;
    int n;              /* nodes, elements + 1 */
    double length;      /* [m] natural */
    double compliance;  /* [1/N] 1/EA, 0: inextensible */
    double weight[3];   /* [N/m] per natural length */
    int obstacle_count;
    const CpsiObstacle *obstacle; /* (obstacle_count) */
    const double *turn; /* (obstacle_count) [rad] by which each turns in this part of the step */
    bool has_zones;     /* friction differs along the line */
    bool follows;       /* nodes have axes of their own, which follow them: more than one plane with isotropic friction */
    double common[9];   /* axes of the whole line: those of the one plane, or of the world */
    CpsEnd end[2];      /* imposed now */
    double *arc_length;      /* (n) [m] */
    double *element_length;  /* (n - 1) [m] element e joins nodes e and e + 1 */
    /* the step */
    double *reference;      /* (n, 3) [m] */
    double *position;       /* (n, 3) [m] */
    double *load;           /* (n, 3) [N] */
    double *normal;         /* (n, 3) */
    double *gap;            /* (n) [m] n.u >= -gap, u from the reference; INFINITY: no contact looked for */
    double *friction_factor; /* (n) of the obstacles' coefficients; NULL: 1 */
    double *friction_bound; /* (n) [N] */
    double *friction_force; /* (n, 3) [N] */
    double *reaction;       /* (n) [N] */
    double *segment_force;  /* (n - 1, 3) [N] */
    double *tension;        /* (n - 1) [N] */
    unsigned char *state;   /* (n) CpsNodeState */
    /* where `follows`, else NULL: what each node sees of the obstacles, from its place `base` */
    double *slide;          /* (n, 3) [m] way of the node on the obstacle in this step, tangential */
    double *base;           /* (n, 3) [m] */
    double *axes;           /* (n, 9) rows first tangent, second tangent, normal */
    double *curvature;      /* (n, 3) [1/m] xx, xy, yy of the surface in these axes */
    int *on;                /* (n) nearest obstacle, -1: none */
    CpsiAhead ahead;        /* of the rounds of a step */
    CpsLineReport report;
} CpsiLine;

/* Place the arrays of a line of line->n nodes in the arena; line->follows and line->has_zones are set. */
void cpsi_line_layout(CpsiLine *line, CpsiArena *arena);

/* Fill the arc length from element_length. */
void cpsi_line_measure(CpsiLine *line);

/* [m] Natural length that node j stands for: half of its elements. */
static inline double cpsi_line_share(const CpsiLine *line, int j) {
    const double before = j > 0 ? line->element_length[j - 1] : 0;
    const double after = j + 1 < line->n ? line->element_length[j] : 0;
    return 0.5*(before + after);
}

/* The obstacle that node j is nearest to, or NULL; the axes of contact there. */
static inline const CpsiObstacle *cpsi_line_obstacle(const CpsiLine *line, int j) {
    if (line->follows) return line->on[j] >= 0 ? &line->obstacle[line->on[j]] : NULL;
    return line->obstacle_count > 0 ? line->obstacle : NULL;
}

static inline const double *cpsi_line_axes(const CpsiLine *line, int j) {
    return line->follows ? &line->axes[9*j] : line->common;
}

/* [m] The way of node j on the obstacle in this step. */
static inline Vec3 cpsi_line_slide(const CpsiLine *line, int j) {
    if (line->follows) return vec3_load(&line->slide[3*j]);
    const Vec3 u = vec3_sub(vec3_load(&line->position[3*j]), vec3_load(&line->reference[3*j]));
    const Vec3 n = vec3_load(&line->normal[3*j]);
    return vec3_axpy(-vec3_dot(u, n), n, u);
}

/* The obstacle nearest to a point (-1: none) and the distance to it (INFINITY). */
int cpsi_line_nearest(const CpsiLine *line, Vec3 x, double *gap);

/* The reaction at a start that is given as a shape: R = -(dT/da + w).n where it touches, T from its own strain (S90 section
 * 2 d 2). Sets reaction and state at `position`; `touch` [m] is how near counts as touching. */
void cpsi_line_start_reaction(CpsiLine *line, double touch);

#endif
