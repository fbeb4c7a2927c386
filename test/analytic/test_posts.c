/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines against posts and balls that are thin beside their elements: nodes are kept out of them,
 * and so are elements.
 *
 * A line of 2 m, EA = 1e4 N, stretched by 1 %, is carried sideways against a post by both of its
 * ends. Without friction the exact line is a string over the post: two tangents and an arc. The
 * discrete line is a chain, whose chords penetrate by up to min(l^2/(4 R), R/4). */
#include <stdio.h>

#include "rig.h"

static const double LENGTH = 2, STIFFNESS = 1e4, STRETCH = 1.01;

/* m below an obstacle of radius R at which an element of natural length l lies at most */
static double allowed(double l, double radius) { return fmin(l * l / (4 * radius), radius / 4); }

/* The deepest place of any element in any obstacle, at 200 places of each, beyond what is
 * allowed. */
static double deepest(const Rig *rig, const CpsLineView *v) {
    double worst = -INFINITY;
    for (int i = 0; i < rig->scene.obstacle_count * v->element_count * 201; i++) {
        const int e = i / 201 % v->element_count;
        const CpsObstacle *o = &rig->scene.obstacle[i / 201 / v->element_count];
        double from[3];
        for (int k = 0; k < 3; k++) {
            const double a = v->position[3 * e + k], b = v->position[3 * e + 3 + k];
            from[k] = a + (b - a) * (i % 201) / 200 - o->point[k];
        }
        const double out = o->kind == CPS_OBSTACLE_SPHERE ? hypot(hypot(from[0], from[1]), from[2])
                                                          : hypot(from[0], from[1]);
        worst = fmax(worst, o->radius - out - allowed(v->element_length[e], o->radius));
    }
    return worst;
}

/* A line along x at height `below`, its middle `off` beside the obstacle's axis (z) or centre, is
 * taken to height `above`. */
static RigRun pose(Rig *rig, CpsObstacleKind kind, double radius, double mu, int elements,
                   double off, double below, double above, int steps) {
    const double half = 0.5 * STRETCH * LENGTH;
    rig_begin(rig, elements, 0, STIFFNESS);
    rig_length(rig, LENGTH);
    rig_obstacle(rig, kind, mu);
    CpsObstacle *o = (CpsObstacle *)(uintptr_t)&rig->scene.obstacle[0];
    o->radius = radius;
    for (int k = 0; k < 3; k++) {
        o->point[k] = 0;
        o->axis[k] = k == 2;
    }
    rig_point(rig, off - half, below, 0);
    rig_point(rig, off + half, below, 0);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, off - half, below, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, off + half, below, 0);
    rig_stage(rig, steps);
    rig_change(rig, CPS_END_A, CPS_END_KIND_HELD, off - half, above, 0);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, off + half, above, 0);
    return rig_open(rig);
}

/* Every step is solved, passes the audit, and no element lies deeper than its chord may. */
static void carry(const char *name, CpsObstacleKind kind, double radius, double mu, double h,
                  double off, int steps) {
    static Rig rig;
    RigRun run = pose(&rig, kind, radius, mu, (int)(LENGTH / h + 0.5), off, -1.5 * radius - 0.02,
                      0.2, steps);
    double worst = -INFINITY, least = INFINITY;
    for (int k = 0; k < steps; k++) {
        const CpsLineView view = rig_step(&run);
        worst = fmax(worst, deepest(&rig, &view));
        CHECK_LESS(run.report.certificate.element_penetration, 1e-10 * LENGTH);
        for (int e = 0; e < view.element_count; e++) least = fmin(least, view.element_reaction[e]);
    }
    rig_show(name, "deepest element beyond its chord [m]", 0, fmax(0, worst));
    /* rounds end where nothing is deeper than 1e-10 of the length */
    CHECK_LESS(worst, 1e-9);
    CHECK_LESS(-least, 1e-300);
    rig_close(&run);
}

static void thin_posts(void **state) {
    (void)state;
    carry("R = 0.05, h = 0.1, one step", CPS_OBSTACLE_CYLINDER, 0.05, 0.3, 0.1, 0.026, 1);
    carry("R = 0.05, h = 0.1", CPS_OBSTACLE_CYLINDER, 0.05, 0.3, 0.1, 0.026, 4);
    carry("R = 0.08, h = 0.2", CPS_OBSTACLE_CYLINDER, 0.08, 0.3, 0.2, 0.07, 20);
    carry("R = 0.01, h = 0.1", CPS_OBSTACLE_CYLINDER, 0.01, 0.3, 0.1, 0.026, 100);
    carry("R = 0.01, h = 0.1, smooth", CPS_OBSTACLE_CYLINDER, 0.01, 0, 0.1, 0.026, 50);
}

