/* SPDX-License-Identifier: BSD-3-Clause */
/* A load step in parts (substeps.h).
 *
 * Friction depends on the path, while a step goes straight from one load to the next. A part of a
 * step is accepted
 *   - without a path tolerance: when it converged;
 *   - with a path tolerance: when moreover its two halves lead to the same positions and tensions
 * within the tolerance, and neither half makes nearly the whole displacement; then the two halves
 * are kept;
 *   - in both cases: when its energy balance closes, or that of its halves does: equilibria on
 * different branches differ by more energy than was supplied. Then the halves are kept. Otherwise
 * it is halved, at most `halvings` times. A part of that size is accepted. If it still differs from
 * its halves it is reported as a jump (snap): the displacement does not decrease with the load
 * increment. A part of that size which does not converge is not divided further. Either the line
 * provably slides without end for the rest of the step; or it moves on as overdamped motion
 * (relaxation.h), which is reported as a jump too, and continues from where it comes to rest; or
 * the whole rest is such a motion, and a part with hardly a change certifies where it ends, after
 * the first motion already where parts that were not kept have cost too much; or the rest of the
 * step is taken in one part and reported as it is.
 *
 * The slip round an obstacle is known only where neither the obstacle turns nor a node moves round
 * it by more than a quarter of a turn (cable/contact.h). A step in which an obstacle turns farther
 * is first divided into equal portions of at most a quarter, each of which is taken as above. A
 * part in which a node with friction moves farther counts as not converged. */
#include "evolve/substeps.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "cable/bend.h"
#include "cable/contact.h"
#include "cable/obstacle_side.h"
#include "cable/winch.h"
#include "evolve/ledger.h"
#include "evolve/relaxation.h"

/* After a part whose halves agree to this share of the tolerance, the next part is twice as
 * long. */
static const double EASY = 0.25;

/* A displacement that depends continuously on the load makes about half of it in each half of a
 * part: 0.71 in the half before a limit load, where it grows like a square root, and 0.75 where
 * slip grows like the square of the load. A jump makes all of it in one half. */
static const double SUDDEN = 0.9;

/* A line slides without end where the power of its loads exceeds what friction can dissipate by
 * this share. The directions of forces in a certified equilibrium may be wrong by the root of its
 * relative gap of 1e-8, and the power of its loads by as much. */
static const double SLIDES_LEAST = 1e-4;
/* ... and above this share smaller parts need not be tried. */
static const double SLIDES_CLEARLY = 0.01;

/* A part whose energy imbalance exceeds this share of its dissipation and positive work is taken in
 * halves. The imbalance of a coarse part that follows the path is far smaller. */
static const double OPEN_ENERGY_SHARE = 0.05;
/* [-] Accuracy of positions relative to the length: a node so near to an obstacle touches it. */
static const double POSITION_TOL = CPSI_TOUCH;
/* ... and accuracy of strains, beside the rounding of coordinates. */
static const double ROUNDED_STRAIN = 1e-12;
/* After this many parts of the smallest size whose energy balance does not close, parts of the step
 * are no longer divided for their energy, and the imbalance is reported. */
static const int JUMPS = 8;

/* Parts of a step that may be taken as overdamped motion. */
static const int RELAXATIONS = 8;
/* This share of the rest of a step is never taken so: the step has to end with an equilibrium. */
static const double LAST_SHARE = 0.0625;
/* Where all that has failed, no more than this share is left for that equilibrium: nothing moves by
 * more than 1e-12 of what it does in the step, which is rounding beside positions known to 1e-9. */
static const double HARDLY_ANY = 1e-12;

/* Without a path tolerance parts are no longer divided after so many iterations times nodes spent
 * on parts that were not kept: about a second of one processor. The cost of an iteration beside
 * that of its nodes is counted as further nodes; a general friction set multiplies the cost of a
 * node. */
static const double MAX_WASTED_WORK = 2e6, NODES_BESIDE = 30, SET_COST = 30;

/* More portions than the limits of turns and shifts ask for. */
static const double MOST_PORTIONS = 1e6;

/* Rounding of an angle that is a whole number of quarter turns. */
static const double ROUNDING = 1e-9;

