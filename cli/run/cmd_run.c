/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan run: solve a scene step by step, write its results, print a short table; or the same by
 * the method of 1990 (regularized_run.h).
 *
 * The first SIGINT or SIGTERM interrupts the load step and keeps the steps before it; the second
 * ends the program at once. A journal of the steps is kept beside the results until the run is
 * finished: after an interruption of any kind, --resume continues from there. */
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "capstan/failure.h"
#include "capstan/io.h"
#include "capstan/results.h"
#include "coarse_steps.h"
#include "commands.h"
#include "destination.h"
#include "options.h"
#include "printable.h"
#include "progress.h"
#include "run/end_table.h"
#include "run/energy.h"
#include "run/extremes.h"
#include "run/regularized_options.h"
#include "run/regularized_run.h"
#include "run/warnings.h"
#include "signals.h"

enum { NAME_WIDTH = 18, LINE_WIDTH = 10 };

/* A range narrower than this, relative to the largest force, is printed as one value. */
static const double RANGE_SHOWN = 1e-5;

static void print_head(FILE *table) {
    static const char *const NAME[] = {"tension A", "tension B"},
                             *const ERROR[] = {"bound", "mesh"},
                             *const LENGTH[] = {"grounded", "slipping", "slack"};
    fprintf(table, "%-*s %-*s %-15s %8s %4s %9s", NAME_WIDTH, "step", LINE_WIDTH, "line", "outcome",
            "substeps", "iter", "gap/scale");
    for (int i = 0; i < 2; ++i) fprintf(table, " %12s", NAME[i]);
    for (int i = 0; i < 2; ++i) fprintf(table, " %8s", ERROR[i]);
    for (int i = 0; i < 3; ++i) fprintf(table, " %10s", LENGTH[i]);
    fprintf(table, "\n%-*s %-*s %-15s %8s %4s %9s", NAME_WIDTH, "", LINE_WIDTH, "", "", "", "", "");
    for (int i = 0; i < 2; ++i) fprintf(table, " %12s", "N");
    for (int i = 0; i < 2; ++i) fprintf(table, " %8s", "N");
    for (int i = 0; i < 3; ++i) fprintf(table, " %10s", "m");
    fputc('\n', table);
}

/* An error of the tension [N], or - where it is not known. */
static void print_error(FILE *table, bool known, double error) {
    if (known && isfinite(error))
        fprintf(table, " %8.2g", error);
    else
        fprintf(table, " %8s", "-");
}

/* [N] tension at an end; 0 where it is below the accuracy of the solution, 1e-9 of the largest
 * force */
static double shown_tension(const CpsLineReport *line, int end) {
    const double tension = line->end[end].tension;
    return tension < 1e-9 * line->certificate.largest_force ? 0 : tension;
}

/* at the end of a stage, where forces at rest leave the tension of the end's element
 * undetermined */
static void print_range(FILE *table, char end, const CpsTensionRange *range, double force) {
    if (range->kind == CPS_RANGE_UNBOUNDED)
        fprintf(table, "%*s element at %c: any tension from %.6g N up may hold it (jammed)\n",
                NAME_WIDTH + 1 + LINE_WIDTH, "", end, range->least);
    else if (range->kind == CPS_RANGE_BOUNDED &&
             range->greatest - range->least > RANGE_SHOWN * force)
        fprintf(table, "%*s element at %c: any tension from %.6g to %.6g N may hold it\n",
                NAME_WIDTH + 1 + LINE_WIDTH, "", end, range->least, range->greatest);
}

/* [m] natural length of elements with |x'| < 1, by more than the strain tolerance of a judgement
 * (cps_solution_judge with 1e-8) */
static double outside_kin(const CpsLineView *view) {
    double length = 0;
    for (int i = 0; i < view->element_count; ++i) {
        const double *a = view->position + 3 * (size_t)i, l = view->element_length[i];
        const double chord = sqrt((a[3] - a[0]) * (a[3] - a[0]) + (a[4] - a[1]) * (a[4] - a[1]) +
                                  (a[5] - a[2]) * (a[5] - a[2]));
        if (chord < (1 - 1e-4) * l) length += l;
    }
    return length;
}

/* With the friction of the reference a step is P4.2 of S90. Print whether its solution lies in Kin,
 * and therefore solves P3.1, and whether it is unique. */
