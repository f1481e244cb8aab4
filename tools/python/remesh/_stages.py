"""The stages of remesh() one by one: cleaning, sampling, relaxation."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._remesh import InvalidSites

Progress = Callable[[float, str], Any]


class Sites(NamedTuple):
    """Points on a surface.

    >>> sites = remesh.Sites(np.array([5, 7]), np.full((2, 3), 1 / 3))
    >>> sites.positions(*remesh.examples.sphere(1)).shape
    (2, 3)
    """

    #: k, int64: the face of the mesh in which each point lies.
    face: NDArray[np.int64]
    #: k x 3: its coordinates, 0 or more with the sum 1; coordinate j belongs to corner j.
    barycentric: NDArray[np.float64]

    def positions(self, V: Any, F: Any = None) -> NDArray[np.float64]:
        """k x 3: where the points lie in space. V, F: the mesh on which they are.

        >>> V, F = remesh.examples.sphere(1)
        >>> remesh.Sites(np.array([0]), np.array([[0.0, 1.0, 0.0]])).positions(V, F) == V[F[0, 1]]
        array([[ True,  True,  True]])
        """
        mesh = _kinds.take(V, F)
        return np.asarray(np.einsum("ij,ijk->ik", self.barycentric, mesh.V[mesh.F[self.face]]))


class Relaxed(NamedTuple):
    """Sites that were moved, and how that went.

    >>> V, F = remesh.examples.sphere(3)
    >>> relaxed = remesh.relax_sites(V, F, remesh.sample_sites(V, F, 100, init="random"))
    >>> bool(relaxed.energies[-1] < relaxed.energies[0])
    True
    """

    sites: Sites
    #: Before the first step and after each. Empty: there are too few sites to be relaxed.
    energies: NDArray[np.float64]


class Cleaned(NamedTuple):
    """A repaired mesh.

    >>> V, F = remesh.examples.sphere(1)
    >>> cleaned = remesh.clean(V, F[:, ::-1])  # inside out
    >>> cleaned.V.shape, int(cleaned.source_face[3])
    ((18, 3), 3)
    """

    V: NDArray[Any]
    F: NDArray[Any]
    #: #V: the vertex of the input that each comes from.
    source_vertex: NDArray[np.int64]
    #: #F: the face of the input in which each lies.
    source_face: NDArray[np.int64]
    #: What was repaired: counts by name.
    repairs: dict[str, int]


def take_sites(mesh: _kinds.Given, sites: Any) -> tuple[_arrays.Indices, _arrays.Floats]:
    """Sites as users give them: see voronoi()."""
    if isinstance(sites, tuple) and len(sites) == 2:
        return _take_points(mesh, sites[0], sites[1])
    given = np.asarray(sites)
    if given.size == 0:
        raise InvalidSites("there is no site; give one or more")
    if given.ndim == 1 and given.dtype.kind in "iu":
        return _at_vertices(mesh, given)
    if given.ndim == 2 and given.shape[1] == 3 and given.dtype.kind in "fiu":
        return _nearest(mesh, given)
    raise InvalidSites(f"sites have the shape {given.shape} and hold {given.dtype}; give vertices "
                       "(k integers), points (k x 3 numbers), or a pair of faces (k) and "
                       "barycentric coordinates (k x 3)")


def _take_points(mesh: _kinds.Given, faces: Any,
                 barycentric: Any) -> tuple[_arrays.Indices, _arrays.Floats]:
    numbers = _arrays.integers(faces, "the sites' faces")
    places = np.asarray(barycentric)
    if numbers.ndim != 1 or places.shape != (len(numbers), 3) or places.dtype.kind not in "fiu":
        raise InvalidSites(f"the sites' faces have the shape {numbers.shape} and their coordinates "
                           f"{places.shape}; give k faces and k x 3 coordinates")
    if numbers.size == 0:
        raise InvalidSites("there is no site; give one or more")
    _check(numbers, len(mesh.F), "face", "faces")
    return _arrays.to_indices(numbers), np.require(places, np.float64, ["C", "A"])


def _check(numbers: NDArray[Any], count: int, one: str, many: str) -> None:
    wrong = _arrays.first_outside(numbers, count)
    if wrong is not None:
        raise InvalidSites(f"site {wrong} names {one} {numbers[wrong]}, but the mesh has only "
                           f"{count} {many}, counted from 0; correct the site")


def _at_vertices(mesh: _kinds.Given,
                 vertices: NDArray[Any]) -> tuple[_arrays.Indices, _arrays.Floats]:
    _check(vertices, len(mesh.V), "vertex", "vertices")
    corner_of = np.full(len(mesh.V), -1, np.int64)
    corners = mesh.F.ravel()
    corner_of[corners[::-1]] = np.arange(len(corners))[::-1]  # The lowest remains.
    corner = corner_of[vertices]
    if (corner < 0).any():
        vertex = vertices[np.argmax(corner < 0)]
        raise InvalidSites(f"vertex {vertex} is in no face; use a vertex of a face")
    barycentric = np.zeros((len(corner), 3))
    barycentric[np.arange(len(corner)), corner % 3] = 1
    return (corner // 3).astype(np.uint32), barycentric


def _nearest(mesh: _kinds.Given, points: NDArray[Any]) -> tuple[_arrays.Indices, _arrays.Floats]:
    places = _arrays.positions(points, "sites")
    for name, array, remedy in (("site", places, "site"), ("vertex", mesh.V, "vertex")):
        is_finite = np.isfinite(array).all(axis=1)
        if not is_finite.all():
            raise InvalidSites(f"{name} {np.argmin(is_finite)} has a coordinate that is not "
                               f"finite; correct or delete the {remedy}")
    face, barycentric = _remesh.nearest_points(mesh.V, mesh.F, places, None)
    return face.astype(np.uint32), barycentric


@checked
def clean(V: Any, F: Any = None, *, keep_slits: bool = False, threads: int = 0,
          progress: Progress | None = None) -> Cleaned:
    """Repairs a mesh as remesh() does first, without moving a vertex: welds, drops degenerate and
    duplicate faces, orients, and cuts at edges and vertices that are not manifold.

    keep_slits: open edges at one place, such as the two sides of a slit, are not welded.

    >>> V, F = remesh.examples.sphere(1)
    >>> remesh.clean(V, np.vstack([F, F[:2]])).repairs["duplicate_faces"]
    2
    """
    mesh = _kinds.take(V, F)
    new_V, new_F, vertices, faces, counts = _remesh.clean(
        mesh.V, mesh.F, bool(keep_slits), _arrays.whole(threads, "threads", 0, 2**31 - 1), progress)
    return Cleaned(*mesh.like_given(new_V, new_F), vertices, faces, counts)


@checked
def sample_sites(V: Any, F: Any = None, n: int = 2000, *, init: str = "blue-noise",
                 boundary: str = "keep", seed: int = 1, threads: int = 0,
                 progress: Progress | None = None) -> Sites:
    """Places ``n`` sites on a surface: the first stage of remesh() after cleaning.

    init: ``"blue-noise"``: even; ``"farthest"``: each as far as can be from those before;
    ``"random"``: by area. boundary: ``"keep"``: those near the boundary lie on it; ``"free"``.

    >>> V, F = remesh.examples.sphere(2)
    >>> remesh.sample_sites(V, F, 50).positions(V, F).shape
    (50, 3)
    """
    mesh = _kinds.take(V, F)
    return Sites(*_remesh.sample_sites(
        mesh.V, mesh.F, _arrays.whole(n, "n", 1), init, boundary,
        _arrays.whole(seed, "seed", 0, 2**64 - 1), _arrays.whole(threads, "threads", 0, 2**31 - 1), progress))


@checked
def relax_sites(V: Any, F: Any = None, sites: Any = None, *, steps: int = 60,
                tolerance: float = 1e-4, stop: Callable[[list[float]], Any] | None = None,
                fixed: Any = None, boundary: str = "keep", threads: int = 0,
                progress: Progress | None = None) -> Relaxed:
    """Moves sites towards the centroids of their cells.

    It ends after ``steps`` steps, when ten steps lower the energy by less than the share
    ``tolerance``, or when ``stop(energies)`` returns something true. ``energies`` is a list: the
    sum of the squared distances of the cells' points from their sites, integrated over the cells,
    before the first step and after each. ``stop`` may take the interpreter's time after each step;
    an exception in it ends the call.

    sites: see voronoi(). fixed: k truth values, true for sites that stay. boundary: see
    sample_sites().

    >>> V, F = remesh.examples.sphere(3)
    >>> first = remesh.sample_sites(V, F, 100, init="random")
    >>> relaxed = remesh.relax_sites(V, F, first, stop=lambda energies: len(energies) == 6)
    >>> len(relaxed.energies)
    6
    >>> result = remesh.remesh(V, F, sites=relaxed.sites, keep_sites=True)
    >>> len(result.V)
    100
    """
    mesh = _kinds.take(V, F)
    faces, barycentric = take_sites(mesh, sites)
    is_fixed = [] if fixed is None else (np.asarray(fixed).ravel() != 0).astype(int).tolist()
    face, places, energies = _remesh.relax_sites(
        mesh.V, mesh.F, faces, barycentric, _arrays.whole(steps, "steps", 0, 2**31 - 1),
        _arrays.number(tolerance, "tolerance"), is_fixed, boundary, stop,
        _arrays.whole(threads, "threads", 0, 2**31 - 1), progress)
    return Relaxed(Sites(face, places), energies)
