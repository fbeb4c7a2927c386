/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness (6, 6) of bodies, held and free, on random moorings.
 *                                    usage: random_body_stiffness [--moorings N] [--seed S]
 * [--seeds N]
 *
 * One or two bodies of any heel on three to seven lines of sections, with clumps, tables, springs,
 * friction that is the same in all directions or not: from the bed, from anchors above it, from
 * body to body, and with both ends on one body. They go by random moves; after the last one the
 * stiffness of the first body is compared with
 *
 *   step   the same move taken again from the saved state before it, to poses beside its own, all
 *          bodies held: what lines, weight, buoyancy and water lose;
 *   stick  a scene that begins where the lines now are, with three times the friction, so that all
 *          that touches is inside its bound, moved to these poses: what the lines lose;
 *   file   the independent checker's matrices of the file of the run, where it knows the states.
 *
 * Central differences by two distances, extrapolated, are the stiffness where no node changes its
 * state between them and the two agree. Moorings are drawn until so many have been compared with
 * both, and of these a given share must lie, slip and heel. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "body_stiffness.h"
#include "capstan/evolve.h"
#include "capstan/results.h"
#include "dice.h"

enum { BODIES = 2, LINES = 9, SECTIONS = 2, ELEMENTS = 40, MOVES = 4, ENTRIES = 36 };

/* Differences from the lines' part of the matrix, per size of it, lengths in arms of the body:
 * forces of a step are known to 1e-11 of the largest one, and the distances are 1e-5 of the size.
 */
static const double AGREE = 1e-5;
/* ... of differences whose own two distances agree so far. */
static const double SMOOTH = 2e-5;
static const double DISTANCE = 2e-5;
/* ... of steps whose gap is rounding: others are answers to the tolerance only. */
static const double ROUNDING = 1e-12;
/* From the checker's own, per largest entry: rounding of places far from the origin, which stiff
 * lines magnify. */
static const double OF_FILE = 1e-6;
/* Shares of the moorings compared, of which a fifth the checker must know. */
static const double GROUNDED = 0.3, SLIPPING = 0.3, HEELED = 0.1;
static const double HEEL = 10 / 57.29577951308232;

typedef struct Mooring {
    double size, arm;
    CpsObstacle bed;
    CpsLine line[LINES];
    CpsSection section[LINES][SECTIONS];
    CpsPointWeight clump[LINES];
    CpsStiffnessRow row[LINES][3];
    CpsFrictionZone zone[LINES];
    CpsSpring spring[LINES];
    CpsLineLoads loads[LINES];
    CpsPoint point[2 * LINES];
    CpsBody body[BODIES];
    char name[3 * LINES + BODIES][16];
    CpsBodyChange change[MOVES][BODIES];
    CpsStage stage[MOVES];
    CpsScene scene;
    bool has_loop;
} Mooring;

typedef struct Tally {
    int seeds, moorings, free, two, loops, springs, grounded, slipping, heeled, file[2];
    int open, changed[2], rough[2], outcome[2][8], not_finite, wrong; /* not compared */
    double worst[2], worst_of_file[2], largest_heel;
} Tally;

static char directory[] = "capstan-stiffness-XXXXXX";

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "%s: %s\n", err->where, err->message);
    exit(1);
}

/* the scene ------------------------------------------------------------------------------------ */

static void turn_by(const double v[3], const double q[4], double out[4]) {
    const double angle = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]), w = cos(angle / 2),
                 s = angle > 0 ? sin(angle / 2) / angle : 0.5;
    const double x = s * v[0], y = s * v[1], z = s * v[2];
    const double to[4] = {w * q[0] - x * q[1] - y * q[2] - z * q[3],
                          w * q[1] + x * q[0] + y * q[3] - z * q[2],
                          w * q[2] + y * q[0] + z * q[1] - x * q[3],
                          w * q[3] + z * q[0] + x * q[2] - y * q[1]};
    memcpy(out, to, sizeof to);
}

