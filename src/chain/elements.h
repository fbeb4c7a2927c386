/* SPDX-License-Identifier: BSD-3-Clause */
/* The elements of a program over a chain (chain_program.h): the arrays of each kind, the program
 * that holds them, and what one kind needs of another. Each kind is a file: segment.c, drag.c,
 * node_field.c, constraint.c, conic_constraint.c, unilateral.c, friction_disc.c, friction_conic.c;
 * chain_program.c puts them together. */
#ifndef CAPSTAN_SRC_CHAIN_ELEMENTS_H
#define CAPSTAN_SRC_CHAIN_ELEMENTS_H

#include <math.h>

#include "base/element_law.h"
#include "chain/chain_system.h"
#include "chain/constraints.h"
#include "chain/friction_shape.h"
#include "ipm/program.h"

/* Two groups of arrays lie in memory that serves something else at other times (chain_program.c):
 * the directions ds, dz of segments and friction discs, written after the last solve of an
 * iteration and read until the next factorisation, in that of the factor; and the right-hand sides
 * q of all three kinds, which begin after the factorisation, in that of the matrix's nodes, where
 * no element has a point. */

/* Springs beside the segments (springs.c): those of element i = 1..n-1 are at[i - 1]..at[i] - 1. */
typedef struct CpsiSprings {
    int count;     /* of all elements; 0: there is none, and nothing else here is read */
    const int *at; /* (n) */
    const double *start, *stiffness; /* (count) s_k/longer, K_k/stiffer */
    double longer, stiffer;
    double *s, *z, *q, *ds, *dz; /* (count) */
    double *compliance, *rest;   /* (n) c, and the part of rho beside 1 + c T - s0, of a pass */
    double *stretch;             /* (n) dd */
} CpsiSprings;

/* Element i = 1..n-1 between nodes i-1 and i; index 0 is unused. */
typedef struct CpsiSegment {
    double *length;    /* (n) l_i > 0, their sum is 1 */
    double compliance; /* c >= 0, of every element; of element i times compliance_factor[i - 1] */
    const double *compliance_factor; /* (n - 1), all positive; NULL: 1 */
    CpsiSprings springs;             /* of elements whose stiffness grows with their strain */
    double (*s)[4];                  /* (n) (1 + d, e) */
    double (*z)[4];                  /* (n) (T, -p) */
    double (*w)[4];                  /* (n) Nesterov-Todd scaling, kept as lanes (lanes.h) */
    double *g;                       /* (n) and its factor */
    double *inverse_w;               /* (n) 1/|w1| */
    double (*q)[4];                  /* (n) right-hand side of the complementarity, so kept */
    double (*ds)[4];                 /* (n) direction */
    double (*dz)[4];                 /* (n) */
} CpsiSegment;

/* c of element i. */
static inline double cpsi_segment_compliance(const CpsiSegment *segment, int i) {
    return segment->compliance_factor ? segment->compliance * segment->compliance_factor[i - 1]
                                      : segment->compliance;
}

/* The law of element i. */
static inline CpsiElementLaw cpsi_segment_law(const CpsiSegment *segment, int i) {
    const CpsiSprings *springs = &segment->springs;
    CpsiElementLaw law = {.compliance = cpsi_segment_compliance(segment, i)};
    if (springs->count == 0) return law;
    const int first = springs->at[i - 1];
    law.count = springs->at[i] - first;
    law.start = &springs->start[first];
    law.stiffness = &springs->stiffness[first];
    law.longer = springs->longer;
    law.stiffer = springs->stiffer;
    return law;
}

