/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets to which ends are held (sets.h). Of each kind the support function, sup of v.y over y in K,
 * is written down from its definition; the rest follows from it. */
#include "sets.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

#include "conic.h"
#include "grasps.h"
#include "surface.h"

enum { NONE, RAIL, HALF_SPACE, BALL, DISC, BOX, FORM, KINDS };

typedef struct Set {
    int kind;
    double point[3], axis[3], length, radius, size[3], turn[4], reaction[3];
    Conic *form; /* of a set that is given by an expression, relative to `point` */
} Set;

struct Sets {
    Set end[2];
};

/* Rounding of a direction, of a unit vector; of a place, per reach of the coordinates. */
static const Real DIRECTION = 1e-12L, PLACE = 1e-13L;
/* Of a set in conic form, where the bound of a distance may stop this far above it (conic.h). */
static const Real FORM_PLACE = 1e-10L;
/* Of a value of a small conic program in double precision, per size of the data: ten times what
 * they leave where their last steps are Newton's. */
static const Real FORM_VALUE = 1e-12L;

/* What places of points are found to, per length. */
static const Real POINT_PLACE = 2e-9L;

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real norm(const Real *a) { return sqrtl(dot(a, a)); }

static int complain(FILE *log, const char *whose, const char *what) {
    if (log) fprintf(log, "sets of %s: %s\n", whose, what);
    return -1;
}

/* Whose set it is: end `index` of a line, or where there is no line point `index`. */
typedef struct Owner {
    const char *line;
    size_t index;
} Owner;

static void variable_of(const Owner *owner, const char *what, char name[300]) {
    if (owner->line)
        snprintf(name, 300, "%.200s_%s", owner->line, what);
    else
        snprintf(name, 300, "%.200s_of_point", what);
}

static int read_one(const Source *source, const Owner *owner, const char *what, size_t step,
                    size_t count, double *value) {
    const size_t start[3] = {step, owner->index, 0}, counts[3] = {1, 1, count};
    char name[300];
    int id, dimensions;
    variable_of(owner, what, name);
    if (nc_inq_varid(source->nc, name, &id) || nc_inq_varndims(source->nc, id, &dimensions))
        return -1;
    const int skip = strcmp(what, "set_reaction") == 0 ? 0 : 1;
    if (dimensions != (count > 1 ? 3 : 2) - skip) return -1;
    return nc_get_vara_double(source->nc, id, &start[skip], &counts[skip], value);
}

/* The numbers of an attribute of the file, which the caller frees; NULL: none, or not finite. */
static double *read_numbers(const Source *source, const Owner *owner, const char *what,
                            size_t *count) {
    char name[300];
    if (owner->line)
        snprintf(name, sizeof name, "%.200s_set_%c_%s", owner->line, owner->index ? 'B' : 'A',
                 what);
    else
        snprintf(name, sizeof name, "%.200s_set_%s", source->point_name[owner->index], what);
    if (nc_inq_attlen(source->nc, NC_GLOBAL, name, count) || *count > 1000000) return NULL;
    double *value = calloc(*count + 1, sizeof *value);
    bool bad = !value || nc_get_att_double(source->nc, NC_GLOBAL, name, value);
    for (size_t i = 0; !bad && i < *count; i++) bad = !isfinite(value[i]);
    if (!bad) return value;
    free(value);
    return NULL;
}

