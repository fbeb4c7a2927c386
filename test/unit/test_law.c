/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws: what is accepted, what is refused and why, loads, residuals, and resistance laws term by
 * term. */
#include <string.h>

#include "capstan/law.h"
#include "check.h"

/* Closed forms of a few operations. */
static const double ROUNDING = 1e-13;

/* The gap at which the conjugate of a sum may end, and what that leaves of a velocity: phi is
 * quadratic round it. */
static const double CONIC = 1e-11, ROOT = 3e-6;

#define OK(call) assert_int_equal((call), CPS_OK)

/* the call is refused with CPS_ERR_ARGUMENT and a message with `part` in it */
#define REFUSED(call, part)                            \
    do {                                               \
        CpsError err = {0};                            \
        assert_int_equal((call), CPS_ERR_ARGUMENT);    \
        if (!strstr(err.message, part)) {              \
            print_error("message: %s\n", err.message); \
            fail();                                    \
        }                                              \
    } while (0)

static CpsLaw *coulomb(double radius) {
    CpsLaw *law = NULL;
    OK(cps_law_coulomb(0.5, 2 * radius, &law, NULL));
    return law;
}

static void laws_without_zero_are_refused(void **state) {
    (void)state;
    CpsLaw *law = NULL;
    CpsSet *away = NULL, *empty = NULL;
    const double centre[2] = {3, 0}, rows[4] = {1, 0, -1, 0}, offsets[2] = {-1, -1};
    OK(cps_set_ball(2, centre, 2, &away, NULL));
    OK(cps_set_inequalities(2, 2, rows, offsets, &empty, NULL));
    REFUSED(cps_law_friction(away, &law, &err), "does not contain 0");
    REFUSED(cps_law_friction(empty, &law, &err), "empty");
    REFUSED(cps_law_unit_load(away, 5, &law, &err), "does not contain 0");
    REFUSED(cps_law_friction(NULL, &law, &err), "NULL");
    assert_null(law);
    cps_set_release(away);
    cps_set_release(empty);
}

/* laws are counted: what is retained outlives the release of what was made, in any order */
static void holds_are_counted(void **state) {
    (void)state;
    const double load[2] = {1, 2}, velocity[2] = {3, 4};
    CpsLaw *law = coulomb(5), *same = cps_law_retain(law);
    assert_ptr_equal(same, law);
    CpsLoadedLaw *loaded = NULL, *again;
    CpsResistance *dry = NULL, *held;
    OK(cps_law_load(law, load, &loaded, NULL));
    OK(cps_resistance_dry(law, &dry, NULL));
    again = cps_loaded_law_retain(loaded);
    held = cps_resistance_retain(dry);
    cps_law_release(law);
    cps_loaded_law_release(loaded);
    cps_resistance_release(dry);
    CHECK_INT(cps_law_space(same), 2);
    CHECK_NEAR(cps_loaded_law_load(again)[1], 2, 0);
    CpsResistanceValue value;
    OK(cps_resistance_value(held, velocity, &value, NULL, NULL));
    CHECK_NEAR(value.power, 25, 25 * ROUNDING); /* 5 N at 5 m/s */
    cps_resistance_release(held);
    cps_loaded_law_release(again);
    cps_law_release(same);
    assert_null(cps_law_retain(NULL));
    assert_null(cps_loaded_law_retain(NULL));
    assert_null(cps_resistance_retain(NULL));
}

static void bad_numbers_are_refused(void **state) {
    (void)state;
    CpsLaw *law = NULL;
    REFUSED(cps_law_coulomb(-0.1, 10, &law, &err), "friction coefficient");
    REFUSED(cps_law_coulomb(NAN, 10, &law, &err), "friction coefficient");
    REFUSED(cps_law_coulomb(0.1, -10, &law, &err), "normal load");
    REFUSED(cps_law_coulomb(0.1, INFINITY, &law, &err), "normal load");
    law = coulomb(5);
    const double velocity[2] = {1, NAN};
    CpsSetAnswer answer;
    CpsSetResidual residual;
    CpsLoadedLaw *loaded = NULL;
    REFUSED(cps_set_dissipation(cps_law_set(law), velocity, NULL, &answer, &err),
            "component 2 of the velocity");
    REFUSED(cps_set_residual(cps_law_set(law), velocity, velocity, 0, &residual, &err),
            "component 2 of the force");
    REFUSED(cps_law_load(law, velocity, &loaded, &err), "component 2 of the load");
    REFUSED(cps_law_product(0, NULL, &law, &err), "NULL");
    cps_law_release(law);
}

