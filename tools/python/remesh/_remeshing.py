"""The whole pipeline: from a mesh to the dual of its geodesic Voronoi diagram."""

from __future__ import annotations

import json
import operator
import os
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _arrays, _given, _kinds, _options, _page, _remesh, _transfer
from ._arguments import checked
from ._remesh import InvalidOption
from ._stages import Progress


@dataclass(frozen=True, repr=False)
class Result:
    """The result of remesh().

    >>> V, F = remesh.examples.sphere(3)
    >>> result = remesh.remesh(V, F, 200, region=V[F].mean(axis=1)[:, 2] > 0)
    >>> remesh.remesh(V, F, 200)
    <remesh.Result: 200 vertices, 396 faces>
    >>> len(result.V) - len(result.kept_vertices)  # of 200, others are on the seam
    168
    >>> bool((result.V[:len(result.kept_vertices)] == V[result.kept_vertices]).all())
    True
    """

    #: #V x 3: float32 if the input's is, else float64.
    V: NDArray[Any]
    #: #F x 3: of the input's type if that has 32 bits or more, else int64.
    F: NDArray[Any]
    #: #V, int64: the face of the input on which each vertex lies: the nearest point of the sheet
    #: to which it belongs.
    source_face: NDArray[np.int64]
    #: #V x 3: the coordinates in that face, 0 or more with the sum 1.
    barycentric: NDArray[np.float64]
    #: With ``region``: vertices and faces of the input that stayed as they were, ascending. They are
    #: the first ones of the result. Otherwise of length 0.
    kept_vertices: NDArray[np.int64]
    kept_faces: NDArray[np.int64]
    #: What was done and found: the keys of the program's ``--report``. ``report["warnings"]`` is a
    #: list of the texts of Python's warnings: what the program warns of, or tells of a result that
    #: is too coarse, and of edges that cleaning cut apart.
    report: dict[str, Any]
    #: Values of the input that were carried over, by name.
    vertex_data: dict[str, NDArray[Any]]
    face_data: dict[str, NDArray[Any]]
    #: With ``uv``: #F x 3 x 2, the texture coordinates of each face's corners; otherwise None.
    uv: NDArray[np.float64] | None
    #: The result as what was given: an object of the same type with its data, or ``(V, F)``.
    mesh: Any
    # Keeps the arrays of the input.
    _source: _page.Source

    def html(self, path: str | os.PathLike[str] | None = None, *, original_name: str = "original",
             result_name: str = "result", progress: Progress | None = None) -> str:
        """The report page: original, result and cells side by side, with all figures; one file for
        any browser, which needs no network. It is written to ``path``, if one is given.

        Raises InvalidOption in a build without node, which makes the parts of pages, FileError,
        Cancelled. In Jupyter a result shows its page by itself.

        >>> V, F = remesh.examples.sphere(3)
        >>> page = remesh.remesh(V, F, 200).html("sphere.html", original_name="sphere.ply")
        >>> page[:15], "sphere.ply" in page
        ('<!doctype html>', True)
        """
        text = _page.page(self, self._source, original_name, result_name, progress)
        if path is not None:
            _page.write(text, path)
        return text

    def _repr_html_(self) -> str | None:
        return _page.frame(self.html()) if _remesh.has_viewer() else None

    def __repr__(self) -> str:
        count = len(self.report["warnings"])
        warnings = f", {count} warning{'s' if count > 1 else ''}" if count else ""
        return f"<remesh.Result: {len(self.V)} vertices, {len(self.F)} faces{warnings}>"


