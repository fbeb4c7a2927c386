/* SPDX-License-Identifier: BSD-3-Clause */
/* The scene reader: what is read, defaults, graded lists, ends, moves, numbers, limits, the
 * locale. */
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "io/base/yaml/yaml.h"
#include "splitmix.h"

#define HEAD     "capstan: 1\nlines:\n  cable:\n    length: 10\n    stiffness: .inf\n    mass: 2\n"
#define STRAIGHT "    start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}\n"
#define ENDS     "    ends: {A: held, B: free}\n"

/* Read a text as a scene file, and once more as a text: both say the same. */
static CpsStatus read_text(const char *text, const CpsReadLimits *limits, CpsSceneFile **file,
                           CpsError *err) {
    char path[] = "scene_read_test_XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
    const CpsStatus status = cps_scene_read(path, limits, file, err);
    unlink(path);
    if (!file) return status;
    CpsSceneFile *again = NULL;
    CpsError said;
    assert_int_equal(cps_scene_read_text(text, path, limits, &again, &said), status);
    if (status == CPS_OK) {
        assert_int_equal(cps_scene_file_scene(again)->line_count,
                         cps_scene_file_scene(*file)->line_count);
    } else if (err) {
        assert_string_equal(said.file, err->file);
        assert_string_equal(said.message, err->message);
        assert_int_equal(said.line, err->line);
        assert_int_equal(said.column, err->column);
    }
    cps_scene_file_destroy(again);
    return status;
}

static CpsSceneFile *read_good(const char *text) {
    CpsSceneFile *file = NULL;
    CpsError err = {0};
    if (read_text(text, NULL, &file, &err) != CPS_OK) {
        print_error("%d:%d: %s\n", err.line, err.column, err.message);
        fail();
    }
    return file;
}

static void reads_defaults(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(HEAD STRAIGHT ENDS);
    const CpsScene *scene = cps_scene_file_scene(file), usual = cps_scene_default();
    assert_null(scene->title);
    assert_memory_equal(scene->gravity, usual.gravity, sizeof usual.gravity);
    assert_memory_equal(&scene->solver, &usual.solver, sizeof usual.solver);
    assert_int_equal(scene->obstacle_count, 0);
    assert_int_equal(scene->friction_policy, usual.friction_policy);
    assert_int_equal(scene->stage_count, 0);
    assert_int_equal(scene->contact_policy, CPS_CONTACT_POLICY_REACHED);
    assert_int_equal(scene->line_count, 1);
    const CpsLine *line = scene->line;
    assert_string_equal(line->name, "cable");
    assert_int_equal(line->element_count, 100);
    assert_null(line->element_length);
    assert_true(line->length == 10 && isinf(line->stiffness) && line->stiffness > 0);
    CHECK_NEAR(line->weight, 2 * 9.81, 1e-14); /* two roundings */
    assert_int_equal(line->end[0].kind, CPS_END_KIND_AT_START);
    assert_int_equal(line->end[1].kind, CPS_END_KIND_FREE);
    assert_true(line->end[1].value[0] == 0 && line->end[1].value[1] == 0 &&
                line->end[1].value[2] == 0);
    cps_scene_file_destroy(file);
    cps_scene_file_destroy(NULL);
}

