/* SPDX-License-Identifier: BSD-3-Clause */
/* Pictures of laws as files (see plot_file.h): written under another name, synced, renamed. */
#include "plot_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "printable.h"

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

static int cannot_write(const char *path, int code) {
    cli_printf(stderr, "capstan: %s: cannot write: %s\n", path,
               code ? strerror(code) : "the write failed");
    return EXIT_IO;
}

/* Draw into an open file and close it; *code: errno of a failure, 0 after success. */
static CpsStatus draw_and_close(PlotDraw *draw, void *user, int fd, bool sync, int *code,
                                CpsError *err) {
    *code = 0;
    FILE *out = fdopen(fd, "w");
    if (!out) {
        *code = errno;
        close(fd);
        return CPS_OK;
    }
    errno = 0;
    const CpsStatus status = draw(user, out, err);
    const bool failed = ferror(out) != 0 || fflush(out) != 0 || (sync && fsync(fd) != 0);
    if (failed) *code = errno ? errno : EIO;
    if (fclose(out) != 0 && !failed) *code = errno;
    return status;
}

/* "folder/.name.PID.part" for "folder/name"; NULL when memory does not suffice */
static char *name_beside(const char *path) {
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t room = strlen(path) + 40;
    char *beside = malloc(room);
    if (beside)
        snprintf(beside, room, "%.*s.%s.%ld.part", (int)(name - path), path, name, (long)getpid());
    return beside;
}

static int plot_beside(PlotDraw *draw, void *user, const char *path) {
    char *beside = name_beside(path);
    if (!beside) {
        fprintf(stderr, "capstan: out of memory\n");
        return EXIT_LIMIT;
    }
    int code = 0;
    CpsError err;
    CpsStatus status = CPS_OK;
    const int fd = open(beside, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) {
        code = errno;
    } else {
        status = draw_and_close(draw, user, fd, true, &code, &err);
        if (status == CPS_OK && code == 0 && rename(beside, path) != 0) code = errno;
        if (status != CPS_OK || code != 0) unlink(beside);
    }
    free(beside);
    if (status != CPS_OK) return cli_report(&err);
    return code ? cannot_write(path, code) : EXIT_OK;
}

int cli_plot(PlotDraw *draw, void *user, const char *path) {
    struct stat found;
    const bool there = stat(path, &found) == 0;
    if (there && S_ISDIR(found.st_mode)) return cannot_write(path, EISDIR);
    if (!there || S_ISREG(found.st_mode)) return plot_beside(draw, user, path);

    /* a device or pipe, perhaps standard output itself */
    CpsError err;
    int code = 0;
    fflush(stdout);
    const int fd = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (fd < 0) return cannot_write(path, errno);
    const CpsStatus status = draw_and_close(draw, user, fd, false, &code, &err);
    if (status != CPS_OK) return cli_report(&err);
    return code ? cannot_write(path, code) : EXIT_OK;
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
