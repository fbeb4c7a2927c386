/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets: arguments, reference counts, degenerate sets, users' sets, projections and gauges with
 * known answers. */
#include "check.h"

#include <string.h>

#include "capstan/set.h"

static CpsError err;
#define DO(call)           assert_int_equal((call), CPS_OK)
#define REFUSED(call, why) refused_((call), (why))

static void refused_(CpsStatus status, const char *why) {
    assert_int_equal(status, CPS_ERR_ARGUMENT);
    assert_int_equal(err.status, CPS_ERR_ARGUMENT);
    if (!strstr(err.message, why)) print_error("%s\n", err.message);
    assert_non_null(strstr(err.message, why));
}

static void bad_arguments_are_refused(void **state) {
    (void)state;
    const double nan[4] = {0, NAN, 0, 0}, zero[4] = {0}, one[2] = {1, 1}, skew[4] = {1, 0.5, 0, 1},
                 flat[4] = {1, 1, 1, 1};
    CpsSet *set = NULL, *disc, *line;
    REFUSED(cps_set_point(2, nan, &set, &err), "point[1] is nan");
    REFUSED(cps_set_point(0, one, &set, &err), "n is 0");
    REFUSED(cps_set_ball(2, NULL, -1, &set, &err), "radius is -1");
    REFUSED(cps_set_ball(2, NULL, NAN, &set, &err), "radius is nan");
    REFUSED(cps_set_ellipsoid(2, NULL, skew, &set, &err), "not symmetric");
    REFUSED(cps_set_ellipsoid(2, NULL, flat, &set, &err), "not positive definite");
    REFUSED(cps_set_box(2, one, zero, &set, &err), "from 1 to 0");
    REFUSED(cps_set_half_space(2, zero, 1, &set, &err), "row 0 is 0");
    REFUSED(cps_set_strip(2, one, 1, -1, &set, &err), "from 1 to -1");
    REFUSED(cps_set_hull_of_points(2, 0, NULL, &set, &err), "count is 0");
    REFUSED(cps_set_product(0, NULL, &set, &err), "0 parts");
    REFUSED(cps_set_user(2, NULL, NULL, &set, &err), "support is NULL");
    DO(cps_set_ball(2, NULL, 1, &disc, &err));
    DO(cps_set_interval(-1, 1, &line, &err));
    const CpsSet *mixed[2] = {disc, line};
    REFUSED(cps_set_intersection(2, mixed, &set, &err), "part 1 lies in R^1");
    REFUSED(cps_set_preimage(2, nan, NULL, disc, &set, &err), "map[1] is nan");
    REFUSED(cps_set_scale(NAN, disc, &set, &err), "factor[0] is nan");
    assert_null(set);
    CpsSetAnswer answer;
    double x[2];
    REFUSED(cps_set_support(disc, nan, x, &answer, &err), "direction[1] is nan");
    REFUSED(cps_set_project(disc, one, flat, x, &answer, &err),
            "metric is not symmetric positive definite");
    REFUSED(cps_set_face(disc, one, -1, &set, &answer, &err), "tolerance is -1");
    cps_set_release(disc);
    cps_set_release(line);
    cps_set_release(NULL);
}

/* Parts live as long as what was made of them, whoever lets go first. */
static void parts_are_held(void **state) {
    (void)state;
    CpsSet *disc, *moved, *sum;
    DO(cps_set_ball(2, NULL, 1, &disc, &err));
    DO(cps_set_translate((const double[]){3, 0}, disc, &moved, &err));
    const CpsSet *both[2] = {disc, moved};
    DO(cps_set_sum(2, both, &sum, &err));
    cps_set_release(disc);
    cps_set_release(moved);
    CpsSetAnswer answer;
    DO(cps_set_support(sum, (const double[]){1, 0}, NULL, &answer, &err));
    CHECK_NEAR(answer.value, 5, 1e-15);
    assert_true(answer.exact);
    char text[80];
    assert_int_equal(cps_set_text(sum, text, sizeof text),
                     strlen("sum(ball(0 0; r 1), translate(3 0, ball(0 0; r 1)))"));
    assert_string_equal(text, "sum(ball(0 0; r 1), translate(3 0, ball(0 0; r 1)))");
    cps_set_release(sum);
}

