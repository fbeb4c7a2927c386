# SPDX-License-Identifier: BSD-3-Clause
"""Reports of the library, which are structs of C, as objects with attributes.

The fields, their units and their meaning are those of the public headers (include/capstan/step.h, point.h, body.h).
A value that may be missing, which has a flag `has_x` there, is None without it; an enumeration is its word in lower
case (``"solved"``); arrays are numpy arrays that cannot be written to."""
from __future__ import annotations

import functools
import os
from typing import Any, Dict, Iterator, List, Mapping, Optional, Tuple

import numpy as np

from ._errors import text
from ._native import ffi

_NUMBERS: Dict[str, Any] = {"double": np.float64, "int": np.int32, "_Bool": np.bool_, "unsigned char": np.uint8}


@functools.lru_cache(maxsize=None)
def enum_words(kind: Any) -> Dict[int, str]:
    """The words of an enumeration: what its constants do not have in common, in lower case."""
    names = list(kind.elements.values())
    common = os.path.commonprefix(names)
    cut = common.rfind("_") + 1
    return {value: name[cut:].lower() for value, name in kind.elements.items()}


def enum_value(kind: str, word: str) -> int:
    """The constant of a word; ValueError names the words that there are."""
    words = enum_words(ffi.typeof(kind))
    for value, name in words.items():
        if isinstance(word, str) and name == word:
            return value
    raise ValueError(f"found {word!r}, expected one of {', '.join(words.values())}")


def enum_word(kind: str, value: int) -> str:
    return enum_words(ffi.typeof(kind))[value]


@functools.lru_cache(maxsize=None)
def _fields(kind: Any) -> Tuple[Dict[str, Any], List[str]]:
    """The fields that are shown, with their types; and those among them that are texts of the library."""
    shown: Dict[str, Any] = {}
    texts = []
    for name, field in kind.fields:
        if field.type.kind == "pointer":
            if field.type.item.cname != "char":
                continue
            texts.append(name)
        if name != "cookie":
            shown[name] = field.type
    return shown, texts


class Record:
    """A report of the library: attributes with the names of its header, of which dir() is the list.

    It is a copy and does not change."""

    __slots__ = ("_c", "_keep", "_texts", "_arrays")

    def __init__(self, c: Any, keep: Any = None, arrays: Optional[Mapping[str, Tuple[int, ...]]] = None) -> None:
        # texts belong to the library and may change with the next step: they are taken now
        self._c, self._keep = c, keep
        self._texts = {name: text(getattr(c, name)) for name in _fields(_struct(c))[1]}
        # so do arrays of which the caller knows the shapes
        self._arrays = {name: _copied(getattr(c, name), shape) for name, shape in (arrays or {}).items()}

    def __getattr__(self, name: str) -> Any:
        if name in self._arrays:
            return self._arrays[name]
        kind = _fields(_struct(self._c))[0].get(name)
        if kind is None:
            raise AttributeError(f"{_named(self._c)} has no {name!r}: it has {', '.join(dir(self))}")
        if name in self._texts:
            return self._texts[name]
        flag = "has_" + name
        if flag in _fields(_struct(self._c))[0] and not getattr(self._c, flag):
            return None
        return self._value(getattr(self._c, name), kind)

    def _value(self, value: Any, kind: Any) -> Any:
        if kind.kind == "enum":
            return enum_words(kind).get(value, value)
        if kind.kind == "struct":
            return Record(value, self)
        if kind.kind == "array":
            if kind.item.cname == "char":
                return text(value)
            dtype = _NUMBERS.get(kind.item.cname)
            if dtype is None:
                return tuple(self._value(item, kind.item) for item in value)
            made: np.ndarray = np.frombuffer(ffi.buffer(value), dtype=dtype).copy()
            made.flags.writeable = False
            return made
        return value

    def __dir__(self) -> List[str]:
        fields = _fields(_struct(self._c))[0]
        return [name for name in fields if not (name.startswith("has_") and name[4:] in fields)] + list(self._arrays)

    def __iter__(self) -> Iterator[Tuple[str, Any]]:
        return ((name, getattr(self, name)) for name in dir(self))

    def to_dict(self) -> Dict[str, Any]:
        """All values, inner reports as dictionaries."""
        return {name: _plain(value) for name, value in self}

    def __repr__(self) -> str:
        inside = ", ".join(f"{name}={_short(value)}" for name, value in self)
        return f"{_named(self._c)}({inside})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and _same(self.to_dict(), other.to_dict())

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        raise TypeError("a report cannot be pickled or copied: take to_dict()")


def _copied(pointer: Any, shape: Tuple[int, ...]) -> Optional[np.ndarray]:
    if pointer == ffi.NULL:
        return None
    made: np.ndarray = np.frombuffer(ffi.buffer(pointer, 8 * int(np.prod(shape))), np.float64).reshape(shape).copy()
    made.flags.writeable = False
    return made


def _struct(c: Any) -> Any:
    kind = ffi.typeof(c)
    return kind.item if kind.kind == "pointer" else kind


def _named(c: Any) -> str:
    return _struct(c).cname.rpartition("Cps")[2]


def _plain(value: Any) -> Any:
    if isinstance(value, Record):
        return value.to_dict()
    return tuple(_plain(item) for item in value) if isinstance(value, tuple) else value


def _same(a: Any, b: Any) -> bool:
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(_same(a[key], b[key]) for key in a)
    if isinstance(a, tuple):
        return len(a) == len(b) and all(map(_same, a, b))
    return np.array_equal(a, b)


def _short(value: Any) -> str:
    if isinstance(value, Record):
        return f"<{_named(value._c)}>"
    if isinstance(value, tuple):
        return f"({', '.join(_short(item) for item in value)})"
    if isinstance(value, np.ndarray):
        return f"<{' x '.join(map(str, value.shape))} array>" if value.size > 6 else str(value.tolist())
    return f"{value:.6g}" if isinstance(value, float) else repr(value)
