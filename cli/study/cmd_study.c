/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan study: solve a scene up to one of its steps, then that step once more by the methods of
 * Souza de Cursi's paper of 1990: regularised, with h, lambda, n and delta going to their limits;
 * and to first order. Prints tables and a judgement, draws pictures. Or it computes all solutions
 * of the step: configurations with its slack laid out, and the judgement of a given
 * configuration.
 *
 * The first SIGINT or SIGTERM ends the present computation and keeps the results so far; the second
 * ends the program at once. Where nothing is written, in a judgement, the first one does. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "commands.h"
#include "destination.h"
#include "options.h"
#include "printable.h"
#include "progress.h"
#include "run/regularized_options.h"
#include "run/regularized_run.h"
#include "signals.h"
#include "study/study_methods.h"
#include "study/study_solutions.h"

/* ---- the step ---- */

static bool is_placed(const CpsScene *scene) {
    bool placed = false;
    for (int i = 0; i < scene->line_count; ++i)
        placed |= scene->line[i].start.kind == CPS_START_STATIC;
    return placed;
}

/* Whether `asked` is the name of the stage, which means its last step, or of one of its steps,
 * "pull 3/10". Returns the step within the stage from 1, or 0. */
static int step_of_stage(const CpsStage *stage, const char *asked) {
    const size_t length = strlen(stage->name);
    int k, n;
    char end;
    if (strcmp(stage->name, asked) == 0) return stage->step_count;
    if (strncmp(asked, stage->name, length) != 0 ||
        sscanf(asked + length, " %9d/%9d%c", &k, &n, &end) != 2)
        return 0;
    return n == stage->step_count && n > 1 && k >= 1 && k <= n ? k : 0;
}

/* The number of the step asked for, from 1 as a run counts them: by its name, which must be unique,
 * or by that number; without one the first step that is not statically placed. 0 after a
 * message. */
static int find_step(const CpsScene *scene, const char *asked) {
    int before = is_placed(scene) ? 1 : 0, found = 0, number = 0;
    char end;
    if (!asked) return before + 1;
    if (before && strcmp(asked, "static") == 0) found = 1;
    for (int s = 0; s < scene->stage_count; before += scene->stage[s++].step_count) {
        const int within = step_of_stage(&scene->stage[s], asked);
        if (within > 0 && found > 0) {
            cli_printf(stderr,
                       "capstan study: --step: '%.80s' is the name of step %d and of step %d: give "
                       "the number\n",
                       asked, found, before + within);
            return 0;
        }
        if (within > 0) found = before + within;
    }
    if (scene->stage_count == 0 && before == 0 && strcmp(asked, "equilibrium") == 0) found = 1;
    const int steps = before > 0 ? before : 1;
    if (found == 0 && sscanf(asked, "%9d%c", &number, &end) == 1 && number >= 1 && number <= steps)
        found = number;
    if (found == 0)
        cli_printf(stderr,
                   "capstan study: --step: found '%.80s', expected the name of a step, 'capstan "
                   "run' lists them, or a number from 1 to %d\n",
                   asked, steps);
    return found;
}

/* Solve up to a step, counted from 1. Returns the exit code, EXIT_OK when that step is solved. */
static int reach_step(CpsEvolution *evolution, int number) {
    CpsError err;
    while (cps_evolution_remaining_count(evolution) > 0 && !cli_interrupted()) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) return cli_report(&err);
        const CpsStepReport step = cps_evolution_report(evolution);
        if (step.outcome != CPS_OUTCOME_SOLVED) {
            fputs("capstan study: step ", stderr);
            cli_print_text(stderr, step.name, 80, false);
            fprintf(stderr, ": %s; there is nothing to compare with\n",
                    cps_outcome_text(step.outcome));
            return cps_outcome_is_final(step.outcome) ? EXIT_NO_SOLUTION : EXIT_NOT_CERTIFIED;
        }
        if (step.step_count == number) return EXIT_OK;
    }
    if (cli_interrupted()) return 128 + cli_interrupted();
    fprintf(stderr, "capstan study: the scene has no step but a static one: give it a history\n");
    return EXIT_USAGE;
}

