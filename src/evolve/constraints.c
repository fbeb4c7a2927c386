/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that are held to sets (constraints.h). */
#include "evolve/constraints.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"
#include "cable/end_set.h"
#include "cable/place_form.h"
#include "evolve/places.h"
#include "evolve/ranges.h"
#include "evolve/sections.h"
#include "evolve/start.h"

/* A reaction of this share of the largest force counts as one. */
static const double ACTIVE = 1e-9;

/* What is held to a set: an end of a line, or where `line` is NULL a point. */
typedef struct HeldToSet {
    const CpsLine *line;
    int end;
    const CpsPoint *point;
    const CpsConstraint *on;
} HeldToSet;

static HeldToSet end_of(const CpsLine *line, int end) {
    return (HeldToSet){.line = line, .end = end, .on = &line->constraint[end]};
}

static CpsStatus refuse(const HeldToSet *held, const char *key, const char *what, CpsError *err) {
    char place[32];
    if (!held->line) {
        snprintf(place, sizeof place, "on%s%s", key[0] ? "." : "", key);
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "point '%s': its set %s",
                            held->point->name, what);
    }
    const char letter = cpsi_end_letter(held->end)[0];
    snprintf(place, sizeof place, "ends.%c.on%s%s", letter, key[0] ? "." : "", key);
    return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "line '%s': ends: the set of end %c %s",
                        held->line->name, letter, what);
}

/* The form of a set that is given by an expression; the caller frees it. */
static CpsStatus make_form(const HeldToSet *held, CpsiPlaceForm **out, CpsError *err) {
    CpsError found;
    const CpsStatus status = cpsi_place_form_make(held->on, out, &found);
    if (status == CPS_OK) return status;
    if (status == CPS_ERR_MEMORY)
        return cpsi_fail(err, status, "no memory for the set of %s '%s'",
                         held->line ? "an end of line" : "point",
                         held->line ? held->line->name : held->point->name);
    return refuse(held, "set", found.message, err);
}

static CpsStatus check_numbers(const HeldToSet *held, CpsError *err) {
    const CpsConstraint *on = held->on;
    const double size = vec3_norm(vec3_load(on->axis));
    const bool has_axis = on->kind == CPS_CONSTRAINT_KIND_RAIL ||
                          on->kind == CPS_CONSTRAINT_KIND_HALF_SPACE ||
                          on->kind == CPS_CONSTRAINT_KIND_DISC,
               is_round =
                   on->kind == CPS_CONSTRAINT_KIND_BALL || on->kind == CPS_CONSTRAINT_KIND_DISC;
    if (on->kind < CPS_CONSTRAINT_KIND_NONE || on->kind > CPS_CONSTRAINT_KIND_SET)
        return refuse(held, "", "is of an unknown kind", err);
    if (!cpsi_are_usable(on->point)) return refuse(held, "", "has a point that is not finite", err);
    if (has_axis && !(cpsi_are_usable(on->axis) && size > 0 && isfinite(size)))
        return refuse(held, "",
                      "has an axis without a direction, expected one of any non-zero "
                      "length",
                      err);
    if (is_round && !cpsi_is_positive(on->radius))
        return refuse(held, "", "has a radius that is no finite number > 0", err);
    if (on->kind == CPS_CONSTRAINT_KIND_RAIL && !(on->length > 0))
        return refuse(held, "", "is a rail whose length is no number > 0", err);
    if (on->kind == CPS_CONSTRAINT_KIND_RAIL && isfinite(on->length) &&
        !cpsi_is_positive(on->length))
        return refuse(held, "", "is a rail that is too long", err);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX)
        for (int a = 0; a < 3; a++)
            if (!cpsi_is_positive(on->size[a]))
                return refuse(held, "", "is a box with a size that is no finite number > 0", err);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX)
        for (int a = 0; a < 4; a++)
            if (!cpsi_is_usable(on->rotation[a]))
                return refuse(held, "", "is a box whose rotation is not finite", err);
    return CPS_OK;
}

/* Is x in the set, as far as `tolerance` [m] tells? `placed`: statics puts it there. */
static CpsStatus check_place(const HeldToSet *held, Vec3 x, bool placed, double tolerance,
                             CpsError *err) {
    CpsiEndSet on = {.is_there = true, .set = cpsi_place_set(held->on)};
    if (held->on->kind == CPS_CONSTRAINT_KIND_SET) {
        const CpsStatus status = make_form(held, &on.form, err);
        if (status != CPS_OK) return status;
    }
    const Vec3 near = placed ? x : cpsi_end_set_project(&on, x);
    cpsi_place_form_free(on.form);
    const double off = vec3_norm(vec3_sub(near, x));
    if (off <= tolerance) return CPS_OK;
    char what[200];
    snprintf(what, sizeof what,
             "is %g m away from where the start puts the %s, (%.6g, %.6g, %.6g) m: let it begin in "
             "the set, as at (%.6g, %.6g, %.6g) m",
             off, held->line ? "end" : "point", x.x, x.y, x.z, near.x, near.y, near.z);
    return refuse(held, "", what, err);
}

