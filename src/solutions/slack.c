/* SPDX-License-Identifier: BSD-3-Clause */
/* The slack of a step and the nodes that hold it (see slack.h and capstan/solutions.h). */
#include "solutions/slack.h"

#include <math.h>

#include "base/larger.h"
#include "regularized/band_blocks.h"

/* an element is slack where its tension is below this share of the step's largest force: the
 * complementary variable, the slack, is then larger */
static const double SLACK_TENSION = 1e-5;

/* a friction force at most this share below its bound is at its bound: the accuracy of a step with
 * a certificate of 1e-8 */
static const double AT_BOUND = 1e-6;

/* a reaction below this share of the force counts as zero: a step leaves about 1e-13 at nodes with
 * a distance */
static const double NO_PUSH = 1e-11;

/* directions [rad] and cosines that differ by less are equal; a slip shorter than the second
 * number, per length, counts as zero */
static const double SAME = 1e-6, SLIP = 1e-9;

double cpsi_slack_force(const CpsLineView *step) {
    double most = 0, sum = 0;
    for (int i = 0; i < step->element_count; ++i) most = cpsi_max_nan(most, step->tension[i]);
    for (int j = 0; j <= step->element_count; ++j) sum += vec3_norm(vec3_at(step->load, j));
    return cpsi_max_nan(most, sum);
}

double cpsi_element_stretch(const CpsLineView *step, const double *position, int i) {
    return vec3_norm(vec3_sub(vec3_at(position, i + 1), vec3_at(position, i))) /
           step->element_length[i];
}

static bool is_slack(const CpsLineView *step, int element, double force) {
    return step->tension[element] <= SLACK_TENSION * force;
}

/* without friction, and without tension on either side; for an end: a free one */
static bool is_loose(const CpsLineView *step, int node, double force) {
    const int n = step->element_count;
    if (node == 0 || node == n) {
        const CpsEnd *end = &step->end[node == 0 ? CPS_END_A : CPS_END_B];
        if (end->kind == CPS_END_KIND_HELD) return false;
    }
    return (node == 0 || is_slack(step, node - 1, force)) &&
           (node == n || is_slack(step, node, force)) && !(step->friction_bound[node] > 0);
}

/* ---- pieces ---- */

/* the plane of the loose nodes of a piece, if there is one */
static void find_plane(const CpsLineView *step, double force, CpsiSlackPiece *piece) {
    const int from = piece->first + !piece->open[0], to = piece->last + piece->open[1];
    const Vec3 a = vec3_at(step->position, piece->first),
               b = vec3_at(step->position, piece->last + 1);
    piece->foot[0] = a;
    piece->foot[1] = b;
    for (int j = from; j <= to && !piece->grounded; ++j) {
        if (!(step->reaction[j] > NO_PUSH * force) || !isfinite(step->gap[j])) continue;
        piece->grounded = true;
        piece->normal = vec3_at(step->normal, j);
        const double level = vec3_dot(piece->normal, vec3_at(step->reference, j)) - step->gap[j];
        for (int side = 0; side < 2; ++side) {
            piece->height[side] = vec3_dot(piece->normal, piece->foot[side]) - level;
            piece->foot[side] = vec3_axpy(-piece->height[side], piece->normal, piece->foot[side]);
        }
    }
    if (piece->grounded) return;
    /* in the air without load: any plane through the chord; a level one across the chord unless
     * that is too near to the vertical */
    const Vec3 chord = vec3_sub(b, a), up = vec3_at(step->normal, from <= to ? from : piece->first);
    const Vec3 z = vec3_norm(up) > 0 ? up : vec3(0, 0, 1);
    Vec3 side = vec3_cross(z, chord);
    if (!(vec3_norm(side) > SAME * vec3_norm(chord))) side = vec3_cross(vec3(z.y, z.z, z.x), z);
    const Vec3 along = vec3_norm(chord) > 0 ? chord : vec3_cross(side, z);
    const Vec3 normal = vec3_cross(along, side);
    piece->normal = vec3_scale(1 / vec3_norm(normal), normal);
}

CpsiSlackPiece cpsi_piece_at(const CpsLineView *step, int element, double force) {
    CpsiSlackPiece piece = {.first = element,
                            .last = element,
                            .slack = is_slack(step, element, force)};
    if (!piece.slack) return piece;
    while (piece.last + 1 < step->element_count && is_loose(step, piece.last + 1, force))
        ++piece.last;
    piece.open[0] = element == 0 && is_loose(step, 0, force);
    piece.open[1] =
        piece.last == step->element_count - 1 && is_loose(step, step->element_count, force);
    find_plane(step, force, &piece);
    return piece;
}

double cpsi_piece_reach(const CpsLineView *step, const CpsiSlackPiece *piece, int i) {
    const double l = step->element_length[i];
    const double h =
        (i == piece->first ? piece->height[0] : 0) - (i == piece->last ? piece->height[1] : 0);
    return sqrt(fmax(0, (l - h) * (l + h)));
}

