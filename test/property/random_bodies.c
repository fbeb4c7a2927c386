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
 * heading that is held, one in HEADINGS of a turn apart, the body finds a pose by statics, and what
 * holds the heading has to resist the same way; or the step itself is taken to held poses at these
 * headings, and at more where the least is missing, until all but the moment about the vertical
 * balances, and that has to turn the body the same way. Of certified steps of every ASKED-th scene
 * it is asked as well, and must not be so. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"
#include "scenes_given.h"
#include "turns.h"

enum { MOST_LINES = 6, STAGES = 2, HEADINGS = 72, PARTS = 20, ASKED = 10 };

/* What is left of forces, and of moments over the arm, per largest force: bodies balance to 1e-6. A
 * tension is told by the places to three times CPS_TOUCH times EA. */
static const double LEFT = 2e-6;
/* What turns the body is more than so many times what may be left; all else is balanced to this
 * share of it. Closer than that it is not everywhere: forces jump by 1e-3 of the largest where the
 * lines begin to take a step in two parts. */
static const double CLEARLY = 10, LITTLE = 0.01;
/* After a whole turn it is what it was to this share, or poses of another kind have been gone
 * through.
 */
static const double CLOSED = 0.05;
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
    const double to[4] = {w * q[0] - x * q[1] - y * q[2] - z * q[3],
                          w * q[1] + x * q[0] + y * q[3] - z * q[2],
                          w * q[2] - x * q[3] + y * q[0] + z * q[1],
                          w * q[3] + x * q[2] - y * q[1] + z * q[0]};
    memcpy(out, to, sizeof to);
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

/* The forces and moments on the body; returns the largest force. `known`: to what share of that
 * they are known. */
static double net_on(const Mooring *m, const CpsEvolution *evolution, const double load[6],
                     double sum[6], double *known) {
    const CpsBodyReport at = cps_evolution_body_report(evolution, 0);
    double r[3][3], arm[3], largest = norm(load);
    matrix_of(at.rotation, r);
    memcpy(sum, load, 6 * sizeof *sum);
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
    return largest;
}

/* What is left of them, per largest force. */
static double left_of(const Mooring *m, const CpsEvolution *evolution, const double load[6],
                      double *known) {
    double sum[6];
    const double largest = net_on(m, evolution, load, sum, known);
    return fmax(norm(sum), norm(&sum[3]) / m->arm) / largest;
}

/* A copy that may be changed, with its parts in place of those of *m and nothing to do. */
static void copy_without_history(Mooring *copy, const Mooring *m) {
    *copy = *m;
    copy->scene.line = copy->line;
    copy->scene.point = copy->point;
    copy->scene.body = &copy->body;
    copy->scene.obstacle = &copy->bed;
    copy->scene.stage_count = 0;
}

