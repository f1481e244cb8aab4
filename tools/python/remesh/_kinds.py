"""The kinds of meshes that users pass: two arrays, a Mesh, or objects of PyVista, VTK, meshio and
trimesh, or laid out like these. Of other packages only VTK's is imported, where its object is given."""

from __future__ import annotations

import os
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _remesh
from ._mesh import Mesh
from ._remesh import InvalidInput

Data = dict[str, NDArray[Any]]


class Given:
    """A mesh as the extension takes it, and how results get the form of what the user gave."""

    #: What is computed anew instead of carried over.
    normals = "Normals"
    #: Of reading it.
    warnings: list[str] = []
    #: Texture coordinates of its corners or vertices.
    uv: Any = None

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

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        return V, F


class PyVistaMesh(Given):
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

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        corners = np.full((len(F), 1), 3)
        mesh = type(self._given)(V, np.hstack([corners, F]).ravel())
        _store(mesh, "point_data", of_vertices)
        _store(mesh, "cell_data", of_faces)
        return mesh


class TrimeshMesh(Given):
    def __init__(self, given: Any) -> None:
        self._given = given
        super().__init__(given.vertices, given.faces)

    def data(self) -> tuple[Data, Data]:
        return (_as_data(self._given, "vertex_attributes"),
                _as_data(self._given, "face_attributes"))

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        mesh = type(self._given)(vertices=V, faces=F, process=False)
        _store(mesh, "vertex_attributes", of_vertices)
        _store(mesh, "face_attributes", of_faces)
        return mesh


class VtkMesh(Given):
    """vtkPolyData. Of its cells only polygons count."""

    def __init__(self, given: Any) -> None:
        if given.GetNumberOfStrips() > 0:
            raise InvalidInput("the vtkPolyData has strips; use vtkTriangleFilter first")
        self._given = given
        polygons = given.GetPolys()
        has_points = given.GetNumberOfPoints() > 0
        points = np.asarray(given.GetPoints().GetData()) if has_points else np.empty((0, 3))
        F, self._polygon = _triangulate(points, np.asarray(polygons.GetConnectivityArray()),
                                        np.asarray(polygons.GetOffsetsArray()))
        super().__init__(points, F)

    def data(self) -> tuple[Data, Data]:
        # Values of cells are those of points and lines, then of polygons.
        first = self._given.GetNumberOfVerts() + self._given.GetNumberOfLines()
        return (_values_of_vtk(self._given.GetPointData()),
                {name: values[first + self._polygon]
                 for name, values in _values_of_vtk(self._given.GetCellData()).items()})

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        from vtkmodules.util.numpy_support import numpy_to_vtk  # type: ignore[import]
        from vtkmodules.vtkCommonCore import vtkPoints  # type: ignore[import]
        from vtkmodules.vtkCommonDataModel import vtkCellArray  # type: ignore[import]

        points, polygons, mesh = vtkPoints(), vtkCellArray(), type(self._given)()
        points.SetData(numpy_to_vtk(V, deep=True))
        polygons.SetData(numpy_to_vtk(np.arange(0, 3 * len(F) + 1, 3, dtype=np.int64), deep=True),
                         numpy_to_vtk(F.astype(np.int64).ravel(), deep=True))
        mesh.SetPoints(points)
        mesh.SetPolys(polygons)
        for target, data in ((mesh.GetPointData(), of_vertices), (mesh.GetCellData(), of_faces)):
            for name, values in data.items():
                target.AddArray(_to_vtk(name, values))
        return mesh


class MeshioMesh(Given):
    """meshio.Mesh. Of its cells only triangles, quads and polygons count."""

    def __init__(self, given: Any) -> None:
        self._given = given
        self._blocks = [i for i, block in enumerate(given.cells)
                        if block.type in ("triangle", "quad", "polygon")]
        if not self._blocks:
            kinds = ", ".join(sorted({block.type for block in given.cells})) or "nothing"
            raise InvalidInput(f"the meshio.Mesh has no triangle, quad or polygon, but {kinds}; "
                               "give its surface")
        polygons = [np.asarray(given.cells[i].data) for i in self._blocks]
        sizes = np.repeat([p.shape[1] for p in polygons], [len(p) for p in polygons])
        points = np.asarray(given.points)
        if points.ndim == 2 and points.shape[1] == 2:
            points = np.pad(points, ((0, 0), (0, 1)))
        F, self._polygon = _triangulate(points, np.concatenate([p.ravel() for p in polygons]),
                                        np.append(0, np.cumsum(sizes)))
        super().__init__(points, F)

    def data(self) -> tuple[Data, Data]:
        of_faces = {str(name): np.concatenate([np.asarray(values[i]) for i in self._blocks])
                    for name, values in self._given.cell_data.items()}
        return (_as_data(self._given, "point_data"),
                {name: values[self._polygon] for name, values in of_faces.items()})

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        return type(self._given)(V, [("triangle", F)], point_data=of_vertices,
                                 cell_data={name: [values] for name, values in of_faces.items()},
                                 field_data=self._given.field_data)


