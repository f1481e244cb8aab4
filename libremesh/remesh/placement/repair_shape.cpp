// Repairs bad triangles, the worst first: by a flip or slides, otherwise by the best collapse or
// split. At the end the count is balanced elsewhere.
#include "remesh/placement/placement.h"

#include <algorithm>
#include <compare>
#include <functional>
#include <queue>

#include "agvd/core/progress.h"
#include "remesh/placement/shape_steps.h"

namespace remesh {
namespace {

using detail::EditedMesh;
using detail::Mobility;
using detail::ShapeEdit;
using detail::ShapeGain;
using detail::ShapeSteps;

// Collapses leave spare vertices, splits need them. Balances the count by edits elsewhere.
class SpareVertices {
public:
    // \param mesh, steps, ticker  outlive this.
    // \param wanted  of `steps`: all triangles that edits touch here keep at least this quality.
    SpareVertices(EditedMesh& mesh, ShapeSteps& steps, double wanted, Ticker& ticker)
        : mesh_(mesh), steps_(steps), ticker_(ticker), wanted_(wanted) {}

    // Begins at 0.
    // \param elsewhere  least quality of triangles, before and after, where collapse_one()
    //                   removes a vertex.
    void restart(double elsewhere) {
        count_ = 0;
        elsewhere_ = elsewhere;
        has_collapses_ = has_edges_ = false;
        collapses_.clear();
        edges_ = {};
    }

    // Vertices that were removed and not yet added elsewhere; below 0: to be removed.
    [[nodiscard]] int count() const { return count_; }
    // Counts a split (-1) or a collapse (+1) of the caller.
    void add(int change) { count_ += change; }

