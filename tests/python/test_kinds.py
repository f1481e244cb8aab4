"""Objects laid out like those of PyVista and trimesh, and values that are carried over."""

import conftest
import numpy as np
import pytest
import remesh


def poly_data(V, F):
    return conftest.PolyData(V, np.hstack([np.full((len(F), 1), 3), F]).ravel())


def corners_of(poly):
    return poly.faces.reshape(-1, 4)[:, 1:]


def test_poly_data_comes_back_as_poly_data(sphere):
    V, F = sphere
    expected = remesh.remesh(V, F, 300)
    for result in (remesh.remesh(poly_data(V, F), n=300), remesh.remesh(poly_data(V, F), 300),
                   remesh.remesh(poly_data(V, F), n_clusters=300)):
        assert type(result.mesh) is conftest.PolyData
        assert np.array_equal(result.mesh.points, expected.V)
        assert (result.mesh.faces.reshape(-1, 4)[:, 0] == 3).all()
        assert np.array_equal(corners_of(result.mesh), expected.F)


def test_trimesh_comes_back_as_trimesh(sphere):
    V, F = sphere
    result = remesh.remesh(conftest.Trimesh(V, F, process=False), 300)
    assert type(result.mesh) is conftest.Trimesh
    expected = remesh.remesh(V, F, 300)
    assert np.array_equal(result.mesh.vertices, expected.V)
    assert np.array_equal(result.mesh.faces, expected.F)
    assert isinstance(expected.mesh, tuple) and expected.mesh[0] is expected.V


def test_polygons_are_triangulated(sphere):
    V = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(np.float32)
    quads = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                      [1, 3, 7, 5]])
    box = conftest.PolyData(V, np.hstack([np.full((6, 1), 4), quads]).ravel())
    result = remesh.remesh(box, n=100)
    assert result.mesh.points.shape == (100, 3) and result.mesh.points.dtype == np.float32

    class Bare:
        points, faces = V, box.faces

    with pytest.raises(remesh.InvalidInput, match="faces that are no triangles; triangulate it"):
        remesh.remesh(Bare(), n=100)


def test_all_functions_take_objects(sphere):
    V, F = sphere
    poly = poly_data(V, F)
    assert np.array_equal(remesh.voronoi(poly, sites=[0, 9]).labels,
                          remesh.voronoi(V, F, [0, 9]).labels)
    assert np.array_equal(remesh.geodesic_distance(poly, sources=[0]),
                          remesh.geodesic_distance(V, F, [0]))
    result = remesh.remesh(poly, 200)
    for given in ((poly, result.mesh), (V, F, result.mesh), (poly, result.V, result.F),
                  (V, F, result.V, result.F)):
        assert remesh.evaluate(*given, samples=100)["result"]["vertices"] == 200
    sites = remesh.sample_sites(poly, n=50)
    assert len(remesh.relax_sites(poly, sites=sites).sites.face) == 50
    assert remesh.clean(poly).repairs["duplicate_faces"] == 0
    with pytest.raises(TypeError, match="give no faces besides"):
        remesh.remesh(poly, F, 200)
    with pytest.raises(TypeError, match="two meshes"):
        remesh.evaluate(V, F)
    with pytest.raises(TypeError, match="an argument besides"):
        remesh.evaluate(poly, poly, poly)


