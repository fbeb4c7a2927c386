/* SPDX-License-Identifier: BSD-3-Clause */
/* Proofs of groups (groups.h).
 *
 * Infeasible: forces p_i that are constant along inextensible lines and balance at every free
 * point. With x the places in the file, and y any others, sum p.(y_B - y_A) = sum p.(x_B - x_A) +
 * what is left at the free points times y - x. No line allows more than |p| l; so there are no
 * places if the first sum exceeds sum |p| l by more than the second can bring, no point being
 * farther from where the file has it than the lines reach. Through a free body, turned by Q, the
 * sum depends on Q by -tr(Q' N), N = -sum of p s' over the ends there (p at end A with the other
 * sign), s their place on the body; the largest tr(Q' N) of any rotation is the sum of the singular
 * values of N, the least of them with the sign of det N.
 *
 * Unbounded: a translation v of all that falls, where nothing is held. Lines without one have a
 * body in their group that is turned in every pose (turning.h), whose proof is examined with the
 * scene.
 */
#include "groups.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>

#include "fall.h"

/* Numbers of the file, which has them in 64 bits, after some thousand sums; unit vectors. */
static const double COPIED = 1e-9, UNIT = 1e-9;
/* What lies so near to an obstacle, per length, touches it. */
static const double TOUCH = 1e-9;

typedef Real Triple[3];

/* What the forces of a proof bring to a free body. */
typedef struct BodySum {
    Triple left, column[3]; /* their sum; N, by columns */
    bool any;
    Real size; /* of the farthest of its points with a force */
} BodySum;

typedef struct Group {
    const GroupStep *at;
    size_t first, root;    /* the line that is looked at, and the group's name */
    const size_t *root_of; /* (lines) */
    Triple *left;          /* (points) */
    BodySum *on;           /* (bodies) */
} Group;

__attribute__((format(printf, 2, 3))) static void find(const Group *g, const char *format, ...) {
    char sentence[300];
    const Record *r = &g->at->line[g->first];
    const int point = r->end_point[r->end_point[0] >= 0 ? 0 : 1];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    g->at->find(g->at->user, g->at->source->point_name[point], g->at->step, sentence);
}

