/* SPDX-License-Identifier: BSD-3-Clause */
/* Random scenes on cylinders, balls and two obstacles at once, on drums that turn, and on planes
 * whose friction has directions, all with consistent friction. Angles of wrap and coefficients are
 * moderate, mu theta up to about 2, and no scene asks for what cannot be: forces pull outwards, and
 * lines are longer than the path over the obstacle. */
#include <math.h>
#include <string.h>

#include "random_scene_maker.h"

static double least(double a, double b) { return a < b ? a : b; }

/* The plane of the maker becomes a cylinder or a ball of some radius around `local`, in the
 * frame. */
static void set_round(Maker *maker, CpsObstacle *obstacle, CpsObstacleKind kind,
                      const double local[3], int axis, double radius) {
    *obstacle = cps_obstacle_default();
    obstacle->name = obstacle == maker->out->obstacle ? "round" : "second";
    obstacle->kind = kind;
    obstacle->friction = maker->friction;
    obstacle->radius = radius;
    maker_place(&maker->frame, local, obstacle->point);
    memcpy(obstacle->axis, maker->frame.axis[axis], sizeof obstacle->axis);
}

/* Axial and lateral coefficients, as an ellipse or a box. */
static void set_directions(Maker *maker, CpsObstacle *obstacle, bool box, bool grain) {
    Random *random = &maker->random;
    obstacle->friction = fmax(obstacle->friction, 0.02);
    obstacle->has_friction_lateral = true;
    obstacle->friction_lateral = obstacle->friction * random_uniform(random, 0.3, 2);
    obstacle->friction_shape = box ? CPS_FRICTION_SHAPE_BOX : CPS_FRICTION_SHAPE_ELLIPSE;
    const double angle = random_uniform(random, 0, 6.283), local[3] = {cos(angle), sin(angle), 0};
    if (grain) maker_direction(&maker->frame, local, 1, obstacle->grain);
}

/* ---- a line wound on a cylinder or along a circle of a ball ---- */

/* An arc in the plane of two axes of the frame, around the origin. */
typedef struct Arc {
    int first, second,
        axis; /* of the frame: where the arc begins, where it goes, what it turns about */
    double radius, angle;
} Arc;

/* a vector of the arc's plane, `turned` from its first axis, plus a part along its axis */
static void in_arc(const Maker *maker, const Arc *arc, double turned, double size, double aside,
                   double out[3]) {
    double local[3] = {0, 0, 0};
    local[arc->first] = size * cos(turned);
    local[arc->second] = size * sin(turned);
    local[arc->axis] = aside;
    maker_direction(&maker->frame, local, 1, out);
}

static void start_on(Maker *maker, const Arc *arc) {
    CpsLine *line = maker_line(maker);
    double *point = maker->out->point[0], local[3] = {0, 0, 0}, first[3], second[3];
    maker_place(&maker->frame, local, &point[3]);
    local[arc->first] = arc->radius;
    maker_place(&maker->frame, local, &point[0]);
    line->start.kind = CPS_START_ARC;
    line->start.point_count = 2;
    memcpy(first, maker->frame.axis[arc->first], sizeof first);
    memcpy(second, maker->frame.axis[arc->second], sizeof second);
    for (int k = 0; k < 3; k++)
        line->start.axis[k] =
            first[(k + 1) % 3] * second[(k + 2) % 3] - first[(k + 2) % 3] * second[(k + 1) % 3];
}

/* the line along the arc, every chord as long as its element, and light beside a tension T */
static double wind(Maker *maker, Arc *arc) {
    Random *random = &maker->random;
    maker_begin_line(maker, 10 + random_below(random, SCENE_ELEMENTS - 9));
    CpsLine *line = maker_line(maker);
    const double chord = 2 * arc->radius * sin(0.5 * arc->angle / line->element_count);
    line->length = maker->length = line->element_count * chord;
    const double tension = random_decades(random, 0, 4);
    line->weight = maker->weight =
        random_chance(random, 0.3) ? 0 : tension / arc->radius * random_decades(random, -4, -1.5);
    line->stiffness =
        random_chance(random, 0.3) ? INFINITY : tension * random_decades(random, 1.5, 7);
    start_on(maker, arc);
    return tension;
}

