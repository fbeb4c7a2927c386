/* SPDX-License-Identifier: BSD-3-Clause */
/* Caught between a ball and a plane (caught.h; docs/theory.md 5).
 *
 * A half-line from the ball outwards, the gate, the ball and the plane make an arch. A line that
 * lies under the arch stays there as long as it cannot cross the gate, and under it no line is
 * shorter than one that goes round the ball where the plane begins. */
#include "cable/caught.h"

#include "cable/line_solve.h"
#include "geometry/shortest_path.h"

/* [-] A line that is longer than its elements allow by this part of its length is none: places
 * and lengths of a certified line are known to 1e-9. */
static const double MARGIN = 1e-6;
/* [-] Vectors between unit vectors are known in direction from this size on. */
static const double LEAST = 1e-3;
/* Positions of the ends on their way that are examined at most. */
enum { POSITIONS = 1000 };

/* The arch over part of a plane. */
typedef struct Arch {
    const CpsiObstacle *ball;
    CpsiPolygon polygon;
    Vec3 gate, low; /* unit vectors from the centre: the half-line, and where the plane begins */
    Vec3 side, up;  /* in the plane of both: across the normal of the plane, and the normal */
    Vec3 from[2], to[2]; /* places of the ends before and after, */
    double speed;        /* [m] and the sum of the ways between them */
} Arch;

static Vec3 from_centre(const Arch *arch, Vec3 x) { return cpsi_obstacle_spoke(arch->ball, x); }

/* The arch over the line between a ball and a plane, away from both ends. False where there is
 * none: the ball does not dip into the plane with its lower half, or no half-line is away from both
 * ends. */
static bool make_arch(const CpsiLine *line, const CpsiObstacle *ball, const CpsiObstacle *plane,
                      double longest, Arch *arch) {
    const double nearest = ball->radius - cpsi_obstacle_allowance(ball, longest),
                 height = cpsi_obstacle_gap(plane, ball->frame.point), sine = height / nearest;
    if (!(height >= 0 && height < nearest)) return false;
    *arch = (Arch){.ball = ball, .polygon = {longest, nearest}, .up = plane->frame.axis[2]};
    Vec3 towards = vec3(0, 0, 0);
    for (int end = 0; end < 2; end++) {
        arch->from[end] = vec3_at(line->position, end == CPS_END_A ? 0 : line->n - 1);
        arch->to[end] = vec3_load(line->end[end].value);
        arch->speed += vec3_norm(vec3_sub(arch->to[end], arch->from[end]));
        const Vec3 spoke = from_centre(arch, arch->from[end]);
        towards = vec3_axpy(1 / vec3_norm(spoke), spoke, towards);
    }
    const double size = vec3_norm(towards);
    if (!(size > LEAST)) return false;
    arch->gate = vec3_scale(-1 / size, towards);
    const Vec3 across = vec3_reject(arch->gate, arch->up);
    const double width = vec3_norm(across);
    if (!(width > LEAST)) return false;
    arch->side = vec3_scale(1 / width, across);
    arch->low = vec3_axpy(-sine, arch->up, vec3_scale(sqrt((1 - sine) * (1 + sine)), arch->side));
    return vec3_dot(arch->gate, arch->up) > -sine;
}

/* How often the line passes under the arch, one way less the other. */
static int passages(const CpsiLine *line, const Arch *arch) {
    const Vec3 across = vec3_cross(arch->side, arch->up);
    const double out = vec3_dot(arch->gate, arch->side), up = vec3_dot(arch->gate, arch->up);
    int count = 0;
    for (int e = 0; e + 1 < line->n; e++) {
        const Vec3 a = from_centre(arch, vec3_at(line->position, e)),
                   b = from_centre(arch, vec3_at(line->position, e + 1));
        const double before = vec3_dot(a, across), after = vec3_dot(b, across);
        if ((before >= 0) == (after >= 0)) continue;
        const Vec3 x = vec3_axpy(before / (before - after), vec3_sub(b, a), a);
        const double along = vec3_dot(x, arch->side), above = vec3_dot(x, arch->up);
        if (along > 0 && above * out < along * up) count += before >= 0 ? 1 : -1;
    }
    return count;
}

/* [m] The least length of the line that crosses the half-line in direction e, its ends at a share
 * of their way; 0: not known. */
static double least_across(const Arch *arch, Vec3 e, double share) {
    Vec3 x[2];
    for (int end = 0; end < 2; end++)
        x[end] = vec3_axpy(share, vec3_sub(arch->to[end], arch->from[end]), arch->from[end]);
    double length;
    return cpsi_shortest_path_across(arch->ball, x[0], x[1], e, arch->polygon, &length) ? length
                                                                                        : 0;
}

/* Is the gate out of reach of a line of length `allowed` on the whole way of its ends? The least
 * length across it changes by no more than the ends move. */
static bool gate_holds(const Arch *arch, double allowed) {
    double share = 0;
    for (int i = 0; i < POSITIONS; i++) {
        const double spare = least_across(arch, arch->gate, share) - allowed;
        if (!(spare > 0)) return false;
        if (!(share < 1)) return true;
        share = spare < (1 - share) * arch->speed ? share + spare / arch->speed : 1;
    }
    return false;
}

/* Do both ends stay away from the arch by a right angle or more, seen from the centre? They go
 * straight, so their places before and after tell. */
static bool ends_are_away(const Arch *arch) {
    return least_across(arch, arch->low, 0) > 0 && least_across(arch, arch->low, 1) > 0 &&
           least_across(arch, arch->gate, 0) > 0 && least_across(arch, arch->gate, 1) > 0;
}

/* Under the arch the angle from an end to the place where the line passes is a concave function of
 * that place, as long as it is a right angle or more: the least is at the gate or at the plane. */
static bool catches(const CpsiLine *line, const Arch *arch, double *missing) {
    const double allowed = line->length * (1 + MARGIN);
    if (!ends_are_away(arch)) return false;
    const double under = fmin(least_across(arch, arch->gate, 1), least_across(arch, arch->low, 1));
    if (!(under > allowed) || !gate_holds(arch, allowed)) return false;
    *missing = under - line->length;
    return passages(line, arch) != 0;
}

bool cpsi_line_is_caught(const CpsiLine *line, const CpsiStepOptions *options, CpsiCatch *out) {
    if (line->compliance > 0 || !cpsi_line_both_ends(line, CPS_END_KIND_HELD) ||
        options->frictionless || options->contact_policy != CPS_CONTACT_POLICY_REACHED ||
        line->element_contacts == 0)
        return false;
    double longest = 0;
    for (int e = 0; e + 1 < line->n; e++) longest = fmax(longest, line->element_length[e]);
    *out = (CpsiCatch){.ball = CPS_NO_OBSTACLE};
    for (int k = 0; k < line->obstacle_count; k++) {
        if (line->obstacle[k].kind != CPS_OBSTACLE_SPHERE ||
            !cpsi_obstacle_is_round(&line->obstacle[k]) || line->obstacle[k].stiffness > 0)
            continue;
        for (int m = 0; m < line->obstacle_count; m++) {
            Arch arch;
            double missing;
            if (line->obstacle[m].kind != CPS_OBSTACLE_PLANE || line->obstacle[m].stiffness > 0)
                continue;
            if (!make_arch(line, &line->obstacle[k], &line->obstacle[m], longest, &arch)) continue;
            if (catches(line, &arch, &missing) && missing > out->missing)
                *out = (CpsiCatch){k, m, missing, arch.gate};
        }
    }
    return out->ball >= 0;
}
