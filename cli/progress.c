/* SPDX-License-Identifier: BSD-3-Clause */
/* Progress of a run (see progress.h). */
#include "progress.h"

#include <stdint.h>
#include <time.h>
#include <unistd.h>

#include "printable.h"

enum { BAR_WIDTH = 30, SHORT_BAR = 10, NAME_WIDTH = 24, SHORT_TABLE = 40 };

/* smallest time between two drawings of the bar [s]; more frequent ones would only cost time */
static const double REDRAW = 0.05;

double cli_now(void) {
    struct timespec now = {0}; /* no time passes where there is no such clock */
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

bool cli_has_pace(const CpsScene *scene) {
    for (int i = 0; i < scene->stage_count; ++i)
        if (scene->stage[i].error > 0) return true;
    return false;
}

bool cli_is_shown(const CpsScene *scene, int steps, int index) {
    if (cli_has_pace(scene)) return index == 0 || index == steps - 1;
    if (steps <= SHORT_TABLE || index == 0 || index == steps - 1) return true;
    if (scene->stage_count > SHORT_TABLE) return index % (steps / SHORT_TABLE + 1) == 0;
    int64_t end = steps - 1;
    for (int i = scene->stage_count - 1; i >= 0 && end >= index; --i) {
        if (end == index) return true;
        end -= scene->stage[i].step_count;
    }
    return false;
}

Progress progress_begin(int steps, bool quiet) {
    return (Progress){.quiet = quiet,
                      .terminal = isatty(STDERR_FILENO) == 1,
                      .steps = steps,
                      .begun = cli_now()};
}

void progress_in_time(Progress *progress, double end) { progress->end = end; }

void progress_time(Progress *progress, double time) {
    if (time > progress->time) progress->interval = time - progress->time;
    progress->time = time;
}

void progress_computes(Progress *progress, int known) {
    progress->known = known;
    progress->computing = cli_now();
}

/* [s] until all steps are done; negative: not known */
static double remaining(const Progress *progress, int done, double now) {
    if (!(progress->computing > 0) || done <= progress->known) return -1;
    return (now - progress->computing) / (done - progress->known) * (progress->steps - done);
}

/* "t = 12 of 600 s, h = 0.5 s, about 30 s remain", each as far as it is known */
static void print_times(const Progress *progress, int done, double now) {
    fprintf(stderr, "t = %.6g of %.6g s", progress->time, progress->end);
    if (progress->interval > 0) fprintf(stderr, ", h = %.4g s", progress->interval);
    const double rest = remaining(progress, done, now);
    if (rest >= 0) fprintf(stderr, ", about %.*f s remain", rest < 10 ? 1 : 0, rest);
}

/* With times a short bar and no name, so that a line of 80 characters holds them. */
static void draw_bar(const Progress *progress, int done, const char *name, double now) {
    const bool in_time = progress->end > 0;
    const int width = in_time ? SHORT_BAR : BAR_WIDTH;
    const int full = (int)((int64_t)width * done / progress->steps);
    fputs("\r[", stderr);
    for (int i = 0; i < width; ++i) fputc(i < full ? '#' : '.', stderr);
    fprintf(stderr, "] %d/%d  %.1f s  ", done, progress->steps, now - progress->begun);
    if (in_time) {
        print_times(progress, done, now);
        fputs("\033[K", stderr); /* the times before may have been longer */
    } else {
        cli_print_text(stderr, name, NAME_WIDTH, true);
    }
    fflush(stderr);
}

void progress_step(Progress *progress, int done, const char *name) {
    if (progress->quiet || progress->steps < 1) return;
    const double now = cli_now();
    if (progress->terminal) {
        if (now - progress->drawn < REDRAW && done < progress->steps) return;
        progress->drawn = now;
        draw_bar(progress, done, name, now);
        return;
    }
    const int tenths = (int)((int64_t)10 * done / progress->steps);
    if (tenths == progress->tenths) return;
    progress->tenths = tenths;
    fprintf(stderr, "step %d of %d, %.1f s", done, progress->steps, now - progress->begun);
    if (progress->end > 0) {
        fputs(", ", stderr);
        print_times(progress, done, now);
    }
    fputs(": ", stderr);
    cli_print_text(stderr, name, 80, false);
    fputc('\n', stderr);
}

void progress_end(Progress *progress) {
    if (progress->quiet || !progress->terminal) return;
    fputs("\r\033[K", stderr);
    fflush(stderr);
}
