/* SPDX-License-Identifier: BSD-3-Clause */
/* The rule of least motion (least_motion.h; docs/theory.md 6a).
 *
 * With the forces of a round kept, a configuration is compatible with them when
 *
 *     element with tension    e = (1 + c |p|) p/|p|:  it may only be translated
 *     element without         |e| <= 1
 *     contact with a reaction         gap 0, else gap >= 0
 *     friction below its bound        no slip;  at its bound: slip against it, of any length
 *
 * A run of nodes joined by elements with tension is translated as a rigid body: a cluster. The
 * translations that its nodes' contacts permit form a linear space of dimension 0 to 3, cut by
 * half-spaces. Clusters are joined by single elements without tension. So the nearest configuration
 * is the solution of a program over the chain of clusters (chain/nearest_program.h). Where each
 * cluster's own nearest position violates no element and no half-space, these positions are the
 * solution.
 *
 * Which of two complementary quantities of a round vanishes is decided by their sizes. In doubt an
 * element has tension, a contact has a reaction and friction sticks: this permits fewer
 * configurations, but all of them are compatible with the forces. */
#include "cable/least_motion.h"

#include <float.h>
#include <string.h>

#include "base/larger.h"
#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/friction_law.h"
#include "cable/winch.h"
#include "chain/slack.h"
#include "ipm/ipm.h"

/* A force below this, per unit of force, counts as zero; other configurations then increase the gap
 * by no more than that. */
static const double NO_FORCE = 1e-9;
/* A slip shorter than this, per length of the line, has no direction. */
static const double LEAST_SLIP = 1e-12;
/* Directions whose sine is below this count as parallel: the error angles of a round's axes are far
 * smaller. */
static const double PARALLEL = 1e-9;
/* An elongation of an inextensible element, or a penetration, up to this counts as rounding: a
 * thousand times the rounding of positions of order one. */
static const double ROUNDING = 1e-12;
/* The loop on the second program is driven to this relative gap, and accepted at that. */
static const double TARGET = 1e-13;
static const double CLEAN = 1e-11;
static const int CENTERING_STEPS = 2;
static const int REFINEMENT_STEPS = 6;

/* Bits of `mark`. */
enum { ACTIVE = 1, FRICTION = 2, SLIPS = 4, SLIPS_ACROSS = 8 };

/* Half-spaces of one contact, at most: one for its normal, or two for the slip along and across a
 * box, and one in reserve. */
enum { HALVES = 3 };

void cpsi_least_motion_layout(CpsiLeastMotion *least, CpsiArena *arena, int n, int contacts,
                              const CpsiChainProgram *program) {
    const size_t end = cpsi_arena_return(arena, program->scratch);
    CPSI_PLACE(arena, least->mark, (size_t)contacts * (size_t)n);
    CPSI_PLACE(arena, least->slack, n);
    CPSI_PLACE(arena, least->cluster, n);
    CPSI_PLACE(arena, least->basis, 9 * (size_t)n);
    CPSI_PLACE(arena, least->place, 3 * (size_t)n);
    cpsi_arena_join(arena, end);
    cpsi_nearest_program_layout(&least->program, arena, n, HALVES * contacts * n, program->ops);
}

/* the state of the round
 * -------------------------------------------------------------------------- */

static void mark_friction(CpsiLeastMotion *least, const CpsiChainProgram *program) {
    const CpsiFrictionDisc *disc = &program->disc;
    for (int k = 0; k < disc->count; k++) {
        const double *s = disc->s[k], *z = disc->z[k];
        const bool slips =
            sqrt(s[1] * s[1] + s[2] * s[2]) * z[0] > z[0] - sqrt(z[1] * z[1] + z[2] * z[2]);
        const bool across =
            k > 0 && disc->contact[k - 1] == disc->contact[k]; /* the second disc of a box */
        least->mark[disc->contact[k]] |= FRICTION | (slips ? across ? SLIPS_ACROSS : SLIPS : 0);
    }
    for (int k = 0; k < program->conic.count; k++) {
        const bool slips =
            cpsi_friction_conic_slip(program, k) > cpsi_friction_conic_margin(&program->conic, k);
        least->mark[program->conic.contact[k]] |= FRICTION | (slips ? SLIPS : 0);
    }
}

