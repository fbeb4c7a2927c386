/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on ground and on surfaces given as functions: one answer for one plane in three forms; a
 * large ball against its tangent plane; a ground sampled from waves against the waves; capstan laws
 * on the tube of a torus and along the geodesic of a cone; forces on both sides of a cell's edge.
 *
 * A weightless line that slides along a geodesic has T' = mu kappa T with the curvature kappa of
 * the geodesic, so that the ratio of the tensions is exp(mu int kappa ds). On the tube of radius r
 * that is the angle turned. On a cone of half angle alpha the geodesic is straight in the unrolled
 * cone; with its polar angle beta there, 0 where it is nearest to the tip, int kappa ds is
 * (sin beta2 - sin beta1)/tan alpha. */
#include <stdio.h>
#include <string.h>

#include "rig.h"

/* ---- one plane in three forms ---- */

static const double SLOPE[3] = {-0.2, 0.1, 1};

static double tilted(void *user, const double x[3], double gradient[3]) {
    const double by = *(const double *)user;
    for (int k = 0; k < 3; k++) gradient[k] = by * SLOPE[k];
    return by * (SLOPE[0] * x[0] + SLOPE[1] * x[1] + SLOPE[2] * x[2]);
}

enum { COLUMNS = 161, ROWS = 121 };

static double x[COLUMNS], y[ROWS], z[COLUMNS * ROWS];

/* A ground of columns x rows points from -20 to 20 and from -15 to 15. */
static CpsGround *sampled(int columns, int rows, double (*height)(double, double)) {
    CpsGroundGrid grid = cps_ground_grid_default();
    CpsGround *ground = NULL;
    CpsError err = {0};
    for (int i = 0; i < columns; i++) x[i] = -20 + 40.0 * i / (columns - 1);
    for (int j = 0; j < rows; j++) y[j] = -15 + 30.0 * j / (rows - 1);
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) z[j * columns + i] = height(x[i], y[j]);
    grid.x_count = columns;
    grid.y_count = rows;
    grid.x = x;
    grid.y = y;
    grid.z = z;
    if (cps_ground_create(&grid, &ground, &err)) fail_msg("%s", err.message);
    return ground;
}

static double plane_height(double a, double b) { return 0.2 * a - 0.1 * b; }

enum { ELEMENTS = 110, STEPS = 6 };

/* Positions and the largest force of all steps of a line that is laid down and dragged about. */
typedef struct Track {
    double place[STEPS + 1][3 * (ELEMENTS + 1)], force[STEPS + 1][ELEMENTS], largest;
} Track;

static void lay(Rig *rig, const CpsObstacle *bed, double lift) {
    rig_begin(rig, ELEMENTS, 30, 1e6);
    rig->line.length = 22;
    rig->line.start.kind = CPS_START_STATIC;
    CpsObstacle *first = rig_obstacle(rig, bed->kind, 0.4);
    const char *name = first->name;
    *first = *bed;
    first->name = name;
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, -8, 1, 5 + lift);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, 9, -2, 6 + lift);
    rig_stage(rig, STEPS / 2);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, 11.5, 3, 6 + lift);
    rig_stage(rig, STEPS / 2);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, 8, -4, 5 + lift);
}

static void follow(const CpsObstacle *bed, double lift, Track *track) {
    Rig rig;
    lay(&rig, bed, lift);
    RigRun run = rig_open(&rig);
    track->largest = 0;
    for (int s = 0; s <= STEPS; s++) {
        const CpsLineView view = rig_step(&run);
        memcpy(track->place[s], view.position, sizeof track->place[s]);
        for (int e = 0; e < ELEMENTS; e++) {
            track->force[s][e] = rig_tension(&view, e);
            track->largest = fmax(track->largest, track->force[s][e]);
        }
    }
    rig_close(&run);
}

/* [m] The largest distance of two places, per length of the line; and the largest difference of two
 * forces, per largest force. */
static double apart(const Track *a, const Track *b, double *force) {
    double worst = 0;
    *force = 0;
    for (int s = 0; s <= STEPS; s++) {
        for (int i = 0; i < 3 * (ELEMENTS + 1); i++)
            worst = fmax(worst, fabs(a->place[s][i] - b->place[s][i]) / 22);
        for (int e = 0; e < ELEMENTS; e++)
            *force = fmax(*force, fabs(a->force[s][e] - b->force[s][e]) / a->largest);
    }
    return worst;
}

