"""Compares a remeshed surface with the original."""

from __future__ import annotations

import json
from typing import Any

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._stages import Progress


@checked
def evaluate(V: Any, F: Any = None, V2: Any = None, F2: Any = None, *, samples: int = 200_000,
             threads: int = 0, progress: Progress | None = None) -> dict[str, Any]:
    """Compares a mesh (V2, F2) with its original (V, F): what ``remesh-eval --report`` writes.

    Either mesh may be one object: ``evaluate(V, F, V2, F2)``, ``evaluate(mesh, mesh2)``. samples:
    points on each surface at which distances are measured.

    Returns quality, topology, distance, self-intersections, sharp edges and corners by name. What
    needs CGAL is None in a build without it.

    >>> V, F = remesh.examples.sphere(3)
    >>> result = remesh.remesh(V, F, 200)
    >>> figures = remesh.evaluate(V, F, result.V, result.F)
    >>> figures["topology_kept"], figures["result"]["vertices"]
    (True, 200)
    """
    given = [argument for argument in (V, F, V2, F2) if argument is not None]
    meshes = []
    for name in ("", "2"):
        if not given:
            raise TypeError("evaluate() needs two meshes: V, F, V2, F2")
        first = given.pop(0)
        needs_faces = not _kinds.is_mesh(first)
        faces = given.pop(0) if needs_faces and given else None
        meshes.append(_kinds.take(first, faces, name))
    if given:
        raise TypeError("evaluate() takes two meshes; there is an argument besides")
    original, result = meshes
    return dict(json.loads(_remesh.evaluate(
        original.V, original.F, result.V, result.F, _arrays.whole(samples, "samples", 1),
        _arrays.whole(threads, "threads", 0, 2**31 - 1), progress)))
