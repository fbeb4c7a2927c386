/* SPDX-License-Identifier: BSD-3-Clause */
/* The stiffness of an end against steps to places beside it.
 *                                            usage: random_stiffness [--scenes N] [--seed S]
 *
 * Random mooring lines, on a bed or a slope, over a pipe on it, round a post or over a ball,
 * elastic or not, uniform or in two sections, with friction that is the same in all directions or
 * not, differs along the line, or is of a set, go by random moves of their upper end. After the
 * last one:
 *
 *   step   the same move is taken again from the saved state before it, to targets beside its own;
 *   stick  a scene that begins where the line now is, with three times the friction, so that all of
 * it is inside its bound, is moved by as much.
 *
 * The central differences of the forces, by two distances and extrapolated, are the stiffness where
 * no node and no element changes its state between them; otherwise both one-sided differences exist
 * and nothing is compared. Where an element touches between its nodes there must be no matrix. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "splitmix.h"

enum { ELEMENTS = 60, MOVES = 4, CORNERS = 6, STATES = 4 * (ELEMENTS + 1) };

/* The largest difference, per size of the matrix: the forces of a step are known to 1e-11 of the
 * largest one, and the distances are 1e-5 of the line. One in a hundred may differ by up to FEW: a
 * node that has slid by less than CPS_TOUCH counts as at rest, and may go on to slide. */
static const double AGREE = 1e-5, FEW = 1e-4;
/* ... of differences whose own two distances agree so far. */
static const double SMOOTH = 2e-5;
static const double DISTANCE = 2e-5;
/* ... of steps whose gap is rounding: others are answers to the tolerance only. */
static const double ROUNDING = 1e-12;

typedef enum Ground { BED, SLOPE, PIPE, POST, BALL, GROUNDS } Ground;

typedef struct Mooring {
    Ground ground;
    CpsObstacle obstacle[2];
    CpsSet *friction_set; /* of the bed; NULL: none */
    CpsLine line;
    CpsSection section[2];
    CpsFrictionZone zone[2];
    double point[3 * (ELEMENTS + 1)];
    CpsScene scene;
    int end;     /* that moves, and whose stiffness is compared */
    CpsEnd last; /* the target of the last move */
} Mooring;

typedef struct Tally {
    int lines, left_out, beyond, compared[2], changed[2], rough[2], grounded, sliding, sets,
        elements, outcome[2][8];
    double largest[2];
    int failures;
} Tally;

static uint64_t state;

static double uniform(double low, double high) { return splitmix(&state, low, high); }

/* the scene ------------------------------------------------------------------------------------ */

static void need(CpsStatus status, const CpsError *err) {
    if (status == CPS_OK) return;
    fprintf(stderr, "%s\n", err->message);
    exit(1);
}

/* A polygon of two to six corners round 0 (a segment through it, of two), or beside it: then 0 is
 * one of them. */
static CpsSet *make_set(void) {
    const int corners = 2 + (int)uniform(0, CORNERS - 1);
    const double first = uniform(0, 6.2831853);
    double point[2 * CORNERS];
    for (int k = 0; k < corners; k++) {
        const double size = uniform(0.05, 1.2), shift = corners > 2 ? uniform(-0.2, 0.2) : 0,
                     angle = first + 6.283185307179586 * (k + shift) / corners;
        point[2 * k] = size * cos(angle);
        point[2 * k + 1] = size * sin(angle);
    }
    if (uniform(0, 1) < 0.15) point[0] = point[1] = 0;
    CpsSet *out = NULL;
    CpsError err;
    need(cps_set_hull_of_points(2, corners, point, &out, &err), &err);
    return out;
}

