"""Meshes of Blender as PLY files, and back: positions, triangles, and everything that is carried over."""

import re

import numpy as np

TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
         "float": "<f4", "double": "<f8"}
# Of an attribute: the type in the file, numbers per element, and the name of its values in Blender. Numbers in float
# are interpolated, whole numbers are labels.
KINDS = {"FLOAT": ("float", 1, "value"), "INT": ("int", 1, "value"), "INT8": ("char", 1, "value"),
         "BOOLEAN": ("uchar", 1, "value"), "FLOAT2": ("float", 2, "vector"), "FLOAT_VECTOR": ("float", 3, "vector"),
         "FLOAT_COLOR": ("float", 4, "color"), "BYTE_COLOR": ("float", 4, "color")}
VALUES = {"float": np.float32, "int": np.int32, "char": np.int32, "uchar": bool}
LABELS = {"material_index": "int", "use_smooth": "uchar", "select": "uchar"}  # Of faces.
OWN = re.compile(r"position$|material_index$|shade_smooth$|sharp_(edge|face)$|\.")  # Not attributes of a user.


def get(collection, name, kind, width=1):
    """Values of all elements: #elements, or #elements x width."""
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values.reshape(-1, width) if width > 1 else values


def put(collection, name, values):
    collection.foreach_set(name, np.ascontiguousarray(values).ravel())


def set_attribute(mesh, name, data_type, domain, values):
    """Makes it, in place of an old one of this name."""
    if name in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[name])
    kind, _, field = KINDS[data_type]
    put(mesh.attributes.new(name, data_type, domain).data, field, np.asarray(values).astype(VALUES[kind]))


def write_ply(path, elements):
    """elements: [(name, [(property, type, values)])]; values with two dimensions are written as a list."""
    header, blocks = ["ply", "format binary_little_endian 1.0"], []
    for element, columns in elements:
        count, kinds = len(columns[0][2]), []
        header.append(f"element {element} {count}")
        for name, kind, values in columns:
            if values.ndim == 2:
                header.append(f"property list uchar {kind} {name}")
                kinds += [(name + "#", "u1"), (name, TYPES[kind], values.shape[1])]
            else:
                header.append(f"property {kind} {name}")
                kinds.append((name, TYPES[kind]))
        block = np.empty(count, kinds)
        for name, kind, values in columns:
            block[name] = values
            if values.ndim == 2:
                block[name + "#"] = values.shape[1]
        blocks.append(block)
    with open(path, "wb") as file:
        file.write("\n".join([*header, "end_header\n"]).encode())
        for block in blocks:
            block.tofile(file)


def read_ply(path):
    """Of a file that remesh wrote from one of write_ply: a structured array for each element."""
    with open(path, "rb") as file:
        data = file.read()
    begin = data.index(b"end_header\n") + len(b"end_header\n")
    elements = []
    for words in map(str.split, data[:begin].decode().splitlines()):
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[:2] == ["property", "list"]:
            width = 6 if words[4] == "texcoord" else 3
            elements[-1][2].extend([(words[4] + "#", TYPES[words[2]]), (words[4], TYPES[words[3]], width)])
        elif words[0] == "property":
            elements[-1][2].append((words[2], TYPES[words[1]]))
    arrays = {}
    for name, count, kinds in elements:
        arrays[name] = np.frombuffer(data, np.dtype(kinds), count, begin)
        begin += arrays[name].nbytes
    return arrays


