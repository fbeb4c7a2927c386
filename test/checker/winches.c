/* SPDX-License-Identifier: BSD-3-Clause */
/* Winches (winches.h). */
#include "winches.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

#include "elongation.h"
#include "soft.h"

/* A node nearer to the drum than this share of its element is on it, by the documentation. */
static const double NEAR_DRUM = 1e-3;

typedef struct Drums {
    size_t nodes, elements, first, last; /* of the whole line; nodes at which it leaves the drums */
    double stored[2], pull[2], said;     /* NaN: no winch; said: work of the winches */
    double *length, *compliance, *breaking_load, *factor, *factor_noise, *off, *weight;
    size_t *spring_of;
    Vector *reference, *position;
    Real arc_from; /* [m] of the whole line where it leaves A */
} Drums;

static int complain(FILE *log, const char *line, const char *what) {
    if (log) fprintf(log, "winches of line %s: %s\n", line, what);
    return -1;
}

static int read_one(const Source *source, const char *line, const char *what, size_t step,
                    size_t count, double *value) {
    const size_t start[2] = {step, 0}, counts[2] = {1, count};
    char name[300];
    int id;
    snprintf(name, sizeof name, "%.200s_%s", line, what);
    return nc_inq_varid(source->nc, name, &id) ||
           nc_get_vara_double(source->nc, id, start, counts, value);
}

static double *copy(const double *from, size_t count) {
    double *to = from ? calloc(count, sizeof *to) : NULL;
    if (to) memcpy(to, from, count * sizeof *to);
    return to;
}

int winches_create(const Source *source, const char *line, Record *r, FILE *log) {
    char name[300];
    int id;
    snprintf(name, sizeof name, "%.200s_length_off_drums", line);
    if (nc_inq_varid(source->nc, name, &id)) return 0;
    Drums *d = calloc(1, sizeof *d);
    if (!d) return complain(log, line, "out of memory");
    r->drums = d;
    d->nodes = r->nodes;
    d->elements = r->elements;
    d->length = copy(r->element_length, r->elements);
    d->compliance = copy(r->element_compliance, r->elements);
    d->breaking_load = copy(r->breaking_load, r->elements);
    d->factor = copy(r->factor, r->nodes);
    d->factor_noise = copy(r->factor_noise, r->nodes);
    d->off = calloc(r->elements, sizeof(double));
    d->weight = calloc(r->nodes, sizeof(double));
    d->reference = calloc(r->nodes, sizeof(Vector));
    d->position = calloc(r->nodes, sizeof(Vector));
    if (r->spring_of) d->spring_of = calloc(r->nodes + 1, sizeof *d->spring_of);
    if (!d->length || !d->compliance || !d->off || !d->weight || !d->reference || !d->position ||
        (r->factor && (!d->factor || !d->factor_noise)) ||
        (r->breaking_load && !d->breaking_load) || (r->spring_of && !d->spring_of))
        return complain(log, line, "out of memory");
    if (r->spring_of) memcpy(d->spring_of, r->spring_of, r->nodes * sizeof *d->spring_of);
    return 0;
}

void winches_destroy(Record *r) {
    Drums *d = r->drums;
    if (!d) return;
    free(d->length);
    free(d->compliance);
    free(d->breaking_load);
    free(d->factor);
    free(d->factor_noise);
    free(d->off);
    free(d->weight);
    free(d->spring_of);
    free(d->reference);
    free(d->position);
    free(d);
    r->drums = NULL;
}

void winches_whole(Record *r) {
    const Drums *d = r->drums;
    if (!d) return;
    r->nodes = d->nodes;
    r->elements = d->elements;
    r->arc_from = 0;
    r->on_drum[0] = r->on_drum[1] = false;
    /* the one obstacle is not read; contacts of elements have been where nodes were */
    if (r->contacts == 1) memset(r->obstacle, 0, d->nodes * sizeof *r->obstacle);
    memcpy(r->element_length, d->length, d->elements * sizeof(double));
    memcpy(r->element_compliance, d->compliance, d->elements * sizeof(double));
    if (d->breaking_load) memcpy(r->breaking_load, d->breaking_load, d->elements * sizeof(double));
    if (d->factor) {
        memcpy(r->factor, d->factor, d->nodes * sizeof(double));
        memcpy(r->factor_noise, d->factor_noise, d->nodes * sizeof(double));
    }
    if (d->spring_of) memcpy(r->spring_of, d->spring_of, d->nodes * sizeof *d->spring_of);
}

