/* SPDX-License-Identifier: BSD-3-Clause */
/* Warm steps (warm_step.h). */
#include "cable/warm_step.h"

#include <math.h>
#include <string.h>

#include "cable/contact.h"
#include "cable/end_set.h"
#include "cable/friction_law.h"
#include "cable/held.h"
#include "cable/inertia_field.h"
#include "cable/soft.h"
#include "chain/frame.h"
#include "chain/polish.h"

/* The increment of the loads is c times the last one, up to this share of it. */
static const double SAME_WAY = 0.5;
/* ... with a ratio c up to this. */
static const double MOST_RATIO = 4;
/* An extrapolated tension is at least this share of the last one. */
static const double LEAST_TENSION = 0.5;
/* The tension that places expected in a step in time give is within this share of the last one. */
static const double LIKE = 0.1;
/* Failures that are counted where the method has been of use before. */
enum { USEFUL_PATIENCE = 3 };
/* A force is at its bound up to what a loop that stopped at the tolerance leaves. */
static const double ROUGHLY = 1e-2;
/* The increments of the loads in the substep. */
static CpsiLoadChange change_of(const CpsiLine *line) {
    CpsiLoadChange out = {.known = true};
    for (int end = 0; end < 2; end++) {
        out.kind[end] = line->end[end].kind;
        if (line->end_before[end].kind != line->end[end].kind) out.known = false;
        for (int a = 0; a < 3; a++)
            out.end[end][a] = line->end[end].value[a] - line->end_before[end].value[a];
    }
    out.grasp_count = line->grasp_count;
    for (int k = 0; k < line->grasp_count; k++) {
        const CpsGrasp *grasp = &line->grasp[k];
        const CpsEnd *before = &line->grasp_before[k];
        out.grasp[k].node = grasp->node;
        out.grasp[k].kind = grasp->imposed.kind;
        if (before->kind != grasp->imposed.kind) out.known = false;
        for (int a = 0; a < 3; a++) out.grasp[k].by[a] = grasp->imposed.value[a] - before->value[a];
    }
    for (int a = 0; a < 3; a++) out.weight[a] = line->weight[a] - line->weight_before[a];
    out.winds = line->drums.moved;
    for (int k = 0; k < line->obstacle_count; k++) {
        out.turn += line->turn[k];
        if (cpsi_line_is_shifted(line, k)) out.known = false;
    }
    return out;
}

/* <a, b> of two increments, in lengths of the line and forces of the size of its own. */
static double product(const CpsiLine *line, const CpsiLoadChange *a, const CpsiLoadChange *b) {
    const double force = line->report.certificate.largest_force;
    const double by_force = force > 0 ? 1 / force : 1, by_weight = by_force * line->length;
    double sum = a->turn * b->turn;
    for (int i = 0; i < 3; i++) {
        for (int end = 0; end < 2; end++) {
            const double by = a->kind[end] == CPS_END_KIND_HELD ? 1 / line->length : by_force;
            sum += by * a->end[end][i] * (by * b->end[end][i]);
        }
        for (int k = 0; k < a->grasp_count; k++) {
            const double by = a->grasp[k].kind == CPS_END_KIND_HELD ? 1 / line->length : by_force;
            sum += by * a->grasp[k].by[i] * (by * b->grasp[k].by[i]);
        }
        sum += by_weight * a->weight[i] * (by_weight * b->weight[i]);
    }
    return sum;
}

/* The factor by which the last move is extrapolated; 0 where the loads do not go on. */
static double ratio_of(const CpsiLine *line, const CpsiLoadChange *now) {
    const CpsiLoadChange *last = &line->last_change;
    if (!last->known || !now->known || last->winds || now->winds) return 0;
    if (last->grasp_count != now->grasp_count) return 0;
    for (int end = 0; end < 2; end++)
        if (last->kind[end] != now->kind[end]) return 0;
    for (int k = 0; k < now->grasp_count; k++)
        if (last->grasp[k].node != now->grasp[k].node || last->grasp[k].kind != now->grasp[k].kind)
            return 0;
    const double before = product(line, last, last), along = product(line, last, now),
                 size = product(line, now, now), ratio = along / before;
    if (!(before > 0) || !(ratio > 0) || !(ratio <= MOST_RATIO)) return 0;
    const double aside = size - along * ratio;
    return aside <= SAME_WAY * SAME_WAY * size ? ratio : 0;
}

