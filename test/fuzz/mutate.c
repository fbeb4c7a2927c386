/* SPDX-License-Identifier: BSD-3-Clause */
/* A fuzzer for systems without libFuzzer: mutates the given files and passes them to the reader
 * that it is linked with.
 *
 *     mutate SECONDS SEED FINDING [FILE..]
 *
 * It does not measure coverage. Its inputs are cuts, copies, splices, bit flips, words of YAML and
 * CSV inserted into the given text, and words repeated up to 1 MiB. An input that crashes the
 * reader, or takes more than 2 s of processor time, is written to FINDING, and the exit code is not
 * 0. */
#define _POSIX_C_SOURCE 200809L
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { SPACE = (1 << 20) - 1, MOST_OF_A_FILE = 1 << 15, FILES = 512, SLOW_SECONDS = 2 };

static uint8_t input[SPACE];
static size_t length;
static const char *finding;
static uint64_t chance;

static uint64_t next(void) { /* xorshift64* */
    chance ^= chance >> 12;
    chance ^= chance << 25;
    chance ^= chance >> 27;
    return chance * 2685821657736338717u;
}

static size_t below(size_t n) { return n ? (size_t)(next() % n) : 0; }

/* Only calls that a handler may make. */
static void keep(int number) {
    const int file = open(finding, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (file < 0 || write(file, input, length) < 0) _exit(3);
    _exit(number == SIGVTALRM ? 4 : 5);
}

static void put(size_t at, const void *bytes, size_t count) {
    if (length + count > SPACE || at > length) return;
    memmove(input + at + count, input + at, length - at);
    memcpy(input + at, bytes, count);
    length += count;
}

static const char *const WORD[] = {":",
                                   "- ",
                                   "[",
                                   "]",
                                   "{",
                                   "}",
                                   ",",
                                   "\n",
                                   "\n  ",
                                   " ",
                                   "'",
                                   "\"",
                                   "#",
                                   "%",
                                   "|\n",
                                   ">\n",
                                   "&a",
                                   "*a",
                                   "!",
                                   "?",
                                   "\t",
                                   "\r",
                                   "---\n",
                                   "...\n",
                                   ".inf",
                                   "-.inf",
                                   ".nan",
                                   "1e308",
                                   "-1",
                                   "0",
                                   "1e-320",
                                   "99999999999",
                                   "0x7fffffff",
                                   "null",
                                   "true",
                                   "~",
                                   "\\",
                                   "\\x1b",
                                   "\xef\xbb\xbf",
                                   "\xc2\x85",
                                   "\xff",
                                   "\x01",
                                   "held",
                                   "free",
                                   "../",
                                   "/",
                                   "-"};

/* One to three words over and over, behind some of what is there: what takes more than linear time
 * shows. */
static void repeat(void) {
    const char *word[3];
    const size_t words = 1 + below(3), space = below(SPACE - 100);
    for (size_t i = 0; i < words; ++i) word[i] = WORD[below(sizeof WORD / sizeof *WORD)];
    length = below(length + 1);
    for (size_t i = 0; length < space; ++i) put(length, word[i % words], strlen(word[i % words]));
}

static void mutate(uint8_t *const *file, const size_t *size, int files) {
    const size_t at = below(length + 1), more = below(16) ? below(8) : below(400);
    uint8_t byte = (uint8_t)next();
    switch (below(8)) {
    case 0:
        if (at < length) input[at] ^= (uint8_t)(1u << below(8));
        break;
    case 1:
        if (at < length) input[at] = byte;
        break;
    case 2: put(at, &byte, 1); break;
    case 3: {
        const char *word = WORD[below(sizeof WORD / sizeof *WORD)];
        put(at, word, strlen(word));
        break;
    }
    case 4: {
        const size_t cut = at + more < length ? more : length - at;
        memmove(input + at, input + at + cut, length - at - cut);
        length -= cut;
        break;
    }
    case 5: {
        uint8_t copy[400];
        const size_t from = below(length), n = from + more < length ? more : length - from;
        memcpy(copy, input + from, n);
        put(at, copy, n);
        break;
    }
    case 6:
        if (files > 0) {
            const int other = (int)below((size_t)files);
            const size_t from = below(size[other]),
                         n = from + more < size[other] ? more : size[other] - from;
            put(at, file[other] + from, n);
        }
        break;
    default: {
        uint8_t some[6] = {(uint8_t)next()};
        some[1] = (uint8_t)below(4);
        some[2] = byte;
        for (int k = 3; k < 6; k++) {
            const size_t kept = below(2);
            some[k] = (uint8_t)(kept * next());
        }
        put(length - length % 6, some, 6);
        break;
    }
    }
}

int main(int argc, char **argv) {
    if (argc < 4) {
        fprintf(stderr, "usage: mutate SECONDS SEED FINDING [FILE..]\n");
        return 2;
    }
    static uint8_t *file[FILES];
    static size_t size[FILES];
    int files = 0;
    finding = argv[3];
    chance = strtoull(argv[2], NULL, 10) * 2654435761u + 88172645463325252u;
    for (int i = 4; i < argc && files < FILES; ++i) {
        FILE *in = fopen(argv[i], "rb");
        if (!in || !(file[files] = malloc(MOST_OF_A_FILE))) return 2;
        size[files] = fread(file[files], 1, MOST_OF_A_FILE, in);
        files += size[files] > 0;
        fclose(in);
    }
    const int kept[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGVTALRM};
    for (size_t i = 0; i < sizeof kept / sizeof *kept; ++i) signal(kept[i], keep);
    FILE *told = fdopen(dup(STDERR_FILENO), "w"); /* a reader may close the door behind it */
    const time_t end = time(NULL) + strtol(argv[1], NULL, 10);
    long long runs = 0;
    for (; time(NULL) < end; ++runs) {
        length = 0;
        if (files > 0) {
            const int which = (int)below((size_t)files);
            memcpy(input, file[which], length = size[which]);
        }
        for (size_t n = 1 + below(6); n > 0; --n) mutate(file, size, files);
        if (below(300) == 0) repeat();
        const struct itimerval slow = {.it_value = {SLOW_SECONDS, 0}}, never = {0};
        setitimer(ITIMER_VIRTUAL, &slow, NULL);
        LLVMFuzzerTestOneInput(input, length);
        setitimer(ITIMER_VIRTUAL, &never, NULL);
    }
    if (told)
        fprintf(told, "%lld inputs, seed %s: no crash, none over %d s\n", runs, argv[2],
                (int)SLOW_SECONDS);
    return 0;
}
