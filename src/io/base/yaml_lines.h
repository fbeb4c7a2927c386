/* SPDX-License-Identifier: BSD-3-Clause */
/* Lines on which libfyaml takes a time that grows with their square. */
#ifndef CAPSTAN_SRC_IO_BASE_YAML_LINES_H
#define CAPSTAN_SRC_IO_BASE_YAML_LINES_H

#include <stdbool.h>
#include <stddef.h>

/* Look through `bytes`, UTF-8. True: nothing is wrong; else *line (from 1), and *found says what is
 * there and what is expected. */
bool cpsi_yaml_lines(const char *bytes, size_t size, int *line, const char **found);

#endif
