/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on capsules, tori, cones and boxes, and inside: a plane as the face of a box; a capsule as
 * a cylinder and as a ball; capstan laws; a chain at the bottom of a bore and down a bowl; a line
 * over the edge of a quay and over the tip of a cone.
 *
 * A weightless line that slides along a geodesic has T' = mu kappa T with the curvature kappa of
 * the geodesic, so that the ratio of the tensions is exp(mu int kappa ds). On the tube of radius r
 * and round a cap that is the angle turned. On a cone of half angle alpha the geodesic is straight
 * in the unrolled cone; with its polar angle beta there, 0 where it is nearest to the tip, int
 * kappa ds is (sin beta2 - sin beta1)/tan alpha. */
#include <stdio.h>
#include <string.h>

#include "rig.h"

static const double PI = 3.14159265358979323846;

/* ---- one answer ---- */

enum { ELEMENTS = 110, STEPS = 6 };

/* Positions and the largest force of all steps of a line that is laid down and dragged about. */
typedef struct Track {
    double place[STEPS + 1][3 * (ELEMENTS + 1)], force[STEPS + 1][ELEMENTS], largest;
} Track;

static void copy_shape(Rig *rig, const CpsObstacle *shape, double friction) {
    CpsObstacle *first = rig_obstacle(rig, shape->kind, friction);
    const char *name = first->name;
    *first = *shape;
    first->friction = friction;
    first->name = name;
}

/* The line of `size` times 22 m goes from (-8, 1, 5) over (9, -2, 6) to other places, times `size`.
 */
static void follow(const CpsObstacle *bed, double size, double friction, Track *track) {
    Rig rig;
    rig_begin(&rig, ELEMENTS, 30, 1e6);
    rig.line.length = 22 * size;
    rig.line.start.kind = CPS_START_STATIC;
    copy_shape(&rig, bed, friction);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, -8 * size, size, 5 * size);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, 9 * size, -2 * size, 6 * size);
    rig_stage(&rig, STEPS / 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 11.5 * size, 3 * size, 6 * size);
    rig_stage(&rig, STEPS / 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 8 * size, -4 * size, 5 * size);
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

/* [-] The largest distance of two places, per length of the line; and the largest difference of two
 * forces, per largest force. */
static double apart(const Track *a, const Track *b, double length, double *force) {
    double worst = 0;
    *force = 0;
    for (int s = 0; s <= STEPS; s++) {
        for (int i = 0; i < 3 * (ELEMENTS + 1); i++)
            worst = fmax(worst, fabs(a->place[s][i] - b->place[s][i]) / length);
        for (int e = 0; e < ELEMENTS; e++)
            *force = fmax(*force, fabs(a->force[s][e] - b->force[s][e]) / a->largest);
    }
    return worst;
}

static CpsObstacle shape_of(CpsObstacleKind kind, double radius) {
    CpsObstacle shape = cps_obstacle_default();
    shape.kind = kind;
    shape.radius = radius;
    return shape;
}

/* A slope as a plane, and as the face of a box, from outside and from inside. */
static void face_of_a_box(void **state) {
    (void)state;
    static Track plane, other;
    CpsObstacle bed = shape_of(CPS_OBSTACLE_PLANE, 0);
    const double angle = 0.2, slope[3] = {-sin(angle), 0, cos(angle)};
    memcpy(bed.normal, slope, sizeof slope);
    follow(&bed, 1, 0.4, &plane);
    for (int inside = 0; inside < 2; inside++) {
        double force;
        const double half = 200, sign = inside ? 1 : -1;
        bed = shape_of(CPS_OBSTACLE_BOX, 1);
        bed.shape = (CpsShape){.inside = inside,
                               .size = {2 * half, 2 * half, 2 * half},
                               .rotation = {cos(angle / 2), 0, -sin(angle / 2), 0}};
        for (int k = 0; k < 3; k++) bed.point[k] = sign * half * slope[k];
        follow(&bed, 1, 0.4, &other);
        CHECK_LESS(rig_show("face of a box",
                            inside ? "inside, places per length" : "places per length", 0,
                            apart(&plane, &other, 22, &force)),
                   1e-10);
        CHECK_LESS(rig_show("face of a box", "forces per largest", 0, force), 1e-8);
    }
}

/* A ball touching the plane from below, and a bowl from above, of 1e3, 1e4 and 1e5 lengths. */
static void large_bowl(void **state) {
    (void)state;
    static Track plane, other;
    CpsObstacle bed = shape_of(CPS_OBSTACLE_PLANE, 0);
    follow(&bed, 1, 0.4, &plane);
    for (int inside = 0; inside < 2; inside++)
        for (int k = 3; k <= 5; k++) {
            const double radius = 22 * pow(10, k);
            double force;
            char figure[64];
            bed = shape_of(CPS_OBSTACLE_SPHERE, radius);
            bed.point[2] = inside ? radius : -radius;
            bed.shape.inside = inside;
            follow(&bed, 1, 0.4, &other);
            snprintf(figure, sizeof figure, "%s of 1e%d lengths, places per length",
                     inside ? "bowl" : "ball", k);
            CHECK_LESS(rig_show("large sphere", figure, 0, apart(&plane, &other, 22, &force)),
                       10 * pow(10, -k));
            CHECK_LESS(force, 10 * pow(10, -k));
        }
}

