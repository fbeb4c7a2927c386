/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/step.h: what a load step reports: its outcome, the certificate of its answer, the
 * forces at the ends of a line, and where the energy went. */
#ifndef CAPSTAN_STEP_H
#define CAPSTAN_STEP_H

#include "capstan/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/* What the mathematics said. A step's outcome is the worst of its lines' (cps_outcome_worse);
 * numbers are no order. */
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
      "slides without end: no equilibrium at any place along its path")

typedef enum CpsOutcome {
#define CPS_OUTCOME_ENUM(name, number, key, sentence) name = number,
    CPS_OUTCOME_LIST(CPS_OUTCOME_ENUM)
#undef CPS_OUTCOME_ENUM
} CpsOutcome;

CPS_API const char *cps_outcome_name(CpsOutcome outcome); /* "solved", ... */
CPS_API const char *cps_outcome_text(CpsOutcome outcome);
/* Is the answer of the step certified? */
CPS_API bool cps_outcome_is_certified(CpsOutcome outcome);
/* Is there no equilibrium, with a proof in the report?  Nothing can follow such a step. */
CPS_API bool cps_outcome_is_final(CpsOutcome outcome);
/* The worse of two, from solved to infeasible. */
CPS_API CpsOutcome cps_outcome_worse(CpsOutcome a, CpsOutcome b);

/* The certificate of one line's step: forces that balance and a configuration, with the gap between
 * them. */
typedef struct CpsCertificate {
    double primal;        /* [J] J + j at the configuration */
    double dual;          /* [J] a lower bound of the minimum, from the forces */
    double gap;           /* [J] sum of the local gaps, each >= 0; primal - dual up to rounding */
    double scale;         /* [J] S of docs/theory.md; certified when gap <= tolerance * scale */
    double tension_bound; /* [N] guaranteed rms error of the tension, with the flag below */
    double tension_estimate; /* [N] max |T - |p||: elongation against equilibrium */
    double force_residual;   /* [N] largest imbalance of forces on a node */
    double largest_force;    /* [N] largest force in the line or on it */
    double law_residual;     /* [J] sum of phi(u) + <u, F> */
    double contact_residual; /* [J] sum of R (n.u + gap) */
    /* [N] sum of |A - mu R|, A the friction bounds used and R the reactions found: what freezing A
     * leaves out; 0 up to rounding with consistent friction */
    double friction_residual;
    double element_push;        /* [N] largest compressive part of an element's force */
    double elongation_residual; /* [-] largest |x'| - (1 + c|p|) of an elastic element: elongation
                                   that its force does not explain */
    double stretch_residual;    /* [-] largest |x'| - 1 of an inextensible element */
    double penetration;         /* [m] deepest node below the obstacle, >= 0 */
    /* [m] deepest element inside a round obstacle, beyond min(l^2/(4 R), R/4) for the natural
     * length l of the element and the radius R; >= 0 */
    double element_penetration;
    bool has_tension_bound; /* false for an inextensible line, and where the bound would be larger
                               than the tension itself: tension_bound is 0 then */
} CpsCertificate;

/* How a node rests on the obstacle. */
typedef enum CpsNodeState {
    CPS_NODE_STATE_FREE = 0,
    CPS_NODE_STATE_STICK = 1,
    CPS_NODE_STATE_SLIP = 2
} CpsNodeState;

/* What is known of the tensions that hold an inextensible line where it is; they need not be unique
 * (docs/theory.md 4a). */
#define CPS_RANGE_LIST(X)                                                                      \
    X(CPS_RANGE_NONE, 0, "none",                                                               \
      "not asked: a step within a stage, or one without a certified answer")                   \
    X(CPS_RANGE_STRAIN, 1, "strain", "an elastic line: its strain tells the tension")          \
    X(CPS_RANGE_BOUNDED, 2, "bounded", "least and greatest tension, each with its bound")      \
    X(CPS_RANGE_UNBOUNDED, 3, "unbounded",                                                     \
      "jammed: forces that hold each other may be added in any amount, the tension with them") \
    X(CPS_RANGE_NOT_GIVEN, 4, "not_given",                                                     \
      "friction by a set of set.h touches the line: not looked into")                          \
    X(CPS_RANGE_FAILED, 5, "failed", "the program of the range did not converge")

