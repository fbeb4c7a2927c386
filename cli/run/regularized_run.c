/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan run --method regularized (see regularized_run.h). */
#include "run/regularized_run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/results.h"
#include "commands.h"
#include "printable.h"
#include "progress.h"
#include "signals.h"

enum { NEWTON_LIMIT = 5000, STEP_NAME = 96, NAME_WIDTH = 18, LINE_WIDTH = 10 };

/* ---- a step ---- */

double regularized_friction(const CpsScene *scene, const char *command) {
    if (scene->obstacle_count == 0) return 0;
    if (scene->obstacle_count == 1) return scene->obstacle[0].friction;
    fprintf(stderr,
            "capstan %s: found %d obstacles, expected one plane or none for the method of 1990\n",
            command, scene->obstacle_count);
    return -1;
}

CpsScene regularized_scene(const CpsScene *scene) {
    CpsScene frozen = *scene;
    frozen.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    frozen.solver.path_tolerance = 0;
    frozen.solver.max_halvings = 0;
    return frozen;
}

void regularized_print_friction(const CpsScene *scene) {
    if (scene->friction_policy == CPS_FRICTION_POLICY_CONSISTENT)
        puts("friction: A = mu R_R of the reference, (78), in every step, as P2.1 has it; the "
             "scene's own, consistent, is A = mu R at x");
}

void regularized_print_steps(const CpsScene *scene) {
    if (scene->solver.path_tolerance > 0)
        puts("steps are taken whole, as given: the scene's path_tolerance is not applied to any "
             "method");
}

CpsStatus regularized_step(Regularized *method, const CpsLineView *exact,
                           CpsRegularizedParameters *parameters, CpsRegularizedReport *report,
                           CpsError *err) {
    CpsRegularized *next = NULL;
    CpsStatus status = method->last
                           ? cps_regularized_next(exact, method->friction, method->last, &next, err)
                           : cps_regularized_create(exact, &next, err);
    cps_regularized_destroy(method->last);
    method->last = next;
    if (status != CPS_OK) return status;
    *parameters = regularized_options_apply(&method->given, next);
    parameters->cell_count = 0;
    return cps_regularized_solve(next, parameters, NEWTON_LIMIT, report, err);
}

/* ---- a history ---- */

/* The history of a line; step 0 is the start. */
typedef struct Track {
    Regularized method;
    int points;
    double *position; /* (steps, points, 3) */
    CpsRegularizedParameters *parameters;
    CpsRegularizedReport *report;
} Track;

typedef struct History {
    const CpsScene *scene;
    CpsEvolution *exact;
    int steps, done, lines; /* number of steps with the start, and of steps computed so far */
    Track *track;
    char (*name)[STEP_NAME];
} History;

static void free_history(History *h) {
    for (int i = 0; i < h->lines && h->track; ++i) {
        Track *t = &h->track[i];
        cps_regularized_destroy(t->method.last);
        free(t->position);
        free(t->parameters);
        free(t->report);
    }
    free(h->track);
    free(h->name);
    cps_evolution_destroy(h->exact);
}

static bool make_history(History *h, double friction, const RegularizedOptions *given) {
    const size_t steps = (size_t)h->steps;
    h->name = calloc(steps, sizeof *h->name);
    h->track = calloc((size_t)h->lines, sizeof *h->track);
    bool whole = h->name && h->track;
    for (int i = 0; i < h->lines && whole; ++i) {
        Track *t = &h->track[i];
        t->method.friction = friction;
        t->method.given = *given;
        t->points = cps_evolution_line_view(h->exact, i).element_count + 1;
        t->position = calloc(steps * (size_t)t->points, 3 * sizeof(double));
        t->parameters = calloc(steps, sizeof *t->parameters);
        t->report = calloc(steps, sizeof *t->report);
        whole = t->position && t->parameters && t->report;
    }
    if (!whole) fprintf(stderr, "capstan: out of memory\n");
    return whole;
}

