//! \file
//! Converts meshes from and to OpenMesh, for programs that use it. Needs the target
//! remesh::openmesh; no other header includes OpenMesh.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "agvd/core/error.h"
#include "agvd/mesh/mesh_view.h"

namespace remesh {

//! Any OpenMesh triangle mesh: all traits, all kinds of coordinates.
template <typename Mesh>
concept OpenMeshTriangles = std::remove_cvref_t<Mesh>::is_trimesh();

//! A mesh that came from OpenMesh, and the origin of each of its elements.
struct FromOpenMesh {
    agvd::TriangleMesh mesh;
    std::vector<OpenMesh::VertexHandle> vertices;  //!< #V: the OpenMesh vertex of each.
    std::vector<OpenMesh::FaceHandle> faces;       //!< #F: the OpenMesh face of each.
};

//! Copies vertices and faces in their order; deleted ones are skipped, whether or not the garbage
//! was collected. Isolated vertices stay. Coordinates are converted to double.
//! \throw agvd::InvalidInput  a coordinate is not finite; the text names the vertex.
//! Cost: O(n).
template <OpenMeshTriangles Mesh>
[[nodiscard]] FromOpenMesh from_openmesh(const Mesh& source) {
    FromOpenMesh result;
    result.mesh.positions.reserve(source.n_vertices());
    result.mesh.triangles.reserve(source.n_faces());
    std::vector<agvd::Index> index(source.n_vertices(), agvd::no_index);
    for (const OpenMesh::VertexHandle v : source.all_vertices()) {
        if (source.has_vertex_status() && source.status(v).deleted()) continue;
        const auto& p = source.point(v);
        result.mesh.positions.emplace_back(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                           static_cast<double>(p[2]));
        if (!result.mesh.positions.back().allFinite()) {
            throw agvd::InvalidInput("OpenMesh vertex " + std::to_string(v.idx()) +
                                     " has a coordinate that is not finite; correct or delete "
                                     "the vertex");
        }
        index[static_cast<std::size_t>(v.idx())] = static_cast<agvd::Index>(result.vertices.size());
        result.vertices.push_back(v);
    }
    for (const OpenMesh::FaceHandle f : source.all_faces()) {
        if (source.has_face_status() && source.status(f).deleted()) continue;
        agvd::Triangle triangle{};
        auto corner = triangle.begin();
        for (const OpenMesh::VertexHandle v : source.fv_range(f)) {
            *corner++ = index[static_cast<std::size_t>(v.idx())];
        }
        result.mesh.triangles.push_back(triangle);
        result.faces.push_back(f);
    }
    return result;
}

//! A mesh that went to OpenMesh. Vertex handles are the indices; face handles too, past the faces
//! that are missing.
struct ToOpenMesh {
    OpenMesh::TriMesh mesh;  //!< Double coordinates.
    //! Faces that OpenMesh's half-edges cannot hold, ascending: with a repeated corner, or at an
    //! edge or vertex that is not manifold or not consistently oriented by what was added before
    //! them.
    std::vector<agvd::FaceId> missing_faces;
};

//! Copies all vertices, and the faces that fit, in order. A face that OpenMesh would refuse, or
//! attach to copied vertices as its file readers do, is left out and reported. All faces of a
//! result of remesh::remesh fit, unless its sheets are welded.
//! \throw agvd::InvalidInput  an index is out of range; the text names the face.
//! Cost: O(n) for bounded valence.
[[nodiscard]] ToOpenMesh to_openmesh(const agvd::MeshView& mesh);

}  // namespace remesh