/* the line asked for, the first line when `asked` is NULL; -1 after a message */
static int find_line(const CpsEvolution *evolution, const char *asked) {
    if (!asked) return 0;
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i)
        if (strcmp(cps_evolution_line_view(evolution, i).name, asked) == 0) return i;
    cli_printf(stderr,
               "capstan study: --line: found '%.80s', expected the name of a line of the scene\n",
               asked);
    return -1;
}

/* ---- output ---- */

typedef struct StudyPrinter {
    Progress progress;
    CpsRegularizedStep step;
    bool converged; /* whether every solution so far has converged */
} StudyPrinter;

static void print_rate(bool known, double rate) {
    if (known)
        printf(" %5.2f", rate);
    else
        printf(" %5s", "-");
}

static void print_row(const CpsStudyRow *row, const CpsRegularizedStep *step) {
    const CpsRegularizedReport *r = &row->report;
    const CpsRegularizedParameters *p = &row->parameters;
    const int cells = p->cell_count > 0 ? p->cell_count : step->element_count;
    printf("%-6s %9.3g %9.2g %9.2g %9.2g %5d %11.3e", cps_study_stage_name(row->stage),
           step->length / cells, p->penalty, p->stiffness, p->delta, r->iteration_count,
           r->energy_error);
    print_rate(row->has_rate_energy, row->rate_energy);
    printf(" %10.2e", r->tension_rms);
    print_rate(row->has_rate_tension, row->rate_tension);
    printf(" %9.1e %9.1e %9.1e %9.1e%s\n", r->compression, r->penetration, r->creep,
           r->friction_excess, r->converged ? "" : "  not converged");
}

static void print_head(void) {
    printf("%-6s %9s %9s %9s %9s %5s %11s %5s %10s %5s %9s %9s %9s %9s\n", "stage", "h", "lambda",
           "1/n", "delta", "iter", "energy", "rate", "tension", "rate", "push", "sunk", "creep",
           "uncarried");
    printf("%-6s %9s %9s %9s %9s %5s %11s %5s %10s %5s %9s %9s %9s %9s\n", "", "m", "N/m2", "N m2",
           "m", "", "J", "", "N rms", "", "N", "m", "m", "N");
}

static bool on_row(void *user, const CpsStudyRow *row, int done, int of) {
    StudyPrinter *printer = user;
    printer->progress.steps = of;
    progress_step(&printer->progress, done, cps_study_stage_name(row->stage));
    printer->converged &= row->report.converged;
    return !cli_interrupted();
}

static void print_force(const CpsFirstOrderReport *r, const char *what) {
    const double *f = r->unbalanced;
    printf("    (%.6g, %.6g, %.6g) N at a = %.6g m %s\n", f[0], f[1], f[2], r->unbalanced_arc,
           what);
}

static void print_outcome(const CpsFirstOrderReport *r, const char *contact) {
    printf("  %s: %s\n", contact, cps_first_order_outcome_text(r->outcome));
    switch (r->outcome) {
    case CPS_FIRST_ORDER_OUTCOME_SHORTENS:
        printf("    t_R.u' = %.6g at a = %.6g m; (86) fails on %.6g m of %.6g m without tension in "
               "the reference\n",
               r->least_strain, r->least_strain_arc, r->shortened, r->slack);
        break;
    case CPS_FIRST_ORDER_OUTCOME_UNBALANCED: print_force(r, "is carried by nothing, (89)"); break;
    case CPS_FIRST_ORDER_OUTCOME_MESH:
        print_force(r, "does not pull along the slack end, (87)");
        break;
    case CPS_FIRST_ORDER_OUTCOME_SOLVED: break;
    case CPS_FIRST_ORDER_OUTCOME_UNDECIDED:
        printf("    forces still fail by %.4g N after %d rounds\n", r->residual, r->round_count);
        break;
    }
    if (r->outcome == CPS_FIRST_ORDER_OUTCOME_SOLVED || r->outcome == CPS_FIRST_ORDER_OUTCOME_MESH)
        printf("    x_R + u is at most %.4g m from the solution of P2.1; forces fail by at most "
               "%.2g N\n",
               r->against_step, r->residual);
}

/* P10.1 with the step's own contact, and with contact at every node where that gives another
 * answer */