static CpsObstacle bed_of(CpsObstacleKind kind) {
    CpsObstacle bed = cps_obstacle_default();
    bed.kind = kind;
    bed.friction = 0.4;
    return bed;
}

static void one_plane_in_three_forms(void **state) {
    (void)state;
    static Track plane, other;
    CpsObstacle bed = bed_of(CPS_OBSTACLE_PLANE);
    memcpy(bed.normal, SLOPE, sizeof SLOPE);
    follow(&bed, 0, &plane);
    double force, by[] = {1, 1e-3, 1e6};
    bed = bed_of(CPS_OBSTACLE_GROUND);
    CpsGround *ground = sampled(41, 31, plane_height);
    bed.ground = ground;
    follow(&bed, 0, &other);
    CHECK_LESS(rig_show("one plane", "grid, places per length", 0, apart(&plane, &other, &force)),
               1e-10);
    CHECK_LESS(rig_show("one plane", "grid, forces per largest", 0, force), 1e-8);
    cps_ground_release(ground);
    for (int k = 0; k < 3; k++) {
        bed = bed_of(CPS_OBSTACLE_SURFACE);
        bed.surface = (CpsSurface){.function = tilted, .user = &by[k], .size = 1};
        bed.point[0] = 7; /* in the plane, 7 m farther */
        bed.point[2] = 1.4;
        follow(&bed, 0, &other);
        CHECK_LESS(rig_show("one plane", "function, places per length", 0,
                            apart(&plane, &other, &force)),
                   1e-10);
        CHECK_LESS(rig_show("one plane", "function, forces per largest", 0, force), 1e-8);
    }
}

/* ---- a large ball ---- */

