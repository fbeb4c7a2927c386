/* SPDX-License-Identifier: BSD-3-Clause */
/* Tables and picture of offsets (capstan/offset.h). */
#include "capstan/offset.h"

#include <math.h>

#include "base/status.h"
#include "io/base/directory/file_set.h"
#include "io/base/text/columns.h"
#include "io/base/text/escape.h"
#include "io/draw/study/offset_picture.h"

enum { MAX_CURVES = 72 };

/* marks offsets that were initialised by the default function */
static const uint32_t COOKIE = 0x4f464653;

CpsOffsets cps_offsets_default(void) { return (CpsOffsets){.cookie = COOKIE}; }

static void curves_table(const void *what, FILE *out) {
    const CpsOffsets *offsets = what;
    fputs("heading,offset,certified,restoring,across,lines_x,lines_y,lines_z,lines_mx,lines_my,"
          "lines_mz,tension,line,utilisation\ndeg,m,1,N,N,N,N,N,N m,N m,N m,N,,1\n",
          out);
    for (int k = 0; k < offsets->curve_count; ++k)
        for (int i = 0; i < offsets->curve[k].count; ++i) {
            const CpsOffsetPlace *place = &offsets->curve[k].place[i];
            const double known = place->certified ? 0 : NAN;
            cpsi_write_csv_number(out, offsets->curve[k].heading);
            cpsi_csv_next(out, place->offset);
            fprintf(out, ",%d", place->certified);
            cpsi_csv_next(out, place->restoring + known);
            cpsi_csv_next(out, place->across + known);
            for (int a = 0; a < 6; ++a) cpsi_csv_next(out, place->lines[a] + known);
            cpsi_csv_next(out, place->tension + known);
            fputc(',', out);
            if (place->certified) cpsi_write_csv(out, offsets->line_name[place->tension_line]);
            cpsi_csv_next(out, place->utilisation > 0 ? place->utilisation + known : NAN);
            fputc('\n', out);
        }
}

static void cases_table(const void *what, FILE *out) {
    const CpsOffsets *offsets = what;
    fputs("missing,certified,x,y,z,from_x,from_y,from_z,heel,tension,line,utilisation,uplift\n"
          ",1,m,m,m,m,m,m,deg,N,,1,N\n",
          out);
    for (int k = 0; k < offsets->case_count; ++k) {
        const CpsOffsetCase *now = &offsets->outcome[k];
        const double known = now->certified ? 0 : NAN;
        if (now->missing) cpsi_write_csv(out, now->missing);
        fprintf(out, ",%d", now->certified);
        for (int a = 0; a < 3; ++a) cpsi_csv_next(out, now->position[a] + known);
        for (int a = 0; a < 3; ++a) cpsi_csv_next(out, now->from[a] + known);
        cpsi_csv_next(out, now->heel + known);
        cpsi_csv_next(out, now->tension + known);
        fputc(',', out);
        if (now->certified && now->tension_line) cpsi_write_csv(out, now->tension_line);
        cpsi_csv_next(out, now->utilisation > 0 ? now->utilisation + known : NAN);
        cpsi_csv_next(out, now->uplift + known);
        fputc('\n', out);
    }
}

static void picture(const void *what, FILE *out) { cpsi_picture_offsets(what, out); }

/* the summary, without its last brace */
static void summary(const void *what, FILE *out) {
    const CpsOffsets *offsets = what;
    fputs("{\n  \"title\": ", out);
    cpsi_write_json_string(out, offsets->title ? offsets->title : "");
    fputs(",\n  \"body\": ", out);
    cpsi_write_json_string(out, offsets->body);
    fprintf(out, ",\n  \"complete\": %s,\n  \"headings\": %d", offsets->complete ? "true" : "false",
            offsets->curve_count);
}

CpsStatus cps_offsets_write(const char *directory, const CpsOffsets *offsets, CpsError *err) {
    if (offsets && offsets->cookie != COOKIE)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "the offsets were not made by cps_offsets_default()");
    if (!directory || !offsets || !offsets->body || !offsets->line_name || !offsets->curve)
        return cpsi_fail(err, CPS_ERR_ARGUMENT,
                         "directory, offsets, body, names of lines or curves is NULL");
    if (offsets->curve_count < 1 || offsets->curve_count > MAX_CURVES)
        return cpsi_fail(err, CPS_ERR_ARGUMENT, "found %d headings, expected 1 to %d",
                         offsets->curve_count, (int)MAX_CURVES);
    const CpsiFile set[] = {{"offset.csv", curves_table, offsets},
                            {"offset.svg", picture, offsets},
                            {"broken.csv", cases_table, offsets}};
    const CpsiFile last = {"offset.json", summary, offsets};
    return cpsi_file_set_write(directory, set, offsets->case_count > 0 ? 3 : 2, &last, NULL, err);
}
