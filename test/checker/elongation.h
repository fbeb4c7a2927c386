/* SPDX-License-Identifier: BSD-3-Clause */
/* What an element's elongation costs, from tables of strain and tension as result.nc has them: EA
 * grows by spring_stiffness at spring_strain. */
#ifndef CAPSTAN_CHECKER_ELONGATION_H
#define CAPSTAN_CHECKER_ELONGATION_H

#include "record.h"

/* Read them; a line without any has none. 0, or -1 with a line in the log. */
int elongation_read(const Source *source, const char *line, Record *record, FILE *log);

void elongation_free(Record *record);

/* [N] T at a strain, of element i. */
Real elongation_tension(const Record *r, size_t i, Real strain);
/* The strain at a tension. */
Real elongation_strain(const Record *r, size_t i, Real tension);
/* [N] Energy per length at a strain. */
Real elongation_energy(const Record *r, size_t i, Real strain);
/* [N] Energy at `strain`, and conjugate at `tension`, less their product. */
Real elongation_mismatch(const Record *r, size_t i, Real strain, Real tension);

#endif
