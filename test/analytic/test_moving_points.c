/* SPDX-License-Identifier: BSD-3-Clause */
/* Free points and bodies in time beside ground that moves: clumps on a belt, on a table that goes
 * to and fro, on a floor that stops; clumps and a body on lines over a drum that turns. Each figure
 * is printed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"

static const double PI = 3.14159265358979323846, G = 9.81;

enum { LINES = 2, POINTS = 4, NODES = 120, STAGES = 12 };

typedef struct Rig {
    CpsScene scene;
    CpsLine line[LINES];
    CpsPoint point[POINTS];
    CpsBody body;
    CpsObstacle obstacle;
    CpsStage stage[STAGES];
    CpsShift shift[STAGES];
    CpsTurn turn[STAGES];
    CpsPointChange change[STAGES];
    double node[LINES][3 * (NODES + 1)];
} Rig;

static void place(double at[3], double x, double y, double z) {
    memcpy(at, (double[]){x, y, z}, 3 * sizeof *at);
}

static void begin(Rig *rig, CpsTimeScheme scheme, double friction) {
    static const char *const LINE[] = {"one", "two"}, *const POINT[] = {"a", "b", "c", "d"};
    *rig = (Rig){.scene = cps_scene_default()};
    rig->scene.time_scheme = scheme;
    rig->scene.line = rig->line;
    rig->scene.point = rig->point;
    rig->scene.body = &rig->body;
    rig->scene.stage = rig->stage;
    rig->scene.obstacle = &rig->obstacle;
    rig->scene.obstacle_count = 1;
    rig->obstacle = cps_obstacle_default();
    rig->obstacle.name = "ground";
    rig->obstacle.friction = friction;
    rig->obstacle.moves = true;
    place(rig->scene.gravity, 0, 0, -G);
    for (int i = 0; i < LINES; i++) {
        rig->line[i] = cps_line_default();
        rig->line[i].name = LINE[i];
    }
    for (int i = 0; i < POINTS; i++) {
        rig->point[i] = cps_point_default();
        rig->point[i].name = POINT[i];
    }
    rig->body = cps_body_default();
    rig->body.name = "body";
}

static void free_point(Rig *rig, int point, double mass, double x, double y, double z) {
    rig->point[point].kind = CPS_POINT_KIND_FREE;
    rig->point[point].weight = mass * G;
    rig->point[point].inertia = mass;
    place(rig->point[point].position, x, y, z);
    if (rig->scene.point_count <= point) rig->scene.point_count = point + 1;
}

/* A line of equal elements along the nodes of the rig, from point a to point b. */
static void tie(Rig *rig, int line, int a, int b, double length, int elements, double stiffness,
                double mass) {
    CpsLine *of = &rig->line[line];
    of->length = length;
    of->element_count = elements;
    of->stiffness = stiffness;
    of->inertia = mass;
    of->weight = mass * G;
    of->quasi_static = !(mass > 0);
    of->start.kind = CPS_START_NODES;
    of->start.point = rig->node[line];
    of->start.point_count = elements + 1;
    of->end[0].kind = of->end[1].kind = CPS_END_KIND_POINT;
    of->end_point[0] = a;
    of->end_point[1] = b;
    if (rig->scene.line_count <= line) rig->scene.line_count = line + 1;
}

/* ... that is straight. */
static void tie_straight(Rig *rig, int line, int a, int b, int elements, double stiffness,
                         double mass) {
    const double *from = rig->point[a].position, *to = rig->point[b].position;
    double square = 0;
    for (int k = 0; k < 3; k++) square += (to[k] - from[k]) * (to[k] - from[k]);
    tie(rig, line, a, b, sqrt(square), elements, stiffness, mass);
    for (int j = 0; j <= elements; j++)
        for (int k = 0; k < 3; k++)
            rig->node[line][3 * j + k] = from[k] + (to[k] - from[k]) * j / elements;
}

static CpsStage *add_stage(Rig *rig, double duration, int steps) {
    CpsStage *stage = &rig->stage[rig->scene.stage_count++];
    *stage = cps_stage_default();
    stage->name = "stage";
    stage->duration = duration;
    stage->step_count = steps;
    return stage;
}

