/* SPDX-License-Identifier: BSD-3-Clause */
/* Contact seen from the nodes (contact.h).
 *
 * The step problem is written on the tangent plane of each node's contact, in axes at the node's
 * place `base`. On one plane with isotropic friction nothing changes from place to place, the axes
 * are the line's own and base is the reference. Elsewhere the normal, the tangent along the line
 * and the way already slid are those of `base`, and rounds move base until it is where the solution
 * is (line_step.c).
 *
 * The way slid is that of the node on the surface since the reference, the reference carried along
 * by an obstacle that turns. An element has a contact with a round obstacle once it has gone deeper
 * into it than its chord may, at the point that is nearest to the axis or centre; what is said of a
 * node's place holds for that point. A node that lands within the step counts its way from the foot
 * of its reference. It is the shorter way round, which is the one that was gone only if the node
 * went round the obstacle by no more than a quarter of a turn while that turned by no more than
 * another: the angle that it went is counted from round to round, so that a whole turn is not taken
 * for none. */
#include "cable/contact.h"

#include <string.h>

#include "cable/friction_law.h"
#include "cable/obstacle_side.h"
#include "chain/frame.h"

/* No node moves farther in one go than this, per distance from the axis or centre of a round
 * obstacle: its planes say no more. */
static const double LEAP = 0.5;
/* A second obstacle is looked for up to so many of its radii away. */
static const double NEAR = 0.5;
/* [rad] More than a quarter of a turn, and not rounding of a node that is carried along by just
 * that. */
static const double QUARTER_ROUNDING = 1e-6;
/* [rad] From here to half a turn rounding takes more than 1e-12 of a way's direction, which changes
 * sign there. */
static const double HALF_ROUND = 2 * CPSI_QUARTER - 1e-2;

/* Direction of the line at node j, by its neighbours. */
static Vec3 direction(const CpsiLine *line, const double *x, int j) {
    const int before = j > 0 ? j - 1 : 0, after = j + 1 < line->n ? j + 1 : j;
    return vec3_sub(vec3_load(&x[3 * after]), vec3_load(&x[3 * before]));
}

/* Does contact c stay with its obstacle through the step?  One that the reference touches, where
 * contact is not gained; one whose frozen friction acts. */
static bool is_kept(const CpsiLine *line, int c) {
    if (line->on[c] < 0) return false;
    return line->gains ? line->frozen && line->friction_bound[c] > 0 : isfinite(line->gap[c]);
}

static bool keeps(const CpsiLine *line, int j, int k, bool pressed) {
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (line->on[c] == k && (is_kept(line, c) || (pressed && line->pressed[c]))) return true;
    return false;
}

/* The obstacles of node j at x, as many as it has contacts: those that it keeps and else the
 * nearest, the nearest first. */
static void nearest(const CpsiLine *line, int j, Vec3 x, bool pressed, int on[2]) {
    double gap[2] = {INFINITY, INFINITY};
    on[0] = on[1] = -1;
    for (int k = 0; k < line->obstacle_count; k++) {
        const double distance =
            keeps(line, j, k, pressed) ? -INFINITY : cpsi_obstacle_gap(&line->obstacle[k], x);
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

/* Is contact looked for where the node is `gap` away from the obstacle?  A second obstacle only as
 * far as its tangent plane tells where it is: from afar the plane of a round one shuts off what is
 * free. One that the contact keeps, always. */
static bool is_watched(const CpsiLine *line, int c, double gap) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!obstacle || cpsi_line_is_contact_held(line, c)) return false;
    if (cpsi_line_element(line, c) >= 0) return line->gains;
    if (!line->gains) return isfinite(line->gap[c]);
    if (c < line->n || obstacle->kind == CPS_OBSTACLE_PLANE || gap <= NEAR * obstacle->radius)
        return true;
    return line->has_local_axes && is_kept(line, c);
}

/* What a contact keeps of its obstacle from place to place. */
typedef struct Kept {
    int on;
    double reaction, bound, gap, round, force[3], normal[3];
    unsigned char state;
    bool pressed;
} Kept;

