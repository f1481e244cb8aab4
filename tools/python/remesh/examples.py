"""Small meshes by formula, for trying things out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["sphere", "torus"]


def sphere(levels: int = 4) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns V and F of the unit sphere: an octahedron, each face of which is cut into four
    ``levels`` times. It has ``8 * 4**levels`` faces.

    >>> V, F = remesh.examples.sphere(2)
    >>> len(V), len(F)
    (66, 128)
    """
    V = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    F = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4],
                  [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    for _ in range(levels):
        edges = np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
        ends, number = np.unique(edges, axis=0, return_inverse=True)
        a, b, c = F.T
        ab, bc, ca = (len(V) + number.reshape(-1, 3)).T
        V = np.vstack([V, V[ends].mean(axis=1)])
        F = np.vstack([np.stack(t, axis=1) for t in
                       ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
        V /= np.linalg.norm(V, axis=1, keepdims=True)
    return V, F.astype(np.int64)


def torus(around: int = 60, across: int = 30, radius: float = 1.0,
          tube: float = 0.4) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Returns V and F of a torus around the z axis, with ``around * across`` vertices.

    >>> V, F = remesh.examples.torus(20, 10)
    >>> len(V), len(F)
    (200, 400)
    """
    i, j = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = 2 * np.pi * i / around, 2 * np.pi * j / across
    from_axis = radius + tube * np.cos(v)
    V = np.stack([from_axis * np.cos(u), from_axis * np.sin(u), tube * np.sin(v)], axis=-1)

    def at(di: int, dj: int) -> NDArray[np.int64]:
        return np.asarray((i + di) % around * across + (j + dj) % across).ravel()

    F = np.vstack([np.stack([at(0, 0), at(1, 0), at(1, 1)], axis=1),
                   np.stack([at(0, 0), at(1, 1), at(0, 1)], axis=1)])
    return V.reshape(-1, 3), F.astype(np.int64)
