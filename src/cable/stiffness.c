/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of the ends of a line (stiffness.h): one linear system of the chain, at the state
 * that the step has left, for the three directions in which an end may move.
 *
 * The force in a taut element, p = T t with T = (|x'| - 1)/c, changes by
 *
 *     dp = (T/|x'|) (1 - t t')/l d + (1/(c l)) t t' d,      d the difference of its nodes' moves.
 *
 * A node that touches keeps to its surface, whose normal turns by K v as the node moves by v, K the
 * curvature: the reaction R turns with it, by R K v, and friction F stays tangential, which takes
 * -F.K v off the normal force. A node that sticks stays. One that slides by s has the friction
 * F = -A B B s/|B s|, with the ratios B of an ellipse and A = mu R,
 *
 *     dF = -A B (1 - q q') B ds/|B s| + mu B q dR,      q = -B s/|B s|,
 *
 * and on a sphere of radius r, where the slip is along a great circle, its direction turns with the
 * place by 1/(r tan(|s|/r)) in place of 1/|s|. Lengths are in units of the line's, forces in those
 * of its largest force. */
#include "cable/stiffness.h"

#include <math.h>
#include <string.h>

#include "cable/contact_surface.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/moving_flow.h"
#include "cable/potential.h"
#include "cable/soft.h"
#include "chain/frame.h"

/* The stiffness of a direction in which a node is held, beside which those of the line vanish. The
 * dense system takes what is smaller by the square of the rounding for 0. */
static const double RIGID = 1e20;
/* The compliance of an element that cannot stretch, or between nodes that are held. */
static const double LEAST_COMPLIANCE = 1e-30;
/* The stiffness with touchdown at the next node differs by no more than this share where the mesh
 * resolves the line's turn up from the ground: what linear interpolation leaves is of its square.
 */
static const double LARGEST_JUMP = 0.2;

/* See is_nearly_open. */
static const double LEFT_OPEN = 1e-4;

/* The line, the program that lends its arrays, and the units. */
typedef struct Tangent {
    const CpsiLine *line;
    CpsiChainProgram *program;
    CpsiMatrix *matrix;
    bool pinned;     /* what friction can hold stays where it is */
    bool consistent; /* friction follows the reaction */
    bool curved;     /* contact follows the surface; else it is that of the reference (S90 (35)) */
    bool moves[2];   /* ends whose stiffness is asked for */
    double force;    /* [N] its unit */
    int opened, landed; /* contacts that are taken as open and as closed, -1: none */
} Tangent;

/* Does the state of a contact hang on rounding? The solution leaves at an open contact a reaction
 * that is this share of the node's weight at most; the state, which compares it with the gap per
 * length of the line, takes a contact for closed that is open by a fraction of a millimetre. */
static bool is_nearly_open(const CpsiLine *line, int c) {
    if (cpsi_line_element(line, c) >= 0 || !cpsi_line_obstacle(line, c)) return false;
    const int j = cpsi_line_node(line, c);
    CpsiObstacle seen;
    const double weight = vec3_norm(cpsi_line_load_at(line, j)) * cpsi_line_share(line, j);
    return line->reaction[c] <= LEFT_OPEN * weight &&
           cpsi_obstacle_gap(cpsi_contact_surface(line, c, &seen), vec3_at(line->position, j)) >
               CPS_TOUCH * line->length;
}

static bool touches(const Tangent *t, int c) {
    if (c == t->landed) return true;
    return t->line->state[c] != CPS_NODE_STATE_FREE && c != t->opened &&
           !is_nearly_open(t->line, c);
}

/* Does friction hold contact c, if there is any? */
static bool sticks(const Tangent *t, int c) {
    return t->pinned || t->line->state[c] == CPS_NODE_STATE_STICK;
}

/* Does friction resist in all directions: is 0 inside its set? Of a set whose boundary is not known
 * piece by piece that is not known. */
static bool holds_all_ways(const CpsiFrictionLaw *law) {
    if (!law->given) return law->ratio[0] > 0 && law->ratio[1] > 0;
    const CpsiFrictionShape *shape = cpsi_friction_set_shape(law->given);
    return shape && shape->inner > 0;
}

/* Does friction act at contact c? Cycles about where the line is have it also where the step has
 * none: one of statics, or with the bound of a reference that did not touch. */
static bool rubs(const Tangent *t, int c, const CpsiFrictionLaw *law) {
    return t->pinned || c == t->landed ? law->friction > 0 : t->line->friction_bound[c] > 0;
}

/* What is opposed to a touching contact along its normal, in the units of the matrix. */
static double normal_stiffness(const Tangent *t, int c) {
    const double gives = cpsi_soft_spring(t->line, c).stiffness;
    return gives > 0 ? gives * t->line->length / t->force : RIGID;
}

/* Is contact c held in all directions? */
static bool rests(const Tangent *t, int c) {
    const CpsiFrictionLaw law = cpsi_line_friction_law(t->line, c);
    return touches(t, c) && sticks(t, c) && rubs(t, c, &law) && holds_all_ways(&law) &&
           normal_stiffness(t, c) == RIGID;
}

/* The contact that node j has, -1: none; *both: it has two. */
static int contact_of(const Tangent *t, int j, bool *both) {
    const int n = t->line->n;
    const bool first = touches(t, j), second = t->line->contacts > 1 && touches(t, j + n);
    *both = first && second;
    return first ? j : second ? j + n : -1;
}

/* matrix --------------------------------------------------------------------------------------- */

static void load_elements(Tangent *t) {
    const CpsiLine *line = t->line;
    for (int i = 1; i < line->n; i++) {
        const Vec3 dx = vec3_sub(vec3_at(line->position, i), vec3_at(line->position, i - 1));
        const double tension = line->tension[i - 1] / t->force, size = vec3_norm(dx);
        const double stretch = size / line->element_length[i - 1];
        const double l = line->element_length[i - 1] / line->length;
        const CpsiElementLaw law = cpsi_line_law(line, i - 1);
        const double c = cpsi_law_compliance(&law, line->tension[i - 1]) * t->force;
        const double share = 1 - c * tension / stretch;
        double along[3];
        vec3_store(along, vec3_scale(size > 0 ? 1 / size : 0, dx));
        cpsi_frame_to(&t->matrix->direction[3 * i], line->common_axes, along);
        const double strain =
            law.count > 0 ? cpsi_law_strain(&law, line->tension[i - 1]) : c * tension;
        const bool taut = tension > 1 + strain - stretch && share > 0; /* as in report.c */
        t->matrix->stiffness[i] = taut ? tension / (stretch * l) : 0;
        t->matrix->compliance[i] = taut ? fmax(c * l / share, LEAST_COMPLIANCE) : RIGID;
    }
}

/* The surface at a contact of a node, at the position that the step has left, and what acts there
 * in its axes. */
typedef struct Surface {
    double axes[9], curvature[3]; /* (obstacle.h) */
    double slip[3], friction[3];
    CpsiFrictionLaw law;
} Surface;

/* The slip at contact c; of one that is taken as closed what its node has moved along the plane. */
static Vec3 slip_of(const Tangent *t, int c) {
    const CpsiLine *line = t->line;
    if (c != t->landed) return cpsi_line_slip(line, c);
    const int j = cpsi_line_node(line, c);
    const Vec3 moved = vec3_sub(vec3_at(line->position, j), vec3_at(line->reference, j));
    return vec3_reject(moved, vec3_at(line->normal, c));
}

static Surface surface_of(const Tangent *t, int c) {
    const CpsiLine *line = t->line;
    Surface out = {.law = cpsi_line_friction_law(line, c)};
    const int j = cpsi_line_node(line, c);
    double slip[3];
    memcpy(out.axes, line->common_axes, sizeof out.axes);
    if (line->has_local_axes) {
        const Vec3 before = vec3_at(line->position, j > 0 ? j - 1 : j),
                   after = vec3_at(line->position, j + 1 < line->n ? j + 1 : j);
        CpsiObstacle seen;
        cpsi_obstacle_axes(cpsi_contact_surface(line, c, &seen), vec3_at(line->position, j),
                           vec3_sub(after, before), out.axes, out.curvature);
    }
    vec3_store(slip, slip_of(t, c));
    cpsi_frame_to(out.slip, out.axes, slip);
    cpsi_frame_to(out.friction, out.axes, &line->friction_force[3 * c]);
    return out;
}

/* [1/m] By how much the direction of a slip turns with the place across it. */
static double turn_of(const Tangent *t, int c, double slip) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(t->line, c);
    if (!obstacle || obstacle->kind != CPS_OBSTACLE_SPHERE) return 1 / slip;
    return 1 / (obstacle->radius * tan(slip / obstacle->radius));
}

/* The rows of node j, which slides at contact c. */
static void load_slip(Tangent *t, int j, int c, const Surface *at) {
    double *diagonal = &t->matrix->diagonal[6 * j], q[2];
    const double *b = at->law.ratio, bound = t->line->friction_bound[c] / t->force;
    for (int a = 0; a < 2; a++) q[a] = -b[a] * at->slip[a];
    const double size = sqrt(q[0] * q[0] + q[1] * q[1]);
    const double across = bound * t->line->length * turn_of(t, c, size);
    for (int a = 0; a < 2; a++) q[a] /= size;
    diagonal[0] += across * b[0] * b[0] * q[1] * q[1];
    diagonal[1] -= across * b[0] * b[1] * q[0] * q[1];
    diagonal[2] += across * b[1] * b[1] * q[0] * q[0];
    const double follows = t->consistent ? at->law.friction * normal_stiffness(t, c) : 0;
    for (int a = 0; a < 2; a++) t->matrix->skew[2 * j + a] = b[a] * q[a] * follows;
}

/* What turns with the surface as node j moves along it: the reaction and friction of contact c. */
static void load_curvature(Tangent *t, int j, int c, const Surface *at) {
    const double *k = at->curvature, *f = at->friction, length = t->line->length;
    double *diagonal = &t->matrix->diagonal[6 * j], *skew = &t->matrix->skew[2 * j];
    for (int a = 0; a < 3; a++) diagonal[a] -= t->line->reaction[c] / t->force * length * k[a];
    for (int a = 0; a < 2; a++) {
        const double turned = length * (k[a] * f[0] + k[a + 1] * f[1]) / t->force;
        diagonal[3 + a] += turned; /* of row z alone */
        skew[a] -= turned;
    }
}

/* The rows of node j at its contact c. */
static void load_contact(Tangent *t, int j, int c) {
    const CpsiLine *line = t->line;
    const Surface at = surface_of(t, c);
    double *diagonal = &t->matrix->diagonal[6 * j];
    if (line->has_local_axes) memcpy(&t->program->frame[9 * j], at.axes, sizeof at.axes);
    if (line->reaction[c] > 0 || c == t->landed) diagonal[5] = normal_stiffness(t, c);
    if (rubs(t, c, &at.law) && !sticks(t, c)) load_slip(t, j, c, &at);
    if (rubs(t, c, &at.law) && sticks(t, c))
        for (int a = 0; a < 2; a++) diagonal[2 * a] = at.law.ratio[a] > 0 ? RIGID : 0;
    if (t->curved) load_curvature(t, j, c, &at);
}

/* What acts on node j by its place. */
static void field_at(const CpsiLine *line, int j, double k[6]) {
    cpsi_potential_stiffness(line, j, k);
    if (cpsi_line_swims(line)) cpsi_line_add_water_stiffness(line, j, k);
}

/* The field at node j, in its axes. */
static void load_field(Tangent *t, int j) {
    static const int AT[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5}, FROM[6] = {0, 1, 4, 2, 5, 8};
    const CpsiLine *line = t->line;
    const double *axes = t->program->frame ? &t->program->frame[9 * j] : line->common_axes;
    double k[6], given[9], own[9];
    field_at(line, j, k);
    for (int i = 0; i < 9; i++) given[i] = k[AT[i]] * line->length / t->force;
    cpsi_frame_turn(own, axes, given);
    for (int i = 0; i < 6; i++) t->matrix->diagonal[6 * j + i] += own[FROM[i]];
}

/* Is node j an end whose stiffness is asked for? */
static bool is_moved(const Tangent *t, int j) {
    return (t->moves[0] && j == cpsi_line_end_node(t->line, 0)) ||
           (t->moves[1] && j == cpsi_line_end_node(t->line, 1));
}

static void load_nodes(Tangent *t) {
    const CpsiLine *line = t->line;
    const size_t n = (size_t)line->n;
    memset(t->matrix->diagonal, 0, 6 * n * sizeof *t->matrix->diagonal);
    memset(t->matrix->skew, 0, 2 * n * sizeof *t->matrix->skew);
    for (int j = 0; j < line->n; j++) {
        bool both;
        const int c = contact_of(t, j, &both);
        t->program->held[j] =
            is_moved(t, j) || cpsi_line_is_held(line, j) || both || (c >= 0 && rests(t, c));
        if (line->has_local_axes)
            memcpy(&t->program->frame[9 * j], line->common_axes, sizeof line->common_axes);
        if (c >= 0 && !t->program->held[j]) load_contact(t, j, c);
        if (cpsi_line_has_field(line)) load_field(t, j);
    }
}

/* what there is no matrix for ------------------------------------------------------------------ */

static bool is_round(const CpsiObstacle *obstacle) {
    return obstacle && obstacle->kind != CPS_OBSTACLE_PLANE;
}

/* Do the directions of friction turn with the line or, by a grain, with a round surface? */
static bool axes_turn(const CpsiLine *line, int c, const CpsiFrictionLaw *law) {
    const CpsiObstacle *obstacle = cpsi_line_obstacle(line, c);
    const bool is_disc = law->ratio[0] == law->ratio[1] && !law->box && !law->given;
    return !is_disc && obstacle && (!obstacle->has_grain || is_round(obstacle));
}

/* Does friction keep the axes of the reference, while contact follows the surface? */
static bool keeps_reference_axes(const Tangent *t) {
    return !t->consistent && t->curved && t->line->has_local_axes;
}

/* Is contact c one whose change of force is known? Frozen friction may act on what is open. An
 * element turns about the point at which it touches. */
static bool is_treated(const Tangent *t, int c) {
    const CpsiLine *line = t->line;
    const CpsiFrictionLaw law = cpsi_line_friction_law(line, c);
    const bool has_friction = rubs(t, c, &law);
    if (!touches(t, c)) return t->pinned || t->consistent || !has_friction;
    if (cpsi_line_element(line, c) >= 0) return false;
    if (!t->curved && is_round(cpsi_line_obstacle(line, c))) return false;
    if (!has_friction || (sticks(t, c) && holds_all_ways(&law))) return true;
    if (law.given || axes_turn(line, c, &law)) return false;
    return sticks(t, c) || ((line->state[c] == CPS_NODE_STATE_SLIP || c == t->landed) && !law.box &&
                            !keeps_reference_axes(t));
}

static bool all_are_treated(const Tangent *t) {
    const CpsiLine *line = t->line;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++)
        if (!is_treated(t, c)) return false;
    for (int j = 0; j < line->n; j++) {
        bool both;
        if (contact_of(t, j, &both) >= 0 && both && !rests(t, j) && !rests(t, j + line->n))
            return false;
    }
    return true;
}

