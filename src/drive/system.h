/* SPDX-License-Identifier: BSD-3-Clause */
/* The content of a system. A law has one piece per factor of a product, each with its own
 * components, or one per term of a resistance, all with the same components; a piece has a conic
 * form. */
#ifndef CAPSTAN_SRC_DRIVE_SYSTEM_H
#define CAPSTAN_SRC_DRIVE_SYSTEM_H

#include "capstan/drive.h"
#include "drive/rows.h"
#include "law/resistance.h"
#include "set/conic_form.h"

/* A factor of a friction law, or a term of a resistance. */
typedef struct CpsiPiece {
    /* the law, and the first and the number of the law's components that belong to the piece */
    int law, offset, space;
    const CpsSet *set;    /* of forces; NULL for a viscous term */
    const CpsiTerm *term; /* of the law's resistance; NULL for friction */
    int form;             /* friction: index of the form in the system */
} CpsiPiece;

typedef struct CpsiSystemLaw {
    char *name;
    /* number of its components, and the first of them among those of all laws */
    int space, first;
    int piece, pieces;         /* its first piece, and their number */
    CpsLaw *friction_law;      /* its own copy, or NULL */
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

/* Whether there is a load other than 0. */
bool cpsi_system_loaded(const CpsSystem *system);

/* An orthonormal basis of the null space of [D; C] in rows (count, n), and of its complement, for
 * the dense computations. *all (n, n): the first `rank` rows span the rows of [D; C], the others
 * are the basis. The caller frees *all. `rhs` (m + constraints) are the values of [D; C] V,
 * replaced by those of the orthonormal rows. CPS_ERR_LIMIT for systems too large to be dense. */
CpsStatus cpsi_system_kernel(const CpsSystem *system, double *rhs, int *rank, double **all,
                             CpsError *err);

#endif
