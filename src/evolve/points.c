/* SPDX-License-Identifier: BSD-3-Clause */
/* The data of points and their check (points.h). */
#include "evolve/points.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/status.h"
#include "evolve/anchor_check.h"
#include "evolve/bodies.h"
#include "evolve/names.h"
#include "evolve/origin.h"
#include "evolve/places.h"
#include "evolve/ranges.h"
#include "evolve/soft_check.h"
#include "evolve/water_check.h"
#include "geometry/obstacle.h"

enum { POINT_COOKIE = 0x5017e005, MAX_POINTS = 100000 };

CpsPoint cps_point_default(void) { return (CpsPoint){.cookie = POINT_COOKIE}; }

/* check ---------------------------------------------------------------------------------------- */

/* [m] By how much x lies below an obstacle, beyond rounding, and its name; else 0. */
static double depth_below(const CpsScene *scene, double length, const double x[3], bool at_start,
                          const char **name) {
    const CpsLine longest = {.length = length};
    const double above = cpsi_scene_height(scene, vec3_load(x), at_start, name);
    return above >= -cpsi_place_tolerance(&longest, vec3_load(x)) ? 0 : -above;
}

/* The names of all points, lines and obstacles, sorted. */
typedef struct Named {
    const char *name, *what;
    int index; /* of a point */
} Named;
typedef struct PointNames {
    Named *all;
    size_t count;
    double *longest; /* (points) [m] the longest line that ends there */
} PointNames;

static int by_name(const void *a, const void *b) {
    const Named *left = a, *right = b;
    const int order = strcmp(left->name, right->name);
    return order ? order : (left->index > right->index) - (left->index < right->index);
}

static void add_name(PointNames *names, const char *name, const char *what, int index) {
    if (name) names->all[names->count++] = (Named){name, what, index};
}

static bool names_make(const CpsScene *scene, PointNames *out) {
    const size_t most =
        (size_t)scene->point_count + (size_t)scene->line_count + (size_t)scene->obstacle_count;
    *out = (PointNames){.all = malloc((most + 1) * sizeof *out->all),
                        .longest = malloc(((size_t)scene->point_count + 1) * sizeof *out->longest)};
    if (!out->all || !out->longest) return false;
    cpsi_longest_lines(scene, out->longest);
    for (int i = 0; i < scene->point_count; i++) add_name(out, scene->point[i].name, "a point", i);
    for (int i = 0; i < scene->line_count; i++) add_name(out, scene->line[i].name, "a line", -1);
    for (int i = 0; i < scene->obstacle_count; i++)
        add_name(out, scene->obstacle[i].name, "an obstacle", -1);
    qsort(out->all, out->count, sizeof *out->all, by_name);
    return true;
}

static void names_free(PointNames *names) {
    free(names->all);
    free(names->longest);
}

/* What else has the name of a point, points before it included: an obstacle, else a line, else a
 * point; NULL: nothing. */
