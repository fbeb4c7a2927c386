/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction sets by their expressions: phi(u) = max -<u, F> against the formula of each part,
 * computed here, in random directions. */
#include "cable/friction_set.h"

#include "check.h"
#include "splitmix.h"

static const double TURN = 6.28318530717958647692;
/* phi of a set with a formula: a few roundings of reach |u|, the reaches here being below 2. */
static const double ROUNDING = 8e-16;
/* ... and by the small program (friction_set.h). */
static const double PROGRAM = 1e-12;

static CpsiFrictionSet *made(CpsSet *set) {
    CpsiFrictionSet *out = NULL;
    CpsError err = {0};
    const CpsStatus status = cpsi_friction_set_make(set, "bed", &out, &err);
    if (status) print_error("%s\n", err.message);
    assert_int_equal(status, CPS_OK);
    assert_non_null(out);
    cps_set_release(set);
    return out;
}

static double most(int count, const double *corner, const double u[2]) {
    double largest = -INFINITY;
    for (int k = 0; k < count; k++)
        largest = fmax(largest, -u[0] * corner[2 * k] - u[1] * corner[2 * k + 1]);
    return largest;
}

/* Corners of a polygon round 0, its sides tangent to a circle. */
static int polygon(uint64_t *stream, double (*corner)[2], double (*side)[2], double *offset) {
    const int count = 3 + (int)splitmix(stream, 0, 6);
    const double radius = splitmix(stream, 0.2, 0.8), first = splitmix(stream, 0, TURN);
    double angle[9];
    for (int k = 0; k <= count; k++)
        angle[k] =
            first + TURN * (k + (k < count && k > 0 ? splitmix(stream, -0.2, 0.2) : 0)) / count;
    for (int k = 0; k < count; k++) {
        const double middle = 0.5 * (angle[k] + angle[k + 1]),
                     far = radius / cos(0.5 * (angle[k + 1] - angle[k]));
        side[k][0] = cos(angle[k]);
        side[k][1] = sin(angle[k]);
        offset[k] = radius;
        corner[k][0] = far * cos(middle);
        corner[k][1] = far * sin(middle);
    }
    return count;
}

/* A polygon as a hull of corners, as inequalities, as an intersection of half-planes, and as the
 * polar of its polar. */
static void polygons(void **unused) {
    (void)unused;
    uint64_t stream = 15;
    for (int trial = 0; trial < 30; trial++) {
        double corner[9][2], side[9][2], offset[9], pole[9][2];
        const int count = polygon(&stream, corner, side, offset);
        CpsSet *set[4] = {NULL}, *half[9], *hull;
        cps_set_hull_of_points(2, count, corner[0], &set[0], NULL);
        cps_set_inequalities(2, count, side[0], offset, &set[1], NULL);
        for (int k = 0; k < count; k++) {
            cps_set_half_space(2, side[k], offset[k], &half[k], NULL);
            for (int a = 0; a < 2; a++) pole[k][a] = side[k][a] / offset[k];
        }
        cps_set_intersection(count, (const CpsSet *const *)half, &set[2], NULL);
        for (int k = 0; k < count; k++) cps_set_release(half[k]);
        cps_set_hull_of_points(2, count, pole[0], &hull, NULL);
        cps_set_polar(hull, &set[3], NULL);
        cps_set_release(hull);
        for (int form = 0; form < 4; form++) {
            CpsiFrictionSet *friction = made(set[form]);
            for (int look = 0; look < 40; look++) {
                const double size = exp(splitmix(&stream, -20, 3)),
                             angle = splitmix(&stream, 0, TURN);
                const double u[2] = {size * cos(angle), size * sin(angle)};
                /* the corners of the other writings are computed from their sides */
                CHECK_NEAR(cpsi_friction_set_phi(friction, u), most(count, corner[0], u),
                           ROUNDING * 4 * size);
            }
            cpsi_friction_set_free(friction);
        }
    }
}

