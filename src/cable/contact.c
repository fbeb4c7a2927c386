/* SPDX-License-Identifier: BSD-3-Clause */
/* Geometry of contacts (contact.h).
 *
 * The step problem is written on the tangent plane of each node's contact, in axes at the node's
 * position `base`. On one plane with isotropic friction the axes are the same everywhere: those of
 * the line, and the base is the reference. Otherwise the normal, the tangent along the line and the
 * slip so far are those at `base`, and rounds move the base until it is at the solution (rounds.c).
 *
 * The slip is that of the node on the surface since the reference, which an obstacle that turns
 * carries along. An element has a contact with a round obstacle once it has gone deeper into it
 * than its chord may, at the point nearest to the axis or centre; what is said of a node's position
 * holds for that point. The slip of a node that lands within the step counts from the foot of its
 * reference. The slip is the shorter path round the obstacle. That is the path taken only if the
 * node moved round the obstacle by no more than a quarter of a turn while the obstacle turned by no
 * more than another. The angle moved is summed from round to round, so that a whole turn is not
 * taken for none. */
#include "cable/contact.h"

#include <string.h>

#include "cable/contact_carry.h"
#include "cable/contact_detection.h"
#include "cable/contact_surface.h"
#include "cable/obstacle_side.h"
#include "cable/soft.h"
#include "cable/winch.h"
#include "chain/frame.h"

/* Largest displacement of a node in one round, per range of its tangent plane. */
static const double MAX_MOVE = 0.5;
/* [rad] Rounding of the angle of a node that is carried along by exactly a quarter of a turn. */
static const double QUARTER_ROUNDING = 1e-6;
/* [rad] From this angle to half a turn, where the direction of the slip changes sign, rounding
 * changes it by more than 1e-12. */
static const double HALF_ROUND = 2 * CPSI_QUARTER - 1e-2;
/* So near to the middle of a round obstacle, as a share of its radius, rounding turns the direction
 * out of it by a hundred times as much as at its surface. */
static const double MIDDLE = 1e-2;

/* Direction of the line at node j, by its neighbours. */
static Vec3 direction(const CpsiLine *line, const double *x, int j) {
    const int before = j > 0 ? j - 1 : 0, after = j + 1 < line->n ? j + 1 : j;
    return vec3_sub(vec3_at(x, after), vec3_at(x, before));
}

/* Direction of the line at contact c. */
static Vec3 direction_at(const CpsiLine *line, const double *x, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return direction(line, x, cpsi_line_node(line, c));
    return vec3_sub(vec3_at(x, e + 1), vec3_at(x, e));
}

/* Are the tangents of contact c kept? */
static bool keeps_tangents(const CpsiLine *line, int c) {
    return line->keeps_tangents &&
           cpsi_obstacle_is_isotropic(&line->obstacle[line->obstacle_index[c]]);
}

/* Axes and curvature of contact c at its base; without an obstacle the axes of the world. */
static void update_contact(CpsiLine *line, int c) {
    const Vec3 x = cpsi_line_place(line, line->base, c);
    double *axes = &line->axes[9 * c];
    if (line->obstacle_index[c] >= 0) {
        const double *along = keeps_tangents(line, c) ? line->reference : line->base;
        CpsiObstacle seen;
        cpsi_obstacle_axes(cpsi_contact_surface(line, c, &seen), x, direction_at(line, along, c),
                           axes, &line->curvature[3 * c]);
        memcpy(&line->normal[3 * c], &axes[6], 3 * sizeof *axes);
        return;
    }
    memcpy(axes, line->common_axes, sizeof line->common_axes);
    for (int a = 0; a < 3; a++) line->curvature[3 * c + a] = line->normal[3 * c + a] = 0;
}

/* The axes of frozen friction: those at the reference, for the present obstacle; of an element at
 * the point that was nearest to it there. */
static void set_reference_axes(CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    double curvature[3], share, gap, *axes = &line->reference_axes[9 * c];
    memcpy(axes, line->common_axes, sizeof line->common_axes);
    if (line->obstacle_index[c] < 0) return;
    Vec3 x = cpsi_line_place(line, line->reference, c);
    if (e >= 0 &&
        cpsi_contact_clearance(line, line->reference, e, line->obstacle_index[c], &share, &gap)) {
        const Vec3 a = vec3_at(line->reference, e), b = vec3_at(line->reference, e + 1);
        x = vec3_axpy(share, vec3_sub(b, a), a);
    }
    CpsiObstacle seen = *cpsi_line_obstacle(line, c);
    if (cpsi_contact_has_face(line, c))
        seen.face = cpsi_obstacle_face_towards(&seen, x, vec3_at(line->normal, c));
    cpsi_obstacle_axes(&seen, x, direction_at(line, line->reference, c), axes, curvature);
}