static Kept keep(const CpsiLine *line, int c) {
    Kept kept = {.on = line->on[c],
                 .reaction = line->reaction[c],
                 .bound = line->friction_bound[c],
                 .gap = line->gap[c],
                 .round = line->round[c],
                 .state = line->state[c],
                 .pressed = line->pressed[c]};
    memcpy(kept.force, &line->friction_force[3 * c], sizeof kept.force);
    memcpy(kept.normal, &line->normal[3 * c], sizeof kept.normal);
    return kept;
}

static void put(CpsiLine *line, int c, const Kept *kept) {
    line->on[c] = kept->on;
    line->reaction[c] = kept->reaction;
    line->friction_bound[c] = kept->bound;
    line->gap[c] = kept->gap;
    line->round[c] = kept->round;
    line->state[c] = kept->state;
    line->pressed[c] = kept->pressed;
    memcpy(&line->friction_force[3 * c], kept->force, sizeof kept->force);
    memcpy(&line->normal[3 * c], kept->normal, sizeof kept->normal);
}

/* Normal of obstacle k at the reference of contact c; 0 0 0 without an obstacle. */
static Vec3 reference_normal(const CpsiLine *line, int k, int c) {
    return k < 0 ? vec3(0, 0, 0)
                 : cpsi_obstacle_normal(&line->obstacle[k],
                                        cpsi_line_place(line, line->reference, c));
}

/* The contacts of node j at its base: those it had keep what they have. */
static void detect(CpsiLine *line, int j, bool pressed) {
    const int n = line->n;
    Kept before[2] = {{.on = -1}, {.on = -1}};
    int on[2];
    nearest(line, j, vec3_load(&line->base[3 * j]), pressed, on);
    for (int i = 0; i < line->contacts; i++) before[i] = keep(line, j + i * n);
    for (int i = 0; i < line->contacts; i++) {
        Kept now = {.on = on[i], .gap = INFINITY, .state = CPS_NODE_FREE};
        vec3_store(now.normal, reference_normal(line, on[i], j));
        for (int k = 0; k < line->contacts; k++)
            if (before[k].on == on[i] && on[i] >= 0) now = before[k];
        put(line, j + i * n, &now);
    }
}

/* What lies nearest of element e, placed at x, to an obstacle: its share of the way, and how far
 * that point is from where the element may be. False where it does not face the obstacle between
 * its nodes. */
static bool clearance(const CpsiLine *line, const double *x, int e, int k, double *share,
                      double *gap) {
    const Vec3 a = vec3_load(&x[3 * e]), b = vec3_load(&x[3 * (e + 1)]);
    if (!cpsi_obstacle_faces(&line->obstacle[k], a, b, share)) return false;
    *gap = cpsi_obstacle_gap(&line->obstacle[k], vec3_axpy(*share, vec3_sub(b, a), a)) +
           cpsi_obstacle_allowance(&line->obstacle[k], line->element_length[e]);
    return true;
}

/* The contact of element e at its base: with the obstacle that it has gone into, else with the one
 * it has had, as long as that is near. Frozen friction that acts stays, if it has to at the point
 * where the element last faced the obstacle. */
static void detect_element(CpsiLine *line, int e) {
    const int c = cpsi_line_contacts(line) + e;
    Kept now = {.on = -1, .gap = INFINITY, .state = CPS_NODE_FREE};
    const Kept before = keep(line, c);
    double least = INFINITY;
    if (is_kept(line, c)) return;
    for (int k = 0; k < line->obstacle_count; k++) {
        double share, gap;
        if (!clearance(line, line->base, e, k, &share, &gap)) continue;
        const bool had = k == before.on && gap <= NEAR * line->obstacle[k].radius;
        if (!(had || gap < 0) || !(gap < least)) continue;
        least = gap;
        line->beta[e] = share;
        if (had)
            now = before;
        else
            now = (Kept){.on = k, .gap = INFINITY, .state = CPS_NODE_FREE};
    }
    put(line, c, &now);
}

