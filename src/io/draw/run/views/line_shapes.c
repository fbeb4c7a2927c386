/* SPDX-License-Identifier: BSD-3-Clause */
/* Plan views and elevations: the shapes of the lines.
 *
 * One step: colour is tension, a pale band under the line shows sticking and slipping, grey is the
 * initial configuration of the step. All steps: colour is the step. Plan views keep both scales
 * equal; elevations may exaggerate heights by a round factor that is printed. */
#include <math.h>
#include <string.h>

#include "io/draw/run/run_picture.h"
#include "io/draw/run/steps.h"

enum {
    MAX_FRAME_HEIGHT = 520,
    MIN_PLAN_HEIGHT = 220,
    LOW_HEIGHT = 210,
    COLOUR_LEVELS = 48,
    NAMED_LINES = 6,
    NAMED_POINTS = 12,
    FEW_LINES = 500 /* more are drawn thin, without marks at their points */
};

static const char COLOUR_STICK[] = "#9ad9c8", COLOUR_SLIP[] = "#ffb59b", COLOUR_AIR[] = "#d3b8f0",
                  COLOUR_START[] = "#c4c4c4", COLOUR_BODY[] = "#e3c98b";

/* largest of 1, 2, 5, 10, ... that is at most x */
static double round_down(double x) {
    const double power = pow(10, floor(log10(x))), lead = x / power;
    return power * (lead >= 5 ? 5 : lead >= 2 ? 2 : 1);
}

/* Place the view's ranges on the sheet; returns the exaggeration of heights. */
static double fit(const CpsiView *view, CpsiFrame *frame) {
    *frame = (CpsiFrame){.left = CPSI_FRAME_LEFT,
                         .top = CPSI_FRAME_TOP,
                         .width = CPSI_FRAME_WIDTH,
                         .x = {view->x[0], view->x[1]},
                         .y = {view->y[0], view->y[1]}};
    cpsi_range_pad(frame->x, 0.05);
    const double height = view->y[1] - view->y[0];
    double dx = frame->x[1] - frame->x[0];
    double factor = 1, scale = frame->width / dx; /* pixels per metre along x */

    /* heights: a round exaggeration where they would hardly be visible, none where they are only
     * rounding */
    const double natural = height * scale;
    if (!view->plan && !view->true_scale && natural > 1e-5 * frame->width && natural < LOW_HEIGHT)
        factor = round_down(LOW_HEIGHT / natural);
    const double most = 0.8 * MAX_FRAME_HEIGHT;
    if (natural * factor > most) scale *= most / (natural * factor);

    /* both ranges centred, filling the frame */
    frame->height = fmin(MAX_FRAME_HEIGHT, fmax(MIN_PLAN_HEIGHT, natural * factor * 1.3));
    dx = frame->width / scale;
    const double dy = frame->height / (scale * factor);
    const double mid_x = 0.5 * (frame->x[0] + frame->x[1]),
                 mid_y = 0.5 * (frame->y[0] + frame->y[1]);
    if (isfinite(dx) && isfinite(mid_x)) {
        frame->x[0] = mid_x - 0.5 * dx;
        frame->x[1] = mid_x + 0.5 * dx;
    }
    if (isfinite(dy) && isfinite(mid_y)) {
        frame->y[0] = mid_y - 0.5 * dy;
        frame->y[1] = mid_y + 0.5 * dy;
    }
    return factor;
}

typedef struct Pen {
    const CpsiView *view;
    const CpsiFrame *frame;
    FILE *out;
    CpsiLabels *labels;
} Pen;

static void draw_point(const Pen *pen, const double position[3]) {
    const Vec3 place = vec3_load(position);
    fprintf(pen->out, "%.1f,%.1f ", cpsi_frame_x(pen->frame, vec3_dot(pen->view->right, place)),
            cpsi_frame_y(pen->frame, vec3_dot(pen->view->up, place)));
}

