/* SPDX-License-Identifier: BSD-3-Clause */
/* Overdamped motion to rest (relaxation.h): time steps with a drag (cable/damped_step.h), each from
 * where the last one ended, with the actual friction. The drag is inverse to the length of a time
 * step. It decreases where displacements are small, so that the last time steps are long, and
 * increases where a time step cannot be solved or an obstacle shortens it. */
#include "evolve/relaxation.h"

#include <math.h>
#include <string.h>

#include "cable/existence.h"
#include "cable/winch.h"
#include "evolve/ledger.h"

/* Largest number of time steps. */
static const int STEPS = 400;
/* [-] The drag of the first time step: forces of the size of the loads move a line by a 64th of its
 * length. */
static const double FIRST_DRAG = 64;
/* ... its range. With the least drag a time step goes as far as the line needs. */
static const double LEAST_DRAG = 1e-6, MOST_DRAG = 1e8;
/* The drag decreases after a time step in which no node moves farther than this share of the
 * length. */
static const double EASY_MOTION = 0.05;
/* The line rests where drag times motion is this share of the forces, and the motion this share of
 * the length. */
static const double REST_FORCE = 1e-7, REST_MOTION = 1e-6;

static double next_drag(const CpsiLine *line, const CpsiDampedStep *step, double drag) {
    if (!step->solved || step->shortened) return fmin(4 * drag, MOST_DRAG);
    const bool easy = step->distance <= EASY_MOTION * line->length;
    return easy ? fmax(0.5 * drag, LEAST_DRAG) : drag;
}

bool cpsi_line_relax(CpsiLine *line, CpsiChainProgram *program, const CpsiStepOptions *options,
                     const CpsEnd before[2], bool known, CpsiRelaxation *done) {
    CpsEnd from[2] = {before[0], before[1]};
    double drag = FIRST_DRAG;
    *done = (CpsiRelaxation){0};
    const CpsiLedgerStart first = cpsi_ledger_start(line, from, known);
    cpsi_winch_wind(line);
    bool winds = line->drums.moved; /* in the step that is next */
    for (int k = 0; k < STEPS && !cpsi_interrupt_seen(program->base.interrupt); k++) {
        const CpsiLedgerStart start = winds ? first : cpsi_ledger_start(line, from, known);
        line->report.iteration_count = 0;
        const CpsiDampedStep step = cpsi_line_damped_step(line, program, options, drag);
        done->iterations += line->report.iteration_count;
        const double taken = drag;
        drag = next_drag(line, &step, drag);
        if (!step.solved) {
            if (taken >= MOST_DRAG) return false;
            continue;
        }
        const CpsLedger ledger = cpsi_ledger_close(line, &start);
        cpsi_ledger_add(&done->ledger, &ledger);
        done->dissipated += line->report.dissipated;
        for (int end = 0; end < 2; end++) done->work[end] += line->report.end[end].work;
        memcpy(from, line->end, sizeof from);
        for (int i = 0; i < line->grasp_count; i++) line->grasp_before[i] = line->grasp[i].imposed;
        memcpy(line->weight_before, line->weight, sizeof line->weight);
        for (int i = 0; i < line->obstacle_count; i++) {
            line->turn[i] = 0;
            line->shift[i] = (CpsiShift){0};
        }
        known = true;
        winds = false;
        double direction[3], load;
        if (cpsi_line_falls_away(line, direction, &load)) return true;
        const double left = step.distance / line->length;
        if (!step.shortened && left <= REST_MOTION && taken * left <= REST_FORCE) return true;
    }
    return false;
}