static CpsStatus check_one(const CpsLine *line, int end, CpsError *err) {
    const HeldToSet held = end_of(line, end);
    const CpsStatus status = check_numbers(&held, err);
    if (status != CPS_OK || held.on->kind == CPS_CONSTRAINT_KIND_NONE) return status;
    if (line->end[end].kind != CPS_END_KIND_FREE)
        return refuse(&held, "",
                      "needs a free end, which a force may act on: leave the set out, "
                      "or let the end be free",
                      err);
    if (line->winch[0].is_there || line->winch[1].is_there)
        return refuse(&held, "", "does not go together with a winch: leave one of them out", err);
    if (cpsi_has_break_at(line))
        return refuse(&held, "",
                      "does not go together with break_at: give the line a "
                      "breaking_load, which is only reported",
                      err);
    const bool placed = line->start.kind == CPS_START_STATIC;
    double start[3] = {0};
    if (!placed) cpsi_start_end(line, end, start);
    const Vec3 x = vec3_load(start);
    return check_place(&held, x, placed, cpsi_place_tolerance(line, x), err);
}

/* Do all lines that end at a point start by statics, which finds its place? */
static bool is_placed(const CpsScene *scene, int point) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (cpsi_point_of(&scene->line[i], end) == point &&
                scene->line[i].start.kind != CPS_START_STATIC)
                return false;
    return true;
}

static CpsStatus check_point(const CpsScene *scene, int index, CpsError *err) {
    const CpsPoint *point = &scene->point[index];
    const HeldToSet held = {.point = point, .on = &point->constraint};
    const CpsStatus status = check_numbers(&held, err);
    if (status != CPS_OK || held.on->kind == CPS_CONSTRAINT_KIND_NONE) return status;
    if (point->kind != CPS_POINT_KIND_FREE)
        return refuse(&held, "", "needs a free point: leave the set out, or let the point be free",
                      err);
    if (scene->has_water_surface && point->displaced_weight > 0)
        return refuse(&held, "",
                      "does not go together with a point that may leave the water: leave "
                      "water_surface or its volume out",
                      err);
    const CpsLine longest = {.length = cpsi_longest_line(scene, index)};
    const Vec3 x = vec3_load(point->position);
    return check_place(&held, x, is_placed(scene, index), cpsi_place_tolerance(&longest, x), err);
}

CpsStatus cpsi_constraints_check_points(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (scene->line[i].constraint[end].kind != CPS_CONSTRAINT_KIND_NONE &&
                scene->line[i].end[!end].kind == CPS_END_KIND_POINT) {
                const HeldToSet held = end_of(&scene->line[i], end);
                return refuse(&held, "",
                              "does not go together with a point at the other end: let this end "
                              "be at a point too, which the set holds",
                              err);
            }
    CpsStatus status = CPS_OK;
    for (int i = 0; i < scene->point_count && status == CPS_OK; i++)
        status =
            cpsi_fail_inside(err, check_point(scene, i, err), "points.%s", scene->point[i].name);
    return status;
}

CpsStatus cpsi_constraints_check(const CpsLine *line, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int end = 0; end < 2 && status == CPS_OK; end++) status = check_one(line, end, err);
    return status;
}