/* The reference position of contact c, carried along by its obstacle as that turns. */
static Vec3 carried_along(const CpsiLine *line, int c) {
    const int k = line->obstacle_index[c];
    return k < 0 ? cpsi_line_place(line, line->reference, c) : cpsi_contact_carry(line, k, c, true);
}

/* The displacement to x from the carried-along reference of contact c, projected onto the plane of
 * friction. */
static Vec3 plane_slip(const CpsiLine *line, int c, Vec3 x) {
    if (line->obstacle_index[c] < 0) return vec3(0, 0, 0);
    const Vec3 u = vec3_sub(x, carried_along(line, c));
    const Vec3 n = vec3_load(&cpsi_line_axes(line, c)[6]);
    return vec3_reject(u, n);
}

/* [m] Permitted penetration at contact c: 0 of a node, that of its chord of an element. */
static double allowance(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 || cpsi_line_is_third(line, c)
               ? 0
               : cpsi_obstacle_allowance(&line->obstacle[line->obstacle_index[c]],
                                         line->natural_length[e]);
}

Vec3 cpsi_contact_slip_between(const CpsiLine *line, int c, Vec3 from, Vec3 to) {
    CpsiObstacle seen;
    const CpsiObstacle *obstacle = cpsi_contact_surface(line, c, &seen);
    if (obstacle->kind == CPS_OBSTACLE_PLANE) return cpsi_obstacle_slip(obstacle, from, to);
    const double depth =
        obstacle->stiffness > 0 ? cpsi_soft_way_depth(obstacle, to) : allowance(line, c);
    const CpsiObstacle touched = cpsi_obstacle_within(obstacle, depth);
    return cpsi_obstacle_slip(&touched, from, to);
}

/* The slip of contact c at x: along the surface, or in the plane of friction where that is
 * frozen. */
static Vec3 slip_to(const CpsiLine *line, int c, Vec3 x) {
    if (line->keeps_reference_axes) return plane_slip(line, c, x);
    return line->obstacle_index[c] < 0
               ? vec3(0, 0, 0)
               : cpsi_contact_slip_between(line, c, carried_along(line, c), x);
}

bool cpsi_contact_holds_element(const CpsiLine *line) {
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++)
        if (line->reaction[c] > 0) return true;
    return false;
}

void cpsi_contact_clear(CpsiLine *line, int c) {
    line->reaction[c] = line->friction_bound[c] = 0;
    for (int a = 0; a < 3; a++) line->friction_force[3 * c + a] = 0;
}

/* The normal of the obstacle of contact c where a way from one point to another begins on it. */
static Vec3 first_normal(const CpsiLine *line, int c, Vec3 from, Vec3 to) {
    CpsiObstacle seen;
    const CpsiObstacle *obstacle = cpsi_contact_surface(line, c, &seen);
    return cpsi_contact_has_face(line, c) ? cpsi_obstacle_first_normal(obstacle, from, to)
                                          : cpsi_obstacle_normal(obstacle, from);
}

/* ... from the reference, shifted along, to the point `to`. */
static Vec3 reference_normal(const CpsiLine *line, int c, Vec3 to) {
    return first_normal(line, c, cpsi_contact_carry(line, line->obstacle_index[c], c, false), to);
}

/* Update the angle by which contact c has moved round its obstacle; its normal was `before` at the
 * last base. For an element, whose point of contact changes from base to base, it is the angle from
 * the reference, as on a ball; so it is in what gives, where the way from there is straight. */
static void update_winding(CpsiLine *line, int c, Vec3 before) {
    const int k = line->obstacle_index[c];
    if (k < 0) return;
    const CpsiObstacle *obstacle = &line->obstacle[k];
    const bool summed = obstacle->kind == CPS_OBSTACLE_CYLINDER && !(obstacle->stiffness > 0) &&
                        cpsi_obstacle_is_round(obstacle) && cpsi_line_element(line, c) < 0;
    const Vec3 from =
        summed ? before : reference_normal(line, c, cpsi_line_place(line, line->base, c));
    const double angle = cpsi_obstacle_angle(obstacle, from, vec3_at(line->normal, c));
    line->winding[c] = summed ? line->winding[c] + angle : angle;
    if (summed && fabs(angle) > CPSI_QUARTER)
        line->winding[c] = INFINITY; /* too far in one round for its direction to be known */
}

