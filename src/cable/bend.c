/* SPDX-License-Identifier: BSD-3-Clause */
/* Bends round obstacles (bend.h).
 *
 * A node at which a line under the tensions T and T' turns by d round an obstacle has the reaction
 * R = (T + T') sin(d/2) and the friction F = (T' - T) cos(d/2), so that |F| <= mu R holds tensions
 * up to the ratio k = (1 + mu tan(d/2))/(1 - mu tan(d/2)) where a smooth line holds exp(mu d). They
 * differ by order d^3, and at mu tan(d/2) = 1 the node holds any ratio.
 *
 * Only the turn towards the obstacle causes a reaction: asin(e.n) - asin(e'.n), e and e' the
 * directions of the two forces. A line bent sideways on a surface is held by friction whose
 * reaction comes from its weight or from other bends, and the mesh does not change the law there.
 * Nor does a turn cause a reaction on a plane, or inside of what is convex: both elements of a node
 * there lead away from the surface. */
#include "cable/bend.h"

#include "base/math.h"
#include "cable/friction_law.h"
#include "chain/frame.h"

/* The direction of a force below this share of the largest one is rounding. */
static const double LEAST_FORCE = 1e-9;
/* The advised element length is the one at which the two ratios differ by this share. */
static const double RATIO_TOL = 0.01;
/* From mu tan(d/2) = 1 on any tension is held. From this value on, where the ratio is 19 or more,
 * the mesh determines it. */
static const double LOCKED = 0.9;

/* ln of the ratio of tensions that a turn by d holds. */
static double log_ratio_held(double friction, double turn) {
    const double t = friction * tan(0.5 * turn);
    return t < 1 ? 2 * atanh(t) : INFINITY;
}

/* Half turns below this have their excess from the first terms of its series: the next one is
 * 1e-12 of it, and the difference of two logarithms would be rounding. */
static const double SMALL_HALF_TURN = 1e-3;

/* ln of the quotient of the ratios that the node and a smooth line hold. */
static double excess(const CpsBend *bend) {
    const double x = 0.5 * bend->turn, mu = bend->friction, m = mu * mu;
    if (x < SMALL_HALF_TURN && mu * x < SMALL_HALF_TURN)
        return 2 * mu * x * x * x * ((1 + m) / 3 + x * x * (2.0 / 15 + m / 3 + m * m / 5));
    return log_ratio_held(mu, bend->turn) - mu * bend->turn;
}

bool cpsi_bend_locks(const CpsBend *bend) {
    return bend->friction * tan(0.5 * bend->turn) >= LOCKED;
}

bool cpsi_bend_is_sharper(const CpsBend *a, const CpsBend *b) {
    const bool locks = cpsi_bend_locks(a);
    return locks != cpsi_bend_locks(b) ? locks : excess(a) > excess(b);
}

/* The turn at which the two ratios differ by RATIO_TOL. */
static double resolved_turn(double friction) {
    double low = 0, high = CPSI_PI;
    for (int i = 0; i < 60; i++) {
        const double turn = 0.5 * (low + high);
        if (log_ratio_held(friction, turn) - friction * turn < log1p(RATIO_TOL))
            low = turn;
        else
            high = turn;
    }
    return low;
}

/* The larger of the friction coefficients for slip along the line in either direction, from the
 * support function of the set of forces. */
static double friction_along(const CpsiLine *line, int c, Vec3 along) {
    const CpsiFrictionLaw *law = &line->friction_law[c];
    double wanted[3], slip[3];
    vec3_store(wanted, along);
    cpsi_frame_to(slip, cpsi_line_axes(line, c), wanted);
    const double size = hypot(slip[0], slip[1]);
    const double forth[2] = {size > 0 ? slip[0] / size : 1, size > 0 ? slip[1] / size : 0},
                 back[2] = {-forth[0], -forth[1]};
    return fmax(cpsi_friction_law_dissipation(law, law->friction, forth),
                cpsi_friction_law_dissipation(law, law->friction, back));
}

/* The forces of the line before and after contact c, false where there is none on one side. The
 * force of an element's contact acts on both of its nodes, and the line turns there. */
static bool forces_beside(const CpsiLine *line, int c, Vec3 *before, Vec3 *after) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) {
        const int j = cpsi_line_node(line, c);
        if (j == 0 || j == line->n - 1) return false;
        *before = vec3_at(line->segment_force, j - 1);
        *after = vec3_at(line->segment_force, j);
        return true;
    }
    const Vec3 within = vec3_at(line->segment_force, e), f = vec3_at(line->friction_force, c);
    const Vec3 action = vec3_axpy(line->reaction[c], vec3_at(line->normal, c), f);
    *before = vec3_axpy(1 - line->beta[e], action, within);
    *after = vec3_axpy(-line->beta[e], action, within);
    return true;
}

/* The direction in which element e pulls: of its force or, where that is rounding, its own if it is
 * not slack, since any force would act along it. False where it has none. */
static bool direction_of(const CpsiLine *line, int e, Vec3 force, double least, Vec3 *out) {
    const double size = vec3_norm(force);
    if (size > least) {
        *out = vec3_scale(1 / size, force);
        return true;
    }
    if (e < 0) return false;
    const Vec3 x = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    const double length = vec3_norm(x);
    if (!(length >= (1 - CPS_TOUCH) * line->element_length[e])) return false;
    *out = vec3_scale(1 / length, x);
    return true;
}

/* [m] Natural arc length at contact c. */
static double arc_of(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? line->arc_length[cpsi_line_node(line, c)]
                 : line->arc_length[e] + line->beta[e] * line->natural_length[e];
}

/* The bend at contact c; its turn is 0 where the reaction does not come from a turn of the line
 * round a curved obstacle. */
static CpsBend bend_of(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    CpsBend bend = {0};
    Vec3 before, after, e, f;
    if (!obstacle || !cpsi_obstacle_faces_lines(obstacle) ||
        !(line->reaction[c] > 0 && line->friction_bound[c] > 0) ||
        !forces_beside(line, c, &before, &after))
        return bend;
    const double least = LEAST_FORCE * line->report.certificate.largest_force;
    const int within = cpsi_line_element(line, c), j = within < 0 ? cpsi_line_node(line, c) : -1;
    if (!direction_of(line, j < 0 ? -1 : j - 1, before, least, &e) ||
        !direction_of(line, j, after, least, &f))
        return bend;
    const Vec3 n = vec3_at(line->normal, c);
    const double rise = fmax(-1, fmin(1, vec3_dot(e, n))), fall = fmax(-1, fmin(1, vec3_dot(f, n)));
    bend.turn = fmax(0, asin(rise) - asin(fall));
    if (bend.turn > 0) bend.friction = friction_along(line, c, vec3_add(e, f));
    bend.arc_length = arc_of(line, c);
    bend.obstacle = (int)(obstacle - line->obstacle);
    return bend;
}

CpsBend cpsi_line_bend(const CpsiLine *line) {
    CpsBend worst = {0};
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            const CpsBend bend = bend_of(line, c);
            if (cpsi_bend_is_sharper(&bend, &worst)) worst = bend;
        }
    if (!(worst.turn > 0)) return worst;
    worst.ratio = exp(log_ratio_held(worst.friction, worst.turn));
    worst.coulomb = exp(worst.friction * worst.turn);
    worst.element =
        2 * line->obstacle[worst.obstacle].radius * sin(0.5 * resolved_turn(worst.friction));
    return worst;
}