/* Marks of contacts and slack elements from the pairs of the solution; NULL stands for a line
 * without any force. */
static void read_solution(const CpsiLine *line, CpsiLeastMotion *least,
                          const CpsiChainProgram *program) {
    const int contacts = cpsi_line_contacts(line);
    memset(least->mark, 0, (size_t)contacts);
    if (!program) {
        for (int c = 0; c < contacts; c++)
            if (line->friction_bound[c] > 0) least->mark[c] = FRICTION;
        for (int i = 1; i < line->n; i++) least->slack[i] = true;
    }
    if (!program) return;
    const CpsiUnilateral *unilateral = &program->unilateral;
    for (int k = 0; k < unilateral->count; k++)
        if (!(unilateral->z[k] < unilateral->s[k] && unilateral->z[k] < NO_FORCE))
            least->mark[unilateral->contact[k]] = ACTIVE;
    mark_friction(least, program);
    for (int i = 1; i < line->n; i++)
        least->slack[i] =
            cpsi_segment_is_slack(&program->segment, i) && program->segment.z[i][0] < NO_FORCE;
}

/* clusters ------------------------------------------------------------------------------------- */

static Vec3 row(const double *basis, int i) { return vec3_at(basis, i); }

/* Remove direction a from the span of the first *freedom rows of the basis. */
static void remove_direction(double *basis, int *freedom, Vec3 a) {
    double c[3], size = 0;
    for (int i = 0; i < *freedom; i++) {
        c[i] = vec3_dot(row(basis, i), a);
        size += c[i] * c[i];
    }
    size = sqrt(size);
    if (*freedom == 0 || size <= PARALLEL * vec3_norm(a)) return;
    if (*freedom == 2) {
        vec3_store(basis,
                   vec3_axpy(c[0] / size, row(basis, 1), vec3_scale(-c[1] / size, row(basis, 0))));
    } else if (*freedom == 3) {
        const Vec3 unit = vec3_scale(1 / vec3_norm(a), a);
        const double x = fabs(unit.x), y = fabs(unit.y), z = fabs(unit.z);
        const Vec3 axis = x <= y && x <= z ? vec3(1, 0, 0) : y <= z ? vec3(0, 1, 0) : vec3(0, 0, 1);
        const Vec3 across = vec3_reject(axis, unit),
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
        remove_direction(rest, &left, row(basis, 0));
        memcpy(&basis[3], rest, 3 * sizeof *rest);
    }
    vec3_store(&basis[6], vec3_cross(row(basis, 0), row(basis, 1)));
}

/* Restrict node j to { gap + a.v >= 0 }, v its translation from its position in the round. */
static void add_half_space(CpsiLeastMotion *least, int j, double weight, Vec3 a, double gap) {
    CpsiUnilateral *half = &least->program.chain.unilateral;
    const int k = half->count++;
    half->node[k] = j;
    half->second[k] = true;
    half->weight[k] = weight;
    half->gap[k] = gap > 0 ? gap : 0;
    vec3_store(half->normal[k], a);
}

/* Restrict the motion along one axis of the friction of node j: slip keeps its sign, stick permits
 * none. */
static void restrict_along(CpsiLeastMotion *least, int j, double weight, double *basis,
                           int *freedom, Vec3 axis, bool slips, double slip) {
    if (slips && fabs(slip) > LEAST_SLIP)
        add_half_space(least, j, weight, vec3_scale(slip > 0 ? 1 : -1, axis), fabs(slip));
    else
        remove_direction(basis, freedom, axis);
}

/* Restrict the motion in the tangent plane of contact c by its friction. A general friction set,
 * unless it is a segment, permits no more than the direction in which it slips. */
