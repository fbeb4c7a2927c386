/* SPDX-License-Identifier: BSD-3-Clause */
/* Minimum degree ordering on the quotient graph (George and Liu 1989), with approximate degrees and
 * element absorption after Amestoy, Davis and Duff (1996).
 *
 * Eliminating p joins all its neighbours to each other. This clique is not stored as edges but as
 * one element p with its list of members; a variable's neighbours are the variables on its list and
 * the members of the elements on it. An element whose members all belong to a newer element is
 * absorbed by it. The degree of i is bounded by
 *
 *     |variables of i| + |L_p| - 1 + sum over its other elements e of |L_e minus L_p|,
 *
 * which counts common members of the e more than once, and costs one pass over the lists of L_p.
 * Variables with very many neighbours (hubs) are removed beforehand and ordered last. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "linalg/sparse_ldl.h"

/* A hub has more than HUB sqrt(n) neighbours, and more than LEAST_HUB. */
static const double HUB = 10;
static const int LEAST_HUB = 40;

typedef enum State { VARIABLE, ELEMENT, GONE } State;

typedef struct Graph {
    int n, ordered, least; /* least: all buckets below it are empty */
    int *order;
    unsigned char *state; /* (n) State */
    size_t *at;           /* (n) where the list of a variable or element begins */
    int *elements,
        /* (n) lengths of lists: of a variable, its elements, which come first, and all entries; of
         * an element, its members */
        *length;
    int *list, *spare; /* the lists, and the array into which they are packed */
    size_t used, capacity;
    /* doubly linked lists of the variables of each degree; -1 ends a list */
    int *degree, *first, *next, *before;
    int *mark, stamp;    /* (n) the members of the newest element have mark = stamp */
    int *seen, *outside; /* (n) of an element: |L_e minus L_p|, valid where seen = stamp */
    void *block;
} Graph;

/* ---- buckets ---- */

static void put(Graph *g, int i, int degree) {
    g->degree[i] = degree;
    g->next[i] = g->first[degree];
    g->before[i] = -1;
    if (g->next[i] >= 0) g->before[g->next[i]] = i;
    g->first[degree] = i;
    if (degree < g->least) g->least = degree;
}

static void take(Graph *g, int i) {
    if (g->before[i] >= 0)
        g->next[g->before[i]] = g->next[i];
    else
        g->first[g->degree[i]] = g->next[i];
    if (g->next[i] >= 0) g->before[g->next[i]] = g->before[i];
}

/* ---- lists ---- */

static bool allocate(Graph *g, int n, size_t capacity) {
    const size_t w = (size_t)n;
    g->n = n;
    g->least = n;
    g->capacity = capacity;
    g->block = calloc(10 * w + 2 * capacity + 1, sizeof(int));
    g->at = calloc(w + 1, sizeof *g->at);
    g->state = calloc(w + 1, 1);
    if (!g->block || !g->at || !g->state) return false;
    int **part[] = {&g->elements, &g->length, &g->degree, &g->first,  &g->next,
                    &g->before,   &g->mark,   &g->seen,   &g->outside};
    int *at = g->block;
    for (size_t k = 0; k < sizeof part / sizeof *part; k++, at += w) *part[k] = at;
    g->list = at;
    g->spare = at + capacity;
    for (int i = 0; i < n; i++) g->first[i] = -1;
    return true;
}

static void release(Graph *g) {
    free(g->block);
    free(g->at);
    free(g->state);
}

/* The lists of neighbours of all variables except hubs, which are ordered last. */
static void lay_lists(Graph *g, const CpsiPattern *pattern) {
    const int n = g->n;
    for (int j = 0; j < n; j++)
        for (size_t e = pattern->start[j]; e < pattern->start[j + 1]; e++)
            if (pattern->index[e] != j) {
                g->length[j]++;
                g->length[pattern->index[e]]++;
            }
    const double most = fmax(LEAST_HUB, HUB * sqrt(n));
    int last = n;
    for (int j = 0; j < n; j++)
        if (g->length[j] > most) {
            g->state[j] = GONE;
            g->order[--last] = j;
        }
    for (int j = 0; j < n; j++) {
        g->at[j] = g->used;
        g->used += g->state[j] == VARIABLE ? (size_t)g->length[j] : 0;
        g->length[j] = 0;
    }
    for (int j = 0; j < n; j++)
        for (size_t e = pattern->start[j]; e < pattern->start[j + 1]; e++) {
            const int i = pattern->index[e];
            if (i == j || g->state[i] != VARIABLE || g->state[j] != VARIABLE) continue;
            g->list[g->at[i] + (size_t)g->length[i]++] = j;
            g->list[g->at[j] + (size_t)g->length[j]++] = i;
        }
    for (int j = 0; j < n; j++)
        if (g->state[j] == VARIABLE) put(g, j, g->length[j]);
}

