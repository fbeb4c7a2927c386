/* SPDX-License-Identifier: BSD-3-Clause */
/* Warnings about a step even if it is certified (see warnings.h).
 *
 * Frozen friction (S90 section 2 d) takes its bound A from the reference. Where the reaction has
 * changed much within the step, A is no longer mu R (example 11.2); where the line has left the
 * obstacle, friction still acts on it, and an equilibrium without it may be the true one (example
 * 11.3). Strict contact excludes only the penetration of obstacles that were touched before (11.1).
 * An element that lies inside a round obstacle is reported whatever the outcome: the step is then
 * not certified, except with contact of the reference.
 *
 * A step goes directly from one equilibrium to another. Where energy is created, or much of it is
 * released, the path between them was another one: the line jumped, or changed to another branch of
 * equilibria.
 *
 * A coordinate is a number of 16 digits. Far from the origin of coordinates its rounding is a
 * change of length, which causes a tension; the stiffer the line, the larger the tension.
 *
 * Where a line turns by the angle d at one node round an obstacle, the polygon can hold tensions up
 * to a ratio k, and a smooth line up to exp(mu d). The difference shows that a mesh is too coarse
 * for the bend. */
#include "run/warnings.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "printable.h"

/* Limits from which a warning is given: shares of the sum of all friction bounds; the depth of a
 * node that is no longer rounding, and the depth of an element at which it is not certified, both
 * relative to the line's length. */
static const double WARN_BOUND = 0.1, WARN_LIFTED = 0.01, WARN_SUNK = 1e-6, WARN_PIERCED = 1e-10;
/* Names of lines and points, of which longer ones are cut in warnings. */
enum { NAME_SIZE = 96 };
/* slack on more than this share of the length determines most of the answer */
static const double WARN_SLACK = 0.5;
/* ... and the tension caused by rounding of coordinates, as a share of the largest force */
static const double WARN_ROUNDED = 1e-3;
/* a buoy so far out of the water, relative to the line's length, is not there by rounding */
static const double WARN_EMERGED = 1e-6;
/* difference of the tension ratios of polygon and smooth line */
static const double WARN_BEND = 0.01;

/* share of the energy exchanged in a step above which energy released without a jump is reported */
static const double WARN_FREED = 0.5;

static double length3(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* Count the case, and keep it where it is the worst so far. */
static bool note(WorstCase *worst, double value, double of, const char *step, const char *line) {
    if (worst->steps++ > 0 && !(value > worst->value)) return false;
    worst->value = value;
    worst->of = of;
    snprintf(worst->step, sizeof worst->step, "%s", step);
    snprintf(worst->line, sizeof worst->line, "%s", line);
    return true;
}

/* ... of a case that concerns an obstacle. */
static bool note_at(WorstCase *worst, double value, double of, const char *step, const char *line,
                    const char *obstacle) {
    const bool is_worst = note(worst, value, of, step, line);
    if (is_worst) snprintf(worst->obstacle, sizeof worst->obstacle, "%s", obstacle);
    return is_worst;
}

/* friction on nodes that have left the obstacle, and the sum of all bounds [N] */
static double lifted_friction(const CpsLineView *view, double *bounds) {
    double lifted = 0;
    const double length = view->arc_length[view->element_count];
    *bounds = 0;
    const size_t nodes = (size_t)view->element_count + 1;
    for (size_t c = 0; c < (size_t)view->contact_count * nodes; ++c) {
        const size_t k = 3 * (c % nodes);
        double distance = view->gap[c];
        for (size_t x = 0; x < 3; ++x)
            distance += view->normal[3 * c + x] * (view->position[k + x] - view->reference[k + x]);
        *bounds += view->friction_bound[c];
        if (distance > CPS_TOUCH * length) lifted += length3(view->friction_force + 3 * c);
    }
    return lifted;
}

/* [J] dissipation plus positive work in a step */
static double exchanged(const CpsLedger *l) {
    return l->dissipated + fmax(0, l->ends) + fmax(0, l->obstacles) + fmax(0, l->loads) +
           fmax(0, l->winches) + fmax(0, -l->elastic) + fmax(0, -l->gravity);
}

/* Energy that the step created or released. The initial forces at held ends are not known, so their
 * work is known only to half of it. */
static void note_energy(Warnings *warnings, const CpsStepReport *step, const CpsLineReport *line,
                        const char *name, bool in_time) {
    const double beside = exchanged(&line->ledger), open = line->ledger.imbalance;
    const double freed = open - (step->step_count == 1 ? fabs(line->ledger.ends) : 0);
    const double known = line->certificate.gap + 1e-8 * line->certificate.scale;
    WorstCase *made = &warnings->kind[WARNING_MADE], *fell = &warnings->kind[WARNING_FREED];
    if (line->unaccounted > 0) {
        if (note(made, line->unaccounted, beside, step->name, name)) made->in_time = in_time;
    } else if (line->jump_count == 0 && freed > WARN_FREED * beside && freed > known) {
        if (note(fell, freed, beside, step->name, name)) fell->in_time = in_time;
    }
}

/* [N] tension caused by rounding of the largest coordinate of an end, eps |x| EA/L; not defined for
 * inextensible lines */
static double rounded_tension(const CpsLineView *view) {
    double reach = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double *b = view->position + 3 * (size_t)view->element_count;
        reach = fmax(reach,
                     fmax(fabs(view->origin[k] + view->position[k]), fabs(view->origin[k] + b[k])));
    }
    return view->compliance > 0
               ? DBL_EPSILON * reach / (view->compliance * view->arc_length[view->element_count])
               : 0;
}

