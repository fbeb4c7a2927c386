/* SPDX-License-Identifier: BSD-3-Clause */
/* Whole moorings without friction against Newton's method on elastic catenaries.
 *                                            usage: random_moorings [--systems N] [--seed S]
 *
 * One to three free bodies on three to twelve lines of one to three sections, with clumps and buoys
 * where these meet, and lines between the bodies. Both begin in the same pose. Of two systems in a
 * row the first hangs in all its lines: what differs from the closed form has a series in h^2, and
 * its extrapolation over three meshes is 0. The second lies on a bed: the nodes touch down one by
 * one, so it has no series, but is below C h^2.
 *
 * What C is made of on a bed: let a line touch down at the distance x h from the node where it
 * lifts off, -1/2 <= x <= 1/2. The elements above it have the closed form's vertical forces at
 * their middles, so their rise is its rise by the midpoint rule, begun at that node: too high by (w
 * h^2/H)(1/24 - x^2/2), per length w L/H (1/24 - x^2/2)/N^2. So C grows with w L/H where all
 * elements are alike. With elements as long as sqrt(s^2 + L H/w), s the distance along the line
 * from touchdown, it does not: these meshes have the same C for all lines.
 *
 * At an anchor on the bed the half element of the end hangs on the anchor, not on the bed: its
 * weight w h/2 is taken off before forces are compared. Bodies that several equilibria hold may be
 * found in another one: then the closed form, begun there, must agree with it.
 */
#include "mooring_newton.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "capstan/evolve.h"
#include "dice.h"

enum { MESHES = 6, MOST_ELEMENTS = 1600, MEASURES = 6 * NEWTON_BODIES + 2 * NEWTON_LINES };

/* Of places per size, of rotations in radians, of forces at ends per largest one. */
static const double SUSPENDED = 1e-7, GROUNDED = 1e-5;
/* [-] w L/H of a grounded line from which on C may grow with it, where all elements are alike. */
static const double SLACK = 100;
/* Poses as far apart as this are two equilibria. */
static const double APART = 0.02;

typedef struct Tally {
    int systems, on_bed, slack, bodies, lines, sections, clumps, heeled, resting, apart, wrong;
    int unsolved, unstable, outside, loose; /* not compared */
    double suspended, c, finest, slackest;
    double alike_c, slack_c; /* of elements that are alike, per w L/(100 H) of nearly slack lines */
} Tally;

/* the system ----------------------------------------------------------------------------------- */

typedef struct System {
    NewtonMooring m;
    bool on_bed, hangs; /* hangs: from anchors above */
    bool backwards[NEWTON_LINES];
    int fiftieths[NEWTON_LINES][NEWTON_PIECES]; /* of the elements of a line, in its pieces */
} System;

static void make_bodies(System *s, double weight, double arm) {
    for (int k = 0; k < s->m.bodies; k++) {
        NewtonBody *b = &s->m.body[k];
        const double turn = uniform(-0.4, 0.4);
        for (int a = 0; a < 2; a++) b->position[a] = uniform(-0.05, 0.05) * s->m.size;
        b->position[0] += 0.8 * k * s->m.size;
        b->position[2] = s->m.size * uniform(0.6, 0.8);
        b->rotation[0] = cos(turn / 2);
        b->rotation[3] = sin(turn / 2);
        b->weight = weight * uniform(2, 8);
        b->gravity_centre[2] = -arm * uniform(0, 1);
        for (int a = 0; a < 3; a++) {
            b->load[a] = weight * uniform(-0.5, 0.5);
            b->load[3 + a] = weight * arm * uniform(-1, 1);
        }
        if (!s->hangs) {
            b->buoyancy = b->weight + weight * uniform(2, 6);
            b->buoyancy_centre[2] = arm * uniform(0, 0.5);
            b->hydrostatics[14] = b->weight / s->m.size * uniform(2, 6);
            b->hydrostatics[21] = b->hydrostatics[28] = b->weight * arm * uniform(0.2, 2);
        }
        memcpy(b->first_position, b->position, sizeof b->position);
        memcpy(b->first_rotation, b->rotation, sizeof b->rotation);
    }
}

