/* SPDX-License-Identifier: BSD-3-Clause */
/* Random lines carried against posts and balls, thick and thin beside their elements; every element
 * is looked at.
 *
 *   random_posts [--share S] [--scene K]
 *
 * One to three cylinders and balls stand beside a line of 4 to 70 elements, h/R from 0.05 to 10;
 * both ends are carried past them, or one end is carried and the other pulled, and then one end
 * goes back. Of every certified step is asked, with code of its own:
 *   - no element is deeper in an obstacle than min(l^2/(4 R), R/4), no node deeper than 0, but for
 *       1e-10 of the length;
 *   - the angle by which the line winds about a cylinder changes by what the ways of its ends go
 *       round it and by nothing else (over a ball it may
 *     slip);
 *   - forces balance and obey the law: with consistent friction and coefficients by rig.h, and
 *       always by the checker, which reads the file of results.
 * Friction has one coefficient, two, or is a planar set of forces; bounds follow the reactions or
 * are those of the step before. No scene takes more than 10 s of processor time. With consistent
 * friction at least 99.5 % of the steps are certified, or proved to have no equilibrium. What is
 * not is printed; --scene K runs a scene alone. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "capstan/results.h"
#include "checker.h"
#include "given.h"
#include "posts_scene.h"

enum { SCENES = 200 };
/* Rounds end where nothing is deeper than 1e-10 of the length; beside it the rounding of a
 * distance. */
static const double DEEP = 1.01e-10;
/* [rad] Windings are whole turns apart where an axis was passed: rounding is far below this. */
static const double SAME = 1e-6;
/* Share of the steps that are certified or proved to have no equilibrium, at least. */
static const double CERTIFIED = 0.995;
/* [s] of processor time, of a scene */
static const double LATE = 10;

static const double PI = 3.14159265358979323846;

/* what is looked at ---------------------------------------------------------------------------- */

/* x as seen from an obstacle: across its axis in two coordinates, or from its centre in three. */
static void seen(const CpsObstacle *o, const double *x, double out[3]) {
    double from[3], axis[3], first[3] = {1, 0, 0}, second[3];
    for (int a = 0; a < 3; a++) from[a] = x[a] - o->point[a];
    memcpy(out, from, sizeof from);
    if (o->kind == CPS_OBSTACLE_SPHERE) return;
    const double size = hypot(hypot(o->axis[0], o->axis[1]), o->axis[2]);
    for (int a = 0; a < 3; a++) axis[a] = o->axis[a] / size;
    const double across = sqrt(1 - axis[0] * axis[0]); /* the axes are within 30 degrees of z */
    for (int a = 0; a < 3; a++) first[a] = (first[a] - axis[0] * axis[a]) / across;
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        second[a] = axis[b] * first[c] - axis[c] * first[b];
    }
    out[0] = out[1] = out[2] = 0;
    for (int a = 0; a < 3; a++) {
        out[0] += first[a] * from[a];
        out[1] += second[a] * from[a];
    }
}

/* The distance of the origin from the straight piece between a and b. */
static double apart(const double *a, const double *b) {
    double length = 0, passed = 0, d = 0;
    for (int i = 0; i < 3; i++) {
        length += (b[i] - a[i]) * (b[i] - a[i]);
        passed -= a[i] * (b[i] - a[i]);
    }
    const double share = length > 0 ? fmin(1, fmax(0, passed / length)) : 0;
    for (int i = 0; i < 3; i++) d += pow(a[i] + share * (b[i] - a[i]), 2);
    return sqrt(d);
}

/* How far elements and nodes are deeper than they may be, over the length of the line. */
static double depth(const PostsScene *s, const CpsLineView *view) {
    double worst = -INFINITY;
    for (int k = 0; k < s->rig.scene.obstacle_count; k++) {
        const CpsObstacle *o = &s->rig.obstacle[k];
        double a[3], b[3];
        seen(o, view->position, b);
        for (int e = 0; e < view->element_count; e++) {
            const double l = view->element_length[e],
                         allowed = fmin(l * l / (4 * o->radius), o->radius / 4);
            memcpy(a, b, sizeof a);
            seen(o, &view->position[3 * e + 3], b);
            worst = fmax(worst, fmax(o->radius - allowed - apart(a, b), o->radius - apart(b, b)));
        }
    }
    return worst / s->rig.line.length;
}

/* [rad] by which the straight path from a to b goes round, between -pi and pi */
static double angle(const double *a, const double *b) {
    return atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
}

