/* SPDX-License-Identifier: BSD-3-Clause */
/* The slack of a step laid out at its full length: S90 (55) with a tangent of one's own where T = 0.
 *
 * A node of a slack part may move without changing the energy if it bears no friction bound and keeps its height above
 * the plane. Between two nodes that stay, the length L of the elements is longer than the chord d; parted into L1 on
 * one side of it and L2 on the other, they and the chord are the sides of a triangle. Taking all of L1 before L2 gives
 * a tent, taking elements from the two in turn a meander; both end where they should, whatever the element lengths. */
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

static double largest_force(const CpsLineView *step) {
    double most = 0, sum = 0;
    for (int i = 0; i < step->elements; ++i) most = cpsi_larger(most, step->tension[i]);
    for (int j = 0; j <= step->elements; ++j) sum += vec3_norm(cpsi_at(step->load, j));
    return cpsi_larger(most, sum);
}

static bool slack(const CpsLineView *step, int element, double force) {
    return element >= 0 && element < step->elements && step->tension[element] <= SLACK_TENSION*force;
}

/* may a node move within its plane? Both its elements are slack, no friction acts or could, and it is no held end. (A
 * free end without tension may be anywhere; it is left where it is.) */
static bool loose(const CpsLineView *step, int node, double force) {
    return node > 0 && node < step->elements && slack(step, node - 1, force) && slack(step, node, force) &&
           !(step->friction_bound[node] > 0);
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

/* on which side of the chord is element i? The tent has the first half (by length) on one side */
static bool first_side(const CpsLineView *step, const Piece *piece, int i, double length) {
    if (piece->how == CPS_COMPLETION_MEANDER) return (i - piece->first)%2 == 0;
    const double before = step->arc_length[i] - step->arc_length[piece->first];
    return before < 0.5*length || i == piece->first;
}

/* a unit vector in the plane of the nodes, across the chord */
static Vec3 sideways(const CpsLineView *step, const Piece *piece, Vec3 along) {
    Vec3 n = cpsi_at(step->normal, piece->first + 1);
    if (!(vec3_norm(n) > 0)) n = fabs(along.z) < 0.9 ? vec3(0, 0, 1) : vec3(1, 0, 0);
    const Vec3 across = vec3_cross(n, along);
    const double length = vec3_norm(across);
    return length > 1e-6 ? vec3_scale(1/length, across) : vec3_cross(vec3(0, 1, 0), along);
}

/* false when the triangle does not close: one side is longer than the other and the chord */
static bool lay_out(const CpsLineView *step, const Piece *piece, double *position) {
    const Vec3 from = cpsi_at(position, piece->first), chord = vec3_sub(cpsi_at(position, piece->last + 1), from);
    const double d = vec3_norm(chord), length = step->arc_length[piece->last + 1] - step->arc_length[piece->first];
    double side = 0;
    for (int i = piece->first; i <= piece->last; ++i)
        if (first_side(step, piece, i, length)) side += step->element_length[i];
    const double other = length - side;
    if (!(length > d*(1 + FULL)) || !(fabs(side - other) <= d)) return false;

    /* law of cosines; a chord of length 0 is left in any direction along the plane */
    const Vec3 along = d > 0 ? vec3_scale(1/d, chord) : vec3(1, 0, 0);
    const Vec3 across = sideways(step, piece, along);
    const double cosine[2] = {d > 0 ? (d*d + side*side - other*other)/(2*d*side) : 0,
                              d > 0 ? (d*d + other*other - side*side)/(2*d*other) : 0};
    Vec3 x = from;
    for (int i = piece->first; i < piece->last; ++i) {
        const bool first = first_side(step, piece, i, length);
        const double c = cosine[!first], s = sqrt(fmax(0, 1 - c*c))*(first ? 1 : -1), l = step->element_length[i];
        x = vec3_axpy(l*c, along, vec3_axpy(l*s, across, x));
        vec3_store(position + 3*(size_t)(i + 1), x);
    }
    return true;
}

int cps_solution_slack(const CpsLineView *step, int room, CpsSlackPart *part) {
    const double force = largest_force(step);
    int parts = 0;
    CpsSlackPart now = {.to = -1};
    for (int i = 0; i < step->elements; ++i) {
        if (!slack(step, i, force)) continue;
        const bool moves = loose(step, i, force) || loose(step, i + 1, force);
        const bool pushed = step->reaction[i] > 0 || step->reaction[i + 1] > 0;
        if (parts == 0 || now.to < step->arc_length[i] || now.loose != moves) {
            now = (CpsSlackPart){.from = step->arc_length[i], .loose = moves};
            ++parts;
        }
        now.to = step->arc_length[i + 1];
        now.grounded = now.grounded || pushed;
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

CpsStatus cps_solution_complete(const CpsLineView *step, CpsCompletion how, double *position, CpsSlackReport *report,
                                CpsError *err) {
    if (!step || !position) return cpsi_fail(err, CPS_ERR_ARGUMENT, "step or position is NULL");
    if (how != CPS_COMPLETION_TENT && how != CPS_COMPLETION_MEANDER)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "completion: found %d, expected tent or meander", (int)how);
    if (step->slide)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "line '%s': its obstacle is curved or rubs differently in two directions; only "
                         "planes with isotropic friction are completed",
                         step->name);
    memcpy(position, step->position, 3*((size_t)step->elements + 1)*sizeof *position);
    CpsSlackReport r = {0};
    const double force = largest_force(step);
    for (int i = 0; i < step->elements;) {
        /* a piece: up to the next node that stays */
        int last = i;
        while (loose(step, last + 1, force)) ++last;
        if (slack(step, i, force)) {
            const Piece piece = {i, last, how};
            const double length = step->arc_length[last + 1] - step->arc_length[i];
            r.slack += length;
            *(last > i ? &r.loose : &r.held) += length;
            for (int k = i; k <= last; ++k)
                if (stretch(step, position, k) >= 1 - FULL) r.straight += step->element_length[k];
            if (last > i && lay_out_any(step, piece, position)) ++r.parts;
            for (int k = i; k <= last; ++k)
                if (stretch(step, position, k) < 1 - FULL) r.left += step->element_length[k];
        }
        i = last + 1;
    }
    if (report) *report = r;
    return CPS_OK;
}
