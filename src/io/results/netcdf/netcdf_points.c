/* SPDX-License-Identifier: BSD-3-Clause */
/* The points and bodies of a scene in result.nc (see netcdf_obstacles.h): tables of the numbers and
 * of the vectors of their reports; and the nodes that are grasped, for which a line has
 * CPS_MAX_GRASPS places, of which the first ones are taken in a step. No name of a line's field
 * ends in "of_point" or "of_body", so that none of these names is taken, whatever a line is
 * called. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "io/base/text/columns.h"
#include "io/history.h"
#include "io/results/netcdf/netcdf_obstacles.h"

enum { XYZ = 3 };

static const struct {
    const char *name, *long_name, *units;
    size_t offset;
} VECTOR[CPSI_POINT_VECTORS] = {
    {"position_of_point", "where the point is", "m", offsetof(CpsPointReport, position)},
    {"lines_of_point", "sum of the forces of the lines on it", "N",
     offsetof(CpsPointReport, lines)},
    {"load_of_point", "force and weight of a free point", "N", offsetof(CpsPointReport, load)},
    {"support_of_point", "what holds a held point", "N", offsetof(CpsPointReport, support)},
    {"normal_of_point", "normal of the obstacle that it touches, 0: it touches none", "1",
     offsetof(CpsPointReport, normal)},
    {"friction_of_point", "friction of that obstacle on it", "N",
     offsetof(CpsPointReport, friction)},
    {"slip_of_point", "slip on that obstacle in the step", "m", offsetof(CpsPointReport, slip)},
    {"drag_of_point", "by which an anchor has given way in the step", "m",
     offsetof(CpsPointReport, drag)},
    {"residual_of_point", "sum of all forces on it", "N", offsetof(CpsPointReport, residual)},
};

static const struct {
    const char *name, *long_name, *units;
    CpsiMember member;
} NUMBER[CPSI_POINT_NUMBERS] = {
    {"reaction_of_point", "reaction of that obstacle along the normal", "N",
     CPSI_MEMBER(CpsPointReport, reaction)},
    {"dissipated_of_point", "energy dissipated by its friction in the step", "J",
     CPSI_MEMBER(CpsPointReport, dissipated)},
    {"buoyancy_of_point", "buoyancy of a point that may leave the water", "N",
     CPSI_MEMBER(CpsPointReport, buoyancy)},
    {"displaced_of_point", "weight of the water that it displaces when submerged", "N",
     CPSI_MEMBER(CpsPointReport, displaced)},
    {"capacity_used_of_point", "force along the ground over the holding capacity of an anchor", "1",
     CPSI_MEMBER(CpsPointReport, capacity_used)},
    {"uplift_used_of_point", "force up from the ground over the uplift limit of an anchor", "1",
     CPSI_MEMBER(CpsPointReport, uplift_used)},
    {"dragged_of_point", "sum of the lengths of its drags since the start", "m",
     CPSI_MEMBER(CpsPointReport, dragged)},
};

/* Where steps have a duration. */
static const struct {
    const char *name, *long_name, *units;
    size_t offset;
} MOTION[CPSI_POINT_MOTIONS] = {
    {"velocity_of_point", "velocity after the step", "m s-1", offsetof(CpsPointMotion, velocity)},
    {"reference_of_point", "x* of the scheme: the velocity is (position - reference)/k", "m",
     offsetof(CpsPointMotion, reference)},
    {"rest_velocity_of_point", "v* of the scheme: the acceleration is (v - v*)/k", "m s-1",
     offsetof(CpsPointMotion, rest_velocity)},
};

static const struct {
    const char *name, *long_name, *units;
    CpsiMember member;
} MOTION_NUMBER[CPSI_POINT_MOTION_NUMBERS] = {
    {"span_of_point", "k of the scheme, 0: a quasi-static step", "s",
     CPSI_MEMBER(CpsPointMotion, span)},
    {"kinetic_of_point", "kinetic energy of its own mass", "J",
     CPSI_MEMBER(CpsPointMotion, kinetic)},
    {"ledger_kinetic_of_point", "growth of that energy", "J",
     CPSI_MEMBER(CpsPointMotion, ledger.kinetic)},
    {"ledger_impact_of_point", "energy lost where it lands", "J",
     CPSI_MEMBER(CpsPointMotion, ledger.impact)},
    {"ledger_scheme_of_point", "energy lost by the scheme in time", "J",
     CPSI_MEMBER(CpsPointMotion, ledger.scheme)},
    {"ledger_settling_of_point", "energy lost where a quasi-static step brings it to rest", "J",
     CPSI_MEMBER(CpsPointMotion, ledger.settling)},
    {"ledger_damping_of_point", "energy lost to the damping of the ground that gives below it", "J",
     CPSI_MEMBER(CpsPointMotion, ledger.damping)},
};

typedef enum PointInt {
    POINT_STATE,
    POINT_OBSTACLE,
    POINT_TRIALS,
    POINT_HAS_PLACE,
    POINT_WATER
} PointInt;

static const struct {
    const char *name, *long_name;
} WHOLE[CPSI_POINT_INTS] = {
    [POINT_STATE] = {"state_of_point", "what holds the point"},
    [POINT_OBSTACLE] = {"obstacle_of_point",
                        "place of the obstacle that it touches in the scene, -1: none"},
    [POINT_TRIALS] = {"trials_of_point", "places tried in the step"},
    [POINT_HAS_PLACE] = {"has_place_of_point", "was a place found where the forces balance"},
    [POINT_WATER] = {"water_of_point", "where a point that may leave the water is"},
};

static const char *point_name(const CpsScene *scene, int k) { return scene->point[k].name; }
static const char *body_name(const CpsScene *scene, int k) { return scene->body[k].name; }

