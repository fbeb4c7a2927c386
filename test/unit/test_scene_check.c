/* SPDX-License-Identifier: BSD-3-Clause */
/* cps_scene_check through the C interface, and the nodes of the start shapes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"

#include "capstan/scene.h"
#include "evolve/start.h"

/* A straight line of 10 m on a bed, pulled at B in one stage; the parts are the caller's to
 * change. */
typedef struct Parts {
    double point[9];
    CpsObstacle obstacle;
    CpsLine line;
    CpsChange change;
    CpsStage stage;
    CpsScene scene;
} Parts;

static void make(Parts *p) {
    *p = (Parts){.point = {0, 0, 0, 10, 0, 0}};
    p->obstacle = cps_obstacle_default();
    p->obstacle.name = "bed";
    p->line = cps_line_default();
    p->line.name = "cable";
    p->line.length = 10;
    p->line.element_count = 4;
    p->line.weight = 5;
    p->line.stiffness = 1e6;
    p->line.start.point_count = 2;
    p->line.start.point = p->point;
    p->change = (CpsChange){.line = 0, .end = CPS_END_B, .to = {CPS_END_KIND_FREE, {1, 0, 0}}};
    p->stage = (CpsStage){.cookie = cps_stage_default().cookie,
                          .name = "pull",
                          .step_count = 3,
                          .change_count = 1,
                          .change = &p->change};
    p->scene = cps_scene_default();
    p->scene.obstacle_count = 1;
    p->scene.obstacle = &p->obstacle;
    p->scene.line_count = 1;
    p->scene.line = &p->line;
    p->scene.stage_count = 1;
    p->scene.stage = &p->stage;
}

static void refused(const Parts *p, const char *fragment) {
    CpsError err = {0};
    const CpsStatus status = cps_scene_check(&p->scene, &err);
    if (status != CPS_ERR_ARGUMENT || err.status != status || !strstr(err.message, fragment)) {
        print_error("expected a refusal with '%s', found status %d: %s\n", fragment, (int)status,
                    err.message);
        fail();
    }
    assert_int_equal(cps_scene_check(&p->scene, NULL), status);
}

/* A good scene of two lines and two obstacles. */
typedef struct Whole {
    Parts p;
    CpsLine line[2];
    CpsObstacle obstacle[2];
    CpsFrictionZone zone;
    CpsTurn turn[2];
    CpsChange change[2];
    double length[4];
} Whole;

static void make_whole(Whole *w) {
    static const double PLACE[6] = {0, 1, 0, 10, 1, 0};
    make(&w->p);
    w->zone = (CpsFrictionZone){0, 1, 0.5};
    for (int i = 0; i < 4; i++) w->length[i] = 2.5;
    w->line[0] = w->line[1] = w->p.line;
    w->line[0].start.point = w->p.point;
    w->line[0].zone = &w->zone;
    w->line[0].zone_count = 1;
    w->line[0].element_length = w->length;
    w->line[1].name = "other";
    w->line[1].start.point = PLACE;
    w->obstacle[0] = w->obstacle[1] = w->p.obstacle;
    w->obstacle[1].name = "drum";
    w->obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
    w->obstacle[1].radius = 1;
    w->obstacle[1].point[2] = -5;
    w->turn[0] = w->turn[1] = (CpsTurn){.obstacle = 1, .angle = 1};
    w->change[0] = w->change[1] = w->p.change;
    w->change[1].line = 1;
    w->p.scene.line = w->line;
    w->p.scene.line_count = 2;
    w->p.scene.obstacle = w->obstacle;
    w->p.scene.obstacle_count = 2;
    w->p.stage.turn = w->turn;
    w->p.stage.turn_count = 1;
    w->p.stage.change = w->change;
    w->p.stage.change_count = 2;
}

/* The statements make it bad. */
#define BAD(...)           \
    do {                   \
        make_whole(&w);    \
        __VA_ARGS__;       \
        refused(&w.p, ""); \
    } while (0)

