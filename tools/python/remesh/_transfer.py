"""Values at the vertices and faces of an input for those of its remesh."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _remesh
from ._kinds import Data, Given
from ._remesh import InvalidOption


@dataclass
class Wanted:
    """What is to be carried over."""

    of_vertices: Data = field(default_factory=dict)
    of_faces: Data = field(default_factory=dict)


def wanted(mesh: Given, transfer: Any) -> Wanted:
    """What ``transfer`` of remesh() asks for."""
    if transfer is None or isinstance(transfer, str):
        names: list[str] | None = None if transfer in (None, "all") else [str(transfer)]
        if transfer == "none":
            return Wanted()
        return _of_mesh(mesh, names)
    if isinstance(transfer, Mapping):
        return _given(mesh, transfer)
    if isinstance(transfer, Iterable):
        return _of_mesh(mesh, [str(name) for name in transfer])
    raise InvalidOption(f"transfer is {transfer!r}; use 'all', 'none', names, or arrays by name")


def _of_mesh(mesh: Given, names: list[str] | None) -> Wanted:
    of_vertices, of_faces = mesh.data()
    for name in names or []:
        if name not in of_vertices and name not in of_faces:
            has = ", ".join([*of_vertices, *of_faces]) or "none"
            raise InvalidOption(f"transfer: the mesh has no values {name!r}; it has: {has}")
    return Wanted({k: v for k, v in of_vertices.items() if names is None or k in names},
                  {k: v for k, v in of_faces.items() if names is None or k in names})


def _given(mesh: Given, arrays: Mapping[Any, Any]) -> Wanted:
    result = Wanted()
    for name, given in arrays.items():
        element, given = given if isinstance(given, tuple) else (None, given)
        values = np.asarray(given)
        counts = {"vertex": len(mesh.V), "face": len(mesh.F)}
        fitting = [kind for kind, count in counts.items()
                   if values.ndim > 0 and len(values) == count and element in (None, kind)]
        if len(fitting) != 1:
            raise InvalidOption(
                f"transfer: {name!r} has the shape {values.shape}, and the mesh has {len(mesh.V)} "
                f"vertices and {len(mesh.F)} faces; give a value for each vertex or each face, as "
                "('vertex', array) or ('face', array) if both fit")
        (result.of_vertices if fitting == ["vertex"] else result.of_faces)[str(name)] = values
    return result


def carry(wanted: Wanted, mesh: Given, V: NDArray[Any], F: NDArray[Any], faces: NDArray[Any],
          barycentric: NDArray[Any], samples: NDArray[Any]) -> tuple[Data, Data]:
    """The values for the result's vertices and faces.

    V, F: the result. faces, barycentric: of its vertices on the input. samples: of its faces."""
    def at_vertices(values: NDArray[Any], is_label: bool) -> NDArray[Any]:
        return _remesh.transfer_vertex_values(values, mesh.V, mesh.F, faces.astype(np.uint32),
                                              barycentric, is_label)

    def at_faces(values: NDArray[Any], is_label: bool) -> NDArray[Any]:
        return _remesh.transfer_face_values(values, samples, is_label)

    of_vertices = {name: _carry_one(values, at_vertices)
                   for name, values in wanted.of_vertices.items() if name != Given.normals}
    if Given.normals in wanted.of_vertices:
        normals = _remesh.vertex_normals(V, F)
        of_vertices[Given.normals] = normals.astype(wanted.of_vertices[Given.normals].dtype)
    of_faces = {name: _carry_one(values, at_faces)
                for name, values in wanted.of_faces.items() if name != Given.normals}
    return of_vertices, of_faces


def keep(wanted: Data, elements: NDArray[np.int64], carried: Data) -> None:
    """The first ones of the result are these elements of the input, and have its values."""
    for name, values in wanted.items():
        if name != Given.normals:
            carried[name][:len(elements)] = values[elements]


def texture(mesh: Given, uv: Any, transfer: Any) -> _arrays.Floats | None:
    """The texture coordinates of remesh(), for each corner: #F x 3 x 2."""
    if uv is None and transfer == "all":
        uv = mesh.uv
    return _arrays.corners(uv, len(mesh.V), mesh.F)


def carry_texture(uv: _arrays.Floats, mesh: Given, V: NDArray[Any], F: NDArray[Any],
                  faces: NDArray[Any], barycentric: NDArray[Any], kept_faces: NDArray[Any],
                  num_threads: int) -> _arrays.Floats:
    """Those of the result, whose first faces are `kept_faces` of the input; see carry()."""
    carried = _remesh.transfer_corner_values(uv, mesh.V, mesh.F, V, F, faces.astype(np.uint32),
                                             barycentric, num_threads).reshape(-1, 3, 2)
    carried[:len(kept_faces)] = uv[kept_faces]
    return carried


def _is_colour(values: NDArray[Any]) -> bool:
    return values.dtype == np.uint8 and values.ndim == 2 and values.shape[1] in (3, 4)


def _carry_one(values: NDArray[Any], at: Any) -> NDArray[Any]:
    """Floats and colours are numbers, everything else is a label: rows are chosen whole."""
    if values.dtype.kind != "f" and not _is_colour(values):
        different, number = np.unique(values, axis=0, return_inverse=True)
        chosen = at(np.ascontiguousarray(number.reshape(-1), np.float64), True)
        return np.asarray(different[chosen.astype(np.int64)])
    columns = values.reshape(len(values), -1).astype(np.float64)
    carried = [at(np.ascontiguousarray(column), False) for column in columns.T]
    result = np.stack(carried, axis=1).reshape(-1, *values.shape[1:])
    if _is_colour(values):
        result = np.rint(result)
    return np.asarray(result.astype(values.dtype))
