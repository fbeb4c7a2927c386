/* SPDX-License-Identifier: BSD-3-Clause */
/* The reference of S90 as data (see node_start.h): x_R at the nodes, T_R in the elements, and the
 * reaction R_R or the friction bound A_R = mu R_R, (78). Where neither is given the reaction is the
 * one that balances T_R and the loads, section 2 d 2. */
#include "evolve/node_start.h"

#include <math.h>

#include "base/status.h"
#include "base/vec3.h"
#include "evolve/friction_zone.h"
#include "evolve/ranges.h"
#include "evolve/sections.h"
#include "geometry/obstacle.h"

/* An inextensible element may be longer than its length by this, relative: coordinates written with
 * 9 digits pass. */
static const double LENGTH_TOLERANCE = 1e-8;
/* An elastic element may not be stretched beyond this strain: more is taken for an error of input,
 * as for other starts. */
static const double MAX_STRAIN = 1;
/* Distance at which a given node touches the obstacle, per length of the line, and force that
 * counts as zero, per largest force. A certified step leaves products of reaction and distance of
 * about 1e-13 in these units, so that where R exceeds NOTHING the distance is less than TOUCH. */
static const double TOUCH = 1e-7, NOTHING = 1e-6;

/* ---- check ---- */

static CpsStatus check_lengths(const CpsLine *line, CpsError *err) {
    const bool elastic = cpsi_is_elastic(line);
    for (int e = 0; e < line->element_count; e++) {
        const Vec3 a = vec3_at(line->start.point, e), b = vec3_at(line->start.point, e + 1);
        const double l = cpsi_element_length(line, e), found = vec3_norm(vec3_sub(b, a));
        if (found <= l * (elastic ? 1 + MAX_STRAIN : 1 + LENGTH_TOLERANCE)) continue;
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': start: nodes %d and %d are %.10g m apart, the element between "
                         "them is %.10g m long%s",
                         line->name, e, e + 1, found, l,
                         elastic ? ", expected at most twice that" : " and inextensible");
    }
    return CPS_OK;
}

/* Forces of an array, from its `from`th node or element. */
static CpsStatus check_forces(const CpsLine *line, const double *force, int count, const char *what,
                              const char *where, CpsError *err) {
    if (force)
        for (int i = 0; i < count; i++)
            if (!cpsi_is_not_negative(force[i]))
                return cpsi_fail(
                    err, CPS_ERR_ARGUMENT,
                    "line '%s': start: the %s %s %d is %g N, expected a finite number >= 0",
                    line->name, what, where, i, force[i]);
    return CPS_OK;
}

/* The larger coefficient of an obstacle; of a given set 1. */
static double coefficient(const CpsObstacle *obstacle) {
    return obstacle->friction_set ? 1 : fmax(obstacle->friction, obstacle->friction_lateral);
}

/* Only touching nodes may have a reaction, and only nodes with friction a friction bound. */
static CpsStatus check_touch(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const CpsStart *start = &line->start;
    const double *force = start->reaction ? start->reaction : start->friction_bound;
    const char *what = start->reaction ? "reaction" : "friction bound";
    double at = 0, largest = 0;
    int first = 0;
    if (force) {
        for (int j = 0; j <= line->element_count; j++) largest = fmax(largest, force[j]);
        for (int j = 0; j <= line->element_count; j++) {
            const double before = j > 0 ? cpsi_element_length(line, j - 1) : 0,
                         after = j < line->element_count ? cpsi_element_length(line, j) : 0;
            at += before;
            const double factor =
                cpsi_zone_factor(line, &first, at - 0.5 * before, 0.5 * (before + after));
            const CpsObstacle *nearest = NULL;
            double gap = INFINITY;
            for (int k = 0; k < scene->obstacle_count; k++) {
                const CpsiObstacle obstacle = cpsi_obstacle(&scene->obstacle[k]);
                const double distance = cpsi_obstacle_gap(&obstacle, vec3_at(start->point, j));
                if (distance < gap) {
                    gap = distance;
                    nearest = &scene->obstacle[k];
                }
            }
            if (!(force[j] > NOTHING * largest)) continue;
            /* a node below the obstacle is refused elsewhere, unless contact is that of the
             * reference, where it may be there and has no reaction */
            const bool near = gap <= TOUCH * line->length &&
                              (scene->contact_policy == CPS_CONTACT_POLICY_REACHED ||
                               gap >= -TOUCH * line->length);
            if (!nearest || !near)
                return cpsi_fail(err, CPS_ERR_ARGUMENT,
                                 "line '%s': start: the %s of node %d is %g N, but it touches no "
                                 "obstacle, expected 0",
                                 line->name, what, j, force[j]);
            if (start->friction_bound && !(factor * coefficient(nearest) > 0))
                return cpsi_fail(
                    err, CPS_ERR_ARGUMENT,
                    "line '%s': start: the %s of node %d is %g N, but obstacle '%s' has "
                    "no friction there, expected 0",
                    line->name, what, j, force[j], nearest->name);
        }
    }
    return CPS_OK;
}

