/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/law.h: friction laws, loaded laws and resistance laws.
 *     (Moreau 1977, M77; Moreau 1970, M70)
 *
 * Velocities V and forces F of one mechanical system are n components each, and their power is <V,
 * F>. A friction law is a closed convex set C of forces that contains 0; it ties F to V by -V in
 * N_C(F), "maximum dissipation": of all forces in C, F is one that takes the most power. All
 * answers that are more than a number are sets (set.h), each with its own gap.
 *
 * Laws are immutable and counted as sets are: release what was made or retained, in any order;
 * laws and systems retain the sets and laws they are made from. Matrices are row-major. In the
 * tables below W is watt, N newton; with torques among the forces read newton metre and radian per
 * second. */
#ifndef CAPSTAN_LAW_H
#define CAPSTAN_LAW_H

#include <stdbool.h>

#include "capstan/set.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- friction laws ---- */

typedef struct CpsLaw CpsLaw;

/* The law whose forces are `set`. Refused (CPS_ERR_ARGUMENT) where the set is empty or does not
 * contain 0: a force law without 0 could give power to the motion (M77 section 3); such a set is a
 * loaded law, below. */
CPS_API CpsStatus cps_law_friction(const CpsSet *set, CpsLaw **out, CpsError *err);

/* Coulomb's law with known normal force (M77 (3)): a disc of radius `friction` x `load` in the
 * tangent plane; friction and load are >= 0. phi(V) = friction load |V|. */
CPS_API CpsStatus cps_law_coulomb(double friction, double load, CpsLaw **out, CpsError *err);

/* C(N) = N C1 (M77 section 7, remark 2): the law that does not depend on how the pressure is
 * spread. `unit` is C1, of friction coefficients: an ellipse, a box, any set with 0; load N >= 0 in
 * newton. */
CPS_API CpsStatus cps_law_unit_load(const CpsSet *unit, double load, CpsLaw **out, CpsError *err);

/* Independent laws side by side (M77 section 8): C = C1 x C2 x .., phi(V) = phi1(V1) + phi2(V2) +
 * .. */
CPS_API CpsStatus cps_law_product(int count, const CpsLaw *const *parts, CpsLaw **out,
                                  CpsError *err);

/* The condition under which the reduced law of cps_law_preimage is complete. With L the map,
 * C' = L^-1(C) always has L* N_C(L G) inside N_C'(G): any motion of the parts obeys the reduced
 * law. The reverse, that every pair (G, W) of the reduced law comes from some motion of the parts,
 * is proved where range(L) meets C well enough (Rockafellar 1970, 23.8-23.9). */
typedef enum CpsComposition {
    CPS_COMPOSITION_INTERIOR, /* range(L) meets the interior of C: equality (M77 section 10) */
    CPS_COMPOSITION_RELATIVE_INTERIOR, /* it meets the relative interior: equality (the brakeless
                                        * wheel)
                                        */
    CPS_COMPOSITION_POLYHEDRAL,   /* what fails of the above are polyhedral factors of a product:
                                   * equality
                                   */
    CPS_COMPOSITION_NOT_SATISFIED /* none of the three: only the inclusion is proved */
} CpsComposition;
/* "interior", ..; and a sentence. Never NULL. */
CPS_API const char *cps_composition_name(CpsComposition composition);
CPS_API const char *cps_composition_text(CpsComposition composition);

/* The law of a system whose forces G (n) act through L: C' = L^-1(C), L (space of law x n);
 * velocities are W = L* V (M77 section 10).
 *
 *   composition  what holds of the list above, decided with relative tolerance 1e-9; NULL: not
 *                wanted */
CPS_API CpsStatus cps_law_preimage(int n, const double *map, const CpsLaw *law,
                                   CpsComposition *composition, CpsLaw **out, CpsError *err);

/* A rigid body on several contacts, or area contact as a sum over small areas: contact k has
 * velocity B_k W, so the body has C = sum over k of B_k* C_k, phi(W) = sum of phi_k(B_k W). The
 * boundary of C is the limit surface of planar sliding.
 *
 *   contact  (count) laws
 *   map      (count) matrices B_k, (space of contact k x n) */
