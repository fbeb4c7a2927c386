/* SPDX-License-Identifier: BSD-3-Clause */
/* Points that float, in time: answers by hand, and the energy of every step. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cases.h"

/* A buoy of MASS that displaces water of DISPLACED under gravity G, on a weightless string from an
 * anchor, slack where a test does not say otherwise. Half of it is in the water. */
static const double G = 10, MASS = 500, DISPLACED = 1e4, EA = 3e5, DEPTH = 20;

typedef struct Float {
    CpsLine line;
    CpsPoint point[2];
    CpsStage stage[3];
    CpsPointChange change[3];
    CpsWave wave;
    CpsWaves waves;
    CpsCurrentRow row;
    CpsCurrent current;
    CpsScene scene;
    double start[9];
} Float;

enum { ANCHOR, BUOY };

/* A string of `length`, in two elements, that begins with its middle off to the side. */
static void make(Float *f, double length, double z, double height) {
    *f = (Float){.scene = cps_scene_default(), .line = cps_line_default()};
    for (int i = 0; i < 2; i++) f->point[i] = cps_point_default();
    f->point[ANCHOR].name = "anchor";
    f->point[ANCHOR].position[2] = -DEPTH;
    f->point[BUOY].name = "buoy";
    f->point[BUOY].kind = CPS_POINT_KIND_FREE;
    f->point[BUOY].position[2] = z;
    f->point[BUOY].weight = MASS * G - DISPLACED;
    f->point[BUOY].displaced_weight = DISPLACED;
    f->point[BUOY].height = height;
    f->point[BUOY].inertia = MASS;
    f->line.name = "string";
    f->line.length = length;
    f->line.element_count = 2;
    f->line.stiffness = EA;
    f->line.quasi_static = true;
    const double way = DEPTH + z, aside = 0.5 * sqrt(fmax(0, length * length - way * way));
    const double start[] = {0, 0, -DEPTH, aside, 0, z - 0.5 * way, 0, 0, z};
    memcpy(f->start, start, sizeof start);
    f->line.start = (CpsStart){.kind = CPS_START_POLYLINE, .point_count = 3, .point = f->start};
    for (int end = 0; end < 2; end++) {
        f->line.end[end].kind = CPS_END_KIND_POINT;
        f->line.end_point[end] = end == CPS_END_A ? ANCHOR : BUOY;
    }
    f->scene.line_count = 1;
    f->scene.line = &f->line;
    f->scene.point_count = 2;
    f->scene.point = f->point;
    f->scene.has_water_surface = true;
    f->scene.gravity[2] = -G;
    f->scene.stage = f->stage;
}

static CpsStage *add_stage(Float *f, double duration, int steps) {
    CpsStage *stage = &f->stage[f->scene.stage_count++];
    *stage = cps_stage_default();
    stage->name = "stage";
    stage->duration = duration;
    stage->step_count = steps;
    return stage;
}

static void move_anchor(Float *f, double x, double z) {
    const int k = f->scene.stage_count - 1;
    f->change[k] = (CpsPointChange){.point = ANCHOR, .value = {x, 0, z}};
    f->stage[k].point_change = &f->change[k];
    f->stage[k].point_change_count = 1;
}

static void add_waves(Float *f, double amplitude, double period, double phase) {
    f->wave = (CpsWave){.amplitude = amplitude, .period = period, .phase = phase};
    f->waves = (CpsWaves){.depth = INFINITY, .wave_count = 1, .wave = &f->wave};
    f->row = (CpsCurrentRow){0};
    f->current = (CpsCurrent){.density = 1000, .row_count = 1, .row = &f->row, .waves = &f->waves};
    f->scene.current = &f->current;
}

/* A run, and what was found at worst. */
typedef struct Voyage {
    CpsEvolution *evolution;
    const Float *of;
    CpsPointReport buoy;
    CpsPointMotion motion;
    double energy; /* [J] of motion, weight and buoyancy */
    double gained; /* [J] the most by which it grew in a step beyond the work of string and waves */
    double remainder; /* [J] sum of what ledgers do not close by */
    double turnover;  /* [J] of the buoy */
} Voyage;