/* {origin + P v : A v + b in K} less `point`. Without a map it is the origin alone. */
static Conic *read_form(const Source *source, const Owner *owner, const double point[3]) {
    static const char *const WHAT[5] = {"origin", "map", "cone", "rows", "offset"};
    double *part[5] = {NULL};
    size_t count[5] = {0}, n, m;
    for (int i = 0; i < 5; i++) part[i] = read_numbers(source, owner, WHAT[i], &count[i]);
    n = part[1] ? count[1] / 3 : 0;
    m = part[2] ? count[2] : 0;
    bool good = part[0] && count[0] == 3 && (n > 0) == (m > 0);
    if (n > 0)
        good =
            good && count[1] == 3 * n && part[3] && count[3] == m * n && part[4] && count[4] == m;
    for (size_t i = 0; good && i < m; i += (size_t)part[2][i]) {
        good = part[2][i] >= 1 && part[2][i] <= (double)(m - i) && floor(part[2][i]) == part[2][i];
        if (!good) break;
    }
    Conic *set = good ? conic_create(3, n, m) : NULL;
    if (set) {
        for (size_t i = 0; i < m; i += (size_t)part[2][i]) set->cone[i] = (size_t)part[2][i];
        for (size_t i = 0; i < m * n; i++) set->a[i] = part[3][i];
        for (size_t i = 0; i < m; i++) set->b[i] = part[4][i];
        for (size_t i = 0; i < 3 * n; i++) set->map[i] = part[1][i];
        for (int a = 0; a < 3; a++) set->origin[a] = (Real)part[0][a] - point[a];
        if (!conic_prepare(set)) {
            conic_free(set);
            set = NULL;
        }
    }
    for (int i = 0; i < 5; i++) free(part[i]);
    return set;
}

static bool all_finite(const double *value, int count) {
    bool finite = true;
    for (int i = 0; i < count; i++) finite = finite && isfinite(value[i]);
    return finite;
}

/* Read what does not change of a set. */
static int open_one(const Source *source, const Owner *owner, Set *set, FILE *log) {
    const char *whose = owner->line ? owner->line : source->point_name[owner->index];
    double kind;
    if (read_one(source, owner, "set_kind", 0, 1, &kind) ||
        read_one(source, owner, "set_point", 0, 3, set->point) ||
        read_one(source, owner, "set_axis", 0, 3, set->axis) ||
        read_one(source, owner, "set_length", 0, 1, &set->length) ||
        read_one(source, owner, "set_radius", 0, 1, &set->radius) ||
        read_one(source, owner, "set_size", 0, 3, set->size) ||
        read_one(source, owner, "set_rotation", 0, 4, set->turn))
        return complain(log, whose, "a variable is missing, or of another shape");
    if (!(kind >= NONE && kind < KINDS)) return complain(log, whose, "of no kind");
    set->kind = (int)kind;
    const double axis = hypot(hypot(set->axis[0], set->axis[1]), set->axis[2]);
    const bool directed = kind == RAIL || kind == HALF_SPACE || kind == DISC;
    if (!all_finite(set->point, 3) || !all_finite(set->axis, 3) || !all_finite(set->size, 3) ||
        !all_finite(set->turn, 4) || (directed && !(axis > 0)) ||
        (kind == RAIL && !(set->length > 0)) ||
        ((kind == BALL || kind == DISC) && !(set->radius > 0 && isfinite(set->radius))) ||
        (kind == BOX && !(set->size[0] > 0 && set->size[1] > 0 && set->size[2] > 0)))
        return complain(log, whose, "a value that cannot be");
    if (kind == FORM) set->form = read_form(source, owner, set->point);
    if (kind == FORM && !set->form)
        return complain(log, whose, "no conic form of a bounded set with points inside");
    return 0;
}

static int read_reaction(const Source *source, const Owner *owner, size_t step, Set *set,
                         FILE *log) {
    if (!read_one(source, owner, "set_reaction", step, 3, set->reaction) &&
        all_finite(set->reaction, 3))
        return 0;
    return complain(log, owner->line ? owner->line : source->point_name[owner->index],
                    "a reaction is missing, or not finite");
}

int sets_create(const Source *source, const char *line, Record *r, FILE *log) {
    char name[300];
    int id;
    snprintf(name, sizeof name, "%.200s_set_kind", line);
    if (nc_inq_varid(source->nc, name, &id)) return 0;
    struct Sets *sets = r->sets = calloc(1, sizeof *sets);
    if (!sets) return complain(log, line, "out of memory");
    for (size_t e = 0; e < 2; e++)
        if (open_one(source, &(Owner){line, e}, &sets->end[e], log)) return -1;
    return 0;
}