static void unit_load_scales(void **state) {
    (void)state;
    /* an anisotropic law: friction 0.3 along, 0.1 across */
    const double shape[4] = {0.09, 0, 0, 0.01}, velocity[2] = {0.6, 0.8};
    CpsSet *unit = NULL;
    CpsLaw *law = NULL;
    CpsSetAnswer answer;
    OK(cps_set_ellipsoid(2, NULL, shape, &unit, NULL));
    OK(cps_law_unit_load(unit, 10, &law, NULL));
    OK(cps_set_dissipation(cps_law_set(law), velocity, NULL, &answer, NULL));
    CHECK_RELATIVE(answer.value, 1.9697715603592207, ROUNDING);
    cps_law_release(law);
    OK(cps_law_unit_load(unit, 0, &law, NULL));
    OK(cps_set_dissipation(cps_law_set(law), velocity, NULL, &answer, NULL));
    CHECK_NEAR(answer.value, 0, 0);
    cps_law_release(law);
    cps_set_release(unit);
}

static void a_load_translates(void **state) {
    (void)state;
    /* phi of C + G is phi of C - <V, G>; here negative: the load drives */
    const double load[2] = {-7, 0}, velocity[2] = {-1, 0};
    CpsLaw *law = coulomb(5);
    CpsLoadedLaw *loaded = NULL;
    CpsSetAnswer answer;
    CpsSetResidual r;
    OK(cps_law_load(law, load, &loaded, NULL));
    cps_law_release(law);
    OK(cps_set_dissipation(cps_loaded_law_set(loaded), velocity, NULL, &answer, NULL));
    CHECK_RELATIVE(answer.value, -2, ROUNDING);
    const double force[2] = {-2, 0};
    OK(cps_set_residual(cps_loaded_law_set(loaded), force, velocity, 0, &r, NULL));
    CHECK_NEAR(r.dissipation, 0, ROUNDING * r.scale);
    CHECK_NEAR(r.power, -2, ROUNDING);
    CHECK_NEAR(cps_loaded_law_load(loaded)[0], -7, 0);
    cps_loaded_law_release(loaded);
}

static void residuals_agree(void **state) {
    (void)state;
    CpsLaw *law = coulomb(5);
    const double velocity[2] = {2, 0}, force[2] = {-3, 4}, outside[2] = {-6, 0};
    CpsSetResidual r;
    OK(cps_set_residual(cps_law_set(law), force, velocity, 0.5, &r, NULL));
    /* phi = 10, <V, F> = -6; the projection of (-4, 4) is (-5, 5)/sqrt 2 */
    CHECK_NEAR(r.dissipation, 4, 1e-12 * r.scale);
    CHECK_NEAR(r.variational, 4, 1e-12 * r.scale);
    CHECK_NEAR(r.maximum_dissipation, 4, 1e-12 * r.scale);
    CHECK_NEAR(r.inverse, 4, 1e-12 * r.scale);
    CHECK_NEAR(r.normal_cone, hypot(5 / sqrt(2) - 3, 5 / sqrt(2) - 4), 1e-12);
    CHECK_LESS(r.normal_cone * r.normal_cone, r.step * r.dissipation);
    CHECK_NEAR(r.outside, 0, 0);
    OK(cps_set_residual(cps_law_set(law), outside, velocity, 0, &r, NULL));
    CHECK_RELATIVE(r.outside, 1, 1e-12);
    CHECK_NEAR(r.inverse, INFINITY, 0);
    CHECK_NEAR(r.step, 3, 0); /* |F|/|V| */
    cps_law_release(law);
}

