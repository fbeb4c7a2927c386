/* SPDX-License-Identifier: BSD-3-Clause */
/* The obstacles of a scene in result.nc: their numbers, friction sets and turns; and its points and
 * bodies (netcdf_points.c). */
#ifndef CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_OBSTACLES_H
#define CAPSTAN_SRC_IO_RESULTS_NETCDF_NETCDF_OBSTACLES_H

#include "capstan/failure.h"
#include "capstan/set.h"
#include "capstan/two_stiffnesses.h"
#include "io/results/netcdf/netcdf_file.h"

enum {
    CPSI_OBSTACLE_FIELDS = 8,
    CPSI_OBSTACLE_MOVES = 5,
    CPSI_SHAPE_FIELDS = 6,
    CPSI_SET_FIELDS = 5,
    CPSI_GROUND_FIELDS = 4
};

/* Variables of the ground of one obstacle, negative: there is none; or of its mesh. */
typedef struct CpsiNetcdfGround {
    int field[CPSI_GROUND_FIELDS];
    int mesh[2]; /* vertices, triangles; unused of what is none */
} CpsiNetcdfGround;

typedef struct CpsiNetcdfObstacles {
    int count;
    bool moves;                    /* one of them does; else the next ones are unused */
    int move[CPSI_OBSTACLE_MOVES]; /* of each step */
    int dimension, turn, field[CPSI_OBSTACLE_FIELDS]; /* unused without obstacles */
    int shape_field[CPSI_SHAPE_FIELDS];               /* unused where has_shapes is false: */
    bool has_shapes; /* some are neither planes nor outside of cylinders, balls, ground, surfaces */
    int set_field[CPSI_SET_FIELDS]; /* unused without sets, */
    size_t set_rows, set_unknowns;  /* where these are 0 */
    /* (count) while the file begins; zeroed where an obstacle has none */
    CpsSetConic *set;
    CpsiNetcdfGround *ground; /* (count) likewise */
} CpsiNetcdfObstacles;

/* Define the variables; `step` and `xyz` are dimensions. */
void cpsi_netcdf_define_obstacles(CpsiNetcdfFile *file, CpsiNetcdfObstacles *out,
                                  const CpsScene *scene, int step, int xyz);
/* Write everything that does not change, relative to the origin of the lines' coordinates. */
void cpsi_netcdf_write_obstacles(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                                 const CpsScene *scene, const double origin[3]);
/* Write how they moved in the last step, as step number `step`, and where they are. */
void cpsi_netcdf_append_obstacles(CpsiNetcdfFile *file, const CpsiNetcdfObstacles *obstacles,
                                  size_t step, const CpsEvolution *evolution);
/* Free the conic forms of the sets, and what is kept of ground. */
void cpsi_netcdf_free_sets(CpsiNetcdfObstacles *obstacles);

enum { CPSI_POINT_VECTORS = 9, CPSI_POINT_NUMBERS = 7, CPSI_POINT_INTS = 5 };
/* in time */
enum { CPSI_POINT_MOTIONS = 3, CPSI_POINT_MOTION_NUMBERS = 7 };

/* The sets to which ends of a line, or points, are held (capstan/constraint.h). */
typedef struct CpsiNetcdfSets {
    bool is_there; /* the line, or a point, has one */
    int kind, point, axis, length, radius, size, rotation, reaction;
} CpsiNetcdfSets;

typedef struct CpsiNetcdfPoints {
    int count;
    int dimension, kind, weight; /* these and the next ones are unused without points */
    int capacity, limit, drags;
    int vector[CPSI_POINT_VECTORS], number[CPSI_POINT_NUMBERS], whole[CPSI_POINT_INTS];
    CpsiNetcdfSets sets;
    bool floats; /* unused without: */
    int direction, level, surface_waves;
    bool in_time; /* unused without: */
    int mass, inertia, motion[CPSI_POINT_MOTIONS], motion_number[CPSI_POINT_MOTION_NUMBERS], given;
} CpsiNetcdfPoints;

/* Define the variables; write what does not change; and what the last step has found, as step
 * number `step`, relative to the origin of the lines' coordinates. */
void cpsi_netcdf_define_points(CpsiNetcdfFile *file, CpsiNetcdfPoints *out, const CpsScene *scene,
                               int step, int xyz, const double origin[3]);
void cpsi_netcdf_write_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points,
                              const CpsScene *scene, const double origin[3]);
void cpsi_netcdf_append_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                               const CpsEvolution *evolution);

enum { CPSI_BODY_CONSTANTS = 10, CPSI_BODY_FIELDS = 16, CPSI_BODY_INTS = 4 };
/* in time: constants, fields of the report, fields of the motion */
enum { CPSI_BODY_MASSES = 15, CPSI_BODY_FORCES = 4, CPSI_BODY_MOTIONS = 11 };