/* A ball of radius R that touches the plane z = 0 from below at the origin. */
static double ball(void *user, const double p[3], double gradient[3]) {
    const double R = *(const double *)user;
    for (int k = 0; k < 3; k++) gradient[k] = p[k];
    gradient[2] += R;
    return (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / 2 + R * p[2];
}

static void large_ball(void **state) {
    (void)state;
    static Track plane, other;
    CpsObstacle bed = bed_of(CPS_OBSTACLE_PLANE);
    follow(&bed, 0, &plane);
    for (int k = 3; k <= 5; k++) {
        double radius = 22 * pow(10, k), force;
        bed = bed_of(CPS_OBSTACLE_SURFACE);
        bed.surface = (CpsSurface){.function = ball, .user = &radius, .size = 1};
        follow(&bed, 0, &other);
        char figure[64];
        snprintf(figure, sizeof figure, "ball of 1e%d lengths, places per length", k);
        /* it lies up to (L/2)^2/(2 R) lower, and less friction holds it: C = 10 with a margin */
        CHECK_BETWEEN(rig_show("large ball", figure, 0, apart(&plane, &other, &force)),
                      1e-3 * pow(10, -k), 10 * pow(10, -k));
        CHECK_LESS(force, 10 * pow(10, -k));
    }
}

/* ---- waves ---- */

static double wave_height(double a, double b) { return 0.4 * (sin(0.7 * a) + cos(0.7 * b)); }

static double waves(void *user, const double p[3], double gradient[3]) {
    (void)user;
    gradient[0] = -0.28 * cos(0.7 * p[0]);
    gradient[1] = 0.28 * sin(0.7 * p[1]);
    gradient[2] = 1;
    return p[2] - wave_height(p[0], p[1]);
}

/* The cubic is off by a third power of the spacing, its slopes by a second one. */
static void waves_converge(void **state) {
    (void)state;
    static Track exact, other;
    CpsObstacle bed = bed_of(CPS_OBSTACLE_SURFACE);
    bed.surface = (CpsSurface){.function = waves, .size = 0.2};
    follow(&bed, 0.5, &exact);
    double before = 0;
    for (int by = 1; by <= 4; by *= 2) {
        double force;
        bed = bed_of(CPS_OBSTACLE_GROUND);
        CpsGround *ground = sampled(40 * by + 1, 30 * by + 1, wave_height);
        bed.ground = ground;
        follow(&bed, 0.5, &other);
        char figure[64];
        snprintf(figure, sizeof figure, "cells of %g m, places per length", 1.0 / by);
        const double off = rig_show("waves", figure, 0, apart(&exact, &other, &force));
        if (by > 1) CHECK_LESS(off, before / 3); /* of second order at least, with a margin */
        before = off;
        cps_ground_release(ground);
    }
    CHECK_LESS(before, 2e-4);
}

/* ---- capstan laws ---- */

/* The tube of radius 1 of a torus of radius 3 about z, moved so that the tube's axis goes through
 * the origin along y. */
static double torus(void *user, const double p[3], double gradient[3]) {
    (void)user;
    const double a = p[0] + 3, out = hypot(a, p[1]), beyond = out - 3;
    gradient[0] = 2 * beyond * a / out;
    gradient[1] = 2 * beyond * p[1] / out;
    gradient[2] = 2 * p[2];
    return beyond * beyond + p[2] * p[2] - 1;
}

/* A cone of half angle 0.5 about z with its tip at the origin, solid below it. */
static const double ALPHA = 0.5;

static double cone(void *user, const double p[3], double gradient[3]) {
    (void)user;
    const double out = hypot(p[0], p[1]);
    gradient[0] = p[0] / out;
    gradient[1] = p[1] / out;
    gradient[2] = tan(ALPHA);
    return out + p[2] * tan(ALPHA);
}

/* A place on a curve by its parameter. */
typedef void Curve(double s, double out[3]);

static void meridian(double s, double out[3]) {
    out[0] = cos(s);
    out[1] = 0;
    out[2] = sin(s);
}

/* The geodesic of the cone at distance 2 from the tip, by its arc length. */
static void geodesic(double s, double out[3]) {
    const double rho = hypot(2, s), around = atan2(s, 2) / sin(ALPHA);
    out[0] = rho * sin(ALPHA) * cos(around);
    out[1] = rho * sin(ALPHA) * sin(around);
    out[2] = -rho * cos(ALPHA);
}

/* The ratio of the tensions of a line with n + 1 nodes on a curve from s1 to s2 and straight leads,
 * held at B, where it is drawn, and pulled by 1 N at A. */
static double drawn(CpsSurfaceFunction *function, Curve *curve, double s1, double s2, double mu,
                    int n) {
    Rig rig;
    rig_begin(&rig, n + 2, 0, INFINITY);
    CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_SURFACE, mu);
    o->surface = (CpsSurface){.function = function, .size = 0.05};
    double lead[2][3], at[3], tip[2][3];
    for (int end = 0; end < 2; end++) { /* tangents, outwards */
        const double s = end ? s2 : s1, h = end ? 1e-5 : -1e-5;
        double ahead[3], behind[3], size = 0;
        curve(s + h, ahead);
        curve(s - h, behind);
        curve(s, at);
        for (int k = 0; k < 3; k++) size += (ahead[k] - behind[k]) * (ahead[k] - behind[k]);
        for (int k = 0; k < 3; k++) {
            lead[end][k] = (ahead[k] - behind[k]) / sqrt(size);
            tip[end][k] = at[k] + lead[end][k];
        }
    }
    rig_point(&rig, tip[0][0], tip[0][1], tip[0][2]);
    for (int j = 0; j <= n; j++) {
        curve(s1 + (s2 - s1) * j / n, at);
        rig_point(&rig, at[0], at[1], at[2]);
    }
    rig_point(&rig, tip[1][0], tip[1][1], tip[1][2]);
    for (int e = 0; e < n + 2; e++) {
        const double *a = &rig.point[3 * e];
        rig.element_length[e] = sqrt((a[3] - a[0]) * (a[3] - a[0]) + (a[4] - a[1]) * (a[4] - a[1]) +
                                     (a[5] - a[2]) * (a[5] - a[2]));
    }
    rig_graded(&rig);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, lead[0][0], lead[0][1], lead[0][2]);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 1);
    const double by = 1e-4; /* far enough to slide, near enough to leave the angles alone */
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, tip[1][0] + by * lead[1][0],
               tip[1][1] + by * lead[1][1], tip[1][2] + by * lead[1][2]);
    RigRun run = rig_open(&rig);
    const CpsLineView view = rig_step(&run);
    const double ratio = rig_tension(&view, n + 1) / rig_tension(&view, 0);
    rig_close(&run);
    return ratio;
}