static void to_scene(const double q[4], const double v[3], double out[3]) {
    const double t[3] = {2 * (q[2] * v[2] - q[3] * v[1]), 2 * (q[3] * v[0] - q[1] * v[2]),
                         2 * (q[1] * v[1] - q[2] * v[0])};
    out[0] = v[0] + q[0] * t[0] + q[2] * t[2] - q[3] * t[1];
    out[1] = v[1] + q[0] * t[1] + q[3] * t[0] - q[1] * t[2];
    out[2] = v[2] + q[0] * t[2] + q[1] * t[1] - q[2] * t[0];
}

/* A rotation that heels by up to `heel`, turned about z. */
static void make_rotation(double heel, double out[4]) {
    const double way = uniform(0, 6.2831853), by = uniform(0, heel);
    const double yaw[3] = {0, 0, uniform(-0.5, 0.5)}, tilt[3] = {by * cos(way), by * sin(way), 0};
    turn_by(yaw, (const double[4]){1, 0, 0, 0}, out);
    turn_by(tilt, out, out);
}

/* Free bodies need one coefficient. */
static void make_bed(Mooring *m, bool is_free) {
    m->bed = cps_obstacle_default();
    m->bed.name = "bed";
    m->bed.friction = chance(0.15) ? 0 : uniform(0.1, 1.2);
    if (chance(0.2)) {
        m->bed.normal[0] = uniform(-0.02, 0.02);
        m->bed.normal[1] = uniform(-0.02, 0.02);
    }
    if (!is_free && chance(0.4)) {
        m->bed.has_friction_lateral = true;
        m->bed.friction_lateral = uniform(0.1, 1.2);
        m->bed.grain[0] = 1;
    }
}

static void make_body(Mooring *m, int k, double weight) {
    CpsBody *b = &m->body[k];
    *b = cps_body_default();
    b->name = m->name[3 * LINES + k];
    b->kind = chance(0.5) ? CPS_BODY_KIND_FREE : CPS_BODY_KIND_HELD;
    for (int a = 0; a < 2; a++) b->position[a] = uniform(-0.05, 0.05) * m->size;
    b->position[0] += 0.8 * k * m->size;
    b->position[2] = m->size * uniform(0.5, 0.8);
    make_rotation(0.3, b->rotation);
    b->weight = weight * uniform(2, 8);
    b->buoyancy = b->weight + weight * uniform(2, 6);
    for (int a = 0; a < 3; a++) b->centre_of_gravity[a] = m->arm * uniform(-0.2, 0.2);
    b->centre_of_gravity[2] -= m->arm * uniform(0, 1);
    b->centre_of_buoyancy[2] = m->arm * uniform(0, 0.5);
    b->hydrostatics[14] = b->weight / m->size * uniform(2, 6);
    b->hydrostatics[21] = b->hydrostatics[28] = b->weight * m->arm * uniform(0.2, 2);
}

/* Where end `end` of a line begins: at a place, or on a body in its first pose. */
static void place_of(const Mooring *m, const CpsPoint *point, double out[3]) {
    memcpy(out, point->position, 3 * sizeof *out);
    if (point->kind != CPS_POINT_KIND_ON_BODY) return;
    const CpsBody *body = &m->body[point->body];
    to_scene(body->rotation, point->position, out);
    for (int a = 0; a < 3; a++) out[a] += body->position[a];
}

static void make_point(Mooring *m, int k, int body, double turn, double out, double z) {
    CpsPoint *point = &m->point[k];
    *point = cps_point_default();
    point->name = m->name[LINES + k];
    if (body >= 0) point->kind = CPS_POINT_KIND_ON_BODY;
    if (body >= 0) point->body = body;
    point->position[0] = out * cos(turn);
    point->position[1] = out * sin(turn);
    point->position[2] = z;
}

