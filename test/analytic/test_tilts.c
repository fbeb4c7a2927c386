/* SPDX-License-Identifier: BSD-3-Clause */
/* Obstacles that turn about axes that are not their own, and planes that turn.
 *
 * A rope rests on a table that is tilted until tan(angle) = mu, and goes with it to rounding; then
 * it slides without end. A turntable takes a rope round. A drum that is lifted lifts what hangs
 * over it, one that rolls moves its top by twice the way of its axis, and one that slides below a
 * line has the capstan law whatever way it moves and turns at the same time. A drum may turn by a
 * shift about its own axis or by a turn: one answer. What moves rigidly as a whole, ends and
 * gravity included, changes nothing but its place: on random ropes over a bed and a bollard. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"
#include "straight_rope.h"

static const double PI = 3.14159265358979323846, LENGTH = 6;
enum { N = 80, SEEDS = 60, MOVES = 6 };

static CpsObstacle obstacle(CpsObstacleKind kind, double friction) {
    CpsObstacle out = cps_obstacle_default();
    out.name = "obstacle";
    out.kind = kind;
    out.friction = friction;
    out.radius = 1;
    out.moves = true;
    return out;
}

static CpsEvolution *open_line(const CpsLine *line, int obstacles, const CpsObstacle *of) {
    CpsScene scene = cps_scene_default();
    scene.obstacle_count = obstacles;
    scene.obstacle = of;
    scene.line_count = 1;
    scene.line = line;
    CpsEvolution *evolution = NULL;
    CpsError err;
    if (cps_evolution_create(&scene, &evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return evolution;
}

/* A shift, and a turn about the obstacle's own axis. */
static CpsOutcome shift(CpsEvolution *evolution, CpsShift by, double angle) {
    const CpsTurn turn = {by.obstacle, angle};
    CpsStage move = cps_stage_default();
    CpsError err;
    move.shift_count = 1;
    move.shift = &by;
    move.turn_count = angle != 0;
    move.turn = &turn;
    if (cps_evolution_move(evolution, &move, &err) != CPS_OK) fail_msg("%s", err.message);
    return cps_evolution_report(evolution).outcome;
}

static void expect(CpsEvolution *evolution, CpsShift by, double angle) {
    CHECK_INT((int)shift(evolution, by, angle), (int)CPS_OUTCOME_SOLVED);
}

/* x turned about y through a point. */
static void about_y(const double x[3], const double c[3], double angle, double out[3]) {
    const double a = x[0] - c[0], b = x[2] - c[2];
    out[0] = c[0] + cos(angle) * a + sin(angle) * b;
    out[1] = x[1];
    out[2] = c[2] + cos(angle) * b - sin(angle) * a;
}

/* A rope along x on a table, its ends free. */
static CpsEvolution *on_a_table(double mu, double stiffness, const double start[6]) {
    CpsLine line = straight_rope(start, LENGTH, N, 10, stiffness);
    line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    const CpsObstacle table = obstacle(CPS_OBSTACLE_PLANE, mu);
    return open_line(&line, 1, &table);
}