/* in the coordinates of the scene */
static void store(Track *t, int step, const double *position, const double origin[3]) {
    double *to = t->position + (size_t)step * 3 * (size_t)t->points;
    for (size_t i = 0; i < 3 * (size_t)t->points; ++i)
        to[i] = origin[i % 3] != 0 ? origin[i % 3] + position[i] : position[i];
}

/* all lines for the present step of the exact history */
static CpsStatus follow(History *h, CpsError *err) {
    for (int i = 0; i < h->lines; ++i) {
        Track *t = &h->track[i];
        const CpsLineView exact = cps_evolution_line_view(h->exact, i);
        const CpsStatus status =
            regularized_step(&t->method, &exact, &t->parameters[h->done], &t->report[h->done], err);
        if (status != CPS_OK) return status;
        const CpsRegularizedView own = cps_regularized_view(t->method.last);
        store(t, h->done, own.position, exact.origin);
    }
    return CPS_OK;
}

/* Compute all steps, or until a signal. Returns the exit code. */
static int take_steps(History *h, bool quiet) {
    CpsError err;
    Progress progress = progress_begin(h->steps - 1, quiet);
    int code = EXIT_OK;
    while (h->done < h->steps && !cli_interrupted() && code == EXIT_OK) {
        if (cps_evolution_step(h->exact, &err) != CPS_OK) {
            code = cli_report(&err);
            break;
        }
        const CpsStepReport report = cps_evolution_report(h->exact);
        snprintf(h->name[h->done], STEP_NAME, "%s", report.name);
        if (report.outcome != CPS_OUTCOME_SOLVED) {
            progress_end(&progress);
            fputs("capstan run: step ", stderr);
            cli_print_text(stderr, report.name, 80, false);
            fprintf(stderr, ": %s; the method of 1990 has no limit to go to\n",
                    cps_outcome_text(report.outcome));
            code = cps_outcome_is_final(report.outcome) ? EXIT_NO_SOLUTION : EXIT_NOT_CERTIFIED;
        } else if (follow(h, &err) != CPS_OK) {
            code = cli_report(&err);
        } else {
            progress_step(&progress, h->done++, report.name);
        }
    }
    progress_end(&progress);
    return code;
}

/* ---- output ---- */

static double larger(double a, double b) { return b > a ? b : a; }

static void tell(const History *h, const char *directory) {
    CpsRegularizedReport most = {0};
    printf("%-*s %-*s %-13s %5s %12s %12s %9s %9s %9s %9s %9s %9s\n", NAME_WIDTH, "step",
           LINE_WIDTH, "line", "outcome", "iter", "tension A", "tension B", "push", "sunk", "creep",
           "uncarried", "tension", "place");
    printf("%-*s %-*s %-13s %5s %12s %12s %9s %9s %9s %9s %9s %9s\n", NAME_WIDTH, "", LINE_WIDTH,
           "", "", "", "N", "N", "N", "m", "m", "N", "N rms off", "m off");
    for (int s = 1; s < h->done; ++s)
        for (int i = 0; i < h->lines; ++i) {
            const Track *t = &h->track[i];
            const CpsRegularizedReport *r = &t->report[s];
            most.compression = larger(most.compression, r->compression);
            most.penetration = larger(most.penetration, r->penetration);
            most.creep = larger(most.creep, r->creep);
            most.friction_excess = larger(most.friction_excess, r->friction_excess);
            if (!cli_is_shown(h->scene, h->steps - 1, s - 1) && r->converged && s < h->done - 1)
                continue;
            cli_print_text(stdout, i == 0 ? h->name[s] : "", NAME_WIDTH, true);
            putchar(' ');
            cli_print_text(stdout, cps_evolution_line_view(h->exact, i).name, LINE_WIDTH, true);
            printf(" %-13s %5d %12.6g %12.6g %9.1e %9.1e %9.1e %9.1e %9.1e %9.1e\n",
                   r->converged ? "converged" : "not converged", r->iteration_count,
                   r->end_tension[0], r->end_tension[1], r->compression, r->penetration, r->creep,
                   r->friction_excess, r->tension_rms, r->position_max);
        }
    printf("\nno certificate: a regularised solution is no equilibrium under dry friction. Its "
           "parameters leave at most\n  %.2g N of push in the line (1/n), %.2g m inside the "
           "obstacle (lambda), %.2g m of creep below the bound (delta),\n  %.2g N that nothing "
           "carries; 'off' is from the certified step with frozen friction\n",
           most.compression, most.penetration, most.creep, most.friction_excess);
    cli_printf(stdout, "\nresults   %s: summary.json, history.csv\npictures  %s: line-1.svg%s\n",
               directory, directory, h->lines > 1 ? ", .." : "");
}

