/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of one line that the checker reads: the constants of the line and one step at a time. */
#ifndef CAPSTAN_CHECKER_RECORD_H
#define CAPSTAN_CHECKER_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "surface.h"

/* flag values of the file, by docs/results.md */
enum {
    OUTCOME_SOLVED,
    OUTCOME_TAUT,
    OUTCOME_STALLED,
    OUTCOME_LIMIT,
    OUTCOME_UNBOUNDED,
    OUTCOME_INFEASIBLE,
    OUTCOME_COARSE,
    OUTCOME_SLIDES,
    OUTCOME_PASSES,
    OUTCOMES
};
enum { END_HELD, END_FREE };
enum { POINT_HELD, POINT_FREE, POINT_STICK, POINT_SLIP, POINT_ON_BODY, POINT_STATES };
enum { POINT_KIND_ON_BODY = 2 }; /* of kind_of_point, beside POINT_HELD and POINT_FREE */

/* the claimed certificate: index here, name of the variable in CLAIM_NAME */
enum {
    CLAIM_PRIMAL,
    CLAIM_DUAL,
    CLAIM_GAP,
    CLAIM_SCALE,
    CLAIM_TENSION_BOUND,
    CLAIM_TENSION_ESTIMATE,
    CLAIM_FORCE_RESIDUAL,
    CLAIM_LARGEST_FORCE,
    CLAIM_LAW_RESIDUAL,
    CLAIM_CONTACT_RESIDUAL,
    CLAIM_FRICTION_RESIDUAL,
    CLAIM_STRETCH_RESIDUAL,
    CLAIM_PENETRATION,
    CLAIM_ELEMENT_PENETRATION,
    CLAIM_ELEMENT_PUSH,
    CLAIM_ELONGATION_RESIDUAL,
    CLAIMS
};
extern const char *const CLAIM_NAME[CLAIMS];

/* between which values the tension of an end's element lies: index here, name in RANGE_NAME */
enum { RANGE_LEAST, RANGE_LEAST_BOUND, RANGE_GREATEST, RANGE_GREATEST_BOUND, RANGES };
extern const char *const RANGE_NAME[RANGES];

/* where the energy of a step went, by the file: ends + obstacles = elastic + gravity + dissipated +
 * imbalance */
enum {
    LEDGER_ENDS,
    LEDGER_OBSTACLES,
    LEDGER_ELASTIC,
    LEDGER_GRAVITY,
    LEDGER_IMBALANCE,
    LEDGER_ENTRIES
};

/* energies of a step in time, by the file */
enum {
    TIME_KINETIC,
    TIME_GROWTH,
    TIME_IMPACT,
    TIME_SCHEME,
    TIME_SETTLING,
    TIME_DAMPING,
    TIME_DRAG,
    TIME_ADDED,
    TIME_WAVES,
    TIME_ENTRIES
};

typedef double Vector[3];
enum { GRASPS = 8 };

/* How elements stretch, by one of two stiffnesses: the members of Record of these names. */
typedef struct Elasticity {
    double *element_compliance, least_compliance, largest_compliance;
    size_t springs, *spring_of;
    double *spring_strain, *spring_stiffness;
} Elasticity;

/* nodes 0..elements; element i joins node i and i + 1 here. Contact c is the first of node c, or
 * the second of node c - nodes; where elements have contacts, contact contacts nodes + i is that of
 * element i. */