void cpsi_substeps_layout(CpsiSubsteps *scratch, CpsiArena *arena, int n, int contacts,
                          bool own_axes, bool path_tolerance) {
    const size_t all = (size_t)contacts * (size_t)n;
    CPSI_PLACE(arena, scratch->reaction, all);
    CPSI_PLACE(arena, scratch->tension, n);
    CPSI_PLACE(arena, scratch->state, all);
    CPSI_PLACE(arena, scratch->obstacle_index, all);
    if (own_axes) CPSI_PLACE(arena, scratch->normal, 3 * all); /* else they do not change */
    CPSI_PLACE(arena, scratch->position, 3 * (size_t)n);
    if (path_tolerance) CPSI_PLACE(arena, scratch->trial, 4 * (size_t)n);
}

void cpsi_substeps_save(const CpsiLine *line, CpsiSubsteps *scratch) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(scratch->reaction, line->reaction, contacts * sizeof *line->reaction);
    if (line->has_local_axes)
        memcpy(scratch->normal, line->normal, 3 * contacts * sizeof *line->normal);
    memcpy(scratch->tension, line->tension, (n - 1) * sizeof *line->tension);
    memcpy(scratch->state, line->state, contacts * sizeof *line->state);
    if (line->has_local_axes)
        memcpy(scratch->obstacle_index, line->obstacle_index,
               contacts * sizeof *line->obstacle_index);
    memcpy(scratch->end, line->report.end, sizeof scratch->end);
    memcpy(scratch->grasp, line->grasp, sizeof scratch->grasp);
    memcpy(scratch->stored, line->drums.stored, sizeof scratch->stored);
    memcpy(scratch->position, line->position, 3 * n * sizeof *line->position);
}

void cpsi_substeps_restore(CpsiLine *line, const CpsiSubsteps *scratch) {
    const size_t n = (size_t)line->n, contacts = (size_t)cpsi_line_all_contacts(line);
    memcpy(line->reaction, scratch->reaction, contacts * sizeof *line->reaction);
    if (line->has_local_axes)
        memcpy(line->normal, scratch->normal, 3 * contacts * sizeof *line->normal);
    memcpy(line->tension, scratch->tension, (n - 1) * sizeof *line->tension);
    memcpy(line->state, scratch->state, contacts * sizeof *line->state);
    if (line->has_local_axes)
        memcpy(line->obstacle_index, scratch->obstacle_index,
               contacts * sizeof *line->obstacle_index);
    memcpy(line->report.end, scratch->end, sizeof scratch->end);
    memcpy(line->grasp, scratch->grasp, sizeof scratch->grasp);
    cpsi_winch_set(line, scratch->stored);
    memcpy(line->position, scratch->position, 3 * n * sizeof *line->position);
    line->last_change.known = false;
}

/* The result of a part of a step. */
typedef struct Part {
    CpsLineReport report;
    CpsLedger ledger;
    bool strayed; /* as of the line */
} Part;

/* The state of a load step while it is taken. */
typedef struct Advance {
    CpsiLine *line;
    CpsiChainProgram *program;
    const CpsiStepOptions *options;
    const CpsiMove *move;
    CpsiSubsteps *scratch;
    bool known;     /* the forces at the ends are those of an equilibrium */
    int iterations; /* of all parts solved, kept or not */
    double wasted; /* iterations times nodes of parts that were not kept, not counting those for the
                      path tolerance */
    int relaxed;   /* parts tried as overdamped motion */
    int jumps;     /* parts of the smallest size whose energy balance does not close */
    CpsLineReport whole;
    CpsLedger ledger;
} Advance;

static CpsEnd grasp_at(const CpsiMove *move, int k, double share) {
    return cpsi_move_between(&move->grasp_from[k], &move->grasp_to[k], share);
}

/* The weight at a share of the move. */
static void weight_at(const CpsiMove *move, double share, double weight[3]) {
    for (int a = 0; a < 3; a++) {
        const double from = move->weight_from[a], to = move->weight_to[a];
        weight[a] = share < 1 ? from + share * (to - from) : to;
    }
}

/* Put the obstacles where they are at share `to`. */
static void shift_obstacles(const CpsiLine *line, const CpsiMove *move, CpsiSubsteps *scratch,
                            double from, double to) {
    for (int k = 0; k < line->obstacle_count; k++) {
        CpsiShift *shift = &line->shift[k];
        *shift = (CpsiShift){0};
        if (!move->shift) continue;
        *shift = cpsi_shift_part(&move->shift[k], from, to);
        scratch->obstacle[k] = cpsi_move_obstacle(line, move, k, to);
    }
}

