"""What stays as it is: regions and locked vertices; and results that must show all."""

import conftest
import numpy as np
import pytest
import remesh


@pytest.fixture(scope="module")
def marked(sphere):
    """A sphere and a mark on the faces of its upper half."""
    V, F = sphere
    return V, F, V[F].mean(axis=1)[:, 2] > 0


def test_faces_outside_the_region_stay_as_they_were(marked):
    V, F, region = marked
    result = remesh.remesh(V, F, 400, region=region)
    kept = np.flatnonzero(~region)
    assert np.array_equal(result.kept_faces, kept) and result.kept_faces.dtype == np.int64
    assert np.array_equal(result.kept_vertices, np.unique(F[kept]))
    assert np.array_equal(result.V[:len(result.kept_vertices)], V[result.kept_vertices])
    assert np.array_equal(result.V[result.F[:len(kept)]], V[F[kept]])
    assert len(np.unique(result.F[len(kept):])) == 400
    assert result.report["kept"]["kept_faces"] == len(kept)
    figures = remesh.evaluate(V, F, result.V, result.F, samples=1000)
    assert figures["topology_kept"]


def test_without_a_region_nothing_is_kept(sphere):
    result = remesh.remesh(*sphere, 200)
    assert len(result.kept_faces) == len(result.kept_vertices) == 0
    assert result.report["kept"] is None
    everything = remesh.remesh(*sphere, 200, region=np.ones(len(sphere[1])))
    assert len(everything.kept_faces) == 0 and np.array_equal(everything.V, result.V)


def test_values_of_what_stays_are_its_own(marked):
    V, F, region = marked
    twice = np.flatnonzero(~region)[:1]  # One face is there twice, with different values.
    F, region = np.vstack([F, F[twice]]), np.append(region, False)
    heat = np.where(V[:, 2] < -0.5, np.nan, V[:, 0])
    number = np.arange(len(F)) * 0.1
    result = remesh.remesh(V, F, 400, region=region,
                           transfer={"heat": heat, "number": number, "Normals": V})
    kept = len(result.kept_vertices)
    assert np.array_equal(result.vertex_data["heat"][:kept], heat[result.kept_vertices],
                          equal_nan=True)
    assert np.isfinite(result.vertex_data["heat"][kept:]).all()
    assert np.array_equal(result.face_data["number"][:len(result.kept_faces)],
                          number[result.kept_faces])
    # Normals are computed anew, those at the seam from faces of both sides.
    lengths = np.linalg.norm(result.vertex_data["Normals"], axis=1)
    assert np.allclose(lengths, 1) and not np.array_equal(
        result.vertex_data["Normals"][:kept], V[result.kept_vertices])


def test_a_region_is_a_mask_numbers_or_a_name(marked):
    V, F, region = marked
    result = remesh.remesh(V, F, 300, region=region)
    for same in (region * 3, region * -0.5, region.tolist()):
        assert np.array_equal(remesh.remesh(V, F, 300, region=same).V, result.V)
    mesh = conftest.PolyData(V, np.hstack([np.full((len(F), 1), 3), F]).ravel())
    mesh.cell_data["upper"] = region
    named = remesh.remesh(mesh, 300, region="upper")
    assert np.array_equal(named.V, result.V)
    assert not named.mesh.cell_data["upper"][:len(named.kept_faces)].any()
    assert named.mesh.cell_data["upper"][len(named.kept_faces):].all()


def test_percentages_count_in_the_region(marked):
    V, F, region = marked
    inside = len(np.unique(F[region]))
    assert 2 * inside < 1.2 * len(V)
    result = remesh.remesh(V, F, "50%", region=region)
    assert len(np.unique(result.F[len(result.kept_faces):])) == round(inside / 2)


