/* SPDX-License-Identifier: BSD-3-Clause */
/* The waves of a scene (capstan/waves.h). */
#ifndef CAPSTAN_SRC_EVOLVE_WAVES_H
#define CAPSTAN_SRC_EVOLVE_WAVES_H

#include "cable/waves.h"
#include "capstan/scene.h"

/* The waves of the scene; NULL: none. */
static inline const CpsWaves *cpsi_waves_of(const CpsScene *scene) {
    return scene->current ? scene->current->waves : NULL;
}

/* Check them; gravity and surface of the scene have been checked. */
CpsStatus cpsi_waves_check(const CpsScene *scene, CpsError *err);
/* A stage or move of a scene with waves. */
CpsStatus cpsi_waves_check_stage(const CpsStage *stage, const char *what, CpsError *err);

/* The waves about `origin` of a scene whose positions are relative to it; `wave` (their number) is
 * where they are kept. */
void cpsi_waves_fill(CpsiWaves *out, CpsiWave *wave, const CpsScene *local, const double origin[3]);

#endif
