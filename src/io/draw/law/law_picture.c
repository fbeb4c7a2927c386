/* SPDX-License-Identifier: BSD-3-Clause */
/* Pictures of friction laws, in the manner of M77 figure 1: the set of forces; at each corner the
 * sector of normals, into which -V points for every velocity that this one force resists; for each
 * given velocity its set of forces, and -V from there.
 *
 * For a set of more dimensions its section by the plane of two components and its projection onto
 * that plane are shown; force sets are then shown by their projections too. Curves are drawn
 * through points of contact with tangents in equally spaced directions, which are points of the set
 * up to rounding and are dense on arcs; corners come from the set itself. */
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/math.h"
#include "base/status.h"
#include "capstan/results.h"
#include "io/draw/law/law_graph.h"
#include "io/draw/law/planar_cone.h"
#include "io/draw/svg.h"

enum {
    DIRECTIONS = 720,
    MOST_CORNERS = 256,
    MOST_LISTED = 14, /* number of given velocities and forces described in words */
    SIDE = 520,       /* frame, pixels */
    LEFT = 84,
    TOP = 76,
    LIST = 290 /* width of the list on the right */
};

/* Largest ratio of the frame's height to its width. */
static const double TALLEST = 1.15;

/* Powers below this share of the set's size times the speed are rounding. */
static const double NOTHING = 1e-12;

/* Radius of normal sectors and length of -V, as shares of the set's larger width. */
static const double SECTOR = 0.2, ARROW = 0.26;

/* For an unbounded set, SEEN times its own size is shown; it is cut off at BEYOND times that
 * distance, outside the frame. */
static const double SEEN = 2, BEYOND = 8;

/* The content of the picture, and the map from data to paper. */
typedef struct Sheet {
    FILE *out;
    CpsError *err;
    const CpsLawPicture *picture;
    const CpsSet *set; /* whole */
    int n;
    double *shadow_map; /* (2 x n) picks the two components */
    CpsiFrame frame;
    CpsiUnit unit;
    double size; /* of the set [N] */
    /* for an unbounded set: half the range shown, in both components [N]; 0: the whole set is
     * shown */
    double limit;
    bool in_space; /* more than two components: section and projection */
    int corners;   /* drawn */
} Sheet;

typedef struct Curve {
    int count;
    double x[DIRECTIONS][2];
} Curve;

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
}

/* ---- sets to curves ---- */

/* points of contact all round a set of R^2; none for an empty set */
static CpsStatus trace(const CpsSet *set, Curve *curve, CpsError *err) {
    curve->count = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        /* shifted by half a step, so that no direction is normal to an edge along an axis */
        const double angle = 2 * CPSI_PI * (i + 0.5) / DIRECTIONS, w[2] = {cos(angle), sin(angle)};
        double *point = curve->x[curve->count];
        CpsSetAnswer answer;
        const CpsStatus status = cps_set_support(set, w, point, &answer, err);
        if (status != CPS_OK) return status;
        if (answer.outcome == CPS_SET_OUTCOME_EMPTY) return CPS_OK;
        if (answer.outcome != CPS_SET_OUTCOME_ANSWERED)
            return cpsi_fail(err, CPS_ERR_ARGUMENT, "cannot draw the set of forces: %s",
                             cps_set_outcome_text(answer.outcome));
        curve->count++;
    }
    return CPS_OK;
}

/* the mean of the points of contact: Steiner's point, the middle of a segment */
static void middle(const Curve *curve, double centre[2]) {
    centre[0] = centre[1] = 0;
    for (int i = 0; i < curve->count; i++)
        for (int k = 0; k < 2; k++) centre[k] += curve->x[i][k] / curve->count;
}

/* the section by the plane of the two components, or the projection onto it */
static CpsStatus plane_set(const Sheet *s, const CpsSet *set, bool section, CpsSet **out) {
    if (s->n == 2 && s->picture->axis[0] == 0) {
        *out = cps_set_retain(set);
        return CPS_OK;
    }
    if (!section) return cps_set_image(2, s->shadow_map, set, out, s->err);
    double *inject = malloc(2 * (size_t)s->n * sizeof *inject);
    if (!inject) return out_of_memory(s->err);
    for (int i = 0; i < s->n; i++)
        for (int k = 0; k < 2; k++) inject[2 * i + k] = s->shadow_map[k * s->n + i];
    const CpsStatus status = cps_set_preimage(2, inject, NULL, set, out, s->err);
    free(inject);
    return status;
}

