/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/step.h: what a load step reports: its outcome, the certificate of its answer, the forces
 * at the ends of a line, where the energy went, and the arrays of a line. The library (evolve.h)
 * fills everything for the caller. SI units; vectors in the axes of the scene. S90 is Souza de
 * Cursi (1990), "theory" docs/theory.md.
 *
 * A load step is divided into substeps where it does not converge, where it depends on the path
 * (`path_tolerance`), and where an obstacle turns far (theory 2.9). */
#ifndef CAPSTAN_STEP_H
#define CAPSTAN_STEP_H

#include "capstan/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* That of a step is the worst of its lines' (cps_outcome_worse); the numbers are no order. */
#define CPS_OUTCOME_LIST(X)                                                                       \
    X(CPS_OUTCOME_SOLVED, 0, "solved", "solved and certified")                                    \
    X(CPS_OUTCOME_TAUT, 1, "taut",                                                                \
      "inextensible line pulled exactly straight: tension not unique")                            \
    X(CPS_OUTCOME_STALLED, 2, "stalled", "no further progress: the answer is not certified")      \
    X(CPS_OUTCOME_ITERATION_LIMIT, 3, "iteration_limit",                                          \
      "iteration limit reached: the answer is not certified")                                     \
    X(CPS_OUTCOME_UNBOUNDED, 4, "unbounded",                                                      \
      "no equilibrium: a rigid motion lowers the energy without bound")                           \
    X(CPS_OUTCOME_INFEASIBLE, 5, "infeasible",                                                    \
      "no configuration: the ends are farther apart than the line is long")                       \
    X(CPS_OUTCOME_MESH_TOO_COARSE, 6, "mesh_too_coarse",                                          \
      "mesh too coarse: one node turns the line by too much for its friction; the answer is not " \
      "certified")                                                                                \
    X(CPS_OUTCOME_SLIDES, 7, "slides",                                                            \
      "slides without end: no equilibrium at any place along its path")                           \
    X(CPS_OUTCOME_PASSES, 8, "passes",                                                            \
      "passes an obstacle: the step's equations are solved, but the answer is not certified")

typedef enum CpsOutcome {
#define CPS_OUTCOME_ENUM(name, number, key, sentence) name = number,
    CPS_OUTCOME_LIST(CPS_OUTCOME_ENUM)
#undef CPS_OUTCOME_ENUM
} CpsOutcome;

CPS_API const char *cps_outcome_name(CpsOutcome outcome);  /* "solved"; never NULL */
CPS_API const char *cps_outcome_text(CpsOutcome outcome);  /* its sentence; never NULL */
CPS_API bool cps_outcome_is_certified(CpsOutcome outcome); /* is the step's answer? */
/* Whether there is no equilibrium, with a proof in the report. It is the last step of a history. */
CPS_API bool cps_outcome_is_final(CpsOutcome outcome);
/* The worse of two outcomes, in the order from solved to infeasible. */
CPS_API CpsOutcome cps_outcome_worse(CpsOutcome a, CpsOutcome b);

/* The certificate of one line's step (theory 4): forces in equilibrium, a configuration, and the
 * gap between their energies, which bounds the error of the answer. */
typedef struct CpsCertificate {
    double primal;              /* [J] J + j, the energy at the configuration */
    double dual;                /* [J] a lower bound of the minimum, from the forces */
    double gap;                 /* [J] sum of local gaps, each >= 0; up to rounding primal - dual */
    double scale;               /* [J] S of theory (5): certified where gap <= tolerance * scale */
    double tension_bound;       /* [N] bound of the rms error of the tension, with the flag below */
    double tension_estimate;    /* [N] largest |T - |p||: elongation against equilibrium */
    double force_residual;      /* [N] largest force on a node that nothing balances */
    double largest_force;       /* [N] largest force in the line or on it */
    double law_residual;        /* [J] sum of phi(u) + <u, F> over the contacts */
    double contact_residual;    /* [J] sum of R (n.u + gap) over the contacts */
    double friction_residual;   /* [N] sum of |w - mu R|: error of frozen bounds, else rounding */
    double load_residual;       /* [N] of drag and potential used less those where they are */
    double element_push;        /* [N] largest compressive part of an element's force */
    double elongation_residual; /* [-] largest |x'| - (1 + c |p|) of an elastic element */
    double stretch_residual;    /* [-] largest |x'| - 1 of an inextensible element */
    double penetration;         /* [m] depth of the deepest node below its obstacle, >= 0 */
    double element_penetration; /* [m] >= 0, in a round obstacle, beyond min(l^2/(4 R), R/4) */
    bool has_tension_bound;     /* not inextensible, nor a bound above the tension; else it is 0 */
} CpsCertificate;