@checked
def remesh(
    V: Any,
    F: Any = None,
    n: Any = None,
    *,
    edge_length: Any = None,
    max_distance: Any = None,
    faces: Any = None,
    n_clusters: Any = None,
    adaptive: bool = False,
    sizing: Any = None,
    face_sizing: Any = None,
    density: Any = None,
    size_at: Any = None,
    min_edge: Any = None,
    max_edge: Any = None,
    gradation: Any = None,
    min_angle: Any = None,
    max_angle: Any = None,
    longest_edge: Any = None,
    features: Any = "auto",
    feature_edges: Any = None,
    face_labels: Any = None,
    junctions: str = "apart",
    boundary: str = "keep",
    topology: str = "exact",
    keep_slits: bool = False,
    drop_components: float = 0,
    weld: Any = None,
    fill_holes: int = 0,
    wrap: Any = None,
    region: Any = None,
    lock: Any = None,
    lock_boundary: bool = False,
    strict: bool = False,
    transfer: Any = "all",
    uv: Any = None,
    sites: Any = None,
    keep_sites: bool = False,
    init: str = "blue-noise",
    relax: int = 60,
    tile: int = 10000,
    fit: bool | None = None,
    engine: str = "window",
    max_error: float | None = None,
    steiner_points: int = 8,
    delaunay: str = "intrinsic",
    seed: int = 1,
    threads: int = 0,
    memory_limit: Any = "75%",
    progress: Progress | None = None,
) -> Result:
    """Replaces a mesh by a clean one whose vertices are distributed as asked for.

    The result is an oriented 2-manifold with the topology of the repaired input. The options are
    those of the program ``remesh``, with its defaults.

    How many vertices, at most one of these:

    - ``n`` (or ``n_clusters``): so many, or a percentage of the input's (``"10%"``); 2000 if
      nothing else is given. ``remesh(mesh, 2000)`` works where the mesh is one object.
    - ``faces``: so many faces, up to a few where there is a boundary.
    - ``edge_length``: the mean edge, in mesh units or percent of the diagonal (``"2%"``).
    - ``max_distance``: no point of the result lies farther from the input, and none of the input
      from the result; proved. Edges are adaptive. ConstraintUnmet if it cannot be met.
    - ``sites``: these, as in voronoi(); with ``keep_sites`` they are not relaxed.

    Where:

    - ``adaptive``: shorter edges where the surface is curved.
    - ``sizing``: the length of edges at each vertex (#V numbers, one for all, a function of V, or
      the name of values of the mesh). It gives the number of vertices, too, if nothing else does;
      otherwise lengths count only relative to each other.
    - ``face_sizing``: likewise, at each face (#F numbers, or the name of values of the mesh), such
      as ``np.where(labels == 3, 0.05, 0.2)``.
    - ``density``: likewise, vertices per area in any unit.
    - ``size_at``: places where edges have a length, a dictionary each: ``length`` (mesh units or
      percent of the diagonal), and one or more of ``sites``, ``lines`` and ``regions`` as in
      voronoi(); with ``radius`` up to this distance around them. From there edges grow by
      ``gradation`` along the surface.
    - ``min_edge``, ``max_edge``, ``gradation`` (1.3): bounds of edges that differ.

    Bounds of all triangles; ConstraintUnmet where they cannot be kept:

    - ``min_angle`` (up to 30) and ``max_angle`` (90 and more): degrees. The report lists the
      triangles that creases or corners of the input force beyond them.
    - ``longest_edge``: mesh units or percent of the diagonal. The result has as many more vertices
      as that takes.

    What is kept:

    - ``features``: creases that become chains of edges: ``"auto"``, ``"off"``, or all above an
      angle in degrees. ``feature_edges``: pairs of vertices that are creases as well.
      ``face_labels``: borders between faces of different labels, or of different values of the mesh
      that have this name, are creases as well.
    - ``junctions``: ``"apart"`` or ``"keep"``; ``boundary``: ``"keep"`` or ``"free"``;
      ``topology``: ``"exact"``, or ``"add"`` to add vertices that the topology needs.
    - ``keep_slits``: open edges at one place, such as the two sides of a slit, are not welded.
    - ``drop_components``: smaller components are dropped; a share of the area from 0 to 1.
    - ``weld``: vertices of the boundary within this length (``"0.1%"`` of the diagonal), and within
      less than half of each edge there, become one. ``fill_holes``: holes of at most so many edges
      are filled. Neither with ``region``.
    - ``wrap``: the outside of the mesh as balls of this radius (``"1%"`` of the diagonal; True:
      half the spacing) see it is remeshed: one closed surface without intersections for each part,
      whatever the mesh. With True solids whose union has no gaps are united exactly. Not with ``sites``, ``feature_edges``, ``lock``, ``region`` or
      ``max_distance``.
    - ``region``: only these faces are remeshed: something other than 0 (or False) for each of them,
      or the name of such values of the mesh. All others stay, bit for bit, and are the first ones
      of the result (Result.kept_faces). ``n``, ``faces`` and lengths count in the region, the
      vertices that it shares with other faces included. Not with ``sites`` or ``drop_components``.
    - ``lock``: vertices that stay where they are, bit for bit: their numbers, or #V truth values.
      Not with ``sites``. ``lock_boundary``: edges of the boundary stay as they are.
    - ``strict``: ConstraintUnmet if the result has more pairs of intersecting faces than the input,
      or is too coarse for creases, walls or components of it. Otherwise the report tells.
    - ``transfer``: values of the input for the result: ``"all"`` that the mesh object has,
      ``"none"``, names of them, or arrays by name with a row for each vertex or each face. Floats
      are interpolated, and so are colours (uint8, 3 or 4 columns); anything else is a label.
      Vertex values called ``Normals`` are computed anew.
    - ``uv``: texture coordinates, #F x 3 x 2 for the corners of each face, or #V x 2. Result.uv has
      those of the result. Seams, where faces disagree about a common corner, become chains of
      edges, unless they are too close to each other for the spacing; the report tells. NaN where a
      corner has none.

    How: ``init`` (``"blue-noise"``, ``"farthest"``, ``"random"``), ``relax`` steps, ``fit``,
    ``tile`` (vertices of a tile, at most: large results are made in tiles; 0: in one piece),
    ``engine`` (``"window"``, ``"steiner"``), ``max_error``, ``steiner_points``,
    ``delaunay`` (``"intrinsic"``, ``"extrinsic"``, ``"off"``), ``seed``, ``threads`` (0: all
    cores; the same bytes for any number).

    ``memory_limit``: OutOfMemory where the process would use more, before the work if that is clear
    by then: bytes, ``"500M"``, ``"3G"``, a percentage of what the machine has, or None.

    progress: ``progress(fraction, stage)`` is called some twenty times a second; fractions are those
    of the whole call, never fall, and end with 1. It ends the call with Cancelled if it returns
    something false other than None. What it raises passes through.

    Raises InvalidOption, InvalidInput, InvalidSites, ConstraintUnmet, OutOfMemory, Cancelled, and
    KeyboardInterrupt after Ctrl-C in the main thread; all but the last are remesh.Error.

    >>> V, F = remesh.examples.torus()
    >>> result = remesh.remesh(V, F, 600, transfer={"height": V[:, 2]})
    >>> result.V.shape, result.report["input_topology"]["genus"]
    ((600, 3), 1)
    >>> bool(abs(result.vertex_data["height"] - result.V[:, 2]).max() < 0.01)
    True
    >>> turn = np.arctan2(V[F][..., 1], V[F][..., 0]) / (2 * np.pi)  # around the axis
    >>> turn += turn < turn.max(axis=1, keepdims=True) - 0.5  # a seam where it jumps
    >>> textured = remesh.remesh(V, F, 600, uv=np.stack([turn, V[F][..., 2]], axis=2))
    >>> textured.uv.shape == (len(textured.F), 3, 2), bool(np.ptp(textured.uv, axis=1).max() < 0.5)
    (True, True)
    >>> corners = V[F[result.source_face]]  # where the vertices lie on the input
    >>> places = np.einsum("ij,ijk->ik", result.barycentric, corners)
    >>> bool(abs(places - result.V).max() < 0.01)
    True
    """
    if _kinds.is_mesh(V) and n is None and _is_count(F):
        F, n = None, F
    call = _page.call_text(remesh, locals())
    mesh = _kinds.take(V, F)
    _options.only_one(n=n, n_clusters=n_clusters, faces=faces, edge_length=edge_length,
                      max_distance=max_distance, sites=sites)
    options = _remesh.Options()
    num_vertices = _options.set_kept(options, mesh, region, lock)
    for name, value in (("n", n), ("n_clusters", n_clusters)):
        if value is not None:
            options.num_samples = _options.count(num_vertices, value, name)
    if faces is not None:
        options.set_num_faces(_arrays.whole(faces, "faces", 1))
    if edge_length is not None:
        options.set_edge_length(_options.length(mesh, edge_length, "edge_length"))
    if max_distance is not None:
        options.set_max_distance(_options.length(mesh, max_distance, "max_distance"))
    has_count = any(v is not None for v in (n, n_clusters, faces, edge_length, max_distance, sites))
    _options.set_sizing(options, mesh, has_count=has_count, adaptive=adaptive, sizing=sizing,
                        face_sizing=face_sizing, density=density, size_at=size_at,
                        max_distance=max_distance, min_edge=min_edge, max_edge=max_edge,
                        gradation=gradation)
    _given.set_places(options, mesh, size_at)
    _options.set_bounds(options, mesh, min_angle, max_angle, longest_edge)
    _options.set_features(options, mesh, features, feature_edges, face_labels)
    _options.set_sites(options, mesh, sites, keep_sites)
    options.junctions = junctions
    options.boundary = boundary
    options.topology = topology
    options.keep_slits = bool(keep_slits)
    options.lock_boundary = bool(lock_boundary)
    options.drop_components = _arrays.number(drop_components, "drop_components")
    options.weld = 0 if weld is None else _options.length(mesh, weld, "weld")
    options.fill_holes = _arrays.whole(fill_holes, "fill_holes")
    if wrap is not None and wrap is not False:
        options.wrap = 0 if wrap is True else _options.length(mesh, wrap, "wrap")
    options.init = init
    options.relax_steps = _arrays.whole(relax, "relax", 0, 1_000_000)
    options.samples_per_tile = _arrays.whole(tile, "tile", 0, 1_000_000_000)
    options.fit = None if fit is None else bool(fit)
    options.engine = engine
    options.max_error = None if max_error is None else _arrays.number(max_error, "max_error")
    options.steiner_points = _arrays.whole(steiner_points, "steiner_points", 0, 1000)
    options.delaunay = delaunay
    options.seed = _arrays.whole(seed, "seed", 0, 2**64 - 1)
    options.num_threads = _arrays.whole(threads, "threads", 0, 2**31 - 1)
    wanted = _transfer.wanted(mesh, transfer)
    texture = _transfer.texture(mesh, uv, transfer)
    if texture is not None:
        options.texture_seams = _remesh.texture_seams(texture, mesh.V, mesh.F)
    return _run(mesh, options, wanted, texture, call, bool(strict),
                _options.memory_limit(memory_limit), progress)