/* What a line is made of: its length and weight are given. */
static void make_matter(Mooring *m, int i, double weight) {
    CpsLine *line = &m->line[i];
    line->stiffness = chance(0.1) ? INFINITY : weight * pow(10, uniform(1.5, 4));
    line->element_count = whole(8, ELEMENTS);
    const double clump = line->length / line->element_count * whole(2, line->element_count - 2);
    if (chance(0.3)) {
        m->clump[i] = (CpsPointWeight){.arc_length = clump, .weight = weight * uniform(0, 0.2)};
        line->point_weight_count = 1;
        line->point_weight = &m->clump[i];
    }
    if (chance(0.3)) {
        line->section_count = SECTIONS;
        line->section = m->section[i];
        for (int k = 0; k < SECTIONS; k++) {
            CpsSection *section = &m->section[i][k];
            *section = (CpsSection){.length = k ? line->length - clump : clump};
            section->weight = line->weight * uniform(0.4, 1.5);
            section->stiffness = line->stiffness * uniform(0.4, 1.5);
        }
    } else if (isfinite(line->stiffness) && chance(0.25)) {
        for (int k = 1; k < 3; k++)
            m->row[i][k] = (CpsStiffnessRow){k * 1e-3, k * k * 1e-3 * line->stiffness};
        line->stiffness_row_count = 3;
        line->stiffness_row = m->row[i];
        line->stiffness = 0;
    }
    if (chance(0.2)) {
        m->zone[i] = (CpsFrictionZone){.to = line->length * uniform(0.2, 0.5)};
        m->zone[i].factor = uniform(0, 2);
        line->zone_count = 1;
        line->zone = &m->zone[i];
    }
    if (chance(0.1)) {
        m->spring[i] = (CpsSpring){.to = line->length};
        for (int a = 0; a < 3; a++) {
            m->spring[i].stiffness[a] = weight / m->size / line->length * uniform(0, 0.1);
            m->spring[i].place[a] = a < 2 ? 0 : m->size;
        }
        m->loads[i] = (CpsLineLoads){.spring_count = 1, .spring = &m->spring[i]};
        line->loads = &m->loads[i];
    }
}

/* From a body to the bed, to an anchor above it (i odd), to the other body, or to itself. */
static void make_line(Mooring *m, int i, int body, int other, double weight) {
    CpsLine *line = &m->line[i];
    const double turn = 2.4 * i + uniform(-0.4, 0.4);
    const bool lies = other < 0 && chance(0.85), loops = other == body;
    make_point(m, 2 * i, body, turn, m->arm, m->arm * uniform(-1, 1));
    if (other >= 0) {
        const double up = m->arm * uniform(-1, 1);
        make_point(m, 2 * i + 1, other, turn + uniform(2, 4), m->arm, up);
    } else {
        make_point(m, 2 * i + 1, -1, turn, uniform(0.8, 1.4) * m->size, 0);
        CpsPoint *anchor = &m->point[2 * i + 1];
        anchor->position[0] += m->body[body].position[0];
        if (!lies) anchor->position[2] = m->size * uniform(0.3, 1.5);
        if (lies)
            for (int a = 0; a < 2; a++)
                anchor->position[2] -= m->bed.normal[a] * anchor->position[a] / m->bed.normal[2];
    }
    double at[2][3], across = 0, straight = 0;
    for (int e = 0; e < 2; e++) place_of(m, &m->point[2 * i + e], at[e]);
    for (int a = 0; a < 3; a++) {
        across += a < 2 ? pow(at[1][a] - at[0][a], 2) : 0;
        straight += pow(at[1][a] - at[0][a], 2);
    }
    straight = sqrt(straight);
    *line = cps_line_default();
    line->name = m->name[i];
    line->length =
        lies ? straight + uniform(0.3, 0.8) * (sqrt(across) + fabs(at[0][2] - at[1][2]) - straight)
             : straight * (loops ? uniform(1.1, 3) : uniform(1.01, 1.15));
    line->weight = weight / m->size * uniform(0.3, 1) * (lies ? 3 : 1);
    make_matter(m, i, weight);
    line->start.kind = CPS_START_STATIC;
    const int first = chance(0.5);
    for (int e = 0; e < 2; e++) {
        line->end[e].kind = CPS_END_KIND_POINT;
        line->end_point[e] = 2 * i + (e == first);
    }
    m->has_loop = m->has_loop || (loops && body == 0);
}

