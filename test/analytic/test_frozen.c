/* SPDX-License-Identifier: BSD-3-Clause */
/* Frozen friction (S90) among several obstacles, planes, cylinders and balls, with contact reached:
 * random scenes, and the conditions that every step reported as solved must satisfy, with a
 * geometry of the test's own.
 *
 * At the final positions: no node is below an obstacle; an obstacle with a reaction touches the
 * node, and the reaction has the direction of its normal there. At the reference: friction lies in
 * the tangent plane, its bound is mu times the reaction of the preceding step, and its dissipation
 * is the largest possible. A held end on an obstacle is carried by the part of its support along
 * the normal. Elements satisfy the same conditions at one point each, at a depth of at most
 * min(l^2/(4 R), R/4). */
#include <stdio.h>
#include <string.h>

#include "rig.h"

enum { SCENES = 150, ELEMENTS = 24 };

/* splitmix64 */
static uint64_t state_of_chance;

static double chance(double low, double high) {
    uint64_t z = state_of_chance += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return low + (high - low) * (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static double size(const double *a) { return sqrt(dot(a, a)); }

/* distance from an obstacle, and its unit normal there */
static double distance(const CpsObstacle *o, const double *x, double *n) {
    double axis[3];
    const bool plane = o->kind == CPS_OBSTACLE_PLANE;
    for (int k = 0; k < 3; k++) {
        axis[k] = plane ? o->normal[k] : o->axis[k];
        n[k] = x[k] - o->point[k];
    }
    const double length = size(axis), along = dot(n, axis) / length;
    for (int k = 0; k < 3; k++) {
        if (plane) n[k] = axis[k] / length;
        if (o->kind == CPS_OBSTACLE_CYLINDER) n[k] -= along * axis[k] / length;
    }
    if (plane) return along;
    const double far = size(n);
    for (int k = 0; k < 3; k++) n[k] /= far;
    return far - o->radius;
}

static double depth(const Rig *rig, const double *x) {
    double deepest = 0, n[3];
    for (int k = 0; k < rig->scene.obstacle_count; k++)
        deepest = fmax(deepest, -distance(&rig->obstacle[k], x, n));
    return deepest;
}

/* A place beside the obstacles, within `reach` of the origin. */
static void place(const Rig *rig, double reach, double *x) {
    do {
        for (int k = 0; k < 3; k++) x[k] = chance(-reach, reach);
        x[2] = fabs(x[2]);
    } while (depth(rig, x) > 0);
}

/* A bed, or none, with one or two round obstacles; a line of length 1 laid over it from a held
 * end. */
static void build(Rig *rig, uint64_t seed) {
    state_of_chance = seed;
    rig_begin(rig, ELEMENTS, 1, pow(10, chance(0.5, 4)));
    rig_length(rig, 1);
    rig->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    if (chance(0, 1) < 0.8) {
        CpsObstacle *bed = rig_obstacle(rig, CPS_OBSTACLE_PLANE, chance(0, 0.8));
        bed->normal[0] = chance(-0.2, 0.2);
        bed->normal[2] = 1;
    }
    const int round = chance(0, 1) < 0.5 ? 1 : 2;
    for (int i = 0; i < round; i++) {
        const double mu = chance(0, 0.8);
        CpsObstacle *o =
            rig_obstacle(rig, chance(0, 1) < 0.5 ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE, mu);
        o->radius =
            seed % 3 ? chance(0.06, 0.4) : chance(0.01, 0.05); /* thin beside elements of 1/24 */
        o->point[0] = chance(-0.5, 0.5);
        o->point[1] = chance(-0.1, 0.1);
        o->point[2] = chance(0, 0.3);
        o->axis[0] = chance(-0.3, 0.3);
        o->axis[1] = 1;
        o->axis[2] = 0;
    }
    rig->line.start.kind = CPS_START_STATIC;
    double a[3], b[3];
    do {
        place(rig, 0.6, a);
        place(rig, 0.6, b);
    } while (hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]) > 0.95);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, a[0], a[1], a[2]);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, b[0], b[1], b[2]);
    for (int s = 0; s < 3; s++) {
        rig_stage(rig, 1 + (int)chance(0, 3));
        if (chance(0, 1) < 0.3) {
            const double z = chance(-1, 2), y = chance(-2, 2), x = chance(-2, 2);
            rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, x, y, z);
        } else {
            place(rig, 0.6, b);
            rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, b[0], b[1], b[2]);
        }
    }
}

static bool is_held(const CpsLineView *v, int j) {
    return (j == 0 && v->end[0].kind == CPS_END_KIND_HELD) ||
           (j == v->element_count && v->end[1].kind == CPS_END_KIND_HELD);
}