/* points first..last of an array (points, 3) */
static void draw_polyline(const Pen *pen, const double *position, int first, int last,
                          const char *colour, double width, const char *more) {
    fprintf(pen->out,
            "<polyline fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" stroke-linejoin=\"round\" "
            "%s points=\"",
            colour, width, more);
    for (int i = first; i <= last; ++i) draw_point(pen, position + 3 * (size_t)i);
    fputs("\"/>\n", pen->out);
}

/* Runs of one colour as one path: what is said once for all takes most of the room of a short one.
 */
static void begin_path(const Pen *pen, const char *colour, double width) {
    fprintf(pen->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%.1f\" d=\"", colour,
            width);
}
static void add_to_path(const Pen *pen, const double *position, int first, int last) {
    fputs("M", pen->out);
    for (int i = first; i <= last; ++i) draw_point(pen, position + 3 * (size_t)i);
}
static void end_path(const Pen *pen) { fputs("\"/>\n", pen->out); }

static const char *band_colour(unsigned char state) {
    return state == CPSI_SHAPE_IN_AIR     ? COLOUR_AIR
           : state == CPS_NODE_STATE_SLIP ? COLOUR_SLIP
                                          : COLOUR_STICK;
}

static bool friction_in_air(const CpsResults *results, const CpsiSnapshot *snapshot) {
    for (int l = 0; l < results->line_count; ++l)
        if (memchr(snapshot->shape[l].state, CPSI_SHAPE_IN_AIR, (size_t)snapshot->shape[l].points))
            return true;
    return false;
}

/* runs of equal state as pale bands */
static void draw_states(const Pen *pen, const CpsiShape *shape) {
    for (int first = 0; first < shape->points;) {
        int last = first;
        while (last + 1 < shape->points && shape->state[last + 1] == shape->state[first]) ++last;
        const unsigned char state = shape->state[first];
        /* a band extends half way to its neighbours; up to the next point is accurate enough */
        const int to = last + 1 < shape->points ? last + 1 : last;
        if (state != CPS_NODE_STATE_FREE && state != CPS_NODE_STATE_UNRESOLVED && to > first)
            draw_polyline(pen, shape->position, first, to, band_colour(state), 11, "");
        first = last + 1;
    }
}

static int level_of(double tension, const double range[2]) {
    const double t = (tension - range[0]) / (range[1] - range[0]);
    return t >= 0 ? (int)fmin(COLOUR_LEVELS - 1, t * COLOUR_LEVELS) : 0;
}

/* runs of nearly equal tension as one polyline each */
static void draw_tension(const Pen *pen, const CpsiShape *shape, const double range[2]) {
    for (int first = 0; first + 1 < shape->points;) {
        const int level = level_of(shape->tension[first], range);
        int last = first + 1;
        while (last + 1 < shape->points && level_of(shape->tension[last], range) == level) ++last;
        draw_polyline(pen, shape->position, first, last,
                      cpsi_colour(CPSI_SCALE_TENSION, (level + 0.5) / COLOUR_LEVELS).hex, 3.4,
                      "stroke-linecap=\"round\"");
        first = last;
    }
}

/* The lines of a net after a step: one path for where they began, one for each colour. */
static void draw_net(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot,
                     const double range[2]) {
    for (int level = 0; level < COLOUR_LEVELS; ++level) {
        begin_path(pen, cpsi_colour(CPSI_SCALE_TENSION, (level + 0.5) / COLOUR_LEVELS).hex, 1);
        for (int l = 0; l < results->line_count; ++l) {
            const CpsiShape *shape = &snapshot->shape[l];
            for (int i = 0; i + 1 < shape->points; ++i)
                if (level_of(shape->tension[i], range) == level)
                    add_to_path(pen, shape->position, i, i + 1);
        }
        end_path(pen);
    }
}