typedef enum CpsRange {
#define CPS_RANGE_ENUM(name, number, key, sentence) name = number,
    CPS_RANGE_LIST(CPS_RANGE_ENUM)
#undef CPS_RANGE_ENUM
} CpsRange;

CPS_API const char *cps_range_name(CpsRange range); /* "bounded", ... */

/* Least and greatest tension of the element at an end, of all forces that balance and obey the laws
 * in the places and slips found. The first value is that of such forces, the second a bound from
 * virtual displacements that none exceeds. */
typedef struct CpsTensionRange {
    CpsRange kind;
    bool has_values;                 /* the kind is bounded or unbounded; else all four are 0 */
    double least, least_bound;       /* [N] */
    double greatest, greatest_bound; /* [N] INFINITY where unbounded */
} CpsTensionRange;

/* Do the forces of a step leave the line a choice of places?  Where they do, the nearest to the
 * reference is taken: of all places that go with the forces that of least sum h |x - x_R|^2. */
typedef enum CpsPlaces {
    CPS_PLACES_UNIQUE = 0,
    CPS_PLACES_NEAREST = 1, /* not unique: the nearest is taken */
    /* not unique, and one of them is taken: the nearest was not found with certainty */
    CPS_PLACES_ANY = 2
} CpsPlaces;

/* The end of a line. The last half element, of length h/2, has the weight w h/2, and where a held
 * end lies on an obstacle its reaction and friction as well; so the force at the end is not the one
 * in the middle of the element (docs/theory.md 3). */
typedef struct CpsEndReport {
    double position[3]; /* [m] in the coordinates of the scene */
    double force[3];    /* [N] on the line at this end */
    double tension;     /* [N] |force|, the line's tension at this end */
    double work; /* [J] of the force at this end in this step, over its parts: the two add up to
                    `ends` of the ledger */
    double friction_force[3]; /* [N] on the half element beside a held end that lies on an obstacle;
                              in balance with `force` */
    CpsTensionRange range;    /* of the end element, at the last step of a stage */
} CpsEndReport;

/* The contact at which the mesh changes the law of friction most: a node on a cylinder or sphere at
 * which the line turns by d holds tensions up to the ratio k = (1 + mu tan(d/2))/(1 - mu tan(d/2)),
 * a smooth line exp(mu d). From mu tan(d/2) = 0.9 on the step is not certified (mesh_too_coarse).
 * All 0 where the line turns round nothing with friction. */
typedef struct CpsBend {
    double turn; /* [rad] d, towards the obstacle */
    double
        friction; /* [-] mu, the larger coefficient for a slip along the line in either direction */
    double ratio; /* [-] k; INFINITY: any */
    double coulomb;    /* [-] exp(mu d) */
    double arc_length; /* [m] where */
    double element;    /* [m] elements that are no longer keep k within 1 % of exp(mu d) */
    int obstacle;      /* index in the scene */
} CpsBend;

/* Where the energy of a step went [J]: ends + obstacles = elastic + gravity + dissipated +
 * imbalance. */
typedef struct CpsLedger {
    double elastic;    /* growth of the energy of elongation */
    double gravity;    /* growth of the weight's potential */
    double ends;       /* work of the forces at the ends, held or free: mean of the force before and
                          after, times the path */
    double obstacles;  /* work of the friction of obstacles that turn */
    double dissipated; /* by friction, >= 0 */
    double imbalance;  /* vanishes at first order as load steps get smaller; large and positive in a
                          snap: energy that is set free */
} CpsLedger;

