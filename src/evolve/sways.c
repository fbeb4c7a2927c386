/* SPDX-License-Identifier: BSD-3-Clause */
/* Oscillations of what a stage imposes (sways.h). */
#include "evolve/sways.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/ranges.h"

/* Oscillations of one thing in a move, whose memory is that of the evolution. */
enum { OF_MOVE = 8 };
/* of a row of a series: time and value */
enum { COLUMNS = 7 };
/* A series ends with its stage up to this share of the duration: rounding. */
static const double COVERED = 1e-9;

/* The name of what a stage changes, as in its messages. */
typedef struct Owner {
    char name[80];
    bool is_there;    /* the stage changes it */
    bool is_released; /* an end that is let go */
    bool is_held;
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
            owner.is_held = change->to.kind == CPS_END_KIND_HELD;
        }
        if (owner.is_there) name = scene->line[index].name;
        what = cpsi_end_letter(sway->end);
        break;
    case CPS_SWAY_OF_POINT:
        for (int i = 0; i < stage->point_change_count; i++) {
            if (stage->point_change[i].point != index) continue;
            owner.is_there = true;
            owner.is_held = stage->point_change[i].kind == CPS_POINT_KIND_HELD;
        }
        if (owner.is_there) name = scene->point[index].name;
        what = "point";
        break;
    case CPS_SWAY_OF_BODY:
        for (int i = 0; i < stage->body_change_count; i++) {
            if (stage->body_change[i].body != index) continue;
            owner.is_there = true;
            owner.is_held = stage->body_change[i].kind == CPS_BODY_KIND_HELD;
        }
        if (owner.is_there) name = scene->body[index].name;
        what = "body";
        break;
    }
    snprintf(owner.name, sizeof owner.name, "%s.%s", name, what);
    return owner;
}

static bool is_zero(const double v[3]) { return v[0] == 0 && v[1] == 0 && v[2] == 0; }

/* A time series: its rows, and what they are for. */
static CpsStatus check_series(const CpsStage *stage, const CpsSway *sway, const Owner *owner,
                              const char *what, CpsError *err) {
    const int last = sway->row_count - 1;
    double begin[6];
    if (sway->row_count < 2 || !sway->row)
        return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                            "%s: the series of %s has %d rows, expected at least 2", what,
                            owner->name, sway->row_count);
    for (int k = 0; k <= last; k++) {
        const double *row = &sway->row[COLUMNS * k], time[3] = {row[0], 0, 0};
        if (!cpsi_are_usable(time) || !cpsi_are_usable(&row[1]) || !cpsi_are_usable(&row[4]))
            return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                                "%s: row %d of the series of %s has numbers that are not finite",
                                what, k + 1, owner->name);
        if (k > 0 && !(row[0] > row[-COLUMNS]))
            return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                                "%s: row %d of the series of %s is at %g s, after %g s: times "
                                "increase",
                                what, k + 1, owner->name, row[0], row[-COLUMNS]);
        if (sway->of != CPS_SWAY_OF_BODY && !is_zero(&row[4]))
            return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                                "%s: the series of %s turns, which only a body does", what,
                                owner->name);
    }
    const double *first = sway->row, *end = &sway->row[COLUMNS * last];
    if (!(first[0] <= 0 && end[0] >= stage->duration * (1 - COVERED)))
        return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                            "%s: the series of %s goes from %g s to %g s, and the entry from 0 to "
                            "%g s: give a series that covers it",
                            what, owner->name, first[0], end[0], stage->duration);
    cps_sway_at(sway, 0, begin);
    if (owner->is_held && !(is_zero(begin) && is_zero(&begin[3])))
        return CPSI_FAIL_AT(owner->name, err, CPS_ERR_ARGUMENT,
                            "%s: the series of %s begins with (%g, %g, %g), and a place does not "
                            "jump: let it begin with 0, and lead %s there in an entry before",
                            what, owner->name, begin[0], begin[1], begin[2], owner->name);
    return CPS_OK;
}

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
    const bool series = sway->row_count != 0;
    if (!series && (!cpsi_is_positive(sway->period) || !cpsi_are_usable(s) || !cpsi_are_usable(c) ||
                    !cpsi_are_usable(&s[3]) || !cpsi_are_usable(&c[3])))
        return CPSI_FAIL_AT(owner.name, err, CPS_ERR_ARGUMENT,
                            "%s: %s oscillates with the period %g s, sine (%g, %g, %g) and cosine "
                            "(%g, %g, %g): expected a positive period and finite numbers",
                            what, owner.name, sway->period, s[0], s[1], s[2], c[0], c[1], c[2]);
    if (!series && sway->of != CPS_SWAY_OF_BODY && !(is_zero(&s[3]) && is_zero(&c[3])))
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
    return series ? check_series(stage, sway, &owner, what, err) : CPS_OK;
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

/* The slope at row k of component a: that of the parabola through it and its neighbours, at an end
 * through the first or last three; of two rows that of the line. */
static double slope_at(const CpsSway *sway, int k, int a) {
    const int last = sway->row_count - 1;
    if (last == 1) {
        const double *low = sway->row, *high = low + COLUMNS;
        return (high[1 + a] - low[1 + a]) / (high[0] - low[0]);
    }
    const int middle = k == 0 ? 1 : k == last ? last - 1 : k;
    const double *at = &sway->row[COLUMNS * middle], *before = at - COLUMNS, *after = at + COLUMNS;
    const double h = at[0] - before[0], g = after[0] - at[0],
                 down = (at[1 + a] - before[1 + a]) / h, up = (after[1 + a] - at[1 + a]) / g,
                 bend = (up - down) / (h + g);
    return down + bend * h + 2 * bend * (sway->row[COLUMNS * k] - at[0]);
}

static void series_at(const CpsSway *sway, double time, double out[6]) {
    int low = 0, high = sway->row_count - 1;
    while (high - low > 1) {
        const int middle = low + (high - low) / 2;
        if (sway->row[COLUMNS * middle] <= time)
            low = middle;
        else
            high = middle;
    }
    const double *from = &sway->row[COLUMNS * low], *to = from + COLUMNS, h = to[0] - from[0],
                 s = fmax(0, fmin(1, (time - from[0]) / h)), r = 1 - s;
    for (int a = 0; a < 6; a++)
        out[a] = r * r * (1 + 2 * s) * from[1 + a] + s * s * (1 + 2 * r) * to[1 + a] +
                 h * s * r * (r * slope_at(sway, low, a) - s * slope_at(sway, low + 1, a));
}

void cps_sway_at(const CpsSway *sway, double time, double out[6]) {
    for (int a = 0; a < 6; a++) out[a] = 0;
    if (sway && sway->row_count > 1) {
        series_at(sway, time, out);
        return;
    }
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

size_t cpsi_sways_numbers(int count, const CpsSway *sway) {
    size_t numbers = 0;
    for (int k = 0; k < count; k++) numbers += COLUMNS * (size_t)sway[k].row_count;
    return numbers;
}

void cpsi_sways_copy(int count, const CpsSway *from, CpsSway *to, double *rows) {
    for (int k = 0; k < count; k++) {
        const size_t numbers = COLUMNS * (size_t)from[k].row_count;
        to[k] = from[k];
        to[k].row = numbers > 0 ? rows : NULL;
        if (numbers > 0) memcpy(rows, from[k].row, numbers * sizeof *rows);
        rows += numbers;
    }
}
