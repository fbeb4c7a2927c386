/* SPDX-License-Identifier: BSD-3-Clause */
/* The inertia of a line as its field (inertia_field.h). */
#include "cable/inertia_field.h"

Vec3 cpsi_line_expected_place(const CpsiLine *line, int j, Vec3 reference) {
    const CpsiInertia *inertia = &line->inertia;
    const Vec3 now = vec3_at(inertia->start, j);
    if (inertia->is_euler[j])
        return vec3_axpy(inertia->span[j], vec3_at(inertia->start_velocity, j), reference);
    /* x(t) = x_{n-1} + v_{n-1} t + (x_n - x_{n-1} - v_{n-1} h_n) (t/h_n)^2 at t = h_n + h */
    const Vec3 before = vec3_at(inertia->before, j);
    const double w = inertia->formula.ratio, last = inertia->formula.length / w;
    const Vec3 on = vec3_scale(last, vec3_at(inertia->before_velocity, j)),
               bent = vec3_sub(vec3_sub(now, before), on);
    return vec3_axpy((1 + w) * (1 + w), bent, vec3_axpy(1 + w, on, before));
}