/* Was the velocity of a point or body given? The scheme then has its x* from it. */
static int define_given(CpsiNetcdfFile *file, const char *name, const int dimension[2]) {
    const int id = cpsi_netcdf_variable(file, "", name, NC_INT, 2, dimension,
                                        "was its velocity given in the step?", "1");
    cpsi_netcdf_flags(file, id, NC_INT, 2, NULL, "no yes");
    return id;
}

/* All names, separated by blanks. */
static void define_names(CpsiNetcdfFile *file, const CpsScene *scene, const char *attribute,
                         int count, const char *(*name)(const CpsScene *scene, int k)) {
    size_t size = 1;
    for (int k = 0; k < count; ++k) size += strlen(name(scene, k)) + 1;
    char *names = calloc(size, 1), *next = names;
    if (!names) cpsi_netcdf_keep(file, NC_ENOMEM);
    if (names)
        for (int k = 0; k < count; ++k)
            next +=
                snprintf(next, size - (size_t)(next - names), "%s%s", k ? " " : "", name(scene, k));
    cpsi_netcdf_text(file, NC_GLOBAL, attribute, names ? names : "");
    free(names);
}

/* What has a surface: points that float, and the waves on them. */
static void define_water(CpsiNetcdfFile *file, CpsiNetcdfPoints *points, const CpsScene *scene,
                         const int shape[3]) {
    points->floats = scene->has_water_surface;
    if (!points->floats) return;
    double *height = calloc((size_t)points->count, sizeof *height);
    if (!height) cpsi_netcdf_keep(file, NC_ENOMEM);
    for (int k = 0; height && k < points->count; ++k) height[k] = scene->point[k].height;
    if (height) cpsi_netcdf_numbers(file, "height_of_point", (size_t)points->count, height);
    free(height);
    points->direction =
        cpsi_netcdf_variable(file, "", "water_direction_of_point", NC_DOUBLE, 3, shape,
                             "by which its buoyancy is the force of the water", "1");
    points->level = cpsi_netcdf_variable(file, "", "water_level_of_point", NC_DOUBLE, 2, shape,
                                         "z of the surface of the water above or below it", "m");
    if (cpsi_has_duration(scene))
        points->surface_waves =
            cpsi_netcdf_variable(file, "", "ledger_waves_of_point", NC_DOUBLE, 2, shape,
                                 "work of the surface of the water as it rises", "J");
}

static void append_water(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                         size_t k, const CpsPointReport *report, double waves) {
    const size_t start[] = {step, k, 0}, count[] = {1, 1, XYZ};
    if (!points->floats) return;
    cpsi_netcdf_doubles(file, points->direction, start, count, report->water_direction);
    cpsi_netcdf_doubles(file, points->level, start, count, &report->water_level);
    if (points->in_time) cpsi_netcdf_doubles(file, points->surface_waves, start, count, &waves);
}

void cpsi_netcdf_define_points(CpsiNetcdfFile *file, CpsiNetcdfPoints *points,
                               const CpsScene *scene, int step, int xyz, const double origin[3]) {
    points->count = scene->point_count;
    if (scene->point_count == 0) return; /* a dimension of no length would be an unlimited one */
    define_names(file, scene, "points", scene->point_count, point_name);
    points->dimension = cpsi_netcdf_dimension(file, "point", (size_t)scene->point_count);
    const int shape[] = {step, points->dimension, xyz};
    points->kind =
        cpsi_netcdf_variable(file, "", "kind_of_point", NC_INT, 1, &points->dimension,
                             "how the point begins; state_of_point says how it goes on", "1");
    const int kinds = scene->body_count > 0 ? 3 : 2; /* on a body only where there are any */
    cpsi_netcdf_flags(file, points->kind, NC_INT, (size_t)kinds, NULL,
                      kinds == 3 ? "held free on_body" : "held free");
    points->weight =
        cpsi_netcdf_variable(file, "", "weight_of_point", NC_DOUBLE, 1, &points->dimension,
                             "weight under the gravity of the scene, negative: it is lifted", "N");
    points->capacity = cpsi_netcdf_variable(file, "", "holding_capacity_of_point", NC_DOUBLE, 1,
                                            &points->dimension,
                                            "force along the ground that an anchor can bear, 0: "
                                            "not given",
                                            "N");
    points->limit =
        cpsi_netcdf_variable(file, "", "uplift_limit_of_point", NC_DOUBLE, 1, &points->dimension,
                             "force up from the ground that an anchor can bear, 0: not "
                             "given",
                             "N");
    points->drags = cpsi_netcdf_variable(file, "", "drags_of_point", NC_INT, 1, &points->dimension,
                                         "does an anchor give way above its capacity", "1");
    cpsi_netcdf_flags(file, points->drags, NC_INT, 2, NULL, "no yes");
    for (int i = 0; i < CPSI_POINT_VECTORS; ++i)
        points->vector[i] = cpsi_netcdf_variable(file, "", VECTOR[i].name, NC_DOUBLE, 3, shape,
                                                 VECTOR[i].long_name, VECTOR[i].units);
    for (int i = 0; i < CPSI_POINT_NUMBERS; ++i)
        points->number[i] = cpsi_netcdf_variable(file, "", NUMBER[i].name, NC_DOUBLE, 2, shape,
                                                 NUMBER[i].long_name, NUMBER[i].units);
    for (int i = 0; i < CPSI_POINT_INTS; ++i)
        points->whole[i] = cpsi_netcdf_variable(file, "", WHOLE[i].name, NC_INT, 2, shape,
                                                WHOLE[i].long_name, "1");
    cpsi_netcdf_flags(file, points->whole[POINT_STATE], NC_INT, (size_t)kinds + 2, NULL,
                      kinds == 3 ? "held free stick slip on_body" : "held free stick slip");
    cpsi_netcdf_flags(file, points->whole[POINT_HAS_PLACE], NC_INT, 2, NULL, "no yes");
    cpsi_netcdf_flags(file, points->whole[POINT_WATER], NC_INT, 4, NULL,
                      "none submerged floating above");
    cpsi_netcdf_define_point_sets(file, &points->sets, scene, shape, origin);
    define_water(file, points, scene, shape);
    points->in_time = cpsi_has_duration(scene);
    if (!points->in_time) return;
    points->mass = cpsi_netcdf_variable(file, "", "mass_of_point", NC_DOUBLE, 1, &points->dimension,
                                        "mass that moves with it, beside those of the lines", "kg");
    points->inertia = cpsi_netcdf_variable(file, "", "inertia_of_point", NC_DOUBLE, 3, shape,
                                           "minus that mass times the acceleration", "N");
    for (int i = 0; i < CPSI_POINT_MOTIONS; ++i)
        points->motion[i] = cpsi_netcdf_variable(file, "", MOTION[i].name, NC_DOUBLE, 3, shape,
                                                 MOTION[i].long_name, MOTION[i].units);
    for (int i = 0; i < CPSI_POINT_MOTION_NUMBERS; ++i)
        points->motion_number[i] =
            cpsi_netcdf_variable(file, "", MOTION_NUMBER[i].name, NC_DOUBLE, 2, shape,
                                 MOTION_NUMBER[i].long_name, MOTION_NUMBER[i].units);
    points->given = define_given(file, "velocity_given_of_point", shape);
}

