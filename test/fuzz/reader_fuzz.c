/* SPDX-License-Identifier: BSD-3-Clause */
/* Fuzzing a reader: any bytes give what the reader promises, or an error with a sentence. READER,
 * set when this is compiled, is one of
 *
 *     scene law drive     a file of that kind
 *     curve               the file that a planimeter names
 *     esri xyz netcdf moordyn_c moordyn_f    a file of ground in that form
 *     stl obj             a file of triangles in that form
 *     judge rows          a table to judge; rows that are asked of a law on standard input
 *     state journal       edits (place, 4 bytes) of a saved state and of a journal, whose checksums
 *                         are mended: what a checksum finds is no test; the states are those of
 *                         warm steps, and of a line of sections among others
 *
 * An input below 1 MiB that takes more than 2 s is a finding. It is the reader alone that is run,
 * with what it checks; of the states that it accepts one in 8192 takes a step as well. Files are in
 * memory, or in a directory in memory. scripts/fuzz runs it with libFuzzer or with mutate.c.
 * libfyaml leaks on some broken keys. */
#define _GNU_SOURCE /* memfd_create */
#include <fcntl.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "capstan/io.h"
#include "capstan/results.h"
#include "commands.h"
#include "law/law_query.h"
#include "study/study_solutions.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef enum Reader {
    scene,
    law,
    drive,
    curve,
    esri,
    xyz,
    netcdf,
    moordyn_c,
    moordyn_f,
    stl,
    obj,
    judge,
    rows,
    state,
    journal
} Reader;

static void must(bool holds) {
    if (!holds) abort();
}

/* as main.c, without a word */
int cli_report(const CpsError *err) { return err->status == CPS_OK ? EXIT_OK : EXIT_INPUT; }

static void write_all(int file, const void *data, size_t size) {
    must(ftruncate(file, (off_t)size) == 0 && pwrite(file, data, size, 0) == (ssize_t)size &&
         lseek(file, 0, SEEK_SET) == 0);
}

