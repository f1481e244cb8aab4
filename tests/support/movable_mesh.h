// A mesh on its own surface, as input for repair_shape and EditedMesh.
#pragma once

#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/curves/curve_network.h"
#include "remesh/curves/glue.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/mesh_curves.h"
#include "remesh/placement/placement.h"

// The vertices of a surface where they are; those on the boundary stay on it.
struct MovableMesh {
    explicit MovableMesh(const agvd::TriangleMesh& mesh)
        : surface(agvd::build_surface(mesh.view())) {
        placed.triangles = mesh.triangles;
        placed.points.resize(mesh.positions.size());
        placed.offsets.assign(mesh.positions.size(), agvd::Vec3::Zero());
        mobility.assign(mesh.positions.size(), remesh::detail::Mobility::Free);
        for (agvd::Index h = 0; h < surface.twin.size(); ++h) {
            agvd::SurfacePoint corner{agvd::FaceId(h / 3), {0, 0, 0}};
            corner.barycentric[h % 3] = 1;
            placed.points[surface.tail(h)] = corner;
        }
        placed.hard = remesh::rim_of(mesh.triangles);
        for (const auto& [from, to] : placed.hard)
            mobility[from] = remesh::detail::Mobility::Boundary;
        // Closed curves: without nodes all of their vertices may move.
        for (std::vector<agvd::Index>& loop : agvd::boundary_loops(surface)) {
            network.curves.push_back(remesh::curve_of_loop(surface, std::move(loop)));
        }
    }

    [[nodiscard]] remesh::detail::MeshCurves curves() const { return {surface, surface, network}; }

    [[nodiscard]] agvd::TriangleMesh mesh_of(const remesh::PlacedMesh& mesh) const {
        agvd::TriangleMesh result{{}, mesh.triangles};
        for (agvd::Index v = 0; v < mesh.points.size(); ++v) {
            result.positions.push_back(mesh.position(surface.mesh.view(), v));
        }
        return result;
    }

    agvd::Surface surface;
    remesh::CurveNetwork network;  // Its boundary.
    remesh::PlacedMesh placed;
    std::vector<remesh::detail::Mobility> mobility;
};