/* ... of an element? */
static bool treats_element(const CpsiLine *line, int c) {
    for (int k = 0; k < line->obstacle_count; k++)
        if (line->obstacle[k].has_set) return false;
    return !line->keeps_reference_axes && !cpsi_line_is_third(line, c);
}

bool cpsi_warm_step_treats(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (c >= cpsi_line_contacts(line) && !treats_element(line, c)) return false;
    if (!obstacle->has_set) return obstacle->shape != CPS_FRICTION_SHAPE_BOX;
    const CpsiFrictionSet *given = cpsi_line_friction_law(line, c).given;
    return !given || cpsi_friction_set_shape(given);
}

/* ... in time, of nodes with one plane that gives, without friction? */
static bool treats_soft(const CpsiLine *line) {
    if (!line->inertia.is_moving || line->obstacle_count != 1 ||
        line->obstacle[0].kind != CPS_OBSTACLE_PLANE || line->contacts > 1)
        return false;
    for (int j = 0; j < line->n; j++)
        if (line->friction_law[j].friction > 0) return false;
    return true;
}

/* How far the method treats the contacts that the line has now; second
 * ones from the solution of a round on, since a line may rest in a corner, or slide along it, under
 * the same forces. */
static CpsiGuess treated_contacts(const CpsiLine *line) {
    CpsiGuess best = CPSI_GUESS_EXTRAPOLATED;
    if (cpsi_line_has_soft(line)) return treats_soft(line) ? best : CPSI_GUESS_NONE;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (!cpsi_line_obstacle(line, c) || line->state[c] == CPS_NODE_STATE_FREE) continue;
        if (!cpsi_warm_step_treats(line, c)) return CPSI_GUESS_NONE;
        if (c >= line->n && c < cpsi_line_contacts(line)) best = CPSI_GUESS_LATER;
    }
    return best;
}

/* [N] The tension of element e at a length in the step to come; that of the step before where it
 * is hardly near that one, as after a snatch. */
static double expected_tension(const CpsiLine *line, int e, double size) {
    const double last = line->tension[e], strain = size / line->element_length[e] - 1;
    const CpsiElementLaw law = cpsi_line_law(line, e);
    if (!(law.compliance > 0)) return last;
    const double now = law.count > 0 ? cpsi_law_tension(&law, strain) : strain / law.compliance;
    return fabs(now - last) <= LIKE * last ? now : last;
}

/* The guess of a step in time: what is expected of it. */
static void expect(const CpsiLine *line, CpsiChainProgram *program) {
    Vec3 before = vec3(0, 0, 0);
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j), to = cpsi_line_is_held(line, j)
                                                            ? cpsi_line_held_place(line, j)
                                                            : cpsi_line_expected_place(line, j, x);
        vec3_store(&program->base.residual[3 * j], vec3_sub(to, x));
        if (j > 0) program->dt[j] = expected_tension(line, j - 1, vec3_norm(vec3_sub(to, before)));
        before = to;
    }
}