typedef struct CpsLineReport {
    CpsOutcome outcome;         /* the worst of the parts that the step was taken in */
    int iteration_count;        /* of all that was solved, parts that were not kept included */
    CpsPlaces places;           /* of the parts the one that leaves most open */
    CpsCertificate certificate; /* of the last part */
    double dissipated;          /* [J] in this step */
    CpsLedger ledger;  /* of this step; zero for a line whose start is computed by statics in it */
    int substep_count; /* in which the step was taken, 1 or more */
    int warm_count;    /* of these, found by Newton's method from the one before (theory.md 6b) */
    double share;   /* of the step that the last part was, which is what the view shows: 1 where it
                       was not cut */
    int jump_count; /* parts in which the line jumped, however small the load */
    double jump;    /* [m] the longest displacement of a node in such a part */
    /* [J] of the imbalance, what parts that could not be cut any more made from nothing; with a
     * path tolerance also what they lost, snaps apart: 0 unless it is more than 5 % of what is
     * dissipated and worked in such a part */
    double unaccounted;
    CpsEndReport end[2];
    double grounded;           /* [m] natural length in contact with a reaction */
    double slipping;           /* [m] natural length that slid on the obstacle in this step */
    double slack;              /* [m] natural length without tension */
    bool has_tension_mesh;     /* the next one is known, else 0 */
    double tension_mesh;       /* [N] estimated error of the tension by the elements' lengths */
    bool has_pierced_obstacle; /* the next one is known */
    int pierced_obstacle;      /* that of the certificate's element_penetration */
    CpsBend bend;              /* the sharpest of the parts */
    /* infeasible: unit vector in which the shortest path to end B leaves end A: straight, where a
     * constant force along it proves it, or round an obstacle; unbounded: the rigid direction in
     * which the energy falls; slides: the velocity of the end that leads, of the field `motion` of
     * the view; else 0 0 0 */
    double proof[3];
    /* [m] infeasible: distance of the ends, or the least length of a line round the obstacle, less
     * the line's length > 0; else 0 */
    double proof_length;
    /* [N] unbounded: fall of the energy per metre > 0; slides: power of the loads per unit of
     * speed, beyond all that friction can take, the least along the path > 0; else 0 */
    double proof_force;
    bool has_proof_obstacle;
    int proof_obstacle; /* infeasible, with the flag: that which the line does not reach round */
    /* [N] unbounded with frozen friction: what friction bears by Coulomb's law under these loads,
     * mu times what presses on the plane, where that is enough to hold the line; else 0 */
    double coulomb;
} CpsLineReport;

/* One step of all lines: sums of energies, residuals and forces at their worst. */
typedef struct CpsStepReport {
    const char *name; /* "static", a stage's name, or "name k/n" within a stage of n steps; owned by
                         the evolution */
    int step_count;   /* steps taken so far, this one included; 0 before the first one */
    CpsOutcome outcome;
    int iteration_count;        /* largest over the lines */
    CpsCertificate certificate; /* energies, gap, scale and J residuals summed, all else the largest
                                   of the lines; has_tension_bound where all lines have one */
    double dissipated;          /* [J] */
    CpsLedger ledger;           /* sum of the lines */
    int substep_count;          /* largest over the lines */
    int warm_count;             /* largest over the lines */
    int jump_count;             /* sum of the lines */
    CpsPlaces places;           /* largest over the lines */
    double jump;                /* [m] largest of the lines */
    double unaccounted;         /* [J] sum of the lines */
    double wall;                /* [s] */
} CpsStepReport;

/* The index of an obstacle where there is none. */
enum { CPS_NO_OBSTACLE = -1 };

/* Everything about one line after a step. Views into the evolution; n = element_count + 1 nodes.
 * Forces act on the line; arrays (n, 3) are stored node after node. A node touches up to
 * `contact_count` obstacles at once, and what belongs to a contact has all nodes' nearest obstacles
 * first: entry j is the first contact of node j, entry n + j its second. */