/* end B pulled along its tangent, a little outwards and aside */
static void pull_b(Maker *maker, const Arc *arc, double size, double aside) {
    Random *random = &maker->random;
    const double outwards = random_chance(random, 0.5) ? 0 : random_uniform(random, 0, 0.3);
    double value[3];
    in_arc(maker, arc, arc->angle + 1.5707963 - outwards, size,
           size * random_uniform(random, -aside, aside), value);
    maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
}

/* a standing or a lying cylinder, or a ball, and an arc on it; mu theta up to 2 */
static Arc begin_round(Maker *maker, CpsObstacleKind kind) {
    Random *random = &maker->random;
    const double friction = random_chance(random, 0.1) ? 0 : random_uniform(random, 0.03, 0.7);
    const bool standing = random_chance(random, 0.5), ball = kind == CPS_OBSTACLE_SPHERE;
    maker_begin(maker, 0, friction, true);
    const double most = ball ? 2 : least(5.5, 2 / (friction + 1e-3)), centre[3] = {0, 0, 0};
    Arc arc = {.first = 0, .second = standing ? 1 : 2, .axis = standing ? 2 : 1};
    arc.angle = random_uniform(random, 0.3, most);
    arc.radius = random_decades(random, -1, 1);
    set_round(maker, &maker->out->obstacle[0], kind, centre, arc.axis, arc.radius);
    if (random_chance(random, 0.3))
        set_directions(maker, &maker->out->obstacle[0], random_chance(random, 0.5), false);
    return arc;
}

static void make_wound(Maker *maker, CpsObstacleKind kind) {
    Random *random = &maker->random;
    Arc arc = begin_round(maker, kind);
    const double tension = wind(maker, &arc);
    const int stages = 1 + random_below(random, 4);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 1 + random_below(random, 4));
        pull_b(maker, &arc, tension * random_decades(random, -1, 0),
               kind == CPS_OBSTACLE_SPHERE ? least(0.03, 0.3 * maker->friction) : 0.1);
    }
}

/* The angle by which a drum may carry along the end that a hand holds: the hand pulls in its
 * direction, so that its pull along the drum falls by the cosine, which must cost less than the
 * ratio exp(mu angle/6) of the wrap. */
static double most_carried(double mu, double angle) { return acos(exp(-mu * angle / 6)); }

/* A load at B, and at A a hook or a hand that holds within the capstan ratio; then the drum turns
 * to and fro, by so little that a line without hook stays wound far enough. */
static void make_drum(Maker *maker, bool hand) {
    Random *random = &maker->random;
    Arc arc = begin_round(maker, CPS_OBSTACLE_CYLINDER);
    CpsObstacle *drum = &maker->out->obstacle[0];
    const double tension = wind(maker, &arc), mu = fmax(drum->friction, 0.05);
    CpsLine *line = maker_line(maker);
    if (hand) {
        drum->friction = mu;
        line->end[CPS_END_A].kind = CPS_END_KIND_FREE;
        const double hold = tension * exp(-random_uniform(random, 0.2, 0.6) * mu * arc.angle);
        in_arc(maker, &arc, -1.5707963, hold, 0, line->end[CPS_END_A].value);
        line->weight = maker->weight = 0;
    }
    maker_stage(maker, hand ? 1 : 1 + random_below(random, 3));
    double value[3];
    in_arc(maker, &arc, arc.angle + 1.5707963, tension, 0, value);
    maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
    const int stages = 1 + random_below(random, 3);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 1 + random_below(random, 4));
        CpsStage *stage = &maker->out->stage[maker->out->scene.stage_count - 1];
        const double most =
            hand ? least(0.07 * arc.angle, most_carried(mu, arc.angle) / stages) : 0.3;
        maker->out->turn[maker->out->scene.stage_count - 1][0] =
            (CpsTurn){0, random_uniform(random, -most, most)};
        stage->turn_count = 1;
    }
}

