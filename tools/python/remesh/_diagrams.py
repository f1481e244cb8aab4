"""Geodesic Voronoi diagrams and distances."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._given import all_sites, surface_of
from ._remesh import InvalidOption
from ._stages import Progress, take_sites


@dataclass(frozen=True)
class BisectorArcs:
    """The k arcs of the bisectors. Arc i lies in one face and has the points p with
    ``|p - focus_left[i]| + weight_left[i] == |p - focus_right[i]| + weight_right[i]``, which is their
    distance from both sites. Foci are images of the sites, or of vertices that paths bend at.

    >>> V, F = remesh.examples.sphere(3)
    >>> diagram = remesh.voronoi(V, F, [0, 1, 2], max_error=0, chord=1e-3)
    >>> arcs = diagram.arcs
    >>> p = diagram.points[arcs.span[:, 0]]  # the first point of each
    >>> left = np.linalg.norm(p - arcs.focus_left, axis=1) + arcs.weight_left
    >>> right = np.linalg.norm(p - arcs.focus_right, axis=1) + arcs.weight_right
    >>> bool(np.allclose(left, right, atol=1e-11))
    True
    """

    #: k: the polyline that the arc is a part of.
    line: NDArray[np.int64]
    #: k x 2: the arc is ``points[span[i, 0]:span[i, 1]]`` of the diagram.
    span: NDArray[np.int64]
    #: k: 0: a line, 1: a hyperbola, 2: a chord without foci, drawn where distances with errors
    #: contradict each other.
    kind: NDArray[np.int64]
    #: k x 3, in the plane of the face.
    focus_left: NDArray[np.float64]
    #: k: the distance of the site on the left from its focus.
    weight_left: NDArray[np.float64]
    focus_right: NDArray[np.float64]
    weight_right: NDArray[np.float64]


@dataclass(frozen=True)
class Voronoi:
    """A geodesic Voronoi diagram of k sites. Lengths are in mesh units.

    >>> V, F = remesh.examples.sphere(3)
    >>> diagram = remesh.voronoi(V, F, [0, 1, 2])
    >>> diagram.cell_area.shape, bool(abs(diagram.cell_area.sum() / (4 * np.pi) - 1) < 0.02)
    ((3,), True)
    """

    #: #V, int64: the nearest site of each vertex of the input; -1: no site reaches it.
    labels: NDArray[np.int64]
    #: #V: its distance along the surface; infinity: no site reaches it.
    distances: NDArray[np.float64]
    #: k x 3; with groups, lines or regions the points given.
    site_positions: NDArray[np.float64]
    #: k: area of each cell; 0 for a site that owns nothing, such as one of two at one place, or one
    #: whose weight exceeds the distance from another.
    cell_area: NDArray[np.float64]
    #: k: Euler characteristic of each cell; 1: a disc.
    cell_euler: NDArray[np.int32]
    #: k + 1: site s has the neighbours ``neighbours[neighbour_offsets[s]:neighbour_offsets[s+1]]``.
    neighbour_offsets: NDArray[np.int64]
    neighbours: NDArray[np.int64]
    #: Points of all polylines, one after the other.
    points: NDArray[np.float64]
    #: The distance of each of these from its sites.
    point_distances: NDArray[np.float64]
    #: #polylines + 1: polyline i is ``points[line_offsets[i]:line_offsets[i+1]]``. A closed one
    #: ends with its first point.
    line_offsets: NDArray[np.int64]
    #: #polylines x 2: the sites on its left and right; -1 on the right: the surface's boundary.
    line_sites: NDArray[np.int64]
    #: Triangles of sites: one for each point where three cells meet.
    dual: NDArray[np.uint32]
    #: No distance is longer than the exact one by more than this share of it.
    certified_error: float
    #: With ``chord``: what the bisectors are made of.
    arcs: BisectorArcs | None = None

    @property
    def bisectors(self) -> list[NDArray[np.float64]]:
        """The polylines between two cells, each m x 3: views of ``points``."""
        return [self.points[self.line_offsets[i]:self.line_offsets[i + 1]]
                for i in np.flatnonzero(self.line_sites[:, 1] >= 0)]

    @property
    def bisector_sites(self) -> NDArray[np.int64]:
        """#bisectors x 2: the sites on the left and on the right of each."""
        return np.asarray(self.line_sites[self.line_sites[:, 1] >= 0])

    def neighbours_of(self, site: int) -> NDArray[np.int64]:
        """The sites whose cells have an edge in common with that of ``site``, ascending."""
        return self.neighbours[self.neighbour_offsets[site]:self.neighbour_offsets[site + 1]]


def _common(engine: str, max_error: float | None, threads: int) -> tuple[str, float | None, int]:
    return (engine, None if max_error is None else _arrays.number(max_error, "max_error"),
            _arrays.whole(threads, "threads", 0, 2**31 - 1))


