"""Diagrams and distances against values that are known."""

import numpy as np
import pytest
import remesh


def flat_square(k):
    """The unit square of k x k pairs of triangles."""
    x, y = np.meshgrid(np.linspace(0, 1, k + 1), np.linspace(0, 1, k + 1), indexing="ij")
    V = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    a = (np.arange(k)[:, None] * (k + 1) + np.arange(k)).ravel()
    F = np.vstack([np.stack([a, a + k + 1, a + k + 2], axis=1),
                   np.stack([a, a + k + 2, a + 1], axis=1)])
    return V, F


def test_distances_in_the_plane_are_straight():
    V, F = flat_square(10)
    points = np.array([[0.21, 0.33, 0], [0.84, 0.7, 0], [0.1, 0.95, 0]])
    straight = np.linalg.norm(V[:, None] - points, axis=2)
    assert np.allclose(remesh.geodesic_distance(V, F, points, 0), straight.min(axis=1), atol=1e-12)
    diagram = remesh.voronoi(V, F, points, 0)
    assert np.allclose(diagram.distances, straight.min(axis=1), atol=1e-12)
    assert np.array_equal(diagram.labels, straight.argmin(axis=1))
    assert np.allclose(diagram.site_positions, points)
    assert diagram.cell_area.sum() == pytest.approx(1)
    assert (diagram.cell_euler == 1).all()
    assert len(diagram.bisectors) == len(diagram.bisector_sites) > 0
    for line, (left, right) in zip(diagram.bisectors, diagram.bisector_sites):
        assert np.allclose(np.linalg.norm(line - points[left], axis=1),
                           np.linalg.norm(line - points[right], axis=1), atol=1e-9)
        assert right in diagram.neighbours_of(left) and left in diagram.neighbours_of(right)
    far = np.linalg.norm(diagram.points[:, None] - points, axis=2).min(axis=1)
    assert np.allclose(diagram.point_distances, far, atol=1e-9)
    assert (diagram.line_sites[:, 1] == -1).sum() > 0  # The square's boundary.


def test_sites_may_be_lines_and_regions():
    V, F = flat_square(10)
    side = np.flatnonzero(V[:, 1] == 0)
    side = side[np.argsort(V[side, 0])]
    diagram = remesh.voronoi(V, F, [[0.5, 0.5, 0]], 0, lines=[side])
    expected = np.minimum(V[:, 1], np.linalg.norm(V - [0.5, 0.5, 0], axis=1))
    assert np.allclose(diagram.distances, expected, atol=1e-12)
    assert diagram.cell_area == pytest.approx([2 / 3, 1 / 3], abs=1e-3)  # A parabola lies between.
    corner = np.flatnonzero((V[F][:, :, :2] == 1).all(axis=2).any(axis=1))
    distances = remesh.geodesic_distance(V, F, None, 0, lines=[side], regions=[corner])
    assert (distances[F[corner]] == 0).all() and (distances <= V[:, 1] + 1e-12).all()
    at = remesh.geodesic_distance(V, F, None, 0, lines=[side], targets=[[0.31, 0.77, 0]])
    assert at == pytest.approx([0.77])
    W, G, site, source = remesh.cut_cells(V, F, [[0.5, 0.5, 0]], 0, lines=[side])
    assert set(site) == {0, 1}
    for wrong in ([[0]], [[0, 10**6]], [[0, 60]]):
        with pytest.raises(remesh.Error):
            remesh.voronoi(V, F, [0], lines=wrong)


def test_sites_may_be_vertices_points_or_places(sphere):
    V, F = sphere
    vertices = np.array([3, 77, 500])
    expected = remesh.voronoi(V, F, vertices)
    corner = [int(np.flatnonzero((F == v).any(axis=1))[0]) for v in vertices]
    barycentric = (F[corner] == vertices[:, None]).astype(float)
    for sites in (vertices.tolist(), V[vertices], V[vertices].astype(np.float32),
                  (corner, barycentric), remesh.Sites(np.array(corner), barycentric)):
        found = remesh.voronoi(V, F, sites)
        assert np.allclose(found.distances, expected.distances, atol=1e-6)
        assert (found.labels == expected.labels).mean() > 0.99