/* Anchors that drag, or would have to. */
static void note_anchors(Warnings *warnings, const CpsScene *scene, const CpsEvolution *evolution,
                         const char *step) {
    for (int i = 0; i < cps_evolution_point_count(evolution); ++i) {
        const CpsPointReport at = cps_evolution_point_report(evolution, i);
        const CpsPoint *point = &scene->point[i];
        if (!at.has_place) continue;
        if (length3(at.drag) > 0)
            note(&warnings->kind[WARNING_DRAGGED], at.dragged, length3(at.drag), step, point->name);
        if (at.capacity_used > 1 && !point->drags)
            note(&warnings->kind[WARNING_CAPACITY], at.capacity_used, point->holding_capacity, step,
                 point->name);
        if (at.uplift_used > 1)
            note(&warnings->kind[WARNING_UPLIFT], at.uplift_used, point->uplift_limit, step,
                 point->name);
    }
}

/* The line `name` of the scene's file that line i is part k of, from 1, where the lines of the
 * scene meet at floats of that line (docs/formats.md); 0: it is a line of the file. */
static int part_of(const CpsScene *scene, int i, char *name, size_t size) {
    const char *own = scene->line[i].name, *dash = strrchr(own, '-');
    const int k = dash ? atoi(dash + 1) : 0;
    char at[2 * NAME_SIZE];
    if (k < 1 || (size_t)(dash - own) >= size) return 0;
    snprintf(name, size, "%.*s", (int)(dash - own), own);
    /* between this part and the one before, of the first the one behind */
    const CpsLine *line = &scene->line[i];
    const int end = k > 1 ? CPS_END_A : CPS_END_B;
    snprintf(at, sizeof at, "%s-float-%d", name, k > 1 ? k - 1 : 1);
    if (line->end[end].kind != CPS_END_KIND_POINT) return 0;
    return strcmp(scene->point[line->end_point[end]].name, at) == 0 ? k : 0;
}

/* The name that the scene's file has for line i; returns where in that line it begins [m]. */
static double written_as(const CpsScene *scene, int i, char *name, size_t size) {
    const int k = part_of(scene, i, name, size);
    double from = 0;
    if (k == 0) {
        snprintf(name, size, "%s", scene->line[i].name);
        return 0;
    }
    for (int j = 0; j < scene->line_count; ++j) {
        char other[NAME_SIZE];
        const int before = part_of(scene, j, other, sizeof other);
        if (before > 0 && before < k && strcmp(other, name) == 0) from += scene->line[j].length;
    }
    return from;
}

/* Where waves end, water still acts on lines with drag. */
static void note_dry(Warnings *warnings, const CpsScene *scene, int line, const CpsLineView *view,
                     const char *step) {
    const CpsLineLoads *loads = scene->line[line].loads;
    const double length = view->arc_length[view->element_count];
    if (!scene->current || !scene->current->waves || !loads || !(loads->drag.diameter > 0)) return;
    double highest = -INFINITY, at = 0;
    for (int j = 0; j <= view->element_count; ++j) {
        const double z = view->position[3 * j + 2] + view->origin[2];
        if (!(z > highest)) continue;
        highest = z;
        at = view->arc_length[j];
    }
    if (!(highest - scene->water_surface > WARN_EMERGED * length)) return;
    char name[NAME_SIZE];
    const double from = written_as(scene, line, name, sizeof name);
    note(&warnings->kind[WARNING_DRY], highest - scene->water_surface, from + at, step, name);
}