/* Direction of the line at contact c. */
static Vec3 direction_at(const CpsiLine *line, const double *x, int c) {
    const int e = cpsi_line_element(line, c);
    if (e < 0) return direction(line, x, cpsi_line_node(line, c));
    return vec3_sub(vec3_load(&x[3 * (e + 1)]), vec3_load(&x[3 * e]));
}

/* Axes and curvature of contact c at its base; without an obstacle those of the world. */
static void update_contact(CpsiLine *line, int c) {
    const Vec3 x = cpsi_line_place(line, line->base, c);
    double *axes = &line->axes[9 * c];
    if (line->on[c] >= 0) {
        cpsi_obstacle_axes(&line->obstacle[line->on[c]], x, direction_at(line, line->base, c), axes,
                           &line->curvature[3 * c]);
        memcpy(&line->normal[3 * c], &axes[6], 3 * sizeof *axes);
        return;
    }
    memcpy(axes, line->common, sizeof line->common);
    for (int a = 0; a < 3; a++) line->curvature[3 * c + a] = line->normal[3 * c + a] = 0;
}

/* The axes of frozen friction: those at the reference, whatever obstacle the contact has come to;
 * of an element at the point that was nearest then. */
static void freeze(CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    double curvature[3], share, gap, *axes = &line->first_axes[9 * c];
    memcpy(axes, line->common, sizeof line->common);
    if (line->on[c] < 0) return;
    Vec3 x = cpsi_line_place(line, line->reference, c);
    if (e >= 0 && clearance(line, line->reference, e, line->on[c], &share, &gap)) {
        const Vec3 a = vec3_load(&line->reference[3 * e]),
                   b = vec3_load(&line->reference[3 * (e + 1)]);
        x = vec3_axpy(share, vec3_sub(b, a), a);
    }
    cpsi_obstacle_axes(&line->obstacle[line->on[c]], x, direction_at(line, line->reference, c),
                       axes, curvature);
}

/* The reference of the node on the obstacle of contact c, carried along as it turns. */
static Vec3 carried_along(const CpsiLine *line, int c) {
    const Vec3 x = cpsi_line_place(line, line->reference, c);
    const int k = line->on[c];
    return k < 0 ? x : cpsi_obstacle_turn(&line->obstacle[k], x, line->turn[k]);
}

/* The part of the node's way to x, from where the obstacle of contact c has carried its reference,
 * in the plane of friction. */
static Vec3 plane_slip(const CpsiLine *line, int c, Vec3 x) {
    const Vec3 u = vec3_sub(x, carried_along(line, c));
    if (line->on[c] < 0) return u;
    const Vec3 n = vec3_load(&cpsi_line_axes(line, c)[6]);
    return vec3_axpy(-vec3_dot(u, n), n, u);
}

/* [m] How deep what touches at contact c may lie in the obstacle: of an element, what its chord
 * cuts in. */
static double allowance(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? 0
                 : cpsi_obstacle_allowance(&line->obstacle[line->on[c]], line->element_length[e]);
}

Vec3 cpsi_contact_slip_between(const CpsiLine *line, int c, Vec3 from, Vec3 to) {
    CpsiObstacle touched = line->obstacle[line->on[c]];
    if (touched.kind == CPS_OBSTACLE_PLANE) return cpsi_obstacle_slip(&touched, from, to);
    touched.radius -= allowance(line, c);
    return cpsi_obstacle_slip(&touched, from, to);
}

/* The way of the node on the obstacle of contact c, at x: along the surface, or in the plane of
 * friction where that is frozen. */
static Vec3 slip_to(const CpsiLine *line, int c, Vec3 x) {
    if (line->frozen) return plane_slip(line, c, x);
    return line->on[c] < 0 ? vec3(0, 0, 0)
                           : cpsi_contact_slip_between(line, c, carried_along(line, c), x);
}

void cpsi_contact_clear(CpsiLine *line, int c) {
    line->reaction[c] = line->friction_bound[c] = 0;
    for (int a = 0; a < 3; a++) line->friction_force[3 * c + a] = 0;
}