void cpsi_netcdf_write_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points,
                              const CpsScene *scene, const double origin[3]) {
    for (size_t k = 0; k < (size_t)points->count; ++k) {
        static const size_t ONE[] = {1};
        cpsi_netcdf_int(file, points->kind, &k, (int)scene->point[k].kind);
        cpsi_netcdf_doubles(file, points->weight, &k, ONE, &scene->point[k].weight);
        const CpsPoint *point = &scene->point[k];
        const double capacity = point->has_holding_capacity ? point->holding_capacity : 0,
                     limit = point->has_uplift_limit ? point->uplift_limit : 0;
        cpsi_netcdf_doubles(file, points->capacity, &k, ONE, &capacity);
        cpsi_netcdf_doubles(file, points->limit, &k, ONE, &limit);
        cpsi_netcdf_int(file, points->drags, &k, point->drags);
        cpsi_netcdf_write_set(file, &points->sets, k, &point->constraint, origin);
        if (points->in_time) cpsi_netcdf_doubles(file, points->mass, &k, ONE, &point->inertia);
    }
}

static void append_point(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                         size_t k, const CpsPointReport *report) {
    const size_t start[] = {step, k, 0}, count[] = {1, 1, XYZ};
    for (int i = 0; i < CPSI_POINT_VECTORS; ++i) {
        double value[XYZ];
        memcpy(value, (const char *)report + VECTOR[i].offset, sizeof value);
        cpsi_netcdf_doubles(file, points->vector[i], start, count, value);
    }
    for (int i = 0; i < CPSI_POINT_NUMBERS; ++i) {
        const double value = cpsi_member(report, NUMBER[i].member);
        cpsi_netcdf_doubles(file, points->number[i], start, count, &value);
    }
    if (points->sets.is_there)
        cpsi_netcdf_doubles(file, points->sets.reaction, start, count, report->set_reaction);
    const int whole[CPSI_POINT_INTS] = {[POINT_STATE] = (int)report->state,
                                        [POINT_OBSTACLE] = report->obstacle,
                                        [POINT_TRIALS] = report->trial_count,
                                        [POINT_HAS_PLACE] = report->has_place,
                                        [POINT_WATER] = (int)report->water};
    for (int i = 0; i < CPSI_POINT_INTS; ++i)
        cpsi_netcdf_int(file, points->whole[i], start, whole[i]);
}

static void append_motion(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                          size_t k, const CpsPointMotion *motion, const double inertia[XYZ]) {
    const size_t start[] = {step, k, 0}, count[] = {1, 1, XYZ};
    cpsi_netcdf_doubles(file, points->inertia, start, count, inertia);
    for (int i = 0; i < CPSI_POINT_MOTIONS; ++i) {
        double value[XYZ];
        memcpy(value, (const char *)motion + MOTION[i].offset, sizeof value);
        cpsi_netcdf_doubles(file, points->motion[i], start, count, value);
    }
    for (int i = 0; i < CPSI_POINT_MOTION_NUMBERS; ++i) {
        const double value = cpsi_member(motion, MOTION_NUMBER[i].member);
        cpsi_netcdf_doubles(file, points->motion_number[i], start, count, &value);
    }
    cpsi_netcdf_int(file, points->given, start, motion->velocity_given);
}

void cpsi_netcdf_append_points(CpsiNetcdfFile *file, const CpsiNetcdfPoints *points, size_t step,
                               const CpsEvolution *evolution) {
    for (int k = 0; k < points->count && file->status == NC_NOERR; ++k) {
        const CpsPointReport report = cps_evolution_point_view(evolution, k);
        append_point(file, points, step, (size_t)k, &report);
        const CpsPointMotion motion = cps_evolution_point_motion_view(evolution, k);
        if (points->in_time) append_motion(file, points, step, (size_t)k, &motion, report.inertia);
        append_water(file, points, step, (size_t)k, &report, motion.ledger.waves);
    }
}

/* ---- bodies ---- */

enum { DIRECTIONS = CPS_BODY_DIRECTIONS, QUATERNION = 4 };

/* The shape of a quantity of a body. A block is 3x3 of a 6x6 matrix. */
typedef enum Shape { NUMBER_OF, VECTOR_OF, ROTATION_OF, BLOCK_OF } Shape;

typedef struct BodyField {
    const char *name, *long_name, *units;
    size_t offset;
    Shape shape;
} BodyField;

/* Where entry i of an array of doubles lies. */
#define ENTRY(type, member, i) (offsetof(type, member) + (i) * sizeof(double))

