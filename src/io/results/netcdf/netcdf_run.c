/* SPDX-License-Identifier: BSD-3-Clause */
/* result.nc: every field of every step, classic netCDF with 64-bit offsets (CDF-2) and CF
 * attributes: the run and its lines. Obstacles are in netcdf_obstacles.c, points
 * and bodies in netcdf_points.c.
 *
 * The layout is two tables, of the arrays in a line's view (fields.c) and of the numbers in its
 * report; docs/results.md describes the file. nc_sync after each step leaves a file that can be
 * read during the run and after a crash, unless it is to be synced only at the end.
 *
 * libnetcdf keeps a list of open files and is not safe for threads, so one lock surrounds all calls
 * (the only shared state in capstan-io). */
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/status.h"
#include "capstan/two_stiffnesses.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/results/fields.h"
#include "io/results/netcdf/netcdf_file.h"
#include "io/results/netcdf/netcdf_obstacles.h"
#include "io/results/writers.h"

static pthread_mutex_t library_lock = PTHREAD_MUTEX_INITIALIZER;

enum { XYZ = 3, ENDS = 2, CONTACTS = 2, NAME_LENGTH = 96 };

/* the format's limit on one variable in one record, in bytes (the specification of CDF-2) */
static const uint64_t MAX_RECORD = 4294967292;

#define REPORT(member)          CPSI_MEMBER(CpsLineReport, member)
#define REPORT_IF(flag, member) CPSI_MEMBER_IF(CpsLineReport, flag, member)
#define CERTIFICATE(member)     REPORT(certificate.member)

/* A number of a struct. */
typedef struct Number {
    const char *name, *long_name, *units;
    CpsiMember member;
} Number;

/* Numbers of CpsLineReport. */
static const Number NUMBER[] = {
    {"primal", "energy and friction work of the configuration", "J", CERTIFICATE(primal)},
    {"dual", "lower bound of the minimum, from the forces", "J", CERTIFICATE(dual)},
    {"gap", "sum of the local gaps", "J", CERTIFICATE(gap)},
    {"scale", "scale of the gap", "J", CERTIFICATE(scale)},
    {"tension_bound", "guaranteed rms error of the tension", "N",
     REPORT_IF(certificate.has_tension_bound, certificate.tension_bound)},
    {"tension_mesh", "estimated error of the tension by the elements' lengths", "N",
     REPORT_IF(has_tension_mesh, tension_mesh)},
    {"utilisation", "largest tension over the breaking load", "1",
     REPORT_IF(has_utilisation, utilisation)},
    {"utilisation_at", "arc length there", "m", REPORT_IF(has_utilisation, utilisation_arc_length)},
    {"tension_estimate", "largest difference of elongation and equilibrium tension", "N",
     CERTIFICATE(tension_estimate)},
    {"force_residual", "largest imbalance of forces on a node", "N", CERTIFICATE(force_residual)},
    {"largest_force", "largest force in the line or on it", "N", CERTIFICATE(largest_force)},
    {"law_residual", "sum of dissipation and work of the friction force", "J",
     CERTIFICATE(law_residual)},
    {"contact_residual", "sum of reaction times distance", "J", CERTIFICATE(contact_residual)},
    {"friction_residual", "sum of friction bounds used less mu times the reactions found, in size",
     "N", CERTIFICATE(friction_residual)},
    {"element_push", "largest part of an element's force that points against it", "N",
     CERTIFICATE(element_push)},
    {"elongation_residual",
     "largest elongation of an elastic element that its force does not explain", "1",
     CERTIFICATE(elongation_residual)},
    {"stretch_residual", "largest stretch of an inextensible element", "1",
     CERTIFICATE(stretch_residual)},
    {"penetration", "depth of the deepest node below the obstacle", "m", CERTIFICATE(penetration)},
    {"element_penetration",
     "depth of the deepest element inside a round obstacle, beyond what its chord may cut in", "m",
     CERTIFICATE(element_penetration)},
    {"dissipated", "energy dissipated by friction in the step", "J", REPORT(dissipated)},
    {"share", "share of the step that the last substep was, which the arrays show", "1",
     REPORT(share)},
    {"jump", "longest displacement of a node in a jump", "m", REPORT(jump)},
    {"bend_turn", "turn of the line at the contact where the mesh changes the law of friction most",
     "rad", REPORT(bend.turn)},
    {"bend_friction", "coefficient along the line there", "1", REPORT(bend.friction)},
    {"bend_at", "arc length there", "m", REPORT(bend.arc_length)},
    {"ledger_elastic", "growth of the energy of elongation", "J", REPORT(ledger.elastic)},
    {"ledger_gravity", "growth of the weight's potential", "J", REPORT(ledger.gravity)},
    {"ledger_ends", "work of the forces at the ends", "J", REPORT(ledger.ends)},
    {"ledger_obstacles", "work of obstacles that turn or move", "J", REPORT(ledger.obstacles)},
    {"ledger_imbalance", "what the ledger does not close by", "J", REPORT(ledger.imbalance)},
    {"unaccounted",
     "of that, more than 5 % of the energies of substeps that could not be halved any more", "J",
     REPORT(unaccounted)},
    {"proof_length", "infeasible: what is missing of the length, else 0", "m",
     REPORT(proof_length)},
    {"proof_force",
     "unbounded: fall of energy per metre; slides: least power per unit of speed; else 0", "N",
     REPORT(proof_force)},
};

/* Numbers of CpsFrictionZone. */
static const Number ZONE[] = {
    {"zone_from", "natural abscissa at which the stretch begins", "m",
     CPSI_MEMBER(CpsFrictionZone, from)},
    {"zone_to", "natural abscissa at which it ends", "m", CPSI_MEMBER(CpsFrictionZone, to)},
    {"zone_factor", "factor of the friction of whatever it touches, 1 elsewhere", "1",
     CPSI_MEMBER(CpsFrictionZone, factor)},
};