/* Sum, hull, image, scale and translate of a disc, an ellipse, a box and a segment. */
static void round_sets(void **unused) {
    (void)unused;
    uint64_t stream = 51;
    for (int trial = 0; trial < 30; trial++) {
        const double radius = splitmix(&stream, 0.1, 0.5), a = splitmix(&stream, 0.1, 0.5),
                     b = splitmix(&stream, 0.1, 0.5), far = splitmix(&stream, 0.5, 1),
                     shape[4] = {a * a, 0, 0, b * b}, low[2] = {-a, -b}, high[2] = {b, a},
                     shift[2] = {0.3 * radius, -0.5 * radius}, map[4] = {0.6, 0.3, -0.2, 0.7},
                     ends[2][2] = {{-0.2 * far, -far}, {0, far}},
                     corners[4][2] = {{-a, -b}, {b, -b}, {b, a}, {-a, a}};
        CpsSet *disc, *ellipse, *box, *segment, *moved, *set[4] = {NULL};
        cps_set_ball(2, NULL, radius, &disc, NULL);
        cps_set_ellipsoid(2, NULL, shape, &ellipse, NULL);
        cps_set_box(2, low, high, &box, NULL);
        cps_set_segment(2, ends[0], ends[1], &segment, NULL);
        cps_set_translate(shift, disc, &moved, NULL);
        cps_set_hull(2, (const CpsSet *const[]){disc, segment}, &set[0], NULL);
        cps_set_sum(3, (const CpsSet *const[]){ellipse, segment, moved}, &set[1], NULL);
        cps_set_image(2, map, box, &set[2], NULL);
        cps_set_scale(-0.5, set[1], &set[3], NULL);
        CpsSet *const parts[] = {disc, ellipse, box, segment, moved};
        for (int k = 0; k < 5; k++) cps_set_release(parts[k]);
        CpsiFrictionSet *friction[4];
        for (int k = 0; k < 4; k++) friction[k] = made(set[k]);
        for (int look = 0; look < 40; look++) {
            const double size = exp(splitmix(&stream, -20, 3)), angle = splitmix(&stream, 0, TURN);
            const double u[2] = {size * cos(angle), size * sin(angle)}, back[2] = {-u[0], -u[1]},
                         pulled[2] = {map[0] * u[0] + map[2] * u[1], map[1] * u[0] + map[3] * u[1]};
            const double tip = most(2, ends[0], u);
            const double sum = hypot(a * u[0], b * u[1]) + tip + radius * size - shift[0] * u[0] -
                               shift[1] * u[1],
                         turned = hypot(a * u[0], b * u[1]) + most(2, ends[0], back) +
                                  radius * size + shift[0] * u[0] + shift[1] * u[1];
            const double want[] = {fmax(radius * size, tip), sum, most(4, corners[0], pulled),
                                   0.5 * turned};
            for (int k = 0; k < 4; k++)
                CHECK_NEAR(cpsi_friction_set_phi(friction[k], u), want[k], ROUNDING * 4 * size);
        }
        for (int k = 0; k < 4; k++) cpsi_friction_set_free(friction[k]);
    }
}

/* A disc cut by a half-plane: its boundary is put together of theirs. */
static void cut_disc(void **unused) {
    (void)unused;
    uint64_t stream = 5;
    const double up[2] = {0, 1}, cut = 0.3, radius = 0.5;
    CpsSet *disc, *half, *both;
    cps_set_ball(2, NULL, radius, &disc, NULL);
    cps_set_half_space(2, up, cut, &half, NULL);
    cps_set_intersection(2, (const CpsSet *const[]){disc, half}, &both, NULL);
    cps_set_release(disc);
    cps_set_release(half);
    CpsiFrictionSet *friction = made(both);
    for (int look = 0; look < 200; look++) {
        const double size = exp(splitmix(&stream, -20, 3)), angle = splitmix(&stream, 0, TURN);
        const double u[2] = {size * cos(angle), size * sin(angle)}, half_width = 0.4;
        /* above the cut the nearest corner (0.4, 0.3) or (-0.4, 0.3) answers */
        const double want =
            -radius * u[1] > cut * size ? half_width * fabs(u[0]) - cut * u[1] : radius * size;
        for (int again = 0; again < 2; again++)
            CHECK_NEAR(cpsi_friction_set_phi(friction, u), want, PROGRAM * size);
    }
    CHECK_NEAR(cpsi_friction_set_phi(friction, (const double[2]){0, 0}), 0, 0);
    cpsi_friction_set_free(friction);
}

/* The same of an ellipse, which is the disc stretched by 2 across the cut, has no known boundary:
 * by the small program, asked for more slips than it keeps. */