/* The four blocks of a 6x6 matrix: of forces and moments by displacements (x) and rotations (r), or
 * by what of them the matrix multiplies. */
#define BLOCKS_OF(name, what, type, member, unit_xx, unit_xr, unit_rx, unit_rr)                 \
    {name "_xx_of_body", what ", force by displacement", unit_xx, ENTRY(type, member, 0),       \
     BLOCK_OF},                                                                                 \
        {name "_xr_of_body", what ", force by rotation", unit_xr, ENTRY(type, member, 3),       \
         BLOCK_OF},                                                                             \
        {name "_rx_of_body", what ", moment by displacement", unit_rx, ENTRY(type, member, 18), \
         BLOCK_OF},                                                                             \
    {                                                                                           \
        name "_rr_of_body", what ", moment by rotation", unit_rr, ENTRY(type, member, 21),      \
            BLOCK_OF                                                                            \
    }

static const BodyField CONSTANT[CPSI_BODY_CONSTANTS] = {
    {"weight_of_body", "weight under the gravity of the scene", "N", offsetof(CpsBody, weight),
     NUMBER_OF},
    {"buoyancy_of_body", "buoyancy under the gravity of the scene", "N",
     offsetof(CpsBody, buoyancy), NUMBER_OF},
    {"centre_of_gravity_of_body", "centre of gravity in the axes of the body", "m",
     offsetof(CpsBody, centre_of_gravity), VECTOR_OF},
    {"centre_of_buoyancy_of_body", "centre of buoyancy in the axes of the body", "m",
     offsetof(CpsBody, centre_of_buoyancy), VECTOR_OF},
    {"start_position_of_body", "where the reference point begins", "m", offsetof(CpsBody, position),
     VECTOR_OF},
    {"start_rotation_of_body", "rotation in which it begins, quaternion w x y z", "1",
     offsetof(CpsBody, rotation), ROTATION_OF},
    BLOCKS_OF("hydrostatics", "stiffness of the water from the pose in which it begins", CpsBody,
              hydrostatics, "N m-1", "N", "N", "N m"),
};

/* A force, and its moment about the reference point. */
#define WRENCH(name, what, member)                                                          \
    {name "_of_body", "force of " what, "N", ENTRY(CpsBodyReport, member, 0), VECTOR_OF}, { \
        name "_moment_of_body", "moment of " what " about the reference point", "N m",      \
            ENTRY(CpsBodyReport, member, 3), VECTOR_OF                                      \
    }

static const BodyField FIELD[CPSI_BODY_FIELDS] = {
    {"position_of_body", "where the reference point is", "m", offsetof(CpsBodyReport, position),
     VECTOR_OF},
    {"rotation_of_body", "rotation, quaternion w x y z", "1", offsetof(CpsBodyReport, rotation),
     ROTATION_OF},
    WRENCH("lines", "all lines", lines),
    WRENCH("load", "weight, water and given load", load),
    WRENCH("support", "what holds it", support),
    WRENCH("residual", "all together", residual),
    BLOCKS_OF("stiffness", "stiffness in the pose, 0 of a held body", CpsBodyReport, stiffness,
              "N m-1", "N", "N", "N m"),
    {"proof_of_body", "axis about which it is turned in every pose, 0 0 0: there is no such proof",
     "1", offsetof(CpsBodyReport, proof), VECTOR_OF},
    {"proof_moment_of_body", "least moment about that axis, else 0", "N m",
     offsetof(CpsBodyReport, proof_moment), NUMBER_OF},
};

/* Where steps have a duration. */
static const BodyField MASS[CPSI_BODY_MASSES] = {
    {"mass_of_body", "mass", "kg", offsetof(CpsBody, mass), NUMBER_OF},
    {"moments_of_inertia_of_body",
     "entries xx, yy, zz of the inertia matrix about the centre of gravity", "kg m2",
     ENTRY(CpsBody, inertia, 0), VECTOR_OF},
    {"products_of_inertia_of_body", "entries xy, xz, yz of that matrix", "kg m2",
     ENTRY(CpsBody, inertia, 3), VECTOR_OF},
    BLOCKS_OF("added_mass", "mass of the water that moves with it", CpsBody, added_mass, "kg",
              "kg m", "kg m", "kg m2"),
    BLOCKS_OF("damping_matrix", "linear damping", CpsBody, damping, "N s m-1", "N s", "N s",
              "N m s"),
    BLOCKS_OF("quadratic_damping", "quadratic damping", CpsBody, quadratic_damping, "N s2 m-2",
              "N s2", "N s2 m-1", "N m s2"),
};

static const BodyField FORCE[CPSI_BODY_FORCES] = {
    WRENCH("inertia", "its mass and added mass", inertia),
    WRENCH("damping", "damping", damping),
};

static const BodyField BODY_MOTION[CPSI_BODY_MOTIONS] = {
    {"velocity_of_body", "velocity of the reference point", "m s-1",
     offsetof(CpsBodyMotion, velocity), VECTOR_OF},
    {"turn_rate_of_body", "rate of rotation", "rad s-1", offsetof(CpsBodyMotion, turn_rate),
     VECTOR_OF},
    {"centre_velocity_of_body", "velocity of the centre of gravity", "m s-1",
     offsetof(CpsBodyMotion, centre_velocity), VECTOR_OF},
    {"span_of_body", "k of the scheme, 0: a quasi-static step", "s", offsetof(CpsBodyMotion, span),
     NUMBER_OF},
    {"kinetic_of_body", "kinetic energy with that of the added mass", "J",
     offsetof(CpsBodyMotion, kinetic), NUMBER_OF},
    {"damped_of_body", "energy dissipated by damping in the step", "J",
     offsetof(CpsBodyMotion, dissipated), NUMBER_OF},
    {"ledger_kinetic_of_body", "growth of the kinetic energy", "J",
     offsetof(CpsBodyMotion, ledger.kinetic), NUMBER_OF},
    {"ledger_scheme_of_body", "energy lost by the scheme in time", "J",
     offsetof(CpsBodyMotion, ledger.scheme), NUMBER_OF},
    {"ledger_settling_of_body", "energy lost where a quasi-static step brings it to rest", "J",
     offsetof(CpsBodyMotion, ledger.settling), NUMBER_OF},
    {"ledger_drag_of_body", "work done on the water against the drag of members and by radiation",
     "J", offsetof(CpsBodyMotion, ledger.drag), NUMBER_OF},
    {"ledger_waves_of_body", "work of the water's own acceleration in waves on members", "J",
     offsetof(CpsBodyMotion, ledger.waves), NUMBER_OF},
};

