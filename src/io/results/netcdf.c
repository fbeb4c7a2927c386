/* SPDX-License-Identifier: BSD-3-Clause */
/* result.nc: every field of every step, classic netCDF with 64-bit offsets (CDF-2) and CF
 * attributes.
 *
 * The layout is two tables, of the arrays in a line's view (fields.c) and of the numbers in its
 * report; docs/results.md shows the result. nc_sync after each step leaves a file that can be read
 * while the run goes on, and after a crash, unless it is to be synced at the end only.
 * The library keeps a list of open files of its own and is not safe for threads: one lock around
 * its calls makes it so (the only shared state in capstan-io). */
#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/status.h"
#include "base/vec3.h"
#include "capstan/set.h"
#include "io/base/escape.h"
#include "io/results/fields.h"
#include "io/results/netcdf_library.h"
#include "io/results/writers.h"

static pthread_mutex_t library_lock = PTHREAD_MUTEX_INITIALIZER;

enum { XYZ = 3, ENDS = 2, TANGENTS = 2, CONTACTS = 2 };
enum { NAME_LENGTH = 96, VARIABLE_NAME_SIZE = NC_MAX_NAME + 1 };

/* the format's limit on one variable in one record, in bytes (the specification of CDF-2) */
static const uint64_t MAX_RECORD = 4294967292;

#define VIEW(member)        offsetof(CpsLineView, member)
#define REPORT(member)      offsetof(CpsLineReport, member)
#define CERTIFICATE(member) REPORT(certificate.member)

/* Numbers of CpsLineReport. */
typedef struct Number {
    const char *name, *long_name, *units; /* units NULL: the unit depends on another variable */
    size_t offset;
} Number;

static const Number NUMBER[] = {
    {"primal", "energy and friction work of the configuration", "J", CERTIFICATE(primal)},
    {"dual", "lower bound of the minimum, from the forces", "J", CERTIFICATE(dual)},
    {"gap", "sum of the local gaps", "J", CERTIFICATE(gap)},
    {"scale", "scale of the gap", "J", CERTIFICATE(scale)},
    {"tension_bound", "guaranteed rms error of the tension", "N", CERTIFICATE(tension_bound)},
    {"tension_mesh", "estimated error of the tension by the elements' lengths", "N",
     REPORT(tension_mesh)},
    {"tension_estimate", "largest difference of elongation and equilibrium tension", "N",
     CERTIFICATE(tension_estimate)},
    {"force_residual", "largest imbalance of forces on a node", "N", CERTIFICATE(force_residual)},
    {"largest_force", "largest force in the line or on it", "N", CERTIFICATE(largest_force)},
    {"law_residual", "sum of dissipation and friction power", "J", CERTIFICATE(law_residual)},
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
    {"share", "part of the step that the arrays show, the last one of a step that was cut", "1",
     REPORT(share)},
    {"jump", "longest displacement of a node in a jump", "m", REPORT(jump)},
    {"bend_turn", "turn of the line at the contact where the mesh changes the law of friction most",
     "rad", REPORT(bend.turn)},
    {"bend_friction", "coefficient along the line there", "1", REPORT(bend.friction)},
    {"bend_at", "arc length there", "m", REPORT(bend.arc_length)},
    {"ledger_elastic", "growth of the energy of elongation", "J", REPORT(ledger.elastic)},
    {"ledger_gravity", "growth of the weight's potential", "J", REPORT(ledger.gravity)},
    {"ledger_ends", "work of the forces at the ends", "J", REPORT(ledger.ends)},
    {"ledger_obstacles", "work of the friction of obstacles that turn", "J",
     REPORT(ledger.obstacles)},
    {"ledger_imbalance", "what the ledger does not close by", "J", REPORT(ledger.imbalance)},
    {"unaccounted",
     "of that, more than 5 % of the energies of parts that could not be cut any more", "J",
     REPORT(unaccounted)},
    {"proof_value",
     "infeasible: what is missing of the length in m; unbounded: fall of energy per metre in N; "
     "slides: least power in N",
     NULL, REPORT(proof_value)},
};

/* Numbers of an obstacle. Their names are none that a line's field could have, whatever the line is
 * called. */
typedef enum ObstacleField {
    OBSTACLE_KIND,
    OBSTACLE_POINT,
    OBSTACLE_AXIS,
    OBSTACLE_RADIUS,
    OBSTACLE_AXIAL,
    OBSTACLE_LATERAL,
    OBSTACLE_SHAPE,
    OBSTACLE_GRAIN,
    OBSTACLE_FIELDS
} ObstacleField;

static const struct {
    const char *name, *long_name, *units;
    bool vector;
} OBSTACLE[OBSTACLE_FIELDS] = {
    {"obstacle_kind", "kind of surface", "1", false},
    {"obstacle_point", "point of the plane or of the cylinder's axis, centre of the sphere", "m",
     true},
    {"obstacle_axis", "normal of the plane, axis of cylinder and sphere, of any length", "1", true},
    {"obstacle_radius", "radius, 0 for a plane", "m", false},
    {"obstacle_friction_axial", "friction coefficient along the line or the grain", "1", false},
    {"obstacle_friction_lateral", "friction coefficient across it", "1", false},
    {"obstacle_friction_shape", "how the two make a set of forces, or that a set is given instead",
     "1", false},
    {"obstacle_friction_grain", "axial direction, 0: that of the line", "1", true},
};

