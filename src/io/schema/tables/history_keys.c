/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of the keys of an entry of a scene's history (see scene_keys.h). */
#include "io/schema/rows.h"
#include "io/schema/tables/scene_keys.h"

/* An oscillation beside a value, or by itself: `at` is where the struct has it. */
#define SINES(kind, at)                                                                       \
    {"sine",                                                                                  \
     OPTIONAL,                                                                                \
     POINT(kind, at sine, 3),                                                                 \
     ANY,                                                                                     \
     .with = "period",                                                                        \
     .fallback = "[0, 0, 0]",                                                                 \
     .help = "in an entry with a duration, beside the way to the value: this times sin(2 pi " \
             "t/period), in m of a position and N of a force"},                               \
    {                                                                                         \
        "cosine", OPTIONAL, POINT(kind, at cosine, 3), ANY,                                   \
            .with = "period", .fallback = "[0, 0, 0]",                                        \
            .help = "... and this times 1 - cos(2 pi t/period)"                               \
    }
#define PERIOD(kind, at, need)                                                             \
    {                                                                                      \
        "period", need, NUMBER(kind, at period), POSITIVE,                                 \
            .unit = "s", .help = "of the oscillation; t is the time since the entry began" \
    }
#define SEVERAL(kind, keys)                                                           \
    {                                                                                 \
        "oscillations", OPTIONAL, LIST(kind, oscillations, 0),                        \
            .inside = &keys, .fallback = "[]",                                        \
            .help = "in an entry with a duration: several oscillations, which add up" \
    }

#define SERIES(kind)                                                                             \
    {                                                                                            \
        "series", OPTIONAL, TEXT(kind, series, 0),                                               \
            .help = "in an entry with a duration, beside the way to the value: CSV file beside " \
                    "the scene with the columns time and x, y, z (m; of a body rx, ry, rz in "   \
                    "degrees) of a place, fx, fy, fz (N; of a body mx, my, mz) of a load"        \
    }

static const CpsiKey SWAY_KEYS[] = {SINES(Sway, ), PERIOD(Sway, , REQUIRED)};
static const CpsiMapping SWAY = {"oscillation", KEYS(SWAY_KEYS), INTO(Sway)};

static const CpsiKey BODY_SWAY_KEYS[] = {
    SINES(Sway, ),
    {"rotation_sine", OPTIONAL, POINT(Sway, rotation_sine, 3), ANY, .unit = "degrees",
     .unless = "moment_sine", .fallback = "[0, 0, 0]",
     .help = "of a held body: the rotation vector that turns it further, about the scene's axes"},
    {"rotation_cosine", OPTIONAL, POINT(Sway, rotation_cosine, 3), ANY, .unit = "degrees",
     .unless = "moment_cosine", .fallback = "[0, 0, 0]", .help = "likewise"},
    {"moment_sine", OPTIONAL, POINT(Sway, moment_sine, 3), ANY, .unit = "N m",
     .fallback = "[0, 0, 0]", .help = "of a free body: added to the moment"},
    {"moment_cosine", OPTIONAL, POINT(Sway, moment_cosine, 3), ANY, .unit = "N m",
     .fallback = "[0, 0, 0]", .help = "likewise"},
    PERIOD(Sway, , REQUIRED),
};
static const CpsiMapping BODY_SWAY = {"oscillation", KEYS(BODY_SWAY_KEYS), INTO(Sway),
                                      .definition = "body_oscillation"};

static const CpsiKey CHANGE_KEYS[] = {
    {"position", ONE_OF, POINT(Change, value, 3), ANY, .unit = "m",
     .help = "move the end to this position; a free end is grabbed where it is"},
    {"move", ONE_OF, POINT(Change, value, 3), ANY, .unit = "m",
     .help = "move the end by this much from where the entry before has put it"},
    {"force", ONE_OF, POINT(Change, value, 3), ANY, .unit = "N",
     .help = "pull with this force; a held end is let go, from the force it carries"},
    {"release", ONE_OF, FLAG(Change, yes),
     .help = "true: let the end go at once, without force, also from its point"},
    SINES(Change, sway.),
    PERIOD(Change, sway., OPTIONAL),
    SEVERAL(Change, SWAY),
    SERIES(Change),
};

static void begin_change(void *values) { ((CpsiChangeValues *)values)->sway.period = NAN; }

static const CpsiMapping CHANGE = {"change", KEYS(CHANGE_KEYS), INTO(Change), .begin = begin_change,
                                   WHICH(Change, kind)};

