"""PyVista's meshes get ``mesh.remesh(...)``: PyVista 0.48 or later finds this module as an entry
point, and ``import remesh`` registers it where PyVista has been imported."""

from __future__ import annotations

from typing import Any

import pyvista  # type: ignore[import]

from ._remeshing import remesh


@pyvista.register_dataset_accessor("remesh", pyvista.PolyData)
class Remesher:
    """``mesh.remesh(n, ...)``: remesh.remesh(mesh, n, ...).mesh, a PolyData with the data of the
    mesh."""

    def __init__(self, mesh: Any) -> None:
        self._mesh = mesh

    def __call__(self, n: Any = None, **options: Any) -> Any:
        return remesh(self._mesh, n=n, **options).mesh
