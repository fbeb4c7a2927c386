/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps in time (inertia.h).
 *
 * The scheme of a node follows from three places and the lengths of two steps (formula.h). A node
 * that bore in the step before may have forgotten its motion along the normal: there only the
 * tangential part is compared. */
#include "inertia.h"

#include <float.h>
#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

#include "damping.h"
#include "elongation.h"
#include "formula.h"
#include "grasps.h"
#include "loads.h"
#include "soft.h"

/* Rounding of places, per largest coordinate; of energies, per their sizes. */
static const double PLACES = 1e-13, ENERGIES = 1e-9;

static int variable(const Source *source, const char *line, const char *what) {
    char name[400];
    int id;
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    return nc_inq_varid(source->nc, name, &id) == NC_NOERR ? id : -1;
}

static int complain(FILE *log, const char *what, const char *line) {
    if (log) fprintf(log, "%s of line '%s'\n", what, line);
    return -1;
}

int inertia_create(const Source *source, const char *line, Record *record, FILE *log) {
    const int id = variable(source, line, "node_mass");
    if (id < 0) return 0;
    record->mass = calloc(record->nodes, sizeof(double));
    record->span = calloc(record->nodes, sizeof(double));
    record->velocity = calloc(record->nodes, sizeof(Vector));
    record->rest_velocity = calloc(record->nodes, sizeof(Vector));
    if (!record->mass || !record->span || !record->velocity || !record->rest_velocity)
        return complain(log, "out of memory for the motion", line);
    if (nc_get_var_double(source->nc, id, record->mass))
        return complain(log, "missing masses", line);
    for (size_t j = 0; j < record->nodes; j++)
        if (!(record->mass[j] > 0 && isfinite(record->mass[j])))
            return complain(log, "senseless masses", line);
    return 0;
}

int inertia_read(const Source *source, const char *line, size_t step, Record *record, FILE *log) {
    static const char *const NUMBER[TIME_ENTRIES] = {"kinetic",         "ledger_kinetic",
                                                     "ledger_impact",   "ledger_scheme",
                                                     "ledger_settling", "ledger_damping",
                                                     "ledger_drag",     "ledger_added",
                                                     "ledger_waves"};
    if (!record->mass) return 0;
    const size_t start[] = {step, 0, 0}, count[] = {1, record->nodes, 3};
    int time, length;
    if (nc_inq_varid(source->nc, "time", &time) ||
        nc_get_var1_double(source->nc, time, start, &record->time) ||
        nc_inq_varid(source->nc, "time_step", &length) ||
        nc_get_var1_double(source->nc, length, start, &record->step_length) ||
        nc_get_vara_double(source->nc, variable(source, line, "span"), start, count,
                           record->span) ||
        nc_get_vara_double(source->nc, variable(source, line, "velocity"), start, count,
                           record->velocity[0]) ||
        nc_get_vara_double(source->nc, variable(source, line, "rest_velocity"), start, count,
                           record->rest_velocity[0]))
        return complain(log, "missing motion", line);
    for (int k = 0; k < TIME_ENTRIES; k++)
        if (nc_get_var1_double(source->nc, variable(source, line, NUMBER[k]), start,
                               &record->time_entry[k]))
            return complain(log, "missing energies of the motion", line);
    double ends;
    if (nc_get_var1_double(source->nc, variable(source, line, "velocity_given"), start, &ends) ||
        !(ends == 0 || ends == 1 || ends == 2 || ends == 3))
        return complain(log, "missing or senseless velocity_given", line);
    for (int e = 0; e < 2; e++) record->velocity_given[e] = ((int)ends >> e) & 1;
    return 0;
}

void inertia_free(Record *record) {
    free(record->mass);
    free(record->span);
    free(record->velocity);
    free(record->rest_velocity);
}

void inertia_times(const Source *source, InertiaFind *find, void *user) {
    int time, length;
    double now = 0, before = 0, step = 0;
    if (nc_inq_varid(source->nc, "time", &time) || nc_inq_varid(source->nc, "time_step", &length))
        return;
    for (size_t s = 0; s < source->steps; s++) {
        if (nc_get_var1_double(source->nc, time, &s, &now) ||
            nc_get_var1_double(source->nc, length, &s, &step) ||
            !(fabs(step - (now - before)) <= 1e-14 * now)) /* a sum of steps */
            find(user, "time_step is not by how much time has passed", step, now - before);
        before = now;
    }
}

