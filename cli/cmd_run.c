/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan run: solve a scene step by step, write its results, print a short table.
 *
 * The first SIGINT or SIGTERM lets the load step end and keeps the results so far; the second ends at once. */
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "capstan/io.h"
#include "commands.h"
#include "options.h"
#include "progress.h"

enum { SHORT_TABLE = 40, NAME_WIDTH = 18, LINE_WIDTH = 10 };

static volatile sig_atomic_t stop_signal;

static void on_signal(int signal_number) {
    if (stop_signal) _exit(128 + signal_number);
    stop_signal = signal_number;
}

static void catch_signals(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    /* a file over the size limit then shows as a write error, and is cleaned up like one */
    signal(SIGXFSZ, SIG_IGN);
}

/* results/NAME for a scene .../NAME.yaml; the caller frees it */
static char *default_directory(const char *scene) {
    const char *slash = strrchr(scene, '/');
    const char *stem = strcmp(scene, "-") == 0 ? "scene" : slash ? slash + 1 : scene;
    const char *dot = strrchr(stem, '.');
    const int length = dot && dot != stem ? (int)(dot - stem) : (int)strlen(stem);
    const size_t size = sizeof "results/" + (size_t)length;
    char *path = malloc(size);
    if (path) snprintf(path, size, "results/%.*s", length, stem);
    return path;
}

/* a long history is shown by its first step and the last ones of its stages */
static bool is_shown(const CpsScene *scene, int steps, int index) {
    if (steps <= SHORT_TABLE || index == 0 || index == steps - 1) return true;
    if (scene->stage_count > SHORT_TABLE) return index % (steps / SHORT_TABLE + 1) == 0;
    int64_t end = steps - 1;
    for (int i = scene->stage_count - 1; i >= 0 && end >= index; --i) {
        if (end == index) return true;
        end -= scene->stage[i].steps;
    }
    return false;
}

static void put_head(FILE *table) {
    fprintf(table, "%-*s %-*s %-15s %4s %9s %12s %12s %10s %10s\n", NAME_WIDTH, "step", LINE_WIDTH, "line", "outcome",
            "iter", "gap/scale", "tension A", "tension B", "grounded", "slipping");
    fprintf(table, "%-*s %-*s %-15s %4s %9s %12s %12s %10s %10s\n", NAME_WIDTH, "", LINE_WIDTH, "", "", "", "", "N",
            "N", "m", "m");
}

static void put_rows(FILE *table, const CpsEvolution *evolution) {
    const CpsStepReport step = cps_evolution_report(evolution);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        const CpsCertificate *certificate = &line.certificate;
        cli_put_text(table, i == 0 ? step.name : "", NAME_WIDTH, true);
        fputc(' ', table);
        cli_put_text(table, cps_evolution_line_view(evolution, i).name, LINE_WIDTH, true);
        fprintf(table, " %-15s %4d %9.1e %12.6g %12.6g %10.4g %10.4g\n", cps_outcome_key(line.outcome), line.iterations,
                certificate->scale > 0 ? certificate->gap / certificate->scale : certificate->gap,
                line.end[CPS_END_A].tension, line.end[CPS_END_B].tension, line.grounded, line.slipping);
    }
}

/* what is not simply solved, said in a sentence with its proof */
static void report_outcomes(const CpsEvolution *evolution) {
    const CpsStepReport step = cps_evolution_report(evolution);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        if (line.outcome == CPS_SOLVED) continue;
        fputs("capstan: step ", stderr);
        cli_put_text(stderr, step.name, 80, false);
        fputs(", line ", stderr);
        cli_put_text(stderr, cps_evolution_line_view(evolution, i).name, 80, false);
        fprintf(stderr, ": %s", cps_outcome_sentence(line.outcome));
        const double *d = line.proof;
        const CpsCertificate *c = &line.certificate;
        if (line.outcome == CPS_INFEASIBLE)
            fprintf(stderr, " (by %.6g m along (%.4g, %.4g, %.4g))", line.proof_value, d[0], d[1], d[2]);
        else if (line.outcome == CPS_UNBOUNDED)
            fprintf(stderr, " (%.6g N along (%.4g, %.4g, %.4g))", line.proof_value, d[0], d[1], d[2]);
        else if (line.outcome != CPS_TAUT)
            fprintf(stderr, " (gap %.2e of the scale, force residual %.2e of the largest force)", c->gap / c->scale,
                    c->force_residual / c->largest_force);
        fputc('\n', stderr);
    }
}