static void refuses_each_wrong_count_and_kind(void **state) {
    (void)state;
    Whole w;
    make_whole(&w);
    assert_int_equal(cps_scene_check(&w.p.scene, NULL), CPS_OK);
    /* what there is how many of */
    BAD(w.p.scene.obstacle_count = -1);
    BAD(w.p.scene.obstacle = NULL);
    BAD(w.p.scene.line_count = 0);
    BAD(w.p.scene.line = NULL);
    BAD(w.p.scene.stage_count = -1);
    BAD(w.p.scene.stage = NULL);
    BAD(w.p.stage.change_count = -1);
    BAD(w.p.stage.change = NULL);
    BAD(w.p.stage.turn_count = -1);
    BAD(w.p.stage.turn = NULL);
    BAD(w.line[0].zone_count = -1);
    BAD(w.line[0].zone = NULL);
    BAD(w.line[0].start.point = NULL);
    BAD(w.line[0].start.point_count = 3);
    BAD(w.line[0].start.kind = CPS_START_POLYLINE; w.line[0].start.point_count = 1);
    /* what has been begun as nothing */
    BAD(w.p.scene.cookie = 0);
    BAD(w.line[1].cookie = 0);
    BAD(w.obstacle[1].cookie = 0);
    /* unknown kinds */
    BAD(w.obstacle[0].kind = (CpsObstacleKind)-1);
    BAD(w.obstacle[0].kind = 99);
    BAD(w.line[0].start.kind = (CpsStartKind)-1);
    BAD(w.line[0].start.kind = 99);
    BAD(w.line[0].end[0].kind = 99);
    BAD(w.change[0].to.kind = 99);
    BAD(w.change[0].end = 2);
    BAD(w.p.scene.solver.linear_system = 99);
    BAD(w.p.scene.friction_policy = 99);
    BAD(w.p.scene.contact_policy = 99);
}

static void refuses_each_wrong_name_and_number(void **state) {
    (void)state;
    Whole w;
    make_whole(&w);
    assert_int_equal(cps_scene_check(&w.p.scene, NULL), CPS_OK);
    /* names */
    BAD(w.obstacle[1].name = NULL);
    BAD(w.obstacle[1].name = "");
    BAD(w.obstacle[1].name = "bed");
    BAD(w.line[1].name = "cable");
    BAD(w.line[1].name = "a name that is far longer than the sixty-four characters it may have");
    BAD(w.p.stage.name = NULL);
    BAD(w.p.stage.name = "");
    /* indices */
    BAD(w.change[0].line = -1);
    BAD(w.change[0].line = 2);
    BAD(w.change[1] = w.change[0]);
    BAD(w.turn[0].obstacle = -1);
    BAD(w.turn[0].obstacle = 2);
    BAD(w.turn[0].obstacle = 0);
    BAD(w.p.stage.turn_count = 2);
    /* numbers */
    BAD(w.length[2] = 0);
    BAD(w.length[2] = NAN);
    BAD(w.obstacle[1].kind = CPS_OBSTACLE_SPHERE; w.obstacle[1].radius = 0);
    BAD(w.obstacle[1].kind = CPS_OBSTACLE_SPHERE; w.obstacle[1].point[0] = NAN);
    BAD(w.obstacle[1].kind = CPS_OBSTACLE_SPHERE; w.obstacle[1].axis[0] = NAN);
    BAD(w.obstacle[1].point[0] = INFINITY);
    BAD(w.obstacle[0].grain[2] = NAN);
    BAD(w.p.scene.solver.path_tolerance = 1e-10);
    BAD(w.p.scene.solver.path_tolerance = 2);
    BAD(w.p.scene.solver.path_tolerance = NAN);
    BAD(w.p.scene.solver.thread_count = 0);
    BAD(w.p.scene.solver.thread_count = 257);
    BAD(w.p.scene.solver.max_halvings = -1);
    BAD(w.p.scene.solver.max_halvings = 31);
    BAD(w.p.scene.solver.max_iterations = 0);
    BAD(w.p.scene.solver.max_iterations = 1001);
    BAD(w.p.stage.gravity_changes = true; w.p.stage.gravity[0] = NAN);
    BAD(w.p.stage.gravity_changes = true; w.line[0].weight = w.line[1].weight = 0;
        memset(w.p.scene.gravity, 0, sizeof w.p.scene.gravity));
    BAD(w.p.stage.step_count = 0);
    BAD(w.line[0].start.kind = CPS_START_STATIC;
        w.line[0].end[0].kind = w.line[0].end[1].kind = CPS_END_KIND_FREE);
}

