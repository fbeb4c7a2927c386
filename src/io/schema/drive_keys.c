/* SPDX-License-Identifier: BSD-3-Clause */
/* The table (see drive_keys.h). */
#include "io/schema/drive_keys.h"

#include <math.h>
#include <stddef.h>

/* clang-format off */

/* ranges: lowest, highest, lowest excluded */
#define ANY          -INFINITY, CPSI_LARGEST, false
#define NOT_NEGATIVE 0, CPSI_LARGEST, false
#define POSITIVE     0, CPSI_LARGEST, true

/* need, place, unit; and inside, words, default */
#define NEEDED(type, field) CPSI_REQUIRED, offsetof(type, field), ""
#define GIVEN(type, field)  CPSI_OPTIONAL, offsetof(type, field), ""
#define INSIDE(mapping)     mapping, NULL, NULL
#define PLAIN               0, NULL, NULL

#define ONE_OF_TWO(a, b) "\"oneOf\": [{\"required\": [\"" a "\"]}, {\"required\": [\"" b "\"]}]"

/* Each row: name, type, need, place, unit, range, most, inside, words, default, help; here those of every patch but a point. */
#define PATCH \
    {"position", CPSI_POINT, GIVEN(CpsiPatchKeys, patch.position), ANY, 2, PLAIN, "[x, y] of the patch in body axes, m; [0, 0] unless given"}, \
    {"angle", CPSI_NUMBER, GIVEN(CpsiPatchKeys, patch.angle), ANY, 0, PLAIN, "by which it is turned, rad, counterclockwise; 0 unless given"}, \
    {"friction", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.friction), NOT_NEGATIVE, 0, PLAIN, "coefficient"}, \
    {"load", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.load), NOT_NEGATIVE, 0, PLAIN, "normal force, N"}
#define TILT "slope of the pressure, mean x (1 + tilt . (r - centroid)), 1/m; 0 unless given"