typedef enum CpsNodeState {
    CPS_NODE_STATE_FREE = 0,      /* no reaction */
    CPS_NODE_STATE_STICK = 1,     /* at rest on the obstacle */
    CPS_NODE_STATE_SLIP = 2,      /* sliding on it with friction at its bound */
    CPS_NODE_STATE_UNRESOLVED = 3 /* in contact; at rest or not (CpsSolverOptions.tolerance) */
} CpsNodeState;

/* What is known of the tensions that hold an inextensible line: they need not be unique. */
#define CPS_RANGE_LIST(X)                                                                      \
    X(CPS_RANGE_NONE, 0, "none",                                                               \
      "not asked: a step within a stage, or one without a certified answer")                   \
    X(CPS_RANGE_STRAIN, 1, "strain", "an elastic line: its strain tells the tension")          \
    X(CPS_RANGE_BOUNDED, 2, "bounded", "least and greatest tension, each with its bound")      \
    X(CPS_RANGE_UNBOUNDED, 3, "unbounded",                                                     \
      "jammed: forces that hold each other may be added in any amount, the tension with them") \
    X(CPS_RANGE_NOT_GIVEN, 4, "not_given",                                                     \
      "a set of set.h holds an end or is that of friction: not looked into")                   \
    X(CPS_RANGE_FAILED, 5, "failed", "the program of the range did not converge")

typedef enum CpsRange {
#define CPS_RANGE_ENUM(name, number, key, sentence) name = number,
    CPS_RANGE_LIST(CPS_RANGE_ENUM)
#undef CPS_RANGE_ENUM
} CpsRange;

CPS_API const char *cps_range_name(CpsRange range); /* "bounded"; never NULL */
CPS_API const char *cps_range_text(CpsRange range); /* its sentence; never NULL */

/* Least and greatest tension (theory 4a) of the element at an end, among all forces that balance
 * and obey the laws at the places found. The first of each pair is attained, the second a bound. */
typedef struct CpsTensionRange {
    CpsRange kind;
    bool has_values;                 /* the kind is bounded or unbounded; otherwise all are 0 */
    double least, least_bound;       /* [N] */
    double greatest, greatest_bound; /* [N] INFINITY where unbounded */
} CpsTensionRange;

/* Whether the forces of a step determine the places; else those of least sum h |u|^2 are taken. */
typedef enum CpsPlaces {
    CPS_PLACES_UNIQUE,
    CPS_PLACES_NEAREST, /* not unique, and the nearest is taken */
    CPS_PLACES_ANY      /* not unique, and one is taken that need not be the nearest */
} CpsPlaces;

/* The force at an end of a line. The last half element has its weight and, where a held end lies on
 * an obstacle, its own reaction and friction; so this force differs from that in the middle of the
 * end element (theory 3). Up is against gravity, or z without. */
typedef struct CpsEndReport {
    double position[3]; /* [m] in the coordinates of the scene */
    double force[3];    /* [N] on the line at this end */
    double tension;     /* [N] |force|, the tension at this end */
    double work;        /* [J] of that force in this step; the two ends' are `ends` of the ledger */
    double friction_force[3]; /* [N] on the half element beside a held end on an obstacle */
    double uplift; /* [N] vertical part of the line's force on what holds this end (docs), up > 0 */
    double angle;  /* [rad] at which the line leaves this end, above the horizontal; 0: no force */
    double suspended;      /* [m] natural length from this end to the first contact; all, if none */
    double touchdown[3];   /* [m] where the line is at that length, with the line's flag */
    CpsTensionRange range; /* of the end element, at the last step of a stage */
} CpsEndReport;

/* The contact at which the mesh changes the law of friction most: a node on a curved obstacle that
 * turns the line by d holds tensions up to the ratio k = (1 + mu tan(d/2))/(1 - mu tan(d/2)), a
 * smooth line exp(mu d). From mu tan(d/2) = 0.9 on, the step is not certified (mesh_too_coarse).
 * All are 0 where the line turns round nothing with friction. */
typedef struct CpsBend {
    double turn;       /* [rad] d, towards the obstacle */
    double friction;   /* [-] mu along the line, the larger of both directions of slip */
    double ratio;      /* [-] k; INFINITY where the node holds any ratio */
    double coulomb;    /* [-] exp(mu d) */
    double arc_length; /* [m] position along the line */
    double element;    /* [m] elements up to this length keep k within 1 % of exp(mu d) */
    int obstacle;      /* index in the scene */
} CpsBend;