/* A red cross: the line has parted here. */
#define CROSS "M-5 -5L5 5M-5 5L5 -5\" stroke=\"#d22\" stroke-width=\"2.2\" fill=\"none\"/>"

static void draw_parted(const Pen *pen, const double position[3]) {
    const Vec3 place = vec3_load(position);
    fprintf(pen->out, "<path transform=\"translate(%.1f %.1f)\" d=\"" CROSS,
            cpsi_frame_x(pen->frame, vec3_dot(pen->view->right, place)),
            cpsi_frame_y(pen->frame, vec3_dot(pen->view->up, place)));
}

static void draw_end(const Pen *pen, const double position[3], bool held, const char *name) {
    const Vec3 place = vec3_load(position);
    const double x = cpsi_frame_x(pen->frame, vec3_dot(pen->view->right, place));
    const double y = cpsi_frame_y(pen->frame, vec3_dot(pen->view->up, place));
    fprintf(pen->out,
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\" stroke=\"#222\" "
            "stroke-width=\"1.4\"/>",
            x, y, held ? "#222" : "#fff");
    /* on the side where there is space */
    const bool left = x > pen->frame->left + 0.8 * pen->frame->width;
    cpsi_svg_text(pen->out, left ? x - 7 : x + 7, y - 8, left ? CPSI_END : CPSI_START,
                  "font-size=\"11\" paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"3\"",
                  name);
}

/* A point where lines meet: a square, dark where it is held. */
static void draw_meeting_point(const Pen *pen, const CpsResults *results, int point,
                               const double position[3], const char *fill, double half, double edge,
                               bool named) {
    const Vec3 place = vec3_sub(vec3_load(position), vec3_load(results->origin));
    const double x = cpsi_frame_x(pen->frame, vec3_dot(pen->view->right, place));
    const double y = cpsi_frame_y(pen->frame, vec3_dot(pen->view->up, place));
    fprintf(pen->out,
            "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" "
            "stroke=\"#222\" stroke-width=\"%.1f\"/>",
            x - half, y - half, 2 * half, 2 * half, fill, edge);
    if (named) cpsi_label_put(pen->labels, pen->frame, x, y, results->point[point].name, pen->out);
}

static void name_body(const Pen *pen, const CpsResults *results, int body,
                      const CpsBodyReport *report) {
    const Vec3 place = vec3_sub(vec3_load(report->position), vec3_load(results->origin));
    cpsi_label_put(pen->labels, pen->frame,
                   cpsi_frame_x(pen->frame, vec3_dot(pen->view->right, place)),
                   cpsi_frame_y(pen->frame, vec3_dot(pen->view->up, place)),
                   results->body[body].name, pen->out);
}

static void draw_bodies(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot) {
    const CpsiRow *row = &results->row[snapshot->step];
    for (int i = 0; i < results->body_count; ++i)
        cpsi_picture_outline(results, pen->view, pen->frame, &row->body[i].report, i,
                             "fill=\"#e3c98b\" fill-opacity=\"0.75\" stroke=\"#6b5420\" "
                             "stroke-width=\"2\"",
                             pen->out);
}

/* What is drawn over all else: the axes of the bodies, and their names. */
static void draw_axes(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot) {
    const CpsiRow *row = &results->row[snapshot->step];
    for (int i = 0; i < results->body_count; ++i) {
        cpsi_picture_axes(results, pen->view, pen->frame, &row->body[i].report, pen->out);
        if (results->body_count <= NAMED_POINTS) name_body(pen, results, i, &row->body[i].report);
    }
}

static void draw_points(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot) {
    const CpsiRow *row = &results->row[snapshot->step];
    for (int i = 0; i < results->point_count; ++i) {
        const CpsPointReport *report = &row->point[i].report;
        draw_meeting_point(pen, results, i, report->position,
                           report->state == CPS_POINT_STATE_HELD      ? "#222"
                           : report->state == CPS_POINT_STATE_ON_BODY ? COLOUR_BODY
                                                                      : "#fff",
                           report->state == CPS_POINT_STATE_ON_BODY ? 3 : 4.5, 1.4,
                           results->point_count <= NAMED_POINTS);
    }
}