static void reads_every_key(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        "# all keys\ncapstan: 1\ntitle: \"R\\u00fcgen: 'a'\"\ngravity: [0, 0, -10]\n"
        "obstacles:\n  slope-1: {plane: {point: [1, 2, 3], normal: [0, -1, 1]}, friction: 0.25}\n"
        "lines:\n"
        "  one: {length: 5, elements: 7, weight: 3, stiffness: 1e3, start: static,\n"
        "        ends: {A: {held: [0, 0, 8]}, B: {force: [4, 5, 6]}}}\n"
        "  two: {length: 3, elements: 0x10, mass: +1.5, stiffness: 2.E3, ends: {B: {held: [0, 1, "
        "12]}, A: free},\n"
        "        start: {polyline: [[0, 0, 10], [0, 0, 12], [0, 1, 12]]}}\n"
        "  three: {length: 3.0, elements: 20, mass: 0, stiffness: .Inf, ends: {A: held, B: "
        "held},\n"
        "          start: {arc: {from: [0, 0, 10], centre: [0, 0, 12], axis: [1, 0, 0]}}}\n"
        "friction_policy: frozen\ncontact_policy: reference\nsolver: {tolerance: 1e-10, "
        "max_iterations: 33, "
        "linear_system: dense}\n"
        "history:\n- {name: up & down, steps: 4, two.B: {position: [0, 1, 13]}, one.B: {force: [0, "
        "0, 9]}}\n- {}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    assert_string_equal(scene->title, "R\xc3\xbcgen: 'a'");
    assert_true(scene->gravity[2] == -10);
    assert_string_equal(scene->obstacle->name, "slope-1");
    assert_true(scene->obstacle->point[2] == 3 && scene->obstacle->normal[1] == -1 &&
                scene->obstacle->friction == 0.25);
    assert_int_equal(scene->contact_policy, CPS_CONTACT_POLICY_REFERENCE);
    assert_true(scene->solver.tolerance == 1e-10);
    assert_int_equal(scene->solver.max_iterations, 33);
    assert_int_equal(scene->solver.linear_system, CPS_LINEAR_SYSTEM_DENSE);

    const CpsLine *one = &scene->line[0], *two = &scene->line[1], *three = &scene->line[2];
    assert_int_equal(one->start.kind, CPS_START_STATIC);
    assert_true(one->weight == 3 && one->element_count == 7 && one->end[0].value[2] == 8 &&
                one->end[1].value[2] == 6);
    assert_int_equal(two->start.kind, CPS_START_POLYLINE);
    assert_int_equal(two->start.point_count, 3);
    assert_true(two->element_count == 16 && two->weight == 15 && two->stiffness == 2000 &&
                two->start.point[7] == 1);
    assert_int_equal(two->end[0].kind, CPS_END_KIND_FREE);
    assert_int_equal(three->start.kind, CPS_START_ARC);
    assert_true(three->start.point[5] == 12 && three->start.axis[0] == 1 &&
                three->start.axis[2] == 0);

    assert_int_equal(scene->stage_count, 2);
    const CpsStage *stage = scene->stage;
    assert_string_equal(stage->name, "up & down");
    assert_int_equal(stage->step_count, 4);
    assert_int_equal(stage->change_count, 2);
    assert_int_equal(stage->change[0].line, 1);
    assert_int_equal(stage->change[0].to.kind, CPS_END_KIND_HELD);
    assert_int_equal(stage->change[1].line, 0);
    assert_int_equal(stage->change[1].to.kind, CPS_END_KIND_FREE);
    assert_string_equal(stage[1].name, "entry 2");
    assert_int_equal(stage[1].change_count, 0);
    cps_scene_file_destroy(file);
}

/* every kind of obstacle, its defaults, both forms of friction; turns in degrees */
static void reads_obstacles(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        HEAD
        "    start: {straight: {from: [0, 0, 50], to: [10, 0, 50]}}\n" ENDS "obstacles:\n"
        "  bed: {plane: {}, friction: {axial: 0.6, lateral: 0.8, shape: box, grain: [1, 2, 0]}}\n"
        "  drum: {cylinder: {point: [1, 2, 3], axis: [0, 0, 5], radius: 0.5}, friction: 0.3}\n"
        "  pipe: {cylinder: {radius: 2}, friction: {axial: 0.1}}\n"
        "  ball: {sphere: {centre: [4, 5, 6], radius: 7, axis: [1, 0, 0]}}\n"
        "history:\n- {drum.turn: 90, cable.B: {force: [0, 0, 1]}, ball.turn: -360, steps: 2}\n- "
        "{}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    const CpsObstacle usual = cps_obstacle_default(), *bed = scene->obstacle, *drum = bed + 1,
                      *pipe = bed + 2, *ball = bed + 3;
    assert_int_equal(scene->obstacle_count, 4);
    assert_int_equal(bed->kind, CPS_OBSTACLE_PLANE);
    assert_memory_equal(bed->normal, usual.normal, sizeof usual.normal);
    assert_true(bed->friction == 0.6 && bed->has_friction_lateral && bed->friction_lateral == 0.8 &&
                bed->grain[1] == 2);
    assert_int_equal(bed->friction_shape, CPS_FRICTION_SHAPE_BOX);
    assert_string_equal(drum->name, "drum");
    assert_int_equal(drum->kind, CPS_OBSTACLE_CYLINDER);
    CHECK_VECTOR(drum->point, ((double[]){1, 2, 3}), 0);
    CHECK_VECTOR(drum->axis, ((double[]){0, 0, 5}), 0);
    assert_true(drum->radius == 0.5 && drum->friction == 0.3 && !drum->has_friction_lateral &&
                drum->friction_lateral == 0);
    assert_memory_equal(pipe->axis, usual.axis, sizeof usual.axis);
    assert_memory_equal(pipe->point, usual.point, sizeof usual.point);
    assert_true(pipe->friction == 0.1 && !pipe->has_friction_lateral);
    assert_int_equal(pipe->friction_shape, CPS_FRICTION_SHAPE_ELLIPSE);
    assert_int_equal(ball->kind, CPS_OBSTACLE_SPHERE);
    assert_true(ball->radius == 7 && ball->point[1] == 5 && ball->axis[0] == 1 &&
                ball->friction == 0);

    const CpsStage *stage = scene->stage;
    assert_int_equal(stage->turn_count, 2);
    assert_int_equal(stage->change_count, 1);
    assert_int_equal(stage->turn[0].obstacle, 1);
    CHECK_NEAR(stage->turn[0].angle, acos(0), 1e-15); /* two roundings */
    assert_int_equal(stage->turn[1].obstacle, 3);
    CHECK_NEAR(stage->turn[1].angle, -2 * acos(-1), 1e-15);
    assert_int_equal(stage[1].turn_count, 0);
    cps_scene_file_destroy(file);
}

