/* SPDX-License-Identifier: BSD-3-Clause */
/* The drag of a current (flow.h). */
#include "cable/flow.h"

#include "base/math.h"

Vec3 cpsi_flow_velocity(const CpsiFlow *flow, double z) {
    const CpsCurrentRow *row = flow->row;
    int above = 0;
    while (above < flow->row_count && row[above].z <= z) above++;
    if (above == 0) return vec3_load(row[0].velocity);
    if (above == flow->row_count) return vec3_load(row[above - 1].velocity);
    const Vec3 low = vec3_load(row[above - 1].velocity), high = vec3_load(row[above].velocity);
    const double share = (z - row[above - 1].z) / (row[above].z - row[above - 1].z);
    return vec3_axpy(share, vec3_sub(high, low), low);
}

/* Add what the program gives. */
static void add_given(const CpsiGivenWater *given, Vec3 x, CpsiWaterMotion *out) {
    const Vec3 at = vec3_add(x, vec3_load(given->origin));
    const double place[3] = {at.x, at.y, at.z};
    double velocity[3] = {0}, acceleration[3] = {0};
    given->function(given->user, given->time, place, velocity, acceleration);
    out->velocity = vec3_add(out->velocity, vec3_load(velocity));
    out->acceleration = vec3_add(out->acceleration, vec3_load(acceleration));
}

void cpsi_flow_add_motion(const CpsiFlow *flow, Vec3 x, CpsiWaterMotion *out) {
    if (flow->waves) {
        const CpsiWaterMotion waves = cpsi_waves_at(flow->waves, x, NULL);
        out->velocity = vec3_add(waves.velocity, out->velocity);
        out->acceleration = waves.acceleration;
    }
    if (flow->given) add_given(flow->given, x, out);
}

Vec3 cpsi_flow_drag(const CpsiFlow *flow, Vec3 velocity, Vec3 d) {
    const CpsDrag *drag = &flow->drag;
    const double size = vec3_norm(d), half = 0.5 * flow->density * drag->diameter;
    const Vec3 t = vec3_scale(size > 0 ? 1 / size : 0, d), across = vec3_reject(velocity, t);
    const double along = vec3_dot(velocity, t);
    return vec3_axpy(half * CPSI_PI * drag->tangential * fabs(along) * along, t,
                     vec3_scale(half * drag->normal * vec3_norm(across), across));
}

/* Half of the drag on element e. */
static Vec3 half_of(const CpsiLine *line, const double *x, int e) {
    if (e < 0 || e + 1 >= line->n) return vec3(0, 0, 0);
    const CpsiFlow *flow = line->field.flow;
    const Vec3 d = vec3_sub(vec3_at(x, e + 1), vec3_at(x, e));
    const double z = 0.5 * (x[3 * e + 2] + x[3 * e + 5]);
    return vec3_scale(0.5 * line->natural_length[e],
                      cpsi_flow_drag(flow, cpsi_flow_velocity(flow, z), d));
}

/* The drag on node j. */
static Vec3 drag_at(const CpsiLine *line, const double *x, int j) {
    return vec3_add(half_of(line, x, j - 1), half_of(line, x, j));
}

void cpsi_line_follow_flow(CpsiLine *line, const double *x) {
    if (!line->field.flow) return;
    for (int j = 0; j < line->n; j++) vec3_store(&line->field.drag[3 * j], drag_at(line, x, j));
}

/* A change of this share of the drag is not near the end of the rounds. */
static const double MUCH = 0.1;

void cpsi_line_approach_flow(CpsiLine *line, bool first) {
    double *drag = line->field.drag, changed = 0, all = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 now = drag_at(line, line->position, j);
        changed += vec3_norm(vec3_sub(now, vec3_at(drag, j)));
        all += vec3_norm(now);
    }
    const bool far = !(changed <= MUCH * all);
    if (first || far) cpsi_anderson_start(&line->field.rounds, line->n, drag);
    for (int j = 0; j < line->n; j++) {
        const Vec3 now = drag_at(line, line->position, j), before = vec3_at(drag, j);
        vec3_store(&drag[3 * j], far ? vec3_scale(0.5, vec3_add(before, now)) : now);
    }
    /* all nodes but the last one count: an element is as long as it is */
    if (!far) cpsi_anderson_accelerate(&line->field.rounds, line->n, line->element_length, drag);
}

double cpsi_line_flow_change(const CpsiLine *line) {
    double changed = 0;
    if (!line->field.flow) return 0;
    if (line->inertia.is_moving) return line->field.left;
    for (int j = 0; j < line->n; j++)
        changed +=
            vec3_norm(vec3_sub(drag_at(line, line->position, j), vec3_at(line->field.drag, j)));
    return changed;
}

Vec3 cpsi_line_mean_drag(const CpsiLine *line, int j) {
    return vec3_scale(0.5, vec3_add(drag_at(line, line->reference, j),
                                    drag_at(line, line->position, j)));
}