static void restrict_slip(const CpsiLine *line, CpsiLeastMotion *least, int c, double weight,
                          double *basis, int *freedom) {
    const int j = cpsi_line_node(line, c), mark = least->mark[c];
    const double *axes = cpsi_line_axes(line, c);
    const CpsiFrictionLaw *law = &line->friction_law[c];
    const Vec3 n = cpsi_line_friction_normal(line, c),
               from =
                   vec3_load(line->has_local_axes ? &line->base[3 * j] : &line->reference[3 * j]);
    const Vec3 u = vec3_sub(vec3_at(line->position, j), from);
    const Vec3 before = line->has_local_axes ? vec3_at(line->slip, c) : vec3(0, 0, 0);
    const Vec3 slip = vec3_scale(1 / line->length, vec3_add(before, vec3_reject(u, n)));
    Vec3 along[2] = {row(axes, 0), row(axes, 1)};
    bool acts[2] = {law->given || law->ratio[0] > 0, law->given || law->ratio[1] > 0},
         slips[2] = {mark & SLIPS, mark & (law->box ? SLIPS_ACROSS : SLIPS)};
    if (law->given && cpsi_friction_set_conic(law->given)->unknowns == 1) {
        const double *p = cpsi_friction_set_conic(law->given)->p, size = hypot(p[0], p[1]);
        const Vec3 x = along[0], y = along[1];
        along[0] = vec3_axpy(p[0] / size, x, vec3_scale(p[1] / size, y));
        along[1] = vec3_cross(n, along[0]);
        acts[1] = false;
    } else if (!law->box && acts[0] && acts[1]) {
        const double size = vec3_norm(slip);
        if (!slips[0] || size <= LEAST_SLIP) {
            remove_direction(basis, freedom, along[0]);
            remove_direction(basis, freedom, along[1]);
            return;
        }
        const Vec3 unit = vec3_scale(1 / size, slip);
        remove_direction(basis, freedom, vec3_cross(n, unit));
        add_half_space(least, j, weight, unit, size);
        return;
    }
    for (int a = 0; a < 2; a++)
        if (acts[a])
            restrict_along(least, j, weight, basis, freedom, along[a], slips[a],
                           vec3_dot(slip, along[a]));
}

/* Restrict the motion of a cluster by contact c. */
static void restrict_contact(const CpsiLine *line, CpsiLeastMotion *least, int c, CpsiBounds bounds,
                             double *basis, int *freedom) {
    const int j = cpsi_line_node(line, c), mark = least->mark[c];
    const double weight = cpsi_line_share(line, j) / line->length;
    const Vec3 n = vec3_at(line->normal, c);
    if (mark & ACTIVE) {
        remove_direction(basis, freedom, n);
    } else if (isfinite(line->gap[c])) {
        const Vec3 u = vec3_sub(vec3_at(line->position, j), vec3_at(line->reference, j));
        add_half_space(least, j, weight, n, (line->gap[c] + vec3_dot(n, u)) / line->length);
    }
    /* a coupled bound is zero without a reaction */
    if ((mark & FRICTION) && (bounds == CPSI_BOUNDS_FIXED || (mark & ACTIVE)))
        restrict_slip(line, least, c, weight, basis, freedom);
}

/* A field keeps a node where it is in the directions that it resists. */
static void restrict_by_field(const CpsiLine *line, int j, double *basis, int *freedom) {
    Vec3 range[3];
    const int rank = cpsi_field_range(&line->field.stiffness[6 * j], range);
    for (int i = 0; i < rank; i++) remove_direction(basis, freedom, range[i]);
}

/* Build the clusters, their free directions, and the position that each would take by itself:
 * translated by the mean displacement of its nodes back to the reference. Returns whether any may
 * move. */