static void draw_ends(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot) {
    const CpsiRow *row = &results->row[snapshot->step];
    for (int l = 0; l < results->line_count; ++l) {
        const CpsiShape *shape = &snapshot->shape[l];
        const bool named = results->line_count > 1 && results->line_count <= NAMED_LINES;
        for (int e = 0; e < 2; ++e) {
            char name[64] = "";
            if (cpsi_results_point_of(results, row, l, e) != CPSI_AT_NO_POINT)
                continue; /* drawn once, with all */
            if (results->line_count <= NAMED_LINES)
                snprintf(name, sizeof name, "%.40s%s%s", named ? results->line_name[l] : "",
                         named ? "." : "", e ? "B" : "A");
            const double *place = shape->position + (e ? 3 * (size_t)(shape->points - 1) : 0);
            draw_end(pen, place, row->line[l].held[e], name);
            if (row->line[l].failure.release[e] == CPS_RELEASE_BY_BREAK) draw_parted(pen, place);
        }
    }
}

static bool all_ends_at_points(const CpsResults *results, const CpsiRow *row) {
    for (int l = 0; l < results->line_count; ++l)
        for (int e = 0; e < 2; ++e)
            if (cpsi_results_point_of(results, row, l, e) == CPSI_AT_NO_POINT) return false;
    return true;
}

static bool has_parted(const CpsResults *results, const CpsiRow *row) {
    for (int l = 0; l < results->line_count; ++l)
        for (int e = 0; e < 2; ++e)
            if (row->line[l].failure.release[e] == CPS_RELEASE_BY_BREAK) return true;
    return false;
}

static bool has_points_of(const CpsResults *results, CpsPointKind kind) {
    for (int i = 0; i < results->point_count; ++i)
        if (results->point[i].kind == kind) return true;
    return false;
}

#define SQUARE(fill)                                                          \
    "<rect x=\"-4.5\" y=\"-4.5\" width=\"9\" height=\"9\" fill=\"" fill "\" " \
    "stroke=\"#222\" stroke-width=\"1.4\"/>"

static void draw_step_legend(const CpsResults *results, const CpsiRow *row, bool air, double y,
                             FILE *out) {
    char mark[160];
    double x = CPSI_FRAME_LEFT;
    snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"2\"/>",
             COLOUR_START);
    cpsi_legend(out, &x, y, mark, "start of the step");
    if (results->obstacle_count > 0) {
        snprintf(mark, sizeof mark,
                 "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"11\"/>", COLOUR_STICK);
        cpsi_legend(out, &x, y, mark, "sticks");
        snprintf(mark, sizeof mark,
                 "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"11\"/>", COLOUR_SLIP);
        cpsi_legend(out, &x, y, mark, "slips");
        if (air) {
            snprintf(mark, sizeof mark,
                     "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"11\"/>", COLOUR_AIR);
            cpsi_legend(out, &x, y, mark, "friction in the air");
        }
        snprintf(mark, sizeof mark,
                 "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"3.4\"/>",
                 cpsi_colour(CPSI_SCALE_TENSION, 0.5).hex);
        cpsi_legend(out, &x, y, mark, "off the obstacle");
    }
    if (has_parted(results, row)) cpsi_legend(out, &x, y, "<path d=\"" CROSS, "parted");
    if (!all_ends_at_points(results, row)) {
        cpsi_legend(out, &x, y, "<circle r=\"4.5\" fill=\"#222\" stroke=\"#222\"/>", "held end");
        cpsi_legend(out, &x, y,
                    "<circle r=\"4.5\" fill=\"#fff\" stroke=\"#222\" stroke-width=\"1.4\"/>",
                    "free end");
    }
    const bool both = results->point_count > 0 && results->body_count == 0;
    if (both || has_points_of(results, CPS_POINT_KIND_HELD))
        cpsi_legend(out, &x, y, SQUARE("#222"), "held point");
    if (both || has_points_of(results, CPS_POINT_KIND_FREE))
        cpsi_legend(out, &x, y, SQUARE("#fff"), "free point");
    if (results->body_count > 0)
        cpsi_legend(out, &x, y,
                    "<rect x=\"-9\" y=\"-5\" width=\"18\" height=\"10\" fill=\"#e3c98b\" "
                    "stroke=\"#6b5420\" stroke-width=\"2\"/>",
                    "body");
}

