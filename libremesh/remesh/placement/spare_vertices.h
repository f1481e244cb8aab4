//! \file
//! What edits of a mesh must keep: distance, intersections, and the number of vertices. Private to
//! repair_shape() and repair_crossings().
#pragma once

#include <algorithm>
#include <compare>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/distance_guard.h"
#include "remesh/placement/shape_steps.h"

namespace remesh::detail {

// What a change elsewhere, for the count, is worth: see ShapeGain.
inline constexpr double worth_elsewhere = 4e-4;

// The changes that may stay: those that neither add intersections nor leave the surface.
class EditGuard {
public:
    EditGuard(const EditedMesh& mesh, const Surface& surface, std::span<const Index> faces)
        : mesh_(mesh), crossings_(mesh), distances_(mesh, surface, faces) {}

    // \param most  how many more pairs of faces may intersect.
    [[nodiscard]] bool accepts(const EditedMesh::Mark& mark, double worth, std::size_t most = 0) {
        const std::vector<Index> changed = mesh_.changed_since(mark);
        return distances_.accepts(changed, worth) && crossings_.accepts(changed, most);
    }
    // Whether no more pairs of faces than `most` are added; see growth().
    [[nodiscard]] bool adds_few_pairs(const EditedMesh::Mark& mark, std::size_t most) {
        return crossings_.accepts(mesh_.changed_since(mark), most);
    }
    // Also takes over the changes; they must not be taken back later.
    [[nodiscard]] bool accept(const EditedMesh::Mark& mark, double worth) {
        if (!accepts(mark, worth)) return false;
        take_over();
        return true;
    }
    // After accepts(): how many more pairs of faces intersect.
    [[nodiscard]] int growth() const { return crossings_.growth(); }
    // A face that intersects another one; no_index: none.
    [[nodiscard]] Index face_through(Index f) const { return crossings_.face_through(f); }
    void open_budget() { distances_.open_budget(); }
    // After accepts(), of the same changes.
    void take_over() {
        distances_.take_over();
        crossings_.take_over();
    }

private:
    const EditedMesh& mesh_;
    CrossingGuard<EditedMesh> crossings_;
    DistanceGuard distances_;
};

// Collapses leave spare vertices, splits need them. Balances the count by edits elsewhere.
class SpareVertices {
public:
    // \param mesh, steps, guard, ticker  outlive this.
    // \param wanted  of `steps`: all triangles that edits touch here keep at least this quality.
    SpareVertices(EditedMesh& mesh, ShapeSteps& steps, EditGuard& guard, double wanted,
                  Ticker& ticker)
        : mesh_(mesh), steps_(steps), guard_(guard), ticker_(ticker), wanted_(wanted) {}

    // Vertices that were removed and not yet added elsewhere.
    [[nodiscard]] int count() const { return count_; }
    // Counts a split (-1) or a collapse (+1) of the caller.
    void add(int change) { count_ += change; }

    // Removes a vertex where triangles stay good, by the best collapses first.
    // \return false if there is none. Cost: O(#triangles log #triangles) for the first call.
    bool collapse_one() {
        if (!has_collapses_) list_collapses();
        while (!collapses_.empty()) {
            const auto [quality, gone, into] = collapses_.back();
            collapses_.pop_back();
            if (mesh_.faces_at(gone).empty() || mesh_.faces_at(into).empty()) continue;
            const EditedMesh::Mark before = mesh_.mark();
            if (mesh_.worst_at(gone) >= wanted_ && mesh_.collapse(gone, into)) {
                (void)steps_.move_to_mean(into);
                steps_.relax(before);
                if (steps_.worst_since(before) >= wanted_ &&
                    guard_.accept(before, worth_elsewhere)) {
                    ++count_;
                    return true;
                }
            }
            mesh_.take_back(before);
        }
        return false;
    }
    // Splits long edges until the count is 0, those between good triangles first.
    // \return false if that fails. Cost: O(log #edges) and a trial for each edge and each change.
    bool balance() {
        for (const bool is_good : {true, false}) {
            edges_ = {};
            if (count_ > 0) {
                for (const Index f : mesh_.faces()) push_edges(f);
            }
            while (count_ > 0 && split_one(is_good)) {
            }
        }
        return count_ == 0;
    }

private:
    struct Candidate {
        double quality;
        Index gone, into;
        [[nodiscard]] auto operator<=>(const Candidate&) const = default;
    };
    // The first one is the longest.
    struct LongEdge {
        double minus_square;  // Of its length.
        Index face, k;
        [[nodiscard]] auto operator<=>(const LongEdge&) const = default;
    };

