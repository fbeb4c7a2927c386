/* SPDX-License-Identifier: BSD-3-Clause */
/* Ends that were let go and lines that part (failure.h). */
#include "failure.h"

#include <math.h>
#include <netcdf.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Shares so near to each other, or to 1, are equal: a file has tensions to rounding. */
static const double EQUAL = 1e-9;

static bool has(const Source *source, const char *name, int *variable) {
    return nc_inq_varid(source->nc, name, variable) == NC_NOERR;
}

static int complain(FILE *log, const char *what, const char *name) {
    if (log) fprintf(log, "%s: %s\n", name, what);
    return -1;
}

static int read(const Source *source, const char *name, const size_t *start, const size_t *count,
                double *value, FILE *log) {
    int variable;
    if (!has(source, name, &variable)) return complain(log, "missing", name);
    const int status = nc_get_vara_double(source->nc, variable, start, count, value);
    return status == NC_NOERR ? 0 : complain(log, nc_strerror(status), name);
}

int failures_open(Source *source, FILE *log) {
    const size_t n = source->steps, start = 0;
    int variable;
    if (!has(source, "break_line", &variable) || n == 0) return 0;
    source->break_line = calloc(n, sizeof *source->break_line);
    source->break_end = calloc(n, sizeof *source->break_end);
    source->break_tension = calloc(n, sizeof *source->break_tension);
    if (!source->break_line || !source->break_end || !source->break_tension)
        return complain(log, "out of memory", "break_line");
    if (read(source, "break_line", &start, &n, source->break_line, log) ||
        read(source, "break_end", &start, &n, source->break_end, log) ||
        read(source, "break_tension", &start, &n, source->break_tension, log))
        return -1;
    for (size_t i = 0; i < n; i++) {
        const double line = source->break_line[i], end = source->break_end[i];
        const bool none = line == -1 && end == -1 && isnan(source->break_tension[i]),
                   some = line >= 0 && line < (double)source->lines && line == floor(line) &&
                          (end == 0 || end == 1) && source->break_tension[i] > 0;
        if (!none && !some) return complain(log, "no line, end or tension", "break_line");
    }
    return 0;
}

void failures_close(const Source *source) {
    free(source->break_line);
    free(source->break_end);
    free(source->break_tension);
}

/* A tension of each element, in `out`; NULL where the file has none. */
static int read_tensions(const Source *source, const char *line, const char *what, size_t n,
                         double **out, FILE *log) {
    char name[400];
    int variable;
    const size_t start = 0;
    snprintf(name, sizeof name, "%s_%s", line, what);
    if (!has(source, name, &variable)) return 0;
    *out = calloc(n, sizeof **out);
    if (!*out) return complain(log, "out of memory", name);
    if (read(source, name, &start, &n, *out, log)) return -1;
    for (size_t i = 0; i < n; i++)
        if (!((*out)[i] > 0)) return complain(log, "senseless tension", name);
    return 0;
}

int failure_create(const Source *source, const char *line, Record *record, FILE *log) {
    const size_t n = record->elements;
    if (read_tensions(source, line, "breaking_load", n, &record->breaking_load, log)) return -1;
    if (!source->break_line) return 0;
    return read_tensions(source, line, "break_at", n, &record->break_at, log);
}

int failure_read(const Source *source, const char *line, size_t step, Record *record, FILE *log) {
    const size_t start[] = {step, 0}, count[] = {1, 2};
    double release[2] = {RELEASE_NONE, RELEASE_NONE};
    char name[400];
    snprintf(name, sizeof name, "%s_end_release", line);
    if (source->break_line && read(source, name, start, count, release, log)) return -1;
    for (int e = 0; e < 2; e++) {
        if (release[e] != RELEASE_NONE && release[e] != RELEASE_STAGE &&
            release[e] != RELEASE_BREAK && release[e] != RELEASE_TAKEN)
            return complain(log, "unknown way of letting go", name);
        record->release[e] = (int)release[e];
        record->end_point[e] = record->release[e] == RELEASE_NONE ? record->given_point[e] : -1;
    }
    return 0;
}