/* tables of strain and tension, of a line and of a type */
static void reads_tables(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        "capstan: 1\n"
        "types:\n  rope: {mass: 2, stiffness: {tension: [0, 4, 9], strain: [0, 0.5, 0.75]}}\n"
        "  wire: {mass: 2, stiffness: 7, dynamic_stiffness: {strain: [0, 0.25], tension: [0, 2]}}\n"
        "lines:\n"
        "  a: {length: 9, mass: 1, stiffness: {strain: [0, 1e-3], tension: [0, 1e+3]}, "
        "dynamic_stiffness: 3e6, start: "
        "static, ends: {A: {held: [0, 0, 0]}, B: {held: [0, 1, 0]}}}\n"
        "  b: {sections: [{type: wire, length: 1, elements: 1}, {type: rope, length: 2, elements: "
        "1}], start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [0, 1, 0]}}}\n"
        "history: [{stiffness: static}, {stiffness: dynamic}, {}]\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    const CpsLine *line = scene->line;
    for (int s = 0; s < 3; s++) CHECK_INT(scene->stage[s].static_stiffness, s == 0);
    assert_true(line[0].has_dynamic_stiffness && line[0].dynamic_stiffness.stiffness == 3e6 &&
                line[0].dynamic_stiffness.row_count == 0);
    assert_true(!line[1].has_dynamic_stiffness && !line[1].section[1].has_dynamic_stiffness);
    assert_true(line[1].section[0].has_dynamic_stiffness &&
                line[1].section[0].dynamic_stiffness.row_count == 2 &&
                line[1].section[0].dynamic_stiffness.row[1].strain == 0.25 &&
                line[1].section[0].dynamic_stiffness.row[1].tension == 2);
    CHECK_INT(line[0].stiffness_row_count, 2);
    assert_true(line[0].stiffness_row[1].strain == 1e-3 && line[0].stiffness_row[1].tension == 1e3);
    const CpsSection *section = line[1].section;
    assert_true(section[0].stiffness_row_count == 0 && !section[0].stiffness_row);
    CHECK_INT(section[1].stiffness_row_count, 3);
    CHECK_NEAR(section[1].stiffness_row[0].tension, 0, 0);
    assert_true(section[1].stiffness_row[1].strain == 0.5 &&
                section[1].stiffness_row[2].tension == 9);
    cps_scene_file_destroy(file);
}

/* the length of a line or section is found, and what is behind it moves along */
static void finds_lengths(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        "capstan: 1\ntypes: {rope: {mass: 1, stiffness: 1e4}}\nlines:\n"
        "  a: {length: 9, elements: 20, mass: 1, stiffness: 1e4, start: static, pretension: {end: "
        "A, "
        "horizontal: 70}, ends: {A: {held: [0, 0, 0]}, B: {held: [8, 0, 2]}}}\n"
        "  b: {sections: [{type: rope, length: 3, elements: 5}, {type: rope, length: 4, elements: "
        "5}], "
        "point_weights: [{at: 3, weight: 5}], start: static, pretension: {end: B, tension: 90, "
        "section: 1}, ends: {A: {held: [0, 9, 0]}, B: {held: [8, 9, 2]}}}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    CpsEvolution *evolution = NULL;
    CpsError err;
    CHECK_INT(cps_evolution_create(scene, &evolution, &err), CPS_OK);
    CHECK_INT(cps_evolution_step(evolution, &err), CPS_OK);
    const CpsLineReport one = cps_evolution_line_report(evolution, 0),
                        two = cps_evolution_line_report(evolution, 1);
    CHECK_RELATIVE(hypot(one.end[CPS_END_A].force[0], one.end[CPS_END_A].force[1]), 70, 1e-9);
    CHECK_RELATIVE(two.end[CPS_END_B].tension, 90, 1e-9);
    CHECK_INT(scene->line[0].element_count, 20);
    const CpsLine *line = &scene->line[1];
    CHECK_NEAR(line->section[1].length, 4, 0);
    CHECK_NEAR(line->length, line->section[0].length + 4, 1e-14);
    CHECK_NEAR(line->point_weight[0].arc_length, line->section[0].length, 1e-14);
    assert_true(fabs(line->section[0].length - 3) > 0.1);
    cps_evolution_destroy(evolution);
    cps_scene_file_destroy(file);
}

/* A line of this length whose elements are said by `text`, as a line or as its one section. */
static CpsSceneFile *read_meshed(double length, const char *text, bool section) {
    char scene[600];
    snprintf(scene, sizeof scene,
             "capstan: 1\ntypes: {rope: {mass: 1, stiffness: 1}}\nlines:\n  cable: {%s length: "
             "%.17g, %s%s, start: static, ends: {A: {held: [0, 0, 0]}, B: {held: [1, 0, 0]}}}\n",
             section ? "sections: [{type: rope," : "mass: 1, stiffness: 1,", length, text,
             section ? "}]" : "");
    return read_good(scene);
}

