/* SPDX-License-Identifier: BSD-3-Clause */
/* How sharply the line turns round obstacles from one element to the next. */
#ifndef CAPSTAN_SRC_CABLE_BEND_H
#define CAPSTAN_SRC_CABLE_BEND_H

#include "cable/line.h"

/* The contact at which the mesh changes the law of friction most, zeros where there is none:
 * theory.md section 3. */
CpsBend cpsi_line_bend(const CpsiLine *line);

/* Does the mesh change the law more at a than at b? */
bool cpsi_bend_is_sharper(const CpsBend *a, const CpsBend *b);

/* Does the contact hold so large a ratio of tensions that the mesh, not friction, decides it? */
bool cpsi_bend_locks(const CpsBend *bend);

#endif
