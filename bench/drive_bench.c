/* SPDX-License-Identifier: BSD-3-Clause */
/* Time per node of a driven rope: an arc of one radian on a table, pulled at its end.
 *     usage: drive_bench
 *
 * Every node has a disc of friction; every element is inextensible (a constraint), or may shorten
 * (a one-sided law). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "capstan/drive.h"

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t); /* not what else the machine does */
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "drive_bench: %s\n", err->message);
    exit(1);
}

static CpsSystem *rope(int n, bool one_sided) {
    CpsError err;
    CpsSystem *system = NULL;
    CpsSet *pull = NULL;
    CpsLaw *node = NULL, *taut = NULL;
    need(cps_system_create(2 * (n + 1), &system, &err), &err);
    need(cps_law_coulomb(1, 1.0 / n, &node, &err), &err);
    need(cps_set_interval(-INFINITY, 0, &pull, &err), &err);
    need(cps_law_friction(pull, &taut, &err), &err);
    for (int i = 0; i <= n; i++)
        need(cps_system_add_friction(system, NULL, node, 2,
                                     (const CpsEntry[]){{0, 2 * i, 1}, {1, 2 * i + 1, 1}}, &err),
             &err);
    for (int i = 1; i <= n; i++) {
        const double x = cos((i - 0.5) / n), y = sin((i - 0.5) / n);
        const CpsEntry entry[] = {{0, 2 * i, x},
                                  {0, 2 * i + 1, y},
                                  {0, 2 * i - 2, -x},
                                  {0, 2 * i - 1, -y}};
        if (one_sided)
            need(cps_system_add_friction(system, NULL, taut, 4, entry, &err), &err);
        else
            need(cps_system_add_constraints(system, 1, 4, entry, &err), &err);
    }
    need(cps_system_set_drive(system, 2, 2, (const CpsEntry[]){{0, 2 * n, 1}, {1, 2 * n + 1, 1}},
                              &err),
         &err);
    cps_law_release(node);
    cps_law_release(taut);
    cps_set_release(pull);
    return system;
}

int main(void) {
    printf("%8s %10s %8s %10s %10s %12s  %s\n", "nodes", "elements", "s", "us/node", "iterations",
           "relative gap", "outcome");
    for (int one_sided = 0; one_sided < 2; one_sided++)
        for (int n = 1000; n <= 100000; n *= 10) {
            CpsError err;
            CpsMotion *motion = NULL;
            CpsMotionOptions options = cps_motion_options_default();
            options.composition = false;
            CpsSystem *system = rope(n, one_sided);
            const double begin = now();
            need(cps_system_solve(system, (const double[]){cos(1), sin(1)}, &options, &motion,
                                  &err),
                 &err);
            const double seconds = now() - begin;
            const CpsMotionReport report = cps_motion_report(motion);
            printf("%8d %10s %8.3f %10.2f %10d %12.1e  %s\n", n + 1,
                   one_sided ? "one-sided" : "rigid", seconds, 1e6 * seconds / (n + 1),
                   report.iteration_count, report.minimum / report.scale,
                   cps_motion_outcome_name(report.outcome));
            cps_motion_destroy(motion);
            cps_system_destroy(system);
        }
    return 0;
}