/* Of lines with springs or loads. */
static const Number LOAD[] = {
    {"ledger_loads", "work of springs, loads, drag and potential", "J", REPORT(ledger.loads)},
    {"load_residual",
     "sum over the nodes of drag and potential used less those where they are, in size", "N",
     CERTIFICATE(load_residual)},
};

/* Numbers of CpsTensionRange, of each end. */
static const Number RANGE[] = {
    {"end_tension_least",
     "least tension of the end's element by forces that hold the line where it is", "N",
     CPSI_MEMBER_IF(CpsTensionRange, has_values, least)},
    {"end_tension_least_bound", "bound of it", "N",
     CPSI_MEMBER_IF(CpsTensionRange, has_values, least_bound)},
    {"end_tension_greatest", "the greatest, infinite where there is none", "N",
     CPSI_MEMBER_IF(CpsTensionRange, has_values, greatest)},
    {"end_tension_greatest_bound", "bound of it", "N",
     CPSI_MEMBER_IF(CpsTensionRange, has_values, greatest_bound)},
};

enum {
    RANGES = sizeof RANGE / sizeof RANGE[0],
    FIELDS = CPSI_FIELDS,
    NUMBERS = sizeof NUMBER / sizeof NUMBER[0],
    LOADS = sizeof LOAD / sizeof LOAD[0],
    ZONES = sizeof ZONE / sizeof ZONE[0]
};

typedef struct LineIds {
    int node, element; /* dimensions */
    int contacts;      /* of a node, as in the view */
    int compliance, state[CONTACTS], obstacle[CONTACTS], end_kind, end_held_position,
        end_applied_force, end_force, end_friction_force, end_tension, end_range[RANGES], outcome,
        iterations, substeps, jumps, places, proof, proof_obstacle, proof_plane, weight_before;
    int field[FIELDS][CONTACTS];         /* unused where a view has no such array */
    int element_obstacle, element_state; /* the same */
    int number[NUMBERS];
    int zone[ZONES];                                     /* unused without zones */
    int load[LOADS];                                     /* unused without loads */
    int compliance_factor, weight_length;                /* unused where the line is uniform */
    int spring_element, spring_strain, spring_stiffness; /* unused where there is none */
    int breaking_load;                                   /* the same */
    int end_point;                                       /* unused without points */
    CpsiNetcdfStiffnesses stiffnesses;
    CpsiNetcdfGrasps grasps;
    CpsiNetcdfWinches winches;
    CpsiNetcdfSets sets;
    CpsiNetcdfPotential potential;
    CpsiNetcdfWater water;
    CpsiNetcdfFailure failure;
    CpsiNetcdfMotion motion;
} LineIds;

struct CpsiNetcdf {
    CpsiNetcdfFile file;
    char *folder;    /* for messages */
    bool open, sync; /* sync: after each step */
    unsigned wanted; /* fields.h */
    size_t steps;
    int step, xyz, end, name_length; /* dimensions */
    int step_name, outcome, wall;
    CpsiNetcdfObstacles obstacles;
    CpsiNetcdfPoints points;
    CpsiNetcdfBodies bodies;
    CpsiNetcdfBreaks breaks;
    CpsiNetcdfTime time;
    int line_count;
    LineIds *line;
};

static CpsStatus result_of(const CpsiNetcdf *nc, CpsError *err) {
    if (nc->file.status == NC_NOERR) return CPS_OK;
    return cpsi_fail(err, nc->file.status == NC_ENOMEM ? CPS_ERR_MEMORY : CPS_ERR_IO,
                     "cannot write %s/result.nc: %s; earlier results are kept", nc->folder,
                     nc->file.library.strerror(nc->file.status));
}

#define OUTCOME_WORD(name, number, key, sentence)   " " key
#define OUTCOME_NUMBER(name, number, key, sentence) number,
static const char OUTCOME_MEANINGS[] = CPS_OUTCOME_LIST(OUTCOME_WORD); /* begins with a blank */
static const int OUTCOME_VALUES[] = {CPS_OUTCOME_LIST(OUTCOME_NUMBER)};

static int add_outcome(CpsiNetcdf *nc, const char *prefix) {
    const int id = cpsi_netcdf_variable(&nc->file, prefix, "outcome", NC_INT, 1, &nc->step,
                                        "what came of the step", "1");
    cpsi_netcdf_flags(&nc->file, id, NC_INT, sizeof OUTCOME_VALUES / sizeof *OUTCOME_VALUES,
                      OUTCOME_VALUES, OUTCOME_MEANINGS + 1);
    return id;
}