/* ---- a line laid over a pipe ---- */

/* The shortest path from (a, h) over the top of a circle of radius r around 0 to (b, k); a < 0 <
 * b. */
static double path_over(double r, double a, double h, double b, double k) {
    const double d1 = hypot(a, h), d2 = hypot(b, k);
    const double between = atan2(h, -a) + acos(r / d1) + atan2(k, b) +
                           acos(r / d2); /* angles above the horizontal and of the tangents */
    const double wrapped = 3.14159265358979 - between;
    if (!(wrapped > 0)) return hypot(b - a, k - h);
    return sqrt(d1 * d1 - r * r) + r * wrapped + sqrt(d2 * d2 - r * r);
}

/* Both ends beside the pipe, at first so high that the straight line passes above its axis; then B
 * goes lower and aside. */
static void make_pipe(Maker *maker) {
    Random *random = &maker->random;
    maker_begin(maker, 0, random_uniform(random, 0.03, 0.7), true);
    const double r = random_decades(random, -0.5, 0.5), none[3] = {0, 0, 0};
    set_round(maker, &maker->out->obstacle[0], CPS_OBSTACLE_CYLINDER, none, 1, r);
    if (random_chance(random, 0.3))
        set_directions(maker, &maker->out->obstacle[0], random_chance(random, 0.5), false);
    maker_begin_line(maker, 10 + random_below(random, SCENE_ELEMENTS - 9));
    CpsLine *line = maker_line(maker);
    line->start.kind = CPS_START_STATIC;
    line->end[CPS_END_B] = line->end[CPS_END_A];
    double a[3] = {-r * random_uniform(random, 1.3, 4)};
    a[2] = r * random_uniform(random, 0.1, 0.6);
    double b[3] = {r * random_uniform(random, 1.3, 4)};
    b[2] = r * random_uniform(random, 0.1, 0.6);
    line->end[CPS_END_A].kind = line->end[CPS_END_B].kind = CPS_END_KIND_HELD;
    maker_place(&maker->frame, a, line->end[CPS_END_A].value);
    maker_place(&maker->frame, b, line->end[CPS_END_B].value);
    double longest = path_over(r, a[0], a[2], b[0], b[2]);
    const int stages = 1 + random_below(random, 3);
    for (int s = 0; s < stages; s++) {
        double to[3] = {r * random_uniform(random, 1.3, 4)}, value[3];
        to[1] = r * random_uniform(random, -0.5, 0.5);
        to[2] = r * random_uniform(random, -2, 0.6);
        longest = fmax(longest, hypot(to[1], path_over(r, a[0], a[2], to[0], to[2])));
        maker_place(&maker->frame, to, value);
        maker_stage(maker, 2 + random_below(random, 6));
        maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
    }
    line->length = maker->length = longest * (1 + random_decades(random, -2, -0.5));
    maker_stiffness(maker, random_decades(random, 1, 6), 0);
}

/* ---- two obstacles ---- */

/* A bed, and a pipe or ball partly buried in it: the line, hardly longer than the path over it,
 * lies on both. */