void cpsi_contact_detect(CpsiLine *line, bool pressed) {
    for (int j = 0; j < line->n; j++) detect(line, j, pressed);
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++)
            if (!(pressed && line->pressed[cpsi_line_contacts(line) + e])) detect_element(line, e);
}

/* What contact c has gone round its obstacle, where its normal was `before` at the last look; that
 * of an element as on a ball, for the point of the element changes from look to look. */
static void wind_round(CpsiLine *line, int c, Vec3 before) {
    const int k = line->on[c];
    if (k < 0) return;
    const CpsiObstacle *obstacle = &line->obstacle[k];
    const bool summed = obstacle->kind == CPS_OBSTACLE_CYLINDER && cpsi_line_element(line, c) < 0;
    const Vec3 from = summed ? before : reference_normal(line, k, c);
    const double angle = cpsi_obstacle_angle(obstacle, from, vec3_load(&line->normal[3 * c]));
    line->round[c] = summed ? line->round[c] + angle : angle;
    if (summed && fabs(angle) > CPSI_QUARTER)
        line->round[c] = INFINITY; /* too far in one round to tell which way */
}

void cpsi_contact_update_geometry(CpsiLine *line) {
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++) {
            const int on = line->on[cpsi_line_contacts(line) + e];
            double share, gap;
            if (on >= 0 && clearance(line, line->base, e, on, &share, &gap)) line->beta[e] = share;
        }
    cpsi_line_lay_out_friction(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const int k = line->on[c];
        const Vec3 before = vec3_load(&line->normal[3 * c]);
        update_contact(line, c);
        wind_round(line, c, before);
        if (line->frozen) freeze(line, c);
        const Vec3 x = cpsi_line_place(line, line->base, c), n = vec3_load(&line->normal[3 * c]);
        vec3_store(&line->slide[3 * c], slip_to(line, c, x));
        const Vec3 u = vec3_sub(x, cpsi_line_place(line, line->reference, c));
        const double gap =
            k < 0 ? INFINITY : cpsi_obstacle_gap(&line->obstacle[k], x) + allowance(line, c);
        line->gap[c] = is_watched(line, c, gap) ? gap - vec3_dot(n, u) : INFINITY;
        if (!isfinite(line->gap[c])) cpsi_contact_clear(line, c);
    }
}

/* Contact c at the reference: its friction bound, and its gap if it is watched. */
static void set_reference(CpsiLine *line, int c, bool frictionless) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const double gap =
        obstacle ? cpsi_obstacle_gap(obstacle, cpsi_line_place(line, line->reference, c)) +
                       allowance(line, c)
                 : INFINITY;
    const bool held = cpsi_line_is_contact_held(line, c);
    /* contact: everywhere, or only where the reference touches (S90 (35)): what is below it is
     * free */
    const bool near = fabs(gap) <= CPSI_TOUCH * line->length,
               touches = line->gains ? obstacle && line->state[c] != CPS_NODE_FREE : near;
    const bool rubs = touches && !held && !frictionless;
    line->friction_bound[c] = rubs ? line->friction_law[c].friction * line->reaction[c] : 0;
    line->gap[c] = !held && near ? 0 : INFINITY;
    if (is_watched(line, c, gap)) line->gap[c] = gap > 0 ? gap : 0;
    /* what is free has no reaction, but for what the loop left of it */
    if (!held && (!is_watched(line, c, gap) || line->state[c] == CPS_NODE_FREE))
        cpsi_contact_clear(line, c);
}

void cpsi_contact_reset(CpsiLine *line) {
    memcpy(line->base, line->reference, 3 * (size_t)line->n * sizeof *line->base);
    cpsi_contact_detect(line, false);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        update_contact(line, c);
        line->round[c] = 0;
    }
    cpsi_line_lay_out_friction(line);
}

