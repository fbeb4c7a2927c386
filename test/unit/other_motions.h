/* SPDX-License-Identifier: BSD-3-Clause */
/* Scenes in time and the changes of their keys, of test_other_scene.c. */
#ifndef CAPSTAN_TEST_OTHER_MOTIONS_H
#define CAPSTAN_TEST_OTHER_MOTIONS_H

/* The key, what is written of it, and what else could be. */
struct Change {
    const char *key, *from, *to;
};

/* A line that moves in time. */
static const char MOTION_SCENE[] =
    "capstan: 1\n"
    "time_scheme: bdf2\n"
    "lines:\n"
    "  one: {length: 3, elements: 4, mass: 2, inertia: 3, velocity: [0, 0, 1], stiffness: 1000,"
    " damping: 5,"
    " point_weights: [{at: 1.5, mass: 1, inertia: 1.2}],"
    " start: {straight: {from: [0, 0, 0], to: [3, 0, 0]}}, ends: {A: held, B: held},"
    " drag: {diameter: 0.1, normal: 1, tangential: 0.1, added_normal: 0.8, added_tangential:"
    " 0.3}}\n"
    "water_density: 10\n"
    "water_surface: 1\n"
    "waves: {depth: 30, ramp: 2, components: [{amplitude: 0.1, period: 5, direction: 20, phase: "
    "30}, {amplitude: 0.2, frequency: 0.1, direction: 0}]}\n"
    "history:\n"
    "  - {name: pull, duration: 2, time_step: 0.5,"
    " one.B: {move: [0, 0, 0.1], sine: [0, 0, 0.2], cosine: [0, 0, 0.3], period: 4,"
    " oscillations: [{sine: [0.1, 0, 0], period: 7}], series: other_scene_s.csv}}\n";

static const char ADRIFT_SCENE[] =
    "capstan: 1\n"
    "bodies: {raft: {free: [0, 0, 0], mass: 50, moments_of_inertia: [20, 25, 30],"
    " products_of_inertia: [1, 2, 3], added_mass: {x: 5}, damping: {y: 6},"
    " quadratic_damping: {z: 7}, velocity: [0.1, 0, 0], turn_rate: [0, 0, 0.2],"
    " excitation: [{period: 4, direction: 20, amplitude: [1, 2, 3, 4, 5, 6]}, {period: 6, "
    "direction: 20,"
    " amplitude: [1, 2, 3, 4, 5, 7], phase: [10, 20, 30, 40, 50, 60]}],"
    " members: [{from: [0, 0, -3], to: [0, 1, 2], diameter: 0.4, normal: 0.9, tangential: 0.3,"
    " added_normal: 0.7, strips: 9}, {from: [1, 0, 0], to: [2, 0, 0], diameter: 1, normal: 1}]},"
    " quay: {held: [0, 0, 3]}}\n"
    "points: {eye: {body: raft, at: [0, 0, 0.5]}, ring: {body: quay, at: [0, 0, 0.5]}}\n"
    "lines:\n"
    "  one: {length: 3, elements: 4, mass: 2, stiffness: 10000, quasi_static: true,"
    " start: {straight: {from: [0, 0, 3.5], to: [0, 0, 0.5]}},"
    " ends: {A: {point: ring}, B: {point: eye}}}\n"
    "water_density: 10\n"
    "water_surface: 9\n"
    "waves: {depth: 30, components: [{amplitude: 0.1, period: 5, direction: 20, phase: 30}]}\n"
    "history:\n"
    "  - {name: pull, duration: 0.2, time_step: 0.1,"
    " raft.body: {force: [0, 0, 0], oscillations: [{moment_sine: [0, 1, 0],"
    " moment_cosine: [0, 2, 0], period: 5}]}, quay.body: {move: [0, 0, 0],"
    " oscillations: [{rotation_sine: [0, 3, 0], rotation_cosine: [0, 4, 0], period: 5}]}}\n";

