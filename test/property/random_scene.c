/* SPDX-License-Identifier: BSD-3-Clause */
/* The generator of random scenes. Sizes are spread over decades: lines of 1 to 1000 m, 0.1 N/m to
 * 10 kN/m, forces from a hundredth of the line's weight to five times it. Everything is laid out in
 * the frame of the plane (two tangents and the normal), so that a class only says what is special
 * about it. */
#include "random_scene_maker.h"
#include "splitmix.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- random numbers ---- */

double random_uniform(Random *random, double low, double high) {
    return splitmix(&random->state, low, high);
}

double random_decades(Random *random, double low, double high) {
    return pow(10, random_uniform(random, low, high));
}
int random_below(Random *random, int bound) { return (int)random_uniform(random, 0, bound); }
bool random_chance(Random *random, double probability) {
    return random_uniform(random, 0, 1) < probability;
}

/* ---- the frame of the plane ---- */

/* a plane through a random point, tilted by `tilt` towards a random side */
static Frame make_frame(Random *random, double tilt) {
    Frame frame;
    double turn = random_uniform(random, 0, 6.283), spin = random_uniform(random, 0, 6.283);
    double down[3] = {cos(turn) * cos(tilt), sin(turn) * cos(tilt), -sin(tilt)},
           across[3] = {-sin(turn), cos(turn), 0};
    double normal[3] = {cos(turn) * sin(tilt), sin(turn) * sin(tilt), cos(tilt)};
    for (int k = 0; k < 3; k++) {
        frame.origin[k] = random_chance(random, 0.5) ? 0 : random_uniform(random, -50, 50);
        frame.axis[0][k] = cos(spin) * down[k] + sin(spin) * across[k];
        frame.axis[1][k] = cos(spin) * across[k] - sin(spin) * down[k];
        frame.axis[2][k] = normal[k];
    }
    return frame;
}

void maker_direction(const Frame *frame, const double local[3], double scale, double out[3]) {
    for (int k = 0; k < 3; k++) {
        out[k] = 0;
        for (int a = 0; a < 3; a++) out[k] += scale * local[a] * frame->axis[a][k];
    }
}

void maker_place(const Frame *frame, const double local[3], double out[3]) {
    maker_direction(frame, local, 1, out);
    for (int k = 0; k < 3; k++) out[k] += frame->origin[k];
}

/* ---- a scene under construction ---- */

CpsLine *maker_line(Maker *maker) { return &maker->out->line[maker->out->scene.line_count - 1]; }

void maker_begin(Maker *maker, double tilt, double friction, bool obstacle) {
    RandomScene *out = maker->out;
    maker->frame = make_frame(&maker->random, tilt);
    maker->friction = friction;
    out->obstacle[0] = cps_obstacle_default();
    out->obstacle[0].name = "plane";
    out->obstacle[0].friction = friction;
    memcpy(out->obstacle[0].point, maker->frame.origin, sizeof out->obstacle[0].point);
    memcpy(out->obstacle[0].normal, maker->frame.axis[2], sizeof out->obstacle[0].normal);
    out->scene = cps_scene_default();
    out->scene.obstacle_count = obstacle;
    out->scene.obstacle = obstacle ? out->obstacle : NULL;
    out->scene.line = out->line;
    out->scene.stage = out->stage;
    out->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN; // of the classes before "consistent"
    out->expected = CPS_OUTCOME_SOLVED;
}

/* a new line without a start; `elements` 0: 5 to 60 */
void maker_begin_line(Maker *maker, int elements) {
    RandomScene *out = maker->out;
    Random *random = &maker->random;
    int i = out->scene.line_count++;
    CpsLine *line = &out->line[i];
    *line = cps_line_default();
    snprintf(out->line_name[i], sizeof out->line_name[i], "line%d", i);
    line->name = out->line_name[i];
    line->element_count = elements ? elements : 5 + random_below(random, SCENE_ELEMENTS - 4);
    line->length = maker->length = random_decades(random, 0, 3);
    line->weight = maker->weight = random_decades(random, -1, 4);
    line->start.point = out->point[i];
    maker->foot[0] = random_uniform(random, -1, 1) * maker->length;
    maker->foot[1] = random_uniform(random, -1, 1) * maker->length;
    maker->foot[2] = 0;
}