static const char *other_of_name(const PointNames *names, const char *name, int index) {
    const char *other = NULL;
    size_t low = 0, high = names->count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (strcmp(names->all[middle].name, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    for (; low < names->count && strcmp(names->all[low].name, name) == 0; low++) {
        const Named *found = &names->all[low];
        if (found->index >= index) continue;
        if (!other || strcmp(found->what, "an obstacle") == 0 || strcmp(other, "a point") == 0)
            other = found->what;
    }
    return other;
}

static CpsStatus check_name(const CpsScene *scene, const PointNames *names, int index,
                            CpsError *err) {
    const char *name = scene->point[index].name;
    const CpsStatus status = cpsi_name_check("point", index, name, err);
    if (status != CPS_OK) return status;
    const char *other = other_of_name(names, name, index);
    if (!other) return CPS_OK;
    return cpsi_fail(err, CPS_ERR_ARGUMENT, "point '%s': %s has the same name", name, other);
}

static CpsStatus check_point(const CpsScene *scene, const PointNames *names, int index,
                             CpsError *err) {
    const CpsPoint *point = &scene->point[index];
    if (point->cookie != POINT_COOKIE)
        return CPSI_FAIL_AT("points", err, CPS_ERR_ARGUMENT,
                            "point %d: not made by cps_point_default()", index + 1);
    CpsStatus status = check_name(scene, names, index, err);
    if (status != CPS_OK) return cpsi_fail_inside(err, status, "points[%d]", index + 1);
    const double length = names->longest[index];
    const char *below = "";
    const double *v = point->position, *f = point->force;
    double at[3];
    vec3_store(at, cpsi_point_begin(scene, index));
    if (point->kind < CPS_POINT_KIND_HELD || point->kind > CPS_POINT_KIND_ON_BODY)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "point '%s': unknown kind %d", point->name,
                           (int)point->kind);
    else if (!cpsi_are_usable(v))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "point '%s': it is at (%g, %g, %g) m, expected finite numbers",
                           point->name, v[0], v[1], v[2]);
    else if (!cpsi_are_usable(f) || !cpsi_is_usable(point->weight))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "point '%s': force (%g, %g, %g) N and weight %g N, expected finite "
                           "numbers",
                           point->name, f[0], f[1], f[2], point->weight);
    else if (point->kind == CPS_POINT_KIND_HELD && (f[0] != 0 || f[1] != 0 || f[2] != 0))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "point '%s': a force of (%g, %g, %g) N acts on it, but it is held: "
                           "leave the force out, or let the point be free",
                           point->name, f[0], f[1], f[2]);
    else if (point->kind == CPS_POINT_KIND_ON_BODY &&
             (f[0] != 0 || f[1] != 0 || f[2] != 0 || point->weight != 0 || point->inertia != 0))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "point '%s': it is on a body, but has a force, a weight or an inertia: "
                           "give them to the body",
                           point->name);
    else if (!(length > 0))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "point '%s': no line ends there: let an end of a line be at it, or "
                           "leave it out",
                           point->name);
    else if (depth_below(scene, length, at, true, &below) > 0)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "point '%s': it is %g m below obstacle '%s'",
                           point->name, depth_below(scene, length, at, true, &below), below);
    else if (point->kind == CPS_POINT_KIND_FREE || point->drags)
        status = cpsi_isotropy_check(scene, "point", point->name, err);
    if (status == CPS_OK) status = cpsi_water_point_check(scene, point, err);
    if (status == CPS_OK) status = cpsi_anchor_check(scene, point, length, err);
    if (status == CPS_OK) status = cpsi_soft_point_check(scene, index, err);
    if (status == CPS_OK)
        status = cpsi_gravity_check(scene, "point", point->name, point->weight != 0, err);
    return cpsi_fail_inside(err, status, "points.%s", point->name);
}

static CpsStatus check_ties(const CpsScene *scene, CpsError *err) {
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const CpsLine *line = &scene->line[i];
            const int point = cpsi_point_of(line, end);
            if (line->end[end].kind != CPS_END_KIND_POINT ||
                (point >= 0 && point < scene->point_count))
                continue;
            return CPSI_FAIL_AT("lines", err, CPS_ERR_ARGUMENT,
                                "line %d: end %s is at point %d: there are %d, the first is 0",
                                i + 1, cpsi_end_letter(end), point, scene->point_count);
        }
    return CPS_OK;
}

CpsStatus cpsi_points_check(const CpsScene *scene, CpsError *err) {
    if (scene->point_count < 0 || (scene->point_count > 0 && !scene->point))
        return CPSI_FAIL_AT("points", err, CPS_ERR_ARGUMENT, "points: found %d, expected 0 or more",
                            scene->point_count);
    if (scene->point_count > MAX_POINTS)
        return CPSI_FAIL_AT("points", err, CPS_ERR_LIMIT, "points: found %d, the limit is %d",
                            scene->point_count, (int)MAX_POINTS);
    CpsStatus status = check_ties(scene, err);
    if (status != CPS_OK || scene->point_count == 0) return status;
    PointNames names;
    if (!names_make(scene, &names))
        status = cpsi_fail(err, CPS_ERR_MEMORY, "no memory for %d points", scene->point_count);
    for (int i = 0; i < scene->point_count && status == CPS_OK; i++)
        status = check_point(scene, &names, i, err);
    names_free(&names);
    return status;
}