double failure_share(const Record *r) {
    double most = 0;
    if (!r->break_at) return 0;
    for (size_t i = 0; i < r->elements; i++) most = fmax(most, r->tension[i] / r->break_at[i]);
    most = fmax(most, r->end_tension[0] / r->break_at[0]);
    return fmax(most, r->end_tension[1] / r->break_at[r->elements - 1]);
}

static bool is_end_loaded(const Record *r, int e) {
    const double *f = r->applied_force[e];
    return r->end_kind[e] == END_HELD || f[0] != 0 || f[1] != 0 || f[2] != 0;
}

bool failure_is_loaded(const Record *r) { return is_end_loaded(r, 0) || is_end_loaded(r, 1); }

/* ---- steps ---- */

typedef struct Failures {
    const Source *source;
    Record *now, *before; /* (lines) */
    size_t step;
    FailureFinding *find;
    void *user;
} Failures;

__attribute__((format(printf, 3, 4))) static void find(const Failures *f, size_t line,
                                                       const char *format, ...) {
    char sentence[240];
    va_list list;
    va_start(list, format);
    vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    f->find(f->user, f->source->line_name[line], f->step, sentence);
}

/* The largest share in the step before, of the lines that can be let go; and of which. */
static double largest_before(const Failures *f, size_t *line) {
    double most = 0;
    for (size_t i = 0; i < f->source->lines; i++) {
        const double own = failure_is_loaded(&f->before[i]) ? failure_share(&f->before[i]) : 0;
        if (own > most) *line = i;
        most = fmax(most, own);
    }
    return most;
}

/* Does the line reach its largest share nearer to this end than to the other, with this tension? */
static bool parts_there(const Record *r, int e, double tension) {
    const double most = failure_share(r) * (1 - EQUAL);
    const size_t last = r->elements - 1;
    double arc = 0, length = 0;
    for (size_t i = 0; i < r->elements; i++) length += r->element_length[i];
    const double at_end[2] = {r->end_tension[0] / r->break_at[0],
                              r->end_tension[1] / r->break_at[last]};
    for (int k = 0; k < 2; k++)
        if (at_end[k] >= most && fabs(r->end_tension[k] - tension) <= EQUAL * tension &&
            (k == e || !is_end_loaded(r, k)))
            return true;
    for (size_t i = 0; i < r->elements; arc += r->element_length[i++]) {
        const double middle = arc + r->element_length[i] / 2;
        const int nearest = middle < length / 2 * (1 - EQUAL)   ? 0
                            : middle > length / 2 * (1 + EQUAL) ? 1
                                                                : e;
        if (r->tension[i] / r->break_at[i] >= most &&
            fabs(r->tension[i] - tension) <= EQUAL * tension &&
            (nearest == e || !is_end_loaded(r, nearest)))
            return true;
    }
    return false;
}

static void check_break(const Failures *f) {
    const size_t line = (size_t)f->source->break_line[f->step];
    const int end = (int)f->source->break_end[f->step];
    size_t worst = 0;
    if (f->step == 0) {
        find(f, line, "it parts before anything was found");
        return;
    }
    const Record *was = &f->before[line];
    const double own = failure_share(was), most = largest_before(f, &worst);
    if (!(own > 1 - EQUAL))
        find(f, line, "it parts, but was at %.9g of its break_at in the step before", own);
    else if (!(own >= most * (1 - 2 * EQUAL)))
        find(f, line, "it parts at %.9g of its break_at, but line %s was at %.9g", own,
             f->source->line_name[worst], most);
    else if (!parts_there(was, end, f->source->break_tension[f->step]))
        find(f, line, "it parts at end %c with %.9g N, which is not where it was nearest to",
             end ? 'B' : 'A', f->source->break_tension[f->step]);
    if (!is_end_loaded(was, end)) find(f, line, "it parts at an end that nothing holds");
    if (f->now[line].release[end] != RELEASE_BREAK)
        find(f, line, "it parts, but end_release of that end does not say so");
}

