/* SPDX-License-Identifier: BSD-3-Clause */
/* Maps of a system with two driven components: its answers at every driving velocity of a grid. The
 * first map shows gamma as colour and the resistance as arrows; each other map shows one velocity
 * parameter. */
#include <math.h>
#include <stdlib.h>

#include "base/status.h"
#include "capstan/results.h"
#include "io/draw/diagram.h"

enum { GRID = 41, LEVELS = 48, MOST_MAPS = 6, ARROWS = 4, SIDE = 300, GAP = 120, TOP = 96 };

typedef struct Maps {
    const CpsDriveFile *file;
    CpsDriveProgress *progress;
    void *user;
    int parameters;
    double *gamma, *resistance,
        *velocity; /* (GRID*GRID), (.., 2), (.., parameters); NaN where there is no motion */
} Maps;

static double grid(const CpsDriveSystem *s, int i) {
    return s->map_radius * (2.0 * i / (GRID - 1) - 1);
}

/* Velocities below this share of the largest of all maps are rounding: the square root of the error
 * of the bounds. */
static const double ROUNDING = 1e-7;

/* A parameter that is at rest everywhere has a uniform map. */
static void clear_rounding(Maps *m) {
    const size_t count = (size_t)GRID * GRID * (size_t)m->parameters;
    double most = m->file->system.map_radius;
    for (size_t i = 0; i < count; i++)
        if (isfinite(m->velocity[i])) most = fmax(most, fabs(m->velocity[i]));
    for (size_t i = 0; i < count; i++)
        if (fabs(m->velocity[i]) <= ROUNDING * most) m->velocity[i] = 0;
}

static CpsStatus solve_grid(Maps *m, CpsError *err) {
    const CpsDriveSystem *s = &m->file->system;
    CpsMotionOptions options = cps_motion_options_default();
    options.composition = false;
    for (int at = 0; at < GRID * GRID; at++) {
        const double w[2] = {grid(s, at % GRID), grid(s, at / GRID)};
        CpsMotion *motion = NULL;
        const CpsStatus status = cps_system_solve(s->system, w, &options, &motion, err);
        if (status != CPS_OK) return status;
        const CpsMotionReport r = cps_motion_report(motion);
        const bool none = r.outcome == CPS_MOTION_OUTCOME_NO_BALANCE ||
                          r.outcome == CPS_MOTION_OUTCOME_BLOCKED ||
                          r.outcome == CPS_MOTION_OUTCOME_NOT_ATTAINED;
        m->gamma[at] = none ? NAN : r.value;
        for (int k = 0; k < 2; k++)
            m->resistance[2 * at + k] = none ? NAN : cps_motion_resistance(motion)[k];
        for (int k = 0; k < m->parameters; k++)
            m->velocity[(size_t)at * (size_t)m->parameters + (size_t)k] =
                none ? NAN : cps_motion_velocity(motion)[k];
        cps_motion_destroy(motion);
        if (m->progress && (at + 1) % GRID == 0) m->progress(m->user, (at + 1) / GRID, GRID);
    }
    clear_rounding(m);
    return CPS_OK;
}

/* index of the interval of LEVELS that contains a value, -1: none */
static int level(double x, const double range[2]) {
    /* differences that are rounding are not shown */
    const double most = fmax(fabs(range[0]), fabs(range[1]));
    if (!isfinite(x)) return -1;
    if (!(range[1] - range[0] > 1e-9 * most)) return LEVELS / 2;
    return (int)((LEVELS - 1) * (x - range[0]) / (range[1] - range[0]) + 0.5);
}

/* a field as square cells, with one path for all cells of a colour and adjacent cells of a row
 * joined; the frame is GRID cells wide and high */
static void draw_field(FILE *out, const CpsiFrame *frame, const double *value, int stride,
                       CpsiScale scale) {
    double range[2] = {INFINITY, -INFINITY};
    for (int i = 0; i < GRID * GRID; i++)
        cpsi_range_include(range, value[(size_t)i * (size_t)stride]);
    const double cell = frame->width / GRID;
    fprintf(
        out,
        "<g shape-rendering=\"crispEdges\" transform=\"translate(%.1f %.1f) scale(%.5f %.5f)\">\n",
        frame->left, frame->top + frame->height, cell, -cell);
    for (int l = 0; l < LEVELS; l++) {
        bool some = false;
        for (int i = 0; i < GRID * GRID; i++) {
            int run = 0; /* number of adjacent cells */
            while (i % GRID + run < GRID &&
                   level(value[(size_t)(i + run) * (size_t)stride], range) == l)
                run++;
            if (run == 0) continue;
            if (!some)
                fprintf(out, "<path fill=\"%s\" d=\"", cpsi_colour(scale, l / (LEVELS - 1.0)).hex);
            fprintf(out, "M%d %dh%dv1h-%dz", i % GRID, i / GRID, run, run);
            i += run - 1;
            some = true;
        }
        if (some) fputs("\"/>\n", out);
    }
    fputs("</g>\n", out);
}

