/* SPDX-License-Identifier: BSD-3-Clause */
/* Detection of contacts (contact_detection.h): of a node with the two nearest obstacles, or faces
 * beside a fold, and, where three bear it, with a plane or face as the third; of an element with a
 * round obstacle that it penetrates. A contact that stays with its obstacle keeps its data. */
#include "cable/contact_detection.h"

#include <string.h>

#include "cable/contact_carry.h"
#include "geometry/folds.h"

/* [-] Two normals whose product is this near to 1 are those of one foot. */
static const double ALIKE = 1e-14;
/* A second contact is considered up to this distance, in radii of its obstacle. */
static const double SECOND_RANGE = 0.5;

/* Does contact c stay with its obstacle through the step? So do contacts of the reference where
 * contact is that of the reference, and contacts on which frozen friction acts. */
static bool is_kept(const CpsiLine *line, int c) {
    if (line->obstacle_index[c] < 0) return false;
    return line->contact_everywhere ? line->keeps_reference_axes && line->friction_bound[c] > 0
                                    : isfinite(line->gap[c]);
}

/* The third contact of node j: that of the element before it, where elements have contacts; -1:
 * none. */
static int third_contact(const CpsiLine *line, int j) {
    return line->element_contacts > 0 && j > 0 ? cpsi_line_contacts(line) + j - 1 : -1;
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
    int face;   /* with folds */
    bool keeps; /* it stays with its obstacle */
} SavedContact;

static SavedContact save_contact(const CpsiLine *line, int c, bool keep_active) {
    SavedContact saved = {.obstacle_index = line->obstacle_index[c],
                          .reaction = line->reaction[c],
                          .bound = line->friction_bound[c],
                          .gap = line->gap[c],
                          .winding = line->winding[c],
                          .state = line->state[c],
                          .active = line->active[c],
                          .face = CPSI_NO_FACE,
                          .keeps = is_kept(line, c) || (keep_active && line->active[c])};
    memcpy(saved.force, &line->friction_force[3 * c], sizeof saved.force);
    memcpy(saved.normal, &line->normal[3 * c], sizeof saved.normal);
    if (line->has_folds) saved.face = line->face[c];
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
    if (line->has_folds) line->face[c] = saved->face;
}

Vec3 cpsi_contact_reference_normal(const CpsiLine *line, int k, int c) {
    return k < 0 ? vec3(0, 0, 0)
                 : cpsi_obstacle_normal(&line->obstacle[k], cpsi_contact_carry(line, k, c, false));
}

/* What node j may touch: an obstacle, or one of its feet on an obstacle with folds. */
typedef struct Candidate {
    int obstacle;  /* CPS_NO_OBSTACLE: none */
    int before;    /* which of the contacts that the node had goes on here, -1: none */
    bool keeps;    /* ... and stays with its obstacle */
    bool active;   /* ... and has borne */
    double gap;    /* [m] */
    CpsiFoot foot; /* with folds, else with CPSI_NO_FACE */
} Candidate;

enum { MOST_CANDIDATES = CPSI_MOST_FEET + 3 };

/* The contacts that node j had: two, and perhaps a third. */
typedef struct Had {
    SavedContact contact[3];
} Had;

static void continue_as(Candidate *candidate, const Had *had, int i) {
    candidate->before = i;
    candidate->keeps = had->contact[i].keeps;
    candidate->active = had->contact[i].active;
}

/* Obstacle k, which has no folds. */
static Candidate plain_candidate(const CpsiLine *line, int k, Vec3 x, const Had *had) {
    Candidate out = {.obstacle = k,
                     .before = -1,
                     .gap = cpsi_obstacle_gap(&line->obstacle[k], x),
                     .foot.face = CPSI_NO_FACE};
    for (int i = 0; i < 3; i++)
        if (had->contact[i].obstacle_index == k) continue_as(&out, had, i);
    return out;
}

/* Which of the candidates has the normal nearest to n, no farther than `least` says; -1: none. With
 * `all` also those at which another contact goes on. */
static int nearest_to(const Candidate *of, int count, Vec3 n, double least, bool all) {
    int best = -1;
    for (int i = 0; i < count; i++) {
        const double near = vec3_dot(of[i].foot.normal, n);
        if ((of[i].before >= 0 && !all) || !(near > least)) continue;
        least = near;
        best = i;
    }
    return best;
}

