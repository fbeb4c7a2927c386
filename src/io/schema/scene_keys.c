/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of keys (see scene_keys.h). */
#include "io/schema/scene_keys.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* clang-format off */

/* ranges: lowest, highest, lowest excluded. Beyond 1e100 squares would overflow (cps_scene_check). */
#define LARGEST      1e100
#define ANY          -LARGEST, LARGEST, false
#define POSITIVE     0, LARGEST, true
#define NOT_NEGATIVE 0, LARGEST, false
#define NO_RANGE     0, 0, false
#define MAP(object)  NO_RANGE, object, NULL

static const CpsiKey KEYS[] = {
    /* where, name, type, need, unit, range, inside, words, default, help */
    {CPSI_SCENE, "capstan", CPSI_INTEGER, CPSI_REQUIRED, "", 1, 1, false, 0, NULL, NULL,
     "version of this file format"},
    {CPSI_SCENE, "title", CPSI_TEXT, CPSI_OPTIONAL, "", NO_RANGE, 0, NULL, NULL,
     "what the scene shows; printed with the results"},
    {CPSI_SCENE, "gravity", CPSI_VECTOR, CPSI_OPTIONAL, "m/s2", ANY, 0, NULL, "[0, 0, -9.81]",
     "acceleration of gravity; its direction is that of the lines' weight"},
    {CPSI_SCENE, "obstacles", CPSI_MAPPING, CPSI_OPTIONAL, "", MAP(CPSI_OBSTACLES), "{}",
     "what the lines lie on, by name; each node rests on the nearest one, or on the two nearest"},
    {CPSI_SCENE, "lines", CPSI_MAPPING, CPSI_REQUIRED, "", MAP(CPSI_LINES), NULL,
     "the lines by name; they do not touch one another"},
    {CPSI_SCENE, "friction", CPSI_WORD, CPSI_OPTIONAL, "", NO_RANGE, 0, "frozen consistent", "\"consistent\"",
     "frozen: the friction bound of a step is taken from the configuration the step starts from; consistent: it is mu "
     "times the reaction in the configuration reached, for nodes that land in the step as well"},
    {CPSI_SCENE, "contact", CPSI_WORD, CPSI_OPTIONAL, "", NO_RANGE, 0, "gained strict", "\"gained\"",
     "gained: no node ends a step below the obstacle; strict: only nodes that touch it when the step starts are "
     "kept out"},
    {CPSI_SCENE, "solver", CPSI_MAPPING, CPSI_OPTIONAL, "", MAP(CPSI_SOLVER), "{}", "how steps are solved"},
    {CPSI_SCENE, "history", CPSI_LIST, CPSI_OPTIONAL, "", MAP(CPSI_STAGE), "[]",
     "what happens to the lines' ends and to obstacles that turn, in turn"},

    {CPSI_OBSTACLES, "NAME", CPSI_MAPPING, CPSI_OPTIONAL, "", MAP(CPSI_OBSTACLE), NULL, "an obstacle"},
    {CPSI_OBSTACLE, "plane", CPSI_MAPPING, CPSI_ONE_OF, "", MAP(CPSI_PLANE), NULL,
     "a plane; lines stay on one side of it"},
    {CPSI_OBSTACLE, "cylinder", CPSI_MAPPING, CPSI_ONE_OF, "", MAP(CPSI_CYLINDER), NULL,
     "a solid cylinder without ends (bollard, pipe, drum); lines stay outside"},
    {CPSI_OBSTACLE, "sphere", CPSI_MAPPING, CPSI_ONE_OF, "", MAP(CPSI_SPHERE), NULL,
     "a solid ball; lines stay outside"},
    {CPSI_OBSTACLE, "friction", CPSI_NUMBER_OR_MAPPING, CPSI_OPTIONAL, "", NOT_NEGATIVE, CPSI_FRICTION, NULL, "0",
     "Coulomb friction coefficient; or one along the line or the grain and another across it, or a set of forces"},
    {CPSI_PLANE, "point", CPSI_VECTOR, CPSI_OPTIONAL, "m", ANY, 0, NULL, "[0, 0, 0]", "a point of the plane"},
    {CPSI_PLANE, "normal", CPSI_VECTOR, CPSI_OPTIONAL, "", ANY, 0, NULL, "[0, 0, 1]",
     "points to the side where lines may be; of any length but zero"},
    {CPSI_CYLINDER, "point", CPSI_VECTOR, CPSI_OPTIONAL, "m", ANY, 0, NULL, "[0, 0, 0]", "a point of the axis"},
    {CPSI_CYLINDER, "axis", CPSI_VECTOR, CPSI_OPTIONAL, "", ANY, 0, NULL, "[0, 1, 0]",
     "direction of the axis, of any length but zero; a turn follows it by the right-hand rule"},
    {CPSI_CYLINDER, "radius", CPSI_NUMBER, CPSI_REQUIRED, "m", POSITIVE, 0, NULL, NULL, "radius of the cylinder"},
    {CPSI_SPHERE, "center", CPSI_VECTOR, CPSI_OPTIONAL, "m", ANY, 0, NULL, "[0, 0, 0]", "centre of the ball"},
    {CPSI_SPHERE, "axis", CPSI_VECTOR, CPSI_OPTIONAL, "", ANY, 0, NULL, "[0, 1, 0]",
     "what the ball turns about, through its centre; of any length but zero"},
    {CPSI_SPHERE, "radius", CPSI_NUMBER, CPSI_REQUIRED, "m", POSITIVE, 0, NULL, NULL, "radius of the ball"},
    {CPSI_FRICTION, "axial", CPSI_NUMBER, CPSI_ONE_OF, "", NOT_NEGATIVE, 0, NULL, NULL,
     "coefficient along the line, or along the grain"},
    {CPSI_FRICTION, "set", CPSI_SET, CPSI_ONE_OF, "", NO_RANGE, 0, NULL, NULL,
     "friction forces on the line per unit of normal force, along the line or the grain and across it to its left: "
     "any bounded set of the plane with 0 in it, in the words of law files"},
    {CPSI_FRICTION, "lateral", CPSI_NUMBER, CPSI_OPTIONAL, "", NOT_NEGATIVE, 0, NULL, NULL,
     "coefficient across it; by default the axial one"},
    {CPSI_FRICTION, "shape", CPSI_WORD, CPSI_OPTIONAL, "", NO_RANGE, 0, "ellipse box", "\"ellipse\"",
     "ellipse: one law for both directions; box: two independent laws"},
    {CPSI_FRICTION, "grain", CPSI_VECTOR, CPSI_OPTIONAL, "", ANY, 0, NULL, "[0, 0, 0]",
     "direction of the axial coefficient or of the set's first component, fixed in space, as far as it lies in the "
     "surface; [0, 0, 0]: that of the line"},

    {CPSI_LINES, "NAME", CPSI_MAPPING, CPSI_OPTIONAL, "", MAP(CPSI_LINE), NULL, "a line from its end A to its end B"},
    {CPSI_LINE, "length", CPSI_NUMBER, CPSI_REQUIRED, "m", POSITIVE, 0, NULL, NULL, "unstretched length"},
    {CPSI_LINE, "elements", CPSI_ELEMENTS, CPSI_OPTIONAL, "", POSITIVE, 0, NULL, "100",
     "number of equal elements; or from A to B a list of element lengths [m] and of pairs [count, length]: count equal "
     "elements that are length [m] long together"},
    {CPSI_LINE, "mass", CPSI_NUMBER, CPSI_ONE_OF, "kg/m", NOT_NEGATIVE, 0, NULL, NULL,
     "mass per unstretched length; the weight is mass times gravity"},
    {CPSI_LINE, "weight", CPSI_NUMBER, CPSI_ONE_OF, "N/m", NOT_NEGATIVE, 0, NULL, NULL,
     "weight per unstretched length (in water: the submerged one), instead of mass"},
    {CPSI_LINE, "stiffness", CPSI_NUMBER, CPSI_REQUIRED, "N", 0, INFINITY, true, 0, NULL, NULL,
     "axial stiffness EA; .inf for an inextensible line"},
    {CPSI_LINE, "friction_zones", CPSI_LIST, CPSI_OPTIONAL, "", MAP(CPSI_ZONE), "[]",
     "stretches that rub otherwise, in order from A to B, without overlap"},
    {CPSI_LINE, "start", CPSI_MAPPING, CPSI_REQUIRED, "", NO_RANGE, CPSI_START, "laid", NULL,
     "shape the line starts from, as long as the line (an elastic one may be stretched); laid: the equilibrium without "
     "friction, found first"},
    {CPSI_LINE, "ends", CPSI_MAPPING, CPSI_REQUIRED, "", MAP(CPSI_ENDS), NULL, "what holds or pulls the two ends"},

    {CPSI_ZONE, "from", CPSI_NUMBER, CPSI_REQUIRED, "m", NOT_NEGATIVE, 0, NULL, NULL,
     "unstretched length from end A at which the stretch begins"},
    {CPSI_ZONE, "to", CPSI_NUMBER, CPSI_REQUIRED, "m", POSITIVE, 0, NULL, NULL, "where it ends"},
    {CPSI_ZONE, "factor", CPSI_NUMBER, CPSI_REQUIRED, "", NOT_NEGATIVE, 0, NULL, NULL,
     "of the friction of whatever it touches; 1 elsewhere"},

    {CPSI_START, "straight", CPSI_MAPPING, CPSI_ONE_OF, "", MAP(CPSI_STRAIGHT), NULL, "a straight line"},
    {CPSI_START, "polyline", CPSI_POINTS, CPSI_ONE_OF, "m", ANY, 0, NULL, NULL, "straight pieces between these points"},
    {CPSI_START, "arc", CPSI_MAPPING, CPSI_ONE_OF, "", MAP(CPSI_ARC), NULL,
     "as much of a circle as the line is long, at most one turn; free of stress"},
    {CPSI_START, "nodes", CPSI_TEXT, CPSI_ONE_OF, "", NO_RANGE, 0, NULL, NULL,
     "any configuration: a CSV file beside this one with the nodes' places and, where they are known, natural lengths and forces"},
    {CPSI_STRAIGHT, "from", CPSI_VECTOR, CPSI_REQUIRED, "m", ANY, 0, NULL, NULL, "where end A starts"},
    {CPSI_STRAIGHT, "to", CPSI_VECTOR, CPSI_REQUIRED, "m", ANY, 0, NULL, NULL, "where end B starts"},
    {CPSI_ARC, "from", CPSI_VECTOR, CPSI_REQUIRED, "m", ANY, 0, NULL, NULL, "where end A starts"},
    {CPSI_ARC, "center", CPSI_VECTOR, CPSI_REQUIRED, "m", ANY, 0, NULL, NULL, "a point on the circle's axis"},
    {CPSI_ARC, "axis", CPSI_VECTOR, CPSI_OPTIONAL, "", ANY, 0, NULL, "[0, 0, 1]",
     "direction of the axis; the line turns about it by the right-hand rule"},

    {CPSI_ENDS, "A", CPSI_MAPPING, CPSI_REQUIRED, "", NO_RANGE, CPSI_END, "fixed free", NULL,
     "the first end; fixed: where the start puts it; free: without force"},
    {CPSI_ENDS, "B", CPSI_MAPPING, CPSI_REQUIRED, "", NO_RANGE, CPSI_END, "fixed free", NULL, "the last end, likewise"},
    {CPSI_END, "fixed", CPSI_VECTOR, CPSI_ONE_OF, "m", ANY, 0, NULL, NULL,
     "held at this position, which must be that of the start shape"},
    {CPSI_END, "force", CPSI_VECTOR, CPSI_ONE_OF, "N", ANY, 0, NULL, NULL, "free, pulled with this force"},

    {CPSI_SOLVER, "tolerance", CPSI_NUMBER, CPSI_OPTIONAL, "", 1e-14, 1e-2, false, 0, NULL, "1e-8",
     "a step is certified when its duality gap is at most this times the scale of its energies"},
    {CPSI_SOLVER, "max_iterations", CPSI_INTEGER, CPSI_OPTIONAL, "", 1, 1000, false, 0, NULL, "60",
     "of one solve of a line; 20 more for each doubling of its elements beyond 12 800"},
    {CPSI_SOLVER, "path_tolerance", CPSI_NUMBER, CPSI_OPTIONAL, "", 0, 1, false, 0, NULL, "0",
     "a step is cut until going in halves changes ways per length and tensions per largest force by no more; 0: "
     "steps as given"},
    {CPSI_SOLVER, "halvings", CPSI_INTEGER, CPSI_OPTIONAL, "", 0, 30, false, 0, NULL, "10",
     "how often a step may be halved, for the path or because it does not converge"},
    {CPSI_SOLVER, "linear_system", CPSI_WORD, CPSI_OPTIONAL, "", NO_RANGE, 0, "chain dense", "\"chain\"",
     "dense: for comparison on small lines"},

    {CPSI_STAGE, "name", CPSI_TEXT, CPSI_OPTIONAL, "", NO_RANGE, 0, NULL, NULL,
     "name of the entry in the results; by default its number"},
    {CPSI_STAGE, "steps", CPSI_INTEGER, CPSI_OPTIONAL, "", 1, 1e6, false, 0, NULL, "1",
     "go there in so many equal load steps"},
    {CPSI_STAGE, "LINE.END", CPSI_MAPPING, CPSI_OPTIONAL, "", MAP(CPSI_CHANGE), NULL,
     "what happens to an end of a line, as in cable.B; all other ends stay as they are"},
    {CPSI_STAGE, "OBSTACLE.turn", CPSI_NUMBER, CPSI_OPTIONAL, "degrees", ANY, 0, NULL, NULL,
     "turn a cylinder or ball by so much in this entry, as in drum.turn, by the right-hand rule about its axis"},
    {CPSI_CHANGE, "position", CPSI_VECTOR, CPSI_ONE_OF, "m", ANY, 0, NULL, NULL,
     "move the end to this position; a free end is grabbed where it is"},
    {CPSI_CHANGE, "move", CPSI_VECTOR, CPSI_ONE_OF, "m", ANY, 0, NULL, NULL,
     "move the end by this much from where the entry before has put it"},
    {CPSI_CHANGE, "force", CPSI_VECTOR, CPSI_ONE_OF, "N", ANY, 0, NULL, NULL,
     "pull with this force; a held end is let go, from the force it carries"},
};
/* clang-format on */
enum { KEY_COUNT = sizeof KEYS / sizeof KEYS[0] };

