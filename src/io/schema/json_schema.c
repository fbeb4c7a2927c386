/* SPDX-License-Identifier: BSD-3-Clause */
/* Writing a JSON schema (see json_schema.h). */
#include "io/schema/json_schema.h"

#include "base/status.h"
#include "capstan/planar.h"
#include "io/base/escape.h"
#include "io/base/numbers.h"

/* What values a row accepts. */
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

static void write_words(FILE *out, const char *words) {
    fputs("\"enum\": [\"", out);
    for (const char *c = words; *c; c++) fputs(*c == ' ' ? "\", \"" : (char[]){*c, '\0'}, out);
    fputs("\"]", out);
}

/* a mapping, or what else may stand in its place */
static void write_mapping(FILE *out, const CpsiKey *key, CpsiName name) {
    const bool number = key->type == CPSI_NUMBER_OR_MAPPING, either = number || key->words;
    if (either) fputs("\"oneOf\": [{", out);
    if (number) {
        fputs("\"type\": \"number\"", out);
        write_range(out, key);
    } else if (key->words) {
        write_words(out, key->words);
    }
    if (either) fputs("}, {", out);
    fprintf(out, "\"$ref\": \"#/$defs/%s\"", name(key->inside));
    if (either) fputs("}]", out);
}

/* `least` rows or more of `columns` numbers, of any one number where that is 0 */
static void write_rows(FILE *out, int least, int columns) {
    fprintf(out, "\"$ref\": \"#/$defs/matrix\", \"minItems\": %d", least);
    if (columns > 0) fprintf(out, ", \"items\": {\"minItems\": %d, \"maxItems\": %d}", columns, columns);
}

/* such rows, or a mapping */
static void write_rows_or(FILE *out, int least, int columns, const char *name) {
    fputs("\"oneOf\": [{", out);
    write_rows(out, least, columns);
    fprintf(out, "}, {\"$ref\": \"#/$defs/%s\"}]", name);
}

/* a list of mappings of one word, that of a patch */
static void write_patches(FILE *out, int first, CpsiName name) {
    fputs("\"type\": \"array\", \"minItems\": 1, \"items\": {\"type\": \"object\", \"minProperties\": 1, "
          "\"maxProperties\": 1, "
          "\"additionalProperties\": false, \"properties\": {",
          out);
    for (int k = CPS_PATCH_POINT; k <= CPS_PATCH_POLYGON; k++)
        fprintf(out, "%s\"%s\": {\"$ref\": \"#/$defs/%s\"}", k ? ", " : "", name(first + k), name(first + k));
    fputs("}}", out);
}

