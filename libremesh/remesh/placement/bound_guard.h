//! \file
//! Distances between an edited mesh and an input, both ways. Private to keep_distance().
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! Where a mesh and an input are apart.
struct Gap {
    Vec3 at = Vec3::Zero();   //!< On the mesh.
    Vec3 way = Vec3::Zero();  //!< From there to the input.
    double distance = -1;     //!< Its length; below 0: no point was looked at.

    //! Keeps the larger one of this and of another one.
    void widen(const Vec3& on_mesh, const Vec3& on_input) {
        const Vec3 between = on_input - on_mesh;
        const double length = between.norm();
        if (length > distance) *this = {on_mesh, between, length};
    }
};

//! Knows for each face where it is farthest from the input, at points of the face and at the points
//! of the input that are nearest to it. After an edit the latter are compared with the edited faces
//! only: the distances known are never too small.
class BoundGuard {
public:
    //! \param mesh, input, ticker  outlive this.
    //! \param points  of the input.
    //! \param least   mesh units: smaller gaps count as so large, as nothing depends on them.
    //! Cost: O((#faces + #points) log n).
    BoundGuard(const EditedMesh& mesh, const ClosestPointTree& input, std::span<const Vec3> points,
               double least, Ticker& ticker)
        : mesh_(mesh),
          input_(input),
          ticker_(ticker),
          least_(least),
          gap_(mesh.num_faces()),
          points_at_(mesh.num_faces()) {
        TriangleMesh faces;
        for (Index f = 0; f < mesh.num_faces(); ++f) {
            const auto first = static_cast<Index>(faces.positions.size());
            for (const Vec3& at : mesh.corners_of(f)) faces.positions.push_back(at);
            faces.triangles.push_back({first, first + 1, first + 2});
            gap_[f] = gap_of_face(f, infinity);
        }
        const ClosestPointTree tree(faces.view());
        for (const Vec3& point : points) {
            ticker.tick(query_steps);
            const ClosestPoint nearest = tree.query(point);
            const Index f = nearest.point.face.value();
            gap_[f].widen(nearest.position, point);
            points_at_[f].push_back(point);
        }
    }

    //! The largest gap of a face.
    [[nodiscard]] const Gap& gap_at(Index f) const { return gap_[f]; }
    //! A larger gap that is known, until the face changes.
    void widen(Index f, const Vec3& on_mesh, const Vec3& on_input) {
        gap_[f].widen(on_mesh, on_input);
    }
    //! One more point of the input, with its nearest face and the point there.
    void add_point(Index f, const Vec3& on_mesh, const Vec3& point) {
        gap_[f].widen(on_mesh, point);
        points_at_[f].push_back(point);
    }

    //! Measures changed faces.
    //! \param changed  each once, also those that are no longer there.
    //! \return the largest gap and its face; the first one above `most` if there is one.
    [[nodiscard]] std::pair<Index, Gap> measure(std::span<const Index> changed, double most) {
        found_.clear();
        points_.clear();
        for (const Index f : changed) {
            if (mesh_.face(f).is_there) found_.push_back({f, mesh_.corners_of(f), {}, {}});
        }
        for (Found& f : found_) {
            for (const Vec3& corner : f.corners) f.box.add(corner);
        }
        std::pair<Index, Gap> largest{no_index, {}};
        for (const Index f : changed) {
            if (f >= points_at_.size()) continue;
            for (const Vec3& point : points_at_[f]) {
                const Found* nearest = assign(point);
                if (nearest == nullptr) return {f, {point, Vec3::Zero(), infinity}};
                if (nearest->gap.distance > most) return {nearest->face, nearest->gap};
            }
        }
        for (Found& f : found_) {
            const Gap gap = gap_of_face(f.face, most);
            if (gap.distance > f.gap.distance) f.gap = gap;
            if (f.gap.distance > largest.second.distance) largest = {f.face, f.gap};
            if (gap.distance > most) break;
        }
        return largest;
    }
    //! Takes over what measure() has found, of the same changes.
    void take_over(std::span<const Index> changed) {
        points_at_.resize(mesh_.num_faces());
        gap_.resize(mesh_.num_faces());
        for (const Index f : changed) {
            points_at_[f].clear();
            gap_[f] = {};
        }
        for (const Found& f : found_) gap_[f.face] = f.gap;
        for (const auto& [f, point] : points_) points_at_[f].push_back(point);
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::size_t query_steps = 64;
    // A face is measured at its corners and at the points between that divide its sides so often.
    static constexpr int rows = 4;

    struct Found {
        Index face;
        std::array<Vec3, 3> corners;
        MeshBox box;
        Gap gap;
    };

    // At points of the face. Ends early above `most`.
    [[nodiscard]] Gap gap_of_face(Index f, double most) {
        if (f >= measured_.size()) measured_.resize(f + 1);
        auto& [corners, gap] = measured_[f];
        if (gap.distance >= 0 && corners == mesh_.corners_of(f)) return gap;
        corners = mesh_.corners_of(f);
        const auto& [a, b, c] = corners;
        gap = {};
        for (int i = 0; i <= rows; ++i) {
            for (int j = 0; i + j <= rows; ++j) {
                ticker_.tick(query_steps);
                const Vec3 at = (i * a + j * b + (rows - i - j) * c) / rows;
                if (input_.is_within(at, least_)) {
                    gap.distance = std::max(gap.distance, least_);
                    continue;
                }
                gap.widen(at, input_.query(at).position);
                if (gap.distance > most) return std::exchange(gap, Gap{});
            }
        }
        return gap;
    }
    // Finds the nearest changed face of a point; null: there is none.
    Found* assign(const Vec3& point) {
        ClosestPoint closest;
        closest.distance_sq = infinity;
        Found* nearest = nullptr;
        for (Found& f : found_) {
            const double least =
                (point - point.cwiseMax(f.box.low).cwiseMin(f.box.high)).squaredNorm();
            if (least >= closest.distance_sq) continue;
            const ClosestPoint here = closest_point_on_triangle(f.corners, FaceId(f.face), point);
            if (here.distance_sq >= closest.distance_sq) continue;
            closest = here;
            nearest = &f;
        }
        if (nearest == nullptr) return nullptr;
        nearest->gap.widen(closest.position, point);
        points_.emplace_back(nearest->face, point);
        return nearest;
    }

    const EditedMesh& mesh_;
    const ClosestPointTree& input_;
    Ticker& ticker_;
    const double least_;
    std::vector<Gap> gap_;                      // By face: the largest.
    std::vector<std::vector<Vec3>> points_at_;  // By face: the points nearest to it.
    // By face: what gap_of_face() has found last, and for which corners.
    std::vector<std::pair<std::array<Vec3, 3>, Gap>> measured_;
    // What measure() has found.
    std::vector<Found> found_;
    std::vector<std::pair<Index, Vec3>> points_;
};

}  // namespace remesh::detail
