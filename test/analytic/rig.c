/* SPDX-License-Identifier: BSD-3-Clause */
/* Building, running and auditing lines on curved obstacles (rig.h). */
#include "rig.h"

#include <stdio.h>
#include <string.h>

#include "rig_shape.h"

/* small vectors -------------------------------------------------------------------------------- */

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static double norm(const double *a) { return sqrt(dot(a, a)); }

static void add(double *out, const double *a, double by, const double *b) {
    for (int k = 0; k < 3; k++) out[k] = a[k] + by * b[k];
}

static void cross(double *out, const double *a, const double *b) {
    const double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                         a[0] * b[1] - a[1] * b[0]};
    memcpy(out, c, sizeof c);
}

static void unit(double *a) {
    const double size = norm(a);
    for (int k = 0; k < 3; k++) a[k] = size > 0 ? a[k] / size : 0;
}

/* the rig -------------------------------------------------------------------------------------- */

void rig_begin(Rig *rig, int elements, double weight, double stiffness) {
    memset(rig, 0, sizeof *rig);
    rig->scene = cps_scene_default();
    rig->line = cps_line_default();
    rig->scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    rig->scene.line_count = 1;
    rig->scene.line = &rig->line;
    rig->scene.obstacle = rig->obstacle;
    rig->scene.stage = rig->stage;
    rig->line.name = "line";
    rig->line.element_count = elements;
    rig->line.weight = weight;
    rig->line.stiffness = stiffness;
    rig->line.start.kind = CPS_START_POLYLINE;
    rig->line.start.point = rig->point;
}

void rig_length(Rig *rig, double length) { rig->line.length = length; }

void rig_graded(Rig *rig) {
    rig->line.length = 0;
    for (int e = 0; e < rig->line.element_count; e++) rig->line.length += rig->element_length[e];
    rig->line.element_length = rig->element_length;
}

CpsObstacle *rig_obstacle(Rig *rig, CpsObstacleKind kind, double friction) {
    static const char *const NAME[RIG_OBSTACLES] = {"first", "second", "third"};
    const int k = rig->scene.obstacle_count++;
    assert_true(k < RIG_OBSTACLES);
    rig->obstacle[k] = cps_obstacle_default();
    rig->obstacle[k].name = NAME[k];
    rig->obstacle[k].kind = kind;
    rig->obstacle[k].friction = friction;
    rig->obstacle[k].radius = 1;
    return &rig->obstacle[k];
}

void rig_lateral(CpsObstacle *obstacle, double friction) {
    obstacle->has_friction_lateral = true;
    obstacle->friction_lateral = friction;
}

void rig_point(Rig *rig, double x, double y, double z) {
    const int k = rig->line.start.point_count++;
    assert_true(k < RIG_POINTS);
    double *p = &rig->point[3 * k];
    p[0] = x;
    p[1] = y;
    p[2] = z;
}

void rig_end(Rig *rig, int end, CpsEndKind kind, double x, double y, double z) {
    rig->line.end[end] = (CpsEnd){.kind = kind, .value = {x, y, z}};
}

void rig_stage(Rig *rig, int steps) {
    const int s = rig->scene.stage_count++;
    assert_true(s < RIG_STAGES);
    rig->stage[s] = (CpsStage){.cookie = cps_stage_default().cookie,
                               .name = "stage",
                               .step_count = steps,
                               .change = rig->change[s],
                               .turn = &rig->turn[s]};
}

void rig_change(Rig *rig, int end, CpsEndKind kind, double x, double y, double z) {
    const int s = rig->scene.stage_count - 1, k = rig->stage[s].change_count++;
    rig->change[s][k] = (CpsChange){.end = end, .to = {.kind = kind, .value = {x, y, z}}};
}

void rig_turn(Rig *rig, int obstacle, double angle) {
    const int s = rig->scene.stage_count - 1;
    rig->stage[s].turn_count = 1;
    rig->turn[s] = (CpsTurn){.obstacle = obstacle, .angle = angle};
}

/* the audit ------------------------------------------------------------------------------------ */

