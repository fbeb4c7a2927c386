/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of tables of keys: the keys that a mapping of a file may have, and where their values are
 * stored. The vocabularies of scenes (scene_keys.c, history_keys.c), of laws (set_keys.c) and of
 * driven systems (drive_keys.c) are tables of these rows. One reader (read/key_reader.c) checks a
 * file against them and fills structs; suggestions, messages and JSON schemas come from the same
 * rows. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "io/base/yaml/yaml.h"

/* The form of a value, and the type stored at its offset. */
typedef enum CpsiValue {
    CPSI_TEXT,    /* const char *; at most `most` bytes, or not empty where `most` is 0 */
    CPSI_INTEGER, /* int within the range */
    CPSI_COUNT,   /* double: a whole number within the range, which may exceed any int */
    CPSI_NUMBER,  /* double within the range */
    CPSI_FLAG,    /* bool: true, false */
    CPSI_WORD,    /* int: index of one of `words`, from 0 */
    CPSI_POINT,   /* double[most]: exactly this many numbers within the range */
    CPSI_WORDS,   /* bool[most]: which of `most` `words` are listed, each at most once */

    /* CpsiNumberRows */
    CPSI_VECTOR, /* [x, ..]: one row of at most `most` numbers within the range */
    CPSI_ROWS,   /* [[x, ..], ..]: `low` to `high` rows of `most` numbers; 0: all equally long */
    CPSI_SQUARE, /* as many rows as columns */
    CPSI_SIDE,   /* b for [-b, b], or [low, high]: two rows of one number */
    CPSI_SIDES,  /* [side, ..]: all low ends, then all high ends */

    /* const CpsiYaml *: checked in part, and read later */
    CPSI_EXPRESSION,   /* {WORD: value}: one of the keys `inside`, a set, a law, .. */
    CPSI_EXPRESSIONS,  /* [{WORD: value}, ..] */
    CPSI_ELEMENTS,     /* [length, [count, length], ..] */
    CPSI_NAMES,        /* names of parameters, at most `most` of them */
    CPSI_COMBINATIONS, /* [name, {name: factor, ..}, ..] */
    CPSI_BY_NAME,      /* {name: number, ..} */

    CPSI_MAPPING, /* with the keys `inside`, read into the struct that begins at the offset */
    CPSI_LIST,    /* CpsiList: [mapping, ..] with the keys `inside`, at least `most` of them */
    CPSI_NAMED    /* CpsiList: {name: mapping, ..} with the keys `inside` */
} CpsiValue;

typedef enum CpsiNeed {
    CPSI_OPTIONAL,
    CPSI_REQUIRED,
    CPSI_ONE_OF /* exactly one of the keys of the mapping with this mark is required */
} CpsiNeed;

struct CpsiSetValues;
struct CpsiSetMade;

/* A row. Fields that are not given are 0. */
typedef struct CpsiKey {
    const char *name;
    CpsiNeed need;
    CpsiValue type;
    int most;                         /* see CpsiValue */
    size_t offset;                    /* offset of the value in the struct of its mapping */
    double low, high;                 /* range of numbers; a high of INFINITY allows .inf */
    bool open;                        /* low itself is excluded */
    const char *words;                /* separated by spaces, in the order of the enum */
    const struct CpsiMapping *inside; /* mapping of a value that is a mapping, list or expression */
    const struct CpsiKey *other;      /* another form that the value may have; NULL: none */
    const char *with;                 /* another key that must be given with this one; NULL: none */
    const char *unless;   /* another key in place of which this one stands: never both, and where
                             neither is given a required one is missing; NULL: none */
    const char *unit;     /* NULL: none */
    const char *fallback; /* default as JSON; NULL: none */
    const char *help;

    /* What earlier versions called it, so that their files are refused by name; NULL: nothing. */
    const char *formerly;     /* the key, under one name or several, separated by spaces .. */
    const char *instead;      /* .. and what to write besides its new name; NULL: nothing else */
    const char *former_words; /* `words` as they were, in their order */

    /* For a name of the form ITS.OWN: the owner, for instance "lines" for the name of one of the
     * lines, followed by a dot and one of `after`. Values are items of a CpsiList at the offset.
     * NULL: the name is fixed. */
    const char *owner;
    const char *after;

    /* For a word of laws: makes its object from its values (set_keys.h). */
    CpsStatus (*make)(const struct CpsiSetValues *values, struct CpsiSetMade *made, CpsError *err);
    bool solved; /* queries of it solve a conic program over all its parts */
    int closed;  /* .. or do where it has more components than this; 0: any number is closed */
} CpsiKey;

/* A kind of mapping: its table of keys. */
typedef struct CpsiMapping {
    /* name in messages and JSON schemas: "line", "entry"; NULL: that of its key */
    const char *name;
    const char *definition; /* name in JSON schemas, where it differs */
    const CpsiKey *key;
    int count;
    /* size of its struct, which begins with a const CpsiYaml *: the mapping, NULL where it is not
     * given. 0: the values are stored in the enclosing struct */
    size_t size;
    void (*begin)(void *values); /* fills the struct with defaults; NULL: zeros */
    /* offset of an int, from 0, for the index of the key CPSI_ONE_OF that is given; NULL: none */
    const size_t *which;
    const char *word;    /* the mapping has exactly one key, which is called a "word" .. */
    const char *example; /* .. or it is a list of such mappings; an example, "{disc: 500}" */
    const char *also;    /* further conditions as JSON schema; NULL: none */
} CpsiMapping;

/* The value of CPSI_LIST, CPSI_NAMED and of keys with an owner. */
typedef struct CpsiList {
    const CpsiYaml *node; /* NULL: not given */
    int count;
    void *item; /* (count) structs of the mapping's size, or CpsiNumberItem */
} CpsiList;

/* An item of a list of numbers, for instance of "OBSTACLE.turn". */
typedef struct CpsiNumberItem {
    const CpsiYaml *node;
    double number;
} CpsiNumberItem;

/* Rows of numbers. */
typedef struct CpsiNumberRows {
    const CpsiYaml *node; /* NULL: not given */
    int rows, columns;
    double *x; /* (rows, columns) */
} CpsiNumberRows;

/* Squares of larger numbers would overflow (cps_scene_check); .inf where a range allows it. */
#define CPSI_LARGEST 1e100

/* The row for a key as written in a file; NULL: there is none. A name with an owner is recognised
 * by its form. */
const CpsiKey *cpsi_key_find(const CpsiMapping *mapping, const char *written);

/* The index of a word in a row's words, from 0; -1: it is not one of them. */
int cpsi_key_word(const char *words, const char *written);

/* Where a word of the row, in any form of its value, was written so by earlier versions: its name
 * now, of *length bytes; NULL: it never was. */
const char *cpsi_key_renamed_word(const CpsiKey *key, const char *written, int *length);

/* What a row accepts, for messages: "a number in m, greater than 0".
 *   text   (size) written, always terminated; returned */
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
