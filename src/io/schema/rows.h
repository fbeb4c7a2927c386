/* SPDX-License-Identifier: BSD-3-Clause */
/* Abbreviations for writing tables of keys. The macros check the type of the field in which a value
 * is stored: a field of another type does not compile. KIND is that of the struct
 * CpsiKINDValues. */
#ifndef CAPSTAN_SRC_IO_SCHEMA_ROWS_H
#define CAPSTAN_SRC_IO_SCHEMA_ROWS_H

#include <math.h>

#include "io/schema/keys.h"

#define OPTIONAL CPSI_OPTIONAL
#define REQUIRED CPSI_REQUIRED
#define ONE_OF   CPSI_ONE_OF

#define AT(kind, field)    offsetof(Cpsi##kind##Values, field)
#define FIELD(kind, field) (&((Cpsi##kind##Values *)0)->field)
#define TYPED(pointer, kind, field) \
    (AT(kind, field) + 0 * sizeof(_Generic(FIELD(kind, field), pointer : 0)))
#define TREE(kind, field) TYPED(const CpsiYaml **, kind, field)

/* type, most, offset; followed by the range of numbers, or of the number of rows */
#define TEXT(kind, field, most)    CPSI_TEXT, most, TYPED(const char **, kind, field)
#define INTEGER(kind, field)       CPSI_INTEGER, 0, TYPED(int *, kind, field)
#define COUNT(kind, field)         CPSI_COUNT, 0, TYPED(double *, kind, field)
#define NUMBER(kind, field)        CPSI_NUMBER, 0, TYPED(double *, kind, field)
#define FLAG(kind, field)          CPSI_FLAG, 0, TYPED(bool *, kind, field)
#define POINT(kind, field, n)      CPSI_POINT, n, TYPED(double(*)[n], kind, field)
#define WORDS(kind, field, n)      CPSI_WORDS, n, TYPED(bool(*)[n], kind, field)
#define VECTOR(kind, field, most)  CPSI_VECTOR, most, TYPED(CpsiNumberRows *, kind, field)
#define ROWS(kind, field, columns) CPSI_ROWS, columns, TYPED(CpsiNumberRows *, kind, field)
#define SQUARE(kind, field)        CPSI_SQUARE, 0, TYPED(CpsiNumberRows *, kind, field)
#define SIDE(kind, field)          CPSI_SIDE, 0, TYPED(CpsiNumberRows *, kind, field)
#define SIDES(kind, field, most)   CPSI_SIDES, most, TYPED(CpsiNumberRows *, kind, field)
#define EXPRESSION(kind, field)    CPSI_EXPRESSION, 0, TREE(kind, field)
#define EXPRESSIONS(kind, field)   CPSI_EXPRESSIONS, 0, TREE(kind, field)
#define ELEMENTS(kind, field)      CPSI_ELEMENTS, 0, TREE(kind, field)
#define NAMES(kind, field, most)   CPSI_NAMES, most, TREE(kind, field)
#define COMBINATIONS(kind, field)  CPSI_COMBINATIONS, 0, TREE(kind, field)
#define BY_NAME(kind, field)       CPSI_BY_NAME, 0, TREE(kind, field)
#define LIST(kind, field, least)   CPSI_LIST, least, TYPED(CpsiList *, kind, field)
#define NAMED(kind, field)         CPSI_NAMED, 0, TYPED(CpsiList *, kind, field)

/* an int, or an enum of the same size */
#define WORD(kind, field) \
    CPSI_WORD, 0,         \
        (AT(kind, field) + 0 * sizeof(char[sizeof *FIELD(kind, field) == sizeof(int) ? 1 : -1]))

/* a mapping with its own struct; a mapping whose values are stored in the enclosing struct; values
 * of a key with an owner */
#define MAPPING(kind, field)       CPSI_MAPPING, 0, AT(kind, field)
#define AROUND                     CPSI_MAPPING, 0, 0
#define OWNED(kind, field)         CPSI_MAPPING, 0, TYPED(CpsiList *, kind, field)
#define OWNED_NUMBERS(kind, field) CPSI_NUMBER, 0, TYPED(CpsiList *, kind, field)

/* ranges: lowest, highest, lowest excluded */
#define ANY          -CPSI_LARGEST, CPSI_LARGEST, false
#define POSITIVE     0, CPSI_LARGEST, true
#define NOT_NEGATIVE 0, CPSI_LARGEST, false

/* Of a mapping: its table, its struct, and where the index of the given key is stored. */
#define KEYS(rows) .key = rows, .count = (int)(sizeof rows / sizeof rows[0])
#define INTO(kind) .size = sizeof(Cpsi##kind##Values)
#define WHICH(kind, field) \
    .which = &(const size_t) { AT(kind, field) }

#endif
