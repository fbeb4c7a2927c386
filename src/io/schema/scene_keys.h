/* SPDX-License-Identifier: BSD-3-Clause */
/* The table of a scene file's keys. It drives the validation and its messages (validate.c), the suggestions for
 * unknown keys and the JSON schema (scene_json.c). To add a key: add its row, and read it in scene_build.c. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_SCENE_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_SCENE_KEYS_H

#include <stdbool.h>
#include <stddef.h>

/* The mappings of a scene file; the order is that of KEYS and of OBJECTS in scene_keys.c. */
typedef enum CpsiObject {
    CPSI_SCENE,
    CPSI_OBSTACLES, /* {NAME: obstacle} */
    CPSI_OBSTACLE,
    CPSI_PLANE,
    CPSI_CYLINDER,
    CPSI_SPHERE,
    CPSI_FRICTION,
    CPSI_LINES, /* {NAME: line} */
    CPSI_LINE,
    CPSI_ZONE,
    CPSI_START,
    CPSI_STRAIGHT,
    CPSI_ARC,
    CPSI_ENDS,
    CPSI_END,
    CPSI_SOLVER,
    CPSI_STAGE,
    CPSI_CHANGE,
    CPSI_OBJECT_COUNT
} CpsiObject;

typedef enum CpsiKeyType {
    CPSI_NUMBER,
    CPSI_INTEGER,
    CPSI_TEXT,
    CPSI_WORD,              /* one of `words` */
    CPSI_VECTOR,            /* [x, y, z] */
    CPSI_POINTS,            /* [[x, y, z], ...], at least two */
    CPSI_ELEMENTS,          /* a count, or a list of lengths and of [count, length] */
    CPSI_MAPPING,           /* an object of kind `inside`, or one of `words` in its place */
    CPSI_NUMBER_OR_MAPPING, /* an object of kind `inside`, or a number in its place */
    CPSI_LIST,              /* of objects of kind `inside` */
    CPSI_SET                /* a set in the words of law files (set_build.h) */
} CpsiKeyType;

typedef enum CpsiKeyNeed {
    CPSI_OPTIONAL,
    CPSI_REQUIRED,
    CPSI_ONE_OF /* exactly one of the object's keys marked so */
} CpsiKeyNeed;

typedef struct CpsiKey {
    CpsiObject where;
    const char *name; /* "NAME": any name; "LINE.END": an end of a line, as cable.B; "OBSTACLE.turn": as drum.turn */
    CpsiKeyType type;
    CpsiKeyNeed need;
    const char *unit;     /* "" without */
    double low, high;     /* range of a number; a high of INFINITY allows .inf */
    bool open;            /* low itself is excluded */
    CpsiObject inside;    /* of a mapping or list */
    const char *words;    /* separated by spaces, in the order of the enum they stand for */
    const char *fallback; /* default as JSON, NULL: none */
    const char *help;
} CpsiKey;

/* The rows of an object: *count of them. */
const CpsiKey *cpsi_keys(CpsiObject object, int *count);

/* What an object is called in messages and in the schema: "line", "entry", ... */
const char *cpsi_object_name(CpsiObject object);

/* The row for a key written in an object; NULL: there is none. A name, LINE.END and OBSTACLE.turn are recognised by
 * their form alone. */
const CpsiKey *cpsi_key_find(CpsiObject object, const char *written);

/* The number of a word in a row's words, from 0; -1: none of them. */
int cpsi_key_word(const CpsiKey *key, const char *written);

/* The 'A' or 'B' after the last dot of LINE.END; 0: no such form. */
char cpsi_key_end(const char *written);

/* Is this of the form OBSTACLE.turn? */
bool cpsi_key_is_turn(const char *written);

/* Keep the nearest of the candidates offered one after the other: start with {.word = written}. */
typedef struct CpsiSuggestion {
    const char *word, *best; /* best NULL: nothing near enough */
    int distance;
} CpsiSuggestion;
void cpsi_suggest(CpsiSuggestion *suggestion, const char *candidate);

/* What a row accepts, for messages: "a number in m, greater than 0".
 * text   (size) written, always terminated; returns text */
const char *cpsi_key_expected(const CpsiKey *key, char *text, size_t size);

#endif