def test_the_dual_is_a_closed_surface(sphere):
    V, F = sphere
    diagram = remesh.voronoi(V, F, remesh.sample_sites(V, F, 100))
    edges = np.unique(np.sort(diagram.dual[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1),
                      axis=0)
    assert 100 - len(edges) + len(diagram.dual) == 2
    assert diagram.certified_error <= 1e-4
    assert remesh.voronoi(V, F, [0, 1], 0).certified_error == 0


def test_closed_bisectors_end_where_they_begin(sphere):
    diagram = remesh.voronoi(*sphere, [0, 1], 0)
    (line,) = diagram.bisectors
    assert np.array_equal(line[0], line[-1]) and len(line) > 10
    assert np.shares_memory(line, diagram.points)


def slit_square():
    """A slit from (.25, .5) to (.75, .5); its sides coincide."""
    V, F = flat_square(8)
    F = F.copy()
    is_above = V[F, 1].mean(axis=1) > 0.5
    for below in [i * 9 + 4 for i in (3, 4, 5)]:
        F[is_above[:, None] & (F == below)] = len(V)
        V = np.vstack([V, V[below]])
    return V, F


def test_slits_are_welded_or_left_open():
    V, F = slit_square()
    source, across = 4 * 9 + 2, 4 * 9 + 6
    for call in (remesh.geodesic_distance, lambda *a, **more: remesh.voronoi(*a, **more).distances):
        assert call(V, F, [source], 0)[across] == pytest.approx(0.5)
        assert call(V, F, [source], 0, keep_slits=True)[across] == pytest.approx(0.5**0.5)
    assert remesh.clean(V, F).repairs["welded_vertices"] == 3
    assert remesh.clean(V, F, keep_slits=True).repairs["welded_vertices"] == 0
    assert remesh.remesh(V, F, 60, keep_slits=True).report["output"]["boundary_loops"] == 2
    assert remesh.remesh(V, F, 60).report["welded_slit_length_mesh_units"] == 0.5


def test_one_and_two_sites_do_on_a_torus(torus):
    one = remesh.voronoi(*torus, remesh.sample_sites(*torus, 1), 0)
    assert (one.labels == 0).all() and one.cell_euler[0] == 0 and len(one.bisectors) == 0
    two = remesh.voronoi(*torus, remesh.sample_sites(*torus, 2), 0)
    assert np.array_equal(two.neighbours_of(0), [1])
    assert two.cell_area.sum() == pytest.approx(one.cell_area.sum())


def test_vertices_that_no_site_reaches(sphere):
    V, F = sphere
    both = np.vstack([V, V + 10, [[50, 50, 50]]])
    diagram = remesh.voronoi(both, np.vstack([F, F + len(V)]), [0])
    assert (diagram.labels[:len(V)] == 0).all() and (diagram.labels[len(V):] == -1).all()
    assert np.isinf(diagram.distances[len(V):]).all()


def test_vertices_of_a_soup_have_the_values_of_their_places(sphere):
    V, F = sphere
    soup = V[F].reshape(-1, 3)
    faces = np.arange(len(soup)).reshape(-1, 3)
    expected = remesh.geodesic_distance(V, F, [0], 0)
    at = int(np.flatnonzero(F.ravel() == 0)[0])
    assert np.allclose(remesh.geodesic_distance(soup, faces, [at], 0), expected[F.ravel()])
    diagram = remesh.voronoi(soup, faces, [at], 0)
    assert (diagram.labels == 0).all() and np.allclose(diagram.distances, expected[F.ravel()])


@pytest.mark.parametrize("source", [1, 3])
def test_a_vertex_between_two_fans_has_the_values_of_the_nearer_one(source):
    V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]
    F = [[0, 1, 2], [0, 3, 4]]
    assert remesh.geodesic_distance(V, F, [source], 0)[0] == pytest.approx(1)
    assert remesh.voronoi(V, F, [source], 0).labels[0] == 0