void maker_stiffness(Maker *maker, double ratio, double force) {
    double tension = fmax(force, 0.3 * maker->weight * maker->length);
    maker_line(maker)->stiffness = ratio * tension;
}

void maker_any_stiffness(Maker *maker) {
    bool rigid = random_chance(&maker->random, 0.3);
    maker_stiffness(maker, rigid ? INFINITY : random_decades(&maker->random, 1, 9), 0);
}

/* ---- start shapes ---- */

static void set_points(Maker *maker, CpsStartKind kind, int count, double local[][3]) {
    CpsStart *start = &maker_line(maker)->start;
    double *point = maker->out->point[maker->out->scene.line_count - 1];
    start->kind = kind;
    start->point_count = count;
    for (int i = 0; i < count; i++) maker_place(&maker->frame, local[i], &point[3 * i]);
}

/* from the foot along an angle in the plane and one above it */
static void start_straight(Maker *maker, double angle, double climb) {
    double local[2][3], along[3] = {cos(angle) * cos(climb), sin(angle) * cos(climb), sin(climb)};
    for (int k = 0; k < 3; k++) {
        local[0][k] = maker->foot[k];
        local[1][k] = maker->foot[k] + maker->length * along[k];
    }
    set_points(maker, CPS_START_STRAIGHT, 2, local);
}

/* random turns, scaled to the length; `rise` > 0 lifts corners off the plane */
static void start_polyline(Maker *maker, double rise) {
    Random *random = &maker->random;
    int count = 3 + random_below(random, SCENE_POINTS - 2);
    double local[SCENE_POINTS][3] = {{0}}, heading = random_uniform(random, 0, 6.283), sum = 0;
    for (int i = 1; i < count; i++) {
        heading += random_uniform(random, -1.5, 1.5);
        double step = random_uniform(random, 0.3, 1),
               height = rise > 0 ? random_uniform(random, 0, rise) : 0;
        local[i][0] = local[i - 1][0] + step * cos(heading);
        local[i][1] = local[i - 1][1] + step * sin(heading);
        local[i][2] = height;
        sum += hypot(step, local[i][2] - local[i - 1][2]);
    }
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++)
            local[i][k] = maker->foot[k] + local[i][k] * maker->length / sum;
    }
    set_points(maker, CPS_START_POLYLINE, count, local);
}

/* a circular arc in the plane; its elements must fit as chords */
static void start_arc(Maker *maker) {
    CpsLine *line = maker_line(maker);
    double most = fmin(6.2, 1.5 * line->element_count);
    double radius = maker->length / random_uniform(&maker->random, 0.3, most),
           angle = random_uniform(&maker->random, 0, 6.283);
    double local[2][3] = {{maker->foot[0], maker->foot[1], maker->foot[2]},
                          {maker->foot[0] + radius * cos(angle),
                           maker->foot[1] + radius * sin(angle), maker->foot[2]}};
    set_points(maker, CPS_START_ARC, 2, local);
    double turn[3] = {0, 0, random_chance(&maker->random, 0.5) ? 1 : -1};
    maker_direction(&maker->frame, turn, 1, line->start.axis);
}

static void start_any(Maker *maker) {
    Random *random = &maker->random;
    if (random_chance(random, 0.15))
        maker->foot[2] = random_uniform(random, 0, 0.3) * maker->length;
    double kind = random_uniform(random, 0, 1);
    if (kind < 0.35) {
        double climb = random_chance(random, 0.6) ? 0 : random_uniform(random, 0, 1.4);
        start_straight(maker, random_uniform(random, 0, 6.283), climb);
    } else if (kind < 0.7) {
        start_polyline(maker, random_chance(random, 0.5) ? 0 : random_uniform(random, 0.1, 0.8));
    } else {
        start_arc(maker);
    }
}

/* ---- history ---- */

void maker_stage(Maker *maker, int steps) {
    RandomScene *out = maker->out;
    int s = out->scene.stage_count++;
    snprintf(out->stage_name[s], sizeof out->stage_name[s], "s%d", s);
    out->stage[s] = (CpsStage){.cookie = cps_stage_default().cookie,
                               .name = out->stage_name[s],
                               .step_count = steps,
                               .change = out->change[s],
                               .turn = out->turn[s]};
}

