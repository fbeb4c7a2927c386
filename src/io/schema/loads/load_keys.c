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

static const CpsiKey MEMBER_KEYS[] = {
    {"from", REQUIRED, POINT(Member, member.from, 3), ANY, .unit = "m",
     .help = "one end, in the axes of the body"},
    {"to", REQUIRED, POINT(Member, member.to, 3), ANY, .unit = "m", .help = "the other end"},
    {"diameter", REQUIRED, NUMBER(Member, member.diameter), POSITIVE, .unit = "m",
     .help = "of the cylinder, that the coefficients are for"},
    {"normal", REQUIRED, NUMBER(Member, member.normal), NOT_NEGATIVE,
     .help = "coefficient of drag across it, on its diameter"},
    {"tangential", OPTIONAL, NUMBER(Member, member.tangential), NOT_NEGATIVE, .fallback = "0",
     .help = "of drag along it, on its circumference"},
    {"added_normal", OPTIONAL, NUMBER(Member, member.added_normal), NOT_NEGATIVE, .fallback = "0",
     .help = "in time: mass of water that goes along across it, over that displaced"},
    {"strips", OPTIONAL, INTEGER(Member, member.strip_count), 1, CPS_MAX_STRIPS, false,
     .fallback = "20", .help = "pieces of equal length, each with the load of its middle"},
};
const CpsiMapping cpsi_member_keys = {"member", KEYS(MEMBER_KEYS), INTO(Member)};

static const CpsiKey CURRENT_KEYS[] = {
    {"z", REQUIRED, NUMBER(Current, row.z), ANY, .unit = "m", .help = "height"},
    {"velocity", REQUIRED, POINT(Current, row.velocity, 3), ANY, .unit = "m/s",
     .help = "of the water there"},
};
const CpsiMapping cpsi_current_keys = {"row of the current", KEYS(CURRENT_KEYS), INTO(Current)};

static const CpsiKey WAVE_KEYS[] = {
    {"amplitude", REQUIRED, NUMBER(Wave, amplitude), POSITIVE, .unit = "m",
     .help = "half of the height between trough and crest"},
    {"period", REQUIRED, NUMBER(Wave, period), POSITIVE, .unless = "frequency", .unit = "s",
     .help = "time from crest to crest in one place"},
    {"frequency", OPTIONAL, NUMBER(Wave, frequency), POSITIVE, .unless = "period", .unit = "Hz",
     .help = "1 over the period, in its place"},
    {"direction", REQUIRED, NUMBER(Wave, direction), ANY, .unit = "degree",
     .help = "in which it goes, from the x axis towards the y axis"},
    {"phase", OPTIONAL, NUMBER(Wave, phase), ANY, .unit = "degree", .fallback = "0",
     .help = "0: a crest over x = y = 0 as the history begins; 90: the surface sinks there"},
};

static void begin_wave(void *values) {
    CpsiWaveValues *wave = values;
    wave->period = wave->frequency = NAN;
}
static const CpsiMapping WAVE = {"component", KEYS(WAVE_KEYS), INTO(Wave), .begin = begin_wave};

static const CpsiKey WAVES_KEYS[] = {
    {"depth", REQUIRED, NUMBER(Waves, depth), 0, INFINITY, true, .unit = "m",
     .help = "of the water below water_surface; .inf: deep water"},
    {"components", REQUIRED, LIST(Waves, components, 1), .inside = &WAVE, .unless = "file",
     .help = "waves of one period each, whose motions add up; one is a regular wave"},
    {"file", OPTIONAL, TEXT(Waves, file, 0), .unless = "components",
     .help = "CSV file beside the scene with the components: columns amplitude, period or "
             "frequency, direction and phase, in the units of these keys"},
    {"ramp", OPTIONAL, NUMBER(Waves, ramp), NOT_NEGATIVE, .unit = "s", .fallback = "0",
     .help = "time from the beginning of the history in which they grow to their amplitudes"},
};
const CpsiMapping cpsi_waves_keys = {"waves", KEYS(WAVES_KEYS), INTO(Waves)};
