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

#include "cable/obstacle_side.h"
#include "chain/frame.h"

/* Largest displacement of a node in one round, per distance from the axis or centre of a round
 * obstacle: the range of its tangent plane. */
static const double MAX_MOVE = 0.5;
/* A second contact is considered up to this distance, in radii of its obstacle. */
static const double SECOND_RANGE = 0.5;
/* [rad] Rounding of the angle of a node that is carried along by exactly a quarter of a turn. */
static const double QUARTER_ROUNDING = 1e-6;
/* [rad] From this angle to half a turn, where the direction of the slip changes sign, rounding
 * changes it by more than 1e-12. */
static const double HALF_ROUND = 2 * CPSI_QUARTER - 1e-2;

/* Direction of the line at node j, by its neighbours. */
static Vec3 direction(const CpsiLine *line, const double *x, int j) {
    const int before = j > 0 ? j - 1 : 0, after = j + 1 < line->n ? j + 1 : j;
    return vec3_sub(vec3_load(&x[3 * after]), vec3_load(&x[3 * before]));
}

/* Does contact c stay with its obstacle through the step? So do contacts of the reference where
 * contact is that of the reference, and contacts on which frozen friction acts. */
static bool is_kept(const CpsiLine *line, int c) {
    if (line->obstacle_index[c] < 0) return false;
    return line->contact_everywhere ? line->keeps_reference_axes && line->friction_bound[c] > 0
                                    : isfinite(line->gap[c]);
}

static bool node_keeps(const CpsiLine *line, int j, int k, bool keep_active) {
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (line->obstacle_index[c] == k && (is_kept(line, c) || (keep_active && line->active[c])))
            return true;
    return false;
}

/* The third contact of node j: that of the element before it, where elements have contacts; -1:
 * none. */
static int third_contact(const CpsiLine *line, int j) {
    return line->element_contacts > 0 && j > 0 ? cpsi_line_contacts(line) + j - 1 : -1;
}

/* Is obstacle k that of a third contact of node j that stays with it? */
static bool third_keeps(const CpsiLine *line, int j, int k, bool keep_active) {
    const int c = third_contact(line, j);
    return c >= 0 && line->obstacle_index[c] == k && cpsi_line_is_third(line, c) &&
           (is_kept(line, c) || (keep_active && line->active[c]));
}

/* The first two obstacles of node j at x: those that it keeps, else the nearest, in the order of
 * distance. */
static void nearest(const CpsiLine *line, int j, Vec3 x, bool keep_active, int on[2]) {
    double gap[2] = {INFINITY, INFINITY};
    on[0] = on[1] = -1;
    for (int k = 0; k < line->obstacle_count; k++) {
        if (third_keeps(line, j, k, keep_active)) continue;
        const double distance = node_keeps(line, j, k, keep_active)
                                    ? -INFINITY
                                    : cpsi_obstacle_gap(&line->obstacle[k], x);
        const int place = distance < gap[0] ? 0 : distance < gap[1] ? 1 : 2;
        if (place == 0) {
            gap[1] = gap[0];
            on[1] = on[0];
        }
        if (place < 2) {
            gap[place] = distance;
            on[place] = k;
        }
    }
    if (isfinite(gap[0]) || on[1] < 0) return;
    const int first = on[0];
    if (cpsi_obstacle_gap(&line->obstacle[first], x) <=
        cpsi_obstacle_gap(&line->obstacle[on[1]], x))
        return;
    on[0] = on[1];
    on[1] = first;
}

/* Does contact c enter the program where its node is `gap` away from the obstacle? A second contact
 * does so only within the range of its tangent plane, for the plane of a round obstacle far away
 * would exclude free space. A contact that keeps its obstacle always does. */
static bool is_watched(const CpsiLine *line, int c, double gap) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!obstacle || cpsi_line_is_contact_held(line, c)) return false;
    if (cpsi_line_element(line, c) >= 0) return line->contact_everywhere;
    if (!line->contact_everywhere) return isfinite(line->gap[c]);
    if (c < line->n || obstacle->kind == CPS_OBSTACLE_PLANE ||
        gap <= SECOND_RANGE * obstacle->radius)
        return true;
    return line->has_local_axes && is_kept(line, c);
}

/* The data that a contact keeps while it stays with its obstacle. */
typedef struct SavedContact {
    int obstacle_index;
    double reaction, bound, gap, winding, force[3], normal[3];
    unsigned char state;
    bool active;
} SavedContact;

