"""A plugin of ParaView: the filters Remesh, Geodesic Distance and Geodesic Voronoi Diagram, by remesh and agvd."""

import os
import tempfile

import numpy as np
from paraview.util.vtkAlgorithm import VTKPythonAlgorithmBase, smdomain, smproperty, smproxy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkPointSet, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

# tools/hosts/pack puts program.py here.

INTERVAL = 0.05  # Seconds between looks at a program.


def _element(kind, name, default, inside):
    return (name, default, f'<{kind} name="{name}" command="Set{name}" number_of_elements="1" '
                           f'default_values="{default}">{inside}</{kind}>')


def shown_if(field, value):
    return ('<Hints><PropertyWidgetDecorator type="GenericDecorator" mode="visibility" '
            f'property="{field}" value="{value}"/></Hints>')


def whole(name, default, hints=""):
    return _element("IntVectorProperty", name, default, '<IntRangeDomain name="range" min="1"/>' + hints)


def number(name, default, hints=""):
    return _element("DoubleVectorProperty", name, default, '<DoubleRangeDomain name="range" min="0"/>' + hints)


def flag(name):
    return _element("IntVectorProperty", name, 0, '<BooleanDomain name="bool"/>')


def choice(name, texts):
    entries = "".join(f'<Entry value="{i}" text="{text}"/>' for i, text in enumerate(texts))
    return _element("IntVectorProperty", name, 0, f'<EnumerationDomain name="enum">{entries}</EnumerationDomain>')


def array(name, association):
    """association: of the arrays that are offered, point or cell."""
    return _element("StringVectorProperty", name, "None", f"""
        <ArrayListDomain name="array_list" attribute_type="Scalars" input_domain_name="{association}_arrays"
                         none_string="None">
          <RequiredProperties><Property name="Input" function="Input"/></RequiredProperties>
        </ArrayListDomain>""")


def fields(*all_fields):
    """Decorates a filter: ParaView shows the fields, and self.NAME is the value."""
    def setter(name):
        def set_value(self, value):
            if value != getattr(self, name):
                setattr(self, name, value)
                self.Modified()
        return set_value

    def decorate(cls):
        for name, default, _ in all_fields:
            setattr(cls, name, default)
            setattr(cls, "Set" + name, setter(name))
        return smproperty.xml("".join(xml for _, _, xml in all_fields))(cls)
    return decorate


def surface_input(cls):
    """Decorates a filter: its input is a surface."""
    arrays = "".join(f'<InputArrayDomain name="{kind}_arrays" attribute_type="{kind}" optional="1"/>'
                     for kind in ("point", "cell"))
    data = smdomain.datatype(dataTypes=["vtkPolyData"], composite_data_supported=False)
    return smproperty.input(name="Input", port_index=0)(data(smdomain.xml(arrays)(cls)))


def sites_input(cls):
    """Decorates a filter: a second input, which may be missing, has points that are sites."""
    return smproperty.xml("""
        <InputProperty name="Sites" command="SetInputConnection" port_index="1">
          <DataTypeDomain name="input_type"><DataType value="vtkPointSet"/></DataTypeDomain>
          <Hints><Optional/></Hints>
          <Documentation>Points that are sites, such as an extracted selection; without them sites are spread evenly.
          </Documentation>
        </InputProperty>""")(cls)