/* Elements of a line: equal ones or graded, by number or by their largest length. Their lengths
 * grow by one factor from the end named, the first over the last is the ratio, they make up the
 * line, and one element less (with both ends two less) would be too long. */
static void grades_elements(void **state) {
    (void)state;
    static const char *const TOWARDS[] = {"A", "B", "both"};
    uint64_t seed = 16;
    for (int i = 0; i < 400; i++) {
        const int way = (int)splitmix(&seed, 0, 3), n = 1 + (int)splitmix(&seed, 0, 60);
        const double length = pow(10, splitmix(&seed, -3, 4)),
                     ratio = splitmix(&seed, 0, 1) < 0.1 ? 1 : pow(10, splitmix(&seed, 0, 3)),
                     most = length * pow(10, splitmix(&seed, -2, 0.3));
        const bool by_length = splitmix(&seed, 0, 1) < 0.6, section = splitmix(&seed, 0, 1) < 0.5;
        char text[200], mesh[60];
        snprintf(mesh, sizeof mesh, by_length ? "element_length: %.17g" : "elements: %.0f",
                 by_length ? most : n);
        snprintf(text, sizeof text, "%s, grade: {towards: %s, ratio: %.17g}", mesh, TOWARDS[way],
                 ratio);
        CpsSceneFile *file = read_meshed(length, text, section);
        const CpsLine *line = cps_scene_file_scene(file)->line;
        const int count = line->element_count, middle = way == 2 ? (count - 1) / 2 : count - 1;
        const double *l = line->element_length;
        double sum = 0, longest = 0, fewer = 0;
        for (int e = 0; e < count; e++) sum += l[e];
        for (int e = 0; e < count; e++) longest = fmax(longest, l[e]);
        CHECK_RELATIVE(sum, length, 1e-12); /* up to 4000 additions */
        if (!by_length) CHECK_INT(count, n);
        if (by_length) CHECK_LESS(longest, most * (1 + 1e-11));
        const double *first = way == 1 ? &l[count - 1] : l;
        const int on = way == 1 ? -1 : 1;
        if (middle > 0) CHECK_RELATIVE(first[on * middle], ratio * first[0], 1e-11);
        for (int e = 1; e <= middle; e++)
            CHECK_RELATIVE(log(first[on * e] / first[0]) * middle, log(ratio) * e, 1e-9);
        if (way == 2)
            for (int e = 0; e < count; e++) CHECK_RELATIVE(l[e], l[count - 1 - e], 1e-12);
        /* the longest of one element less on this length, or of one less in each half */
        const int less = way == 2 ? count / 2 - 1 : count - 1;
        for (int e = 0; e < less; e++) fewer += pow(ratio, less > 1 ? -(double)e / (less - 1) : 0);
        if (by_length && less > 0) CHECK_GREATER(length, fewer * most * (way == 2 ? 2 : 1));
        cps_scene_file_destroy(file);
        /* without a grade */
        file = read_meshed(length, mesh, section);
        line = cps_scene_file_scene(file)->line;
        const double each = length / line->element_count;
        if (!by_length) CHECK_INT(line->element_count, n);
        if (by_length) CHECK_LESS(each, most * (1 + 1e-11));
        if (by_length && line->element_count > 1)
            CHECK_GREATER(length / (line->element_count - 1), most);
        if (line->element_length) CHECK_RELATIVE(line->element_length[0], each, 1e-15);
        cps_scene_file_destroy(file);
    }
}