typedef struct Record {
    size_t nodes, elements, contacts;   /* contacts: 1 or 2 for each node */
    double *element_length, compliance; /* of a line of sections the mean */
    double *element_compliance, least_compliance, largest_compliance;
    double
        *weight_length; /* [m] of mean weight that the node carries; NULL: half of its elements */
    /* of tables of strain and tension (elongation.h): those of element i are spring_of[i] to
     * spring_of[i + 1] - 1; NULL: there are none */
    size_t springs, *spring_of;
    double *spring_strain, *spring_stiffness;
    /* of a line with a static and a dynamic stiffness (elongation.h): which holds in the step, and
     * at which strains there is no tension; else false, and NULL: 0 */
    bool has_dynamic, is_dynamic;
    double *rest_strain;
    struct Damping *damping; /* (damping.h) NULL: none */
    Elasticity elasticity[2];
    double *breaking_load;              /* (elements) [N] infinite: none; NULL: the line has none */
    double utilisation, utilisation_at; /* [-], [m], where it has */
    Vector *reference, *position, *load, *segment_force;
    bool has_weight_before; /* [N/m] per natural length, where the step began; else it is that of
                               the loads */
    Vector weight_before;
    /* of a file with steps in time, else NULL; [kg], [s] k, [m/s]: inertia.h */
    double *mass, *span, time, step_length, time_entry[TIME_ENTRIES];
    bool velocity_given[2]; /* of the ends, by the caller of the step */
    Vector *velocity, *rest_velocity;
    /* where the nodes were as it began, and as the step before began; NULL: not both in time
     * (carried.h), and [s] the length of that */
    const Vector *start, *past;
    double length_before;
    Vector *motion;                          /* of a line that slides without end, else 0 */
    Vector *normal, *friction, *slip;        /* (contacts, nodes) */
    double *gap, *friction_bound, *reaction; /* the same */
    double *obstacle;  /* the same: its number, by the file; where there is one contact, 0 */
    double *share_of;  /* (elements) where on its way element i touches */
    bool has_elements; /* the file has contacts of elements; obstacle -1: none */
    double *turn;      /* of each obstacle in the step [rad] */
    double *mu; /* (contacts, nodes) not read: factor times the larger coefficient of the obstacle,
                   by measure.h */
    /* of friction at a node, the mean over the length that it stands for, and what rounding of the
     * abscissas may leave of it in 64 bits; NULL without friction zones: 1 */
    double *factor, *factor_noise;
    double *tension;
    int end_point[2];   /* at which the ends are in the step; -1: at none */
    int given_point[2]; /* ... and where the run begins */
    int release[2];     /* whether the ends were let go (failure.h) */
    double *break_at;   /* (elements) [N] infinite: none; NULL: the line has none */
    int end_kind[2], outcome, iterations;
    int substeps; /* that the step was taken in; the arrays are those of the last one, */
    double share; /* which is so much of the step */
    /* of a line with winches, what is off their drums (winches.h); else NULL, and 0 */
    struct Drums *drums;
    double arc_from, stored[2], winch_pull[2], winch_work; /* stored, winch_pull: NaN: no winch */
    bool winds;      /* a drum has not the same as in the step before */
    bool settles;    /* it moved in the step before, and is at rest (settling.h); */
    double kept;     /* [J] what its elements stored then beyond their strains */
    bool on_drum[2]; /* the node at the end is one that a drum has */
    size_t grasps, grasp_node[GRASPS]; /* nodes between the ends that are held or pulled */
    int grasp_kind[GRASPS];
    Vector grasp_place[GRASPS], grasp_load[GRASPS], grasp_force[GRASPS];
    Vector held_position[2], applied_force[2]; /* what is imposed on an end; NaN: the other is */
    Vector end_force[2], end_friction_force[2], proof;
    double end_tension[2], end_range[RANGES][2];
    double bend_turn, bend_friction,
        bend_at;                     /* [rad], [-], [m] of the sharpest bend round an obstacle */
    int proof_obstacle, proof_plane; /* -1: none, or the file does not say */
    double proof_length, proof_force, claim[CLAIMS], dissipated, ledger[LEDGER_ENTRIES],
        unaccounted;
    double bearing_width; /* [m] on what gives (soft.h) */
    struct Sets *sets;    /* (sets.h) that ends are held to; NULL: there are none */
    struct Loads *loads;  /* (loads.h) beside the weight; NULL: there are none */
} Record;

/* A point where lines meet, after a step; forces are on the point. */
typedef struct Junction {
    Vector position, lines, load, support, normal, friction, slip, residual;
    double reaction, dissipated;
    int state, obstacle; /* obstacle: -1: none */
    bool has_place;
} Junction;

/* An open file: its lines and how many steps they have. */
typedef struct Source {
    int nc;
    size_t steps, lines;
    char **line_name;
    /* (steps) the line that parts, its end, and its tension before; NULL: none may */
    double *break_line, *break_end, *break_tension;
    double tolerance, gravity[3];
    double origin[3];   /* [m] from which the places of the file are measured, in the scene's
                           coordinates; 0 0 0 unless it says so */
    bool consistent;    /* friction bounds follow the reactions of the same step */
    bool touching_only; /* only what touches at the reference is kept out */
    bool has_static;    /* the first step is statics without friction, of the lines laid */
    bool follows; /* normals are those of where the nodes end up: not one plane with one coefficient
                   */
    size_t surfaces;
    Surface *surface; /* where they are after the step read last, if they move */
    bool moves;
    struct Places *places; /* places.h */
    size_t points;
    char **point_name;
    double *point_weight; /* (points) [N] under the gravity of the scene */
    int *point_kind; /* (points) POINT_HELD, POINT_FREE or POINT_KIND_ON_BODY, where the run begins
                      */
} Source;

/* All return 0, or -1 after one sentence on log. */
int source_open(const char *path, Source *source, FILE *log);
int record_create(const Source *source, const char *line, Record *record, FILE *log);
int record_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);

/* All points of the source after a step, (points). */
int junctions_read(const Source *source, size_t step, Junction *all, FILE *log);

/* Both accept a zeroed struct. */
void source_close(Source *source);
void record_destroy(Record *record);

#endif
