/* SPDX-License-Identifier: BSD-3-Clause */
/* A system inside. A law has one piece per factor of a product, each on its own components, or one
 * per term of a resistance, all on the same components; a piece has a conic form. */
#ifndef CAPSTAN_SRC_DRIVE_SYSTEM_H
#define CAPSTAN_SRC_DRIVE_SYSTEM_H

#include "capstan/drive.h"
#include "drive/rows.h"
#include "law/resistance.h"
#include "set/conic_form.h"

/* A factor of a friction law, or a term of a resistance. */
typedef struct CpsiPiece {
    int law, offset, space; /* the law's components that it is about */
    const CpsSet *set;      /* of forces; NULL for a viscous term */
    const CpsiTerm *term;   /* of the law's resistance; NULL for friction */
    int form;               /* friction: its place among the system's forms */
} CpsiPiece;

typedef struct CpsiSystemLaw {
    char *name;
    int space, first;          /* its components among all laws' */
    int piece, pieces;         /* its pieces */
    CpsLaw *friction;          /* its own copy, or NULL */
    CpsResistance *resistance; /* its own copy, or NULL */
} CpsiSystemLaw;

struct CpsSystem {
    int n, laws, pieces, forms, components;
    size_t law_room, piece_room, form_room;
    CpsiSystemLaw *law;
    CpsiPiece *piece;
    CpsiConicForm **form; /* conic forms of the friction laws' sets */
    CpsiRows map;         /* (components) rows of all B_k */
    CpsiRows constraint;  /* C */
    CpsiRows drive;       /* D */
    double *load;         /* (n), NULL: none */
};

/* Is there a load other than 0? */
bool cpsi_system_loaded(const CpsSystem *system);

/* An orthonormal basis of the null space of [D; C] in rows (count, n), and of its complement; for
 * the dense questions. *all (n, n): first `rank` rows span the rows of [D; C], the others are the
 * basis. The caller frees *all. `rhs` (m + constraints) are the values of [D; C] V, replaced by
 * those of the orthonormal rows. CPS_ERR_LIMIT for systems too large to be dense. */
CpsStatus cpsi_system_kernel(const CpsSystem *system, double *rhs, int *rank, double **all,
                             CpsError *err);

#endif