/* Pieces that make up the length, and clumps and buoys between them. On a bed all elements of a
 * line are alike. */
static void make_pieces(System *s, int i, double length, double weight) {
    NewtonLine *line = &s->m.line[i];
    double share[NEWTON_PIECES], sum = 0;
    int left = 50;
    line->count = whole(1, NEWTON_PIECES);
    for (int k = 0; k < line->count; k++) {
        const bool last = k + 1 == line->count;
        s->fiftieths[i][k] = last ? left : whole(8, 20);
        left -= s->fiftieths[i][k];
        sum += share[k] = s->on_bed ? s->fiftieths[i][k] : uniform(0.3, 1);
    }
    for (int k = 0; k < line->count; k++) {
        NewtonPiece *p = &line->piece[k];
        p->length = length * share[k] / sum;
        p->weight = weight / s->m.size * uniform(0.3, 1);
        p->stiffness = weight * pow(10, uniform(1.5, 4));
        if (k + 1 < line->count && chance(0.5))
            p->drop = weight * (s->on_bed ? uniform(0, 0.3) : uniform(-0.2, 0.3));
    }
}

static void make_line(System *s, int i, int from, int to, double weight, double arm) {
    NewtonLine *line = &s->m.line[i];
    const double turn = 2.4 * i + uniform(-0.4, 0.4), out = uniform(0.8, 1.4) * s->m.size;
    const NewtonBody *b = &s->m.body[to];
    line->body[0] = from;
    line->body[1] = to;
    s->backwards[i] = chance(0.5);
    if (from < 0) {
        line->place[0][0] = b->position[0] + out * cos(turn);
        line->place[0][1] = b->position[1] + out * sin(turn);
        line->place[0][2] = s->hangs ? 1.5 * s->m.size : 0;
        line->place[1][0] = arm * cos(turn);
        line->place[1][1] = arm * sin(turn);
    } else {
        line->place[0][0] = arm;
        line->place[1][0] = -arm;
        for (int e = 0; e < 2; e++) line->place[e][1] = arm * uniform(-0.5, 0.5);
    }
    double at[2][3], unused[3];
    for (int e = 0; e < 2; e++) {
        if (line->body[e] >= 0) line->place[e][2] = arm * uniform(-1, 1);
        newton_place(&s->m, line, e, at[e], unused);
    }
    const double x = hypot(at[1][0] - at[0][0], at[1][1] - at[0][1]), rise = at[1][2] - at[0][2],
                 straight = hypot(x, rise);
    line->rests = s->on_bed && from < 0;
    const double length = line->rests ? straight + uniform(0.2, 0.8) * (x + rise - straight)
                                      : straight * uniform(1, 1.1);
    make_pieces(s, i, length, line->rests ? 3 * weight : weight);
}

static void make(System *s, uint64_t seed) {
    memset(s, 0, sizeof *s);
    state = 0x9fb21c651e98df25u * (seed + 1);
    s->on_bed = seed % 2;
    s->hangs = !s->on_bed && chance(0.5);
    s->m.size = pow(10, uniform(0, 3));
    s->m.lines = whole(3, NEWTON_LINES);
    s->m.bodies = s->m.lines < 6 ? 1 : s->m.lines < 9 ? whole(1, 2) : whole(1, NEWTON_BODIES);
    const double weight = pow(10, uniform(0, 4)), arm = s->m.size * pow(10, uniform(-1.7, -0.8));
    make_bodies(s, weight, arm);
    int i = 0;
    for (int k = 1; k < s->m.bodies; k++) make_line(s, i++, k - 1, k, weight, arm);
    for (; i < s->m.lines; i++) make_line(s, i, -1, i % s->m.bodies, weight, arm);
}

