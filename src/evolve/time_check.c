/* SPDX-License-Identifier: BSD-3-Clause */
/* What a scene gives for steps in time (time_check.h). */
#include "evolve/time_check.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "evolve/body_motion_check.h"
#include "evolve/radiation.h"
#include "evolve/ranges.h"

bool cpsi_is_in_time(const CpsScene *scene) {
    bool any = scene->in_time;
    /* also asked before the history is checked */
    if (!scene->stage) return any;
    for (int k = 0; k < scene->stage_count; k++) any = any || scene->stage[k].duration > 0;
    return any;
}

/* ---- the check ---- */

/* [kg/m] of section k of a line, or of a line of one make. */
static double inertia_of(const CpsLine *line, int k) {
    return line->section_count > 0 ? line->section[k].inertia : line->inertia;
}

/* Damping goes with one stiffness. */
static CpsStatus check_damping(const CpsLine *line, bool in_time, CpsError *err) {
    bool tables = line->stiffness_row_count > 0, stiff = !tables && isinf(line->stiffness),
         two = line->has_dynamic_stiffness;
    if (!cpsi_is_not_negative(line->damping))
        return CPSI_FAIL_AT("damping", err, CPS_ERR_ARGUMENT,
                            "line '%s': damping is %g N s, expected a finite number >= 0",
                            line->name, line->damping);
    if (line->section_count > 0) tables = stiff = two = false;
    for (int k = 0; k < line->section_count; k++) {
        const CpsSection *section = &line->section[k];
        tables = tables || section->stiffness_row_count > 0;
        stiff = stiff || (section->stiffness_row_count == 0 && isinf(section->stiffness));
        two = two || section->has_dynamic_stiffness;
    }
    if (line->damping > 0 && in_time && !line->quasi_static && (tables || stiff || two))
        return CPSI_FAIL_AT("damping", err, CPS_ERR_ARGUMENT,
                            "line '%s': damping: it goes with a stiffness that is one number, not "
                            "with %s: leave either out",
                            line->name,
                            stiff    ? "an inextensible line"
                            : tables ? "a table of strains and tensions"
                                     : "a dynamic stiffness");
    return CPS_OK;
}

static CpsStatus check_line(const CpsLine *line, bool in_time, CpsError *err) {
    const int makes = line->section_count > 0 ? line->section_count : 1;
    for (int k = 0; k < makes; k++) {
        const double inertia = inertia_of(line, k);
        if (!cpsi_is_not_negative(inertia))
            return CPSI_FAIL_AT("inertia", err, CPS_ERR_ARGUMENT,
                                "line '%s': inertia is %g kg/m, expected a finite number >= 0",
                                line->name, inertia);
        if (in_time && !line->quasi_static && !(inertia > 0))
            return CPSI_FAIL_AT("inertia", err, CPS_ERR_ARGUMENT,
                                "line '%s': inertia: a step of the history has a duration, but "
                                "the line has no mass to move: give its mass, or let it be "
                                "quasi_static",
                                line->name);
    }
    for (int k = 0; k < line->point_weight_count; k++)
        if (!cpsi_is_not_negative(line->point_weight[k].inertia))
            return CPSI_FAIL_AT("point_weights", err, CPS_ERR_ARGUMENT,
                                "line '%s': point_weights: number %d has the inertia %g kg, "
                                "expected a finite number >= 0",
                                line->name, k + 1, line->point_weight[k].inertia);
    const CpsStatus status = check_damping(line, in_time, err);
    if (status != CPS_OK) return status;
    const double *v = line->velocity;
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT("velocity", err, CPS_ERR_ARGUMENT,
                            "line '%s': velocity is (%g, %g, %g) m/s, expected finite numbers",
                            line->name, v[0], v[1], v[2]);
    bool parts = line->section_count == 0 && line->has_break_at;
    for (int k = 0; k < line->section_count; k++) parts = parts || line->section[k].has_break_at;
    if (in_time && parts)
        return CPSI_FAIL_AT("break_at", err, CPS_ERR_ARGUMENT,
                            "line '%s': break_at: lines do not part in a history of which a step "
                            "has a duration: leave it out",
                            line->name);
    if (in_time && (line->winch[CPS_END_A].is_there || line->winch[CPS_END_B].is_there))
        return CPSI_FAIL_AT("ends", err, CPS_ERR_ARGUMENT,
                            "line '%s': stored: winches do not wind in a history of which a step "
                            "has a duration: leave it out",
                            line->name);
    return CPS_OK;
}

