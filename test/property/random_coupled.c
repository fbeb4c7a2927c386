/* SPDX-License-Identifier: BSD-3-Clause */
/* A coupled program that gives place and velocity of what it leads, beside the same motion written
 * into the history of a scene.             usage: random_coupled [--scenes N] [--seed S]
 *
 * A line from an anchor, on a bed with friction or hanging, with or without damping and drag, goes
 * to an end or a point that is led, or two go to a body. The motion is a sum of c (1 - cos w t),
 * which begins at rest; of a body the rotation vector as well. The history has it as oscillations,
 * and its velocities are those of the scheme by the places; the coupled program gives the places,
 * to the same bits, and the velocities of the closed form. Then, in every step:
 *
 *   places   The free nodes have the same program in both, for the led node enters it by its place
 *            alone. Each solution is within the bound that its certificate gives of the exact one,
 *            2 k^2 gap in the norm of the masses (theory.md 9e), and what a step adds by it to the
 *            velocity goes on to the end: n times the sum of the bounds so far.
 *   force    Without drag the forces that lead it differ by M ((V - V*) - (v - v*))/k, M the mass
 *            there, V the velocities given and v those of the scheme, each by its own formula here,
 *            up to the stiffness of the last element times what the places of its node differ by.
 *   bound    With M2, M3 and M4 bounds of the second to fourth derivatives of the motion, the
 * scheme has v = V + e, |e| <= (h/2) M2 in the first step, by (x_1 - x_0)/h, and (h^2/3) M3 in the
 * others, the error at its end of the parabola through three places. e is a function of time there,
 * of the derivative at most (h^2/3) M4, and the same formula applied to it is 3/2 of one difference
 * quotient less 1/2 of another. So accelerations differ by at most
 *
 *                M2/2,  M2 + (h/2) M3,  M2/4 + (7/6) h M3   in the first three steps,
 *                (2/3) h^2 M4                               in all others,
 *
 *            and forces by M and the added mass times that, and by e times the slope of drag.
 *   body     Its velocities are those given, and its inertia is minus the rate by the scheme of the
 *            momenta that these velocities have.
 *
 * Nodes that take a step of the first order later, where something is snatched, have other bounds
 * and are counted only. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"

enum { WAVES = 3, STEPS = 40, MOST_NODES = 21, LED = 1 };
typedef enum Lead { LEAD_END, LEAD_POINT, LEAD_BODY } Lead;
static const double PI = 3.14159265358979323846, GRAVITY = 9.81, DENSITY = 1000;

/* Forces of a step are known to this share of the largest, and inertia to some roundings of places
 * over k^2. */
static const double FORCES = 1e-8, ROUNDINGS = 64 * DBL_EPSILON;

typedef struct Coupled {
    Lead lead;
    double h, size, place[3]; /* place: where it begins */
    int waves;
    double amplitude[WAVES][6], rate[WAVES];
    bool has_drag;
    CpsObstacle bed;
    CpsLine line[2];
    CpsLineLoads loads;
    CpsCurrentRow row;
    CpsCurrent current;
    CpsPoint point[4];
    CpsBody body;
    CpsChange end_change;
    CpsPointChange point_change;
    CpsBodyChange body_change;
    CpsSway sway[WAVES];
    CpsStage stage;
    CpsScene scene;
} Coupled;

typedef struct Tally {
    int scenes, by_lead[3], steps, open, rough, dragged, wrong;
    double places, forces, bounds; /* largest shares of what is allowed */
    int told_apart;                /* steps in which forces differ by more than is rounding */
    double early[2]; /* sums of errors of accelerations over M2: given, and by the scheme */
} Tally;

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "%s: %s\n", err->where, err->message);
    exit(1);
}

static double size_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }
static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* the scene ------------------------------------------------------------------------------------ */

