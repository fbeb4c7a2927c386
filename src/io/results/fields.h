/* SPDX-License-Identifier: BSD-3-Clause */
/* The fields of result.nc along a line, and the selection of those that a run writes. */
#ifndef CAPSTAN_SRC_IO_RESULTS_FIELDS_H
#define CAPSTAN_SRC_IO_RESULTS_FIELDS_H

#include "capstan/step.h"

typedef enum CpsiPlace {
    CPSI_PLACE_NODE,
    CPSI_PLACE_SPRING, /* of nodes, where the line has springs; where it has loads */
    CPSI_PLACE_LOAD,
    CPSI_PLACE_ELEMENT,
    CPSI_PLACE_ELEMENT_CONTACT /* of elements, where their contacts are looked for */
} CpsiPlace;

/* An array of CpsLineView. */
typedef struct CpsiField {
    const char *name, *long_name, *units;
    CpsiPlace place;
    bool vector, fixed; /* fixed: does not change from step to step, and is always written */
    /* belongs to a contact: where nodes have a second one, there is one more variable for it */
    bool contact;
    size_t offset; /* offset of a const double * in CpsLineView */
} CpsiField;

enum { CPSI_FIELDS = 26 };
extern const CpsiField cpsi_field[CPSI_FIELDS];

/* The selected fields: a bit for each field, and these two for arrays that do not contain
 * doubles. */
#define CPSI_WANTED_STATE    (1u << CPSI_FIELDS)
#define CPSI_WANTED_OBSTACLE (2u << CPSI_FIELDS)

/* A list of names separated by commas; NULL: all; "none": none. Returns CPS_OK or
 * CPS_ERR_ARGUMENT. */
CpsStatus cpsi_fields_choose(const char *list, unsigned *wanted, CpsError *err);

#endif