class OwnMesh(Given):
    """A Mesh of this package."""

    def __init__(self, given: Mesh) -> None:
        super().__init__(given.V, given.F)
        self._given = given
        self.warnings, self.uv = given.warnings, given.uv

    def data(self) -> tuple[Data, Data]:
        return _as_data(self._given, "vertex_data"), _as_data(self._given, "face_data")

    def build(self, V: NDArray[Any], F: NDArray[Any], of_vertices: Data, of_faces: Data,
              uv: Any = None) -> Any:
        return Mesh(V, F, of_vertices, of_faces, uv, list(self._given.material_files))


def _unwrapped(given: Any) -> Any:
    """Results of this package, which have V and F, as meshes: the object that they came as, if it is
    one, or a Mesh."""
    if isinstance(given, Mesh) or not (hasattr(given, "V") and hasattr(given, "F")):
        return given
    inner = getattr(given, "mesh", None)
    if inner is not None and not isinstance(inner, tuple):
        return inner
    return Mesh(given.V, given.F, dict(getattr(given, "vertex_data", {})),
                dict(getattr(given, "face_data", {})), getattr(given, "uv", None))


def kind_of(given: Any) -> Any:
    """The class above that takes it; None: it is no mesh by itself."""
    given = _unwrapped(given)
    for kind, has in ((OwnMesh, isinstance(given, Mesh)),
                      (PyVistaMesh, hasattr(given, "faces") and hasattr(given, "points")),
                      (TrimeshMesh, hasattr(given, "faces") and hasattr(given, "vertices")),
                      (VtkMesh, hasattr(given, "GetPolys")),
                      (MeshioMesh, hasattr(given, "cells") and hasattr(given, "cell_data"))):
        if has:
            return kind
    return None


def is_mesh(given: Any) -> bool:
    """Whether it is a mesh by itself, or the two arrays as a tuple."""
    return _is_pair(given) or kind_of(given) is not None


def _is_pair(given: Any) -> bool:
    return type(given) is tuple and len(given) == 2


def take(V: Any, F: Any, name: str = "") -> Given:
    """The mesh that a user gave as V and F, or as V alone."""
    if isinstance(V, (str, os.PathLike)):
        raise TypeError(f"{os.fspath(V)!r} is a path, not a mesh; read it first: "
                        f"remesh.read({os.fspath(V)!r})")
    if F is None and _is_pair(V):
        V, F = V
    kind = kind_of(V)
    if kind is not None:
        if F is not None:
            raise TypeError("the first argument is a mesh with faces; give no faces besides")
        mesh: Given = kind(_unwrapped(V))
        return mesh
    if F is None:
        raise TypeError(f"{type(V).__name__} has no faces; give V and F, a remesh.Mesh, or an object "
                        "of PyVista, VTK (vtkPolyData), meshio or trimesh")
    return Given(V, F, name)


def _triangulate(points: NDArray[Any], corners: NDArray[Any],
                 offsets: NDArray[Any]) -> tuple[NDArray[np.uint32], NDArray[np.int64]]:
    """Polygons as triangles, and the polygon of each."""
    wrong = _arrays.first_outside(corners, len(points))
    if wrong is not None:
        raise InvalidInput(f"a polygon names point {corners[wrong]}, but the mesh has only "
                           f"{len(points)}, counted from 0; correct or delete it")
    return _remesh.triangulate(_arrays.positions(points), _arrays.to_indices(corners),
                               offsets.astype(np.int64))


def _values_of_vtk(data: Any) -> Data:
    arrays = [data.GetAbstractArray(i) for i in range(data.GetNumberOfArrays())]
    return {array.GetName(): np.array([array.GetValue(i) for i in range(array.GetNumberOfValues())])
            if array.IsA("vtkStringArray") else np.array(array)
            for array in arrays if array.GetName()}


def _to_vtk(name: str, values: NDArray[Any]) -> Any:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonCore import vtkStringArray

    if values.dtype.kind in "US":
        array = vtkStringArray()
        for value in values:
            array.InsertNextValue(str(value))
    else:
        is_bool = values.dtype == bool
        array = numpy_to_vtk(values.view(np.uint8) if is_bool else values, deep=True)
    array.SetName(name)
    return array


def _is_of_triangles(faces: NDArray[Any]) -> bool:
    return faces.ndim == 1 and len(faces) % 4 == 0 and bool((faces[::4] == 3).all())


def _as_data(mesh: Any, name: str) -> Data:
    return {str(key): np.asarray(value) for key, value in dict(getattr(mesh, name, {})).items()}


def _store(mesh: Any, name: str, values: Data) -> None:
    for key, value in values.items():
        getattr(mesh, name)[key] = value