static Real dot(const Real *a, const Real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
static Real size(const Real *a) { return hypotl(hypotl(a[0], a[1]), a[2]); }
static void widen(const double *a, Real *out) {
    for (int k = 0; k < 3; k++) out[k] = a[k];
}

static bool is_free(const GroupStep *at, int point) {
    return point >= 0 && at->now[point].state != POINT_HELD &&
           at->now[point].state != POINT_ON_BODY;
}

/* The free body that a point is on, else -1. */
static int free_body(const GroupStep *at, int point) {
    const int body = point >= 0 && at->bodies->count > 0 ? at->bodies->of_point[point] : ON_NO_BODY;
    return body >= 0 && at->body[body].kind == BODY_FREE ? body : -1;
}

/* Do two ends share a free point, or a free body? */
static bool are_joined(const GroupStep *at, int a, int b) {
    const int body = free_body(at, a);
    return (a == b && is_free(at, a)) || (body >= 0 && body == free_body(at, b));
}

static bool is_held_end(const GroupStep *at, const Record *r, int e) {
    const int point = r->end_point[e];
    return point >= 0 ? !is_free(at, point) && free_body(at, point) < 0
                      : r->end_kind[e] == END_HELD;
}

static Real length_of(const Record *r) {
    Real sum = 0;
    for (size_t i = 0; i < r->elements; i++) sum += r->element_length[i];
    return sum;
}

bool groups_claim(const Record *r) {
    return (r->outcome == OUTCOME_INFEASIBLE || r->outcome == OUTCOME_UNBOUNDED) &&
           r->proof_obstacle < 0 && (r->end_point[0] >= 0 || r->end_point[1] >= 0);
}

/* Give lines that share a free point or body one name: the least of their numbers. */
static void name_groups(const GroupStep *at, size_t *root) {
    const size_t lines = at->source->lines;
    for (size_t i = 0; i < lines; i++) root[i] = i;
    for (bool more = true; more;) {
        more = false;
        for (size_t i = 0; i < lines; i++)
            for (size_t j = 0; j < i; j++)
                for (int e = 0; e < 4; e++) {
                    const int point = at->line[i].end_point[e / 2];
                    if (root[i] == root[j] || !are_joined(at, point, at->line[j].end_point[e % 2]))
                        continue;
                    root[i] = root[j] = root[i] < root[j] ? root[i] : root[j];
                    more = true;
                }
    }
}

static void place_of_end(const GroupStep *at, const Record *r, int e, Real *out) {
    if (r->end_point[e] >= 0)
        widen(at->now[r->end_point[e]].position, out);
    else
        widen(r->held_position[e], out);
}

/* Turn two columns of a matrix in their plane so that they are orthogonal. */
static void make_orthogonal(Real *a, Real *b) {
    const Real product = dot(a, b), zeta = (dot(b, b) - dot(a, a)) / (2 * product),
               t = (zeta < 0 ? -1 : 1) / (fabsl(zeta) + hypotl(zeta, 1)), c = 1 / hypotl(t, 1);
    if (product == 0) return;
    for (int k = 0; k < 3; k++) {
        const Real x = a[k], y = b[k];
        a[k] = c * (x - t * y);
        b[k] = c * (t * x + y);
    }
}

/* The largest tr(Q' N) of any rotation Q (Hestenes' method). */
static Real largest_trace(const Triple n[3]) {
    enum { SWEEPS = 40 };
    Triple c[3], cross;
    Real sum = 0, least = INFINITY;
    for (int k = 0; k < 9; k++) c[k / 3][k % 3] = n[k / 3][k % 3];
    for (int k = 0; k < 3; k++)
        cross[k] = n[0][(k + 1) % 3] * n[1][(k + 2) % 3] - n[0][(k + 2) % 3] * n[1][(k + 1) % 3];
    for (int i = 0; i < SWEEPS; i++)
        for (int k = 0; k < 3; k++) make_orthogonal(c[k], c[(k + 1) % 3]);
    for (int k = 0; k < 3; k++) {
        sum += size(c[k]);
        least = fminl(least, size(c[k]));
    }
    return dot(cross, n[2]) < 0 ? sum - 2 * least : sum;
}

static void add_to_body(const Group *g, int point, int e, const Real *p) {
    const int body = free_body(g->at, point);
    if (body < 0) return;
    BodySum *on = &g->on[body];
    Triple s;
    widen(g->at->bodies->place[point], s);
    on->any = true;
    on->size = fmaxl(on->size, size(s));
    for (int k = 0; k < 3; k++) {
        on->left[k] += e == 0 ? p[k] : -p[k];
        for (int c = 0; c < 3; c++) on->column[c][k] += (e == 0 ? p[k] : -p[k]) * s[c];
    }
}

/* By how much other rotations of the bodies shorten the ways along the forces; what is left on
 * them, and how far they reach. */
static Real check_bodies(const Group *g, Real *imbalance, Real *reach) {
    const GroupStep *at = g->at;
    Real gained = 0;
    for (size_t k = 0; k < at->bodies->count; k++) {
        const BodyData *data = &at->bodies->data[k];
        BodySum *on = &g->on[k];
        Real now = 0;
        if (!on->any) continue;
        for (int a = 0; a < 3; a++) {
            Triple x, axis;
            const Vector unit = {a == 0, a == 1, a == 2};
            body_place((Vector){0, 0, 0}, at->body[k].rotation, unit, axis);
            for (int i = 0; i < 3; i++) x[i] = on->column[a][i];
            now += dot(axis, x);
            if (!data->fixed[a]) *imbalance += fabsl(on->left[a]);
        }
        *reach += 4 * on->size;
        if (data->fixed[3] && data->fixed[4] && data->fixed[5]) continue;
        gained += largest_trace((const Triple *)on->column) - now;
    }
    return gained;
}

static void check_infeasible(const Group *g) {
    const GroupStep *at = g->at;
    Real sum = 0, most = 0, reach = 0, sizes = 0, imbalance = 0;
    Triple origin;
    widen(at->source->origin, origin);
    for (size_t i = 0; i < at->source->points; i++) widen((double[]){0, 0, 0}, g->left[i]);
    for (size_t k = 0; k < at->bodies->count; k++) g->on[k] = (BodySum){.any = false};
    for (size_t i = 0; i < at->source->lines; i++) {
        const Record *r = &at->line[i];
        if (g->root_of[i] != g->root) continue;
        Triple p, from = {0}, to = {0}, span;
        widen(r->proof, p);
        const Real force = size(p), length = length_of(r);
        most = fmaxl(most, force);
        if (force == 0) continue;
        if (r->compliance != 0) find(g, "infeasible by a force in an elastic line");
        for (int e = 0; e < 2; e++) {
            if (r->end_point[e] < 0 && r->end_kind[e] != END_HELD)
                find(g, "infeasible by a force in a line with a free end");
            if (r->end_point[e] >= 0 && at->gives[r->end_point[e]])
                find(g, "infeasible by a force at a point that gives way");
            if (r->end_point[e] >= 0) add_to_body(g, r->end_point[e], e, p);
            if (!is_free(at, r->end_point[e])) continue;
            for (int k = 0; k < 3; k++) g->left[r->end_point[e]][k] += e == 0 ? p[k] : -p[k];
        }
        place_of_end(at, r, 0, from);
        place_of_end(at, r, 1, to);
        for (int k = 0; k < 3; k++) span[k] = to[k] - from[k];
        sum += dot(p, span) - force * length;
        sizes += force * (length + size(from) + size(to));
        /* the file has the places of points to the rounding of the scene's coordinates */
        for (int e = 0; e < 2; e++)
            if (r->end_point[e] >= 0) sizes += force * size(origin);
        reach += length + size(span);
    }
    for (size_t i = 0; i < at->source->points; i++) imbalance += size(g->left[i]);
    sum -= check_bodies(g, &imbalance, &reach);
    if (!(sum > imbalance * reach && sum > 0))
        find(g, "infeasible, but the self-stress lacks %.6g m, of which %.3g m are its imbalance",
             (double)sum, (double)(imbalance * reach));
    if (!(fabsl(most - 1) <= UNIT)) find(g, "the largest force of the proof is %.9g", (double)most);
    const double claimed = at->line[g->first].proof_length;
    /* claimed for other places, by which the sum differs by no more than the imbalance brings */
    if (!(fabsl(claimed - sum) <= COPIED * sum + imbalance * reach + 1e-15L * sizes))
        find(g, "claimed proof_length %.9g, recomputed %.9g", claimed, (double)sum);
}

/* What frozen bounds take of a record on one surface, per speed along it. */
static Real frozen_bounds(const Record *r, size_t surface) {
    const size_t contacts = r->contacts * r->nodes + (r->has_elements ? r->elements : 0);
    Real sum = 0;
    for (size_t c = 0; c < contacts; c++)
        if (r->obstacle[c] == (int)surface) sum += r->friction_bound[c];
    return sum;
}

/* Does v leave all obstacles, planes, whatever the reactions? *taken: what frozen bounds take. */
static bool leaves_planes(const Group *g, const Record *r, const Real *v, bool smooth,
                          Real *taken) {
    const Source *source = g->at->source;
    Real factor = 1;
    for (size_t j = 0; j < (r->factor ? r->nodes : 0); j++) factor = fmaxl(factor, r->factor[j]);
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *on = &source->surface[k];
        if (on->kind != SURFACE_PLANE || on->set) return false;
        Triple n, x = {0};
        surface_normal(on, x, n);
        const Real rise = dot(n, v), across = sqrtl(fmaxl(0, 1 - rise * rise));
        const Real mu = smooth || !source->consistent ? 0 : factor * surface_friction(on);
        if (!(rise >= mu * across)) return false;
        if (!source->consistent) *taken += frozen_bounds(r, k) * across;
    }
    return true;
}

