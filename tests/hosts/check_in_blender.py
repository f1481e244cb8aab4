"""Runs in Blender without a window: the add-on on a torus whose values are functions of the place."""

import math
import os
import sys
import unittest

import bpy
import numpy as np

NAME = "remesh_blender"
RING, TUBE, AROUND, ACROSS = 1.0, 0.4, 96, 40  # Radii, and numbers of quads of the torus.


def get(collection, name, kind, width=1):
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def points_of(mesh):
    return get(mesh.vertices, "co", np.float32, 3)


def angles_of(points):
    """Around the axis, and around the tube: 0 to 1."""
    u = np.arctan2(points[:, 1], points[:, 0]) / (2 * np.pi) % 1
    v = np.arctan2(points[:, 2], np.hypot(points[:, 0], points[:, 1]) - RING) / (2 * np.pi) % 1
    return u, v


def off_by(a, b):
    """Of angles from 0 to 1."""
    return np.abs((a - b + 0.5) % 1 - 0.5)


def make_torus():
    """Two materials, on either side of y = 0; a weight and colours that are linear in space; texture coordinates that
    jump at u = 0 and v = 0, where seams are marked; a modifier that moves it; the circle u = 0.25, where it is smooth, is marked."""
    u, v = (a.ravel() for a in np.meshgrid(np.arange(AROUND), np.arange(ACROSS), indexing="ij"))
    a, b = 2 * np.pi * u / AROUND, 2 * np.pi * v / ACROSS
    ring = RING + TUBE * np.cos(b)
    points = np.stack([ring * np.cos(a), ring * np.sin(a), TUBE * np.sin(b)], 1)
    next_u, next_v = (u + 1) % AROUND, (v + 1) % ACROSS
    quads = np.stack([ACROSS * u + v, ACROSS * next_u + v, ACROSS * next_u + next_v, ACROSS * u + next_v], 1)
    mesh = bpy.data.meshes.new("torus")
    mesh.from_pydata(points.tolist(), [], quads.tolist())
    for name in ("front", "back"):
        mesh.materials.append(bpy.data.materials.new(name))
    middle = points[quads].mean(axis=1)
    mesh.polygons.foreach_set("material_index", (middle[:, 1] < 0).astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(quads), bool))
    corners = np.stack([np.stack([u, v]), np.stack([u + 1, v]), np.stack([u + 1, v + 1]), np.stack([u, v + 1])], 0)
    pairs = (corners / np.array([[AROUND], [ACROSS]])).transpose(2, 0, 1)
    mesh.uv_layers.new(name="chart").data.foreach_set("uv", pairs.astype(np.float32).ravel())
    mesh.attributes.new("height", "FLOAT", "POINT").data.foreach_set("value", points[:, 2].astype(np.float32))
    mesh.attributes.new("side", "INT", "FACE").data.foreach_set("value", 7 + (middle[:, 1] < 0).astype(np.int32))
    mesh.attributes.new("small", "INT8", "FACE").data.foreach_set("value", -(middle[:, 1] < 0).astype(np.int32))
    mesh.attributes.new("flag", "BOOLEAN", "FACE").data.foreach_set("value", middle[:, 1] < 0)
    mesh.attributes.new("place", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", points.astype(np.float32).ravel())
    mesh.attributes.new("pair", "FLOAT2", "POINT").data.foreach_set("vector", points[:, 1:].astype(np.float32).ravel())
    color = np.concatenate([points / 4 + 0.5, np.ones((len(points), 1))], 1)
    mesh.color_attributes.new("paint", "FLOAT_COLOR", "POINT").data.foreach_set("color", color.ravel())
    of_corner = mesh.color_attributes.new("old paint", "BYTE_COLOR", "CORNER")
    of_corner.data.foreach_set("color", color[quads.ravel()].ravel())
    mesh.color_attributes.active_color = mesh.color_attributes["paint"]
    for edge in mesh.edges:
        edge.use_edge_sharp = all(i // ACROSS == AROUND // 4 for i in edge.vertices)
        edge.use_seam = all(i // ACROSS == 0 for i in edge.vertices) or all(i % ACROSS == 0 for i in edge.vertices)
    item = bpy.data.objects.new("torus", mesh)
    bpy.context.collection.objects.link(item)
    item.vertex_groups.new(name="empty")
    group = item.vertex_groups.new(name="outward")
    for i, weight in enumerate(weight_at(points)):
        group.add([i], weight, "REPLACE")
    moved = item.modifiers.new("moved", "DISPLACE")
    moved.direction, moved.strength, moved.mid_level = "Z", 1.0, 0.0
    bpy.context.view_layer.objects.active = item
    item.select_set(True)
    return item


def weight_at(points):
    return (points[:, 0] / 2.8 + 0.5).astype(float)


def weights_of(item, name):
    index = item.vertex_groups[name].index
    return np.array([sum(g.weight for g in v.groups if g.group == index) for v in item.data.vertices])


def remesh(**fields):
    return bpy.ops.object.remesh_geodesic("EXEC_DEFAULT", True, **fields)


class AddOn(unittest.TestCase):
    def setUp(self):
        for item in list(bpy.data.objects):
            bpy.data.objects.remove(item)
        for mesh in list(bpy.data.meshes):
            bpy.data.meshes.remove(mesh)
        self.item = make_torus()

    def moved_back(self, mesh):
        return points_of(mesh) - [0, 0, 1]

    def test_values_come_back(self):
        self.assertEqual(remesh(vertices=1500), {"FINISHED"})
        item, mesh = bpy.context.object, bpy.context.object.data
        self.assertEqual(item, self.item)
        self.assertEqual((len(mesh.vertices), mesh.name, list(item.modifiers)), (1500, "torus", []))
        self.assertFalse(mesh.validate())
        points = self.moved_back(mesh)
        off = np.hypot(np.hypot(points[:, 0], points[:, 1]) - RING, points[:, 2]) - TUBE
        self.assertLess(np.abs(off).max(), 0.02)

        self.assertEqual(item.vertex_groups.keys(), ["empty", "outward"])
        self.assertEqual(weights_of(item, "empty").max(), 0)
        self.assertLess(np.abs(weights_of(item, "outward") - weight_at(points)).max(), 0.01)
        self.assertLess(np.abs(get(mesh.attributes["height"].data, "value", np.float32) - points[:, 2]).max(), 0.02)
        paint, old = mesh.color_attributes["paint"], mesh.color_attributes["old paint"]
        self.assertEqual((paint.domain, paint.data_type), ("POINT", "FLOAT_COLOR"))
        self.assertEqual((old.domain, old.data_type), ("CORNER", "BYTE_COLOR"))
        self.assertEqual(mesh.color_attributes.active_color.name, "paint")
        color = get(paint.data, "color", np.float32, 4)
        self.assertLess(np.abs(color[:, :3] - (points / 4 + 0.5)).max(), 0.01)
        self.assertLess(np.abs(color[:, 3] - 1).max(), 1e-6)
        of_corner = get(mesh.loops, "vertex_index", np.int32)
        self.assertLess(np.abs(get(old.data, "color", np.float32, 4) - color[of_corner]).max(), 0.02)

        triangles = of_corner.reshape(-1, 3)
        middle = points[triangles].mean(axis=1)
        material = get(mesh.polygons, "material_index", np.int32)
        self.assertEqual([m.name.split(".")[0] for m in mesh.materials], ["front", "back"])
        away = np.abs(middle[:, 1]) > 0.002
        self.assertTrue((material == (middle[:, 1] < 0))[away].all())
        self.assertTrue((get(mesh.attributes["small"].data, "value", np.int32) == -material).all())
        self.assertTrue((get(mesh.attributes["flag"].data, "value", bool) == material).all())
        self.assertLess(np.abs(get(mesh.attributes["place"].data, "vector", np.float32, 3) - points).max(), 0.02)
        self.assertLess(np.abs(get(mesh.attributes["pair"].data, "vector", np.float32, 2) - points[:, 1:]).max(), 0.02)
        self.assertTrue((get(mesh.attributes["side"].data, "value", np.int32) == 7 + material).all())
        self.assertTrue(get(mesh.polygons, "use_smooth", bool).all())

        uv = get(mesh.uv_layers["chart"].data, "uv", np.float32, 2)
        u, v = angles_of(points[of_corner])
        self.assertLess(off_by(uv[:, 0], u).max(), 0.01)
        self.assertLess(off_by(uv[:, 1], v).max(), 0.02)
        self.assertLess(np.ptp(uv.reshape(-1, 3, 2), axis=1).max(), 0.3)  # No face spans a seam.

        seams = get(mesh.edges, "vertices", np.int32, 2)[get(mesh.edges, "use_seam", bool)]
        u, v = angles_of(points[seams].reshape(-1, 3))
        self.assertLess(np.minimum(off_by(u, 0), off_by(v, 0)).max(), 0.01)
        length = np.linalg.norm(points[seams[:, 0]] - points[seams[:, 1]], axis=1).sum()
        self.assertLess(abs(length - 2 * np.pi * (RING + 2 * TUBE)), 0.05)

        sharp = get(mesh.edges, "vertices", np.int32, 2)[get(mesh.edges, "use_edge_sharp", bool)]
        self.assertGreater(len(sharp), 10)
        self.assertLess(np.abs(points[sharp][:, :, 0]).max(), 0.01)
        self.assertTrue((points[sharp][:, :, 1] > 0).all())
        length = np.linalg.norm(points[sharp[:, 0]] - points[sharp[:, 1]], axis=1).sum()
        self.assertLess(abs(length - 2 * np.pi * TUBE), 0.03)
        self.assertTrue((np.bincount(sharp.ravel())[np.unique(sharp)] == 2).all())  # A closed chain.

    def test_borders_of_materials_are_edges(self):
        for is_kept in (True, False):
            self.setUp()
            remesh(vertices=400, materials=is_kept, marked=False)
            mesh = bpy.context.object.data
            points = points_of(mesh)
            triangles = get(mesh.loops, "vertex_index", np.int32).reshape(-1, 3)
            y = points[triangles][:, :, 1]
            crossed = (y.min(axis=1) < -0.002) & (y.max(axis=1) > 0.002)
            self.assertEqual(crossed.any(), not is_kept)

    def test_one_undo_brings_all_back(self):
        before = points_of(self.item.data)
        bpy.ops.ed.undo_push(message="before")
        remesh(vertices=500)
        self.assertEqual(len(bpy.context.object.data.vertices), 500)
        bpy.ops.ed.undo()
        item = bpy.context.object  # Older references are invalid.
        self.assertEqual((item.name, item.data.name, item.modifiers.keys()), ("torus", "torus", ["moved"]))
        self.assertTrue((points_of(item.data) == before).all())
        self.assertGreater(weights_of(item, "outward").max(), 0.9)
        bpy.ops.ed.redo()
        self.assertEqual(len(bpy.context.object.data.vertices), 500)

    def test_a_run_that_fails_changes_nothing(self):
        mesh, before = self.item.data, points_of(self.item.data)
        with self.assertRaisesRegex(RuntimeError, ": 4 samples are too few for the topology"):
            remesh(vertices=4)
        with self.assertRaisesRegex(RuntimeError, "has no vertex group nothing"):
            remesh(density="nothing")
        programs, path = os.environ.pop("REMESH_PROGRAMS"), os.environ.pop("PATH")
        try:
            with self.assertRaisesRegex(RuntimeError, "remesh is not found. Install"):
                remesh()
        finally:
            os.environ.update(REMESH_PROGRAMS=programs, PATH=path)
        self.assertEqual((bpy.context.object.data, self.item.modifiers.keys()), (mesh, ["moved"]))
        self.assertTrue((points_of(mesh) == before).all())
        self.assertEqual(list(bpy.data.meshes), [mesh])
        self.assertEqual(list(bpy.data.objects), [self.item])

    def test_a_run_that_fails_is_no_step_to_undo(self):
        bpy.ops.ed.undo_push(message="first")
        self.item.location.x = 3
        bpy.ops.ed.undo_push(message="moved")
        with self.assertRaises(RuntimeError):
            remesh(vertices=4)
        bpy.ops.ed.undo()
        self.assertEqual(bpy.data.objects["torus"].location.x, 0)

    def test_marked_edges_may_go(self):
        remesh(vertices=1500, marked=False)
        mesh = bpy.context.object.data
        self.assertFalse(get(mesh.edges, "use_edge_sharp", bool).any())
        points = points_of(mesh)
        on_circle = (np.abs(points[:, 0]) < 1e-4) & (points[:, 1] > 0)
        self.assertLess(on_circle.sum(), 10)

    def test_the_folder_of_the_programs_may_be_a_setting(self):
        preferences = bpy.context.preferences.addons[NAME].preferences
        programs, path = os.environ.pop("REMESH_PROGRAMS"), os.environ.pop("PATH")
        preferences.folder = programs
        try:
            self.assertEqual(remesh(vertices=300), {"FINISHED"})
        finally:
            os.environ.update(REMESH_PROGRAMS=programs, PATH=path)
            preferences.folder = ""

    def test_a_new_object_leaves_the_old_one(self):
        before = points_of(self.item.data)
        remesh(vertices=300, new_object=True)
        item = bpy.context.object
        self.assertNotEqual(item, self.item)
        self.assertEqual((len(item.data.vertices), list(item.modifiers)), (300, []))
        self.assertEqual(item.vertex_groups.keys(), ["empty", "outward"])
        self.assertEqual(self.item.modifiers.keys(), ["moved"])
        self.assertTrue((points_of(self.item.data) == before).all())

    def test_other_objects_of_the_same_mesh_stay(self):
        other = bpy.data.objects.new("other", self.item.data)
        remesh(vertices=300)
        self.assertEqual(len(other.data.vertices), AROUND * ACROSS)

    def test_only_selected_faces_are_remeshed(self):
        mesh = self.item.data
        middle = np.array([p.center for p in mesh.polygons])
        selected = middle[:, 0] > 0
        mesh.polygons.foreach_set("select", selected)
        kept = {tuple(points_of(mesh)[i] + np.float32([0, 0, 1])) for p in mesh.polygons if not p.select
                for i in p.vertices}
        remesh(vertices=200, selected=True)
        new = bpy.context.object.data
        self.assertTrue(kept <= {tuple(p) for p in points_of(new)})
        chosen = get(new.polygons, "select", bool)
        self.assertEqual((~chosen).sum(), 2 * (~selected).sum())
        self.assertLess(chosen.sum(), selected.sum())

    def test_the_density_follows_a_vertex_group(self):
        remesh(vertices=1500, density="outward", ratio=9, marked=False, materials=False)
        x = points_of(bpy.context.object.data)[:, 0]
        self.assertGreater((x > 0.8).sum(), 4 * (x < -0.8).sum())

    def test_sizes_are_lengths_or_distances(self):
        remesh(size="LENGTH", length=0.1)
        mesh = bpy.context.object.data
        points, ends = points_of(mesh), get(mesh.edges, "vertices", np.int32, 2)
        lengths = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
        self.assertLess(abs(lengths.mean() - 0.1), 0.01)
        numbers = []
        for distance in (0.02, 0.005):
            self.setUp()
            remesh(size="DISTANCE", distance=distance)
            numbers.append(len(bpy.context.object.data.vertices))
        self.assertGreater(numbers[1], 2 * numbers[0])

    def test_adaptive_edges_are_shorter_where_it_is_curved(self):
        counts = []
        for adaptive in (True, False):
            bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, calc_uvs=False)
            bpy.context.object.data.vertices.foreach_set(
                "co", (points_of(bpy.context.object.data) * [1, 1, 4]).ravel())
            bpy.context.object.data.update()
            remesh(vertices=500, adaptive=adaptive)
            counts.append((np.abs(points_of(bpy.context.object.data)[:, 2]) > 3.5).sum())
        self.assertGreater(counts[0], 1.5 * counts[1])

    def test_wrap_closes_the_mesh(self):
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        self.item.data.polygons[0].select = True
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.delete(type="FACE")
        bpy.ops.object.mode_set(mode="OBJECT")
        remesh(vertices=800, wrap=True)
        mesh = bpy.context.object.data
        self.assertEqual(len(mesh.edges) * 2, len(mesh.polygons) * 3)  # No boundary.
        self.assertLess(np.abs(weights_of(bpy.context.object, "outward") - weight_at(points_of(mesh))).max(), 0.1)

    def test_creases_are_kept_by_angle(self):
        counts = {}
        for sharp, angle in (("auto", 1), ("angle", math.radians(80)), ("angle", math.radians(100)), ("off", 1)):
            bpy.ops.mesh.primitive_cube_add(size=2, calc_uvs=False)  # Their seams would be edges, too.
            remesh(vertices=500, sharp=sharp, angle=angle)
            points = np.abs(points_of(bpy.context.object.data))
            counts[sharp, round(math.degrees(angle))] = int((points.min(axis=1) > 0.9999).sum())
        self.assertEqual(counts["auto", 57], 8)
        self.assertEqual(counts["angle", 80], 8)
        self.assertEqual(counts["angle", 100], 0)
        self.assertEqual(counts["off", 57], 0)

    def test_what_is_not_carried_over_is_told(self):
        self.item.data.uv_layers.new(name="second", do_init=False)
        remesh(vertices=300)
        self.assertEqual(bpy.context.object.data.uv_layers.keys(), ["chart"])

    def test_distances_and_cells(self):
        mesh = self.item.data
        for elements in (mesh.vertices, mesh.edges, mesh.polygons):
            elements.foreach_set("select", np.zeros(len(elements), bool))
        sites = [0, ACROSS * (AROUND // 2)]
        for i in sites:
            mesh.vertices[i].select = True
        self.assertEqual(bpy.ops.object.geodesic_distance("EXEC_DEFAULT", True), {"FINISHED"})
        mesh = bpy.context.object.data
        distance = get(mesh.attributes["geodesic_distance"].data, "value", np.float32)
        points = points_of(mesh)
        self.assertEqual(distance[sites].tolist(), [0, 0])
        straight = np.linalg.norm(points[:, None] - points[sites], axis=2).min(axis=1)
        self.assertTrue((distance >= straight - 1e-5).all())
        outer = np.arange(AROUND) * ACROSS  # The outermost circle: it is not shortest, but near there.
        self.assertLess(abs(distance[outer[1]] - np.linalg.norm(points[outer[1]] - points[0])), 1e-5)
        color = get(mesh.color_attributes["geodesic_distance_color"].data, "color", np.float32, 4)
        self.assertLess(np.abs(color[:, 0] - distance / distance.max()).max(), 1e-6)
        cell = get(mesh.attributes["geodesic_cell"].data, "value", np.int32)
        middle = np.array([p.center for p in mesh.polygons])
        away = np.abs(middle[:, 0]) > 0.1
        self.assertTrue((cell == (middle[:, 0] < 0))[away].all())
        self.assertEqual(self.item.modifiers.keys(), ["moved"])
        for vertex in mesh.vertices:
            vertex.select = False
        with self.assertRaisesRegex(RuntimeError, "no vertex is selected"):
            bpy.ops.object.geodesic_distance()

    def test_objects_without_faces_are_refused(self):
        mesh = bpy.data.meshes.new("points")
        mesh.from_pydata([(0, 0, 0), (1, 0, 0)], [], [])
        item = bpy.data.objects.new("points", mesh)
        bpy.context.collection.objects.link(item)
        bpy.context.view_layer.objects.active = item
        mesh.vertices.foreach_set("select", [True, True])
        for operator in (remesh, bpy.ops.object.geodesic_distance, bpy.ops.object.select_bad_faces):
            with self.assertRaisesRegex(RuntimeError, "no faces?"):
                operator()
        with self.assertRaisesRegex(RuntimeError, "no face is selected"):
            for polygon in self.item.data.polygons:
                polygon.select = False
            bpy.context.view_layer.objects.active = self.item
            remesh(selected=True)

    def test_bad_faces_are_selected(self):
        remesh(vertices=500)
        self.assertEqual(bpy.ops.object.select_bad_faces(), {"FINISHED"})
        mesh = bpy.context.object.data
        self.assertFalse(get(mesh.polygons, "select", bool).any())
        # A vertex that is pulled through the other side of the tube, and a face that becomes narrow.
        corner = mesh.polygons[100].vertices[0]
        mesh.vertices[corner].co -= 1.5 * TUBE * 2 * mesh.vertices[corner].normal
        bpy.ops.object.select_bad_faces()
        bad = get(mesh.polygons, "select", bool)
        around = [p.index for p in mesh.polygons if corner in p.vertices]
        self.assertTrue(bad[around].all())
        self.assertGreater(bad.sum(), len(around))
        self.assertLess(bad.sum(), len(bad) / 4)


def install():
    """Installs the zip behind --, as the preferences do."""
    bpy.ops.preferences.addon_install(filepath=sys.argv[sys.argv.index("--") + 1])
    bpy.ops.preferences.addon_enable(module=NAME)


if __name__ == "__main__":
    install()
    bpy.context.preferences.edit.use_global_undo = True
    ended = unittest.main(argv=["check_in_blender", "-v", *sys.argv[sys.argv.index("--") + 2:]], exit=False)
    sys.exit(0 if ended.result.wasSuccessful() else 1)