/* one number made bad, and where the error says that it is */
static void says_the_place(void **state) {
    (void)state;
    CpsFrictionZone zone[2] = {{0, 1, 0.5}, {2, 3, 0.5}};
    CpsTurn turn = {.obstacle = 1, .angle = 1};
    CpsObstacle obstacle[2];
    Parts p;
    const struct {
        double *number, bad;
        const char *where;
    } CASE[] = {
        {&p.line.length, -1, "lines.cable.length"},
        {&p.line.weight, -1, "lines.cable.weight"},
        {&p.line.stiffness, 0, "lines.cable.stiffness"},
        {&zone[1].factor, -1, "lines.cable.friction_zones[2]"},
        {&p.point[4], NAN, "lines.cable.start"},
        {&p.line.end[1].value[2], NAN, "lines.cable.ends.B"},
        {&obstacle[0].point[1], NAN, "obstacles.bed.plane.point"},
        {&obstacle[1].radius, -1, "obstacles.drum.cylinder.radius"},
        {&obstacle[1].axis[0], NAN, "obstacles.drum.cylinder.axis"},
        {&obstacle[1].friction, -1, "obstacles.drum.friction"},
        {&obstacle[1].friction_lateral, -2, "obstacles.drum.friction.lateral"},
        {&p.change.to.value[0], NAN, "history[1].cable.B"},
        {&turn.angle, INFINITY, "history[1].drum.turn"},
        {&p.scene.gravity[1], NAN, "gravity"},
        {&p.scene.solver.tolerance, 1, "solver.tolerance"},
        {&p.line.length, 10, ""},
    };
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        make(&p);
        obstacle[0] = obstacle[1] = p.obstacle;
        obstacle[1].name = "drum";
        obstacle[1].kind = CPS_OBSTACLE_CYLINDER;
        obstacle[1].radius = 1;
        obstacle[1].point[2] = -5;
        p.scene.obstacle = obstacle;
        p.scene.obstacle_count = 2;
        zone[1].factor = 0.5;
        turn.angle = 1;
        p.line.zone = zone;
        p.line.zone_count = 2;
        p.stage.turn = &turn;
        p.stage.turn_count = 1;
        *CASE[i].number = CASE[i].bad;
        CpsError err = {0};
        cps_scene_check(&p.scene, &err);
        assert_string_equal(err.where, CASE[i].where);
    }
    obstacle[1].name = "2nd";
    CpsError err;
    assert_int_equal(cps_scene_check(&p.scene, &err), CPS_ERR_ARGUMENT);
    assert_string_equal(err.where, "obstacles[2]");
}

static void accepts_the_good_scene(void **state) {
    (void)state;
    Parts p;
    make(&p);
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    p.line.stiffness = INFINITY;
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
}

/* every number of the scene, made NaN or infinite, is refused */
static void refuses_nan_and_infinity(void **state) {
    (void)state;
    static const double BAD[] = {NAN, INFINITY, -INFINITY, 1e200};
    Parts p;
    make(&p);
    double *const numbers[] = {&p.point[0],
                               &p.point[4],
                               &p.obstacle.point[2],
                               &p.obstacle.normal[0],
                               &p.obstacle.friction,
                               &p.line.length,
                               &p.line.weight,
                               &p.line.end[1].value[0],
                               &p.change.to.value[1],
                               &p.scene.gravity[0],
                               &p.scene.solver.tolerance};
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        for (size_t k = 0; k < sizeof BAD / sizeof BAD[0]; k++) {
            make(&p);
            *numbers[i] = BAD[k];
            refused(&p, "expected");
        }
    make(&p);
    p.line.stiffness = NAN;
    refused(&p, "line 'cable': stiffness is nan N, expected a positive number");
}

