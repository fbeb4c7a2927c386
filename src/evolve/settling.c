/* SPDX-License-Identifier: BSD-3-Clause */
/* The loss of what comes to rest (settling.h). */
#include "evolve/settling.h"

#include <math.h>
#include <string.h>

#include "cable/damping.h"
#include "cable/field.h"

void cpsi_line_stop(CpsiLine *line) {
    CpsiInertia *inertia = &line->inertia;
    const size_t n = (size_t)line->n;
    inertia->settles = inertia->is_moving;
    inertia->settled = 0;
    inertia->is_moving = false;
    inertia->velocity_given[CPS_END_A] = inertia->velocity_given[CPS_END_B] = false;
    cpsi_line_field_clear(line);
    if (cpsi_line_has_damping(line)) cpsi_line_undamp(line);
    inertia->ledger =
        (CpsMotionLedger){.kinetic = 0 - inertia->kinetic, .settling = inertia->kinetic};
    inertia->kinetic = inertia->position_bound = 0;
    inertia->landed = inertia->changed = inertia->snatched = 0;
    if (line->has_node_loads) {
        memset(line->field.added, 0, 3 * n * sizeof *line->field.added);
        memset(line->field.wave, 0, 3 * n * sizeof *line->field.wave);
    }
    memset(inertia->velocity, 0, 3 * n * sizeof *inertia->velocity);
    memset(inertia->rest_velocity, 0, 3 * n * sizeof *inertia->rest_velocity);
    memset(inertia->span, 0, n * sizeof *inertia->span);
    for (size_t j = 0; j < n; j++) inertia->restarts[j] = true;
}

double cpsi_settling_stored(const CpsiLine *line) {
    return cpsi_line_has_damping(line) ? cpsi_line_kept_energy(line) : 0;
}

/* The displacement in the part of what is at contact c, or at node j. */
static Vec3 way_of_contact(const CpsiLine *line, int c) {
    return vec3_sub(cpsi_line_place(line, line->position, c),
                    cpsi_line_place(line, line->reference, c));
}

static Vec3 way_of(const CpsiLine *line, int j) {
    return vec3_sub(vec3_at(line->position, j), vec3_at(line->reference, j));
}

/* [J] What reactions and friction do, on held ends with the half elements beside them. */
static double contact_work(const CpsiLine *line) {
    double work = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (cpsi_line_element(line, c) >= 0 && line->obstacle_index[c] < 0) continue;
        if (c < cpsi_line_contacts(line) && cpsi_line_is_held(line, cpsi_line_node(line, c)))
            continue;
        const Vec3 force = vec3_axpy(line->reaction[c], vec3_at(line->normal, c),
                                     vec3_at(line->friction_force, c));
        work += vec3_dot(force, way_of_contact(line, c));
    }
    for (int end = 0; end < 2; end++) {
        const int j = end == CPS_END_A ? 0 : line->n - 1;
        if (!cpsi_line_is_held(line, j) || line->state[j] == CPS_NODE_STATE_FREE) continue;
        const Vec3 force = vec3_axpy(line->reaction[j], vec3_at(line->normal, j),
                                     vec3_load(line->report.end[end].friction_force));
        work += vec3_dot(force, way_of(line, j));
    }
    return work;
}

double cpsi_settling_loss(const CpsiLine *line, const CpsLedger *ledger) {
    double stretched = 0;
    for (int e = 0; e + 1 < line->n; e++)
        stretched += vec3_dot(vec3_at(line->segment_force, e),
                              vec3_sub(way_of(line, e + 1), way_of(line, e)));
    return (stretched - ledger->elastic) -
           (contact_work(line) - ledger->obstacles + ledger->dissipated);
}

void cpsi_settling_close(CpsiLine *line) {
    CpsiInertia *inertia = &line->inertia;
    CpsMotionLedger *motion = &inertia->ledger;
    const CpsLedger *ledger = &line->report.ledger;
    if (cpsi_line_has_damping(line)) cpsi_line_begin_damping(line);
    if (!inertia->settles) return;
    motion->settling += inertia->settled;
    motion->turnover = fabs(motion->kinetic) + fabs(motion->settling) + fabs(ledger->elastic) +
                       fabs(ledger->gravity) + fabs(ledger->dissipated) + fabs(ledger->ends) +
                       fabs(ledger->obstacles) + fabs(ledger->loads);
}
