/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/law.h: friction laws, loaded laws and resistance laws.
 *     (Moreau 1977, M77; Moreau 1970, M70)
 *
 * Velocities V and forces F of a mechanical system have n components each, and their power is
 * <V, F>. A friction law is a closed convex set C of forces that contains 0. It relates F and V by
 * -V in N_C(F), the principle of maximum dissipation: among all forces in C, F takes the most power
 * from the motion V. Answers that are more than a number are sets (set.h), each with its own gap.
 *
 * Laws are immutable and have reference counts, as sets have: release what was made or retained, in
 * any order; laws and systems retain the sets and laws of which they are made. Matrices are stored
 * row by row. [W] is watt and [N] newton; for components that are torques read newton metre and
 * radian per second. */
#ifndef CAPSTAN_LAW_H
#define CAPSTAN_LAW_H

#include <stdbool.h>

#include "capstan/set.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- friction laws ---- */

typedef struct CpsLaw CpsLaw;

/* The law whose forces are `set`. A set that is empty or does not contain 0 is refused
 * (CPS_ERR_ARGUMENT), because its forces could give power to the motion (M77 section 3); such a set
 * is that of a loaded law, below. */
CPS_API CpsStatus cps_law_friction(const CpsSet *set, CpsLaw **out, CpsError *err);

/* Coulomb's law with a given normal force (M77 (3)): a disc of radius `friction` x `load` in the
 * tangent plane, with a coefficient [-] >= 0 and a load [N] >= 0. phi(V) = friction load |V|. */
CPS_API CpsStatus cps_law_coulomb(double friction, double load, CpsLaw **out, CpsError *err);

/* C(N) = N C1 for a normal force N (M77 section 7, remark 2), however the pressure is distributed.
 * `unit` is C1, a set of friction coefficients that contains 0: an ellipse, a box, or any other;
 * `load` is N >= 0 [N]. */
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
 *   composition  out: which of the conditions above holds, decided with the relative tolerance
 *                1e-9; may be NULL */
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

/* Add a reference to the law, and return the law. */
CPS_API CpsLaw *cps_law_retain(const CpsLaw *law);
/* Remove a reference; the last one frees the law. NULL is accepted. */
CPS_API void cps_law_release(CpsLaw *law);
CPS_API int cps_law_space(const CpsLaw *law);
/* The set C; owned by the law. */
CPS_API const CpsSet *cps_law_set(const CpsLaw *law);

/* ---- loaded laws (M77 section 12, remark) ---- */

/* The law C + G of a system on which a constant load G [N] acts beside friction. The set need not
 * contain 0, and phi may be negative, since the load can give power to the motion. It has a type of
 * its own because a loaded law cannot be composed as friction laws are. */
typedef struct CpsLoadedLaw CpsLoadedLaw;
CPS_API CpsStatus cps_law_load(const CpsLaw *law, const double *load, CpsLoadedLaw **out,
                               CpsError *err);
CPS_API CpsLoadedLaw *cps_loaded_law_retain(const CpsLoadedLaw *law);
CPS_API void cps_loaded_law_release(CpsLoadedLaw *law);
CPS_API int cps_loaded_law_space(const CpsLoadedLaw *law);
/* The set C + G, and the load G (n); owned by the law. */
CPS_API const CpsSet *cps_loaded_law_set(const CpsLoadedLaw *law);
CPS_API const double *cps_loaded_law_load(const CpsLoadedLaw *law);

/* ---- queries: `set` is that of cps_law_set or cps_loaded_law_set ---- */

/* phi(V) = sup over C of -<V, F> [W] (M77 (7)), and a force (n, or NULL) that attains it. It is the
 * power that any force of a friction law dissipates at V. UNBOUNDED, with the value INFINITY: the
 * law has no force at V. */
CPS_API CpsStatus cps_set_dissipation(const CpsSet *set, const double *velocity, double *force,
                                      CpsSetAnswer *answer, CpsError *err);

/* All forces of the law at V: the face of C in direction -V (M77 section 4).
 *
 *   tolerance  [rad] as in cps_set_face; 0 stands for 1e-9
 *   forces     out: a new set, which the caller releases; NULL where there is no answer */
CPS_API CpsStatus cps_set_forces(const CpsSet *set, const double *velocity, double tolerance,
                                 CpsSet **forces, CpsSetAnswer *answer, CpsError *err);