/* What frozen friction takes at a free point: the bound is that of the step before. */
static Real taken_at(const Group *g, int point, const Real *v, bool smooth) {
    const Source *source = g->at->source;
    Real taken = 0;
    if (source->consistent || smooth) return 0;
    for (size_t k = 0; k < source->surfaces; k++) {
        const Surface *on = &source->surface[k];
        Triple n, x;
        widen(g->at->now[point].position, x);
        if (surface_friction(on) == 0) continue;
        surface_normal(on, x, n);
        const Real rise = dot(n, v), across = sqrtl(fmaxl(0, 1 - rise * rise));
        const bool touches = surface_distance(on, x) <= TOUCH * (1 + size(x));
        if (g->at->before)
            taken += surface_friction(on) * g->at->before[point].reaction * across;
        else if (touches)
            taken = INFINITY; /* its reaction where the run begins is not in the file */
    }
    return taken;
}

static bool is_in_group(const Group *g, int point) {
    for (size_t i = 0; i < g->at->source->lines; i++)
        if (g->root_of[i] == g->root &&
            (g->at->line[i].end_point[0] == point || g->at->line[i].end_point[1] == point))
            return true;
    return false;
}

/* The loads of the bodies of the group, of which none may have a stiffness along v. */
static void add_bodies(const Group *g, const Real *v, Real *fall, Real *loads) {
    const GroupStep *at = g->at;
    bool counted = false;
    for (size_t k = 0; k < at->bodies->count; k++, counted = false) {
        const BodyData *data = &at->bodies->data[k];
        Triple load;
        for (size_t i = 0; i < at->source->points && !counted; i++)
            counted = free_body(at, (int)i) == (int)k && is_in_group(g, (int)i);
        if (!counted) continue;
        widen(at->body[k].load, load);
        *fall += dot(load, v);
        *loads += size(load);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < SIX; b++)
                if (v[a] != 0 && (data->fixed[a] || data->hydrostatics[SIX * a + b] != 0))
                    find(g, "unbounded, but %s does not move so", data->name);
    }
}