/* Friction sets {origin + P v : A v + b in K}, padded with zeros to the largest. */
typedef enum SetField { SET_ORIGIN, SET_MAP, SET_CONE, SET_ROWS, SET_OFFSET, SET_FIELDS } SetField;

static const struct {
    const char *name, *long_name;
} SET[SET_FIELDS] = {
    {"obstacle_friction_set_origin", "friction set: {origin + P v : A v + b in K}"},
    {"obstacle_friction_set_map", "P"},
    {"obstacle_friction_set_cone",
     "rows of the cone of K that begins in this row, 1: half-line, 0: none begins"},
    {"obstacle_friction_set_rows", "A"},
    {"obstacle_friction_set_offset", "b"},
};

/* Numbers of CpsFrictionZone. */
static const struct {
    const char *name, *long_name, *units;
    size_t offset;
} ZONE[] = {
    {"zone_from", "natural abscissa at which the stretch begins", "m",
     offsetof(CpsFrictionZone, from)},
    {"zone_to", "natural abscissa at which it ends", "m", offsetof(CpsFrictionZone, to)},
    {"zone_factor", "factor of the friction of whatever it touches, 1 elsewhere", "1",
     offsetof(CpsFrictionZone, factor)},
};

/* Numbers of CpsTensionRange, of each end. */
static const struct {
    const char *name, *long_name;
    size_t offset;
} RANGE[] = {
    {"end_tension_least",
     "least tension of the end's element by forces that hold the line where it is",
     offsetof(CpsTensionRange, least)},
    {"end_tension_least_bound", "bound of it", offsetof(CpsTensionRange, least_bound)},
    {"end_tension_greatest", "the greatest, infinite where there is none",
     offsetof(CpsTensionRange, greatest)},
    {"end_tension_greatest_bound", "bound of it", offsetof(CpsTensionRange, greatest_bound)},
};

enum {
    RANGES = sizeof RANGE / sizeof RANGE[0],
    FIELDS = CPSI_FIELDS,
    NUMBERS = sizeof NUMBER / sizeof NUMBER[0],
    ZONES = sizeof ZONE / sizeof ZONE[0]
};

typedef struct LineIds {
    int node, element; /* dimensions */
    int contacts;      /* of a node, as in the view */
    int compliance, state[CONTACTS], obstacle[CONTACTS], end_kind, end_value, end_force,
        end_friction_force, end_tension, end_range[RANGES], outcome, iterations, parts, snaps,
        places, proof, proof_obstacle, weight_before;
    int field[FIELDS][CONTACTS];         /* unused where a view has no such array */
    int element_obstacle, element_state; /* the same */
    int number[NUMBERS];
    int zone[ZONES]; /* unused without zones */
} LineIds;

struct CpsiNetcdf {
    CpsiNetcdfLibrary library;
    int file;
    bool open, sync; /* sync: after each step */
    unsigned wanted; /* fields.h */
    int status;      /* of the first call that failed: later ones do nothing */
    size_t steps;
    int step, xyz, end, name_length; /* dimensions */
    int step_name, outcome, wall;
    int obstacle, turn,
        obstacle_field[OBSTACLE_FIELDS]; /* dimension, variables; without obstacles unused */
    int obstacle_count;
    int set_field[SET_FIELDS];     /* unused without sets, */
    size_t set_rows, set_unknowns; /* where these are 0 */
    /* (obstacle_count + 1) while the file begins; zeroed where an obstacle has none */
    CpsSetConic *set;
    double *slide; /* (nodes of the longest line, 3) where a view has none */
    int line_count;
    LineIds *line;
};

static void keep(CpsiNetcdf *nc, int status) {
    if (nc->status == NC_NOERR) nc->status = status;
}

static CpsStatus result_of(const CpsiNetcdf *nc, CpsError *err) {
    if (nc->status == NC_NOERR) return CPS_OK;
    return cpsi_fail(err, nc->status == NC_ENOMEM ? CPS_ERR_MEMORY : CPS_ERR_IO,
                     "cannot write result.nc: %s", nc->library.strerror(nc->status));
}

static int add_dimension(CpsiNetcdf *nc, const char *name, size_t size) {
    int id = -1;
    if (nc->status == NC_NOERR) keep(nc, nc->library.def_dim(nc->file, name, size, &id));
    return id;
}

static void add_text(CpsiNetcdf *nc, int variable, const char *name, const char *text) {
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_att_text(nc->file, variable, name, strlen(text), text));
}

/* a variable "prefix_name", or "name" without a prefix */
static int add_variable(CpsiNetcdf *nc, const char *prefix, const char *name, nc_type type,
                        int rank, const int *shape, const char *long_name, const char *units) {
    char full[VARIABLE_NAME_SIZE];
    int id = -1;
    const int length = snprintf(full, sizeof full, "%s%s%s", prefix, *prefix ? "_" : "", name);
    if (length < 0 || (size_t)length >= sizeof full) keep(nc, NC_EMAXNAME);
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.def_var(nc->file, full, type, rank, shape, &id));
    add_text(nc, id, "long_name", long_name);
    if (units) add_text(nc, id, "units", units);
    return id;
}

