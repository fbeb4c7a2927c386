#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The JSON schemas of scenes, laws and driven systems: valid JSON, complete references, every key documented; the examples are accepted.

usage: schema.py CAPSTAN SOURCE_FOLDER

Where the Python packages jsonschema and yaml are installed, the examples are also validated against the schemas, and
scenes that the schema must refuse are tried, and all that bad_laws.py and bad_drives.py try.
"""
import copy
import glob
import json
import os
import re
import subprocess
import sys

sys.dont_write_bytecode = True  # nothing is left in the source folder
import bad_drives  # noqa: E402
import bad_laws  # noqa: E402

# definitions that scenes share with laws
OF_SETS = {"set", "contact"}
EXAMPLES = ["barge.yaml", "moved-bollard.yaml", "bridle.yaml", "buoy.yaml", "catenary-moored-buoy.yaml", "bollard-and-rail.yaml", "souza-de-cursi-1990-c2.yaml", "chain-wire-chain.yaml", "taut-leg.yaml", "parting-lines.yaml", "dropped-chain.yaml", "souza-de-cursi-1990.yaml", "souza-de-cursi-1990-half-circle.yaml",
            "souza-de-cursi-1990-circle.yaml", "oc3-hywind.yaml", "oc3-hywind-decay.yaml", "oc3-hywind-line.yaml", "grooved-slope.yaml", "rough-end.yaml"]


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


def check_definitions(schema, documentation):
    """every definition is used and is a mapping with keys, each of which is described here and in docs/formats.md"""
    definitions = schema["$defs"]
    assert set(references(schema)) == {f"#/$defs/{name}" for name in definitions}, set(references(schema))
    mappings = dict(definitions)
    for name, mapping in definitions.items():  # the words of laws that have keys, and mappings from names
        mappings |= {f"{name} {key}": row for key, row in mapping.get("properties", {}).items() if row.get("additionalProperties") is False}
    for name, mapping in mappings.items():
        assert mapping["additionalProperties"] is False and mapping.keys() & {"properties", "patternProperties"}, name
        assert set(mapping.get("required", [])) <= set(mapping["properties"] if "properties" in mapping else []), name
        for key, row in mapping.get("properties", {}).items():
            assert row["description"], (name, key)
            assert re.search(f"`[^`]*\\b{key}\\b[^`]*`", documentation), f"docs/formats.md does not mention `{key}` of {name}"
        for pattern, row in mapping.get("patternProperties", {}).items():
            form = re.search(r"\((\w+)", pattern)
            example = {"A": "cable.B", "turn": "drum.turn", "pay_out_A": "cable.pay_out_A", "point": "knot.point", "body": "spar.body", "node": "cable.node", "obstacle": "post.obstacle"}[form[1]] if form else "cable"
            assert re.match(pattern, example) and not re.match(pattern, "9"), (name, pattern)
    return mappings


def core_loader():
    """YAML 1.2's core schema, in which `on` is a text; PyYAML follows YAML 1.1"""
    import yaml

    class Core(yaml.SafeLoader):
        pass

    boolean = "tag:yaml.org,2002:bool"
    Core.yaml_implicit_resolvers = {first: [(tag, form) for tag, form in resolvers if tag != boolean]
                                    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}
    Core.add_implicit_resolver(boolean, re.compile("^(?:true|false)$"), list("tf"))
    return Core


def check_words_validation(schema, folder, cases, beyond):
    """every file of the folder is valid; of the bad ones (name, contents) those that are beyond a schema, and no others"""
    try:
        import jsonschema
        import yaml
    except ImportError:
        return 0
    jsonschema.Draft202012Validator.check_schema(schema)
    validator, loader = jsonschema.Draft202012Validator(schema), core_loader()
    paths = sorted(glob.glob(os.path.join(folder, "*.yaml")))
    assert paths, folder
    for path in paths:
        with open(path) as f:
            errors = [e.message for e in validator.iter_errors(yaml.load(f, loader))]
        assert not errors, (path, errors)
    assert beyond <= {name for name, _ in cases}, beyond - {name for name, _ in cases}
    for name, text in cases:
        try:
            bad = yaml.load(text, loader)
        except yaml.YAMLError:
            continue  # two documents, no YAML at all
        accepted = validator.is_valid(bad)
        assert accepted == (name in beyond), f"{name}: the schema {'accepts' if accepted else 'refuses'} it"
    return len(paths)