static void print_solution(FILE *solutions, const char *step, const CpsLineReport *line,
                           const CpsLineView *view) {
    const double length = outside_kin(view);
    cli_print_text(solutions, step, NAME_WIDTH, true);
    fputc(' ', solutions);
    cli_print_text(solutions, view->name, LINE_WIDTH, true);
    fputc(' ', solutions);
    if (length > 0)
        fprintf(solutions, "a solution of P4.2 outside Kin: |x'| < 1 on %.4g m", length);
    else
        fputs("a solution of P3.1", solutions);
    fprintf(solutions, ", %s\n",
            line->places == CPS_PLACES_UNIQUE ? "the only one" : "one of many places");
}

/* A free point whose forces do not balance at any of the places tried. */
static void print_unbalanced(FILE *out, const char *name, const CpsPointReport *point,
                             const char *advice) {
    const double *f = point->residual;
    fputs("point ", out);
    cli_print_text(out, name, 80, false);
    fprintf(out,
            ": no place found where the forces on it balance (%.4g N are left after "
            "%d trials)%s\n",
            sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]), point->trial_count, advice);
}

/* What to do about such a point in a step in time: has it an inertia of its own, or that of a line
 * that ends there? */
static const char *advice_for(const CpsScene *scene, const CpsEvolution *evolution, int point) {
    if (!(cps_evolution_pace(evolution).length > 0) || scene->point[point].inertia > 0) return "";
    for (int i = 0; i < scene->line_count; ++i)
        for (int e = 0; e < 2; ++e)
            if (scene->line[i].end[e].kind == CPS_END_KIND_POINT &&
                scene->line[i].end_point[e] == point && !scene->line[i].quasi_static)
                return "";
    return "; it has no 'inertia' to move with: give it one";
}

/* An anchor that has given way, or is beyond its limits. */
static void print_anchor(FILE *table, const CpsPoint *point, const CpsPointReport *at) {
    const double *d = at->drag, drag = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const bool over = at->capacity_used > 1 && !point->drags, lifted = at->uplift_used > 1;
    if (drag == 0 && !over && !lifted) return;
    fprintf(table, "%*spoint ", NAME_WIDTH + 1, "");
    cli_print_text(table, point->name, 80, false);
    const char *between = ":";
    if (drag > 0) {
        fprintf(table, "%s drags by %.4g m, %.4g m in all", between, drag, at->dragged);
        between = ",";
    }
    if (over) {
        fprintf(table, "%s %.4g times its holding capacity", between, at->capacity_used);
        between = ",";
    }
    if (lifted) fprintf(table, "%s %.4g times its uplift limit", between, at->uplift_used);
    fputc('\n', table);
}

/* A free body whose forces and moments do not balance in any of the poses tried. */
static void print_unbalanced_body(FILE *out, const char *name, const CpsBodyReport *body) {
    const double *f = body->residual, *m = &body->residual[3];
    fputs("body ", out);
    cli_print_text(out, name, 80, false);
    fprintf(out,
            ": no pose found where the forces and moments on it balance (%.4g N and %.4g N m are "
            "left after %d trials)\n",
            sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]),
            sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]), body->trial_count);
}

/* A nanometre, or a billionth of a degree, is rounding. */
static double tidy(double x) { return fabs(x) < 1e-9 ? 0 : x; }

/* Is there a proof that a line at the point has no equilibrium? */
static bool has_proof(const CpsScene *scene, const CpsEvolution *evolution, int point) {
    for (int i = 0; i < scene->line_count; ++i)
        for (int e = 0; e < 2; ++e)
            if (scene->line[i].end[e].kind == CPS_END_KIND_POINT &&
                scene->line[i].end_point[e] == point &&
                cps_outcome_is_final(cps_evolution_line_report(evolution, i).outcome))
                return true;
    return false;
}

/* Has no place been found for a point, though there is no such proof? The same of a body. */
static bool is_unbalanced(const CpsScene *scene, const CpsEvolution *evolution, int point) {
    return !cps_evolution_point_report(evolution, point).has_place &&
           !has_proof(scene, evolution, point);
}
static bool is_unbalanced_body(const CpsScene *scene, const CpsEvolution *evolution, int body) {
    if (cps_evolution_body_report(evolution, body).has_place) return false;
    for (int i = 0; i < scene->point_count; ++i)
        if (scene->point[i].kind == CPS_POINT_KIND_ON_BODY && scene->point[i].body == body &&
            has_proof(scene, evolution, i))
            return false;
    return true;
}

