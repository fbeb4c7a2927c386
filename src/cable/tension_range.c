/* SPDX-License-Identifier: BSD-3-Clause */
/* The range of the tensions at the ends of an inextensible line (tension_field.h).
 *
 * Over the set of force_set.h the tension of one element is a linear function: its least and its
 * greatest value are cone programs. The solution's duals z are virtual displacements of the nodes:
 * with load + G'z = 0 no forces of the set have load.y > z.h. Whether there is a greatest value is
 * checked first: the tension is unbounded if and only if the recession cone of the set contains a
 * direction along which it grows. That is the same program without loads, with the growth bounded
 * by 1. */
#include <math.h>

#include "cable/tension_field.h"

/* The growth along an unbounded direction is 1 or 0 in exact arithmetic. */
static const double GROWS = 0.5;

/* Where other forces than the tension in question are unbounded, the loop may not converge; then a
 * small weight on all of them is tried. Its effect on the extreme value is included in the
 * bound. */
static const double WEIGHTS[] = {0, 1e-10, 1e-8};

/* A value is accepted if it differs from its bound by no more than this share of the largest force:
 * the root of the loop's rounding. */
static const double VALUE_TOL = 1e-7;

/* The extreme value of the tension of element e, and its bound: the greatest by sign 1, the least
 * by -1. False where no program found the two close to each other. */
static bool extreme(CpsiForceSet *set, int e, double sign, double *value, double *bound) {
    const double now = *value = *bound = fmax(0, set->tension[e]);
    const int g = set->scalar[e];
    if (g < 0) return true;
    set->program.base.load[g] = sign * set->gain[e];
    for (size_t k = 0; k < sizeof WEIGHTS / sizeof *WEIGHTS; k++) {
        cpsi_scalar_program_weigh(&set->program, WEIGHTS[k]);
        if (!cpsi_force_set_solve(set)) continue;
        /* T >= 0 is a bound as well, exact to rounding */
        *value = fmax(0, now + set->force * set->gain[e] * set->program.base.u[g]);
        *bound = fmax(0, now + sign * set->force * cpsi_scalar_program_bound(&set->program));
        if (fabs(*value - *bound) <= VALUE_TOL * set->force) return true;
    }
    return false;
}

/* Is there a direction of the recession cone along which the tension of element e grows? *known is
 * false where the program was not solved. */
static bool grows(CpsiForceSet *set, const CpsiLine *line, CpsiForceLaw law, int e, bool *known) {
    law.directions = true;
    *known = true;
    if (!cpsi_force_set_build(set, line, &law) || set->scalar[e] < 0) return false;
    const int g = set->scalar[e];
    cpsi_scalar_program_site(&set->program, g, -1, 0);
    const int row = cpsi_scalar_program_cone(&set->program, 1);
    set->program.g[row][0] = -set->gain[e];
    set->program.h[row] = 1;
    set->program.base.load[g] = set->gain[e];
    *known = cpsi_force_set_solve(set);
    return *known && set->gain[e] * set->program.base.u[g] > GROWS;
}

static CpsTensionRange range_of(CpsiLine *line, CpsiForceSet *set, const CpsiForceLaw *law, int e) {
    const CpsTensionRange failed = {.kind = CPS_RANGE_FAILED};
    CpsTensionRange range = failed;
    bool known;
    const bool unbounded = grows(set, line, *law, e, &known);
    if (!known) return range;
    if (!cpsi_force_set_build(set, line, law)) {
        const double only = fmax(0, set->tension[e]);
        if (!set->partial)
            return (CpsTensionRange){CPS_RANGE_BOUNDED, true, only, only, only, only};
    }
    if (set->partial) return (CpsTensionRange){.kind = CPS_RANGE_NOT_GIVEN};
    if (!extreme(set, e, -1, &range.least, &range.least_bound)) return failed;
    if (unbounded) {
        range.greatest = range.greatest_bound = INFINITY;
        range.kind = CPS_RANGE_UNBOUNDED;
        range.has_values = true;
        return range;
    }
    cpsi_force_set_build(set, line, law);
    if (!extreme(set, e, 1, &range.greatest, &range.greatest_bound)) return failed;
    range.kind = CPS_RANGE_BOUNDED;
    range.has_values = true;
    return range;
}

void cpsi_line_tension_range(CpsiLine *line, CpsiForceSet *set, const CpsiStepOptions *options) {
    const CpsiForceLaw law = cpsi_force_law(options, line->exact);
    for (int end = 0; end < 2; end++) {
        CpsTensionRange *range = &line->report.end[end].range;
        *range = range_of(line, set, &law,
                          end == CPS_END_A ? cpsi_line_end_node(line, end)
                                           : cpsi_line_end_node(line, end) - 1);
        /* without any force there is no scale for the bounds; report no range */
        if (range->kind == CPS_RANGE_BOUNDED && !(line->report.certificate.largest_force > 0))
            *range = (CpsTensionRange){.kind = CPS_RANGE_NONE};
    }
}
