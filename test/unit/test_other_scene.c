/* SPDX-License-Identifier: BSD-3-Clause */
/* A saved state is refused by any other scene: each key of a scene file is changed in turn, and the
 * state of the scene before the change is not accepted by the one after it. A key that nobody
 * changes here fails the test, so that a new key cannot be left out of a scene's fingerprint. What
 * only changes stages that have not begun is accepted. A
 * state with a byte changed is refused, or its flags are still flags. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

#include "capstan/evolve.h"
#include "capstan/io.h"
#include "io/schema/tables/scene_keys.h"
#include "other_motions.h"

static const char SCENE[] =
    "capstan: 1\n"
    "title: keys\n"
    "gravity: [0, 0, -10]\n"
    "obstacles:\n"
    "  bed: {plane: {point: [0, 0, -1], normal: [0, 0, 1]}, friction: 0.3}\n"
    "  post: {cylinder: {point: [0, 50, 0], axis: [0, 0, 1], radius: 1}, friction:"
    " {axial: 0.2, lateral: 0.1, shape: ellipse, grain: [0, 0, 1]}}\n"
    "  ball: {sphere: {centre: [0, 90, 0], axis: [1, 0, 0], radius: 2}, friction:"
    " {set: {disc: 0.4}}}\n"
    "lines:\n"
    "  one: {length: 10, elements: 4, mass: 2, stiffness: 1000, friction_zones:"
    " [{from: 2, to: 5, factor: 2}], start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}},"
    " ends: {A: held, B: {force: [1, 0, 0]}}}\n"
    "  two: {length: 10, elements: 4, weight: 3, stiffness: 1000,"
    " start: {polyline: [[0, 5, 0], [10, 5, 0]]}, ends: {A: {held: [0, 5, 0]}, B: free}}\n"
    "  bow: {length: 3, elements: 4, mass: 1, stiffness: 1000,"
    " start: {arc: {from: [0, -9, 0], centre: [0, -8, 0], axis: [0, 0, 1]}},"
    " ends: {A: held, B: held}}\n"
    "  made: {sections: [{type: hawser, length: 4, elements: 2}, {type: wire, length: 6,"
    " element_length: 1.5}], point_weights: [{at: 2, mass: 5, volume: 0.003}, {at: 4, weight: 3}],"
    " start: {straight: {from: [0, 200, 0], to: [0, 210, 0]}}, ends: {A: held, B: free}}\n"
    "  tied: {length: 10, elements: 4, mass: 2, stiffness: 1000, springs:"
    " [{from: 2, to: 5, stiffness: [1, 2, 3]}, {at: 7, stiffness: [1, 1, 0], place: [7, 1, 0]}],"
    " loads: [{force: [0, 0, 1], to: 6}], drag: {diameter: 0.1, normal: 1.2, tangential: 0.3},"
    " start: {straight: {from: [0, 600, 0], to: [10, 600, 0]}}, ends: {A: held, B: free}}\n"
    "  wet: {length: 3, elements: 3, mass: 4, diameter: 0.04, stiffness: 2000, breaking_load: 80,"
    " break_at: 90000,"
    " start: {straight: {from: [0, 300, 0], to: [3, 300, 0]}}, ends: {A: held, B: free}}\n"
    "  soft: {sections: [{type: rope, length: 3, elements: 2}],"
    " start: {straight: {from: [0, 400, 0], to: [3, 400, 0]}}, ends: {A: held, B: free}}\n"
    "  fine: {length: 3, grade: {towards: B, ratio: 4}, element_length: 0.9, mass: 2, stiffness: "
    "2000,"
    " start: {straight: {from: [0, 500, 0], to: [3, 500, 0]}}, ends: {A: held, B: free}}\n"
    "  poly: {length: 3, mass: 2, stiffness: 2000, dynamic_stiffness: 5000, elements: 3,"
    " start: {straight: {from: [0, 600, 0], to: [3, 600, 0]}}, ends: {A: held, B: free}}\n"
    "types: {hawser: {mass: 7, diameter: 0.05, stiffness: 3000, breaking_load: 900}, wire: "
    "{weight: 4, stiffness: 3000,"
    " friction: 0.5}, rope: {weight: 2, stiffness: {strain: [0, 0.1, 0.2], tension: [0, 90, "
    "400]}}}\n"
    "water_density: 900\n"
    "current: [{z: -5, velocity: [0.5, 0, 0]}, {z: 5, velocity: [1, 0.5, 0]}]\n"
    "friction_policy: consistent\n"
    "contact_policy: reached\n"
    "solver: {tolerance: 1e-8, max_iterations: 60, path_tolerance: 0.1, halvings: 3,"
    " linear_system: chain}\n"
    "history:\n"
    "  - {name: pull, steps: 2, stiffness: static, gravity: [0, 0, -9], one.B: {force: [2, 0, 0]}, "
    "post.turn: 5}\n"
    "  - {one.A: {move: [1, 0, 0]}, two.A: {position: [0, 6, 0]}}\n"
    "  - {wet.node: {at: 1, hold: true}, one.node: {at: 5, force: [0, 1, 0]}}\n"
    "  - {wet.node: {at: 2, position: [2, 300, 2]}, one.node: {at: 5, release: true}}\n";

/* Points where lines meet: beside obstacles whose friction has no directions. */
static const char POINTS_SCENE[] =
    "capstan: 1\n"
    "water_density: 900\n"
    "water_surface: 2\n"
    "obstacles: {bed: {plane: {point: [0, 0, -9]}, friction: 0.3}}\n"
    "points:\n"
    "  anchor: {held: [0, 0, 0], holding_capacity: 1e4, uplift_limit: 900, drags: true}\n"
    "  ring: {held: [8, 4, 0], weight: 2}\n"
    "  knot: {free: [4, 0, -3], force: [1, 0, 0], mass: 3, volume: 0.001}\n"
    "  ferry: {free: [4, 30, -3], weight: 5, on: {ball: {centre: [4, 30, -3], radius: 1}}}\n"
    "lines:\n"
    "  drawn: {length: 6, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {held: [0, 30, 0]}, B: {point: ferry}}}\n"
    "  one: {length: 5.5, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {point: anchor}, B: {point: knot}}}\n"
    "  two: {length: 7, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {point: knot}, B: {point: ring}}}\n"
    "  far: {length: 9, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {held: [4, 8, 0], stored: 0.5}, B: {point: knot}}}\n"
    "  taut: {sections: [{type: rope, length: 3, elements: 2}, {type: rope, length: 3, elements: "
    "2}],"
    " pretension: {end: B, tension: 40, section: 1}, start: static, ends: {A: {held: [0, 60, 0]},"
    " B: {held: [5, 60, 2]}}}\n"
    "types: {rope: {weight: 2, stiffness: 1000}}\n"
    "history:\n"
    "  - {name: pull, steps: 2, knot.point: {force: [2, 0, 0]}, far.pay_out_A: 0.1}\n"
    "  - {anchor.point: {position: [1, 0, 0]}, ring.point: {position: [8, 5, 0]},"
    " bed.obstacle: {move: [0, 0, -1], turn: 1, axis: [0, 1, 0], about: [2, 0, -9]}}\n"
    "  - {ring.point: {move: [0, 0, 1]}}\n";

