"""Checks arrays of users and brings them into the form that the extension takes: float64 and
uint32, C order. Arrays that have it already, and int32 for uint32, are not copied."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._remesh import InvalidInput, InvalidOption

Floats = NDArray[np.float64]
Indices = NDArray[np.uint32]

_MOST = 2**32 - 2  # The largest index of the libraries.


def positions(V: Any, name: str = "V") -> Floats:
    given = np.asarray(V)
    if given.dtype.kind not in "fiu":
        raise InvalidInput(f"{name} holds {given.dtype}; give numbers")
    if given.ndim != 2 or given.shape[1] != 3:
        raise InvalidInput(f"{name} has the shape {given.shape}; give a row of three coordinates "
                           "for each vertex")
    return np.require(given, np.float64, ["C", "A"])


def integers(values: Any, name: str) -> NDArray[Any]:
    """An array of integers, or of no element."""
    given = np.asarray(values)
    if given.size == 0:
        return given.astype(np.int64)
    if given.dtype.kind not in "iu":
        raise InvalidInput(f"{name} holds {given.dtype}; give integers")
    return given


def to_indices(values: NDArray[Any]) -> Indices:
    """Values are in range."""
    if values.dtype == np.int32:
        return np.require(values, np.int32, ["C", "A"]).view(np.uint32)
    return np.require(values, np.uint32, ["C", "A"])


def first_outside(values: NDArray[Any], count: int) -> int | None:
    """The place in the flat array of the first value that is no index below ``count``."""
    if values.size == 0 or (values.min() >= 0 and values.max() < count):
        return None
    return int(np.argmax(((values < 0) | (values >= count)).ravel()))


def triangles(F: Any, num_vertices: int, name: str = "F") -> Indices:
    given = integers(F, name)
    if given.size == 0:
        given = given.reshape(0, 3)
    if given.ndim != 2 or given.shape[1] != 3:
        raise InvalidInput(f"{name} has the shape {given.shape}; give a row of three vertices for "
                           "each face")
    wrong = first_outside(given, num_vertices)
    if wrong is not None:
        raise InvalidInput(
            f"face {wrong // 3} names vertex {given.ravel()[wrong]}, but the mesh has only "
            f"{num_vertices} vertices, counted from 0; correct or delete the face")
    return to_indices(given)


def one_each(values: Any, count: int, name: str, element: str) -> Floats:
    """Numbers for each vertex or face."""
    given = np.asarray(values)
    if given.dtype.kind not in "fiub" or given.shape != (count,):
        raise InvalidOption(f"{name} has the shape {given.shape} and holds {given.dtype}, but the "
                            f"mesh has {count} {element}; give one number for each")
    return np.require(given, np.float64, ["C", "A"])


def corners(uv: Any, num_vertices: int, F: Indices) -> Floats | None:
    """Texture coordinates of each corner, #F x 3 x 2, or none."""
    if uv is None:
        return None
    given = np.asarray(uv)
    if given.dtype.kind not in "fiu":
        raise InvalidInput(f"uv holds {given.dtype}; give numbers")
    of_vertices, of_corners = (num_vertices, 2), (len(F), 3, 2)
    if given.shape not in (of_vertices, of_corners):
        raise InvalidInput(f"uv has the shape {given.shape}; give a pair for each corner of each "
                           f"face, {of_corners}, or for each vertex, {of_vertices}")
    return np.require(given if given.shape == of_corners else given[F], np.float64, ["C", "A"])


def whole(value: Any, name: str, low: int = 0, high: int = _MOST) -> int:
    """An integer, or a float that is one."""
    is_whole = isinstance(value, (int, np.integer)) or (
        isinstance(value, (float, np.floating)) and float(value).is_integer())
    if isinstance(value, (bool, np.bool_)) or not is_whole or not low <= int(value) <= high:
        raise InvalidOption(f"{name} is {value!r}; use a whole number from {low} to {high}")
    return int(value)


def number(value: Any, name: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InvalidOption(f"{name} is {value!r}; use a number") from None


def parts(points: Floats, offsets: NDArray[np.int64]) -> list[Floats]:
    """Part i is points[offsets[i]:offsets[i+1]], a view."""
    return [points[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]