void maker_change(Maker *maker, int end, CpsEndKind kind, const double value[3]) {
    RandomScene *out = maker->out;
    CpsStage *stage = &out->stage[out->scene.stage_count - 1];
    CpsChange *change = &out->change[out->scene.stage_count - 1][stage->change_count++];
    *change = (CpsChange){.line = out->scene.line_count - 1, .end = end, .to = {.kind = kind}};
    memcpy(change->to.value, value, sizeof change->to.value);
}

/* a force on end B, in any direction not deep into the plane; returns its size */
static double force_b(Maker *maker, double low, double high) {
    Random *random = &maker->random;
    double angle = random_uniform(random, 0, 6.283),
           climb = random_chance(random, 0.3) ? 0 : random_uniform(random, -0.2, 1.57);
    double local[3] = {cos(angle) * cos(climb), sin(angle) * cos(climb), sin(climb)}, value[3];
    double size = maker->weight * maker->length * random_decades(random, low, high);
    maker_direction(&maker->frame, local, size, value);
    maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
    return size;
}

/* end B to a place at most `reach` lengths from the foot, on or above the plane */
static void move_b(Maker *maker, double reach) {
    Random *random = &maker->random;
    double angle = random_uniform(random, 0, 6.283),
           distance = reach * maker->length * random_uniform(random, 0.1, 1);
    double climb = random_chance(random, 0.5) ? 0 : random_uniform(random, 0, 1.5), value[3];
    if (maker->foot[2] > 0) climb = random_uniform(random, 0, 1.5);
    double local[3] = {maker->foot[0] + distance * cos(angle) * cos(climb),
                       maker->foot[1] + distance * sin(angle) * cos(climb),
                       maker->foot[2] + distance * sin(climb)};
    maker_place(&maker->frame, local, value);
    maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
}

/* ---- classes ---- */

/* the common scene: a line on a mostly flat bed, pulled about at its free end */
double maker_common(Maker *maker, int elements) {
    Random *random = &maker->random;
    double friction = random_chance(random, 0.15) ? 0 : random_uniform(random, 0.01, 1),
           largest = 0;
    maker_begin(maker, random_chance(random, 0.7) ? 0 : random_uniform(random, 0, 0.6), friction,
                true);
    maker_begin_line(maker, elements);
    start_any(maker);
    int stages = 1 + random_below(random, 4);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 1 + random_below(random, 2));
        if (random_chance(random, 0.85)) {
            largest = fmax(largest, force_b(maker, -2, 0.7));
        } else {
            move_b(maker, 0.97);
        }
    }
    return largest;
}

static void make_slope(Maker *maker) {
    Random *random = &maker->random;
    double friction = random_uniform(random, 0.05, 1.2),
           tilt = atan(friction) * random_uniform(random, 0.3, 1.7);
    maker_begin(maker, fmin(tilt, 1.4), friction, true);
    maker_begin_line(maker, 0);
    start_any(maker);
    maker_stage(maker, 1);
    if (random_chance(random, 0.5)) force_b(maker, -3, 0.3);
    maker_stage(maker, 1 + random_below(random, 3));
    force_b(maker, -2, 0.5);
    maker_any_stiffness(maker);
}

/* an end pushed back: only a part of the line moves, the rest rests without tension */
static void make_slack(Maker *maker) {
    Random *random = &maker->random;
    const double friction = random_uniform(random, 0.25, 1);
    maker_begin(maker, random_chance(random, 0.6) ? 0 : random_uniform(random, 0, 0.2), friction,
                true);
    maker_begin_line(maker, 0);
    double angle = random_uniform(random, 0, 6.283), back = random_uniform(random, 0.02, 0.7),
           value[3];
    start_straight(maker, angle, 0);
    maker_stage(maker, 1 + random_below(random, 3));
    if (random_chance(random, 0.5)) {
        double at = maker->length * (1 - back);
        double local[3] = {maker->foot[0] + at * cos(angle), maker->foot[1] + at * sin(angle), 0};
        maker_place(&maker->frame, local, value);
        maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
    } else {
        double local[3] = {-cos(angle), -sin(angle), 0};
        maker_direction(&maker->frame, local,
                        back * maker->friction * maker->weight * maker->length, value);
        maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
    }
    if (random_chance(random, 0.5)) {
        maker_stage(maker, 1);
        force_b(maker, -2, 0);
    }
    maker_any_stiffness(maker);
}

