/* SPDX-License-Identifier: BSD-3-Clause */
/* The table (see drive_keys.h). */
#include "io/schema/drive_keys.h"

#include <math.h>
#include <stddef.h>

/* clang-format off */

/* required, range of numbers, most */
#define NEEDED            true, 0, false, 0
#define GIVEN             false, 0, false, 0
#define NEEDED_ANY        true, -INFINITY, false, 0
#define GIVEN_ANY         false, -INFINITY, false, 0
#define NEEDED_POSITIVE   true, 0, true, 0
#define NEEDED_POINT(n)   true, -INFINITY, false, n
#define GIVEN_POINT(n)    false, -INFINITY, false, n
#define NEEDED_COUNT(n)   true, 0, false, n
#define GIVEN_COUNT(n)    false, 0, false, n

#define ONE_OF_TWO(a, b) "\"oneOf\": [{\"required\": [\"" a "\"]}, {\"required\": [\"" b "\"]}]"

/* of every patch but a point */
#define PATCH \
    {"position", CPSI_FIELD_POINT, GIVEN_POINT(2), "[x, y] of the patch in body axes, m; [0, 0] unless given", 0}, \
    {"angle", CPSI_FIELD_NUMBER, GIVEN_ANY, "by which it is turned, rad, counterclockwise; 0 unless given", 0}, \
    {"friction", CPSI_FIELD_NUMBER, NEEDED, "coefficient", 0}, \
    {"load", CPSI_FIELD_NUMBER, NEEDED, "normal force, N", 0}
#define TILT "slope of the pressure, mean x (1 + tilt . (r - centroid)), 1/m; 0 unless given"

