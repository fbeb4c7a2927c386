/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of tables of keys: what may stand in a mapping of a file, and where reading puts it. The
 * vocabularies of scenes (scene_keys.c), of laws (set_keys.c) and of driven systems (drive_keys.c)
 * are tables of these rows. One reader (read/key_reader.c) checks a file against them and fills
 * structs; suggestions, messages and JSON schemas come from the same rows. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "io/base/yaml.h"

/* What stands under a key, and the type that reading stores at its offset. */
typedef enum CpsiValue {
    CPSI_TEXT,    /* const char *; at most `most` bytes, or not empty where `most` is 0 */
    CPSI_INTEGER, /* int of the range, which int holds */
    CPSI_COUNT,   /* double: a whole number of the range, which may be beyond any int */
    CPSI_NUMBER,  /* double of the range */
    CPSI_FLAG,    /* bool: true, false */
    CPSI_WORD,    /* int: which of `words`, from 0 */
    CPSI_POINT,   /* double[most]: exactly so many numbers of the range */

    /* CpsiRows */
    CPSI_VECTOR, /* [x, ..]: one row of at most `most` numbers of the range */
    CPSI_ROWS,   /* [[x, ..], ..]: `low` to `high` rows of `most` numbers; 0: all equally long */
    CPSI_SQUARE, /* as many rows as columns */
    CPSI_SIDE,   /* b for [-b, b], or [low, high]: two rows of one number */
    CPSI_SIDES,  /* [side, ..]: all low ends, then all high ends */

    /* const CpsiYaml *: checked in part, and read later */
    CPSI_EXPRESSION,   /* {WORD: value}: one of the keys `inside`, a set, a law, .. */
    CPSI_EXPRESSIONS,  /* [{WORD: value}, ..] */
    CPSI_ELEMENTS,     /* [length, [count, length], ..] */
    CPSI_NAMES,        /* names of parameters, at most `most` */
    CPSI_COMBINATIONS, /* [name, {name: factor, ..}, ..] */
    CPSI_BY_NAME,      /* {name: number, ..} */

    CPSI_MAPPING, /* with the keys `inside`, read into the struct that begins at the offset */
    CPSI_LIST,    /* CpsiList: [mapping, ..] with the keys `inside`, at least `most` of them */
    CPSI_NAMED    /* CpsiList: {name: mapping, ..} with the keys `inside` */
} CpsiValue;

typedef enum CpsiNeed {
    CPSI_OPTIONAL,
    CPSI_REQUIRED,
    CPSI_ONE_OF /* exactly one of the mapping's keys marked so */
} CpsiNeed;

struct CpsiSetValues;
struct CpsiSetMade;

/* A row. Fields that it does not give are 0. */
typedef struct CpsiKey {
    const char *name;
    CpsiNeed need;
    CpsiValue type;
    int most;                         /* see CpsiValue */
    size_t offset;                    /* of the value in the struct that the mapping is read into */
    double low, high;                 /* range of numbers; a high of INFINITY allows .inf */
    bool open;                        /* low itself is excluded */
    const char *words;                /* separated by spaces, in the order of the enum */
    const struct CpsiMapping *inside; /* what a mapping, list or expression holds */
    const struct CpsiKey *other;      /* another form that the value may have; NULL: none */
    const char *with;                 /* the key without which this one says nothing; NULL: none */
    const char *unit;                 /* NULL: none */
    const char *fallback;             /* default as JSON; NULL: none */
    const char *help;

    /* What earlier versions called it, so that their files are refused by name; NULL: nothing. */
    const char *formerly;     /* the key, under one name or several, separated by spaces .. */
    const char *instead;      /* .. and what to write besides its new name; NULL: nothing else */
    const char *former_words; /* `words` as they were, in their order */

    /* A name written as ITS.OWN: owner "lines" for the name of one of the lines, a dot and one of
     * `after`. Values are items of a CpsiList at the offset. NULL: the name as it is. */
    const char *owner;
    const char *after;

    /* Of a word of laws: makes it of its values (set_keys.h). */
    CpsStatus (*make)(const struct CpsiSetValues *values, struct CpsiSetMade *made, CpsError *err);
    bool solved; /* questions about it solve a conic program over all its parts */
} CpsiKey;

/* A kind of mapping: its table of keys. */
typedef struct CpsiMapping {
    const char *name; /* in messages and JSON schemas: "line", "entry"; NULL: that of its key */
    const char *definition; /* in JSON schemas, where it is not the name */
    const CpsiKey *key;
    int count;
    size_t size; /* of its struct, which begins with a const CpsiYaml *: the mapping,
                    NULL where it is not given. 0: keys go to the struct around */
    void (*begin)(void *values); /* fills the struct with defaults; NULL: zeros */
    const size_t *which; /* where to store, as an int from 0, which of the keys CPSI_ONE_OF is
                            given; NULL: nowhere */
    const char *word;    /* exactly one key stands in it, which is called a "word" .. */
    const char *example; /* .. or a list of it: one of them, "{disc: 500}" */
    const char *also;    /* JSON schema of what else goes together; NULL: nothing */
} CpsiMapping;

/* What CPSI_LIST, CPSI_NAMED and names of a form are read into. */
typedef struct CpsiList {
    const CpsiYaml *node; /* NULL: not given */
    int count;
    void *item; /* (count) structs of the mapping's size, or CpsiNumberItem */
} CpsiList;

/* An item of a list of numbers, as of "OBSTACLE.turn". */
typedef struct CpsiNumberItem {
    const CpsiYaml *node;
    double number;
} CpsiNumberItem;

/* Rows of numbers. */
typedef struct CpsiRows {
    const CpsiYaml *node; /* NULL: not given */
    int rows, columns;
    double *x; /* (rows, columns) */
} CpsiRows;

/* Beyond it squares would overflow (cps_scene_check); .inf where a range allows it. */
#define CPSI_LARGEST 1e100

/* The row for a key as it is written; NULL: there is none. A name of a form is told by its form. */
const CpsiKey *cpsi_key_find(const CpsiMapping *mapping, const char *written);

/* The number of a word in a row's words, from 0; -1: none of them. */
int cpsi_key_word(const char *words, const char *written);

/* Where a word of the row, in any form of its value, was written so by earlier versions: its name
 * now, of *length bytes; NULL: it never was. */
const char *cpsi_key_renamed_word(const CpsiKey *key, const char *written, int *length);

/* What a row accepts, for messages: "a number in m, greater than 0".
 * text   (size) written, always terminated; returns text */
const char *cpsi_key_expected(const CpsiKey *key, char *text, size_t size);

/* WHAT: unknown key 'lenght'; did you mean 'length'?  Or: 'fixed' is now 'held'. Returns
 * CPS_ERR_INPUT. */
CpsStatus cpsi_key_unknown(const char *file, const CpsiYaml *node, const char *what,
                           const CpsiMapping *mapping, CpsError *err);
/* WHAT: found '3', expected ..  Returns CPS_ERR_INPUT. */
CpsStatus cpsi_key_wrong(const char *file, const CpsiYaml *node, const char *what,
                         const char *expected, CpsError *err);
/* WHAT: 'length' is missing: [m] unstretched length; or: nothing given, expected exactly one of ..
 * Returns CPS_OK or CPS_ERR_INPUT. */
CpsStatus cpsi_key_needs(const char *file, const CpsiYaml *node, const char *what,
                         const CpsiMapping *mapping, CpsError *err);

#endif