/* Is there a node that nothing holds: one between elements without tension that touches nothing,
 * and that no field holds? */
static bool is_loose(const Tangent *t) {
    const CpsiLine *line = t->line;
    for (int j = 0; j < line->n; j++) {
        const bool before = j > 0 && t->matrix->stiffness[j] > 0,
                   after = j + 1 < line->n && t->matrix->stiffness[j + 1] > 0;
        if (!t->program->held[j] && !before && !after && !cpsi_line_field_holds(line, j))
            return true;
    }
    return false;
}

/* solution ------------------------------------------------------------------------------------- */

/* v of the common axes in those of node j, and back. */
static void to_node(const Tangent *t, int j, const double v[3], double out[3]) {
    if (t->program->frame)
        cpsi_frame_to(out, &t->program->frame[9 * j], v);
    else
        memcpy(out, v, 3 * sizeof *out);
}
static void from_node(const Tangent *t, int j, const double v[3], double out[3]) {
    if (t->program->frame)
        cpsi_frame_from(out, &t->program->frame[9 * j], v);
    else
        memcpy(out, v, 3 * sizeof *out);
}

/* An end: its node, the next one, the element between and the sign of its direction. */
typedef struct EndPlace {
    int node, next, element;
    double sign;
} EndPlace;

static EndPlace place_of(const CpsiLine *line, int end) {
    const int j = cpsi_line_end_node(line, end);
    return end == CPS_END_A ? (EndPlace){j, j + 1, j + 1, -1} : (EndPlace){j, j - 1, j, 1};
}

