/* SPDX-License-Identifier: BSD-3-Clause */
/* The tables of the keys of loads (load_keys.h). */
#include "io/schema/loads/load_keys.h"

#include "io/schema/rows.h"

static const CpsiKey SPRING_KEYS[] = {
    {"stiffness", REQUIRED, POINT(Spring, stiffness, 3), NOT_NEGATIVE,
     .help = "along x, y and z: N/m per metre of unstretched line; of a single spring N/m"},
    {"coupling", OPTIONAL, POINT(Spring, coupling, 3), ANY, .fallback = "[0, 0, 0]",
     .help = "of xy, xz, yz, in the same unit: a quadratic field whose axes are others"},
    {"at", OPTIONAL, NUMBER(Spring, at), NOT_NEGATIVE, .unit = "m",
     .help = "unstretched length from end A of a single spring, at the nearest node"},
    {"from", OPTIONAL, NUMBER(Spring, from), NOT_NEGATIVE, .unless = "at", .unit = "m",
     .fallback = "0", .help = "unstretched length from end A at which the springs begin"},
    {"to", OPTIONAL, NUMBER(Spring, to), POSITIVE, .unless = "at", .unit = "m",
     .help = "where they end; without it at end B"},
    {"place", OPTIONAL, POINT(Spring, place, 3), ANY, .unit = "m",
     .help = "where the springs are without force; without it where each node starts"},
};

static void begin_spring(void *values) {
    CpsiSpringValues *spring = values;
    spring->at = spring->from = spring->to = spring->place[0] = NAN;
}

const CpsiMapping cpsi_spring_keys = {"spring", KEYS(SPRING_KEYS), INTO(Spring),
                                      .begin = begin_spring};

static const CpsiKey FORCE_KEYS[] = {
    {"force", REQUIRED, POINT(Force, force, 3), ANY, .unit = "N/m",
     .help = "force per metre of unstretched line"},
    {"from", OPTIONAL, NUMBER(Force, from), NOT_NEGATIVE, .unit = "m", .fallback = "0",
     .help = "unstretched length from end A at which it begins"},
    {"to", OPTIONAL, NUMBER(Force, to), POSITIVE, .unit = "m",
     .help = "where it ends; without it at end B"},
};

static void begin_force(void *values) {
    CpsiForceValues *force = values;
    force->from = force->to = NAN;
}

const CpsiMapping cpsi_force_keys = {"load", KEYS(FORCE_KEYS), INTO(Force), .begin = begin_force};

static const CpsiKey DRAG_KEYS[] = {
    {"diameter", REQUIRED, NUMBER(Drag, drag.diameter), POSITIVE, .unit = "m",
     .help = "that both coefficients are for"},
    {"normal", REQUIRED, NUMBER(Drag, drag.normal), NOT_NEGATIVE,
     .help = "coefficient across the line, on its diameter"},
    {"tangential", OPTIONAL, NUMBER(Drag, drag.tangential), NOT_NEGATIVE, .fallback = "0",
     .help = "along the line, on its circumference"},
    {"added_normal", OPTIONAL, NUMBER(Drag, drag.added_normal), NOT_NEGATIVE, .fallback = "0",
     .help = "in time: mass of water that goes along across the line, over that displaced"},
    {"added_tangential", OPTIONAL, NUMBER(Drag, drag.added_tangential), NOT_NEGATIVE,
     .fallback = "0", .help = "in time: the same along the line"},
};
const CpsiMapping cpsi_drag_keys = {"drag", KEYS(DRAG_KEYS), INTO(Drag)};

static const CpsiKey CURRENT_KEYS[] = {
    {"z", REQUIRED, NUMBER(Current, row.z), ANY, .unit = "m", .help = "height"},
    {"velocity", REQUIRED, POINT(Current, row.velocity, 3), ANY, .unit = "m/s",
     .help = "of the water there"},
};
const CpsiMapping cpsi_current_keys = {"row of the current", KEYS(CURRENT_KEYS), INTO(Current)};