static void make_line(Coupled *c, int i) {
    CpsLine *line = &c->line[i];
    *line = cps_line_default();
    line->name = i ? "other" : "line";
    const double far[2] = {i ? -0.6 : 0.8, i ? 0.1 : 0}, mass = pow(10, uniform(0, 1.5));
    double square = 0;
    for (int a = 0; a < 3; a++) {
        const double from = a < 2 ? c->place[a] - far[a] * c->size : 0;
        c->point[i].position[a] = from;
        square += pow(c->place[a] - from, 2);
    }
    line->length = sqrt(square) * uniform(1.02, 1.2);
    line->element_count = whole(6, MOST_NODES - 1);
    line->inertia = mass;
    line->weight = mass * GRAVITY;
    line->stiffness = line->weight * line->length * pow(10, uniform(1, 3));
    if (chance(0.3)) line->damping = line->stiffness * c->h * pow(10, uniform(-2, 0));
    if (c->has_drag) line->loads = &c->loads;
    line->start.kind = CPS_START_STATIC;
    line->end[CPS_END_A].kind = line->end[CPS_END_B].kind = CPS_END_KIND_POINT;
    line->end_point[CPS_END_A] = i;
    line->end_point[CPS_END_B] = c->lead == LEAD_POINT ? LED : 2 + i;
    if (c->lead != LEAD_END) return;
    for (int end = 0; end < 2; end++) line->end[end] = (CpsEnd){.kind = CPS_END_KIND_HELD};
    memcpy(line->end[CPS_END_A].value, c->point[0].position, sizeof c->place);
    memcpy(line->end[CPS_END_B].value, c->place, sizeof c->place);
}

static void make_points(Coupled *c) {
    static const char *const NAME[] = {"anchor", "far", "eye", "ear"};
    for (int i = 0; i < 4; i++) {
        c->point[i] = cps_point_default();
        c->point[i].name = NAME[i];
    }
    c->point[LED].inertia = c->lead == LEAD_POINT ? uniform(0, 100) : 0;
    if (c->lead == LEAD_POINT) memcpy(c->point[LED].position, c->place, sizeof c->place);
    if (c->lead != LEAD_BODY) return;
    c->body = cps_body_default();
    c->body.name = "body";
    c->body.mass = uniform(10, 500);
    memcpy(c->body.position, c->place, sizeof c->place);
    for (int a = 0; a < 3; a++) {
        c->body.centre_of_gravity[a] = uniform(-0.02, 0.02) * c->size;
        c->body.inertia[a] = c->body.mass * pow(uniform(0.08, 0.1) * c->size, 2);
        c->body.inertia[3 + a] = uniform(-0.1, 0.1) * c->body.inertia[a];
    }
    for (int i = 2; i < 4; i++) {
        c->point[i].kind = CPS_POINT_KIND_ON_BODY;
        for (int a = 0; a < 3; a++) c->point[i].position[a] = uniform(-0.05, 0.05) * c->size;
    }
}

static void make_motion(Coupled *c) {
    c->waves = whole(1, WAVES);
    c->stage = cps_stage_default();
    c->stage.name = "lead";
    c->stage.duration = STEPS * c->h;
    c->stage.step_count = STEPS;
    c->stage.sway = c->sway;
    c->stage.sway_count = c->waves;
    for (int j = 0; j < c->waves; j++) {
        const double period = uniform(20, 80) * c->h;
        CpsSway *sway = &c->sway[j];
        c->rate[j] = 2 * PI / period;
        *sway = (CpsSway){.of = c->lead == LEAD_END     ? CPS_SWAY_OF_END
                                : c->lead == LEAD_POINT ? CPS_SWAY_OF_POINT
                                                        : CPS_SWAY_OF_BODY,
                          .owner = c->lead == LEAD_POINT ? LED : 0,
                          .end = CPS_END_B,
                          .period = period};
        for (int a = 0; a < 6; a++) {
            if (a > 2 && c->lead != LEAD_BODY) continue;
            c->amplitude[j][a] = uniform(-0.02, 0.02) * (a < 3 ? c->size : 3);
            sway->cosine[a] = c->amplitude[j][a];
        }
    }
}