/* Pack the lists that are still in use. */
static void pack(Graph *g) {
    size_t used = 0;
    for (int i = 0; i < g->n; i++) {
        if (g->state[i] == GONE) continue;
        memcpy(&g->spare[used], &g->list[g->at[i]], (size_t)g->length[i] * sizeof *g->list);
        g->at[i] = used;
        used += (size_t)g->length[i];
    }
    int *old = g->list;
    g->list = g->spare;
    g->spare = old;
    g->used = used;
}

/* ---- one elimination ---- */

static void join(Graph *g, const int *list, int count) {
    for (int k = 0; k < count; k++) {
        const int i = list[k];
        if (g->mark[i] == g->stamp || g->state[i] != VARIABLE) continue;
        g->mark[i] = g->stamp;
        take(g, i);
        g->list[g->used++] = i;
    }
}

/* L_p: the neighbours of p, those on its list and the members of its elements, which p absorbs. */
static void make_element(Graph *g, int p) {
    const size_t begin = g->used;
    const int *list = &g->list[g->at[p]];
    g->mark[p] = ++g->stamp;
    join(g, list + g->elements[p], g->length[p] - g->elements[p]);
    for (int k = 0; k < g->elements[p]; k++) {
        const int e = list[k];
        if (g->state[e] != ELEMENT) continue;
        join(g, &g->list[g->at[e]], g->length[e]);
        g->state[e] = GONE;
    }
    g->state[p] = ELEMENT;
    g->at[p] = begin;
    g->length[p] = (int)(g->used - begin);
}

/* |L_e minus L_p| for every element that has members in L_p */
static void count_outside(Graph *g, const int *member, int count) {
    for (int k = 0; k < count; k++) {
        const int i = member[k], *list = &g->list[g->at[i]];
        for (int j = 0; j < g->elements[i]; j++) {
            const int e = list[j];
            if (g->state[e] != ELEMENT) continue;
            if (g->seen[e] != g->stamp) {
                g->seen[e] = g->stamp;
                g->outside[e] = g->length[e];
            }
            g->outside[e]--;
        }
    }
}

/* Remove from the list of member i what p covers, and insert p. Returns the bound on the degree of
 * i outside L_p. */
static int prune(Graph *g, int i, int p) {
    int *list = &g->list[g->at[i]], kept = 0, degree = 0;
    const int elements = g->elements[i], length = g->length[i];
    for (int k = 0; k < elements; k++) {
        const int e = list[k];
        if (g->state[e] != ELEMENT) continue;
        if (g->outside[e] == 0) {
            g->state[e] = GONE;
            continue;
        }
        degree += g->outside[e];
        list[kept++] = e;
    }
    const int own = kept; /* where p is inserted */
    for (int k = elements; k < length; k++) {
        const int j = list[k];
        if (g->mark[j] == g->stamp || g->state[j] != VARIABLE) continue;
        list[kept++] = j;
        degree++;
    }
    /* i belongs to L_p by an edge to p or by an absorbed element, so at least one entry is free */
    if (kept > own) list[kept] = list[own];
    list[own] = p;
    g->elements[i] = own + 1;
    g->length[i] = kept + 1;
    return degree;
}

static void eliminate(Graph *g, int p) {
    take(g, p);
    g->order[g->ordered++] = p;
    if (g->capacity - g->used < (size_t)g->n) pack(g);
    make_element(g, p);
    int *member = &g->list[g->at[p]];
    const int count = g->length[p];
    count_outside(g, member, count);
    int left = 0;
    for (int k = 0; k < count; k++) {
        const int i = member[k], beyond = prune(g, i, p);
        /* i has no neighbours outside L_p, so it can be eliminated at once without fill */
        if (beyond == 0) {
            g->state[i] = GONE;
            g->order[g->ordered++] = i;
            continue;
        }
        g->degree[i] = beyond;
        member[left++] = i;
    }
    g->length[p] = left;
    g->used = g->at[p] + (size_t)left;
    if (left == 0) g->state[p] = GONE;
    for (int k = 0; k < left; k++) {
        const int bound = g->degree[member[k]] + left - 1, most = g->n - g->ordered - 1;
        put(g, member[k], bound < most ? bound : most);
    }
}

bool cpsi_sparse_order(const CpsiPattern *pattern, int *order) {
    Graph g = {.order = order};
    const size_t n = (size_t)pattern->n, neighbours = 2 * pattern->start[n];
    bool done = allocate(&g, pattern->n, neighbours + 2 * n + neighbours / 4);
    if (done) {
        lay_lists(&g, pattern);
        int variables = 0;
        for (int i = 0; i < g.n; i++) variables += g.state[i] == VARIABLE;
        while (g.ordered < variables) {
            while (g.first[g.least] < 0) g.least++;
            eliminate(&g, g.first[g.least]);
        }
    }
    release(&g);
    return done;
}
