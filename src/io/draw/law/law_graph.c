/* SPDX-License-Identifier: BSD-3-Clause */
/* Laws over velocity (see law_graph.h).
 *
 * The graph of a law of one component is a monotone curve with vertical pieces, where one velocity
 * has many forces. It is drawn through the ends of the set of forces at successive velocities.
 * Unbounded forces leave the frame. */
#include "io/draw/law/law_graph.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"
#include "io/draw/diagram.h"
#include "io/draw/svg.h"

enum {
    STEPS = 240,
    DIRECTIONS = 240,
    SPEEDS = 5,
    MOST_LISTED = 14,
    SIDE = 520,
    LEFT = 84,
    TOP = 76,
    LIST = 300
};

/* The range is the largest velocity given, times this factor; 1 m/s where none is given. */
static const double WIDER = 1.25;

/* Unbounded forces are drawn at a distance of this many frames. */
static const double FAR = 50;

typedef struct LawGraph {
    FILE *out;
    CpsError *err;
    const CpsSet *set;
    const CpsResistance *resistance;
    const CpsLawPicture *picture;
    int n, axis[2];
    double most;               /* speed */
    double *velocity, *centre; /* (n) scratch */
    CpsiFrame frame;
    CpsiUnit unit;
} LawGraph;

/* The forces at g->velocity; NULL where there are none. */
static CpsStatus forces_at(const LawGraph *g, CpsSet **forces, CpsSetAnswer *answer) {
    *forces = NULL;
    if (g->set) return cps_set_forces(g->set, g->velocity, 0, forces, answer, g->err);
    return cps_resistance_forces(g->resistance, g->velocity, 0, forces, answer, g->err);
}

/* ---- one component ---- */

/* Both ends of the set of forces at each velocity, the larger first; NAN where there are none. */
static CpsStatus sample(LawGraph *g, double (*end)[2]) {
    for (int i = 0; i <= STEPS; i++) {
        g->velocity[0] = g->most * (2.0 * i / STEPS - 1);
        CpsSet *forces = NULL;
        CpsSetAnswer answer;
        CpsSetExtent extent = {.low = NAN, .high = NAN};
        CpsStatus status = forces_at(g, &forces, &answer);
        if (status == CPS_OK && forces)
            status = cps_set_extent(forces, (double[]){1}, &extent, g->err);
        cps_set_release(forces);
        if (status != CPS_OK) return status;
        end[i][0] = extent.high;
        end[i][1] = extent.low;
    }
    return CPS_OK;
}

static void fit_graph(LawGraph *g, double (*end)[2]) {
    double y[2] = {0, 0};
    for (int i = 0; i <= STEPS; i++)
        for (int k = 0; k < 2; k++)
            if (isfinite(end[i][k])) cpsi_range_include(y, end[i][k]);
    for (int i = 0; i < g->picture->force_count; i++) cpsi_range_include(y, g->picture->force[i]);
    if (y[0] == y[1]) {
        y[0] = -1;
        y[1] = 1;
    }
    g->unit = cpsi_unit("N", fmax(-y[0], y[1]));
    for (int k = 0; k < 2; k++) y[k] *= g->unit.factor;
    cpsi_range_pad(y, 0.12);
    g->frame = (CpsiFrame){LEFT, TOP, SIDE, 0.75 * SIDE, {-g->most, g->most}, {y[0], y[1]}};
}

/* A force in the units of the frame; an unbounded one far outside. */
static double in_frame(const LawGraph *g, double force) {
    return isfinite(force) ? force * g->unit.factor
                           : copysign(FAR * (g->frame.y[1] - g->frame.y[0]), force);
}

