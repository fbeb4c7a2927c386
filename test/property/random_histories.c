/* SPDX-License-Identifier: BSD-3-Clause */
/* Random histories of lines on a bed, a half-buried pipe and a boulder with consistent friction,
 * each step audited.
 *
 *   random_histories [--share S] [--class C] [--seed K] [--halvings H]
 *
 * Lines of 5 to 500 m, EA from 10 to 1e6 times their weight or none, are laid over the obstacles
 * and moved, pulled, let go and grabbed at one end while the pipe may turn. Friction of each
 * obstacle: one coefficient or two, ellipse or box, along the line or in a grain. At least 99.5 %
 * of all load steps must converge; what does not says so, and what claims to be solved must pass
 * the audit of test/analytic/rig.h. A step whose law is broken by more than 1e-8 of what it
 * dissipates, though within its certificate, is loose: none may be. The seed of a history is
 * printed with its complaint; --seed K runs that one alone, --class the histories of one class. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "rig.h"
#include "splitmix.h"

enum { HISTORIES = 500 };
static const double CONVERGED = 0.995;

/* random numbers */
static uint64_t state;

static double uniform(double low, double high) { return splitmix(&state, low, high); }

static double decades(double low, double high) { return pow(10, uniform(low, high)); }
static bool chance(double probability) { return uniform(0, 1) < probability; }

/* the scene ------------------------------------------------------------------------------------ */

static void add_friction(CpsObstacle *o) {
    o->friction = uniform(0.05, 1);
    if (chance(0.5)) rig_lateral(o, uniform(0.05, 1));
    if (chance(0.3)) o->friction_shape = CPS_FRICTION_SHAPE_BOX;
    if (chance(0.2)) {
        o->grain[0] = uniform(-1, 1);
        o->grain[1] = uniform(-1, 1);
    }
}

/* A pipe or a boulder, buried to its middle or a little less, between 0.35 and 0.65 of the way. */
static void curved(Rig *rig, CpsObstacleKind kind, double span) {
    CpsObstacle *o = rig_obstacle(rig, kind, 0);
    add_friction(o);
    o->radius = uniform(0.03, 0.15) * span;
    o->point[0] = uniform(0.35, 0.65) * span;
    o->point[2] = -uniform(0, 0.5) * o->radius;
    if (kind == CPS_OBSTACLE_SPHERE) o->point[1] = uniform(-0.3, 0.3) * o->radius;
    o->axis[0] = uniform(-0.3, 0.3);
    o->axis[1] = 1;
    o->axis[2] = 0;
}

/* Somewhere the end can be: within reach of end A at the origin, above the bed, clear of the
 * obstacles. */
static void somewhere(double reach, double to[3]) {
    const double far = uniform(0.75, 0.9) * reach, up = uniform(-0.2, 0.7),
                 aside = uniform(-0.6, 0.6);
    to[2] = up > 0 ? far * sin(up) : 0;
    const double flat = sqrt(far * far - to[2] * to[2]);
    to[0] = flat * cos(aside);
    to[1] = flat * sin(aside);
}

/* The next stage: a move, a force, or a turn of the pipe. */
static void stage(Rig *rig, double from[3], double length, double force, int pipe) {
    rig_stage(rig, 2 + (int)uniform(0, 5));
    const double what = uniform(0, 1);
    if (what < 0.6) {
        double to[3];
        somewhere(length, to);
        /* some of the way, so that a load step is a few per cent of the length */
        for (int a = 0; a < 3; a++) from[a] += uniform(0.2, 0.6) * (to[a] - from[a]);
        rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, from[0], from[1], from[2]);
    } else if (what < 0.8 || pipe < 0) {
        const double z = force * uniform(0, 0.5), y = force * uniform(-0.5, 0.5);
        rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, force * uniform(0, 1), y, z);
    } else {
        rig_turn(rig, pipe, uniform(-0.3, 0.3));
    }
}

