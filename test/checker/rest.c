/* SPDX-License-Identifier: BSD-3-Clause */
/* The range of tensions at rest (rest.h). */
#include "rest.h"

#include <math.h>
#include <string.h>

/* Elements shorter than their length by less are taut, as docs/theory.md has it. */
static const double TAUT = 1e-9;
/* Room across a ray or a point that a force must lie on, in units of the force: where no forces are
 * found the next is tried. Places are known to about KNOWN. */
static const double ROOMS[] = {1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-7}, KNOWN = 1e-9;

static size_t nodes_of(const RestLine *line) { return line->elements + 1; }

static bool held(const RestLine *line, size_t j) { return line->held[j]; }

static size_t touching(const RestLine *line, size_t j, size_t which[2]) {
    size_t count = 0;
    for (size_t k = 0; k < line->contacts; k++)
        if (line->contact[k * nodes_of(line) + j] != REST_APART)
            which[count++] = k * nodes_of(line) + j;
    return count;
}

/* An affine map of the unknowns to a force. */
typedef struct Force {
    Real *a[3], b[3]; /* (unknowns) each */
} Force;

enum { CONE_ROWS = 9 };

/* sum of row . force as one row of the set */
static void put(Conic *set, size_t row, size_t cone, const Force *f, const Real w[3], Real more) {
    set->cone[row] = cone;
    set->b[row] = more;
    for (size_t a = 0; a < 3; a++) {
        set->b[row] += w[a] * f->b[a];
        for (size_t j = 0; j < set->unknowns; j++)
            set->a[row * set->unknowns + j] += w[a] * f->a[a][j];
    }
}

/* The force lies in the cone of contact c; c beyond all contacts: it vanishes. Returns the rows
 * used. */
static size_t bind(const RestLine *line, Conic *set, size_t row, size_t c, const Force *f,
                   Real margin) {
    static const Real axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, none[3] = {0, 0, 0};
    if (c >= line->contacts * nodes_of(line)) {
        put(set, row, 4, f, none, margin);
        for (size_t a = 0; a < 3; a++) put(set, row + 1 + a, 0, f, axis[a], 0);
        return 4;
    }
    const double *n = line->normal[c], *u = line->slip[c];
    const Real normal[3] = {n[0], n[1], n[2]}, mu = line->friction[c];
    const bool slips = line->contact[c] == REST_SLIPS;
    Real size = sqrtl((Real)u[0] * u[0] + (Real)u[1] * u[1] + (Real)u[2] * u[2]), pull[3];
    for (size_t a = 0; a < 3; a++) pull[a] = slips ? -u[a] / size : 0; // where friction points
    /* along the normal, R; across, F less what slipping makes of it */
    Real bound[3], shift = 0;
    for (size_t a = 0; a < 3; a++) bound[a] = slips || line->frozen ? 0 : mu * normal[a];
    if (slips)
        shift = margin;
    else if (line->frozen)
        shift = mu / line->force + margin;
    else
        shift = margin;
    put(set, row, 4, f, bound, shift);
    for (size_t a = 0; a < 3; a++) {
        Real w[3];
        for (size_t k = 0; k < 3; k++) {
            w[k] = (a == k) - normal[a] * normal[k];
            if (slips && !line->frozen) w[k] -= mu * pull[a] * normal[k];
        }
        put(set, row + 1 + a, 0, f, w, slips && line->frozen ? -mu / line->force * pull[a] : 0);
    }
    put(set, row + 4, 1, f, normal, margin); /* R >= 0 */
    return 5;
}

/* What contacts do at node j, in units of the force. */
static void missing(const RestLine *line, size_t j, const Real (*t)[3], Force *f) {
    for (size_t a = 0; a < 3; a++) {
        f->b[a] = -(Real)line->load[j][a] / line->force;
        if (j > 0) f->a[a][j - 1] = t[j - 1][a];
        if (j < line->elements) f->a[a][j] = -t[j][a];
    }
}

static void negate(Force *f, size_t unknowns, const Force *part) {
    for (size_t a = 0; a < 3; a++) {
        f->b[a] -= part->b[a];
        for (size_t k = 0; k < unknowns; k++) f->a[a][k] -= part->a[a][k];
    }
}