/* All velocities of the law at F: the cone -N_C(F) (M77 (5)). OUTSIDE: there are none.
 *
 *   tolerance   [-] as in cps_set_normal_cone; 0 stands for 1e-9
 *   velocities  out: a new set, which the caller releases; NULL where there is no answer */
CPS_API CpsStatus cps_set_velocities(const CpsSet *set, const double *force, double tolerance,
                                     CpsSet **velocities, CpsSetAnswer *answer, CpsError *err);

/* The residual of a pair (F, V) in the five equivalent forms of the law. All are 0 exactly where
 * the law holds.
 *
 * For F in C the four power forms are the same number, the gap phi(V) + <V, F> >= 0, computed in
 * four ways; with closed forms they agree to rounding, 1e-12 of `scale`. The form with the normal
 * cone is a distance, and for F in C
 *
 *     normal_cone^2 <= step x dissipation                                   (square-root bound)
 *
 * since p = P_C(F - step V) has <F - step V - p, F - p> <= 0. For F at the distance d = outside
 * from C, normal_cone <= 2 d + the square root of the same product with P_C(F) in place of F. The
 * two distances, and inverse, are NAN where the projection has no answer (a user's set, or
 * rounding). */
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
    double power;   /* [W] dissipated, -<V, F> */
    double step;    /* [N s/m] that was used */
    double scale;   /* [W] |V| (|F| + |P|) for a force P of the law at V: "relative" refers to it */
    double gap;     /* bound of the errors of the numbers above, 0 where closed forms were used */
} CpsSetResidual;

/*   step  [N s/m] > 0; 0 stands for max(|F|, |P|)/|V|
 *
 * F counts as being in C up to a distance of 1e-12 (|F| + |P|). */
CPS_API CpsStatus cps_set_residual(const CpsSet *set, const double *force, const double *velocity,
                                   double step, CpsSetResidual *residual, CpsError *err);

/* ---- resistance laws ---- */

/* -F in dphi(V) for a convex potential phi >= phi(0) = 0 (M77 section 7, remark 1; M70 section 7).
 * Every term here is phi = h(g), where g(V) is the dissipation function of a set C that contains 0,
 * convex and homogeneous of degree 1, and h is convex and increasing. Then
 *
 *     forces:           -F = h'(g(V)) x a point of dg(V)
 *     dissipated power: -<V, F> = g h'(g)
 *     conjugate:        h*(gauge of C at F)
 *
 * A law is a sum of terms. Their powers add up; the conjugate of the sum is the inf-convolution of
 * their conjugates. */
typedef struct CpsResistance CpsResistance;

/* Dry friction: h(g) = g. */
CPS_API CpsStatus cps_resistance_dry(const CpsLaw *law, CpsResistance **out, CpsError *err);

/* Linear viscosity: F = -D V, phi = <V, D V>/2 (Rayleigh), power 2 phi, with D (n x n) [N s/m]. D
 * must be symmetric, to 1e-12 of its largest entry, because otherwise the force is no
 * subdifferential (M70 section 7), and positive semidefinite. A singular one is the power of degree
 * 2 of the flat ellipsoid {L y : |y| <= 1}, D = L L'. */
CPS_API CpsStatus cps_resistance_viscous(int n, const double *matrix, CpsResistance **out,
                                         CpsError *err);

/* h(g) = factor g^degree / degree, power = degree x phi; degree > 1, factor >= 0. Degree 1 is
 * cps_resistance_dry; below 1 the force would decrease with the speed. */
CPS_API CpsStatus cps_resistance_power(const CpsLaw *law, double degree, double factor,
                                       CpsResistance **out, CpsError *err);

/* Friction C times a factor h'(g) that depends on the speed: linear between the points (speed_i,
 * factor_i) and constant beyond the last. The first speed is 0, and speeds increase. A factor that
 * decreases with the speed is refused, since the force is then no subdifferential (M70 section 7),
 * and a negative one, since phi < phi(0) gives power to the motion. */
CPS_API CpsStatus cps_resistance_table(const CpsLaw *law, int count, const double *speed,
                                       const double *factor, CpsResistance **out, CpsError *err);