/* The bytes as a file without a name; the path to it. */
static const char *file_of(const uint8_t *data, size_t size) {
    static int file = -1;
    static char path[64];
    if (file < 0) file = memfd_create("input", MFD_CLOEXEC);
    must(file >= 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    write_all(file, data, size);
    return path;
}

/* A directory of this process, made once, and removed at its end. */
static char own_folder[64];

static void clear(void) {
    static const char *const NAME[] = {"drive.yaml",  "curve.csv", "law.yaml",  ".journal",
                                       "ground.yaml", "ground",    "mesh.yaml", "mesh"};
    char path[128];
    for (size_t i = 0; i < sizeof NAME / sizeof *NAME; ++i) {
        snprintf(path, sizeof path, "%s/%s", own_folder, NAME[i]);
        unlink(path);
    }
    rmdir(own_folder);
}

static const char *folder(void) {
    char *const path = own_folder;
    if (*path) return path;
    struct stat found;
    atexit(clear);
    snprintf(path, sizeof own_folder, "%s/capstan-fuzz-XXXXXX",
             stat("/dev/shm", &found) == 0 ? "/dev/shm" : "/tmp");
    must(mkdtemp(path) != NULL);
    return path;
}

static void put_file(const char *name, const void *data, size_t size) {
    char path[128];
    snprintf(path, sizeof path, "%s/%s", folder(), name);
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    must(file >= 0);
    write_all(file, data, size);
    close(file);
}

static void expect(CpsStatus status, const void *made, const CpsError *err) {
    must((status == CPS_OK) == (made != NULL));
    must(status == CPS_OK || (err->status == status && err->message[0]));
}

/* files of YAML -------------------------------------------------------------------------------- */

static void read_scene(const uint8_t *data, size_t size) {
    CpsSceneFile *file = NULL;
    CpsError err;
    const CpsStatus status = cps_scene_read(file_of(data, size), NULL, &file, &err);
    expect(status, file, &err);
    if (file) must(cps_scene_check(cps_scene_file_scene(file), NULL) == CPS_OK);
    cps_scene_file_destroy(file);
}

static void read_law(const uint8_t *data, size_t size) {
    CpsLawFile *file = NULL;
    CpsError err;
    const CpsStatus status = cps_law_read(file_of(data, size), NULL, &file, &err);
    expect(status, file, &err);
    cps_law_file_destroy(file);
}

static void read_drive(const char *path) {
    CpsDriveFile *file = NULL;
    CpsError err;
    const CpsStatus status = cps_drive_read(path, NULL, &file, &err);
    expect(status, file, &err);
    cps_drive_file_destroy(file);
}

static void read_curve(const uint8_t *data, size_t size) {
    static const char PLANIMETER[] =
        "capstan: 1\nplanimeter: {pole: [0, 0], pole_arm: 1, tracer_arm: 1.3, wheel: 0.4, "
        "friction: 0.2, load: 1, curve: {file: curve.csv}}\n";
    static char path[128];
    if (!*path) {
        snprintf(path, sizeof path, "%s/drive.yaml", folder());
        put_file("drive.yaml", PLANIMETER, sizeof PLANIMETER - 1);
    }
    put_file("curve.csv", data, size);
    read_drive(path);
}

/* A ground that is read has a height everywhere. */
static void ask_ground(const CpsGround *of) {
    const CpsGroundGrid grid = cps_ground_grid(of);
    for (int k = 0; k < 4; ++k) {
        double slope[2];
        const double x = grid.x[0] + k * (grid.x[grid.x_count - 1] - grid.x[0]) / 2,
                     y = grid.y[0] + k * (grid.y[grid.y_count - 1] - grid.y[0]) / 2;
        (void)cps_ground_height(of, x, y, slope);
    }
}

/* The scene whose obstacle is such a mapping, in a file of such a name; NULL where it is refused.
 */
static CpsSceneFile *read_obstacle(const char *name, const char *obstacle) {
    char path[128], text[512];
    CpsSceneFile *file = NULL;
    CpsError err = {0};
    const int length = snprintf(text, sizeof text,
                                "capstan: 1\nobstacles: {bed: {%s}}\nlines: {a: {length: 1, "
                                "elements: 1, mass: 1, stiffness: 1, "
                                "start: {straight: {from: [0, 0, 1e99], to: [1, 0, 1e99]}}, ends: "
                                "{A: held, B: held}}}\nhistory: []\n",
                                obstacle);
    put_file(name, text, (size_t)length);
    snprintf(path, sizeof path, "%s/%s", folder(), name);
    const CpsStatus status = cps_scene_read(path, NULL, &file, &err);
    expect(status, file, &err);
    return file;
}

static void read_ground(const char *form, const uint8_t *data, size_t size) {
    char obstacle[128];
    put_file("ground", data, size);
    snprintf(obstacle, sizeof obstacle, "ground: {file: ground, form: %s, extend: true}", form);
    CpsSceneFile *file = read_obstacle("ground.yaml", obstacle);
    if (file) ask_ground(cps_scene_file_scene(file)->obstacle[0].ground);
    cps_scene_file_destroy(file);
}

/* A mesh that is read has a distance everywhere, which at a corner is rounding of its extent. */
static void ask_mesh(const CpsMesh *of) {
    const CpsMeshTriangles triangles = cps_mesh_triangles(of);
    const CpsMeshReport report = cps_mesh_report(of);
    double extent = 0;
    for (int k = 0; k < 3; ++k)
        extent = fmax(extent, fmax(fabs(report.low[k]), fabs(report.high[k])));
    for (int i = 0; i < 3 * triangles.triangle_count && i < 24; ++i) {
        const double *at = &triangles.vertex[3 * (size_t)triangles.triangle[i]];
        must(fabs(cps_mesh_distance(of, at, NULL)) <= 1e-12 * extent);
        must(isfinite(cps_mesh_distance(of, (double[]){at[0] + 1, at[1], at[2]}, NULL)));
    }
}

static void read_mesh(const char *form, const uint8_t *data, size_t size) {
    char obstacle[128];
    put_file("mesh", data, size);
    snprintf(obstacle, sizeof obstacle,
             "mesh: {file: mesh, form: %s, radius: 1e40, two_sided: true}", form);
    CpsSceneFile *file = read_obstacle("mesh.yaml", obstacle);
    if (file) ask_mesh(cps_scene_file_scene(file)->obstacle[0].mesh);
    cps_scene_file_destroy(file);
}

/* tables --------------------------------------------------------------------------------------- */

/* A history that the tables and states are about: a line of sections with a clump, an inextensible
 * one, and one round a post. */
static const CpsScene *small_scene(void) {
    static const char TEXT[] =
        "capstan: 1\ntypes: {chain: {weight: 1, stiffness: 100}, wire: {weight: 0.5, stiffness: "
        "200, friction: 0.3}}\nobstacles: {bed: {plane: {normal: [0, 0, 1]}, friction: 0.5}, "
        "post: {cylinder: {point: [1, 1, 0], axis: [0, 0, 1], radius: 0.5}, friction: "
        "0.1}}\nlines:\n  rope: {sections: [{type: chain, length: 1, elements: 2}, {type: wire, "
        "length: 1, elements: 2}], point_weights: [{at: 1, weight: 0.5}], start: {straight: "
        "{from: [0, 0, 0], to: [2, 0, 0]}}, ends: {A: held, B: free}}\n  wire: {length: 1, "
        "elements: 2, weight: 1, stiffness: .inf, start: {straight: {from: [0, -1, 0], to: [1, "
        "-1, 0]}}, ends: {A: held, B: held}}\n  turn: {length: 1.6, elements: 6, weight: 0.1, "
        "stiffness: 1e3, start: {straight: {from: [0.2, 0.48, 0.5], to: [1.8, 0.48, 0.5]}}, "
        "ends: {A: held, B: {force: [2, 1, 0]}}}\nhistory: [{name: a, steps: 4, rope.B: {force: "
        "[1, 0.5, 0]}, turn.B: {force: [3, 1.5, 0]}}, {name: b, steps: 2, wire.B: {position: "
        "[0.9, -1, 0]}, rope.B: {force: [2, 1, 0]}, turn.B: {force: [3.5, 2, 0]}}]\n";
    static CpsSceneFile *file;
    if (!file)
        must(cps_scene_read(file_of((const uint8_t *)TEXT, sizeof TEXT - 1), NULL, &file, NULL) ==
             CPS_OK);
    return cps_scene_file_scene(file);
}

/* The steps WARM - 1 and WARM are warm, of the lines 0 and 2. */
enum { WARM = 3 };

static CpsEvolution *evolution_at(int steps) {
    CpsEvolution *evolution = NULL;
    must(cps_evolution_create(small_scene(), &evolution, NULL) == CPS_OK);
    while (steps-- > 0) must(cps_evolution_step(evolution, NULL) == CPS_OK);
    return evolution;
}

/* What is printed goes nowhere; libFuzzer does it by itself and prints on a copy of standard error.
 * Errors are buffered: written one by one, their characters would cost more than the readers. */
static void hush(void) {
    static bool hushed;
    if (hushed) return;
    if (!BY_LIBFUZZER) must(freopen("/dev/null", "w", stdout) && freopen("/dev/null", "w", stderr));
    must(setvbuf(stderr, NULL, _IOFBF, 1 << 16) == 0);
    hushed = true;
}

static void read_judge(const uint8_t *data, size_t size) {
    static CpsEvolution *evolution;
    if (!evolution) evolution = evolution_at(1);
    hush();
    const CpsLineView view = cps_evolution_line_view(evolution, 0);
    study_judge(&view, file_of(data, size), 1e-8, true);
}

/* Rows of two numbers on standard input; of others there are fewer. */
static void read_rows(const uint8_t *data, size_t size) {
    const CliList given = {.count = 1, .item = {"-"}};
    QueryList list = {.command = "law", .n = 2};
    hush();
    FILE *const before = stdin;
    stdin = fmemopen((void *)(uintptr_t)data, size, "r");
    must(stdin != NULL);
    const int code = law_query_read(&given, "force", &list);
    must(code == EXIT_OK ? list.count > 0 : code == EXIT_INPUT);
    for (int i = 0; i < 2 * list.count; ++i) must(fabs(list.row[i]) <= 1e100);
    fclose(stdin);
    stdin = before;
    free(list.row);
}

/* states --------------------------------------------------------------------------------------- */

/* Places and values, six bytes each, counted from `first`. */
static void edit(unsigned char *bytes, size_t capacity, size_t first, const uint8_t *data,
                 size_t size) {
    for (; size >= 6; data += 6, size -= 6) {
        const size_t at = first + ((size_t)data[0] | (size_t)data[1] << 8) % (capacity - first - 3);
        memcpy(bytes + at, data + 2, 4);
    }
}

/* FNV-1a over 64-bit words, as in journal.c */
static uint64_t checksum(uint64_t hash, const unsigned char *byte, size_t size) {
    for (size_t i = 0; i < size; i += 8) {
        uint64_t word = 0;
        memcpy(&word, byte + i, size - i < 8 ? size - i : 8);
        hash = (hash ^ word) * 1099511628211u;
    }
    return hash;
}

static const uint64_t CHECKSUM_BEGINS = 14695981039346656037u;

/* Does this input take a step?  The same one always does. */
static bool steps_on(const uint8_t *data, size_t size) {
    return (checksum(CHECKSUM_BEGINS, data, size) >> 32) % 8192 == 0;
}

/* Everything that a step or a writer would look at; then perhaps a step from there. */
static void go_on(CpsEvolution *evolution, bool step) {
    const CpsScene *of = small_scene();
    double sum = 0;
    for (int i = 0; i < cps_evolution_line_count(evolution); ++i) {
        const CpsLineView view = cps_evolution_line_view(evolution, i);
        const CpsLineReport report = cps_evolution_line_report(evolution, i);
        must(cps_outcome_name(report.outcome)[0] && report.bend.obstacle < of->obstacle_count &&
             report.pierced_obstacle < of->obstacle_count);
        for (int j = 0; j < 3 * (view.element_count + 1); ++j) sum += view.position[j];
        if (view.obstacle)
            for (int c = 0; c < view.contact_count * (view.element_count + 1); ++c)
                must(view.obstacle[c] < of->obstacle_count &&
                     view.state[c] <= CPS_NODE_STATE_UNRESOLVED);
    }
    must(isfinite(sum) || isinf(sum));
    if (step && cps_evolution_remaining_count(evolution) > 0)
        (void)cps_evolution_step(evolution, NULL);
}

/* magic, size, fingerprint and the hashes of the history and its past, which are compared */
enum { STATE_HEAD = 40 };

static void read_state(const uint8_t *data, size_t size) {
    static CpsEvolution *saved, *loaded;
    static unsigned char *good, *bytes;
    static size_t capacity;
    if (!saved) {
        saved = evolution_at(WARM);
        must(cps_evolution_line_report(saved, 0).warm_count > 0 &&
             cps_evolution_line_report(saved, 2).warm_count > 0);
        loaded = evolution_at(0);
        capacity = cps_evolution_state_size(saved);
        good = malloc(capacity);
        bytes = malloc(capacity);
        must(good && bytes);
        cps_evolution_save(saved, good);
    }
    memcpy(bytes, good, capacity);
    edit(bytes, capacity, STATE_HEAD, data, size);
    CpsError err;
    const CpsStatus status = cps_evolution_load(loaded, bytes, capacity, &err);
    must(status == CPS_OK || err.message[0]);
    if (status == CPS_OK) go_on(loaded, steps_on(data, size));
}

enum { JOURNAL_HEAD = 104, RECORD_HEAD = 16, RECORDS = WARM };

/* What a journal is edited from, and an evolution that is put back to its start each time. */
typedef struct Journaled {
    CpsEvolution *evolution;
    unsigned char *start, *good,
        *bytes; /* its state at the start; a journal of RECORDS steps; that one, edited */
    size_t state, record, capacity;
} Journaled;

static Journaled make_journaled(void) {
    Journaled made = {.evolution = evolution_at(0)};
    CpsJournal *written = NULL;
    char path[128];
    snprintf(path, sizeof path, "%s/.journal", folder());
    made.state = cps_evolution_state_size(made.evolution);
    made.record = RECORD_HEAD + made.state;
    made.capacity = JOURNAL_HEAD + RECORDS * made.record;
    made.start = malloc(made.state);
    made.good = malloc(made.capacity);
    made.bytes = malloc(made.capacity);
    must(made.start && made.good && made.bytes);
    cps_evolution_save(made.evolution, made.start);
    must(cps_journal_open(folder(), made.evolution, CPS_JOURNAL_NEW, &written, NULL) == CPS_OK);
    for (int i = 0; i < RECORDS; ++i)
        must(cps_evolution_step(made.evolution, NULL) == CPS_OK &&
             cps_journal_append(written, made.evolution, NULL) == CPS_OK);
    const int file = open(path, O_RDONLY | O_CLOEXEC);
    must(file >= 0 && pread(file, made.good, made.capacity, 0) == (ssize_t)made.capacity);
    close(file);
    cps_journal_destroy(written);
    return made;
}

/* The checksums of head and records, made to fit. */
static void mend(const Journaled *made) {
    const uint64_t head = checksum(CHECKSUM_BEGINS, made->bytes, JOURNAL_HEAD - 8);
    memcpy(made->bytes + JOURNAL_HEAD - 8, &head, sizeof head);
    for (int i = 0; i < RECORDS; ++i) {
        unsigned char *at = made->bytes + JOURNAL_HEAD + (size_t)i * made->record;
        const uint64_t sum =
            checksum(checksum(CHECKSUM_BEGINS, at, 8), at + RECORD_HEAD, made->state);
        memcpy(at + 8, &sum, sizeof sum);
    }
}

/* An odd first byte: the checksums fit what has been edited; of the even ones each second journal
 * is cut short. */
static void read_journal(const uint8_t *data, size_t size) {
    static Journaled made;
    if (!made.good) made = make_journaled();
    must(cps_evolution_load(made.evolution, made.start, made.state, NULL) == CPS_OK);
    memcpy(made.bytes, made.good, made.capacity);
    if (size > 0) edit(made.bytes, made.capacity, 0, data + 1, size - 1);
    if (size > 0 && data[0] % 2 == 1) mend(&made);
    put_file(".journal", made.bytes,
             size > 0 && data[0] % 4 == 2 ? made.capacity / 256 * data[0] : made.capacity);
    CpsJournal *read = NULL;
    CpsError err;
    CpsStatus status = cps_journal_open(folder(), made.evolution, CPS_JOURNAL_RESUME, &read, &err);
    expect(status, read, &err);
    bool found = status == CPS_OK;
    while (found && (status = cps_journal_next(read, made.evolution, &found, &err)) == CPS_OK)
        if (found) go_on(made.evolution, false);
    must(status == CPS_OK || err.message[0]);
    if (status == CPS_OK && steps_on(data, size)) go_on(made.evolution, true);
    cps_journal_destroy(read);
}

static void run_reader(Reader reader, const uint8_t *data, size_t size) {
    switch (reader) {
    case scene: read_scene(data, size); break;
    case law: read_law(data, size); break;
    case drive: read_drive(file_of(data, size)); break;
    case curve: read_curve(data, size); break;
    case esri: read_ground("esri", data, size); break;
    case xyz: read_ground("xyz", data, size); break;
    case netcdf: read_ground("netcdf", data, size); break;
    case moordyn_c: read_ground("moordyn_c", data, size); break;
    case moordyn_f: read_ground("moordyn_f", data, size); break;
    case stl: read_mesh("stl", data, size); break;
    case obj: read_mesh("obj", data, size); break;
    case judge: read_judge(data, size); break;
    case rows: read_rows(data, size); break;
    case state: read_state(data, size); break;
    case journal: read_journal(data, size); break;
    }
}

static bool too_long(clock_t begun, size_t size) {
    return size < 1 << 20 && clock() - begun > 2 * CLOCKS_PER_SEC;
}

/* Time of the processor, not of a clock on the wall, which a busy machine stretches; that one is
 * cheaper to ask, and what was fast by it was fast. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    const time_t seen = time(NULL);
    run_reader(READER, data, size);
    if (time(NULL) - seen < 2) return 0;
    const clock_t begun = clock();
    run_reader(READER, data, size);
    must(!too_long(begun, size));
    return 0;
}