/* points, ends at them and their changes: moves add up, weights are those in water */
static void reads_points(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        "capstan: 1\nwater_density: 1000\ngravity: [0, 0, -10]\npoints:\n"
        "  zulu: {held: [1, 2, 3]}\n"
        "  knot: {free: [4, 5, 6], force: [7, 8, 9], mass: 5, volume: 0.001}\n"
        "  anchor: {held: [-1, 0, 3], weight: -2}\n"
        "lines:\n"
        "  a: {length: 9, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: anchor}, B: "
        "{point: knot}}}\n"
        "  b: {length: 9, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: zulu}, B: "
        "{held: [0, 1, 0]}}}\n"
        "history:\n"
        "- {anchor.point: {move: [1, 0, 0]}, knot.point: {force: [3, 2, 1]}, b.B: {move: [0, 0, "
        "1]}}\n"
        "- {anchor.point: {move: [1, 0, 1]}, knot.point: {position: [4, 4, 4]}}\n"
        "- {anchor.point: {force: [0, 0, 5]}, knot.point: {move: [0, 0, 2]}}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    const CpsPoint *point = scene->point;
    assert_int_equal(scene->point_count, 3);
    assert_string_equal(point[0].name, "zulu");
    assert_string_equal(point[1].name, "knot");
    assert_string_equal(point[2].name, "anchor");
    assert_int_equal(point[0].kind, CPS_POINT_KIND_HELD);
    assert_int_equal(point[1].kind, CPS_POINT_KIND_FREE);
    CHECK_VECTOR(point[0].position, ((double[]){1, 2, 3}), 0);
    CHECK_VECTOR(point[1].position, ((double[]){4, 5, 6}), 0);
    CHECK_VECTOR(point[1].force, ((double[]){7, 8, 9}), 0);
    CHECK_VECTOR(point[2].force, ((double[]){0, 0, 0}), 0);
    assert_true(point[0].weight == 0 && point[1].weight == 40 && point[2].weight == -2);

    const CpsLine *line = scene->line;
    assert_int_equal(line[0].end[0].kind, CPS_END_KIND_POINT);
    assert_int_equal(line[0].end_point[0], 2);
    assert_int_equal(line[0].end_point[1], 1);
    assert_int_equal(line[1].end_point[0], 0);
    assert_int_equal(line[1].end[1].kind, CPS_END_KIND_HELD);

    const CpsStage *stage = scene->stage;
    const CpsPointChange *change = stage[0].point_change;
    assert_int_equal(stage[0].change_count, 1);
    for (int i = 0; i < 3; i++) assert_int_equal(stage[i].point_change_count, 2);
    assert_int_equal(change[0].point, 2);
    assert_int_equal(change[0].kind, CPS_POINT_KIND_HELD);
    CHECK_VECTOR(change[0].value, ((double[]){0, 0, 3}), 0);
    assert_int_equal(change[1].point, 1);
    assert_int_equal(change[1].kind, CPS_POINT_KIND_FREE);
    CHECK_VECTOR(change[1].value, ((double[]){3, 2, 1}), 0);
    change = stage[1].point_change;
    CHECK_VECTOR(change[0].value, ((double[]){1, 0, 4}), 0);
    assert_int_equal(change[1].kind, CPS_POINT_KIND_HELD);
    CHECK_VECTOR(change[1].value, ((double[]){4, 4, 4}), 0);
    change = stage[2].point_change;
    assert_int_equal(change[0].kind, CPS_POINT_KIND_FREE);
    CHECK_VECTOR(change[0].value, ((double[]){0, 0, 5}), 0);
    CHECK_VECTOR(change[1].value, ((double[]){4, 4, 6}), 0);
    cps_scene_file_destroy(file);
}

