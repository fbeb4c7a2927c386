/* SPDX-License-Identifier: BSD-3-Clause */
/* Random lines beside posts and balls (posts_scene.h). */
#include "posts_scene.h"

#include <stdlib.h>
#include <string.h>

#include "splitmix.h"

static const double PI = 3.14159265358979323846;

/* random numbers */
static uint64_t state;

static double uniform(double low, double high) { return splitmix(&state, low, high); }

static double decades(double low, double high) { return pow(10, uniform(low, high)); }
static bool chance(double probability) { return uniform(0, 1) < probability; }

/* A set of friction forces with 0 in it: a polygon about a point beside it, a segment, or a disc
 * beside it. */
static CpsSet *friction_set(void) {
    const double size = uniform(0.1, 0.5), angle = uniform(0, 2 * PI), x = size * cos(angle),
                 y = size * sin(angle), aside = uniform(-0.5, 0.5);
    const double what = uniform(0, 1);
    CpsSet *set = NULL;
    CpsError err;
    CpsStatus status;
    if (what < 0.2) {
        status = cps_set_segment(2, (double[]){-x, -y}, (double[]){aside * x + x, aside * y + y},
                                 &set, &err);
    } else if (what < 0.4) {
        status = cps_set_ball(2, (double[]){aside * x, aside * y}, size, &set, &err);
    } else {
        double points[12];
        const int count = 3 + (int)uniform(0, 4);
        for (int k = 0; k < count; k++) { /* 0 is inside: no two neighbours are half a turn apart */
            const double at = angle + 2 * PI * (k + uniform(-0.2, 0.2)) / count,
                         far = size * uniform(0.6, 1.4);
            points[2 * k] = far * cos(at);
            points[2 * k + 1] = far * sin(at);
        }
        status = cps_set_hull_of_points(2, count, points, &set, &err);
    }
    if (status != CPS_OK) {
        print_error("%s\n", err.message);
        abort();
    }
    return set;
}

static void add_friction(PostsScene *s, CpsObstacle *o) {
    if (chance(0.15)) return;
    if (s->sets) {
        o->friction_set = s->set[s->rig.scene.obstacle_count - 1] = friction_set();
        return;
    }
    o->friction = uniform(0.05, 0.6);
    if (chance(0.2)) rig_lateral(o, uniform(0.05, 0.6));
    if (chance(0.1)) o->friction_shape = CPS_FRICTION_SHAPE_BOX;
    if (chance(0.1)) {
        o->grain[0] = uniform(-1, 1);
        o->grain[2] = 1;
    }
}

/* Is there space for a post of this radius at x, y? */
static bool fits(const PostsScene *s, double x, double y, double radius) {
    for (int k = 0; k < s->rig.scene.obstacle_count; k++) {
        const CpsObstacle *o = &s->rig.obstacle[k];
        if (hypot(x - o->point[0], y - o->point[1]) < 1.15 * (radius + o->radius)) return false;
    }
    return true;
}

static void stand(PostsScene *s, double length, double radius) {
    double x = 0, y = 0;
    for (int i = 0;; i++) {
        if (i == 100) return;
        const double clearance = 0.48 * length - radius; /* clear of the paths of the ends */
        x = uniform(-0.75, 0.75) * clearance;
        y = uniform(0, 0.3) * length;
        if (fits(s, x, y, radius)) break;
    }
    const bool post = chance(0.6);
    CpsObstacle *o = rig_obstacle(&s->rig, post ? CPS_OBSTACLE_CYLINDER : CPS_OBSTACLE_SPHERE, 0);
    add_friction(s, o);
    o->radius = radius;
    o->point[0] = x;
    o->point[1] = y;
    o->axis[1] = 0;
    o->axis[2] = 1;
    if (s->flat) return;
    if (post && chance(0.4)) {
        o->axis[0] = uniform(-0.3, 0.3);
        o->axis[1] = uniform(-0.3, 0.3);
    }
    if (!post) o->point[2] = uniform(-0.3, 0.3) * radius;
}

void posts_scene_make(PostsScene *s, int number) {
    state = 7919u * (uint64_t)(number + 1);
    const double unit = chance(0.3) ? decades(-2, 2) : 1, ratio = decades(log10(0.05), 1);
    const int fewest = (int)ceil(3 / ratio),
              elements = (fewest > 4 ? fewest : 4) + (int)uniform(0, 20);
    const double length = elements * unit, radius = fmin(unit / ratio, length / 3);
    const bool pulled = chance(0.4), rigid = pulled && chance(0.3), heavy = chance(0.5);
    const double stiffness = decades(2, 4) * unit, force = 0.01 * stiffness;
    Rig *rig = &s->rig;
    rig_begin(rig, elements, heavy ? decades(-3, -1) : 0, rigid ? INFINITY : stiffness);
    rig_length(rig, length);
    s->flat = !heavy && chance(0.3);
    s->sets = number % 5 == 4;
    memset(s->set, 0, sizeof s->set);
    s->thickest = 0;
    double low = INFINITY, high = -INFINITY;
    const int wanted = 1 + (int)uniform(0, 3);
    for (int k = 0; k < wanted; k++)
        stand(s, length, radius * (wanted > 1 ? uniform(0.7, 1.3) : 1));
    for (int k = 0; k < rig->scene.obstacle_count; k++) {
        const CpsObstacle *o = &rig->obstacle[k];
        low = fmin(low, o->point[1] - 1.3 * o->radius);
        high = fmax(high, o->point[1] + o->radius);
        s->thickest = fmax(s->thickest, unit / o->radius);
    }
    const double half = (rigid ? 0.5 : 0.505) * length, y = low - uniform(0.3, 0.8) * unit,
                 up = high + uniform(0, 0.15) * length;
    rig_point(rig, -half, y, 0);
    rig_point(rig, half, y, 0);
    rig_end(rig, CPS_END_A, CPS_END_KIND_HELD, -half, y, 0);
    if (pulled)
        rig_end(rig, CPS_END_B, CPS_END_KIND_FREE, force, 0, 0);
    else
        rig_end(rig, CPS_END_B, CPS_END_KIND_HELD, half, y, 0);
    const int steps = 1 + (int)uniform(0, 30);
    rig_stage(rig, steps);
    rig_change(rig, CPS_END_A, CPS_END_KIND_HELD, -half, up,
               s->flat ? 0 : uniform(-0.05, 0.05) * length);
    if (pulled)
        rig_change(rig, CPS_END_B, CPS_END_KIND_FREE, force, 0.4 * force, 0);
    else
        rig_change(rig, CPS_END_B, CPS_END_KIND_HELD, half, up * uniform(0.5, 1), 0);
    rig_stage(rig, 1 + steps / 2);
    rig_change(rig, CPS_END_A, CPS_END_KIND_HELD, -0.98 * half, 0.8 * up, 0);
    rig->scene.friction_policy =
        chance(0.15) ? CPS_FRICTION_POLICY_FROZEN : CPS_FRICTION_POLICY_CONSISTENT;
}

void posts_scene_release(PostsScene *s) {
    for (int k = 0; k < RIG_OBSTACLES; k++) cps_set_release(s->set[k]);
}