@pytest.mark.parametrize("engine", ["window", "steiner"])
def test_engines_agree(sphere, engine):
    exact = remesh.geodesic_distance(*sphere, [0], 0)
    found = remesh.geodesic_distance(*sphere, [0], engine=engine)
    assert (found >= exact - 1e-12).all() and np.allclose(found, exact, rtol=0.03)


def test_engines_refuse_what_they_cannot_do(sphere):
    for call in (remesh.voronoi, remesh.geodesic_distance):
        with pytest.raises(remesh.InvalidOption, match="the Steiner engine cannot be exact"):
            call(*sphere, [0], 0, engine="steiner")
        with pytest.raises(remesh.InvalidOption, match="the maximal error is 2"):
            call(*sphere, [0], 2)
        with pytest.raises(remesh.InvalidOption, match="threads is -1"):
            call(*sphere, [0], threads=-1)


WRONG_SITES = [
    ([], "there is no site"),
    ([-1], "site 0 names vertex -1, but the mesh has only 1026 vertices, counted from 0"),
    ([0, 1026], "site 1 names vertex 1026"),
    ([[0, 1]], r"sites have the shape \(1, 2\)"),
    ([0.5], r"sites have the shape \(1,\) and hold float64"),
    ([[np.nan, 0, 0]], "site 0 has a coordinate that is not finite"),
    (([2048], [[1, 0, 0]]), "site 0 names face 2048, but the mesh has only 2048 faces"),
    (([0], [[1, 0]]), r"faces have the shape \(1,\) and their coordinates \(1, 2\)"),
    (([0], [[1, 1, 0]]), "site 0"),
    (([0], [[2, -1, 0]]), "site 0"),
    (([], np.zeros((0, 3))), "there is no site"),
    (None, "sites have the shape"),
]


@pytest.mark.parametrize("number", range(len(WRONG_SITES)))
def test_wrong_sites_are_refused_with_a_reason(sphere, number):
    sites, text = WRONG_SITES[number]
    for call in (remesh.voronoi, remesh.geodesic_distance, remesh.relax_sites):
        with pytest.raises(remesh.InvalidSites, match=text) as caught:
            call(*sphere, sites)
        assert isinstance(caught.value, remesh.InvalidInput)


def test_sites_at_vertices_without_a_face_are_refused(sphere):
    V, F = sphere
    with pytest.raises(remesh.InvalidSites, match="vertex 1026 is in no face"):
        remesh.voronoi(np.vstack([V, [[5, 5, 5]]]), F, [1026])


def test_distances_of_targets_and_within_a_radius():
    V, F = flat_square(10)
    sites = np.array([[0.21, 0.33, 0], [0.84, 0.7, 0]])
    targets = np.array([[0.5, 0.4, 0], [0.22, 0.3, 0], [0.9, 0.1, 0]])
    straight = np.linalg.norm(targets[:, None] - sites, axis=2).min(axis=1)
    assert np.allclose(remesh.geodesic_distance(V, F, sites, 0, targets=targets), straight, atol=1e-12)
    near = remesh.geodesic_distance(V, F, sites, 0, targets=targets, radius=0.4)
    assert np.allclose(near, np.where(straight <= 0.4, straight, np.inf), atol=1e-12)
    of_vertices = np.linalg.norm(V[:, None] - sites, axis=2).min(axis=1)
    found = remesh.geodesic_distance(V, F, sites, 0, radius=0.25)
    assert np.allclose(found, np.where(of_vertices <= 0.25, of_vertices, np.inf), atol=1e-12)
    with pytest.raises(remesh.InvalidOption, match="window"):
        remesh.geodesic_distance(V, F, sites, 0.1, radius=1, engine="steiner")
    with pytest.raises(remesh.InvalidOption):
        remesh.geodesic_distance(V, F, sites, radius=-1)