class Carried:
    """The arrays of a surface: under names that each format keeps in a file, and as they were on a result."""

    def __init__(self, surface):
        self.surface = vtkPolyData()
        self.surface.CopyStructure(surface)
        self.arrays, self.missing = [], []
        for prefix, source, target in (("p", surface.GetPointData(), self.surface.GetPointData()),
                                       ("c", surface.GetCellData(), self.surface.GetCellData())):
            for i in range(source.GetNumberOfArrays()):
                one = source.GetArray(i)  # None: not of numbers.
                if one is None or one.GetName() == "vtkGhostType":
                    self.missing.append(source.GetAbstractArray(i).GetName())
                elif one is source.GetNormals():
                    target.SetNormals(one)  # A result has normals of its own, if the input has some.
                else:
                    copy = one.NewInstance()
                    copy.ShallowCopy(one)
                    copy.SetName(f"{prefix}{i}")
                    target.AddArray(copy)
                    self.arrays.append((prefix, f"{prefix}{i}", one))

    def name(self, prefix, name):
        """Of an array in the file."""
        return next((own for kind, own, one in self.arrays if (kind, one.GetName()) == (prefix, name)), name)

    def put_on(self, result):
        """Returns the names of arrays that did not come back."""
        missing = list(self.missing)
        for prefix, own, one in self.arrays:
            data = result.GetPointData() if prefix == "p" else result.GetCellData()
            # The first array of bytes that may be a colour comes back under one of these names.
            found = next((data.GetArray(name) for name in (own, "RGB", "RGBA") if data.GetArray(name)), None)
            if found is None:
                missing.append(one.GetName())
                continue
            values = one.NewInstance()
            values.DeepCopy(found)
            values.SetName(one.GetName())
            for i in range(one.GetNumberOfComponents()):
                if one.GetComponentName(i):
                    values.SetComponentName(i, one.GetComponentName(i))
            data.RemoveArray(found.GetName())
            data.AddArray(values)
        return missing


class Filter(VTKPythonAlgorithmBase):
    """Base of the filters. `results` runs programs and gives the data of each output port."""

    def __init__(self, inputs=1, outputs=1):
        super().__init__(nInputPorts=inputs, nOutputPorts=outputs, inputType="vtkPolyData", outputType="vtkPolyData")

    def FillInputPortInformation(self, port, info):
        info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet" if port else "vtkPolyData")
        if port:
            info.Set(self.INPUT_IS_OPTIONAL(), 1)
        return 1

    def RequestData(self, request, inputs, outputs):
        surface = vtkPolyData.GetData(inputs[0])
        sites = vtkPointSet.GetData(inputs[1]) if len(inputs) > 1 else None
        try:
            with tempfile.TemporaryDirectory(prefix="remesh-") as folder:
                self._folder = folder
                for port, result in enumerate(self.results(surface, sites)):
                    vtkPolyData.GetData(outputs, port).ShallowCopy(result)
        except Stopped:
            pass
        except (Failed, OSError) as error:
            vtkOutputWindow.GetInstance().DisplayErrorText(f"{self.LABEL}: {error}\n")
        return 1  # Otherwise each drawing would run the program again; after a failure the outputs are empty.

    def run(self, program, arguments):
        """Runs a program in the folder, with progress and abort; warnings go to the output window."""
        running = Run(program, arguments, self._folder)
        while not running.wait(INTERVAL):
            self.UpdateProgress(running.fraction)
            if self.GetAbortExecute():
                running.stop()
        for text in running.result()["warning"]:
            self.warn(text)

    def warn(self, text):
        vtkOutputWindow.GetInstance().DisplayWarningText(f"{self.LABEL}: {text}\n")

    def write(self, surface):
        writer = vtkXMLPolyDataWriter()
        writer.SetFileName(os.path.join(self._folder, "in.vtp"))
        writer.SetInputData(surface)
        writer.SetCompressorTypeToNone()
        writer.EncodeAppendedDataOff()
        writer.Write()

    def read(self, name):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(os.path.join(self._folder, name))
        reader.Update()
        return reader.GetOutput()

    def carry(self, carried, result):
        for name in carried.put_on(result):
            self.warn(f"{name} is not carried over")
        return result

    def site_options(self, sites):
        if sites is None:
            return ["--samples", self.NumberOfSites, "--init", "farthest"]
        if not sites.GetNumberOfPoints():
            raise Failed("the input Sites has no points")
        points = vtk_to_numpy(sites.GetPoints().GetData())
        np.savetxt(os.path.join(self._folder, "sites.txt"), points, "p %.17g %.17g %.17g")
        return ["--sites", "sites.txt"]