/* The forces on the line at its ends by a move of one of them in the direction `a`, in the common
 * axes and in units of the program. */
static void solve(const Tangent *t, int end, int a, double column[6]) {
    const int n = t->line->n;
    const CpsiMatrix *matrix = t->matrix;
    const EndPlace from = place_of(t->line, end);
    double *x = t->program->base.du, *tension = t->program->dt, move[3] = {0};
    memset(x, 0, 3 * (size_t)n * sizeof *x);
    memset(tension, 0, (size_t)n * sizeof *tension);
    move[a] = matrix->stiffness[from.element];
    if (!t->program->held[from.next]) to_node(t, from.next, move, &x[3 * from.next]);
    tension[from.element] = -from.sign * matrix->direction[3 * from.element + a];
    t->program->ops->solve(t->program->linsys, matrix, x, tension, NULL);
    for (int to = 0; to < 2; to++) {
        const EndPlace at = place_of(t->line, to);
        const double *m = &matrix->direction[3 * at.element];
        double next[3] = {0};
        if (!t->program->held[at.next]) from_node(t, at.next, &x[3 * at.next], next);
        for (int b = 0; b < 3; b++) {
            const double own = to == end && b == a,
                         other = at.element == from.element && to != end && b == a;
            column[3 * to + b] = matrix->stiffness[at.element] * (own - other - next[b]) +
                                 at.sign * m[b] * tension[at.element];
        }
    }
}

