/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, forces and drag (load_build.h). */
#include "io/read/scene/parts/load_build.h"

#include <math.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"

static CpsSpring spring_of(const CpsiSpringValues *values, const CpsLine *line) {
    CpsSpring out = {.from = isnan(values->from) ? 0 : values->from,
                     .to = isnan(values->to) ? line->length : values->to,
                     .at_start = isnan(values->place[0])};
    if (!isnan(values->at)) out.from = out.to = values->at;
    memcpy(out.stiffness, values->stiffness, sizeof out.stiffness);
    memcpy(out.coupling, values->coupling, sizeof out.coupling);
    if (!out.at_start) memcpy(out.place, values->place, sizeof out.place);
    return out;
}

static CpsLineForce force_of(const CpsiForceValues *values, const CpsLine *line) {
    CpsLineForce out = {.from = isnan(values->from) ? 0 : values->from,
                        .to = isnan(values->to) ? line->length : values->to};
    memcpy(out.force, values->force, sizeof out.force);
    return out;
}

CpsStatus cpsi_loads_build(const CpsiMaterials *m, const CpsiLineValues *values, CpsLine *line) {
    const CpsiSpringValues *springs = values->springs.item;
    const CpsiForceValues *forces = values->loads.item;
    if (values->springs.count + values->loads.count == 0 && !values->drag.node) return CPS_OK;
    CpsLineLoads *loads = CPSI_POOL_TAKE(m->pool, 1, CpsLineLoads);
    CpsSpring *spring = CPSI_POOL_TAKE(m->pool, values->springs.count + 1, CpsSpring);
    CpsLineForce *force = CPSI_POOL_TAKE(m->pool, values->loads.count + 1, CpsLineForce);
    if (!loads || !spring || !force) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < values->springs.count; k++) spring[k] = spring_of(&springs[k], line);
    for (int k = 0; k < values->loads.count; k++) force[k] = force_of(&forces[k], line);
    *loads = (CpsLineLoads){.spring_count = values->springs.count,
                            .spring = spring,
                            .force_count = values->loads.count,
                            .force = force};
    if (values->drag.node) loads->drag = values->drag.drag;
    line->loads = loads;
    return CPS_OK;
}

static CpsWave wave_of(const CpsiWaveValues *values) {
    return (CpsWave){.amplitude = values->amplitude,
                     .period = isnan(values->period) ? 1 / values->frequency : values->period,
                     .direction = values->direction * CPSI_DEGREE,
                     .phase = values->phase * CPSI_DEGREE};
}

enum { AMPLITUDE, PERIOD, FREQUENCY, DIRECTION, PHASE, COLUMNS };
static const CpsiCsvColumn COLUMN[COLUMNS] = {[AMPLITUDE] = {"amplitude", "m", CPSI_CSV_REQUIRED},
                                              [PERIOD] = {"period", "s", CPSI_CSV_OPTIONAL},
                                              [FREQUENCY] = {"frequency", "Hz", CPSI_CSV_OPTIONAL},
                                              [DIRECTION] = {"direction", "degree",
                                                             CPSI_CSV_REQUIRED},
                                              [PHASE] = {"phase", "degree", CPSI_CSV_OPTIONAL}};

