/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of a step in time (time_ledger.h). */
#include "evolve/time_ledger.h"

#include <math.h>

#include "cable/contact.h"
#include "cable/contact_carry.h"
#include "cable/damping.h"
#include "cable/field.h"
#include "cable/soft.h"

/* What the sums need of the step. */
typedef struct Sums {
    const CpsiLine *line;
    double length; /* [s] of the step */
    CpsLedger ledger;
    double impact, scheme, drag, added, waves, damping;
} Sums;

/* The displacement of node j in the step. */
static Vec3 way_of(const CpsiLine *line, int j) {
    return vec3_sub(vec3_at(line->position, j), vec3_at(line->inertia.start, j));
}

double cpsi_kinetic_energy(const CpsiLine *line) {
    double sum = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 v = vec3_at(line->inertia.velocity, j);
        sum += 0.5 * line->inertia.mass[j] * vec3_dot(v, v);
    }
    return sum;
}

/* [J] The elastic energy of element e at x, of an inextensible one 0. */
static double energy_of(const CpsiLine *line, const double *x, int e) {
    if (!(line->compliance > 0)) return 0;
    const double l = line->element_length[e];
    const double strain = vec3_norm(vec3_sub(vec3_at(x, e + 1), vec3_at(x, e))) / l - 1;
    const CpsiElementLaw law = cpsi_line_law(line, e);
    if (!(strain > 0)) return 0;
    return law.count > 0 ? l * cpsi_law_energy(&law, strain)
                         : l * strain * (strain / (2 * law.compliance));
}

/* Given loads and the water. */
static void add_loads(Sums *sums) {
    const CpsiLine *line = sums->line;
    const CpsiNodeField *field = &line->field;
    if (!line->has_node_loads) return;
    for (int j = 0; j < line->n; j++) {
        const Vec3 way = way_of(line, j);
        sums->ledger.loads += vec3_dot(vec3_at(field->load, j), way);
        sums->drag -= vec3_dot(vec3_at(field->drag, j), way);
        sums->added -= vec3_dot(vec3_at(field->added, j), way);
        sums->waves += vec3_dot(vec3_at(field->wave, j), way);
    }
}

/* [J] What the scheme loses at node j to inertia. */
static double inertia_loss(const CpsiLine *line, int j) {
    const CpsiInertia *inertia = &line->inertia;
    const Vec3 v = vec3_at(inertia->velocity, j), v0 = vec3_at(inertia->start_velocity, j);
    const double work = -vec3_dot(cpsi_line_field_balanced(line, j), way_of(line, j)),
                 gained = 0.5 * inertia->mass[j] * vec3_dot(vec3_sub(v, v0), vec3_add(v, v0));
    return work - gained;
}

/* Inertia, gravity and the elements. */
static void add_bodies(Sums *sums) {
    const CpsiLine *line = sums->line;
    const CpsiInertia *inertia = &line->inertia;
    for (int j = 0; j < line->n; j++) {
        const Vec3 way = way_of(line, j);
        sums->scheme += inertia_loss(line, j);
        sums->ledger.gravity -=
            cpsi_line_weight_length(line, j) * vec3_dot(vec3_load(line->weight), way);
    }
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 longer = vec3_sub(way_of(line, e + 1), way_of(line, e));
        double stored = 0, damped = 0;
        if (cpsi_line_has_damping(line)) {
            const CpsiDamped element = cpsi_line_damped(line, e);
            stored = element.stored;
            damped = element.damped;
        } else {
            stored = energy_of(line, line->position, e) - energy_of(line, inertia->start, e);
        }
        sums->ledger.elastic += stored;
        sums->damping += damped;
        sums->scheme += vec3_dot(vec3_at(line->segment_force, e), longer) - stored - damped;
    }
}

/* Friction F and reaction R n at a point that went `way` on ground that went `ground`. */
static void add_forces(Sums *sums, Vec3 friction, Vec3 reaction, Vec3 way, Vec3 ground) {
    const Vec3 slip = vec3_sub(way, ground);
    sums->scheme -= vec3_dot(reaction, slip);
    sums->ledger.dissipated -= vec3_dot(friction, slip);
    sums->ledger.obstacles += vec3_dot(vec3_add(friction, reaction), ground);
}

/* Node j lands at contact c, on ground that goes `ground` in the step. */
static void add_impact(Sums *sums, int j, int c, Vec3 ground) {
    const CpsiInertia *inertia = &sums->line->inertia;
    const Vec3 v = vec3_axpy(-1 / sums->length, ground, vec3_at(inertia->start_velocity, j));
    const double rate = fmin(0, vec3_dot(v, vec3_at(sums->line->normal, c)));
    const double lost = 0.5 * inertia->mass[j] * rate * rate;
    sums->impact += lost;
    sums->scheme -= lost;
}

/* The way of the ground under contact c, at x, in the whole step. */
static Vec3 ground_way(const CpsiLine *line, int c, Vec3 x) {
    const int k = line->has_local_axes ? line->obstacle_index[c] : CPS_NO_OBSTACLE;
    return k < 0 ? vec3(0, 0, 0) : cpsi_contact_ground_way(line, k, x);
}

