"""Clean triangle meshes out of dense or dirty ones, by geodesic Voronoi diagrams.

    >>> import remesh
    >>> V, F = remesh.examples.sphere(3)
    >>> result = remesh.remesh(V, F, 500)
    >>> result.V.shape, result.F.shape
    ((500, 3), (996, 3))

A mesh is two arrays: ``V`` (#V x 3, any floating-point or integer type) and ``F`` (#F x 3, any
integer type, counted from 0), or one object: a remesh.Mesh, as read() returns it, or a mesh of
PyVista, VTK (vtkPolyData), meshio or trimesh. Inputs are never changed, and must not be changed by other
threads during a call. Every function releases the interpreter, may run in several threads at
once, and gives the same bytes for any number of threads. Ctrl-C ends a call in the main thread.
Of functions that have them, ``threads`` is how many are used (0: all cores), ``seed`` that of the
random numbers, and ``progress`` a function of the fraction that is done and the stage: see remesh().
"""

import sys as _sys

from . import examples, tiles
from ._diagrams import (
    BisectorArcs,
    Voronoi,
    compare,
    cut_cells,
    geodesic_distance,
    nearest_sites,
    voronoi,
)
from ._evaluation import evaluate
from ._files import read, write
from ._isolines import Isolines, isolines
from ._mesh import Mesh
from ._paths import Paths, paths
from ._remesh import (
    Cancelled,
    ConstraintUnmet,
    Error,
    FileError,
    InvalidInput,
    InvalidOption,
    InvalidSites,
    OutOfMemory,
)
from ._remesh import version as __version__
from ._remeshing import Result, remesh
from ._stages import Cleaned, Relaxed, Sites, clean, relax_sites, sample_sites

if hasattr(_sys.modules.get("pyvista"), "register_dataset_accessor"):
    from . import _pyvista

__all__ = [
    "BisectorArcs",
    "Cancelled",
    "Cleaned",
    "ConstraintUnmet",
    "Error",
    "FileError",
    "InvalidInput",
    "InvalidOption",
    "InvalidSites",
    "Isolines",
    "Mesh",
    "OutOfMemory",
    "Paths",
    "Relaxed",
    "Result",
    "Sites",
    "Voronoi",
    "__version__",
    "clean",
    "compare",
    "cut_cells",
    "evaluate",
    "examples",
    "geodesic_distance",
    "isolines",
    "nearest_sites",
    "paths",
    "read",
    "relax_sites",
    "remesh",
    "sample_sites",
    "tiles",
    "voronoi",
    "write",
]