/* Energy [J]: ends + obstacles + winches + loads = elastic + gravity + dissipated + imbalance. */
typedef struct CpsLedger {
    double elastic;    /* increase of the elastic energy */
    double gravity;    /* increase of the potential energy of the weight */
    double ends;       /* work of the end forces: mean of before and after, times displacement */
    double obstacles;  /* work of obstacles that turn or are shifted */
    double winches;    /* work of winches (winch.h) */
    double loads;      /* work of what acts on the nodes beside their weight */
    double dissipated; /* by friction, >= 0 */
    double imbalance;  /* of first order in the load step; large and positive in a jump */
} CpsLedger;

/* The report on one line. */
typedef struct CpsLineReport {
    CpsOutcome outcome;         /* the worst of the substeps */
    int iteration_count;        /* of all programs solved, also of substeps that were not kept */
    CpsPlaces places;           /* the least determined of the substeps */
    CpsCertificate certificate; /* of the last substep */
    double dissipated;          /* [J] in this step */
    CpsLedger ledger;           /* of this step; 0 for a line that is placed statically in it */
    int substep_count;          /* substeps kept, 1 or more */
    int warm_count; /* of these, found by Newton's method from the one before (theory 6b) */
    double share;   /* share of the step that the last substep was, which the view shows */
    int jump_count; /* substeps in which the line jumped, however small the load */
    double jump;    /* [m] longest displacement of a node in such a substep */
    /* [J] that substeps which could not be halved any more created; with a path tolerance also that
     * they lost, jumps excepted. 0 unless above 5 % of what such a substep dissipates and works. */
    double unaccounted;
    CpsEndReport end[2]; /* of ends A and B */
    double grounded;     /* [m] natural length in contact with a reaction */
    double slipping;     /* [m] natural length that slid on the obstacle in this step */
    double slack;        /* [m] natural length without tension */
    double sweep; /* [m] of what touches, aside from its place at the start, in plan (docs) */
    bool has_slipping, has_tension_mesh, has_touchdown; /* it is known; otherwise it is 0 */
    double tension_mesh;  /* [N] estimated error of the tension due to the mesh */
    bool has_utilisation; /* of a line with a breaking load; otherwise the next two are 0 */
    double utilisation;   /* [-] largest tension over it, of elements and ends */
    double utilisation_arc_length; /* [m] where that is */
    bool has_pierced_obstacle;     /* pierced_obstacle is known */
    int pierced_obstacle;          /* obstacle of the certificate's element_penetration */
    CpsBend bend;                  /* the sharpest of the substeps */
    /* The proof that there is no equilibrium, else 0 0 0. Infeasible: unit vector in which the
     * shortest path to end B leaves end A (if straight, that of a force, the proof); 0 0 0: an
     * element is too long; caught: from the centre to the gate. Unbounded: the rigid direction in
     * which the energy falls. Slides: the velocity of the leading end, of `motion` of the view. */
    double proof[3];
    /* [m] > 0, infeasible: the distance of the ends, or the least length of a line round an
     * obstacle, less the line's; or how deep an element stays in one; otherwise 0 */
    double proof_length;
    /* [N] > 0, unbounded: decrease of the energy per metre; slides: least power of the loads, less
     * all that friction can dissipate, per unit of speed; otherwise 0 */
    double proof_force;
    bool has_proof_obstacle, has_proof_plane; /* infeasible: not reached round, or caught */
    int proof_obstacle, proof_plane; /* between both, or above it; passes: the one passed */
    /* [N] unbounded with frozen friction: what Coulomb's law allows, if that is enough; else 0 */
    double coulomb;
} CpsLineReport;

/* The report on one step of all lines. */
typedef struct CpsStepReport {
    const char
        *name;      /* "static", of a stage or move, or "name k/n" in n steps; until the next one */
    int step_count; /* steps taken so far, this one included; 0 before the first one */
    CpsOutcome outcome;  /* the worst of the lines */
    int iteration_count; /* largest of the lines */
    /* energies, gap, scale, friction_residual and residuals in joules are sums over the lines, all
     * else is the largest of them; has_tension_bound where all lines have one */
    CpsCertificate certificate;
    double dissipated;             /* [J] sum of the lines and points */
    CpsLedger ledger;              /* sum of the lines; `ends` and `dissipated` with the points */
    int substep_count, warm_count; /* largest of the lines */
    int jump_count;                /* sum of the lines */
    CpsPlaces places;              /* the least determined of the lines */
    double jump, unaccounted;      /* [m] largest of the lines; [J] sum of the lines */
    double wall;                   /* [s] time taken */
} CpsStepReport;

enum { CPS_NO_OBSTACLE = -1 }; /* in an array of obstacles' indices: there is none */

/* All arrays of one line after a step or its last substep, until the next. n = element_count +
 * 1 nodes; forces act on the line. In an array over contacts entry j is the contact of node j with
 * its nearest obstacle, entry n + j its second. Beside a concave edge of a mesh both may be with
 * it. */
