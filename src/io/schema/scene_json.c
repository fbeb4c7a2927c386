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

static void put_number(FILE *out, const char *key, double x) {
    fprintf(out, ", \"%s\": ", key);
    cpsi_put_json_number(out, x);
}

static void put_range(FILE *out, const CpsiKey *key) {
    if (key->low > -1e100) put_number(out, key->open ? "exclusiveMinimum" : "minimum", key->low);
    if (key->high < 1e100) put_number(out, "maximum", key->high);
}

static void put_reference(FILE *out, CpsiObject object) {
    fprintf(out, "\"$ref\": \"#/$defs/%s\"", cpsi_object_name(object));
}

static void put_words(FILE *out, const char *words) {
    fprintf(out, "\"enum\": [\"");
    for (const char *c = words; *c; c++) fputs(*c == ' ' ? "\", \"" : (char[]){*c, '\0'}, out);
    fprintf(out, "\"]");
}

/* What values a row accepts. */
static void put_type(FILE *out, const CpsiKey *key) {
    static const char VECTOR[] =
        "\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 3, \"maxItems\": 3";
    switch (key->type) {
    case CPSI_NUMBER:
        fprintf(out, "\"type\": \"number\"");
        put_range(out, key);
        break;
    case CPSI_INTEGER:
        fprintf(out, "\"type\": \"integer\"");
        put_range(out, key);
        break;
    case CPSI_TEXT:
        fprintf(out, "\"type\": [\"string\", \"number\"], \"minLength\": 1");
        break;
    case CPSI_WORD:
        put_words(out, key->words);
        break;
    case CPSI_POINT:
        fprintf(out, "%s", VECTOR);
        break;
    case CPSI_POINTS:
        fprintf(out, "\"type\": \"array\", \"items\": {%s}, \"minItems\": 2", VECTOR);
        break;
    case CPSI_ELEMENTS:
        fprintf(
            out,
            "\"oneOf\": [{\"type\": \"integer\", \"minimum\": 1}, {\"type\": \"array\", \"minItems\": 1, \"items\": "
            "{\"oneOf\": [{\"type\": \"number\", \"exclusiveMinimum\": 0}, {\"type\": \"array\", \"prefixItems\": "
            "[{\"type\": \"integer\", \"minimum\": 1}, {\"type\": \"number\", \"exclusiveMinimum\": 0}], "
            "\"minItems\": 2, \"maxItems\": 2}]}}]");
        break;
    case CPSI_MAPPING:
        if (!key->words) {
            put_reference(out, (CpsiObject)key->inside);
            break;
        }
        fprintf(out, "\"oneOf\": [{");
        put_words(out, key->words);
        fprintf(out, "}, {");
        put_reference(out, (CpsiObject)key->inside);
        fprintf(out, "}]");
        break;
    case CPSI_NUMBER_OR_MAPPING:
        fprintf(out, "\"oneOf\": [{\"type\": \"number\"");
        put_range(out, key);
        fprintf(out, "}, {");
        put_reference(out, (CpsiObject)key->inside);
        fprintf(out, "}]");
        break;
    case CPSI_SET:
        fprintf(out, "\"$ref\": \"#/$defs/set\"");
        break;
    case CPSI_LIST:
        fprintf(out, "\"type\": \"array\", \"items\": {");
        put_reference(out, (CpsiObject)key->inside);
        fprintf(out, "}");
        break;
    default:
        break; /* not of scenes */
    }
}

static void put_row(FILE *out, const CpsiKey *key) {
    fprintf(out, "{");
    put_type(out, key);
    fprintf(out, ", \"description\": ");
    char text[512];
    snprintf(text, sizeof text, "%s%s%s%s", key->unit[0] ? "[" : "", key->unit, key->unit[0] ? "] " : "", key->help);
    cpsi_put_json_string(out, text);
    if (key->fallback) fprintf(out, ", \"default\": %s", key->fallback);
    fprintf(out, "}");
}

/* The form of a row's key as a regular expression; NULL where it has a fixed name. */
static const char *pattern_of(const CpsiKey *key) {
    if (strcmp(key->name, "NAME") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}$";
    if (strcmp(key->name, "LINE.END") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}\\.[AB]$";
    if (strcmp(key->name, "OBSTACLE.turn") == 0) return "^[A-Za-z][A-Za-z0-9_-]{0,63}\\.turn$";
    return NULL;
}

/* Keys with a fixed name (or, if `patterns`, those of a form), one line each. */
static int put_rows(FILE *out, const CpsiKey *keys, int count, bool patterns) {
    int written = 0;
    for (int i = 0; i < count; i++) {
        const char *pattern = pattern_of(&keys[i]);
        if ((pattern != NULL) != patterns) continue;
        fprintf(out, "%s\n        ", written++ ? "," : "");
        cpsi_put_json_string(out, pattern ? pattern : keys[i].name);
        fprintf(out, ": ");
        put_row(out, &keys[i]);
    }
    return written;
}

static void put_object(FILE *out, CpsiObject object) {
    int count, rows = 0;
    const CpsiKey *keys = cpsi_keys(object, &count);
    fprintf(out, "    ");
    cpsi_put_json_string(out, cpsi_object_name(object));
    fprintf(out, ": {\n      \"type\": \"object\", \"additionalProperties\": false,\n      \"properties\": {");
    rows = put_rows(out, keys, count, false);
    fprintf(out, "%s},\n      \"patternProperties\": {", rows ? "\n      " : "");
    rows = put_rows(out, keys, count, true);
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

static void put_schema(FILE *out) {
    fprintf(out, "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
                 "  \"title\": \"capstan scene, format version 1\",\n  ");
    put_reference(out, CPSI_SCENE);
    fprintf(out, ",\n  \"$defs\": {\n");
    for (int i = 0; i < CPSI_OBJECT_COUNT; i++) {
        put_object(out, (CpsiObject)i);
        fprintf(out, ",\n");
    }
    cpsi_put_set_definitions(out);
    fprintf(out, "  }\n}\n");
}

CpsStatus cps_scene_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, put_schema, err); }