/* The ground moves by this much in it. */
static void shift(Rig *rig, CpsStage *stage, double x, double y, double z) {
    CpsShift *by = &rig->shift[stage - rig->stage];
    *by = (CpsShift){.obstacle = 0};
    place(by->by, x, y, z);
    stage->shift = by;
    stage->shift_count = 1;
}
static void turn(Rig *rig, CpsStage *stage, double angle) {
    CpsTurn *by = &rig->turn[stage - rig->stage];
    *by = (CpsTurn){.obstacle = 0, .angle = angle};
    stage->turn = by;
    stage->turn_count = 1;
}

static CpsEvolution *open(const Rig *rig) {
    CpsEvolution *evolution;
    CpsError err;
    if (cps_evolution_create(&rig->scene, &evolution, &err)) fail_msg("%s", err.message);
    return evolution;
}

/* [J] Sums over steps. */
typedef struct Sums {
    double obstacles, dissipated, impact, imbalance, turnover;
} Sums;

static void add(const CpsEvolution *evolution, Sums *sums) {
    const CpsLedger ledger = cps_evolution_report(evolution).ledger;
    sums->obstacles += ledger.obstacles;
    sums->dissipated += ledger.dissipated;
    sums->imbalance += fabs(ledger.imbalance);
    sums->turnover += fabs(ledger.obstacles) + fabs(ledger.ends);
    for (int i = 0; i < cps_evolution_line_count(evolution); i++)
        sums->turnover += cps_evolution_line_motion(evolution, i).ledger.turnover;
    for (int i = 0; i < cps_evolution_point_count(evolution); i++) {
        const CpsMotionLedger own = cps_evolution_point_motion(evolution, i).ledger;
        sums->turnover += own.turnover;
        sums->impact += own.impact;
    }
    for (int i = 0; i < cps_evolution_body_count(evolution); i++)
        sums->turnover += cps_evolution_body_motion(evolution, i).ledger.turnover;
}

static void steps(CpsEvolution *evolution, int count, Sums *sums) {
    CpsError err;
    for (int k = 0; k < count; k++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        const CpsStepReport report = cps_evolution_report(evolution);
        if (!cps_outcome_is_certified(report.outcome))
            fail_msg("step %d is not certified: outcome %d", report.step_count, report.outcome);
        add(evolution, sums);
    }
}

static double figure(const char *name, const char *what, double expected, double found) {
    printf("%s: %s %.9g, expected %.9g\n", name, what, found, expected);
    return found - expected;
}

static double at(const CpsEvolution *evolution, int point, int axis) {
    return cps_evolution_point_report(evolution, point).position[axis];
}
static double speed_of(const CpsEvolution *evolution, int point, int axis) {
    return cps_evolution_point_motion(evolution, point).velocity[axis];
}

/* ---- clumps on planes ---- */

/* Two clumps beside each other, joined by a string without mass that they never pull. */
static void clumps(Rig *rig, CpsTimeScheme scheme, double friction) {
    begin(rig, scheme, friction);
    free_point(rig, 0, 5, 2, 0, 0);
    free_point(rig, 1, 3, 2, 0.5, 0);
    tie_straight(rig, 0, 0, 1, 1, 100, 0);
}

/* A belt that starts with the velocity V drags clumps at rest along: they lag behind by V^2/(2 mu
 * g), then they go with it. It does twice the work of their kinetic energy, half of it lost. */
static void a_belt_takes_clumps_along(void **state) {
    (void)state;
    const double speed = 1.5, friction = 0.4, mass = 8;
    const double lag = speed * speed / (2 * friction * G);
    for (int scheme = 0; scheme < 2; scheme++)
        for (int k = 0; k < 2; k++) {
            const int count = 100 << k;
            Rig rig;
            clumps(&rig, (CpsTimeScheme)scheme, friction);
            shift(&rig, add_stage(&rig, 1, count), speed, 0, 0);
            CpsEvolution *evolution = open(&rig);
            Sums sums = {0};
            steps(evolution, count, &sums);
            char name[48];
            snprintf(name, sizeof name, "belt, %s, %d steps", scheme ? "Euler" : "BDF2", count);
            const double off =
                figure(name, "lag [m]", lag, speed - (at(evolution, 0, 0) - 2)) / lag;
            CHECK_NEAR(at(evolution, 1, 0), at(evolution, 0, 0), 1e-9);
            CHECK_NEAR(speed_of(evolution, 0, 0), speed, 1e-9);
            figure(name, "work of the belt [J]", mass * speed * speed, sums.obstacles);
            figure(name, "lost to friction [J]", mass * speed * speed / 2, sums.dissipated);
            /* Euler's method is of the first order; by the other the step in which they come to
             * rest on the belt is not resolved */
            CHECK_LESS(fabs(off), scheme ? 0.03 / (1 << k) : 2e-3 / (1 << 2 * k));
            CHECK_NEAR(sums.obstacles, mass * speed * speed,
                       (scheme ? 1e-9 : 0.015 / (1 << k)) * mass * speed * speed);
            CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
            cps_evolution_destroy(evolution);
        }
}

