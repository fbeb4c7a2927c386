# SPDX-License-Identifier: BSD-3-Clause
"""Scenes that differ from a good one by one change, each of which `capstan check` refuses with its place and its message."""
import os
import subprocess
import tempfile


def check(capstan, path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    done = subprocess.run([capstan, "check", path], capture_output=True, text=True, timeout=60, check=False)
    return done.returncode, done.stdout, done.stderr


def write_bad(folder, name, good, changes):
    """One file for each change that is refused, to begin fuzzing with."""
    for i, (_, old, new, _) in enumerate(changes):
        with open(os.path.join(folder, f"bad-{name}-{i}.yaml"), "w", encoding="utf-8") as file:
            file.write(good.replace(old, new))


def one_change_each(capstan, good, accepted, changes):
    """What `capstan check` prints of a good scene with replacements (replacements, wanted), and that each scene that differs from it by one
    change (name, old, new, place and message) is refused in one line. Returns how many fail."""
    failed = 0
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.yaml")
        for replaced, wanted in accepted:
            text = good
            for old, new in replaced:
                assert text.count(old) == 1, old
                text = text.replace(old, new)
            code, out, err = check(capstan, path, text)
            if code != 0 or wanted not in out or err:
                failed += 1
                print(f"FAILED {replaced}: exit {code}: {err}{out}")
        for name, old, new, fragment in changes:
            assert good.count(old) == 1, name
            code, out, err = check(capstan, path, good.replace(old, new))
            if code != 3 or out or not err.startswith(f"capstan: {path}:{fragment}") or err.count("\n") != 1:
                failed += 1
                print(f"FAILED {name}\n  expected {fragment}\n  found exit {code}: {err}{out}")
    return failed
