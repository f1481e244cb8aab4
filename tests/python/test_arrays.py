"""Types and orders of arrays, copies, and what is refused."""

import numpy as np
import pytest
import remesh
from remesh import _arrays, _kinds

FLOATS = [np.float32, np.float64, np.float16, ">f8", np.longdouble]
INTEGERS = [np.int32, np.uint32, np.int64, np.uint64, np.int16, np.uint16, ">i4"]


def orders(array):
    """The same values in C order, in Fortran order, as every other row, and unaligned."""
    apart = np.zeros((2 * len(array), 3), array.dtype)
    apart[::2] = array
    buffer = np.zeros(array.nbytes + 1, np.uint8)
    unaligned = np.ndarray(array.shape, array.dtype, buffer.data, offset=1)
    unaligned[:] = array
    return [np.ascontiguousarray(array), np.asfortranarray(array), apart[::2], unaligned]


def test_any_type_and_order_gives_the_same_result():
    V, F = remesh.examples.sphere(2)
    V = np.rint(V * 64)  # Exact in all types.
    expected = remesh.remesh(V, F, 60)
    tried = 0
    for float_type in FLOATS:
        for int_type in INTEGERS:
            for i in range(4):
                result = remesh.remesh(orders(V.astype(float_type))[i],
                                       orders(F.astype(int_type))[i], 60)
                is_narrow = np.dtype(float_type) == np.float32
                assert result.V.dtype == (np.float32 if is_narrow else np.float64)
                assert np.array_equal(result.V, expected.V.astype(result.V.dtype))
                is_wide = np.dtype(int_type).itemsize >= 4
                assert result.F.dtype == (np.dtype(int_type) if is_wide else np.int64)
                assert np.array_equal(result.F, expected.F)
                tried += 1
    assert tried == 140


def test_integers_are_positions_and_lists_are_arrays():
    V = [[0, 0, 0], [9, 0, 0], [0, 9, 0], [0, 0, 9]]
    F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    assert remesh.remesh(V, F, 40).V.shape == (40, 3)


@pytest.mark.parametrize("int_type", [np.int32, np.uint32])
def test_arrays_of_the_right_type_are_not_copied(sphere, int_type):
    V, F = sphere
    F = F.astype(int_type)
    mesh = _kinds.take(V, F)
    assert np.shares_memory(mesh.V, V)
    assert np.shares_memory(mesh.F, F)
    result = remesh.remesh(V, F, 100)
    assert not result.V.flags.owndata and result.V.flags.writeable  # The memory of the vector.
    assert not result.F.flags.owndata and result.F.flags.writeable


def test_all_else_is_converted_to_aligned_arrays_in_c_order():
    V, F = remesh.examples.sphere(1)
    for positions in orders(V):
        for faces in orders(F.astype(np.uint32)):
            mesh = _kinds.take(positions, faces)
            for array in (mesh.V, mesh.F):
                assert array.flags.aligned and array.flags.c_contiguous


def test_results_outlive_all_else(sphere):
    V = remesh.remesh(*sphere, 100).V
    V[0] = 7
    assert (V[0] == 7).all() and np.isfinite(V).all()


def test_inputs_are_not_changed(torus):
    V, F = (array.copy() for array in torus)
    values = V[:, 2].copy()
    F[5] = F[5, ::-1]  # To be repaired.
    before = V.tobytes(), F.tobytes(), values.tobytes()
    remesh.remesh(V, F, 300, sizing=0.2 + values ** 2, transfer={"z": values})
    remesh.voronoi(V, F, [1, 2])
    remesh.geodesic_distance(V, F, [1, 2])
    remesh.evaluate(V, F, V, F, samples=100)
    remesh.clean(V, F)
    remesh.relax_sites(V, F, remesh.sample_sites(V, F, 100))
    assert before == (V.tobytes(), F.tobytes(), values.tobytes())


def wrong_meshes():
    V, F = remesh.examples.sphere(1)
    nan, negative, large = V.copy(), F.copy(), F.copy()
    nan[3, 1] = np.nan
    negative[4, 2] = -1
    large[4, 2] = 18
    return [
        (V.T, F, r"V has the shape \(3, 18\); give a row of three coordinates for each vertex"),
        (V[:, 0], F, r"V has the shape \(18,\)"),
        (V, F.T, r"F has the shape \(3, 32\); give a row of three vertices for each face"),
        (V, F.ravel(), r"F has the shape \(96,\)"),
        (V, F.astype(float), "F holds float64; give integers"),
        (V.astype(complex), F, "V holds complex128; give numbers"),
        (V.astype(str), F, "V holds <U32; give numbers"),
        (nan, F, "vertex 3 has a coordinate that is not finite; correct or delete the vertex"),
        (V, negative, "face 4 names vertex -1, but the mesh has only 18 vertices, counted from 0"),
        (V, negative.astype(np.int32), "face 4 names vertex -1, but"),
        (V, large, "face 4 names vertex 18, but the mesh has only 18 vertices, counted from 0; "
                   "correct or delete the face"),
        (V, large.astype(np.uint8), "face 4 names vertex 18, but"),
        (V, F[:0], "the mesh has no face with an area"),
        (V, [], "the mesh has no face with an area"),
    ]


@pytest.mark.parametrize("number", range(14))
def test_wrong_meshes_are_refused_with_a_reason(number):
    V, F, text = wrong_meshes()[number]
    with pytest.raises(remesh.InvalidInput, match=text) as caught:
        remesh.remesh(V, F, 50)
    assert isinstance(caught.value, ValueError) and isinstance(caught.value, remesh.Error)


def test_the_largest_indices_are_no_vertices():
    V, F = remesh.examples.sphere(1)
    for value in (2**32 - 1, 2**32, 2**63, 2**64 - 1):
        wrong = F.astype(np.uint64)
        wrong[0, 0] = value
        with pytest.raises(remesh.InvalidInput, match=f"face 0 names vertex {value}, but"):
            remesh.remesh(V, wrong, 50)


def test_int32_is_seen_as_uint32():
    values = np.array([[0, 1, 2]], np.int32)
    assert np.shares_memory(_arrays.to_indices(values), values)
