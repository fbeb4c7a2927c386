/* SPDX-License-Identifier: BSD-3-Clause */
/* Points and bodies that move in time, from a scene to the checker: the file is sound and the
 * scene's, and copies with a number changed are refused, by themselves or beside their scene. */
#include "check.h"
#include "falsified.h"

/* A float that rolls and heaves with added mass, coupled with its rotation, and damping, on a line
 * without inertia and one with; between them a clump swings, and another one falls on rough ground
 * and slides. */
static const char SCENE[] =
    "capstan: 1\ngravity: [0, 0, -9.81]\nwater_density: 1025\nobstacles:\n"
    "  bed: {plane: {point: [0, 0, -20]}, friction: 0.3}\n"
    "bodies:\n"
    "  float: {free: [0, 0, 0], rotation: {roll_pitch_yaw: [5, 12, 20]}, mass: 400,"
    " moments_of_inertia: [90, 120, 150], products_of_inertia: [4, -3, 5],"
    " centre_of_gravity: [0.2, 0.1, -0.8], buoyancy: 6000, centre_of_buoyancy: [0, 0, 0.3],"
    " hydrostatics: [[10, 0, 0, 0, 5, 0], [0, 12, 0, 0, 0, 0], [0, 0, 3000, 0, 0, 0],"
    " [0, 0, 0, 900, 0, 0], [5, 0, 0, 0, 910, 0], [0, 0, 0, 0, 0, 40]],"
    " added_mass: [[200, 0, 0, 0, -40, 0], [0, 220, 0, 30, 0, 0], [0, 0, 300, 0, 0, 0],"
    " [0, 30, 0, 50, 0, 0], [-40, 0, 0, 0, 60, 0], [0, 0, 0, 0, 0, 20]],"
    " damping: {x: 20, z: 90, rx: 30, rz: 15}, quadratic_damping: [[40, 0, 0, 0, -2, 0],"
    " [0, 0, 0, 0, 0, 0], [0, 0, 25, 0, 0, 0], [0, 0, 0, 0, 0, 0], [3, 0, 0, 0, 12, 0],"
    " [0, 0, 0, 0, 0, 0]],"
    " velocity: [0.4, -0.2, 0.3], turn_rate: [0.5, 0.2, -0.3], force: [50, 10, 0], arm: [0, 0, "
    "1]}\n"
    "points:\n"
    "  left: {body: float, at: [-1, 0.2, -1]}\n"
    "  right: {body: float, at: [1, 0, -1]}\n"
    "  knot: {free: [9, 0, -9], mass: 60, velocity: [0.2, 0.5, 0]}\n"
    "  clump: {free: [14, 3, -19.99], mass: 80, velocity: [0.6, 0.8, -0.4]}\n"
    "lines:\n"
    "  a: {length: 22.07, elements: 10, mass: 4, stiffness: 1e5, quasi_static: true, start: "
    "{straight: "
    "{from: [-12, 1, -20], to: [-1.208334883627139, -0.1350230755365901, -0.7494635268526606]}}, "
    "ends: {A: {held: [-12, 1, -20]}, B: {point: "
    "left}}}\n"
    "  b: {length: 11.39, elements: 6, mass: 3, stiffness: 1e5, start: {straight: {from: "
    "[0.6947194347465925, 0.3456063995896875, -1.182337144619938], "
    "to: [9, 0, -9]}}, ends: {A: {point: right}, B: {point: knot}}}\n"
    "  c: {length: 12.4, elements: 6, mass: 3, stiffness: 1e5, start: {straight: {from: [9, 0, "
    "-9], "
    "to: [14, 3, -19.99]}}, ends: {A: {point: knot}, B: {point: clump}}}\n"
    "history:\n"
    "  - {name: swing, duration: 0.2, steps: 8, float.body: {force: [90, 10, 0], arm: [0, 0, "
    "1]}}\n";
enum { STEPS = 8, LINES = 3, POINTS = 4, FLOAT = 0, KNOT = 2, CLUMP = 3 };

/* Component a of a vector of the float, or of a point, in a step. */
#define BODY(step, a)         (3 * (step) + (a))
#define POINT(step, point)    ((step)*POINTS + (point))
#define PLACE(step, point, a) (3 * POINT(step, point) + (a))

