"""Report pages: what Result.html() and Jupyter show."""

from __future__ import annotations

import html
import inspect
import json
import numbers
import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _arrays, _remesh, _transfer
from ._stages import Progress


@dataclass(frozen=True)
class Source:
    """What a page needs besides the result. The arrays are those of the input."""

    V: _arrays.Floats
    F: _arrays.Indices
    made: _remesh.Made
    #: The call, as text.
    call: str
    #: Name and one number for each face, of the input.
    labels: tuple[str, _arrays.Floats] | None


def call_text(function: Any, given: dict[str, Any]) -> str:
    """The call with what differs from the defaults; arrays and objects are left out."""
    words = ["mesh"] if given["F"] is None else ["V", "F"]
    for name, parameter in list(inspect.signature(function).parameters.items())[2:]:
        value = given[name]
        if value is None or value is parameter.default or name == "progress":
            continue
        elif isinstance(value, (str, numbers.Number)):
            if value != parameter.default:
                words.append(f"{name}={value!r}")
        else:
            words.append(f"{name}=...")
    return f"remesh.remesh({', '.join(words)})"


def labels_of(wanted: _transfer.Wanted) -> tuple[str, _arrays.Floats] | None:
    """The first values of faces that are labels, one number each."""
    for name, values in wanted.of_faces.items():
        if values.ndim == 1 and values.dtype.kind in "iub":
            return name, np.ascontiguousarray(values, np.float64)
    return None


def page(result: Any, source: Source, original_name: str, result_name: str,
         progress: Progress | None) -> str:
    V, F = np.asarray(result.V), np.asarray(result.F)
    name, labels = source.labels or ("", np.empty(0))
    of_result = result.face_data.get(name)
    has_both = of_result is not None and of_result.ndim == 1
    of_original, of_result = (np.ascontiguousarray(values, np.float64) if has_both else np.empty(0)
                              for values in (labels, of_result))
    return _remesh.page(source.V, source.F, _arrays.positions(V, "V"),
                        _arrays.triangles(F, len(V), "F"), source.made, json.dumps(result.report),
                        source.call, original_name, result_name, name, of_original, of_result,
                        progress)


def write(text: str, path: str | os.PathLike[str]) -> None:
    try:
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    except OSError as error:
        raise _remesh.FileError(f"{os.fspath(path)} cannot be written ({error.strerror}); "
                                "name another file") from error


def frame(text: str) -> str:
    """The page in a frame, for a notebook."""
    return (f'<iframe srcdoc="{html.escape(text)}" title="Remesh report" width="100%" '
            'height="640" style="border: 0" allowfullscreen></iframe>')