CpsiGuess cpsi_warm_step_guess(CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options) {
    const CpsiLoadChange now = change_of(line);
    const double ratio = ratio_of(line, &now);
    const bool settled = line->last_change.known;
    line->newton.tried = line->newton.solved = line->newton.failed = 0;
    line->newton.guessed = line->newton.began = line->newton.unpolished = false;
    line->last_change = now;
    if (options->frictionless) line->last_change.known = false;
    const CpsiGuess treated = treated_contacts(line);
    if (options->frictionless || options->solver.cold || treated == CPSI_GUESS_NONE ||
        cpsi_line_has_sets(line))
        return CPSI_GUESS_NONE;
    if (!settled || treated == CPSI_GUESS_LATER) return CPSI_GUESS_LATER;
    if (line->newton.pause > 0) {
        line->newton.pause--;
        return CPSI_GUESS_LATER;
    }
    if (line->inertia.is_moving) {
        expect(line, program);
        return CPSI_GUESS_EXTRAPOLATED;
    }
    if (!(ratio > 0) || cpsi_contact_holds_element(line)) return CPSI_GUESS_REFERENCE;
    double *shift = program->base.residual, *tension = program->dt;
    for (int i = 0; i < 3 * line->n; i++)
        shift[i] = ratio * (line->position[i] - line->reference[i]);
    for (int i = 1; i < line->n; i++) {
        const double t = line->tension[i - 1], *x = &line->reference[3 * (i - 1)];
        const double strain =
            vec3_norm(vec3_sub(vec3_load(x + 3), vec3_load(x))) / line->element_length[i - 1] - 1;
        const CpsiElementLaw law = cpsi_line_law(line, i - 1);
        const double own = law.count > 0 ? cpsi_law_tension(&law, strain) : strain / law.compliance,
                     before = law.compliance > 0 ? own : t;
        tension[i] = fmax(t + ratio * (t - before), LEAST_TENSION * t);
    }
    return CPSI_GUESS_EXTRAPOLATED;
}

CpsiGuess cpsi_warm_step_go_on(const CpsiLine *line, CpsiChainProgram *program,
                               const CpsiStepOptions *options) {
    if (options->frictionless || options->solver.cold || cpsi_line_has_sets(line))
        return CPSI_GUESS_NONE;
    for (int i = 0; i < 3 * line->n; i++)
        program->base.residual[i] = line->position[i] - line->reference[i];
    for (int i = 1; i < line->n; i++) program->dt[i] = line->tension[i - 1];
    return treated_contacts(line);
}

void cpsi_warm_step_predict(CpsiLine *line, const CpsiChainProgram *program) {
    const double *shift = program->base.residual;
    for (int i = 0; i < 3 * line->n; i++) line->position[i] = line->reference[i] + shift[i];
    cpsi_line_put_held(line, line->position);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++)
        line->active[c] = line->state[c] != CPS_NODE_STATE_FREE && line->reaction[c] > 0;
}

/* Move the first guess of the program to `shift` from the base. */
static void place(const CpsiLine *line, CpsiChainProgram *program, const double *shift) {
    double before[3] = {0};
    for (int j = 0; j < line->n; j++) {
        const double *axes = program->frame ? &program->frame[9 * j] : line->common_axes;
        double *u = &program->base.u[3 * j], to[3] = {0}, by[3] = {0}, moved[3] = {0};
        if (shift) {
            for (int a = 0; a < 3; a++) moved[a] = shift[3 * j + a] / line->length;
            cpsi_frame_to(to, axes, moved);
        }
        for (int a = 0; a < 3 && !program->held[j]; a++) {
            by[a] = to[a] - u[a];
            u[a] = to[a];
        }
        if (program->frame)
            cpsi_frame_from(moved, axes, by);
        else
            memcpy(moved, by, sizeof moved);
        for (int a = 0; a < 3; a++) {
            if (j > 0)
                program->segment.s[j][1 + a] += (moved[a] - before[a]) / program->segment.length[j];
            before[a] = moved[a];
        }
    }
}