CpsStatus cpsi_constraints_check_stage(const CpsScene *scene, const CpsStage *stage,
                                       const char *what, CpsError *err) {
    for (int i = 0; i < stage->change_count; i++) {
        const CpsChange *change = &stage->change[i];
        const CpsLine *line = &scene->line[change->line];
        char place[80];
        if (line->constraint[change->end].kind == CPS_CONSTRAINT_KIND_NONE ||
            change->to.kind == CPS_END_KIND_FREE)
            continue;
        snprintf(place, sizeof place, "%s.%s", line->name, cpsi_end_letter(change->end));
        return CPSI_FAIL_AT(
            place, err, CPS_ERR_ARGUMENT,
            "%s: %s.%s is %s, but it is held to a set, which stays where it is: give "
            "it a force",
            what, line->name, cpsi_end_letter(change->end),
            change->to.kind == CPS_END_KIND_HELD ? "moved" : "released");
    }
    for (int i = 0; i < stage->point_change_count; i++) {
        const CpsPoint *point = &scene->point[stage->point_change[i].point];
        char place[80];
        if (point->constraint.kind == CPS_CONSTRAINT_KIND_NONE ||
            stage->point_change[i].kind == CPS_POINT_KIND_FREE)
            continue;
        snprintf(place, sizeof place, "%s.point", point->name);
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "%s: point '%s' is moved, but it is held to a set, which stays where "
                            "it is: give it a force",
                            what, point->name);
    }
    if (!(stage->duration > 0)) return CPS_OK;
    for (int i = 0; i < scene->point_count; i++)
        if (scene->point[i].constraint.kind != CPS_CONSTRAINT_KIND_NONE)
            return CPSI_FAIL_AT("duration", err, CPS_ERR_ARGUMENT,
                                "%s: it has a duration, but point '%s' is held to a set, which has "
                                "no impacts: leave the duration out",
                                what, scene->point[i].name);
    for (int k = 0; k < scene->line_count; k++)
        for (int end = 0; end < 2; end++)
            if (scene->line[k].constraint[end].kind != CPS_CONSTRAINT_KIND_NONE)
                return CPSI_FAIL_AT("duration", err, CPS_ERR_ARGUMENT,
                                    "%s: it has a duration, but end %s of line '%s' is held to a "
                                    "set, which has no impacts: leave the duration out",
                                    what, cpsi_end_letter(end), scene->line[k].name);
    return CPS_OK;
}

CpsStatus cpsi_constraints_make(CpsEvolution *evolution, const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const HeldToSet held = end_of(&scene->line[i], end);
            if (held.on->kind != CPS_CONSTRAINT_KIND_SET) continue;
            const CpsStatus status = make_form(&held, &evolution->line[i].on[end].form, err);
            if (status != CPS_OK) return status;
        }
    for (int i = 0; i < scene->point_count; i++) {
        const HeldToSet held = {.point = &scene->point[i], .on = &scene->point[i].constraint};
        if (held.on->kind != CPS_CONSTRAINT_KIND_SET) continue;
        const CpsStatus status = make_form(&held, &evolution->points.point[i].on.form, err);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

void cpsi_constraints_free(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) cpsi_place_form_free(evolution->line[i].on[end].form);
    for (int i = 0; i < evolution->points.count; i++)
        cpsi_place_form_free(evolution->points.point[i].on.form);
}

/* A set, but for what belongs to an expression. */
static CpsiEndSet set_of(const CpsConstraint *given) {
    CpsiEndSet out = {.is_there = given->kind != CPS_CONSTRAINT_KIND_NONE};
    if (out.is_there) out.set = cpsi_place_set(given);
    return out;
}

void cpsi_constraints_fill(CpsiLine *line, const CpsLine *given) {
    for (int end = 0; end < 2; end++) line->on[end] = set_of(&given->constraint[end]);
}

void cpsi_point_constraints_fill(CpsiPoints *points, const CpsScene *scene) {
    points->count = scene->point_count;
    for (int i = 0; i < scene->point_count; i++)
        points->point[i].on = set_of(&scene->point[i].constraint);
}

/* The report on what is held to a set at x. */
static CpsConstraintReport report_on(const CpsiEndSet *on, Vec3 x, double largest) {
    CpsConstraintReport out = {.is_there = true, .gap = cpsi_end_set_gap(on, x)};
    const Vec3 r = cpsi_place_set_from(&on->set, on->reaction);
    vec3_store(out.reaction, r);
    out.residual = vec3_norm(vec3_sub(cpsi_end_set_project(on, x), x));
    out.is_active = vec3_norm(r) > ACTIVE * largest;
    return out;
}

CpsConstraintReport cps_evolution_constraint_report(const CpsEvolution *evolution, int line,
                                                    int end) {
    const CpsConstraintReport none = {.is_there = false};
    if (!evolution || line < 0 || line >= evolution->line_count ||
        (end != CPS_END_A && end != CPS_END_B))
        return none;
    const CpsiLine *of = &evolution->line[line];
    if (!of->on[end].is_there) return none;
    return report_on(&of->on[end], vec3_at(of->position, end == CPS_END_A ? 0 : of->n - 1),
                     of->report.certificate.largest_force);
}

CpsConstraintReport cps_evolution_point_constraint_report(const CpsEvolution *evolution,
                                                          int point) {
    const CpsConstraintReport none = {.is_there = false};
    if (!evolution || point < 0 || point >= evolution->points.count) return none;
    const CpsiPoint *of = &evolution->points.point[point];
    double largest = 0;
    if (!of->on.is_there) return none;
    for (int i = 0; i < 2 * evolution->line_count; i++)
        if (evolution->points.tie[i] == point)
            largest = fmax(largest, evolution->line[i / 2].report.certificate.largest_force);
    return report_on(&of->on, vec3_load(of->position), largest);
}