/* Replace an unbounded set by its part within this many limits. */
static CpsStatus cut_off(const Sheet *s, double limits, CpsSet **set) {
    if (s->limit == 0) return CPS_OK;
    CpsSet *box = NULL, *seen = NULL;
    const double most = limits * s->limit, low[2] = {-most, -most}, high[2] = {most, most};
    CpsStatus status = cps_set_box(2, low, high, &box, s->err);
    if (status == CPS_OK)
        status = cps_set_intersection(2, (const CpsSet *const[]){*set, box}, &seen, s->err);
    cps_set_release(box);
    if (status != CPS_OK) return status;
    cps_set_release(*set);
    *set = seen;
    return CPS_OK;
}

/* Half the range shown of an unbounded set: a multiple of the largest of its finite supports, its
 * distance from 0 or depth there, its corners and the given forces. */
static CpsStatus choose_limit(Sheet *s, const CpsSet *shadow) {
    CpsSetFacts facts;
    CpsStatus status = cps_set_facts(shadow, 0, &facts, NULL, NULL, s->err);
    if (status != CPS_OK || facts.outcome != CPS_SET_OUTCOME_ANSWERED || facts.bounded)
        return status;
    double most = 0, corner[2 * MOST_CORNERS];
    int corners = 0;
    CpsSetAnswer answer;
    for (int i = 0; status == CPS_OK && i < DIRECTIONS / 20; i++) {
        const double angle = 40 * CPSI_PI * i / DIRECTIONS;
        status = cps_set_support(shadow, (double[]){cos(angle), sin(angle)}, NULL, &answer, s->err);
        if (answer.outcome == CPS_SET_OUTCOME_ANSWERED) most = fmax(most, fabs(answer.value));
    }
    if (status == CPS_OK)
        status = cps_set_contains(shadow, (double[]){0, 0}, NULL, &answer, s->err);
    if (status == CPS_OK && answer.outcome == CPS_SET_OUTCOME_ANSWERED && isfinite(answer.value))
        most = fmax(most, fabs(answer.value));
    if (status == CPS_OK)
        status = cps_set_vertices(shadow, 0, MOST_CORNERS, corner, &corners, &answer, s->err);
    if (status == CPS_OK && answer.outcome == CPS_SET_OUTCOME_ANSWERED)
        for (int i = 0; i < 2 * corners && i < 2 * MOST_CORNERS; i++)
            most = fmax(most, fabs(corner[i]));
    for (int i = 0; i < s->picture->force_count; i++)
        for (int k = 0; k < 2; k++)
            most = fmax(
                most,
                fabs(s->picture->force[(size_t)i * (size_t)s->n + (size_t)s->picture->axis[k]]));
    s->limit = most > 0 ? SEEN * most : 1;
    return status;
}

/* ---- drawing ---- */

static double px(const Sheet *s, double x) { return cpsi_frame_x(&s->frame, x * s->unit.factor); }
static double py(const Sheet *s, double y) { return cpsi_frame_y(&s->frame, y * s->unit.factor); }

/* whether a point is outside the range shown of an unbounded set */
static bool is_beyond(const Sheet *s, const double x[2]) {
    return s->limit > 0 && fmax(fabs(x[0]), fabs(x[1])) > s->limit * (1 + 1e-9);
}

static void draw_curve(const Sheet *s, const Curve *curve, const char *style) {
    fprintf(s->out, "<polygon %s stroke-linejoin=\"round\" points=\"", style);
    double lx = INFINITY, ly = INFINITY;
    for (int i = 0; i < curve->count; i++) {
        /* repeated points at a corner are written once */
        const double x = px(s, curve->x[i][0]), y = py(s, curve->x[i][1]);
        if (fabs(x - lx) + fabs(y - ly) < 0.02) continue;
        fprintf(s->out, "%.2f,%.2f ", x, y);
        lx = x;
        ly = y;
    }
    fputs("\"/>\n", s->out);
}

