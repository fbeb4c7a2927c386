/* SPDX-License-Identifier: BSD-3-Clause */
/* A step in time of one line (time_step.h).
 *
 * By the backward difference formula of second order (CpsiFormula), after a step of the same length
 * h
 *
 *     x* = (4 x_n - x_{n-1})/3,   v* = (4 v_n - v_{n-1})/3,   k = 2 h/3
 *
 * and by the implicit Euler method x* = x_n, v* = v_n, k = h. Then the new configuration minimises
 * |x - x* - k v*|^2_M/(2 k^2) beside the energies of a quasi-static step with the reference x*, and
 * v_{n+1} = (x_{n+1} - x*)/k. Dissipation is homogeneous, so friction measured from x* obeys its
 * law in the new velocity; what rests has x* = x_n, and stays.
 *
 * Contact and slack make the motion rough, and there the history of a node must not speak of what
 * was before: after a step in which it bears, its motion along the normal is that of the ground in
 * the past as well, so that it does not rebound; after it has landed its next step is an Euler
 * step, for friction may have stopped it; a step in which an element is snatched taut is taken
 * again as an Euler step of its two nodes, and their next step is one too; so is one in which a
 * node goes into what gives, or out of it, if that would fling it with more than it had. */
#include "evolve/time_step.h"

#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/contact.h"
#include "cable/damping.h"
#include "cable/field.h"
#include "cable/inertia_field.h"
#include "cable/line_step.h"
#include "cable/obstacle_side.h"
#include "cable/soft.h"
#include "evolve/pace.h"
#include "evolve/time_ledger.h"

/* [-] An element shorter than its length by this share is slack. */
static const double SLACK = 1e-9;
/* Two normals with a sine below this are one. */
static const double PARALLEL = 1e-6;

static bool is_slack(const CpsiLine *line, const double *x, int e) {
    const double size = vec3_norm(vec3_sub(vec3_at(x, e + 1), vec3_at(x, e)));
    return size < (1 - SLACK) * line->natural_length[e];
}

/* The reference of node j, v* and k, and its inertia. */
static void predict(CpsiLine *line, int j, const CpsiTimeStep *step, bool euler) {
    CpsiInertia *inertia = &line->inertia;
    const CpsiFormula *formula = &step->formula;
    inertia->span[j] = euler ? formula->length : formula->span;
    inertia->is_euler[j] = euler;
    for (int i = 3 * j; i < 3 * j + 3; i++) {
        const double x = inertia->start[i], v = inertia->start_velocity[i];
        const double place = euler ? x : x + formula->back * (x - inertia->before[i]),
                     velocity = euler ? v : v + formula->back * (v - inertia->before_velocity[i]);
        line->position[i] = place;
        inertia->rest_velocity[i] = velocity;
    }
    line->field.size += cpsi_line_set_inertia(line, j, vec3_at(line->position, j));
}

/* An end with a given velocity: x* is the place from which that leads in the span to where the end
 * is held. */
static void lead(CpsiLine *line, const CpsiMove *move, int end) {
    const int j = end == CPS_END_A ? 0 : line->n - 1;
    const Vec3 place = vec3_axpy(-line->inertia.span[j], vec3_load(move->velocity[end]),
                                 vec3_load(move->to[end].value));
    vec3_store(&line->position[3 * j], place);
    (void)cpsi_line_set_inertia(line, j, place);
}

/* Does an obstacle turn or move in the step? */
static bool ground_moves(const CpsiLine *line, const CpsiMove *move) {
    for (int k = 0; k < line->obstacle_count; k++)
        if (move->angle[k] != 0 || (move->shift && !cpsi_shift_is_none(&move->shift[k])))
            return true;
    return false;
}

/* Solve the step from where it began. Nodes on ground that moves all have the same k, for the
 * ground's way in it. Returns the share of the step that is k. */
static double attempt(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                      const CpsiMove *move, CpsiSubsteps *scratch, const CpsiTimeStep *step) {
    bool all = step->scheme == CPS_TIME_SCHEME_EULER || step->restarts;
    if (ground_moves(line, move))
        for (int j = 0; j < line->n; j++) all = all || line->inertia.restarts[j];
    cpsi_line_field_clear(line);
    line->inertia.formula = step->formula;
    for (int j = 0; j < line->n; j++) predict(line, j, step, all || line->inertia.restarts[j]);
    for (int end = 0; end < 2; end++)
        if (move->has_velocity[end]) lead(line, move, end);
    if (cpsi_line_has_damping(line)) cpsi_line_damp(line);
    const double share =
        all || !ground_moves(line, move) ? 1 : step->formula.span / step->formula.length;
    cpsi_substeps_impose(line, move, scratch, 1 - share, 1);
    line->inertia.moved_in_span = share < 1;
    memcpy(line->weight_before, move->weight_from, sizeof line->weight_before);
    cpsi_line_step(line, program, options);
    for (int j = 0; j < line->n; j++)
        for (int i = 3 * j; i < 3 * j + 3; i++)
            line->inertia.velocity[i] =
                (line->position[i] - line->reference[i]) / line->inertia.span[j];
    return share;
}

