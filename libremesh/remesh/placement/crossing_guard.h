//! \file
//! Keeps the edits of a mesh from adding intersections. Private to remeshing.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "agvd/mesh/scale.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

//! Whether a segment passes through a triangle; touching it up to rounding does not count.
[[nodiscard]] inline bool passes_through(const Vec3& p, const Vec3& q,
                                         const std::array<Vec3, 3>& t) {
    constexpr double rounding = 1e-9;
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]), way = q - p;
    const double from = normal.dot(p - t[0]), to = normal.dot(q - t[0]);
    const double least = rounding * normal.norm() * way.norm();
    if (!(std::min(from, to) < -least && std::max(from, to) > least)) return false;
    std::array<double, 3> volume{};
    for (std::size_t k = 0; k < 3; ++k) volume[k] = way.dot((t[k] - p).cross(t[(k + 1) % 3] - p));
    return std::min({volume[0], volume[1], volume[2]}) >= 0 ||
           std::max({volume[0], volume[1], volume[2]}) <= 0;
}

//! Knows the pairs of faces that intersect, up to rounding, or are folds (is_fold). Others that
//! share an edge, or lie in one plane, do not count.
//! \tparam Mesh  such as EditedMesh.
template <typename Mesh>
class CrossingGuard {
public:
    //! \param mesh  outlives this. Cost: O(#faces).
    explicit CrossingGuard(const Mesh& mesh) : mesh_(mesh), cell_(mesh.mean_length()) {
        for (Index f = 0; f < mesh.num_faces(); ++f) insert(f);
        for (Index f = 0; f < mesh.num_faces(); ++f) {
            for (const Index other : faces_through(f)) pairs_.emplace(f, other);
        }
    }

    //! Compares the intersections of some faces with those that were taken over last.
    //! \param changed  each once, also those that are no longer there.
    //! \param most     how many more there may be.
    //! \return false if there are more than that. Cost: O(faces nearby).
    [[nodiscard]] bool accepts(std::span<const Index> changed, std::size_t most = 0) {
        before_.clear();
        now_.clear();
        for (const Index f : changed) {
            for (auto i = pairs_.lower_bound({f, 0}); i != pairs_.end() && i->first == f; ++i) {
                before_.insert(std::minmax(f, i->second));
            }
            if (mesh_.face(f).is_there) insert(f);
        }
        for (const Index f : changed) {
            if (!mesh_.face(f).is_there) continue;
            for (const Index other : faces_through(f)) now_.insert(std::minmax(f, other));
            if (now_.size() > before_.size() + most) return false;
        }
        return true;
    }
    //! After accepts(): how many more there are.
    [[nodiscard]] int growth() const {
        return static_cast<int>(now_.size()) - static_cast<int>(before_.size());
    }
    //! One that intersects a face, as was taken over last; no_index: none.
    [[nodiscard]] Index face_through(Index f) const {
        const auto found = pairs_.lower_bound({f, 0});
        return found != pairs_.end() && found->first == f ? found->second : no_index;
    }
    //! Takes over what accepts() has found.
    void take_over() {
        for (const auto& [f, g] : before_) {
            pairs_.erase({f, g});
            pairs_.erase({g, f});
        }
        for (const auto& [f, g] : now_) {
            pairs_.emplace(f, g);
            pairs_.emplace(g, f);
        }
    }

private:
    using Pairs = std::set<std::pair<Index, Index>>;
    // Faces over more cells are listed apart.
    static constexpr double most_cells = 64;

    // Calls each(key) for the cells of a box. False if there are too many.
    template <typename Each>
    bool for_each_cell(const MeshBox& box, const Each& each) const {
        const Eigen::Array3d low = (box.low.array() / cell_).floor(),
                             high = (box.high.array() / cell_).floor();
        if (!((high - low + 1).prod() <= most_cells)) return false;
        const auto first = low.cast<std::int64_t>().eval(), last = high.cast<std::int64_t>().eval();
        for (std::int64_t x = first[0]; x <= last[0]; ++x) {
            for (std::int64_t y = first[1]; y <= last[1]; ++y) {
                for (std::int64_t z = first[2]; z <= last[2]; ++z) {
                    // Cells may share a key: that costs time only.
                    each(x + 1'000'003 * y + 998'244'353'011 * z);
                }
            }
        }
        return true;
    }
    // Faces stay where they once were listed: what they are now is tested.
    void insert(Index f) {
        const MeshBox box = mesh_.box_of(f);
        const auto add = [&](std::vector<Index>& list) {
            if (std::find(list.begin(), list.end(), f) == list.end()) list.push_back(f);
        };
        if (!for_each_cell(box, [&](std::int64_t key) { add(faces_[key]); })) add(large_);
    }
    // Faces that intersect one, each once.
    [[nodiscard]] std::vector<Index> faces_through(Index f) const {
        const MeshBox box = mesh_.box_of(f);
        std::vector<Index> found;
        const auto add_if_near = [&](Index g) {
            const bool is_other = g != f && g < mesh_.num_faces() && mesh_.face(g).is_there;
            if (is_other && box.meets(mesh_.box_of(g))) found.push_back(g);
        };
        const bool is_small = for_each_cell(box, [&](std::int64_t key) {
            const auto cell = faces_.find(key);
            if (cell != faces_.end()) std::ranges::for_each(cell->second, add_if_near);
        });
        if (is_small) {
            std::ranges::for_each(large_, add_if_near);
        } else {
            for (Index g = 0; g < mesh_.num_faces(); ++g) add_if_near(g);
        }
        found = distinct(std::move(found));
        std::erase_if(found, [&](Index g) { return !do_cross(f, g); });
        return found;
    }
    [[nodiscard]] bool do_cross(Index f, Index g) const {
        const auto is_common = [&](Index v) { return mesh_.has_corner(g, v); };
        const auto num_common = std::ranges::count_if(mesh_.face(f).corner, is_common);
        if (num_common == 2) return is_fold(mesh_.normal_of(f), mesh_.normal_of(g));
        return num_common < 2 && (has_edge_through(f, g) || has_edge_through(g, f));
    }
    // Whether an edge of f that has no corner of g passes through g.
    [[nodiscard]] bool has_edge_through(Index f, Index g) const {
        const Triangle& t = mesh_.face(f).corner;
        const std::array<Vec3, 3> corners = mesh_.corners_of(g);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index from = t[k], to = t[(k + 1) % 3];
            if (!mesh_.has_corner(g, from) && !mesh_.has_corner(g, to) &&
                passes_through(mesh_.at(from), mesh_.at(to), corners)) {
                return true;
            }
        }
        return false;
    }

    const Mesh& mesh_;
    const double cell_;
    std::unordered_map<std::int64_t, std::vector<Index>> faces_;  // By cell.
    std::vector<Index> large_;
    Pairs pairs_;         // Each in both orders.
    Pairs before_, now_;  // Of the faces that accepts() compared; each once.
};

}  // namespace remesh::detail
