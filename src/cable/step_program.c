/* SPDX-License-Identifier: BSD-3-Clause */
/* From a step to a program and back (step_program.h).
 *
 * Lengths are divided by a length L, that of the line or of its network, forces by a force F0 of
 * the size of the tension to come. The unknowns are displacements from `base` (the reference, or
 * where the last round ended), in axes whose third is the normal of the obstacle: common axes for a
 * line on one plane, else axes of each node. */
#include "cable/step_program.h"

#include <string.h>

#include "cable/end_set.h"
#include "cable/field.h"
#include "cable/friction_law.h"
#include "cable/held.h"
#include "cable/soft.h"
#include "cable/winch.h"
#include "chain/frame.h"

/* Friction bounds below this share of the force scale count as zero: they cannot be distinguished
 * from rounding. */
static const double LEAST_FRICTION = 1e-14;
/* Least trial bound per share of the line: a bound of zero could not grow. */
static const double LEAST_TRIAL_BOUND = 1e-12;

/* Normals with an angle whose sine is below this count as parallel and form no corner. */
static const double PARALLEL = 1e-3;
/* A node nearer than this to two obstacles, per length of the line, may be in the corner between
 * them. */
static const double CORNER_RANGE = 1e-3;

static const double *base_of(const CpsiLine *line) {
    return line->has_local_axes ? line->base : line->reference;
}

/* [m] The gap of contact c at the base; INFINITY where it does not enter the program. */
static double open_gap(const CpsiLine *line, int c) {
    const int j = cpsi_line_node(line, c);
    double gap = line->gap[c];
    if (cpsi_line_element(line, c) >= 0) {
        const Vec3 u = vec3_sub(cpsi_line_place(line, line->base, c),
                                cpsi_line_place(line, line->reference, c));
        return gap + vec3_dot(vec3_at(line->normal, c), u);
    }
    if (line->has_local_axes)
        for (int a = 0; a < 3; a++)
            gap += line->normal[3 * c + a] * (line->base[3 * j + a] - line->reference[3 * j + a]);
    return gap;
}

/* The node of the program that contact c acts on: its own, or the point of its element. */
static int node_of(const CpsiLine *line, int c) {
    const int e = cpsi_line_element(line, c);
    return e < 0 ? cpsi_line_node(line, c) : line->n + e + 1;
}

/* Is contact c the second of its node? */
static bool is_second(const CpsiLine *line, int c) {
    return c >= line->n && c < cpsi_line_contacts(line);
}

/* The axes of node j: those of its first contact, or of the line. In a corner of two contacts x is
 * along the corner, so that the stiff directions are y and z; with a friction conic the axes of the
 * first contact are kept. */
static void fill_axes(const CpsiLine *line, CpsiChainProgram *program, int j) {
    double *axes = &program->frame[9 * j];
    memcpy(axes, &line->axes[9 * j], 9 * sizeof *axes);
    for (int i = 0, c = j; i < 2; i++, c += line->n)
        if (line->contacts < 2 || !(open_gap(line, c) <= CORNER_RANGE * line->length)) return;
    const Vec3 n = vec3_at(line->normal, j), other = vec3_at(line->normal, j + line->n);
    const Vec3 corner = vec3_cross(n, other);
    const double sine = vec3_norm(corner);
    if (sine < PARALLEL || line->friction_law[j].given) return;
    const Vec3 x = vec3_scale(1 / sine, corner);
    vec3_store(&axes[0], x);
    vec3_store(&axes[3], vec3_cross(n, x));
}

static const double *node_axes(const CpsiLine *line, const CpsiChainProgram *program, int j) {
    return program->frame ? &program->frame[9 * j] : line->common_axes;
}