/* [m] What is on the drum of an end at a share of the move. */
static double stored_at(const CpsiMove *move, int end, double share) {
    const double from = move->stored_from[end], to = move->stored_to[end];
    return share < 1 ? from + share * (to - from) : to;
}

void cpsi_substeps_impose(CpsiLine *line, const CpsiMove *move, CpsiSubsteps *scratch, double from,
                          double to) {
    weight_at(move, from, line->weight_before);
    weight_at(move, to, line->weight);
    for (int end = 0; end < 2; end++) {
        line->end_before[end] = cpsi_move_end(line, move, end, from);
        line->end[end] = cpsi_move_end(line, move, end, to);
        line->drums.due[end] = stored_at(move, end, to);
    }
    for (int k = 0; k < move->grasp_count; k++) {
        line->grasp_before[k] = grasp_at(move, k, from);
        line->grasp[k].imposed = grasp_at(move, k, to);
    }
    line->inertia.moved_in_span = false;
    for (int k = 0; k < line->obstacle_count; k++) line->turn[k] = (to - from) * move->angle[k];
    shift_obstacles(line, move, scratch, from, to);
}

static void impose(const Advance *substeps, double from, double to) {
    cpsi_substeps_impose(substeps->line, substeps->move, substeps->scratch, from, to);
}

/* A too coarse mesh counts as an answer: smaller parts would not change it. */
static bool is_answer(CpsOutcome outcome) {
    return cps_outcome_is_certified(outcome) || outcome == CPS_OUTCOME_MESH_TOO_COARSE;
}

/* Take the part of the move from share `from` to share `to`. */
static Part accept(Advance *substeps, double from, double to, bool known) {
    CpsiLine *line = substeps->line;
    impose(substeps, from, to);
    const CpsiLedgerStart start = cpsi_ledger_start(line, line->end_before, known);
    cpsi_winch_wind(line);
    cpsi_line_step(line, substeps->program, substeps->options);
    if ((is_answer(line->report.outcome) || line->report.outcome == CPS_OUTCOME_PASSES) &&
        cpsi_contact_turns_too_far(line))
        line->report.outcome = CPS_OUTCOME_STALLED;
    if (!cps_outcome_is_certified(line->report.outcome)) line->last_change.known = false;
    line->report.share = to - from;
    substeps->iterations += line->report.iteration_count;
    Part part = {0};
    if (!cps_outcome_is_final(line->report.outcome)) part.ledger = cpsi_ledger_close(line, &start);
    part.report = line->report;
    part.strayed = line->strayed;
    return part;
}

static bool converged(const Part *part) { return is_answer(part->report.outcome); }

/* Add a part to the whole: sums, the worst outcome, else the later state. */
static void add(Advance *substeps, const Part *part) {
    CpsLineReport *whole = &substeps->whole;
    const CpsLineReport before = *whole;
    *whole = part->report;
    whole->substep_count = before.substep_count + 1;
    whole->warm_count = before.warm_count + part->report.warm_count;
    whole->jump_count = before.jump_count;
    whole->jump = before.jump;
    whole->unaccounted = before.unaccounted;
    whole->outcome = cps_outcome_worse(before.outcome, whole->outcome);
    /* the last part must show that the line passes an obstacle */
    if (before.outcome == CPS_OUTCOME_PASSES && part->report.outcome != CPS_OUTCOME_PASSES)
        whole->outcome = cps_outcome_worse(CPS_OUTCOME_STALLED, whole->outcome);
    if (whole->outcome != part->report.outcome)
        whole->has_proof_obstacle = whole->has_proof_plane = false;
    if (before.places > whole->places) whole->places = before.places;
    if (cpsi_bend_is_sharper(&before.bend, &whole->bend)) whole->bend = before.bend;
    whole->iteration_count = substeps->iterations;
    whole->dissipated += before.dissipated;
    for (int end = 0; end < 2; end++) whole->end[end].work += before.end[end].work;
    cpsi_ledger_add(&substeps->ledger, &part->ledger);
    whole->ledger = substeps->ledger;
}

static void store_trial(const CpsiLine *line, double *trial) {
    for (int j = 0; j < line->n; j++) {
        memcpy(&trial[4 * j], &line->position[3 * j], 3 * sizeof *trial);
        trial[4 * j + 3] = j > 0 ? line->tension[j - 1] : 0;
    }
}

