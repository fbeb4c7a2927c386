/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: a rope on a table; the velocity field of least dissipation, then its motion along
 * a path of end B, step by step, as an inextensible line on a plane (scene.h). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "drive/system_answer.h"
#include "law/set_answer.h"
#include "plot_file.h"
#include "progress.h"

/* Nodes slower than this share of the fastest end count as at rest. */
static const double REST = 1e-6;

typedef struct RopeRun {
    DriveRun *run;
    const CpsDriveRope *rope;
    CpsMotion *motion;
    int shots;
    double *shot; /* (shots, nodes, 2) */
    double dissipated, work, scale, gap;
    int uncertified;
    CpsOutcome outcome;
} RopeRun;

/* ---- the velocity field ---- */

static double fastest(const RopeRun *r) {
    double most = 0;
    const double *v = cps_motion_velocity(r->motion);
    for (int i = 0; i < r->rope->rope.node_count; i++)
        most = fmax(most, hypot(v[2 * i], v[2 * i + 1]));
    return most;
}

/* [m] of the rope that slides, and the largest tension */
static void measure(const RopeRun *r, double *length, double *sliding, double *tension) {
    const CpsRope *rope = &r->rope->rope;
    const double *v = cps_motion_velocity(r->motion), rest = REST * fastest(r);
    *length = *sliding = *tension = 0;
    for (int i = 0; i + 1 < rope->node_count; i++) {
        const double *x = rope->node + 2 * (size_t)i, l = hypot(x[2] - x[0], x[3] - x[1]);
        int slide = 0;
        for (int k = 0; k < 2; k++) slide += hypot(v[2 * (i + k)], v[2 * (i + k) + 1]) > rest;
        *length += l;
        *sliding += 0.5 * slide * l;
        *tension = fmax(*tension, -cps_motion_law_force(r->motion, rope->node_count + i)[0]);
    }
}

static void json_rope(const RopeRun *r, double length, double sliding, double tension) {
    const CpsRope *rope = &r->rope->rope;
    const CpsMotionReport p = cps_motion_report(r->motion);
    printf(", \"nodes\": %d", rope->node_count);
    drive_json_word("outcome", cps_motion_outcome_name(p.outcome));
    drive_json("gamma_W", p.value);
    drive_json("lower_W", p.lower);
    drive_json("upper_W", p.upper);
    drive_json("length_m", length);
    drive_json("sliding_m", sliding);
    drive_json("tension_max_N", tension);
    drive_json_rows("velocity", 2, rope->node_count, cps_motion_velocity(r->motion));
    fputs(", \"tension_N\": [", stdout);
    for (int i = 0; i + 1 < rope->node_count; i++) {
        if (i) fputs(", ", stdout);
        law_json_number(-cps_motion_law_force(r->motion, rope->node_count + i)[0], stdout);
    }
    putchar(']');
    drive_json_list("resistance_N", 2 * (rope->driven[0] + rope->driven[1]),
                    cps_motion_resistance(r->motion));
}

static void print_velocity(const RopeRun *r) {
    const CpsMotionReport p = cps_motion_report(r->motion);
    double length, sliding, tension;
    r->run->answered &= p.outcome != CPS_MOTION_OUTCOME_INACCURATE;
    if (p.outcome == CPS_MOTION_OUTCOME_BLOCKED || p.outcome == CPS_MOTION_OUTCOME_NO_BALANCE) {
        r->run->none = true;
        if (r->run->json)
            drive_json_word("outcome", cps_motion_outcome_name(p.outcome));
        else
            printf("no motion: %s\n", cps_motion_outcome_text(p.outcome));
        return;
    }
    measure(r, &length, &sliding, &tension);
    if (r->run->json) {
        json_rope(r, length, sliding, tension);
        return;
    }
    printf("rope of %.6g m on %d elements, friction %.6g N/m; end B moves with (%.6g, %.6g) m/s\n",
           length, r->rope->rope.node_count - 1, r->rope->rope.resistance,
           r->rope->driving[r->rope->rope.driven[0] ? 2 : 0],
           r->rope->driving[r->rope->rope.driven[0] ? 3 : 1]);
    printf("  gamma = %.10g W, proved between bounds %.2g W apart\n", p.value, p.upper - p.lower);
    printf("  sliding %.6g m, resting %.6g m; largest tension %.8g N\n", sliding,
           fmax(length - sliding, 0), tension);
    fputs("  resistance of the driven ends: ", stdout);
    law_print_vector(2 * (r->rope->rope.driven[0] + r->rope->rope.driven[1]),
                     cps_motion_resistance(r->motion));
    puts(" N");
}