static double winding(const CpsObstacle *o, const double *x, int elements) {
    double sum = 0, a[3], b[3];
    seen(o, x, b);
    for (int e = 0; e < elements; e++) {
        memcpy(a, b, sizeof a);
        seen(o, &x[3 * e + 3], b);
        sum += angle(a, b);
    }
    return sum;
}

/* Turns by which the line has come round an obstacle beyond what its ends went, from place `from`
 * to place `to`. A free end's path is straight as long as it is short. */
static double passed(const PostsScene *s, const double *from, const double *to) {
    const int elements = s->rig.line.element_count;
    double worst = 0;
    for (int k = 0; k < s->rig.scene.obstacle_count; k++) {
        const CpsObstacle *o = &s->rig.obstacle[k];
        if (o->kind == CPS_OBSTACLE_SPHERE) continue;
        double off = winding(o, to, elements) - winding(o, from, elements), a[3], b[3];
        for (int end = 0; end < 2; end++) {
            seen(o, &from[end ? 3 * elements : 0], a);
            seen(o, &to[end ? 3 * elements : 0], b);
            off += (end ? -1 : 1) * angle(a, b);
        }
        worst = fmax(worst, fabs(off));
    }
    return worst / (2 * PI);
}

/* the run -------------------------------------------------------------------------------------- */

typedef struct Tally {
    int scenes, steps, certified, proved, coarse, refused, late, wrong;
    long iterations;
    double slowest;
} Tally;

/* What a certified step promises of its forces; of a line without any there is nothing to ask. */
static bool right(const Audit *a, const CpsCertificate *c) {
    if (a->scale == 0) return c->gap == 0;
    return a->balance <= 1e-9 && a->open <= 1e-8 && a->bound <= 1e-8 && a->outside <= 1e-8 &&
           a->law <= c->gap + 1e-12 * a->scale && c->gap <= 1e-8 * c->scale;
}

static void check_step(const PostsScene *s, const char *name, const CpsEvolution *evolution,
                       const double *before, Tally *tally) {
    static const double still[RIG_OBSTACLES] = {0};
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    const char *step = cps_evolution_report(evolution).name;
    tally->steps++;
    if (!cps_outcome_is_certified(report.outcome)) {
        const bool final = cps_outcome_is_final(report.outcome),
                   coarse = report.outcome == CPS_OUTCOME_MESH_TOO_COARSE;
        tally->proved += final;
        tally->coarse += coarse;
        tally->refused += !final && !coarse;
        if (!final && !coarse) printf("%s, %s: %s\n", name, step, cps_outcome_name(report.outcome));
        return;
    }
    tally->certified++;
    const double deep = depth(s, &view), turns = passed(s, before, view.position);
    bool wrong = !(deep <= DEEP) || !(turns * 2 * PI <= SAME);
    if (wrong)
        printf(
            "%s, %s: WRONG: certified, %.3g of the length too deep, %.6f turns round an obstacle\n",
            name, step, fmax(0, deep), turns);
    if (s->rig.scene.friction_policy == CPS_FRICTION_POLICY_CONSISTENT && !s->sets) {
        const Audit audit = rig_audit(&s->rig.scene, still, &view);
        if (!right(&audit, &report.certificate)) {
            wrong = true;
            printf("%s, %s: WRONG: balance %.1e, open %.1e, bound %.1e, outside %.1e, law %.1e "
                   "beside a gap of %.1e\n",
                   name, step, audit.balance, audit.open, audit.bound, audit.outside, audit.law,
                   report.certificate.gap);
        }
    }
    tally->wrong += wrong;
}

/* The file of results by the checker. */
static void check_file(const PostsScene *s, const char *name, const char *directory, Tally *tally) {
    char path[512];
    CheckerReport report;
    snprintf(path, sizeof path, "%s/result.nc", directory);
    FILE *log = tmpfile();
    if (!log) abort();
    checker_file(path, &report, log);
    const int other = given_file(path, &s->rig.scene, log);
    if (report.refuted > 0 || other != 0) {
        tally->wrong++;
        printf("%s: WRONG: refuted by the checker\n", name);
        rewind(log);
        for (int c = fgetc(log); c != EOF; c = fgetc(log)) putchar(c);
    }
    fclose(log);
}

/* All steps of an evolution, or as many as there is time for; [s] of processor time that they
 * took. */
