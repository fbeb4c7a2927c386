/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schemas (draft 2020-12) of scenes, laws and driven systems, from their tables of keys:
 * one definition for each kind of mapping. They contain everything that does not depend on two
 * values together, as dimensions do. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/status.h"
#include "capstan/io.h"
#include "io/base/text/escape.h"
#include "io/base/text/numbers.h"
#include "io/schema/tables/drive_keys.h"
#include "io/schema/tables/scene_keys.h"
#include "io/schema/tables/set_keys.h"

/* Of a required key exactly one of it and that which it stands for; of another, not both. */
static void write_replacements(FILE *out, const CpsiMapping *mapping) {
    int written = 0;
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        if (!key->unless) continue;
        fputs(written++ ? ",\n        " : ",\n      \"allOf\": [", out);
        fprintf(out,
                key->need == CPSI_REQUIRED
                    ? "{\"oneOf\": [{\"required\": [\"%s\"]}, {\"required\": [\"%s\"]}]}"
                    : "{\"not\": {\"required\": [\"%s\", \"%s\"]}}",
                key->name, key->unless);
    }
    if (written) fputc(']', out);
}

static void write_mapping(FILE *out, const CpsiMapping *mapping);

static const char *definition(const CpsiMapping *mapping) {
    return mapping->definition ? mapping->definition : mapping->name;
}

/* ---- values ---- */

static void write_range(FILE *out, const CpsiKey *key) {
    if (key->low > -CPSI_LARGEST) {
        fprintf(out, ", \"%s\": ", key->open ? "exclusiveMinimum" : "minimum");
        cpsi_write_json_number(out, key->low);
    }
    if (key->high < CPSI_LARGEST) {
        fputs(", \"maximum\": ", out);
        cpsi_write_json_number(out, key->high);
    }
}

/* ["a", "b"] of words */
static void write_words(FILE *out, const char *words) {
    fputs("[\"", out);
    for (const char *c = words; *c; c++) fputs(*c == ' ' ? "\", \"" : (char[]){*c, '\0'}, out);
    fputs("\"]", out);
}

static void write_number(FILE *out, const CpsiKey *key, const char *type) {
    fprintf(out, "\"type\": \"%s\"", type);
    write_range(out, key);
}

#define ANY_NAME "[A-Za-z][A-Za-z0-9_-]{0,63}"
#define ARRAY    "\"type\": \"array\", \"minItems\": "

/* `low` to `high` rows of `columns` numbers; of any number of numbers where `columns` is 0 */
static void write_rows(FILE *out, const CpsiKey *key) {
    fprintf(out, ARRAY "%.0f, ", key->low);
    if (key->high < CPSI_LARGEST) fprintf(out, "\"maxItems\": %.0f, ", key->high);
    fprintf(out, "\"items\": {" ARRAY "%d, \"maxItems\": %d, \"items\": {\"type\": \"number\"}}",
            key->most ? key->most : 1, key->most ? key->most : CPSI_LAW_MOST_COMPONENTS);
}

#define TWO_NUMBERS \
    "{\"type\": \"array\", \"minItems\": 2, \"maxItems\": 2, \"items\": {\"type\": \"number\"}}"
#define SIDE    "\"oneOf\": [{\"type\": \"number\", \"minimum\": 0}, " TWO_NUMBERS "]"
#define NAME    "{\"type\": [\"string\", \"number\", \"boolean\"], \"minLength\": 1}"
#define BY_NAME "\"type\": \"object\", \"additionalProperties\": {\"type\": \"number\"}"

/* Values whose form does not depend on the row. */
static const char *const ALWAYS[] = {
    [CPSI_FLAG] = "\"type\": \"boolean\"",
    [CPSI_SIDE] = SIDE,
    [CPSI_ELEMENTS] =
        ARRAY "1, \"items\": {\"oneOf\": [{\"type\": \"number\", \"exclusiveMinimum\": 0}, {" ARRAY
              "2, \"maxItems\": 2, \"prefixItems\": [{\"type\": \"integer\", \"minimum\": 1}, "
              "{\"type\": \"number\", \"exclusiveMinimum\": 0}]}]}",
    [CPSI_COMBINATIONS] = ARRAY "1, \"items\": {\"oneOf\": [" NAME ", {" BY_NAME "}]}",
    [CPSI_BY_NAME] = BY_NAME,
};

