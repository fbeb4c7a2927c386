/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, forces and drag (loads.h). A node has the springs and forces of the length that it
 * stands for, half of the elements beside it, so that their sums are the integrals. */
#include "evolve/loads.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/potential.h"
#include "evolve/ranges.h"
#include "evolve/sections.h"
#include "evolve/time_check.h"

bool cpsi_has_springs(const CpsLine *line) { return line->loads && line->loads->spring_count > 0; }
bool cpsi_has_forces(const CpsLine *line) {
    return line->loads && (line->loads->force_count > 0 || line->loads->force_function);
}
bool cpsi_has_potential(const CpsLine *line) {
    return line->loads && line->loads->potential.function;
}
bool cpsi_has_drag(const CpsScene *scene, const CpsLine *line) {
    return scene->current && line->loads && line->loads->drag.diameter > 0;
}

/* check ---------------------------------------------------------------------------------------- */

/* Is x'K x nowhere negative? So no minor of K about its diagonal may be, but for rounding. */
static bool is_nowhere_negative(const CpsSpring *spring) {
    const double *k = spring->stiffness, *c = spring->coupling, noise = 1e-14;
    const double xy = k[0] * k[1], xz = k[0] * k[2], yz = k[1] * k[2], all = xy * k[2];
    return xy * (1 + noise) >= c[0] * c[0] && xz * (1 + noise) >= c[1] * c[1] &&
           yz * (1 + noise) >= c[2] * c[2] &&
           all + 2 * c[0] * c[1] * c[2] - k[0] * c[2] * c[2] - k[1] * c[1] * c[1] -
                   k[2] * c[0] * c[0] >=
               -4 * noise * all;
}

static CpsStatus check_spring(const CpsLine *line, int k, CpsError *err) {
    const CpsSpring *spring = &line->loads->spring[k];
    char place[32];
    snprintf(place, sizeof place, "springs[%d]", k + 1);
    if (!(spring->from >= 0 && spring->from <= spring->to && spring->to <= line->length))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': springs: number %d goes from %g m to %g m, expected a "
                            "piece of the line's length %g m",
                            line->name, k + 1, spring->from, spring->to, line->length);
    for (int a = 0; a < 3; a++)
        if (!cpsi_is_not_negative(spring->stiffness[a]))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "line '%s': springs: number %d has the stiffness %g along %c, "
                                "expected a finite number >= 0",
                                line->name, k + 1, spring->stiffness[a], "xyz"[a]);
    if (!cpsi_are_usable(spring->coupling) || !is_nowhere_negative(spring))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': springs: number %d pushes away along some direction: with "
                            "the coupling (%g, %g, %g) its energy is negative there, expected "
                            "numbers with which it is nowhere",
                            line->name, k + 1, spring->coupling[0], spring->coupling[1],
                            spring->coupling[2]);
    if (!spring->at_start && !cpsi_are_usable(spring->place))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': springs: number %d is at (%g, %g, %g) m, expected finite "
                            "numbers",
                            line->name, k + 1, spring->place[0], spring->place[1],
                            spring->place[2]);
    if (spring->at_start && line->start.kind == CPS_START_STATIC)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': springs: number %d is where the line starts, but the start "
                            "is static: give the spring a place, or the line a shape to start from",
                            line->name, k + 1);
    return CPS_OK;
}

static CpsStatus check_force(const CpsLine *line, int k, CpsError *err) {
    const CpsLineForce *force = &line->loads->force[k];
    char place[32];
    snprintf(place, sizeof place, "loads[%d]", k + 1);
    if (!(force->from >= 0 && force->from < force->to && force->to <= line->length))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': loads: number %d goes from %g m to %g m, expected a piece "
                            "of the line's length %g m",
                            line->name, k + 1, force->from, force->to, line->length);
    if (!cpsi_are_usable(force->force))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "line '%s': loads: number %d has the force (%g, %g, %g) N/m, expected "
                            "finite numbers",
                            line->name, k + 1, force->force[0], force->force[1], force->force[2]);
    return CPS_OK;
}

static CpsStatus check_potential(const CpsLine *line, CpsError *err) {
    const CpsPotential *potential = &line->loads->potential;
    if (!potential->function) return CPS_OK;
    if (!(potential->from >= 0 && potential->from < potential->to && potential->to <= line->length))
        return CPSI_FAIL_AT("potential", err, CPS_ERR_ARGUMENT,
                            "line '%s': potential: it goes from %g m to %g m, expected a piece of "
                            "the line's length %g m",
                            line->name, potential->from, potential->to, line->length);
    return CPS_OK;
}

/* The tension of an inextensible line is no function of the places of its ends, and the program of
 * all lines at once, which finds both, has no potential. */