/* What the steps before leave: reactions by node and obstacle. */
typedef struct Before {
    double reaction[RIG_OBSTACLES][ELEMENTS + 1], element[RIG_OBSTACLES][ELEMENTS];
    bool known;
} Before;

typedef struct Worst {
    double open, depth, normal, across, bound, beyond, balance, support;
    int elements; /* contacts of elements with a reaction */
} Worst;

static int obstacle_of(const CpsLineView *v, int c) { return v->obstacle[c]; }

/* What touches an obstacle: a node, or a point of an element. */
typedef struct Touch {
    int obstacle;
    double x[3], from[3], normal[3],
        friction[3]; /* its place, that at the reference, and what the view says */
    double first[3]; /* normal of the plane of friction */
    double depth, reaction, bound,
        due; /* how deep it may lie; due: mu times the reaction of the step before */
} Touch;

static void look_at(const Rig *rig, const Touch *t, bool known, double largest, double *sum,
                    Worst *w, double *law) {
    double n[3], u[3];
    const double open = distance(&rig->obstacle[t->obstacle], t->x, n) + t->depth;
    for (int a = 0; a < 3; a++) u[a] = t->x[a] - t->from[a];
    const double rise = dot(u, t->first);
    for (int a = 0; a < 3; a++) {
        sum[a] += t->friction[a] + t->reaction * t->normal[a];
        u[a] -= rise * t->first[a];
        if (t->reaction > 0) w->normal = fmax(w->normal, fabs(t->normal[a] - n[a]));
    }
    if (t->reaction > 1e-6 * largest) w->open = fmax(w->open, fabs(open));
    w->across = fmax(w->across, fabs(dot(t->friction, t->first)) / largest);
    w->beyond = fmax(w->beyond, (size(t->friction) - t->bound) / largest);
    *law += t->bound * size(u) + dot(t->friction, u);
    /* what the step before left apart has none */
    if (known && t->bound > 0) w->bound = fmax(w->bound, fabs(t->bound - t->due) / largest);
}

/* A contact of a free node; adds its forces to `sum`. */
static void look_at_node(const Rig *rig, const CpsLineView *v, const Before *before, int c,
                         double largest, double *sum, Worst *w, double *law) {
    const int j = c % (v->element_count + 1), k = obstacle_of(v, c);
    Touch t = {.obstacle = k,
               .reaction = v->reaction[c],
               .bound = v->friction_bound[c],
               .due = rig->obstacle[k].friction * before->reaction[k][j]};
    memcpy(t.x, &v->position[3 * j], sizeof t.x);
    memcpy(t.from, &v->reference[3 * j], sizeof t.from);
    memcpy(t.normal, &v->normal[3 * c], sizeof t.normal);
    memcpy(t.friction, &v->friction_force[3 * c], sizeof t.friction);
    distance(&rig->obstacle[k], t.from, t.first);
    look_at(rig, &t, before->known, largest, sum, w, law);
}

/* The share of the segment from a to b at which the straight piece is nearest to an obstacle; below
 * 0 or above 1 where that is an end. */
static double nearest(const CpsObstacle *o, const double *a, const double *b) {
    double d0[3], d1[3];
    for (int k = 0; k < 3; k++) {
        d0[k] = a[k] - o->point[k];
        d1[k] = b[k] - a[k];
    }
    const double axis = size(o->axis), rise = dot(d0, o->axis) / axis,
                 lift = dot(d1, o->axis) / axis;
    if (o->kind == CPS_OBSTACLE_CYLINDER)
        for (int k = 0; k < 3; k++) {
            d0[k] -= rise * o->axis[k] / axis;
            d1[k] -= lift * o->axis[k] / axis;
        }
    return -dot(d0, d1) / dot(d1, d1);
}

static void look_at_element(const Rig *rig, const CpsLineView *v, const Before *before, int e,
                            double largest, double *sum, Worst *w, double *law) {
    const int k = v->element_obstacle[e];
    const double b = v->element_share[e], l = v->element_length[e],
                 radius = rig->obstacle[k].radius;
    const double *x = &v->position[3 * e], *from = &v->reference[3 * e];
    Touch t = {.obstacle = k,
               .reaction = v->element_reaction[e],
               .bound = v->element_friction_bound[e],
               .depth = fmin(l * l / radius, radius) / 4,
               .due = rig->obstacle[k].friction * before->element[k][e]};
    double facing = nearest(&rig->obstacle[k], from, from + 3), touched[3];
    if (!(facing > 0 && facing < 1)) facing = b;
    for (int a = 0; a < 3; a++) {
        t.x[a] = (1 - b) * x[a] + b * x[3 + a];
        t.from[a] = (1 - b) * from[a] + b * from[3 + a];
        touched[a] = (1 - facing) * from[a] + facing * from[3 + a];
    }
    distance(&rig->obstacle[k], touched, t.first);
    memcpy(t.normal, &v->element_normal[3 * e], sizeof t.normal);
    memcpy(t.friction, &v->element_friction_force[3 * e], sizeof t.friction);
    w->elements += t.reaction > 0;
    look_at(rig, &t, before->known, largest, sum, w, law);
}