static void define_run(CpsiNetcdf *nc, const CpsScene *scene, const double origin[XYZ],
                       const char *names) {
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "Conventions", "CF-1.8");
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "title", scene->title ? scene->title : "");
    char source[64];
    snprintf(source, sizeof source, "capstan %s", cps_version());
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "source", source);
    cpsi_netcdf_history(&nc->file, source);
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "lines", names);
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "friction_policy",
                     scene->friction_policy == CPS_FRICTION_POLICY_CONSISTENT ? "consistent"
                                                                              : "frozen");
    cpsi_netcdf_text(&nc->file, NC_GLOBAL, "contact_policy",
                     scene->contact_policy == CPS_CONTACT_POLICY_REFERENCE ? "reference"
                                                                           : "reached");
    cpsi_netcdf_numbers(&nc->file, "gravity", XYZ, scene->gravity);
    cpsi_netcdf_numbers(&nc->file, "tolerance", 1, &scene->solver.tolerance);
    if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0)
        cpsi_netcdf_numbers(&nc->file, "origin", XYZ, origin);
    const double surface = scene->water_surface - origin[2];
    if (scene->has_water_surface) cpsi_netcdf_numbers(&nc->file, "water_surface", 1, &surface);

    nc->step = cpsi_netcdf_dimension(&nc->file, "step", NC_UNLIMITED);
    nc->xyz = cpsi_netcdf_dimension(&nc->file, "xyz", XYZ);
    nc->end = cpsi_netcdf_dimension(&nc->file, "end", ENDS);
    nc->name_length = cpsi_netcdf_dimension(&nc->file, "name_length", NAME_LENGTH);
    const int shape[] = {nc->step, nc->name_length};
    nc->step_name = cpsi_netcdf_variable(&nc->file, "", "step_name", NC_CHAR, 2, shape,
                                         "name of the step", NULL);
    nc->outcome = add_outcome(nc, "");
    nc->wall = cpsi_netcdf_variable(&nc->file, "", "wall", NC_DOUBLE, 1, &nc->step,
                                    "time taken by the step", "s");
    cpsi_netcdf_define_obstacles(&nc->file, &nc->obstacles, scene, nc->step, nc->xyz);
    cpsi_netcdf_define_points(&nc->file, &nc->points, scene, nc->step, nc->xyz, origin);
    cpsi_netcdf_define_bodies(&nc->file, &nc->bodies, &nc->points, scene, nc->step, nc->xyz);
    cpsi_netcdf_define_breaks(&nc->file, &nc->breaks, scene, nc->step);
    cpsi_netcdf_define_time(&nc->file, &nc->time, scene, nc->step);
}

/* "LINE_NAME" of a node's first contact, "LINE_NAME_second" of its second. */
static int add_contact(CpsiNetcdf *nc, const char *line, const char *name, int contact,
                       nc_type type, int rank, const int *shape, const char *long_name,
                       const char *units) {
    char full[64], meaning[128];
    snprintf(full, sizeof full, "%s%s", name, contact ? "_second" : "");
    snprintf(meaning, sizeof meaning, "%s%s", long_name, contact ? ": the next nearest" : "");
    return cpsi_netcdf_variable(&nc->file, line, full, type, rank, shape, meaning, units);
}

static bool is_wanted(const CpsiNetcdf *nc, int f) {
    return cpsi_field[f].fixed || (nc->wanted >> f & 1u);
}

static const double *in_view(const CpsLineView *view, const CpsiField *field) {
    const double *array;
    memcpy(&array, (const char *)view + field->offset, sizeof array);
    return array;
}

static bool is_of_nodes(const CpsiField *field) {
    return field->place == CPSI_PLACE_NODE || field->place == CPSI_PLACE_SPRING ||
           field->place == CPSI_PLACE_LOAD;
}

/* Contacts of elements, and what acts on nodes, are written only where there are any. */
static bool has_field(const CpsLineView *view, const CpsiField *field) {
    if (field->place == CPSI_PLACE_SPRING) return view->has_springs;
    if (field->place == CPSI_PLACE_LOAD) return view->has_node_loads;
    return field->place != CPSI_PLACE_ELEMENT_CONTACT || view->has_element_contacts;
}

static void define_field(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view, int f) {
    const CpsiField *field = &cpsi_field[f];
    const char *line = view->name;
    if (!is_wanted(nc, f) || !has_field(view, field)) return;
    const int along = is_of_nodes(field) ? ids->node : ids->element;
    const int shape[] = {nc->step, along, nc->xyz};
    const int rank = 1 + !field->fixed + field->vector;
    for (int c = 0; c < (field->contact ? ids->contacts : 1); ++c)
        ids->field[f][c] =
            add_contact(nc, line, field->name, c, NC_DOUBLE, rank, field->fixed ? shape + 1 : shape,
                        field->long_name, field->units);
}

static void define_zones(CpsiNetcdf *nc, LineIds *ids, const CpsLine *line) {
    if (line->zone_count == 0) return;
    char name[NC_MAX_NAME + 1];
    snprintf(name, sizeof name, "%.200s_zone", line->name);
    const int zone = cpsi_netcdf_dimension(&nc->file, name, (size_t)line->zone_count);
    for (int i = 0; i < ZONES; ++i)
        ids->zone[i] = cpsi_netcdf_variable(&nc->file, line->name, ZONE[i].name, NC_DOUBLE, 1,
                                            &zone, ZONE[i].long_name, ZONE[i].units);
}

static bool has_loads(const CpsLineView *view) { return view->has_springs || view->has_node_loads; }

static void define_loads(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    if (!has_loads(view)) return;
    for (int i = 0; i < LOADS; ++i)
        ids->load[i] = cpsi_netcdf_variable(&nc->file, view->name, LOAD[i].name, NC_DOUBLE, 1,
                                            &nc->step, LOAD[i].long_name, LOAD[i].units);
}

/* The view of a line whose elements are those of its static stiffness: what is written once. */
static CpsLineView constant_view(const CpsEvolution *evolution, int line) {
    CpsLineView view = cps_evolution_line_view(evolution, line);
    const CpsTwoStiffnesses two = cps_evolution_two_stiffnesses(evolution, line);
    if (!two.exists) return view;
    view.element_length = two.element_length;
    view.compliance_factor = two.at_static.compliance_factor;
    view.spring_count = two.at_static.spring_count;
    view.spring_element = two.at_static.spring_element;
    view.spring_strain = two.at_static.spring_strain;
    view.spring_stiffness = two.at_static.spring_stiffness;
    return view;
}

