/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines that meet at points: stars, trees, rings and nets, checked from the places alone.
 *                   usage: random_graphs [--scenes N] [--seed S] [--class C] [--meshes N] [--open
 * N]
 *
 * Wide nets have up to N x N meshes (default 10), each side of them cut and stiff at random, many
 * slack; they hang from their corners or from more of their knots, over a bed, over a ball and
 * pegs, or over nothing. Their sides are one element, or in half of the nets up to three.
 *
 * The tension of an element follows from the distance of its nodes, T = EA (|x'| - 1)^+. With half
 * the weight of the end elements, what the points carry and what acts on them, the forces on every
 * free point are added up anew; they must balance with a reaction and a friction force on the
 * obstacle that obey Coulomb's law at the slip that the places before and after tell. The force of
 * an inextensible line is its own where it obeys all laws of such a line, and a step without an
 * equilibrium has a proof, which is verified from the scene. Every eighth scene is taken on three
 * threads as well, and is to have the same bits. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "balance_at_points.h"
#include "capstan/evolve.h"
#include "dice.h"
#include "graph_proofs.h"
#include "scenes_given.h"

enum { MOST_MESHES = 30, MOST_LINES = 2 * MOST_MESHES * (MOST_MESHES + 1) };
enum {
    MOST_POINTS = (MOST_MESHES + 1) * (MOST_MESHES + 1),
    STAGES = 2,
    CLASSES = 10,
    PEGS = 4,
    THREADED = 8
};
typedef enum Class { STAR, TREE, RING, NET, CLUMPS, WIDE, SLACK, INEXTENSIBLE, LOOSE, SHORT } Class;
static const char *const CLASS[CLASSES] = {"star", "tree",  "ring",         "net",   "clumps",
                                           "wide", "slack", "inextensible", "loose", "short"};
/* The share of steps of a class that are to have no equilibrium, so that proofs are tested. */
static const double REFUSED[CLASSES] = {[LOOSE] = 0.1, [SHORT] = 0.05};

/* Share of the steps of a class that may be open. */
static const double OPEN_SHARE = 0.005;

typedef struct Tally {
    int scenes, steps, open, refused, trials, most_trials, touching, sliding, wrong;
    double left;
} Tally;

static int most_meshes = 10;

typedef struct Graph {
    CpsObstacle obstacle[1 + PEGS];
    CpsLine line[MOST_LINES];
    CpsPoint point[MOST_POINTS];
    char name[MOST_LINES + MOST_POINTS][16];
    CpsPointChange change[STAGES][MOST_POINTS];
    CpsStage stage[STAGES];
    CpsScene scene;
    double size, weight, stiffness, load; /* load: [m] of line, of whose weight loads are */
} Graph;

static int add_point(Graph *g, CpsPointKind kind, double x, double y, double z) {
    const int i = g->scene.point_count++;
    CpsPoint *point = &g->point[i];
    *point = cps_point_default();
    snprintf(g->name[MOST_LINES + i], sizeof g->name[0], "p%d", i);
    point->name = g->name[MOST_LINES + i];
    point->kind = kind;
    point->position[0] = x;
    point->position[1] = y;
    point->position[2] = fmax(z, 0);
    return i;
}

/* A line between two points, `longer` times as long as their distance. */
static void add_line(Graph *g, int from, int to, double longer, int elements) {
    const int i = g->scene.line_count++;
    CpsLine *line = &g->line[i];
    double distance = 0;
    for (int a = 0; a < 3; a++)
        distance += pow(g->point[from].position[a] - g->point[to].position[a], 2);
    *line = cps_line_default();
    snprintf(g->name[i], sizeof g->name[0], "l%d", i);
    line->name = g->name[i];
    line->length = longer * sqrt(distance);
    line->element_count = elements;
    line->weight = g->weight * uniform(0.5, 1.5);
    line->stiffness = g->stiffness * uniform(0.5, 1.5);
    line->start.kind = CPS_START_STATIC;
    const bool turned = chance(0.5);
    line->end[turned].kind = CPS_END_KIND_POINT;
    line->end_point[turned] = from;
    line->end[!turned].kind = CPS_END_KIND_POINT;
    line->end_point[!turned] = to;
}

static int anchor(Graph *g, double angle, double height) {
    return add_point(g, CPS_POINT_KIND_HELD, g->size * cos(angle), g->size * sin(angle), height);
}

static void make_star(Graph *g) {
    const int lines = whole(2, 6);
    const double z = uniform(0.1, 1) * g->size, y = uniform(-0.3, 0.3) * g->size,
                 x = uniform(-0.3, 0.3) * g->size;
    const int knot = add_point(g, CPS_POINT_KIND_FREE, x, y, z);
    for (int k = 0; k < lines; k++) {
        const int elements = whole(3, 30);
        const double longer = uniform(0.95, 1.6), height = uniform(-0.3, 1) * g->size,
                     angle = 6.28 * k / lines + uniform(-0.3, 0.3);
        add_line(g, anchor(g, angle, height), knot, longer, elements);
    }
    if (chance(0.5)) g->point[knot].weight = uniform(-2, 1) * g->weight * g->size;
}

static void make_tree(Graph *g) {
    const int knots = whole(2, 8);
    const int first = anchor(g, 0, g->size);
    for (int k = 0; k < knots; k++) {
        const int from = k == 0 ? first : whole(0, 1) ? first + k : whole(first, first + k);
        const double *at = g->point[from].position, z = at[2] + uniform(-0.8, 0.3) * g->size,
                     y = at[1] + uniform(-0.6, 0.6) * g->size,
                     x = at[0] + uniform(-0.6, 0.6) * g->size;
        const int to = add_point(g, CPS_POINT_KIND_FREE, x, y, z), elements = whole(2, 20);
        add_line(g, from, to, uniform(1, 1.3), elements);
        if (chance(0.3)) g->point[to].weight = uniform(-0.5, 1) * g->weight * g->size;
        if (chance(0.3)) {
            const int pieces = whole(2, 20);
            const double longer = uniform(1, 1.5), height = uniform(0, 1) * g->size;
            add_line(g, anchor(g, uniform(-3, 3), height), to, longer, pieces);
        }
    }
}

static void make_ring(Graph *g) {
    const int knots = whole(3, 10), first = g->scene.point_count;
    for (int k = 0; k < knots; k++) {
        const double angle = 6.28 * k / knots;
        add_point(g, CPS_POINT_KIND_FREE, 0.5 * g->size * cos(angle), 0.5 * g->size * sin(angle),
                  uniform(0.3, 0.8) * g->size);
    }
    for (int k = 0; k < knots; k++) {
        const int elements = whole(1, 10);
        add_line(g, first + k, first + (k + 1) % knots, uniform(0.9, 1.4), elements);
    }
    const int held = whole(2, 4);
    for (int k = 0; k < held; k++) {
        const int elements = whole(2, 20);
        const double longer = uniform(0.95, 1.4), height = uniform(0.5, 1.5) * g->size;
        add_line(g, anchor(g, 6.28 * k / held, height), first + k * knots / held, longer, elements);
    }
}

/* A line of a net, of 1 to `pieces` elements: `slack` x 0.98 .. most times as long as the distance.
 */
static void add_cord(Graph *g, int from, int to, double slack, double most, int pieces) {
    const int elements = whole(1, pieces);
    add_line(g, from, to, slack * uniform(0.98, most), elements);
}

static void make_net(Graph *g) {
    const int a = whole(3, 6), b = whole(3, 6), first = g->scene.point_count;
    for (int i = 0; i < a; i++)
        for (int j = 0; j < b; j++) {
            const bool corner = (i == 0 || i == a - 1) && (j == 0 || j == b - 1);
            add_point(g, corner ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE, g->size * i / (a - 1),
                      g->size * j / (b - 1), 0.6 * g->size);
        }
    for (int i = 0; i < a; i++)
        for (int j = 0; j < b; j++) {
            const int at = first + i * b + j;
            if (i + 1 < a) add_cord(g, at, at + b, 1, 1.2, 3);
            if (j + 1 < b) add_cord(g, at, at + 1, 1, 1.2, 3);
        }
}

/* A line of pieces with clumps at their joints, on the bed. */
static void make_clumps(Graph *g) {
    const int pieces = whole(2, 5);
    int from = anchor(g, 0, 0);
    for (int k = 1; k <= pieces; k++) {
        const double x = g->size * (1 - 1.5 * k / pieces);
        const int to = add_point(g, k < pieces ? CPS_POINT_KIND_FREE : CPS_POINT_KIND_HELD, x,
                                 uniform(-0.1, 0.1) * g->size, k < pieces ? 0 : 0.4 * g->size);
        if (k < pieces) g->point[to].weight = uniform(0, 2) * g->weight * g->size;
        const int elements = whole(3, 25);
        add_line(g, from, to, uniform(1, 1.15), elements);
        from = to;
    }
}

static void add_ball(Graph *g, const char *name, double x, double y, double top, double radius) {
    CpsObstacle *ball = &g->obstacle[g->scene.obstacle_count++];
    *ball = cps_obstacle_default();
    ball->name = name;
    ball->kind = CPS_OBSTACLE_SPHERE;
    ball->radius = radius;
    ball->point[0] = x;
    ball->point[1] = y;
    ball->point[2] = top - radius;
    ball->friction = chance(0.2) ? 0 : uniform(0.05, 1.2);
}

/* A net of meshes of one length. The radius of any ball is at least 1.05 times as large, as a side
 * of one element may not cut deeper into one; and none comes near another, since a knot does not
 * rest on two of them. */
static void make_wide(Graph *g) {
    static const char *const PEG[PEGS] = {"a", "b", "c", "d"};
    const int a = whole(most_meshes / 2, most_meshes), b = whole(most_meshes / 2, most_meshes),
              first = g->scene.point_count;
    const double mesh = g->size / fmax(a, b), height = 0.3 * g->size,
                 slack = chance(0.5) ? uniform(1, 1.15) : 1;
    const bool edges = chance(0.3);
    const int pieces = chance(0.5) ? 1 : 3;
    for (int i = 0; i <= a; i++)
        for (int j = 0; j <= b; j++) {
            const bool side = i == 0 || i == a, end = j == 0 || j == b;
            add_point(g,
                      (side && end) || (edges && side) ? CPS_POINT_KIND_HELD : CPS_POINT_KIND_FREE,
                      mesh * i, mesh * j, height);
        }
    for (int i = 0; i <= a; i++)
        for (int j = 0; j <= b; j++) {
            const int at = first + i * (b + 1) + j;
            if (i < a) add_cord(g, at, at + b + 1, slack, 1.1, pieces);
            if (j < b) add_cord(g, at, at + 1, slack, 1.1, pieces);
        }
    if (g->scene.obstacle_count > 0 || chance(0.3)) return;
    const double apart = 0.3 * mesh * hypot(a, b);
    const double most = fmax(1.05 * mesh, uniform(0.2, 0.5) * apart);
    add_ball(g, "ball", 0.5 * mesh * a, 0.5 * mesh * b, uniform(0, 0.25) * g->size, most);
    for (int k = 0; k < PEGS; k++) {
        const double radius = fmax(1.05 * mesh, uniform(0.05, 0.35) * apart);
        add_ball(g, PEG[k], (k % 2 ? 0.2 : 0.8) * mesh * a, (k / 2 ? 0.2 : 0.8) * mesh * b,
                 uniform(0, 0.2) * g->size, radius);
    }
}

static void make_any(Graph *g) {
    static void (*const ANY[])(Graph *) = {make_star, make_tree, make_ring, make_clumps};
    ANY[whole(0, 3)](g);
}

/* Lines of up to four times the distance of their ends lie about on the bed. */
static void make_slack(Graph *g) {
    make_any(g);
    for (int i = 0; i < g->scene.line_count; i++)
        if (chance(0.5)) g->line[i].length *= uniform(1, 3);
}

/* Some lines, or all, cannot be stretched. */
static void make_inextensible(Graph *g) {
    const double share = uniform(0.2, 1.2);
    make_any(g);
    for (int i = 0; i < g->scene.line_count; i++)
        if (i == 0 || chance(share)) g->line[i].stiffness = INFINITY;
}

/* What was held is not. */
static void make_loose(Graph *g) {
    make_any(g);
    for (int i = 0; i < g->scene.point_count; i++) g->point[i].kind = CPS_POINT_KIND_FREE;
}

/* ... and they are shorter, so that they may reach or not. */
static void make_short(Graph *g) {
    const double shorter = uniform(0.5, 1);
    make_inextensible(g);
    for (int i = 0; i < g->scene.line_count; i++) g->line[i].length *= shorter * uniform(0.8, 1);
}

static void make_stages(Graph *g) {
    for (int k = 0; k < STAGES; k++) {
        CpsStage *stage = &g->stage[k];
        *stage = cps_stage_default();
        stage->name = "stage";
        stage->step_count = whole(1, 3);
        stage->point_change = g->change[k];
        for (int i = 0; i < g->scene.point_count; i++) {
            if (!chance(0.3)) continue;
            CpsPointChange *change = &g->change[k][stage->point_change_count++];
            *change = (CpsPointChange){.point = i, .kind = g->point[i].kind};
            for (int a = 0; a < 3; a++)
                change->value[a] =
                    g->point[i].kind == CPS_POINT_KIND_FREE
                        ? uniform(-1, 1) * g->weight * g->load
                        : fmax(a == 2 ? 0 : -INFINITY,
                               g->point[i].position[a] + uniform(-0.1, 0.1) * g->size);
        }
    }
}

static void make(Graph *g, Class class, uint64_t seed) {
    static void (*const MAKE[CLASSES])(
        Graph *) = {make_star, make_tree,  make_ring,         make_net,   make_clumps,
                    make_wide, make_slack, make_inextensible, make_loose, make_short};
    memset(g, 0, sizeof *g);
    state = 0x9b05688c2b3e6c1fu * (seed + 1) + (uint64_t) class;
    g->scene = cps_scene_default();
    g->size = pow(10, uniform(-0.5, 3));
    g->weight = pow(10, uniform(-1, 4));
    g->stiffness = g->weight * g->size * pow(10, uniform(1, 4.5));
    if (class == CLUMPS || class == SLACK || chance(0.6)) {
        g->obstacle[0] = cps_obstacle_default();
        g->obstacle[0].name = "bed";
        g->obstacle[0].friction = chance(0.2) ? 0 : uniform(0.05, 1.2);
        g->scene.obstacle_count = 1;
        g->scene.obstacle = g->obstacle;
    }
    g->load = class == WIDE ? g->size / 10 : g->size;
    MAKE[class](g);
    make_stages(g);
    g->scene.obstacle = g->obstacle;
    g->scene.line = g->line;
    g->scene.point = g->point;
    g->scene.stage = g->stage;
    g->scene.stage_count = STAGES;
}

/* [N] The force on the point at an end of a line, from the places of its nodes. */
static void add_pull(const CpsLineView *view, double stiffness, int end, const double weight[3],
                     double sum[3], double *largest) {
    const int e = end == CPS_END_A ? 0 : view->element_count - 1;
    const int near = end == CPS_END_A ? 0 : e + 1, far = end == CPS_END_A ? 1 : e;
    double d[3], size = 0;
    for (int a = 0; a < 3; a++) {
        d[a] = view->position[3 * far + a] - view->position[3 * near + a];
        size += d[a] * d[a];
    }
    size = sqrt(size);
    if (!isfinite(
            stiffness)) { /* the force that the check of the line has found to obey its laws */
        const double *p = &view->segment_force[3 * e];
        for (int a = 0; a < 3; a++)
            sum[a] += (end == CPS_END_A ? p[a] : -p[a]) + 0.5 * view->element_length[e] * weight[a];
        return;
    }
    const double l = view->element_length[e], tension = stiffness * fmax(0, size / l - 1);
    for (int a = 0; a < 3; a++)
        sum[a] += (size > 0 ? tension * d[a] / size : 0) + 0.5 * l * weight[a];
    *largest = fmax(*largest, tension);
}

static double norm(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* What the lines bring to a point. */
typedef struct Pulls {
    double sum[3], largest, known; /* [N]; known: how well the forces follow from the places */
} Pulls;

/* The pulls on all points; returns the largest force in any line. */
static double add_pulls(const Graph *g, const CpsEvolution *evolution, Pulls *pulls) {
    double largest = 0;
    memset(pulls, 0, (size_t)g->scene.point_count * sizeof *pulls);
    for (int k = 0; k < g->scene.line_count; k++) {
        const CpsLineView view = cps_evolution_line_view(evolution, k);
        const CpsCertificate line = cps_evolution_line_report(evolution, k).certificate;
        const double weight[3] = {0, 0, -g->line[k].weight};
        largest = fmax(largest, line.largest_force);
        for (int end = 0; end < 2; end++) {
            Pulls *at = &pulls[g->line[k].end_point[end]];
            const double EA = g->line[k].stiffness;
            add_pull(&view, EA, end, weight, at->sum, &at->largest);
            at->known +=
                (isfinite(EA) ? EA : 0) * (RESTING + fmin(line.elongation_residual, STRAIN)) +
                fmin(line.tension_estimate, TENSION * line.largest_force);
        }
    }
    return largest;
}

/* [m] The distance of x from an obstacle, with its normal n there and the foot of x on it. */
static double distance(const CpsObstacle *on, const double x[3], double n[3], double foot[3]) {
    double size = 0;
    for (int a = 0; a < 3; a++) {
        n[a] = on->kind == CPS_OBSTACLE_PLANE ? on->normal[a] : x[a] - on->point[a];
        size += on->kind == CPS_OBSTACLE_PLANE ? n[a] * (x[a] - on->point[a]) : 0;
    }
    if (on->kind == CPS_OBSTACLE_SPHERE) {
        const double spoke = norm(n);
        for (int a = 0; a < 3; a++) n[a] /= spoke;
        size = spoke - on->radius;
    }
    for (int a = 0; a < 3; a++) foot[a] = x[a] - size * n[a];
    return size;
}

/* [m] How far a point slid on the obstacle, and the direction in which it arrived. */
static double slip_on(const CpsObstacle *on, const double before[3], const double now[3],
                      double direction[3]) {
    double n[3], unused[3], from[3], to[3], along = 0;
    (void)distance(on, before, unused, from);
    (void)distance(on, now, n, to);
    for (int a = 0; a < 3; a++) along += n[a] * (to[a] - from[a]);
    for (int a = 0; a < 3; a++) direction[a] = to[a] - from[a] - along * n[a];
    const double size = norm(direction);
    for (int a = 0; a < 3; a++) direction[a] = size > 0 ? direction[a] / size : 0;
    return size;
}

/* Check a free point after a step; returns what is left of its forces over the largest. */
static double check_point(const Graph *g, const CpsPointReport *report, int i, const Pulls *pulls,
                          double in_lines, const double before[3], const double load[3],
                          bool smooth, bool *wrong, Tally *tally) {
    const double far = 1e-8 * g->size, *x = report->position;
    double sum[3], n[3], unused[3], slip[3] = {0}, normal[3] = {0}, across = 0, slid = 0, mu = 0;
    const double largest = fmax(fmax(norm(load), pulls->largest), in_lines);
    const double allowed = LEFT * largest + pulls->known, *friction = report->friction;
    for (int a = 0; a < 3; a++)
        sum[a] = pulls->sum[a] + load[a] - (a == 2 ? g->point[i].weight : 0) +
                 report->reaction * report->normal[a] + friction[a];
    bool below = false, floats = false, pulled = report->reaction < 0, lazy = false;
    for (int k = 0; k < g->scene.obstacle_count; k++)
        below = below || distance(&g->obstacle[k], x, n, unused) < -far;
    if (report->reaction > 0) {
        const CpsObstacle *on = &g->obstacle[report->obstacle];
        floats = distance(on, x, normal, unused) > far;
        slid = slip_on(on, before, x, slip);
        mu = smooth ? 0 : on->friction;
    }
    for (int a = 0; a < 3; a++) {
        pulled = pulled || fabs(report->normal[a] - normal[a]) > 1e-7;
        across += friction[a] * normal[a];
        lazy = lazy || (slid > 1e-6 * g->size &&
                        fabs(friction[a] + mu * report->reaction * slip[a]) > 10 * allowed);
    }
    const bool over = norm(friction) > mu * report->reaction + allowed || fabs(across) > allowed,
               open = !(norm(sum) <= allowed);
    tally->touching += report->reaction > 0;
    tally->sliding += slid > 1e-6 * g->size;
    if (below || floats || pulled || over || lazy || open) {
        *wrong = true;
        printf("  point %d: below %d floats %d pulls %d over %d lazy %d left %g allowed %g\n", i,
               below, floats, pulled, over, lazy, norm(sum), allowed);
    }
    return norm(sum) / largest;
}

static void fail(uint64_t seed, const CpsError *err) {
    printf("seed %llu: %s\n", (unsigned long long)seed, err->message);
    exit(1);
}

/* [N] or [m] The given force on a free point, or the place of a held one, after `step` of the
 * scene, of which the first is the statics. */
static void given_at(const Graph *g, int point, int step, double load[3]) {
    double from[3] = {0};
    int at = 1;
    if (g->point[point].kind == CPS_POINT_KIND_HELD)
        memcpy(from, g->point[point].position, sizeof from);
    memcpy(load, from, sizeof from);
    for (int k = 0; k < STAGES; k++) {
        const CpsStage *stage = &g->stage[k];
        double to[3];
        memcpy(to, from, sizeof to);
        for (int i = 0; i < stage->point_change_count; i++)
            if (g->change[k][i].point == point) memcpy(to, g->change[k][i].value, sizeof to);
        for (int part = 1; part <= stage->step_count; part++, at++)
            if (at == step)
                for (int a = 0; a < 3; a++)
                    load[a] = from[a] + (to[a] - from[a]) * part / stage->step_count;
        memcpy(from, to, sizeof from);
    }
}

/* Have the same steps on several threads the same bits? */
static bool same_bits(const Graph *g, const CpsEvolution *one, const CpsEvolution *other) {
    for (int i = 0; i < g->scene.line_count; i++) {
        const CpsLineView a = cps_evolution_line_view(one, i),
                          b = cps_evolution_line_view(other, i);
        const size_t n = (size_t)a.element_count;
        if (memcmp(a.position, b.position, 3 * (n + 1) * sizeof *a.position) != 0 ||
            memcmp(a.tension, b.tension, n * sizeof *a.tension) != 0)
            return false;
    }
    for (int i = 0; i < g->scene.point_count; i++) {
        const CpsPointReport a = cps_evolution_point_report(one, i),
                             b = cps_evolution_point_report(other, i);
        if (memcmp(a.position, b.position, sizeof a.position) != 0 ||
            memcmp(a.residual, b.residual, sizeof a.residual) != 0 || a.reaction != b.reaction)
            return false;
    }
    return true;
}

/* Take the scene on three threads as well. */
static void run_on_threads(const Graph *g, uint64_t seed, Tally *tally) {
    CpsError err;
    CpsScene threaded = g->scene;
    CpsEvolution *one = NULL, *other = NULL;
    threaded.solver.thread_count = 3;
    if (cps_evolution_create(&g->scene, &one, &err) != CPS_OK) fail(seed, &err);
    if (cps_evolution_create(&threaded, &other, &err) != CPS_OK) fail(seed, &err);
    while (cps_evolution_remaining_count(one) > 0) {
        if (cps_evolution_step(one, &err) != CPS_OK) fail(seed, &err);
        if (cps_evolution_step(other, &err) != CPS_OK) fail(seed, &err);
        if (same_bits(g, one, other)) continue;
        printf("seed %llu: other bits on three threads\n", (unsigned long long)seed);
        tally->wrong++;
        break;
    }
    cps_evolution_destroy(one);
    cps_evolution_destroy(other);
}

/* Check the proofs of a step without equilibrium, or the inextensible lines of one with. */
static bool check_step(const Graph *g, const CpsEvolution *evolution, int step, bool sound) {
    double given[MOST_POINTS][3], load[MOST_POINTS][3], largest = 0;
    for (int i = 0; i < g->scene.point_count; i++) {
        given_at(g, i, step, given[i]);
        memcpy(load[i], given[i], sizeof load[i]);
        load[i][2] -= g->point[i].weight;
    }
    for (int i = 0; i < g->scene.line_count; i++)
        largest = fmax(largest, cps_evolution_line_report(evolution, i).certificate.largest_force);
    const double mu = g->scene.obstacle_count == 0 ? -1 : step == 0 ? 0 : g->obstacle[0].friction;
    const GraphStep at = {&g->scene, evolution, (const double(*)[3])given, (const double(*)[3])load,
                          mu,        g->size};
    bool good = graph_proofs_hold(&at);
    for (int i = 0; i < g->scene.line_count; i++)
        if (sound && !isfinite(g->line[i].stiffness))
            good = graph_line_holds(&at, i, LEFT * largest) && good;
    return good;
}

static void run(Class class, uint64_t seed, Tally *tally) {
    static Graph graph;
    make(&graph, class, seed);
    CpsError err;
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(&graph.scene, &evolution, &err) != CPS_OK) fail(seed, &err);
    static double before[MOST_POINTS][3];
    static Pulls pulls[MOST_POINTS];
    bool sound = true;
    tally->scenes++;
    for (int step = 0; sound && cps_evolution_remaining_count(evolution) > 0; step++) {
        for (int i = 0; i < graph.scene.point_count; i++)
            memcpy(before[i], cps_evolution_point_report(evolution, i).position, sizeof before[i]);
        if (cps_evolution_step(evolution, &err) != CPS_OK) fail(seed, &err);
        const CpsStepReport report = cps_evolution_report(evolution);
        tally->steps++;
        sound = cps_outcome_is_certified(report.outcome);
        bool wrong = !check_step(&graph, evolution, step, sound);
        const bool refused = cps_outcome_is_final(report.outcome);
        tally->refused += refused;
        const double in_lines = add_pulls(&graph, evolution, pulls);
        for (int i = 0; i < graph.scene.point_count; i++) {
            double load[3];
            if (graph.point[i].kind != CPS_POINT_KIND_FREE) continue;
            const CpsPointReport point = cps_evolution_point_report(evolution, i);
            const int trials = point.trial_count;
            if (trials > tally->most_trials) tally->most_trials = trials;
            if (i == 0 || graph.point[i - 1].kind != CPS_POINT_KIND_FREE) tally->trials += trials;
            given_at(&graph, i, step, load);
            if (sound)
                tally->left =
                    fmax(tally->left, check_point(&graph, &point, i, &pulls[i], in_lines, before[i],
                                                  load, step == 0, &wrong, tally));
        }
        tally->wrong += wrong;
        tally->open += !sound && !refused;
        if (wrong || !(sound || refused))
            printf("%s seed %llu step %d: %s%s\n", CLASS[class], (unsigned long long)seed, step,
                   cps_outcome_name(report.outcome), wrong ? ", refuted" : "");
    }
    cps_evolution_destroy(evolution);
    if (seed % THREADED == 0) run_on_threads(&graph, seed, tally);
}

int main(int argc, char **argv) {
    int only = -1, may_be_open = -1;
    uint64_t first;
    const int scenes = scenes_given(argc, argv, 20, &first);
    for (int i = 1; i + 1 < argc; i += 2) {
        if (strcmp(argv[i], "--class") == 0) only = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--open") == 0) may_be_open = atoi(argv[i + 1]);
        if (strcmp(argv[i], "--meshes") == 0) most_meshes = atoi(argv[i + 1]);
    }
    if (most_meshes < 4 || most_meshes > MOST_MESHES) return 2;
    bool failed = false;
    for (int class = 0; class < CLASSES; class ++) {
        if (only >= 0 && class != only) continue;
        Tally t = {0};
        for (int i = 0; i < scenes; i++) run((Class) class, first + (uint64_t)i, &t);
        printf("%-6s %d scenes, %d steps: %d open, %d refused, %d wrong; %.1f trials a step, at "
               "most %d; left of "
               "the forces up to %.2g; %d points touch, %d slide\n",
               CLASS[class], t.scenes, t.steps, t.open, t.refused, t.wrong,
               (double)t.trials / t.steps, t.most_trials, t.left, t.touching, t.sliding);
        /* one of few may be open */
        const double open = may_be_open < 0 ? fmax(1, OPEN_SHARE * t.steps) : may_be_open;
        failed = failed || t.wrong > 0 || t.open > open ||
                 (only < 0 && t.refused < REFUSED[class] * t.steps);
    }
    return failed;
}
