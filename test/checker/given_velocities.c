/* SPDX-License-Identifier: BSD-3-Clause */
/* The velocities that stages of one step give to ends, points and bodies, against the file.
 *
 * A point on a body moves as that does, u + w x a with a its place on the body turned with it, and
 * an end of a line as the point at which it is. In a file velocities are differences of places over
 * the span k of the step, and known to the rounding of places over k. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "failure.h"
#include "joint_motion.h"

/* Rounding of places, as a share of the largest coordinate; of angles [rad]. */
static const double PLACES = 1e-12, ANGLES = 1e-12;

/* What the scene gives in a step; NULL: nothing. */
typedef struct Given {
    const CpsScene *scene;
    const CpsStage *stage;
} Given;

static const double *of_body(const Given *given, int body) {
    for (int i = 0; given->stage && i < given->stage->body_change_count; i++) {
        const CpsBodyChange *change = &given->stage->body_change[i];
        if (change->body == body && change->has_velocity) return change->velocity;
    }
    return NULL;
}

/* A point's own, or that of its body. */
static const double *of_point(const Given *given, int point) {
    const CpsPoint *at = &given->scene->point[point];
    if (at->kind == CPS_POINT_KIND_ON_BODY) return of_body(given, at->body);
    for (int i = 0; given->stage && i < given->stage->point_change_count; i++) {
        const CpsPointChange *change = &given->stage->point_change[i];
        if (change->point == point && change->has_velocity) return change->velocity;
    }
    return NULL;
}

static const double *of_end(const Given *given, int line, int end) {
    for (int i = 0; given->stage && i < given->stage->change_count; i++) {
        const CpsChange *change = &given->stage->change[i];
        if (change->line == line && change->end == end && change->has_velocity)
            return change->velocity;
    }
    return NULL;
}

static void compare_flag(Compare *compare, const char *of, size_t step, bool said,
                         const double *given) {
    if (said != (given != NULL))
        find(compare, "velocity_given of %s in step %zu is %d, in the scene %d", of, step, said,
             given != NULL);
}

static void compare_vector(Compare *compare, const char *of, size_t step, const double *said,
                           const double *given, double noise) {
    for (int a = 0; a < 3; a++)
        if (!(fabs(said[a] - given[a]) <= noise))
            find(compare, "velocity of %s in step %zu is %.17g, in the scene %.17g", of, step,
                 said[a], given[a]);
}

static void compare_line_ends(Compare *compare, const Given *given, int index, size_t step,
                              const Record *r) {
    const CpsLine *line = &compare->scene->line[index];
    for (int e = 0; e < 2; e++) {
        const int point = r->end_point[e];
        const size_t j = e ? r->elements : 0;
        const double *own = point >= 0 ? of_point(given, point) : of_end(given, index, e);
        compare_flag(compare, line->name, step, r->velocity_given[e], own);
        if (!own || point >= 0 || r->outcome > OUTCOME_TAUT) continue;
        compare_vector(compare, line->name, step, r->velocity[j], own,
                       PLACES * (size(r->position[j]) + r->span[j] * size(own)) / r->span[j]);
    }
}

static int compare_lines(Compare *compare) {
    const Source *source = &compare->source;
    int bad = 0;
    for (size_t i = 0; i < source->lines && !bad; i++) {
        Record r = {0};
        bad = record_create(source, source->line_name[i], &r, compare->log);
        for (size_t step = 0; r.mass && step < source->steps && !bad; step++) {
            Part part;
            const bool staged = stage_of(compare, step, &part) && !is_break(source, step);
            const Given given = {compare->scene,
                                 staged ? &compare->scene->stage[part.stage] : NULL};
            bad = record_read(source, source->line_name[i], step, &r, compare->log);
            if (!bad) compare_line_ends(compare, &given, (int)i, step, &r);
        }
        record_destroy(&r);
    }
    return bad;
}

static void compare_points(Compare *compare, const Given *given, size_t step,
                           const PointMotion *point, const Junction *at) {
    for (int k = 0; k < compare->scene->point_count; k++) {
        const CpsPoint *of = &compare->scene->point[k];
        const double *own = of_point(given, k);
        compare_flag(compare, of->name, step, point[k].velocity_given, own);
        if (own && of->kind != CPS_POINT_KIND_ON_BODY)
            compare_vector(compare, of->name, step, point[k].velocity, own,
                           PLACES * (size(at[k].position) + point[k].span * size(own)) /
                               point[k].span);
    }
}

static void compare_bodies(Compare *compare, const Given *given, size_t step,
                           const BodyMotion *body, const BodyState *at) {
    for (int k = 0; k < compare->scene->body_count; k++) {
        const char *name = compare->scene->body[k].name;
        const double *own = of_body(given, k);
        compare_flag(compare, name, step, body[k].velocity_given, own);
        if (!own) continue;
        const double span = body[k].span;
        compare_vector(compare, name, step, body[k].velocity, own,
                       PLACES * (size(at[k].position) + span * size(own)) / span);
        compare_vector(compare, name, step, body[k].rate, &own[3],
                       ANGLES * (1 + span * size(&own[3])) / span);
    }
}

static int compare_joints(Compare *compare) {
    const Source *source = &compare->source;
    const size_t bodies = (size_t)compare->scene->body_count;
    PointMotion *point = calloc(source->points + 1, sizeof *point);
    Junction *junction = calloc(source->points + 1, sizeof *junction);
    BodyMotion *body = calloc(bodies + 1, sizeof *body);
    BodyState *state = calloc(bodies + 1, sizeof *state);
    Bodies all = {0};
    int bad = point && junction && body && state ? 0 : -1;
    if (!bad && bodies > 0) bad = bodies_open(source, &all, compare->log);
    for (size_t step = 0; step < source->steps && !bad; step++) {
        Part part;
        const bool staged = stage_of(compare, step, &part) && !is_break(source, step);
        const Given given = {compare->scene, staged ? &compare->scene->stage[part.stage] : NULL};
        bad = point_motions_read(source, step, point, compare->log);
        if (!bad && source->points > 0) bad = junctions_read(source, step, junction, compare->log);
        if (!bad) bad = body_motions_read(source, bodies, step, body, compare->log);
        if (!bad && bodies > 0) bad = bodies_read(source, &all, step, state, compare->log);
        if (!bad) compare_points(compare, &given, step, point, junction);
        if (!bad) compare_bodies(compare, &given, step, body, state);
    }
    if (bodies > 0) bodies_close(&all);
    free(point);
    free(junction);
    free(body);
    free(state);
    return bad;
}

int compare_velocities(Compare *compare) {
    const int bad = compare_lines(compare);
    return bad ? bad : compare_joints(compare);
}
