/* SPDX-License-Identifier: BSD-3-Clause */
/* The report of a step (report.h). */
#include "cable/report.h"

#include <string.h>

#include "cable/certificate.h"
#include "cable/contact.h"
#include "cable/contact_carry.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/friction_law.h"
#include "cable/winch.h"
#include "chain/frame.h"
#include "chain/slack.h"

/* [J] by friction in the step. */
static double dissipated(const CpsiLine *line) {
    double sum = 0;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (!(line->friction_bound[c] > 0)) continue;
        double slip[3];
        cpsi_line_local_slip(line, c, slip);
        sum += cpsi_friction_law_dissipation(&line->friction_law[c], line->friction_bound[c], slip);
    }
    return sum;
}

/* A friction force is at its bound if it lacks no more than this share of it: a hundred times what
 * the interior-point loop leaves at nodes that slip. */
static const double AT_BOUND = 1e-4;

/* Free or in contact, and slack: of two complementary quantities, the one that is larger on its own
 * scale counts as not zero. A node slips if its friction is at its bound and it has moved by more
 * than CPS_TOUCH lengths of the line on its obstacle; it sticks if not. */
void cpsi_line_classify(CpsiLine *line, const CpsiChainProgram *program) {
    const double weight = vec3_norm(vec3_load(line->weight));
    const double density =
        weight > 0 ? weight : line->report.certificate.largest_force / line->length;
    CpsLineReport *report = &line->report;
    memset(line->state, CPS_NODE_STATE_FREE, (size_t)cpsi_line_all_contacts(line));
    for (int k = 0; k < program->unilateral.count; k++) {
        const int c = program->unilateral.contact[k];
        if (line->reaction[c] >
            density * cpsi_line_contact_share(line, c) * program->unilateral.s[k])
            line->state[c] = line->is_rough ? CPS_NODE_STATE_UNRESOLVED : CPS_NODE_STATE_STICK;
    }
    for (int k = 0; k < program->disc.count; k++) {
        const int c = program->disc.contact[k];
        const double *z = program->disc.z[k], *s = program->disc.s[k],
                     slip = sqrt(s[1] * s[1] + s[2] * s[2]);
        if (line->state[c] == CPS_NODE_STATE_STICK && slip > CPSI_TOUCH &&
            sqrt(z[1] * z[1] + z[2] * z[2]) >= (1 - AT_BOUND) * z[0])
            line->state[c] = CPS_NODE_STATE_SLIP;
    }
    for (int k = 0; k < program->conic.count; k++) {
        const int c = program->conic.contact[k];
        if (line->state[c] == CPS_NODE_STATE_STICK &&
            cpsi_friction_conic_slip(program, k) > CPSI_TOUCH &&
            cpsi_friction_conic_margin(&program->conic, k) <= AT_BOUND)
            line->state[c] = CPS_NODE_STATE_SLIP;
    }
    report->dissipated = dissipated(line);
    for (int i = 1; i < line->n; i++)
        if (cpsi_segment_is_slack(&program->segment, i) && !cpsi_line_is_on_drum(line, i - 1))
            report->slack += line->natural_length[i - 1];
}

Vec3 cpsi_line_end_slip(const CpsiLine *line, int end, int k) {
    const int j = cpsi_line_end_node(line, end);
    return cpsi_obstacle_slip(&line->obstacle[k], cpsi_contact_carry(line, k, j, true),
                              vec3_at(line->position, j));
}

/* Rotate v, in the plane with normal `from`, with the normal to that with normal `to`; the two
 * normals are never opposite. */
static Vec3 rotate_with_normal(Vec3 v, Vec3 from, Vec3 to) {
    const double cosine = vec3_dot(from, to);
    return cosine > -0.5 ? vec3_axpy(-vec3_dot(to, v) / (1 + cosine), vec3_add(from, to), v)
                         : vec3(0, 0, 0);
}

/* The friction of the half element beside an end that is held where it lies on obstacle k, with
 * normal n and a reaction: that of the neighbouring node, F per length of the line, with the end's
 * own zone factor. Its share of its bound is no larger than that of F, and it is 0 where it would
 * drive a sliding end. */
static Vec3 half_friction_force(const CpsiLine *line, int end, int k, Vec3 n, double reaction) {
    const Vec3 none = vec3(0, 0, 0);
    const int j = cpsi_line_end_node(line, end), next = end == CPS_END_A ? j + 1 : j - 1;
    for (int c = next; c < cpsi_line_contacts(line); c += line->n) {
        const double bound = line->friction_bound[c];
        if (cpsi_line_obstacle(line, c) != &line->obstacle[k] || !(bound > 0)) continue;
        const double zone =
            line->friction_factor ? line->friction_factor[j] / line->friction_factor[next] : 1;
        const double density = zone * cpsi_line_share(line, j) / cpsi_line_share(line, next);
        const double part = fmin(density, line->friction_law[j].friction * reaction / bound);
        const Vec3 force = rotate_with_normal(vec3_at(line->friction_force, c),
                                              cpsi_line_friction_normal(line, c), n);
        const Vec3 slip = cpsi_line_end_slip(line, end, k);
        const bool drives =
            vec3_dot(force, slip) > 0 && vec3_norm(slip) > CPSI_TOUCH * line->length;
        return drives ? none : vec3_scale(part, force);
    }
    return none;
}

