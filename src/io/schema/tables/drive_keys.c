/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of keys of files of driven systems (see drive_keys.h). */
#include "io/schema/tables/drive_keys.h"

#include "io/schema/rows.h"
#include "io/schema/tables/set_keys.h"

/* ---- paths ---- */

#define MOST_ANGLE 57240 /* degrees: 159 turns */
#define ANGLE      "through which it goes, counterclockwise"

static const CpsiKey PATH_ARC_KEYS[] = {
    {"centre", REQUIRED, POINT(PathArc, centre, 2), ANY, .unit = "m", .formerly = "center",
     .help = "of the circle"},
    {"angle", REQUIRED, NUMBER(PathArc, angle), -MOST_ANGLE, MOST_ANGLE, false, .unit = "degrees",
     .formerly = "turn", .instead = "in degrees, not in radians", .help = ANGLE},
};
static const CpsiMapping PATH_ARC = {"arc", "path_arc", KEYS(PATH_ARC_KEYS), INTO(PathArc)};

static const CpsiKey PATH_KEYS[] = {
    {"arc", REQUIRED, MAPPING(Path, arc), .inside = &PATH_ARC,
     .help = "an arc of a circle, as in {centre: [0, 0], angle: 90}"},
};
static const CpsiMapping PATH = {"path", KEYS(PATH_KEYS), INTO(Path)};

/* ---- systems ---- */

static const CpsiKey LAW_KEYS[] = {
    {"name", OPTIONAL, TEXT(SystemLaw, name, CPSI_DRIVE_LONGEST_TEXT),
     .help = "in answers; its number unless given"},
    {"on", REQUIRED, COMBINATIONS(SystemLaw, on), .help = "what it acts on, as in [side, roll]"},
    {"law", ONE_OF, EXPRESSION(SystemLaw, law), .inside = &cpsi_set_words,
     .help = "a friction law, in the words of law files"},
    {"resistance", ONE_OF, EXPRESSIONS(SystemLaw, resistance), .inside = &cpsi_term_words,
     .help = "terms of a resistance law, in the words of law files"},
};
static const CpsiMapping LAW = {"law", "system_law", KEYS(LAW_KEYS), INTO(SystemLaw),
                                .example = "{on: [omega], law: {interval: 60}}"};

static const CpsiKey SYSTEM_KEYS[] = {
    {"parameters", REQUIRED, NAMES(System, parameters, CPSI_DRIVE_MOST_PARAMETERS),
     .help = "names of the velocity parameters"},
    {"laws", REQUIRED, LIST(System, laws, 1), .inside = &LAW,
     .help = "laws, each on some parameters"},
    {"constraints", OPTIONAL, COMBINATIONS(System, constraints), .help = "combinations that are 0"},
    {"drive", OPTIONAL, COMBINATIONS(System, drive),
     .help = "combinations that are imposed, the driving velocity"},
    {"load", OPTIONAL, BY_NAME(System, load), .help = "constant forces dual to the parameters"},
    {"velocity", OPTIONAL, ROWS(System, velocity, 0), 1, CPS_SET_MAX_ITEMS, false,
     .help = "driving velocities to answer where none is asked on the command line"},
    {"map_radius", OPTIONAL, NUMBER(System, map_radius), POSITIVE,
     .help = "pictures show |W| up to it in both components; 1 unless given"},
};

static void begin_system(void *values) { ((CpsiSystemValues *)values)->map_radius = 1; }

static const CpsiMapping SYSTEM = {"system", KEYS(SYSTEM_KEYS), INTO(System),
                                   .begin = begin_system};

/* ---- bodies ---- */

/* The keys of every patch; friction and load are optional only for a point. */
#define PLACE_AND_LOAD(need)                                                                       \
    {"position", OPTIONAL,    POINT(Patch, patch.position, 2),                                     \
     ANY,        .unit = "m", .help = "[x, y] of the patch in body axes; [0, 0] unless given"},    \
        {"orientation",                                                                            \
         OPTIONAL,                                                                                 \
         NUMBER(Patch, orientation),                                                               \
         ANY,                                                                                      \
         .unit = "degrees",                                                                        \
         .formerly = "angle",                                                                      \
         .instead = "in degrees, not in radians",                                                  \
         .help = "angle by which it is turned, counterclockwise; 0 unless given"},                 \
        {"friction", need, NUMBER(Patch, patch.friction), NOT_NEGATIVE, .help = "coefficient"}, {  \
        "load", need, NUMBER(Patch, patch.load), NOT_NEGATIVE, .unit = "N", .help = "normal force" \
    }
