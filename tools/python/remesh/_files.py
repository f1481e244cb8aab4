"""Reads and writes meshes with all their values."""

from __future__ import annotations

import os
import warnings
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._kinds import Data, Given
from ._mesh import Mesh
from ._remesh import InvalidInput
from ._stages import Progress

_COLOUR = "color"
_PARTS = ("red", "green", "blue", "alpha")


@checked
def read(path: str | os.PathLike[str], *, format: str = "", lenient: bool = False,
         progress: Progress | None = None) -> Mesh:
    """Reads a mesh with all that the program carries over: the formats of the program.

    Values have the names and the types of the file. Colours are one array, ``"color"``: #V x 3 or
    4, uint8, or from 0 to 1 where a text has them so. Materials and other labels that have names
    are strings. Where the file has normals of vertices, ``"Normals"`` has normals computed anew.

    format: ``"ply"``, ``"obj"``, ... where the extension does not name it. lenient: a file that
    holds more elements than its header announces is read as far as announced.

    Raises FileError (also an OSError) and InvalidInput. Mesh.warnings has what was skipped.

    >>> import tempfile
    >>> V, F = remesh.examples.sphere(1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = folder + "/sphere.ply"
    ...     remesh.write(path, V, F, vertex_data={"height": V[:, 2]})
    ...     remesh.read(path)
    <remesh.Mesh: 18 vertices, 32 faces; of vertices: height>
    """
    path = os.fspath(path)
    (V, F, of_vertices, of_faces, corners, corner_type, normals, materials,
     texts) = _remesh.read_mesh(path, format, bool(lenient), progress)
    mesh = Mesh(V, F.view(np.int32), _data_of(of_vertices), _data_of(of_faces),
                warnings=list(texts))
    if normals is not None:
        mesh.vertex_data[Given.normals] = _remesh.vertex_normals(V, F).astype(normals)
    if len(corners) > 0:
        mesh.uv = corners.reshape(-1, 3, 2).astype(corner_type or np.float32)
    folder = os.path.dirname(os.path.abspath(path))
    mesh.material_files = [os.path.join(folder, name) for name in materials]
    return mesh


@checked
def write(path: str | os.PathLike[str], V: Any, F: Any = None, *, vertex_data: Data | None = None,
          face_data: Data | None = None, uv: Any = None, format: str = "",
          progress: Progress | None = None) -> None:
    """Writes a mesh and its values to a path, all or nothing: the formats of the program.

    V, F: arrays, or one object that is a mesh or a result, whose values are written, too; ``vertex_data``,
    ``face_data`` (arrays by name) and ``uv`` (#F x 3 x 2 or #V x 2) are added or take their place.
    ``result.mesh`` of a remesh.Mesh has all of them. Columns of an array become values of their
    own: ``"color"`` red, green, blue and alpha, others ``name_0``, ``name_1``, ... What the
    format cannot hold is a Python warning. An existing file is replaced.

    Raises FileError (also an OSError) and InvalidInput.

    >>> import os, tempfile
    >>> V, F = remesh.examples.sphere(1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     remesh.write(folder + "/sphere.obj", V, F)
    ...     os.listdir(folder)
    ['sphere.obj']
    """
    path = os.fspath(path)
    mesh = _kinds.take(V, F)
    of_vertices, of_faces = mesh.data()
    of_vertices.update(vertex_data or {})
    of_faces.update(face_data or {})
    normals = of_vertices.pop(Given.normals, None)
    of_faces.pop(Given.normals, None)
    corners = _arrays.corners(mesh.uv if uv is None else uv, len(mesh.V), mesh.F)
    corner_type = None
    if corners is None:
        corners = np.empty((0, 3, 2))
    else:
        is_wide = np.asarray(mesh.uv if uv is None else uv).dtype == np.float64
        corner_type = "float64" if is_wide else "float32"
    folder = os.path.dirname(os.path.abspath(path))
    materials = [os.path.relpath(name, folder) if os.path.isabs(name) else name
                 for name in getattr(getattr(V, "mesh", V), "material_files", [])]
    texts = _remesh.write_mesh(
        path, format, mesh.V, mesh.F, _rows_of(of_vertices, len(mesh.V), "vertices"),
        _rows_of(of_faces, len(mesh.F), "faces"), corners, corner_type,
        None if normals is None else np.asarray(normals).dtype.name, materials, progress)
    for text in texts:
        warnings.warn(f"{path}: {text}", stacklevel=3)  # Where write() is called: see _arguments.


def _data_of(rows: list[_remesh.Row]) -> Data:
    """Attributes of the extension as arrays by name; parts of a colour as one."""
    data: Data = {}
    parts = [name for name in _PARTS if any(row[0] == name for row in rows)]
    is_colour = parts[:3] == list(_PARTS[:3])
    for name, kind, values, names, _ in rows:
        if is_colour and name in parts:
            continue
        data[name] = (np.array(names)[values.astype(np.int64)] if names else
                      values.astype(kind))
    if is_colour:
        of_part = {row[0]: row[2].astype(row[1]) for row in rows if row[0] in parts}
        data[_COLOUR] = np.stack([of_part[part] for part in parts], axis=1)
    return data


def _rows_of(data: Data, count: int, element: str) -> list[_remesh.Row]:
    rows: list[_remesh.Row] = []
    for name, given in data.items():
        values = np.asarray(given)
        if values.ndim == 0 or len(values) != count:
            raise InvalidInput(f"{name!r} has the shape {values.shape}, but the mesh has {count} "
                               f"{element}; give a row for each")
        if values.ndim == 1:
            rows.append(_row_of(name, values, False))
            continue
        columns = values.reshape(count, -1).T
        is_colour = name == _COLOUR and len(columns) in (3, 4)
        rows += [_row_of(_PARTS[i] if is_colour else f"{name}_{i}", column,
                         is_colour and values.dtype.kind == "f")
                 for i, column in enumerate(columns)]
    return rows


def _row_of(name: str, values: NDArray[Any], is_intensity: bool) -> _remesh.Row:
    if values.dtype.kind in "US":
        names, number = np.unique(values, return_inverse=True)
        return name, "int32", number.astype(np.float64), [str(one) for one in names], False
    if values.dtype.kind not in "fiub":
        raise InvalidInput(f"{name!r} holds {values.dtype}; give numbers or strings")
    return (name, _type_of(values), np.require(values, np.float64, ["C", "A"]), [], is_intensity)


def _type_of(values: NDArray[Any]) -> str:
    """A type that files have and that holds the values."""
    if values.dtype.kind == "b":
        return "uint8"
    if values.dtype.itemsize <= 4:
        return "float32" if values.dtype == np.float16 else values.dtype.name
    is_whole = values.dtype.kind in "iu" and values.size > 0
    if is_whole and -2**31 <= values.min() and values.max() < 2**31:
        return "int32"
    return "float64"