/* The displacement of node j, an end or one that is held, to where it is to be. */
static void shift_of(const CpsiLine *line, const CpsiStepScale *scale, int j, double shift[3]) {
    const double *base = base_of(line);
    shift[0] = shift[1] = shift[2] = 0;
    if (!cpsi_line_is_held(line, j)) return;
    double place[3];
    vec3_store(place, cpsi_line_held_place(line, j));
    for (int a = 0; a < 3; a++) shift[a] = (place[a] - base[3 * j + a]) / scale->length;
}

/* The first guess: the base with its held nodes at their imposed positions and the other nodes
 * moved by linear interpolation. */
static void initial_guess(const CpsiLine *line, CpsiChainProgram *program,
                          const CpsiStepScale *scale) {
    const int last = line->n - 1;
    double shift[2][3];
    shift_of(line, scale, 0, shift[0]);
    for (int from = 0, to; from < last; from = to) {
        to = cpsi_line_next_held(line, from + 1);
        if (to > last) to = last;
        shift_of(line, scale, to, shift[1]);
        const double length = cpsi_line_length_between(line, from, to);
        for (int j = from; j <= to; j++) {
            const double b =
                length > 0 ? (line->arc_length[j] - line->arc_length[from]) / length : 0;
            double move[3];
            for (int a = 0; a < 3; a++)
                move[a] = j == from ? shift[0][a]
                          : j == to ? shift[1][a]
                                    : (1 - b) * shift[0][a] + b * shift[1][a];
            cpsi_frame_to(&program->base.u[3 * j], node_axes(line, program, j), move);
        }
        memcpy(shift[0], shift[1], sizeof shift[0]);
    }
}

/* The tangents (2, 3) of contact c, row by row, and its normal, in the axes of its node; the first
 * contact's normal is z. */
static void contact_axes(const CpsiLine *line, const CpsiChainProgram *program, int c,
                         double axes[9]) {
    static const double own[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const int j = node_of(line, c);
    memcpy(axes, own, sizeof own);
    if (j >= line->n) return;
    if (!program->frame) return;
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): is the frame a copy of the axes? */
    if (c == j && memcmp(&program->frame[9 * j], &line->axes[9 * j], sizeof own) == 0) return;
    cpsi_frame_relative(axes, &line->axes[9 * c], &program->frame[9 * j]);
    if (c == j) {
        axes[2] = axes[5] = axes[6] = axes[7] = 0;
        axes[8] = 1;
    }
}

/* The tangents of contact c's friction, and their normal, in the axes of its node: frozen friction
 * keeps its own. */
static void friction_axes(const CpsiLine *line, const CpsiChainProgram *program, int c,
                          double axes[9]) {
    if (!line->keeps_reference_axes)
        contact_axes(line, program, c, axes);
    else
        cpsi_frame_relative(axes, cpsi_line_axes(line, c), &program->frame[9 * node_of(line, c)]);
}

static double trial_bound_or(const CpsiStepScale *scale, double bound) {
    return scale->bounds == CPSI_BOUNDS_TRIAL ? fmax(bound, LEAST_TRIAL_BOUND) : bound;
}

/* The friction conic of a contact with a general friction set. */
static void fill_conic(const CpsiLine *line, CpsiChainProgram *program, int c,
                       const CpsiStepScale *scale) {
    CpsiFrictionConic *conic = &program->conic;
    const CpsiFrictionLaw *law = &line->friction_law[c];
    const int j = node_of(line, c), k = conic->count++;
    const double share = cpsi_line_contact_share(line, c) / scale->length;
    double slip[3], axes[9];
    cpsi_frame_to(slip, cpsi_line_axes(line, c), &line->slip[3 * c]);
    friction_axes(line, program, c, axes);
    conic->node[k] = j;
    conic->contact[k] = c;
    conic->second[k] =
        is_second(line, c) ||
        line->keeps_reference_axes; /* the tangents of a first contact are those of the node */
    conic->weight[k] = share;
    conic->form[k] = cpsi_friction_set_conic(law->given);
    conic->unilateral[k] = isfinite(line->gap[c]) ? program->unilateral.count - 1 : -1;
    conic->friction[k] = law->friction;
    conic->bound[k] = trial_bound_or(scale, line->friction_bound[c] / (scale->force * share));
    for (int a = 0; a < 2; a++) conic->offset[k][a] = slip[a] / scale->length;
    memcpy(conic->tangent[k], axes, sizeof conic->tangent[k]);
}