static Voyage sail(const Float *f) {
    Voyage v = {.of = f, .energy = NAN};
    CpsError err;
    if (cps_evolution_create(&f->scene, &v.evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    return v;
}

/* The energy of the buoyancy at the height h, by its integral from 0 out of the water. */
static double afloat(const Float *f, double h) {
    const double H = f->point[BUOY].height;
    if (h >= H / 2) return 0;
    if (h <= -H / 2) return -DISPLACED * h;
    return DISPLACED * (H / 2 - h) * (H / 2 - h) / (2 * H);
}

/* [m] Above the surface that the step has, along its direction. */
static double height_of(const CpsPointReport *buoy) {
    return (buoy->position[2] - buoy->water_level) * buoy->water_direction[2];
}

/* The ledger of the buoy: the string, weight and buoyancy by its energy, and the surface as it
 * rises under where the buoy was. That of all, where the string has an inertia: otherwise it has
 * the work of mean forces. */
static void close_ledger(Voyage *v, const CpsPointReport *last, double lines) {
    const CpsMotionLedger *l = &v->motion.ledger;
    const CpsPointReport *now = &v->buoy;
    const double *n = now->water_direction, before = height_of(last);
    double along = 0, left = 0;
    for (int a = 0; a < 3; a++) {
        const double way = now->position[a] - last->position[a];
        along += n[a] * way;
        left += now->residual[a] * way;
    }
    const double stored = afloat(v->of, height_of(now)) - afloat(v->of, before),
                 weight = now->load[2] * (now->position[2] - last->position[2]),
                 waves = now->buoyancy * (along - (height_of(now) - before));
    v->remainder += fabs(lines + weight - stored + waves - l->kinetic - l->scheme - left);
    v->remainder += fabs(l->waves - waves);
    v->turnover += fabs(lines) + fabs(weight) + fabs(stored) + fabs(waves) + fabs(l->kinetic) +
                   fabs(l->scheme);
    const CpsStepReport report = cps_evolution_report(v->evolution);
    if (!v->of->line.quasi_static) v->remainder += fabs(report.ledger.imbalance);
}

/* Energies are those of a surface at rest. */
static void step(Voyage *v) {
    CpsError err;
    const double before = v->energy;
    const CpsPointReport last = v->buoy;
    if (cps_evolution_step(v->evolution, &err) != CPS_OK) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_report(v->evolution).outcome, CPS_OUTCOME_SOLVED);
    v->buoy = cps_evolution_point_report(v->evolution, BUOY);
    v->motion = cps_evolution_point_motion(v->evolution, BUOY);
    assert_true(v->buoy.has_place);
    const double z = v->buoy.position[2];
    v->energy = v->motion.kinetic + MASS * G * z + afloat(v->of, z);
    double lines = 0;
    for (int a = 0; a < 3; a++)
        lines += v->buoy.lines[a] * (v->buoy.position[a] - last.position[a]);
    if (!isfinite(before)) return; /* where it begins is not reported */
    if (v->motion.is_moving) close_ledger(v, &last, lines);
    v->gained = fmax(v->gained, v->energy - before - lines);
}

static void arrive(Voyage *v) {
    if (v->turnover > 0) CHECK_LESS(v->remainder, 1e-10 * v->turnover);
    cps_evolution_destroy(v->evolution);
}

/* [m] Where it is after all steps. */
static double end_of(const Float *f, int steps) {
    Voyage v = sail(f);
    for (int k = 0; k < steps; k++) step(&v);
    arrive(&v);
    return v.buoy.position[2];
}

/* Of a float with the height H the water is a spring of D/H: from a height above its floating
 * depth, at which all of it is in and out of the water by less than H/2, it swings by a cosine of
 * the rate sqrt(D/(H m)). */
static void heaves(void **unused) {
    (void)unused;
    const double height = 2, lift = 0.3, rate = sqrt(DISPLACED / (height * MASS)), time = 3;
    static const CpsTimeScheme SCHEME[] = {CPS_TIME_SCHEME_BDF2, CPS_TIME_SCHEME_EULER};
    for (int s = 0; s < 2; s++) {
        double error[2];
        for (int i = 0; i < 2; i++) {
            const int steps = 300 << i;
            Float f;
            make(&f, 30, lift, height);
            f.scene.time_scheme = SCHEME[s];
            add_stage(&f, time, steps);
            error[i] = fabs(end_of(&f, steps) - lift * cos(rate * time));
        }
        (void)show("float in heave", s == 0 ? "order of bdf2" : "order of euler", s == 0 ? 2 : 1,
                   order(error[0], error[1]));
        CHECK_NEAR(order(error[0], error[1]), s == 0 ? 2 : 1, 0.1);
        /* bdf2: a phase of w t (w h)^2/3, and its first step */
        CHECK_LESS(error[1], s == 0 ? 2e-4 : 3e-2);
    }
}

/* Without a height the buoyancy jumps at the surface: a buoy that is let go above it falls by a
 * parabola, is as much braked as it weighs, and so on: v against z is two arcs, and the time of one
 * oscillation 2 sqrt(2 z/G) + 2 sqrt(2 z'/G'), z' = z W/(D - W), G' = (D - W)/m. */
static void falls_in_and_leaps(void **unused) {
    (void)unused;
    const double lift = 0.8, weight = MASS * G, brake = (DISPLACED - weight) / MASS,
                 fall = sqrt(2 * lift / G), deep = lift * weight / (DISPLACED - weight),
                 period = 2 * fall + 2 * sqrt(2 * deep / brake);
    double error[2];
    for (int i = 0; i < 2; i++) {
        const int steps = 1000 << i;
        Float f;
        make(&f, 30, lift, 0);
        add_stage(&f, period, steps);
        Voyage v = sail(&f);
        double lowest = 0;
        bool above = false, below = false;
        error[i] = 0;
        for (int k = 0; k < steps; k++) {
            step(&v);
            const double t = (k + 1) * period / steps, z = v.buoy.position[2];
            if (t < fall - period / steps)
                error[i] = fmax(error[i], fabs(z - lift + 0.5 * G * t * t));
            lowest = fmin(lowest, z);
            above = above || v.buoy.water == CPS_POINT_WATER_ABOVE;
            below = below || v.buoy.water == CPS_POINT_WATER_SUBMERGED;
        }
        assert_true(above && below);
        CHECK_LESS(v.gained, 1e-9 * v.turnover);
        error[i] = fmax(error[i], fabs(lowest + deep));
        error[i] = fmax(error[i], fabs(v.buoy.position[2] - lift));
        arrive(&v);
    }
    (void)show("buoy falls in and leaps", "order", 1, order(error[0], error[1]));
    CHECK_LESS(error[1], 0.02);
    CHECK_BETWEEN(order(error[0], error[1]), 0.9, 2.1);
}

/* Dropped from high above, floats of any height lose energy in every step, and come to rest where
 * they float. By Euler's method so much is lost in each that they are at rest soon. */
static void energy_never_grows(void **unused) {
    (void)unused;
    static const double HEIGHT[] = {0, 0.05, 0.5, 3};
    for (int k = 0; k < 16; k++) {
        Float f;
        make(&f, 40, 0.3 + 0.4 * (k / 4), HEIGHT[k % 4]);
        f.scene.time_scheme = k < 8 ? CPS_TIME_SCHEME_BDF2 : CPS_TIME_SCHEME_EULER;
        const int steps = 400;
        add_stage(&f, k % 8 < 4 ? 40 : 8, steps);
        Voyage v = sail(&f);
        for (int i = 0; i < steps; i++) step(&v);
        CHECK_LESS(v.gained, 1e-10 * v.turnover);
        if (k >= 8 && k < 12) CHECK_NEAR(v.buoy.position[2], 0, 1e-2);
        arrive(&v);
    }
}

/* The anchor goes down, by which the string comes taut and pulls the buoy under, and comes up
 * again: the slower, the nearer to the same in quasi-static steps. */
static void slow_is_static(void **unused) {
    (void)unused;
    static const double HEIGHT[] = {0, 1.5};
    for (int h = 0; h < 2; h++) {
        const int steps = 200;
        double off[3] = {0, 0, 0}, still[200];
        for (int i = 0; i < 4; i++) { /* the first one is quasi-static */
            Float f;
            make(&f, 20.2, 0, HEIGHT[h]);
            const double time = i == 0 ? 0 : 100 << (2 * i);
            f.scene.in_time = true;
            add_stage(&f, time, steps / 2);
            move_anchor(&f, 0, -DEPTH - 1);
            add_stage(&f, time, steps / 2);
            move_anchor(&f, 0, -DEPTH);
            Voyage v = sail(&f);
            for (int k = 0; k < steps; k++) {
                step(&v);
                if (i == 0) still[k] = v.buoy.position[2];
                if (i > 0) off[i - 1] = fmax(off[i - 1], fabs(v.buoy.position[2] - still[k]));
            }
            if (i == 0) CHECK_LESS(still[steps / 2 - 1], -0.3);
            arrive(&v);
        }
        (void)show("slowly pulled under", "off the statics [m]", 0, off[2]);
        CHECK_LESS(off[2], 2e-4);
        CHECK_LESS(off[2], 0.3 * off[0]);
    }
}

/* In a deep long wave of small height the float is a driven oscillator: of the buoyancy n B, n =
 * e_z
 * + a/g, B = W - D z/H, the small part is D/H (eta - z) upwards, and W a/g. With a = -w^2 eta it
 * heaves by
 *
 *     z = eta (D/H - w^2 W/g)/(D/H - w^2 m)
 *
 * where m is its mass and that of the water that goes along; without the latter it moves as the
 * water does, in circles. */
static void follows_a_long_wave(void **unused) {
    (void)unused;
    const double height = 2, size = 1e-4, period = 6, w = 6.283185307179586 / period;
    static const double ADDED[] = {0, 1.5};
    for (int i = 0; i < 2; i++) {
        const double mass = MASS * (1 + ADDED[i]), stiff = DISPLACED / height,
                     gain = (stiff - w * w * MASS) / (stiff - w * w * mass),
                     drift = MASS / mass; /* m x'' = W a_x/g, and a_x = -(water's way) w^2 */
        const int steps = 2400;
        Float f;
        make(&f, 30, gain * size, height);
        f.point[BUOY].inertia = mass;
        f.point[BUOY].velocity[0] = drift * size * w; /* x = drift size sin(w t) */
        add_waves(&f, size, period, 0);
        add_stage(&f, 2 * period, steps);
        Voyage v = sail(&f);
        double off[2] = {0, 0};
        for (int k = 0; k < steps; k++) {
            step(&v);
            const double t = (k + 1) * 2 * period / steps;
            off[0] = fmax(off[0], fabs(v.buoy.position[2] - gain * size * cos(w * t)));
            off[1] = fmax(off[1], fabs(v.buoy.position[0] - drift * size * sin(w * t)));
        }
        (void)show("float in a long wave", "heave over that of the wave", gain,
                   gain + off[0] / size);
        CHECK_LESS(off[0], 1e-3 * size);
        CHECK_LESS(off[1], 2e-3 * size);
        arrive(&v);
    }
}

/* In a steep wave that grows a buoy without a height stays at the surface; of a step that is a
 * plane through the surface where the buoy would come to if nothing acted on it, off the surface
 * where it comes to by the second order in the step. */
static void stays_at_the_surface(void **unused) {
    (void)unused;
    double off[2], end[3][3];
    const double time = 8;
    for (int i = 0; i < 3; i++) {
        const int steps = 200 << i;
        Float f;
        make(&f, 30, 0, 0);
        add_waves(&f, 0.9, 5, 0);
        f.waves.ramp = 3;
        add_stage(&f, time, steps);
        Voyage v = sail(&f);
        double worst = 0;
        for (int k = 0; k < steps; k++) {
            step(&v);
            const CpsWaterMotion water =
                cps_waves_at(&f.scene, (k + 1) * time / steps, v.buoy.position);
            assert_int_equal(v.buoy.water, CPS_POINT_WATER_FLOATING);
            CHECK_NEAR(v.buoy.position[2], v.buoy.water_level, 1e-7);
            if (k > 2) worst = fmax(worst, fabs(v.buoy.position[2] - water.elevation));
        }
        memcpy(end[i], v.buoy.position, sizeof end[i]);
        if (i > 0) off[i - 1] = worst;
        arrive(&v);
    }
    (void)show("buoy in a steep wave", "distance from the surface [m]", 0, off[1]);
    (void)show("buoy in a steep wave", "order of the distance from the surface", 2,
               order(off[0], off[1]));
    CHECK_NEAR(order(off[0], off[1]), 2, 0.2);
    CHECK_LESS(off[1], 1e-5);
    const double coarse = hypot(end[1][0] - end[0][0], end[1][2] - end[0][2]),
                 fine = hypot(end[2][0] - end[1][0], end[2][2] - end[1][2]);
    (void)show("buoy in a steep wave", "order", 2, order(coarse, fine));
    CHECK_NEAR(order(coarse, fine), 2, 0.2);
}

/* The same buoy far below the surface, held by a string: what is left of the wave there is the
 * force of Froude and Krylov, D a/g on the buoy, smaller by exp(-k depth). */
static void deep_under_waves(void **unused) {
    (void)unused;
    const double size = 0.5, period = 4, w = 6.283185307179586 / period, k = w * w / G, depth = 8;
    Float f;
    make(&f, DEPTH - depth, -depth, 0);
    add_waves(&f, size, period, 0);
    add_stage(&f, 1, 100);
    Voyage v = sail(&f);
    for (int i = 0; i < 100; i++) {
        step(&v);
        /* the place that the step has asked for is on the way to where it is */
        const double t = (i + 1) * 0.01, *n = v.buoy.water_direction, a = size * w * w / G,
                     share = exp(k * v.buoy.position[2]);
        CHECK_NEAR(n[0], -a * share * sin(w * t), 2e-2 * a * share);
        CHECK_NEAR(n[1], 0, 0);
        CHECK_NEAR(n[2], 1 - a * share * cos(w * t), 2e-2 * a * share);
        CHECK_NEAR(v.buoy.buoyancy, DISPLACED, 0);
        assert_int_equal(v.buoy.water, CPS_POINT_WATER_SUBMERGED);
    }
    arrive(&v);
}

/* The anchor goes down fast, which snatches the string taut and the buoy under, and comes up, so
 * that it leaps; with and without a mass. */
static void snatched_under(void **unused) {
    (void)unused;
    for (int i = 0; i < 8; i++) {
        Float f;
        make(&f, 20.3, 0, i % 4 < 2 ? 0 : 0.8);
        if (i % 2) f.line.quasi_static = false;
        f.line.inertia = i % 2 ? 2 : 0;
        if (i >= 4) {
            f.point[BUOY].inertia = i % 2 ? 0 : 1e-3;
            add_waves(&f, 0.4, 5, 1);
        }
        add_stage(&f, 1, 100);
        move_anchor(&f, 0.5, -DEPTH - 4);
        add_stage(&f, 0.5, 100);
        move_anchor(&f, 0, -DEPTH);
        add_stage(&f, 3, 300);
        bool under = false, floats = false;
        Voyage v = sail(&f);
        for (int k = 0; k < 500; k++) {
            step(&v);
            under = under || v.buoy.water == CPS_POINT_WATER_SUBMERGED;
            floats = floats || v.buoy.water != CPS_POINT_WATER_SUBMERGED;
        }
        assert_true(under && floats);
        arrive(&v);
    }
}

/* With too little volume it sinks, braked by what it displaces, until the string holds it; one of
 * none falls through the surface as if there was none. */
static void sinks(void **unused) {
    (void)unused;
    for (int i = 0; i < 2; i++) {
        const double volume = i == 0 ? 0.25 : 0, time = 2;
        Float f;
        make(&f, 30, 0, 0);
        f.point[BUOY].displaced_weight = volume * DISPLACED;
        f.point[BUOY].weight = MASS * G - volume * DISPLACED;
        add_stage(&f, time, 200);
        Voyage v = sail(&f);
        for (int k = 0; k < 200; k++) step(&v);
        const double rate = G - volume * DISPLACED / MASS;
        CHECK_NEAR(v.buoy.position[2], -0.5 * rate * time * time, 0.02 * rate * time);
        CHECK_NEAR(v.motion.velocity[2], -rate * time, 1e-6 * rate * time);
        assert_int_equal(v.buoy.water, i == 0 ? CPS_POINT_WATER_SUBMERGED : CPS_POINT_WATER_NONE);
        cps_evolution_destroy(v.evolution);
    }
}

static void check_same(const Voyage *a, const Voyage *b) {
    CHECK_VECTOR(a->buoy.position, b->buoy.position, 0);
    CHECK_VECTOR(a->motion.velocity, b->motion.velocity, 0);
    CHECK_VECTOR(a->buoy.water_direction, b->buoy.water_direction, 0);
    CHECK_NEAR(a->motion.ledger.waves, b->motion.ledger.waves, 0);
    CHECK_NEAR(a->motion.ledger.scheme, b->motion.ledger.scheme, 0);
    CHECK_NEAR(a->buoy.buoyancy, b->buoy.buoyancy, 0);
}

static void leap(Float *f, double height) {
    make(f, 21, 0.7, height);
    add_waves(f, 0.6, 5, 1);
    add_stage(f, 3, 120);
}

/* Saved in the air, at the surface or below it, and loaded into another evolution, it goes on with
 * the same bits. */
static void goes_on_with_the_same_bits(void **unused) {
    (void)unused;
    for (int k = 0; k < 8; k++) {
        Float f;
        leap(&f, k % 2 ? 0.5 : 0);
        Voyage a = sail(&f), b = sail(&f);
        for (int i = 0; i < 5 + 13 * k; i++) step(&a);
        const size_t size = cps_evolution_state_size(a.evolution);
        void *saved = malloc(size);
        CpsError err;
        assert_non_null(saved);
        cps_evolution_save(a.evolution, saved);
        if (cps_evolution_load(b.evolution, saved, size, &err)) fail_msg("%s", err.message);
        free(saved);
        for (int i = 0; i < 20; i++) {
            step(&a);
            step(&b);
            check_same(&a, &b);
        }
        arrive(&a);
        cps_evolution_destroy(b.evolution);
    }
}

/* A move of 20 ms in which the buoy has a force, or is held in a place. */
static void take_move(Voyage *v, CpsPointKind kind, double z) {
    CpsError err;
    CpsPointChange change = {.point = BUOY, .kind = kind, .value = {0, 0, z}};
    CpsStage move = cps_stage_default();
    move.duration = 0.02;
    move.point_change = &change;
    move.point_change_count = 1;
    if (cps_evolution_move(v->evolution, &move, &err)) fail_msg("%s", err.message);
    assert_int_equal(cps_evolution_report(v->evolution).outcome, CPS_OUTCOME_SOLVED);
    v->buoy = cps_evolution_point_report(v->evolution, BUOY);
    v->motion = cps_evolution_point_motion(v->evolution, BUOY);
}

/* Moves of a program, of which some are tried and taken back in one of two runs, by which it is
 * pushed, or held. */
static void moves_are_taken_back(void **unused) {
    (void)unused;
    Float f;
    leap(&f, 0.5);
    f.scene.stage_count = 0;
    f.scene.in_time = true;
    Voyage a = sail(&f), b = sail(&f);
    for (int i = 0; i < 150; i++) {
        CpsError err;
        const double push = i % 40 < 10 ? -9e3 : 0;
        if (i % 5 == 4) {
            take_move(&b, i % 2 ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD, i % 2 ? -2e4 : -0.2);
            if (cps_evolution_take_back(b.evolution, &err)) fail_msg("%s", err.message);
        }
        take_move(&a, CPS_POINT_KIND_FREE, push);
        take_move(&b, CPS_POINT_KIND_FREE, push);
        check_same(&a, &b);
    }
    cps_evolution_destroy(a.evolution);
    cps_evolution_destroy(b.evolution);
}

/* Held in the air and let go by a move: it falls by a parabola, and the force that held it is gone.
 */
static void let_go_by_moves(void **unused) {
    (void)unused;
    Float f;
    make(&f, 30, 0.5, 0.4);
    f.point[BUOY].kind = CPS_POINT_KIND_HELD;
    f.scene.in_time = true;
    Voyage v = sail(&f);
    for (int i = 0; i < 15; i++) {
        take_move(&v, CPS_POINT_KIND_FREE, 0);
        const double t = 0.02 * (i + 1);
        if (v.buoy.position[2] > 0.2)
            CHECK_NEAR(v.buoy.position[2], 0.5 - 0.5 * G * t * t, 0.02 * G * t);
    }
    CHECK_LESS(v.buoy.position[2], 0.2);
    CHECK_GREATER(v.buoy.buoyancy, 0);
    cps_evolution_destroy(v.evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heaves),
        cmocka_unit_test(falls_in_and_leaps),
        cmocka_unit_test(energy_never_grows),
        cmocka_unit_test(slow_is_static),
        cmocka_unit_test(follows_a_long_wave),
        cmocka_unit_test(stays_at_the_surface),
        cmocka_unit_test(deep_under_waves),
        cmocka_unit_test(snatched_under),
        cmocka_unit_test(sinks),
        cmocka_unit_test(goes_on_with_the_same_bits),
        cmocka_unit_test(moves_are_taken_back),
        cmocka_unit_test(let_go_by_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