static SavedContact save_contact(const CpsiLine *line, int c) {
    SavedContact saved = {.obstacle_index = line->obstacle_index[c],
                          .reaction = line->reaction[c],
                          .bound = line->friction_bound[c],
                          .gap = line->gap[c],
                          .winding = line->winding[c],
                          .state = line->state[c],
                          .active = line->active[c]};
    memcpy(saved.force, &line->friction_force[3 * c], sizeof saved.force);
    memcpy(saved.normal, &line->normal[3 * c], sizeof saved.normal);
    return saved;
}

static void restore_contact(CpsiLine *line, int c, const SavedContact *saved) {
    line->obstacle_index[c] = saved->obstacle_index;
    line->reaction[c] = saved->reaction;
    line->friction_bound[c] = saved->bound;
    line->gap[c] = saved->gap;
    line->winding[c] = saved->winding;
    line->state[c] = saved->state;
    line->active[c] = saved->active;
    memcpy(&line->friction_force[3 * c], saved->force, sizeof saved->force);
    memcpy(&line->normal[3 * c], saved->normal, sizeof saved->normal);
}

/* Normal of obstacle k at the reference of contact c; 0 0 0 without an obstacle. */
static Vec3 reference_normal(const CpsiLine *line, int k, int c) {
    return k < 0 ? vec3(0, 0, 0)
                 : cpsi_obstacle_normal(&line->obstacle[k],
                                        cpsi_line_place(line, line->reference, c));
}

/* The contact with obstacle k as it was among the `count` contacts `before`, or a new one, at
 * node j. */
static SavedContact contact_with(const CpsiLine *line, int j, int k, const SavedContact before[],
                                 int count) {
    SavedContact now = {.obstacle_index = k, .gap = INFINITY, .state = CPS_NODE_STATE_FREE};
    vec3_store(now.normal, reference_normal(line, k, j));
    for (int i = 0; i < count; i++)
        if (before[i].obstacle_index == k && k >= 0) now = before[i];
    return now;
}

/* The plane with which node j has a third contact beside the obstacles `on`, -1: none. It is one
 * that the node would leave without a contact although it was active, or lies below. Third contacts
 * are with planes: if the obstacle left out is round, it takes the place of a plane in `on`. */
static int third_obstacle(const CpsiLine *line, int j, const SavedContact before[3], int on[2]) {
    const Vec3 x = vec3_load(&line->base[3 * j]);
    int left_out = -1;
    double least = 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        bool active = false;
        for (int i = 0; i < 3; i++) active |= before[i].active && before[i].obstacle_index == k;
        const double gap = cpsi_obstacle_gap(&line->obstacle[k], x);
        if (k == on[0] || k == on[1] || !(active || gap < -0.1 * CPSI_TOUCH * line->length) ||
            (left_out >= 0 && gap >= least))
            continue;
        left_out = k;
        least = gap;
    }
    if (left_out < 0 || line->obstacle[left_out].kind == CPS_OBSTACLE_PLANE) return left_out;
    for (int i = 2; i-- > 0;)
        if (on[i] >= 0 && line->obstacle[on[i]].kind == CPS_OBSTACLE_PLANE) {
            const int plane = on[i];
            on[i] = left_out;
            return plane;
        }
    return -1;
}

/* Detect the contacts of node j at its base; those with the same obstacle as before keep their
 * data. */
static void detect(CpsiLine *line, int j, bool keep_active) {
    const int n = line->n, third = third_contact(line, j);
    const bool had_third = third >= 0 && cpsi_line_is_third(line, third);
    SavedContact before[3] = {{.obstacle_index = -1},
                              {.obstacle_index = -1},
                              {.obstacle_index = -1}};
    int on[2], plane = -1;
    nearest(line, j, vec3_load(&line->base[3 * j]), keep_active, on);
    for (int i = 0; i < line->contacts; i++) before[i] = save_contact(line, j + i * n);
    if (had_third) before[2] = save_contact(line, third);
    if (had_third && third_keeps(line, j, before[2].obstacle_index, keep_active))
        plane = before[2].obstacle_index;
    else if (third >= 0 && line->obstacle_count > 2 && !cpsi_line_is_held(line, j) &&
             (had_third || line->obstacle_index[third] < 0))
        plane = third_obstacle(line, j, before, on);
    for (int i = 0; i < line->contacts; i++) {
        const SavedContact now = contact_with(line, j, on[i], before, 3);
        restore_contact(line, j + i * n, &now);
    }
    if (!had_third && plane < 0) return;
    const SavedContact now = contact_with(line, j, plane, before, 3);
    restore_contact(line, third, &now);
    line->beta[j - 1] = 1;
}