static void unbounded_laws_answer_what_they_can(void **state) {
    (void)state;
    /* a perfect constraint along y: any force there, none along x */
    const double y[2] = {0, 1}, along[2] = {1, 0}, against[2] = {0, 1};
    CpsSet *line = NULL;
    CpsLaw *law = NULL;
    CpsSetAnswer answer;
    CpsSetResidual r;
    OK(cps_set_subspace(2, 1, y, &line, NULL));
    OK(cps_law_friction(line, &law, NULL));
    OK(cps_set_dissipation(cps_law_set(law), along, NULL, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, 0, 0);
    OK(cps_set_dissipation(cps_law_set(law), against, NULL, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    OK(cps_set_residual(cps_law_set(law), y, against, 0, &r, NULL));
    assert_int_equal(r.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    CHECK_NEAR(r.dissipation, INFINITY, 0);
    cps_law_release(law);
    cps_set_release(line);
}

/* ---- resistance laws ---- */

static void resistance_refusals(void **state) {
    (void)state;
    CpsLaw *law = coulomb(1);
    CpsResistance *out = NULL;
    const double rotated[4] = {1, 0.5, -0.5, 1}, indefinite[4] = {1, 2, 2, 1}, speed[3] = {0, 1, 2};
    const double falling[3] = {1, 0.8, 0.9}, negative[3] = {-0.1, 0, 1}, rising[3] = {1, 1, 2},
                 late[3] = {1, 1, 2};
    REFUSED(cps_resistance_viscous(2, rotated, &out, &err), "not symmetric");
    REFUSED(cps_resistance_viscous(2, indefinite, &out, &err), "not positive definite");
    REFUSED(cps_resistance_table(law, 3, speed, falling, &out, &err), "falls with speed");
    REFUSED(cps_resistance_table(law, 3, speed, negative, &out, &err), "give power to the motion");
    REFUSED(cps_resistance_table(law, 3, late, rising, &out, &err), "speeds begin with 0");
    REFUSED(cps_resistance_power(law, 0.5, 1, &out, &err), "fall with speed");
    REFUSED(cps_resistance_power(law, 1, 1, &out, &err), "more than 1");
    REFUSED(cps_resistance_power(law, 2, -1, &out, &err), "give power to the motion");
    REFUSED(cps_resistance_power(law, NAN, 1, &out, &err), "degree");
    REFUSED(cps_resistance_power(law, 2, NAN, &out, &err), "factor");

    /* parts of one sum act on one velocity */
    const double one[1] = {1};
    CpsResistance *part[2] = {NULL};
    OK(cps_resistance_dry(law, &part[0], NULL));
    OK(cps_resistance_viscous(1, one, &part[1], NULL));
    REFUSED(cps_resistance_sum(2, (const CpsResistance *const *)part, &out, &err),
            "1 components, the first 2");
    assert_null(out);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_law_release(law);
}

/* phi + phi* = -<V, F> at the law's velocity for a force, and the force is the one force there */
static void check_pair(const CpsResistance *law, const double *force) {
    double velocity[2], gap, distance;
    CpsSetAnswer answer;
    OK(cps_resistance_conjugate(law, force, velocity, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    OK(cps_resistance_residual(law, force, velocity, &gap, &distance, NULL));
    const double power = fabs(velocity[0] * force[0] + velocity[1] * force[1]);
    CHECK_NEAR(gap, 0, 1e-11 * fmax(power, 1));
    CHECK_NEAR(distance, 0, ROOT * hypot(force[0], force[1]));
}

static void power_law(void **state) {
    (void)state;
    /* phi = 4 |V|^3/3 with the unit disc */
    CpsLaw *disc = coulomb(1);
    CpsResistance *law = NULL;
    CpsResistanceValue value;
    CpsSetAnswer answer;
    const double velocity[2] = {1.2, 1.6}, force[2] = {-3, 1};
    OK(cps_resistance_power(disc, 3, 4, &law, NULL));
    OK(cps_resistance_value(law, velocity, &value, NULL, NULL));
    CHECK_RELATIVE(value.potential, 4.0 * 8 / 3, ROUNDING);
    CHECK_RELATIVE(value.power, 3 * value.potential, ROUNDING);
    /* h*(s) = (2/3) s^(3/2) / 2 */
    OK(cps_resistance_conjugate(law, force, NULL, &answer, NULL));
    CHECK_RELATIVE(answer.value, pow(10, 0.75) / 3, 1e-12);
    check_pair(law, force);
    cps_resistance_release(law);
    cps_law_release(disc);
}

static void table_law(void **state) {
    (void)state;
    /* h' = 1 + g up to g = 2, then 3 */
    const double speed[2] = {0, 2}, factor[2] = {1, 3}, slow[2] = {0.6, 0.8}, fast[2] = {3, 4},
                 rest[2] = {0, 0};
    CpsLaw *disc = coulomb(10);
    CpsResistance *law = NULL;
    CpsResistanceValue value;
    CpsSetAnswer answer;
    CpsSet *forces = NULL;
    CpsSetExtent extent;
    OK(cps_resistance_table(disc, 2, speed, factor, &law, NULL));
    /* g = 10 |V|: beyond the table */
    OK(cps_resistance_value(law, slow, &value, NULL, NULL));
    CHECK_RELATIVE(value.potential, 4 + 3 * 8, ROUNDING);
    CHECK_RELATIVE(value.power, 30, ROUNDING);
    OK(cps_resistance_value(law, fast, &value, NULL, NULL));
    CHECK_RELATIVE(value.power, 150, ROUNDING);
    /* at rest: h'(0) C */
    OK(cps_resistance_forces(law, rest, 0, &forces, &answer, NULL));
    OK(cps_set_extent(forces, slow, &extent, NULL));
    CHECK_RELATIVE(extent.high, 10, ROUNDING);
    cps_set_release(forces);
    /* gauge 2 is reached at g = 1; more than 3 never */
    const double force[2] = {0, -20}, large[2] = {0, 31}, small[2] = {0, 9};
    OK(cps_resistance_conjugate(law, force, NULL, &answer, NULL));
    CHECK_RELATIVE(answer.value, 2 * 1 - 1.5, 1e-12);
    check_pair(law, force);
    check_pair(law, small);
    OK(cps_resistance_conjugate(law, large, NULL, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
    cps_resistance_release(law);
    cps_law_release(disc);
}

static void viscous_law(void **state) {
    (void)state;
    const double matrix[4] = {4, 1, 1, 3}, velocity[2] = {1, -2}, force[2] = {5, 7};
    CpsResistance *law = NULL, *twice[2], *sum = NULL;
    CpsResistanceValue value;
    OK(cps_resistance_viscous(2, matrix, &law, NULL));
    OK(cps_resistance_value(law, velocity, &value, NULL, NULL));
    CHECK_RELATIVE(value.power, 12, ROUNDING);
    CHECK_RELATIVE(value.potential, 6, ROUNDING);
    check_pair(law, force);
    twice[0] = twice[1] = law;
    OK(cps_resistance_sum(2, (const CpsResistance *const *)twice, &sum, NULL));
    CHECK_INT(cps_resistance_term_count(sum), 2);
    OK(cps_resistance_value(sum, velocity, &value, NULL, NULL));
    CHECK_RELATIVE(value.power, 24, ROUNDING);
    check_pair(sum, force);
    cps_resistance_release(law);
    cps_resistance_release(sum);
}

static void mixed_sum(void **state) {
    (void)state;
    /* phi = |V| + 2 |V|^3/3: the force at |V| = 1 is 1 + 2, and phi* = 3 - 5/3 */
    CpsLaw *disc = coulomb(1);
    CpsResistance *part[2] = {NULL}, *sum = NULL;
    CpsSetAnswer answer;
    double gap, distance, found[2];
    const double velocity[2] = {1, 0}, force[2] = {-3, 0}, weak[2] = {0.6, -0.7}, none[2] = {0, 0};
    OK(cps_resistance_dry(disc, &part[0], NULL));
    OK(cps_resistance_power(disc, 3, 2, &part[1], NULL));
    OK(cps_resistance_sum(2, (const CpsResistance *const *)part, &sum, NULL));
    OK(cps_resistance_conjugate(sum, force, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_RELATIVE(answer.value, 4.0 / 3, CONIC);
    CHECK_NEAR(answer.gap, 0, CONIC * 3);
    CHECK_NEAR(found[0], 1, ROOT);
    CHECK_NEAR(found[1], 0, ROOT);
    OK(cps_resistance_residual(sum, force, velocity, &gap, &distance, NULL));
    CHECK_NEAR(gap, 0, CONIC * 3);
    CHECK_NEAR(distance, 0, 1e-12);
    /* what rest bears, and nothing */
    OK(cps_resistance_conjugate(sum, weak, found, &answer, NULL));
    CHECK_NEAR(answer.value, 0, 0);
    CHECK_NEAR(hypot(found[0], found[1]), 0, 0);
    OK(cps_resistance_conjugate(sum, none, found, &answer, NULL));
    CHECK_NEAR(answer.value, 0, 0);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(sum);
    cps_law_release(disc);
}

/* one dry and one viscous term: phi* and V at F */
static void check_dry_and_viscous(CpsSet *dry, const double *force, double value, double v0,
                                  double v1) {
    const double d[4] = {2, 0.5, 0.5, 1};
    CpsLaw *law = NULL;
    CpsResistance *part[2] = {NULL}, *sum = NULL;
    CpsSetAnswer answer;
    double found[2];
    OK(cps_law_friction(dry, &law, NULL));
    OK(cps_resistance_dry(law, &part[0], NULL));
    OK(cps_resistance_viscous(2, d, &part[1], NULL));
    OK(cps_resistance_sum(2, (const CpsResistance *const *)part, &sum, NULL));
    OK(cps_resistance_conjugate(sum, force, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_NEAR(answer.value, value, CONIC * 3 * value);
    CHECK_NEAR(found[0], v0, ROOT * hypot(v0, v1));
    CHECK_NEAR(found[1], v1, ROOT * hypot(v0, v1));
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(sum);
    cps_law_release(law);
}

static void unbounded_terms(void **state) {
    (void)state;
    const double rail[2] = {1, 0}, force[2] = {3, 7}, across[2] = {0.5, -40};
    const double low[2] = {-1, -1}, high[2] = {INFINITY, 1}, against[2] = {6.9, 3};
    const double rays[4] = {1, 0.3, 1, -0.3}, away[2] = {-5, 3};
    CpsSet *set = NULL;
    /* |F_x| <= 1 and any F_y: a rail along x. V_y = 0, V_x = -(F_x - 1)/2, phi* = (F_x - 1)^2/4 */
    OK(cps_set_strip(2, rail, -1, 1, &set, NULL));
    check_dry_and_viscous(set, force, 1, -1, 0);
    check_dry_and_viscous(set, across, 0, 0, 0);
    cps_set_release(set);
    /* a ratchet: no motion to -x; V_y = -(F_y - 1) */
    OK(cps_set_box(2, low, high, &set, NULL));
    check_dry_and_viscous(set, against, 2, 0, -2);
    cps_set_release(set);
    /* a wedge that bears nothing: V = -D^-1 F */
    OK(cps_set_cone_of_rays(2, 2, rays, &set, NULL));
    check_dry_and_viscous(set, away, 0.5 * (5 * 6.5 + 3 * 8.5) / 1.75, 6.5 / 1.75, -8.5 / 1.75);
    cps_set_release(set);
}

static bool unit_ball(void *user, int n, const double *direction, double *value, double *point) {
    (void)user;
    *value = 0;
    for (int i = 0; i < n; i++) *value = hypot(*value, direction[i]);
    for (int i = 0; i < n; i++) point[i] = *value > 0 ? direction[i] / *value : 0;
    return true;
}

static void sums_without_an_answer(void **state) {
    (void)state;
    /* dry and a table that ends: forces up to 1 + 2 x 2 along x, none along y */
    const double from[2] = {-1, 0}, to[2] = {1, 0}, speed[2] = {0, 1}, factor[2] = {0, 2},
                 d[4] = {2, 1, 1, 2};
    const double inside[2] = {4.9, 0}, outside[2] = {5.1, 0}, beside[2] = {1, 0.1};
    CpsSet *segment = NULL, *user = NULL;
    CpsLaw *law = NULL;
    CpsResistance *part[3] = {NULL}, *sum = NULL, *same = NULL;
    CpsSetAnswer answer;
    double found[2];
    OK(cps_set_segment(2, from, to, &segment, NULL));
    OK(cps_law_unit_load(segment, 2, &law, NULL));
    OK(cps_resistance_table(law, 2, speed, factor, &part[0], NULL));
    cps_law_release(law);
    OK(cps_law_friction(segment, &law, NULL));
    OK(cps_resistance_dry(law, &part[1], NULL));
    OK(cps_resistance_sum(2, (const CpsResistance *const *)part, &sum, NULL));
    OK(cps_resistance_conjugate(sum, inside, found, &answer, NULL));
    /* the table bears 3.9 = 2 h', h' = 2 g, g = 2 |V|; h*(s) = s^2/4 */
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_RELATIVE(answer.value, 1.95 * 1.95 / 4, CONIC);
    CHECK_NEAR(found[0], -0.4875, ROOT);
    OK(cps_resistance_conjugate(sum, outside, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
    assert_true(isinf(answer.value));
    OK(cps_resistance_conjugate(sum, beside, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);

    /* a user's set has no gauge */
    OK(cps_resistance_viscous(2, d, &part[2], NULL));
    OK(cps_set_user(2, unit_ball, NULL, &user, NULL));
    cps_resistance_release(part[0]);
    cps_law_release(law);
    OK(cps_law_friction(user, &law, NULL));
    OK(cps_resistance_power(law, 3, 1, &part[0], NULL));
    const CpsResistance *has_second_contacts[2] = {part[0], part[2]};
    OK(cps_resistance_sum(2, has_second_contacts, &same, NULL));
    OK(cps_resistance_conjugate(same, inside, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_NOT_AVAILABLE);
    cps_law_release(law);
    for (int i = 0; i < 3; i++) cps_resistance_release(part[i]);
    cps_resistance_release(sum);
    cps_resistance_release(same);
    cps_set_release(segment);
    cps_set_release(user);
}

/* ---- functions of the user's: h and h' by number of the case ---- */

enum { SOFT, FALLING, NEGATIVE, BACKWARD, NOT_ITS_SLOPE, NO_NUMBER, NO_REST, CORNER, GOVERNOR };

static bool function(void *user, double g, double *value, double *slope) {
    const int which = *(const int *)user;
    *value = g * g / (1 + g);
    *slope = g * (2 + g) / ((1 + g) * (1 + g)); /* soft: the slope tends to 1 */
    if (which == FALLING) {
        *value = log1p(g);
        *slope = 1 / (1 + g);
    }
    if (which == NEGATIVE) {
        *value = g * g - g;
        *slope = 2 * g - 1;
    }
    if (which == BACKWARD) {
        *value = -g * g;
        *slope = -2 * g;
    }
    if (which == NOT_ITS_SLOPE) {
        *value = g * g * g / 3;
        *slope = 2 * g * g;
    }
    if (which == NO_NUMBER) {
        *value = g > 3 ? NAN : g;
        *slope = 1;
    }
    if (which == NO_REST) {
        *value = 1 + g;
        *slope = 1;
    }
    if (which == CORNER) {
        *value = g <= 2 ? g : 2 + 3 * (g - 2);
        *slope = g <= 2 ? 1 : 3;
    }
    if (which == GOVERNOR) {
        *value = g <= 1 ? g * g / 2 : INFINITY;
        *slope = g <= 1 ? g : INFINITY;
    }
    return true;
}

static bool soft_conjugate(void *user, double s, double *value, double *g) {
    /* h' = 1 - 1/(1+g)^2 */
    *g = s < 1 ? 1 / sqrt(1 - s) - 1 : INFINITY;
    *value = s < 1 ? (1 - sqrt(1 - s)) * (1 - sqrt(1 - s)) : INFINITY;
    (void)user;
    return true;
}

static bool wrong_conjugate(void *user, double s, double *value, double *g) {
    (void)soft_conjugate(user, s, value, g);
    *value *= 1.001;
    return true;
}

static void function_refusals(void **state) {
    (void)state;
    static const struct {
        int which;
        const char *reason;
    } CASE[] = {{FALLING, "falls with speed"},
                {NEGATIVE, "power to the motion"},
                {BACKWARD, "power to the motion"},
                {NOT_ITS_SLOPE, "not the slope of its values"},
                {NO_NUMBER, "no value and slope at speed 4"},
                {NO_REST, "expected 0"}};
    CpsLaw *disc = coulomb(1);
    CpsResistance *out = NULL;
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        int which = CASE[i].which;
        REFUSED(cps_resistance_function(disc, function, NULL, &which, &out, &err), CASE[i].reason);
    }
    REFUSED(cps_resistance_function(disc, NULL, NULL, NULL, &out, &err), "NULL");
    assert_null(out);

    /* found when it is asked: a conjugate of something else, and a function that changes its
     * mind */
    int which = SOFT;
    const double force[2] = {0.3, 0.4}, velocity[2] = {1, 1};
    CpsSetAnswer answer;
    CpsResistanceValue value;
    OK(cps_resistance_function(disc, function, wrong_conjugate, &which, &out, NULL));
    REFUSED(cps_resistance_conjugate(out, force, NULL, &answer, &err), "conjugate is");
    which = FALLING;
    REFUSED(cps_resistance_value(out, velocity, &value, NULL, &err), "falls with speed");
    cps_resistance_release(out);
    cps_law_release(disc);
}

static void function_law(void **state) {
    (void)state;
    int soft = SOFT, corner = CORNER, governor = GOVERNOR;
    CpsLaw *disc = coulomb(1);
    CpsSetAnswer answer;
    CpsResistanceValue value;
    const double velocity[2] = {0, 3}, force[2] = {0.3, -0.4}, strong[2] = {2, 0},
                 level[2] = {0, 2};
    const double three[2] = {3, 0};
    double found[2];
    for (int given = 0; given < 2; given++) {
        CpsResistance *law = NULL;
        OK(cps_resistance_function(disc, function, given ? soft_conjugate : NULL, &soft, &law,
                                   NULL));
        OK(cps_resistance_value(law, velocity, &value, NULL, NULL));
        CHECK_RELATIVE(value.potential, 9.0 / 4, ROUNDING);
        CHECK_RELATIVE(value.power, 3 * 15.0 / 16, ROUNDING);
        OK(cps_resistance_conjugate(law, force, found, &answer, NULL));
        CHECK_RELATIVE(answer.value, (1 - sqrt(0.5)) * (1 - sqrt(0.5)), 1e-12);
        CHECK_NEAR(hypot(found[0], found[1]), sqrt(2) - 1, ROOT);
        check_pair(law, force);
        OK(cps_resistance_conjugate(law, strong, found, &answer, NULL));
        assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
        cps_resistance_release(law);
    }
    /* a jump of the slope from 1 to 3 at speed 2: forces between them go with that speed */
    CpsResistance *law = NULL;
    OK(cps_resistance_function(disc, function, NULL, &corner, &law, NULL));
    OK(cps_resistance_conjugate(law, level, found, &answer, NULL));
    CHECK_RELATIVE(answer.value, 2 * 2 - 2, 1e-12);
    CHECK_NEAR(found[1], -2, ROOT * 2);
    cps_resistance_release(law);

    /* a governor allows speeds up to 1: phi* = 3 - 1/2 at |F| = 3; no force goes with more. With as
     * much viscosity: at |F| = 6 it is 6 - 1/2 - 1/2, and F = 1 is shared in equal parts */
    const double d[4] = {1, 0, 0, 1}, large[2] = {0, 6}, small[2] = {1, 0};
    CpsResistance *part[2] = {NULL}, *sum = NULL;
    CpsSet *forces = NULL;
    OK(cps_resistance_function(disc, function, NULL, &governor, &part[0], NULL));
    OK(cps_resistance_conjugate(part[0], three, found, &answer, NULL));
    CHECK_RELATIVE(answer.value, 2.5, 1e-12);
    CHECK_NEAR(found[0], -1, ROOT);
    OK(cps_resistance_forces(part[0], velocity, 0, &forces, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_UNBOUNDED);
    assert_null(forces);
    OK(cps_resistance_viscous(2, d, &part[1], NULL));
    OK(cps_resistance_sum(2, (const CpsResistance *const *)part, &sum, NULL));
    OK(cps_resistance_conjugate(sum, large, found, &answer, NULL));
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_RELATIVE(answer.value, 5, CONIC * 3);
    CHECK_NEAR(found[1], -1, ROOT);
    OK(cps_resistance_conjugate(sum, small, found, &answer, NULL));
    CHECK_RELATIVE(answer.value, 0.25, CONIC * 3);
    CHECK_NEAR(found[0], -0.5, ROOT);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(sum);
    cps_law_release(disc);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_without_zero_are_refused),
        cmocka_unit_test(holds_are_counted),
        cmocka_unit_test(bad_numbers_are_refused),
        cmocka_unit_test(unit_load_scales),
        cmocka_unit_test(a_load_translates),
        cmocka_unit_test(residuals_agree),
        cmocka_unit_test(unbounded_laws_answer_what_they_can),
        cmocka_unit_test(resistance_refusals),
        cmocka_unit_test(power_law),
        cmocka_unit_test(table_law),
        cmocka_unit_test(viscous_law),
        cmocka_unit_test(mixed_sum),
        cmocka_unit_test(unbounded_terms),
        cmocka_unit_test(sums_without_an_answer),
        cmocka_unit_test(function_refusals),
        cmocka_unit_test(function_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