/* The difference between the line and the stored trial. */
typedef struct Difference {
    double displacement; /* largest, per length of the line */
    double tension;      /* largest, per largest force */
} Difference;

static Difference difference(const CpsiLine *line, const double *trial) {
    double displacement = 0, tension = 0;
    for (int j = 0; j < line->n; j++) {
        displacement =
            cpsi_max_nan(displacement, vec3_norm(vec3_sub(vec3_load(&line->position[3 * j]),
                                                          vec3_load(&trial[4 * j]))));
        if (j > 0) tension = cpsi_max_nan(tension, fabs(line->tension[j - 1] - trial[4 * j + 3]));
    }
    const double force = line->report.certificate.largest_force;
    return (Difference){displacement / line->length, force > 0 ? tension / force : 0};
}

/* The energy imbalance of one part or two: energy gained, and with a path tolerance also energy
 * lost; and the uncertainty of an energy by the certificate and the accuracy of positions. */
typedef struct Open {
    double energy, beside; /* [J] the imbalance; dissipated plus positive work */
    double noise;          /* [J] */
} Open;

/* [J] Elastic energy of a line without forces due to the rounding of its coordinates. */
static double rounding_energy(const CpsiLine *line) {
    if (!(line->compliance > 0)) return 0;
    double reach = 0, shortest = line->length;
    for (int j = 0; j < line->n; j++)
        reach = cpsi_max_nan(reach, vec3_norm(vec3_load(&line->position[3 * j])));
    for (int e = 0; e + 1 < line->n; e++)
        if (line->element_length[e] < shortest) shortest = line->element_length[e];
    const double strain = ROUNDED_STRAIN + 8 * DBL_EPSILON * reach / shortest;
    return 0.5 * line->length * strain * (strain / cpsi_line_least_compliance(line));
}

static Open open_energy(const Advance *substeps, const Part *first, const Part *second) {
    Open open = {0};
    for (int k = 0; k < (second ? 2 : 1); k++) {
        const Part *part = k ? second : first;
        open.energy -= part->ledger.imbalance;
        open.beside += cpsi_ledger_exchanged(&part->ledger);
        const CpsCertificate *found = &part->report.certificate;
        open.noise += found->gap + (found->largest_force > 0 ? POSITION_TOL * found->largest_force *
                                                                   substeps->line->length
                                                             : rounding_energy(substeps->line));
    }
    if (substeps->options->solver.path_tolerance > 0) open.energy = fabs(open.energy);
    return open;
}

static bool is_open(const Open *open) {
    return open->energy > OPEN_ENERGY_SHARE * open->beside && open->energy > open->noise;
}

/* A part, taken whole or in its two halves, and its assessment. */
typedef struct Trial {
    Part first, second;
    bool halved; /* the line is at the end of the second half */
    bool good;   /* converged */
    bool agrees; /* with its halves, where these were required */
    bool sudden;
    Difference error;
    double longest; /* [m] largest displacement of a node in one of the halves */
    Open open;      /* of the part or its halves, whichever is kept */
} Trial;

/* Take the halves of a part that was taken whole. */
static void halve(Advance *substeps, double from, double middle, double to, Trial *trial) {
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    trial->first = accept(substeps, from, middle, substeps->known);
    trial->longest = cpsi_line_largest_displacement(substeps->line, substeps->line->reference);
    if (converged(&trial->first)) trial->second = accept(substeps, middle, to, true);
    trial->good = converged(&trial->first) && converged(&trial->second);
    trial->halved = true;
}

/* Do the halves close the energy balance that the whole part left open? */
static bool halves_close_energy(const Advance *substeps, Trial *trial) {
    const Open whole = trial->open;
    trial->open = open_energy(substeps, &trial->first, &trial->second);
    return !is_open(&whole) || (!is_open(&trial->open) && trial->open.energy < 0.5 * whole.energy);
}

/* With a path tolerance: keep the halves, if they lead to the same result. */
static void compare(Advance *substeps, double from, double middle, double to, Trial *trial) {
    const double tolerance = substeps->options->solver.path_tolerance,
                 whole_way =
                     cpsi_line_largest_displacement(substeps->line, substeps->line->reference);
    store_trial(substeps->line, substeps->scratch->trial);
    halve(substeps, from, middle, to, trial);
    if (trial->good) trial->error = difference(substeps->line, substeps->scratch->trial);
    trial->longest =
        cpsi_max_nan(trial->longest,
                     cpsi_line_largest_displacement(substeps->line, substeps->line->reference));
    trial->sudden =
        trial->longest > SUDDEN * whole_way && trial->longest > tolerance * substeps->line->length;
    trial->agrees = !trial->sudden && trial->error.displacement <= tolerance &&
                    trial->error.tension <= tolerance;
    if (trial->good && !halves_close_energy(substeps, trial)) trial->agrees = false;
}