/* names of the values of an enumeration, as CF wants them */
static void add_flags(CpsiNetcdf *nc, int variable, nc_type type, int count, const char *meanings) {
    const int value[] = {0, 1, 2};
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_att_int(nc->file, variable, "flag_values", type, (size_t)count,
                                         value));
    add_text(nc, variable, "flag_meanings", meanings);
}

#define OUTCOME_WORD(name, number, key, sentence)   " " key
#define OUTCOME_NUMBER(name, number, key, sentence) number,
static const char OUTCOME_MEANINGS[] = CPS_OUTCOME_LIST(OUTCOME_WORD); /* begins with a blank */
static const int OUTCOME_VALUES[] = {CPS_OUTCOME_LIST(OUTCOME_NUMBER)};

static int add_outcome(CpsiNetcdf *nc, const char *prefix) {
    const int id =
        add_variable(nc, prefix, "outcome", NC_INT, 1, &nc->step, "what came of the step", "1");
    const size_t count = sizeof OUTCOME_VALUES / sizeof *OUTCOME_VALUES;
    if (nc->status == NC_NOERR)
        keep(nc,
             nc->library.put_att_int(nc->file, id, "flag_values", NC_INT, count, OUTCOME_VALUES));
    add_text(nc, id, "flag_meanings", OUTCOME_MEANINGS + 1);
    return id;
}

/* The conic form of the friction sets; false when there is none. */
static bool form_sets(CpsiNetcdf *nc, const CpsScene *scene) {
    bool found = false;
    nc->set = calloc((size_t)scene->obstacle_count + 1, sizeof *nc->set);
    if (!nc->set) keep(nc, NC_ENOMEM);
    for (int k = 0; k < scene->obstacle_count && nc->status == NC_NOERR; ++k) {
        if (!scene->obstacle[k].friction_set) continue;
        found = true;
        if (cps_set_conic(scene->obstacle[k].friction_set, &nc->set[k], NULL) != CPS_OK)
            keep(nc, NC_ENOMEM);
    }
    return found && nc->status == NC_NOERR;
}

static void define_sets(CpsiNetcdf *nc, const CpsScene *scene) {
    if (!form_sets(nc, scene)) return;
    nc->set_unknowns = nc->set_rows = 1; /* a dimension of no length would be an unlimited one */
    for (int k = 0; k < scene->obstacle_count; ++k) {
        const size_t unknowns = (size_t)nc->set[k].unknowns, rows = (size_t)nc->set[k].rows;
        if (unknowns > nc->set_unknowns) nc->set_unknowns = unknowns;
        if (rows > nc->set_rows) nc->set_rows = rows;
    }
    const int tangent = add_dimension(nc, "tangent", TANGENTS);
    const int unknown = add_dimension(nc, "set_unknown", nc->set_unknowns);
    const int row = add_dimension(nc, "set_row", nc->set_rows);
    const int shape[SET_FIELDS][3] = {{nc->obstacle, tangent},
                                      {nc->obstacle, tangent, unknown},
                                      {nc->obstacle, row},
                                      {nc->obstacle, row, unknown},
                                      {nc->obstacle, row}};
    for (int f = 0; f < SET_FIELDS; ++f)
        nc->set_field[f] =
            add_variable(nc, "", SET[f].name, NC_DOUBLE, 2 + (f == SET_MAP || f == SET_ROWS),
                         shape[f], SET[f].long_name, "1");
}

/* Obstacles: their names as an attribute like those of the lines, their numbers as variables. */
static void define_obstacles(CpsiNetcdf *nc, const CpsScene *scene) {
    size_t size = 1;
    for (int k = 0; k < scene->obstacle_count; ++k) size += strlen(scene->obstacle[k].name) + 1;
    char *names = calloc(size, 1), *next = names;
    if (!names) keep(nc, NC_ENOMEM);
    if (names)
        for (int k = 0; k < scene->obstacle_count; ++k)
            next += snprintf(next, size - (size_t)(next - names), "%s%s", k ? " " : "",
                             scene->obstacle[k].name);
    add_text(nc, NC_GLOBAL, "obstacles", names ? names : "");
    free(names);
    nc->obstacle_count = scene->obstacle_count;
    if (scene->obstacle_count == 0) return; /* a dimension of no length would be an unlimited one */
    nc->obstacle = add_dimension(nc, "obstacle", (size_t)scene->obstacle_count);
    const int shape[] = {nc->obstacle, nc->xyz}, turned[] = {nc->step, nc->obstacle};
    for (int f = 0; f < OBSTACLE_FIELDS; ++f)
        nc->obstacle_field[f] =
            add_variable(nc, "", OBSTACLE[f].name, NC_DOUBLE, 1 + OBSTACLE[f].vector, shape,
                         OBSTACLE[f].long_name, OBSTACLE[f].units);
    add_flags(nc, nc->obstacle_field[OBSTACLE_KIND], NC_DOUBLE, 3, "plane cylinder sphere");
    add_flags(nc, nc->obstacle_field[OBSTACLE_SHAPE], NC_DOUBLE, 3, "ellipse box set");
    nc->turn = add_variable(nc, "", "obstacle_turn", NC_DOUBLE, 2, turned,
                            "angle turned about its axis in the step", "rad");
    define_sets(nc, scene);
}

