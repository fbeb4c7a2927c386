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

/* The springs of a stiffness; one without any has none. */
static int read_springs(const Source *source, const char *line, const char *of, Record *record,
                        FILE *log) {
    char name[400], what[3][64];
    int id;
    snprintf(name, sizeof name, "%.200s_%sspring", line, of);
    if (nc_inq_dimid(source->nc, name, &id) != NC_NOERR) return 0;
    if (nc_inq_dimlen(source->nc, id, &record->springs) || record->springs == 0 ||
        record->springs / 100 > record->elements || !(record->compliance > 0))
        return complain(log, "senseless number of springs", line);
    snprintf(what[0], sizeof what[0], "%sspring_element", of);
    snprintf(what[1], sizeof what[1], "%sspring_strain", of);
    snprintf(what[2], sizeof what[2], "%sspring_stiffness", of);
    double *element = calloc(record->springs, sizeof *element);
    record->spring_strain = calloc(record->springs, sizeof(double));
    record->spring_stiffness = calloc(record->springs, sizeof(double));
    record->spring_of = calloc(record->elements + 1, sizeof(size_t));
    int bad = 0;
    if (!element || !record->spring_strain || !record->spring_stiffness || !record->spring_of)
        bad = complain(log, "out of memory for springs", line);
    else if (read_variable(source, line, what[0], record->springs, element) ||
             read_variable(source, line, what[1], record->springs, record->spring_strain) ||
             read_variable(source, line, what[2], record->springs, record->spring_stiffness))
        bad = complain(log, "missing or senseless springs", line);
    else
        bad = accept(record, element, line, log);
    free(element);
    return bad;
}

/* ---- two stiffnesses ---- */

static void keep(Record *r, bool is_dynamic) {
    r->elasticity[is_dynamic] =
        (Elasticity){r->element_compliance, r->least_compliance, r->largest_compliance, r->springs,
                     r->spring_of,          r->spring_strain,    r->spring_stiffness};
}

void elongation_use(Record *r, bool is_dynamic) {
    const Elasticity *own = &r->elasticity[is_dynamic];
    if (!r->has_dynamic) return;
    r->is_dynamic = is_dynamic;
    r->element_compliance = own->element_compliance;
    r->least_compliance = own->least_compliance;
    r->largest_compliance = own->largest_compliance;
    r->springs = own->springs;
    r->spring_of = own->spring_of;
    r->spring_strain = own->spring_strain;
    r->spring_stiffness = own->spring_stiffness;
}

static int read_dynamic(const Source *source, const char *line, Record *r, FILE *log) {
    char name[400];
    int id;
    snprintf(name, sizeof name, "%.200s_dynamic_compliance_factor", line);
    if (nc_inq_varid(source->nc, name, &id) != NC_NOERR) return 0;
    keep(r, false);
    r->has_dynamic = true;
    r->springs = 0;
    r->spring_of = NULL;
    r->spring_strain = r->spring_stiffness = NULL;
    r->element_compliance = calloc(r->elements, sizeof(double));
    r->rest_strain = calloc(r->elements, sizeof(double));
    int bad = 0;
    if (!r->element_compliance || !r->rest_strain)
        bad = complain(log, "out of memory for the dynamic stiffness", line);
    else if (!(r->compliance > 0) || read_variable(source, line, "dynamic_compliance_factor",
                                                   r->elements, r->element_compliance))
        bad = complain(log, "missing or senseless dynamic stiffness", line);
    for (size_t i = 0; i < r->elements && !bad; i++) {
        double *c = &r->element_compliance[i];
        if (!(*c > 0) || !isfinite(*c)) bad = complain(log, "senseless dynamic stiffness", line);
        *c *= r->compliance;
        r->least_compliance = i == 0 ? *c : fmin(r->least_compliance, *c);
        r->largest_compliance = i == 0 ? *c : fmax(r->largest_compliance, *c);
    }
    if (!bad) bad = read_springs(source, line, "dynamic_", r, log);
    keep(r, true);
    elongation_use(r, false);
    return bad;
}

int elongation_read(const Source *source, const char *line, Record *record, FILE *log) {
    return read_springs(source, line, "", record, log) || read_dynamic(source, line, record, log)
               ? -1
               : 0;
}

int elongation_read_step(const Source *source, const char *line, size_t step, Record *record,
                         FILE *log) {
    if (!record->has_dynamic) return 0;
    const size_t start[] = {step, 0}, count[] = {1, record->elements};
    signed char which = 0;
    char name[2][400];
    int id[2];
    snprintf(name[0], sizeof name[0], "%.200s_stiffness", line);
    snprintf(name[1], sizeof name[1], "%.200s_rest_strain", line);
    if (nc_inq_varid(source->nc, name[0], &id[0]) || nc_inq_varid(source->nc, name[1], &id[1]) ||
        nc_get_var1_schar(source->nc, id[0], start, &which) ||
        nc_get_vara_double(source->nc, id[1], start, count, record->rest_strain) || which < 0 ||
        which > 1)
        return complain(log, "missing or senseless stiffness", line);
    for (size_t i = 0; i < record->elements; i++)
        if (!(record->rest_strain[i] >= 0 && isfinite(record->rest_strain[i])))
            return complain(log, "senseless rest strain", line);
    elongation_use(record, which == 1);
    return 0;
}

