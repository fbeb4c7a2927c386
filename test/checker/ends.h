/* SPDX-License-Identifier: BSD-3-Clause */
/* Forces and tensions at the ends of a line, recomputed from a record. */
#ifndef CAPSTAN_CHECKER_ENDS_H
#define CAPSTAN_CHECKER_ENDS_H

#include "record.h"

typedef struct End {
    Real force[3];    /* [N] on the line */
    Real friction[3]; /* [N] on its half element */
    Real reaction;    /* [N] of the obstacle on it, where it is held */
    Real slid;        /* [J] that friction dissipates */
    Real carried;     /* [J] its work on the path of an obstacle that turns */
} End;

/* End e (0: A, 1: B). A held end that touches several obstacles may lie on each of them: of these
 * answers, the one that is nearest to what the file says. */
End end_measure(const Source *source, const Record *record, int e);

/* [J] Work of both ends since the record before, by the trapezium rule; friction of half elements
 * works with the force after. */
Real ends_work(const Record *record, const Record *before);

#endif