/* Is the step too long for an obstacle that moves in it? It may go past the line then, and the way
 * of what slips on it is not known. A quasi-static step is divided there (substeps.c). */
static bool ground_outruns(const CpsiLine *line, const CpsiMove *move) {
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiShift *shift = move->shift ? &move->shift[k] : NULL;
        if (cpsi_obstacle_turns_too_far(move->angle[k], shift)) return true;
        if (!shift) continue;
        for (int j = 0; j < line->n; j++) {
            const Vec3 x = vec3_at(line->position, j);
            const double element = line->element_length[j < line->n - 1 ? j : j - 1];
            if (cpsi_obstacle_may_pass(&line->obstacle[k], shift, vec3_at(line->inertia.start, j),
                                       x, element))
                return true;
        }
    }
    return false;
}

/* The elements that were slack and are taut, and the nodes that have gone into or out of what
 * gives in a step of length h. Such nodes are to be taken by Euler steps next: returns whether one
 * was not and is to be now, since it is beside a snatched element or has gained energy. */
static bool find_rough(CpsiLine *line, double h) {
    CpsiInertia *inertia = &line->inertia;
    bool found = false;
    inertia->snatched = 0;
    for (int j = 0; cpsi_line_has_soft(line) && j < line->n; j++) {
        if (cpsi_line_is_held(line, j) || !cpsi_soft_is_crossed(line, j, h)) continue;
        found = found || (!inertia->restarts[j] && cpsi_node_loss(line, j, h) < 0);
        inertia->restarts[j] = true;
    }
    for (int e = 0; e + 1 < line->n; e++) {
        if (!is_slack(line, inertia->start, e) || is_slack(line, line->position, e)) continue;
        inertia->snatched++;
        for (int j = e; j <= e + 1; j++) {
            found = found || !inertia->restarts[j];
            inertia->restarts[j] = true;
        }
    }
    return found;
}

/* The velocity of contact c's ground. */
static Vec3 ground_velocity(const CpsiLine *line, int c) {
    const int k = line->has_local_axes ? line->obstacle_index[c] : 0;
    if (!line->has_local_axes || k < 0 || !cpsi_line_is_shifted(line, k)) return vec3(0, 0, 0);
    const double span = line->inertia.span[cpsi_line_node(line, c)];
    return vec3_scale(1 / span,
                      cpsi_shift_to(&line->shift[k], cpsi_line_place(line, line->position, c)));
}

/* Give node j, along the unit vector n, the velocity v and such a past. */
static void stop_along(CpsiLine *line, int j, Vec3 n, double v, double h) {
    CpsiInertia *inertia = &line->inertia;
    double *now = &inertia->velocity[3 * j], *old = &inertia->before_velocity[3 * j],
           *before = &inertia->before[3 * j];
    const Vec3 x = vec3_at(line->position, j);
    vec3_store(now, vec3_axpy(v - vec3_dot(n, vec3_load(now)), n, vec3_load(now)));
    vec3_store(old, vec3_axpy(v - vec3_dot(n, vec3_load(old)), n, vec3_load(old)));
    const double off = vec3_dot(n, vec3_sub(x, vec3_load(before))) - h * v;
    vec3_store(before, vec3_axpy(off, n, vec3_load(before)));
}

/* Does contact c bear on what is rigid? What gives slows a node down by its force alone. */
static bool stops(const CpsiLine *line, int c) {
    return line->state[c] != CPS_NODE_STATE_FREE && !(cpsi_soft_spring(line, c).stiffness > 0);
}

/* The contacts at which node j bears on what is rigid, up to two, and orthonormal vectors that span
 * their normals; returns how many. */
static int find_stops(const CpsiLine *line, int j, int contact[2], Vec3 n[2]) {
    int count = 0;
    if (cpsi_line_is_held(line, j)) return 0;
    for (int c = j; c < cpsi_line_contacts(line) && count < 2; c += line->n) {
        if (!stops(line, c)) continue;
        n[count] = vec3_at(line->normal, c);
        if (count > 0) {
            const Vec3 aside = vec3_reject(n[1], n[0]);
            const double sine = vec3_norm(aside);
            if (sine < PARALLEL) continue;
            n[1] = vec3_scale(1 / sine, aside);
        }
        contact[count++] = c;
    }
    return count;
}