def test_nearest_sites_are_ranked():
    V, F = flat_square(10)
    points = np.array([[0.21, 0.33, 0], [0.84, 0.7, 0], [0.1, 0.95, 0]])
    straight = np.linalg.norm(V[:, None] - points, axis=2)
    sites, distances = remesh.nearest_sites(V, F, points, 4, 0)
    assert np.array_equal(sites[:, :3], straight.argsort(axis=1))
    assert np.allclose(distances[:, :3], np.sort(straight, axis=1), atol=1e-12)
    assert (sites[:, 3] == -1).all() and np.isinf(distances[:, 3]).all()
    with pytest.raises(remesh.InvalidOption):
        remesh.nearest_sites(V, F, points, 0)
    # Groups, starts and a line along y = 0.
    line = [v for v in range(len(V)) if V[v, 1] == 0]
    of_sites = np.column_stack([np.minimum(straight[:, 0], straight[:, 2] + 0.1), straight[:, 1],
                                V[:, 1]])
    sites, distances = remesh.nearest_sites(V, F, points, 3, 0, groups=[0, 1, 0],
                                            weights=[0, 0, 0.1, 0], lines=[line])
    assert np.allclose(distances, np.sort(of_sites, axis=1), atol=1e-12)
    assert np.allclose(np.take_along_axis(of_sites, sites, axis=1), distances, atol=1e-12)


def test_points_may_make_groups_and_start_late():
    V, F = flat_square(10)
    points = np.array([[0.2, 0.3, 0], [0.8, 0.7, 0], [0.3, 0.9, 0], [0.82, 0.72, 0]])
    weights = np.array([0, 0.1, 0.3, 0.4])
    groups = [1, 0, 1, 2]
    far = np.linalg.norm(V[:, None] - points, axis=2) + weights
    diagram = remesh.voronoi(V, F, points, 0, groups=groups, weights=weights)
    assert np.allclose(diagram.distances, far.min(axis=1), atol=1e-12)
    assert np.array_equal(diagram.labels, np.array(groups)[far.argmin(axis=1)])
    assert diagram.cell_area.shape == (3,) and diagram.cell_area[2] == 0
    assert diagram.cell_area.sum() == pytest.approx(1)
    assert diagram.site_positions.shape == (4, 3)
    assert np.allclose(remesh.geodesic_distance(V, F, points, 0, weights=weights), far.min(axis=1))
    assert np.allclose(remesh.geodesic_distance(V, F, points, 0, weights=weights, targets=points),
                       (np.linalg.norm(points[:, None] - points, axis=2) + weights).min(axis=1))
    with pytest.raises(remesh.InvalidOption, match="weights"):
        remesh.voronoi(V, F, points, weights=[1, 2])
    with pytest.raises(remesh.InvalidOption, match="groups"):
        remesh.voronoi(V, F, points, groups=[0, 1])
    with pytest.raises(remesh.InvalidSites, match="belongs to site 9"):
        remesh.voronoi(V, F, points, groups=[0, 1, 9, 2])
    with pytest.raises(remesh.InvalidSites, match="site 1 has no point"):
        remesh.voronoi(V, F, points, groups=[0, 2, 2, 0])
    with pytest.raises(remesh.InvalidSites, match="starts at the distance -1"):
        remesh.voronoi(V, F, points, weights=[0, -1, 0, 0])