static void degenerate_sets_are_answered(void **state) {
    (void)state;
    const double low[2] = {0, 0}, high[2] = {1, 0}, far[2] = {5, 5}, w[2] = {0, 1}, s[2] = {1, 0};
    CpsSet *thin, *point, *none, *strip, *face;
    CpsSetFacts facts;
    CpsSetAnswer answer;
    double x[2];
    DO(cps_set_box(2, low, high, &thin, &err));
    DO(cps_set_facts(thin, 0, &facts, NULL, NULL, &err));
    CHECK_INT(facts.dimension, 1);
    assert_true(facts.bounded && facts.has_zero && !facts.zero_relative);
    DO(cps_set_point(2, far, &point, &err));
    const CpsSet *apart[2] = {thin, point};
    DO(cps_set_intersection(2, apart, &none, &err));
    DO(cps_set_support(none, w, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_EMPTY);
    assert_true(answer.value == -INFINITY);
    DO(cps_set_facts(none, 0, &facts, NULL, NULL, &err));
    assert_int_equal(facts.outcome, CPS_SET_OUTCOME_EMPTY);
    assert_false(facts.has_dimension);
    CHECK_INT(facts.dimension, 0);
    DO(cps_set_face(none, w, 0, &face, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_EMPTY);
    assert_null(face);
    DO(cps_set_strip(2, w, -1, 1, &strip, &err));
    DO(cps_set_support(strip, s, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    CHECK_GREATER(x[0], 0);
    DO(cps_set_normal_cone(strip, far, 0, &face, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
    CHECK_NEAR(answer.value, 4, 1e-12);
    DO(cps_set_gauge(point, w, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NO_ZERO);
    CpsSetMeasure measure;
    DO(cps_set_measure(strip, &measure, &err));
    assert_int_equal(measure.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    DO(cps_set_measure(thin, &measure, &err));
    CHECK_NEAR(measure.perimeter, 2, 1e-14);
    CHECK_NEAR(measure.area, 0, 1e-14);
    cps_set_release(thin);
    cps_set_release(point);
    cps_set_release(none);
    cps_set_release(strip);
}

/* the l1 ball scaled by *user */
static bool cross(void *user, int n, const double *w, double *value, double *point) {
    const double size = *(const double *)user;
    int best = 0;
    memset(point, 0, (size_t)n * sizeof *point);
    for (int i = 1; i < n; i++)
        if (fabs(w[i]) > fabs(w[best])) best = i;
    point[best] = copysign(size, w[best]);
    *value = size * fabs(w[best]);
    return true;
}

static void users_sets_answer_their_support(void **state) {
    (void)state;
    double size = 2;
    CpsSet *user, *ball, *sum, *face;
    CpsSetAnswer answer;
    double x[3];
    DO(cps_set_user(3, cross, &size, &user, &err));
    DO(cps_set_ball(3, NULL, 1, &ball, &err));
    const CpsSet *both[2] = {user, ball};
    DO(cps_set_sum(2, both, &sum, &err));
    DO(cps_set_support(sum, (const double[]){0, -3, 0}, x, &answer, &err));
    CHECK_NEAR(answer.value, 9, 1e-15);
    CHECK_NEAR(x[1], -3, 1e-15);
    DO(cps_set_project(sum, x, NULL, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NOT_AVAILABLE);
    DO(cps_set_face(user, x, 0, &face, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NOT_AVAILABLE);
    cps_set_release(user);
    cps_set_release(ball);
    cps_set_release(sum);
}

/* Projections against hand calculation: disc ∩ half plane, and a box in a skew metric. */
static void projections_and_gauges(void **state) {
    (void)state;
    CpsSet *disc, *half, *set, *box;
    CpsSetAnswer answer;
    double x[2], w[2];
    DO(cps_set_ball(2, NULL, 5, &disc, &err));
    DO(cps_set_half_space(2, (const double[]){0, 1}, 3, &half, &err));
    const CpsSet *both[2] = {disc, half};
    DO(cps_set_intersection(2, both, &set, &err));
    DO(cps_set_project(set, (const double[]){6, 8}, NULL, x, &answer, &err));
    CHECK_NEAR(x[0], 4, 1e-9); /* the corner; 1e-9 is what the conic solver promises */
    CHECK_NEAR(x[1], 3, 1e-9);
    CHECK_NEAR(answer.value, sqrt(29), 1e-9);
    DO(cps_set_contains(set, (const double[]){6, 8}, w, &answer, &err));
    CHECK_NEAR(answer.value, -sqrt(29), 1e-9);
    CHECK_NEAR(w[0], 2 / sqrt(29), 1e-9);
    DO(cps_set_contains(set, (const double[]){0, 1}, w, &answer, &err));
    assert_true(answer.exact);
    CHECK_NEAR(answer.value, 2, 1e-14);
    DO(cps_set_gauge(set, (const double[]){0, 6}, &answer, &err));
    CHECK_NEAR(answer.value, 2, 1e-14);
    /* min (x - p)'M(x - p) over x <= 0: with x1 = 0 free x2 = p2 + M12/M22 p1 */
    DO(cps_set_box(2, (const double[]){-INFINITY, -INFINITY}, (const double[]){0, INFINITY}, &box,
                   &err));
    DO(cps_set_project(box, (const double[]){1, 0}, (const double[]){2, 1, 1, 1}, x, &answer,
                       &err));
    CHECK_NEAR(x[0], 0, 1e-9);
    CHECK_NEAR(x[1], 1, 1e-9);
    CHECK_NEAR(answer.value, 1, 1e-9);
    cps_set_release(disc);
    cps_set_release(half);
    cps_set_release(set);
    cps_set_release(box);
}

/* A cube by its inequalities: faces, cones and vertices of every dimension. */
static void faces_and_cones_of_a_cube(void **state) {
    (void)state;
    double rows[18] = {0}, offsets[6], centre[3], ray[9];
    for (int i = 0; i < 6; i++) {
        rows[3 * i + i / 2] = i % 2 ? -1 : 1;
        offsets[i] = 1;
    }
    CpsSet *cube, *face, *cone;
    DO(cps_set_inequalities(3, 6, rows, offsets, &cube, &err));
    for (int d = 1; d <= 3; d++) {
        const double w[3] = {1, d > 1, d > 2};
        CpsSetAnswer answer;
        CpsSetFacts facts;
        int count;
        DO(cps_set_face(cube, w, 0, &face, &answer, &err));
        CHECK_NEAR(answer.value, d, 1e-10);
        DO(cps_set_facts(face, 0, &facts, centre, NULL, &err));
        CHECK_INT(facts.dimension, 3 - d);
        DO(cps_set_normal_cone(cube, centre, 0, &cone, &answer, &err));
        DO(cps_set_rays(cone, 0, 3, ray, &count, &answer, &err));
        CHECK_INT(count, d);
        DO(cps_set_facts(cone, 0, &facts, NULL, NULL, &err));
        CHECK_INT(facts.dimension, d);
        cps_set_release(face);
        cps_set_release(cone);
    }
    cps_set_release(cube);
}

/* The polar of the unit disc round (2, 0) is bounded by a hyperbola, 2 x + |(x, y)| = 1, with its
 * asymptotes at 60 degrees to -x. In their normals the support is 1/sqrt 3, the gauge of the
 * tangent's point, and nothing attains it. */
static void what_is_not_attained_says_so(void **state) {
    (void)state;
    const double w[2] = {sqrt(3) / 2, 0.5}, inner[2] = {1, 0}, outer[2] = {0.8, 0.6};
    CpsSet *disc, *polar, *face;
    CpsSetAnswer answer;
    CpsSetExtent extent;
    CpsSetFacts facts;
    double x[2];
    DO(cps_set_ball(2, (const double[]){2, 0}, 1, &disc, &err));
    DO(cps_set_polar(disc, &polar, &err));
    DO(cps_set_support(polar, w, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NOT_ATTAINED);
    CHECK_NEAR(answer.value, 1 / sqrt(3), 1e-6); /* what a point a million away leaves of 1e-13 */
    CHECK_NEAR(answer.value, 1 / sqrt(3), answer.gap);
    CHECK_GREATER(hypot(x[0], x[1]), 1e5);
    DO(cps_set_face(polar, w, 0, &face, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NOT_ATTAINED);
    assert_null(face);
    DO(cps_set_extent(polar, w, &extent, &err));
    assert_int_equal(extent.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_false(extent.high_attained);
    CHECK_NEAR(extent.high, 1 / sqrt(3), 1e-6);
    /* inside the barrier cone the point (1, 0)/2 answers, outside it a ray */
    DO(cps_set_support(polar, inner, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, 1. / 3, 1e-12);
    DO(cps_set_support(polar, outer, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    DO(cps_set_facts(polar, 0, &facts, NULL, NULL, &err));
    assert_int_equal(facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_false(facts.bounded);
    cps_set_release(disc);
    cps_set_release(polar);
}

/* The hyperbola's region has the open half-line below 1/sqrt 3 as its image along the asymptote's
 * normal: the closure answers, and says that it is one. So do sums of two such sets and hulls of
 * unbounded ones; others are closed. */
static void closures_say_so(void **state) {
    (void)state;
    const double w[2] = {sqrt(3) / 2, 0.5}, one = 1;
    CpsSet *disc, *polar, *strip, *set;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    double x[2];
    DO(cps_set_ball(2, (const double[]){2, 0}, 1, &disc, &err));
    DO(cps_set_polar(disc, &polar, &err));
    DO(cps_set_strip(2, w, 0, 1, &strip, &err));
    DO(cps_set_image(1, w, polar, &set, &err));
    DO(cps_set_support(set, &one, x, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_true(answer.closure);
    CHECK_NEAR(answer.value, 1 / sqrt(3), 1e-6);
    CHECK_NEAR(x[0], 1 / sqrt(3), 1e-6);
    DO(cps_set_facts(set, 0, &facts, NULL, NULL, &err));
    assert_true(facts.closure);
    cps_set_release(set);
    CpsSet *const with[] = {polar, strip, disc};
    const bool closure[] = {true, false, false};
    for (int k = 0; k < 3; k++) {
        DO(cps_set_sum(2, (const CpsSet *[]){k == 1 ? strip : polar, with[k]}, &set, &err));
        DO(cps_set_support(set, (const double[]){1, 0}, x, &answer, &err));
        assert_int_equal(answer.closure, closure[k]);
        cps_set_release(set);
    }
    DO(cps_set_hull(2, (const CpsSet *[]){strip, disc}, &set, &err));
    DO(cps_set_contains(set, w, NULL, &answer, &err));
    assert_true(answer.closure);
    cps_set_release(disc);
    cps_set_release(polar);
    cps_set_release(strip);
    cps_set_release(set);
}

/* Where 0 is, told from the parts of a sum: of many contacts, which no conic program could hold,
 * and of points that are far apart in size. */
static void zero_is_found_by_parts(void **state) {
    (void)state;
    enum { COUNT = 1500 };
    static CpsSet *part[COUNT];
    CpsSet *disc, *set, *far;
    CpsSetFacts facts;
    DO(cps_set_ball(2, NULL, 1.0 / COUNT, &disc, &err));
    for (int k = 0; k < COUNT; k++) {
        const double x = cos(k), y = sin(k), map[6] = {1, 0, 0, 1, -y, x};
        DO(cps_set_image(3, map, disc, &part[k], &err));
    }
    DO(cps_set_sum(COUNT, (const CpsSet *const *)part, &set, &err));
    DO(cps_set_facts(set, 0, &facts, NULL, NULL, &err));
    assert_int_equal(facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_INT(facts.dimension, 3);
    assert_true(facts.bounded && facts.has_zero && facts.zero_interior);
    DO(cps_set_translate((const double[]){5, 0, 0}, set, &far, &err));
    DO(cps_set_facts(far, 0, &facts, NULL, NULL, &err));
    assert_int_equal(facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_false(facts.has_zero);
    for (int k = 0; k < COUNT; k++) cps_set_release(part[k]);
    cps_set_release(disc);
    cps_set_release(set);
    cps_set_release(far);

    DO(cps_set_point(1, (const double[]){2.1}, &part[0], &err));
    DO(cps_set_scale(7.5e10, part[0], &part[1], &err));
    DO(cps_set_box(1, (const double[]){0.3}, (const double[]){0.3}, &part[2], &err));
    DO(cps_set_sum(3, (const CpsSet *const *)part, &set, &err));
    DO(cps_set_facts(set, 0, &facts, NULL, NULL, &err));
    assert_int_equal(facts.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_INT(facts.dimension, 0);
    assert_false(facts.has_zero);
    for (int k = 0; k < 3; k++) cps_set_release(part[k]);
    cps_set_release(set);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_arguments_are_refused),
        cmocka_unit_test(parts_are_held),
        cmocka_unit_test(degenerate_sets_are_answered),
        cmocka_unit_test(users_sets_answer_their_support),
        cmocka_unit_test(projections_and_gauges),
        cmocka_unit_test(faces_and_cones_of_a_cube),
        cmocka_unit_test(what_is_not_attained_says_so),
        cmocka_unit_test(closures_say_so),
        cmocka_unit_test(zero_is_found_by_parts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