static const struct Change ADRIFT_CHANGE[] = {
    {"moment_sine", "moment_sine: [0, 1, 0]", "moment_sine: [1, 1, 0]"},
    {"moment_cosine", "moment_cosine: [0, 2, 0]", "moment_cosine: [0, 2, 1]"},
    {"rotation_sine", "rotation_sine: [0, 3, 0]", "rotation_sine: [0, 3.5, 0]"},
    {"rotation_cosine", "rotation_cosine: [0, 4, 0]", "rotation_cosine: [1, 4, 0]"},
    {"quasi_static", ", quasi_static: true", ""},
    {"moments_of_inertia", "[20, 25, 30]", "[20, 25, 31]"},
    {"products_of_inertia", "[1, 2, 3]", "[1, 2, 4]"},
    {"added_mass", "added_mass: {x: 5}", "added_mass: {x: 5, rz: 1}"},
    {"damping", ", damping: {y: 6}", ", damping: {y: 7}"},
    {"quadratic_damping", "quadratic_damping: {z: 7}", "quadratic_damping: {z: 8}"},
    {"quadratic_damping of rz", "quadratic_damping: {z: 7}", "quadratic_damping: {z: 7, rz: 1}"},
    {"velocity", "velocity: [0.1, 0, 0]", "velocity: [0.2, 0, 0]"},
    {"turn_rate", "turn_rate: [0, 0, 0.2]", "turn_rate: [0, 0, 0.3]"},
    {"excitation", "[{period: 4, direction: 20, amplitude: [1, 2, 3, 4, 5, 6]}, ",
     "[{period: 3, direction: 20, amplitude: [1, 2, 3, 4, 5, 6]}, "},
    {"amplitude", "[1, 2, 3, 4, 5, 7]", "[1, 2, 3, 4, 5, 8]"},
    {"phase", "phase: [10", "phase: [11"},
    {"members", ", {from: [1, 0, 0], to: [2, 0, 0], diameter: 1, normal: 1}", ""},
    {"from", "from: [0, 0, -3]", "from: [0, 0, -3.1]"},
    {"to", "to: [0, 1, 2]", "to: [0, 1, 2.1]"},
    {"diameter", "diameter: 0.4", "diameter: 0.5"},
    {"normal", "normal: 0.9", "normal: 0.8"},
    {"tangential", "tangential: 0.3", "tangential: 0.2"},
    {"added_normal", "added_normal: 0.7", "added_normal: 0.8"},
    {"strips", "strips: 9", "strips: 10"},
    {"water_surface", "water_surface: 9", "water_surface: 8"},
    {"ramp", "waves: {depth: 30,", "waves: {depth: 30, ramp: 3,"},
};

static const struct Change MOTION_CHANGE[] = {
    {"time_scheme", "time_scheme: bdf2", "time_scheme: euler"},
    {"inertia", "inertia: 3", "inertia: 3.5"},
    {"inertia", "inertia: 1.2", "inertia: 1.3"},
    {"velocity", "velocity: [0, 0, 1]", "velocity: [0, 0, 2]"},
    {"duration", "duration: 2", "duration: 1.9"},
    {"time_step", "time_step: 0.5", "time_step: 0.25"},
    {"error", "time_step: 0.5", "time_step: 0.5, error: 1"},
    {"sine", "sine: [0, 0, 0.2]", "sine: [0, 0, 0.21]"},
    {"cosine", "cosine: [0, 0, 0.3]", "cosine: [0, 0.1, 0.3]"},
    {"period", "period: 4", "period: 5"},
    {"oscillations", "{sine: [0.1, 0, 0], period: 7}", "{sine: [0.1, 0, 0], period: 8}"},
    {"oscillations", "sine: [0.1, 0, 0]", "sine: [0.2, 0, 0]"},
    {"series", "other_scene_s.csv", "other_scene_t.csv"},
    {"file",
     "components: [{amplitude: 0.1, period: 5, direction: 20, phase: 30}, {amplitude: 0.2, "
     "frequency: 0.1, direction: 0}]",
     "file: other_scene_w.csv"},
    {"damping", " damping: 5", " damping: 6"},
    {"diameter", "diameter: 0.1", "diameter: 0.11"},
    {"normal", ", normal: 1", ", normal: 1.1"},
    {"tangential", ", tangential: 0.1", ", tangential: 0.2"},
    {"added_normal", "added_normal: 0.8", "added_normal: 0.9"},
    {"added_tangential", "added_tangential: 0.3", "added_tangential: 0.4"},
    {"waves", ", {amplitude: 0.2, frequency: 0.1, direction: 0}", ""},
    {"components", ", {amplitude: 0.2, frequency: 0.1, direction: 0}", ""},
    {"depth", "depth: 30", "depth: .inf"},
    {"ramp", "ramp: 2", "ramp: 3"},
    {"amplitude", "amplitude: 0.1", "amplitude: 0.11"},
    {"period", "period: 5, direction", "period: 5.1, direction"},
    {"frequency", "frequency: 0.1", "frequency: 0.11"},
    {"direction", "direction: 20", "direction: 21"},
    {"phase", "phase: 30", "phase: 31"},
    {"water_surface", "water_surface: 1", "water_surface: 2"},
};

#endif