typedef enum BodyInt { BODY_STATE, BODY_TRIALS, BODY_STABLE, BODY_HAS_PLACE } BodyInt;

static const struct {
    const char *name, *long_name;
} BODY_WHOLE[CPSI_BODY_INTS] = {
    [BODY_STATE] = {"state_of_body", "what holds the body"},
    [BODY_TRIALS] = {"trials_of_body", "poses tried in the step"},
    [BODY_STABLE] = {"stable_of_body", "is the stiffness positive definite where it may move?"},
    [BODY_HAS_PLACE] = {"has_place_of_body", "was a pose found where the forces balance?"},
};

/* The dimensions of a quantity behind `first` ones, and their sizes. */
typedef struct Extent {
    int rank, dimension[4];
} Extent;

static int define_field(CpsiNetcdfFile *file, const BodyField *field, Extent extent, int xyz,
                        int quaternion) {
    const int each[] = {
        [NUMBER_OF] = -1, [VECTOR_OF] = xyz, [ROTATION_OF] = quaternion, [BLOCK_OF] = xyz};
    if (field->shape != NUMBER_OF) extent.dimension[extent.rank++] = each[field->shape];
    if (field->shape == BLOCK_OF) extent.dimension[extent.rank++] = xyz;
    return cpsi_netcdf_variable(file, "", field->name, NC_DOUBLE, extent.rank, extent.dimension,
                                field->long_name, field->units);
}

void cpsi_netcdf_define_bodies(CpsiNetcdfFile *file, CpsiNetcdfBodies *out,
                               const CpsiNetcdfPoints *points, const CpsScene *scene, int step,
                               int xyz) {
    out->count = scene->body_count;
    if (out->count == 0) return;
    define_names(file, scene, "bodies", scene->body_count, body_name);
    const int body = cpsi_netcdf_dimension(file, "body", (size_t)scene->body_count),
              direction = cpsi_netcdf_dimension(file, "direction", DIRECTIONS),
              quaternion = cpsi_netcdf_dimension(file, "quaternion", QUATERNION);
    const Extent constant = {1, {body}}, field = {2, {step, body}};
    out->kind = cpsi_netcdf_variable(file, "", "kind_of_body", NC_INT, 1, &body,
                                     "how the body begins; state_of_body says how it goes on", "1");
    cpsi_netcdf_flags(file, out->kind, NC_INT, 2, NULL, "held free");
    out->fixed = cpsi_netcdf_variable(
        file, "", "fixed_of_body", NC_INT, 2, (const int[]){body, direction},
        "does it not move in this direction while it is free? x, y, z, and about them", "1");
    cpsi_netcdf_flags(file, out->fixed, NC_INT, 2, NULL, "no yes");
    out->of_point = cpsi_netcdf_variable(file, "", "body_of_point", NC_INT, 1, &points->dimension,
                                         "place of its body in the scene, -1: on none", "1");
    out->place_of_point =
        cpsi_netcdf_variable(file, "", "place_on_body_of_point", NC_DOUBLE, 2,
                             (const int[]){points->dimension, xyz},
                             "where on its body it is, in the axes of the body", "m");
    cpsi_netcdf_may_miss(file, out->place_of_point);
    for (int i = 0; i < CPSI_BODY_CONSTANTS; ++i)
        out->constant[i] = define_field(file, &CONSTANT[i], constant, xyz, quaternion);
    for (int i = 0; i < CPSI_BODY_FIELDS; ++i)
        out->field[i] = define_field(file, &FIELD[i], field, xyz, quaternion);
    for (int i = 0; i < CPSI_BODY_INTS; ++i) {
        out->whole[i] = cpsi_netcdf_variable(file, "", BODY_WHOLE[i].name, NC_INT, 2,
                                             field.dimension, BODY_WHOLE[i].long_name, "1");
        if (i != BODY_TRIALS)
            cpsi_netcdf_flags(file, out->whole[i], NC_INT, 2, NULL,
                              i == BODY_STATE ? "held free" : "no yes");
    }
    out->in_time = cpsi_has_duration(scene);
    if (!out->in_time) return;
    for (int i = 0; i < CPSI_BODY_MASSES; ++i)
        out->mass[i] = define_field(file, &MASS[i], constant, xyz, quaternion);
    for (int i = 0; i < CPSI_BODY_FORCES; ++i)
        out->force[i] = define_field(file, &FORCE[i], field, xyz, quaternion);
    for (int i = 0; i < CPSI_BODY_MOTIONS; ++i)
        out->motion[i] = define_field(file, &BODY_MOTION[i], field, xyz, quaternion);
    out->given = define_given(file, "velocity_given_of_body", field.dimension);
}

