/* SPDX-License-Identifier: BSD-3-Clause */
/* Run a program and let one of its system calls fail: the K-th after it has begun of those that
 * open, read, write, list or remove files, or that one and all behind it. Or kill it before that
 * call.
 *
 *     refuse_calls K once|on|kill ERRNO COUNT_FILE PROGRAM ARGUMENTS..
 *
 * Calls are counted from the program's first fcntl, with which capstan begins, so that those of the
 * dynamic linker are not among them. The number of calls counted goes to COUNT_FILE; the exit code
 * is the program's, 128 + the signal that ended it, or 77 where programs cannot be traced. Unlike
 * functions of a library, what libc itself calls is reached, too. A program built for coverage
 * writes its counts when it has ended; those calls are its compiler's, and are left alone. */
#define _GNU_SOURCE
#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __x86_64__

static bool is_counted(long call) {
    static const long COUNTED[] = {SYS_open,      SYS_openat,     SYS_write,     SYS_pwrite64,
                                   SYS_writev,    SYS_fsync,      SYS_fdatasync, SYS_rename,
                                   SYS_renameat,  SYS_renameat2,  SYS_unlink,    SYS_unlinkat,
                                   SYS_mkdir,     SYS_mkdirat,    SYS_rmdir,     SYS_close,
                                   SYS_ftruncate, SYS_lseek,      SYS_read,      SYS_pread64,
                                   SYS_stat,      SYS_lstat,      SYS_fstat,     SYS_newfstatat,
                                   SYS_statx,     SYS_getdents64, SYS_flock};
    for (size_t i = 0; i < sizeof COUNTED / sizeof *COUNTED; i++)
        if (COUNTED[i] == call) return true;
    return false;
}

/* Is the path that a stopped program opens one of its coverage counts? */
static bool opens_counts(pid_t child, unsigned long long path) {
    char text[4096] = {0};
    size_t length = 0;
    while (length + sizeof(long) < sizeof text) {
        const long word = ptrace(PTRACE_PEEKDATA, child, path + length, 0);
        memcpy(text + length, &word, sizeof word);
        if (memchr(text + length, 0, sizeof word)) break;
        length += sizeof word;
    }
    text[sizeof text - 1] = '\0';
    const size_t whole = strnlen(text, sizeof text);
    return whole > 5 && strcmp(text + whole - 5, ".gcda") == 0;
}

/* The traced program from its start to its end; the exit code. */
static int trace(pid_t child, long k, const char *mode, long code, long *count) {
    const bool on = strcmp(mode, "on") == 0, kills = strcmp(mode, "kill") == 0;
    int status;
    bool inside = false, refused = false, begun = false, ended = false;
    if (waitpid(child, &status, 0) != child || !WIFSTOPPED(status)) return 77;
    ptrace(PTRACE_SETOPTIONS, child, 0, PTRACE_O_TRACESYSGOOD | PTRACE_O_EXITKILL);
    for (int pass = 0;;) {
        if (ptrace(PTRACE_SYSCALL, child, 0, pass) != 0 || waitpid(child, &status, 0) != child)
            return 77;
        pass = 0;
        if (WIFEXITED(status)) return WEXITSTATUS(status);
        if (WIFSIGNALED(status)) return 128 + WTERMSIG(status);
        if (WSTOPSIG(status) != (SIGTRAP | 0x80)) {
            pass = WSTOPSIG(status) == SIGTRAP ? 0 : WSTOPSIG(status);
            continue;
        }
        struct user_regs_struct regs;
        ptrace(PTRACE_GETREGS, child, 0, &regs);
        inside = !inside;
        if (inside) {
            const long call = (long)regs.orig_rax;
            begun = begun || call == SYS_fcntl;
            ended = ended || (begun && call == SYS_openat && opens_counts(child, regs.rsi));
            refused = false;
            const bool told =
                call == SYS_write && regs.rdi == STDERR_FILENO; /* what went wrong shall be read */
            if (begun && !ended && !told && is_counted(call)) {
                ++*count;
                refused = *count == k || (on && *count > k && k > 0);
            }
            if (refused && kills) {
                kill(child, SIGKILL);
                waitpid(child, &status, 0);
                return 128 + SIGKILL;
            }
            if (refused) {
                regs.orig_rax = (unsigned long long)-1;
                ptrace(PTRACE_SETREGS, child, 0, &regs);
            }
        } else if (refused) {
            regs.rax = (unsigned long long)-code;
            ptrace(PTRACE_SETREGS, child, 0, &regs);
        }
    }
}

int main(int argc, char **argv) {
    if (argc < 6) return 2;
    const pid_t child = fork();
    if (child < 0) return 77;
    if (child == 0) {
        if (ptrace(PTRACE_TRACEME, 0, 0, 0) != 0) _exit(77);
        execv(argv[5], argv + 5);
        _exit(77);
    }
    long count = 0;
    const int code =
        trace(child, strtol(argv[1], NULL, 10), argv[2], strtol(argv[3], NULL, 10), &count);
    FILE *out = fopen(argv[4], "w");
    if (!out || fprintf(out, "%ld\n", count) < 0 || fclose(out) != 0) return 2;
    return code;
}

#else

int main(void) { return 77; }

#endif