/* bodies, points on them and their changes */
static void reads_bodies(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        "capstan: 1\nwater_density: 1000\ngravity: [0, 0, -10]\nbodies:\n"
        "  zulu: {held: [1, 2, 3], fixed: [y, rz], members: [{from: [1, 2, 3], to: [4, 5, 6],"
        " diameter: 0.7, normal: 0.8, tangential: 0.9, added_normal: 1.1, strips: 12},"
        " {from: [1, 2, 3], to: [4, 5, 7], diameter: 0.6, normal: 1}]}\n"
        "  spar: {free: [4, 5, 6], rotation: {quaternion: [1, 2, 3, 4]}, mass: 5, volume: 0.02,"
        " centre_of_gravity: [1, 0, 2], centre_of_buoyancy: [0, 3, 4], force: [7, 8, 9],"
        " moment: [1, 1, 1], arm: [2, 0, -1], hydrostatics: {z: 3, ry: -5}}\n"
        "points:\n  a: {held: [0, 0, 0]}\n  b: {body: spar, at: [0.1, 0.2, 0.3]}\n"
        "  c: {body: zulu}\n"
        "lines:\n"
        "  k: {length: 9, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: a}, B: {point: "
        "b}}}\n"
        "  l: {length: 9, mass: 1, stiffness: 1e6, start: static, ends: {A: {point: b}, B: {point: "
        "c}}}\n"
        "history:\n"
        "- {zulu.body: {move: [1, 0, 0]}, spar.body: {force: [0, 0, 2], arm: [3, 0, 0]}}\n"
        "- {zulu.body: {rotation: {roll_pitch_yaw: [0, 0, 90]}, move: [1, 0, 1]}}\n"
        "- {zulu.body: {moment: [0, 4, 0]}, spar.body: {position: [1, 1, 1], rotation: "
        "{quaternion: "
        "[0, 1, 0, 0]}}}\n"
        "- {spar.body: {move: [0, 1, 0]}}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    const CpsBody *body = scene->body;
    assert_int_equal(scene->body_count, 2);
    assert_string_equal(body[0].name, "zulu");
    assert_string_equal(body[1].name, "spar");
    assert_int_equal(body[0].kind, CPS_BODY_KIND_HELD);
    assert_int_equal(body[1].kind, CPS_BODY_KIND_FREE);
    for (int i = 0; i < 6; i++) {
        assert_true(body[0].fixed[i] == (i == 1 || i == 5));
        assert_false(body[1].fixed[i]);
    }
    CHECK_VECTOR(body[0].position, ((double[]){1, 2, 3}), 0);
    CHECK_VECTOR(body[1].position, ((double[]){4, 5, 6}), 0);
    const CpsMember *member = body[0].member;
    assert_true(body[0].member_count == 2 && body[1].member_count == 0);
    CHECK_VECTOR(member[0].from, ((double[]){1, 2, 3}), 0);
    CHECK_VECTOR(member[0].to, ((double[]){4, 5, 6}), 0);
    assert_true(member[0].diameter == 0.7 && member[0].normal == 0.8 &&
                member[0].strip_count == 12);
    assert_true(member[0].tangential == 0.9 && member[0].added_normal == 1.1);
    assert_true(member[1].tangential == 0 && member[1].added_normal == 0 && member[1].to[2] == 7);
    assert_true(member[1].strip_count == 0);
    assert_true(body[0].rotation[0] == 1 && body[0].weight == 0 && body[0].buoyancy == 0);
    CHECK_VECTOR(&body[1].rotation[1], ((double[]){2, 3, 4}), 0);
    assert_true(body[1].weight == 50 && body[1].buoyancy == 200);
    CHECK_VECTOR(body[1].centre_of_gravity, ((double[]){1, 0, 2}), 0);
    CHECK_VECTOR(body[1].centre_of_buoyancy, ((double[]){0, 3, 4}), 0);
    CHECK_VECTOR(body[1].force, ((double[]){7, 8, 9}), 0);
    /* (2, 0, -1) x (7, 8, 9) = (8, -25, 16) */
    CHECK_VECTOR(body[1].moment, ((double[]){9, -24, 17}), 0);
    for (int i = 0; i < 36; i++)
        assert_true(body[1].hydrostatics[i] == (i == 14 ? 3 : i == 28 ? -5 : 0));
    const CpsPoint *point = scene->point;
    assert_int_equal(point[1].kind, CPS_POINT_KIND_ON_BODY);
    assert_int_equal(point[1].body, 1);
    assert_int_equal(point[2].body, 0);
    CHECK_VECTOR(point[1].position, ((double[]){0.1, 0.2, 0.3}), 0);
    CHECK_VECTOR(point[2].position, ((double[]){0, 0, 0}), 0);

    const CpsStage *stage = scene->stage;
    static const int COUNT[] = {2, 1, 2, 1};
    for (int i = 0; i < 4; i++) assert_int_equal(stage[i].body_change_count, COUNT[i]);
    const CpsBodyChange *change = stage[0].body_change;
    assert_int_equal(change[0].body, 0);
    assert_int_equal(change[0].kind, CPS_BODY_KIND_HELD);
    CHECK_VECTOR(change[0].position, ((double[]){2, 2, 3}), 0);
    assert_true(change[0].rotation[0] == 1);
    assert_int_equal(change[1].body, 1);
    assert_int_equal(change[1].kind, CPS_BODY_KIND_FREE);
    CHECK_VECTOR(change[1].force, ((double[]){0, 0, 2}), 0);
    CHECK_VECTOR(change[1].moment, ((double[]){0, -6, 0}), 0); /* and no more of the first one */
    change = stage[1].body_change;
    CHECK_VECTOR(change[0].position, ((double[]){3, 2, 4}), 0);
    CHECK_NEAR(change[0].rotation[3], sqrt(0.5), 1e-15);
    change = stage[2].body_change;
    assert_int_equal(change[0].kind, CPS_BODY_KIND_FREE);
    CHECK_VECTOR(change[0].force, ((double[]){0, 0, 0}), 0);
    CHECK_VECTOR(change[0].moment, ((double[]){0, 4, 0}), 0);
    assert_int_equal(change[1].kind, CPS_BODY_KIND_HELD);
    change = stage[3].body_change;
    CHECK_VECTOR(change[0].position, ((double[]){1, 2, 1}), 0);
    assert_true(change[0].rotation[1] == 1);
    cps_scene_file_destroy(file);
}

