/* SPDX-License-Identifier: BSD-3-Clause */
/* Contact seen from the nodes (contact.h).
 *
 * The step problem is written on the tangent plane of each node's contact, in axes at the node's place `base`. On one
 * plane with isotropic friction nothing changes from place to place, the axes are the line's own and base is the
 * reference. Elsewhere the normal, the tangent along the line and the way already slid are those of `base`, and rounds
 * move base until it is where the solution is (line_step.c).
 *
 * The way slid is that of the node on the surface since the reference, the reference carried along by an obstacle that
 * turns. A node that lands within the step counts its way from the foot of its reference. */
#include "cable/contact.h"

#include <string.h>

#include "cable/rub_set.h"
#include "linsys/frame.h"

static bool is_end(const CpsiLine *line, int j, CpsEndKind kind) {
    return (j == 0 && line->end[CPS_END_A].kind == kind) || (j == line->n - 1 && line->end[CPS_END_B].kind == kind);
}

/* Direction of the line at node j, by its neighbours. */
static Vec3 direction(const CpsiLine *line, const double *x, int j) {
    const int before = j > 0 ? j - 1 : 0, after = j + 1 < line->n ? j + 1 : j;
    return vec3_sub(vec3_load(&x[3*after]), vec3_load(&x[3*before]));
}

/* Nearest obstacle, axes and curvature at the node's base; without an obstacle those of the world. */
static void see(CpsiLine *line, int j) {
    const Vec3 x = vec3_load(&line->base[3*j]);
    double *axes = &line->axes[9*j], gap;
    line->on[j] = cpsi_line_nearest(line, x, &gap);
    if (line->on[j] >= 0) {
        cpsi_obstacle_axes(&line->obstacle[line->on[j]], x, direction(line, line->base, j), axes,
                           &line->curvature[3*j]);
        memcpy(&line->normal[3*j], &axes[6], 3*sizeof *axes);
        return;
    }
    memcpy(axes, line->common, sizeof line->common);
    for (int a = 0; a < 3; a++) line->curvature[3*j + a] = line->normal[3*j + a] = 0;
}

/* The reference on obstacle k, carried along as it turns. */
static Vec3 carried(const CpsiLine *line, int j, int k) {
    return cpsi_obstacle_turn(&line->obstacle[k], vec3_load(&line->reference[3*j]), line->turn[k]);
}

void cpsi_contact_look(CpsiLine *line) {
    for (int j = 0; j < line->n; j++) {
        see(line, j);
        const Vec3 x = vec3_load(&line->base[3*j]), n = vec3_load(&line->normal[3*j]);
        const int k = line->on[j];
        vec3_store(&line->slide[3*j],
                   k < 0 ? vec3(0, 0, 0) : cpsi_obstacle_way(&line->obstacle[k], carried(line, j, k), x));
        if (!isfinite(line->gap[j])) continue;
        const Vec3 u = vec3_sub(x, vec3_load(&line->reference[3*j]));
        line->gap[j] = cpsi_obstacle_gap(&line->obstacle[k], x) - vec3_dot(n, u);
    }
}

void cpsi_contact_pose(CpsiLine *line, const CpsiStepOptions *options) {
    const size_t n = (size_t)line->n;
    memcpy(line->reference, line->position, 3*n*sizeof *line->reference);
    if (line->follows) memcpy(line->base, line->reference, 3*n*sizeof *line->base);
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_load(&line->reference[3*j]);
        double gap;
        const int k = cpsi_line_nearest(line, x, &gap);
        const bool touches = k >= 0 && line->state[j] != CPS_NODE_FREE, held = is_end(line, j, CPS_END_HELD);
        if (line->follows)
            see(line, j);
        else if (k >= 0)
            vec3_store(&line->normal[3*j], line->obstacle[k].frame.axis[2]);
        const bool rubs = touches && !held && !options->frictionless;
        line->friction_bound[j] = rubs ? cpsi_rub_set(line, j).friction*line->reaction[j] : 0;
        /* contact: everywhere, or only where the reference touches (S90 (35)) */
        const bool watched =
            k >= 0 && !held && (options->contact == CPS_CONTACT_GAINED || touches || gap <= CPSI_TOUCH*line->length);
        line->gap[j] = !watched ? INFINITY : gap > 0 ? gap : 0;
    }
    cpsi_contact_slide(line);
}

void cpsi_contact_slide(CpsiLine *line) {
    if (!line->follows) return;
    for (int j = 0; j < line->n; j++) {
        const Vec3 from = line->on[j] >= 0 ? carried(line, j, line->on[j]) : vec3_load(&line->reference[3*j]);
        const Vec3 n = vec3_load(&line->normal[3*j]), u = vec3_sub(vec3_load(&line->position[3*j]), from);
        vec3_store(&line->slide[3*j], vec3_axpy(-vec3_dot(u, n), n, u));
    }
}

double cpsi_contact_move(CpsiLine *line) {
    double turned = 0;
    for (int j = 0; j < line->n; j++) {
        const Vec3 from = vec3_load(&line->base[3*j]), to = vec3_load(&line->position[3*j]);
        const CpsiObstacle *obstacle = cpsi_line_obstacle(line, j);
        const bool touching = obstacle && line->reaction[j] > 0;
        const Vec3 x = touching ? cpsi_obstacle_move(obstacle, from, vec3_sub(to, from)) : to;
        vec3_store(&line->position[3*j], x);
    }
    /* how the axes turn, the tangent's turn counting where it matters */
    memcpy(line->base, line->position, 3*(size_t)line->n*sizeof *line->base);
    for (int j = 0; j < line->n; j++) {
        const int on = line->on[j];
        double before[9];
        memcpy(before, &line->axes[9*j], sizeof before);
        see(line, j);
        if (!(line->reaction[j] > 0)) continue;
        if (line->on[j] != on) turned = INFINITY;
        const double *now = &line->axes[9*j];
        for (int row = 0; row < 3; row += 2) {
            const Vec3 change = vec3_sub(vec3_load(&now[3*row]), vec3_load(&before[3*row]));
            turned = fmax(turned, vec3_norm(change));
        }
    }
    return turned;
}
