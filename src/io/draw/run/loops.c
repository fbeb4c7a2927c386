/* SPDX-License-Identifier: BSD-3-Clause */
/* The loops that force and displacement of a moved end describe.
 *
 * A loop is a run of stages that move a held end away and back to the same position, or, of a stage
 * in which the end swings, the last of its cycles, or all of it where it only comes back. With u
 * the displacement along the direction of the farthest point and F the force along it, the loop's
 * area is the work done on the line there, and in a steady cycle the dissipation of friction. The
 * figures of the picture are those of the ledger, which includes the substeps of every load step;
 * the curve is straight between steps and may enclose another area. A stiff line's loop is too thin
 * to be visible. The second frame therefore shows F minus the mean f(u) of the paths out and back.
 * This opens the loop and does not change its area, since the integral of f(u) du round a closed
 * path is 0. */
#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "io/base/text/escape.h"
#include "io/draw/run/run_picture.h"

/* Displacements closer than this share of the loop's width are equal. */
static const double SAME_DISPLACEMENT = 1e-6;

/* Ends closer than this share of the line's length are at the same position: far above the rounding
 * of imposed positions. */
static const double SAME_PLACE = 1e-9;

/* Places closer than this share of the way in a stage are the same in a cycle: above the error of
 * sums over a million steps. */
static const double SAME_CYCLE = 1e-7;

enum {
    MAX_LOOPS = 48,
    MAX_LOOP_STAGES = 1000,
    MAX_CYCLE_STEPS = 20000,
    FORCE_HEIGHT = 300,
    OPENED_HEIGHT = 260
};

/* Steps first..last (rows) of one end of one line that lead back to the initial position; row first
 * - 1, if there is one, is the state before. */
typedef struct Loop {
    int line, end, first_stage, last_stage;
    /* rows: the state before the loop, or its first step if there is none; its last step */
    int start, last;
    Vec3 direction;    /* unit vector to the farthest point */
    double work;       /* [J] done on the line at this end, by the ledger */
    double dissipated; /* [J] by friction on this line, by the ledger */
} Loop;

static const CpsEndReport *end_at(const CpsResults *results, const Loop *loop, int row) {
    return &results->row[row].line[loop->line].report.end[loop->end];
}

static Vec3 moved(const CpsResults *results, const Loop *loop, int row) {
    return vec3_sub(vec3_load(end_at(results, loop, row)->position),
                    vec3_load(end_at(results, loop, loop->start)->position));
}

static double along(const CpsResults *results, const Loop *loop, int row) {
    return vec3_dot(loop->direction, moved(results, loop, row));
}

static double force(const CpsResults *results, const Loop *loop, int row) {
    return vec3_dot(loop->direction, vec3_load(end_at(results, loop, row)->force));
}

/* the row before a stage, or its first one */
static int before_stage(const CpsiStage *stage) {
    return stage->first > 0 ? stage->first - 1 : stage->first;
}

/* whether the end was held during this stage, which has been taken */
static bool stage_holds(const CpsResults *results, const Loop *loop, const CpsiStage *stage) {
    if (stage->last >= results->row_count || stage->last < 1) return false;
    for (int row = stage->first; row <= stage->last; ++row)
        if (!results->row[row].line[loop->line].held[loop->end]) return false;
    return true;
}

/* whether the end was held and moved during this stage */
static bool stage_moves(const CpsResults *results, const Loop *loop, const CpsiStage *stage) {
    if (!stage_holds(results, loop, stage)) return false;
    const int from = before_stage(stage);
    const Vec3 a = vec3_load(end_at(results, loop, from)->position);
    const Vec3 b = vec3_load(end_at(results, loop, stage->last)->position);
    return vec3_norm(vec3_sub(b, a)) > SAME_PLACE * results->line_length[loop->line];
}