/* The point of element e, at positions x, that is nearest to obstacle k: its share of the element,
 * and its distance from the surface plus the allowance. False where that point is a node. */
static bool clearance(const CpsiLine *line, const double *x, int e, int k, double *share,
                      double *gap) {
    const Vec3 a = vec3_load(&x[3 * e]), b = vec3_load(&x[3 * (e + 1)]);
    if (!cpsi_obstacle_faces(&line->obstacle[k], a, b, share)) return false;
    *gap = cpsi_obstacle_gap(&line->obstacle[k], vec3_axpy(*share, vec3_sub(b, a), a)) +
           cpsi_obstacle_allowance(&line->obstacle[k], line->element_length[e]);
    return true;
}

/* Detect the contact of element e at its base: with the obstacle that it penetrates, else with the
 * one it had, as long as that is near. A contact on which frozen friction acts is kept, if need be
 * at the point where the element last faced the obstacle. */
static void detect_element(CpsiLine *line, int e) {
    const int c = cpsi_line_contacts(line) + e;
    SavedContact now = {.obstacle_index = -1, .gap = INFINITY, .state = CPS_NODE_STATE_FREE};
    const SavedContact before = save_contact(line, c);
    double least = INFINITY;
    if (is_kept(line, c)) return;
    for (int k = 0; k < line->obstacle_count; k++) {
        double share, gap;
        if (!clearance(line, line->base, e, k, &share, &gap)) continue;
        const bool had =
            k == before.obstacle_index && gap <= SECOND_RANGE * line->obstacle[k].radius;
        if (!(had || gap < 0) || !(gap < least)) continue;
        least = gap;
        line->beta[e] = share;
        if (had)
            now = before;
        else
            now =
                (SavedContact){.obstacle_index = k, .gap = INFINITY, .state = CPS_NODE_STATE_FREE};
    }
    if (now.obstacle_index < 0 && cpsi_line_is_third(line, c)) return;
    restore_contact(line, c, &now);
}

/* Direction of the line at contact c. */
static Vec3 direction_at(const CpsiLine *line, const double *x, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return direction(line, x, cpsi_line_node(line, c));
    return vec3_sub(vec3_load(&x[3 * (e + 1)]), vec3_load(&x[3 * e]));
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
        cpsi_obstacle_axes(&line->obstacle[line->obstacle_index[c]], x,
                           direction_at(line, along, c), axes, &line->curvature[3 * c]);
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
    if (e >= 0 && clearance(line, line->reference, e, line->obstacle_index[c], &share, &gap)) {
        const Vec3 a = vec3_load(&line->reference[3 * e]),
                   b = vec3_load(&line->reference[3 * (e + 1)]);
        x = vec3_axpy(share, vec3_sub(b, a), a);
    }
    cpsi_obstacle_axes(&line->obstacle[line->obstacle_index[c]], x,
                       direction_at(line, line->reference, c), axes, curvature);
}

/* The reference position of contact c, carried along by its obstacle as that turns. */
static Vec3 carried_along(const CpsiLine *line, int c) {
    const Vec3 x = cpsi_line_place(line, line->reference, c);
    const int k = line->obstacle_index[c];
    return k < 0 ? x : cpsi_obstacle_turn(&line->obstacle[k], x, line->turn[k]);
}

/* The displacement to x from the carried-along reference of contact c, projected onto the plane of
 * friction. */
static Vec3 plane_slip(const CpsiLine *line, int c, Vec3 x) {
    const Vec3 u = vec3_sub(x, carried_along(line, c));
    if (line->obstacle_index[c] < 0) return u;
    const Vec3 n = vec3_load(&cpsi_line_axes(line, c)[6]);
    return vec3_axpy(-vec3_dot(u, n), n, u);
}

/* [m] Permitted penetration at contact c: 0 of a node, that of its chord of an element. */
static double allowance(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 || cpsi_line_is_third(line, c)
               ? 0
               : cpsi_obstacle_allowance(&line->obstacle[line->obstacle_index[c]],
                                         line->element_length[e]);
}