static bool both_certified(const Trial *trial) {
    return cps_outcome_is_certified(trial->first.report.outcome) &&
           cps_outcome_is_certified(trial->second.report.outcome);
}

/* The energy balance is open, or the rounds have strayed: keep the halves if they close it and do
 * not stray. If they find no answer, take the whole part again. */
static void divide(Advance *substeps, double from, double middle, double to, Trial *trial) {
    const Trial whole = *trial;
    halve(substeps, from, middle, to, trial);
    if (!is_open(&whole.open) && !both_certified(trial)) trial->good = false;
    trial->agrees = trial->good && halves_close_energy(substeps, trial) && !trial->first.strayed &&
                    !trial->second.strayed;
    if (trial->good) return;
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    *trial = whole;
    trial->first = accept(substeps, from, to, substeps->known);
}

/* May smaller parts find another branch? With frozen friction a step is one convex problem by
 * definition (S90 P2.1). The friction of the reference may then produce energy, and a path
 * tolerance shows how much that matters. */
static bool may_branch(const Advance *substeps) {
    return substeps->options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT &&
           substeps->jumps < JUMPS;
}

/* May the line jump? With contact of the reference and frozen friction a step is one convex problem
 * without a path. */
static bool may_relax(const Advance *substeps) {
    const CpsiStepOptions *options = substeps->options;
    const bool convex = options->friction_policy == CPS_FRICTION_POLICY_FROZEN &&
                        options->contact_policy == CPS_CONTACT_POLICY_REFERENCE;
    return !convex && substeps->relaxed < RELAXATIONS;
}

/* Take a part of the step; `cut`: it may be divided. */
static Trial try_part(Advance *substeps, double from, double middle, double to, bool cut) {
    cpsi_substeps_save(substeps->line, substeps->scratch);
    Trial trial = {.first = accept(substeps, from, to, substeps->known), .agrees = true};
    trial.good = converged(&trial.first);
    if (!trial.good) return trial;
    trial.open = open_energy(substeps, &trial.first, NULL);
    if (substeps->line->newton.guessed && is_open(&trial.open)) {
        /* restored, the line has no move to go on from: the part begins cold */
        cpsi_substeps_restore(substeps->line, substeps->scratch);
        trial.first = accept(substeps, from, to, substeps->known);
        trial.good = converged(&trial.first);
        if (!trial.good) return trial;
        trial.open = open_energy(substeps, &trial.first, NULL);
    }
    if (substeps->options->solver.path_tolerance > 0)
        compare(substeps, from, middle, to, &trial);
    else if (cut && may_branch(substeps) && (is_open(&trial.open) || trial.first.strayed))
        divide(substeps, from, middle, to, &trial);
    return trial;
}

/* Keep a part, and report a jump or an open energy balance that remains. */
static void keep_part(Advance *substeps, const Trial *trial) {
    CpsLineReport *whole = &substeps->whole;
    add(substeps, &trial->first);
    if (trial->halved) add(substeps, &trial->second);
    substeps->known = true;
    if (trial->sudden || trial->error.displacement > substeps->options->solver.path_tolerance) {
        whole->jump_count++;
        whole->jump = cpsi_max_nan(whole->jump, trial->longest);
    } else if (is_open(&trial->open)) {
        whole->unaccounted += trial->open.energy;
        substeps->jumps++;
    }
}

/* A portion of a step. */
typedef struct Portion {
    double from, to; /* shares of the step */
} Portion;

/* The share of the step that corresponds to a share of the portion. */
static double share_of_step(const Portion *portion, double share) {
    return share < 1 ? portion->from + share * (portion->to - portion->from) : portion->to;
}

/* What is on the drums before a part that is only looked at. */
typedef struct Drums {
    double stored[2];
} Drums;

static Drums wind(const Advance *substeps) {
    const double *stored = substeps->line->drums.stored;
    const Drums before = {{stored[CPS_END_A], stored[CPS_END_B]}};
    cpsi_winch_wind(substeps->line);
    return before;
}