static void add_numbers(CpsiNetcdf *nc, const char *name, size_t count, const double *value) {
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_att_double(nc->file, NC_GLOBAL, name, NC_DOUBLE, count, value));
}

/* When the file was begun and by what, as CF wants the first line of a file's history. */
static void add_history(CpsiNetcdf *nc, const char *source) {
    char history[96];
    struct timespec now = {0};
    struct tm utc = {0};
    if (timespec_get(&now, TIME_UTC) == TIME_UTC) gmtime_r(&now.tv_sec, &utc);
    const size_t length = strftime(history, sizeof history, "%Y-%m-%dT%H:%M:%SZ: ", &utc);
    snprintf(history + length, sizeof history - length, "written by %s", source);
    add_text(nc, NC_GLOBAL, "history", history);
}

static void define_run(CpsiNetcdf *nc, const CpsScene *scene, const double origin[XYZ],
                       const char *names) {
    add_text(nc, NC_GLOBAL, "Conventions", "CF-1.8");
    add_text(nc, NC_GLOBAL, "title", scene->title ? scene->title : "");
    char source[64];
    snprintf(source, sizeof source, "capstan %s", cps_version());
    add_text(nc, NC_GLOBAL, "source", source);
    add_history(nc, source);
    add_text(nc, NC_GLOBAL, "lines", names);
    add_text(nc, NC_GLOBAL, "friction_policy",
             scene->friction_policy == CPS_FRICTION_CONSISTENT ? "consistent" : "frozen");
    add_text(nc, NC_GLOBAL, "contact_policy",
             scene->contact_policy == CPS_CONTACT_REFERENCE ? "reference" : "reached");
    add_numbers(nc, "gravity", XYZ, scene->gravity);
    add_numbers(nc, "tolerance", 1, &scene->solver.tolerance);
    if (origin[0] != 0 || origin[1] != 0 || origin[2] != 0) add_numbers(nc, "origin", XYZ, origin);

    nc->step = add_dimension(nc, "step", NC_UNLIMITED);
    nc->xyz = add_dimension(nc, "xyz", XYZ);
    nc->end = add_dimension(nc, "end", ENDS);
    nc->name_length = add_dimension(nc, "name_length", NAME_LENGTH);
    const int shape[] = {nc->step, nc->name_length};
    nc->step_name = add_variable(nc, "", "step_name", NC_CHAR, 2, shape, "name of the step", NULL);
    nc->outcome = add_outcome(nc, "");
    nc->wall = add_variable(nc, "", "wall", NC_DOUBLE, 1, &nc->step, "time taken by the step", "s");
    define_obstacles(nc, scene);
}

/* "LINE_NAME" of a node's first contact, "LINE_NAME_second" of its second. */
static int add_contact(CpsiNetcdf *nc, const char *line, const char *name, int contact,
                       nc_type type, int rank, const int *shape, const char *long_name,
                       const char *units) {
    char full[64], meaning[128];
    snprintf(full, sizeof full, "%s%s", name, contact ? "_second" : "");
    snprintf(meaning, sizeof meaning, "%s%s", long_name, contact ? ": the next nearest" : "");
    return add_variable(nc, line, full, type, rank, shape, meaning, units);
}

static bool is_wanted(const CpsiNetcdf *nc, int f) {
    return cpsi_field[f].fixed || (nc->wanted >> f & 1u);
}

static const double *in_view(const CpsLineView *view, const CpsiField *field) {
    const double *array;
    memcpy(&array, (const char *)view + field->offset, sizeof array);
    return array;
}

/* Has the view such an array, or is it made for it? */
static bool has_field(const CpsLineView *view, const CpsiField *field) {
    return field->offset == VIEW(slide) || in_view(view, field);
}

static void define_field(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view, int f) {
    const CpsiField *field = &cpsi_field[f];
    const char *line = view->name;
    if (!is_wanted(nc, f) || !has_field(view, field)) return;
    const int along = field->place == CPSI_PLACE_NODE ? ids->node : ids->element;
    const int shape[] = {nc->step, along, nc->xyz};
    const int rank = 1 + !field->fixed + field->vector;
    for (int c = 0; c < (field->contact ? ids->contacts : 1); ++c)
        ids->field[f][c] =
            add_contact(nc, line, field->name, c, NC_DOUBLE, rank, field->fixed ? shape + 1 : shape,
                        field->long_name, field->units);
}