/* The components of a file. */
static CpsStatus read_waves(const CpsiMaterials *m, const CpsiWavesValues *values,
                            CpsWaves *waves) {
    CpsiCsvTable table;
    const char *path;
    const CpsStatus status =
        cpsi_document_table(m->d, cpsi_yaml_child(values->node, "file"), values->file, COLUMN,
                            COLUMNS, m->pool, &table, &path);
    if (status != CPS_OK) return status;
    const int timed = table.has[PERIOD] ? PERIOD : FREQUENCY;
    if (table.has[PERIOD] == table.has[FREQUENCY])
        return cpsi_fail_at(m->d->err, CPS_ERR_INPUT, path, table.names, 1,
                            "found %s, expected either the column period or the column frequency",
                            table.has[PERIOD] ? "both" : "neither");
    CpsWave *wave = CPSI_POOL_TAKE(m->pool, table.rows, CpsWave);
    if (!wave) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < table.rows; k++) {
        const double *row = &table.value[COLUMNS * k];
        const int wrong = row[AMPLITUDE] > 0 ? timed : AMPLITUDE;
        if (!(row[wrong] > 0))
            return cpsi_fail_at(m->d->err, CPS_ERR_INPUT, path, table.line[k], 1,
                                "%s: found %g, expected a number in %s, greater than 0",
                                COLUMN[wrong].name, row[wrong], COLUMN[wrong].unit);
        wave[k] = wave_of(&(CpsiWaveValues){.amplitude = row[AMPLITUDE],
                                            .period = timed == PERIOD ? row[PERIOD] : NAN,
                                            .frequency = row[FREQUENCY],
                                            .direction = row[DIRECTION],
                                            .phase = row[PHASE]});
    }
    waves->wave = wave;
    waves->wave_count = table.rows;
    return CPS_OK;
}

static CpsStatus build_waves(const CpsiMaterials *m, const CpsiWavesValues *values,
                             CpsWaves *waves) {
    const CpsiWaveValues *component = values->components.item;
    *waves = (CpsWaves){.depth = values->depth, .ramp = values->ramp};
    if (values->file) return read_waves(m, values, waves);
    CpsWave *wave = CPSI_POOL_TAKE(m->pool, values->components.count, CpsWave);
    if (!wave) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < values->components.count; k++) wave[k] = wave_of(&component[k]);
    waves->wave = wave;
    waves->wave_count = values->components.count;
    return CPS_OK;
}

/* Waves without a current are those of water at rest. */
CpsStatus cpsi_current_build(const CpsiMaterials *m, const CpsiList *rows,
                             const CpsiWavesValues *waves, CpsScene *scene) {
    const CpsiCurrentValues *values = rows->item;
    if (rows->count == 0 && !waves->node) return CPS_OK;
    const int count = rows->count > 0 ? rows->count : 1;
    CpsCurrent *current = CPSI_POOL_TAKE(m->pool, 1, CpsCurrent);
    CpsCurrentRow *row = CPSI_POOL_TAKE(m->pool, count, CpsCurrentRow);
    if (!current || !row) return cpsi_document_no_memory(m->d);
    for (int k = 0; k < rows->count; k++) row[k] = values[k].row;
    if (rows->count == 0) *row = (CpsCurrentRow){.z = 0};
    *current = (CpsCurrent){.density = m->water, .row_count = count, .row = row};
    scene->current = current;
    if (!waves->node) return CPS_OK;
    CpsWaves *built = CPSI_POOL_TAKE(m->pool, 1, CpsWaves);
    if (!built) return cpsi_document_no_memory(m->d);
    current->waves = built;
    return build_waves(m, waves, built);
}

CpsStatus cpsi_still_water_build(const CpsiMaterials *m, CpsScene *scene) {
    bool in_time = false, drag = false;
    for (int k = 0; k < scene->stage_count; k++) in_time = in_time || scene->stage[k].duration > 0;
    for (int i = 0; i < scene->line_count; i++)
        drag = drag || (scene->line[i].loads && scene->line[i].loads->drag.diameter > 0);
    if (scene->current || !in_time || !drag || !(m->water > 0)) return CPS_OK;
    CpsCurrent *current = CPSI_POOL_TAKE(m->pool, 1, CpsCurrent);
    CpsCurrentRow *row = CPSI_POOL_TAKE(m->pool, 1, CpsCurrentRow);
    if (!current || !row) return cpsi_document_no_memory(m->d);
    *row = (CpsCurrentRow){.z = 0};
    *current = (CpsCurrent){.density = m->water, .row_count = 1, .row = row};
    scene->current = current;
    return CPS_OK;
}
