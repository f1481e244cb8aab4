"""Reads the meshes of data/: OFF, OBJ of triangles, binary PLY of triangles without lists besides."""

import numpy as np

TYPES = {"float": "f4", "float32": "f4", "double": "f8", "float64": "f8", "uchar": "u1",
         "uint8": "u1", "char": "i1", "short": "i2", "ushort": "u2", "int": "i4", "int32": "i4",
         "uint": "u4", "uint32": "u4"}


def read_mesh(path):
    """V (float64) and F (int64) of a file of triangles."""
    path = str(path)
    return {".off": _read_off, ".obj": _read_obj, ".ply": _read_ply}[path[-4:]](path)


def _read_off(path):
    with open(path) as file:
        words = [word for line in file for word in line.split("#")[0].split()]
    count, faces = int(words[1]), int(words[2])
    V = np.array(words[4:4 + 3 * count], float).reshape(-1, 3)
    rows = np.array(words[4 + 3 * count:4 + 3 * count + 4 * faces], np.int64).reshape(-1, 4)
    assert (rows[:, 0] == 3).all(), path
    return V, np.ascontiguousarray(rows[:, 1:])


def _read_obj(path):
    V, F = [], []
    with open(path) as file:
        for line in file:
            words = line.split()
            if words[:1] == ["v"]:
                V.append([float(x) for x in words[1:4]])
            if words[:1] == ["f"]:
                F.append([int(word.split("/")[0]) - 1 for word in words[1:4]])
    return np.array(V), np.array(F)


def _read_ply(path):
    with open(path, "rb") as file:
        content = file.read()
    end = content.index(b"end_header\n") + len(b"end_header\n")
    header = content[:end].decode().split("\n")
    order = "<" if "binary_little_endian" in header[1] else ">"
    counts, fields, element = {}, [], None
    for words in (line.split() for line in header):
        if words[:1] == ["element"]:
            element, counts[words[1]] = words[1], int(words[2])
        if words[:1] == ["property"] and element == "vertex":
            fields.append((words[2], order + TYPES[words[1]]))
        if words[:2] == ["property", "list"] and element == "face":
            row = np.dtype([("count", order + TYPES[words[2]]), ("corners", order + TYPES[words[3]], 3)])
    vertices = np.frombuffer(content, np.dtype(fields), counts["vertex"], end)
    faces = np.frombuffer(content, row, counts["face"], end + vertices.nbytes)
    assert (faces["count"] == 3).all(), path
    V = np.stack([vertices[name] for name in "xyz"], axis=1).astype(float)
    return V, faces["corners"].astype(np.int64)
