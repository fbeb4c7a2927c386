/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether there is an equilibrium at all (existence.h). An inextensible line shorter than the
 * distance of its ends has none; a line with no end held needs friction and reactions that can
 * carry its loads. */
#include "cable/existence.h"

#include <math.h>

#include "cable/contact.h"
#include "cable/held.h"
#include "cable/line_solve.h"

/* A direction leaves a plane by this much more steeply than friction on it asks, which is more than
 * rounding. */
static const double STEEPER = 1e-9;
/* [-] Least power of the loads per metre, as a share of the sum of their sizes: forces in a
 * certified equilibrium balance to less. */
static const double LEAST_POWER = 1e-6;

/* Held nodes farther apart than an inextensible line is long between them: a constant force along
 * that span is a proof. */
static bool too_short(CpsiLine *line) {
    CpsiSpan span = {.to = 0}, worst = {.distance = 0};
    if (line->compliance > 0) return false;
    while (cpsi_line_next_span(line, span.to, &span))
        if (span.distance > span.length * (1 + CPSI_TAUT) &&
            span.distance - span.length > worst.distance - worst.length)
            worst = span;
    if (!(worst.distance > 0)) return false;
    const Vec3 apart =
        vec3_sub(cpsi_line_held_place(line, worst.to), cpsi_line_held_place(line, worst.from));
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, vec3_scale(1 / worst.distance, apart));
    line->report.proof_length = worst.distance - worst.length;
    return true;
}

/* No end held: a rigid translation v with B.v > sum w |v_T| lowers the energy for ever, B the sum
 * of loads. The best v has the tangential part of B that friction cannot carry, and the normal part
 * of B where the obstacle does not prevent it. This holds on one plane with isotropic friction, or
 * without obstacles; for several planes see slips_off. */
static bool runs_away(CpsiLine *line, const CpsiStepOptions *options) {
    if (!cpsi_line_is_loose(line) || line->has_local_axes) return false;
    Vec3 sum = vec3(0, 0, 0);
    double bound = 0, steepest = 0, least = INFINITY, loads = 0;
    bool stopped = false;
    for (int j = 0; j < line->n; j++) {
        const Vec3 b = vec3_load(&line->load[3 * j]);
        sum = vec3_add(sum, b);
        loads += vec3_norm(b);
        bound += line->friction_bound[j];
        steepest = fmax(steepest, line->friction_law[j].friction);
        least = fmin(least, line->friction_law[j].friction);
        stopped = stopped || isfinite(line->gap[j]);
    }
    const Vec3 n = vec3_load(&line->common_axes[6]);
    const double normal = vec3_dot(sum, n), along = stopped && normal < 0 ? 0 : normal;
    const Vec3 tangent = vec3_axpy(-normal, n, sum);
    /* all reactions together balance B.n; friction is largest if they act where its coefficient
     * is */
    if (options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT && !options->frictionless)
        bound = steepest * fmax(0, -normal);
    const double pull = vec3_norm(tangent), beyond = pull > bound ? pull - bound : 0;
    const double fall = sqrt(beyond * beyond + along * along);
    if (!(fall > CPSI_TAUT * loads)) return false;
    const Vec3 in_plane = pull > 0 ? vec3_scale(beyond / (pull * fall), tangent) : vec3(0, 0, 0);
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    vec3_store(line->report.proof, vec3_axpy(along / fall, n, in_plane));
    line->report.proof_force = fall;
    /* with bounds coupled to the reactions, whose sum is -B.n, friction would hold the line
     * wherever they act */
    const bool frozen =
        options->friction_policy == CPS_FRICTION_POLICY_FROZEN && !options->frictionless;
    if (frozen && along == 0 && pull <= least * -normal) line->report.coulomb = least * -normal;
    return true;
}

/* A plane as friction on it cannot hold: whatever moves along a unit vector v with n.v >= rise, but
 * for what it takes along its tangential part. */
typedef struct Slope {
    Vec3 n;
    double rise;
    double bound; /* [N] friction on it at most, whatever the reactions; 0 if it follows them */
} Slope;