typedef struct CpsiFrictionDisc {
    int count;
    int *node;
    int *contact;        /* (count) the caller's number */
    double *weight;      /* (count) w_k > 0, that of its unilateral contact */
    double (*s)[3];      /* (count) (t, u_x, u_y) */
    double (*z)[3];      /* (count) (A, F_x, F_y) */
    double (*offset)[2]; /* (count) o_k; NULL: none */
    double (*map)[6]; /* (count) B_k (2, 3) row by row; NULL: the first two rows of the identity */
    int *unilateral;  /* (count) the contact whose reaction bounds it, where bounds are coupled */
    double *friction; /* (count) [-] bound over reaction, where bounds are coupled */
    /* (count) forces lie in A times this set, NULL: the unit disc; only in programs for Newton's
     * method. The array is NULL where no obstacle has a general set */
    const CpsiFrictionShape **shape;
    double (*w)[3]; /* (count) scaling and right-hand sides, kept as lanes (lanes.h) */
    double *g;
    double (*q)[3], (*ds)[3], (*dz)[3];
} CpsiFrictionDisc;

typedef struct CpsiUnilateral {
    int count;
    int *node;
    int *contact;       /* (count) the caller's number */
    double *weight;     /* (count) w_k > 0 */
    double *gap;        /* (count) g_k >= 0, any where it gives */
    double *compliance; /* (count) c_k >= 0: the distance is g_k + n_k.u + c_k R_k; NULL: all 0 */
    bool *second;       /* (count) its normal is not z: the second contact of its node */
    double (
        *normal)[3]; /* (count) n_k; of a first contact z. NULL: all are z, and none is second */
    double (*curvature)[6]; /* (count) R0 times the curvature of the surface, xx, xy, yy, xz, yz,
                               zz: the force R n gains that times u; with `normal` */
    double *s, *z;          /* (count) distance, reaction */
    /* (count) dz also serves between the passes `load` and `direct`: there it is the direction
     * without the part that is linear in n.du */
    double *q, *ds, *dz;
} CpsiUnilateral;

/* A planar set of forces { origin + P v : A v + b in K }, K a product of half-lines (dimension 1)
 * and second-order cones. */
typedef struct CpsiConicSet {
    int unknowns, rows, cones;
    int spread;           /* rows, and one more for each second-order cone */
    const int *dim;       /* (cones) */
    const double *a, *b;  /* (rows, unknowns) of full column rank, (rows) */
    const double *p;      /* (2, unknowns) */
    const double *origin; /* (2) */
    const double *centre; /* (unknowns) the analytic centre: A'z^-1 = 0 for z = A v + b */
    double reach;         /* no point of the set has a larger norm */
} CpsiConicSet;

typedef struct CpsiFrictionConic {
    int count;
    int *node;
    int *contact;              /* (count) the caller's number */
    double *weight;            /* (count) w_k > 0, that of its unilateral contact */
    const CpsiConicSet **form; /* (count) */
    double *bound;             /* (count) a: the forces are a times the set */
    double (*offset)[2];       /* (count) o_k */
    double (*tangent)[6];    /* (count) the tangents (2, 3) of its contact row by row: x and y of a
                                first one */
    bool *second;            /* (count) as its contact */
    int *unilateral;         /* (count) as of a friction disc */
    double *friction;        /* (count) the same */
    double *d_bound, *shift; /* (count) direction of a, and its part that does not come from the
                                direction of R */
    double (*turn)[2]; /* (count) cosine and sine of the turn of the node's tangents in the linear
                          system */
    double (*du)[2];   /* (count) the direction in these */
    double *frame;     /* (n, 9) the axes of the nodes, so turned */
    double *data, *scratch; /* what the elements hold, in blocks of eight (conic_block.h) */
    int *index;
    size_t blocks, stride, index_stride;
} CpsiFrictionConic;

