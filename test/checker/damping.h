/* SPDX-License-Identifier: BSD-3-Clause */
/* The internal damping of a line in time: its tension is EA d + BA d', d' by the scheme, and not
 * negative, d the elongation of each element that the file tells. */
#ifndef CAPSTAN_CHECKER_DAMPING_H
#define CAPSTAN_CHECKER_DAMPING_H

#include "record.h"

typedef struct Damping {
    double coefficient; /* [N s] BA */
    double *compliance; /* (elements) [1/N] without damping */
    double least, largest;
    double *elongation; /* (elements) [-] d */
} Damping;

/* What the file has of a line; record->damping is NULL where that is nothing. After damping_read,
 * which follows the spans, the record has the law of elongation of its step. 0, or -1 with a line
 * in the log. */
int damping_create(const Source *source, const char *line, Record *record, FILE *log);
int damping_read(const Source *source, const char *line, size_t step, Record *record, FILE *log);
void damping_free(Record *record);

/* [1/N] Of element i, without damping. */
double damping_compliance(const Record *r, size_t i);

/* Of a step in time and the two before it, NULL: not known. The growth of the elastic energy and
 * what damping takes [J]; and by how much, at most, an elongation is off what follows from the
 * places, and the one at which tension begins off what follows from the elongations. */
typedef struct Damped {
    double stored, damped, elongation, rest;
} Damped;
Damped damping_measure(const Record *r, const Record *before, const Record *older);

#endif