/* What tables of strain and tension add to 1/compliance. */
static void define_springs(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    char name[NC_MAX_NAME + 1];
    snprintf(name, sizeof name, "%.200s_spring", view->name);
    const int spring = cpsi_netcdf_dimension(&nc->file, name, (size_t)view->spring_count);
    ids->spring_element =
        cpsi_netcdf_variable(&nc->file, view->name, "spring_element", NC_INT, 1, &spring,
                             "element whose stiffness grows at a strain", "1");
    ids->spring_strain = cpsi_netcdf_variable(&nc->file, view->name, "spring_strain", NC_DOUBLE, 1,
                                              &spring, "strain from which on it grows", "1");
    ids->spring_stiffness =
        cpsi_netcdf_variable(&nc->file, view->name, "spring_stiffness", NC_DOUBLE, 1, &spring,
                             "by how much EA grows there", "N");
}

/* What differs along a line of sections or with point weights, and what breaks. */
static void define_sections(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    if (view->has_breaking_load) {
        ids->breaking_load =
            cpsi_netcdf_variable(&nc->file, view->name, "breaking_load", NC_DOUBLE, 1,
                                 &ids->element,
                                 "tension at which the element breaks, infinite: none given", "N");
    }
    if (view->spring_count > 0) define_springs(nc, ids, view);
    if (view->uniform) return;
    ids->compliance_factor =
        cpsi_netcdf_variable(&nc->file, view->name, "compliance_factor", NC_DOUBLE, 1,
                             &ids->element,
                             "1/EA of the element over the compliance, which is the mean", "1");
    if (ids->winches.is_there) return; /* it has one in every step */
    ids->weight_length = cpsi_netcdf_variable(
        &nc->file, view->name, "weight_length", NC_DOUBLE, 1, &ids->node,
        "natural length of mean weight that the node carries, negative: it is lifted", "m");
}

/* Which points the ends are at, in a scene that has points. */
static void define_end_points(CpsiNetcdf *nc, LineIds *ids, const CpsLine *line) {
    if (nc->points.count > 0)
        ids->end_point =
            cpsi_netcdf_variable(&nc->file, line->name, "end_point", NC_INT, 1, &nc->end,
                                 "point at which A and B end, -1: none", "1");
}

static void define_element_contacts(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    const int on_elements[] = {nc->step, ids->element};
    if (view->has_element_contacts && (nc->wanted & CPSI_WANTED_OBSTACLE))
        ids->element_obstacle = cpsi_netcdf_variable(
            &nc->file, view->name, "element_obstacle", NC_INT, 2, on_elements,
            "place of the obstacle that an element touches in the scene, -1: none", "1");
    if (view->has_element_contacts && (nc->wanted & CPSI_WANTED_STATE)) {
        ids->element_state = cpsi_netcdf_variable(&nc->file, view->name, "element_state", NC_BYTE,
                                                  2, on_elements, "rest of the element on it", "1");
        cpsi_netcdf_flags(&nc->file, ids->element_state, NC_BYTE, 4, NULL,
                          "free stick slip unresolved");
    }
}

