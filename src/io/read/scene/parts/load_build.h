/* SPDX-License-Identifier: BSD-3-Clause */
/* Springs, forces and drag of lines, and the current: from the values of a scene file. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_PARTS_LOAD_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_PARTS_LOAD_BUILD_H

#include "io/read/scene/parts/section_build.h"

/* What acts on a line, whose length is known. */
CpsStatus cpsi_loads_build(const CpsiMaterials *materials, const CpsiLineValues *values,
                           CpsLine *line);

/* Still water, for lines with drag and members of bodies that move in time where there is no
 * current. */
CpsStatus cpsi_still_water_build(const CpsiMaterials *materials, CpsScene *scene);
CpsStatus cpsi_current_build(const CpsiMaterials *materials, const CpsiList *rows,
                             const CpsiWavesValues *waves, CpsScene *scene);

#endif
