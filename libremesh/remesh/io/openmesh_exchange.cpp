#include "remesh/io/openmesh_exchange.h"

#include <algorithm>

namespace remesh {
namespace {

using Mesh = OpenMesh::TriMesh;
using Corners = std::array<OpenMesh::VertexHandle, 3>;

// Whether the two half-edges, which exist and have no face, can become neighbours at the vertex
// between them. If another fan of faces lies between them, OpenMesh moves it into another gap of
// the vertex, which must exist.
bool can_be_joined(const Mesh& mesh, OpenMesh::HalfedgeHandle in, OpenMesh::HalfedgeHandle out) {
    if (mesh.next_halfedge_handle(in) == out) return true;
    OpenMesh::HalfedgeHandle gap = mesh.opposite_halfedge_handle(out);
    do {
        gap = mesh.opposite_halfedge_handle(mesh.next_halfedge_handle(gap));
    } while (!mesh.is_boundary(gap));
    return gap != in;
}

// The conditions of OpenMesh's add_face, tested beforehand, as it prints a message when it refuses.
bool can_be_added(const Mesh& mesh, const Corners& corner) {
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

}  // namespace

ToOpenMesh to_openmesh(const agvd::MeshView& mesh) {
    ToOpenMesh result;
    result.mesh.reserve(mesh.positions.size(), mesh.positions.size() + mesh.triangles.size(),
                        mesh.triangles.size());
    for (const agvd::Vec3& p : mesh.positions) {
        result.mesh.add_vertex(OpenMesh::Vec3d(p.x(), p.y(), p.z()));
    }
    for (agvd::Index f = 0; f < mesh.triangles.size(); ++f) {
        const agvd::Triangle& triangle = mesh.triangles[f];
        const agvd::Index highest = std::ranges::max(triangle);
        if (highest >= mesh.positions.size()) {
            throw agvd::InvalidInput("face " + std::to_string(f) + " names vertex " +
                                     std::to_string(highest) + ", but the mesh has only " +
                                     std::to_string(mesh.positions.size()) +
                                     " vertices, counted from 0; correct or delete the face");
        }
        Corners corner;
        std::ranges::transform(triangle, corner.begin(), [](agvd::Index v) {
            return OpenMesh::VertexHandle(static_cast<int>(v));
        });
        if (!can_be_added(result.mesh, corner) ||
            !result.mesh.add_face(corner[0], corner[1], corner[2]).is_valid()) {
            result.missing_faces.emplace_back(f);
        }
    }
    return result;
}

}  // namespace remesh
