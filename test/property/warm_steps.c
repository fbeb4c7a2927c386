/* SPDX-License-Identifier: BSD-3-Clause */
/* Warm steps against cold ones, on the histories of scene files:
 *
 *   warm_steps [--table] [--least N | --percent P] SCENE.yaml...
 *
 * Three evolutions take each step from the same state, that of the cold run before it: one by the
 * interior point alone, one warm, and one warm that was made and loaded for this step, as a run
 * that is resumed. Prints a row per scene: steps, steps that were warm, iterations, and the largest
 * differences between warm and cold. Which of the two is nearer to the solution shows where the law
 * leaves no doubt what is right: a node that slips lacks nothing of its bound, |F| = A, where there
 * is one coefficient.
 * --table prints it for docs/validation.md. Fails where
 *   - a step is certified cold but not warm,
 *   - places differ by more than PLACES, or forces in elements and on nodes by more than FORCES,
 *   - the two find other events in more than MOST_EVENTS of the steps in time,
 *   - the state of a node differs,
 *   - a warm step leaves a larger gap than GAP of its scale,
 *   - a node that slips lacks more of its bound in the warm step than in the cold one, beyond
 * rounding,
 *   - the resumed step has other bits, or a warm run accepts a state of the cold one as its own,
 *   - the first scene has fewer warm steps than --least says,
 *   - it takes more than --percent says of the iterations of the cold run.
 * Scenes with points are left out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "capstan/motion.h"

/* magic, size and fingerprint of a state (evolve/checkpoint.c) */
enum { HEAD = 24 };

/* per length of the line */
static const double PLACES = 1e-7;
/* share of the steps in time */
static const double MOST_EVENTS = 0.005;
/* Per largest force. What the two differ by is what the interior point leaves where Newton's method
 * does not end its programs: a node at rest moves
 * by some 1e-11 of the length, which a stiff element of a hundredth of it turns into 1e-9 EA. */
static const double FORCES = 2e-5;
/* What the interior-point loop aims at (CPSI_TARGET). */
static const double GAP = 1e-13;
/* Rounding of what a node lacks of its bound: forces balance to some eps of the largest, which may
 * be a thousand times a bound. */
static const double ROUNDING = 1e-10;
/* Less is not printed: it changes with the order of operations. */
static const double NOTHING = 1e-13;

typedef struct Tally {
    bool ended;     /* there is no equilibrium */
    bool isotropic; /* each obstacle has one coefficient of friction */
    int steps, warm, failed, other_bits, other_states, other_events;
    long iterations[2];
    double place, force, end, gap;
    double lack[2]; /* of friction at nodes that slip, cold and warm, per bound */
} Tally;

static void raise_to(double *most, double value) {
    if (!(value <= *most)) *most = value;
}

static double largest(const double *a, const double *b, int count) {
    double most = 0;
    for (int i = 0; i < count; i++) raise_to(&most, fabs(a[i] - b[i]));
    return most;
}

static bool same_bits(const double *a, const double *b, int count) {
    return memcmp(a, b, (size_t)count * sizeof *a) == 0;
}

/* Has every obstacle one coefficient of friction? */
static bool is_isotropic(const CpsScene *scene) {
    bool one = true;
    for (int k = 0; k < scene->obstacle_count; k++) {
        const CpsObstacle *o = &scene->obstacle[k];
        one = one && !o->friction_set &&
              (!o->has_friction_lateral || o->friction_lateral == o->friction);
    }
    return one;
}

/* What the friction of nodes that slip lacks of its bounds, per bound. */
static double lack_of(const CpsLineView *view) {
    double most = 0;
    for (int c = 0; c < view->contact_count * (view->element_count + 1); c++) {
        const double *f = &view->friction_force[3 * c];
        if (view->state[c] == CPS_NODE_STATE_SLIP)
            raise_to(&most, fabs(1 - hypot(hypot(f[0], f[1]), f[2]) / view->friction_bound[c]));
    }
    return most;
}

/* Do both find the same events in a step in time? Where rounding decides whether an element is
 * snatched taut, they solve two programs. */