static const CpsiDriveWord WORD[] = {
    [CPSI_DRIVE_FILE] = {"drive file", "file",
        "\"oneOf\": [{\"required\": [\"system\"]}, {\"required\": [\"body\"]}, {\"required\": [\"vehicle\"]}, "
        "{\"required\": [\"planimeter\"]}, {\"required\": [\"rope\"]}, {\"required\": [\"sweep\"]}]", {
        {"capstan", CPSI_FIELD_COUNT, NEEDED_COUNT(1), "version of this file format", 0},
        {"title", CPSI_FIELD_TEXT, GIVEN, "heading of answers and pictures", 0},
        {"system", CPSI_FIELD_MAPPING, GIVEN, "laws on combinations of velocity parameters", CPSI_DRIVE_SYSTEM},
        {"body", CPSI_FIELD_MAPPING, GIVEN, "a body that slides on a plane", CPSI_DRIVE_BODY},
        {"vehicle", CPSI_FIELD_MAPPING, GIVEN, "a body on wheels", CPSI_DRIVE_VEHICLE},
        {"planimeter", CPSI_FIELD_MAPPING, GIVEN,
         "a polar planimeter that follows a closed curve", CPSI_DRIVE_PLANIMETER},
        {"rope", CPSI_FIELD_MAPPING, GIVEN, "a rope on a table, pulled at its ends", CPSI_DRIVE_ROPE},
        {"sweep", CPSI_FIELD_MAPPING, GIVEN, "a block on a spring, drawn along a path", CPSI_DRIVE_SWEEP}}},

    [CPSI_DRIVE_SYSTEM] = {"system", "system", NULL, {
        {"parameters", CPSI_FIELD_NAMES, NEEDED_COUNT(CPSI_DRIVE_MOST_PARAMETERS),
         "names of the velocity parameters", 0},
        {"laws", CPSI_FIELD_LIST, NEEDED, "laws, each on some parameters", CPSI_DRIVE_LAW},
        {"constraints", CPSI_FIELD_MAP, GIVEN, "combinations that are 0", 0},
        {"drive", CPSI_FIELD_MAP, GIVEN, "combinations that are imposed, the driving velocity", 0},
        {"load", CPSI_FIELD_BY_NAME, GIVEN, "constant forces dual to the parameters", 0},
        {"velocity", CPSI_FIELD_ROWS, false, 1, false, 0,
         "driving velocities to answer where none is asked on the command line", 0},
        {"map_radius", CPSI_FIELD_NUMBER, false, 0, true, 0,
         "pictures show |W| up to it in both components; 1 unless given", 0}}},
    [CPSI_DRIVE_LAW] = {"law", "system_law", ONE_OF_TWO("law", "resistance"), {
        {"name", CPSI_FIELD_TEXT, GIVEN, "in answers; its number unless given", 0},
        {"on", CPSI_FIELD_MAP, NEEDED, "what it acts on, as in [side, roll]", 0},
        {"law", CPSI_FIELD_LAW, GIVEN, "a friction law, in the words of law files", 0},
        {"resistance", CPSI_FIELD_TERMS, GIVEN, "terms of a resistance law, in the words of law files", 0}}},

    [CPSI_DRIVE_BODY] = {"body", "body", NULL, {
        {"patches", CPSI_FIELD_PATCHES, NEEDED, "what it stands on", 0},
        {"push", CPSI_FIELD_LIST, GIVEN, "motions to answer, one at a time", CPSI_DRIVE_PUSH},
        {"tow", CPSI_FIELD_MAPPING, GIVEN, "a path along which it is drawn", CPSI_DRIVE_TOW}}},
    [CPSI_DRIVE_VEHICLE] = {"vehicle", "vehicle", NULL, {
        {"wheels", CPSI_FIELD_LIST, NEEDED, "what it stands on", CPSI_DRIVE_PATCH + 1},
        {"push", CPSI_FIELD_LIST, GIVEN, "motions to answer, one at a time", CPSI_DRIVE_PUSH},
        {"tow", CPSI_FIELD_MAPPING, GIVEN, "a path along which it is drawn", CPSI_DRIVE_TOW}}},
    [CPSI_DRIVE_PATCH] = {"'point'", "point",
        "\"oneOf\": [{\"required\": [\"friction\", \"load\"], \"not\": {\"required\": [\"law\"]}}, "
        "{\"required\": [\"law\"], "
        "\"not\": {\"anyOf\": [{\"required\": [\"friction\"]}, {\"required\": [\"load\"]}]}}]", {
        {"position", CPSI_FIELD_POINT, GIVEN_POINT(2), "[x, y] of the patch in body axes, m; [0, 0] unless given", 0},
        {"angle", CPSI_FIELD_NUMBER, GIVEN_ANY, "by which it is turned, rad, counterclockwise; 0 unless given", 0},
        {"friction", CPSI_FIELD_NUMBER, GIVEN, "coefficient", 0},
        {"load", CPSI_FIELD_NUMBER, GIVEN, "normal force, N", 0},
        {"law", CPSI_FIELD_LAW, GIVEN, "a bounded law of two components, in place of friction and load", 0}}},
    [CPSI_DRIVE_PATCH + 1] = {"'wheel'", "wheel", NULL, {
        PATCH,
        {"radius", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"brake", CPSI_FIELD_BRAKE, GIVEN, "torque, N m, or locked; 0 unless given: it rolls freely", 0}}},
    [CPSI_DRIVE_PATCH + 2] = {"'rod'", "rod", NULL, {
        PATCH,
        {"half_length", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"tilt", CPSI_FIELD_NUMBER, GIVEN_ANY, TILT, 0}}},
    [CPSI_DRIVE_PATCH + 3] = {"'ring'", "ring", NULL, {
        PATCH,
        {"radius", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"tilt", CPSI_FIELD_POINT, GIVEN_POINT(2), TILT, 0}}},
    [CPSI_DRIVE_PATCH + 4] = {"'disc'", "disc", NULL, {
        PATCH,
        {"radius", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"tilt", CPSI_FIELD_POINT, GIVEN_POINT(2), TILT, 0}}},
    [CPSI_DRIVE_PATCH + 5] = {"'polygon'", "polygon", NULL, {
        PATCH,
        {"corners", CPSI_FIELD_ROWS, true, 3, false, 2, "[[x, y], ..], m", 0},
        {"tilt", CPSI_FIELD_POINT, GIVEN_POINT(2), TILT, 0}}},
    [CPSI_DRIVE_PUSH] = {"push", "push",
        "\"oneOf\": [{\"required\": [\"at\", \"velocity\"], \"maxProperties\": 2}, "
        "{\"required\": [\"at\", \"normal\", \"speed\"], "
        "\"maxProperties\": 3}, {\"required\": [\"twist\"], \"maxProperties\": 1}]", {
        {"at", CPSI_FIELD_POINT, GIVEN_POINT(2), "[x, y] of the point moved, in body axes, m", 0},
        {"velocity", CPSI_FIELD_POINT, GIVEN_POINT(2), "of that point, m/s", 0},
        {"normal", CPSI_FIELD_POINT, GIVEN_POINT(2), "direction in which alone it is moved; of any length but zero", 0},
        {"speed", CPSI_FIELD_NUMBER, GIVEN_ANY, "along the normal, m/s", 0},
        {"twist", CPSI_FIELD_POINT, GIVEN_POINT(3), "[vx, vy, w] of the body, m/s and rad/s", 0}}},
    [CPSI_DRIVE_TOW] = {"tow", "tow", "\"dependentRequired\": {\"end\": [\"rope\"]}", {
        {"pose", CPSI_FIELD_POINT, GIVEN_POINT(3), "[x, y, angle] where it starts, m and rad; 0 unless given", 0},
        {"hitch", CPSI_FIELD_POINT, GIVEN_POINT(2), "[x, y] in body axes, m; 0 unless given", 0},
        {"rope", CPSI_FIELD_NUMBER, GIVEN, "length of a rope between hitch and end, m; 0 unless given", 0},
        {"end", CPSI_FIELD_POINT, GIVEN_POINT(2), "[x, y] where the rope's far end starts, m", 0},
        {"path", CPSI_FIELD_PATH, NEEDED, "points that the hitch or the rope's end passes", 0},
        {"steps", CPSI_FIELD_COUNT, NEEDED_COUNT(CPSI_DRIVE_MOST_STEPS), "equal steps along the path", 0}}},

    [CPSI_DRIVE_PLANIMETER] = {"planimeter", "planimeter", NULL, {
        {"pole", CPSI_FIELD_POINT, NEEDED_POINT(2), "where the pole is, m", 0},
        {"pole_arm", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "length, m", 0},
        {"tracer_arm", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "length, m", 0},
        {"wheel", CPSI_FIELD_NUMBER, NEEDED_ANY, "from the hinge towards the tracer, m", 0},
        {"friction", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "coefficient of the wheel: what turns it is friction", 0},
        {"load", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "on the wheel, N", 0},
        {"left_elbow", CPSI_FIELD_FLAG, GIVEN,
         "the hinge lies left of the line from pole to tracer; false unless given", 0},
        {"curve", CPSI_FIELD_CURVE, NEEDED, "closed curve that the tracer follows", 0},
        {"steps", CPSI_FIELD_COUNT, GIVEN_COUNT(10000), "on each side of the curve; 1 unless given", 0}}},
    [CPSI_DRIVE_CURVE] = {"'curve'", "curve", ONE_OF_TWO("circle", "file"), {
        {"circle", CPSI_FIELD_MAPPING, GIVEN, "a regular polygon on a circle", CPSI_DRIVE_CIRCLE},
        {"file", CPSI_FIELD_FILE_NAME, GIVEN, "of x, y in each line, beside this one", 0}}},
    [CPSI_DRIVE_CIRCLE] = {"'circle'", "circle", "\"allOf\": [{\"properties\": {\"points\": {\"minimum\": 3}}}]", {
        {"center", CPSI_FIELD_POINT, NEEDED_POINT(2), "m", 0},
        {"radius", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"points", CPSI_FIELD_COUNT, NEEDED_COUNT(CPSI_DRIVE_MOST_STEPS), "corners on it", 0}}},

    [CPSI_DRIVE_ROPE] = {"rope", "rope", NULL, {
        {"shape", CPSI_FIELD_MAPPING, NEEDED, "{straight: ..}, {arc: ..} or {points: ..}", CPSI_DRIVE_SHAPE},
        {"elements", CPSI_FIELD_COUNT, GIVEN_COUNT(CPSI_DRIVE_MOST_ELEMENTS),
         "straight ones, of equal length; 100 unless given", 0},
        {"friction", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "coefficient", 0},
        {"weight", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "N/m", 0},
        {"ends", CPSI_FIELD_MAPPING, NEEDED, "what the ends do, as in {A: held, B: [1, 0]}", CPSI_DRIVE_ENDS},
        {"slack", CPSI_FIELD_FLAG, GIVEN,
         "may elements become shorter, without tension?  Unless true, the velocity keeps every length", 0},
        {"path", CPSI_FIELD_PATH, GIVEN, "points that end B then passes", 0},
        {"steps", CPSI_FIELD_COUNT, GIVEN_COUNT(10000), "load steps along the path; 40 unless given", 0},
        {"shots", CPSI_FIELD_COUNT, GIVEN_COUNT(24), "shapes along the path in the picture; 6 unless given", 0}}},
    [CPSI_DRIVE_SHAPE] = {"'shape'", "shape", "\"minProperties\": 1, \"maxProperties\": 1", {
        {"straight", CPSI_FIELD_MAPPING, GIVEN, "a straight rope", CPSI_DRIVE_STRAIGHT},
        {"arc", CPSI_FIELD_MAPPING, GIVEN, "an arc of a circle", CPSI_DRIVE_ARC},
        {"points", CPSI_FIELD_ROWS, false, 2, false, 2, "[[x, y], ..] joined by straight pieces, m", 0}}},
    [CPSI_DRIVE_STRAIGHT] = {"'straight'", "straight", NULL, {
        {"from", CPSI_FIELD_POINT, NEEDED_POINT(2), "first end, m", 0},
        {"to", CPSI_FIELD_POINT, NEEDED_POINT(2), "last end, m", 0}}},
    [CPSI_DRIVE_ARC] = {"'arc'", "arc", NULL, {
        {"center", CPSI_FIELD_POINT, NEEDED_POINT(2), "m", 0},
        {"radius", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "m", 0},
        {"from", CPSI_FIELD_NUMBER, NEEDED_ANY, "angle of the first end, rad", 0},
        {"turn", CPSI_FIELD_NUMBER, NEEDED_ANY, "angle to the last end, rad, counterclockwise", 0}}},
    [CPSI_DRIVE_ENDS] = {"'ends'", "ends", NULL, {
        {"A", CPSI_FIELD_END, GIVEN, "the first end likewise; free unless given", 0},
        {"B", CPSI_FIELD_END, NEEDED, "velocity [vx, vy] of the last end, m/s", 0}}},

    [CPSI_DRIVE_SWEEP] = {"sweep", "sweep", NULL, {
        {"law", CPSI_FIELD_LAW, NEEDED, "friction law of the block, 1 or 2 components", 0},
        {"stiffness", CPSI_FIELD_NUMBER, NEEDED_POSITIVE, "of the spring, N/m", 0},
        {"position", CPSI_FIELD_VECTOR, GIVEN, "where the block is at first, m; 0 unless given", 0},
        {"end", CPSI_FIELD_VECTOR, GIVEN,
         "where the spring's far end is at first, m; where the block is unless given", 0},
        {"path", CPSI_FIELD_PATH, NEEDED, "points that the spring's far end passes", 0},
        {"steps", CPSI_FIELD_COUNT, NEEDED_COUNT(CPSI_DRIVE_MOST_STEPS), "equal steps along the path", 0}}},

    [CPSI_DRIVE_PATH] = {"'path'", "path", NULL, {
        {"arc", CPSI_FIELD_MAPPING, NEEDED, "{center: .., turn: ..}", CPSI_DRIVE_PATH_ARC}}},
    [CPSI_DRIVE_PATH_ARC] = {"'arc'", "path_arc",
        "\"allOf\": [{\"properties\": {\"turn\": {\"minimum\": -1000, \"maximum\": 1000}}}]", {
        {"center", CPSI_FIELD_POINT, NEEDED_POINT(2), "middle of the circle, m", 0},
        {"turn", CPSI_FIELD_NUMBER, NEEDED_ANY, "angle, rad, counterclockwise", 0}}},
};
/* clang-format on */

_Static_assert(sizeof WORD / sizeof WORD[0] == CPSI_DRIVE_MAPPINGS, "one word per kind of mapping");

const CpsiDriveWord *cpsi_drive_word(CpsiDriveMapping mapping) { return &WORD[mapping]; }

int cpsi_drive_word_count(const CpsiDriveWord *word) {
    int n = 0;
    while (n < CPSI_DRIVE_MOST_FIELDS && word->field[n].name) n++;
    return n;
}