static const char *const OBJECTS[CPSI_OBJECT_COUNT] = {
    "scene", "obstacles", "obstacle", "plane", "cylinder", "sphere", "friction", "lines", "line",
    "zone",  "start",     "straight", "arc",   "ends",     "end",    "solver",   "entry", "change",
};

const CpsiKey *cpsi_keys(CpsiObject object, int *count) {
    int first = 0, end;
    while (first < KEY_COUNT && KEYS[first].where != object) first++;
    for (end = first; end < KEY_COUNT && KEYS[end].where == object;) end++;
    *count = end - first;
    return &KEYS[first];
}

const char *cpsi_object_name(CpsiObject object) { return OBJECTS[object]; }

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

int cpsi_key_word(const CpsiKey *key, const char *written) {
    const size_t n = strlen(written);
    int number = 0;
    for (const char *word = key->words; word && *word; number++) {
        const size_t length = strcspn(word, " ");
        if (length == n && memcmp(word, written, n) == 0) return number;
        word += length + (word[length] == ' ');
    }
    return -1;
}

/* Edits (insert, delete, replace a letter, capitals ignored) between two words of at most 31 letters; else 32. */
static int edit_distance(const char *a, const char *b) {
    enum { MOST = 32 };
    const size_t na = strlen(a), nb = strlen(b);
    if (na >= MOST || nb >= MOST) return MOST;
    int row[MOST];
    for (size_t j = 0; j <= nb; j++) row[j] = (int)j;
    for (size_t i = 1; i <= na; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= nb; j++) {
            const int above = row[j];
            const bool same = tolower((unsigned char)a[i - 1]) == tolower((unsigned char)b[j - 1]);
            int least = diagonal + (same ? 0 : 1);
            if (above + 1 < least) least = above + 1;
            if (row[j - 1] + 1 < least) least = row[j - 1] + 1;
            row[j] = least;
            diagonal = above;
        }
    }
    return row[nb];
}

void cpsi_suggest(CpsiSuggestion *suggestion, const char *candidate) {
    const int distance = edit_distance(suggestion->word, candidate);
    const int allowed = ((int)strlen(candidate) + 2) / 3;
    if (distance <= allowed && (!suggestion->best || distance < suggestion->distance))
        suggestion->best = candidate, suggestion->distance = distance;
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
    case CPSI_VECTOR:
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
        const CpsiKey *keys = cpsi_keys(key->inside, &count);
        const bool number = key->type == CPSI_NUMBER_OR_MAPPING;
        size_t used =
            (size_t)snprintf(text, size, "%s%s%s%sa mapping with ", number ? "a number" : "", number ? range : "",
                             key->words ? key->words : "", number || key->words ? ", or " : "");
        for (int i = 0; i < count && used < size; i++)
            used += (size_t)snprintf(text + used, size - used, "%s%s", i ? ", " : "", keys[i].name);
        break;
    }
    }
    return text;
}
