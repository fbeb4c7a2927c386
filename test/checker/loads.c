/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, given loads and drag (loads.h). A spring with the stiffness K pulls its node towards a
 * with K (a - x), and is taken at x + y, y so small that (K y).y/2 is nothing beside energies. */
#include "loads.h"

#include <float.h>
#include <math.h>
#include <netcdf.h>
#include <stdlib.h>

static const Real PI = 3.14159265358979323846L;

static int complain(FILE *log, const char *what, const char *name) {
    if (log) fprintf(log, "%s: %s\n", what, name);
    return -1;
}

/* A variable of the line, of one step where it has steps; false where there is none. */
static bool find(const Source *source, const char *line, const char *what, int *id) {
    char name[400];
    snprintf(name, sizeof name, "%s_%s", line, what);
    return nc_inq_varid(source->nc, name, id) == NC_NOERR;
}

/* (nodes, 3) numbers that must be finite. */
static int read_vectors(const Source *source, const char *line, const char *what, long step,
                        size_t nodes, Vector *out, FILE *log) {
    int id;
    const size_t start[] = {(size_t)(step < 0 ? 0 : step), 0, 0}, count[] = {1, nodes, 3};
    const int skip = step < 0;
    if (!find(source, line, what, &id) ||
        nc_get_vara_double(source->nc, id, start + skip, count + skip, out[0]) != NC_NOERR)
        return complain(log, "cannot read", what);
    for (size_t i = 0; i < 3 * nodes; i++)
        if (!isfinite(out[i / 3][i % 3])) return complain(log, "a value that cannot be", what);
    return 0;
}

static int read_number(const Source *source, const char *line, const char *what, size_t step,
                       double *out, FILE *log) {
    int id;
    if (!find(source, line, what, &id) ||
        nc_get_var1_double(source->nc, id, &step, out) != NC_NOERR || !isfinite(*out))
        return complain(log, "cannot read", what);
    return 0;
}

static int read_current(const Source *source, Loads *loads, FILE *log) {
    size_t length;
    if (nc_inq_attlen(source->nc, NC_GLOBAL, "current", &length) != NC_NOERR || length < 4 ||
        length % 4 != 0)
        return complain(log, "no rows", "current");
    loads->rows = length / 4;
    loads->row = calloc(length, sizeof(double));
    if (!loads->row || nc_get_att_double(source->nc, NC_GLOBAL, "current", loads->row) ||
        nc_get_att_double(source->nc, NC_GLOBAL, "water_density", &loads->density))
        return complain(log, "cannot read", "current");
    return 0;
}

/* Can the energy v'K v be negative nowhere? By the pivots of Gauss' elimination, in long double. */
static bool is_convex(const double *k, const double *c) {
    Real m[3][3] = {{k[0], c[0], c[1]}, {c[0], k[1], c[2]}, {c[1], c[2], k[2]}};
    const Real noise = 1e-12L * (fabsl(m[0][0]) + fabsl(m[1][1]) + fabsl(m[2][2]));
    for (int i = 0; i < 3; i++) {
        if (!(m[i][i] >= -noise)) return false;
        for (int a = i + 1; a < 3; a++) {
            if (m[i][i] <= noise && fabsl(m[i][a]) > 1e3L * noise) return false;
            for (int b = i + 1; b < 3 && m[i][i] > noise; b++)
                m[a][b] -= m[a][i] * m[i][b] / m[i][i];
        }
    }
    return true;
}

/* A potential of a program: nobody else knows the function. */
static int create_potential(const Source *source, const char *line, Record *record, FILE *log) {
    Loads *loads = record->loads;
    int id;
    if (!loads->given || !find(source, line, "potential_force", &id)) return 0;
    loads->pull = calloc(record->nodes, sizeof(Vector));
    loads->pull_before = calloc(record->nodes, sizeof(Vector));
    loads->energy = calloc(record->nodes, sizeof(double));
    loads->energy_before = calloc(record->nodes, sizeof(double));
    return loads->pull && loads->pull_before && loads->energy && loads->energy_before
               ? 0
               : complain(log, "out of memory", "loads");
}