/* The pose of a body, and what is to be said of it. */
static void print_body(FILE *table, const char *name, const CpsBodyReport *body,
                       bool is_unbalanced) {
    static const double DEGREES = 57.29577951308232;
    const double *x = body->position;
    double angle[3], heel;
    cps_body_angles(body, angle, &heel);
    if (!body->has_place && !is_unbalanced) return;
    fprintf(table, "%*s", NAME_WIDTH + 1, "");
    if (is_unbalanced) {
        print_unbalanced_body(table, name, body);
        return;
    }
    fputs("body ", table);
    cli_print_text(table, name, 80, false);
    fprintf(table, ": at (%.6g, %.6g, %.6g) m, roll %.4g, pitch %.4g, yaw %.4g degrees", tidy(x[0]),
            tidy(x[1]), tidy(x[2]), tidy(DEGREES * angle[0]), tidy(DEGREES * angle[1]),
            tidy(DEGREES * angle[2]));
    const double *f = body->lines, size = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    for (int a = 0; a < 3; ++a)
        fprintf(table, "%s%.6g", a == 0 ? ", lines pull by (" : ", ",
                fabs(f[a]) < 1e-9 * size ? 0 : f[a]);
    fprintf(table, ") N%s\n", body->is_stable ? "" : "; not stable");
}

static void print_rows(FILE *table, FILE *solutions, const CpsScene *scene,
                       const CpsEvolution *evolution) {
    const CpsStepReport step = cps_evolution_report(evolution);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        const CpsCertificate *certificate = &line.certificate;
        cli_print_text(table, i == 0 ? step.name : "", NAME_WIDTH, true);
        fputc(' ', table);
        cli_print_text(table, cps_evolution_line_view(evolution, i).name, LINE_WIDTH, true);
        fprintf(table, " %-15s %8d %4d %9.1e %12.6g %12.6g", cps_outcome_name(line.outcome),
                line.substep_count, line.iteration_count,
                certificate->scale > 0 ? certificate->gap / certificate->scale : certificate->gap,
                shown_tension(&line, CPS_END_A), shown_tension(&line, CPS_END_B));
        const bool solved = line.outcome == CPS_OUTCOME_SOLVED || line.outcome == CPS_OUTCOME_TAUT;
        print_error(table, solved && certificate->has_tension_bound, certificate->tension_bound);
        print_error(table, solved && line.has_tension_mesh, line.tension_mesh);
        fprintf(table, " %10.4g ", line.grounded);
        if (line.has_slipping)
            fprintf(table, "%10.4g", line.slipping);
        else
            fprintf(table, "%10s", "-");
        fprintf(table, " %10.4g\n", line.slack);
        for (int e = 0; e < 2; ++e)
            print_range(table, "AB"[e], &line.end[e].range, certificate->largest_force);
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        if (solved && scene->friction_policy == CPS_FRICTION_POLICY_FROZEN && view.one_plane)
            print_solution(solutions, step.name, &line, &view);
    }
    for (int i = 0; i < cps_evolution_point_count(evolution); ++i) {
        const CpsPointReport point = cps_evolution_point_report(evolution, i);
        if (point.has_place) print_anchor(table, &scene->point[i], &point);
        if (!is_unbalanced(scene, evolution, i)) continue;
        fprintf(table, "%*s", NAME_WIDTH + 1, "");
        print_unbalanced(table, scene->point[i].name, &point, "");
    }
    for (int i = 0; i < cps_evolution_body_count(evolution); ++i) {
        const CpsBodyReport body = cps_evolution_body_report(evolution, i);
        print_body(table, scene->body[i].name, &body, is_unbalanced_body(scene, evolution, i));
    }
}

