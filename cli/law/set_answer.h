/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan law: sets as answers, as text and as JSON. */
#ifndef CAPSTAN_CLI_LAW_SET_ANSWER_H
#define CAPSTAN_CLI_LAW_SET_ANSWER_H

#include <stdio.h>

#include "capstan/io.h"
#include "capstan/law.h"

/* The description of a set: facts, extent along an orthonormal basis of its directions, vertices or
 * rays. */
typedef struct SetAnswer {
    int n;
    CpsSetFacts facts;
    double gap;         /* of the extents */
    double *centre;     /* (n) of the relative interior */
    double *basis;      /* (n x n), of which the first `dimension` rows are used */
    double *low, *high; /* (n) extent along them, of which the first `dimension` are used */
    int vertex_count;   /* -1: not known */
    double *vertex;     /* (vertex_count x n) */
    int ray_count;      /* -1: not known, or not a cone */
    double *ray;        /* (ray_count x n) unit generators */
    int lineality;      /* of a cone: dimension of the largest subspace in it */
    double *line;       /* (lineality x n) orthonormal */
    double *block;      /* memory of all arrays above */
} SetAnswer;

/* Describe a set (a cone if `cone`). Returns CPS_OK or the library's error; free with
 * law_answer_free. */
CpsStatus law_answer_ask(const CpsSet *set, bool cone, SetAnswer *answer, CpsError *err);
void law_answer_free(SetAnswer *answer);

/* "a segment from (..) to (..)", "all velocities between the directions (..) and (..)", ... */
void law_answer_print(const SetAnswer *answer, bool cone);
/* {"dimension": 1, "centre": [..], "vertices": [..], "extent": [..]} */
void law_answer_json(const SetAnswer *answer, bool cone, FILE *out);

void law_print_vector(int n, const double *x);           /* (1, 2) */
void law_json_number(double x, FILE *out);               /* null when not finite */
void law_json_vector(int n, const double *x, FILE *out); /* [1, 2] */

#endif
