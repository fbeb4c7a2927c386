/* SPDX-License-Identifier: BSD-3-Clause */
/* A step into a program and back (step_program.h).
 *
 * Lengths are divided by the line's length L, forces by a force F0 of the size of the tension to come. Unknown is the
 * displacement from `base` (the reference, or where the last round ended), in axes whose third is the normal of the
 * obstacle: one set of axes for a line on one plane, else each node's own. */
#include "cable/step_program.h"

#include <string.h>

#include "cable/rub_set.h"
#include "linsys/frame.h"

/* Friction below this share of the force scale is none: it could not be told from rounding. */
static const double LEAST_FRICTION = 1e-14;
/* Bounds that are tried are not less than this, per share of the line: what is to grow must be there. */
static const double LEAST_TRIED = 1e-12;

bool cpsi_is_held(const CpsiLine *line, int j) {
    return (j == 0 && line->end[CPS_END_A].kind == CPS_END_HELD) ||
           (j == line->n - 1 && line->end[CPS_END_B].kind == CPS_END_HELD);
}

static const double *base_of(const CpsiLine *line) { return line->follows ? line->base : line->reference; }

/* The first guess: the base, its ends moved to where they are held, the rest along in proportion. */
static void guess(const CpsiLine *line, CpsiChainProgram *program) {
    double shift[2][3] = {{0}};
    const int last = line->n - 1;
    const double *base = base_of(line);
    for (int end = 0; end < 2; end++) {
        if (line->end[end].kind != CPS_END_HELD) continue;
        for (int a = 0; a < 3; a++)
            shift[end][a] = (line->end[end].value[a] - base[3*(end ? last : 0) + a])/line->length;
    }
    for (int j = 0; j < line->n; j++) {
        const double b = line->arc_length[j]/line->length;
        double move[3];
        for (int a = 0; a < 3; a++)
            move[a] = j == 0 ? shift[0][a] : j == last ? shift[1][a] : (1 - b)*shift[0][a] + b*shift[1][a];
        cpsi_frame_to(&program->base.u[3*j], cpsi_line_axes(line, j), move);
    }
}

/* The shape of a node, its set being given as such. */
static void fill_shape(const CpsiLine *line, CpsiChainProgram *program, int j, const CpsiStepScale *scale) {
    CpsiShape *shape = &program->shape;
    const CpsiRubSet set = cpsi_rub_set(line, j);
    const double share = cpsi_line_share(line, j)/line->length;
    double way[3];
    cpsi_frame_to(way, cpsi_line_axes(line, j), &line->slide[3*j]);
    const int k = shape->count++;
    shape->node[k] = j;
    shape->weight[k] = share;
    shape->form[k] = cpsi_friction_set_shape(set.given);
    shape->stop[k] = isfinite(line->gap[j]) ? program->stop.count - 1 : -1;
    shape->friction[k] = set.friction;
    shape->bound[k] = line->friction_bound[j]/(scale->force*share);
    if (scale->bounds == CPSI_BOUNDS_TRIED) shape->bound[k] = fmax(shape->bound[k], LEAST_TRIED);
    for (int a = 0; a < 2; a++) shape->offset[k][a] = way[a]/line->length;
}

/* The rubs of a node: one, its map the ratios of an ellipse, or two for a box. */
static void fill_rubs(const CpsiLine *line, CpsiChainProgram *program, int j, const CpsiStepScale *scale) {
    CpsiRub *rub = &program->rub;
    const CpsiRubSet set = cpsi_rub_set(line, j);
    const double share = cpsi_line_share(line, j)/line->length;
    const int count = line->follows && set.box ? 2 : 1;
    double way[3] = {0};
    if (line->follows) cpsi_frame_to(way, cpsi_line_axes(line, j), &line->slide[3*j]);
    for (int i = 0; i < count; i++) {
        const int k = rub->count++;
        rub->node[k] = j;
        rub->weight[k] = share;
        rub->stop[k] = isfinite(line->gap[j]) ? program->stop.count - 1 : -1;
        rub->friction[k] = set.friction;
        rub->z[k][0] = line->friction_bound[j]/(scale->force*share);
        if (scale->bounds == CPSI_BOUNDS_TRIED) rub->z[k][0] = fmax(rub->z[k][0], LEAST_TRIED);
        if (!line->follows) continue;
        const bool first = !set.box || i == 0, second = !set.box || i == 1;
        const double map[4] = {first ? set.ratio[0] : 0, 0, 0, second ? set.ratio[1] : 0};
        memcpy(rub->map[k], map, sizeof map);
        rub->offset[k][0] = map[0]*way[0]/line->length;
        rub->offset[k][1] = map[3]*way[1]/line->length;
    }
}

