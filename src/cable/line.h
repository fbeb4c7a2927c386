/* SPDX-License-Identifier: BSD-3-Clause */
/* One line and its last step: what a step reads and the fields that it leaves. World axes, SI. A
 * node touches up to `contacts` obstacles at once. The data of contacts are in arrays (contacts,
 * n): contact c < n is the first contact of node c, contact n <= c < 2 n is the second contact of
 * node c - n. Where there are round obstacles, or more than two, and contact is not that of the
 * reference, elements touch as well: the contact of element e has the number `contacts` * n + e, at
 * its point nearest to the axis or centre; with a plane or a mesh it is the third of node e + 1. */
#ifndef CAPSTAN_SRC_CABLE_LINE_H
#define CAPSTAN_SRC_CABLE_LINE_H

#include <stdbool.h>

#include "base/arena.h"
#include "base/element_law.h"
#include "cable/anderson.h"
#include "cable/drums.h"
#include "cable/elasticity.h"
#include "cable/end_ground.h"
#include "cable/friction_law.h"
#include "cable/in_set.h"
#include "cable/inertia.h"
#include "cable/load_change.h"
#include "cable/node_field.h"
#include "capstan/step.h"
#include "geometry/obstacle.h"

typedef struct CpsiLine {
    const char *name;
    int n;                   /* nodes, elements + 1 */
    double length;           /* [m] natural */
    double compliance;       /* [1/N] 1/EA without tension, 0: inextensible */
    double weight[3];        /* [N/m] per natural length; of a line of sections its scale */
    double weight_before[3]; /* [N/m] at the beginning of the substep */
    int obstacle_count;
    const CpsiObstacle *obstacle; /* (obstacle_count) */
    const CpsiFrictionSet *const
        *friction_set; /* (obstacle_count) general; an entry NULL: {0} or none; NULL: all are */
    double *turn;      /* (obstacle_count) [rad] by which each turns in this substep, and */
    CpsiShift *shift;  /* how each has been shifted in it */
    bool has_zones, has_inertia; /* friction differs along it; it may move in time */
    bool has_field, has_node_loads, has_potential; /* the arrays of `field` are there */
    bool has_sections; /* weight and compliance may, and there may be point masses */
    bool has_breaking_load, has_break_at; /* an element has one */
    bool has_local_axes, has_folds;       /* contacts have their own axes; an obstacle has folds */
    int contacts;          /* of a node: 2 with folds or more than one obstacle, else 1 */
    int element_contacts;  /* of an element, 0 or 1: so many more rows have arrays (contacts, n) */
    double bearing_width;  /* [m] on what gives */
    double common_axes[9]; /* axes of the whole line: those of the one plane, or of the world */
    CpsEnd end[2], end_before[2]; /* imposed now, and at the beginning of the substep */
    CpsiEndSet on[2];             /* that free ends are held to */
    CpsiDrums drums;              /* what is on winches at the ends */
    bool is_at_point[2]; /* held at a point, which bears what obstacles do to the half element */
    CpsiEndGround ground[2];          /* under it */
    double *arc_length;               /* (n) [m] */
    double *element_length;           /* (n - 1) [m] at rest, element e joins nodes e and e + 1 */
    double *natural_length;           /* (n - 1) the same, but for `two` and internal damping */
    double *breaking_load, *break_at; /* (n - 1) [N] INFINITY: none; NULL: none anywhere */
    /* of element e over `weight` and `compliance` at T = 0; NULL: no sections or point masses */
    double *weight_factor, *compliance_factor; /* (n - 1) */
    /* springs beside the elements (base/element_law.h), spring_at[e]..spring_at[e + 1] - 1 of e */
    int spring_count;         /* 0: none, and the arrays are NULL */
    double spring_compliance; /* [1/N] `compliance` as given, not as statics use it */
    CpsiTwoStiffnesses two;
    int *spring_at, *spring_element;         /* (n), (spring_count) */
    double *spring_start, *spring_stiffness; /* (spring_count) [-], [N] */
    double *weight_length; /* (n) [m] of `weight` that the node carries, with its point masses */
    const struct CpsiJoined
        *joined; /* (line_solve.h) its part of a solution to be taken; or NULL */
    int grasp_count;
    CpsGrasp grasp[CPS_MAX_GRASPS]; /* nodes between the ends that are held or pulled, in order */
    CpsEnd grasp_before[CPS_MAX_GRASPS]; /* imposed on them at the beginning of the substep */
    CpsEnd grasp_from[CPS_MAX_GRASPS];   /* ... and of the stage */
    CpsiLoadChange last_change; /* in the last substep; known where position - reference moves */
    CpsiNewtonRecord newton;
    /* the step */
    double *reference;    /* (n, 3) [m] */
    double *position;     /* (n, 3) [m] */
    double start_end[3];  /* [m] of end A at the start of the history */
    float *start_element; /* (n - 1, 3) [m] the elements there, as vectors to the next node */
    double *load;         /* (n, 3) [N] */
    CpsiNodeField field;
    double *normal; /* (contacts, n, 3) */
    double *gap;    /* (contacts, n) [m] n.u >= -gap from the reference; INFINITY: not looked for */
    double *friction_factor;       /* (n) of the obstacles' coefficients; NULL: 1 */
    CpsiFrictionLaw *friction_law; /* (contacts, n) of the obstacle that each contact is with */
    double *friction_bound;        /* (contacts, n) [N] with the larger coefficient */
    double *friction_force;        /* (contacts, n, 3) [N] */
    double *reaction;              /* (contacts, n) [N] */
    double *segment_force;         /* (n - 1, 3) [N] */
    double *tension;               /* (n - 1) [N] */
    double *motion;                /* (n, 3) [-] of a line that slides without end, else 0 */
    unsigned char *state;          /* (contacts, n) CpsNodeState */
    /* (contacts, n, 3) [m] slip of the node on the obstacle in this step, tangential; without
     * has_local_axes computed after the step, for views */
    double *slip;
    bool *active;   /* (contacts, n) the last solution's reaction, without unit, exceeds its gap */
    bool *at_bound; /* (contacts, n) friction is at its bound in it (warm_step.h) */
    /* with has_local_axes, else NULL: the geometry of the contacts at `base` */
    /* (contacts, n) [rad] by which the node has moved round the obstacle in this step: on a ball
     * that of the great circle, on a cylinder the sum over the rounds, perhaps beyond a turn */
    double *winding;
    double *base;           /* (n, 3) [m] */
    double *axes;           /* (contacts, n, 9) rows first tangent, second tangent, normal */
    double *reference_axes; /* (contacts, n, 9) at the reference: those of frozen friction */
    double *curvature;      /* (contacts, n, 3) [1/m] xx, xy, yy of the surface in these axes */
    int *obstacle_index; /* (contacts, n) the obstacle of each contact: the nearest and the next; of
                            an element the one with which it is in contact; -1: none */
    int *face;    /* (contacts, n) with has_folds: of each contact, in a step (geometry/folds.h) */
    double *beta; /* (n) share of element e at which it touches; NULL without such contacts */
    double *node_reaction;     /* (n) [N] sum of the reactions on the node and on its elements */
    bool is_rough;             /* the program was solved to a hundredth of the tolerance only */
    bool contact_everywhere;   /* contacts are not only detected where the reference touches */
    bool keeps_reference_axes; /* ... but friction has its axes there, frozen; not on one plane */
    bool strayed;              /* only rounds with drag found the answer (line_step.c) */
    bool keeps_tangents;       /* the first ones of isotropic friction are those of the reference */
    double *watched; /* (2 n, 3) [m] from which the progress of rounds with drag is measured */
    CpsiAnderson anderson; /* of the rounds of a step */
    /* where the line is inextensible, else NULL: its tensions and reactions before the step, and
     * scratch memory for the choice among those after it */
    double *tension_before;     /* (n - 1) [N] T_R */
    double *reaction_before;    /* (contacts, n) [N] */
    int *obstacle_index_before; /* (contacts, n) with has_local_axes, as obstacle_index */
    struct CpsiForceSet *forces;
    bool exact; /* segments are taut and contacts stick only where positions show it to rounding */
    CpsiInertia inertia; /* with has_inertia */
    CpsLineReport report;
} CpsiLine;

