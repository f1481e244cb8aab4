//! \file
//! Distances between an edited mesh and an input, both ways. Private to keep_distance().
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/placement/changed_faces.h"
#include "remesh/placement/far_points.h"

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
        const std::vector<Index> faces = mesh.faces();
        for (const Index f : faces) gap_[f] = gap_of_face(f, infinity);
        const ClosestPointTree tree(mesh_of(mesh, faces));
        for (const Vec3& point : points) {
            ticker.tick(query_steps);
            const ClosestPoint nearest = tree.query(point);
            add({faces[nearest.point.face.value()], nearest.position, point, true});
        }
    }

    //! The largest gap of a face.
    [[nodiscard]] const Gap& gap_at(Index f) const { return gap_[f]; }
    //! A gap that was found elsewhere. One of a point of a face is known until the face changes, a
    //! point of the input is compared with edited faces from now on.
    void add(const FarPair& far) {
        gap_[far.face].widen(far.on_mesh, far.on_input);
        if (far.is_of_input) points_at_[far.face].push_back(far.on_input);
    }

    //! Measures changed faces.
    //! \param changed  each once, also those that are no longer there.
    //! \return the largest gap and its face; the first one above `most` if there is one.
    [[nodiscard]] std::pair<Index, Gap> measure(std::span<const Index> changed, double most) {
        faces_.set(mesh_, changed);
        points_.clear();
        now_.resize(mesh_.num_faces());
        for (const Index f : changed) now_[f] = {};
        for (const Index f : changed) {
            if (f >= points_at_.size()) continue;
            for (const Vec3& point : points_at_[f]) {
                const ClosestPoint nearest =
                    faces_.nearest(point, [](const auto&) { return true; });
                if (!nearest.point.face.is_valid()) return {f, {point, Vec3::Zero(), infinity}};
                const Index face = nearest.point.face.value();
                points_.emplace_back(face, point);
                now_[face].widen(nearest.position, point);
                if (now_[face].distance > most) return {face, now_[face]};
            }
        }
        std::pair<Index, Gap> largest{no_index, {}};
        for (const ChangedFaces::Face& face : faces_.faces()) {
            const Index f = face.number;
            const Gap gap = gap_of_face(f, most);
            if (gap.distance > now_[f].distance) now_[f] = gap;
            if (now_[f].distance > largest.second.distance) largest = {f, now_[f]};
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
            gap_[f] = now_[f];
        }
        for (const auto& [f, point] : points_) points_at_[f].push_back(point);
    }

private:
    static constexpr std::size_t query_steps = 64;
    // A face is measured at its corners and at the points between that divide its sides so often.
    static constexpr int rows = 4;

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

    const EditedMesh& mesh_;
    const ClosestPointTree& input_;
    Ticker& ticker_;
    const double least_;
    std::vector<Gap> gap_;                      // By face: the largest.
    std::vector<std::vector<Vec3>> points_at_;  // By face: the points nearest to it.
    // By face: what gap_of_face() has found last, and for which corners.
    std::vector<std::pair<std::array<Vec3, 3>, Gap>> measured_;
    // What measure() has found.
    ChangedFaces faces_;
    std::vector<Gap> now_;                        // By face: of those changed.
    std::vector<std::pair<Index, Vec3>> points_;  // With the faces nearest to them.
};

}  // namespace remesh::detail