static void draw_arrow(const Sheet *s, const double from[2], const double direction[2],
                       double length, const char *colour) {
    const double x0 = px(s, from[0]), y0 = py(s, from[1]);
    const double x1 = px(s, from[0] + length * direction[0]),
                 y1 = py(s, from[1] + length * direction[1]);
    const double dx = x1 - x0, dy = y1 - y0, l = hypot(dx, dy);
    if (!(l > 1)) return;
    const double ux = dx / l, uy = dy / l;
    fprintf(s->out,
            "<line x1=\"%.2f\" y1=\"%.2f\" x2=\"%.2f\" y2=\"%.2f\" stroke=\"%s\" "
            "stroke-width=\"1.8\"/>",
            x0, y0, x1 - 7 * ux, y1 - 7 * uy, colour);
    fprintf(s->out, "<polygon fill=\"%s\" points=\"%.2f,%.2f %.2f,%.2f %.2f,%.2f\"/>\n", colour, x1,
            y1, x1 - 10 * ux - 4 * uy, y1 - 10 * uy + 4 * ux, x1 - 10 * ux + 4 * uy,
            y1 - 10 * uy - 4 * ux);
}

/* a cone of R^2 with its apex at a point: a sector up to the whole disc, an arrow, a line with two
 * heads; *dimension: that of the cone */
static CpsStatus draw_cone(const Sheet *s, const CpsSet *cone, const double apex[2], bool arrow,
                           const char *style, int *dimension) {
    CpsiPlanarCone found;
    const CpsStatus status = cpsi_planar_cone(cone, &found, s->err);
    *dimension = found.dimension;
    const double r = SECTOR * s->size;
    if (found.dimension == 1 && arrow)
        for (int side = 1; side >= (found.line ? -1 : 1); side -= 2)
            draw_arrow(s, apex, (double[]){side * cos(found.start), side * sin(found.start)}, r,
                       "#c98a1b");
    if (status != CPS_OK || found.dimension < 2) return status;
    fprintf(s->out, "<polygon %s points=\"", style);
    if (found.turn < 2 * CPSI_PI) fprintf(s->out, "%.2f,%.2f ", px(s, apex[0]), py(s, apex[1]));
    for (int i = 0; i <= 48; i++) {
        const double a = found.start + found.turn * i / 48;
        fprintf(s->out, "%.2f,%.2f ", px(s, apex[0] + r * cos(a)), py(s, apex[1] + r * sin(a)));
    }
    fputs("\"/>\n", s->out);
    return CPS_OK;
}

/* the corners of the visible part of a set of R^2, each with the set's sector of normals */
static CpsStatus draw_corners(Sheet *s, const CpsSet *seen, const CpsSet *set) {
    double *corner = malloc(2 * MOST_CORNERS * sizeof *corner);
    if (!corner) return out_of_memory(s->err);
    int count = 0;
    CpsSetAnswer answer;
    CpsStatus status = cps_set_vertices(seen, 0, MOST_CORNERS, corner, &count, &answer, s->err);
    if (status == CPS_OK && (answer.outcome != CPS_SET_OUTCOME_ANSWERED || count > MOST_CORNERS))
        count = 0;
    for (int i = 0; i < count && status == CPS_OK; i++) {
        /* where an edge continues into an arc there is one normal, and no corner */
        const double *at = corner + 2 * i;
        int dimension = 0;
        CpsSet *cone = NULL;
        if (is_beyond(s, at)) continue;
        status = cps_set_normal_cone(set, at, 0, &cone, &answer, s->err);
        if (status == CPS_OK && cone)
            status = draw_cone(
                s, cone, at, false,
                "fill=\"#f6dca6\" fill-opacity=\"0.75\" stroke=\"#c98a1b\" stroke-width=\"0.8\"",
                &dimension);
        cps_set_release(cone);
        s->corners += dimension == 2;
        if (dimension == 2)
            fprintf(s->out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"3\" fill=\"#2b5fa8\"/>\n",
                    px(s, at[0]), py(s, at[1]));
    }
    free(corner);
    return status;
}

