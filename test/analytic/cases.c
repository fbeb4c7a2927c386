/* SPDX-License-Identifier: BSD-3-Clause */
/* Building and running the analytic cases. */
#include "cases.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "checker.h"

void case_begin(Case *c, double length, int elements, double weight, double stiffness) {
    *c = (Case){.scene = cps_scene_default(),
                .bed = cps_obstacle_default(),
                .line = cps_line_default()};
    c->line.name = "line";
    c->line.length = length;
    c->line.element_count = elements;
    c->line.weight = weight;
    c->line.stiffness = stiffness;
    c->line.start.point = c->point;
    c->bed.name = "bed";
    c->scene.line_count = 1;
    c->scene.line = &c->line;
    c->scene.stage = c->stage;
}

void case_bed(Case *c, double friction) {
    c->bed.friction = friction;
    c->scene.obstacle_count = 1;
    c->scene.obstacle = &c->bed;
}

void case_straight(Case *c, double x_from, double x_to) {
    c->line.start.kind = CPS_START_STRAIGHT;
    c->line.start.point_count = 2;
    c->point[0] = x_from;
    c->point[3] = x_to;
}

void case_corner(Case *c, double corner) {
    c->line.start.kind = CPS_START_POLYLINE;
    c->line.start.point_count = 3;
    c->point[3] = c->point[6] = corner;
    c->point[8] = c->line.length - corner;
}

void case_arc(Case *c, double radius) {
    c->line.start.kind = CPS_START_ARC;
    c->line.start.point_count = 2;
    c->point[4] = radius;
}

void case_laid(Case *c, double x, double z) {
    c->line.start.kind = CPS_START_STATIC;
    c->line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    c->line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {x, 0, z}};
}

static void add(Case *c, int steps, CpsEndKind kind, double x, double y, double z) {
    int s = c->scene.stage_count++;
    assert_true(s < CASE_STAGES);
    c->change[s] = (CpsChange){.end = CPS_END_B, .to = {.kind = kind, .value = {x, y, z}}};
    c->stage[s] = (CpsStage){.cookie = cps_stage_default().cookie,
                             .name = "stage",
                             .step_count = steps,
                             .change_count = 1,
                             .change = &c->change[s]};
}

void case_force(Case *c, int steps, double x, double y, double z) {
    add(c, steps, CPS_END_KIND_FREE, x, y, z);
}
void case_move(Case *c, int steps, double x, double y, double z) {
    add(c, steps, CPS_END_KIND_HELD, x, y, z);
}

static void must(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    print_error("%s: %s\n", cps_status_name(status), err->message);
    fail();
}

Run case_open(const Case *c) {
    CpsError err = {0};
    Run run = {.directory = "capstan-analytic-XXXXXX"};
    assert_non_null(mkdtemp(run.directory));
    must(cps_evolution_create(&c->scene, &run.evolution, &err), &err);
    must(cps_results_open(run.directory, &c->scene, run.evolution, NULL, &run.results, &err), &err);
    return run;
}

/* The target of the interior-point loop, as a share of the scale: it ends with a gap below this. */
static const double LOOP_TARGET = 1e-13;

/* The bound of the tension's error in a step. The certificate is that of the last substep; those
 * before it that the loop has solved are known to its target, and the bound is a root of the gap.
 */
static double tension_error(const CpsStepReport *report) {
    const CpsCertificate *found = &report->certificate;
    const double loop = LOOP_TARGET * found->scale;
    if (report->warm_count == report->substep_count || report->substep_count < 2 ||
        !(found->gap > 0) || found->gap > loop)
        return found->tension_bound;
    return found->tension_bound * sqrt(loop / found->gap);
}

CpsLineView case_step(Run *run) {
    CpsError err = {0};
    must(cps_evolution_step(run->evolution, &err), &err);
    must(cps_results_append(run->results, run->evolution, &err), &err);
    CpsStepReport report = cps_evolution_report(run->evolution);
    if (report.outcome != CPS_OUTCOME_SOLVED)
        print_error("step %d: %s\n", report.step_count - 1, cps_outcome_text(report.outcome));
    CHECK_INT(report.outcome, CPS_OUTCOME_SOLVED);
    run->dissipated += report.dissipated;
    CpsLineView view = cps_evolution_line_view(run->evolution, 0);
    run->tension_error = report.certificate.tension_bound;
    run->motion_error +=
        tension_error(&report) * view.compliance * view.arc_length[view.element_count];
    return view;
}

void case_close(Run *run) {
    CpsError err = {0};
    must(cps_results_finish(run->results, 0, &err), &err);
    cps_results_destroy(run->results);
    cps_evolution_destroy(run->evolution);

    char path[128];
    snprintf(path, sizeof path, "%s/result.nc", run->directory);
    CHECK_INT(checker_file(path, NULL, stderr), 0);
    snprintf(path, sizeof path, "rm -rf '%s'", run->directory);
    CHECK_INT(system(path), 0);
}

double show(const char *name, const char *figure, double expected, double found) {
    printf("%-28s | %-30s | %18.11g | %18.11g | %10.2e\n", name, figure, expected, found,
           found - expected);
    return found - expected;
}

double order(double coarse, double fine) { return log2(fabs(coarse) / fabs(fine)); }