/* Rigid bodies, and points on them. */
#define SPAR                                                                                   \
    "  spar: {free: [4, 0, -3], rotation: {roll_pitch_yaw: [1, 2, 3]}, fixed: [rz], mass: 30," \
    " centre_of_gravity: [0, 0, -0.2], volume: 0.02, centre_of_buoyancy: [0, 0, 0.1],"         \
    " hydrostatics: {x: 10, y: 11, z: 12, rx: 13, ry: 14, rz: 15},"                            \
    " force: [1, 0, 0], moment: [0, 2, 0], arm: [0, 0, 0.5]}\n"
#define BARGE \
    "  barge: {held: [8, 4, 0], rotation: {quaternion: [2, 0, 0, 1]}, weight: 2, buoyancy: 1}\n"
static const char BODIES_SCENE[] =
    "capstan: 1\n"
    "water_density: 900\n"
    "bodies:\n" SPAR BARGE "points:\n"
    "  eye: {body: spar, at: [0.1, 0, 0.3]}\n"
    "  keel: {body: spar, at: [0, 0.1, -0.3]}\n"
    "  bow: {body: barge}\n"
    "lines:\n"
    "  one: {length: 5.5, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {held: [0, 0, 0]}, B: {point: eye}}}\n"
    "  two: {length: 7, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {point: eye}, B: {point: bow}}}\n"
    "  far: {length: 9, elements: 4, mass: 2, stiffness: 1000, start: static,"
    " ends: {A: {held: [4, 8, 0]}, B: {point: keel}}}\n"
    "history:\n"
    "  - {name: pull, steps: 2, spar.body: {force: [2, 0, 0], arm: [0, 0, 0.6], moment: [0, 0, 1]},"
    " barge.body: {move: [0.1, 0, 0]}}\n"
    "  - {barge.body: {position: [8, 5, 0], rotation: {quaternion: [1, 0, 0, 1]}}}\n";

/* Ground, of files that are written beside the scene. */
static const char GROUND_SCENE[] =
    "capstan: 1\n"
    "obstacles: {bed: {ground: {file: other_scene_a.asc, form: esri, depths: false,"
    " point: [0, 0, -3], extend: true, friction_factor: other_scene_b.asc}, friction: 0.3}}\n"
    "lines:\n"
    "  one: {length: 3, elements: 4, mass: 2, stiffness: 1000,"
    " start: {straight: {from: [0, 0, 0], to: [3, 0, 0]}}, ends: {A: held, B: held}}\n"
    "history:\n"
    "  - {name: pull, steps: 2, one.B: {move: [0, 0, 0.1]}}\n";

/* A mesh, from a file that is written as well. */
static const char MESH_SCENE[] =
    "capstan: 1\n"
    "obstacles: {bed: {mesh: {file: other_scene_d.obj, form: obj, radius: 0.1, scale: 2,"
    " point: [0, 0, -1], rotation: {roll_pitch_yaw: [0, 0, 10]}, two_sided: false},"
    " friction: 0.3}}\n"
    "lines:\n"
    "  one: {length: 3, elements: 4, mass: 2, stiffness: 1000,"
    " start: {straight: {from: [0, 0, 0], to: [3, 0, 0]}}, ends: {A: held, B: held}}\n"
    "history:\n"
    "  - {name: pull, steps: 2, one.B: {move: [0, 0, 0.1]}}\n";

/* Shapes, below and round the line. */
static const char FLOAT_SCENE[] =
    "capstan: 1\nwater_density: 1000\nwater_surface: 0\n"
    "points: {can: {free: [9, 0, 0], mass: 5, volume: 0.1, height: 0.5}}\n"
    "lines:\n"
    "  leg: {length: 4, elements: 4, mass: 2, stiffness: 1e4, start: static,"
    " ends: {A: {held: [9, 0, -2]}, B: {point: can}}}\n"
    "  cable: {length: 4, elements: 4, mass: 2, diameter: 0.02, stiffness: 1e4, start: static,"
    " point_weights: [{at: 2, mass: 5, volume: 0.1, floats: true}],"
    " ends: {A: {held: [0, 0, -1]}, B: {held: [3, 0, -1]}}}\n"
    "history:\n"
    "  - {name: pull, cable.B: {move: [0, 0, 0.1]}}\n";

#define IN_A_SET(name, y, set)                                                            \
    "  " name                                                                             \
    ": {length: 6, elements: 4, mass: 1, stiffness: 1e4, start: {straight: {from: [0, " y \
    ", 0], to: [6, " y ", 0]}}, ends: {A: held, B: {on: {" set "}}}}\n"
static const char SETS_SCENE[] =
    "capstan: 1\n"
    "lines:\n" IN_A_SET("a", "0", "rail: {from: [6, 0, 0], to: [6, 3, 0]}, force: [1, 0, 0]")
        IN_A_SET("b", "10", "rail: {from: [6, 10, 0], along: [0, 1, 0]}") IN_A_SET(
            "c", "20", "half_space: {point: [6, 20, 0], normal: [-1, 0, 0]}, force: [9, 0, 0]")
            IN_A_SET("d", "30", "ball: {centre: [6, 30, 0], radius: 1}")
                IN_A_SET("e", "40", "disc: {centre: [6, 40, 0], radius: 1, normal: [0, 0, 2]}")
                    IN_A_SET("f", "50",
                             "box: {centre: [6, 50, 0], size: [1, 2, 3], rotation: {quaternion: "
                             "[1, 0, 0, 0]}}")
                        IN_A_SET("g", "60",
                                 "set: {translate: {by: [6, 60, 0], of: {ball: {radius: 9, "
                                 "dimension: 3}}}}") "history:\n"
                                                     "  - {name: pull, a.A: {move: [0, 0, 0.1]}}\n";