CpsStatus cpsi_node_start_check(const CpsScene *scene, const CpsLine *line, CpsError *err) {
    const CpsStart *start = &line->start;
    if (!start->point || start->point_count != line->element_count + 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': start has %d nodes, expected %d: one more than elements",
                         line->name, start->point ? start->point_count : 0,
                         line->element_count + 1);
    for (int i = 0; i < 3 * start->point_count; i++)
        if (!cpsi_is_usable(start->point[i]))
            return cpsi_fail(
                err, CPS_ERR_ARGUMENT,
                "line '%s': start: a coordinate of node %d is %g m, expected a finite number",
                line->name, i / 3, start->point[i]);
    if (start->reaction && start->friction_bound)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "line '%s': start: found reactions and friction bounds, expected one of them: A = mu R",
            line->name);
    CpsStatus status = check_lengths(line, err);
    if (status == CPS_OK)
        status =
            check_forces(line, start->tension, line->element_count, "tension", "of element", err);
    if (status == CPS_OK)
        status =
            check_forces(line, start->reaction, start->point_count, "reaction", "at node", err);
    if (status == CPS_OK)
        status = check_forces(line, start->friction_bound, start->point_count, "friction bound",
                              "at node", err);
    return status == CPS_OK ? check_touch(scene, line, err) : status;
}

/* ---- the line ---- */

/* The force T_R t of element e. */
static Vec3 force_of(const CpsiLine *line, const CpsLine *def, int e) {
    const Vec3 dx = vec3_sub(vec3_at(line->position, e + 1), vec3_at(line->position, e));
    const double size = vec3_norm(dx), strain = size / line->element_length[e] - 1;
    const CpsiElementLaw law = cpsi_line_law(line, e);
    const double elastic =
        law.compliance > 0 && strain > 0
            ? (law.count > 0 ? cpsi_law_tension(&law, strain) : strain / law.compliance)
            : 0;
    const double tension = def->start.tension ? def->start.tension[e] : elastic;
    return size > 0 ? vec3_scale(tension / size, dx) : vec3(0, 0, 0);
}

/* The reaction that balances the loads and the line's forces on node j along the normal. */
static double balance(const CpsiLine *line, const CpsLine *def, int j, Vec3 normal) {
    Vec3 sum = vec3_scale(cpsi_line_weight_length(line, j), vec3_load(line->weight));
    if (j > 0) sum = vec3_sub(sum, force_of(line, def, j - 1));
    if (j + 1 < line->n) sum = vec3_add(sum, force_of(line, def, j));
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_KIND_FREE && j == (end == CPS_END_A ? 0 : line->n - 1))
            sum = vec3_add(sum, vec3_load(line->end[end].value));
    return fmax(0, -vec3_dot(sum, normal));
}

void cpsi_node_start(CpsiLine *line, const CpsLine *def) {
    const CpsStart *start = &def->start;
    for (int e = 0; start->tension && e + 1 < line->n; e++) line->tension[e] = start->tension[e];
    for (int j = 0; j < line->n; j++) {
        const Vec3 x = vec3_at(line->position, j);
        double gap;
        const int on = cpsi_line_nearest(line, x, &gap);
        line->reaction[j] = 0;
        line->state[j] = CPS_NODE_STATE_FREE;
        const bool soft = on >= 0 && line->obstacle[on].stiffness > 0;
        if (!(fabs(gap) <= TOUCH * line->length || (soft && gap < 0))) continue;
        line->state[j] = CPS_NODE_STATE_STICK;
        if (line->has_local_axes) line->obstacle_index[j] = on;
        if (soft) {
            line->reaction[j] = line->obstacle[on].stiffness * line->bearing_width *
                                cpsi_line_share(line, j) * fmax(0, -gap);
        } else if (start->reaction) {
            line->reaction[j] = start->reaction[j];
        } else if (start->friction_bound) {
            const double friction = cpsi_line_friction_law(line, j).friction;
            line->reaction[j] = friction > 0 ? start->friction_bound[j] / friction : 0;
        } else {
            line->reaction[j] = balance(line, def, j, cpsi_obstacle_normal(&line->obstacle[on], x));
        }
    }
}