bool elongation_jumps(const Record *r, const Record *before) {
    return r->has_dynamic && !r->is_dynamic && before->is_dynamic;
}

/* |x'| - 1 of element i, and what the rounding of coordinates makes of it. */
static Real strain_of(const Record *r, Vector *place, size_t i, Real *noise) {
    Real square = 0, reach = 0;
    for (int k = 0; k < 3; k++) {
        const Real d = (Real)place[i + 1][k] - place[i][k];
        square += d * d;
        reach += fabsl((Real)place[i + 1][k]) + fabsl((Real)place[i][k]);
    }
    *noise = 0x1p-50L * (1 + reach / r->element_length[i]);
    return sqrtl(square) / r->element_length[i] - 1;
}

const char *elongation_rest_fault(const Record *r, const Record *before) {
    if (!r->has_dynamic) return NULL;
    const bool goes_on = before && before->is_dynamic;
    /* where the first step began is its reference, where it was taken whole */
    Vector *place = before ? before->position : r->substeps == 1 ? r->reference : NULL;
    Record slow = *r, fast = *r;
    elongation_use(&slow, false);
    elongation_use(&fast, true);
    slow.rest_strain = fast.rest_strain = NULL;
    for (size_t i = 0; i < r->elements; i++) {
        Real noise = 0, expected = 0;
        if (!r->is_dynamic) {
            if (r->rest_strain[i] != 0) return "rest strains by the static stiffness";
            continue;
        }
        if (goes_on) {
            if (r->rest_strain[i] != before->rest_strain[i])
                return "rest strains that change while the dynamic stiffness holds";
            continue;
        }
        if (!place) return NULL;
        const Real strain = strain_of(r, place, i, &noise);
        if (strain > 0)
            expected = strain - elongation_strain(&fast, i, elongation_tension(&slow, i, strain));
        if (!(fabsl(r->rest_strain[i] - expected) <= noise))
            return "rest strains that are not those of the state reached before";
    }
    return NULL;
}

Real elongation_rest(const Record *r, size_t i) { return r->rest_strain ? r->rest_strain[i] : 0; }

static void free_springs(size_t *spring_of, double *strain, double *stiffness) {
    free(spring_of);
    free(strain);
    free(stiffness);
}

void elongation_free(Record *record) {
    if (record->has_dynamic) {
        const Elasticity *other = &record->elasticity[!record->is_dynamic];
        free(other->element_compliance);
        free_springs(other->spring_of, other->spring_strain, other->spring_stiffness);
    }
    free(record->rest_strain);
    free(record->element_compliance);
    free_springs(record->spring_of, record->spring_strain, record->spring_stiffness);
}

static size_t first_of(const Record *r, size_t i) { return r->spring_of ? r->spring_of[i] : 0; }
static size_t end_of(const Record *r, size_t i) { return r->spring_of ? r->spring_of[i + 1] : 0; }

Real elongation_tension(const Record *r, size_t i, Real strain) {
    strain -= elongation_rest(r, i);
    Real sum = strain / r->element_compliance[i];
    for (size_t k = first_of(r, i); k < end_of(r, i); k++)
        if (strain > r->spring_strain[k])
            sum += r->spring_stiffness[k] * (strain - r->spring_strain[k]);
    return sum;
}

/* From the strain without springs, where T is too large, Newton's method on this convex function
 * goes down from corner to corner, and ends on the piece of the tension. */
Real elongation_strain(const Record *r, size_t i, Real tension) {
    const Real rest = elongation_rest(r, i); /* added in the end */
    Real strain = tension * r->element_compliance[i];
    for (size_t pass = first_of(r, i); pass <= end_of(r, i); pass++) {
        Real slope = 1 / (Real)r->element_compliance[i];
        for (size_t k = first_of(r, i); k < end_of(r, i); k++)
            if (strain > r->spring_strain[k]) slope += r->spring_stiffness[k];
        strain -= (elongation_tension(r, i, strain + rest) - tension) / slope;
    }
    return strain + rest;
}

static Real square(Real x) { return x * x; }

Real elongation_energy(const Record *r, size_t i, Real strain) {
    strain -= elongation_rest(r, i);
    Real sum = square(strain) / (2 * r->element_compliance[i]);
    for (size_t k = first_of(r, i); k < end_of(r, i); k++)
        if (strain > r->spring_strain[k])
            sum += r->spring_stiffness[k] * square(strain - r->spring_strain[k]) / 2;
    return sum;
}

/* Spring by spring W(x) - W(y) - W'(y) (x - y), y the strain at the tension. */
Real elongation_mismatch(const Record *r, size_t i, Real strain, Real tension) {
    const Real own = elongation_strain(r, i, tension) - elongation_rest(r, i);
    strain -= elongation_rest(r, i);
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