static const char SHAPES_SCENE[] =
    "capstan: 1\n"
    "obstacles:\n"
    "  rod: {capsule: {centre: [0, 0, -9], axis: [0, 1, 0], length: 3, radius: 1, inside: false}}\n"
    "  ring: {torus: {centre: [0, 0, -9], axis: [0, 1, 0], main_radius: 3, radius: 1}}\n"
    "  tip: {cone: {tip: [0, 0, -9], axis: [0, 0, -1], angle: 30, radius: 1}}\n"
    "  quay: {box: {centre: [0, 0, -9], size: [2, 3, 4], radius: 0.5,"
    " rotation: {quaternion: [1, 0, 0, 0]}}, stiffness: 900, damping: 5}\n"
    "  bowl: {sphere: {radius: 90, inside: true}}\n"
    "points: {foot: {free: [3, 0, 0], bearing_area: 0.5}}\n"
    "lines:\n"
    "  one: {length: 3, elements: 4, mass: 2, stiffness: 1000, bearing_width: 0.1,"
    " start: {straight: {from: [0, 0, 0], to: [3, 0, 0]}}, ends: {A: held, B: {point: foot}}}\n"
    "history:\n"
    "  - {name: pull, steps: 2, foot.point: {force: [0, 0, 0.1]}}\n";

static const struct SideFile {
    const char *name, *text;
} SIDE_FILE[] = {
    {"other_scene_a.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter -1\ncellsize 3\n0 0\n0 1\n"},
    {"other_scene_s.csv", "time,z\n0,0\n2,0.1\n"},
    {"other_scene_t.csv", "time,z\n0,0\n2,0.2\n"},
    {"other_scene_k.csv", "time,k33\n0,5\n2,0.2\n"},
    {"other_scene_w.csv", "amplitude,period,direction\n0.1,5,20\n"},
    {"other_scene_b.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter -1\ncellsize 3\n1 1\n1 2\n"},
    {"other_scene_c.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter -1\ncellsize 3\n1 1\n1 3\n"},
    {"other_scene_d.obj", "v 0 -1 0\nv 2 -1 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n"},
    {"other_scene_e.obj", "v 0 -1 0\nv 2 -1 0\nv 2 1 0\nv 0 1 0\nf 1 2 4\nf 2 3 4\n"},
};