static void a_rope_slides_off_a_table_at_tan_mu(void **state) {
    (void)state;
    const double start[6] = {0, 0, 0, LENGTH, 0, 0}, degree = PI / 180;
    const double mu[] = {0.1, 0.4, 1.2}, stiffness[] = {1e4, INFINITY};
    const double axis[][3] = {{0, 0, 0}, {3, 0, 0}, {-40, 0, 2}};
    for (int k = 0; k < 18; k++) {
        const double *c = axis[k % 3], limit = atan(mu[k / 6]), sign = k % 2 ? 1 : -1;
        CpsEvolution *evolution = on_a_table(mu[k / 6], stiffness[k / 3 % 2], start);
        double angle = 0;
        CpsShift tilt = {0, {0, 0, 0}, {0, 0, 0}, {c[0], c[1], c[2]}};
        while (angle + 2 * degree < limit) {
            tilt.turn[1] = sign * 2 * degree;
            angle += 2 * degree;
            expect(evolution, tilt, 0);
        }
        tilt.turn[1] = sign * (limit - 1e-4 - angle);
        expect(evolution, tilt, 0);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        double far = 0;
        for (int j = 0; j <= N; j++) {
            double there[3];
            about_y((const double[3]){LENGTH * j / N, 0, 0}, c, sign * (limit - 1e-4), there);
            for (int a = 0; a < 3; a++) far = fmax(far, fabs(there[a] - view.position[3 * j + a]));
        }
        /* known to 1e-9 of the length, and to rounding about a far axis */
        CHECK_LESS(far, 1e-8);
        CHECK_NEAR(cps_evolution_report(evolution).ledger.dissipated, 0, 1e-9);
        tilt.turn[1] = sign * 2e-4;
        CHECK_INT((int)shift(evolution, tilt, 0), (int)CPS_OUTCOME_UNBOUNDED);
        cps_evolution_destroy(evolution);
    }
}

static void a_turntable_takes_a_rope_round(void **state) {
    (void)state;
    const double start[6] = {1, 0, 0, 1 + LENGTH, 0, 0};
    for (int parts = 1; parts <= 16; parts *= 4) {
        CpsEvolution *evolution = on_a_table(0.3, 1e4, start);
        /* by one and a quarter turns about the origin */
        for (int k = 0; k < parts; k++)
            expect(evolution, (CpsShift){0, {0, 0, 0}, {0, 0, 2.5 * PI / parts}, {0, 0, 0}}, 0);
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        CHECK_VECTOR(view.position, ((double[]){0, 1, 0}), 1e-8);
        CHECK_VECTOR(&view.position[3 * N], ((double[]){0, 1 + LENGTH, 0}), 1e-8);
        CHECK_INT(cps_evolution_report(evolution).substep_count, parts == 1   ? 5
                                                                 : parts == 4 ? 2
                                                                              : 1);
        cps_evolution_destroy(evolution);
    }
}

/* Half of a drum of radius 1 about y, n chords, and leads down; loads at the ends. */
enum { AROUND = 40, LEAD = 70, POINTS = AROUND + 2 * LEAD + 1 };
static CpsEvolution *over_a_drum(double mu, double stiffness, double a, double b) {
    static double x[3 * POINTS];
    const double d = PI / AROUND, chord = 2 * sin(d / 2);
    for (int k = -LEAD; k <= AROUND + LEAD; k++) {
        const int on = k < 0 ? 0 : k > AROUND ? AROUND : k;
        double *at = &x[3 * (k + LEAD)];
        at[0] = -cos(on * d);
        at[1] = 0;
        at[2] = sin(on * d) - chord * abs(k - on);
    }
    CpsLine line = straight_rope(x, chord * (POINTS - 1), POINTS - 1, 0, stiffness);
    line.start.kind = CPS_START_POLYLINE;
    line.start.point_count = POINTS;
    line.end[CPS_END_A] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, -a}};
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, -b}};
    const CpsObstacle drum = obstacle(CPS_OBSTACLE_CYLINDER, mu);
    return open_line(&line, 1, &drum);
}

static double end_place(const CpsEvolution *evolution, int end, int axis) {
    return cps_evolution_line_report(evolution, 0).end[end].position[axis];
}

