/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction laws and systems at the edge of what has an answer.
 *     usage: random_extremes [--cases N] [--seed S]
 *
 * Cases take turns:
 *
 *   polygon    up to 12 integer points, some twice or on one line: the cone of velocities at a
 *              corner, on an edge, inside
 *   solid      up to 12 integer points in space: the same, the facets being all planes through
 *              three points that have all others on one side
 *   lines      segments and flat discs in up to 4 components: cones of velocities that contain
 *              lines
 *   touching   two balls, a ball and a half-space, a line and a ball with one point in common
 *   unbounded  sums and hulls of a disc with a ray, a line, a half-plane: supports, faces
 *   flat       a flat disc on parameters of which its forces move none or some: gamma, the motion's
 *              and the reduced law's
 *   limit      a block under a load near, at and beyond what its friction holds, driven across: is
 *              there a motion?
 *   table      velocities of a resistance law at kinks, on flat pieces and beyond its table's end
 *   wheel      a braked wheel whose brake is 1e-15 to 1e6 times as strong as its ground, or just as
 *              strong, sizes from 1e-9 to 1e9, components of W down to 1e-12: gamma, the motion,
 *              the forces
 *   polar      the polar of a ball with 0 inside, on its boundary and outside, and the ball's own
 *              gauge: facts, supports, gauges
 *   cone       friction cones and intervals with infinite ends, as laws and in systems: supports,
 *              cones of velocities, reactions
 *
 * All data are small integers, Pythagorean directions and powers of ten; what is expected follows
 * from formulas written here. */
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "capstan/drive.h"
#include "extreme_case.h"
#include "random_case.h"

enum { MOST_POINTS = 12 };

/* ---- polygons ---- */

typedef struct Points {
    int count, n;
    long x[MOST_POINTS][3];
} Points;

static CpsSet *hull_of(const Points *p) {
    double x[MOST_POINTS * 3];
    CpsSet *set = NULL;
    for (int k = 0; k < p->count; k++)
        for (int i = 0; i < p->n; i++) x[k * p->n + i] = (double)p->x[k][i];
    need(cps_set_hull_of_points(p->n, p->count, x, &set, &err), "hull");
    return set;
}

static Points draw_points(int n) {
    Points p = {.count = n + 2 + below(MOST_POINTS - n - 1), .n = n};
    for (int k = 0; k < p.count; k++) {
        for (int i = 0; i < n; i++) p.x[k][i] = digit(5);
        if (k > 0 && below(6) == 0) memcpy(p.x[k], p.x[below(k)], sizeof p.x[k]);
    }
    return p;
}

/* Normals of the facets through `at` (twice its coordinates, so that middles are integers), by all
 * pairs or triples of points: unit normals once each. Returns how many; *inside: does `at` belong
 * to the hull? *flat: no facet has a side without all. */
static int facets_at(const Points *p, const long *at, double *normals, bool *inside) {
    int count = 0;
    *inside = true;
    for (int a = 0; a < p->count; a++)
        for (int b = 0; b < p->count; b++)
            for (int c = 0; c < (p->n == 3 ? p->count : 1); c++) {
                long m[3] = {0}, least = 0, most = 0, here = 0;
                if (p->n == 2) {
                    m[0] = p->x[b][1] - p->x[a][1];
                    m[1] = p->x[a][0] - p->x[b][0];
                } else {
                    for (int i = 0; i < 3; i++) {
                        const int j = (i + 1) % 3, k = (i + 2) % 3;
                        m[i] = (p->x[b][j] - p->x[a][j]) * (p->x[c][k] - p->x[a][k]) -
                               (p->x[b][k] - p->x[a][k]) * (p->x[c][j] - p->x[a][j]);
                    }
                }
                if (!m[0] && !m[1] && !m[2]) continue;
                for (int k = 0; k < p->count; k++) {
                    long h = 0;
                    for (int i = 0; i < p->n; i++) h += m[i] * (p->x[k][i] - p->x[a][i]);
                    least = h < least ? h : least;
                    most = h > most ? h : most;
                }
                if (most > 0) continue; /* no facet, seen from this side */
                for (int i = 0; i < p->n; i++) here += m[i] * (at[i] - 2 * p->x[a][i]);
                if (here > 0) *inside = false;
                if (here != 0) continue;
                double size = sqrt((double)(m[0] * m[0] + m[1] * m[1] + m[2] * m[2])), unit[3];
                bool known = false;
                for (int i = 0; i < p->n; i++) unit[i] = (double)m[i] / size;
                for (int k = 0; k < count; k++)
                    known = known || dot(p->n, unit, &normals[k * p->n]) > 1 - 1e-12;
                if (!known) memcpy(&normals[count++ * p->n], unit, (size_t)p->n * sizeof *unit);
            }
    return count;
}