typedef struct CpsiNetcdfBodies {
    int count;
    /* these and the next ones are unused without bodies */
    int kind, fixed, of_point, place_of_point;
    int constant[CPSI_BODY_CONSTANTS], field[CPSI_BODY_FIELDS], whole[CPSI_BODY_INTS];
    bool in_time; /* unused without: */
    int mass[CPSI_BODY_MASSES], force[CPSI_BODY_FORCES], motion[CPSI_BODY_MOTIONS], given;
} CpsiNetcdfBodies;

/* The same of the bodies, and of which points are on them. */
void cpsi_netcdf_define_bodies(CpsiNetcdfFile *file, CpsiNetcdfBodies *out,
                               const CpsiNetcdfPoints *points, const CpsScene *scene, int step,
                               int xyz);
void cpsi_netcdf_write_bodies(CpsiNetcdfFile *file, const CpsiNetcdfBodies *bodies,
                              const CpsScene *scene, const double origin[3]);
void cpsi_netcdf_append_bodies(CpsiNetcdfFile *file, const CpsiNetcdfBodies *bodies, size_t step,
                               const CpsEvolution *evolution);
/* Ends that are let go and lines that part. */
typedef struct CpsiNetcdfBreaks {
    bool is_there; /* cpsi_lets_go */
    int line, end, tension;
} CpsiNetcdfBreaks;
typedef struct CpsiNetcdfFailure {
    int release, break_at; /* break_at: unused where no element has one */
} CpsiNetcdfFailure;

/* Define the variables of the run, and of line number i; none in a scene that lets nothing go. */
void cpsi_netcdf_define_breaks(CpsiNetcdfFile *file, CpsiNetcdfBreaks *ids, const CpsScene *scene,
                               int step);
void cpsi_netcdf_define_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                                CpsiNetcdfFailure *ids, const CpsEvolution *evolution, int i,
                                const int dimension[3]); /* of steps, ends, and elements */
/* Write what does not change, and what the last step has found. */
void cpsi_netcdf_write_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                               const CpsiNetcdfFailure *ids, const CpsEvolution *evolution, int i);
void cpsi_netcdf_append_breaks(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *ids, size_t step,
                               const CpsEvolution *evolution);
void cpsi_netcdf_append_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                                const CpsiNetcdfFailure *ids, size_t step,
                                const CpsEvolution *evolution, int i);

/* Nodes of a line between its ends that are held or pulled. */
typedef struct CpsiNetcdfGrasps {
    bool is_there; /* the history grasps nodes of the line */
    int node, kind, held_position, applied_force, force;
} CpsiNetcdfGrasps;

/* Define the variables of a line of the scene; none where its history grasps no node of it. */
void cpsi_netcdf_define_grasps(CpsiNetcdfFile *file, CpsiNetcdfGrasps *ids, const CpsScene *scene,
                               int line, int step, int xyz);
/* ... and write those of a step. */
void cpsi_netcdf_append_grasps(CpsiNetcdfFile *file, const CpsiNetcdfGrasps *ids, size_t step,
                               const CpsLineView *view);

/* The motion in time of a scene; nothing of one without steps in time. Of quasi-static steps among
 * them velocities and spans are 0. */
enum { CPSI_MOTION_NUMBERS = 15 };

typedef struct CpsiNetcdfTime {
    bool is_there; /* otherwise all other variables are unused */
    int time, length, error, rejected;
} CpsiNetcdfTime;

typedef struct CpsiNetcdfMotion {
    bool is_there; /* the line has inertia */
    int mass, velocity, rest_velocity, span, number[CPSI_MOTION_NUMBERS];
    bool has_damping;
    int elongation, rest;
} CpsiNetcdfMotion;

/* Define the variables of the run; write those of a step. */
void cpsi_netcdf_define_time(CpsiNetcdfFile *file, CpsiNetcdfTime *ids, const CpsScene *scene,
                             int step);
void cpsi_netcdf_append_time(CpsiNetcdfFile *file, const CpsiNetcdfTime *ids, size_t step,
                             const CpsEvolution *evolution);

/* The same of a line, and what does not change; the dimensions are step, node, xyz and element. */
void cpsi_netcdf_define_motion(CpsiNetcdfFile *file, const CpsiNetcdfTime *time,
                               CpsiNetcdfMotion *ids, const CpsLine *line, const int dimension[4]);
void cpsi_netcdf_write_motion(CpsiNetcdfFile *file, const CpsiNetcdfMotion *ids,
                              const CpsEvolution *evolution, int line);
