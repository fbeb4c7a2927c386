/* SPDX-License-Identifier: BSD-3-Clause */
/* capstan drive: planimeters, and blocks on a spring. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "drive/system_answer.h"
#include "law/set_answer.h"
#include "plot_file.h"
#include "progress.h"

/* ---- planimeter ---- */

typedef struct TraceDrawing {
    const CpsDriveFile *file;
    const CpsPlanimeterReading *reading;
} TraceDrawing;

static CpsStatus draw_trace(void *user, FILE *out, CpsError *err) {
    const TraceDrawing *d = user;
    return cps_drive_draw_planimeter(d->file, d->reading, out, err);
}

static void print_reading(const DriveRun *run, const CpsPlanimeterReading *r) {
    const CpsDrivePlanimeter *p = &run->file->planimeter;
    const double error = r->area - r->exact;
    if (run->json) {
        printf(", \"points\": %d, \"steps\": %d", p->point_count, p->step_count);
        drive_json("area_m2", r->area);
        drive_json("exact_m2", r->exact);
        drive_json("error_m2", error);
        drive_json("roll_m", r->roll);
        drive_json("side_slip_m", r->side_slip);
        drive_json("dissipated_J", r->dissipated);
        drive_json("pole_turns", r->pole_turns);
        drive_json("arm_turns", r->arm_turns);
        return;
    }
    printf("traced %d sides in %d step%s each, the pole %s\n", p->point_count, p->step_count,
           p->step_count == 1 ? "" : "s", r->pole_turns != 0 ? "inside" : "outside");
    printf("  wheel rolled %.10g m and slipped sideways %.6g m, which dissipated %.6g J\n", r->roll,
           r->side_slip, r->dissipated);
    printf("  area by the wheel  %.12g m2\n  area of the curve  %.12g m2\n  difference         "
           "%.3g m2",
           r->area, r->exact, error);
    if (r->exact != 0) printf(" (%.2g of it)", fabs(error / r->exact));
    puts("");
}

int drive_answer_planimeter(DriveRun *run) {
    const CpsDrivePlanimeter *p = &run->file->planimeter;
    CpsPlanimeterReading reading;
    if (cps_planimeter_trace(&p->planimeter, p->point_count, p->point, p->step_count, &reading,
                             &run->err) != CPS_OK)
        return cli_report(&run->err);
    print_reading(run, &reading);
    TraceDrawing drawing = {run->file, &reading};
    return run->options->plot ? cli_plot(draw_trace, &drawing, run->options->plot) : EXIT_OK;
}

/* ---- sweep ---- */

/* The history of a sweep; the first row is the start. */
typedef struct Sweep {
    const CpsDriveFile *file;
    int count, inaccurate;
    double *end, *position, *force; /* (count, space) */
    double stored;
    CpsSweep state;
} Sweep;

static bool go(DriveRun *run, Sweep *s) {
    const CpsDriveSweep *w = &run->file->sweep;
    const size_t n = (size_t)w->space;
    s->state = w->start;
    s->count = w->step_count + 1;
    s->end = calloc((size_t)s->count * n * 3, sizeof *s->end);
    if (!s->end) {
        run->err = (CpsError){.status = CPS_ERR_MEMORY, .message = "out of memory"};
        return false;
    }
    s->position = s->end + (size_t)s->count * n;
    s->force = s->position + (size_t)s->count * n;
    cps_drive_walk(w->space, w->point_count, w->path, s->count, s->end);
    memcpy(s->position, s->state.position, n * sizeof *s->position);
    for (size_t k = 0; k < n; k++)
        s->force[k] = s->state.stiffness * (s->state.position[k] - s->state.end[k]);
    Progress progress = progress_begin(w->step_count, run->options->quiet || w->step_count < 20000);
    bool good = true;
    for (size_t i = 1; i < (size_t)s->count && good; i++) {
        CpsSweepStep step;
        good = cps_sweep_step(w->law, &s->state, s->end + i * n, &step, &run->err) == CPS_OK;
        if (!good) break;
        s->inaccurate += step.outcome != CPS_SET_OUTCOME_ANSWERED;
        memcpy(s->position + i * n, s->state.position, n * sizeof *s->position);
        memcpy(s->force + i * n, step.force, n * sizeof *s->force);
        s->stored = step.stored;
        progress_step(&progress, (int)i, "sweep");
    }
    progress_end(&progress);
    return good;
}

static void print_sweep(DriveRun *run, const Sweep *s) {
    const int n = run->file->sweep.space;
    run->answered &= s->inaccurate == 0;
    if (run->json) {
        printf(", \"components\": %d, \"steps\": %d", n, s->count - 1);
        drive_json("work_J", s->state.work);
        drive_json("dissipated_J", s->state.dissipated);
        drive_json("stored_J", s->stored);
        printf(", \"inaccurate\": %d", s->inaccurate);
        drive_json_rows("end", n, s->count, s->end);
        drive_json_rows("position", n, s->count, s->position);
        drive_json_rows("force_N", n, s->count, s->force);
        return;
    }
    const size_t last = (size_t)(s->count - 1) * (size_t)n;
    printf("block on a spring, %d component%s, in %d steps: ends at ", n, n == 1 ? "" : "s",
           s->count - 1);
    law_print_vector(n, s->position + last);
    fputs(" m, force ", stdout);
    law_print_vector(n, s->force + last);
    printf(" N\n  dissipated %.10g J, work of the moved end %.10g J, in the spring %.10g J\n",
           s->state.dissipated, s->state.work, s->stored);
    if (s->inaccurate) printf("  note: %d steps are not certified\n", s->inaccurate);
}

static CpsStatus draw_sweep(void *user, FILE *out, CpsError *err) {
    const Sweep *s = user;
    return cps_drive_draw_sweep(s->file, s->count, s->end, s->position, s->force, out, err);
}

int drive_answer_sweep(DriveRun *run) {
    Sweep sweep = {.file = run->file};
    int code = EXIT_OK;
    if (go(run, &sweep))
        print_sweep(run, &sweep);
    else
        code = cli_report(&run->err);
    if (code == EXIT_OK && run->options->plot)
        code = cli_plot(draw_sweep, &sweep, run->options->plot);
    free(sweep.end);
    return code;
}