/* A convex function h of the user. CpsSpeedLaw writes h(speed) and its slope h'(speed) >= 0 at a
 * speed >= 0 (a value of g, [W]), INFINITY for both beyond the end of its domain, and returns false
 * when it has no answer. h(0) = 0, h and h' are non-decreasing, and h' is continuous. The optional
 * conjugate writes h*(slope) and a speed that attains it, INFINITY for both where none does;
 * without it h* is found from h by bisection. Both may be called from every thread that queries the
 * law, and `user` must outlive the law and its sums.
 *
 * All values are checked, on creation for pairs of speeds from 2^-40 to 2^40, and later by each
 * query. CPS_ERR_ARGUMENT is returned for a slope that decreases (no subdifferential), a value or
 * slope below 0 (power to the motion), values that are not the integral of the slopes, and a
 * conjugate that is not that of h. */
typedef bool CpsSpeedLaw(void *user, double speed, double *value, double *slope);
typedef bool CpsSpeedConjugate(void *user, double slope, double *value, double *speed);
CPS_API CpsStatus cps_resistance_function(const CpsLaw *law, CpsSpeedLaw *h,
                                          CpsSpeedConjugate *conjugate, void *user,
                                          CpsResistance **out, CpsError *err);

/* The law with all terms of all parts. */
CPS_API CpsStatus cps_resistance_sum(int count, const CpsResistance *const *parts,
                                     CpsResistance **out, CpsError *err);

CPS_API CpsResistance *cps_resistance_retain(const CpsResistance *law);
CPS_API void cps_resistance_release(CpsResistance *law);
CPS_API int cps_resistance_space(const CpsResistance *law);
CPS_API int cps_resistance_term_count(const CpsResistance *law);

/* The potential phi and the dissipated power -<V, F> [W], the same for every force of the law at V.
 * `gap` bounds the error of both. `by_term` has cps_resistance_term_count entries, or is NULL. */
typedef struct CpsResistanceValue {
    CpsSetOutcome outcome; /* UNBOUNDED: the law has no force at V */
    double potential, power, gap;
} CpsResistanceValue;
CPS_API CpsStatus cps_resistance_value(const CpsResistance *law, const double *velocity,
                                       CpsResistanceValue *whole, CpsResistanceValue *by_term,
                                       CpsError *err);

/* All forces of the law at V, -dphi(V): a sum of scaled faces, as from cps_set_forces. */
CPS_API CpsStatus cps_resistance_forces(const CpsResistance *law, const double *velocity,
                                        double tolerance, CpsSet **forces, CpsSetAnswer *answer,
                                        CpsError *err);

/* phi*(-F), and a velocity of the law at F (n, or NULL), which is unique where there is a viscous
 * term. A sum of terms divides F among them at least cost:
 *
 *     phi*(-F) = min sum of h_i*(gauge_i(F_i)), F_1 + F_2 + .. = F
 *         = max over V of -<V, F> - phi(V)
 *
 * The value has a closed form (exact) for one term, for viscous terms, and for dry terms with
 * viscosity c I where the dry set has a closed projection. Otherwise it is that of the best
 * division found, and the gap is its distance from the lower bound of the best velocity found, both
 * from the formulas of the terms; INACCURATE where the gap exceeds 1e-9 of phi(V) + phi*(-F). The
 * error of the velocity is of the order of the root of the relative gap where phi is curved.
 * OUTSIDE, with the value INFINITY: the law has no velocity at F; a force outside by less than
 * answer->tolerance counts as being on the boundary. NOT_AVAILABLE: a user's set. */
CPS_API CpsStatus cps_resistance_conjugate(const CpsResistance *law, const double *force,
                                           double *velocity, CpsSetAnswer *answer, CpsError *err);

/* Whether all terms are dry; then the velocities at a force are a cone. */
CPS_API bool cps_resistance_is_dry(const CpsResistance *law);

/* All velocities of the law at F, the subgradients of phi* at -F. It is a single one with a viscous
 * term and where slopes increase; otherwise a cone (dry terms at their limit), or all between two
 * speeds of the same slope. *velocities is a new set, which the caller releases, or NULL where
 * there are none; the answer is that of the conjugate. */
CPS_API CpsStatus cps_resistance_velocities(const CpsResistance *law, const double *force,
                                            CpsSet **velocities, CpsSetAnswer *answer,
                                            CpsError *err);

/* The residual of a pair (F, V): the Fenchel gap phi(V) + phi*(-F) + <V, F> >= 0 [W] in *gap (NAN
 * where the conjugate has no answer), and the distance of F from the forces of the law at V [N] in
 * *distance. */
CPS_API CpsStatus cps_resistance_residual(const CpsResistance *law, const double *force,
                                          const double *velocity, double *gap, double *distance,
                                          CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