static void make_stages(Mooring *m, double weight) {
    const int moves = whole(1, MOVES);
    for (int s = 0; s < moves; s++) {
        m->stage[s] = cps_stage_default();
        m->stage[s].name = "stage";
        m->stage[s].body_change_count = m->scene.body_count;
        m->stage[s].body_change = m->change[s];
        for (int k = 0; k < m->scene.body_count; k++) {
            CpsBodyChange *change = &m->change[s][k];
            const CpsBody *b = &m->body[k];
            *change = (CpsBodyChange){.body = k, .kind = b->kind};
            for (int a = 0; a < 3; a++) {
                change->position[a] = b->position[a] + uniform(-0.04, 0.04) * m->size;
                change->force[a] = weight * uniform(-1, 1) * (a < 2 ? 1 : 0.3);
                change->moment[a] = weight * m->arm * uniform(-2, 2);
            }
            make_rotation(0.6, change->rotation);
        }
    }
    m->scene.stage_count = moves;
    m->scene.stage = m->stage;
}

static void make(Mooring *m, uint64_t seed) {
    memset(m, 0, sizeof *m);
    state = 0x8cb92ba72f3d8dd7u * (seed + 1);
    for (int i = 0; i < 3 * LINES + BODIES; i++) snprintf(m->name[i], sizeof m->name[0], "n%d", i);
    m->scene = cps_scene_default();
    m->size = pow(10, uniform(0, 3));
    m->arm = m->size * pow(10, uniform(-1.7, -0.8));
    const double weight = pow(10, uniform(0, 4));
    const int bodies = chance(0.3) ? 2 : 1;
    int lines = whole(3, 6) + bodies - 1;
    bool is_free = false;
    for (int k = 0; k < bodies; k++) {
        make_body(m, k, weight);
        is_free = is_free || m->body[k].kind == CPS_BODY_KIND_FREE;
    }
    make_bed(m, is_free);
    for (int i = 0; i < lines; i++) make_line(m, i, i % bodies, -1, weight);
    if (bodies == 2) make_line(m, lines++, 0, 1, weight);
    if (chance(0.3)) make_line(m, lines++, 0, 0, weight);
    m->scene.obstacle_count = 1;
    m->scene.obstacle = &m->bed;
    m->scene.line_count = lines;
    m->scene.line = m->line;
    m->scene.point_count = 2 * lines;
    m->scene.point = m->point;
    m->scene.body_count = bodies;
    m->scene.body = m->body;
    m->scene.solver.max_halvings = 0; /* the step is one substep, or it is not compared */
    make_stages(m, weight);
}

/* differences ---------------------------------------------------------------------------------- */

/* What must stay the same for the forces to be smooth. */
typedef struct Contacts {
    unsigned char state[LINES][ELEMENTS + 1], taut[LINES][ELEMENTS];
} Contacts;

static Contacts contacts_of(const CpsEvolution *evolution) {
    Contacts out = {0};
    for (int i = 0; i < cps_evolution_line_count(evolution); i++) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        memcpy(out.state[i], view.state, (size_t)view.element_count + 1);
        for (int e = 0; e < view.element_count; e++) out.taut[i][e] = view.tension[e] > 0;
    }
    return out;
}

/* Solved to rounding, in one substep. */
static bool is_clean(const CpsEvolution *evolution) {
    if (cps_evolution_report(evolution).outcome != CPS_OUTCOME_SOLVED) return false;
    for (int i = 0; i < cps_evolution_line_count(evolution); i++) {
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        if (report.outcome != CPS_OUTCOME_SOLVED || report.substep_count != 1 ||
            !(report.certificate.gap <= ROUNDING * report.certificate.scale))
            return false;
    }
    return true;
}

/* Where displaced steps begin, and the poses beside which they end. */
typedef struct Origin {
    CpsEvolution *evolution;
    void *saved;
    size_t size;
    CpsBodyChange pose[BODIES];
    int bodies;
} Origin;

/* What the lines, and all loads together, do to the first body, displaced by `by` in direction d.
 */