/* What the contacts of the elements beside node j do on it. */
static void add_elements(const CpsLineView *v, int j, double *sum) {
    if (v->element_obstacle)
        for (int e = j - 1; e <= j; e++) {
            if (e < 0 || e >= v->element_count || v->element_obstacle[e] < 0) continue;
            const double part = e == j ? 1 - v->element_share[e] : v->element_share[e];
            for (int a = 0; a < 3; a++)
                sum[a] += part * (v->element_friction_force[3 * e + a] +
                                  v->element_reaction[e] * v->element_normal[3 * e + a]);
        }
}

static void audit(const Rig *rig, const CpsLineView *v, const CpsLineReport *report,
                  const Before *before, Worst *w) {
    const int n = v->element_count + 1;
    const double largest = report->certificate.largest_force;
    double law = 0;
    for (int j = 0; j < n; j++) {
        double sum[3], normal[3];
        w->depth = fmax(w->depth, depth(rig, &v->position[3 * j]));
        for (int a = 0; a < 3; a++) {
            sum[a] = v->load[3 * j + a];
            if (j < v->element_count) sum[a] += v->segment_force[3 * j + a];
            if (j > 0) sum[a] -= v->segment_force[3 * (j - 1) + a];
        }
        add_elements(v, j, sum);
        if (is_held(v, j)) {
            if (!(v->reaction[j] > 0)) continue;
            w->open = fmax(w->open, fabs(distance(&rig->obstacle[obstacle_of(v, j)],
                                                  &v->position[3 * j], normal)));
            for (int a = 0; a < 3; a++)
                w->normal = fmax(w->normal, fabs(v->normal[3 * j + a] - normal[a]));
            w->support = fmax(w->support, fabs(v->reaction[j] + dot(sum, normal)) / largest);
            continue;
        }
        for (int c = j; c < v->contact_count * n; c += n)
            look_at_node(rig, v, before, c, largest, sum, w, &law);
        w->balance = fmax(w->balance, size(sum) / largest);
    }
    if (v->element_obstacle)
        for (int e = 0; e < v->element_count; e++) {
            double unused[3] = {0};
            if (v->element_obstacle[e] >= 0)
                look_at_element(rig, v, before, e, largest, unused, w, &law);
        }
    CHECK_LESS(law, 1e-8 * report->certificate.scale + 1e-300); /* what the certificate promises */
}

static void remember(const CpsLineView *v, Before *before) {
    const int n = v->element_count + 1;
    memset(before, 0, sizeof *before);
    before->known = true;
    for (int c = 0; c < v->contact_count * n; c++)
        before->reaction[obstacle_of(v, c)][c % n] = v->reaction[c];
    if (v->element_obstacle)
        for (int e = 0; e < v->element_count; e++)
            if (v->element_obstacle[e] >= 0)
                before->element[v->element_obstacle[e]][e] = v->element_reaction[e];
}

static void check_worst(const Worst *w, uint64_t seed) {
    if (!(w->open < 1e-8 && w->depth < 1e-9)) print_error("seed %d\n", (int)seed);
    CHECK_LESS(w->depth, 1e-9); /* the touch of a line of length 1 */
    CHECK_LESS(w->open,
               1e-8); /* of reactions above 1e-6 of the largest force: gap/R, and rounding */
    CHECK_LESS(w->normal, 1e-12); /* rounding, over radii above 0.01 */
    CHECK_LESS(w->across, 1e-12);
    CHECK_LESS(w->beyond, 1e-12);
    CHECK_LESS(w->bound, 1e-12);
    CHECK_LESS(w->balance, 1e-9); /* as the checker */
    CHECK_LESS(w->support, 1e-12);
}

static void random_scenes(void **state) {
    (void)state;
    int steps = 0, solved = 0, pressed = 0, elements = 0;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        Rig rig;
        build(&rig, seed);
        CpsError err = {0};
        CpsEvolution *evolution;
        if (cps_evolution_create(&rig.scene, &evolution, &err) != CPS_OK)
            continue; /* an end's path leads through an obstacle */
        Before before = {.known = false};
        Worst worst = {0};
        for (int s = 0; cps_evolution_remaining_count(evolution) > 0; s++) {
            if (cps_evolution_step(evolution, &err) != CPS_OK) break;
            const CpsLineReport report = cps_evolution_line_report(evolution, 0);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            steps++;
            if (report.substep_count > 1)
                before.known = false; /* the reference is that of the last part */
            if (report.outcome == CPS_OUTCOME_SOLVED && s > 0) {
                solved++;
                audit(&rig, &view, &report, &before, &worst);
                for (int c = 0; c < view.contact_count * (ELEMENTS + 1); c++)
                    pressed += view.reaction[c] > 0;
            }
            remember(&view, &before);
        }
        check_worst(&worst, seed);
        elements += worst.elements;
        cps_evolution_destroy(evolution);
    }
    printf("%d steps, %d solved after the first, %d contacts with a reaction, and %d of elements\n",
           steps, solved, pressed, elements);
    CHECK_GREATER(elements, 10);
    CHECK_GREATER(solved, 2 * SCENES); /* three to nine steps a scene */
    CHECK_GREATER(pressed, 10 * SCENES);
}

