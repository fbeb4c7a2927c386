# SPDX-License-Identifier: BSD-3-Clause
"""What the tests of the command share: the faults found, what is expected, and files as bytes."""
import os
import pty
import re
import sys
import tempfile

faults = []
PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../docs/validation.md")


def is_told(count):
    """Does docs/validation.md tell that the running suite has so many inputs, and the sum of all suites?"""
    with open(PAGE, encoding="utf-8") as file:
        rows = {name: int(number) for name, number in re.findall(r"^\| `?((?:bad_\w+\.py|all of them))`? \| (\d+) \|", file.read(), re.M)}
    suite, total = os.path.basename(sys.argv[0]), rows.pop("all of them", None)
    if rows.get(suite) == count and sum(rows.values()) == total:
        return True
    print(f"docs/validation.md: {suite} has {count} inputs, the page says {rows.get(suite)}; its sum is {sum(rows.values())}, and it says {total}")
    return False


def expect(what, holds, found=""):
    if not holds:
        faults.append(f"{what}: {found!r}")


def write(name, data):
    with open(name, "wb") as file:
        file.write(data if isinstance(data, bytes) else data.encode())


def read(name):
    with open(name, "rb") as file:
        return file.read()


def has_terminals():
    """Whether the system gives pseudo-terminals, which a bare container may not."""
    try:
        for side in pty.openpty():
            os.close(side)
    except OSError:
        return False
    return True


def run_in_an_empty_folder(main, passed):
    """Run a test in a folder that is removed after it, print its faults or that it passed, and end the program."""
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        main()
        os.chdir("/")
    print("\n".join(faults[:20]) or passed)
    sys.exit(1 if faults else 0)
