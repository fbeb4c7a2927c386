/* SPDX-License-Identifier: BSD-3-Clause */
/* Steps that are too long for what they impose (see coarse_steps.h). */
#include "coarse_steps.h"

#include <math.h>
#include <stdio.h>

#include "printable.h"

/* Fewer steps for a period do not show it. */
static const double STEPS = 4;
/* [rad] What turns by more in a step is taken to turn the other way. */
static const double HALF_TURN = 3.14159265358979323846;

typedef struct Coarse {
    const CpsStage *stage; /* the worst; NULL: none */
    double step, value;    /* [s] its step, and [s] the period or [rad] the turn in a step */
    const char *body;
    int count, of; /* waves that are shorter, of all */
} Coarse;

static void note(Coarse *worst, const CpsStage *stage, double step, double value, bool worse) {
    if (worst->stage && !worse) return;
    worst->stage = stage;
    worst->step = step;
    worst->value = value;
}

/* Periods are worse the shorter they are beside a step. */
static void note_period(Coarse *worst, const CpsStage *stage, double step, double period) {
    if (period < STEPS * step)
        note(worst, stage, step, period, period / step < worst->value / worst->step);
}

static void note_waves(const CpsWaves *waves, const CpsStage *stage, double step, Coarse *worst) {
    int count = 0;
    double shortest = INFINITY;
    for (int i = 0; i < waves->wave_count; i++) {
        shortest = fmin(shortest, waves->wave[i].period);
        count += waves->wave[i].period < STEPS * step;
    }
    note_period(worst, stage, step, shortest);
    if (worst->stage == stage) worst->count = count;
    worst->of = waves->wave_count;
}

/* What the oscillations of a body turn it by in each step, beside its way. */
static void note_turns(const CpsScene *scene, const CpsStage *stage, double step, int body,
                       Coarse *worst) {
    double before[3] = {0};
    for (int n = 1; n <= stage->step_count; n++) {
        double now[3] = {0}, one[6];
        for (int i = 0; i < stage->sway_count; i++) {
            const CpsSway *sway = &stage->sway[i];
            if (sway->of != CPS_SWAY_OF_BODY || sway->owner != body) continue;
            cps_sway_at(sway, n * step, one);
            for (int k = 0; k < 3; k++) now[k] += one[3 + k];
        }
        double turn = 0;
        for (int k = 0; k < 3; k++) {
            turn = hypot(turn, now[k] - before[k]);
            before[k] = now[k];
        }
        if (!(turn > HALF_TURN)) continue;
        note(worst, stage, step, turn, turn > worst->value);
        worst->body = scene->body[body].name;
    }
}

/* Bodies that the entry leads. */
static void note_bodies(const CpsScene *scene, const CpsStage *stage, double step, Coarse *worst) {
    for (int i = 0; i < stage->body_change_count; i++) {
        const CpsBodyChange *change = &stage->body_change[i];
        if (change->kind == CPS_BODY_KIND_HELD && stage->sway_count > 0)
            note_turns(scene, stage, step, change->body, worst);
    }
}

static void print_head(const Coarse *worst) {
    fputs("capstan: warning: entry ", stderr);
    cli_print_text(stderr, worst->stage->name ? worst->stage->name : "", 80, false);
    fprintf(stderr, ": in a step of %.4g s ", worst->step);
}

void coarse_steps_warn(const CpsScene *scene) {
    Coarse sway = {0}, wave = {0}, turn = {0};
    const CpsWaves *waves = scene->current ? scene->current->waves : NULL;
    for (int s = 0; s < scene->stage_count; s++) {
        const CpsStage *stage = &scene->stage[s];
        if (!(stage->duration > 0)) continue;
        const double step = stage->duration / stage->step_count;
        for (int i = 0; i < stage->sway_count; i++)
            if (stage->sway[i].row_count == 0)
                note_period(&sway, stage, step, stage->sway[i].period);
        if (waves) note_waves(waves, stage, step, &wave);
        note_bodies(scene, stage, step, &turn);
    }
    if (sway.stage) {
        print_head(&sway);
        fprintf(stderr,
                "an oscillation goes through %.3g of its period of %.4g s, and is not seen as it "
                "is: take at least ten steps for a period\n",
                sway.step / sway.value, sway.value);
    }
    if (wave.stage) {
        print_head(&wave);
        fprintf(stderr,
                "a wave goes through %.3g of its period of %.4g s, and is not seen as it is: take "
                "at least ten steps for a period (%d of %d waves have fewer than four)\n",
                wave.step / wave.value, wave.value, wave.count, wave.of);
    }
    if (turn.stage) {
        print_head(&turn);
        fprintf(stderr,
                "body %s is turned by up to %.4g degrees; by more than half a turn it is taken to "
                "turn the other way: take shorter steps\n",
                turn.body, turn.value * 180 / HALF_TURN);
    }
}
