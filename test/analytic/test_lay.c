/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines placed in curves: what holds them in place on a bed and on a sphere, and where they move
 * when nothing does.
 *
 * On a bed, a line of weight w and tension T placed with curvature kappa is held as long as its
 * friction, T' along and T kappa across the line, lies in its set: (T'/mu_a)^2 + (T kappa/mu_t)^2
 * <= w^2. With uniform tension that is T <= mu_t w r; on a slope of angle b, where the weight pulls
 * the same way as the tension at the highest place of the curve, T <= (mu cos(b) - sin(b)) w r.
 * Pulled at the end of an arc of angle theta, T = mu_t w r sin(mu_a theta/mu_t) up to a quarter
 * turn of the sine, then mu_t w r. A line that slides across itself without axial friction takes
 * the shape of a circle, r = T/(mu w). On a sphere a taut line of uniform tension on a circle of
 * latitude lambda presses with T cos(lambda)/r and pulls sideways with T sin(lambda)/r: it holds if
 * and only if tan(lambda) <= mu, whatever its tension, and otherwise slides towards the great
 * circle. */
#include <stdio.h>

#include "rig.h"

static const double PI = 3.14159265358979323846;

/* largest displacement of a node from the start */
static double farthest(const RigRun *run) {
    double most = 0;
    for (int j = 0; j <= run->view.element_count; j++) {
        const double *x = &run->view.position[3 * j], *start = &run->rig->point[3 * j];
        most = fmax(most, hypot(hypot(x[0] - start[0], x[1] - start[1]), x[2] - start[2]));
    }
    return most;
}

/* on a bed ------------------------------------------------------------------------------------- */

/* A line of even tension on a half circle of radius r, both ends held: chord 2 r sin(d/2), tension
 * T makes 2 T sin(d/2) across, against mu w times the natural length of the chord: T <= mu w r/(1 +
 * T/EA), exactly, for any number of elements; on a slope with the highest node at the middle, its
 * centre below that. Returns how far it moves. */
static double lay(double radius, double lateral, CpsFrictionShape shape, double tension,
                  double slope) {
    enum { N = 60 };
    const double d = PI / N, stiffness = 1e3, weight = 10;
    Rig rig;
    rig_begin(&rig, N, weight, stiffness);
    CpsObstacle *bed = rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0.5);
    rig_lateral(bed, lateral);
    bed->friction_shape = shape;
    bed->normal[0] = 0;
    bed->normal[1] = -sin(slope);
    bed->normal[2] = cos(slope);
    for (int j = 0; j <= N; j++) {
        const double up = radius * sin(j * d);
        rig_point(&rig, radius * cos(j * d), up * cos(slope), up * sin(slope));
    }
    rig_length(&rig, N * 2 * radius * sin(d / 2) / (1 + tension / stiffness));
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    RigRun run = rig_open(&rig);
    rig_step(&run);
    const double displacement = farthest(&run);
    rig_close(&run);
    return displacement;
}

/* The critical radius, by halving: the line moves iff its radius is less. */
static double critical(double lateral, CpsFrictionShape shape, double tension) {
    double low = 0.5 * tension / (lateral * 10), high = 4 * low;
    for (int i = 0; i < 22; i++) {
        const double middle = 0.5 * (low + high);
        /* a radius too small by a share s lets the line in by s r T/EA = 0.18 s; near the limit,
         * where friction has no reserve left, a certified line may be off by 1e-7 */
        if (lay(middle, lateral, shape, tension, 0) > 1e-6)
            low = middle;
        else
            high = middle;
    }
    return 0.5 * (low + high);
}

