/* SPDX-License-Identifier: BSD-3-Clause */
/* The JSON schema (draft 2020-12) of law files, from the table of words: what does not depend on two values together,
 * such as dimensions, is in it. */
#include "capstan/law_io.h"
#include "io/schema/set_words.h"
#include "io/base/escape.h"
#include "io/schema/json_schema.h"
#include "io/schema/set_json.h"

static void write_description(FILE *out, const char *help) {
    fputs(", \"description\": ", out);
    cpsi_write_json_string(out, help);
}

/* "type": "object" with the word's keys */
static void write_keys(FILE *out, const CpsiLawWord *word) {
    const CpsiKey *key = word->key;
    const int count = cpsi_law_key_count(word);
    fputs("\"type\": \"object\", \"additionalProperties\": false, \"properties\": {", out);
    for (int i = 0; i < count; i++) {
        fprintf(out, "%s\"%s\": ", i ? ", " : "", key[i].name);
        cpsi_draw_key(out, &key[i], NULL);
    }
    fputs("}, \"required\": [", out);
    for (int i = 0, written = 0; i < count; i++)
        if (key[i].need == CPSI_REQUIRED) fprintf(out, "%s\"%s\"", written++ ? ", " : "", key[i].name);
    fputc(']', out);
}

/* the words of a group that another has not, one line each */
static void write_words(FILE *out, CpsiLawGroup group, CpsiLawGroup other, int *written) {
    int count;
    const CpsiLawWord *word = cpsi_law_words(group, &count);
    for (int i = 0; i < count; i++) {
        if (group != other && cpsi_law_word(other, word[i].name)) continue;
        fprintf(out, "%s\n        \"%s\": {", (*written)++ ? "," : "", word[i].name);
        if (word[i].key[0].name)
            write_keys(out, &word[i]);
        else
            cpsi_write_value(out, word[i].key, NULL);
        write_description(out, word[i].help);
        fputc('}', out);
    }
}

/* a mapping of one word */
static const char ONE_WORD[] = ": {\n      \"type\": \"object\", \"minProperties\": 1, \"maxProperties\": 1, "
                               "\"additionalProperties\": false,\n      \"properties\": {";

void cpsi_write_set_definitions(FILE *out) {
    int written = 0;
    fputs("    \"set\"", out);
    fputs(ONE_WORD, out);
    write_words(out, CPSI_LAW_SET_WORDS, CPSI_LAW_SET_WORDS, &written);
    write_words(out, CPSI_LAW_LAW_WORDS, CPSI_LAW_SET_WORDS, &written);
    fputs("\n      }\n    },\n    \"contact\": {", out);
    write_keys(out, &cpsi_law_contact_word);
    fprintf(
        out,
        "},\n    \"matrix\": {\"type\": \"array\", \"minItems\": 1, \"maxItems\": %d, \"items\": {\"type\": \"array\", "
        "\"minItems\": 1, \"maxItems\": %d, \"items\": {\"type\": \"number\"}}},\n",
        CPS_SET_MAX_ITEMS, CPSI_LAW_MOST_COMPONENTS);
    fputs("    \"pair\": {\"type\": \"array\", \"minItems\": 2, \"maxItems\": 2, \"items\": {\"type\": \"number\"}},\n"
          "    \"side\": {\"oneOf\": [{\"type\": \"number\", \"minimum\": 0}, {\"$ref\": \"#/$defs/pair\"}]}\n",
          out);
}

void cpsi_write_law_definitions(FILE *out) {
    int written = 0;
    fputs("    \"term\"", out);
    fputs(ONE_WORD, out);
    write_words(out, CPSI_LAW_TERM_WORDS, CPSI_LAW_TERM_WORDS, &written);
    fputs("\n      }\n    },\n", out);
    cpsi_write_set_definitions(out);
}

static void write_schema(FILE *out) {
    fprintf(out, "{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n"
                 "  \"title\": \"capstan law, format version 1\",\n  ");
    write_keys(out, &cpsi_law_file_word);
    fputs(",\n  \"oneOf\": [{\"required\": [\"law\"]}, {\"required\": [\"resistance\"], \"not\": {\"required\": "
          "[\"load\"]}}],\n"
          "  \"$defs\": {\n",
          out);
    cpsi_write_law_definitions(out);
    fputs("  }\n}\n", out);
}

CpsStatus cps_law_write_schema(FILE *out, CpsError *err) { return cpsi_write_schema(out, write_schema, err); }
