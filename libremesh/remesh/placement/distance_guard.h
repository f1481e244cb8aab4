//! \file
//! Keeps the edits of a mesh from leaving the surface. Private to repair_shape().
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {

//! Knows for samples of the surface the nearest faces of a mesh, among those of the same part:
//! parts may touch or overlap.
class DistanceGuard {
public:
    //! \param mesh  outlives this.
    //! \param surface  whole, with the faces that the vertices of the mesh lie in.
    //! Cost: O(#surface + #faces log #faces).
    DistanceGuard(const EditedMesh& mesh, const Surface& surface)
        : mesh_(mesh), samples_at_(mesh.num_faces()) {
        const FaceLabels parts = label_components(surface.twin);
        add_samples(surface, parts.of_face);
        std::vector<TriangleMesh> of_part(parts.count);
        std::vector<std::vector<Index>> faces(parts.count);
        for (Index f = 0; f < mesh.num_faces(); ++f) {
            const Triangle& t = mesh.face(f).corner;
            const Index part = parts.of_face[mesh.face_of_surface(t[0]).value()];
            auto& [positions, triangles] = of_part[part];
            const auto first = static_cast<Index>(positions.size());
            for (const Vec3& at : mesh.corners_of(f)) positions.push_back(at);
            triangles.push_back({first, first + 1, first + 2});
            faces[part].push_back(f);
        }
        std::erase_if(samples_, [&](const Sample& s) { return faces[s.part].empty(); });
        std::stable_sort(samples_.begin(), samples_.end(),
                         [](const Sample& s, const Sample& t) { return s.part < t.part; });
        std::optional<ClosestPointTree> tree;
        for (Index i = 0; i < samples_.size(); ++i) {
            Sample& sample = samples_[i];
            if (i == 0 || samples_[i - 1].part != sample.part) {
                tree.emplace(of_part[sample.part].view());
            }
            const ClosestPoint nearest = tree->query(sample.at);
            sample.face = faces[sample.part][nearest.point.face.value()];
            sample.distance_sq = nearest.distance_sq;
            samples_at_[sample.face].push_back(i);
        }
    }

    //! Compares the distances of the samples of some faces with those that were taken over last.
    //! \param changed  each once, also those that are no longer there.
    //! \param gain  of shape quality, in all.
    //! \return false if they have grown by more than that is worth.
    //! Cost: O(#samples #changed).
    [[nodiscard]] bool accepts(std::span<const Index> changed, double gain) {
        found_.clear();
        boxed_.clear();
        for (const Index f : changed) {
            if (mesh_.face(f).is_there) boxed_.push_back({f, mesh_.corners_of(f), mesh_.box_of(f)});
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
        Index part;  // Of the surface.
        Index face = no_index;
        double distance_sq = 0;
    };
    struct Found {
        Index sample, face;
        double distance_sq;
    };
    struct BoxedFace {
        Index face;
        std::array<Vec3, 3> corners;
        MeshBox box;
    };
    static double squared(double x) { return x * x; }

    // Points that divide faces evenly, and vertices: tips are among these.
    void add_samples(const Surface& surface, std::span<const Index> parts) {
        double area = 0;
        std::vector<double> around(surface.num_vertices(), 0);
        std::vector<Index> part_of(surface.num_vertices(), 0);
        for (Index f = 0; f < surface.num_faces(); ++f) area += area_of(surface, f);
        const double count = samples_for_each * mesh_.num_vertices();
        double due = 0;  // Samples that the faces so far should have.
        for (Index f = 0; f < surface.num_faces(); ++f) {
            const double own = area_of(surface, f);
            for (const Index v : surface.mesh.triangles[f]) {
                around[v] += own / 3;
                part_of[v] = parts[f];
            }
            const double before = std::floor(due);
            due += count * own / area;
            if (!(std::floor(due) > before)) continue;
            const auto rows = static_cast<int>(std::ceil(std::sqrt(std::floor(due) - before)));
            const double weight = area / count * (std::floor(due) - before) / (rows * rows);
            add_in_face(surface, f, parts[f], rows, weight);
        }
        const auto stride = static_cast<Index>(1 + surface.num_vertices() / count);
        for (Index v = 0; v < surface.num_vertices(); v += stride) {
            samples_.push_back({surface.mesh.positions[v], stride * around[v], part_of[v]});
        }
    }
    // The middles of rows^2 equal triangles.
    void add_in_face(const Surface& surface, Index f, Index part, int rows, double weight) {
        const auto& p = surface.mesh.positions;
        const auto& [a, b, c] = surface.mesh.triangles[f];
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; i + j < rows; ++j) {
                for (int up = 0; up < (i + j + 1 < rows ? 2 : 1); ++up) {
                    const double u = (i + (1 + up) / 3.0) / rows, v = (j + (1 + up) / 3.0) / rows;
                    const Vec3 at = p[a] + u * (p[b] - p[a]) + v * (p[c] - p[a]);
                    samples_.push_back({at, weight, part});
                }
            }
        }
    }
    static double area_of(const Surface& surface, Index f) {
        const auto& p = surface.mesh.positions;
        const auto& [a, b, c] = surface.mesh.triangles[f];
        return (p[b] - p[a]).cross(p[c] - p[a]).norm() / 2;
    }
    // The nearest of the faces in boxed_.
    [[nodiscard]] Found find_nearest(Index sample) const {
        const Vec3& at = samples_[sample].at;
        Found nearest{sample, no_index, std::numeric_limits<double>::infinity()};
        for (const auto& [face, corners, box] : boxed_) {
            const double least = (at - at.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
            if (least >= nearest.distance_sq) continue;
            const double distance_sq =
                closest_point_on_triangle(corners, FaceId(face), at).distance_sq;
            if (distance_sq < nearest.distance_sq) nearest = {sample, face, distance_sq};
        }
        return nearest;
    }

    const EditedMesh& mesh_;
    std::vector<Sample> samples_;
    std::vector<std::vector<Index>> samples_at_;  // By face: the samples nearest to it.
    std::vector<Found> found_;
    std::vector<BoxedFace> boxed_;
};

}  // namespace remesh::detail