static const struct Change CHANGE[] = {
    {"gravity", "gravity: [0, 0, -10]", "gravity: [0, 0, -9.9]"},
    {"obstacles", "  ball:", "  best: {plane: {}}\n  ball:"},
    {"plane", "bed: {plane: {point: [0, 0, -1], normal: [0, 0, 1]}",
     "bed: {sphere: {centre: [0, 0, -9], radius: 1}"},
    {"point", "point: [0, 0, -1]", "point: [0, 0, -2]"},
    {"normal", "normal: [0, 0, 1]", "normal: [0, 0.1, 1]"},
    {"friction", "friction: 0.3", "friction: 0.31"},
    {"cylinder", "point: [0, 50, 0]", "point: [0, 51, 0]"},
    {"axis", "axis: [0, 0, 1], radius", "axis: [0, 0.1, 1], radius"},
    {"axis", "axis: [1, 0, 0]", "axis: [1, 1, 0]"},
    {"radius", "radius: 1", "radius: 1.5"},
    {"radius", "radius: 2", "radius: 2.5"},
    {"axial", "axial: 0.2", "axial: 0.25"},
    {"lateral", "lateral: 0.1", "lateral: 0.15"},
    {"shape", "shape: ellipse", "shape: box"},
    {"grain", "grain: [0, 0, 1]", "grain: [0, 1, 1]"},
    {"sphere", "centre: [0, 90, 0]", "centre: [0, 91, 0]"},
    {"centre", "centre: [0, 90, 0]", "centre: [1, 90, 0]"},
    {"set", "{disc: 0.4}", "{disc: 0.5}"},
    {"set", "{disc: 0.4}", "{ellipse: [0.4, 0.5]}"},
    {"lines", "  bow:", "  bog:"},
    {"length", "bow: {length: 3", "bow: {length: 3.1"},
    {"elements", "length: 3, elements: 4", "length: 3, elements: [1, [2, 2]]"},
    {"mass", "mass: 2", "mass: 2.5"},
    {"weight", "weight: 3", "weight: 3.5"},
    {"stiffness", "mass: 1, stiffness: 1000", "mass: 1, stiffness: .inf"},
    {"dynamic_stiffness", "dynamic_stiffness: 5000", "dynamic_stiffness: 5001"},
    {"dynamic_stiffness", "dynamic_stiffness: 5000",
     "dynamic_stiffness: {strain: [0, 0.1, 0.2], tension: [0, 500, 1100]}"},
    {"dynamic_stiffness", "rope: {weight: 2, ",
     "rope: {weight: 2, dynamic_stiffness: {strain: [0, 0.05], tension: [0, 300]}, "},
    {"stiffness", "stiffness: static", "stiffness: dynamic"},
    {"breaking_load", "stiffness: 3000, breaking_load: 900}",
     "stiffness: 3000, breaking_load: 901}"},
    {"breaking_load", "stiffness: 2000, breaking_load: 80", "stiffness: 2000"},
    {"break_at", "break_at: 90000", "break_at: 90001"},
    {"element_length", "element_length: 0.9", "element_length: 0.3"},
    {"grade", "grade: {towards: B, ratio: 4}, element", "element"},
    {"towards", "towards: B", "towards: A"},
    {"ratio", "ratio: 4", "ratio: 5"},
    {"strain", "[0, 0.1, 0.2]", "[0, 0.11, 0.2]"},
    {"tension", "[0, 90, 400]", "[0, 90, 401]"},
    {"tension", "[0, 90, 400]", "[0, 90, 180]"},
    {"water_density", "water_density: 900", "water_density: 950"},
    {"types", "types: {hawser: {mass: 7", "types: {hawser: {mass: 8"},
    {"sections", "{type: hawser, length: 4, elements: 2}, {type: wire, length: 6,",
     "{type: hawser, length: 4, elements: 2}, {type: hawser, length: 6,"},
    {"type", "{type: wire, length: 6", "{type: hawser, length: 6"},
    {"element_length", "element_length: 1.5", "element_length: 1.4"},
    {"point_weights", ", {at: 4, weight: 3}", ""},
    {"at", "{at: 4, weight: 3}", "{at: 2, weight: 3}"},
    {"volume", "volume: 0.003", "volume: 0.004"},
    {"diameter", "mass: 4, diameter: 0.04", "mass: 4, diameter: 0.03"},
    {"friction_zones", "[{from: 2, to: 5, factor: 2}]", "[]"},
    {"springs", ", {at: 7, stiffness: [1, 1, 0], place: [7, 1, 0]}", ""},
    {"at", "{at: 7, stiffness", "{at: 2, stiffness"},
    {"stiffness", "stiffness: [1, 2, 3]", "stiffness: [1, 2, 4]"},
    {"coupling", "stiffness: [1, 2, 3]", "stiffness: [1, 2, 3], coupling: [0, 0, 0.5]"},
    {"place", "place: [7, 1, 0]", "place: [7, 2, 0]"},
    {"from", "{from: 2, to: 5, stiffness", "{from: 1, to: 5, stiffness"},
    {"to", "to: 5, stiffness", "to: 6, stiffness"},
    {"loads", "loads: [{force: [0, 0, 1], to: 6}]", "loads: []"},
    {"force", "{force: [0, 0, 1], to", "{force: [0, 0, 2], to"},
    {"drag", "drag: {diameter: 0.1", "drag: {diameter: 0.2"},
    {"diameter", "drag: {diameter: 0.1", "drag: {diameter: 0.3"},
    {"normal", "normal: 1.2", "normal: 1.3"},
    {"tangential", "tangential: 0.3", "tangential: 0.4"},
    {"current", "[1, 0.5, 0]}]", "[1, 0.6, 0]}]"},
    {"z", "{z: -5, velocity", "{z: -4, velocity"},
    {"velocity", "velocity: [0.5, 0, 0]", "velocity: [0.4, 0, 0]"},
    {"from", "{from: 2, to", "{from: 0.2, to"},
    {"to", "to: 5, factor", "to: 9, factor"},
    {"factor", "factor: 2", "factor: 2.5"},
    {"start", "start: {straight: {from: [0, 0, 0], to: [10, 0, 0]}}",
     "start: {polyline: [[0, 0, 0], [5, 0, 0], [5, 5, 0]]}"},
    {"straight", "to: [10, 0, 0]", "to: [0, 10, 0]"},
    {"polyline", "[[0, 5, 0], [10, 5, 0]]", "[[0, 5, 0], [5, 5, 0], [5, 0, 0]]"},
    {"arc", "centre: [0, -8, 0]", "centre: [0, -7, 0]"},
    {"ends", "ends: {A: held, B: held}", "ends: {A: held, B: free}"},
    {"A", "{A: held, B: held}", "{A: free, B: held}"},
    {"B", "B: free", "B: held"},
    {"force", "B: {force: [1, 0, 0]}", "B: {force: [1, 1, 0]}"},
    {"held", "B: {force: [1, 0, 0]}", "B: {held: [10, 0, 0]}"},
    {"friction_policy", "consistent", "frozen"},
    {"contact_policy", "reached", "reference"},
    {"solver",
     "solver: {tolerance: 1e-8, max_iterations: 60, path_tolerance: 0.1, halvings: 3,"
     " linear_system: chain}\n",
     ""},
    {"tolerance", "tolerance: 1e-8", "tolerance: 1e-9"},
    {"max_iterations", "max_iterations: 60", "max_iterations: 61"},
    {"path_tolerance", "path_tolerance: 0.1", "path_tolerance: 0.2"},
    {"halvings", "halvings: 3", "halvings: 4"},
    {"linear_system", "chain", "dense"},
    {"history", "  - {one.A: {move: [1, 0, 0]}, two.A: {position: [0, 6, 0]}}\n", ""},
    {"name", "name: pull", "name: push"},
    {"steps", "steps: 2", "steps: 3"},
    {"gravity", "gravity: [0, 0, -9]", "gravity: [0, 0, -8]"},
    {"LINE.END", "one.B: {", "two.B: {"},
    {"force", "force: [2, 0, 0]", "force: [2, 0, 1]"},
    {"LINE.node", "one.node: {at: 5, force", "two.node: {at: 5, force"},
    {"at", "wet.node: {at: 1", "wet.node: {at: 2"},
    {"hold", "wet.node: {at: 1, hold: true}", "wet.node: {at: 1, release: true}"},
    {"force", "one.node: {at: 5, force: [0, 1, 0]}", "one.node: {at: 5, force: [0, 2, 0]}"},
    {"position", "position: [2, 300, 2]", "position: [2, 300, 1]"},
    {"release", "one.node: {at: 5, release: true}", "one.node: {at: 5, force: [0, 0, 0]}"},
    {"OBSTACLE.turn", "post.turn: 5", "post.turn: 6"},
    {"OBSTACLE.turn", "post.turn: 5", "ball.turn: 5"},
    {"move", "move: [1, 0, 0]", "move: [1, 1, 0]"},
    {"position", "position: [0, 6, 0]", "position: [0, 7, 0]"},
};