/* the scene ------------------------------------------------------------------------------------ */

typedef struct Model {
    CpsObstacle bed;
    CpsLine line[NEWTON_LINES];
    CpsSection section[NEWTON_LINES][NEWTON_PIECES];
    CpsPointWeight clump[NEWTON_LINES][NEWTON_PIECES];
    double element[NEWTON_LINES][MOST_ELEMENTS];
    CpsPoint point[2 * NEWTON_LINES];
    CpsBody body[NEWTON_BODIES];
    char name[3 * NEWTON_LINES + NEWTON_BODIES][16];
    CpsScene scene;
} Model;

/* A mesh of a line that rests, dense where it touches down: arc length s from end A of its pieces,
 * s = touchdown + size sinh(u), in equal steps of u within each piece. */
typedef struct Grading {
    double touchdown, size;
} Grading;

static Grading grading_of(const NewtonLine *line) {
    double lifts = 0, weight = 0, length = 0;
    for (int k = 0; k < line->count; k++) length += line->piece[k].length;
    for (int k = 0; k < line->count && lifts < length - line->grounded; k++) {
        weight = line->piece[k].weight;
        lifts += line->piece[k].length;
    }
    return (Grading){line->grounded, sqrt(line->h / weight * length)};
}

static double to_u(const Grading *g, double s) { return asinh((s - g->touchdown) / g->size); }
static double to_s(const Grading *g, double u) { return g->touchdown + g->size * sinh(u); }

/* The number of elements of each piece, of the n of the line. */
static void share_elements(const System *s, int i, int n, bool graded, int count[NEWTON_PIECES]) {
    const NewtonLine *line = &s->m.line[i];
    if (!graded) {
        for (int k = 0; k < line->count; k++) count[k] = s->fiftieths[i][k] * n / 50;
        return;
    }
    const Grading g = grading_of(line);
    double top = 0, all = 0;
    int left = n;
    for (int k = 0; k < line->count; k++) top += line->piece[k].length;
    all = to_u(&g, top) - to_u(&g, 0);
    for (int k = 0; k < line->count; k++) {
        const double foot = top - line->piece[k].length;
        const int most = left - (line->count - 1 - k),
                  own = (int)fmax(1, round((to_u(&g, top) - to_u(&g, foot)) / all * n));
        count[k] = k + 1 == line->count || own > most ? most : own;
        left -= count[k];
        top = foot;
    }
}

/* The lengths of the elements of piece k, from its upper end to its lower one. */
static void grade(const NewtonLine *line, int k, int count, double element[]) {
    const Grading g = grading_of(line);
    double foot = 0;
    for (int j = k + 1; j < line->count; j++) foot += line->piece[j].length;
    const double top = foot + line->piece[k].length, u = to_u(&g, top),
                 step = (u - to_u(&g, foot)) / count;
    double last = top;
    for (int j = 1; j <= count; j++) {
        const double next = j == count ? foot : to_s(&g, u - j * step);
        element[j - 1] = last - next;
        last = next;
    }
}