Vec3 cpsi_contact_slip_between(const CpsiLine *line, int c, Vec3 from, Vec3 to) {
    CpsiObstacle touched = line->obstacle[line->obstacle_index[c]];
    if (touched.kind == CPS_OBSTACLE_PLANE) return cpsi_obstacle_slip(&touched, from, to);
    touched.radius -= allowance(line, c);
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

void cpsi_contact_clear(CpsiLine *line, int c) {
    line->reaction[c] = line->friction_bound[c] = 0;
    for (int a = 0; a < 3; a++) line->friction_force[3 * c + a] = 0;
}

void cpsi_contact_detect(CpsiLine *line, bool keep_active) {
    for (int j = 0; j < line->n; j++) detect(line, j, keep_active);
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++)
            if (!(keep_active && line->active[cpsi_line_contacts(line) + e]))
                detect_element(line, e);
}

/* Update the angle by which contact c has moved round its obstacle; its normal was `before` at the
 * last base. For an element, whose point of contact changes from base to base, it is the angle from
 * the reference, as on a ball. */
static void update_winding(CpsiLine *line, int c, Vec3 before) {
    const int k = line->obstacle_index[c];
    if (k < 0) return;
    const CpsiObstacle *obstacle = &line->obstacle[k];
    const bool summed = obstacle->kind == CPS_OBSTACLE_CYLINDER && cpsi_line_element(line, c) < 0;
    const Vec3 from = summed ? before : reference_normal(line, k, c);
    const double angle = cpsi_obstacle_angle(obstacle, from, vec3_load(&line->normal[3 * c]));
    line->winding[c] = summed ? line->winding[c] + angle : angle;
    if (summed && fabs(angle) > CPSI_QUARTER)
        line->winding[c] = INFINITY; /* too far in one round for its direction to be known */
}

void cpsi_contact_update_geometry(CpsiLine *line) {
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++) {
            const int on = line->obstacle_index[cpsi_line_contacts(line) + e];
            double share, gap;
            if (on >= 0 && clearance(line, line->base, e, on, &share, &gap)) line->beta[e] = share;
            if (cpsi_line_is_third(line, cpsi_line_contacts(line) + e)) line->beta[e] = 1;
        }
    cpsi_line_lay_out_friction(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const int k = line->obstacle_index[c];
        const Vec3 before = vec3_load(&line->normal[3 * c]);
        update_contact(line, c);
        update_winding(line, c, before);
        if (line->keeps_reference_axes) set_reference_axes(line, c);
        const Vec3 x = cpsi_line_place(line, line->base, c), n = vec3_load(&line->normal[3 * c]);
        vec3_store(&line->slip[3 * c], slip_to(line, c, x));
        const Vec3 u = vec3_sub(x, cpsi_line_place(line, line->reference, c));
        const double gap =
            k < 0 ? INFINITY : cpsi_obstacle_gap(&line->obstacle[k], x) + allowance(line, c);
        line->gap[c] = is_watched(line, c, gap) ? gap - vec3_dot(n, u) : INFINITY;
        if (!isfinite(line->gap[c])) cpsi_contact_clear(line, c);
    }
}

/* Contact c at the reference: its friction bound, and its gap if it enters the program. */
static void set_reference(CpsiLine *line, int c, bool frictionless) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const double gap =
        obstacle ? cpsi_obstacle_gap(obstacle, cpsi_line_place(line, line->reference, c)) +
                       allowance(line, c)
                 : INFINITY;
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
    if (is_watched(line, c, gap)) line->gap[c] = gap > 0 ? gap : 0;
    /* a free contact has no reaction; remove what the loop left of it */
    if (!held && (!is_watched(line, c, gap) || line->state[c] == CPS_NODE_STATE_FREE))
        cpsi_contact_clear(line, c);
}

void cpsi_contact_reset(CpsiLine *line) {
    memcpy(line->base, line->reference, 3 * (size_t)line->n * sizeof *line->base);
    cpsi_contact_detect(line, false);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        update_contact(line, c);
        line->winding[c] = 0;
    }
    cpsi_line_lay_out_friction(line);
}

