//! \file
//! Keeps the edits of a mesh from leaving the surface. Private to repair_shape().
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! Knows for samples of the surface the nearest faces of a mesh.
class DistanceGuard {
public:
    //! \param mesh  outlives this. Cost: O(#surface + #faces log #faces).
    DistanceGuard(const EditedMesh& mesh, const Surface& surface)
        : mesh_(mesh), samples_at_(mesh.num_faces()) {
        add_samples(surface);
        TriangleMesh copy;
        for (Index v = 0; v < mesh.num_vertices(); ++v) copy.positions.push_back(mesh.at(v));
        for (Index f = 0; f < mesh.num_faces(); ++f) copy.triangles.push_back(mesh.face(f).corner);
        const ClosestPointTree tree(copy.view());
        for (Index i = 0; i < samples_.size(); ++i) {
            const ClosestPoint nearest = tree.query(samples_[i].at);
            samples_[i].face = nearest.point.face.value();
            samples_[i].distance_sq = nearest.distance_sq;
            samples_at_[samples_[i].face].push_back(i);
        }
    }

    //! Compares the distances of the samples of some faces with those that were taken over last.
    //! \param changed  each once, also those that are no longer there.
    //! \param gain  of shape quality, in all.
    //! \return false if they have grown by more than that is worth.
    //! Cost: O(#samples #changed).
    [[nodiscard]] bool accepts(std::span<const Index> changed, double gain) {
        found_.clear();
        boxes_.clear();
        for (const Index f : changed) {
            if (mesh_.face(f).is_there) boxes_.push_back({f, mesh_.corners_of(f)});
        }
        double sum = 0, most_before = 0, most_now = 0;
        for (const Index f : changed) {
            if (f >= samples_at_.size()) continue;
            for (const Index i : samples_at_[f]) {
                const Sample& sample = samples_[i];
                const Found now = find_nearest(i);
                found_.push_back(now);
                sum += sample.weight * (now.distance_sq - sample.distance_sq);
                most_before = std::max(most_before, sample.distance_sq);
                most_now = std::max(most_now, now.distance_sq);
            }
        }
        const double length_sq = squared(mesh_.mean_length());
        return sum * cost <= gain * squared(length_sq) &&
               most_now <= std::max(most_before, squared(largest) * length_sq);
    }
    //! Takes over what accepts() has found.
    void take_over() {
        samples_at_.resize(mesh_.num_faces());
        for (const Found& now : found_) samples_at_[samples_[now.sample].face].clear();
        for (const Found& now : found_) {
            samples_[now.sample].face = now.face;
            samples_[now.sample].distance_sq = now.distance_sq;
            samples_at_[now.face].push_back(now.sample);
        }
    }

private:
    // Of quality, for a growth of squared distances by the fourth power of a mean edge length.
    static constexpr double cost = 2;
    // In mean edge lengths: no sample gets farther than that.
    static constexpr double largest = 0.4;
    // For each vertex of the mesh, at most: inside faces, and vertices of the surface.
    static constexpr double samples_for_each = 4;

    struct Sample {
        Vec3 at;
        double weight;
        Index face = no_index;
        double distance_sq = 0;
    };
    struct Found {
        Index sample, face;
        double distance_sq;
    };
    struct FaceBox {
        FaceBox(Index of, const std::array<Vec3, 3>& at)
            : face(of),
              corners(at),
              low(at[0].cwiseMin(at[1]).cwiseMin(at[2])),
              high(at[0].cwiseMax(at[1]).cwiseMax(at[2])) {}
        Index face;
        std::array<Vec3, 3> corners;
        Vec3 low, high;
    };
    static double squared(double x) { return x * x; }

    // Points that divide faces evenly, and vertices: tips are among these.
    void add_samples(const Surface& surface) {
        double area = 0;
        std::vector<double> around(surface.num_vertices(), 0);
        for (Index f = 0; f < surface.num_faces(); ++f) area += area_of(surface, f);
        const double count = samples_for_each * mesh_.num_vertices();
        double due = 0;  // Samples that the faces so far should have.
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const double own = area_of(surface, f);
            for (const Index v : surface.mesh.triangles[f]) around[v] += own / 3;
            const double before = std::floor(due);
            due += count * own / area;
            if (!(std::floor(due) > before)) continue;
            const auto parts = static_cast<int>(std::ceil(std::sqrt(std::floor(due) - before)));
            add_in_face(surface, f, parts,
                        area / count * (std::floor(due) - before) / (parts * parts));
        }
        const auto stride = static_cast<Index>(1 + surface.num_vertices() / count);
        for (Index v = 0; v < surface.num_vertices(); v += stride) {
            samples_.push_back({surface.mesh.positions[v], stride * around[v]});
        }
    }
    // The middles of parts^2 equal triangles.
    void add_in_face(const Surface& surface, Index f, int parts, double weight) {
        const auto& p = surface.mesh.positions;
        const auto& [a, b, c] = surface.mesh.triangles[f];
        for (int i = 0; i < parts; ++i) {
            for (int j = 0; i + j < parts; ++j) {
                for (int up = 0; up < (i + j + 1 < parts ? 2 : 1); ++up) {
                    const double u = (i + (1 + up) / 3.0) / parts, v = (j + (1 + up) / 3.0) / parts;
                    samples_.push_back({p[a] + u * (p[b] - p[a]) + v * (p[c] - p[a]), weight});
                }
            }
        }
    }
    static double area_of(const Surface& surface, Index f) {
        const auto& p = surface.mesh.positions;
        const auto& [a, b, c] = surface.mesh.triangles[f];
        return (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    // The nearest of the faces in boxes_.
    [[nodiscard]] Found find_nearest(Index sample) const {
        const Vec3& at = samples_[sample].at;
        Found nearest{sample, no_index, std::numeric_limits<double>::infinity()};
        for (const FaceBox& box : boxes_) {
            const double least = (at - at.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
            if (least >= nearest.distance_sq) continue;
            const double distance_sq =
                closest_point_on_triangle(box.corners, FaceId(box.face), at).distance_sq;
            if (distance_sq < nearest.distance_sq) nearest = {sample, box.face, distance_sq};
        }
        return nearest;
    }

    const EditedMesh& mesh_;
    std::vector<Sample> samples_;
    std::vector<std::vector<Index>> samples_at_;  // By face: the samples nearest to it.
    std::vector<Found> found_;
    std::vector<FaceBox> boxes_;
};

}  // namespace remesh::detail