static const struct Change POINT_CHANGE[] = {
    {"OBSTACLE.obstacle", "move: [0, 0, -1]", "move: [0, 0, -2]"},
    {"LINE.pay_out", "far.pay_out_A: 0.1", "far.pay_out_A: 0.2"},
    {"stored", "stored: 0.5", "stored: 0.6"},
    {"turn", "turn: 1,", "turn: 2,"},
    {"axis", "axis: [0, 1, 0]", "axis: [1, 1, 0]"},
    {"about", "about: [2, 0, -9]", "about: [1, 0, -9]"},
    {"points",
     "  ring: {held: [8, 4, 0], weight: 2}\n  knot: {free: [4, 0, -3], force: [1, 0, 0], mass: 3,"
     " volume: 0.001}\n",
     "  knot: {free: [4, 0, -3], force: [1, 0, 0], mass: 3, volume: 0.001}\n"
     "  ring: {held: [8, 4, 0], weight: 2}\n"},
    {"water_surface", "water_surface: 2", "water_surface: 2.5"},
    {"water_surface", "water_surface: 2\n", ""},
    {"held", "held: [8, 4, 0]", "held: [8, 4.5, 0]"},
    {"held", "held: [8, 4, 0]", "free: [8, 4, 0]"},
    {"free", "free: [4, 0, -3]", "free: [4, 0, -3.5]"},
    {"free", "free: [4, 0, -3], force: [1, 0, 0]", "held: [4, 0, -3]"},
    {"force", "force: [1, 0, 0]", "force: [1, 0, 1]"},
    {"weight", "weight: 2", "weight: 2.5"},
    {"mass", "mass: 3", "mass: 3.5"},
    {"volume", "volume: 0.001", "volume: 0.002"},
    {"pretension", " pretension: {end: B, tension: 40, section: 1},", ""},
    {"end", "end: B, tension", "end: A, tension"},
    {"tension", "tension: 40", "tension: 41"},
    {"horizontal", "tension: 40", "horizontal: 40"},
    {"section", "section: 1", "section: 2"},
    {"point", "{A: {point: anchor}, B: {point: knot}}", "{A: {point: knot}, B: {point: anchor}}"},
    {"point", "{A: {held: [4, 8, 0], stored: 0.5}", "{A: {point: ring, stored: 0.5}"},
    {"POINT.point", "knot.point: {", "ring.point: {"},
    {"on", ", on: {ball: {centre: [4, 30, -3], radius: 1}}", ""},
    {"on", "on: {ball: {centre: [4, 30, -3], radius: 1}}",
     "on: {ball: {centre: [4, 30, -3], radius: 2}}"},
    {"on", "on: {ball: {centre: [4, 30, -3], radius: 1}}",
     "on: {rail: {from: [4, 30, -3], along: [0, 1, 0]}}"},
    {"force", "force: [2, 0, 0]", "force: [2, 0, 1]"},
    {"position", "position: [8, 5, 0]", "position: [8, 6, 0]"},
    {"position", "position: [1, 0, 0]", "position: [1, 1, 0]"},
    {"holding_capacity", "holding_capacity: 1e4", "holding_capacity: 2e4"},
    {"uplift_limit", "uplift_limit: 900", "uplift_limit: 800"},
    {"drags", ", drags: true", ""},
};

static const struct Change BODY_CHANGE[] = {
    {"radiation", "mass: 30,", "mass: 30, radiation: other_scene_k.csv,"},
    {"bodies", SPAR BARGE, BARGE SPAR},
    {"held", "held: [8, 4, 0]", "held: [8, 4.5, 0]"},
    {"free", "free: [4, 0, -3]", "free: [4, 0, -3.5]"},
    {"rotation", "rotation: {roll_pitch_yaw: [1, 2, 3]}, ", ""},
    {"roll_pitch_yaw", "roll_pitch_yaw: [1, 2, 3]", "roll_pitch_yaw: [1, 3, 2]"},
    {"quaternion", "quaternion: [2, 0, 0, 1]", "quaternion: [2, 0, 0, -1]"},
    {"fixed", "fixed: [rz]", "fixed: [rx]"},
    {"mass", "mass: 30", "mass: 31"},
    {"weight", "weight: 2,", "weight: 3,"},
    {"centre_of_gravity", "centre_of_gravity: [0, 0, -0.2]", "centre_of_gravity: [0, 0, -0.3]"},
    {"volume", "volume: 0.02", "volume: 0.03"},
    {"buoyancy", "buoyancy: 1}", "buoyancy: 1.5}"},
    {"centre_of_buoyancy", "centre_of_buoyancy: [0, 0, 0.1]", "centre_of_buoyancy: [0, 0, 0.2]"},
    {"hydrostatics", "hydrostatics: {x: 10, y: 11, z: 12, rx: 13, ry: 14, rz: 15}, ", ""},
    {"x", "x: 10,", "x: 20,"},
    {"y", "y: 11,", "y: 20,"},
    {"z", " z: 12,", " z: 20,"},
    {"rx", "rx: 13,", "rx: 20,"},
    {"ry", "ry: 14,", "ry: 20,"},
    {"rz", "rz: 15", "rz: 20"},
    {"force", "force: [1, 0, 0]", "force: [1, 0, 1]"},
    {"moment", "moment: [0, 2, 0]", "moment: [0, 3, 0]"},
    {"arm", "arm: [0, 0, 0.5]", "arm: [0, 0, 0.7]"},
    {"body", "{body: spar, at: [0.1, 0, 0.3]}", "{body: barge, at: [0.1, 0, 0.3]}"},
    {"at", "at: [0.1, 0, 0.3]", "at: [0.1, 0, 0.4]"},
    {"BODY.body", "barge.body: {move: [0.1, 0, 0]}", "gravity: [0, 0, -9]"},
    {"force", "force: [2, 0, 0]", "force: [2, 0, 1]"},
    {"arm", "arm: [0, 0, 0.6]", "arm: [0, 0, 0.7]"},
    {"moment", "moment: [0, 0, 1]", "moment: [0, 0, 2]"},
    {"move", "move: [0.1, 0, 0]", "move: [0.2, 0, 0]"},
    {"position", "position: [8, 5, 0]", "position: [8, 6, 0]"},
    {"rotation", "rotation: {quaternion: [1, 0, 0, 1]}", "rotation: {quaternion: [1, 0, 0, 2]}"},
};

static const struct Change GROUND_CHANGE[] = {
    {"ground",
     "ground: {file: other_scene_a.asc, form: esri, depths: false, point: [0, 0, -3],"
     " extend: true, friction_factor: other_scene_b.asc}",
     "plane: {point: [0, 0, -3]}"},
    {"file", "file: other_scene_a.asc", "file: other_scene_b.asc"},
    {"depths", "depths: false", "depths: true"},
    {"point", "point: [0, 0, -3]", "point: [0, 0, -4]"},
    {"extend", "extend: true", "extend: false"},
    {"friction_factor", "friction_factor: other_scene_b.asc", "friction_factor: other_scene_c.asc"},
    {"friction_factor", ", friction_factor: other_scene_b.asc", ""},
};