/* ---- given velocities and forces ---- */

static CpsiColour colour_of(const Sheet *s, int i) {
    const int count = s->picture->velocity_count;
    return cpsi_colour(CPSI_SCALE_TENSION, count > 1 ? 0.35 + 0.6 * i / (count - 1) : 0.6);
}

static void draw_line(const Sheet *s, int line, const char *colour, const char *text) {
    char style[80];
    snprintf(style, sizeof style, "font-size=\"12\" fill=\"%s\"", colour);
    cpsi_svg_text(s->out, LEFT + SIDE + 24, TOP + 12 + 17.0 * line, CPSI_START, style, text);
}

/* "(1, 0.3)", at most six numbers */
static void vector_text(int n, const double *x, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "(");
    for (int i = 0; i < n && i < 6 && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%.4g", i ? ", " : "", x[i] + 0.0);
    if (used < size) snprintf(text + used, size - used, n > 6 ? ", ...)" : ")");
}

static void list_velocity(const Sheet *s, int i, const double *velocity, const CpsSetAnswer *phi,
                          int dimension) {
    static const char *const KIND[] = {"one force", "a segment of forces", "an area of forces"};
    char text[160], vector[100];
    if (i > MOST_LISTED) return;
    if (i == MOST_LISTED) {
        draw_line(s, 3 * i, "#666", "and more");
        return;
    }
    vector_text(s->n, velocity, vector, sizeof vector);
    snprintf(text, sizeof text, "V = %s m/s", vector);
    draw_line(s, 3 * i, colour_of(s, i).hex, text);
    double speed = 0; /* below the rounding of forces times speed phi is 0 */
    for (int k = 0; k < s->n; k++) speed = fmax(speed, fabs(velocity[k]));
    if (phi->outcome == CPS_SET_OUTCOME_ANSWERED)
        snprintf(text, sizeof text, "   %.6g W, %s",
                 fabs(phi->value) > NOTHING * s->size * speed ? phi->value : 0,
                 dimension < 3 ? KIND[dimension] : "a body of forces");
    else if (phi->outcome == CPS_SET_OUTCOME_UNBOUNDED)
        snprintf(text, sizeof text, "   no force: phi is infinite");
    else
        snprintf(text, sizeof text, "   no force: %s", cps_set_outcome_text(phi->outcome));
    draw_line(s, 3 * i + 1, "#555", text);
}

/* the middle of the visible part of a planar set */
static CpsStatus find_middle(const Sheet *s, const CpsSet *flat, Curve *curve, double centre[2]) {
    CpsSet *seen = cps_set_retain(flat);
    CpsStatus status = cut_off(s, 1, &seen);
    if (status == CPS_OK) status = trace(seen, curve, s->err);
    if (status == CPS_OK && curve->count > 0) middle(curve, centre);
    cps_set_release(seen);
    return status;
}

static CpsStatus draw_planar_forces(const Sheet *s, CpsSet **flat, const CpsSetFacts *facts,
                                    const char *colour, double centre[2]) {
    char style[120];
    if (facts->dimension == 0) {
        fprintf(s->out, "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"5.5\" fill=\"%s\" stroke=\"#fff\"/>\n",
                px(s, centre[0]), py(s, centre[1]), colour);
        return CPS_OK;
    }
    Curve *curve = malloc(sizeof *curve);
    if (!curve) return out_of_memory(s->err);
    CpsStatus status = find_middle(s, *flat, curve, centre);
    if (status == CPS_OK && !facts->bounded) status = cut_off(s, BEYOND, flat);
    if (status == CPS_OK) status = trace(*flat, curve, s->err);
    if (status == CPS_OK) {
        snprintf(style, sizeof style,
                 "fill=\"%s\" fill-opacity=\"0.35\" stroke=\"%s\" stroke-width=\"4\"", colour,
                 colour);
        fputs("<g clip-path=\"url(#frame1)\">\n", s->out); /* as of cpsi_frame_begin in put_axes */
        draw_curve(s, curve, style);
        fputs("</g>\n", s->out);
    }
    free(curve);
    return status;
}

