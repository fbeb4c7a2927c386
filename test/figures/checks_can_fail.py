# SPDX-License-Identifier: BSD-3-Clause
"""The comparison of scripts/pages finds what is not as the program gives it: each fault is put into a page on purpose.   usage: checks_can_fail.py ROOT"""
import os
import sys
import tempfile
import types

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(sys.argv[1], "scripts", "pages"))
from marks import Page, Program, write  # noqa: E402

PAGE = """# A page

Example 5.7 of 1990, (36) to (38), takes 24 steps of
0.125 m each, on 800 elements.

<!-- figures: rows -->

| a | 1.2345 |
| b | 3e-7 |

<!-- end -->

![A line](pictures/line.svg)
"""
PICTURE = "<svg><path d=\"M10.0 20.5 L30 40\"/></svg>"
# what is changed, and what is told of it
FAULTS = (("1.2345", "1.2349", "rows"), ("| b |", "| c |", "rows"), ("3e-7", "6e-7", "rows"), ("24 steps", "27 steps", "in a sentence"),
          ("0.125 m", "0.128 m", "in a sentence"), ("steps of", "parts of", "stands there 0 times"), ("each, on", "each, 3.5 times, on", "nothing writes the figure 3.5"),
          ("800 elements", "900 elements", "is said to be given"), ("(36)", "36", "nothing writes the figure 36"), ("| b | 3e-7 |\n", "", "lines, expected"),
          ("pictures/line", "pictures/other", "drawn by no command"))


def faults_of(page, picture=PICTURE):
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "docs", "pictures"))
        write(os.path.join(root, "docs", "page.md"), page)
        write(os.path.join(root, "docs", "pictures", "line.svg"), PICTURE)
        drawn = os.path.join(root, "line.svg")
        write(drawn, picture)
        module = types.SimpleNamespace(FIGURES={"rows": lambda p: ["| a | 1.2346 |", "| b | 3e-7 |"]},
                                       SENTENCES=[("takes {} steps of {} m each", lambda p: ["24", "0.125"])],
                                       GIVEN=["800 elements"], PICTURES={"line": lambda p: drawn})
        with Program(root, root) as program:
            return Page(program, "page", module).faults(True)


wrong = [f"of the page itself: {fault}" for fault in faults_of(PAGE)]
for old, new, told in FAULTS:
    assert PAGE.count(old) == 1, old
    if not any(told in fault for fault in faults_of(PAGE.replace(old, new))):
        wrong.append(f"'{old}' -> '{new}': nothing said of '{told}'")
if not any("not what is drawn" in fault for fault in faults_of(PAGE, PICTURE.replace("30", "33"))):
    wrong.append("another picture is not told")
print("\n".join(wrong) or f"{len(FAULTS) + 1} faults found")
sys.exit(1 if wrong else 0)
