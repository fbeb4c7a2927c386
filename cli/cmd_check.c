/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan check: read a scene, say what is wrong with it or what is in it; nothing is solved. */
#include <math.h>
#include <stdio.h>

#include "capstan/io.h"
#include "commands.h"
#include "options.h"

static void print_obstacle(const CpsObstacle *o) {
    printf("obstacle %s: plane through (%g, %g, %g) m, normal (%g, %g, %g), friction %g\n", o->name, o->point[0],
           o->point[1], o->point[2], o->normal[0], o->normal[1], o->normal[2], o->friction);
}

static void print_end(char letter, const CpsEnd *end) {
    const double *v = end->value;
    if (end->kind == CPS_END_FREE)
        printf("  end %c: free, force (%g, %g, %g) N\n", letter, v[0], v[1], v[2]);
    else if (isnan(v[0]))
        printf("  end %c: fixed where the start puts it\n", letter);
    else
        printf("  end %c: fixed at (%g, %g, %g) m\n", letter, v[0], v[1], v[2]);
}

static void print_line(const CpsLine *line) {
    static const char *const START[] = {"straight", "polyline", "arc", "laid by statics"};
    printf("line %s: %g m, %d %selement%s, weight %g N/m, ", line->name, line->length, line->elements,
           line->element_length ? "graded " : "", line->elements == 1 ? "" : "s", line->weight);
    if (isinf(line->stiffness))
        printf("inextensible");
    else
        printf("stiffness %g N", line->stiffness);
    printf(", start %s\n", START[line->start.kind]);
    print_end('A', &line->end[CPS_END_A]);
    print_end('B', &line->end[CPS_END_B]);
}

static void print_scene(const CpsScene *scene) {
    if (scene->title) printf("%s\n", scene->title);
    printf("gravity (%g, %g, %g) m/s2\n", scene->gravity[0], scene->gravity[1], scene->gravity[2]);
    for (int i = 0; i < scene->obstacle_count; i++) print_obstacle(&scene->obstacle[i]);
    for (int i = 0; i < scene->line_count; i++) print_line(&scene->line[i]);

    /* steps as they will be counted: a start laid by statics is one */
    int steps = 0;
    for (int i = 0; i < scene->line_count; i++)
        if (scene->line[i].start.kind == CPS_START_LAID) steps = 1;
    for (int i = 0; i < scene->stage_count; i++) steps += scene->stage[i].steps;
    printf("history: %d entr%s, %d load step%s in all\nThe scene is valid.\n", scene->stage_count,
           scene->stage_count == 1 ? "y" : "ies", steps, steps == 1 ? "" : "s");
}

int cmd_check(int argc, char **argv) {
    CliOptions options;
    if (!cli_parse(argc, argv, FOR_CHECK, true, &options)) return EXIT_USAGE;

    CpsSceneFile *file = NULL;
    CpsError err;
    if (cps_scene_read(options.scene, NULL, &file, &err) != CPS_OK) return cli_report(&err);
    print_scene(cps_scene_file_scene(file));
    cps_scene_file_destroy(file);
    return EXIT_OK;
}