/* A table that goes to and fro with the velocity V, for the time T each way. Where mu g T < V the
 * clumps never have its velocity: they are accelerated for T, and slowed down for T, and go mu g
 * T^2 each time. Where mu g T > 2 V they go with it, and slip for 2 V/(mu g) after each turn. */
static void a_table_goes_to_and_fro(void **state) {
    (void)state;
    const double friction = 0.3, time = 0.2;
    for (int fast = 0; fast < 2; fast++)
        for (int scheme = 0; scheme < 2; scheme++) {
            const double speed = fast ? 2 : 0.2, gain = friction * G;
            const int count = 200;
            Rig rig;
            clumps(&rig, (CpsTimeScheme)scheme, friction);
            for (int k = 0; k < 6; k++)
                shift(&rig, add_stage(&rig, time, count), (k % 2 ? -1 : 1) * speed * time, 0, 0);
            CpsEvolution *evolution = open(&rig);
            Sums sums = {0};
            char name[48];
            snprintf(name, sizeof name, "table, %s, %s", fast ? "fast" : "slow",
                     scheme ? "Euler" : "BDF2");
            steps(evolution, 6 * count, &sums);
            if (fast) {
                CHECK_LESS(fabs(figure(name, "way in 3 periods [m]", 3 * gain * time * time,
                                       at(evolution, 0, 0) - 2)),
                           1e-2 * gain * time * time);
                CHECK_NEAR(speed_of(evolution, 0, 0), 0, 1e-9);
            } else {
                /* behind by V^2/(2 mu g) at first, then 2 V^2/(mu g) back and forth */
                const double lag = speed * speed / gain;
                CHECK_LESS(fabs(figure(name, "lag after 3 periods [m]", -lag / 2 + 2 * lag,
                                       at(evolution, 0, 0) - 2)),
                           2e-2 * lag);
                CHECK_NEAR(speed_of(evolution, 0, 0), -speed, 1e-9);
            }
            CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
            cps_evolution_destroy(evolution);
        }
}

/* A program moves the table as 1 - cos, so slowly that clumps go with it; each move is taken twice,
 * the first time back. */
static void a_program_moves_the_table(void **state) {
    (void)state;
    Rig rig;
    CpsError err;
    const double size = 0.1, rate = 4, friction = 0.3, h = 0.01; /* size rate^2 < mu g */
    clumps(&rig, CPS_TIME_SCHEME_BDF2, friction);
    rig.scene.in_time = true;
    CpsEvolution *evolution = open(&rig);
    double before = 0, most = 0;
    Sums sums = {0};
    for (int k = 1; k <= 300; k++) {
        const double x = size * (1 - cos(rate * h * k));
        CpsShift by = {.obstacle = 0, .by = {x - before, 0, 0}};
        CpsStage move = cps_stage_default();
        move.duration = h;
        move.shift = &by;
        move.shift_count = 1;
        double first[3];
        for (int again = 0; again < 2; again++) {
            if (cps_evolution_move(evolution, &move, &err)) fail_msg("%s", err.message);
            const CpsPointReport report = cps_evolution_point_report(evolution, 0);
            if (again)
                CHECK_INT(memcmp(first, report.position, sizeof first), 0);
            else
                memcpy(first, report.position, sizeof first);
            if (!again && cps_evolution_take_back(evolution, &err)) fail_msg("%s", err.message);
        }
        assert_true(cps_outcome_is_certified(cps_evolution_report(evolution).outcome));
        add(evolution, &sums);
        most = fmax(most, fabs(at(evolution, 0, 0) - 2 - x));
        before = x;
    }
    figure("table of a program", "largest slip [m]", 0, most);
    CHECK_LESS(most, 1e-12);
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
}