/* print that the ends are too far apart, or that an element is too long to go round an obstacle */
static void print_shortfall(const CpsScene *scene, int index, const CpsLineReport *line) {
    const double *d = line->proof;
    const CpsEnd *end = scene->line[index].end;
    const bool at_point =
        end[CPS_END_A].kind == CPS_END_KIND_POINT || end[CPS_END_B].kind == CPS_END_KIND_POINT;
    if (at_point && !line->has_proof_obstacle) {
        fprintf(stderr,
                "no configuration: the inextensible lines that meet at points are too short (by "
                "%.6g m for the self-stress that is (%.4g, %.4g, %.4g) in this line)",
                line->proof_length, d[0], d[1], d[2]);
        return;
    }
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) {
        fputs("no configuration: an element is too long to go round obstacle ", stderr);
        cli_print_text(stderr, scene->obstacle[line->proof_obstacle].name, 80, false);
        fprintf(stderr,
                " (wherever its nodes are, it lies %.6g m deeper than a chord may; take shorter "
                "elements there)",
                line->proof_length);
        return;
    }
    if (line->has_proof_plane && line->has_proof_obstacle) {
        fputs("no configuration: the line is caught between obstacles ", stderr);
        cli_print_text(stderr, scene->obstacle[line->proof_obstacle].name, 80, false);
        fputs(" and ", stderr);
        cli_print_text(stderr, scene->obstacle[line->proof_plane].name, 80, false);
        fprintf(stderr, ", and at least %.6g m too short for the way between them",
                line->proof_length);
        return;
    }
    fprintf(stderr, "%s (by %.6g m along (%.4g, %.4g, %.4g)", cps_outcome_text(line->outcome),
            line->proof_length, d[0], d[1], d[2]);
    if (line->has_proof_obstacle) {
        fputs(", the shortest path round obstacle ", stderr);
        cli_print_text(stderr, scene->obstacle[line->proof_obstacle].name, 80, false);
    }
    if (line->has_proof_plane) {
        fputs(", on the free side of obstacle ", stderr);
        cli_print_text(stderr, scene->obstacle[line->proof_plane].name, 80, false);
    }
    fputc(')', stderr);
}

/* Is a step in time not certified though its program is solved? Beside points that may be for
 * their sake. */
static bool is_too_long(const CpsScene *scene, const CpsEvolution *evolution, int i) {
    const CpsLineReport line = cps_evolution_line_report(evolution, i);
    return line.outcome == CPS_OUTCOME_STALLED &&
           cps_evolution_line_motion(evolution, i).is_moving && scene->point_count == 0 &&
           line.certificate.gap <= scene->solver.tolerance * line.certificate.scale;
}

/* print that a body is turned in every pose; a line that reports no motion is in its group */
static void report_turning(const CpsScene *scene, const CpsEvolution *evolution, const char *step) {
    for (int i = 0; i < cps_evolution_body_count(evolution); ++i) {
        const CpsBodyReport body = cps_evolution_body_report(evolution, i);
        if (!(body.proof_moment > 0)) continue;
        fputs("capstan: step ", stderr);
        cli_print_text(stderr, step, 80, false);
        fputs(", body ", stderr);
        cli_print_text(stderr, scene->body[i].name, 80, false);
        fprintf(stderr,
                ": no equilibrium: its lines end at one point of it, and in every pose the loads "
                "turn it about the axis (%.4g, %.4g, %.4g) there, by at least %.6g N m\n",
                tidy(body.proof[0]), tidy(body.proof[1]), tidy(body.proof[2]), body.proof_moment);
    }
}

