/* SPDX-License-Identifier: BSD-3-Clause */
/* A static stiffness and a dynamic one about the state that it reaches (two_stiffnesses.h).
 *
 * T(e) = T_d(e - r) of an element of natural length l is the law of one of the length at rest
 * l (1 + r), whose strain is d = (e - r)/(1 + r):
 *
 *     T = T_d((1 + r) d):    c/(1 + r) for c,    s_k/(1 + r) for s_k,    (1 + r) K_k for K_k
 *
 * and l W is the same energy. So a step is the program of a line without rest strains, to the
 * letter; weights, friction and abscissas stay those of the natural length. */
#include "cable/two_stiffnesses.h"

#include <string.h>

/* One of the laws of element e, per natural length. */
static CpsiElementLaw law_of(const CpsiLine *line, int which, int e) {
    const CpsiElasticity *own = &line->two.elasticity[which];
    CpsiElementLaw law = {.compliance = line->spring_compliance * own->compliance_factor[e],
                          .longer = 1,
                          .stiffer = 1};
    if (own->spring_count == 0) return law;
    const int first = own->spring_at[e];
    law.count = own->spring_at[e + 1] - first;
    law.start = &own->spring_start[first];
    law.stiffness = &own->spring_stiffness[first];
    return law;
}

/* r of element e at its present strain. The dynamic stiffness is not the softer one: r >= 0 but for
 * rounding. */
static double rest_strain(const CpsiLine *line, int e) {
    const Vec3 dx = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    const double strain = vec3_norm(dx) / line->natural_length[e] - 1;
    if (!(strain > 0)) return 0;
    const CpsiElementLaw slow = law_of(line, CPSI_STATIC, e), fast = law_of(line, CPSI_DYNAMIC, e);
    return fmax(0, strain - cpsi_law_strain(&fast, cpsi_law_tension(&slow, strain)));
}

void cpsi_line_set_stiffness(CpsiLine *line) {
    const CpsiTwoStiffnesses *two = &line->two;
    const CpsiElasticity *own = &two->elasticity[two->is_dynamic ? CPSI_DYNAMIC : CPSI_STATIC];
    line->spring_count = own->spring_count;
    for (int e = 0; e + 1 < line->n; e++) {
        const double longer = 1 + two->rest_strain[e];
        line->element_length[e] = longer * line->natural_length[e];
        line->compliance_factor[e] = own->compliance_factor[e] / longer;
        if (own->spring_count == 0) continue;
        for (int k = own->spring_at[e]; k < own->spring_at[e + 1]; k++) {
            line->spring_element[k] = e;
            line->spring_start[k] = own->spring_start[k] / longer;
            line->spring_stiffness[k] = own->spring_stiffness[k] * longer;
        }
    }
    if (own->spring_count > 0)
        memcpy(line->spring_at, own->spring_at, (size_t)line->n * sizeof *line->spring_at);
}

void cpsi_line_use_stiffness(CpsiLine *line, bool is_dynamic) {
    CpsiTwoStiffnesses *two = &line->two;
    two->has_jumped = false;
    if (!two->exists || two->is_dynamic == is_dynamic) return;
    two->has_jumped = !is_dynamic;
    for (int e = 0; e + 1 < line->n; e++)
        two->rest_strain[e] = is_dynamic ? rest_strain(line, e) : 0;
    two->is_dynamic = is_dynamic;
    line->last_change.known = false; /* the next step is not like the last one */
    cpsi_line_set_stiffness(line);
}
