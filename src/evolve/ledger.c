/* SPDX-License-Identifier: BSD-3-Clause */
/* The ledger of one step:
 *
 *     ends + obstacles + winches + loads = elastic + gravity + dissipated + imbalance
 *
 * Stored energies are differences of states, elastic = sum l (|e| - 1)^2/(2c) where stretched (of a
 * table of strain and tension sum l W(|e| - 1)), with that of obstacles that give,
 * gravity = - sum (weight of the node) . x, with the mean of the weights before and after where
 * gravity changes. The work of loads of nodes is what the energy of their field falls by, and a
 * given load, or the mean of a drag before and after, times the displacement. The work of an end is
 * the mean of its force before and after times its displacement (trapezium rule), or the force
 * after where the one before is not known. Friction does work with the force at the end of the
 * step, on the slip (dissipated) and on the displacement of an obstacle that turns (obstacles); so
 * does the part of an end's force that balances the friction of its half element. The work of a
 * winch is that of the pull on its drum, likewise the mean of before and after, on the length
 * hauled in; what it winds has its weight at the place of the drum. So the imbalance of a step is
 * of second order in its size where nothing slides, and over a path it vanishes at first order with
 * the steps; on a path on which forces are linear in the displacements and nothing slides it is
 * rounding. */
#include "evolve/ledger.h"

#include <string.h>

#include "cable/contact.h"
#include "cable/field.h"
#include "cable/flow.h"
#include "cable/potential.h"
#include "cable/report.h"
#include "cable/soft.h"
#include "cable/winch.h"
#include "evolve/settling.h"

/* The weight per length that does the work of a step. */
static Vec3 mean_weight(const CpsiLine *line, bool settles) {
    const double *before = settles ? line->weight : line->weight_before;
    return vec3_scale(0.5, vec3_add(vec3_load(before), vec3_load(line->weight)));
}

static void potentials(const CpsiLine *line, bool before, bool settles, double *elastic,
                       double *gravity) {
    const Vec3 origin = vec3_load(line->position), weight = mean_weight(line, settles);
    double carried = 0; /* [m] */
    *elastic = cpsi_soft_energy(line, before);
    *gravity = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j);
        /* relative to the line's own end, so that a distant origin loses no digits; the term of the
         * end itself is added last */
        *gravity -= cpsi_line_weight_length(line, j) * vec3_dot(weight, vec3_sub(x, origin));
        if (line->weight_length) carried += line->weight_length[j];
        if (j == 0 || !(line->compliance > 0)) continue;
        const double l = line->element_length[j - 1];
        const double strain = vec3_norm(vec3_sub(x, vec3_at(line->position, j - 1))) / l - 1;
        if (!(strain > 0)) continue;
        const CpsiElementLaw law = cpsi_line_law(line, j - 1);
        *elastic += law.count > 0 ? l * cpsi_law_energy(&law, strain)
                                  : l * strain * (strain / (2 * law.compliance));
    }
    *gravity -= (line->weight_length ? carried : line->length) * vec3_dot(weight, origin);
}

/* The work of the reactions as obstacles are shifted, from where the line is or to there. */
static double push_work(const CpsiLine *line, bool from_here) {
    double work = 0;
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            const int k = line->obstacle_index[c];
            if (k < 0 || !cpsi_line_is_shifted(line, k)) continue;
            const Vec3 x = cpsi_line_place(line, line->position, c),
                       by = from_here ? cpsi_shift_from(&line->shift[k], x)
                                      : cpsi_shift_to(&line->shift[k], x);
            work += line->reaction[c] * vec3_dot(vec3_at(line->normal, c), by);
        }
    return work;
}

