"""Sites of all kinds, and the surface that they lie on, as the extension takes them."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _arrays, _kinds, _options, _remesh
from ._remesh import InvalidInput, InvalidOption, InvalidSites
from ._stages import take_sites


def all_sites(mesh: _kinds.Given, sites: Any, groups: Any, weights: Any, lines: Any,
              regions: Any) -> _remesh.GivenSites:
    """What users give as sites, groups, weights, lines and regions: see voronoi()."""
    shapes = _shapes(mesh, lines, regions)
    num_shapes = len(shapes[0]) + len(shapes[1])
    if sites is None and num_shapes > 0:
        faces, barycentric = np.empty(0, np.uint32), np.empty((0, 3))
    else:
        faces, barycentric = take_sites(mesh, sites)
    return _remesh.GivenSites(faces, barycentric, _groups(groups, len(faces), num_shapes),
                              _weights(weights, len(faces), num_shapes), *shapes)


def set_places(options: _remesh.Options, mesh: _kinds.Given, size_at: Any) -> None:
    """Says where edges have which length: see remesh()."""
    for place in [] if size_at is None else size_at:
        known = {"sites", "lines", "regions", "length", "radius"}
        if not isinstance(place, dict) or "length" not in place or not known.issuperset(place):
            raise InvalidOption(f"size_at holds {place!r}; give dictionaries with a length, one or "
                                "more of sites, lines and regions, and maybe a radius")
        sites, lines, regions = (place.get(name) for name in ("sites", "lines", "regions"))
        if sites is None and (lines is not None or regions is not None):
            points = np.empty(0, np.uint32), np.empty((0, 3))
        else:
            points = take_sites(mesh, sites)
        radius = place.get("radius", 0)
        options.add_place(*points, *_shapes(mesh, lines, regions),
                          _options.length(mesh, place["length"], "length of size_at"),
                          0 if radius == 0 else _options.length(mesh, radius, "radius of size_at"))


def surface_of(mesh: _kinds.Given, barriers: Any, edge_lengths: Any,
               keep_slits: bool) -> _remesh.SurfaceOptions:
    """What users give as barriers and edge_lengths: see voronoi()."""
    return _remesh.SurfaceOptions(bool(keep_slits), _barriers(barriers, mesh),
                                  _lengths(edge_lengths, barriers, mesh))


def _weights(weights: Any, count: int, num_shapes: int) -> _arrays.Floats:
    if weights is None:
        return np.empty(0)
    given = np.asarray(weights)
    if given.dtype.kind not in "fiu" or given.shape not in ((count,), (count + num_shapes,)):
        raise InvalidOption(f"weights has the shape {given.shape} and holds {given.dtype}; give a "
                            f"number for each of the {count} points")
    return np.require(given, np.float64, ["C", "A"])


def _groups(groups: Any, count: int, num_shapes: int) -> _arrays.Indices:
    given = _arrays.integers([] if groups is None else groups, "groups")
    if groups is not None and given.shape not in ((count,), (count + num_shapes,)):
        raise InvalidOption(f"groups has the shape {given.shape}; give the site of each of the "
                            f"{count} points")
    wrong = _arrays.first_outside(given, count + num_shapes)
    if wrong is not None:
        raise InvalidSites(f"point {wrong} belongs to site {given[wrong]}, but {count} points "
                           "make no more sites, counted from 0")
    return _arrays.to_indices(given)


def _shapes(mesh: _kinds.Given, lines: Any, regions: Any
            ) -> tuple[list[_arrays.Indices], list[_arrays.Indices]]:
    """Chains of vertices and sets of faces."""
    def take(given: Any, name: str, least: int, count: int, many: str) -> list[_arrays.Indices]:
        taken = []
        for i, shape in enumerate([] if given is None else given):
            numbers = _arrays.integers(shape, f"{name}[{i}]")
            if numbers.ndim != 1 or len(numbers) < least:
                raise InvalidSites(f"{name}[{i}] has the shape {numbers.shape}; give {least} or "
                                   f"more {many}")
            wrong = _arrays.first_outside(numbers, count)
            if wrong is not None:
                raise InvalidSites(f"{name}[{i}] names {numbers[wrong]}, but the mesh has only "
                                   f"{count} {many}, counted from 0; correct it")
            taken.append(_arrays.to_indices(numbers))
        return taken
    return (take(lines, "lines", 2, len(mesh.V), "vertices"),
            take(regions, "regions", 1, len(mesh.F), "faces"))


def _barriers(barriers: Any, mesh: _kinds.Given) -> _arrays.Indices:
    given = _arrays.integers([] if barriers is None else barriers, "barriers")
    if given.size == 0:
        given = given.reshape(0, 2)
    if given.ndim != 2 or given.shape[1] != 2:
        raise InvalidInput(f"barriers has the shape {given.shape}; give a row of two vertices for "
                           "each edge")
    wrong = _arrays.first_outside(given, len(mesh.V))
    if wrong is not None:
        raise InvalidInput(f"barrier {wrong // 2} names vertex {given.ravel()[wrong]}, but the "
                           f"mesh has only {len(mesh.V)} vertices, counted from 0; correct it")
    return _arrays.to_indices(given)


def _lengths(edge_lengths: Any, barriers: Any, mesh: _kinds.Given) -> _arrays.Floats:
    if edge_lengths is None:
        return np.empty(0)
    given = np.asarray(edge_lengths)
    if given.dtype.kind not in "fiu" or given.shape != mesh.F.shape:
        raise InvalidInput(f"edge_lengths has the shape {given.shape} and holds {given.dtype}; "
                           "give the lengths of the three sides of each face, "
                           f"{mesh.F.shape}")
    if barriers is not None:
        raise InvalidOption("edge_lengths and barriers do not go together; leave one out")
    return np.require(given, np.float64, ["C", "A"])