def _is_count(value: Any) -> bool:
    if isinstance(value, str):
        return True
    try:
        operator.index(value)
    except TypeError:
        return isinstance(value, float)
    return True


def _run(mesh: _kinds.Given, options: _remesh.Options, wanted: _transfer.Wanted,
         texture: _arrays.Floats | None, call: str, strict: bool, memory_limit: str,
         progress: Progress | None) -> Result:
    if progress is not None and not callable(progress):
        raise InvalidOption(f"progress is {progress!r}; give a function of a fraction and a stage")
    (new_V, new_F, source_face, barycentric, samples, kept_vertices, kept_faces,
     text, made) = _remesh.remesh(mesh.V, mesh.F, options, bool(wanted.of_faces), strict, memory_limit,
                              progress)
    report = json.loads(text)
    report["warnings"] = mesh.warnings + report["warnings"]
    for warning in report["warnings"]:
        warnings.warn(warning, stacklevel=4)  # Where remesh() is called: see _arguments.
    of_vertices, of_faces = _transfer.carry(wanted, mesh, new_V, new_F, source_face, barycentric,
                                            samples)
    _transfer.keep(wanted.of_vertices, kept_vertices, of_vertices)
    _transfer.keep(wanted.of_faces, kept_faces, of_faces)
    uv = None if texture is None else _transfer.carry_texture(
        texture, mesh, new_V, new_F, source_face, barycentric, kept_faces, options.num_threads)
    like_V, like_F = mesh.like_given(new_V, new_F)
    return Result(like_V, like_F, source_face, barycentric, kept_vertices, kept_faces, report,
                  of_vertices, of_faces, uv,
                  mesh.build(like_V, like_F, of_vertices, of_faces, uv),
                  _page.Source(mesh.V, mesh.F, made, call, _page.labels_of(wanted)))