/* Is the friction of contact c at its bound, up to a share of it? */
static bool is_at_bound(const CpsiLine *line, int c, double share) {
    double f[3], inside[3];
    const double bound = line->friction_bound[c];
    cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
    if (line->friction_law[c].given) {
        const CpsiFrictionShape *shape = cpsi_friction_set_shape(line->friction_law[c].given);
        const double over = bound > 0 ? 1 / ((1 - share) * bound) : 0;
        const double x[2] = {over * f[0], over * f[1]};
        int piece;
        return shape && cpsi_friction_shape_beyond(shape, x, &piece) > 0;
    }
    memcpy(inside, f, sizeof f);
    cpsi_friction_law_clip(&line->friction_law[c], bound, (1 - share) * bound, inside);
    return inside[0] != f[0] || inside[1] != f[1];
}

void cpsi_warm_step_note_round(CpsiLine *line, const CpsiChainProgram *program) {
    const CpsiFrictionDisc *disc = &program->disc;
    const CpsiFrictionConic *conic = &program->conic;
    memset(line->at_bound, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->at_bound);
    for (int d = 0; d < disc->count; d++)
        if (cpsi_chain_disc_slips(program, d)) line->at_bound[disc->contact[d]] = true;
    for (int k = 0; k < conic->count; k++)
        line->at_bound[conic->contact[k]] = cpsi_chain_conic_slips(program, k);
}

/* Did friction slip at contact c in the last step or round? */
static bool slipped(const CpsiLine *line, int c, CpsiGuess guess) {
    if (guess >= CPSI_GUESS_BASE) return line->at_bound[c];
    if (guess == CPSI_GUESS_REFERENCE) return false;
    return line->state[c] == CPS_NODE_STATE_UNRESOLVED ? is_at_bound(line, c, ROUGHLY)
                                                       : line->state[c] == CPS_NODE_STATE_SLIP;
}

static void guess_pairs(const CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale,
                        CpsiGuess guess, const double *tension) {
    CpsiUnilateral *unilateral = &program->unilateral;
    CpsiFrictionDisc *disc = &program->disc;
    for (int i = 1; i < line->n; i++)
        program->segment.z[i][0] = (tension ? tension[i] : line->tension[i - 1]) / scale->force;
    for (int k = 0; k < unilateral->count; k++) {
        const int c = unilateral->contact[k];
        const bool closed =
            guess >= CPSI_GUESS_BASE ? line->active[c] : line->state[c] != CPS_NODE_STATE_FREE;
        unilateral->z[k] = closed ? line->reaction[c] / (scale->force * unilateral->weight[k]) : 0;
    }
    for (int d = 0; d < disc->count; d++) {
        const int c = disc->contact[d];
        const double over = line->friction_bound[c] > 0 ? 1 / line->friction_bound[c] : 0;
        disc->s[d][0] = slipped(line, c, guess);
        const bool shaped = disc->shape && disc->shape[d];
        /* it is in no corner, and not that of an element */
        if (!shaped && line->contacts < 2 && c < cpsi_line_contacts(line)) continue;
        double f[3];
        cpsi_frame_to(f, cpsi_line_axes(line, c), &line->friction_force[3 * c]);
        for (int a = 0; a < 2; a++)
            disc->z[d][1 + a] = shaped ? over * f[a] : f[a] / (scale->force * disc->weight[d]);
    }
}

void cpsi_warm_step_start(CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale,
                          CpsiGuess guess) {
    const bool extrapolated = guess == CPSI_GUESS_EXTRAPOLATED;
    const bool predicted = guess == CPSI_GUESS_PREDICTED;
    place(line, program, extrapolated ? program->base.residual : NULL);
    guess_pairs(line, program, scale, guess, extrapolated || predicted ? program->dt : NULL);
}

void cpsi_warm_step_note(CpsiLine *line, bool certified) {
    CpsiNewtonRecord *record = &line->newton;
    if (certified && record->began) {
        record->useful = true;
        record->failures = 0;
    } else if (record->failures < (record->useful ? USEFUL_PATIENCE : CPSI_NEWTON_PATIENCE)) {
        record->failures++;
    }
    record->pause = record->failures > 1 ? (1 << record->failures) - 2 : 0;
}
