/* SPDX-License-Identifier: BSD-3-Clause */
/* The waves of a scene (waves.h). */
#include "evolve/waves.h"

#include <math.h>
#include <stdio.h>

#include "base/status.h"
#include "evolve/loads.h"
#include "evolve/ranges.h"
#include "evolve/time_check.h"

static CpsStatus check_wave(const CpsScene *scene, int index, CpsError *err) {
    const CpsWaves *waves = cpsi_waves_of(scene);
    const CpsWave *wave = &waves->wave[index];
    char place[48];
    snprintf(place, sizeof place, "waves.components[%d]", index + 1);
    if (!cpsi_is_positive(wave->amplitude) || !cpsi_is_positive(wave->period) ||
        !cpsi_is_usable(wave->direction) || !cpsi_is_usable(wave->phase))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "waves: component %d has the amplitude %g m, period %g s, direction "
                            "%g rad and phase %g rad: expected a positive amplitude and period "
                            "and finite angles",
                            index + 1, wave->amplitude, wave->period, wave->direction, wave->phase);
    const double k = cps_wave_number(wave->period, waves->depth, -scene->gravity[2]),
                 most = cps_breaking_height(k, waves->depth);
    if (!cpsi_is_positive(k))
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "waves: component %d has no wave length: its period is %g s", index + 1,
                            wave->period);
    if (2 * wave->amplitude > most)
        return CPSI_FAIL_AT(place, err, CPS_ERR_ARGUMENT,
                            "waves: component %d would be %g m high, but in this depth a wave "
                            "with the period %g s breaks at %.4g m: give half of a height below "
                            "that as amplitude",
                            index + 1, 2 * wave->amplitude, wave->period, most);
    return CPS_OK;
}

/* What waves need of the scene. */
static CpsStatus check_scene(const CpsScene *scene, CpsError *err) {
    bool any = false;
    if (!scene->has_water_surface)
        return CPSI_FAIL_AT("waves", err, CPS_ERR_ARGUMENT,
                            "waves: they are those of a surface, which the water has not: give "
                            "water_surface");
    if (!(scene->gravity[2] < 0))
        return CPSI_FAIL_AT("waves", err, CPS_ERR_ARGUMENT,
                            "waves: without gravity there are none: give gravity (0, 0, -g)");
    if (!cpsi_is_in_time(scene))
        return CPSI_FAIL_AT("waves", err, CPS_ERR_ARGUMENT,
                            "waves: they move the water in time, but no stage of the history has "
                            "a duration: give one");
    for (int i = 0; i < scene->line_count; i++)
        any = any || (!scene->line[i].quasi_static && cpsi_has_drag(scene, &scene->line[i]));
    for (int i = 0; i < scene->body_count; i++)
        any = any || scene->body[i].excitation_count > 0 || scene->body[i].member_count > 0;
    for (int i = 0; i < scene->point_count; i++) any = any || scene->point[i].displaced_weight > 0;
    if (!any)
        return CPSI_FAIL_AT("waves", err, CPS_ERR_ARGUMENT,
                            "waves: they act on lines with drag that are not quasi_static, on "
                            "points with a volume and on "
                            "bodies with excitation or members, and there is none: give one, or "
                            "leave the waves out");
    return CPS_OK;
}

CpsStatus cpsi_waves_check_stage(const CpsStage *stage, const char *what, CpsError *err) {
    if (!stage->gravity_changes) return CPS_OK;
    return CPSI_FAIL_AT("gravity", err, CPS_ERR_ARGUMENT,
                        "%s: gravity changes, but waves are those under one gravity: leave either "
                        "out",
                        what);
}

CpsStatus cpsi_waves_check(const CpsScene *scene, CpsError *err) {
    const CpsWaves *waves = cpsi_waves_of(scene);
    if (!waves) return CPS_OK;
    CpsStatus status = check_scene(scene, err);
    if (status != CPS_OK) return status;
    if (!(cpsi_is_positive(waves->depth) || waves->depth == INFINITY))
        return CPSI_FAIL_AT("waves.depth", err, CPS_ERR_ARGUMENT,
                            "waves: depth is %g m, expected a positive number, or infinity",
                            waves->depth);
    if (!cpsi_is_not_negative(waves->ramp))
        return CPSI_FAIL_AT("waves.ramp", err, CPS_ERR_ARGUMENT,
                            "waves: ramp is %g s, expected a finite number >= 0", waves->ramp);
    if (waves->wave_count < 1 || !waves->wave)
        return CPSI_FAIL_AT("waves.components", err, CPS_ERR_ARGUMENT,
                            "waves: found no component, expected one or more");
    if (waves->wave_count > CPS_MAX_WAVES)
        return CPSI_FAIL_AT("waves.components", err, CPS_ERR_LIMIT,
                            "waves: found %d components, the limit is %d", waves->wave_count,
                            (int)CPS_MAX_WAVES);
    for (int i = 0; i < waves->wave_count && status == CPS_OK; i++)
        status = check_wave(scene, i, err);
    for (int k = 0; k < scene->stage_count && status == CPS_OK; k++) {
        char what[32];
        snprintf(what, sizeof what, "stage %d", k + 1);
        status = cpsi_waves_check_stage(&scene->stage[k], what, err);
        if (status != CPS_OK) status = cpsi_fail_inside(err, status, "history[%d]", k + 1);
    }
    return status;
}

void cpsi_waves_fill(CpsiWaves *out, CpsiWave *wave, const CpsScene *local,
                     const double origin[3]) {
    const CpsWaves *given = cpsi_waves_of(local);
    if (!given) return;
    for (int i = 0; i < given->wave_count; i++)
        wave[i] = cpsi_wave(&given->wave[i], given->depth, -local->gravity[2], origin);
    *out = (CpsiWaves){.surface = local->water_surface,
                       .depth = given->depth,
                       .ramp = given->ramp,
                       .count = given->wave_count,
                       .wave = wave};
}

CpsWaterMotion cps_waves_at(const CpsScene *scene, double time, const double x[3]) {
    CpsWaterMotion out = {.elevation = 0};
    const CpsWaves *given = scene ? cpsi_waves_of(scene) : NULL;
    if (!given || !scene->has_water_surface) return out;
    Vec3 velocity = vec3(0, 0, 0), acceleration = vec3(0, 0, 0);
    for (int i = 0; i < given->wave_count; i++) {
        const CpsiWave wave = cpsi_wave(&given->wave[i], given->depth, -scene->gravity[2], x);
        const CpsiWaves one = {.surface = scene->water_surface,
                               .depth = given->depth,
                               .ramp = given->ramp,
                               .time = time,
                               .count = 1,
                               .wave = &wave};
        double lift;
        const CpsiWaterMotion motion = cpsi_waves_at(&one, vec3(0, 0, x[2]), &lift);
        velocity = vec3_add(velocity, motion.velocity);
        acceleration = vec3_add(acceleration, motion.acceleration);
        out.elevation += lift;
    }
    vec3_store(out.velocity, velocity);
    vec3_store(out.acceleration, acceleration);
    return out;
}