/* Initial configuration of a step. Before a line is statically placed it has none: the solver's
 * first guess is not shown. */
static const double *start_of(const CpsResults *results, const CpsiSnapshot *snapshot, int line) {
    return snapshot->step == 0 && results->begins_static ? snapshot->shape[line].position
                                                         : snapshot->shape[line].reference;
}

/* Obstacles and axes; `more` is said of the heights. */
static void begin_frame(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                        int id, int step, const char *more, FILE *out) {
    char label[256];
    cpsi_frame_begin(out, frame, id);
    fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#fdfdfd\"/>\n",
            frame->left, frame->top, frame->width, frame->height);
    cpsi_picture_obstacles(results, view, frame, step, out);
    cpsi_picture_sets(results, view, frame, out);
    cpsi_frame_end(out);
    snprintf(label, sizeof label, "%s%s", view->y_label, more);
    cpsi_frame_axes(out, frame, view->x_label, label);
}

/* By how much heights are exaggerated, as it is said beside them. */
static void say_factor(double factor, char more[64]) {
    snprintf(more, 64, "%s", "");
    if (factor > 1) snprintf(more, 64, ", heights \xC3\x97 %.8g", factor);
}

/* axes, obstacles, subtitle: the beginning of both kinds of sheet; step as for
 * cpsi_picture_obstacles */
static void begin_sheet(const CpsResults *results, const CpsiView *view, CpsiFrame *frame, int step,
                        const char *what, FILE *out) {
    char subtitle[300], more[64];
    say_factor(fit(view, frame), more);
    snprintf(subtitle, sizeof subtitle, "%s%s%s", view->plan ? "Plan view" : "Elevation", more,
             what);
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, frame->top + frame->height + 88,
                   *results->title ? results->title : "capstan", subtitle);
    begin_frame(results, view, frame, 0, step, more, out);
}

static void draw_lines(const Pen *pen, const CpsResults *results, const CpsiSnapshot *snapshot,
                       const double range[2]) {
    for (int l = 0; l < results->line_count; ++l)
        draw_polyline(pen, start_of(results, snapshot, l), 0, snapshot->shape[l].points - 1,
                      COLOUR_START, 2, "");
    for (int l = 0; l < results->line_count; ++l) draw_states(pen, &snapshot->shape[l]);
    for (int l = 0; l < results->line_count; ++l) draw_tension(pen, &snapshot->shape[l], range);
}

