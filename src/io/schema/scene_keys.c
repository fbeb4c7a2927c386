/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of keys (see scene_keys.h). */
#include "io/schema/scene_keys.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "capstan/scene.h"

/* clang-format off */

/* ranges: lowest, highest, lowest excluded */
#define LARGEST      CPSI_LARGEST
#define ANY          -LARGEST, LARGEST, false
#define POSITIVE     0, LARGEST, true
#define NOT_NEGATIVE 0, LARGEST, false
#define NO_RANGE     0, 0, false
#define MAP(object)  NO_RANGE, 0, object, NULL

/* where a value goes: into a field, with what is inside into fields of the same struct, or where scene_build.c puts it */
#define AT(type, field) offsetof(type, field)
#define SAME            0
#define BY_HAND         CPSI_BY_HAND

/* Each row: name, type, need, place, unit, range, most, inside, words, default, help. */

static const CpsiKey SCENE_KEYS[] = {
    {"capstan", CPSI_INTEGER, CPSI_REQUIRED, BY_HAND, "", 1, 1, false, 0, 0, NULL, NULL,
     "version of this file format"},
    {"title", CPSI_TEXT, CPSI_OPTIONAL, AT(CpsScene, title), "", NO_RANGE, 0, 0, NULL, NULL,
     "what the scene shows; printed with the results"},
    {"gravity", CPSI_POINT, CPSI_OPTIONAL, AT(CpsScene, gravity), "m/s2", ANY, 3, 0, NULL, "[0, 0, -9.81]",
     "acceleration of gravity; its direction is that of the lines' weight"},
    {"obstacles", CPSI_MAPPING, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_OBSTACLES), "{}",
     "what the lines lie on, by name; each node rests on the nearest one, or on the two nearest"},
    {"lines", CPSI_MAPPING, CPSI_REQUIRED, BY_HAND, "", MAP(CPSI_LINES), NULL,
     "the lines by name; they do not touch one another"},
    {"friction", CPSI_WORD, CPSI_OPTIONAL, AT(CpsScene, friction), "", NO_RANGE, 0, 0, "frozen consistent", "\"consistent\"",
     "frozen: the friction bound of a step is taken from the configuration the step starts from; consistent: it is mu "
     "times the reaction in the configuration reached, for nodes that land in the step as well"},
    {"contact", CPSI_WORD, CPSI_OPTIONAL, AT(CpsScene, contact), "", NO_RANGE, 0, 0, "gained strict", "\"gained\"",
     "gained: no node ends a step below the obstacle; strict: only nodes that touch it when the step starts are "
     "kept out"},
    {"solver", CPSI_MAPPING, CPSI_OPTIONAL, SAME, "", MAP(CPSI_SOLVER), "{}", "how steps are solved"},
    {"history", CPSI_LIST, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_STAGE), "[]",
     "what happens to the lines' ends and to obstacles that turn, in turn"},
};

static const CpsiKey OBSTACLES_KEYS[] = {
    {"NAME", CPSI_MAPPING, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_OBSTACLE), NULL, "an obstacle"},
};

static const CpsiKey OBSTACLE_KEYS[] = {
    {"plane", CPSI_MAPPING, CPSI_ONE_OF, SAME, "", MAP(CPSI_PLANE), NULL,
     "a plane; lines stay on one side of it"},
    {"cylinder", CPSI_MAPPING, CPSI_ONE_OF, SAME, "", MAP(CPSI_CYLINDER), NULL,
     "a solid cylinder without ends (bollard, pipe, drum); lines stay outside"},
    {"sphere", CPSI_MAPPING, CPSI_ONE_OF, SAME, "", MAP(CPSI_SPHERE), NULL,
     "a solid ball; lines stay outside"},
    {"friction", CPSI_NUMBER_OR_MAPPING, CPSI_OPTIONAL, AT(CpsObstacle, friction), "", NOT_NEGATIVE, 0, CPSI_FRICTION, NULL, "0",
     "Coulomb friction coefficient; or one along the line or the grain and another across it, or a set of forces"},
};

