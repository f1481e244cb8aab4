"""Report pages of results, in files and in Jupyter, and the accessor of PyVista."""

import html
import json
import re
import subprocess
import sys

import numpy as np
import pytest

import remesh

needs_viewer = pytest.mark.skipif(not remesh._remesh.has_viewer(),
                                  reason="built without the viewer of pages")


def data_of(page):
    return json.loads(re.search(r'id="page-data">(.*?)</script>', page, re.DOTALL)[1])


@needs_viewer
def test_the_page_tells_names_call_figures_and_labels(torus, tmp_path):
    V, F = torus
    side = (V[F].mean(axis=1)[:, 0] > 0).astype(np.int32)
    result = remesh.remesh(V, F, 300, adaptive=True, transfer={"side": side}, features=40)
    path = tmp_path / "torus.html"
    page = result.html(path, original_name="<b>torus</b>.ply", result_name="out.ply")
    assert path.read_text(encoding="utf-8") == page == result.html(
        original_name="<b>torus</b>.ply", result_name="out.ply")
    data = data_of(page)
    assert "<b>torus" not in page
    assert (data["original"]["name"], data["result"]["name"]) == ("<b>torus</b>.ply", "out.ply")
    assert data["command"] == "remesh.remesh(V, F, n=300, adaptive=True, features=40, transfer=...)"
    assert data["evaluation"]["result"]["vertices"] == 300
    assert data["result"]["labels"]["name"] == data["original"]["labels"]["name"] == "side"
    assert data["run"]["options"]["seed"] == 1
    assert [one["key"] for one in data["result"]["values"]] == ["distance", "target"]
    streams = dict(data["original"]["streams"])
    assert streams["cell_steps"] > 300, "the cells are missing"


@needs_viewer
def test_a_page_of_float32_and_of_a_region_has_no_cells(torus):
    V, F = torus
    result = remesh.remesh(V.astype(np.float32), F, 100, region=V[F].mean(axis=1)[:, 0] > 0)
    streams = dict(data_of(result.html())["original"]["streams"])
    assert "cell_steps" not in streams


@needs_viewer
def test_a_page_that_cannot_be_written_or_is_ended_is_told(torus, tmp_path):
    result = remesh.remesh(*torus, 100)
    with pytest.raises(remesh.FileError, match="no/torus.html cannot be written"):
        result.html(tmp_path / "no" / "torus.html")
    with pytest.raises(remesh.Cancelled):
        result.html(progress=lambda fraction, stage: False)


@pytest.mark.skipif(remesh._remesh.has_viewer(), reason="built with the viewer of pages")
def test_without_the_viewer_a_page_is_refused_and_jupyter_shows_the_text(torus):
    result = remesh.remesh(*torus, 100)
    with pytest.raises(remesh.InvalidOption, match="needs the viewer of pages"):
        result.html()
    assert result._repr_html_() is None


@needs_viewer
def test_jupyter_shows_the_page_in_a_frame(torus):
    interactiveshell = pytest.importorskip("IPython.core.interactiveshell")
    result = remesh.remesh(*torus, 100)
    shell = interactiveshell.InteractiveShell.instance()
    shell.display_formatter.active_types = ["text/plain", "text/html"]
    shown, _ = shell.display_formatter.format(result)
    assert shown["text/plain"] == "<remesh.Result: 100 vertices, 200 faces>"
    frame = re.fullmatch(r'<iframe srcdoc="([^"]*)"[^<>]*></iframe>', shown["text/html"])
    assert html.unescape(frame[1]) == result.html()


# What PyVista 0.48 has of accessors.
STAND_IN = """
import sys, types
import numpy as np
class PolyData:
    def __init__(self, points, faces):
        self.points, self.faces, self.point_data, self.cell_data = points, faces, {}, {}
def register_dataset_accessor(name, target):
    def register(accessor):
        setattr(target, name, property(accessor))
        return accessor
    return register
pyvista = types.ModuleType("pyvista")
pyvista.PolyData, pyvista.register_dataset_accessor = PolyData, register_dataset_accessor
sys.modules["pyvista"] = pyvista
import remesh
V, F = remesh.examples.torus()
mesh = PolyData(V, np.hstack([np.full((len(F), 1), 3), F]).ravel())
made = mesh.remesh(200, adaptive=True)
assert type(made) is PolyData
assert np.array_equal(made.points, remesh.remesh(V, F, 200, adaptive=True).V)
"""


def test_an_accessor_is_registered_where_pyvista_is_imported():
    subprocess.run([sys.executable, "-c", STAND_IN], check=True)


def test_pyvista_finds_the_accessor():
    pyvista = pytest.importorskip("pyvista", minversion="0.48")
    assert pyvista.Sphere().remesh(200).n_points == 200
