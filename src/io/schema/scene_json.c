/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schema (draft 2020-12) of scene files, from the table of keys: one definition per kind of mapping, and those
 * of sets. */
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#include "capstan/io.h"
#include "io/base/escape.h"
#include "io/schema/json_schema.h"
#include "io/schema/scene_keys.h"
#include "io/schema/set_json.h"

static const char *name_of(int object) { return cpsi_object_name((CpsiObject)object); }

/* The form of a row's key as a regular expression; NULL where it has a fixed name. */
static const char *pattern_of(const CpsiKey *key) {
    if (strcmp(key->name, "NAME") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}$";
    if (strcmp(key->name, "LINE.END") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}\\.[AB]$";
    if (strcmp(key->name, "OBSTACLE.turn") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}\\.turn$";
    return NULL;
}

/* Keys with a fixed name (or, if `patterns`, those of a form), one line each. */
static int write_rows(FILE *out, const CpsiKey *keys, int count, bool patterns) {
    int written = 0;
    for (int i = 0; i < count; i++) {
        const char *pattern = pattern_of(&keys[i]);
        if ((pattern != NULL) != patterns) continue;
        fprintf(out, "%s\n        ", written++ ? "," : "");
        cpsi_write_json_string(out, pattern ? pattern : keys[i].name);
        fprintf(out, ": ");
        cpsi_draw_key(out, &keys[i], name_of);
    }
    return written;
}

static void write_object(FILE *out, CpsiObject object) {
    int count, rows = 0;
    const CpsiKey *keys = cpsi_keys(object, &count);
    fprintf(out, "    ");
    cpsi_write_json_string(out, cpsi_object_name(object));
    fprintf(out, ": {\n      \"type\": \"object\", \"additionalProperties\": false,\n      \"properties\": {");
    rows = write_rows(out, keys, count, false);
    fprintf(out, "%s},\n      \"patternProperties\": {", rows ? "\n      " : "");
    rows = write_rows(out, keys, count, true);
    fprintf(out, "%s},\n      \"required\": [", rows ? "\n      " : "");
    for (int i = 0, n = 0; i < count; i++)
        if (keys[i].need == CPSI_REQUIRED) fprintf(out, "%s\"%s\"", n++ ? ", " : "", keys[i].name);
    fprintf(out, "]");
    int alternatives = 0;
    for (int i = 0; i < count; i++)
        if (keys[i].need == CPSI_ONE_OF)
            fprintf(out, "%s{\"required\": [\"%s\"]}", alternatives++ ? ", " : ",\n      \"oneOf\": [", keys[i].name);
    fprintf(out, "%s\n    }", alternatives ? "]" : "");
}

static void write_schema(FILE *out) {
    fprintf(out, "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
                 "  \"title\": \"capstan scene, format version 1\",\n  ");
    fprintf(out, "\"$ref\": \"#/$defs/%s\"", name_of(CPSI_SCENE));
    fprintf(out, ",\n  \"$defs\": {\n");
    for (int i = 0; i < CPSI_OBJECT_COUNT; i++) {
        write_object(out, (CpsiObject)i);
        fprintf(out, ",\n");
    }
    cpsi_write_set_definitions(out);
    fprintf(out, "  }\n}\n");
}

CpsStatus cps_scene_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, write_schema, err); }