/* [J] The potential energy in a pose: the lines where they are with the body held there. */
static double energy(const Mooring *m, const double position[3], const double rotation[4],
                     const double load[6]) {
    static Mooring held;
    CpsEvolution *evolution = NULL;
    CpsError err;
    double r[3][3], arm[3], sum = 0;
    copy_without_history(&held, m);
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

/* The given load after `step` of the scene, of which the first is the statics. */
static void load_after(const Mooring *m, int step, double load[6]) {
    double from[6] = {0};
    int at = 1;
    memset(load, 0, 6 * sizeof *load);
    for (int k = 0; k < STAGES; k++) {
        const int parts = m->stage[k].step_count;
        const double *force = m->change[k].force, *moment = m->change[k].moment;
        for (int part = 1; part <= parts; part++, at++) {
            if (at != step) continue;
            for (int a = 0; a < 6; a++)
                load[a] =
                    from[a] + (double)part / parts * ((a < 3 ? force[a] : moment[a - 3]) - from[a]);
        }
        memcpy(from, force, 3 * sizeof *from);
        memcpy(&from[3], moment, 3 * sizeof *from);
    }
}

/* A step that is asked about: where it begins, and the load under which it ends. */
typedef struct Asked {
    const Mooring *m;
    CpsEvolution *evolution;
    void *before;
    size_t size;
    double load[6];
} Asked;

typedef struct Pose {
    double position[3], rotation[4];
    double turns;         /* [N] the moment about the vertical, per arm */
    double stiffness[36]; /* the last one that was found, of lines not slack in part */
} Pose;

/* Solve a x = b of the columns 0 to 4 and 5 of a, with pivots. */
static bool solve(double a[5][6]) {
    for (int p = 0; p < 5; p++) {
        int best = p;
        for (int i = p + 1; i < 5; i++)
            if (fabs(a[i][p]) > fabs(a[best][p])) best = i;
        if (!(fabs(a[best][p]) > 0)) return false;
        for (int k = 0; k < 6; k++) {
            const double swap = a[p][k];
            a[p][k] = a[best][k];
            a[best][k] = swap;
        }
        for (int i = 0; i < 5; i++) {
            const double by = i == p ? 0 : a[i][p] / a[p][p];
            for (int k = p; k < 6; k++) a[i][k] -= by * a[p][k];
        }
    }
    for (int i = 0; i < 5; i++) a[i][5] /= a[i][i];
    return true;
}

/* Take the step to the held pose; what then acts on the body, and its largest force. */
static double net_at(const Asked *asked, const Pose *pose, double sum[6], double *known) {
    CpsError err;
    CpsBodyChange to = {.kind = CPS_BODY_KIND_HELD};
    CpsStage move = cps_stage_default();
    memcpy(to.position, pose->position, sizeof to.position);
    memcpy(to.rotation, pose->rotation, sizeof to.rotation);
    move.body_change_count = 1;
    move.body_change = &to;
    if (cps_evolution_load(asked->evolution, asked->before, asked->size, &err) != CPS_OK) exit(1);
    if (cps_evolution_move(asked->evolution, &move, &err) != CPS_OK) exit(1);
    const bool sound = cps_outcome_is_certified(cps_evolution_report(asked->evolution).outcome);
    const double largest = net_on(asked->m, asked->evolution, asked->load, sum, known);
    return sound ? largest : NAN;
}

/* [rad] Where the first axis of the body points, seen from above. */
static double heading_of(const double rotation[4]) {
    double r[3][3];
    matrix_of(rotation, r);
    return atan2(r[1][0], r[0][0]);
}

/* Turn about the vertical to this heading. */
static void head(double rotation[4], double heading) {
    const double turn[3] = {0, 0, heading - heading_of(rotation)};
    turn_on(rotation, turn, rotation);
}

/* Find the pose with this heading in which all but the moment about the vertical balances, by
 * Newton's method from the pose given. False: there is none, or that moment is none. */
static bool find_pose(const Asked *asked, Pose *pose) {
    enum { MOST = 100 };
    const Mooring *m = asked->m;
    const double heading = heading_of(pose->rotation);
    for (int i = 0; i < MOST; i++) {
        double sum[6], a[5][6], known, left = 0, far = 0;
        CpsError err;
        CpsBodyStiffness k;
        const double largest = net_at(asked, pose, sum, &known);
        for (int j = 0; j < 5; j++) left = fmax(left, fabs(sum[j]) / (j < 3 ? 1 : m->arm));
        pose->turns = sum[5] / m->arm;
        if (left <= LITTLE * fabs(pose->turns))
            return fabs(pose->turns) > CLEARLY * (LEFT + known) * largest;
        if (cps_evolution_body_stiffness(asked->evolution, 0, CPS_STIFFNESS_STEP, &k, &err) !=
            CPS_OK)
            exit(1);
        if (k.outcome == CPS_STIFFNESS_OUTCOME_FOUND)
            memcpy(pose->stiffness, k.matrix, sizeof pose->stiffness);
        for (int j = 0; j < 5; j++) {
            memcpy(a[j], &pose->stiffness[6 * j], 5 * sizeof **a);
            a[j][5] = sum[j];
        }
        if (!solve(a)) return false;
        for (int j = 0; j < 5; j++) far = fmax(far, fabs(a[j][5]) * (j < 3 ? 1 : m->arm));
        const double share = fmin(1, 0.03 * m->size / far);
        const double turn[3] = {share * a[3][5], share * a[4][5], 0};
        for (int j = 0; j < 3; j++) pose->position[j] += share * a[j][5];
        turn_on(pose->rotation, turn, pose->rotation);
        head(pose->rotation, heading);
    }
    return false;
}

/* Does the load turn the body the same way at `count` headings beyond that of the pose, so far
 * [rad] apart? The pose goes along; remembers the one before that where the load does so least. */
static bool turns_on(const Asked *asked, Pose *pose, int count, double apart, Pose *least) {
    const double first = pose->turns;
    double most = INFINITY;
    for (int k = 0; k < count; k++) {
        const Pose before = *pose;
        head(pose->rotation, heading_of(pose->rotation) + apart);
        if (!find_pose(asked, pose) || first * pose->turns < 0) return false;
        if (fabs(pose->turns) >= most) continue;
        most = fabs(pose->turns);
        *least = before;
    }
    return true;
}

/* Take the steps before this one, each in a stage of its own: no step of a program may be taken
 * within a stage. */
static void go_before(const Mooring *m, int step, Asked *asked) {
    enum { MOST = 3 * STAGES };
    static Mooring split;
    CpsBodyChange change[MOST];
    CpsStage stage[MOST];
    CpsError err;
    split = *m;
    split.scene.stage = stage;
    split.scene.stage_count = step > 0 ? step - 1 : 0;
    for (int k = 0; k < split.scene.stage_count; k++) {
        double load[6];
        load_after(m, k + 1, load);
        stage[k] = m->stage[0];
        stage[k].step_count = 1;
        stage[k].body_change = &change[k];
        change[k] = m->change[0];
        memcpy(change[k].force, load, sizeof change[k].force);
        memcpy(change[k].moment, &load[3], sizeof change[k].moment);
    }
    asked->m = m;
    load_after(m, step, asked->load);
    if (cps_evolution_create(&split.scene, &asked->evolution, &err) != CPS_OK) exit(1);
    while (cps_evolution_remaining_count(asked->evolution) > 0)
        if (cps_evolution_step(asked->evolution, &err) != CPS_OK) exit(1);
    asked->size = cps_evolution_state_size(asked->evolution);
    asked->before = malloc(asked->size);
    if (!asked->before) exit(1);
    cps_evolution_save(asked->evolution, asked->before);
}

/* Does the load of a step turn the body at every heading, always the same way, with the friction of
 * the lines from where the step begins? */
static bool is_spun_by_step(const Mooring *m, int step) {
    Asked asked;
    const double apart = 6.283185307179586 / HEADINGS;
    if (step == 0) return false;
    go_before(m, step, &asked);
    Pose pose = {{0}, {0}, 0, {0}}, least, unused;
    const CpsBodyReport at = cps_evolution_body_report(asked.evolution, 0);
    memcpy(pose.position, at.position, sizeof pose.position);
    memcpy(pose.rotation, at.rotation, sizeof pose.rotation);
    memcpy(pose.stiffness, at.stiffness, sizeof pose.stiffness);
    bool spun = find_pose(&asked, &pose);
    const double first = pose.turns;
    spun = spun && turns_on(&asked, &pose, HEADINGS, apart, &least) &&
           fabs(pose.turns - first) <= CLOSED * fabs(first) &&
           turns_on(&asked, &least, 2 * PARTS, apart / PARTS, &unused);
    free(asked.before);
    cps_evolution_destroy(asked.evolution);
    return spun;
}

/* Does the load turn the body at every heading, always the same way, where nothing rubs and the
 * step places all by statics? */
static bool is_spun_by_statics(const Mooring *m, const double load[6]) {
    static Mooring turned;
    int sign = 0;
    for (int k = 0; k < HEADINGS; k++) {
        const double half = 3.14159265358979 * k / HEADINGS;
        CpsEvolution *evolution = NULL;
        CpsError err;
        copy_without_history(&turned, m);
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

static bool is_spun(const Mooring *m, int step, const double load[6]) {
    return is_spun_by_statics(m, load) || is_spun_by_step(m, step);
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
    for (int step = 0; sound && cps_evolution_remaining_count(evolution) > 0; step++) {
        if (cps_evolution_step(evolution, &err) != CPS_OK) exit(1);
        double load[6], known;
        load_after(&m, step, load);
        const CpsBodyReport at = cps_evolution_body_report(evolution, 0);
        tally->steps++;
        tally->trials += at.trial_count;
        if (at.trial_count > tally->most_trials) tally->most_trials = at.trial_count;
        sound = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
        if (!sound) {
            const bool spun = is_spun(&m, step, load);
            tally->spun += spun;
            tally->open += !spun;
            printf("seed %llu step %d: %s after %d trials\n", (unsigned long long)seed, step,
                   spun ? "turned round and round" : "open", at.trial_count);
            continue;
        }
        if (seed % ASKED == 0 && step > 0 && is_spun(&m, step, load)) {
            printf("seed %llu step %d: certified, and turned round and round\n",
                   (unsigned long long)seed, step);
            tally->wrong++;
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
