/* SPDX-License-Identifier: BSD-3-Clause */
/* The rule of least motion (least_motion.h; docs/theory.md 6a).
 *
 * With the forces of a round kept, a place goes with them when
 *
 *     element that pulls              e = (1 + c |p|) p/|p|:  it may only be shifted
 *     element that does not           |e| <= 1
 *     contact with a reaction         gap 0, else gap >= 0
 *     friction below its bound        no slip;  at its bound: slip against it, of any length
 *
 * Runs of nodes joined by elements that pull move as one rigid body that does not turn: a cluster.
 * What its nodes' contacts leave free is a linear space of dimension 0 to 3, cut by half-spaces.
 * Clusters are joined by single elements without tension. So the nearest place is a program over
 * the chain of clusters (chain/nearest_program.h), and its solution is at hand where no element and
 * no half-space is in the way of each cluster's own nearest place.
 *
 * Which of two complementary quantities of a round is the one that vanishes is read from their
 * sizes. In doubt an element pulls, a contact presses and friction sticks: fewer places then, but
 * all of them go with the forces. */
#include "cable/least_motion.h"

#include <float.h>
#include <string.h>

#include "base/larger.h"
#include "cable/friction_law.h"
#include "ipm/ipm.h"

/* What carries more than this, per unit of force, is not called without force: others places would
 * cost as much. */
static const double LOOSE = 1e-9;
/* A slip shorter than this, per length of the line, has no direction. */
static const double LEAST_WAY = 1e-12;
/* Directions whose sine is below this are the same: the angles that a round leaves between axes are
 * far smaller. */
static const double SAME = 1e-9;
/* An element longer than its length by this, or a node this deep, is rounding: a thousand times
 * what positions of order one have. */
static const double ROUNDING = 1e-12;
/* The loop on the second program is driven to this relative gap, and accepted at that. */
static const double TARGET = 1e-13;
static const double CLEAN = 1e-11;
static const int CENTRINGS = 2;
static const int SHARPENINGS = 6;

/* Bits of `mark`. */
enum { PRESSED = 1, RUBS = 2, SLIPS = 4, SLIPS_ACROSS = 8 };

/* Half-spaces of one contact: its normal, or the way along and across of a box, and one to
 * spare. */
enum { HALVES = 3 };

void cpsi_least_motion_layout(CpsiLeastMotion *least, CpsiArena *arena, int n, int contacts,
                              const CpsiLinsysOps *ops) {
    cpsi_nearest_program_layout(&least->program, arena, n, HALVES * contacts * n, ops);
    least->mark = CPSI_TAKE(arena, (size_t)contacts * (size_t)n, unsigned char);
    least->slack = CPSI_TAKE(arena, n, bool);
    least->cluster = CPSI_TAKE(arena, n, int);
    least->basis = CPSI_TAKE(arena, 9 * (size_t)n, double);
    least->place = CPSI_TAKE(arena, 3 * (size_t)n, double);
}

/* what the round says -------------------------------------------------------------------------- */

static void mark_friction(CpsiLeastMotion *least, const CpsiChainProgram *program) {
    const CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const double *s = disc->s[k], *z = disc->z[k];
        const bool slips =
            sqrt(s[1] * s[1] + s[2] * s[2]) * z[0] > z[0] - sqrt(z[1] * z[1] + z[2] * z[2]);
        const bool across =
            k > 0 && disc->contact[k - 1] == disc->contact[k]; /* the second of a box */
        least->mark[disc->contact[k]] |= RUBS | (slips ? across ? SLIPS_ACROSS : SLIPS : 0);
    }
    for (int k = 0; k < program->conic.count; k++) {
        const bool slips =
            cpsi_friction_conic_slip(program, k) > cpsi_friction_conic_margin(&program->conic, k);
        least->mark[program->conic.contact[k]] |= RUBS | (slips ? SLIPS : 0);
    }
}

/* Marks of contacts and slack elements, from the pairs of the solution; of a line without any force
 * where there is none. */