@checked
def voronoi(V: Any, F: Any = None, sites: Any = None, max_error: float | None = None, *,
            groups: Any = None, weights: Any = None, lines: Any = None, regions: Any = None,
            barriers: Any = None, edge_lengths: Any = None, engine: str = "window",
            chord: float | None = None, file: str | os.PathLike[str] | None = None,
            keep_slits: bool = False, threads: int = 0,
            progress: Progress | None = None) -> Voronoi:
    """The geodesic Voronoi diagram of sites on a surface.

    sites: vertices (k integers), points (k x 3 numbers: the nearest point of the surface counts),
    or a pair of faces (k integers) and barycentric coordinates (k x 3), such as Sites.
    max_error: distances are at most this share above exact; 0: exact; None: 0.0001.
    groups: of each of these points the site that it belongs to: 0, 1, ... without gaps; without it
    each point is a site. A site's distance is the least from its points.
    weights: numbers of 0 or more that are added to the distances from each point. A site that is
    farther from its own place than another one owns nothing: its ``cell_area`` is 0.
    lines: sites that are lines along edges: of each its vertices, every one joined to the next by an
    edge. Their numbers follow those of the points; sites may then be None.
    regions: sites that are regions, at distance 0 inside: of each its faces. Their numbers follow.
    groups and weights may go on with those of the lines and of the regions.
    barriers: edges that no path crosses (m x 2 vertices). The mesh is cut along them; of a vertex
    on them the nearest side counts, and sites on them count on both sides.
    edge_lengths: in place of those between the positions, which then are for drawing only (#F x 3
    numbers: of the side from corner k of a face to corner k + 1). The mesh is not cleaned: what
    cleaning repairs is an error. Not together with barriers; sites are vertices, or faces and
    barycentric coordinates.
    engine: ``"window"`` or ``"steiner"``: see the README.
    chord: polylines stray from the bisectors by at most this length, and the result has ``arcs``;
    None: by a hundredth of each chord, without arcs.
    file: the diagram is also written to it: ``.agvd`` (for compare()), ``.vtp``, ``.ply`` or ``.obj``,
    as ``agvd diagram -o`` writes them.
    keep_slits: open edges at one place, such as the two sides of a slit, are not welded.

    >>> V, F = remesh.examples.sphere(3)
    >>> diagram = remesh.voronoi(V, F, [0, 1], max_error=0)  # the two poles of the x axis
    >>> bool((V[diagram.labels == 0, 0] >= 0).all())
    True
    >>> len(diagram.bisectors), diagram.neighbours_of(0)
    (1, array([1]))
    >>> line = remesh.voronoi(V, F, [0], lines=[F[100][:2]], regions=[[300, 301]])
    >>> line.labels[F[100][0]], line.labels[F[300]].tolist(), line.cell_area.shape
    (1, [2, 2, 2], (3,))
    >>> pairs = remesh.voronoi(V, F, [0, 1, 2, 3], groups=[0, 0, 1, 1])
    >>> pairs.cell_area.shape, sorted(set(pairs.labels.tolist()))
    ((2,), [0, 1])
    """
    mesh = _kinds.take(V, F)
    name, error, num_threads = _common(engine, max_error, threads)
    found = _remesh.voronoi(
        mesh.V, mesh.F, all_sites(mesh, sites, groups, weights, lines, regions),
        surface_of(mesh, barriers, edge_lengths, keep_slits), name, error,
        None if chord is None else _arrays.number(chord, "chord"),
        "" if file is None else os.fspath(file), num_threads, progress)
    arcs = found.pop("arcs", None)
    return Voronoi(**found, arcs=None if arcs is None else BisectorArcs(**arcs))


@checked
def compare(a: str | os.PathLike[str], b: str | os.PathLike[str] = "exact", *,
            spacing: float = 0.01, samples: int = 100_000, points: int = 20_000, threads: int = 0,
            progress: Progress | None = None) -> dict[str, Any]:
    """Measures how far the diagram of a file is from another one of the same mesh and sites: what
    ``agvd compare --report`` writes.

    a, b: ``.agvd`` files, of voronoi(file=...) or ``agvd diagram``; b may be ``"exact"``: the exact
    diagram of a's mesh and sites.
    spacing: between points of a loop, in mean cell radii. samples: number of points at which cells
    are compared. points: largest number of points of bisectors at which exact distances are
    measured; 0: none.

    >>> import tempfile
    >>> V, F = remesh.examples.sphere(3)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = remesh.voronoi(V, F, [0, 1], regions=[[300]], file=folder + "/cells.agvd")
    ...     figures = remesh.compare(folder + "/cells.agvd")
    >>> figures["sites"], figures["frechet"]["unmatched_loops"]
    (3, 0)
    """
    return dict(json.loads(_remesh.compare(
        os.fspath(a), os.fspath(b), _arrays.number(spacing, "spacing"),
        _arrays.whole(samples, "samples", 1), _arrays.whole(points, "points", 0),
        _arrays.whole(threads, "threads", 0, 2**31 - 1), progress)))