def with_numbers(value):
    """PyYAML follows YAML 1.1, where 384.243e6 is a text; texts of that form are numbers here."""
    if isinstance(value, dict):
        return {key: with_numbers(inner) for key, inner in value.items()}
    if isinstance(value, list):
        return [with_numbers(inner) for inner in value]
    return float(value) if isinstance(value, str) and re.fullmatch(r"[-+]?[0-9.]+e[-+]?[0-9]+", value) else value


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
            scene = yaml.load(f, core_loader())
        scene = with_numbers(scene)
        errors = [e.message for e in validator.iter_errors(scene)]
        assert not errors, (name, errors)

    changes = [("capstan", 2), ("lines", []), ("gravity", [0, 0]), ("contact_policy", "lost"), ("unknown", 1),
               ("history", [{"steps": 0}]), ("history", [{"cable.C": {}}]), ("history", [{"cable.B": {}}]),
               ("obstacles", {"bed": {}}), ("obstacles", {"bed": {"plane": {}, "friction": [1]}}),
               ("obstacles", {"pipe": {"cylinder": {}}}),
               ("obstacles", {"bed": {"plane": {}, "friction": {"set": {"disc": -1}}}}),
               ("obstacles", {"bed": {"plane": {}, "friction": {"set": {"disk": 1}}}}),
               ("obstacles", {"bed": {"plane": {}, "friction": {"set": {"disc": 1}, "axial": 1}}}),
               ("obstacles", {"bed": {"plane": {}, "friction": {"lateral": 1}}}), ("history", [{"drum.turn": "half"}]), ("solver", {"tolerance": 1})]
    for key, value in changes:
        bad = copy.deepcopy(scene)
        bad[key] = value
        assert not validator.is_valid(bad), (key, value)
    for key, value in [("length", 0), ("elements", 0), ("elements", [[0, 1]]), ("mass", 1), ("start", "flat"), ("ends", {}),
                       ("friction_zones", {}), ("friction_zones", [{"from": 0, "to": 1}]),
                       ("friction_zones", [{"from": -1, "to": 1, "factor": 1}])]:
        bad = copy.deepcopy(scene)
        next(iter(bad["lines"].values()))[key] = value
        assert not validator.is_valid(bad), (key, value)


def check_dictionary(schema, path):
    """The words with which law files are mutated are those of the schema: none is missing, none is of the past."""
    with open(path) as f:
        words = {line[1:].split(":")[0].rstrip('"\n') for line in f if line.startswith('"')}
    words = {word for word in words if word[:1].isalpha()}
    wanted = set(schema["$defs"]["set"]["properties"]) | set(schema["$defs"]["term"]["properties"])
    known = wanted | set(schema["$defs"]["file"]["properties"])
    assert wanted <= words <= known, (sorted(wanted - words), sorted(words - known))


def main():
    capstan, source = sys.argv[1:]
    with open(os.path.join(source, "docs", "formats.md")) as f:
        documentation = f.read()
    schema = json.loads(output(capstan, "schema"))
    scenes = check_definitions(schema, documentation)
    assert OF_SETS < set(scenes) and sum("patternProperties" in mapping for mapping in scenes.values()) == 6, scenes.keys()

    folder = os.path.join(source, "examples")
    found = {os.path.basename(path) for path in glob.glob(os.path.join(folder, "*.yaml"))}
    assert found >= set(EXAMPLES), found
    for name in sorted(found):
        assert "The scene is valid." in output(capstan, "check", os.path.join(folder, name)), name
    check_validation(schema, folder)

    law_schema = json.loads(output(capstan, "schema", "law"))
    assert {"file", "set", "contact", "term"} < set(check_definitions(law_schema, documentation))
    check_dictionary(law_schema, os.path.join(source, "test", "fuzz", "law.dict"))
    laws = check_words_validation(law_schema, os.path.join(folder, "laws"), [case[:2] for case in bad_laws.CASES],
                                  bad_laws.BEYOND_A_SCHEMA)
    drive_schema = json.loads(output(capstan, "schema", "drive"))
    assert len(set(check_definitions(drive_schema, documentation)) - OF_SETS - {"term"}) > 20, drive_schema["$defs"].keys()
    drives = check_words_validation(drive_schema, os.path.join(folder, "drive"), [case[:2] for case in bad_drives.FILES],
                                    bad_drives.BEYOND_A_SCHEMA)
    assert output(capstan, "schema") == output(capstan, "schema", "scene")
    refused = subprocess.run([capstan, "schema", "lines"], capture_output=True, text=True, check=False)
    assert refused.returncode == 2 and "expected scene, law or drive" in refused.stderr, refused
    print(f"schema of driven systems with {len(drive_schema['$defs'])} definitions, {drives} examples validated: good")
    print(f"schema of laws with {len(law_schema['$defs']['set']['properties'])} words, {laws} examples validated: good")
    print(f"schema with {len(schema['$defs'])} definitions, {len(found)} examples: good")


if __name__ == "__main__":
    main()
