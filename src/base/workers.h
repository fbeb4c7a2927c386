/* SPDX-License-Identifier: BSD-3-Clause */
/* Threads that share independent items of work. They are started once and wait between runs. */
#ifndef CAPSTAN_SRC_BASE_WORKERS_H
#define CAPSTAN_SRC_BASE_WORKERS_H

typedef struct CpsiWorkers CpsiWorkers;

/* Do one item. `worker` is 0 .. count - 1; no two calls at the same time have the same one, and
 * worker 0 is the thread that runs. */
typedef void (*CpsiTask)(void *data, int worker, int item);

/* Start count - 1 threads, count >= 1, that work beside the caller's; NULL where the system has no
 * memory or no thread left. To be destroyed by the caller. */
CpsiWorkers *cpsi_workers_create(int count);
void cpsi_workers_destroy(CpsiWorkers *workers);

/* Do the items 0 .. item_count - 1, each once, and return when all are done. Who does which item
 * changes from run to run: a task may depend on its item only. `workers` NULL: the caller does
 * them in order. */
void cpsi_workers_run(CpsiWorkers *workers, CpsiTask task, void *data, int item_count);

#endif
