"""What the panel asks for. The fields stand in the scene for the panel, and in the operator for scripts."""

import math

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty


def field(kind, **settings):
    return kind(options={"SKIP_SAVE"}, **settings)  # A script that leaves it out gets its default, not the last value.


class Fields:
    """What the panel asks for, with the meaning of the options of remesh."""
    size: field(EnumProperty, name="Size by", default="VERTICES", items=[
        ("VERTICES", "Vertices", "The result has so many vertices"),
        ("LENGTH", "Edge length", "The mean edge of the result, in units of the object's data"),
        ("DISTANCE", "Distance", "No point of the result is farther from the object, and none of the object from it")])
    vertices: field(IntProperty, name="Vertices", default=2000, min=4, soft_max=1000000)
    length: field(FloatProperty, name="Edge length", default=0.1, min=1e-9, precision=4, unit="LENGTH")
    distance: field(FloatProperty, name="Largest distance", default=0.01, min=1e-9, precision=4, unit="LENGTH")
    adaptive: field(BoolProperty, name="Adaptive", description="Shorter edges where the surface is curved")
    sharp: field(EnumProperty, name="Sharp edges", default="auto", items=[
        ("auto", "Automatic", "Keeps sharp edges that are long and strong enough for the spacing"),
        ("angle", "By angle", "Keeps all edges that are sharper than an angle"),
        ("off", "None", "Keeps no edges for their angle")])
    angle: field(FloatProperty, name="Angle", default=math.radians(40), min=math.radians(1), max=math.radians(179),
                         subtype="ANGLE")
    marked: field(BoolProperty, name="Marked edges", default=True, description="Keeps edges that are marked sharp")
    materials: field(BoolProperty, name="Materials' borders", default=True,
                            description="Borders between materials become chains of edges")
    selected: field(BoolProperty, name="Selected faces only", description="All other faces stay as they are")
    density: field(StringProperty, name="Density", description="Vertex group: where the weight is 1, there are so many "
                                                               "times as many vertices per area as where it is 0")
    ratio: field(FloatProperty, name="Ratio", default=9, min=1, soft_max=100)
    wrap: field(BoolProperty, name="Wrap", description="Remesh the outside as one closed surface without intersections")
    new_object: field(BoolProperty, name="New object", description="Keep the object, and make another one")


def draw_fields(layout, fields, item):
    """item: the object, whose vertex groups are offered."""
    layout.prop(fields, "size", text="")
    layout.prop(fields, {"VERTICES": "vertices", "LENGTH": "length", "DISTANCE": "distance"}[fields.size])
    layout.prop(fields, "adaptive")
    layout.prop(fields, "sharp", text="Sharp")
    if fields.sharp == "angle":
        layout.prop(fields, "angle")
    layout.prop(fields, "marked")
    layout.prop(fields, "materials")
    layout.prop(fields, "selected")
    layout.prop_search(fields, "density", item, "vertex_groups")
    if fields.density:
        layout.prop(fields, "ratio")
    layout.prop(fields, "wrap")
    layout.prop(fields, "new_object")