static bool disc_support(void *user, int n, const double *direction, double *value, double *point) {
    (void)user;
    (void)n;
    *value = hypot(direction[0], direction[1]);
    for (int a = 0; a < 2; a++) point[a] = *value > 0 ? direction[a] / *value : 0;
    return true;
}

static void refuses_wrong_lines(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.line.length = -2;
    refused(&p, "line 'cable': length is -2 m, expected a positive finite number");
    make(&p);
    p.line.element_count = 0;
    refused(&p, "line 'cable': elements is 0");
    make(&p);
    p.line.weight = -1;
    refused(&p, "line 'cable': weight is -1 N/m");
    make(&p);
    p.line.name = NULL;
    refused(&p, "line 1: its name is '(none)'");
    make(&p);
    p.line.name = "a/b";
    refused(&p, "line 1: its name is 'a/b'");
    make(&p);
    p.line.start.point = NULL;
    refused(&p, "line 'cable': start has 0 points");
    make(&p);
    p.line.end[0] = (CpsEnd){CPS_END_KIND_HELD, {NAN, 0, NAN}};
    refused(&p, "ends: end A is at (nan, 0, nan)");
    make(&p);
    p.line.end[0].value[1] = 1;
    refused(&p, "end A is held where the start puts it, but has a position");
}

/* A good shape but for one number. */
static void make_shape(Parts *p, CpsObstacleKind kind) {
    make(p);
    p->obstacle.kind = kind;
    p->obstacle.radius = 1;
    p->obstacle.point[2] = -90;
    p->obstacle.shape.length = 2;
    p->obstacle.shape.main_radius = 3;
    p->obstacle.shape.angle = 0.5;
    for (int i = 0; i < 3; i++) p->obstacle.shape.size[i] = 4;
}

static void refuses_wrong_shapes(Parts *p) {
    static const CpsObstacleKind KIND[] = {CPS_OBSTACLE_CAPSULE, CPS_OBSTACLE_TORUS,
                                           CPS_OBSTACLE_CONE, CPS_OBSTACLE_BOX};
    CpsError err = {0};
    for (int k = 0; k < 4; k++) {
        static const double WRONG[] = {0, -1, NAN, INFINITY};
        make_shape(p, KIND[k]);
        assert_int_equal(cps_scene_check(&p->scene, &err), CPS_OK);
        for (int i = 0; i < 4; i++) {
            make_shape(p, KIND[k]);
            p->obstacle.radius = WRONG[i];
            refused(p, "expected a positive finite number");
        }
        make_shape(p, KIND[k]);
        p->obstacle.point[1] = NAN;
        refused(p, "expected finite numbers");
        make_shape(p, KIND[k]);
        p->obstacle.axis[1] = NAN;
        if (KIND[k] != CPS_OBSTACLE_BOX) refused(p, "expected a direction");
    }
    static const double LENGTH[] = {-1, NAN, INFINITY}, MAIN[] = {1, 0.5, -3, NAN, INFINITY},
                        ANGLE[] = {0, -0.1, 1.5707963267948967, 2, NAN}, SIZE[] = {2, 0, -4, NAN};
    for (int i = 0; i < 3; i++) {
        make_shape(p, CPS_OBSTACLE_CAPSULE);
        p->obstacle.shape.length = LENGTH[i];
        refused(p, "length is");
    }
    for (int i = 0; i < 5; i++) {
        make_shape(p, CPS_OBSTACLE_TORUS);
        p->obstacle.shape.main_radius = MAIN[i];
        refused(p, "main_radius is");
        make_shape(p, CPS_OBSTACLE_CONE);
        p->obstacle.shape.angle = ANGLE[i];
        refused(p, "the angle between axis and side is");
    }
    for (int i = 0; i < 4; i++) {
        make_shape(p, CPS_OBSTACLE_BOX);
        p->obstacle.shape.size[i % 3] = SIZE[i];
        refused(p, "size is");
    }
    make_shape(p, CPS_OBSTACLE_BOX);
    p->obstacle.shape.rotation[0] = 0;
    refused(p, "expected a quaternion");
    make_shape(p, CPS_OBSTACLE_BOX);
    p->obstacle.shape.rotation[2] = NAN;
    refused(p, "expected a quaternion");
    make(p);
    p->obstacle.shape.inside = true;
    refused(p, "lines can be inside of a cylinder, sphere, capsule, torus, cone or box alone");
}