/* A floor that rises with the velocity V and stops throws clumps up by V^2/(2 g); they land after
 * 2 V/g with the energy that they had, and stay. */
static void a_floor_throws_clumps_up(void **state) {
    (void)state;
    const double speed = 2, time = 0.2;
    double off[2];
    for (int k = 0; k < 2; k++) {
        Rig rig;
        clumps(&rig, CPS_TIME_SCHEME_BDF2, 0.3);
        const int count = 400 << k;
        shift(&rig, add_stage(&rig, time, 20), 0, 0, speed * time);
        add_stage(&rig, 0.6, count);
        CpsEvolution *evolution = open(&rig);
        Sums start = {0}, sums = {0};
        steps(evolution, 20, &start);
        CHECK_LESS(start.imbalance, 1e-10 * start.turnover);
        CHECK_NEAR(speed_of(evolution, 0, 2), speed, 1e-9);
        CHECK_NEAR(speed_of(evolution, 1, 2), speed, 1e-9);
        double top = 0;
        for (int i = 0; i < count; i++) {
            steps(evolution, 1, &sums);
            top = fmax(top, at(evolution, 0, 2) - speed * time);
        }
        char name[48];
        snprintf(name, sizeof name, "floor, %d steps", count);
        const double exact = speed * speed / (2 * G);
        off[k] = figure(name, "thrown up by [m]", exact, top) / exact;
        figure(name, "lost by impact [J]", 8 * speed * speed / 2, sums.impact);
        CHECK_NEAR(sums.impact, 8 * speed * speed / 2, 0.02 * 8 * speed * speed / 2);
        CHECK_NEAR(at(evolution, 0, 2), speed * time, 1e-12);
        CHECK_NEAR(speed_of(evolution, 0, 2), 0, 1e-12);
        CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
        cps_evolution_destroy(evolution);
    }
    CHECK_LESS(fabs(off[0]), 1e-4);
    CHECK_LESS(fabs(off[1]), 3e-5);
}

/* A table that turns at a constant rate w takes clumps round that have its velocity, r w^2 < mu g:
 * they stay where they are on it, by either scheme and in steps of any length. */
static void a_table_takes_clumps_round(void **state) {
    (void)state;
    const double rate = 1, time = 10;
    for (int scheme = 0; scheme < 2; scheme++)
        for (int count = 50; count <= 200; count *= 4) {
            Rig rig;
            clumps(&rig, (CpsTimeScheme)scheme, 0.9);
            const double from[3] = {rig.point[0].position[0], rig.point[0].position[1], 0};
            for (int i = 0; i < 2; i++)
                place(rig.point[i].velocity, -rate * rig.point[i].position[1],
                      rate * rig.point[i].position[0], 0);
            CpsStage *stage = add_stage(&rig, time, count);
            shift(&rig, stage, 0, 0, 0);
            place(rig.shift[0].turn, 0, 0, rate * time);
            CpsEvolution *evolution = open(&rig);
            Sums sums = {0};
            steps(evolution, count, &sums);
            const double c = cos(rate * time), s = sin(rate * time),
                         off = hypot(at(evolution, 0, 0) - (c * from[0] - s * from[1]),
                                     at(evolution, 0, 1) - (s * from[0] + c * from[1]));
            char name[48];
            snprintf(name, sizeof name, "turntable, %s, %d steps", scheme ? "Euler" : "BDF2",
                     count);
            figure(name, "off its place [m]", 0, off);
            CHECK_LESS(off, 1e-12);
            CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
            cps_evolution_destroy(evolution);
        }
}

