/* SPDX-License-Identifier: BSD-3-Clause */
/* An end in a set of which a plane leaves a part only (set_beside_plane.h).
 *
 * Let the end be in the set K and above the plane, g(y) = n.(y - p) >= 0, and the line of the
 * length L lead from there to a place a. For any unit vector v and lambda >= 0
 *
 *     |y - a|  >=  v.(y - a)  >=  inf over K of (v - lambda n).(y - a)  -  lambda g(a),
 *
 * since lambda (g(y) - n.(y - a)) = lambda g(a); a right side above L is a proof. It is best where
 * y is the place of both that is nearest to a. That place is the one of K nearest to a + mu n, mu
 * >= 0 the least that brings it above the plane, v = (y - a)/|y - a| and lambda = mu/|y - a|; its
 * height grows with mu, so that mu is found by bisection. The proof holds wherever that ends. */
#include "cable/set_beside_plane.h"

#include "cable/end_set.h"
#include "cable/held.h"

/* Bisections, and doublings before them. */
enum { HALVINGS = 100, DOUBLINGS = 40 };

/* An end in its set, the place that holds the line next, and the length between. */
typedef struct Reach {
    const CpsiEndSet *on;
    Vec3 from;
    double length;
} Reach;

/* The place of the set that is nearest to `from` on the free side, with mu; false where none is
 * found. */
static bool find_nearest(const Reach *reach, const CpsiObstacle *plane, Vec3 *place, double *mu) {
    const Vec3 n = cpsi_obstacle_normal(plane, reach->from);
    double low = 0, high = reach->length;
    *place = cpsi_end_set_project(reach->on, reach->from);
    if (!(cpsi_obstacle_gap(plane, *place) < 0)) return false; /* the plane takes nothing away */
    for (int k = 0;; k++) {
        *place = cpsi_end_set_project(reach->on, vec3_axpy(high, n, reach->from));
        if (cpsi_obstacle_gap(plane, *place) >= 0) break;
        if (k == DOUBLINGS) return false;
        low = high;
        high *= 2;
    }
    for (int k = 0; k < HALVINGS; k++) {
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) break;
        const Vec3 y = cpsi_end_set_project(reach->on, vec3_axpy(middle, n, reach->from));
        if (cpsi_obstacle_gap(plane, y) >= 0) {
            high = middle;
            *place = y;
        } else {
            low = middle;
        }
    }
    *mu = high;
    return true;
}

/* [m] What the line lacks, by the proof; -INFINITY: there is none. */
static double lacks(const Reach *reach, const CpsiObstacle *plane, Vec3 *apart) {
    Vec3 y;
    double mu;
    if (!find_nearest(reach, plane, &y, &mu)) return -INFINITY;
    const Vec3 way = vec3_sub(y, reach->from);
    const double size = vec3_norm(way);
    if (!(size > reach->length)) return -INFINITY;
    *apart = vec3_scale(1 / size, way);
    const Vec3 w = vec3_axpy(-mu / size, cpsi_obstacle_normal(plane, y), *apart);
    return vec3_dot(w, way) - cpsi_end_set_beyond(reach->on, vec3_scale(-1, w), y) -
           mu / size * cpsi_obstacle_gap(plane, reach->from) - reach->length;
}

/* What holds the line next to the end; false: nothing does. */
static bool find_reach(const CpsiLine *line, int end, Reach *reach) {
    int held = cpsi_line_next_held(line, 0);
    if (!line->on[end].is_there || held >= line->n) return false;
    if (end == CPS_END_B)
        for (int j = held; j < line->n; j = cpsi_line_next_held(line, j + 1)) held = j;
    const int last = end == CPS_END_A ? held : line->n - 1;
    *reach = (Reach){
        .on = &line->on[end],
        .from = cpsi_line_held_place(line, held),
        .length = cpsi_line_length_between(line, end == CPS_END_A ? 0 : held, last),
    };
    return true;
}

bool cpsi_line_misses_beside_plane(const CpsiLine *line, double share, CpsiBesidePlane *found) {
    *found = (CpsiBesidePlane){.missing = share * line->length};
    bool any = false;
    for (int end = 0; end < 2; end++) {
        Reach reach;
        if (!find_reach(line, end, &reach)) continue;
        /* where the end is now the set and all planes allow it */
        const Vec3 now = vec3_at(line->reference, end == CPS_END_A ? 0 : line->n - 1);
        if (vec3_norm(vec3_sub(now, reach.from)) <= reach.length) continue;
        for (int k = 0; k < line->obstacle_count; k++) {
            const CpsiObstacle *plane = &line->obstacle[k];
            Vec3 apart;
            if (plane->kind != CPS_OBSTACLE_PLANE || plane->stiffness > 0 ||
                !cpsi_shift_is_none(&line->shift[k]))
                continue;
            const double missing = lacks(&reach, plane, &apart);
            if (!(missing > found->missing)) continue;
            *found = (CpsiBesidePlane){.plane = k, .apart = apart, .missing = missing};
            any = true;
        }
    }
    return any;
}
