/* SPDX-License-Identifier: BSD-3-Clause */
/* Which obstacle, and which of its feet, a contact of a node sees, and whether it is the one that
 * it must be with. */
#ifndef CAPSTAN_CHECKER_SEEN_H
#define CAPSTAN_CHECKER_SEEN_H

#include "record.h"

/* Where contact is seen from: the configuration reached, or the reference. */
typedef struct Where {
    const Source *source;
    Vector *place;
    bool reached, frozen; /* frozen: friction is that of the reference whatever place */
    /* [m] largest coordinate, radius and obstacle coordinate: what rounding goes with */
    Real reach;
} Where;

/* Where the contacts of node j are seen from: a held end on which an obstacle pushes is where it
 * came to. */
void seen_from(const Where *where, const Record *r, size_t j, Real x[3]);
/* The obstacle of contact c of node j, which the file says where there are several; a held node's
 * may be that of either place, so it is the nearest here. NULL: none. */
const Surface *seen_surface(const Where *where, const Record *r, size_t j, size_t c);
/* ... as the contact sees it: with contact of the reference, and of what is held, its nearest
 * foot. */
Surface seen_by(const Where *where, const Record *r, size_t j, size_t c);
/* Is contact c with the nearest foot of all obstacles but for those before it, within a margin? The
 * other contact of its node is with the nearest of the rest, unless it stays. */
bool seen_in_place(const Where *where, const Record *r, size_t j, size_t c, Real margin);

#endif