#define TILT "slope of the pressure, mean x (1 + tilt . (r - centroid)); 0 unless given"

static void begin_patch(void *values) {
    CpsiPatchValues *patch = values;
    patch->patch = cps_patch_default();
    patch->patch.friction = patch->patch.load = NAN;
    patch->locked = -1;
}

static const CpsiKey POINT_PATCH_KEYS[] = {
    PLACE_AND_LOAD(OPTIONAL),
    {"law", OPTIONAL, EXPRESSION(Patch, law), .inside = &cpsi_set_words,
     .help = "a bounded law of two components, in place of friction and load"},
};
static const CpsiMapping POINT_PATCH = {
    "point", KEYS(POINT_PATCH_KEYS), INTO(Patch), .begin = begin_patch,
    .also =
        "\"oneOf\": [{\"required\": [\"friction\", \"load\"], \"not\": {\"required\": [\"law\"]}}, "
        "{\"required\": [\"law\"], "
        "\"not\": {\"anyOf\": [{\"required\": [\"friction\"]}, {\"required\": [\"load\"]}]}}]"};

static const CpsiKey WHEEL_PATCH_KEYS[] = {
    PLACE_AND_LOAD(REQUIRED),
    {"radius", REQUIRED, NUMBER(Patch, patch.size), POSITIVE, .unit = "m", .help = "of the wheel"},
    {"brake", OPTIONAL, WORD(Patch, locked), .words = "locked",
     .other = &(const CpsiKey){.type = NUMBER(Patch, patch.brake), NOT_NEGATIVE}, .unit = "N m",
     .help = "torque, or locked; 0 unless given: it rolls freely"},
};
static const CpsiMapping WHEEL_PATCH = {"wheel", KEYS(WHEEL_PATCH_KEYS), INTO(Patch),
                                        .begin = begin_patch,
                                        .example = "{radius: 0.3, friction: 0.8, load: 4000}"};

static const CpsiKey ROD_PATCH_KEYS[] = {
    PLACE_AND_LOAD(REQUIRED),
    {"half_length", REQUIRED, NUMBER(Patch, patch.size), POSITIVE, .unit = "m",
     .help = "half the length of the rod"},
    {"tilt", OPTIONAL, NUMBER(Patch, patch.tilt[0]), ANY, .unit = "1/m", .help = TILT},
};
static const CpsiMapping ROD_PATCH = {"rod", KEYS(ROD_PATCH_KEYS), INTO(Patch),
                                      .begin = begin_patch};

static const CpsiKey RING_PATCH_KEYS[] = {
    PLACE_AND_LOAD(REQUIRED),
    {"radius", REQUIRED, NUMBER(Patch, patch.size), POSITIVE, .unit = "m", .help = "of the ring"},
    {"tilt", OPTIONAL, POINT(Patch, patch.tilt, 2), ANY, .unit = "1/m", .help = TILT},
};
static const CpsiMapping RING_PATCH = {"ring", KEYS(RING_PATCH_KEYS), INTO(Patch),
                                       .begin = begin_patch};

static const CpsiKey DISC_PATCH_KEYS[] = {
    PLACE_AND_LOAD(REQUIRED),
    {"radius", REQUIRED, NUMBER(Patch, patch.size), POSITIVE, .unit = "m", .help = "of the disc"},
    {"tilt", OPTIONAL, POINT(Patch, patch.tilt, 2), ANY, .unit = "1/m", .help = TILT},
};
static const CpsiMapping DISC_PATCH = {"disc", KEYS(DISC_PATCH_KEYS), INTO(Patch),
                                       .begin = begin_patch};

