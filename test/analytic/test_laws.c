/* SPDX-License-Identifier: BSD-3-Clause */
/* Friction and resistance laws with closed forms: the braked wheel (M77 sections 9-10), dry and
 * viscous friction (Bingham), limit surfaces of ring, disc and rod as sums over contacts, the bipod
 * whose force set is a whole disc. */
#include <stdio.h>
#include <stdlib.h>

#include "capstan/law.h"
#include "check.h"

/* Closed forms in a handful of operations: rounding of the values, 1e-10 with a margin for the
 * conic solver's 1e-9 gap being met far better than promised. */
static const double EXACT = 1e-10;

static const double PI = 3.14159265358979323846;

static CpsLaw *disc_law(double radius) {
    CpsLaw *law = NULL;
    assert_int_equal(cps_law_coulomb(1, radius, &law, NULL), CPS_OK);
    return law;
}

static CpsLaw *set_law(CpsSet *set) {
    CpsLaw *law = NULL;
    assert_int_equal(cps_law_friction(set, &law, NULL), CPS_OK);
    cps_set_release(set);
    return law;
}

static double dissipation(const CpsLaw *law, const double *velocity, double *force) {
    CpsSetAnswer answer;
    assert_int_equal(cps_set_dissipation(cps_law_set(law), velocity, force, &answer, NULL), CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    return answer.value;
}

/* ---- the braked wheel: r = f N = 500, strip half width s = b/a = 200, c = sqrt(r^2 - s^2) ---- */

enum { WHEEL_RADIUS = 500 };
static const double WHEEL_A = 0.3, STRIP = 200, CHORD = 458.257569495584;

/* axis i is component 1, rolling direction j component 2; brake torque h = -a G.j */
static CpsLaw *wheel(double brake, CpsComposition *composition) {
    const double map[3][2] = {{0, -WHEEL_A}, {1, 0}, {0, 1}};
    CpsSet *interval = NULL;
    assert_int_equal(cps_set_interval(-brake, brake, &interval, NULL), CPS_OK);
    CpsLaw *part[2] = {set_law(interval), disc_law(WHEEL_RADIUS)}, *both = NULL, *law = NULL;
    assert_int_equal(cps_law_product(2, (const CpsLaw *const *)part, &both, NULL), CPS_OK);
    assert_int_equal(cps_law_preimage(2, map[0], both, composition, &law, NULL), CPS_OK);
    for (int i = 0; i < 2; i++) cps_law_release(part[i]);
    cps_law_release(both);
    return law;
}

static void wheel_dissipation(void **state) {
    (void)state;
    /* phi = r|W| where the wheel stays locked, else s|Wj| + c|Wi| */
    static const double CASE[][3] = {{1, 0, 500},
                                     {1, 0.3, 522.0153254455275},
                                     {1, 1, 658.257569495584},
                                     {0.5, 2, 629.128784747792},
                                     {0, 1, 200},
                                     {-1, -1, 658.257569495584}};
    CpsComposition composition;
    CpsLaw *law = wheel(60, &composition);
    assert_int_equal(composition, CPS_COMPOSITION_INTERIOR);
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++)
        CHECK_RELATIVE(dissipation(law, CASE[i], NULL), CASE[i][2], EXACT);
    cps_law_release(law);
}

