/* SPDX-License-Identifier: BSD-3-Clause */
/* The picture of offsets: what holds a body against them. */
#ifndef CAPSTAN_SRC_IO_DRAW_STUDY_OFFSET_PICTURE_H
#define CAPSTAN_SRC_IO_DRAW_STUDY_OFFSET_PICTURE_H

#include <stdio.h>

#include "capstan/offset.h"

void cpsi_picture_offsets(const CpsOffsets *offsets, FILE *out);

#endif