/* The velocities at a force: a dot, or a thick line. */
static CpsStatus draw_force(const LawGraph *g, double force) {
    CpsSet *velocities = NULL;
    CpsSetAnswer answer;
    CpsSetExtent extent;
    const double y = in_frame(g, force);
    CpsStatus status =
        g->set ? cps_set_velocities(g->set, &force, 0, &velocities, &answer, g->err)
               : cps_resistance_velocities(g->resistance, &force, &velocities, &answer, g->err);
    if (status == CPS_OK && velocities)
        status = cps_set_extent(velocities, (double[]){1}, &extent, g->err);
    if (status == CPS_OK && velocities) {
        const double low = fmax(extent.low, -2 * g->most), high = fmin(extent.high, 2 * g->most);
        cpsi_draw_curve(g->out, &g->frame, 2, (double[]){low, y, high, y}, false,
                        "fill=\"none\" stroke=\"" CPSI_ORANGE "\" stroke-width=\"5\"");
        if (low == high)
            cpsi_draw_dot(g->out, &g->frame, (double[]){low, y}, 5, "fill=\"" CPSI_ORANGE "\"");
    }
    cps_set_release(velocities);
    return status;
}

static void draw_axis_lines(const LawGraph *g) {
    fprintf(g->out,
            "<path d=\"M%.1f %.1fH%.1f M%.1f %.1fV%.1f\" stroke=\"#aaa\" stroke-width=\"1\"/>\n",
            g->frame.left, cpsi_frame_y(&g->frame, 0), g->frame.left + g->frame.width,
            cpsi_frame_x(&g->frame, 0), g->frame.top, g->frame.top + g->frame.height);
}

static const char *title_of(const LawGraph *g) {
    if (g->picture->title && *g->picture->title) return g->picture->title;
    return g->set ? "friction law" : "resistance law";
}

static CpsStatus draw_graph(LawGraph *g) {
    double(*end)[2] = calloc(STEPS + 1, sizeof *end),
    *curve = calloc(4 * (STEPS + 1), sizeof *curve);
    CpsStatus status =
        end && curve ? sample(g, end) : cpsi_fail(g->err, CPS_ERR_MEMORY, "out of memory");
    if (status == CPS_OK) {
        char label[60];
        int points = 0;
        fit_graph(g, end);
        cpsi_svg_begin(g->out, LEFT + SIDE + 40, TOP + g->frame.height + 76, title_of(g),
                       "forces over velocity");
        snprintf(label, sizeof label, "force (%s, of a torque %s m)", g->unit.name, g->unit.name);
        cpsi_frame_axes(g->out, &g->frame, "velocity (m/s, of an angle rad/s)", label);
        cpsi_frame_begin(g->out, &g->frame, 1);
        draw_axis_lines(g);
        for (int i = 0; i <= STEPS; i++)
            for (int k = 0; k < 2 && !isnan(end[i][k]); k++, points++) {
                curve[2 * points] = g->most * (2.0 * i / STEPS - 1);
                curve[2 * points + 1] = in_frame(g, end[i][k]);
            }
        cpsi_draw_curve(g->out, &g->frame, points, curve, false,
                        "fill=\"none\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2.2\"");
        for (int i = 0; status == CPS_OK && i < g->picture->force_count; i++)
            status = draw_force(g, g->picture->force[i]);
        for (int i = 0; status == CPS_OK && i < g->picture->velocity_count; i++) {
            CpsSet *forces = NULL;
            CpsSetAnswer answer;
            CpsSetExtent extent;
            const double v = g->velocity[0] = g->picture->velocity[i];
            status = forces_at(g, &forces, &answer);
            if (status == CPS_OK && forces)
                status = cps_set_extent(forces, (double[]){1}, &extent, g->err);
            if (status == CPS_OK && forces) {
                const double at[4] = {v, in_frame(g, extent.low), v, in_frame(g, extent.high)};
                cpsi_draw_curve(g->out, &g->frame, 2, at, false,
                                "fill=\"none\" stroke=\"" CPSI_PLUM "\" stroke-width=\"5\"");
                if (extent.low == extent.high)
                    cpsi_draw_dot(g->out, &g->frame, at, 5, "fill=\"" CPSI_PLUM "\"");
            }
            cps_set_release(forces);
        }
        cpsi_frame_end(g->out);
        double x = LEFT;
        const double y = TOP + g->frame.height + 58;
        cpsi_legend(g->out, &x, y,
                    "<line x1=\"-11\" x2=\"11\" stroke=\"" CPSI_BLUE "\" stroke-width=\"2.2\"/>",
                    "forces at each velocity");
        if (g->picture->velocity_count > 0)
            cpsi_legend(g->out, &x, y, "<circle r=\"5\" fill=\"" CPSI_PLUM "\"/>",
                        "at a velocity asked for");
        if (g->picture->force_count > 0)
            cpsi_legend(g->out, &x, y, "<circle r=\"5\" fill=\"" CPSI_ORANGE "\"/>",
                        "velocities at a force");
        cpsi_svg_finish(g->out);
    }
    free(end);
    free(curve);
    return status;
}