static void a_drum_lifts_what_hangs_over_it(void **state) {
    (void)state;
    CpsEvolution *evolution = over_a_drum(0.3, 1e5, 2, 1);
    expect(evolution, (CpsShift){0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 0);
    const double a = end_place(evolution, CPS_END_A, 2), b = end_place(evolution, CPS_END_B, 2);
    expect(evolution, (CpsShift){0, {0.2, 0.1, 0.7}, {0, 0, 0}, {0, 0, 0}}, 0);
    CHECK_NEAR(end_place(evolution, CPS_END_A, 2), a + 0.7, 1e-7);
    CHECK_NEAR(end_place(evolution, CPS_END_B, 2), b + 0.7, 1e-7);
    CHECK_NEAR(end_place(evolution, CPS_END_B, 1), 0.1, 1e-7);
    /* the loads are lifted by what pushes the drum; elongations hold T^2 L/(2 EA) */
    CHECK_NEAR(cps_evolution_report(evolution).ledger.obstacles, 3 * 0.7, 4 * 9 / 1e5);
    cps_evolution_destroy(evolution);
}

/* Its axis goes by R angle along x as it turns by it about y: by a turn about its own axis, by a
 * shift, and in steps by shifts about another point, which itself moves. */
static void a_drum_that_rolls_moves_its_top_twice_as_far(void **state) {
    (void)state;
    const double angle = 0.6, d = PI / AROUND, c[3] = {3, 0, -2};
    for (int way = 0; way < 3; way++) {
        CpsEvolution *evolution = over_a_drum(0.3, 1e5, 2, 2);
        const CpsShift none = {.obstacle = 0};
        expect(evolution, none, 0);
        const int top = LEAD + AROUND / 2, steps = way == 2 ? 12 : 1;
        const double x = cps_evolution_line_view(evolution, 0).position[3 * top],
                     a = end_place(evolution, CPS_END_A, 2), b = end_place(evolution, CPS_END_B, 2);
        for (int k = 0; k < steps; k++) {
            const double by = angle / steps, at[3] = {by * k, 0, 0};
            CpsShift roll = {0, {by, 0, 0}, {0, way > 0 ? by : 0, 0}, {by * k, 0, 0}};
            if (way == 2) {
                double turned[3];
                about_y(at, c, by, turned);
                for (int i = 0; i < 3; i++) {
                    roll.by[i] += at[i] - turned[i];
                    roll.about[i] = c[i];
                }
            }
            expect(evolution, roll, way == 0 ? by : 0);
        }
        const CpsObstacleReport drum = cps_evolution_obstacle_report(evolution, 0);
        CHECK_VECTOR(drum.point, ((double[]){angle, 0, 0}), 1e-12);
        CHECK_VECTOR(drum.axis, ((double[]){0, 1, 0}), 1e-12);
        /* the rope goes by the angle of its nodes on the circle, and down by its length: chords */
        CHECK_NEAR(cps_evolution_line_view(evolution, 0).position[3 * top] - x, angle + sin(angle),
                   angle * d * d);
        CHECK_NEAR(end_place(evolution, CPS_END_A, 2), a + angle, angle * d * d);
        CHECK_NEAR(end_place(evolution, CPS_END_B, 2), b - angle, angle * d * d);
        cps_evolution_destroy(evolution);
    }
}

/* A weightless line over n chords of half a drum, straight leads of 1 m; A pulled with 1 N. */
static CpsEvolution *round_a_drum(double mu, int n, double tip[3]) {
    static double x[3 * 64];
    static double element[64];
    const double d = PI / n, chord = 2 * sin(d / 2);
    for (int k = -1; k <= n; k++) {
        const int on = k < 0 ? 0 : k >= n ? n - 1 : k, next = k < 0 ? -1 : n;
        const double by = k == on ? 0 : 1 / chord, c = cos(on * d), s = -sin(on * d);
        double *at = &x[3 * (k + 1)];
        at[0] = c + by * (cos(next * d) - c);
        at[1] = 0;
        at[2] = s + by * (-sin(next * d) - s);
    }
    for (int e = 0; e <= n; e++) element[e] = e == 0 || e == n ? 1 : chord;
    CpsLine line = straight_rope(x, 2 + (n - 1) * chord, n + 1, 0, INFINITY);
    line.element_length = element;
    line.start.kind = CPS_START_NODES;
    line.start.point_count = n + 2;
    line.end[CPS_END_A] = (CpsEnd){CPS_END_KIND_FREE, {x[0] - x[3], 0, x[2] - x[5]}};
    memcpy(tip, &x[3 * (n + 1)], 3 * sizeof *tip);
    line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {tip[0], 0, tip[2]}};
    const CpsObstacle drum = obstacle(CPS_OBSTACLE_CYLINDER, mu);
    return open_line(&line, 1, &drum);
}