def test_locked_vertices_stay(sphere):
    V, F = sphere
    locked = np.array([3, 700, 41])
    places = {tuple(p) for p in remesh.remesh(V, F, 300).V}
    assert not all(tuple(V[v]) in places for v in locked)
    for given in (locked, locked.astype(np.int32), locked.tolist()):
        result = remesh.remesh(V, F, 300, lock=given)
        places = {tuple(p) for p in result.V}
        assert all(tuple(V[v]) in places for v in locked) and len(places) == 300
        assert result.report["options"]["locked_vertices"] == 3
    assert np.array_equal(remesh.remesh(V, F, 300, lock=[]).V, remesh.remesh(V, F, 300).V)


@pytest.mark.parametrize("options, text", [
    (dict(region=[True]), r"region has the shape \(1,\) and holds bool, but the mesh has 2048 faces"),
    (dict(region=np.zeros(2048)), "region is 0 for all faces; mark the faces to remesh"),
    (dict(region="top"), "region: the mesh has no values 'top' of faces; it has: none"),
    (dict(region=np.arange(2048) < 500, sites=[0, 1, 2, 3]), "leave out one of them"),
    (dict(region=np.arange(2048) < 500, drop_components=0.1), "leave out one of them"),
    (dict(lock=[1026]), "lock names vertex 1026; give a list of vertices, counted from 0, below 1026"),
    (dict(lock=[-1]), "lock names vertex -1"),
    (dict(lock=[[1, 2]]), r"lock has the shape \(1, 2\)"),
    (dict(lock=5), r"lock has the shape \(\)"),
    (dict(lock=[1, 2], sites=[0, 1, 2, 3]), "use one of them"),
])
def test_what_does_not_fit_is_refused(sphere, options, text):
    with pytest.raises(remesh.InvalidOption, match=text):
        remesh.remesh(*sphere, **options)


def test_the_boundary_may_be_locked(sphere):
    V, F = sphere
    half = F[V[F].mean(axis=1)[:, 2] > 0]
    names = np.unique(half)
    rim = np.flatnonzero(np.isin(names, F[V[F].mean(axis=1)[:, 2] <= 0]))
    kept = {tuple(p) for p in V[names[rim]]}
    for is_locked in (False, True):
        result = remesh.remesh(V, half, 200, lock_boundary=is_locked, topology="add")
        assert (kept <= {tuple(p) for p in result.V}) == is_locked


def test_vertices_may_be_locked_by_a_mask(sphere):
    mask = np.zeros(1026, bool)
    mask[[3, 41, 700]] = True
    assert np.array_equal(remesh.remesh(*sphere, 300, lock=mask).V,
                          remesh.remesh(*sphere, 300, lock=[3, 41, 700]).V)
    with pytest.raises(remesh.InvalidInput, match="lock holds bool; give integers"):
        remesh.remesh(*sphere, 300, lock=mask[1:])


def thin_plate():
    """A box of 1 x 1 x 0.01, each side in 2 (20 x 20) triangles."""
    side = np.linspace(0, 1, 21)
    V, F = [], []
    for axis in range(3):
        for end in (0, 1):
            u, v = np.meshgrid(side, side, indexing="ij")
            points = np.stack([np.full(u.size, end), u.ravel(), v.ravel()], axis=1)
            first = sum(len(p) for p in V)
            V.append(np.roll(points, axis, axis=1))
            a = (np.arange(20)[:, None] * 21 + np.arange(20)).ravel()
            both = np.concatenate([np.stack([a, a + 21, a + 22], 1), np.stack([a, a + 22, a + 1], 1)])
            F.append(first + (both if end else both[:, ::-1]))
    V, number = np.unique(np.vstack(V).round(9), axis=0, return_inverse=True)
    return V * [1, 1, 0.01], number.reshape(-1)[np.vstack(F)]


def test_strict_results_show_all_or_are_none():
    V, F = thin_plate()
    coarse = remesh.remesh(V, F, 40, features="off").report
    assert coarse["verdict"]["thin_walls"] > 0
    with pytest.raises(remesh.ConstraintUnmet, match=r"too coarse for some walls; use a larger n "
                       r"\(about \d+ would do\), or leave out strict"):
        remesh.remesh(V, F, 40, features="off", strict=True)
    fine = remesh.remesh(*remesh.examples.torus(), 600, strict=True)
    assert len(fine.V) == 600
