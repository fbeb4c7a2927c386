/* SPDX-License-Identifier: BSD-3-Clause */
/* Airy waves by known answers: the dispersion, the motion of the water, lines that the water moves
 * beside the differential equation of their motion, and the whole of Froude and Krylov's force on a
 * taut line beside its integral. Each figure is printed. */
#include <stdio.h>
#include <string.h>

#include "splitmix.h"
#include "time_rig.h"

static const double PI = 3.14159265358979323846, G = 9.81;

/* ---- dispersion ---- */

/* w^2 = g k tanh(k d), with the period made of k, from shallow to deep water. */
static void the_dispersion_is_solved_to_rounding(void **state) {
    (void)state;
    double worst = 0;
    for (int i = 0; i <= 4000; i++) {
        const double depth = pow(10, -2 + 6.0 * (i % 61) / 60), kd = pow(10, -7 + 0.0025 * i);
        const long double k = (long double)kd / depth, w = sqrtl(G * k * tanhl(k * depth));
        const double period = (double)(2 * 3.14159265358979323846264L / w),
                     found = cps_wave_number(period, depth, G);
        worst = fmax(worst, fabs((double)(found / k - 1)));
    }
    /* k goes with the square of the period in deep water: a few roundings */
    CHECK_LESS(time_report("dispersion", "largest relative error", 0, worst), 4e-15);
    const double period = 7, w = 2 * PI / period, deep = w * w / G;
    CHECK_NEAR(time_report("dispersion", "infinite depth", deep,
                           cps_wave_number(period, INFINITY, G)),
               0, 1e-15 * deep);
    CHECK_NEAR(time_report("dispersion", "depth 1e300 m", deep, cps_wave_number(period, 1e300, G)),
               0, 1e-15 * deep);
    /* shallow: k = w/sqrt(g d) (1 + (k d)^2/6 + ..) */
    const double depth = 1e-4, k = w / sqrt(G * depth), kd = k * depth;
    CHECK_NEAR(time_report("dispersion", "shallow water", k * (1 + kd * kd / 6),
                           cps_wave_number(period, depth, G)),
               0, k * kd * kd * kd * kd);
    const double none[] = {cps_wave_number(0, 1, G), cps_wave_number(1, 0, G),
                           cps_wave_number(1, 1, 0), cps_wave_number(NAN, 1, G)};
    for (int i = 0; i < 4; i++) CHECK_INT(isnan(none[i]), 1);
}

