/* SPDX-License-Identifier: BSD-3-Clause */
/* A whole history by three methods (see study_methods.h). The regularised one continues from its
 * own configurations and reactions; loads and ends are those of the frozen history. */
#include "study/study_methods.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/results.h"
#include "commands.h"
#include "printable.h"
#include "run/regularized_run.h"
#include "signals.h"

enum { REGULARISED, FROZEN, CONSISTENT, METHODS, NAME_SIZE = 96 };

static const char *const METHOD[METHODS] = {"regularised, 1990", "frozen friction",
                                            "consistent friction"};

typedef struct Histories {
    const CpsScene *scene;
    const char *line; /* as given by the user */
    double friction;  /* mu of the obstacle */
    RegularizedOptions given;
    int steps, points; /* the start is step 0 */
    double *position[METHODS];
    char (*name)[NAME_SIZE]; /* (steps) */
    bool converged;
} Histories;

static int out_of_memory(void) {
    fprintf(stderr, "capstan: out of memory\n");
    return EXIT_LIMIT;
}

/* index of the line, -1 after a message */
static int find_line(const Histories *h) {
    for (int i = 0; i < h->scene->line_count; ++i)
        if (!h->line || strcmp(h->scene->line[i].name, h->line) == 0) return i;
    fprintf(stderr,
            "capstan study: --line: found '%.80s', expected the name of a line of the scene\n",
            h->line);
    return -1;
}

/* in the coordinates of the scene */
static void store(Histories *h, int method, int step, const double *position,
                  const double origin[3]) {
    double *to = h->position[method] + (size_t)step * 3 * (size_t)h->points;
    for (size_t i = 0; i < 3 * (size_t)h->points; ++i)
        to[i] = origin[i % 3] != 0 ? origin[i % 3] + position[i] : position[i];
}

/* solve the step with the regularised method too */
static int regularise(Histories *h, const CpsLineView *view, int step, Regularized *method) {
    CpsError err;
    CpsRegularizedReport report;
    CpsRegularizedParameters fine;
    if (regularized_step(method, view, &fine, &report, &err) != CPS_OK) return cli_report(&err);
    h->converged &= report.converged;
    store(h, REGULARISED, step, cps_regularized_view(method->last).position, view->origin);
    return EXIT_OK;
}

/* all steps of one evolution; the regularised method is computed along with the frozen one */
static int run_evolution(Histories *h, int method, int line) {
    CpsScene scene = regularized_scene(h->scene);
    if (method == CONSISTENT) {
        scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
        scene.solver.max_halvings =
            h->scene->solver.max_halvings; /* whole steps need not converge */
    }
    CpsError err;
    CpsEvolution *evolution = NULL;
    Regularized own = {.friction = h->friction, .given = h->given};
    if (cli_evolution_create(&scene, &evolution, &err) != CPS_OK) return cli_report(&err);
    int code = EXIT_OK;
    const CpsLineView start = cps_evolution_line_view(evolution, line);
    store(h, method, 0, start.position, start.origin);
    if (method == FROZEN) store(h, REGULARISED, 0, start.position, start.origin);
    for (int step = 1; step < h->steps && code == EXIT_OK; ++step) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) {
            code = cli_report(&err);
            break;
        }
        const CpsStepReport report = cps_evolution_report(evolution);
        snprintf(h->name[step], NAME_SIZE, "%s", report.name);
        if (report.outcome != CPS_OUTCOME_SOLVED) {
            fprintf(stderr, "capstan study: step %d, %s: %s\n", report.step_count - 1,
                    METHOD[method], cps_outcome_text(report.outcome));
            code = cps_outcome_is_final(report.outcome) ? EXIT_NO_SOLUTION : EXIT_NOT_CERTIFIED;
            break;
        }
        const CpsLineView view = cps_evolution_line_view(evolution, line);
        store(h, method, step, view.position, view.origin);
        if (method == FROZEN) code = regularise(h, &view, step, &own);
    }
    cps_regularized_destroy(own.last);
    cps_evolution_destroy(evolution);
    return code;
}