CpsStatus cpsi_potential_ends_check(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            if (cpsi_has_potential(&scene->line[i]) && !cpsi_is_elastic(&scene->line[i]) &&
                scene->line[i].end[end].kind == CPS_END_KIND_POINT)
                return CPSI_FAIL_AT("potential", err, CPS_ERR_ARGUMENT,
                                    "line '%s': potential: end %c is at a point, and the line is "
                                    "inextensible: give it a finite stiffness, hold the end, or "
                                    "leave the potential out",
                                    scene->line[i].name, "AB"[end]);
    return CPS_OK;
}

/* What a line cannot have in a history of which a step has a duration. */
static CpsStatus check_in_time(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const CpsLineLoads *loads = line->loads;
    if (loads->spring_count > 0 && !line->quasi_static)
        return CPSI_FAIL_AT("springs", err, CPS_ERR_ARGUMENT,
                            "line '%s': springs are those of lines at rest: make it quasi_static, "
                            "or leave them or the motion in time out",
                            line->name);
    if (loads->potential.function && !line->quasi_static)
        return CPSI_FAIL_AT("potential", err, CPS_ERR_ARGUMENT,
                            "line '%s': a potential is that of lines at rest: make it "
                            "quasi_static, or leave it or the motion in time out",
                            line->name);
    if (loads->drag.diameter > 0 && !scene->current)
        return CPSI_FAIL_AT("drag", err, CPS_ERR_ARGUMENT,
                            "line '%s': drag: a step of the history has a duration, and there is "
                            "no water that the line could move in: give water_density",
                            line->name);
    return CPS_OK;
}

CpsStatus cpsi_line_loads_check(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const CpsLineLoads *loads = line->loads;
    CpsStatus status = CPS_OK;
    if (!loads) return CPS_OK;
    if (cpsi_is_in_time(scene)) status = check_in_time(scene, line, err);
    if (status != CPS_OK) return status;
    if (loads->spring_count < 0 || (loads->spring_count > 0 && !loads->spring))
        return CPSI_FAIL_AT("springs", err, CPS_ERR_ARGUMENT,
                            "line '%s': springs: found %d, expected 0 or more", line->name,
                            loads->spring ? loads->spring_count : 0);
    if (loads->force_count < 0 || (loads->force_count > 0 && !loads->force))
        return CPSI_FAIL_AT("loads", err, CPS_ERR_ARGUMENT,
                            "line '%s': loads: found %d, expected 0 or more", line->name,
                            loads->force ? loads->force_count : 0);
    for (int k = 0; k < loads->spring_count && status == CPS_OK; k++)
        status = check_spring(line, k, err);
    for (int k = 0; k < loads->force_count && status == CPS_OK; k++)
        status = check_force(line, k, err);
    if (status == CPS_OK) status = check_potential(line, err);
    const CpsDrag *drag = &loads->drag;
    if (status == CPS_OK &&
        !(cpsi_is_not_negative(drag->diameter) && cpsi_is_not_negative(drag->normal) &&
          cpsi_is_not_negative(drag->tangential) && cpsi_is_not_negative(drag->added_normal) &&
          cpsi_is_not_negative(drag->added_tangential)))
        return CPSI_FAIL_AT("drag", err, CPS_ERR_ARGUMENT,
                            "line '%s': drag: diameter %g m, normal %g, tangential %g, "
                            "added_normal %g, added_tangential %g, expected finite numbers >= 0",
                            line->name, drag->diameter, drag->normal, drag->tangential,
                            drag->added_normal, drag->added_tangential);
    return status;
}

CpsStatus cpsi_current_check(const CpsScene *scene, CpsError *err) {
    const CpsCurrent *current = scene->current;
    if (!current) return CPS_OK;
    if (!cpsi_is_positive(current->density))
        return CPSI_FAIL_AT("current", err, CPS_ERR_ARGUMENT,
                            "current: the water's density is %g kg/m3, expected a positive finite "
                            "number: give water_density",
                            current->density);
    if (current->function && !cpsi_is_in_time(scene))
        return CPSI_FAIL_AT("current", err, CPS_ERR_ARGUMENT,
                            "current: a function moves the water in time, but no stage of the "
                            "history has a duration: give one, or in_time");
    if (current->row_count < 1 || !current->row)
        return CPSI_FAIL_AT("current", err, CPS_ERR_ARGUMENT,
                            "current: found no rows, expected one or more");
    for (int k = 0; k < current->row_count; k++) {
        const CpsCurrentRow *row = &current->row[k];
        char place[32];
        snprintf(place, sizeof place, "current[%d]", k + 1);
        const double z[3] = {row->z, 0, 0};
        if (!cpsi_are_usable(z) || !cpsi_are_usable(row->velocity))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "current: row %d has z = %g m and the velocity (%g, %g, %g) m/s, "
                                "expected finite numbers",
                                k + 1, row->z, row->velocity[0], row->velocity[1],
                                row->velocity[2]);
        if (k > 0 && !(row->z > row[-1].z))
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "current: row %d has z = %g m, after %g m: give the rows from the "
                                "lowest to the highest",
                                k + 1, row->z, row[-1].z);
    }
    return CPS_OK;
}