typedef struct CpsiChainProgram {
    CpsiProgram base;    /* u (n, or 2 n with points, 3) and so on: node after node */
    int n;               /* nodes */
    unsigned char *held; /* (n) */
    double *frame; /* (n, or 2 n, 9) axes of the nodes (chain/frame.h); NULL: the common axes */
    struct {
        double *frame, (*offset)[2], (*map)[6], (*normal)[3], (*curvature)[6];
        double *share; /* (n) b_i, where along element i its point lies, 0: none; NULL: the program
                          has no points */
        CpsiMatrixSecond second;
        double *second_reaction_change; /* (n) w (z/s) n.du of second contacts */
        bool has_second_contacts;       /* nodes may have second contacts */
    } node_frames; /* storage that is used only where nodes have axes of their own */
    CpsiSegment segment;
    double drag; /* d >= 0: a force -d w_j u_j on node j, w_j its share of the line */
    /* (n, 6) K_j >= 0 as xx, xy, yy, xz, yz, zz in the axes of the node: a force -K_j u_j on it;
     * the caller's; NULL: none */
    const double *field;
    CpsiConstraints constraints; /* of its end nodes; the caller's, none after a resize */
    CpsiFrictionDisc disc;
    CpsiUnilateral unilateral;
    bool bounds_coupled;     /* friction bounds are coupled to the reactions, A = friction R; else
                                A is fixed */
    CpsiFrictionConic conic; /* laid out only where asked for */
    double *dt;              /* (n) direction of the tension unknowns (index 0 unused) */
    CpsiMatrix matrix;
    const CpsiLinsysOps *ops;
    CpsiLinsys *linsys;
    /* The arena from here to the end of the layout holds factor and directions alone: while the
     * program is not being solved it may serve others. */
    size_t scratch;
} CpsiChainProgram;

static inline CpsiChainProgram *cpsi_chain(CpsiProgram *program) {
    return (CpsiChainProgram *)program;
}

/* n.u of unilateral contact k, for a field u of the nodes. */
static inline double cpsi_unilateral_rise(const CpsiUnilateral *unilateral, int k,
                                          const double *u) {
    const double *v = &u[3 * unilateral->node[k]];
    if (!unilateral->normal || !unilateral->second[k]) return v[2];
    const double *n = unilateral->normal[k];
    return n[0] * v[0] + n[1] * v[1] + n[2] * v[2];
}

/* s + c z of unilateral contact k, which over w z is the compliance of the node along n. */
static inline double cpsi_unilateral_give(const CpsiUnilateral *unilateral, int k) {
    const double c = unilateral->compliance ? unilateral->compliance[k] : 0;
    return unilateral->s[k] + c * unilateral->z[k];
}

/* K_j u_j of the field, which is there. */
static inline void cpsi_field_pull(const CpsiChainProgram *program, int j, double pull[3]) {
    const double *k = &program->field[6 * j], *u = &program->base.u[3 * j];
    pull[0] = k[0] * u[0] + k[1] * u[1] + k[3] * u[2];
    pull[1] = k[1] * u[0] + k[2] * u[1] + k[4] * u[2];
    pull[2] = k[3] * u[0] + k[4] * u[1] + k[5] * u[2];
}

/* Add by x B^T M B to D; B (2, 3), M as xx, xy, yy, D as xx, xy, yy, xz, yz, zz. */
static inline void cpsi_add_mapped(double *d, double by, const double b[6], const double m[3]) {
    static const int ROW[6] = {0, 0, 1, 0, 1, 2}, COLUMN[6] = {0, 1, 1, 2, 2, 2};
    for (int i = 0; i < 6; i++) {
        const double *p = &b[ROW[i]], *q = &b[COLUMN[i]];
        d[i] += by * (p[0] * (m[0] * q[0] + m[1] * q[3]) + p[3] * (m[1] * q[0] + m[2] * q[3]));
    }
}

/* Friction coupled to the reaction of unilateral contact k: the force c times the change of the
 * bound acts on the node, c in its axes; the bound is friction R. Adds the part that is linear in
 * du to the matrix. */