static const struct Change MESH_CHANGE[] = {
    {"mesh",
     "mesh: {file: other_scene_d.obj, form: obj, radius: 0.1, scale: 2, point: [0, 0, -1],"
     " rotation: {roll_pitch_yaw: [0, 0, 10]}, two_sided: false}",
     "plane: {point: [0, 0, -1]}"},
    {"file", "file: other_scene_d.obj", "file: other_scene_e.obj"},
    {"radius", "radius: 0.1", "radius: 0.2"},
    {"scale", "scale: 2", "scale: 2.5"},
    {"point", "point: [0, 0, -1]", "point: [0, 0, -1.5]"},
    {"rotation", "roll_pitch_yaw: [0, 0, 10]", "roll_pitch_yaw: [0, 0, 11]"},
    {"two_sided", "two_sided: false", "two_sided: true"},
};

static const struct Change FLOAT_CHANGE[] = {
    {"floats", ", floats: true", ""},
    {"floats", "at: 2", "at: 3"},
    {"floats", "volume: 0.1, floats", "volume: 0.2, floats"},
    {"height", "height: 0.5", "height: 0.6"},
};

static const struct Change SET_CHANGE[] = {
    {"on", "{on: {rail: {from: [6, 0, 0], to: [6, 3, 0]}, force: [1, 0, 0]}}",
     "{force: [1, 0, 0]}"},
    {"rail", "rail: {from: [6, 0, 0], to: [6, 3, 0]}", "ball: {centre: [6, 0, 0], radius: 1}"},
    {"from", "from: [6, 0, 0], to", "from: [6, -1, 0], to"},
    {"to", "to: [6, 3, 0]", "to: [6, 4, 0]"},
    {"force", "to: [6, 3, 0]}, force: [1, 0, 0]", "to: [6, 3, 0]}, force: [2, 0, 0]"},
    {"along", "along: [0, 1, 0]", "along: [0, 1, 0.1]"},
    {"half_space", "half_space: {point: [6, 20, 0], normal: [-1, 0, 0]}",
     "ball: {centre: [6, 20, 0], radius: 1}"},
    {"normal", "normal: [-1, 0, 0]", "normal: [-1, 0.1, 0]"},
    {"point", "half_space: {point: [6, 20, 0]", "half_space: {point: [6.1, 20, 0]"},
    {"ball", "ball: {centre: [6, 30, 0], radius: 1}", "disc: {centre: [6, 30, 0], radius: 1}"},
    {"centre", "ball: {centre: [6, 30, 0]", "ball: {centre: [6, 30, 0.1]"},
    {"radius", "ball: {centre: [6, 30, 0], radius: 1}", "ball: {centre: [6, 30, 0], radius: 2}"},
    {"disc", "normal: [0, 0, 2]", "normal: [0, 1, 2]"},
    {"box", "size: [1, 2, 3]", "size: [1, 2, 4]"},
    {"rotation", "quaternion: [1, 0, 0, 0]", "quaternion: [1, 0.1, 0, 0]"},
    {"set", "radius: 9, dimension: 3", "radius: 8, dimension: 3"},
    {"set", "by: [6, 60, 0]", "by: [6, 60.5, 0]"},
};

static const struct Change SHAPE_CHANGE[] = {
    {"capsule",
     "capsule: {centre: [0, 0, -9], axis: [0, 1, 0], length: 3, radius: 1, inside: false}",
     "cylinder: {point: [0, 0, -9], axis: [0, 1, 0], radius: 1}"},
    {"torus", "torus: {centre: [0, 0, -9], axis: [0, 1, 0], main_radius: 3, radius: 1}",
     "sphere: {centre: [0, 0, -9], radius: 1}"},
    {"cone", "cone: {tip: [0, 0, -9], axis: [0, 0, -1], angle: 30, radius: 1}",
     "sphere: {centre: [0, 0, -9], radius: 1}"},
    {"box",
     "box: {centre: [0, 0, -9], size: [2, 3, 4], radius: 0.5, rotation: {quaternion: [1, 0, "
     "0, 0]}}",
     "sphere: {centre: [0, 0, -9], radius: 1}"},
    {"stiffness", "stiffness: 900", "stiffness: 901"},
    {"damping", "damping: 5", "damping: 6"},
    {"bearing_width", "bearing_width: 0.1", "bearing_width: 0.2"},
    {"bearing_area", "bearing_area: 0.5", "bearing_area: 0.6"},
    {"length", "length: 3, radius", "length: 4, radius"},
    {"inside", "{radius: 90, inside: true}", "{centre: [0, 0, -100], radius: 90}"},
    {"main_radius", "main_radius: 3", "main_radius: 4"},
    {"tip", "tip: [0, 0, -9]", "tip: [0, 1, -9]"},
    {"angle", "angle: 30", "angle: 31"},
    {"size", "size: [2, 3, 4]", "size: [2, 3, 5]"},
    {"size", "size: [2, 3, 4]", "size: [2, 4, 4]"},
    {"size", "size: [2, 3, 4]", "size: [3, 3, 4]"},
    {"radius", "radius: 0.5", "radius: 0.6"},
    {"rotation", "rotation: {quaternion: [1, 0, 0, 0]}", "rotation: {quaternion: [1, 0, 0, 1]}"},
};

/* Keys that change no answer, and how the file of a ground is to be read; and a file of places,
 * which is a start as good as any. */
static const char *const LEFT_OUT[] = {"capstan", "title", "nodes", "form", "variable"};