/* Strict contact, S90 (35), with either law: what pushes a node touched it at the reference, to
 * 1e-9 of the length, and what is below an obstacle there is pushed by nothing. */
static void strict_contact(void **state) {
    (void)state;
    int pressed = 0, below = 0;
    for (uint64_t seed = 1; seed <= SCENES; seed++) {
        Rig rig;
        build(&rig, seed);
        rig.scene.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
        rig.scene.friction_policy =
            seed % 2 ? CPS_FRICTION_POLICY_FROZEN : CPS_FRICTION_POLICY_CONSISTENT;
        CpsError err = {0};
        CpsEvolution *evolution;
        if (cps_evolution_create(&rig.scene, &evolution, &err) != CPS_OK) continue;
        for (int s = 0; cps_evolution_remaining_count(evolution) > 0; s++) {
            if (cps_evolution_step(evolution, &err) != CPS_OK) break;
            const CpsLineReport report = cps_evolution_line_report(evolution, 0);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            if (s == 0 || report.outcome != CPS_OUTCOME_SOLVED) continue;
            for (int c = 0; c < view.contact_count * (ELEMENTS + 1); c++) {
                const int j = c % (ELEMENTS + 1);
                if (is_held(&view, j)) continue;
                double n[3];
                const double from =
                    distance(&rig.obstacle[obstacle_of(&view, c)], &view.reference[3 * j], n);
                below += from < -1e-6;
                if (!(view.reaction[c] > 0)) continue;
                pressed++;
                CHECK_BETWEEN(from, -1.001e-9, 1.001e-9);
            }
        }
        cps_evolution_destroy(evolution);
    }
    printf("strict: %d contacts with a reaction, %d below an obstacle\n", pressed, below);
    CHECK_GREATER(pressed, 100);
    CHECK_GREATER(below, 100);
}

/* A rope over a ball whose end is lifted off it and put down elsewhere: the reaction belongs to the
 * normal at the place reached, not to that of the reference. */
static void held_end_on_a_ball(void **state) {
    (void)state;
    for (int k = 0; k < 8; k++) {
        Rig rig;
        rig_begin(&rig, ELEMENTS, 1, 1000);
        rig_length(&rig, 1);
        rig.scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
        CpsObstacle *ball = rig_obstacle(&rig, CPS_OBSTACLE_SPHERE, 0.3);
        ball->radius = 0.5;
        rig.line.start.kind = CPS_START_STATIC;
        rig_end(&rig, CPS_END_A, CPS_END_KIND_HELD, -0.9, 0, 0.1);
        rig_end(&rig, CPS_END_B, CPS_END_KIND_HELD, 0, 0, 0.5);
        for (int s = 1; s <= 3; s++) {
            const double angle = 0.1 * s * (k % 2 ? 1 : -1), turn = 0.7 * k, r[2] = {0.55, 0.5};
            for (int i = 0; i < 2; i++) {
                const double from = angle - (i ? 0 : 0.1);
                rig_stage(&rig, 1);
                rig_change(&rig, CPS_END_B, CPS_END_KIND_HELD, r[i] * sin(from) * cos(turn),
                           r[i] * sin(from) * sin(turn), r[i] * cos(from));
            }
        }
        CpsError err = {0};
        CpsEvolution *evolution;
        CHECK_INT(cps_evolution_create(&rig.scene, &evolution, &err), CPS_OK);
        Worst worst = {0};
        Before before = {.known = false};
        int carried = 0;
        for (int s = 0; cps_evolution_remaining_count(evolution) > 0; s++) {
            CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
            const CpsLineReport report = cps_evolution_line_report(evolution, 0);
            const CpsLineView view = cps_evolution_line_view(evolution, 0);
            if (report.outcome != CPS_OUTCOME_SOLVED || s == 0) continue;
            carried += view.reaction[ELEMENTS] > 0;
            audit(&rig, &view, &report, &before, &worst);
        }
        check_worst(&worst, (uint64_t)k);
        CHECK_GREATER(carried, 1);
        cps_evolution_destroy(evolution);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(random_scenes),
                                       cmocka_unit_test(strict_contact),
                                       cmocka_unit_test(held_end_on_a_ball)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
