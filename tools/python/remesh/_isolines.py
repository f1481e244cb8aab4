"""Lines of equal distance on surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._given import all_sites, surface_of
from ._remesh import InvalidOption
from ._stages import Progress


@dataclass(frozen=True)
class Isolines:
    """Lines of equal distance as polylines.

    >>> V, F = remesh.examples.sphere(4)
    >>> lines = remesh.isolines(V, F, [0], levels=[1.0])
    >>> len(lines.lines), lines.is_closed.tolist(), lines.levels.tolist()
    (1, [True], [1.0])
    """

    #: Points of all polylines, one after the other.
    points: NDArray[np.float64]
    #: #lines + 1: line i is ``points[offsets[i]:offsets[i+1]]``. A closed one ends with its first
    #: point.
    offsets: NDArray[np.int64]
    #: #lines: the distance of its points from the nearest site, in mesh units.
    levels: NDArray[np.float64]
    #: #lines: open lines end on the boundary of the surface.
    is_closed: NDArray[np.bool_]

    @property
    def lines(self) -> list[NDArray[np.float64]]:
        """The polylines, each m x 3: views of ``points``."""
        return _arrays.parts(self.points, self.offsets)


@checked
def isolines(V: Any, F: Any = None, sites: Any = None, levels: Any = None, *,
             every: float | None = None, tolerance: float | None = None, max_error: float = 0,
             groups: Any = None, weights: Any = None, lines: Any = None, regions: Any = None,
             barriers: Any = None, edge_lengths: Any = None, keep_slits: bool = False,
             threads: int = 0, progress: Progress | None = None) -> Isolines:
    """The lines at which the distance along the surface from the nearest site is one of the levels.

    sites, groups, weights, lines, regions, barriers, edge_lengths, keep_slits: as for voronoi().
    levels: distances in mesh units; or every: a line at each multiple of this distance, up to the
    largest distance of a vertex.
    tolerance: largest distance of the polylines from the arcs of circles that they are drawn from,
    in mesh units; None: 0.0001 of the bounding box's diagonal. The points lie on the arcs. In front
    of edges of lines and regions they are straight.
    max_error: largest error of the distances, as a share of the exact ones; 0: points are at their
    level up to 1e-9 of it.

    >>> V, F = remesh.examples.sphere(4)
    >>> sorted(set(remesh.isolines(V, F, [0], every=1.0).levels.tolist()))
    [1.0, 2.0, 3.0]
    """
    mesh = _kinds.take(V, F)
    if (levels is None) == (every is None):
        raise InvalidOption("there are no levels, or twice; give one of levels= and every=")
    wanted = [] if levels is None else [_arrays.number(level, "levels")
                                        for level in np.atleast_1d(np.asarray(levels))]
    if levels is not None and not wanted:
        raise InvalidOption("there is no level; give one or more in levels=")
    return Isolines(**_remesh.isolines(
        mesh.V, mesh.F, all_sites(mesh, sites, groups, weights, lines, regions),
        surface_of(mesh, barriers, edge_lengths, keep_slits), wanted,
        0.0 if every is None else _arrays.number(every, "every"),
        None if tolerance is None else _arrays.number(tolerance, "tolerance"),
        _arrays.number(max_error, "max_error"),
        _arrays.whole(threads, "threads", 0, 2**31 - 1), progress))