/* The friction discs of a contact: one, whose map holds the ratios of an ellipse, or two for a
 * box. */
static void fill_discs(const CpsiLine *line, CpsiChainProgram *program, int c,
                       const CpsiStepScale *scale) {
    CpsiFrictionDisc *disc = &program->disc;
    const CpsiFrictionLaw *law = &line->friction_law[c];
    const int j = node_of(line, c), count = line->has_local_axes && law->box ? 2 : 1;
    const double share = cpsi_line_contact_share(line, c) / scale->length;
    double slip[3] = {0}, axes[9];
    if (line->has_local_axes) {
        cpsi_frame_to(slip, cpsi_line_axes(line, c), &line->slip[3 * c]);
        friction_axes(line, program, c, axes);
    }
    for (int i = 0; i < count; i++) {
        const int k = disc->count++;
        disc->node[k] = j;
        disc->contact[k] = c;
        disc->weight[k] = share;
        disc->unilateral[k] = isfinite(line->gap[c]) ? program->unilateral.count - 1 : -1;
        disc->friction[k] = law->friction;
        disc->z[k][0] = trial_bound_or(scale, line->friction_bound[c] / (scale->force * share));
        if (line->has_local_axes)
            for (int a = 0; a < 2; a++) {
                const double ratio = !law->box || i == a ? law->ratio[a] : 0;
                for (int b = 0; b < 3; b++) disc->map[k][3 * a + b] = ratio * axes[3 * a + b];
                disc->offset[k][a] = ratio * slip[a] / scale->length;
            }
        if (disc->shape) disc->shape[k] = law->given ? cpsi_friction_set_shape(law->given) : NULL;
    }
}

/* The product of `by` and T^T (curvature) T as xx, xy, yy, xz, yz, zz; the rows of T are the
 * tangents. */
static void turn_curvature(double out[6], const double axes[9], const double curvature[3],
                           double by) {
    memset(out, 0, 6 * sizeof *out);
    cpsi_add_mapped(out, by, axes, curvature);
}

/* Does the wall round a line draw it back wherever it moves along it? Then its reaction is a
 * stiffness that no round leaves out. */
static bool draws_back(const CpsiLine *line, int c) {
    const double *k = &line->curvature[3 * c];
    return cpsi_line_obstacle(line, c)->form.inside && k[0] <= 0 && k[2] <= 0 &&
           k[0] * k[2] >= k[1] * k[1];
}

static void fill_unilateral(const CpsiLine *line, CpsiChainProgram *program, int c,
                            const CpsiStepScale *scale) {
    CpsiUnilateral *unilateral = &program->unilateral;
    const int j = node_of(line, c), k = unilateral->count++;
    const double share = cpsi_line_contact_share(line, c) / scale->length;
    unilateral->node[k] = j;
    unilateral->contact[k] = c;
    unilateral->second[k] = is_second(line, c);
    unilateral->weight[k] = share;
    const CpsiSoft soft = cpsi_soft_spring(line, c);
    unilateral->gap[k] = (open_gap(line, c) + soft.rest) / scale->length;
    const double gives = soft.stiffness * scale->length;
    if (unilateral->compliance)
        unilateral->compliance[k] = gives > 0 ? share * scale->force / gives : 0;
    if (!line->has_local_axes) return;
    double axes[9];
    contact_axes(line, program, c, axes);
    memcpy(unilateral->normal[k], &axes[6], sizeof unilateral->normal[k]);
    const bool turns = scale->reaction_stiffness || draws_back(line, c);
    turn_curvature(unilateral->curvature[k], axes, &line->curvature[3 * c],
                   turns && j < line->n ? line->reaction[c] * scale->length / (scale->force * share)
                                        : 0);
}

