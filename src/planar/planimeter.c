/* SPDX-License-Identifier: BSD-3-Clause */
/* Polar planimeter: the area enclosed by a curve, from the rotation of a wheel without resistance
 * to rolling (M77 section 10).
 *
 * The tracer arm sweeps the area L (dn + (L/2 - k) dbeta), n the roll of a wheel at k from the
 * hinge, beta the arm's heading; the hinge's circle sweeps p^2/2 dalpha. Round a closed curve
 *
 *     area = L n + L (L/2 - k) [beta] + p^2 [alpha]/2,
 *
 * brackets being whole turns: L n alone with the pole outside, and pi (L^2 - 2 L k + p^2) more for
 * each turn round it.
 *
 * The division of the wheel's motion into rolling and slipping follows from its law, by minimum
 * dissipation: without a brake W = (sideways, rolling) gives spin -W_j/radius and slip W_i, the
 * segment of forces being that of M77 figure 1 with b = 0. */
#include <math.h>

#include "base/math.h"
#include "base/status.h"
#include "planar/planar.h"

/* Arms nearer than this to being stretched or folded are refused, relative to their length. */
static const double MARGIN = 1e-6;

enum { PLANIMETER_COOKIE = 0x11a1a5e0 };

CpsPlanimeter cps_planimeter_default(void) { return (CpsPlanimeter){.cookie = PLANIMETER_COOKIE}; }

static CpsStatus check_numbers(const CpsPlanimeter *p, int count, const double *point,
                               CpsError *err) {
    if (p->cookie != PLANIMETER_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the planimeter was not made by cps_planimeter_default()");
    const double number[7] = {p->pole[0], p->pole[1],  p->pole_arm, p->tracer_arm,
                              p->wheel,   p->friction, p->load};
    CpsStatus status = cpsi_law_check_vector("planimeter", 7, number, err);
    if (status != CPS_OK) return status;
    if (!(p->pole_arm > 0) || !(p->tracer_arm > 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the arms are %g m and %g m long, expected more than 0", p->pole_arm,
                         p->tracer_arm);
    if (!(p->friction * p->load > 0))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "friction %g and load %g N of the wheel, expected more than 0: what turns "
                         "it is friction",
                         p->friction, p->load);
    if (count < 3) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d points, expected at least 3", count);
    if (point)
        for (int i = 0; i < count; i++)
            if (!isfinite(point[2 * i]) || !isfinite(point[2 * i + 1]))
                return cpsi_fail(err, CPS_ERR_ARGUMENT, "point %d is not finite", i);
    return point ? CPS_OK : cpsi_fail(err, CPS_ERR_ARGUMENT, "the points are NULL");
}

/* The arms with the tracer at a point. */
typedef struct Arms {
    double alpha, beta; /* headings of pole arm and tracer arm */
    double wheel[2];    /* position of its contact */
} Arms;

/* Triangle of pole, hinge and tracer: the cosine rule gives the angle at the pole. Returns false
 * where the tracer is out of reach. */
static bool place_arms(const CpsPlanimeter *p, const double tracer[2], Arms *arms) {
    const double x = tracer[0] - p->pole[0], y = tracer[1] - p->pole[1], far = hypot(x, y);
    const double a = p->pole_arm, l = p->tracer_arm, margin = MARGIN * (a + l);
    if (!(far < a + l - margin) || !(far > fabs(a - l) + margin)) return false;
    const double angle = acos((far * far + a * a - l * l) / (2 * far * a));
    arms->alpha = atan2(y, x) + (p->left_elbow ? angle : -angle);
    const double hinge[2] = {p->pole[0] + a * cos(arms->alpha), p->pole[1] + a * sin(arms->alpha)};
    const double along[2] = {(tracer[0] - hinge[0]) / l, (tracer[1] - hinge[1]) / l};
    arms->beta = atan2(along[1], along[0]);
    for (int i = 0; i < 2; i++) arms->wheel[i] = hinge[i] + p->wheel * along[i];
    return true;
}

/* Twice the area of the triangle (origin, a, b). */
static double cross(const double a[2], const double b[2]) { return a[0] * b[1] - a[1] * b[0]; }

static double half_turn(double angle) { return remainder(angle, 2 * CPSI_PI); }

/* One step of the arms: roll and slip of the wheel, whose axis has the mean heading of the tracer
 * arm. */
static void roll_wheel(const CpsPlanimeter *p, const Arms *from, const Arms *to,
                       CpsPlanimeterReading *sum) {
    const double turned = half_turn(to->beta - from->beta), heading = from->beta + 0.5 * turned;
    const CpsiPatch wheel = {.kind = CPS_PATCH_WHEEL,
                             .axis = {-sin(heading), cos(heading)},
                             .strength = p->friction * p->load,
                             .size = 1};
    const double moved[2] = {to->wheel[0] - from->wheel[0], to->wheel[1] - from->wheel[1]};
    const CpsWheelMotion motion = cpsi_wheel_motion(&wheel, moved);
    sum->roll -= wheel.size * motion.spin;
    sum->side_slip += fabs(motion.slip[0]);
    sum->dissipated += motion.ground;
    sum->pole_turns += half_turn(to->alpha - from->alpha);
    sum->arm_turns += turned;
}

/* The tracer is between two points of the curve, or at the second of them. */
static CpsStatus out_of_reach(const CpsPlanimeter *p, const double tracer[2], int from, int to,
                              CpsError *err) {
    return cpsi_fail(err, CPS_ERR_ARGUMENT,
                     "the tracer cannot reach (%g, %g), between points %d and %d: the "
                     "arms of %g m and %g m are too short or too unequal",
                     tracer[0], tracer[1], from, to, p->pole_arm, p->tracer_arm);
}

CpsStatus cps_planimeter_check(const CpsPlanimeter *planimeter, int count, const double *point,
                               CpsError *err) {
    if (!planimeter) return cpsi_fail(err, CPS_ERR_ARGUMENT, "planimeter is NULL");
    const CpsStatus status = check_numbers(planimeter, count, point, err);
    if (status != CPS_OK) return status;
    Arms arms;
    if (!place_arms(planimeter, point, &arms))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "the tracer cannot reach the first point (%g, %g)",
                         point[0], point[1]);
    for (int i = 1; i < count; i++)
        if (!place_arms(planimeter, point + 2 * i, &arms))
            return out_of_reach(planimeter, point + 2 * i, i - 1, i, err);
    return CPS_OK;
}