/* ---- along the path ---- */

static void keep_shot(RopeRun *r, const double *position, size_t stride) {
    const size_t nodes = (size_t)r->rope->rope.node_count;
    double *to = r->shot + (size_t)r->shots++ * 2 * nodes;
    for (size_t i = 0; i < nodes; i++) {
        to[2 * i] = position[stride * i];
        to[2 * i + 1] = position[stride * i + 1];
    }
}

/* take the steps, storing configurations at even distances */
static bool step_through(RopeRun *r, CpsEvolution *evolution) {
    const int steps = r->rope->step_count, wanted = r->rope->shot_count;
    Progress progress =
        progress_begin(steps, r->run->options->quiet || steps * r->rope->rope.node_count < 20000);
    bool good = true;
    for (int i = 1; i <= steps && good && cps_evolution_remaining_count(evolution) > 0; i++) {
        good = cps_evolution_step(evolution, &r->run->err) == CPS_OK;
        if (!good) break;
        const CpsStepReport report = cps_evolution_report(evolution);
        r->outcome = cps_outcome_worse(r->outcome, report.outcome);
        r->uncertified += !cps_outcome_is_certified(report.outcome);
        r->dissipated += report.dissipated;
        r->work += report.ledger.ends;
        r->gap += report.certificate.gap;
        r->scale += report.certificate.scale;
        if (wanted > 1 && (int)((long long)i * (wanted - 1) / steps) > r->shots - 1 &&
            r->shots < wanted)
            keep_shot(r, cps_evolution_line_view(evolution, 0).position, 3);
        progress_step(&progress, i, "rope");
    }
    progress_end(&progress);
    return good;
}

/* the rope and its path as a scene, in the caller's arrays */
static CpsStatus make_scene(const CpsDriveRope *rope, double *node, double *element,
                            CpsChange *change, CpsStage *stage, CpsEvolution **out, CpsError *err) {
    const int nodes = rope->rope.node_count, steps = rope->step_count;
    CpsObstacle table = cps_obstacle_default();
    table.name = "table";
    table.friction = rope->friction;
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.element_count = nodes - 1;
    line.element_length = element;
    line.weight = rope->weight;
    line.stiffness = INFINITY;
    line.length = 0;
    for (int i = 0; i < nodes; i++) {
        node[3 * i] = rope->rope.node[2 * i];
        node[3 * i + 1] = rope->rope.node[2 * i + 1];
    }
    for (int i = 0; i + 1 < nodes; i++) {
        element[i] = hypot(node[3 * i + 3] - node[3 * i], node[3 * i + 4] - node[3 * i + 1]);
        line.length += element[i];
    }
    line.start = (CpsStart){.kind = CPS_START_POLYLINE, .point_count = nodes, .point = node};
    const double *last = node + 3 * (nodes - 1);
    line.end[CPS_END_A] =
        (CpsEnd){.kind = rope->rope.driven[0] ? CPS_END_KIND_HELD : CPS_END_KIND_FREE};
    if (rope->rope.driven[0]) memcpy(line.end[CPS_END_A].value, node, sizeof line.end[0].value);
    line.end[CPS_END_B] = (CpsEnd){.kind = CPS_END_KIND_HELD, .value = {last[0], last[1], 0}};
    double *path = node + 3 * (size_t)nodes;
    cps_drive_walk(2, rope->point_count, rope->path, steps + 1, path);
    for (int i = 0; i < steps; i++) {
        change[i] = (CpsChange){.end = CPS_END_B,
                                .to = {CPS_END_KIND_HELD, {path[2 * i + 2], path[2 * i + 3], 0}}};
        stage[i] = cps_stage_default();
        stage[i].name = "pull";
        stage[i].change_count = 1;
        stage[i].change = &change[i];
    }
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = scene.line_count = 1;
    scene.stage_count = steps;
    scene.obstacle = &table;
    scene.line = &line;
    scene.stage = stage;
    return cps_evolution_create(&scene, out, err);
}

