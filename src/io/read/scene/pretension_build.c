/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines with a pretension get the lengths that have it (see scene_build.h). */
#include <limits.h>
#include <math.h>
#include <string.h>

#include "capstan/pretension.h"
#include "io/read/scene/scene_build.h"

static CpsStatus find_length(const CpsiDocument *d, const CpsiPretensionValues *values,
                             CpsiPool *pool, const CpsScene *scene, CpsLine *line) {
    const int index = (int)(line - scene->line);
    const bool horizontal = isnan(values->tension);
    int section = CPS_WHOLE_LINE;
    if (!isnan(values->section)) section = (int)fmin(values->section, INT_MAX) - 1;
    if (line->section_count > 0 && section == CPS_WHOLE_LINE)
        return cpsi_document_fail(d, CPS_ERR_INPUT, values->node,
                                  "'pretension': 'section' is missing: the number, from 1 to %d, "
                                  "of the section whose length is found",
                                  line->section_count);
    CpsError found;
    double length;
    const CpsStatus status =
        cps_scene_length_for(scene, index, section, values->end,
                             horizontal ? CPS_PULL_HORIZONTAL : CPS_PULL_TENSION,
                             horizontal ? values->horizontal : values->tension, &length, &found);
    if (status != CPS_OK)
        return cpsi_document_fail(d, status == CPS_ERR_ARGUMENT ? CPS_ERR_INPUT : status,
                                  values->node, "%s", found.message);
    const CpsLineArrays arrays = {
        .element_length = CPSI_POOL_TAKE(pool, line->element_count, double),
        .section = CPSI_POOL_TAKE(pool, line->section_count + 1, CpsSection),
        .point_weight = CPSI_POOL_TAKE(pool, line->point_weight_count + 1, CpsPointWeight),
        .zone = CPSI_POOL_TAKE(pool, line->zone_count + 1, CpsFrictionZone)};
    if (!arrays.element_length || !arrays.section || !arrays.point_weight || !arrays.zone)
        return cpsi_document_no_memory(d);
    cps_line_resize(line, section, length, &arrays);
    return CPS_OK;
}

/* Does the history grasp a node of the line? */
static bool is_grasped(const CpsScene *scene, int line) {
    for (int s = 0; s < scene->stage_count; s++)
        for (int k = 0; k < scene->stage[s].grasp_change_count; k++)
            if (scene->stage[s].grasp_change[k].line == line) return true;
    return false;
}

CpsStatus cpsi_scene_find_lengths(const CpsiDocument *d, const CpsiSceneValues *values,
                                  CpsiPool *pool, CpsScene *scene) {
    const CpsiLineValues *from = values->lines.item;
    bool any = false;
    for (int i = 0; i < scene->line_count; i++) any = any || from[i].pretension.node;
    if (!any) return CPS_OK;
    CpsLine *line = CPSI_POOL_TAKE(pool, scene->line_count, CpsLine);
    if (!line) return cpsi_document_no_memory(d);
    memcpy(line, scene->line, (size_t)scene->line_count * sizeof *line);
    scene->line = line;
    CpsStatus status = CPS_OK;
    for (int i = 0; i < scene->line_count && status == CPS_OK; i++)
        if (from[i].pretension.node && is_grasped(scene, i))
            status = cpsi_document_fail(
                d, CPS_ERR_INPUT, from[i].pretension.node,
                "'pretension': the history grasps a node of this line, whose arc length is not "
                "known before the length is found; give the line the length that `capstan check` "
                "prints without these entries, and no pretension");
        else if (from[i].pretension.node)
            status = find_length(d, &from[i].pretension, pool, scene, &line[i]);
    return status;
}