/* Line i in n elements. */
static void model_line(const System *s, int i, int n, bool graded, Model *out) {
    const NewtonLine *from = &s->m.line[i];
    CpsLine *line = &out->line[i];
    int count[NEWTON_PIECES];
    graded = graded && from->grounded > 0;
    *line = cps_line_default();
    line->name = out->name[i];
    line->start.kind = CPS_START_STATIC;
    line->element_count = n;
    line->element_length = out->element[i];
    line->section_count = from->count;
    line->section = out->section[i];
    line->point_weight = out->clump[i];
    line->length = 0;
    share_elements(s, i, n, graded, count);
    for (int k = 0, e = 0; k < from->count; k++) {
        /* pieces go from B to A */
        const int own = s->backwards[i] ? k : from->count - 1 - k;
        const NewtonPiece *p = &from->piece[own];
        double element[MOST_ELEMENTS];
        for (int j = 0; j < count[own]; j++) element[j] = p->length / count[own];
        if (graded) grade(from, own, count[own], element);
        for (int j = 0; j < count[own]; j++)
            out->element[i][e++] = element[s->backwards[i] ? j : count[own] - 1 - j];
        out->section[i][k] =
            (CpsSection){.length = p->length, .weight = p->weight, .stiffness = p->stiffness};
        line->length += p->length;
        const double drop = k + 1 == from->count ? 0
                            : s->backwards[i]    ? p->drop
                                                 : from->piece[own - 1].drop;
        if (drop != 0)
            out->clump[i][line->point_weight_count++] =
                (CpsPointWeight){.arc_length = line->length, .weight = drop};
    }
    for (int e = 0; e < 2; e++) {
        CpsPoint *point = &out->point[2 * i + e];
        *point = cps_point_default();
        point->name = out->name[NEWTON_LINES + 2 * i + e];
        memcpy(point->position, from->place[e], sizeof point->position);
        if (from->body[e] >= 0) point->kind = CPS_POINT_KIND_ON_BODY;
        if (from->body[e] >= 0) point->body = from->body[e];
        line->end[e].kind = CPS_END_KIND_POINT;
        line->end_point[s->backwards[i] ? 1 - e : e] = 2 * i + e;
    }
}

static void model_body(const NewtonBody *from, const char *name, CpsBody *to) {
    *to = cps_body_default();
    to->name = name;
    to->kind = CPS_BODY_KIND_FREE;
    to->weight = from->weight;
    to->buoyancy = from->buoyancy;
    memcpy(to->position, from->first_position, sizeof to->position);
    memcpy(to->rotation, from->first_rotation, sizeof to->rotation);
    memcpy(to->centre_of_gravity, from->gravity_centre, sizeof to->centre_of_gravity);
    memcpy(to->centre_of_buoyancy, from->buoyancy_centre, sizeof to->centre_of_buoyancy);
    memcpy(to->hydrostatics, from->hydrostatics, sizeof to->hydrostatics);
    memcpy(to->force, from->load, sizeof to->force);
    memcpy(to->moment, &from->load[3], sizeof to->moment);
}

static void model(const System *s, int n, bool graded, Model *out) {
    memset(out, 0, sizeof *out);
    for (int i = 0; i < 3 * NEWTON_LINES + NEWTON_BODIES; i++)
        snprintf(out->name[i], sizeof out->name[0], "n%d", i);
    out->bed = cps_obstacle_default();
    out->bed.name = "bed";
    for (int i = 0; i < s->m.lines; i++) model_line(s, i, n, graded, out);
    for (int k = 0; k < s->m.bodies; k++)
        model_body(&s->m.body[k], out->name[3 * NEWTON_LINES + k], &out->body[k]);
    out->scene = cps_scene_default();
    out->scene.obstacle_count = s->on_bed;
    out->scene.obstacle = &out->bed;
    out->scene.line_count = s->m.lines;
    out->scene.line = out->line;
    out->scene.point_count = 2 * s->m.lines;
    out->scene.point = out->point;
    out->scene.body_count = s->m.bodies;
    out->scene.body = out->body;
    out->scene.solver.tolerance = 1e-11; /* bodies balance to a hundred times this */
}

/* comparison ----------------------------------------------------------------------------------- */

typedef struct Found {
    CpsBodyReport body[NEWTON_BODIES];
    double force[NEWTON_LINES][2][3]; /* [N] of the line on what holds ends A and B of its pieces */
    bool certified, stable;
} Found;

/* [N] The weight of half an element at end A of the pieces of a line. */
static double half_element(const System *s, int i, const Model *scene) {
    const int e = s->backwards[i] ? scene->line[i].element_count - 1 : 0;
    return s->m.line[i].piece[s->m.line[i].count - 1].weight * scene->element[i][e] / 2;
}