CpsiLedgerStart cpsi_ledger_start(const CpsiLine *line, const CpsEnd end[2], bool known) {
    CpsiLedgerStart start = {.settles = !known && line->inertia.settles};
    potentials(line, true, start.settles, &start.elastic, &start.gravity);
    if (start.settles) start.elastic += cpsi_settling_stored(line);
    for (int i = 0; i < 2; i++) {
        const bool is_free = end[i].kind == CPS_END_KIND_FREE && !start.settles;
        const int j = i == CPS_END_A ? 0 : line->n - 1;
        if (line->drums.on[i]) start.pull[i] = cpsi_winch_pull(line, i, true);
        start.stored[i] = line->drums.stored[i];
        start.hangs[i] = line->drums.weight[i];
        start.known[i] = known || is_free;
        for (int a = 0; a < 3; a++) {
            start.end[i].position[a] = line->position[3 * j + a];
            start.end[i].force[a] = is_free ? end[i].value[a] : line->report.end[i].force[a];
            start.end[i].friction_force[a] = is_free ? 0 : line->report.end[i].friction_force[a];
        }
    }
    start.all_known = known;
    start.pushed = push_work(line, true);
    for (int k = 0; k < line->grasp_count; k++) {
        const CpsGrasp *grasp = &line->grasp[k];
        const bool is_free = line->grasp_before[k].kind == CPS_END_KIND_FREE && !start.settles;
        memcpy(start.grasp[k].position, &line->position[3 * grasp->node],
               sizeof start.grasp[k].position);
        memcpy(start.grasp[k].force, is_free ? line->grasp_before[k].value : grasp->force,
               sizeof start.grasp[k].force);
    }
    return start;
}

/* The work of an end's force. */
static double end_work(const CpsEndReport *before, const CpsEndReport *after, bool known) {
    double work = 0;
    for (int a = 0; a < 3; a++) {
        const double pull = after->force[a] + after->friction_force[a],
                     pulled = before->force[a] + before->friction_force[a];
        const double force = (known ? 0.5 * (pulled + pull) : pull) - after->friction_force[a];
        work += force * (after->position[a] - before->position[a]);
    }
    return work;
}

/* The work of friction on what obstacle k does: its shift moves what is at x now, and by its turn
 * the slip from where the shift has taken the reference `from` is another, `slip`, than `own`. */
static double friction_work(const CpsiLine *line, int k, Vec3 friction, Vec3 x, Vec3 own,
                            Vec3 slip) {
    double work = vec3_dot(friction, vec3_sub(own, slip));
    if (cpsi_line_is_shifted(line, k))
        work += vec3_dot(friction, cpsi_shift_to(&line->shift[k], x));
    return work;
}

/* ... on the half elements at held ends. */
static double end_obstacle_work(const CpsiLine *line) {
    double work = 0;
    if (line->has_local_axes)
        for (int end = 0; end < 2; end++) {
            const int j = cpsi_line_end_node(line, end), k = line->obstacle_index[j];
            if (!cpsi_line_is_held(line, j) || k < 0 ||
                (line->turn[k] == 0 && !cpsi_line_is_shifted(line, k)))
                continue;
            const Vec3 x = vec3_at(line->position, j),
                       from = cpsi_shift_carry(&line->shift[k], vec3_at(line->reference, j));
            work += friction_work(line, k, vec3_load(line->report.end[end].friction_force), x,
                                  cpsi_obstacle_slip(&line->obstacle[k], from, x),
                                  cpsi_line_end_slip(line, end, k));
        }
    return work;
}

/* The work of obstacles that turn or are shifted: friction on the displacement of the surface under
 * the node. */
static double obstacle_work(const CpsiLine *line) {
    double work = 0;
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            const int k = line->obstacle_index[c];
            if (k < 0 || (line->turn[k] == 0 && !cpsi_line_is_shifted(line, k))) continue;
            const Vec3 x = cpsi_line_place(line, line->position, c),
                       from = cpsi_shift_carry(&line->shift[k],
                                               cpsi_line_place(line, line->reference, c));
            work +=
                friction_work(line, k, vec3_at(line->friction_force, c), x,
                              cpsi_contact_slip_between(line, c, from, x), cpsi_line_slip(line, c));
        }
    return work + end_obstacle_work(line);
}

/* The work of the winches; and in the ledger, the weight of what they have wound at the place of
 * the drum. */
