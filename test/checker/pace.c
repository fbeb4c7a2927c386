/* SPDX-License-Identifier: BSD-3-Clause */
/* The errors of steps (pace.h), by Taylor's series about the end of a step.
 *
 * Of the formula of the second order it is (h^3/6) (1 + w)^2/(w (1 + 2 w)) x''', w the length h
 * over that of the step before: x''' is twice the second divided difference of the velocity, whose
 * value two steps ago is in v* = v + b (v - v_older). Of an Euler step it is h^2 x''/2. What bears
 * on something rigid is there, and its error lies across the normals. Forces of a step are known to
 * a share of the largest: where a reaction is fainter, the node may be there or just off it. */
#include "pace.h"

#include <math.h>
#include <netcdf.h>
#include <stdlib.h>
#include <string.h>

#include "bodies.h"
#include "formula.h"
#include "grasps.h"
#include "joint_motion.h"

static const double PLACES = 1e-13, SHARES = 1e-9, FAINT = 1e-7;

/* The three velocities of a thing, the last first, of which that before the others may not be
 * known, and v* of the step. */
typedef struct Velocities {
    Real now[3], before[3], star[3];
} Velocities;

/* The lengths of the steps. */
typedef struct Lengths {
    double h, h_before, span; /* [s] */
} Lengths;

static bool is_euler(const Lengths *of) { return formula_is_euler(of->span, of->h); }

/* The displacement by which the step is wrong. */
static void error_of(const Lengths *of, const Velocities *v, Real out[3]) {
    const Real h = of->h, w = is_euler(of) ? 0 : h / of->h_before,
               back = formula_of(of->span, of->h, of->h_before).back,
               factor = h * h * (1 + w) * (1 + w) / (3 * w * (1 + 2 * w));
    for (int a = 0; a < 3; a++) {
        const Real last = (v->now[a] - v->before[a]) / h;
        if (is_euler(of)) {
            out[a] = h * h * last / 2;
            continue;
        }
        const Real first = (v->star[a] - v->before[a]) / back / of->h_before,
                   second = (last - first) / (h + of->h_before);
        out[a] = factor * h * second;
    }
}