/* What is imposed on an end that a break leaves alone is what was. */
static bool is_left_alone(const Record *r, const Record *before, int e) {
    const bool at_point = r->end_point[e] >= 0; /* which may move, being free or on a body */
    return r->end_kind[e] == before->end_kind[e] &&
           (at_point || r->end_kind[e] == END_FREE ||
            memcmp(r->held_position[e], before->held_position[e], sizeof(Vector)) == 0) &&
           (r->end_kind[e] == END_HELD ||
            memcmp(r->applied_force[e], before->applied_force[e], sizeof(Vector)) == 0);
}

static void check_ends(const Failures *f) {
    const Source *source = f->source;
    const bool breaks = is_break(source, f->step);
    for (size_t i = 0; i < source->lines; i++)
        for (int e = 0; e < 2; e++) {
            const Record *r = &f->now[i], *before = &f->before[i];
            const int was = f->step > 0 ? before->release[e] : RELEASE_NONE;
            const bool own = breaks && (size_t)source->break_line[f->step] == i &&
                             (int)source->break_end[f->step] == e;
            const double *force = r->applied_force[e];
            /* what is not certified is left as it was before */
            const bool let_go = r->outcome <= OUTCOME_TAUT &&
                                (r->release[e] == RELEASE_STAGE || r->release[e] == RELEASE_BREAK);
            if (r->release[e] == RELEASE_BREAK && was != RELEASE_BREAK && !own)
                find(f, i, "end %c has parted, but the step is no break of it", e ? 'B' : 'A');
            if (r->release[e] == RELEASE_NONE && was != RELEASE_NONE)
                find(f, i, "end %c was let go, and is again as if it had not been", e ? 'B' : 'A');
            if (let_go &&
                (r->end_kind[e] != END_FREE || force[0] != 0 || force[1] != 0 || force[2] != 0))
                find(f, i, "end %c was let go, but something acts on it", e ? 'B' : 'A');
            if (breaks && !own && f->step > 0 &&
                (r->release[e] != was || !is_left_alone(r, before, e)))
                find(f, i, "end %c changes in a step in which a line parts", e ? 'B' : 'A');
        }
    if (!breaks) return;
    for (size_t k = 0; k < source->surfaces; k++)
        if (f->now[0].turn[k] != 0) find(f, 0, "an obstacle turns in a step in which a line parts");
}

/* A step that is certified and leaves a line above its break_at is followed by a break. */
static void check_whole(const Failures *f, const double *outcome) {
    size_t worst = 0;
    if (f->step == 0 || is_break(f->source, f->step) || outcome[f->step - 1] > OUTCOME_TAUT) return;
    const double most = largest_before(f, &worst);
    if (most > 1 + EQUAL)
        find(f, worst, "it was at %.9g of its break_at in the step before, and does not part",
             most);
}

static int check_steps(Failures *f, const double *outcome, FILE *log) {
    const Source *source = f->source;
    for (f->step = 0; f->step < source->steps; f->step++) {
        for (size_t i = 0; i < source->lines; i++)
            if (record_read(source, source->line_name[i], f->step, &f->now[i], log)) return -1;
        if (is_break(source, f->step)) check_break(f);
        check_ends(f);
        check_whole(f, outcome);
        Record *swap = f->before;
        f->before = f->now;
        f->now = swap;
    }
    return 0;
}

int failures_check(const Source *source, FailureFinding *finding, void *user, FILE *log) {
    const size_t n = source->lines, start = 0;
    if (!source->break_line) return 0;
    Failures f = {.source = source,
                  .now = calloc(n, sizeof *f.now),
                  .before = calloc(n, sizeof *f.before),
                  .find = finding,
                  .user = user};
    double *outcome = calloc(source->steps, sizeof *outcome);
    int bad = f.now && f.before && outcome ? 0 : complain(log, "out of memory", "break_line");
    if (!bad) bad = read(source, "outcome", &start, &source->steps, outcome, log);
    for (size_t i = 0; i < n && !bad; i++)
        bad = record_create(source, source->line_name[i], &f.now[i], log) ||
              record_create(source, source->line_name[i], &f.before[i], log);
    if (!bad) bad = check_steps(&f, outcome, log);
    for (size_t i = 0; i < n; i++) {
        if (f.now) record_destroy(&f.now[i]);
        if (f.before) record_destroy(&f.before[i]);
    }
    free(f.now);
    free(f.before);
    free(outcome);
    return bad ? -1 : 0;
}
