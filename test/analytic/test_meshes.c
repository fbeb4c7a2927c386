/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on triangle meshes: one plane as a plane, a grid and a mesh; a cylinder against grids and
 * meshes of it; a mesh that is carried away with what lies on it; a rope over the rounded edge of a
 * block, whose tension obeys the capstan law. Every step is checked by rig.c, which looks at all
 * triangles. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"

enum { MOST = 60000 };

/* Triangles over a rectangle of columns x rows cells, whose corners are put into space. */
static double vertex[3 * MOST];
static int triangle[6 * MOST];

typedef void Place(double a, double b, double out[3]);

static CpsMesh *mesh_of(int columns, int rows, const double a[2], const double b[2], Place *place,
                        double shake) {
    CpsMeshTriangles of = cps_mesh_triangles_default();
    CpsMesh *mesh = NULL;
    CpsError err = {0};
    unsigned random = 1;
    int count = 0;
    assert_true((columns + 1) * (rows + 1) <= MOST);
    for (int j = 0; j <= rows; j++)
        for (int i = 0; i <= columns; i++) {
            double by[2] = {0, 0};
            for (int k = 0; k < 2; k++) {
                random = random * 1664525u + 1013904223u;
                const bool inner = i > 0 && i < columns && j > 0 && j < rows;
                if (inner) by[k] = shake * (random / 4294967296.0 - 0.5);
            }
            place(a[0] + (a[1] - a[0]) * (i + by[0]) / columns,
                  b[0] + (b[1] - b[0]) * (j + by[1]) / rows, &vertex[3 * (j * (columns + 1) + i)]);
        }
    for (int j = 0; j < rows; j++)
        for (int i = 0; i < columns; i++) {
            const int at = j * (columns + 1) + i, up = at + columns + 1;
            const int both[6] = {at, at + 1, up + 1, at, up + 1, up};
            memcpy(&triangle[3 * count], both, sizeof both);
            count += 2;
        }
    of.vertex_count = (columns + 1) * (rows + 1);
    of.vertex = vertex;
    of.triangle_count = count;
    of.triangle = triangle;
    if (cps_mesh_create(&of, &mesh, &err)) fail_msg("%s", err.message);
    return mesh;
}

static CpsObstacle bed_of(CpsObstacleKind kind, double radius, const CpsMesh *mesh) {
    CpsObstacle bed = cps_obstacle_default();
    bed.kind = kind;
    bed.friction = 0.4;
    bed.radius = radius;
    bed.mesh = mesh;
    return bed;
}

/* ---- a line that is laid down and dragged about ---- */

enum { ELEMENTS = 110, STEPS = 24 };
static const double LENGTH = 22;

typedef struct Track {
    double place[STEPS + 1][3 * (ELEMENTS + 1)], force[STEPS + 1][ELEMENTS], largest;
} Track;

static void follow(const CpsObstacle *bed, Track *track) {
    Rig rig;
    rig_begin(&rig, ELEMENTS, 30, 1e6);
    rig.line.length = LENGTH;
    rig.line.start.kind = CPS_START_STATIC;
    CpsObstacle *first = rig_obstacle(&rig, bed->kind, 0.4);
    const char *name = first->name;
    *first = *bed;
    first->name = name;
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, -8, 1, 5);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, 9, -2, 6);
    rig_stage(&rig, STEPS / 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 11.5, 3, 6);
    rig_stage(&rig, STEPS / 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 8, -4, 5);
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

/* The largest distance of two places per length, and difference of two forces per largest one. */
static double apart(const Track *a, const Track *b, double *force) {
    double worst = 0;
    *force = 0;
    for (int s = 0; s <= STEPS; s++) {
        for (int i = 0; i < 3 * (ELEMENTS + 1); i++)
            worst = fmax(worst, fabs(a->place[s][i] - b->place[s][i]) / LENGTH);
        for (int e = 0; e < ELEMENTS; e++)
            *force = fmax(*force, fabs(a->force[s][e] - b->force[s][e]) / a->largest);
    }
    return worst;
}

/* ---- one plane ---- */

static const double SLOPE[3] = {-0.2, 0.1, 1};
static double lowered;

static void on_the_slope(double a, double b, double out[3]) {
    const double size = sqrt(1 + 0.2 * 0.2 + 0.1 * 0.1);
    out[0] = a;
    out[1] = b;
    out[2] = 0.2 * a - 0.1 * b;
    for (int k = 0; k < 3; k++) out[k] -= lowered * SLOPE[k] / size;
}