static const CpsiDriveWord WORD[] = {
    [CPSI_DRIVE_FILE] = {"drive file", "file",
        "\"oneOf\": [{\"required\": [\"system\"]}, {\"required\": [\"body\"]}, {\"required\": [\"vehicle\"]}, "
        "{\"required\": [\"planimeter\"]}, {\"required\": [\"rope\"]}, {\"required\": [\"sweep\"]}]", {
        {"capstan", CPSI_INTEGER, NEEDED(CpsiFileKeys, capstan), 1, 1, false, 0, PLAIN, "version of this file format"},
        {"title", CPSI_TEXT, GIVEN(CpsiFileKeys, title), NOT_NEGATIVE, CPSI_DRIVE_LONGEST_TEXT, PLAIN, "heading of answers and pictures"},
        {"system", CPSI_MAPPING, GIVEN(CpsiFileKeys, system), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_SYSTEM),
         "laws on combinations of velocity parameters"},
        {"body", CPSI_MAPPING, GIVEN(CpsiFileKeys, body), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_BODY), "a body that slides on a plane"},
        {"vehicle", CPSI_MAPPING, GIVEN(CpsiFileKeys, vehicle), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_VEHICLE), "a body on wheels"},
        {"planimeter", CPSI_MAPPING, GIVEN(CpsiFileKeys, planimeter), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PLANIMETER),
         "a polar planimeter that follows a closed curve"},
        {"rope", CPSI_MAPPING, GIVEN(CpsiFileKeys, rope), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_ROPE), "a rope on a table, pulled at its ends"},
        {"sweep", CPSI_MAPPING, GIVEN(CpsiFileKeys, sweep), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_SWEEP), "a block on a spring, drawn along a path"}}},

    [CPSI_DRIVE_SYSTEM] = {"system", "system", NULL, {
        {"parameters", CPSI_NAMES, NEEDED(CpsiSystemKeys, parameters), NOT_NEGATIVE, CPSI_DRIVE_MOST_PARAMETERS, PLAIN,
         "names of the velocity parameters"},
        {"laws", CPSI_LIST, NEEDED(CpsiSystemKeys, laws), NOT_NEGATIVE, 1, INSIDE(CPSI_DRIVE_LAW), "laws, each on some parameters"},
        {"constraints", CPSI_MAP, GIVEN(CpsiSystemKeys, constraints), NOT_NEGATIVE, 0, PLAIN, "combinations that are 0"},
        {"drive", CPSI_MAP, GIVEN(CpsiSystemKeys, drive), NOT_NEGATIVE, 0, PLAIN, "combinations that are imposed, the driving velocity"},
        {"load", CPSI_BY_NAME, GIVEN(CpsiSystemKeys, load), NOT_NEGATIVE, 0, PLAIN, "constant forces dual to the parameters"},
        {"velocity", CPSI_ROWS, GIVEN(CpsiSystemKeys, velocity), 1, CPSI_LARGEST, false, 0, PLAIN,
         "driving velocities to answer where none is asked on the command line"},
        {"map_radius", CPSI_NUMBER, GIVEN(CpsiSystemKeys, map_radius), POSITIVE, 0, PLAIN,
         "pictures show |W| up to it in both components; 1 unless given"}}},
    [CPSI_DRIVE_LAW] = {"law", "system_law", ONE_OF_TWO("law", "resistance"), {
        {"name", CPSI_TEXT, GIVEN(CpsiLawKeys, name), NOT_NEGATIVE, CPSI_DRIVE_LONGEST_TEXT, PLAIN, "in answers; its number unless given"},
        {"on", CPSI_MAP, NEEDED(CpsiLawKeys, on), NOT_NEGATIVE, 0, PLAIN, "what it acts on, as in [side, roll]"},
        {"law", CPSI_LAW, GIVEN(CpsiLawKeys, law), NOT_NEGATIVE, 0, PLAIN, "a friction law, in the words of law files"},
        {"resistance", CPSI_TERMS, GIVEN(CpsiLawKeys, resistance), NOT_NEGATIVE, 0, PLAIN, "terms of a resistance law, in the words of law files"}}},

    [CPSI_DRIVE_BODY] = {"body", "body", NULL, {
        {"patches", CPSI_PATCHES, NEEDED(CpsiBodyKeys, patches), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PATCH), "what it stands on"},
        {"push", CPSI_LIST, GIVEN(CpsiBodyKeys, push), NOT_NEGATIVE, 1, INSIDE(CPSI_DRIVE_PUSH), "motions to answer, one at a time"},
        {"tow", CPSI_MAPPING, GIVEN(CpsiBodyKeys, tow), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_TOW), "a path along which it is drawn"}}},
    [CPSI_DRIVE_VEHICLE] = {"vehicle", "vehicle", NULL, {
        {"wheels", CPSI_LIST, NEEDED(CpsiBodyKeys, patches), NOT_NEGATIVE, 1, INSIDE(CPSI_DRIVE_PATCH + 1), "what it stands on"},
        {"push", CPSI_LIST, GIVEN(CpsiBodyKeys, push), NOT_NEGATIVE, 1, INSIDE(CPSI_DRIVE_PUSH), "motions to answer, one at a time"},
        {"tow", CPSI_MAPPING, GIVEN(CpsiBodyKeys, tow), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_TOW), "a path along which it is drawn"}}},
    [CPSI_DRIVE_PATCH] = {"'point'", "point",
        "\"oneOf\": [{\"required\": [\"friction\", \"load\"], \"not\": {\"required\": [\"law\"]}}, "
        "{\"required\": [\"law\"], "
        "\"not\": {\"anyOf\": [{\"required\": [\"friction\"]}, {\"required\": [\"load\"]}]}}]", {
        {"position", CPSI_POINT, GIVEN(CpsiPatchKeys, patch.position), ANY, 2, PLAIN, "[x, y] of the patch in body axes, m; [0, 0] unless given"},
        {"angle", CPSI_NUMBER, GIVEN(CpsiPatchKeys, patch.angle), ANY, 0, PLAIN, "by which it is turned, rad, counterclockwise; 0 unless given"},
        {"friction", CPSI_NUMBER, GIVEN(CpsiPatchKeys, patch.friction), NOT_NEGATIVE, 0, PLAIN, "coefficient"},
        {"load", CPSI_NUMBER, GIVEN(CpsiPatchKeys, patch.load), NOT_NEGATIVE, 0, PLAIN, "normal force, N"},
        {"law", CPSI_LAW, GIVEN(CpsiPatchKeys, law), NOT_NEGATIVE, 0, PLAIN, "a bounded law of two components, in place of friction and load"}}},
    [CPSI_DRIVE_PATCH + 1] = {"'wheel'", "wheel", NULL, {
        PATCH,
        {"radius", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.size), POSITIVE, 0, PLAIN, "m"},
        {"brake", CPSI_BRAKE, GIVEN(CpsiPatchKeys, brake), NOT_NEGATIVE, 0, PLAIN, "torque, N m, or locked; 0 unless given: it rolls freely"}}},
    [CPSI_DRIVE_PATCH + 2] = {"'rod'", "rod", NULL, {
        PATCH,
        {"half_length", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.size), POSITIVE, 0, PLAIN, "m"},
        {"tilt", CPSI_NUMBER, GIVEN(CpsiPatchKeys, patch.tilt), ANY, 0, PLAIN, TILT}}},
    [CPSI_DRIVE_PATCH + 3] = {"'ring'", "ring", NULL, {
        PATCH,
        {"radius", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.size), POSITIVE, 0, PLAIN, "m"},
        {"tilt", CPSI_POINT, GIVEN(CpsiPatchKeys, patch.tilt), ANY, 2, PLAIN, TILT}}},
    [CPSI_DRIVE_PATCH + 4] = {"'disc'", "disc", NULL, {
        PATCH,
        {"radius", CPSI_NUMBER, NEEDED(CpsiPatchKeys, patch.size), POSITIVE, 0, PLAIN, "m"},
        {"tilt", CPSI_POINT, GIVEN(CpsiPatchKeys, patch.tilt), ANY, 2, PLAIN, TILT}}},
    [CPSI_DRIVE_PATCH + 5] = {"'polygon'", "polygon", NULL, {
        PATCH,
        {"corners", CPSI_ROWS, NEEDED(CpsiPatchKeys, corners), 3, CPSI_LARGEST, false, 2, PLAIN, "[[x, y], ..], m"},
        {"tilt", CPSI_POINT, GIVEN(CpsiPatchKeys, patch.tilt), ANY, 2, PLAIN, TILT}}},
    [CPSI_DRIVE_PUSH] = {"push", "push",
        "\"oneOf\": [{\"required\": [\"at\", \"velocity\"], \"maxProperties\": 2}, "
        "{\"required\": [\"at\", \"normal\", \"speed\"], "
        "\"maxProperties\": 3}, {\"required\": [\"twist\"], \"maxProperties\": 1}]", {
        {"at", CPSI_POINT, GIVEN(CpsiPushKeys, at), ANY, 2, PLAIN, "[x, y] of the point moved, in body axes, m"},
        {"velocity", CPSI_POINT, GIVEN(CpsiPushKeys, velocity), ANY, 2, PLAIN, "of that point, m/s"},
        {"normal", CPSI_POINT, GIVEN(CpsiPushKeys, normal), ANY, 2, PLAIN, "direction in which alone it is moved; of any length but zero"},
        {"speed", CPSI_NUMBER, GIVEN(CpsiPushKeys, speed), ANY, 0, PLAIN, "along the normal, m/s"},
        {"twist", CPSI_POINT, GIVEN(CpsiPushKeys, twist), ANY, 3, PLAIN, "[vx, vy, w] of the body, m/s and rad/s"}}},
    [CPSI_DRIVE_TOW] = {"tow", "tow", "\"dependentRequired\": {\"end\": [\"rope\"]}", {
        {"pose", CPSI_POINT, GIVEN(CpsiTowKeys, start.pose), ANY, 3, PLAIN, "[x, y, angle] where it starts, m and rad; 0 unless given"},
        {"hitch", CPSI_POINT, GIVEN(CpsiTowKeys, start.hitch), ANY, 2, PLAIN, "[x, y] in body axes, m; 0 unless given"},
        {"rope", CPSI_NUMBER, GIVEN(CpsiTowKeys, start.rope), NOT_NEGATIVE, 0, PLAIN, "length of a rope between hitch and end, m; 0 unless given"},
        {"end", CPSI_POINT, GIVEN(CpsiTowKeys, end), ANY, 2, PLAIN, "[x, y] where the rope's far end starts, m"},
        {"path", CPSI_PATH, NEEDED(CpsiTowKeys, path), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PATH), "points that the hitch or the rope's end passes"},
        {"steps", CPSI_INTEGER, NEEDED(CpsiTowKeys, steps), 1, CPSI_DRIVE_MOST_STEPS, false, 0, PLAIN, "equal steps along the path"}}},

    [CPSI_DRIVE_PLANIMETER] = {"planimeter", "planimeter", NULL, {
        {"pole", CPSI_POINT, NEEDED(CpsiPlanimeterKeys, planimeter.pole), ANY, 2, PLAIN, "where the pole is, m"},
        {"pole_arm", CPSI_NUMBER, NEEDED(CpsiPlanimeterKeys, planimeter.pole_arm), POSITIVE, 0, PLAIN, "length, m"},
        {"tracer_arm", CPSI_NUMBER, NEEDED(CpsiPlanimeterKeys, planimeter.tracer_arm), POSITIVE, 0, PLAIN, "length, m"},
        {"wheel", CPSI_NUMBER, NEEDED(CpsiPlanimeterKeys, planimeter.wheel), ANY, 0, PLAIN, "from the hinge towards the tracer, m"},
        {"friction", CPSI_NUMBER, NEEDED(CpsiPlanimeterKeys, planimeter.friction), POSITIVE, 0, PLAIN,
         "coefficient of the wheel: what turns it is friction"},
        {"load", CPSI_NUMBER, NEEDED(CpsiPlanimeterKeys, planimeter.load), POSITIVE, 0, PLAIN, "on the wheel, N"},
        {"left_elbow", CPSI_FLAG, GIVEN(CpsiPlanimeterKeys, planimeter.left_elbow), NOT_NEGATIVE, 0, PLAIN,
         "the hinge lies left of the line from pole to tracer; false unless given"},
        {"curve", CPSI_CURVE, NEEDED(CpsiPlanimeterKeys, curve), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_CURVE), "closed curve that the tracer follows"},
        {"steps", CPSI_INTEGER, GIVEN(CpsiPlanimeterKeys, steps), 1, 10000, false, 0, PLAIN, "on each side of the curve; 1 unless given"}}},
    [CPSI_DRIVE_CURVE] = {"'curve'", "curve", ONE_OF_TWO("circle", "file"), {
        {"circle", CPSI_MAPPING, GIVEN(CpsiCurveKeys, circle), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_CIRCLE), "a regular polygon on a circle"},
        {"file", CPSI_FILE_NAME, GIVEN(CpsiCurveKeys, file), NOT_NEGATIVE, 0, PLAIN, "of x, y in each line, beside this one"}}},
    [CPSI_DRIVE_CIRCLE] = {"'circle'", "circle", "\"allOf\": [{\"properties\": {\"points\": {\"minimum\": 3}}}]", {
        {"center", CPSI_POINT, NEEDED(CpsiCircleKeys, center), ANY, 2, PLAIN, "m"},
        {"radius", CPSI_NUMBER, NEEDED(CpsiCircleKeys, radius), POSITIVE, 0, PLAIN, "m"},
        {"points", CPSI_INTEGER, NEEDED(CpsiCircleKeys, points), 1, CPSI_DRIVE_MOST_STEPS, false, 0, PLAIN, "corners on it"}}},

    [CPSI_DRIVE_ROPE] = {"rope", "rope", NULL, {
        {"shape", CPSI_MAPPING, NEEDED(CpsiRopeKeys, shape), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_SHAPE), "{straight: ..}, {arc: ..} or {points: ..}"},
        {"elements", CPSI_INTEGER, GIVEN(CpsiRopeKeys, elements), 1, CPSI_DRIVE_MOST_ELEMENTS, false, 0, PLAIN,
         "straight ones, of equal length; 100 unless given"},
        {"friction", CPSI_NUMBER, NEEDED(CpsiRopeKeys, friction), POSITIVE, 0, PLAIN, "coefficient"},
        {"weight", CPSI_NUMBER, NEEDED(CpsiRopeKeys, weight), POSITIVE, 0, PLAIN, "N/m"},
        {"ends", CPSI_MAPPING, NEEDED(CpsiRopeKeys, ends), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_ENDS), "what the ends do, as in {A: held, B: [1, 0]}"},
        {"slack", CPSI_FLAG, GIVEN(CpsiRopeKeys, slack), NOT_NEGATIVE, 0, PLAIN,
         "may elements become shorter, without tension?  Unless true, the velocity keeps every length"},
        {"path", CPSI_PATH, GIVEN(CpsiRopeKeys, path), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PATH), "points that end B then passes"},
        {"steps", CPSI_INTEGER, GIVEN(CpsiRopeKeys, steps), 1, 10000, false, 0, PLAIN, "load steps along the path; 40 unless given"},
        {"shots", CPSI_INTEGER, GIVEN(CpsiRopeKeys, shots), 1, 24, false, 0, PLAIN, "shapes along the path in the picture; 6 unless given"}}},
    [CPSI_DRIVE_SHAPE] = {"'shape'", "shape", "\"minProperties\": 1, \"maxProperties\": 1", {
        {"straight", CPSI_MAPPING, GIVEN(CpsiShapeKeys, straight), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_STRAIGHT), "a straight rope"},
        {"arc", CPSI_MAPPING, GIVEN(CpsiShapeKeys, arc), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_ARC), "an arc of a circle"},
        {"points", CPSI_ROWS, GIVEN(CpsiShapeKeys, points), 2, CPSI_LARGEST, false, 2, PLAIN, "[[x, y], ..] joined by straight pieces, m"}}},
    [CPSI_DRIVE_STRAIGHT] = {"'straight'", "straight", NULL, {
        {"from", CPSI_POINT, NEEDED(CpsiStraightKeys, from), ANY, 2, PLAIN, "first end, m"},
        {"to", CPSI_POINT, NEEDED(CpsiStraightKeys, to), ANY, 2, PLAIN, "last end, m"}}},
    [CPSI_DRIVE_ARC] = {"'arc'", "arc", NULL, {
        {"center", CPSI_POINT, NEEDED(CpsiArcKeys, center), ANY, 2, PLAIN, "m"},
        {"radius", CPSI_NUMBER, NEEDED(CpsiArcKeys, radius), POSITIVE, 0, PLAIN, "m"},
        {"from", CPSI_NUMBER, NEEDED(CpsiArcKeys, from), ANY, 0, PLAIN, "angle of the first end, rad"},
        {"turn", CPSI_NUMBER, NEEDED(CpsiArcKeys, turn), ANY, 0, PLAIN, "angle to the last end, rad, counterclockwise"}}},
    [CPSI_DRIVE_ENDS] = {"'ends'", "ends", NULL, {
        {"A", CPSI_END_MOTION, GIVEN(CpsiEndsKeys, A), NOT_NEGATIVE, 0, PLAIN, "the first end likewise; free unless given"},
        {"B", CPSI_END_MOTION, NEEDED(CpsiEndsKeys, B), NOT_NEGATIVE, 0, PLAIN, "velocity [vx, vy] of the last end, m/s"}}},

    [CPSI_DRIVE_SWEEP] = {"sweep", "sweep", NULL, {
        {"law", CPSI_LAW, NEEDED(CpsiSweepKeys, law), NOT_NEGATIVE, 0, PLAIN, "friction law of the block, 1 or 2 components"},
        {"stiffness", CPSI_NUMBER, NEEDED(CpsiSweepKeys, stiffness), POSITIVE, 0, PLAIN, "of the spring, N/m"},
        {"position", CPSI_COMPONENTS, GIVEN(CpsiSweepKeys, position), NOT_NEGATIVE, 0, PLAIN, "where the block is at first, m; 0 unless given"},
        {"end", CPSI_COMPONENTS, GIVEN(CpsiSweepKeys, end), NOT_NEGATIVE, 0, PLAIN,
         "where the spring's far end is at first, m; where the block is unless given"},
        {"path", CPSI_PATH, NEEDED(CpsiSweepKeys, path), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PATH), "points that the spring's far end passes"},
        {"steps", CPSI_INTEGER, NEEDED(CpsiSweepKeys, steps), 1, CPSI_DRIVE_MOST_STEPS, false, 0, PLAIN, "equal steps along the path"}}},

    [CPSI_DRIVE_PATH] = {"'path'", "path", NULL, {
        {"arc", CPSI_MAPPING, NEEDED(CpsiPathKeys, arc), NOT_NEGATIVE, 0, INSIDE(CPSI_DRIVE_PATH_ARC), "{center: .., turn: ..}"}}},
    [CPSI_DRIVE_PATH_ARC] = {"'arc'", "path_arc",
        "\"allOf\": [{\"properties\": {\"turn\": {\"minimum\": -1000, \"maximum\": 1000}}}]", {
        {"center", CPSI_POINT, NEEDED(CpsiPathArcKeys, center), ANY, 2, PLAIN, "middle of the circle, m"},
        {"turn", CPSI_NUMBER, NEEDED(CpsiPathArcKeys, turn), ANY, 0, PLAIN, "angle, rad, counterclockwise"}}},
};
/* clang-format on */

_Static_assert(sizeof WORD / sizeof WORD[0] == CPSI_DRIVE_MAPPINGS, "one word per kind of mapping");

const CpsiDriveWord *cpsi_drive_word(CpsiDriveMapping mapping) { return &WORD[mapping]; }

int cpsi_drive_word_count(const CpsiDriveWord *word) {
    int n = 0;
    while (n < CPSI_DRIVE_MOST_KEYS && word->key[n].name) n++;
    return n;
}
