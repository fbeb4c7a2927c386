/* SPDX-License-Identifier: BSD-3-Clause */
/* The conic form of a set and the solver on it.
 *
 * Every expression without user's sets is { x : exists y, E (x, y) = e, A (x, y) + b in K }, K a
 * product of half-lines and second-order cones, built node by node (conic_rows.c): "X in t C" for
 * affine X and t of the unknowns is a list of rows for each kind of C. Eliminating the equations by
 * an orthonormal basis of their null space gives the reduced form
 *
 *     C = { origin + P v + Q' l :  A v + b in K },     A of full column rank, l free,
 *
 * on which every query is a small conic program in v. */
#ifndef CAPSTAN_SRC_SET_CONIC_FORM_H
#define CAPSTAN_SRC_SET_CONIC_FORM_H

#include <stdbool.h>

#include "capstan/set.h"

/* Reduced form; one block of memory. */
typedef struct CpsiConicForm {
    int n;        /* of x */
    int unknowns; /* of v */
    int lines;    /* rows of Q: directions of lines contained in the set */
    int rows, cones, largest_cone;
    bool empty;     /* the equations contradict each other */
    int *dim;       /* (cones) */
    double *origin; /* (n) */
    double *p;      /* (n, unknowns) */
    double *q;      /* (lines, n) orthonormal */
    double *a, *b;  /* (rows, unknowns), (rows): the rows of each cone are scaled to size one */
    double size;    /* unit of length of v */
} CpsiConicForm;

/* Rows over unknowns (x, y) while an expression is being written. An affine expression is `width`
 * numbers: the coefficients of the unknowns and then the constant. */
typedef struct CpsiConicRows {
    int unknowns, width;        /* width = unknowns + 1 */
    int equations, rows, cones; /* written so far */
    int next;                   /* first unknown not yet used */
    double *equation;           /* (equations, width) = 0 */
    double *row;                /* (rows, width) in K */
    int *dim;                   /* (cones) */
    double constant;            /* largest one that occurred in an equation, before cancellation */
    int max_equations, max_rows, max_cones;
} CpsiConicRows;

/* Sizes that an expression needs. */
typedef struct CpsiCount {
    size_t unknowns, equations, rows, cones;
} CpsiCount;

/* Add the sizes that the rows of a set need. */
void cpsi_conic_rows_count(const CpsSet *set, CpsiCount *count);
/* Memory for `count`; CPS_ERR_LIMIT where that is too large for a dense solver. The first `used`
 * unknowns are the caller's. */
CpsStatus cpsi_conic_rows_new(CpsiCount count, int used, CpsiConicRows **out, CpsError *err);
void cpsi_conic_rows_free(CpsiConicRows *conic);
/* The next equation; the next cone's `dim` rows; all zero. */
double *cpsi_conic_rows_equation(CpsiConicRows *conic);
double *cpsi_conic_rows_cone(CpsiConicRows *conic, int dim);
/* Write "X in t set": X (set's n, width) and t (width) affine; the closure at t = 0. Returns false
 * when memory does not suffice. */
bool cpsi_conic_rows_write(CpsiConicRows *conic, const CpsSet *set, const double *x,
                           const double *t);

/* The reduced form of { x (n, width) : the rows }. A row of the equations counts as dependent when
 * no more than the share `tolerance` of it remains after subtracting the others. `lines` more rows
 * q (lines, n) or NULL are directions known to be lines. */
CpsStatus cpsi_conic_form_reduce(const CpsiConicRows *conic, int n, const double *x, int lines,
                                 const double *q, double tolerance, CpsiConicForm **out,
                                 CpsError *err);
/* The reduced form of `scale` times a set, at 0 of its recession cone; the caller frees it
 * (conic_make.c). */
CpsStatus cpsi_conic_form_make(const CpsSet *set, double scale, CpsiConicForm **out, CpsError *err);
/* A form of zeros with memory for these numbers of unknowns, lines, rows and cones; NULL when
 * memory does not suffice. */
CpsiConicForm *cpsi_conic_form_new(int n, int unknowns, int lines, int rows, int cones);
void cpsi_conic_form_free(CpsiConicForm *form);

/* A solution of  min <c, x>  over the form. */
typedef struct CpsiSolution {
    CpsSetOutcome outcome; /* ANSWERED, EMPTY, UNBOUNDED (x is a ray with <c, x> < 0), INACCURATE */
    double value, gap;
    double scale;        /* z belongs to the objective c/scale */
    double *x;           /* (n) */
    const double *v;     /* (unknowns) */
    const double *s, *z; /* (rows) */
    void *block;
} CpsiSolution;
CpsStatus cpsi_conic_form_minimise(const CpsiConicForm *form, const double *c,
                                   CpsiSolution *solution, CpsError *err);
void cpsi_solution_free(CpsiSolution *solution);
/* Change the outcome to CPS_SET_OUTCOME_NOT_ATTAINED where the point that attains the value is too
 * far away to count as a point. */
void cpsi_check_attained(const CpsiConicForm *form, const double *c, CpsiSolution *solution);

/* Accuracy of the solver's z: the square root of its complementarity. Smaller angles cannot be
 * distinguished from 0 on a conic form. */
#define CPSI_LEAST_ANGLE 3e-8
/* Equations of a face that differ by less than this share are the same, since the directions of z
 * have this accuracy. */
#define CPSI_SAME_EQUATION 1e-7
/* The part of the form on the face of its cones that the multipliers z of `at` select, each
 * accurate to `angle`, written relative to the point with s and x (restrict.c). */
CpsStatus cpsi_conic_form_restrict(const CpsiConicForm *form, const CpsiSolution *at, double angle,
                                   CpsiConicForm **out, CpsError *err);
/* Replace a form without interior by one over the faces of its cones that it lies in, and set
 * *touching to true then (touching.c). */
CpsStatus cpsi_conic_form_reduce_to_face(CpsiConicForm **form, bool *touching, CpsError *err);

#endif