enum {
    CHANGES = sizeof CHANGE / sizeof *CHANGE,
    POINT_CHANGES = sizeof POINT_CHANGE / sizeof *POINT_CHANGE,
    BODY_CHANGES = sizeof BODY_CHANGE / sizeof *BODY_CHANGE,
    GROUND_CHANGES = sizeof GROUND_CHANGE / sizeof *GROUND_CHANGE,
    MESH_CHANGES = sizeof MESH_CHANGE / sizeof *MESH_CHANGE,
    SHAPE_CHANGES = sizeof SHAPE_CHANGE / sizeof *SHAPE_CHANGE,
    ADRIFT_CHANGES = sizeof ADRIFT_CHANGE / sizeof *ADRIFT_CHANGE,
    FLOAT_CHANGES = sizeof FLOAT_CHANGE / sizeof *FLOAT_CHANGE,
    SET_CHANGES = sizeof SET_CHANGE / sizeof *SET_CHANGE,
    MOTION_CHANGES = sizeof MOTION_CHANGE / sizeof *MOTION_CHANGE,
    LEFT = sizeof LEFT_OUT / sizeof *LEFT_OUT
};

/* A scene and its changes. */
typedef struct Suite {
    const char *scene;
    const struct Change *change;
    int count;
} Suite;

static const Suite ALL = {SCENE, CHANGE, CHANGES},
                   POINTS = {POINTS_SCENE, POINT_CHANGE, POINT_CHANGES},
                   BODIES = {BODIES_SCENE, BODY_CHANGE, BODY_CHANGES},
                   GROUND = {GROUND_SCENE, GROUND_CHANGE, GROUND_CHANGES},
                   MESH = {MESH_SCENE, MESH_CHANGE, MESH_CHANGES},
                   SHAPES = {SHAPES_SCENE, SHAPE_CHANGE, SHAPE_CHANGES},
                   ADRIFT = {ADRIFT_SCENE, ADRIFT_CHANGE, ADRIFT_CHANGES},
                   FLOATS = {FLOAT_SCENE, FLOAT_CHANGE, FLOAT_CHANGES},
                   SETS = {SETS_SCENE, SET_CHANGE, SET_CHANGES},
                   MOTION = {MOTION_SCENE, MOTION_CHANGE, MOTION_CHANGES};

static CpsEvolution *evolution_of(const char *text) {
    char path[] = "other_scene_test_XXXXXX";
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(write(fd, text, strlen(text)), strlen(text));
    close(fd);
    CpsSceneFile *file = NULL;
    CpsEvolution *evolution = NULL;
    CpsError err = {0};
    CpsStatus status = cps_scene_read(path, NULL, &file, &err);
    unlink(path);
    if (status == CPS_OK)
        status = cps_evolution_create(cps_scene_file_scene(file), &evolution, &err);
    if (status != CPS_OK) {
        print_error("%d:%d: %s, in\n%s\n", err.line, err.column, err.message, text);
        fail();
    }
    cps_scene_file_destroy(file);
    return evolution;
}

static void changed(const char *scene, const struct Change *change, char *text, size_t size) {
    const char *at = strstr(scene, change->from);
    if (!at) fail_msg("'%s' is not in the scene", change->from);
    const int before = (int)(at - scene);
    const int length =
        snprintf(text, size, "%.*s%s%s", before, scene, change->to, at + strlen(change->from));
    assert_true(length > 0 && (size_t)length < size);
}

/* Where in the scene a change is. */
static size_t place_of(const char *scene, const char *text) {
    return (size_t)(strstr(scene, text) - scene);
}

/* The state after `steps` steps, loaded by every changed scene: only changes of stages that have
 * not begun, which are written from `future` on, are of no account. */
static void expect_refused(const Suite *suite, int steps, size_t future) {
    CpsEvolution *evolution = evolution_of(suite->scene), *same = evolution_of(suite->scene);
    const size_t size = cps_evolution_state_size(evolution);
    unsigned char *saved = malloc(size);
    assert_non_null(saved);
    for (int i = 0; i < steps; i++) assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    cps_evolution_save(evolution, saved);
    assert_int_equal(cps_evolution_load(same, saved, size, NULL), CPS_OK);
    for (int i = 0; i < suite->count; i++) {
        const struct Change *change = &suite->change[i];
        char text[2 * sizeof SCENE];
        changed(suite->scene, change, text, sizeof text);
        CpsEvolution *other = evolution_of(text);
        CpsError err = {0};
        const bool is_to_come = place_of(suite->scene, change->from) >= future,
                   is_accepted = cps_evolution_load(other, saved, size, &err) == CPS_OK;
        if (is_accepted != is_to_come)
            fail_msg("after %d steps %s: '%s' for '%s' is %s; %s", steps, change->key, change->to,
                     change->from, is_accepted ? "accepted" : "refused", err.message);
        if (!is_accepted && !strstr(err.message, "another scene") &&
            !strstr(err.message, "that the history does not have"))
            fail_msg("%s: %s", change->key, err.message);
        cps_evolution_destroy(other);
    }
    free(saved);
    cps_evolution_destroy(same);
    cps_evolution_destroy(evolution);
}

static void every_change_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&ALL, 0, place_of(SCENE, "{name: pull"));
    expect_refused(&ALL, 1, place_of(SCENE, "  - {one.A"));
    expect_refused(&ALL, 2, place_of(SCENE, "  - {one.A"));
    expect_refused(&ALL, 3, place_of(SCENE, "  - {wet.node: {at: 1"));
    expect_refused(&ALL, 5, sizeof SCENE);
}

static void every_change_of_points_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&POINTS, 0, place_of(POINTS_SCENE, "{name: pull"));
    expect_refused(&POINTS, 1, place_of(POINTS_SCENE, "{name: pull")); /* after the static start */
    expect_refused(&POINTS, 2, place_of(POINTS_SCENE, "  - {anchor.point"));
    expect_refused(&POINTS, 4, sizeof POINTS_SCENE);
}

static void every_change_of_bodies_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&BODIES, 0, place_of(BODIES_SCENE, "{name: pull"));
    expect_refused(&BODIES, 2, place_of(BODIES_SCENE, "  - {barge.body"));
    expect_refused(&BODIES, 4, sizeof BODIES_SCENE);
}

static int write_files(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof SIDE_FILE / sizeof *SIDE_FILE; i++) {
        FILE *out = fopen(SIDE_FILE[i].name, "w");
        assert_non_null(out);
        fputs(SIDE_FILE[i].text, out);
        assert_int_equal(fclose(out), 0);
    }
    return 0;
}