/* Which nodes are off the drums, by what is stored and the lengths of elements, and whether the
 * file says so. */
static int find_nodes(Drums *d, const char *line, FILE *log) {
    Real total = 0;
    for (size_t e = 0; e < d->elements; e++) total += d->length[e];
    const Real low = isnan(d->stored[0]) ? 0 : d->stored[0],
               high = total - (isnan(d->stored[1]) ? 0 : d->stored[1]), tiny = 1e-12 * total;
    if (!(low >= 0) || !(high <= total) || !(high > low))
        return complain(log, line, "more is stored than the line has");
    for (d->first = 0; d->first < d->elements && d->off[d->first] == 0;) d->first++;
    for (d->last = d->elements; d->last > 0 && d->off[d->last - 1] == 0;) d->last--;
    if (d->first >= d->last) return complain(log, line, "nothing is off the drums");
    Real at = 0;
    for (size_t e = 0; e < d->elements; e++) {
        const Real from = at, to = at + d->length[e];
        const bool off = e >= d->first && e < d->last;
        Real wanted = off ? to - from : 0;
        at = to;
        if (e == d->first) {
            wanted -= low - from;
            /* the node before it is on the drum, and the next one is not, or there is none */
            if (e > 0 && !(from <= low + NEAR_DRUM * d->length[e] + tiny))
                return complain(log, line, "a node is taken for one on the drum of A");
            if (e + 1 < d->last && !(to >= low + NEAR_DRUM * d->length[e + 1] - tiny))
                return complain(log, line, "a node is on the drum of A, and not taken for it");
        }
        if (e + 1 == d->last) {
            wanted -= to - high;
            if (e + 1 < d->elements && !(to >= high - NEAR_DRUM * d->length[e] - tiny))
                return complain(log, line, "a node is taken for one on the drum of B");
            if (e > d->first && !(from <= high - NEAR_DRUM * d->length[e - 1] + tiny))
                return complain(log, line, "a node is on the drum of B, and not taken for it");
        }
        if (!(fabsl(d->off[e] - wanted) <= tiny))
            return complain(log, line, "length_off_drums is not what the drums leave");
    }
    d->arc_from = low;
    return 0;
}

/* What is on a drum is where its end is, and carries nothing. */
static int check_drums(const Drums *d, const Record *r, const char *line, FILE *log) {
    double most = 0;
    /* a step without an answer leaves nodes and forces where they were */
    if (r->outcome > 1) return 0;
    for (size_t e = 0; e < d->elements; e++) most = fmax(most, r->tension[e]);
    for (size_t j = 0; j < d->nodes; j++) {
        if (j >= d->first && j <= d->last) continue;
        const int end = j > d->last;
        double away = 0, size = 1;
        for (int k = 0; k < 3; k++) {
            away = fmax(away, fabs(r->position[j][k] - r->held_position[end][k]));
            size = fmax(size, fabs(r->held_position[end][k]));
        }
        if (!(away <= 1e-12 * size)) return complain(log, line, "a node on a drum is elsewhere");
        if (d->weight[j] != 0) return complain(log, line, "a node on a drum has a weight");
        for (size_t c = j; c < r->contacts * d->nodes; c += d->nodes)
            if (r->reaction[c] != 0 || r->friction_bound[c] != 0)
                return complain(log, line, "a node on a drum touches an obstacle");
    }
    for (size_t e = 0; e < d->elements; e++) {
        if (e >= d->first && e < d->last) continue;
        const double *p = r->segment_force[e];
        /* the loop leaves 1e-9 of the forces in what is slack */
        if (!(hypot(hypot(p[0], p[1]), p[2]) <= 1e-9 * (most + 1e-300)) ||
            !(r->tension[e] <= 1e-9 * (most + 1e-300)))
            return complain(log, line, "an element on a drum carries a force");
    }
    return 0;
}

static void shift_doubles(double *of, size_t first, size_t count) {
    if (of) memmove(of, of + first, count * sizeof *of);
}