bool in_time(const Record *r) { return r->mass && r->span[0] > 0; }

void inertia_add(const Record *r, size_t j, Real *sum) {
    if (!in_time(r)) return;
    for (int a = 0; a < 3; a++) {
        const Real speed = ((Real)r->position[j][a] - r->reference[j][a]) / r->span[j];
        sum[a] -= r->mass[j] * (speed - r->rest_velocity[j][a]) / r->span[j];
    }
}

bool inertia_terms(const Record *r, size_t j, bool held, Real *pull, Inertia *out) {
    if (!in_time(r)) return false;
    const Real stiffness = (Real)r->mass[j] / ((Real)r->span[j] * r->span[j]);
    Real open = 0, square = 0;
    *out = (Inertia){0};
    inertia_add(r, j, out->force);
    for (int k = 0; k < 3; k++) {
        pull[k] += out->force[k];
        square += out->force[k] * out->force[k];
        out->taken[k] = out->force[k];
        if (held) continue;
        open += pull[k] * pull[k];
        out->taken[k] -= pull[k];
        pull[k] = 0;
    }
    out->energy = square / (2 * stiffness);
    out->gap = open / (2 * stiffness);
    return true;
}

/* Of m ((x - x*)/k - v*)/k, x and x* known to a rounding of the coordinates. */
double inertia_rounding(const Record *r, int e) {
    const size_t j = e ? r->elements : 0;
    double reach = 0;
    if (!in_time(r)) return 0;
    for (int a = 0; a < 3; a++) reach += fabs(r->position[j][a]) + fabs(r->reference[j][a]);
    return DBL_EPSILON * reach * r->mass[j] / (r->span[j] * r->span[j]);
}

/* Take the part along the unit vector n off v; returns the size of what is left. */
static Real take_off(const Real *n, Real *v) {
    Real along = 0, left = 0;
    for (int a = 0; a < 3; a++) along += v[a] * n[a];
    for (int a = 0; a < 3; a++) {
        v[a] -= along * n[a];
        left += v[a] * v[a];
    }
    return sqrtl(left);
}

void inertia_across(const Source *source, const Record *r, size_t j, double faint, Real *v) {
    Real first[3];
    bool any = false;
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes) {
        if (!(r->reaction[c] > faint) || source->surface[(size_t)r->obstacle[c]].gives > 0)
            continue;
        Real n[3] = {r->normal[c][0], r->normal[c][1], r->normal[c][2]};
        const Real sine = any ? take_off(first, n) : 1;
        for (int a = 0; a < 3; a++) {
            n[a] = sine > 1e-6L ? n[a] / sine : 0;
            if (!any) first[a] = n[a];
        }
        take_off(n, v);
        any = true;
    }
}