static bool forces_at(const Origin *from, int d, double by, const Contacts *same, double lines[6],
                      double all[6]) {
    CpsError err;
    CpsBodyChange to[BODIES];
    memcpy(to, from->pose, sizeof to);
    if (d < 3) {
        to[0].position[d] += by;
    } else {
        double turn[3] = {0};
        turn[d - 3] = by;
        turn_by(turn, to[0].rotation, to[0].rotation);
    }
    CpsStage move = cps_stage_default();
    move.body_change_count = from->bodies;
    move.body_change = to;
    need(cps_evolution_load(from->evolution, from->saved, from->size, &err), &err);
    need(cps_evolution_move(from->evolution, &move, &err), &err);
    const CpsBodyReport report = cps_evolution_body_report(from->evolution, 0);
    const Contacts now = contacts_of(from->evolution);
    for (int a = 0; a < 6; a++) {
        lines[a] = report.lines[a];
        all[a] = report.lines[a] + report.load[a];
    }
    return is_clean(from->evolution) && memcmp(&now, same, sizeof now) == 0;
}

/* The stiffnesses by differences, of the lines and of all; false: a state changes. *rough: how far
 * two distances differ for the lines. Rows and columns of rotations are in arms. */
static bool differences(const Mooring *m, const Origin *from, const Contacts *same,
                        double of_lines[ENTRIES], double of_all[ENTRIES], double *rough) {
    *rough = 0;
    for (int d = 0; d < 6; d++) {
        double lines[4][6], all[4][6];
        const double h = DISTANCE * m->size / (d < 3 ? 1 : m->arm);
        for (int i = 0; i < 4; i++)
            if (!forces_at(from, d, h * (i % 2 ? -1 : 1) / (i / 2 ? 2 : 1), same, lines[i], all[i]))
                return false;
        for (int b = 0; b < 6; b++) {
            const double unit = (d < 3 ? 1 : m->arm) * (b < 3 ? 1 : m->arm),
                         far = (lines[1][b] - lines[0][b]) / (2 * h * unit),
                         near = (lines[3][b] - lines[2][b]) / (h * unit),
                         far_all = (all[1][b] - all[0][b]) / (2 * h * unit),
                         near_all = (all[3][b] - all[2][b]) / (h * unit);
            of_lines[6 * b + d] = near + (near - far) / 3;
            of_all[6 * b + d] = near_all + (near_all - far_all) / 3;
            *rough = fmax(*rough, fabs(near - far));
        }
    }
    return true;
}

static double size_of(const double k[ENTRIES]) {
    double sum = 0;
    for (int i = 0; i < ENTRIES; i++) sum += k[i] * k[i];
    return sqrt(sum);
}

/* The largest difference from the expected matrix, which is in arms, per size. */
static double error_of(const Mooring *m, const double matrix[ENTRIES], const double k[ENTRIES],
                       double size) {
    double most = 0;
    for (int i = 0; i < ENTRIES; i++) {
        const double unit = (i / 6 < 3 ? 1 : m->arm) * (i % 6 < 3 ? 1 : m->arm);
        most = fmax(most, fabs(matrix[i] / unit - k[i]) / size);
    }
    return most;
}

static void save(Origin *origin) {
    origin->size = cps_evolution_state_size(origin->evolution);
    if (!origin->saved) origin->saved = malloc(origin->size);
    if (!origin->saved) exit(1);
    cps_evolution_save(origin->evolution, origin->saved);
}

static void hold(Origin *origin, const CpsEvolution *at) {
    origin->bodies = cps_evolution_body_count(at);
    for (int k = 0; k < origin->bodies; k++) {
        const CpsBodyReport report = cps_evolution_body_report(at, k);
        origin->pose[k] = (CpsBodyChange){.body = k, .kind = CPS_BODY_KIND_HELD};
        memcpy(origin->pose[k].position, report.position, sizeof report.position);
        memcpy(origin->pose[k].rotation, report.rotation, sizeof report.rotation);
    }
}