static void read_round(const CpsiLine *line, CpsiLeastMotion *least,
                       const CpsiChainProgram *program) {
    const int contacts = cpsi_line_contacts(line);
    memset(least->mark, 0, (size_t)contacts);
    if (!program) {
        for (int c = 0; c < contacts; c++)
            if (line->friction_bound[c] > 0) least->mark[c] = RUBS;
        for (int i = 1; i < line->n; i++) least->slack[i] = true;
    }
    if (!program) return;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++)
        if (!(unilateral->z[k] < unilateral->s[k] && unilateral->z[k] < LOOSE))
            least->mark[unilateral->contact[k]] = PRESSED;
    mark_friction(least, program);
    for (int i = 1; i < line->n; i++) {
        const double *s = program->segment.s[i], *z = program->segment.z[i];
        least->slack[i] =
            z[0] < s[0] - sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) && z[0] < LOOSE;
    }
}

/* clusters ------------------------------------------------------------------------------------- */

static Vec3 row(const double *basis, int i) { return vec3_load(&basis[3 * i]); }

/* Take direction a from the span of the first *freedom rows of the basis. */
static void block(double *basis, int *freedom, Vec3 a) {
    double c[3], size = 0;
    for (int i = 0; i < *freedom; i++) {
        c[i] = vec3_dot(row(basis, i), a);
        size += c[i] * c[i];
    }
    size = sqrt(size);
    if (*freedom == 0 || size <= SAME * vec3_norm(a)) return;
    if (*freedom == 2) {
        vec3_store(basis,
                   vec3_axpy(c[0] / size, row(basis, 1), vec3_scale(-c[1] / size, row(basis, 0))));
    } else if (*freedom == 3) {
        const Vec3 unit = vec3_scale(1 / vec3_norm(a), a);
        const double x = fabs(unit.x), y = fabs(unit.y), z = fabs(unit.z);
        const Vec3 axis = x <= y && x <= z ? vec3(1, 0, 0) : y <= z ? vec3(0, 1, 0) : vec3(0, 0, 1);
        const Vec3 across = vec3_axpy(-vec3_dot(axis, unit), unit, axis),
                   first = vec3_scale(1 / vec3_norm(across), across);
        vec3_store(basis, first);
        vec3_store(&basis[3], vec3_cross(unit, first));
    }
    --*freedom;
}

/* Complete the free directions to an orthonormal basis. */
static void complete(double *basis, int freedom) {
    static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (freedom == 0 || freedom == 3) {
        memcpy(basis, world, sizeof world);
        return;
    }
    if (freedom == 1) {
        double rest[9];
        int left = 3;
        memcpy(rest, world, sizeof rest);
        block(rest, &left, row(basis, 0));
        memcpy(&basis[3], rest, 3 * sizeof *rest);
    }
    vec3_store(&basis[6], vec3_cross(row(basis, 0), row(basis, 1)));
}

/* Node j keeps to { room + a.v >= 0 }, v its shift from where the round has it. */
static void cut(CpsiLeastMotion *least, int j, double weight, Vec3 a, double room) {
    CpsiHalfSpace *half = &least->program.half;
    const int k = half->count++;
    half->node[k] = j;
    half->weight[k] = weight;
    half->gap[k] = room > 0 ? room : 0;
    vec3_store(half->normal[k], a);
}

/* What friction leaves free along one of its axes, of which it slips or not; `way` is the slip
 * there. */
static void restrict_along(CpsiLeastMotion *least, int j, double weight, double *basis,
                           int *freedom, Vec3 axis, bool slips, double slip) {
    if (slips && fabs(slip) > LEAST_WAY)
        cut(least, j, weight, vec3_scale(slip > 0 ? 1 : -1, axis), fabs(slip));
    else
        block(basis, freedom, axis);
}

/* What the friction of contact c leaves free of its tangent plane. A set given as such has no more
 * than the direction in which it slips, but for one that is a segment. */