static int exit_code(CpsOutcome worst) {
    switch (worst) {
    case CPS_SOLVED:
    case CPS_TAUT:
        return EXIT_OK;
    case CPS_STALLED:
    case CPS_ITERATION_LIMIT:
        return EXIT_NOT_CERTIFIED;
    case CPS_UNBOUNDED:
    case CPS_INFEASIBLE:
        return EXIT_NO_SOLUTION;
    }
    return EXIT_NOT_CERTIFIED;
}

/* All steps, or until a signal; *code is the exit code of the outcomes. */
static CpsStatus take_steps(const CpsScene *scene, CpsEvolution *evolution, CpsResults *results, Progress *progress,
                            FILE *table, int *code, CpsError *err) {
    const int steps = cps_evolution_step_count(evolution);
    CpsOutcome worst = CPS_SOLVED;
    while (cps_evolution_remaining(evolution) > 0 && !stop_signal) {
        CpsStatus status = cps_evolution_step(evolution, err);
        if (!status) status = cps_results_append(results, evolution, err);
        if (status) return status;
        const CpsStepReport report = cps_evolution_report(evolution);
        progress_step(progress, report.index + 1, report.name);
        if (is_shown(scene, steps, report.index) || report.outcome != CPS_SOLVED || stop_signal)
            put_rows(table, evolution);
        if (report.outcome != CPS_SOLVED) {
            progress_end(progress);
            report_outcomes(evolution);
        }
        if (report.outcome > worst) worst = report.outcome;
    }
    *code = exit_code(worst);
    return CPS_OK;
}

static void say_where(const char *directory, const CpsEvolution *evolution) {
    const int steps = cps_evolution_step_count(evolution), left = cps_evolution_remaining(evolution);
    if (stop_signal) fprintf(stderr, "capstan: stopped by a signal after %d of %d steps\n", steps - left, steps);
    printf("\nresults   %s: summary.json, history.csv, result.nc, result.pvd (ParaView)\n", directory);
    printf("pictures  %s: plan.svg, elevation.svg, tension.svg, step-*.svg, loop-*.svg of closed cycles\n", directory);
}

static int run(const CpsScene *scene, const char *directory, const CliOptions *options) {
    const double begun = cli_now();
    CpsError err;
    CpsEvolution *evolution = NULL;
    CpsResults *results = NULL;
    char *text = NULL;
    size_t size = 0;
    int code = EXIT_OK;
    FILE *table = open_memstream(&text, &size);
    if (!table) {
        fprintf(stderr, "capstan: out of memory\n");
        return EXIT_LIMIT;
    }
    put_head(table);

    CpsStatus status = cps_evolution_create(scene, &evolution, &err);
    if (!status) status = cps_results_open(directory, scene, evolution, &results, &err);
    if (!status) {
        Progress progress = progress_begin(cps_evolution_step_count(evolution), options->quiet);
        status = take_steps(scene, evolution, results, &progress, table, &code, &err);
        progress_end(&progress);
    }
    const double wall = cli_now() - begun;
    if (!status) status = cps_results_finish(results, wall, &err);
    if (!status && options->json) status = cps_results_write_summary(results, wall, stdout, &err);
    if (fclose(table) == 0 && !status && !options->json) {
        fwrite(text, 1, size, stdout);
        say_where(directory, evolution);
    }
    if (status)
        code = cli_report(&err);
    else if (stop_signal)
        code = 128 + stop_signal;
    free(text);
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    return code;
}

int cmd_run(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_RUN, true, &options)) return EXIT_USAGE;
    catch_signals();

    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.scene, NULL, &file, &err) != CPS_OK) return cli_report(&err);

    /* the results directory itself is made by the library; its parent only where it is ours */
    char *directory = options.output ? strdup(options.output) : default_directory(options.scene);
    int code = EXIT_LIMIT;
    if (!directory)
        fprintf(stderr, "capstan: out of memory\n");
    else if (!options.output && mkdir("results", 0777) != 0 && errno != EEXIST) {
        fprintf(stderr, "capstan: cannot make the directory results: %s; choose another with -o\n", strerror(errno));
        code = EXIT_IO;
    } else
        code = run(cps_scene_file_scene(file), directory, &options);
    free(directory);
    cps_scene_file_destroy(file);
    return code;
}
