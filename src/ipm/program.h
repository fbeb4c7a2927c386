/* SPDX-License-Identifier: BSD-3-Clause */
/* A conic program over a chain of nodes, as elements by kind, and the interior-point iterate that lives in it.
 *
 *     min   sum_i l_i d_i^2/(2 c_i)  +  sum_k w_k A_k t_k  -  sum_j b_j.u_j
 *     s.t.  (1 + d_i, e_i) in Q4,       e_i = e_i^0 + (u_i - u_{i-1})/l_i       stretch, one per element i = 1..n-1
 *           (t_k, u_xy) in Q3           at node k                               rub,     a disc of forces of radius A_k
 *           g_k + u_z >= 0              at node k                               stop,    a half-line
 *           u_j = given at held nodes
 *
 * All quantities are dimensionless and of order one; the program knows no mechanics, but its names are those of a line:
 * stretch duals are (T, -p), rub duals (A, F), stop duals R, each per unit weight, where the weight of an element is its share
 * of the line (l_i, w_k). With weights the complementarity s.z is a density, and the same target serves a fine and a coarse
 * element. Private unknowns (d_i, t_k) are condensed out cone by cone; each stretch keeps its tension in the linear system.
 *
 * Iterate: s primal, z dual, both interior. s of a rub is exact by construction, s of a stretch or stop may differ from what
 * u says by the residual rho, which a full step removes. */
#ifndef CAPSTAN_SRC_IPM_PROGRAM_H
#define CAPSTAN_SRC_IPM_PROGRAM_H

#include "linsys/linsys.h"

/* Element i = 1..n-1 between nodes i-1 and i; index 0 is unused. */
typedef struct CpsiStretch {
    double *length;       /* (n) l_i > 0, their sum is 1 */
    double *compliance;   /* (n) c_i >= 0 */
    double (*s)[4];       /* (n) (1 + d, e) */
    double (*z)[4];       /* (n) (T, -p) */
    double (*w)[4];       /* (n) Nesterov-Todd scaling */
    double *g;            /* (n) and its factor */
    double (*q)[4];       /* (n) right-hand side of the complementarity equation */
    double (*ds)[4];      /* (n) direction */
    double (*dz)[4];      /* (n) */
} CpsiStretch;

typedef struct CpsiRub {
    int count;
    int *node;
    double *weight; /* (count) w_k > 0 */
    double (*s)[3]; /* (count) (t, u_x, u_y) */
    double (*z)[3]; /* (count) (A, F_x, F_y): z[0] never changes */
    double (*w)[3];
    double *g;
    double (*q)[3], (*ds)[3], (*dz)[3];
} CpsiRub;

typedef struct CpsiStop {
    int count;
    int *node;
    double *weight; /* (count) w_k > 0 */
    double *gap;    /* (count) g_k >= 0 */
    double *s, *z;  /* (count) distance, reaction */
    double *q, *ds, *dz;
} CpsiStop;

typedef struct CpsiProgram {
    int n;               /* nodes */
    unsigned char *held; /* (n) */
    double *load;        /* (n, 3) b_j */
    CpsiStretch stretch;
    CpsiRub rub;
    CpsiStop stop;
    /* iterate and direction at the nodes */
    double *u;        /* (n, 3) */
    double *du;       /* (n, 3) right-hand side, then direction */
    double *dt;       /* (n) direction of the tension unknowns (index 0 unused) */
    double *residual; /* (n, 3) imbalance of forces */
    CpsiMatrix matrix;
    const CpsiLinsysOps *ops;
    CpsiLinsys *linsys;
} CpsiProgram;

/* What a pass over the elements of one kind adds up. Step lengths are kept as inverses: the largest bounds the step. */
typedef struct CpsiSums {
    double inverse_step; /* 1/alpha of the nearest boundary */
    double weight;       /* sum of weights */
    double sz, first, second; /* sum w (s.z),  w (s.dz + z.ds),  w (ds.dz) */
    double residual;     /* largest |rho| */
    double scale;        /* sum w s0 z0 over the cones */
    double largest;      /* largest dual of a stretch or stop */
    double ray;          /* minus what the duals, as a ray, ask of the primal: > 0 speaks for infeasibility */
    double ray_cost;     /* sum l c T^2: > 0 where the ray strains what has compliance */
} CpsiSums;

/* Place a program for at most n nodes in the arena. */
void cpsi_program_layout(CpsiProgram *program, CpsiArena *arena, int n, const CpsiLinsysOps *ops);

/* The same seven steps for every kind (stretch.c, rub.c, stop.c):
 *
 *   start      a centred pair (s, z) near the iterate u, with s o z = mu e; z of a rub and s of a stretch keep their data
 *   measure    add up s.z and the residuals
 *   scale      scaling; add the condensed stiffness to the matrix; q of the predictor, s o z -> 0
 *   load       add the forces that q and the residuals put on the nodes to f; `keep` scales the residuals
 *   direct     direction (ds, dz) from du and dt; step to the boundary and sums
 *   correct    q of the corrector: s o z -> target e, less the second-order term of the predictor just taken
 *   advance    s += alpha ds, z += alpha dz */
void cpsi_stretch_start(CpsiProgram *program, double mu, double margin);
void cpsi_stretch_measure(CpsiProgram *program, CpsiSums *sums);
void cpsi_stretch_scale(CpsiProgram *program);
void cpsi_stretch_load(CpsiProgram *program, double keep);
void cpsi_stretch_direct(CpsiProgram *program, double keep, CpsiSums *sums);
void cpsi_stretch_correct(CpsiProgram *program, double target);
void cpsi_stretch_advance(CpsiProgram *program, double alpha);

void cpsi_rub_start(CpsiProgram *program, double mu);
void cpsi_rub_measure(CpsiProgram *program, CpsiSums *sums);
void cpsi_rub_scale(CpsiProgram *program);
void cpsi_rub_load(CpsiProgram *program);
void cpsi_rub_direct(CpsiProgram *program, CpsiSums *sums);
void cpsi_rub_correct(CpsiProgram *program, double target);
void cpsi_rub_advance(CpsiProgram *program, double alpha);

void cpsi_stop_start(CpsiProgram *program, double mu, double margin);
void cpsi_stop_measure(CpsiProgram *program, CpsiSums *sums);
void cpsi_stop_scale(CpsiProgram *program);
void cpsi_stop_load(CpsiProgram *program, double keep);
void cpsi_stop_direct(CpsiProgram *program, double keep, CpsiSums *sums);
void cpsi_stop_correct(CpsiProgram *program, double target);
void cpsi_stop_advance(CpsiProgram *program, double alpha);

#endif
