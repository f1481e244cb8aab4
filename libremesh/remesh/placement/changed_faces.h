//! \file
//! Faces by their corners: a mesh of some, and which of those that an edit changed is the nearest.
//! Private to the guards of edited meshes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! A mesh of these faces, in their order. They share no vertices.
[[nodiscard]] inline TriangleMesh mesh_of(std::span<const std::array<Vec3, 3>> faces) {
    TriangleMesh mesh;
    for (Index i = 0; i < faces.size(); ++i) {
        mesh.positions.insert(mesh.positions.end(), faces[i].begin(), faces[i].end());
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return mesh;
}

//! The same for faces of an edited mesh.
[[nodiscard]] inline TriangleMesh mesh_of(const EditedMesh& mesh, std::span<const Index> faces) {
    std::vector<std::array<Vec3, 3>> corners;
    corners.reserve(faces.size());
    for (const Index f : faces) corners.push_back(mesh.corners_of(f));
    return mesh_of(corners);
}

//! The faces that an edit has changed or made, as they are now.
class ChangedFaces {
public:
    struct Face {
        Index number;  //!< In the edited mesh.
        std::array<Vec3, 3> corners;
        MeshBox box;
        Vec3 normal;  //!< Twice its area long.
    };

    //! \param changed  each once, also those that are no longer there.
    void set(const EditedMesh& mesh, std::span<const Index> changed) {
        faces_.clear();
        for (const Index f : changed) {
            if (!mesh.face(f).is_there) continue;
            faces_.push_back({f, mesh.corners_of(f), mesh.box_of(f), mesh.normal_of(f)});
        }
    }
    [[nodiscard]] std::span<const Face> faces() const { return faces_; }

    //! The nearest point of those faces for which counts(face) is true, and its face in the edited
    //! mesh. Infinitely far and in no face if there is none.
    //! Cost: O(#faces).
    template <typename Counts>
    [[nodiscard]] ClosestPoint nearest(const Vec3& point, const Counts& counts) const {
        ClosestPoint nearest;
        nearest.distance_sq = infinity;
        for (const Face& f : faces_) {
            if (!counts(f)) continue;
            const double least =
                (point - point.cwiseMax(f.box.low).cwiseMin(f.box.high)).squaredNorm();
            if (least >= nearest.distance_sq) continue;
            const ClosestPoint here = closest_point_on_triangle(f.corners, FaceId(f.number), point);
            if (here.distance_sq < nearest.distance_sq) nearest = here;
        }
        return nearest;
    }

private:
    std::vector<Face> faces_;
};

}  // namespace remesh::detail
