//! \file
//! Converts meshes from and to OpenMesh, for programs that use it. Needs the target
//! remesh::openmesh, which links OpenMesh; no other header includes OpenMesh.
//! Held by OpenMeshExchange in tests/remesh/meshfile.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <algorithm>
#include <type_traits>
#include <utility>

#include "remesh/meshfile/mesh_file.h"

namespace remesh {

//! Any mesh of OpenMesh, of triangles or polygons: all traits, all kinds of coordinates.
template <typename Mesh>
concept OpenMeshMesh =
    std::remove_cvref_t<Mesh>::is_trimesh() || std::remove_cvref_t<Mesh>::is_polymesh();

//! A mesh that came from OpenMesh, and the origin of each of its elements.
struct FromOpenMesh {
    TriangleMesh mesh;                             //!< Polygons are cut into triangles.
    std::vector<OpenMesh::VertexHandle> vertices;  //!< #V: the OpenMesh vertex of each.
    std::vector<OpenMesh::FaceHandle> faces;       //!< #F: the OpenMesh face of each.

    //! Every function of an MeshView takes it. The view must not outlive it.
    operator MeshView() const { return mesh; }
};

//! Copies vertices and faces in their order; deleted ones are skipped, whether or not the garbage
//! was collected. Isolated vertices stay. Coordinates are converted to double. Polygons are cut
//! into triangles as those of files are.
//! \throw InvalidInput  a coordinate is not finite; the text names the vertex.
//! Cost: O(n).
template <OpenMeshMesh Mesh>
[[nodiscard]] FromOpenMesh from_openmesh(const Mesh& source) {
    FromOpenMesh result;
    result.mesh.positions.reserve(source.n_vertices());
    result.mesh.triangles.reserve(source.n_faces());
    std::vector<Index> index(source.n_vertices(), no_index);
    for (const OpenMesh::VertexHandle v : source.all_vertices()) {
        if (source.has_vertex_status() && source.status(v).deleted()) continue;
        const auto& p = source.point(v);
        result.mesh.positions.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                           static_cast<double>(p[2]));
        if (!result.mesh.positions.back().allFinite()) {
            throw InvalidInput("OpenMesh vertex " + std::to_string(v.idx()) +
                               " has a coordinate that is not finite; correct or delete "
                               "the vertex");
        }
        index[static_cast<std::size_t>(v.idx())] = static_cast<Index>(result.vertices.size());
        result.vertices.push_back(v);
    }
    std::vector<Index> polygon;
    Ticker ticker;
    for (const OpenMesh::FaceHandle f : source.all_faces()) {
        if (source.has_face_status() && source.status(f).deleted()) continue;
        polygon.clear();
        for (const OpenMesh::VertexHandle v : source.fv_range(f)) {
            polygon.push_back(index[static_cast<std::size_t>(v.idx())]);
        }
        append_triangles(polygon, result.mesh.positions, ticker, result.mesh.triangles);
        result.faces.resize(result.mesh.triangles.size(), f);
    }
    return result;
}

namespace detail {

using OpenMeshCorners = std::array<OpenMesh::VertexHandle, 3>;

//! Whether the two half-edges, which exist and have no face, can become neighbours at the vertex
//! between them. If another fan of faces lies between them, OpenMesh moves it into another gap of
//! the vertex, which must exist.
template <typename Mesh>
[[nodiscard]] bool can_be_joined(const Mesh& mesh, OpenMesh::HalfedgeHandle in,
                                 OpenMesh::HalfedgeHandle out) {
    if (mesh.next_halfedge_handle(in) == out) return true;
    OpenMesh::HalfedgeHandle gap = mesh.opposite_halfedge_handle(out);
    do {
        gap = mesh.opposite_halfedge_handle(mesh.next_halfedge_handle(gap));
    } while (!mesh.is_boundary(gap));
    return gap != in;
}

//! The conditions of OpenMesh's add_face, tested beforehand, as it prints a message when it
//! refuses.
template <typename Mesh>
[[nodiscard]] bool can_be_added(const Mesh& mesh, const OpenMeshCorners& corner) {
    if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) return false;
    std::array<OpenMesh::HalfedgeHandle, 3> side;
    for (std::size_t k = 0; k < 3; ++k) {
        side[k] = mesh.find_halfedge(corner[k], corner[(k + 1) % 3]);
        if (!mesh.is_boundary(corner[k])) return false;
        if (side[k].is_valid() && !mesh.is_boundary(side[k])) return false;
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const OpenMesh::HalfedgeHandle in = side[k], out = side[(k + 1) % 3];
        if (in.is_valid() && out.is_valid() && !can_be_joined(mesh, in, out)) return false;
    }
    return true;
}

}  // namespace detail

//! A mesh that went to OpenMesh. Vertex handles are the indices; face handles too, past the faces
//! that are missing.
template <OpenMeshMesh Mesh>
struct ToOpenMesh {
    Mesh mesh;  //!< In OpenMesh's types.
    //! Faces that OpenMesh's half-edges cannot hold, ascending: with a repeated corner, or at an
    //! edge or vertex that is not manifold or not consistently oriented by what was added before
    //! them.
    std::vector<FaceId> missing_faces;
};

//! Copies all vertices, and the faces that fit, in order. A face that OpenMesh would refuse, or
//! attach to copied vertices as its file readers do, is left out and reported. All faces of a
//! result of remesh::remesh fit, unless its sheets are welded.
//! \tparam Mesh  the mesh to make; OpenMesh::TriMesh has coordinates in double.
//! \throw InvalidInput  an index is out of range; the text names the face.
//! Cost: O(n) for bounded valence.
template <OpenMeshMesh Mesh = OpenMesh::TriMesh>
[[nodiscard]] ToOpenMesh<Mesh> to_openmesh(const MeshView& mesh) {
    ToOpenMesh<Mesh> result;
    result.mesh.reserve(mesh.positions.size(), mesh.positions.size() + mesh.triangles.size(),
                        mesh.triangles.size());
    for (const Vec3& p : mesh.positions) {
        using Scalar = typename Mesh::Scalar;
        result.mesh.add_vertex(typename Mesh::Point(
            static_cast<Scalar>(p.x()), static_cast<Scalar>(p.y()), static_cast<Scalar>(p.z())));
    }
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& triangle = mesh.triangles[f];
        const Index highest = std::ranges::max(triangle);
        if (highest >= mesh.positions.size()) {
            throw InvalidInput("face " + std::to_string(f) + " names vertex " +
                               std::to_string(highest) + ", but the mesh has only " +
                               std::to_string(mesh.positions.size()) +
                               " vertices, counted from 0; correct or delete the face");
        }
        detail::OpenMeshCorners corner;
        std::ranges::transform(triangle, corner.begin(),
                               [](Index v) { return OpenMesh::VertexHandle(static_cast<int>(v)); });
        if (!detail::can_be_added(result.mesh, corner) ||
            !result.mesh.add_face(corner[0], corner[1], corner[2]).is_valid()) {
            result.missing_faces.emplace_back(f);
        }
    }
    return result;
}

}  // namespace remesh
