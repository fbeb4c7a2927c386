/* SPDX-License-Identifier: BSD-3-Clause */
/* Inextensible lines round a cylinder or a ball whose end B is moved away until the line is too
 * short to reach it.
 *
 * The shortest path from A to B is a helix between two tangents: developed, t_A + t_B + R (turn -
 * acos(R/r_A) - acos(R/r_B)) across the axis and the rise along it. A line at least as long as the
 * path round the obstacle can be placed there, with its nodes on the path and its elements as
 * chords of admissible depth. A line shorter than the path round the obstacle reduced by the
 * admissible depth, min(l^2/(4 R), R/4), cannot. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"
#include "splitmix.h"

typedef struct Case {
    CpsObstacleKind kind;
    double radius, turn, pitch, lift, scale, axis[3][3], point[3],
        direction[3]; /* lift: of the start above the surface; direction: of B, in the axes */
    int elements;
    bool graded, elastic;
} Case;

/* So many of each kind always; ten times as many with --all. */
static int cases = 200;

static double draw(uint64_t *seed, double low, double high) { return splitmix(seed, low, high); }

static void unit(double *v) {
    const double size = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) v[k] /= size;
}

static void cross(const double *a, const double *b, double *out) {
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static Case random_case(uint64_t *seed) {
    Case c = {.kind = draw(seed, 0, 1) < 0.7 ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE};
    const bool ball = c.kind == CPS_OBSTACLE_SPHERE;
    c.scale = pow(10, draw(seed, -3, 6));
    c.radius = c.scale * pow(10, draw(seed, -1, 1));
    c.turn = ball ? draw(seed, 0.5, 2.8) : draw(seed, 0.5, 16);
    if (!ball && draw(seed, 0, 1) < 0.5) c.turn *= -1;
    c.pitch = ball || draw(seed, 0, 1) < 0.3 ? 0 : c.radius * draw(seed, -0.5, 0.5);
    c.lift = draw(seed, 0, 1) < 0.3 ? 0 : pow(10, draw(seed, -4, -1));
    c.elements = (int)fmin(60, ceil(fabs(c.turn) / pow(10, draw(seed, -1.3, 0))));
    c.graded = draw(seed, 0, 1) < 0.3;
    c.elastic = draw(seed, 0, 1) < 0.04;
    for (int k = 0; k < 3; k++) {
        c.axis[0][k] = draw(seed, -1, 1);
        c.axis[2][k] = draw(seed, -1, 1);
    }
    unit(c.axis[2]);
    cross(c.axis[2], c.axis[0], c.axis[1]);
    unit(c.axis[1]);
    cross(c.axis[1], c.axis[2], c.axis[0]);
    const double off = draw(seed, 0, 1) < 0.5 ? 0 : c.scale * pow(10, draw(seed, 0, 5));
    for (int k = 0; k < 3; k++) c.point[k] = off * draw(seed, -1, 1);
    /* outwards, on, along the axis */
    c.direction[0] = draw(seed, 0.01, 0.5);
    c.direction[1] = 1;
    c.direction[2] = draw(seed, 0, 1) < 0.3 ? 0 : draw(seed, -1, 1);
    return c;
}

/* A point at distance r and angle phi, moved by s along the direction of B there. */
static void place(const Case *c, double r, double phi, double rise, double s, double *out) {
    const double sense = c->turn < 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        const double radial = cos(phi) * c->axis[0][k] + sin(phi) * c->axis[1][k],
                     onward = sense * (cos(phi) * c->axis[1][k] - sin(phi) * c->axis[0][k]);
        out[k] = c->point[k] + r * radial + rise * c->axis[2][k] +
                 s * (c->direction[0] * radial + c->direction[1] * onward +
                      c->direction[2] * c->axis[2][k]);
    }
}

static double rise_of(const Case *c, double share) { return c->pitch * fabs(c->turn) * share; }

/* The path round an obstacle of radius R once B has gone by s: A is at the angle 0 and B was at the
 * angle `turn`. */
static double path_round(const Case *c, double R, double s) {
    const double r = c->radius * (1 + c->lift), x = r + s * c->direction[0],
                 y = s * c->direction[1], z = rise_of(c, 1) + s * c->direction[2];
    double turn = fabs(c->turn) + atan2(y, x), far = hypot(x, y), up = z;
    if (c->kind == CPS_OBSTACLE_SPHERE) { /* the angle at the centre between the two ends */
        turn = acos((x * cos(c->turn) - y * sin(c->turn)) / hypot(far, z));
        far = hypot(far, z);
        up = 0;
    }
    const double arc = turn - acos(R / r) - acos(R / far);
    return arc > 0 ? hypot(sqrt(r * r - R * R) + sqrt(far * far - R * R) + R * arc, up) : 0;
}

static void lay(Rig *rig, const Case *c, uint64_t *seed) {
    double share[RIG_POINTS] = {0}, total = 0;
    rig_begin(rig, c->elements, 1, c->elastic ? 1e3 * c->scale : INFINITY);
    CpsObstacle *o = rig_obstacle(rig, c->kind, 0.3);
    o->radius = c->radius;
    memcpy(o->point, c->point, sizeof o->point);
    memcpy(o->axis, c->axis[2], sizeof o->axis);
    for (int j = 1; j <= c->elements; j++)
        share[j] = share[j - 1] + (c->graded ? draw(seed, 0.3, 1) : 1);
    for (int j = 0; j <= c->elements; j++) {
        double x[3];
        place(c, c->radius * (1 + c->lift), c->turn * share[j] / share[c->elements],
              rise_of(c, share[j] / share[c->elements]), 0, x);
        rig_point(rig, x[0], x[1], x[2]);
    }
    for (int j = 0; j < c->elements; j++) {
        const double *p = &rig->point[3 * j];
        rig->element_length[j] =
            sqrt(pow(p[3] - p[0], 2) + pow(p[4] - p[1], 2) + pow(p[5] - p[2], 2));
        total += rig->element_length[j];
    }
    rig_graded(rig);
    rig_length(rig, total);
}