/* The part is none: false, and winches are where they were. */
static bool unwind(const Advance *substeps, const Drums *before) {
    cpsi_winch_set(substeps->line, before->stored);
    return false;
}

/* If the line slides without end from share `from` to share `to`, the end of a portion: add that as
 * the last part. */
static bool add_slide(Advance *substeps, double from, double to, double margin) {
    impose(substeps, from, to);
    const Drums before = wind(substeps);
    if (!cpsi_line_step_slides_endlessly(substeps->line, substeps->options, margin))
        return unwind(substeps, &before);
    Part part = {0};
    part.report = substeps->line->report;
    part.report.share = to - from;
    add(substeps, &part);
    return true;
}

/* Has a motion with contact of the reference taken the line past an obstacle? No contact keeps it
 * before one, and its time steps may come nearer to the axis without end. */
static bool creeps_past(const Advance *substeps) {
    const CpsiLine *line = substeps->line;
    return substeps->options->contact_policy == CPS_CONTACT_POLICY_REFERENCE &&
           cpsi_obstacle_passed(line, substeps->scratch->position, line->position) !=
               CPS_NO_OBSTACLE;
}

/* Take the part from share `from` to share `to` as overdamped motion, after which the line may have
 * an equilibrium again. False where that is not permitted, or the line does not come to rest; then
 * it is restored. */
static bool relax(Advance *substeps, double from, double to) {
    CpsiLine *line = substeps->line;
    CpsLineReport *whole = &substeps->whole;
    CpsiRelaxation done;
    if (!may_relax(substeps)) return false;
    substeps->relaxed++;
    impose(substeps, from, to);
    line->last_change.known = false;
    const bool rests = cpsi_line_relax(line, substeps->program, substeps->options, line->end_before,
                                       substeps->known, &done);
    substeps->iterations += done.iterations;
    if (!rests || creeps_past(substeps)) {
        cpsi_substeps_restore(line, substeps->scratch);
        return false;
    }
    whole->substep_count++;
    whole->jump_count++;
    whole->jump = cpsi_max_nan(whole->jump,
                               cpsi_line_largest_displacement(line, substeps->scratch->position));
    whole->dissipated += done.dissipated;
    for (int end = 0; end < 2; end++) whole->end[end].work += done.work[end];
    cpsi_ledger_add(&substeps->ledger, &done.ledger);
    whole->ledger = substeps->ledger;
    substeps->known = true;
    return true;
}

/* Is the line too short for the positions of its ends at the end of the step? Checked before the
 * step is divided: for ends on straight paths round a cylinder the worst position is the last
 * (docs/theory.md 5). */
static bool add_shortfall(Advance *substeps) {
    impose(substeps, 0, 1);
    const Drums before = wind(substeps);
    if (!cpsi_line_step_falls_short(substeps->line, substeps->options))
        return unwind(substeps, &before);
    Part part = {0};
    part.report = substeps->line->report;
    part.report.share = 1;
    add(substeps, &part);
    return true;
}

/* The cost of the solutions since there were `before` iterations: iterations times nodes. For
 * converged parts general friction sets cost no more, so that they are divided alike. */
static double cost_of(const Advance *substeps, int before, bool good) {
    const CpsiLine *line = substeps->line;
    double nodes = line->n + NODES_BESIDE;
    if (!good)
        for (int k = 0; k < line->obstacle_count; k++)
            if (line->obstacle[k].has_set) nodes = fmax(nodes, SET_COST * line->n);
    return (double)(substeps->iterations - before) * nodes;
}

/* If frozen friction cannot hold a line with two free ends from the start of the part to the end of
 * the portion: add that as the last part. */
static bool add_escape(Advance *substeps, double from, double to) {
    impose(substeps, from, to);
    const Drums before = wind(substeps);
    if (!cpsi_line_step_outruns_bounds(substeps->line, substeps->options))
        return unwind(substeps, &before);
    Part part = {0};
    part.report = substeps->line->report;
    part.report.share = to - from;
    add(substeps, &part);
    return true;
}

/* If the line, where it is at share `from`, is caught on the rest of the step: add that as the last
 * part. Otherwise the line is not changed. */