static void refuses_wrong_obstacles(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.scene.obstacle_count = -1;
    refused(&p, "obstacles: found -1");
    make(&p);
    p.obstacle.kind = 70;
    refused(&p, "unknown kind 70");
    refuses_wrong_shapes(&p);
    make(&p);
    p.obstacle.kind = CPS_OBSTACLE_CYLINDER;
    refused(&p, "radius is 0 m");
    make(&p);
    p.obstacle.kind = CPS_OBSTACLE_SPHERE;
    p.obstacle.radius = 1;
    p.obstacle.axis[1] = 0;
    refused(&p, "axis is (0, 0, 0)");
    const CpsTurn turns[2] = {{.obstacle = 0, .angle = 7e4}, {.obstacle = 0, .angle = 6e4}};
    for (int k = 0; k < 2; k++) {
        make(&p);
        p.obstacle.kind = CPS_OBSTACLE_CYLINDER;
        p.obstacle.radius = 1;
        p.obstacle.point[2] = -1;
        p.stage.turn_count = 1;
        p.stage.turn = &turns[k];
        assert_int_equal(cps_scene_check(&p.scene, NULL), k == 0 ? CPS_ERR_LIMIT : CPS_OK);
    }
    make(&p);
    p.obstacle.friction_lateral = 0.2;
    refused(&p, "has_friction_lateral");
    p.obstacle.has_friction_lateral = true;
    p.obstacle.friction_lateral = -2;
    refused(&p, "lateral is -2");
    make(&p);
    p.obstacle.friction_shape = 5;
    refused(&p, "unknown shape 5");
    make(&p);
    p.obstacle.grain[0] = NAN;
    refused(&p, "grain is (nan");
}

static void refuses_wrong_friction(void **state) {
    (void)state;
    Parts p;
    static const struct {
        int n;
        double low, high;
        const char *message;
    } boxes[] = {{3, -1, 1, "friction set: it lies in R^3, expected the plane"},
                 {2, -INFINITY, 1, "friction set: it is unbounded"},
                 {2, 0.1, 1, "friction set: it does not contain 0"}};
    for (size_t i = 0; i < sizeof boxes / sizeof *boxes; i++) {
        const double low[] = {boxes[i].low, boxes[i].low, boxes[i].low},
                     high[] = {boxes[i].high, boxes[i].high, boxes[i].high};
        CpsSet *box;
        assert_int_equal(cps_set_box(boxes[i].n, low, high, &box, NULL), CPS_OK);
        make(&p);
        p.obstacle.friction_set = box;
        refused(&p, boxes[i].message);
        cps_set_release(box);
    }
    CpsSet *users;
    assert_int_equal(cps_set_user(2, disc_support, NULL, &users, NULL), CPS_OK);
    make(&p);
    p.obstacle.friction_set = users;
    refused(&p, "friction set: it holds a user's set");
    cps_set_release(users);
    CpsFrictionZone zones[2] = {{.from = 1, .to = 2, .factor = 2},
                                {.from = 1.5, .to = 3, .factor = 0}};
    make(&p);
    p.line.zone_count = 2;
    p.line.zone = zones;
    refused(&p, "number 2 goes from 1.5 m to 3 m");
    zones[1].from = 2;
    zones[1].to = 1e9;
    refused(&p, "number 2 goes from 2 m to 1e+09 m");
    zones[1].to = NAN;
    refused(&p, "number 2 goes from 2 m to nan m");
    zones[1].to = 2;
    refused(&p, "number 2 goes from 2 m to 2 m");
    zones[1].to = 3;
    zones[1].factor = -1;
    refused(&p, "number 2 has the factor -1");
    zones[1].factor = 1e200;
    refused(&p, "number 2 has the factor 1e+200");
    zones[1].factor = 0;
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    p.line.zone = NULL;
    refused(&p, "friction zones: found 0");
}