void cpsi_picture_step(const CpsResults *results, const CpsiView *view,
                       const CpsiSnapshot *snapshot, FILE *out) {
    const CpsiRow *row = &results->row[snapshot->step];
    char what[160], label[32];
    CpsiFrame frame;
    snprintf(what, sizeof what, "  \xC2\xB7  step %d of %d: %.*s  \xC2\xB7  %s", snapshot->step + 1,
             results->planned_steps, 80, row->name, cps_outcome_name(row->report.outcome));
    begin_sheet(results, view, &frame, snapshot->step, what, out);

    double range[2];
    cpsi_tension_range(results, range);
    CpsiLabels labels = {0};
    const Pen pen = {view, &frame, out, &labels};
    cpsi_frame_begin(out, &frame, 1);
    draw_bodies(&pen, results, snapshot);
    if (results->line_count > FEW_LINES)
        draw_net(&pen, results, snapshot, range);
    else
        draw_lines(&pen, results, snapshot, range);
    cpsi_frame_end(out);
    draw_ends(&pen, results, snapshot);
    draw_axes(&pen, results, snapshot);
    if (results->line_count <= FEW_LINES) draw_points(&pen, results, snapshot);

    const CpsiUnit unit = cpsi_unit("N", range[1]);
    snprintf(label, sizeof label, "tension (%s)", unit.name);
    cpsi_frame_bar(out, &frame, CPSI_SCALE_TENSION, range[0] * unit.factor, range[1] * unit.factor,
                   label);
    if (results->line_count <= FEW_LINES)
        draw_step_legend(results, &results->row[snapshot->step], friction_in_air(results, snapshot),
                         frame.top + frame.height + 68, out);
    cpsi_svg_finish(out);
}

/* Is a point at an end of the line, or is it of all lines (-1)? */
static bool is_of(const CpsResults *results, const CpsiRow *row, int line, int point) {
    if (line < 0) return true;
    return cpsi_results_point_of(results, row, line, CPS_END_A) == point ||
           cpsi_results_point_of(results, row, line, CPS_END_B) == point;
}

/* Where the points are after each step, with their names at the last one; those of one line, or of
 * all (-1). */
static void draw_points_of_steps(const Pen *pen, const CpsResults *results, int line) {
    for (int s = 0; s < results->snapshot_count; ++s) {
        const bool last = s + 1 == results->snapshot_count;
        const CpsiRow *row = &results->row[results->snapshot[s].step];
        for (int i = 0; i < results->point_count; ++i)
            if (is_of(results, row, line, i))
                draw_meeting_point(pen, results, i, row->point[i].report.position,
                                   cpsi_step_colour(results, s).hex, 3, 0.6,
                                   last && (line >= 0 || results->point_count <= NAMED_POINTS));
    }
}

/* Where the bodies are after each step, in the same way. */
static void draw_bodies_of_steps(const Pen *pen, const CpsResults *results, int line) {
    for (int s = 0; s < results->snapshot_count; ++s)
        for (int i = 0; i < results->body_count; ++i) {
            const CpsiRow *row = &results->row[results->snapshot[s].step];
            const CpsBodyReport *report = &row->body[i].report;
            if (line >= 0 && !cpsi_results_is_on_body(results, row, line, i)) continue;
            const bool last = s + 1 == results->snapshot_count;
            char style[80];
            snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"1.2\"",
                     cpsi_step_colour(results, s).hex);
            cpsi_picture_outline(results, pen->view, pen->frame, report, i, style, pen->out);
            if (!last) continue;
            cpsi_picture_axes(results, pen->view, pen->frame, report, pen->out);
            if (line >= 0 || results->body_count <= NAMED_POINTS)
                name_body(pen, results, i, report);
        }
}

/* Lines from `first` to before `end`. */
static void draw_lines_of_steps(const Pen *pen, const CpsResults *results, int first, int end) {
    for (int l = first; l < end; ++l)
        draw_polyline(pen, start_of(results, &results->snapshot[0], l), 0,
                      results->snapshot[0].shape[l].points - 1, COLOUR_START, 3, "");
    for (int s = 0; s < results->snapshot_count; ++s)
        for (int l = first; l < end; ++l)
            draw_polyline(pen, results->snapshot[s].shape[l].position, 0,
                          results->snapshot[s].shape[l].points - 1,
                          cpsi_step_colour(results, s).hex, cpsi_step_width(results, s), "");
}