/* A line drawn over the middle of a capsule, and one over its cap, against a cylinder and a ball.
 */
static void parts_of_a_capsule(void **state) {
    (void)state;
    static Track simple, other;
    for (int cap = 0; cap < 2; cap++) {
        double force;
        CpsObstacle bed = shape_of(cap ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER, 4);
        follow(&bed, 1, 0.2, &simple);
        bed = shape_of(CPS_OBSTACLE_CAPSULE, 4);
        bed.shape.length = cap ? 0 : 60;
        follow(&bed, 1, 0.2, &other);
        const double off = apart(&simple, &other, 22, &force);
        /* two ways to one place, each to a gap of 1e-13 of the scale: to three times its root */
        CHECK_LESS(rig_show("capsule", cap ? "as a ball, places" : "as a cylinder, places", 0, off),
                   1e-6);
        CHECK_LESS(rig_show("capsule", "forces per largest", 0, force), 1e-6);
    }
}

/* ---- capstan laws ---- */

static const double ALPHA = 0.5;

/* A place on a curve by its parameter. */
typedef void Curve(double s, double out[3]);

static void meridian(double s, double out[3]) {
    out[0] = cos(s);
    out[1] = 0;
    out[2] = sin(s);
}

/* The geodesic of the cone with its tip at the origin, at distance 2 from the tip, by its arc
 * length.
 */
static void geodesic(double s, double out[3]) {
    const double rho = hypot(2, s), around = atan2(s, 2) / sin(ALPHA);
    out[0] = rho * sin(ALPHA) * cos(around);
    out[1] = rho * sin(ALPHA) * sin(around);
    out[2] = -rho * cos(ALPHA);
}

/* Over the tip of a cone whose tip is a ball of radius 1, from side to side: by its arc length. */
static void over_the_tip(double s, double out[3]) {
    const double turn = PI / 2 - ALPHA, on = fmax(-turn, fmin(turn, s)), rest = s - on;
    out[0] = sin(on) + rest * cos(on);
    out[1] = 0;
    out[2] = cos(on) - rest * sin(on);
}

/* Round the edge of a box along x, whose corner is a quarter of a circle of radius 1 round the
 * origin: by its arc length. */
static void over_the_edge(double s, double out[3]) {
    const double on = fmax(0, fmin(PI / 2, s)), rest = s - on;
    out[0] = sin(on) + rest * cos(on);
    out[1] = 0;
    out[2] = cos(on) - rest * sin(on);
}

static void tangent(Curve *curve, double s, double h, double out[3]) {
    double ahead[3], behind[3], size = 0;
    curve(s + h, ahead);
    curve(s - h, behind);
    for (int k = 0; k < 3; k++) size += (ahead[k] - behind[k]) * (ahead[k] - behind[k]);
    for (int k = 0; k < 3; k++) out[k] = (ahead[k] - behind[k]) / sqrt(size);
}

/* The ratio of the tensions of a line with n + 1 nodes on a curve from s1 to s2 and straight leads,
 * held at B, where it is drawn, and pulled by 1 N at A. */