    // Removes a vertex where triangles stay good, by the best collapses first.
    // \return false if there is none. Cost: O(#triangles log #triangles) for the first call after
    // restart().
    bool collapse_one() {
        if (!has_collapses_) list_collapses();
        while (!collapses_.empty()) {
            const auto [quality, gone, into] = collapses_.back();
            collapses_.pop_back();
            if (mesh_.faces_at(gone).empty() || mesh_.faces_at(into).empty()) continue;
            const EditedMesh::Mark before = mesh_.mark();
            if (mesh_.worst_at(gone) >= elsewhere_ && mesh_.collapse(gone, into)) {
                (void)steps_.move_to_mean(into);
                steps_.relax(before);
                if (steps_.worst_since(before) >= elsewhere_) {
                    ++count_;
                    return true;
                }
            }
            mesh_.take_back(before);
        }
        return false;
    }
    // Splits long edges or removes vertices until the count is 0.
    // \return false if that fails. Cost: O(log #edges) and a trial for each edge and each change.
    bool balance() {
        if (count_ < 0) prune();
        while (count_ > 0 && split_one()) {
        }
        while (count_ < 0 && collapse_one()) {
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

    // Removes boundary vertices whose worst triangle lies between the wanted quality and that of
    // elsewhere_, if all triangles keep the wanted one.
    void prune() {
        for (Index v = 0; v < mesh_.num_vertices() && count_ < 0; ++v) {
            if (mesh_.mobility(v) != Mobility::Boundary || mesh_.faces_at(v).empty()) continue;
            const double worst = mesh_.worst_at(v);
            if (worst < wanted_ || worst >= elsewhere_) continue;
            for (const Index into : mesh_.hard_neighbours(v)) {
                if (into == no_index) continue;
                const EditedMesh::Mark before = mesh_.mark();
                if (mesh_.collapse(v, into)) {
                    steps_.relax(before);
                    if (steps_.worst_since(before) >= wanted_) {
                        ++count_;
                        break;
                    }
                }
                mesh_.take_back(before);
            }
        }
    }
    // Lists collapses by the quality that triangles have with the edge's middle in place of its
    // ends.
    void list_collapses() {
        has_collapses_ = true;
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            if (!mesh_.face(f).is_there) continue;
            ticker_.tick(30);
            const Triangle& t = mesh_.face(f).corner;
            for (Index k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                if (a > b) continue;  // Each edge once.
                if (mesh_.mobility(a) != Mobility::Free || mesh_.mobility(b) != Mobility::Free) {
                    continue;
                }
                const double quality = quality_of_middle(a, b);
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
    [[nodiscard]] double quality_of_middle(Index a, Index b) const {
        const Vec3 middle = (mesh_.at(a) + mesh_.at(b)) / 2;
        double worst = 1;
        for (const Index v : {a, b}) {
            for (const Index f : mesh_.faces_at(v)) {
                const Triangle& t = mesh_.face(f).corner;
                std::array<Vec3, 3> at;
                int num_moved = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const bool is_moved = t[k] == a || t[k] == b;
                    num_moved += is_moved ? 1 : 0;
                    at[k] = is_moved ? middle : mesh_.at(t[k]);
                }
                if (num_moved == 1) {
                    worst = std::min(worst, detail::shape_quality(at[0], at[1], at[2]));
                }
            }
        }
        return worst;
    }
    // Splits the longest edge that can be split well.
    bool split_one() {
        if (!has_edges_) {
            has_edges_ = true;
            for (Index f = 0; f < mesh_.num_faces(); ++f) {
                if (mesh_.face(f).is_there) push_edges(f);
            }
        }
        while (!edges_.empty()) {
            const auto [minus_square, face, k] = edges_.top();
            edges_.pop();
            if (!mesh_.face(face).is_there) continue;
            const Triangle& t = mesh_.face(face).corner;
            const Index a = t[k], b = t[(k + 1) % 3];
            if (a > b || -(mesh_.at(a) - mesh_.at(b)).squaredNorm() != minus_square) continue;
            const EditedMesh::Mark before = mesh_.mark();
            if (steps_.edit({face, k, true, false}) && steps_.worst_since(before) >= wanted_) {
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
    Ticker& ticker_;
    const double wanted_;
    double elsewhere_ = 0;
    int count_ = 0;
    bool has_collapses_ = false, has_edges_ = false;
    std::vector<Candidate> collapses_;  // The best one last.
    // Edges to split. One that could not be split comes back when its face changes.
    std::priority_queue<LongEdge, std::vector<LongEdge>, std::greater<>> edges_;
    std::vector<Index> changed_;
    std::vector<double> before_;
};

struct Goal {
    double quality;  // Triangles below it are repaired.
    // Least quality of triangles, before and after, where a vertex is removed to balance the count.
    double elsewhere;
};
// Met one after the other: the worst triangles first have all the vertices that can be spared. As
// qualities, angles of 21.3 and 29.1 degrees count as .425 and .57.
constexpr std::array goals{Goal{0.425, 0.6}, Goal{0.57, 0.63}};
// Least gain of an edit.
constexpr double least_trial_gain = 0.02;
// At most one of so many vertices may be missing: a surface that is thinner than the spacing
// everywhere has nowhere to take them from.
constexpr Index most_moved = 8;
// Budgets for each initially bad triangle: where all are bad, work would not end. Lips use half of
// them.
constexpr std::size_t edits_for_each = 3, slides_for_each = 200;
// This many bad triangles get the whole budget; each further one gets fewer slides. Organic meshes
// have at most some 20 bad triangles, thin walls over a thousand.
constexpr std::size_t paid_in_full = 64, slides_for_others = 25;
constexpr int most_rounds_of_repair = 6;

class ShapeRepair {
public:
    // \param num_faces  of the surface.
    ShapeRepair(EditedMesh& mesh, Index num_faces, const Goal& goal, Ticker& ticker)
        : mesh_(mesh),
          goal_(goal),
          steps_(mesh, num_faces, goal.quality, ticker),
          spare_(mesh, steps_, goal.quality, ticker),
          least_spare_(-static_cast<int>(mesh.num_vertices() / most_moved)) {}

    // First balances the count at the end, when the number of missing vertices is known: it is
    // below the number of splits. If that fails, starts again and removes a vertex after each
    // split.
    // \return whether the mesh has changed; it does not if the count cannot be kept.
    bool run() {
        const EditedMesh::Mark start = mesh_.mark();
        const std::size_t num_bad = steps_.bad_faces().size();
        // Where most triangles are bad, as on spikes, the repair gains nothing.
        const std::size_t num_good = mesh_.num_faces() - num_bad;
        const std::size_t num_more_good = num_good - std::min(num_good, num_bad);
        const std::size_t num_paid = std::min(num_bad, std::max(num_more_good, paid_in_full));
        const std::size_t num_full = std::min(num_paid, paid_in_full);
        const std::size_t num_slides =
            slides_for_each * num_full + slides_for_others * (num_paid - num_full);
        for (const bool pays_at_once : {false, true}) {
            pays_at_once_ = pays_at_once;
            edits_left_ = edits_for_each * num_paid;
            spare_.restart(pays_at_once ? goal_.quality + least_trial_gain : goal_.elsewhere);
            steps_.allow_slides(num_slides);
            const bool is_changed = work();
            steps_.allow_slides(num_slides);
            if (spare_.balance()) return is_changed;
            mesh_.take_back(start);
        }
        return false;
    }

private:
    bool work() {
        bool is_changed = false;
        for (int round = 0; round < most_rounds_of_repair; ++round) {
            bool is_better = false;
            for (const auto& [quality, f] : steps_.bad_faces()) {
                if (!steps_.is_bad(f)) continue;
                is_better = repair(f) || is_better;
            }
            if (!is_better) break;
            is_changed = true;
        }
        return is_changed;
    }

    bool repair(Index f) {
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.improve(f)) {
            steps_.relax(before);
            if (!steps_.is_bad(f)) return true;
        }
        const bool is_better = mesh_.mark().faces > before.faces;
        return try_edits(f) || is_better;
    }

    // The score of a trial; 0: no gain. Collapses that repair all triangles come first, since they
    // leave a spare vertex; then splits. Splits count by their sum, since in a chain of equal
    // triangles no worst one improves alone. Other collapses count by the worst triangle: they
    // remove faces, which distorts the sum.
    [[nodiscard]] static double score_of(const ShapeGain& gain, bool is_split) {
        if (gain.worst < 0 || gain.sum < least_trial_gain) return 0;
        if (is_split) return 1 + gain.sum;
        if (gain.is_all) return 100 + gain.sum;
        return gain.worst < least_trial_gain ? 0 : gain.worst;
    }

    // Collapses first, the shortest edge first; then splits, the longest first.
    [[nodiscard]] std::array<ShapeEdit, 9> trials_at(Index f) const {
        const Triangle& t = mesh_.face(f).corner;
        std::array<std::pair<double, Index>, 3> edges;
        for (Index k = 0; k < 3; ++k) {
            edges[k] = {(mesh_.at(t[k]) - mesh_.at(t[(k + 1) % 3])).norm(), k};
        }
        std::sort(edges.begin(), edges.end());
        std::array<ShapeEdit, 9> trials;
        for (std::size_t i = 0; i < 3; ++i) {
            trials[2 * i] = {f, edges[i].second, false, false};
            trials[2 * i + 1] = {f, edges[i].second, false, true};
            trials[8 - i] = {f, edges[i].second, true, false};
        }
        return trials;
    }

    // Applies the first collapse or split that repairs all it touches, otherwise the best one.
    bool try_edits(Index f) {
        if (edits_left_ == 0) return false;
        --edits_left_;
        ShapeEdit best;
        double most = 0;
        for (const ShapeEdit& trial : trials_at(f)) {
            const EditedMesh::Mark before = mesh_.mark();
            const bool is_done = steps_.edit(trial);
            const ShapeGain gain = is_done ? steps_.gain_since(before) : ShapeGain{};
            mesh_.take_back(before);
            const double score = is_done ? score_of(gain, trial.is_split) : 0;
            if (!(score > most)) continue;
            most = score;
            best = trial;
            if (gain.is_all) break;
        }
        if (best.face == no_index || (best.is_split && spare_.count() <= least_spare_))
            return false;
        const EditedMesh::Mark before = mesh_.mark();
        (void)steps_.edit(best);
        if (!best.is_split) {
            spare_.add(1);
            return true;
        }
        spare_.add(-1);
        if (!pays_at_once_ || spare_.count() >= 0 || spare_.collapse_one()) return true;
        spare_.add(1);
        mesh_.take_back(before);
        return false;
    }

    EditedMesh& mesh_;
    const Goal goal_;
    ShapeSteps steps_;
    SpareVertices spare_;
    const int least_spare_;
    bool pays_at_once_ = false;
    std::size_t edits_left_ = 0;
};

}  // namespace

std::vector<Index> repair_shape(const detail::MeshCurves& curves,
                                std::span<const Mobility> mobility,
                                std::span<const DirectedEdge> hard, PlacedMesh& mesh,
                                const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> numbers;
    EditedMesh edited(curves, mesh, mobility, hard);
    bool is_changed = false;
    for (const Goal& goal : goals) {
        is_changed =
            ShapeRepair(edited, curves.surface().num_faces(), goal, ticker).run() || is_changed;
    }
    if (is_changed) mesh = edited.result(numbers);
    return numbers;
}

}  // namespace remesh