/* A quantity of `of` at an index; `from` is subtracted from a place, NULL: nothing is. */
static void write_field(CpsiNetcdfFile *file, int variable, const BodyField *field,
                        const size_t index[2], int rank, const void *of, const double *from) {
    static const size_t EACH[] = {
        [NUMBER_OF] = 1, [VECTOR_OF] = XYZ, [ROTATION_OF] = QUATERNION, [BLOCK_OF] = XYZ};
    const size_t each = EACH[field->shape], rows = field->shape == BLOCK_OF ? XYZ : 1;
    double value[XYZ * QUATERNION];
    size_t start[4] = {0}, count[4] = {1, 1, 1, 1};
    for (int i = 0; i < rank; ++i) start[i] = index[i];
    count[rank] = field->shape == BLOCK_OF ? rows : each;
    if (field->shape == BLOCK_OF) count[rank + 1] = each;
    for (size_t row = 0; row < rows; ++row)
        memcpy(&value[each * row],
               (const char *)of + field->offset + row * DIRECTIONS * sizeof *value,
               each * sizeof *value);
    if (from)
        for (int a = 0; a < XYZ; ++a) value[a] -= from[a];
    cpsi_netcdf_doubles(file, variable, start, count, value);
}

void cpsi_netcdf_write_bodies(CpsiNetcdfFile *file, const CpsiNetcdfBodies *bodies,
                              const CpsScene *scene, const double origin[XYZ]) {
    if (bodies->count == 0) return;
    for (size_t k = 0; k < (size_t)scene->point_count; ++k) {
        const CpsPoint *point = &scene->point[k];
        const bool is_on = point->kind == CPS_POINT_KIND_ON_BODY;
        const double nowhere[XYZ] = {NAN, NAN, NAN};
        cpsi_netcdf_int(file, bodies->of_point, &k, is_on ? point->body : -1);
        cpsi_netcdf_doubles(file, bodies->place_of_point, (const size_t[]){k, 0},
                            (const size_t[]){1, XYZ}, is_on ? point->position : nowhere);
    }
    for (size_t k = 0; k < (size_t)bodies->count; ++k) {
        const CpsBody *body = &scene->body[k];
        const size_t at[2] = {k};
        cpsi_netcdf_int(file, bodies->kind, &k, (int)body->kind);
        for (size_t i = 0; i < DIRECTIONS; ++i)
            cpsi_netcdf_int(file, bodies->fixed, (const size_t[]){k, i}, body->fixed[i]);
        for (int i = 0; i < CPSI_BODY_CONSTANTS; ++i)
            write_field(file, bodies->constant[i], &CONSTANT[i], at, 1, body,
                        CONSTANT[i].offset == offsetof(CpsBody, position) ? origin : NULL);
        CpsBody whole = *body;
        cps_body_added_mass(scene, (int)k, whole.added_mass);
        if (bodies->in_time)
            for (int i = 0; i < CPSI_BODY_MASSES; ++i)
                write_field(file, bodies->mass[i], &MASS[i], at, 1, &whole, NULL);
    }
}

static void append_body_motion(CpsiNetcdfFile *file, const CpsiNetcdfBodies *bodies,
                               const size_t at[2], const CpsEvolution *evolution,
                               const CpsBodyReport *report) {
    const CpsBodyMotion motion = cps_evolution_body_motion(evolution, (int)at[1]);
    for (int i = 0; i < CPSI_BODY_FORCES; ++i)
        write_field(file, bodies->force[i], &FORCE[i], at, 2, report, NULL);
    for (int i = 0; i < CPSI_BODY_MOTIONS; ++i)
        write_field(file, bodies->motion[i], &BODY_MOTION[i], at, 2, &motion, NULL);
    cpsi_netcdf_int(file, bodies->given, at, motion.velocity_given);
}

void cpsi_netcdf_append_bodies(CpsiNetcdfFile *file, const CpsiNetcdfBodies *bodies, size_t step,
                               const CpsEvolution *evolution) {
    for (int k = 0; k < bodies->count && file->status == NC_NOERR; ++k) {
        const CpsBodyReport report = cps_evolution_body_view(evolution, k);
        const size_t at[2] = {step, (size_t)k};
        for (int i = 0; i < CPSI_BODY_FIELDS; ++i)
            write_field(file, bodies->field[i], &FIELD[i], at, 2, &report, NULL);
        if (bodies->in_time) append_body_motion(file, bodies, at, evolution, &report);
        const int whole[CPSI_BODY_INTS] = {[BODY_STATE] = (int)report.kind,
                                           [BODY_TRIALS] = report.trial_count,
                                           [BODY_STABLE] = report.is_stable,
                                           [BODY_HAS_PLACE] = report.has_place};
        for (int i = 0; i < CPSI_BODY_INTS; ++i)
            cpsi_netcdf_int(file, bodies->whole[i], at, whole[i]);
    }
}

/* ---- nodes that are grasped ---- */

static bool grasps(const CpsScene *scene, int line) {
    for (int i = 0; i < scene->stage_count; ++i)
        for (int k = 0; k < scene->stage[i].grasp_change_count; ++k)
            if (scene->stage[i].grasp_change[k].line == line) return true;
    return false;
}

void cpsi_netcdf_define_grasps(CpsiNetcdfFile *file, CpsiNetcdfGrasps *ids, const CpsScene *scene,
                               int line, int step, int xyz) {
    const char *of = scene->line[line].name;
    char name[NC_MAX_NAME + 1];
    ids->is_there = grasps(scene, line);
    if (!ids->is_there) return;
    snprintf(name, sizeof name, "%.200s_grasp", of);
    const int on[] = {step, cpsi_netcdf_dimension(file, name, CPS_MAX_GRASPS), xyz};
    ids->node = cpsi_netcdf_variable(file, of, "grasp_node", NC_INT, 2, on,
                                     "node that is held or pulled, -1: none", "1");
    ids->kind = cpsi_netcdf_variable(file, of, "grasp_kind", NC_BYTE, 2, on,
                                     "what is imposed on that node", "1");
    cpsi_netcdf_flags(file, ids->kind, NC_BYTE, 2, NULL, "held free");
    ids->held_position = cpsi_netcdf_variable(file, of, "grasp_held_position", NC_DOUBLE, 3, on,
                                              "imposed position of a node that is held", "m");
    ids->applied_force = cpsi_netcdf_variable(file, of, "grasp_applied_force", NC_DOUBLE, 3, on,
                                              "imposed force on a node that is pulled", "N");
    ids->force = cpsi_netcdf_variable(file, of, "grasp_force", NC_DOUBLE, 3, on,
                                      "force on the line at that node", "N");
    cpsi_netcdf_may_miss(file, ids->held_position);
    cpsi_netcdf_may_miss(file, ids->applied_force);
    cpsi_netcdf_may_miss(file, ids->force);
}

