/* SPDX-License-Identifier: BSD-3-Clause */
/* A body towed over the plane: quasi-static steps with finite rotations, and their ledger.
 *
 * In one step the body makes a screw motion: its twist is constant in its own axes, so every
 * contact moves at constant velocity over its patch, and the dissipation of the finite motion is
 * exactly phi of the increment. With theta the total angle, a point that moves by u in body axes is
 * displaced by the chord c = sinc(theta/2) R(angle + theta/2) u. The increment is the one of least
 * dissipation whose chord brings the hitch to its target, or to the rope's length from there. With
 * a0, a1 from the position of the hitch before the step to the rope's far end before and after
 * it,
 *
 *     |a1 - c|^2 = rope^2   <=>   e.c = e.(a1 - a0) - (rope^2 - |a0|^2)/2,     e = (a0 + a1 - c)/2:
 *
 * e is the rope in the middle of the step, along which it pulls. theta and c on the right are those
 * of the preceding pass. A pass changes them by the order of the step, so a few passes converge,
 * and the step is of second order (with the first pass alone: of first). */
#include <math.h>

#include "base/status.h"
#include "planar/planar.h"

/* Passes that change the motion by no more than this share have converged. Where they do not
 * converge, the motion is discontinuous in the orientation, or the step is as long as the body. */
static const double CONVERGED = 1e-13;
enum { PASSES = 25 };

/* A step that turns the body farther is refused, since its chord says little about its path. */
static const double MOST_TURN = 2;

/* The orientation in the middle of a screw motion, and the ratio of a chord to its arc. */
typedef struct Middle {
    double angle, sinc;
} Middle;

static Middle middle_of(double angle, double turned) {
    const double half = 0.5 * turned;
    return (Middle){.angle = angle + half, .sinc = half != 0 ? sin(half) / half : 1};
}

/* From body axes into the plane, or back with -angle. */
static void turn(double angle, const double v[2], double out[2]) {
    const double x = cos(angle) * v[0] - sin(angle) * v[1],
                 y = sin(angle) * v[0] + cos(angle) * v[1];
    out[0] = x;
    out[1] = y;
}

/* Displacement in the plane of the point r of the body by a screw motion. */
static void displacement(Middle middle, const double twist[3], const double r[2], double chord[2]) {
    const double arc[2] = {twist[0] - twist[2] * r[1], twist[1] + twist[2] * r[0]};
    turn(middle.angle, (double[2]){middle.sinc * arc[0], middle.sinc * arc[1]}, chord);
}

void cps_planar_move(double pose[3], const double twist[3]) {
    if (!pose || !twist) return;
    double chord[2];
    displacement(middle_of(pose[2], twist[2]), twist, (double[2]){0, 0}, chord);
    for (int i = 0; i < 2; i++) pose[i] += chord[i];
    pose[2] += twist[2];
}

enum { TOW_COOKIE = 0x70ed1a5e };

CpsTow cps_tow_default(void) { return (CpsTow){.cookie = TOW_COOKIE}; }