/* a set of forces in the plane: a dot, a thick line, or an area; its middle goes to centre */
static CpsStatus draw_forces(const Sheet *s, const CpsSet *forces, const char *colour,
                             double centre[2]) {
    CpsSet *flat = NULL;
    CpsSetFacts facts;
    CpsStatus status = plane_set(s, forces, false, &flat);
    if (status == CPS_OK) status = cps_set_facts(flat, 0, &facts, centre, NULL, s->err);
    if (status == CPS_OK && facts.outcome == CPS_SET_OUTCOME_ANSWERED &&
        (facts.bounded || s->limit > 0))
        status = draw_planar_forces(s, &flat, &facts, colour, centre);
    cps_set_release(flat);
    return status;
}

static CpsStatus draw_velocity(const Sheet *s, int i) {
    const double *velocity = s->picture->velocity + (size_t)i * (size_t)s->n;
    const CpsiColour colour = colour_of(s, i);
    CpsSet *forces = NULL;
    CpsSetAnswer answer;
    CpsSetFacts facts = {.dimension = 0};
    CpsStatus status = cps_set_forces(s->set, velocity, 0, &forces, &answer, s->err);
    if (status == CPS_OK && forces) status = cps_set_facts(forces, 0, &facts, NULL, NULL, s->err);
    double centre[2] = {0, 0};
    if (status == CPS_OK && forces) status = draw_forces(s, forces, colour.hex, centre);
    cps_set_release(forces);
    if (status != CPS_OK) return status;

    /* -V in the plane, to the length of the arrows */
    const double v[2] = {-velocity[s->picture->axis[0]], -velocity[s->picture->axis[1]]},
                 l = hypot(v[0], v[1]);
    const double direction[2] = {l > 0 ? v[0] / l : 0, l > 0 ? v[1] / l : 0};
    if (answer.outcome == CPS_SET_OUTCOME_ANSWERED)
        draw_arrow(s, centre, direction, ARROW * s->size, colour.hex);
    list_velocity(s, i, velocity, &answer, facts.dimension);
    return CPS_OK;
}

/* a force, and the cone of -V, or with more components its projection */
static CpsStatus draw_force(const Sheet *s, int i) {
    const double *force = s->picture->force + (size_t)i * (size_t)s->n;
    const double at[2] = {force[s->picture->axis[0]], force[s->picture->axis[1]]};
    int dimension;
    CpsSet *cone = NULL, *flat = NULL;
    CpsSetAnswer answer;
    CpsStatus status = cps_set_normal_cone(s->set, force, 0, &cone, &answer, s->err);
    if (status == CPS_OK && cone) status = plane_set(s, cone, false, &flat);
    if (status == CPS_OK && flat)
        status = draw_cone(
            s, flat, at, true,
            "fill=\"#f0b429\" fill-opacity=\"0.6\" stroke=\"#8a5a00\" stroke-width=\"1.2\"",
            &dimension);
    cps_set_release(cone);
    cps_set_release(flat);
    fprintf(s->out,
            "<circle cx=\"%.2f\" cy=\"%.2f\" r=\"4.5\" fill=\"#fff\" stroke=\"#8a5a00\" "
            "stroke-width=\"1.6\"/>\n",
            px(s, at[0]), py(s, at[1]));
    return status;
}

/* ---- the sheet ---- */