static int read_potential(const Source *source, const char *line, size_t step, size_t nodes,
                          Vector *pull, double *energy, FILE *log) {
    int id;
    const size_t start[] = {step, 0}, count[] = {1, nodes};
    if (read_vectors(source, line, "potential_force", (long)step, nodes, pull, log)) return -1;
    if (!find(source, line, "potential_energy", &id) ||
        nc_get_vara_double(source->nc, id, start, count, energy) != NC_NOERR)
        return complain(log, "cannot read", "potential_energy");
    for (size_t j = 0; j < nodes; j++)
        if (!isfinite(energy[j]))
            return complain(log, "a value that cannot be", "potential_energy");
    return 0;
}

int loads_create(const Source *source, const char *line, Record *record, FILE *log) {
    int id;
    char name[400];
    const bool springs = find(source, line, "node_stiffness", &id),
               given = find(source, line, "node_load", &id);
    if (!springs && !given) return 0;
    Loads *loads = record->loads = calloc(1, sizeof *loads);
    if (!loads) return complain(log, "out of memory", "loads");
    Vector **array[] = {&loads->stiffness, &loads->coupling, &loads->place, &loads->beside,
                        &loads->given};
    for (int k = 0; k < 5; k++) {
        if (!(k < 4 ? springs : given)) continue;
        *array[k] = calloc(record->nodes, sizeof(Vector));
        if (!*array[k]) return complain(log, "out of memory", "loads");
    }
    if (springs &&
        (read_vectors(source, line, "node_stiffness", -1, record->nodes, loads->stiffness, log) ||
         read_vectors(source, line, "node_coupling", -1, record->nodes, loads->coupling, log) ||
         read_vectors(source, line, "node_place", -1, record->nodes, loads->place, log)))
        return -1;
    const size_t on_springs = springs ? record->nodes : 0;
    for (size_t j = 0; j < on_springs; j++)
        if (!is_convex(loads->stiffness[j], loads->coupling[j]))
            return complain(log, "negative energy", "node_stiffness");
    if (create_potential(source, line, record, log)) return -1;
    if (find(source, line, "water_velocity", &id)) {
        loads->water = calloc(record->elements, sizeof(Vector));
        loads->water_rate = calloc(record->elements, sizeof(Vector));
        if (!loads->water || !loads->water_rate) return complain(log, "out of memory", "loads");
    }
    snprintf(name, sizeof name, "%s_drag", line);
    loads->has_drag = nc_get_att_double(source->nc, NC_GLOBAL, name, loads->drag) == NC_NOERR &&
                      nc_inq_attlen(source->nc, NC_GLOBAL, "current", &(size_t){0}) == NC_NOERR;
    snprintf(name, sizeof name, "%s_added_mass", line);
    const size_t numbers = sizeof loads->added / sizeof *loads->added;
    size_t found;
    if (nc_inq_attlen(source->nc, NC_GLOBAL, name, &found) == NC_NOERR &&
        (found != numbers || nc_get_att_double(source->nc, NC_GLOBAL, name, loads->added)))
        return complain(log, "cannot read", name);
    if (!loads->has_drag) return 0;
    return read_current(source, loads, log) || sea_read(source, &loads->sea, log) ? -1 : 0;
}

int loads_read(const Source *source, const char *line, size_t step, Record *record, FILE *log) {
    Loads *loads = record->loads;
    int bad = 0;
    if (!loads) return 0;
    bad |= read_number(source, line, "ledger_loads", step, &loads->ledger, log);
    bad |= read_number(source, line, "load_residual", step, &loads->residual, log);
    if (loads->given)
        bad |=
            read_vectors(source, line, "node_load", (long)step, record->nodes, loads->given, log);
    if (loads->beside)
        bad |= read_vectors(source, line, "node_beside", (long)step, record->nodes, loads->beside,
                            log);
    if (loads->water)
        bad |= read_vectors(source, line, "water_velocity", (long)step, record->elements,
                            loads->water, log) ||
               read_vectors(source, line, "water_acceleration", (long)step, record->elements,
                            loads->water_rate, log);
    if (!loads->pull || bad) return bad ? -1 : 0;
    loads->has_before = step > 0;
    if (loads->has_before)
        bad = read_potential(source, line, step - 1, record->nodes, loads->pull_before,
                             loads->energy_before, log);
    return bad || read_potential(source, line, step, record->nodes, loads->pull, loads->energy, log)
               ? -1
               : 0;
}

