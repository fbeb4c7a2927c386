/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that were let go and lines that part, read and recomputed from a file (docs/results.md). */
#ifndef CAPSTAN_CHECKER_FAILURE_H
#define CAPSTAN_CHECKER_FAILURE_H

#include "record.h"

/* What the variable LINE_end_release says of an end. */
enum { RELEASE_NONE, RELEASE_STAGE, RELEASE_BREAK, RELEASE_TAKEN };

/* Read which steps are breaks; where the elements of a line break and part; which ends were let go.
 * A file of a scene that lets nothing go does not say. All return 0, or -1 after one sentence on
 * log. */
int failures_open(Source *source, FILE *log);
void failures_close(const Source *source);
int failure_create(const Source *source, const char *line, Record *record, FILE *log);
int failure_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);

/* Is the step a break? */
static inline bool is_break(const Source *source, size_t step) {
    return source->break_line && source->break_line[step] >= 0;
}

/* Was the end let go in this step? */
static inline bool is_let_go(const Record *r, const Record *before, int e) {
    return r->release[e] != before->release[e] &&
           (r->release[e] == RELEASE_STAGE || r->release[e] == RELEASE_BREAK);
}

/* The largest tension over break_at, 0 without one. */
double failure_share(const Record *r);
/* Is an end of the line held, or does a force act on it? */
bool failure_is_loaded(const Record *r);

/* Called with one sentence for each finding; `name` is that of the line. */
typedef void FailureFinding(void *user, const char *name, size_t step, const char *sentence);

/* Check all steps: what parts was above its break_at in the step before, by the largest factor;
 * nothing that is above stays whole; nothing else changes in a break. Returns 0, or -1 after one
 * sentence on log. */
int failures_check(const Source *source, FailureFinding *find, void *user, FILE *log);

#endif
