/* SPDX-License-Identifier: BSD-3-Clause */
#include "time_rig.h"

#include <stdio.h>
#include <string.h>

void time_begin(TimeRig *rig, double length, int elements, double mass, double stiffness) {
    *rig = (TimeRig){.gravity = 9.81};
    rig->scene = cps_scene_default();
    rig->line = cps_line_default();
    rig->line.name = "line";
    rig->line.length = length;
    rig->line.element_count = elements;
    rig->line.weight = rig->gravity * mass;
    rig->line.inertia = mass;
    rig->line.stiffness = stiffness;
    rig->line.start.kind = CPS_START_NODES;
    rig->line.start.point = rig->point;
    rig->line.start.point_count = elements + 1;
    rig->scene.line = &rig->line;
    rig->scene.line_count = 1;
    rig->scene.stage = rig->stage;
}

void time_plane(TimeRig *rig, double height, double friction) {
    rig->plane = cps_obstacle_default();
    rig->plane.name = "plane";
    rig->plane.point[2] = height;
    rig->plane.friction = friction;
    rig->scene.obstacle = &rig->plane;
    rig->scene.obstacle_count = 1;
}

void time_node(TimeRig *rig, int j, double x, double y, double z) {
    const double at[3] = {x, y, z};
    memcpy(&rig->point[3 * j], at, sizeof at);
}

void time_block(TimeRig *rig) {
    time_begin(rig, 2, 2, 0.01, 400);
    time_plane(rig, 0, 0.1);
    rig->line.end[CPS_END_B].kind = CPS_END_KIND_AT_START;
    rig->clump = (CpsPointWeight){.arc_length = 1, .weight = 5 * rig->gravity, .inertia = 5};
    rig->line.point_weight = &rig->clump;
    rig->line.point_weight_count = 1;
    time_node(rig, 0, -1.5, 0, 0);
    time_node(rig, 1, 0.2, 0, 0);
    time_node(rig, 2, 1.5, 0, 0);
}

void time_water(TimeRig *rig, double density, const double velocity[3], CpsDrag drag) {
    memcpy(rig->row.velocity, velocity, sizeof rig->row.velocity);
    rig->current = (CpsCurrent){.density = density, .row_count = 1, .row = &rig->row};
    rig->loads.drag = drag;
    rig->scene.current = &rig->current;
    rig->line.loads = &rig->loads;
}

CpsStage *time_stage(TimeRig *rig, double duration, int steps) {
    CpsStage *stage = &rig->stage[rig->scene.stage_count++];
    *stage = cps_stage_default();
    stage->name = "stage";
    stage->duration = duration;
    stage->step_count = steps;
    return stage;
}

CpsChange *time_change(TimeRig *rig, CpsEndKind kind, double x, double y, double z) {
    const int s = rig->scene.stage_count - 1;
    rig->change[s] = (CpsChange){.end = CPS_END_B, .to = {.kind = kind, .value = {x, y, z}}};
    rig->stage[s].change = &rig->change[s];
    rig->stage[s].change_count = 1;
    return &rig->change[s];
}

CpsSway *time_sway(TimeRig *rig, double period) {
    const int s = rig->scene.stage_count - 1;
    rig->sway[s] = (CpsSway){.owner = 0, .end = CPS_END_B, .period = period};
    rig->stage[s].sway = &rig->sway[s];
    rig->stage[s].sway_count = 1;
    return &rig->sway[s];
}

TimeRun time_open(TimeRig *rig) {
    TimeRun run = {.rig = rig};
    CpsError err;
    if (cps_evolution_create(&rig->scene, &run.evolution, &err)) fail_msg("%s", err.message);
    return run;
}

