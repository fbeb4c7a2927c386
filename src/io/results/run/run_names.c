/* SPDX-License-Identifier: BSD-3-Clause */
/* Before a computation: whether its results can be written to a directory, and under which names
 * they will be. Names that are taken are found here, and not when everything has been computed. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/results/writers.h"

/* the most names of a kind that are always the same */
enum { PLAIN_NAMES = 6 };

static const char *const PLAIN[][PLAIN_NAMES] = {
    [CPS_RESULTS_KIND_RUN] = {"summary.json", "history.csv", "result.nc", "plan.svg",
                              "elevation.svg", "tension.svg"},
    [CPS_RESULTS_KIND_REGULARIZED] = {"summary.json", "history.csv"},
    [CPS_RESULTS_KIND_STUDY] = {"study.csv", "study.svg", "first-order.csv", "first-order.svg",
                                "relaxed.svg", "study.json"},
    [CPS_RESULTS_KIND_METHODS] = {"methods.csv", "methods.svg", "methods.json"},
    [CPS_RESULTS_KIND_COMPLETED] = {"completed.csv", "completed.svg", "completed.json"},
    [CPS_RESULTS_KIND_OFFSET] = {"offset.csv", "offset.svg", "broken.csv", "offset.json"}};

enum { KINDS = sizeof PLAIN / sizeof *PLAIN };

static bool is_plain(CpsResultsKind kind, const char *name) {
    for (int i = 0; i < PLAIN_NAMES && PLAIN[kind][i]; ++i)
        if (strcmp(name, PLAIN[kind][i]) == 0) return true;
    return false;
}

/* Is an obstacle to turn or move in this step of the history? */
static bool is_to_move(const CpsResults *results, int step) {
    for (int i = 0; i < results->stage_count; ++i)
        if (step >= results->stage[i].first && step <= results->stage[i].last)
            return results->stage[i].moves;
    return false;
}

/* A name of step-00000.vtp and its like, which begins with the number. */
static bool writes_of_step(const CpsResults *results, const char *name) {
    char own[64];
    const unsigned long step = strtoul(name + sizeof "step-" - 1, NULL, 10);
    /* breaks, one for each end of a line at most, shift the steps that follow; with a pace there is
     * any number of steps */
    const bool shifts = results->lets_go || results->has_pace;
    const unsigned long breaks = shifts ? 2ul * (unsigned long)results->line_count : 0;
    if (!results->has_pace && step >= (unsigned long)results->planned_steps + breaks) return false;
    snprintf(own, sizeof own, "step-%05lu.vtp", step);
    if (strcmp(name, own) == 0) return results->paraview;
    snprintf(own, sizeof own, "step-%05lu-points.vtp", step);
    if (strcmp(name, own) == 0) return results->paraview && results->point_count > 0;
    cpsi_paraview_obstacles_name((int)step, own);
    if (strcmp(name, own) == 0)
        return results->paraview && results->obstacle_count > 0 &&
               (shifts || is_to_move(results, (int)step));
    if (!shifts && !cpsi_results_pictured(results, (int)step)) return false;
    snprintf(own, sizeof own, "step-%05lu-plan.svg", step);
    if (strcmp(name, own) == 0) return true;
    snprintf(own, sizeof own, "step-%05lu-elevation.svg", step);
    return strcmp(name, own) == 0;
}

bool cpsi_results_writes(const void *run, const char *name) {
    const CpsResults *results = run;
    if (is_plain(CPS_RESULTS_KIND_RUN, name)) return true;
    if (strcmp(name, "history.svg") == 0) return results->planned_steps > 1;
    if (strcmp(name, "planes.svg") == 0) return cpsi_results_has_planes(results);
    if (strcmp(name, "history.out") == 0) return results->out_table;
    if (strcmp(name, "points.csv") == 0) return results->point_count > 0;
    if (strcmp(name, "bodies.csv") == 0) return results->body_count > 0;
    if (strcmp(name, "stiffness.csv") == 0) return results->stiffness;
    if (strcmp(name, "point-stiffness.csv") == 0)
        return results->stiffness && results->point_count > 0;
    if (strcmp(name, "body-stiffness.csv") == 0)
        return results->stiffness && results->body_count > 0;
    if (strcmp(name, "result.pvd") == 0) return results->paraview;
    if (strcmp(name, "obstacles.vtp") == 0) return results->paraview && results->obstacle_count > 0;
    if (strcmp(name, "sets.vtp") == 0) return results->paraview && results->draws_sets;
    return strncmp(name, "step-", 5) == 0 && writes_of_step(results, name);
}

bool cpsi_results_replaces(const char *name) {
    static const char *const BEGINNING[] = {"obstacles.vtp",
                                            "result.pvd",
                                            "history.svg",
                                            "history.out",
                                            "stiffness.csv",
                                            "points.csv",
                                            "bodies.csv",
                                            "body-stiffness.csv",
                                            "point-stiffness.csv",
                                            "planes.svg",
                                            "loop-",
                                            "step-",
                                            "line-"};
    for (size_t i = 0; i < sizeof BEGINNING / sizeof *BEGINNING; ++i)
        if (strncmp(name, BEGINNING[i], strlen(BEGINNING[i])) == 0) return true;
    return is_plain(CPS_RESULTS_KIND_RUN, name); /* which has the names of the other method too */
}

typedef struct Wanted {
    CpsResultsKind kind;
    int lines;
} Wanted;

/* Of a run the names depend on its history, and are checked where it is opened. */
static bool is_wanted(const void *user, const char *name) {
    const Wanted *wanted = user;
    if (wanted->kind == CPS_RESULTS_KIND_RUN) return false;
    if (is_plain(wanted->kind, name)) return true;
    if (wanted->kind != CPS_RESULTS_KIND_REGULARIZED || strncmp(name, "line-", 5) != 0)
        return false;
    const long line = strtol(name + sizeof "line-" - 1, NULL, 10);
    return line >= 1 && line <= wanted->lines;
}

CpsStatus cps_results_prepare(const char *directory, CpsResultsKind kind, int line_count,
                              bool force, CpsError *err) {
    if (!directory || !*directory)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "directory is NULL or empty");
    if ((int)kind < 0 || (int)kind >= KINDS || line_count < 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "there is no such kind of results, or the number of lines is negative");
    const bool other = kind == CPS_RESULTS_KIND_REGULARIZED;
    CpsStatus status = CPS_OK;
    if (force && kind == CPS_RESULTS_KIND_RUN)
        status = cpsi_journal_check(directory, false, force, err);
    const Wanted wanted = {kind, line_count};
    if (status == CPS_OK)
        status = cpsi_directory_prepare(directory, force, is_wanted, &wanted, err);
    if (status == CPS_OK && other) status = cpsi_journal_check(directory, true, force, err);
    return status;
}