/* A line around a drum of radius 1, up to a turn and a half, with leads; end A pulled, end B held.
 * The drum turns, the pull changes, end B moves. */
static void wound(Rig *rig) {
    const int n = 20 + (int)uniform(0, 60), lead = 3 + (int)uniform(0, 10);
    const double angle = uniform(0.5, 9), d = angle / n, pitch = uniform(0, 0.05),
                 chord = hypot(2 * sin(d / 2), pitch);
    const double pull = decades(-1, 4);
    const double stiffness = chance(0.3) ? INFINITY : pull * decades(2, 6);
    rig_begin(rig, n + 2 * lead, chance(0.5) ? 0 : pull * decades(-3, 0), stiffness);
    CpsObstacle *drum = rig_obstacle(rig, CPS_OBSTACLE_CYLINDER, 0);
    add_friction(drum);
    double x[3] = {0};
    for (int k = -lead; k <= n + lead; k++) {
        const int on = k < 0 ? 0 : k > n ? n : k;
        const double phi = on * d, beyond = (k - on) * 2 * sin(d / 2);
        rig_point(rig, sin(phi) + beyond * cos(phi), k * pitch, cos(phi) - beyond * sin(phi));
    }
    rig_length(rig, (n + 2 * lead) * chord);
    for (int a = 0; a < 3; a++) x[a] = rig->point[3 * (n + 2 * lead) + a];
    rig_end(rig, CPS_END_A, CPS_END_KIND_FREE, -pull, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_AT_START, 0, 0, 0);
    const int stages = 3 + (int)uniform(0, 4);
    for (int k = 0; k < stages; k++) {
        const double what = uniform(0, 1);
        rig_stage(rig, 2 + (int)uniform(0, 5));
        /* B stays clear of the drum */
        if (what < 0.2)
            for (int a = 0; a < 3; a++) x[a] += uniform(-0.1, 0.1);
        const double out = fmax(1, 1.001 / hypot(x[0], x[2]));
        x[0] *= out;
        x[2] *= out;
        if (what < 0.2) {
            rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, x[0], x[1], x[2]);
        } else if (what < 0.5) {
            const double up = pull * uniform(-0.2, 0.2), across = pull * uniform(-0.1, 0.1);
            rig_change(rig, CPS_END_A, CPS_END_KIND_FREE, -pull * uniform(0.3, 3), across, up);
        } else {
            rig_turn(rig, 0, uniform(-0.5, 0.5));
        }
    }
}

static void make(Rig *rig, uint64_t seed) {
    state = seed;
    if (chance(0.3)) {
        wound(rig);
        return;
    }
    const double length = decades(0.7, 2.7), weight = decades(-1, 3), heavy = length * weight;
    const bool inextensible = chance(0.2);
    const double stiffness = inextensible ? INFINITY : heavy * decades(1, 6);
    rig_begin(rig, 20 + (int)uniform(0, 80), weight, stiffness);
    rig_length(rig, length);
    rig->line.start.kind = CPS_START_STATIC;
    double at[3];
    somewhere(length, at);
    add_friction(rig_obstacle(rig, CPS_OBSTACLE_PLANE, 0));
    int pipe = -1;
    const double span = hypot(at[0], at[1]);
    if (chance(0.6)) {
        pipe = rig->scene.obstacle_count;
        curved(rig, CPS_OBSTACLE_CYLINDER, span);
    }
    if (chance(0.3)) curved(rig, CPS_OBSTACLE_SPHERE, span);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, 0, 0, 0);
    rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, at[0], at[1], at[2]);
    const int stages = 3 + (int)uniform(0, 3);
    for (int k = 0; k < stages; k++) stage(rig, at, length, heavy, pipe);
}

/* the run -------------------------------------------------------------------------------------- */

/* What a history rubs on. */
enum { ISOTROPIC, ANISOTROPIC, PIPE, BOULDER, DRUM, CLASSES };
static const char *const CLASS[CLASSES] = {"a bed, one coefficient", "a bed, two",
                                           "a bed and a pipe", "a boulder too", "a drum"};

