/* SPDX-License-Identifier: BSD-3-Clause */
/* Nodes that are held or pulled (grasps.h). */
#include "grasps.h"

#include "loads.h"

#include <math.h>
#include <netcdf.h>
#include <string.h>

#include "inertia.h"

static int complain(FILE *log, const char *line, const char *what) {
    if (log) fprintf(log, "grasps of line %s: %s\n", line, what);
    return -1;
}

static int read_one(const Source *source, const char *line, const char *what, const size_t *start,
                    const size_t *count, double *value) {
    char name[300];
    int id;
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    return nc_inq_varid(source->nc, name, &id) ||
           nc_get_vara_double(source->nc, id, start, count, value);
}

int grasps_read(const Source *source, const char *line, size_t step, Record *r, FILE *log) {
    const size_t start[3] = {step, 0, 0}, count[3] = {1, GRASPS, 3};
    double node[GRASPS], kind[GRASPS];
    char name[300];
    int id;
    r->grasps = 0;
    snprintf(name, sizeof name, "%.200s_grasp_node", line);
    if (nc_inq_varid(source->nc, name, &id)) return 0;
    if (read_one(source, line, "grasp_node", start, count, node) ||
        read_one(source, line, "grasp_kind", start, count, kind) ||
        read_one(source, line, "grasp_held_position", start, count, r->grasp_place[0]) ||
        read_one(source, line, "grasp_applied_force", start, count, r->grasp_load[0]) ||
        read_one(source, line, "grasp_force", start, count, r->grasp_force[0]))
        return complain(log, line, "a variable is missing, or of another shape");
    for (size_t k = 0; k < GRASPS; k++) {
        const bool held = kind[k] == END_HELD;
        if (node[k] == -1) {
            for (size_t i = k; i < GRASPS; i++)
                if (node[i] != -1) return complain(log, line, "a place is left out");
            return 0;
        }
        if (!(node[k] >= 1 && node[k] < (double)r->elements) || (k > 0 && !(node[k] > node[k - 1])))
            return complain(log, line, "no node between the ends, or out of order");
        if (kind[k] != END_HELD && kind[k] != END_FREE) return complain(log, line, "of no kind");
        for (int a = 0; a < 3; a++)
            if (!isfinite(r->grasp_force[k][a]) || isnan(r->grasp_place[k][a]) == held ||
                isnan(r->grasp_load[k][a]) != held)
                return complain(log, line, "a value that cannot be");
        r->grasp_node[k] = (size_t)node[k];
        r->grasp_kind[k] = (int)kind[k];
        r->grasps = k + 1;
    }
    return 0;
}

static size_t find(const Record *r, size_t j) {
    size_t k = 0;
    while (k < r->grasps && r->grasp_node[k] != j) k++;
    return k;
}

bool node_is_held(const Record *r, size_t j) {
    const size_t k = find(r, j);
    return (j == 0 && r->end_kind[0] == END_HELD) ||
           (j == r->elements && r->end_kind[1] == END_HELD) ||
           (k < r->grasps && r->grasp_kind[k] == END_HELD);
}

const double *node_place(const Record *r, size_t j) {
    const size_t k = find(r, j);
    return k < r->grasps ? r->grasp_place[k] : r->held_position[j == 0 ? 0 : 1];
}

void node_load(const Record *r, size_t j, Real *load) {
    const size_t k = find(r, j);
    if (k < r->grasps && r->grasp_kind[k] == END_FREE)
        for (int a = 0; a < 3; a++) load[a] -= r->grasp_load[k][a];
    if (r->loads && r->loads->given)
        for (int a = 0; a < 3; a++) load[a] -= r->loads->given[j][a];
}

double grasps_force_error(const Record *r) {
    Real most = 0;
    for (size_t k = 0; k < r->grasps; k++) {
        const size_t j = r->grasp_node[k];
        Real others[3] = {0, 0, 0};
        loads_add_others(r, j, others);
        inertia_add(r, j, others);
        for (int a = 0; a < 3; a++) {
            const Real balance = (Real)r->segment_force[j - 1][a] - r->segment_force[j][a] -
                                 r->load[j][a] - others[a],
                       wanted = r->grasp_kind[k] == END_HELD ? balance : r->grasp_load[k][a];
            most = fmaxl(most, fabsl(wanted - r->grasp_force[k][a]));
        }
    }
    return (double)most;
}

/* [N] The force on node j in the step before that goes over to what grasps it now. */
static void force_before(const Record *before, size_t j, bool held, Real *force) {
    const size_t k = find(before, j);
    for (int a = 0; a < 3; a++) force[a] = k < before->grasps ? before->grasp_force[k][a] : 0;
    // what holds it now takes over what its obstacles did
    if (!held || (k < before->grasps && before->grasp_kind[k] == END_HELD)) return;
    for (size_t c = j; c < before->contacts * before->nodes; c += before->nodes)
        for (int a = 0; a < 3; a++)
            force[a] += (Real)before->reaction[c] * before->normal[c][a] + before->friction[c][a];
}

Real grasps_work(const Record *r, const Record *before, unsigned at_once) {
    Real work = 0;
    for (size_t k = 0; k < r->grasps; k++) {
        const size_t j = r->grasp_node[k];
        const bool held = r->grasp_kind[k] == END_HELD;
        Real first[3];
        force_before(before, j, held, first);
        for (int a = 0; a < 3; a++) {
            if (!held && (at_once >> k & 1)) first[a] = r->grasp_load[k][a];
            work += (first[a] + r->grasp_force[k][a]) / 2 *
                    ((Real)r->position[j][a] - r->reference[j][a]);
        }
    }
    return work;
}

bool longest_span(const Record *r, Span *span) {
    Real arc = 0, begin = 0;
    size_t last = r->nodes;
    bool found = false;
    for (size_t j = 0; j < r->nodes; j++) {
        if (j > 0) arc += r->element_length[j - 1];
        if (!node_is_held(r, j)) continue;
        if (last < r->nodes) {
            const double *a = node_place(r, last), *b = node_place(r, j);
            const Span now = {last, j, (double)(arc - begin),
                              hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2])};
            if (!found || now.distance - now.length > span->distance - span->length) *span = now;
            found = true;
        }
        last = j;
        begin = arc;
    }
    return found;
}