/* pulled and let go without friction, shortened between its ends, dropped, or never pulled */
static void make_fully_slack(Maker *maker) {
    Random *random = &maker->random;
    const double none[3] = {0, 0, 0};
    int kind = random_below(random, 4);
    maker_begin(maker, 0, kind == 0 || kind == 1 ? 0 : random_uniform(random, 0, 1), true);
    maker_begin_line(maker, 0);
    if (kind == 2) {
        double climb = random_uniform(random, 0.1, 1.2);
        start_straight(maker, random_uniform(random, 0, 6.283), climb);
    } else if (kind == 1) {
        start_polyline(maker, 0);
    } else {
        start_any(maker);
    }
    maker_stage(maker, 1);
    if (kind == 0) {
        force_b(maker, -2, 0.3);
        maker_stage(maker, 1 + random_below(random, 2));
    }
    if (kind == 1) {
        double local[3] = {maker->foot[0] + 0.2 * maker->length, maker->foot[1], 0}, value[3];
        maker_place(&maker->frame, local, value);
        maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
    } else {
        maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, none);
    }
    maker_any_stiffness(maker);
}

static void make_long_history(Maker *maker) {
    Random *random = &maker->random;
    int stages = random_below(random, 2) ? 20 : 4;
    const double friction = random_uniform(random, 0, 1);
    maker_begin(maker, random_chance(random, 0.7) ? 0 : random_uniform(random, 0, 0.4), friction,
                true);
    maker_begin_line(maker, 0);
    start_any(maker);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 20 / stages);
        if (random_chance(random, 0.7)) {
            force_b(maker, -1.5, 0.3);
        } else {
            move_b(maker, 0.97);
        }
    }
    maker_any_stiffness(maker);
}

/* both ends held and moved, from a bent shape or laid by statics; sometimes let go */
static void make_imposed(Maker *maker) {
    Random *random = &maker->random;
    const double friction = random_uniform(random, 0, 1);
    maker_begin(maker, random_chance(random, 0.7) ? 0 : random_uniform(random, 0, 0.5), friction,
                true);
    maker_begin_line(maker, 0);
    CpsLine *line = maker_line(maker);
    line->end[CPS_END_B] = line->end[CPS_END_A]; // held where the start puts it
    if (random_chance(random, 0.5)) {
        start_polyline(maker, random_chance(random, 0.5) ? 0 : 0.5);
    } else {
        double along = random_uniform(random, 0.2, 0.8) * maker->length,
               up = random_uniform(random, 0, 0.5) * maker->length,
               local[3] = {maker->foot[0] + along, maker->foot[1], up};
        line->start.kind = CPS_START_STATIC;
        line->end[CPS_END_A].kind = line->end[CPS_END_B].kind = CPS_END_KIND_HELD;
        maker_place(&maker->frame, maker->foot, line->end[CPS_END_A].value);
        maker_place(&maker->frame, local, line->end[CPS_END_B].value);
    }
    int stages = 1 + random_below(random, 4);
    for (int s = 0; s < stages; s++) {
        maker_stage(maker, 1 + random_below(random, 3));
        if (random_chance(random, 0.85)) {
            move_b(maker, 0.99);
        } else {
            force_b(maker, -1, 0.3);
        }
    }
    maker_any_stiffness(maker);
}

/* inextensible, end B brought to length * (1 + excess) from A, from a straight or a bent start */
static void make_stretched(Maker *maker, double excess, bool obstacle) {
    Random *random = &maker->random;
    const double friction = random_uniform(random, 0, 1);
    maker_begin(maker, random_chance(random, 0.6) ? 0 : random_uniform(random, 0, 0.5), friction,
                obstacle);
    maker_begin_line(maker, 0);
    CpsLine *line = maker_line(maker);
    line->end[CPS_END_B] = line->end[CPS_END_A];
    double angle = random_uniform(random, 0, 6.283),
           climb = random_chance(random, 0.4) ? 0 : random_uniform(random, 0, 1.3), value[3];
    if (random_chance(random, 0.5)) {
        start_straight(maker, angle, climb);
    } else {
        start_polyline(maker, random_chance(random, 0.5) ? 0 : 0.5);
    }
    double at = maker->length * (1 + excess);
    double local[3] = {maker->foot[0] + at * cos(angle) * cos(climb),
                       maker->foot[1] + at * sin(angle) * cos(climb),
                       maker->foot[2] + at * sin(climb)};
    maker_place(&maker->frame, local, value);
    maker_stage(maker, 1);
    maker_change(maker, CPS_END_B, CPS_END_KIND_HELD, value);
}