static void a_drum_that_turns_and_moves_has_the_capstan_law(void **state) {
    (void)state;
    uint64_t s = 7;
    double worst = 0, apart = 0;
    for (int k = 0; k < 40; k++) {
        const int n = 12 + k;
        const double mu = splitmix(&s, 0.05, 0.6), angle = splitmix(&s, 0.2, 3) * (k % 2 ? 1 : -1),
                     d = PI / n, node = (1 + mu * tan(d / 2)) / (1 - mu * tan(d / 2));
        double by[3];
        for (int a = 0; a < 3; a++) by[a] = splitmix(&s, -1, 1);
        double tension[2];
        for (int way = 0; way < 2; way++) {
            double tip[3];
            CpsEvolution *evolution = round_a_drum(mu, n, tip);
            /* the held end goes with the drum */
            const CpsShift move = {0, {by[0], by[1], by[2]}, {0, way ? angle : 0, 0}, {0, 0, 0}};
            const CpsTurn turn = {0, angle};
            const CpsChange end = {.line = 0,
                                   .end = CPS_END_B,
                                   .to = {CPS_END_KIND_HELD,
                                          {tip[0] + by[0], by[1], tip[2] + by[2]}}};
            CpsStage stage = cps_stage_default();
            CpsError err;
            stage.shift_count = stage.change_count = 1;
            stage.shift = &move;
            stage.change = &end;
            stage.turn_count = way ? 0 : 1;
            stage.turn = &turn;
            if (cps_evolution_move(evolution, &stage, &err) != CPS_OK) fail_msg("%s", err.message);
            CHECK_INT((int)cps_evolution_report(evolution).outcome, (int)CPS_OUTCOME_SOLVED);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            tension[way] = view.tension[n] / view.tension[0];
            worst = fmax(worst, fabs(tension[way] * pow(node, angle < 0 ? -n : n) - 1));
            cps_evolution_destroy(evolution);
        }
        apart = fmax(apart, fabs(tension[1] / tension[0] - 1));
    }
    print_message("capstan law of 40 drums: off by %.1e, by a shift or a turn %.1e\n", worst,
                  apart);
    CHECK_LESS(worst, 1e-8);
    CHECK_LESS(apart, 1e-8);
}

/* ---- what moves rigidly as a whole ---- */

static void turned(const double v[3], const double turn[3], double out[3]) {
    const double angle = sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
    double u[3], along = 0;
    for (int a = 0; a < 3; a++) u[a] = turn[a] / angle;
    for (int a = 0; a < 3; a++) along += u[a] * v[a];
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = cos(angle) * v[a] + (1 - cos(angle)) * along * u[a] +
                 sin(angle) * (u[b] * v[c] - u[c] * v[b]);
    }
}

typedef struct Rigid {
    double by[3], turn[3], about[3];
} Rigid;

static void carried(const Rigid *m, const double x[3], double out[3]) {
    double arm[3];
    for (int a = 0; a < 3; a++) arm[a] = x[a] - m->about[a];
    turned(arm, m->turn, out);
    for (int a = 0; a < 3; a++) out[a] += m->about[a] + m->by[a];
}

/* Move the ends to places as they are at the beginning, carried along by `moved`, with the bed and
 * the bollard. */