static bool add_catch(Advance *substeps, double from) {
    impose(substeps, from, 1);
    const Drums before = wind(substeps);
    if (!cpsi_line_step_is_caught(substeps->line, substeps->options))
        return unwind(substeps, &before);
    Part part = {0};
    part.report = substeps->line->report;
    part.report.share = 1 - from;
    add(substeps, &part);
    return true;
}

/* The rest of a portion by a proof that there is no equilibrium; the line is restored if there is
 * no proof. */
static bool end_in_proof(Advance *substeps, double from, double to) {
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    if (add_slide(substeps, from, to, SLIDES_LEAST)) return true;
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    if (add_escape(substeps, from, to)) return true;
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    return false;
}

/* Take the rest of a portion in one part, and keep it whatever its outcome. If `tried`, the whole
 * portion was too dear to be divided: it fails again, and not all strategies are tried. */
static void accept_rest(Advance *substeps, double from, double to, bool tried) {
    const CpsiStepOptions *all = substeps->options;
    CpsiStepOptions options = *all;
    options.fails = tried;
    substeps->options = &options;
    Trial rest = {.first = accept(substeps, from, to, substeps->known)};
    substeps->options = all;
    if (converged(&rest.first) || rest.first.report.outcome == CPS_OUTCOME_PASSES)
        rest.open = open_energy(substeps, &rest.first, NULL);
    keep_part(substeps, &rest);
}

/* Where friction follows the reactions and only what touched is kept out of obstacles: take the
 * rest of a portion in one part that may pass obstacles (docs/theory.md 2.6). False where that is
 * of no use; then the line is restored. */
static bool accept_across(Advance *substeps, double from, double to) {
    const CpsiStepOptions *all = substeps->options;
    if (all->contact_policy != CPS_CONTACT_POLICY_REFERENCE ||
        all->friction_policy != CPS_FRICTION_POLICY_CONSISTENT || !substeps->line->has_local_axes)
        return false;
    CpsiStepOptions options = *all;
    options.across = true;
    cpsi_substeps_save(substeps->line, substeps->scratch);
    substeps->options = &options;
    Trial rest = {.first = accept(substeps, from, to, substeps->known)};
    substeps->options = all;
    if (!converged(&rest.first) && rest.first.report.outcome != CPS_OUTCOME_PASSES) {
        cpsi_substeps_restore(substeps->line, substeps->scratch);
        return false;
    }
    rest.open = open_energy(substeps, &rest.first, NULL);
    keep_part(substeps, &rest);
    return true;
}

/* The next smaller part after one that was tried, which ended with the portion if it reached beyond
 * what was `left` of it: the same part is not tried twice. */
static double smaller_part(double part, double left) {
    do part *= 0.5;
    while (part >= left);
    return part;
}

/* Take the rest of a portion as overdamped motion, and certify where the line comes to rest by a
 * part in which hardly anything changes. False where that fails; then the line is restored. */
static bool relax_rest(Advance *substeps, double from, double to) {
    const double rest_from = to - HARDLY_ANY;
    if (!(rest_from > from)) return false;
    const Advance before = *substeps;
    cpsi_substeps_save(substeps->line, substeps->scratch);
    substeps->relaxed = 0;
    if (relax(substeps, from, rest_from)) {
        const Part rest = accept(substeps, rest_from, to, true);
        if (converged(&rest)) {
            add(substeps, &rest);
            return true;
        }
    }
    const int iterations = substeps->iterations;
    *substeps = before;
    substeps->iterations = iterations;
    cpsi_substeps_restore(substeps->line, substeps->scratch);
    return false;
}

