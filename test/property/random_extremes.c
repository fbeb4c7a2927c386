/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction laws and systems at the edge of what has an answer.
 *     usage: random_extremes [--cases N] [--seed S]
 *
 * Cases take turns:
 *
 *   polygon    up to 12 integer points, some twice or on one line: the cone of velocities at a
 *              corner, on an edge, inside
 *   solid      up to 12 integer points in space: the same, the facets being all planes through
 *              three points that have all others on one side
 *   lines      segments and flat discs in up to 4 components: cones of velocities that contain
 *              lines
 *   touching   two balls, a ball and a half-space, a line and a ball with one point in common
 *   unbounded  sums and hulls of a disc with a ray, a line, a half-plane: supports, faces
 *   flat       a flat disc on parameters of which its forces move none or some: gamma, the motion's
 *              and the reduced law's
 *   limit      a block under a load near, at and beyond what its friction holds, driven across: is
 *              there a motion?
 *   table      velocities of a resistance law at kinks, on flat pieces and beyond its table's end
 *   wheel      a braked wheel whose brake is 1e-15 to 1e6 times as strong as its ground, or just as
 *              strong, sizes from 1e-9 to 1e9, components of W down to 1e-12: gamma, the motion,
 *              the forces
 *   polar      the polar of a ball with 0 inside, on its boundary and outside, and the ball's own
 *              gauge: facts, supports, gauges
 *   cone       friction cones and intervals with infinite ends, as laws and in systems: supports,
 *              cones of velocities, reactions
 *
 * All data are small integers, Pythagorean directions and powers of ten; what is expected follows
 * from formulas written here. */
#include <string.h>

#include "extreme_case.h"

int main(int argc, char **argv) {
    static void (*const TRY[CLASSES])(void) = {try_polygon,   try_solid, try_lines, try_touching,
                                               try_unbounded, try_flat,  try_limit, try_table,
                                               try_wheel,     try_polar, try_cone};
    static const char *const NAME[CLASSES] = {"polygon",   "solid", "lines", "touching",
                                              "unbounded", "flat",  "limit", "table",
                                              "wheel",     "polar", "cone"};
    long cases = 200, first = 1;
    int wrong[CLASSES] = {0}, tried[CLASSES] = {0};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--cases")) cases = atol(argv[i + 1]);
        if (!strcmp(argv[i], "--seed")) first = atol(argv[i + 1]);
    }
    for (long i = 0; i < cases; i++) {
        seed = (uint64_t)(first + i);
        state = seed * 0x9e3779b97f4a7c15u;
        class_of_case = (int)(seed % CLASSES);
        failed[class_of_case] = 0;
        TRY[class_of_case]();
        tried[class_of_case]++;
        wrong[class_of_case] += failed[class_of_case];
        failures += failed[class_of_case];
    }
    for (int k = 0; k < CLASSES; k++)
        printf("%-10s %6d cases, %d wrong\n", NAME[k], tried[k], wrong[k]);
    printf("%ld cases, %d wrong\n", cases, failures);
    return failures > 0;
}
