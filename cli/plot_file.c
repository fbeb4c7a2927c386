/* SPDX-License-Identifier: BSD-3-Clause */
/* Pictures of laws as files (see plot_file.h). */
#include "plot_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

/* A picture that has been drawn, in memory: a program that is killed while it draws leaves no
 * file. */
typedef struct Drawn {
    char *text;
    size_t size;
} Drawn;

static CpsStatus put_drawn(void *user, FILE *out, CpsError *err) {
    const Drawn *drawn = user;
    (void)err;
    fwrite(drawn->text, 1, drawn->size, out);
    return CPS_OK;
}

/* Whether a file may be made in the folder of `path`. */
static bool has_place(const char *path) {
    char folder[4096];
    const char *slash = strrchr(path, '/');
    const size_t length = slash ? (size_t)(slash + 1 - path) : 0;
    if (length >= sizeof folder) return false;
    memcpy(folder, path, length);
    folder[length] = '\0';
    return access(length > 0 ? folder : ".", W_OK | X_OK) == 0;
}

static int out_of_memory(void) {
    fprintf(stderr, "capstan: out of memory\n");
    return EXIT_LIMIT;
}

int cli_plot(CpsFileWriter *draw, void *user, const char *path) {
    CpsError err;
    Drawn drawn = {0};
    fflush(stdout); /* the file may be standard output itself */
    /* Where no file can be made, that is found before the drawing, which may take long. */
    if (!has_place(path))
        return cps_write_file(path, draw, user, &err) == CPS_OK ? EXIT_OK : cli_report(&err);
    FILE *out = open_memstream(&drawn.text, &drawn.size);
    if (!out) return out_of_memory();
    CpsStatus status = draw(user, out, &err);
    const bool whole = fclose(out) == 0;
    if (status == CPS_OK && whole) status = cps_write_file(path, put_drawn, &drawn, &err);
    free(drawn.text);
    if (status != CPS_OK) return cli_report(&err);
    return whole ? EXIT_OK : out_of_memory();
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