static CpsStatus check(const CpsTow *tow, const double target[2], CpsError *err) {
    if (tow->cookie != TOW_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the tow was not made by cps_tow_default()");
    const double state[10] = {tow->pose[0],  tow->pose[1],   tow->pose[2], tow->hitch[0],
                              tow->hitch[1], tow->rope,      tow->end[0],  tow->end[1],
                              tow->work,     tow->dissipated};
    CpsStatus status = cpsi_law_check_vector("tow", 10, state, err);
    if (status == CPS_OK) status = cpsi_law_check_vector("target", 2, target, err);
    if (status == CPS_OK && !(tow->rope >= 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the rope is %g m long, expected at least 0",
                         tow->rope);
    return status;
}

/* a0 and a1: from the hitch before the step to the rope's far end (without a rope: to the target)
 * before and after it. */
typedef struct Pull {
    double before[2], after[2];
} Pull;

/* One pass: the increment for the middle and the chord of the preceding pass. */
static CpsStatus drive_step(const CpsPlanar *body, const CpsTow *tow, const Pull *pull_of_end,
                            Middle middle, const double chord[2], CpsPlanarMotion *motion,
                            CpsError *err) {
    const double x = tow->hitch[0], y = tow->hitch[1], *a0 = pull_of_end->before,
                 *a1 = pull_of_end->after;
    double local[2];
    if (tow->rope > 0) {
        const double e[2] = {0.5 * (a0[0] + a1[0] - chord[0]), 0.5 * (a0[1] + a1[1] - chord[1])},
                     length = hypot(e[0], e[1]);
        const double slack = 0.5 * (tow->rope * tow->rope - a0[0] * a0[0] - a0[1] * a0[1]);
        const double pull =
            (e[0] * (a1[0] - a0[0]) + e[1] * (a1[1] - a0[1]) - slack) / (length * middle.sinc);
        turn(-middle.angle, (double[2]){e[0] / length, e[1] / length}, local);
        return cps_planar_drive(body, 1,
                                (double[3]){local[0], local[1], x * local[1] - y * local[0]}, &pull,
                                motion, err);
    }
    turn(-middle.angle, (double[2]){a1[0] / middle.sinc, a1[1] / middle.sinc}, local);
    return cps_planar_drive(body, 2, (double[6]){1, 0, -y, 0, 1, x}, local, motion, err);
}

/* Passes until motion, middle and chord agree. */
static CpsStatus iterate(const CpsPlanar *body, const CpsTow *tow, const Pull *pull_of_end,
                         CpsTowStep *step, CpsError *err) {
    const double length = hypot(pull_of_end->after[0], pull_of_end->after[1]) + tow->rope;
    double chord[2] = {0, 0};
    Middle middle = middle_of(tow->pose[2], 0);
    for (int pass = 0; pass < PASSES && !step->converged; pass++) {
        CpsPlanarMotion motion;
        const CpsStatus status = drive_step(body, tow, pull_of_end, middle, chord, &motion, err);
        if (status != CPS_OK) return status;
        step->outcome =
            fabs(motion.twist[2]) <= MOST_TURN ? motion.outcome : CPS_SET_OUTCOME_INACCURATE;
        if (step->outcome != CPS_SET_OUTCOME_ANSWERED) return CPS_OK;

        const double last[2] = {chord[0], chord[1]}, turned = step->twist[2];
        middle = middle_of(tow->pose[2], motion.twist[2]);
        displacement(middle, motion.twist, tow->hitch, chord);
        step->converged = fabs(motion.twist[2] - turned) <= CONVERGED &&
                          hypot(chord[0] - last[0], chord[1] - last[1]) <= CONVERGED * length;

        /* the driver pulls against friction, whose moment about the hitch is 0 */
        turn(middle.angle, (double[2]){-motion.wrench[0], -motion.wrench[1]}, step->force);
        for (int i = 0; i < 3; i++) step->twist[i] = motion.twist[i];
        step->work = step->force[0] * chord[0] + step->force[1] * chord[1];
        step->dissipated = 0.5 * (motion.lower + motion.upper);
        step->lower = motion.lower;
        step->upper = motion.upper;
    }
    return CPS_OK;
}

CpsStatus cps_planar_tow(const CpsPlanar *body, CpsTow *tow, const double target[2],
                         CpsTowStep *step, CpsError *err) {
    if (!body || !tow || !step)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "body, tow or step is NULL");
    CpsStatus status = check(tow, target, err);
    if (status != CPS_OK) return status;
    double arm[2];
    turn(tow->pose[2], tow->hitch, arm);
    const double hitch[2] = {tow->pose[0] + arm[0], tow->pose[1] + arm[1]};
    const Pull pull_of_end = {.before = {tow->end[0] - hitch[0], tow->end[1] - hitch[1]},
                              .after = {target[0] - hitch[0], target[1] - hitch[1]}};

    CpsTowStep out = {.outcome = CPS_SET_OUTCOME_ANSWERED,
                      .pulled = hypot(pull_of_end.after[0], pull_of_end.after[1]) > tow->rope};
    if (out.pulled) status = iterate(body, tow, &pull_of_end, &out, err);
    if (status != CPS_OK) return status;
    if (out.outcome == CPS_SET_OUTCOME_ANSWERED) {
        out.converged |= !out.pulled;
        cps_planar_move(tow->pose, out.twist);
        for (int i = 0; i < 2; i++) tow->end[i] = target[i];
        tow->work += out.work;
        tow->dissipated += out.dissipated;
    } else {
        out = (CpsTowStep){.outcome = out.outcome};
    }
    *step = out;
    return CPS_OK;
}