void cpsi_netcdf_append_grasps(CpsiNetcdfFile *file, const CpsiNetcdfGrasps *ids, size_t step,
                               const CpsLineView *view) {
    if (!ids->is_there) return;
    const size_t start[] = {step, 0, 0}, count[] = {1, CPS_MAX_GRASPS, XYZ};
    int node[CPS_MAX_GRASPS];
    unsigned char kind[CPS_MAX_GRASPS];
    double held[CPS_MAX_GRASPS][XYZ], applied[CPS_MAX_GRASPS][XYZ], force[CPS_MAX_GRASPS][XYZ];
    for (int k = 0; k < CPS_MAX_GRASPS; ++k) {
        const bool is = k < view->grasp_count;
        const CpsGrasp *grasp = &view->grasp[is ? k : 0];
        node[k] = is ? grasp->node : -1;
        kind[k] = !is || grasp->imposed.kind == CPS_END_KIND_FREE;
        for (int a = 0; a < XYZ; ++a) {
            held[k][a] = kind[k] ? NAN : grasp->imposed.value[a];
            applied[k][a] = is && kind[k] ? grasp->imposed.value[a] : NAN;
            force[k][a] = is ? grasp->force[a] : NAN;
        }
    }
    cpsi_netcdf_ints(file, ids->node, start, count, node);
    cpsi_netcdf_bytes(file, ids->kind, start, count, kind);
    cpsi_netcdf_doubles(file, ids->held_position, start, count, held[0]);
    cpsi_netcdf_doubles(file, ids->applied_force, start, count, applied[0]);
    cpsi_netcdf_doubles(file, ids->force, start, count, force[0]);
}

/* ---- winches ---- */

void cpsi_netcdf_define_winches(CpsiNetcdfFile *file, CpsiNetcdfWinches *ids, const CpsLine *line,
                                const int on[4]) {
    const int step = on[0], ends[] = {step, on[1]}, nodes[] = {step, on[2]},
              elements[] = {step, on[3]};
    const char *of = line->name;
    ids->is_there = cpsi_has_winch(line);
    if (!ids->is_there) return;
    ids->stored = cpsi_netcdf_variable(file, of, "stored", NC_DOUBLE, 2, ends,
                                       "natural length on the drum of a winch", "m");
    ids->pull = cpsi_netcdf_variable(file, of, "winch_pull", NC_DOUBLE, 2, ends,
                                     "pull of the line on the drum of a winch", "N");
    cpsi_netcdf_may_miss(file, ids->stored);
    cpsi_netcdf_may_miss(file, ids->pull);
    ids->length_off_drums =
        cpsi_netcdf_variable(file, of, "length_off_drums", NC_DOUBLE, 2, elements,
                             "natural length of the element that is on no drum", "m");
    ids->weight = cpsi_netcdf_variable(
        file, of, "node_weight_length", NC_DOUBLE, 2, nodes,
        "natural length of mean weight that the node carries, without what is on drums", "m");
    ids->work = cpsi_netcdf_variable(file, of, "ledger_winches", NC_DOUBLE, 1, &step,
                                     "work of the winches", "J");
}

void cpsi_netcdf_append_winches(CpsiNetcdfFile *file, const CpsiNetcdfWinches *ids, size_t step,
                                const CpsEvolution *evolution, int line) {
    if (!ids->is_there) return;
    const CpsLineView view = cps_evolution_line_view(evolution, line);
    const CpsLineReport report = cps_evolution_line_report(evolution, line);
    const size_t start[] = {step, 0}, ends[] = {1, 2}, one[] = {1, 1},
                 nodes[] = {1, (size_t)view.element_count + 1};
    double stored[2], pull[2];
    int off[2] = {0, view.element_count};
    for (int end = 0; end < 2; ++end) {
        const CpsWinchReport winch = cps_evolution_winch_report(evolution, line, end);
        stored[end] = winch.is_there ? winch.stored : NAN;
        pull[end] = winch.is_there ? winch.pull : NAN;
        if (winch.is_there) off[end] = winch.node;
    }
    cpsi_netcdf_doubles(file, ids->stored, start, ends, stored);
    cpsi_netcdf_doubles(file, ids->pull, start, ends, pull);
    cpsi_netcdf_doubles(file, ids->weight, start, nodes, view.weight_length);
    cpsi_netcdf_doubles(file, ids->work, start, one, &report.ledger.winches);
    for (int e = 0; e < view.element_count; ++e) {
        const size_t at[] = {step, (size_t)e};
        const double length = e < off[0] || e >= off[1] ? 0 : view.element_length[e];
        cpsi_netcdf_doubles(file, ids->length_off_drums, at, one, &length);
    }
}

/* ---- failure ---- */

void cpsi_netcdf_define_breaks(CpsiNetcdfFile *file, CpsiNetcdfBreaks *ids, const CpsScene *scene,
                               int step) {
    ids->is_there = cpsi_lets_go(scene);
    if (!ids->is_there) return;
    ids->line = cpsi_netcdf_variable(file, "", "break_line", NC_INT, 1, &step,
                                     "line that parts in the step, -1: none", "1");
    ids->end = cpsi_netcdf_variable(file, "", "break_end", NC_INT, 1, &step,
                                    "end at which it does, 0: A, 1: B, -1: no line parts", "1");
    ids->tension = cpsi_netcdf_variable(file, "", "break_tension", NC_DOUBLE, 1, &step,
                                        "tension at which it does", "N");
    cpsi_netcdf_may_miss(file, ids->tension);
}