/* sets in the words of law files, the scene file holds them; stretches of a line */
static void reads_friction_sets_and_zones(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(
        HEAD
        "    start: {straight: {from: [0, 0, 50], to: [10, 0, 50]}}\n" ENDS
        "    friction_zones: [{from: 0, to: 4, factor: 1.5}, {factor: 0, to: 10.0, from: 4.5}]\n"
        "obstacles:\n"
        "  bed: {plane: {}, friction: {set: {translate: {by: [0.1, 0], of: {ellipse: [0.6, "
        "0.3]}}}, grain: [1, 2, 0]}}\n"
        "  pipe: {cylinder: {radius: 2}, friction: {set: {coulomb: {friction: 0.4, load: 1}}}}\n"
        "  ball: {sphere: {radius: 3}, friction: 0.2}\n");
    const CpsScene *scene = cps_scene_file_scene(file);
    CpsSetAnswer answer;
    const double along[] = {1, 0}, across[] = {0, 1};
    assert_int_equal(cps_set_support(scene->obstacle[0].friction_set, along, NULL, &answer, NULL),
                     CPS_OK);
    CHECK_NEAR(answer.value, 0.7, 1e-15); /* a rounding or two */
    assert_int_equal(cps_set_support(scene->obstacle[0].friction_set, across, NULL, &answer, NULL),
                     CPS_OK);
    CHECK_NEAR(answer.value, 0.3, 1e-15);
    assert_true(scene->obstacle[0].grain[1] == 2 && scene->obstacle[0].friction == 0);
    assert_int_equal(cps_set_support(scene->obstacle[1].friction_set, across, NULL, &answer, NULL),
                     CPS_OK);
    CHECK_NEAR(answer.value, 0.4, 1e-15);
    assert_null(scene->obstacle[2].friction_set);
    const CpsLine *line = scene->line;
    assert_int_equal(line->zone_count, 2);
    assert_true(line->zone[0].from == 0 && line->zone[0].to == 4 && line->zone[0].factor == 1.5);
    assert_true(line->zone[1].from == 4.5 && line->zone[1].to == 10 && line->zone[1].factor == 0);
    cps_scene_file_destroy(file);

    /* what was made before a fault is let go (the address sanitizer looks) */
    CpsError err;
    const char *bad =
        HEAD STRAIGHT ENDS "obstacles:\n  a: {plane: {}, friction: {set: {disc: 1}}}\n"
                           "  b: {plane: {}, friction: {set: {sum: [{disc: 1}, {disc: -1}]}}}\n";
    assert_int_equal(read_text(bad, NULL, &file, &err), CPS_ERR_INPUT);
    assert_int_equal(err.line, 11);
    assert_int_equal(err.column, 53);
    assert_null(file);
}

static void reads_graded_elements(void **state) {
    (void)state;
    CpsSceneFile *file = read_good(HEAD STRAIGHT ENDS "    elements: [0.5, [3, 4.5], [2, 4], 1]\n");
    const CpsLine *line = cps_scene_file_scene(file)->line;
    static const double want[] = {0.5, 1.5, 1.5, 1.5, 2, 2, 1};
    assert_int_equal(line->element_count, 7);
    for (int i = 0; i < 7; i++)
        CHECK_NEAR(line->element_length[i], want[i], 1e-15); /* exact in binary */
    cps_scene_file_destroy(file);
}

/* a move is counted from where the entry before has put the end, from the start shape at first */
static void adds_moves(void **state) {
    (void)state;
    CpsSceneFile *file =
        read_good(HEAD STRAIGHT "    ends: {A: held, B: held}\n"
                                "history:\n"
                                "- {cable.B: {move: [-1, 0, 0]}}\n"
                                "- {cable.B: {move: [0, 2, 0]}, cable.A: {move: [0, 0, 1]}}\n"
                                "- {cable.B: {position: [5, 5, 5]}}\n"
                                "- {cable.B: {move: [0, 0, -1]}}\n");
    const CpsStage *stage = cps_scene_file_scene(file)->stage;
    CHECK_VECTOR(stage[0].change[0].to.value, ((double[]){9, 0, 0}), 0);
    CHECK_VECTOR(stage[1].change[0].to.value, ((double[]){9, 2, 0}), 0);
    CHECK_VECTOR(stage[1].change[1].to.value, ((double[]){0, 0, 1}), 0);
    CHECK_VECTOR(stage[3].change[0].to.value, ((double[]){5, 5, 4}), 0);
    cps_scene_file_destroy(file);

    CpsError err;
    const char *released =
        HEAD STRAIGHT "    ends: {A: held, B: held}\n"
                      "history:\n- {cable.B: {force: [0, 0, 0]}}\n- {cable.B: {move: [0, 2, 0]}}\n";
    assert_int_equal(read_text(released, NULL, &file, &err), CPS_ERR_INPUT);
    assert_int_equal(err.line, 11);
    assert_int_equal(err.column, 14);
    assert_null(file);
}