static void make(Coupled *c, uint64_t seed) {
    memset(c, 0, sizeof *c);
    state = 0xa54ff53a5f1d36f1u * (seed + 1);
    c->lead = (Lead)whole(LEAD_END, LEAD_BODY);
    c->h = pow(10, uniform(-2.3, -1));
    c->size = pow(10, uniform(0.3, 2));
    c->has_drag = c->lead != LEAD_BODY && chance(0.4);
    for (int a = 0; a < 3; a++) c->place[a] = uniform(0.3, 0.7) * c->size;
    c->scene = cps_scene_default();
    c->scene.in_time = true;
    c->bed = cps_obstacle_default();
    c->bed.name = "bed";
    c->bed.friction = chance(0.2) ? 0 : uniform(0.1, 1);
    c->scene.obstacle = &c->bed;
    c->scene.obstacle_count = chance(0.8);
    CpsDrag *drag = &c->loads.drag;
    drag->diameter = uniform(0.01, 0.1);
    drag->normal = uniform(0.5, 2);
    drag->tangential = uniform(0, 0.1);
    drag->added_normal = uniform(0, 1);
    drag->added_tangential = uniform(0, 0.2);
    c->row = (CpsCurrentRow){.z = 0};
    for (int a = 0; a < 2; a++) c->row.velocity[a] = uniform(-0.5, 0.5);
    c->current = (CpsCurrent){.density = DENSITY, .row_count = 1, .row = &c->row};
    if (c->has_drag) c->scene.current = &c->current;
    make_points(c);
    c->scene.line = c->line;
    c->scene.line_count = c->lead == LEAD_BODY ? 2 : 1;
    for (int i = 0; i < c->scene.line_count; i++) make_line(c, i);
    c->scene.point = c->point;
    c->scene.point_count = c->lead == LEAD_END ? 0 : c->lead == LEAD_POINT ? 2 : 4;
    c->scene.body = &c->body;
    c->scene.body_count = c->lead == LEAD_BODY;
    make_motion(c);
    c->end_change = (CpsChange){.line = 0, .end = CPS_END_B, .to = {.kind = CPS_END_KIND_HELD}};
    c->point_change = (CpsPointChange){.point = LED, .kind = CPS_POINT_KIND_HELD};
    c->body_change = (CpsBodyChange){.kind = CPS_BODY_KIND_HELD, .rotation = {1, 0, 0, 0}};
    memcpy(c->end_change.to.value, c->place, sizeof c->place);
    memcpy(c->point_change.value, c->place, sizeof c->place);
    memcpy(c->body_change.position, c->place, sizeof c->place);
    c->stage.change = &c->end_change;
    c->stage.point_change = &c->point_change;
    c->stage.body_change = &c->body_change;
    c->stage.change_count = c->lead == LEAD_END;
    c->stage.point_change_count = c->lead == LEAD_POINT;
    c->stage.body_change_count = c->lead == LEAD_BODY;
}

/* the motion in closed form -------------------------------------------------------------------- */

/* The derivative of this order of displacement and rotation vector, order >= 1. */
static void derivative(const Coupled *c, int order, double time, double out[6]) {
    for (int a = 0; a < 6; a++) out[a] = 0;
    for (int j = 0; j < c->waves; j++)
        for (int a = 0; a < 6; a++)
            out[a] -= c->amplitude[j][a] * pow(c->rate[j], order) *
                      cos(c->rate[j] * time + order * PI / 2);
}

/* A bound of the displacement's derivative of an order at all times. */
static double most(const Coupled *c, int order) {
    double sum = 0;
    for (int j = 0; j < c->waves; j++) sum += size_of(c->amplitude[j]) * pow(c->rate[j], order);
    return sum;
}

/* What is led after a step. */
typedef struct Phase {
    double place[3], rotation[4]; /* as they are given */
    double velocity[6];           /* of it, and its rate of rotation in the axes of the scene */
} Phase;

