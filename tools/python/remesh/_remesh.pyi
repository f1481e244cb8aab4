from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

version: str

class Error(Exception): ...
class InvalidOption(Error, ValueError): ...
class InvalidInput(Error, ValueError): ...
class InvalidSites(InvalidInput): ...
class ConstraintUnmet(Error, RuntimeError): ...
class Cancelled(Error): ...

_Floats = NDArray[np.float64]
_Indices = NDArray[np.uint32]
_Flags = NDArray[np.uint8]
_Numbers = NDArray[np.int64]
_Progress = Callable[[float, str], Any] | None

class Options:
    num_samples: int
    drop_components: float
    feature_angle: float
    feature_edges: list[list[int]]
    texture_seams: list[list[int]]
    seed: int
    relax_steps: int
    keep_sites: bool
    fit: bool | None
    num_threads: int
    topology: str
    boundary: str
    init: str
    features: str
    junctions: str
    delaunay: str
    engine: str
    max_error: float | None
    steiner_points: int
    is_adaptive: bool
    max_distance: float
    min_edge: float
    max_edge: float
    gradation: float
    edge_length: float
    num_faces: int
    gives_count: bool
    def __init__(self) -> None: ...
    def set_sites(self, faces: _Indices, barycentric: _Floats) -> None: ...
    def set_face_labels(self, labels: _Indices) -> None: ...
    def set_region(self, flags: _Flags) -> None: ...
    def set_locked(self, vertices: _Indices) -> None: ...
    def set_target_lengths(self, values: _Floats) -> None: ...
    def set_densities(self, values: _Floats) -> None: ...

def remesh(positions: _Floats, triangles: _Indices, options: Options, with_faces: bool,
           progress: _Progress) -> tuple[_Floats, _Indices, _Numbers, _Floats, _Indices, _Numbers,
                                         _Numbers, str]: ...
def voronoi(positions: _Floats, triangles: _Indices, faces: _Indices, barycentric: _Floats,
            engine: str, max_error: float | None, num_threads: int,
            progress: _Progress) -> dict[str, Any]: ...
def geodesic_distance(positions: _Floats, triangles: _Indices, faces: _Indices,
                      barycentric: _Floats, engine: str, max_error: float | None,
                      num_threads: int, progress: _Progress) -> _Floats: ...
def clean(positions: _Floats, triangles: _Indices, num_threads: int, progress: _Progress
          ) -> tuple[_Floats, _Indices, _Numbers, _Numbers, dict[str, int]]: ...
def sample_sites(positions: _Floats, triangles: _Indices, num_samples: int, init: str,
                 boundary: str, seed: int, num_threads: int,
                 progress: _Progress) -> tuple[_Numbers, _Floats]: ...
def relax_sites(positions: _Floats, triangles: _Indices, faces: _Indices, barycentric: _Floats,
                steps: int, tolerance: float, is_fixed: list[int], boundary: str,
                stop: Callable[[list[float]], Any] | None, num_threads: int,
                progress: _Progress) -> tuple[_Numbers, _Floats, _Floats]: ...
def nearest_points(positions: _Floats, triangles: _Indices, points: _Floats,
                   progress: _Progress) -> tuple[_Numbers, _Floats]: ...
def transfer_vertex_values(values: _Floats, positions: _Floats, triangles: _Indices,
                           faces: _Indices, barycentric: _Floats, is_label: bool) -> _Floats: ...
def transfer_face_values(values: _Floats, samples: _Indices, is_label: bool) -> _Floats: ...
def texture_seams(values: _Floats, positions: _Floats, triangles: _Indices
                  ) -> list[list[int]]: ...
def transfer_corner_values(values: _Floats, positions: _Floats, triangles: _Indices,
                           result_positions: _Floats, result_triangles: _Indices,
                           faces: _Indices, barycentric: _Floats,
                           num_threads: int) -> _Floats: ...
def vertex_normals(positions: _Floats, triangles: _Indices) -> _Floats: ...
def evaluate(positions: _Floats, triangles: _Indices, result_positions: _Floats,
             result_triangles: _Indices, samples: int, num_threads: int,
             progress: _Progress) -> str: ...
def diagonal(positions: _Floats, triangles: _Indices) -> float: ...
