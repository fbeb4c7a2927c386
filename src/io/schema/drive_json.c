/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schema (draft 2020-12) of files of driven systems, from the table of their keys: one definition per kind of
 * mapping, those of combinations of parameters, and those of laws. */
#include "capstan/drive_io.h"
#include "io/schema/drive_keys.h"
#include "io/base/escape.h"
#include "io/schema/json_schema.h"
#include "io/schema/set_json.h"

static const char *alias_of(int mapping) { return cpsi_drive_word((CpsiDriveMapping)mapping)->alias; }

static void write_word(FILE *out, const CpsiDriveWord *word) {
    const int count = cpsi_drive_word_count(word);
    fputs("\"type\": \"object\", \"additionalProperties\": false,\n      \"properties\": {", out);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s\n        \"%s\": ", i ? "," : "", word->key[i].name);
        cpsi_draw_key(out, &word->key[i], alias_of);
    }
    fputs("\n      },\n      \"required\": [", out);
    for (int i = 0, written = 0; i < count; i++)
        if (word->key[i].need == CPSI_REQUIRED) fprintf(out, "%s\"%s\"", written++ ? ", " : "", word->key[i].name);
    fputc(']', out);
    if (word->also) fprintf(out, ",\n      %s", word->also);
}

static void write_schema(FILE *out) {
    fputs("{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
          "  \"title\": \"capstan driven system, format version 1\",\n  ",
          out);
    write_word(out, cpsi_drive_word(CPSI_DRIVE_FILE));
    fputs(",\n  \"$defs\": {\n", out);
    for (int k = CPSI_DRIVE_FILE + 1; k < CPSI_DRIVE_MAPPINGS; k++) {
        fprintf(out, "    \"%s\": {\n      ", alias_of(k));
        write_word(out, cpsi_drive_word((CpsiDriveMapping)k));
        fputs("\n    },\n", out);
    }
    fputs("    \"parameter\": {\"type\": [\"string\", \"number\", \"boolean\"], \"minLength\": 1},\n"
          "    \"by_parameter\": {\"type\": \"object\", \"additionalProperties\": {\"type\": \"number\"}},\n",
          out);
    cpsi_write_law_definitions(out);
    fputs("  }\n}\n", out);
}

CpsStatus cps_drive_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, write_schema, err); }