/* the range of a field as a bar below it */
static void draw_scale(FILE *out, const CpsiFrame *frame, const double *value, int stride,
                       CpsiScale scale, const char *unit) {
    double range[2] = {INFINITY, -INFINITY};
    char text[40];
    for (int i = 0; i < GRID * GRID; i++)
        cpsi_range_include(range, value[(size_t)i * (size_t)stride]);
    const double y = frame->top + frame->height + 52;
    for (int i = 0; i < 60; i++)
        fprintf(out, "<rect x=\"%.1f\" y=\"%.1f\" width=\"2.4\" height=\"9\" fill=\"%s\"/>",
                frame->left + 90 + 2 * i, y, cpsi_colour(scale, i / 59.0).hex);
    snprintf(text, sizeof text, "%.4g", fabs(range[0]) < 1e-9 * fabs(range[1]) ? 0 : range[0]);
    cpsi_svg_text(out, frame->left + 84, y + 9, CPSI_END, "font-size=\"11\" fill=\"#555\"", text);
    snprintf(text, sizeof text, "%.4g %s", fabs(range[1]) < 1e-9 * fabs(range[0]) ? 0 : range[1],
             unit);
    cpsi_svg_text(out, frame->left + 218, y + 9, CPSI_START, "font-size=\"11\" fill=\"#555\"",
                  text);
}

/* -G at every fourth point, all with the same scale */
static void draw_arrows(FILE *out, const CpsiFrame *frame, const Maps *m) {
    const CpsDriveSystem *s = &m->file->system;
    double most = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        const double l = hypot(m->resistance[2 * i], m->resistance[2 * i + 1]);
        if (isfinite(l)) most = fmax(most, l);
    }
    const double unit = most > 0 ? 2 * s->map_radius * (ARROWS * 0.9) / (GRID - 1) / most : 0;
    for (int iy = ARROWS / 2; iy < GRID; iy += ARROWS)
        for (int ix = ARROWS / 2; ix < GRID; ix += ARROWS) {
            const double *g = m->resistance + 2 * (size_t)(iy * GRID + ix);
            const double at[2] = {grid(s, ix), grid(s, iy)}, along[2] = {g[0] * unit, g[1] * unit};
            if (isfinite(along[0])) cpsi_draw_arrow(out, frame, at, along, "#1a1a1a", 1.1);
        }
}

static void draw_map(FILE *out, const Maps *m, int index, int columns) {
    const CpsDriveSystem *s = &m->file->system;
    const double half = s->map_radius * (1 + 1.0 / (GRID - 1));
    const int row = index / columns;
    const CpsiFrame frame = {.left = 84 + (SIDE + GAP) * (double)(index % columns),
                             .top = TOP + (SIDE + 130) * (double)row,
                             .width = SIDE,
                             .height = SIDE,
                             .x = {-half, half},
                             .y = {-half, half}};
    char text[160];
    const double *value = index ? m->velocity + (index - 1) : m->gamma;
    const int stride = index ? m->parameters : 1;
    const CpsiScale scale = index ? CPSI_SCALE_STEP : CPSI_SCALE_TENSION;
    cpsi_frame_axes(out, &frame, s->drive[0], s->drive[1]);
    cpsi_frame_begin(out, &frame, index);
    draw_field(out, &frame, value, stride, scale);
    if (index == 0) draw_arrows(out, &frame, m);
    cpsi_frame_end(out);
    snprintf(text, sizeof text,
             index ? "velocity map: %.60s" : "force map: gamma, and the resistance G as arrows",
             index ? s->parameter[index - 1] : "");
    cpsi_frame_title(out, &frame, text);
    draw_scale(out, &frame, value, stride, scale, index ? "" : "W");
}

static CpsStatus draw_maps(void *what, FILE *out, CpsError *err) {
    Maps *m = what;
    const CpsDriveSystem *s = &m->file->system;
    m->parameters = s->parameter_count < MOST_MAPS ? s->parameter_count : MOST_MAPS;
    const size_t cells = (size_t)GRID * GRID;
    m->gamma = malloc(cells * (3 + (size_t)m->parameters) * sizeof *m->gamma);
    if (!m->gamma) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    m->resistance = m->gamma + cells;
    m->velocity = m->resistance + 2 * cells;
    const CpsStatus status = solve_grid(m, err);
    const int maps = 1 + m->parameters,
              columns = maps < 4    ? maps
                        : maps == 4 ? 2
                                    : 3,
              rows = (maps + columns - 1) / columns;
    if (status == CPS_OK) {
        cpsi_svg_begin(
            out, 84 + columns * (SIDE + GAP) - GAP + 60, TOP + rows * (SIDE + 130) - 40,
            *m->file->title ? m->file->title : "driven system",
            "by least dissipation, at every driving velocity W (m/s; of an angle rad/s)");
        for (int i = 0; i < maps; i++) draw_map(out, m, i, columns);
        cpsi_svg_finish(out);
    }
    free(m->gamma);
    return status;
}

CpsStatus cps_drive_draw_system(const CpsDriveFile *file, CpsDriveProgress *progress, void *user,
                                FILE *out, CpsError *err) {
    if (!file || file->kind != CPS_DRIVE_SYSTEM || file->system.driven_count != 2)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "maps are drawn of a system with two driven components; found %d",
                         file ? file->system.driven_count : 0);
    if (file->system.parameter_count > 500)
        return cpsi_fail(err, CPS_ERR_LIMIT,
                         "maps are drawn of systems of up to 500 parameters; found %d",
                         file->system.parameter_count);
    Maps maps = {.file = file, .progress = progress, .user = user};
    return cpsi_draw_plain(draw_maps, &maps, out, err);
}