static void critical_radius(void **state) {
    (void)state;
    const double tension = 30, strain = tension / 1e3;
    static const struct {
        const char *name;
        double lateral;
        CpsFrictionShape shape;
    } BED[] = {{"lay, mu 0.5", 0.5, CPS_FRICTION_SHAPE_ELLIPSE},
               {"lay, mu 0.5 by 0.8, ellipse", 0.8, CPS_FRICTION_SHAPE_ELLIPSE},
               {"lay, mu 0.5 by 0.3, ellipse", 0.3, CPS_FRICTION_SHAPE_ELLIPSE},
               {"lay, mu 0.5 by 0.8, box", 0.8, CPS_FRICTION_SHAPE_BOX}};
    for (int i = 0; i < 4; i++) {
        const double exact = tension * (1 + strain) / (BED[i].lateral * 10);
        const double found = critical(BED[i].lateral, BED[i].shape, tension);
        CHECK_LESS(fabs(rig_show(BED[i].name, "critical radius [m]", exact, found)),
                   2e-5 * exact); /* 1e-6/0.18, times 4 */
    }
}

/* On a slope only the highest node comes to its limit, so that little moves near it: the radius is
 * that beyond which nothing does, to either side. */
static void critical_radius_on_a_slope(void **state) {
    (void)state;
    static const double BED[][2] = {{0.5, 0.05}, {0.5, 0.1}, {0.5, 0.3}, {0.5, 0.4}}, BESIDE = 5e-4;
    const double tension = 30, strain = tension / 1e3;
    for (int i = 0; i < 4; i++) {
        const double slope = BED[i][1],
                     exact = tension * (1 + strain) / ((BED[i][0] * cos(slope) - sin(slope)) * 10),
                     wider = lay(exact * (1 + BESIDE), BED[i][0], CPS_FRICTION_SHAPE_ELLIPSE,
                                 tension, slope),
                     narrower = lay(exact * (1 - BESIDE), BED[i][0], CPS_FRICTION_SHAPE_ELLIPSE,
                                    tension, slope);
        printf(
            "lay, mu %g, slope %g rad: moves by %.1e m at 1 + %g of the radius, by %.1e m at 1 - "
            "%g\n",
            BED[i][0], slope, wider, BESIDE, narrower, BESIDE);
        CHECK_LESS(wider, 1e-7); /* rounding of a certified line, as above */
        CHECK_GREATER(narrower, 1e-6);
    }
}

/* The most that the end of an arc of angle theta can be pulled with before anything slides. Free at
 * the other end; from node to node the tension grows by what the ellipse leaves beside the pull
 * across, half a node's worth at the ends. */
static double most(double theta, double axial, double lateral, double weight, int n) {
    const double d = theta / n, h = 2 * sin(d / 2), w = weight * h, c = cos(d / 2) / axial,
                 s = sin(d / 2) / lateral;
    double tension = axial * w / 2;
    for (int j = 1; j < n; j++) {
        /* (T' - T)^2 c^2 + (T' + T)^2 s^2 = w^2 */
        const double a = c * c + s * s, b = tension * (c * c - s * s);
        tension = (b + sqrt(b * b - a * (a * tension * tension - w * w))) / a;
    }
    return tension + axial * w / 2;
}

/* Pull the end of an arc of radius 1; how far anything moves. */
static double pull_arc(double theta, double axial, double lateral, double force) {
    enum { N = 50 };
    const double d = theta / N, weight = 10;
    Rig rig;
    rig_begin(&rig, N, weight, INFINITY);
    rig_lateral(rig_obstacle(&rig, CPS_OBSTACLE_PLANE, axial), lateral);
    for (int j = 0; j <= N; j++) rig_point(&rig, cos(j * d), sin(j * d), 0);
    rig_length(&rig, N * 2 * sin(d / 2));
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_FREE, 0, 0, 0);
    rig_stage(&rig, 1);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_FREE, -force * sin(theta - d / 2),
               force * cos(theta - d / 2), 0);
    RigRun run = rig_open(&rig);
    rig_step(&run);
    const double displacement = farthest(&run);
    rig_close(&run);
    return displacement;
}