/* distance of x from an obstacle and the normal there */
static double distance(const CpsObstacle *o, const double *x, double *normal) {
    double from[3], axis[3];
    if (rig_is_shape(o)) return rig_shape_distance(o, x, normal, NULL);
    add(from, x, -1, o->point);
    if (o->kind == CPS_OBSTACLE_SURFACE || o->kind == CPS_OBSTACLE_GROUND) {
        double level, slope[2];
        if (o->kind == CPS_OBSTACLE_SURFACE) {
            level = o->surface.function(o->surface.user, from, normal);
        } else {
            level = from[2] - cps_ground_height(o->ground, from[0], from[1], slope);
            normal[0] = -slope[0];
            normal[1] = -slope[1];
            normal[2] = 1;
        }
        level /= norm(normal);
        unit(normal);
        return level;
    }
    if (o->kind == CPS_OBSTACLE_PLANE) {
        memcpy(normal, o->normal, 3 * sizeof *normal);
        unit(normal);
        return dot(from, normal);
    }
    memcpy(axis, o->axis, sizeof axis);
    unit(axis);
    memcpy(normal, from, sizeof from);
    if (o->kind == CPS_OBSTACLE_CYLINDER) add(normal, from, -dot(from, axis), axis);
    const double size = norm(normal);
    unit(normal);
    return size - o->radius;
}

/* x turned about the axis of the obstacle */
static void turned(const CpsObstacle *o, double angle, const double *x, double *out) {
    double from[3], axis[3], side[3];
    memcpy(axis, o->axis, sizeof axis);
    unit(axis);
    add(from, x, -1, o->point);
    cross(side, axis, from);
    const double along = dot(axis, from), c = cos(angle), s = sin(angle);
    for (int k = 0; k < 3; k++)
        out[k] = o->point[k] + along * axis[k] + c * (from[k] - along * axis[k]) + s * side[k];
}

/* Path from the foot of one point to that of another, as a tangent at the second, where the normal
 * is n. */
static void path_between(const CpsObstacle *o, const double *from, const double *to,
                         const double *n, double *out) {
    double other[3], step[3], axis[3], straight = 0;
    if (rig_is_shape(o)) {
        rig_shape_path(o, from, to, out);
        return;
    }
    distance(o, from, other);
    add(step, to, -1, from);
    if (o->kind == CPS_OBSTACLE_PLANE) {
        add(out, step, -dot(step, n), n);
        return;
    }
    if (o->kind == CPS_OBSTACLE_SURFACE || o->kind == CPS_OBSTACLE_GROUND) {
        /* the arc that turns by the angle between the normals, from foot to foot */
        double apart[3];
        add(step, step, -distance(o, to, apart), n);
        add(step, step, distance(o, from, other), other);
        add(apart, n, -1, other);
        const double half = asin(fmin(1, norm(apart) / 2));
        add(out, step, -dot(step, n), n);
        const double flat = norm(out), by = half > 1e-6 ? half / sin(half) : 1;
        if (flat > 0)
            for (int k = 0; k < 3; k++) out[k] *= by * norm(step) / flat;
        return;
    }
    memcpy(axis, o->axis, sizeof axis);
    unit(axis);
    if (o->kind == CPS_OBSTACLE_CYLINDER) straight = dot(step, axis);
    /* the angle between the normals, well conditioned at 0: 2 atan2(|n - m|, |n + m|) */
    double less[3], sum[3], tangent[3];
    add(less, n, -1, other);
    add(sum, n, 1, other);
    const double angle = 2 * atan2(norm(less), norm(sum));
    add(tangent, less, -dot(less, n), n);
    unit(tangent);
    for (int k = 0; k < 3; k++)
        out[k] = o->radius * angle * tangent[k] +
                 (o->kind == CPS_OBSTACLE_CYLINDER ? straight * axis[k] : 0);
}

/* two tangents: the grain's or the line's part in the tangent plane, and the one across it */
static void tangents(const CpsObstacle *o, const double *direction, const double *n, double *first,
                     double *second) {
    const double *along = norm(o->grain) > 0 ? o->grain : direction;
    add(first, along, -dot(along, n), n);
    unit(first);
    cross(second, n, first);
}

static double support(const CpsObstacle *o, double lateral, double reaction, double a, double b) {
    a *= o->friction;
    b *= lateral;
    return reaction *
           (o->friction_shape == CPS_FRICTION_SHAPE_BOX ? fabs(a) + fabs(b) : hypot(a, b));
}

/* of a set without width, what is within 1e-8 R of it is in it: axes are settled to that */
static double share(double force, double friction, double reaction) {
    return friction > 0 ? force / friction : fabs(force) <= 1e-8 * reaction ? 0 : INFINITY;
}