/* Place the arrays of a line in the arena; its number of nodes, its flags, line->contacts,
 * line->element_contacts, line->spring_count and line->compliance are set. */
void cpsi_line_layout(CpsiLine *line, CpsiArena *arena);

/* Fill the arc length from element_length. */
void cpsi_line_set_arc_length(CpsiLine *line);

/* The node of an end: the last one on the drum of a winch, at which the line leaves it. */
static inline int cpsi_line_end_node(const CpsiLine *line, int end) {
    return end == CPS_END_A ? line->drums.nodes[0] : line->n - 1 - line->drums.nodes[1];
}

/* [m] Natural length that node j represents: half of its elements. */
static inline double cpsi_line_share(const CpsiLine *line, int j) {
    const double before = j > line->drums.nodes[0] ? line->natural_length[j - 1] : 0;
    const double after = j < cpsi_line_end_node(line, 1) ? line->natural_length[j] : 0;
    return 0.5 * (before + after);
}

/* [m] Natural length of line->weight that node j carries: its own, with what hangs on it. */
static inline double cpsi_line_weight_length(const CpsiLine *line, int j) {
    return line->weight_length ? line->weight_length[j] : cpsi_line_share(line, j);
}

/* [N/m] Weight per natural length of element e; and at node j, the mean of its two halves. */
static inline Vec3 cpsi_line_weight(const CpsiLine *line, int e) {
    const double factor = line->weight_factor ? line->weight_factor[e] : 1;
    return vec3_scale(factor, vec3_load(line->weight));
}
static inline Vec3 cpsi_line_weight_at(const CpsiLine *line, int j) {
    if (!line->weight_factor) return vec3_load(line->weight);
    double sum = 0;
    if (j > line->drums.nodes[0])
        sum += 0.5 * line->natural_length[j - 1] * line->weight_factor[j - 1];
    if (j < cpsi_line_end_node(line, 1))
        sum += 0.5 * line->natural_length[j] * line->weight_factor[j];
    return vec3_scale(sum / cpsi_line_share(line, j), vec3_load(line->weight));
}