static CpsStatus check_change(const CpsScene *scene, const CpsStage *stage, int index,
                              const char *what, CpsError *err) {
    const CpsPointChange *change = &stage->point_change[index];
    if (change->point < 0 || change->point >= scene->point_count)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: change %d names point %d: there are %d", what,
                         index + 1, change->point, scene->point_count);
    const CpsPoint *point = &scene->point[change->point];
    const double *v = change->value;
    const char *below = "";
    const double length = cpsi_longest_line(scene, change->point);
    CpsStatus status = CPS_OK;
    for (int i = 0; i < index; i++)
        if (stage->point_change[i].point == change->point)
            status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: point '%s' is changed twice", what,
                               point->name);
    if (status == CPS_OK && point->kind == CPS_POINT_KIND_ON_BODY)
        status =
            cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: point '%s' is on a body: change the body instead",
                      what, point->name);
    if (status != CPS_OK) return cpsi_fail_inside(err, status, "%s.point", point->name);
    if (change->kind != CPS_POINT_KIND_HELD && change->kind != CPS_POINT_KIND_FREE)
        status = cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: point '%s' gets the unknown kind %d", what,
                           point->name, (int)change->kind);
    else if (!cpsi_are_usable(v))
        status = cpsi_fail(err, CPS_ERR_ARGUMENT,
                           "%s: point '%s' gets (%g, %g, %g), expected finite numbers", what,
                           point->name, v[0], v[1], v[2]);
    else if (change->kind == CPS_POINT_KIND_FREE)
        status = cpsi_isotropy_check(scene, "point", point->name, err);
    else if (depth_below(scene, length, v, false, &below) > 0)
        status =
            cpsi_fail(err, CPS_ERR_ARGUMENT, "%s: point '%s' is moved to %g m below obstacle '%s'",
                      what, point->name, depth_below(scene, length, v, false, &below), below);
    return cpsi_fail_inside(err, status, "%s.point", point->name);
}

CpsStatus cpsi_point_changes_check(const CpsScene *scene, const CpsStage *stage, const char *what,
                                   CpsError *err) {
    if (stage->point_change_count < 0 || (stage->point_change_count > 0 && !stage->point_change))
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "%s: found %d changes of points, expected 0 or more", what,
                         stage->point_change_count);
    CpsStatus status = CPS_OK;
    for (int i = 0; i < stage->point_change_count && status == CPS_OK; i++)
        status = check_change(scene, stage, i, what, err);
    return status;
}

/* data ----------------------------------------------------------------------------------------- */

Vec3 cpsi_point_begin(const CpsScene *scene, int index) {
    const CpsPoint *point = &scene->point[index];
    if (point->kind != CPS_POINT_KIND_ON_BODY) return vec3_load(point->position);
    const CpsiPose pose = cpsi_body_begin(&scene->body[point->body]);
    return cpsi_pose_place(&pose, point->position);
}

CpsStatus cpsi_held_scene(const CpsScene *scene, CpsiHeldScene *out, CpsError *err) {
    *out = (CpsiHeldScene){.scene = *scene};
    if (scene->point_count == 0) return CPS_OK;
    CpsLine *line = out->block = malloc((size_t)scene->line_count * sizeof *line);
    if (!line)
        return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for the ends of %d lines",
                         scene->line_count);
    memcpy(line, scene->line, (size_t)scene->line_count * sizeof *line);
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++) {
            const int point = cpsi_point_of(&line[i], end);
            if (point == CPSI_NO_POINT) continue;
            line[i].end[end] = (CpsEnd){.kind = CPS_END_KIND_HELD};
            vec3_store(line[i].end[end].value, cpsi_point_begin(scene, point));
        }
    out->scene.line = line;
    return CPS_OK;
}

void cpsi_points_layout(CpsiPoints *points, CpsiArena *arena, const CpsScene *scene) {
    CPSI_PLACE(arena, points->point, scene->point_count);
    CPSI_PLACE(arena, points->given, scene->point_count);
    CPSI_PLACE(arena, points->tie, 2 * (size_t)scene->line_count);
    CPSI_PLACE(arena, points->tie_given, 2 * (size_t)scene->line_count);
    CPSI_PLACE(arena, points->group, scene->point_count);
}

