/* SPDX-License-Identifier: BSD-3-Clause */
/* Detection of contacts (contact_detection.h): of a node with the two nearest obstacles and, where
 * three bear it, with a plane as the third; of an element with a round obstacle that it penetrates.
 * A contact that stays with its obstacle keeps its data. */
#include "cable/contact_detection.h"

#include <string.h>

/* A second contact is considered up to this distance, in radii of its obstacle. */
static const double SECOND_RANGE = 0.5;

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
    on[0] = on[1] = CPS_NO_OBSTACLE;
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

bool cpsi_contact_is_watched(const CpsiLine *line, int c, double gap) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!obstacle || cpsi_line_is_contact_held(line, c)) return false;
    if (cpsi_line_element(line, c) >= 0) return line->contact_everywhere;
    if (!line->contact_everywhere) return isfinite(line->gap[c]);
    if (c < line->n || !cpsi_obstacle_is_round(obstacle) || gap <= SECOND_RANGE * obstacle->radius)
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

Vec3 cpsi_contact_reference_normal(const CpsiLine *line, int k, int c) {
    return k < 0
               ? vec3(0, 0, 0)
               : cpsi_obstacle_normal(&line->obstacle[k],
                                      cpsi_obstacle_carry(&line->obstacle[k],
                                                          cpsi_line_place(line, line->reference, c),
                                                          &line->shift[k], 0));
}

/* The contact with obstacle k as it was among the `count` contacts `before`, or a new one, at
 * node j. */
static SavedContact contact_with(const CpsiLine *line, int j, int k, const SavedContact before[],
                                 int count) {
    SavedContact now = {.obstacle_index = k, .gap = INFINITY, .state = CPS_NODE_STATE_FREE};
    vec3_store(now.normal, cpsi_contact_reference_normal(line, k, j));
    for (int i = 0; i < count; i++)
        if (before[i].obstacle_index == k && k >= 0) now = before[i];
    return now;
}

/* The plane with which node j has a third contact beside the obstacles `on`, -1: none. It is one
 * that the node would leave without a contact although it was active, or lies below. Third contacts
 * are with planes: if the obstacle left out is round, it takes the place of a plane in `on`. */
static int third_obstacle(const CpsiLine *line, int j, const SavedContact before[3], int on[2]) {
    const Vec3 x = vec3_at(line->base, j);
    int left_out = -1;
    double least = 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        bool active = false;
        for (int i = 0; i < 3; i++) active |= before[i].active && before[i].obstacle_index == k;
        const double gap = cpsi_obstacle_gap(&line->obstacle[k], x);
        if (k == on[0] || k == on[1] || !(active || gap < -0.1 * CPS_TOUCH * line->length) ||
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
    return CPS_NO_OBSTACLE;
}

/* Detect the contacts of node j at its base; those with the same obstacle as before keep their
 * data. */
static void detect(CpsiLine *line, int j, bool keep_active) {
    const int n = line->n, third = third_contact(line, j);
    const bool had_third = third >= 0 && cpsi_line_is_third(line, third);
    SavedContact before[3] = {{.obstacle_index = CPS_NO_OBSTACLE},
                              {.obstacle_index = CPS_NO_OBSTACLE},
                              {.obstacle_index = CPS_NO_OBSTACLE}};
    int on[2], plane = -1;
    nearest(line, j, vec3_at(line->base, j), keep_active, on);
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

bool cpsi_contact_clearance(const CpsiLine *line, const double *x, int e, int k, double *share,
                            double *gap) {
    const Vec3 a = vec3_at(x, e), b = vec3_at(x, e + 1);
    if (!cpsi_obstacle_faces(&line->obstacle[k], a, b, share)) return false;
    *gap = cpsi_obstacle_gap(&line->obstacle[k], vec3_axpy(*share, vec3_sub(b, a), a)) +
           cpsi_obstacle_allowance(&line->obstacle[k], line->natural_length[e]);
    return true;
}

/* Detect the contact of element e at its base: with the obstacle that it penetrates, else with the
 * one it had, as long as that is near. A contact on which frozen friction acts is kept, if need be
 * at the point where the element last faced the obstacle. */
static void detect_element(CpsiLine *line, int e) {
    const int c = cpsi_line_contacts(line) + e;
    SavedContact now = {.obstacle_index = CPS_NO_OBSTACLE,
                        .gap = INFINITY,
                        .state = CPS_NODE_STATE_FREE};
    const SavedContact before = save_contact(line, c);
    double least = INFINITY;
    if (is_kept(line, c)) return;
    for (int k = 0; k < line->obstacle_count; k++) {
        double share, gap;
        if (!cpsi_contact_clearance(line, line->base, e, k, &share, &gap)) continue;
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

void cpsi_contact_detect(CpsiLine *line, bool keep_active) {
    for (int j = 0; j < line->n; j++) detect(line, j, keep_active);
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++)
            if (!(keep_active && line->active[cpsi_line_contacts(line) + e]))
                detect_element(line, e);
}