/* Buoys between the ends lift as if they were under water, wherever they are. */
static void note_buoys(Warnings *warnings, const CpsScene *scene, int line, const CpsLineView *view,
                       const char *step) {
    const CpsLine *given = &scene->line[line];
    const double length = view->arc_length[view->element_count];
    for (int k = 0; k < given->point_weight_count; ++k) {
        const CpsPointWeight *buoy = &given->point_weight[k];
        int node = 0;
        for (int j = 1; j < view->element_count; ++j)
            if (fabs(view->arc_length[j] - buoy->arc_length) <
                fabs(view->arc_length[node] - buoy->arc_length))
                node = j;
        const double height = view->position[3 * node + 2] + view->origin[2] - scene->water_surface;
        if (!(buoy->weight < 0 && height > WARN_EMERGED * length)) continue;
        char name[NAME_SIZE];
        const double from = written_as(scene, line, name, sizeof name);
        note(&warnings->kind[WARNING_EMERGED], height, from + view->arc_length[node], step, name);
    }
}

/* At its place on the line that the file has. */
static void keep_bend(Warnings *warnings, const CpsBend *bend, double begins) {
    warnings->bend = *bend;
    warnings->bend.arc_length += begins;
}

void warnings_note_step(Warnings *warnings, const CpsScene *scene, const CpsEvolution *evolution) {
    const CpsStepReport report = cps_evolution_report(evolution);
    const char *step = report.name;
    note_anchors(warnings, scene, evolution, step);
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        char name[NAME_SIZE];
        const double begins = written_as(scene, i, name, sizeof name);
        const double length = view.arc_length[view.element_count],
                     pierced = line.certificate.element_penetration;
        if (line.has_pierced_obstacle && pierced > WARN_PIERCED * length)
            note_at(&warnings->kind[WARNING_PIERCED], pierced, length, step, name,
                    scene->obstacle[line.pierced_obstacle].name);
        if (line.has_utilisation)
            note(&warnings->utilisation, line.utilisation, begins + line.utilisation_arc_length,
                 step, name);
        if (line.outcome != CPS_OUTCOME_SOLVED) continue;
        note_energy(warnings, &report, &line, name, cps_evolution_pace(evolution).length > 0);
        if (line.jump_count > 0)
            note(&warnings->kind[WARNING_JUMPED], line.jump, length, step, name);
        const double residual = line.certificate.friction_residual;
        double bounds;
        const double lifted = lifted_friction(&view, &bounds);
        if (scene->friction_policy == CPS_FRICTION_POLICY_FROZEN && lifted > WARN_LIFTED * bounds)
            note(&warnings->kind[WARNING_LIFTED], lifted, bounds, step, name);
        if (scene->friction_policy == CPS_FRICTION_POLICY_FROZEN &&
            residual > WARN_BOUND * bounds && bounds > 0)
            note(&warnings->kind[WARNING_BOUND], residual, bounds, step, name);
        if (scene->has_water_surface) note_buoys(warnings, scene, i, &view, step);
        note_dry(warnings, scene, i, &view, step);
        if (line.has_utilisation && line.utilisation > 1)
            note(&warnings->kind[WARNING_BROKEN], line.utilisation,
                 begins + line.utilisation_arc_length, step, name);
        const CpsBend *bend = &line.bend;
        if (bend->turn > 0 && bend->ratio > (1 + WARN_BEND) * bend->coulomb &&
            note_at(&warnings->kind[WARNING_BEND], bend->ratio / bend->coulomb, 1, step, name,
                    scene->obstacle[bend->obstacle].name))
            keep_bend(warnings, bend, begins);
        if (scene->contact_policy == CPS_CONTACT_POLICY_REFERENCE &&
            line.certificate.penetration > WARN_SUNK * length)
            note(&warnings->kind[WARNING_SUNK], line.certificate.penetration, length, step, name);
        if (line.slack > WARN_SLACK * length && line.slipping > 0)
            note(&warnings->kind[WARNING_SLACK], line.slack, length, step, name);
        if (line.places != CPS_PLACES_UNIQUE)
            note(&warnings->kind[WARNING_PLACES], (double)line.places, 0, step, name);
        const double rounded = rounded_tension(&view), force = line.certificate.largest_force;
        if (rounded > WARN_ROUNDED * force && force > 0)
            note(&warnings->kind[WARNING_ROUNDED], rounded, force, step, name);
    }
}

void warnings_print_bend(const CpsBend *bend, const char *obstacle) {
    fprintf(stderr,
            " (at %.4g m the line turns by %.4g degrees at one node round obstacle '%s', mu %.4g: "
            "it holds ",
            bend->arc_length, bend->turn * 57.29577951308232, obstacle, bend->friction);
    if (isinf(bend->ratio))
        fputs("any tension", stderr);
    else
        fprintf(stderr, "tensions up to a ratio of %.4g", bend->ratio);
    fprintf(stderr,
            ", a smooth line up to exp(mu d) = %.4g; elements no longer than %.3g m keep them "
            "within 1 %%)",
            bend->coulomb, bend->element);
}

/* What tells whether a line jumps: 'path_tolerance' divides no step in time. */
static const char *cure(bool in_time) {
    return in_time ? "shorter steps in time tell which"
                   : "smaller load steps or a 'path_tolerance' tell which";
}

