/* SPDX-License-Identifier: BSD-3-Clause */
/* Detection of lines for which libfyaml needs quadratic time. */
#ifndef CAPSTAN_SRC_IO_BASE_YAML_YAML_LINES_H
#define CAPSTAN_SRC_IO_BASE_YAML_YAML_LINES_H

#include <stdbool.h>
#include <stddef.h>

/* Check `bytes`, UTF-8. Returns true where nothing is wrong; else *line (from 1), and *found
 * describes what was found and what is expected. */
bool cpsi_yaml_lines(const char *bytes, size_t size, int *line, const char **found);

#endif
