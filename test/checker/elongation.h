/* SPDX-License-Identifier: BSD-3-Clause */
/* What an element's elongation costs, from tables of strain and tension as result.nc has them: EA
 * grows by spring_stiffness at spring_strain. */
#ifndef CAPSTAN_CHECKER_ELONGATION_H
#define CAPSTAN_CHECKER_ELONGATION_H

#include "record.h"

/* Read them; a line without any has none. 0, or -1 with a line in the log. */
int elongation_read(const Source *source, const char *line, Record *record, FILE *log);

void elongation_free(Record *record);

/* Which stiffness holds in a step, and its rest strains: from then on the functions below are of
 * these. 0, or -1 with a line in the log. */
int elongation_read_step(const Source *source, const char *line, size_t step, Record *record,
                         FILE *log);
/* Let the static or the dynamic stiffness hold; rest strains stay. */
void elongation_use(Record *record, bool is_dynamic);

/* Do the rest strains follow from the step before, NULL for the first? NULL, or what is wrong. A
 * dynamic stiffness holds about what the static one has reached before it. */
const char *elongation_rest_fault(const Record *r, const Record *before);
/* Have the forces changed before the step, by the static stiffness in place of the dynamic one? */
bool elongation_jumps(const Record *r, const Record *before);

/* The strain without tension, of element i. */
Real elongation_rest(const Record *r, size_t i);

/* [N] T at a strain, of element i. */
Real elongation_tension(const Record *r, size_t i, Real strain);
/* The strain at a tension. */
Real elongation_strain(const Record *r, size_t i, Real tension);
/* [N] Energy per length at a strain. */
Real elongation_energy(const Record *r, size_t i, Real strain);
/* [N] Energy at `strain`, and conjugate at `tension`, less their product. */
Real elongation_mismatch(const Record *r, size_t i, Real strain, Real tension);

#endif