CpsStatus cps_planimeter_trace(const CpsPlanimeter *planimeter, int count, const double *point,
                               int steps, CpsPlanimeterReading *reading, CpsError *err) {
    if (!reading) return cpsi_fail(err, CPS_ERR_ARGUMENT, "reading is NULL");
    const CpsStatus status = cps_planimeter_check(planimeter, count, point, err);
    if (status != CPS_OK) return status;
    if (steps < 1) return cpsi_fail(err, CPS_ERR_ARGUMENT, "%d steps, expected at least 1", steps);

    CpsPlanimeterReading sum = {0};
    Arms arms, next;
    const double *origin = point;
    place_arms(planimeter, point, &arms);
    for (int i = 0; i < count; i++) {
        const double *a = point + 2 * i, *b = point + 2 * ((i + 1) % count);
        for (int s = 1; s <= steps; s++) {
            const double t = (double)s / steps,
                         tracer[2] = {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]};
            if (!place_arms(planimeter, tracer, &next))
                return out_of_reach(planimeter, tracer, i, (i + 1) % count, err);
            roll_wheel(planimeter, &arms, &next, &sum);
            arms = next;
        }
        sum.exact += 0.5 * cross((double[2]){a[0] - origin[0], a[1] - origin[1]},
                                 (double[2]){b[0] - origin[0], b[1] - origin[1]});
    }

    /* the curve is closed, so the angles change by whole turns */
    const double a = planimeter->pole_arm, l = planimeter->tracer_arm;
    sum.pole_turns = round(sum.pole_turns / (2 * CPSI_PI));
    sum.arm_turns = round(sum.arm_turns / (2 * CPSI_PI));
    sum.area = l * sum.roll + 2 * CPSI_PI * l * (0.5 * l - planimeter->wheel) * sum.arm_turns +
               CPSI_PI * a * a * sum.pole_turns;
    *reading = sum;
    return CPS_OK;
}