static void print_first_order(const CpsFirstOrder *const *solution) {
    const CpsFirstOrderReport paper = cps_first_order_report(solution[0]),
                              reached = cps_first_order_report(solution[1]);
    const CpsFirstOrderView a = cps_first_order_view(solution[0]),
                            b = cps_first_order_view(solution[1]);
    double apart = 0;
    for (int k = 0; k < 3 * (a.element_count + 1); ++k)
        apart = fmax(apart, fabs(a.displacement[k] - b.displacement[k]));
    printf("\nconsistent first-order problem P10.1\n");
    print_outcome(&paper, "C of (77), u.n >= 0 where x_R touches");
    if (paper.outcome != reached.outcome || apart > 1e-6 * a.arc_length[a.element_count])
        print_outcome(&reached,
                      "every node kept out, (16), as the step with 'contact_policy: reached' does");
    if (paper.outside > 0)
        printf("  (on %.6g m the reference has |x_R'| < 1, outside Kin: taken as slack and just "
               "straight)\n",
               paper.outside);
}

static void tell(const CpsStudy *study, const CpsFirstOrder *const *first_order,
                 const CpsLineView *view, const StudyPrinter *printer, double tolerance,
                 const char *directory) {
    printf("exact: J** + j = %.10g J on %d elements; everything below is against it\n\n",
           printer->step.energy, printer->step.element_count);
    print_head();
    for (int i = 0; i < cps_study_row_count(study); ++i) {
        const CpsStudyRow row = cps_study_row(study, i);
        print_row(&row, &printer->step);
    }
    print_first_order(first_order);
    study_print_slack(view, tolerance);
    cli_printf(
        stdout,
        "\nresults   %s: study.csv, first-order.csv\npictures  %s: study.svg, first-order.svg, "
        "relaxed.svg\n",
        directory, directory);
}

/* ---- the whole study ---- */

static int study_step(const CpsLineView *view, const char *title, const char *directory,
                      const CliOptions *options) {
    CpsError err;
    CpsRegularized *regularized = NULL;
    CpsStudy *study = NULL;
    CpsFirstOrder *first_order[2] = {NULL, NULL};
    StudyPrinter printer = {.converged = true};
    RegularizedOptions given;
    if (!regularized_options_read(options, "study", &given)) return EXIT_USAGE;
    CpsStatus status = cps_regularized_create(view, &regularized, &err);
    if (status == CPS_OK) {
        const CpsRegularizedParameters to = regularized_options_apply(&given, regularized);
        const CpsStudyOptions how = cps_study_options_to(regularized, &to);
        printer.step = cps_regularized_step(regularized);
        printer.progress = progress_begin(1, options->quiet);
        status = cps_study_run(regularized, &how, on_row, &printer, &study, &err);
        progress_end(&printer.progress);
    }
    if (status == CPS_OK)
        status = cps_first_order_solve(regularized, CPS_FIRST_ORDER_CONTACT_REFERENCE,
                                       &first_order[0], &err);
    if (status == CPS_OK)
        status = cps_first_order_solve(regularized, CPS_FIRST_ORDER_CONTACT_REACHED,
                                       &first_order[1], &err);
    if (status == CPS_OK) {
        CpsStudyFiles files = cps_study_files_default();
        files.title = title;
        files.regularized = regularized;
        files.study = study;
        files.first_order = first_order[0];
        status = cps_study_write(directory, &files, &err);
    }
    if (status == CPS_OK && !options->quiet)
        tell(study, (const CpsFirstOrder *const *)first_order, view, &printer,
             study_find_tolerance(options->tolerance), directory);
    const int code = status != CPS_OK    ? cli_report(&err)
                     : cli_interrupted() ? 128 + cli_interrupted()
                     : printer.converged ? EXIT_OK
                                         : EXIT_NOT_CERTIFIED;
    if (status != CPS_OK && view->compliance == 0)
        fputs("capstan study: --complete and --judge take inextensible lines too\n", stderr);
    for (int k = 0; k < 2; ++k) cps_first_order_destroy(first_order[k]);
    cps_study_destroy(study);
    cps_regularized_destroy(regularized);
    return code;
}

/* Print the friction bounds with which the solutions are judged. */
static void print_bounds(const CpsScene *scene) {
    puts(scene->friction_policy == CPS_FRICTION_POLICY_CONSISTENT
             ? "friction_policy: consistent, A = mu R at x; P4.2 and P3.1 are those with this A"
             : "friction_policy: frozen, A = mu R_R of the reference, (78)");
}