/* Rank of unit normals with entries that are not small unless 0. */
static int rank_of(int n, int count, const double *rows) {
    double a[200 * 3];
    int rank = 0;
    memcpy(a, rows, (size_t)(count * n) * sizeof *a);
    for (int j = 0; j < n && rank < count; j++) {
        int best = rank;
        for (int i = rank; i < count; i++)
            if (fabs(a[i * n + j]) > fabs(a[best * n + j])) best = i;
        if (fabs(a[best * n + j]) < 1e-9) continue;
        for (int k = 0; k < n; k++) {
            const double keep = a[rank * n + k];
            a[rank * n + k] = a[best * n + k];
            a[best * n + k] = keep;
        }
        for (int i = rank + 1; i < count; i++) {
            const double factor = a[i * n + j] / a[rank * n + j];
            for (int k = j; k < n; k++) a[i * n + k] -= factor * a[rank * n + k];
        }
        rank++;
    }
    return rank;
}

/* At a point of the set and in the middle of two. The set need not contain 0: velocities are asked
 * of any set of forces. */
static void try_points(int n) {
    const Points p = draw_points(n);
    CpsSet *set = hull_of(&p);
    double normals[200 * 3], force[3];
    for (int trial = 0; trial < 4; trial++) {
        const int one = below(p.count), other = trial < 2 ? one : below(p.count);
        long at[3] = {0};
        bool inside;
        for (int i = 0; i < n; i++) {
            at[i] = p.x[one][i] + p.x[other][i];
            force[i] = 0.5 * (double)at[i];
        }
        const int count = facets_at(&p, at, normals, &inside);
        double outside[3] = {0};
        for (int k = 0; k < count; k++)
            for (int i = 0; i < n; i++)
                outside[i] += normals[k * n + i]; /* a normal itself is no velocity, */
        const double size = sqrt(dot(n, outside, outside));
        for (int i = 0; i < n; i++) outside[i] /= size;
        const int dimension = rank_of(n, count, normals);
        double spread[MOST_POINTS * 3];
        for (int k = 0; k < p.count; k++)
            for (int i = 0; i < n; i++) spread[k * n + i] = (double)(p.x[k][i] - p.x[0][i]);
        bool flat = rank_of(n, p.count, spread) < n; /* but in a flat set it may be */
        for (int k = 0; k < count; k++)
            for (int l = 0; l < count; l++)
                flat = flat || dot(n, &normals[k * n], &normals[l * n]) < -1 + 1e-12;
        if (flat) continue; /* class `lines` has these */
        if (inside)
            compare_cone(set, n, force, count, normals, dimension, count > 0 ? outside : NULL);
    }
    cps_set_release(set);
}

static void try_polygon(void) { try_points(2); }
static void try_solid(void) { try_points(3); }

/* ---- cones that contain lines ---- */

/* The segment from -low e to high e: at t e all w with <w, e> = 0 inside, <w, e> >= 0 at the end
 * high. */
static void try_segment(int n) {
    double e[MOST], ends[2 * MOST], normals[(2 * MOST + 1) * MOST], force[MOST];
    const int low = below(3), high = 1 + below(3),
              where = below(3); /* its low end, inside, its high end */
    double square = 0;
    for (int i = 0; i < n; i++) {
        e[i] = digit(3);
        square += e[i] * e[i];
    }
    if (square == 0) e[0] = square = 1;
    for (int i = 0; i < n; i++) {
        ends[i] = -low * e[i];
        ends[n + i] = high * e[i];
    }
    const double at = where == 0 ? -low : where == 2 ? high : 0.5 * (high - low);
    for (int i = 0; i < n; i++) force[i] = at * e[i];
    int count = 0;
    for (int k = 0; k < n; k++, count += 2) /* unit vectors less their part along e, both ways */
        for (int i = 0; i < n; i++) {
            const double part = (i == k) - e[k] * e[i] / square;
            normals[count * n + i] = part;
            normals[(count + 1) * n + i] = -part;
        }
    for (int k = count - 2; k >= 0; k -= 2) {
        if (dot(n, &normals[k * n], &normals[k * n]) > 1e-12) continue;
        memmove(&normals[k * n], &normals[(k + 2) * n],
                (size_t)((count - k - 2) * n) * sizeof *normals);
        count -= 2;
    }
    if (where != 1) {
        for (int i = 0; i < n; i++) normals[count * n + i] = where ? e[i] : -e[i];
        count++;
    }
    double outside[MOST];
    for (int i = 0; i < n; i++) outside[i] = (where == 0 ? -1 : 1) * e[i] / sqrt(square);
    CpsSet *set = NULL;
    need(cps_set_segment(n, ends, ends + n, &set, &err), "segment");
    compare_cone(set, n, force, count, normals, n - (where == 1), outside);
    cps_set_release(set);
}

/* {M t : |t| <= r} in space, M of rank 2: at M t with |t| < r the line across, at |t| = r also s
 * with M's = t. */
