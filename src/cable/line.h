/* SPDX-License-Identifier: BSD-3-Clause */
/* One line and its last step: the data that a step reads and the fields that it leaves. World axes,
 * SI units.
 *
 * A node touches up to `contacts` obstacles at once. What belongs to a contact stands in arrays
 * (contacts, n): contact c is the first of node c, or the second of node c - n. Where there are
 * round obstacles, and contact is not strict, elements touch as well: contact contacts n + e is
 * that of element e, at the point of it that was nearest to the axis or centre. */
#ifndef CAPSTAN_SRC_CABLE_LINE_H
#define CAPSTAN_SRC_CABLE_LINE_H

#include <stdbool.h>

#include "base/arena.h"
#include "cable/anderson.h"
#include "cable/friction_set.h"
#include "capstan/evolve.h"
#include "geometry/obstacle.h"

typedef struct CpsiFrictionLaw CpsiFrictionLaw; /* friction_law.h */

typedef struct CpsiLine {
    const char *name;
    int n;                   /* nodes, elements + 1 */
    double length;           /* [m] natural */
    double compliance;       /* [1/N] 1/EA, 0: inextensible */
    double weight[3];        /* [N/m] per natural length */
    double weight_before[3]; /* [N/m] where the part of the step began */
    int obstacle_count;
    const CpsiObstacle *obstacle;               /* (obstacle_count) */
    const CpsiFrictionSet *const *friction_set; /* (obstacle_count) of those that have one, NULL: no
                                                   friction; NULL: none has */
    const double *turn;   /* (obstacle_count) [rad] by which each turns in this part of the step */
    bool has_zones;       /* friction differs along the line */
    bool has_local_axes;  /* nodes have axes of their own, which follow them: more than one plane
                      with  isotropic friction */
    int contacts;         /* of a node: 2 where there is more than one obstacle, else 1 */
    int element_contacts; /* of an element: 1 where there is a round obstacle, else 0; the arrays
                             (contacts, n) have so many rows more */
    double common[9];     /* axes of the whole line: those of the one plane, or of the world */
    CpsEnd end[2];        /* imposed now */
    double *arc_length;   /* (n) [m] */
    double *element_length; /* (n - 1) [m] element e joins nodes e and e + 1 */
    /* the step */
    double *reference; /* (n, 3) [m] */
    double *position;  /* (n, 3) [m] */
    double *load;      /* (n, 3) [N] */
    double *normal;    /* (contacts, n, 3) */
    double *gap; /* (contacts, n) [m] n.u >= -gap, u from the reference; INFINITY: no contact looked
                    for */
    double *friction_factor;       /* (n) of the obstacles' coefficients; NULL: 1 */
    CpsiFrictionLaw *friction_law; /* (contacts, n) of the obstacle that each contact is with */
    double *friction_bound;        /* (contacts, n) [N] */
    double *friction_force;        /* (contacts, n, 3) [N] */
    double *reaction;              /* (contacts, n) [N] */
    double *segment_force;         /* (n - 1, 3) [N] */
    double *tension;               /* (n - 1) [N] */
    double *motion;                /* (n, 3) [-] of a line that slides without end, else 0 */
    unsigned char *state;          /* (contacts, n) CpsNodeState */
    /* where `follows`, else NULL: what each node sees of the obstacles, from its place `base` */
    double
        *slide; /* (contacts, n, 3) [m] way of the node on the obstacle in this step, tangential */
    /* (contacts, n) [rad] by which the node has gone round the contact's obstacle in this step: on
     * a cylinder the sum over the rounds, which may exceed a turn; on a ball the angle of the great
     * circle */
    double *round;
    double *base;       /* (n, 3) [m] */
    double *axes;       /* (contacts, n, 9) rows first tangent, second tangent, normal */
    double *first_axes; /* (contacts, n, 9) the same at the reference: those of frozen friction */
    double *curvature;  /* (contacts, n, 3) [1/m] xx, xy, yy of the surface in these axes */
    int *on; /* (contacts, n) the nearest obstacle, and the next; of an element the one that it is
                kept out of; -1: none */
    double *beta; /* (n) where on its way from node e to e + 1 element e touches; NULL without such
                     contacts */
    double *carries; /* (n) [N] reactions that act on the node, also by its elements */
    bool *pressed;   /* (contacts, n) in the last solution: of reaction and distance, it is the
                        reaction that is not 0 */
    bool gains;      /* contact is looked for everywhere */
    bool frozen; /* friction keeps the bounds and axes of the reference while contact is looked for
                    where the nodes are */
    double *trail;         /* (n, 3) [m] where rounds with drag began to be watched */
    CpsiAnderson anderson; /* of the rounds of a step */
    /* where it is inextensible, else NULL: what its tensions and reactions were before the step,
     * and room to choose among those after */
    double *tension_before;  /* (n - 1) [N] T_R */
    double *reaction_before; /* (contacts, n) [N] */
    int *on_before;          /* (contacts, n) where `follows`, as `on` */
    struct CpsiForceSet *forces;
    bool tight; /* taut and stuck only where the places say so to rounding: else what was chosen
                   could not be certified */
    CpsLineReport report;
} CpsiLine;