static void fill_stop(const CpsiLine *line, CpsiChainProgram *program, int j, const CpsiStepScale *scale) {
    CpsiStop *stop = &program->stop;
    const double share = cpsi_line_share(line, j)/line->length;
    double gap = line->gap[j];
    if (line->follows)
        for (int a = 0; a < 3; a++)
            gap += line->normal[3*j + a]*(line->base[3*j + a] - line->reference[3*j + a]);
    const int k = stop->count++;
    stop->node[k] = j;
    stop->weight[k] = share;
    stop->gap[k] = gap/line->length;
    for (int a = 0; line->follows && a < 3; a++)
        stop->curvature[k][a] =
            scale->curved ? line->reaction[j]*line->curvature[3*j + a]*line->length/(scale->force*share) : 0;
}

static void fill_nodes(const CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale) {
    program->rub.count = program->stop.count = program->shape.count = 0;
    program->rub.follow = scale->bounds == CPSI_BOUNDS_FOLLOW;
    for (int j = 0; j < line->n; j++) {
        program->held[j] = cpsi_is_held(line, j);
        if (line->follows) memcpy(&program->frame[9*j], &line->axes[9*j], 9*sizeof *line->axes);
        cpsi_frame_to(&program->base.load[3*j], cpsi_line_axes(line, j), &line->load[3*j]);
        for (int a = 0; a < 3; a++) program->base.load[3*j + a] /= scale->force;
        const bool watched = isfinite(line->gap[j]);
        if (watched) fill_stop(line, program, j, scale);
        const bool rubs = scale->bounds == CPSI_BOUNDS_GIVEN
                              ? line->friction_bound[j] >= LEAST_FRICTION*scale->force
                              : watched && cpsi_rub_set(line, j).friction > 0;
        if (rubs && cpsi_rub_set(line, j).given) fill_shape(line, program, j, scale);
        else if (rubs) fill_rubs(line, program, j, scale);
    }
}

/* A node's displacement in the axes of the chain. */
static void common(const CpsiChainProgram *program, int j, double out[3]) {
    if (program->frame)
        cpsi_frame_from(out, &program->frame[9*j], &program->base.u[3*j]);
    else
        memcpy(out, &program->base.u[3*j], 3*sizeof *out);
}

static void fill_elements(const CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale) {
    CpsiStretch *st = &program->stretch;
    const double *base = base_of(line);
    st->compliance = line->compliance*scale->force;
    for (int i = 1; i < line->n; i++) {
        const double l = line->element_length[i - 1]*scale->longer;
        double dx[3], e[3], far[3], near[3];
        for (int a = 0; a < 3; a++) dx[a] = (base[3*i + a] - base[3*(i - 1) + a])/l;
        cpsi_frame_to(e, line->common, dx);
        common(program, i, far), common(program, i - 1, near);
        st->length[i] = l/line->length;
        for (int a = 0; a < 3; a++) st->s[i][1 + a] = e[a] + (far[a] - near[a])/st->length[i];
    }
}

void cpsi_step_program_fill(const CpsiLine *line, CpsiChainProgram *program, const CpsiStepScale *scale) {
    cpsi_chain_program_resize(program, line->n, line->follows);
    guess(line, program);
    fill_nodes(line, program, scale);
    fill_elements(line, program, scale);
}