static void make_ground(Mooring *m) {
    const bool round = m->ground >= PIPE;
    for (int k = 0; k < 2; k++) m->obstacle[k] = cps_obstacle_default();
    CpsObstacle *bed = &m->obstacle[0], *other = &m->obstacle[1];
    bed->name = "bed";
    bed->friction = uniform(0, 1) < 0.15 ? 0 : uniform(0.05, 1.2);
    if (m->ground == SLOPE) { /* it does not reach the fairlead */
        bed->normal[0] = uniform(-0.05, 0.2);
        bed->normal[1] = uniform(-0.2, 0.2);
    }
    if (m->ground <= SLOPE && uniform(0, 1) < 0.4) {
        bed->has_friction_lateral = true;
        bed->friction_lateral = uniform(0.05, 1.2);
        if (uniform(0, 1) < 0.5) bed->grain[0] = 1;
    } else if (uniform(0, 1) < 0.2) {
        bed->friction = 0;
        bed->friction_set = m->friction_set = make_set();
        if (uniform(0, 1) < 0.7) bed->grain[0] = 1;
    }
    other->name = "other";
    other->kind = m->ground == BALL ? CPS_OBSTACLE_SPHERE : CPS_OBSTACLE_CYLINDER;
    other->radius = uniform(0, 1) < 0.3 ? uniform(0.2, 2) : uniform(4, 20);
    other->friction = uniform(0.05, 0.6);
    other->axis[1] = m->ground == POST ? 0 : 1;
    other->axis[2] = m->ground == POST ? 1 : 0;
    if (uniform(0, 1) < 0.2) {
        other->has_friction_lateral = true;
        other->friction_lateral = uniform(0.05, 0.6);
        for (int a = 0; a < 3; a++) other->grain[a] = uniform(-1, 1);
    }
    other->point[0] = uniform(30, 50);
    other->point[1] = m->ground == POST ? -other->radius : 0;
    other->point[2] = m->ground == POST ? 0 : uniform(-0.9, 0.2) * other->radius;
    m->scene.obstacle_count = round ? 2 : 1;
    m->scene.obstacle = m->obstacle;
}

/* A line of 100 m from an anchor on the bed to a fairlead above it, by statics. */
static void make_line(Mooring *m) {
    CpsLine *line = &m->line;
    *line = cps_line_default();
    line->name = "mooring";
    line->length = 100;
    line->element_count = ELEMENTS;
    line->weight = uniform(50, 500);
    const double tension = line->weight * line->length;
    line->stiffness = uniform(0, 1) < 0.15 ? INFINITY : tension * pow(10, uniform(0.5, 5));
    if (uniform(0, 1) < 0.3) {
        const double first = line->length / ELEMENTS * floor(uniform(10, ELEMENTS - 10));
        for (int k = 0; k < 2; k++) {
            m->section[k] = (CpsSection){.length = k ? line->length - first : first};
            m->section[k].weight = line->weight * uniform(0.3, 2);
            m->section[k].stiffness = line->stiffness * uniform(0.3, 2);
        }
        line->section_count = 2;
        line->section = m->section;
    }
    if (uniform(0, 1) < 0.2) { /* without friction, and with more of it */
        m->zone[0] = (CpsFrictionZone){.from = uniform(5, 20)};
        m->zone[0].to = uniform(20, 35);
        m->zone[1] = (CpsFrictionZone){.from = 40, .to = 70, .factor = uniform(0.5, 2)};
        line->zone_count = 2;
        line->zone = m->zone;
    }
    line->start.kind = CPS_START_STATIC;
    const double depth = uniform(10, 40), reach = uniform(0.75, 0.98) * sqrt(1e4 - depth * depth);
    line->end[CPS_END_A] = (CpsEnd){CPS_END_KIND_HELD, {0, 0, 0.05}};
    line->end[CPS_END_B] = (CpsEnd){CPS_END_KIND_HELD, {reach, uniform(-1, 1), depth}};
}

static void make_mooring(uint64_t seed, Mooring *m) {
    state = seed;
    *m = (Mooring){.ground = (Ground)(seed % GROUNDS),
                   .scene = cps_scene_default(),
                   .end = CPS_END_B};
    make_ground(m);
    make_line(m);
    if (uniform(0, 1) < 0.3) { /* both ends are above the ground, and the other one moves */
        m->end = CPS_END_A;
        m->line.end[CPS_END_A].value[2] = 6;
    }
    m->scene.line_count = 1;
    m->scene.line = &m->line;
    if (uniform(0, 1) < 0.3) m->scene.friction_policy = CPS_FRICTION_POLICY_FROZEN;
    if (uniform(0, 1) < 0.2) m->scene.contact_policy = CPS_CONTACT_POLICY_REFERENCE;
    if (uniform(0, 1) < 0.01) m->scene.solver.linear_system = CPS_LINEAR_SYSTEM_DENSE;
    m->scene.solver.max_halvings = 0; /* the step is one substep, or it is not compared */
}