/* Add the field of the end itself, in the axes of the scene. */
static void add_field_of_end(const CpsiLine *line, int end, double out[36]) {
    static const int AT[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5};
    if (!cpsi_line_has_field(line)) return;
    double own[6];
    field_at(line, cpsi_line_end_node(line, end), own);
    for (int i = 0; i < 9; i++) out[6 * (3 * end + i / 3) + 3 * end + i % 3] += own[AT[i]];
}

/* The derivative of the forces on the line at the ends that move by their places, (6, 6) [N/m] in
 * the axes of the scene; 0 at an end that does not. The matrix of the chain is factored. */
static void find_columns(const Tangent *t, double out[36]) {
    const CpsiLine *line = t->line;
    double own[9], block[9]; /* from the common axes to those of the scene: Q'K Q */
    for (int i = 0; i < 9; i++) own[i] = line->common_axes[3 * (i % 3) + i / 3];
    memset(out, 0, 36 * sizeof *out);
    for (int end = 0; end < 2; end++) {
        double column[3][6] = {{0}};
        if (!t->moves[end]) continue;
        for (int a = 0; a < 3; a++) solve(t, end, a, column[a]);
        for (int to = 0; to < 2; to++) {
            if (!t->moves[to]) continue;
            for (int i = 0; i < 9; i++) block[i] = column[i % 3][3 * to + i / 3];
            cpsi_frame_turn(block, own, block);
            for (int i = 0; i < 9; i++)
                out[6 * (3 * to + i / 3) + 3 * end + i % 3] = block[i] * t->force / line->length;
        }
    }
}

