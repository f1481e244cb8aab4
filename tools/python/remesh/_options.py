"""Turns the keywords of remesh() into the options of the extension."""

from __future__ import annotations

from typing import Any

import numpy as np

from . import _arrays, _kinds, _remesh, _stages
from ._remesh import InvalidOption


def count(num_vertices: int, value: Any, name: str) -> int:
    """A number of vertices: 2000, or "10%" of the input's."""
    if not isinstance(value, str):
        return _arrays.whole(value, name, 1)
    percent = _percent(value)
    if percent is None or percent <= 0:
        raise InvalidOption(f"{name} is {value!r}; use a whole number of 1 or more, or a percentage "
                            "of the input's vertices (such as '10%')")
    return max(1, round(num_vertices * percent / 100))


def length(mesh: _kinds.Given, value: Any, name: str) -> float:
    """Mesh units: 0.5, or "2%" of the diagonal of the mesh."""
    share = _percent(value) if isinstance(value, str) else None
    try:
        result = float(value) if share is None else (
            share / 100 * _remesh.diagonal(mesh.V, mesh.F))
    except (TypeError, ValueError):
        result = np.nan
    if not 0 < result < np.inf:
        raise InvalidOption(f"{name} is {value!r}; use a number above 0, or a percentage of the "
                            "diagonal of the mesh (such as '2%')")
    return result


def _percent(text: str) -> float | None:
    try:
        return float(text.rstrip()[:-1]) if text.rstrip().endswith("%") else None
    except ValueError:
        return None


def only_one(**given: Any) -> None:
    """Refuses several ways to say how many vertices there are."""
    names = [name for name, value in given.items() if value is not None]
    if len(names) > 1:
        raise InvalidOption(f"{' and '.join(names)} each give the number of vertices; use one of "
                            "them")


def set_sizing(options: _remesh.Options, mesh: _kinds.Given, *, has_count: bool, adaptive: bool,
               sizing: Any, face_sizing: Any, density: Any, size_at: Any, max_distance: Any,
               min_edge: Any, max_edge: Any, gradation: Any) -> None:
    """Says where edges are how long."""
    differs = adaptive or any(v is not None for v in (sizing, face_sizing, density, size_at, max_distance))
    if not differs and any(v is not None for v in (min_edge, max_edge, gradation)):
        raise InvalidOption("min_edge, max_edge and gradation bound edges that differ; add "
                            "adaptive, max_distance, sizing, face_sizing, size_at or density, or "
                            "leave them out")
    has_values = [v is not None for v in (sizing, face_sizing, density)]
    if sum(has_values) + bool(adaptive) > 1:
        raise InvalidOption("several of adaptive, sizing, face_sizing and density are given; use "
                            "one of them")
    if max_distance is not None and any(has_values):
        raise InvalidOption("max_distance excludes sizing, face_sizing and density")
    if adaptive:
        options.set_adaptive()
    if not has_count and (sizing is not None or face_sizing is not None):
        options.set_count_of_lengths()
    if sizing is not None:
        options.set_target_lengths(_at_vertices(mesh, sizing, "sizing"))
    if face_sizing is not None:
        if isinstance(face_sizing, str):
            face_sizing = _named(mesh.data()[1], face_sizing, "face_sizing", "faces")
        options.set_face_lengths(_arrays.one_each(face_sizing, len(mesh.F), "face_sizing", "faces"))
    if density is not None:
        options.set_densities(_at_vertices(mesh, density, "density"))
    if min_edge is not None:
        options.min_edge = length(mesh, min_edge, "min_edge")
    if max_edge is not None:
        options.max_edge = length(mesh, max_edge, "max_edge")
    if gradation is not None:
        options.gradation = _arrays.number(gradation, "gradation")


def set_bounds(options: _remesh.Options, mesh: _kinds.Given, min_angle: Any, max_angle: Any,
               longest_edge: Any) -> None:
    """Says what no triangle exceeds."""
    if min_angle is not None:
        options.min_angle = _arrays.number(min_angle, "min_angle")
    if max_angle is not None:
        options.max_angle = _arrays.number(max_angle, "max_angle")
    if longest_edge is not None:
        options.longest_edge = length(mesh, longest_edge, "longest_edge")