static void check_unbounded(const Group *g) {
    const GroupStep *at = g->at;
    const bool smooth = at->source->has_static && at->step == 0;
    Triple v, b;
    Real fall = 0, loads = 0, taken = 0;
    bool leaves = true, clear = true;
    widen(at->line[g->first].proof, v);
    if (!(fabsl(size(v) - 1) <= UNIT)) find(g, "unbounded, but its motion has no unit length");
    for (size_t i = 0; i < at->source->lines; i++) {
        const Record *r = &at->line[i];
        if (g->root_of[i] != g->root) continue;
        for (int k = 0; k < 3; k++)
            if (r->proof[k] != at->line[g->first].proof[k])
                find(g, "unbounded, but its lines move in different directions");
        for (int e = 0; e < 2; e++)
            if (is_held_end(at, r, e))
                find(g, "unbounded, but line %s is held", at->source->line_name[i]);
        for (size_t j = 0; j < r->nodes; j++) {
            widen(r->load[j], b);
            fall += dot(b, v);
            loads += size(b);
        }
        leaves = leaves && leaves_planes(g, r, v, smooth, &taken);
        clear = clear && falls_clear(at->source, r, v);
    }
    for (size_t i = 0; i < at->source->points; i++) {
        if (!is_in_group(g, (int)i)) continue;
        if (at->gives[i]) find(g, "unbounded, but %s gives way", at->source->point_name[i]);
        widen(at->now[i].load, b);
        fall += dot(b, v);
        loads += size(b);
        taken += taken_at(g, (int)i, v, smooth);
    }
    add_bodies(g, v, &fall, &loads);
    if (!leaves && !clear) find(g, "unbounded, but an obstacle may stop it");
    if (leaves) fall -= taken;
    if (!(fall > 0)) find(g, "unbounded, but the energy falls by %.3g N", (double)fall);
    const double claimed = at->line[g->first].proof_force;
    if (!(fabsl(claimed - fall) <= COPIED * loads))
        find(g, "claimed proof_force %.9g, recomputed %.9g", claimed, (double)fall);
}

/* Is this body in the group? */
static bool has_body(const Group *g, size_t body) {
    for (size_t i = 0; i < g->at->source->points; i++)
        if (free_body(g->at, (int)i) == (int)body && is_in_group(g, (int)i)) return true;
    return false;
}

/* Does a body of the group claim that it turns for ever? */
static bool has_turning(const Group *g) {
    for (size_t k = 0; k < g->at->bodies->count; k++)
        if (g->at->body[k].proof_moment != 0 && has_body(g, k)) return true;
    return false;
}

/* All lines of such a group have no motion of their own. */
static void check_turning(const Group *g) {
    for (size_t i = 0; i < g->at->source->lines; i++) {
        const Record *r = &g->at->line[i];
        if (g->root_of[i] != g->root) continue;
        if (r->proof[0] != 0 || r->proof[1] != 0 || r->proof[2] != 0 || r->proof_force != 0)
            find(g, "its lines move, and a body turns for ever");
    }
}

/* All lines of a group say the same. */
static void check_agreement(const Group *g) {
    const Record *first = &g->at->line[g->first];
    for (size_t i = 0; i < g->at->source->lines; i++) {
        const Record *r = &g->at->line[i];
        if (g->root_of[i] != g->root) continue;
        if (r->outcome != first->outcome || r->proof_length != first->proof_length ||
            r->proof_force != first->proof_force)
            find(g, "its lines do not claim the same");
    }
}

static void check_all(const GroupStep *at, size_t *root, Triple *left, BodySum *on, bool *seen) {
    name_groups(at, root);
    for (size_t i = 0; i < at->source->lines; i++) {
        if (!groups_claim(&at->line[i]) || seen[root[i]]) continue;
        const Group g = {at, i, root[i], root, left, on};
        seen[root[i]] = true;
        check_agreement(&g);
        if (at->line[i].outcome == OUTCOME_INFEASIBLE)
            check_infeasible(&g);
        else if (has_turning(&g))
            check_turning(&g);
        else
            check_unbounded(&g);
    }
}

int groups_check(const GroupStep *at, FILE *log) {
    size_t *root = calloc(at->source->lines, sizeof *root);
    Triple *left = calloc(at->source->points, sizeof *left);
    BodySum *on = calloc(at->bodies->count + 1, sizeof *on);
    bool *seen = calloc(at->source->lines, sizeof *seen);
    const int bad = !root || !left || !on || !seen ? -1 : 0;
    if (bad && log) fprintf(log, "no memory for the groups of lines\n");
    if (!bad) check_all(at, root, left, on, seen);
    free(root);
    free(left);
    free(on);
    free(seen);
    return bad;
}
