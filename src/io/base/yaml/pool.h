/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory for many small objects that are freed together: a parsed file, a scene. */
#ifndef CAPSTAN_SRC_IO_BASE_YAML_POOL_H
#define CAPSTAN_SRC_IO_BASE_YAML_POOL_H

#include <stddef.h>

typedef struct CpsiPool {
    struct CpsiPoolBlock *newest; /* NULL: empty */
} CpsiPool;

/* Memory for `count` zeroed items of `size` bytes, aligned for any type; NULL when memory or size_t
 * does not suffice. */
void *cpsi_pool_take(CpsiPool *pool, size_t count, size_t size);

/* A copy of n bytes followed by a zero byte; NULL as above. */
char *cpsi_pool_text(CpsiPool *pool, const char *text, size_t n);

void cpsi_pool_free(CpsiPool *pool);

#define CPSI_POOL_TAKE(pool, count, type) cpsi_pool_take((pool), (size_t)(count), sizeof(type))

#endif
