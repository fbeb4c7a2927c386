/* SPDX-License-Identifier: BSD-3-Clause */
/* Oscillations of what a stage imposes (sways.h). */
#include "evolve/sways.h"

#include <math.h>
#include <stdio.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/ranges.h"

/* Oscillations of one thing in a move, whose memory is that of the evolution. */
enum { OF_MOVE = 8 };

/* The name of what a stage changes, as in its messages. */
typedef struct Owner {
    char name[80];
    bool is_there;    /* the stage changes it */
    bool is_released; /* an end that is let go */
} Owner;

static Owner find_owner(const CpsScene *scene, const CpsStage *stage, const CpsSway *sway) {
    Owner owner = {.name = ""};
    const int index = sway->owner;
    const char *name = "", *what = "";
    switch (sway->of) {
    case CPS_SWAY_OF_END:
        for (int i = 0; i < stage->change_count; i++) {
            const CpsChange *change = &stage->change[i];
            if (change->line != index || change->end != sway->end) continue;
            owner.is_there = true;
            owner.is_released = change->to.kind == CPS_END_KIND_RELEASED;
        }
        if (owner.is_there) name = scene->line[index].name;
        what = cpsi_end_letter(sway->end);
        break;
    case CPS_SWAY_OF_POINT:
        for (int i = 0; i < stage->point_change_count; i++)
            owner.is_there = owner.is_there || stage->point_change[i].point == index;
        if (owner.is_there) name = scene->point[index].name;
        what = "point";
        break;
    case CPS_SWAY_OF_BODY:
        for (int i = 0; i < stage->body_change_count; i++)
            owner.is_there = owner.is_there || stage->body_change[i].body == index;
        if (owner.is_there) name = scene->body[index].name;
        what = "body";
        break;
    }
    snprintf(owner.name, sizeof owner.name, "%s.%s", name, what);
    return owner;
}

static bool is_zero(const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

static CpsStatus check_sway(const CpsScene *scene, const CpsStage *stage, int index,
                            const char *what, CpsError *err) {
    static const char *const kind[] = {"line", "point", "body"};
    const CpsSway *sway = &stage->sway[index];
    if ((unsigned)sway->of > CPS_SWAY_OF_BODY)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: oscillation %d is of the unknown kind %d",
                         what, index + 1, (int)sway->of);
    const Owner owner = find_owner(scene, stage, sway);
    if (!owner.is_there)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: oscillation %d is of %s %d, end %d, which the stage does not change",
                         what, index + 1, kind[sway->of], sway->owner, sway->end);
    const double *s = sway->sine, *c = sway->cosine;
    if (!cpsi_is_positive(sway->period) || !cpsi_are_usable(s) || !cpsi_are_usable(c) ||
        !cpsi_are_usable(&s[3]) || !cpsi_are_usable(&c[3]))
        return CPSI_FAIL_AT(owner.name, err, CPS_ERR_ARGUMENT,
                            "%s: %s oscillates with the period %g s, sine (%g, %g, %g) and cosine "
                            "(%g, %g, %g): expected a positive period and finite numbers",
                            what, owner.name, sway->period, s[0], s[1], s[2], c[0], c[1], c[2]);
    if (sway->of != CPS_SWAY_OF_BODY && !(is_zero(&s[3]) && is_zero(&c[3])))
        return CPSI_FAIL_AT(owner.name, err, CPS_ERR_ARGUMENT,
                            "%s: %s oscillates about axes, which only a body does", what,
                            owner.name);
    if (!(stage->duration > 0))
        return CPSI_FAIL_AT(owner.name, err, CPS_ERR_ARGUMENT,
                            "%s: %s oscillates in time, but the stage has no duration", what,
                            owner.name);
    if (owner.is_released)
        return CPSI_FAIL_AT(owner.name, err, CPS_ERR_ARGUMENT,
                            "%s: %s is let go, and cannot oscillate", what, owner.name);
    return CPS_OK;
}

CpsStatus cpsi_sways_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                           CpsError *err) {
    if (stage->sway_count < 0 || (stage->sway_count > 0 && !stage->sway))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: found %d oscillations, expected 0 or more",
                         what, stage->sway_count);
    for (int i = 0; i < stage->sway_count; i++) {
        const CpsStatus status = check_sway(scene, stage, i, what, err);
        if (status != CPS_OK) return status;
    }
    return CPS_OK;
}

void cps_sway_at(const CpsSway *sway, double time, double out[6]) {
    for (int a = 0; a < 6; a++) out[a] = 0;
    if (!sway || !(sway->period > 0)) return;
    const double angle = 2 * CPSI_PI * (time / sway->period);
    for (int a = 0; a < 6; a++)
        out[a] = sway->sine[a] * sin(angle) + sway->cosine[a] * (1 - cos(angle));
}

int cpsi_sways_of_move(int things) { return OF_MOVE * things; }

void cpsi_sways_at(int count, const CpsSway *sway, CpsSwayOf of, int owner, int end, double time,
                   double out[6]) {
    for (int a = 0; a < 6; a++) out[a] = 0;
    for (int k = 0; k < count; k++) {
        if (sway[k].of != of || sway[k].owner != owner) continue;
        if (of == CPS_SWAY_OF_END && sway[k].end != end) continue;
        double added[6];
        cps_sway_at(&sway[k], time, added);
        for (int a = 0; a < 6; a++) out[a] += added[a];
    }
}
