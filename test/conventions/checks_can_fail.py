# SPDX-License-Identifier: BSD-3-Clause
"""Show each check of scripts/ a small tree with known faults.          usage: checks_can_fail.py SCRIPTS CC

A check that never objects proves nothing: every fault below has to be reported, and a clean tree has to pass.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile

SCRIPTS, CC = sys.argv[1], sys.argv[2]
LICENCE = "/* SPDX-License-Identifier: BSD-3-Clause */\n"

CLEAN = {
    "include/capstan/base.h": '#include <stddef.h>\nint cps_one(void);\n',
    "include/capstan/scene.h": '#include "capstan/base.h"\n',
    "src/base/one.c": '#include "base/one.h"\n\n#include "capstan/base.h"\n'
                      'int cps_one(void) { return cpsi_two; }\n',
    "src/base/one.h": 'static const int cpsi_two = 2;\n',
    "src/base/three.c": '#include "base/three.h"\n\nconst int cpsi_three = 3;\nint cpsi_second(void) { return cpsi_first(); }\n',
    "src/base/three.h": 'extern const int cpsi_three;\n',
    "src/io/history.h": '#include "io/base/yaml/pool.h"\n',
    "src/io/base/yaml/pool.h": '#include "base/one.h"\n',
    "src/io/results/writers.h": '#include "io/history.h"\n',
    "src/io/results/run/files.h": '#include "io/draw/run/one.h"\n#include "io/results/writers.h"\n',
    "src/io/draw/svg.h": '#include "io/history.h"\n',
    "src/io/base/directory/list.h": "",
    **{f"src/io/draw/run/{name}.h": "" for name in "one two three four five six seven eight".split()},
    "src/chain/loop.c": '#include <math.h>\n\n#include "base/one.h"\n#include "linalg/dense.h"\n',
    "src/linalg/dense.h": '#include "base/one.h"\n',
    "cli/drive/answer.h": '#include "law/answer.h"\n',
    "cli/law/answer.h": '#include "capstan/base.h"\n',
    "src/base/commas.c": 'static int a = 1, b = 2, c[] = {1, 2};\n'
                         'void cpsi_commas(int x, double (*f)(int, int)) {\n'
                         '    CpsOne *p = 0, *q[2] = {p, p}, *r = (CpsOne *)f(x, (x));\n'
                         '    for (int i = 0, j = 1; i < j; i++, j--) q[i] = r ? p : r;\n'
                         '    for (int i = 0; i < x && a < 3; i++) a += i;\n'
                         '    for (int i = 0; i < x && p->size > 1; i++) f(p, i);\n'
                         '    for (int i = 0, ok = 1; ok && i < x; i++) ok = c[i];\n'
                         '    do f(a, b);\n    while (x && a++ < 3);\n'
                         '    switch (x) {\n    case 1: f(a, b); break;\n    default: (*f)(c[0], 1);\n    }\n'
                         '}\n',
    "test/dice.h": 'static inline double uniform(double low, double high) { return splitmix(&state, low, high); }\n',
    "test/draws.c": 'static int below(int n) { return (int)uniform(0, n); }\n'
                    'void draws(double *x) {\n'
                    '    const double a = uniform(0, 1), b = below(2) ? uniform(1, 2) : uniform(2, below(3));\n'
                    '    for (int i = below(3); i < 9; i++) x[i] = a * uniform(b, 1);\n'
                    '    if (below(2) && below(3)) x[below(4)] = 0;\n'
                    '    if (uniform(0, 1) < 0.5 || below(3)) x[0] = 1;\n'
                    '    switch (below(3)) {\n    case 1: x[1] = below(2); break;\n    default: {\n        x[2] = below(3);\n'
                    '        x[3] = below(4);\n    }\n    }\n'
                    '}\n',
    "cli/main.c": '#include "capstan/scene.h"\n\ntypedef struct Pair {\n    int a;\n} Pair;\n',
}

# what is added to the clean tree, the check that must object, and a piece of its sentence
FAULTS = [
    ("src/linalg/up.c", '#include "ipm/loop.h"\n', "check-layers", "neither a file of this tree"),
    ("src/linalg/dense.h", '#include "ipm/program.h"\n', "check-layers", "may use base, linalg"),
    ("src/ipm/knows.c", '#include "capstan/scene.h"\n', "check-layers", "ipm/ knows only base.h"),
    ("src/cable/fyaml.c", '#include <libfyaml.h>\n', "check-layers", "nor standard C"),
    ("src/rope/rope.c", '#include <math.h>\n', "check-layers", "no known layer"),
    ("cli/deep.c", '#include "../src/base/one.h"\n', "check-layers", "public headers and its own folder"),
    ("python/native/deep.c", '#include "../../src/base/one.h"\n', "check-layers", "the Python package uses public headers"),
    ("cli/law/cmd.c", '#include "drive/answer.h"\n', "check-layers", "cli/law/ may use cli, cli/law"),
    ("include/capstan/base.h", '#include "capstan/scene.h"\n', "check-layers", "only lower ones"),
    ("src/base/one.h", '#include "base/other.h"\n', "check-layers", "include cycle"),
    ("src/io/draw/up.c", '#include "io/results/writers.h"\n', "check-layers", "io/base/yaml, io/draw\n"),
    ("src/io/read/side.c", '#include "io/history.h"\n', "check-layers", "io/base/yaml, io/read, io/schema, io/schema/loads, io/schema/tables\n"),
    ("src/io/base/yaml/up.c", '#include "io/base/directory/list.h"\n', "check-layers", "may use base, io/base/text, io/base/yaml\n"),
    ("src/io/draw/svg.h", '#include "io/draw/run/one.h"\n', "check-layers", "svg.h:3: includes io/draw/run/one.h: io/draw/ may use"),
    ("src/io/draw/deep/one.h", "#include <math.h>\n", "check-layers", "no known layer"),
    ("src/io/draw/run/nine.h", "", "check-layers", "src/io/draw/run: 9 files and folders, at most 8"),
    ("src/base/one.c", "int cpsi_first(void) { return cpsi_three; }\n", "check-loops", "in a loop: src/base/one src/base/three"),
    ("src/base/bare.c", "int x;\n", "check-files", "first line should be"),
    ("src/base/long.c", LICENCE + "\n" * 801, "check-files", "at most 800"),
    ("src/base/deep.c", LICENCE + "int f(void) {\n" + "\n" * 100 + "return 0; }\n", "check-files", "at most 100"),
    ("src/base/same.c", LICENCE + "typedef struct Pair {\n    int a;\n} Pair;\n", "check-files", "the type Pair of"),
    ("src/base/comma.c", "void f(int a, int b) {\n    a = 1, b = 2;\n}\n", "check-idioms", "comma.c:2: a comma operator"),
    ("src/base/group.c", "int f(int a) { return (a++, a); }\n", "check-idioms", "a comma operator"),
    ("src/base/last.c", "int f(int *a) { return *a = 1, 2; }\n", "check-idioms", "a comma operator"),
    ("src/base/body.h", "void f(int a) {\n    while (a--) g(a, a), g(a, 1);\n}\n", "check-idioms", "body.h:2: a comma"),
    ("src/base/macro.h", "#define TWICE(f) f(), f()\n#define G(a) ((a)++, 1)\n", "check-idioms", "macro.h:2: a comma"),
    ("src/base/choice.c", "void f(int a) { a ? g(), h() : g(); }\n", "check-idioms", "a comma operator"),
    ("src/base/kept.c", "int f(int n, int good) {\n    for (int i = 0; good && i < n; i++) g(i);\n    return 0;\n}\n",
     "check-idioms", "kept.c:2: a condition that the loop does not change"),
    ("src/base/member.h", "int f(CpsOne *a, int *x) {\n    while (next(x) && a->y.z == CPS_ONE) g(a->x);\n    return 0;\n}\n",
     "check-idioms", "member.h:2: a condition that the loop"),
    ("test/call.c", "void f(void) {\n    g(uniform(0, 1), 2,\n      uniform(0, 1));\n}\n", "check-draws", "call.c:3: a second"),
    ("test/sum.c", "double f(int n) { return n + uniform(0, 1) * (uniform(0, 1) < 0.5 ? 1 : -1); }\n", "check-draws", "sum.c:1"),
    ("test/list.c", "void f(void) {\n    const P p = {.x = uniform(0, 1), .y = {uniform(0, 1)}};\n}\n", "check-draws",
     "list.c:2"),
    ("test/item.c", "static int die(void) { return (int)uniform(0, 6); }\nvoid f(int *a) { if (a) a[die()] = die(); }\n",
     "check-draws", "item.c:2"),
    ("test/macro.c", "#define TOSS() (uniform(0, 6) < 3)\nint f(void) { return g(uniform(0, 1), TOSS()); }\n",
     "check-draws", "macro.c:2"),
    ("bench/own.c", "static double next(void) { return (double)(step() >> 11) * 0x1p-53; }\nint f(void) { return g(next() + next()); }\n",
     "check-draws", "own.c:2"),
    ("src/base/ugly.c", "int  f( int a ) { return a*2; }\n", "format --check", "src/base/ugly.c: not as clang-format"),
    ("src/base/wide.c", "int f(int a) { return a; } /* " + "word " * 20 + "*/\n", "format --check", "src/base/wide.c"),
    ("docs/page.md", "See [there](nowhere.md).\n", "check-links", "no docs/nowhere.md"),
    ("docs/page.md", "Read `src/ipm/gone.c`.\n", "check-links", "no src/ipm/gone.c"),
]

# options of check-names, a library source and what the check has to say about it
ALONE = ["--only-libc", CC]
LIBRARIES = [
    ([], "const char *cps_version(void) { return \"0\"; }", None),
    ([], "static const char *const name[] = {\"a\", \"b\"}; const char *cpsi_n(int i) { return name[i]; }", None),
    ([], "int f(void) { return 1; }", "start with cps_ or cpsi_"),
    ([], "int cps_secret(void) { return 1; }", "not declared"),
    ([], "int cpsi_count(void) { static int n; return ++n; }", "mutable data"),
    ([], "int cpsi_table[3] = {1};", "mutable data"),
    ([], "#include <stdio.h>\nvoid cpsi_say(void) { printf(\"%d\", 1); }", "must not use"),
    ([], "#include <stdlib.h>\nvoid cpsi_leave(void) { exit(1); }", "must not use"),
    (ALONE, "#include <math.h>\ndouble cpsi_a(double x) { return sin(x); }", None),
    (ALONE, "int elsewhere(void); int cpsi_a(void) { return elsewhere(); }", "needs more than libc"),
]


def write(root, path, text):
    path = os.path.join(root, path)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "a", encoding="utf-8") as file:
        file.write(text)


def check(script, *arguments):
    """Exit code and words of one check."""
    script, *options = script.split()
    done = subprocess.run([sys.executable, os.path.join(SCRIPTS, script), *options, *arguments], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def clean_tree(root):
    for path, text in CLEAN.items():
        write(root, path, LICENCE + text)
    write(root, "src/ipm/program.h", LICENCE)
    write(root, "src/base/other.h", LICENCE + '#include "base/one.h"\n')
    write(root, "README.md", "Read [the header](include/capstan/base.h) and `src/chain/loop.c`.\n")


def expect(what, code, words, wanted):
    """One sentence on stdout if the check did not do what is wanted (None: pass)."""
    if (wanted is None and code in (0, 77)) or (wanted and code == 1 and wanted in words):
        return 0
    print(f"{what}: expected {wanted or 'no objection'}, got exit code {code} and\n{words}")
    return 1


def main():
    wrong = 0
    passes = [(None, None, script, None) for script in ("check-layers", "check-loops", "check-files", "check-idioms", "check-draws", "format --check",
                                                       "check-links")]
    for path, text, script, wanted in passes + FAULTS:
        with tempfile.TemporaryDirectory() as root:
            clean_tree(root)
            if path:
                write(root, path, text)
            if wanted == "at most 100" and not shutil.which("ctags"):
                continue
            code, words = check(script, root)
            if script.startswith("format") and code == 77:
                continue  # no clang-format of that version
            wrong += expect(f"{script} {path}", code, words, wanted)

    for options, text, wanted in LIBRARIES:
        with tempfile.TemporaryDirectory() as root:
            source, thing, library = (os.path.join(root, name) for name in ("a.c", "a.o", "a.a"))
            write(root, "a.c", text)
            subprocess.run([CC, "-fPIC", "-O1", "-c", source, "-o", thing], check=True)
            subprocess.run(["ar", "rc", library, thing], check=True)
            wrong += expect(f"check-names {text}", *check("check-names", *options, library), wanted)

    for width, wanted in (("int", None), ("long long", "error:")):  # a long holds either with 64 bits
        with tempfile.TemporaryDirectory() as root:
            write(root, "src/base/wide.c", f"long wide({width} x) {{\n    return x;\n}}\n")
            entry = {"directory": root, "file": os.path.join(root, "src/base/wide.c"),
                     "command": f"{CC} -std=c17 -O2 -Wconversion -o wide.o -c src/base/wide.c"}
            write(root, "compile_commands.json", json.dumps([entry]))
            code, words = check("check-32-bits", root, root)
            wrong += 0 if code == 77 else expect(f"check-32-bits {width}", code, words, wanted)
    sys.exit(1 if wrong else 0)


main()
