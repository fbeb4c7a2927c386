/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan/offset.h: files of what holds a body in place (library capstan-io): the force that its
 * lines oppose to an offset along several headings, there and back, and its equilibrium with each
 * line missing. `capstan offset` computes them with moves of evolve.h (docs/formats.md).
 *
 * These are plain structs that need to live during the call only. */
#ifndef CAPSTAN_OFFSET_H
#define CAPSTAN_OFFSET_H

#include <stdbool.h>

#include "capstan/base.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A body that is held at an offset in its horizontal plane. */
typedef struct CpsOffsetPlace {
    double offset;      /* [m] from where it was, along the heading */
    double restoring;   /* [N] of the lines, against the heading */
    double across;      /* [N] of the lines, to the left of the heading */
    double lines[6];    /* [N, N m] of the lines, as of CpsBodyReport */
    double tension;     /* [N] the largest of all lines */
    int tension_line;   /* its line */
    double utilisation; /* [-] the largest of lines with a breaking load; 0 without */
    bool certified;     /* the step that led there */
} CpsOffsetPlace;

/* The places of one heading, out and back. */
typedef struct CpsOffsetCurve {
    double heading; /* [degrees] from x towards y */
    int count;
    const CpsOffsetPlace *place; /* (count) in the order in which they were taken */
} CpsOffsetCurve;

/* The last step of the history with all lines, or with one missing. */
typedef struct CpsOffsetCase {
    const char *missing; /* name of the line; NULL: none */
    bool certified;      /* every step */
    double position[3];  /* [m] of the body */
    double from[3];      /* [m] from where it is with all lines */
    double heel;         /* [degrees] of its z axis from the vertical */
    double tension;      /* [N] the largest of all lines */
    const char *tension_line;
    double utilisation; /* [-] as above */
    double uplift;      /* [N] the largest at an end that is not on the body */
} CpsOffsetCase;

typedef struct CpsOffsets {
    uint32_t cookie; /* of cps_offsets_default(); offsets made otherwise are refused */
    const char *title, *body;
    int line_count;
    const char *const *line_name; /* (line_count) */
    int curve_count;              /* 1..72 */
    const CpsOffsetCurve *curve;
    int case_count; /* 0: not asked for */
    const CpsOffsetCase *outcome;
    bool complete; /* nothing that was asked for is missing */
} CpsOffsets;
CPS_API CpsOffsets cps_offsets_default(void);

/* Write offset.csv (a row per place), broken.csv (a row per case), offset.svg (restoring force and
 * largest tension over the offset, a colour for each heading) and offset.json (the list) into
 * `directory`, completely or not at all. Returns CPS_OK, CPS_ERR_ARGUMENT, CPS_ERR_IO or
 * CPS_ERR_MEMORY. */
CPS_API CpsStatus cps_offsets_write(const char *directory, const CpsOffsets *offsets,
                                    CpsError *err);

#ifdef __cplusplus
}
#endif
#endif