static int class_of(const Rig *rig) {
    const CpsObstacle *bed = &rig->obstacle[0];
    if (bed->kind != CPS_OBSTACLE_PLANE) return DRUM;
    if (rig->scene.obstacle_count == 1)
        return !bed->has_friction_lateral && bed->friction_shape == CPS_FRICTION_SHAPE_ELLIPSE
                   ? ISOTROPIC
                   : ANISOTROPIC;
    for (int k = 1; k < rig->scene.obstacle_count; k++)
        if (rig->obstacle[k].kind == CPS_OBSTACLE_SPHERE) return BOULDER;
    return PIPE;
}

typedef struct Count {
    int steps, converged, refused, wrong, loose, parts, cut, ended;
    Audit worst;
} Count;

/* What a certified step promises: forces that balance, in their sets, bounds that follow, nothing
 * below the surface, and a law that is broken by no more than the certificate's gap. */
static bool right(const Audit *a, const CpsCertificate *c) {
    return a->balance <= 1e-9 && a->penetration <= 1e-6 && a->open <= 1e-8 && a->bound <= 1e-8 &&
           a->outside <= 1e-8 && a->law <= c->gap + 1e-12 * a->scale && c->gap <= 1e-8 * c->scale;
}

/* What is asked for: 1e-8 of the dissipation in sum and of w l at a node. */
static bool tight(const Audit *a, double length) {
    return a->node_law <= 1e-8 &&
           a->law <= 1e-8 * a->dissipated + 1e-12 * a->bounds * length + 1e-14 * a->scale;
}

static void keep_worst(Audit *worst, const Audit *a) {
    worst->balance = fmax(worst->balance, a->balance);
    worst->bound = fmax(worst->bound, a->bound);
    worst->outside = fmax(worst->outside, a->outside);
    worst->node_law = fmax(worst->node_law, a->node_law);
    worst->penetration = fmax(worst->penetration, a->penetration);
}

/* One step that has been taken: counted, audited. */
static void check_step(Count *count, const Rig *rig, const CpsEvolution *evolution,
                       const double *turn, uint64_t seed, bool first) {
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const CpsStepReport step = cps_evolution_report(evolution);
    count->steps++;
    count->parts += report.substep_count;
    count->cut += report.substep_count > 1;
    if (!cps_outcome_is_certified(report.outcome)) {
        count->refused++;
        printf("seed %llu, step %d: %s\n", (unsigned long long)seed, step.step_count - 1,
               cps_outcome_name(report.outcome));
        return;
    }
    count->converged++;
    if (first) return; /* laid without friction */
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    double last[RIG_OBSTACLES];
    for (int k = 0; k < RIG_OBSTACLES; k++) last[k] = report.share * turn[k];
    const Audit audit = rig_audit(&rig->scene, last, &view);
    keep_worst(&count->worst, &audit);
    if (!tight(&audit, rig->line.length)) count->loose++;
    if (right(&audit, &report.certificate)) return;
    count->wrong++;
    printf("seed %llu, step %d: WRONG: balance %.1e, depth %.1e, open %.1e, bound %.1e, outside "
           "%.1e, law %.1e of %.1e J, a node %.1e\n",
           (unsigned long long)seed, step.step_count - 1, audit.balance, audit.penetration,
           audit.open, audit.bound, audit.outside, audit.law, audit.dissipated, audit.node_law);
}

/* A history that a step refuses to go on with. An end that is free may be where an obstacle is in
 * the way of what grabs it; nothing else may be refused. */
static void end_early(Count *count, uint64_t seed, CpsStatus status, const CpsError *err) {
    const bool grabbed = status == CPS_ERR_ARGUMENT && strstr(err->message, "is grabbed at");
    printf("seed %llu: %s: %s\n", (unsigned long long)seed, grabbed ? "ends early" : "WRONG",
           err->message);
    if (grabbed)
        count->ended++;
    else
        count->wrong++;
}

