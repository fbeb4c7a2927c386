/* SPDX-License-Identifier: BSD-3-Clause */
/* Sets to which ends of lines are held, in plan views and elevations: their outlines (history.h),
 * thin. */
#include <math.h>

#include "io/draw/run/run_picture.h"

void cpsi_picture_sets(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out) {
    CpsiOutlineWalk walk = {.reach = hypot(frame->x[1] - frame->x[0], frame->y[1] - frame->y[0])};
    while (cpsi_next_outline(results, &walk)) {
        fputs("<polyline fill=\"none\" stroke=\"#7a5c99\" stroke-width=\"1.2\" points=\"", out);
        for (int i = 0; i < walk.count; ++i)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, vec3_dot(view->right, walk.x[i])),
                    cpsi_frame_y(frame, vec3_dot(view->up, walk.x[i])));
        fputs("\"/>\n", out);
    }
}

void cpsi_view_include_sets(const CpsResults *results, double most, CpsiView *view) {
    for (int l = 0; l < results->line_count; ++l)
        for (int end = 0; end < 2; ++end) {
            const CpsConstraint *on = &results->line_constraint[l][end];
            const double *about = results->row[0].line[l].report.end[end].position;
            Vec3 x[CPSI_OUTLINE_POINTS];
            CpsiView with = *view;
            int count;
            for (int piece = 0; (count = cpsi_set_outline(on, vec3_load(about), 0, piece, x)) > 0;
                 ++piece)
                for (int i = 0; i < count; ++i) {
                    cpsi_range_include(with.x, vec3_dot(view->right, x[i]));
                    cpsi_range_include(with.y, vec3_dot(view->up, x[i]));
                }
            if (hypot(with.x[1] - with.x[0], with.y[1] - with.y[0]) <= most) *view = with;
        }
}