/* Take a portion in parts, each halved up to `halvings` times. */
static void advance_portion(Advance *substeps, Portion portion, int halvings) {
    const double tolerance = substeps->options->solver.path_tolerance, least = ldexp(1, -halvings);
    for (double at = 0, part = 1;
         at < 1 && !cpsi_interrupt_seen(substeps->program->base.interrupt);) {
        const double end = at + part < 1 ? at + part : 1,
                     middle = share_of_step(&portion, at + 0.5 * (end - at));
        const double from = share_of_step(&portion, at), to = share_of_step(&portion, end);
        const int before = substeps->iterations;
        if (add_catch(substeps, from)) return;
        const Trial trial = try_part(substeps, from, middle, to, part > least);
        if (cps_outcome_is_final(trial.first.report.outcome)) {
            add(substeps, &trial.first);
            return;
        }
        const bool kept = trial.good && trial.agrees;
        if (!trial.good || (!kept && tolerance == 0))
            substeps->wasted += cost_of(substeps, before, trial.good);
        if (!kept && part > least && substeps->wasted < MAX_WASTED_WORK) {
            cpsi_substeps_restore(substeps->line, substeps->scratch);
            if (!trial.good && part == 1 && add_slide(substeps, from, portion.to, SLIDES_CLEARLY))
                return;
            cpsi_substeps_restore(substeps->line, substeps->scratch);
            part = smaller_part(part, 1 - at);
            continue;
        }
        if (!trial.good) { /* it cannot be made smaller */
            if (end_in_proof(substeps, from, portion.to)) return;
            const bool dear = substeps->relaxed > 0 && substeps->wasted >= MAX_WASTED_WORK;
            if (dear && relax_rest(substeps, from, portion.to)) return;
            const double jump = fmin(ldexp(part, substeps->relaxed), (1 - LAST_SHARE) * (1 - at));
            if (relax(substeps, from, share_of_step(&portion, at + jump))) {
                at += jump;
                continue;
            }
            if (!relax_rest(substeps, from, portion.to) &&
                !accept_across(substeps, from, portion.to))
                accept_rest(substeps, from, portion.to, at == 0 && end == 1);
            return;
        }
        keep_part(substeps, &trial);
        at = end;
        if (trial.error.displacement <= EASY * tolerance && trial.error.tension <= EASY * tolerance)
            part *= 2;
    }
}

/* [m] How far a curved obstacle is shifted where the line may meet it. An obstacle that turns about
 * a point moves differently everywhere. */
static double shift_size(const CpsiLine *line, const CpsiMove *move, int k) {
    const CpsiShift *shift = &move->shift[k];
    const double by = vec3_norm(shift->by);
    if (cpsi_vec3_is_zero(shift->turn)) return by;
    const CpsiObstacle start = cpsi_move_obstacle(line, move, k, 0);
    double most = 0, drawn = 0;
    for (int end = 0; end < 2; end++)
        if (move->to[end].kind == CPS_END_KIND_HELD)
            drawn = fmax(drawn, vec3_norm(vec3_sub(vec3_load(move->to[end].value),
                                                   vec3_load(move->from[end].value))));
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j);
        const bool round = cpsi_obstacle_is_round(&start);
        const double gap = cpsi_obstacle_gap(&start, x);
        const Vec3 foot = vec3_sub(x, round ? cpsi_obstacle_spoke(&start, x)
                                            : vec3_scale(gap, cpsi_obstacle_normal(&start, x)));
        const double size = by + vec3_norm(vec3_cross(shift->turn, vec3_sub(foot, shift->about))),
                     element = line->element_length[j < line->n - 1 ? j : j - 1];
        if (gap <= size + drawn + element) most = fmax(most, size);
    }
    return most;
}

/* Number of equal portions of a step in each of which no obstacle turns by more than a quarter
 * turn, nor is shifted too far. */
static int portion_count(const CpsiLine *line, const CpsiMove *move) {
    double most = 0;
    for (int k = 0; k < line->obstacle_count; k++)
        most = cpsi_max_nan(most, fabs(move->angle[k]) +
                                      (move->shift ? vec3_norm(move->shift[k].turn) : 0));
    const double quarters = ceil(most / CPSI_QUARTER - ROUNDING);
    double count = quarters > 1 ? quarters : 1;
    if (move->shift)
        for (int k = 0; k < line->obstacle_count; k++)
            if (line->obstacle[k].kind != CPS_OBSTACLE_PLANE)
                count = fmax(count, ceil(shift_size(line, move, k) /
                                         (CPSI_MOST_SHIFT * line->obstacle[k].radius)));
    return (int)fmin(count, MOST_PORTIONS);
}

void cpsi_line_substeps(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                        const CpsiMove *move, CpsiSubsteps *scratch, bool known) {
    Advance substeps = {line, program, options, move, scratch, .known = known};
    const int count = add_shortfall(&substeps) ? 0 : portion_count(line, move);
    for (int k = 0; k < count && !cps_outcome_is_final(substeps.whole.outcome); k++) {
        /* once a part is not certified, there is no point in dividing the rest */
        const int halvings =
            cps_outcome_is_certified(substeps.whole.outcome) ? options->solver.max_halvings : 0;
        advance_portion(&substeps, (Portion){(double)k / count, (double)(k + 1) / count}, halvings);
    }
    line->report = substeps.whole;
}