static void define_zones(CpsiNetcdf *nc, LineIds *ids, const CpsLine *line) {
    if (line->zone_count == 0) return;
    char name[VARIABLE_NAME_SIZE];
    snprintf(name, sizeof name, "%.200s_zone", line->name);
    const int zone = add_dimension(nc, name, (size_t)line->zone_count);
    for (int i = 0; i < ZONES; ++i)
        ids->zone[i] = add_variable(nc, line->name, ZONE[i].name, NC_DOUBLE, 1, &zone,
                                    ZONE[i].long_name, ZONE[i].units);
}

static void define_line(CpsiNetcdf *nc, LineIds *ids, const CpsLineView *view) {
    char name[VARIABLE_NAME_SIZE];
    snprintf(name, sizeof name, "%.200s_node", view->name);
    ids->node = add_dimension(nc, name, (size_t)view->elements + 1);
    snprintf(name, sizeof name, "%.200s_element", view->name);
    ids->element = add_dimension(nc, name, (size_t)view->elements);

    ids->contacts = view->contacts;
    for (int f = 0; f < FIELDS; ++f) define_field(nc, ids, view, f);
    ids->compliance = add_variable(nc, view->name, "compliance", NC_DOUBLE, 0, NULL,
                                   "1/EA, 0: inextensible", "N-1");
    const int on_nodes[] = {nc->step, ids->node}, on_ends[] = {nc->step, nc->end, nc->xyz};
    for (int c = 0; c < ids->contacts; ++c) {
        if (nc->wanted & CPSI_WANTED_STATE) {
            ids->state[c] = add_contact(nc, view->name, "state", c, NC_BYTE, 2, on_nodes,
                                        "rest on the obstacle", "1");
            add_flags(nc, ids->state[c], NC_BYTE, 3, "free stick slip");
        }
        if (ids->contacts < 2 || !(nc->wanted & CPSI_WANTED_OBSTACLE)) continue;
        ids->obstacle[c] = add_contact(nc, view->name, "obstacle", c, NC_INT, 2, on_nodes,
                                       "place of the obstacle in the scene", "1");
    }
    const int on_elements[] = {nc->step, ids->element};
    if (view->element_obstacle && (nc->wanted & CPSI_WANTED_OBSTACLE))
        ids->element_obstacle =
            add_variable(nc, view->name, "element_obstacle", NC_INT, 2, on_elements,
                         "place of the obstacle that an element touches in the scene, -1: none",
                         "1");
    if (view->element_obstacle && (nc->wanted & CPSI_WANTED_STATE)) {
        ids->element_state = add_variable(nc, view->name, "element_state", NC_BYTE, 2, on_elements,
                                          "rest of the element on it", "1");
        add_flags(nc, ids->element_state, NC_BYTE, 3, "free stick slip");
    }
    ids->end_kind = add_variable(nc, view->name, "end_kind", NC_BYTE, 2, on_ends,
                                 "what is imposed at A and B", "1");
    add_flags(nc, ids->end_kind, NC_BYTE, 2, "held free");
    ids->end_value = add_variable(nc, view->name, "end_value", NC_DOUBLE, 3, on_ends,
                                  "position in m of a held end, force in N on a free one", NULL);
    ids->end_force = add_variable(nc, view->name, "end_force", NC_DOUBLE, 3, on_ends,
                                  "force on the line at its ends", "N");
    ids->end_friction_force =
        add_variable(nc, view->name, "end_friction_force", NC_DOUBLE, 3, on_ends,
                     "friction of the half element beside a held end that lies on an obstacle",
                     "N");
    ids->end_tension = add_variable(nc, view->name, "end_tension", NC_DOUBLE, 2, on_ends,
                                    "tension of the line at its ends", "N");
    for (int i = 0; i < RANGES; ++i)
        ids->end_range[i] = add_variable(nc, view->name, RANGE[i].name, NC_DOUBLE, 2, on_ends,
                                         RANGE[i].long_name, "N");
    ids->outcome = add_outcome(nc, view->name);
    ids->iterations = add_variable(nc, view->name, "iterations", NC_INT, 1, &nc->step,
                                   "interior-point iterations", "1");
    ids->parts = add_variable(nc, view->name, "parts", NC_INT, 1, &nc->step,
                              "parts that the step was taken in", "1");
    ids->snaps = add_variable(nc, view->name, "snaps", NC_INT, 1, &nc->step,
                              "parts in which the line jumped", "1");
    ids->places = add_variable(
        nc, view->name, "places_not_unique", NC_INT, 1, &nc->step,
        "do the forces leave a choice of places; 0: no, 1: the nearest is taken, 2: one of them",
        "1");
    add_flags(nc, ids->places, NC_INT, 3, "unique nearest any");
    const int vectors[] = {nc->step, nc->xyz};
    ids->proof = add_variable(nc, view->name, "proof", NC_DOUBLE, 2, vectors,
                              "direction that proves no solution", "1");
    ids->proof_obstacle =
        add_variable(nc, view->name, "proof_obstacle", NC_INT, 1, &nc->step,
                     "infeasible: the obstacle that the line does not reach round; -1: none", "1");
    ids->weight_before =
        add_variable(nc, view->name, "weight_before", NC_DOUBLE, 2, vectors,
                     "weight per natural length where the step, or its last part, began", "N m-1");
    for (int i = 0; i < NUMBERS; ++i)
        ids->number[i] = add_variable(nc, view->name, NUMBER[i].name, NC_DOUBLE, 1, &nc->step,
                                      NUMBER[i].long_name, NUMBER[i].units);
}