static void pulled_arc(void **state) {
    (void)state;
    static const double BED[][3] = {{1, 0.5, 0.5}, {1, 0.5, 0.8}, {1.2, 0.3, 0.4}};
    for (int i = 0; i < 3; i++) {
        const double theta = BED[i][0], axial = BED[i][1], lateral = BED[i][2];
        const double closed = lateral * 10 * sin(axial * theta / lateral),
                     discrete = most(theta, axial, lateral, 10, 50);
        char name[64];
        snprintf(name, sizeof name, "arc of %g rad, mu %g by %g", theta, axial, lateral);
        /* the polygon's limit against the line's: pulled along its last chord, it is half an angle
         * short */
        CHECK_LESS(fabs(rig_show(name, "limit, polygon of 50 [N]", closed, discrete)) / closed,
                   0.5 * theta / 50);
        CHECK_LESS(rig_show(name, "displacement at 0.9995 of the limit [m]", 0,
                            pull_arc(theta, axial, lateral, 0.9995 * discrete)),
                   1e-8);
        CHECK_GREATER(rig_show(name, "displacement at 1.0005 of the limit [m]", 0,
                               pull_arc(theta, axial, lateral, 1.0005 * discrete)),
                      1e-6);
    }
}

/* A taut line on a bed that holds only across it, moved sideways by both ends until all of it
 * slides: 2 T sin(d/2) = mu w h at every node, T the same everywhere, whatever the history. */
static void lateral_slip(void **state) {
    (void)state;
    enum { N = 40 };
    const double length = 4, stiffness = 1e3, weight = 10, mu = 0.5, tension = 30;
    Rig rig;
    rig_begin(&rig, N, weight, stiffness);
    rig_lateral(rig_obstacle(&rig, CPS_OBSTACLE_PLANE, 0), mu);
    rig_point(&rig, 0, 0, 0);
    rig_point(&rig, length * (1 + tension / stiffness), 0, 0);
    rig_length(&rig, length);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 5);
    rig_change(&rig, CPS_END_A, CPS_END_KIND_HELD, 0, 1, 0);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, length * (1 + tension / stiffness), 1, 0);
    RigRun run = rig_open(&rig);
    const CpsLineView v = rig_next(&run);
    double worst = 0, even = 0, radius = 0;
    for (int j = 1; j < N; j++) {
        const double *a = &v.position[3 * (j - 1)], *b = a + 3, *c = b + 3;
        const double turn = atan2((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]),
                                  (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]));
        const double here = rig_tension(&v, j),
                     exact = 2 * asin(mu * weight * length / N / (2 * here));
        worst = fmax(worst, fabs(fabs(turn) / exact - 1));
        even = fmax(even, fabs(here / rig_tension(&v, 0) - 1));
        radius = hypot(c[0] - b[0], c[1] - b[1]) / (2 * sin(fabs(turn) / 2));
    }
    CHECK_LESS(rig_show("lateral slip", "unevenness of T", 0, even), 1e-6);
    /* a turn is 0.017 and elements lie in their direction to 1e-7 or so, in which the gap is
     * quadratic */
    CHECK_LESS(rig_show("lateral slip", "turn at nodes, worst share off", 0, worst), 5e-5);
    /* the polygon through the nodes has elements stretched by T/EA */
    const double exact =
        rig_tension(&v, N - 1) / (mu * weight) * (1 + rig_tension(&v, N - 1) / stiffness);
    CHECK_RELATIVE(rig_show("lateral slip", "radius, T/(mu w) [m]", exact, radius) + exact, exact,
                   5e-5);
    rig_close(&run);
}

/* normality ------------------------------------------------------------------------------------ */

/* One element drags its node A over a grooved bed, B is led at the angle theta to the grooves. The
 * force on the node is normal to the set of forces, against the motion: along (mu1^2 s1, mu2^2 s2)
 * for an ellipse, into a corner for a box. After a while the element trails along that force and
 * the node follows B. */