/* An element that no longer faces a shape, and bears nothing there, has no contact with it. */
static void leave_obstacle(CpsiLine *line, int c) {
    if (line->keeps_reference_axes || cpsi_line_is_third(line, c)) return;
    cpsi_contact_clear(line, c);
    line->obstacle_index[c] = CPS_NO_OBSTACLE;
}

void cpsi_contact_leave(CpsiLine *line) {
    for (int e = 0; e + 1 < line->n && line->element_contacts > 0; e++) {
        const int c = cpsi_line_contacts(line) + e, on = line->obstacle_index[c];
        double share, gap;
        if (on >= 0 && line->state[c] == CPS_NODE_STATE_FREE &&
            cpsi_obstacle_is_round(&line->obstacle[on]) && !(line->reaction[c] > 0) &&
            !cpsi_contact_clearance(line, line->position, e, on, &share, &gap))
            leave_obstacle(line, c);
    }
}

void cpsi_contact_update_geometry(CpsiLine *line) {
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++) {
            const int c = cpsi_line_contacts(line) + e, on = line->obstacle_index[c];
            double share, gap;
            if (on >= 0 && cpsi_contact_clearance(line, line->base, e, on, &share, &gap))
                line->beta[e] = share;
            else if (on >= 0 && !line->active[c] && cpsi_obstacle_is_rounded(&line->obstacle[on]))
                leave_obstacle(line, c);
            if (cpsi_line_is_third(line, cpsi_line_contacts(line) + e)) line->beta[e] = 1;
        }
    cpsi_line_lay_out_friction(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const int k = line->obstacle_index[c];
        const Vec3 before = vec3_at(line->normal, c);
        update_contact(line, c);
        update_winding(line, c, before);
        if (line->keeps_reference_axes) set_reference_axes(line, c);
        const Vec3 x = cpsi_line_place(line, line->base, c), n = vec3_at(line->normal, c);
        vec3_store(&line->slip[3 * c], slip_to(line, c, x));
        const Vec3 u = vec3_sub(x, cpsi_line_place(line, line->reference, c));
        CpsiObstacle seen;
        const double gap =
            k < 0 ? INFINITY
                  : cpsi_obstacle_gap(cpsi_contact_surface(line, c, &seen), x) + allowance(line, c);
        line->gap[c] = cpsi_contact_is_watched(line, c, gap) ? gap - vec3_dot(n, u) : INFINITY;
        if (!isfinite(line->gap[c])) cpsi_contact_clear(line, c);
    }
}

/* Contact c at the reference: its friction bound, and its gap if it enters the program. */
static void set_reference(CpsiLine *line, int c, bool frictionless) {
    if (c < cpsi_line_contacts(line) &&
        (cpsi_line_grasp_holds(line, cpsi_line_node(line, c)) ||
         cpsi_line_is_node_on_drum(line, cpsi_line_node(line, c)))) {
        /* what holds a node between the ends, or has it on a drum, bears all that the obstacle did
         */
        cpsi_contact_clear(line, c);
        line->state[c] = CPS_NODE_STATE_FREE;
        line->gap[c] = INFINITY;
        return;
    }
    CpsiObstacle seen;
    const CpsiObstacle *obstacle = cpsi_contact_surface(line, c, &seen);
    const Vec3 x = cpsi_line_place(line, line->reference, c);
    double gap = obstacle ? cpsi_obstacle_gap(obstacle, x) + allowance(line, c) : INFINITY;
    /* [m] by which the obstacle has come nearer since */
    double nearer = 0;
    if (obstacle &&
        cpsi_line_is_shifted(line, line->has_local_axes ? line->obstacle_index[c] : 0)) {
        nearer = cpsi_obstacle_gap(obstacle, carried_along(line, c)) + allowance(line, c) - gap;
        gap += nearer;
    }
    const bool held = cpsi_line_is_contact_held(line, c);
    /* contact everywhere, or only where the reference touches (S90 (35)): nodes below the surface
     * are then free */
    const bool near = fabs(gap) <= CPSI_TOUCH * line->length,
               touches = line->contact_everywhere
                             ? obstacle && line->state[c] != CPS_NODE_STATE_FREE
                             : near;
    const bool has_friction = touches && !held && !frictionless;
    line->friction_bound[c] = has_friction ? line->friction_law[c].friction * line->reaction[c] : 0;
    line->gap[c] = !held && near ? 0 : INFINITY;
    if (cpsi_contact_is_watched(line, c, gap))
        line->gap[c] = gap > 0 || line->inertia.is_moving || obstacle->stiffness > 0 ? gap : 0;
    line->gap[c] -= nearer;
    /* a free contact has no reaction; remove what the loop left of it */
    if (!held && (!cpsi_contact_is_watched(line, c, gap) || line->state[c] == CPS_NODE_STATE_FREE))
        cpsi_contact_clear(line, c);
}