/* A point that is held on a floor goes up with it: the floor does the work, the ledger closes. */
static void a_held_point_rises_with_the_floor(void **state) {
    (void)state;
    Rig rig;
    const double height = 0.5;
    begin(&rig, CPS_TIME_SCHEME_BDF2, 0.4);
    free_point(&rig, 0, 5, 2, 0, 0);
    rig.point[0].kind = CPS_POINT_KIND_HELD;
    rig.point[1].position[0] = 2.5;
    rig.scene.point_count = 2;
    tie_straight(&rig, 0, 0, 1, 4, 1e5, 0.2);
    CpsStage *stage = add_stage(&rig, 1, 20);
    shift(&rig, stage, 0, 0, height);
    CpsPointChange change[2] = {{.point = 0, .kind = CPS_POINT_KIND_HELD, .value = {2, 0, height}},
                                {.point = 1,
                                 .kind = CPS_POINT_KIND_HELD,
                                 .value = {2.5, 0, height}}};
    stage->point_change = change;
    stage->point_change_count = 2;
    CpsEvolution *evolution = open(&rig);
    Sums sums = {0};
    steps(evolution, 20, &sums);
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
}

/* ---- over a drum ---- */

/* A line over the drum of radius r about the y axis, from height -down on the left side to that on
 * the right, of equal chords that the tension `pull` has stretched; its ends are at points a and b.
 * Returns its chords. */
static int tie_over(Rig *rig, int line, int a, int b, double y, double r, int arc, double down,
                    double stiffness, double mass, double pull) {
    const double chord = 2 * r * sin(PI / (2 * arc));
    const int hang = (int)lround(down / chord), count = arc + 2 * hang;
    for (int j = 0; j <= count; j++) {
        const int k = j - hang;
        const double angle = PI * (1 - fmin(fmax((double)k / arc, 0), 1)),
                     below = chord * fmax(-k, fmax(k - arc, 0));
        place(&rig->node[line][3 * j], r * cos(angle), y, r * sin(angle) - below);
    }
    memcpy(rig->point[a].position, rig->node[line], 3 * sizeof(double));
    memcpy(rig->point[b].position, &rig->node[line][3 * count], 3 * sizeof(double));
    tie(rig, line, a, b, count * chord / (1 + pull / stiffness), count, stiffness, mass);
    return count;
}

static void drum(Rig *rig, CpsTimeScheme scheme, double friction, double r) {
    begin(rig, scheme, friction);
    rig->obstacle.kind = CPS_OBSTACLE_CYLINDER;
    rig->obstacle.radius = r;
    place(rig->obstacle.axis, 0, 1, 0);
}

/* Two clumps on a line over a drum that turns faster than they move, by more than one turn: what
 * goes against it has e^(mu pi) times the tension of the other side. With T = m (g -+ a) the drum
 * accelerates them by g (E m_b - m_a)/(m_a + E m_b), E = e^(+- mu pi). */
static double atwood(int arc, double direction, int count) {
    const double r = 0.1, friction = 0.3, time = 0.2, a = 1, b = 1.5,
                 grows = exp(direction * friction * PI),
                 gain = G * (grows * b - a) / (a + grows * b);
    Rig rig;
    drum(&rig, CPS_TIME_SCHEME_BDF2, friction, r);
    free_point(&rig, 0, a, 0, 0, 0);
    free_point(&rig, 1, b, 0, 0, 0);
    tie_over(&rig, 0, 0, 1, 0, r, arc, 0.4, 1e5, 1e-4, 10);
    turn(&rig, add_stage(&rig, time, count), direction * 40 * time);
    CpsEvolution *evolution = open(&rig);
    Sums sums = {0};
    const double from = at(evolution, 1, 2);
    steps(evolution, count, &sums);
    char name[64];
    snprintf(name, sizeof name, "drum turns %s, %d elements round, %d steps",
             direction > 0 ? "down" : "up", arc, count);
    const double found = 2 * (from - at(evolution, 1, 2)) / (time * time);
    const double off = figure(name, "acceleration [m/s2]", gain, found) / G;
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
    return off;
}

static void clumps_on_a_line_over_a_drum(void **state) {
    (void)state;
    for (int direction = -1; direction < 2; direction += 2) {
        const double off = atwood(12, direction, 100), finer = atwood(24, direction, 200);
        CHECK_LESS(fabs(off), 0.02);
        CHECK_LESS(fabs(finer), 0.01);
    }
}

/* Clumps on the top of a drum that turns go round with it, and so do they where it is taken along
 * on a table that turns, by either scheme and in steps of any length. */