static void tow(const char *name, CpsFrictionShape shape, double mu1, double mu2, double theta) {
    const double displacement = 12, direction[2] = {cos(theta), sin(theta)};
    Rig rig;
    rig_begin(&rig, 1, 10, INFINITY);
    CpsObstacle *bed = rig_obstacle(&rig, CPS_OBSTACLE_PLANE, mu1);
    rig_lateral(bed, mu2);
    bed->friction_shape = shape;
    bed->grain[0] = 1;
    rig_point(&rig, 0, 0, 0);
    rig_point(&rig, 1, 0, 0);
    rig_length(&rig, 1);
    rig_end(&rig, CPS_END_A, CPS_END_KIND_FREE, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_stage(&rig, 120);
    rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, 1 + displacement * direction[0],
               displacement * direction[1], 0);
    RigRun run = rig_open(&rig);
    double worst = 0;
    for (int k = 0; k < 120; k++) {
        const CpsLineView v = rig_step(&run);
        const double s1 = v.position[0] - v.reference[0], s2 = v.position[1] - v.reference[1],
                     r = v.reaction[0];
        const double size = hypot(mu1 * s1, mu2 * s2);
        if (shape == CPS_FRICTION_SHAPE_BOX || size < 1e-6) continue;
        worst = fmax(worst, hypot(v.friction_force[0] + r * mu1 * mu1 * s1 / size,
                                  v.friction_force[1] + r * mu2 * mu2 * s2 / size) /
                                r);
    }
    if (shape == CPS_FRICTION_SHAPE_ELLIPSE)
        CHECK_LESS(rig_show(name, "force off its closed form, /R", 0, worst),
                   1e-6); /* the gap is quadratic in it */
    const CpsLineView v = run.view;
    const bool box = shape == CPS_FRICTION_SHAPE_BOX;
    const double exact =
        box ? atan2(mu2, mu1) : atan2(mu2 * mu2 * direction[1], mu1 * mu1 * direction[0]);
    const double found = atan2(v.position[4] - v.position[1], v.position[3] - v.position[0]);
    /* the element turns towards it with exp(-displacement/length), or faster: 6e-6 after 12 lengths
     */
    CHECK_LESS(fabs(rig_show(name, "direction of the element [rad]", exact, found)), 2e-5);
    rig_close(&run);
}

static void normality(void **state) {
    (void)state;
    tow("tow, ellipse 0.6 by 0.3", CPS_FRICTION_SHAPE_ELLIPSE, 0.6, 0.3, 0.8);
    tow("tow, ellipse 0.2 by 0.9", CPS_FRICTION_SHAPE_ELLIPSE, 0.2, 0.9, 0.3);
    tow("tow, disc", CPS_FRICTION_SHAPE_ELLIPSE, 0.5, 0.5, 0.8);
    tow("tow, box 0.6 by 0.3", CPS_FRICTION_SHAPE_BOX, 0.6, 0.3, 0.8);
}

/* on a sphere ---------------------------------------------------------------------------------- */

/* A taut line over a ball of radius 1 without friction, from A to B at (-2, 0, 0.6) and (2, 0,
 * 0.6), laid askew: it comes to the great circle through both, two tangents of sqrt(|A|^2 - 1) and
 * an arc. Worst distance from the plane y = 0 and from the length of that way, found by the
 * strain. */
static double geodesic(int n, double *aside) {
    const double reach = sqrt(4.36), arc = 2 * atan2(2, 0.6) - 2 * acos(1 / reach);
    const double displacement = 2 * sqrt(reach * reach - 1) + arc, stiffness = 100, strain = 0.05;
    Rig rig;
    rig_begin(&rig, n, 0, stiffness);
    rig_obstacle(&rig, CPS_OBSTACLE_SPHERE, 0);
    rig_point(&rig, -2, 0, 0.6);
    rig_point(&rig, -0.5, 0.4, 1.2);
    rig_point(&rig, 0.5, 0.3, 1.2);
    rig_point(&rig, 2, 0, 0.6);
    rig_length(&rig, displacement / (1 + strain));
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    RigRun run = rig_open(&rig);
    const CpsLineView v = rig_step(&run);
    *aside = 0;
    double length = 0;
    for (int j = 0; j <= n; j++) *aside = fmax(*aside, fabs(v.position[3 * j + 1]));
    for (int e = 0; e < n; e++) length += rig_tension(&v, e) / stiffness * v.element_length[e];
    rig_close(&run);
    return length / (displacement - displacement / (1 + strain)) - 1;
}