/* print a sentence with the proof for each outcome other than solved */
static void report_outcomes(const CpsScene *scene, const CpsEvolution *evolution) {
    const CpsStepReport step = cps_evolution_report(evolution);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        if (line.outcome == CPS_OUTCOME_SOLVED) continue;
        fputs("capstan: step ", stderr);
        cli_print_text(stderr, step.name, 80, false);
        fputs(", line ", stderr);
        cli_print_text(stderr, cps_evolution_line_view(evolution, i).name, 80, false);
        fputs(": ", stderr);
        if (line.outcome != CPS_OUTCOME_INFEASIBLE) fputs(cps_outcome_text(line.outcome), stderr);
        const double *d = line.proof;
        const CpsCertificate *c = &line.certificate;
        if (line.outcome == CPS_OUTCOME_INFEASIBLE) {
            print_shortfall(scene, i, &line);
        } else if (line.outcome == CPS_OUTCOME_UNBOUNDED && !(line.proof_force > 0)) {
            fputs(" (a body turns for ever)", stderr);
        } else if (line.outcome == CPS_OUTCOME_UNBOUNDED || line.outcome == CPS_OUTCOME_SLIDES) {
            fprintf(stderr, " (%.6g N along (%.4g, %.4g, %.4g))", line.proof_force, d[0], d[1],
                    d[2]);
            if (line.coulomb > 0)
                fprintf(
                    stderr,
                    " with the friction bounds of the reference; these loads press so that mu R, "
                    "%.6g N in all, holds the line: 'friction_policy: consistent' has an "
                    "equilibrium",
                    line.coulomb);
        } else if (line.outcome == CPS_OUTCOME_PASSES) {
            fputs(" (obstacle ", stderr);
            cli_print_text(stderr, scene->obstacle[line.proof_obstacle].name, 80, false);
            fputc(')', stderr);
        } else if (line.outcome == CPS_OUTCOME_MESH_TOO_COARSE)
            warnings_print_bend(&line.bend, scene->obstacle[line.bend.obstacle].name);
        else if (line.outcome != CPS_OUTCOME_TAUT && !(c->scale > 0 && c->largest_force > 0))
            fprintf(stderr, " (gap %.2e J, without any force)", c->gap);
        else if (line.outcome != CPS_OUTCOME_TAUT)
            fprintf(stderr, " (gap %.2e of the scale, force residual %.2e of the largest force)",
                    c->gap / c->scale, c->force_residual / c->largest_force);
        if (is_too_long(scene, evolution, i))
            fputs("; the step is too long: an obstacle, or what slips round it, goes farther in "
                  "it than is told apart from another way; take more steps, or give an 'error'",
                  stderr);
        fputc('\n', stderr);
    }
    for (int i = 0; i < cps_evolution_point_count(evolution); ++i) {
        const CpsPointReport point = cps_evolution_point_report(evolution, i);
        if (!is_unbalanced(scene, evolution, i)) continue;
        fputs("capstan: step ", stderr);
        cli_print_text(stderr, step.name, 80, false);
        fputs(", ", stderr);
        print_unbalanced(stderr, scene->point[i].name, &point, advice_for(scene, evolution, i));
    }
    report_turning(scene, evolution, step.name);
    for (int i = 0; i < cps_evolution_body_count(evolution); ++i) {
        const CpsBodyReport body = cps_evolution_body_report(evolution, i);
        if (!is_unbalanced_body(scene, evolution, i)) continue;
        fputs("capstan: step ", stderr);
        cli_print_text(stderr, step.name, 80, false);
        fputs(", ", stderr);
        print_unbalanced_body(stderr, scene->body[i].name, &body);
        if (!body.is_stable)
            fputs(
                cps_evolution_pace(evolution).length > 0
                    ? "capstan: in time a body turns by less than half a turn in a step: take "
                      "shorter steps\n"
                    : "capstan: where nothing holds a body in a direction, as about the axis of a "
                      "single line, give that direction as 'fixed'\n",
                stderr);
    }
}

static int exit_code(CpsOutcome worst) {
    switch (worst) {
    case CPS_OUTCOME_SOLVED:
    case CPS_OUTCOME_TAUT: return EXIT_OK;
    case CPS_OUTCOME_STALLED:
    case CPS_OUTCOME_ITERATION_LIMIT:
    case CPS_OUTCOME_MESH_TOO_COARSE:
    case CPS_OUTCOME_PASSES: return EXIT_NOT_CERTIFIED;
    case CPS_OUTCOME_UNBOUNDED:
    case CPS_OUTCOME_INFEASIBLE:
    case CPS_OUTCOME_SLIDES: return EXIT_NO_SOLUTION;
    }
    return EXIT_NOT_CERTIFIED;
}

static CpsResultsOptions wanted_results(const CliOptions *options) {
    CpsResultsOptions wanted = cps_results_options_default();
    wanted.no_paraview = options->no_paraview;
    wanted.stiffness = options->stiffness;
    wanted.out_table = options->out_table;
    wanted.sync_at_end = options->sync && strcmp(options->sync, "end") == 0;
    wanted.fields = options->fields;
    return wanted;
}

static void print_utilisation(const WorstCase *most) {
    if (most->steps == 0) return;
    printf("\nutilisation  %.3g of the breaking load at most: step ", most->value);
    cli_print_text(stdout, most->step, 80, false);
    fputs(", line ", stdout);
    cli_print_text(stdout, most->line, 80, false);
    printf(", at %.6g m\n", most->of);
}

/* A run: its scene, its results and its output. */
typedef struct Run {
    const CpsScene *scene;
    CpsEvolution *evolution;
    CpsResults *results;
    CpsJournal *journal;
    Progress progress;
    Warnings warnings;
    Extremes extremes;
    EndTable ends;
    Energy energy;
    FILE *table, *solutions;
    CpsOutcome worst;
    bool refused; /* a step could not begin; the steps before it are kept */
} Run;

