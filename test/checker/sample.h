/* SPDX-License-Identifier: BSD-3-Clause */
/* Result files with known contents, for tests of the checker. */
#ifndef CAPSTAN_CHECKER_SAMPLE_H
#define CAPSTAN_CHECKER_SAMPLE_H

#include <stddef.h>

/* Two steps of four lines, the second without any motion, every number exact in binary:
 *   drag   elastic, straight on a rough bed, pulled at B: solved
 *   tight  inextensible, ends exactly its length apart: taut
 *   far    inextensible, ends farther apart than its length: infeasible
 *   loose  both ends free, pulled harder than the bed holds it: unbounded
 * Returns 0 or a netCDF error. */
int sample_write(const char *path);

/* Two equal steps of one line, "wound" on a drum that turns back under it, slipping everywhere,
 * with consistent friction: axial coefficient 1/2, lateral 1/4. Every number to rounding. */
int sample_write_drum(const char *path);

/* The same with the coefficients as a set of 1/1.25 of the size, and friction zones that make up
 * for it. */
int sample_write_set(const char *path);

/* Two steps of one line, "corner", as "drag" but on a bed and beside a wall at once, both rough,
 * under a ceiling that nothing touches, with consistent friction. */
int sample_write_corner(const char *path);

/* Two equal steps of one line, "line", that goes over a post with consistent friction and touches
 * it with an element. */
int sample_write_post(const char *path);

/* Two equal steps of one massless line, "spill", over a drum with mu = 1/2, which A follows and B
 * pulls beyond the limit: it slides without end. */
int sample_write_spill(const char *path);

/* Two equal steps of one line, "fall", that hangs in the air below a drum, both ends free:
 * unbounded. */
int sample_write_fall(const char *path);

/* Two equal steps of one inextensible line, "reel", that is too short to reach round a drum to
 * where end B shall be: infeasible. */
int sample_write_reel(const char *path);

/* Overwrite one number: component `index` (flat; beyond the first step's: in the second) of a
 * variable. */
int sample_poke(const char *path, const char *variable, size_t index, double value);

#endif
