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

static CpsStatus refuse(const CpsLine *line, int end, const char *key, const char *what,
                        CpsError *err) {
    char place[32];
    snprintf(place, sizeof place, "ends.%s.on%s%s", cpsi_end_letter(end), key[0] ? "." : "", key);
    return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT, "line '%s': ends: the set of end %s %s",
                        line->name, cpsi_end_letter(end), what);
}

/* The form of a set that is given by an expression; the caller frees it. */
static CpsStatus make_form(const CpsLine *line, int end, CpsiPlaceForm **out, CpsError *err) {
    CpsError found;
    const CpsStatus status = cpsi_place_form_make(&line->constraint[end], out, &found);
    if (status == CPS_OK) return status;
    if (status == CPS_ERR_MEMORY)
        return cpsi_fail(err, status, "no memory for the set of an end of line '%s'", line->name);
    return refuse(line, end, "set", found.message, err);
}

static CpsStatus check_numbers(const CpsLine *line, int end, CpsError *err) {
    const CpsConstraint *on = &line->constraint[end];
    const double size = vec3_norm(vec3_load(on->axis));
    const bool has_axis = on->kind == CPS_CONSTRAINT_KIND_RAIL ||
                          on->kind == CPS_CONSTRAINT_KIND_HALF_SPACE ||
                          on->kind == CPS_CONSTRAINT_KIND_DISC,
               is_round =
                   on->kind == CPS_CONSTRAINT_KIND_BALL || on->kind == CPS_CONSTRAINT_KIND_DISC;
    if (on->kind < CPS_CONSTRAINT_KIND_NONE || on->kind > CPS_CONSTRAINT_KIND_SET)
        return refuse(line, end, "", "is of an unknown kind", err);
    if (!cpsi_are_usable(on->point))
        return refuse(line, end, "", "has a point that is not finite", err);
    if (has_axis && !(cpsi_are_usable(on->axis) && size > 0 && isfinite(size)))
        return refuse(line, end, "",
                      "has an axis without a direction, expected one of any non-zero "
                      "length",
                      err);
    if (is_round && !cpsi_is_positive(on->radius))
        return refuse(line, end, "", "has a radius that is no finite number > 0", err);
    if (on->kind == CPS_CONSTRAINT_KIND_RAIL && !(on->length > 0))
        return refuse(line, end, "", "is a rail whose length is no number > 0", err);
    if (on->kind == CPS_CONSTRAINT_KIND_RAIL && isfinite(on->length) &&
        !cpsi_is_positive(on->length))
        return refuse(line, end, "", "is a rail that is too long", err);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX)
        for (int a = 0; a < 3; a++)
            if (!cpsi_is_positive(on->size[a]))
                return refuse(line, end, "", "is a box with a size that is no finite number > 0",
                              err);
    if (on->kind == CPS_CONSTRAINT_KIND_BOX)
        for (int a = 0; a < 4; a++)
            if (!cpsi_is_usable(on->rotation[a]))
                return refuse(line, end, "", "is a box whose rotation is not finite", err);
    return CPS_OK;
}

static CpsStatus check_one(const CpsLine *line, int end, CpsError *err) {
    CpsStatus status = check_numbers(line, end, err);
    if (status != CPS_OK || line->constraint[end].kind == CPS_CONSTRAINT_KIND_NONE) return status;
    if (line->end[end].kind != CPS_END_KIND_FREE)
        return refuse(line, end, "",
                      "needs a free end, which a force may act on: leave the set out, "
                      "or let the end be free",
                      err);
    if (line->winch[0].is_there || line->winch[1].is_there)
        return refuse(line, end, "", "does not go together with a winch: leave one of them out",
                      err);
    if (cpsi_has_break_at(line))
        return refuse(line, end, "",
                      "does not go together with break_at: give the line a "
                      "breaking_load, which is only reported",
                      err);
    CpsiEndSet on = {.is_there = true, .set = cpsi_place_set(&line->constraint[end])};
    if (line->constraint[end].kind == CPS_CONSTRAINT_KIND_SET) {
        status = make_form(line, end, &on.form, err);
        if (status != CPS_OK) return status;
    }
    const bool placed = line->start.kind == CPS_START_STATIC;
    double start[3] = {0};
    if (!placed) cpsi_start_end(line, end, start);
    const Vec3 x = vec3_load(start), near = placed ? x : cpsi_end_set_project(&on, x);
    cpsi_place_form_free(on.form);
    const double off = vec3_norm(vec3_sub(near, x));
    if (off <= cpsi_place_tolerance(line, x)) return CPS_OK;
    char what[200];
    snprintf(
        what, sizeof what,
        "is %g m away from where the start puts the end, (%.6g, %.6g, %.6g) m: let it begin in "
        "the set, as at (%.6g, %.6g, %.6g) m",
        off, x.x, x.y, x.z, near.x, near.y, near.z);
    return refuse(line, end, "", what, err);
}

CpsStatus cpsi_constraints_check_points(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (scene->line[i].constraint[end].kind != CPS_CONSTRAINT_KIND_NONE &&
                scene->line[i].end[!end].kind == CPS_END_KIND_POINT)
                return refuse(&scene->line[i], end, "",
                              "does not go together with a point at the other end: hold the "
                              "other end, or let it be free",
                              err);
    return CPS_OK;
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
    if (!(stage->duration > 0)) return CPS_OK;
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
            const CpsConstraint *on = &scene->line[i].constraint[end];
            if (on->kind != CPS_CONSTRAINT_KIND_SET) continue;
            const CpsStatus status =
                make_form(&scene->line[i], end, &evolution->line[i].on[end].form, err);
            if (status != CPS_OK) return status;
        }
    return CPS_OK;
}

void cpsi_constraints_free(CpsEvolution *evolution) {
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) cpsi_place_form_free(evolution->line[i].on[end].form);
}

void cpsi_constraints_fill(CpsiLine *line, const CpsLine *given) {
    for (int end = 0; end < 2; end++) {
        line->on[end] =
            (CpsiEndSet){.is_there = given->constraint[end].kind != CPS_CONSTRAINT_KIND_NONE};
        if (line->on[end].is_there) line->on[end].set = cpsi_place_set(&given->constraint[end]);
    }
}

CpsConstraintReport cps_evolution_constraint_report(const CpsEvolution *evolution, int line,
                                                    int end) {
    CpsConstraintReport out = {.is_there = false};
    if (!evolution || line < 0 || line >= evolution->line_count ||
        (end != CPS_END_A && end != CPS_END_B))
        return out;
    const CpsiLine *of = &evolution->line[line];
    const int j = end == CPS_END_A ? 0 : of->n - 1;
    if (!of->on[end].is_there) return out;
    const Vec3 r = cpsi_line_set_reaction(of, j), x = vec3_at(of->position, j);
    const Vec3 moved = cpsi_end_set_project(&of->on[end], x);
    out.is_there = true;
    vec3_store(out.reaction, r);
    out.gap = cpsi_line_set_gap(of, j);
    out.residual = vec3_norm(vec3_sub(moved, x));
    out.is_active = vec3_norm(r) > ACTIVE * of->report.certificate.largest_force;
    return out;
}
