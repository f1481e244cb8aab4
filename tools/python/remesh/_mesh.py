"""A mesh with all that a file holds of it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from numpy.typing import NDArray


@dataclass(repr=False)
class Mesh:
    """A mesh and its values: what read() returns and write() takes. All functions take it in place
    of ``V`` and ``F``, and Result.mesh is one where one was given.

    >>> V, F = remesh.examples.sphere(1)
    >>> mesh = remesh.Mesh(V, F, vertex_data={"height": V[:, 2]})
    >>> mesh
    <remesh.Mesh: 18 vertices, 32 faces; of vertices: height>
    >>> remesh.remesh(mesh, 100).mesh.vertex_data["height"].shape
    (100,)
    """

    #: #V x 3
    V: NDArray[Any]
    #: #F x 3
    F: NDArray[Any]
    #: By name: a row for each vertex, for each face. Names of labels, such as materials, are strings.
    vertex_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    face_data: dict[str, NDArray[Any]] = field(default_factory=dict)
    #: #F x 3 x 2: the texture coordinates of each face's corners, NaN where there are none; or None.
    uv: NDArray[Any] | None = None
    #: The files behind ``mtllib`` of an OBJ.
    material_files: list[str] = field(default_factory=list)
    #: What read() skipped. They are the first ones of Result.report["warnings"].
    warnings: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        values = [f"; of {element}: {', '.join(data)}" for element, data in
                  (("vertices", self.vertex_data), ("faces", self.face_data)) if data]
        texture = "; texture coordinates" if self.uv is not None else ""
        return (f"<remesh.Mesh: {len(self.V)} vertices, {len(self.F)} faces"
                f"{''.join(values)}{texture}>")