/* The tension over a smooth post against that of a string, at h from two radii down. The nodes lie
 * on the post in the end, and a chord of it is shorter than its arc by h^3/(24 R^2): in all by turn
 * h^2/(24 R), and by up to h^3/(6 R^2) at either end of the arc, where the string leaves the post
 * within an element. */
static void order(void **state) {
    (void)state;
    static Rig rig;
    const double radius = 0.1, above = 0.2, half = 0.5 * STRETCH * LENGTH,
                 quarter = 1.57079632679489661923;
    const double r = hypot(half, above), straight = sqrt(r * r - radius * radius);
    const double turn = 2 * (quarter + atan2(above, half) - acos(radius / r));
    const double exact = STIFFNESS * ((2 * straight + radius * turn) / LENGTH - 1);
    for (int n = 10; n <= 640; n *= 4) {
        RigRun run = pose(&rig, CPS_OBSTACLE_CYLINDER, radius, 0, n, 0.0, -0.2, above, 4);
        CpsLineView view = {0};
        for (int i = 0; i < 4; i++) view = rig_step(&run);
        const double h = LENGTH / n,
                     off = rig_show("smooth post", "tension [N]", exact, rig_tension(&view, 0));
        const double chords =
            fmin(radius * turn * turn * turn, h * h / radius * (turn + 8 * h / radius)) / 24;
        CHECK_LESS(fabs(off), STIFFNESS / LENGTH * (h < radius ? chords : 2 * allowed(h, radius)));
        rig_close(&run);
    }
}

/* The element that alone lies on the post, -1 where there is none or a node lies there. */
static int across(const CpsLineView *v) {
    int one = -1;
    for (int j = 0; j <= v->element_count; j++)
        if (v->reaction[j] > 0) return -1;
    for (int e = 0; e < v->element_count; e++)
        if (v->element_reaction[e] > 0) one = one < 0 ? e : v->element_count;
    return one < v->element_count ? one : -1;
}

/* A line without weight is pulled through over a post, one of its elements sliding across: what the
 * ends work is what friction dissipates, but for what a step leaves, which is of first order. An
 * element slides at the depth at which it lies. */
static void work(void **state) {
    (void)state;
    static Rig rig;
    for (int i = 0; i < 4; i++) {
        const CpsObstacleKind kind = i % 2 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER;
        const double h = i < 2 ? 0.2 : 0.1, radius = i < 2 ? 0.02 : 0.06, pull = 10;
        rig_begin(&rig, (int)(LENGTH / h + 0.5), 0, i < 2 ? INFINITY : STIFFNESS);
        rig_length(&rig, LENGTH);
        CpsObstacle *o = rig_obstacle(&rig, kind, 0.2);
        o->radius = radius;
        o->axis[1] = 0;
        o->axis[2] = 1;
        rig_point(&rig, -1.03, -0.15, 0);
        rig_point(&rig, 0.97, -0.15, 0);
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, -1.03, -0.15, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, pull, 0, 0);
        rig_stage(&rig, 10);
        rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, -1.03, 0.4, 0);
        rig_stage(&rig, 40);
        rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, -1.13, 0.44, 0);
        RigRun run = rig_open(&rig);
        rig_next(&run);
        double dissipated = 0, worked = 0;
        int steps = 0, before = -1;
        for (int k = 0; k < 40; k++) {
            const CpsLineView v = rig_step(&run);
            const CpsLedger ledger = cps_evolution_line_report(run.evolution, 0).ledger;
            const int now = across(&v);
            if (k >= 5 && now >= 0 && now == before) /* from when all slides this way */
            {
                steps++;
                dissipated += ledger.dissipated;
                worked += ledger.ends - ledger.elastic;
            }
            before = now;
        }
        printf("%s, h/R = %g: in %d steps the ends worked %.6g J more than went into the line, and "
               "%.6g J were dissipated\n",
               kind == CPS_OBSTACLE_SPHERE ? "ball" : "post", h / radius, steps, worked,
               dissipated);
        CHECK_GREATER(steps, 5);
        CHECK_RELATIVE(worked, dissipated, 0.02);
        rig_close(&run);
    }
}

/* A line without weight, drawn up over a thin post, turns at both nodes of the element that lies on
 * it, by d in all. With the two forces beside it the contact's makes the same triangle as at a
 * node: tensions are held up to k = cos(d/2 - phi)/cos(d/2 + phi), mu = tan(phi), and from mu
 * tan(d/2) = 0.9 on the mesh is too coarse. */