static const CpsiKey POLYGON_PATCH_KEYS[] = {
    PLACE_AND_LOAD(REQUIRED),
    {"corners", REQUIRED, ROWS(Patch, corners, 2), 3, CPS_SET_MAX_ITEMS, false, .unit = "m",
     .help = "[[x, y], ..]"},
    {"tilt", OPTIONAL, POINT(Patch, patch.tilt, 2), ANY, .unit = "1/m", .help = TILT},
};
static const CpsiMapping POLYGON_PATCH = {"polygon", KEYS(POLYGON_PATCH_KEYS), INTO(Patch),
                                          .begin = begin_patch};

static const CpsiKey PATCH_KEYS[] = {
    {"point", ONE_OF, AROUND, .inside = &POINT_PATCH, .help = "a point"},
    {"wheel", ONE_OF, AROUND, .inside = &WHEEL_PATCH,
     .help = "a wheel that rolls along its first axis"},
    {"rod", ONE_OF, AROUND, .inside = &ROD_PATCH, .help = "a rod"},
    {"ring", ONE_OF, AROUND, .inside = &RING_PATCH, .help = "a circle"},
    {"disc", ONE_OF, AROUND, .inside = &DISC_PATCH, .help = "a disc"},
    {"polygon", ONE_OF, AROUND, .inside = &POLYGON_PATCH, .help = "a polygon"},
};
static const CpsiMapping PATCH = {"patch",
                                  KEYS(PATCH_KEYS),
                                  INTO(Patch),
                                  .begin = begin_patch,
                                  WHICH(Patch, patch.kind),
                                  .word = "patch",
                                  .example = "{disc: {radius: 1, friction: 0.5, load: 10}}"};

static const CpsiKey PUSH_KEYS[] = {
    {"at", OPTIONAL, POINT(Push, at, 2), ANY, .unit = "m",
     .help = "[x, y] of the point moved, in body axes"},
    {"velocity", OPTIONAL, POINT(Push, velocity, 2), ANY, .unit = "m/s", .help = "of that point"},
    {"normal", OPTIONAL, POINT(Push, normal, 2), ANY,
     .help = "direction in which alone it is moved; of any length but zero"},
    {"speed", OPTIONAL, NUMBER(Push, speed), ANY, .unit = "m/s", .help = "along the normal"},
    {"twist", OPTIONAL, POINT(Push, twist, 3), ANY, .unit = "m/s and rad/s",
     .help = "[vx, vy, w] of the body"},
};

static void begin_push(void *values) {
    CpsiPushValues *push = values;
    push->at[0] = push->velocity[0] = push->normal[0] = push->speed = push->twist[0] = NAN;
}

static const CpsiMapping PUSH = {
    "push",
    KEYS(PUSH_KEYS),
    INTO(Push),
    .begin = begin_push,
    .example = "{at: [1, 0], velocity: [0, 1]}",
    .also = "\"oneOf\": [{\"required\": [\"at\", \"velocity\"], \"maxProperties\": 2}, "
            "{\"required\": [\"at\", \"normal\", \"speed\"], "
            "\"maxProperties\": 3}, {\"required\": [\"twist\"], \"maxProperties\": 1}]"};

static const CpsiKey TOW_KEYS[] = {
    {"position", OPTIONAL, POINT(Tow, position, 2), ANY, .unit = "m", .formerly = "pose",
     .instead = "[x, y], and 'orientation', in degrees",
     .help = "[x, y] of the body where it starts; [0, 0] unless given"},
    {"orientation", OPTIONAL, NUMBER(Tow, orientation), ANY, .unit = "degrees",
     .help = "angle by which the body is turned there, counterclockwise; 0 unless given"},
    {"hitch", OPTIONAL, POINT(Tow, start.hitch, 2), ANY, .unit = "m",
     .help = "[x, y] in body axes; 0 unless given"},
    {"rope", OPTIONAL, NUMBER(Tow, start.rope), NOT_NEGATIVE, .unit = "m",
     .help = "length of a rope between hitch and end; 0 unless given"},
    {"end", OPTIONAL, POINT(Tow, end, 2), ANY, .with = "rope", .unit = "m",
     .help = "[x, y] where the rope's far end starts"},
    {"path", REQUIRED, ROWS(Tow, path.points, 0), 1, CPS_SET_MAX_ITEMS, false,
     .other = &(const CpsiKey){.type = MAPPING(Tow, path), .inside = &PATH},
     .help = "points that the hitch or the rope's end passes"},
    {"steps", REQUIRED, INTEGER(Tow, steps), 1, CPSI_DRIVE_MOST_STEPS, false,
     .help = "equal steps along the path"},
};

