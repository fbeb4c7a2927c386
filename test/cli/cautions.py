# SPDX-License-Identifier: BSD-3-Clause
"""What capstan run says by itself of the examples of S90 annex 6.                usage: cautions.py CAPSTAN EXAMPLES"""
import os
import subprocess
import sys
import tempfile

CAPSTAN, EXAMPLES = sys.argv[1:]
BOUND, LIFTED, SUNK = "differ from mu R", "has left the obstacle", "inside the obstacle"

# example, what must be said with its figure, what must not be said
CASES = (
    ("11-1", {BOUND: "of 0.15 N in all", SUNK: "0.625 m"}, [LIFTED]),  # all of the bed's line is carried by the hanging part
    ("11-2", {BOUND: "0.399 N, of 0.399 N", LIFTED: "0.399 N"}, [SUNK]),  # mu w l less half an element at the held end
    ("11-3", {BOUND: "0.399 N, of 0.399 N", LIFTED: "of 0.399 N in all"}, [SUNK]),
)
faults = []


def run(folder, scene, *more):
    done = subprocess.run([CAPSTAN, "run", scene, "-o", os.path.join(folder, "out"), *more], capture_output=True, text=True,
                          timeout=60)
    if done.returncode:
        faults.append(f"{scene}: exit code {done.returncode}: {done.stderr}")
    return [line for line in done.stderr.splitlines() if "caution" in line]


with tempfile.TemporaryDirectory() as folder:
    for name, said, unsaid in CASES:
        path = os.path.join(EXAMPLES, f"souza-de-cursi-1990-example-{name}.yaml")
        lines = run(folder, path)
        for words, figure in said.items():
            if not any(words in line and figure in line for line in lines):
                faults.append(f"{name}: '{words}' with '{figure}' not in {lines}")
        faults += [f"{name}: '{words}' in {lines}" for words in unsaid if any(words in line for line in lines)]
        if run(folder, path, "--quiet"):
            faults.append(f"{name}: cautions in spite of --quiet")

        # the cure that is offered: nothing is left to say
        with open(path, encoding="utf-8") as file:
            text = file.read().replace("friction: frozen", "friction: consistent").replace("contact: strict", "contact: gained")
        cured = os.path.join(folder, "cured.yaml")
        with open(cured, "w", encoding="utf-8") as file:
            file.write(text)
        if lines := run(folder, cured):
            faults.append(f"{name}, consistent: {lines}")

print("\n".join(faults) or "cautions: said with their figures, and only there")
sys.exit(1 if faults else 0)