static void a_drum_takes_clumps_round(void **state) {
    (void)state;
    const double r = 0.7, own = 0.5, time = 1;
    for (int scheme = 0; scheme < 2; scheme++)
        for (int k = 0; k < 4; k++) {
            const int count = k % 2 ? 40 : 8;
            const double about = k < 2 ? 0 : 0.8; /* of the table, about x = 1 */
            Rig rig;
            drum(&rig, (CpsTimeScheme)scheme, 0.9, r);
            free_point(&rig, 0, 5, 0, -0.2, r);
            free_point(&rig, 1, 3, 0, 0.3, r);
            tie_straight(&rig, 0, 0, 1, 1, 100, 0);
            for (int i = 0; i < 2; i++)
                place(rig.point[i].velocity, own / time * r - about * rig.point[i].position[1],
                      -about, 0);
            CpsStage *stage = add_stage(&rig, time, count);
            turn(&rig, stage, own);
            if (about > 0) {
                shift(&rig, stage, 0, 0, 0);
                place(rig.shift[0].turn, 0, 0, about);
                place(rig.shift[0].about, 1, 0, 0);
            }
            CpsEvolution *evolution = open(&rig);
            Sums sums = {0};
            steps(evolution, count, &sums);
            double most = 0;
            for (int i = 0; i < 2; i++) {
                const double x = r * sin(own) - 1, y = rig.point[i].position[1],
                             to[3] = {1 + cos(about) * x - sin(about) * y,
                                      sin(about) * x + cos(about) * y, r * cos(own)};
                for (int a = 0; a < 3; a++) most = fmax(most, fabs(at(evolution, i, a) - to[a]));
            }
            char name[64];
            snprintf(name, sizeof name, "clumps on a drum%s, %s, %d steps",
                     about > 0 ? " taken along" : "", scheme ? "Euler" : "BDF2", count);
            figure(name, "off their places [m]", 0, most);
            CHECK_LESS(most, 1e-12);
            CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
            cps_evolution_destroy(evolution);
        }
}

/* A body on two lines over a drum, in balance without friction; both lines end at held points. */
static void hang(Rig *rig, double friction, double mass, double line_mass) {
    const double r = 0.1, half = mass * G / 2;
    drum(rig, CPS_TIME_SCHEME_EULER, friction, r);
    rig->scene.body_count = 1;
    for (int i = 0; i < 2; i++)
        (void)tie_over(rig, i, i, 2 + i, 0.2 * i - 0.1, r, 16, 0.4, 2e4, line_mass, half);
    rig->scene.point_count = 4;
    const double low = rig->point[2].position[2] - 0.1;
    rig->body.kind = CPS_BODY_KIND_FREE;
    place(rig->body.position, r, 0, low);
    rig->body.weight = mass * G;
    rig->body.mass = mass;
    place(rig->body.inertia, 0.02, 0.02, 0.02);
    for (int i = 0; i < 2; i++) {
        rig->point[2 + i].kind = CPS_POINT_KIND_ON_BODY;
        rig->point[2 + i].body = 0;
        place(rig->point[2 + i].position, 0, 0.2 * i - 0.1, 0.1);
    }
}

/* ... over a drum that slips under them it hangs at rest: each held end takes half of its weight,
 * times or over e^(mu pi). */
static void a_body_on_lines_over_a_drum(void **state) {
    (void)state;
    const double friction = 0.3, mass = 4, half = mass * G / 2;
    for (int direction = -1; direction < 2; direction += 2) {
        Rig rig;
        hang(&rig, friction, mass, 1e-3);
        turn(&rig, add_stage(&rig, 2, 200), direction * 4 * PI);
        CpsEvolution *evolution = open(&rig);
        Sums sums = {0};
        steps(evolution, 200, &sums);
        /* the drum that turns towards the body pulls it down: the held end takes more */
        const double expected = half * exp(direction * friction * PI);
        char name[48];
        snprintf(name, sizeof name, "body, drum turns %s", direction > 0 ? "down" : "up");
        for (int i = 0; i < 2; i++) {
            const double *f = cps_evolution_line_report(evolution, i).end[0].force;
            const double pull = sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
            CHECK_LESS(fabs(figure(name, "tension at the held end [N]", expected, pull)),
                       0.01 * expected);
        }
        const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
        CHECK_NEAR(report.position[1], 0, 1e-9);
        CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
        cps_evolution_destroy(evolution);
    }
}

