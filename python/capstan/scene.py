# SPDX-License-Identifier: BSD-3-Clause
"""Scenes: lines, points, bodies and obstacles with the history of their changes.

A scene is read from YAML, or made of dictionaries, or of the objects below, whose keyword arguments are the keys of a
scene file (docs/formats.md). In each case it is the library's own reader that checks it: there is one list of keys."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, Dict, Iterator, List, Mapping, Optional, Union

from . import _netcdf, _yaml
from ._errors import ArgumentError, FileError, Place, check, text
from ._native import ffi, lib
from ._schema import documented

_TEXT = "<scene>"


class _Keys:
    """A mapping of a scene file: keyword arguments are its keys; they can be read and set as attributes too."""

    def __init__(self, **keys: Any) -> None:
        object.__setattr__(self, "_keys", dict(keys))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        try:
            return self.__dict__["_keys"][name]
        except KeyError:
            raise AttributeError(f"{type(self).__name__} has no {name!r} yet") from None

    def __setattr__(self, name: str, value: Any) -> None:
        self._keys[name] = value

    def __delattr__(self, name: str) -> None:
        del self._keys[name]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Keys) and self.to_tree() == other.to_tree()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        inside = ", ".join(f"{key}={value!r}" for key, value in self._keys.items())
        return f"{type(self).__name__}({inside})"

    def to_tree(self) -> Dict[str, Any]:
        """The mapping as dictionaries, lists and values."""
        return _yaml.plain(self._keys, type(self).__name__)


@documented("line")
class Line(_Keys):
    """A line from its end A to its end B.

    >>> Line(length=10.0, mass=2, stiffness=1e6, start="static",
    ...      ends={"A": {"held": [0, 0, 0]}, "B": {"held": [8, 0, 0]}}).length
    10.0
    """


@documented("point")
class Point(_Keys):
    """A point where lines meet: `held`, or `free`, or on a `body`, with its `weight`, `force` and so on."""


@documented("body")
class Body(_Keys):
    """A rigid body that lines hold: `held` or `free`, with `mass`, `buoyancy`, `hydrostatics` and so on."""


@documented("obstacle")
class Obstacle(_Keys):
    """A surface (`plane`, `cylinder`, `sphere`, `box`, `mesh`, ..) with its `friction`: a number, or a `Friction`.

    >>> Obstacle(plane={}, friction=Friction(axial=0.6, lateral=0.8)).to_tree()
    {'plane': {}, 'friction': {'axial': 0.6, 'lateral': 0.8}}
    """


@documented("friction")
class Friction(_Keys):
    """Friction that depends on direction: `axial`, `lateral`, `shape` and `grain`; or `set`, which may be a `Set`."""


@documented("scene")
class Scene:
    """Lines, obstacles and loads, and the history of their changes.

    Keyword arguments are the top keys of a scene file: ``lines``, ``obstacles``, ``points``, ``bodies`` (dictionaries
    by name), ``history`` (a list), ``gravity`` and so on. ``capstan: 1``, the version of the format, need not be given.

    >>> scene = Scene(obstacles={"floor": Obstacle(plane={}, friction=0.5)},
    ...     lines={"rope": Line(length=2, mass=1, stiffness=1e4, elements=10,
    ...         start={"straight": {"from": [0, 0, 0], "to": [2, 0, 0]}}, ends={"A": "free", "B": "free"})},
    ...     history=[{"name": "pull", "rope.B": {"force": [3, 0, 0]}}])
    >>> scene.check()
    >>> print(scene.to_yaml().splitlines()[0])
    capstan: 1
    """

    def __init__(self, **keys: Any) -> None:
        self._tree: Optional[Dict[str, Any]] = {"capstan": 1, **keys}
        self._text: Optional[bytes] = None
        self._name = _TEXT

    # ---- where scenes come from ----

    @classmethod
    def from_yaml(cls, yaml: Union[str, bytes], name: str = _TEXT) -> "Scene":
        """A scene of a YAML text. `name` stands for the file in messages, and files that it names lie beside it."""
        if not isinstance(yaml, (str, bytes)):
            raise ArgumentError(f"yaml: found {type(yaml).__name__}, expected a text")
        scene = cls()
        scene._tree, scene._name = None, os.fspath(name)
        scene._text = yaml.encode("utf-8", "surrogatepass") if isinstance(yaml, str) else yaml
        return scene

    @classmethod
    def read(cls, path: Union[str, "os.PathLike[str]"]) -> "Scene":
        """The scene of a file, checked."""
        name, out, err = os.fspath(path), ffi.new("CpsSceneFile **"), ffi.new("CpsError *")
        check(lib.cps_scene_read(os.fsencode(name), ffi.NULL, out, err), err)
        lib.cps_scene_file_destroy(out[0])
        try:
            return cls.from_yaml(Path(name).read_bytes(), name)
        except OSError as error:
            raise FileError(f"cannot open: {error.strerror}", Place(name, 0, 0)) from None

    @classmethod
    def from_dict(cls, tree: Mapping[str, Any]) -> "Scene":
        """A scene of a dictionary with the keys of a scene file."""
        if not isinstance(tree, Mapping):
            raise ArgumentError(f"tree: found {type(tree).__name__}, expected a dictionary")
        return cls(**{str(key): value for key, value in tree.items()})

    @classmethod
    def of(cls, source: "SceneLike") -> "Scene":
        """A scene of whatever one is made of: itself, a dictionary, a path, or a text of several lines of YAML."""
        if isinstance(source, Scene):
            return source
        if isinstance(source, Mapping):
            return cls.from_dict(source)
        if isinstance(source, bytes) or (isinstance(source, str) and "\n" in source):
            return cls.from_yaml(source)
        if isinstance(source, (str, os.PathLike)):
            return cls.read(source)
        raise ArgumentError(f"scene: found {type(source).__name__}, expected a Scene, a dictionary, a path or YAML")

    # ---- what it contains ----

    @property
    def tree(self) -> Dict[str, Any]:
        """The scene as a dictionary with the keys of a scene file. What is changed in it changes the scene.

        A scene that was read from YAML is written anew from then on: comments are gone, and messages tell positions
        in the text of `to_yaml`."""
        if self._tree is None:
            self.check()  # the reader's words, should it be no scene
            self._tree = _yaml.load(self._source().decode("utf-8"), self._name)
            self._text = None
        return self._tree

    def __getitem__(self, key: str) -> Any:
        return self.tree[key]

    def __setitem__(self, key: str, value: Any) -> None:
        self.tree[key] = value

    def __contains__(self, key: object) -> bool:
        return key in self.tree

    def __iter__(self) -> Iterator[str]:
        return iter(self.tree)

    def to_dict(self) -> Dict[str, Any]:
        """A copy of the scene as dictionaries, lists and values."""
        return _yaml.plain(self.tree)

    def to_yaml(self) -> str:
        """The scene as the text of a scene file, which `capstan run` takes; of a scene that was read, that text."""
        return _yaml.dump(self._tree) if self._tree is not None else self._source().decode("utf-8")

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Write a scene file."""
        Path(path).write_text(self.to_yaml(), encoding="utf-8")

    def copy(self) -> "Scene":
        """A scene of its own with the same contents."""
        made = Scene()
        made._name, made._text = self._name, self._text
        made._tree = None if self._tree is None else _yaml.plain(self._tree)
        return made

    def check(self) -> None:
        """Raise what the library finds wrong: InputError with file, line and column, and what to do."""
        self._file()

    def _source(self) -> bytes:
        return self._text if self._tree is None else _yaml.dump(self._tree).encode("utf-8", "surrogatepass")  # type: ignore

    def _file(self) -> Any:
        """The scene as the library reads it: a CpsSceneFile that is freed with this object."""
        out, err, source = ffi.new("CpsSceneFile **"), ffi.new("CpsError *"), self._source()
        if b"netcdf" in source:  # of a ground
            _netcdf.load_with_its_own()
        if b"\0" in source:
            raise ArgumentError("the scene's text contains a zero byte")
        check(lib.cps_scene_read_text(source, os.fsencode(self._name), ffi.NULL, out, err), err)
        return ffi.gc(out[0], lib.cps_scene_file_destroy)

    def __getstate__(self) -> Any:
        return {"_tree": None if self._tree is None else _yaml.plain(self._tree), "_text": self._text,
                "_name": self._name}

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Scene) and self.to_yaml() == other.to_yaml()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        if self._tree is None:
            return f"<Scene of {self._name}>"
        inside = ", ".join(f"{len(self._tree[key])} {key}" for key in ("lines", "points", "bodies", "obstacles", "history")
                           if self._tree.get(key))
        return f"<Scene: {inside or 'empty'}>"


SceneLike = Union[Scene, Mapping[str, Any], str, bytes, "os.PathLike[str]"]


def names_of(scene: Any) -> Dict[str, List[str]]:
    """The names of lines, points, bodies and obstacles of a CpsScene, in the order of their indices."""
    return {"lines": [text(scene.line[i].name) for i in range(scene.line_count)],
            "points": [text(scene.point[i].name) for i in range(scene.point_count)],
            "bodies": [text(scene.body[i].name) for i in range(scene.body_count)],
            "obstacles": [text(scene.obstacle[i].name) for i in range(scene.obstacle_count)]}
