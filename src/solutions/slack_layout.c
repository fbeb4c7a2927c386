/* SPDX-License-Identifier: BSD-3-Clause */
/* Configurations with the slack of a step stretched to its full length: S90 (55), with tangents of
 * our choice where T = 0.
 *
 * Between two nodes that remain in place, the elements of a piece (slack.h) have reaches r_i within
 * the plane of its loose nodes: their lengths, except for an element that comes down from a node
 * above the plane. The elements are divided into groups of one direction each. The groups and the
 * chord between the projections of the two nodes are the sides of a triangle or a quadrilateral.
 *
 * Taking half of the length first gives two straight parts; taking elements alternately for the
 * shorter side gives a meander. If the lengths of the two sides differ by as much of the chord as
 * the elements allow, the triangle is flat: the piece goes back and forth along the chord. Where
 * the sides differ by more than the chord, as with an odd number of elements between nodes that
 * nearly coincide, the last element is placed across first. Where the polygon still does not close
 * there are three groups: the elements up to half of the length, the element at that half, and the
 * rest. Each of them is at most half of the length, so that they close whenever any directions of
 * the elements do. */
#include <math.h>
#include <string.h>

#include "base/status.h"
#include "base/words.h"
#include "regularized/band_blocks.h"
#include "solutions/slack.h"

static const CpsiWords COMPLETION[] = {CPS_COMPLETION_LIST(CPSI_WORDS_WITH_KEY)};

const char *cps_completion_name(CpsCompletion completion) {
    return CPSI_WORDS(COMPLETION, completion).name;
}

const char *cps_completion_text(CpsCompletion completion) {
    return CPSI_WORDS(COMPLETION, completion).text;
}

/* A piece, how it is laid out, and the sides of its polygon [m]. */
typedef struct Laying {
    const CpsLineView *step;
    CpsiSlackPiece piece;
    CpsCompletion how;
    double chord, length; /* chord between the projections; sum of the elements' reaches */
    double side[3];
    bool third; /* whether there are three groups */
} Laying;

static double reach(const Laying *lay, int i) {
    return cpsi_piece_reach(lay->step, &lay->piece, i);
}

/* The group of element i; `gone` is the length already laid out in each group. */
static int group_of(const Laying *lay, int i, const double gone[3]) {
    const double before = gone[0] + gone[1] + gone[2], r = reach(lay, i);
    if (lay->third) {
        const double half = (lay->length + lay->chord) / 2;
        return gone[1] > 0 ? 2 : before + r > half * (1 + CPSI_FULL) ? 1 : 0;
    }
    switch (lay->how) {
    case CPS_COMPLETION_MEANDER: return gone[1] < gone[0] * (1 - CPSI_FULL);
    case CPS_COMPLETION_STRAIGHT:
        return !(before < 0.5 * lay->length * (1 - CPSI_FULL) || i == lay->piece.first);
    default:
        /* forward, unless that leads beyond the position prescribed for the end of the element */
        return !(gone[0] - gone[1] + r <=
                 lay->chord * (before + r) / lay->length * (1 + CPSI_FULL));
    }
}

static void measure_sides(Laying *lay) {
    memset(lay->side, 0, sizeof lay->side);
    for (int i = lay->piece.first; i <= lay->piece.last; ++i) {
        double *side = &lay->side[group_of(lay, i, lay->side)];
        *side += reach(lay, i);
    }
}

/* unit vectors in the plane: along the chord, and across it to the left */
static void axes(const Laying *lay, Vec3 *along, Vec3 *across) {
    const Vec3 n = lay->piece.normal, chord = vec3_sub(lay->piece.foot[1], lay->piece.foot[0]);
    Vec3 t = chord;
    if (!(lay->chord > CPSI_FULL * lay->length)) {
        const Vec3 x = vec3_axpy(-n.x, n, vec3(1, 0, 0));
        t = vec3_norm(x) > 0.1 ? x : vec3_axpy(-n.y, n, vec3(0, 1, 0));
    }
    *along = vec3_scale(1 / vec3_norm(t), t);
    *across = vec3_cross(n, *along);
}