static double size_of(const Real *v) {
    return (double)sqrtl(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* A thing's error is `least` to `most`. */
static void raise_to(StepError *to, double least, double most, double reach) {
    to->least = fmax(to->least, least);
    to->most = fmax(to->most, most);
    to->noise = fmax(to->noise, PLACES * reach + SHARES * most);
}

/* ---- lines ---- */

static bool is_at_point(const Record *r, size_t j) {
    return (j == 0 && r->end_point[0] >= 0) || (j == r->elements && r->end_point[1] >= 0);
}

static void add_line(const Source *source, const Record *r, const Record *before, StepError *out) {
    double reach = 0;
    for (size_t j = 0; j < r->nodes; j++)
        for (int a = 0; a < 3; a++) reach = fmax(reach, fabs(r->position[j][a]));
    for (size_t j = 0; j < r->nodes; j++) {
        if (node_is_held(r, j) || is_at_point(r, j)) continue;
        const Lengths of = {r->step_length, before->step_length, r->span[j]};
        Velocities v;
        Real off[3];
        for (int a = 0; a < 3; a++) {
            v.now[a] = ((Real)r->position[j][a] - r->reference[j][a]) / r->span[j];
            v.before[a] = before->velocity[j][a];
            v.star[a] = r->rest_velocity[j][a];
        }
        error_of(&of, &v, off);
        inertia_across(source, r, j, FAINT * r->claim[CLAIM_LARGEST_FORCE], off);
        const double most = size_of(off);
        inertia_across(source, r, j, 0, off);
        raise_to(out, size_of(off), most, reach);
    }
}

static int add_lines(const Source *source, const char *line, StepError *out, FILE *log) {
    Record record = {0}, before = {0};
    int bad =
        record_create(source, line, &record, log) || record_create(source, line, &before, log);
    for (size_t s = 0; s < source->steps && !bad && record.mass; s++) {
        bad = record_read(source, line, s, &record, log);
        if (!bad && in_time(&record) && s > 0 && record.outcome <= OUTCOME_TAUT)
            add_line(source, &record, &before, &out[s]);
        if (!bad && in_time(&record) && s == 0) out[s].noise = INFINITY;
        const Record swap = before;
        before = record;
        record = swap;
    }
    record_destroy(&record);
    record_destroy(&before);
    return bad ? -1 : 0;
}

/* ---- points ---- */

static void add_point(const Source *source, const Junction *at, const PointMotion *motion,
                      const PointMotion *before, const Lengths *of, StepError *out) {
    Velocities v;
    Real off[3], along = 0;
    double reach = 0;
    if (at->state == POINT_HELD || !(motion->span > 0)) return;
    for (int a = 0; a < 3; a++) {
        v.now[a] = ((Real)at->position[a] - motion->reference[a]) / motion->span;
        v.before[a] = before->velocity[a];
        v.star[a] = motion->rest_velocity[a];
        reach = fmax(reach, fabs(at->position[a]));
    }
    error_of(of, &v, off);
    if (at->state != POINT_ON_BODY && at->reaction > 0 &&
        !(source->surface[at->obstacle].gives > 0))
        for (int a = 0; a < 3; a++) along += off[a] * at->normal[a];
    for (int a = 0; a < 3; a++) off[a] -= along * at->normal[a];
    raise_to(out, size_of(off), size_of(off), reach);
}

static int add_points(const Source *source, StepError *out, FILE *log) {
    const size_t n = source->points;
    if (n == 0) return 0;
    Junction *now = calloc(n + 1, sizeof *now);
    PointMotion *motion = calloc(2 * n + 1, sizeof *motion);
    int bad = now && motion ? 0 : -1;
    for (size_t s = 0; s < source->steps && !bad; s++) {
        PointMotion *at = &motion[s % 2 * n], *before = &motion[(s + 1) % 2 * n];
        bad = junctions_read(source, s, now, log) || point_motions_read(source, s, at, log);
        if (bad || s == 0) continue;
        for (size_t k = 0; k < n; k++) {
            const Lengths of = {step_length_of(source, s), step_length_of(source, s - 1),
                                at[k].span};
            add_point(source, &now[k], &at[k], &before[k], &of, &out[s]);
        }
    }
    free(now);
    free(motion);
    return bad ? -1 : 0;
}

/* ---- bodies ---- */

/* Three vectors, and the length that goes with each. */
static void add_body(const BodyState *at, const BodyMotion *m, const BodyMotion *before,
                     const BodyMotion *older, const Lengths *of, StepError *out) {
    const double most = fmax(m->moments[0], fmax(m->moments[1], m->moments[2])),
                 length[3] = {1, 1, m->mass > 0 ? sqrt(most / m->mass) : 0};
    const double *const now[3] = {m->velocity, m->centre_velocity, m->rate},
                        *const last[3] = {before->velocity, before->centre_velocity, before->rate},
                        *const past[3] = {older ? older->velocity : NULL,
                                          older ? older->centre_velocity : NULL,
                                          older ? older->rate : NULL};
    const Real back = formula_of(of->span, of->h, of->h_before).back;
    double reach = 0;
    for (int a = 0; a < 3; a++) reach = fmax(reach, fabs(at->position[a]));
    for (int k = 0; k < 3; k++) {
        Velocities v;
        Real off[3];
        for (int a = 0; a < 3; a++) {
            v.now[a] = now[k][a];
            v.before[a] = last[k][a];
            v.star[a] =
                is_euler(of) ? v.before[a] : v.before[a] + back * (v.before[a] - past[k][a]);
        }
        error_of(of, &v, off);
        const double size = length[k] * size_of(off);
        raise_to(out, size, size, reach + length[k]);
    }
}

static int add_bodies(const Source *source, StepError *out, FILE *log) {
    Bodies bodies;
    int bad = bodies_open(source, &bodies, log);
    const size_t n = bad ? 0 : bodies.count;
    if (n == 0) {
        bodies_close(&bodies);
        return bad;
    }
    BodyState *now = calloc(n + 1, sizeof *now);
    BodyMotion *motion = calloc(3 * n + 1, sizeof *motion);
    if (!now || !motion) bad = -1;
    for (size_t s = 0; s < source->steps && !bad; s++) {
        BodyMotion *at = &motion[s % 3 * n], *before = &motion[(s + 2) % 3 * n],
                   *older = &motion[(s + 1) % 3 * n];
        bad = bodies_read(source, &bodies, s, now, log) || body_motions_read(source, n, s, at, log);
        if (bad || s == 0) continue;
        for (size_t k = 0; k < n; k++) {
            const Lengths of = {step_length_of(source, s), step_length_of(source, s - 1),
                                at[k].span};
            if (now[k].kind != BODY_FREE || !(at[k].span > 0)) continue;
            if (!is_euler(&of) && s < 2)
                out[s].noise = INFINITY;
            else
                add_body(&now[k], &at[k], &before[k], s < 2 ? NULL : &older[k], &of, &out[s]);
        }
    }
    free(now);
    free(motion);
    bodies_close(&bodies);
    return bad ? -1 : 0;
}

/* ---- all ---- */

int pace_errors(const Source *source, StepError *out, FILE *log) {
    memset(out, 0, source->steps * sizeof *out);
    for (size_t i = 0; i < source->lines; i++)
        if (add_lines(source, source->line_name[i], out, log)) return -1;
    if (add_points(source, out, log) || add_bodies(source, out, log)) return -1;
    /* where the first step of the file began is not in it */
    if (source->steps > 0 && step_length_of(source, 0) > 0) out[0].noise = INFINITY;
    return 0;
}

bool pace_agrees(double said, const StepError *own) {
    return said >= own->least - own->noise && said <= own->most + own->noise;
}

int pace_said(const Source *source, double *out, FILE *log) {
    int id;
    const size_t first = 0, count = source->steps;
    memset(out, 0, count * sizeof *out);
    if (nc_inq_varid(source->nc, "step_error", &id) != NC_NOERR) return 0;
    if (nc_get_vara_double(source->nc, id, &first, &count, out) == NC_NOERR) return 0;
    if (log) fprintf(log, "missing errors of steps\n");
    return -1;
}

int pace_check(const Source *source, InertiaFind *find, void *user, FILE *log) {
    double *said = calloc(source->steps + 1, sizeof *said);
    StepError *own = calloc(source->steps + 1, sizeof *own);
    int bad = said && own ? pace_said(source, said, log) : -1;
    size_t count = 0; /* of steps that say something */
    inertia_times(source, find, user);
    if (!bad)
        for (size_t s = 0; s < source->steps; s++) count += said[s] != 0;
    if (count > 0) bad = pace_errors(source, own, log);
    if (count > 0 && !bad)
        for (size_t s = 0; s < source->steps; s++)
            if (said[s] != 0 && !pace_agrees(said[s], &own[s]))
                find(user, "step_error", said[s], own[s].most);
    free(said);
    free(own);
    return bad;
}