/* unpack -------------------------------------------------------------------------------------------------------- */

static void unpack_positions(CpsiLine *line, const CpsiChainProgram *program) {
    const double *base = base_of(line);
    for (int j = 0; j < line->n; j++) {
        double u[3], shift[3];
        for (int a = 0; a < 3; a++) u[a] = line->length*program->base.u[3*j + a];
        if (!line->follows && isfinite(line->gap[j]) && u[2] < -line->gap[j]) u[2] = -line->gap[j];
        cpsi_frame_from(shift, cpsi_line_axes(line, j), u);
        for (int a = 0; a < 3; a++) line->position[3*j + a] = base[3*j + a] + shift[a];
    }
    for (int end = 0; end < 2; end++)
        if (line->end[end].kind == CPS_END_HELD)
            memcpy(&line->position[3*(end == CPS_END_A ? 0 : line->n - 1)], line->end[end].value,
                   sizeof line->end[end].value);
}

static void unpack_reactions(CpsiLine *line, const CpsiChainProgram *program, const CpsiStepScale *scale) {
    memset(line->reaction, 0, (size_t)line->n*sizeof *line->reaction);
    for (int k = 0; k < program->stop.count; k++)
        line->reaction[program->stop.node[k]] = scale->force*program->stop.weight[k]*program->stop.z[k];
}

/* The friction of a node: what its rubs add up to, kept inside the set. */
static void unpack_friction(CpsiLine *line, const CpsiChainProgram *program, const CpsiStepScale *scale) {
    const CpsiRub *rub = &program->rub;
    const bool follow = scale->bounds == CPSI_BOUNDS_FOLLOW;
    for (int j = 0; j < line->n; j++) {
        if (follow || line->friction_bound[j] < LEAST_FRICTION*scale->force) line->friction_bound[j] = 0;
        for (int a = 0; a < 3; a++) line->friction_force[3*j + a] = 0;
    }
    for (int k = 0; k < rub->count;) {
        const int j = rub->node[k];
        const CpsiRubSet set = cpsi_rub_set(line, j);
        double f[3] = {0};
        for (; k < rub->count && rub->node[k] == j; k++) {
            const double by = scale->force*rub->weight[k];
            f[0] += by*(rub->map ? rub->map[k][0] : 1)*rub->z[k][1];
            f[1] += by*(rub->map ? rub->map[k][3] : 1)*rub->z[k][2];
        }
        if (follow) line->friction_bound[j] = set.friction*line->reaction[j];
        cpsi_rub_clip(&set, line->friction_bound[j], line->friction_bound[j], f);
        cpsi_frame_from(&line->friction_force[3*j], cpsi_line_axes(line, j), f);
    }
    for (int k = 0; k < program->shape.count; k++) {
        const int j = program->shape.node[k];
        const CpsiRubSet set = cpsi_rub_set(line, j);
        const double by = scale->force*program->shape.weight[k];
        double f[3] = {0};
        cpsi_shape_force(&program->shape, k, f);
        f[0] *= by, f[1] *= by;
        if (follow) line->friction_bound[j] = set.friction*line->reaction[j];
        cpsi_rub_clip(&set, by*program->shape.bound[k], line->friction_bound[j], f);
        cpsi_frame_from(&line->friction_force[3*j], cpsi_line_axes(line, j), f);
    }
}

void cpsi_step_program_unpack(CpsiLine *line, const CpsiChainProgram *program, const CpsiStepScale *scale) {
    unpack_positions(line, program);
    unpack_reactions(line, program, scale);
    unpack_friction(line, program, scale);
    for (int i = 1; i < line->n; i++) {
        const double *z = program->stretch.z[i];
        const double force[3] = {-scale->force*z[1], -scale->force*z[2], -scale->force*z[3]};
        cpsi_frame_from(&line->segment_force[3*(i - 1)], line->common, force);
        line->tension[i - 1] = scale->force*z[0];
    }
}