static const CpsiKey POINT_CHANGE_KEYS[] = {
    {"position", ONE_OF, POINT(Change, value, 3), ANY, .unit = "m",
     .help = "move the point to this position; a free one is grabbed where it is"},
    {"move", ONE_OF, POINT(Change, value, 3), ANY, .unit = "m",
     .help = "move it by this much from where the entry before has put it"},
    {"force", ONE_OF, POINT(Change, value, 3), ANY, .unit = "N",
     .help = "pull it with this force; a held one is let go, from the force that holds it"},
    SINES(Change, sway.),
    PERIOD(Change, sway., OPTIONAL),
    SEVERAL(Change, SWAY),
    SERIES(Change),
};
static const CpsiMapping POINT_CHANGE = {"change",
                                         KEYS(POINT_CHANGE_KEYS),
                                         INTO(Change),
                                         .definition = "point_change",
                                         .begin = begin_change,
                                         WHICH(Change, kind)};

static const CpsiKey ROTATION_KEYS[] = {
    {"quaternion", ONE_OF, POINT(Rotation, quaternion, 4), ANY,
     .help = "w, x, y, z: by the angle 2 acos(w) about (x, y, z); of any length but zero"},
    {"roll_pitch_yaw", ONE_OF, POINT(Rotation, angle, 3), ANY, .unit = "degrees",
     .help = "yaw about z, then pitch about the y axis so turned, then roll about the x axis so "
             "turned, each by the right-hand rule"},
};
const CpsiMapping cpsi_rotation_keys = {"rotation", KEYS(ROTATION_KEYS), INTO(Rotation),
                                        WHICH(Rotation, form)};

static const CpsiKey BODY_CHANGE_KEYS[] = {
    {"position", OPTIONAL, POINT(BodyChange, position, 3), ANY, .unit = "m",
     .help = "hold the body, and move its reference point to this position"},
    {"move", OPTIONAL, POINT(BodyChange, move, 3), ANY, .unit = "m", .unless = "position",
     .help = "move it by this much from where the entry before has put it"},
    {"rotation", OPTIONAL, MAPPING(BodyChange, rotation), .inside = &cpsi_rotation_keys,
     .help = "hold the body, and turn it to this rotation, the short way about one axis"},
    {"force", OPTIONAL, POINT(BodyChange, force, 3), ANY, .unit = "N", .fallback = "[0, 0, 0]",
     .help = "load the body; one that is held is let go, from the load that holds it"},
    {"moment", OPTIONAL, POINT(BodyChange, moment, 3), ANY, .unit = "N m", .fallback = "[0, 0, 0]",
     .help = "moment about its reference point, likewise"},
    {"arm", OPTIONAL, POINT(BodyChange, arm, 3), ANY, .unit = "m", .with = "force",
     .fallback = "[0, 0, 0]",
     .help = "from its reference point to where the force acts, in the scene's axes, whatever its "
             "rotation: the moment gains arm x force"},
    SEVERAL(BodyChange, BODY_SWAY),
    SERIES(BodyChange),
};
static const CpsiMapping BODY_CHANGE = {
    "change", KEYS(BODY_CHANGE_KEYS), INTO(BodyChange), .definition = "body_change",
    .also = "\"oneOf\": [{\"anyOf\": [{\"required\": [\"position\"]}, {\"required\": [\"move\"]}, "
            "{\"required\": [\"rotation\"]}]}, {\"anyOf\": [{\"required\": [\"force\"]}, "
            "{\"required\": [\"moment\"]}]}]"};
static const CpsiKey GRASP_KEYS[] = {
    {"at", REQUIRED, NUMBER(Grasp, at), NOT_NEGATIVE, .unit = "m",
     .help = "natural length from end A; the node between the ends that is nearest is grasped"},
    {"position", ONE_OF, POINT(Grasp, value, 3), ANY, .unit = "m",
     .help = "hold the node where it is, and move it to this position"},
    {"hold", ONE_OF, FLAG(Grasp, yes), .help = "true: hold the node where it is"},
    {"force", ONE_OF, POINT(Grasp, value, 3), ANY, .unit = "N",
     .help = "pull it with this force; one that is held is let go, from the force that holds it"},
    {"release", ONE_OF, FLAG(Grasp, yes), .help = "true: let the node go at once, without force"},
};
static const CpsiMapping GRASP = {"grasp", KEYS(GRASP_KEYS), INTO(Grasp), WHICH(Grasp, kind)};

static const CpsiKey SHIFT_KEYS[] = {
    {"move", OPTIONAL, POINT(Shift, move, 3), ANY, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "move the obstacle by this much in this entry; what sticks to it moves with it"},
    {"turn", OPTIONAL, NUMBER(Shift, turn), ANY, .unit = "degrees", .with = "axis",
     .help = "turn it by so much, by the right-hand rule about the axis given"},
    {"axis", OPTIONAL, POINT(Shift, axis, 3), ANY, .with = "turn",
     .help = "direction of the axis that it turns about, of any length but zero"},
    {"about", OPTIONAL, POINT(Shift, about, 3), ANY, .unit = "m", .with = "turn",
     .fallback = "[0, 0, 0]",
     .help = "a point of that axis as the entry begins; a move takes it along"},
};