void cpsi_contact_reset(CpsiLine *line) {
    memcpy(line->base, line->reference, 3 * (size_t)line->n * sizeof *line->base);
    /* contacts go on at the faces that their normals tell */
    for (int c = 0; c < cpsi_line_all_contacts(line) && line->has_folds; c++)
        line->face[c] = CPSI_NO_FACE;
    cpsi_contact_detect(line, false);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        update_contact(line, c);
        line->winding[c] = 0;
    }
    cpsi_line_lay_out_friction(line);
}

void cpsi_contact_set_reference(CpsiLine *line, CpsContactPolicy contact,
                                CpsFrictionPolicy friction_policy, bool frictionless) {
    const size_t n = (size_t)line->n;
    line->keeps_tangents = false;
    line->contact_everywhere = contact == CPS_CONTACT_POLICY_REACHED;
    line->keeps_reference_axes = line->has_local_axes && line->contact_everywhere &&
                                 friction_policy == CPS_FRICTION_POLICY_FROZEN && !frictionless;
    memcpy(line->reference, line->position, 3 * n * sizeof *line->reference);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        line->friction_bound[c] = 0;
        line->gap[c] = INFINITY;
    }
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++)
        if (line->state[c] == CPS_NODE_STATE_FREE)
            line->obstacle_index[c] =
                CPS_NO_OBSTACLE; /* detected again when the element penetrates an obstacle */
    if (line->has_local_axes)
        cpsi_contact_reset(line);
    else
        cpsi_line_lay_out_friction(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->keeps_reference_axes) set_reference_axes(line, c);
        if (!line->has_local_axes && line->obstacle_count > 0)
            vec3_store(&line->normal[3 * c], line->obstacle->frame.axis[2]);
        set_reference(line, c, frictionless);
    }
    cpsi_contact_plane_slip(line);
}

void cpsi_contact_plane_slip(CpsiLine *line) {
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            const Vec3 to = cpsi_line_place(line, line->position, c);
            vec3_store(&line->slip[3 * c], plane_slip(line, c, to));
            const int k = line->obstacle_index[c];
            if (k < 0) continue;
            CpsiObstacle seen;
            const Vec3 from = reference_normal(line, c, to),
                       there = cpsi_obstacle_normal(cpsi_contact_surface(line, c, &seen), to);
            line->winding[c] = cpsi_obstacle_angle(&line->obstacle[k], from, there);
        }
}

/* [rad] The angle from the carried-along reference to the position of contact c, on the shorter
 * path. */
static double angle_from_reference(const CpsiLine *line, int c) {
    CpsiObstacle seen;
    const CpsiObstacle *obstacle = cpsi_contact_surface(line, c, &seen);
    const Vec3 to = cpsi_line_place(line, line->position, c),
               from = first_normal(line, c, carried_along(line, c), to);
    return fabs(cpsi_obstacle_angle(obstacle, from, cpsi_obstacle_normal(obstacle, to)));
}

/* Does contact c come from the middle of a round obstacle, as a line may that is laid by statics?
 */
static bool comes_from_middle(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    return cpsi_obstacle_is_round(obstacle) &&
           cpsi_obstacle_gap(obstacle, carried_along(line, c)) <= (MIDDLE - 1) * obstacle->radius;
}

void cpsi_contact_clear_undetermined_slip(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->obstacle_index[c] < 0 || line->friction_bound[c] > 0) continue;
        if (angle_from_reference(line, c) < HALF_ROUND && !comes_from_middle(line, c)) continue;
        for (int a = 0; a < 3; a++) line->slip[3 * c + a] = 0;
    }
}