static void restrict_slip(const CpsiLine *line, CpsiLeastMotion *least, int c, double weight,
                          double *basis, int *freedom) {
    const int j = cpsi_line_node(line, c), mark = least->mark[c];
    const double *axes = cpsi_line_axes(line, c);
    const CpsiFrictionLaw *set = &line->friction_law[c];
    const Vec3 n = cpsi_line_friction_normal(line, c),
               from =
                   vec3_load(line->has_local_axes ? &line->base[3 * j] : &line->reference[3 * j]);
    const Vec3 u = vec3_sub(vec3_load(&line->position[3 * j]), from);
    const Vec3 before = line->has_local_axes ? vec3_load(&line->slide[3 * c]) : vec3(0, 0, 0);
    const Vec3 slip =
        vec3_scale(1 / line->length, vec3_add(before, vec3_axpy(-vec3_dot(u, n), n, u)));
    Vec3 along[2] = {row(axes, 0), row(axes, 1)};
    bool acts[2] = {set->given || set->ratio[0] > 0, set->given || set->ratio[1] > 0},
         slips[2] = {mark & SLIPS, mark & (set->box ? SLIPS_ACROSS : SLIPS)};
    if (set->given && cpsi_friction_set_conic(set->given)->unknowns == 1) {
        const double *p = cpsi_friction_set_conic(set->given)->p, size = hypot(p[0], p[1]);
        const Vec3 x = along[0], y = along[1];
        along[0] = vec3_axpy(p[0] / size, x, vec3_scale(p[1] / size, y));
        along[1] = vec3_cross(n, along[0]);
        acts[1] = false;
    } else if (!set->box && acts[0] && acts[1]) {
        const double size = vec3_norm(slip);
        if (!slips[0] || size <= LEAST_WAY) {
            block(basis, freedom, along[0]);
            block(basis, freedom, along[1]);
            return;
        }
        const Vec3 unit = vec3_scale(1 / size, slip);
        block(basis, freedom, vec3_cross(n, unit));
        cut(least, j, weight, unit, size);
        return;
    }
    for (int a = 0; a < 2; a++)
        if (acts[a])
            restrict_along(least, j, weight, basis, freedom, along[a], slips[a],
                           vec3_dot(slip, along[a]));
}

/* What contact c leaves free. */
static void restrict_contact(const CpsiLine *line, CpsiLeastMotion *least, int c, CpsiBounds bounds,
                             double *basis, int *freedom) {
    const int j = cpsi_line_node(line, c), mark = least->mark[c];
    const double weight = cpsi_line_share(line, j) / line->length;
    const Vec3 n = vec3_load(&line->normal[3 * c]);
    if (mark & PRESSED) {
        block(basis, freedom, n);
    } else if (isfinite(line->gap[c])) {
        const Vec3 u =
            vec3_sub(vec3_load(&line->position[3 * j]), vec3_load(&line->reference[3 * j]));
        cut(least, j, weight, n, (line->gap[c] + vec3_dot(n, u)) / line->length);
    }
    /* a bound that follows the reaction is none without it */
    if ((mark & RUBS) && (bounds == CPSI_BOUNDS_FIXED || (mark & PRESSED)))
        restrict_slip(line, least, c, weight, basis, freedom);
}

/* The clusters, what each is free to do, and where each would go if nothing else were in its way:
 * to the mean of its nodes' ways back. Returns whether any may move. */
static bool gather(const CpsiLine *line, CpsiLeastMotion *least, CpsiBounds bounds) {
    CpsiNearestProgram *program = &least->program;
    bool any = false;
    int count = 0;
    program->half.count = 0;
    for (int first = 0, end; first < line->n; first = end, count++) {
        double *basis = &least->basis[9 * count], weight = 0;
        int *freedom = &program->freedom[count];
        Vec3 back = vec3(0, 0, 0), shift = vec3(0, 0, 0);
        *freedom = 3;
        complete(basis, 3);
        for (end = first; end < line->n && (end == first || !least->slack[end]); end++) {
            const double share = cpsi_line_share(line, end);
            const Vec3 u =
                vec3_sub(vec3_load(&line->position[3 * end]), vec3_load(&line->reference[3 * end]));
            least->cluster[end] = count;
            back = vec3_axpy(-share, u, back);
            weight += share;
            if (cpsi_line_is_held(line, end)) *freedom = 0;
            for (int c = end; c < cpsi_line_contacts(line); c += line->n)
                restrict_contact(line, least, c, bounds, basis, freedom);
        }
        complete(basis, *freedom);
        program->weight[count] = weight / line->length;
        back = vec3_scale(1 / weight, back);
        for (int i = 0; i < *freedom; i++)
            shift = vec3_axpy(vec3_dot(row(basis, i), back), row(basis, i), shift);
        for (int j = first; j < end; j++)
            vec3_store(&least->place[3 * j], vec3_add(vec3_load(&line->position[3 * j]), shift));
        if (end == first + 1 && *freedom > 0) { /* one node: from the reference, without a detour */
            Vec3 place = vec3_load(&line->reference[3 * first]);
            for (int i = *freedom; i < 3; i++)
                place = vec3_axpy(-vec3_dot(row(basis, i), back), row(basis, i), place);
            vec3_store(&least->place[3 * first], place);
        }
        any = any || *freedom > 0;
    }
    program->chain.n = count;
    return any;
}

