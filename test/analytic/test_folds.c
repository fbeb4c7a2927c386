/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines in concave edges and corners of a mesh, against the planes of its faces, raised by its
 * radius: a groove between two faces, and a pit between three. The node between two elements comes
 * to rest there, and is drawn about. */
#include <stdio.h>
#include <string.h>

#include "capstan/evolve.h"
#include "check.h"
#include "splitmix.h"

enum { ELEMENTS = 2, STEPS = 8, FACES = 3 };
static const double LENGTH = 8, WEIGHT = 60, RADIUS = 0.05;

typedef struct Track {
    double place[STEPS + 1][3 * (ELEMENTS + 1)], force[STEPS + 1][3 * ELEMENTS]; /* [m], [N] */
    int bears[STEPS + 1]; /* contacts of the node */
} Track;

static double size_of(const double *x) { return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); }

/* How many contacts of node j bear. */
static int bearing(const CpsLineView *view, int j) {
    const int n = view->element_count + 1;
    int count = 0;
    for (int c = j; c < view->contact_count * n; c += n) count += view->reaction[c] > 1e-6;
    if (view->has_element_contacts && j > 0 && view->element_share[j - 1] == 1)
        count += view->element_reaction[j - 1] > 1e-6;
    return count;
}

static void follow(CpsScene *scene, Track *track) {
    CpsError err = {0};
    CpsEvolution *evolution = NULL;
    if (cps_evolution_create(scene, &evolution, &err)) fail_msg("%s", err.message);
    for (int s = 0; s <= STEPS; s++) {
        if (cps_evolution_step(evolution, &err)) fail_msg("%s", err.message);
        const CpsStepReport report = cps_evolution_report(evolution);
        if (!cps_outcome_is_certified(report.outcome))
            fail_msg("%s: step %d: %s", scene->obstacle->name, s, cps_outcome_name(report.outcome));
        const CpsLineView view = cps_evolution_line_view(evolution, 0);
        memcpy(track->place[s], view.position, sizeof track->place[s]);
        memcpy(track->force[s], view.segment_force, sizeof track->force[s]);
        track->bears[s] = bearing(&view, 1);
    }
    cps_evolution_destroy(evolution);
}

/* A pit of so many faces that meet at the origin, the faces rising from there: the edges between
 * them lead to these corners. Two faces are a groove, whose edge goes on behind the origin. */
typedef struct Pit {
    int faces;
    double corner[3 * 5];
    int triangle[3 * 4], triangles;
} Pit;

static Pit groove(uint64_t *random) {
    const double rise = splitmix(random, 0.1, 1.2), other = splitmix(random, 0.1, 1.2);
    Pit pit = {.faces = 2, .triangles = 4};
    const double corner[5][3] = {
        {0, 0, 0}, {30, 0, 0}, {0, 30, 30 * rise}, {-30, 0, 0}, {0, -30, 30 * other}};
    const int triangle[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    memcpy(pit.corner, corner, sizeof corner);
    memcpy(pit.triangle, triangle, sizeof triangle);
    return pit;
}

static Pit corner(uint64_t *random) {
    Pit pit = {.faces = 3, .triangles = 3};
    const int triangle[] = {0, 1, 2, 0, 2, 3, 0, 3, 1};
    memcpy(pit.triangle, triangle, sizeof triangle);
    for (int i = 0; i < 3; i++) {
        const double angle = 2.0943951 * i + splitmix(random, -0.3, 0.3);
        pit.corner[3 * (i + 1)] = 30 * cos(angle);
        pit.corner[3 * (i + 1) + 1] = 30 * sin(angle);
        pit.corner[3 * (i + 1) + 2] = splitmix(random, 6, 20);
    }
    return pit;
}

static CpsMesh *mesh_of(const Pit *pit) {
    CpsMeshTriangles of = cps_mesh_triangles_default();
    CpsMesh *mesh = NULL;
    CpsError err = {0};
    of.vertex_count = pit->triangles + 1;
    of.vertex = pit->corner;
    of.triangle_count = pit->triangles;
    of.triangle = pit->triangle;
    if (cps_mesh_create(&of, &mesh, &err)) fail_msg("%s", err.message);
    return mesh;
}

/* The planes of the faces, raised by the radius; of a groove every other triangle has a new one. */
static void planes_of(const Pit *pit, CpsObstacle plane[FACES]) {
    static const char *const NAME[FACES] = {"first", "second", "third"};
    for (int k = 0; k < pit->faces; k++) {
        const int *t = &pit->triangle[3 * (pit->faces == 2 ? 2 * k : k)];
        const double *a = &pit->corner[3 * t[1]], *b = &pit->corner[3 * t[2]];
        double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                       a[0] * b[1] - a[1] * b[0]};
        const double size = size_of(n);
        plane[k] = cps_obstacle_default();
        plane[k].name = NAME[k];
        plane[k].kind = CPS_OBSTACLE_PLANE;
        for (int i = 0; i < 3; i++) {
            plane[k].normal[i] = n[i] / size;
            plane[k].point[i] = RADIUS * n[i] / size;
        }
    }
}

