/* SPDX-License-Identifier: BSD-3-Clause */
/* A step into a program and back (step_program.h).
 *
 * Lengths are divided by the line's length L, forces by a force F0 of the size of the tension to
 * come. Unknown is the displacement from `base` (the reference, or where the last round ended), in
 * axes whose third is the normal of the obstacle: one set of axes for a line on one plane, else
 * each node's own. */
#include "cable/step_program.h"

#include <string.h>

#include "cable/rub_set.h"
#include "linsys/frame.h"

/* Friction below this share of the force scale is none: it could not be told from rounding. */
static const double LEAST_FRICTION = 1e-14;
/* Bounds that are tried are not less than this, per share of the line: what is to grow must be
 * there. */
static const double LEAST_TRIED = 1e-12;

/* Normals whose sine is below this make no corner. */
static const double PARALLEL = 1e-3;
/* A node this near to two obstacles, per length of the line, may be in the corner between them. */
static const double BOTH = 1e-3;

static const double *base_of(const CpsiLine *line) {
    return line->follows ? line->base : line->reference;
}

/* [m] How far contact c is open at the base; INFINITY where it is not looked for. */
static double open_gap(const CpsiLine *line, int c) {
    const int j = cpsi_line_node(line, c);
    double gap = line->gap[c];
    if (cpsi_line_element(line, c) >= 0) {
        const Vec3 u = vec3_sub(cpsi_line_place(line, line->base, c),
                                cpsi_line_place(line, line->reference, c));
        return gap + vec3_dot(vec3_load(&line->normal[3 * c]), u);
    }
    for (int a = 0; line->follows && a < 3; a++)
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

/* The axes of node j: those of its first contact, or of the line. Where there are two, x lies along
 * the corner that they make, so that what is stiff stays in y and z; a shape keeps its own. */
static void fill_axes(const CpsiLine *line, CpsiChainProgram *program, int j) {
    double *axes = &program->frame[9 * j];
    memcpy(axes, &line->axes[9 * j], 9 * sizeof *axes);
    for (int i = 0, c = j; i < 2; i++, c += line->n)
        if (line->contacts < 2 || !(open_gap(line, c) <= BOTH * line->length)) return;
    const Vec3 n = vec3_load(&line->normal[3 * j]),
               other = vec3_load(&line->normal[3 * (j + line->n)]);
    const Vec3 corner = vec3_cross(n, other);
    const double sine = vec3_norm(corner);
    if (sine < PARALLEL || cpsi_rub_set(line, j).given) return;
    const Vec3 x = vec3_scale(1 / sine, corner);
    vec3_store(&axes[0], x);
    vec3_store(&axes[3], vec3_cross(n, x));
}

static const double *node_axes(const CpsiLine *line, const CpsiChainProgram *program, int j) {
    return program->frame ? &program->frame[9 * j] : line->common;
}

/* The first guess: the base, its ends moved to where they are held, the rest along in
 * proportion. */
static void guess(const CpsiLine *line, CpsiChainProgram *program) {
    double shift[2][3] = {{0}};
    const int last = line->n - 1;
    const double *base = base_of(line);
    for (int end = 0; end < 2; end++) {
        if (line->end[end].kind != CPS_END_HELD) continue;
        for (int a = 0; a < 3; a++)
            shift[end][a] =
                (line->end[end].value[a] - base[3 * (end ? last : 0) + a]) / line->length;
    }
    for (int j = 0; j < line->n; j++) {
        const double b = line->arc_length[j] / line->length;
        double move[3];
        for (int a = 0; a < 3; a++)
            move[a] = j == 0      ? shift[0][a]
                      : j == last ? shift[1][a]
                                  : (1 - b) * shift[0][a] + b * shift[1][a];
        cpsi_frame_to(&program->base.u[3 * j], node_axes(line, program, j), move);
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
    if (!program->frame ||
        (c == j && memcmp(&program->frame[9 * j], &line->axes[9 * j], sizeof own) == 0))
        return;
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
    if (!line->frozen)
        contact_axes(line, program, c, axes);
    else
        cpsi_frame_relative(axes, cpsi_line_axes(line, c), &program->frame[9 * node_of(line, c)]);
}

static double tried_or(const CpsiStepScale *scale, double bound) {
    return scale->bounds == CPSI_BOUNDS_TRIED ? fmax(bound, LEAST_TRIED) : bound;
}

/* The shape of a contact, its set being given as such. */
static void fill_shape(const CpsiLine *line, CpsiChainProgram *program, int c,
                       const CpsiStepScale *scale) {
    CpsiShape *shape = &program->shape;
    const CpsiRubSet set = cpsi_rub_set(line, c);
    const int j = node_of(line, c), k = shape->count++;
    const double share = cpsi_line_contact_share(line, c) / line->length;
    double way[3], axes[9];
    cpsi_frame_to(way, cpsi_line_axes(line, c), &line->slide[3 * c]);
    friction_axes(line, program, c, axes);
    shape->node[k] = j;
    shape->contact[k] = c;
    shape->second[k] =
        is_second(line, c) || line->frozen; /* a first one's tangents are those of the node */
    shape->weight[k] = share;
    shape->form[k] = cpsi_friction_set_shape(set.given);
    shape->stop[k] = isfinite(line->gap[c]) ? program->stop.count - 1 : -1;
    shape->friction[k] = set.friction;
    shape->bound[k] = tried_or(scale, line->friction_bound[c] / (scale->force * share));
    for (int a = 0; a < 2; a++) shape->offset[k][a] = way[a] / line->length;
    memcpy(shape->tangent[k], axes, sizeof shape->tangent[k]);
}

/* The rubs of a contact: one, its map the ratios of an ellipse, or two for a box. */
static void fill_rubs(const CpsiLine *line, CpsiChainProgram *program, int c,
                      const CpsiStepScale *scale) {
    CpsiRub *rub = &program->rub;
    const CpsiRubSet set = cpsi_rub_set(line, c);
    const int j = node_of(line, c), count = line->follows && set.box ? 2 : 1;
    const double share = cpsi_line_contact_share(line, c) / line->length;
    double way[3] = {0}, axes[9];
    if (line->follows) cpsi_frame_to(way, cpsi_line_axes(line, c), &line->slide[3 * c]);
    friction_axes(line, program, c, axes);
    for (int i = 0; i < count; i++) {
        const int k = rub->count++;
        rub->node[k] = j;
        rub->contact[k] = c;
        rub->weight[k] = share;
        rub->stop[k] = isfinite(line->gap[c]) ? program->stop.count - 1 : -1;
        rub->friction[k] = set.friction;
        rub->z[k][0] = tried_or(scale, line->friction_bound[c] / (scale->force * share));
        for (int a = 0; line->follows && a < 2; a++) {
            const double ratio = !set.box || i == a ? set.ratio[a] : 0;
            for (int b = 0; b < 3; b++) rub->map[k][3 * a + b] = ratio * axes[3 * a + b];
            rub->offset[k][a] = ratio * way[a] / line->length;
        }
    }
}

/* by T^T (curvature) T as xx, xy, yy, xz, yz, zz, the rows of T the tangents. */
static void turn_curvature(double out[6], const double axes[9], const double curvature[3],
                           double by) {
    memset(out, 0, 6 * sizeof *out);
    cpsi_add_mapped(out, by, axes, curvature);
}

static void fill_stop(const CpsiLine *line, CpsiChainProgram *program, int c,
                      const CpsiStepScale *scale) {
    CpsiStop *stop = &program->stop;
    const int j = node_of(line, c), k = stop->count++;
    const double share = cpsi_line_contact_share(line, c) / line->length;
    stop->node[k] = j;
    stop->contact[k] = c;
    stop->second[k] = is_second(line, c);
    stop->weight[k] = share;
    stop->gap[k] = open_gap(line, c) / line->length;
    if (!line->follows) return;
    double axes[9];
    contact_axes(line, program, c, axes);
    memcpy(stop->normal[k], &axes[6], sizeof stop->normal[k]);
    turn_curvature(stop->curvature[k], axes, &line->curvature[3 * c],
                   scale->curved && j < line->n
                       ? line->reaction[c] * line->length / (scale->force * share)
                       : 0);
}

static void fill_contact(const CpsiLine *line, CpsiChainProgram *program, int c,
                         const CpsiStepScale *scale) {
    const bool watched = isfinite(line->gap[c]);
    if (watched) fill_stop(line, program, c, scale);
    const bool rubs = scale->bounds == CPSI_BOUNDS_GIVEN
                          ? line->friction_bound[c] >= LEAST_FRICTION * scale->force
                          : watched && cpsi_rub_set(line, c).friction > 0;
    if (rubs && cpsi_rub_set(line, c).given)
        fill_shape(line, program, c, scale);
    else if (rubs)
        fill_rubs(line, program, c, scale);
}

static void fill_nodes(const CpsiLine *line, CpsiChainProgram *program,
                       const CpsiStepScale *scale) {
    program->rub.count = program->stop.count = program->shape.count = 0;
    program->rub.follow = scale->bounds == CPSI_BOUNDS_FOLLOW;
    for (int j = 0; j < line->n; j++) {
        program->held[j] = cpsi_line_is_held(line, j);
        cpsi_frame_to(&program->base.load[3 * j], node_axes(line, program, j), &line->load[3 * j]);
        for (int a = 0; a < 3; a++) program->base.load[3 * j + a] /= scale->force;
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
            line->on[c] >= 0 && (isfinite(line->gap[c]) || line->friction_bound[c] > 0);
        if (i < n) program->own.share[i] = acts ? line->beta[i - 1] : 0;
        if (!acts) continue;
        any = true;
        memcpy(&program->frame[9 * (n + i)], &line->axes[9 * c], 9 * sizeof *line->axes);
        fill_contact(line, program, c, scale);
    }
    if (any) cpsi_chain_program_use_points(program);
}

/* A node's displacement in the axes of the chain. */
static void common(const CpsiChainProgram *program, int j, double out[3]) {
    if (program->frame)
        cpsi_frame_from(out, &program->frame[9 * j], &program->base.u[3 * j]);
    else
        memcpy(out, &program->base.u[3 * j], 3 * sizeof *out);
}

static void fill_elements(const CpsiLine *line, CpsiChainProgram *program,
                          const CpsiStepScale *scale) {
    CpsiStretch *st = &program->stretch;
    const double *base = base_of(line);
    st->compliance = line->compliance * scale->force;
    for (int i = 1; i < line->n; i++) {
        const double l = line->element_length[i - 1] * scale->longer;
        double dx[3], e[3], far[3], near[3];
        for (int a = 0; a < 3; a++) dx[a] = (base[3 * i + a] - base[3 * (i - 1) + a]) / l;
        cpsi_frame_to(e, line->common, dx);
        common(program, i, far);
        common(program, i - 1, near);
        st->length[i] = l / line->length;
        for (int a = 0; a < 3; a++) st->s[i][1 + a] = e[a] + (far[a] - near[a]) / st->length[i];
    }
}

void cpsi_step_program_fill(const CpsiLine *line, CpsiChainProgram *program,
                            const CpsiStepScale *scale) {
    cpsi_chain_program_resize(program, line->n, line->follows);
    program->drag = scale->drag;
    for (int j = 0; line->follows && j < line->n; j++) fill_axes(line, program, j);
    guess(line, program);
    fill_nodes(line, program, scale);
    if (line->element_contacts > 0) fill_points(line, program, scale);
    fill_elements(line, program, scale);
}

void cpsi_step_program_clear(const CpsiLine *line, CpsiChainProgram *program) {
    cpsi_chain_program_resize(program, line->n, line->follows);
    program->rub.count = program->stop.count = program->shape.count = 0;
    for (int i = 1; i < line->n; i++)
        for (int a = 0; a < 4; a++) {
            program->stretch.s[i][a] = a == 0;
            program->stretch.z[i][a] = 0;
        }
}

/* unpack --------------------------------------------------------------------------------------- */

static void unpack_positions(CpsiLine *line, const CpsiChainProgram *program) {
    const double *base = base_of(line);
    for (int j = 0; j < line->n; j++) {
        double u[3], shift[3];
        for (int a = 0; a < 3; a++) u[a] = line->length * program->base.u[3 * j + a];
        if (!line->follows && isfinite(line->gap[j]) && u[2] < -line->gap[j]) u[2] = -line->gap[j];
        cpsi_frame_from(shift, node_axes(line, program, j), u);
        for (int a = 0; a < 3; a++) line->position[3 * j + a] = base[3 * j + a] + shift[a];
    }
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_HELD)
            memcpy(&line->position[3 * (end == CPS_END_A ? 0 : line->n - 1)], line->end[end].value,
                   sizeof line->end[end].value);
}

static void unpack_reactions(CpsiLine *line, const CpsiChainProgram *program,
                             const CpsiStepScale *scale) {
    memset(line->reaction, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->reaction);
    if (line->follows)
        memset(line->pressed, 0, (size_t)cpsi_line_all_contacts(line) * sizeof *line->pressed);
    for (int k = 0; k < program->stop.count; k++) {
        const int c = program->stop.contact[k];
        line->reaction[c] = scale->force * program->stop.weight[k] * program->stop.z[k];
        if (line->follows) line->pressed[c] = program->stop.z[k] > program->stop.s[k];
    }
}

/* The friction (f_x, f_y) of contact c, given inside the set of the bound `within`, kept inside its
 * own. */
static void put_friction(CpsiLine *line, int c, bool follow, double within, double f[3]) {
    const CpsiRubSet set = cpsi_rub_set(line, c);
    if (follow) line->friction_bound[c] = set.friction * line->reaction[c];
    cpsi_rub_clip(&set, within > 0 ? within : line->friction_bound[c], line->friction_bound[c], f);
    cpsi_frame_from(&line->friction_force[3 * c], cpsi_line_axes(line, c), f);
}

/* The friction of a contact: what its rubs add up to, or its shape's force. */
static void unpack_friction(CpsiLine *line, const CpsiChainProgram *program,
                            const CpsiStepScale *scale) {
    const CpsiRub *rub = &program->rub;
    const CpsiShape *shape = &program->shape;
    const bool follow = scale->bounds == CPSI_BOUNDS_FOLLOW;
    for (int c = 0; c < cpsi_line_all_contacts(line); c++) {
        if (follow || line->friction_bound[c] < LEAST_FRICTION * scale->force)
            line->friction_bound[c] = 0;
        for (int a = 0; a < 3; a++) line->friction_force[3 * c + a] = 0;
    }
    for (int k = 0; k < rub->count;) {
        const int c = rub->contact[k];
        const CpsiRubSet set = cpsi_rub_set(line, c);
        double f[3] = {0};
        for (int i = 0; k < rub->count && rub->contact[k] == c; k++, i++) {
            const double by = scale->force * rub->weight[k];
            for (int a = 0; a < 2; a++)
                f[a] += by * (!set.box || i == a ? set.ratio[a] : 0) * rub->z[k][1 + a];
        }
        put_friction(line, c, follow, 0, f);
    }
    for (int k = 0; k < shape->count; k++) {
        const double by = scale->force * shape->weight[k];
        double f[3] = {0};
        cpsi_shape_force(shape, k, f);
        f[0] *= by;
        f[1] *= by;
        put_friction(line, shape->contact[k], follow, by * shape->bound[k], f);
    }
}

void cpsi_step_program_unpack(CpsiLine *line, const CpsiChainProgram *program,
                              const CpsiStepScale *scale) {
    unpack_positions(line, program);
    unpack_reactions(line, program, scale);
    unpack_friction(line, program, scale);
    for (int i = 1; i < line->n; i++) {
        const double *z = program->stretch.z[i];
        const double force[3] = {-scale->force * z[1], -scale->force * z[2], -scale->force * z[3]};
        cpsi_frame_from(&line->segment_force[3 * (i - 1)], line->common, force);
        line->tension[i - 1] = scale->force * z[0];
    }
}
