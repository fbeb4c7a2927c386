/* SPDX-License-Identifier: BSD-3-Clause */
/* The slack of a step laid out at its full length: S90 (55) with a tangent of one's own where T = 0.
 *
 * A node of a slack part may move without changing the energy if it bears no friction bound and keeps its height above
 * the plane. Between two nodes that stay, the length L of the elements is longer than the chord d; parted into L1 in
 * one direction and L2 in another, they and the chord are the sides of a triangle. Taking half of L first gives two
 * straight pieces, taking elements from the two in turn a meander. With L1 - L2 as close to d as the elements let it be
 * the triangle is flat: to and fro along the chord itself. All end where they should, whatever the element lengths. */
#include <math.h>
#include <string.h>

#include "base/larger.h"
#include "base/status.h"
#include "capstan/solutions.h"
#include "classic/places.h"

/* an element is slack with a tension below this part of the step's largest force: its complement, the slack, is then
 * larger */
static const double SLACK_TENSION = 1e-5;

/* an element closer to its length than this needs no laying out [-] */
static const double FULL = 1e-9;

/* a friction force this part below its bound is at it: what a step's certificate of 1e-8 leaves of it */
static const double AT_BOUND = 1e-6;

static const struct {
    const char *key, *sentence;
} COMPLETION[] = {
#define CPS_COMPLETION_TEXT(name, number, key, sentence) [number] = {key, sentence},
    CPS_COMPLETION_LIST(CPS_COMPLETION_TEXT)
#undef CPS_COMPLETION_TEXT
};

const char *cps_completion_key(CpsCompletion completion) {
    return (unsigned)completion < CPS_COMPLETIONS ? COMPLETION[completion].key : "unknown";
}

const char *cps_completion_sentence(CpsCompletion completion) {
    return (unsigned)completion < CPS_COMPLETIONS ? COMPLETION[completion].sentence : "unknown completion";
}

static double largest_force(const CpsLineView *step) {
    double most = 0, sum = 0;
    for (int i = 0; i < step->elements; ++i) most = cpsi_larger(most, step->tension[i]);
    for (int j = 0; j <= step->elements; ++j) sum += vec3_norm(cpsi_at(step->load, j));
    return cpsi_larger(most, sum);
}

static bool slack(const CpsLineView *step, int element, double force) {
    return element >= 0 && element < step->elements && step->tension[element] <= SLACK_TENSION*force;
}

/* may a node move within its plane? Both its elements are slack, no friction acts or could, and it is no end. */
static bool loose(const CpsLineView *step, int node, double force) {
    return node > 0 && node < step->elements && slack(step, node - 1, force) && slack(step, node, force) &&
           !(step->friction_bound[node] > 0);
}

/* the same of end B: free, without tension, without friction */
static bool loose_end(const CpsLineView *step, double force) {
    const int n = step->elements;
    return step->end[CPS_END_B].kind != CPS_END_HELD && slack(step, n - 1, force) && !(step->friction_bound[n] > 0);
}

static double stretch(const CpsLineView *step, const double *position, int i) {
    return vec3_norm(vec3_sub(cpsi_at(position, i + 1), cpsi_at(position, i)))/step->element_length[i];
}

/* ---- laying out ---- */

/* Elements first..last between the nodes first and last + 1 that stay. */
typedef struct Piece {
    int first, last;
    CpsCompletion how;
} Piece;

/* does element i go in the first of the two directions? So far `on` of the length before it did, `back` did not; the
 * chord is `d` of the whole length. */
static bool first_side(const CpsLineView *step, const Piece *piece, int i, double d, double on, double back) {
    const double length = step->arc_length[piece->last + 1] - step->arc_length[piece->first];
    const double before = step->arc_length[i] - step->arc_length[piece->first], l = step->element_length[i];
    if (piece->how == CPS_COMPLETION_MEANDER) return (i - piece->first)%2 == 0;
    if (piece->how == CPS_COMPLETION_STRAIGHT) return before < 0.5*length || i == piece->first;
    /* on, unless that leads past the place due at the end of the element */
    return on - back + l <= d*(before + l)/length*(1 + FULL);
}

