/* SPDX-License-Identifier: BSD-3-Clause */
/* The law of elongation (elongation.h). */
#include "elongation.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

static int complain(FILE *log, const char *what, const char *line) {
    if (log) fprintf(log, "%s of line '%s'\n", what, line);
    return -1;
}

static int read_variable(const Source *source, const char *line, const char *what, size_t count,
                         double *value) {
    char name[400];
    int id, rank, dimension[NC_MAX_VAR_DIMS];
    size_t size;
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    if (nc_inq_varid(source->nc, name, &id) || nc_inq_varndims(source->nc, id, &rank)) return -1;
    if (rank != 1 || nc_inq_vardimid(source->nc, id, dimension)) return -1;
    if (nc_inq_dimlen(source->nc, dimension[0], &size) || size != count) return -1;
    return nc_get_var_double(source->nc, id, value) ? -1 : 0;
}

/* Elements in order, strains rising within each, and what they do to the range of 1/EA. */
static int accept(Record *r, const double *element, const char *line, FILE *log) {
    size_t k = 0;
    r->least_compliance = INFINITY;
    for (size_t i = 0; i < r->elements; i++) {
        double stiffness = 1 / r->element_compliance[i];
        r->spring_of[i] = k;
        for (; k < r->springs && element[k] == (double)i; k++) {
            const double strain = r->spring_strain[k], more = r->spring_stiffness[k];
            const bool rises = strain > (k > r->spring_of[i] ? r->spring_strain[k - 1] : 0);
            if (!rises || !isfinite(strain) || !(more > 0) || !isfinite(more))
                return complain(log, "senseless springs", line);
            stiffness += more;
        }
        r->least_compliance = fmin(r->least_compliance, 1 / stiffness);
    }
    r->spring_of[r->elements] = k;
    return k == r->springs ? 0 : complain(log, "springs in no order", line);
}

int elongation_read(const Source *source, const char *line, Record *record, FILE *log) {
    char name[400];
    int id;
    snprintf(name, sizeof name, "%.200s_spring", line);
    if (nc_inq_dimid(source->nc, name, &id) != NC_NOERR) return 0;
    if (nc_inq_dimlen(source->nc, id, &record->springs) || record->springs == 0 ||
        record->springs / 100 > record->elements || !(record->compliance > 0))
        return complain(log, "senseless number of springs", line);
    double *element = calloc(record->springs, sizeof *element);
    record->spring_strain = calloc(record->springs, sizeof(double));
    record->spring_stiffness = calloc(record->springs, sizeof(double));
    record->spring_of = calloc(record->elements + 1, sizeof(size_t));
    int bad = 0;
    if (!element || !record->spring_strain || !record->spring_stiffness || !record->spring_of)
        bad = complain(log, "out of memory for springs", line);
    else if (read_variable(source, line, "spring_element", record->springs, element) ||
             read_variable(source, line, "spring_strain", record->springs, record->spring_strain) ||
             read_variable(source, line, "spring_stiffness", record->springs,
                           record->spring_stiffness))
        bad = complain(log, "missing or senseless springs", line);
    else
        bad = accept(record, element, line, log);
    free(element);
    return bad;
}

void elongation_free(Record *record) {
    free(record->spring_of);
    free(record->spring_strain);
    free(record->spring_stiffness);
}

static size_t first_of(const Record *r, size_t i) { return r->spring_of ? r->spring_of[i] : 0; }
static size_t end_of(const Record *r, size_t i) { return r->spring_of ? r->spring_of[i + 1] : 0; }

Real elongation_tension(const Record *r, size_t i, Real strain) {
    Real sum = strain / r->element_compliance[i];
    for (size_t k = first_of(r, i); k < end_of(r, i); k++)
        if (strain > r->spring_strain[k])
            sum += r->spring_stiffness[k] * (strain - r->spring_strain[k]);
    return sum;
}

/* From the strain without springs, where T is too large, Newton's method on this convex function
 * goes down from corner to corner, and ends on the piece of the tension. */
Real elongation_strain(const Record *r, size_t i, Real tension) {
    Real strain = tension * r->element_compliance[i];
    for (size_t pass = first_of(r, i); pass <= end_of(r, i); pass++) {
        Real slope = 1 / (Real)r->element_compliance[i];
        for (size_t k = first_of(r, i); k < end_of(r, i); k++)
            if (strain > r->spring_strain[k]) slope += r->spring_stiffness[k];
        strain -= (elongation_tension(r, i, strain) - tension) / slope;
    }
    return strain;
}

static Real square(Real x) { return x * x; }

Real elongation_energy(const Record *r, size_t i, Real strain) {
    Real sum = square(strain) / (2 * r->element_compliance[i]);
    for (size_t k = first_of(r, i); k < end_of(r, i); k++)
        if (strain > r->spring_strain[k])
            sum += r->spring_stiffness[k] * square(strain - r->spring_strain[k]) / 2;
    return sum;
}

/* Spring by spring W(x) - W(y) - W'(y) (x - y), y the strain at the tension. */
Real elongation_mismatch(const Record *r, size_t i, Real strain, Real tension) {
    const Real own = elongation_strain(r, i, tension);
    Real sum = square(strain - own) / (2 * r->element_compliance[i]);
    for (size_t k = first_of(r, i); k < end_of(r, i); k++) {
        const Real x = strain - r->spring_strain[k], y = own - r->spring_strain[k];
        Real part = 0;
        if (x > 0 && y > 0) part = square(x - y) / 2;
        if (x > 0 && y <= 0) part = square(x) / 2;
        if (x <= 0 && y > 0) part = y * (y / 2 - x);
        sum += r->spring_stiffness[k] * part;
    }
    return sum;
}
