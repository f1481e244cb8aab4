"""Lines of docs/switching.md with the other package as well, where it is installed."""

import numpy as np
import pytest
import remesh


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
    assert clus.create_mesh().n_points == 500
    ours = remesh.remesh(mesh, 500, density=weights).mesh
    assert (ours.points[:, 0] > 0).sum() > 300
    labels = remesh.voronoi(mesh, sites=remesh.sample_sites(mesh, n=100)).labels
    assert len(labels) == len(clus.clusters)
