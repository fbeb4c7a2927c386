/* SPDX-License-Identifier: BSD-3-Clause */
/* Claimed ranges of tensions (ranges.h). */
#include "ranges.h"

#include "grasps.h"

#include <math.h>
#include <stdlib.h>

#include "rest.h"

/* Values of a loop that stops at 1e-7 of the largest force. */
static const double FOUND = 1e-6;
/* Ways and missing lengths below the first are none, above the second they are some; between them
 * places leave it open. */
static const double NONE = 1e-9, SOME = 1e-6;
/* The rest program is dense. */
enum { MOST_ELEMENTS = 16 };

static Real norm(const Real *a) { return sqrtl(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }

static double length_of(const double *v) { return hypot(hypot(v[0], v[1]), v[2]); }

/* Does the place leave open which elements are taut? */
static bool taut_in_doubt(const Record *r, double force) {
    for (size_t i = 0; i < r->elements; i++) {
        Real dx[3];
        for (int k = 0; k < 3; k++) dx[k] = (Real)r->position[i + 1][k] - r->position[i][k];
        const double missing = (double)(1 - norm(dx) / r->element_length[i]);
        if (missing > NONE && (missing < SOME || length_of(r->segment_force[i]) > NONE * force))
            return true;
    }
    return false;
}

/* The contacts of the record for the program; false where they are not of its kind, or in doubt. */
static bool contacts_of(const Source *source, const Record *r, double length, double force,
                        RestContact *contact, double *friction) {
    bool rough = false;
    for (size_t c = 0; c < r->contacts * r->nodes; c++) rough = rough || r->friction_bound[c] > 0;
    for (size_t c = 0; c < r->contacts * r->nodes; c++) {
        const size_t j = c % r->nodes;
        double open = r->gap[c];
        contact[c] = REST_APART;
        for (int k = 0; k < 3; k++)
            open += r->normal[c][k] * (r->position[j][k] - r->reference[j][k]);
        if (!(open <= NONE * length)) {
            if (open < SOME * length || r->friction_bound[c] > NONE * force) return false;
            continue;
        }
        const Surface *surface = &source->surface[(size_t)r->obstacle[c]];
        if (surface->set || surface->mu[0] != surface->mu[1]) return false;
        if (!source->consistent && surface->kind != SURFACE_PLANE)
            return false; // friction keeps the plane of the reference
        friction[c] = !rough ? 0 : source->consistent ? r->mu[c] : r->friction_bound[c];
        const double slip_size = length_of(r->slip[c]);
        if (friction[c] > 0 && slip_size > NONE * length && slip_size < SOME * length) return false;
        contact[c] = friction[c] > 0 && slip_size > NONE * length ? REST_SLIPS : REST_STICKS;
    }
    return true;
}

/* Is the claimed value, the least by sign -1, wrong?  It is that of rest.c; where places are not
 * exact it may be farther out, but no farther than they are known. */
static bool value_is_wrong(const RestLine *line, size_t element, int sign, double claimed,
                           double close, double *found) {
    *found = rest_tension(line, element, sign);
    if (isnan(*found) || claimed == *found || fabs(claimed - *found) <= close) return false;
    if (!(sign * (claimed - *found) > 0)) return true;
    return !(sign * (claimed - rest_tension_about(line, element, sign)) <= close);
}

/* [rad] To what the forces tell by how much the line turns between its ends. The gap is the sum of
 * T l (1 - cos a) over the elements, a the angle from an element to its force; so the first and the
 * last of them, a_1 and a_n, have T_1 l_1 a_1^2 + T_n l_n a_n^2 <= 2 gap, and |a_1 - a_n| is at
 * most this. Infinite where one of these has no tension. */
static double known_turn(const Record *r) {
    const size_t last = r->elements - 1;
    const double first = length_of(r->segment_force[0]) * r->element_length[0],
                 other = length_of(r->segment_force[last]) * r->element_length[last];
    return sqrt(2 * fmax(0, r->claim[CLAIM_GAP]) * (1 / first + 1 / other));
}

/* [rad] By how much the line turns between its ends. */
static double turn_of(const Record *r) {
    double turn = 0;
    for (size_t i = 0; i + 1 < r->elements; i++) {
        Real first[3], second[3], sine = 0;
        for (int k = 0; k < 3; k++) {
            first[k] = ((Real)r->position[i + 1][k] - r->position[i][k]) / r->element_length[i];
            second[k] =
                ((Real)r->position[i + 2][k] - r->position[i + 1][k]) / r->element_length[i + 1];
        }
        for (int k = 0; k < 3; k++) {
            const int a = (k + 1) % 3, b = (k + 2) % 3;
            const Real cross = first[a] * second[b] - first[b] * second[a];
            sine += cross * cross;
        }
        turn += (double)sqrtl(sine);
    }
    return turn;
}

double tension_told(const Record *r) {
    const double known = known_turn(r), turn = turn_of(r);
    return known < turn ? known / turn : 0; /* what acts across it turns it by that over T */
}

/* Are the two values of a line of these places wrong? */
static bool values_are_wrong(const RestLine *line, size_t element, const double claimed[2],
                             double close, double found[2]) {
    const bool low = value_is_wrong(line, element, -1, claimed[0], close, &found[0]);
    return value_is_wrong(line, element, 1, claimed[1], close, &found[1]) || low;
}

/* The nodes on the straight way between the ends. */
static void straighten(const Record *r, double (*out)[3]) {
    Real length = 0, at = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    for (size_t j = 0; j < r->nodes; j++) {
        for (int k = 0; k < 3; k++)
            out[j][k] = (double)(r->position[0][k] +
                                 at / length * (r->position[r->elements][k] - r->position[0][k]));
        if (j < r->elements) at += r->element_length[j];
    }
}

/* Do the values by rest.c say otherwise?  False where they are not asked or not found. A line that
 * turns by less than is known of its directions may be straight as well, and the values are then
 * those of either. */
static bool is_other(const Source *source, const Record *r, size_t element, double force,
                     const double claimed[2], double found[2]) {
    const size_t all = r->contacts * r->nodes;
    RestContact *contact = calloc(all, sizeof *contact);
    double *friction = calloc(all, sizeof *friction), length = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    bool *held = calloc(r->nodes, sizeof *held);
    double(*straight)[3] = calloc(r->nodes, sizeof *straight);
    bool wrong = contact && friction && held && straight && r->elements <= MOST_ELEMENTS &&
                 force > 0 && !taut_in_doubt(r, force) &&
                 contacts_of(source, r, length, force, contact, friction);
    if (wrong) {
        for (size_t j = 0; j < r->nodes; j++) held[j] = node_is_held(r, j);
        RestLine line = {.elements = r->elements,
                         .contacts = r->contacts,
                         .element_length = r->element_length,
                         .position = (const double(*)[3])r->position,
                         .load = (const double(*)[3])r->load,
                         .normal = (const double(*)[3])r->normal,
                         .slip = (const double(*)[3])r->slip,
                         .friction = friction,
                         .contact = contact,
                         .frozen = !source->consistent,
                         .held = held,
                         .force = force};
        const double close = (FOUND + tension_told(r)) * force;
        wrong = values_are_wrong(&line, element, claimed, close, found);
        if (wrong && turn_of(r) <= known_turn(r)) {
            double other[2];
            straighten(r, straight);
            line.position = (const double(*)[3])straight;
            wrong = values_are_wrong(&line, element, claimed, FOUND * force, other);
        }
    }
    free(straight);
    free(held);
    free(contact);
    free(friction);
    return wrong;
}

bool range_is_wrong(const Source *source, const Record *r, int e, double force, char *text,
                    size_t size) {
    double said[RANGES];
    int missing = 0;
    for (int k = 0; k < RANGES; k++) missing += isnan(said[k] = r->end_range[k][e]);
    if (missing == RANGES) return false;
    const size_t element = e == 0 ? 0 : r->elements - 1;
    const double least = said[RANGE_LEAST], greatest = said[RANGE_GREATEST],
                 tension = length_of(r->segment_force[element]);
    if (missing > 0) {
        snprintf(text, size, "the range of an end's tension is not whole");
        return true;
    }
    if (r->compliance > 0 ||
        r->sets) { /* the reaction of a set is not among the forces of rest.c */
        snprintf(text, size,
                 "a range of tensions of an elastic line, or of one with an end in a set");
        return true;
    }
    if (!(least >= 0 && fabs(least - said[RANGE_LEAST_BOUND]) <= FOUND * force) ||
        !(greatest == said[RANGE_GREATEST_BOUND] ||
          fabs(greatest - said[RANGE_GREATEST_BOUND]) <= FOUND * force)) {
        snprintf(text, size, "a least or greatest tension and its bound differ");
        return true;
    }
    if (!(tension >= least - FOUND * force && tension <= greatest + FOUND * force)) {
        snprintf(text, size, "the tension %.9g of the end's element is not in its range", tension);
        return true;
    }
    const double claimed[2] = {least, greatest};
    double found[2];
    if (is_other(source, r, element, force, claimed, found)) {
        snprintf(text, size, "claimed range of tensions %.9g to %.9g, recomputed %.9g to %.9g",
                 least, greatest, found[0], found[1]);
        return true;
    }
    return false;
}