def test_values_of_objects_are_carried_over(torus):
    V, F = torus
    poly = poly_data(V, F)
    poly.point_data = {"z": V[:, 2], "name": np.where(V[:, 2] > 0, "up", "down"),
                       "Normals": V.astype(np.float32)}
    poly.cell_data = {"Normals": np.zeros((len(F), 3)), "side": (V[F, 0].mean(axis=1) > 0).astype(np.int16)}
    result = remesh.remesh(poly, 800)
    carried = result.mesh
    assert set(carried.point_data) == {"z", "name", "Normals"} and set(carried.cell_data) == {"side"}
    assert np.abs(carried.point_data["z"] - result.V[:, 2]).max() < 0.01
    is_clear = np.abs(result.V[:, 2]) > 0.1
    assert (carried.point_data["name"] == np.where(result.V[:, 2] > 0, "up", "down"))[is_clear].all()
    normals = carried.point_data["Normals"]
    assert normals.dtype == np.float32
    assert np.allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-5)
    middle = result.V[corners_of(carried), 0].mean(axis=1)
    assert carried.cell_data["side"].dtype == np.int16
    assert (carried.cell_data["side"] == (middle > 0))[np.abs(middle) > 0.1].all()
    only = remesh.remesh(poly, 800, transfer=["z"]).mesh
    assert set(only.point_data) == {"z"} and not only.cell_data
    assert set(remesh.remesh(poly, 800, transfer="z").mesh.point_data) == {"z"}
    assert not remesh.remesh(poly, 800, transfer="none").mesh.point_data


def test_sizing_may_be_named(torus):
    V, F = torus
    poly = poly_data(V, F)
    poly.point_data = {"size": np.where(V[:, 0] > 0, 0.1, 0.2)}
    assert len(remesh.remesh(poly, sizing="size").V) == len(
        remesh.remesh(V, F, sizing=poly.point_data["size"]).V)


def test_arrays_are_carried_over_by_kind(torus):
    V, F = torus
    colours = np.rint(255 * (V - V.min(axis=0)) / np.ptp(V, axis=0)).astype(np.uint8)
    big = np.int64(2**60) + np.arange(len(F)) // (len(F) // 2)
    values = {"float": colours.astype(float), "xyz": V.astype(np.float32), "rgb": colours, "pairs": np.rint(4 * V).astype(int),
              "flag": V[:, 2] > 0, "big": big}
    result = remesh.remesh(V, F, 500, transfer=values)
    assert result.vertex_data["xyz"].dtype == np.float32
    assert np.abs(result.vertex_data["xyz"] - result.V).max() < 0.01
    expected = 255 * (result.V - V.min(axis=0)) / np.ptp(V, axis=0)
    assert result.vertex_data["rgb"].dtype == np.uint8
    assert np.abs(result.vertex_data["rgb"] - expected).max() < 4
    assert np.array_equal(result.vertex_data["rgb"], np.rint(result.vertex_data["float"]))
    rows = {tuple(row) for row in values["pairs"]}
    assert all(tuple(row) in rows for row in result.vertex_data["pairs"])
    assert result.vertex_data["flag"].dtype == bool
    assert set(result.face_data) == {"big"} and set(result.face_data["big"]) == set(big)
    assert len(result.face_data["big"]) == len(result.F)


def test_values_that_fit_both_elements_need_a_name_of_one():
    V = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    F = np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    with pytest.raises(remesh.InvalidOption, match="as .'vertex', array. or .'face', array."):
        remesh.remesh(V, F, 50, transfer={"x": V[:, 0]})
    result = remesh.remesh(V, F, 50, features="off",
                           transfer={"x": ("vertex", 1.0 * V[:, 0]), "f": ("face", np.arange(4))})
    assert len(result.vertex_data["x"]) == 50 and len(result.face_data["f"]) == len(result.F)


def test_vtk_poly_data_comes_back_as_such(torus):
    vtk = pytest.importorskip("vtkmodules.vtkCommonDataModel")
    V, F = torus
    mesh = given_vtk(vtk, V, F)
    result = remesh.remesh(mesh, 300)
    expected = remesh.remesh(V, F, 300)
    assert type(result.mesh) is type(mesh) and np.array_equal(result.V, expected.V)
    assert np.array_equal(np.asarray(result.mesh.GetPoints().GetData()), expected.V)
    assert result.mesh.GetNumberOfPolys() == len(expected.F)
    height = np.asarray(result.mesh.GetPointData().GetArray("height"))
    assert np.abs(height - result.V[:, 2]).max() < 0.02
    assert set(np.asarray(result.mesh.GetCellData().GetArray("side"))) == {0, 1}


