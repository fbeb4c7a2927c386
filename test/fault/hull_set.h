/* SPDX-License-Identifier: BSD-3-Clause */
/* A friction set of a scene that takes many allocations: the hull of a disc, a segment and a
 * triangle. */
#ifndef CAPSTAN_TEST_FAULT_HULL_SET_H
#define CAPSTAN_TEST_FAULT_HULL_SET_H

#define HULL_SET                                              \
    "{hull: [{disc: 0.3}, {segment: [[0, -0.5], [0, 0.9]]}, " \
    "{polytope: [[1, 0], [0, 1], [-1, -1]]}]}"

#endif