static void one_plane(void **state) {
    (void)state;
    static Track plane, other;
    static const double WIDE[2] = {-20, 20}, TALL[2] = {-15, 15};
    CpsObstacle bed = bed_of(CPS_OBSTACLE_PLANE, 0, NULL);
    memcpy(bed.normal, SLOPE, sizeof SLOPE);
    follow(&bed, &plane);
    const double radius[] = {1e-2, 0.5, 5};
    for (int k = 0; k < 3; k++) {
        double force;
        lowered = radius[k];
        CpsMesh *mesh = mesh_of(20, 15, WIDE, TALL, on_the_slope, 0.5);
        bed = bed_of(CPS_OBSTACLE_MESH, radius[k], mesh);
        follow(&bed, &other);
        char figure[64];
        snprintf(figure, sizeof figure, "mesh, radius %g m, places per length", radius[k]);
        CHECK_LESS(rig_show("one plane", figure, 0, apart(&plane, &other, &force)), 1e-10);
        CHECK_LESS(rig_show("one plane", "mesh, forces per largest", 0, force), 1e-8);
        cps_mesh_release(mesh);
    }
}

/* ---- a cylinder ---- */

static const double ROUND = 17; /* its slopes are up to 1 where the line may be */

/* a: the angle from the top, over 1 rad; b: along the axis. */
static void on_the_cylinder(double a, double b, double out[3]) {
    out[0] = (ROUND - lowered) * sin(a);
    out[1] = b;
    out[2] = (ROUND - lowered) * cos(a) - ROUND;
}

static CpsGround *grid_of(int columns) {
    static double x[801], z[1602];
    const double y[2] = {-15, 15};
    CpsGroundGrid grid = cps_ground_grid_default();
    CpsGround *ground = NULL;
    CpsError err = {0};
    for (int i = 0; i <= columns; i++) {
        x[i] = -14 + 28.0 * i / columns;
        z[i] = z[columns + 1 + i] = sqrt(ROUND * ROUND - x[i] * x[i]) - ROUND;
    }
    grid.x_count = columns + 1;
    grid.y_count = 2;
    grid.x = x;
    grid.y = y;
    grid.z = z;
    if (cps_ground_create(&grid, &ground, &err)) fail_msg("%s", err.message);
    return ground;
}

/* ", order 2.1", or nothing for the first one. */
static const char *order_of(double before, double now, char text[32]) {
    text[0] = '\0';
    if (before > 0) snprintf(text, 32, ", order %.1f", log(before / now) / log(2));
    return text;
}

static void one_cylinder(void **state) {
    (void)state;
    static Track exact, other;
    static const double WIDE[2] = {-0.9, 0.9}, TALL[2] = {-15, 15};
    CpsObstacle bed = bed_of(CPS_OBSTACLE_CYLINDER, ROUND, NULL);
    bed.point[2] = -ROUND;
    follow(&bed, &exact);
    double before = 0, force, first = 0;
    char figure[120], order[32];
    for (int columns = 14; columns <= 56; columns *= 2) {
        CpsGround *ground = grid_of(columns);
        bed = bed_of(CPS_OBSTACLE_GROUND, 0, NULL);
        bed.ground = ground;
        follow(&bed, &other);
        const double off = apart(&exact, &other, &force);
        snprintf(figure, sizeof figure, "grid of %d cells, places per length%s", columns,
                 order_of(before, off, order));
        rig_show("cylinder", figure, 0, off);
        if (columns == 14) first = off;
        before = off;
        cps_ground_release(ground);
    }
    /* the cubic is of third order; ways leave 1.7e-7 */
    CHECK_LESS(before, first / 50);
    lowered = 0.5;
    for (int columns = 30; columns <= 240; columns *= 2) {
        CpsMesh *mesh = mesh_of(columns, 3, WIDE, TALL, on_the_cylinder, 0);
        bed = bed_of(CPS_OBSTACLE_MESH, lowered, mesh);
        follow(&bed, &other);
        const double off = apart(&exact, &other, &force);
        snprintf(figure, sizeof figure, "mesh of %d faces round it, places per length%s", columns,
                 order_of(columns > 30 ? before : 0, off, order));
        rig_show("cylinder", figure, 0, off);
        if (columns == 30) first = off;
        before = off;
        cps_mesh_release(mesh);
    }
    /* faces are off by a second power of their width, three times halved, until they are as short
     * as the elements */
    CHECK_LESS(before, first / 40);
}

/* ---- a rounded edge ---- */

/* Two faces at a right angle, whose edge is rounded by 1 m; the rope lies across it. */
static void block(double a, double b, double out[3]) {
    out[0] = fmin(a, 0);
    out[1] = b;
    out[2] = -fmax(a, 0);
}

/* The ratio of the tensions of a weightless rope over the edge, pulled by 1 N at A and drawn at B:
 * n + 1 nodes over the angles 0.1 to 1.4 from the top. */
