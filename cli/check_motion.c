/* SPDX-License-Identifier: BSD-3-Clause */
/* What `capstan check` prints of a scene in time (see check_motion.h). */
#include "check_motion.h"

#include <math.h>
#include <stdio.h>

enum { SIX = CPS_BODY_DIRECTIONS, HEAD = 18 };

bool check_in_time(const CpsScene *scene) {
    for (int i = 0; i < scene->stage_count; i++)
        if (scene->stage[i].duration > 0) return true;
    return false;
}

static bool any(const double *value, int count) {
    for (int i = 0; i < count; i++)
        if (value[i] != 0) return true;
    return false;
}

void check_print_current(const CpsScene *scene) {
    if (!scene->current) return;
    printf("water of %g kg/m3", scene->current->density);
    for (int i = 0; i < scene->current->row_count; i++) {
        const CpsCurrentRow *row = &scene->current->row[i];
        const double *v = row->velocity;
        if (!any(v, 3) && scene->current->row_count == 1) continue;
        printf("%s (%g, %g, %g) m/s at z = %g m", i ? "," : ", current", v[0], v[1], v[2], row->z);
    }
    putchar('\n');
}

void check_print_matrix(const char *head, const double *matrix) {
    double largest = 0;
    for (int i = 0; i < SIX * SIX; i++) largest = fmax(largest, fabs(matrix[i]));
    if (largest == 0) return;
    for (int i = 0; i < SIX; i++) {
        printf("  %-*s", HEAD, i ? "" : head);
        for (int k = 0; k < SIX; k++) {
            const double value = matrix[SIX * i + k];
            printf("%s%g", k ? " " : "[", fabs(value) > 1e-16 * largest ? value : 0);
        }
        puts("]");
    }
}

static void print_velocity(const double *v, const char *unit) {
    if (any(v, 3)) printf(", velocity (%g, %g, %g) %s", v[0], v[1], v[2], unit);
}

void check_print_body_motion(const CpsScene *scene, int body) {
    const CpsBody *of = &scene->body[body];
    const double *j = of->inertia, *v = of->velocity;
    double added[SIX * SIX];
    cps_body_added_mass(scene, body, added);
    printf("  mass %g kg, moments of inertia (%g, %g, %g) kg m2", of->mass, j[0], j[1], j[2]);
    if (any(&j[3], 3)) printf(", products (%g, %g, %g) kg m2", j[3], j[4], j[5]);
    print_velocity(v, "m/s");
    if (any(&v[3], 3)) printf(", turn rate (%g, %g, %g) rad/s", v[3], v[4], v[5]);
    putchar('\n');
    check_print_matrix("added mass", added);
    check_print_matrix("damping", of->damping);
    check_print_matrix("quadratic damping", of->quadratic_damping);
    if (of->excitation_count > 0)
        printf("  excitation by waves in %d row%s\n", of->excitation_count,
               of->excitation_count == 1 ? "" : "s");
    if (of->radiation_count > 0)
        printf("  memory of radiation over %g s in %d rows\n",
               of->radiation[of->radiation_count - 1].time, of->radiation_count);
    if (of->member_count > 0)
        printf("  %d member%s, whose added mass is in the one above\n", of->member_count,
               of->member_count == 1 ? "" : "s");
}

void check_print_point_motion(const CpsPoint *point) {
    if (point->inertia > 0) printf(", moves with %g kg", point->inertia);
    print_velocity(point->velocity, "m/s");
}

/* The least and the greatest mass per length of its sections. */
static void inertia_of(const CpsLine *line, double range[2]) {
    range[0] = range[1] = line->inertia;
    for (int k = 0; k < line->section_count; k++) {
        const double inertia = line->section[k].inertia;
        range[0] = k ? fmin(range[0], inertia) : inertia;
        range[1] = k ? fmax(range[1], inertia) : inertia;
    }
}

void check_print_line_motion(const CpsScene *scene, const CpsLine *line) {
    const CpsDrag *drag = line->loads ? &line->loads->drag : NULL;
    double inertia[2];
    inertia_of(line, inertia);
    if (check_in_time(scene)) {
        if (line->quasi_static)
            printf("  moves without inertia");
        else if (inertia[1] > inertia[0])
            printf("  moves with %g to %g kg/m", inertia[0], inertia[1]);
        else
            printf("  moves with %g kg/m", inertia[0]);
        if (line->damping > 0) printf(", internal damping %g N s", line->damping);
        print_velocity(line->velocity, "m/s");
        putchar('\n');
    }
    if (!drag || !(drag->diameter > 0)) return;
    printf("  drag on a diameter of %g m: %g across, %g along", drag->diameter, drag->normal,
           drag->tangential);
    if (drag->added_normal > 0 || drag->added_tangential > 0)
        printf("; added mass %g across, %g along", drag->added_normal, drag->added_tangential);
    putchar('\n');
}

void check_print_times(const CpsScene *scene) {
    double time = 0, least = INFINITY, most = 0;
    bool adapts = false;
    for (int i = 0; i < scene->stage_count; i++) {
        const CpsStage *stage = &scene->stage[i];
        if (!(stage->duration > 0)) continue;
        const double h = stage->duration / stage->step_count;
        time += stage->duration;
        least = fmin(least, h);
        most = fmax(most, h);
        adapts = adapts || stage->error > 0;
    }
    if (!(time > 0)) return;
    printf(", %g s in time by %s, steps of %s", time,
           scene->time_scheme == CPS_TIME_SCHEME_EULER ? "euler" : "bdf2",
           adapts ? "at most " : "");
    if (least < most * (1 - 1e-9) && !adapts) printf("%g to ", least);
    printf("%g s", most);
}
