/* SPDX-License-Identifier: BSD-3-Clause */
/* Rigid bodies on random moorings, checked from the places alone.
 *                                              usage: random_bodies [--scenes N] [--seed S]
 *
 * A body floats or hangs on two to six lines, on a bed with or without friction or clear of it, and
 * is loaded and let go. Tensions follow from the distances of nodes; with the weight of the half
 * elements their forces and moments about the body's reference point must balance its weight,
 * buoyancy, hydrostatics and load. Where nothing rubs and a pose is called stable, its potential
 * energy, the lines' included, is less than that of poses beside it.
 *
 * A given moment keeps its direction, and may be larger than what lines can hold: then the body
 * turns round and round, and there is no pose to be found. That is asked of an open step: at every
 * heading that is held, one in HEADINGS of a turn apart, the body finds a pose, and what holds the
 * heading has to resist the same way. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"
#include "turns.h"

enum { MOST_LINES = 6, STAGES = 2, HEADINGS = 72 };

/* What is left of forces, and of moments over the arm, per largest force: bodies balance to 1e-6. A
 * tension is told by the places to three times CPS_TOUCH times EA. */
static const double LEFT = 2e-6;
/* Share of the steps that may be open. */
static const double OPEN_SHARE = 0.005;

typedef struct Tally {
    int scenes, steps, open, spun, trials, most_trials, stable, heeled, poses, grounded, wrong;
    double left;
} Tally;

typedef struct Mooring {
    CpsObstacle bed;
    CpsLine line[MOST_LINES];
    CpsPoint point[2 * MOST_LINES];
    char name[3 * MOST_LINES][16];
    CpsBody body;
    CpsBodyChange change[STAGES];
    CpsStage stage[STAGES];
    CpsScene scene;
    double size, arm;
} Mooring;

static void make_body(Mooring *m, double weight, bool floats) {
    m->body = cps_body_default();
    m->body.name = "body";
    m->body.kind = CPS_BODY_KIND_FREE;
    for (int a = 0; a < 2; a++) m->body.position[a] = uniform(-0.05, 0.05) * m->size;
    m->body.position[2] = m->size * uniform(0.6, 0.9);
    const double turn = uniform(-0.5, 0.5);
    m->body.rotation[0] = cos(turn / 2);
    m->body.rotation[3] = sin(turn / 2);
    m->body.weight = weight * uniform(2, 10);
    m->body.centre_of_gravity[2] = -m->arm * uniform(0, 1);
    if (!floats) return;
    m->body.buoyancy = m->body.weight + weight * uniform(1, 4);
    m->body.centre_of_buoyancy[2] = m->arm * uniform(0, 0.5);
    m->body.hydrostatics[14] = m->body.weight / m->size * uniform(0, 4);
    m->body.hydrostatics[21] = m->body.hydrostatics[28] = m->body.weight * m->arm * uniform(0.1, 2);
}

static void make(Mooring *m, uint64_t seed) {
    memset(m, 0, sizeof *m);
    state = 0xa54ff53a5f1d36f1u * (seed + 1);
    const int lines = whole(3, MOST_LINES);
    const bool floats = chance(0.6);
    m->scene = cps_scene_default();
    m->size = pow(10, uniform(0, 3));
    m->arm = m->size * pow(10, uniform(-2, -0.8));
    const double weight = pow(10, uniform(0, 4)), stiffness = pow(10, uniform(1.5, 4));
    if (floats) {
        m->bed = cps_obstacle_default();
        m->bed.name = "bed";
        m->bed.friction = chance(0.4) ? 0 : uniform(0.05, 1.2);
        m->scene.obstacle_count = 1;
        m->scene.obstacle = &m->bed;
    }
    make_body(m, weight, floats);
    for (int i = 0; i < lines; i++) {
        const double turn = 6.283 * i / lines + uniform(-0.3, 0.3), out = uniform(0.8, 1.4);
        for (int end = 0; end < 2; end++) {
            const int k = end * lines + i;
            m->point[k] = cps_point_default();
            snprintf(m->name[k], sizeof m->name[0], "p%d", k);
            m->point[k].name = m->name[k];
            const double reach = end ? m->arm : out * m->size;
            m->point[k].position[0] = reach * cos(turn);
            m->point[k].position[1] = reach * sin(turn);
            m->point[k].position[2] = end ? m->arm * uniform(-1, 1) : floats ? 0 : 1.5 * m->size;
        }
        m->point[lines + i].kind = CPS_POINT_KIND_ON_BODY;
        double distance = 0;
        for (int a = 0; a < 3; a++)
            distance += pow(m->point[i].position[a] - m->body.position[a], 2);
        CpsLine *line = &m->line[i];
        *line = cps_line_default();
        snprintf(m->name[2 * MOST_LINES + i], sizeof m->name[0], "l%d", i);
        line->name = m->name[2 * MOST_LINES + i];
        line->length = sqrt(distance) * uniform(0.98, 1.15);
        line->element_count = whole(3, 40);
        line->weight = weight / m->size * uniform(0.3, 1);
        line->stiffness = weight * stiffness;
        line->start.kind = CPS_START_STATIC;
        const int first = chance(0.5);
        for (int end = 0; end < 2; end++) {
            line->end[end].kind = CPS_END_KIND_POINT;
            line->end_point[end] = (end == first ? 0 : lines) + i;
        }
    }
    for (int k = 0; k < STAGES; k++) {
        m->change[k] = (CpsBodyChange){.kind = CPS_BODY_KIND_FREE};
        if (k == 0)
            for (int a = 0; a < 3; a++) {
                m->change[k].force[a] = weight * uniform(-0.5, 0.5);
                m->change[k].moment[a] = weight * m->arm * uniform(-1, 1);
            }
        m->stage[k] = cps_stage_default();
        m->stage[k].name = "stage";
        m->stage[k].step_count = whole(1, 3);
        m->stage[k].body_change_count = 1;
        m->stage[k].body_change = &m->change[k];
    }
    m->scene.line_count = lines;
    m->scene.line = m->line;
    m->scene.point_count = 2 * lines;
    m->scene.point = m->point;
    m->scene.body_count = 1;
    m->scene.body = &m->body;
    m->scene.stage_count = STAGES;
    m->scene.stage = m->stage;
}