/* The lines where they are, as the start of a scene in which all that touches sticks. */
static CpsEvolution *stuck(const Mooring *m, const CpsEvolution *now, const Origin *at) {
    static double point[LINES][3 * (ELEMENTS + 1)], tension[LINES][ELEMENTS];
    static Mooring n;
    CpsError err;
    CpsEvolution *out = NULL;
    n = *m;
    n.bed.friction *= 3;
    n.bed.friction_lateral *= 3;
    n.scene.obstacle = &n.bed;
    n.scene.line = n.line;
    n.scene.body = n.body;
    n.scene.stage_count = 0;
    for (int i = 0; i < n.scene.line_count; i++) {
        const CpsLineView view = cps_evolution_line_view(now, i);
        const size_t elements = (size_t)view.element_count;
        memcpy(point[i], view.position, 3 * (elements + 1) * sizeof *point[i]);
        memcpy(tension[i], view.tension, elements * sizeof *tension[i]);
        n.line[i].start = (CpsStart){.kind = CPS_START_NODES,
                                     .point_count = view.element_count + 1,
                                     .point = point[i],
                                     .tension = tension[i]};
    }
    for (int k = 0; k < n.scene.body_count; k++) {
        n.body[k].kind = CPS_BODY_KIND_HELD;
        memcpy(n.body[k].position, at->pose[k].position, sizeof n.body[k].position);
        memcpy(n.body[k].rotation, at->pose[k].rotation, sizeof n.body[k].rotation);
    }
    need(cps_evolution_create(&n.scene, &out, &err), &err);
    return out;
}

/* comparison ----------------------------------------------------------------------------------- */

/* The matrices of one kind: found, and by differences of all and of the lines. */
typedef struct Found {
    CpsBodyStiffness said;
    double all[ENTRIES], lines[ENTRIES];
} Found;

static void compare(const Mooring *m, const Found *found, CpsStiffnessKind kind, uint64_t seed,
                    Tally *tally) {
    const double error = error_of(m, found->said.matrix, found->all, size_of(found->lines));
    tally->worst[kind] = fmax(tally->worst[kind], error);
    if (error <= AGREE) return;
    fprintf(stderr, "seed %llu, %s: differs by %.2g\n", (unsigned long long)seed,
            cps_stiffness_name(kind), error);
    tally->wrong++;
}

/* Is there a matrix by differences, of a step that ends at these poses with these contacts? */
static bool find_differences(const Mooring *m, const Origin *from, const Contacts *same,
                             CpsStiffnessKind kind, Found *found, Tally *tally) {
    double rough;
    const bool smooth = differences(m, from, same, found->lines, found->all, &rough);
    tally->changed[kind] += !smooth;
    if (!smooth) return false;
    const bool near = rough <= SMOOTH * size_of(found->lines);
    tally->rough[kind] += !near;
    return near;
}

static void note(const Mooring *m, const CpsEvolution *evolution, Tally *tally) {
    bool grounded = false, slipping = false, springs = false;
    const CpsBodyReport body = cps_evolution_body_report(evolution, 0);
    double angles[3], heel;
    cps_body_angles(&body, angles, &heel);
    for (int i = 0; i < m->scene.line_count; i++) {
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        const bool is_on = m->point[2 * i].body == 0 || m->point[2 * i + 1].body == 0;
        grounded = grounded || (is_on && report.grounded > 0);
        slipping = slipping || (is_on && report.slipping > 0);
        springs = springs || m->line[i].loads;
    }
    tally->moorings++;
    tally->free += body.kind == CPS_BODY_KIND_FREE;
    tally->two += m->scene.body_count == 2;
    tally->loops += m->has_loop;
    tally->springs += springs;
    tally->grounded += grounded;
    tally->slipping += slipping;
    tally->heeled += heel > HEEL;
    tally->largest_heel = fmax(tally->largest_heel, heel);
}