static void run_one(Count *counts, uint64_t seed, int halvings, int class) {
    static Rig rig;
    make(&rig, seed);
    if (class >= 0 && class_of(&rig) != class) return;
    Count *count = &counts[class_of(&rig)];
    if (halvings >= 0) rig.scene.solver.max_halvings = halvings;
    CpsError err = {0};
    CpsEvolution *evolution;
    if (cps_evolution_create(&rig.scene, &evolution, &err) != CPS_OK) {
        printf("seed %llu: %s\n", (unsigned long long)seed, err.message);
        count->wrong++;
        return;
    }
    for (int s = rig.line.start.kind == CPS_START_STATIC ? -1 : 0; s < rig.scene.stage_count; s++) {
        double turn[RIG_OBSTACLES] = {0};
        const CpsStage *now = s < 0 ? NULL : &rig.stage[s];
        if (now && now->turn_count) turn[now->turn->obstacle] = now->turn->angle / now->step_count;
        for (int i = 0;
             i < (now ? now->step_count : 1) && cps_evolution_remaining_count(evolution) > 0; i++) {
            const CpsStatus status = cps_evolution_step(evolution, &err);
            if (status != CPS_OK) {
                end_early(count, seed, status, &err);
                cps_evolution_destroy(evolution);
                return;
            }
            check_step(count, &rig, evolution, turn, seed, s < 0);
        }
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    double share = 1;
    long seed = 0;
    int halvings = -1, class = -1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--share") == 0) {
            share = strtod(argv[i + 1], NULL);
        } else if (strcmp(argv[i], "--seed") == 0) {
            seed = strtol(argv[i + 1], NULL, 10);
        } else if (strcmp(argv[i], "--halvings") == 0) {
            halvings = (int)strtol(argv[i + 1], NULL, 10);
        } else if (strcmp(argv[i], "--class") == 0) {
            class = (int)strtol(argv[i + 1], NULL, 10);
        } else {
            fprintf(stderr,
                    "usage: random_histories [--share S] [--class C] [--seed K] [--halvings H]\n");
            return 2;
        }
    }
    Count count[CLASSES + 1] = {0}, *all = &count[CLASSES];
    const int histories = (int)(HISTORIES * share);
    if (seed > 0) run_one(count, (uint64_t)seed, halvings, class);
    if (seed == 0)
        for (int k = 1; k <= histories; k++) run_one(count, (uint64_t)k, halvings, class);
    for (int c = 0; c <= CLASSES; c++) {
        const Count *one = &count[c];
        if (c < CLASSES && one->steps == 0) continue;
        printf("%-24s %6d load steps, %6d converged (%.2f %%), %d refused, %d wrong, %d loose; %d "
               "cut, %.2f parts each\n",
               c < CLASSES ? CLASS[c] : "all", one->steps, one->converged,
               100.0 * one->converged / one->steps, one->refused, one->wrong, one->loose, one->cut,
               (double)one->parts / one->steps);
        if (c == CLASSES) break;
        all->steps += one->steps;
        all->converged += one->converged;
        all->refused += one->refused;
        all->wrong += one->wrong;
        all->parts += one->parts;
        all->loose += one->loose;
        all->cut += one->cut;
        all->ended += one->ended;
        keep_worst(&all->worst, &one->worst);
    }
    printf("worst: balance %.1e, bound %.1e, outside %.1e, node's law %.1e, depth %.1e\n",
           all->worst.balance, all->worst.bound, all->worst.outside, all->worst.node_law,
           all->worst.penetration);
    printf("%d histories end where what grabs a free end would go through an obstacle\n",
           all->ended);
    /* of the histories hardly any may end early, or little is tested */
    return all->wrong > 0 || all->loose > 0 || 100 * all->ended > histories ||
           all->converged < CONVERGED * all->steps;
}
