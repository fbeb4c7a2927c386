/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of a scene file's keys (see scene_keys.h). */
#include "io/schema/tables/scene_keys.h"

#include "io/schema/loads/load_keys.h"
#include "io/schema/rows.h"
#include "io/schema/tables/set_keys.h"

/* ---- obstacles ---- */

static const CpsiKey PLANE_KEYS[] = {
    {"point", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "a point of the plane"},
    {"normal", OPTIONAL, POINT(Obstacle, obstacle.normal, 3), ANY, .fallback = "[0, 0, 1]",
     .help = "points to the side where lines may be; of any length but zero"},
};
static const CpsiMapping PLANE = {"plane", KEYS(PLANE_KEYS)};

/* of what has a radius */
#define INSIDE                                                                     \
    {                                                                              \
        "inside", OPTIONAL, FLAG(Obstacle, obstacle.shape.inside),                 \
            .fallback = "false", .help = "lines are inside of it, and not outside" \
    }

static const CpsiKey CYLINDER_KEYS[] = {
    {"point", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "a point of the axis"},
    {"axis", OPTIONAL, POINT(Obstacle, obstacle.axis, 3), ANY, .fallback = "[0, 1, 0]",
     .help = "direction of the axis, of any length but zero; turns follow the right-hand rule"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of the cylinder"},
    INSIDE,
};
static const CpsiMapping CYLINDER = {"cylinder", KEYS(CYLINDER_KEYS)};

static const CpsiKey SPHERE_KEYS[] = {
    {"centre", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m", .formerly = "center",
     .fallback = "[0, 0, 0]", .help = "centre of the ball"},
    {"axis", OPTIONAL, POINT(Obstacle, obstacle.axis, 3), ANY, .fallback = "[0, 1, 0]",
     .help = "what the ball turns about, through its centre; of any length but zero"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of the ball"},
    INSIDE,
};
static const CpsiMapping SPHERE = {"sphere", KEYS(SPHERE_KEYS)};

static const CpsiKey GROUND_KEYS[] = {
    {"file", REQUIRED, TEXT(Obstacle, grid, 255), ANY, .help = "grid of heights, beside this file"},
    {"form", REQUIRED, WORD(Obstacle, form), .words = "esri xyz netcdf moordyn_c moordyn_f",
     .help = "form of the file: ESRI ASCII grid; rows x y z of all points of a grid; classic "
             "netCDF; or a bathymetry file of MoorDyn in C or in Fortran"},
    {"variable", OPTIONAL, TEXT(Obstacle, variable, 64), ANY, .fallback = "\"z\"",
     .help = "of a netCDF file: its variable of heights over y and x"},
    {"depths", OPTIONAL, FLAG(Obstacle, are_depths), .fallback = "false",
     .help = "the file has depths, downwards, in place of heights; those of moordyn_f always are"},
    {"point", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "where the origin of the file's coordinates is in the scene"},
    {"extend", OPTIONAL, FLAG(Obstacle, extends), .fallback = "false",
     .help = "beyond its edges it goes on with their slopes; else lines that leave it are refused"},
    {"friction_factor", OPTIONAL, TEXT(Obstacle, factors, 255), ANY,
     .help = "a second file of the same form and points: factors of the friction, bilinear"},
};
static const CpsiMapping GROUND = {"ground", KEYS(GROUND_KEYS)};

#define CENTRE                                                               \
    {                                                                        \
        "centre", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY,         \
            .unit = "m", .fallback = "[0, 0, 0]", .help = "the middle of it" \
    }

static const CpsiKey CAPSULE_KEYS[] = {
    CENTRE,
    {"axis", OPTIONAL, POINT(Obstacle, obstacle.axis, 3), ANY, .fallback = "[0, 1, 0]",
     .help = "direction of the axis, of any length but zero; turns follow the right-hand rule"},
    {"length", REQUIRED, NUMBER(Obstacle, obstacle.shape.length), NOT_NEGATIVE, .unit = "m",
     .help = "between the centres of its round ends: of the cylinder alone"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of cylinder and ends"},
    INSIDE,
};
static const CpsiMapping CAPSULE = {"capsule", KEYS(CAPSULE_KEYS)};

static const CpsiKey TORUS_KEYS[] = {
    CENTRE,
    {"axis", OPTIONAL, POINT(Obstacle, obstacle.axis, 3), ANY, .fallback = "[0, 1, 0]",
     .help = "direction of its axis of rotation, of any length but zero"},
    {"main_radius", REQUIRED, NUMBER(Obstacle, obstacle.shape.main_radius), POSITIVE, .unit = "m",
     .help = "of the circle that the middle of the tube follows, above radius"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of the tube"},
    INSIDE,
};
static const CpsiMapping TORUS = {"torus", KEYS(TORUS_KEYS)};

static const CpsiKey CONE_KEYS[] = {
    {"tip", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "the outermost point of its round tip"},
    {"axis", REQUIRED, POINT(Obstacle, obstacle.axis, 3), ANY,
     .help = "direction from the tip into the cone, which has no end; of any length but zero"},
    {"angle", REQUIRED, NUMBER(Obstacle, cone_angle), POSITIVE, .unit = "degrees",
     .help = "between axis and side, below 90"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of the ball that rounds its tip"},
    INSIDE,
};
static const CpsiMapping CONE = {"cone", KEYS(CONE_KEYS)};

static const CpsiKey BOX_KEYS[] = {
    CENTRE,
    {"size", REQUIRED, POINT(Obstacle, obstacle.shape.size, 3), 0, CPSI_LARGEST, true, .unit = "m",
     .help = "from face to face along its own axes, each above twice the radius"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "radius of its edges and corners"},
    {"rotation", OPTIONAL, MAPPING(Obstacle, rotation), .inside = &cpsi_rotation_keys,
     .fallback = "{\"quaternion\": [1, 0, 0, 0]}",
     .help = "turns its own axes, which begin as those of the scene"},
    INSIDE,
};
static const CpsiMapping BOX = {"box", KEYS(BOX_KEYS)};

static const CpsiKey MESH_KEYS[] = {
    {"file", REQUIRED, TEXT(Obstacle, triangles, 255), ANY, .help = "triangles, beside this file"},
    {"form", REQUIRED, WORD(Obstacle, mesh_form), .words = "stl obj",
     .help = "form of the file: STL, binary or text; or Wavefront OBJ"},
    {"radius", REQUIRED, NUMBER(Obstacle, obstacle.radius), POSITIVE, .unit = "m",
     .help = "by which the triangles are inflated, and convex edges rounded"},
    {"scale", OPTIONAL, NUMBER(Obstacle, scale), POSITIVE, .fallback = "1",
     .help = "metres per unit of the file: 0.001 for millimetres"},
    {"point", OPTIONAL, POINT(Obstacle, obstacle.point, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "where the origin of the file's coordinates is in the scene"},
    {"rotation", OPTIONAL, MAPPING(Obstacle, rotation), .inside = &cpsi_rotation_keys,
     .help = "of the file's axes"},
    {"two_sided", OPTIONAL, FLAG(Obstacle, two_sided), .fallback = "false",
     .help = "a sheet that lines may touch from both sides; else they stay on the side from which "
             "corners are seen counter-clockwise"},
};
static const CpsiMapping MESH = {"mesh", KEYS(MESH_KEYS)};

static const CpsiKey FRICTION_KEYS[] = {
    {"axial", ONE_OF, NUMBER(Obstacle, obstacle.friction), NOT_NEGATIVE,
     .help = "coefficient along the line, or along the grain"},
    {"set", ONE_OF, EXPRESSION(Obstacle, set), .inside = &cpsi_set_words,
     .help = "friction forces on the line per unit of normal force, along the line or the grain "
             "and across it to its left: any bounded set of the plane with 0 in it, in the "
             "words of law files"},
    {"lateral", OPTIONAL, NUMBER(Obstacle, obstacle.friction_lateral), NOT_NEGATIVE,
     .with = "axial", .help = "coefficient across it; by default the axial one"},
    {"shape", OPTIONAL, WORD(Obstacle, obstacle.friction_shape), .words = "ellipse box",
     .with = "axial", .fallback = "\"ellipse\"",
     .help = "ellipse: one law for both directions; box: two independent laws"},
    {"grain", OPTIONAL, POINT(Obstacle, obstacle.grain, 3), ANY, .fallback = "[0, 0, 0]",
     .help = "direction of the axial coefficient or of the set's first component, fixed in "
             "space, as far as it lies in the surface; [0, 0, 0]: that of the line"},
};
static const CpsiMapping FRICTION = {"friction", KEYS(FRICTION_KEYS)};

static const CpsiKey OBSTACLE_KEYS[] = {
    {"plane", ONE_OF, AROUND, .inside = &PLANE, .help = "a plane; lines stay on one side of it"},
    {"cylinder", ONE_OF, AROUND, .inside = &CYLINDER,
     .help = "a cylinder without ends (bollard, pipe, drum); lines stay outside, or inside"},
    {"sphere", ONE_OF, AROUND, .inside = &SPHERE, .help = "a solid ball; lines stay outside"},
    {"ground", ONE_OF, AROUND, .inside = &GROUND,
     .help = "a smooth surface through the points of a grid; lines stay above it"},
    {"capsule", ONE_OF, AROUND, .inside = &CAPSULE,
     .help = "a cylinder with round ends (bollard, tank)"},
    {"torus", ONE_OF, AROUND, .inside = &TORUS, .help = "a ring (shackle, bent tube)"},
    {"cone", ONE_OF, AROUND, .inside = &CONE, .help = "a cone with a round tip (funnel)"},
    {"box", ONE_OF, AROUND, .inside = &BOX, .help = "a box with round edges (quay, slab)"},
    {"mesh", ONE_OF, AROUND, .inside = &MESH,
     .help = "triangles, inflated by a radius; lines stay outside"},
    {"friction", OPTIONAL, NUMBER(Obstacle, obstacle.friction), NOT_NEGATIVE,
     .other = &(const CpsiKey){.type = CPSI_MAPPING, .inside = &FRICTION}, .fallback = "0",
     .help = "Coulomb friction coefficient; or one along the line or the grain and another "
             "across it, or a set of forces"},
    {"stiffness", OPTIONAL, NUMBER(Obstacle, obstacle.stiffness), NOT_NEGATIVE, .unit = "N/m3",
     .fallback = "0",
     .help = "pressure over depth of an obstacle that gives; 0: rigid; lines need bearing_width"},
    {"damping", OPTIONAL, NUMBER(Obstacle, obstacle.damping), NOT_NEGATIVE, .unit = "N s/m3",
     .fallback = "0",
     .help = "pressure over velocity of an obstacle that gives, in steps with a duration"},
};

static void begin_obstacle(void *values) {
    CpsObstacle *obstacle = &((CpsiObstacleValues *)values)->obstacle;
    *obstacle = cps_obstacle_default();
    obstacle->friction_lateral = NAN; /* not given */
    ((CpsiObstacleValues *)values)->variable = "z";
    ((CpsiObstacleValues *)values)->scale = 1;
}

static const CpsiMapping OBSTACLE = {"obstacle", KEYS(OBSTACLE_KEYS), INTO(Obstacle),
                                     .begin = begin_obstacle, WHICH(Obstacle, obstacle.kind)};

/* ---- bodies ---- */

static const CpsiKey DIAGONAL_KEYS[] = {
    {"x", OPTIONAL, NUMBER(Diagonal, k[0]), ANY, .unit = "N/m", .fallback = "0",
     .help = "against a displacement along x"},
    {"y", OPTIONAL, NUMBER(Diagonal, k[1]), ANY, .unit = "N/m", .fallback = "0",
     .help = "against a displacement along y"},
    {"z", OPTIONAL, NUMBER(Diagonal, k[2]), ANY, .unit = "N/m", .fallback = "0",
     .help = "against a displacement along z: of a waterplane, density times gravity times area"},
    {"rx", OPTIONAL, NUMBER(Diagonal, k[3]), ANY, .unit = "N m", .fallback = "0",
     .help = "per radian about x"},
    {"ry", OPTIONAL, NUMBER(Diagonal, k[4]), ANY, .unit = "N m", .fallback = "0",
     .help = "per radian about y"},
    {"rz", OPTIONAL, NUMBER(Diagonal, k[5]), ANY, .unit = "N m", .fallback = "0",
     .help = "per radian about z"},
};
static const CpsiMapping DIAGONAL = {"hydrostatics", KEYS(DIAGONAL_KEYS), INTO(Diagonal)};

/* the diagonal of a matrix of a body for motion, without coupling */
#define DIAGONAL_OF(name, KEYS_NAME, unit_x, unit_r, what)                                      \
    static const CpsiKey KEYS_NAME[] = {                                                        \
        {"x", OPTIONAL, NUMBER(Diagonal, k[0]), NOT_NEGATIVE, .unit = unit_x, .fallback = "0",  \
         .help = what "along its x axis"},                                                      \
        {"y", OPTIONAL, NUMBER(Diagonal, k[1]), NOT_NEGATIVE, .unit = unit_x, .fallback = "0",  \
         .help = what "along its y axis"},                                                      \
        {"z", OPTIONAL, NUMBER(Diagonal, k[2]), NOT_NEGATIVE, .unit = unit_x, .fallback = "0",  \
         .help = what "along its z axis"},                                                      \
        {"rx", OPTIONAL, NUMBER(Diagonal, k[3]), NOT_NEGATIVE, .unit = unit_r, .fallback = "0", \
         .help = what "about its x axis"},                                                      \
        {"ry", OPTIONAL, NUMBER(Diagonal, k[4]), NOT_NEGATIVE, .unit = unit_r, .fallback = "0", \
         .help = what "about its y axis"},                                                      \
        {"rz", OPTIONAL, NUMBER(Diagonal, k[5]), NOT_NEGATIVE, .unit = unit_r, .fallback = "0", \
         .help = what "about its z axis"},                                                      \
    };                                                                                          \
    static const CpsiMapping name = {#name, KEYS(KEYS_NAME), INTO(Diagonal)}

DIAGONAL_OF(added_mass, ADDED_KEYS, "kg", "kg m2", "for an acceleration ");
DIAGONAL_OF(damping, DAMPING_KEYS, "N s/m", "N m s", "against a velocity ");
DIAGONAL_OF(quadratic_damping, QUADRATIC_KEYS, "N s2/m2", "N m s2", "against a velocity squared ");

/* directions of a body, in the order of CpsBody */
#define DIRECTIONS "x y z rx ry rz"

static const CpsiKey EXCITATION_KEYS[] = {
    {"period", REQUIRED, NUMBER(Excitation, period), POSITIVE, .unless = "frequency", .unit = "s",
     .help = "of the wave"},
    {"frequency", OPTIONAL, NUMBER(Excitation, frequency), POSITIVE, .unless = "period",
     .unit = "Hz", .help = "1 over the period, in its place"},
    {"direction", REQUIRED, NUMBER(Excitation, direction), ANY, .unit = "degree",
     .help = "of the wave, from the x axis towards the y axis"},
    {"amplitude", REQUIRED, POINT(Excitation, amplitude, 6), NOT_NEGATIVE,
     .help =
         "[N/m, N] of force and moment about the reference point, along and about x, y and z of "
         "the scene, per metre of the wave's amplitude"},
    {"phase", OPTIONAL, POINT(Excitation, phase, 6), ANY, .unit = "degree",
     .fallback = "[0, 0, 0, 0, 0, 0]",
     .help = "by which each is largest before the crest is where the reference point begins"},
};

static void begin_excitation(void *values) {
    CpsiExcitationValues *row = values;
    row->period = row->frequency = NAN;
}
static const CpsiMapping EXCITATION = {"row of the excitation", KEYS(EXCITATION_KEYS),
                                       INTO(Excitation), .begin = begin_excitation};

static const CpsiKey SCENE_BODY_KEYS[] = {
    {"held", ONE_OF, POINT(SceneBody, body.position, 3), ANY, .unit = "m",
     .help = "held with its reference point, the origin of its own axes, at this position"},
    {"free", ONE_OF, POINT(SceneBody, body.position, 3), ANY, .unit = "m",
     .help = "free: each step finds the pose in which the forces and moments on it balance; its "
             "reference point begins here, and hydrostatics count from here"},
    {"rotation", OPTIONAL, MAPPING(SceneBody, rotation), .inside = &cpsi_rotation_keys,
     .fallback = "{\"quaternion\": [1, 0, 0, 0]}",
     .help = "turns its own axes, which begin as those of the scene"},
    {"fixed", OPTIONAL, WORDS(SceneBody, body.fixed, 6), .words = DIRECTIONS, .fallback = "[]",
     .help = "directions in which it does not move while it is free: x, y, z, and about them"},
    {"mass", OPTIONAL, NUMBER(SceneBody, mass), NOT_NEGATIVE, .unit = "kg", .unless = "weight",
     .help = "its weight is mass times gravity; buoyancy is given apart"},
    {"weight", OPTIONAL, NUMBER(SceneBody, body.weight), NOT_NEGATIVE, .unit = "N", .fallback = "0",
     .help = "weight in air, instead of mass"},
    {"centre_of_gravity", OPTIONAL, POINT(SceneBody, body.centre_of_gravity, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "in its own axes"},
    {"volume", OPTIONAL, NUMBER(SceneBody, volume), NOT_NEGATIVE, .unit = "m3",
     .unless = "buoyancy",
     .help = "of the displaced water: buoyancy is water_density times gravity times volume"},
    {"buoyancy", OPTIONAL, NUMBER(SceneBody, body.buoyancy), NOT_NEGATIVE, .unit = "N",
     .fallback = "0", .help = "against gravity, instead of volume"},
    {"centre_of_buoyancy", OPTIONAL, POINT(SceneBody, body.centre_of_buoyancy, 3), ANY, .unit = "m",
     .fallback = "[0, 0, 0]", .help = "in its own axes"},
    {"hydrostatics", OPTIONAL, ROWS(SceneBody, hydrostatics, 6), 6, 6, false,
     .other = &(const CpsiKey){.type = MAPPING(SceneBody, diagonal), .inside = &DIAGONAL},
     .fallback = "{}",
     .help = "[N/m, N, N m] linear stiffness about the reference point, in the directions x, y, "
             "z, rx, ry, rz, from the pose in which the scene begins: 6 symmetric rows, or its "
             "diagonal by direction. Beside weight and buoyancy as given"},
    {"force", OPTIONAL, POINT(SceneBody, body.force, 3), ANY, .unit = "N", .with = "free",
     .fallback = "[0, 0, 0]", .help = "force on it, besides its weight, water and lines"},
    {"moment", OPTIONAL, POINT(SceneBody, body.moment, 3), ANY, .unit = "N m", .with = "free",
     .fallback = "[0, 0, 0]", .help = "moment about its reference point, likewise"},
    {"arm", OPTIONAL, POINT(SceneBody, arm, 3), ANY, .unit = "m", .with = "force",
     .fallback = "[0, 0, 0]",
     .help = "from its reference point to where the force acts, in the scene's axes, whatever its "
             "rotation: the moment gains arm x force"},
    {"moments_of_inertia", OPTIONAL, POINT(SceneBody, moments, 3), NOT_NEGATIVE, .unit = "kg m2",
     .fallback = "[0, 0, 0]",
     .help = "of its mass about axes through its centre of gravity along its own, for steps in "
             "time: entries xx, yy, zz of the inertia matrix"},
    {"products_of_inertia", OPTIONAL, POINT(SceneBody, products, 3), ANY, .unit = "kg m2",
     .with = "moments_of_inertia", .fallback = "[0, 0, 0]",
     .help = "entries xy, xz, yz of the same matrix: of masses m at (x, y, z) the sums of -m x y, "
             "-m x z and -m y z"},
    {"added_mass", OPTIONAL, ROWS(SceneBody, added_mass, 6), 6, 6, false,
     .other = &(const CpsiKey){.type = MAPPING(SceneBody, added_diagonal), .inside = &added_mass},
     .fallback = "{}",
     .help = "[kg, kg m, kg m2] of the water that moves with it, about the reference point in its "
             "own axes: 6 symmetric rows, or the diagonal by direction"},
    {"damping", OPTIONAL, ROWS(SceneBody, damping, 6), 6, 6, false,
     .other = &(const CpsiKey){.type = MAPPING(SceneBody, damping_diagonal), .inside = &damping},
     .fallback = "{}",
     .help = "[N s/m, N s, N m s] force and moment per velocity of the reference point and rate of "
             "rotation in its own axes, against them: 6 rows, or the diagonal by direction"},
    {"quadratic_damping", OPTIONAL, ROWS(SceneBody, quadratic, 6), 6, 6, false,
     .other = &(const CpsiKey){.type = MAPPING(SceneBody, quadratic_diagonal),
                               .inside = &quadratic_damping},
     .fallback = "{}", .help = "[N s2/m2, N s2, N s2/m, N m s2] the same per square of velocities"},
    {"excitation", OPTIONAL, LIST(SceneBody, excitation, 1), .inside = &EXCITATION,
     .help = "force and moment of the scene's waves on it, by rows for periods and directions; "
             "linear in the frequency between them"},
    {"radiation", OPTIONAL, TEXT(SceneBody, radiation, 255), ANY,
     .help = "CSV file of times and the kernel of radiation, k11 .. k66, beside this file"},
    {"members", OPTIONAL, LIST(SceneBody, members, 1), .inside = &cpsi_member_keys,
     .help = "cylinders on which the water acts by Morison's formula up to the surface"},
    {"velocity", OPTIONAL, POINT(SceneBody, velocity, 3), ANY, .unit = "m/s", .with = "free",
     .fallback = "[0, 0, 0]", .help = "of its reference point as the history begins"},
    {"turn_rate", OPTIONAL, POINT(SceneBody, turn_rate, 3), ANY, .unit = "rad/s", .with = "free",
     .fallback = "[0, 0, 0]", .help = "its rate of rotation then, in the axes of the scene"},
};

static void begin_scene_body(void *values) {
    CpsiSceneBodyValues *body = values;
    body->body = cps_body_default();
    body->mass = body->volume = NAN;
}

static const CpsiMapping SCENE_BODY = {"body", KEYS(SCENE_BODY_KEYS), INTO(SceneBody),
                                       .begin = begin_scene_body, WHICH(SceneBody, body.kind)};

/* ---- sets of places ---- */

static const CpsiKey RAIL_KEYS[] = {
    {"from", REQUIRED, POINT(On, on.point, 3), ANY, .unit = "m", .help = "one end of the rail"},
    {"to", ONE_OF, POINT(On, to, 3), ANY, .unit = "m", .help = "its other end"},
    {"along", ONE_OF, POINT(On, on.axis, 3), ANY,
     .help = "in place of `to`: without ends, through `from` in this direction, not zero"},
};
static const CpsiMapping RAIL = {"rail", KEYS(RAIL_KEYS), WHICH(On, rail)};

static const CpsiKey HALF_SPACE_KEYS[] = {
    {"point", OPTIONAL, POINT(On, on.point, 3), ANY, .unit = "m", .fallback = "[0, 0, 0]",
     .help = "a point of its plane"},
    {"normal", REQUIRED, POINT(On, on.axis, 3), ANY,
     .help = "points to the side where the end may be; of any length but zero"},
};
static const CpsiMapping HALF_SPACE = {"half_space", KEYS(HALF_SPACE_KEYS)};

#define ON_CENTRE \
    { "centre", REQUIRED, POINT(On, on.point, 3), ANY, .unit = "m", .help = "the middle of it" }
#define ON_RADIUS                                                        \
    {                                                                    \
        "radius", REQUIRED, NUMBER(On, on.radius), POSITIVE,             \
            .unit = "m", .help = "the end is no farther from the middle" \
    }

static const CpsiKey BALL_KEYS[] = {ON_CENTRE, ON_RADIUS};
static const CpsiMapping BALL = {"ball", KEYS(BALL_KEYS)};

static const CpsiKey DISC_KEYS[] = {
    ON_CENTRE,
    ON_RADIUS,
    {"normal", OPTIONAL, POINT(On, on.axis, 3), ANY, .fallback = "[0, 0, 1]",
     .help = "across the disc, of any length but zero"},
};
static const CpsiMapping DISC = {"disc", KEYS(DISC_KEYS)};

static const CpsiKey ON_BOX_KEYS[] = {
    ON_CENTRE,
    {"size", REQUIRED, POINT(On, on.size, 3), 0, CPSI_LARGEST, true, .unit = "m",
     .help = "from face to face along its own axes"},
    {"rotation", OPTIONAL, MAPPING(On, rotation), .inside = &cpsi_rotation_keys,
     .fallback = "{\"quaternion\": [1, 0, 0, 0]}",
     .help = "turns its own axes, which begin as those of the scene"},
};
static const CpsiMapping ON_BOX = {"box", "set_box", KEYS(ON_BOX_KEYS)};

/* What the places of an end or a point may be in. */
#define ON_SETS                                                                               \
    {"rail", ONE_OF, AROUND, .inside = &RAIL, .help = "a straight rail"},                     \
        {"half_space", ONE_OF, AROUND, .inside = &HALF_SPACE, .help = "one side of a plane"}, \
        {"ball", ONE_OF, AROUND, .inside = &BALL, .help = "within a ball"},                   \
        {"disc", ONE_OF, AROUND, .inside = &DISC, .help = "within a flat disc"},              \
        {"box", ONE_OF, AROUND, .inside = &ON_BOX, .help = "within a box"}, {                 \
        "set", ONE_OF, EXPRESSION(On, set),                                                   \
            .inside = &cpsi_set_words,                                                        \
            .help = "within any bounded set of space, in metres, in the words of law files"   \
    }

static const CpsiKey ON_KEYS[] = {
    ON_SETS,
    {"force", OPTIONAL, POINT(On, force, 3), ANY, .unit = "N", .fallback = "[0, 0, 0]",
     .help = "on the end, beside the reaction of the set"},
};
static const CpsiKey POINT_ON_KEYS[] = {ON_SETS};

static void begin_on(void *values) { ((CpsiOnValues *)values)->on.axis[2] = 1; }

static const CpsiMapping ON = {"on", KEYS(ON_KEYS), INTO(On), WHICH(On, kind), .begin = begin_on};
static const CpsiMapping POINT_ON = {"on",     "point_on",      KEYS(POINT_ON_KEYS),
                                     INTO(On), WHICH(On, kind), .begin = begin_on};

/* ---- points ---- */

static const CpsiKey SCENE_POINT_KEYS[] = {
    {"held", ONE_OF, POINT(ScenePoint, point.position, 3), ANY, .unit = "m",
     .help = "held at this position"},
    {"free", ONE_OF, POINT(ScenePoint, point.position, 3), ANY, .unit = "m",
     .help = "free: each step finds where the forces on it balance; it begins at this position, "
             "which is a first guess where all lines that end there start static"},
    {"body", ONE_OF, TEXT(ScenePoint, body, 0),
     .help = "name of one of the scene's bodies, which it is on and moves with"},
    {"at", OPTIONAL, POINT(ScenePoint, at, 3), ANY, .unit = "m", .with = "body",
     .fallback = "[0, 0, 0]", .help = "where on the body it is, in the body's own axes"},
    {"force", OPTIONAL, POINT(ScenePoint, point.force, 3), ANY, .unit = "N", .with = "free",
     .fallback = "[0, 0, 0]", .help = "force on it, besides its weight and its lines"},
    {"on", OPTIONAL, MAPPING(ScenePoint, on), .inside = &POINT_ON, .with = "free",
     .help = "it is on a rail, or anywhere within another convex set, without friction"},
    {"mass", OPTIONAL, NUMBER(ScenePoint, mass), NOT_NEGATIVE, .unit = "kg", .unless = "weight",
     .help = "mass; its weight is mass times gravity, less that of the water it displaces"},
    {"weight", OPTIONAL, NUMBER(ScenePoint, point.weight), ANY, .unit = "N", .fallback = "0",
     .help = "weight (in water: the submerged one), instead of mass; negative: a buoy"},
    {"volume", OPTIONAL, NUMBER(ScenePoint, volume), NOT_NEGATIVE, .unit = "m3", .with = "mass",
     .fallback = "0", .help = "of the water it displaces"},
    {"height", OPTIONAL, NUMBER(ScenePoint, point.height), NOT_NEGATIVE, .unit = "m",
     .with = "volume", .fallback = "0",
     .help = "of what floats, with the point in its middle: its buoyancy grows evenly over it"},
    {"holding_capacity", OPTIONAL, NUMBER(ScenePoint, point.holding_capacity), POSITIVE,
     .unit = "N", .with = "held",
     .help = "of an anchor: the force along the ground that it can bear; what exceeds it is said"},
    {"uplift_limit", OPTIONAL, NUMBER(ScenePoint, point.uplift_limit), POSITIVE, .unit = "N",
     .with = "held", .help = "of an anchor: the force up from the ground that it can bear"},
    {"drags", OPTIONAL, FLAG(ScenePoint, point.drags), .with = "holding_capacity",
     .help = "the anchor gives way along the ground to a force above its capacity"},
    {"bearing_area", OPTIONAL, NUMBER(ScenePoint, point.bearing_area), POSITIVE, .unit = "m2",
     .help = "with which it bears on obstacles that give, beside its lines"},
    {"inertia", OPTIONAL, NUMBER(ScenePoint, inertia), NOT_NEGATIVE, .unit = "kg",
     .help = "mass that moves in time, with water that goes along; default: mass, of a weight 0"},
    {"velocity", OPTIONAL, POINT(ScenePoint, point.velocity, 3), ANY, .unit = "m/s", .with = "free",
     .fallback = "[0, 0, 0]", .help = "of a free point as the history begins"},
};

static void begin_scene_point(void *values) {
    CpsiScenePointValues *point = values;
    point->point = cps_point_default();
    point->mass = point->inertia = point->point.holding_capacity = point->point.uplift_limit = NAN;
}

static const CpsiMapping SCENE_POINT = {"point", KEYS(SCENE_POINT_KEYS), INTO(ScenePoint),
                                        .begin = begin_scene_point, WHICH(ScenePoint, point.kind)};

/* ---- lines ---- */

static const CpsiKey STRAIGHT_KEYS[] = {
    {"from", REQUIRED, POINT(Straight, from, 3), ANY, .unit = "m", .help = "where end A starts"},
    {"to", REQUIRED, POINT(Straight, to, 3), ANY, .unit = "m", .help = "where end B starts"},
};
static const CpsiMapping STRAIGHT = {"straight", KEYS(STRAIGHT_KEYS), INTO(Straight)};

static const CpsiKey ARC_KEYS[] = {
    {"from", REQUIRED, POINT(Arc, from, 3), ANY, .unit = "m", .help = "where end A starts"},
    {"centre", REQUIRED, POINT(Arc, centre, 3), ANY, .unit = "m", .formerly = "center",
     .help = "a point on the circle's axis"},
    {"axis", OPTIONAL, POINT(Arc, axis, 3), ANY, .fallback = "[0, 0, 1]",
     .help = "direction of the axis; the line turns about it by the right-hand rule"},
};

static void begin_arc(void *values) { ((CpsiArcValues *)values)->axis[2] = 1; }

static const CpsiMapping ARC = {"arc", KEYS(ARC_KEYS), INTO(Arc), .begin = begin_arc};

static const CpsiKey START_KEYS[] = {
    {"straight", ONE_OF, MAPPING(Start, straight), .inside = &STRAIGHT, .help = "a straight line"},
    {"polyline", ONE_OF, ROWS(Start, polyline, 3), 2, INFINITY, false, .unit = "m",
     .help = "straight pieces between these points"},
    {"arc", ONE_OF, MAPPING(Start, arc), .inside = &ARC,
     .help = "as much of a circle as the line is long, at most one turn; free of stress"},
    {"nodes", ONE_OF, TEXT(Start, nodes, 0),
     .help = "any configuration: a CSV file beside this one with the nodes' places and, where "
             "they are known, natural lengths and forces"},
};
static const CpsiMapping START = {"start", KEYS(START_KEYS), INTO(Start)};

static const CpsiKey END_KEYS[] = {
    {"held", ONE_OF, POINT(End, value, 3), ANY, .unit = "m", .formerly = "fixed",
     .help = "held at this position, which must be that of the start shape"},
    {"force", ONE_OF, POINT(End, value, 3), ANY, .unit = "N", .help = "free, pulled by this force"},
    {"point", ONE_OF, TEXT(End, point, 0),
     .help = "name of one of the scene's points, at which the line ends with others"},
    {"on", ONE_OF, MAPPING(End, on), .inside = &ON,
     .help = "it slides without friction on a rail, or anywhere within another convex set"},
    {"stored", OPTIONAL, NUMBER(End, stored), NOT_NEGATIVE, .unit = "m",
     .help = "a winch is at this end, and has so much of the line's length on its drum"},
};

static void begin_end(void *values) { ((CpsiEndValues *)values)->stored = NAN; }
static const CpsiMapping END = {"end", KEYS(END_KEYS), INTO(End), WHICH(End, word),
                                .begin = begin_end};

static const CpsiKey ENDS_KEYS[] = {
    {"A", REQUIRED, WORD(Line, end[0].word), .words = "held free", .former_words = "fixed free",
     .other = &(const CpsiKey){.type = MAPPING(Line, end[0]), .inside = &END},
     .help = "the first end; held: where the start puts it; free: without force"},
    {"B", REQUIRED, WORD(Line, end[1].word), .words = "held free", .former_words = "fixed free",
     .other = &(const CpsiKey){.type = MAPPING(Line, end[1]), .inside = &END},
     .help = "the last end, likewise"},
};
static const CpsiMapping ENDS = {"ends", KEYS(ENDS_KEYS)};

static const CpsiKey ZONE_KEYS[] = {
    {"from", REQUIRED, NUMBER(Zone, zone.from), NOT_NEGATIVE, .unit = "m",
     .help = "unstretched length from end A at which the stretch begins"},
    {"to", REQUIRED, NUMBER(Zone, zone.to), POSITIVE, .unit = "m", .help = "where it ends"},
    {"factor", REQUIRED, NUMBER(Zone, zone.factor), NOT_NEGATIVE,
     .help = "of the friction of whatever it touches; 1 elsewhere"},
};
static const CpsiMapping ZONE = {"zone", KEYS(ZONE_KEYS), INTO(Zone)};

static const CpsiKey GRADE_KEYS[] = {
    {"towards", REQUIRED, WORD(Grade, towards), .words = "A B both",
     .help = "end at which the elements are shortest; both: at the ends, longest in the middle"},
    {"ratio", REQUIRED, NUMBER(Grade, ratio), 1, 1e6, false,
     .help = "longest element over the shortest; between them they grow by equal factors"},
};
static const CpsiMapping GRADE = {"grade", KEYS(GRADE_KEYS), INTO(Grade)};

static const CpsiKey SECTION_KEYS[] = {
    {"type", REQUIRED, TEXT(Section, type, 0), .help = "name of one of the scene's types"},
    {"length", REQUIRED, NUMBER(Section, length), POSITIVE, .unit = "m",
     .help = "unstretched length of the section"},
    {"elements", ONE_OF, COUNT(Section, count), 1, CPSI_LARGEST, false,
     .help = "number of elements, equal ones without a grade"},
    {"element_length", ONE_OF, NUMBER(Section, element_length), POSITIVE, .unit = "m",
     .help = "length that its elements shall not exceed"},
    {"grade", OPTIONAL, MAPPING(Section, grade), .inside = &GRADE,
     .help = "elements that become shorter towards an end of the section"},
};

static void begin_section(void *values) {
    CpsiSectionValues *section = values;
    section->count = section->element_length = NAN;
}

static const CpsiMapping SECTION = {"section", KEYS(SECTION_KEYS), INTO(Section),
                                    .begin = begin_section};

static const CpsiKey POINT_WEIGHT_KEYS[] = {
    {"at", REQUIRED, NUMBER(PointWeight, at), POSITIVE, .unit = "m",
     .help = "unstretched length from end A, where an element ends"},
    {"mass", ONE_OF, NUMBER(PointWeight, mass), NOT_NEGATIVE, .unit = "kg",
     .help = "mass; its weight is mass times gravity, less that of the water it displaces"},
    {"weight", ONE_OF, NUMBER(PointWeight, weight), ANY, .unit = "N",
     .help = "weight (in water: the submerged one), instead of mass; negative: a buoy"},
    {"inertia", OPTIONAL, NUMBER(PointWeight, inertia), NOT_NEGATIVE, .unit = "kg",
     .help = "mass that moves with the node in time; by default its mass, 0 of a weight"},
    {"volume", OPTIONAL, NUMBER(PointWeight, volume), NOT_NEGATIVE, .unit = "m3", .with = "mass",
     .fallback = "0", .help = "of the water it displaces"},
    {"floats", OPTIONAL, FLAG(PointWeight, floats), .with = "volume",
     .help = "a buoy that floats at the scene's water_surface where it reaches it: the line is "
             "taken as lines that meet there at a free point"},
};

static void begin_point_weight(void *values) {
    CpsiPointWeightValues *point = values;
    point->mass = point->inertia = NAN;
}

static const CpsiMapping POINT_WEIGHT = {"point weight", KEYS(POINT_WEIGHT_KEYS), INTO(PointWeight),
                                         .definition = "point_weight", .begin = begin_point_weight};

static const CpsiKey STIFFNESS_KEYS[] = {
    {"strain", REQUIRED, VECTOR(Stiffness, strain, CPS_MAX_STIFFNESS_ROWS), NOT_NEGATIVE,
     .unit = "1", .help = "elongation over unstretched length, from 0 on"},
    {"tension", REQUIRED, VECTOR(Stiffness, tension, CPS_MAX_STIFFNESS_ROWS), NOT_NEGATIVE,
     .unit = "N", .help = "tension at each strain, from 0 on; slopes do not fall"},
};
static const CpsiMapping STIFFNESS = {"stiffness", KEYS(STIFFNESS_KEYS), INTO(Stiffness)};

static const CpsiKey TYPE_KEYS[] = {
    {"mass", ONE_OF, NUMBER(Type, mass), NOT_NEGATIVE, .unit = "kg/m",
     .help = "mass per unstretched length; its weight is mass times gravity, less that of the "
             "water that its diameter displaces"},
    {"weight", ONE_OF, NUMBER(Type, weight), NOT_NEGATIVE, .unit = "N/m",
     .help = "weight per unstretched length (in water: the submerged one), instead of mass"},
    {"inertia", OPTIONAL, NUMBER(Type, inertia), NOT_NEGATIVE, .unit = "kg/m",
     .help = "mass per unstretched length that moves in time, with the water that goes along; by "
             "default its mass, 0 of a weight"},
    {"diameter", OPTIONAL, NUMBER(Type, diameter), NOT_NEGATIVE, .unit = "m", .with = "mass",
     .fallback = "0", .help = "of the circle whose area displaces water (volume-equivalent)"},
    {"stiffness", REQUIRED, NUMBER(Type, stiffness), 0, INFINITY, true, .unit = "N",
     .other = &(const CpsiKey){.type = MAPPING(Type, table), .inside = &STIFFNESS},
     .help = "axial stiffness EA; .inf for an inextensible type; or a table of strain and tension"},
    {"dynamic_stiffness", OPTIONAL, NUMBER(Type, dynamic.stiffness), POSITIVE,
     .other = &(const CpsiKey){.type = MAPPING(Type, dynamic.table), .inside = &STIFFNESS},
     .unit = "N",
     .help = "the axial stiffness, or its table, about the state that `stiffness` has reached; "
             "nowhere softer than it"},
    {"breaking_load", OPTIONAL, NUMBER(Type, breaking_load), POSITIVE, .unit = "N",
     .help = "tension at which it breaks: results then give the largest tension over it"},
    {"break_at", OPTIONAL, NUMBER(Type, break_at), POSITIVE, .unit = "N",
     .help = "tension above which a line of it parts: it is let go at the nearest end"},
    {"friction", OPTIONAL, NUMBER(Type, friction), NOT_NEGATIVE, .fallback = "1",
     .help = "factor of the friction of whatever it touches"},
};

static void begin_type(void *values) {
    CpsiTypeValues *type = values;
    type->mass = type->inertia = type->breaking_load = type->break_at = type->dynamic.stiffness =
        NAN;
    type->friction = 1;
}

static const CpsiMapping TYPE = {"type", KEYS(TYPE_KEYS), INTO(Type), .begin = begin_type};

static const CpsiKey PRETENSION_KEYS[] = {
    {"end", REQUIRED, WORD(Pretension, end), .words = "A B", .help = "end with the tension"},
    {"tension", ONE_OF, NUMBER(Pretension, tension), POSITIVE, .unit = "N",
     .help = "size of the force at the end; or"},
    {"horizontal", ONE_OF, NUMBER(Pretension, horizontal), POSITIVE, .unit = "N",
     .help = "size of its part across gravity"},
    {"section", OPTIONAL, COUNT(Pretension, section), 1, CPSI_LARGEST, false,
     .help = "number of the section, from A, whose length is found"},
};

static void begin_pretension(void *values) {
    CpsiPretensionValues *pretension = values;
    pretension->tension = pretension->horizontal = pretension->section = NAN;
}

static const CpsiMapping PRETENSION = {"pretension", KEYS(PRETENSION_KEYS), INTO(Pretension),
                                       .begin = begin_pretension};

static const CpsiKey LINE_KEYS[] = {
    {"length", REQUIRED, NUMBER(Line, line.length), POSITIVE, .unless = "sections", .unit = "m",
     .help = "unstretched length"},
    {"elements", OPTIONAL, COUNT(Line, count), 1, CPSI_LARGEST, false, .unless = "sections",
     .other = &(const CpsiKey){.type = ELEMENTS(Line, elements), POSITIVE}, .fallback = "100",
     .help = "number of elements; or from A to B a list of element lengths [m] and of "
             "pairs [count, length]: count equal elements that are length [m] long together"},
    {"element_length", OPTIONAL, NUMBER(Line, element_length), POSITIVE, .unless = "sections",
     .unit = "m", .help = "length that its elements shall not exceed, instead of their number"},
    {"grade", OPTIONAL, MAPPING(Line, grade), .inside = &GRADE, .unless = "sections",
     .help = "elements that become shorter towards an end"},
    {"mass", ONE_OF, NUMBER(Line, mass), NOT_NEGATIVE, .unit = "kg/m",
     .help = "mass per unstretched length; the weight is mass times gravity, less that of the "
             "water that the diameter displaces"},
    {"weight", ONE_OF, NUMBER(Line, line.weight), NOT_NEGATIVE, .unit = "N/m",
     .help = "weight per unstretched length (in water: the submerged one), instead of mass"},
    {"damping", OPTIONAL, NUMBER(Line, line.damping), NOT_NEGATIVE, .unit = "N s", .fallback = "0",
     .help = "in time: tension per rate of strain, BA"},
    {"inertia", OPTIONAL, NUMBER(Line, inertia), NOT_NEGATIVE, .unless = "sections", .unit = "kg/m",
     .help = "mass per unstretched length that moves in time, with the water that goes along; by "
             "default its mass, 0 of a weight"},
    {"velocity", OPTIONAL, POINT(Line, line.velocity, 3), ANY, .unit = "m/s",
     .fallback = "[0, 0, 0]", .help = "of its free nodes as the history begins"},
    {"quasi_static", OPTIONAL, FLAG(Line, line.quasi_static), .fallback = "false",
     .help = "in time it follows what moves it, without inertia"},
    {"sections", ONE_OF, LIST(Line, sections, 1), .inside = &SECTION,
     .help = "stretches of different types, in order from A to B"},
    {"diameter", OPTIONAL, NUMBER(Line, diameter), NOT_NEGATIVE, .unit = "m", .with = "mass",
     .fallback = "0", .help = "of the circle whose area displaces water (volume-equivalent)"},
    {"bearing_width", OPTIONAL, NUMBER(Line, line.bearing_width), NOT_NEGATIVE, .unit = "m",
     .fallback = "0", .help = "width with which it bears on obstacles that give (stiffness)"},
    {"stiffness", REQUIRED, NUMBER(Line, line.stiffness), 0, INFINITY, true, .unless = "sections",
     .other = &(const CpsiKey){.type = MAPPING(Line, table), .inside = &STIFFNESS}, .unit = "N",
     .help = "axial stiffness EA; .inf for an inextensible line; or a table of strain and tension"},
    {"dynamic_stiffness", OPTIONAL, NUMBER(Line, dynamic.stiffness), POSITIVE, .unless = "sections",
     .other = &(const CpsiKey){.type = MAPPING(Line, dynamic.table), .inside = &STIFFNESS},
     .unit = "N",
     .help = "the axial stiffness, or its table, about the state that `stiffness` has reached; "
             "nowhere softer than it"},
    {"breaking_load", OPTIONAL, NUMBER(Line, breaking_load), POSITIVE, .unless = "sections",
     .unit = "N",
     .help = "tension at which it breaks: results then give the largest tension over it"},
    {"break_at", OPTIONAL, NUMBER(Line, break_at), POSITIVE, .unless = "sections", .unit = "N",
     .help = "tension above which it parts: it is let go at the nearest end"},
    {"point_weights", OPTIONAL, LIST(Line, point_weights, 0), .inside = &POINT_WEIGHT,
     .fallback = "[]", .help = "clumps and buoys between the ends, in order from A to B"},
    {"friction_zones", OPTIONAL, LIST(Line, zones, 0), .inside = &ZONE, .fallback = "[]",
     .help = "intervals of arc length with another friction, from A to B, without overlap"},
    {"springs", OPTIONAL, LIST(Line, springs, 0), .inside = &cpsi_spring_keys,
     .unless = "pretension", .fallback = "[]",
     .help = "springs from pieces of the line to the ground; they add up"},
    {"loads", OPTIONAL, LIST(Line, loads, 0), .inside = &cpsi_force_keys, .unless = "pretension",
     .fallback = "[]",
     .help = "given forces on pieces of the line, besides its weight; they add up"},
    {"drag", OPTIONAL, MAPPING(Line, drag), .inside = &cpsi_drag_keys,
     .help = "coefficients of the drag in the scene's current, or in time in still water"},
    {"pretension", OPTIONAL, MAPPING(Line, pretension), .inside = &PRETENSION,
     .help = "the tension of the static start, for which the length is found; the one written "
             "then says how many elements there are"},
    {"start", REQUIRED, WORD(Line, start.word), .words = "static", .former_words = "laid",
     .other = &(const CpsiKey){.type = MAPPING(Line, start), .inside = &START},
     .help = "shape the line starts from, as long as the line (an elastic one may be "
             "stretched); static: the equilibrium without friction, found first"},
    {"ends", REQUIRED, AROUND, .inside = &ENDS, .help = "what holds or pulls the two ends"},
};

static void begin_line(void *values) {
    CpsiLineValues *line = values;
    line->line = cps_line_default();
    line->mass = line->count = line->breaking_load = line->break_at = line->element_length = NAN;
    line->inertia = line->dynamic.stiffness = NAN;
}

static const CpsiMapping LINE = {"line", KEYS(LINE_KEYS), INTO(Line), .begin = begin_line};

/* ---- the scene ---- */

static const CpsiKey SOLVER_KEYS[] = {
    {"tolerance", OPTIONAL, NUMBER(Scene, scene.solver.tolerance), 1e-14, 1e-2, false,
     .fallback = "1e-8",
     .help = "a step is certified when its duality gap is at most this times the scale of its "
             "energies; above 1e-8 it need not be resolved which nodes slip"},
    {"max_iterations", OPTIONAL, INTEGER(Scene, scene.solver.max_iterations), 1, 1000, false,
     .fallback = "60",
     .help = "of one solve of a line; 20 more for each doubling of its elements beyond 12 800"},
    {"path_tolerance", OPTIONAL, NUMBER(Scene, scene.solver.path_tolerance), 0, 1, false,
     .fallback = "0",
     .help = "a step is cut until two halves change displacements per length and tensions per "
             "largest force by no more; 0: steps as given"},
    {"halvings", OPTIONAL, INTEGER(Scene, scene.solver.max_halvings), 0, 30, false,
     .fallback = "10",
     .help = "how often a step may be halved, for the path or because it does not converge"},
    {"linear_system", OPTIONAL, WORD(Scene, scene.solver.linear_system), .words = "chain dense",
     .fallback = "\"chain\"", .help = "dense: for comparison on small lines"},
};
static const CpsiMapping SOLVER = {"solver", KEYS(SOLVER_KEYS)};

static const CpsiKey SCENE_KEYS[] = {
    {"capstan", REQUIRED, INTEGER(Scene, version), 1, 1, false, .help = "version of the format"},
    {"title", OPTIONAL, TEXT(Scene, scene.title, 0),
     .help = "what the scene shows; printed with the results"},
    {"gravity", OPTIONAL, POINT(Scene, scene.gravity, 3), ANY, .unit = "m/s2",
     .fallback = "[0, 0, -9.81]",
     .help = "acceleration of gravity; its direction is that of the lines' weight"},
    {"water_density", OPTIONAL, NUMBER(Scene, water), NOT_NEGATIVE, .unit = "kg/m3",
     .fallback = "0",
     .help = "of the water around everything that is given by its mass: 1025 in the sea, 0 in air"},
    {"water_surface", OPTIONAL, NUMBER(Scene, scene.water_surface), ANY, .unit = "m",
     .with = "water_density",
     .help = "height z of the surface of the still water, at which free points with a volume "
             "float; without it all is under water"},
    {"current", OPTIONAL, LIST(Scene, current, 1), .inside = &cpsi_current_keys,
     .with = "water_density",
     .help = "velocity of the water over the height, from the lowest row to the highest; linear "
             "between, constant beyond"},
    {"waves", OPTIONAL, MAPPING(Scene, waves), .inside = &cpsi_waves_keys, .with = "water_surface",
     .help =
         "waves of small height, which move the water about lines with drag and bodies in time"},
    {"types", OPTIONAL, NAMED(Scene, types), .inside = &TYPE, .fallback = "{}",
     .help = "what sections of lines are made of, by name"},
    {"obstacles", OPTIONAL, NAMED(Scene, obstacles), .inside = &OBSTACLE, .fallback = "{}",
     .help = "what the lines lie on, by name; each node rests on the nearest one, or on the two "
             "nearest"},
    {"bodies", OPTIONAL, NAMED(Scene, bodies), .inside = &SCENE_BODY, .fallback = "{}",
     .help = "rigid bodies that lines hold, by name: a spar, a barge"},
    {"points", OPTIONAL, NAMED(Scene, points), .inside = &SCENE_POINT, .fallback = "{}",
     .help = "where ends of lines meet, by name: anchors, knots, clumps and buoys on joints"},
    {"lines", REQUIRED, NAMED(Scene, lines), .inside = &LINE,
     .help = "the lines by name; they do not touch one another"},
    {"friction_policy", OPTIONAL, WORD(Scene, scene.friction_policy), .words = "frozen consistent",
     .formerly = "friction", .fallback = "\"consistent\"",
     .help = "frozen: the friction bound of a step is taken from the configuration the step "
             "starts from; consistent: it is mu times the reaction in the configuration "
             "reached, for nodes that land in the step as well"},
    {"contact_policy", OPTIONAL, WORD(Scene, scene.contact_policy), .words = "reached reference",
     .formerly = "contact", .former_words = "gained strict", .fallback = "\"reached\"",
     .help = "reached: no node ends a step below the obstacle; reference: only nodes that touch "
             "it in the configuration the step starts from are kept out"},
    {"time_scheme", OPTIONAL, WORD(Scene, scene.time_scheme), .words = "bdf2 euler",
     .fallback = "\"bdf2\"",
     .help = "of steps in time: bdf2 is of second order; euler is of first order, and never gains "
             "energy"},
    {"solver", OPTIONAL, AROUND, .inside = &SOLVER, .fallback = "{}",
     .help = "how steps are solved"},
    {"history", OPTIONAL, LIST(Scene, history, 0), .inside = &cpsi_stage_keys, .fallback = "[]",
     .help = "what happens to the lines' ends, to points, to bodies and to obstacles that turn or "
             "move, in turn"},
};

static void begin_scene(void *values) {
    CpsScene *scene = &((CpsiSceneValues *)values)->scene;
    *scene = cps_scene_default();
    scene->water_surface = NAN; /* not given */
}

const CpsiMapping cpsi_scene_file = {"scene", KEYS(SCENE_KEYS), INTO(Scene), .begin = begin_scene};