/* The slip where the view leaves it out, on one plane: the tangential part of the
 * displacement. */
static const double *plane_slide(CpsiNetcdf *nc, const CpsLineView *view) {
    for (size_t j = 0; j <= (size_t)view->elements; ++j) {
        const Vec3 n = vec3_load(view->normal + 3 * j);
        const Vec3 u =
            vec3_sub(vec3_load(view->position + 3 * j), vec3_load(view->reference + 3 * j));
        vec3_store(nc->slide + 3 * j,
                   vec3_norm(n) > 0 ? vec3_axpy(-vec3_dot(u, n), n, u) : vec3(0, 0, 0));
    }
    return nc->slide;
}

static const double *array_of(CpsiNetcdf *nc, const CpsLineView *view, const CpsiField *field) {
    const double *array = in_view(view, field);
    return array || field->offset != VIEW(slide) ? array : plane_slide(nc, view);
}

static const size_t ONE[] = {1}; /* count of a single number */

static void write_doubles(CpsiNetcdf *nc, int variable, const size_t *start, const size_t *count,
                          const double *value) {
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_vara_double(nc->file, variable, start, count, value));
}

static void write_int(CpsiNetcdf *nc, int variable, const size_t *start, int value) {
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_var1_int(nc->file, variable, start, &value));
}

/* the fields that do not change (fixed), or those of a step; an array of contacts has the first of
 * all nodes first */
static void write_fields(CpsiNetcdf *nc, const LineIds *ids, const CpsLineView *view, bool fixed) {
    for (int f = 0; f < FIELDS; ++f) {
        const CpsiField *field = &cpsi_field[f];
        if (field->fixed != fixed || !is_wanted(nc, f) || !has_field(view, field)) continue;
        const size_t along = (size_t)view->elements + (field->place == CPSI_PLACE_NODE);
        const size_t start[] = {nc->steps, 0, 0}, count[] = {1, along, XYZ};
        const double *array = array_of(nc, view, field);
        for (int c = 0; c < (field->contact ? ids->contacts : 1);
             ++c, array += along * (field->vector ? XYZ : 1))
            write_doubles(nc, ids->field[f][c], start + fixed, count + fixed, array);
    }
}

static void write_line(CpsiNetcdf *nc, const LineIds *ids, const CpsLineView *view,
                       const CpsLineReport *report) {
    write_fields(nc, ids, view, false);
    const size_t start[] = {nc->steps, 0, 0};
    const size_t nodes[] = {1, (size_t)view->elements + 1}, ends[] = {1, ENDS, XYZ},
                 vector[] = {1, XYZ};
    for (int c = 0; c < ids->contacts && nc->status == NC_NOERR; ++c) {
        const size_t from = (size_t)c * nodes[1];
        if (nc->wanted & CPSI_WANTED_STATE)
            keep(nc, nc->library.put_vara_uchar(nc->file, ids->state[c], start, nodes,
                                                view->state + from));
        if (ids->contacts < 2 || nc->status != NC_NOERR || !(nc->wanted & CPSI_WANTED_OBSTACLE))
            continue;
        keep(nc, nc->library.put_vara_int(nc->file, ids->obstacle[c], start, nodes,
                                          view->obstacle + from));
    }

    const size_t elements[] = {1, (size_t)view->elements};
    if (view->element_obstacle && (nc->wanted & CPSI_WANTED_OBSTACLE) && nc->status == NC_NOERR)
        keep(nc, nc->library.put_vara_int(nc->file, ids->element_obstacle, start, elements,
                                          view->element_obstacle));
    if (view->element_obstacle && (nc->wanted & CPSI_WANTED_STATE) && nc->status == NC_NOERR)
        keep(nc, nc->library.put_vara_uchar(nc->file, ids->element_state, start, elements,
                                            view->element_state));

    unsigned char kind[ENDS];
    double value[ENDS][XYZ], force[ENDS][XYZ], friction[ENDS][XYZ], tension[ENDS];
    for (int e = 0; e < ENDS; ++e) {
        kind[e] = view->end[e].kind == CPS_END_FREE;
        memcpy(value[e], view->end[e].value, sizeof value[e]);
        memcpy(force[e], report->end[e].force, sizeof force[e]);
        memcpy(friction[e], report->end[e].friction_force, sizeof friction[e]);
        tension[e] = report->end[e].tension;
    }
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_vara_uchar(nc->file, ids->end_kind, start, ends, kind));
    write_doubles(nc, ids->end_value, start, ends, value[0]);
    write_doubles(nc, ids->end_force, start, ends, force[0]);
    write_doubles(nc, ids->end_friction_force, start, ends, friction[0]);
    write_doubles(nc, ids->end_tension, start, ends, tension);
    for (int i = 0; i < RANGES; ++i) {
        double range[ENDS];
        for (int e = 0; e < ENDS; ++e)
            range[e] = *(const double *)(const void *)((const char *)&report->end[e].range +
                                                       RANGE[i].offset);
        write_doubles(nc, ids->end_range[i], start, ends, range);
    }
    write_doubles(nc, ids->proof, start, vector, report->proof);
    write_doubles(nc, ids->weight_before, start, vector, view->weight_before);

    write_int(nc, ids->outcome, start, (int)report->outcome);
    write_int(nc, ids->iterations, start, report->iterations);
    write_int(nc, ids->parts, start, report->parts);
    write_int(nc, ids->snaps, start, report->snaps);
    write_int(nc, ids->places, start, (int)report->places);
    write_int(nc, ids->proof_obstacle, start, report->proof_obstacle);
    for (int i = 0; i < NUMBERS; ++i) {
        const double *number =
            (const double *)(const void *)((const char *)report + NUMBER[i].offset);
        write_doubles(nc, ids->number[i], start, ONE, number);
    }
}