/* k by bisection, in long double. */
static long double number_of(long double w, double depth) {
    long double low = w * w / G, high = low;
    while (isfinite(depth) && G * high * tanhl(high * depth) < w * w) high *= 2;
    for (int i = 0; i < 200; i++) {
        const long double middle = (low + high) / 2;
        if (G * middle * tanhl(middle * depth) < w * w)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* The surface of one wave up to 1000 km from 0, where the phase is up to 1.6e7 rad: in long double
 * that has an error of 1e-11. Numbers and directions known to a double leave 1e-9. */
static void the_phase_keeps_its_digits_far_away(void **state) {
    (void)state;
    uint64_t dice = 18;
    double worst = 0;
    for (int i = 0; i < 600; i++) {
        const double depth = i % 3 == 0   ? INFINITY
                             : i % 3 == 1 ? 200
                                          : pow(10, splitmix(&dice, -4, 2)),
                     far = pow(10, splitmix(&dice, 0, 6)), time = splitmix(&dice, 0, 10),
                     east = splitmix(&dice, -far, far), north = splitmix(&dice, -far, far),
                     x[3] = {east, north, 0};
        CpsWave wave = {.amplitude = 1, .period = pow(10, splitmix(&dice, -0.3, 1.3))};
        wave.direction = splitmix(&dice, -4, 10);
        wave.phase = splitmix(&dice, -40, 40);
        CpsWaves waves = {.depth = depth, .wave_count = 1, .wave = &wave};
        CpsCurrentRow row = {.z = 0};
        CpsCurrent current = {.density = 1025, .row_count = 1, .row = &row, .waves = &waves};
        CpsScene scene = cps_scene_default();
        scene.current = &current;
        scene.has_water_surface = true;
        scene.gravity[2] = -G;
        const long double w = 2 * 3.14159265358979323846264L / wave.period,
                          p = number_of(w, depth) *
                                  (cosl(wave.direction) * x[0] + sinl(wave.direction) * x[1]) -
                              w * time + wave.phase;
        const double off = cps_waves_at(&scene, time, x).elevation - (double)cosl(p);
        worst = fmax(worst, fabs(off));
    }
    CHECK_LESS(time_report("far away", "largest error of the surface, of a", 0, worst), 2e-11);
}

/* ---- the motion of the water ---- */

typedef struct Sea {
    CpsScene scene;
    CpsCurrent current;
    CpsCurrentRow row;
    CpsWaves waves;
    CpsWave wave[3];
} Sea;

static void make_sea(Sea *sea, double depth, double surface, double ramp) {
    *sea = (Sea){.scene = cps_scene_default()};
    sea->wave[0] = (CpsWave){.amplitude = 1.5, .period = 9, .direction = 0.4, .phase = 1};
    sea->wave[1] = (CpsWave){.amplitude = 0.3, .period = 4, .direction = -2, .phase = 0.2};
    sea->wave[2] = (CpsWave){.amplitude = 0.7, .period = 15, .direction = 1.7, .phase = -3};
    sea->waves = (CpsWaves){.depth = depth, .wave_count = 3, .wave = sea->wave, .ramp = ramp};
    sea->current =
        (CpsCurrent){.density = 1025, .row_count = 1, .row = &sea->row, .waves = &sea->waves};
    sea->scene.current = &sea->current;
    sea->scene.has_water_surface = true;
    sea->scene.water_surface = surface;
    sea->scene.gravity[2] = -G;
}

/* d(velocity)/d(place a), and with a = 3 by the time, by central differences of fourth order. */
static void slope_of(const Sea *sea, double time, const double *x, int a, double h, double *out) {
    static const double BY[4] = {1.0 / 12, -8.0 / 12, 8.0 / 12, -1.0 / 12}, AT[4] = {-2, -1, 1, 2};
    memset(out, 0, 3 * sizeof *out);
    for (int s = 0; s < 4; s++) {
        double at[3] = {x[0], x[1], x[2]}, t = time;
        if (a < 3)
            at[a] += AT[s] * h;
        else
            t += AT[s] * h;
        const CpsWaterMotion motion = cps_waves_at(&sea->scene, t, at);
        for (int i = 0; i < 3; i++) out[i] += BY[s] * motion.velocity[i] / h;
    }
}

static void water_is_neither_made_nor_turned(void **state) {
    (void)state;
    double made = 0, turned = 0, faster = 0, at_surface = 0, at_bottom = 0, above = 0;
    for (int i = 0; i < 300; i++) {
        const double depth = i % 3 == 0   ? INFINITY
                             : i % 3 == 1 ? 200
                                          : 12,
                     surface = 3 - i % 7, ramp = i % 2 ? 40 : 0, time = 0.37 * i,
                     low = isinf(depth) ? 100 : depth,
                     x[3] = {1.7 * i - 200, 90 - 0.9 * i,
                             surface - 0.1 - (low - 0.2) * (i % 50) / 50};
        Sea sea;
        double by[4][3];
        make_sea(&sea, depth, surface, ramp);
        for (int a = 0; a < 4; a++) slope_of(&sea, time, x, a, 0.01, by[a]);
        made = fmax(made, fabs(by[0][0] + by[1][1] + by[2][2]));
        turned = fmax(turned, fmax(fabs(by[1][2] - by[2][1]),
                                   fmax(fabs(by[2][0] - by[0][2]), fabs(by[0][1] - by[1][0]))));
        const CpsWaterMotion motion = cps_waves_at(&sea.scene, time, x);
        const bool growing = fabs(time - ramp) < 0.05;
        for (int a = 0; a < 3; a++)
            faster = growing ? faster : fmax(faster, fabs(by[3][a] - motion.acceleration[a]));
        if (ramp > 0) continue;
        const double top[3] = {x[0], x[1], surface}, over[3] = {x[0], x[1], surface + 9},
                     down[3] = {x[0], x[1], surface - depth};
        const CpsWaterMotion here = cps_waves_at(&sea.scene, time, top),
                             later = cps_waves_at(&sea.scene, time + 0.01, top),
                             before = cps_waves_at(&sea.scene, time - 0.01, top);
        at_surface =
            fmax(at_surface, fabs((later.elevation - before.elevation) / 0.02 - here.velocity[2]));
        const CpsWaterMotion higher = cps_waves_at(&sea.scene, time, over);
        for (int a = 0; a < 3; a++)
            above = fmax(above, fabs(higher.velocity[a] - here.velocity[a]) +
                                    fabs(higher.acceleration[a] - here.acceleration[a]));
        if (!isinf(depth)) {
            const CpsWaterMotion bed = cps_waves_at(&sea.scene, time, down);
            at_bottom = fmax(at_bottom, fabs(bed.velocity[2]) + fabs(bed.acceleration[2]));
        }
    }
    /* differences over 0.01 of numbers near 1; of the time with the error h^4/30 times the sum of
     * the amplitudes times w^6, 1.6e-9 */
    CHECK_LESS(time_report("water", "divergence [1/s]", 0, made), 1e-9);
    CHECK_LESS(time_report("water", "curl [1/s]", 0, turned), 1e-9);
    CHECK_LESS(time_report("water", "acceleration less that of velocity", 0, faster), 3e-9);
    /* second order in 0.01 s */
    CHECK_LESS(time_report("water", "rise of the surface less velocity", 0, at_surface), 1e-4);
    CHECK_LESS(time_report("water", "through the bottom", 0, at_bottom), 1e-13);
    CHECK_LESS(time_report("water", "change above the surface", 0, above), 1e-300);
    const CpsWaterMotion none = cps_waves_at(NULL, 1, (const double[3]){0, 0, 0});
    CHECK_NEAR(none.velocity[0], 0, 1e-300);
}

/* ---- lines in waves ---- */

/* Give the rig a regular wave. */
static void time_waves(TimeRig *rig, CpsWaves *waves, CpsWave *wave, double depth, double surface) {
    *waves = (CpsWaves){.depth = depth, .wave_count = 1, .wave = wave};
    rig->current.waves = waves;
    rig->scene.has_water_surface = true;
    rig->scene.water_surface = surface;
}

/* What moves: two places and their rates. */
typedef struct Phase {
    double q[2], v[2];
} Phase;

typedef void Acceleration(const void *of, double time, const Phase *at, double out[2]);

/* By the Runge-Kutta method of fourth order. */
static Phase integrate(Acceleration *rule, const void *of, Phase at, double time) {
    const int steps = 40000;
    const double h = time / steps;
    for (int i = 0; i < steps; i++) {
        double k[4][2], l[4][2];
        for (int s = 0; s < 4; s++) {
            const double by = s == 0 ? 0 : s < 3 ? h / 2 : h;
            Phase trial = at;
            for (int a = 0; a < 2; a++) {
                trial.q[a] += s > 0 ? by * k[s - 1][a] : 0;
                trial.v[a] += s > 0 ? by * l[s - 1][a] : 0;
            }
            memcpy(k[s], trial.v, sizeof k[s]);
            rule(of, i * h + by, &trial, l[s]);
        }
        for (int a = 0; a < 2; a++) {
            at.q[a] += h / 6 * (k[0][a] + 2 * k[1][a] + 2 * k[2][a] + k[3][a]);
            at.v[a] += h / 6 * (l[0][a] + 2 * l[1][a] + 2 * l[2][a] + l[3][a]);
        }
    }
    return at;
}

/* A wave along x, by its formula; x and z from the surface at rest. */
typedef struct Regular {
    double amplitude, w, k, depth, phase;
} Regular;

static Regular regular(const CpsWave *wave, double depth) {
    const double w = 2 * PI / wave->period;
    double k = w * w / G;
    for (int i = 0; i < 200; i++) k = 0.5 * (k + w * w / G / tanh(k * depth));
    return (Regular){wave->amplitude, w, k, depth, wave->phase};
}

static void water_of(const Regular *r, double time, double x, double z, double u[2], double a[2]) {
    const double p = r->k * x - r->w * time + r->phase, s = sinh(r->k * r->depth),
                 c = cosh(r->k * (z + r->depth)) / s, d = sinh(r->k * (z + r->depth)) / s,
                 speed = r->amplitude * r->w;
    u[0] = speed * c * cos(p);
    u[1] = speed * d * sin(p);
    a[0] = speed * r->w * c * sin(p);
    a[1] = -speed * r->w * d * cos(p);
}

/* A rope along the crests: all of it moves alike, across itself. */
typedef struct Rope {
    Regular wave;
    double mass, weight, density, drag, displaced, added, stream;
} Rope;

static void rope_rule(const void *of, double time, const Phase *at, double out[2]) {
    const Rope *r = of;
    double u[2], a[2], w[2];
    water_of(&r->wave, time, at->q[0], at->q[1], u, a);
    u[0] += r->stream;
    for (int i = 0; i < 2; i++) w[i] = u[i] - at->v[i];
    const double fast = hypot(w[0], w[1]);
    for (int i = 0; i < 2; i++)
        out[i] =
            ((i == 1 ? -r->weight : 0) + r->drag * fast * w[i] + (r->displaced + r->added) * a[i]) /
            (r->mass + r->added);
}

static const double ROPE_DEPTH = 30, ROPE_Z = -4;

static double rope_error(CpsTimeScheme scheme, int steps, Phase *exact) {
    enum { ELEMENTS = 4 };
    TimeRig rig;
    CpsWaves waves;
    CpsWave wave = {.amplitude = 0.9, .period = 6, .phase = 0.7};
    const CpsDrag drag = {.diameter = 0.2, .normal = 1.1, .tangential = 0.3, .added_normal = 0.9};
    const double density = 1025, stream[3] = {0.3, 0, 0}, mass = 40, weight = 30, time = 9;
    time_begin(&rig, 3, ELEMENTS, mass, 1e7);
    rig.line.weight = weight;
    rig.scene.gravity[2] = -G;
    rig.scene.time_scheme = scheme;
    rig.line.end[CPS_END_A] = (CpsEnd){.kind = CPS_END_KIND_FREE};
    time_water(&rig, density, stream, drag);
    /* far from the origin, and the surface not at 0 */
    time_waves(&rig, &waves, &wave, ROPE_DEPTH, 5);
    for (int j = 0; j <= ELEMENTS; j++) time_node(&rig, j, 0, 1e3 + 3.0 * j / ELEMENTS, 5 + ROPE_Z);
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double area = PI / 4 * 0.2 * 0.2;
    const Rope rope = {
        regular(&wave, ROPE_DEPTH), mass, weight, density, density / 2 * 0.2 * 1.1, density * area,
        density * area * 0.9,       0.3};
    *exact = integrate(rope_rule, &rope, (Phase){.q = {0, ROPE_Z}}, time);
    double off = 0;
    for (int j = 0; j <= ELEMENTS; j++)
        off = fmax(off, hypot(run.view.position[3 * j] - exact->q[0],
                              run.view.position[3 * j + 2] - 5 - exact->q[1]));
    printf("rope, %s, %4d steps: off by %.3e m; work of waves %.6g J, on drag %.6g J, on the water "
           "that goes along %.6g J\n",
           scheme ? "Euler" : "BDF2", steps, off, run.waves, run.drag, run.added);
    CHECK_GREATER(fabs(run.waves), 1);
    time_close(&run, "a rope along the crests");
    return off;
}

static void a_rope_along_the_crests_goes_as_its_equation_says(void **state) {
    (void)state;
    for (int scheme = 0; scheme < 2; scheme++) {
        double error[4];
        Phase exact;
        for (int k = 0; k < 4; k++)
            error[k] = rope_error((CpsTimeScheme)scheme, (scheme ? 200 : 100) << k, &exact);
        const double order = log2(error[2] / error[3]);
        time_report("a rope along the crests", scheme ? "order of Euler" : "order of BDF2",
                    scheme ? 1 : 2, order);
        CHECK_NEAR(order, scheme ? 1 : 2, 0.1);
        if (!scheme) CHECK_LESS(error[3], 1e-4);
    }
}

/* A pendulum of one element in a wave along its plane: half of the element is at its end, in the
 * water of its middle. */
typedef struct Swing {
    Regular wave;
    double length, height, mass, weight, pressed, displaced, added;
} Swing;

static void swing_rule(const void *of, double time, const Phase *at, double out[2]) {
    const Swing *s = of;
    const double angle = at->q[0], c = cos(angle), n = sin(angle);
    double u[2], a[2];
    water_of(&s->wave, time, s->length / 2 * n, s->height - s->length / 2 * c, u, a);
    const double across = u[0] * c + u[1] * n - s->length * at->v[0], push = a[0] * c + a[1] * n;
    out[0] =
        (-s->weight * n + s->pressed * fabs(across) * across + (s->displaced + s->added) * push) /
        ((s->mass + s->added) * s->length);
    out[1] = 0;
}

static double swing_error(int steps) {
    TimeRig rig;
    CpsWaves waves;
    CpsWave wave = {.amplitude = 1.2, .period = 7, .phase = 2};
    const CpsDrag drag = {.diameter = 0.15, .normal = 1.2, .added_normal = 1};
    const double density = 1025, none[3] = {0, 0, 0}, mass = 60, weight = 300, length = 5,
                 depth = 20, height = -3, time = 10;
    time_begin(&rig, length, 1, mass, INFINITY);
    rig.line.weight = weight;
    rig.scene.gravity[2] = -G;
    time_water(&rig, density, none, drag);
    time_waves(&rig, &waves, &wave, depth, 0);
    time_node(&rig, 0, 0, 0, height);
    time_node(&rig, 1, 0, 0, height - length);
    time_stage(&rig, time, steps);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const double half = length / 2, area = PI / 4 * 0.15 * 0.15;
    const Swing swing = {regular(&wave, depth),
                         length,
                         height,
                         half * mass,
                         half * weight,
                         half * density / 2 * 0.15 * 1.2,
                         half * density * area,
                         half * density * area};
    const Phase exact = integrate(swing_rule, &swing, (Phase){.q = {0, 0}}, time);
    const double found = atan2(run.view.position[3], height - run.view.position[5]);
    char name[48];
    snprintf(name, sizeof name, "pendulum, %d steps", steps);
    const double error = time_report(name, "angle after 10 s [rad]", exact.q[0], found);
    CHECK_GREATER(fabs(exact.q[0]), 0.05);
    time_close(&run, name);
    return error;
}

static void a_pendulum_in_waves_goes_as_its_equation_says(void **state) {
    (void)state;
    double error[4];
    for (int k = 0; k < 4; k++) error[k] = swing_error(200 << k);
    const double order = log2(error[2] / error[3]);
    time_report("pendulum in waves", "order of BDF2", 2, order);
    CHECK_NEAR(order, 2, 0.1);
}

/* ---- the whole force ---- */

/* The force of the waves on a taut upright line without drag and added mass, from the bottom to the
 * surface, beside rho A times the integral of the acceleration, a w^2/k sin(p). */
static double whole_error(int elements, double *expected) {
    TimeRig rig;
    CpsWaves waves;
    CpsWave wave = {.amplitude = 2, .period = 8, .phase = 0.4};
    const CpsDrag drag = {.diameter = 0.3};
    const double density = 1025, none[3] = {0, 0, 0}, depth = 60, area = PI / 4 * 0.09;
    time_begin(&rig, depth, elements, 2000, 1e12);
    rig.scene.gravity[2] = -G;
    time_water(&rig, density, none, drag);
    time_waves(&rig, &waves, &wave, depth, 0);
    for (int j = 0; j <= elements; j++) time_node(&rig, j, 0, 0, -depth + depth * j / elements);
    time_stage(&rig, 1e-3, 1);
    time_change(&rig, CPS_END_KIND_HELD, 0, 0, 0);
    TimeRun run = time_open(&rig);
    time_steps(&run, 0);
    const Regular r = regular(&wave, depth);
    double found = 0;
    for (int j = 0; j <= elements; j++) found += run.view.node_load[3 * j];
    *expected = density * area * r.amplitude * r.w * r.w / r.k * sin(-r.w * 1e-3 + r.phase);
    char name[48];
    snprintf(name, sizeof name, "taut line, %d elements", elements);
    const double error = time_report(name, "whole force [N]", *expected, found);
    time_close(&run, name);
    return error;
}

static void the_whole_force_on_a_taut_line_is_its_integral(void **state) {
    (void)state;
    double error[3], expected;
    for (int k = 0; k < 3; k++) error[k] = whole_error(40 << k, &expected);
    const double order = log2(error[1] / error[2]), limit = error[2] + (error[2] - error[1]) / 3;
    time_report("taut line", "order in the elements", 2, order);
    CHECK_NEAR(order, 2, 0.05);
    CHECK_NEAR(time_report("taut line", "extrapolated over expected", 0, limit / expected), 0,
               1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_dispersion_is_solved_to_rounding),
        cmocka_unit_test(the_phase_keeps_its_digits_far_away),
        cmocka_unit_test(water_is_neither_made_nor_turned),
        cmocka_unit_test(a_rope_along_the_crests_goes_as_its_equation_says),
        cmocka_unit_test(a_pendulum_in_waves_goes_as_its_equation_says),
        cmocka_unit_test(the_whole_force_on_a_taut_line_is_its_integral),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
