/* SPDX-License-Identifier: BSD-3-Clause */
/* Rows of tables of keys: what may stand in a mapping of a file, and where reading puts it. The vocabularies of scenes, of laws and of driven
 * systems are tables of these; messages, suggestions and JSON schemas all come from the rows. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_KEYS_H
#define CAPSTAN_SRC_IO_SCHEMA_KEYS_H

#include <stdbool.h>
#include <stddef.h>

#include "io/base/yaml.h"

/* What stands under a key, and what reading stores at its offset. */
typedef enum CpsiValue {
    CPSI_NOTHING,           /* behind the last key */
    CPSI_TEXT,              /* const char *; at most `most` bytes, not empty where that is 0 */
    CPSI_INTEGER,           /* int of the range */
    CPSI_NUMBER,            /* double of the range */
    CPSI_FLAG,              /* bool: true, false */
    CPSI_WORD,              /* int: which of `words`, from 0 */
    CPSI_POINT,             /* double[most]: exactly so many numbers */

    /* sets and laws, as CpsiLawValue (set_words.h) */
    CPSI_VECTOR,            /* [x, ..], at most `most` numbers of the range */
    CPSI_MATRIX,            /* [[x, ..], ..]: rows of components, all equally long */
    CPSI_SQUARE,            /* a matrix with as many rows as columns */
    CPSI_ENDS_OF_SEGMENT,   /* [[x, ..], [x, ..]]: a matrix of two rows */
    CPSI_PAIRS,             /* [[x, y], ..]; kept as all x, then all y */
    CPSI_SIDE,              /* b for [-b, b], or [low, high] */
    CPSI_SIDES,             /* [side, ..]; kept as all low ends, then all high ends */
    CPSI_SET,               /* {WORD: value} */
    CPSI_SETS,              /* [set, ..] */
    CPSI_LAW,               /* a set that must contain 0 */
    CPSI_LAWS,              /* [law, ..] */
    CPSI_CONTACTS,          /* [{map: B, of: law}, ..] */
    CPSI_TERMS,             /* [{TERM: value}, ..] */

    /* the node itself, const CpsiYaml *, for the caller to read */
    CPSI_MAPPING,           /* with the keys `inside`, or one of `words` in its place */
    CPSI_LIST,              /* of such mappings, at least `most` */
    CPSI_NUMBER_OR_MAPPING, /* a number of the range in its place */
    CPSI_POINTS,            /* [[x, y, z], ...], at least two */
    CPSI_ELEMENTS,          /* a count, or a list of lengths and of [count, length] */
    CPSI_PATCHES,           /* list of {WORD: mapping}, one of the kinds of patch each */
    CPSI_COMPONENTS,        /* as many numbers as the law has components */
    CPSI_ROWS,              /* at least `low` rows of `most` numbers, of any one number where that is 0 */
    CPSI_PATH,              /* rows of numbers, or a mapping */
    CPSI_CURVE,             /* at least 3 rows of 2 numbers, or a mapping */
    CPSI_NAMES,             /* names of parameters, at most `most` */
    CPSI_MAP,               /* combinations of parameters */
    CPSI_BY_NAME,           /* numbers by parameter */
    CPSI_BRAKE,             /* a torque of at least 0, or "locked" */
    CPSI_END_MOTION,        /* "free", "held" or a velocity of 2 numbers */
    CPSI_FILE_NAME          /* of a file */
} CpsiValue;

typedef enum CpsiNeed {
    CPSI_OPTIONAL,
    CPSI_REQUIRED,
    CPSI_ONE_OF /* exactly one of the mapping's keys marked so */
} CpsiNeed;

/* The offset of a value that the reader takes from the tree itself. */
#define CPSI_BY_HAND ((size_t)-1)

typedef struct CpsiKey {
    const char *name; /* NULL: what stands behind a word of law files itself. Scenes: see scene_keys.h for names of a form */
    CpsiValue type;
    CpsiNeed need;
    size_t offset;    /* in the struct that the mapping is read into; of a mapping: its keys go to the same struct */
    const char *unit; /* "" without */
    double low, high; /* range of numbers; a high of INFINITY allows .inf */
    bool open;        /* low itself is excluded */
    int most;
    int inside;           /* number of the mapping in its vocabulary */
    const char *words;    /* separated by spaces, in the order of the enum they stand for */
    const char *fallback; /* default as JSON, NULL: none */
    const char *help;
} CpsiKey;

/* Beyond it squares would overflow (cps_scene_check); .inf where a range allows it. */
#define CPSI_LARGEST 1e100

/* The number of a word in a row's words, from 0; -1: none of them. */
int cpsi_key_word(const CpsiKey *key, const char *written);

/* "a, b, c". Returns text. */
const char *cpsi_key_list(const CpsiKey *key, int count, char *text, size_t size);

/* Keep the nearest of the candidates offered one after the other: start with {.word = written}. */
typedef struct CpsiSuggestion {
    const char *word, *best; /* best NULL: nothing near enough */
    int distance;
} CpsiSuggestion;
void cpsi_suggest(CpsiSuggestion *suggestion, const char *candidate);

/* WHAT: unknown key 'lenght'; did you mean 'length'?  Returns CPS_ERR_INPUT. */
CpsStatus cpsi_key_unknown(const char *file, const CpsiYaml *node, const char *what, const CpsiKey *key, int count, CpsError *err);
/* WHAT: 'length' is missing: [m] unstretched length.  Returns CPS_ERR_INPUT. */
CpsStatus cpsi_key_missing(const char *file, const CpsiYaml *node, const char *what, const CpsiKey *key, CpsError *err);
/* WHAT: found '3', expected ..  Returns CPS_ERR_INPUT. */
CpsStatus cpsi_key_wrong(const char *file, const CpsiYaml *node, const char *what, const char *expected, CpsError *err);

#endif
