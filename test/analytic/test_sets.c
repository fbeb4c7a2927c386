/* SPDX-License-Identifier: BSD-3-Clause */
/* Closed forms of sets: elementary sets, the braked wheel's set disc ∩ strip (M77 §11), limit
 * surfaces of area contact as Minkowski sums over contacts. Tolerance of closed forms: 1e-10 of the
 * expected value, unless said. */
#include "check.h"

#include <stdio.h>
#include <string.h>

#include "capstan/set.h"

static CpsError err;
#define DO(call) assert_int_equal((call), CPS_OK)

static const double PI = 3.14159265358979323846;

static double show(const char *what, double want, double got) {
    print_message("%-44s expected %.15g, found %.15g, relative %.1e\n", what, want, got,
                  want != 0 ? got / want - 1 : got);
    return got;
}

static double support(const CpsSet *set, double a, double b) {
    const double w[2] = {a, b};
    CpsSetAnswer answer;
    DO(cps_set_support(set, w, NULL, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    return answer.value;
}

/* disc of radius 500 ∩ {|j.G| <= 200}, j the second axis; or the same as a preimage of interval x
 * disc */
static CpsSet *wheel(bool preimage) {
    static const double AXIS[2] = {0, 1}, MAP[6] = {0, -0.3, 1, 0, 0, 1};
    CpsSet *part[2], *product, *set;
    DO(cps_set_ball(2, NULL, 500, &part[1], &err));
    if (preimage) {
        DO(cps_set_interval(-60, 60, &part[0], &err));
        DO(cps_set_product(2, (const CpsSet *const *)part, &product, &err));
        DO(cps_set_preimage(2, MAP, NULL, product, &set, &err));
        cps_set_release(product);
    } else {
        DO(cps_set_strip(2, AXIS, -200, 200, &part[0], &err));
        DO(cps_set_intersection(2, (const CpsSet *const *)part, &set, &err));
    }
    cps_set_release(part[0]);
    cps_set_release(part[1]);
    return set;
}

static void elementary_sets(void **state) {
    (void)state;
    static const double SHAPE[4] = {9, 0, 0, 1}, LOW[2] = {-3, -1}, HIGH[2] = {3, 1},
                        SHIFT[2] = {2, -1};
    CpsSet *ellipse, *box, *disc, *polar, *moved;
    CpsSetMeasure measure;
    DO(cps_set_ellipsoid(2, NULL, SHAPE, &ellipse, &err));
    DO(cps_set_box(2, LOW, HIGH, &box, &err));
    DO(cps_set_ball(2, NULL, 4, &disc, &err));
    DO(cps_set_polar(disc, &polar, &err));
    DO(cps_set_translate(SHIFT, ellipse, &moved, &err));
    CHECK_RELATIVE(show("ellipse 3, 1 along (0.6, 0.8)", 1.9697715603592207,
                        support(ellipse, 0.6, 0.8)),
                   1.9697715603592207, 1e-15);
    CHECK_RELATIVE(support(moved, 0.6, 0.8), 1.9697715603592207 + 0.4, 1e-15);
    CHECK_RELATIVE(support(box, 0.6, 0.8), 2.6, 1e-15);
    CHECK_RELATIVE(show("polar of the disc of radius 4", 0.25, support(polar, 0.6, 0.8)), 0.25,
                   1e-10);
    DO(cps_set_measure(ellipse, &measure, &err));
    CHECK_RELATIVE(show("area of the ellipse", 3 * PI, measure.area), 3 * PI, 1e-10);
    /* perimeter 4 a E(e), a = 3, e^2 = 8/9 */
    CHECK_RELATIVE(show("perimeter of the ellipse", 13.364893220555258, measure.perimeter),
                   13.364893220555258, 1e-10);
    DO(cps_set_measure(box, &measure, &err));
    CHECK_RELATIVE(measure.area, 12, 1e-14);
    CHECK_RELATIVE(measure.perimeter, 16, 1e-14);
    cps_set_release(ellipse);
    cps_set_release(box);
    cps_set_release(disc);
    cps_set_release(polar);
    cps_set_release(moved);
}

static void wheel_support_area_and_corners(void **state) {
    (void)state;
    static const double CASE[5][3] = {{1, 0, 500},
                                      {1, 0.3, 522.0153254455275},
                                      {1, 1, 658.257569495584},
                                      {0.5, 2, 629.128784747792},
                                      {0, 1, 200}};
    static const double CORNER = 458.257569495584;
    for (int form = 0; form < 2; form++) {
        CpsSet *set = wheel(form == 1);
        for (int k = 0; k < 5; k++)
            CHECK_RELATIVE(show("wheel, dissipation", CASE[k][2],
                                support(set, CASE[k][0], CASE[k][1])),
                           CASE[k][2], 1e-12);
        CpsSetMeasure measure;
        DO(cps_set_measure(set, &measure, &err));
        CHECK_RELATIVE(show("wheel, area", 389061.45083197765, measure.area), 389061.45083197765,
                       1e-10);
        CHECK_RELATIVE(show("wheel, perimeter", 2656.0639701173122, measure.perimeter),
                       2656.0639701173122, 1e-10);
        double corner[8];
        int count;
        CpsSetAnswer answer;
        DO(cps_set_vertices(set, 0, 4, corner, &count, &answer, &err));
        CHECK_INT(count, 4);
        for (int k = 0; k < 4; k++) {
            CHECK_RELATIVE(fabs(corner[2 * k]), CORNER, 1e-10);
            CHECK_RELATIVE(fabs(corner[2 * k + 1]), 200, 1e-10);
            /* the normal cone is spanned by +-j and the radial direction */
            CpsSet *cone;
            double ray[4];
            DO(cps_set_normal_cone(set, &corner[2 * k], 0, &cone, &answer, &err));
            assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
            DO(cps_set_rays(cone, 0, 2, ray, &count, &answer, &err));
            CHECK_INT(count, 2);
            const double angle = acos(ray[0] * ray[2] + ray[1] * ray[3]);
            CHECK_RELATIVE(show("wheel, opening of a corner", acos(0.4), angle), acos(0.4), 1e-10);
            cps_set_release(cone);
        }
        cps_set_release(set);
    }
}

/* W along j answers an edge, W inside a corner's sector the corner, W along i one point of the
 * arc. */
static void wheel_faces(void **state) {
    (void)state;
    static const double CORNER = 458.257569495584;
    static const struct {
        double w[2];
        int dimension;
        double low, high;
    } CASE[] = {{{0, 1}, 1, -458.257569495584, 458.257569495584},
                {{1, 1}, 0, 458.257569495584, 458.257569495584},
                {{1, 0}, 0, 500, 500}};
    CpsSet *set = wheel(false);
    for (size_t k = 0; k < sizeof CASE / sizeof *CASE; k++) {
        CpsSet *face;
        CpsSetAnswer answer;
        CpsSetFacts facts;
        CpsSetExtent extent;
        DO(cps_set_face(set, CASE[k].w, 0, &face, &answer, &err));
        assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        DO(cps_set_facts(face, 0, &facts, NULL, NULL, &err));
        CHECK_INT(facts.dimension, CASE[k].dimension);
        DO(cps_set_extent(face, (const double[]){1, 0}, &extent, &err));
        CHECK_NEAR(extent.low, CASE[k].low, 1e-10 * CORNER);
        CHECK_NEAR(extent.high, CASE[k].high, 1e-10 * CORNER);
        cps_set_release(face);
    }
    cps_set_release(set);
}

/* Two discs of radius 1, their centres 2 sin(a/2) apart: two corners, whose cones open by a,
 * however little that is. Discs joined smoothly have none. */
static void corners_between_arcs(void **state) {
    (void)state;
    CpsSet *disc, *moved, *set, *box;
    CpsSetAnswer answer;
    CpsSetMeasure measure;
    double corner[16];
    int count;
    DO(cps_set_ball(2, NULL, 1, &disc, &err));
    for (double angle = 1; angle > 5e-6; angle /= 10) {
        DO(cps_set_translate((const double[]){2 * sin(angle / 2), 0}, disc, &moved, &err));
        DO(cps_set_intersection(2, (const CpsSet *[]){disc, moved}, &set, &err));
        DO(cps_set_vertices(set, 0, 8, corner, &count, &answer, &err));
        CHECK_INT(count, 2);
        /* over the angle a point moves by a^2/8, which 1e-9 of the size tells from 0 within
         * 1e-9/a */
        CHECK_NEAR(corner[0], sin(angle / 2), 1e-9);
        CHECK_NEAR(fabs(corner[1]), cos(angle / 2), 1e-9);
        DO(cps_set_measure(set, &measure, &err));
        CHECK_RELATIVE(show("lens of two discs, area", PI - angle - sin(angle), measure.area),
                       PI - angle - sin(angle), 1e-8);
        CHECK_RELATIVE(measure.perimeter, 2 * (PI - angle), 1e-8);
        cps_set_release(moved);
        cps_set_release(set);
    }
    DO(cps_set_box(2, (const double[]){-1, -2}, (const double[]){1, 2}, &box, &err));
    DO(cps_set_sum(2, (const CpsSet *[]){box, disc}, &set, &err));
    DO(cps_set_vertices(set, 0, 8, corner, &count, &answer, &err));
    CHECK_INT(count, 0);
    DO(cps_set_measure(set, &measure, &err)); /* Steiner: 8 + 12 + pi, 12 + 2 pi */
    CHECK_RELATIVE(show("box and disc, area", 20 + PI, measure.area), 20 + PI, 1e-10);
    CHECK_RELATIVE(measure.perimeter, 12 + 2 * PI, 1e-10);
    cps_set_release(disc);
    cps_set_release(box);
    cps_set_release(set);
}

static void measured(const char *what, const CpsSet *set, double area, double perimeter,
                     double tolerance) {
    CpsSetMeasure measure;
    DO(cps_set_measure(set, &measure, &err));
    assert_int_equal(measure.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_RELATIVE(show(what, area, measure.area), area, tolerance);
    CHECK_RELATIVE(show("  perimeter", perimeter, measure.perimeter), perimeter, tolerance);
    /* the gap is true, to the rounding of the expected values */
    CHECK_LESS(fabs(measure.area - area), measure.area_gap + 1e-14 * area);
    CHECK_LESS(fabs(measure.perimeter - perimeter), measure.perimeter_gap + 1e-14 * perimeter);
}

/* Ellipses of any aspect, in closed form and along the outline, turned and scaled: pi a b, 4 a
 * E(e). */
static void thin_ellipses(void **state) {
    (void)state;
    static const double AXES[][3] = {{3, 1, 13.364893220555258},
                                     {1e3, 1e-3, 4000.0000000294126},
                                     {1e100, 1e-100, 4e100},
                                     {2, 2, 12.566370614359172}};
    const double origin[2] = {0, 0}, turn[4] = {0.6, -0.8, 0.8, 0.6}, shift[2] = {7, -5};
    for (size_t k = 0; k < sizeof AXES / sizeof *AXES; k++) {
        const double a = AXES[k][0], b = AXES[k][1], shape[4] = {a * a, 0, 0, b * b};
        CpsSet *ellipse, *point, *sum, *turned, *moved, *scaled;
        DO(cps_set_ellipsoid(2, NULL, shape, &ellipse, &err));
        DO(cps_set_image(2, turn, ellipse, &turned, &err));
        DO(cps_set_translate(shift, turned, &moved, &err));
        DO(cps_set_scale(-0.5, moved, &scaled, &err));
        DO(cps_set_point(2, origin, &point, &err));
        measured("ellipse, area", ellipse, PI * a * b, AXES[k][2], 1e-14);
        measured("ellipse turned and scaled, area", scaled, PI * a * b / 4, AXES[k][2] / 2, 1e-14);
        if (a < 1e6) { /* thinner than 1e-7 of the size counts as flat */
            DO(cps_set_sum(2, (const CpsSet *[]){ellipse, point}, &sum, &err));
            measured("ellipse along its outline, area", sum, PI * a * b, AXES[k][2], 1e-12);
            cps_set_release(sum);
        }
        cps_set_release(ellipse);
        cps_set_release(point);
        cps_set_release(turned);
        cps_set_release(moved);
        cps_set_release(scaled);
    }
}

/* N ellipses of half axes a > b about one centre, turned by pi/N from one to the next. In each
 * direction the nearest short axis decides: at the angle t from it r(t) = a b/hypot(a cos t, b sin
 * t), |t| <= pi/(2 N), so that there are 2 N corners, at r(pi/(2 N)), and the area is 2 N a b
 * atan(b/a tan(pi/(2 N))). */
static void rosette(void **state) {
    (void)state;
    enum { N = 15 };
    const double a = 3, b = 1, half = PI / (2 * N),
                 corner = a * b / hypot(a * cos(half), b * sin(half));
    const double area = 2 * N * a * b * atan(b / a * tan(half));
    CpsSet *part[N], *set;
    CpsSetMeasure measure;
    CpsSetAnswer answer;
    double vertex[4 * 2 * N];
    int count;
    for (int k = 0; k < N; k++) {
        const double c = cos(2 * half * k), s = sin(2 * half * k), both = (a * a - b * b) * c * s;
        const double shape[4] = {a * a * c * c + b * b * s * s, both, both,
                                 a * a * s * s + b * b * c * c};
        DO(cps_set_ellipsoid(2, NULL, shape, &part[k], &err));
    }
    DO(cps_set_intersection(N, (const CpsSet *const *)part, &set, &err));
    DO(cps_set_measure(set, &measure, &err));
    CHECK_RELATIVE(show("rosette of 15 ellipses, area", area, measure.area), area, 1e-10);
    CHECK_LESS(fabs(measure.area - area), measure.area_gap + 1e-14 * area);
    DO(cps_set_vertices(set, 0, 4 * N, vertex, &count, &answer, &err));
    CHECK_INT(count, 2 * N);
    /* a corner's place is what its supports leave, whose gap is 1e-9 of the size at most */
    for (int k = 0; k < count; k++)
        CHECK_RELATIVE(hypot(vertex[2 * k], vertex[2 * k + 1]), corner, 1e-8);
    CHECK_RELATIVE(show("  support at a corner", corner, support(set, -sin(half), cos(half))),
                   corner, 1e-10);
    for (int k = 0; k < N; k++) cps_set_release(part[k]);
    cps_set_release(set);
}

/* Polygons by points and by inequalities, a disc cut by lines, the flat and the far. */
static void polygons_and_cut_discs(void **state) {
    (void)state;
    const double corner[10] = {0, 0, 1e6, 1, 1e6, -1e-6, 5e5, 0.1, 0, 0}, up[2] = {0, 2},
                 place[2] = {3, -1};
    const double row[8] = {1, 0, -1, 0, 0, 1, 0, -1}, offset[4] = {1e6, 1e6, 1, 1},
                 ends[4] = {3, -1, 3, 1};
    CpsSet *polygon, *disc, *half, *strip, *cut, *segment, *sum;
    DO(cps_set_hull_of_points(2, 5, corner, &polygon, &err));
    measured("thin triangle, area", polygon, 5e5 + 0.5, 1e6 + 1.000001 + hypot(1e6, 1) + 5e-19,
             1e-15);
    cps_set_release(polygon);
    DO(cps_set_inequalities(2, 4, row, offset, &polygon, &err));
    measured("thin box by inequalities, area", polygon, 4e6, 4e6 + 4, 1e-9);
    DO(cps_set_ball(2, place, 2, &disc, &err));
    DO(cps_set_half_space(2, up, -2, &half, &err));
    DO(cps_set_intersection(2, (const CpsSet *[]){half, disc}, &cut, &err));
    measured("half a disc, area", cut, 2 * PI, 2 * PI + 4, 1e-15);
    cps_set_release(cut);
    DO(cps_set_strip(2, up, -4, 0, &strip, &err)); /* lines at 1 on both sides of the centre */
    DO(cps_set_intersection(2, (const CpsSet *[]){disc, strip}, &cut, &err));
    measured("disc between lines, area", cut, 4 * (PI / 3 + sqrt(0.75)), 4 * PI / 3 + 4 * sqrt(3),
             1e-15);
    DO(cps_set_hull_of_points(2, 2, ends, &segment, &err));
    DO(cps_set_sum(2, (const CpsSet *[]){segment, segment}, &sum, &err));
    measured("upright segment, area", sum, 0, 8, 1e-15);
    double vertex[4];
    int count;
    CpsSetAnswer answer;
    DO(cps_set_vertices(sum, 0, 2, vertex, &count, &answer, &err));
    CHECK_INT(count, 2);
    CHECK_NEAR(fabs(vertex[3] - vertex[1]), 4, 1e-14);
    cps_set_release(polygon);
    cps_set_release(disc);
    cps_set_release(half);
    cps_set_release(strip);
    cps_set_release(cut);
    cps_set_release(segment);
    cps_set_release(sum);
}

static void margin(const CpsSet *set, double x, double y, double want, bool exact) {
    CpsSetAnswer answer;
    DO(cps_set_contains(set, (const double[]){x, y}, NULL, &answer, &err));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, want, 1e-12);
    CHECK_LESS(fabs(answer.value - want), answer.gap + 1e-14);
    assert_int_equal(answer.exact, exact);
}

/* Margins inside: the ellipse 3, 1, whose nearest point from (x, 0) is (9x/8, ..) up to x = 8/3 and
 * then its end; sums with a disc; similar images and preimages; polars; others by enclosure. */
static void margins_inside(void **state) {
    (void)state;
    const double shape[4] = {9, 0, 0, 1}, turn[4] = {1.2, -1.6, 1.6, 1.2}, low[2] = {-1, -2},
                 high[2] = {1, 2};
    CpsSet *ellipse, *disc, *box, *sum, *image, *preimage, *cross, *polar, *hull;
    DO(cps_set_ellipsoid(2, NULL, shape, &ellipse, &err));
    margin(ellipse, 0, 0, 1, true);
    margin(ellipse, 1, 0, sqrt(1 - 1.0 / 8), true);
    margin(ellipse, 8.0 / 3, 0, 1.0 / 3, true);
    margin(ellipse, 2.9, 0, 0.1, true);
    margin(ellipse, 0, 0.25, 0.75, true);
    margin(ellipse, 0, 3, -2, true);
    DO(cps_set_ball(2, NULL, 0.5, &disc, &err));
    DO(cps_set_sum(2, (const CpsSet *[]){disc, ellipse}, &sum, &err));
    margin(sum, 1, 0, sqrt(1 - 1.0 / 8) + 0.5, true);
    margin(sum, 0, 1.25, 0.25, true); /* outside the ellipse, inside the sum */
    margin(sum, 0, 3, -1.5, true);
    DO(cps_set_image(2, turn, ellipse, &image, &err));
    margin(image, 1.2, 1.6, 2 * sqrt(1 - 1.0 / 8), true);
    DO(cps_set_preimage(2, turn, NULL, image, &preimage, &err));
    margin(preimage, 1, 0, sqrt(1 - 1.0 / 8), true);
    DO(cps_set_hull_of_points(2, 4, (const double[]){1, 0, -1, 0, 0, 1, 0, -1}, &cross, &err));
    margin(cross, 0.25, 0, 0.75 / sqrt(2), true);
    DO(cps_set_polar(cross, &polar, &err)); /* the square */
    margin(polar, 0.25, 0.5, 0.5, true);
    DO(cps_set_box(2, low, high, &box, &err));
    DO(cps_set_hull(2, (const CpsSet *[]){box, disc}, &hull, &err));
    margin(hull, 0.25, 0, 0.75, false);
    cps_set_release(sum);
    cps_set_release(hull);
    DO(cps_set_sum(2, (const CpsSet *[]){box, ellipse}, &sum, &err));
    margin(sum, 0, 0, 3, false);
    margin(sum, 3.5, 2, sqrt(1 - 2.5 * 2.5 / 8), false); /* the arc about the corner */
    cps_set_release(ellipse);
    cps_set_release(disc);
    cps_set_release(box);
    cps_set_release(sum);
    cps_set_release(image);
    cps_set_release(preimage);
    cps_set_release(cross);
    cps_set_release(polar);
}

/* ---- limit surfaces: C = sum over contacts of B' D, B' f = (f, x f_y - y f_x), D the disc of the
 * contact's share ----
 */

static CpsSet *contacts(int count, const double *place, const double *share) {
    CpsSet **part = test_calloc((size_t)count, sizeof *part), *disc, *set;
    for (int k = 0; k < count; k++) {
        const double map[6] = {1, 0, 0, 1, -place[2 * k + 1], place[2 * k]};
        DO(cps_set_ball(2, NULL, share[k], &disc, &err));
        DO(cps_set_image(3, map, disc, &part[k], &err));
        cps_set_release(disc);
    }
    DO(cps_set_sum(count, (const CpsSet *const *)part, &set, &err));
    for (int k = 0; k < count; k++) cps_set_release(part[k]);
    test_free(part);
    return set;
}

static double twist(const CpsSet *set, double vx, double vy, double w) {
    const double direction[3] = {vx, vy, w};
    CpsSetAnswer answer;
    DO(cps_set_support(set, direction, NULL, &answer, &err));
    assert_true(answer.exact);
    return answer.value;
}

enum { MOST = 128 * 256 };
static double place[2 * MOST], share[MOST];

static double ring(int count, double v, double w) {
    for (int k = 0; k < count; k++) {
        place[2 * k] = cos(2 * PI * k / count);
        place[2 * k + 1] = sin(2 * PI * k / count);
        share[k] = 1.0 / count;
    }
    CpsSet *set = contacts(count, place, share);
    const double value = twist(set, v, 0, w);
    cps_set_release(set);
    return value;
}

/* phi = (2/pi)(|v| + |w|) E(m): periodic and smooth at (1, 0.5), so the sum converges faster than
 * any power; with the centre of rotation on the ring (1, 1) at second order. */
static void ring_limit_surface(void **state) {
    (void)state;
    CHECK_RELATIVE(show("ring, 128 contacts, (1, 0.5)", 1.0635444099733649, ring(128, 1, 0.5)),
                   1.0635444099733649, 1e-12);
    double before = 0;
    for (int count = 64; count <= 1024; count *= 4) {
        const double off = fabs(show("ring, (1, 1)", 4 / PI, ring(count, 1, 1)) - 4 / PI);
        if (before > 0) CHECK_BETWEEN(before / off, 15.9, 16.1);
        before = off;
    }
}

/* uniform disc: midpoint rule in the radius, spectral in the angle: second order; phi = e F(e) +
 * T(e) at v = e, w = 1
 */
static void disc_limit_surface(void **state) {
    (void)state;
    const double want = 0.25 * 0.24803130976 + 0.63578612361;
    double before = 0;
    for (int rings = 8; rings <= 128; rings *= 4) {
        const int around = 256;
        for (int i = 0; i < rings; i++)
            for (int k = 0; k < around; k++) {
                const int at = i * around + k;
                const double r = (i + 0.5) / rings;
                place[2 * at] = r * cos(2 * PI * (k + 0.5) / around);
                place[2 * at + 1] = r * sin(2 * PI * (k + 0.5) / around);
                share[at] = 2 * r / rings / around;
            }
        CpsSet *set = contacts(rings * around, place, share);
        const double off = fabs(show("disc, e = 0.25", want, twist(set, 0.25, 0, 1)) - want);
        /* the kink at the centre of rotation disturbs the order a little; the printed constants
         * have 11 digits */
        if (before > 0) CHECK_BETWEEN(before / off, 10, 25);
        before = off;
        cps_set_release(set);
    }
    CHECK_LESS(before, 1e-4);
}

static void rod_limit_surface(void **state) {
    (void)state;
    const double want = 1.17610140974653;
    double before = 0;
    for (int count = 16; count <= 1024; count *= 4) {
        for (int k = 0; k < count; k++) {
            place[2 * k] = -1 + (2 * k + 1.0) / count;
            place[2 * k + 1] = 0;
            share[k] = 1.0 / count;
        }
        CpsSet *set = contacts(count, place, share);
        const double off = fabs(show("rod, (1, 0.5, 0.7)", want, twist(set, 1, 0.5, 0.7)) - want);
        if (before > 0) CHECK_BETWEEN(before / off, 15.8, 16.2); /* midpoint rule */
        before = off;
        cps_set_release(set);
    }
}

/* Two supports at +-1: turning about one of them leaves its whole disc free, a face of dimension
 * 2. */
/* Sets that touch: two discs, a ball and a plane, a line and a disc as a preimage. What they have
 * in common is one point, its normals all directions; the discs' directions do not have exact
 * sines, so that rounding decides whether they meet. */
static void touching_sets(void **state) {
    (void)state;
    for (int k = 0; k < 60; k++) {
        const double a = 0.1 * k, r = 0.5 + 0.05 * k, n[2] = {cos(a), sin(a)};
        CpsSet *part[2], *both = NULL, *cone = NULL;
        CpsSetAnswer answer;
        CpsSetFacts facts;
        double point[2];
        assert_int_equal(cps_set_ball(2, (double[]){n[0], n[1]}, 1, &part[0], NULL), CPS_OK);
        assert_int_equal(cps_set_ball(2, (double[]){-r * n[0], -r * n[1]}, r, &part[1], NULL),
                         CPS_OK);
        assert_int_equal(cps_set_intersection(2, (const CpsSet *const *)part, &both, NULL), CPS_OK);
        assert_int_equal(cps_set_support(both, (double[]){-n[1], n[0]}, point, &answer, NULL),
                         CPS_OK);
        CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        CHECK_NEAR(point[0], 0, 1e-7);
        CHECK_NEAR(point[1], 0, 1e-7); /* the root of what rounding lets them overlap */
        assert_int_equal(cps_set_facts(both, 0, &facts, NULL, NULL, NULL), CPS_OK);
        CHECK_INT(facts.dimension, 0);
        assert_int_equal(cps_set_normal_cone(both, (double[]){0, 0}, 1e-6, &cone, &answer, NULL),
                         CPS_OK);
        assert_int_equal(cps_set_facts(cone, 0, &facts, NULL, NULL, NULL), CPS_OK);
        CHECK_INT(facts.dimension, 2);
        assert_true(facts.zero_interior);
        cps_set_release(cone);
        cps_set_release(both);
        cps_set_release(part[0]);
        cps_set_release(part[1]);
    }
    /* {(x, y) : (x, y, 1) in the unit ball} = {0}, and a ball on a plane of its own height */
    CpsSet *ball = NULL, *touch = NULL, *half = NULL;
    CpsSetAnswer answer;
    double nearest[3];
    assert_int_equal(cps_set_ball(3, NULL, 1, &ball, NULL), CPS_OK);
    assert_int_equal(cps_set_preimage(2, (double[]){1, 0, 0, 1, 0, 0}, (double[]){0, 0, 1}, ball,
                                      &touch, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_project(touch, (double[]){3, 4}, NULL, nearest, &answer, NULL),
                     CPS_OK);
    CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, 5, 1e-9);
    cps_set_release(touch);
    assert_int_equal(cps_set_half_space(3, (double[]){0, 0, -1}, -1, &half, NULL), CPS_OK);
    assert_int_equal(cps_set_intersection(2, (const CpsSet *const[]){ball, half}, &touch, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_project(touch, (double[]){3, 4, 1}, NULL, nearest, &answer, NULL),
                     CPS_OK);
    CHECK_NEAR(answer.value, 5, 1e-9);
    CHECK_NEAR(nearest[2], 1, 1e-12);
    cps_set_release(touch);
    cps_set_release(half);
    cps_set_release(ball);
}

/* The gauge of a ball with 0 on its boundary, in directions of which some have no multiple of it:
 * |x|^2/2<c, x>. */
static void gauge_through_zero(void **state) {
    (void)state;
    for (int k = 0; k < 48; k++) {
        const double a = 0.13 * k, r = 1 + 0.25 * k, c[2] = {r * cos(1.7 * k), r * sin(1.7 * k)},
                     x[2] = {3 * cos(a), 3 * sin(a)};
        const double along = c[0] * x[0] + c[1] * x[1];
        CpsSet *ball = NULL;
        CpsSetAnswer answer;
        assert_int_equal(cps_set_ball(2, c, r, &ball, NULL), CPS_OK);
        assert_int_equal(cps_set_gauge(ball, x, &answer, NULL), CPS_OK);
        CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        if (along > 0)
            CHECK_RELATIVE(answer.value, 9 / (2 * along), 1e-12);
        else
            assert_true(isinf(answer.value));
        cps_set_release(ball);
    }
}

/* The hull of a disc and a half-plane below it is, closed, the half-plane up to the disc's top: its
 * face there is the whole line. */
static void face_of_an_unbounded_hull(void **state) {
    (void)state;
    CpsSet *part[2], *hull = NULL, *face = NULL;
    CpsSetAnswer answer;
    CpsSetExtent extent;
    assert_int_equal(cps_set_ball(2, NULL, 1, &part[0], NULL), CPS_OK);
    assert_int_equal(cps_set_half_space(2, (double[]){0, 1}, 0, &part[1], NULL), CPS_OK);
    assert_int_equal(cps_set_hull(2, (const CpsSet *const *)part, &hull, NULL), CPS_OK);
    assert_int_equal(cps_set_face(hull, (double[]){0, 1}, 0, &face, &answer, NULL), CPS_OK);
    CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_int_equal(cps_set_extent(face, (double[]){1, 0}, &extent, NULL), CPS_OK);
    assert_true(isinf(extent.low) && isinf(extent.high));
    assert_int_equal(cps_set_extent(face, (double[]){0, 1}, &extent, NULL), CPS_OK);
    CHECK_NEAR(extent.low, 1, 1e-9);
    CHECK_NEAR(extent.high, 1, 1e-9);
    cps_set_release(face);
    cps_set_release(hull);
    cps_set_release(part[0]);
    cps_set_release(part[1]);
}

/* A ball cut by a half-space ends in a disc, whose unit is its radius, whatever that is: its
 * dimension does not depend on the units, and it is bounded, so that its sum with itself is closed.
 */
static void face_of_a_cut_ball(void **state) {
    (void)state;
    for (double r = 1e4; r > 1e-9; r /= 100) {
        const double w[3] = {1, 0, 0}, offset = 0.5 * r;
        CpsSet *ball, *half, *cut, *face, *sum;
        CpsSetAnswer answer;
        CpsSetFacts facts;
        DO(cps_set_ball(3, NULL, r, &ball, &err));
        DO(cps_set_inequalities(3, 1, w, &offset, &half, &err));
        DO(cps_set_intersection(2, (const CpsSet *[]){ball, half}, &cut, &err));
        DO(cps_set_face(cut, w, 0, &face, &answer, &err));
        DO(cps_set_facts(face, 0, &facts, NULL, NULL, &err));
        CHECK_INT(facts.dimension, 2);
        assert_true(facts.bounded);
        CHECK_LESS(facts.tolerance, 1.1e-7 * r);
        CHECK_GREATER(facts.tolerance, 0.8e-7 * r);
        DO(cps_set_sum(2, (const CpsSet *[]){face, face}, &sum, &err));
        DO(cps_set_facts(sum, 0, &facts, NULL, NULL, &err));
        assert_false(facts.closure);
        CpsSet *all[] = {ball, half, cut, face, sum};
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) cps_set_release(all[k]);
    }
}

static void bipod_face(void **state) {
    (void)state;
    const double at[4] = {1, 0, -1, 0}, half[2] = {0.5, 0.5}, about_right[3] = {0, -1, 1};
    CpsSet *set = contacts(2, at, half), *face;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    DO(cps_set_face(set, about_right, 0, &face, &answer, &err));
    CHECK_RELATIVE(answer.value, 1, 1e-15); /* (0 + |-1 - 1|)/2 */
    DO(cps_set_facts(face, 0, &facts, NULL, NULL, &err));
    CHECK_INT(facts.dimension, 2);
    CpsSetExtent extent;
    DO(cps_set_extent(face, (const double[]){1, 0, 0}, &extent, &err));
    CHECK_NEAR(extent.low, -0.5, 1e-12);
    CHECK_NEAR(extent.high, 0.5, 1e-12);
    cps_set_release(set);
    cps_set_release(face);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elementary_sets),    cmocka_unit_test(wheel_support_area_and_corners),
        cmocka_unit_test(wheel_faces),        cmocka_unit_test(corners_between_arcs),
        cmocka_unit_test(ring_limit_surface), cmocka_unit_test(disc_limit_surface),
        cmocka_unit_test(rod_limit_surface),  cmocka_unit_test(face_of_a_cut_ball),
        cmocka_unit_test(bipod_face),         cmocka_unit_test(gauge_through_zero),
        cmocka_unit_test(touching_sets),      cmocka_unit_test(face_of_an_unbounded_hull),
        cmocka_unit_test(thin_ellipses),      cmocka_unit_test(polygons_and_cut_discs),
        cmocka_unit_test(margins_inside),     cmocka_unit_test(rosette),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
