/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan check: read a scene and report its faults, or print a summary of it; nothing is
 * solved. */
#include <limits.h>
#include <math.h>
#include <stdio.h>

#include "capstan/io.h"
#include "check_motion.h"
#include "coarse_steps.h"
#include "commands.h"
#include "options.h"
#include "printable.h"
#include "progress.h"

static void print_direction(const double *grain) {
    if (grain[0] != 0 || grain[1] != 0 || grain[2] != 0)
        printf("(%g, %g, %g)", grain[0], grain[1], grain[2]);
    else
        printf("the line");
}

static void print_friction(const CpsObstacle *o) {
    const double lateral = o->has_friction_lateral ? o->friction_lateral : o->friction;
    if (o->friction_set) {
        char text[200];
        const size_t length = cps_set_text(o->friction_set, text, sizeof text);
        printf(", friction in %s%s, along ", text, length < sizeof text ? "" : "..");
        print_direction(o->grain);
        printf("\n");
        return;
    }
    if (lateral == o->friction && o->friction_shape == CPS_FRICTION_SHAPE_ELLIPSE) {
        printf(", friction %g\n", o->friction);
        return;
    }
    printf(", friction %g along ", o->friction);
    print_direction(o->grain);
    printf(" and %g across, %s\n", lateral,
           o->friction_shape == CPS_FRICTION_SHAPE_BOX ? "box" : "ellipse");
}

static void print_ground(const CpsObstacle *o) {
    const CpsGroundGrid grid = cps_ground_grid(o->ground);
    const double *p = o->point, *x = grid.x, *y = grid.y;
    const size_t points = (size_t)grid.x_count * (size_t)grid.y_count;
    double low = grid.z[0], high = grid.z[0];
    for (size_t i = 0; i < points; i++) {
        low = fmin(low, grid.z[i]);
        high = fmax(high, grid.z[i]);
    }
    printf("ground of %d x %d points, x %g to %g m, y %g to %g m, z %g to %g m%s%s", grid.x_count,
           grid.y_count, x[0] + p[0], x[grid.x_count - 1] + p[0], y[0] + p[1],
           y[grid.y_count - 1] + p[1], low + p[2], high + p[2],
           grid.extends ? ", extended beyond its edges" : "",
           grid.friction_factor ? ", with factors of friction" : "");
}

static void print_mesh(const CpsObstacle *o) {
    const CpsMeshReport of = cps_mesh_report(o->mesh);
    const CpsMeshTriangles triangles = cps_mesh_triangles(o->mesh);
    const double *p = o->point, *a = of.low, *b = of.high;
    printf("mesh of %d triangles, x %g to %g m, y %g to %g m, z %g to %g m, rounded by %g m, ",
           triangles.triangle_count, a[0] + p[0], b[0] + p[0], a[1] + p[1], b[1] + p[1],
           a[2] + p[2], b[2] + p[2], o->radius);
    if (of.rim_count > 0)
        printf("open (%d edges at its rim), %s", of.rim_count,
               triangles.two_sided ? "two-sided" : "one-sided");
    else
        printf("closed, lines %s", triangles.two_sided ? "on both sides"
                                   : of.volume >= 0    ? "outside"
                                                       : "inside");
    if (of.left_out_count > 0) printf(", %d triangles left out", of.left_out_count);
}

static void print_shape(const CpsObstacle *o) {
    const double *p = o->point, *d = o->axis, r = o->radius, *size = o->shape.size;
    if (o->kind == CPS_OBSTACLE_CAPSULE)
        printf("capsule of radius %g m and length %g m around (%g, %g, %g) m, axis (%g, %g, %g)", r,
               o->shape.length, p[0], p[1], p[2], d[0], d[1], d[2]);
    else if (o->kind == CPS_OBSTACLE_TORUS)
        printf("torus of radii %g and %g m around (%g, %g, %g) m, axis (%g, %g, %g)",
               o->shape.main_radius, r, p[0], p[1], p[2], d[0], d[1], d[2]);
    else if (o->kind == CPS_OBSTACLE_CONE)
        printf("cone of %g degrees with a tip of radius %g m at (%g, %g, %g) m, axis (%g, %g, %g)",
               o->shape.angle * 180 / 3.14159265358979323846, r, p[0], p[1], p[2], d[0], d[1],
               d[2]);
    else
        printf("box of %g x %g x %g m with edges of radius %g m around (%g, %g, %g) m", size[0],
               size[1], size[2], r, p[0], p[1], p[2]);
}

