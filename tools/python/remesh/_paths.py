"""Shortest paths on surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _kinds, _remesh
from ._arguments import checked
from ._given import all_sites, surface_of
from ._remesh import InvalidOption, InvalidSites
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
    #: #paths: the length along the surface, in mesh units, without weights; infinity: no site reaches
    #: the start.
    lengths: NDArray[np.float64]
    #: #paths, int64: the site to which each leads, -1: none reaches its start; empty with ``ends``.
    sites: NDArray[np.int64]

    @property
    def lines(self) -> list[NDArray[np.float64]]:
        """The polylines, each m x 3: views of ``points``."""
        return _arrays.parts(self.points, self.offsets)


@checked
def paths(V: Any, F: Any = None, starts: Any = None, sites: Any = None, *, ends: Any = None,
          max_error: float = 0, groups: Any = None, weights: Any = None, lines: Any = None,
          regions: Any = None, barriers: Any = None, edge_lengths: Any = None,
          keep_slits: bool = False, threads: int = 0, progress: Progress | None = None) -> Paths:
    """The shortest paths along a surface, from each start to its nearest site, or from start i to
    end i.

    starts: vertices, points, or faces and barycentric coordinates, as ``sites`` of voronoi().
    sites, ends: likewise; one of them is given, and ends are as many as starts.
    max_error: a path is at most this share longer than the shortest one; 0: it is the shortest.
    groups, weights, lines, regions: of sites, as for voronoi(). Paths end at the nearest point of a
    line, and at the rim of a region.
    barriers, edge_lengths, keep_slits: as for voronoi().

    >>> V, F = remesh.examples.sphere(4)
    >>> path = remesh.paths(V, F, [0], ends=[1])  # pole to pole
    >>> bool(abs(path.lengths[0] - np.pi) < 0.01)
    True
    """
    mesh = _kinds.take(V, F)
    has_sites = any(given is not None for given in (sites, lines, regions))
    if has_sites == (ends is not None):
        raise InvalidSites("paths lead to sites, or to ends of their own; give one of sites= and "
                           "ends=")
    if ends is not None and not (groups is None and weights is None):
        raise InvalidOption("groups and weights are of sites; leave them out with ends=")
    begin = take_sites(mesh, starts)
    surface = surface_of(mesh, barriers, edge_lengths, keep_slits)
    error = _arrays.number(max_error, "max_error")
    num_threads = _arrays.whole(threads, "threads", 0, 2**31 - 1)
    if ends is None:
        to_sites = all_sites(mesh, sites, groups, weights, lines, regions)
        return Paths(**_remesh.paths_to_sites(mesh.V, mesh.F, *begin, to_sites, surface, error,
                                               num_threads, progress))
    to = take_sites(mesh, ends)
    if len(begin[0]) != len(to[0]):
        raise InvalidSites(f"there are {len(begin[0])} starts and {len(to[0])} ends; give as many "
                           "of both")
    return Paths(**_remesh.paths_between(mesh.V, mesh.F, *begin, *to, surface, error,
                                          num_threads, progress))
