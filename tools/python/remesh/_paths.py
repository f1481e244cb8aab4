"""Shortest paths on surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._remesh import InvalidSites
from ._stages import Progress, take_sites


@dataclass(frozen=True)
class Paths:
    """Shortest paths as polylines, each piece of which lies in one face.

    >>> V, F = remesh.examples.sphere(3)
    >>> paths = remesh.paths(V, F, [5, 7], sites=[0])
    >>> len(paths.lines), bool((paths.lines[0][-1] == V[0]).all())
    (2, True)
    """

    #: Points of all polylines, one after the other.
    points: NDArray[np.float64]
    #: #paths + 1: path i is ``points[offsets[i]:offsets[i+1]]``.
    offsets: NDArray[np.int64]
    #: #paths: the length along the surface, in mesh units; infinity: no site reaches the start.
    lengths: NDArray[np.float64]
    #: #paths, int64: the site to which each leads, -1: none reaches its start; empty with ``ends``.
    sites: NDArray[np.int64]

    @property
    def lines(self) -> list[NDArray[np.float64]]:
        """The polylines, each m x 3: views of ``points``."""
        return _arrays.parts(self.points, self.offsets)


def paths(V: Any, F: Any = None, starts: Any = None, sites: Any = None, *, ends: Any = None,
          max_error: float = 0, keep_slits: bool = False, threads: int = 0,
          progress: Progress | None = None) -> Paths:
    """The shortest paths along a surface, from each start to its nearest site, or from start i to
    end i.

    starts: vertices, points, or faces and barycentric coordinates, as ``sites`` of voronoi().
    sites, ends: likewise; one of them is given, and ends are as many as starts.
    max_error: a path is at most this share longer than the shortest one; 0: it is the shortest.
    keep_slits: as for voronoi().

    >>> V, F = remesh.examples.sphere(4)
    >>> path = remesh.paths(V, F, [0], ends=[1])  # pole to pole
    >>> bool(abs(path.lengths[0] - np.pi) < 0.01)
    True
    """
    mesh = _kinds.take(V, F)
    if (sites is None) == (ends is None):
        raise InvalidSites("paths lead to sites, or to ends of their own; give one of sites= and "
                           "ends=")
    begin = take_sites(mesh, starts)
    to = take_sites(mesh, sites if ends is None else ends)
    if ends is not None and len(begin[0]) != len(to[0]):
        raise InvalidSites(f"there are {len(begin[0])} starts and {len(to[0])} ends; give as many "
                           "of both")
    run = _remesh.paths_to_sites if ends is None else _remesh.paths_between
    return Paths(**run(mesh.V, mesh.F, *begin, *to, _arrays.number(max_error, "max_error"),
                       bool(keep_slits), _arrays.whole(threads, "threads", 0, 2**31 - 1),
                       progress))