static const CpsiKey PLANE_KEYS[] = {
    {"point", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, point), "m", ANY, 3, 0, NULL, "[0, 0, 0]", "a point of the plane"},
    {"normal", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, normal), "", ANY, 3, 0, NULL, "[0, 0, 1]",
     "points to the side where lines may be; of any length but zero"},
};

static const CpsiKey CYLINDER_KEYS[] = {
    {"point", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, point), "m", ANY, 3, 0, NULL, "[0, 0, 0]", "a point of the axis"},
    {"axis", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, axis), "", ANY, 3, 0, NULL, "[0, 1, 0]",
     "direction of the axis, of any length but zero; a turn follows it by the right-hand rule"},
    {"radius", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsObstacle, radius), "m", POSITIVE, 0, 0, NULL, NULL, "radius of the cylinder"},
};

static const CpsiKey SPHERE_KEYS[] = {
    {"center", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, point), "m", ANY, 3, 0, NULL, "[0, 0, 0]", "centre of the ball"},
    {"axis", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, axis), "", ANY, 3, 0, NULL, "[0, 1, 0]",
     "what the ball turns about, through its centre; of any length but zero"},
    {"radius", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsObstacle, radius), "m", POSITIVE, 0, 0, NULL, NULL, "radius of the ball"},
};

static const CpsiKey FRICTION_KEYS[] = {
    {"axial", CPSI_NUMBER, CPSI_ONE_OF, AT(CpsObstacle, friction), "", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "coefficient along the line, or along the grain"},
    {"set", CPSI_SET, CPSI_ONE_OF, BY_HAND, "", NO_RANGE, 0, 0, NULL, NULL,
     "friction forces on the line per unit of normal force, along the line or the grain and across it to its left: "
     "any bounded set of the plane with 0 in it, in the words of law files"},
    {"lateral", CPSI_NUMBER, CPSI_OPTIONAL, AT(CpsObstacle, friction_lateral), "", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "coefficient across it; by default the axial one"},
    {"shape", CPSI_WORD, CPSI_OPTIONAL, AT(CpsObstacle, friction_shape), "", NO_RANGE, 0, 0, "ellipse box", "\"ellipse\"",
     "ellipse: one law for both directions; box: two independent laws"},
    {"grain", CPSI_POINT, CPSI_OPTIONAL, AT(CpsObstacle, grain), "", ANY, 3, 0, NULL, "[0, 0, 0]",
     "direction of the axial coefficient or of the set's first component, fixed in space, as far as it lies in the "
     "surface; [0, 0, 0]: that of the line"},
};

static const CpsiKey LINES_KEYS[] = {
    {"NAME", CPSI_MAPPING, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_LINE), NULL, "a line from its end A to its end B"},
};

static const CpsiKey LINE_KEYS[] = {
    {"length", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsLine, length), "m", POSITIVE, 0, 0, NULL, NULL, "unstretched length"},
    {"elements", CPSI_ELEMENTS, CPSI_OPTIONAL, BY_HAND, "", POSITIVE, 0, 0, NULL, "100",
     "number of equal elements; or from A to B a list of element lengths [m] and of pairs [count, length]: count equal "
     "elements that are length [m] long together"},
    {"mass", CPSI_NUMBER, CPSI_ONE_OF, BY_HAND, "kg/m", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "mass per unstretched length; the weight is mass times gravity"},
    {"weight", CPSI_NUMBER, CPSI_ONE_OF, AT(CpsLine, weight), "N/m", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "weight per unstretched length (in water: the submerged one), instead of mass"},
    {"stiffness", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsLine, stiffness), "N", 0, INFINITY, true, 0, 0, NULL, NULL,
     "axial stiffness EA; .inf for an inextensible line"},
    {"friction_zones", CPSI_LIST, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_ZONE), "[]",
     "stretches that rub otherwise, in order from A to B, without overlap"},
    {"start", CPSI_MAPPING, CPSI_REQUIRED, BY_HAND, "", NO_RANGE, 0, CPSI_START, "laid", NULL,
     "shape the line starts from, as long as the line (an elastic one may be stretched); laid: the equilibrium without "
     "friction, found first"},
    {"ends", CPSI_MAPPING, CPSI_REQUIRED, BY_HAND, "", MAP(CPSI_ENDS), NULL, "what holds or pulls the two ends"},
};