/* The values that a form accepts, without braces. */
static void write_form(FILE *out, const CpsiKey *key) {
    const char *inside = key->inside ? definition(key->inside) : NULL;
    switch (key->type) {
    case CPSI_TEXT:
        if (key->most > 0)
            fprintf(out,
                    "\"type\": [\"string\", \"number\", \"boolean\", \"null\"], \"maxLength\": %d",
                    key->most);
        else
            fputs("\"type\": [\"string\", \"number\"], \"minLength\": 1", out);
        break;
    case CPSI_INTEGER:
    case CPSI_COUNT: write_number(out, key, "integer"); break;
    case CPSI_NUMBER: write_number(out, key, "number"); break;
    case CPSI_WORD:
        fputs("\"enum\": ", out);
        write_words(out, key->words);
        break;
    case CPSI_WORDS:
        fputs("\"type\": \"array\", \"uniqueItems\": true, \"items\": {\"enum\": ", out);
        write_words(out, key->words);
        fputc('}', out);
        break;
    case CPSI_POINT:
    case CPSI_VECTOR:
        fprintf(out, ARRAY "%d, \"maxItems\": %d, \"items\": {",
                key->type == CPSI_POINT ? key->most : 1, key->most);
        write_number(out, key, "number");
        fputc('}', out);
        break;
    case CPSI_ROWS:
    case CPSI_SQUARE: write_rows(out, key); break;
    case CPSI_SIDES:
        fprintf(out, ARRAY "1, \"maxItems\": %d, \"items\": {" SIDE "}", key->most);
        break;
    case CPSI_NAMES:
        fprintf(out, ARRAY "1, \"maxItems\": %d, \"uniqueItems\": true, \"items\": " NAME,
                key->most);
        break;
    case CPSI_EXPRESSION:
    case CPSI_MAPPING:
        if (inside)
            fprintf(out, "\"$ref\": \"#/$defs/%s\"", inside);
        else
            write_mapping(out, key->inside);
        break;
    case CPSI_NAMED:
        fprintf(out,
                "\"type\": \"object\", \"additionalProperties\": false, \"patternProperties\": "
                "{\"^" ANY_NAME "$\": {\"$ref\": \"#/$defs/%s\"}}",
                inside);
        break;
    case CPSI_EXPRESSIONS:
    case CPSI_LIST:
        fprintf(out, ARRAY "%d, \"items\": {\"$ref\": \"#/$defs/%s\"}",
                key->type == CPSI_LIST ? key->most : 1, inside);
        break;
    default: fputs(ALWAYS[key->type], out);
    }
}

/* ---- mappings ---- */

static void write_key(FILE *out, const CpsiKey *key) {
    char text[512];
    const char *unit = key->unit ? key->unit : "";
    fputc('{', out);
    if (key->other) fputs("\"oneOf\": [{", out);
    for (const CpsiKey *form = key; form; form = form->other) {
        write_form(out, form);
        if (form->other) fputs("}, {", out);
    }
    if (key->other) fputs("}]", out);
    snprintf(text, sizeof text, "%s%s%s%s", *unit ? "[" : "", unit, *unit ? "] " : "", key->help);
    fputs(", \"description\": ", out);
    cpsi_write_json_string(out, text);
    if (key->fallback) fprintf(out, ", \"default\": %s", key->fallback);
    fputc('}', out);
}

/* The name of a row, or a regular expression for its form. */
static void write_name(FILE *out, const CpsiKey *key) {
    if (!key->owner) {
        fprintf(out, "\"%s\": ", key->name);
        return;
    }
    fputs("\"^" ANY_NAME, out);
    for (const char *c = key->after; *c; c++) {
        if (c == key->after) fputs("\\\\.(", out);
        fputc(*c == ' ' ? '|' : *c, out);
        if (!c[1]) fputc(')', out);
    }
    fputs("$\": ", out);
}