/* ---- more components ---- */

/* A force for each direction of the plane at one speed, the middle of the set where there are
 * several; NAN where there is none. */
static CpsStatus sample_speed(LawGraph *g, double speed, double *curve) {
    for (int i = 0; i < DIRECTIONS; i++) {
        const double angle = 2 * CPSI_PI * (i + 0.5) / DIRECTIONS;
        CpsSet *forces = NULL;
        CpsSetAnswer answer;
        CpsSetFacts facts = {.outcome = CPS_SET_OUTCOME_INACCURATE};
        memset(g->velocity, 0, (size_t)g->n * sizeof *g->velocity);
        g->velocity[g->axis[0]] = speed * cos(angle);
        g->velocity[g->axis[1]] = speed * sin(angle);
        CpsStatus status = forces_at(g, &forces, &answer);
        if (status == CPS_OK && forces)
            status = cps_set_facts(forces, 0, &facts, g->centre, NULL, g->err);
        cps_set_release(forces);
        if (status != CPS_OK) return status;
        for (int k = 0; k < 2; k++)
            curve[2 * i + k] =
                facts.outcome == CPS_SET_OUTCOME_ANSWERED ? g->centre[g->axis[k]] : NAN;
    }
    return CPS_OK;
}

static CpsStatus draw_speeds(LawGraph *g) {
    double *curve = calloc(2 * SPEEDS * DIRECTIONS, sizeof *curve), x[2] = {0, 0}, y[2] = {0, 0};
    CpsStatus status = curve ? CPS_OK : cpsi_fail(g->err, CPS_ERR_MEMORY, "out of memory");
    for (int k = 0; status == CPS_OK && k < SPEEDS; k++)
        status = sample_speed(g, g->most * (k + 1) / SPEEDS, curve + 2 * k * DIRECTIONS);
    if (status == CPS_OK) {
        char labels[2][64], text[40], style[80];
        for (int i = 0; i < SPEEDS * DIRECTIONS; i++)
            if (isfinite(curve[2 * i]) && isfinite(curve[2 * i + 1])) {
                cpsi_range_include(x, curve[2 * i]);
                cpsi_range_include(y, curve[2 * i + 1]);
            }
        g->unit = cpsi_unit("N", fmax(fmax(-x[0], x[1]), fmax(-y[0], y[1])));
        for (int k = 0; k < 2; k++) {
            x[k] *= g->unit.factor;
            y[k] *= g->unit.factor;
        }
        cpsi_range_pad(x, 0.08);
        cpsi_range_pad(y, 0.08);
        g->frame = (CpsiFrame){LEFT, TOP, SIDE, SIDE, {x[0], x[1]}, {y[0], y[1]}};
        cpsi_frame_equal(&g->frame);
        for (int k = 0; k < 2; k++)
            snprintf(labels[k], sizeof labels[k], "force, component %d (%s)", g->axis[k] + 1,
                     g->unit.name);
        cpsi_svg_begin(g->out, LEFT + SIDE + LIST, TOP + SIDE + 56, title_of(g),
                       "forces at some speeds in all directions");
        cpsi_frame_axes(g->out, &g->frame, labels[0], labels[1]);
        cpsi_frame_begin(g->out, &g->frame, 1);
        draw_axis_lines(g);
        for (int k = 0; k < SPEEDS; k++) {
            double *one = curve + 2 * k * DIRECTIONS;
            int points = 0;
            for (int i = 0; i < DIRECTIONS; i++)
                if (isfinite(one[2 * i]) && isfinite(one[2 * i + 1])) {
                    one[2 * points] = one[2 * i] * g->unit.factor;
                    one[2 * points++ + 1] = one[2 * i + 1] * g->unit.factor;
                }
            snprintf(style, sizeof style, "fill=\"none\" stroke=\"%s\" stroke-width=\"2\"",
                     cpsi_colour(CPSI_SCALE_STEP, k / (SPEEDS - 1.0)).hex);
            cpsi_draw_curve(g->out, &g->frame, points, one, points == DIRECTIONS, style);
        }
        cpsi_frame_end(g->out);
        for (int k = 0; k < SPEEDS; k++) {
            snprintf(text, sizeof text, "at %.4g m/s", g->most * (k + 1) / SPEEDS);
            snprintf(style, sizeof style, "font-size=\"12\" fill=\"%s\"",
                     cpsi_colour(CPSI_SCALE_STEP, k / (SPEEDS - 1.0)).hex);
            cpsi_svg_text(g->out, LEFT + SIDE + 24, TOP + 12 + 17.0 * k, CPSI_START, style, text);
        }
        cpsi_svg_finish(g->out);
    }
    free(curve);
    return status;
}