/* [1/N] 1/EA of element e, without tension. */
static inline double cpsi_line_compliance(const CpsiLine *line, int e) {
    return line->compliance_factor ? line->compliance * line->compliance_factor[e]
                                   : line->compliance;
}
/* The law of element e of an elastic line; with springs it is not in line. */
CpsiElementLaw cpsi_line_spring_law(const CpsiLine *line, int e);
static inline CpsiElementLaw cpsi_line_law(const CpsiLine *line, int e) {
    if (line->spring_count > 0) return cpsi_line_spring_law(line, e);
    return (CpsiElementLaw){.compliance = cpsi_line_compliance(line, e)};
}
int cpsi_line_most_springs(const CpsiLine *line);        /* of either of its stiffnesses */
double cpsi_line_least_compliance(const CpsiLine *line); /* [1/N] of all, at any tension */

/* The number of contacts of all nodes, and the node of one. */
static inline int cpsi_line_contacts(const CpsiLine *line) { return line->contacts * line->n; }
static inline int cpsi_line_node(const CpsiLine *line, int c) {
    return c < line->n ? c : c - line->n;
}

/* The number of all contacts, those of elements included; the element of a contact, -1 for that of
 * a node. */
static inline int cpsi_line_all_contacts(const CpsiLine *line) {
    return (line->contacts + line->element_contacts) * line->n;
}
static inline int cpsi_line_element(const CpsiLine *line, int c) {
    return c < cpsi_line_contacts(line) ? -1 : c - cpsi_line_contacts(line);
}

/* Is c the third contact of a node, at the end of its element? */
static inline bool cpsi_line_is_third(const CpsiLine *line, int c) {
    return c >= cpsi_line_contacts(line) && line->obstacle_index[c] >= 0 &&
           cpsi_obstacle_may_be_third(&line->obstacle[line->obstacle_index[c]]);
}

/* Share of the force of a contact of element e that acts on its node j. */
static inline double cpsi_line_part(const CpsiLine *line, int e, int j) {
    return j == e ? 1 - line->beta[e] : line->beta[e];
}

/* The position of contact c in the positions x (n, 3): of its node, or of the point of its
 * element. */
static inline Vec3 cpsi_line_place(const CpsiLine *line, const double *x, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return vec3_load(&x[3 * cpsi_line_node(line, c)]);
    const Vec3 a = vec3_at(x, e), b = vec3_at(x, e + 1);
    return vec3_axpy(line->beta[e], vec3_sub(b, a), a);
}

