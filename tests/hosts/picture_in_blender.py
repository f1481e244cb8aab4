"""Runs in Blender with a window: a picture of the panel and of a result. Behind --: the zip, a mesh, the picture."""

import os
import sys

import bpy

sys.path.insert(0, os.path.dirname(__file__))
import check_in_blender
from check_in_blender_window import finish_by, remesh, view

MESH, PICTURE = sys.argv[-2:]


def click(x, y):
    """A generator, as Blender has to see one event after the other."""
    window = bpy.context.window_manager.windows[0]
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"),
                        ("LEFTMOUSE", "RELEASE"), ("MOUSEMOVE", "NOTHING")):
        x += 1
        window.event_simulate(type=kind, value=value, x=x, y=y)
        yield
        yield


def steps():
    for item in list(bpy.data.objects):
        bpy.data.objects.remove(item)
    bpy.ops.import_mesh.ply(filepath=MESH)
    item = bpy.context.object
    size = max(item.dimensions)
    fields = bpy.context.scene.remesh_fields
    fields.vertices, fields.new_object = 2000, True
    remesh(vertices=2000, new_object=True)
    while bpy.context.view_layer.objects.active == item:
        yield
    bpy.context.view_layer.objects.active.location.x = size * 0.8
    for each in bpy.data.objects:
        each.select_set(False)
    space = view()["area"].spaces.active
    space.show_region_ui = True
    bpy.context.view_layer.objects.active.show_wire = True
    bpy.context.view_layer.objects.active.show_all_edges = True
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = False
    bpy.context.preferences.view.smooth_view = 0
    bpy.context.preferences.system.use_region_overlap = False
    for _ in range(5):
        yield
    with bpy.context.temp_override(**view()):
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_all()
    space.region_3d.view_distance *= 0.8
    sidebar = next(region for region in view()["area"].regions if region.type == "UI")
    for _ in range(3):  # The first clicks close the splash screen.
        yield from click(sidebar.x + sidebar.width - 21, sidebar.y + sidebar.height - 169)  # The tab of the add-on.
    for _ in range(15):
        yield
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=PICTURE)


finish_by(steps())
