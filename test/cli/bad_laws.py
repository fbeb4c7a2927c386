#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""capstan law: bad files are refused with their place and message, good ones answered.     usage: bad_laws.py CAPSTAN EXAMPLES
                                                                      or: bad_laws.py --write FOLDER   (to begin fuzzing with)

Every bad case is one law expression (or whole contents); expected is what follows the file name in the one line on standard
error. Good cases are the examples, whose answers are read back from the JSON.
"""
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile

from checks import is_told

INPUT, USAGE, OK, OPEN = 3, 2, 0, 1

# name, value of `law:` (it begins in column 6 of line 2), expected after "FILE:"
LAWS = [
    # words and keys
    ("unknown word", "{dics: 500}", "2:7: unknown word 'dics'; did you mean 'disc'?"),
    ("unknown word, nothing near", "{wheel: 500}", "2:7: unknown word 'wheel', expected one of: point, interval, disc"),
    ("two words", "{disc: 1, ball: 2}", "2:1: 'law': found a mapping, expected one word with its value"),
    ("a number for a set", "5", "2:1: 'law': found '5', expected one word with its value"),
    ("a list for a set", "[{disc: 5}]", "2:1: 'law': found a list of 1, expected one word"),
    ("unknown key", "{preimage: {mpa: [[1]], of: {interval: 1}}}", "2:18: 'preimage': unknown key 'mpa', expected a mapping with map, of"),
    ("key missing", "{preimage: {map: [[1]]}}", "2:7: 'preimage': 'of' is missing"),
    ("coulomb without load", "{coulomb: {friction: 0.5}}", "2:7: 'coulomb': 'load' is missing"),
    ("duplicate key", "{disc: 1, disc: 2}", "2:16: key 'disc' is given twice"),
    # numbers
    ("negative radius", "{disc: -1}", "2:7: 'disc': found '-1', expected a number, at least 0"),
    ("NaN radius", "{disc: .nan}", "2:7: 'disc': found '.nan', expected a number, at least 0, finite and at most 1e100"),
    ("infinite radius", "{disc: .inf}", "2:7: 'disc': found '.inf', expected a number, at least 0, finite and at most 1e100"),
    ("unit in the value", "{disc: 5 N}", "2:7: 'disc': found '5 N', expected a number, at least 0: write the number alone, without a unit"),
    ("text in quotes", "{disc: '5'}", "2:7: 'disc': found the text \"5\" in quotes, expected a number"),
    ("too large", "{disc: 1e101}", "2:7: 'disc': found '1e101'"),
    ("NaN in a matrix", "{ellipsoid: [[1, 0], [0, .nan]]}", "2:31: 'ellipsoid': found '.nan', expected a number, finite and at most 1e100"),
    ("negative friction", "{coulomb: {friction: -0.5, load: 10}}", "2:17: 'friction': found '-0.5'"),
    ("negative load", "{unit_load: {load: -1, of: {disc: 1}}}", "2:19: 'load': found '-1'"),
    ("axis of length 0", "{ellipse: [1, 0]}", "2:20: 'ellipse': found '0', expected a number, greater than 0"),
    ("dimension 0", "{ball: {radius: 1, dimension: 0}}", "2:25: 'dimension': found '0', expected a whole number, from 1 to 32"),
    ("dimension 1e9", "{ball: {radius: 1, dimension: 1e9}}", "2:25: 'dimension': found '1e9'"),
    ("half a dimension", "{ball: {radius: 1, dimension: 1.5}}", "2:25: 'dimension': found '1.5'"),
    # dimensions
    ("ragged matrix", "{polytope: [[1, 0], [0]]}", "2:26: 'polytope': found a list of 1, expected rows of numbers, all equally long"),
    ("empty list", "{product: []}", "2:7: 'product': found a list of 0, expected a list of at least one word with its value"),
    ("rows of a map", "{preimage: {map: [[1, 0]], of: {disc: 5}}}", "2:18: 'map': found 1 rows, expected 2, as many as its set has components"),
    ("columns of a map", "{image: {map: [[1, 0, 0]], of: {disc: 5}}}", "2:15: 'map': found 3 columns, expected 2, as many as its set has components"),
    ("contacts of two bodies", "{contacts: [{map: [[1, 0]], of: {interval: 1}}, {map: [[1]], of: {interval: 1}}]}", "2:55: 'map': found 1 columns, expected 2, as many as the first contact's map has"),
    ("intersection of different spaces", "{intersection: [{disc: 1}, {interval: 1}]}", "2:7: 'intersection': "),
    ("translate by too little", "{translate: {by: [1], of: {disc: 5}}}", "2:19: 'by': found 1 numbers, expected 2, as many as its set has components"),
    ("shape not square", "{ellipsoid: [[1, 0]]}", "2:7: 'ellipsoid': found a list of 1, expected a square matrix"),
    ("offsets and rows", "{inequalities: {rows: [[1], [-1]], offsets: [1]}}", "2:41: 'offsets': found 1 numbers, expected 2, as many as there are rows"),
    # shapes
    ("indefinite shape", "{ellipsoid: [[1, 2], [2, 1]]}", "2:7: 'ellipsoid': "),
    ("shape not symmetric", "{ellipsoid: [[1, 0.5], [0, 1]]}", "2:7: 'ellipsoid': "),
    ("strip without normal", "{intersection: [{disc: 5}, {strip: {normal: [0, 0], width: 1}}]}", "2:34: 'strip': "),
    # no friction law
    ("without 0", "{translate: {by: [9, 0], of: {disc: 5}}}", "2:7: 'translate': the set of forces does not contain 0"),
    ("a factor without 0", "{product: [{interval: [1, 2]}, {disc: 5}]}", "2:18: 'interval': the set of forces does not contain 0"),
    ("empty intersection", "{intersection: [{point: [0, 0]}, {point: [1, 0]}]}", "2:7: 'intersection': the set of forces is empty"),
    ("interval turned round", "{interval: [2, -1]}", "2:7: 'interval': "),
    # YAML
    ("anchor", "&a {disc: 5}", "2:7: found an anchor"),
    # sizes
    ("too many components", "{box: [" + "1, "*64 + "1]}", "2:7: 'box': found 65 numbers, at most 32"),
    ("too many together", "{product: [" + "{disc: 1}, "*33 + "]}", "2:7: 'product': a set of 66 components, at most 32"),
    ("too many columns", "{image: {map: [[" + "1, "*65 + "]], of: {disc: 1}}}", "2:21: 'map': found 65 numbers, at most 32"),
    ("too much to solve", "{polar: {polytope: [" + "[1, 0], [0, 1], [-1, -1], "*200 + "]}}", "2:15: 'polytope': the sets up to here"),
    ("deep nesting", "{polar: " * 100 + "{disc: 1}" + "}" * 100, "2:"),
]

# name, contents, expected after "FILE:"
FILES = [
    ("empty file", "", "1:1: found an empty file: a law begins with 'capstan: 1'"),
    ("neither", "capstan: 1\n", "1:1: law file: nothing given, expected exactly one of 'law', 'resistance'"),
    ("both", "capstan: 1\nlaw: {disc: 1}\nresistance: [{dry: {disc: 1}}]\n", "1:1: law file: too much given"),
    ("no version", "law: {disc: 1}\n", "1:1: law file: 'capstan' is missing"),
    ("version of the future", "capstan: 2\nlaw: {disc: 1}\n", "1:1: 'capstan': found '2', expected a whole number: 1"),
    ("unknown key", "capstan: 1\nlaww: {disc: 1}\n", "2:1: law file: unknown key 'laww'; did you mean 'law'?"),
    ("load of another space", "capstan: 1\nlaw: {disc: 1}\nload: [1]\n", "3:1: 'load': found 1 numbers, expected 2, as many as the law has components"),
    ("load on a resistance", "capstan: 1\nresistance: [{dry: {disc: 1}}]\nload: [1, 0]\n", "3:1: 'load': it goes with 'law', which is not given"),
    ("falls with speed", "capstan: 1\nresistance:\n- {table: {points: [[0, 1], [1, 0.8]], of: {disc: 1}}}\n",
     "3:4: 'table': the factor falls from 1 at speed 0 to 0.8 at speed 1: friction that falls with speed is no subdifferential"),
    ("not symmetric", "capstan: 1\nresistance:\n- {viscous: [[1, 0.5], [-0.5, 1]]}\n", "3:4: 'viscous': the viscous matrix is not symmetric"),
    ("not definite", "capstan: 1\nresistance:\n- {viscous: [[1, 0], [0, -1]]}\n", "3:4: 'viscous': the viscous matrix is not positive definite"),
    ("negative factor", "capstan: 1\nresistance:\n- {table: {points: [[0, -1], [1, 1]], of: {disc: 1}}}\n", "3:4: 'table': the factor at speed 0 is -1: phi < phi(0)"),
    ("degree below 1", "capstan: 1\nresistance:\n- {power: {degree: 0.5, factor: 1, of: {disc: 1}}}\n", "3:4: 'power': degree 0.5 is below 1: friction would fall"),
    ("a scene", "capstan: 1\nlines: {}\n", "2:1: found a scene ('lines'), which 'capstan run', 'check' and 'study' take; expected a law"),
    ("a list", "[1, 2]\n", "1:1: law file: found a list of 2, expected a mapping with capstan, title, law"),
    ("nothing but a comment", "# law\n", "1:1: found nothing: a law begins with 'capstan: 1'"),
    ("two documents", "capstan: 1\nlaw: {disc: 1}\n---\n", "3:1: found a second document ('---'): a file holds one law"),
    ("unknown term", "capstan: 1\nresistance:\n- {viscuos: [[1]]}\n", "3:4: unknown term 'viscuos'; did you mean 'viscous'?"),
    ("terms of two spaces", "capstan: 1\nresistance:\n- {dry: {disc: 1}}\n- {viscous: [[1]]}\n", "2:1: 'resistance': part 2 has 1 components, the first 2"),
    ("polytope of four components", "capstan: 1\nlaw: {polytope: [" + ", ".join(f"[{k % 7 - 3}, {k % 5 - 2}, {k % 3 - 1}, {k % 2}]" for k in range(300)) + "]}\n",
     "2:7: 'polytope': the sets up to here that are not answered in closed form have 304 components, points and rows together, at most 170 with sets of 4 components"),
    ("dry without 0", "capstan: 1\nresistance:\n- {dry: {interval: [1, 2]}}\n", "3:10: 'interval': the set of forces does not contain 0"),
]

# names of the cases above that a JSON schema cannot tell: what ties two values together, the mathematics, YAML itself
BEYOND_A_SCHEMA = {
    "too many together", "too much to solve", "polytope of four components",
    "duplicate key", "NaN radius", "infinite radius", "NaN in a matrix", "anchor", "deep nesting",
    "ragged matrix", "rows of a map", "columns of a map", "contacts of two bodies", "intersection of different spaces",
    "translate by too little", "shape not square", "offsets and rows", "load of another space", "terms of two spaces",
    "indefinite shape", "shape not symmetric", "strip without normal", "without 0", "a factor without 0", "empty intersection",
    "interval turned round", "falls with speed", "not symmetric", "not definite", "negative factor", "degree below 1",
    "dry without 0",
}

CASES = [(name, f"capstan: 1\nlaw: {law}\n", wanted) for name, law, wanted in LAWS] + FILES


class Suite:
    def __init__(self, capstan, folder):
        self.capstan, self.folder, self.count, self.failed = capstan, folder, 0, 0

    def run(self, *arguments, text=None, before=None):
        done = subprocess.run([self.capstan, "law", *arguments], capture_output=True, text=True, timeout=60, input=text,
                              preexec_fn=before, check=False)
        return done.returncode, done.stdout, done.stderr

    def expect(self, name, holds, found):
        self.count += 1
        if not holds:
            self.failed += 1
            print(f"FAILED {name}: {found}")

    def bad(self, name, contents, wanted):
        path = os.path.join(self.folder, "law.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(contents)
        code, out, err = self.run(path, "--velocity", "1,0")
        start = f"capstan: {path}:{wanted}"
        limit = " at most 32" in err or " closed form have " in err or "nested deeper" in err
        self.expect(name, code == (6 if limit else INPUT) and out == "" and err.startswith(start) and err.count("\n") == 1,
                    f"expected {start}\n  found exit {code}: {err}{out}")

    def ask(self, path, *arguments, code=OK):
        got, out, err = self.run(path, "--json", *arguments)
        self.expect(f"{path} {arguments}", got == code and err == "", f"exit {got}: {err}")
        return json.loads(out) if out else {}

    def near(self, name, got, wanted):
        # closed forms printed with all digits
        self.expect(name, isinstance(got, float | int) and abs(got - wanted) <= 1e-10 * max(1, abs(wanted)), f"{got}, expected {wanted}")

    def answers(self, examples):
        wheel = os.path.join(examples, "braked-wheel.yaml")
        answer = self.ask(wheel, "--velocity", "1,1", "--velocity=0,1", "--force", "458.257569495584,200")
        self.expect("composition", answer["composition"]["condition"] == "interior", answer["composition"])
        self.near("area", answer["area"], 389061.45083197765)
        corner, edge, force = answer["answers"]
        self.near("corner power", corner["dissipation_W"], 658.257569495584)
        self.expect("corner", corner["forces"]["dimension"] == 0, corner)
        self.expect("edge", edge["forces"]["dimension"] == 1 and len(edge["forces"]["vertices"]) == 2, edge)
        self.near("edge extent", edge["forces"]["extent"][0]["high"] - edge["forces"]["extent"][0]["low"], 2 * 458.257569495584)
        self.expect("sector", force["velocities"]["description"] == "sector" and len(force["velocities"]["rays"]) == 2, force)
        self.expect("gap", all(isinstance(a["gap"], int | float) for a in answer["answers"]), answer)

        # velocities as CSV, with names and a comment; a pair on the law
        code, out, err = self.run(wheel, "--json", "--velocity", "-", text="vx, vy\n# rolling\n1, 0\n0.5,2\n")
        rows = json.loads(out)["answers"]
        self.expect("two rows", code == OK and len(rows) == 2, err)
        self.near("second row", rows[1]["dissipation_W"], 629.128784747792)
        pair = self.ask(wheel, "--velocity", "1,0", "--force=-500,0")["pairs"][0]
        self.near("pair", pair["gap_W"], 0)
        bingham = self.ask(os.path.join(examples, "grease.yaml"), "--velocity", "0,1", "--force", "0,-5")
        self.near("power of grease", bingham["answers"][0]["dissipation_W"], 5)
        self.near("velocity of grease", bingham["answers"][1]["velocities"]["centre"][1], 1)
        outside = self.ask(wheel, "--force", "0,300")
        self.expect("no velocity", outside["answers"][0]["velocities"] == {"outcome": "CPS_SET_OUTCOME_OUTSIDE"}, outside)

        # every example answers in words and is drawn
        for name in sorted(os.listdir(examples)):
            path = os.path.join(examples, name)
            about = self.ask(path)
            ones = ",".join(["0.5"] * about["components"])
            code, out, err = self.run(path, "--velocity", ones, "--force", ones)
            self.expect(name, code == OK and "dissipates" in out and not err, f"exit {code}: {err}")
            picture = os.path.join(self.folder, "law.svg")
            code, _, err = self.run(path, "--velocity", ones, "--plot", picture)
            with open(picture, encoding="utf-8") as file:
                text = file.read()
            self.expect(f"picture of {name}", code == OK and text.endswith("</svg>\n") and "nan" not in text and "inf\"" not in text,
                        f"exit {code}: {err}")

    def usage(self, wheel):
        for arguments, code, wanted in [
                ([], USAGE, "capstan law: no file given"),
                ([wheel, "--velocity", "1"], USAGE, "capstan law: --velocity: expected 2 numbers separated by commas, at most 1e100: found '1'"),
                ([wheel, "--velocity", "1,2,3"], USAGE, "capstan law: --velocity: expected 2 numbers"),
                ([wheel, "--velocity", "1,nan"], USAGE, "capstan law: --velocity: expected 2 numbers"),
                ([wheel, "--force", "1;2"], USAGE, "capstan law: --force: expected 2 numbers"),
                ([wheel, "--velocity"], USAGE, "capstan law: option '--velocity' needs an argument"),
                ([wheel, "--velocity", "1e300,1"], USAGE, "capstan law: --velocity: expected 2 numbers separated by commas, at most 1e100"),
                ([wheel, "--velocity", "-", "--force", "-"], USAGE, "capstan law: '-' is given 2 times"),
                (["-", "--velocity", "-"], USAGE, "capstan law: '-' is given 2 times"),
                ([wheel, "--axes", "1,2"], USAGE, "capstan law: --axes goes with --plot"),
                (["/"], 4, "capstan: /: is a directory"),
                (["/dev/null"], 4, "capstan: /dev/null: is not a regular file"),
                (["missing.yaml"], 4, "capstan: missing.yaml: cannot open: No such file"),
                ([sys.executable], INPUT, f"capstan: {sys.executable}:1:1: found a control character (byte 0x7f)"),
                ([wheel, "--plot", "x.svg", "--axes", "1,1"], USAGE, "capstan law: --axes: found '1,1'"),
                ([wheel, "--output", "x"], USAGE, "capstan law: unknown option '--output'")]:
            got, out, err = self.run(*arguments)
            self.expect(" ".join(arguments), got == code and err.startswith(wanted) and not out, f"exit {got}: {err}")
        for text, wanted in [("1,2\n1,x\n", "2: expected 2 numbers"), ("", " found no rows"), ("vx,vy\n# none\n", " found no rows"),
                             ("nan,nan\n", "1: expected 2 numbers"), ("vx\n1,2\n", "1: expected 2 numbers"),
                             ("vx,vy,vz\n1,2\n", "1: expected 2 numbers"), ("1,2\n3\n", "2: expected 2 numbers"),
                             ("1;2\n", "1: expected 2 numbers"), ("\x7fELF\x02\n", "1: expected 2 numbers"), ("1,2\0\n", "1: a zero byte")]:
            got, out, err = self.run(wheel, "--velocity", "-", text=text)
            self.expect(f"CSV {text!r}", got == INPUT and err.startswith(f"capstan: standard input:{wanted}") and not out, f"exit {got}: {err}")


    def pictures(self, wheel):
        """what cannot be written leaves what was there, and nothing beside it"""
        folder = os.path.join(self.folder, "pictures")
        picture = os.path.join(folder, "law.svg")
        os.mkdir(folder)

        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))

        for earlier in (None, "an earlier picture"):
            if earlier:
                with open(picture, "w", encoding="utf-8") as file:
                    file.write(earlier)
            os.environ["GCOV_PREFIX"] = folder + "-counts"  # a program built for coverage has no space for its counts either
            code, _, err = self.run(wheel, "--plot", picture, before=small_files)
            del os.environ["GCOV_PREFIX"]
            self.expect("no space", code == 4 and err == f"capstan: {picture}: cannot write: File too large\n", f"exit {code}: {err}")
            self.expect("nothing beside", os.listdir(folder) == (["law.svg"] if earlier else []), os.listdir(folder))
        with open(picture, encoding="utf-8") as file:
            self.expect("earlier picture kept", file.read() == earlier, "changed")
        code, _, err = self.run(wheel, "--plot", picture)
        with open(picture, encoding="utf-8") as file:
            self.expect("replaced", code == OK and file.read().endswith("</svg>\n") and os.listdir(folder) == ["law.svg"], err)
        for path, reason in [("/dev/full", "No space left on device"), (folder, "Is a directory"), ("/proc/law.svg", ""),
                             (os.path.join(folder, "law.svg", "below.svg"), "Not a directory")]:
            code, _, err = self.run(wheel, "--plot", path)
            self.expect(path, code == 4 and err.startswith(f"capstan: {path}: cannot write: {reason}"), f"exit {code}: {err}")
        code, out, err = self.run(wheel, "--plot", "/dev/stdout")
        self.expect("to a pipe", code == OK and out.endswith("</svg>\n") and os.path.islink("/dev/stdout"), f"exit {code}: {err}")


def write(folder):
    for i, (_, contents, _) in enumerate(CASES):
        with open(os.path.join(folder, f"bad{i}.yaml"), "w", encoding="utf-8") as file:
            file.write(contents)
    return 0


def main():
    if sys.argv[1] == "--write":
        return write(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder:
        suite = Suite(sys.argv[1], folder)
        for case in CASES:
            suite.bad(*case)
        suite.usage(os.path.join(sys.argv[2], "braked-wheel.yaml"))
        suite.pictures(os.path.join(sys.argv[2], "braked-wheel.yaml"))
        suite.answers(sys.argv[2])
        print(f"{suite.count} cases, {suite.failed} failed")
        return 0 if is_told(suite.count) and not suite.failed else 1


if __name__ == "__main__":
    sys.exit(main())
