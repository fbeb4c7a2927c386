/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schema (draft 2020-12) of files of driven systems, from the table of their keys: one definition per kind of
 * mapping, those of combinations of parameters, and those of laws. */
#include <math.h>

#include "capstan/drive_io.h"
#include "io/schema/drive_keys.h"
#include "io/base/escape.h"
#include "io/schema/json_schema.h"
#include "io/schema/set_json.h"

static const char *alias_of(CpsiDriveMapping mapping) { return cpsi_drive_word(mapping)->alias; }

static void put_range(FILE *out, const CpsiField *f) {
    if (!(f->low > -INFINITY)) return;
    fprintf(out, ", \"%s\": ", f->open ? "exclusiveMinimum" : "minimum");
    cpsi_put_json_number(out, f->low);
}

/* `least` rows or more of `columns` numbers, of any one number where that is 0 */
static void put_rows(FILE *out, int least, int columns) {
    fprintf(out, "\"$ref\": \"#/$defs/matrix\", \"minItems\": %d", least);
    if (columns > 0) fprintf(out, ", \"items\": {\"minItems\": %d, \"maxItems\": %d}", columns, columns);
}

/* such rows, or a mapping */
static void put_rows_or(FILE *out, int least, int columns, CpsiDriveMapping mapping) {
    fputs("\"oneOf\": [{", out);
    put_rows(out, least, columns);
    fprintf(out, "}, {\"$ref\": \"#/$defs/%s\"}]", alias_of(mapping));
}

/* a list of mappings of one word, that of a patch */
static void put_patches(FILE *out) {
    fputs("\"type\": \"array\", \"minItems\": 1, \"items\": {\"type\": \"object\", \"minProperties\": 1, "
          "\"maxProperties\": 1, "
          "\"additionalProperties\": false, \"properties\": {",
          out);
    for (int k = CPS_PATCH_POINT; k <= CPS_PATCH_POLYGON; k++) {
        const char *alias = alias_of((CpsiDriveMapping)((int)CPSI_DRIVE_PATCH + k));
        fprintf(out, "%s\"%s\": {\"$ref\": \"#/$defs/%s\"}", k ? ", " : "", alias, alias);
    }
    fputs("}}", out);
}

/* What values look like whatever the key. */
static const char *const ALWAYS[] = {
    [CPSI_FIELD_TEXT] = "\"type\": [\"string\", \"number\", \"boolean\", \"null\"], \"maxLength\": 255",
    [CPSI_FIELD_FLAG] = "\"type\": \"boolean\"",
    [CPSI_FIELD_VECTOR] = "\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": 1, \"maxItems\": 2",
    [CPSI_FIELD_MAP] = "\"type\": \"array\", \"items\": {\"oneOf\": [{\"$ref\": \"#/$defs/parameter\"}, "
                       "{\"$ref\": \"#/$defs/by_parameter\"}]}, \"minItems\": 1",
    [CPSI_FIELD_BY_NAME] = "\"$ref\": \"#/$defs/by_parameter\"",
    [CPSI_FIELD_LAW] = "\"$ref\": \"#/$defs/set\"",
    [CPSI_FIELD_TERMS] = "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/term\"}, \"minItems\": 1",
    [CPSI_FIELD_BRAKE] = "\"oneOf\": [{\"type\": \"number\", \"minimum\": 0}, {\"const\": \"locked\"}]",
    [CPSI_FIELD_END] = "\"oneOf\": [{\"enum\": [\"free\", \"held\"]}, {\"$ref\": \"#/$defs/pair\"}]",
    [CPSI_FIELD_FILE_NAME] = "\"type\": \"string\", \"minLength\": 1",
};

static void put_type(FILE *out, const CpsiField *f) {
    switch (f->kind) {
    case CPSI_FIELD_COUNT:
        fprintf(out, "\"type\": \"integer\", \"minimum\": 1, \"maximum\": %d", f->most);
        break;
    case CPSI_FIELD_NUMBER:
        fputs("\"type\": \"number\"", out);
        put_range(out, f);
        break;
    case CPSI_FIELD_POINT:
        fprintf(out, "\"type\": \"array\", \"items\": {\"type\": \"number\"}, \"minItems\": %d, \"maxItems\": %d",
                f->most, f->most);
        break;
    case CPSI_FIELD_MAPPING:
        fprintf(out, "\"$ref\": \"#/$defs/%s\"", alias_of(f->inside));
        break;
    case CPSI_FIELD_LIST:
        fprintf(out, "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/%s\"}, \"minItems\": 1",
                alias_of(f->inside));
        break;
    case CPSI_FIELD_PATCHES:
        put_patches(out);
        break;
    case CPSI_FIELD_ROWS:
        put_rows(out, (int)f->low, f->most);
        break;
    case CPSI_FIELD_PATH:
        put_rows_or(out, 1, 0, CPSI_DRIVE_PATH);
        break;
    case CPSI_FIELD_CURVE:
        put_rows_or(out, 3, 2, CPSI_DRIVE_CURVE);
        break;
    case CPSI_FIELD_NAMES:
        fprintf(out,
                "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/parameter\"}, \"minItems\": 1, "
                "\"maxItems\": %d, \"uniqueItems\": true",
                f->most);
        break;
    default:
        fputs(ALWAYS[f->kind], out);
    }
}

static void put_word(FILE *out, const CpsiDriveWord *word) {
    const int count = cpsi_drive_word_count(word);
    fputs("\"type\": \"object\", \"additionalProperties\": false,\n      \"properties\": {", out);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s\n        \"%s\": {", i ? "," : "", word->field[i].name);
        put_type(out, &word->field[i]);
        fputs(", \"description\": ", out);
        cpsi_put_json_string(out, word->field[i].help);
        fputc('}', out);
    }
    fputs("\n      },\n      \"required\": [", out);
    for (int i = 0, written = 0; i < count; i++)
        if (word->field[i].required) fprintf(out, "%s\"%s\"", written++ ? ", " : "", word->field[i].name);
    fputc(']', out);
    if (word->also) fprintf(out, ",\n      %s", word->also);
}

static void put_schema(FILE *out) {
    fputs("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
          "  \"title\": \"capstan driven system, format version 1\",\n  ",
          out);
    put_word(out, cpsi_drive_word(CPSI_DRIVE_FILE));
    fputs(",\n  \"$defs\": {\n", out);
    for (int k = CPSI_DRIVE_FILE + 1; k < CPSI_DRIVE_MAPPINGS; k++) {
        fprintf(out, "    \"%s\": {\n      ", alias_of((CpsiDriveMapping)k));
        put_word(out, cpsi_drive_word((CpsiDriveMapping)k));
        fputs("\n    },\n", out);
    }
    fputs("    \"parameter\": {\"type\": [\"string\", \"number\", \"boolean\"], \"minLength\": 1},\n"
          "    \"by_parameter\": {\"type\": \"object\", \"additionalProperties\": {\"type\": \"number\"}},\n",
          out);
    cpsi_put_law_definitions(out);
    fputs("  }\n}\n", out);
}

CpsStatus cps_drive_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, put_schema, err); }