/* Both matrices against the checker's of the file, at its last step. */
static void compare_file(const Mooring *m, const Found found[2], uint64_t seed, Tally *tally) {
    char path[64];
    Source source;
    Bodies bodies;
    Record line[LINES] = {{0}};
    BodyState at[BODIES];
    snprintf(path, sizeof path, "%s/result.nc", directory);
    if (source_open(path, &source, stderr) || bodies_open(&source, &bodies, stderr)) exit(1);
    const size_t step = (size_t)m->scene.stage_count; /* that of the start is the first */
    if (bodies_read(&source, &bodies, step, at, stderr)) exit(1);
    for (size_t i = 0; i < source.lines; i++)
        if (record_create(&source, source.line_name[i], &line[i], stderr) ||
            record_read(&source, source.line_name[i], step, &line[i], stderr))
            exit(1);
    for (int kind = 0; kind < 2; kind++) {
        const StiffnessStep of = {&source, &bodies, line, (const double[3]){0, 0, -1}, step, kind};
        Real own[ENTRIES];
        double k[ENTRIES], size = 0;
        if (!body_stiffness(&of, 0, &at[0], m->arm, own)) continue;
        for (int i = 0; i < ENTRIES; i++) {
            k[i] = (double)own[i] / (i / 6 < 3 ? 1 : m->arm) / (i % 6 < 3 ? 1 : m->arm);
            size = fmax(size, fabs(k[i]));
        }
        const double error = error_of(m, found[kind].said.matrix, k, size);
        tally->file[kind]++;
        tally->worst_of_file[kind] = fmax(tally->worst_of_file[kind], error);
        if (error <= OF_FILE) continue;
        fprintf(stderr, "seed %llu, %s: differs from the checker's by %.2g\n",
                (unsigned long long)seed, cps_stiffness_name((CpsStiffnessKind)kind), error);
        tally->wrong++;
    }
    for (size_t i = 0; i < source.lines; i++) record_destroy(&line[i]);
    bodies_close(&bodies);
    source_close(&source);
}

/* What the lines lose where all that touches sticks, with what the step has found of the rest. */
static bool find_stuck(const Mooring *m, const Origin *of_step, const CpsEvolution *now,
                       Found found[2], Tally *tally) {
    Origin rest = *of_step;
    CpsError err;
    double lines[6], all[6];
    rest.evolution = stuck(m, now, of_step);
    rest.saved = NULL;
    need(cps_evolution_step(rest.evolution, &err), &err);
    save(&rest);
    const Contacts unused = {0};
    forces_at(&rest, 0, 0, &unused, lines, all);
    const Contacts sticking = contacts_of(rest.evolution);
    const bool known = find_differences(m, &rest, &sticking, CPS_STIFFNESS_STICK, &found[1], tally);
    for (int i = 0; i < ENTRIES; i++)
        found[1].all[i] = found[1].lines[i] + found[0].all[i] - found[0].lines[i];
    cps_evolution_destroy(rest.evolution);
    free(rest.saved);
    return known;
}

static bool all_finite(const CpsBodyStiffness *k) {
    for (int i = 0; i < ENTRIES; i++)
        if (!isfinite(k->matrix[i]) || !isfinite(k->smooth[i])) return false;
    return true;
}

/* Take the history, with its results beside it; false: a step is not solved to rounding. */
static bool take_history(const Mooring *m, Origin *origin) {
    CpsError err;
    CpsResults *results = NULL;
    CpsResultsOptions options = cps_results_options_default();
    options.no_paraview = options.sync_at_end = true;
    need(cps_results_prepare(directory, CPS_RESULTS_KIND_RUN, 0, true, &err), &err);
    need(cps_results_open(directory, &m->scene, origin->evolution, &options, &results, &err), &err);
    while (cps_evolution_remaining_count(origin->evolution) > 0) {
        save(origin);
        need(cps_evolution_step(origin->evolution, &err), &err);
        need(cps_results_append(results, origin->evolution, &err), &err);
    }
    need(cps_results_finish(results, 0, &err), &err);
    cps_results_destroy(results);
    hold(origin, origin->evolution);
    return is_clean(origin->evolution);
}

/* The matrices that are found, of all bodies finite whatever the step; false: not both of the first
 * one. */