static double gauge(const CpsObstacle *o, double lateral, double reaction, double a, double b) {
    a = share(a, o->friction, reaction);
    b = share(b, lateral, reaction);
    return o->friction_shape == CPS_FRICTION_SHAPE_BOX ? fmax(fabs(a), fabs(b)) : hypot(a, b);
}

/* The depth of x below the nearest surface, over zero. */
static double depth(const CpsScene *scene, const double *x) {
    double deepest = 0, n[3];
    for (int k = 0; k < scene->obstacle_count; k++)
        deepest = fmax(deepest, -distance(&scene->obstacle[k], x, n));
    return deepest;
}

/* The largest force of the line or on it. */
static double largest(const CpsLineView *v) {
    double most = 0;
    for (int e = 0; e < v->element_count; e++) most = fmax(most, norm(&v->segment_force[3 * e]));
    for (int j = 0; j <= v->element_count; j++) most = fmax(most, norm(&v->load[3 * j]));
    for (int c = 0; c < v->contact_count * (v->element_count + 1); c++)
        most = fmax(most, v->reaction[c]);
    return most;
}

/* A node that does not touch keeps a reaction of rounding and friction in no direction: what that
 * leaves, over the largest force times the length. A step is solved to a gap of 1e-13 of its
 * scale. */
static const double ROUNDING = 1e-14;
/* The interior point ends at this gap of the scale (CPSI_TARGET). */
static const double LOOP_GAP = 1e-13;

/* Where something touches an obstacle, the line's direction there, and the forces of the obstacle
 * on it. */
typedef struct Touch {
    double place[3], reference[3], along[3], friction[3], bound, reaction;
} Touch;

/* Its friction, where the normal is n. */
static void audit_friction(Audit *audit, const CpsObstacle *o, const double *turn,
                           const Touch *touch, const double *n, double length) {
    double first[3], second[3], from[3], slid[3];
    const double *f = touch->friction, reaction = touch->reaction;
    const double lateral = o->has_friction_lateral ? o->friction_lateral : o->friction;
    const double w = fmax(o->friction, lateral) * reaction;
    tangents(o, touch->along, n, first, second);
    memcpy(from, touch->reference, sizeof from);
    if (*turn != 0) turned(o, *turn, touch->reference, from);
    path_between(o, from, touch->place, n, slid);
    const double f1 = dot(f, first), f2 = dot(f, second), s1 = dot(slid, first),
                 s2 = dot(slid, second);
    const double phi = support(o, lateral, reaction, s1, s2), law = phi + f1 * s1 + f2 * s2;
    audit->bound += fabs(touch->bound - w);
    audit->bounds += w;
    audit->law += fmax(0, law);
    audit->dissipated += phi;
    if (!(w > 0)) return;
    audit->outside =
        fmax(audit->outside, (gauge(o, lateral, reaction, f1, f2) - reaction) / reaction);
    audit->outside = fmax(audit->outside, fabs(dot(f, n)) / w);
    audit->node_law =
        fmax(audit->node_law, fmax(0, fabs(law) - ROUNDING * audit->scale) / (w * length));
}

/* What touches obstacle k at `touch`, as deep as it may lie there: its reaction, friction and what
 * they do. */
static void audit_touch(Audit *audit, const CpsScene *scene, const double *turn, const Touch *touch,
                        int k, double depth, double length, double *sum) {
    double n[3];
    add(sum, sum, 1, touch->friction);
    if (k < 0) {
        audit->open += touch->reaction != 0;
        return;
    }
    const CpsObstacle *o = &scene->obstacle[k];
    const double gap = distance(o, touch->place, n) + depth;
    add(sum, sum, touch->reaction, n);
    audit->open += fabs(gap * touch->reaction) / audit->scale;
    CpsObstacle within = *o; /* at the depth at which the point goes round */
    within.radius -= depth;
    if (touch->reaction > 0) audit_friction(audit, &within, &turn[k], touch, n, length);
}