void loads_free(Record *record) {
    Loads *loads = record->loads;
    if (!loads) return;
    free(loads->stiffness);
    free(loads->coupling);
    free(loads->place);
    free(loads->beside);
    free(loads->given);
    free(loads->pull);
    free(loads->pull_before);
    free(loads->energy);
    free(loads->energy_before);
    free(loads->row);
    free(loads->water);
    free(loads->water_rate);
    sea_free(&loads->sea);
    free(loads);
    record->loads = NULL;
}

/* K v of node j. */
static void stiffness_times(const Loads *loads, size_t j, const Real *v, Real *out) {
    const double *k = loads->stiffness[j], *c = loads->coupling[j];
    out[0] = k[0] * v[0] + c[0] * v[1] + c[1] * v[2];
    out[1] = c[0] * v[0] + k[1] * v[1] + c[2] * v[2];
    out[2] = c[1] * v[0] + c[2] * v[1] + k[2] * v[2];
}

Spring loads_spring(const Record *record, size_t j) {
    const Loads *loads = record->loads;
    Spring out = {.gap = 0};
    if (!loads || !loads->stiffness) return out;
    Real off[3], middle[3], y[3], pull[3], rest[3], mean[3];
    for (int a = 0; a < 3; a++) {
        const Real x = record->position[j][a], from = record->reference[j][a],
                   at = loads->place[j][a];
        off[a] = x - at;
        y[a] = loads->beside[j][a];
        middle[a] = (off[a] + (from - at)) / 2;
    }
    stiffness_times(loads, j, off, pull);
    stiffness_times(loads, j, y, rest);
    stiffness_times(loads, j, middle, mean);
    for (int a = 0; a < 3; a++) {
        const Real x = record->position[j][a];
        out.force[a] = -(pull[a] + rest[a]);
        out.energy += off[a] * pull[a] / 2;
        out.gap += y[a] * rest[a] / 2;
        out.dual += out.force[a] * x;
        out.fall -= mean[a] * (x - record->reference[j][a]);
    }
    out.dual += out.energy - out.gap;
    return out;
}

/* Linear between the rows. */
void loads_current(const Loads *loads, Real z, Real *u) {
    const double *low = loads->row, *high = &loads->row[4 * (loads->rows - 1)];
    for (size_t k = 0; k < loads->rows; k++) {
        const double *row = &loads->row[4 * k];
        if (row[0] <= z && row[0] >= low[0]) low = row;
    }
    for (size_t k = loads->rows; k-- > 0;) {
        const double *row = &loads->row[4 * k];
        if (row[0] >= z && row[0] <= high[0]) high = row;
    }
    Real share = high[0] > low[0] ? (z - low[0]) / ((Real)high[0] - low[0]) : 0;
    share = share < 0 ? 0 : share > 1 ? 1 : share;
    for (int a = 0; a < 3; a++) u[a] = (1 - share) * low[1 + a] + share * high[1 + a];
}

/* The direction of element i at the places x, and its size. */
static Real direction(Vector *x, size_t i, Real *t) {
    Real size = 0;
    for (int a = 0; a < 3; a++) {
        t[a] = (Real)x[i + 1][a] - x[i][a];
        size += t[a] * t[a];
    }
    return sqrtl(size);
}

/* Half of the drag on element i at the places x, whose end there has the velocity v, in water that
 * waves move: Morison's law across and along it. */
