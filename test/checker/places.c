/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that are shifted (places.h). */
#include "places.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

/* Places on file against those composed here, per size of the coordinates: the run rounds in each
 * step. */
static const double PLACED = 1e-11;

struct Places {
    Surface *start;
    size_t next; /* the step that follows the one after which the obstacles are where they are */
};

static int complain(FILE *log, const char *what, size_t step) {
    if (log) fprintf(log, "obstacles, step %zu: %s\n", step, what);
    return -1;
}

int places_open(Source *source, FILE *log) {
    int id;
    source->moves =
        source->surfaces > 0 && nc_inq_varid(source->nc, "obstacle_shift", &id) == NC_NOERR;
    if (!source->moves) return 0;
    source->follows = true;
    source->places = calloc(1, sizeof *source->places);
    if (!source->places) return complain(log, "out of memory", 0);
    source->places->start = malloc(source->surfaces * sizeof(Surface));
    if (!source->places->start) return complain(log, "out of memory", 0);
    memcpy(source->places->start, source->surface, source->surfaces * sizeof(Surface));
    return 0;
}

void places_close(Source *source) {
    if (source->places) free(source->places->start);
    free(source->places);
    source->places = NULL;
}

/* Three finite numbers of obstacle k in a step. */
static int read_three(const Source *source, const char *name, size_t step, size_t k, Real *out,
                      FILE *log) {
    const size_t start[3] = {step, k, 0}, count[3] = {1, 1, 3};
    double value[3];
    int id, rank = 0;
    if (nc_inq_varid(source->nc, name, &id) || nc_inq_varndims(source->nc, id, &rank) ||
        rank != 3 || nc_get_vara_double(source->nc, id, start, count, value))
        return complain(log, name, step);
    for (int a = 0; a < 3; a++) {
        if (!isfinite(value[a])) return complain(log, name, step);
        out[a] = value[a];
    }
    return 0;
}

/* Take the shift of a step, and move the obstacle. */
static int advance(const Source *source, size_t step, size_t k, FILE *log) {
    Surface *s = &source->surface[k];
    if (read_three(source, "obstacle_shift", step, k, s->by, log) ||
        read_three(source, "obstacle_shift_turn", step, k, s->spin, log) ||
        read_three(source, "obstacle_shift_about", step, k, s->about, log))
        return -1;
    Real point[3], axis[3], grain[3], side[3], length = 0;
    surface_shift(s, s->point, 1, point);
    surface_spin(s->axis, s->spin, axis);
    surface_spin(s->grain, s->spin, grain);
    surface_spin(s->side, s->spin, side);
    for (int a = 0; a < 3; a++) length += axis[a] * axis[a];
    for (int a = 0; a < 3; a++) {
        s->point[a] = point[a];
        s->axis[a] = axis[a] / sqrtl(length);
        s->grain[a] = grain[a];
        s->side[a] = side[a];
    }
    return 0;
}

/* Is the place on file that of the shifts? */
static int compare(const Source *source, size_t step, size_t k, FILE *log) {
    const Surface *s = &source->surface[k], *from = &source->places->start[k];
    Real place[3], direction[3], reach = s->radius;
    if (read_three(source, "obstacle_place", step, k, place, log) ||
        read_three(source, "obstacle_direction", step, k, direction, log))
        return -1;
    for (int a = 0; a < 3; a++)
        reach += fabsl(place[a]) + fabsl(s->about[a]) + fabsl(from->point[a]) + fabsl(s->by[a]);
    for (int a = 0; a < 3; a++) {
        if (!(fabsl(place[a] - s->point[a]) <= PLACED * (Real)(step + 1) * reach))
            return complain(log, "obstacle_place is not where the shifts lead", step);
        if (!(fabsl(direction[a] - s->axis[a]) <= PLACED * (Real)(step + 1)))
            return complain(log, "obstacle_direction is not where the shifts lead", step);
    }
    return 0;
}

int places_at(const Source *source, size_t step, FILE *log) {
    struct Places *places = source->places;
    if (!source->moves || places->next == step + 1) return 0;
    if (step < places->next) {
        memcpy(source->surface, places->start, source->surfaces * sizeof(Surface));
        places->next = 0;
    }
    for (; places->next <= step; places->next++)
        for (size_t k = 0; k < source->surfaces; k++)
            if (advance(source, places->next, k, log)) return -1;
    for (size_t k = 0; k < source->surfaces; k++)
        if (compare(source, step, k, log)) return -1;
    return 0;
}

/* Where contact c is: a node, or a point of an element. */
static void place_of(const Record *r, size_t c, Real *x) {
    const size_t nodes = r->contacts * r->nodes;
    const size_t i = c < nodes ? c % r->nodes : c - nodes;
    const Real t = c < nodes ? 0 : (Real)r->share_of[i];
    for (int a = 0; a < 3; a++)
        x[a] = (1 - t) * r->position[i][a] + (t > 0 ? t * r->position[i + 1][a] : 0);
}

/* What the reactions of a record work on the shifts, from where its nodes are or to there. */
static Real push(const Source *source, const Record *r, bool from_here) {
    const size_t contacts = r->contacts * r->nodes + (r->has_elements ? r->elements : 0);
    Real work = 0;
    for (size_t c = 0; c < contacts; c++) {
        if (r->obstacle[c] < 0 || r->reaction[c] == 0) continue;
        const Surface *s = &source->surface[(size_t)r->obstacle[c]];
        Real x[3], there[3];
        place_of(r, c, x);
        if (from_here)
            surface_shift(s, x, 1, there);
        else
            surface_unshift(s, x, 1, there);
        for (int a = 0; a < 3; a++)
            work +=
                r->reaction[c] * (from_here ? 1 : -1) * (Real)r->normal[c][a] * (there[a] - x[a]);
    }
    return work;
}

Real places_work(const Source *source, const Record *r, const Record *before) {
    const Real after = push(source, r, false);
    return before && !r->settles ? (after + push(source, before, true)) / 2 : after;
}

/* The contacts of node j with an obstacle; returns their number. */
static size_t contacts_with(const Record *r, size_t j, double obstacle, size_t out[3]) {
    size_t count = 0;
    for (size_t c = j; c < r->contacts * r->nodes; c += r->nodes)
        if (r->obstacle[c] == obstacle) out[count++] = c;
    const size_t third = r->contacts * r->nodes + j - 1;
    if (r->has_elements && j > 0 && r->share_of[j - 1] == 1 && r->obstacle[third] == obstacle)
        out[count++] = third;
    return count;
}

static double rank_of(const double *values, const size_t *contact, size_t count, size_t c) {
    double larger = 0;
    for (size_t i = 0; i < count; i++)
        larger +=
            values[contact[i]] > values[c] || (values[contact[i]] == values[c] && contact[i] < c);
    return larger;
}

double places_reaction_on(const Record *before, const Record *r, size_t j, size_t c) {
    size_t now[3], then[3];
    if (before == r) return r->reaction[c];
    const size_t count = contacts_with(r, j, r->obstacle[c], now),
                 had = contacts_with(before, j, r->obstacle[c], then);
    const double place = rank_of(r->friction_bound, now, count, c);
    for (size_t i = 0; i < had; i++)
        if (rank_of(before->reaction, then, had, then[i]) == place)
            return before->reaction[then[i]];
    return 0;
}