/* Contact c of node j. */
static void audit_contact(Audit *audit, const CpsScene *scene, const double *turn,
                          const CpsLineView *v, int j, int c, double *sum) {
    const int before = j > 0 ? j - 1 : 0, after = j < v->element_count ? j + 1 : j;
    Touch touch = {.reaction = v->reaction[c], .bound = v->friction_bound[c]};
    memcpy(touch.friction, &v->friction_force[3 * c], sizeof touch.friction);
    memcpy(touch.place, &v->position[3 * j], sizeof touch.place);
    memcpy(touch.reference, &v->reference[3 * j], sizeof touch.reference);
    add(touch.along, &v->position[3 * after], -1, &v->position[3 * before]);
    audit_touch(audit, scene, turn, &touch, v->obstacle[c], 0, v->arc_length[v->element_count],
                sum);
}

/* The contact of element e, at the point of it that is nearest to the obstacle: what it does in
 * all. */
static void audit_element(Audit *audit, const CpsScene *scene, const double *turn,
                          const CpsLineView *v, int e, double *sum) {
    const int k = v->element_obstacle[e];
    const double b = v->element_share[e], l = v->element_length[e];
    Touch touch = {.reaction = v->element_reaction[e], .bound = v->element_friction_bound[e]};
    memcpy(touch.friction, &v->element_friction_force[3 * e], sizeof touch.friction);
    for (int i = 0; i < 3; i++) {
        touch.place[i] = (1 - b) * v->position[3 * e + i] + b * v->position[3 * e + 3 + i];
        touch.reference[i] = (1 - b) * v->reference[3 * e + i] + b * v->reference[3 * e + 3 + i];
        touch.along[i] = v->position[3 * e + 3 + i] - v->position[3 * e + i];
        sum[i] = 0;
    }
    /* with a plane it is the contact of the node at the element's end */
    const bool plane = k >= 0 && scene->obstacle[k].kind == CPS_OBSTACLE_PLANE;
    const double radius = k < 0 ? 1 : scene->obstacle[k].radius;
    if (plane) CHECK_NEAR(b, 1, 0);
    audit_touch(audit, scene, turn, &touch, k, plane ? 0 : fmin(l * l / radius, radius) / 4,
                v->arc_length[v->element_count], sum);
}

/* The share of element e's contact on its node j, added to `sum`. */
static void add_element(const CpsLineView *v, int e, int j, double *sum) {
    if (!v->element_obstacle || e < 0 || e >= v->element_count || v->element_obstacle[e] < 0)
        return;
    const double part = j == e ? 1 - v->element_share[e] : v->element_share[e];
    add(sum, sum, part, &v->element_friction_force[3 * e]);
    add(sum, sum, part * v->element_reaction[e], &v->element_normal[3 * e]);
}

Audit rig_audit(const CpsScene *scene, const double *turn, const CpsLineView *v) {
    const int nodes = v->element_count + 1;
    const double length = v->arc_length[v->element_count], force = largest(v);
    Audit audit = {.scale = force * length};
    for (int j = 0; j < nodes; j++) {
        double sum[3];
        audit.penetration = fmax(audit.penetration, depth(scene, &v->position[3 * j]) / length);
        const int end = j == 0 ? CPS_END_A : CPS_END_B;
        if ((j == 0 || j == v->element_count) && v->end[end].kind == CPS_END_KIND_HELD) continue;
        memcpy(sum, &v->load[3 * j], sizeof sum);
        for (int c = j; c < v->contact_count * nodes; c += nodes)
            audit_contact(&audit, scene, turn, v, j, c, sum);
        if (j > 0) add(sum, sum, -1, &v->segment_force[3 * (j - 1)]);
        if (j < v->element_count) add(sum, sum, 1, &v->segment_force[3 * j]);
        add_element(v, j - 1, j, sum);
        add_element(v, j, j, sum);
        if (force > 0) audit.balance = fmax(audit.balance, norm(sum) / force);
    }
    if (v->element_obstacle)
        for (int e = 0; e < v->element_count; e++) {
            double sum[3], told[3];
            if (v->element_obstacle[e] < 0) continue;
            audit_element(&audit, scene, turn, v, e, sum);
            /* the normal of the view is the obstacle's there */
            for (int i = 0; i < 3; i++)
                told[i] = sum[i] - v->element_friction_force[3 * e + i] -
                          v->element_reaction[e] * v->element_normal[3 * e + i];
            if (force > 0) audit.balance = fmax(audit.balance, norm(told) / force);
        }
    if (audit.bounds > 0) audit.bound /= audit.bounds;
    return audit;
}

/* the run -------------------------------------------------------------------------------------- */

static void must(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    print_error("%s: %s\n", cps_status_name(status), err->message);
    fail();
}