static void write_obstacles(CpsiNetcdf *nc, const CpsScene *scene, const double origin[XYZ]) {
    for (size_t k = 0; k < (size_t)scene->obstacle_count; ++k) {
        const CpsObstacle *o = &scene->obstacle[k];
        const bool plane = o->kind == CPS_OBSTACLE_PLANE;
        const double kind = o->kind, radius = plane ? 0 : o->radius,
                     shape = o->friction_set ? 2 : o->friction_shape;
        const double lateral = o->friction_lateral >= 0 ? o->friction_lateral : o->friction;
        const double point[XYZ] = {o->point[0] - origin[0], o->point[1] - origin[1],
                                   o->point[2] - origin[2]};
        const double *value[OBSTACLE_FIELDS] = {&kind,   point,        plane ? o->normal : o->axis,
                                                &radius, &o->friction, &lateral,
                                                &shape,  o->grain};
        const size_t start[] = {k, 0}, count[] = {1, XYZ};
        for (int f = 0; f < OBSTACLE_FIELDS; ++f)
            write_doubles(nc, nc->obstacle_field[f], start, count, value[f]);
    }
}

/* A matrix of obstacle k, padded with zeros; columns 0: a vector. */
static void write_padded(CpsiNetcdf *nc, SetField f, size_t k, const size_t padded[2], int rows,
                         int columns, const double *value) {
    const size_t start[] = {k, 0, 0}, count[] = {1, padded[0], padded[1]};
    const size_t width = padded[1], each = columns > 0 ? (size_t)columns : 1;
    double *all = calloc(padded[0] * width, sizeof *all);
    if (!all) keep(nc, NC_ENOMEM);
    for (size_t i = 0; all && i < (size_t)rows; ++i)
        memcpy(&all[i * width], &value[i * each], each * sizeof *all);
    if (all) write_doubles(nc, nc->set_field[f], start, count, all);
    free(all);
}

static void write_sets(CpsiNetcdf *nc, const CpsScene *scene) {
    const size_t rows = nc->set_rows, unknowns = nc->set_unknowns;
    if (rows == 0) return;
    for (size_t k = 0; k < (size_t)scene->obstacle_count && nc->status == NC_NOERR; ++k) {
        const CpsSetConic *set = &nc->set[k];
        double *cone = calloc(rows, sizeof *cone), *next = cone;
        if (!cone) keep(nc, NC_ENOMEM);
        if (cone)
            for (int c = 0; c < set->cones; next += set->dim[c++]) *next = set->dim[c];
        write_padded(nc, SET_ORIGIN, k, (size_t[]){TANGENTS, 1}, set->space, 0, set->origin);
        write_padded(nc, SET_MAP, k, (size_t[]){TANGENTS, unknowns}, set->space, set->unknowns,
                     set->p);
        if (cone) write_padded(nc, SET_CONE, k, (size_t[]){rows, 1}, set->rows, 0, cone);
        write_padded(nc, SET_ROWS, k, (size_t[]){rows, unknowns}, set->rows, set->unknowns, set->a);
        write_padded(nc, SET_OFFSET, k, (size_t[]){rows, 1}, set->rows, 0, set->b);
        free(cone);
    }
}

static void write_zones(CpsiNetcdf *nc, const LineIds *ids, const CpsLine *line) {
    for (size_t k = 0; k < (size_t)line->zone_count; ++k)
        for (int i = 0; i < ZONES; ++i)
            write_doubles(nc, ids->zone[i], &k, ONE,
                          (const double *)(const void *)((const char *)&line->zone[k] +
                                                         ZONE[i].offset));
}

