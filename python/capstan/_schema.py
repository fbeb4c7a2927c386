# SPDX-License-Identifier: BSD-3-Clause
"""The keys of scene files, as the library's reader has them: its JSON schema."""
from __future__ import annotations

import functools
import inspect
import json
import tempfile
from typing import Any, Dict

from ._errors import check
from ._native import ffi, lib


@functools.lru_cache(maxsize=None)
def scene_schema() -> Dict[str, Any]:
    """The JSON schema of scenes; what `capstan schema` prints."""
    err = ffi.new("CpsError *")
    with tempfile.TemporaryFile("w+b") as file:
        check(lib.cps_scene_write_schema(file, err), err)
        file.seek(0)
        return json.loads(file.read())


def documented(kind: str) -> Any:
    """A class whose keyword arguments are the keys of a mapping of scene files: its signature and its help list them."""
    def decorate(cls: type) -> type:
        keys = scene_schema()["$defs"][kind]["properties"]
        given = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None) for name in keys if name.isidentifier()]
        cls.__signature__ = inspect.Signature(given)  # type: ignore[attr-defined]
        rows = [f"    {name + ':':18} {what.get('description', 'a mapping, or a ' + kind)}" for name, what in keys.items()]
        cls.__doc__ = f"{cls.__doc__.rstrip()}\n\n" + "\n".join(rows) + "\n" if cls.__doc__ else None
        return cls
    return decorate
