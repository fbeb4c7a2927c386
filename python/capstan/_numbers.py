# SPDX-License-Identifier: BSD-3-Clause
"""Values from Python as numbers of C: float64, contiguous, of the shape that is expected, or an exception."""
from __future__ import annotations

import math
from typing import Any, Optional, Tuple

import numpy as np

from ._errors import ArgumentError


def array(value: Any, shape: Tuple[Optional[int], ...], what: str, infinite: bool = False) -> np.ndarray:
    """`value` as a C-contiguous float64 array of this shape, where None stands for any size.

    Integers and real numbers of any size and stride are converted; texts, None, complex numbers and ragged lists are
    refused, as are NaN and, but where `infinite` says so, infinite numbers."""
    raw = _numeric(value, what)
    fits = raw.ndim == len(shape) and all(n is None or n == m for n, m in zip(shape, raw.shape))
    if not fits:
        wanted = " x ".join("any" if n is None else str(n) for n in shape)
        raise ArgumentError(f"{what}: found the shape {raw.shape}, expected {wanted}")
    made = np.ascontiguousarray(raw, dtype=np.float64)
    return _finite(made, what, infinite)


def rows(value: Any, n: int, what: str) -> np.ndarray:
    """`value` as a float64 array of vectors: any shape whose last dimension is n."""
    raw = _numeric(value, what)
    if raw.ndim == 0 or raw.shape[-1] != n:
        raise ArgumentError(f"{what}: found the shape {raw.shape}, expected (.., {n})")
    return _finite(np.ascontiguousarray(raw, dtype=np.float64), what, False)


def _numeric(value: Any, what: str) -> np.ndarray:
    try:
        raw = np.asarray(value)
    except (ValueError, TypeError) as error:
        raise ArgumentError(f"{what}: no array of numbers ({error})") from None
    if raw.dtype.kind not in "iuf":
        raise ArgumentError(f"{what}: found {_named(value, raw)}, expected numbers")
    return raw


def _finite(made: np.ndarray, what: str, infinite: bool) -> np.ndarray:
    if np.isnan(made).any() or not (infinite or np.isfinite(made).all()):
        raise ArgumentError(f"{what}: found a number that is not finite")
    return made


def number(value: Any, what: str, infinite: bool = False) -> float:
    """A real number; an infinite one only where that is allowed."""
    raw = np.asarray(value) if not isinstance(value, (list, dict)) else np.empty(2)
    if raw.ndim != 0 or raw.dtype.kind not in "iuf":
        raise ArgumentError(f"{what}: found {_named(value, raw)}, expected a number")
    made = float(raw)
    if math.isnan(made) or (math.isinf(made) and not infinite):
        raise ArgumentError(f"{what}: found {made}, expected a finite number")
    return made


def count(value: Any, what: str, least: int = 0, most: int = 2**31 - 1) -> int:
    """A whole number within a range."""
    raw = np.asarray(value) if not isinstance(value, (list, dict)) else np.empty(2)
    if raw.ndim != 0 or raw.dtype.kind not in "iu":
        raise ArgumentError(f"{what}: found {_named(value, raw)}, expected a whole number")
    if not least <= int(raw) <= most:
        raise ArgumentError(f"{what}: found {int(raw)}, expected {least} to {most}")
    return int(raw)


def _named(value: Any, raw: np.ndarray) -> str:
    if value is None or isinstance(value, (str, bytes, bool)):
        return repr(value)[:60]
    return f"{type(value).__name__} of {raw.dtype}"