static void refuses_wrong_histories(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.scene.line_count = 0;
    refused(&p, "lines: found 0");
    make(&p);
    p.scene.solver.max_iterations = 0;
    refused(&p, "solver: max_iterations is 0");
    make(&p);
    p.scene.contact_policy = (CpsContactPolicy)7;
    refused(&p, "contact_policy: unknown value 7");
    make(&p);
    p.stage.step_count = 0;
    refused(&p, "stage 1: steps is 0");
    make(&p);
    p.stage.cookie = 0;
    refused(&p, "stage 1: not made by cps_stage_default()");
    make(&p);
    p.stage.name = NULL;
    refused(&p, "stage 1: it has no name");
    make(&p);
    p.change.line = 1;
    refused(&p, "stage 1: change 1 names line 1, end 1");
    make(&p);
    p.change.end = 2;
    refused(&p, "stage 1: change 1 names line 0, end 2");

    CpsChange twice[2];
    make(&p);
    twice[0] = twice[1] = p.change;
    p.stage.change = twice;
    p.stage.change_count = 2;
    refused(&p, "stage 1: cable.B is changed twice");
    CpsLine same[2];
    make(&p);
    same[0] = same[1] = p.line;
    p.scene.line = same;
    p.scene.line_count = 2;
    refused(&p, "lines 1 and 2 have the same name");

    const CpsScene forgotten = {.line_count = 1};
    CpsError err;
    assert_int_equal(cps_scene_check(&forgotten, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(cps_scene_check(NULL, &err), CPS_ERR_ARGUMENT);
}

static void limits_sizes(void **state) {
    (void)state;
    Parts p;
    CpsError err;
    make(&p);
    p.line.element_count = 10000001;
    assert_int_equal(cps_scene_check(&p.scene, &err), CPS_ERR_LIMIT);
    make(&p);
    p.stage.step_count = 1000001;
    assert_int_equal(cps_scene_check(&p.scene, &err), CPS_ERR_LIMIT);
}

/* the bounds of the start's length, from both sides: 1e-8 relative */
static void bounds_the_start_length(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.point[3] = 10 * (1 - 0.9e-8);
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    make(&p);
    p.point[3] = 10 * (1 - 1.1e-8);
    refused(&p, "shorter than the line's length");
    make(&p);
    p.point[3] = 20;
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    make(&p);
    p.point[3] = 20.0001;
    refused(&p, "more than twice the line's length");
    make(&p);
    p.line.stiffness = INFINITY;
    p.point[3] = 10 * (1 + 0.9e-8);
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    make(&p);
    p.line.stiffness = INFINITY;
    p.point[3] = 10 * (1 + 1.1e-8);
    refused(&p, "longer than the inextensible");
}

/* how far a held end may lie from the start, and a node below the obstacle: 1e-9 of the length */
static void bounds_places(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.line.end[0] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0.9e-8}};
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    make(&p);
    p.line.end[0] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 1.1e-8}};
    refused(&p, "end A is held at");
    make(&p);
    p.obstacle.point[2] = 0.9e-8;
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    make(&p);
    p.obstacle.point[2] = 1.1e-8;
    refused(&p, "start: node 0 lies");
}

/* ---- start shapes ---- */