/* ---- the whole run ---- */

static bool all_converged(const History *h) {
    for (int i = 0; i < h->lines; ++i)
        for (int s = 1; s < h->done; ++s)
            if (!h->track[i].report[s].converged) return false;
    return true;
}

static int write_results(const History *h, double wall, const char *directory,
                         const CliOptions *options) {
    CpsError err;
    const char **name = malloc((size_t)h->steps * sizeof *name);
    CpsRegularizedLine *line = calloc((size_t)h->lines, sizeof *line);
    CpsStatus status = CPS_OK;
    int code = EXIT_LIMIT;
    if (name && line) {
        for (int s = 0; s < h->steps; ++s) name[s] = h->name[s];
        for (int i = 0; i < h->lines; ++i) {
            const Track *t = &h->track[i];
            line[i] = (CpsRegularizedLine){.name = cps_evolution_line_view(h->exact, i).name,
                                           .point_count = t->points,
                                           .position = t->position,
                                           .parameters = t->parameters,
                                           .report = t->report};
        }
        const CpsRegularizedRun run = {.cookie = cps_regularized_run_default().cookie,
                                       .title = h->scene->title ? h->scene->title : "capstan",
                                       .step_count = h->done,
                                       .line_count = h->lines,
                                       .step_name = name,
                                       .line = line,
                                       .complete = h->done == h->steps,
                                       .wall = wall};
        status = cps_regularized_write(directory, &run, &err);
        if (status == CPS_OK && options->json) status = cps_regularized_summary(&run, stdout, &err);
        code = status == CPS_OK ? EXIT_OK : cli_report(&err);
    } else {
        fprintf(stderr, "capstan: out of memory\n");
    }
    free(name);
    free(line);
    return code;
}

int run_regularized(const CpsScene *scene, const char *directory, const CliOptions *options) {
    CpsError err;
    const double begun = cli_now(), friction = regularized_friction(scene, "run");
    if (friction < 0) return EXIT_INPUT;
    RegularizedOptions given;
    if (!regularized_options_read(options, "run", &given)) return EXIT_USAGE;
    const CpsScene frozen = regularized_scene(scene);
    History h = {.scene = scene, .done = 1};
    if (cli_evolution_create(&frozen, &h.exact, &err) != CPS_OK) return cli_report(&err);
    h.steps = 1 + cps_evolution_step_count(h.exact);
    h.lines = cps_evolution_line_count(h.exact);
    int code = EXIT_LIMIT;
    if (make_history(&h, friction, &given)) {
        snprintf(h.name[0], STEP_NAME, "start");
        for (int i = 0; i < h.lines; ++i) {
            const CpsLineView view = cps_evolution_line_view(h.exact, i);
            store(&h.track[i], 0, view.position, view.origin);
        }
        code = take_steps(&h, options->quiet);
        const bool some = h.done > 1 || h.steps == 1;
        const int written =
            some ? write_results(&h, cli_now() - begun, directory, options) : EXIT_OK;
        if (written != EXIT_OK) code = written;
        if (some && written == EXIT_OK && !options->quiet && !options->json) {
            regularized_print_friction(scene);
            regularized_print_steps(scene);
            tell(&h, directory);
        }
        if (code == EXIT_OK && !all_converged(&h)) code = EXIT_NOT_CERTIFIED;
        if (cli_interrupted())
            fprintf(stderr, "capstan: stopped by a signal after %d of %d steps\n", h.done - 1,
                    h.steps - 1);
        if (code == EXIT_OK && cli_interrupted()) code = 128 + cli_interrupted();
    }
    free_history(&h);
    return code;
}
