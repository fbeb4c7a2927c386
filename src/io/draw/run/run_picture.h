/* SPDX-License-Identifier: BSD-3-Clause */
/* Definitions shared by the pictures: dimensions of the sheet, the direction of view, and one
 * function per kind of picture. */
#ifndef CAPSTAN_SRC_IO_DRAW_RUN_RUN_PICTURE_H
#define CAPSTAN_SRC_IO_DRAW_RUN_RUN_PICTURE_H

#include "base/rotation.h"
#include "base/vec3.h"
#include "io/draw/svg.h"
#include "io/history.h"

/* In pixels. */
enum { CPSI_SHEET_WIDTH = 960, CPSI_FRAME_LEFT = 84, CPSI_FRAME_WIDTH = 740, CPSI_FRAME_TOP = 72 };

/* A parallel projection of the scene onto paper. */
typedef struct CpsiView {
    bool plan;
    Vec3 right, up, toward; /* unit vectors: along the paper, and from it to the eye */
    char x_label[80], y_label[80];
    double x[2], y[2]; /* ranges of everything drawn */
    double cut;        /* coordinate along `toward` at which an elevation intersects planes */
    bool true_scale;   /* heights are not exaggerated, since a round obstacle is visible */
} CpsiView;

CpsiView cpsi_view_plan(const CpsResults *results);
CpsiView cpsi_view_elevation(const CpsResults *results);
CpsiView cpsi_view_line(const CpsResults *results, int line); /* in its own vertical plane */

/* The obstacles, under everything else, as after a step, or for all steps (-1). */
void cpsi_picture_obstacles(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                            int step, FILE *out);

/* Ground: from above its contours, else its section with the paper. */
void cpsi_picture_ground(const CpsObstacle *ground, const CpsiView *view, const CpsiFrame *frame,
                         FILE *out);

/* Heights at the corners of the squares of a frame, NaN where there is nothing, with their range;
 * and contours at round heights. */
enum { CPSI_SQUARES = 120 };
typedef struct CpsiRelief {
    double z[CPSI_SQUARES + 1][CPSI_SQUARES + 1], low, high;
} CpsiRelief;

void cpsi_picture_contours(const CpsiRelief *relief, const CpsiFrame *frame, FILE *out);

/* A mesh: its outline, with contours from above and its section with the paper in an elevation. */
void cpsi_picture_mesh(const CpsObstacle *mesh, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out);
/* A capsule, torus, cone or box by its silhouette; and the ranges of the view that show it. */
void cpsi_picture_shape(const CpsObstacle *obstacle, const char *fill, const char *edge,
                        const CpsiView *view, const CpsiFrame *frame, FILE *out);
void cpsi_shape_extend(const CpsObstacle *obstacle, CpsiView *view);

/* The outlines of the sets to which ends of lines are held; and the ranges of the view that show
 * those, where its diagonal is then no longer than `most` [m]. */
void cpsi_picture_sets(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                       FILE *out);
void cpsi_view_include_sets(const CpsResults *results, double most, CpsiView *view);

/* Whether the silhouette is a circle: that of a ball, or of a cylinder seen from its end. */
bool cpsi_obstacle_is_circle(const CpsObstacle *obstacle, const CpsiView *view);

/* Corners of a body in a pose, relative to the origin of the views: the points on it, its reference
 * point and its centres. */
int cpsi_body_corner_count(const CpsResults *results, int body);
Vec3 cpsi_body_corner(const CpsResults *results, const CpsBodyReport *report, int body, int corner);

/* A body in a pose: the polygon around its corners, with the attributes `style`; and its own axes
 * at its reference point, of a fixed length on paper. */
void cpsi_picture_outline(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                          const CpsBodyReport *report, int body, const char *style, FILE *out);
void cpsi_picture_axes(const CpsResults *results, const CpsiView *view, const CpsiFrame *frame,
                       const CpsBodyReport *report, FILE *out);

/* Names so far, as boxes on paper: left, top, right, bottom. */
enum { CPSI_LABELS = 32 };
typedef struct CpsiLabels {
    int count;
    double box[CPSI_LABELS][4];
} CpsiLabels;

/* Write a name beside a place on paper, clear of the names so far where that is possible. */
void cpsi_label_put(CpsiLabels *labels, const CpsiFrame *frame, double x, double y,
                    const char *name, FILE *out);

/* One step: lines coloured by tension, with sticking and slipping parts. All steps: curves coloured
 * by step. */
void cpsi_picture_step(const CpsResults *results, const CpsiView *view,
                       const CpsiSnapshot *snapshot, FILE *out);
void cpsi_picture_steps(const CpsResults *results, const CpsiView *view, FILE *out);

/* All steps of each line in its own vertical plane, one below the other. */
void cpsi_picture_planes(const CpsResults *results, FILE *out);

/* Tension along the lines, all steps. */
void cpsi_picture_tension(const CpsResults *results, FILE *out);

/* Tensions and uplift at the ends, grounded and slipping length, over the steps. False: memory does
 * not suffice. */
bool cpsi_picture_over_steps(const CpsResults *results, FILE *out);

/* All pictures of a run, as files of its directory. */
CpsStatus cpsi_pictures_write(CpsResults *results, CpsError *err);

/* Force over displacement of every held end that moves along a closed cycle: loop-NAME.svg. */
CpsStatus cpsi_pictures_loops(CpsResults *results, CpsError *err);

#endif