static void tell(const Histories *h) {
    printf("%-20s %-20s %12s %12s %12s %12s\n%-20s %-20s %12s %12s %12s %12s\n", "step", "method",
           "B.x", "B.y", "B.z", "from frozen", "", "", "m", "m", "m", "m");
    for (int s = 0; s < h->steps; ++s)
        for (int m = 0; m < METHODS; ++m) {
            const size_t size = 3 * (size_t)h->points, from = (size_t)s * size;
            double most = 0;
            for (size_t p = from; p < from + size; p += 3) {
                const double *a = h->position[m] + p, *b = h->position[FROZEN] + p;
                most =
                    fmax(most, sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                                    (a[2] - b[2]) * (a[2] - b[2])));
            }
            const double *tip = h->position[m] + from + size - 3;
            cli_print_text(stdout, m == 0 ? h->name[s] : "", 20, true);
            printf(" %-20s %12.6f %12.6f %12.6f %12.3e\n", METHOD[m], tip[0], tip[1], tip[2], most);
        }
}

static int run_all(Histories *h, const char *directory, bool quiet) {
    const int line = find_line(h);
    if (line < 0) return EXIT_USAGE;
    int code = run_evolution(h, FROZEN, line);
    if (code == EXIT_OK) code = run_evolution(h, CONSISTENT, line);
    if (code != EXIT_OK) return code;
    const char **name = malloc((size_t)h->steps * sizeof *name);
    if (!name) return out_of_memory();
    for (int s = 0; s < h->steps; ++s) name[s] = h->name[s];
    CpsMethodHistory method[METHODS];
    for (int m = 0; m < METHODS; ++m) method[m] = (CpsMethodHistory){METHOD[m], h->position[m]};
    CpsError err;
    const char *title = h->scene->title ? h->scene->title : "capstan";
    const CpsStatus status =
        cps_methods_write(directory, title, METHODS, method, h->steps, h->points, name, &err);
    free(name);
    if (status != CPS_OK) return cli_report(&err);
    if (!quiet) {
        regularized_print_steps(h->scene);
        tell(h);
    }
    if (!quiet) cli_printf(stdout, "\nresults   %s: methods.csv, methods.svg\n", directory);
    if (!h->converged) fprintf(stderr, "capstan study: a regularised solve did not converge\n");
    return h->converged ? EXIT_OK : EXIT_NOT_CERTIFIED;
}

int study_methods(const CpsScene *scene, const CliOptions *options, const char *directory) {
    CpsEvolution *evolution = NULL;
    CpsError err;
    const double friction = regularized_friction(scene, "study");
    if (friction < 0) return EXIT_INPUT;
    if (cps_evolution_create(scene, &evolution, &err) != CPS_OK) return cli_report(&err);
    Histories h = {.scene = scene,
                   .line = options->line,
                   .friction = friction,
                   .steps = 1 + cps_evolution_step_count(evolution),
                   .converged = true};
    cps_evolution_destroy(evolution);
    if (!regularized_options_read(options, "study", &h.given)) return EXIT_USAGE;
    const int index = find_line(&h);
    if (index < 0) return EXIT_USAGE;
    h.points = scene->line[index].element_count + 1;
    bool whole = true;
    for (int m = 0; m < METHODS; ++m) {
        h.position[m] = calloc((size_t)h.steps * 3 * (size_t)h.points, sizeof(double));
        whole = whole && h.position[m];
    }
    h.name = calloc((size_t)h.steps, sizeof *h.name);
    whole = whole && h.name;
    if (whole) snprintf(h.name[0], NAME_SIZE, "start");
    const int code = whole ? run_all(&h, directory, options->quiet) : out_of_memory();
    for (int m = 0; m < METHODS; ++m) free(h.position[m]);
    free(h.name);
    return code;
}