/* Before the first step. */
static CpsPointState state_of(CpsPointKind kind) {
    return kind == CPS_POINT_KIND_HELD   ? CPS_POINT_STATE_HELD
           : kind == CPS_POINT_KIND_FREE ? CPS_POINT_STATE_FREE
                                         : CPS_POINT_STATE_ON_BODY;
}

void cpsi_points_fill(CpsiPoints *points, const CpsScene *scene, const CpsScene *local) {
    const double pull = vec3_norm(vec3_load(scene->gravity));
    points->count = scene->point_count;
    for (int i = 0; i < scene->point_count; i++) points->point[i].length = 0;
    points->has_surface = local->has_water_surface;
    points->surface = local->has_water_surface ? local->water_surface : 0;
    for (int i = 0; i < scene->line_count; i++)
        for (int end = 0; end < 2; end++)
            points->tie[2 * i + end] = points->tie_given[2 * i + end] =
                cpsi_point_of(&scene->line[i], end);
    for (int i = 0; i < 2 * scene->line_count; i++)
        if (points->tie[i] != CPSI_NO_POINT) {
            double *longest = &points->point[points->tie[i]].length;
            *longest = fmax(*longest, scene->line[i / 2].length);
        }
    for (int i = 0; i < scene->point_count; i++) {
        const CpsPoint *from = &scene->point[i];
        CpsiPoint *point = &points->point[i];
        point->kind = from->kind;
        vec3_store(point->position, cpsi_point_begin(local, i));
        memcpy(point->before, point->position, sizeof point->before);
        memcpy(point->force, from->force, sizeof point->force);
        point->mass = pull > 0 ? from->weight / pull : 0;
        point->extent = from->height;
        point->surface = cpsi_surface_at_rest(points);
        if (scene->has_water_surface && pull > 0 && from->displaced_weight > 0) {
            point->mass = (from->weight + from->displaced_weight) / pull;
            point->displaced_mass = from->displaced_weight / pull;
        }
        point->report = (CpsPointReport){.obstacle = CPS_NO_OBSTACLE,
                                         .has_place = true,
                                         .state = state_of(from->kind)};
        memcpy(point->report.position, point->position, sizeof point->position);
        points->given[i] = *from;
        points->given[i].name = point->name;
        points->given[i].constraint.set = NULL; /* the form of which is kept alone */
    }
}

/* Those on the way there are set to what is nearer. */
int cpsi_group_first(int *group, int point) {
    while (group[point] != point) {
        group[point] = group[group[point]];
        point = group[point];
    }
    return point;
}

void cpsi_group_unite(int *group, int a, int b) {
    if (a == CPSI_NO_POINT || b == CPSI_NO_POINT) return;
    if (group[a] == CPSI_NO_POINT || group[b] == CPSI_NO_POINT) return;
    const int left = cpsi_group_first(group, a), right = cpsi_group_first(group, b);
    if (left < right)
        group[right] = left;
    else
        group[left] = right;
}

void cpsi_points_group(CpsiPoints *points, const CpsiBodies *bodies, int lines) {
    int *group = points->group;
    for (int i = 0; i < points->count; i++) {
        const CpsPoint *given = &points->given[i];
        const bool moves = points->point[i].kind == CPS_POINT_KIND_FREE ||
                           cpsi_point_drags(points, i) ||
                           (given->kind == CPS_POINT_KIND_ON_BODY &&
                            bodies->body[given->body].kind == CPS_BODY_KIND_FREE);
        group[i] = moves ? i : CPSI_NO_POINT;
    }
    for (int i = 0; i < lines; i++)
        cpsi_group_unite(group, points->tie[2 * i], points->tie[2 * i + 1]);
    for (int k = 0; k < bodies->count; k++) {
        int first = CPSI_NO_POINT;
        for (int i = 0; i < points->count; i++) {
            if (points->given[i].kind != CPS_POINT_KIND_ON_BODY || points->given[i].body != k)
                continue;
            cpsi_group_unite(group, first, i);
            if (first == CPSI_NO_POINT) first = i;
        }
    }
    for (int i = 0; i < points->count; i++)
        if (group[i] != CPSI_NO_POINT) group[i] = cpsi_group_first(group, i);
}