static void bends(void **state) {
    (void)state;
    static Rig rig;
    int told = 0, coarse = 0;
    for (int i = 0; i < 12; i++) {
        const double mu = 0.1 + 0.1 * i, phi = atan(mu), off = 0.03 + 0.01 * (i % 3);
        RigRun run = pose(&rig, i % 2 ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER, 0.01, mu, 10,
                          off, -0.05, 1, 20);
        cps_evolution_destroy(run.evolution);
        rig.line.stiffness = 100;
        run = rig_open(&rig);
        for (int k = 0; k < 20; k++) {
            const CpsOutcome outcome = rig_try(&run);
            const CpsLineView v = cps_evolution_line_view(run.evolution, 0);
            const CpsLineReport r = cps_evolution_line_report(run.evolution, 0);
            const int e = across(&v);
            if (e < 1 || e + 1 >= v.element_count || !(v.element_friction_bound[e] > 0)) continue;
            const double *x = &v.position[3 * e];
            const double d = acos(((x[0] - x[-3]) * (x[6] - x[3]) + (x[1] - x[-2]) * (x[7] - x[4]) +
                                   (x[2] - x[-1]) * (x[8] - x[5])) /
                                  (hypot(hypot(x[0] - x[-3], x[1] - x[-2]), x[2] - x[-1]) *
                                   hypot(hypot(x[6] - x[3], x[7] - x[4]), x[8] - x[5])));
            if (d < 0.05)
                continue; /* an angle by its cosine: to 1e-15/d, and forces are along elements to
                             the root of the gap */
            const double low = cos(d / 2 + phi);
            CHECK_NEAR(r.bend.turn, d, 1e-6);
            CHECK_RELATIVE(r.bend.friction, mu, 1e-12);
            if (low > 0.02)
                CHECK_RELATIVE(r.bend.ratio, cos(d / 2 - phi) / low, 1e-4); /* 1e-6 over low */
            if (fabs(mu * tan(d / 2) - 0.9) < 1e-4) continue;
            CHECK_INT(outcome,
                      mu * tan(d / 2) >= 0.9 ? CPS_OUTCOME_MESH_TOO_COARSE : CPS_OUTCOME_SOLVED);
            told++;
            coarse += outcome == CPS_OUTCOME_MESH_TOO_COARSE;
        }
        rig_close(&run);
    }
    printf("%d bends of elements, %d too coarse\n", told, coarse);
    CHECK_GREATER(told - coarse, 40);
    CHECK_GREATER(coarse, 10);
}

/* Two thin posts side by side, nearer to each other than an element is long. An element has one
 * contact: where it would need two the step is not certified, and says which obstacle the element
 * is in and how deep. What is certified is clear of both. */
static void two_posts(void **state) {
    (void)state;
    static Rig rig;
    int certified = 0, pierced = 0;
    for (int i = 0; i < 6; i++) {
        const double apart = 0.05 + 0.02 * i;
        RigRun run =
            pose(&rig, CPS_OBSTACLE_CYLINDER, 0.01, 0.3, 5 + 5 * (i % 3), 0.013, -0.05, 0.3, 12);
        cps_evolution_destroy(run.evolution);
        rig.scene.solver.max_halvings = 3;
        rig.obstacle[0].point[0] = -apart / 2;
        CpsObstacle *other = rig_obstacle(&rig, CPS_OBSTACLE_CYLINDER, 0.3);
        other->radius = 0.01;
        other->point[0] = apart / 2;
        other->axis[1] = 0;
        other->axis[2] = 1;
        run = rig_open(&rig);
        for (int k = 0; k < 12; k++) {
            const CpsOutcome outcome = rig_try(&run);
            const CpsLineView v = cps_evolution_line_view(run.evolution, 0);
            const CpsLineReport r = cps_evolution_line_report(run.evolution, 0);
            if (outcome == CPS_OUTCOME_SOLVED) {
                CHECK_LESS(deepest(&rig, &v), 1e-9);
                certified++;
            } else if (r.certificate.element_penetration > 1e-10 * LENGTH) {
                assert_true(r.has_pierced_obstacle);
                CHECK_BETWEEN(r.pierced_obstacle, 0, 1);
                pierced++;
            }
        }
        rig_close(&run);
    }
    printf("two posts: %d steps certified, %d not for an element in one of them\n", certified,
           pierced);
    CHECK_GREATER(certified, 24);
    CHECK_GREATER(pierced, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(thin_posts), cmocka_unit_test(order),
                                       cmocka_unit_test(work), cmocka_unit_test(bends),
                                       cmocka_unit_test(two_posts)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