static void add_half(const Record *record, Vector *x, size_t i, const Real *v, const Real *waves,
                     Real *out) {
    const Loads *loads = record->loads;
    const double diameter = loads->drag[0], across_by = loads->drag[1], along_by = loads->drag[2];
    Real u[3], t[3], along = 0, across[3], speed = 0;
    loads_current(loads, ((Real)x[i][2] + x[i + 1][2]) / 2, u);
    for (int a = 0; a < 3; a++) u[a] += waves[a] - v[a];
    const Real size = direction(x, i, t);
    for (int a = 0; a < 3; a++) along += size > 0 ? u[a] * t[a] / size : 0;
    for (int a = 0; a < 3; a++) {
        across[a] = u[a] - (size > 0 ? along * t[a] / size : 0);
        speed += across[a] * across[a];
    }
    speed = sqrtl(speed);
    const Real pressed = (Real)loads->density * record->element_length[i] / 4;
    for (int a = 0; a < 3; a++)
        out[a] += pressed * diameter *
                  (across_by * speed * across[a] +
                   (size > 0 ? PI * along_by * fabsl(along) * along * t[a] / size : 0));
}

void loads_drag(const Record *record, Vector *x, size_t j, Real *out) {
    out[0] = out[1] = out[2] = 0;
    if (!record->loads || !record->loads->has_drag) return;
    const Real rest[3] = {0, 0, 0};
    if (j > 0) add_half(record, x, j - 1, rest, rest, out);
    if (j < record->elements) add_half(record, x, j, rest, rest, out);
}

/* Half of the mass of water that element i moves along, times minus the acceleration; `own` times
 * that which it displaces. */
static void add_inertia(const Record *record, size_t i, const Real *acceleration, double own,
                        Real *out) {
    const Loads *loads = record->loads;
    Real t[3], along = 0;
    const Real size = direction(record->position, i, t), radius = (Real)loads->drag[0] / 2;
    const Real displaced = PI * radius * radius * loads->density * record->element_length[i] / 2;
    for (int a = 0; a < 3; a++) along += size > 0 ? acceleration[a] * t[a] / size : 0;
    for (int a = 0; a < 3; a++) {
        const Real part = size > 0 ? along * t[a] / size : 0;
        out[a] -= displaced * ((loads->added[0] + own) * (acceleration[a] - part) +
                               (loads->added[1] + own) * part);
    }
}

/* What the water has beyond the current in the middle of element i, by the file. */
static void given_water(const Loads *loads, size_t i, Real z, Real *beyond, Real *rate) {
    Real current[3];
    loads_current(loads, z, current);
    for (int a = 0; a < 3; a++) {
        beyond[a] = loads->water[i][a] - current[a];
        rate[a] = loads->water_rate[i][a];
    }
}

Flow loads_flow(const Record *record, size_t j) {
    Real v[3], acceleration[3];
    Flow out = {.drag = {0, 0, 0}};
    if (!record->loads || !record->loads->has_drag) return out;
    for (int a = 0; a < 3; a++) {
        v[a] = ((Real)record->position[j][a] - record->reference[j][a]) / record->span[j];
        acceleration[a] = (v[a] - record->rest_velocity[j][a]) / record->span[j];
    }
    for (size_t i = j > 0 ? j - 1 : 0; i <= j && i < record->elements; i++) {
        Real middle[3], waves[3] = {0, 0, 0}, faster[3] = {0, 0, 0}, against[3];
        for (int a = 0; a < 3; a++)
            middle[a] = ((Real)record->position[i][a] + record->position[i + 1][a]) / 2;
        sea_motion(&record->loads->sea, record->time, middle, waves, faster);
        if (record->loads->water) given_water(record->loads, i, middle[2], waves, faster);
        for (int a = 0; a < 3; a++) against[a] = -faster[a];
        add_half(record, record->position, i, v, waves, out.drag);
        add_inertia(record, i, acceleration, 0, out.added);
        add_inertia(record, i, against, 1, out.wave);
    }
    return out;
}