/* Place the arrays of a line of line->n nodes in the arena; line->follows, line->contacts,
 * line->has_zones and line->compliance are set. */
void cpsi_line_layout(CpsiLine *line, CpsiArena *arena);

/* Fill the arc length from element_length. */
void cpsi_line_set_arc_length(CpsiLine *line);

/* [m] Natural length that node j stands for: half of its elements. */
static inline double cpsi_line_share(const CpsiLine *line, int j) {
    const double before = j > 0 ? line->element_length[j - 1] : 0;
    const double after = j + 1 < line->n ? line->element_length[j] : 0;
    return 0.5 * (before + after);
}

/* Contacts of all nodes, and the node of one. */
static inline int cpsi_line_contacts(const CpsiLine *line) { return line->contacts * line->n; }
static inline int cpsi_line_node(const CpsiLine *line, int c) {
    return c < line->n ? c : c - line->n;
}

/* Those of the elements with them; the element of a contact, -1 of a node's. */
static inline int cpsi_line_all_contacts(const CpsiLine *line) {
    return (line->contacts + line->element_contacts) * line->n;
}
static inline int cpsi_line_element(const CpsiLine *line, int c) {
    return c < cpsi_line_contacts(line) ? -1 : c - cpsi_line_contacts(line);
}

/* How much a contact of element e acts on its node j. */
static inline double cpsi_line_part(const CpsiLine *line, int e, int j) {
    return j == e ? 1 - line->beta[e] : line->beta[e];
}

/* The place x (n, 3) of contact c: of its node, or of the point of its element. */
static inline Vec3 cpsi_line_place(const CpsiLine *line, const double *x, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return vec3_load(&x[3 * cpsi_line_node(line, c)]);
    const Vec3 a = vec3_load(&x[3 * e]), b = vec3_load(&x[3 * (e + 1)]);
    return vec3_axpy(line->beta[e], vec3_sub(b, a), a);
}

/* [m] Natural length that contact c stands for. */
static inline double cpsi_line_contact_share(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? cpsi_line_share(line, cpsi_line_node(line, c)) : line->element_length[e];
}

/* Is node j an end that is held? */
static inline bool cpsi_line_is_held(const CpsiLine *line, int j) {
    return (j == 0 && line->end[CPS_END_A].kind == CPS_END_HELD) ||
           (j == line->n - 1 && line->end[CPS_END_B].kind == CPS_END_HELD);
}

/* Is what touches at contact c held? */
static inline bool cpsi_line_is_contact_held(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return cpsi_line_is_held(line, cpsi_line_node(line, c));
    return cpsi_line_is_held(line, e) && cpsi_line_is_held(line, e + 1);
}

/* The obstacle of contact c, or NULL; the axes of its friction. */
static inline const CpsiObstacle *cpsi_line_obstacle(const CpsiLine *line, int c) {
    if (line->has_local_axes) return line->on[c] >= 0 ? &line->obstacle[line->on[c]] : NULL;
    return line->obstacle_count > 0 ? line->obstacle : NULL;
}

static inline const double *cpsi_line_axes(const CpsiLine *line, int c) {
    if (line->frozen) return &line->first_axes[9 * c];
    return line->has_local_axes ? &line->axes[9 * c] : line->common;
}

/* The normal of the plane in which contact c rubs: that of the contact, but where friction is
 * frozen that of the reference. */
static inline Vec3 cpsi_line_friction_normal(const CpsiLine *line, int c) {
    return vec3_load(line->frozen ? &line->first_axes[9 * c + 6] : &line->normal[3 * c]);
}

/* [m] The way of the node on the obstacle of contact c in this step. */
static inline Vec3 cpsi_line_slide(const CpsiLine *line, int c) {
    if (line->has_local_axes) return vec3_load(&line->slide[3 * c]);
    const Vec3 u = vec3_sub(vec3_load(&line->position[3 * c]), vec3_load(&line->reference[3 * c]));
    const Vec3 n = vec3_load(&line->normal[3 * c]);
    return vec3_axpy(-vec3_dot(u, n), n, u);
}

/* [m] The longest way of a node from place `from` (n, 3) to where it is. */
double cpsi_line_largest_displacement(const CpsiLine *line, const double *from);

/* The obstacle nearest to a point (-1: none) and the distance to it (INFINITY). */
int cpsi_line_nearest(const CpsiLine *line, Vec3 x, double *gap);

/* [m] How deep an element lies in a round obstacle, beyond what its chord may cut in
 * (cpsi_obstacle_allowance), at `position`: the worst of all, and which obstacle that is; 0 and -1
 * where there is none. */
double cpsi_line_pierces(const CpsiLine *line, int *obstacle);

/* The reaction at a start that is given as a shape: R = -(dT/da + w).n where it touches, T from its
 * own strain (S90 section 2 d 2). Sets reaction and state at `position`; `touch` [m] is how near
 * counts as touching. */
void cpsi_line_start_reaction(CpsiLine *line, double touch);

#endif