static CpsStatus go(CpsEvolution *evolution, int count, const Rigid *moved, double end[2][3],
                    const Rigid *now, CpsError *err) {
    double gravity[3] = {0, 0, -9.81}, at[2][3];
    memcpy(at, end, sizeof at);
    for (int k = 0; k < count; k++) {
        double next[3];
        turned(gravity, moved[k].turn, next);
        memcpy(gravity, next, sizeof gravity);
        for (int e = 0; e < 2; e++) {
            carried(&moved[k], at[e], next);
            memcpy(at[e], next, sizeof next);
        }
    }
    const CpsChange change[2] = {
        {.line = 0, .end = CPS_END_A, .to = {CPS_END_KIND_HELD, {at[0][0], at[0][1], at[0][2]}}},
        {.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_HELD, {at[1][0], at[1][1], at[1][2]}}}};
    CpsShift shifts[2] = {{.obstacle = 0}, {.obstacle = 1}};
    for (int k = 0; k < 2; k++) {
        memcpy(shifts[k].by, now->by, sizeof now->by);
        memcpy(shifts[k].turn, now->turn, sizeof now->turn);
        memcpy(shifts[k].about, now->about, sizeof now->about);
    }
    CpsStage move = cps_stage_default();
    move.change_count = 2;
    move.change = change;
    move.shift_count = count > 0 ? 2 : 0;
    move.shift = shifts;
    move.gravity_changes = count > 0;
    memcpy(move.gravity, gravity, sizeof gravity);
    return cps_evolution_move(evolution, &move, err);
}

static void what_moves_rigidly_only_changes_its_place(void **state) {
    (void)state;
    int steps = 0, certified = 0, compared = 0;
    double apart = 0, tension = 0;
    for (uint64_t seed = 1; seed <= SEEDS; seed++) {
        uint64_t s = seed;
        const double slack = splitmix(&s, 0.85, 0.98),
                     stiffness = splitmix(&s, 0, 1) < 0.3 ? INFINITY : 5000;
        CpsObstacle both[2];
        both[0] = obstacle(CPS_OBSTACLE_PLANE, splitmix(&s, 0.1, 0.8));
        both[1] = obstacle(CPS_OBSTACLE_CYLINDER, splitmix(&s, 0, 0.5));
        both[0].name = "bed";
        if (seed % 3 == 0) { /* its grain turns with it */
            both[0].has_friction_lateral = true;
            both[0].friction_lateral = 2 * both[0].friction;
            both[0].grain[0] = 1;
            both[0].grain[1] = splitmix(&s, -1, 1);
        }
        both[1].axis[1] = 0;
        both[1].axis[2] = 1;
        both[1].radius = splitmix(&s, 0.15, 0.35);
        both[1].point[0] = splitmix(&s, 2, 4);
        both[1].point[1] = splitmix(&s, 0.5, 0.8);
        if (splitmix(&s, 0, 1) >= 0.5) both[1].point[1] *= -1;
        double x[3 * (N + 1)] = {0};
        for (int j = 0; j <= N; j++) {
            x[3 * j] = slack * LENGTH * j / N;
            x[3 * j + 2] = 0.1;
        }
        CpsLine line = straight_rope(x, LENGTH, N, splitmix(&s, 2, 20), stiffness);
        line.start.kind = CPS_START_NODES;
        line.start.point_count = N + 1;
        line.end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {slack * LENGTH, 0, 0.1}};
        CpsEvolution *moving = open_line(&line, 2, both), *still = open_line(&line, 2, both);
        double end[2][3] = {{0, 0, 0.1}, {slack * LENGTH, 0, 0.1}};
        Rigid moved[MOVES];
        bool same = true;
        for (int k = 0; k < MOVES && same; k++) {
            for (int i = 0; i < 3; i++) {
                moved[k].by[i] = splitmix(&s, -0.04, 0.04);
                moved[k].turn[i] = splitmix(&s, -0.01, 0.01);
                moved[k].about[i] = splitmix(&s, -3, 3);
                const double more = splitmix(&s, -0.04, 0.04);
                end[0][i] += i < 2 ? more : 0;
                end[1][i] -= i < 2 ? more : 0;
            }
            CpsError err;
            if (go(moving, k + 1, moved, end, &moved[k], &err) != CPS_OK ||
                go(still, 0, moved, end, &moved[k], &err) != CPS_OK)
                fail_msg("%s", err.message);
            const CpsStepReport one = cps_evolution_report(moving),
                                other = cps_evolution_report(still);
            steps++;
            certified += cps_outcome_is_certified(one.outcome);
            same = cps_outcome_is_certified(one.outcome) &&
                   cps_outcome_is_certified(other.outcome) && one.substep_count == 1 &&
                   other.substep_count == 1 && one.places == CPS_PLACES_UNIQUE;
            if (!same) continue;
            const CpsLineView a = cps_evolution_line_view(moving, 0),
                              b = cps_evolution_line_view(still, 0);
            for (int j = 0; j <= N; j++) {
                double there[3] = {b.position[3 * j], b.position[3 * j + 1], b.position[3 * j + 2]};
                for (int m = 0; m <= k; m++) {
                    double next[3];
                    carried(&moved[m], there, next);
                    memcpy(there, next, sizeof next);
                }
                for (int i = 0; i < 3; i++)
                    apart = fmax(apart, fabs(there[i] - a.position[3 * j + i]));
            }
            for (int e = 0; e < N; e++)
                tension = fmax(tension,
                               fabs(a.tension[e] - b.tension[e]) / other.certificate.largest_force);
            compared++;
        }
        cps_evolution_destroy(moving);
        cps_evolution_destroy(still);
    }
    print_message("%d of %d steps certified; %d compared: %.1e m, %.1e of the force\n", certified,
                  steps, compared, apart, tension);
    CHECK_GREATER(certified, 0.99 * steps - 1);
    CHECK_GREATER(compared, 60);
    CHECK_LESS(apart, 1e-6);
    CHECK_LESS(tension, 1e-4); /* the root of the relative gap that a certificate permits */
}

