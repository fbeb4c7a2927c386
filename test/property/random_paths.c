/* SPDX-License-Identifier: BSD-3-Clause */
/* Where a step found by Newton's method is another one than that of the interior point, it is no
 * farther from the path.
 *
 *   random_paths [--scenes N] [--scene K]
 *
 * On coarse meshes the law may have several solutions, and the certificate cannot tell which of
 * them the line comes to. So each step of the scenes of posts_scene.h is taken from one state with
 * and without Newton's method; where the places differ by more than OTHER, the step is taken from
 * that state in PARTS parts as well, by both, and each of these is halved until its halves lead to
 * the same place (`path_tolerance` OTHER), without which no jump is found. Where these two paths
 * end at one place, the line comes there; where they do not, or one of them jumps, the path is not
 * known. A step that the program itself has cut into more parts by one method than by the other
 * says nothing of the methods, since smaller parts follow the path closer: it is taken again by
 * both in the fewest equal parts that neither cuts again, if there are such, and compared so; else
 * as it is. How far the step as the program took it is from a known path is printed as well, and
 * taken as one step with a path tolerance of NEAR it has to end that near to it. Fails where
 *   - the path is known, and the step that begins with Newton's method is farther from its end than
 *     the other one, by more than a factor of TWICE and OTHER,
 *   - it is not certified where the other one is, or leaves a gap that is larger, by more than a
 *     factor of TWICE and GAP.
 * All friction follows the reactions. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "posts_scene.h"

/* magic, size and fingerprint of a state (evolve/checkpoint.c) */
enum { HEAD = 24, PARTS = 64, STEPS = 60 };
/* per length of the line */
static const double OTHER = 1e-6, NEAR = 1e-3;
static const double TWICE = 2;
/* Per scale: ten times what a program is solved to (CPSI_TARGET), since rounds end with axes that
 * may still turn by 2e-9 rad. */
static const double GAP = 1e-12;
/* [s] of processor time of a scene: what is left of it is not looked at */
static const double LATE = 20;

enum { COLD, WARM, METHODS };

typedef struct Tally {
    int steps, warm, other, cut, alike, known, farther, wrong, late;
    double taken,
        followed; /* per length: farthest from the path, as taken, with a path tolerance */
} Tally;

/* The history with a stage for each step, between which there may be moves. */
typedef struct Single {
    int count;
    CpsStage stage[STEPS];
    CpsChange change[STEPS][2];
} Single;

static double between(double from, double to, int part, int parts) {
    return part == parts ? to : from + (double)part / parts * (to - from);
}

/* Part `part` of `parts` of the changes, from where the ends are. */
static CpsStage part_of(const CpsStage *stage, const CpsEnd at[2], int part, int parts,
                        CpsChange change[2]) {
    CpsStage out = *stage;
    out.step_count = 1;
    out.change = change;
    for (int k = 0; k < stage->change_count; k++) {
        change[k] = stage->change[k];
        for (int a = 0; a < 3; a++)
            change[k].to.value[a] = between(at[stage->change[k].end].value[a],
                                            stage->change[k].to.value[a], part, parts);
    }
    return out;
}

static void follow(const CpsStage *stage, CpsEnd at[2]) {
    for (int k = 0; k < stage->change_count; k++) at[stage->change[k].end] = stage->change[k].to;
}

static void make_single(const PostsScene *s, Single *single) {
    CpsEnd at[2] = {s->rig.line.end[0], s->rig.line.end[1]};
    single->count = 0;
    for (int k = 0; k < s->rig.scene.stage_count; k++) {
        const CpsStage *stage = &s->rig.stage[k];
        for (int i = 1; i <= stage->step_count && single->count < STEPS; i++) {
            const int n = single->count++;
            single->stage[n] = part_of(stage, at, i, stage->step_count, single->change[n]);
        }
        follow(stage, at);
    }
}

/* What one scene needs. */
typedef struct Run {
    CpsEvolution *evolution[METHODS];
    unsigned char *state, *own; /* before the step, of the cold run; its own head */
    size_t size;
    double *end[METHODS], *path[METHODS]; /* (n, 3) [m] */
    double *taken[METHODS];               /* likewise, as the program took the step */
    int n;
    double length;
    CpsEnd at[2];
} Run;

static CpsEvolution *create(const CpsScene *scene, bool cold) {
    CpsScene copy = *scene;
    CpsEvolution *evolution = NULL;
    CpsError err;
    copy.solver.cold = cold;
    if (cps_evolution_create(&copy, &evolution, &err) == CPS_OK) return evolution;
    fprintf(stderr, "%s\n", err.message);
    exit(1);
}

/* Put an evolution where the cold one was before the step. */
static void load(Run *run, CpsEvolution *evolution) {
    CpsError err;
    cps_evolution_save(evolution, run->own);
    memcpy(run->own + HEAD, run->state + HEAD, run->size - HEAD);
    if (cps_evolution_load(evolution, run->own, run->size, &err) == CPS_OK) return;
    fprintf(stderr, "%s\n", err.message);
    exit(1);
}