static double longest_of(const Rig *rig) {
    double longest = 0;
    for (int j = 0; j < rig->line.element_count; j++)
        longest = fmax(longest, rig->element_length[j]);
    return longest;
}

/* How far B goes until the path round an obstacle of radius R is so long; NAN where it never gets
 * so long or the obstacle is not in the way. */
static double path_of_end(const Case *c, double R, double length) {
    double low = 0, high = 10 * length;
    if (!(path_round(c, R, 0) < length && path_round(c, R, 0) > 0)) return NAN;
    for (int i = 0; i < 200; i++) {
        const double s = (low + high) / 2;
        if (path_round(c, R, s) > length || path_round(c, R, s) == 0)
            high = s;
        else
            low = s;
    }
    return fabs(path_round(c, R, low) - length) < 1e-9 * length ? low : NAN;
}

/* The outcome where the path round the obstacle of radius R is `length` in the end. */
static bool outcome(const Case *c, uint64_t seed, bool shrunk, double share, CpsOutcome *out,
                    CpsLineReport *report) {
    Rig *rig = malloc(sizeof *rig);
    assert_non_null(rig);
    lay(rig, c, &seed);
    const double l = longest_of(rig),
                 R = c->radius - (shrunk ? fmin(l * l / (4 * c->radius), c->radius / 4) : 0);
    const double s = path_of_end(c, R, rig->line.length * (1 + share));
    double to[3];
    place(c, c->radius * (1 + c->lift), c->turn, rise_of(c, 1), s, to);
    rig_end(rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    const double *last = &rig->point[3 * c->elements];
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, last[0], last[1], last[2]);
    rig_stage(rig, 1);
    rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, to[0], to[1], to[2]);
    rig->scene.solver.max_halvings = 0;
    rig->scene.solver.max_iterations = 2; /* whether it is solved is not asked */
    bool taken = isfinite(s);
    if (taken) {
        CpsError err;
        CpsEvolution *evolution;
        if (cps_evolution_create(&rig->scene, &evolution, &err) != CPS_OK) {
            print_error("%s\n", err.message);
            fail();
        }
        assert_int_equal(cps_evolution_step(evolution, &err), CPS_OK);
        *report = cps_evolution_line_report(evolution, 0);
        *out = report->outcome;
        cps_evolution_destroy(evolution);
    }
    free(rig);
    return taken;
}

static void short_of_the_path(void **state) {
    (void)state;
    int tried[2][2] = {{0}}, proved[2] = {0}, straight[2] = {0};
    for (int i = 0; i < cases; i++) {
        uint64_t seed = 7000 + 1000 * (uint64_t)i;
        const Case c = random_case(&seed);
        const double far =
            sqrt(c.point[0] * c.point[0] + c.point[1] * c.point[1] + c.point[2] * c.point[2]);
        /* beside what places so far from the origin are known to */
        const double slack = pow(10, draw(&seed, -11, -3)) + 1e-14 * far / c.scale * 10;
        CpsLineReport report;
        CpsOutcome found;
        const int ball = c.kind == CPS_OBSTACLE_SPHERE;
        Case few = c; /* a step that is solved takes long: few elements, and a start beside the
                         surface, so that there is way to go */
        few.lift = fmax(c.lift, 0.05);
        few.elements = (int)ceil(fabs(c.turn) / 0.8);
        if (i % 4 == 0 && fabs(c.turn) < 8 &&
            outcome(&few, seed, false, -slack, &found,
                    &report)) { /* a step that is solved takes long */
            tried[ball][0]++;
            if (found == CPS_OUTCOME_INFEASIBLE)
                print_error("case %d: longer by %g of its length, yet infeasible by %g m\n", i,
                            slack, report.proof_length);
            assert_true(found != CPS_OUTCOME_INFEASIBLE);
        }
        if (outcome(&c, seed, true, slack, &found, &report)) {
            tried[ball][1]++;
            proved[ball] += found == CPS_OUTCOME_INFEASIBLE;
            if ((found == CPS_OUTCOME_INFEASIBLE) == c.elastic)
                print_error("case %d: shorter by %g of its length, yet %s\n", i, slack,
                            cps_outcome_name(found));
            assert_true((found == CPS_OUTCOME_INFEASIBLE) != c.elastic);
            if (c.elastic) continue;
            assert_true(report.proof_length > 0);
            assert_int_equal(report.proof_obstacle, 0);
            straight[ball] += !report.has_proof_obstacle; /* the obstacle is hardly in the way: the
                                                             ends alone are too far apart */
        }
    }
    for (int k = 0; k < 2; k++)
        printf("%s: %d long enough, none infeasible; %d too short, %d proved, %d of them by the "
               "straight way, the others elastic\n",
               k ? "ball" : "cylinder", tried[k][0], tried[k][1], proved[k], straight[k]);
    CHECK_LESS(straight[0] + straight[1], cases / 20);
    CHECK_GREATER(tried[0][1], cases / 4);
    CHECK_GREATER(tried[1][1], cases / 20);
}

int main(int argc, char **argv) {
    if (argc == 2 && strcmp(argv[1], "--all") == 0) cases *= 10;
    const struct CMUnitTest tests[] = {cmocka_unit_test(short_of_the_path)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