static void make_two(Maker *maker) {
    Random *random = &maker->random;
    maker_begin(maker, 0, random_uniform(random, 0.05, 0.8), true);
    const double r = random_decades(random, -0.3, 0.5),
                 buried = r * random_uniform(random, 0.1, 0.6);
    const double at[3] = {0, 0, -buried};
    const bool ball = random_chance(random, 0.3);
    set_round(maker, &maker->out->obstacle[1], ball ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER,
              at, 1, r);
    maker->out->obstacle[1].friction = random_uniform(random, 0.05, 0.8);
    maker->out->scene.obstacle_count = 2;
    maker_begin_line(maker, 20 + random_below(random, SCENE_ELEMENTS - 19));
    CpsLine *line = maker_line(maker);
    line->start.kind = CPS_START_STATIC;
    line->end[CPS_END_B] = line->end[CPS_END_A];
    const double a[3] = {-r * random_uniform(random, 2, 6), 0, 0};
    double b[3] = {r * random_uniform(random, 2, 6)};
    b[2] = r * random_uniform(random, 0, 1.5);
    line->end[CPS_END_A].kind = line->end[CPS_END_B].kind = CPS_END_KIND_HELD;
    maker_place(&maker->frame, a, line->end[CPS_END_A].value);
    maker_place(&maker->frame, b, line->end[CPS_END_B].value);
    double longest = path_over(r, a[0], buried, b[0], b[2] + buried);
    const int stages = 1 + random_below(random, 3);
    for (int s = 0; s < stages; s++) {
        const double away = ball ? 0 : r * random_uniform(random, -0.3, 0.3);
        double to[3] = {b[0] + r * random_uniform(random, -0.1, 0.3), away}, value[3];
        to[2] = r * random_uniform(random, 0, 1.5);
        longest = fmax(longest, hypot(path_over(r, a[0], buried, to[0], to[2] + buried), to[1]));
        maker_place(&maker->frame, to, value);
        maker_stage(maker, 2 + random_below(random, 6));
        maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
    }
    line->length = maker->length = longest * (1 + random_decades(random, -4, -2));
    maker_stiffness(maker, random_decades(random, 1, 6), 0);
}

/* ---- friction with directions on a plane ---- */

/* Any scene on a plane, however large its steps. */
static void make_wild(Maker *maker, bool box, bool grain) {
    maker_common(maker, 0);
    maker_any_stiffness(maker);
    set_directions(maker, &maker->out->obstacle[0], box, grain);
}

/* Along an arc, pulled at B within a third of a right angle of its tangent, in a few steps. */
static void make_directions(Maker *maker, bool box) {
    Random *random = &maker->random;
    const double friction = random_uniform(random, 0.1, 0.8);
    maker_begin(maker, random_chance(random, 0.7) ? 0 : random_uniform(random, 0, 0.2), friction,
                true);
    maker_begin_line(maker, 10 + random_below(random, SCENE_ELEMENTS - 9));
    maker_any_stiffness(maker);
    CpsLine *line = maker_line(maker);
    Arc arc = {.first = 0, .second = 1, .axis = 2, .angle = random_uniform(random, 0.05, 2)};
    arc.radius =
        line->length / (2 * line->element_count * sin(0.5 * arc.angle / line->element_count));
    start_on(maker, &arc);
    const int stages = 1 + random_below(random, 4);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 2 + random_below(random, 4));
        const double size = line->weight * line->length * random_decades(random, -1.5, 0.3);
        double value[3];
        in_arc(maker, &arc, arc.angle + 1.5707963 + random_uniform(random, -0.5, 0.5), size, 0,
               value);
        maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
    }
    set_directions(maker, &maker->out->obstacle[0], box, false);
}

void random_scene_curved(int class_index, Maker *maker) {
    switch (class_index) {
    case SCENE_CYLINDER: make_wound(maker, CPS_OBSTACLE_CYLINDER); break;
    case SCENE_SPHERE: make_wound(maker, CPS_OBSTACLE_SPHERE); break;
    case SCENE_PIPE: make_pipe(maker); break;
    case SCENE_TWO: make_two(maker); break;
    case SCENE_DRUM: make_drum(maker, false); break;
    case SCENE_WINCH: make_drum(maker, true); break;
    case SCENE_ELLIPSE: make_directions(maker, false); break;
    case SCENE_BOX: make_directions(maker, true); break;
    case SCENE_GRAIN: make_wild(maker, random_chance(&maker->random, 0.5), true); break;
    default: make_wild(maker, random_chance(&maker->random, 0.5), false); break; // wild
    }
    maker->out->scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
}