/* Say which line has parted, where, and at what tension. */
static void print_break(FILE *out, const CpsEvolution *evolution) {
    const CpsBreak parted = cps_evolution_break(evolution);
    if (!parted.is_break) return;
    fprintf(out,
            "line %s parts at end %c: %.6g N at %.6g m, above its break_at of %.6g N (step %d)\n",
            cps_evolution_line_view(evolution, parted.line).name,
            parted.end == CPS_END_A ? 'A' : 'B', parted.tension, parted.arc_length, parted.break_at,
            cps_evolution_report(evolution).step_count - 1);
}

/* Add the present step of the evolution to the results and the table. */
static CpsStatus keep_step(Run *run, CpsError *err) {
    const CpsStatus status = cps_results_append(run->results, run->evolution, err);
    if (status) return status;
    const CpsStepReport report = cps_evolution_report(run->evolution);
    run->progress.steps = cps_evolution_step_count(run->evolution); /* breaks add to them */
    progress_time(&run->progress, cps_evolution_time(run->evolution));
    progress_step(&run->progress, report.step_count, report.name);
    warnings_note_step(&run->warnings, run->scene, run->evolution);
    energy_note_step(&run->energy, run->evolution);
    if (!extremes_note_step(&run->extremes, run->evolution)) {
        *err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return CPS_ERR_MEMORY;
    }
    const int steps = cps_evolution_step_count(run->evolution);
    if (cli_is_shown(run->scene, steps, report.step_count - 1) ||
        report.outcome != CPS_OUTCOME_SOLVED || cli_interrupted() ||
        cps_evolution_break(run->evolution).is_break) {
        print_rows(run->table, run->solutions, run->scene, run->evolution);
        end_table_add(&run->ends, run->evolution);
    }
    print_break(run->solutions, run->evolution);
    if (report.outcome != CPS_OUTCOME_SOLVED) {
        progress_end(&run->progress);
        report_outcomes(run->scene, run->evolution);
    }
    run->worst = cps_outcome_worse(run->worst, report.outcome);
    return CPS_OK;
}

/* Restore the steps of an earlier run into the same directory from its journal. */
static CpsStatus replay(Run *run, CpsError *err) {
    int steps = 0;
    for (bool found = true; found;) {
        CpsStatus status = cps_journal_next(run->journal, run->evolution, &found, err);
        if (!status && found) status = keep_step(run, err);
        if (status) return status;
        steps += found;
    }
    progress_end(&run->progress);
    fprintf(stderr, "capstan: %d of %d steps were done before\n", steps,
            cps_evolution_step_count(run->evolution));
    return CPS_OK;
}

/* Solve all steps, or until a signal. */
static CpsStatus take_steps(Run *run, CpsError *err) {
    progress_computes(&run->progress, cps_evolution_report(run->evolution).step_count);
    while (cps_evolution_remaining_count(run->evolution) > 0 && !cli_interrupted()) {
        CpsStatus status = cps_evolution_step(run->evolution, err);
        if (status == CPS_ERR_INTERRUPTED) break;
        run->refused = status != CPS_OK;
        if (!status) status = cps_journal_append(run->journal, run->evolution, err);
        if (!status) status = keep_step(run, err);
        if (status) return status;
    }
    progress_end(&run->progress);
    if (!run->progress.quiet) {
        coarse_steps_warn(run->scene);
        warnings_print(&run->warnings);
    }
    return CPS_OK;
}

/* The results are complete without the journal, but the next run would take it for that of an
 * interrupted one. */
static void remove_journal(CpsJournal *journal) {
    CpsError err;
    if (cps_journal_remove(journal, &err) == CPS_OK) return;
    fputs("capstan: the run is complete, but the next one into this directory needs --force: ",
          stderr);
    cli_print_text(stderr, err.message, INT_MAX, false);
    fputc('\n', stderr);
}

/* Whether a signal has ended the run; one that came after the last step has not. */
static bool was_stopped(const CpsEvolution *evolution) {
    return cli_interrupted() && cps_evolution_remaining_count(evolution) > 0;
}

/* [s] How long the history is in simulated time. */
static double simulated_time(const CpsScene *scene) {
    double sum = 0;
    for (int i = 0; i < scene->stage_count; i++) sum += scene->stage[i].duration;
    return sum;
}