static Found find(const System *s, int n, bool graded) {
    static Model scene;
    CpsEvolution *evolution = NULL;
    CpsError err;
    Found out = {.stable = true};
    model(s, n, graded, &scene);
    if (cps_evolution_create(&scene.scene, &evolution, &err) != CPS_OK ||
        cps_evolution_step(evolution, &err) != CPS_OK) {
        printf("%s: %s\n", err.where, err.message);
        exit(1);
    }
    out.certified = cps_outcome_is_certified(cps_evolution_report(evolution).outcome);
    for (int k = 0; k < s->m.bodies; k++) {
        out.body[k] = cps_evolution_body_report(evolution, k);
        out.stable = out.stable && out.body[k].is_stable;
    }
    for (int i = 0; i < s->m.lines; i++) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        for (int e = 0; e < 2; e++)
            for (int a = 0; a < 3; a++)
                out.force[i][e][a] = -line.end[s->backwards[i] ? 1 - e : e].force[a];
        if (s->m.line[i].grounded > 0) out.force[i][0][2] += half_element(s, i, &scene);
    }
    cps_evolution_destroy(evolution);
    return out;
}

/* What differs of poses and forces; the number of measures. */
static int differences(const NewtonMooring *m, const Found *found, double d[MEASURES]) {
    int count = 0;
    double largest = 0;
    for (int k = 0; k < m->bodies; k++) {
        for (int a = 0; a < 3; a++)
            d[count++] = (found->body[k].position[a] - m->body[k].position[a]) / m->size;
        newton_vector(found->body[k].rotation, m->body[k].rotation, &d[count]);
        count += 3;
    }
    for (int i = 0; i < m->lines; i++) largest = fmax(largest, hypot(m->line[i].h, m->line[i].v));
    for (int i = 0; i < m->lines; i++)
        for (int e = 0; e < 2; e++) {
            double sum = 0, own = 0;
            for (int a = 0; a < 3; a++) {
                sum += pow(found->force[i][e][a], 2);
                own += pow(m->line[i].force[e][a], 2);
            }
            d[count++] = (sqrt(sum) - sqrt(own)) / largest;
        }
    return count;
}

static double most_of(int count, const double d[MEASURES]) {
    double most = 0;
    for (int i = 0; i < count; i++) most = isnan(d[i]) ? INFINITY : fmax(most, fabs(d[i]));
    return most;
}

/* Does a line that hangs between bodies go below the bed? Then the closed form is not its. */
static bool is_outside(const System *s) {
    for (int i = 0; i < s->m.lines; i++) {
        const NewtonLine *line = &s->m.line[i];
        if (!s->on_bed || line->rests) continue;
        double low = INFINITY;
        for (int e = 0; e < 2; e++)
            low = fmin(low, s->m.body[line->body[e]].position[2] - 2 * fabs(line->place[e][2]));
        if (low + newton_lowest(line) <= 0) return true;
    }
    return false;
}

static void show(const char *who, const NewtonMooring *m, const Found *found) {
    for (int k = 0; k < m->bodies; k++) {
        const double *x = found ? found->body[k].position : m->body[k].position,
                     *q = found ? found->body[k].rotation : m->body[k].rotation;
        printf("  %s, body %d: %.9g %.9g %.9g m, rotation %.7f %.7f %.7f %.7f, %s\n", who, k, x[0],
               x[1], x[2], q[0], q[1], q[2], q[3],
               (found ? found->stable : m->is_stable) ? "stable" : "unstable");
    }
}