static void begin_tow(void *values) {
    CpsiTowValues *tow = values;
    tow->start = cps_tow_default();
    tow->end[0] = NAN;
}

static const CpsiMapping TOW = {"tow", KEYS(TOW_KEYS), INTO(Tow), .begin = begin_tow};

static const CpsiKey BODY_KEYS[] = {
    {"patches", REQUIRED, LIST(Body, patches, 1), .inside = &PATCH, .help = "what it stands on"},
    {"push", OPTIONAL, LIST(Body, pushes, 1), .inside = &PUSH,
     .help = "motions to answer, one at a time"},
    {"tow", OPTIONAL, MAPPING(Body, tow), .inside = &TOW, .help = "a path along which it is drawn"},
};
static const CpsiMapping BODY = {"body", KEYS(BODY_KEYS), INTO(Body)};

static const CpsiKey VEHICLE_KEYS[] = {
    {"wheels", REQUIRED, LIST(Body, patches, 1), .inside = &WHEEL_PATCH,
     .help = "what it stands on"},
    {"push", OPTIONAL, LIST(Body, pushes, 1), .inside = &PUSH,
     .help = "motions to answer, one at a time"},
    {"tow", OPTIONAL, MAPPING(Body, tow), .inside = &TOW, .help = "a path along which it is drawn"},
};
static const CpsiMapping VEHICLE = {"vehicle", KEYS(VEHICLE_KEYS), INTO(Body)};

/* ---- planimeters ---- */

static const CpsiKey CIRCLE_KEYS[] = {
    {"centre", REQUIRED, POINT(Circle, centre, 2), ANY, .unit = "m", .formerly = "center",
     .help = "of the circle"},
    {"radius", REQUIRED, NUMBER(Circle, radius), POSITIVE, .unit = "m", .help = "of the circle"},
    {"points", REQUIRED, INTEGER(Circle, points), 3, CPSI_DRIVE_MOST_STEPS, false,
     .help = "corners on it"},
};
static const CpsiMapping CIRCLE = {"circle", KEYS(CIRCLE_KEYS), INTO(Circle)};

static const CpsiKey CURVE_KEYS[] = {
    {"circle", ONE_OF, MAPPING(Curve, circle), .inside = &CIRCLE,
     .help = "a regular polygon on a circle"},
    {"file", ONE_OF, TEXT(Curve, file, 0), .help = "of x, y in each line, beside this one"},
};
static const CpsiMapping CURVE = {"curve", KEYS(CURVE_KEYS), INTO(Curve)};

static const CpsiKey PLANIMETER_KEYS[] = {
    {"pole", REQUIRED, POINT(Planimeter, planimeter.pole, 2), ANY, .unit = "m",
     .help = "where the pole is"},
    {"pole_arm", REQUIRED, NUMBER(Planimeter, planimeter.pole_arm), POSITIVE, .unit = "m",
     .help = "length"},
    {"tracer_arm", REQUIRED, NUMBER(Planimeter, planimeter.tracer_arm), POSITIVE, .unit = "m",
     .help = "length"},
    {"wheel", REQUIRED, NUMBER(Planimeter, planimeter.wheel), ANY, .unit = "m",
     .help = "from the hinge towards the tracer"},
    {"friction", REQUIRED, NUMBER(Planimeter, planimeter.friction), POSITIVE,
     .help = "coefficient of the wheel: what turns it is friction"},
    {"load", REQUIRED, NUMBER(Planimeter, planimeter.load), POSITIVE, .unit = "N",
     .help = "on the wheel"},
    {"left_elbow", OPTIONAL, FLAG(Planimeter, planimeter.left_elbow),
     .help = "the hinge lies left of the line from pole to tracer; false unless given"},
    {"curve", REQUIRED, ROWS(Planimeter, curve.points, 2), 3, CPS_SET_MAX_ITEMS, false,
     .other = &(const CpsiKey){.type = MAPPING(Planimeter, curve), .inside = &CURVE},
     .help = "closed curve that the tracer follows"},
    {"steps", OPTIONAL, INTEGER(Planimeter, steps), 1, 10000, false,
     .help = "on each side of the curve; 1 unless given"},
};