static double distance(const double *a, const double *b) {
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* equal elements on a straight line; the last node is exactly the end point */
static void places_straight(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.point[3] = 12;
    p.point[4] = 0.1;
    p.point[5] = 3; /* stretched */
    double x[15];
    cpsi_start_place(&p.line, x);
    for (int i = 0; i <= 4; i++) {
        const double want[] = {12 * i / 4.0, 0.1 * i / 4, 3 * i / 4.0};
        CHECK_VECTOR(&x[3 * i], want, 1e-14); /* a few roundings of numbers of size 12 */
    }
    assert_true(x[12] == 12 && x[13] == 0.1 && x[14] == 3);
}

/* graded elements keep their shares of a polyline, here 16 m for 10 m of line; a corner falls on
 * node 2 */
static void places_polyline(void **state) {
    (void)state;
    static const double lengths[] = {2, 3, 1, 4};
    Parts p;
    make(&p);
    memcpy(p.point, (double[]){0, 0, 0, 8, 0, 0, 8, 8, 0}, sizeof p.point);
    p.line.start.kind = CPS_START_POLYLINE;
    p.line.start.point_count = 3;
    p.line.element_length = lengths;
    assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
    CHECK_NEAR(cpsi_start_length(&p.line), 16, 1e-14); /* sum of exact numbers */
    double x[15];
    cpsi_start_place(&p.line, x);
    static const double want[] = {0, 0, 0, 3.2, 0, 0, 8, 0, 0, 8, 1.6, 0, 8, 8, 0};
    for (int i = 0; i <= 4; i++) CHECK_VECTOR(&x[3 * i], &want[3 * i], 1e-14);
}

/* every chord of an arc is its element's length, every node on the circle; the half circle ends
 * opposite */
static void places_arc(void **state) {
    (void)state;
    enum { N = 800 };
    static double lengths[N], x[3 * (N + 1)];
    Parts p;
    for (int graded = 0; graded < 2; graded++) {
        make(&p);
        double sum = 0;
        for (int i = 0; i < N; i++) sum += lengths[i] = graded ? exp(-0.005 * i) : 1;
        for (int i = 0; i < N; i++) lengths[i] *= 6.28 / sum;
        const double radius = 6.28 / acos(-1.0);
        memcpy(p.point, (double[]){1, 2, 3, 1, 2 + radius, 9},
               sizeof(double[6])); /* the centre may lie off the plane */
        p.line.length = 6.28;
        p.line.element_count = N;
        p.line.element_length = graded ? lengths : NULL;
        p.line.start.kind = CPS_START_ARC;
        assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
        cpsi_start_place(&p.line, x);
        for (int i = 0; i <= N; i++) {
            CHECK_NEAR(x[3 * i + 2], 3, 1e-15);
            CHECK_NEAR(hypot(x[3 * i] - 1, x[3 * i + 1] - 2 - radius), radius,
                       1e-14); /* roundings of size 4 */
            /* an angle of at most pi, summed, has some ulps of pi: 1e-15 of 2 m */
            if (i > 0) CHECK_NEAR(distance(&x[3 * i], &x[3 * i - 3]), lengths[i - 1], 1e-14);
        }
        assert_true(x[3] >
                    1); /* turns to +x first: right-hand rule about z, the centre towards +y */
        /* chords cut the corner: N chords turn a little more than pi, by (pi/N)^2 pi/24 for equal
         * ones */
        if (!graded) CHECK_NEAR(x[3 * N + 1], 2 + 2 * radius, 1e-9);
    }
}

static void guesses_laid(void **state) {
    (void)state;
    Parts p;
    make(&p);
    p.line.start.kind = CPS_START_STATIC;
    p.line.end[0] = (CpsEnd){CPS_END_KIND_HELD, {1, 0, 0}};
    p.line.end[1] = (CpsEnd){CPS_END_KIND_HELD, {1, 8, 4}};
    double x[15], end[3];
    cpsi_start_place(&p.line, x);
    for (int i = 0; i <= 4; i++) CHECK_VECTOR(&x[3 * i], ((double[]){1, 2.0 * i, i}), 1e-14);

    /* one end only: along the force, or down */
    p.line.end[1] = (CpsEnd){CPS_END_KIND_FREE, {0, 3, 4}};
    cpsi_start_end(&p.line, CPS_END_B, end);
    CHECK_VECTOR(end, ((double[]){1, 6, 8}), 1e-14);
    p.line.end[1] = (CpsEnd){CPS_END_KIND_FREE, {0, 0, 0}};
    cpsi_start_end(&p.line, CPS_END_B, end);
    CHECK_VECTOR(end, ((double[]){1, 0, -10}), 1e-14);
}

/* a million elements: the abscissa must not drift */
static void places_many(void **state) {
    (void)state;
    enum { N = 1000000 };
    Parts p;
    make(&p);
    p.line.element_count = N;
    double *x = malloc((size_t)(N + 1) * sizeof(double[3]));
    assert_non_null(x);
    cpsi_start_place(&p.line, x);
    double worst = 0;
    for (int i = 1; i <= N; i++) worst = fmax(worst, fabs(x[3 * i] - x[3 * i - 3] - 1e-5));
    free(x);
    CHECK_LESS(worst, 4e-15); /* two ulps of 10 m */
}

/* A start from nodes: lengths, forces, and what they may be of. */
static void checks_given_nodes(void **state) {
    (void)state;
    double x[15] = {0, 0, 0, 2.5, 0, 0, 4, 2, 0, 5, 2, 0, 7.5, 2, 0}, tension[4] = {3, 3, 0, 0},
           force[5] = {1, 2, 2, 2, 1};
    const CpsFrictionZone zone = {.from = 3, .to = 6.5, .factor = 0};
    Parts p;
    for (int k = 0; k < 13; k++) {
        make(&p);
        p.obstacle.friction = 0.5;
        p.line.start = (CpsStart){.kind = CPS_START_NODES,
                                  .point_count = 5,
                                  .point = x,
                                  .tension = tension,
                                  .friction_bound = force};
        double *const spoilt[] = {NULL, &x[7], &x[7], &x[8], &tension[2], &force[3], &force[3]};
        static const double BY[] = {0, NAN, 20, -1, -1, -2, INFINITY};
        static const char *const SAID[] = {NULL,
                                           "a coordinate of node 2 is nan m",
                                           "nodes 1 and 2 are",
                                           "node 2 lies 1 m below obstacle 'bed'",
                                           "the tension of element 2 is -1 N",
                                           "the friction bound at node 3 is -2 N",
                                           "the friction bound at node 3 is inf N"};
        const double before = k < 7 && spoilt[k] ? *spoilt[k] : 0;
        if (k < 7 && spoilt[k]) *spoilt[k] = BY[k];
        if (k == 7) p.line.start.point_count = 4;
        if (k == 8) p.line.start.reaction = force;
        if (k == 9) {
            p.line.stiffness = INFINITY;
            x[13] = 2.1;
        }
        if (k == 10) {
            p.line.zone_count = 1;
            p.line.zone = &zone;
        }
        if (k == 11) {
            x[8] = 0.1;
            p.line.start.friction_bound = NULL;
            p.line.start.reaction = force;
        }
        if (k == 12) x[8] = 1e-8;
        static const char *const MORE[] = {
            "start has 4 nodes, expected 5", "found reactions and friction bounds",
            "m long and inextensible", "obstacle 'bed' has no friction there",
            "the reaction of node 2 is 2 N, but it touches no obstacle"};
        const char *said = k < 7 ? SAID[k] : k < 12 ? MORE[k - 7] : NULL;
        if (said)
            refused(&p, said);
        else
            assert_int_equal(cps_scene_check(&p.scene, NULL), CPS_OK);
        if (k < 7 && spoilt[k]) *spoilt[k] = before;
        x[13] = 2;
        x[8] = 0;
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(says_the_place),
        cmocka_unit_test(refuses_each_wrong_count_and_kind),
        cmocka_unit_test(refuses_each_wrong_name_and_number),
        cmocka_unit_test(accepts_the_good_scene),
        cmocka_unit_test(refuses_nan_and_infinity),
        cmocka_unit_test(refuses_wrong_lines),
        cmocka_unit_test(refuses_wrong_obstacles),
        cmocka_unit_test(refuses_wrong_friction),
        cmocka_unit_test(refuses_wrong_histories),
        cmocka_unit_test(limits_sizes),
        cmocka_unit_test(bounds_the_start_length),
        cmocka_unit_test(bounds_places),
        cmocka_unit_test(places_straight),
        cmocka_unit_test(places_polyline),
        cmocka_unit_test(places_arc),
        cmocka_unit_test(guesses_laid),
        cmocka_unit_test(places_many),
        cmocka_unit_test(checks_given_nodes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