double loads_rounding(const Record *record) {
    const Loads *loads = record->loads;
    double sum = 0;
    if (!loads || !loads->has_drag) return 0;
    for (size_t j = 0; j < record->nodes; j++) {
        const double k = record->span[j], pi = (double)PI;
        const Flow flow = loads_flow(record, j);
        double length = 0, reach = 0, drag = 0;
        for (size_t i = j > 0 ? j - 1 : 0; i <= j && i < record->elements; i++)
            length += record->element_length[i] / 2;
        for (int a = 0; a < 3; a++) {
            reach += fabs(record->position[j][a]) + fabs(record->reference[j][a]);
            drag += fabs((double)flow.drag[a]);
        }
        const double broad = loads->density * loads->drag[0] * length,
                     moved = broad * pi / 4 * loads->drag[0] * (loads->added[0] + loads->added[1]),
                     pressed = broad / 2 * (loads->drag[1] + pi * loads->drag[2]);
        /* c w w has the slope 2 c w by the velocity w, 2 sqrt(c f) by the force f */
        sum += DBL_EPSILON * reach *
               ((record->mass[j] + moved) / (k * k) + 2 * sqrt(pressed * drag) / k);
    }
    return sum;
}

Real loads_work(const Record *record) {
    const Loads *loads = record->loads;
    Real work = 0;
    if (!loads) return 0;
    for (size_t j = 0; j < record->nodes; j++) {
        Real before[3], after[3];
        work += loads_spring(record, j).fall;
        if (!loads->given) continue;
        loads_drag(record, record->reference, j, before);
        loads_drag(record, record->position, j, after);
        for (int a = 0; a < 3; a++)
            work += (loads->given[j][a] - (loads->pull ? (Real)loads->pull[j][a] : 0) +
                     (record->settles ? 0 : (before[a] - after[a]) / 2)) *
                    ((Real)record->position[j][a] - record->reference[j][a]);
        if (loads->energy) work += (Real)loads->energy_before[j] - loads->energy[j];
    }
    /* where the line began its potential is not on file */
    return loads->energy && !loads->has_before ? loads->ledger : work;
}

/* U(y) >= U(x) - F(x).(y - x), but for rounding */
static bool rises(double at_y, double at_x, const double *F, const double *y, const double *x) {
    Real by = 0, sizes = fabsl((Real)at_y) + fabsl((Real)at_x);
    for (int a = 0; a < 3; a++) {
        by -= (Real)F[a] * ((Real)y[a] - x[a]);
        sizes += fabsl((Real)F[a]) * (fabsl((Real)y[a]) + fabsl((Real)x[a]));
    }
    return at_y - at_x - by >= -1e-9L * sizes;
}

bool loads_are_convex(const Record *r) {
    const Loads *loads = r->loads;
    if (!loads || !loads->energy || !loads->has_before) return true;
    for (size_t j = 0; j < r->nodes; j++)
        if (!rises(loads->energy[j], loads->energy_before[j], loads->pull_before[j], r->position[j],
                   r->reference[j]) ||
            !rises(loads->energy_before[j], loads->energy[j], loads->pull[j], r->reference[j],
                   r->position[j]))
            return false;
    return true;
}

double loads_open_work(const Record *record) {
    Real most = 0;
    for (size_t j = 0; j < record->nodes; j++) {
        Real square = 0;
        for (int a = 0; a < 3; a++) {
            const Real u = (Real)record->position[j][a] - record->reference[j][a];
            square += u * u;
        }
        most = fmaxl(most, square);
    }
    return record->loads ? record->loads->residual * (double)sqrtl(most) : 0;
}

void loads_add_others(const Record *r, size_t j, Real *sum) {
    const Spring spring = loads_spring(r, j);
    for (int k = 0; k < 3; k++) sum[k] += spring.force[k];
    if (r->has_elements)
        for (size_t i = j > 0 ? j - 1 : 0; i <= j && i < r->elements; i++) {
            const size_t c = r->contacts * r->nodes + i;
            const Real part = i == j ? 1 - (Real)r->share_of[i] : r->share_of[i];
            if (r->obstacle[c] >= 0)
                for (int k = 0; k < 3; k++)
                    sum[k] += part * (r->friction[c][k] + (Real)r->reaction[c] * r->normal[c][k]);
        }
}