/* the second program --------------------------------------------------------------------------- */

/* By how much `place` is in its own way, per length of the line: elements too long, half-spaces
 * left. 0 where it is not. */
static double violation(const CpsiLine *line, const CpsiLeastMotion *least) {
    const CpsiHalfSpace *half = &least->program.half;
    double size = 0, most = 0;
    for (int j = 0; j < 3 * line->n; j++) most = fmax(most, fabs(least->place[j]));
    const double lost = 4 * DBL_EPSILON * most; /* [m] */
    for (int i = 1; i < line->n; i++) {
        if (!least->slack[i]) continue;
        const double l = line->element_length[i - 1];
        const double over = vec3_norm(vec3_sub(vec3_load(&least->place[3 * i]),
                                               vec3_load(&least->place[3 * (i - 1)]))) /
                                l -
                            1;
        if (over * l > ROUNDING * l + lost) size = cpsi_max_nan(size, over * l / line->length);
    }
    for (int k = 0; k < half->count; k++)
        if (half->gap[k] < -ROUNDING - lost / line->length)
            size = cpsi_max_nan(size, -half->gap[k]);
    return size;
}

/* Half-spaces as the clusters see them, from their places; those that concern nothing free are
 * dropped. */
static void turn_halves(const CpsiLine *line, CpsiLeastMotion *least) {
    CpsiNearestProgram *program = &least->program;
    CpsiHalfSpace *half = &program->half;
    int kept = 0;
    for (int k = 0; k < half->count; k++) {
        const int j = half->node[k], cluster = least->cluster[j];
        const Vec3 n = vec3_load(half->normal[k]);
        const Vec3 shift =
            vec3_sub(vec3_load(&least->place[3 * j]), vec3_load(&line->position[3 * j]));
        double own[3] = {0}, size = 0;
        for (int a = 0; a < program->freedom[cluster]; a++) {
            own[a] = vec3_dot(row(&least->basis[9 * cluster], a), n);
            size += own[a] * own[a];
        }
        if (!(sqrt(size) > SAME)) continue;
        half->node[kept] = cluster;
        half->weight[kept] = half->weight[k];
        half->gap[kept] = half->gap[k] + vec3_dot(n, shift) / line->length;
        memcpy(half->normal[kept], own, sizeof own);
        kept++;
    }
    half->count = kept;
}

/* Write the program: unknown is the way of each cluster from its place, first guess the place that
 * the round has found. */
static void fill(const CpsiLine *line, CpsiLeastMotion *least, double size) {
    CpsiNearestProgram *program = &least->program;
    CpsiChainProgram *chain = &program->chain;
    cpsi_chain_program_resize(chain, chain->n, true);
    chain->segment.compliance = 0;
    program->size = size;
    memcpy(chain->frame, least->basis, 9 * (size_t)chain->n * sizeof *chain->frame);
    memset(chain->base.load, 0, 3 * (size_t)chain->n * sizeof *chain->base.load);
    for (int j = 0; j < line->n; j++) {
        const int k = least->cluster[j];
        if (j > 0 && least->cluster[j - 1] == k) continue;
        const Vec3 at = vec3_load(&line->position[3 * j]);
        const Vec3 back =
            vec3_scale(1 / line->length, vec3_sub(at, vec3_load(&least->place[3 * j])));
        chain->held[k] = program->freedom[k] == 0;
        for (int a = 0; a < 3; a++)
            chain->base.u[3 * k + a] =
                a < program->freedom[k] ? vec3_dot(row(&least->basis[9 * k], a), back) : 0;
        if (k == 0) continue;
        const double l = line->element_length[j - 1];
        chain->segment.length[k] = l / line->length;
        vec3_store(&chain->segment.s[k][1],
                   vec3_scale(1 / l, vec3_sub(at, vec3_load(&line->position[3 * (j - 1)]))));
    }
}