static void print_figures(int kind, double value, double of, bool in_time) {
    if (kind == WARNING_BOUND)
        fprintf(stderr,
                "the friction bounds of the reference differ from mu R by %.4g N, of %.4g N in "
                "all; 'friction_policy: consistent' follows R",
                value, of);
    else if (kind == WARNING_LIFTED)
        fprintf(stderr,
                "friction of %.4g N, of bounds of %.4g N in all, acts where the line has left the "
                "obstacle, and an equilibrium without it is no solution of this step; "
                "'friction_policy: consistent' has none there",
                value, of);
    else if (kind == WARNING_BROKEN)
        fprintf(stderr, "the tension is %.3g times the breaking load, at %.6g m", value, of);
    else if (kind == WARNING_EMERGED)
        fprintf(stderr,
                "the buoy at %.6g m is %.4g m above the surface of the water, and lifts as if it "
                "were below it: give it 'floats: true', or end the line there at a free point with "
                "its mass and volume",
                of, value);
    else if (kind == WARNING_DRY)
        fprintf(
            stderr,
            "at %.6g m it is %.4g m above the surface of the water at rest, where the drag of "
            "the water and its waves act as at the surface: let a line without drag go on there",
            of, value);
    else if (kind == WARNING_DRAGGED)
        fprintf(stderr, "the anchor drags: by %.4g m in this step, by %.4g m in all", of, value);
    else if (kind == WARNING_CAPACITY)
        fprintf(stderr,
                "the force along the ground is %.4g times the holding capacity of %.4g N; 'drags: "
                "true' lets the anchor give way",
                value, of);
    else if (kind == WARNING_UPLIFT)
        fprintf(stderr, "the force up from the ground is %.4g times the uplift limit of %.4g N",
                value, of);
    else if (kind == WARNING_SLACK)
        fprintf(stderr,
                "slack over %.4g m of %.4g m: where a line has no tension its place and what "
                "friction dissipates there depend on the mesh; compare several numbers of elements",
                value, of);
    else if (kind == WARNING_PLACES)
        fprintf(stderr, "its forces leave a choice of places: %s",
                (CpsPlaces)value > CPS_PLACES_NEAREST
                    ? "one of them is taken, which says nothing of the others"
                    : "the nearest to where the step began is taken");
    else if (kind == WARNING_JUMPED)
        fprintf(stderr,
                "the line jumps by %.4g m, of %.4g m of length, however small the load steps: it "
                "comes to rest at an equilibrium, which need not be the only one",
                value, of);
    else if (kind == WARNING_MADE)
        fprintf(stderr,
                "the energy does not close by %.4g J, beside %.4g J dissipated and worked: the "
                "line jumps, takes another branch, or friction is that of the reference; %s",
                value, of, cure(in_time));
    else if (kind == WARNING_FREED)
        fprintf(
            stderr,
            "%.4g J are set free, beside %.4g J dissipated and worked: the line falls or jumps, or "
            "the load step is large; %s",
            value, of, cure(in_time));
    else if (kind == WARNING_ROUNDED)
        fprintf(stderr,
                "coordinates are so large that their last digit is worth %.4g N of tension, of "
                "%.4g N: measure places from one near the lines",
                value, of);
    else if (kind == WARNING_SUNK)
        fprintf(stderr,
                "the line is %.4g m inside the obstacle, of %.4g m of length: 'contact_policy: "
                "reference' keeps out only what touched before; 'contact_policy: reached' keeps "
                "all out",
                value, of);
    else
        fprintf(stderr,
                "the line goes through the obstacle: an element lies %.4g m inside it, more than a "
                "chord may, of %.4g m of length; take shorter elements or smaller steps",
                value, of);
}

void warnings_print(const Warnings *warnings) {
    for (int k = 0; k < WARNINGS; ++k) {
        const WorstCase *worst = &warnings->kind[k];
        if (worst->steps == 0) continue;
        fputs("capstan: warning: step ", stderr);
        cli_print_text(stderr, worst->step, 80, false);
        const bool of_point = k >= WARNING_DRAGGED && k <= WARNING_UPLIFT;
        fputs(of_point ? ", point " : ", line ", stderr);
        cli_print_text(stderr, worst->line, 80, false);
        if (k == WARNING_PIERCED) {
            fputs(", obstacle ", stderr);
            cli_print_text(stderr, worst->obstacle, 80, false);
        }
        fputs(": ", stderr);
        if (k == WARNING_BEND) {
            fputs("the mesh is coarse for a bend", stderr);
            warnings_print_bend(&warnings->bend, worst->obstacle);
        } else
            print_figures(k, worst->value, worst->of, worst->in_time);
        if (worst->steps > 1) fprintf(stderr, " (the worst of %d)", worst->steps);
        fputc('\n', stderr);
    }
}