/* Can points or bodies be free in the history? */
static bool may_be_free(const CpsScene *scene) {
    bool free = scene->body_count > 0;
    for (int i = 0; i < scene->point_count; i++)
        free = free || scene->point[i].kind != CPS_POINT_KIND_HELD;
    for (int k = 0; k < scene->stage_count; k++)
        for (int i = 0; i < scene->stage[k].point_change_count; i++)
            free = free || scene->stage[k].point_change[i].kind != CPS_POINT_KIND_HELD;
    return free;
}

/* A point that begins with a velocity moves from the first step on. */
static CpsStatus check_first_step(const CpsScene *scene, const char *what, const char *name,
                                  CpsError *err) {
    bool is_static = false;
    for (int i = 0; i < scene->line_count; i++)
        is_static = is_static || scene->line[i].start.kind == CPS_START_STATIC;
    if (!is_static) return CPS_OK;
    return CPSI_FAIL_AT("velocity", err, CPS_ERR_ARGUMENT,
                        "%s '%s': velocity: lines that start static are at rest after the first "
                        "step: leave it out, or start them otherwise",
                        what, name);
}

static bool moves(const double *v, int count) {
    bool any = false;
    for (int i = 0; i < count; i++) any = any || v[i] != 0;
    return any;
}

static CpsStatus check_point(const CpsScene *scene, int index, bool in_time, CpsError *err) {
    const CpsPoint *point = &scene->point[index];
    const double *v = point->velocity;
    if (!cpsi_is_not_negative(point->inertia))
        return CPSI_FAIL_AT("inertia", err, CPS_ERR_ARGUMENT,
                            "point '%s': inertia is %g kg, expected a finite number >= 0",
                            point->name, point->inertia);
    if (!cpsi_are_usable(v))
        return CPSI_FAIL_AT("velocity", err, CPS_ERR_ARGUMENT,
                            "point '%s': velocity is (%g, %g, %g) m/s, expected finite numbers",
                            point->name, v[0], v[1], v[2]);
    if (moves(v, 3) && point->kind != CPS_POINT_KIND_FREE)
        return CPSI_FAIL_AT("velocity", err, CPS_ERR_ARGUMENT,
                            "point '%s': velocity: only a free point begins with one", point->name);
    if (!in_time) return CPS_OK;
    if (point->drags)
        return CPSI_FAIL_AT("drags", err, CPS_ERR_ARGUMENT,
                            "point '%s': drags: a step of the history has a duration, in which "
                            "anchors do not drag: leave it out",
                            point->name);
    return moves(v, 3) ? check_first_step(scene, "point", point->name, err) : CPS_OK;
}

/* What a step in time cannot have beside free points and bodies. */
static CpsStatus check_beside_free(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++) {
        const CpsLine *line = &scene->line[i];
        bool stiff =
            line->section_count == 0 && line->stiffness_row_count == 0 && isinf(line->stiffness);
        for (int k = 0; k < line->section_count; k++)
            stiff = stiff || (line->section[k].stiffness_row_count == 0 &&
                              isinf(line->section[k].stiffness));
        if (stiff)
            return cpsi_fail_inside(
                err,
                CPSI_FAIL_AT("stiffness", err, CPS_ERR_ARGUMENT,
                             "line '%s': stiffness: a step of the history has a duration, and "
                             "beside free points or bodies lines stretch: give its stiffness",
                             line->name),
                "lines.%s", line->name);
    }
    return CPS_OK;
}

static CpsStatus check_points(const CpsScene *scene, bool in_time, CpsError *err) {
    for (int i = 0; i < scene->point_count; i++) {
        const CpsStatus status = check_point(scene, i, in_time, err);
        if (status != CPS_OK)
            return cpsi_fail_inside(err, status, "points.%s", scene->point[i].name);
    }
    for (int i = 0; i < scene->body_count; i++) {
        const CpsBody *body = &scene->body[i];
        CpsStatus status = cpsi_body_motion_check(body, in_time, err);
        if (status == CPS_OK) status = cpsi_radiation_check(body, err);
        if (status == CPS_OK && in_time && moves(body->velocity, CPS_BODY_DIRECTIONS))
            status = check_first_step(scene, "body", body->name, err);
        if (status != CPS_OK) return cpsi_fail_inside(err, status, "bodies.%s", body->name);
    }
    if (!in_time || !may_be_free(scene)) return CPS_OK;
    return check_beside_free(scene, err);
}