static void make_graded(Maker *maker) {
    Random *random = &maker->random;
    maker_common(maker, 0);
    maker_any_stiffness(maker);
    CpsLine *line = maker_line(maker);
    double *l = maker->out->element_length[0], sum = 0, range = random_uniform(random, 2, 4);
    bool smooth = random_chance(random, 0.6);
    for (int i = 0; i < line->element_count; i++) {
        l[i] = pow(10, smooth ? range * i / (line->element_count - 1)
                              : random_uniform(random, 0, range));
        sum += l[i];
    }
    for (int i = 0; i < line->element_count; i++) l[i] *= line->length / sum;
    line->element_length = l;
    if (line->start.kind == CPS_START_ARC)
        start_polyline(maker, 0); // one long chord would not fit an arc
}

static void make_several(Maker *maker) {
    Random *random = &maker->random;
    int lines = 2 + random_below(random, SCENE_LINES - 1);
    const double friction = random_uniform(random, 0, 1);
    maker_begin(maker, random_chance(random, 0.7) ? 0 : random_uniform(random, 0, 0.5), friction,
                true);
    int stages = 1 + random_below(random, 3);
    for (int i = 0; i < lines; i++) {
        maker_begin_line(maker, 0);
        start_any(maker);
        maker_any_stiffness(maker);
        for (int s = 0; s < stages; s++) {
            if (i == 0) maker_stage(maker, 1 + random_below(random, 2));
            maker->out->scene.stage_count = s + 1;
            if (random_chance(random, 0.8)) force_b(maker, -2, 0.5);
        }
    }
}

static void make_hanging(Maker *maker) {
    Random *random = &maker->random;
    maker_begin(maker, 0, 0, false);
    maker_begin_line(maker, 0);
    CpsLine *line = maker_line(maker);
    if (random_chance(random, 0.5)) {
        line->end[CPS_END_B] = line->end[CPS_END_A];
        start_polyline(maker, 0.5);
        if (random_chance(random, 0.4)) {
            line->start.kind = CPS_START_STATIC;
            line->end[CPS_END_A].kind = line->end[CPS_END_B].kind = CPS_END_KIND_HELD;
            memcpy(line->end[CPS_END_A].value, &line->start.point[0], sizeof line->end[0].value);
            memcpy(line->end[CPS_END_B].value, &line->start.point[3], sizeof line->end[0].value);
            line->start.point_count = 0;
        }
        maker_stage(maker, 1);
        if (random_chance(random, 0.5)) {
            maker_stage(maker, 2);
            move_b(maker, 0.99);
        }
    } else {
        start_any(maker);
        maker_stage(maker, 1);
        force_b(maker, -2, 0.7);
    }
    maker_any_stiffness(maker);
}

/* both ends free: dragged by more than the friction, lifted by more than the weight, on too steep a
 * slope, or falling
 */
static void make_unbounded(Maker *maker) {
    Random *random = &maker->random;
    int kind = random_below(random, 4);
    double friction = random_uniform(random, 0, 0.8), beyond = 1 + random_decades(random, -2, 0.5),
           value[3];
    maker_begin(maker, kind == 2 ? fmin(atan(friction * beyond) + 1e-3, 1.5) : 0, friction,
                kind != 3);
    maker_begin_line(maker, 0);
    CpsLine *line = maker_line(maker);
    line->end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    start_straight(maker, random_uniform(random, 0, 6.283), 0);
    maker_stage(maker, 1);
    double total = maker->weight * maker->length,
           pull = kind == 0 ? fmax(friction, 0.01) * total : total;
    double angle = random_uniform(random, 0, 6.283), local[3] = {cos(angle), sin(angle), 0};
    if (kind == 1) {
        local[0] = local[1] = 0;
        local[2] = 1;
    }
    maker_direction(&maker->frame, local, kind < 2 ? beyond * pull : 0, value);
    maker_change(maker, CPS_END_B, CPS_END_KIND_FREE, value);
    maker_any_stiffness(maker);
    maker->out->expected = CPS_OUTCOME_UNBOUNDED;
}

/* ---- the table ---- */