RigRun rig_open(const Rig *rig) {
    CpsError err = {0};
    RigRun run = {.rig = rig};
    must(cps_evolution_create(&rig->scene, &run.evolution, &err), &err);
    run.view = cps_evolution_line_view(run.evolution, 0);
    return run;
}

/* What each obstacle turns in the step to come; and on to the next step. */
static void turns(RigRun *run, double *turn) {
    const CpsScene *scene = &run->rig->scene;
    for (int k = 0; k < RIG_OBSTACLES; k++) turn[k] = 0;
    if (run->rig->line.start.kind == CPS_START_STATIC && run->steps == 0) return;
    if (run->stage >= scene->stage_count) return;
    const CpsStage *stage = &scene->stage[run->stage];
    for (int k = 0; k < stage->turn_count; k++)
        turn[stage->turn[k].obstacle] = stage->turn[k].angle / stage->step_count;
    if (++run->part == stage->step_count) {
        run->part = 0;
        run->stage++;
    }
}

/* The limits are those asked for: residuals of the bound and of the law 1e-8, depth 1e-6; forces
 * balance to 1e-9 of the largest, which is what the checker of result.nc asks. Sticking leaves
 * positions that differ from the reference by rounding of the length: up to 1e-13 of w l in the
 * law's sum, of all bounds together. */
static void check(RigRun *run, const Audit *audit) {
    const double length = run->rig->line.length;
    /* the certificate is that of the last substep; of those before it, the ones not found by
     * Newton's method may have the gap at which the interior point ends */
    const int cold = run->report.substep_count - run->report.warm_count,
              hidden = cold < run->report.substep_count ? cold : cold - 1;
    const double compliance = run->view.compliance * length,
                 gap = LOOP_GAP * run->report.certificate.scale,
                 before = compliance > 0 ? sqrt(2 * gap / compliance) : 0;
    run->motion += (run->report.certificate.tension_bound + hidden * before) * compliance;
    run->dissipated += run->report.dissipated;
    run->law += audit->law;
    const bool frictionless = run->rig->line.start.kind == CPS_START_STATIC && run->steps == 1;
    CHECK_LESS(audit->balance, 1e-9);
    CHECK_LESS(audit->penetration, 1e-6);
    CHECK_LESS(audit->open, 1e-8);
    if (frictionless) return;
    CHECK_LESS(audit->bound, 1e-8);
    CHECK_LESS(audit->outside, 1e-8);
    CHECK_LESS(audit->node_law, 1e-8);
    CHECK_LESS(audit->law, 1e-8 * audit->dissipated + 1e-12 * audit->bounds * length +
                               ROUNDING * audit->scale + 1e-300);
}

CpsOutcome rig_try(RigRun *run) {
    CpsError err = {0};
    double turn[RIG_OBSTACLES];
    turns(run, turn);
    must(cps_evolution_step(run->evolution, &err), &err);
    run->steps++;
    run->view = cps_evolution_line_view(run->evolution, 0);
    run->report = cps_evolution_line_report(run->evolution, 0);
    if (run->report.outcome != CPS_OUTCOME_SOLVED) return run->report.outcome;
    run->solved++;
    for (int k = 0; k < RIG_OBSTACLES; k++) turn[k] *= run->report.share;
    const Audit audit = rig_audit(&run->rig->scene, turn, &run->view);
    check(run, &audit);
    return CPS_OUTCOME_SOLVED;
}

CpsLineView rig_step(RigRun *run) {
    const CpsOutcome outcome = rig_try(run);
    if (outcome != CPS_OUTCOME_SOLVED)
        print_error("step %d: %s\n", run->steps, cps_outcome_text(outcome));
    CHECK_INT(outcome, CPS_OUTCOME_SOLVED);
    return run->view;
}

CpsLineView rig_next(RigRun *run) {
    const int stage = run->stage;
    do rig_step(run);
    while (run->stage == stage && cps_evolution_remaining_count(run->evolution) > 0);
    return run->view;
}

void rig_close(RigRun *run) { cps_evolution_destroy(run->evolution); }

double rig_tension(const CpsLineView *view, int e) { return norm(&view->segment_force[3 * e]); }

double rig_show(const char *name, const char *figure, double expected, double found) {
    printf("%-28s | %-34s | %18.11g | %18.11g | %10.2e\n", name, figure, expected, found,
           found - expected);
    return found - expected;
}