static void begin_planimeter(void *values) {
    CpsiPlanimeterValues *planimeter = values;
    planimeter->planimeter = cps_planimeter_default();
    planimeter->steps = 1;
}

static const CpsiMapping PLANIMETER = {"planimeter", KEYS(PLANIMETER_KEYS), INTO(Planimeter),
                                       .begin = begin_planimeter};

/* ---- ropes ---- */

static const CpsiKey STRAIGHT_KEYS[] = {
    {"from", REQUIRED, POINT(RopeStraight, from, 2), ANY, .unit = "m", .help = "first end"},
    {"to", REQUIRED, POINT(RopeStraight, to, 2), ANY, .unit = "m", .help = "last end"},
};
static const CpsiMapping STRAIGHT = {"straight", KEYS(STRAIGHT_KEYS), INTO(RopeStraight)};

static const CpsiKey ARC_KEYS[] = {
    {"from", REQUIRED, POINT(RopeArc, from, 2), ANY, .unit = "m", .formerly = "radius",
     .instead = "the point [x, y] where it begins", .help = "where end A is"},
    {"centre", REQUIRED, POINT(RopeArc, centre, 2), ANY, .unit = "m", .formerly = "center",
     .help = "of the circle"},
    {"angle", REQUIRED, NUMBER(RopeArc, angle), ANY, .unit = "degrees", .formerly = "turn",
     .instead = "in degrees, not in radians", .help = ANGLE},
};
static const CpsiMapping ARC = {"arc", KEYS(ARC_KEYS), INTO(RopeArc)};

static const CpsiKey SHAPE_KEYS[] = {
    {"straight", ONE_OF, MAPPING(RopeShape, straight), .inside = &STRAIGHT,
     .help = "a straight rope"},
    {"arc", ONE_OF, MAPPING(RopeShape, arc), .inside = &ARC, .help = "an arc of a circle"},
    {"polyline", ONE_OF, ROWS(RopeShape, polyline, 2), 2, CPS_SET_MAX_ITEMS, false, .unit = "m",
     .formerly = "points", .help = "straight pieces between these points"},
};
static const CpsiMapping SHAPE = {"shape", KEYS(SHAPE_KEYS), INTO(RopeShape)};

static const CpsiKey ENDS_KEYS[] = {
    {"A", OPTIONAL, WORD(Rope, end[0]), .words = "free held",
     .other = &(const CpsiKey){.type = POINT(Rope, velocity[0], 2), ANY},
     .help = "the first end likewise; free unless given"},
    {"B", REQUIRED, WORD(Rope, end[1]), .words = "free held",
     .other = &(const CpsiKey){.type = POINT(Rope, velocity[1], 2), ANY}, .unit = "m/s",
     .help = "velocity [vx, vy] of the last end"},
};
static const CpsiMapping ENDS = {"ends", KEYS(ENDS_KEYS)};