typedef struct CpsLineView {
    const char *name;
    int element_count;
    int contact_count; /* of a node: 2 with several obstacles, or a mesh that is not convex */
    bool one_plane;    /* one isotropic plane or none, no grasp, drum, load or mass */
    const double *arc_length;     /* (n) [m] natural, of the nodes from end A, drums included */
    const double *element_length; /* (element_count) [m]; on a drum the whole */
    double compliance; /* [1/N] 1/EA at T = 0, of sections the mean; 0 of an inextensible line */
    bool uniform;      /* without sections and point weights */
    const double *compliance_factor; /* (element_count) [-] of `compliance`; 1 where uniform */
    const double *weight_length; /* (n) [m] weight at a node over the mean one; 0 where uniform */
    int spring_count; /* of tables: T = d/c + sum K (d - s)^+, d = |x'| - 1; else 0, and NULL: */
    const int *spring_element; /* (spring_count) not falling; s [-] and K [N] of each: */
    const double *spring_strain, *spring_stiffness;
    bool has_breaking_load;      /* of some element; otherwise the array is 0 */
    const double *breaking_load; /* (element_count) [N] INFINITY of elements without one */
    CpsEnd end[2];               /* what was imposed in this step */
    int grasp_count;
    const CpsGrasp *grasp;   /* (grasp_count) nodes between the ends that are held or pulled */
    const double *reference; /* (n, 3) [m] x_R, where the step or its last substep began */
    const double *position;  /* (n, 3) [m] */
    const double *load;      /* (n, 3) [N] weight, drag, given loads, the force on a free end */
    double weight_before[3]; /* [N/m] weight where the step, or its last substep, began */
    const int *obstacle;     /* (contact_count, n) index in the scene, or CPS_NO_OBSTACLE */
    const double *normal;    /* (contact_count, n, 3) [-] at `position`; 0 0 0 without obstacle */
    /* (contact_count, n) [m] n.u >= -gap, u from the reference; INFINITY: no contact considered */
    const double *gap;
    /* (contact_count, n) [N] w = A h of the larger coefficient, or a set's factor; 0: smooth */
    const double *friction_bound;
    const double *friction_factor; /* (n) [-] mean factor of the zones at a node; 1 without */
    const double *friction_force;  /* (contact_count, n, 3) [N] F, within the set that w bounds */
    const double *reaction;        /* (contact_count, n) [N] R >= 0, along the normal */
    /* (contact_count, n, 3) [m] slip on the obstacle in this step, tangential: along the surface; 0
     * before the first step */
    const double *slip;
    const double *segment_force; /* (element_count, 3) [N] p, of the B side on the A side */
    const double *tension;       /* (element_count) [N] T >= 0, of the elongation unknown */
    const double *motion; /* (n, 3) [-] slides: proving velocities, the largest of size 1; else 0 */
    const unsigned char *state; /* (contact_count, n) CpsNodeState */
    /* [m] from which positions are measured, the same for all lines: 0 0 0, or a point near the
     * lines where these lie more than 512 lengths away */
    double origin[3];
    bool has_springs, has_node_loads; /* (loads.h) of nodes; without, what follows is 0 */
    /* (n, 3) [N/m] K, its xx, yy, zz and xy, xz, yz, [m] a, [m] y, small: their force -K (x + y -
     * a) balances; [N] drag and given loads, a part of `load` */
    const double *node_stiffness, *node_coupling, *node_place, *node_beside, *node_load;
    /* Contact of element e with a round obstacle at the point (1 - beta) x_e + beta x_{e+1} nearest
     * to its axis or centre; its forces act on the nodes in these shares, its slip is that of the
     * point with this beta. With a plane it is the third contact of the node at the element's end,
     * of share 1. They exist (the flag; else all is 0) where an obstacle is round or there are more
     * than two, and contact is not that of the reference; without an obstacle they mean nothing. */
    bool has_element_contacts;
    const int *element_obstacle;  /* (element_count) */
    const double *element_share;  /* (element_count) [-] beta */
    const double *element_normal; /* (element_count, 3) [-] */
    const double *element_gap; /* (element_count) [m] plus the depth allowed, min(l^2/(4 R), R/4) */
    const double *element_friction_bound; /* (element_count) [N] */
    const double *element_friction_force; /* (element_count, 3) [N] */
    const double *element_reaction;       /* (element_count) [N] */
    const double *element_slip;           /* (element_count, 3) [m] */
    const unsigned char *element_state;   /* (element_count) CpsNodeState */
} CpsLineView;

/* A node no farther from an obstacle than this share of its line's length touches it. */
#define CPS_TOUCH 1e-9
#ifdef __cplusplus
}
#endif
#endif
