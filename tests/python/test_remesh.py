"""Options, results and errors of remesh.remesh()."""

import numpy as np
import pytest
import remesh
from remesh import _remesh


def mean_edge(V, F):
    edges = np.unique(np.sort(F[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)
    return np.linalg.norm(V[edges[:, 0]] - V[edges[:, 1]], axis=1).mean()


def places(V, F, result):
    return np.einsum("ij,ijk->ik", result.barycentric, V[F[result.source_face]])


def test_there_are_as_many_vertices_as_asked_for(sphere):
    V, F = sphere
    assert len(remesh.remesh(V, F, 500).V) == 500
    assert len(remesh.remesh(V, F, n=500.0).V) == 500
    assert len(remesh.remesh(V, F, n="10%").V) == round(len(V) / 10)
    assert len(remesh.remesh(V, F, n_clusters=500).V) == 500
    assert len(remesh.remesh(V, F).V) == 2000
    assert len(remesh.remesh(V, F, faces=500).F) == 500
    assert len(remesh.remesh(V, F, sites=np.arange(0, len(V), 4)).V) == (len(V) + 3) // 4


def test_edges_are_as_long_as_asked_for(sphere):
    V, F = sphere
    result = remesh.remesh(V, F, edge_length=0.15)
    assert abs(mean_edge(result.V, result.F) / 0.15 - 1) < 0.03
    diagonal = np.linalg.norm(V.max(axis=0) - V.min(axis=0))
    percent = remesh.remesh(V, F, edge_length="5%")
    assert np.array_equal(percent.V, remesh.remesh(V, F, edge_length=0.05 * diagonal).V)


def test_the_distance_is_kept(torus):
    V, F = torus
    result = remesh.remesh(V, F, max_distance=0.01)
    figures = remesh.evaluate(V, F, result.V, result.F, samples=20_000)
    assert result.report["options"]["sizing"]["max_distance_mesh_units"] == 0.01
    if figures["distance"] is not None:
        percent = figures["distance"]["original_diagonal_mesh_units"] / 100
        assert figures["distance"]["two_sided"]["max_percent_of_diagonal"] * percent <= 0.01
    with pytest.raises(remesh.InvalidOption, match="use longer ones, or a larger distance"):
        remesh.remesh(V, F, max_distance=1e-12)


def test_sizing_gives_lengths_and_number(sphere):
    V, F = sphere
    wanted = np.where(V[:, 0] > 0, 0.1, 0.3)
    result = remesh.remesh(V, F, sizing=wanted)
    assert len(result.V) == len(remesh.remesh(V, F, sizing=lambda p: np.where(p[:, 0] > 0, 0.1,
                                                                               0.3)).V)
    front = result.F[(result.V[result.F, 0] > 0.5).all(axis=1)]
    back = result.F[(result.V[result.F, 0] < -0.5).all(axis=1)]
    assert mean_edge(result.V, front) == pytest.approx(0.1, rel=0.1)
    assert mean_edge(result.V, back) > 1.8 * mean_edge(result.V, front)
    scaled = remesh.remesh(V, F, 400, sizing=wanted)
    assert len(scaled.V) == 400
    by_density = remesh.remesh(V, F, 400, density=wanted ** -2)
    back, front = (by_density.F[(sign * by_density.V[by_density.F, 0] > 0.5).all(axis=1)]
                   for sign in (-1, 1))
    assert mean_edge(by_density.V, back) > 1.8 * mean_edge(by_density.V, front)
    bounded = remesh.remesh(V, F, 400, adaptive=True, min_edge=0.05, max_edge="50%", gradation=1.2)
    assert len(bounded.V) == 400


def test_edges_are_short_at_places(sphere):
    V, F = sphere
    pole = int(V[:, 2].argmax())
    regions = [np.flatnonzero((F == pole).any(axis=1))]
    for where in (dict(sites=[pole]), dict(regions=regions), dict(lines=[[pole, F[regions[0][0]]
                                                                        [F[regions[0][0]] != pole][0]]])):
        result = remesh.remesh(V, F, 400, size_at=[dict(where, length=0.05, radius=0.2)])
        assert len(result.V) == 400
        near = result.F[(result.V[result.F, 2] > 0.98).all(axis=1)]
        assert 0.03 < mean_edge(result.V, near) < 0.055


def test_bounds_of_all_triangles(organic):
    V, F = organic
    result = remesh.remesh(V, F, 1000, min_angle=25, max_angle=100, longest_edge="3%")
    assert len(result.V) > 1000 and result.report["forced_faces"] == []
    edges = result.V[result.F] - result.V[np.roll(result.F, -1, axis=1)]
    longest = result.report["options"]["bounds"]["longest_edge_mesh_units"]
    assert 0.9 * longest < np.linalg.norm(edges, axis=2).max() <= longest
    assert result.report["verdict"]["min_angle_deg"] >= 25
    with pytest.raises(remesh.ConstraintUnmet, match="the largest angle asked for is 90, and "):
        remesh.remesh(V, F, 1000, relax=0, max_angle=90)


def test_places_are_the_nearest_points(organic):
    V, F = organic
    result = remesh.remesh(V, F, 1000)
    assert result.source_face.dtype == np.int64 and result.barycentric.shape == (1000, 3)
    assert (result.barycentric >= 0).all()
    assert np.allclose(result.barycentric.sum(axis=1), 1)
    gap = np.linalg.norm(places(V, F, result) - result.V, axis=1)
    nearest = remesh.Sites(*_remesh.nearest_points(V, F.astype(np.uint32), result.V, None))
    least = np.linalg.norm(nearest.positions(V, F) - result.V, axis=1)
    # Some vertices are nearer to a sheet to which they do not belong.
    assert (gap >= least - 1e-12).all() and (gap <= least + 1e-12).mean() > 0.95
    without = remesh.remesh(V, F, 1000, fit=False)
    assert np.abs(places(V, F, without) - without.V).max() < 1e-12


def test_the_report_is_that_of_the_program(torus):
    report = remesh.remesh(*torus, 600, seed=7).report
    assert report["output_vertices"] == 600
    assert report["options"]["seed"] == 7
    assert report["input_topology"]["genus"] == 1
    assert report["version"] == remesh.__version__


def test_features_are_kept_as_asked_for():
    V = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(float)
    F = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4],
                  [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]])
    kept = remesh.remesh(V, F, 300)
    assert kept.report["features"]["crease_length_mesh_units"] == pytest.approx(12)
    assert remesh.remesh(V, F, 300, features=30).report["features"][
        "crease_length_mesh_units"] == pytest.approx(12)
    assert remesh.remesh(V, F, 300, features="off").report["features"]["crease_length_mesh_units"] == 0
    one = remesh.remesh(V, F, 300, features="off", feature_edges=[[0, 1]])
    assert one.report["features"]["crease_length_mesh_units"] == pytest.approx(1)
    labels = np.where(np.arange(12) < 2, "floor", "rest")
    rim = remesh.remesh(V, F, 300, features="off", face_labels=labels)
    assert rim.report["features"]["crease_length_mesh_units"] == pytest.approx(4)