/* Open the results, solve the steps, finish. */
static CpsStatus execute(Run *run, const char *directory, const CliOptions *options,
                         CpsError *err) {
    const double begun = cli_now();
    CpsStatus status = cli_evolution_create(run->scene, &run->evolution, err);
    const CpsResultsOptions wanted = wanted_results(options);
    if (!status)
        status =
            cps_results_open(directory, run->scene, run->evolution, &wanted, &run->results, err);
    const CpsJournalMode journal = options->resume      ? CPS_JOURNAL_RESUME
                                   : options->overwrite ? CPS_JOURNAL_REPLACE
                                                        : CPS_JOURNAL_NEW;
    if (!status) status = cps_journal_open(directory, run->evolution, journal, &run->journal, err);
    if (status) return status;
    if (wanted.sync_at_end) cps_journal_sync_late(run->journal);
    run->progress = progress_begin(cps_evolution_step_count(run->evolution), options->quiet);
    progress_in_time(&run->progress, simulated_time(run->scene));
    if (options->resume) status = replay(run, err);
    if (!status) status = take_steps(run, err);
    progress_end(&run->progress);
    const double wall = cli_now() - begun;
    CpsError none;
    if (run->refused) /* the error reported is the one that ended the run */
        cps_results_finish(run->results, wall, &none);
    if (!status) status = cps_results_finish(run->results, wall, err);
    if (!status && cps_evolution_remaining_count(run->evolution) == 0)
        remove_journal(run->journal);
    else if (run->journal && wanted.sync_at_end)
        status = status ? status : cps_journal_sync(run->journal, err);
    if (status || !options->json) return status;
    status = cps_results_write_summary(run->results, wall, stdout, err);
    if (status == CPS_ERR_IO) snprintf(err->file, sizeof err->file, "standard output");
    return status;
}

static void print_where(const char *directory, const CpsEvolution *evolution,
                        const CliOptions *options) {
    const int steps = cps_evolution_step_count(evolution),
              left = cps_evolution_remaining_count(evolution);
    if (was_stopped(evolution))
        fprintf(stderr,
                "capstan: stopped by a signal after %d of %d steps; --resume goes on from there\n",
                steps - left, steps);
    printf("\nbound     rms error of the tension that the certificate leaves possible, in this "
           "step's own problem: it says nothing of the\n"
           "          mesh, nor of what earlier steps have left. mesh: estimated error by the "
           "elements' length, of the step as well\n");
    const bool bodies = cps_evolution_body_count(evolution) > 0;
    const bool points = cps_evolution_point_count(evolution) > 0;
    cli_printf(stdout, "\nresults   %s: summary.json, history.csv, result.nc%s%s%s%s%s%s%s\n",
               directory, options->out_table ? ", history.out" : "", points ? ", points.csv" : "",
               bodies ? ", bodies.csv" : "", options->stiffness ? ", stiffness.csv" : "",
               options->stiffness && points ? ", point-stiffness.csv" : "",
               options->stiffness && bodies ? ", body-stiffness.csv" : "",
               options->no_paraview ? "" : ", result.pvd (ParaView)");
    cli_printf(stdout,
               "pictures  %s: plan.svg, elevation.svg, tension.svg, history.svg, step-*.svg; "
               "planes.svg of up to 12 lines at points; "
               "loop-*.svg where a held end goes round a closed cycle\n",
               directory);
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const double *o = view.origin;
    if (o[0] != 0 || o[1] != 0 || o[2] != 0)
        printf("origin    places in result.nc, the ParaView files and pictures are measured from "
               "(%.15g, %.15g, %.15g) m\n",
               o[0], o[1], o[2]);
}

static int run(const CpsScene *scene, const char *directory, const CliOptions *options) {
    CpsError err;
    char *text = NULL, *said = NULL;
    size_t size = 0, length = 0;
    Run run = {.scene = scene,
               .table = open_memstream(&text, &size),
               .solutions = open_memstream(&said, &length)};
    if (!end_table_begin(&run.ends) || !run.table || !run.solutions) {
        end_table_free(&run.ends);
        if (run.table) fclose(run.table);
        if (run.solutions) fclose(run.solutions);
        free(text);
        free(said);
        fprintf(stderr, "capstan: out of memory\n");
        return EXIT_LIMIT;
    }
    print_head(run.table);
    const CpsStatus status = execute(&run, directory, options, &err);
    const bool table = fclose(run.table) == 0, solutions = fclose(run.solutions) == 0;
    const bool whole = table && solutions;
    if (whole && !status && !options->json && !options->quiet) {
        fwrite(text, 1, size, stdout);
        end_table_print(&run.ends, stdout);
        if (length > 0) printf("\n%s", said);
        extremes_print(&run.extremes, run.scene, run.evolution, stdout);
        energy_print(&run.energy, stdout);
        print_utilisation(&run.warnings.utilisation);
        print_where(directory, run.evolution, options);
    }
    const int code = status                       ? cli_report(&err)
                     : was_stopped(run.evolution) ? 128 + cli_interrupted()
                                                  : exit_code(run.worst);
    free(text);
    free(said);
    end_table_free(&run.ends);
    extremes_free(&run.extremes);
    cps_journal_destroy(run.journal);
    cps_results_destroy(run.results);
    cps_evolution_destroy(run.evolution);
    return code;
}