static void try_flat_disc(void) {
    double m[3][2], across[3], size = 0;
    do {
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 2; j++) m[i][j] = digit(3);
        for (int i = 0; i < 3; i++)
            across[i] =
                m[(i + 1) % 3][0] * m[(i + 2) % 3][1] - m[(i + 2) % 3][0] * m[(i + 1) % 3][1];
        size = dot(3, across, across);
    } while (size == 0);
    static const double UNIT[][2] = {{1, 0}, {0.6, 0.8}, {-0.28, 0.96}, {0, -1}, {-0.8, -0.6}};
    const double *t = UNIT[below(5)], r = pow(10, digit(3));
    const bool edge = below(2) == 0;
    /* s = M (M'M)^-1 t */
    double g[3] = {0}, y[2], normals[9], force[3], outside[3];
    for (int i = 0; i < 3; i++) {
        g[0] += m[i][0] * m[i][0];
        g[1] += m[i][0] * m[i][1];
        g[2] += m[i][1] * m[i][1];
    }
    const double det = g[0] * g[2] - g[1] * g[1];
    y[0] = (g[2] * t[0] - g[1] * t[1]) / det;
    y[1] = (g[0] * t[1] - g[1] * t[0]) / det;
    for (int i = 0; i < 3; i++) {
        normals[i] = across[i];
        normals[3 + i] = -across[i];
        normals[6 + i] = m[i][0] * y[0] + m[i][1] * y[1];
        force[i] = r * (edge ? 1 : 0.5) * (m[i][0] * t[0] + m[i][1] * t[1]);
    }
    const double length = sqrt(dot(3, normals + 6, normals + 6));
    for (int i = 0; i < 3; i++) outside[i] = normals[6 + i] / length;
    CpsSet *ball = NULL, *flat = NULL;
    need(cps_set_ball(2, NULL, r, &ball, &err), "ball");
    need(cps_set_image(3, &m[0][0], ball, &flat, &err), "image");
    compare_cone(flat, 3, force, edge ? 3 : 2, normals, edge ? 2 : 1, outside);
    cps_set_release(ball);
    cps_set_release(flat);
}

static void try_lines(void) {
    if (below(2))
        try_segment(2 + below(3));
    else
        try_flat_disc();
}

/* ---- touching sets ---- */