/* "properties": all keys with a fixed name, or those with a form */
static void write_keys(FILE *out, const CpsiMapping *mapping, bool forms) {
    int written = 0;
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        if ((key->owner != NULL) != forms) continue;
        if (!written++)
            fprintf(out, ",\n      \"%s\": {", forms ? "patternProperties" : "properties");
        else
            fputc(',', out);
        fputs("\n        ", out);
        write_name(out, key);
        write_key(out, key);
    }
    if (written) fputs("\n      }", out);
}

/* "required": [..], or as many schemas that require one key each */
static void write_needs(FILE *out, const CpsiMapping *mapping, CpsiNeed need) {
    const bool all = need == CPSI_REQUIRED;
    int written = 0;
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        if (key->need != need || (all && key->unless)) continue;
        const char *first = all ? ",\n      \"required\": [" : ",\n      \"oneOf\": [";
        fputs(written++ ? ", " : first, out);
        fprintf(out, all ? "\"%s\"" : "{\"required\": [\"%s\"]}", key->name);
    }
    if (written) fputc(']', out);
}

static void write_companions(FILE *out, const CpsiMapping *mapping) {
    int written = 0;
    for (int i = 0; i < mapping->count; i++) {
        const CpsiKey *key = &mapping->key[i];
        if (!key->with) continue;
        fputs(written++ ? ", " : ",\n      \"dependentRequired\": {", out);
        fprintf(out, "\"%s\": [\"%s\"]", key->name, key->with);
    }
    if (written) fputc('}', out);
}

static void write_mapping(FILE *out, const CpsiMapping *mapping) {
    fputs("\"type\": \"object\", \"additionalProperties\": false", out);
    if (mapping->word) fputs(", \"minProperties\": 1, \"maxProperties\": 1", out);
    write_keys(out, mapping, false);
    write_keys(out, mapping, true);
    if (mapping->word) return;
    write_needs(out, mapping, CPSI_REQUIRED);
    write_needs(out, mapping, CPSI_ONE_OF);
    write_companions(out, mapping);
    write_replacements(out, mapping);
    if (mapping->also) fprintf(out, ",\n      %s", mapping->also);
}

/* ---- files ---- */

enum { MOST_DEFINITIONS = 64 };

typedef struct Definitions {
    const CpsiMapping *mapping[MOST_DEFINITIONS];
    int count;
} Definitions;

/* All mappings that can be reached from this one, each once; those without a name are written in
 * place. */
static void collect(Definitions *found, const CpsiMapping *mapping) {
    for (int k = 0; k < found->count; k++)
        if (found->mapping[k] == mapping) return;
    if (mapping->name && found->count < MOST_DEFINITIONS) found->mapping[found->count++] = mapping;
    for (int i = 0; i < mapping->count; i++)
        for (const CpsiKey *form = &mapping->key[i]; form; form = form->other)
            if (form->inside) collect(found, form->inside);
}

static CpsStatus write_schema(FILE *out, const char *title, const CpsiMapping *file,
                              CpsError *err) {
    CpsiNumbers numbers;
    Definitions found = {.count = 0};
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected an open file");
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    collect(&found, file);
    errno = 0;
    fprintf(out,
            "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
            "  \"title\": \"capstan %s, format version 1\",\n"
            "  \"$ref\": \"#/$defs/%s\",\n  \"$defs\": {\n",
            title, definition(file));
    for (int k = 0; k < found.count; k++) {
        fprintf(out, "    \"%s\": {\n      ", definition(found.mapping[k]));
        write_mapping(out, found.mapping[k]);
        fprintf(out, "\n    }%s\n", k + 1 < found.count ? "," : "");
    }
    fputs("  }\n}\n", out);
    cpsi_numbers_end(&numbers);
    if (fflush(out) != 0 || ferror(out))
        return cpsi_fail(err, CPS_ERR_IO, "cannot write the schema: %s",
                         strerror(errno ? errno : EIO));
    return CPS_OK;
}

CpsStatus cps_scene_write_schema(FILE *out, CpsError *err) {
    return write_schema(out, "scene", &cpsi_scene_file, err);
}

CpsStatus cps_law_write_schema(FILE *out, CpsError *err) {
    return write_schema(out, "law", &cpsi_law_file, err);
}

CpsStatus cps_drive_write_schema(FILE *out, CpsError *err) {
    return write_schema(out, "driven system", &cpsi_drive_file, err);
}
