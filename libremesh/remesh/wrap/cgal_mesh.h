//! \file
//! Meshes of CGAL's wrap and union. For compile units that include CGAL already.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "agvd/mesh/mesh.h"

namespace remesh::detail {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

//! \param mesh  of triangles, without garbage.
[[nodiscard]] inline agvd::TriangleMesh to_triangle_mesh(const CgalMesh& mesh) {
    agvd::TriangleMesh result;
    result.positions.reserve(mesh.number_of_vertices());
    for (const auto v : mesh.vertices()) {
        const auto& p = mesh.point(v);
        result.positions.emplace_back(p.x(), p.y(), p.z());
    }
    result.triangles.reserve(mesh.number_of_faces());
    for (const auto f : mesh.faces()) {
        agvd::Triangle corners{};
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[k++] = v.idx();
        result.triangles.push_back(corners);
    }
    return result;
}

}  // namespace remesh::detail