static Phase phase_at(const Coupled *c, double time) {
    Phase out = {.rotation = {1, 0, 0, 0}};
    double sum[6] = {0}, rate[6];
    for (int j = 0; j < c->waves; j++) {
        double added[6];
        cps_sway_at(&c->sway[j], time, added);
        for (int a = 0; a < 6; a++) sum[a] += added[a];
    }
    derivative(c, 1, time, rate);
    for (int a = 0; a < 3; a++) {
        out.place[a] = c->place[a] + sum[a];
        out.velocity[a] = rate[a];
    }
    const double *t = &sum[3], angle = size_of(t);
    double once[3], twice[3];
    cross(t, &rate[3], once);
    cross(t, once, twice);
    const double small = angle < 1e-3, square = angle * angle,
                 first = small ? 0.5 - square / 24 : (1 - cos(angle)) / square,
                 second = small ? 1.0 / 6 - square / 120 : (angle - sin(angle)) / (square * angle);
    out.rotation[0] = cos(angle / 2);
    for (int a = 0; a < 3; a++) {
        out.rotation[1 + a] = angle > 0 ? sin(angle / 2) * t[a] / angle : 0;
        out.velocity[3 + a] = rate[3 + a] + first * once[a] + second * twice[a];
    }
    return out;
}

/* runs ----------------------------------------------------------------------------------------- */

static CpsEvolution *begin(const CpsScene *scene) {
    CpsError err;
    CpsEvolution *evolution = NULL;
    need(cps_evolution_create(scene, &evolution, &err), &err);
    need(cps_evolution_step(evolution, &err), &err);
    return evolution;
}

static void move(Coupled *c, CpsEvolution *evolution, const Phase *to) {
    CpsError err;
    CpsStage step = c->stage;
    CpsChange end = c->end_change;
    CpsPointChange point = c->point_change;
    CpsBodyChange body = c->body_change;
    step.sway_count = 0;
    step.duration = c->stage.duration / STEPS;
    step.step_count = 1;
    step.change = &end;
    step.point_change = &point;
    step.body_change = &body;
    memcpy(end.to.value, to->place, sizeof to->place);
    memcpy(point.value, to->place, sizeof to->place);
    memcpy(body.position, to->place, sizeof to->place);
    memcpy(body.rotation, to->rotation, sizeof to->rotation);
    memcpy(end.velocity, to->velocity, sizeof end.velocity);
    memcpy(point.velocity, to->velocity, sizeof point.velocity);
    memcpy(body.velocity, to->velocity, sizeof body.velocity);
    end.has_velocity = point.has_velocity = body.has_velocity = true;
    need(cps_evolution_move(evolution, &step, &err), &err);
}

/* What leads it: force, and velocity as reported; the span of its scheme. The line at a point that
 * is led may take a step of the first order by itself, where something is snatched beside it. */
typedef struct Led {
    double force[3], velocity[3], span, mass;
    double beside[3]; /* place of the next node of the line */
    bool apart;       /* the line did */
} Led;

static Led led_of(const Coupled *c, const CpsEvolution *evolution) {
    Led out = {.span = 0};
    const CpsLineMotion line = cps_evolution_line_motion(evolution, 0);
    const int last = c->line[0].element_count;
    out.mass = line.mass[last];
    memcpy(out.beside, &cps_evolution_line_view(evolution, 0).position[3 * (last - 1)],
           sizeof out.beside);
    if (c->lead == LEAD_END) {
        const CpsLineReport report = cps_evolution_line_report(evolution, 0);
        memcpy(out.force, report.end[CPS_END_B].force, sizeof out.force);
        memcpy(out.velocity, &line.velocity[3 * last], sizeof out.velocity);
        out.span = line.span[last];
    } else {
        const CpsPointReport report = cps_evolution_point_report(evolution, LED);
        const CpsPointMotion motion = cps_evolution_point_motion(evolution, LED);
        memcpy(out.force, report.support, sizeof out.force);
        memcpy(out.velocity, motion.velocity, sizeof out.velocity);
        out.span = motion.span;
        out.mass += motion.mass;
        out.apart = line.span[last] != motion.span;
    }
    return out;
}

/* comparison ----------------------------------------------------------------------------------- */

static void fault(uint64_t seed, int step, const char *what, double found, double allowed,
                  Tally *tally) {
    fprintf(stderr, "seed %llu, step %d: %s is %.3g, allowed %.3g\n", (unsigned long long)seed,
            step, what, found, allowed);
    tally->wrong++;
}

