/* SPDX-License-Identifier: BSD-3-Clause */
/* The first-order force of waves on bodies (excitation.h).
 *
 * With p the phase of a wave of the amplitude a at the place where the body begins, component j of
 * its force there is a A_j cos(p - lead_j), A_j and lead_j from the rows for its direction: between
 * two rows A_j exp(i lead_j) is linear in the frequency. */
#include "evolve/excitation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"
#include "evolve/ranges.h"
#include "evolve/waves.h"

enum { SIX = CPS_BODY_DIRECTIONS, OF_WAVE = 2 * SIX };
/* [rad] Two directions, and per period two periods, that differ by no more are one. */
static const double SAME = 1e-6, SAME_PERIOD = 1e-9;

static bool is_same_direction(double a, double b) {
    return fabs(remainder(a - b, 2 * CPSI_PI)) <= SAME;
}

/* Add the row's part of the force at the phases 0 and pi/2. */
static void add_row(const CpsExcitation *row, double share, double out[OF_WAVE]) {
    for (int j = 0; j < SIX; j++) {
        out[j] += share * row->amplitude[j] * cos(row->lead[j]);
        out[SIX + j] += share * row->amplitude[j] * sin(row->lead[j]);
    }
}

/* [N, N m] per amplitude of a wave at its phases 0 and pi/2; false: no rows have it between them.
 */
static bool find_transfer(const CpsBody *body, const CpsWave *wave, double out[OF_WAVE]) {
    const CpsExcitation *below = NULL, *above = NULL;
    const double period = wave->period, margin = SAME_PERIOD * period;
    for (int k = 0; k < body->excitation_count; k++) {
        const CpsExcitation *row = &body->excitation[k];
        if (!is_same_direction(row->direction, wave->direction)) continue;
        if (row->period <= period + margin && (!below || row->period > below->period)) below = row;
        if (row->period >= period - margin && (!above || row->period < above->period)) above = row;
    }
    memset(out, 0, OF_WAVE * sizeof *out);
    if (!below || !above) return false;
    const double slow = 1 / above->period, fast = 1 / below->period,
                 share = fast > slow ? fmax(0, fmin(1, (1 / period - slow) / (fast - slow))) : 1;
    add_row(below, share, out);
    add_row(above, 1 - share, out);
    return true;
}

/* ---- check ---- */

static CpsStatus check_row(const CpsBody *body, int index, CpsError *err) {
    const CpsExcitation *row = &body->excitation[index];
    char place[32];
    snprintf(place, sizeof place, "excitation[%d]", index + 1);
    bool sound = cpsi_is_positive(row->period) && cpsi_is_usable(row->direction);
    for (int j = 0; j < SIX; j++)
        sound = sound && cpsi_is_not_negative(row->amplitude[j]) && cpsi_is_usable(row->lead[j]);
    if (!sound)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "body '%s': excitation: row %d: expected a positive period, amplitudes "
                            "that are not negative and finite angles",
                            body->name, index + 1);
    for (int k = 0; k < index; k++)
        if (is_same_direction(body->excitation[k].direction, row->direction) &&
            fabs(row->period - body->excitation[k].period) <= row->period * SAME_PERIOD)
            return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                                "body '%s': excitation: row %d has the period %g s and the "
                                "direction %g degrees, as row %d: leave one of them out",
                                body->name, index + 1, row->period, row->direction / CPSI_DEGREE,
                                k + 1);
    return CPS_OK;
}