typedef struct CpsLineView {
    const char *name;
    int element_count;
    int contact_count; /* of a node: 2 where the scene has more than one obstacle, else 1 */
    bool one_plane;    /* all contacts are with one plane with isotropic friction, or there is no
                          obstacle: what regularized.h and the solutions of a step (evolve.h) need */
    const double *arc_length;     /* (n) [m] natural abscissa a of the nodes */
    const double *element_length; /* (element_count) [m] */
    double compliance;            /* [1/N] 1/EA, 0: inextensible */
    CpsEnd end[2];                /* what was imposed in this step */
    const double *reference;      /* (n, 3) [m] x_R of this step */
    const double *position;       /* (n, 3) [m] */
    const double *load;           /* (n, 3) [N] weight and free-end forces */
    double weight_before[3]; /* [N/m] per natural length where the step, or its last part, began;
                                another one than now where gravity changes */
    const int *obstacle;     /* (contact_count, n) index in the scene of the nearest and the next
                                obstacle;     CPS_NO_OBSTACLE without one */
    const double *normal;    /* (contact_count, n, 3) [-] that of the obstacle at the configuration
                                reached;    0 0 0 without */
    const double *gap; /* (contact_count, n) [m] n.u >= -gap, u from the reference; INFINITY: no
                          contact looked for */
    const double *friction_bound; /* (contact_count, n) [N] w = A h, of the larger coefficient (of a
                                     friction set: its multiple); 0 where friction does not act */
    const double *friction_factor; /* (n) [-] of the friction zones, the mean over the length that a
                                      node stands for; 1 without zones */
    const double
        *friction_force;    /* (contact_count, n, 3) [N] F, in the set of forces that w bounds */
    const double *reaction; /* (contact_count, n) [N] R >= 0, along the normal */
    /* (contact_count, n, 3) [m] slip on the obstacle in this step, tangential: on a plane the part
     * of u in it, on a curved obstacle along the surface; 0 before the first step */
    const double *slip;
    const double *segment_force; /* (element_count, 3) [N] p: what the B side does to the A side */
    /* (element_count) [N] T >= 0 from the elongation unknown, not from positions */
    const double *tension;
    /* (n, 3) [-] slides: velocities that prove it, the fastest of size 1; else 0 */
    const double *motion;
    const unsigned char *state; /* (contact_count, n) CpsNodeState */
    /* [m] what reference, position and the places of held ends are measured from: 0 0 0, but a
     * place near the lines where these lie more than 512 lengths away; same for all lines */
    double origin[3];
    /* Contact of an element with a round obstacle, at the point (1 - beta) x_e + beta x_{e+1} that
     * was nearest to its axis or centre; its forces act on the element's nodes by these shares. As
     * above for that point, whose slip is that of the point with this beta since the reference.
     * With a plane it is the third contact of the node at the element's end, of share 1. They are
     * looked for where an obstacle is round, or there are more than two, and contact is not that of
     * the reference; elsewhere all are 0. Those of an element without obstacle have no meaning. */
    bool has_element_contacts;
    const int *element_obstacle;  /* (element_count) */
    const double *element_share;  /* (element_count) [-] beta */
    const double *element_normal; /* (element_count, 3) [-] */
    const double *element_gap; /* (element_count) [m] with what an element may lie deep, min(l^2/(4
                                  R), R/4), added */
    const double *element_friction_bound; /* (element_count) [N] */
    const double *element_friction_force; /* (element_count, 3) [N] */
    const double *element_reaction;       /* (element_count) [N] */
    const double *element_slip;           /* (element_count, 3) [m] */
    const unsigned char *element_state;   /* (element_count) */
} CpsLineView;

/* A node this near to an obstacle, per length of its line, touches it. */
#define CPS_TOUCH 1e-9

#ifdef __cplusplus
}
#endif
#endif
