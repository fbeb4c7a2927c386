/* SPDX-License-Identifier: BSD-3-Clause */
/* Pictures of laws as files (see plot_file.h). */
#include "plot_file.h"

#include <stdio.h>

#include "commands.h"

bool law_plot_axes(const char *text, int n, int axis[2]) {
    char end;
    if (n == 1 && !text) { /* there is only one choice */
        axis[0] = axis[1] = 0;
        return true;
    }
    axis[0] = 1;
    axis[1] = 2;
    if (text && sscanf(text, "%4d,%4d%c", &axis[0], &axis[1], &end) != 2) return false;
    axis[0]--;
    axis[1]--;
    return axis[0] >= 0 && axis[0] < n && axis[1] >= 0 && axis[1] < n && axis[0] != axis[1];
}

int cli_plot(CpsFileWriter *draw, void *user, const char *path) {
    CpsError err;
    fflush(stdout); /* the file may be standard output itself */
    return cps_write_file(path, draw, user, &err) == CPS_OK ? EXIT_OK : cli_report(&err);
}

typedef struct LawDrawing {
    const CpsSet *set;
    const CpsResistance *resistance; /* used where there is no set */
    const CpsLawPicture *picture;
} LawDrawing;

static CpsStatus draw_law(void *user, FILE *out, CpsError *err) {
    const LawDrawing *drawing = user;
    if (!drawing->set) return cps_resistance_draw(drawing->resistance, drawing->picture, out, err);
    return cps_law_draw(drawing->set, drawing->picture, out, err);
}

int law_plot(const CpsSet *set, const CpsResistance *resistance, const CpsLawPicture *picture,
             const char *path) {
    LawDrawing drawing = {set, resistance, picture};
    return cli_plot(draw_law, &drawing, path);
}