/* The rotation vector from the pose in which the body begins: that of R R0'. */
static void turned_by(const double q[4], const double from[4], double out[3]) {
    const double w = q[0] * from[0] + q[1] * from[1] + q[2] * from[2] + q[3] * from[3];
    double v[3];
    const double a[3] = {q[1], q[2], q[3]}, b[3] = {from[1], from[2], from[3]};
    cross(b, a, v);
    for (int i = 0; i < 3; i++) v[i] = from[0] * a[i] - q[0] * b[i] + v[i];
    const double sign = w < 0 ? -1 : 1, size = norm(v),
                 by = size > 1e-12 ? 2 * atan2(size, fabs(w)) / size : 2;
    for (int i = 0; i < 3; i++) out[i] = sign * by * v[i];
}

/* The rotation after one more by the vector `by`. */
static void turn_on(const double q[4], const double by[3], double out[4]) {
    const double angle = norm(by), s = angle > 0 ? sin(angle / 2) / angle : 0.5, w = cos(angle / 2),
                 x = s * by[0], y = s * by[1], z = s * by[2];
    out[0] = w * q[0] - x * q[1] - y * q[2] - z * q[3];
    out[1] = w * q[1] + x * q[0] + y * q[3] - z * q[2];
    out[2] = w * q[2] - x * q[3] + y * q[0] + z * q[1];
    out[3] = w * q[3] + x * q[2] - y * q[1] + z * q[0];
}

/* [J] The energy of the hydrostatics. */
static double water_energy(const Mooring *m, const double position[3], const double rotation[4]) {
    double q[6], sum = 0;
    for (int a = 0; a < 3; a++) q[a] = position[a] - m->body.position[a];
    turned_by(rotation, m->body.rotation, &q[3]);
    for (int i = 0; i < 6; i++)
        for (int k = 0; k < 6; k++) sum += 0.5 * m->body.hydrostatics[6 * i + k] * q[i] * q[k];
    return sum;
}

/* Add a force and its moment about the reference point. */
static void add(double sum[6], const double force[3], const double arm[3]) {
    double moment[3];
    cross(arm, force, moment);
    for (int i = 0; i < 3; i++) {
        sum[i] += force[i];
        sum[3 + i] += moment[i];
    }
}