static bool same_events(CpsEvolution *const run[3], int l, int n) {
    const CpsLineMotion cold = cps_evolution_line_motion(run[0], l),
                        warm = cps_evolution_line_motion(run[1], l);
    return !cold.is_moving || same_bits(cold.span, warm.span, n);
}

/* The largest difference of what the contacts of a node have on it together. In a corner at rest
 * the share of each of them is not determined. */
static double largest_on_node(const CpsLineView *cold, const CpsLineView *warm) {
    const int n = cold->element_count + 1;
    double most = 0;
    for (int i = 0; i < 3 * n; i++) {
        double off = 0;
        for (int c = i / 3; c < cold->contact_count * n; c += n) {
            const int at = 3 * c + i % 3;
            off += cold->reaction[c] * cold->normal[at] + cold->friction_force[at];
            off -= warm->reaction[c] * warm->normal[at] + warm->friction_force[at];
        }
        raise_to(&most, fabs(off));
    }
    return most;
}

/* Line l of the step that the evolutions cold, warm and resumed have taken. */
static void compare_line(CpsEvolution *const run[3], int l, Tally *tally) {
    const CpsLineView cold = cps_evolution_line_view(run[0], l),
                      warm = cps_evolution_line_view(run[1], l),
                      again = cps_evolution_line_view(run[2], l);
    const CpsLineReport before = cps_evolution_line_report(run[0], l),
                        now = cps_evolution_line_report(run[1], l);
    const int n = cold.element_count + 1;
    const double length = cold.arc_length[cold.element_count],
                 force =
                     before.certificate.largest_force > 0 ? before.certificate.largest_force : 1;
    if (!same_bits(warm.position, again.position, 3 * n) ||
        !same_bits(warm.segment_force, again.segment_force, 3 * (n - 1)) ||
        !same_bits(warm.reaction, again.reaction, warm.contact_count * n))
        tally->other_bits++;
    if (!same_events(run, l, n)) {
        tally->other_events++;
        return;
    }
    raise_to(&tally->place, largest(cold.position, warm.position, 3 * n) / length);
    raise_to(&tally->force, largest(cold.segment_force, warm.segment_force, 3 * (n - 1)) / force);
    raise_to(&tally->force, largest_on_node(&cold, &warm) / force);
    for (int end = 0; end < 2; end++)
        raise_to(&tally->end, largest(before.end[end].force, now.end[end].force, 3) / force);
    for (int c = 0; c < cold.contact_count * n; c++)
        tally->other_states += cold.state[c] != warm.state[c];
    if (now.warm_count < now.substep_count) return;
    raise_to(&tally->lack[0], lack_of(&cold));
    raise_to(&tally->lack[1], lack_of(&warm));
    if (now.certificate.scale > 0)
        raise_to(&tally->gap, now.certificate.gap / now.certificate.scale);
}

/* Take the next step with all three from the state of the first. False at the end. */
static bool compare_step(CpsEvolution *const run[3], unsigned char *state, unsigned char *own,
                         size_t size, Tally *tally) {
    CpsError err;
    if (cps_evolution_remaining_count(run[0]) == 0) return false;
    cps_evolution_save(run[0], state);
    tally->failed += cps_evolution_load(run[1], state, size, &err) == CPS_OK;
    for (int k = 1; k < 3; k++) {
        /* the head of a state names the settings it was made with: this run's are other ones */
        cps_evolution_save(run[k], own);
        memcpy(own + HEAD, state + HEAD, size - HEAD);
        if (cps_evolution_load(run[k], own, size, &err)) return false;
    }
    for (int k = 0; k < 3; k++)
        if (cps_evolution_step(run[k], &err)) return false;
    const CpsStepReport cold = cps_evolution_report(run[0]), warm = cps_evolution_report(run[1]);
    tally->steps++;
    tally->warm += warm.warm_count > 0 && warm.warm_count == warm.substep_count;
    tally->iterations[0] += cold.iteration_count;
    tally->iterations[1] += warm.iteration_count;
    tally->failed +=
        cps_outcome_is_certified(cold.outcome) && !cps_outcome_is_certified(warm.outcome);
    for (int l = 0; l < cps_evolution_line_count(run[0]); l++) compare_line(run, l, tally);
    tally->ended = cps_outcome_is_final(cold.outcome) && cps_outcome_is_final(warm.outcome);
    return !tally->ended;
}