/* fill ----------------------------------------------------------------------------------------- */

/* [m] The part of the length of node j from `from` to `to`. */
static double part_of(const CpsiLine *line, int j, double from, double to) {
    const double s = line->arc_length[j], low = j > 0 ? s - 0.5 * line->element_length[j - 1] : s,
                 high = j + 1 < line->n ? s + 0.5 * line->element_length[j] : s;
    return fmax(0, fmin(high, to) - fmax(low, from));
}

static int nearest_node(const CpsiLine *line, double s) {
    int best = 0;
    for (int j = 1; j < line->n; j++)
        if (fabs(line->arc_length[j] - s) < fabs(line->arc_length[best] - s)) best = j;
    return best;
}

static void add_spring(CpsiLine *line, const CpsSpring *spring, const double origin[3]) {
    const bool single = spring->from == spring->to;
    const int only = single ? nearest_node(line, spring->from) : -1;
    for (int j = 0; j < line->n; j++) {
        const double by = !single ? part_of(line, j, spring->from, spring->to) : j == only ? 1 : 0;
        const double *k = spring->stiffness, *c = spring->coupling,
                     stiffness[6] = {by * k[0], by * c[0], by * k[1],
                                     by * c[1], by * c[2], by * k[2]};
        const Vec3 place = vec3_sub(vec3_load(spring->place), vec3_load(origin));
        if (by > 0)
            cpsi_line_field_add(line, j, stiffness,
                                spring->at_start ? vec3_at(line->position, j) : place);
    }
}

static void fill_potential(CpsiLine *line, const CpsLine *def, const double origin[3]) {
    CpsiNodeField *field = &line->field;
    if (!line->has_potential) return;
    field->potential.given = def->loads->potential;
    memcpy(field->potential.origin, origin, sizeof field->potential.origin);
    for (int j = 0; j < line->n; j++)
        field->share[j] = part_of(line, j, def->loads->potential.from, def->loads->potential.to);
    cpsi_potential_model(line, line->position);
    cpsi_potential_settle(line);
}

void cpsi_current_fill(const CpsCurrent *current, const double origin[3], CpsCurrentRow *row) {
    for (int k = 0; k < current->row_count; k++) {
        row[k] = current->row[k];
        row[k].z -= origin[2];
    }
}

void cpsi_line_loads_fill(CpsiLine *line, const CpsScene *scene, const CpsLine *def,
                          const double origin[3], CpsCurrentRow *row, CpsiFlow *flow) {
    CpsiNodeField *field = &line->field;
    const CpsLineLoads *loads = def->loads;
    const size_t n = (size_t)line->n;
    if (!loads) return;
    cpsi_line_field_clear(line);
    for (int k = 0; k < loads->spring_count; k++) add_spring(line, &loads->spring[k], origin);
    for (int k = 0; k < loads->force_count; k++)
        for (int i = 0; i < 3 * line->n; i++) {
            const CpsLineForce *force = &loads->force[k];
            field->load[i] += force->force[i % 3] * part_of(line, i / 3, force->from, force->to);
        }
    if (line->has_field) {
        memcpy(field->own_stiffness, field->stiffness, 6 * n * sizeof *field->stiffness);
        memcpy(field->own_place, field->place, 3 * n * sizeof *field->place);
        for (int j = 0; j < line->n; j++) {
            static const int DIAGONAL[3] = {0, 2, 5}, BESIDE[3] = {1, 3, 4};
            for (int a = 0; a < 3; a++) {
                field->diagonal[3 * j + a] = field->stiffness[6 * j + DIAGONAL[a]];
                field->coupling[3 * j + a] = field->stiffness[6 * j + BESIDE[a]];
            }
        }
    }
    if (line->has_node_loads) memcpy(field->own_load, field->load, 3 * n * sizeof *field->load);
    if (field->function) memcpy(field->base_load, field->load, 3 * n * sizeof *field->load);
    fill_potential(line, def, origin);
    if (!cpsi_has_drag(scene, def)) return;
    const CpsCurrent *current = scene->current;
    cpsi_current_fill(current, origin, row);
    *flow = (CpsiFlow){.density = current->density,
                       .drag = loads->drag,
                       .row_count = current->row_count,
                       .row = row};
    field->flow = flow;
    cpsi_line_follow_flow(line, line->position);
}

void cpsi_line_loads_take(CpsiLine *line, const CpsLine *def) {
    if (!def->loads) return;
    line->field.function = def->loads->force_function;
    line->field.user = def->loads->force_user;
}

void cpsi_line_loads_impose(CpsiLine *line, double time) {
    CpsiNodeField *field = &line->field;
    if (!field->function) return;
    for (int j = 0; j < line->n; j++) {
        double force[3] = {0};
        field->function(field->user, time, line->arc_length[j], force);
        for (int a = 0; a < 3; a++)
            field->own_load[3 * j + a] =
                field->base_load[3 * j + a] + cpsi_line_share(line, j) * force[a];
    }
}