/* a unit vector in the plane of the nodes, across the chord */
static Vec3 sideways(const CpsLineView *step, const Piece *piece, Vec3 along) {
    Vec3 n = cpsi_at(step->normal, piece->first + 1);
    if (!(vec3_norm(n) > 0)) n = fabs(along.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0);
    const Vec3 across = vec3_cross(n, along);
    const double length = vec3_norm(across);
    return length > 1e-6 ? vec3_scale(1/length, across) : vec3_cross(vec3(0, 1, 0), along);
}

/* lengths laid out in the first and in the second direction */
static void sides(const CpsLineView *step, const Piece *piece, double d, double side[2]) {
    side[0] = side[1] = 0;
    for (int i = piece->first; i <= piece->last; ++i)
        side[!first_side(step, piece, i, d, side[0], side[1])] += step->element_length[i];
}

/* false when the triangle does not close: one side is longer than the other and the chord */
static bool lay_out(const CpsLineView *step, const Piece *piece, double *position) {
    const Vec3 from = cpsi_at(position, piece->first), chord = vec3_sub(cpsi_at(position, piece->last + 1), from);
    const double d = vec3_norm(chord), length = step->arc_length[piece->last + 1] - step->arc_length[piece->first];
    double side[2];
    sides(step, piece, d, side);
    if (!(length > d*(1 + FULL)) || !(fabs(side[0] - side[1]) <= d*(1 + FULL))) return false;

    /* law of cosines; a chord of length 0 is left in any direction along the plane */
    const Vec3 along = d > 0 ? vec3_scale(1/d, chord) : vec3(1, 0, 0);
    const Vec3 across = sideways(step, piece, along);
    const double turn[2] = {d > 0 ? (d*d + (side[0] - side[1])*length)/(2*d*side[0]) : 0,
                            d > 0 ? (d*d - (side[0] - side[1])*length)/(2*d*side[1]) : 0};
    double gone[2] = {0, 0};
    Vec3 x = from;
    for (int i = piece->first; i < piece->last; ++i) {
        const int k = !first_side(step, piece, i, d, gone[0], gone[1]);
        const double c = fmax(-1, fmin(1, turn[k])), s = sqrt(1 - c*c)*(k ? -1 : 1), l = step->element_length[i];
        x = vec3_axpy(l*c, along, vec3_axpy(l*s, across, x));
        vec3_store(position + 3*(size_t)(i + 1), x);
        gone[k] += l;
    }
    return true;
}

/* Straight on from the last node that stays to a loose end, in the direction in which the end lies, along the plane. */
static void lay_straight_on(const CpsLineView *step, int first, double *position) {
    const Vec3 from = cpsi_at(position, first), chord = vec3_sub(cpsi_at(position, step->elements), from);
    const Vec3 n = cpsi_at(step->normal, step->elements), flat = vec3_axpy(-vec3_dot(n, chord), n, chord);
    const double d = vec3_norm(flat);
    const Piece piece = {first, step->elements - 1, CPS_COMPLETION_STRAIGHT};
    const Vec3 along = d > 0 ? vec3_scale(1/d, flat) : sideways(step, &piece, vec3(1, 0, 0));
    for (int j = first + 1; j <= step->elements; ++j)
        vec3_store(position + 3*(size_t)j, vec3_axpy(step->arc_length[j] - step->arc_length[first], along, from));
}

/* what holds a node, added to its part */
static void note_node(const CpsLineView *step, int j, CpsSlackPart *part) {
    const double bound = step->friction_bound[j];
    part->grounded = part->grounded || step->reaction[j] > 0;
    part->rubs = part->rubs || bound > 0;
    part->sliding = part->sliding || (bound > 0 && vec3_norm(cpsi_at(step->friction, j)) >= bound*(1 - AT_BOUND));
}

