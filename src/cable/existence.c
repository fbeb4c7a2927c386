/* SPDX-License-Identifier: BSD-3-Clause */
/* Whether there is an equilibrium at all (existence.h). An inextensible line shorter than the
 * distance of its ends has none; a line with no end held needs friction and reactions that can
 * carry its loads. */
#include "cable/existence.h"

#include <math.h>

#include "cable/contact.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/held.h"
#include "cable/line_solve.h"
#include "cable/set_beside_plane.h"
#include "cable/slopes.h"

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

/* The same of an end that is held to a set farther away than the line is long. */
static bool misses_set(CpsiLine *line) {
    double distance, length;
    Vec3 apart;
    if (line->compliance > 0 || !cpsi_line_has_sets(line)) return false;
    if (!cpsi_line_set_distance(line, &distance, &length, &apart)) return false;
    if (!(distance > length * (1 + CPSI_TAUT))) return false;
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, apart);
    line->report.proof_length = distance - length;
    return true;
}

/* The same of the part of a set that lies above a plane. */
static bool misses_beside_plane(CpsiLine *line) {
    CpsiBesidePlane found;
    if (line->compliance > 0 || !line->contact_everywhere) return false;
    if (!cpsi_line_misses_beside_plane(line, CPSI_TAUT, &found)) return false;
    line->report.outcome = CPS_OUTCOME_INFEASIBLE;
    vec3_store(line->report.proof, found.apart);
    line->report.proof_length = found.missing;
    line->report.has_proof_plane = true;
    line->report.proof_plane = found.plane;
    return true;
}

/* No node held, but ends in sets: B.v > 0 for a direction v in which the sets have no end, and in
 * which the line meets no obstacle. */
static bool slides_off(CpsiLine *line) {
    Vec3 sum = vec3(0, 0, 0);
    double loads = 0;
    if (!cpsi_line_is_loose(line) || cpsi_line_loads_follow(line)) return false;
    for (int j = 0; j < line->n; j++) {
        sum = vec3_add(sum, vec3_at(line->load, j));
        loads += vec3_norm(vec3_at(line->load, j));
    }
    const Vec3 v = cpsi_line_sets_let(line, cpsi_line_field_free_part(line, sum));
    const double size = vec3_norm(v);
    if (!(size > CPSI_TAUT * loads)) return false;
    const Vec3 unit = vec3_scale(1 / size, v);
    const double fall = vec3_dot(sum, unit);
    if (!(fall > CPSI_TAUT * loads) || !cpsi_line_moves_away(line, unit) ||
        !cpsi_line_field_lets(line, unit))
        return false;
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    vec3_store(line->report.proof, unit);
    line->report.proof_force = fall;
    return true;
}

/* No end held: a rigid translation v with B.v > sum w |v_T| lowers the energy for ever, B the sum
 * of loads, which the field of the line does not resist. The best v has the tangential part of B
 * that friction cannot carry, and the normal part of B where the obstacle does not prevent it. This
 * holds on one plane with isotropic friction, or without obstacles; for several planes see
 * slips_off. */
static bool runs_away(CpsiLine *line, const CpsiStepOptions *options) {
    if (!cpsi_line_is_loose(line) || line->has_local_axes || cpsi_line_loads_follow(line))
        return false;
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
    sum = cpsi_line_field_free_part(line, sum);
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
    const Vec3 in_plane = pull > 0 ? vec3_scale(beyond / (pull * fall), tangent) : vec3(0, 0, 0),
               v = vec3_axpy(along / fall, n, in_plane);
    if (!cpsi_line_field_lets(line, v)) return false;
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    vec3_store(line->report.proof, v);
    line->report.proof_force = fall;
    /* with bounds coupled to the reactions, whose sum is -B.n, friction would hold the line
     * wherever they act */
    const bool frozen =
        options->friction_policy == CPS_FRICTION_POLICY_FROZEN && !options->frictionless;
    if (frozen && along == 0 && pull <= least * -normal) line->report.coulomb = least * -normal;
    return true;
}

/* No end held, all obstacles planes. With bounds that follow the reactions: whatever contact forces
 * R (n + f) there are, wherever the line lies, their power along v is at least 0 if v leaves every
 * plane at the friction angle or steeper. So B.v > 0 proves that they do not balance the sum of
 * loads B, and the energy falls by B.v per metre along v, without friction. With frozen bounds w it
 * is enough that v leads into no plane, and the fall is B.v less the sum of w |v_T|. */
static bool slips_off(CpsiLine *line, bool frozen) {
    CpsiSlopes slopes;
    if (!cpsi_line_is_loose(line) || !line->has_local_axes || cpsi_line_loads_follow(line))
        return false;
    if (cpsi_line_has_sets(line)) return false;
    if (!cpsi_slopes_fill(line, cpsi_largest_friction_factor(line), frozen, &slopes)) return false;
    if (frozen) cpsi_slopes_add_bounds(line, &slopes);
    CpsiFall fall = {0};
    double loads = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 b = vec3_load(&line->load[3 * j]);
        fall.sum = vec3_add(fall.sum, b);
        loads += vec3_norm(b);
    }
    fall.sum = cpsi_line_field_free_part(line, fall.sum);
    cpsi_slopes_fall(&slopes, &fall);
    if (!(fall.power > CPSI_LEAST_POWER * loads)) return false;
    if (!cpsi_line_field_lets(line, fall.v)) return false;
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
    if (!cpsi_obstacle_is_convex(obstacle)) return false;
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

bool cpsi_line_moves_away(const CpsiLine *line, Vec3 v) {
    for (int k = 0; k < line->obstacle_count; k++)
        if (!moves_away(line, &line->obstacle[k], v)) return false;
    return true;
}

bool cpsi_line_falls_away(const CpsiLine *line, double direction[3], double *load) {
    if (!cpsi_line_is_loose(line) || cpsi_line_loads_follow(line) || cpsi_line_has_sets(line))
        return false;
    Vec3 sum = vec3(0, 0, 0);
    double loads = 0;
    for (int j = 0; j < line->n; j++) {
        sum = vec3_add(sum, vec3_load(&line->load[3 * j]));
        loads += vec3_norm(vec3_load(&line->load[3 * j]));
    }
    sum = cpsi_line_field_free_part(line, sum);
    const double size = vec3_norm(sum);
    if (!(size > CPSI_TAUT * loads)) return false;
    const Vec3 v = vec3_scale(1 / size, sum);
    if (!cpsi_line_moves_away(line, v) || !cpsi_line_field_lets(line, v)) return false;
    vec3_store(direction, v);
    *load = size;
    return true;
}

bool cpsi_line_outruns_frozen_bounds(CpsiLine *line) { return slips_off(line, true); }

bool cpsi_line_has_no_equilibrium(CpsiLine *line, const CpsiStepOptions *options) {
    const bool follows =
        options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT && !options->frictionless;
    if (line->inertia.is_moving) return too_short(line);
    if (cpsi_line_has_sets(line)) {
        cpsi_line_clear_set_reactions(line);
        return too_short(line) || misses_set(line) || misses_beside_plane(line) || slides_off(line);
    }
    if (too_short(line) || runs_away(line, options) || (follows && slips_off(line, false)))
        return true;
    double direction[3], load;
    if (!cpsi_line_falls_away(line, direction, &load)) return false;
    line->report.outcome = CPS_OUTCOME_UNBOUNDED;
    for (int a = 0; a < 3; a++) line->report.proof[a] = direction[a];
    line->report.proof_force = load;
    return true;
}