def _at_vertices(mesh: _kinds.Given, given: Any, name: str) -> _arrays.Floats:
    """Numbers for the vertices: an array, a function of the positions, a name of the mesh, or one
    number for all."""
    if np.ndim(given) == 0 and not callable(given) and not isinstance(given, str):
        return np.full(len(mesh.V), _arrays.number(given, name))
    if callable(given):
        given = given(mesh.V.copy())
    elif isinstance(given, str):
        given = _named(mesh.data()[0], given, name, "vertices")
    return _arrays.one_each(given, len(mesh.V), name, "vertices")


def _named(values: _kinds.Data, given: str, name: str, element: str) -> Any:
    if given not in values:
        raise InvalidOption(f"{name}: the mesh has no values {given!r} of {element}; it has: "
                            f"{', '.join(values) or 'none'}")
    return values[given]


def set_features(options: _remesh.Options, mesh: _kinds.Given, features: Any, feature_edges: Any,
                 face_labels: Any) -> None:
    """Says which creases are kept."""
    if features in ("auto", "off"):
        options.features = features
    elif features is None or isinstance(features, (bool, str)):
        raise InvalidOption(f"features is {features!r}; use 'auto', 'off' or an angle in degrees")
    else:
        options.features = "angle"
        options.feature_angle = _arrays.number(features, "features")
    if feature_edges is not None:
        edges = _arrays.integers(feature_edges, "feature_edges")
        if edges.size > 0 and (edges.ndim != 2 or edges.shape[1] != 2):
            raise InvalidOption(f"feature_edges has the shape {edges.shape}; give a row of two "
                                "vertices for each edge")
        wrong = _arrays.first_outside(edges, len(mesh.V))
        if wrong is not None:
            raise InvalidOption(f"feature edge {wrong // 2} names vertex {edges.ravel()[wrong]}, "
                                f"but the mesh has only {len(mesh.V)} vertices, counted from 0; "
                                "correct or delete the edge")
        options.feature_edges = edges.reshape(-1, 2).tolist()
    if face_labels is not None:
        if isinstance(face_labels, str):
            face_labels = _named(mesh.data()[1], face_labels, "face_labels", "faces")
        labels = np.asarray(face_labels)
        if labels.shape != (len(mesh.F),):
            raise InvalidOption(f"face_labels has the shape {labels.shape}, but the mesh has "
                                f"{len(mesh.F)} faces; give one for each")
        numbers = np.unique(labels, return_inverse=True)[1]
        options.set_face_labels(numbers.reshape(-1).astype(np.uint32))


def set_kept(options: _remesh.Options, mesh: _kinds.Given, region: Any, lock: Any) -> int:
    """Says what stays as it is.

    Returns the number of vertices of what is remeshed."""
    if lock is not None:
        given = np.asarray(lock)
        is_mask = given.dtype == bool and given.shape == (len(mesh.V),)
        vertices = np.flatnonzero(given) if is_mask else _arrays.integers(given, "lock")
        wrong = _arrays.first_outside(vertices, len(mesh.V))
        if vertices.ndim != 1 or wrong is not None:
            what = f"has the shape {vertices.shape}" if wrong is None else (
                f"names vertex {vertices.ravel()[wrong]}")
            raise InvalidOption(f"lock {what}; give a list of vertices, counted from 0, below "
                                f"{len(mesh.V)}")
        options.set_locked(_arrays.to_indices(vertices))
    if region is None:
        return len(mesh.V)
    if isinstance(region, str):
        region = _named(mesh.data()[1], region, "region", "faces")
    flags = _arrays.one_each(region, len(mesh.F), "region", "faces") != 0
    if not flags.any():
        raise InvalidOption("region is 0 for all faces; mark the faces to remesh, or leave out "
                            "region")
    options.set_region(flags.view(np.uint8))
    return len(np.unique(mesh.F[flags]))


def memory_limit(value: Any) -> str:
    """As the program's --memory-limit; empty: none."""
    if value is None or isinstance(value, str):
        return value or ""
    return str(_arrays.whole(value, "memory_limit", 1, 2**63 - 1))


def set_sites(options: _remesh.Options, mesh: _kinds.Given, sites: Any, keep_sites: bool) -> None:
    """Says where vertices start."""
    if sites is not None:
        options.set_sites(*_stages.take_sites(mesh, sites))
    elif keep_sites:
        raise InvalidOption("keep_sites needs sites")
    options.keep_sites = bool(keep_sites)