/* More planes are not examined, since all pairs of them are. */
enum { MOST_SLOPES = 16 };

/* The radius of a disc that contains all friction forces per unit normal force, over the larger
 * coefficient. */
static double disc_factor(const CpsiObstacle *o) {
    const double most = fmax(o->friction[0], o->friction[1]);
    return o->shape == CPS_FRICTION_SHAPE_BOX && most > 0
               ? hypot(o->friction[0], o->friction[1]) / most
               : 1;
}

/* The slopes of the obstacles: with bounds that follow the reactions the sine of the friction
 * angle, with frozen ones 0 and the sum of the bounds. Returns 0 where an obstacle is round or has
 * a given set. */
static int fill_slopes(const CpsiLine *line, bool frozen, Slope slope[MOST_SLOPES]) {
    double factor = line->friction_factor ? 0 : 1;
    if (line->friction_factor)
        for (int j = 0; j < line->n; j++) factor = fmax(factor, line->friction_factor[j]);
    if (line->obstacle_count > MOST_SLOPES) return 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        const CpsiObstacle *o = &line->obstacle[k];
        if (o->kind != CPS_OBSTACLE_PLANE || o->has_set) return 0;
        const double mu = factor * disc_factor(o) * fmax(o->friction[0], o->friction[1]);
        slope[k] = (Slope){.n = o->frame.axis[2], .rise = frozen ? 0 : mu / hypot(1, mu)};
    }
    const int bounded = frozen ? cpsi_line_all_contacts(line) : 0;
    for (int c = 0; c < bounded; c++) {
        const int k = line->obstacle_index[c];
        if (k != CPS_NO_OBSTACLE)
            slope[k].bound += disc_factor(&line->obstacle[k]) * line->friction_bound[c];
    }
    return line->obstacle_count;
}

/* The steepest fall found so far: the power of the loads `sum` along a unit vector v, less what
 * frozen bounds can take. */
typedef struct Fall {
    Vec3 sum, v;
    double power;
} Fall;

static void consider(const Slope *slope, int count, Vec3 along, Fall *fall) {
    const Vec3 v = vec3_scale(1 / vec3_norm(along), along);
    double power = vec3_dot(fall->sum, v);
    for (int k = 0; k < count; k++) {
        const double rise = vec3_dot(slope[k].n, v);
        if (!(rise >= slope[k].rise)) return;
        power -= slope[k].bound * vec3_norm(vec3_axpy(-rise, slope[k].n, v));
    }
    if (!(power > fall->power)) return;
    fall->v = v;
    fall->power = power;
}

/* ... that leaves one plane as steeply as its friction asks, */
static void consider_one(const Slope *slope, int count, int k, Fall *fall) {
    const double rise = slope[k].rise + STEEPER;
    const Vec3 n = slope[k].n, t = vec3_axpy(-vec3_dot(fall->sum, n), n, fall->sum);
    const Vec3 up = vec3_scale(rise * vec3_norm(t), n);
    consider(slope, count, vec3_axpy(sqrt(fmax(0, 1 - rise * rise)), t, up), fall);
}

/* ... and two, to either side of the corner between them. */
static void consider_two(const Slope *slope, int count, int k, int m, Fall *fall) {
    const Vec3 a = slope[k].n, b = slope[m].n, corner = vec3_cross(a, b);
    const double p = slope[k].rise + STEEPER, q = slope[m].rise + STEEPER, cosine = vec3_dot(a, b),
                 square = vec3_dot(corner, corner);
    const Vec3 up =
        vec3_axpy((p - cosine * q) / square, a, vec3_scale((q - cosine * p) / square, b));
    const double along = sqrt((1 - vec3_dot(up, up)) / square);
    consider(slope, count, vec3_axpy(along, corner, up), fall);
    consider(slope, count, vec3_axpy(-along, corner, up), fall);
}