static CpsEvolution *prepare(const CpsScene *scene) {
    CpsEvolution *out = NULL;
    CpsError err;
    need(cps_evolution_create(scene, &out, &err), &err);
    return out;
}

static bool is_solved(const CpsEvolution *evolution) {
    return cps_evolution_report(evolution).outcome == CPS_OUTCOME_SOLVED;
}

static CpsStatus go_to(CpsEvolution *evolution, int end, const CpsEnd *to, CpsError *err) {
    const CpsChange change = {.line = 0, .end = end, .to = *to};
    CpsStage move = cps_stage_default();
    move.change_count = 1;
    move.change = &change;
    return cps_evolution_move(evolution, &move, err);
}

/* differences ---------------------------------------------------------------------------------- */

/* What must stay the same for the force to be smooth. */
typedef struct Contacts {
    unsigned char state[STATES], taut[ELEMENTS];
} Contacts;

static Contacts contacts_of(const CpsEvolution *evolution) {
    Contacts out = {0};
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    const size_t n = (size_t)view.element_count + 1, nodes = n * (size_t)view.contact_count;
    memcpy(out.state, view.state, nodes);
    if (view.has_element_contacts) memcpy(out.state + nodes, view.element_state, n - 1);
    for (size_t e = 0; e + 1 < n; e++) out.taut[e] = view.tension[e] > 0;
    return out;
}

/* Where the displaced steps begin: a state of an evolution. */
typedef struct Origin {
    CpsEvolution *evolution;
    void *saved;
    size_t size;
    int end;
    CpsEnd to;
} Origin;

/* The force at the end by the step to the target displaced by `by` along axis a. */
static bool force_at(const Origin *from, int a, double by, const Contacts *same, double force[3]) {
    CpsEnd to = from->to;
    to.value[a] += by;
    if (cps_evolution_load(from->evolution, from->saved, from->size, NULL) != CPS_OK) exit(1);
    if (go_to(from->evolution, from->end, &to, NULL) != CPS_OK) return false;
    const CpsLineReport report = cps_evolution_line_report(from->evolution, 0);
    const Contacts now = contacts_of(from->evolution);
    memcpy(force, report.end[from->end].force, sizeof report.end[from->end].force);
    return report.outcome == CPS_OUTCOME_SOLVED && report.substep_count == 1 &&
           memcmp(&now, same, sizeof now) == 0;
}

/* The stiffness by differences; false: a state changes. *rough: how far two distances differ. */
static bool differences(const Origin *from, const Contacts *same, double k[9], double *rough) {
    *rough = 0;
    for (int a = 0; a < 3; a++) {
        double force[4][3];
        for (int i = 0; i < 4; i++) {
            const double by = DISTANCE * 100 * (i % 2 ? -1 : 1) / (i / 2 ? 2 : 1);
            if (!force_at(from, a, by, same, force[i])) return false;
        }
        for (int b = 0; b < 3; b++) {
            const double far = (force[0][b] - force[1][b]) / (200 * DISTANCE),
                         near = (force[2][b] - force[3][b]) / (100 * DISTANCE);
            k[3 * b + a] = near + (near - far) / 3;
            *rough = fmax(*rough, fabs(near - far));
        }
    }
    return true;
}

static double size_of(const double k[9]) {
    double sum = 0;
    for (int i = 0; i < 9; i++) sum += k[i] * k[i];
    return sqrt(sum);
}

static void compare(const Origin *from, const Contacts *same, CpsStiffnessKind kind,
                    const CpsStiffness *found, uint64_t seed, Tally *tally) {
    double k[9], rough, error = 0;
    tally->outcome[kind][found->outcome]++;
    if (found->outcome != CPS_STIFFNESS_OUTCOME_FOUND) return;
    if (!differences(from, same, k, &rough)) {
        tally->changed[kind]++;
        return;
    }
    const double size = size_of(k);
    if (!(rough <= SMOOTH * size)) {
        tally->rough[kind]++;
        return;
    }
    tally->compared[kind]++;
    for (int i = 0; i < 9; i++) error = fmax(error, fabs(k[i] - found->matrix[i]) / size);
    tally->largest[kind] = fmax(tally->largest[kind], error);
    if (error <= AGREE) return;
    tally->beyond++;
    if (error <= FEW) return;
    tally->failures++;
    fprintf(stderr, "seed %llu, ground %d, %s: differs by %.2g\n", (unsigned long long)seed,
            (int)(seed % GROUNDS), cps_stiffness_name(kind), error);
    for (int b = 0; b < 3; b++)
        fprintf(stderr, "   %12.6g %12.6g %12.6g   expected %12.6g %12.6g %12.6g\n",
                found->matrix[3 * b], found->matrix[3 * b + 1], found->matrix[3 * b + 2], k[3 * b],
                k[3 * b + 1], k[3 * b + 2]);
}

