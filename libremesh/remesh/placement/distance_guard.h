//! \file
//! Keeps the edits of a mesh from leaving the surface. Private to repair_shape().
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "remesh/placement/changed_faces.h"

namespace remesh::detail {

//! A direction of an axis. Faces look to a side if their normal does, at least a little.
struct Side {
    int axis = 0;
    bool is_against = false;

    //! The one that a normal is nearest to.
    [[nodiscard]] static Side of(const Vec3& normal) {
        Side side;
        normal.cwiseAbs().maxCoeff(&side.axis);
        side.is_against = normal[side.axis] < 0;
        return side;
    }
    [[nodiscard]] bool sees(const Vec3& normal) const {
        return is_against ? normal[axis] < 0 : normal[axis] > 0;
    }
    [[nodiscard]] auto operator<=>(const Side&) const = default;
};

//! Knows for samples of the surface the nearest faces of a mesh. These are of the same part, as
//! parts may touch or overlap, and look to the same side, as the far side of a thin wall may be
//! nearer; where no face does, to any side.
class DistanceGuard {
public:
    //! \param mesh  outlives this.
    //! \param surface  whole, with the faces that the vertices of the mesh lie in.
    //! \param near     its faces near the mesh, if it is a part of one; empty: all.
    //! Cost: O(#surface + #faces log #faces).
    DistanceGuard(const EditedMesh& mesh, const Surface& surface, std::span<const Index> near = {})
        : mesh_(mesh), samples_at_(mesh.num_faces()) {
        const FaceLabels parts = label_components(surface.twin);
        add_samples(surface, near, parts.of_face);
        std::vector<std::vector<Index>> faces(parts.count);
        for (const Index f : mesh.faces()) {
            const Index v = mesh.face(f).corner[0];
            faces[parts.of_face[mesh.face_of_surface(v).value()]].push_back(f);
        }
        std::erase_if(samples_, [&](const Sample& s) { return faces[s.part].empty(); });
        std::stable_sort(samples_.begin(), samples_.end(), [](const Sample& s, const Sample& t) {
            return std::tie(s.part, s.side) < std::tie(t.part, t.side);
        });
        for (Index i = 0; i < samples_.size();) i = assign_like(i, faces[samples_[i].part]);
    }

    //! From now on distances may grow beyond what edits are worth, by a small share in all: for the
    //! few triangles that are still bad.
    void open_budget() {
        for (const Sample& s : samples_) budget_ += share_of_budget * s.weight * s.distance_sq;
    }

    //! Compares the distances of the samples of some faces with those that were taken over last.
    //! \param changed  each once, also those that are no longer there.
    //! \param worth  of the gain of shape quality, see ShapeGain.
    //! \return false if they have grown by more than that is worth.
    //! Cost: O(#samples #changed).
    [[nodiscard]] bool accepts(std::span<const Index> changed, double worth) {
        found_.clear();
        changed_.set(mesh_, changed);
        double growth = 0, most_before = 0, most_now = 0;
        for (const Index f : changed) {
            if (f >= samples_at_.size()) continue;
            for (const Index i : samples_at_[f]) {
                const Sample& sample = samples_[i];
                const Found now = find_nearest(i);
                found_.push_back(now);
                growth += sample.weight * (now.distance_sq - sample.distance_sq);
                most_before = std::max(most_before, sample.distance_sq);
                most_now = std::max(most_now, now.distance_sq);
            }
        }
        const double length_sq = squared(mesh_.mean_length());
        if (most_now > std::max(most_before, squared(largest) * length_sq)) return false;
        const double paid = price * worth * squared(length_sq);
        from_budget_ = std::max(growth - paid, 0.0);
        return growth <= paid || (growth <= most_over * paid && from_budget_ <= budget_);
    }
    //! Takes over what accepts() has found.
    void take_over() {
        budget_ -= from_budget_;
        samples_at_.resize(mesh_.num_faces());
        for (const Found& now : found_) samples_at_[samples_[now.sample].face].clear();
        for (const Found& now : found_) {
            samples_[now.sample].face = now.face;
            samples_[now.sample].distance_sq = now.distance_sq;
            samples_at_[now.face].push_back(now.sample);
        }
    }

private:
    // Growth of the squared distances for a worth of 1, by the fourth power of a mean edge length.
    static constexpr double price = 1.25;
    // Out of the budget, a share of all squared distances, an edit gets so many times its worth.
    static constexpr double most_over = 30, share_of_budget = 0.01;
    // In mean edge lengths: no sample gets farther than that.
    static constexpr double largest = 0.4;
    // For each vertex of the mesh, at most: inside faces, and vertices of the surface.
    static constexpr double samples_for_each = 8;

    struct Sample {
        Vec3 at;
        double weight;
        Index part;  // Of the surface.
        Side side;
        Index face = no_index;
        double distance_sq = 0;
    };
    struct Found {
        Index sample, face;
        double distance_sq;
    };
    static double squared(double x) { return x * x; }

