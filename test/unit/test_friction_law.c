/* SPDX-License-Identifier: BSD-3-Clause */
/* Ellipse and box of friction forces: dissipation is the support function, the gap is phi + F.u and
 * not less than 0, clipped forces are in the set, the margin keeps them there. */
#include "cable/line.h"

#include "check.h"

static const double PI = 3.14159265358979323846;

static CpsiFrictionLaw make(double first, double second, bool box) {
    CpsObstacle def = cps_obstacle_default();
    def.friction = first;
    def.has_friction_lateral = true;
    def.friction_lateral = second;
    def.friction_shape = box ? CPS_FRICTION_SHAPE_BOX : CPS_FRICTION_SHAPE_ELLIPSE;
    const CpsiObstacle o = cpsi_obstacle(&def);
    const CpsiLine line = {.obstacle_count = 1,
                           .obstacle = &o}; /* of one obstacle, without zones */
    return cpsi_line_friction_law(&line, 0);
}

/* The point of the set's boundary at parameter t, with bound w of the larger coefficient. */
static void edge(const CpsiFrictionLaw *law, double w, double t, double out[2]) {
    const double c = cos(t), s = sin(t), by = law->box ? fmax(fabs(c), fabs(s)) : 1;
    out[0] = w * law->ratio[0] * c / by;
    out[1] = w * law->ratio[1] * s / by;
}

static void ratios(void **state) {
    (void)state;
    CpsiFrictionLaw law = make(0.6, 0.3, false);
    CHECK_NEAR(law.friction, 0.6, 0);
    CHECK_NEAR(law.ratio[0], 1, 2e-16);
    CHECK_NEAR(law.ratio[1], 0.5, 2e-16);
    law = make(0, 0.3, true);
    CHECK_NEAR(law.friction, 0.3, 0);
    CHECK_NEAR(law.ratio[0], 0, 0);
    CHECK_NEAR(law.ratio[1], 1, 2e-16);
    law = make(0, 0, false);
    CHECK_NEAR(law.friction, 0, 0);
    const CpsiLine nowhere = {.obstacle_count = 0};
    law = cpsi_line_friction_law(&nowhere, 0);
    CHECK_NEAR(law.friction, 0, 0);
}

static const double SHAPE[][3] = {{0.6, 0.3, 0}, {0.3, 0.6, 0}, {0.5, 0.5, 0}, {0.6, 0.3, 1},
                                  {0.2, 0.9, 1}, {0, 0.7, 0},   {0.4, 0, 1}};

/* phi(u) = max of -F.u over the boundary; found at 4000 points of it, so short by (pi/2000)^2/2 =
 * 1.3e-6 of it at most.
 */
static void support(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof SHAPE / sizeof *SHAPE; k++) {
        const CpsiFrictionLaw law = make(SHAPE[k][0], SHAPE[k][1], SHAPE[k][2] > 0);
        for (double a = 0; a < 6.3; a += 0.37) {
            const double u[2] = {3 * cos(a), 3 * sin(a)}, w = 2.5;
            double most = 0;
            for (int i = 0; i < 4000; i++) {
                double f[2];
                edge(&law, w, i * PI / 2000, f);
                most = fmax(most, -f[0] * u[0] - f[1] * u[1]);
            }
            const double phi = cpsi_friction_law_dissipation(&law, w, u);
            CHECK_BETWEEN(phi, most * (1 - 1e-15), most * (1 + 2e-6) + 1e-15);
        }
    }
}

/* gap = phi + F.u to rounding of the sum, >= 0 on the set, and 0 to rounding squared where the law
 * holds. */
