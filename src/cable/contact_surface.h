/* SPDX-License-Identifier: BSD-3-Clause */
/* The obstacle as a contact sees it. */
#ifndef CAPSTAN_SRC_CABLE_CONTACT_SURFACE_H
#define CAPSTAN_SRC_CABLE_CONTACT_SURFACE_H

#include "cable/line.h"
#include "geometry/folds.h"

/* Has contact c a face of its own, one of several that its node may touch on an obstacle? */
static inline bool cpsi_contact_has_face(const CpsiLine *line, int c) {
    return line->has_folds && line->obstacle_index[c] >= 0 && line->face[c] != CPSI_NO_FACE &&
           !cpsi_line_is_contact_held(line, c);
}

/* The obstacle of contact c, NULL without one; if the contact has a face, a copy in *seen, as seen
 * from there (geometry/folds.h). */
static inline const CpsiObstacle *cpsi_contact_surface(const CpsiLine *line, int c,
                                                       CpsiObstacle *seen) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!cpsi_contact_has_face(line, c)) return obstacle;
    *seen = *obstacle;
    seen->face = line->face[c];
    return seen;
}

/* Is the foot of x beyond a fold of the obstacle, where that does not bear? */
static inline bool cpsi_contact_is_beyond(const CpsiLine *line, int c, Vec3 x) {
    CpsiObstacle seen;
    return cpsi_contact_has_face(line, c) &&
           cpsi_obstacle_foot(cpsi_contact_surface(line, c, &seen), x).beyond;
}

#endif