static void converges(const char *name, CpsSurfaceFunction *function, Curve *curve, double s1,
                      double s2, double mu, double turned) {
    double before = 0;
    for (int n = 20; n <= 160; n *= 2) {
        char figure[48];
        snprintf(figure, sizeof figure, "mu %g, ratio, n = %d", mu, n);
        const double exact = exp(mu * turned),
                     off = rig_show(name, figure, exact, drawn(function, curve, s1, s2, mu, n));
        /* the nodes' sum is that of trapezoids, of second order; the slide of 1e-4 changes the
         * angles at the ends by less than 1e-6 of the ratio */
        if (n > 20) CHECK_LESS(fabs(off), fabs(before) / 3.7 + 1e-6 * exact);
        before = off;
    }
    CHECK_LESS(fabs(before), 1e-4 * exp(mu * turned));
}

static void capstan_on_a_torus(void **state) {
    (void)state;
    converges("torus' tube", torus, meridian, -0.9, 1.1, 0.3, 2);
    converges("torus' tube", torus, meridian, -0.9, 1.1, 1, 2);
}

static void capstan_on_a_cone(void **state) {
    (void)state;
    const double turned = (sin(atan2(2.5, 2)) + sin(atan2(1, 2))) / tan(ALPHA);
    converges("cone's geodesic", cone, geodesic, -1, 2.5, 0.3, turned);
}

/* ---- an edge of cells ---- */

/* A loaded node on a random ground: its forces with the edge of a cell 1e-9 of a cell to its left
 * and to its right. */
static double rough_height(double a, double b) {
    const double h = sin(12.9898 * a + 78.233 * b) * 43758.5453;
    return 0.4 * (h - floor(h)) + 0.1 * a;
}

static void forces_agree_across_edges(void **state) {
    (void)state;
    CpsGround *ground = sampled(41, 31, rough_height);
    for (int along = 0; along < 2; along++)
        for (int k = 0; k < 12; k++) {
            double force[2][3];
            for (int side = 0; side < 2; side++) {
                Rig rig;
                rig_begin(&rig, 2, 10, 1e5);
                CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_GROUND, 0.5);
                o->ground = ground;
                double p[3] = {-3 + k, 2 - k % 4, 0};
                p[along] += (side ? 1 : -1) * 1e-9;
                p[2] = cps_ground_height(ground, p[0], p[1], NULL);
                rig_point(&rig, p[0] - 1.5, p[1], p[2] + 1.5);
                rig_point(&rig, p[0], p[1], p[2]);
                rig_point(&rig, p[0] + 1.5, p[1], p[2] + 1.5);
                rig_length(&rig, 3 * sqrt(2) * (1 - 1e-4));
                rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
                rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
                rig_stage(&rig, 1);
                rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, p[0] + 1.5, p[1], p[2] + 1.4);
                RigRun run = rig_open(&rig);
                const CpsLineView view = rig_step(&run);
                for (int i = 0; i < 3; i++)
                    force[side][i] =
                        view.reaction[1] * view.normal[3 + i] + view.friction_force[3 + i];
                rig_close(&run);
            }
            const double weight = 10 * 1.5 * sqrt(2);
            CHECK_VECTOR(force[1], force[0], 1e-6 * weight);
        }
    cps_ground_release(ground);
}

/* ---- friction by zone, and edges ---- */

static double level(double a, double b) {
    (void)a;
    (void)b;
    return 0;
}

/* A taut line on level ground whose friction grows along x: what is needed to draw it is the
 * integral of mu w, which the nodes' trapezoids give exactly. */