/* direction, work and dissipation of a loop whose steps are known */
static void measure_loop(const CpsResults *results, Loop *loop) {
    Vec3 farthest = vec3(0, 0, 0);
    for (int row = loop->start; row <= loop->last; ++row) {
        const Vec3 place = moved(results, loop, row);
        if (vec3_norm(place) > vec3_norm(farthest)) farthest = place;
    }
    loop->direction = vec3_scale(1 / vec3_norm(farthest), farthest);
    loop->work = loop->dissipated = 0;
    for (int row = loop->start + 1; row <= loop->last; ++row) {
        loop->work += end_at(results, loop, row)->work;
        loop->dissipated += results->row[row].line[loop->line].report.ledger.dissipated;
    }
}

/* The loop within one stage, in which the end swings: from the last row at which it was where it is
 * at the end, coming from the same side, or from the beginning if it is there again. */
static bool find_cycle(const CpsResults *results, Loop *loop, int index) {
    const CpsiStage *stage = &results->stage[index];
    if (!stage_holds(results, loop, stage)) return false;
    const int from = before_stage(stage), last = stage->last;
    double extent = 0, left = 0;
    loop->start = last;
    for (int row = from; row < last; ++row)
        extent = fmax(extent, vec3_norm(moved(results, loop, row)));
    if (!(extent > SAME_PLACE * results->line_length[loop->line])) return false;
    const Vec3 way = moved(results, loop, last - 1);
    int start = -1;
    for (int row = last - 1; row > from && start < 0; --row) {
        const Vec3 place = moved(results, loop, row), earlier = moved(results, loop, row - 1);
        left = fmax(left, vec3_norm(place));
        if (left > 0.1 * extent && vec3_norm(place) <= SAME_CYCLE * extent &&
            vec3_norm(vec3_sub(earlier, way)) <= SAME_CYCLE * extent)
            start = row;
    }
    if (start < 0 && vec3_norm(moved(results, loop, from)) <= SAME_CYCLE * extent) start = from;
    if (start < 0 || last - start > MAX_CYCLE_STEPS) return false;
    loop->start = start;
    loop->first_stage = loop->last_stage = index;
    loop->last = last;
    measure_loop(results, loop);
    return true;
}

/* The next closed run of stages from `stage` on for the loop's line and end; returns the stage
 * after it, or the number of stages when there is none (loop->last is then -1). */
static int find_loop(const CpsResults *results, Loop *loop, int stage) {
    loop->last = -1;
    for (; stage < results->stage_count; ++stage) {
        if (find_cycle(results, loop, stage)) return stage + 1;
        if (!stage_moves(results, loop, &results->stage[stage])) continue;
        const int first = results->stage[stage].first;
        loop->start = first > 0 ? first - 1 : 0;
        const int most = results->stage_count - stage < MAX_LOOP_STAGES ? results->stage_count
                                                                        : stage + MAX_LOOP_STAGES;
        for (int next = stage; next < most; ++next) {
            if (!stage_moves(results, loop, &results->stage[next])) break;
            const int last = results->stage[next].last;
            if (vec3_norm(moved(results, loop, last)) >
                SAME_PLACE * results->line_length[loop->line])
                continue;
            loop->first_stage = stage;
            loop->last_stage = next;
            loop->last = last;
            measure_loop(results, loop);
            return next + 1;
        }
    }
    return stage;
}

/* the common part of the names of the loop's stages, else the first name: "surge out", "surge back"
 * -> "surge" */
static void loop_name(const CpsResults *results, const Loop *loop, char out[64]) {
    const char *first = results->stage[loop->first_stage].name;
    size_t length = cpsi_utf8_cut(first, 60);
    for (int i = loop->first_stage + 1; i <= loop->last_stage; ++i) {
        size_t same = 0;
        while (same < length && results->stage[i].name[same] == first[same]) ++same;
        length = same;
    }
    while (length > 0 && !isalnum((unsigned char)first[length - 1])) --length;
    if (length == 0) length = cpsi_utf8_cut(first, 60);
    snprintf(out, 64, "%.*s", (int)length, first);
}

/* A knot of the mean curve, or a point of the path between knots. */
typedef struct Knot {
    double u, force;
} Knot;

