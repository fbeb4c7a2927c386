/* SPDX-License-Identifier: BSD-3-Clause */
/* The condition of Proposition 1: whether the forces in the middle of all forces in equilibrium lie
 * inside the laws' sets. */
#include <math.h>
#include <stdlib.h>

#include "base/status.h"
#include "drive/motion.h"
#include "ipm/cones.h"
#include "linalg/dense.h"

static CpsStatus out_of_memory(CpsError *err) {
    return cpsi_fail(err, CPS_ERR_MEMORY, "no memory for a motion");
}

/* Whether the forces of the form have the full dimension of the space. */
static CpsStatus full_dimension(const CpsiConicForm *form, int space, bool *full, CpsError *err) {
    const size_t n = (size_t)space, count = (size_t)form->unknowns + (size_t)form->lines;
    if (count < n) {
        *full = false;
        return CPS_OK;
    }
    double *rows = malloc((count * n + 1) * sizeof *rows);
    if (!rows) return out_of_memory(err);
    for (size_t j = 0; j < count; j++)
        for (size_t i = 0; i < n; i++) {
            const size_t u = (size_t)form->unknowns;
            rows[j * n + i] = j < u ? form->p[i * u + j] : form->q[(j - u) * (size_t)form->n + i];
        }
    *full = cpsi_orthonormal_rows((int)count, space, rows, NULL, 1e-9) == space;
    free(rows);
    return CPS_OK;
}

/* The smallest margin of a piece's cones, whose rows have size one. */
static double margin_of(const CpsiConicForm *form, const double *s) {
    double least = INFINITY;
    CPSI_FOR_CONES(c, i, form->cones, form->dim)
        least = fmin(least, s[i] - cpsi_norm(form->dim[c] - 1, &s[i + 1]));
    return least;
}

CpsStatus cpsi_motion_composition(const CpsSystem *system, double boundary,
                                  CpsComposition *composition, int *iterations, CpsError *err) {
    CpsiDriveProgram program;
    CpsStatus status =
        cpsi_drive_program_new(system, CPSI_AIM_MIDDLE, NULL, 1, false, &program, err);
    if (status != CPS_OK) return status;
    cpsi_drive_program_solve(&program);
    *iterations += program.result.iterations;
    const bool known = program.result.outcome == CPSI_CONIC_SOLVED;
    const double *s = program.result.s;
    *composition = known ? CPS_COMPOSITION_INTERIOR : CPS_COMPOSITION_NOT_SATISFIED;
    bool full = true;
    if (known)
        for (int k = 0; status == CPS_OK && k < system->pieces; k++) {
            const CpsiConicForm *form = program.form[k];
            const CpsiPiece *piece = &system->piece[k];
            CpsComposition place = CPS_COMPOSITION_INTERIOR;
            /* neighbouring pieces with the same set have the same dimension */
            if (k == 0 || form != program.form[k - 1])
                status = full_dimension(form, piece->space, &full, err);
            if (!full) place = CPS_COMPOSITION_RELATIVE_INTERIOR;
            if (margin_of(form, s + program.row[k]) < boundary)
                place = piece->set && cpsi_law_polyhedral(piece->set)
                            ? CPS_COMPOSITION_POLYHEDRAL
                            : CPS_COMPOSITION_NOT_SATISFIED;
            if (place > *composition) *composition = place;
        }
    cpsi_drive_program_clear(&program);
    return status;
}