/* all definitions, then the fields that never change */
static void begin(CpsiNetcdf *nc, const char *path, const CpsScene *scene,
                  const CpsEvolution *evolution, const char *names) {
    int before = 0;
    keep(nc, nc->library.create(path, NC_CLOBBER | NC_64BIT_OFFSET, &nc->file));
    nc->open = nc->status == NC_NOERR;
    /* everything is written once, so nothing need be filled before */
    if (nc->open) keep(nc, nc->library.set_fill(nc->file, NC_NOFILL, &before));
    const CpsLineView first = cps_evolution_line_view(evolution, 0);
    if (nc->open) define_run(nc, scene, first.origin, names);
    for (int i = 0; i < nc->line_count && nc->status == NC_NOERR; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        define_line(nc, &nc->line[i], &view);
        define_zones(nc, &nc->line[i], &scene->line[i]);
    }
    if (nc->status == NC_NOERR) keep(nc, nc->library.enddef(nc->file));
    write_obstacles(nc, scene, first.origin);
    write_sets(nc, scene);
    for (int i = 0; i < nc->line_count && nc->status == NC_NOERR; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        write_fields(nc, &nc->line[i], &view, true);
        write_zones(nc, &nc->line[i], &scene->line[i]);
        if (nc->status == NC_NOERR)
            keep(nc,
                 nc->library.put_var_double(nc->file, nc->line[i].compliance, &view.compliance));
    }
    if (nc->status == NC_NOERR) keep(nc, nc->library.sync(nc->file));
}

static void free_sets(CpsiNetcdf *nc, const CpsScene *scene) {
    for (int k = 0; nc->set && k < scene->obstacle_count; ++k) cps_set_conic_free(&nc->set[k]);
    free(nc->set);
    nc->set = NULL;
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

/* *longest: most nodes of a line */
static CpsStatus check_sizes(const CpsEvolution *evolution, int count, size_t *longest,
                             CpsError *err) {
    *longest = 0;
    for (int i = 0; i < count; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const size_t nodes = (size_t)view.elements + 1;
        if (nodes > *longest) *longest = nodes;
        if ((uint64_t)nodes * (XYZ * sizeof(double)) > MAX_RECORD) /* an int of nodes fits */
            return cpsi_fail(err, CPS_ERR_LIMIT,
                             "line %s has %d elements; result.nc holds at most %llu per line",
                             view.name, view.elements,
                             (unsigned long long)(MAX_RECORD / (XYZ * sizeof(double)) - 1));
    }
    return CPS_OK;
}

CpsStatus cpsi_netcdf_open(const char *path, const CpsScene *scene, const CpsEvolution *evolution,
                           const CpsResultsOptions *options, CpsiNetcdf **out, CpsError *err) {
    *out = NULL;
    const int lines = cps_evolution_line_count(evolution);
    size_t nodes = 0;
    unsigned wanted = 0;
    CpsStatus status = cpsi_fields_choose(options->fields, &wanted, err);
    if (!status) status = check_sizes(evolution, lines, &nodes, err);
    if (status) return status;
    CpsiNetcdf *nc = calloc(1, sizeof *nc);
    char *names = join_names(evolution, lines);
    if (nc) {
        nc->wanted = wanted;
        nc->sync = !options->sync_at_end;
        nc->line = calloc((size_t)lines, sizeof *nc->line);
        nc->line_count = lines;
    }
    if (nc) nc->slide = calloc(nodes, XYZ * sizeof *nc->slide);
    if (nc && nc->line && nc->slide && names) status = cpsi_netcdf_library(&nc->library, err);
    if (!status && nc && nc->line && nc->slide && names) {
        pthread_mutex_lock(&library_lock);
        begin(nc, path, scene, evolution, names);
        free_sets(nc, scene);
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

CpsStatus cpsi_netcdf_append(CpsiNetcdf *nc, const CpsEvolution *evolution, const double *turn,
                             CpsError *err) {
    const CpsStepReport report = cps_evolution_report(evolution);
    const size_t start[] = {nc->steps, 0}, count[] = {1, NAME_LENGTH};
    char name[NAME_LENGTH] = {0};
    const char *given = report.name ? report.name : "";
    memcpy(name, given, cpsi_utf8_cut(given, sizeof name));

    pthread_mutex_lock(&library_lock);
    if (nc->status == NC_NOERR)
        keep(nc, nc->library.put_vara_text(nc->file, nc->step_name, start, count, name));
    write_int(nc, nc->outcome, start, (int)report.outcome);
    write_doubles(nc, nc->wall, start, ONE, &report.wall);
    const size_t turns[] = {1, (size_t)nc->obstacle_count};
    if (nc->obstacle_count > 0) write_doubles(nc, nc->turn, start, turns, turn);
    for (int i = 0; i < nc->line_count && nc->status == NC_NOERR; ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const CpsLineReport line = cps_evolution_line_report(evolution, i);
        write_line(nc, &nc->line[i], &view, &line);
    }
    if (nc->status == NC_NOERR && nc->sync) keep(nc, nc->library.sync(nc->file));
    pthread_mutex_unlock(&library_lock);
    nc->steps++;
    return result_of(nc, err);
}

CpsStatus cpsi_netcdf_close(CpsiNetcdf *nc, CpsError *err) {
    if (!nc) return CPS_OK;
    if (nc->open) {
        pthread_mutex_lock(&library_lock);
        const int status = nc->library.close(nc->file);
        pthread_mutex_unlock(&library_lock);
        keep(nc, status);
    }
    const CpsStatus status = result_of(nc, err);
    cpsi_netcdf_library_close(&nc->library);
    free(nc->line);
    free(nc->slide);
    free(nc);
    return status;
}