int sets_read(const Source *source, const char *line, size_t step, Record *r, FILE *log) {
    if (!r->sets) return 0;
    for (size_t e = 0; e < 2; e++)
        if (read_reaction(source, &(Owner){line, e}, step, &r->sets->end[e], log)) return -1;
    return 0;
}

const struct Conic *sets_form(const Record *r, int e) { return r->sets->end[e].form; }

void sets_free(Record *r) {
    if (!r->sets) return;
    for (int e = 0; e < 2; e++) conic_free(r->sets->end[e].form);
    free(r->sets);
    r->sets = NULL;
}

/* The set of node j, or NULL. */
static const Set *set_of(const Record *r, size_t j) {
    if (!r->sets || (j != 0 && j != r->elements)) return NULL;
    const Set *set = &r->sets->end[j == 0 ? 0 : 1];
    return set->kind == NONE ? NULL : set;
}

static void unit_axis(const Set *set, Real *u) {
    for (int a = 0; a < 3; a++) u[a] = set->axis[a];
    const Real size = norm(u);
    for (int a = 0; a < 3; a++) u[a] /= size;
}

/* Axis i of a box: the unit vector turned by the quaternion. */
static void box_axis(const Set *set, int i, Real *u) {
    Real q[4], size = 0;
    for (int a = 0; a < 4; a++) size += (Real)set->turn[a] * set->turn[a];
    for (int a = 0; a < 4; a++) q[a] = size > 0 ? set->turn[a] / sqrtl(size) : a == 0;
    const Real w = q[0], x = q[1], y = q[2], z = q[3];
    const Real m[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    for (int a = 0; a < 3; a++) u[a] = m[a][i];
}

/* sup of v.(y - point) over y in the set. What of v points along an endless direction by no more
 * than its rounding counts as 0; INFINITY beyond that. */
static Real support(const Set *set, const Real *v) {
    Real u[3], sum = 0;
    const Real size = norm(v), nothing = DIRECTION * size;
    switch (set->kind) {
    case RAIL: {
        unit_axis(set, u);
        const Real along = dot(u, v);
        if (isinf(set->length)) return fabsl(along) <= nothing ? 0 : INFINITY;
        return fmaxl(0, along * set->length);
    }
    case HALF_SPACE: {
        unit_axis(set, u);
        const Real along = dot(u, v);
        Real across[3];
        for (int a = 0; a < 3; a++) across[a] = v[a] - along * u[a];
        return norm(across) <= nothing && along <= nothing ? 0 : INFINITY;
    }
    case BALL: return size * set->radius;
    case FORM: return conic_support(set->form, v);
    case DISC: {
        unit_axis(set, u);
        const Real along = dot(u, v);
        Real across[3];
        for (int a = 0; a < 3; a++) across[a] = v[a] - along * u[a];
        return norm(across) * set->radius;
    }
    default:
        for (int i = 0; i < 3; i++) {
            box_axis(set, i, u);
            sum += fabsl(dot(u, v)) * set->size[i] / 2;
        }
        return sum;
    }
}

/* [m] from x to the set */
static Real distance(const Set *set, const Real *x) {
    Real y[3], u[3], off[3];
    for (int a = 0; a < 3; a++) y[a] = x[a] - set->point[a];
    if (set->kind == BALL) return fmaxl(0, norm(y) - set->radius);
    if (set->kind == FORM) return conic_distance(set->form, y);
    if (set->kind == BOX) {
        for (int i = 0; i < 3; i++) {
            box_axis(set, i, u);
            off[i] = fmaxl(0, fabsl(dot(u, y)) - set->size[i] / 2);
        }
        return norm(off);
    }
    unit_axis(set, u);
    const Real along = dot(u, y);
    if (set->kind == HALF_SPACE) return fmaxl(0, -along);
    for (int a = 0; a < 3; a++) off[a] = y[a] - along * u[a];
    if (set->kind == DISC) return hypotl(along, fmaxl(0, norm(off) - set->radius));
    if (isinf(set->length)) return norm(off);
    return hypotl(norm(off), fmaxl(fmaxl(0, -along), along - set->length));
}

Real sets_add(const Record *r, size_t j, Real *sum) {
    const Set *set = set_of(r, j);
    if (!set) return 0;
    Real force[3];
    for (int a = 0; a < 3; a++) force[a] = set->reaction[a];
    for (int a = 0; a < 3; a++) sum[a] += force[a];
    return norm(force);
}

double sets_rounding(const Record *r) {
    Real sum = 0;
    for (int e = 0; r->sets && e < 2; e++) {
        const Set *set = &r->sets->end[e];
        Real force[3];
        for (int a = 0; a < 3; a++) force[a] = set->reaction[a];
        if (set->form) sum += FORM_VALUE * norm(force) * set->form->reach;
    }
    return (double)sum;
}

/* sup over y in the set of -r.(y - x) */
static Real gap_at(const Set *set, const double *x) {
    Real outwards[3], y[3];
    for (int a = 0; a < 3; a++) {
        outwards[a] = -(Real)set->reaction[a];
        y[a] = (Real)x[a] - set->point[a];
    }
    return support(set, outwards) - dot(outwards, y);
}

Real sets_gap(const Record *r, size_t j) {
    const Set *set = set_of(r, j);
    return set ? gap_at(set, r->position[j]) : 0;
}

/* [m] the size of the coordinates, [N] of the largest force of the line on what holds it */
static void sizes(const Record *r, double *reach, double *force) {
    *reach = *force = 0;
    for (size_t j = 0; j < r->nodes; j++)
        for (int a = 0; a < 3; a++) *reach = fmax(*reach, fabs(r->position[j][a]));
    for (size_t i = 0; i < r->elements; i++) {
        *reach = fmax(*reach, r->element_length[i]);
        *force = fmax(*force, r->tension[i]);
    }
    for (int e = 0; e < 2; e++)
        for (int a = 0; a < 3; a++) {
            *reach = fmax(*reach, fabs(r->sets->end[e].point[a]));
            *force = fmax(*force, fabs(r->sets->end[e].reaction[a]));
        }
    for (int e = 0; e < 2; e++)
        if (r->sets->end[e].form) *reach = fmax(*reach, (double)r->sets->end[e].form->reach);
}

void sets_check(const Record *r, SetFind *find, void *user) {
    double reach, force;
    if (!r->sets) return;
    sizes(r, &reach, &force);
    for (int e = 0; e < 2; e++) {
        const size_t j = e ? r->elements : 0;
        const Set *set = set_of(r, j);
        if (!set) continue;
        Real x[3];
        for (int a = 0; a < 3; a++) x[a] = r->position[j][a];
        const Real off = distance(set, x);
        if (r->end_kind[e] == END_HELD) find(user, "an end in a set is held", 1, 0);
        if (!(off <= (set->form ? FORM_PLACE : PLACE) * reach))
            find(user, "distance of an end from its set", (double)off, 0);
        /* what of the gap is rounding of places goes with the force and the coordinates */
        const Real gap = sets_gap(r, j);
        if (!(gap >= -1e-14L * force * reach && isfinite(gap)))
            find(user, "reaction of a set outside its normal cone, gap", (double)gap, 0);
    }
}

/* [m] The least v.(y - point) over y in the set with the multiplier `by` of the plane on whose free
 * side y is: over all of the set it is that of v - by n, and the plane gives by c. */
static Real least_with(const Set *set, const Surface *plane, const Real *v, Real by) {
    Real against[3], n[3] = {0}, at[3];
    for (int a = 0; a < 3; a++) at[a] = set->point[a];
    if (plane) surface_normal(plane, at, n);
    for (int a = 0; a < 3; a++) against[a] = by * n[a] - v[a];
    return -support(set, against) - (plane ? by * surface_distance(plane, at) : 0);
}

/* Of a set without end: the one multiplier with which v - by n has no part along its endless
 * directions; of others NAN. */
static Real multiplier(const Set *set, const Surface *plane, const Real *v) {
    const bool line = set->kind == RAIL && isinf(set->length);
    Real u[3], n[3], at[3], own[2][3];
    if (!line && set->kind != HALF_SPACE) return NAN;
    unit_axis(set, u);
    for (int a = 0; a < 3; a++) at[a] = set->point[a];
    surface_normal(plane, at, n);
    const Real along[2] = {dot(u, n), dot(u, v)};
    for (int a = 0; a < 3; a++) {
        own[0][a] = line ? along[0] * u[a] : n[a] - along[0] * u[a];
        own[1][a] = line ? along[1] * u[a] : v[a] - along[1] * u[a];
    }
    return fmaxl(0, dot(own[0], own[1]) / dot(own[0], own[0]));
}

/* The greatest of these, a concave function of the multiplier. */
static Real least_along(const Set *set, const Surface *plane, const Real *v) {
    enum { HALVINGS = 200 };
    static const Real MOST = 1e6L, GOLDEN = 0.6180339887498948482L;
    Real low = 0, high = 1;
    if (!plane) return least_with(set, NULL, v, 0);
    const Real only = multiplier(set, plane, v);
    if (!isnan(only)) return least_with(set, plane, v, only);
    while (high < MOST && least_with(set, plane, v, 2 * high) > least_with(set, plane, v, high))
        high *= 2;
    high *= 2;
    for (int k = 0; k < HALVINGS && high - low > 1e-17L * high; k++) {
        const Real width = GOLDEN * (high - low);
        if (least_with(set, plane, v, high - width) < least_with(set, plane, v, low + width))
            low = high - width;
        else
            high = low + width;
    }
    return least_with(set, plane, v, (low + high) / 2);
}

/* [m] By how much the sets, seen along the unit vector v, and of what a plane leaves of them where
 * there is one, are farther from what else holds the line than it is long; -INFINITY: no set has an
 * end there. */
static Real excess_along(const Record *r, const Surface *plane, const Real *v) {
    Real most = -INFINITY;
    for (int e = 0; e < 2; e++) {
        const size_t end = e ? r->elements : 0;
        const Set *set = set_of(r, end), *other = set_of(r, r->elements - end);
        if (!set) continue;
        Real point[3], length = 0, from;
        for (int a = 0; a < 3; a++) point[a] = set->point[a];
        size_t j = end;
        do {
            length += r->element_length[e ? j - 1 : j];
            j += e ? (size_t)-1 : 1;
        } while (!node_is_held(r, j) && j > 0 && j < r->elements);
        if (node_is_held(r, j)) {
            const double *place = node_place(r, j);
            from = v[0] * place[0] + v[1] * place[1] + v[2] * place[2];
        } else if (other) {
            Real at[3];
            for (int a = 0; a < 3; a++) at[a] = other->point[a];
            from = support(other, v) + dot(v, at);
        } else {
            continue;
        }
        most = fmaxl(most, dot(v, point) + least_along(set, plane, v) - from - length);
    }
    return most;
}

/* The plane of a proof, which must keep out all that is beyond; NULL: none, or not of that kind. */
static const Surface *plane_of_proof(const Source *source, const Record *r) {
    if (r->proof_plane < 0 || r->proof_plane >= (int)source->surfaces) return NULL;
    const Surface *plane = &source->surface[r->proof_plane];
    const bool keeps = plane->kind == SURFACE_PLANE && !(plane->gives > 0) &&
                       !surface_moves(plane) && !source->touching_only;
    return keeps ? plane : NULL;
}

void sets_check_infeasible(const Source *source, const Record *r, double reach, SetFind *find,
                           void *user) {
    const Surface *plane = plane_of_proof(source, r);
    const Real v[3] = {r->proof[0], r->proof[1], r->proof[2]}, excess = excess_along(r, plane, v);
    if (r->proof_plane >= 0 && !plane)
        find(user, "infeasible beside a plane that is none", r->proof_plane, -1);
    if (!(excess > 0))
        find(user, "infeasible, but a set is within reach, excess", (double)excess, 0);
    if (!(fabsl(excess - r->proof_length) <= 1e-12L * reach))
        find(user, "proof_length", r->proof_length, (double)excess);
    if (!(norm(v) <= 1 + 1e-12L)) find(user, "length of the proof", (double)norm(v), 1);
}

bool sets_let(const Record *r) {
    const Real v[3] = {r->proof[0], r->proof[1], r->proof[2]};
    for (int e = 0; e < 2; e++) {
        const Set *set = set_of(r, e ? r->elements : 0);
        if (!set) continue;
        Real u[3], across = 0;
        if (set->kind != HALF_SPACE && !(set->kind == RAIL && isinf(set->length))) return false;
        unit_axis(set, u);
        const Real along = dot(u, v);
        for (int a = 0; a < 3; a++) across += (v[a] - along * u[a]) * (v[a] - along * u[a]);
        if (set->kind == HALF_SPACE ? along < -DIRECTION : sqrtl(across) > DIRECTION) return false;
    }
    return true;
}

/* ---- of points ---- */

struct PointSets {
    size_t count;
    Set *of; /* (count) */
};

PointSets *point_sets_open(const Source *source, int *bad, FILE *log) {
    int id;
    *bad = 0;
    if (nc_inq_varid(source->nc, "set_kind_of_point", &id)) return NULL;
    PointSets *sets = calloc(1, sizeof *sets);
    if (sets) sets->of = calloc(source->points + 1, sizeof *sets->of);
    if (!sets || !sets->of) {
        free(sets);
        *bad = complain(log, "points", "out of memory");
        return NULL;
    }
    sets->count = source->points;
    for (size_t k = 0; k < sets->count && !*bad; k++)
        *bad = open_one(source, &(Owner){NULL, k}, &sets->of[k], log);
    return sets;
}

int point_sets_read(const Source *source, size_t step, PointSets *sets, FILE *log) {
    const size_t count = sets ? sets->count : 0;
    for (size_t k = 0; k < count; k++)
        if (read_reaction(source, &(Owner){NULL, k}, step, &sets->of[k], log)) return -1;
    return 0;
}

void point_sets_free(PointSets *sets) {
    if (!sets) return;
    for (size_t k = 0; k < sets->count; k++) conic_free(sets->of[k].form);
    free(sets->of);
    free(sets);
}

bool point_sets_has(const PointSets *sets, size_t k) { return sets && sets->of[k].kind != NONE; }

const struct Conic *point_sets_form(const PointSets *sets, size_t k) { return sets->of[k].form; }

void point_sets_add(const PointSets *sets, size_t k, Real *sum) {
    if (!sets) return;
    for (int a = 0; a < 3; a++) sum[a] += sets->of[k].reaction[a];
}

void point_sets_check(const PointSets *sets, size_t k, const double *x, double length,
                      SetFind *find, void *user) {
    if (!sets) return;
    const Set *set = &sets->of[k];
    Real at[3], force[3];
    double reach = length;
    for (int a = 0; a < 3; a++) {
        at[a] = x[a];
        force[a] = set->reaction[a];
        reach = fmax(reach, fmax(fabs(x[a]), fabs(set->point[a])));
    }
    if (set->kind == NONE) {
        if (norm(force) > 0) find(user, "reaction of no set", (double)norm(force), 0);
        return;
    }
    if (set->form) reach = fmax(reach, (double)set->form->reach);
    const Real off = distance(set, at);
    if (!(off <= (set->form ? FORM_PLACE : PLACE) * reach))
        find(user, "distance of a point from its set", (double)off, 0);
    /* places are found to a billionth of the lines; below 0 by rounding */
    const Real gap = gap_at(set, x), least = set->form ? FORM_VALUE : 1e-14L;
    if (!(gap >= -least * norm(force) * reach && gap <= POINT_PLACE * norm(force) * reach))
        find(user, "reaction of the set of a point outside its normal cone, gap", (double)gap, 0);
}