/* ---- Galilei ---- */

/* Clumps on a line, one of them thrown on a bed, for `count` steps, all of it in a frame of the
 * velocity `v`; the places at the end, seen from the frame. */
static void thrown(const double v[3], int count, double out[3 * POINTS]) {
    const double time = 0.6;
    Rig rig;
    begin(&rig, CPS_TIME_SCHEME_EULER, 0.3);
    free_point(&rig, 0, 2, 0, 0, 0.3);
    free_point(&rig, 1, 1, 0.6, 0.1, 0);
    free_point(&rig, 2, 3, 0.9, -0.4, 0.2);
    tie_straight(&rig, 0, 0, 1, 8, 4e3, 0.3);
    tie_straight(&rig, 1, 1, 2, 8, 4e3, 0.3);
    for (int i = 0; i < 3; i++) memcpy(rig.point[i].velocity, v, 3 * sizeof *v);
    for (int i = 0; i < 2; i++) memcpy(rig.line[i].velocity, v, 3 * sizeof *v);
    rig.point[0].velocity[0] += 1;
    rig.point[2].velocity[1] += 2;
    shift(&rig, add_stage(&rig, time, count), v[0] * time, v[1] * time, v[2] * time);
    CpsEvolution *evolution = open(&rig);
    Sums sums = {0};
    steps(evolution, count, &sums);
    for (int i = 0; i < 3; i++)
        for (int a = 0; a < 3; a++) out[3 * i + a] = at(evolution, i, a) - v[a] * time;
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
}

/* ... and a body that swings on lines over a drum that turns, their other ends held in the frame.
 */
static void swung(const double v[3], int count, double out[3]) {
    const double time = 0.4;
    Rig rig;
    hang(&rig, 0.2, 4, 0.2);
    memcpy(rig.body.velocity, v, 3 * sizeof *v);
    rig.body.velocity[0] += 0.3;
    rig.body.velocity[1] += 0.2;
    for (int i = 0; i < 2; i++) memcpy(rig.line[i].velocity, v, 3 * sizeof *v);
    CpsStage *stage = add_stage(&rig, time, count);
    shift(&rig, stage, v[0] * time, v[1] * time, v[2] * time);
    turn(&rig, stage, 3);
    for (int i = 0; i < 2; i++) {
        rig.change[i] = (CpsPointChange){.point = i, .kind = CPS_POINT_KIND_HELD};
        for (int a = 0; a < 3; a++) rig.change[i].value[a] = rig.point[i].position[a] + v[a] * time;
    }
    stage->point_change = rig.change;
    stage->point_change_count = 2;
    CpsEvolution *evolution = open(&rig);
    Sums sums = {0};
    steps(evolution, count, &sums);
    const CpsBodyReport report = cps_evolution_body_report(evolution, 0);
    for (int a = 0; a < 3; a++) out[a] = report.position[a] - v[a] * time;
    CHECK_LESS(sums.imbalance, 1e-10 * sums.turnover);
    cps_evolution_destroy(evolution);
}

/* All that moves in a frame moves so in another one. */
static void a_frame_of_constant_velocity(void **state) {
    (void)state;
    const double still[3] = {0}, frame[3] = {2, -1, 0.7};
    double a[3 * POINTS], b[3 * POINTS], most = 0;
    thrown(still, 120, a);
    thrown(frame, 120, b);
    for (int i = 0; i < 9; i++) most = fmax(most, fabs(a[i] - b[i]));
    figure("frames", "largest difference of places [m]", 0, most);
    CHECK_LESS(most, 1e-8);
    const double slow[3] = {0.5, -0.3, 0.2};
    swung(still, 120, a);
    swung(slow, 120, b);
    most = 0;
    for (int i = 0; i < 3; i++) most = fmax(most, fabs(a[i] - b[i]));
    figure("frames", "largest difference of the body's place [m]", 0, most);
    CHECK_LESS(most, 1e-8);
}

/* ---- steps too long ---- */