/* A held end that lies on an obstacle has a reaction, and its half element has friction there:
 * returns the remainder of `force` for the support. */
static Vec3 rest_on_obstacle(CpsiLine *line, int end, Vec3 force) {
    const int j = cpsi_line_end_node(line, end);
    const Vec3 x = vec3_at(line->position, j);
    double gap;
    const int on = cpsi_line_nearest_rigid(line, x, &gap);
    const Vec3 n = on < 0 ? vec3(0, 0, 0) : cpsi_obstacle_normal(&line->obstacle[on], x);
    const double up = vec3_dot(force, n);
    if (!(up > 0) || !(gap <= CPSI_TOUCH * line->length)) return force;
    line->reaction[j] = up;
    vec3_store(&line->normal[3 * j], n);
    if (line->has_local_axes) line->obstacle_index[j] = on;
    line->friction_law[j] = cpsi_line_friction_law(line, j);
    line->state[j] =
        CPS_NODE_STATE_STICK; /* if it is released in the next step, it starts with this friction */
    const Vec3 friction_force = half_friction_force(line, end, on, n, up);
    vec3_store(line->report.end[end].friction_force, friction_force);
    line->report.dissipated -= vec3_dot(friction_force, cpsi_line_end_slip(line, end, on));
    return vec3_sub(vec3_axpy(-up, n, force), friction_force);
}

/* What acts on node j beside the line and obstacles. */
static Vec3 load_of(const CpsiLine *line, int j) {
    const Vec3 load = vec3_at(line->load, j);
    if (!cpsi_line_has_field(line)) return load;
    return vec3_add(load, cpsi_line_field_balanced(line, j));
}

void cpsi_line_report_ends(CpsiLine *line) {
    for (int end = 0; end < 2; end++) {
        const int j = cpsi_line_end_node(line, end), e = end == CPS_END_A ? j : j - 1;
        CpsEndReport *out = &line->report.end[end];
        memcpy(out->position, &line->position[3 * j], sizeof out->position);
        Vec3 force = vec3_load(line->end[end].value);
        if (line->end[end].kind == CPS_END_KIND_HELD) {
            /* the force of the support balances the element's tension, the node's weight and the
             * force of the element's contact on the node */
            const Vec3 pull =
                vec3_scale(end == CPS_END_A ? 1 : -1, vec3_at(line->segment_force, e));
            const Vec3 others = cpsi_add_element_contacts(line, j, load_of(line, j));
            force = vec3_scale(-1, vec3_add(pull, others));
            if (!line->is_at_point[end]) force = rest_on_obstacle(line, end, force);
        }
        if (line->on[end].is_there) force = vec3_add(force, cpsi_line_set_reaction(line, j));
        vec3_store(out->force, force);
        out->tension = vec3_norm(force);
    }
    for (int k = 0; k < line->grasp_count; k++) {
        CpsGrasp *grasp = &line->grasp[k];
        const int j = grasp->node;
        Vec3 force = vec3_load(grasp->imposed.value);
        if (grasp->imposed.kind == CPS_END_KIND_HELD) {
            const Vec3 pull =
                vec3_sub(vec3_at(line->segment_force, j), vec3_at(line->segment_force, j - 1));
            const Vec3 others = cpsi_add_element_contacts(line, j, load_of(line, j));
            force = vec3_scale(-1, vec3_add(pull, others));
        }
        vec3_store(grasp->force, force);
    }
}

/* Against gravity, or z without. */
static Vec3 upwards(const double gravity[3]) {
    const double size = vec3_norm(vec3_load(gravity));
    return size > 0 ? vec3_scale(-1 / size, vec3_load(gravity)) : vec3(0, 0, 1);
}

void cpsi_line_report_uplift(CpsiLine *line, const double gravity[3]) {
    const Vec3 up = upwards(gravity);
    for (int end = 0; end < 2; end++) {
        CpsEndReport *out = &line->report.end[end];
        const CpsiEndGround *ground = &line->ground[end];
        const Vec3 normal = vec3_load(ground->normal);
        Vec3 pull = vec3_scale(-1, vec3_load(out->force));
        /* the ground under an anchor bears what presses on it */
        if (ground->obstacle && vec3_dot(pull, normal) < 0)
            pull = vec3_axpy(-ground->borne * vec3_dot(pull, normal), normal, pull);
        out->uplift = vec3_dot(pull, up);
        out->angle = atan2(out->uplift, vec3_norm(vec3_reject(pull, up)));
    }
}

