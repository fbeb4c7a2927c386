/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schema (draft 2020-12) of law files, from the table of words: what does not depend on two values together,
 * such as dimensions, is in it. */
#include <math.h>

#include "capstan/law_io.h"
#include "io/schema/set_words.h"
#include "io/base/escape.h"
#include "io/schema/json_schema.h"
#include "io/schema/set_json.h"

static void put_range(FILE *out, const CpsiLawKey *key) {
    if (!(key->low > -INFINITY)) return;
    fprintf(out, ", \"%s\": ", key->open ? "exclusiveMinimum" : "minimum");
    cpsi_put_json_number(out, key->low);
}

/* What a value looks like; definitions that others refer to are in put_schema. */
static void put_type(FILE *out, const CpsiLawKey *key) {
    switch (key->type) {
    case CPSI_LAW_NOTHING:
        break;
    case CPSI_LAW_TEXT:
        fprintf(out, "\"type\": [\"string\", \"number\", \"boolean\", \"null\"], \"maxLength\": %d", key->most);
        break;
    case CPSI_LAW_COUNT:
        fprintf(out, "\"type\": \"integer\", \"minimum\": 1, \"maximum\": %d", key->most);
        break;
    case CPSI_LAW_NUMBER:
        fputs("\"type\": \"number\"", out);
        put_range(out, key);
        break;
    case CPSI_LAW_VECTOR:
        fputs("\"type\": \"array\", \"items\": {\"type\": \"number\"", out);
        put_range(out, key);
        fprintf(out, "}, \"minItems\": 1, \"maxItems\": %d", key->most);
        break;
    case CPSI_LAW_MATRIX:
    case CPSI_LAW_SQUARE:
        fputs("\"$ref\": \"#/$defs/matrix\"", out);
        break;
    case CPSI_LAW_ENDS:
        fputs("\"$ref\": \"#/$defs/matrix\", \"minItems\": 2, \"maxItems\": 2", out);
        break;
    case CPSI_LAW_PAIRS:
        fputs("\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/pair\"}, \"minItems\": 1", out);
        break;
    case CPSI_LAW_SIDE:
        fputs("\"$ref\": \"#/$defs/side\"", out);
        break;
    case CPSI_LAW_SIDES:
        fprintf(out, "\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/side\"}, \"minItems\": 1, \"maxItems\": %d",
                CPSI_LAW_MOST_COMPONENTS);
        break;
    case CPSI_LAW_SET:
    case CPSI_LAW_LAW:
        fputs("\"$ref\": \"#/$defs/set\"", out);
        break;
    case CPSI_LAW_SETS:
    case CPSI_LAW_LAWS:
        fputs("\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/set\"}, \"minItems\": 1", out);
        break;
    case CPSI_LAW_CONTACTS:
        fputs("\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/contact\"}, \"minItems\": 1", out);
        break;
    case CPSI_LAW_TERMS:
        fputs("\"type\": \"array\", \"items\": {\"$ref\": \"#/$defs/term\"}, \"minItems\": 1", out);
        break;
    }
}

static void put_description(FILE *out, const char *help) {
    fputs(", \"description\": ", out);
    cpsi_put_json_string(out, help);
}

/* "type": "object" with the word's keys */
static void put_keys(FILE *out, const CpsiLawKey *key) {
    fputs("\"type\": \"object\", \"additionalProperties\": false, \"properties\": {", out);
    for (int i = 0; i < CPSI_LAW_MOST_KEYS && key[i].type; i++) {
        fprintf(out, "%s\"%s\": {", i ? ", " : "", key[i].name);
        put_type(out, &key[i]);
        put_description(out, key[i].help);
        fputc('}', out);
    }
    fputs("}, \"required\": [", out);
    for (int i = 0, written = 0; i < CPSI_LAW_MOST_KEYS && key[i].type; i++)
        if (!key[i].optional) fprintf(out, "%s\"%s\"", written++ ? ", " : "", key[i].name);
    fputc(']', out);
}

/* the words of a group that another has not, one line each */
static void put_words(FILE *out, CpsiLawGroup group, CpsiLawGroup other, int *written) {
    int count;
    const CpsiLawWord *word = cpsi_law_words(group, &count);
    for (int i = 0; i < count; i++) {
        if (group != other && cpsi_law_word(other, word[i].name)) continue;
        fprintf(out, "%s\n        \"%s\": {", (*written)++ ? "," : "", word[i].name);
        if (word[i].key[0].name)
            put_keys(out, word[i].key);
        else
            put_type(out, word[i].key);
        put_description(out, word[i].help);
        fputc('}', out);
    }
}

/* a mapping of one word */
static const char ONE_WORD[] = ": {\n      \"type\": \"object\", \"minProperties\": 1, \"maxProperties\": 1, "
                               "\"additionalProperties\": false,\n      \"properties\": {";

void cpsi_put_set_definitions(FILE *out) {
    int written = 0;
    fputs("    \"set\"", out);
    fputs(ONE_WORD, out);
    put_words(out, CPSI_LAW_SET_WORDS, CPSI_LAW_SET_WORDS, &written);
    put_words(out, CPSI_LAW_LAW_WORDS, CPSI_LAW_SET_WORDS, &written);
    fputs("\n      }\n    },\n    \"contact\": {", out);
    put_keys(out, cpsi_law_contact_word.key);
    fprintf(
        out,
        "},\n    \"matrix\": {\"type\": \"array\", \"minItems\": 1, \"maxItems\": %d, \"items\": {\"type\": \"array\", "
        "\"minItems\": 1, \"maxItems\": %d, \"items\": {\"type\": \"number\"}}},\n",
        CPS_SET_MAX_ITEMS, CPSI_LAW_MOST_COMPONENTS);
    fputs("    \"pair\": {\"type\": \"array\", \"minItems\": 2, \"maxItems\": 2, \"items\": {\"type\": \"number\"}},\n"
          "    \"side\": {\"oneOf\": [{\"type\": \"number\", \"minimum\": 0}, {\"$ref\": \"#/$defs/pair\"}]}\n",
          out);
}

void cpsi_put_law_definitions(FILE *out) {
    int written = 0;
    fputs("    \"term\"", out);
    fputs(ONE_WORD, out);
    put_words(out, CPSI_LAW_TERM_WORDS, CPSI_LAW_TERM_WORDS, &written);
    fputs("\n      }\n    },\n", out);
    cpsi_put_set_definitions(out);
}

static void put_schema(FILE *out) {
    fprintf(out, "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
                 "  \"title\": \"capstan law, format version 1\",\n  ");
    put_keys(out, cpsi_law_file_word.key);
    fputs(",\n  \"oneOf\": [{\"required\": [\"law\"]}, {\"required\": [\"resistance\"], \"not\": {\"required\": "
          "[\"load\"]}}],\n"
          "  \"$defs\": {\n",
          out);
    cpsi_put_law_definitions(out);
    fputs("  }\n}\n", out);
}

CpsStatus cps_law_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, put_schema, err); }