static int remove_files(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof SIDE_FILE / sizeof *SIDE_FILE; i++) unlink(SIDE_FILE[i].name);
    return 0;
}

static void every_change_of_files_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&GROUND, 0, place_of(GROUND_SCENE, "{name: pull"));
    expect_refused(&GROUND, 1, sizeof GROUND_SCENE);
    expect_refused(&MESH, 0, place_of(MESH_SCENE, "{name: pull"));
    expect_refused(&MESH, 1, sizeof MESH_SCENE);
}

static void every_change_of_shapes_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&SHAPES, 0, place_of(SHAPES_SCENE, "{name: pull"));
    expect_refused(&SHAPES, 1, sizeof SHAPES_SCENE);
}

static void every_change_of_floats_and_sets_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&FLOATS, 1, place_of(FLOAT_SCENE, "{name: pull"));
    expect_refused(&FLOATS, 2, sizeof FLOAT_SCENE);
    expect_refused(&SETS, 0, place_of(SETS_SCENE, "{name: pull"));
    expect_refused(&SETS, 1, sizeof SETS_SCENE);
}

static void every_change_of_motions_makes_another_scene(void **state) {
    (void)state;
    expect_refused(&MOTION, 0, place_of(MOTION_SCENE, "{name: pull"));
    expect_refused(&MOTION, 1, sizeof MOTION_SCENE);
    expect_refused(&ADRIFT, 0, place_of(ADRIFT_SCENE, "{name: pull"));
    expect_refused(&ADRIFT, 1, sizeof ADRIFT_SCENE);
}

/* Whether a key is changed above or left out; found: the changes of keys that there are. */
static bool is_tried(const char *key, bool found[CHANGES]) {
    bool tried = false;
    for (int i = 0; i < CHANGES; i++)
        if (strcmp(CHANGE[i].key, key) == 0) tried = found[i] = true;
    for (int i = 0; i < POINT_CHANGES; i++) tried = tried || strcmp(POINT_CHANGE[i].key, key) == 0;
    for (int i = 0; i < BODY_CHANGES; i++) tried = tried || strcmp(BODY_CHANGE[i].key, key) == 0;
    for (int i = 0; i < GROUND_CHANGES; i++)
        tried = tried || strcmp(GROUND_CHANGE[i].key, key) == 0;
    for (int i = 0; i < MESH_CHANGES; i++) tried = tried || strcmp(MESH_CHANGE[i].key, key) == 0;
    for (int i = 0; i < ADRIFT_CHANGES; i++)
        tried = tried || strcmp(ADRIFT_CHANGE[i].key, key) == 0;
    for (int i = 0; i < FLOAT_CHANGES; i++) tried = tried || strcmp(FLOAT_CHANGE[i].key, key) == 0;
    for (int i = 0; i < SET_CHANGES; i++) tried = tried || strcmp(SET_CHANGE[i].key, key) == 0;
    for (int i = 0; i < SHAPE_CHANGES; i++) tried = tried || strcmp(SHAPE_CHANGE[i].key, key) == 0;
    for (int i = 0; i < MOTION_CHANGES; i++)
        tried = tried || strcmp(MOTION_CHANGE[i].key, key) == 0;
    for (int i = 0; i < LEFT; i++) tried = tried || strcmp(LEFT_OUT[i], key) == 0;
    return tried;
}

/* All keys of a mapping and of the mappings in it; the words of sets are one key. */
static void try_all(const CpsiMapping *mapping, bool found[CHANGES]) {
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        if (!is_tried(key->name, found)) fail_msg("no change of '%s' is tried", key->name);
        for (const CpsiKey *form = key; form; form = form->other)
            if (form->inside && form->type != CPSI_EXPRESSION) try_all(form->inside, found);
    }
}

static void every_key_is_changed(void **state) {
    (void)state;
    bool found[CHANGES] = {false};
    try_all(&cpsi_scene_file, found);
    for (int i = 0; i < CHANGES; i++)
        if (!found[i]) fail_msg("there is no key '%s'", CHANGE[i].key);
}

/* A flag that is read from bytes is 0 or 1, also where the byte was another. */
static void assert_flag(const bool *flag) {
    unsigned char byte;
    memcpy(&byte, flag, 1);
    assert_in_range(byte, 0, 1);
}

static void flags_of_a_changed_state_are_flags(void **state) {
    (void)state;
    CpsEvolution *evolution = evolution_of(SCENE);
    assert_int_equal(cps_evolution_step(evolution, NULL), CPS_OK);
    const size_t size = cps_evolution_state_size(evolution);
    unsigned char *saved = malloc(size);
    assert_non_null(saved);
    cps_evolution_save(evolution, saved);
    int accepted = 0;
    for (size_t i = 0; i < size; i++) {
        const unsigned char was = saved[i];
        saved[i] = 2;
        if (cps_evolution_load(evolution, saved, size, NULL) == CPS_OK) {
            accepted++;
            for (int k = 0; k < cps_evolution_line_count(evolution); k++) {
                const CpsLineReport report = cps_evolution_line_report(evolution, k);
                assert_flag(&report.has_slipping);
                assert_flag(&report.has_tension_mesh);
                assert_flag(&report.has_utilisation);
                assert_flag(&report.has_pierced_obstacle);
                assert_flag(&report.has_proof_obstacle);
                assert_flag(&report.has_proof_plane);
                assert_flag(&report.certificate.has_tension_bound);
                for (int end = 0; end < 2; end++) assert_flag(&report.end[end].range.has_values);
            }
        }
        saved[i] = was;
    }
    assert_true(accepted > 100);
    free(saved);
    cps_evolution_destroy(evolution);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_change_makes_another_scene),
        cmocka_unit_test(every_change_of_points_makes_another_scene),
        cmocka_unit_test(every_change_of_bodies_makes_another_scene),
        cmocka_unit_test(every_change_of_files_makes_another_scene),
        cmocka_unit_test(every_change_of_shapes_makes_another_scene),
        cmocka_unit_test(every_change_of_floats_and_sets_makes_another_scene),
        cmocka_unit_test(every_change_of_motions_makes_another_scene),
        cmocka_unit_test(flags_of_a_changed_state_are_flags),
        cmocka_unit_test(every_key_is_changed)};
    return cmocka_run_group_tests(tests, write_files, remove_files);
}