def test_the_same_bytes_for_any_number_of_threads(organic):
    results = [remesh.remesh(*organic, 800, threads=t) for t in (1, 2, 8)]
    assert [result.report["options"]["threads"] for result in results] == [1, 2, 8]
    for other in results[1:]:
        assert other.V.tobytes() == results[0].V.tobytes()
        assert other.F.tobytes() == results[0].F.tobytes()
        assert other.barycentric.tobytes() == results[0].barycentric.tobytes()
    assert remesh.remesh(*organic, 800, seed=2).V.tobytes() != results[0].V.tobytes()


WRONG_OPTIONS = [
    (dict(n=0), "n is 0; use a whole number from 1"),
    (dict(n=-5), "n is -5"),
    (dict(n=2.5), "n is 2.5"),
    (dict(n=True), "n is True"),
    (dict(n="many"), "n is 'many'; use a whole number of 1 or more, or a percentage"),
    (dict(n=10**12), "n is 1000000000000"),
    (dict(n=100, n_clusters=100), "n and n_clusters each give the number of vertices; use one"),
    (dict(n=100, edge_length=1), "n and edge_length each give"),
    (dict(faces=100, max_distance=1), "faces and max_distance each give|max_distance and faces"),
    (dict(n=100, sites=[0, 1]), "n and sites each give"),
    (dict(edge_length=0), "edge_length is 0; use a number above 0, or a percentage of the diagonal"),
    (dict(edge_length="wide"), "edge_length is 'wide'"),
    (dict(edge_length=float("nan")), "edge_length is nan"),
    (dict(max_distance=-1), "max_distance is -1"),
    (dict(min_angle=40), "min_angle is 40"),
    (dict(longest_edge=0), "longest_edge is 0"),
    (dict(min_edge=1), "min_edge, max_edge and gradation bound edges that differ"),
    (dict(adaptive=True, gradation=0.5), "gradation is 0.5"),
    (dict(adaptive=True, sizing=np.ones(1026)), "several of adaptive, sizing, face_sizing and density"),
    (dict(size_at=[dict(sites=[0])]), "size_at holds .*; give dictionaries with a length"),
    (dict(size_at=[dict(length=0, sites=[0])]), "length of size_at is 0"),
    (dict(sizing=np.ones(5)), r"sizing has the shape \(5,\) and holds float64, but the mesh has 1026"),
    (dict(sizing="name"), "sizing: the mesh has no values 'name' of vertices; it has: none"),
    (dict(features="sharp"), "features is 'sharp'; use 'auto', 'off' or an angle in degrees"),
    (dict(features=200), "features is 200"),
    (dict(features=True), "features is True; use 'auto', 'off' or an angle in degrees"),
    (dict(feature_edges=[[0, 9999]]), "feature edge 0 names vertex 9999, but the mesh has only 1026"),
    (dict(feature_edges=[0, 1, 2]), r"feature_edges has the shape \(3,\)"),
    (dict(face_labels=[1, 2]), r"face_labels has the shape \(2,\), but the mesh has 2048 faces"),
    (dict(junctions="weld"), "junctions is 'weld'; use apart or keep"),
    (dict(boundary="fixed"), "boundary is 'fixed'; use keep or free"),
    (dict(topology="any"), "topology is 'any'; use exact or add"),
    (dict(init="poisson"), "init is 'poisson'; use blue-noise, farthest or random"),
    (dict(engine="heat"), "engine is 'heat'; use window or steiner"),
    (dict(delaunay="yes"), "delaunay is 'yes'; use intrinsic, extrinsic or off"),
    (dict(drop_components=2), "drop_components is 2"),
    (dict(relax=-1), "relax is -1"),
    (dict(seed=-1), "seed is -1"),
    (dict(threads=-2), "threads is -2"),
    (dict(max_error=1.5), "the maximal error is 1.5"),
    (dict(max_error="none"), "max_error is 'none'; use a number"),
    (dict(engine="steiner", max_error=0), "the Steiner engine cannot be exact"),
    (dict(keep_sites=True), "keep_sites needs sites"),
    (dict(transfer={"x": [1, 2]}), r"transfer: 'x' has the shape \(2,\)"),
    (dict(transfer=["height"]), "transfer: the mesh has no values 'height'; it has: none"),
    (dict(transfer=5), "transfer is 5"),
    (dict(progress=5), "progress is 5"),
]


@pytest.mark.parametrize("number", range(len(WRONG_OPTIONS)))
def test_wrong_options_are_refused_with_a_reason(sphere, number):
    options, text = WRONG_OPTIONS[number]
    with pytest.raises(remesh.InvalidOption, match=text) as caught:
        remesh.remesh(*sphere, **options)
    assert isinstance(caught.value, ValueError)


def test_unknown_options_and_missing_faces_are_type_errors(sphere):
    V, F = sphere
    with pytest.raises(TypeError, match="nsamples"):
        remesh.remesh(V, F, nsamples=5)
    with pytest.raises(TypeError, match="ndarray has no faces; give V and F, a remesh.Mesh, or an object of"):
        remesh.remesh(V)


def test_too_few_vertices_for_the_topology_are_refused(torus):
    with pytest.raises(remesh.ConstraintUnmet, match="samples") as caught:
        remesh.remesh(*torus, 3)
    assert isinstance(caught.value, RuntimeError) and isinstance(caught.value, remesh.Error)


def test_bunny(bunny):
    V, F = bunny
    result = remesh.remesh(V, F, 1000)
    assert len(result.V) == 1000
    assert remesh.evaluate(V, F, result.V, result.F, samples=1000)["topology_kept"]