static const CpsiKey ZONE_KEYS[] = {
    {"from", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsFrictionZone, from), "m", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "unstretched length from end A at which the stretch begins"},
    {"to", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsFrictionZone, to), "m", POSITIVE, 0, 0, NULL, NULL, "where it ends"},
    {"factor", CPSI_NUMBER, CPSI_REQUIRED, AT(CpsFrictionZone, factor), "", NOT_NEGATIVE, 0, 0, NULL, NULL,
     "of the friction of whatever it touches; 1 elsewhere"},
};

static const CpsiKey START_KEYS[] = {
    {"straight", CPSI_MAPPING, CPSI_ONE_OF, BY_HAND, "", MAP(CPSI_STRAIGHT), NULL, "a straight line"},
    {"polyline", CPSI_POINTS, CPSI_ONE_OF, BY_HAND, "m", ANY, 3, 0, NULL, NULL, "straight pieces between these points"},
    {"arc", CPSI_MAPPING, CPSI_ONE_OF, BY_HAND, "", MAP(CPSI_ARC), NULL,
     "as much of a circle as the line is long, at most one turn; free of stress"},
    {"nodes", CPSI_TEXT, CPSI_ONE_OF, BY_HAND, "", NO_RANGE, 0, 0, NULL, NULL,
     "any configuration: a CSV file beside this one with the nodes' places and, where they are known, natural lengths and forces"},
};

static const CpsiKey STRAIGHT_KEYS[] = {
    {"from", CPSI_POINT, CPSI_REQUIRED, BY_HAND, "m", ANY, 3, 0, NULL, NULL, "where end A starts"},
    {"to", CPSI_POINT, CPSI_REQUIRED, BY_HAND, "m", ANY, 3, 0, NULL, NULL, "where end B starts"},
};

static const CpsiKey ARC_KEYS[] = {
    {"from", CPSI_POINT, CPSI_REQUIRED, BY_HAND, "m", ANY, 3, 0, NULL, NULL, "where end A starts"},
    {"center", CPSI_POINT, CPSI_REQUIRED, BY_HAND, "m", ANY, 3, 0, NULL, NULL, "a point on the circle's axis"},
    {"axis", CPSI_POINT, CPSI_OPTIONAL, BY_HAND, "", ANY, 3, 0, NULL, "[0, 0, 1]",
     "direction of the axis; the line turns about it by the right-hand rule"},
};

static const CpsiKey ENDS_KEYS[] = {
    {"A", CPSI_MAPPING, CPSI_REQUIRED, BY_HAND, "", NO_RANGE, 0, CPSI_END, "fixed free", NULL,
     "the first end; fixed: where the start puts it; free: without force"},
    {"B", CPSI_MAPPING, CPSI_REQUIRED, BY_HAND, "", NO_RANGE, 0, CPSI_END, "fixed free", NULL, "the last end, likewise"},
};

static const CpsiKey END_KEYS[] = {
    {"fixed", CPSI_POINT, CPSI_ONE_OF, BY_HAND, "m", ANY, 3, 0, NULL, NULL,
     "held at this position, which must be that of the start shape"},
    {"force", CPSI_POINT, CPSI_ONE_OF, BY_HAND, "N", ANY, 3, 0, NULL, NULL, "free, pulled with this force"},
};

static const CpsiKey SOLVER_KEYS[] = {
    {"tolerance", CPSI_NUMBER, CPSI_OPTIONAL, AT(CpsScene, solver.tolerance), "", 1e-14, 1e-2, false, 0, 0, NULL, "1e-8",
     "a step is certified when its duality gap is at most this times the scale of its energies"},
    {"max_iterations", CPSI_INTEGER, CPSI_OPTIONAL, AT(CpsScene, solver.max_iterations), "", 1, 1000, false, 0, 0, NULL, "60",
     "of one solve of a line; 20 more for each doubling of its elements beyond 12 800"},
    {"path_tolerance", CPSI_NUMBER, CPSI_OPTIONAL, AT(CpsScene, solver.path_tolerance), "", 0, 1, false, 0, 0, NULL, "0",
     "a step is cut until going in halves changes ways per length and tensions per largest force by no more; 0: "
     "steps as given"},
    {"halvings", CPSI_INTEGER, CPSI_OPTIONAL, AT(CpsScene, solver.halvings), "", 0, 30, false, 0, 0, NULL, "10",
     "how often a step may be halved, for the path or because it does not converge"},
    {"linear_system", CPSI_WORD, CPSI_OPTIONAL, AT(CpsScene, solver.linear_system), "", NO_RANGE, 0, 0, "chain dense", "\"chain\"",
     "dense: for comparison on small lines"},
};

