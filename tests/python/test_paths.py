"""Shortest paths against values that are known."""

import numpy as np
import pytest
import remesh
from test_diagrams import flat_square, square_sites


def lengths_of(lines):
    return [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines]


def test_paths_in_the_plane_are_straight():
    V, F = flat_square(9)
    starts = np.array([[0.21, 0.33, 0], [0.84, 0.7, 0], [0.1, 0.95, 0]])
    sites = np.array([[0.5, 0.51, 0], [0.02, 0.1, 0]])
    straight = np.linalg.norm(starts[:, None] - sites, axis=2)
    found = remesh.paths(V, F, starts, sites)
    assert np.array_equal(found.sites, straight.argmin(axis=1))
    assert np.allclose(found.lengths, straight.min(axis=1), rtol=1e-12)
    assert np.allclose(lengths_of(found.lines), found.lengths, rtol=1e-12)
    for line, start, site in zip(found.lines, starts, sites[found.sites]):
        assert np.allclose(line[0], start) and np.allclose(line[-1], site)
    pairs = remesh.paths(V, F, starts, ends=starts[[1, 2, 0]])
    assert np.allclose(pairs.lengths, np.linalg.norm(starts - starts[[1, 2, 0]], axis=1), rtol=1e-12)
    assert pairs.sites.size == 0


def test_paths_have_the_distances(torus):
    V, F = torus
    starts = np.arange(0, len(V), 37)
    found = remesh.paths(V, F, starts, sites=[3, 200])
    distances = remesh.geodesic_distance(V, F, [3, 200], 0)[starts]
    assert np.allclose(found.lengths, distances, rtol=1e-11)


def test_unreached_starts_have_no_path():
    V, F = flat_square(2)
    two = np.vstack([V, V + [5, 0, 0]]), np.vstack([F, F + len(V)])
    found = remesh.paths(*two, [0, len(V)], sites=[4])
    assert found.sites.tolist() == [0, -1]
    assert np.isinf(found.lengths[1]) and len(found.lines[1]) == 0
    with pytest.raises(remesh.InvalidInput, match="pair 0"):
        remesh.paths(*two, [0], ends=[len(V)])


def test_what_is_wrong_is_said(sphere):
    with pytest.raises(remesh.InvalidSites, match="sites= and"):
        remesh.paths(*sphere, [0])
    with pytest.raises(remesh.InvalidSites, match="1 starts and 2 ends"):
        remesh.paths(*sphere, [0], ends=[1, 2])
    with pytest.raises(remesh.InvalidOption):
        remesh.paths(*sphere, [0], ends=[1], max_error=1)


def test_paths_to_lines_and_regions():
    V, F, sites, distances = square_sites()
    weights = np.array([0.05, 0.03, 0])
    starts = np.random.default_rng(1).random((50, 3)) * [1, 1, 0]
    far = distances(starts) + weights
    found = remesh.paths(V, F, starts, weights=weights, **sites)
    assert np.array_equal(found.sites, far.argmin(axis=1))
    assert np.allclose(found.lengths, far.min(axis=1) - weights[found.sites], atol=1e-12)
    for line, site in zip(found.lines, found.sites):
        assert distances(line[-1:])[0, site] < 1e-12
    with pytest.raises(remesh.InvalidOption, match="of sites"):
        remesh.paths(V, F, [0], ends=[1], weights=[1])
