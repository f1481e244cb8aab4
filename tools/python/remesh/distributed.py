"""Tiles meshed by the workers of dask.distributed (Debian: python3-distributed), on one machine or
many that share a folder. A worker that is lost costs the tile that it worked on.

On one machine, with as many workers as it has cores:

    python3 -m remesh.distributed scan.ply out.ply -n 1000000
"""

from __future__ import annotations

import argparse
import importlib
import os
import sys
import tempfile
from contextlib import ExitStack
from typing import Any

from . import tiles
from ._files import write
from ._remesh import Error
from ._stages import Progress
from .tiles import Path


def mesh(folder: Path, client: Any = None, *, retries: int = 3,
         progress: Progress | None = None) -> tuple[int, int]:
    """Makes the meshes of all tiles of a folder, one job for each.

    client: a distributed.Client, the address of a scheduler, or None: workers on this machine, one
    for each core. Workers see the folder under the same path, and have this package. retries: how
    often a job that failed is tried again.
    progress: gets the fraction of the tiles that are done, and ``"mesh"``; a result that is false
    other than None ends the call, and what the workers are at is finished.

    Returns how many were made, and how many were there before.
    """
    from . import Cancelled
    dask: Any = importlib.import_module("distributed")
    folder = os.path.abspath(os.fspath(folder))
    count = tiles.plan(folder).num_tiles
    with ExitStack() as opened:
        if client is None:
            cluster = opened.enter_context(dask.LocalCluster(threads_per_worker=1, dashboard_address=None))
            client = opened.enter_context(dask.Client(cluster))
        elif isinstance(client, str):
            client = opened.enter_context(dask.Client(client))
        jobs = client.map(_mesh_tile, [folder] * count, range(count), retries=retries, pure=False)
        made = 0
        for done, job in enumerate(dask.as_completed(jobs), 1):
            made += job.result()
            told = None if progress is None else progress(done / count, "mesh")
            if told is not None and not told:
                client.cancel(jobs)
                raise Cancelled("the progress function ended the call")
    return made, count - made


def remesh_file(file: Path, out: Path, n: int = 2000, *, folder: Path | None = None,
                client: Any = None, tile: int = 10000, seed: int = 1, relax: int = 60,
                retries: int = 3, progress: Progress | None = None) -> None:
    """Splits a file, meshes its tiles by workers, joins them, and writes the result.

    out: the result; the extension gives the format. folder: for the tiles, which stay there; None: a
    temporary one, which only workers of this machine see. n, tile, seed and relax are those of
    tiles.split(), client and retries those of mesh().
    """
    with tempfile.TemporaryDirectory() as temporary:
        used = temporary if folder is None else folder
        tiles.split(file, used, n, tile=tile, seed=seed, relax=relax)
        mesh(used, client, retries=retries, progress=progress)
        write(out, tiles.join(used))


def _mesh_tile(folder: str, number: int) -> int:
    return tiles.mesh(folder, [number], threads=1)[0]


def _main() -> None:
    parser = argparse.ArgumentParser("python3 -m remesh.distributed", description=(
        "Remeshes a file in tiles by workers of dask.distributed."))
    parser.add_argument("file", help="binary PLY with triangles, or binary STL")
    parser.add_argument("out", help="the result; the extension gives the format")
    parser.add_argument("-n", "--samples", type=int, default=2000, help="vertices of the result")
    parser.add_argument("--tile", type=int, default=10000, help="vertices of a tile, at most")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--folder", help="for the tiles, which stay there")
    parser.add_argument("--scheduler", help="address; without it workers of this machine are used")
    given = parser.parse_args()
    try:
        remesh_file(given.file, given.out, given.samples, folder=given.folder,
                    client=given.scheduler, tile=given.tile, seed=given.seed,
                    progress=lambda share, _: print(f"{100 * share:.0f} % of the tiles", flush=True))
    except ModuleNotFoundError as error:
        sys.exit(f"remesh.distributed: error: {error}; install dask.distributed (Debian: "
                 "python3-distributed)")
    except Error as error:
        sys.exit(f"remesh.distributed: error: {error}")


if __name__ == "__main__":
    _main()