def test_no_path_crosses_a_barrier():
    V, F = flat_square(40)
    V = 2 * V
    row = 41 * np.arange(4, 37) + 20
    slit = np.stack([row[:-1], row[1:]], axis=1)
    source, target = 41 * 20 + 15, 41 * 20 + 25
    assert np.linalg.norm(V[source] - V[target]) == pytest.approx(0.5)
    around = 2 * np.hypot(0.8, 0.25)
    assert remesh.geodesic_distance(V, F, [source], 0)[target] == pytest.approx(0.5, abs=1e-12)
    far = remesh.geodesic_distance(V, F, [source], 0, barriers=slit)
    assert far[target] == pytest.approx(around, abs=1e-12)
    assert far[row[16]] == pytest.approx(0.25)  # The near side.
    assert remesh.geodesic_distance(V, F, [source], 0, barriers=slit,
                                    targets=[target]) == pytest.approx(around, abs=1e-12)
    on_slit = remesh.geodesic_distance(V, F, [row[16]], 0, barriers=slit)
    assert on_slit[[source, target]] == pytest.approx([0.25, 0.25])  # Both sides.
    diagram = remesh.voronoi(V, F, [source, target], barriers=slit)
    assert diagram.cell_area.sum() == pytest.approx(4)
    with pytest.raises(remesh.InvalidInput, match="barriers"):
        remesh.voronoi(V, F, [0], barriers=[0, 1])
    with pytest.raises(remesh.InvalidInput, match="names vertex 99999"):
        remesh.voronoi(V, F, [0], barriers=[[0, 99999]])
    with pytest.raises(remesh.InvalidInput):
        remesh.voronoi(V, F, [0], barriers=[[0, 1000]])


def test_lengths_may_stand_for_positions():
    V, F = flat_square(12)
    lengths = np.linalg.norm(V[F] - V[np.roll(F, -1, axis=1)], axis=2)
    by_positions = remesh.voronoi(V, F, [5, 77, 130], 0)
    same = remesh.voronoi(V, F, [5, 77, 130], 0, edge_lengths=lengths)
    assert np.array_equal(same.distances, by_positions.distances)
    assert np.array_equal(same.labels, by_positions.labels)
    rolled = np.stack([np.sin(2 * V[:, 0]), 2 * V[:, 1], np.cos(2 * V[:, 0])], axis=1) / 2
    bent = remesh.voronoi(rolled, F, [5, 77, 130], 0, edge_lengths=lengths)
    assert np.allclose(bent.distances, by_positions.distances, atol=1e-12)
    assert bent.cell_area.sum() == pytest.approx(1)
    far = remesh.geodesic_distance(0 * V, F, [5], 0, edge_lengths=2 * lengths)
    assert np.allclose(far, 2 * np.linalg.norm(V - V[5], axis=1), atol=1e-12)
    assert np.allclose(remesh.geodesic_distance(0 * V, F, [5], 0, edge_lengths=lengths,
                                                targets=[130]), np.linalg.norm(V[130] - V[5]))
    with pytest.raises(remesh.InvalidInput, match="edge_lengths has the shape"):
        remesh.voronoi(V, F, [0], edge_lengths=lengths[:3])
    with pytest.raises(remesh.InvalidOption, match="do not go together"):
        remesh.voronoi(V, F, [0], edge_lengths=lengths, barriers=[[0, 1]])
    with pytest.raises(remesh.InvalidInput, match="make no triangle"):
        remesh.voronoi(V[[0, 1, 14]], [[0, 1, 2]], [0], edge_lengths=[[1, 1, 3]])


def test_bisectors_are_made_of_arcs():
    V, F = flat_square(8)
    points = np.array([[0.2, 0.5, 0], [0.8, 0.5, 0]])
    assert remesh.voronoi(V, F, points, 0).arcs is None
    diagram = remesh.voronoi(V, F, points, 0, weights=[0, 0.2], chord=1e-5)
    arcs = diagram.arcs
    assert (arcs.kind == 1).all() and len(arcs.kind) > 4
    assert np.allclose(arcs.focus_left, points[0]) and np.allclose(arcs.focus_right, points[1])
    assert (arcs.weight_left == 0).all() and (arcs.weight_right == 0.2).all()
    assert (diagram.line_sites[arcs.line] == [0, 1]).all()
    spans = [diagram.points[begin:end] for begin, end in arcs.span]
    for before, after in zip(spans, spans[1:]):
        assert np.array_equal(before[-1], after[0])
    # |p - (.2, .5)| = |p - (.8, .5)| + .2
    x, y = np.vstack(spans)[:, :2].T
    assert np.allclose(x, 0.5 + 0.1 * np.sqrt(1 + (y - 0.5) ** 2 / 0.08), atol=1e-14)
    with pytest.raises(remesh.InvalidOption):
        remesh.voronoi(V, F, points, 0, chord=0)