CPS_API CpsStatus cps_law_contacts(int n, int count, const CpsLaw *const *contact,
                                   const double *const *map, CpsLaw **out, CpsError *err);

/* One more hold on the law; returns it. */
CPS_API CpsLaw *cps_law_retain(const CpsLaw *law);
/* Let go; NULL is accepted. The last hold frees the law. */
CPS_API void cps_law_release(CpsLaw *law);
CPS_API int cps_law_space(const CpsLaw *law);
/* C; owned by the law. */
CPS_API const CpsSet *cps_law_set(const CpsLaw *law);

/* ---- loaded laws (M77 section 12, remark) ---- */

/* A friction law whose system carries a constant load G as well: C + G, which need not contain 0.
 * Its phi may be negative: the load can give power to the motion. A type of its own, so that no
 * loaded law is composed where a friction law is needed. */
typedef struct CpsLoadedLaw CpsLoadedLaw;
CPS_API CpsStatus cps_law_load(const CpsLaw *law, const double *load, CpsLoadedLaw **out,
                               CpsError *err);
CPS_API CpsLoadedLaw *cps_loaded_law_retain(const CpsLoadedLaw *law);
CPS_API void cps_loaded_law_release(CpsLoadedLaw *law);
CPS_API int cps_loaded_law_space(const CpsLoadedLaw *law);
/* C + G; owned by the law. */
CPS_API const CpsSet *cps_loaded_law_set(const CpsLoadedLaw *law);
CPS_API const double *cps_loaded_law_load(const CpsLoadedLaw *law);

/* ---- questions to a law: `set` is that of cps_law_set or cps_loaded_law_set ---- */

/* phi(V) = sup over C of -<V, F> [W] (M77 (7)) and a force (n, or NULL) that attains it. For a
 * friction law it is the power dissipated at V, by any force of the law. Outcome UNBOUNDED: no
 * force of the law goes with V (value INFINITY).
 */
CPS_API CpsStatus cps_set_dissipation(const CpsSet *set, const double *velocity, double *force,
                                      CpsSetAnswer *answer, CpsError *err);

/* All forces of the law at V: the face of C in direction -V (M77 section 4). *forces is a new set
 * or NULL.
 *   tolerance  angle in radians, as in cps_set_face; 0 picks 1e-9 */
CPS_API CpsStatus cps_set_forces(const CpsSet *set, const double *velocity, double tolerance,
                                 CpsSet **forces, CpsSetAnswer *answer, CpsError *err);

/* All velocities of the law at F: the cone -N_C(F) (M77 (5)). *velocities is a new set or NULL;
 * outcome OUTSIDE: none.
 *   tolerance  relative length, as in cps_set_normal_cone; 0 picks 1e-9 */
CPS_API CpsStatus cps_set_velocities(const CpsSet *set, const double *force, double tolerance,
                                     CpsSet **velocities, CpsSetAnswer *answer, CpsError *err);

/* How far a pair (F, V) is from the law, in its five equivalent forms. All are 0 exactly where the
 * law holds.
 *
 * With F in C the four power forms are one number, the gap phi(V) + <V, F> >= 0, reached in four
 * ways: they agree to rounding, 1e-12 of `scale` for closed forms. The normal cone form is a
 * distance and obeys, for F in C,
 *
 *     normal_cone^2 <= step x dissipation                                   (square-root bound)
 *
 * since p = P_C(F - step V) has <F - step V - p, F - p> <= 0. With F outside by d = outside,
 * normal_cone <= 2d + sqrt of the same with P_C(F) for F. The two distances, and inverse, are NAN
 * where the projection has no answer (a user's set; lost to rounding). */
