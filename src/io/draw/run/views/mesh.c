/* SPDX-License-Identifier: BSD-3-Clause */
/* Meshes in plan views and elevations (run_picture.h).
 *
 * A mesh is shown by its outline, the highest and the lowest place of the triangles in each of many
 * columns of the paper, moved outwards by its radius; parts between which one sees through are not
 * told apart. From above it has contours as ground has, of what is highest; in an elevation the
 * section of the triangles with the paper. */
#include <math.h>

#include "io/draw/run/run_picture.h"

static const char FILL[] = "#efe7d6", EDGE[] = "#b9a67c", SEEN_FROM_ABOVE[] = "#faf7f0",
                  SECTION[] = "#9a8350";

enum { COLUMNS = 320 };

/* A mesh as it is after a step, on paper. */
typedef struct Placed {
    CpsMeshTriangles of;
    Vec3 right, up, toward; /* of the paper, in the axes of the mesh */
    double x, y, z;         /* of the mesh's origin on paper, and towards the eye */
    double radius;
} Placed;

/* Corner i of triangle t: along the paper, up, and towards the eye. */
static Vec3 corner(const Placed *mesh, int t, int i) {
    const Vec3 p = vec3_at(mesh->of.vertex, mesh->of.triangle[3 * (size_t)t + (size_t)i]);
    return vec3(mesh->x + vec3_dot(p, mesh->right), mesh->y + vec3_dot(p, mesh->up),
                mesh->z + vec3_dot(p, mesh->toward));
}

typedef struct Outline {
    double low[COLUMNS + 1], high[COLUMNS + 1];
} Outline;

/* The range of a triangle above the place `at` of the paper; false: it is not there. */
static bool range_at(const Vec3 p[3], double at, double range[2]) {
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const Vec3 a = p[i], b = p[(i + 1) % 3];
        if ((a.x < at) == (b.x < at)) continue;
        const double y = a.y + (at - a.x) / (b.x - a.x) * (b.y - a.y);
        range[0] = fmin(range[0], y);
        range[1] = fmax(range[1], y);
    }
    return range[0] <= range[1];
}

static void find_outline(const Placed *mesh, const CpsiFrame *frame, Outline *out) {
    const double left = frame->x[0], wide = (frame->x[1] - left) / COLUMNS;
    for (int c = 0; c <= COLUMNS; c++) {
        out->low[c] = INFINITY;
        out->high[c] = -INFINITY;
    }
    for (int t = 0; t < mesh->of.triangle_count; t++) {
        const Vec3 p[3] = {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)};
        const double low = fmin(p[0].x, fmin(p[1].x, p[2].x)),
                     high = fmax(p[0].x, fmax(p[1].x, p[2].x));
        const double first = fmax(0, ceil((low - left) / wide)),
                     last = fmin(COLUMNS, floor((high - left) / wide));
        for (int c = (int)fmin(first, COLUMNS + 1); c <= last; c++) {
            double range[2];
            if (!range_at(p, left + wide * c, range)) continue;
            out->low[c] = fmin(out->low[c], range[0] - mesh->radius);
            out->high[c] = fmax(out->high[c], range[1] + mesh->radius);
        }
    }
}

static double clipped(const CpsiFrame *frame, double y) {
    return cpsi_frame_y(frame, fmin(frame->y[1], fmax(frame->y[0], y)));
}

/* One polygon for each run of columns in which there is something. */
static void draw_outline(const Placed *mesh, const CpsiFrame *frame, const char *fill, FILE *out) {
    Outline outline;
    const double wide = (frame->x[1] - frame->x[0]) / COLUMNS;
    find_outline(mesh, frame, &outline);
    for (int first = 0; first <= COLUMNS; first++) {
        int last = first;
        while (last <= COLUMNS && outline.low[last] <= outline.high[last]) last++;
        if (last == first) continue;
        fprintf(out, "<polygon fill=\"%s\" stroke=\"%s\" points=\"", fill, EDGE);
        for (int c = first; c < last; c++)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, frame->x[0] + wide * c),
                    clipped(frame, outline.high[c]));
        for (int c = last - 1; c >= first; c--)
            fprintf(out, "%.1f,%.1f ", cpsi_frame_x(frame, frame->x[0] + wide * c),
                    clipped(frame, outline.low[c]));
        fputs("\"/>\n", out);
        first = last;
    }
}