/* The number of threads that --threads asks for. False after a message. */
static bool read_threads(const char *text, int *threads) {
    char *end = NULL;
    errno = 0;
    const long count = strtol(text, &end, 10);
    if (end != text && *end == '\0' && errno == 0 && count >= 1 && count <= CPS_MAX_THREADS) {
        *threads = (int)count;
        return true;
    }
    cli_printf(stderr, "capstan run: --threads '%.40s': expected a whole number, 1 to %d\n", text,
               (int)CPS_MAX_THREADS);
    return false;
}

/* Change the scene according to the command line. False after a message. */
static bool adjust(CpsScene *scene, const CliOptions *options) {
    if (options->threads && !read_threads(options->threads, &scene->solver.thread_count))
        return false;
    if (!options->path_tolerance) return true;
    char *end = NULL;
    errno = 0;
    const double tolerance = scene->solver.path_tolerance = strtod(options->path_tolerance, &end);
    const bool within = tolerance == 0 || (tolerance >= 1e-9 && tolerance <= 1);
    if (end != options->path_tolerance && *end == '\0' && errno == 0 && within) return true;
    cli_printf(stderr, "capstan run: --path-tolerance '%s': expected a number, 0 or 1e-9 to 1\n",
               options->path_tolerance);
    return false;
}

/* Check --method, which may be unknown or exclude other options. False after a message. */
static bool is_sound(const CliOptions *options, bool *regularized) {
    const CpsResultsOptions wanted = wanted_results(options);
    CpsError err;
    *regularized = options->method && strcmp(options->method, "regularized") == 0;
    if (options->method && !*regularized && strcmp(options->method, "exact") != 0)
        cli_printf(stderr, "capstan run: --method: found '%.40s', expected exact or regularized\n",
                   options->method);
    else if (!*regularized && regularized_options_given(options))
        fputs("capstan run: --lambda, --n and --delta are those of --method regularized\n", stderr);
    else if (*regularized && (options->resume || options->path_tolerance || options->no_paraview ||
                              options->stiffness || options->out_table || options->fields ||
                              options->sync || options->threads))
        fputs("capstan run: --method regularized: takes the steps as given, without "
              "--path-tolerance, "
              "--threads and --resume, and writes no fields and no stiffness\n",
              stderr);
    else if (options->sync && strcmp(options->sync, "step") != 0 &&
             strcmp(options->sync, "end") != 0)
        cli_printf(stderr, "capstan run: --sync: found '%.40s', expected step or end\n",
                   options->sync);
    else if (cps_results_check_options(&wanted, &err) != CPS_OK)
        cli_printf(stderr, "capstan run: --%s\n", err.message);
    else
        return true;
    return false;
}

int cmd_run(int argc, char **argv) {
    CliOptions options;
    bool regularized;
    if (!cli_parse(argc, argv, FOR_RUN, "SCENE.yaml", &options) ||
        !is_sound(&options, &regularized))
        return EXIT_USAGE;
    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.operand, NULL, &file, &err) != CPS_OK) return cli_report(&err);

    /* while a scene is read there is nothing to keep, so a signal ends the program at once */
    cli_catch_signals();
    CpsScene scene = *cps_scene_file_scene(file);
    if (!adjust(&scene, &options)) {
        cps_scene_file_destroy(file);
        return EXIT_USAGE;
    }
    if (regularized && scene.point_count > 0) {
        fputs("capstan run: --method regularized: the scene has points where lines meet, which the "
              "method of 1990 does not know\n",
              stderr);
        cps_scene_file_destroy(file);
        return EXIT_INPUT;
    }
    int code;
    const CpsResultsKind kind = regularized ? CPS_RESULTS_KIND_REGULARIZED : CPS_RESULTS_KIND_RUN;
    char *directory = cli_destination(&options, kind, scene.line_count, &code);
    if (directory)
        code = regularized ? run_regularized(&scene, directory, &options)
                           : run(&scene, directory, &options);
    free(directory);
    cps_scene_file_destroy(file);
    return code;
}