typedef struct CpsSetResidual {
    CpsSetOutcome outcome; /* UNBOUNDED: no force goes with V; the power forms are then INFINITY */
    double outside;        /* [N] dist(F, C), part of every form */
    double variational;    /* [W] max over P in C of <V, F - P>                       M77 (4) */
    double maximum_dissipation; /* [W] <V, F> - min over C of <V, .>                       M77
                                   section 4 */
    double normal_cone; /* [N] |F - P_C(F - step V)|                               M77 (5) */
    double dissipation; /* [W] phi(V) + <V, F>                                     M77 (8) */
    double inverse; /* [W] phi(V) + <V, F> - min over U of (phi(U) + <U, F>)    M77 (10); INFINITY
                       outside C */
    double power;   /* [W] dissipated: -<V, F> */
    double step;    /* [N s/m] the one used */
    double scale;   /* [W] |V| (|F| + |P|), P a force of the law at V: what "relative" means */
    double gap;     /* bound on the errors of the numbers above, 0 where closed forms were used */
} CpsSetResidual;

/*   step  > 0; 0 picks |F| or |P| over |V|, whichever force is larger
 *
 * F counts as in C within 1e-12 (|F| + |P|). */
CPS_API CpsStatus cps_set_residual(const CpsSet *set, const double *force, const double *velocity,
                                   double step, CpsSetResidual *residual, CpsError *err);

/* ---- resistance laws ---- */

/* -F in dphi(V) for a convex potential phi >= phi(0) = 0 (M77 section 7, remark 1; M70 section 7).
 * Every term here is phi = h(g): g(V) is the dissipation function of a set C with 0, convex and
 * homogeneous of degree 1, and h is convex and increasing. Then
 *
 *     forces:           -F = h'(g(V)) x a point of dg(V)
 *     dissipated power: -<V, F> = g h'(g)
 *     conjugate:        h*(gauge of C at F)
 *
 * Terms add up; so do their powers, and their conjugates by inf-convolution. */
typedef struct CpsResistance CpsResistance;

/* Dry friction: h(g) = g. */
CPS_API CpsStatus cps_resistance_dry(const CpsLaw *law, CpsResistance **out, CpsError *err);

/* Linear viscosity: F = -D V, phi = <V, D V>/2 (Rayleigh), power 2 phi; D (n x n) in N s/m.
 * Refused: a matrix that is not symmetric (to 1e-12 of its largest entry), because its force is no
 * subdifferential (M70 section 7), or not positive semidefinite. A singular one is kept as the
 * power of degree 2 of the flat ellipsoid {L y : |y| <= 1}, D = L L'. */
CPS_API CpsStatus cps_resistance_viscous(int n, const double *matrix, CpsResistance **out,
                                         CpsError *err);

/* h(g) = factor g^degree / degree: power = degree x phi. degree > 1, factor >= 0. Refused: a degree
 * below 1, for which friction falls with speed. (Degree 1 is cps_resistance_dry.) */
CPS_API CpsStatus cps_resistance_power(const CpsLaw *law, double degree, double factor,
                                       CpsResistance **out, CpsError *err);

/* h' piecewise linear: friction is C times a factor h'(g) that depends on speed, through the points
 * (speed_i, factor_i), and constant after the last. speed_0 = 0, speeds increase. Refused: a factor
 * that falls with speed, since the force is then no subdifferential (M70 section 7), and a negative
 * factor, since phi < phi(0) gives power to the motion. */
CPS_API CpsStatus cps_resistance_table(const CpsLaw *law, int count, const double *speed,
                                       const double *factor, CpsResistance **out, CpsError *err);

/* A convex h of the user's: write h(speed) and its slope h'(speed) >= 0 at a speed >= 0 [W, a value
 * of g], INFINITY for both beyond the end of its domain; false: no answer. h(0) = 0, h and h' do
 * not fall and h' is continuous. The optional conjugate writes h*(slope) and a speed that attains
 * it, INFINITY for both where none does; without it h* comes from h by bisection. Both must be fit
 * for every thread that asks, and `user` must outlive the law and its sums.
 *
 * Whatever is evaluated is checked. Refused (CPS_ERR_ARGUMENT), at the making on pairs of speeds
 * from 2^-40 to 2^40 and later by the question that finds it: a slope that falls (no
 * subdifferential), a value or slope below 0 (power to the motion), values that are not the
 * integral of the slopes, a conjugate that is not that of h. */