/* cosine of the angle between the sides a and b of a triangle with the third side c */
static double corner(double a, double b, double c) {
    return a > 0 && b > 0 ? fmax(-1, fmin(1, (a * a + b * b - c * c) / (2 * a * b))) : 1;
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* The groups' directions, as cosine and sine of their angles from the chord. */
static void directions(const Laying *lay, double out[3][2]) {
    const double *l = lay->side, d = lay->chord;
    if (!lay->third) {
        const bool tiny = !(d > CPSI_FULL * lay->length);
        for (int k = 0; k < 2; ++k) {
            out[k][0] = tiny ? 0 : corner(l[k], d, l[1 - k]);
            out[k][1] = (k ? -1 : 1) * sqrt(1 - out[k][0] * out[k][0]);
        }
        return;
    }
    /* the diagonal from the start to the end of the second group gives two triangles, one with the
     * chord and one with the first two groups */
    const double least = fmax(fabs(l[0] - l[1]), fabs(l[2] - d)),
                 most = fmin(l[0] + l[1], l[2] + d);
    const double diagonal = clamp((least + most) / 2, least, most),
                 turn = acos(corner(diagonal, d, l[2]));
    const double angle[3] = {turn + acos(corner(l[0], diagonal, l[1])),
                             turn - acos(corner(l[1], diagonal, l[0])),
                             -acos(corner(l[2], d, diagonal))};
    for (int k = 0; k < 3; ++k) {
        out[k][0] = cos(angle[k]);
        out[k][1] = sin(angle[k]);
    }
}

static Laying begin(const CpsLineView *step, const CpsiSlackPiece *piece, CpsCompletion how) {
    Laying lay = {.step = step,
                  .piece = *piece,
                  .how = how,
                  .chord = vec3_norm(vec3_sub(piece->foot[1], piece->foot[0]))};
    for (int i = piece->first; i <= piece->last; ++i) lay.length += reach(&lay, i);
    return lay;
}

/* Whether the sides differ by no more than the chord, and are together long enough for it. After an
 * element has been placed across this may not hold. */
static bool two_close(Laying *lay) {
    lay->third = false;
    measure_sides(lay);
    return lay->length >= lay->chord * (1 - CPSI_FULL) &&
           fabs(lay->side[0] - lay->side[1]) <= lay->chord * (1 + CPSI_FULL);
}

static bool three_close(Laying *lay) {
    const double half = (lay->length + lay->chord) / 2 * (1 + CPSI_FULL);
    lay->third = true;
    measure_sides(lay);
    return lay->side[0] <= half && lay->side[1] <= half;
}

/* The piece without its last element, which is placed across the chord. */
static Laying without_last(const Laying *lay) {
    CpsiSlackPiece piece = lay->piece;
    Vec3 along, across;
    axes(lay, &along, &across);
    piece.foot[1] = vec3_axpy(-reach(lay, piece.last), across, piece.foot[1]);
    piece.height[1] = 0;
    --piece.last;
    return begin(lay->step, &piece, lay->how);
}

/* Lay out a piece between two nodes that remain in place. Returns false where no directions close
 * the polygon: one element is longer than all others and the chord together. */
static bool place_slack(Laying lay, double *position) {
    if (!two_close(&lay)) {
        Laying shorter = lay.piece.last > lay.piece.first + 1 ? without_last(&lay) : lay;
        if (shorter.piece.last < lay.piece.last && two_close(&shorter)) {
            vec3_store(position + 3 * (size_t)lay.piece.last, shorter.piece.foot[1]);
            lay = shorter;
        } else if (!three_close(&lay)) {
            return false;
        }
    }
    Vec3 along, across;
    double direction[3][2], gone[3] = {0, 0, 0};
    axes(&lay, &along, &across);
    directions(&lay, direction);
    Vec3 x = lay.piece.foot[0];
    for (int i = lay.piece.first; i < lay.piece.last; ++i) {
        const int k = group_of(&lay, i, gone);
        const double r = reach(&lay, i);
        x = vec3_axpy(r * direction[k][0], along, vec3_axpy(r * direction[k][1], across, x));
        vec3_store(position + 3 * (size_t)(i + 1), x);
        gone[k] += r;
    }
    return true;
}

/* Lay out a piece straight to a free end, from the last node that remains in place, in the present
 * direction of the end. */
static void place_straight_on(const Laying *lay, double *position) {
    const CpsiSlackPiece *piece = &lay->piece;
    Vec3 along, across;
    axes(lay, &along, &across);
    const bool forth = piece->open[1];
    Vec3 x = piece->foot[!forth];
    for (int k = piece->first; k <= piece->last; ++k) {
        const int i = forth ? k : piece->first + piece->last - k;
        x = vec3_axpy(forth ? reach(lay, i) : -reach(lay, i), along, x);
        vec3_store(position + 3 * (size_t)(forth ? i + 1 : i), x);
    }
}

/* Lay out a piece and count it. */
static void read_piece(const CpsLineView *step, const CpsiSlackPiece *piece, CpsCompletion how,
                       double *position, CpsSlackReport *r) {
    const bool moves = cpsi_piece_moves(step, piece), open = piece->open[0] || piece->open[1];
    const double length = step->arc_length[piece->last + 1] - step->arc_length[piece->first];
    r->slack += length;
    *(moves ? &r->loose : &r->held) += length;
    for (int i = piece->first; i <= piece->last; ++i)
        if (cpsi_element_stretch(step, position, i) >= 1 - CPSI_FULL)
            r->straight += step->element_length[i];
    const Laying lay = begin(step, piece, how);
    const bool straight_on = open && how == CPS_COMPLETION_STRAIGHT;
    bool placed = !straight_on && moves && piece->last > piece->first && place_slack(lay, position);
    if (open && !placed) {
        place_straight_on(&lay, position);
        placed = true;
    }
    r->part_count += placed;
    for (int i = piece->first; i <= piece->last; ++i)
        if (cpsi_element_stretch(step, position, i) < 1 - CPSI_FULL)
            r->left += step->element_length[i];
}

CpsStatus cps_solution_complete(const CpsLineView *step, CpsCompletion how, double *position,
                                CpsSlackReport *report, CpsError *err) {
    if (!step || !position || step->element_count < 1)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "step or position is NULL, or the step has no elements");
    if ((unsigned)how >= CPS_COMPLETION_COUNT)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "completion: found %d, expected shortest, straight or meander", (int)how);
    if (!step->one_plane)
        return cpsi_fail(
            err, CPS_ERR_ARGUMENT,
            "line '%s': more than one obstacle, or one that is curved, gives or has directions, a "
            "node that is grasped, a winch, springs, loads or drag; only planes with isotropic "
            "friction "
            "are completed",
            step->name);
    memcpy(position, step->position, 3 * ((size_t)step->element_count + 1) * sizeof *position);
    CpsSlackReport r = {0};
    const double force = cpsi_slack_force(step);
    for (int i = 0; i < step->element_count;) {
        const CpsiSlackPiece piece = cpsi_piece_at(step, i, force);
        if (piece.slack) read_piece(step, &piece, how, position, &r);
        i = piece.last + 1;
    }
    if (report) *report = r;
    return CPS_OK;
}