/* Stop node j along the normals of the contacts at which it bears. */
static void stop_node(CpsiLine *line, int j, double h) {
    int contact[2];
    Vec3 n[2];
    const int count = find_stops(line, j, contact, n);
    for (int i = 0; i < count; i++)
        stop_along(line, j, n[i], vec3_dot(n[i], ground_velocity(line, contact[i])), h);
}

/* The points of elements that bear, by the least change of their two nodes. */
static void stop_elements(CpsiLine *line) {
    CpsiInertia *inertia = &line->inertia;
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++) {
        const int e = cpsi_line_element(line, c);
        if (e + 1 >= line->n || !stops(line, c)) continue;
        const Vec3 n = vec3_at(line->normal, c), ground = ground_velocity(line, c);
        double rate = -vec3_dot(n, ground), ease = 0, part[2];
        for (int i = 0; i < 2; i++) {
            const bool held = cpsi_line_is_held(line, e + i);
            part[i] = held ? 0 : cpsi_line_part(line, e, e + i);
            ease += part[i] * part[i] / inertia->mass[e + i];
            rate += cpsi_line_part(line, e, e + i) * vec3_dot(n, vec3_at(inertia->velocity, e + i));
        }
        if (!(ease > 0)) continue;
        for (int i = 0; i < 2; i++) {
            double *v = &inertia->velocity[3 * (e + i)];
            vec3_store(v,
                       vec3_axpy(-part[i] / inertia->mass[e + i] * rate / ease, n, vec3_load(v)));
        }
    }
}

/* [m] The largest error of a node by its estimate (pace.h). What bears on something rigid is there,
 * and its error lies in the tangent planes. */
static double error_of(const CpsiLine *line) {
    const CpsiInertia *inertia = &line->inertia;
    double largest = 0;
    for (int j = 0; j < line->n; j++) {
        if (cpsi_line_is_held(line, j)) continue;
        Vec3 off =
            cpsi_step_error(&inertia->formula, inertia->is_euler[j],
                            vec3_at(inertia->before_velocity, j),
                            vec3_at(inertia->start_velocity, j), vec3_at(inertia->velocity, j));
        int contact[2];
        Vec3 n[2];
        const int count = find_stops(line, j, contact, n);
        for (int i = 0; i < count; i++) off = vec3_reject(off, n[i]);
        largest = cpsi_max_nan(largest, vec3_norm(off));
    }
    return largest;
}

/* Count what changed at contacts. Friction may stop at once what lands: the next step of its nodes
 * is an Euler step. */
static void note_events(CpsiLine *line, const unsigned char *state) {
    CpsiInertia *inertia = &line->inertia;
    inertia->landed = inertia->changed = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->state[c] == CPS_NODE_STATE_FREE || line->state[c] == state[c]) continue;
        if (state[c] != CPS_NODE_STATE_FREE) {
            inertia->changed++;
            continue;
        }
        const int e = cpsi_line_element(line, c);
        inertia->landed++;
        inertia->restarts[e < 0 ? cpsi_line_node(line, c) : e] = true;
        if (e >= 0) inertia->restarts[e + 1] = true;
    }
}

/* Go on from the step: it becomes the past. */
static void advance(CpsiLine *line, const CpsiTimeStep *step, const unsigned char *state) {
    CpsiInertia *inertia = &line->inertia;
    const size_t places = 3 * (size_t)line->n * sizeof *inertia->before;
    memset(inertia->restarts, 0, (size_t)line->n * sizeof *inertia->restarts);
    (void)find_rough(line, step->formula.length);
    note_events(line, state);
    cpsi_time_ledger(line, step->formula.length, state);
    inertia->error = error_of(line);
    memcpy(inertia->before, inertia->start, places);
    memcpy(inertia->before_velocity, inertia->start_velocity, places);
    if (cpsi_line_has_damping(line)) cpsi_line_advance_damping(line);
    const double energy = cpsi_kinetic_energy(line);
    for (int j = 0; j < line->n; j++) stop_node(line, j, step->formula.length);
    stop_elements(line);
    cpsi_time_ledger_close(line, energy - cpsi_kinetic_energy(line));
    double stiffness = 0;
    for (int j = 0; j < line->n; j++)
        stiffness += inertia->mass[j] / (inertia->span[j] * inertia->span[j]);
    const double gap = line->report.certificate.gap;
    inertia->position_bound = stiffness > 0 && gap > 0 ? sqrt(2 * gap / stiffness) : 0;
}

/* Are the ends after the step too far apart for an inextensible line that goes round an obstacle?
 * From where the step began. */
static bool falls_short(CpsiLine *line, const CpsiStepOptions *options, const CpsiMove *move,
                        CpsiSubsteps *scratch) {
    cpsi_substeps_restore(line, scratch);
    cpsi_substeps_impose(line, move, scratch, 0, 1);
    return cpsi_line_step_falls_short(line, options);
}