static bool build_clusters(const CpsiLine *line, CpsiLeastMotion *least, CpsiBounds bounds) {
    CpsiNearestProgram *program = &least->program;
    bool any = false;
    int count = 0;
    program->chain.unilateral.count = 0;
    for (int first = 0, end; first < line->n; first = end, count++) {
        double *basis = &least->basis[9 * count], weight = 0;
        int *freedom = &program->freedom[count];
        Vec3 back = vec3(0, 0, 0), shift = vec3(0, 0, 0);
        *freedom = 3;
        complete(basis, 3);
        for (end = first; end < line->n && (end == first || !least->slack[end]); end++) {
            const double share = cpsi_line_share(line, end);
            const Vec3 u = vec3_sub(vec3_at(line->position, end), vec3_at(line->reference, end));
            least->cluster[end] = count;
            back = vec3_axpy(-share, u, back);
            weight += share;
            if (cpsi_line_is_held(line, end) || cpsi_line_is_in_set(line, end)) *freedom = 0;
            if (cpsi_line_has_field(line)) restrict_by_field(line, end, basis, freedom);
            for (int c = end; c < cpsi_line_contacts(line); c += line->n)
                restrict_contact(line, least, c, bounds, basis, freedom);
        }
        complete(basis, *freedom);
        program->weight[count] = weight / line->length;
        back = vec3_scale(1 / weight, back);
        for (int i = 0; i < *freedom; i++)
            shift = vec3_axpy(vec3_dot(row(basis, i), back), row(basis, i), shift);
        for (int j = first; j < end; j++)
            vec3_store(&least->place[3 * j], vec3_add(vec3_at(line->position, j), shift));
        if (end == first + 1 &&
            *freedom > 0) { /* one node: computed from the reference, with fewer roundings */
            Vec3 place = vec3_at(line->reference, first);
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

/* The largest violation of constraints by `place`, per length of the line: elements too long,
 * half-spaces left. 0 where there is none. */
static double violation(const CpsiLine *line, const CpsiLeastMotion *least) {
    const CpsiUnilateral *half = &least->program.chain.unilateral;
    double size = 0, most = 0;
    for (int j = 0; j < 3 * line->n; j++) most = fmax(most, fabs(least->place[j]));
    const double lost = 4 * DBL_EPSILON * most; /* [m] */
    for (int i = 1; i < line->n; i++) {
        if (!least->slack[i]) continue;
        const double l = line->element_length[i - 1];
        const double over =
            vec3_norm(vec3_sub(vec3_at(least->place, i), vec3_at(least->place, i - 1))) / l - 1;
        if (over * l > ROUNDING * l + lost) size = cpsi_max_nan(size, over * l / line->length);
    }
    for (int k = 0; k < half->count; k++)
        if (half->gap[k] < -ROUNDING - lost / line->length)
            size = cpsi_max_nan(size, -half->gap[k]);
    return size;
}

/* Express the half-spaces in the free directions of the clusters, from their new positions; those
 * without a free component are dropped. */
static void project_half_spaces(const CpsiLine *line, CpsiLeastMotion *least) {
    CpsiNearestProgram *program = &least->program;
    CpsiUnilateral *half = &program->chain.unilateral;
    int kept = 0;
    for (int k = 0; k < half->count; k++) {
        const int j = half->node[k], cluster = least->cluster[j];
        const Vec3 n = vec3_load(half->normal[k]);
        const Vec3 shift = vec3_sub(vec3_at(least->place, j), vec3_at(line->position, j));
        double own[3] = {0}, size = 0;
        for (int a = 0; a < program->freedom[cluster]; a++) {
            own[a] = vec3_dot(row(&least->basis[9 * cluster], a), n);
            size += own[a] * own[a];
        }
        if (!(sqrt(size) > PARALLEL)) continue;
        half->node[kept] = cluster;
        half->weight[kept] = half->weight[k];
        half->gap[kept] = half->gap[k] + vec3_dot(n, shift) / line->length;
        memcpy(half->normal[kept], own, sizeof own);
        kept++;
    }
    half->count = kept;
}

/* Write the program: the unknowns are the displacements of the clusters from `place`, the first
 * guess is the configuration of the round. */
static void fill(const CpsiLine *line, CpsiLeastMotion *least, double size) {
    CpsiNearestProgram *program = &least->program;
    CpsiChainProgram *chain = &program->chain;
    cpsi_chain_program_resize(chain, chain->n, true);
    chain->segment.compliance = 0;
    chain->segment.compliance_factor = NULL;
    chain->segment.springs.count = 0;
    program->size = size;
    memcpy(chain->frame, least->basis, 9 * (size_t)chain->n * sizeof *chain->frame);
    memset(chain->base.load, 0, 3 * (size_t)chain->n * sizeof *chain->base.load);
    for (int j = 0; j < line->n; j++) {
        const int k = least->cluster[j];
        if (j > 0 && least->cluster[j - 1] == k) continue;
        const Vec3 at = vec3_at(line->position, j);
        const Vec3 back = vec3_scale(1 / line->length, vec3_sub(at, vec3_at(least->place, j)));
        chain->held[k] = program->freedom[k] == 0;
        for (int a = 0; a < 3; a++)
            chain->base.u[3 * k + a] =
                a < program->freedom[k] ? vec3_dot(row(&least->basis[9 * k], a), back) : 0;
        if (k == 0) continue;
        const double l = line->element_length[j - 1];
        chain->segment.length[k] = l / line->length;
        vec3_store(&chain->segment.s[k][1],
                   vec3_scale(1 / l, vec3_sub(at, vec3_at(line->position, j - 1))));
    }
}

/* Solve it and move `place` to the solution. False where it is not solved. */
static bool solve(const CpsiLine *line, CpsiLeastMotion *least, double size, int most,
                  int *iterations) {
    fill(line, least, size);
    CpsiNearestProgram *program = &least->program;
    const CpsiIpmOptions options = {.target = TARGET,
                                    .scale = 1,
                                    .max_iterations = most,
                                    .centering_steps = CENTERING_STEPS,
                                    .sharpenings = REFINEMENT_STEPS};
    const CpsiIpmReport ipm = cpsi_ipm_solve(&program->chain.base, &options);
    *iterations += ipm.iterations;
    if (!(ipm.gap + ipm.residual + ipm.imbalance <= CLEAN)) return false;
    for (int j = 0; j < line->n; j++) {
        const int k = least->cluster[j];
        Vec3 place = vec3_at(least->place, j);
        for (int a = 0; a < program->freedom[k]; a++)
            place = vec3_axpy(line->length * program->chain.base.u[3 * k + a],
                              row(&least->basis[9 * k], a), place);
        vec3_store(&least->place[3 * j], place);
    }
    return true;
}

/* Move the line to `place`. A node that is below the plane of its contact by rounding is moved onto
 * it. */
static void accept_places(CpsiLine *line, const CpsiLeastMotion *least) {
    memcpy(line->position, least->place, 3 * (size_t)line->n * sizeof *line->position);
    for (int c = 0; c < cpsi_line_contacts(line); c++) {
        const int j = cpsi_line_node(line, c);
        if (least->program.freedom[least->cluster[j]] == 0 || (least->mark[c] & ACTIVE) ||
            !isfinite(line->gap[c]))
            continue;
        const Vec3 n = vec3_at(line->normal, c), x = vec3_at(line->position, j);
        const double gap = line->gap[c] + vec3_dot(n, vec3_sub(x, vec3_at(line->reference, j)));
        if (gap < 0) vec3_store(&line->position[3 * j], vec3_axpy(-gap, n, x));
    }
    for (int i = 1; i < line->n; i++)
        if (least->slack[i]) line->tension[i - 1] = 0;
}

/* Do elements have contacts in this round? Such a contact couples two nodes, for which clusters
 * have no constraint. */
static bool has_element_contacts(const CpsiLine *line, const CpsiChainProgram *program) {
    if (program)
        for (int k = 0; k < program->unilateral.count; k++)
            if (program->unilateral.contact[k] >= cpsi_line_contacts(line)) return true;
    return false;
}

static bool is_slack_somewhere(const CpsiLine *line, const CpsiChainProgram *program) {
    for (int i = 1; i < program->n; i++)
        if (!(program->segment.z[i][0] > NO_FORCE) && !cpsi_line_is_on_drum(line, i - 1))
            return true;
    return false;
}

void cpsi_places_as_found(CpsiLine *line, const CpsiChainProgram *program) {
    line->report.places = is_slack_somewhere(line, program) ? CPS_PLACES_ANY : CPS_PLACES_UNIQUE;
}

int cpsi_least_motion(CpsiLine *line, CpsiLeastMotion *least, const CpsiChainProgram *program,
                      CpsiBounds bounds, int max_iterations) {
    int iterations = 0;
    if (has_element_contacts(line, program)) {
        cpsi_places_as_found(line, program);
        return 0;
    }
    read_solution(line, least, program);
    line->report.places = CPS_PLACES_UNIQUE;
    const bool open = build_clusters(line, least, bounds);
    if (!open && program) return 0;
    project_half_spaces(line, least);
    const double size = violation(line, least);
    if (!open) { /* nothing can move, and the positions need not be admissible */
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
        const CpsiFrictionLaw *law = &line->friction_law[c];
        const bool across = k > 0 && disc->contact[k - 1] == c;
        const double *axes = cpsi_line_axes(line, c);
        const Vec3 slip = vec3_scale(1 / line->length, cpsi_line_slip(line, c));
        for (int a = 0; a < 2; a++)
            disc->s[k][1 + a] = (!law->box || across == (a == 1) ? law->ratio[a] : 0) *
                                vec3_dot(row(axes, a), slip);
    }
}