@smproxy.filter(name="GeodesicRemesh", label="Remesh")
@surface_input
@fields(choice("SizeBy", ["Vertices", "Edge length", "Largest distance"]),
        whole("Vertices", 2000, shown_if("SizeBy", 0)),
        number("EdgeLength", 0.1, shown_if("SizeBy", 1)),
        number("LargestDistance", 0.01, shown_if("SizeBy", 2)),
        flag("Adaptive"),
        choice("SharpEdges", ["Automatic", "By angle", "None"]),
        number("FeatureAngle", 40, shown_if("SharpEdges", 1)),
        array("BordersOf", "cell"),
        array("OnlyWhere", "cell"),
        array("EdgeLengths", "point"),
        array("Density", "point"),
        flag("Wrap"))
class GeodesicRemesh(Filter):
    """A surface of even triangles, with the arrays of the input."""
    LABEL = "Remesh"

    def results(self, surface, sites):
        carried = Carried(surface)
        self.write(carried.surface)
        arguments = ["in.vtp", "out.vtp"]
        arguments += [["--samples", self.Vertices], ["--edge-length", self.EdgeLength],
                      ["--max-distance", self.LargestDistance]][self.SizeBy]
        arguments += ["--features", ["auto", self.FeatureAngle, "off"][self.SharpEdges]]
        arguments += ["--adaptive"] * self.Adaptive + ["--wrap"] * self.Wrap
        for option, prefix, name in (("--keep-labels=", "c", self.BordersOf), ("--region=", "c", self.OnlyWhere),
                                     ("--sizing=", "p", self.EdgeLengths), ("--density=", "p", self.Density)):
            if name != "None":
                arguments.append(option + carried.name(prefix, name))
        self.run("remesh", arguments)
        return [self.carry(carried, self.read("out.vtp"))]


@smproxy.filter(name="GeodesicDistance", label="Geodesic Distance")
@sites_input
@surface_input
@fields(whole("NumberOfSites", 1))
class GeodesicDistance(Filter):
    """The input with its arrays, and of each point the distance along the surface and the nearest site."""
    LABEL = "Geodesic Distance"

    def __init__(self):
        super().__init__(inputs=2)

    def results(self, surface, sites):
        shape = vtkPolyData()
        shape.CopyStructure(surface)
        self.write(shape)
        self.run("agvd", ["distance", "in.vtp", "-o", "out.vtp", *self.site_options(sites)])
        result, found = vtkPolyData(), self.read("out.vtp").GetPointData()
        result.ShallowCopy(surface)
        for name in ("distance", "site"):
            values = found.GetArray(name)
            values.SetName("geodesic_" + name)
            result.GetPointData().AddArray(values)
        return [result]


@smproxy.filter(name="GeodesicVoronoiDiagram", label="Geodesic Voronoi Diagram")
@sites_input
@surface_input
@fields(whole("NumberOfSites", 100))
class GeodesicVoronoiDiagram(Filter):
    """The surface cut into cells, with its arrays and the cell array geodesic_site; and the lines between."""
    LABEL = "Geodesic Voronoi Diagram"

    def __init__(self):
        super().__init__(inputs=2, outputs=2)

    def results(self, surface, sites):
        carried = Carried(surface)
        self.write(carried.surface)
        self.run("agvd", ["diagram", "in.vtp", "--cells", "cells.vtp", "-o", "out.vtp", *self.site_options(sites)])
        cells = self.read("cells.vtp")
        cells.GetCellData().GetArray("site").SetName("geodesic_site")
        return [self.carry(carried, cells), without_polygons(self.read("out.vtp"))]


def without_polygons(diagram):
    """Keeps the polylines and vertices, which come first in the cell data."""
    number = diagram.GetNumberOfVerts() + diagram.GetNumberOfLines()
    lines = vtkPolyData()
    lines.SetPoints(diagram.GetPoints())
    lines.SetVerts(diagram.GetVerts())
    lines.SetLines(diagram.GetLines())
    lines.GetPointData().ShallowCopy(diagram.GetPointData())
    lines.GetCellData().CopyAllocate(diagram.GetCellData(), number)
    lines.GetCellData().CopyData(diagram.GetCellData(), 0, number, 0)
    return lines
