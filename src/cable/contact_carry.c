/* SPDX-License-Identifier: BSD-3-Clause */
/* Where an obstacle that moves has taken what friction is measured from (contact_carry.h).
 *
 * By the formula of the second order a step in time has its obstacles move for the span k of the
 * scheme alone, the last share k/h of the step, and the reference is x* = x_n + b (x_n - x_{n-1}).
 * Of what goes round with an obstacle that is outside of its circle. In the matter of the obstacle
 * it is at rest: so x_n and x_{n-1} are each carried along to the end of the step by one that
 * turns, and friction is measured from x* of these. The obstacle moves in the step before as it
 * does in this one, or all nodes take Euler steps, which begin at x_n. */
#include "cable/contact_carry.h"

/* Does obstacle k turn in a step by the formula of the second order? */
static bool turns_twice(const CpsiLine *line, int k) {
    return line->inertia.moved_in_span &&
           (line->turn[k] != 0 || !cpsi_vec3_is_zero(line->shift[k].turn));
}

/* The length of the step in time over that for which obstacles move in it. */
static double whole_step(const CpsiLine *line) {
    const CpsiInertia *inertia = &line->inertia;
    return inertia->moved_in_span ? inertia->formula.length / inertia->span[0] : 1;
}

/* Where obstacle k takes x to at the end of the step, in `shares` of the span for which it moves in
 * the step. */
static Vec3 carry_for(const CpsiLine *line, int k, double shares, bool turns, Vec3 x) {
    const CpsiShift shift = cpsi_shift_part(&line->shift[k], 1 - shares, 1);
    return cpsi_obstacle_carry(&line->obstacle[k], x, &shift, turns ? shares * line->turn[k] : 0);
}

Vec3 cpsi_contact_carry(const CpsiLine *line, int k, int c, bool turns) {
    if (!turns_twice(line, k))
        return cpsi_obstacle_carry(&line->obstacle[k], cpsi_line_place(line, line->reference, c),
                                   &line->shift[k], turns ? line->turn[k] : 0);
    const CpsiInertia *inertia = &line->inertia;
    const CpsiFormula *formula = &inertia->formula;
    const double step = whole_step(line), both = step * (1 + 1 / formula->ratio);
    const Vec3 last = carry_for(line, k, step, turns, cpsi_line_place(line, inertia->start, c)),
               first = carry_for(line, k, both, turns, cpsi_line_place(line, inertia->past, c));
    return vec3_axpy(formula->back, vec3_sub(last, first), last);
}

Vec3 cpsi_contact_ground_way(const CpsiLine *line, int k, Vec3 x) {
    if (line->turn[k] == 0 && !cpsi_line_is_shifted(line, k)) return vec3(0, 0, 0);
    const double step = whole_step(line);
    const CpsiShift shift = cpsi_shift_part(&line->shift[k], 1 - step, 1);
    const Vec3 before = cpsi_obstacle_turn(&line->obstacle[k], x, -step * line->turn[k]);
    return vec3_add(vec3_sub(x, before), cpsi_shift_to(&shift, before));
}
