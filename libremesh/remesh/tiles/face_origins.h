//! \file
//! Meshes whose faces are parts of the faces of another mesh. Private to remeshing.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! Barycentric coordinates in a face.
using Weights = std::array<double, 3>;

//! Corners of a part of a face, in barycentric coordinates of that face.
using PartCorners = std::array<Weights, 3>;

//! The whole face as a part of itself.
inline constexpr PartCorners whole_face{Weights{1, 0, 0}, Weights{0, 1, 0}, Weights{0, 0, 1}};

//! A point between two others: those on one edge of the face stay exactly on it.
[[nodiscard]] inline Weights between(const Weights& a, const Weights& b, double share) {
    Weights point;
    for (Index k = 0; k < 3; ++k) point[k] = (1 - share) * a[k] + share * b[k];
    return point;
}

//! For each face of a mesh the face of another mesh in which it lies, and where.
class FaceOrigins {
public:
    [[nodiscard]] Index num_faces() const { return static_cast<Index>(face_.size()); }
    void reserve(std::size_t count) {
        face_.reserve(count);
        part_.reserve(count);
    }
    //! The next face is a whole one.
    void add_whole(Index face) {
        face_.push_back(face);
        part_.push_back(no_index);
    }
    //! The next face is a part.
    void add(Index face, const PartCorners& corners) {
        face_.push_back(face);
        part_.push_back(static_cast<Index>(corners_.size()));
        corners_.push_back(corners);
    }

    //! The next face is one of other parts.
    void add(const FaceOrigins& others, Index part) {
        if (others.part_[part] == no_index) {
            add_whole(others.face_[part]);
        } else {
            add(others.face_[part], others.corners_[others.part_[part]]);
        }
    }

    //! The face in which a face lies.
    [[nodiscard]] Index face(Index part) const { return face_[part]; }
    [[nodiscard]] const PartCorners& corners(Index part) const {
        return part_[part] == no_index ? whole_face : corners_[part_[part]];
    }
    //! The same point on the other mesh.
    [[nodiscard]] SurfacePoint to_whole(const SurfacePoint& point) const {
        const Index part = point.face.value();
        if (part_[part] == no_index) return {FaceId(face_[part]), point.barycentric};
        const PartCorners& corners = corners_[part_[part]];
        Weights sum{};
        for (Index k = 0; k < 3; ++k) {
            for (Index i = 0; i < 3; ++i) sum[i] += point.barycentric[k] * corners[k][i];
        }
        return {FaceId(face_[part]), sum};
    }
    //! The half-edge of the other mesh on which a half-edge lies; no_index: it lies inside a face.
    [[nodiscard]] Index half_edge_of_whole(Index half_edge) const {
        const PartCorners& c = corners(Surface::face(half_edge));
        const Weights &from = c[half_edge % 3], &to = c[Surface::next(half_edge) % 3];
        for (Index k = 0; k < 3; ++k) {
            const Index opposite = (k + 2) % 3;
            if (from[opposite] == 0 && to[opposite] == 0) {
                return 3 * face_[Surface::face(half_edge)] + k;
            }
        }
        return no_index;
    }

private:
    std::vector<Index> face_, part_;  // Part: index into corners_; no_index: a whole face.
    std::vector<PartCorners> corners_;
};

//! A corner of a polygon in a face.
struct PartPoint {
    Index vertex;     //!< Of the mesh that is made.
    Weights weights;  //!< In the face.
};

//! Divides a convex polygon in a face into triangles. Neighbouring sides may lie on one line.
//! \param corners  of the face.
//! \return indices into `polygon`; without triangles of no area if the polygon has area.
//! Cost: O(n^2).
[[nodiscard]] std::vector<Triangle> triangulate_part(const std::array<Vec3, 3>& corners,
                                                     std::span<const PartPoint> polygon);

}  // namespace remesh