static void define_line(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    char name[NC_MAX_NAME + 1];
    snprintf(name, sizeof name, "%.200s_node", view->name);
    ids->node = cpsi_netcdf_dimension(&nc->file, name, (size_t)view->element_count + 1);
    snprintf(name, sizeof name, "%.200s_element", view->name);
    ids->element = cpsi_netcdf_dimension(&nc->file, name, (size_t)view->element_count);

    ids->contacts = view->contact_count;
    for (int f = 0; f < FIELDS; ++f) define_field(nc, ids, view, f);
    ids->compliance = cpsi_netcdf_variable(&nc->file, view->name, "compliance", NC_DOUBLE, 0, NULL,
                                           "1/EA, 0: inextensible", "N-1");
    define_sections(nc, ids, view);
    const int on_nodes[] = {nc->step, ids->node}, on_ends[] = {nc->step, nc->end, nc->xyz};
    for (int c = 0; c < ids->contacts; ++c) {
        if (nc->wanted & CPSI_WANTED_STATE) {
            ids->state[c] = add_contact(nc, view->name, "state", c, NC_BYTE, 2, on_nodes,
                                        "rest on the obstacle", "1");
            cpsi_netcdf_flags(&nc->file, ids->state[c], NC_BYTE, 4, NULL,
                              "free stick slip unresolved");
        }
        if (ids->contacts < 2 || !(nc->wanted & CPSI_WANTED_OBSTACLE)) continue;
        ids->obstacle[c] = add_contact(nc, view->name, "obstacle", c, NC_INT, 2, on_nodes,
                                       "place of the obstacle in the scene", "1");
    }
    define_element_contacts(nc, ids, view);
    ids->end_kind = cpsi_netcdf_variable(&nc->file, view->name, "end_kind", NC_BYTE, 2, on_ends,
                                         "what is imposed at A and B", "1");
    cpsi_netcdf_flags(&nc->file, ids->end_kind, NC_BYTE, 2, NULL, "held free");
    ids->end_held_position =
        cpsi_netcdf_variable(&nc->file, view->name, "end_held_position", NC_DOUBLE, 3, on_ends,
                             "imposed position of a held end", "m");
    ids->end_applied_force =
        cpsi_netcdf_variable(&nc->file, view->name, "end_applied_force", NC_DOUBLE, 3, on_ends,
                             "imposed force on a free end", "N");
    cpsi_netcdf_may_miss(&nc->file, ids->end_held_position);
    cpsi_netcdf_may_miss(&nc->file, ids->end_applied_force);
    ids->end_force = cpsi_netcdf_variable(&nc->file, view->name, "end_force", NC_DOUBLE, 3, on_ends,
                                          "force on the line at its ends", "N");
    ids->end_friction_force = cpsi_netcdf_variable(
        &nc->file, view->name, "end_friction_force", NC_DOUBLE, 3, on_ends,
        "friction of the half element beside a held end that lies on an obstacle", "N");
    ids->end_tension = cpsi_netcdf_variable(&nc->file, view->name, "end_tension", NC_DOUBLE, 2,
                                            on_ends, "tension of the line at its ends", "N");
    for (int i = 0; i < RANGES; ++i) {
        ids->end_range[i] = cpsi_netcdf_variable(&nc->file, view->name, RANGE[i].name, NC_DOUBLE, 2,
                                                 on_ends, RANGE[i].long_name, RANGE[i].units);
        cpsi_netcdf_may_miss(&nc->file, ids->end_range[i]);
    }
    ids->outcome = add_outcome(nc, view->name);
    ids->iterations = cpsi_netcdf_variable(&nc->file, view->name, "iterations", NC_INT, 1,
                                           &nc->step, "interior-point iterations", "1");
    ids->substeps = cpsi_netcdf_variable(&nc->file, view->name, "substeps", NC_INT, 1, &nc->step,
                                         "substeps that the step was taken in", "1");
    ids->jumps = cpsi_netcdf_variable(&nc->file, view->name, "jumps", NC_INT, 1, &nc->step,
                                      "substeps in which the line jumped", "1");
    ids->places = cpsi_netcdf_variable(
        &nc->file, view->name, "places_not_unique", NC_INT, 1, &nc->step,
        "do the forces leave a choice of places; 0: no, 1: the nearest is taken, 2: one of them",
        "1");
    cpsi_netcdf_flags(&nc->file, ids->places, NC_INT, 3, NULL, "unique nearest any");
    const int vectors[] = {nc->step, nc->xyz};
    ids->proof = cpsi_netcdf_variable(&nc->file, view->name, "proof", NC_DOUBLE, 2, vectors,
                                      "direction that proves no solution", "1");
    ids->proof_obstacle =
        cpsi_netcdf_variable(&nc->file, view->name, "proof_obstacle", NC_INT, 1, &nc->step,
                             "infeasible: the obstacle that the line does not reach round, passes: "
                             "that it passes; -1: none",
                             "1");
    ids->proof_plane = cpsi_netcdf_variable(
        &nc->file, view->name, "proof_plane", NC_INT, 1, &nc->step,
        "infeasible: the plane between which and proof_obstacle it is caught; -1: none", "1");
    ids->weight_before =
        cpsi_netcdf_variable(&nc->file, view->name, "weight_before", NC_DOUBLE, 2, vectors,
                             "weight per natural length where the step, or its last part, began",
                             "N m-1");
    for (int i = 0; i < NUMBERS; ++i) {
        ids->number[i] = cpsi_netcdf_variable(&nc->file, view->name, NUMBER[i].name, NC_DOUBLE, 1,
                                              &nc->step, NUMBER[i].long_name, NUMBER[i].units);
        if (NUMBER[i].member.flag) cpsi_netcdf_may_miss(&nc->file, ids->number[i]);
    }
}

static const size_t ONE[] = {1}; /* count of a single number */

/* the fields that do not change (fixed), or those of a step; an array of contacts has the first of
 * all nodes first */
static void write_fields(CpsiNetcdf *nc, const LineIds *ids, const CpsLineView *view, bool fixed) {
    for (int f = 0; f < FIELDS; ++f) {
        const CpsiField *field = &cpsi_field[f];
        if (field->fixed != fixed || !is_wanted(nc, f) || !has_field(view, field)) continue;
        const size_t along = (size_t)view->element_count + is_of_nodes(field);
        const size_t start[] = {nc->steps, 0, 0}, count[] = {1, along, XYZ};
        const double *array = in_view(view, field);
        if (ids->winches.is_there && array == view->element_length)
            array = ids->winches.whole_length;
        for (int c = 0; c < (field->contact ? ids->contacts : 1);
             ++c, array += along * (field->vector ? XYZ : 1))
            cpsi_netcdf_doubles(&nc->file, ids->field[f][c], start + fixed, count + fixed, array);
    }
}

