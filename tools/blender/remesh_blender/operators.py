"""The operators: remesh, geodesic distance and cells, and faces of a bad verdict."""

import json
import math
import os

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from . import exchange
from .fields import Fields, draw_fields
from .jobs import Job
from .program import Failed, verdict

NEAR = 0.15  # Lengths of an edge; vertices beside a chain are farther from it.
NARROW = math.radians(30)  # What remesh calls a narrow face has a smaller angle.


def evaluated_mesh(context):
    """A new mesh: that of the object with its modifiers."""
    graph = context.evaluated_depsgraph_get()
    return bpy.data.meshes.new_from_object(context.object.evaluated_get(graph), preserve_all_data_layers=True,
                                           depsgraph=graph)


def marked_edges(mesh, mark):
    """#edges x 2: the ends of edges with a mark, use_edge_sharp or use_seam."""
    return exchange.get(mesh.edges, "vertices", np.int32, 2)[exchange.get(mesh.edges, mark, bool)]


def mark_edges(mesh, mark, lines):
    """Marks edges of a result whose ends and middle lie on the lines, #lines x 2 x 3."""
    corners = [(2 * i, 2 * i + 1, 2 * i + 1) for i in range(len(lines))]
    tree = BVHTree.FromPolygons(lines.reshape(-1, 3).tolist(), corners)
    for edge in mesh.edges:
        a, b = (mesh.vertices[i].co for i in edge.vertices)
        length = (b - a).length
        setattr(edge, mark, all(tree.find_nearest(point, NEAR * length)[0] is not None
                                for point in (a, b, (a + b) / 2)))


class OBJECT_OT_remesh_geodesic(Fields, Job, bpy.types.Operator):
    """Replace the surface by even triangles"""
    bl_idname = "object.remesh_geodesic"
    bl_label = "Remesh (Geodesic)"
    bl_options = {"REGISTER", "UNDO"}

    def draw(self, context):
        draw_fields(self.layout, self, context.object)

    def start(self, context):
        mesh = evaluated_mesh(context)
        try:
            return "remesh", self._write(mesh, context.object.vertex_groups.keys())
        finally:
            bpy.data.meshes.remove(mesh)

    def _write(self, mesh, groups):
        if not mesh.polygons:
            raise Failed("the object has no faces")
        self._layers = layers = exchange.Layers(mesh, groups)
        arguments = ["in.ply", "out.ply"]
        arguments += {"VERTICES": ["--samples", self.vertices], "LENGTH": ["--edge-length", self.length],
                      "DISTANCE": ["--max-distance", self.distance]}[self.size]
        arguments += ["--features", math.degrees(self.angle) if self.sharp == "angle" else self.sharp]
        arguments += ["--adaptive"] * self.adaptive + ["--wrap"] * self.wrap
        if self.materials and "material_index" not in layers.constant:
            arguments.append("--keep-labels=material_index")
        if self.selected and not layers.constant.get("select", False):  # Else all faces are selected.
            if "select" in layers.constant:
                raise Failed("no face is selected; select some in Edit Mode")
            arguments += ["--region", "select"]
        if self.density:
            if self.density not in groups:
                raise Failed(f"the object has no vertex group {self.density}")
            layers.add_density(self.ratio ** layers.weights[groups.index(self.density)])
            arguments += ["--density", "density"]
        marks = {mark: marked_edges(mesh, mark) for mark in ("use_edge_sharp", "use_seam")}
        if not self.marked or self.wrap:
            del marks["use_edge_sharp"]
        elif len(marks["use_edge_sharp"]):
            np.savetxt(os.path.join(self.path, "marked.txt"), marks["use_edge_sharp"], "%d")
            arguments += ["--feature-edges", "marked.txt"]
        points = exchange.get(mesh.vertices, "co", np.float32, 3)
        self._lines = {mark: points[ends] for mark, ends in marks.items() if len(ends)}
        layers.write(os.path.join(self.path, "in.ply"))
        return arguments

    def take(self, context, texts):
        arrays = exchange.read_ply(os.path.join(self.path, "out.ply"))
        mesh = evaluated_mesh(context)
        weights = self._layers.fill(mesh, arrays)
        for mark, lines in self._lines.items():
            mark_edges(mesh, mark, lines)
        item, old = context.object, context.object.data
        if self.new_object:
            item = item.copy()
            context.collection.objects.link(item)
            context.object.select_set(False)
            context.view_layer.objects.active = item
            item.select_set(True)
        item.modifiers.clear()
        item.data = mesh
        if old.users == 0:
            name = old.name
            bpy.data.meshes.remove(old)
            mesh.name = name
        exchange.fill_groups(item, self._layers.groups, weights)
        warnings = texts["warning"] + [f"{name} is not carried over" for name in self._layers.missing]
        for warning in warnings:
            self.report({"WARNING"}, warning)
        self.report({"WARNING" if warnings else "INFO"}, verdict(texts))