static CpsStatus check_body(const CpsScene *scene, const CpsBody *body, CpsError *err) {
    const CpsWaves *waves = cpsi_waves_of(scene);
    const int count = body->excitation_count;
    if (count < 0 || (count > 0 && !body->excitation))
        return CPSI_FAIL_AT("excitation", err, CPS_ERR_ARGUMENT,
                            "body '%s': excitation: found %d rows, expected 0 or more", body->name,
                            count);
    if (count > CPS_MAX_WAVES)
        return CPSI_FAIL_AT("excitation", err, CPS_ERR_LIMIT,
                            "body '%s': excitation: found %d rows, the limit is %d", body->name,
                            count, (int)CPS_MAX_WAVES);
    if (count > 0 && !waves)
        return CPSI_FAIL_AT("excitation", err, CPS_ERR_ARGUMENT,
                            "body '%s': excitation: it is that of waves, and the scene has none: "
                            "give waves, or leave it out",
                            body->name);
    CpsStatus status = CPS_OK;
    for (int k = 0; k < count && status == CPS_OK; k++) status = check_row(body, k, err);
    const int asked = count > 0 && status == CPS_OK ? waves->wave_count : 0;
    for (int w = 0; w < asked; w++) {
        double out[OF_WAVE];
        if (!find_transfer(body, &waves->wave[w], out))
            return CPSI_FAIL_AT("excitation", err, CPS_ERR_ARGUMENT,
                                "body '%s': excitation: no rows for the direction %g degrees have "
                                "the period %g s of wave %d between them",
                                body->name, waves->wave[w].direction / CPSI_DEGREE,
                                waves->wave[w].period, w + 1);
    }
    return status;
}

CpsStatus cpsi_excitation_check(const CpsScene *scene, CpsError *err) {
    CpsStatus status = CPS_OK;
    for (int i = 0; i < scene->body_count && status == CPS_OK; i++) {
        status = check_body(scene, &scene->body[i], err);
        if (status != CPS_OK)
            return cpsi_fail_inside(err, status, "bodies.%s", scene->body[i].name);
    }
    return status;
}

/* ---- data ---- */

static size_t numbers_of(const CpsScene *scene, int body) {
    const CpsWaves *waves = cpsi_waves_of(scene);
    return waves && scene->body[body].excitation_count > 0 ? OF_WAVE * (size_t)waves->wave_count
                                                           : 0;
}

void cpsi_excitation_layout(CpsEvolution *evolution, CpsiArena *arena, const CpsScene *scene) {
    size_t numbers = 0;
    for (int i = 0; i < scene->body_count; i++) numbers += numbers_of(scene, i);
    CPSI_PLACE(arena, evolution->excitation, numbers);
}

void cpsi_excitation_fill(CpsEvolution *evolution, const CpsScene *local) {
    const CpsWaves *waves = cpsi_waves_of(local);
    double *next = evolution->excitation;
    for (int i = 0; i < local->body_count; i++) {
        CpsiBody *body = &evolution->bodies.body[i];
        body->given.excitation = NULL; /* the caller's */
        if (numbers_of(local, i) == 0) continue;
        body->excitation = next;
        body->wave_count = waves->wave_count;
        for (int w = 0; w < waves->wave_count; w++, next += OF_WAVE) {
            (void)find_transfer(&local->body[i], &waves->wave[w], next);
            for (int j = 0; j < OF_WAVE; j++) next[j] *= waves->wave[w].amplitude;
        }
    }
}

void cpsi_excite_bodies(CpsEvolution *evolution) {
    const CpsiWaves *waves = &evolution->waves;
    for (int i = 0; i < evolution->bodies.count; i++) {
        CpsiBody *body = &evolution->bodies.body[i];
        double sum[SIX] = {0};
        const int count = evolution->interval > 0 ? body->wave_count : 0;
        for (int w = 0; w < count; w++) {
            const double p = cpsi_wave_phase(waves, w, body->begin.place), c = cos(p), s = sin(p);
            const double *force = &body->excitation[OF_WAVE * w];
            for (int j = 0; j < SIX; j++) sum[j] += c * force[j] + s * force[SIX + j];
        }
        const double share = cpsi_waves_share(waves);
        body->waves =
            (CpsiWrench){vec3_scale(share, vec3_load(sum)), vec3_scale(share, vec3_load(&sum[3]))};
    }
}