static bool follow_path(RopeRun *r) {
    const size_t nodes = (size_t)r->rope->rope.node_count, steps = (size_t)r->rope->step_count;
    double *number = calloc(4 * nodes + 2 * (steps + 1), sizeof *number);
    CpsChange *change = calloc(steps, sizeof *change);
    CpsStage *stage = calloc(steps, sizeof *stage);
    r->shot = calloc((size_t)r->rope->shot_count * nodes * 2, sizeof *r->shot);
    CpsEvolution *evolution = NULL;
    bool good = number && change && stage && r->shot;
    if (!good) r->run->err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
    good = good && make_scene(r->rope, number, number + 3 * nodes + 2 * (steps + 1), change, stage,
                              &evolution, &r->run->err) == CPS_OK;
    if (good) {
        keep_shot(r, r->rope->rope.node, 2);
        good = step_through(r, evolution);
    }
    cps_evolution_destroy(evolution);
    free(stage);
    free(change);
    free(number);
    return good;
}

static void print_path(const RopeRun *r) {
    const int last = r->shots - 1, nodes = r->rope->rope.node_count;
    if (cps_outcome_is_final(r->outcome))
        r->run->none = true;
    else
        r->run->answered &= r->uncertified == 0;
    if (r->run->json) {
        printf(", \"path\": {\"steps\": %d, \"outcome\": \"%s\", \"uncertified\": %d",
               r->rope->step_count, cps_outcome_name(r->outcome), r->uncertified);
        drive_json("dissipated_J", r->dissipated);
        drive_json("work_J", r->work);
        drive_json("gap_J", r->gap);
        drive_json_rows("shape", 2, nodes, r->shot + (size_t)last * 2 * (size_t)nodes);
        putchar('}');
        return;
    }
    const double *a = r->shot + (size_t)last * 2 * (size_t)nodes;
    printf("end B along its path in %d steps: %s\n", r->rope->step_count,
           cps_outcome_text(r->outcome));
    if (r->uncertified)
        printf("  note: %d steps are not certified, so energies are not given\n", r->uncertified);
    else
        printf("  dissipated %.8g J, work of the ends %.8g J, gaps of all steps together %.1e J\n",
               r->dissipated, r->work, r->gap);
    printf("  end A comes to (%.6g, %.6g)\n", a[0] + 0.0, a[1] + 0.0);
}

/* ---- the whole answer ---- */

static CpsStatus draw(void *user, FILE *out, CpsError *err) {
    const RopeRun *r = user;
    return cps_drive_draw_rope(r->run->file, r->motion, r->shots, r->shot, out, err);
}

int drive_answer_rope(DriveRun *run) {
    RopeRun r = {.run = run, .rope = &run->file->rope};
    CpsSystem *system = NULL;
    CpsMotionOptions options = cps_motion_options_default();
    options.composition = false;
    bool good = cps_rope_system(&r.rope->rope, &system, &run->err) == CPS_OK &&
                cps_system_solve(system, r.rope->driving, &options, &r.motion, &run->err) == CPS_OK;
    if (good) print_velocity(&r);
    if (good && !run->none && r.rope->point_count > 0 && (good = follow_path(&r))) print_path(&r);
    int code = good ? EXIT_OK : cli_report(&run->err);
    if (code == EXIT_OK && run->options->plot && !run->none)
        code = cli_plot(draw, &r, run->options->plot);
    cps_motion_destroy(r.motion);
    cps_system_destroy(system);
    free(r.shot);
    return code;
}