/* What values look like whatever the row. */
static const char *const ALWAYS[] = {
    [CPSI_FLAG] = "\"type\": \"boolean\"",
    [CPSI_MATRIX] = "\"$ref\": \"#/$defs/matrix\"",
    [CPSI_SQUARE] = "\"$ref\": \"#/$defs/matrix\"",
    [CPSI_ENDS_OF_SEGMENT] = "\"$ref\": \"#/$defs/matrix\", \"minItems\": 2, \"maxItems\": 2",
    [CPSI_PAIRS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/pair\"}, \"minItems\": 1",
    [CPSI_SIDE] = "\"$ref\": \"#/$defs/side\"",
    [CPSI_SET] = "\"$ref\": \"#/$defs/set\"",
    [CPSI_LAW] = "\"$ref\": \"#/$defs/set\"",
    [CPSI_SETS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/set\"}, \"minItems\": 1",
    [CPSI_LAWS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/set\"}, \"minItems\": 1",
    [CPSI_CONTACTS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/contact\"}, \"minItems\": 1",
    [CPSI_TERMS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/term\"}, \"minItems\": 1",
    [CPSI_POINTS] = "\"type\": \"array\", \"items\": {\"type\": \"array\", \"items\": {\"type\": \"number\"}, "
                    "\"minItems\": 3, \"maxItems\": 3}, \"minItems\": 2",
    [CPSI_ELEMENTS] = "\"oneOf\": [{\"type\": \"integer\", \"minimum\": 1}, {\"type\": \"array\", \"minItems\": 1, \"items\": "
                      "{\"oneOf\": [{\"type\": \"number\", \"exclusiveMinimum\": 0}, {\"type\": \"array\", \"prefixItems\": "
                      "[{\"type\": \"integer\", \"minimum\": 1}, {\"type\": \"number\", \"exclusiveMinimum\": 0}], "
                      "\"minItems\": 2, \"maxItems\": 2}]}}]",
    [CPSI_COMPONENTS] = "\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 1, \"maxItems\": 2",
    [CPSI_MAP] = "\"type\": \"array\", \"items\": {\"oneOf\": [{\"$ref\": \"#/$defs/parameter\"}, "
                 "{\"$ref\": \"#/$defs/by_parameter\"}]}, \"minItems\": 1",
    [CPSI_BY_NAME] = "\"$ref\": \"#/$defs/by_parameter\"",
    [CPSI_BRAKE] = "\"oneOf\": [{\"type\": \"number\", \"minimum\": 0}, {\"const\": \"locked\"}]",
    [CPSI_END_MOTION] = "\"oneOf\": [{\"enum\": [\"free\", \"held\"]}, {\"$ref\": \"#/$defs/pair\"}]",
    [CPSI_FILE_NAME] = "\"type\": \"string\", \"minLength\": 1",
};

void cpsi_write_value(FILE *out, const CpsiKey *key, CpsiName name) {
    switch (key->type) {
    case CPSI_TEXT:
        if (key->most > 0)
            fprintf(out, "\"type\": [\"string\", \"number\", \"boolean\", \"null\"], \"maxLength\": %d", key->most);
        else
            fputs("\"type\": [\"string\", \"number\"], \"minLength\": 1", out);
        break;
    case CPSI_INTEGER:
    case CPSI_NUMBER:
        fprintf(out, "\"type\": \"%s\"", key->type == CPSI_NUMBER ? "number" : "integer");
        write_range(out, key);
        break;
    case CPSI_WORD:
        write_words(out, key->words);
        break;
    case CPSI_POINT:
        fprintf(out, "\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": %d, \"maxItems\": %d", key->most,
                key->most);
        break;
    case CPSI_VECTOR:
        fputs("\"type\": \"array\", \"items\": {\"type\": \"number\"", out);
        write_range(out, key);
        fprintf(out, "}, \"minItems\": 1, \"maxItems\": %d", key->most);
        break;
    case CPSI_SIDES:
        fprintf(out, "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/side\"}, \"minItems\": 1, \"maxItems\": %d", key->most);
        break;
    case CPSI_MAPPING:
    case CPSI_NUMBER_OR_MAPPING:
        write_mapping(out, key, name);
        break;
    case CPSI_LIST:
        fprintf(out, "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/%s\"}", name(key->inside));
        if (key->most > 0) fprintf(out, ", \"minItems\": %d", key->most);
        break;
    case CPSI_PATCHES:
        write_patches(out, key->inside, name);
        break;
    case CPSI_ROWS:
        write_rows(out, (int)key->low, key->most);
        break;
    case CPSI_PATH:
        write_rows_or(out, 1, 0, name(key->inside));
        break;
    case CPSI_CURVE:
        write_rows_or(out, 3, 2, name(key->inside));
        break;
    case CPSI_NAMES:
        fprintf(out,
                "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/parameter\"}, \"minItems\": 1, "
                "\"maxItems\": %d, \"uniqueItems\": true",
                key->most);
        break;
    default:
        if (ALWAYS[key->type]) fputs(ALWAYS[key->type], out);
    }
}

void cpsi_draw_key(FILE *out, const CpsiKey *key, CpsiName name) {
    char text[512];
    snprintf(text, sizeof text, "%s%s%s%s", key->unit[0] ? "[" : "", key->unit, key->unit[0] ? "] " : "", key->help);
    fputc('{', out);
    cpsi_write_value(out, key, name);
    fputs(", \"description\": ", out);
    cpsi_write_json_string(out, text);
    if (key->fallback) fprintf(out, ", \"default\": %s", key->fallback);
    fputc('}', out);
}

CpsStatus cpsi_write_schema(FILE *out, void (*put)(FILE *out), CpsError *err) {
    if (!out) return cpsi_fail(err, CPS_ERR_ARGUMENT, "out is NULL, expected an open file");
    CpsiNumbers numbers;
    if (!cpsi_numbers_begin(&numbers)) return cpsi_fail(err, CPS_ERR_MEMORY, "out of memory");
    put(out);
    cpsi_numbers_end(&numbers);
    if (fflush(out) != 0 || ferror(out)) return cpsi_fail(err, CPS_ERR_IO, "the schema could not be written");
    return CPS_OK;
}
