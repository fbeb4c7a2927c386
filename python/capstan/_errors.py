# SPDX-License-Identifier: BSD-3-Clause
"""Errors of the library as exceptions, with its own words."""
from __future__ import annotations

from typing import Any, NamedTuple, NoReturn, Optional

from ._native import ffi, lib


class Place(NamedTuple):
    """Where in a file an error lies; line and column count from 1 and are 0 where the whole file is meant."""

    file: str
    line: int
    column: int


class Error(Exception):
    """What the library refuses or cannot do.

    Attributes:
        code:  name of the status, as ``"CPS_ERR_INPUT"``.
        path:  the place in the file as ``(file, line, column)``, or None where no file is concerned.
        where: the place in the scene by the names of a scene file, as ``"lines.cable.length"``; or empty.
    """

    code = ""

    def __init__(self, message: str, path: Optional[Place] = None, where: str = "", code: str = "") -> None:
        super().__init__(message)
        self.message, self.path, self.where = message, path, where
        self.code = code or self.code

    def __str__(self) -> str:
        if self.path is None:
            return self.message
        file, line, column = self.path
        return f"{file}:{line}:{column}: {self.message}" if line else f"{file}: {self.message}"

    def __reduce__(self) -> Any:
        return type(self), (self.message, self.path, self.where, self.code)


class ArgumentError(Error, ValueError):
    """A value is outside what the call accepts."""

    code = "CPS_ERR_ARGUMENT"


class InputError(Error, ValueError):
    """A scene, law or driven system is not valid."""

    code = "CPS_ERR_INPUT"


class FileError(Error):
    """A file cannot be read or written."""

    code = "CPS_ERR_IO"


class LimitError(Error):
    """Something is larger than a limit allows."""

    code = "CPS_ERR_LIMIT"


class OutOfMemory(Error, MemoryError):
    """There is not enough memory."""

    code = "CPS_ERR_MEMORY"


class NoAnswer(Error, ArithmeticError):
    """A question has no answer; `outcome` says why, as ``"unbounded"``."""

    code = "NO_ANSWER"

    def __init__(self, message: str, outcome: str = "") -> None:
        super().__init__(message)
        self.outcome = outcome

    def __reduce__(self) -> Any:
        return type(self), (self.message, self.outcome)


_KINDS = {kind.code: kind for kind in (ArgumentError, InputError, FileError, LimitError, OutOfMemory)}


def text(chars: Any) -> str:
    """A string of C; bytes that are no UTF-8 are escaped."""
    return "" if chars == ffi.NULL else ffi.string(chars).decode("utf-8", "backslashreplace")


def fail(status: int, err: Any) -> NoReturn:
    """Raise the exception of a status that is not CPS_OK."""
    code = text(lib.cps_status_name(status))
    kind = _KINDS.get(code, Error)
    file = text(err.file)
    path = Place(file, err.line, err.column) if file else None
    raise kind(text(err.message) or text(lib.cps_status_text(status)), path, text(err.where), code)


def check(status: int, err: Any) -> None:
    """Raise the exception of a status, if it has one."""
    if status != lib.CPS_OK:
        fail(status, err)