/* equal scales on both axes, with space for sectors and arrows; 0 is visible */
static void fit_frame(Sheet *s, const Curve *curve) {
    double x[2] = {0, 0}, y[2] = {0, 0};
    for (int i = 0; i < curve->count; i++) {
        cpsi_range_include(x, curve->x[i][0]);
        cpsi_range_include(y, curve->x[i][1]);
    }
    for (int i = 0; i < s->picture->force_count; i++) {
        cpsi_range_include(
            x, s->picture->force[(size_t)i * (size_t)s->n + (size_t)s->picture->axis[0]]);
        cpsi_range_include(
            y, s->picture->force[(size_t)i * (size_t)s->n + (size_t)s->picture->axis[1]]);
    }
    s->size = fmax(fmax(x[1] - x[0], y[1] - y[0]), 1e-300);
    s->unit = cpsi_unit("N", 0.5 * s->size);
    const double margin = 0.31 * s->size, wide = 0.5 * (x[1] - x[0]) + margin,
                 high = 0.5 * (y[1] - y[0]) + margin;
    const double half = fmax(wide, high / TALLEST) * s->unit.factor,
                 share = fmin(high / wide, TALLEST);
    const double cx = 0.5 * (x[0] + x[1]) * s->unit.factor,
                 cy = 0.5 * (y[0] + y[1]) * s->unit.factor;
    s->frame = (CpsiFrame){.left = LEFT,
                           .top = TOP,
                           .width = SIDE,
                           .height = SIDE * share,
                           .x = {cx - half, cx + half},
                           .y = {cy - half * share, cy + half * share}};
}

static void draw_axes(const Sheet *s) {
    char x[64], y[64];
    if (s->n == 2) {
        snprintf(x, sizeof x, "force, component %d (%s)", s->picture->axis[0] + 1, s->unit.name);
        snprintf(y, sizeof y, "force, component %d (%s)", s->picture->axis[1] + 1, s->unit.name);
    } else { /* of more components some may be torques */
        snprintf(x, sizeof x, "component %d (%s, of a torque %s m)", s->picture->axis[0] + 1,
                 s->unit.name, s->unit.name);
        snprintf(y, sizeof y, "component %d (%s, of a torque %s m)", s->picture->axis[1] + 1,
                 s->unit.name, s->unit.name);
    }
    cpsi_frame_axes(s->out, &s->frame, x, y);
    cpsi_frame_begin(s->out, &s->frame, 1);
    fprintf(s->out,
            "<path d=\"M%.1f %.1fh%d M%.1f %.1fv%.1f\" stroke=\"#aaa\" stroke-width=\"1\"/>\n",
            s->frame.left, py(s, 0), SIDE, px(s, 0), s->frame.top, s->frame.height);
}

static void draw_legend(const Sheet *s, bool some) {
    double x = LEFT, y = TOP + s->frame.height + 58;
    cpsi_legend(
        s->out, &x, y,
        "<rect x=\"-11\" y=\"-5\" width=\"22\" height=\"10\" fill=\"#dfe9f6\" stroke=\"#2b5fa8\"/>",
        !s->in_space ? "set of forces"
        : some       ? "section of the set of forces"
                     : "no section: the plane misses the set");
    if (s->in_space)
        cpsi_legend(s->out, &x, y,
                    "<line x1=\"-11\" x2=\"11\" stroke=\"#2b5fa8\" stroke-dasharray=\"4 3\"/>",
                    "its shadow");
    if (s->corners > 0)
        cpsi_legend(s->out, &x, y,
                    "<path d=\"M-9 4L9 4A18 18 0 0 0 4 -7Z\" fill=\"#f6dca6\" stroke=\"#c98a1b\"/>",
                    "directions of \xE2\x88\x92V at a corner");
    if (s->picture->velocity_count > 0)
        cpsi_legend(s->out, &x, y,
                    "<path d=\"M-10 0H10M4 -4L10 0L4 4\" stroke=\"#a03070\" fill=\"none\" "
                    "stroke-width=\"1.8\"/>",
                    "\xE2\x88\x92V, from its forces");
}

/* the frame, from the visible part of the projection */
static CpsStatus frame_shadow(Sheet *s, const CpsSet *shadow, Curve *curve) {
    CpsSet *seen = cps_set_retain(shadow);
    CpsStatus status = cut_off(s, 1, &seen);
    if (status == CPS_OK) status = trace(seen, curve, s->err);
    cps_set_release(seen);
    if (status == CPS_OK && curve->count == 0)
        status = cpsi_fail(s->err, CPS_ERR_ARGUMENT, "cannot draw the set of forces: it is empty");
    if (status == CPS_OK) fit_frame(s, curve);
    return status;
}