static void limit(uint64_t seed, int step, const char *what, double found, double allowed,
                  double *worst, Tally *tally) {
    *worst = fmax(*worst, found / allowed);
    if (!(found <= allowed)) fault(seed, step, what, found, allowed, tally);
}

/* Free nodes of both runs; `sum`: of the bounds so far. Returns the largest force. */
static double compare_places(const Coupled *c, const CpsEvolution *one, const CpsEvolution *other,
                             uint64_t seed, int step, double sum[2], Tally *tally) {
    double largest = 0;
    for (int i = 0; i < c->scene.line_count; i++) {
        const CpsLineView a = cps_evolution_line_view(one, i),
                          b = cps_evolution_line_view(other, i);
        const CpsLineMotion u = cps_evolution_line_motion(one, i),
                            v = cps_evolution_line_motion(other, i);
        double square = 0, weight = 0;
        for (int j = 1; j < a.element_count; j++)
            for (int k = 0; k < 3; k++) {
                const double m = u.mass[j] / (u.span[j] * u.span[j]),
                             off = a.position[3 * j + k] - b.position[3 * j + k];
                square += m * off * off;
                weight += k == 0 ? m : 0;
            }
        sum[i] += u.position_bound + v.position_bound;
        limit(seed, step, "distance of places", sqrt(square / weight),
              step * sum[i] + 1e-12 * c->size, &tally->places, tally);
        largest = fmax(largest, cps_evolution_line_report(one, i).certificate.largest_force);
    }
    return largest;
}

/* Two vectors after each of the last three steps, the last one first. */
typedef struct Steps {
    double one[3][3], other[3][3];
} Steps;

static void push(double rows[3][3], const double v[3]) {
    memmove(rows[1], rows[0], sizeof rows[0] * 2);
    memcpy(rows[0], v, sizeof rows[0]);
}

/* y_{n+1} - y*, over k. */
static double rate_of(double rows[3][3], int a, bool euler, double h) {
    return euler ? (rows[0][a] - rows[1][a]) / h
                 : (3 * rows[0][a] - 4 * rows[1][a] + rows[2][a]) / (2 * h);
}

/* By how much drag differs for velocities that differ by 1 m/s, and the largest added mass. */
static double drag_slope(const Coupled *c, double speed) {
    const double half = 0.5 * c->line[0].length / c->line[0].element_count;
    return half * 0.5 * DENSITY * c->loads.drag.diameter * 2 *
           (c->loads.drag.normal + PI * c->loads.drag.tangential) * speed;
}
static double added_mass(const Coupled *c) {
    const double half = 0.5 * c->line[0].length / c->line[0].element_count,
                 d = c->loads.drag.diameter;
    return half * DENSITY * PI / 4 * d * d *
           fmax(c->loads.drag.added_normal, c->loads.drag.added_tangential);
}

/* Velocities given and of the scheme, and places. */
typedef struct Pair {
    Steps velocity;
    double place[3][3];
    bool smooth; /* all steps but the first were of the second order */
    bool apart;  /* line and point were not one in the step before */
} Pair;