static const CpsiKey STAGE_KEYS[] = {
    {"name", CPSI_TEXT, CPSI_OPTIONAL, AT(CpsStage, name), "", NO_RANGE, 0, 0, NULL, NULL,
     "name of the entry in the results; by default its number"},
    {"steps", CPSI_INTEGER, CPSI_OPTIONAL, AT(CpsStage, steps), "", 1, 1e6, false, 0, 0, NULL, "1",
     "go there in so many equal load steps"},
    {"gravity", CPSI_POINT, CPSI_OPTIONAL, AT(CpsStage, gravity), "m/s2", ANY, 3, 0, NULL, NULL,
     "what gravity becomes in this entry, evenly over its steps; the weight of all lines goes with it"},
    {"LINE.END", CPSI_MAPPING, CPSI_OPTIONAL, BY_HAND, "", MAP(CPSI_CHANGE), NULL,
     "what happens to an end of a line, as in cable.B; all other ends stay as they are"},
    {"OBSTACLE.turn", CPSI_NUMBER, CPSI_OPTIONAL, BY_HAND, "degrees", ANY, 0, 0, NULL, NULL,
     "turn a cylinder or ball by so much in this entry, as in drum.turn, by the right-hand rule about its axis"},
};

static const CpsiKey CHANGE_KEYS[] = {
    {"position", CPSI_POINT, CPSI_ONE_OF, BY_HAND, "m", ANY, 3, 0, NULL, NULL,
     "move the end to this position; a free end is grabbed where it is"},
    {"move", CPSI_POINT, CPSI_ONE_OF, BY_HAND, "m", ANY, 3, 0, NULL, NULL,
     "move the end by this much from where the entry before has put it"},
    {"force", CPSI_POINT, CPSI_ONE_OF, BY_HAND, "N", ANY, 3, 0, NULL, NULL,
     "pull with this force; a held end is let go, from the force it carries"},
};

#define MAPPING(name, keys) {name, keys, sizeof keys / sizeof keys[0]}
static const struct {
    const char *name;
    const CpsiKey *key;
    int count;
} OBJECT[CPSI_OBJECT_COUNT] = {
    [CPSI_SCENE] = MAPPING("scene", SCENE_KEYS),
    [CPSI_OBSTACLES] = MAPPING("obstacles", OBSTACLES_KEYS),
    [CPSI_OBSTACLE] = MAPPING("obstacle", OBSTACLE_KEYS),
    [CPSI_PLANE] = MAPPING("plane", PLANE_KEYS),
    [CPSI_CYLINDER] = MAPPING("cylinder", CYLINDER_KEYS),
    [CPSI_SPHERE] = MAPPING("sphere", SPHERE_KEYS),
    [CPSI_FRICTION] = MAPPING("friction", FRICTION_KEYS),
    [CPSI_LINES] = MAPPING("lines", LINES_KEYS),
    [CPSI_LINE] = MAPPING("line", LINE_KEYS),
    [CPSI_ZONE] = MAPPING("zone", ZONE_KEYS),
    [CPSI_START] = MAPPING("start", START_KEYS),
    [CPSI_STRAIGHT] = MAPPING("straight", STRAIGHT_KEYS),
    [CPSI_ARC] = MAPPING("arc", ARC_KEYS),
    [CPSI_ENDS] = MAPPING("ends", ENDS_KEYS),
    [CPSI_END] = MAPPING("end", END_KEYS),
    [CPSI_SOLVER] = MAPPING("solver", SOLVER_KEYS),
    [CPSI_STAGE] = MAPPING("entry", STAGE_KEYS),
    [CPSI_CHANGE] = MAPPING("change", CHANGE_KEYS),
};
/* clang-format on */

