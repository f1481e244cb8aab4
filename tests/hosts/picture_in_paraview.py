"""Runs in the window of ParaView: the cells and the remesh of a mesh, with the fields of the filter. The environment
names plugin and mesh."""

import inspect
import os

if not hasattr(inspect, "getargspec"):
    inspect.getargspec = inspect.getfullargspec

from paraview import simple

simple.LoadPlugin(os.environ["PLUGIN"], remote=False, ns=vars(simple))
mesh = simple.PLYReader(FileNames=[os.environ["MESH"]])
mesh.UpdatePipeline()
bounds = mesh.GetDataInformation().GetBounds()
size = bounds[1] - bounds[0]
view = simple.GetActiveViewOrCreate("RenderView")
simple.Hide(mesh, view)
diagram = simple.GeodesicVoronoiDiagram(Input=mesh, NumberOfSites=60)
cells = simple.Show(diagram, view)
simple.ColorBy(cells, ("CELLS", "geodesic_site"))
cells.SetScalarBarVisibility(view, False)
bisectors = simple.Show(simple.OutputPort(diagram, 1), view)
bisectors.ColorArrayName = ["POINTS", ""]
bisectors.LineWidth, bisectors.PointSize = 3, 6
bisectors.AmbientColor = bisectors.DiffuseColor = [0, 0, 0]
for one in (cells, bisectors):
    one.Position = [-size, 0, 0]
result = simple.Remesh(Input=mesh, Vertices=2000)
shown = simple.Show(result, view)
shown.ColorArrayName = ["POINTS", ""]
shown.Representation = "Surface With Edges"
simple.SetActiveSource(result)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1, 0], [0, 0, 0], [0, 0, 1]
simple.ResetCamera(view)
simple.GetActiveCamera().Dolly(1.4)
simple.Render(view)
print("READY", flush=True)