static void cut_ellipse(void **unused) {
    (void)unused;
    enum { SLIPS = 1500 };
    uint64_t stream = 6;
    const double up[2] = {0, 1}, cut = 0.6, radius = 0.5;
    CpsSet *ellipse, *half, *both;
    cps_set_ellipsoid(2, NULL, (const double[]){radius * radius, 0, 0, 4 * radius * radius},
                      &ellipse, NULL);
    cps_set_half_space(2, up, cut, &half, NULL);
    cps_set_intersection(2, (const CpsSet *const[]){ellipse, half}, &both, NULL);
    cps_set_release(ellipse);
    cps_set_release(half);
    CpsiFrictionSet *friction = made(both);
    assert_null(cpsi_friction_set_shape(friction));
    double u[SLIPS][2], first[SLIPS];
    for (int turn = 0; turn < 2; turn++)
        for (int k = 0; k < SLIPS; k++) {
            if (turn == 0)
                for (int a = 0; a < 2; a++) u[k][a] = splitmix(&stream, -1, 1);
            const double half_width = 0.4, size = hypot(u[k][0], 2 * u[k][1]),
                         want = -2 * radius * 2 * u[k][1] > cut * size
                                    ? half_width * fabs(u[k][0]) - cut * u[k][1]
                                    : radius * size;
            const double phi = cpsi_friction_set_phi(friction, u[k]);
            CHECK_NEAR(phi, want, PROGRAM * size);
            if (turn == 0) first[k] = phi;
            assert_true(phi == first[k]);
        }
    cpsi_friction_set_free(friction);
}

/* A disc, a segment and a polygon about 0, alone or one after the other in a hull or a sum. */
static CpsSet *of_pieces(uint64_t *stream, int trial) {
    double corner[9][2], side[9][2], offset[9];
    const int count = polygon(stream, corner, side, offset);
    const double x = splitmix(stream, 0.1, 0.9), y = splitmix(stream, -0.9, 0.9),
                 radius = splitmix(stream, 0.1, 0.7);
    CpsSet *part[3], *out = NULL;
    cps_set_ball(2, (const double[]){0.5 * radius, 0}, radius, &part[0], NULL);
    cps_set_segment(2, (const double[]){-x, -y}, (const double[]){0.5 * x, 0.5 * y}, &part[1],
                    NULL);
    cps_set_hull_of_points(2, count, corner[0], &part[2], NULL);
    const int from = trial % 3, parts = trial % 5 == 0 && from != 1 ? 1 : 3 - (from == 2);
    const CpsSet *chosen[3] = {part[from], part[(from + 1) % 3], part[(from + 2) % 3]};
    if (parts == 1)
        out = cps_set_retain(chosen[0]);
    else
        (trial % 2 ? cps_set_hull : cps_set_sum)(parts, chosen, &out, NULL);
    for (int k = 0; k < 3; k++) cps_set_release(part[k]);
    return out;
}

/* The boundary of a set as edges, corners and arcs: distances and gauges of points against those of
 * the expression, and each piece against the support function. Releases the set. */
static void check_boundary(uint64_t *stream, CpsSet *set) {
    cps_set_retain(set);
    CpsiFrictionSet *friction = made(set);
    const CpsiFrictionShape *shape = cpsi_friction_set_shape(friction);
    assert_non_null(shape);
    for (int look = 0; look < 40; look++) {
        const double angle = splitmix(stream, 0, TURN), size = splitmix(stream, 0, 4);
        const double q[2] = {cos(angle), sin(angle)}, x[2] = {size * q[0], size * q[1]},
                     zero[2] = {0, 0}, against[2] = {-q[0], -q[1]};
        double nearest[2];
        CpsSetAnswer distance, gauge, support;
        int piece;
        assert_int_equal(cps_set_project(set, x, NULL, nearest, &distance, NULL), CPS_OK);
        assert_int_equal(cps_set_gauge(set, q, &gauge, NULL), CPS_OK);
        assert_int_equal(cps_set_support(set, q, NULL, &support, NULL), CPS_OK);
        CHECK_NEAR(cpsi_friction_shape_beyond(shape, x, &piece), distance.value, 1e-7);
        assert_int_equal(piece >= 0, gauge.value * size > 1);
        CHECK_NEAR(cpsi_friction_shape_reach(shape, zero, q) * gauge.value, 1, 1e-9);
        CHECK_NEAR(cpsi_friction_set_phi(friction, against), support.value, PROGRAM);
    }
    for (int i = 0; i < shape->count; i++) {
        const CpsiShapePiece *piece = &shape->piece[i],
                             *next = &shape->piece[(i + 1) % shape->count];
        for (int a = 0; a < 2; a++) CHECK_NEAR(piece->at[1][a], next->at[0][a], 1e-13);
        for (int end = 0; end < 2; end++) {
            const double *n = piece->normal[end], against[2] = {-n[0], -n[1]};
            CHECK_NEAR(n[0] * piece->at[end][0] + n[1] * piece->at[end][1],
                       cpsi_friction_set_phi(friction, against), 1e-14);
        }
    }
    cps_set_release(set);
    cpsi_friction_set_free(friction);
}