/* ... with the contacts as they are taken. */
static CpsStiffnessOutcome find_matrix(Tangent *t, double out[36]) {
    double k[36];
    load_elements(t);
    load_nodes(t);
    if (is_loose(t) || !t->program->ops->factor(t->program->linsys, t->matrix))
        return CPS_STIFFNESS_OUTCOME_LOOSE;
    find_columns(t, k);
    for (int end = 0; end < 2; end++)
        if (t->moves[end]) add_field_of_end(t->line, end, k);
    for (int i = 0; i < 36; i++)
        if (!isfinite(k[i])) return CPS_STIFFNESS_OUTCOME_LOOSE;
    memcpy(out, k, sizeof k);
    return CPS_STIFFNESS_OUTCOME_FOUND;
}

/* touchdown ------------------------------------------------------------------------------------ */

/* How near to a jump the touchdown at node j is, whose neighbour `next` is off the plane: by how
 * much of a half it is nearer to opening there, or to closing at `next`. The reaction R and the
 * pull p of the element between them bear the weight q of the node: R = 0 where it opens, and p = 0
 * where its neighbour lands. What hangs at the node beside q holds the touchdown there. */
typedef struct Front {
    int contact, next;   /* of node j, and of its neighbour */
    double opens, lands; /* [-] up to 1/2 */
} Front;