static double wind_work(const CpsiLine *line, const CpsiLedgerStart *start, CpsLedger *ledger) {
    const Vec3 weight = mean_weight(line, false);
    double work = 0;
    for (int end = 0; end < 2; end++) {
        const double in = line->drums.stored[end] - start->stored[end],
                     weighs = line->drums.weight[end] - start->hangs[end];
        if (!line->drums.on[end] || (in == 0 && weighs == 0)) continue;
        const double pull = cpsi_winch_pull(line, end, false);
        const Vec3 drum = vec3_scale(0.5, vec3_add(vec3_load(start->end[end].position),
                                                   vec3_load(line->report.end[end].position)));
        work += in * (start->known[end] ? 0.5 * (start->pull[end] + pull) : pull);
        ledger->gravity -= weighs * vec3_dot(weight, drum);
    }
    return work;
}

/* The work of the loads of the nodes beside their weight, from the reference to the position. */
static double load_work(const CpsiLine *line, bool settles) {
    double work = 0;
    if (!line->has_field && !line->has_node_loads) return 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j), from = vec3_at(line->reference, j),
                   mean = vec3_scale(0.5, vec3_add(x, from));
        /* the energy is quadratic: its fall is the force half way times the displacement */
        work += vec3_dot(cpsi_node_field_at(&line->field, j, mean), vec3_sub(x, from));
        if (!line->field.flow) continue;
        const Vec3 drag = settles ? vec3_at(line->field.drag, j) : cpsi_line_mean_drag(line, j);
        work += vec3_dot(drag, vec3_sub(x, from));
    }
    /* a potential has the work by which it falls */
    return work + cpsi_potential_energy(line, line->reference) -
           cpsi_potential_energy(line, line->position);
}

/* The work of the load of an end that is held to a set, whose reaction does none. */
static double work_in_set(const CpsEndReport *before, const CpsiLine *line, int end) {
    CpsEndReport after = line->report.end[end];
    memcpy(after.force, line->end[end].value, sizeof after.force);
    return end_work(before, &after, true);
}

CpsLedger cpsi_ledger_close(CpsiLine *line, const CpsiLedgerStart *start) {
    CpsLedger ledger = {.dissipated = line->report.dissipated, .obstacles = obstacle_work(line)};
    double elastic, gravity;
    const double pushed = push_work(line, false);
    ledger.obstacles += start->all_known ? 0.5 * (start->pushed + pushed) : pushed;
    potentials(line, false, start->settles, &elastic, &gravity);
    ledger.elastic = elastic - start->elastic;
    ledger.gravity = gravity - start->gravity;
    ledger.winches = wind_work(line, start, &ledger);
    for (int end = 0; end < 2; end++) {
        CpsEndReport *report = &line->report.end[end];
        report->work = end_work(&start->end[end], report, start->known[end]);
        if (line->on[end].is_there) report->work = work_in_set(&start->end[end], line, end);
        ledger.ends += report->work;
    }
    for (int k = 0; k < line->grasp_count; k++) {
        const CpsGrasp *grasp = &line->grasp[k];
        CpsEndReport now = {.work = 0};
        memcpy(now.position, &line->position[3 * grasp->node], sizeof now.position);
        memcpy(now.force, grasp->force, sizeof now.force);
        ledger.ends += end_work(&start->grasp[k], &now,
                                start->all_known ||
                                    (grasp->imposed.kind == CPS_END_KIND_FREE && !start->settles));
    }
    ledger.loads = load_work(line, start->settles);
    ledger.imbalance = ledger.ends + ledger.obstacles + ledger.winches + ledger.loads -
                       ledger.elastic - ledger.gravity - ledger.dissipated;
    if (start->settles) {
        line->inertia.settled = cpsi_settling_loss(line, &ledger);
        ledger.imbalance -= line->inertia.settled;
    }
    return ledger;
}

double cpsi_ledger_exchanged(const CpsLedger *ledger) {
    const double work[] = {ledger->ends,  ledger->obstacles, ledger->winches,
                           ledger->loads, -ledger->elastic,  -ledger->gravity};
    double sum = ledger->dissipated;
    for (int k = 0; k < 6; k++) sum += work[k] > 0 ? work[k] : 0;
    return sum;
}

void cpsi_ledger_add(CpsLedger *sum, const CpsLedger *part) {
    sum->elastic += part->elastic;
    sum->gravity += part->gravity;
    sum->ends += part->ends;
    sum->obstacles += part->obstacles;
    sum->winches += part->winches;
    sum->loads += part->loads;
    sum->dissipated += part->dissipated;
    sum->imbalance += part->imbalance;
}