static void compare_forces(const Coupled *c, const Led led[2], const Phase *now, uint64_t seed,
                           int step, double largest, Pair *pair, Tally *tally) {
    const double h = c->stage.duration / STEPS;
    const bool euler = fabs(led[0].span - h) <= 1e-9 * h;
    double exact[6], velocity[3], differ[3], expected[3], slow = 0, error = 0;
    const bool one = !led[0].apart && !led[1].apart;
    if (euler != (step == 1) || !one) pair->smooth = false;
    push(pair->velocity.one, now->velocity);
    push(pair->place, now->place);
    for (int a = 0; a < 3; a++) velocity[a] = rate_of(pair->place, a, euler, h);
    push(pair->velocity.other, velocity);
    derivative(c, 2, step * h, exact);
    double missed[2][3], off[3], beside[3];
    for (int a = 0; a < 3; a++) beside[a] = led[1].beside[a] - led[0].beside[a];
    const CpsLine *line = &c->line[0];
    const double rounding = ROUNDINGS * (size_of(now->place) + c->size),
                 stiffness = 2 * (line->stiffness + line->damping / led[0].span) *
                             line->element_count / line->length,
                 noise = FORCES * largest + stiffness * size_of(beside) +
                         led[0].mass * rounding / (led[0].span * led[0].span);
    for (int a = 0; a < 3; a++) {
        const double by_given = rate_of(pair->velocity.one, a, euler, h),
                     by_scheme = rate_of(pair->velocity.other, a, euler, h);
        differ[a] = led[1].force[a] - led[0].force[a];
        expected[a] = led[0].mass * (by_given - by_scheme);
        missed[0][a] = by_given - exact[a];
        missed[1][a] = by_scheme - exact[a];
        off[a] = led[1].velocity[a] - now->velocity[a];
        slow += pow(velocity[a] - now->velocity[a], 2);
        error += pow(expected[a] - differ[a], 2);
    }
    double unused = 0;
    limit(seed, step, "velocity off that given", size_of(off), rounding / led[1].span, &unused,
          tally);
    if (!c->has_drag && one && !pair->apart)
        limit(seed, step, "force off what the formulas say", sqrt(error), noise, &tally->forces,
              tally);
    pair->apart = !one;
    if (size_of(differ) > noise) tally->told_apart++;
    if (!pair->smooth) {
        tally->rough++;
        return;
    }
    const double m2 = most(c, 2), m3 = most(c, 3), m4 = most(c, 4),
                 wide = step == 1   ? m2 / 2
                        : step == 2 ? m2 + h / 2 * m3
                        : step == 3 ? m2 / 4 + 7.0 / 6 * h * m3
                                    : 2.0 / 3 * h * h * m4,
                 off_by = step == 1 ? h / 2 * m2 : h * h / 3 * m3,
                 speed = size_of(c->row.velocity) + most(c, 1) + off_by,
                 mass = led[0].mass + (c->has_drag ? added_mass(c) : 0),
                 slope = c->has_drag ? drag_slope(c, speed) : 0;
    limit(seed, step, "velocity of the scheme off the motion", sqrt(slow), off_by + rounding / h,
          &tally->bounds, tally);
    limit(seed, step, "difference of forces", size_of(differ), mass * wide + slope * off_by + noise,
          &tally->bounds, tally);
    if (step > 3) return;
    for (int k = 0; k < 2; k++) tally->early[k] += size_of(missed[k]) / m2;
}

/* Momenta of the body: of its mass, and angular about its centre of gravity. */
typedef struct Momenta {
    double arm[3], linear[3], angular[3];
} Momenta;

static void turned(const double q[4], const double v[3], bool back, double out[3]) {
    const double sign = back ? -1 : 1, axis[3] = {sign * q[1], sign * q[2], sign * q[3]};
    double once[3], twice[3];
    cross(axis, v, once);
    cross(axis, once, twice);
    for (int a = 0; a < 3; a++) out[a] = v[a] + 2 * q[0] * once[a] + 2 * twice[a];
}

static Momenta momenta_of(const CpsBody *body, const Phase *at) {
    Momenta out;
    double w[3], around[3], own[3];
    const double *j = body->inertia;
    turned(at->rotation, body->centre_of_gravity, false, out.arm);
    cross(&at->velocity[3], out.arm, around);
    turned(at->rotation, &at->velocity[3], true, w);
    own[0] = j[0] * w[0] + j[3] * w[1] + j[4] * w[2];
    own[1] = j[3] * w[0] + j[1] * w[1] + j[5] * w[2];
    own[2] = j[4] * w[0] + j[5] * w[1] + j[2] * w[2];
    turned(at->rotation, own, false, out.angular);
    for (int a = 0; a < 3; a++) out.linear[a] = body->mass * (at->velocity[a] + around[a]);
    return out;
}