/* `whole` is the section; where it or the projection is unbounded, it is cut off outside the
 * frame */
static CpsStatus draw_all(Sheet *s, const CpsSet *whole, const CpsSet *section,
                          const CpsSet *shadow, Curve *curve) {
    CpsStatus status = trace(shadow, curve, s->err);
    if (status != CPS_OK) return status;
    const int asked = s->picture->velocity_count;
    const double list = TOP + 51.0 * (asked < MOST_LISTED ? asked : MOST_LISTED + 1);
    const char *title =
        s->picture->title && *s->picture->title ? s->picture->title : "friction law";
    cpsi_svg_begin(s->out, LEFT + SIDE + (asked ? LIST : 40),
                   fmax(TOP + s->frame.height + 76, list), title,
                   s->in_space    ? "section through 0, and shadow, of the set of forces"
                   : s->limit > 0 ? "set of forces, which goes on beyond the frame"
                                  : "set of forces");
    draw_axes(s);
    if (s->in_space) {
        draw_curve(
            s, curve,
            "fill=\"#f6f8fc\" stroke=\"#2b5fa8\" stroke-width=\"1\" stroke-dasharray=\"5 4\"");
        status = trace(section, curve, s->err);
    }
    /* the plane through 0 may not intersect a set that a load has translated; then only the
     * projection is drawn */
    const bool some = curve->count > 0;
    if (status == CPS_OK && some)
        draw_curve(s, curve, "fill=\"#dfe9f6\" stroke=\"#2b5fa8\" stroke-width=\"1.8\"");
    if (status == CPS_OK && some) status = draw_corners(s, section, whole);
    for (int i = 0; i < s->picture->force_count && status == CPS_OK; i++) status = draw_force(s, i);
    cpsi_frame_end(s->out);
    for (int i = 0; i < s->picture->velocity_count && status == CPS_OK; i++)
        status = draw_velocity(s, i);
    draw_legend(s, some);
    cpsi_svg_finish(s->out);
    return status;
}

static CpsStatus draw(Sheet *s) {
    CpsSet *whole = NULL, *section = NULL, *shadow = NULL;
    Curve *curve = malloc(sizeof *curve);
    if (!curve) return out_of_memory(s->err);
    CpsStatus status = plane_set(s, s->set, true, &whole);
    if (status == CPS_OK) section = cps_set_retain(whole);
    if (status == CPS_OK) status = plane_set(s, s->set, false, &shadow);
    if (status == CPS_OK) status = choose_limit(s, shadow);
    if (status == CPS_OK) status = frame_shadow(s, shadow, curve);
    if (status == CPS_OK) status = cut_off(s, BEYOND, &section);
    if (status == CPS_OK) status = cut_off(s, BEYOND, &shadow);
    if (status == CPS_OK) status = draw_all(s, whole, section, shadow, curve);
    cps_set_release(whole);
    cps_set_release(section);
    cps_set_release(shadow);
    free(curve);
    return status;
}

CpsStatus cps_law_draw(const CpsSet *set, const CpsLawPicture *picture, FILE *out, CpsError *err) {
    if (!set || !picture || !out)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "set, picture or out is NULL");
    const int n = cps_set_space(set), *axis = picture->axis;
    CpsStatus status = cpsi_law_picture_check(picture, n, err);
    if (status) return status;
    if (n == 1) return cpsi_law_graph(set, NULL, picture, out, err);
    Sheet s = {.out = out, .err = err, .picture = picture, .set = set, .n = n, .in_space = n > 2};
    s.shadow_map = calloc(2 * (size_t)n, sizeof *s.shadow_map);
    const locale_t numbers = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (s.shadow_map && numbers) {
        s.shadow_map[axis[0]] = s.shadow_map[n + axis[1]] = 1;
        const locale_t before = uselocale(numbers);
        status = draw(&s);
        uselocale(before);
    } else {
        status = out_of_memory(err);
    }
    if (numbers) freelocale(numbers);
    free(s.shadow_map);
    return status;
}