def given_vtk(vtk, V, F):
    given = remesh._kinds.VtkMesh(vtk.vtkPolyData())
    side = (V[F].mean(axis=1)[:, 0] > 0).astype(np.int32)
    return given.build(V, F, {"height": V[:, 2].copy()}, {"side": side})


def test_meshio_comes_back_as_meshio(torus):
    meshio = pytest.importorskip("meshio")
    V, F = torus
    line = ("line", F[:2, :2])  # Is left out, with its values.
    side = (V[F].mean(axis=1)[:, 0] > 0).astype(np.int32)
    mesh = meshio.Mesh(V, [line, ("triangle", F)], point_data={"height": V[:, 2]},
                       cell_data={"side": [np.array([7, 7]), side]})
    result = remesh.remesh(mesh, 300)
    assert type(result.mesh) is meshio.Mesh
    assert np.array_equal(result.V, remesh.remesh(V, F, 300).V)
    assert np.array_equal(result.mesh.cells_dict["triangle"], result.F)
    assert np.abs(result.mesh.point_data["height"] - result.V[:, 2]).max() < 0.02
    assert set(result.mesh.cell_data["side"][0]) == {0, 1}
    with pytest.raises(remesh.InvalidInput, match="no triangle, quad or polygon, but line"):
        remesh.remesh(meshio.Mesh(V, [line]), 300)


def test_quads_of_meshio_are_cut_into_triangles():
    meshio = pytest.importorskip("meshio")
    V = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(float)
    quads = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                      [1, 3, 7, 5]])
    mesh = meshio.Mesh(V, [("quad", quads)], cell_data={"side": [np.arange(6)]})
    result = remesh.remesh(mesh, 100)
    assert len(result.V) == 100 and set(result.face_data["side"]) == set(range(6))


def test_pyvista():
    pyvista = pytest.importorskip("pyvista")
    mesh = pyvista.Sphere()
    result = remesh.remesh(mesh, 500)
    assert type(result.mesh) is type(mesh) and result.mesh.n_points == 500


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    mesh = trimesh.creation.icosphere()
    result = remesh.remesh(mesh, 500)
    assert type(result.mesh) is type(mesh) and len(result.mesh.vertices) == 500


def test_results_go_back_in(tmp_path):
    V, F = remesh.examples.sphere(3)
    result = remesh.remesh(V, F, 100, transfer={"height": V[:, 2]})
    for again in (result, result.mesh, (result.V, result.F)):
        assert len(remesh.remesh(again, 80).V) == 80
    remesh.write(tmp_path / "a.ply", result)
    back = remesh.read(tmp_path / "a.ply")
    assert np.array_equal(back.vertex_data["height"], result.vertex_data["height"])
    own = remesh.remesh(back, 90)
    remesh.write(tmp_path / "b.ply", own)
    assert remesh.remesh(own, 80).vertex_data["height"].shape == (80,)
    cleaned = remesh.clean(V, F)
    assert len(remesh.remesh(cleaned, 70).V) == 70


def test_a_path_is_no_mesh():
    with pytest.raises(TypeError, match=r"read it first: remesh.read\('gear.stl'\)"):
        remesh.remesh("gear.stl")


def test_unknown_arguments_name_the_one_that_was_meant():
    V, F = remesh.examples.sphere(1)
    with pytest.raises(TypeError, match="no argument 'edge_lenght'; did you mean 'edge_length'"):
        remesh.remesh(V, F, edge_lenght=0.1)
    with pytest.raises(TypeError, match="did you mean 'max_error'"):
        remesh.voronoi(V, F, [0], maxerror=0)


def test_what_the_program_warns_of_are_warnings():
    V, F = remesh.examples.sphere(3)
    plate = V * [1, 1, 0.01]
    with pytest.warns(UserWarning, match="too coarse for some walls; use a larger n") as told:
        result = remesh.remesh(plate, F, 100)
    assert [str(one.message) for one in told] == result.report["warnings"]
    assert told[0].filename == __file__
