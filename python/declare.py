#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Write the C source of capstan's Python module from the public headers.   usage: declare.py CC INCLUDE NATIVE OUTPUT

The C compiler preprocesses the headers. What comes from include/capstan is kept and handed to cffi in API mode, so
that the layout of every struct is the compiler's. NATIVE is a folder with native.h, the few loops that the package
adds in C, whose declarations are read the same way, and native.c. A declaration added to a header is available in
Python as capstan._native.lib.NAME after the next build; nothing here needs to be changed for it.
"""
import os
import re
import subprocess
import sys

import cffi

MODULE = "capstan._native"
# function-like macros, include guards and the marker of exported symbols are no constants
CONSTANT = re.compile(r"^#define (CPS_[A-Z0-9_]+) (\(?-?[0-9][0-9a-zA-Z.+-]*\)?)$", re.M)


def preprocessed(compiler, include, native):
    """(file, text) of every public header and of native.h, in the order in which C needs them."""
    headers = sorted(name for name in os.listdir(os.path.join(include, "capstan")) if name.endswith(".h"))
    source = "".join(f'#include "capstan/{name}"\n' for name in headers) + '#include "native.h"\n'
    done = subprocess.run([compiler, "-E", "-x", "c", "-std=c17", "-I", include, "-I", native, "-"], input=source,
                          capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"declare: the headers do not compile:\n{done.stderr}")
    wanted = [os.path.realpath(os.path.join(include, "capstan")), os.path.realpath(native)]
    parts, keep = [], False
    for line in done.stdout.splitlines():
        marker = re.match(r'^# \d+ "(.*)"', line)
        if marker:
            keep = os.path.dirname(os.path.realpath(marker.group(1))) in wanted
        elif keep:
            parts.append(line)
    return "\n".join(parts), headers


def constants(include, headers):
    """The macros that are plain integers, as cffi declares them."""
    found = []
    for name in headers:
        with open(os.path.join(include, "capstan", name), encoding="utf-8") as file:
            found += [key for key, value in CONSTANT.findall(re.sub(r"\s*/\*.*", "", file.read()))
                      if re.fullmatch(r"\(?-?\d+\)?", value)]
    return "".join(f"#define {name} ...\n" for name in dict.fromkeys(found))


def declarations(compiler, include, native):
    text, headers = preprocessed(compiler, include, native)
    text = re.sub(r"__attribute__\s*\(\((?:[^()]|\([^()]*\))*\)\)", "", text)
    # what C calls from Python has to be marked for cffi
    text = re.sub(r"^extern (.*\bcapstan_python_\w+\()", r'extern "Python+C" \1', text, flags=re.M)
    return constants(include, headers) + text, headers


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    compiler, include, native, output = sys.argv[1:]
    text, headers = declarations(compiler, include, native)
    with open(os.path.join(native, "native.c"), encoding="utf-8") as file:
        source = file.read()
    ffi = cffi.FFI()
    ffi.cdef(text)
    ffi.set_source(MODULE, "".join(f'#include "capstan/{name}"\n' for name in headers) + source)
    ffi.emit_c_code(output)


main()