class OBJECT_OT_geodesic_distance(Job, bpy.types.Operator):
    """Measure along the surface from the selected vertices: distances as the attribute geodesic_distance and as a
    colour, and the nearest selected vertex of each face as the attribute geodesic_cell"""
    bl_idname = "object.geodesic_distance"
    bl_label = "Geodesic Distance and Cells"
    bl_options = {"REGISTER", "UNDO"}

    def start(self, context):
        mesh = context.object.data
        selected = np.flatnonzero(exchange.get(mesh.vertices, "select", bool))
        if not len(selected):
            raise Failed("no vertex is selected; select one or more in Edit Mode")
        layers = exchange.Layers(mesh, [])
        layers.write(os.path.join(self.path, "in.ply"))
        self._used = np.unique(layers.triangles)
        first = np.unique(layers.polygon, return_index=True)[1]  # The first triangle of each face stands for it.
        with open(os.path.join(self.path, "sites.txt"), "w") as file:
            file.writelines(f"v {i}\n" for i in selected)
        with open(os.path.join(self.path, "targets.txt"), "w") as file:
            file.writelines(f"v {i}\n" for i in self._used)
            file.writelines(f"f {i} {1 / 3} {1 / 3} {1 / 3}\n" for i in first)
        return "agvd", ["distance", "in.ply", "--sites", "sites.txt", "--targets", "targets.txt", "-o", "out.csv"]

    def take(self, context, texts):
        site, distance = np.loadtxt(os.path.join(self.path, "out.csv"), delimiter=",", skiprows=1, ndmin=2).T
        mesh = context.object.data
        of_vertex = np.full(len(mesh.vertices), np.inf)
        of_vertex[self._used] = distance[:len(self._used)]
        largest = max(of_vertex[np.isfinite(of_vertex)].max(), 1e-30)
        grey = np.minimum(of_vertex / largest, 1)
        color = np.stack([grey, grey, grey, np.ones_like(grey)], 1)
        exchange.set_attribute(mesh, "geodesic_distance", "FLOAT", "POINT", of_vertex)
        exchange.set_attribute(mesh, "geodesic_cell", "INT", "FACE", site[len(self._used):])
        exchange.set_attribute(mesh, "geodesic_distance_color", "FLOAT_COLOR", "POINT", color)
        mesh.color_attributes.active_color = mesh.color_attributes["geodesic_distance_color"]
        mesh.update()
        self.report({"INFO"}, f"largest distance {largest:.6g}")


class OBJECT_OT_select_bad_faces(Job, bpy.types.Operator):
    """Select the faces that intersect others, and those with an angle below 30 degrees"""
    bl_idname = "object.select_bad_faces"
    bl_label = "Select Bad Faces"
    bl_options = {"REGISTER", "UNDO"}

    def start(self, context):
        self._layers = exchange.Layers(context.object.data, [])
        self._layers.write(os.path.join(self.path, "in.ply"))
        return "remesh-eval", ["in.ply", "in.ply", "--samples", "1", "--report", "report.json"]

    def take(self, context, texts):
        with open(os.path.join(self.path, "report.json"), encoding="utf-8") as file:
            pairs = json.load(file)["result"]["self_intersecting_faces"] or []
        mesh = context.object.data
        intersecting = np.unique(np.array(pairs, int))
        narrow = np.flatnonzero(smallest_angles(mesh, self._layers.triangles) < NARROW)
        for elements in (mesh.vertices, mesh.edges):
            exchange.put(elements, "select", np.zeros(len(elements), bool))
        is_bad = np.zeros(len(mesh.polygons), bool)
        is_bad[self._layers.polygon[intersecting]] = is_bad[self._layers.polygon[narrow]] = True
        exchange.put(mesh.polygons, "select", is_bad)
        mesh.update()
        self.report({"INFO"}, f"{is_bad.sum()} faces selected; triangles: {len(intersecting)} intersect others, "
                              f"{len(narrow)} have an angle below 30 degrees")


def smallest_angles(mesh, triangles):
    """Of each triangle, in radians; 0 where it has no area."""
    points = exchange.get(mesh.vertices, "co", np.float32, 3).astype(float)[triangles]
    side = np.roll(points, -1, axis=1) - points
    cross = np.linalg.norm(np.cross(side[:, 0], side[:, 1]), axis=1)
    return np.arctan2(cross[:, None], -(side * np.roll(side, 1, axis=1)).sum(2)).min(axis=1)


OPERATORS = (OBJECT_OT_remesh_geodesic, OBJECT_OT_geodesic_distance, OBJECT_OT_select_bad_faces)