static void add_contacts(Sums *sums, const unsigned char *state) {
    const CpsiLine *line = sums->line;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->state[c] == CPS_NODE_STATE_FREE && cpsi_contact_is_idle(line, c)) continue;
        const Vec3 friction = vec3_at(line->friction_force, c),
                   reaction = vec3_scale(line->reaction[c], vec3_at(line->normal, c));
        if (cpsi_line_element(line, c) >= 0 && line->obstacle_index[c] < 0) continue;
        if (c < cpsi_line_contacts(line) && cpsi_line_is_held(line, cpsi_line_node(line, c)))
            continue;
        const Vec3 x = cpsi_line_place(line, line->position, c),
                   way = vec3_sub(x, cpsi_line_place(line, line->inertia.start, c));
        const Vec3 ground = ground_way(line, c, x);
        add_forces(sums, friction, reaction, way, ground);
        if (cpsi_soft_spring(line, c).stiffness > 0) {
            const double damped = cpsi_soft_damped(line, c, sums->length);
            sums->damping += damped;
            sums->scheme -= damped;
        } else if (c < cpsi_line_contacts(line) && state[c] == CPS_NODE_STATE_FREE &&
                   line->state[c] != CPS_NODE_STATE_FREE)
            add_impact(sums, cpsi_line_node(line, c), c, ground);
    }
}

/* The forces at the ends, with what an obstacle does to the half element beside a held one. */
static void add_ends(Sums *sums, CpsLineReport *report) {
    const CpsiLine *line = sums->line;
    for (int end = 0; end < 2; end++) {
        const int j = end == CPS_END_A ? 0 : line->n - 1;
        const Vec3 way = way_of(line, j);
        report->end[end].work = vec3_dot(vec3_load(report->end[end].force), way);
        sums->ledger.ends += report->end[end].work;
        if (!cpsi_line_is_held(line, j) || line->state[j] == CPS_NODE_STATE_FREE) continue;
        add_forces(sums, vec3_load(report->end[end].friction_force),
                   vec3_scale(line->reaction[j], vec3_at(line->normal, j)), way,
                   ground_way(line, j, vec3_at(line->position, j)));
    }
    for (int k = 0; k < line->grasp_count; k++)
        sums->ledger.ends +=
            vec3_dot(vec3_load(line->grasp[k].force), way_of(line, line->grasp[k].node));
}

double cpsi_node_loss(const CpsiLine *line, int j, double length) {
    double loss = inertia_loss(line, j) - cpsi_soft_growth(line, j, length);
    for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
        if (!(line->reaction[c] > 0)) continue;
        const Vec3 ground = ground_way(line, c, vec3_at(line->position, j));
        loss -= line->reaction[c] *
                vec3_dot(vec3_at(line->normal, c), vec3_sub(way_of(line, j), ground));
        loss -= fmax(0, cpsi_soft_damped(line, c, length));
    }
    return loss;
}

void cpsi_time_ledger(CpsiLine *line, double length, const unsigned char *state) {
    Sums sums = {.line = line, .length = length};
    add_bodies(&sums);
    add_loads(&sums);
    add_contacts(&sums, state);
    if (cpsi_line_has_soft(line)) {
        double stored = 0;
        for (int j = 0; j < line->n; j++) stored += cpsi_soft_growth(line, j, length);
        sums.ledger.elastic += stored;
        sums.scheme -= stored;
    }
    add_ends(&sums, &line->report);
    line->report.dissipated = sums.ledger.dissipated;
    line->report.ledger = sums.ledger;
    line->inertia.ledger = (CpsMotionLedger){.impact = sums.impact,
                                             .scheme = sums.scheme,
                                             .drag = sums.drag,
                                             .added = sums.added,
                                             .waves = sums.waves,
                                             .damping = sums.damping};
}

void cpsi_time_ledger_close(CpsiLine *line, double stopped) {
    CpsiInertia *inertia = &line->inertia;
    CpsLedger *ledger = &line->report.ledger;
    CpsMotionLedger *motion = &inertia->ledger;
    const double before = inertia->kinetic;
    inertia->kinetic = cpsi_kinetic_energy(line);
    motion->kinetic = inertia->kinetic - before;
    motion->scheme += stopped;
    const double out[] = {ledger->elastic, ledger->gravity, ledger->dissipated,
                          motion->kinetic, motion->impact,  motion->scheme,
                          motion->drag,    motion->added,   motion->damping};
    ledger->imbalance = ledger->ends + ledger->obstacles + ledger->loads + motion->waves;
    motion->turnover =
        fabs(ledger->ends) + fabs(ledger->obstacles) + fabs(ledger->loads) + fabs(motion->waves);
    for (size_t i = 0; i < sizeof out / sizeof *out; i++) {
        ledger->imbalance -= out[i];
        motion->turnover += fabs(out[i]);
    }
}