static void shift_vectors(Vector *of, size_t first, size_t count) {
    memmove(of, of + first, count * sizeof *of);
}

/* Rows of contacts become as long as there are nodes left. */
static void shift_contacts(const Drums *d, Record *r) {
    const size_t nodes = d->last - d->first + 1, elements = nodes - 1;
    Vector *vector[] = {r->normal, r->friction, r->slip};
    double *number[] = {r->gap, r->friction_bound, r->reaction, r->obstacle, r->mu};
    for (size_t row = 0; row <= r->contacts; row++) {
        const size_t from = row * d->nodes + d->first, to = row * nodes,
                     count = row < r->contacts ? nodes : elements;
        for (size_t i = 0; i < sizeof vector / sizeof *vector; i++)
            memmove(vector[i] + to, vector[i] + from, count * sizeof(Vector));
        for (size_t i = 0; i < sizeof number / sizeof *number; i++)
            memmove(number[i] + to, number[i] + from, count * sizeof(double));
    }
}

int winches_read(const Source *source, const char *line, size_t step, Record *r, FILE *log) {
    Drums *d = r->drums;
    if (!d) return 0;
    if (read_one(source, line, "stored", step, 2, d->stored) ||
        read_one(source, line, "winch_pull", step, 2, d->pull) ||
        read_one(source, line, "ledger_winches", step, 1, &d->said) ||
        read_one(source, line, "length_off_drums", step, d->elements, d->off) ||
        read_one(source, line, "node_weight_length", step, d->nodes, d->weight))
        return complain(log, line, "a variable is missing, or of another shape");
    if (!isfinite(d->said)) return complain(log, line, "the work of the winches is not finite");
    if (find_nodes(d, line, log) || check_drums(d, r, line, log)) return -1;
    const size_t nodes = d->last - d->first + 1, elements = nodes - 1;
    memcpy(d->reference, r->reference, d->nodes * sizeof(Vector));
    memcpy(d->position, r->position, d->nodes * sizeof(Vector));
    Vector *at_nodes[] = {r->reference, r->position, r->load, r->motion};
    for (size_t i = 0; i < sizeof at_nodes / sizeof *at_nodes; i++)
        shift_vectors(at_nodes[i], d->first, nodes);
    shift_vectors(r->segment_force, d->first, elements);
    double *on_elements[] = {r->tension, r->share_of, r->element_compliance, r->breaking_load};
    for (size_t i = 0; i < sizeof on_elements / sizeof *on_elements; i++)
        shift_doubles(on_elements[i], d->first, elements);
    shift_doubles(r->factor, d->first, nodes);
    shift_doubles(r->factor_noise, d->first, nodes);
    if (r->spring_of) memmove(r->spring_of, r->spring_of + d->first, nodes * sizeof *r->spring_of);
    shift_contacts(d, r);
    memcpy(r->element_length, d->off + d->first, elements * sizeof(double));
    memcpy(r->weight_length, d->weight + d->first, nodes * sizeof(double));
    r->nodes = nodes;
    r->elements = elements;
    r->arc_from = (double)d->arc_from;
    r->on_drum[0] = d->first > 0;
    r->on_drum[1] = d->last < d->elements;
    r->winch_work = d->said;
    for (int e = 0; e < 2; e++) {
        r->stored[e] = d->stored[e];
        r->winch_pull[e] = d->pull[e];
    }
    return 0;
}

bool winches_continue(const Record *r, const Record *before) {
    Vector *from = r->drums ? r->drums->reference : r->reference,
           *to = before->drums ? before->drums->position : before->position;
    const size_t nodes = r->drums ? r->drums->nodes : r->nodes;
    return memcmp(from, to, nodes * sizeof(Vector)) == 0;
}

bool winches_wind(const Record *r, const Record *before) {
    if (!r->drums || !before) return false;
    for (int e = 0; e < 2; e++)
        if (!isnan(r->stored[e]) && r->stored[e] != before->stored[e]) return true;
    return false;
}

/* [N/m] The weight of the line per length of mean weight, by its loads. */
static void weight_of(const Record *r, Real *w) {
    Real length = 0;
    w[0] = w[1] = w[2] = 0;
    for (size_t j = 1; j + 1 < r->nodes; j++) {
        length += r->weight_length[j];
        for (int k = 0; k < 3; k++) w[k] += r->load[j][k];
    }
    if (r->nodes < 3)
        for (int k = 0; k < 3; k++) w[k] = r->weight_before[k];
    else
        for (int k = 0; k < 3; k++) w[k] = length != 0 ? w[k] / length : 0;
}