/* The saved state of an evolution, which the caller frees. */
static void *save(const CpsEvolution *evolution, size_t *size) {
    *size = cps_evolution_state_size(evolution);
    void *out = malloc(*size);
    if (!out) exit(1);
    cps_evolution_save(evolution, out);
    return out;
}

/* Has another evolution of the scene the same bits in the state of this one? */
static bool stays_when_loaded(const CpsScene *scene, const CpsEvolution *now, int end,
                              const CpsStiffness found[2]) {
    CpsEvolution *other = prepare(scene);
    size_t size;
    void *state_now = save(now, &size);
    bool same = cps_evolution_load(other, state_now, size, NULL) == CPS_OK;
    for (int k = 0; k < 2; k++) {
        CpsStiffness again;
        cps_evolution_stiffness(other, 0, end, (CpsStiffnessKind)k, &again, NULL);
        same = same && again.outcome == found[k].outcome &&
               memcmp(again.matrix, found[k].matrix, sizeof again.matrix) == 0;
    }
    free(state_now);
    cps_evolution_destroy(other);
    return same;
}

/* The line where it now is, as the start of a scene in which all that touches sticks. */
static CpsEvolution *stuck(Mooring *m, const CpsEvolution *now) {
    static double tension[ELEMENTS];
    const CpsLineView view = cps_evolution_line_view(now, 0);
    memcpy(m->point, view.position, sizeof m->point);
    memcpy(tension, view.tension, sizeof tension);
    m->line.start = (CpsStart){.kind = CPS_START_NODES,
                               .point_count = ELEMENTS + 1,
                               .point = m->point,
                               .tension = tension};
    m->line.end[m->end] = m->last;
    for (int k = 0; k < m->scene.obstacle_count; k++) {
        m->obstacle[k].friction *= 3;
        m->obstacle[k].friction_lateral *= 3;
    }
    if (m->friction_set) {
        CpsSet *larger;
        CpsError err;
        need(cps_set_scale(3, m->friction_set, &larger, &err), &err);
        cps_set_release(m->friction_set);
        m->obstacle[0].friction_set = m->friction_set = larger;
    }
    return prepare(&m->scene);
}

static bool elements_touch(const CpsEvolution *evolution) {
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    if (view.has_element_contacts)
        for (int e = 0; e < view.element_count; e++)
            if (view.element_state[e] != CPS_NODE_STATE_FREE) return true;
    return false;
}

static void note_contacts(const CpsEvolution *evolution, const CpsStiffness found[2], uint64_t seed,
                          Tally *tally) {
    const CpsLineReport report = cps_evolution_line_report(evolution, 0);
    tally->grounded += report.grounded > 0;
    tally->sliding += report.slipping > 0;
    if (!elements_touch(evolution)) return;
    tally->elements++;
    for (int k = 0; k < 2; k++) {
        if (found[k].outcome == CPS_STIFFNESS_OUTCOME_NOT_GIVEN) continue;
        tally->failures++;
        fprintf(stderr, "seed %llu, %s: %s where an element touches\n", (unsigned long long)seed,
                cps_stiffness_name((CpsStiffnessKind)k),
                cps_stiffness_outcome_name(found[k].outcome));
    }
}

/* Frozen friction holds what has been lifted, and nothing holds that in a scene that begins there:
 * a step to the same place lets go of it. Then it is compared on planes, where contact with the
 * reference stays, and one contact of a node has all of the reaction at the start. */