/* Keep the larger utilisation, by a tension at an arc length. */
static void raise_utilisation(CpsLineReport *report, double tension, double breaking_load,
                              double arc_length) {
    const double utilisation = tension / breaking_load;
    if (!(utilisation > report->utilisation)) return;
    report->utilisation = utilisation;
    report->utilisation_arc_length = arc_length;
}

void cpsi_line_report_utilisation(CpsiLine *line) {
    CpsLineReport *report = &line->report;
    report->has_utilisation = line->has_breaking_load;
    report->utilisation = report->utilisation_arc_length = 0;
    if (!line->has_breaking_load) return;
    const int first = cpsi_line_end_node(line, CPS_END_A),
              last = cpsi_line_end_node(line, CPS_END_B) - 1;
    for (int e = first; e <= last; e++)
        raise_utilisation(report, line->tension[e], line->breaking_load[e],
                          0.5 * (line->arc_length[e] + line->arc_length[e + 1]));
    raise_utilisation(report, report->end[CPS_END_A].tension, line->breaking_load[first], 0);
    raise_utilisation(report, report->end[CPS_END_B].tension, line->breaking_load[last],
                      line->length);
}

/* Does node j touch obstacle k? If so, *density is its reaction per length. */
static bool touches(const CpsiLine *line, int j, const CpsiObstacle *k, double *density) {
    if (j < 0 || j >= line->n) return false;
    for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
        if (line->state[c] == CPS_NODE_STATE_FREE || cpsi_line_obstacle(line, c) != k) continue;
        *density = line->reaction[c] / cpsi_line_share(line, j);
        return true;
    }
    return false;
}

/* The ground under the point at which node j ends the line, or NULL. */
static const CpsiEndGround *ground_at(const CpsiLine *line, int j) {
    for (int end = 0; end < 2; end++)
        if (line->ground[end].obstacle && j == cpsi_line_end_node(line, end))
            return &line->ground[end];
    return NULL;
}

/* The share of its length with which a touching node lies on the obstacle of contact c. Inside a
 * piece that lies there it is 1. At the end of a piece it is the ratio of its reaction to that of a
 * node that lies there with its whole length: on a plane the weight, on a curved obstacle the
 * reaction per length of the next node inside the piece. It is 1 where neither is known. */
static double grounded_part(const CpsiLine *line, int c) {
    const int j = cpsi_line_node(line, c);
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const CpsiEndGround *first = ground_at(line, j - 1), *last = ground_at(line, j + 1);
    double density = 0, other = 0;
    const bool before = touches(line, j - 1, obstacle, &density) ||
                        (first && first->obstacle == obstacle),
               after =
                   touches(line, j + 1, obstacle, &density) || (last && last->obstacle == obstacle);
    if (before && after) return 1;
    if (obstacle->kind == CPS_OBSTACLE_PLANE)
        density = -vec3_dot(cpsi_line_load_at(line, j), vec3_at(line->normal, c));
    else if (before == after || !touches(line, before ? j - 2 : j + 2, obstacle, &other))
        return 1;
    const double bears = density * cpsi_line_share(line, j);
    return line->reaction[c] < bears ? line->reaction[c] / bears : 1;
}

/* Has the node of contact c slipped? The motion of a held end is imposed. */
static bool has_slipped(const CpsiLine *line, int c) {
    const int j = cpsi_line_node(line, c),
              end = j <= cpsi_line_end_node(line, CPS_END_A) ? CPS_END_A : CPS_END_B;
    if (!cpsi_line_is_held(line, j)) return line->state[c] == CPS_NODE_STATE_SLIP;
    const int k = line->has_local_axes ? line->obstacle_index[c] : 0;
    return vec3_norm(cpsi_line_end_slip(line, end, k)) > CPSI_TOUCH * line->length;
}

/* The share of its length with which node j lies on any obstacle; 0 of a node without contact. */
static double touching_part(const CpsiLine *line, int j) {
    const CpsiEndGround *ground = ground_at(line, j);
    double part = ground ? ground->part : 0;
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (line->state[c] != CPS_NODE_STATE_FREE) part = fmax(part, grounded_part(line, c));
    return part;
}

/* [m] The length from an end to the first contact, which begins between nodes as a grounded piece
 * does; what a single node does not ground is off the obstacle on both sides. *node is the first
 * one that touches; -1: none does. */
