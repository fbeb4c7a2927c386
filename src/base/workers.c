/* SPDX-License-Identifier: BSD-3-Clause */
/* Threads that share independent items of work (workers.h).
 *
 * One lock guards everything. Items are as large as a load step of a line, or a pass over hundreds
 * of nodes, so taking each of them under the lock costs nothing beside them. */
#include "base/workers.h"

#include <pthread.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>

typedef struct Worker {
    CpsiWorkers *all;
    int number; /* from 1 */
    pthread_t thread;
} Worker;

struct CpsiWorkers {
    pthread_mutex_t lock;
    pthread_cond_t begun, ended; /* a run has begun, or all shall end; a run has no item left */
    CpsiTask task;
    void *data;
    int next, item_count; /* the next item of the run, and how many it has */
    int unfinished;       /* items that are not done yet */
    bool closing;
    int thread_count;
    Worker worker[];
};

/* Do items of the present run until none is left to take. The lock is held before and after. */
static void take_items(CpsiWorkers *workers, int number) {
    while (workers->next < workers->item_count) {
        const int item = workers->next++;
        pthread_mutex_unlock(&workers->lock);
        workers->task(workers->data, number, item);
        pthread_mutex_lock(&workers->lock);
        if (--workers->unfinished == 0) pthread_cond_signal(&workers->ended);
    }
}

static void *serve(void *data) {
    const Worker *worker = data;
    CpsiWorkers *workers = worker->all;
    pthread_mutex_lock(&workers->lock);
    for (;;) {
        take_items(workers, worker->number);
        if (workers->closing) break;
        pthread_cond_wait(&workers->begun, &workers->lock);
    }
    pthread_mutex_unlock(&workers->lock);
    return NULL;
}

/* Start the threads with all signals blocked: signals are for the threads of the caller. */
static bool start_threads(CpsiWorkers *workers, int count) {
    sigset_t all, before;
    sigfillset(&all);
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0) return false;
    for (int i = 0; i < count; i++) {
        Worker *worker = &workers->worker[i];
        *worker = (Worker){.all = workers, .number = i + 1};
        if (pthread_create(&worker->thread, NULL, serve, worker) != 0) break;
        workers->thread_count++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return workers->thread_count == count;
}

CpsiWorkers *cpsi_workers_create(int count) {
    CpsiWorkers *workers =
        calloc(1, sizeof *workers + (size_t)(count - 1) * sizeof *workers->worker);
    if (!workers) return NULL;
    pthread_mutex_init(&workers->lock, NULL);
    pthread_cond_init(&workers->begun, NULL);
    pthread_cond_init(&workers->ended, NULL);
    if (start_threads(workers, count - 1)) return workers;
    cpsi_workers_destroy(workers);
    return NULL;
}

void cpsi_workers_destroy(CpsiWorkers *workers) {
    if (!workers) return;
    pthread_mutex_lock(&workers->lock);
    workers->closing = true;
    pthread_cond_broadcast(&workers->begun);
    pthread_mutex_unlock(&workers->lock);
    for (int i = 0; i < workers->thread_count; i++) pthread_join(workers->worker[i].thread, NULL);
    pthread_cond_destroy(&workers->ended);
    pthread_cond_destroy(&workers->begun);
    pthread_mutex_destroy(&workers->lock);
    free(workers);
}

void cpsi_workers_run(CpsiWorkers *workers, CpsiTask task, void *data, int item_count) {
    if (!workers) {
        for (int item = 0; item < item_count; item++) task(data, 0, item);
        return;
    }
    pthread_mutex_lock(&workers->lock);
    workers->task = task;
    workers->data = data;
    workers->next = 0;
    workers->item_count = workers->unfinished = item_count;
    pthread_cond_broadcast(&workers->begun);
    take_items(workers, 0);
    while (workers->unfinished > 0) pthread_cond_wait(&workers->ended, &workers->lock);
    pthread_mutex_unlock(&workers->lock);
}