static double drawn(const CpsMesh *mesh, double mu, int n) {
    static const double FROM = 0.1, TO = 1.4;
    Rig rig;
    rig_begin(&rig, n + 2, 0, INFINITY);
    CpsObstacle *o = rig_obstacle(&rig, CPS_OBSTACLE_MESH, mu);
    o->mesh = mesh;
    o->radius = 1;
    rig_point(&rig, sin(FROM) - cos(FROM), 0, cos(FROM) + sin(FROM));
    for (int j = 0; j <= n; j++) {
        const double s = FROM + (TO - FROM) * j / n;
        rig_point(&rig, sin(s), 0, cos(s));
    }
    const double tip[3] = {sin(TO) + cos(TO), 0, cos(TO) - sin(TO)};
    rig_point(&rig, tip[0], 0, tip[2]);
    for (int e = 0; e < n + 2; e++) {
        const double *a = &rig.point[3 * e];
        rig.element_length[e] = hypot(a[3] - a[0], a[5] - a[2]);
    }
    rig_graded(&rig);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, -cos(FROM), 0, sin(FROM));
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 1);
    const double by = 1e-4; /* far enough to slide, near enough to leave the angles alone */
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, tip[0] + by * cos(TO), 0, tip[2] - by * sin(TO));
    RigRun run = rig_open(&rig);
    const CpsLineView view = rig_step(&run);
    const double ratio = rig_tension(&view, n + 1) / rig_tension(&view, 0);
    rig_close(&run);
    return ratio;
}

static void capstan_over_an_edge(void **state) {
    (void)state;
    static const double ACROSS[2] = {-5, 5}, ALONG[2] = {-5, 5};
    CpsMesh *mesh = mesh_of(10, 3, ACROSS, ALONG, block, 0);
    const double mu = 0.3, exact = exp(mu * 1.3);
    double before = 0;
    for (int n = 20; n <= 160; n *= 2) {
        char figure[48];
        snprintf(figure, sizeof figure, "ratio, n = %d", n);
        const double off = rig_show("edge of a block", figure, exact, drawn(mesh, mu, n));
        /* trapezoids: second order; the slide of 1e-4 changes the angles at the ends by less than
         * 1e-6 of the ratio */
        if (n > 20) CHECK_LESS(fabs(off), fabs(before) / 3.7 + 1e-6 * exact);
        before = off;
    }
    CHECK_LESS(fabs(before), 1e-4 * exact);
    cps_mesh_release(mesh);
}

/* ---- a table that moves ---- */

static void level(double a, double b, double out[3]) {
    out[0] = a;
    out[1] = b;
    out[2] = -lowered;
}

/* A rope on a table that is shifted, turned and tilted in 4 steps: the places after these. */
static void carried(const CpsObstacle *table, double out[3 * (ELEMENTS + 1)]) {
    Rig rig;
    rig_begin(&rig, ELEMENTS, 30, 1e6);
    rig.line.length = LENGTH;
    rig.line.start.kind = CPS_START_STRAIGHT;
    rig_point(&rig, -11, 0, 0);
    rig_point(&rig, 11, 0, 0);
    CpsObstacle *first = rig_obstacle(&rig, table->kind, 0.4);
    const char *name = first->name;
    *first = *table;
    first->name = name;
    first->moves = true;
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0); /* it sticks, also on the slope */
    rig_stage(&rig, 4);
    const CpsShift shift = {.by = {1, -0.5, 0.3}, .turn = {0.15, 0.1, 0.4}, .about = {2, 1, 0}};
    rig.stage[0].shift_count = 1;
    rig.stage[0].shift = &shift;
    CpsEvolution *evolution = NULL;
    CpsError err = {0};
    if (cps_evolution_create(&rig.scene, &evolution, &err)) fail_msg("%s", err.message);
    while (cps_evolution_remaining_count(evolution) > 0) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        assert_int_equal(cps_evolution_report(evolution).outcome, CPS_OUTCOME_SOLVED);
    }
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    memcpy(out, view.position, 3 * (ELEMENTS + 1) * sizeof *out);
    cps_evolution_destroy(evolution);
}

static void moving_table(void **state) {
    (void)state;
    static const double WIDE[2] = {-20, 20};
    double one[3 * (ELEMENTS + 1)], other[3 * (ELEMENTS + 1)], worst = 0;
    CpsObstacle table = bed_of(CPS_OBSTACLE_PLANE, 0, NULL);
    carried(&table, one);
    lowered = 0.3;
    CpsMesh *mesh = mesh_of(20, 20, WIDE, WIDE, level, 0.5);
    table = bed_of(CPS_OBSTACLE_MESH, lowered, mesh);
    carried(&table, other);
    for (int i = 0; i < 3 * (ELEMENTS + 1); i++) worst = fmax(worst, fabs(one[i] - other[i]));
    CHECK_LESS(rig_show("moving table", "mesh against plane, places per length", 0, worst / LENGTH),
               1e-10);
    CHECK_BETWEEN(fabs(one[1]), 1, 10); /* it has gone with the table */
    cps_mesh_release(mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_plane),
        cmocka_unit_test(one_cylinder),
        cmocka_unit_test(capstan_over_an_edge),
        cmocka_unit_test(moving_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