static double drawn(const CpsObstacle *shape, Curve *curve, double s1, double s2, double mu,
                    int n) {
    Rig rig;
    rig_begin(&rig, n + 2, 0, INFINITY);
    copy_shape(&rig, shape, mu);
    double lead[2][3], at[3], tip[2][3];
    for (int end = 0; end < 2; end++) { /* tangents, outwards */
        curve(end ? s2 : s1, at);
        tangent(curve, end ? s2 : s1, end ? 1e-5 : -1e-5, lead[end]);
        for (int k = 0; k < 3; k++) tip[end][k] = at[k] + lead[end][k];
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

static void converges(const char *name, const CpsObstacle *shape, Curve *curve, double s1,
                      double s2, double mu, double turned) {
    double before = 0, first = 0;
    for (int n = 20; n <= 160; n *= 2) {
        char figure[48];
        snprintf(figure, sizeof figure, "mu %g, ratio, n = %d", mu, n);
        const double exact = exp(mu * turned),
                     off = rig_show(name, figure, exact, drawn(shape, curve, s1, s2, mu, n));
        if (n > 20) print_message("%s, n = %d: order %.2f\n", name, n, log2(fabs(before / off)));
        if (n == 20) first = off;
        before = off;
    }
    /* The nodes' sum is that of trapezoids, of second order; where the curvature jumps between two
     * nodes, an error depends on its place within the element, and the order is that of three
     * halvings: 64 times less, with a margin of 2. The slide of 1e-4 changes the angles at the ends
     * by less than 1e-6 of the ratio. */
    CHECK_LESS(fabs(before), fabs(first) / 32 + 1e-6 * exp(mu * turned));
    CHECK_LESS(fabs(before), 4e-4 * exp(mu * turned));
}

static void capstan_laws(void **state) {
    (void)state;
    CpsObstacle torus = shape_of(CPS_OBSTACLE_TORUS, 1);
    torus.axis[1] = 0;
    torus.axis[2] = 1;
    torus.point[0] = -3;
    torus.shape.main_radius = 3;
    converges("tube of a torus", &torus, meridian, -0.9, 1.1, 0.3, 2);
    converges("tube of a torus", &torus, meridian, -0.9, 1.1, 1, 2);
    CpsObstacle cone = shape_of(CPS_OBSTACLE_CONE, 0.1);
    cone.axis[1] = 0;
    cone.axis[2] = -1;
    cone.shape.angle = ALPHA;
    cone.point[2] = 0.1 - 0.1 / sin(ALPHA); /* the sides meet in the origin */
    converges("geodesic of a cone", &cone, geodesic, -1, 2.5, 0.3,
              (sin(atan2(2.5, 2)) + sin(atan2(1, 2))) / tan(ALPHA));
    cone.radius = 1;
    cone.point[2] = 1;
    converges("over the tip of a cone", &cone, over_the_tip, -1.5, 1.5, 0.3, PI - 2 * ALPHA);
    CpsObstacle box = shape_of(CPS_OBSTACLE_BOX, 1);
    box.shape.size[0] = box.shape.size[1] = box.shape.size[2] = 8;
    box.point[0] = box.point[2] = -3;
    converges("over the edge of a box", &box, over_the_edge, -0.5, 2, 0.3, PI / 2);
}

/* ---- inside ---- */

/* A chain at the bottom of a bore is a line on its bottom line: of mu w per length, as on a plane.
 */
static void chain_in_a_bore(void **state) {
    (void)state;
    enum { N = 60 };
    const double weight = 50, mu = 0.4, length = 6;
    Rig rig;
    rig_begin(&rig, N, weight, INFINITY);
    CpsObstacle pipe = shape_of(CPS_OBSTACLE_CYLINDER, 0.5);
    pipe.axis[0] = 1;
    pipe.axis[1] = 0;
    pipe.point[2] = 0.5;
    pipe.shape.inside = true;
    copy_shape(&rig, &pipe, mu);
    rig_point(&rig, 0, 0, 0);
    rig_point(&rig, length, 0, 0);
    rig_length(&rig, length);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 2);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, length + 0.1, 0, 0);
    RigRun run = rig_open(&rig);
    for (int s = 0; s < 2; s++) {
        const CpsLineView view = rig_step(&run);
        /* all nodes but the held one, which stands for half an element, slide */
        const double exact = mu * weight * (length - 0.5 * length / N);
        CHECK_RELATIVE(rig_tension(&view, N - 1), exact, 1e-9);
        for (int j = 0; j <= N; j++) {
            CHECK_NEAR(view.position[3 * j + 1], 0, 1e-9);
            CHECK_NEAR(view.position[3 * j + 2], 0, 1e-9);
        }
    }
    rig_close(&run);
}

/* A chain held on the wall of a smooth bowl and hanging down it: the tension at a place is w times
 * its height above the free end. It would lift off the wall where that is more than w cos(phi) R,
 * which here it is nowhere. */
static void chain_in_a_bowl(void **state) {
    (void)state;
    double before = 0;
    for (int n = 20; n <= 80; n *= 2) {
        Rig rig;
        const double radius = 3, weight = 20, from = 0.9, to = 0.3;
        rig_begin(&rig, n, weight, INFINITY);
        CpsObstacle bowl = shape_of(CPS_OBSTACLE_SPHERE, radius);
        bowl.shape.inside = true;
        copy_shape(&rig, &bowl, 0);
        const double chord = 2 * radius * sin((from - to) / (2 * n));
        for (int j = 0; j <= n; j++) {
            const double angle = from + (to - from) * j / n;
            rig_point(&rig, radius * sin(angle), 0, -radius * cos(angle));
        }
        rig_length(&rig, n * chord);
        rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
        rig_stage(&rig, 1);
        RigRun run = rig_open(&rig);
        const CpsLineView view = rig_step(&run);
        /* in the middle of the first element, by half of its height less */
        const double height = -radius * cos(from) + radius * cos(to), step = (from - to) / n,
                     half = radius * (cos(from - 0.5 * step) - cos(from));
        char figure[32];
        snprintf(figure, sizeof figure, "tension [N], n = %d", n);
        const double off =
            rig_show("chain in a bowl", figure, weight * (height - half), rig_tension(&view, 0));
        if (before != 0) CHECK_LESS(fabs(off), fabs(before) / 3.5); /* of second order */
        before = off;
        rig_close(&run);
    }
    CHECK_LESS(fabs(before), 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(face_of_a_box),      cmocka_unit_test(large_bowl),
        cmocka_unit_test(parts_of_a_capsule), cmocka_unit_test(capstan_laws),
        cmocka_unit_test(chain_in_a_bore),    cmocka_unit_test(chain_in_a_bowl),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
