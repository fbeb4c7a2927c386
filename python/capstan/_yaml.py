# SPDX-License-Identifier: BSD-3-Clause
"""A tree of dictionaries, lists and values as YAML 1.2, and back. What it means is decided by the C reader alone."""
from __future__ import annotations

import json
import math
import re
from typing import Any, Dict, List, Mapping, Union

import numpy as np

from ._errors import ArgumentError, InputError, Place

# a word that no YAML reader takes for anything else
_PLAIN = re.compile(r"[A-Za-z][A-Za-z0-9_.-]*(?: [A-Za-z0-9_.-]+)*")
_WORDS = {"true", "false", "null", "yes", "no", "on", "off", "y", "n"}
_WIDTH = 100


def plain(value: Any, what: str = "scene") -> Any:
    """The value as dictionaries, lists, texts, numbers and truth values; objects with `to_tree` are asked for theirs."""
    if hasattr(value, "to_tree"):
        return plain(value.to_tree(), what)
    if isinstance(value, Mapping):
        bad = [key for key in value if not isinstance(key, str)]
        if bad:
            raise ArgumentError(f"{what}: found the key {bad[0]!r}, expected a text")
        return {key: plain(item, f"{what}.{key}") for key, item in value.items()}
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [plain(item, what) for item in value]
    if isinstance(value, (np.bool_, np.integer, np.floating)):
        value = value.item()
    if isinstance(value, (bool, int, float, str)):
        return value
    raise ArgumentError(f"{what}: found {value!r:.60}, expected a number, a text, a list or a mapping")


def _text(value: str) -> str:
    simple = _PLAIN.fullmatch(value) and value.lower() not in _WORDS
    if simple:
        return value
    # what YAML takes for a control character or the end of a line is escaped
    return re.sub("[\x7f-\x9f\u2028\u2029\ufeff]", lambda found: f"\\u{ord(found[0]):04x}", json.dumps(value, ensure_ascii=False))


def _scalar(value: Union[bool, int, float, str]) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        if math.isnan(value):
            return ".nan"
        if math.isinf(value):
            return ".inf" if value > 0 else "-.inf"
    return _text(value) if isinstance(value, str) else repr(value)


def _flow(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_text(key)}: {_flow(item)}" for key, item in value.items()) + "}"
    return "[" + ", ".join(map(_flow, value)) + "]" if isinstance(value, list) else _scalar(value)


def _lines(value: Any, indent: str) -> List[str]:
    """The value in block style, with what is short on one line."""
    made = []
    pairs = value.items() if isinstance(value, dict) else ((None, item) for item in value)
    for key, item in pairs:
        head = indent + ("-" if key is None else _text(key) + ":")
        short = f"{head} {_flow(item)}"
        if not isinstance(item, (dict, list)) or not item or len(short) <= _WIDTH:
            made.append(short)
        else:
            made += [head] + _lines(item, indent + "  ")
    return made


def dump(tree: Dict[str, Any]) -> str:
    """The tree as a YAML text. Numbers are written so that they are read back unchanged."""
    return "\n".join(_lines(plain(tree), "")) + "\n"


def load(text: str, name: str) -> Any:
    """The tree of a YAML text, with numbers by the YAML 1.2 core schema as the C reader takes them."""
    import yaml

    try:
        node = yaml.compose(text, Loader=yaml.BaseLoader)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark
        raise InputError(str(error.problem), Place(name, mark.line + 1, mark.column + 1) if mark else None) from None
    return _built(node) if node is not None else {}


def _built(node: Any) -> Any:
    if node.id == "mapping":
        return {key.value: _built(item) for key, item in node.value}
    if node.id == "sequence":
        return [_built(item) for item in node.value]
    return node.value if node.style else _resolved(node.value)


def _resolved(word: str) -> Any:
    """A plain scalar: a number, a truth value or a text."""
    if re.fullmatch(r"[-+]?[0-9]+", word):
        return int(word)
    if re.fullmatch(r"0x[0-9a-fA-F]+|0o[0-7]+", word):
        return int(word, 0)
    if re.fullmatch(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?", word):
        return float(word)
    if re.fullmatch(r"[-+]?\.(inf|Inf|INF)|\.(nan|NaN|NAN)", word):
        return float(word.replace(".", ""))
    return {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}.get(word, word)