static void boundaries(void **unused) {
    (void)unused;
    uint64_t stream = 8;
    for (int trial = 0; trial < 60; trial++) {
        CpsSet *set = of_pieces(&stream, trial);
        check_boundary(&stream, set);
    }
}

/* Parts that have 0 inside: a disc, a polygon, a half-plane, a disc swept along a segment, and the
 * hull of a disc and a point. Two or more of them have a boundary in common, and so have those of
 * nested intersections. */
static void intersections(void **unused) {
    (void)unused;
    enum { PARTS = 5 };
    uint64_t stream = 77;
    for (int trial = 0; trial < 120; trial++) {
        double corner[9][2], side[9][2], offset[9];
        const int count = polygon(&stream, corner, side, offset);
        const double r = splitmix(&stream, 0.2, 0.9), angle = splitmix(&stream, 0, TURN),
                     away = splitmix(&stream, 0, 0.9) * r;
        const double q[2] = {cos(angle), sin(angle)}, at[2] = {away * q[0], away * q[1]},
                     half_away[2] = {-0.5 * at[1], 0.5 * at[0]}, far[2] = {-1.3 * q[1], 1.1 * q[0]},
                     near[2] = {-0.2 * far[0], -0.3 * far[1]};
        CpsSet *part[PARTS], *disc, *other;
        const CpsSet *chosen[PARTS];
        int parts = 0;
        cps_set_ball(2, at, r, &part[0], NULL);
        cps_set_hull_of_points(2, count, corner[0], &part[1], NULL);
        cps_set_half_space(2, q, splitmix(&stream, 0.05, 0.6), &part[2], NULL);
        cps_set_ball(2, half_away, splitmix(&stream, 0.6, 1) * r, &disc, NULL);
        cps_set_segment(2, near, far, &other, NULL);
        cps_set_sum(2, (const CpsSet *const[]){disc, other}, &part[3], NULL);
        cps_set_release(other);
        cps_set_point(2, far, &other, NULL);
        cps_set_hull(2, (const CpsSet *const[]){disc, other}, &part[4], NULL);
        cps_set_release(other);
        cps_set_release(disc);
        const int among = 3 + (int)splitmix(&stream, 0, 29);
        for (int k = 0; k < PARTS; k++)
            if (among >> k & 1 || k == trial % 2 * 3) chosen[parts++] = part[k];
        CpsSet *set, *inner;
        if (trial % 3 == 0 && parts > 2) {
            cps_set_intersection(2, chosen, &inner, NULL);
            chosen[1] = inner;
            cps_set_intersection(parts - 1, chosen + 1, &set, NULL);
            cps_set_release(inner);
        } else {
            cps_set_intersection(parts, chosen, &set, NULL);
        }
        for (int k = 0; k < PARTS; k++) cps_set_release(part[k]);
        CpsSetFacts facts;
        cps_set_facts(set, 0, &facts, NULL, NULL, NULL);
        if (facts.bounded)
            check_boundary(&stream, set);
        else
            cps_set_release(set);
    }
}

/* Sets with other boundaries have none: an ellipse, a part of an ellipse, and a sum with a part of
 * a disc. */
static void other_boundaries(void **unused) {
    (void)unused;
    CpsSet *set[3], *disc, *half, *cut;
    cps_set_ellipsoid(2, NULL, (const double[]){1, 0, 0, 0.25}, &set[0], NULL);
    cps_set_ball(2, NULL, 0.5, &disc, NULL);
    cps_set_half_space(2, (const double[]){0, 1}, 0.3, &half, NULL);
    cps_set_intersection(2, (const CpsSet *const[]){set[0], half}, &set[1], NULL);
    cps_set_intersection(2, (const CpsSet *const[]){disc, half}, &cut, NULL);
    cps_set_sum(2, (const CpsSet *const[]){cut, disc}, &set[2], NULL);
    cps_set_release(disc);
    cps_set_release(half);
    cps_set_release(cut);
    for (int k = 0; k < 3; k++) {
        CpsiFrictionSet *friction = made(set[k]);
        assert_null(cpsi_friction_set_shape(friction));
        cpsi_friction_set_free(friction);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(polygons),
                                       cmocka_unit_test(round_sets),
                                       cmocka_unit_test(cut_disc),
                                       cmocka_unit_test(cut_ellipse),
                                       cmocka_unit_test(boundaries),
                                       cmocka_unit_test(intersections),
                                       cmocka_unit_test(other_boundaries)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
