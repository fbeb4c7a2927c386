/* SPDX-License-Identifier: BSD-3-Clause */
/* All SVG pictures of a run. */
#include "base/status.h"
#include "io/draw/run/run_picture.h"

static CpsStatus write_steps(CpsResults *results, const CpsiView *view, CpsError *err) {
    const char *kind = view->plan ? "plan" : "elevation";
    CpsStatus status = CPS_OK;
    FILE *out = NULL;
    for (int s = 0; s < results->snapshot_count && !status; ++s) {
        const CpsiSnapshot *snapshot = &results->snapshot[s];
        /* for a history that ended early the last step is drawn too */
        if (!cpsi_results_pictured(results, snapshot->step) &&
            snapshot->step != results->row_count - 1)
            continue;
        char name[64];
        snprintf(name, sizeof name, "step-%05d-%s.svg", snapshot->step, kind);
        status = cpsi_directory_create(results->directory, name, &out, err);
        if (status) return status;
        cpsi_picture_step(results, view, snapshot, out);
        status = cpsi_directory_close_file(results->directory, out, err);
    }
    if (status) return status;
    status = cpsi_directory_create(results->directory, view->plan ? "plan.svg" : "elevation.svg",
                                   &out, err);
    if (status) return status;
    cpsi_picture_steps(results, view, out);
    return cpsi_directory_close_file(results->directory, out, err);
}

/* The picture over the steps, of a history that has more than one. */
static CpsStatus write_over_steps(CpsResults *results, CpsError *err) {
    FILE *out = NULL;
    if (results->row_count < 2) return CPS_OK;
    CpsStatus status = cpsi_directory_create(results->directory, "history.svg", &out, err);
    if (status) return status;
    const bool whole = cpsi_picture_over_steps(results, out);
    status = cpsi_directory_close_file(results->directory, out, err);
    if (!status && !whole)
        status = cpsi_fail(err, CPS_ERR_MEMORY, "out of memory while drawing history.svg");
    return status;
}

CpsStatus cpsi_pictures_write(CpsResults *results, CpsError *err) {
    if (results->snapshot_count == 0) return CPS_OK;
    const CpsiView plan = cpsi_view_plan(results), elevation = cpsi_view_elevation(results);
    CpsStatus status = write_steps(results, &plan, err);
    if (!status) status = write_steps(results, &elevation, err);
    if (status) return status;

    FILE *out = NULL;
    if (cpsi_results_has_planes(results)) {
        status = cpsi_directory_create(results->directory, "planes.svg", &out, err);
        if (status) return status;
        cpsi_picture_planes(results, out);
        status = cpsi_directory_close_file(results->directory, out, err);
        if (status) return status;
    }
    status = cpsi_directory_create(results->directory, "tension.svg", &out, err);
    if (status) return status;
    cpsi_picture_tension(results, out);
    status = cpsi_directory_close_file(results->directory, out, err);
    if (!status) status = write_over_steps(results, err);
    return status ? status : cpsi_pictures_loops(results, err);
}