/* [m] Natural length that contact c represents. */
static inline double cpsi_line_contact_share(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? cpsi_line_share(line, cpsi_line_node(line, c)) : line->natural_length[e];
}

/* Is node j between the ends held by a grasp? Is it held, as an end, on a drum or by a grasp? */
bool cpsi_line_grasp_holds(const CpsiLine *line, int j);
static inline bool cpsi_line_is_held(const CpsiLine *line, int j) {
    return (j <= line->drums.nodes[0] && line->end[CPS_END_A].kind == CPS_END_KIND_HELD) ||
           (j >= cpsi_line_end_node(line, 1) && line->end[CPS_END_B].kind == CPS_END_KIND_HELD) ||
           (line->grasp_count > 0 && cpsi_line_grasp_holds(line, j));
}

/* Is the node, or the whole element, of contact c held? */
static inline bool cpsi_line_is_contact_held(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return cpsi_line_is_held(line, cpsi_line_node(line, c));
    return cpsi_line_is_held(line, e) && cpsi_line_is_held(line, e + 1);
}

/* The obstacle of contact c, or NULL; the axes of its friction. */
static inline const CpsiObstacle *cpsi_line_obstacle(const CpsiLine *line, int c) {
    if (line->has_local_axes)
        return line->obstacle_index[c] >= 0 ? &line->obstacle[line->obstacle_index[c]] : NULL;
    return line->obstacle_count > 0 ? line->obstacle : NULL;
}

static inline const double *cpsi_line_axes(const CpsiLine *line, int c) {
    if (line->keeps_reference_axes) return &line->reference_axes[9 * c];
    return line->has_local_axes ? &line->axes[9 * c] : line->common_axes;
}

/* The normal of the plane of friction of contact c: that of the contact, or of the reference
 * where the line keeps that. */
static inline Vec3 cpsi_line_friction_normal(const CpsiLine *line, int c) {
    return vec3_load(line->keeps_reference_axes ? &line->reference_axes[9 * c + 6]
                                                : &line->normal[3 * c]);
}

/* [m] The slip of contact c on its obstacle in this step. */
static inline Vec3 cpsi_line_slip(const CpsiLine *line, int c) {
    if (line->has_local_axes) return vec3_at(line->slip, c);
    const Vec3 u = vec3_sub(vec3_at(line->position, c), vec3_at(line->reference, c));
    const Vec3 n = vec3_at(line->normal, c);
    return vec3_reject(u, n);
}

/* Is obstacle k shifted in this substep? */
static inline bool cpsi_line_is_shifted(const CpsiLine *line, int k) {
    return !cpsi_shift_is_none(&line->shift[k]);
}

/* [m] ... and in the axes of the contact. */
void cpsi_line_local_slip(const CpsiLine *line, int c, double slip[3]);

/* [m] The largest displacement of a node from the positions `from` (n, 3). */
double cpsi_line_largest_displacement(const CpsiLine *line, const double *from);

/* The obstacle nearest to a point (CPS_NO_OBSTACLE: none) and the distance to it (INFINITY); among
 * all, or among those that are rigid. */
int cpsi_line_nearest(const CpsiLine *line, Vec3 x, double *gap);
int cpsi_line_nearest_rigid(const CpsiLine *line, Vec3 x, double *gap);

/* [m] The largest penetration of an element into a round obstacle at `position`, beyond the
 * allowance of its chord (cpsi_obstacle_allowance), and that obstacle; 0, and *obstacle as it
 * was, where there is none. */
double cpsi_line_pierces(const CpsiLine *line, int *obstacle);

/* The reaction at an initial configuration given as a shape: R = -(dT/da + w).n where it touches, T
 * from its own strain (S90 section 2 d 2). Sets reaction and state at `position`; nodes nearer than
 * `touch` [m] touch. */
void cpsi_line_start_reaction(CpsiLine *line, double touch);
/* ... and the force of the line on what holds an end of it there. */
Vec3 cpsi_line_start_pull(const CpsiLine *line, int end);

/* The law of contact c of a line, by the obstacle that it is with and its place on the line. */
CpsiFrictionLaw cpsi_line_friction_law(const CpsiLine *line, int c);

/* Lay out line->friction_law, the law of every contact: when contacts have been detected or moved
 * along the line, once per round. */
void cpsi_line_lay_out_friction(CpsiLine *line);

#endif
