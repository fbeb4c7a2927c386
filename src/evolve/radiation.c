/* SPDX-License-Identifier: BSD-3-Clause */
/* Memory of radiation (radiation.h). */
#include "evolve/radiation.h"

#include <math.h>
#include <string.h>

#include "base/status.h"
#include "evolve/body_motion_check.h"
#include "evolve/ranges.h"

enum { SIX = CPS_BODY_DIRECTIONS, ENTRIES = SIX * SIX };
/* Times that differ by this share of the spacing are one; of a table, as it is written. */
static const double SAME = 1e-9, AS_WRITTEN = 1e-6;

/* ---- check ---- */

static double spacing_of(const CpsBody *body) {
    return body->radiation[body->radiation_count - 1].time / (body->radiation_count - 1);
}

static CpsStatus check_row(const CpsBody *body, int index, CpsError *err) {
    const CpsRadiation *row = &body->radiation[index];
    const double g = spacing_of(body);
    bool sound = true;
    for (int i = 0; i < ENTRIES; i++) sound = sound && cpsi_is_usable(row->kernel[i]);
    if (!sound || !(fabs(row->time - index * g) <= AS_WRITTEN * g))
        return CPSI_FAIL_AT("radiation", err, CPS_ERR_ARGUMENT,
                            "body '%s': radiation: row %d is at %.9g s, expected finite numbers, "
                            "and times 0, g, 2 g, .. of one spacing, here %.9g s",
                            body->name, index + 1, row->time, g);
    return CPS_OK;
}

CpsStatus cpsi_radiation_check(const CpsBody *body, CpsError *err) {
    const int count = body->radiation_count;
    CpsStatus status = CPS_OK;
    if (count < 0 || (count > 0 && !body->radiation) || count == 1)
        return CPSI_FAIL_AT("radiation", err, CPS_ERR_ARGUMENT,
                            "body '%s': radiation: found %d rows, expected 0, or 2 or more",
                            body->name, count);
    if (count == 0) return CPS_OK;
    if (count > CPS_MAX_RADIATION)
        return CPSI_FAIL_AT("radiation", err, CPS_ERR_LIMIT,
                            "body '%s': radiation: found %d rows, the limit is %d", body->name,
                            count, (int)CPS_MAX_RADIATION);
    if (!cpsi_is_positive(spacing_of(body)))
        return CPSI_FAIL_AT("radiation", err, CPS_ERR_ARGUMENT,
                            "body '%s': radiation: the last row is at %g s, expected a time > 0",
                            body->name, body->radiation[count - 1].time);
    for (int k = 0; k < count && status == CPS_OK; k++) status = check_row(body, k, err);
    if (status == CPS_OK && !cpsi_takes_energy(body->radiation[0].kernel))
        return CPSI_FAIL_AT("radiation", err, CPS_ERR_ARGUMENT,
                            "body '%s': radiation: the kernel at 0 s would drive some motion: its "
                            "symmetric part has a negative eigenvalue",
                            body->name);
    return status;
}

/* ---- data ---- */

size_t cpsi_radiation_size(const CpsBody *body) {
    return (ENTRIES + SIX) * (size_t)body->radiation_count;
}

CpsiRadiation cpsi_radiation_of(const CpsBody *body, double *numbers) {
    const int rows = body->radiation_count;
    if (rows == 0) return (CpsiRadiation){.rows = 0};
    for (int k = 0; k < rows; k++)
        memcpy(&numbers[ENTRIES * k], body->radiation[k].kernel, ENTRIES * sizeof *numbers);
    return (CpsiRadiation){.rows = rows,
                           .spacing = spacing_of(body),
                           .kernel = numbers,
                           .past = &numbers[ENTRIES * rows],
                           .kept = -1};
}

/* ---- the sum ---- */

/* How many of the times j g are before this one. */
static int64_t count_before(const CpsiRadiation *radiation, double time) {
    const double most = 4e15; /* integers up to there are numbers */
    return (int64_t)fmin(most, ceil(time / radiation->spacing - SAME));
}

/* The first of those times in the step under way, of which those after `next` are of use, whose
 * velocities are between those before and after it; and their share of the latter. */
static int64_t first_in_step(const CpsiRadiation *radiation, int64_t next) {
    const int64_t oldest = next - radiation->rows;
    return radiation->kept > oldest ? radiation->kept : oldest > 0 ? oldest : 0;
}
static double share_of(const CpsiRadiation *radiation, int64_t j) {
    const double share = ((double)j * radiation->spacing - radiation->from) / radiation->length;
    return fmin(fmax(share, 0), 1);
}

/* out += factor K u, K at the part of a spacing after row m. */
static void add_product(const CpsiRadiation *radiation, int64_t m, double part, double factor,
                        const double *u, double *out) {
    const double *k = &radiation->kernel[ENTRIES * m];
    for (int i = 0; i < SIX; i++)
        for (int j = 0; j < SIX; j++) {
            const double low = k[SIX * i + j], high = k[ENTRIES + SIX * i + j];
            out[i] += factor * (low + part * (high - low)) * u[j];
        }
}

void cpsi_radiation_begin(CpsiRadiation *radiation, double time, double length, const double *now) {
    const double g = radiation->spacing;
    if (radiation->rows == 0) return;
    radiation->from = time;
    radiation->length = length;
    if (radiation->kept < 0) {
        radiation->kept = count_before(radiation, time);
        memset(radiation->past, 0, SIX * (size_t)radiation->rows * sizeof *radiation->past);
    }
    const double after = time + length;
    const int64_t next = count_before(radiation, after), within = first_in_step(radiation, next);
    const double last = after - (double)(next - 1) * g, part = fmin(last / g, 1);
    memset(radiation->known, 0, sizeof radiation->known);
    for (int i = 0; i < ENTRIES; i++) radiation->direct[i] = 0.5 * last * radiation->kernel[i];
    for (int64_t m = 0; m + 1 < radiation->rows; m++) {
        const int64_t j = next - 1 - m;
        if (j < 0) break;
        /* half of the way to its neighbours; the history begins at 0 */
        const double weight = 0.5 * ((m == 0 ? last : g) + (j == 0 ? 0 : g));
        if (j < within) {
            const double *u = &radiation->past[SIX * (j % radiation->rows)];
            add_product(radiation, m, part, weight, u, radiation->known);
            continue;
        }
        const double share = share_of(radiation, j), *k = &radiation->kernel[ENTRIES * m];
        add_product(radiation, m, part, weight * (1 - share), now, radiation->known);
        for (int i = 0; i < ENTRIES; i++)
            radiation->direct[i] += weight * share * (k[i] + part * (k[ENTRIES + i] - k[i]));
    }
}

void cpsi_radiation_add(const CpsiRadiation *radiation, const double *u, double *f) {
    if (radiation->rows == 0) return;
    for (int i = 0; i < SIX; i++) {
        f[i] -= radiation->known[i];
        for (int k = 0; k < SIX; k++) f[i] -= radiation->direct[SIX * i + k] * u[k];
    }
}

void cpsi_radiation_advance(CpsiRadiation *radiation, const double *now, const double *next) {
    if (radiation->rows == 0) return;
    const int64_t after = count_before(radiation, radiation->from + radiation->length);
    for (int64_t j = first_in_step(radiation, after); j < after; j++) {
        const double share = share_of(radiation, j);
        double *u = &radiation->past[SIX * (j % radiation->rows)];
        for (int i = 0; i < SIX; i++) u[i] = now[i] + share * (next[i] - now[i]);
    }
    radiation->kept = after;
}

void cpsi_radiation_forget(CpsiRadiation *radiation) { radiation->kept = -1; }