const CpsiKey *cpsi_keys(CpsiObject object, int *count) {
    *count = OBJECT[object].count;
    return OBJECT[object].key;
}

const char *cpsi_object_name(CpsiObject object) { return OBJECT[object].name; }

char cpsi_key_end(const char *written) {
    const char *dot = strrchr(written, '.');
    return dot && dot > written && (dot[1] == 'A' || dot[1] == 'B') && !dot[2] ? dot[1] : 0;
}

bool cpsi_key_is_turn(const char *written) {
    const char *dot = strrchr(written, '.');
    return dot && dot > written && strcmp(dot, ".turn") == 0;
}

const CpsiKey *cpsi_key_find(CpsiObject object, const char *written) {
    int count;
    const CpsiKey *keys = cpsi_keys(object, &count);
    for (int i = 0; i < count; i++) {
        const bool any = strcmp(keys[i].name, "NAME") == 0;
        const bool end = strcmp(keys[i].name, "LINE.END") == 0 && cpsi_key_end(written);
        const bool turn = strcmp(keys[i].name, "OBSTACLE.turn") == 0 && cpsi_key_is_turn(written);
        if (any || end || turn || strcmp(keys[i].name, written) == 0) return &keys[i];
    }
    return NULL;
}

/* ", greater than 0", ", from 1 to 1000", ... */
static void range_text(const CpsiKey *key, char *text, size_t size) {
    const char *inf = isinf(key->high) ? ", or .inf" : "";
    text[0] = '\0';
    if (key->low <= -LARGEST) return;
    if (key->high < LARGEST && key->low == key->high)
        snprintf(text, size, ": %g", key->low);
    else if (key->high < LARGEST)
        snprintf(text, size, ", from %g to %g", key->low, key->high);
    else
        snprintf(text, size, ", %s %g%s", key->open ? "greater than" : "at least", key->low, inf);
}

const char *cpsi_key_expected(const CpsiKey *key, char *text, size_t size) {
    char range[80];
    range_text(key, range, sizeof range);
    const char *in = key->unit[0] ? " in " : "";
    switch (key->type) {
    case CPSI_NUMBER:
        snprintf(text, size, "a number%s%s%s", in, key->unit, range);
        break;
    case CPSI_INTEGER:
        snprintf(text, size, "a whole number%s", range);
        break;
    case CPSI_TEXT:
        snprintf(text, size, "a text");
        break;
    case CPSI_POINT:
        snprintf(text, size, "three numbers%s%s, as in [x, y, z]", in, key->unit);
        break;
    case CPSI_POINTS:
        snprintf(text, size, "at least two points%s%s, as in [[x, y, z], [x, y, z]]", in, key->unit);
        break;
    case CPSI_ELEMENTS:
        snprintf(text, size, "a whole number, at least 1, or a list of lengths and [count, length] in m");
        break;
    case CPSI_LIST:
        snprintf(text, size, "a list, as in [{...}, {...}]");
        break;
    case CPSI_SET:
        snprintf(text, size, "a set, as in {disc: 0.5}");
        break;
    case CPSI_WORD:
        if (strchr(key->words, ' '))
            snprintf(text, size, "one of: %s", key->words);
        else
            snprintf(text, size, "'%s'", key->words);
        break;
    case CPSI_MAPPING:
    case CPSI_NUMBER_OR_MAPPING: {
        /* the keys it may hold */
        int count;
        const CpsiKey *keys = cpsi_keys((CpsiObject)key->inside, &count);
        const bool number = key->type == CPSI_NUMBER_OR_MAPPING;
        const size_t used =
            (size_t)snprintf(text, size, "%s%s%s%sa mapping with ", number ? "a number" : "", number ? range : "",
                             key->words ? key->words : "", number || key->words ? ", or " : "");
        if (used < size) cpsi_key_list(keys, count, text + used, size - used);
        break;
    }
    default:
        text[0] = '\0'; /* not of scenes */
    }
    return text;
}