static void compare_stick(Mooring *m, CpsEvolution *now, const CpsStiffness *of_step, uint64_t seed,
                          Tally *tally) {
    CpsStiffness found = *of_step;
    if (m->scene.friction_policy == CPS_FRICTION_POLICY_FROZEN) {
        if (m->ground > SLOPE || go_to(now, m->end, &m->last, NULL) != CPS_OK) return;
        if (!is_solved(now)) return;
        cps_evolution_stiffness(now, 0, m->end, CPS_STIFFNESS_STICK, &found, NULL);
    }
    Origin rest = {.evolution = stuck(m, now), .end = m->end, .to = m->last};
    rest.saved = save(rest.evolution, &rest.size);
    CpsError err;
    need(go_to(rest.evolution, rest.end, &rest.to, &err), &err);
    const Contacts sticking = contacts_of(rest.evolution);
    compare(&rest, &sticking, CPS_STIFFNESS_STICK, &found, seed, tally);
    free(rest.saved);
    cps_evolution_destroy(rest.evolution);
}

static void try_mooring(uint64_t seed, Tally *tally) {
    static Mooring m;
    make_mooring(seed, &m);
    Origin from = {.evolution = prepare(&m.scene)};
    tally->lines++;
    cps_evolution_step(from.evolution, NULL);
    m.last = m.line.end[m.end];
    CpsError err;
    const int moves = 1 + (int)uniform(0, MOVES);
    for (int k = 0; k < moves && is_solved(from.evolution); k++) {
        for (int a = 0; a < 3; a++) m.last.value[a] += uniform(-2, 2);
        if (m.end == CPS_END_A) m.last.value[2] = uniform(5.5, 7);
        free(from.saved);
        from.saved = save(from.evolution, &from.size);
        need(go_to(from.evolution, m.end, &m.last, &err), &err);
    }
    from.end = m.end;
    from.to = m.last;
    const CpsLineReport report = cps_evolution_line_report(from.evolution, 0);
    const CpsCertificate *certificate = &report.certificate;
    if (report.outcome != CPS_OUTCOME_SOLVED || report.substep_count != 1 ||
        !(certificate->gap <= ROUNDING * certificate->scale)) {
        tally->left_out++;
    } else {
        CpsStiffness found[2];
        const Contacts same = contacts_of(from.evolution);
        tally->sets += m.friction_set && report.grounded > 0;
        for (int k = 0; k < 2; k++)
            cps_evolution_stiffness(from.evolution, 0, m.end, (CpsStiffnessKind)k, &found[k], NULL);
        note_contacts(from.evolution, found, seed, tally);
        if (!stays_when_loaded(&m.scene, from.evolution, m.end, found)) {
            tally->failures++;
            fprintf(stderr, "seed %llu: other bits after a load\n", (unsigned long long)seed);
        }
        compare_stick(&m, from.evolution, &found[1], seed, tally);
        compare(&from, &same, CPS_STIFFNESS_STEP, &found[0], seed, tally);
    }
    free(from.saved);
    cps_evolution_destroy(from.evolution);
    cps_set_release(m.friction_set);
}

int main(int argc, char **argv) {
    int count = 100;
    uint64_t seed = 1;
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--scenes") == 0) count = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) seed = strtoull(argv[i + 1], NULL, 10);
    }
    Tally t = {0};
    for (int k = 0; k < count; k++) try_mooring(seed + (uint64_t)k, &t);
    const int tried = t.lines - t.left_out;
    printf("%d lines, %d of them solved to rounding in one substep: %d grounded, %d sliding, %d "
           "grounded with a set, %d with an element that touches\n",
           t.lines, tried, t.grounded, t.sliding, t.sets, t.elements);
    for (int k = 0; k < 2; k++) {
        printf("%-5s: %d compared, largest difference %.2g; %d with another state beside, %d rough",
               cps_stiffness_name((CpsStiffnessKind)k), t.compared[k], t.largest[k], t.changed[k],
               t.rough[k]);
        for (int o = 1; o < 5; o++)
            printf(", %d %s", t.outcome[k][o], cps_stiffness_outcome_name((CpsStiffnessOutcome)o));
        printf("\n");
    }
    /* a third of the lines must be compared, and as many lie and slide, or nothing is tested */
    return t.failures > 0 || 100 * t.beyond > t.compared[0] + t.compared[1] ||
           3 * t.compared[0] < tried || 3 * t.compared[1] < tried || 3 * t.grounded < tried ||
           t.elements == 0 || 20 * t.sets < tried || 10 * t.sliding < 3 * tried;
}