/* Let contact i go on, whose foot has moved with x. */
static int follow_foot(const CpsiObstacle *obstacle, Vec3 x, double touch, const Had *had, int i,
                       int count, Candidate out[MOST_CANDIDATES]) {
    const SavedContact *contact = &had->contact[i];
    CpsiObstacle seen = *obstacle;
    seen.face = contact->face;
    const CpsiFoot moved = cpsi_obstacle_foot(&seen, x);
    const int at = nearest_to(out, count, moved.normal, 1 - ALIKE, true);
    if (at >= 0 && out[at].before < 0) {
        continue_as(&out[at], had, i);
    } else if (at >= 0 && !contact->keeps) {
        /* two feet have become one */
    } else if (contact->keeps || (contact->active && (out[0].gap < -touch || moved.gap > touch))) {
        out[count] =
            (Candidate){.obstacle = contact->obstacle_index, .gap = moved.gap, .foot = moved};
        continue_as(&out[count++], had, i);
    }
    return count;
}

/* Let contact i go on, whose face is not known. */
static int place_by_normal(const Had *had, int i, int count, Candidate out[MOST_CANDIDATES]) {
    const SavedContact *contact = &had->contact[i];
    const Vec3 n = vec3_load(contact->normal);
    const int at = nearest_to(out, count, n, -INFINITY, false);
    if (at >= 0) {
        continue_as(&out[at], had, i);
    } else if (contact->keeps) {
        out[count] = out[nearest_to(out, count, n, -INFINITY, true)];
        continue_as(&out[count++], had, i);
    }
    return count;
}

/* The feet of x on obstacle k, which has folds. A contact goes on at the foot to which its own has
 * moved; where its face is not known, at that with the normal nearest to its own. One that has
 * borne in the round before goes on with the plane of its face where the node has gone over a fold;
 * not if it lies on that plane without being below another face, for then nothing is there that
 * bears it. Returns their number. */
static int folded_candidates(const CpsiLine *line, int k, Vec3 x, const Had *had,
                             Candidate out[MOST_CANDIDATES]) {
    const CpsiObstacle *obstacle = &line->obstacle[k];
    const double touch = 0.1 * CPS_TOUCH * line->length;
    CpsiFoot foot[CPSI_MOST_FEET];
    int count = cpsi_obstacle_feet(obstacle, x, foot);
    for (int i = 0; i < count; i++)
        out[i] = (Candidate){.obstacle = k, .before = -1, .gap = foot[i].gap, .foot = foot[i]};
    for (int pass = 0; pass < 2; pass++) /* first those that stay */
        for (int i = 0; i < 3; i++)
            if (had->contact[i].obstacle_index == k && had->contact[i].keeps == (pass == 0))
                count = had->contact[i].face == CPSI_NO_FACE
                            ? place_by_normal(had, i, count, out)
                            : follow_foot(obstacle, x, touch, had, i, count, out);
    return count;
}

/* The candidates on obstacle k; returns their number. */
static int candidates_on(const CpsiLine *line, int k, Vec3 x, const Had *had,
                         Candidate out[MOST_CANDIDATES]) {
    if (line->has_folds && cpsi_obstacle_has_folds(&line->obstacle[k]))
        return folded_candidates(line, k, x, had, out);
    out[0] = plain_candidate(line, k, x, had);
    return 1;
}

/* What stays with its obstacle comes first, then what is nearer; what has borne beside a fold is as
 * near as what the node lies on. */
static double rank(const Candidate *of) {
    if (of->keeps) return -INFINITY;
    return of->active && of->foot.face != CPSI_NO_FACE ? fmin(of->gap, 0) : of->gap;
}

/* Keep the two of lowest rank. */
static void keep_nearest(Candidate on[2], const Candidate *now) {
    const bool first = on[0].obstacle < 0 || rank(now) < rank(&on[0]);
    if (!first && on[1].obstacle >= 0 && !(rank(now) < rank(&on[1]))) return;
    if (first) on[1] = on[0];
    on[first ? 0 : 1] = *now;
}

/* Would the node be without a contact that it needs? It is one that was active, or that it lies
 * below. */
static bool is_needed(const CpsiLine *line, const Candidate *of) {
    return of->active || of->gap < -0.1 * CPS_TOUCH * line->length;
}

static bool is_same(const Candidate *a, const Candidate *b) {
    return a->obstacle == b->obstacle && a->foot.face == b->foot.face && a->before == b->before;
}

/* The first two contacts of a node at x: those that stay, else the nearest, in the order of
 * distance; not the third if that stays, which is then *third. Returns how many others are
 * needed. */
