#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The JSON schema of scenes: valid JSON, complete references, every key documented; the examples are accepted.

usage: schema.py CAPSTAN SOURCE_FOLDER

Where the Python packages jsonschema and yaml are installed, the examples are also validated against the schema, and
scenes that the schema must refuse are tried.
"""
import copy
import glob
import json
import os
import re
import subprocess
import sys

EXAMPLES = ["souza-de-cursi-1990.yaml", "souza-de-cursi-1990-half-circle.yaml", "souza-de-cursi-1990-circle.yaml",
            "oc3-hywind-line.yaml"]


def output(*command):
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout.decode()


def references(value):
    """all "$ref" below a value"""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key == "$ref":
                yield inner
            yield from references(inner)
    elif isinstance(value, list):
        for inner in value:
            yield from references(inner)


def check_schema(schema, documentation):
    definitions = schema["$defs"]
    used = set(references(schema))
    assert used == {f"#/$defs/{name}" for name in definitions}, used
    for name, definition in definitions.items():
        assert definition["additionalProperties"] is False, name
        assert set(definition["required"]) <= set(definition["properties"]), name
        for key, row in definition["properties"].items():
            assert row["description"], key
            assert re.search(f"`[^`]*\\b{key}\\b[^`]*`", documentation), f"docs/formats.md does not mention `{key}` of {name}"
    for pattern in (p for d in definitions.values() for p in d["patternProperties"]):
        assert re.match(pattern, "cable.B" if "AB" in pattern else "cable") and not re.match(pattern, "9"), pattern


def check_validation(schema, folder):
    try:
        import jsonschema
        import yaml
    except ImportError:
        print("jsonschema or yaml is not installed: examples not validated")
        return
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    for name in EXAMPLES:
        with open(os.path.join(folder, name)) as f:
            scene = yaml.safe_load(f)
        # PyYAML follows YAML 1.1, where 384.243e6 is a text
        for line in scene["lines"].values():
            line["stiffness"] = float(line["stiffness"])
        errors = [e.message for e in validator.iter_errors(scene)]
        assert not errors, (name, errors)

    changes = [("capstan", 2), ("lines", []), ("gravity", [0, 0]), ("contact", "lost"), ("unknown", 1),
               ("history", [{"steps": 0}]), ("history", [{"cable.C": {}}]), ("history", [{"cable.B": {}}]),
               ("obstacles", {"bed": {}}), ("solver", {"tolerance": 1})]
    for key, value in changes:
        bad = copy.deepcopy(scene)
        bad[key] = value
        assert not validator.is_valid(bad), (key, value)
    for key, value in [("length", 0), ("elements", 0), ("elements", [[0, 1]]), ("mass", 1), ("start", "flat"), ("ends", {})]:
        bad = copy.deepcopy(scene)
        bad["lines"]["mooring"][key] = value
        assert not validator.is_valid(bad), (key, value)


def main():
    capstan, source = sys.argv[1:]
    with open(os.path.join(source, "docs", "formats.md")) as f:
        documentation = f.read()
    schema = json.loads(output(capstan, "schema"))
    check_schema(schema, documentation)

    folder = os.path.join(source, "examples")
    found = {os.path.basename(path) for path in glob.glob(os.path.join(folder, "*.yaml"))}
    assert found >= set(EXAMPLES), found
    for name in sorted(found):
        assert "The scene is valid." in output(capstan, "check", os.path.join(folder, name)), name
    check_validation(schema, folder)
    print(f"schema with {len(schema['$defs'])} definitions, {len(found)} examples: good")


if __name__ == "__main__":
    main()
