"""Remeshing and geodesic distances by the programs remesh and agvd."""

import bpy

from .fields import Fields, draw_fields
from .operators import OPERATORS, OBJECT_OT_remesh_geodesic

bl_info = {
    "name": "Remesh (Geodesic)",
    "description": "Even triangles by geodesic Voronoi diagrams; geodesic distances and cells",
    "author": "The authors of remesh",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Object menu; 3D View > Sidebar > Remesh",
    "category": "Mesh",
}


class RemeshPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    folder: bpy.props.StringProperty(name="Folder of the programs", subtype="DIR_PATH",
                                     description="Where remesh and agvd are, if not in PATH")

    def draw(self, context):
        self.layout.prop(self, "folder")


class RemeshFields(Fields, bpy.types.PropertyGroup):
    pass


def draw_button(layout, context):
    """A button that remeshes as the fields of the scene say."""
    button = layout.operator(OBJECT_OT_remesh_geodesic.bl_idname)
    for name in Fields.__annotations__:
        setattr(button, name, getattr(context.scene.remesh_fields, name))


class VIEW3D_PT_remesh_geodesic(bpy.types.Panel):
    bl_label = "Remesh (Geodesic)"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Remesh"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def draw(self, context):
        draw_fields(self.layout, context.scene.remesh_fields, context.object)
        draw_button(self.layout, context)
        for operator in OPERATORS[1:]:
            self.layout.operator(operator.bl_idname)


def draw_menu(self, context):
    self.layout.separator()
    draw_button(self.layout, context)
    for operator in OPERATORS[1:]:
        self.layout.operator(operator.bl_idname)


CLASSES = (RemeshPreferences, RemeshFields, *OPERATORS, VIEW3D_PT_remesh_geodesic)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.remesh_fields = bpy.props.PointerProperty(type=RemeshFields)
    bpy.types.VIEW3D_MT_object.append(draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(draw_menu)
    del bpy.types.Scene.remesh_fields
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