/* Solve it; the places move to the solution. False where it is not to be had. */
static bool solve(const CpsiLine *line, CpsiLeastMotion *least, double size, int most,
                  int *iterations) {
    fill(line, least, size);
    CpsiNearestProgram *program = &least->program;
    const CpsiIpmOptions options = {.target = TARGET,
                                    .scale = 1,
                                    .max_iterations = most,
                                    .centering_steps = CENTRINGS,
                                    .sharpenings = SHARPENINGS};
    const CpsiIpmReport ipm = cpsi_ipm_solve(&program->chain.base, &options);
    *iterations += ipm.iterations;
    if (!(ipm.gap + ipm.residual + ipm.imbalance <= CLEAN)) return false;
    for (int j = 0; j < line->n; j++) {
        const int k = least->cluster[j];
        Vec3 place = vec3_load(&least->place[3 * j]);
        for (int a = 0; a < program->freedom[k]; a++)
            place = vec3_axpy(line->length * program->chain.base.u[3 * k + a],
                              row(&least->basis[9 * k], a), place);
        vec3_store(&least->place[3 * j], place);
    }
    return true;
}

/* Take the places. A node that rounding has put below the plane of its contact is lifted to it. */
static void accept_places(CpsiLine *line, const CpsiLeastMotion *least) {
    memcpy(line->position, least->place, 3 * (size_t)line->n * sizeof *line->position);
    for (int c = 0; c < cpsi_line_contacts(line); c++) {
        const int j = cpsi_line_node(line, c);
        if (least->program.freedom[least->cluster[j]] == 0 || (least->mark[c] & PRESSED) ||
            !isfinite(line->gap[c]))
            continue;
        const Vec3 n = vec3_load(&line->normal[3 * c]), x = vec3_load(&line->position[3 * j]);
        const double room =
            line->gap[c] + vec3_dot(n, vec3_sub(x, vec3_load(&line->reference[3 * j])));
        if (room < 0) vec3_store(&line->position[3 * j], vec3_axpy(-room, n, x));
    }
    for (int i = 1; i < line->n; i++)
        if (least->slack[i]) line->tension[i - 1] = 0;
}

/* Are elements kept out of obstacles in this round?  Their contacts tie two nodes each, which
 * clusters do not know. */
static bool ties_nodes(const CpsiLine *line, const CpsiChainProgram *program) {
    if (program)
        for (int k = 0; k < program->unilateral.count; k++)
            if (program->unilateral.contact[k] >= cpsi_line_contacts(line)) return true;
    return false;
}

static bool is_slack_somewhere(const CpsiChainProgram *program) {
    for (int i = 1; i < program->n; i++)
        if (!(program->segment.z[i][0] > LOOSE)) return true;
    return false;
}

void cpsi_places_as_found(CpsiLine *line, const CpsiChainProgram *program) {
    line->report.places = is_slack_somewhere(program) ? CPS_PLACES_ANY : CPS_PLACES_UNIQUE;
}

int cpsi_least_motion(CpsiLine *line, CpsiLeastMotion *least, const CpsiChainProgram *program,
                      CpsiBounds bounds, int max_iterations) {
    int iterations = 0;
    if (ties_nodes(line, program)) {
        cpsi_places_as_found(line, program);
        return 0;
    }
    read_round(line, least, program);
    line->report.places = CPS_PLACES_UNIQUE;
    const bool open = gather(line, least, bounds);
    if (!open && program) return 0;
    turn_halves(line, least);
    const double size = violation(line, least);
    if (!open) { /* nothing can move, and it need not be a place */
        if (size > 0) line->report.places = CPS_PLACES_ANY;
        return 0;
    }
    const bool found = !(size > 0) || solve(line, least, size, max_iterations, &iterations);
    line->report.places = found ? CPS_PLACES_NEAREST : CPS_PLACES_ANY;
    least->chose = true;
    if (found) accept_places(line, least);
    return iterations;
}

void cpsi_least_motion_restate(const CpsiLine *line, CpsiChainProgram *program) {
    CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const int c = disc->contact[k];
        const CpsiFrictionLaw *set = &line->friction_law[c];
        const bool across = k > 0 && disc->contact[k - 1] == c;
        const double *axes = cpsi_line_axes(line, c);
        const Vec3 slip = vec3_scale(1 / line->length, cpsi_line_slide(line, c));
        for (int a = 0; a < 2; a++)
            disc->s[k][1 + a] = (!set->box || across == (a == 1) ? set->ratio[a] : 0) *
                                vec3_dot(row(axes, a), slip);
    }
}