/* Raise the heights of the relief, of what is towards the eye, to those of a triangle. */
static void add_to_relief(const Vec3 p[3], double radius, const CpsiFrame *frame,
                          CpsiRelief *relief) {
    const double wide = (frame->x[1] - frame->x[0]) / CPSI_SQUARES,
                 tall = (frame->y[1] - frame->y[0]) / CPSI_SQUARES;
    const double ux = p[1].x - p[0].x, uy = p[1].y - p[0].y, vx = p[2].x - p[0].x,
                 vy = p[2].y - p[0].y, area = ux * vy - uy * vx;
    if (area == 0) return;
    double low[2] = {p[0].x, p[0].y}, high[2] = {p[0].x, p[0].y};
    for (int i = 1; i < 3; i++) {
        low[0] = fmin(low[0], p[i].x);
        low[1] = fmin(low[1], p[i].y);
        high[0] = fmax(high[0], p[i].x);
        high[1] = fmax(high[1], p[i].y);
    }
    const int n = CPSI_SQUARES;
    const int i0 = (int)fmax(0, fmin(n + 1, ceil((low[0] - frame->x[0]) / wide))),
              i1 = (int)fmin(n, fmax(-1, floor((high[0] - frame->x[0]) / wide))),
              j0 = (int)fmax(0, fmin(n + 1, ceil((low[1] - frame->y[0]) / tall))),
              j1 = (int)fmin(n, fmax(-1, floor((high[1] - frame->y[0]) / tall)));
    for (int j = j0; j <= j1; j++)
        for (int i = i0; i <= i1; i++) {
            const double a = frame->x[0] + wide * i - p[0].x, b = frame->y[0] + tall * j - p[0].y,
                         s = (a * vy - b * vx) / area, t = (ux * b - uy * a) / area;
            if (!(s >= 0 && t >= 0 && s + t <= 1)) continue;
            const double z = p[0].z + s * (p[1].z - p[0].z) + t * (p[2].z - p[0].z) + radius;
            relief->z[j][i] = fmax(relief->z[j][i], z); /* of NaN the other one */
            relief->low = fmin(relief->low, z);
            relief->high = fmax(relief->high, z);
        }
}

static void draw_contours(const Placed *mesh, const CpsiFrame *frame, FILE *out) {
    CpsiRelief relief = {.low = INFINITY, .high = -INFINITY};
    for (int j = 0; j <= CPSI_SQUARES; j++)
        for (int i = 0; i <= CPSI_SQUARES; i++) relief.z[j][i] = NAN;
    for (int t = 0; t < mesh->of.triangle_count; t++) {
        const Vec3 p[3] = {corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2)};
        add_to_relief(p, mesh->radius, frame, &relief);
    }
    cpsi_picture_contours(&relief, frame, out);
}

/* Where the triangles meet the paper at a coordinate towards the eye. */
static void draw_section(const Placed *mesh, double cut, const CpsiFrame *frame, FILE *out) {
    fprintf(out, "<path fill=\"none\" stroke=\"%s\" d=\"", SECTION);
    for (int t = 0; t < mesh->of.triangle_count; t++) {
        int found = 0;
        for (int i = 0; i < 3; i++) {
            const Vec3 a = corner(mesh, t, i), b = corner(mesh, t, (i + 1) % 3);
            if ((a.z < cut) == (b.z < cut)) continue;
            const Vec3 at = vec3_axpy((cut - a.z) / (b.z - a.z), vec3_sub(b, a), a);
            if (at.x < frame->x[0] || at.x > frame->x[1] || at.y < frame->y[0] ||
                at.y > frame->y[1])
                break;
            fprintf(out, "%s%.1f,%.1f", found++ % 2 ? "L" : "M", cpsi_frame_x(frame, at.x),
                    cpsi_frame_y(frame, at.y));
        }
    }
    fputs("\"/>\n", out);
}

void cpsi_picture_mesh(const CpsObstacle *o, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out) {
    const Rotation back = rotation_inverse(rotation_load(o->shape.rotation));
    const Vec3 point = vec3_load(o->point);
    const Placed mesh = {.of = cps_mesh_triangles(o->mesh),
                         .right = rotation_apply(back, view->right),
                         .up = rotation_apply(back, view->up),
                         .toward = rotation_apply(back, view->toward),
                         .x = vec3_dot(point, view->right),
                         .y = vec3_dot(point, view->up),
                         .z = vec3_dot(point, view->toward),
                         .radius = o->radius};
    draw_outline(&mesh, frame, view->plan ? SEEN_FROM_ABOVE : FILL, out);
    if (view->plan)
        draw_contours(&mesh, frame, out);
    else
        draw_section(&mesh, view->cut, frame, out);
}