bool cpsi_contact_turns_too_far(const CpsiLine *line) {
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            const int k = line->obstacle_index[c];
            /* what gives may also be gone through */
            if (k < 0 || !(line->friction_bound[c] > 0 ||
                           (line->obstacle[k].stiffness > 0 && line->reaction[c] > 0)))
                continue;
            /* it has left the surface, and its slip is that in the plane of the reference */
            if (line->keeps_reference_axes && !(line->reaction[c] > 0)) continue;
            if (!(fabs(line->winding[c]) <= CPSI_QUARTER + QUARTER_ROUNDING) ||
                !(angle_from_reference(line, c) < HALF_ROUND))
                return true;
        }
    return false;
}

double cpsi_contact_shorten(CpsiLine *line, bool sides) {
    double share = 1;
    for (int c = 0; c < cpsi_line_contacts(line); c++) {
        const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
        if (!obstacle || obstacle->kind == CPS_OBSTACLE_PLANE) continue;
        const int j = cpsi_line_node(line, c);
        const Vec3 from = vec3_at(line->base, j), to = vec3_at(line->position, j);
        const double distance = vec3_norm(vec3_sub(to, from)),
                     within = cpsi_obstacle_range(obstacle, from);
        if (distance * share > MAX_MOVE * within) share = MAX_MOVE * within / distance;
    }
    if (sides) share = cpsi_obstacle_side_share(line, line->base, line->position, share);
    if (share < 1)
        for (int i = 0; i < 3 * line->n; i++)
            line->position[i] = line->base[i] + share * (line->position[i] - line->base[i]);
    return share;
}

/* Move node j along the surface of the obstacle with the larger reaction. */
static void move_along_surface(CpsiLine *line, int j) {
    const Vec3 from = vec3_at(line->base, j), to = vec3_at(line->position, j);
    const int c =
        line->contacts > 1 && line->reaction[j + line->n] > line->reaction[j] ? j + line->n : j;
    CpsiObstacle seen;
    const CpsiObstacle *obstacle = cpsi_contact_surface(line, c, &seen);
    if (!obstacle || !line->active[c] || obstacle->stiffness > 0) return;
    vec3_store(&line->position[3 * j], cpsi_obstacle_move(obstacle, from, vec3_sub(to, from)));
}

/* [m] A node that is held may be so much deeper than others, and is where it is held. Scenes are
 * checked to this depth (evolve/places.h), twice of which is allowed here for rounding. */
static double held_depth(const CpsiLine *line) { return 2 * CPSI_TOUCH * line->length; }

/* [m] The distance of node j from the obstacles that it may not enter, INFINITY without any: all of
 * them, or with contact of the reference those of its contacts. */
static double node_clearance(const CpsiLine *line, int j) {
    const Vec3 to = vec3_at(line->position, j);
    double least = INFINITY;
    if (line->contact_everywhere) {
        cpsi_line_nearest_rigid(line, to, &least);
        least = fmin(least, cpsi_soft_missed(line, j));
    }
    for (int c = j; c < cpsi_line_contacts(line) && !line->contact_everywhere; c += line->n) {
        CpsiObstacle seen;
        if (isfinite(line->gap[c]))
            least = fmin(least, cpsi_obstacle_gap(cpsi_contact_surface(line, c, &seen), to));
    }
    return least < 0 && least >= -held_depth(line) && cpsi_line_is_held(line, j) ? 0 : least;
}

double cpsi_contact_depth(const CpsiLine *line) {
    double depth = 0;
    for (int j = 0; j < line->n; j++) depth = fmax(depth, -node_clearance(line, j));
    return depth;
}

/* How far the axes of contact c turn from the base to `now`: its normal, and where friction is not
 * frozen its tangent. An ellipse and a box do not depend on the sign of the tangent, which changes
 * where a slack line turns back. */
static double turn_of_axes(const CpsiLine *line, int c, const double now[9]) {
    const double *before = &line->axes[9 * c];
    const Vec3 tangent = vec3_load(&now[0]), from = vec3_load(&before[0]);
    const double normal = vec3_norm(vec3_sub(vec3_load(&now[6]), vec3_load(&before[6])));
    if (line->keeps_reference_axes || keeps_tangents(line, c)) return normal;
    const double along = vec3_norm(vec3_sub(tangent, from)),
                 against = vec3_norm(vec3_axpy(1, tangent, from));
    return fmax(normal, line->friction_law[c].given ? along : fmin(along, against));
}

