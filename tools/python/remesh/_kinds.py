"""The kinds of meshes that users pass: two arrays, or objects laid out like those of PyVista and
trimesh, which this package never imports."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays
from ._remesh import InvalidInput

Data = dict[str, NDArray[Any]]


class Mesh:
    """A mesh as the extension takes it, and how results get the form of what the user gave."""

    #: What is computed anew instead of carried over.
    normals = "Normals"

    def __init__(self, V: Any, F: Any, name: str = "") -> None:
        given_V, given_F = np.asarray(V), np.asarray(F)
        self.V = _arrays.positions(given_V, "V" + name)
        self.F = _arrays.triangles(given_F, len(self.V), "F" + name)
        self._float = given_V.dtype if given_V.dtype == np.float32 else np.dtype(np.float64)
        is_wide = given_F.dtype.kind in "iu" and given_F.dtype.itemsize >= 4
        self._int = given_F.dtype if is_wide else np.dtype(np.int64)

    def like_given(self, V: NDArray[Any], F: NDArray[Any]) -> tuple[NDArray[Any], NDArray[Any]]:
        """In the types of the input: float32 and integers of 32 bits or more stay."""
        F = F.view(np.int32) if self._int == np.int32 else F.astype(self._int, copy=False)
        return V.astype(self._float, copy=False), F

    def data(self) -> tuple[Data, Data]:
        """Of vertices and of faces."""
        return {}, {}

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data) -> Any:
        return V, F


class PyVistaMesh(Mesh):
    def __init__(self, given: Any) -> None:
        faces = np.asarray(given.faces)
        if not _is_of_triangles(faces):
            if not hasattr(given, "triangulate"):
                raise InvalidInput("the mesh has faces that are no triangles; triangulate it")
            given = given.triangulate()
            faces = np.asarray(given.faces)
        self._given = given
        super().__init__(given.points, faces.reshape(-1, 4)[:, 1:])

    def data(self) -> tuple[Data, Data]:
        return _as_data(self._given, "point_data"), _as_data(self._given, "cell_data")

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data) -> Any:
        corners = np.full((len(F), 1), 3)
        mesh = type(self._given)(V, np.hstack([corners, F]).ravel())
        _store(mesh, "point_data", of_vertices)
        _store(mesh, "cell_data", of_faces)
        return mesh


class TrimeshMesh(Mesh):
    def __init__(self, given: Any) -> None:
        self._given = given
        super().__init__(given.vertices, given.faces)

    def data(self) -> tuple[Data, Data]:
        return (_as_data(self._given, "vertex_attributes"),
                _as_data(self._given, "face_attributes"))

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data) -> Any:
        mesh = type(self._given)(vertices=V, faces=F, process=False)
        _store(mesh, "vertex_attributes", of_vertices)
        _store(mesh, "face_attributes", of_faces)
        return mesh


def is_mesh(given: Any) -> bool:
    """Whether it is a mesh by itself."""
    return hasattr(given, "faces") and (hasattr(given, "points") or hasattr(given, "vertices"))


def take(V: Any, F: Any, name: str = "") -> Mesh:
    """The mesh that a user gave as V and F, or as V alone."""
    if is_mesh(V):
        if F is not None:
            raise TypeError("the first argument is a mesh with faces; give no faces besides")
        return PyVistaMesh(V) if hasattr(V, "points") else TrimeshMesh(V)
    if F is None:
        raise TypeError(f"{type(V).__name__} has no faces; give V and F, or an object with .points "
                        "and .faces (PyVista) or with .vertices and .faces (trimesh)")
    return Mesh(V, F, name)


def _is_of_triangles(faces: NDArray[Any]) -> bool:
    return faces.ndim == 1 and len(faces) % 4 == 0 and bool((faces[::4] == 3).all())


def _as_data(mesh: Any, name: str) -> Data:
    return {str(key): np.asarray(value) for key, value in dict(getattr(mesh, name, {})).items()}


def _store(mesh: Any, name: str, values: Data) -> None:
    for key, value in values.items():
        getattr(mesh, name)[key] = value