/* Points of a loop, and their forces minus the mean curve. */
typedef struct Path {
    int count;
    double *u, *force, *opened; /* (count) [m], [N], [N] */
    Knot *knot;                 /* (count) work space */
} Path;

static int by_displacement(const void *a, const void *b) {
    const Knot *p = a, *q = b;
    return (p->u > q->u) - (p->u < q->u);
}

/* The mean curve's knots from the sorted points: where the path passes more than once, half way
 * between the largest and the smallest force; and both turning points. Returns their number. */
static int find_knots(Knot *knot, int count) {
    const double same = SAME_DISPLACEMENT * (knot[count - 1].u - knot[0].u);
    int knots = 0;
    for (int i = 0, next; i < count; i = next) {
        double low = knot[i].force, high = low;
        for (next = i + 1; next < count && knot[next].u - knot[i].u <= same; ++next) {
            low = fmin(low, knot[next].force);
            high = fmax(high, knot[next].force);
        }
        if (next - i > 1 || i == 0 || next == count)
            knot[knots++] = (Knot){knot[i].u, 0.5 * (low + high)};
    }
    return knots;
}

/* opened = force - f(u), f piecewise linear through the knots */
static void open_path(Path *path) {
    Knot *knot = path->knot;
    for (int i = 0; i < path->count; ++i) knot[i] = (Knot){path->u[i], path->force[i]};
    qsort(knot, (size_t)path->count, sizeof *knot, by_displacement);
    const int knots = find_knots(knot, path->count);
    for (int i = 0; i < path->count; ++i) {
        int k = 1;
        while (k < knots - 1 && knot[k].u < path->u[i]) ++k;
        const double t = (path->u[i] - knot[k - 1].u) / (knot[k].u - knot[k - 1].u);
        path->opened[i] = path->force[i] - (1 - t) * knot[k - 1].force - t * knot[k].force;
    }
}

static void draw_path(const Path *path, const double *force, CpsiFrame frame, const char *x_label,
                      const char *what, FILE *out) {
    char label[80];
    frame.x[0] = frame.y[0] = INFINITY;
    frame.x[1] = frame.y[1] = -INFINITY;
    for (int i = 0; i < path->count; ++i) {
        cpsi_range_include(frame.x, path->u[i]);
        cpsi_range_include(frame.y, force[i]);
    }
    const CpsiUnit unit = cpsi_unit("N", fmax(fabs(frame.y[0]), fabs(frame.y[1])));
    frame.y[0] *= unit.factor;
    frame.y[1] *= unit.factor;
    cpsi_range_pad(frame.x, 0.06);
    cpsi_range_pad(frame.y, 0.12);
    snprintf(label, sizeof label, "%s (%s)", what, unit.name);
    cpsi_frame_axes(out, &frame, x_label, label);

    /* the area, then the path with its steps */
    for (int pass = 0; pass < 2; ++pass) {
        fprintf(out,
                "<%s fill=\"%s\" stroke=\"%s\" stroke-width=\"1.8\" stroke-linejoin=\"round\" "
                "points=\"",
                pass ? "polyline" : "polygon", pass ? "none" : "#dfe9f6",
                pass ? "#2b5fa8" : "none");
        for (int i = 0; i < path->count; ++i)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(&frame, path->u[i]),
                    cpsi_frame_y(&frame, force[i] * unit.factor));
        fputs("\"/>\n", out);
    }
    for (int i = 0; i < path->count; ++i)
        fprintf(out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"#2b5fa8\"/>\n",
                cpsi_frame_x(&frame, path->u[i]), cpsi_frame_y(&frame, force[i] * unit.factor),
                i ? "2.2" : "5", i ? "#2b5fa8" : "#fff");
}