static void try_touching(void) {
    const int n = 2 + below(2), kind = below(3);
    const double r = pow(10, digit(2)), s = r * (1 + below(4));
    double u[3], c[3], touch[3], w[3], far[3], nearest[3], map[3] = {0};
    CpsSet *part[2] = {NULL, NULL}, *both = NULL;
    unit_vector(n, u);
    for (int i = 0; i < n; i++) {
        c[i] = digit(3) * r;
        touch[i] = c[i] + r * u[i];
        far[i] = c[i] + (r + s) * u[i];
    }
    need(cps_set_ball(n, c, r, &part[0], &err), "ball");
    if (kind == 0)
        need(cps_set_ball(n, far, s, &part[1], &err), "ball");
    else {
        for (int i = 0; i < n; i++) map[i] = -u[i];
        need(cps_set_half_space(n, map, dot(n, map, touch), &part[1], &err), "half-space");
    }
    if (kind < 2)
        need(cps_set_intersection(2, (const CpsSet *const *)part, &both, &err), "intersection");
    else { /* the line touch + x v, v normal to u */
        const double v[3] = {-u[1], u[0], 0}, size = hypot(u[0], u[1]);
        for (int i = 0; i < n; i++) map[i] = size > 0 ? v[i] / size : i == 0;
        need(cps_set_preimage(1, map, touch, part[0], &both, &err), "preimage");
    }
    const int space = kind < 2 ? n : 1;
    /* the root of rounding, of the size that the numbers have */
    const double size = 10 * r + 2 * s, allowed = 1e-6 * size;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    for (int i = 0; i < n; i++) w[i] = digit(3);
    need(cps_set_support(both, w, NULL, &answer, &err), "support");
    same("outcome of the support", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    near("support", answer.value, kind < 2 ? dot(n, w, touch) : 0,
         allowed * (1 + sqrt(dot(n, w, w))));
    for (int i = 0; i < space; i++) far[i] = (kind < 2 ? touch[i] : 0) + size * (i == 0);
    need(cps_set_project(both, far, NULL, nearest, &answer, &err), "project");
    same("outcome of the projection", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    near("distance", answer.value, size, allowed);
    need(cps_set_facts(both, 1e-5, &facts, NULL, NULL, &err), "facts");
    same("dimension", facts.dimension, 0);
    for (int k = 0; k < 2; k++) cps_set_release(part[k]);
    cps_set_release(both);
}

/* ---- unbounded sets ---- */

/* A disc of radius r round c and the ray along e from its centre (or the whole line): sum or hull.
 * For both h(w) = <w, c> + r|w| where <w, e> <= 0 (= 0 for a line), else infinite; where <w, e> = 0
 * the face is the ray (line) from the disc's point. */
static void try_unbounded(void) {
    double e[2], c[2], w[2], point[2];
    const double r = 1 + below(4);
    const bool line = below(2) == 0, hull = below(2) == 0;
    unit_vector(2, e);
    for (int i = 0; i < 2; i++) c[i] = digit(3);
    CpsSet *disc = NULL, *ray = NULL, *moved = NULL, *set = NULL, *face = NULL;
    need(cps_set_ball(2, c, r, &disc, &err), "disc");
    if (line)
        need(cps_set_subspace(2, 1, e, &ray, &err), "line");
    else
        need(cps_set_cone_of_rays(2, 1, e, &ray, &err), "ray");
    need(cps_set_translate(c, ray, &moved, &err), "translate");
    const CpsSet *const parts[2] = {disc, hull ? moved : ray};
    need(hull ? cps_set_hull(2, parts, &set, &err) : cps_set_sum(2, parts, &set, &err),
         "sum or hull");
    const int side = digit(1); /* along e, against it, across */
    const double turn = below(2) ? 1 : -1;
    for (int i = 0; i < 2; i++)
        w[i] = side * e[i] + turn * (i ? e[0] : -e[1]) * (side && below(2) ? 0.5 : 1);
    CpsSetAnswer answer;
    CpsSetExtent extent;
    need(cps_set_support(set, w, point, &answer, &err), "support");
    const bool infinite = line ? side != 0 : side > 0;
    same("outcome of the support", answer.outcome,
         infinite ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    if (!infinite) near("support", answer.value, dot(2, w, c) + r * sqrt(dot(2, w, w)), CLOSE * 10);
    if (side == 0) {
        const double at = dot(2, e, c);
        need(cps_set_face(set, w, 0, &face, &answer, &err), "face");
        same("outcome of the face", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        if (face) need(cps_set_extent(face, e, &extent, &err), "extent");
        if (face && !isinf(extent.high)) fail("face ends", extent.high, INFINITY);
        if (face && line && !isinf(extent.low)) fail("face begins", extent.low, -INFINITY);
        if (face && !line) near("face begins", extent.low, at, CLOSE * 10);
        cps_set_release(face);
    }
    CpsSet *const all[] = {disc, ray, moved, set};
    for (int i = 0; i < 4; i++) cps_set_release(all[i]);
}

/* ---- flat laws along free directions ---- */

/* Parameters (x, y, z): a segment of forces from -e to 2 e on U = (x, y, z), x driven, z held at 0
 * or free. Its forces do work on what is free unless those components of e are 0. */
static void try_flat(void) {
    const double e[3] = {1 + below(3), below(2) ? digit(2) : 0, below(2) ? digit(2) : 0},
                 size = pow(10, digit(3));
    const bool held = below(2) == 0;
    double ends[6];
    for (int i = 0; i < 3; i++) {
        ends[i] = -size * e[i];
        ends[3 + i] = 2 * size * e[i];
    }
    CpsSet *segment = NULL, *forces = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    need(cps_set_segment(3, ends, ends + 3, &segment, &err), "segment");
    CpsLaw *law = law_of(segment);
    need(cps_system_create(3, &system, &err), "system");
    need(cps_system_add_friction(system, "flat", law, 3,
                                 (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}, {2, 2, 1}}, &err),
         "add");
    if (held)
        need(cps_system_add_constraints(system, 1, 1, (const CpsEntry[]){{0, 2, 1}}, &err),
             "constraint");
    need(cps_system_set_drive(system, 1, 1, (const CpsEntry[]){{0, 0, 1}}, &err), "drive");
    const double w = digit(3), works = e[1] == 0 && (held || e[2] == 0), power = -size * e[0] * w;
    const double gamma = works != 0 ? fmax(-power, 2 * power) : 0, allowed = 1e-7 * size * 10;
    need(cps_system_solve(system, &w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    same("outcome", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    near("gamma", report.value, gamma, allowed);
    if (!(report.lower <= gamma + allowed)) fail("lower bound", report.lower, gamma);
    need(cps_system_eliminate(system, NULL, &forces, NULL, &err), "eliminate");
    CpsSetAnswer phi;
    need(cps_set_support(forces, (const double[]){-w}, NULL, &phi, &err), "support");
    near("gamma of the reduced law", phi.value, gamma, allowed);
    cps_set_release(forces);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law);
}

/* ---- loads at the limit ---- */

/* A block with friction r (disc) or a in x, b in y (box), driven along x with w under the load f L
 * along y, L what friction holds: disc: gamma = r |w| sqrt(1 - f^2), at f = 1 not attained unless w
 * = 0; box: gamma = a |w|, at f = 1 attained; beyond: none. */
static void try_limit(void) {
    static const int TEN[] = {0, 1, 3, 5, 7, 9, 11};
    const bool round = below(2) == 0;
    const int side = digit(1), power = TEN[below(7)];
    const double r = pow(10, digit(2)) * (1 + below(5)), a = r * (1 + below(3)), w = digit(2);
    const double factor = 1 + side * pow(10, -power) * (side < 0 ? 0.9 : 1);
    double u[2];
    CpsSet *set = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    unit_vector(2, u); /* the block's axes */
    if (round)
        need(cps_set_ball(2, NULL, r, &set, &err), "disc");
    else
        need(cps_set_box(2, (double[]){-a, -r}, (double[]){a, r}, &set, &err), "box");
    CpsLaw *law = law_of(set);
    need(cps_system_create(2, &system, &err), "system");
    const CpsEntry map[] = {{0, 0, u[0]}, {0, 1, u[1]}, {1, 0, -u[1]}, {1, 1, u[0]}};
    need(cps_system_add_friction(system, "table", law, 4, map, &err), "add");
    need(cps_system_set_drive(system, 1, 2, (const CpsEntry[]){{0, 0, u[0]}, {0, 1, u[1]}}, &err),
         "drive");
    need(cps_system_set_load(system, (double[]){-u[1] * factor * r, u[0] * factor * r}, &err),
         "load");
    need(cps_system_solve(system, &w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    const bool beyond = side > 0, at = side == 0, attained = !round || w == 0;
    const double gamma = beyond  ? -INFINITY
                         : round ? r * fabs(w) * sqrt(fmax(0, 1 - factor * factor))
                                 : a * fabs(w);
    if (beyond)
        same("beyond the limit", report.outcome, CPS_MOTION_OUTCOME_NO_BALANCE);
    else if (at && !attained)
        same("at the limit", report.outcome, CPS_MOTION_OUTCOME_NOT_ATTAINED);
    else if (report.outcome != CPS_MOTION_OUTCOME_SOLVED &&
             report.outcome != CPS_MOTION_OUTCOME_LIMIT_LOAD &&
             !(round && power >= 9 &&
               report.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED)) /* V = w tan: 3e4 w and more */
        fail("below the limit", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    if (beyond)
        same("no gamma", isinf(report.value) && report.value < 0, 1);
    else {
        /* near the limit the force is known along the disc to the root of its rounding */
        near("gamma", report.value, gamma, 1e-6 * a * fmax(1, fabs(w)));
        if (!(report.lower <= gamma + 1e-9 * a)) fail("lower bound", report.lower, gamma);
    }
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(law);
}

/* ---- tables ---- */

/* h' through (0, y0), (1, y1), (2, y1), (3, y2) times a disc of radius r, alone or beside a dry
 * disc: at the force F the speeds with h' = |F|/r (less the dry one's). */
static void try_table(void) {
    const double y0 = below(3), y1 = y0 + 1 + below(2), y2 = y1 + 1 + below(3),
                 r = pow(10, digit(2)), s = below(2) ? r * (1 + below(3)) : 0;
    const double speed[] = {0, 1, 2, 3}, factor[] = {y0, y1, y1, y2};
    const int where =
        below(6); /* in rest, at h'(0), between, on the flat piece, above it, at the end */
    const double slope[] = {0.5 * y0, y0, 0.5 * (y0 + y1), y1, 0.5 * (y1 + y2), y2},
                 low[] = {0, 0, 0.5, 1, 2.5, 3}, high[] = {0, 0, 0.5, 2, 2.5, INFINITY};
    if (where < 2 && y0 == 0 && s == 0 && where == 1) return; /* F = 0 twice */
    double u[2], force[2];
    unit_vector(2, u);
    CpsSet *disc = NULL, *dry = NULL, *velocities = NULL;
    need(cps_set_ball(2, NULL, r, &disc, &err), "disc");
    if (s > 0) need(cps_set_ball(2, NULL, s, &dry, &err), "dry");
    CpsLaw *law = law_of(disc), *rough = s > 0 ? law_of(dry) : NULL;
    CpsResistance *part[2] = {NULL, NULL}, *all = NULL;
    need(cps_resistance_table(law, 4, speed, factor, &part[0], &err), "table");
    if (s > 0) need(cps_resistance_dry(rough, &part[1], &err), "dry");
    need(cps_resistance_sum(s > 0 ? 2 : 1, (const CpsResistance *const *)part, &all, &err), "sum");
    for (int i = 0; i < 2; i++) force[i] = (slope[where] * r + s) * u[i];
    CpsSetAnswer answer;
    CpsSetExtent extent;
    need(cps_resistance_velocities(all, force, &velocities, &answer, &err), "velocities");
    same("outcome", answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    if (velocities) {
        need(cps_set_extent(velocities, (double[]){-u[0], -u[1]}, &extent, &err), "extent");
        near("least speed", r * extent.low, low[where], 1e-5); /* g = r |V| */
        if (isinf(high[where]))
            same("greatest speed", isinf(extent.high), 1);
        else
            near("greatest speed", r * extent.high, high[where], 1e-5);
    }
    cps_set_release(velocities);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(all);
    cps_law_release(law);
    cps_law_release(rough);
}

/* ---- weak laws beside strong ones, drives that hardly move ---- */

typedef struct Wheel {
    double ground, brake, w[2]; /* f N, b; the radius is 1/2, so that b = f N/2 is exact */
} Wheel;

static Wheel draw_wheel(void) {
    static const double BETA[] = {1, 1, 0.6, 0.8, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e3, 1e6};
    const double ground = (1 + below(5)) * pow(10, digit(9)), speed = pow(10, digit(6));
    Wheel wheel = {ground, 0.5 * ground * BETA[below(11)], {0, 0}};
    for (int i = 0; i < 2; i++)
        wheel.w[i] = digit(3) * speed * (below(2) ? 1 : pow(10, -below(13)));
    return wheel;
}

/* omega, V by least dissipation: with beta = 2 b/(f N), s = sign(Wj) min(|Wj|, |Wi| beta/sqrt(1 -
 * beta^2)), V = (Wi, s), omega = 2 (s - Wj). */
static void wheel_motion(const Wheel *wheel, double *v) {
    const double beta = 2 * wheel->brake / wheel->ground;
    double s = fabs(wheel->w[1]);
    if (beta < 1) s = fmin(s, fabs(wheel->w[0]) * beta / sqrt((1 - beta) * (1 + beta)));
    s = copysign(s, wheel->w[1]);
    v[0] = 2 * (s - wheel->w[1]);
    v[1] = wheel->w[0];
    v[2] = s;
}

/* A claim of the sets of all motions, or of all forces: the expected one belongs to it; and is the
 * one found, where that is said to be the only one. */
static void belongs(const char *what, const CpsSolutionSet *all, int n, const double *expected,
                    const double *low, const double *high, const double *allowed) {
    if (all->outcome == CPS_SET_OUTCOME_ANSWERED)
        for (int i = 0; i < n; i++)
            if (!(low[i] - allowed[i] <= expected[i] && expected[i] <= high[i] + allowed[i]))
                fail(what, low[i], expected[i]);
}

static void try_wheel(void) {
    const Wheel wheel = draw_wheel();
    double v[3], low[3], high[3];
    CpsSet *set[2] = {NULL, NULL};
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    CpsSolutionSet all;
    need(cps_set_interval(-wheel.brake, wheel.brake, &set[0], &err), "interval");
    need(cps_set_ball(2, NULL, wheel.ground, &set[1], &err), "disc");
    CpsLaw *brake = law_of(set[0]), *ground = law_of(set[1]);
    need(cps_system_create(3, &system, &err), "system");
    need(cps_system_add_friction(system, "brake", brake, 1, (const CpsEntry[]){{0, 0, 1}}, &err),
         "add");
    need(cps_system_add_friction(system, "ground", ground, 2,
                                 (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}}, &err),
         "add");
    need(cps_system_set_drive(system, 2, 3, (const CpsEntry[]){{0, 1, 1}, {1, 2, 1}, {1, 0, -0.5}},
                              &err),
         "drive");
    need(cps_system_solve(system, wheel.w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    wheel_motion(&wheel, v);
    const double speed = fmax(fabs(wheel.w[0]), fabs(wheel.w[1])), length = hypot(v[1], v[2]);
    const double gamma = wheel.ground * length + wheel.brake * fabs(v[0]),
                 power = wheel.ground * speed;
    same("outcome", report.outcome, CPS_MOTION_OUTCOME_SOLVED);
    /* the promise is 1e-8 of the power scale, in which a strong brake that does not slip has a
     * part */
    near("gamma", report.value, gamma, 1e-9 * power);
    if (!(report.lower <= gamma * (1 + 1e-12) && gamma * (1 - 1e-12) <= report.upper))
        fail("bounds", report.lower, gamma);
    need(cps_motion_velocities(motion, 0, &all, low, high, &err), "velocities");
    belongs("velocities", &all, 3, v, low, high,
            (const double[]){4e-5 * speed, 1e-5 * speed, 1e-5 * speed});
    cps_solution_set_clear(&all);
    /* one pair of forces, by the motion: where the ground slips it tells all; where the wheel rolls
     * straight on, the brake does */
    double force[3] = {0, 0, 0};
    bool known = length > 0;
    if (known)
        for (int i = 0; i < 2; i++) force[1 + i] = -wheel.ground * v[1 + i] / length;
    if (!known && v[0] != 0) {
        force[0] = -copysign(wheel.brake, v[0]);
        force[2] = -2 * force[0];
    } else {
        force[0] = v[0] != 0 ? -copysign(wheel.brake, v[0]) : -0.5 * force[2];
    }
    need(cps_motion_forces(motion, 0, &all, low, high, &err), "forces");
    /* the tolerance of these sets is 1e-6 of the largest force, and a set may have been moved by
     * that */
    const double allowed = 2e-6 * fmax(wheel.ground, wheel.brake);
    belongs("forces", &all, 3, force, low, high, (const double[]){allowed, allowed, allowed});
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(brake);
    cps_law_release(ground);
}

/* ---- polars, gauges ---- */

/* A ball of radius r round c = rho r u: 0 inside, on the boundary, outside. Gauge of the ball at x:
 * least t >= 0 with |x - t c| <= t r. Its polar is {x : <x, c> + r |x| <= 1}; that of the ball
 * without 0 has the hull of ball and 0 as its polar. */
static void support_of_polar(const CpsSet *polar, int n, double rho, double r, const double *u,
                             const double *w) {
    /* least t with |w - t c| <= t r; of a ball without 0 only within the cone that touches it,
     * which is left out here */
    const double s = dot(n, w, u), size = dot(n, w, w), lead = r * r * (1 - rho * rho),
                 root = rho * r * s;
    if (rho > 1) return;
    const bool none = rho == 1 && s <= 1e-9;
    const double t = rho < 1 ? (sqrt(root * root + lead * size) - root) / lead : size / (2 * root);
    double at[3];
    CpsSetAnswer answer;
    need(cps_set_support(polar, w, at, &answer, &err), "support of the polar");
    same("outcome of the polar's support", answer.outcome,
         none ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    if (none) return;
    near("support of the polar", answer.value, t, 1e-9 * t);
    near("where it is attained", dot(n, at, w), t, 1e-9 * t);
    near("that point on the polar's boundary", rho * r * dot(n, at, u) + r * sqrt(dot(n, at, at)),
         1, 1e-9 * (1 + r * sqrt(dot(n, at, at))));
}

static void try_polar(void) {
    static const double RHO[] = {0, 0.5, 1, 1, 2};
    const int n = 2 + below(2);
    const double rho = RHO[below(5)], r = pow(10, digit(6)), scale = pow(10, digit(2));
    double u[3], c[3], x[3], w[3];
    unit_vector(n, u);
    unit_vector(n, w);
    for (int i = 0; i < n; i++) c[i] = rho * r * u[i];
    CpsSet *ball = NULL, *polar = NULL;
    CpsSetFacts facts;
    CpsSetAnswer answer;
    need(cps_set_ball(n, c, r, &ball, &err), "ball");
    need(cps_set_polar(ball, &polar, &err), "polar");
    need(cps_set_facts(polar, 0, &facts, NULL, NULL, &err), "facts");
    same("outcome of the facts", facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    same("dimension", facts.dimension, n);
    same("0 is inside", facts.zero_interior, true);
    same("bounded", facts.bounded, rho < 1);
    /* gauge of the ball, 0 not outside: |x - t c| = t r, with s = <x, u>: t = |x|^2/(2 r s) on the
     * boundary */
    for (int i = 0; i < n; i++) x[i] = scale * r * w[i];
    const double s = dot(n, x, u), square = dot(n, x, x);
    if (rho < 1) {
        const double a = r * r * (1 - rho * rho), b = rho * r * s;
        need(cps_set_gauge(ball, x, &answer, &err), "gauge");
        near("gauge", answer.value, (sqrt(b * b + a * square) - b) / a, 1e-9 * scale);
    } else if (rho == 1) {
        need(cps_set_gauge(ball, x, &answer, &err), "gauge");
        const bool some = s > 1e-9 * scale * r;
        if (some)
            near("gauge on the boundary", answer.value, square / (2 * r * s),
                 1e-9 * square / (2 * r * s));
        else
            same("no gauge", isinf(answer.value) || answer.outcome != CPS_SET_OUTCOME_ANSWERED, 1);
    }
    /* the polar at 1/h along w, h = <w, c> + r |w|: its boundary, where there is one */
    const double h = dot(n, w, c) + r;
    CpsSetAnswer inside;
    for (int i = 0; i < n; i++) x[i] = w[i] * (h > 1e-9 * r ? 0.5 / h : 1 / r);
    need(cps_set_contains(polar, x, NULL, &inside, &err), "contains");
    same("outcome of the margin", inside.outcome, CPS_SET_OUTCOME_ANSWERED);
    if (!(inside.value >= -1e-9 / r)) fail("a point of the polar", inside.value, 0);
    if (h > 1e-9 * r) {
        for (int i = 0; i < n; i++) x[i] = w[i] * 1.5 / h;
        need(cps_set_contains(polar, x, NULL, &inside, &err), "contains");
        if (!(inside.value < 0)) fail("no point of the polar", inside.value, -1);
    }
    support_of_polar(polar, n, rho, r, u, w);
    if (below(3) == 0) { /* across the axis */
        w[0] = -u[1];
        w[1] = u[0];
        for (int i = 2; i < n; i++) w[i] = 0;
        if (dot(n, w, w) > 0) support_of_polar(polar, n, rho, r, u, w);
    }
    cps_set_release(polar);
    cps_set_release(ball);
}

/* ---- cones and infinite ends ---- */

/* {(F, N) : |F| <= f N}, 1 to 3 components, times a size: support 0 or infinite; cone of velocities
 * at 0, inside, on the mantle. */
static void friction_cone(void) {
    const int n = 2 + below(2);
    const double f = 0.25 * below(5), size = pow(10, digit(9)), N = size * (1 + below(3));
    double e[3] = {1, 0, 0}, force[3] = {0}, normals[5 * 3] = {0}, w[3], outside[3] = {0};
    if (n == 3) unit_vector(2, e);
    CpsSet *cone = NULL;
    CpsSetAnswer answer;
    need(cps_set_friction_cone(n, f, &cone, &err), "friction cone");
    /* <F, w> + N wn <= N (f |w| + wn) */
    double length = 0;
    for (int i = 0; i < n - 1; i++) {
        w[i] = digit(3);
        length += w[i] * w[i];
    }
    length = sqrt(length);
    w[n - 1] = -f * length + digit(1);
    need(cps_set_support(cone, w, NULL, &answer, &err), "support");
    same("outcome of the support", answer.outcome,
         f * length + w[n - 1] > 1e-9 ? CPS_SET_OUTCOME_UNBOUNDED : CPS_SET_OUTCOME_ANSWERED);
    const int where = below(3); /* at the tip, inside, on the mantle */
    if (where > 0) force[n - 1] = N;
    for (int i = 0; i < n - 1; i++) force[i] = where == 2 ? f * N * e[i] : 0;
    outside[n - 1] = -1; /* (0, -1) opens the contact's way: -V = (0, 1) is no normal */
    int count = 0;
    if (where == 0) {
        for (int side = -1; side <= 1; side += 2, count++) {
            for (int i = 0; i < n - 1; i++) normals[count * n + i] = side * e[i];
            normals[count * n + n - 1] = -f;
        }
        compare_cone(cone, n, force, count, normals, n, outside);
    } else if (where == 1 && f > 0) {
        compare_cone(cone, n, force, 0, normals, 0, outside);
    } else if (where == 2 && f > 0) {
        for (int i = 0; i < n - 1; i++) normals[i] = e[i];
        normals[n - 1] = -f;
        compare_cone(cone, n, force, 1, normals, 1, outside);
    } else { /* a ray: all that is across */
        for (int side = -1; side <= 1; side += 2, count++)
            for (int i = 0; i < n - 1; i++) normals[count * n + i] = side * e[i];
        compare_cone(cone, n, force, count, normals, n - 1, outside);
    }
    cps_set_release(cone);
}

/* A stop [0, inf) on x beside friction b in x and y, driven with (w, v): w > 0 lifts off, w = 0
 * leaves the reaction open, w < 0 is blocked. With U = x and forces >= 0 of the stop, phi is 0 for
 * x >= 0, else infinite. */
static void one_sided(void) {
    const double b = pow(10, digit(9)), w[2] = {digit(2), digit(2)};
    CpsSet *stop = NULL, *friction = NULL;
    CpsSystem *system = NULL;
    CpsMotion *motion = NULL;
    need(cps_set_interval(0, INFINITY, &stop, &err), "interval");
    need(cps_set_box(2, (double[]){-b, -2 * b}, (double[]){b, 2 * b}, &friction, &err), "box");
    CpsLaw *laws[2] = {law_of(stop), law_of(friction)};
    need(cps_system_create(2, &system, &err), "system");
    need(cps_system_add_friction(system, "stop", laws[0], 1, (const CpsEntry[]){{0, 0, 1}}, &err),
         "add");
    need(cps_system_add_friction(system, "table", laws[1], 2,
                                 (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err),
         "add");
    need(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 0, 1}, {1, 1, 1}}, &err),
         "drive");
    need(cps_system_solve(system, w, NULL, &motion, &err), "solve");
    const CpsMotionReport report = cps_motion_report(motion);
    const int expected = w[0] < 0 ? CPS_MOTION_OUTCOME_BLOCKED : CPS_MOTION_OUTCOME_SOLVED;
    same("outcome", report.outcome, expected);
    if (w[0] >= 0) near("gamma", report.value, b * w[0] + 2 * b * fabs(w[1]), 1e-8 * b);
    if (w[0] >= 0) same("Proposition 1", report.composition, CPS_COMPOSITION_INTERIOR);
    CpsSolutionSet all;
    double low[2], high[2];
    need(cps_motion_resistances(motion, 0, &all, low, high, &err), "resistances");
    if (w[0] == 0) {
        same("resistance is open above", isinf(high[0]) && high[0] > 0, 1);
        near("resistance at least", low[0], -b, 1e-6 * b);
    } else if (w[0] > 0) {
        near("resistance", low[0], -b, 1e-6 * b);
        near("resistance", high[0], -b, 1e-6 * b);
    }
    cps_solution_set_clear(&all);
    cps_motion_destroy(motion);
    cps_system_destroy(system);
    cps_law_release(laws[0]);
    cps_law_release(laws[1]);
}

static void try_cone(void) {
    if (below(2))
        friction_cone();
    else
        one_sided();
}

int main(int argc, char **argv) {
    static void (*const TRY[CLASSES])(void) = {try_polygon,   try_solid, try_lines, try_touching,
                                               try_unbounded, try_flat,  try_limit, try_table,
                                               try_wheel,     try_polar, try_cone};
    static const char *const NAME[CLASSES] = {"polygon",   "solid", "lines", "touching",
                                              "unbounded", "flat",  "limit", "table",
                                              "wheel",     "polar", "cone"};
    long cases = 200, first = 1;
    int wrong[CLASSES] = {0}, tried[CLASSES] = {0};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases")) cases = atol(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) first = atol(argv[i + 1]);
    }
    for (long i = 0; i < cases; i++) {
        seed = (uint64_t)(first + i);
        state = seed * 0x9e3779b97f4a7c15u;
        class_of_case = (int)(seed % CLASSES);
        failed[class_of_case] = 0;
        TRY[class_of_case]();
        tried[class_of_case]++;
        wrong[class_of_case] += failed[class_of_case];
        failures += failed[class_of_case];
    }
    for (int k = 0; k < CLASSES; k++)
        printf("%-10s %6d cases, %d wrong\n", NAME[k], tried[k], wrong[k]);
    printf("%ld cases, %d wrong\n", cases, failures);
    return failures > 0;
}