CpsStatus cpsi_time_check(const CpsScene *scene, CpsError *err) {
    const bool in_time = cpsi_is_in_time(scene);
    if (scene->time_scheme != CPS_TIME_SCHEME_BDF2 && scene->time_scheme != CPS_TIME_SCHEME_EULER)
        return CPSI_FAIL_AT("time_scheme", err, CPS_ERR_ARGUMENT, "time_scheme: unknown scheme %d",
                            (int)scene->time_scheme);
    for (int i = 0; i < scene->line_count; i++) {
        const CpsStatus status = check_line(&scene->line[i], in_time, err);
        if (status != CPS_OK) return cpsi_fail_inside(err, status, "lines.%s", scene->line[i].name);
    }
    const CpsStatus status = check_points(scene, in_time, err);
    if (status != CPS_OK || !in_time) return status;
    if (scene->friction_policy != CPS_FRICTION_POLICY_CONSISTENT)
        return CPSI_FAIL_AT("friction_policy", err, CPS_ERR_ARGUMENT,
                            "friction_policy: a step of the history has a duration, which needs "
                            "consistent friction");
    if (scene->contact_policy != CPS_CONTACT_POLICY_REACHED)
        return CPSI_FAIL_AT("contact_policy", err, CPS_ERR_ARGUMENT,
                            "contact_policy: a step of the history has a duration, which needs "
                            "contact that is reached");
    return CPS_OK;
}

CpsStatus cpsi_stage_time_check(const CpsStage *stage, const char *what, CpsError *err) {
    const double h = stage->duration / stage->step_count;
    if (!cpsi_is_not_negative(stage->duration) || (stage->duration > 0 && !cpsi_is_positive(h * h)))
        return CPSI_FAIL_AT("duration", err, CPS_ERR_ARGUMENT,
                            "%s: duration is %g s, expected a finite number >= 0", what,
                            stage->duration);
    if (!cpsi_is_not_negative(stage->error) ||
        (stage->error > 0 && !cpsi_is_positive(stage->error * stage->error)))
        return CPSI_FAIL_AT("error", err, CPS_ERR_ARGUMENT,
                            "%s: error is %g m, expected a finite number >= 0", what, stage->error);
    if (stage->error > 0 && !(stage->duration > 0))
        return CPSI_FAIL_AT("error", err, CPS_ERR_ARGUMENT,
                            "%s: error is that of steps in time: give a duration as well, or leave "
                            "it out",
                            what);
    return CPS_OK;
}

/* ---- fill ---- */

void cpsi_inertia_fill(CpsiLine *line, const CpsLine *def) {
    CpsiInertia *inertia = &line->inertia;
    int section = 0;
    double end = def->section_count > 0 ? def->section[0].length : INFINITY;
    for (int e = 0; e + 1 < line->n; e++) {
        const double l = line->element_length[e], middle = line->arc_length[e] + 0.5 * l;
        while (middle > end && section + 1 < def->section_count)
            end += def->section[++section].length;
        for (int j = e; j <= e + 1; j++) inertia->mass[j] += 0.5 * l * inertia_of(def, section);
    }
    for (int k = 0; k < def->point_weight_count; k++) {
        int nearest = 0;
        for (int j = 1; j < line->n; j++)
            if (fabs(line->arc_length[j] - def->point_weight[k].arc_length) <
                fabs(line->arc_length[nearest] - def->point_weight[k].arc_length))
                nearest = j;
        inertia->mass[nearest] += def->point_weight[k].inertia;
    }
    for (int e = 0; inertia->damping.own_factor && e + 1 < line->n; e++) {
        if (!line->has_sections) line->compliance_factor[e] = 1;
        inertia->damping.own_factor[e] = line->compliance_factor[e];
    }
    for (int j = 0; j < line->n; j++) {
        const bool held = cpsi_line_is_held(line, j);
        inertia->restarts[j] = true;
        for (int a = 0; a < 3; a++) {
            const double v = held ? 0 : def->velocity[a];
            inertia->velocity[3 * j + a] = v;
            inertia->kinetic += 0.5 * inertia->mass[j] * v * v;
        }
    }
}