static double tangent(const RestLine *line, size_t i, Real out[3]) {
    Real size = 0;
    for (size_t a = 0; a < 3; a++) {
        out[a] = (Real)line->position[i + 1][a] - line->position[i][a];
        size += out[a] * out[a];
    }
    size = sqrtl(size);
    for (size_t a = 0; a < 3; a++) out[a] = size > 0 ? out[a] / size : 0;
    return (double)(1 - size / line->element_length[i]);
}

static double extreme(const RestLine *line, size_t element, int sign, double margin) {
    enum { MOST_ELEMENTS = 64, MOST_UNKNOWNS = 4 * MOST_ELEMENTS + 3 };
    static Real entries[2][3][MOST_UNKNOWNS];
    static const Real none[3] = {0, 0, 0};
    Real t[MOST_ELEMENTS][3];
    const size_t n = line->elements;
    if (n > MOST_ELEMENTS) return NAN;
    size_t unknowns = n, rows = 2 * n;
    for (size_t j = 0; j <= n; j++) {
        size_t which[2], count = touching(line, j, which);
        if (held(line, j)) continue;
        rows += count == 0 ? 4 : 5 * count;
        if (count == 2) {
            unknowns += 3;
            rows += 4;
        }
    }
    Conic *set = conic_create(2, unknowns, rows);
    if (!set) return NAN;
    size_t row = 0, own = n;
    for (size_t i = 0; i < n; i++) {
        const bool taut = tangent(line, i, t[i]) <= TAUT;
        set->cone[row] = 1;
        set->a[row * unknowns + i] = 1;
        set->b[row++] = margin; /* T >= 0 */
        set->cone[row] = 1;
        set->a[row * unknowns + i] = -1;
        set->b[row++] = taut ? REST_MOST : margin;
    }
    for (size_t j = 0; j <= n; j++) {
        size_t which[2], count = touching(line, j, which);
        if (held(line, j)) continue;
        memset(entries, 0, sizeof entries);
        Force whole, first;
        for (size_t a = 0; a < 3; a++) {
            whole.a[a] = entries[0][a];
            first.a[a] = entries[1][a];
            first.b[a] = 0;
        }
        missing(line, j, (const Real(*)[3])t, &whole);
        if (count == 2) {
            for (size_t a = 0; a < 3; a++) first.a[a][own++] = 1;
            negate(&whole, unknowns, &first);
            put(set, row, 4, &first, none, REST_MOST); // so that the set has an end
            for (size_t a = 0; a < 3; a++) set->a[(row + 1 + a) * unknowns + own - 3 + a] = 1;
            row += 4;
            row += bind(line, set, row, which[1], &first, margin);
        }
        row += bind(line, set, row, count > 0 ? which[0] : (size_t)-1, &whole, margin);
    }
    set->map[element] = 1;
    const Real d[2] = {sign, 0};
    const Real value = conic_prepare(set) ? conic_support(set, d) : NAN;
    conic_free(set);
    if (value > REST_MOST / 2) return INFINITY;
    return (double)(sign * value * line->force);
}

/* By the smallest margin from `least` on with which there are forces; `taken_off`: less what it
 * adds in proportion. */
static double with_margin(const RestLine *line, size_t element, int sign, double least,
                          bool taken_off) {
    for (size_t k = 0; k < sizeof ROOMS / sizeof *ROOMS; k++) {
        const double value = ROOMS[k] >= least ? extreme(line, element, sign, ROOMS[k]) : NAN;
        if (isnan(value)) continue;
        return isinf(value) || !taken_off ? value
                                          : 2 * value - extreme(line, element, sign, 2 * ROOMS[k]);
    }
    return NAN;
}

/* The margin widens a range: a node that turns the line by a shallow angle holds it back by its
 * tension times that angle, so margin over angle is added to the tension; where friction stands at
 * its limit all along, the root of the margin. The greatest value is a concave function v of the
 * margin, as that of any convex program is of what bounds it, so that 2 v(r) - v(2 r) lies between
 * v(0) and v(r): what the margin adds in proportion is gone. So with the least one. */
double rest_tension(const RestLine *line, size_t element, int sign) {
    return with_margin(line, element, sign, 0, true);
}

double rest_tension_about(const RestLine *line, size_t element, int sign) {
    return with_margin(line, element, sign, KNOWN, false);
}
