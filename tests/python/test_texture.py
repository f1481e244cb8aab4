"""Texture coordinates."""

import numpy as np
import pytest

import remesh


def tube():
    """An open cylinder and its texture coordinates, whose u jumps from 1 to 0."""
    n, m = 48, 12
    i, j = np.meshgrid(np.arange(n), np.arange(m + 1), indexing="ij")
    angle = 2 * np.pi * i / n
    V = np.stack([np.cos(angle), np.sin(angle), j / 6], axis=2).reshape(-1, 3)
    F, uv = [], []
    for a in range(n):
        for b in range(m):
            for corners in (((a, b), (a + 1, b), (a + 1, b + 1)), ((a, b), (a + 1, b + 1), (a, b + 1))):
                F.append([(p % n) * (m + 1) + q for p, q in corners])
                uv.append([(p / n, q / m) for p, q in corners])
    return V, np.array(F), np.array(uv)


def test_no_face_spans_the_jump():
    V, F, uv = tube()
    result = remesh.remesh(V, F, 500, uv=uv)
    assert result.uv.shape == (len(result.F), 3, 2)
    assert np.ptp(result.uv, axis=1).max() < 0.2
    centre = result.V[result.F].mean(axis=1)
    turn = np.arctan2(result.V[result.F][..., 1], result.V[result.F][..., 0]) / (2 * np.pi)
    off = result.uv[..., 0] - turn
    assert abs(off - np.round(off)).max() < 5e-3
    assert abs(result.uv[..., 1] - result.V[result.F][..., 2] / 2).max() < 5e-3
    side = centre[:, 1] > 0
    near = abs(centre[:, 1]) < 0.2
    right = centre[:, 0] > 0
    assert (result.uv[side & near & right][..., 0] < 0.1).all()
    assert (result.uv[~side & near & right][..., 0] > 0.9).all()
    assert result.report["features"]["texture_seam_length_mesh_units"] == pytest.approx(2)


def test_values_of_vertices_have_no_seam():
    V, F, _ = tube()
    result = remesh.remesh(V, F, 300, uv=V[:, :2])
    plain = remesh.remesh(V, F, 300)
    assert np.array_equal(result.V, plain.V) and plain.uv is None
    at_corners = result.V[result.F][..., :2]
    assert abs(result.uv - at_corners).max() < 0.01


def test_faces_that_stay_keep_their_bits():
    V, F, uv = tube()
    region = V[F].mean(axis=1)[:, 2] > 1
    result = remesh.remesh(V, F, 400, uv=uv, region=region)
    kept = len(result.kept_faces)
    assert kept > 0 and np.array_equal(result.uv[:kept], uv[~region])
    assert np.ptp(result.uv, axis=1).max() < 0.2


@pytest.mark.parametrize("uv, text", [
    (np.zeros((3, 2)), r"uv has the shape \(3, 2\); give a pair for each corner"),
    ([["a"]], "uv holds <U1; give numbers"),
])
def test_wrong_ones_are_named(uv, text):
    V, F, _ = tube()
    with pytest.raises(remesh.InvalidInput, match=text):
        remesh.remesh(V, F, 300, uv=uv)