/* the numbers of YAML 1.2's core schema, and what only looks like one */
static void knows_numbers(void **state) {
    (void)state;
    static const struct {
        const char *text;
        double value;
    } GOOD[] = {
        {"0", 0},     {"-0", 0},     {"+12", 12},        {"1.5", 1.5},         {".5", 0.5},
        {"5.", 5},    {"1e3", 1000}, {"1E-3", 0.001},    {"-1.e+2", -100},     {"0x1F", 31},
        {"0o17", 15}, {"012", 12},   {"1e-310", 1e-310}, {"-.inf", -INFINITY}, {"+.INF", INFINITY},
        {"0.1", 0.1}};
    static const char *const BAD[] = {"",
                                      " 1",
                                      "1 ",
                                      "e3",
                                      "1e",
                                      "1e+",
                                      ".",
                                      "-",
                                      "--1",
                                      "1.2.3",
                                      "1_000",
                                      "1,5",
                                      "0x",
                                      "0o8",
                                      "0x1g",
                                      "inf",
                                      "nan",
                                      "infinity",
                                      "1d3",
                                      "1f",
                                      "0b1",
                                      "-0x1",
                                      ".infx",
                                      "1:30",
                                      "\xef\xbc\x91",
                                      "0x1p3",
                                      "5 m",
                                      "1e400",
                                      "-1e400",
                                      "1e-400",
                                      "0o7777777777777777777777"};
    for (size_t i = 0; i < sizeof GOOD / sizeof GOOD[0]; i++) {
        double x = NAN;
        if (!cpsi_yaml_number(GOOD[i].text, &x)) fail_msg("'%s' is a number", GOOD[i].text);
        CHECK_NEAR(x, GOOD[i].value, 0);
    }
    double x = 0;
    assert_true(cpsi_yaml_number(".NaN", &x) && isnan(x));
    for (size_t i = 0; i < sizeof BAD / sizeof BAD[0]; i++)
        if (cpsi_yaml_number(BAD[i], &x)) fail_msg("'%s' is no number", BAD[i]);
}

static void keeps_limits(void **state) {
    (void)state;
    const char *text = HEAD STRAIGHT ENDS "history: [{steps: 3}, {steps: 3}]\n";
    CpsSceneFile *file;
    CpsError err;
    CpsReadLimits limits = cps_read_limits_default();
    limits.max_bytes = strlen(text);
    limits.max_depth = 6;
    limits.max_elements = 100;
    limits.max_steps = 6;
    assert_int_equal(read_text(text, &limits, &file, &err), CPS_OK);
    cps_scene_file_destroy(file);

    /* and limits that did not begin as the default */
    const CpsReadLimits bare = {.max_bytes = 1000,
                                .max_depth = 6,
                                .max_elements = 100,
                                .max_steps = 6};
    assert_int_equal(read_text(text, &bare, &file, &err), CPS_ERR_ARGUMENT);

    /* one less of each is refused */
    CpsReadLimits less = limits;
    less.max_bytes--;
    assert_int_equal(read_text(text, &less, &file, &err), CPS_ERR_LIMIT);
    less = limits;
    less.max_depth--;
    assert_int_equal(read_text(text, &less, &file, &err), CPS_ERR_LIMIT);
    assert_int_equal(err.line, 7);
    less = limits;
    less.max_elements--;
    assert_int_equal(read_text(text, &less, &file, &err), CPS_ERR_LIMIT);
    less = limits;
    less.max_steps--;
    assert_int_equal(read_text(text, &less, &file, &err), CPS_ERR_LIMIT);
    const char *beside = HEAD STRAIGHT ENDS "obstacles: {a: {plane: {normal: [0, 0, 1]}}, "
                                            "b: {plane: {normal: [0, 0, 1]}}}\n";
    less = cps_read_limits_default();
    less.max_pairs = 200;
    assert_int_equal(read_text(beside, &less, &file, &err), CPS_OK);
    cps_scene_file_destroy(file);
    less.max_pairs--;
    assert_int_equal(read_text(beside, &less, &file, &err), CPS_ERR_LIMIT);
    less = limits;
    less.max_depth = 0;
    assert_int_equal(read_text(text, &less, &file, &err), CPS_ERR_ARGUMENT);
    assert_int_equal(read_text(text, NULL, NULL, &err), CPS_ERR_ARGUMENT);
}

/* a program whose locale has a decimal comma reads the same numbers, and keeps its locale */
static void ignores_the_locale(void **state) {
    (void)state;
    static const char *const COMMA[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"};
    bool found = false;
    for (size_t i = 0; i < sizeof COMMA / sizeof COMMA[0] && !found; i++)
        found = setlocale(LC_NUMERIC, COMMA[i]) != NULL;
    if (!found) skip();
    CpsSceneFile *file = read_good(HEAD STRAIGHT ENDS "    elements: [0.5, 9.5]\n");
    assert_true(cps_scene_file_scene(file)->line->element_length[0] == 0.5);
    cps_scene_file_destroy(file);
    char number[16];
    snprintf(number, sizeof number, "%.1f", 0.5);
    setlocale(LC_NUMERIC, "C");
    assert_string_equal(number, "0,5");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_defaults),  cmocka_unit_test(reads_every_key),
        cmocka_unit_test(reads_obstacles), cmocka_unit_test(reads_points),
        cmocka_unit_test(reads_bodies),    cmocka_unit_test(reads_friction_sets_and_zones),
        cmocka_unit_test(reads_tables),    cmocka_unit_test(reads_graded_elements),
        cmocka_unit_test(adds_moves),      cmocka_unit_test(knows_numbers),
        cmocka_unit_test(keeps_limits),    cmocka_unit_test(ignores_the_locale),
        cmocka_unit_test(grades_elements), cmocka_unit_test(finds_lengths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
