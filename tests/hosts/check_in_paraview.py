"""Runs in pvpython: the plugin on a sphere whose arrays are functions of the place. Argument: the plugin."""

import inspect
import os
import sys
import unittest

if not hasattr(inspect, "getargspec"):  # Python 3.11 has it no more, ParaView 5.11 needs it: see docs/paraview.md.
    inspect.getargspec = inspect.getfullargspec

import numpy as np
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkOutputWindow, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource


def make_sphere():
    """Point arrays that are linear in space, a colour, numbers of points; cell arrays by octant."""
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    sphere = vtkPolyData()
    sphere.CopyStructure(source.GetOutput())
    points = vtk_to_numpy(sphere.GetPoints().GetData()).astype(float)

    def add(data, name, values, cls=None):
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        data.AddArray(array)
        return array
    add(sphere.GetPointData(), "Height of it", points[:, 2])
    add(sphere.GetPointData(), "place", points.astype(np.float32)).SetComponentName(1, "y")
    add(sphere.GetPointData(), "colour", (127 * (points + 1)).astype(np.uint8))
    add(sphere.GetPointData(), "edges", 0.05 + 0.15 * (points[:, 2] < 0))
    ids = vtkIdTypeArray()
    ids.SetName("ids")
    ids.SetNumberOfTuples(len(points))
    for i in range(len(points)):
        ids.SetValue(i, i)
    sphere.GetPointData().AddArray(ids)
    middle = cell_middles(sphere)
    add(sphere.GetCellData(), "side", (middle[:, 2] > 0).astype(np.int32))
    add(sphere.GetCellData(), "weight", middle[:, 0])
    text = vtkStringArray()
    text.SetName("text")
    text.SetNumberOfValues(sphere.GetNumberOfCells())
    sphere.GetCellData().AddArray(text)
    return sphere


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def triangles_of(data):
    return vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def cell_middles(data):
    return points_of(data)[triangles_of(data)].mean(axis=1)


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def kind(data, name):
    return data.GetArray(name).GetDataTypeAsString()