static void read_places(const CpsEvolution *evolution, int n, double *place) {
    memcpy(place, cps_evolution_line_view(evolution, 0).position, 3 * (size_t)n * sizeof *place);
}

/* The largest distance in a coordinate, per length. */
static double apart(const Run *run, const double *a, const double *b) {
    double most = 0;
    for (int i = 0; i < 3 * run->n; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most / run->length;
}

/* What is asked of a step that is taken in parts. */
typedef enum Asked { CERTIFIED, NO_JUMP, NOT_CUT } Asked;

/* The step in `parts` parts by one method: is each certified, and as asked? */
static bool take_parts(const CpsScene *scene, Run *run, const CpsStage *stage, int method,
                       int parts, Asked asked, double *place) {
    bool good = true;
    CpsEvolution *evolution = create(scene, method == COLD);
    load(run, evolution);
    for (int part = 1; part <= parts && good; part++) {
        CpsChange change[2];
        const CpsStage move = part_of(stage, run->at, part, parts, change);
        good = cps_evolution_move(evolution, &move, NULL) == CPS_OK;
        const CpsStepReport report = cps_evolution_report(evolution);
        good = good && cps_outcome_is_certified(report.outcome) &&
               (asked != NO_JUMP || report.jump_count == 0) &&
               (asked != NOT_CUT || report.substep_count == 1);
    }
    read_places(evolution, run->n, place);
    cps_evolution_destroy(evolution);
    return good;
}

/* The step in PARTS parts, by both methods; is the path known? */
static bool follow_path(const CpsScene *scene, Run *run, const CpsStage *stage) {
    CpsScene fine = *scene;
    fine.solver.path_tolerance = OTHER;
    for (int method = 0; method < METHODS; method++)
        if (!take_parts(&fine, run, stage, method, PARTS, NO_JUMP, run->path[method])) return false;
    return apart(run, run->path[COLD], run->path[WARM]) <= OTHER;
}

/* The step by both methods in the fewest equal parts that neither cuts, if there are such; how
 * many these are, or 0. */
static int cut_alike(const CpsScene *scene, Run *run, const CpsStage *stage) {
    for (int parts = 2; parts <= PARTS; parts *= 2) {
        bool good = true;
        for (int method = 0; method < METHODS && good; method++)
            good = take_parts(scene, run, stage, method, parts, NOT_CUT, run->path[method]);
        if (!good) continue;
        for (int method = 0; method < METHODS; method++)
            memcpy(run->end[method], run->path[method], 3 * (size_t)run->n * sizeof(double));
        return parts;
    }
    return 0;
}

/* The step as the program took it, and as it takes it with a path tolerance, beside the path. */
static void judge_taken(const CpsScene *scene, Run *run, const CpsStage *stage, Tally *tally) {
    double off[METHODS], near[METHODS];
    CpsScene fine = *scene;
    fine.solver.path_tolerance = NEAR;
    bool wrong = false;
    for (int method = 0; method < METHODS; method++) {
        off[method] = apart(run, run->taken[method], run->path[COLD]);
        const bool good = take_parts(&fine, run, stage, method, 1, CERTIFIED, run->taken[method]);
        near[method] = apart(run, run->taken[method], run->path[COLD]);
        wrong = wrong || !good || near[method] > NEAR;
        tally->taken = fmax(tally->taken, off[method]);
        tally->followed = fmax(tally->followed, near[method]);
    }
    tally->wrong += wrong;
    printf("as taken cold %.1e, warm %.1e from the path, with a path tolerance %.1e, %.1e%s\n",
           off[COLD], off[WARM], near[COLD], near[WARM], wrong ? "  WRONG" : "");
}

/* Are two different steps equally near to the path, where that is known? */
static void judge(const CpsScene *scene, Run *run, const CpsStage *stage, const char *name,
                  Tally *tally) {
    double off[METHODS];
    tally->other++;
    printf("%s: %.1e of the length apart; ", name, apart(run, run->end[COLD], run->end[WARM]));
    if (!follow_path(scene, run, stage)) {
        printf("the path is not known\n");
        return;
    }
    for (int method = 0; method < METHODS; method++)
        off[method] = apart(run, run->end[method], run->path[COLD]);
    const bool wrong = off[WARM] > TWICE * off[COLD] + OTHER;
    tally->known++;
    tally->farther += off[WARM] > off[COLD];
    tally->wrong += wrong;
    printf("from the path cold %.1e, warm %.1e%s; ", off[COLD], off[WARM], wrong ? "  WRONG" : "");
    judge_taken(scene, run, stage, tally);
}

/* The same of a step that one method has cut into more parts than the other, in equal parts if
 * there are such. */
static void judge_alike(const CpsScene *scene, Run *run, const CpsStage *stage, const char *name,
                        Tally *tally) {
    const int parts = cut_alike(scene, run, stage);
    tally->alike += parts > 0;
    if (parts > 0) printf("in %d equal parts ", parts);
    if (apart(run, run->end[COLD], run->end[WARM]) > OTHER) {
        judge(scene, run, stage, name, tally);
        return;
    }
    printf("%s: the same; ", name);
    if (follow_path(scene, run, stage))
        judge_taken(scene, run, stage, tally);
    else
        printf("the path is not known\n");
}

/* The next step by both methods from one state; false at the end. */
static bool take_step(const CpsScene *scene, Run *run, const CpsStage *stage, const char *name,
                      Tally *tally) {
    CpsStepReport report[METHODS];
    CpsEvolution *const *evolution = run->evolution;
    cps_evolution_save(evolution[COLD], run->state);
    load(run, evolution[WARM]);
    for (int method = 0; method < METHODS; method++) {
        if (cps_evolution_step(evolution[method], NULL) != CPS_OK) return false;
        report[method] = cps_evolution_report(evolution[method]);
        read_places(evolution[method], run->n, run->end[method]);
        read_places(evolution[method], run->n, run->taken[method]);
    }
    tally->steps++;
    tally->warm += report[WARM].warm_count == report[WARM].substep_count;
    if (!cps_outcome_is_certified(report[COLD].outcome)) return true;
    const CpsCertificate *cold = &report[COLD].certificate, *warm = &report[WARM].certificate;
    if (!cps_outcome_is_certified(report[WARM].outcome) ||
        warm->gap > TWICE * cold->gap + GAP * warm->scale) {
        printf("%s: cold gap %.1e, warm %s with %.1e  WRONG\n", name, cold->gap / cold->scale,
               cps_outcome_name(report[WARM].outcome), warm->gap / warm->scale);
        tally->wrong++;
    } else if (apart(run, run->end[COLD], run->end[WARM]) <= OTHER) {
        return true;
    } else if (report[COLD].substep_count != report[WARM].substep_count) {
        tally->cut++;
        printf("%s: %.1e of the length apart; in %d parts cold, %d warm\n", name,
               apart(run, run->end[COLD], run->end[WARM]), report[COLD].substep_count,
               report[WARM].substep_count);
        judge_alike(scene, run, stage, name, tally);
    } else {
        judge(scene, run, stage, name, tally);
    }
    return true;
}

static void allocate(Run *run, const PostsScene *s) {
    run->n = s->rig.line.element_count + 1;
    run->length = s->rig.line.length;
    run->size = cps_evolution_state_size(run->evolution[COLD]);
    run->state = malloc(2 * run->size);
    run->end[0] = malloc(3 * METHODS * 3 * (size_t)run->n * sizeof(double));
    if (!run->state || !run->end[0]) abort();
    run->own = run->state + run->size;
    run->end[1] = run->end[0] + 3 * run->n;
    run->path[0] = run->end[1] + 3 * run->n;
    run->path[1] = run->path[0] + 3 * run->n;
    run->taken[0] = run->path[1] + 3 * run->n;
    run->taken[1] = run->taken[0] + 3 * run->n;
    for (int end = 0; end < 2; end++) run->at[end] = s->rig.line.end[end];
}

static void look_at(int number, Tally *tally) {
    static PostsScene s;
    static Single single;
    Run run = {.n = 0};
    posts_scene_make(&s, number);
    make_single(&s, &single);
    CpsScene scene = s.rig.scene;
    scene.friction_policy = CPS_FRICTION_POLICY_CONSISTENT;
    scene.stage_count = single.count;
    scene.stage = single.stage;
    for (int method = 0; method < METHODS; method++)
        run.evolution[method] = create(&scene, method == COLD);
    allocate(&run, &s);
    const clock_t begun = clock();
    for (int k = 0; k < single.count; k++) {
        char name[80];
        snprintf(name, sizeof name, "scene %d, h/R %.2f, step %d", number, s.thickest, k);
        if (!take_step(&scene, &run, &single.stage[k], name, tally)) break;
        follow(&single.stage[k], run.at);
        if ((double)(clock() - begun) / CLOCKS_PER_SEC < LATE) continue;
        tally->late++;
        break;
    }
    free(run.state);
    free(run.end[0]);
    for (int method = 0; method < METHODS; method++) cps_evolution_destroy(run.evolution[method]);
    posts_scene_release(&s);
}

int main(int argc, char **argv) {
    Tally tally = {0};
    int count = 400, only = -1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--scenes")) count = atoi(argv[i + 1]);
        if (!strcmp(argv[i], "--scene")) only = atoi(argv[i + 1]);
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    for (int k = only < 0 ? 0 : only; k < (only < 0 ? count : only + 1); k++) look_at(k, &tally);
    printf("%d steps, %d warm; %d are cut otherwise and differ, of which %d are taken again in "
           "equal parts; in %d the two then differ; in %d of these the path is known, and "
           "the warm step farther from it in %d; as taken the steps whose path is known end up to "
           "%.1e beside it, with a path tolerance %.1e; %d scenes too long; %d WRONG\n",
           tally.steps, tally.warm, tally.cut, tally.alike, tally.other, tally.known, tally.farther,
           tally.taken, tally.followed, tally.late, tally.wrong);
    return tally.wrong > 0 || tally.steps == 0;
}