static void print_obstacle(const CpsObstacle *o) {
    const double *p = o->point, *d = o->kind == CPS_OBSTACLE_PLANE ? o->normal : o->axis;
    printf("obstacle %s: ", o->name);
    if (o->kind == CPS_OBSTACLE_PLANE)
        printf("plane through (%g, %g, %g) m, normal (%g, %g, %g)", p[0], p[1], p[2], d[0], d[1],
               d[2]);
    else if (o->kind == CPS_OBSTACLE_CYLINDER)
        printf("cylinder of radius %g m through (%g, %g, %g) m, axis (%g, %g, %g)", o->radius, p[0],
               p[1], p[2], d[0], d[1], d[2]);
    else if (o->kind == CPS_OBSTACLE_SPHERE)
        printf("ball of radius %g m around (%g, %g, %g) m", o->radius, p[0], p[1], p[2]);
    else if (o->kind == CPS_OBSTACLE_MESH)
        print_mesh(o);
    else if (o->kind == CPS_OBSTACLE_GROUND)
        print_ground(o);
    else
        print_shape(o);
    if (o->shape.inside) printf(", lines inside");
    print_friction(o);
}

static void print_body(const CpsScene *scene, int index) {
    const CpsBody *body = &scene->body[index];
    static const char *const DIRECTION[] = {"x", "y", "z", "rx", "ry", "rz"};
    const double *x = body->position, *q = body->rotation, *g = body->centre_of_gravity,
                 *b = body->centre_of_buoyancy, *f = body->force, *m = body->moment;
    const bool is_free = body->kind == CPS_BODY_KIND_FREE;
    printf("body %s: %s (%g, %g, %g) m, rotation (%g, %g, %g, %g)\n", body->name,
           is_free ? "free, begins at" : "held at", x[0], x[1], x[2], q[0], q[1], q[2], q[3]);
    int fixed = 0;
    for (int i = 0; i < CPS_BODY_DIRECTIONS; i++)
        if (body->fixed[i]) printf("%s%s", fixed++ ? " " : "  fixed in ", DIRECTION[i]);
    if (fixed) putchar('\n');
    if (body->weight != 0)
        printf("  weight %g N at (%g, %g, %g) m\n", body->weight, g[0], g[1], g[2]);
    if (body->buoyancy != 0)
        printf("  buoyancy %g N at (%g, %g, %g) m\n", body->buoyancy, b[0], b[1], b[2]);
    check_print_matrix("hydrostatics", body->hydrostatics);
    if (is_free)
        printf("  force (%g, %g, %g) N, moment (%g, %g, %g) N m\n", f[0], f[1], f[2], m[0], m[1],
               m[2]);
    if (check_in_time(scene)) check_print_body_motion(scene, index);
}

static void print_set(const CpsConstraint *on) {
    const double *p = on->point, *a = on->axis, *s = on->size;
    switch (on->kind) {
    case CPS_CONSTRAINT_KIND_NONE: break;
    case CPS_CONSTRAINT_KIND_RAIL:
        printf(", on a rail from (%g, %g, %g) m along (%g, %g, %g)", p[0], p[1], p[2], a[0], a[1],
               a[2]);
        if (isfinite(on->length)) printf(", %g m", on->length);
        break;
    case CPS_CONSTRAINT_KIND_HALF_SPACE:
        printf(", in the half-space of (%g, %g, %g) m, normal (%g, %g, %g)", p[0], p[1], p[2], a[0],
               a[1], a[2]);
        break;
    case CPS_CONSTRAINT_KIND_BALL:
        printf(", in a ball about (%g, %g, %g) m, radius %g m", p[0], p[1], p[2], on->radius);
        break;
    case CPS_CONSTRAINT_KIND_DISC:
        printf(", in a disc about (%g, %g, %g) m, radius %g m, normal (%g, %g, %g)", p[0], p[1],
               p[2], on->radius, a[0], a[1], a[2]);
        break;
    case CPS_CONSTRAINT_KIND_SET: printf(", in a convex set"); break;
    case CPS_CONSTRAINT_KIND_BOX:
        printf(", in a box about (%g, %g, %g) m, %g x %g x %g m", p[0], p[1], p[2], s[0], s[1],
               s[2]);
        break;
    }
}