void cpsi_contact_set_reference(CpsiLine *line, CpsContactPolicy contact,
                                CpsFrictionPolicy friction, bool frictionless) {
    const size_t n = (size_t)line->n;
    line->keeps_tangents = false;
    line->contact_everywhere = contact == CPS_CONTACT_POLICY_REACHED;
    line->keeps_reference_axes = line->has_local_axes && line->contact_everywhere &&
                                 friction == CPS_FRICTION_POLICY_FROZEN && !frictionless;
    memcpy(line->reference, line->position, 3 * n * sizeof *line->reference);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        line->friction_bound[c] = 0;
        line->gap[c] = INFINITY;
    }
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++)
        if (line->state[c] == CPS_NODE_STATE_FREE)
            line->obstacle_index[c] =
                -1; /* detected again when the element penetrates an obstacle */
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
            const Vec3 from = reference_normal(line, k, c),
                       there = cpsi_obstacle_normal(&line->obstacle[k], to);
            line->winding[c] = cpsi_obstacle_angle(&line->obstacle[k], from, there);
        }
}

/* [rad] The angle from the carried-along reference to the position of contact c, on the shorter
 * path. */
static double angle_from_reference(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = &line->obstacle[line->obstacle_index[c]];
    const Vec3 from = cpsi_obstacle_normal(obstacle, carried_along(line, c)),
               to = cpsi_line_place(line, line->position, c);
    return fabs(cpsi_obstacle_angle(obstacle, from, cpsi_obstacle_normal(obstacle, to)));
}

void cpsi_contact_clear_undetermined_slip(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->obstacle_index[c] < 0 || line->friction_bound[c] > 0) continue;
        if (angle_from_reference(line, c) < HALF_ROUND) continue;
        for (int a = 0; a < 3; a++) line->slip[3 * c + a] = 0;
    }
}

bool cpsi_contact_turns_too_far(const CpsiLine *line) {
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            if (line->obstacle_index[c] < 0 || !(line->friction_bound[c] > 0)) continue;
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
        const Vec3 from = vec3_load(&line->base[3 * j]), to = vec3_load(&line->position[3 * j]);
        const double distance = vec3_norm(vec3_sub(to, from)),
                     within = obstacle->radius + fmax(0, cpsi_obstacle_gap(obstacle, from));
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
    const Vec3 from = vec3_load(&line->base[3 * j]), to = vec3_load(&line->position[3 * j]);
    const int c =
        line->contacts > 1 && line->reaction[j + line->n] > line->reaction[j] ? j + line->n : j;
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!obstacle || !line->active[c]) return;
    vec3_store(&line->position[3 * j], cpsi_obstacle_move(obstacle, from, vec3_sub(to, from)));
}

/* [m] The distance of node j from the obstacles that it may not enter, INFINITY without any: all of
 * them, or with contact of the reference those of its contacts. */
static double node_clearance(const CpsiLine *line, int j) {
    const Vec3 to = vec3_load(&line->position[3 * j]);
    double least = INFINITY;
    if (line->contact_everywhere) {
        cpsi_line_nearest(line, to, &least);
        return least;
    }
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (isfinite(line->gap[c]))
            least = fmin(least, cpsi_obstacle_gap(cpsi_line_obstacle(line, c), to));
    return least;
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

/* How far the axes of node j turn from its base to its position. INFINITY where it has penetrated
 * an obstacle: of three equally near obstacles only two are its contacts. */
static double axes_turn_of_node(const CpsiLine *line, int j) {
    const Vec3 to = vec3_load(&line->position[3 * j]);
    double turned = 0;
    if (node_clearance(line, j) < -0.1 * CPSI_TOUCH * line->length) return INFINITY;
    for (int i = 0; i < line->contacts; i++) {
        const int c = j + i * line->n;
        if (!line->active[c]) continue;
        double now[9], curvature[3];
        cpsi_obstacle_axes(&line->obstacle[line->obstacle_index[c]], to,
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
    if (!line->active[c] || k < 0 || cpsi_line_is_third(line, c)) return 0;
    if (!clearance(line, line->position, e, k, &share, &gap)) return INFINITY;
    const Vec3 a = vec3_load(&line->position[3 * e]), along = direction_at(line, line->position, c);
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
            if (!clearance(line, line->position, e, k, &share, &gap) ||
                gap >= -0.1 * CPSI_TOUCH * line->length)
                continue;
            if (line->obstacle_index[cpsi_line_contacts(line) + e] != k) return INFINITY;
            worst = fmax(worst, sqrt(-gap / line->obstacle[k].radius));
        }
    return worst;
}

double cpsi_contact_move_base(CpsiLine *line, bool sides) {
    /* where nodes moved along the surface would pass an obstacle, they move straight; slide serves
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