    // Lists collapses by the quality that triangles have with one point in place of both ends: the
    // second one, or the middle of an edge that is off the curves.
    void list_collapses() {
        has_collapses_ = true;
        for (const Index f : mesh_.faces()) {
            ticker_.tick(30);
            const Triangle& t = mesh_.face(f).corner;
            for (Index k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const bool is_free = mesh_.mobility(a) == Mobility::Free;
                const bool are_free = is_free && mesh_.mobility(b) == Mobility::Free;
                const bool is_along = is_free || (mesh_.mobility(a) == Mobility::Boundary &&
                                                  mesh_.face(f).is_hard(k));
                if (!is_along || (are_free && a > b)) continue;
                const double quality =
                    quality_at(are_free ? (mesh_.at(a) + mesh_.at(b)) / 2 : mesh_.at(b), a, b);
                if (quality >= wanted_) collapses_.push_back({quality, a, b});
            }
        }
        std::sort(collapses_.begin(), collapses_.end());
    }
    // Lists the edges whose half-edge from the lower vertex lies in a face.
    void push_edges(Index face) {
        const Triangle& t = mesh_.face(face).corner;
        for (Index k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a < b) edges_.push({-(mesh_.at(a) - mesh_.at(b)).squaredNorm(), face, k});
        }
    }
    [[nodiscard]] double quality_at(const Vec3& point, Index a, Index b) const {
        double worst = 1;
        for (const Index v : {a, b}) {
            for (const Index f : mesh_.faces_at(v)) {
                const Triangle& t = mesh_.face(f).corner;
                std::array<Vec3, 3> at;
                int num_moved = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const bool is_moved = t[k] == a || t[k] == b;
                    num_moved += is_moved ? 1 : 0;
                    at[k] = is_moved ? point : mesh_.at(t[k]);
                }
                if (num_moved == 1) {
                    worst = std::min(worst, mesh_.quality_of_shape(at));
                }
            }
        }
        return worst;
    }
    // Splits the longest edge whose triangles are good after that or, if not all need be, no worse
    // than before.
    bool split_one(bool is_good) {
        while (!edges_.empty()) {
            const auto [minus_square, face, k] = edges_.top();
            edges_.pop();
            if (!mesh_.face(face).is_there) continue;
            const Triangle& t = mesh_.face(face).corner;
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a > b || -(mesh_.at(a) - mesh_.at(b)).squaredNorm() != minus_square) continue;
            const EditedMesh::Mark before = mesh_.mark();
            const bool is_done = steps_.edit({face, k, ShapeEdit::Kind::Split});
            steps_.relax(before);
            if (is_done &&
                (is_good ? steps_.worst_since(before) >= wanted_
                         : steps_.keeps_quality(before, wanted_)) &&
                guard_.accept(before, worth_elsewhere)) {
                mesh_.changed_since(before, changed_, before_);
                for (const Index changed : changed_) push_edges(changed);
                --count_;
                return true;
            }
            mesh_.take_back(before);
        }
        return false;
    }

    EditedMesh& mesh_;
    ShapeSteps& steps_;
    EditGuard& guard_;
    Ticker& ticker_;
    const double wanted_;
    int count_ = 0;
    bool has_collapses_ = false;
    std::vector<Candidate> collapses_;  // The best one last.
    // Edges to split. One that could not be split comes back when its face changes.
    std::priority_queue<LongEdge, std::vector<LongEdge>, std::greater<>> edges_;
    std::vector<Index> changed_;
    std::vector<double> before_;
};

}  // namespace remesh::detail