const char *random_scene_class_name(int class_index) {
    static const char *const NAME[SCENE_CLASSES] = {"ea_0",
                                                    "ea_1",
                                                    "ea_2",
                                                    "ea_3",
                                                    "ea_4",
                                                    "ea_5",
                                                    "ea_6",
                                                    "ea_7",
                                                    "ea_8",
                                                    "ea_9",
                                                    "ea_10",
                                                    "ea_11",
#define SCENE_CLASS_TEXT(name, text) text,
                                                    SCENE_CLASS_LIST(SCENE_CLASS_TEXT)
#undef SCENE_CLASS_TEXT
    };
    return NAME[class_index];
}

/* a scene of another class with Coulomb's law itself, from the stiffest of its kind down to soft
 * lines */
static void make_consistent(Maker *maker) {
    switch (random_below(&maker->random, 4)) {
    case 0: make_slope(maker); break;
    case 1: make_imposed(maker); break;
    case 2: make_long_history(maker); break;
    default:
        maker_common(maker, 0);
        maker_any_stiffness(maker);
        break;
    }
    maker->out->scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
}

/* A scene of another class, whose lines are made of sections and carry weights. */
static void make_sections(Maker *maker, bool tables) {
    switch (random_below(&maker->random, 6)) {
    case 0: make_imposed(maker); break;
    case 1: make_graded(maker); break;
    case 2: make_several(maker); break;
    case 3: make_hanging(maker); break;
    case 4: random_scene_curved(SCENE_PIPE, maker); break;
    default:
        maker_common(maker, 0);
        maker_any_stiffness(maker);
        break;
    }
    random_scene_add_sections(maker);
    if (tables) random_scene_add_tables(maker);
}

void random_scene_make(int class_index, uint64_t seed, RandomScene *out) {
    *out = (RandomScene){0};
    Maker maker = {.random = {seed * 0x2545f4914f6cdd1du + (uint64_t)class_index}, .out = out};
    Random *random = &maker.random;
    random_uniform(random, 0, 1); // neighbouring seeds part here
    switch (class_index) {
    case SCENE_INEXTENSIBLE: maker_common(&maker, 0); break;
    case SCENE_SLOPE: make_slope(&maker); break;
    case SCENE_SLACK: make_slack(&maker); break;
    case SCENE_FULLY_SLACK: make_fully_slack(&maker); break;
    case SCENE_LONG_HISTORY: make_long_history(&maker); break;
    case SCENE_IMPOSED: make_imposed(&maker); break;
    case SCENE_NEAR_FULL: {
        const bool obstacle = random_chance(random, 0.6);
        make_stretched(&maker, -random_decades(random, -9, -3), obstacle);
        break;
    }
    case SCENE_GRADED: make_graded(&maker); break;
    case SCENE_FEW:
        maker_common(&maker, 1 + random_below(random, 3));
        maker_any_stiffness(&maker);
        break;
    case SCENE_SEVERAL: make_several(&maker); break;
    case SCENE_HANGING: make_hanging(&maker); break;
    case SCENE_INFEASIBLE: {
        const bool obstacle = random_chance(random, 0.6);
        make_stretched(&maker, random_decades(random, -9, 0), obstacle);
        out->expected = CPS_OUTCOME_INFEASIBLE;
        break;
    }
    case SCENE_UNBOUNDED: make_unbounded(&maker); break;
    case SCENE_TAUT:
        make_stretched(&maker, 0, random_chance(random, 0.6));
        out->expected = CPS_OUTCOME_TAUT;
        break;
    case SCENE_CONSISTENT: make_consistent(&maker); break;
    case SCENE_SECTIONS:
    case SCENE_TABLES: make_sections(&maker, class_index == SCENE_TABLES); break;
    case SCENE_CYLINDER:
    case SCENE_PIPE:
    case SCENE_SPHERE:
    case SCENE_TWO:
    case SCENE_DRUM:
    case SCENE_ELLIPSE:
    case SCENE_BOX:
    case SCENE_GRAIN:
    case SCENE_WINCH:
    case SCENE_WILD: random_scene_curved(class_index, &maker); break;
    default: { // ea_k
        double force = maker_common(&maker, 0);
        maker_stiffness(&maker, random_decades(random, class_index, class_index + 1), force);
    }
    }
}

RandomSceneRange random_scene_range(int argc, char **argv) {
    RandomSceneRange range = {.count = 200, .seed = 1};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--scenes")) range.count = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) range.seed = strtoull(argv[i + 1], NULL, 10);
    }
    return range;
}