/* No end held, all obstacles planes. With bounds that follow the reactions: whatever contact forces
 * R (n + f) there are, wherever the line lies, their power along v is at least 0 if v leaves every
 * plane at the friction angle or steeper. So B.v > 0 proves that they do not balance the sum of
 * loads B, and the energy falls by B.v per metre along v, without friction. The best v is the point
 * of the cone of these directions that is nearest to B: B itself, or one on the boundary of one
 * slope or of two. With frozen bounds w it is enough that v leads into no plane, and the fall is
 * B.v less the sum of w |v_T|; the same directions are tried, of which none need be the best. */
static bool slips_off(CpsiLine *line, bool frozen) {
    Slope slope[MOST_SLOPES];
    if (!cpsi_line_is_loose(line) || !line->has_local_axes) return false;
    const int count = fill_slopes(line, frozen, slope);
    Fall fall = {0};
    double loads = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 b = vec3_load(&line->load[3 * j]);
        fall.sum = vec3_add(fall.sum, b);
        loads += vec3_norm(b);
    }
    if (count > 0) consider(slope, count, fall.sum, &fall);
    for (int k = 0; k < count; k++) {
        consider_one(slope, count, k, &fall);
        for (int m = 0; m < k; m++) consider_two(slope, count, k, m, &fall);
    }
    if (!(fall.power > LEAST_POWER * loads)) return false;
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    vec3_store(line->report.proof, fall.v);
    line->report.proof_force = fall.power;
    return true;
}

/* Is point x farther than `touch` [m] from the obstacle, and does it not come nearer while it moves
 * along v? */
static bool moves_off(const CpsiObstacle *obstacle, Vec3 x, Vec3 v, double touch) {
    return cpsi_obstacle_gap(obstacle, x) > touch &&
           vec3_dot(cpsi_obstacle_normal(obstacle, x), v) >= 0;
}

/* Does the line not touch the obstacle, and never come nearer while it moves along the unit vector
 * v? The distance of an element from a convex obstacle is a convex function of the displacement
 * along v: if it does not decrease at first, it never does. */
static bool moves_away(const CpsiLine *line, const CpsiObstacle *obstacle, Vec3 v) {
    const double touch = CPSI_TOUCH * line->length;
    for (int j = 0; j < line->n; j++)
        if (!moves_off(obstacle, vec3_load(&line->position[3 * j]), v, touch)) return false;
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 a = vec3_load(&line->position[3 * e]),
                   b = vec3_load(&line->position[3 * (e + 1)]);
        double share;
        if (!cpsi_obstacle_faces(obstacle, a, b, &share)) continue;
        if (!moves_off(obstacle, vec3_axpy(share, vec3_sub(b, a), a), v, touch)) return false;
    }
    return true;
}

bool cpsi_line_falls_away(const CpsiLine *line, double direction[3], double *load) {
    if (!cpsi_line_is_loose(line)) return false;
    Vec3 sum = vec3(0, 0, 0);
    double loads = 0;
    for (int j = 0; j < line->n; j++) {
        sum = vec3_add(sum, vec3_load(&line->load[3 * j]));
        loads += vec3_norm(vec3_load(&line->load[3 * j]));
    }
    const double size = vec3_norm(sum);
    if (!(size > CPSI_TAUT * loads)) return false;
    const Vec3 v = vec3_scale(1 / size, sum);
    for (int k = 0; k < line->obstacle_count; k++)
        if (!moves_away(line, &line->obstacle[k], v)) return false;
    vec3_store(direction, v);
    *load = size;
    return true;
}

bool cpsi_line_outruns_frozen_bounds(CpsiLine *line) { return slips_off(line, true); }

bool cpsi_line_has_no_equilibrium(CpsiLine *line, const CpsiStepOptions *options) {
    const bool follows =
        options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT && !options->frictionless;
    if (too_short(line) || runs_away(line, options) || (follows && slips_off(line, false)))
        return true;
    double direction[3], load;
    if (!cpsi_line_falls_away(line, direction, &load)) return false;
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    for (int a = 0; a < 3; a++) line->report.proof[a] = direction[a];
    line->report.proof_force = load;
    return true;
}