def test_cells_may_be_cut_out():
    V, F = flat_square(8)
    points = np.array([[0.21, 0.33, 0], [0.84, 0.7, 0], [0.1, 0.95, 0]])
    W, G, site, source = remesh.cut_cells(V, F, points, 0)
    corners = W[G]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert (areas > 0).all()
    diagram = remesh.voronoi(V, F, points, 0)
    for s in range(3):
        assert areas[site == s].sum() == pytest.approx(diagram.cell_area[s], abs=1e-12)
    nearest = np.linalg.norm(corners.mean(axis=1)[:, None] - points, axis=2).argmin(axis=1)
    assert np.array_equal(site, nearest)
    whole = np.bincount(source, areas, len(F))
    assert np.allclose(whole, 1 / 128)


def square_sites():
    """A square, a point, a line and a region on it, and the distances of points from each."""
    V, F = flat_square(10)
    at = lambda x, y: int(np.linalg.norm(V[:, :2] - [x, y], axis=1).argmin())
    point = np.array([[0.25, 0.75, 0]])
    line = [at(0.1 * i, 0.2) for i in range(2, 8)]
    centres = V[F].mean(axis=1)
    region = np.flatnonzero((centres[:, 0] > 0.7) & (centres[:, 1] > 0.6))

    def distances(P):
        beside = np.maximum(np.abs(P[:, 0] - 0.45) - 0.25, 0)
        in_corner = np.maximum([0.7, 0.6] - P[:, :2], 0)
        return np.stack([np.linalg.norm(P - point, axis=1),
                         np.hypot(beside, P[:, 1] - 0.2),
                         np.linalg.norm(in_corner, axis=1)], axis=1)

    return V, F, {"sites": point, "lines": [line], "regions": [region]}, distances


def test_lines_and_regions_may_start_late():
    V, F, sites, distances = square_sites()
    weights = np.array([0.05, 0.1, 0.02])
    far = distances(V) + weights
    diagram = remesh.voronoi(V, F, max_error=0, weights=weights, **sites)
    assert np.allclose(diagram.distances, far.min(axis=1), atol=1e-12)
    assert np.array_equal(diagram.labels, far.argmin(axis=1))
    only_points = remesh.voronoi(V, F, max_error=0, weights=weights[:1], **sites)
    assert np.allclose(only_points.distances, (distances(V) + [0.05, 0, 0]).min(axis=1))
    grouped = remesh.voronoi(V, F, max_error=0, groups=[1, 0, 1], **sites)
    assert grouped.cell_area.shape == (2,)
    point, line, region = distances(V).T
    ahead = np.minimum(point, region) - line
    is_clear = np.abs(ahead) > 1e-9
    assert np.array_equal((grouped.labels == 0)[is_clear], (ahead > 0)[is_clear])


def test_diagrams_of_all_kinds_of_sites_are_compared(tmp_path):
    V, F, sites, _ = square_sites()
    for engine in ("window", "steiner"):
        file = tmp_path / f"{engine}.agvd"
        remesh.voronoi(V, F, engine=engine, weights=[0.05, 0.1, 0.02], file=file, **sites)
        figures = remesh.compare(file)
        assert figures["sites"] == 3 and figures["frechet"]["unmatched_loops"] == 0
        assert figures["bisector_error_a"]["max"] < 0.05
    figures = remesh.compare(tmp_path / "steiner.agvd", tmp_path / "window.agvd", points=0)
    assert figures["wrong_label_percent"] < 1 and figures["bisector_error_a"] is None
    remesh.voronoi(V, F, [3], file=tmp_path / "other.agvd")
    with pytest.raises(remesh.InvalidInput, match="different sites"):
        remesh.compare(tmp_path / "other.agvd", tmp_path / "window.agvd")
    with pytest.raises(remesh.FileError):
        remesh.voronoi(V, F, [3], file=tmp_path / "other.stl")