/* What is left of the forces on the body, per largest force; `known`: to what they are known. */
static double left_of(const Mooring *m, const CpsEvolution *evolution, const double load[6],
                      double *known) {
    const CpsBodyReport at = cps_evolution_body_report(evolution, 0);
    double r[3][3], sum[6], arm[3], largest = norm(load);
    matrix_of(at.rotation, r);
    memcpy(sum, load, sizeof sum);
    *known = 0;
    for (int i = 0; i < m->scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const int n = view.element_count;
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        largest = fmax(largest, report.certificate.largest_force);
        *known += 3 * CPS_TOUCH * m->line[i].stiffness + report.certificate.tension_estimate;
        for (int end = 0; end < 2; end++) {
            const int point = m->line[i].end_point[end];
            if (point < m->scene.line_count) continue;
            const int e = end ? n - 1 : 0, near = end ? n : 0, far = end ? n - 1 : 1;
            double force[3], d[3];
            for (int a = 0; a < 3; a++)
                d[a] = view.position[3 * far + a] - view.position[3 * near + a];
            const double l = view.element_length[e], size = norm(d),
                         tension = m->line[i].stiffness * fmax(0, size / l - 1);
            for (int a = 0; a < 3; a++) force[a] = tension * d[a] / size;
            force[2] -= 0.5 * l * m->line[i].weight;
            turn_to(r, m->point[point].position, arm);
            add(sum, force, arm);
        }
    }
    turn_to(r, m->body.centre_of_gravity, arm);
    add(sum, (const double[3]){0, 0, -m->body.weight}, arm);
    turn_to(r, m->body.centre_of_buoyancy, arm);
    add(sum, (const double[3]){0, 0, m->body.buoyancy}, arm);
    for (int i = 0; i < 6; i++) {
        const double size = i < 3 ? 1e-4 * m->arm : 1e-4;
        double by[2];
        for (int side = 0; side < 2; side++) {
            double position[3], rotation[4], move[6] = {0};
            move[i] = side ? size : -size;
            for (int a = 0; a < 3; a++) position[a] = at.position[a] + move[a];
            turn_on(at.rotation, &move[3], rotation);
            by[side] = water_energy(m, position, rotation);
        }
        sum[i] -= (by[1] - by[0]) / (2 * size);
    }
    *known /= largest;
    return fmax(norm(sum), norm(&sum[3]) / m->arm) / largest;
}

/* [J] The potential energy in a pose: the lines where they are with the body held there. */
static double energy(const Mooring *m, const double position[3], const double rotation[4],
                     const double load[6]) {
    static Mooring held;
    CpsEvolution *evolution = NULL;
    CpsError err;
    double r[3][3], arm[3], sum = 0;
    held = *m;
    held.scene.line = held.line;
    held.scene.point = held.point;
    held.scene.body = &held.body;
    held.scene.obstacle = &held.bed;
    held.scene.stage_count = 0;
    held.body.kind = CPS_BODY_KIND_HELD;
    memcpy(held.body.position, position, sizeof held.body.position);
    memcpy(held.body.rotation, rotation, sizeof held.body.rotation);
    if (cps_evolution_create(&held.scene, &evolution, &err) != CPS_OK) return INFINITY;
    if (cps_evolution_step(evolution, &err) != CPS_OK) sum = INFINITY;
    if (cps_evolution_report(evolution).outcome != CPS_OUTCOME_SOLVED) sum = NAN;
    for (int i = 0; i < m->scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        for (int e = 0; e < view.element_count; e++) {
            const double *x = &view.position[3 * e], l = view.element_length[e];
            const double d[3] = {x[3] - x[0], x[4] - x[1], x[5] - x[2]};
            const double strain = fmax(0, norm(d) / l - 1);
            sum += 0.5 * m->line[i].stiffness * strain * strain * l +
                   m->line[i].weight * l * 0.5 * (x[2] + x[5]);
        }
    }
    cps_evolution_destroy(evolution);
    matrix_of(rotation, r);
    turn_to(r, m->body.centre_of_gravity, arm);
    sum += m->body.weight * (position[2] + arm[2]);
    turn_to(r, m->body.centre_of_buoyancy, arm);
    sum -= m->body.buoyancy * (position[2] + arm[2]);
    sum += water_energy(m, position, rotation);
    for (int a = 0; a < 3; a++) sum -= load[a] * position[a];
    return sum;
}

/* Poses beside a stable one without a moment have more energy; of a given moment there is none. */
static bool is_minimum(const Mooring *m, const CpsBodyReport *at, const double load[6],
                       Tally *tally) {
    const double here = energy(m, at->position, at->rotation, load);
    double scale = 0;
    for (int i = 0; i < m->scene.line_count; i++)
        scale += m->line[i].length * (m->line[i].weight * m->line[i].length);
    scale += (m->body.weight + m->body.buoyancy) * m->size;
    for (int k = 0; k < 4; k++) {
        double position[3], rotation[4], turn[3];
        for (int a = 0; a < 3; a++) {
            position[a] = at->position[a] + uniform(-1, 1) * 1e-3 * m->size;
            turn[a] = uniform(-3e-3, 3e-3);
        }
        turn_on(at->rotation, turn, rotation);
        tally->poses++;
        if (energy(m, position, rotation, load) < here - 1e-11 * scale) return false;
    }
    return true;
}