static void gap(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof SHAPE / sizeof *SHAPE; k++) {
        const CpsiFrictionLaw law = make(SHAPE[k][0], SHAPE[k][1], SHAPE[k][2] > 0);
        const double w = 2.5;
        for (double t = 0.01; t < 6.3; t += 0.19) {
            for (double part = 0; part <= 1; part += 0.25) {
                double f[2];
                edge(&law, w, t, f);
                for (int a = 0; a < 2; a++) f[a] *= part;
                for (double a = 0; a < 6.3; a += 0.41) {
                    const double u[2] = {1e-3 * cos(a), 1e-3 * sin(a)};
                    const double found = cpsi_friction_law_gap(&law, w, f, u),
                                 plain = cpsi_friction_law_dissipation(&law, w, u) + f[0] * u[0] +
                                         f[1] * u[1];
                    CHECK_NEAR(found, plain, 2e-15 * w * 1e-3); /* a few ulps of each term */
                    CHECK_GREATER(found, -1e-18);
                }
            }
            /* the way that the force on the edge answers: its normal, u against F */
            double f[2];
            edge(&law, w, t, f);
            const double *r = law.ratio;
            if (law.box || r[0] == 0 || r[1] == 0) continue;
            const double u[2] = {-f[0] / (r[0] * r[0]), -f[1] / (r[1] * r[1])};
            /* quadratic in the rounding of directions, linear in that of |f| against w */
            CHECK_NEAR(cpsi_friction_law_gap(&law, w, f, u), 0,
                       1e-15 * w * hypot(r[0] * u[0], r[1] * u[1]));
        }
    }
}

/* A corner of a box answers every way of its quadrant. */
static void corner(void **state) {
    (void)state;
    const CpsiFrictionLaw law = make(0.6, 0.3, true);
    const double f[2] = {-2, -1};
    for (double a = 0; a <= PI / 2; a += 0.1) {
        const double u[2] = {cos(a), sin(a)};
        CHECK_NEAR(cpsi_friction_law_gap(&law, 2, f, u), 0, 1e-15);
    }
}

/* What is clipped keeps its direction, and is in the set; what is inside is not touched. Room is a
 * lower bound of what may be added in the force's own direction. */
static void clip_and_margin(void **state) {
    (void)state;
    for (size_t k = 0; k < sizeof SHAPE / sizeof *SHAPE; k++) {
        const CpsiFrictionLaw law = make(SHAPE[k][0], SHAPE[k][1], SHAPE[k][2] > 0);
        const bool flat = law.ratio[0] == 0 || law.ratio[1] == 0;
        for (double t = 0.05; t < 6.3; t += 0.23) {
            double on[2], far[2], in[2], kept[2];
            edge(&law, 2.5, t, on);
            for (int a = 0; a < 2; a++) {
                far[a] = 3 * on[a];
                kept[a] = in[a] = 0.4 * on[a];
            }
            cpsi_friction_law_clip(&law, 2.5, 2.5, far);
            cpsi_friction_law_clip(&law, 2.5, 2.5, kept);
            for (int a = 0; a < 2; a++) {
                if (!flat) CHECK_NEAR(far[a], on[a], 1e-15);
                CHECK_NEAR(kept[a], in[a], 0);
            }
            const double size = hypot(in[0], in[1]),
                         margin = cpsi_friction_law_margin(&law, 2.5, in);
            CHECK_GREATER(margin, -1e-300);
            CHECK_LESS(margin, hypot(on[0], on[1]) - size + 1e-15);
            if (flat) CHECK_NEAR(margin, 0, 0);
            if (!flat) CHECK_NEAR(cpsi_friction_law_margin(&law, 2.5, on), 0, 1e-15);
        }
    }
    /* no width, no force */
    const CpsiFrictionLaw law = make(0, 0.7, false);
    double f[2] = {1, 0.5};
    cpsi_friction_law_clip(&law, 2.5, 2.5, f);
    CHECK_NEAR(f[0], 0, 0);
    CHECK_NEAR(f[1], 0.5, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ratios), cmocka_unit_test(support),         cmocka_unit_test(gap),
        cmocka_unit_test(corner), cmocka_unit_test(clip_and_margin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