static void write_line(CpsiNetcdf *nc, const LineIds *ids, const CpsLineView *view,
                       const CpsLineReport *report) {
    write_fields(nc, ids, view, false);
    const size_t start[] = {nc->steps, 0, 0};
    const size_t nodes[] = {1, (size_t)view->element_count + 1}, ends[] = {1, ENDS, XYZ},
                 vector[] = {1, XYZ};
    for (int c = 0; c < ids->contacts && nc->file.status == NC_NOERR; ++c) {
        const size_t from = (size_t)c * nodes[1];
        if (nc->wanted & CPSI_WANTED_STATE)
            cpsi_netcdf_bytes(&nc->file, ids->state[c], start, nodes, view->state + from);
        if (ids->contacts < 2 || !(nc->wanted & CPSI_WANTED_OBSTACLE)) continue;
        cpsi_netcdf_ints(&nc->file, ids->obstacle[c], start, nodes, view->obstacle + from);
    }

    const size_t elements[] = {1, (size_t)view->element_count};
    if (view->has_element_contacts && (nc->wanted & CPSI_WANTED_OBSTACLE))
        cpsi_netcdf_ints(&nc->file, ids->element_obstacle, start, elements, view->element_obstacle);
    if (view->has_element_contacts && (nc->wanted & CPSI_WANTED_STATE))
        cpsi_netcdf_bytes(&nc->file, ids->element_state, start, elements, view->element_state);

    unsigned char kind[ENDS];
    double position[ENDS][XYZ], applied[ENDS][XYZ], force[ENDS][XYZ], friction[ENDS][XYZ],
        tension[ENDS];
    for (int e = 0; e < ENDS; ++e) {
        kind[e] = view->end[e].kind == CPS_END_KIND_FREE;
        for (int k = 0; k < XYZ; ++k) {
            position[e][k] = kind[e] ? NAN : view->end[e].value[k];
            applied[e][k] = kind[e] ? view->end[e].value[k] : NAN;
        }
        memcpy(force[e], report->end[e].force, sizeof force[e]);
        memcpy(friction[e], report->end[e].friction_force, sizeof friction[e]);
        tension[e] = report->end[e].tension;
    }
    cpsi_netcdf_bytes(&nc->file, ids->end_kind, start, ends, kind);
    cpsi_netcdf_doubles(&nc->file, ids->end_held_position, start, ends, position[0]);
    cpsi_netcdf_doubles(&nc->file, ids->end_applied_force, start, ends, applied[0]);
    cpsi_netcdf_doubles(&nc->file, ids->end_force, start, ends, force[0]);
    cpsi_netcdf_doubles(&nc->file, ids->end_friction_force, start, ends, friction[0]);
    cpsi_netcdf_doubles(&nc->file, ids->end_tension, start, ends, tension);
    for (int i = 0; i < RANGES; ++i) {
        double range[ENDS];
        for (int e = 0; e < ENDS; ++e)
            range[e] = cpsi_member(&report->end[e].range, RANGE[i].member);
        cpsi_netcdf_doubles(&nc->file, ids->end_range[i], start, ends, range);
    }
    cpsi_netcdf_append_grasps(&nc->file, &ids->grasps, nc->steps, view);
    cpsi_netcdf_doubles(&nc->file, ids->proof, start, vector, report->proof);
    cpsi_netcdf_doubles(&nc->file, ids->weight_before, start, vector, view->weight_before);

    cpsi_netcdf_int(&nc->file, ids->outcome, start, (int)report->outcome);
    cpsi_netcdf_int(&nc->file, ids->iterations, start, report->iteration_count);
    cpsi_netcdf_int(&nc->file, ids->substeps, start, report->substep_count);
    cpsi_netcdf_int(&nc->file, ids->jumps, start, report->jump_count);
    cpsi_netcdf_int(&nc->file, ids->places, start, (int)report->places);
    cpsi_netcdf_int(&nc->file, ids->proof_obstacle, start,
                    report->has_proof_obstacle ? report->proof_obstacle : CPS_NO_OBSTACLE);
    cpsi_netcdf_int(&nc->file, ids->proof_plane, start,
                    report->has_proof_plane ? report->proof_plane : CPS_NO_OBSTACLE);
    for (int i = 0; i < NUMBERS; ++i) {
        const double number = cpsi_member(report, NUMBER[i].member);
        cpsi_netcdf_doubles(&nc->file, ids->number[i], start, ONE, &number);
    }
    for (int i = 0; i < LOADS && has_loads(view); ++i) {
        const double number = cpsi_member(report, LOAD[i].member);
        cpsi_netcdf_doubles(&nc->file, ids->load[i], start, ONE, &number);
    }
}

static void write_end_points(CpsiNetcdf *nc, const LineIds *ids, const CpsLine *line) {
    for (size_t e = 0; e < ENDS && nc->points.count > 0; ++e)
        cpsi_netcdf_int(&nc->file, ids->end_point, &e,
                        line->end[e].kind == CPS_END_KIND_POINT ? line->end_point[e] : -1);
}

static void write_zones(CpsiNetcdf *nc, const LineIds *ids, const CpsLine *line) {
    for (size_t k = 0; k < (size_t)line->zone_count; ++k)
        for (int i = 0; i < ZONES; ++i) {
            const double number = cpsi_member(&line->zone[k], ZONE[i].member);
            cpsi_netcdf_doubles(&nc->file, ids->zone[i], &k, ONE, &number);
        }
}

/* What differs along a line of sections or with point weights, and what breaks. */
static void write_sections(CpsiNetcdf *nc, const LineIds *ids, const CpsLineView *view) {
    const size_t first = 0, elements = (size_t)view->element_count, nodes = elements + 1;
    if (view->has_breaking_load)
        cpsi_netcdf_doubles(&nc->file, ids->breaking_load, &first, &elements, view->breaking_load);
    if (view->spring_count > 0) {
        const size_t springs = (size_t)view->spring_count;
        cpsi_netcdf_ints(&nc->file, ids->spring_element, &first, &springs, view->spring_element);
        cpsi_netcdf_doubles(&nc->file, ids->spring_strain, &first, &springs, view->spring_strain);
        cpsi_netcdf_doubles(&nc->file, ids->spring_stiffness, &first, &springs,
                            view->spring_stiffness);
    }
    if (view->uniform) return;
    cpsi_netcdf_doubles(&nc->file, ids->compliance_factor, &first, &elements,
                        view->compliance_factor);
    if (!ids->winches.is_there)
        cpsi_netcdf_doubles(&nc->file, ids->weight_length, &first, &nodes, view->weight_length);
}

/* Make the file. libnetcdf strips blanks at the beginning of a path and takes one with "://" for an
 * address: it is given the same path from the working directory with single slashes. */
static int create(CpsiNetcdf *nc, const char *path) {
    char *own = malloc(strlen(path) + sizeof "./"), *to = own;
    if (!own) return NC_ENOMEM;
    if (path[0] != '/') to = stpcpy(own, "./");
    for (const char *from = path; *from; ++from)
        if (from[0] != '/' || from[1] != '/') *to++ = *from;
    *to = '\0';
    const int status = nc->file.library.create(own, NC_NOCLOBBER | NC_64BIT_OFFSET, &nc->file.id);
    free(own);
    return status;
}