static bool find_front(const Tangent *t, int j, int step, Front *out) {
    const CpsiLine *line = t->line;
    const int next = j + step, e = step > 0 ? j : next;
    bool both;
    const int c = contact_of(t, j, &both);
    if (c < 0 || both || next <= 0 || next >= line->n - 1 || contact_of(t, next, &both) >= 0)
        return false;
    const CpsiObstacle *plane = cpsi_line_obstacle(line, c);
    if (is_round(plane) || plane != cpsi_line_obstacle(line, next) || !(line->tension[e] > 0))
        return false;
    const Vec3 n = vec3_at(line->normal, c), weight = cpsi_line_load_at(line, j);
    const double q = -vec3_dot(weight, n) * cpsi_line_share(line, j),
                 p = step * vec3_dot(vec3_at(line->segment_force, e), n);
    if (!(q > 0)) return false;
    *out = (Front){.contact = c,
                   .next = next,
                   .opens = 0.5 - line->reaction[c] / q,
                   .lands = 0.5 - p / q};
    return out->opens > 0 || out->lands > 0;
}

/* The stiffness with the touchdown at the node beside; false where it is not known, or differs by
 * so much that the line turns up from the ground within an element. */
static bool find_beside(Tangent *t, const Front *front, const double as_is[36], double out[36]) {
    double jump = 0, size = 0;
    t->opened = front->opens > 0 ? front->contact : -1;
    t->landed = front->opens > 0 ? -1 : front->next;
    const bool treated = t->landed < 0 || is_treated(t, t->landed);
    const bool found = treated && find_matrix(t, out) == CPS_STIFFNESS_OUTCOME_FOUND;
    t->opened = t->landed = -1;
    if (!found) return false;
    for (int i = 0; i < 36; i++) {
        jump += (out[i] - as_is[i]) * (out[i] - as_is[i]);
        size += as_is[i] * as_is[i];
    }
    return sqrt(jump) <= LARGEST_JUMP * sqrt(size);
}

/* The stiffness with touchdown points that move along the elements instead of jumping from node to
 * node: add what it would differ by with each of them at the node beside, by the share of the way
 * there. */
static bool find_smooth(Tangent *t, const double as_is[36], double out[36]) {
    memcpy(out, as_is, 36 * sizeof *out);
    for (int j = 1; j < t->line->n - 1; j++)
        for (int step = -1; step <= 1; step += 2) {
            Front front;
            double beside[36];
            if (!find_front(t, j, step, &front)) continue;
            if (!(t->pinned || t->consistent) || !find_beside(t, &front, as_is, beside))
                return false;
            const double share = fmax(front.opens, front.lands);
            for (int i = 0; i < 36; i++) out[i] += share * (beside[i] - as_is[i]);
        }
    return true;
}