int cps_solution_slack(const CpsLineView *step, int room, CpsSlackPart *part) {
    const double force = largest_force(step);
    int parts = 0;
    CpsSlackPart now = {.to = -1};
    for (int i = 0; i < step->elements; ++i) {
        if (!slack(step, i, force)) continue;
        const bool end = i == step->elements - 1 && loose_end(step, force);
        const bool moves = loose(step, i, force) || loose(step, i + 1, force) || end;
        if (parts == 0 || now.to < step->arc_length[i] || now.loose != moves) {
            now = (CpsSlackPart){.from = step->arc_length[i], .loose = moves};
            ++parts;
            note_node(step, i, &now);
        }
        now.to = step->arc_length[i + 1];
        note_node(step, i + 1, &now);
        if (parts <= room) part[parts - 1] = now;
    }
    return parts;
}

/* The same, and where the two sides differ by more than the chord, an odd number of elements between nodes that nearly
 * meet, once more after the last element is laid across. */
static bool lay_out_any(const CpsLineView *step, Piece piece, double *position) {
    if (lay_out(step, &piece, position)) return true;
    const Vec3 end = cpsi_at(position, piece.last + 1), chord = vec3_sub(end, cpsi_at(position, piece.first));
    const double d = vec3_norm(chord), l = step->element_length[piece.last];
    if (piece.last - piece.first < 2 ||
        !(step->arc_length[piece.last + 1] - step->arc_length[piece.first] > d*(1 + FULL)))
        return false;
    const Vec3 across = sideways(step, &piece, d > 0 ? vec3_scale(1/d, chord) : vec3(1, 0, 0));
    vec3_store(position + 3*(size_t)piece.last, vec3_axpy(-l, across, end));
    --piece.last;
    return lay_out(step, &piece, position);
}

/* Lay out a piece and count it. */
static void take_piece(const CpsLineView *step, const Piece *piece, bool end, double *position, CpsSlackReport *r) {
    const double length = step->arc_length[piece->last + 1] - step->arc_length[piece->first];
    const bool moves = piece->last > piece->first || end;
    r->slack += length;
    *(moves ? &r->loose : &r->held) += length;
    for (int i = piece->first; i <= piece->last; ++i)
        if (stretch(step, position, i) >= 1 - FULL) r->straight += step->element_length[i];
    if (end && piece->how == CPS_COMPLETION_STRAIGHT) {
        lay_straight_on(step, piece->first, position);
        ++r->parts;
    } else if (moves && lay_out_any(step, *piece, position)) {
        ++r->parts;
    }
    for (int i = piece->first; i <= piece->last; ++i)
        if (stretch(step, position, i) < 1 - FULL) r->left += step->element_length[i];
}

CpsStatus cps_solution_complete(const CpsLineView *step, CpsCompletion how, double *position, CpsSlackReport *report,
                                CpsError *err) {
    if (!step || !position) return cpsi_fail(err, CPS_ERR_ARGUMENT, "step or position is NULL");
    if ((unsigned)how >= CPS_COMPLETIONS)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "completion: found %d, expected shortest, straight or meander",
                         (int)how);
    if (step->slide)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': more than one obstacle, or one that is curved or has directions; only "
                         "planes with isotropic friction are completed",
                         step->name);
    memcpy(position, step->position, 3*((size_t)step->elements + 1)*sizeof *position);
    CpsSlackReport r = {0};
    const double force = largest_force(step);
    for (int i = 0; i < step->elements;) {
        /* a piece: up to the next node that stays */
        Piece piece = {i, i, how};
        while (loose(step, piece.last + 1, force)) ++piece.last;
        const bool end = piece.last == step->elements - 1 && loose_end(step, force);
        if (slack(step, i, force)) take_piece(step, &piece, end, position, &r);
        i = piece.last + 1;
    }
    if (report) *report = r;
    return CPS_OK;
}