static void raise_to(double *worst, double value) {
    if (!(value <= *worst)) *worst = value;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static double size(const double *a) { return sqrt(dot(a, a)); }

/* Is node j free to move? */
static int moves(const CpsLineView *v, int j) {
    const int end = j == 0 ? CPS_END_A : CPS_END_B;
    return (j > 0 && j < v->element_count) || v->end[end].kind == CPS_END_KIND_FREE;
}

/* [m] How much deeper node j lies than its reaction says, (k d + c d')^+, on a plane that gives; d'
 * counts from the plane where the reference is above it. */
static double off_bed(const TimeRun *run, int j) {
    const CpsObstacle *bed = &run->rig->plane;
    const CpsLineView *v = &run->view;
    const double l = run->rig->line.length / v->element_count,
                 part = j > 0 && j < v->element_count ? l : l / 2,
                 area = run->rig->line.bearing_width * part,
                 span = run->motion.is_moving ? run->motion.span[j] : INFINITY;
    const double d = bed->point[2] - v->position[3 * j + 2],
                 past = fmax(0, bed->point[2] - v->reference[3 * j + 2]),
                 stiffness = area * (bed->stiffness + bed->damping / span);
    const double force = area * (bed->stiffness * d + bed->damping * (d - past) / span);
    /* the certificate leaves the spring open by stiffness x^2/2 <= gap */
    return fabs(v->reaction[j] - fmax(0, force)) / stiffness -
           sqrt(2 * run->report.certificate.gap / stiffness);
}

static void audit_node(TimeRun *run, int j, double largest) {
    const CpsLineView *v = &run->view;
    const CpsLineMotion *m = &run->motion;
    double rest[3], slip[3];
    for (int a = 0; a < 3; a++) {
        const int i = 3 * j + a;
        const double span = m->is_moving ? m->span[j] : 1,
                     speed = (v->position[i] - v->reference[i]) / span,
                     pace = m->is_moving ? (speed - m->rest_velocity[i]) / span : 0;
        rest[a] =
            v->load[i] + v->friction_force[i] + v->reaction[j] * v->normal[i] - m->mass[j] * pace;
        if (j > 0) rest[a] -= v->segment_force[i - 3];
        if (j < v->element_count) rest[a] += v->segment_force[i];
        slip[a] = a < 2 ? speed : 0;
    }
    /* the certificate leaves the inertia open by a force f with f^2 k^2/(2 m) <= gap */
    const double span = m->is_moving ? m->span[j] : 1;
    const double open =
        m->is_moving ? sqrt(2 * run->report.certificate.gap * m->mass[j]) / span : 0;
    raise_to(&run->balance, (size(rest) - open) / largest);
    const double friction = size(&v->friction_force[3 * j]),
                 bound = run->rig->plane.friction * v->reaction[j], speed = size(slip);
    raise_to(&run->outside, (friction - bound) / largest);
    raise_to(&run->opposed, (dot(&v->friction_force[3 * j], slip) + bound * speed) * span /
                                (largest * run->rig->line.length));
    const double above = v->position[3 * j + 2] - run->rig->plane.point[2];
    if (run->rig->plane.stiffness > 0)
        raise_to(&run->lifted, off_bed(run, j) / run->rig->line.length);
    else if (v->reaction[j] > 1e-9 * largest)
        raise_to(&run->lifted, fabs(above) / run->rig->line.length);
}

void time_step(TimeRun *run) {
    CpsError err;
    if (cps_evolution_step(run->evolution, &err)) fail_msg("%s", err.message);
    run->view = cps_evolution_line_view(run->evolution, 0);
    run->motion = cps_evolution_line_motion(run->evolution, 0);
    run->report = cps_evolution_line_report(run->evolution, 0);
    run->steps++;
    run->certified += cps_outcome_is_certified(run->report.outcome);
    if (!run->motion.mass) return; /* of a scene that is not in time */
    const CpsMotionLedger *ledger = &run->motion.ledger;
    double kinetic = 0;
    for (int j = 0; j <= run->view.element_count; j++) {
        kinetic += 0.5 * run->motion.mass[j] *
                   dot(&run->motion.velocity[3 * j], &run->motion.velocity[3 * j]);
        /* statics place the line without friction, by bounds that follow in the next step */
        if (moves(&run->view, j) && (run->motion.is_moving || run->steps > 1))
            audit_node(run, j, run->report.certificate.largest_force);
    }
    if (!run->motion.is_moving) return;
    CHECK_NEAR(run->motion.kinetic, kinetic, 1e-12 * (kinetic + ledger->turnover));
    run->imbalance += fabs(run->report.ledger.imbalance);
    run->turnover += ledger->turnover;
    run->kinetic += ledger->kinetic;
    run->impact += ledger->impact;
    run->scheme += ledger->scheme;
    run->drag += ledger->drag;
    run->damping += ledger->damping;
    run->added += ledger->added;
    run->waves += ledger->waves;
    run->lost += run->report.ledger.dissipated;
    run->landed += run->motion.landed;
    run->changed += run->motion.changed;
    run->snatched += run->motion.snatched;
}

void time_steps(TimeRun *run, int count) {
    for (int k = 0; (count == 0 || k < count) && cps_evolution_remaining_count(run->evolution) > 0;
         k++)
        time_step(run);
}

void time_close(TimeRun *run, const char *name) {
    run->remainder = run->turnover > 0 ? run->imbalance / run->turnover : 0;
    printf(
        "%-24s %6d steps, %d certified; %d landed, %d changed, %d snatched; balance %.1e, friction "
        "outside %.1e, not opposite %.1e, lifted %.1e, remainder %.1e\n",
        name, run->steps, run->certified, run->landed, run->changed, run->snatched, run->balance,
        run->outside, run->opposed, run->lifted, run->remainder);
    CHECK_INT(run->certified, run->steps);
    /* forces balance to rounding, which k amplifies: m x/k^2 with x to 1e-16 of its size */
    CHECK_LESS(run->balance, 1e-8);
    CHECK_LESS(run->outside, 1e-11);
    CHECK_LESS(run->opposed, 1e-9);
    CHECK_LESS(run->lifted, 1e-11);
    CHECK_LESS(run->remainder, 1e-10);
    cps_evolution_destroy(run->evolution);
}

double time_report(const char *name, const char *figure, double expected, double found) {
    printf("%-24s %-36s expected %-14.9g found %-14.9g difference %.3g\n", name, figure, expected,
           found, found - expected);
    return found - expected;
}

double time_pendulum_angle(double angle, double rate, double time) {
    const int steps = 100000;
    const double h = time / steps;
    double omega = 0;
    for (int i = 0; i < steps; i++) {
        const double k1 = omega, l1 = -rate * sin(angle);
        const double k2 = omega + h / 2 * l1, l2 = -rate * sin(angle + h / 2 * k1);
        const double k3 = omega + h / 2 * l2, l3 = -rate * sin(angle + h / 2 * k2);
        const double k4 = omega + h * l3, l4 = -rate * sin(angle + h * k3);
        angle += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        omega += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4);
    }
    return angle;
}