void cpsi_netcdf_define_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                                CpsiNetcdfFailure *ids, const CpsEvolution *evolution, int i,
                                const int dimension[3]) {
    if (!breaks->is_there) return;
    const char *name = cps_evolution_line_view(evolution, i).name;
    ids->release = cpsi_netcdf_variable(file, name, "end_release", NC_BYTE, 2, dimension,
                                        "whether the end was let go, also from its point", "1");
    cpsi_netcdf_flags(file, ids->release, NC_BYTE, 4, NULL, "none released parted taken");
    if (cps_evolution_line_failure(evolution, i).has_break_at)
        ids->break_at = cpsi_netcdf_variable(file, name, "break_at", NC_DOUBLE, 1, &dimension[2],
                                             "tension above which the element parts, infinite: "
                                             "it does not",
                                             "N");
}

void cpsi_netcdf_write_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                               const CpsiNetcdfFailure *ids, const CpsEvolution *evolution, int i) {
    const CpsLineFailure failure = cps_evolution_line_failure(evolution, i);
    const size_t first = 0, elements = (size_t)cps_evolution_line_view(evolution, i).element_count;
    if (breaks->is_there && failure.has_break_at)
        cpsi_netcdf_doubles(file, ids->break_at, &first, &elements, failure.break_at);
}

void cpsi_netcdf_append_breaks(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *ids, size_t step,
                               const CpsEvolution *evolution) {
    const CpsBreak parted = cps_evolution_break(evolution);
    const size_t one = 1;
    const double tension = parted.is_break ? parted.tension : NAN;
    if (!ids->is_there) return;
    cpsi_netcdf_int(file, ids->line, &step, parted.is_break ? parted.line : -1);
    cpsi_netcdf_int(file, ids->end, &step, parted.is_break ? parted.end : -1);
    cpsi_netcdf_doubles(file, ids->tension, &step, &one, &tension);
}

void cpsi_netcdf_append_failure(CpsiNetcdfFile *file, const CpsiNetcdfBreaks *breaks,
                                const CpsiNetcdfFailure *ids, size_t step,
                                const CpsEvolution *evolution, int i) {
    const CpsLineFailure failure = cps_evolution_line_failure(evolution, i);
    const size_t start[] = {step, 0}, count[] = {1, 2};
    const unsigned char release[] = {(unsigned char)failure.release[0],
                                     (unsigned char)failure.release[1]};
    if (breaks->is_there) cpsi_netcdf_bytes(file, ids->release, start, count, release);
}

/* ---- lines of two stiffnesses ---- */

void cpsi_netcdf_define_stiffnesses(CpsiNetcdfFile *file, CpsiNetcdfStiffnesses *ids,
                                    const char *line, const CpsTwoStiffnesses *two,
                                    const int shape[2]) {
    if (!two->exists) return;
    ids->which = cpsi_netcdf_variable(file, line, "stiffness", NC_BYTE, 1, &shape[0],
                                      "which stiffness is in force", "1");
    cpsi_netcdf_flags(file, ids->which, NC_BYTE, 2, NULL, "static dynamic");
    ids->rest_strain = cpsi_netcdf_variable(
        file, line, "rest_strain", NC_DOUBLE, 2, shape,
        "strain at which an element would be without tension, by the stiffness in force", "1");
    ids->compliance_factor =
        cpsi_netcdf_variable(file, line, "dynamic_compliance_factor", NC_DOUBLE, 1, &shape[1],
                             "compliance_factor of the dynamic stiffness", "1");
    if (two->at_dynamic.spring_count == 0) return;
    char name[NC_MAX_NAME + 1];
    snprintf(name, sizeof name, "%.200s_dynamic_spring", line);
    const int spring = cpsi_netcdf_dimension(file, name, (size_t)two->at_dynamic.spring_count);
    ids->spring[0] = cpsi_netcdf_variable(file, line, "dynamic_spring_element", NC_INT, 1, &spring,
                                          "spring_element of the dynamic stiffness", "1");
    ids->spring[1] = cpsi_netcdf_variable(file, line, "dynamic_spring_strain", NC_DOUBLE, 1,
                                          &spring, "spring_strain of the dynamic stiffness", "1");
    ids->spring[2] =
        cpsi_netcdf_variable(file, line, "dynamic_spring_stiffness", NC_DOUBLE, 1, &spring,
                             "spring_stiffness of the dynamic stiffness", "N");
}

void cpsi_netcdf_write_stiffnesses(CpsiNetcdfFile *file, const CpsiNetcdfStiffnesses *ids,
                                   size_t elements, const CpsTwoStiffnesses *two) {
    const size_t first = 0, springs = (size_t)two->at_dynamic.spring_count;
    if (!two->exists) return;
    cpsi_netcdf_doubles(file, ids->compliance_factor, &first, &elements,
                        two->at_dynamic.compliance_factor);
    if (springs == 0) return;
    cpsi_netcdf_ints(file, ids->spring[0], &first, &springs, two->at_dynamic.spring_element);
    cpsi_netcdf_doubles(file, ids->spring[1], &first, &springs, two->at_dynamic.spring_strain);
    cpsi_netcdf_doubles(file, ids->spring[2], &first, &springs, two->at_dynamic.spring_stiffness);
}

void cpsi_netcdf_append_stiffnesses(CpsiNetcdfFile *file, const CpsiNetcdfStiffnesses *ids,
                                    size_t step, size_t elements, const CpsTwoStiffnesses *two) {
    if (!two->exists) return;
    const size_t start[] = {step, 0}, count[] = {1, elements};
    const unsigned char which = two->is_dynamic;
    cpsi_netcdf_bytes(file, ids->which, start, count, &which);
    cpsi_netcdf_doubles(file, ids->rest_strain, start, count, two->rest_strain);
}