static double go(const PostsScene *s, const char *name, CpsEvolution *evolution,
                 CpsResults *results, Tally *tally) {
    const size_t size = 3 * (size_t)(s->rig.line.element_count + 1) * sizeof(double);
    double *before = malloc(size), spent = 0;
    CpsError err;
    if (!before) abort();
    while (cps_evolution_remaining_count(evolution) > 0 && spent <= LATE) {
        memcpy(before, cps_evolution_line_view(evolution, 0).position, size);
        const clock_t begun = clock();
        if (cps_evolution_step(evolution, &err))
            break; /* an end's path leads through an obstacle */
        spent += (double)(clock() - begun) / CLOCKS_PER_SEC;
        tally->iterations += cps_evolution_report(evolution).iteration_count;
        check_step(s, name, evolution, before, tally);
        if (cps_results_append(results, evolution, &err)) {
            print_error("%s: %s\n", name, err.message);
            abort();
        }
    }
    free(before);
    return spent;
}

static void run(int number, const char *directory, Tally tallies[2]) {
    static PostsScene s;
    CpsResultsOptions terse = cps_results_options_default();
    terse.no_paraview = terse.sync_at_end = true;
    CpsEvolution *evolution;
    CpsResults *results;
    CpsError err;
    char name[160];
    posts_scene_make(&s, number);
    Tally *tally = &tallies[s.rig.scene.friction_policy];
    snprintf(name, sizeof name, "scene %d, %d obstacles%s, %d elements, h/R %.2f, %s%s", number,
             s.rig.scene.obstacle_count, s.sets ? " with friction sets" : "",
             s.rig.line.element_count, s.thickest,
             s.rig.scene.friction_policy == CPS_FRICTION_POLICY_FROZEN ? "frozen" : "consistent",
             s.rig.line.end[1].kind == CPS_END_KIND_FREE ? ", pulled" : "");
    if (cps_evolution_create(&s.rig.scene, &evolution, &err) ||
        cps_results_open(directory, &s.rig.scene, evolution, &terse, &results, &err)) {
        printf("%s: %s\n", name, err.message);
        tally->wrong++;
        return;
    }
    const double spent = go(&s, name, evolution, results, tally);
    if (cps_results_finish(results, 0, &err)) {
        print_error("%s: %s\n", name, err.message);
        abort();
    }
    cps_results_destroy(results);
    cps_evolution_destroy(evolution);
    check_file(&s, name, directory, tally);
    posts_scene_release(&s);
    tally->scenes++;
    tally->slowest = fmax(tally->slowest, spent);
    if (spent <= LATE) return;
    tally->late++;
    printf("%s: beyond %g s\n", name, LATE);
}

/* Says what was found; is the share of the steps that are certified, or proved to have no
 * equilibrium, as large as asked for? */
static bool tell(const char *friction, const Tally *t) {
    printf("%s: %d scenes, %d steps: %d certified, %d proved to have no equilibrium, %d with a "
           "mesh too coarse, %d not certified, %d WRONG; %ld iterations, the slowest scene took "
           "%.1f s, %d more than %g s\n",
           friction, t->scenes, t->steps, t->certified, t->proved, t->coarse, t->refused, t->wrong,
           t->iterations, t->slowest, t->late, LATE);
    return t->certified + t->proved >= CERTIFIED * t->steps;
}

int main(int argc, char **argv) {
    double share = 1;
    int only = -1;
    for (int i = 1; i < argc; i += 2) {
        if (i + 1 < argc && !strcmp(argv[i], "--share")) {
            share = strtod(argv[i + 1], NULL);
        } else if (i + 1 < argc && !strcmp(argv[i], "--scene")) {
            only = (int)strtol(argv[i + 1], NULL, 10);
        } else {
            fprintf(stderr, "usage: random_posts [--share S] [--scene K]\n");
            return 2;
        }
    }
    Tally tally[2] = {{0}};
    const char *base = getenv("TMPDIR");
    char directory[256], command[300];
    snprintf(directory, sizeof directory, "%.200s/capstan-posts-XXXXXX", base ? base : "/tmp");
    if (!mkdtemp(directory)) {
        perror(directory);
        return 2;
    }
    snprintf(command, sizeof command, "rm -rf '%s'", directory);
    setvbuf(stdout, NULL, _IOLBF, 0); /* what a time limit ends has told so far */
    if (only < 0)
        for (int k = 0; k < SCENES * share; k++) run(k, directory, tally);
    if (only >= 0) run(only, directory, tally);
    if (system(command) != 0) printf("%s is left behind\n", directory);
    const bool enough = tell("consistent friction", &tally[CPS_FRICTION_POLICY_CONSISTENT]) &
                        tell("frozen friction", &tally[CPS_FRICTION_POLICY_FROZEN]);
    return tally[0].wrong + tally[1].wrong > 0 || tally[0].late + tally[1].late > 0 || !enough;
}
