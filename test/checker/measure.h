/* SPDX-License-Identifier: BSD-3-Clause */
/* Every quantity of a step problem, recomputed from a record. */
#ifndef CAPSTAN_CHECKER_MEASURE_H
#define CAPSTAN_CHECKER_MEASURE_H

#include <stdbool.h>

#include "bend.h"
#include "record.h"

typedef struct Measures {
    const char *missing;    /* the first variable with a value that cannot be (NaN, infinite,
                               negative), or NULL */
    double length;          /* [m] sum of the element lengths */
    double extent;          /* [m] largest coordinate */
    double strain_rounding; /* of any element: the last bits of its coordinates over its length */
    double primal, dual;    /* [J] */
    double gap;             /* [J] sum of |local gap| over segments, friction and contact */
    double overlong; /* [J] part of the gap from inextensible elements longer than they may be */
    double
        beyond; /* [J] part of the gap from forces beyond a given friction set: phi(s) + F.s < 0 */
    double
        identity; /* [J] primal - dual - sum of local gaps + work of the imbalance: rounding only */
    double identity_noise;   /* [J] what rounding may leave there */
    double scale;            /* [J] S */
    double slid;             /* [J] sum of phi(s) */
    double law, contact;     /* [J] parts of the gap */
    double force;            /* [N] largest imbalance on a node that is not held */
    double largest_force;    /* [N] */
    double elastic, gravity; /* [J] growth of the energy of elongation and of the weight's potential
                                from the reference */
    double loads;            /* [J] work of springs, given loads and drag */
    double carried;          /* [J] work of friction on the path of obstacles that turn or move */
    double pushed;           /* [J] work of the reactions on that; not found here (places.h) */
    double bound_residual;   /* [N] sum of |w - mu R| */
    double friction_excess;  /* [N] how far outside its set a friction force is, at most */
    double friction_normal;  /* [N] max |F.n| */
    double reaction_least;   /* [N] */
    double stray_force; /* [N] friction or reaction where there is no obstacle or the end is held */
    double penetration; /* [m] max -(n.u + gap), >= 0 */
    double depth;       /* [m] of the deepest node below an obstacle, watched or not, >= 0 */
    double sunk;        /* [m] the same of nodes that are not held */
    double pierced; /* [m] how deep an element lies in a round obstacle beyond what its chord may
                       cut in, >= 0 */
    double reach;   /* [m] largest coordinate or radius of anything */
    int unwatched;  /* contacts without a contact_gap that should have one; of the reference: or the
                       other way  round */
    double gap_error;  /* [m] max |contact_gap - what it must be| */
    double slip_error; /* [m] max |slip - that from the carried reference| */
    double quarters;   /* of a turn by which an obstacle turns in the part that the arrays show, at
                          most */
    double gone_quarters; /* of a turn by which a node with friction has gone round an obstacle in
                             it, at most */
    double share_error; /* [m] how far the point where an element touches is from the nearest on its
                           way */
    int misplaced;      /* contacts with obstacles that are not the nearest and the next */
    double normal_error;  /* [-] max |n - the obstacle's|, over 1 + reach/radius on a curved one */
    double stretch;       /* [-] max |e| - 1 over inextensible elements */
    double strain_error;  /* [-] max |e| - 1 - c T beyond rounding: the tension must carry the
                             elongation */
    double push;          /* [N] largest part of an element's force that points against it, >= 0 */
    double elongation;    /* [-] max |e| - 1 - c|p| over elastic elements, >= 0 */
    double tension_least; /* [N] */
    double tension_estimate; /* [N] max |T - |p|| */
    double tension_bound;    /* [N] sqrt(2 gap / (c L)), NaN for c = 0 */
    double held_error;       /* [m] how far a held end is from where it is imposed */
    double
        rigid_fall; /* [N] fall of the energy per metre along `proof`, NaN without a proof vector */
    bool meets;     /* does the line meet an obstacle on that way? (where obstacles are round) */
    double rigid_rise_least; /* [-] min n.proof over nodes that may touch */
    Bend bend;
} Measures;

/* Where contact is seen from: the configuration reached; the reference; or the one reached, but for
 * friction, whose axes and slips are those of the reference. */
typedef enum Sight { SIGHT_REACHED, SIGHT_REFERENCE, SIGHT_FROZEN } Sight;

/* Sets record->mu. */
Measures measure(const Source *source, const Record *record, Sight sight);

/* The plane of friction of element i on surface `on`, and its direction there: those of its point
 * that is nearest to the obstacle. Frozen friction has them from the reference, at the share t
 * where none was nearest between the nodes. */
void measure_element_plane(const Record *r, const Surface *on, size_t i, bool frozen, Real t,
                           const Real *x, Real *plane, Real *along);

#endif