/* The methods of the paper use the history with frozen friction; configurations are judged and
 * completed with the scene's own friction. */
static int study(const CpsScene *given, const char *directory, const CliOptions *options) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    const bool solutions = options->judge || options->complete;
    const CpsScene scene = solutions ? *given : regularized_scene(given);
    const int number = find_step(given, options->step);
    if (number == 0) return EXIT_USAGE;
    if (cli_evolution_create(&scene, &evolution, &err) != CPS_OK) return cli_report(&err);
    const int line = find_line(evolution, options->line);
    int code = line < 0 ? EXIT_USAGE : reach_step(evolution, number);
    if (code == EXIT_OK) {
        char title[256];
        const CpsStepReport step = cps_evolution_report(evolution);
        const CpsLineView view = cps_evolution_line_view(evolution, line);
        const double tolerance = study_find_tolerance(options->tolerance);
        const int substeps = cps_evolution_line_report(evolution, line).substep_count;
        if (substeps > 1)
            fprintf(
                stderr,
                "capstan study: the step was taken in %d substeps: this is about the last one\n",
                substeps);
        snprintf(title, sizeof title, "%.120s: %.60s, %.60s", scene.title ? scene.title : "capstan",
                 step.name, view.name);
        if (!options->quiet) {
            cli_print_text(stdout, title, 240, false);
            putchar('\n');
            if (solutions) {
                print_bounds(given);
            } else {
                regularized_print_friction(given);
                regularized_print_steps(given);
            }
        }
        if (options->judge)
            code = study_judge(&view, options->judge, tolerance, options->quiet);
        else if (options->complete)
            code = study_complete(&view, study_find_completion(options->complete), tolerance, title,
                                  directory, options->quiet);
        else
            code = study_step(&view, title, directory, options);
    }
    cps_evolution_destroy(evolution);
    return code;
}

/* exactly one of the possible tasks must be asked for */
static bool is_sound(const CliOptions *options) {
    if (options->history + (options->judge != NULL) + (options->complete != NULL) > 1) {
        fputs(
            "capstan study: found two of --history, --judge and --complete, expected one at most\n",
            stderr);
        return false;
    }
    if (regularized_options_given(options) &&
        (options->judge || options->complete || (options->history && options->h))) {
        fputs("capstan study: --lambda, --n and --delta are those of the method of 1990, in a step "
              "or with --history; --h is that of a step\n",
              stderr);
        return false;
    }
    if (options->judge && strcmp(options->judge, "-") == 0 && strcmp(options->operand, "-") == 0) {
        fputs("capstan study: found '-' for the scene and for --judge, expected one of them from "
              "standard input\n",
              stderr);
        return false;
    }
    if (!(study_find_tolerance(options->tolerance) > 0)) return false;
    return !options->complete || study_find_completion(options->complete) != CPS_COMPLETION_COUNT;
}

int cmd_study(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_STUDY, "SCENE.yaml", &options) || !is_sound(&options))
        return EXIT_USAGE;
    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.operand, NULL, &file, &err) != CPS_OK) return cli_report(&err);
    if (options.history && cps_scene_file_scene(file)->point_count > 0) {
        fputs(
            "capstan study: --history: the scene has points where lines meet, which the methods of "
            "1990 do not know\n",
            stderr);
        cps_scene_file_destroy(file);
        return EXIT_INPUT;
    }
    /* a judgement writes no files: it needs no directory, and a signal ends the program at once */
    int code = EXIT_OK;
    char *directory = NULL;
    if (!options.judge) {
        cli_catch_signals();
        const CpsResultsKind kind = options.history    ? CPS_RESULTS_KIND_METHODS
                                    : options.complete ? CPS_RESULTS_KIND_COMPLETED
                                                       : CPS_RESULTS_KIND_STUDY;
        directory = cli_destination(&options, kind, cps_scene_file_scene(file)->line_count, &code);
    }
    if (directory && options.history)
        code = study_methods(cps_scene_file_scene(file), &options, directory);
    else if (directory || options.judge)
        code = study(cps_scene_file_scene(file), directory, &options);
    free(directory);
    cps_scene_file_destroy(file);
    return code;
}