static void friction_by_zone(void **state) {
    (void)state;
    enum { N = 40 };
    double factor[2 * 2] = {0, 2, 0, 2}, grid_x[2] = {0, 10}, grid_y[2] = {-1, 1}, flat[4] = {0};
    CpsGroundGrid grid = cps_ground_grid_default();
    CpsGround *ground = NULL;
    CpsError err = {0};
    grid.x_count = grid.y_count = 2;
    grid.x = grid_x;
    grid.y = grid_y;
    grid.z = flat;
    grid.friction_factor = factor;
    if (cps_ground_create(&grid, &ground, &err)) fail_msg("%s", err.message);
    Rig rig;
    rig_begin(&rig, N, 7, 1e9);
    CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_GROUND, 0.3);
    o->ground = ground;
    rig_point(&rig, 1, 0, 0);
    rig_point(&rig, 9, 0, 0);
    rig_length(&rig, 8);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 9.5, 0, 0);
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    for (int k = 0; k < 2; k++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        CHECK_INT(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    }
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    /* from end A, now at 1.5 m, to the last element, less the held end's share of half of it */
    const double half = 4.0 / N, last = 9.5 - half,
                 exact = 0.3 * 0.1 * 7 * (last * last - 1.5 * 1.5 - half * half),
                 found = rig_tension(&view, N - 1);
    /* a node has the coefficient of its place: the half element at end A is (l/2)^2/2 times the
     * slope short */
    CHECK_LESS(fabs(rig_show("friction by zone", "pull [N]", exact, found)), 1e-5);
    cps_evolution_destroy(evolution);
    evolution = NULL;
    /* beyond its edge the ground is unknown */
    rig_begin(&rig, N, 7, 1e9);
    o = rig_obstacle(&rig, CPS_OBSTACLE_GROUND, 0.3);
    o->ground = ground;
    rig_point(&rig, 1, 0, 0);
    rig_point(&rig, 9, 0, 0);
    rig_length(&rig, 8);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 1);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 10.5, 0, 0);
    CHECK_INT(cps_evolution_create(&rig.scene, &evolution, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "beyond the grid of ground 'first'"));
    cps_ground_release(ground);
}

/* A line that is blown off the grid is refused, and no step follows. */
static void leaves_the_grid(void **state) {
    (void)state;
    CpsGround *ground = sampled(41, 31, level);
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    Rig rig;
    rig_begin(&rig, 20, 7, 1e9);
    CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_GROUND, 0.3);
    o->ground = ground;
    rig_point(&rig, 9, 0, 0);
    rig_point(&rig, 19, 0, 0);
    rig_length(&rig, 10);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
    rig_stage(&rig, 2);
    rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, 19.5, 0, 6);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_FREE, 900, 0, 0);
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    CpsStatus status = CPS_OK;
    int steps = 0;
    while (status == CPS_OK && cps_evolution_remaining_count(evolution) > 0) {
        status = cps_evolution_step(evolution, &err);
        steps++;
    }
    CHECK_INT(status, CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "has left the grid of ground 'first'"));
    CHECK_INT(cps_evolution_remaining_count(evolution), 0);
    cps_evolution_destroy(evolution);
    cps_ground_release(ground);
}

/* A move that takes a line off the grid is refused: the state before it stands, and another move is
 * taken from there. */
static void another_move_is_taken(void **state) {
    (void)state;
    CpsGround *ground = sampled(41, 31, level);
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    Rig rig;
    rig_begin(&rig, 20, 7, 1e9);
    CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_GROUND, 0.3);
    o->ground = ground;
    rig_point(&rig, 9, 0, 0);
    rig_point(&rig, 19, 0, 0);
    rig_length(&rig, 10);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    const CpsChange off[] = {{.line = 0, .end = CPS_END_A, .to = {CPS_END_KIND_HELD, {19.5, 0, 6}}},
                             {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {900, 0, 0}}}},
                    back = {.line = 0, .end = CPS_END_A, .to = {CPS_END_KIND_HELD, {8, 0, 0}}};
    CpsStage move = cps_stage_default();
    move.change_count = 2;
    move.change = off;
    CHECK_INT(cps_evolution_move(evolution, &move, &err), CPS_ERR_ARGUMENT);
    assert_non_null(strstr(err.message, "has left the grid of ground 'first'"));
    const CpsLineView stood = cps_evolution_line_view(evolution, 0);
    for (int j = 0; j <= stood.element_count; j++)
        CHECK_NEAR(stood.position[3 * j], 9 + 10.0 * j / stood.element_count, 1e-12);
    move.change_count = 1;
    move.change = &back;
    if (cps_evolution_move(evolution, &move, &err)) fail_msg("%s", err.message);
    const CpsStepReport report = cps_evolution_report(evolution);
    CHECK_INT(report.outcome, CPS_OUTCOME_SOLVED);
    CHECK_INT(report.step_count, 1);
    cps_evolution_destroy(evolution);
    cps_ground_release(ground);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_plane_in_three_forms), cmocka_unit_test(large_ball),
        cmocka_unit_test(waves_converge),           cmocka_unit_test(capstan_on_a_torus),
        cmocka_unit_test(capstan_on_a_cone),        cmocka_unit_test(forces_agree_across_edges),
        cmocka_unit_test(friction_by_zone),         cmocka_unit_test(leaves_the_grid),
        cmocka_unit_test(another_move_is_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