class Plugin(unittest.TestCase):
    def setUp(self):
        self.sphere = make_sphere()
        self.source = simple.TrivialProducer()
        self.source.GetClientSideObject().SetOutput(self.sphere)

        self.texts = []

        def take(caller, event, text):
            self.texts.append(text)
        take.CallDataType = "string0"
        window = vtkOutputWindow.GetInstance()
        for event in ("ErrorEvent", "WarningEvent"):
            self.addCleanup(window.RemoveObserver, window.AddObserver(event, take))

    def result(self, proxy, port=0):
        proxy.UpdatePipeline()
        return proxy.GetClientSideObject().GetOutputDataObject(port)

    def test_arrays_come_back(self):
        result = self.result(simple.Remesh(Input=self.source, Vertices=1000))
        self.assertEqual(result.GetNumberOfPoints(), 1000)
        points, data = points_of(result), result.GetPointData()
        self.assertLess(np.abs(np.linalg.norm(points, axis=1) - 1).max(), 0.02)
        self.assertLess(np.abs(values(data, "Height of it") - points[:, 2]).max(), 0.02)
        self.assertEqual(kind(data, "Height of it"), "double")
        self.assertLess(np.abs(values(data, "place") - points).max(), 0.02)
        self.assertEqual(data.GetArray("place").GetComponentName(1), "y")
        self.assertEqual((kind(data, "place"), kind(data, "colour")), ("float", "unsigned char"))
        self.assertLess(np.abs(values(data, "colour") - 127 * (points + 1)).max(), 4)
        near = points_of(self.sphere)[values(data, "ids")]
        self.assertLess(np.linalg.norm(near - points, axis=1).max(), 0.15)
        self.assertEqual(kind(data, "ids"), "idtype")
        middle = cell_middles(result)
        away = np.abs(middle[:, 2]) > 0.05
        self.assertTrue((values(result.GetCellData(), "side") == (middle[:, 2] > 0))[away].all())
        self.assertLess(np.abs(values(result.GetCellData(), "weight") - middle[:, 0]).max(), 0.03)
        self.assertEqual(kind(result.GetCellData(), "side"), "int")
        self.assertEqual(self.texts, ["Remesh: text is not carried over\n"])

    def test_sizes(self):
        lengths = self.result(simple.Remesh(Input=self.source, SizeBy="Edge length", EdgeLength=0.1))
        edges = points_of(lengths)[triangles_of(lengths)]
        mean = np.linalg.norm(edges - np.roll(edges, 1, axis=1), axis=2).mean()
        self.assertLess(abs(mean - 0.1), 0.01)
        few, many = (self.result(simple.Remesh(Input=self.source, SizeBy="Largest distance", LargestDistance=d))
                     .GetNumberOfPoints() for d in (0.02, 0.005))
        self.assertGreater(many, 2 * few)

    def test_arrays_say_where_and_how_dense(self):
        sized = points_of(self.result(simple.Remesh(Input=self.source, Vertices=1000, EdgeLengths="edges")))
        self.assertGreater((sized[:, 2] > 0.3).sum(), 4 * (sized[:, 2] < -0.3).sum())
        dense = points_of(self.result(simple.Remesh(Input=self.source, Vertices=1000, Density="edges")))
        self.assertGreater((dense[:, 2] < -0.3).sum(), 2 * (dense[:, 2] > 0.3).sum())
        part = points_of(self.result(simple.Remesh(Input=self.source, Vertices=200, OnlyWhere="side")))
        below = points_of(self.sphere)[points_of(self.sphere)[:, 2] < -0.1]
        self.assertTrue({tuple(p) for p in below} <= {tuple(p) for p in part})
        self.assertLess((part[:, 2] > 0.1).sum(), 300)
        for borders, is_crossed in (("None", True), ("side", False)):
            kept = self.result(simple.Remesh(Input=self.source, Vertices=300, BordersOf=borders))
            z = points_of(kept)[triangles_of(kept)][:, :, 2]
            crossed = (z.min(axis=1) < -0.06) & (z.max(axis=1) > 0.06)
            self.assertEqual(crossed.any(), is_crossed)

    def test_sharp_edges(self):
        box = simple.Box()
        for sharp, corners in (({}, 8), ({"SharpEdges": "By angle", "FeatureAngle": 80}, 8),
                               ({"SharpEdges": "By angle", "FeatureAngle": 100}, 0), ({"SharpEdges": "None"}, 0)):
            points = points_of(self.result(simple.Remesh(Input=box, Vertices=500, **sharp)))
            self.assertEqual((np.abs(points).min(axis=1) > 0.49999).sum(), corners)

    def test_adaptive_and_wrap(self):
        stretched = simple.Transform(Input=self.source)
        stretched.Transform.Scale = [1, 1, 4]
        points = [points_of(self.result(simple.Remesh(Input=stretched, Vertices=500, Adaptive=on))) for on in (1, 0)]
        counts = [(np.abs(of_run[:, 2]) > 3.5).sum() for of_run in points]
        self.assertGreater(counts[0], 1.5 * counts[1])
        half = simple.Clip(Input=self.source, ClipType="Plane")
        half.ClipType.Normal = [0, 0, 1]
        surface = simple.ExtractSurface(Input=half)
        open_mesh, closed = (self.result(simple.Remesh(Input=surface, Vertices=500, Wrap=on)) for on in (0, 1))
        self.assertNotEqual(open_mesh.GetNumberOfPolys(), 2 * open_mesh.GetNumberOfPoints() - 4)
        self.assertEqual(closed.GetNumberOfPolys(), 2 * closed.GetNumberOfPoints() - 4)  # Of a sphere.

    def test_distances(self):
        sites = simple.PointSource(NumberOfPoints=1, Radius=0, Center=[0, 0, 1])
        result = self.result(simple.GeodesicDistance(Input=self.source, Sites=sites))
        distance, points = values(result.GetPointData(), "geodesic_distance"), points_of(result)
        self.assertLess(np.abs(distance - np.arccos(np.clip(points[:, 2], -1, 1))).max(), 0.02)
        self.assertTrue((values(result.GetPointData(), "geodesic_site") == 0).all())
        self.assertEqual(result.GetNumberOfCells(), self.sphere.GetNumberOfCells())
        for name in ("Height of it", "colour", "ids"):
            self.assertTrue((values(result.GetPointData(), name) == values(self.sphere.GetPointData(), name)).all())
        self.assertIsNotNone(result.GetCellData().GetAbstractArray("text"))
        sampled = self.result(simple.GeodesicDistance(Input=self.source, NumberOfSites=7))
        self.assertEqual(set(values(sampled.GetPointData(), "geodesic_site")), set(range(7)))

    def test_diagrams(self):
        sites = simple.Line(Point1=[0, 0, 1], Point2=[0, 0, -1], Resolution=1)
        diagram = simple.GeodesicVoronoiDiagram(Input=self.source, Sites=sites)
        cells, lines = self.result(diagram), self.result(diagram, 1)
        site, z = values(cells.GetCellData(), "geodesic_site"), cell_middles(cells)[:, 2]
        self.assertTrue((site == (z < 0)).all())
        self.assertLess(np.abs(values(cells.GetPointData(), "Height of it") - points_of(cells)[:, 2]).max(), 1e-6)
        self.assertEqual(kind(cells.GetPointData(), "colour"), "unsigned char")
        away = np.abs(z) > 0.06
        self.assertTrue((values(cells.GetCellData(), "side") == (z > 0))[away].all())
        self.assertEqual(lines.GetNumberOfPolys(), 0)
        self.assertGreater(lines.GetNumberOfLines(), 0)
        left, right = (values(lines.GetCellData(), name) for name in ("site_left", "site_right"))
        of_lines = slice(lines.GetNumberOfVerts(), None)
        self.assertEqual(set(left[of_lines]) | set(right[of_lines]), {0, 1})
        used = vtk_to_numpy(lines.GetLines().GetConnectivityArray())
        self.assertLess(np.abs(points_of(lines)[used][:, 2]).max(), 0.01)
        self.assertEqual(lines.GetNumberOfVerts(), 2)

    def test_errors_are_told(self):
        result = self.result(simple.Remesh(Input=self.source, Vertices=1))
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertRegex("".join(self.texts), "Remesh: .*1 samples? .* too few")
        self.texts.clear()
        programs, path = os.environ.pop("REMESH_PROGRAMS"), os.environ.pop("PATH")
        try:
            result = self.result(simple.GeodesicDistance(Input=self.source))
        finally:
            os.environ.update(REMESH_PROGRAMS=programs, PATH=path)
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertRegex("".join(self.texts), "Geodesic Distance: the program agvd is not found. Install")

    def test_progress_and_abort(self):
        proxy = simple.Remesh(Input=self.source, SizeBy="Largest distance", LargestDistance=0.0001)
        algorithm, seen = proxy.GetClientSideObject(), []

        def stop(caller, event):
            seen.append(algorithm.GetProgress())
            if seen[-1] > 0.02:
                algorithm.SetAbortExecute(1)
        algorithm.AddObserver("ProgressEvent", stop)
        result = self.result(proxy)
        self.assertEqual(seen, sorted(seen))
        self.assertGreater(max(seen), 0.02)
        self.assertEqual(result.GetNumberOfPoints(), 0)
        self.assertEqual(self.texts, [])


if __name__ == "__main__":
    simple.LoadPlugin(sys.argv[1], remote=False, ns=vars(simple))
    unittest.main(argv=["check_in_paraview", "-v", *sys.argv[2:]])
