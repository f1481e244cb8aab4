import os
import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))
import files  # noqa: E402
import remesh  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def sphere():
    V, F = remesh.examples.sphere(4)
    V.flags.writeable = F.flags.writeable = False  # Inputs are never changed.
    return V, F


@pytest.fixture(scope="session")
def torus():
    V, F = remesh.examples.torus()
    V.flags.writeable = F.flags.writeable = False
    return V, F


@pytest.fixture(scope="session")
def organic():
    V, F = files.read_mesh(ROOT / "data" / "organic.ply")
    V.flags.writeable = F.flags.writeable = False
    return V, F


@pytest.fixture(scope="session")
def bunny():
    folder = Path(os.environ.get("AGVD_MESHES", ROOT.parent / "shared" / "meshes"))
    if not (folder / "bunny.off").exists():
        pytest.skip(f"no real mesh at {folder}")
    return files.read_mesh(folder / "bunny.off")


class PolyData:
    """Laid out like PyVista's: .points, flat .faces with the number of corners before each."""

    def __init__(self, points, faces):
        self.points = np.asarray(points)
        self.faces = np.asarray(faces)
        self.point_data, self.cell_data = {}, {}

    def triangulate(self):
        corners, rest = [], list(self.faces)
        while rest:
            count, rest = rest[0], rest[1:]
            face, rest = rest[:count], rest[count:]
            corners += [[3, face[0], face[i], face[i + 1]] for i in range(1, count - 1)]
        return type(self)(self.points, np.array(corners).ravel())


class Trimesh:
    """Laid out like trimesh's: .vertices, .faces; the constructor merges unless told not to."""

    def __init__(self, vertices=None, faces=None, process=True):
        assert process is False, "vertices would be merged and numbered anew"
        self.vertices, self.faces = np.asarray(vertices), np.asarray(faces)
        self.vertex_attributes, self.face_attributes = {}, {}