bool cpsi_piece_moves(const CpsLineView *step, const CpsiSlackPiece *piece) {
    if (!piece->slack) return false;
    if (piece->open[0] || piece->open[1]) return true;
    if (piece->first == piece->last) return false;
    double reach = 0;
    for (int i = piece->first; i <= piece->last; ++i) reach += cpsi_piece_reach(step, piece, i);
    return reach > vec3_norm(vec3_sub(piece->foot[1], piece->foot[0])) * (1 + CPSI_FULL);
}

/* ---- nodes that slip on ---- */

static bool at_bound(const CpsLineView *step, int node) {
    const double bound = step->friction_bound[node];
    return bound > 0 && vec3_norm(vec3_at(step->friction_force, node)) >= bound * (1 - AT_BOUND);
}

static bool is_held(const CpsLineView *step, int node) {
    return (node == 0 && step->end[CPS_END_A].kind == CPS_END_KIND_HELD) ||
           (node == step->element_count && step->end[CPS_END_B].kind == CPS_END_KIND_HELD);
}

/* Whether a node can move along the unit vector v of its plane by itself, with a solution as the
 * result. Friction at its bound lets it slip on, or back as far as it has slipped. */
static bool may_go(const CpsLineView *step, int node, Vec3 v) {
    if (is_held(step, node)) return false;
    if (!(step->friction_bound[node] > 0)) return true;
    if (!at_bound(step, node)) return false;
    const Vec3 force = vec3_at(step->friction_force, node), n = vec3_at(step->normal, node);
    const Vec3 u = vec3_sub(vec3_at(step->position, node), vec3_at(step->reference, node));
    const double along = vec3_dot(force, v), size = vec3_norm(force);
    if (!(vec3_norm(vec3_cross(force, v)) <= SAME * size)) return false;
    const double slip = vec3_norm(vec3_reject(u, n));
    return along < 0 || slip > SLIP * step->arc_length[step->element_count];
}

/* Whether the element between a node that moves along v and the next one, on side 0 or 1, moves
 * that node too. It does not where it is shorter than its length, or becomes so. */
static bool carries(const CpsLineView *step, int node, int side, Vec3 v, double force) {
    const int i = side == 0 ? node - 1 : node, other = side == 0 ? node - 1 : node + 1;
    if (!is_slack(step, i, force)) return true;
    const double stretch = cpsi_element_stretch(step, step->position, i);
    if (stretch < 1 - CPSI_FULL) return false;
    const Vec3 e = vec3_sub(vec3_at(step->position, node), vec3_at(step->position, other));
    return !(vec3_dot(e, v) < -SAME * vec3_norm(e));
}

/* whether a node, with all nodes that it moves, can move along v */
static bool cluster_goes(const CpsLineView *step, int node, Vec3 v, double force) {
    if (!may_go(step, node, v)) return false;
    for (int side = 0; side < 2; ++side) {
        const int end = side == 0 ? 0 : step->element_count;
        for (int j = node; j != end && carries(step, j, side, v, force);) {
            j += side == 0 ? -1 : 1;
            if (!may_go(step, j, v)) return false;
        }
    }
    return true;
}

/* whether a node at its bound can slip on or back */
static bool may_slip(const CpsLineView *step, int node, double force) {
    const Vec3 f = vec3_at(step->friction_force, node);
    const double size = vec3_norm(f);
    return at_bound(step, node) && size > 0 &&
           (cluster_goes(step, node, vec3_scale(-1 / size, f), force) ||
            cluster_goes(step, node, vec3_scale(1 / size, f), force));
}

/* ---- the list ---- */

/* count what holds a node in the part that it belongs to */
static void note_node(const CpsLineView *step, int j, double force, CpsSlackPart *part) {
    part->grounded |= step->reaction[j] > 0;
    part->has_friction |= step->friction_bound[j] > 0;
    part->at_bound = part->at_bound || at_bound(step, j);
    part->sliding = part->sliding || may_slip(step, j, force);
}

int cps_solution_slack(const CpsLineView *step, int capacity, CpsSlackPart *part) {
    if (!step || step->element_count < 1 || (capacity > 0 && !part)) return 0;
    const double force = cpsi_slack_force(step);
    int parts = 0;
    CpsSlackPart now = {.to = -1};
    for (int i = 0; i < step->element_count;) {
        const CpsiSlackPiece piece = cpsi_piece_at(step, i, force);
        i = piece.last + 1;
        if (!piece.slack) continue;
        const bool moves = cpsi_piece_moves(step, &piece);
        if (parts == 0 || now.to < step->arc_length[piece.first] || now.loose != moves) {
            now = (CpsSlackPart){.from = step->arc_length[piece.first], .loose = moves};
            ++parts;
            note_node(step, piece.first, force, &now);
        }
        now.to = step->arc_length[i];
        for (int j = piece.first + 1; j <= i; ++j) note_node(step, j, force, &now);
        if (parts <= capacity) part[parts - 1] = now;
    }
    return parts;
}
