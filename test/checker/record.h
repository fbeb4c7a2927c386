/* SPDX-License-Identifier: BSD-3-Clause */
/* What the checker reads of one line: the constants of the line and one step at a time. */
#ifndef CAPSTAN_CHECKER_RECORD_H
#define CAPSTAN_CHECKER_RECORD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

/* flag values of the file, by docs/formats.md */
enum { OUTCOME_SOLVED, OUTCOME_TAUT, OUTCOME_STALLED, OUTCOME_LIMIT, OUTCOME_UNBOUNDED, OUTCOME_INFEASIBLE, OUTCOMES };
enum { END_HELD, END_FREE };

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
    CLAIM_STRETCH_RESIDUAL,
    CLAIM_PENETRATION,
    CLAIMS
};
extern const char *const CLAIM_NAME[CLAIMS];

typedef double Vector[3];

/* nodes 0..elements; element i joins node i and i + 1 here */
typedef struct Record {
    size_t nodes, elements;
    double *element_length, compliance;
    Vector *reference, *position, *load, *normal, *friction, *segment_force;
    double *gap, *friction_bound, *reaction, *tension;
    int end_kind[2], outcome, iterations;
    Vector end_value[2], proof;
    double proof_value, claim[CLAIMS], dissipated;
} Record;

/* An open file: its lines and how many steps they have. */
typedef struct Source {
    int nc;
    size_t steps, lines;
    char **line_name;
    double tolerance;
    bool consistent; /* friction bounds follow the reactions of the same step */
} Source;

/* All return 0, or -1 after one sentence on log. */
int source_open(const char *path, Source *source, FILE *log);
int record_create(const Source *source, const char *line, Record *record, FILE *log);
int record_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);

/* Both accept a zeroed struct. */
void source_close(Source *source);
void record_destroy(Record *record);

#endif