/* The closed form at the equilibrium that was found: the one from the first pose, or another. */
static bool same_equilibrium(System *s, const Found *found, uint64_t seed, Tally *tally) {
    double d[MEASURES];
    differences(&s->m, found, d);
    if (most_of(6 * s->m.bodies, d) < APART) return true;
    printf("seed %llu: two equilibria\n", (unsigned long long)seed);
    show("closed form", &s->m, NULL);
    show("found", &s->m, found);
    const bool first = s->m.is_stable;
    for (int k = 0; k < s->m.bodies; k++) {
        memcpy(s->m.body[k].position, found->body[k].position, sizeof found->body[k].position);
        memcpy(s->m.body[k].rotation, found->body[k].rotation, sizeof found->body[k].rotation);
    }
    tally->apart++;
    const bool beside = newton_solve(&s->m);
    show("closed form begun there", &s->m, NULL);
    differences(&s->m, found, d);
    return beside && first && s->m.is_stable && most_of(6 * s->m.bodies, d) < APART;
}

/* The differences on three meshes without their parts in h^2 and h^4. */
static double extrapolated(const NewtonMooring *m, const Found found[3]) {
    double d[3][MEASURES];
    int count = 0;
    for (int k = 0; k < 3; k++) count = differences(m, &found[k], d[k]);
    for (int i = 0; i < count; i++) {
        const double coarse = (4 * d[1][i] - d[0][i]) / 3, fine = (4 * d[2][i] - d[1][i]) / 3;
        d[0][i] = (16 * fine - coarse) / 15;
    }
    return most_of(count, d[0]);
}

static bool compare_suspended(System *s, uint64_t seed, Tally *tally) {
    Found found[3];
    for (int k = 0; k < 3; k++) found[k] = find(s, 100 << k, false);
    if (!same_equilibrium(s, &found[2], seed, tally)) return false;
    const double left = extrapolated(&s->m, found);
    tally->suspended = fmax(tally->suspended, left);
    printf("seed %llu: suspended, %d bodies, %d lines: left %.2g\n", (unsigned long long)seed,
           s->m.bodies, s->m.lines, left);
    return found[0].certified && found[1].certified && found[2].certified && left <= SUSPENDED;
}

/* [-] The largest w L/H of the lines that rest, w that of the section that lifts off. */
static double slackness(const NewtonMooring *m) {
    double most = 0;
    for (int i = 0; i < m->lines; i++) {
        const NewtonLine *line = &m->line[i];
        double length = 0, weight = 0, lifts = 0;
        for (int k = 0; k < line->count; k++) length += line->piece[k].length;
        for (int k = 0; k < line->count && lifts < length - line->grounded; k++) {
            weight = line->piece[k].weight;
            lifts += line->piece[k].length;
        }
        if (line->grounded > 0) most = fmax(most, weight * length / line->h);
    }
    return most;
}

/* The differences on all meshes, and the smallest C; false: a step is not certified, or another
 * equilibrium is found that is not the closed form's. */
static bool find_c(System *s, bool graded, uint64_t seed, Tally *tally, double *c, double *finest) {
    Found found[MESHES];
    double d[MEASURES];
    bool sound = true;
    *c = 0;
    for (int k = 0; k < MESHES; k++) found[k] = find(s, 50 << k, graded);
    if (!same_equilibrium(s, &found[MESHES - 1], seed, tally)) return false;
    printf("seed %llu: on a bed, %d bodies, %d lines, %s elements:", (unsigned long long)seed,
           s->m.bodies, s->m.lines, graded ? "graded" : "equal");
    for (int k = 0; k < MESHES; k++) {
        *finest = most_of(differences(&s->m, &found[k], d), d);
        *c = fmax(*c, *finest * pow(50 << k, 2));
        sound = sound && found[k].certified;
        printf(" %.2g", *finest);
    }
    printf(", C %.3g, w L/H %.3g\n", *c, slackness(&s->m));
    return sound;
}