static void wheel_forces(void **state) {
    (void)state;
    CpsLaw *law = wheel(60, NULL);
    CpsSet *forces = NULL;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    double vertex[8], centre[2];
    int count = 0;

    /* rolling straight on: the whole edge, a segment of side forces */
    const double along[2] = {0, 1};
    assert_int_equal(cps_set_forces(cps_law_set(law), along, 0, &forces, &answer, NULL), CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    CHECK_RELATIVE(answer.value, 200, EXACT);
    assert_int_equal(cps_set_vertices(forces, 0, 4, vertex, &count, &answer, NULL), CPS_OK);
    CHECK_INT(count, 2);
    CHECK_RELATIVE(fmin(vertex[0], vertex[2]), -CHORD, EXACT);
    CHECK_RELATIVE(fmax(vertex[0], vertex[2]), CHORD, EXACT);
    CHECK_RELATIVE(vertex[1], -STRIP, EXACT);
    CHECK_RELATIVE(vertex[3], -STRIP, EXACT);
    cps_set_release(forces);

    /* braking and slipping sideways at once: the corner */
    const double both[2] = {1, 1};
    assert_int_equal(cps_set_forces(cps_law_set(law), both, 0, &forces, &answer, NULL), CPS_OK);
    assert_int_equal(cps_set_facts(forces, 0, &facts, centre, NULL, NULL), CPS_OK);
    CHECK_INT(facts.dimension, 0);
    CHECK_RELATIVE(centre[0], -CHORD, EXACT);
    CHECK_RELATIVE(centre[1], -STRIP, EXACT);
    cps_set_release(forces);
    cps_law_release(law);
}

static void wheel_corner_velocities(void **state) {
    (void)state;
    /* at a corner -V lies between the strip's normal and the radius: opening acos(s/r) */
    CpsLaw *law = wheel(60, NULL);
    CpsSet *velocities = NULL;
    CpsSetAnswer answer;
    const double corner[2] = {-sqrt(500.0 * 500 - 200.0 * 200), -200};
    double ray[8];
    int count = 0;
    assert_int_equal(cps_set_velocities(cps_law_set(law), corner, 0, &velocities, &answer, NULL),
                     CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_int_equal(cps_set_rays(velocities, 0, 4, ray, &count, &answer, NULL), CPS_OK);
    CHECK_INT(count, 2);
    const double sine = fabs(ray[0] * ray[3] - ray[1] * ray[2]),
                 cosine = ray[0] * ray[2] + ray[1] * ray[3];
    CHECK_RELATIVE(atan2(sine, cosine), acos(0.4), EXACT);
    /* one bounding velocity is along the axis j, the other along the radius */
    const int strip = fabs(ray[0]) < fabs(ray[2]) ? 0 : 2;
    CHECK_NEAR(ray[strip], 0, EXACT);
    CHECK_RELATIVE(ray[strip + 1], 1, EXACT);
    CHECK_RELATIVE(ray[2 - strip], CHORD / 500, EXACT);
    cps_set_release(velocities);

    /* inside: only at rest; outside: none */
    const double inside[2] = {100, 50}, outside[2] = {0, 201};
    CpsSetFacts facts;
    assert_int_equal(cps_set_velocities(cps_law_set(law), inside, 0, &velocities, &answer, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_facts(velocities, 0, &facts, NULL, NULL, NULL), CPS_OK);
    CHECK_INT(facts.dimension, 0);
    cps_set_release(velocities);
    assert_int_equal(cps_set_velocities(cps_law_set(law), outside, 0, &velocities, &answer, NULL),
                     CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
    assert_null(velocities);
    cps_law_release(law);
}

static void wheel_measure_and_limits(void **state) {
    (void)state;
    CpsSetMeasure measure;
    CpsComposition composition;
    CpsLaw *law = wheel(60, NULL);
    assert_int_equal(cps_set_measure(cps_law_set(law), &measure, NULL), CPS_OK);
    CHECK_RELATIVE(measure.area, 389061.45083197765, EXACT);
    CHECK_RELATIVE(measure.perimeter, 2656.0639701173122, EXACT);
    cps_law_release(law);

    /* no brake: a segment across, the wheel of a planimeter */
    const double turned[2] = {0.6, 0.8};
    law = wheel(0, &composition);
    assert_int_equal(composition, CPS_COMPOSITION_RELATIVE_INTERIOR);
    CHECK_RELATIVE(dissipation(law, turned, NULL), 300, EXACT);
    cps_law_release(law);

    /* brake stronger than the ground: plain Coulomb */
    law = wheel(200, &composition);
    assert_int_equal(composition, CPS_COMPOSITION_INTERIOR);
    CHECK_RELATIVE(dissipation(law, turned, NULL), 500, EXACT);
    cps_law_release(law);
}

/* ---- the other two cases of the composition rule ---- */

static void composition_on_a_boundary(void **state) {
    (void)state;
    CpsComposition composition;
    CpsSet *half = NULL, *ball = NULL;
    CpsLaw *law = NULL, *both = NULL, *part[2];

    /* G -> (0, G): meets [0, 5] at its end only, the disc inside; the interval is polyhedral */
    const double beside[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    assert_int_equal(cps_set_interval(0, 5, &half, NULL), CPS_OK);
    part[0] = set_law(half);
    part[1] = disc_law(3);
    assert_int_equal(cps_law_product(2, (const CpsLaw *const *)part, &both, NULL), CPS_OK);
    assert_int_equal(cps_law_preimage(2, beside[0], both, &composition, &law, NULL), CPS_OK);
    assert_int_equal(composition, CPS_COMPOSITION_POLYHEDRAL);
    for (int i = 0; i < 2; i++) cps_law_release(part[i]);
    cps_law_release(both);
    cps_law_release(law);

    /* G -> (0, G) touches a disc round (5, 0) at 0 alone: the reduced law {0} resists every W, the
     * disc none but along it */
    const double tangent[2] = {0, 1}, centre[2] = {5, 0};
    assert_int_equal(cps_set_ball(2, centre, 5, &ball, NULL), CPS_OK);
    part[0] = set_law(ball);
    assert_int_equal(cps_law_preimage(1, tangent, part[0], &composition, &law, NULL), CPS_OK);
    assert_int_equal(composition, CPS_COMPOSITION_NOT_SATISFIED);
    cps_law_release(part[0]);
    cps_law_release(law);
}

/* ---- dry and viscous: phi = k|V| + c|V|^2/2 ---- */

static void bingham(void **state) {
    (void)state;
    const double k = 3, c = 2, matrix[4] = {c, 0, 0, c}, velocity[2] = {0.6, -0.8}, speed = 1;
    CpsLaw *disc = disc_law(k);
    CpsResistance *part[2] = {NULL}, *law = NULL;
    assert_int_equal(cps_resistance_dry(disc, &part[0], NULL), CPS_OK);
    assert_int_equal(cps_resistance_viscous(2, matrix, &part[1], NULL), CPS_OK);
    assert_int_equal(cps_resistance_sum(2, (const CpsResistance *const *)part, &law, NULL), CPS_OK);

    /* potential and power, whole and term by term: the power is not phi */
    CpsResistanceValue whole, term[2];
    assert_int_equal(cps_resistance_value(law, velocity, &whole, term, NULL), CPS_OK);
    CHECK_RELATIVE(whole.potential, k * speed + c * speed * speed / 2, EXACT);
    CHECK_RELATIVE(whole.power, k * speed + c * speed * speed, EXACT);
    CHECK_RELATIVE(term[0].power, k, EXACT);
    CHECK_RELATIVE(term[1].power, 2 * term[1].potential, EXACT);

    /* V = -(F - P F)/c outside the disc, 0 within; conjugate dist(F, disc)^2/(2c) */
    const double force[2] = {-4, 3}, weak[2] = {1, 2};
    double found[2], gap, distance;
    CpsSetAnswer answer;
    assert_int_equal(cps_resistance_conjugate(law, force, found, &answer, NULL), CPS_OK);
    CHECK_RELATIVE(answer.value, 2 * 2 / (2 * c), EXACT);
    CHECK_RELATIVE(found[0], 0.8 * 2 / c, EXACT);
    CHECK_RELATIVE(found[1], -0.6 * 2 / c, EXACT);
    assert_int_equal(cps_resistance_residual(law, force, found, &gap, &distance, NULL), CPS_OK);
    CHECK_NEAR(gap, 0, EXACT * 10);     /* of a power of 10 W */
    CHECK_NEAR(distance, 0, EXACT * 5); /* of a force of 5 N */
    assert_int_equal(cps_resistance_conjugate(law, weak, found, &answer, NULL), CPS_OK);
    CHECK_NEAR(answer.value, 0, EXACT);
    CHECK_NEAR(hypot(found[0], found[1]), 0, EXACT);

    /* at rest every force of the disc */
    const double rest[2] = {0, 0};
    CpsSet *forces = NULL;
    CpsSetExtent extent;
    assert_int_equal(cps_resistance_forces(law, rest, 0, &forces, &answer, NULL), CPS_OK);
    assert_int_equal(cps_set_extent(forces, velocity, &extent, NULL), CPS_OK);
    CHECK_RELATIVE(extent.high, k, EXACT);
    CHECK_RELATIVE(extent.low, -k, EXACT);
    cps_set_release(forces);
    for (int i = 0; i < 2; i++) cps_resistance_release(part[i]);
    cps_resistance_release(law);
    cps_law_release(disc);
}

/* ---- sums of any terms: phi*(-F) is the least of shared costs ---- */

/* The gap at which the conjugate may end, and the root of it that is left of a velocity. */
static const double SHARED = 1e-11, SHARED_VELOCITY = 3e-6;

static CpsResistance *sum_of(int count, CpsResistance **part) {
    CpsResistance *sum = NULL;
    assert_int_equal(cps_resistance_sum(count, (const CpsResistance *const *)part, &sum, NULL),
                     CPS_OK);
    for (int i = 0; i < count; i++) cps_resistance_release(part[i]);
    return sum;
}

/* phi = k|V| + c |V|^p/p: |V| = (x/c)^(1/(p-1)) at x = |F| - k, phi* = x |V| (1 - 1/p) */
static void dry_and_power(void **state) {
    (void)state;
    static const double DEGREE[] = {1.1, 1.5, 2, 3.7, 6};
    const double k = 3, c = 2, force[2] = {-4.8, 3.6}, x = 6 - k;
    for (size_t i = 0; i < sizeof DEGREE / sizeof DEGREE[0]; i++) {
        const double p = DEGREE[i], speed = pow(x / c, 1 / (p - 1));
        CpsLaw *disc = disc_law(k), *unit = disc_law(1);
        CpsResistance *part[2] = {NULL};
        double found[2];
        CpsSetAnswer answer;
        assert_int_equal(cps_resistance_dry(disc, &part[0], NULL), CPS_OK);
        assert_int_equal(cps_resistance_power(unit, p, c, &part[1], NULL), CPS_OK);
        CpsResistance *law = sum_of(2, part);
        assert_int_equal(cps_resistance_conjugate(law, force, found, &answer, NULL), CPS_OK);
        assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        /* phi + phi* is up to k/x + 1 and p/(p - 1) times phi* */
        CHECK_RELATIVE(answer.value, x * speed * (1 - 1 / p), SHARED * 20);
        CHECK_RELATIVE(found[0], 0.8 * speed, SHARED_VELOCITY * 10);
        CHECK_RELATIVE(found[1], -0.6 * speed, SHARED_VELOCITY * 10);
        cps_resistance_release(law);
        cps_law_release(disc);
        cps_law_release(unit);
    }
}

/* Two powers of one component, phi = a v^2/2 + b v^3/3: a v + b v^2 = f. Then each axis on its own,
 * phi = sum of c_i |V_i|^p_i/p_i from sets that are segments: V_i = (F_i/c_i)^(1/(p_i-1)), phi* the
 * sum of the parts'. */
static void powers_side_by_side(void **state) {
    (void)state;
    const double a = 2, b = 5, f = 7, v = (sqrt(a * a + 4 * b * f) - a) / (2 * b);
    CpsSet *interval = NULL;
    CpsLaw *law = NULL;
    CpsResistance *part[3] = {NULL};
    CpsSetAnswer answer;
    double found[3];
    assert_int_equal(cps_set_interval(-1, 1, &interval, NULL), CPS_OK);
    assert_int_equal(cps_law_friction(interval, &law, NULL), CPS_OK);
    assert_int_equal(cps_resistance_power(law, 2, a, &part[0], NULL), CPS_OK);
    assert_int_equal(cps_resistance_power(law, 3, b, &part[1], NULL), CPS_OK);
    CpsResistance *sum = sum_of(2, part);
    assert_int_equal(cps_resistance_conjugate(sum, &f, found, &answer, NULL), CPS_OK);
    CHECK_RELATIVE(answer.value, f * v - a * v * v / 2 - b * v * v * v / 3, SHARED * 3);
    CHECK_RELATIVE(found[0], -v, SHARED_VELOCITY);
    cps_resistance_release(sum);
    cps_law_release(law);
    cps_set_release(interval);

    const double degree[3] = {1.5, 2.5, 4}, factor[3] = {3, 0.5, 20}, force[3] = {2, -1, 0.25};
    double expected = 0;
    for (int i = 0; i < 3; i++) {
        double end[3] = {0}, other[3] = {0};
        CpsSet *segment = NULL;
        end[i] = 1;
        other[i] = -1;
        assert_int_equal(cps_set_segment(3, other, end, &segment, NULL), CPS_OK);
        assert_int_equal(cps_law_friction(segment, &law, NULL), CPS_OK);
        assert_int_equal(cps_resistance_power(law, degree[i], factor[i], &part[i], NULL), CPS_OK);
        expected += fabs(force[i]) * pow(fabs(force[i]) / factor[i], 1 / (degree[i] - 1)) *
                    (1 - 1 / degree[i]);
        cps_law_release(law);
        cps_set_release(segment);
    }
    sum = sum_of(3, part);
    assert_int_equal(cps_resistance_conjugate(sum, force, found, &answer, NULL), CPS_OK);
    CHECK_RELATIVE(answer.value, expected, SHARED * 5);
    for (int i = 0; i < 3; i++)
        CHECK_RELATIVE(found[i],
                       -copysign(pow(fabs(force[i]) / factor[i], 1 / (degree[i] - 1)), force[i]),
                       SHARED_VELOCITY * 10);
    cps_resistance_release(sum);
}

/* ---- limit surfaces: contacts k at (x, y) with share w of the load, unit friction; twist (vx, vy,
 * omega) ---- */

typedef struct Place {
    double x, y, share;
} Place;

static CpsLaw *footprint(int count, const Place *place) {
    double(*map)[6] = calloc((size_t)count, sizeof *map);
    const double **maps = calloc((size_t)count, sizeof *maps);
    CpsLaw **disc = calloc((size_t)count, sizeof *disc), *law = NULL;
    for (int i = 0; i < count; i++) {
        const double rows[6] = {1, 0, -place[i].y, 0, 1, place[i].x};
        for (int k = 0; k < 6; k++) map[i][k] = rows[k];
        maps[i] = map[i];
        disc[i] = disc_law(place[i].share);
    }
    assert_int_equal(cps_law_contacts(3, count, (const CpsLaw *const *)disc, maps, &law, NULL),
                     CPS_OK);
    for (int i = 0; i < count; i++) cps_law_release(disc[i]);
    free(map);
    free(maps);
    free(disc);
    return law;
}

static double ring(int count, const double *twist) {
    Place *place = calloc((size_t)count, sizeof *place);
    for (int i = 0; i < count; i++) {
        const double t = 2 * PI * (i + 0.5) / count;
        place[i] = (Place){cos(t), sin(t), 1.0 / count};
    }
    CpsLaw *law = footprint(count, place);
    const double phi = dissipation(law, twist, NULL);
    cps_law_release(law);
    free(place);
    return phi;
}

static void ring_surface(void **state) {
    (void)state;
    /* the integrand is analytic round the ring unless the centre of rotation lies on it, at (0, 1):
     * then order 2, as long as it falls in the same place between contacts (half way, for multiples
     * of 4) */
    const double smooth[3] = {1, 0, 0.5}, on_ring[3] = {1, 0, 1};
    CHECK_RELATIVE(ring(64, smooth), 1.0635444099733649, EXACT);
    const double exact = 4 / PI, coarse = ring(52, on_ring) - exact,
                 fine = ring(104, on_ring) - exact;
    CHECK_BETWEEN(coarse / fine, 3.9,
                  4.1); /* 4 for order 2; the next term of the expansion is 1/count^2 smaller */
    CHECK_NEAR(fine, 0, 2e-4);
}

/* rings of contacts at the middles of `rings` bands of equal width, uniform pressure; phi, and
 * force and torque at (v, 0, 1) */
static double disc(int rings, double v, double *force) {
    const int round = 6 * rings;
    Place *place = calloc((size_t)rings * (size_t)round, sizeof *place);
    for (int i = 0; i < rings; i++)
        for (int k = 0; k < round; k++) {
            const double r = (i + 0.5) / rings, t = 2 * PI * (k + 0.5) / round;
            place[i * round + k] = (Place){r * cos(t), r * sin(t), 2 * r / rings / round};
        }
    CpsLaw *law = footprint(rings * round, place);
    const double twist[3] = {0, v, 1}, phi = dissipation(law, twist, force);
    cps_law_release(law);
    free(place);
    return phi;
}

static void disc_surface(void **state) {
    (void)state;
    /* Farkas et al. 2003: force and torque of a uniform disc at v/(R omega) */
    static const double CASE[][3] = {{0.25, 0.24803130976, 0.63578612361},
                                     {0.5, 0.48384375563, 0.54774835477},
                                     {1.5, 0.94081937550, 0.17379810553},
                                     {3, 0.98591116599, 0.08413023494}};
    for (size_t i = 0; i < sizeof CASE / sizeof CASE[0]; i++) {
        double coarse[3], fine[3];
        const double v = CASE[i][0], exact = v * CASE[i][1] + CASE[i][2];
        const double first = disc(10, v, coarse) - exact, second = disc(20, v, fine) - exact;
        /* bands of width h: order 2, with a factor for the point where the sliding velocity
         * vanishes (e < 1) */
        CHECK_LESS(fabs(second), fabs(first) / 3);
        CHECK_NEAR(second, 0, 1e-3);
        CHECK_NEAR(-fine[1], CASE[i][1], 2e-3);
        CHECK_NEAR(-fine[2], CASE[i][2], 2e-3);
    }
}

static double rod(int count, const double *twist) {
    Place *place = calloc((size_t)count, sizeof *place);
    for (int i = 0; i < count; i++) place[i] = (Place){-1 + 2 * (i + 0.5) / count, 0, 1.0 / count};
    CpsLaw *law = footprint(count, place);
    const double phi = dissipation(law, twist, NULL);
    cps_law_release(law);
    free(place);
    return phi;
}

static void rod_surface(void **state) {
    (void)state;
    const double twist[3] = {1, 0.5, 0.7}, turning[3] = {0, 0, 1}, exact = 1.17610140974653;
    const double coarse = rod(40, twist) - exact, fine = rod(80, twist) - exact;
    CHECK_BETWEEN(coarse / fine, 3.98, 4.02); /* midpoint rule on a smooth integrand: order 2 */
    CHECK_RELATIVE(rod(10, turning), 0.5, EXACT);
}

static void bipod(void **state) {
    (void)state;
    /* rotation about the support at (1, 0): it carries any force of its disc, the other one */
    const Place place[2] = {{1, 0, 0.5}, {-1, 0, 0.5}};
    const double twist[3] = {0, -1, 1}, along[3] = {1, 0, 0};
    CpsLaw *law = footprint(2, place);
    CpsSet *forces = NULL;
    CpsSetAnswer answer;
    CpsSetFacts facts;
    CpsSetExtent extent;
    assert_int_equal(cps_set_forces(cps_law_set(law), twist, 0, &forces, &answer, NULL), CPS_OK);
    CHECK_RELATIVE(answer.value, 1, EXACT);
    assert_int_equal(cps_set_facts(forces, 0, &facts, NULL, NULL, NULL), CPS_OK);
    CHECK_INT(facts.dimension, 2);
    assert_int_equal(cps_set_extent(forces, along, &extent, NULL), CPS_OK);
    CHECK_RELATIVE(extent.high - extent.low, 1, EXACT);
    cps_set_release(forces);
    cps_law_release(law);
}

/* ---- velocities at a force ---- */

/* The rays of -N at a force, in `ray` (4, 2); their number. */
static int velocity_rays(const CpsSet *set, const double *force, double *ray) {
    CpsSet *velocities = NULL;
    CpsSetAnswer answer;
    int count = 0;
    assert_int_equal(cps_set_velocities(set, force, 0, &velocities, &answer, NULL), CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    assert_int_equal(cps_set_rays(velocities, 0, 4, ray, &count, &answer, NULL), CPS_OK);
    assert_int_equal(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
    cps_set_release(velocities);
    return count;
}

/* Is one of `count` rays the unit vector along (x, y)?  Bounding rays are right to the square root
 * of rounding where a conic projection finds them. */
static bool has_ray(const double *ray, int count, double x, double y) {
    const double size = hypot(x, y);
    for (int i = 0; i < count; i++)
        if (hypot(ray[2 * i] - x / size, ray[2 * i + 1] - y / size) <= 1e-7) return true;
    return false;
}

/* At a corner of a polygon -N lies between the inward normals of its two edges. Corners of random
 * convex polygons on an ellipse, with further points inside that are no corners, as hull of points
 * and as image of another polygon. */
static void polygon_corners(void **state) {
    (void)state;
    enum { MOST = 9 };
    srand(7);
    for (int k = 0; k < 300; k++) {
        const int corners = 3 + rand() % 4, inside = rand() % 3, at = rand() % corners;
        double p[2 * MOST], twice[2 * MOST], ray[8], turn = rand() % 628 * 0.01, a = 1 + rand() % 9,
                                                     b = 1 + rand() % 9;
        for (int i = 0; i < corners; i++) {
            const double t = turn + (i + rand() % 50 * 0.01) * 2 * PI / corners;
            p[2 * i] = a * cos(t);
            p[2 * i + 1] = b * sin(t);
        }
        for (int i = corners; i < corners + inside; i++) /* between two corners, and drawn in */
            for (int c = 0; c < 2; c++)
                p[2 * i + c] = 0.3 * p[2 * (i - corners) + c] + 0.2 * p[2 * (corners - 1) + c];
        for (int i = 0; i < 2 * (corners + inside); i++) twice[i] = 2 * p[i];
        CpsSet *hull = NULL, *half = NULL, *image = NULL;
        assert_int_equal(cps_set_hull_of_points(2, corners + inside, p, &hull, NULL), CPS_OK);
        assert_int_equal(cps_set_hull_of_points(2, corners + inside, twice, &half, NULL), CPS_OK);
        assert_int_equal(cps_set_image(2, (const double[]){0.5, 0, 0, 0.5}, half, &image, NULL),
                         CPS_OK);
        const double *here = &p[2 * at], *next = &p[2 * ((at + 1) % corners)],
                     *last = &p[2 * ((at + corners - 1) % corners)];
        for (int form = 0; form < 2; form++) {
            const int count = velocity_rays(form ? image : hull, here, ray);
            assert_int_equal(count, 2);
            /* counterclockwise: inward normal of the edge (dx, dy) is (-dy, dx) */
            assert_true(has_ray(ray, count, here[1] - next[1], next[0] - here[0]));
            assert_true(has_ray(ray, count, last[1] - here[1], here[0] - last[0]));
        }
        cps_set_release(hull);
        cps_set_release(half);
        cps_set_release(image);
    }
}

/* A segment of forces lets its law slide freely across: along a line inside the segment, in a
 * half-plane at its end. A law without force moves anywhere. Laws in any position: every cone is
 * turned by the same angle. */
/* The velocities of a resistance law at F = -s (cos, sin): along -F between two speeds, low and
 * high. */
static void speeds_at(const CpsResistance *law, double s, double low, double high) {
    for (int k = 0; k < 12; k++) {
        const double n[2] = {cos(0.6 * k), sin(0.6 * k)}, across[2] = {-n[1], n[0]};
        CpsSet *velocities = NULL;
        CpsSetAnswer answer;
        CpsSetExtent extent;
        assert_int_equal(cps_resistance_velocities(law, (double[]){s * n[0], s * n[1]}, &velocities,
                                                   &answer, NULL),
                         CPS_OK);
        CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        assert_int_equal(cps_set_extent(velocities, (double[]){-n[0], -n[1]}, &extent, NULL),
                         CPS_OK);
        CHECK_NEAR(extent.low, low, 1e-7);
        if (isinf(high))
            assert_true(isinf(extent.high));
        else
            CHECK_NEAR(extent.high, high, 1e-7);
        assert_int_equal(cps_set_extent(velocities, across, &extent, NULL), CPS_OK);
        if (!isinf(high)) {
            CHECK_NEAR(extent.low, 0, 1e-7);
            CHECK_NEAR(extent.high, 0, 1e-7);
        }
        cps_set_release(velocities);
    }
}

/* Resistance laws are set-valued both ways: dry friction at its limit, flat pieces of a table and
 * what lies beyond its end, also in a sum, and the power of a segment, which leaves the velocity
 * across it free. */
static void velocities_of_resistances(void **state) {
    (void)state;
    CpsLaw *unit = disc_law(1), *three = disc_law(3);
    CpsResistance *dry = NULL, *table = NULL, *sum = NULL, *power = NULL;
    assert_int_equal(cps_resistance_dry(three, &dry, NULL), CPS_OK);
    assert_int_equal(cps_resistance_table(unit, 4, (double[]){0, 1, 3, 4}, (double[]){1, 2, 2, 5},
                                          &table, NULL),
                     CPS_OK);
    assert_int_equal(cps_resistance_sum(2, (const CpsResistance *const[]){dry, table}, &sum, NULL),
                     CPS_OK);
    speeds_at(dry, 3, 0, INFINITY);
    speeds_at(dry, 2, 0, 0);
    speeds_at(table, 1, 0, 0);
    speeds_at(table, 1.5, 0.5, 0.5);
    speeds_at(table, 2, 1, 3);
    speeds_at(table, 5, 4, INFINITY);
    speeds_at(sum, 4, 0, 0);
    speeds_at(sum, 4.5, 0.5, 0.5);
    speeds_at(sum, 5, 1, 3);
    speeds_at(sum, 8, 4, INFINITY);
    CpsSet *segment = NULL, *velocities = NULL;
    assert_int_equal(cps_set_segment(2, (double[]){-1, 0}, (double[]){1, 0}, &segment, NULL),
                     CPS_OK);
    CpsLaw *flat = set_law(segment);
    assert_int_equal(cps_resistance_power(flat, 3, 1, &power, NULL), CPS_OK);
    CpsSetAnswer answer;
    CpsSetExtent extent;
    assert_int_equal(cps_resistance_velocities(power, (double[]){4, 0}, &velocities, &answer, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_extent(velocities, (double[]){1, 0}, &extent, NULL), CPS_OK);
    CHECK_NEAR(extent.low, -2, 1e-8);
    CHECK_NEAR(extent.high, -2, 1e-8); /* h' = g^2 */
    assert_int_equal(cps_set_extent(velocities, (double[]){0, 1}, &extent, NULL), CPS_OK);
    assert_true(isinf(extent.low) && isinf(extent.high));
    cps_set_release(velocities);
    cps_resistance_release(dry);
    cps_resistance_release(table);
    cps_resistance_release(sum);
    cps_resistance_release(power);
    cps_law_release(unit);
    cps_law_release(three);
    cps_law_release(flat);
}

/* D = a a' with a = (1, 2): phi = <a, V>^2/2; a force along a has a line of velocities, any other
 * none. A matrix with a negative value is refused, one of zeros resists nothing. */
static void semidefinite_viscosity(void **state) {
    (void)state;
    CpsResistance *law = NULL, *none = NULL;
    CpsResistanceValue value;
    CpsSet *velocities = NULL;
    CpsSetAnswer answer;
    CpsSetExtent extent;
    assert_int_equal(cps_resistance_viscous(2, (double[]){1, 2, 2, 4}, &law, NULL), CPS_OK);
    assert_int_equal(cps_resistance_value(law, (double[]){3, -1}, &value, NULL, NULL), CPS_OK);
    CHECK_NEAR(value.potential, 0.5, EXACT);
    CHECK_NEAR(value.power, 1, EXACT);
    assert_int_equal(cps_resistance_value(law, (double[]){2, -1}, &value, NULL, NULL), CPS_OK);
    CHECK_NEAR(value.potential, 0, EXACT);
    assert_int_equal(cps_resistance_velocities(law, (double[]){-2, -4}, &velocities, &answer, NULL),
                     CPS_OK);
    assert_int_equal(cps_set_extent(velocities, (double[]){1, 2}, &extent, NULL), CPS_OK);
    CHECK_NEAR(extent.low, 2, 1e-8);
    CHECK_NEAR(extent.high, 2, 1e-8);
    assert_int_equal(cps_set_extent(velocities, (double[]){2, -1}, &extent, NULL), CPS_OK);
    assert_true(isinf(extent.low) && isinf(extent.high));
    cps_set_release(velocities);
    assert_int_equal(cps_resistance_velocities(law, (double[]){1, 0}, &velocities, &answer, NULL),
                     CPS_OK);
    CHECK_INT(answer.outcome, CPS_SET_OUTCOME_OUTSIDE);
    assert_int_equal(cps_resistance_viscous(2, (double[]){1, 2, 2, 3.9}, &none, NULL),
                     CPS_ERR_ARGUMENT);
    assert_int_equal(cps_resistance_viscous(2, (double[]){0, 0, 0, 0}, &none, NULL), CPS_OK);
    assert_int_equal(cps_resistance_value(none, (double[]){3, -1}, &value, NULL, NULL), CPS_OK);
    CHECK_NEAR(value.potential, 0, 0);
    cps_resistance_release(law);
    cps_resistance_release(none);
}

/* {|F| <= f N}: finite phi, which is 0, for N's velocity v >= f |V| only; on the boundary one ray
 * of velocities, at the tip those of the polar cone. */
static void friction_cone(void **state) {
    (void)state;
    const double f = 0.5;
    CpsSet *cone = NULL, *velocities = NULL;
    CpsSetAnswer answer;
    assert_int_equal(cps_set_friction_cone(3, f, &cone, NULL), CPS_OK);
    for (int k = 0; k < 24; k++) {
        const double a = 0.3 * k, v[3] = {cos(a), sin(a), f * (k % 2 ? 1.001 : 0.999)},
                     tip[3] = {0, 0, 0};
        assert_int_equal(cps_set_dissipation(cone, v, NULL, &answer, NULL), CPS_OK);
        CHECK_INT(answer.outcome, k % 2 ? CPS_SET_OUTCOME_ANSWERED : CPS_SET_OUTCOME_UNBOUNDED);
        const double force[3] = {2 * f * cos(a), 2 * f * sin(a), 2},
                     along[3] = {-cos(a), -sin(a), f};
        assert_int_equal(cps_set_velocities(cone, force, 0, &velocities, &answer, NULL), CPS_OK);
        CHECK_INT(answer.outcome, CPS_SET_OUTCOME_ANSWERED);
        double nearest[3];
        assert_int_equal(cps_set_project(velocities, along, NULL, nearest, &answer, NULL), CPS_OK);
        CHECK_NEAR(answer.value, 0, 1e-8);
        cps_set_release(velocities);
        assert_int_equal(cps_set_velocities(cone, tip, 0, &velocities, &answer, NULL), CPS_OK);
        assert_int_equal(cps_set_project(velocities, v, NULL, nearest, &answer, NULL), CPS_OK);
        if (k % 2)
            CHECK_NEAR(answer.value, 0, 1e-8);
        else
            CHECK_GREATER(answer.value, 1e-4);
        cps_set_release(velocities);
    }
    cps_set_release(cone);
}

static void cones_with_lines(void **state) {
    (void)state;
    for (int k = 0; k < 24; k++) {
        const double t = 0.3 + k * 2 * PI / 24, c = cos(t), s = sin(t), far = 500, zero[2] = {0, 0};
        const double ends[4] = {-far * c, -far * s, far * c, far * s};
        double ray[8];
        CpsSet *segment = NULL, *nothing = NULL;
        assert_int_equal(cps_set_hull_of_points(2, 2, ends, &segment, NULL), CPS_OK);
        int count = velocity_rays(segment, zero, ray);
        assert_int_equal(count, 2);
        assert_true(has_ray(ray, count, -s, c) && has_ray(ray, count, s, -c));
        count = velocity_rays(segment, &ends[2], ray);
        assert_int_equal(count, 3);
        assert_true(has_ray(ray, count, -s, c) && has_ray(ray, count, s, -c));
        for (int i = 0; i < count; i++) assert_true(ray[2 * i] * c + ray[2 * i + 1] * s <= 1e-7);
        assert_int_equal(cps_set_ball(2, zero, 0, &nothing, NULL), CPS_OK);
        count = velocity_rays(nothing, zero, ray);
        assert_int_equal(count, 4);
        for (int i = 0; i < count; i++)
            assert_true(has_ray(ray, count, -ray[2 * i], -ray[2 * i + 1]));
        cps_set_release(segment);
        cps_set_release(nothing);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wheel_dissipation),
        cmocka_unit_test(wheel_forces),
        cmocka_unit_test(wheel_corner_velocities),
        cmocka_unit_test(wheel_measure_and_limits),
        cmocka_unit_test(composition_on_a_boundary),
        cmocka_unit_test(bingham),
        cmocka_unit_test(dry_and_power),
        cmocka_unit_test(powers_side_by_side),
        cmocka_unit_test(ring_surface),
        cmocka_unit_test(disc_surface),
        cmocka_unit_test(rod_surface),
        cmocka_unit_test(bipod),
        cmocka_unit_test(polygon_corners),
        cmocka_unit_test(velocities_of_resistances),
        cmocka_unit_test(semidefinite_viscosity),
        cmocka_unit_test(friction_cone),
        cmocka_unit_test(cones_with_lines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