/* Does the load turn the body at every heading, always the same way? */
static bool is_spun(const Mooring *m, const double load[6]) {
    static Mooring turned;
    int sign = 0;
    for (int k = 0; k < HEADINGS; k++) {
        const double half = 3.14159265358979 * k / HEADINGS;
        CpsEvolution *evolution = NULL;
        CpsError err;
        turned = *m;
        turned.scene.line = turned.line;
        turned.scene.point = turned.point;
        turned.scene.body = &turned.body;
        turned.scene.obstacle = &turned.bed;
        turned.scene.stage_count = 0;
        turned.body.fixed[5] = true;
        memcpy(turned.body.force, load, sizeof turned.body.force);
        memcpy(turned.body.moment, &load[3], sizeof turned.body.moment);
        memcpy(turned.body.rotation, (const double[4]){cos(half), 0, 0, sin(half)},
               sizeof turned.body.rotation);
        if (cps_evolution_create(&turned.scene, &evolution, &err) != CPS_OK) exit(1);
        if (cps_evolution_step(evolution, &err) != CPS_OK) exit(1);
        const bool found = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
        const double held = cps_evolution_body_report(evolution, 0).support[5];
        cps_evolution_destroy(evolution);
        const int now = held < 0 ? -1 : 1;
        if (!found || (sign != 0 && now != sign)) return false;
        sign = now;
    }
    return true;
}

static void run(uint64_t seed, Tally *tally) {
    static Mooring m;
    make(&m, seed);
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&m.scene, &evolution, &err) != CPS_OK) {
        printf("seed %llu: %s\n", (unsigned long long)seed, err.message);
        exit(1);
    }
    tally->scenes++;
    bool sound = true;
    int stage = 0, part = 0;
    for (int step = 0; sound && cps_evolution_remaining_count(evolution) > 0; step++) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) exit(1);
        double load[6] = {0}, known;
        if (step > 0) {
            const double share = (double)(part + 1) / m.stage[stage].step_count;
            for (int a = 0; a < 6; a++) {
                const double *to =
                                 a < 3 ? &m.change[stage].force[a] : &m.change[stage].moment[a - 3],
                             *from = a < 3 ? &m.change[0].force[a] : &m.change[0].moment[a - 3];
                load[a] = stage == 0 ? share * *to : *from + share * (*to - *from);
            }
            if (++part == m.stage[stage].step_count) {
                part = 0;
                stage++;
            }
        }
        const CpsBodyReport at = cps_evolution_body_report(evolution, 0);
        tally->steps++;
        tally->trials += at.trial_count;
        if (at.trial_count > tally->most_trials) tally->most_trials = at.trial_count;
        sound = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
        if (!sound) {
            const bool spun = is_spun(&m, load);
            tally->spun += spun;
            tally->open += !spun;
            printf("seed %llu step %d: %s after %d trials\n", (unsigned long long)seed, step,
                   spun ? "turned round and round" : "open", at.trial_count);
            continue;
        }
        const double left = left_of(&m, evolution, load, &known);
        double vector[3];
        turned_by(at.rotation, m.body.rotation, vector);
        tally->left = fmax(tally->left, left);
        tally->stable += at.is_stable;
        tally->heeled += norm(vector) > 10 / 57.3;
        for (int i = 0; i < m.scene.line_count; i++)
            tally->grounded += cps_evolution_line_report(evolution, i).grounded > 0;
        bool wrong = !(left <= LEFT + known);
        if (step == 0 && at.is_stable && !is_minimum(&m, &at, load, tally)) wrong = true;
        if (wrong)
            printf("seed %llu step %d: refuted, left %g, allowed %g\n", (unsigned long long)seed,
                   step, left, LEFT + known);
        tally->wrong += wrong;
    }
    cps_evolution_destroy(evolution);
}

int main(int argc, char **argv) {
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 60, &first);
    Tally t = {0};
    for (int i = 0; i < scenes; i++) run(first + (uint64_t)i, &t);
    printf("%d scenes, %d steps: %d turned round and round, %d open, %d wrong; %.1f trials a step, "
           "at most %d; left of the "
           "forces up to %.2g; %d stable, %d heel by more than 10 degrees, %d grounded lines; %d "
           "poses of more energy\n",
           t.scenes, t.steps, t.spun, t.open, t.wrong, (double)t.trials / t.steps, t.most_trials,
           t.left, t.stable, t.heeled, t.grounded, t.poses);
    return t.wrong > 0 || t.open > fmax(1, OPEN_SHARE * t.steps);
}
