/* SPDX-License-Identifier: BSD-3-Clause */
/* The report of a step (line_report.h). */
#include "cable/line_report.h"

#include <string.h>

#include "cable/contact.h"
#include "cable/rub_set.h"
#include "linsys/frame.h"

/* [J] by friction in the step. */
static double dissipated(const CpsiLine *line) {
    double sum = 0;
    for (int c = 0; c < cpsi_line_contacts(line); c++) {
        if (!(line->friction_bound[c] > 0)) continue;
        double slide[3], way[3];
        const CpsiRubSet set = cpsi_rub_set(line, c);
        vec3_store(slide, cpsi_line_slide(line, c));
        cpsi_frame_to(way, cpsi_line_axes(line, c), slide);
        sum += cpsi_rub_dissipation(&set, line->friction_bound[c], way);
    }
    return sum;
}

/* Free, stick or slip, and slack: of two complementary quantities, the one that is larger at its own scale is the one
 * that is not zero. */
void cpsi_line_classify(CpsiLine *line, const CpsiChainProgram *program) {
    const double weight = vec3_norm(vec3_load(line->weight));
    const double density = weight > 0 ? weight : line->report.certificate.largest_force/line->length;
    CpsLineReport *report = &line->report;
    memset(line->state, CPS_NODE_FREE, (size_t)cpsi_line_contacts(line));
    for (int k = 0; k < program->stop.count; k++) {
        const int c = program->stop.contact[k], j = program->stop.node[k];
        if (line->reaction[c] > density*cpsi_line_share(line, j)*program->stop.s[k]) line->state[c] = CPS_NODE_STICK;
    }
    for (int k = 0; k < program->rub.count; k++) {
        const int c = program->rub.contact[k];
        const double *z = program->rub.z[k], *s = program->rub.s[k], slide = sqrt(s[1]*s[1] + s[2]*s[2]);
        if (line->state[c] == CPS_NODE_STICK && slide*z[0] > z[0] - sqrt(z[1]*z[1] + z[2]*z[2]))
            line->state[c] = CPS_NODE_SLIP;
    }
    for (int k = 0; k < program->shape.count; k++) {
        const int c = program->shape.contact[k];
        if (line->state[c] == CPS_NODE_STICK && cpsi_shape_way(program, k) > cpsi_shape_margin(&program->shape, k))
            line->state[c] = CPS_NODE_SLIP;
    }
    for (int j = 0; j < line->n; j++) {
        bool touches = false, slips = false;
        for (int c = j; c < cpsi_line_contacts(line); c += line->n) {
            touches = touches || line->state[c] != CPS_NODE_FREE;
            slips = slips || line->state[c] == CPS_NODE_SLIP;
        }
        if (touches) report->grounded += cpsi_line_share(line, j);
        if (slips) report->slipping += cpsi_line_share(line, j);
    }
    report->dissipated = dissipated(line);
    for (int i = 1; i < line->n; i++) {
        const double *s = program->stretch.s[i], *z = program->stretch.z[i];
        if (z[0] < s[0] - sqrt(s[1]*s[1] + s[2]*s[2] + s[3]*s[3])) report->slack += line->element_length[i - 1];
    }
}

void cpsi_line_report_ends(CpsiLine *line) {
    for (int end = 0; end < 2; end++) {
        const int j = end == CPS_END_A ? 0 : line->n - 1, e = end == CPS_END_A ? 0 : line->n - 2;
        CpsEndReport *out = &line->report.end[end];
        memcpy(out->position, &line->position[3*j], sizeof out->position);
        Vec3 force = vec3_load(line->end[end].value);
        if (line->end[end].kind == CPS_END_HELD) {
            /* what the support does: the opposite of the element's pull and the node's own weight */
            const Vec3 pull = vec3_scale(end == CPS_END_A ? 1 : -1, vec3_load(&line->segment_force[3*e]));
            force = vec3_scale(-1, vec3_add(pull, vec3_load(&line->load[3*j])));
            /* an end that lies on the obstacle is carried by it */
            double gap;
            const int on = cpsi_line_nearest(line, vec3_load(out->position), &gap);
            const Vec3 n = on < 0 ? vec3(0, 0, 0) : cpsi_obstacle_normal(&line->obstacle[on], vec3_load(out->position));
            const double up = vec3_dot(force, n);
            if (up > 0 && gap <= CPSI_TOUCH*line->length) {
                line->reaction[j] = up;
                if (line->follows) line->on[j] = on;
                line->state[j] = CPS_NODE_STICK; /* let go in the next step, it starts with its friction */
                force = vec3_axpy(-up, n, force);
            }
        }
        vec3_store(out->force, force);
        out->tension = vec3_norm(force);
    }
}