static void print_row(const char *path, const Tally *tally, bool good, bool table) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    if (table && tally->steps > 4) {
        printf("| `%s` | %d, %d | %ld, %ld | %.1e | %.1e | %.1e | ", name, tally->steps,
               tally->warm, tally->iterations[0], tally->iterations[1], tally->place, tally->force,
               tally->end);
        if (tally->isotropic && tally->warm > 0)
            printf("%.1e, %s%.1e |\n", tally->lack[0], tally->lack[1] < NOTHING ? "below " : "",
                   fmax(tally->lack[1], NOTHING));
        else
            printf("|\n");
    }
    if (table) return;
    printf("%-42s | %3d steps, %3d warm | iterations %6ld cold %6ld warm | places %.1e, forces "
           "%.1e, ends %.1e, gap %.1e, states %d, lack %.1e cold %.1e warm%s\n",
           name, tally->steps, tally->warm, tally->iterations[0], tally->iterations[1],
           tally->place, tally->force, tally->end, tally->gap, tally->other_states, tally->lack[0],
           tally->lack[1], good ? "" : "  FAILED");
}

/* The whole history; false where something is wrong. */
static bool compare(const char *path, int least, int percent, bool table) {
    CpsError err;
    CpsSceneFile *file = NULL;
    CpsEvolution *run[3] = {NULL, NULL, NULL};
    Tally tally = {0};
    if (cps_scene_read(path, NULL, &file, &err)) {
        printf("%s: %s\n", path, err.message);
        return false;
    }
    CpsScene scene = *cps_scene_file_scene(file);
    bool good = true;
    /* The places of free points are found to the tolerance of a step, and so the lines of the two
     * runs end at other places. */
    if (scene.point_count > 0) {
        cps_scene_file_destroy(file);
        return true;
    }
    tally.isotropic = is_isotropic(&scene);
    for (int k = 0; k < 3; k++) {
        scene.solver.cold = k == 0;
        good = good && cps_evolution_create(&scene, &run[k], &err) == CPS_OK;
    }
    const size_t size = cps_evolution_state_size(run[0]);
    unsigned char *state = malloc(2 * size);
    bool more = good && state;
    while (more) more = compare_step(run, state, state + size, size, &tally);
    good = good && state && (tally.ended || cps_evolution_remaining_count(run[0]) == 0) &&
           tally.failed == 0 && tally.other_bits == 0 && tally.place <= PLACES &&
           tally.other_events <= MOST_EVENTS * tally.steps && tally.force <= FORCES &&
           tally.gap <= GAP && tally.other_states == 0 &&
           (!tally.isotropic || tally.lack[1] <= fmax(tally.lack[0], ROUNDING)) &&
           tally.warm >= least && 100 * tally.iterations[1] <= percent * tally.iterations[0];
    print_row(path, &tally, good, table);
    if (tally.failed || tally.other_bits)
        printf("    %d steps not certified warm, %d with other bits after loading\n", tally.failed,
               tally.other_bits);
    free(state);
    for (int k = 0; k < 3; k++) cps_evolution_destroy(run[k]);
    cps_scene_file_destroy(file);
    return good;
}

int main(int argc, char **argv) {
    /* a step that the loop has to solve after all may take twice as long */
    enum { ANY = 200 };
    int least = 0, percent = ANY, from = 1, failed = 0;
    const bool table = argc > 1 && strcmp(argv[1], "--table") == 0;
    if (table) {
        from = 2;
        printf("| history | steps, warm | iterations cold, warm | places | forces | at the ends "
               "| slipping nodes lack, cold, warm |\n|---|---|---|---|---|---|---|\n");
    } else if (argc > 2 && strcmp(argv[1], "--least") == 0) {
        least = atoi(argv[2]);
        from = 3;
    } else if (argc > 2 && strcmp(argv[1], "--percent") == 0) {
        percent = atoi(argv[2]);
        from = 3;
    }
    for (int i = from; i < argc; i++)
        failed += !compare(argv[i], i == from ? least : 0, i == from ? percent : ANY, table);
    return failed > 0 || from >= argc;
}