/* Records begin on a page of the library's memory that the header does not reach: what fills their
 * byte variables up to a word, which nothing writes, is 0 there. */
enum { ALIGN = 4, PAGE = 8192 };

/* all definitions, then the fields that never change */
static void begin(CpsiNetcdf *nc, const char *path, const CpsScene *scene,
                  const CpsEvolution *evolution, const char *names) {
    int before = 0;
    cpsi_netcdf_keep(&nc->file, create(nc, path));
    nc->open = nc->file.status == NC_NOERR;
    /* everything is written once, so nothing need be filled before */
    if (nc->open)
        cpsi_netcdf_keep(&nc->file, nc->file.library.set_fill(nc->file.id, NC_NOFILL, &before));
    const CpsLineView first = cps_evolution_line_view(evolution, 0);
    if (nc->open) define_run(nc, scene, first.origin, names);
    if (nc->open) cpsi_netcdf_define_current(&nc->file, scene, first.origin[2]);
    if (nc->open) cpsi_netcdf_define_soft(&nc->file, scene);
    for (int i = 0; i < nc->line_count && nc->file.status == NC_NOERR; ++i) {
        const CpsLineView view = constant_view(evolution, i);
        const CpsTwoStiffnesses two = cps_evolution_two_stiffnesses(evolution, i);
        nc->line[i].winches.is_there = cpsi_has_winch(&scene->line[i]);
        define_line(nc, &nc->line[i], &view);
        cpsi_netcdf_define_stiffnesses(&nc->file, &nc->line[i].stiffnesses, view.name, &two,
                                       (const int[]){nc->step, nc->line[i].element});
        define_zones(nc, &nc->line[i], &scene->line[i]);
        define_loads(nc, &nc->line[i], &view);
        define_end_points(nc, &nc->line[i], &scene->line[i]);
        cpsi_netcdf_define_grasps(&nc->file, &nc->line[i].grasps, scene, i, nc->step, nc->xyz);
        cpsi_netcdf_define_winches(&nc->file, &nc->line[i].winches, &scene->line[i],
                                   (const int[]){nc->step, nc->end, nc->line[i].node,
                                                 nc->line[i].element});
        cpsi_netcdf_define_sets(&nc->file, &nc->line[i].sets, &scene->line[i],
                                (const int[]){nc->step, nc->end, nc->xyz}, first.origin);
        cpsi_netcdf_define_potential(&nc->file, &nc->line[i].potential, &scene->line[i],
                                     (const int[]){nc->step, nc->line[i].node, nc->xyz});
        cpsi_netcdf_define_water(&nc->file, &nc->line[i].water, scene, i,
                                 (const int[]){nc->step, nc->line[i].element, nc->xyz});
        cpsi_netcdf_define_failure(&nc->file, &nc->breaks, &nc->line[i].failure, evolution, i,
                                   (const int[]){nc->step, nc->end, nc->line[i].element});
        cpsi_netcdf_define_motion(&nc->file, &nc->time, &nc->line[i].motion, &scene->line[i],
                                  (const int[]){nc->step, nc->line[i].node, nc->xyz,
                                                nc->line[i].element});
    }
    if (nc->file.status == NC_NOERR)
        cpsi_netcdf_keep(&nc->file, nc->file.library._enddef(nc->file.id, 0, ALIGN, 0, PAGE));
    cpsi_netcdf_write_obstacles(&nc->file, &nc->obstacles, scene, first.origin);
    cpsi_netcdf_write_points(&nc->file, &nc->points, scene, first.origin);
    cpsi_netcdf_write_bodies(&nc->file, &nc->bodies, scene, first.origin);
    for (int i = 0; i < nc->line_count && nc->file.status == NC_NOERR; ++i) {
        const CpsLineView view = constant_view(evolution, i);
        const CpsTwoStiffnesses two = cps_evolution_two_stiffnesses(evolution, i);
        for (int e = 0; e < ENDS; ++e) {
            const double *whole = cps_evolution_winch_report(evolution, i, e).length;
            if (whole) nc->line[i].winches.whole_length = whole;
        }
        write_fields(nc, &nc->line[i], &view, true);
        cpsi_netcdf_write_stiffnesses(&nc->file, &nc->line[i].stiffnesses,
                                      (size_t)view.element_count, &two);
        write_zones(nc, &nc->line[i], &scene->line[i]);
        write_end_points(nc, &nc->line[i], &scene->line[i]);
        write_sections(nc, &nc->line[i], &view);
        for (size_t e = 0; e < ENDS; ++e)
            cpsi_netcdf_write_set(&nc->file, &nc->line[i].sets, e, &scene->line[i].constraint[e],
                                  first.origin);
        cpsi_netcdf_write_failure(&nc->file, &nc->breaks, &nc->line[i].failure, evolution, i);
        cpsi_netcdf_write_motion(&nc->file, &nc->line[i].motion, evolution, i);
        if (nc->file.status == NC_NOERR)
            cpsi_netcdf_keep(&nc->file,
                             nc->file.library.put_var_double(nc->file.id, nc->line[i].compliance,
                                                             &view.compliance));
    }
    if (nc->file.status == NC_NOERR)
        cpsi_netcdf_keep(&nc->file, nc->file.library.sync(nc->file.id));
}

/* names of all lines, separated by blanks; NULL when memory does not suffice */
static char *join_names(const CpsEvolution *evolution, int count) {
    size_t size = 1;
    for (int i = 0; i < count; ++i) size += strlen(cps_evolution_line_view(evolution, i).name) + 1;
    char *names = calloc(size, 1), *next = names;
    if (names)
        for (int i = 0; i < count; ++i)
            next += snprintf(next, size - (size_t)(next - names), "%s%s", i ? " " : "",
                             cps_evolution_line_view(evolution, i).name);
    return names;
}

