"""Numbers that are taken in several forms."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def floats(name: str, value: ArrayLike, shape: tuple[int, ...]) -> Any:
    """Nested lists of numbers, of that shape."""
    array = np.asarray(value, dtype=float)
    if array.shape != shape:
        raise ValueError(f"{name}: expected shape {shape}, found {array.shape}")
    return array.tolist()


def for_each_joint(name: str, value: ArrayLike | None, joints: int) -> list[float] | None:
    """A number for each joint, of one for all of them or of as many."""
    if value is None:
        return None
    array = np.asarray(value, dtype=float)
    if array.ndim and array.shape != (joints,):
        raise ValueError(f"{name}: expected one number or shape ({joints},), found {array.shape}")
    numbers: list[float] = np.broadcast_to(array, (joints,)).tolist()
    return numbers


def wrench_of(name: str, value: ArrayLike) -> list[float]:
    """``[f; n]``, of a force alone or of both."""
    array = np.asarray(value, dtype=float)
    if array.shape not in ((3,), (6,)):
        raise ValueError(f"{name}: expected shape (3,) or (6,), found {array.shape}")
    numbers: list[float] = np.concatenate([array, np.zeros(6 - len(array))]).tolist()
    return numbers