static void draw_loop(const CpsResults *results, const Loop *loop, const Path *path,
                      const char *name, FILE *out) {
    const CpsiFrame above = {.left = CPSI_FRAME_LEFT,
                             .top = CPSI_FRAME_TOP + 28,
                             .width = CPSI_FRAME_WIDTH,
                             .height = FORCE_HEIGHT};
    CpsiFrame below = above;
    below.top += above.height + 62;
    below.height = OPENED_HEIGHT;
    char text[300], x_label[96];
    snprintf(text, sizeof text,
             "%s  \xC2\xB7  line %.40s, end %s  \xC2\xB7  steps %d to %d, from the open circle on",
             name, results->line_name[loop->line], loop->end ? "B" : "A", loop->start + 1,
             loop->last + 1);
    cpsi_svg_begin(out, CPSI_SHEET_WIDTH, below.top + below.height + 56,
                   *results->title ? results->title : "capstan", text);
    const CpsiUnit joule = cpsi_unit("J", fmax(fabs(loop->work), loop->dissipated));
    snprintf(text, sizeof text, "work done on the line at this end: %.4g %s",
             loop->work * joule.factor, joule.name);
    cpsi_svg_text(out, above.left, above.top - 12, CPSI_START,
                  "font-size=\"14\" font-weight=\"bold\" fill=\"#2b5fa8\"", text);
    snprintf(text, sizeof text, "dissipated by friction: %.4g %s", loop->dissipated * joule.factor,
             joule.name);
    cpsi_svg_text(out, above.left + above.width, above.top - 12, CPSI_END,
                  "font-size=\"13\" fill=\"#666\"", text);

    const Vec3 d = loop->direction;
    snprintf(x_label, sizeof x_label, "displacement along (%.3g, %.3g, %.3g) (m)", d.x + 0.0,
             d.y + 0.0, d.z + 0.0);
    draw_path(path, path->force, above, x_label, "force along it", out);
    draw_path(path, path->opened, below, x_label, "less the mean of loading and unloading", out);
    cpsi_svg_finish(out);
}

/* the picture of one loop; false when memory does not suffice */
static bool picture_loop(const CpsResults *results, const Loop *loop, const char *name, FILE *out) {
    Path path = {.count = loop->last - loop->start + 1};
    double *block = calloc((size_t)path.count, 3 * sizeof *block);
    path.knot = calloc((size_t)path.count, sizeof *path.knot);
    if (!block || !path.knot) {
        free(block);
        free(path.knot);
        return false;
    }
    path.u = block;
    path.force = path.u + path.count;
    path.opened = path.force + path.count;
    for (int i = 0; i < path.count; ++i) {
        path.u[i] = along(results, loop, loop->start + i);
        path.force[i] = force(results, loop, loop->start + i);
    }
    open_path(&path);
    draw_loop(results, loop, &path, name, out);
    free(block);
    free(path.knot);
    return true;
}

/* letters, digits, '-', '_' and '.' are safe in file names everywhere */
static void file_name(char *out, size_t size, const char *name, int number) {
    char safe[64];
    snprintf(safe, sizeof safe, "%s", name);
    for (char *c = safe; *c; ++c)
        if (!isalnum((unsigned char)*c) && !strchr("-_.", *c)) *c = '-';
    if (number > 1)
        snprintf(out, size, "loop-%s-%d.svg", safe, number);
    else
        snprintf(out, size, "loop-%s.svg", safe);
}

CpsStatus cpsi_pictures_loops(CpsResults *results, CpsError *err) {
    int drawn = 0;
    for (int i = 0; i < 2 * results->line_count; ++i) {
        Loop loop = {.line = i / 2, .end = i % 2};
        for (int stage = 0; drawn < MAX_LOOPS;) {
            stage = find_loop(results, &loop, stage);
            if (loop.last < 0) break;
            char name[64], file[96];
            loop_name(results, &loop, name);
            int number = 1;
            do file_name(file, sizeof file, name, number++);
            while (cpsi_directory_has(results->directory, file));
            FILE *out = NULL;
            CpsStatus status = cpsi_directory_create(results->directory, file, &out, err);
            if (status) return status;
            const bool drawn_whole = picture_loop(results, &loop, name, out);
            status = cpsi_directory_close_file(results->directory, out, err);
            if (status) return status;
            if (!drawn_whole)
                return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while drawing %s", file);
            ++drawn;
        }
    }
    return CPS_OK;
}