static void print_point(const CpsScene *scene, const CpsPoint *point) {
    const double *x = point->position, *f = point->force;
    if (point->kind == CPS_POINT_KIND_ON_BODY) {
        printf("point %s: on body %s at (%g, %g, %g) m\n", point->name,
               scene->body[point->body].name, x[0], x[1], x[2]);
        return;
    }
    const bool is_free = point->kind == CPS_POINT_KIND_FREE;
    printf("point %s: %s (%g, %g, %g) m", point->name, is_free ? "free, begins at" : "held at",
           x[0], x[1], x[2]);
    if (point->weight != 0)
        printf(", %s of %g N", point->weight < 0 ? "buoy" : "clump", fabs(point->weight));
    if (scene->has_water_surface && point->displaced_weight > 0)
        printf(", displaces water of %g N", point->displaced_weight);
    if (scene->has_water_surface && point->height > 0)
        printf(" over a height of %g m", point->height);
    if (point->bearing_area > 0) printf(", bears on %g m2", point->bearing_area);
    if (point->has_holding_capacity) printf(", holding capacity %g N", point->holding_capacity);
    if (point->has_uplift_limit) printf(", uplift limit %g N", point->uplift_limit);
    if (point->drags) printf(", drags");
    if (is_free) printf(", force (%g, %g, %g) N", f[0], f[1], f[2]);
    if (check_in_time(scene)) check_print_point_motion(point);
    print_set(&point->constraint);
    putchar('\n');
}

static void print_end(const CpsScene *scene, const CpsLine *line, int e) {
    const CpsEnd *end = &line->end[e];
    const char letter = e == CPS_END_A ? 'A' : 'B';
    const double *v = end->value;
    if (end->kind == CPS_END_KIND_POINT) {
        printf("  end %c: at point %s\n", letter, scene->point[line->end_point[e]].name);
    } else if (end->kind == CPS_END_KIND_FREE) {
        printf("  end %c: free, force (%g, %g, %g) N", letter, v[0], v[1], v[2]);
        print_set(&line->constraint[e]);
        putchar('\n');
    } else if (end->kind == CPS_END_KIND_AT_START) {
        printf("  end %c: held where the start puts it\n", letter);
    } else {
        printf("  end %c: held at (%g, %g, %g) m\n", letter, v[0], v[1], v[2]);
    }
}

/* What a section has, or a line of one make. */
typedef struct Stuff {
    double weight, stiffness;
    int row_count;
    const CpsStiffnessRow *row;
    bool breaks;
    double breaking_load;
    bool parts;
    double break_at;
} Stuff;

static void print_make(const Stuff *make) {
    printf("weight %g N/m, ", make->weight);
    if (make->row_count > 0) {
        const int last = make->row_count - 1;
        const CpsStiffnessRow *row = make->row;
        printf("stiffness %g N, %g N beyond %g %%", row[1].tension / row[1].strain,
               (row[last].tension - row[last - 1].tension) /
                   (row[last].strain - row[last - 1].strain),
               100 * row[last - 1].strain);
    } else if (isinf(make->stiffness)) {
        printf("inextensible");
    } else {
        printf("stiffness %g N", make->stiffness);
    }
    if (make->breaks) printf(", breaks at %g N", make->breaking_load);
    if (make->parts) printf(", parts above %g N", make->break_at);
}

/* Print the number of elements that end between two arc lengths, and how long they are. */
static void print_elements(const CpsLine *line, double from, double to) {
    double at = 0, least = INFINITY, most = 0;
    int count = 0;
    for (int e = 0; e < line->element_count; e++) {
        const double l =
            line->element_length ? line->element_length[e] : line->length / line->element_count;
        const double middle = at + 0.5 * l;
        at += l;
        if (middle < from || middle > to) continue;
        count++;
        least = fmin(least, l);
        most = fmax(most, l);
    }
    printf("%d element%s of %g m", count, count == 1 ? "" : "s", least);
    if (most > least * (1 + 1e-9)) printf(" to %g m", most);
}