static void fill_contact(const CpsiLine *line, CpsiChainProgram *program, int c,
                         const CpsiStepScale *scale) {
    const bool watched = isfinite(line->gap[c]);
    if (watched) fill_unilateral(line, program, c, scale);
    const bool discs = scale->bounds == CPSI_BOUNDS_FIXED
                           ? line->friction_bound[c] >= LEAST_FRICTION * scale->force
                           : watched && line->friction_law[c].friction > 0;
    const CpsiFrictionSet *given = line->friction_law[c].given;
    if (discs && given && !(scale->by_newton && cpsi_friction_set_shape(given)))
        fill_conic(line, program, c, scale);
    else if (discs)
        fill_discs(line, program, c, scale);
}

static void fill_nodes(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepScale *scale) {
    program->disc.count = program->unilateral.count = program->conic.count = 0;
    program->bounds_coupled = scale->bounds == CPSI_BOUNDS_COUPLED;
    for (int j = 0; j < line->n; j++) {
        program->held[j] = cpsi_line_is_held(line, j);
        for (int c = j; c < cpsi_line_contacts(line); c += line->n)
            fill_contact(line, program, c, scale);
    }
}

/* The contacts of elements, at points in axes of their own. */
static void fill_points(const CpsiLine *line, CpsiChainProgram *program,
                        const CpsiStepScale *scale) {
    const int n = line->n, nodes = cpsi_line_contacts(line);
    bool any = false;
    for (int c = nodes; c < cpsi_line_all_contacts(line); c++) {
        const int i = c - nodes + 1; /* element i of the program; the last contact is none */
        const bool acts =
            line->obstacle_index[c] >= 0 && (isfinite(line->gap[c]) || line->friction_bound[c] > 0);
        if (i < n) program->node_frames.share[i] = acts ? line->beta[i - 1] : 0;
        if (!acts) continue;
        any = true;
        memcpy(&program->frame[9 * (n + i)], &line->axes[9 * c], 9 * sizeof *line->axes);
        fill_contact(line, program, c, scale);
    }
    if (any) cpsi_chain_program_use_points(program);
}

/* K of node j, which is given in common axes, in those of the node. */
static void fill_stiffness(const double given[6], const double *axes, double by, double out[6]) {
    static const int AT[9] = {0, 1, 3, 1, 2, 4, 3, 4, 5}, FROM[6] = {0, 1, 4, 2, 5, 8};
    double common[9], own[9];
    for (int i = 0; i < 9; i++) common[i] = by * given[AT[i]];
    cpsi_frame_turn(own, axes, common);
    for (int i = 0; i < 6; i++) out[i] = own[FROM[i]];
}

