/* SPDX-License-Identifier: BSD-3-Clause */
/* Internal damping (damping.h). With d' = (d - d*)/k, d* by the scheme of the nodes, the tension is
 * (EA + BA/k) d - (BA/k) d*, where that is not negative. */
#include "damping.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

#include "formula.h"
#include "inertia.h"

static int complain(FILE *log, const char *what, const char *line) {
    if (log) fprintf(log, "%s of line '%s'\n", what, line);
    return -1;
}

int damping_create(const Source *source, const char *line, Record *record, FILE *log) {
    char name[400];
    size_t length;
    snprintf(name, sizeof name, "%.200s_damping", line);
    if (nc_inq_attlen(source->nc, NC_GLOBAL, name, &length) != NC_NOERR) return 0;
    Damping *damping = record->damping = calloc(1, sizeof *damping);
    if (!damping) return complain(log, "out of memory for the damping", line);
    damping->compliance = calloc(record->elements, sizeof(double));
    damping->elongation = calloc(record->elements, sizeof(double));
    record->rest_strain = calloc(record->elements, sizeof(double));
    if (!damping->compliance || !damping->elongation || !record->rest_strain)
        return complain(log, "out of memory for the damping", line);
    if (length != 1 || nc_get_att_double(source->nc, NC_GLOBAL, name, &damping->coefficient) ||
        !(damping->coefficient > 0) || !isfinite(damping->coefficient) ||
        !(record->compliance > 0) || record->springs > 0 || record->has_dynamic || !record->mass)
        return complain(log, "senseless damping", line);
    for (size_t i = 0; i < record->elements; i++)
        damping->compliance[i] = record->element_compliance[i];
    damping->least = record->least_compliance;
    damping->largest = record->largest_compliance;
    return 0;
}

void damping_free(Record *record) {
    if (!record->damping) return;
    free(record->damping->compliance);
    free(record->damping->elongation);
    free(record->damping);
    record->damping = NULL;
}

/* [s] k of element i, which is that of the slower of its nodes. */
static double span_of(const Record *r, size_t i) { return fmax(r->span[i], r->span[i + 1]); }

static int read_elements(const Source *source, const char *line, const char *what, size_t step,
                         size_t count, double *out) {
    char name[400];
    int id;
    const size_t start[] = {step, 0}, size[] = {1, count};
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    if (nc_inq_varid(source->nc, name, &id) || nc_get_vara_double(source->nc, id, start, size, out))
        return -1;
    for (size_t i = 0; i < count; i++)
        if (!(out[i] >= 0 && isfinite(out[i]))) return -1;
    return 0;
}

int damping_read(const Source *source, const char *line, size_t step, Record *record, FILE *log) {
    Damping *damping = record->damping;
    if (!damping) return 0;
    if (read_elements(source, line, "elongation", step, record->elements, damping->elongation) ||
        read_elements(source, line, "elongation_rest", step, record->elements, record->rest_strain))
        return complain(log, "missing or senseless elongations", line);
    for (size_t i = 0; i < record->elements; i++) {
        const double own = 1 / damping->compliance[i];
        if (!in_time(record)) record->rest_strain[i] = 0;
        const double c = record->element_compliance[i] =
            in_time(record) ? 1 / (own + damping->coefficient / span_of(record, i))
                            : damping->compliance[i];
        record->least_compliance = i == 0 ? c : fmin(record->least_compliance, c);
        record->largest_compliance = i == 0 ? c : fmax(record->largest_compliance, c);
    }
    return 0;
}

double damping_compliance(const Record *r, size_t i) {
    return r->damping ? r->damping->compliance[i] : r->element_compliance[i];
}

static Real strain_of(const Record *r, size_t i) {
    Real square = 0;
    for (int a = 0; a < 3; a++) {
        const Real d = (Real)r->position[i + 1][a] - r->position[i][a];
        square += d * d;
    }
    return sqrtl(square) / r->element_length[i] - 1;
}

/* d of element i after a step. */
static Real elongation_of(const Record *r, size_t i) {
    return in_time(r) ? (Real)r->damping->elongation[i] : fmaxl(0, strain_of(r, i));
}

Damped damping_measure(const Record *r, const Record *before, const Record *older) {
    Damped out = {0};
    Real stored = 0, damped = 0;
    const double h = r->step_length;
    for (size_t i = 0; i < r->elements; i++) {
        const double k = span_of(r, i);
        const Real d = r->damping->elongation[i], from = elongation_of(before, i),
                   stiffness = 1 / (Real)r->damping->compliance[i],
                   viscous = r->damping->coefficient / (Real)k, l = r->element_length[i];
        const bool euler = formula_is_euler(k, h);
        const Real back = formula_of(k, h, before->step_length).back,
                   past = older ? elongation_of(older, i) : 0,
                   start = euler ? from : fmaxl(0, from + back * (from - past));
        stored += l * stiffness * (d - from) * (d + from) / 2;
        /* where the first step of the file began is not in it: by the elongation of rest */
        const Real known = euler || older || !in_time(before)
                               ? start
                               : r->rest_strain[i] * (stiffness + viscous) / viscous;
        damped += l * viscous * (d - known) * (d - from);
        out.rest = fmax(out.rest,
                        (double)fabsl(r->rest_strain[i] - viscous * known / (stiffness + viscous)));
        out.elongation =
            fmax(out.elongation, (double)fabsl(d - fmaxl(r->rest_strain[i], strain_of(r, i))) *
                                     r->element_length[i]);
    }
    out.stored = (double)stored;
    out.damped = (double)damped;
    return out;
}