static inline void cpsi_unilateral_couple_bound(CpsiChainProgram *program, int k, double weight,
                                                double friction, const double c[3]) {
    const CpsiUnilateral *unilateral = &program->unilateral;
    const int node = unilateral->node[k];
    if (unilateral->normal && unilateral->second[k]) { /* compliance (s + c z)/(w z) */
        for (int a = 0; a < 3; a++)
            program->node_frames.second.column[3 * node + a] +=
                weight / unilateral->weight[k] * friction * c[a];
        return;
    }
    for (int a = 0; a < 2; a++)
        program->matrix.skew[2 * node + a] +=
            weight * friction * unilateral->z[k] / cpsi_unilateral_give(unilateral, k) * c[a];
}

/* ---- springs (springs.c) ---- */

/* Place the arrays of at most `count` springs on n nodes. */
void cpsi_springs_layout(CpsiSprings *springs, CpsiArena *arena, int n, int count);
/* The passes, each called by that of the segments: `direct` at its end, the others before. */
void cpsi_springs_start(CpsiSegment *segment, int n, double mu, double margin);
void cpsi_springs_measure(CpsiSegment *segment, int n, double alpha, CpsiSums *sums);
void cpsi_springs_scale(CpsiSegment *segment, int n);
void cpsi_springs_load(CpsiSegment *segment, int n, const CpsiIpmAim *aim);
void cpsi_springs_direct(CpsiSegment *segment, int n, const CpsiIpmAim *aim, CpsiSums *sums);

/* ---- friction conics (friction_conic.c) ---- */

/* Place the arrays of at most `count` friction conics on n nodes. */
void cpsi_friction_conic_layout(CpsiFrictionConic *conic, CpsiArena *arena, int n, int count,
                                const CpsiConicSet *largest);
/* F of friction conic k, per unit weight. */
void cpsi_friction_conic_force(const CpsiFrictionConic *conic, int k, double force[2]);
/* |o + u_xy| of friction conic k. */
double cpsi_friction_conic_slip(const CpsiChainProgram *program, int k);
/* Distance of F from the boundary of its set in the scale of the cones: 0 on the boundary, of order
 * one at the centre. */
double cpsi_friction_conic_margin(const CpsiFrictionConic *conic, int k);
/* Turn the tangential components of nodes to the rotated tangents of their friction conics; turn a
 * direction back, after keeping it. */
void cpsi_friction_conic_turn(const CpsiFrictionConic *conic, double *x);
void cpsi_friction_conic_turn_back(CpsiFrictionConic *conic, double *du);
/* The part of cpsi_chain_program_couple_bounds for friction conics: every bound moves to friction
 * R. */
void cpsi_friction_conic_predict_bounds(CpsiFrictionConic *conic, const CpsiUnilateral *unilateral);

/* The kinds of a chain; those with loops over lanes once for each width (base/width.h). */
extern const CpsiKind cpsi_segment_128, cpsi_segment_256, cpsi_segment_512;
extern const CpsiKind cpsi_unilateral_128, cpsi_unilateral_256, cpsi_unilateral_512;
extern const CpsiKind cpsi_friction_disc_128, cpsi_friction_disc_256, cpsi_friction_disc_512;
extern const CpsiKind cpsi_friction_conic_128, cpsi_friction_conic_256, cpsi_friction_conic_512;
extern const CpsiKind cpsi_drag, cpsi_node_field, cpsi_constraint, cpsi_conic_constraint;

/* In this order: friction discs and conics read what the same pass has computed for their
 * unilateral contact. */
enum {
    CPSI_KIND_SEGMENT,
    CPSI_KIND_DRAG,
    CPSI_KIND_FIELD,
    CPSI_KIND_CONSTRAINT,
    CPSI_KIND_CONIC_CONSTRAINT,
    CPSI_KIND_UNILATERAL,
    CPSI_KIND_FRICTION_DISC,
    CPSI_KIND_FRICTION_CONIC,
    CPSI_CHAIN_KINDS
};

/* The kinds for the width of this processor (CPSI_CHAIN_KINDS). */
const CpsiKind *const *cpsi_chain_kinds(CpsiArena *arena);

#endif
