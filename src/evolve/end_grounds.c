/* SPDX-License-Identifier: BSD-3-Clause */
/* The ground under points (end_grounds.h). Of lines that meet at a point there lies as much on the
 * ground as of one line that goes through it (cable/report.c): where all go on along the ground all
 * of their half elements; else, on a plane, the share that the reaction has of what there is to
 * bear, first of the lines that go on along the ground. */
#include "evolve/end_grounds.h"

#include <math.h>
#include <string.h>

#include "cable/field.h"
#include "cable/report.h"

/* Does node j of a line touch the obstacle? */
static bool touches(const CpsiLine *line, int j, const CpsiObstacle *obstacle) {
    for (int c = j; c < cpsi_line_contacts(line); c += line->n)
        if (line->state[c] != CPS_NODE_STATE_FREE && cpsi_line_obstacle(line, c) == obstacle)
            return true;
    return false;
}

/* The point of an end, if it touches an obstacle that bears. */
static CpsiPoint *touching_point(const CpsEvolution *evolution, int line, int end) {
    const int index = evolution->points.tie[2 * line + end];
    if (index == CPSI_NO_POINT) return NULL;
    CpsiPoint *point = &evolution->points.point[index];
    const bool bears = point->report.obstacle != CPS_NO_OBSTACLE && point->report.reaction > 0;
    return bears ? point : NULL;
}

static const CpsiObstacle *under(const CpsEvolution *evolution, const CpsiPoint *point) {
    return &evolution->obstacle[point->report.obstacle];
}

/* Add what an end presses on its point. */
static void press(const CpsEvolution *evolution, CpsiPoint *point, int index, int end) {
    const CpsiLine *line = &evolution->line[index];
    const int j = cpsi_line_end_node(line, end), next = end == CPS_END_A ? j + 1 : j - 1;
    const Vec3 normal = vec3_load(point->report.normal);
    CpsiPressed *pressed = &point->pressed;
    pressed->weight -= cpsi_line_share(line, j) * vec3_dot(cpsi_line_load_at(line, j), normal);
    pressed->force += fmax(0, vec3_dot(vec3_load(line->report.end[end].force), normal));
    const bool goes_on = touches(line, next, under(evolution, point));
    *(goes_on ? &pressed->on : &pressed->off) += cpsi_line_share(line, j);
}

/* The share of the half element at an end that lies on the ground. */
static double part_of(const CpsiPoint *point, const CpsiObstacle *under, bool goes_on) {
    const CpsiPressed *pressed = &point->pressed;
    if (pressed->off == 0 || under->kind != CPS_OBSTACLE_PLANE) return 1;
    const double borne = fmin(1, point->report.reaction / pressed->weight),
                 lies = borne * (pressed->on + pressed->off);
    return goes_on ? fmin(1, lies / pressed->on) : fmax(0, lies - pressed->on) / pressed->off;
}

/* The ground at an end, once all ends at its point have pressed on it. */
static CpsiEndGround ground_of(const CpsEvolution *evolution, const CpsiPoint *point,
                               const CpsiLine *line, int end) {
    const CpsPointReport *report = &point->report;
    const CpsiPressed *pressed = &point->pressed;
    const int j = cpsi_line_end_node(line, end);
    CpsiEndGround ground = {.obstacle = under(evolution, point)};
    ground.part = part_of(point, ground.obstacle,
                          touches(line, end == CPS_END_A ? j + 1 : j - 1, ground.obstacle));
    /* as of nodes: the motion of a held one is imposed, and what is smooth does not slip */
    ground.slips =
        report->state == CPS_POINT_STATE_HELD
            ? vec3_norm(cpsi_line_end_slip(line, end, report->obstacle)) > CPS_TOUCH * line->length
            : report->state == CPS_POINT_STATE_SLIP && vec3_norm(vec3_load(report->friction)) > 0;
    if (report->state == CPS_POINT_STATE_HELD && pressed->force > 0) {
        ground.borne = fmin(1, report->reaction / pressed->force);
        memcpy(ground.normal, report->normal, sizeof ground.normal);
    }
    return ground;
}

void cpsi_end_grounds_report(CpsEvolution *evolution) {
    for (int k = 0; k < evolution->points.count; k++) {
        CpsiPoint *point = &evolution->points.point[k];
        const CpsPointReport *report = &point->report;
        point->pressed =
            (CpsiPressed){.weight = -vec3_dot(vec3_load(report->load), vec3_load(report->normal))};
    }
    for (int i = 0; i < evolution->line_count; i++)
        for (int end = 0; end < 2; end++) {
            CpsiPoint *point = touching_point(evolution, i, end);
            if (point) press(evolution, point, i, end);
        }
    for (int i = 0; i < evolution->line_count; i++) {
        CpsiLine *line = &evolution->line[i];
        bool any = false;
        for (int end = 0; end < 2; end++) {
            const CpsiPoint *point = touching_point(evolution, i, end);
            if (point) line->ground[end] = ground_of(evolution, point, line, end);
            any = any || point;
        }
        if (!any) continue;
        cpsi_line_report_lengths(line);
        cpsi_line_report_uplift(line, evolution->gravity);
    }
}
