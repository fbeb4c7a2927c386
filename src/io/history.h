/* SPDX-License-Identifier: BSD-3-Clause */
/* Data shared by the writers of results and the pictures: the numbers of the history so far, and
 * sampled shapes for the pictures.
 *
 * Fields are written to files step by step. Memory contains one row of reports per step and at most
 * about sixty sampled shapes, so that it does not grow with the number of nodes. */
#ifndef CAPSTAN_SRC_IO_HISTORY_H
#define CAPSTAN_SRC_IO_HISTORY_H

#include <locale.h>
#include <stdbool.h>

#include "base/vec3.h"
#include "capstan/failure.h"
#include "capstan/results.h"
#include "io/base/directory/write_directory.h"

typedef struct CpsiNetcdf CpsiNetcdf;

typedef struct CpsiLineRow {
    CpsLineReport report;
    bool held[2];           /* whether the position of this end, or of its point, was imposed */
    CpsLineFailure failure; /* without its array */
    CpsWinchReport winch[2];
    CpsConstraintReport constraint[2];
    double open_reaction; /* [N] largest reaction on a node without contact */
} CpsiLineRow;

typedef struct CpsiBodyRow {
    CpsBodyReport report;
    CpsBodyMotion motion;
    double angle[3], heel;         /* [degrees] roll, pitch and yaw; heel (cps_body_angles) */
    double residual[2];            /* [N], [N m] sizes of what nothing balances */
    CpsBodyStiffness stiffness[2]; /* by kind; where that was asked for */
} CpsiBodyRow;

/* An obstacle after a step. */
typedef struct CpsiObstacleRow {
    double point[3], axis[3]; /* [m] relative to the origin of the views; [-] normal or axis */
    double rotation[4];       /* of a box or mesh, since the start */
    double turn, turned;      /* [rad] about its own axis in the step, and since the start */
    bool moved;               /* in the step */
} CpsiObstacleRow;

/* A point after a step. */
typedef struct CpsiPointRow {
    CpsPointReport report;
    CpsPointMotion motion;
} CpsiPointRow;

/* The motion in time of all lines, points and bodies together; 0 in quasi-static steps. */
typedef struct CpsiMotionRow {
    double time; /* [s] since the history began */
    CpsPace pace;
    CpsStepMotion of;
    double rejected, landed, changed, snatched; /* as there */
} CpsiMotionRow;

typedef struct CpsiRow {
    CpsStepReport report; /* its name is `name` */
    char *name;
    CpsBreak parted;
    double open_reaction; /* [N] largest over the lines */
    CpsiMotionRow motion;
    CpsiLineRow *line;
    CpsiPointRow *point;                /* (points) NULL without points */
    CpsiBodyRow *body;                  /* (bodies) NULL without bodies */
    CpsiObstacleRow *place;             /* (obstacles) NULL without obstacles */
    CpsStiffness (*stiffness)[2][2];    /* (lines) of ends A and B, by kind; NULL: not asked for */
    CpsStiffness (*point_stiffness)[2]; /* (points) by kind; likewise */
} CpsiRow;

/* Of an end that is at no point. */
enum { CPSI_AT_NO_POINT = -1 };

/* A state in addition to CpsNodeState: no contact, but friction. */
enum { CPSI_SHAPE_IN_AIR = 4 };

/* A line at one step, reduced to a number of points that a picture can show. */
typedef struct CpsiShape {
    int points;
    double *abscissa;     /* (points) [m] */
    double *position;     /* (points, 3) [m] */
    double *reference;    /* (points, 3) [m] at the beginning of the step */
    double *tension;      /* (points - 1) [N] mean over the elements between two points */
    unsigned char *state; /* (points) CpsNodeState, or CPSI_SHAPE_IN_AIR */
} CpsiShape;

typedef struct CpsiSnapshot {
    int step;         /* index of its row */
    CpsiShape *shape; /* one per line, with a single block of memory */
} CpsiSnapshot;

/* The steps first..last (inclusive) of an entry of the history. */
typedef struct CpsiStage {
    char *name;
    int first, last;
    bool moves;    /* an obstacle turns or moves in it */
    bool has_pace; /* its steps have the lengths that an error allows: `last` is known when it ends
                    */
    double end;    /* [s] the time when it ends, with the durations that the scene gives */
} CpsiStage;

struct CpsResults {
    CpsiDirectory *directory;
    CpsiNetcdf *netcdf;
    /* "C": numbers are written with a decimal point whatever the program's locale */
    locale_t locale;
    bool paraview;  /* .vtp and .pvd files are written */
    bool stiffness; /* ... and stiffness.csv */
    bool out_table; /* ... and history.out */
    bool failed;    /* a call has failed, so nothing may be committed */