/* A finding NULL: only beside the scene. */
static const FalseNumber FALSE[] = {
    {"mass_of_body", FLOAT, 401, "float: force of inertia, off"},
    {"moments_of_inertia_of_body", 1, 121, "float: moment of inertia, off"},
    {"products_of_inertia_of_body", 2, 6, "float: moment of inertia, off"},
    {"added_mass_xx_of_body", 0, 201, "float: force of inertia, off"},
    {"added_mass_xr_of_body", 1, -41, "float: force of inertia, off"},
    {"added_mass_rr_of_body", 8, 21, "float: moment of inertia, off"},
    {"damping_matrix_xx_of_body", 0, 21, "float: force of damping, off"},
    {"damping_matrix_rr_of_body", 8, 16, "float: moment of damping, off"},
    {"quadratic_damping_xx_of_body", 0, 41, "float: force of damping, off"},
    {"quadratic_damping_xr_of_body", 1, -1, "float: force of damping, off"},
    {"quadratic_damping_rr_of_body", 4, 13, "float: moment of damping, off"},
    {"inertia_of_body", BODY(4, 0), 1e3, "float: force of inertia, off"},
    {"inertia_moment_of_body", BODY(4, 1), 1e3, "float: moment of inertia, off"},
    {"damping_of_body", BODY(4, 2), 1e3, "float: force of damping, off"},
    {"damping_moment_of_body", BODY(4, 0), 1e3, "float: moment of damping, off"},
    {"velocity_of_body", BODY(4, 0), 3, "float: velocity off that of the places"},
    {"turn_rate_of_body", BODY(4, 2), 3, "float: rate of rotation off that of the rotations"},
    {"centre_velocity_of_body", BODY(4, 1), 3, "float: velocity of the centre of gravity"},
    {"span_of_body", 4, 0.02, "float: span of the scheme"},
    {"kinetic_of_body", 4, 1e3, "float: kinetic energy"},
    {"damped_of_body", 4, 10, "float: energy dissipated by damping"},
    {"ledger_kinetic_of_body", 4, 1e3, "float: growth of the kinetic energy"},
    {"ledger_scheme_of_body", 4, 1e-3, NULL},
    {"position_of_body", BODY(4, 2), 1, "float: distance of a point from its place"},
    {"inertia_of_point", PLACE(4, KNOT, 0), 1e3, "knot: "},
    {"velocity_of_point", PLACE(4, KNOT, 1), 3, "knot: "},
    {"velocity_of_point", PLACE(5, CLUMP, 2), 0.1, "clump: velocity out of the ground"},
    {"reference_of_point", PLACE(4, KNOT, 2), -8, "knot: reference off that of the scheme"},
    {"rest_velocity_of_point", PLACE(4, KNOT, 0), 3, "knot: v* off that of the scheme"},
    {"span_of_point", POINT(4, KNOT), 0.02, "knot: span of the scheme"},
    {"kinetic_of_point", POINT(4, KNOT), 1e3, "knot: kinetic energy"},
    {"ledger_kinetic_of_point", POINT(4, KNOT), 1e3, "knot: growth of the kinetic energy"},
    {"ledger_impact_of_point", POINT(4, KNOT), 1, "knot: ledger, work of lines and load"},
    {"ledger_impact_of_point", POINT(4, CLUMP), -1, "clump: energy lost by impact"},
    {"ledger_scheme_of_point", POINT(4, KNOT), 1, "knot: ledger, work of lines and load"},
    {"b_velocity", 3 * (4 * 7), 3, "right: velocity of the end of a line"},
    {"mass_of_body", FLOAT, 401, NULL},
    {"moments_of_inertia_of_body", 1, 120.01, NULL},
    {"products_of_inertia_of_body", 2, 5.01, NULL},
    {"added_mass_xx_of_body", 4, 220.01, NULL},
    {"damping_matrix_xx_of_body", 0, 20.01, NULL},
    {"damping_matrix_xr_of_body", 1, 0.01, NULL},
    {"quadratic_damping_xx_of_body", 0, 40.01, NULL},
    {"quadratic_damping_xr_of_body", 1, -2.01, NULL},
    {"quadratic_damping_rx_of_body", 3, 3.01, NULL},
    {"quadratic_damping_rr_of_body", 4, 12.01, NULL},
    {"mass_of_point", KNOT, 60.01, NULL},
    {"b_node_mass", 2, 6, NULL},
    {"time", 4, 0.13, "time_step is not by how much time has passed"},
    {"time_step", 4, 0.03, "float: span of the scheme"},
};

/* Scenes in which what moves, or damps, is another. */
static const OtherScene OTHER[] = {
    {"moments_of_inertia: [90, 120, 150]", "moments_of_inertia: [90, 120.001, 150]"},
    {"products_of_inertia: [4, -3, 5]", "products_of_inertia: [4, -3.001, 5]"},
    {"[0, 0, 300, 0, 0, 0]", "[0, 0, 300.001, 0, 0, 0]"},
    {"damping: {x: 20, z: 90, rx: 30", "damping: {x: 20, z: 90, rx: 30.001"},
    {"[[40, 0, 0, 0, -2, 0]", "[[40.001, 0, 0, 0, -2, 0]"},
    {"[[40, 0, 0, 0, -2, 0]", "[[40, 0, 0, 0, -2.001, 0]"},
    {"[3, 0, 0, 0, 12, 0]", "[3.001, 0, 0, 0, 12, 0]"},
    {"[3, 0, 0, 0, 12, 0]", "[3, 0, 0, 0, 12.001, 0]"},
};

int main(void) {
    static const Falsified FALSIFIED = {.scene = SCENE,
                                        .records = LINES * STEPS,
                                        .number = FALSIFIED_ROWS(FALSE),
                                        .other = FALSIFIED_ROWS(OTHER)};
    return falsified_main(&FALSIFIED);
}