static double size_of(const Real *v) {
    return (double)sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* How far the reference of node j is from that of its scheme. */
static double off_scheme(const Source *source, const Record *r, const Record *before,
                         const Record *older, size_t j, Real back) {
    Real off[3];
    for (int a = 0; a < 3; a++) {
        const Real x = before->position[j][a], past = older ? older->position[j][a] : x;
        off[a] = r->reference[j][a] - x - back * (x - past);
    }
    if (back > 0) inertia_across(source, before, j, 0, off);
    return size_of(off);
}

/* Is node j an end whose velocity the caller gave? Then x* is not that of the scheme but the place
 * from which the velocity leads to the place imposed, and the velocity is compared with the scene
 * (given_velocities.c); that it is (x - x*)/k is checked of all nodes alike. */
static bool has_given_velocity(const Record *r, size_t j) {
    return (j == 0 && r->velocity_given[0]) || (j == r->elements && r->velocity_given[1]);
}

/* Is node j an end at a point? That has its own check (joint_motion.h), and its normal. */
static bool is_at_point(const Record *r, size_t j) {
    return (j == 0 && r->end_point[0] >= 0) || (j == r->elements && r->end_point[1] >= 0);
}

/* The share of the step in which the scheme has obstacles move: all of it where none does. */
static double moving_share(const Source *source, const Record *r) {
    for (size_t k = 0; k < source->surfaces; k++)
        if (r->turn[k] != 0 || surface_moves(&source->surface[k]))
            return r->span[0] / r->step_length;
    return 1;
}

static void check_scheme(const Source *source, const Record *r, const Record *before,
                         const Record *older, double reach, InertiaFind *find, void *user) {
    const double h = r->step_length;
    double off = 0, span = 0;
    for (size_t j = 0; j < r->nodes; j++) {
        const bool euler = formula_is_euler(r->span[j], h);
        const Formula formula = formula_of(r->span[j], h, before->step_length);
        span = fmax(span, fabs(r->span[j] - (double)formula.span) / h);
        /* where the first step of the file began is not in it */
        const bool unknown = !euler && !older && in_time(before);
        if (!is_at_point(r, j) && !has_given_velocity(r, j) && !unknown)
            off = fmax(off, off_scheme(source, r, before, older, j, formula.back));
    }
    for (int e = 0; e < 2; e++)
        if (r->velocity_given[e] && r->end_kind[e] != END_HELD && r->end_point[e] < 0)
            find(user, "given velocity of an end that is not held", e, 0);
    const double share = moving_share(source, r);
    if (!(fabs(r->share - share) <= FORMULA_TIMES))
        find(user, "share of the step in which the ground moves", r->share, share);
    if (!(span <= FORMULA_TIMES)) find(user, "span of the scheme, off", span, 0);
    if (!(off <= PLACES * reach)) find(user, "reference off that of the scheme", off, 0);
}

/* Does the contact of element i, or i - 1, touch node j? Its velocity is then changed with that. */
static bool is_beside_element(const Record *r, size_t j) {
    if (!r->has_elements) return false;
    for (size_t i = j > 0 ? j - 1 : 0; i <= j && i < r->elements; i++)
        if (r->obstacle[r->contacts * r->nodes + i] >= 0) return true;
    return false;
}

/* [J] of the velocities of the file; these are those of the positions but along normals. */
static double kinetic_energy(const Source *source, const Record *r, double reach, InertiaFind *find,
                             void *user) {
    Real sum = 0;
    double off = 0;
    for (size_t j = 0; j < r->nodes; j++) {
        Real v[3];
        for (int a = 0; a < 3; a++) {
            const Real own = r->velocity[j][a];
            sum += own * own * r->mass[j] / 2;
            v[a] = (own - ((Real)r->position[j][a] - r->reference[j][a]) / r->span[j]);
        }
        inertia_across(source, r, j, 0, v);
        if (!is_beside_element(r, j) && !is_at_point(r, j))
            off = fmax(off, size_of(v) * r->span[j]);
    }
    if (!(off <= PLACES * reach)) find(user, "velocity off that of the positions, times k", off, 0);
    return (double)sum;
}

/* [J] What the forces on the nodes do on their way, and the energies that are stored. */
typedef struct Works {
    double elastic, soft, gravity, ends, drag, added, waves, loads, sizes;
} Works;

static double stored(const Record *r, const Vector *x, size_t i) {
    Real l = r->element_length[i], square = 0;
    for (int a = 0; a < 3; a++)
        square += ((Real)x[i + 1][a] - x[i][a]) * ((Real)x[i + 1][a] - x[i][a]);
    const Real strain = sqrtl(square) / l - 1;
    return r->compliance > 0
               ? (double)(l * elongation_energy(r, i, fmaxl(strain, elongation_rest(r, i))))
               : 0;
}

static Works works_of(const Source *source, const Record *r, const Record *before) {
    Works w = {0};
    for (size_t i = 0; i < r->elements; i++)
        w.elastic += stored(r, (const Vector *)r->position, i) -
                     stored(r, (const Vector *)before->position, i);
    for (size_t j = 0; j < r->nodes; j++) {
        if (!node_is_held(r, j))
            w.soft += (double)soft_growth(source, r, j, before->position[j], 1);
        const Flow flow = loads_flow(r, j);
        for (int a = 0; a < 3; a++) {
            double load = r->load[j][a];
            const double way = r->position[j][a] - before->position[j][a];
            for (int e = 0; e < 2; e++) {
                if (j != (e ? r->elements : 0)) continue;
                if (r->end_kind[e] == END_FREE) load -= r->applied_force[e][a];
                w.ends += r->end_force[e][a] * way;
            }
            if (r->loads && r->loads->given) {
                const double given = r->loads->given[j][a];
                load -= given;
                w.drag -= (double)flow.drag[a] * way;
                w.added -= (double)flow.added[a] * way;
                w.waves += (double)flow.wave[a] * way;
                w.loads += (given - (double)(flow.drag[a] + flow.added[a] + flow.wave[a])) * way;
                w.sizes += fabs(given * way) + fabs((double)flow.drag[a] * way) +
                           fabs((double)flow.wave[a] * way);
            }
            w.gravity -= load * way;
            w.sizes += fabs(load * way);
        }
    }
    return w;
}

static void compare(const char *what, double said, double expected, double noise, InertiaFind *find,
                    void *user) {
    if (!(fabs(said - expected) <= noise)) find(user, what, said, expected);
}

void inertia_check(const Source *source, const Record *r, const Record *before, const Record *older,
                   InertiaFind *find, void *user) {
    const double given = r->loads ? r->loads->ledger : 0;
    double reach = 0, sizes = fabs(r->dissipated) + fabs(given);
    if (!in_time(r) || !before || r->outcome > OUTCOME_TAUT) return;
    for (size_t j = 0; j < r->nodes; j++)
        for (int a = 0; a < 3; a++) reach = fmax(reach, fabs(r->position[j][a]));
    check_scheme(source, r, before, in_time(before) ? older : NULL, reach, find, user);
    const double kinetic = kinetic_energy(source, r, reach, find, user);
    for (int k = 0; k < LEDGER_ENTRIES; k++) sizes += fabs(r->ledger[k]);
    for (int k = 0; k < TIME_ENTRIES; k++) sizes += fabs(r->time_entry[k]);
    /* works are known to the rounding of places under the forces */
    const double noise = ENERGIES * sizes + PLACES * reach * r->claim[CLAIM_LARGEST_FORCE] + 1e-300;
    compare("kinetic energy", r->time_entry[TIME_KINETIC], kinetic, noise, find, user);
    if (in_time(before))
        compare("growth of the kinetic energy", r->time_entry[TIME_GROWTH],
                kinetic - before->time_entry[TIME_KINETIC], noise, find, user);
    const double spent = r->ledger[LEDGER_ELASTIC] + r->ledger[LEDGER_GRAVITY] + r->dissipated +
                         r->time_entry[TIME_GROWTH] + r->time_entry[TIME_IMPACT] +
                         r->time_entry[TIME_SCHEME] + r->time_entry[TIME_DAMPING] +
                         r->time_entry[TIME_DRAG] + r->time_entry[TIME_ADDED] +
                         r->ledger[LEDGER_IMBALANCE];
    compare("ledger in time, ends + obstacles + loads + waves",
            r->ledger[LEDGER_ENDS] + r->ledger[LEDGER_OBSTACLES] + given +
                r->time_entry[TIME_WAVES],
            spent, 1e-12 * sizes + 1e-300, find, user);
    compare("ledger_settling in time", r->time_entry[TIME_SETTLING], 0, 0, find, user);
    compare("imbalance of the ledger in time", r->ledger[LEDGER_IMBALANCE], 0, noise, find, user);
    const Damped own = r->damping ? damping_measure(r, before, older) : (Damped){0};
    compare("ledger_damping", r->time_entry[TIME_DAMPING],
            own.damped + soft_damped(source, r, before), noise, find, user);
    if (!(own.elongation <= PLACES * reach))
        find(user, "elongation off that of the places, as a length", own.elongation, 0);
    if (!(own.rest <= PLACES)) find(user, "elongation_rest off that of the scheme", own.rest, 0);
    if (!(r->time_entry[TIME_IMPACT] >= 0))
        find(user, "energy lost by impact", r->time_entry[TIME_IMPACT], 0);
    if (r->grasps > 0) return;
    Works w = works_of(source, r, before);
    if (r->damping) w.elastic = own.stored;
    compare("ledger_elastic in time", r->ledger[LEDGER_ELASTIC], w.elastic + w.soft, noise, find,
            user);
    compare("ledger_gravity in time", r->ledger[LEDGER_GRAVITY], w.gravity,
            noise + ENERGIES * w.sizes, find, user);
    compare("ledger_ends in time", r->ledger[LEDGER_ENDS], w.ends, noise, find, user);
    const double water = noise + ENERGIES * w.sizes;
    compare("ledger_drag", r->time_entry[TIME_DRAG], w.drag, water, find, user);
    compare("ledger_added", r->time_entry[TIME_ADDED], w.added, water, find, user);
    compare("ledger_waves", r->time_entry[TIME_WAVES], w.waves, water, find, user);
    compare("ledger_loads in time", given, w.loads, water, find, user);
}
