"""Lines of docs/switching.md: those on the left with the other package, where it is installed; those on the right with ours."""

import numpy as np
import pytest
import remesh


def is_close(count, other, share):
    return abs(count - other) <= share * other


def test_lines_of_pyacvd():
    pyacvd = pytest.importorskip("pyacvd")
    pyvista = pytest.importorskip("pyvista")
    V, F = remesh.examples.torus()
    mesh = pyvista.PolyData.from_regular_faces(V, F)
    clus = pyacvd.Clustering(mesh.copy())
    clus.subdivide(3)
    clus.cluster(500)
    theirs = clus.create_mesh()
    ours = remesh.remesh(mesh, n_clusters=500).mesh
    assert type(ours) is type(theirs)
    assert theirs.n_points == ours.n_points == 500

    weights = np.where(V[:, 0] > 0, 4.0, 1.0)
    clus = pyacvd.Clustering(mesh.copy(), weights=weights)
    clus.cluster(500)
    theirs = clus.create_mesh()
    ours = remesh.remesh(mesh, 500, density=weights).mesh
    assert (theirs.points[:, 0] > 0).sum() > 300
    assert (ours.points[:, 0] > 0).sum() > 300
    labels = remesh.voronoi(mesh, sites=remesh.sample_sites(mesh, n=100)).labels
    assert len(labels) == len(clus.clusters)


def test_lines_of_gpytoolbox(torus):
    gpytoolbox = pytest.importorskip("gpytoolbox")
    V, F = torus
    u, g = gpytoolbox.remesh_botsch(V, F.astype(np.int32), 20, 0.1, True)
    result = remesh.remesh(V, F, edge_length=0.1)
    assert is_close(len(u), len(result.V), 0.3) and is_close(len(g), len(result.F), 0.3)

    fixed = np.array([0, 40, 900])
    u, g = gpytoolbox.remesh_botsch(V, F.astype(np.int32), 20, 0.1, True, feature=fixed)
    result = remesh.remesh(V, F, edge_length=0.1, lock=fixed)
    for points in (u, result.V):
        assert all((points == V[i]).all(axis=1).any() for i in fixed)

    u, g, i, j = gpytoolbox.decimate(V, F, face_ratio=0.1)
    result = remesh.remesh(V, F, "10%", adaptive=True)
    assert is_close(len(g), len(result.F), 0.02)
    assert result.source_face.shape == (len(result.V),)