static bool compare_grounded(System *s, uint64_t seed, Tally *tally) {
    double c, alike, finest, unused;
    const double most = GROUNDED * pow(MOST_ELEMENTS, 2);
    const bool sound =
        find_c(s, true, seed, tally, &c, &finest) && find_c(s, false, seed, tally, &alike, &unused);
    if (!sound) return false;
    const double slack = slackness(&s->m), loose = fmax(1, slack / SLACK);
    tally->on_bed++;
    tally->slack += loose > 1;
    tally->c = fmax(tally->c, c);
    tally->finest = fmax(tally->finest, finest);
    tally->slackest = fmax(tally->slackest, slack);
    if (loose > 1)
        tally->slack_c = fmax(tally->slack_c, alike / loose);
    else
        tally->alike_c = fmax(tally->alike_c, alike);
    for (int i = 0; i < s->m.lines; i++) tally->resting += s->m.line[i].grounded > 0;
    return c <= most && alike <= most * loose;
}

static void note(const System *s, Tally *tally) {
    tally->systems++;
    tally->bodies += s->m.bodies;
    tally->lines += s->m.lines;
    for (int i = 0; i < s->m.lines; i++) {
        tally->sections += s->m.line[i].count;
        for (int k = 0; k < s->m.line[i].count; k++)
            tally->clumps += s->m.line[i].piece[k].drop != 0;
    }
    for (int k = 0; k < s->m.bodies; k++) {
        double turn[3];
        newton_vector(s->m.body[k].rotation, s->m.body[k].first_rotation, turn);
        tally->heeled += hypot(turn[0], turn[1]) > 10 / 57.3;
    }
}

/* Is there a closed form at an equilibrium, of the lines that the mesh can resolve? */
static bool has_closed_form(System *s, Tally *tally) {
    const bool solved = newton_solve(&s->m), outside = solved && is_outside(s);
    bool loose = false;
    for (int i = 0; i < s->m.lines; i++) loose = loose || s->m.line[i].loose;
    tally->unsolved += !solved;
    tally->unstable += solved && !s->m.is_stable;
    tally->outside += outside;
    tally->loose += solved && loose;
    return solved && s->m.is_stable && !outside && !loose;
}

static void run(uint64_t seed, Tally *tally) {
    static System s;
    make(&s, seed);
    if (!has_closed_form(&s, tally)) return;
    note(&s, tally);
    const bool agrees =
        s.on_bed ? compare_grounded(&s, seed, tally) : compare_suspended(&s, seed, tally);
    if (!agrees) printf("seed %llu: DIFFERS\n", (unsigned long long)seed);
    tally->wrong += !agrees;
}

int main(int argc, char **argv) {
    int systems = 40;
    Tally t = {0};
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--systems") == 0) systems = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--seed") == 0) {
            run(strtoull(argv[i + 1], NULL, 10), &t);
            return t.wrong > 0;
        }
    }
    for (uint64_t seed = 0; t.systems < systems && seed < 10 * (uint64_t)systems; seed++) {
        /* as many on a bed as hanging */
        if (2 * (seed % 2 ? t.on_bed : t.systems - t.on_bed) < systems) run(seed, &t);
    }
    printf("%d systems, %d on a bed, of %d bodies and %d lines in %d sections with %d clumps and "
           "buoys; %d bodies heel by more than 10 degrees, %d lines rest; passed over: %d that "
           "Newton's method does not find, %d unstable, %d below the bed, %d with a loose line\n",
           t.systems, t.on_bed, t.bodies, t.lines, t.sections, t.clumps, t.heeled, t.resting,
           t.unsolved, t.unstable, t.outside, t.loose);
    printf("suspended to %.2g; on a bed within C h^2, C = %.3g, %.2g at 1600 elements, w L/H up to "
           "%.3g; with equal elements C = %.3g, or C = %.3g w L/(100 H) in %d with a line nearly "
           "slack; %d in another equilibrium; %d wrong\n",
           t.suspended, t.c, t.finest, t.slackest, t.alike_c, t.slack_c, t.slack, t.apart, t.wrong);
    return t.wrong > 0 || t.systems < systems;
}