/* ---- both ---- */

static CpsStatus draw(void *what, FILE *out, CpsError *err) {
    LawGraph *g = what;
    g->out = out;
    g->err = err;
    return g->n == 1 ? draw_graph(g) : draw_speeds(g);
}

/* marks a picture that was initialised by its default function */
static const uint32_t PICTURE_COOKIE = 0x50494354;

CpsLawPicture cps_law_picture_default(void) {
    return (CpsLawPicture){.cookie = PICTURE_COOKIE, .axis = {0, 1}};
}

CpsStatus cpsi_law_picture_check(const CpsLawPicture *picture, int n, CpsError *err) {
    const int *axis = picture->axis;
    if (picture->cookie != PICTURE_COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the picture was not made by cps_law_picture_default()");
    if (picture->velocity_count < 0 || picture->force_count < 0)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%d velocities and %d forces: no number may be negative",
                         picture->velocity_count, picture->force_count);
    if ((picture->velocity_count > 0 && !picture->velocity) ||
        (picture->force_count > 0 && !picture->force))
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "velocities or forces are counted, and NULL");
    if (n > 1 && (axis[0] < 0 || axis[1] < 0 || axis[0] >= n || axis[1] >= n || axis[0] == axis[1]))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "axes %d and %d are not two different components from 0 to %d", axis[0],
                         axis[1], n - 1);
    return CPS_OK;
}

CpsStatus cpsi_law_graph(const CpsSet *set, const CpsResistance *resistance,
                         const CpsLawPicture *picture, FILE *out, CpsError *err) {
    LawGraph g = {.set = set,
                  .resistance = resistance,
                  .picture = picture,
                  .axis = {picture->axis[0], picture->axis[1]}};
    g.n = set ? cps_set_space(set) : cps_resistance_space(resistance);
    for (int i = 0; i < picture->velocity_count * g.n; i++)
        g.most = fmax(g.most, WIDER * fabs(picture->velocity[i]));
    if (g.most == 0) g.most = 1;
    g.velocity = calloc(2 * (size_t)g.n, sizeof *g.velocity);
    if (!g.velocity) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    g.centre = g.velocity + g.n;
    const CpsStatus status = cpsi_draw_plain(draw, &g, out, err);
    free(g.velocity);
    return status;
}

CpsStatus cps_resistance_draw(const CpsResistance *law, const CpsLawPicture *picture, FILE *out,
                              CpsError *err) {
    if (!law || !picture || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "law, picture or out is NULL");
    const CpsStatus status = cpsi_law_picture_check(picture, cps_resistance_space(law), err);
    return status ? status : cpsi_law_graph(NULL, law, picture, out, err);
}