void cpsi_contact_set_reference(CpsiLine *line, CpsContactPolicy contact,
                                CpsFrictionPolicy friction, bool frictionless) {
    const size_t n = (size_t)line->n;
    line->gains = contact == CPS_CONTACT_GAINED;
    line->frozen =
        line->has_local_axes && line->gains && friction == CPS_FRICTION_FROZEN && !frictionless;
    memcpy(line->reference, line->position, 3 * n * sizeof *line->reference);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        line->friction_bound[c] = 0;
        line->gap[c] = INFINITY;
    }
    for (int c = cpsi_line_contacts(line); c < cpsi_line_all_contacts(line); c++)
        if (line->state[c] == CPS_NODE_FREE) line->on[c] = -1; /* to be met again when it goes in */
    if (line->has_local_axes)
        cpsi_contact_reset(line);
    else
        cpsi_line_lay_out_friction(line);
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->frozen) freeze(line, c);
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
            vec3_store(&line->slide[3 * c], plane_slip(line, c, to));
            const int k = line->on[c];
            if (k < 0) continue;
            const Vec3 from = reference_normal(line, k, c),
                       there = cpsi_obstacle_normal(&line->obstacle[k], to);
            line->round[c] = cpsi_obstacle_angle(&line->obstacle[k], from, there);
        }
}

/* [rad] From where its obstacle has carried the reference to the node of contact c, the shorter way
 * round. */
static double apart(const CpsiLine *line, int c) {
    const CpsiObstacle *obstacle = &line->obstacle[line->on[c]];
    const Vec3 from = cpsi_obstacle_normal(obstacle, carried_along(line, c)),
               to = cpsi_line_place(line, line->position, c);
    return fabs(cpsi_obstacle_angle(obstacle, from, cpsi_obstacle_normal(obstacle, to)));
}

void cpsi_contact_clear_undetermined_slip(CpsiLine *line) {
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (line->on[c] < 0 || line->friction_bound[c] > 0) continue;
        if (apart(line, c) < HALF_ROUND) continue;
        for (int a = 0; a < 3; a++) line->slide[3 * c + a] = 0;
    }
}

bool cpsi_contact_turns_too_far(const CpsiLine *line) {
    if (line->has_local_axes)
        for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
            if (line->on[c] < 0 || !(line->friction_bound[c] > 0)) continue;
            /* it has left the surface, and its way is one in the plane of the reference */
            if (line->frozen && !(line->reaction[c] > 0)) continue;
            if (!(fabs(line->round[c]) <= CPSI_QUARTER + QUARTER_ROUNDING) ||
                !(apart(line, c) < HALF_ROUND))
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
        const double way = vec3_norm(vec3_sub(to, from)),
                     within = obstacle->radius + fmax(0, cpsi_obstacle_gap(obstacle, from));
        if (way * share > LEAP * within) share = LEAP * within / way;
    }
    if (sides) share = cpsi_obstacle_side_share(line, line->base, line->position, share);
    if (share < 1)
        for (int i = 0; i < 3 * line->n; i++)
            line->position[i] = line->base[i] + share * (line->position[i] - line->base[i]);
    return share;
}

/* Move node j along the obstacle that presses it most. */
static void move(CpsiLine *line, int j) {
    const Vec3 from = vec3_load(&line->base[3 * j]), to = vec3_load(&line->position[3 * j]);
    const int c =
        line->contacts > 1 && line->reaction[j + line->n] > line->reaction[j] ? j + line->n : j;
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    if (!obstacle || !line->pressed[c]) return;
    vec3_store(&line->position[3 * j], cpsi_obstacle_move(obstacle, from, vec3_sub(to, from)));
}

/* [m] The distance of node j from the obstacles that keep it out, INFINITY without any: all of
 * them, or with strict contact those of its contacts. */