typedef bool CpsSpeedLaw(void *user, double speed, double *value, double *slope);
typedef bool CpsSpeedConjugate(void *user, double slope, double *value, double *speed);
CPS_API CpsStatus cps_resistance_function(const CpsLaw *law, CpsSpeedLaw *h,
                                          CpsSpeedConjugate *conjugate, void *user,
                                          CpsResistance **out, CpsError *err);

/* All terms of all parts together. */
CPS_API CpsStatus cps_resistance_sum(int count, const CpsResistance *const *parts,
                                     CpsResistance **out, CpsError *err);

CPS_API CpsResistance *cps_resistance_retain(const CpsResistance *law);
CPS_API void cps_resistance_release(CpsResistance *law);
CPS_API int cps_resistance_space(const CpsResistance *law);
CPS_API int cps_resistance_term_count(const CpsResistance *law);

/* Potential phi and dissipated power -<V, F> [W], whole and by term (capacity:
 * cps_resistance_term_count, or NULL). The power is that of every force of the law at V. `gap`
 * bounds the error of both. */
typedef struct CpsResistanceValue {
    CpsSetOutcome outcome; /* UNBOUNDED: no force goes with V */
    double potential, power, gap;
} CpsResistanceValue;
CPS_API CpsStatus cps_resistance_value(const CpsResistance *law, const double *velocity,
                                       CpsResistanceValue *whole, CpsResistanceValue *by_term,
                                       CpsError *err);

/* All forces of the law at V: -dphi(V), a sum of scaled faces. */
CPS_API CpsStatus cps_resistance_forces(const CpsResistance *law, const double *velocity,
                                        double tolerance, CpsSet **forces, CpsSetAnswer *answer,
                                        CpsError *err);

/* phi*(-F), and a velocity of the law at F (n, or NULL; unique with a viscous term, else one of
 * several). A sum shares F among its terms at least cost:
 *
 *     phi*(-F) = min sum of h_i*(gauge_i(F_i)), F_1 + F_2 + .. = F
 *         = max over V of -<V, F> - phi(V)
 *
 * Closed forms (exact): one term (the velocity is found as for a sum), viscous terms, and dry terms
 * with viscosity c I where the dry set has a closed projection. Else the value is that of the best
 * split found, and the gap what it is above the bound of the best velocity, both from the terms'
 * own formulas; CPS_SET_OUTCOME_INACCURATE where that is more than 1e-9 of phi(V) + phi*(-F). The
 * velocity is right to the root of the relative gap where phi is curved. OUTSIDE, value INFINITY:
 * no velocity goes with F; a force outside by less than answer->tolerance counts as on the
 * boundary. NOT_AVAILABLE: a user's set.
 */
CPS_API CpsStatus cps_resistance_conjugate(const CpsResistance *law, const double *force,
                                           double *velocity, CpsSetAnswer *answer, CpsError *err);

/* Dry terms alone: the velocities at a force are a cone. */
CPS_API bool cps_resistance_is_dry(const CpsResistance *law);

/* All velocities of the law at F, the subgradients of phi* at -F: one with a viscous term and where
 * slopes rise, else a cone (dry terms at their limit) or what is between two speeds of the same
 * slope. *velocities NULL where there are none; answer as of the conjugate. */
CPS_API CpsStatus cps_resistance_velocities(const CpsResistance *law, const double *force,
                                            CpsSet **velocities, CpsSetAnswer *answer,
                                            CpsError *err);

/* How far (F, V) is from the law: the Fenchel gap phi(V) + phi*(-F) + <V, F> >= 0 [W] to *gap (NAN
 * where the conjugate has no answer), and dist(F, forces of the law at V) [N] to *distance. */
CPS_API CpsStatus cps_resistance_residual(const CpsResistance *law, const double *force,
                                          const double *velocity, double *gap, double *distance,
                                          CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