/* Of a net its first and its last step. */
static void draw_nets_of_steps(const Pen *pen, const CpsResults *results) {
    const int last = results->snapshot_count - 1;
    for (int s = 0; s <= last; s += last > 0 ? last : 1) {
        begin_path(pen, cpsi_step_colour(results, s).hex, 1);
        for (int l = 0; l < results->line_count; ++l) {
            const CpsiShape *shape = &results->snapshot[s].shape[l];
            add_to_path(pen, shape->position, 0, shape->points - 1);
        }
        end_path(pen);
    }
}

void cpsi_picture_steps(const CpsResults *results, const CpsiView *view, FILE *out) {
    char note[64], what[80], mark[160];
    CpsiFrame frame;
    cpsi_step_note(results, note, sizeof note);
    snprintf(what, sizeof what, "  \xC2\xB7  %s", note);
    begin_sheet(results, view, &frame, -1, what, out);

    CpsiLabels labels = {0};
    const Pen pen = {view, &frame, out, &labels};
    cpsi_frame_begin(out, &frame, 1);
    if (results->line_count > FEW_LINES)
        draw_nets_of_steps(&pen, results);
    else
        draw_lines_of_steps(&pen, results, 0, results->line_count);
    draw_bodies_of_steps(&pen, results, -1);
    if (results->line_count <= FEW_LINES) draw_points_of_steps(&pen, results, -1);
    cpsi_frame_end(out);
    cpsi_step_list(results, &frame, out);
    double x = CPSI_FRAME_LEFT;
    snprintf(mark, sizeof mark, "<line x1=\"-11\" x2=\"11\" stroke=\"%s\" stroke-width=\"3\"/>",
             COLOUR_START);
    cpsi_legend(out, &x, frame.top + frame.height + 68, mark, "where the first step started");
    if (results->point_count > 0 && results->line_count <= FEW_LINES)
        cpsi_legend(out, &x, frame.top + frame.height + 68, SQUARE("#fff"),
                    "points where lines meet");
    cpsi_svg_finish(out);
}

/* A line in its frame, which `y` is above. */
static void draw_plane(const CpsResults *results, const CpsiView *view, int line, double y,
                       FILE *out) {
    CpsiFrame frame;
    char more[64], title[160];
    say_factor(fit(view, &frame), more);
    frame.top = y;
    begin_frame(results, view, &frame, 2 * line, -1, more, out);
    CpsiLabels labels = {0};
    const Pen pen = {view, &frame, out, &labels};
    cpsi_frame_begin(out, &frame, 2 * line + 1);
    draw_lines_of_steps(&pen, results, line, line + 1);
    draw_bodies_of_steps(&pen, results, line);
    draw_points_of_steps(&pen, results, line);
    cpsi_frame_end(out);
    snprintf(title, sizeof title, "line %.80s%s", results->line_name[line], more);
    cpsi_svg_text(out, frame.left, y - 8, CPSI_START, "font-size=\"12\" font-weight=\"bold\"",
                  title);
    if (line == 0) cpsi_step_list(results, &frame, out);
}

enum { BESIDE_PLANES = 76 }; /* above a frame and below it, in pixels */

void cpsi_picture_planes(const CpsResults *results, FILE *out) {
    double height = CPSI_FRAME_TOP + 18;
    CpsiFrame frame;
    char note[64], subtitle[160];
    for (int l = 0; l < results->line_count; ++l) {
        const CpsiView view = cpsi_view_line(results, l);
        fit(&view, &frame);
        height += frame.height + BESIDE_PLANES;
    }
    cpsi_step_note(results, note, sizeof note);
    snprintf(subtitle, sizeof subtitle, "Each line in its own vertical plane  \xC2\xB7  %s", note);
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, height, *results->title ? results->title : "capstan",
                   subtitle);
    double y = CPSI_FRAME_TOP + 18;
    for (int l = 0; l < results->line_count; ++l) {
        const CpsiView view = cpsi_view_line(results, l);
        draw_plane(results, &view, l, y, out);
        fit(&view, &frame);
        y += frame.height + BESIDE_PLANES;
    }
    cpsi_svg_finish(out);
}