static const CpsiKey ROPE_KEYS[] = {
    {"shape", REQUIRED, MAPPING(Rope, shape), .inside = &SHAPE,
     .help = "{straight: ..}, {arc: ..} or {polyline: ..}"},
    {"elements", OPTIONAL, INTEGER(Rope, elements), 1, CPSI_DRIVE_MOST_ELEMENTS, false,
     .help = "straight ones, of equal length; 100 unless given"},
    {"friction", REQUIRED, NUMBER(Rope, friction), POSITIVE, .help = "coefficient"},
    {"weight", REQUIRED, NUMBER(Rope, weight), POSITIVE, .unit = "N/m",
     .help = "weight per length"},
    {"ends", REQUIRED, AROUND, .inside = &ENDS,
     .help = "what the ends do, as in {A: held, B: [1, 0]}"},
    {"slack", OPTIONAL, FLAG(Rope, slack),
     .help = "may elements become shorter, without tension?  Unless true, the velocity keeps "
             "every length"},
    {"path", OPTIONAL, ROWS(Rope, path.points, 0), 1, CPS_SET_MAX_ITEMS, false,
     .other = &(const CpsiKey){.type = MAPPING(Rope, path), .inside = &PATH},
     .help = "points that end B then passes"},
    {"steps", OPTIONAL, INTEGER(Rope, steps), 1, 10000, false,
     .help = "load steps along the path; 40 unless given"},
    {"shots", OPTIONAL, INTEGER(Rope, shots), 1, 24, false,
     .help = "shapes along the path in the picture; 6 unless given"},
};

static void begin_rope(void *values) {
    CpsiRopeValues *rope = values;
    rope->elements = 100;
    rope->steps = 40;
    rope->shots = 6;
    rope->velocity[0][0] = rope->velocity[1][0] = NAN;
}

static const CpsiMapping ROPE = {"rope", KEYS(ROPE_KEYS), INTO(Rope), .begin = begin_rope};

/* ---- sweeps, and the file ---- */

static const CpsiKey SWEEP_KEYS[] = {
    {"law", REQUIRED, EXPRESSION(Sweep, law), .inside = &cpsi_set_words,
     .help = "friction law of the block, 1 or 2 components"},
    {"stiffness", REQUIRED, NUMBER(Sweep, stiffness), POSITIVE, .unit = "N/m",
     .help = "of the spring"},
    {"position", OPTIONAL, VECTOR(Sweep, position, 2), ANY, .unit = "m",
     .help = "where the block is at first; 0 unless given"},
    {"end", OPTIONAL, VECTOR(Sweep, end, 2), ANY, .unit = "m",
     .help = "where the spring's far end is at first; where the block is unless given"},
    {"path", REQUIRED, ROWS(Sweep, path.points, 0), 1, CPS_SET_MAX_ITEMS, false,
     .other = &(const CpsiKey){.type = MAPPING(Sweep, path), .inside = &PATH},
     .help = "points that the spring's far end passes"},
    {"steps", REQUIRED, INTEGER(Sweep, steps), 1, CPSI_DRIVE_MOST_STEPS, false,
     .help = "equal steps along the path"},
};
static const CpsiMapping SWEEP = {"sweep", KEYS(SWEEP_KEYS), INTO(Sweep)};

static const CpsiKey FILE_KEYS[] = {
    {"capstan", REQUIRED, INTEGER(Drive, version), 1, 1, false,
     .help = "version of this file format"},
    {"title", OPTIONAL, TEXT(Drive, title, CPSI_DRIVE_LONGEST_TEXT),
     .help = "heading of answers and pictures"},
    {"system", ONE_OF, MAPPING(Drive, system), .inside = &SYSTEM,
     .help = "laws on combinations of velocity parameters"},
    {"body", ONE_OF, MAPPING(Drive, body), .inside = &BODY,
     .help = "a body that slides on a plane"},
    {"vehicle", ONE_OF, MAPPING(Drive, vehicle), .inside = &VEHICLE, .help = "a body on wheels"},
    {"planimeter", ONE_OF, MAPPING(Drive, planimeter), .inside = &PLANIMETER,
     .help = "a polar planimeter that follows a closed curve"},
    {"rope", ONE_OF, MAPPING(Drive, rope), .inside = &ROPE,
     .help = "a rope on a table, pulled at its ends"},
    {"sweep", ONE_OF, MAPPING(Drive, sweep), .inside = &SWEEP,
     .help = "a block on a spring, drawn along a path"},
};

static void begin_file(void *values) { ((CpsiDriveValues *)values)->title = ""; }

const CpsiMapping cpsi_drive_file = {"drive file",        "file",
                                     KEYS(FILE_KEYS),     INTO(Drive),
                                     .begin = begin_file, WHICH(Drive, kind)};
