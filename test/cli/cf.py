# SPDX-License-Identifier: BSD-3-Clause
"""Does result.nc keep the rules of the CF conventions (1.8) on attributes?  Chapters 2.3 names, 2.6 attributes of the file, 3.1 units,
3.2 long names, 3.5 flags; read from the layout of the file alone.                    usage: cf.py CAPSTAN SCENE.."""
import os
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "property"))
import result_file  # noqa: E402

# what UDUNITS reads of the units that are used here: symbols with integer powers, blanks between
SYMBOL = r"(m|s|N|J|W|rad)(-?\d)?"
UNITS = re.compile(rf"1|{SYMBOL}( {SYMBOL})*")
CHARACTERS = 2


def faults(path):
    """What is wrong with a file, a sentence each."""
    results = result_file.Results(path)
    about = results.attributes
    if about.get("Conventions") != "CF-1.8":
        yield f"Conventions: {about.get('Conventions')}"
    for name in ("title", "source"):
        if not about.get(name):
            yield f"no {name}"
    if not re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ: .*capstan \d+\.\d+\.\d+", about.get("history", "")):
        yield f"history: {about.get('history')}"
    for name, (_, kind, _, _) in results.variables.items():
        its = results.attributes_of[name]
        if not re.fullmatch(r"[A-Za-z]\w*", name):
            yield f"{name}: not a name of CF"
        if not its.get("long_name"):
            yield f"{name}: no long_name"
        if kind != CHARACTERS and not UNITS.fullmatch(its.get("units", "")):
            yield f"{name}: units {its.get('units')}"
        values, meanings = its.get("flag_values"), its.get("flag_meanings")
        if (values is None) != (meanings is None):
            yield f"{name}: one of flag_values and flag_meanings only"
        if values is not None:
            if values.typecode != result_file.CODE[kind]:
                yield f"{name}: flag_values of another type"
            if not re.fullmatch(r"[\w.+@-]+( [\w.+@-]+)*", meanings) or len(meanings.split()) != len(values) or len(set(values)) != len(values):
                yield f"{name}: flags {list(values)} {meanings!r}"


def main():
    wrong = []
    for scene in sys.argv[2:]:
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.argv[1], "run", scene, "-q", "--no-paraview", "-o", folder], stdout=subprocess.DEVNULL, check=False)
            wrong += [f"{os.path.basename(scene)}: {fault}" for fault in faults(os.path.join(folder, "result.nc"))]
    print("\n".join(wrong) or "nothing to object to")
    sys.exit(1 if wrong else 0)


main()