bool cpsi_contact_bears_beyond(const CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line) && line->has_folds; c++)
        if ((line->reaction[c] > 0 || line->friction_bound[c] > 0) &&
            cpsi_contact_is_beyond(line, c, cpsi_line_place(line, line->position, c)))
            return true;
    return false;
}

/* How far the axes of node j turn from its base to its position. INFINITY where it has penetrated
 * an obstacle: of three equally near obstacles only two are its contacts; or has gone over a fold
 * from what bears it. */
static double axes_turn_of_node(const CpsiLine *line, int j) {
    const Vec3 to = vec3_at(line->position, j);
    double turned = 0;
    if (node_clearance(line, j) < -0.1 * CPSI_TOUCH * line->length) return INFINITY;
    for (int i = 0; i < line->contacts; i++) {
        const int c = j + i * line->n;
        if (!line->active[c]) continue;
        if (cpsi_contact_is_beyond(line, c, to)) return INFINITY;
        double now[9], curvature[3];
        CpsiObstacle seen;
        cpsi_obstacle_axes(cpsi_contact_surface(line, c, &seen), to,
                           direction(line, line->position, j), now, curvature);
        turned = fmax(turned, turn_of_axes(line, c, now));
    }
    return turned;
}

/* The same for the contact of element e, with the change of its place on the element. INFINITY
 * where the element no longer faces its obstacle. */
static double axes_turn_of_element(const CpsiLine *line, int e) {
    const int c = cpsi_line_contacts(line) + e, k = line->obstacle_index[c];
    double share, gap, now[9], curvature[3];
    if (!line->active[c] || k < 0) return 0;
    if (cpsi_line_is_third(line, c)) {
        const Vec3 to = vec3_at(line->position, e + 1);
        CpsiObstacle seen;
        if (!cpsi_contact_has_face(line, c)) return 0;
        if (cpsi_contact_is_beyond(line, c, to)) return INFINITY;
        cpsi_obstacle_axes(cpsi_contact_surface(line, c, &seen), to,
                           direction_at(line, line->position, c), now, curvature);
        return turn_of_axes(line, c, now);
    }
    if (!cpsi_contact_clearance(line, line->position, e, k, &share, &gap)) return INFINITY;
    const Vec3 a = vec3_at(line->position, e), along = direction_at(line, line->position, c);
    cpsi_obstacle_axes(&line->obstacle[k], vec3_axpy(share, along, a), along, now, curvature);
    double turned = fabs(share - line->beta[e]);
    return fmax(turned, turn_of_axes(line, c, now));
}

/* The angle [rad] that corresponds to the largest inadmissible penetration of an element, with
 * which rounds do not end; INFINITY where the obstacle is not yet the element's contact. */
static double penetration_turn(const CpsiLine *line) {
    double worst = 0;
    for (int e = 0; e + 1 < line->n; e++)
        for (int k = 0; k < line->obstacle_count; k++) {
            double share, gap;
            if (!cpsi_contact_clearance(line, line->position, e, k, &share, &gap) ||
                gap >= -0.1 * CPSI_TOUCH * line->length)
                continue;
            if (line->obstacle_index[cpsi_line_contacts(line) + e] != k) return INFINITY;
            worst = fmax(worst, sqrt(-gap / line->obstacle[k].radius));
        }
    return worst;
}

double cpsi_contact_move_base(CpsiLine *line, bool sides) {
    /* where nodes moved along the surface would pass an obstacle, they move straight; slip serves
     * as scratch memory here, it is computed anew afterwards */
    const size_t places = 3 * (size_t)line->n * sizeof *line->position;
    memcpy(line->slip, line->position, places);
    for (int j = 0; j < line->n; j++) move_along_surface(line, j);
    if (sides && cpsi_obstacle_side_share(line, line->base, line->position, 1) < 1)
        memcpy(line->position, line->slip, places);
    double turned =
        line->contact_everywhere && line->element_contacts > 0 ? penetration_turn(line) : 0;
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++) turned = fmax(turned, axes_turn_of_element(line, e));
    for (int j = 0; j < line->n; j++) turned = fmax(turned, axes_turn_of_node(line, j));
    memcpy(line->base, line->position, 3 * (size_t)line->n * sizeof *line->base);
    return turned;
}