static void print_line(const CpsScene *scene, const CpsLine *line) {
    static const char *const START[] = {"straight", "polyline", "arc", "static equilibrium",
                                        "from given nodes"};
    printf("line %s: %g m, ", line->name, line->length);
    print_elements(line, 0, line->length);
    printf(", ");
    if (line->section_count == 0) {
        print_make(&(Stuff){line->weight, line->stiffness, line->stiffness_row_count,
                            line->stiffness_row, line->has_breaking_load, line->breaking_load,
                            line->has_break_at, line->break_at});
        printf(", ");
    }
    printf("start %s\n", START[line->start.kind]);
    double from = 0;
    for (int k = 0; k < line->section_count; from += line->section[k++].length) {
        const CpsSection *section = &line->section[k];
        printf("  ");
        cli_print_text(stdout, section->type, INT_MAX, false);
        printf(" from %g m to %g m: ", from, from + section->length);
        print_elements(line, from, from + section->length);
        printf(", ");
        print_make(&(Stuff){section->weight, section->stiffness, section->stiffness_row_count,
                            section->stiffness_row, section->has_breaking_load,
                            section->breaking_load, section->has_break_at, section->break_at});
        putchar('\n');
    }
    for (int k = 0; k < line->point_weight_count; k++)
        printf("  %s of %g N at %g m\n", line->point_weight[k].weight < 0 ? "buoy" : "clump",
               fabs(line->point_weight[k].weight), line->point_weight[k].arc_length);
    for (int k = 0; k < line->zone_count; k++)
        printf("  friction from %g m to %g m: %g times\n", line->zone[k].from, line->zone[k].to,
               line->zone[k].factor);
    check_print_line_motion(scene, line);
    print_end(scene, line, CPS_END_A);
    print_end(scene, line, CPS_END_B);
}

static void print_waves(const CpsScene *scene) {
    const CpsWaves *waves = scene->current ? scene->current->waves : NULL;
    if (!waves) return;
    printf("waves in a depth of %g m", waves->depth);
    if (waves->ramp > 0) printf(", which grow for %g s", waves->ramp);
    putchar('\n');
    for (int i = 0; i < waves->wave_count; i++) {
        const CpsWave *wave = &waves->wave[i];
        static const double DEGREES = 57.29577951308232;
        const double k = cps_wave_number(wave->period, waves->depth, -scene->gravity[2]);
        printf("  amplitude %g m, period %g s, length %.6g m, direction %g degrees, phase %g "
               "degrees; %.3g of the height at which it breaks\n",
               wave->amplitude, wave->period, 2 * acos(-1) / k, wave->direction * DEGREES,
               wave->phase * DEGREES, 2 * wave->amplitude / cps_breaking_height(k, waves->depth));
    }
}

static void print_scene(const CpsScene *scene) {
    if (scene->title) {
        cli_print_text(stdout, scene->title, INT_MAX, false);
        putchar('\n');
    }
    printf("gravity (%g, %g, %g) m/s2\n", scene->gravity[0], scene->gravity[1], scene->gravity[2]);
    if (scene->has_water_surface)
        printf("surface of the water at z = %g m\n", scene->water_surface);
    check_print_current(scene);
    print_waves(scene);
    for (int i = 0; i < scene->obstacle_count; i++) print_obstacle(&scene->obstacle[i]);
    for (int i = 0; i < scene->body_count; i++) print_body(scene, i);
    for (int i = 0; i < scene->point_count; i++) print_point(scene, &scene->point[i]);
    for (int i = 0; i < scene->line_count; i++) print_line(scene, &scene->line[i]);

    /* number of steps as a run counts them: a start that is statically placed is a step */
    int steps = 0;
    for (int i = 0; i < scene->line_count; i++)
        if (scene->line[i].start.kind == CPS_START_STATIC) steps = 1;
    for (int i = 0; i < scene->stage_count; i++) steps += scene->stage[i].step_count;
    printf("history: %d entr%s, %s%d load step%s in all", scene->stage_count,
           scene->stage_count == 1 ? "y" : "ies", cli_has_pace(scene) ? "at least " : "", steps,
           steps == 1 ? "" : "s");
    check_print_times(scene);
    fputs("\nThe scene is valid.\n", stdout);
}

int cmd_check(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_CHECK, "SCENE.yaml", &options)) return EXIT_USAGE;

    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.operand, NULL, &file, &err) != CPS_OK) return cli_report(&err);
    print_scene(cps_scene_file_scene(file));
    coarse_steps_warn(cps_scene_file_scene(file));
    cps_scene_file_destroy(file);
    return EXIT_OK;
}