class Layers:
    """What a mesh has besides its shape, as properties of a file, and back on another mesh."""

    def __init__(self, mesh, groups):
        """mesh: with loop triangles. groups: names of the vertex groups of its object."""
        mesh.calc_loop_triangles()
        count = len(mesh.vertices)
        self.triangles = get(mesh.loop_triangles, "vertices", np.int32, 3).reshape(-1, 3)
        self.polygon = get(mesh.loop_triangles, "polygon_index", np.int32)
        points = get(mesh.vertices, "co", np.float32, 3)
        self.vertex = [(axis, "double", values) for axis, values in zip("xyz", points.T)]
        self.face = [("vertex_indices", "int", self.triangles)]
        self.constant = {}  # What is the same on all faces need not be carried over by remesh.
        for name, kind in LABELS.items():
            values = get(mesh.polygons, name, VALUES[kind])[self.polygon]
            if len(values) and values.min() == values.max():
                self.constant[name] = values[0]
            else:
                self.face.append((name, kind, values))
        self.attributes, self.missing = [], []
        color = getattr(mesh, "color_attributes", None)
        self.active = (color.active_color.name if color and color.active_color else "",
                       color.render_color_index if color else -1)
        for attribute in mesh.attributes:
            self._add(mesh, attribute)
        self.uv = mesh.uv_layers.active.name if mesh.uv_layers.active else ""
        self.missing += [layer.name for layer in mesh.uv_layers if layer.name != self.uv]
        if self.uv:
            corners = get(mesh.loop_triangles, "loops", np.int32, 3)
            pairs = get(mesh.uv_layers.active.data, "uv", np.float32, 2)[corners]
            self.face.append(("texcoord", "float", pairs.reshape(-1, 6)))
        self.groups = list(groups)
        self.weights = np.zeros((len(self.groups), count), np.float32)  # 0 outside of a group.
        for vertex in mesh.vertices if self.groups else []:
            for member in vertex.groups:
                self.weights[member.group, vertex.index] = member.weight
        self.vertex += [(f"group_{i}", "float", of_group) for i, of_group in enumerate(self.weights)]

    def _add(self, mesh, attribute):
        is_color = attribute.data_type.endswith("_COLOR")
        if OWN.match(attribute.name) or attribute.name in mesh.uv_layers:
            return
        if attribute.data_type not in KINDS or not (attribute.domain in ("POINT", "FACE") or
                                                    attribute.domain == "CORNER" and is_color):
            self.missing.append(attribute.name)
            return
        kind, width, field = KINDS[attribute.data_type]
        values = get(attribute.data, field, VALUES[kind], width).reshape(-1, width)
        if attribute.domain == "CORNER":  # A vertex has the mean of its corners.
            of_corner = get(mesh.loops, "vertex_index", np.int32)
            sums = [np.bincount(of_corner, column, len(mesh.vertices)) for column in values.T]
            values = np.stack(sums, 1) / np.maximum(np.bincount(of_corner, minlength=len(mesh.vertices)), 1)[:, None]
        elif attribute.domain == "FACE":
            values = values[self.polygon]
        columns = self.face if attribute.domain == "FACE" else self.vertex
        names = [f"attribute_{len(self.attributes)}_{i}" for i in range(width)]
        columns += [(name, kind, column) for name, column in zip(names, values.T)]
        self.attributes.append((attribute.name, attribute.data_type, attribute.domain, names))

    def add_density(self, values):
        self.vertex.append(("density", "float", values))

    def write(self, path):
        write_ply(path, [("vertex", self.vertex), ("face", self.face)])

    def fill(self, mesh, arrays):
        """Replaces the shape of a mesh, which keeps its materials and settings, by that of a file, with all layers.
        Returns the weights of the vertex groups."""
        vertex, face = arrays["vertex"], arrays["face"]
        triangles = face["vertex_indices"]
        mesh.clear_geometry()
        mesh.from_pydata(np.stack([vertex[axis] for axis in "xyz"], 1).tolist(), [], triangles.tolist())
        for name, kind in LABELS.items():
            values = np.full(len(face), self.constant[name]) if name in self.constant else face[name]
            put(mesh.polygons, name, values.astype(VALUES[kind]))
        if self.uv:
            layer = mesh.uv_layers.new(name=self.uv)
            put(layer.data, "uv", face["texcoord"].astype(np.float32))
        for name, data_type, domain, columns in self.attributes:
            values = np.stack([(face if domain == "FACE" else vertex)[column] for column in columns], 1)
            set_attribute(mesh, name, data_type, domain, values[triangles.ravel()] if domain == "CORNER" else values)
        active, render = self.active
        if active:
            mesh.color_attributes.active_color = mesh.color_attributes[active]
            mesh.color_attributes.render_color_index = render
        mesh.update()
        return [vertex[f"group_{i}"] for i in range(len(self.groups))]


def fill_groups(item, names, weights):
    """Gives an object, whose mesh is new, its vertex groups back."""
    for name, of_group in zip(names, weights):
        group = item.vertex_groups.get(name) or item.vertex_groups.new(name=name)
        for index in np.flatnonzero(of_group > 0).tolist():
            group.add([index], float(of_group[index]), "REPLACE")
