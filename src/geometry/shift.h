/* SPDX-License-Identifier: BSD-3-Clause */
/* A rigid motion of an obstacle: it turns about a point, which is shifted meanwhile. At share s of
 * the motion x is at
 *
 *     about + s by + R(s turn) (x - about),
 *
 * R(v) the rotation by the angle |v| about v. */
#ifndef CAPSTAN_SRC_GEOMETRY_SHIFT_H
#define CAPSTAN_SRC_GEOMETRY_SHIFT_H

#include "base/rotation.h"

typedef struct CpsiShift {
    Vec3 by;    /* [m] */
    Vec3 turn;  /* [rad] */
    Vec3 about; /* [m] where the point is at the start */
} CpsiShift;

static inline bool cpsi_vec3_is_zero(Vec3 v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/* Does it move nothing? */
static inline bool cpsi_shift_is_none(const CpsiShift *shift) {
    return cpsi_vec3_is_zero(shift->by) && cpsi_vec3_is_zero(shift->turn);
}

/* From share `from` of it to share `to`, which may be less: back. */
static inline CpsiShift cpsi_shift_part(const CpsiShift *shift, double from, double to) {
    return (CpsiShift){vec3_scale(to - from, shift->by), vec3_scale(to - from, shift->turn),
                       vec3_axpy(from, shift->by, shift->about)};
}

/* Where it takes x. */
static inline Vec3 cpsi_shift_carry(const CpsiShift *shift, Vec3 x) {
    if (cpsi_shift_is_none(shift)) return x;
    if (cpsi_vec3_is_zero(shift->turn)) return vec3_add(x, shift->by);
    const Vec3 arm = rotation_apply(rotation_of(shift->turn), vec3_sub(x, shift->about));
    return vec3_add(vec3_add(shift->about, arm), shift->by);
}

/* [m] How far it has moved what is at x in the end, and how far it will move what is at x now. */
static inline Vec3 cpsi_shift_to(const CpsiShift *shift, Vec3 x) {
    if (cpsi_vec3_is_zero(shift->turn)) return shift->by;
    const CpsiShift back = cpsi_shift_part(shift, 1, 0);
    return vec3_sub(x, cpsi_shift_carry(&back, x));
}
static inline Vec3 cpsi_shift_from(const CpsiShift *shift, Vec3 x) {
    if (cpsi_vec3_is_zero(shift->turn)) return shift->by;
    return vec3_sub(cpsi_shift_carry(shift, x), x);
}

#endif