static int find_nearest(const CpsiLine *line, Vec3 x, const Had *had, Candidate on[2],
                        Candidate *third) {
    Candidate some[MOST_CANDIDATES];
    int needed = 0;
    for (int k = 0; k < line->obstacle_count; k++) {
        const int count = candidates_on(line, k, x, had, some);
        for (int i = 0; i < count; i++) {
            if (some[i].before == 2 && some[i].keeps) {
                *third = some[i];
                continue;
            }
            needed += is_needed(line, &some[i]);
            keep_nearest(on, &some[i]);
        }
    }
    for (int i = 0; i < 2; i++) needed -= on[i].obstacle >= 0 && is_needed(line, &on[i]);
    if (on[1].obstacle >= 0 && !(on[0].gap <= on[1].gap)) {
        const Candidate first = on[0];
        on[0] = on[1];
        on[1] = first;
    }
    return needed;
}

/* Of the candidates that are needed beside `on`, the one with the least gap. */
static Candidate find_left_out(const CpsiLine *line, Vec3 x, const Had *had,
                               const Candidate on[2]) {
    Candidate some[MOST_CANDIDATES], out = {.obstacle = CPS_NO_OBSTACLE};
    for (int k = 0; k < line->obstacle_count; k++) {
        const int count = candidates_on(line, k, x, had, some);
        for (int i = 0; i < count; i++) {
            if (is_same(&some[i], &on[0]) || is_same(&some[i], &on[1]) ||
                !is_needed(line, &some[i]) || (out.obstacle >= 0 && some[i].gap >= out.gap))
                continue;
            out = some[i];
        }
    }
    return out;
}

static bool is_plane(const CpsiLine *line, const Candidate *of) {
    return of->obstacle >= 0 && line->obstacle[of->obstacle].kind == CPS_OBSTACLE_PLANE;
}

/* The third contact of a node beside `on`: with a plane or, else, with a mesh that has folds. If
 * what is left out is none, it takes the place of one in `on`. */
static Candidate find_third(const CpsiLine *line, Vec3 x, const Had *had, Candidate on[2]) {
    const Candidate left_out = find_left_out(line, x, had, on);
    if (left_out.obstacle < 0 || is_plane(line, &left_out)) return left_out;
    int place = -1;
    for (int i = 2; i-- > 0;)
        if (place < 0 && is_plane(line, &on[i])) place = i;
    if (place < 0 && left_out.foot.face != CPSI_NO_FACE) return left_out;
    for (int i = 2; i-- > 0;)
        if (place < 0 && on[i].obstacle >= 0 && on[i].foot.face != CPSI_NO_FACE) place = i;
    if (place < 0) return (Candidate){.obstacle = CPS_NO_OBSTACLE};
    const Candidate third = on[place];
    on[place] = left_out;
    return third;
}

/* Contact c of node j is the candidate from now on, with its data if it goes on. */
static void become(CpsiLine *line, int j, int c, const Candidate *now, const Had *had) {
    const bool goes_on = now->obstacle >= 0 && now->before >= 0,
               has_face = now->obstacle >= 0 && now->foot.face != CPSI_NO_FACE;
    SavedContact contact = {.obstacle_index = now->obstacle,
                            .gap = INFINITY,
                            .state = CPS_NODE_STATE_FREE};
    if (goes_on)
        contact = had->contact[now->before];
    else
        vec3_store(contact.normal, has_face
                                       ? now->foot.normal
                                       : cpsi_contact_reference_normal(line, now->obstacle, j));
    contact.face = has_face ? now->foot.face : CPSI_NO_FACE;
    restore_contact(line, c, &contact);
}

/* Detect the contacts of node j at its base; those with the same obstacle as before keep their
 * data. */
static void detect(CpsiLine *line, int j, bool keep_active) {
    static const SavedContact NONE = {.obstacle_index = CPS_NO_OBSTACLE};
    const int third = third_contact(line, j);
    const bool had_third = third >= 0 && cpsi_line_is_third(line, third);
    const Vec3 x = vec3_at(line->base, j);
    Had had = {{NONE, NONE, NONE}};
    Candidate on[2] = {{.obstacle = CPS_NO_OBSTACLE}, {.obstacle = CPS_NO_OBSTACLE}},
              other = {.obstacle = CPS_NO_OBSTACLE};
    for (int i = 0; i < line->contacts; i++)
        had.contact[i] = save_contact(line, j + i * line->n, keep_active);
    if (had_third) had.contact[2] = save_contact(line, third, keep_active);
    const int needed = find_nearest(line, x, &had, on, &other);
    if (other.obstacle < 0 && needed > 0 && third >= 0 && !cpsi_line_is_held(line, j) &&
        (had_third || line->obstacle_index[third] < 0))
        other = find_third(line, x, &had, on);
    for (int i = 0; i < line->contacts; i++) become(line, j, j + i * line->n, &on[i], &had);
    if (!had_third && other.obstacle < 0) return;
    become(line, j, third, &other, &had);
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
    const SavedContact before = save_contact(line, c, false);
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
