"""Lines of equal distance against values that are known."""

import numpy as np
import pytest
import remesh
from test_diagrams import flat_square, square_sites


def test_lines_in_the_plane_are_circles():
    V, F = flat_square(9)
    sites = np.array([[0.3, 0.31, 0], [0.8, 0.7, 0]])
    found = remesh.isolines(V, F, sites, levels=[0.1, 0.25], tolerance=1e-5)
    assert len(found.lines) == 4 and sorted(found.levels.tolist()) == [0.1, 0.1, 0.25, 0.25]
    for line, level, is_closed in zip(found.lines, found.levels, found.is_closed):
        distances = np.linalg.norm(line[:, None] - sites, axis=2).min(axis=1)
        assert np.allclose(distances, level, rtol=1e-9)
        if is_closed:
            assert (line[0] == line[-1]).all()
            length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
            assert length == pytest.approx(2 * np.pi * level, rel=1e-3)
    # The second site is .2 from the boundary.
    assert sorted(zip(found.levels, found.is_closed)) == [
        (0.1, True), (0.1, True), (0.25, False), (0.25, True)]


def test_a_line_at_every_step(torus):
    V, F = torus
    found = remesh.isolines(V, F, [0], every=0.3)
    farthest = remesh.geodesic_distance(V, F, [0], 0).max()
    assert np.allclose(np.unique(found.levels), np.arange(1, farthest / 0.3) * 0.3)
    assert found.is_closed.all()
    fine = remesh.isolines(V, F, [0], every=0.3, tolerance=1e-6)
    assert len(fine.points) > len(found.points)


def test_what_is_wrong_is_said(sphere):
    for wrong in ({}, {"levels": [1], "every": 1}, {"levels": []}, {"levels": [-1]},
                  {"every": 0}, {"levels": [1], "tolerance": 0}):
        with pytest.raises(remesh.InvalidOption):
            remesh.isolines(*sphere, [0], **wrong)


def test_lines_around_lines_and_regions():
    V, F, sites, distances = square_sites()
    weights = np.array([0.05, 0.03, 0])
    found = remesh.isolines(V, F, levels=[0.1, 0.2], weights=weights, **sites)
    assert set(found.levels.tolist()) == {0.1, 0.2}
    for line, level in zip(found.lines, found.levels):
        assert np.allclose((distances(line) + weights).min(axis=1), level, rtol=1e-9)
