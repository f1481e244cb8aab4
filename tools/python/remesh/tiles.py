"""Meshes that are larger than memory: a file is cut into tiles, each becomes a mesh, and these are
joined. What the program ``remesh-tiles`` does; both may work on the same folder. A step that was
stopped goes on where it was, and tiles may be meshed by any number of processes.
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Union

from numpy import int32

from . import _arrays, _remesh
from ._arguments import checked
from ._mesh import Mesh
from ._stages import Progress

#: A file or a folder.
Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Plan:
    """How a file was cut.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     remesh.write(folder + "/a.ply", *remesh.examples.sphere(5))
    ...     plan = remesh.tiles.split(folder + "/a.ply", folder, 3000, tile=600)
    >>> plan.num_faces, plan.num_tiles
    (8192, 5)
    """

    #: Of the file.
    num_faces: int
    #: Of its surface, square mesh units.
    area: float
    #: Of neighbouring vertices of the result, mesh units.
    spacing: float
    #: By tile: of its mesh, those on borders included.
    vertices: list[int]
    #: On borders between tiles.
    border_vertices: int
    #: Of creases, which tiles do not keep; split() also warns. Empty: there are none.
    warning: str

    @property
    def num_tiles(self) -> int:
        """How many tiles there are."""
        return len(self.vertices)


@checked
def split(file: Path, folder: Path, n: int = 2000, *, tile: int = 10000, seed: int = 1,
          relax: int = 60, threads: int = 0, progress: Progress | None = None) -> Plan:
    """Cuts a file into tiles of at most ``tile`` vertices (500 or more), for a result of ``n``
    vertices in all.

    relax: steps of relaxation on each of two levels.
    Creases are not kept: a mesh that has any is a warning.
    file: binary PLY with triangles, or binary STL; it is read twice and need not fit into memory.
    folder: is made if it does not exist. A plan that is there is kept if the file and the options
    are the same.
    """
    made = Plan(**_remesh.split_into_tiles(
        os.fspath(file), os.fspath(folder), _arrays.whole(n, "n", 1, 2**32 - 2),
        _arrays.whole(tile, "tile", 0, 2**32 - 2), _arrays.whole(seed, "seed", 0, 2**64 - 1),
        _arrays.whole(relax, "relax", 0, 1_000_000), _threads(threads), progress))
    if made.warning:
        warnings.warn(made.warning, stacklevel=3)  # Where split() is called: see _arguments.
    return made


@checked
def plan(folder: Path) -> Plan:
    """The plan of a folder that a file was split into."""
    return Plan(**_remesh.read_tile_plan(os.fspath(folder)))


@checked
def mesh(folder: Path, tiles: Iterable[int] | None = None, *, threads: int = 0,
         progress: Progress | None = None) -> tuple[int, int]:
    """Makes the meshes of tiles of a folder (None: of all), as many side by side as there are threads.

    Returns how many were made, and how many were there before.
    """
    chosen = range(plan(folder).num_tiles) if tiles is None else tiles
    return _remesh.mesh_tiles(os.fspath(folder),
                              [_arrays.whole(t, "tiles", 0, 2**32 - 2) for t in chosen],
                              _threads(threads), progress)


@checked
def join(folder: Path, *, threads: int = 0, progress: Progress | None = None) -> Mesh:
    """Joins the meshes of all tiles.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     remesh.write(folder + "/a.ply", *remesh.examples.sphere(5))
    ...     plan = remesh.tiles.split(folder + "/a.ply", folder + "/tiles", 3000, tile=600)
    ...     remesh.tiles.mesh(folder + "/tiles")
    ...     remesh.tiles.join(folder + "/tiles")
    (5, 0)
    <remesh.Mesh: 3000 vertices, 5996 faces>
    """
    V, F = _remesh.join_tiles(os.fspath(folder), _threads(threads), progress)
    return Mesh(V, F.view(int32))


def _threads(threads: int) -> int:
    return _arrays.whole(threads, "threads", 0, 2**31 - 1)