static double suspended(const CpsiLine *line, int end, int *node) {
    const int first = cpsi_line_end_node(line, end), towards = end == CPS_END_A ? 1 : -1;
    double length = 0;
    for (int j = first; j >= 0 && j < line->n; j += towards) {
        const double part = touching_part(line, j), share = cpsi_line_share(line, j);
        *node = part > 0 ? j : -1;
        if (part > 0 && j == first) return 0;
        if (part > 0) {
            const int next = j + towards;
            const bool goes_on = next < 0 || next >= line->n || touching_part(line, next) > 0;
            return length + (goes_on ? 1 - part : 0.5 * (1 - part)) * share;
        }
        length += share;
    }
    return line->length;
}

/* Where the line is at an arc length, which lies on an element at node j; at an end, the end. */
static Vec3 place_near(const CpsiLine *line, int j, double arc_length) {
    const int e = j == line->n - 1 || (j > 0 && arc_length < line->arc_length[j]) ? j - 1 : j;
    const double part = (arc_length - line->arc_length[e]) / line->natural_length[e],
                 within = fmin(fmax(part, 0), 1);
    return vec3_add(vec3_scale(1 - within, vec3_at(line->position, e)),
                    vec3_scale(within, vec3_at(line->position, e + 1)));
}

/* The length that hangs from an end, and where it touches down, if the line touches at all. */
static void report_touchdown(CpsiLine *line, int end, bool touches) {
    CpsEndReport *out = &line->report.end[end];
    int node = -1;
    out->suspended = touches ? suspended(line, end, &node) : line->length;
    line->report.has_touchdown = node >= 0;
    const double arc_length =
        end == CPS_END_A ? out->suspended : line->arc_length[line->n - 1] - out->suspended;
    vec3_store(out->touchdown, node >= 0 ? place_near(line, node, arc_length) : vec3(0, 0, 0));
}

void cpsi_line_keep_start(CpsiLine *line) {
    memcpy(line->start_end, line->position, sizeof line->start_end);
    for (int i = 0; i < 3 * (line->n - 1); i++)
        line->start_element[i] = (float)(line->position[i + 3] - line->position[i]);
}

/* The element behind node j as it was at the start; nothing behind the last node or before the
 * first. */
static Vec3 element_at_start(const CpsiLine *line, int j) {
    if (j < 0 || j >= line->n - 1) return vec3(0, 0, 0);
    const float *x = &line->start_element[3 * j];
    return vec3(x[0], x[1], x[2]);
}

/* In single precision the sum of the elements is known to 1e-7 of the line's length; what is less
 * than this share of it counts as no sweep. */
static const double UNSWEPT = 1e-6;
/* A piece of line whose plan is no longer than this share of it stood upright. */
static const double UPRIGHT = 1e-6;

/* [m] The part in plan of a motion across a direction; all of it where that is upright. */
static double across(Vec3 moved, Vec3 along, Vec3 up) {
    const Vec3 plan = vec3_reject(along, up), level = vec3_reject(moved, up);
    const double length = vec3_norm(plan);
    if (!(length > UPRIGHT * vec3_norm(along))) return vec3_norm(level);
    return vec3_norm(vec3_reject(level, vec3_scale(1 / length, plan)));
}

void cpsi_line_report_sweep(CpsiLine *line, const double gravity[3]) {
    const Vec3 up = upwards(gravity);
    Vec3 start = vec3_load(line->start_end);
    double most = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 before = element_at_start(line, j - 1), behind = element_at_start(line, j);
        const bool was_on_drum =
            cpsi_line_has_winch(line) && vec3_norm(before) == 0 && vec3_norm(behind) == 0;
        start = vec3_add(start, before);
        if (touching_part(line, j) > 0 && !was_on_drum)
            most = fmax(most, across(vec3_sub(vec3_at(line->position, j), start),
                                     vec3_add(before, behind), up));
    }
    line->report.sweep = most > UNSWEPT * line->length ? most : 0;
}

void cpsi_line_report_lengths(CpsiLine *line) {
    line->report.has_slipping = true;
    line->report.grounded = line->report.slipping = 0;
    bool any = false;
    for (int j = 0; j < line->n; j++) {
        const double part = touching_part(line, j);
        const CpsiEndGround *ground = ground_at(line, j);
        bool slips = ground && ground->slips;
        for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
            if (line->state[c] == CPS_NODE_STATE_FREE) continue;
            slips = slips || has_slipped(line, c);
            if (line->state[c] == CPS_NODE_STATE_UNRESOLVED) line->report.has_slipping = false;
        }
        any = any || part > 0;
        line->report.grounded += part * cpsi_line_share(line, j);
        if (slips) line->report.slipping += part * cpsi_line_share(line, j);
    }
    if (!line->report.has_slipping) line->report.slipping = 0;
    for (int end = 0; end < 2; end++) report_touchdown(line, end, any);
}