/* A clump on a string from a held point, beside a post of 0.05 m that goes by `way` or turns, in
 * `count` steps: how many are certified, and where the clump is. */
static int push(int count, double way, double angle, double *found) {
    Rig rig;
    CpsError err;
    drum(&rig, CPS_TIME_SCHEME_BDF2, 0.2, 0.05);
    place(rig.scene.gravity, 0, 0, 0);
    place(rig.obstacle.axis, 0, 0, 1);
    place(rig.obstacle.point, 1, 0.3, 0);
    free_point(&rig, 1, 1, 1, 0, 0);
    rig.point[1].weight = 0;
    tie_straight(&rig, 0, 0, 1, 1, 100, 0);
    CpsStage *stage = add_stage(&rig, 1, count);
    if (way != 0) shift(&rig, stage, 0, way, 0);
    if (angle != 0) turn(&rig, stage, angle);
    CpsEvolution *evolution = open(&rig);
    int certified = 0;
    for (int k = 0; k < count; k++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        const CpsOutcome outcome = cps_evolution_report(evolution).outcome;
        certified += cps_outcome_is_certified(outcome);
        assert_true(cps_outcome_is_certified(outcome) || outcome == CPS_OUTCOME_STALLED);
    }
    *found = at(evolution, 1, 1);
    cps_evolution_destroy(evolution);
    return certified;
}

/* As beside lines alone: by no more than a quarter of a radius, and of a turn. */
static void no_step_is_too_long(void **state) {
    (void)state;
    double found;
    CHECK_INT(push(1, -0.6, 0, &found), 0);
    CHECK_LESS(push(12, -0.6, 0, &found), 12);
    CHECK_INT(push(100, -0.6, 0, &found), 100);
    figure("post", "place of the clump [m]", -0.35, found);
    CHECK_LESS(found, -0.3);
    CHECK_INT(push(1, 0, 2, &found), 0);
    CHECK_INT(push(2, 0, 2, &found), 2);
    CHECK_INT(push(1, 0.6, 0, &found), 1);
}

/* What rests on a deck goes with it, by three radii of its edges in a step. */
static void clumps_go_with_a_deck(void **state) {
    (void)state;
    const double by[3] = {1.5, -0.6, 0};
    const int count = 10;
    Rig rig;
    clumps(&rig, CPS_TIME_SCHEME_BDF2, 0.4);
    rig.obstacle.kind = CPS_OBSTACLE_BOX;
    place(rig.obstacle.point, 2, 0, -0.5);
    place(rig.obstacle.shape.size, 8, 4, 1);
    rig.obstacle.radius = 0.05;
    for (int k = 0; k < 2; k++) place(rig.point[k].velocity, by[0], by[1], by[2]);
    place(rig.line[0].velocity, by[0], by[1], by[2]);
    CpsStage *stage = add_stage(&rig, 1, count);
    shift(&rig, stage, by[0], by[1], by[2]);
    CpsEvolution *evolution = open(&rig);
    const double from[2] = {at(evolution, 0, 0), at(evolution, 1, 0)};
    Sums sums = {0};
    steps(evolution, count, &sums);
    for (int k = 0; k < 2; k++) {
        figure("deck", "way of a clump along x [m]", by[0], at(evolution, k, 0) - from[k]);
        CHECK_NEAR(at(evolution, k, 0) - from[k], by[0], 1e-9);
        CHECK_NEAR(at(evolution, k, 2), 0, 1e-9);
    }
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_belt_takes_clumps_along),
        cmocka_unit_test(a_table_goes_to_and_fro),
        cmocka_unit_test(a_program_moves_the_table),
        cmocka_unit_test(a_table_takes_clumps_round),
        cmocka_unit_test(a_floor_throws_clumps_up),
        cmocka_unit_test(a_held_point_rises_with_the_floor),
        cmocka_unit_test(clumps_on_a_line_over_a_drum),
        cmocka_unit_test(a_drum_takes_clumps_round),
        cmocka_unit_test(a_body_on_lines_over_a_drum),
        cmocka_unit_test(a_frame_of_constant_velocity),
        cmocka_unit_test(no_step_is_too_long),
        cmocka_unit_test(clumps_go_with_a_deck),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
