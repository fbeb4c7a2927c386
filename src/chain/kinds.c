/* SPDX-License-Identifier: BSD-3-Clause */
/* The kinds of element of a chain, for each width of the processor's registers (base/width.h). */
#include "base/width.h"
#include "chain/elements.h"

#define KINDS(width)                                                                     \
    {                                                                                    \
        [CPSI_KIND_SEGMENT] = &cpsi_segment_##width, [CPSI_KIND_DRAG] = &cpsi_drag,      \
        [CPSI_KIND_FIELD] = &cpsi_node_field, [CPSI_KIND_CONSTRAINT] = &cpsi_constraint, \
        [CPSI_KIND_CONIC_CONSTRAINT] = &cpsi_conic_constraint,                           \
        [CPSI_KIND_UNILATERAL] = &cpsi_unilateral_##width,                               \
        [CPSI_KIND_FRICTION_DISC] = &cpsi_friction_disc_##width,                         \
        [CPSI_KIND_FRICTION_CONIC] = &cpsi_friction_conic_##width                        \
    }

const CpsiKind *const *cpsi_chain_kinds(CpsiArena *arena) {
#ifdef CPSI_HAS_WIDTHS
    static const CpsiKind *const kinds[CPSI_WIDTHS][CPSI_CHAIN_KINDS] = {
        [CPSI_WIDTH_128] = KINDS(128),
        [CPSI_WIDTH_256] = KINDS(256),
        [CPSI_WIDTH_512] = KINDS(512)};
    return kinds[cpsi_width_once(&arena->width)];
#else
    static const CpsiKind *const kinds[CPSI_CHAIN_KINDS] = KINDS(128);
    (void)arena;
    return kinds;
#endif
}