    // Points that divide faces evenly, and vertices: tips are among these.
    void add_samples(const Surface& surface, std::span<const Index> near,
                     std::span<const Index> parts) {
        const auto& p = surface.mesh.positions;
        const auto for_each_face = [&](const auto& each) {
            for (const Index f : near) each(f);
            for (Index f = 0; near.empty() && f < surface.num_faces(); ++f) each(f);
        };
        double area = 0;
        for_each_face([&](Index f) { area += face_area(surface, f); });
        std::vector<double> around(surface.num_vertices(), 0);
        std::vector<Vec3> normal_at(surface.num_vertices(), Vec3::Zero());
        std::vector<Index> part_of(surface.num_vertices(), 0);
        double count = samples_for_each * mesh_.num_vertices();
        // Faces near a part may go far beyond it: samples are as dense there as on the part.
        if (!near.empty()) count *= area / measure_part();
        double due = 0;  // Samples that the faces so far should have.
        for_each_face([&](Index f) {
            const auto& [a, b, c] = surface.mesh.triangles[f];
            const double own = face_area(surface, f);
            const Vec3 normal = doubled_normal(p, surface.mesh.triangles[f]);
            for (const Index v : {a, b, c}) {
                around[v] += own / 3;
                normal_at[v] += normal;
                part_of[v] = parts[f];
            }
            const double before = std::floor(due);
            due += count * own / area;
            if (!(std::floor(due) > before)) return;
            const auto rows = static_cast<int>(std::ceil(std::sqrt(std::floor(due) - before)));
            const double weight = area / count * (std::floor(due) - before) / (rows * rows);
            add_in_face({p[a], p[b], p[c]}, rows, {{}, weight, parts[f], Side::of(normal)});
        });
        const auto num_near = static_cast<double>(
            std::count_if(around.begin(), around.end(), [](double own) { return own > 0; }));
        const auto stride = static_cast<Index>(1 + num_near / count);
        for (Index v = 0, rank = 0; v < surface.num_vertices(); ++v) {
            if (!(around[v] > 0) || rank++ % stride != 0) continue;
            add({p[v], stride * around[v], part_of[v], Side::of(normal_at[v])});
        }
    }
    // Finds where samples tell anything.
    // \return the area of the mesh.
    double measure_part() {
        const Vec3 room = Vec3::Constant(largest * mesh_.mean_length());
        box_ = {};
        double area = 0;
        for (const Index f : mesh_.faces()) {
            area += mesh_.normal_of(f).norm() / 2;
            box_.add(mesh_.box_of(f));
        }
        box_ = {box_.low - room, box_.high + room};
        return area;
    }
    void add(const Sample& sample) {
        const bool is_near = (sample.at.array() >= box_.low.array()).all() &&
                             (sample.at.array() <= box_.high.array()).all();
        if (is_near) samples_.push_back(sample);
    }
    // The middles of rows^2 equal triangles.
    void add_in_face(const std::array<Vec3, 3>& corners, int rows, Sample sample) {
        const auto& [a, b, c] = corners;
        for (int i = 0; i < rows; ++i) {
            for (int j = 0; i + j < rows; ++j) {
                for (int up = 0; up < (i + j + 1 < rows ? 2 : 1); ++up) {
                    const double u = (i + (1 + up) / 3.0) / rows, v = (j + (1 + up) / 3.0) / rows;
                    sample.at = a + u * (b - a) + v * (c - a);
                    add(sample);
                }
            }
        }
    }
    // Finds the nearest faces for the samples from `begin` on, up to one of another part or side.
    // \param faces  of that part.
    // \return the end.
    Index assign_like(Index begin, std::vector<Index> faces) {
        const Index part = samples_[begin].part;
        const Side side = samples_[begin].side;
        const auto is_seen = [&](Index f) { return side.sees(mesh_.normal_of(f)); };
        if (std::any_of(faces.begin(), faces.end(), is_seen)) {
            std::erase_if(faces, [&](Index f) { return !is_seen(f); });
        }
        const ClosestPointTree tree(mesh_of(mesh_, faces));
        Index i = begin, hint = 0;
        for (; i < samples_.size(); ++i) {
            Sample& sample = samples_[i];
            if (sample.part != part || sample.side != side) break;
            const ClosestPoint nearest = tree.query(sample.at, hint);
            if (is_at_fixed(faces[nearest.point.face.value()], nearest.point.barycentric)) continue;
            sample.face = faces[nearest.point.face.value()];
            sample.distance_sq = nearest.distance_sq;
            samples_at_[sample.face].push_back(i);
        }
        return i;
    }
    // Whether a point lies on an edge between vertices that stay, or at one. The mesh may end
    // there: of surface beyond it the distance tells nothing.
    [[nodiscard]] bool is_at_fixed(Index f, const std::array<double, 3>& weights) const {
        bool is_inside = true;
        for (std::size_t k = 0; k < 3; ++k) {
            if (weights[k] == 0) {
                is_inside = false;
            } else if (mesh_.mobility(mesh_.face(f).corner[k]) != Mobility::Fixed) {
                return false;
            }
        }
        return !is_inside;
    }
    // The nearest of the changed faces.
    [[nodiscard]] Found find_nearest(Index sample) const {
        const auto is_seen = [&](const ChangedFaces::Face& f) {
            return samples_[sample].side.sees(f.normal);
        };
        const bool is_any_seen = std::ranges::any_of(changed_.faces(), is_seen);
        const ClosestPoint nearest = changed_.nearest(
            samples_[sample].at,
            [&](const ChangedFaces::Face& f) { return !is_any_seen || is_seen(f); });
        return {sample, nearest.point.face.value(), nearest.distance_sq};
    }

    const EditedMesh& mesh_;
    MeshBox box_{Vec3::Constant(-infinity), Vec3::Constant(infinity)};  // Of samples.
    double budget_ = 0;
    std::vector<Sample> samples_;
    std::vector<std::vector<Index>> samples_at_;  // By face: the samples nearest to it.
    // What accepts() has found.
    double from_budget_ = 0;
    std::vector<Found> found_;
    ChangedFaces changed_;
};

}  // namespace remesh::detail