    char *title; /* "" when the scene has none */
    double gravity[3];
    double origin[3]; /* [m] origin of the views */
    bool has_water_surface;
    double water_surface; /* [m] z, relative to the origin of the views */
    int obstacle_count;
    /* (obstacle_count), without friction sets, relative to the origin of the views */
    CpsObstacle *obstacle;
    int line_count;
    char **line_name;
    double *line_length; /* [m] */
    int *line_elements;
    int (*line_point)[2]; /* (line_count) the point of each end; CPSI_AT_NO_POINT: none */
    /* (line_count) sets of the ends, or of a point there, each but once, relative to the origin of
     * the views */
    CpsConstraint (*line_constraint)[2];
    int point_count;
    CpsPoint *point; /* (point_count) */
    int body_count;
    CpsBody *body; /* (body_count) */
    int stage_count;
    CpsiStage *stage;
    int planned_steps;  /* with the breaks so far; with a pace a guess until the end */
    bool has_pace;      /* a stage has one */
    bool lets_go;       /* cpsi_lets_go */
    bool in_time;       /* a step may have a duration */
    bool winds;         /* a line has a winch */
    bool has_sets;      /* an end of a line is held to a set */
    bool draws_sets;    /* ... or a point is */
    bool has_loads;     /* a line has springs, given loads or drag */
    bool begins_static; /* the first step places lines by statics */

    int row_count, row_capacity;
    CpsiRow *row;
    int snapshot_count, snapshot_capacity;
    CpsiSnapshot *snapshot;
};

/* Does the time pass a multiple of 1/parts of that of the whole history in the step? */
bool cpsi_results_passes(const CpsResults *results, int step, int parts);
/* Whether this step has its own plan view and elevation. All steps of a short history have; of a
 * long one the ends of its stages, or an even selection, and always the first and the last step,
 * and those in which a line parts. */
bool cpsi_results_pictured(const CpsResults *results, int step);

/* Whether ends of the scene's lines may be let go: its history does, or lines may part. Only then
 * do results say which ends were. */
bool cpsi_lets_go(const CpsScene *scene);
/* Whether steps of the scene may have a duration. */
bool cpsi_has_duration(const CpsScene *scene);
CpsiMotionRow cpsi_motion_row(const CpsEvolution *evolution);
/* Whether a line has a winch. Only then do results say what winches do. */
bool cpsi_has_winch(const CpsLine *line);
/* ... and whether an end of it is held to a set, likewise. */
bool cpsi_has_set(const CpsLine *line);
bool cpsi_has_point_set(const CpsScene *scene);
/* Polyline `piece`, from 0 on, of the outline of a set; returns its points, 0: there is no such
 * one. What has no end is shown to `reach` [m] from the place of it that is nearest to `about`. */
enum { CPSI_OUTLINE_POINTS = 49 };
int cpsi_set_outline(const CpsConstraint *on, Vec3 about, double reach, int piece,
                     Vec3 out[CPSI_OUTLINE_POINTS]);
/* All of them in turn: begin with {.reach = ..}, end at false; `line` is whose end is in the set.
 */
typedef struct CpsiOutlineWalk {
    double reach;                /* [m] 0: for each line its length */
    int line, end, piece, count; /* count: points of x */
    Vec3 x[CPSI_OUTLINE_POINTS];
} CpsiOutlineWalk;
bool cpsi_next_outline(const CpsResults *results, CpsiOutlineWalk *walk);
/* The point of an end of a line after a step; CPSI_AT_NO_POINT: none. */
int cpsi_results_point_of(const CpsResults *results, const CpsiRow *row, int line, int end);
/* Does a line end on the body then? */
bool cpsi_results_is_on_body(const CpsResults *results, const CpsiRow *row, int line, int body);
/* Is there a picture of each line in its own vertical plane: of a few that meet at points? */
bool cpsi_results_has_planes(const CpsResults *results);

/* An obstacle as it is after a step; of step -1 at the start. */
CpsObstacle cpsi_results_obstacle(const CpsResults *results, int step, int obstacle);
/* [rad] Its turn about its own axis since the start, after a step. */
double cpsi_results_turned(const CpsResults *results, int step, int obstacle);
/* Whether it turns about its own axis in a step, or otherwise moves in it. */
bool cpsi_results_turns(const CpsResults *results, int step, int obstacle);
bool cpsi_results_moves(const CpsResults *results, int step, int obstacle);
/* The places of all after the last step of the evolution, which follows the last row. */
void cpsi_obstacle_rows(const CpsResults *results, const CpsEvolution *evolution,
                        CpsiObstacleRow *out);

/* The surface of a capsule, torus, cone or box as (rows + 1) x (columns + 1) points; 0 rows of
 * other kinds. A cone ends at the distance `end` [m] from its tip. It has turned about its axis by
 * `turned` [rad]. */
void cpsi_shape_grid(const CpsObstacle *obstacle, int *rows, int *columns);
Vec3 cpsi_shape_point(const CpsObstacle *obstacle, double end, double turned, int row, int column);

/* The point in words: held, free, stick, slip, on_body; and how large a force nothing balances
 * there [N]. */
const char *cpsi_point_state(CpsPointState state);
const char *cpsi_point_water(CpsPointWater water); /* empty: none */
double cpsi_point_residual(const CpsPointReport *report);
/* The body in words: held, free; and the rows of reports, angles and residuals of all bodies. */
const char *cpsi_body_kind(CpsBodyKind kind);
void cpsi_body_row(const CpsEvolution *evolution, int body, bool stiffness, CpsiBodyRow *out);

/* Worst outcome so far. */
CpsOutcome cpsi_results_outcome(const CpsResults *results);

/* State of node j, from the stronger of its contacts: a node that slides on one obstacle slides. */
static inline unsigned char cpsi_node_state(const CpsLineView *view, int j) {
    const unsigned char state = view->state[j],
                        other =
                            view->contact_count > 1 ? view->state[view->element_count + 1 + j] : 0;
    return other > state ? other : state;
}

#endif