static CpsStatus check_sizes(const CpsEvolution *evolution, int count, CpsError *err) {
    for (int i = 0; i < count; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const size_t nodes = (size_t)view.element_count + 1;
        if ((uint64_t)nodes * (XYZ * sizeof(double)) > MAX_RECORD) /* an int of nodes fits */
            return cpsi_fail(err, CPS_ERR_LIMIT,
                             "line %s has %d elements; result.nc holds at most %llu per line",
                             view.name, view.element_count,
                             (unsigned long long)(MAX_RECORD / (XYZ * sizeof(double)) - 1));
    }
    return CPS_OK;
}

CpsStatus cpsi_netcdf_open(const char *path, const CpsScene *scene, const CpsEvolution *evolution,
                           const CpsResultsOptions *options, CpsiNetcdf **out, CpsError *err) {
    *out = NULL;
    const int lines = cps_evolution_line_count(evolution);
    unsigned wanted = 0;
    CpsStatus status = cpsi_fields_choose(options->fields, &wanted, err);
    if (!status) status = check_sizes(evolution, lines, err);
    if (status) return status;
    CpsiNetcdf *nc = calloc(1, sizeof *nc);
    char *names = join_names(evolution, lines);
    if (nc) {
        nc->wanted = wanted;
        nc->sync = !options->sync_at_end;
        nc->line = calloc((size_t)lines, sizeof *nc->line);
        nc->line_count = lines;
        nc->folder = strdup(path);
        if (nc->folder) *strrchr(nc->folder, '/') = '\0'; /* the path of a reserved file has one */
    }
    const bool whole = nc && nc->line && nc->folder && names;
    if (whole) status = cpsi_netcdf_library(&nc->file.library, err);
    if (!status && whole) {
        pthread_mutex_lock(&library_lock);
        begin(nc, path, scene, evolution, names);
        cpsi_netcdf_free_sets(&nc->obstacles);
        pthread_mutex_unlock(&library_lock);
        status = result_of(nc, err);
    } else if (!status) {
        status = cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while opening result.nc");
    }
    free(names);
    if (status)
        cpsi_netcdf_close(nc, NULL);
    else
        *out = nc;
    return status;
}

CpsStatus cpsi_netcdf_append(CpsiNetcdf *nc, const CpsEvolution *evolution, CpsError *err) {
    const CpsStepReport report = cps_evolution_report(evolution);
    const size_t start[] = {nc->steps, 0}, count[] = {1, NAME_LENGTH};
    char name[NAME_LENGTH] = {0};
    memcpy(name, report.name, cpsi_utf8_cut(report.name, sizeof name));

    pthread_mutex_lock(&library_lock);
    /* nothing is appended after a failure (run_files.c) */
    cpsi_netcdf_keep(&nc->file, nc->file.library.put_vara_text(nc->file.id, nc->step_name, start,
                                                               count, name));
    cpsi_netcdf_int(&nc->file, nc->outcome, start, (int)report.outcome);
    cpsi_netcdf_doubles(&nc->file, nc->wall, start, ONE, &report.wall);
    cpsi_netcdf_append_obstacles(&nc->file, &nc->obstacles, nc->steps, evolution);
    cpsi_netcdf_append_points(&nc->file, &nc->points, nc->steps, evolution);
    cpsi_netcdf_append_bodies(&nc->file, &nc->bodies, nc->steps, evolution);
    cpsi_netcdf_append_breaks(&nc->file, &nc->breaks, nc->steps, evolution);
    cpsi_netcdf_append_time(&nc->file, &nc->time, nc->steps, evolution);
    for (int i = 0; i < nc->line_count && nc->file.status == NC_NOERR; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        const CpsTwoStiffnesses two = cps_evolution_two_stiffnesses(evolution, i);
        write_line(nc, &nc->line[i], &view, &line);
        cpsi_netcdf_append_winches(&nc->file, &nc->line[i].winches, nc->steps, evolution, i);
        cpsi_netcdf_append_sets(&nc->file, &nc->line[i].sets, nc->steps, evolution, i);
        cpsi_netcdf_append_potential(&nc->file, &nc->line[i].potential, nc->steps, evolution, i);
        cpsi_netcdf_append_water(&nc->file, &nc->line[i].water, nc->steps, evolution, i);
        cpsi_netcdf_append_stiffnesses(&nc->file, &nc->line[i].stiffnesses, nc->steps,
                                       (size_t)view.element_count, &two);
        cpsi_netcdf_append_failure(&nc->file, &nc->breaks, &nc->line[i].failure, nc->steps,
                                   evolution, i);
        cpsi_netcdf_append_motion(&nc->file, &nc->line[i].motion, nc->steps, evolution, i);
    }
    if (nc->file.status == NC_NOERR && nc->sync)
        cpsi_netcdf_keep(&nc->file, nc->file.library.sync(nc->file.id));
    pthread_mutex_unlock(&library_lock);
    nc->steps++;
    return result_of(nc, err);
}

CpsStatus cpsi_netcdf_close(CpsiNetcdf *nc, CpsError *err) {
    if (!nc) return CPS_OK;
    if (nc->open) {
        pthread_mutex_lock(&library_lock);
        const int status = nc->file.library.close(nc->file.id);
        pthread_mutex_unlock(&library_lock);
        cpsi_netcdf_keep(&nc->file, status);
    }
    const CpsStatus status = result_of(nc, err);
    cpsi_netcdf_library_close(&nc->file.library);
    free(nc->folder);
    free(nc->line);
    free(nc);
    return status;
}
