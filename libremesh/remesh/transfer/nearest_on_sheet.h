//! \file
//! Nearest points of a mesh on the sheet that a point belongs to.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <vector>

#include "agvd/core/groups.h"
#include "agvd/core/progress.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/meshfile/mesh_file.h"

namespace remesh::detail {

//! Where a search ends.
enum class SearchEnd {
    Ball,      //!< Where the ball ends only.
    Junction,  //!< Also at edges with more than two faces, where sheets meet.
};

//! Floods the part of the mesh in the ball around a point that is connected, within the ball, with
//! a given start: the other side of a thin wall is never found. Works on any triangles: vertices at
//! equal positions count as one, and edges may have any number of faces.
class NearestOnSheet {
public:
    //! \param mesh  outlives this; finite, indices in range. Cost: O(n).
    NearestOnSheet(const MeshView& mesh, Ticker ticker)
        : mesh_(mesh),
          points_(rename_vertices(mesh.triangles, first_at_position(mesh.positions, ticker))),
          faces_(triangles_by_vertex(points_, mesh.positions.size())) {
        double largest = 0;
        for (const Vec3& p : mesh.positions) largest = std::max(largest, p.cwiseAbs().maxCoeff());
        rounding_ = rounding_share * largest;
    }

    //! The point of the sheet that is nearest to `point`. It is `start` itself, bit for bit, if
    //! `point` lies there up to rounding.
    //! Cost: that of the faces in the ball around `point` that reaches to `start`.
    [[nodiscard]] ClosestPoint query(const Vec3& point, const SurfacePoint& start,
                                     SearchEnd end = SearchEnd::Ball) const {
        ClosestPoint best{start, position(mesh_, start), 0};
        best.distance_sq = (best.position - point).squaredNorm();
        if (best.distance_sq <= rounding_ * rounding_) return best;
        const double reach = (1 + margin) * std::sqrt(best.distance_sq);
        flood(point, reach, start.face.value(), end, [&](Index face) {
            const ClosestPoint here = closest(face, point);
            if (here.distance_sq < best.distance_sq) best = here;
            return true;
        });
        return best;
    }

    //! Whether a point lies where sheets meet, and belongs to all of them.
    [[nodiscard]] bool is_on_junction(const SurfacePoint& point) const {
        const Index face = point.face.value();
        const auto is_off = [&](std::size_t k) { return point.barycentric[k] > on_edge; };
        for (std::size_t k = 0; k < 3; ++k) {
            if (!is_off((k + 2) % 3) && is_junction(face, k)) return true;
            if (is_off((k + 1) % 3) || is_off((k + 2) % 3)) continue;
            for (const Index f : faces_.of(points_[face][k])) {
                const std::size_t at = corner_at(f, points_[face][k]);
                if (is_junction(f, at) || is_junction(f, (at + 2) % 3)) return true;
            }
        }
        return false;
    }

    //! Whether two faces are connected within a ball.
    //! Cost: that of the faces in the ball.
    [[nodiscard]] bool are_connected(const Vec3& point, double radius, Index a, Index b) const {
        bool is_found = false;
        flood(point, std::max(radius, rounding_), a, SearchEnd::Ball, [&](Index face) {
            is_found = face == b;
            return !is_found;
        });
        return is_found;
    }

    //! The same mesh where faces that do not agree at an edge are not neighbours.
    //! \param agree  outlives the copy.
    [[nodiscard]] NearestOnSheet cut_at_seams(const CornerAgreement& agree) const {
        NearestOnSheet cut = *this;
        cut.agree_ = &agree;
        return cut;
    }

    [[nodiscard]] const MeshView& mesh() const { return mesh_; }

private:
    // As a share of the largest coordinate: a sum of three products of corners and barycentric
    // coordinates, on the caller's mesh and on the cleaned one, differs by less.
    static constexpr double rounding_share = 16 * std::numeric_limits<double>::epsilon();
    // A barycentric coordinate of a point on an edge, at most.
    static constexpr double on_edge = 1e-9;
    // The ball reaches farther than the start by this share, so that edges through the start meet
    // it.
    static constexpr double margin = 1e-9;

    [[nodiscard]] ClosestPoint closest(Index face, const Vec3& point) const {
        return closest_point_on_triangle(corners_of(mesh_, face), FaceId(face), point);
    }
    // The corner of a face at a point; 3: it has none there.
    [[nodiscard]] std::size_t corner_at(Index face, Index point) const {
        const Triangle& t = points_[face];
        return static_cast<std::size_t>(std::find(t.begin(), t.end(), point) - t.begin());
    }
    // Whether an edge of a face has more than two. Of faces that lie on each other one counts.
    [[nodiscard]] bool is_junction(Index face, std::size_t k) const {
        const Index a = points_[face][k], b = points_[face][(k + 1) % 3];
        const Index own = points_[face][(k + 2) % 3];
        Index other = own;
        for (const Index f : faces_.of(a)) {
            const Triangle& t = points_[f];
            if (corner_at(f, b) == 3) continue;
            const Index third = t[3 - corner_at(f, a) - corner_at(f, b)];
            if (third == own || third == other || third == a || third == b) continue;
            if (other != own) return true;
            other = third;
        }
        return false;
    }
    template <typename Visit>
    void for_each_neighbor(Index face, std::size_t k, const Visit& visit) const {
        const Index a = points_[face][k], b = points_[face][(k + 1) % 3];
        for (const Index other : faces_.of(a)) {
            const std::size_t at_b = corner_at(other, b);
            if (at_b == 3 || other == face) continue;
            if (agree_ != nullptr && !((*agree_)(face, k, other, corner_at(other, a)) &&
                                       (*agree_)(face, (k + 1) % 3, other, at_b))) {
                continue;
            }
            visit(other);
        }
    }
    template <typename Visit>
    void flood(const Vec3& point, double reach, Index start, SearchEnd end,
               const Visit& visit) const {
        std::vector<Index> waiting{start};
        std::unordered_set<Index> seen{start};
        while (!waiting.empty()) {
            const Index face = waiting.back();
            waiting.pop_back();
            if (!visit(face)) return;
            const Triangle& t = mesh_.triangles[face];
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 &a = mesh_.positions[t[k]], &b = mesh_.positions[t[(k + 1) % 3]];
                if (distance_to_segment(point, a, b) > reach) continue;
                if (end == SearchEnd::Junction && is_junction(face, k)) continue;
                for_each_neighbor(face, k, [&](Index neighbor) {
                    if (seen.insert(neighbor).second) waiting.push_back(neighbor);
                });
            }
        }
    }

    MeshView mesh_;
    std::vector<Triangle> points_;  // #F: for each corner the first vertex at its position.
    Groups faces_;                  // At each such vertex.
    double rounding_ = 0;           // Lengths up to this are rounding.
    const CornerAgreement* agree_ = nullptr;  // Null: seams do not count.
};

}  // namespace remesh::detail