static void compare_body(const Coupled *c, const CpsEvolution *live, const Phase *now,
                         uint64_t seed, int step, Steps *momenta, Tally *tally) {
    const double h = c->stage.duration / STEPS;
    const CpsBodyMotion motion = cps_evolution_body_motion(live, 0);
    const CpsBodyReport report = cps_evolution_body_report(live, 0);
    const bool euler = fabs(motion.span - h) <= 1e-9 * h;
    const Momenta is = momenta_of(&c->body, now);
    double force[3], moment[3], off[4][3], unused = 0;
    push(momenta->one, is.linear);
    push(momenta->other, is.angular);
    for (int a = 0; a < 3; a++) force[a] = -rate_of(momenta->one, a, euler, h);
    cross(is.arm, force, moment);
    for (int a = 0; a < 3; a++) {
        moment[a] -= rate_of(momenta->other, a, euler, h);
        off[0][a] = motion.velocity[a] - now->velocity[a];
        off[1][a] = motion.turn_rate[a] - now->velocity[3 + a];
        off[2][a] = report.inertia[a] - force[a];
        off[3][a] = report.inertia[3 + a] - moment[a];
    }
    const double rounding = ROUNDINGS * (size_of(now->place) + c->size), k = motion.span,
                 fast = k * size_of(&now->velocity[3]) + 1;
    limit(seed, step, "velocity of the body", size_of(off[0]), rounding / k, &unused, tally);
    limit(seed, step, "rate of rotation", size_of(off[1]), ROUNDINGS * fast / k, &unused, tally);
    limit(seed, step, "inertia of the body", size_of(off[2]), 4 * c->body.mass * rounding / (k * k),
          &tally->forces, tally);
    limit(seed, step, "moment of inertia", size_of(off[3]),
          4 * c->body.mass * rounding * c->size / (k * k), &tally->forces, tally);
}

static void try_scene(uint64_t seed, Tally *tally) {
    static Coupled c;
    Pair pair = {.smooth = true};
    Steps momenta = {{{0}}, {{0}}};
    double sum[2] = {0};
    CpsError err;
    make(&c, seed);
    tally->scenes++;
    tally->by_lead[c.lead]++;
    tally->dragged += c.has_drag;
    CpsScene history = c.scene;
    history.stage = &c.stage;
    history.stage_count = 1;
    CpsEvolution *one = begin(&history), *live = begin(&c.scene);
    push(pair.place, c.place);
    for (int step = 1; step <= STEPS; step++) {
        const Phase now = phase_at(&c, step * (c.stage.duration / STEPS));
        need(cps_evolution_step(one, &err), &err);
        move(&c, live, &now);
        if (!cps_outcome_is_certified(cps_evolution_report(one).outcome) ||
            !cps_outcome_is_certified(cps_evolution_report(live).outcome)) {
            tally->open++;
            break;
        }
        tally->steps++;
        const double largest = compare_places(&c, one, live, seed, step, sum, tally);
        if (c.lead == LEAD_BODY) {
            compare_body(&c, live, &now, seed, step, &momenta, tally);
        } else {
            const Led led[2] = {led_of(&c, one), led_of(&c, live)};
            compare_forces(&c, led, &now, seed, step, largest, &pair, tally);
        }
    }
    cps_evolution_destroy(one);
    cps_evolution_destroy(live);
}

int main(int argc, char **argv) {
    Tally t = {0};
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 60, &first);
    for (int i = 0; i < scenes; i++) try_scene(first + (uint64_t)i, &t);
    printf(
        "%d scenes: %d ends, %d points, %d bodies are led, %d with drag; %d steps, %d scenes end "
        "uncertified, %d steps after one of the first order\n",
        t.scenes, t.by_lead[0], t.by_lead[1], t.by_lead[2], t.dragged, t.steps, t.open, t.rough);
    printf("largest share of what is allowed: places %.2g, forces %.2g, bounds %.2g; forces "
           "differ in %d steps\n",
           t.places, t.forces, t.bounds, t.told_apart);
    printf("errors of the accelerations in the first three steps, in all: %.3g with velocities, "
           "%.3g with places alone\n",
           t.early[0], t.early[1]);
    printf("%d wrong\n", t.wrong);
    return t.wrong > 0 || t.open > 0.02 * t.scenes + 1 ||
           (scenes > 1 && (4 * t.told_apart < t.steps || !(t.early[0] < 0.5 * t.early[1])));
}