/* The loads with the force of the field at the base, and its K, in the axes of the nodes. */
static void fill_field(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepScale *scale) {
    static const double WORLD[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const double *base = base_of(line), over = 1 / scale->force, by = scale->length * over;
    /* NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): are the axes those of the world? */
    const bool turned = program->frame || memcmp(line->common_axes, WORLD, sizeof WORLD) != 0;
    for (int j = 0; j < line->n; j++) {
        const double *k = &line->field.stiffness[6 * j], *axes = node_axes(line, program, j);
        double *own = &line->field.program[6 * j], *load = &program->base.load[3 * j];
        const Vec3 force =
            vec3_add(vec3_at(line->load, j), cpsi_line_field_force(line, j, vec3_at(base, j)));
        double f[3];
        vec3_store(f, vec3_scale(over, force));
        if (turned) {
            cpsi_frame_to(load, axes, f);
            fill_stiffness(k, axes, by, own);
        } else {
            memcpy(load, f, sizeof f);
            for (int i = 0; i < 6; i++) own[i] = by * k[i];
        }
    }
    program->field = line->field.program;
}

void cpsi_step_program_fill_loads(const CpsiLine *line, CpsiChainProgram *program,
                                  const CpsiStepScale *scale) {
    if (cpsi_line_has_field(line)) {
        fill_field(line, program, scale);
        return;
    }
    for (int j = 0; j < line->n; j++) {
        double *load = &program->base.load[3 * j];
        cpsi_frame_to(load, node_axes(line, program, j), &line->load[3 * j]);
        for (int a = 0; a < 3; a++) load[a] /= scale->force;
    }
}

/* A node's displacement in the axes of the chain. */
static void in_common_axes(const CpsiChainProgram *program, int j, double out[3]) {
    if (program->frame)
        cpsi_frame_from(out, &program->frame[9 * j], &program->base.u[3 * j]);
    else
        memcpy(out, &program->base.u[3 * j], 3 * sizeof *out);
}

static void fill_elements(const CpsiLine *line, CpsiChainProgram *program,
                          const CpsiStepScale *scale) {
    CpsiSegment *st = &program->segment;
    const double *base = base_of(line);
    CpsiSpan span = {.to = 0};
    bool longer = line->grasp_count == 0;
    st->compliance = line->compliance * scale->force;
    st->compliance_factor = line->compliance_factor;
    st->springs.count = line->spring_count;
    st->springs.at = line->spring_at;
    st->springs.start = line->spring_start;
    st->springs.stiffness = line->spring_stiffness;
    if (line->spring_count > 0) {
        st->springs.longer = line->compliance / line->spring_compliance;
        st->springs.stiffer = 1 / (st->springs.longer * scale->force);
    }
    for (int i = 1; i < line->n; i++) {
        if (line->grasp_count > 0 && i - 1 == cpsi_line_next_held(line, i - 1))
            longer = cpsi_line_next_span(line, i - 1, &span) && cpsi_line_is_span_taut(line, &span);
        const double l = line->element_length[i - 1] * (longer ? scale->longer : 1);
        double dx[3], e[3], far[3], near[3];
        for (int a = 0; a < 3; a++) dx[a] = (base[3 * i + a] - base[3 * (i - 1) + a]) / l;
        cpsi_frame_to(e, line->common_axes, dx);
        in_common_axes(program, i, far);
        in_common_axes(program, i - 1, near);
        st->length[i] = l / scale->length;
        for (int a = 0; a < 3; a++) st->s[i][1 + a] = e[a] + (far[a] - near[a]) / st->length[i];
    }
}

void cpsi_step_program_fill(const CpsiLine *line, CpsiChainProgram *program,
                            const CpsiStepScale *scale) {
    cpsi_chain_program_resize(program, line->n, line->has_local_axes);
    program->drag = scale->drag;
    if (line->has_local_axes)
        for (int j = 0; j < line->n; j++) fill_axes(line, program, j);
    initial_guess(line, program, scale);
    fill_nodes(line, program, scale);
    cpsi_step_program_fill_loads(line, program, scale);
    cpsi_line_fill_sets(line, program, base_of(line),
                        program->frame ? program->frame : line->common_axes, !program->frame);
    if (line->element_contacts > 0) fill_points(line, program, scale);
    fill_elements(line, program, scale);
}

void cpsi_step_program_clear(const CpsiLine *line, CpsiChainProgram *program) {
    cpsi_chain_program_resize(program, line->n, line->has_local_axes);
    program->disc.count = program->unilateral.count = program->conic.count = 0;
    for (int i = 1; i < line->n; i++)
        for (int a = 0; a < 4; a++) {
            program->segment.s[i][a] = a == 0;
            program->segment.z[i][a] = 0;
        }
}

/* unpack --------------------------------------------------------------------------------------- */

void cpsi_step_program_unpack_positions(CpsiLine *line, const CpsiChainProgram *program,
                                        const CpsiStepScale *scale) {
    const double *base = base_of(line);
    const bool rigid = !line->has_local_axes && !cpsi_line_has_soft(line);
    for (int j = 0; j < line->n; j++) {
        double u[3], shift[3];
        for (int a = 0; a < 3; a++) u[a] = scale->length * program->base.u[3 * j + a];
        if (rigid && isfinite(line->gap[j]) && u[2] < -line->gap[j]) u[2] = -line->gap[j];
        cpsi_frame_from(shift, node_axes(line, program, j), u);
        for (int a = 0; a < 3; a++) line->position[3 * j + a] = base[3 * j + a] + shift[a];
    }
    cpsi_line_put_held(line, line->position);
}

static void unpack_reactions(CpsiLine *line, const CpsiChainProgram *program,
                             const CpsiStepScale *scale) {
    memset(line->reaction, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->reaction);
    memset(line->active, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->active);
    for (int k = 0; k < program->unilateral.count; k++) {
        const int c = program->unilateral.contact[k];
        line->reaction[c] = scale->force * program->unilateral.weight[k] * program->unilateral.z[k];
        line->active[c] = program->unilateral.z[k] > program->unilateral.s[k];
    }
}

/* The friction (f_x, f_y) of contact c, given inside the set of the bound `within`, kept inside its
 * own. */
static void store_friction(CpsiLine *line, int c, bool follow, double within, double f[3]) {
    const CpsiFrictionLaw *law = &line->friction_law[c];
    if (follow) line->friction_bound[c] = law->friction * line->reaction[c];
    cpsi_friction_law_clip(law, within > 0 ? within : line->friction_bound[c],
                           line->friction_bound[c], f);
    cpsi_frame_from(&line->friction_force[3 * c], cpsi_line_axes(line, c), f);
}

/* The friction of each contact: the sum of its friction discs, or the force of its friction
 * conic. */
static void unpack_friction(CpsiLine *line, const CpsiChainProgram *program,
                            const CpsiStepScale *scale) {
    const CpsiFrictionDisc *disc = &program->disc;
    const CpsiFrictionConic *conic = &program->conic;
    const bool follow = scale->bounds == CPSI_BOUNDS_COUPLED;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (follow || line->friction_bound[c] < LEAST_FRICTION * scale->force)
            line->friction_bound[c] = 0;
        for (int a = 0; a < 3; a++) line->friction_force[3 * c + a] = 0;
    }
    for (int k = 0; k < disc->count;) {
        const int c = disc->contact[k];
        const CpsiFrictionLaw *law = &line->friction_law[c];
        double f[3] = {0};
        for (int i = 0; k < disc->count && disc->contact[k] == c; k++, i++) {
            const double by = scale->force * disc->weight[k];
            for (int a = 0; a < 2; a++)
                f[a] += by * (!law->box || i == a ? law->ratio[a] : 0) * disc->z[k][1 + a];
        }
        store_friction(line, c, follow, 0, f);
    }
    for (int k = 0; k < conic->count; k++) {
        const double by = scale->force * conic->weight[k];
        double f[3] = {0};
        cpsi_friction_conic_force(conic, k, f);
        f[0] *= by;
        f[1] *= by;
        store_friction(line, conic->contact[k], follow, by * conic->bound[k], f);
    }
}

void cpsi_step_program_unpack(CpsiLine *line, const CpsiChainProgram *program,
                              const CpsiStepScale *scale) {
    cpsi_step_program_unpack_positions(line, program, scale);
    cpsi_line_unpack_sets(line, program, scale->force);
    unpack_reactions(line, program, scale);
    unpack_friction(line, program, scale);
    for (int i = 1; i < line->n; i++) {
        const double *z = program->segment.z[i];
        const double force[3] = {-scale->force * z[1], -scale->force * z[2], -scale->force * z[3]};
        cpsi_frame_from(&line->segment_force[3 * (i - 1)], line->common_axes, force);
        line->tension[i - 1] = scale->force * z[0];
    }
    cpsi_winch_unload(line);
}
