/* SPDX-License-Identifier: BSD-3-Clause */
/* Types of lines, sections, point weights, and weights in water: from the values of a scene file to
 * a line. */
#ifndef CAPSTAN_SRC_IO_READ_SCENE_SECTION_BUILD_H
#define CAPSTAN_SRC_IO_READ_SCENE_SECTION_BUILD_H

#include "io/base/yaml/pool.h"
#include "io/read/document.h"
#include "io/schema/tables/scene_keys.h"

/* What lines are made of and lie in. */
typedef struct CpsiMaterials {
    const CpsiDocument *d;
    CpsiPool *pool;
    const CpsiTypeValues **type; /* (type_count) by name */
    int type_count;
    double gravity; /* [m/s2] its size */
    double water;   /* [kg/m3] */
} CpsiMaterials;

/* Sort the scene's types by name. */
CpsStatus cpsi_materials_sort(CpsiMaterials *materials, const CpsiList *types);

/* [N/m] The weight per length of a line without sections. */
CpsStatus cpsi_line_weight_build(const CpsiMaterials *materials, const CpsiLineValues *values,
                                 CpsLine *line);

/* The table of a type or line; none where it has a number. */
CpsStatus cpsi_stiffness_build(const CpsiMaterials *materials, const CpsiStiffnessValues *values,
                               int *count, const CpsStiffnessRow **row);

/* The dynamic stiffness of a type or line. */
CpsStatus cpsi_dynamic_stiffness_build(const CpsiMaterials *materials,
                                       const CpsiDynamicValues *values, bool *has,
                                       CpsDynamicStiffness *out);

/* The elements of a stretch of natural length [m]: how many, where `count` is NaN so many that none
 * exceeds `most` [m]; and how long each is, (elements), from A to B. */
double cpsi_graded_count(double length, double count, double most, const CpsiGradeValues *grade);
void cpsi_graded_fill(double length, int count, const CpsiGradeValues *grade, double *out);

/* The number of elements of all sections. */
double cpsi_section_elements(const CpsiList *sections);

/* Sections, with length and elements of the line, line->element_count of them, and friction zones
 * where types have a friction of their own. */
CpsStatus cpsi_sections_build(const CpsiMaterials *materials, const CpsiLineValues *values,
                              CpsLine *line);

/* [N] The weight of a clump or a buoy of this mass [kg], NaN: not given, and volume [m3]; else
 * `weight`. */
/* [kg, kg/m] The mass that moves: as given, else the mass of what is given by that; NaN: not given.
 */
double cpsi_moving_mass(double inertia, double mass);

double cpsi_weight_in_water(const CpsiMaterials *materials, double mass, double volume,
                            double weight);

/* [N] Of the water that this volume [m3] displaces. */
double cpsi_displaced_weight(const CpsiMaterials *materials, double volume);

CpsStatus cpsi_point_weights_build(const CpsiMaterials *materials, const CpsiList *points,
                                   CpsLine *line);

#endif