Real winches_pull(const Source *source, const Record *r, int end) {
    const size_t j = end ? r->elements : 0, next = end ? j - 1 : 1, e = end ? j - 1 : 0;
    Real w[3], up = 0;
    weight_of(r, w);
    /* the half element at the end has its weight alone; what hangs on the node is on the drum */
    const Real half = r->weight_length[j];
    for (int k = 0; k < 3; k++)
        up += w[k] * half / r->element_length[e] * ((Real)r->position[j][k] - r->position[next][k]);
    const Real T = r->tension[e], strain = r->compliance > 0 ? elongation_strain(r, e, T) : 0,
               energy = r->compliance > 0 ? elongation_energy(r, e, strain) : 0;
    /* half of the element bears on its other node */
    return T + T * strain - energy - up - soft_energy_per_length(source, r, next) / 2;
}

/* [J] Energy of elongation of a line where it is. */
static Real elastic_energy(const Record *r) {
    Real sum = 0;
    if (!(r->compliance > 0)) return 0;
    for (size_t e = 0; e < r->elements; e++) {
        Real l = 0;
        for (int k = 0; k < 3; k++) {
            const Real d = (Real)r->position[e + 1][k] - r->position[e][k];
            l += d * d;
        }
        const Real strain = sqrtl(l) / r->element_length[e] - 1;
        if (strain > 0) sum += r->element_length[e] * elongation_energy(r, e, strain);
    }
    return sum;
}

/* What comes off the drum of an end has the weight of what the line has gained, where the other
 * drum rests; where both wind, that of its length, if the line is of one weight. */
static bool gains(const Record *r, const Record *before, Real gained[2]) {
    Real sum = 0, length = 0;
    int winding = 0;
    for (size_t j = 0; j < r->nodes; j++) sum += r->weight_length[j];
    for (size_t j = 0; j < before->nodes; j++) sum -= before->weight_length[j];
    for (int e = 0; e < 2; e++) {
        gained[e] = isnan(r->stored[e]) ? 0 : (Real)before->stored[e] - r->stored[e];
        winding += gained[e] != 0;
        length += gained[e];
    }
    if (winding == 1) gained[gained[0] == 0] = sum;
    return winding == 1 || fabsl(sum - length) <= 1e-9 * (fabsl(sum) + fabsl(length));
}

WinchLedger winches_ledger(const Source *source, const Record *r, const Record *before) {
    WinchLedger out = {.elastic = elastic_energy(r) - elastic_energy(before) +
                                  soft_energy(source, r, 0) - soft_energy(source, before, 1)};
    Real w[3], gained[2];
    weight_of(r, w);
    for (int k = 0; k < 3; k++) w[k] = (w[k] + r->weight_before[k]) / 2;
    out.known = gains(r, before, gained);
    const double *from = r->position[0];
    for (int k = 0; k < 3; k++) {
        Real now = 0, then = 0;
        for (size_t j = 0; j < r->nodes; j++)
            now += r->weight_length[j] * ((Real)r->position[j][k] - from[k]);
        for (size_t j = 0; j < before->nodes; j++)
            then += before->weight_length[j] * ((Real)before->position[j][k] - from[k]);
        out.gravity -= w[k] * (now - then);
        out.size += fabsl(w[k] * now) + fabsl(w[k] * then);
    }
    for (int e = 0; e < 2; e++) {
        if (isnan(r->stored[e]) || r->stored[e] == before->stored[e]) continue;
        const Real in = (Real)r->stored[e] - before->stored[e],
                   mean = (winches_pull(source, r, e) + (Real)before->winch_pull[e]) / 2;
        const double *a = r->position[e ? r->elements : 0],
                     *b = before->position[e ? before->elements : 0];
        out.winches += in * mean;
        out.size += fabsl(in * mean);
        /* it has left the drum where that was half way */
        for (int k = 0; k < 3; k++)
            out.gravity += gained[e] * w[k] * (((Real)a[k] + b[k]) / 2 - from[k]);
    }
    return out;
}
