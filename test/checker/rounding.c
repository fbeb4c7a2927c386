/* SPDX-License-Identifier: BSD-3-Clause */
/* Rounding of coordinates (rounding.h). */
#include "rounding.h"

#include <math.h>

/* [-] What rounding makes of the strain of an elastic line: of its coordinates; and where no force
 * acts at all, so that it has no scale, a part of 1e-12. */
static double strain_of_rounding(const Record *r, const Measures *m) {
    if (!(r->compliance > 0)) return 0;
    double shortest = r->element_length[0];
    for (size_t i = 1; i < r->elements; i++) shortest = fmin(shortest, r->element_length[i]);
    return (m->largest_force > 0 ? 0 : 1e-12) + 4 * 2.3e-16 * 2 * m->reach / shortest;
}

double strain_energy_of_rounding(const Record *r, const Measures *m) {
    double strain = strain_of_rounding(r, m);
    return strain > 0 ? m->length * strain * strain / (2 * r->least_compliance) : 0;
}

/* Such a gap is a sum of coordinates, of the reference and now, and of contact_gap, each of which
 * is rounded where it is written. */
double contact_work_of_rounding(const Record *r, const Measures *m) {
    double reactions = 0;
    for (size_t c = 0; c < r->contacts * r->nodes; c++) reactions += fabs(r->reaction[c]);
    return 3 * 1.2e-16 * m->reach * reactions;
}

double tension_of_rounding(const Record *r, const Measures *m) {
    double strain = strain_of_rounding(r, m);
    return strain > 0 && m->largest_force > 0 ? strain / r->least_compliance : 0;
}