static bool find_matrices(const CpsEvolution *evolution, Found found[2], Tally *tally) {
    CpsError err;
    bool both = true;
    for (int kind = 0; kind < 2; kind++)
        for (int k = 0; k < cps_evolution_body_count(evolution); k++) {
            CpsBodyStiffness said;
            need(cps_evolution_body_stiffness(evolution, k, (CpsStiffnessKind)kind, &said, &err),
                 &err);
            tally->not_finite += !all_finite(&said);
            if (k > 0) continue;
            found[kind].said = said;
            tally->outcome[kind][said.outcome]++;
            both = both && said.outcome == CPS_STIFFNESS_OUTCOME_FOUND;
        }
    return both;
}

static void try_mooring(uint64_t seed, Tally *tally) {
    static Mooring m;
    CpsError err;
    Found found[2];
    Origin now = {NULL};
    make(&m, seed);
    tally->seeds++;
    need(cps_evolution_create(&m.scene, &now.evolution, &err), &err);
    const bool clean = take_history(&m, &now);
    const bool both = find_matrices(now.evolution, found, tally);
    tally->open += !clean;
    Origin beside = now; /* the displaced steps are those of another evolution */
    need(cps_evolution_create(&m.scene, &beside.evolution, &err), &err);
    const Contacts same = contacts_of(now.evolution);
    if (clean && both &&
        find_differences(&m, &beside, &same, CPS_STIFFNESS_STEP, &found[0], tally) &&
        find_stuck(&m, &beside, now.evolution, found, tally)) {
        note(&m, now.evolution, tally);
        for (int k = 0; k < 2; k++) compare(&m, &found[k], (CpsStiffnessKind)k, seed, tally);
        compare_file(&m, found, seed, tally);
    }
    cps_evolution_destroy(beside.evolution);
    cps_evolution_destroy(now.evolution);
    free(now.saved);
}

static bool print(const Tally *t, int moorings) {
    printf("%d moorings compared of %d drawn: %d of a free body, %d of two bodies, %d with a line "
           "from the body to itself, %d with springs; %d grounded, %d slip, %d heel beyond 10 "
           "degrees, up to %.1f\n",
           t->moorings, t->seeds, t->free, t->two, t->loops, t->springs, t->grounded, t->slipping,
           t->heeled, t->largest_heel * 57.29577951308232);
    printf("%d not solved to rounding in one substep", t->open);
    for (int k = 0; k < 2; k++) {
        const CpsStiffnessKind kind = (CpsStiffnessKind)k;
        printf("\n%-5s: largest difference %.2g, from the checker's %.2g in %d; %d with another "
               "state beside, %d rough",
               cps_stiffness_name(kind), t->worst[k], t->worst_of_file[k], t->file[k],
               t->changed[k], t->rough[k]);
        for (int o = 1; o < 5; o++)
            printf(", %d %s", t->outcome[k][o], cps_stiffness_outcome_name((CpsStiffnessOutcome)o));
    }
    printf("\n%d not finite, %d wrong\n", t->not_finite, t->wrong);
    return t->wrong == 0 && t->not_finite == 0 && t->moorings >= moorings &&
           t->grounded >= GROUNDED * t->moorings && t->slipping >= SLIPPING * t->moorings &&
           t->heeled >= HEELED * t->moorings && 5 * t->file[0] >= t->moorings &&
           5 * t->file[1] >= t->moorings && 10 * t->loops >= t->moorings;
}

int main(int argc, char **argv) {
    int moorings = 100, seeds = 0;
    uint64_t seed = 0;
    Tally t = {0};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--moorings") == 0) moorings = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) seed = strtoull(argv[i + 1], NULL, 10);
        if (strcmp(argv[i], "--seeds") == 0) seeds = atoi(argv[i + 1]);
    }
    if (!mkdtemp(directory)) return 1;
    for (; t.moorings < moorings && t.seeds < (seeds ? seeds : 4 * moorings); seed++)
        try_mooring(seed, &t);
    const bool sound = print(&t, moorings);
    char command[64];
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    return system(command) != 0 || !sound;
}