static double room_of(const CpsiLine *line, int j) {
    const Vec3 to = vec3_load(&line->position[3 * j]);
    double least = INFINITY;
    if (line->gains) {
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
    for (int j = 0; j < line->n; j++) depth = fmax(depth, -room_of(line, j));
    return depth;
}

/* How far the axes of contact c turn from what they were to `now`: its normal, and where friction
 * is not frozen its tangent. An ellipse and a box are the same along a tangent and against it, as
 * where a slack line turns back. */
static double turn_of_axes(const CpsiLine *line, int c, const double now[9]) {
    const double *before = &line->axes[9 * c];
    const Vec3 tangent = vec3_load(&now[0]), from = vec3_load(&before[0]);
    const double normal = vec3_norm(vec3_sub(vec3_load(&now[6]), vec3_load(&before[6])));
    if (line->frozen) return normal;
    const double along = vec3_norm(vec3_sub(tangent, from)),
                 against = vec3_norm(vec3_axpy(1, tangent, from));
    return fmax(normal, line->friction_law[c].given ? along : fmin(along, against));
}

/* How far the axes of node j turn from its base to its position, the tangent's turn counting where
 * it matters: not where friction is frozen. INFINITY where it has gone through an obstacle: of
 * three that are equally near it rests on those that press. */
static double turn_of(const CpsiLine *line, int j) {
    const Vec3 to = vec3_load(&line->position[3 * j]);
    double turned = 0;
    if (room_of(line, j) < -0.1 * CPSI_TOUCH * line->length) return INFINITY;
    for (int i = 0; i < line->contacts; i++) {
        const int c = j + i * line->n;
        if (!line->pressed[c]) continue;
        double now[9], curvature[3];
        cpsi_obstacle_axes(&line->obstacle[line->on[c]], to, direction(line, line->position, j),
                           now, curvature);
        turned = fmax(turned, turn_of_axes(line, c, now));
    }
    return turned;
}

/* The same of the contact of element e, and how far its place on the element moves. INFINITY where
 * it does not face its obstacle any more. */
static double turn_of_element(const CpsiLine *line, int e) {
    const int c = cpsi_line_contacts(line) + e, k = line->on[c];
    double share, gap, now[9], curvature[3];
    if (!line->pressed[c] || k < 0) return 0;
    if (!clearance(line, line->position, e, k, &share, &gap)) return INFINITY;
    const Vec3 a = vec3_load(&line->position[3 * e]), along = direction_at(line, line->position, c);
    cpsi_obstacle_axes(&line->obstacle[k], vec3_axpy(share, along, a), along, now, curvature);
    double turned = fabs(share - line->beta[e]);
    return fmax(turned, turn_of_axes(line, c, now));
}

/* Is an element deeper in an obstacle than it may be?  Rounds do not end so. INFINITY where the
 * next round has to meet an obstacle first, else the angle [rad] that goes with the depth. */
static double turn_of_deepest(const CpsiLine *line) {
    double worst = 0;
    for (int e = 0; e + 1 < line->n; e++)
        for (int k = 0; k < line->obstacle_count; k++) {
            double share, gap;
            if (!clearance(line, line->position, e, k, &share, &gap) ||
                gap >= -0.1 * CPSI_TOUCH * line->length)
                continue;
            if (line->on[cpsi_line_contacts(line) + e] != k) return INFINITY;
            worst = fmax(worst, sqrt(-gap / line->obstacle[k].radius));
        }
    return worst;
}

double cpsi_contact_move_base(CpsiLine *line, bool sides) {
    /* where a surface bends away from a coarse line, its nodes go straight: the slide is looked up
     * anew after this */
    const size_t places = 3 * (size_t)line->n * sizeof *line->position;
    memcpy(line->slide, line->position, places);
    for (int j = 0; j < line->n; j++) move(line, j);
    if (sides && cpsi_obstacle_side_share(line, line->base, line->position, 1) < 1)
        memcpy(line->position, line->slide, places);
    double turned = line->gains && line->element_contacts > 0 ? turn_of_deepest(line) : 0;
    if (line->element_contacts > 0)
        for (int e = 0; e + 1 < line->n; e++) turned = fmax(turned, turn_of_element(line, e));
    for (int j = 0; j < line->n; j++) turned = fmax(turned, turn_of(line, j));
    memcpy(line->base, line->position, 3 * (size_t)line->n * sizeof *line->base);
    return turned;
}