void cpsi_netcdf_append_motion(CpsiNetcdfFile *file, const CpsiNetcdfMotion *ids, size_t step,
                               const CpsEvolution *evolution, int line);

/* The winches of a line, and what is off their drums. */
typedef struct CpsiNetcdfWinches {
    bool is_there;              /* the line has a winch */
    const double *whole_length; /* (elements) [m] as if nothing were on drums */
    int length_off_drums, stored, pull, weight, work;
} CpsiNetcdfWinches;

/* Define the variables of a line of the scene, none where it has no winch; and write those of a
 * step. */
void cpsi_netcdf_define_winches(CpsiNetcdfFile *file, CpsiNetcdfWinches *ids, const CpsLine *line,
                                const int on[4]);
void cpsi_netcdf_append_winches(CpsiNetcdfFile *file, const CpsiNetcdfWinches *ids, size_t step,
                                const CpsEvolution *evolution, int line);

/* Define the variables of a line of the scene, none where it has no such end; the dimensions are
 * step, end, xyz. Both these and what is written once are relative to an origin. */
void cpsi_netcdf_define_sets(CpsiNetcdfFile *file, CpsiNetcdfSets *ids, const CpsLine *line,
                             const int dimension[3], const double origin[3]);
/* ... and of the points of a scene, with the dimensions step, point, xyz. */
void cpsi_netcdf_define_point_sets(CpsiNetcdfFile *file, CpsiNetcdfSets *ids, const CpsScene *scene,
                                   const int dimension[3], const double origin[3]);
/* Write the set of an end or a point. */
void cpsi_netcdf_write_set(CpsiNetcdfFile *file, const CpsiNetcdfSets *ids, size_t owner,
                           const CpsConstraint *on, const double origin[3]);
void cpsi_netcdf_append_sets(CpsiNetcdfFile *file, const CpsiNetcdfSets *ids, size_t step,
                             const CpsEvolution *evolution, int line);

/* The water about a line with drag in a scene whose program moves it (capstan/loads.h); nothing
 * else. The dimensions are those of an array of vectors over elements. */
typedef struct CpsiNetcdfWater {
    bool is_there;
    int velocity, acceleration;
} CpsiNetcdfWater;

void cpsi_netcdf_define_water(CpsiNetcdfFile *file, CpsiNetcdfWater *ids, const CpsScene *scene,
                              int line, const int dimension[3]);
void cpsi_netcdf_append_water(CpsiNetcdfFile *file, const CpsiNetcdfWater *ids, size_t step,
                              const CpsEvolution *evolution, int line);

/* The potential of a program on a line (capstan/loads.h); nothing of other lines. The dimensions
 * are step, node, xyz. */
typedef struct CpsiNetcdfPotential {
    bool is_there;
    int energy, force;
} CpsiNetcdfPotential;

void cpsi_netcdf_define_potential(CpsiNetcdfFile *file, CpsiNetcdfPotential *ids,
                                  const CpsLine *line, const int dimension[3]);
void cpsi_netcdf_append_potential(CpsiNetcdfFile *file, const CpsiNetcdfPotential *ids, size_t step,
                                  const CpsEvolution *evolution, int line);

/* How obstacles give, and the widths with which lines bear on them; nothing where none gives. */
void cpsi_netcdf_define_soft(CpsiNetcdfFile *file, const CpsScene *scene);
/* The current as attributes: the density, z and velocity of row after row; the waves: amplitude,
 * period, direction and phase [rad] about the origin of the scene, one after the other, depth,
 * which deep water has not, and ramp; and the drag of lines.
 */
void cpsi_netcdf_define_current(CpsiNetcdfFile *file, const CpsScene *scene, double origin_z);

/* Of a line with a static and a dynamic stiffness: the dynamic one, and which of the two is in
 * force in each step. Nothing of other lines. */
typedef struct CpsiNetcdfStiffnesses {
    int which, rest_strain, compliance_factor, spring[3];
} CpsiNetcdfStiffnesses;

/* The dimensions are step and element. */
void cpsi_netcdf_define_stiffnesses(CpsiNetcdfFile *file, CpsiNetcdfStiffnesses *ids,
                                    const char *line, const CpsTwoStiffnesses *two,
                                    const int shape[2]);
void cpsi_netcdf_write_stiffnesses(CpsiNetcdfFile *file, const CpsiNetcdfStiffnesses *ids,
                                   size_t elements, const CpsTwoStiffnesses *two);
void cpsi_netcdf_append_stiffnesses(CpsiNetcdfFile *file, const CpsiNetcdfStiffnesses *ids,
                                    size_t step, size_t elements, const CpsTwoStiffnesses *two);

#endif