/* There is no such motion: the line stays where it was. */
static void stay(CpsiLine *line) {
    CpsiInertia *inertia = &line->inertia;
    const size_t places = 3 * (size_t)line->n * sizeof *inertia->start;
    memcpy(line->position, inertia->start, places);
    memcpy(inertia->velocity, inertia->start_velocity, places);
    inertia->ledger = (CpsMotionLedger){0};
    inertia->landed = inertia->changed = inertia->snatched = 0;
    inertia->error = 0;
}

void cpsi_line_time_step(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                         const CpsiMove *move, CpsiSubsteps *scratch, const CpsiTimeStep *step) {
    CpsiInertia *inertia = &line->inertia;
    const size_t places = 3 * (size_t)line->n * sizeof *inertia->start;
    if (cpsi_line_has_damping(line) && !inertia->is_moving) cpsi_line_begin_damping(line);
    inertia->is_moving = true;
    memcpy(inertia->velocity_given, move->has_velocity, sizeof inertia->velocity_given);
    memcpy(inertia->past, inertia->start, places);
    memcpy(inertia->start, line->position, places);
    memcpy(inertia->start_velocity, inertia->velocity, places);
    cpsi_substeps_save(line, scratch);
    const bool goes_on = line->last_change.known;
    double share = attempt(line, program, options, move, scratch, step);
    int iterations = line->report.iteration_count;
    if (cps_outcome_is_certified(line->report.outcome) && step->scheme != CPS_TIME_SCHEME_EULER &&
        !step->restarts && !step->in_group && find_rough(line, step->formula.length)) {
        cpsi_substeps_restore(line, scratch);
        line->last_change.known = goes_on; /* what is expected of the step does not depend on it */
        share = attempt(line, program, options, move, scratch, step);
        iterations += line->report.iteration_count;
    }
    const bool failed = !cps_outcome_is_certified(line->report.outcome) &&
                        !cps_outcome_is_final(line->report.outcome);
    if (failed && line->compliance == 0 &&
        !falls_short(line, options, move, scratch)) { /* what the attempt came to */
        cpsi_substeps_restore(line, scratch);
        share = attempt(line, program, options, move, scratch, step);
    }
    const bool stalled = !cps_outcome_is_certified(line->report.outcome) &&
                         !cps_outcome_is_final(line->report.outcome);
    if (stalled && step->scheme != CPS_TIME_SCHEME_EULER && !step->restarts && !step->in_group) {
        /* x* of (9b) may lie where contacts are not those of the step: by (9c) it is x_n */
        cpsi_substeps_restore(line, scratch);
        line->last_change.known = goes_on;
        for (int j = 0; j < line->n; j++) inertia->restarts[j] = true;
        share = attempt(line, program, options, move, scratch, step);
        iterations += line->report.iteration_count;
    }
    /* the way of what went farther round an obstacle is not known, nor on which side of it a line
     * is that it goes past: the steps are too long. In a group that is said at its end
     * (balance_report.c): the forces of a trial are what they are */
    inertia->goes_too_far = cps_outcome_is_certified(line->report.outcome) &&
                            (cpsi_contact_turns_too_far(line) || ground_outruns(line, move));
    if (inertia->goes_too_far && !step->in_group) line->report.outcome = CPS_OUTCOME_STALLED;
    line->report.iteration_count = iterations;
    line->report.places = CPS_PLACES_UNIQUE;
    line->report.substep_count = 1;
    line->report.share = share;
    line->last_change.known =
        cps_outcome_is_certified(line->report.outcome) && !inertia->goes_too_far;
    if (cps_outcome_is_final(line->report.outcome))
        stay(line);
    else
        advance(line, step, scratch->state);
}

bool cpsi_line_is_rough(CpsiLine *line, double h) {
    CpsiInertia *inertia = &line->inertia;
    bool late = false;
    if (!line->has_inertia) return false;
    for (int j = 0; j < line->n; j++) {
        inertia->late[j] = !cpsi_line_is_held(line, j) && cpsi_soft_is_crossed(line, j, h);
        late = late || (inertia->late[j] && inertia->span[j] < h && cpsi_node_loss(line, j, h) < 0);
    }
    for (int e = 0; e + 1 < line->n; e++) {
        if (!is_slack(line, inertia->start, e) || is_slack(line, line->position, e)) continue;
        for (int j = e; j <= e + 1; j++) {
            inertia->late[j] = true;
            late = late || inertia->span[j] < h;
        }
    }
    return late;
}

void cpsi_line_restart_rough(CpsiLine *line) {
    if (!line->has_inertia) return;
    for (int j = 0; j < line->n; j++)
        line->inertia.restarts[j] = line->inertia.restarts[j] || line->inertia.late[j];
}