/* [m] Of the highest of the planes. */
static double height_at(const CpsObstacle plane[FACES], int faces, double a, double b) {
    double most = -INFINITY;
    for (int k = 0; k < faces; k++) {
        const double *n = plane[k].normal;
        most = fmax(most,
                    plane[k].point[2] +
                        ((plane[k].point[0] - a) * n[0] + (plane[k].point[1] - b) * n[1]) / n[2]);
    }
    return most;
}

/* What two runs differ by at worst where the node touches all faces. */
typedef struct Apart {
    double place, force; /* per length, per weight */
    int steps;           /* in which it does */
} Apart;

static void set_apart(const Track *a, const Track *b, int faces, Apart *apart) {
    for (int s = 0; s <= STEPS; s++) {
        if (a->bears[s] < faces && b->bears[s] < faces) continue;
        apart->steps++;
        for (int i = 0; i < 3 * (ELEMENTS + 1); i++)
            apart->place = fmax(apart->place, fabs(a->place[s][i] - b->place[s][i]) / LENGTH);
        for (int i = 0; i < 3 * ELEMENTS; i++)
            apart->force =
                fmax(apart->force, fabs(a->force[s][i] - b->force[s][i]) / (WEIGHT * LENGTH));
    }
}

/* Run a line through the pit, on its mesh and on planes. */
static void compare(const Pit *pit, double friction, double stiffness, uint64_t *random,
                    Apart *apart) {
    static Track mesh_track, plane_track;
    CpsMesh *mesh = mesh_of(pit);
    CpsObstacle bed = cps_obstacle_default(), plane[FACES];
    bed.name = "pit";
    bed.kind = CPS_OBSTACLE_MESH;
    bed.mesh = mesh;
    bed.radius = RADIUS;
    bed.friction = friction;
    planes_of(pit, plane);
    for (int k = 0; k < pit->faces; k++) plane[k].friction = friction;
    CpsLine line = cps_line_default();
    line.name = "rope";
    line.element_count = ELEMENTS;
    line.weight = WEIGHT;
    line.stiffness = stiffness;
    line.start.kind = CPS_START_STATIC;
    const double way = splitmix(random, 0, 6.28), out = splitmix(random, 3.2, 4.2);
    for (int end = 0; end < 2; end++) {
        const double a = (end == 0 ? -out : out) * cos(way), b = (end == 0 ? -out : out) * sin(way);
        line.end[end] =
            (CpsEnd){CPS_END_KIND_HELD, {a, b, height_at(plane, pit->faces, a, b) + 0.4}};
    }
    /* taut, so that the node has one place only */
    line.length = 1.9 * fmin(size_of(line.end[0].value), size_of(line.end[1].value));
    CpsChange change[2] = {{.end = CPS_END_B, .to = line.end[CPS_END_B]},
                           {.end = CPS_END_A, .to = line.end[CPS_END_A]}};
    for (int k = 0; k < 3; k++) {
        change[0].to.value[k] += k == 2 ? splitmix(random, 0, 0.3) : splitmix(random, -0.2, 0.2);
        change[1].to.value[k] += k == 2 ? splitmix(random, 0, 0.3) : splitmix(random, -0.2, 0.2);
    }
    CpsStage stage[2] = {cps_stage_default(), cps_stage_default()};
    for (int s = 0; s < 2; s++) {
        stage[s].name = s == 0 ? "one" : "two";
        stage[s].step_count = STEPS / 2;
        stage[s].change_count = 1;
        stage[s].change = &change[s];
    }
    CpsScene scene = cps_scene_default();
    scene.gravity[2] = -9.81;
    scene.solver.tolerance = 1e-12;
    scene.line_count = 1;
    scene.line = &line;
    scene.stage_count = 2;
    scene.stage = stage;
    scene.obstacle_count = 1;
    scene.obstacle = &bed;
    follow(&scene, &mesh_track);
    scene.obstacle_count = pit->faces;
    scene.obstacle = plane;
    follow(&scene, &plane_track);
    cps_mesh_release(mesh);
    set_apart(&mesh_track, &plane_track, pit->faces, apart);
}

static void against_planes(const char *name, Pit (*make)(uint64_t *random), double within) {
    uint64_t random = 1;
    Apart apart = {0};
    for (int k = 0; k < 20; k++) {
        const Pit pit = make(&random);
        const double friction = k % 2 == 0 ? 0 : splitmix(&random, 0.05, 0.5),
                     stiffness = k % 4 < 2 ? 300 : 1000;
        compare(&pit, friction, stiffness, &random, &apart);
    }
    printf("| %s, %d steps | planes | places per length; forces per weight | 0 | %.1e; %.1e |\n",
           name, apart.steps, apart.place, apart.force);
    CHECK_LESS(apart.place, within);
    CHECK_LESS(apart.force, 1e-8);
    assert_true(apart.steps >= 100);
}

/* Along the groove a node is held by the tension alone, in the static start: there the gap of the
 * interior point, 1e-13 of the scale, is the square of an error of the place, which the last round
 * of statics takes away. */
static void a_groove(void **state) {
    (void)state;
    against_planes("groove between two faces", groove, 1e-10);
}

static void a_corner(void **state) {
    (void)state;
    against_planes("corner between three faces", corner, 1e-10);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_groove), cmocka_unit_test(a_corner)};
    return cmocka_run_group_tests_name("analytic.folds", tests, NULL, NULL);
}