/* ---- refuse ---- */

static void nonsense_and_what_is_in_the_way_is_refused(void **state) {
    (void)state;
    const double start[6] = {0, 0, 0, LENGTH, 0, 0};
    CpsLine line = straight_rope(start, LENGTH, N, 10, 1e4);
    const CpsObstacle table = obstacle(CPS_OBSTACLE_PLANE, 0.3);
    CpsEvolution *evolution = open_line(&line, 1, &table);
    CpsShift bad[] = {{0, {0, 0, 0}, {0, NAN, 0}, {0, 0, 0}},
                      {0, {0, 0, 0}, {0, 1, 0}, {INFINITY, 0, 0}},
                      {0, {0, 0, 0}, {0, 1e6, 0}, {0, 0, 0}},
                      {1, {0, 0, 0}, {0, 1, 0}, {0, 0, 0}},
                      /* the end that is held at the origin */
                      {0, {0, 0, 0}, {0, 0.5, 0}, {1, 0, 0}},
                      /* through it and back again, where only the way shows it */
                      {0, {0, 0, 0}, {0, 2 * PI, 0}, {1, 0, 0}}};
    const char *words[] = {"turn",       "about",     "the limit is", "names obstacle 1",
                           "in the way", "in the way"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        CpsStage move = cps_stage_default();
        CpsError err;
        move.shift_count = 1;
        move.shift = &bad[k];
        const CpsStatus status = cps_evolution_move(evolution, &move, &err);
        CHECK_INT((int)status, (int)(k == 2 ? CPS_ERR_LIMIT : CPS_ERR_ARGUMENT));
        if (!strstr(err.message, words[k])) fail_msg("'%s' lacks '%s'", err.message, words[k]);
    }
    /* about the end itself all is well */
    expect(evolution, (CpsShift){0, {0, 0, 0}, {0, 0.2, 0}, {0, 0, 0}}, 0);
    expect(evolution, (CpsShift){0, {0, 0, 0}, {0.2, 0.2, -1}, {0, 0, 0}}, 0);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rope_slides_off_a_table_at_tan_mu),
        cmocka_unit_test(a_turntable_takes_a_rope_round),
        cmocka_unit_test(a_drum_lifts_what_hangs_over_it),
        cmocka_unit_test(a_drum_that_rolls_moves_its_top_twice_as_far),
        cmocka_unit_test(a_drum_that_turns_and_moves_has_the_capstan_law),
        cmocka_unit_test(what_moves_rigidly_only_changes_its_place),
        cmocka_unit_test(nonsense_and_what_is_in_the_way_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