/* Lend the program's arrays to the matrix of the chain. */
static void begin(Tangent *t) {
    cpsi_chain_program_resize(t->program, t->line->n, t->line->has_local_axes);
    t->matrix->held = t->program->held;
    t->matrix->frame = t->program->frame;
    t->matrix->second = NULL;
    t->matrix->share = NULL;
}

CpsiLineStiffness cpsi_line_stiffness(const CpsiLine *line, CpsiChainProgram *program,
                                      const CpsiStepOptions *options, CpsStiffnessKind kind,
                                      const bool moves[2]) {
    CpsiLineStiffness out = {.outcome = CPS_STIFFNESS_OUTCOME_NO_STEP};
    bool both;
    Tangent t = {.line = line,
                 .program = program,
                 .matrix = &program->matrix,
                 .pinned = kind == CPS_STIFFNESS_STICK,
                 .consistent = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT,
                 .curved = options->contact_policy != CPS_CONTACT_POLICY_REFERENCE ||
                           options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT,
                 .moves = {moves[0], moves[1]},
                 .opened = -1,
                 .landed = -1,
                 .force = line->report.certificate.largest_force};
    if (line->report.outcome != CPS_OUTCOME_SOLVED || !(t.force > 0)) return out;
    out.outcome = CPS_STIFFNESS_OUTCOME_NOT_GIVEN;
    if (cpsi_line_has_sets(line)) return out;
    out.outcome = CPS_STIFFNESS_OUTCOME_TOUCHES;
    for (int end = 0; end < 2; end++)
        if (moves[end] && contact_of(&t, cpsi_line_end_node(line, end), &both) >= 0) return out;
    out.outcome = CPS_STIFFNESS_OUTCOME_NOT_GIVEN;
    if (cpsi_line_has_soft(line) || !all_are_treated(&t)) return out;
    begin(&t);
    out.outcome = find_matrix(&t, out.matrix);
    if (out.outcome != CPS_STIFFNESS_OUTCOME_FOUND) return out;
    out.has_smooth = find_smooth(&t, out.matrix, out.smooth);
    if (!out.has_smooth) memset(out.smooth, 0, sizeof out.smooth);
    return out;
}

/* the tangent of both ends ----------------------------------------------------------------------
 */

/* Hold what is_treated does not know, and nodes that nothing holds. */
static void hold_others(Tangent *t) {
    const CpsiLine *line = t->line;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        const int e = cpsi_line_element(line, c);
        if (e < 0 && touches(t, c) && !is_treated(t, c))
            t->program->held[cpsi_line_node(line, c)] = 1;
        if (e >= 0 && e + 1 < line->n && touches(t, c))
            t->program->held[e] = t->program->held[e + 1] = 1;
    }
    for (int j = 0; j < line->n; j++) {
        const bool before = j > 0 && t->matrix->stiffness[j] > 0,
                   after = j + 1 < line->n && t->matrix->stiffness[j + 1] > 0;
        if (!before && !after) t->program->held[j] = 1;
    }
}

void cpsi_line_tangent(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepOptions *options, double tangent[36]) {
    double found[36];
    Tangent t = {.line = line,
                 .program = program,
                 .matrix = &program->matrix,
                 .consistent = options->friction_policy == CPS_FRICTION_POLICY_CONSISTENT,
                 .curved = options->contact_policy != CPS_CONTACT_POLICY_REFERENCE,
                 .opened = -1,
                 .landed = -1,
                 .force = line->report.certificate.largest_force};
    memset(tangent, 0, 36 * sizeof *tangent);
    for (int end = 0; end < 2; end++) {
        t.moves[end] = line->end[end].kind == CPS_END_KIND_HELD;
        if (t.moves[end]) add_field_of_end(line, end, tangent);
    }
    if (!(t.force > 0)) return;
    begin(&t);
    load_elements(&t);
    load_nodes(&t);
    hold_others(&t);
    if (!program->ops->factor(program->linsys, t.matrix)) return;
    find_columns(&t, found);
    for (int i = 0; i < 36; i++) tangent[i] += isfinite(found[i]) ? found[i] : 0;
}