static void begin_shift(void *values) { ((CpsiShiftValues *)values)->turn = NAN; }

static const CpsiMapping SHIFT = {
    "change",
    KEYS(SHIFT_KEYS),
    INTO(Shift),
    .definition = "obstacle_change",
    .begin = begin_shift,
    .also = "\"anyOf\": [{\"required\": [\"move\"]}, {\"required\": [\"turn\"]}]"};

static const CpsiKey STAGE_KEYS[] = {
    {"name", OPTIONAL, TEXT(Stage, stage.name, 0),
     .help = "name of the entry in the results; by default its number"},
    {"steps", OPTIONAL, INTEGER(Stage, stage.step_count), 1, 1e6, false, .fallback = "1",
     .help = "go there in so many equal load steps"},
    {"duration", OPTIONAL, NUMBER(Stage, stage.duration), POSITIVE, .unit = "s",
     .help =
         "take the entry in time: lines move with their mass; without it steps are quasi-static "
         "and leave the lines at rest"},
    {"time_step", OPTIONAL, NUMBER(Stage, time_step), POSITIVE, .unit = "s", .with = "duration",
     .unless = "steps",
     .help = "length that the steps of the duration shall not exceed, instead of their number"},
    {"error", OPTIONAL, NUMBER(Stage, stage.error), POSITIVE, .unit = "m", .with = "time_step",
     .help = "shorten the steps such that none makes a larger error of places by its estimate"},
    {"gravity", OPTIONAL, POINT(Stage, stage.gravity, 3), ANY, .unit = "m/s2",
     .help = "what gravity becomes in this entry, evenly over its steps; the weight of all "
             "lines goes with it"},
    {"LINE.END", OPTIONAL, OWNED(Stage, changes), .owner = "lines", .after = "A B",
     .inside = &CHANGE,
     .help = "what happens to an end of a line, as in cable.B; all other ends stay as they are"},
    {"LINE.node", OPTIONAL, OWNED(Stage, grasps), .owner = "lines",
     .after = "node node2 node3 node4", .inside = &GRASP,
     .help =
         "what happens to a node between the ends of a line, as in cable.node; to others of the "
         "same line in the same entry cable.node2 to cable.node4"},
    {"LINE.pay_out", OPTIONAL, OWNED_NUMBERS(Stage, pay_outs), ANY, .owner = "lines",
     .after = "pay_out_A pay_out_B", .unit = "m",
     .help = "length that the winch at end A or B of a line pays out in this entry, as in "
             "cable.pay_out_B; negative: hauls in"},
    {"OBSTACLE.turn", OPTIONAL, OWNED_NUMBERS(Stage, turns), ANY, .owner = "obstacles",
     .after = "turn", .unit = "degrees",
     .help = "turn a cylinder or ball by so much in this entry, as in drum.turn, by the "
             "right-hand rule about its axis"},
    {"POINT.point", OPTIONAL, OWNED(Stage, point_changes), .owner = "points", .after = "point",
     .inside = &POINT_CHANGE,
     .help = "what happens to a point where lines meet, as in knot.point; all others stay as they "
             "are"},
    {"BODY.body", OPTIONAL, OWNED(Stage, body_changes), .owner = "bodies", .after = "body",
     .inside = &BODY_CHANGE,
     .help = "what happens to a body, as in spar.body; all others stay as they are"},
    {"OBSTACLE.obstacle", OPTIONAL, OWNED(Stage, shifts), .owner = "obstacles", .after = "obstacle",
     .inside = &SHIFT,
     .help = "how an obstacle moves, as in bollard.obstacle; all others stay where they are"},
    {"stiffness", OPTIONAL, WORD(Stage, stiffness), .words = "dynamic static",
     .fallback = "\"dynamic\"",
     .help = "by which stiffness lines stretch that have a dynamic one: by it, about the state "
             "reached before, or slowly, by the static one"},
};

static void begin_stage(void *values) {
    CpsStage *stage = &((CpsiStageValues *)values)->stage;
    *stage = cps_stage_default();
    ((CpsiStageValues *)values)->time_step = NAN;
    stage->gravity[0] = NAN; /* not given */
}

const CpsiMapping cpsi_stage_keys = {"entry", KEYS(STAGE_KEYS), INTO(Stage), .begin = begin_stage};