@checked
def cut_cells(V: Any, F: Any = None, sites: Any = None, max_error: float | None = None, *,
              groups: Any = None, weights: Any = None, lines: Any = None, regions: Any = None,
              barriers: Any = None, edge_lengths: Any = None, engine: str = "window", keep_slits: bool = False,
              threads: int = 0, progress: Progress | None = None
              ) -> tuple[NDArray[np.float64], NDArray[np.uint32], NDArray[np.int64],
                         NDArray[np.int64]]:
    """The mesh cut along the bisectors of voronoi(): vertices, faces, the site of each face (-1:
    none reaches it), and the face of the input that it is a part of. It is a manifold, and the faces
    of a site have the area of its cell.

    sites, max_error, groups, weights, lines, regions, barriers, edge_lengths, engine and keep_slits
    are those of voronoi(), which has ``chord`` besides.

    >>> V, F = remesh.examples.sphere(3)
    >>> W, G, site, source = remesh.cut_cells(V, F, [0, 1])
    >>> len(G) > len(F), np.unique(site).tolist(), len(source) == len(G)
    (True, [0, 1], True)
    """
    mesh = _kinds.take(V, F)
    return _remesh.cut_cells(mesh.V, mesh.F, all_sites(mesh, sites, groups, weights, lines, regions),
                             surface_of(mesh, barriers, edge_lengths, keep_slits),
                             *_common(engine, max_error, threads), progress)


@checked
def geodesic_distance(V: Any, F: Any = None, sources: Any = None, max_error: float | None = None, *,
                      targets: Any = None, radius: float | None = None, weights: Any = None,
                      lines: Any = None, regions: Any = None,
                      barriers: Any = None, edge_lengths: Any = None, engine: str = "window", keep_slits: bool = False, threads: int = 0,
                      progress: Progress | None = None) -> NDArray[np.float64]:
    """#V: the distance along the surface of each vertex from the nearest of the sources; infinity
    where there is none on the same component.

    sources: as ``sites`` of voronoi(). max_error, weights, lines, regions, barriers, edge_lengths, engine,
    keep_slits: likewise.
    targets: points given in the same ways; the result is their distances, one for each.
    radius: what is farther away gets infinity; only faces so near to a source are looked at.
    targets and radius need the engine ``"window"``.

    >>> V, F = remesh.examples.sphere(4)
    >>> d = remesh.geodesic_distance(V, F, [0], max_error=0)
    >>> bool(abs(d[1] - np.pi) < 0.01)  # half around
    True
    """
    mesh = _kinds.take(V, F)
    given = all_sites(mesh, sources, None, weights, lines, regions)
    surface = surface_of(mesh, barriers, edge_lengths, keep_slits)
    name, error, num_threads = _common(engine, max_error, threads)
    if targets is not None or radius is not None:
        if engine != "window":
            raise InvalidOption(f"targets and radius need engine='window', not {engine!r}")
        to = take_sites(mesh, [0] if targets is None else targets)
        return _remesh.distances_at(
            mesh.V, mesh.F, given, surface, *to, targets is not None,
            float("inf") if radius is None else _arrays.number(radius, "radius"),
            1e-4 if error is None else error, num_threads, progress)
    return _remesh.geodesic_distance(mesh.V, mesh.F, given, surface, name, error, num_threads,
                                     progress)


@checked
def nearest_sites(V: Any, F: Any = None, sites: Any = None, k: int = 1, max_error: float = 1e-4, *,
                  groups: Any = None, weights: Any = None, lines: Any = None, regions: Any = None,
                  barriers: Any = None, edge_lengths: Any = None, keep_slits: bool = False,
                  threads: int = 0, progress: Progress | None = None
                  ) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """The k nearest sites of each vertex along the surface, and their distances: two arrays #V x k,
    the nearest first; -1 and infinity where fewer sites reach.

    sites, max_error, groups, weights, lines, regions, barriers, edge_lengths and keep_slits: as for
    voronoi(). No line hides what lies beyond it.

    >>> V, F = remesh.examples.sphere(3)
    >>> sites, distances = remesh.nearest_sites(V, F, [0, 1, 2], k=2)
    >>> sites[0].tolist()[0], float(distances[0, 0]), sites.shape == (len(V), 2)
    (0, 0.0, True)
    """
    mesh = _kinds.take(V, F)
    count = _arrays.whole(k, "k", 1)
    found, distances = _remesh.nearest_sites(
        mesh.V, mesh.F, all_sites(mesh, sites, groups, weights, lines, regions),
        surface_of(mesh, barriers, edge_lengths, keep_slits), count,
        _arrays.number(max_error, "max_error"), _arrays.whole(threads, "threads", 0, 2**31 - 1),
        progress)
    return found.reshape(-1, count), distances.reshape(-1, count)
