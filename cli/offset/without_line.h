/* SPDX-License-Identifier: BSD-3-Clause */
/* A scene in which one line is missing: broken, or not yet laid. */
#ifndef CAPSTAN_CLI_OFFSET_WITHOUT_LINE_H
#define CAPSTAN_CLI_OFFSET_WITHOUT_LINE_H

#include "capstan/scene.h"

/* `scene` refers to the arrays here and to those of the scene that it was made from. */
typedef struct WithoutLine {
    CpsScene scene;
    void *memory;
} WithoutLine;

/* The points at which no other line ends are missing as well, and so is what the history does to
 * them and to the line. False without memory. */
bool without_line(const CpsScene *scene, int line, WithoutLine *out);
void without_line_clear(WithoutLine *without);

#endif