static void sphere_geodesic(void **state) {
    (void)state;
    for (int n = 40; n <= 160; n *= 2) {
        double aside;
        const double error = geodesic(n, &aside);
        char figure[48];
        snprintf(figure, sizeof figure, "off the great circle, N = %d [m]", n);
        /* nothing holds it there but its own tension: the gap is quadratic in it, 1e-7 and a
         * factor */
        CHECK_LESS(rig_show("taut line over a ball", figure, 0, aside), 1e-5);
        snprintf(figure, sizeof figure, "elongation, share off, N = %d", n);
        /* a polygon inside the arc is shorter by d^2/24 of it, less at ends that are clear: 1/0.05
         * times of the elongation */
        const double d = 4.4 / n;
        CHECK_LESS(fabs(rig_show("taut line over a ball", figure, 0, error)), 20 * d * d / 24);
    }
}

/* A quarter of a circle of latitude on the ball, even tension, a little weight: beta = atan(w r/T)
 * besides, so that pull across over pressure is tan(lambda - beta), which is made `part` of mu.
 * Returns how far it moves. */
static double latitude(double mu, double part, CpsFrictionShape shape) {
    enum { N = 40 };
    const double d = 0.5 * PI / N, stiffness = 100, tension = 2, strain = tension / stiffness,
                 weight = 0.1;
    double lambda = atan(part * mu);
    for (int i = 0; i < 60; i++)
        lambda = atan(part * mu) + atan(weight * cos(lambda) / (tension * (1 + strain)));
    const double r = cos(lambda);
    Rig rig;
    rig_begin(&rig, N, weight, stiffness);
    CpsObstacle *ball = rig_obstacle(&rig, CPS_OBSTACLE_SPHERE, 0.2);
    rig_lateral(ball, mu);
    ball->friction_shape = shape;
    for (int j = 0; j <= N; j++) rig_point(&rig, r * cos(j * d), r * sin(j * d), sin(lambda));
    rig_length(&rig, N * 2 * r * sin(d / 2) / (1 + strain));
    rig_end(&rig, CPS_END_A, CPS_END_KIND_AT_START, 0, 0, 0);
    rig_end(&rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    RigRun run = rig_open(&rig);
    rig_step(&run);
    const double displacement = farthest(&run);
    rig_close(&run);
    return displacement;
}

static void sphere_latitude(void **state) {
    (void)state;
    static const double MU[] = {0.1, 0.3, 1};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 2; k++) {
            char name[48];
            snprintf(name, sizeof name, "latitude, mu %g, %s", MU[i], k ? "box" : "ellipse");
            const CpsFrictionShape shape = k ? CPS_FRICTION_SHAPE_BOX : CPS_FRICTION_SHAPE_ELLIPSE;
            CHECK_LESS(rig_show(name, "displacement at 0.999 of the limit [m]", 0,
                                latitude(MU[i], 0.999, shape)),
                       1e-6);
            CHECK_GREATER(rig_show(name, "displacement at 1.001 of the limit [m]", 0,
                                   latitude(MU[i], 1.001, shape)),
                          1e-5);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(critical_radius), cmocka_unit_test(critical_radius_on_a_slope),
        cmocka_unit_test(pulled_arc),      cmocka_unit_test(lateral_slip),
        cmocka_unit_test(normality),       cmocka_unit_test(sphere_geodesic),
        cmocka_unit_test(sphere_latitude),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
