"""Files with all their values, warnings, the limit of memory, and messages in the caller's terms."""

import os

import numpy as np
import pytest
import remesh


@pytest.fixture
def mesh():
    V, F = remesh.examples.torus(24, 12)
    name = np.where(V[F].mean(axis=1)[:, 2] > 0, "up", "down")
    return remesh.Mesh(V, F, {"height": V[:, 2].astype(np.float32), "Normals": V.astype(np.float32),
                              "color": np.arange(3 * len(V), dtype=np.uint8).reshape(-1, 3)},
                       {"material": name, "part": np.arange(len(F))}, V[F][:, :, :2])


def test_a_file_keeps_every_value(mesh, tmp_path):
    remesh.write(tmp_path / "all.ply", mesh)
    back = remesh.read(tmp_path / "all.ply")
    assert np.array_equal(back.V, mesh.V) and np.array_equal(back.F, mesh.F)
    assert np.array_equal(back.uv, mesh.uv) and back.warnings == []
    assert set(back.vertex_data) == {"height", "Normals", "color"}
    for name in ("height", "color"):
        assert back.vertex_data[name].dtype == mesh.vertex_data[name].dtype
        assert np.array_equal(back.vertex_data[name], mesh.vertex_data[name])
    assert np.array_equal(back.face_data["part"], mesh.face_data["part"])


def test_what_was_read_is_remeshed_and_written_with_its_values(mesh, tmp_path):
    remesh.write(tmp_path / "in.obj", mesh.V, mesh.F, uv=mesh.uv,
                 face_data={"material": mesh.face_data["material"]})
    given = remesh.read(tmp_path / "in.obj")
    assert set(given.face_data["material"]) == {"up", "down"}
    result = remesh.remesh(given, 300, face_labels="material")
    assert isinstance(result.mesh, remesh.Mesh) and result.mesh.uv.shape == (len(result.F), 3, 2)
    remesh.write(tmp_path / "out.obj", result.mesh)
    back = remesh.read(tmp_path / "out.obj")
    # In the file faces of one material stand together.
    order = np.argsort([result.face_data["material"].tolist().index(name)
                        for name in result.face_data["material"]], kind="stable")
    assert np.array_equal(back.face_data["material"], result.face_data["material"][order])
    assert np.array_equal(back.V[back.F], result.mesh.V[result.F[order]])


def test_what_a_format_cannot_hold_is_warned_of(mesh, tmp_path):
    with pytest.warns(UserWarning, match="a.stl: .*height.*have no place for it"):
        remesh.write(tmp_path / "a.stl", mesh)


def test_files_that_cannot_be_used_are_errors(mesh, tmp_path):
    with pytest.raises(remesh.FileError, match="none.ply") as error:
        remesh.read(tmp_path / "none.ply")
    assert isinstance(error.value, OSError)
    with pytest.raises(remesh.FileError, match="xyz"):
        remesh.write(tmp_path / "out.xyz", mesh)
    with pytest.raises(remesh.InvalidInput, match=r"'short' has the shape \(1,\)"):
        remesh.write(tmp_path / "out.ply", mesh, vertex_data={"short": np.ones(1)})
    assert os.listdir(tmp_path) == []


def test_warnings_are_those_of_reading_and_of_the_result(mesh):
    crossing = np.vstack([mesh.V, mesh.V + [0.1, 0.05, 0.3]])
    both = remesh.Mesh(crossing, np.vstack([mesh.F, mesh.F + len(mesh.V)]), warnings=["a line"])
    result = remesh.remesh(both, 300, adaptive=True, max_edge=0.01)
    texts = result.report["warnings"]
    assert texts[0] == "a line"
    assert any("300 vertices are too few for max_edge" in text for text in texts), texts
    assert f"{len(texts)} warnings" in repr(result) and "\n" not in repr(result)


def test_more_memory_than_allowed_is_refused_before_the_work(mesh):
    stages = []
    with pytest.raises(remesh.OutOfMemory, match="use a smaller n .* or raise memory_limit") as error:
        remesh.remesh(mesh, 10**8, memory_limit="16G", progress=lambda _, stage: stages.append(stage))
    assert isinstance(error.value, MemoryError) and stages == []
    assert len(remesh.remesh(mesh, 100, memory_limit=None).V) == 100
    for wrong in ("many", "200%", 0):
        with pytest.raises(remesh.InvalidOption, match="memory_limit is"):
            remesh.remesh(mesh, 100, memory_limit=wrong)


def test_progress_runs_once_from_0_to_1(mesh):
    for options in ({"n": 300}, {"max_distance": "2%"}):
        seen = []
        remesh.remesh(mesh, **options, progress=lambda fraction, stage: seen.append((fraction, stage)))
        fractions = [fraction for fraction, _ in seen]
        assert fractions == sorted(fractions) and fractions[0] < 0.1 and fractions[-1] == 1
        assert fractions.count(1) == 1 and {"clean", "relax"} <= {stage for _, stage in seen}


@pytest.mark.parametrize("options, text", [
    ({"features": "angle"}, "features is 'angle'; use 'auto', 'off' or an angle in degrees"),
    ({"features": 200}, "features is 200"),
    ({"sizing": -1}, "sizing is -1"),
    ({"adaptive": True, "sizing": 0.1}, "several of adaptive, sizing, face_sizing and density"),
    ({"face_labels": "colour"}, "face_labels: the mesh has no values 'colour' of faces; it has: "),
])
def test_messages_name_what_the_caller_wrote(mesh, options, text):
    with pytest.raises(remesh.InvalidOption, match=text):
        remesh.remesh(mesh, 100, **options)


def test_faces_have_a_sizing(mesh):
    V, F = mesh.V, mesh.F
    lengths = np.full(len(F), 0.2)
    same = remesh.remesh(V, F, face_sizing=lengths)
    assert len(same.V) == len(remesh.remesh(V, F, sizing=0.2).V)
    lengths[V[F].mean(axis=1)[:, 0] > 0] = 0.1
    finer = remesh.remesh(V, F, face_sizing=lengths)
    assert (finer.V[:, 0] > 0).sum() > 2 * (finer.V[:, 0] < 0).sum()
    with pytest.raises(remesh.InvalidOption, match=r"face_sizing has the shape \(2,\)"):
        remesh.remesh(V, F, face_sizing=lengths[:2])
    with pytest.raises(remesh.InvalidOption, match="face_sizing: the mesh has no values 'q'"):
        remesh.remesh(V, F, face_sizing="q")


def test_one_number_is_a_sizing(mesh):
    V, F = mesh.V, mesh.F
    assert np.array_equal(remesh.remesh(V, F, sizing=0.2).V,
                          remesh.remesh(V, F, sizing=np.full(len(V), 0.2)).V)
