// Repairs bad triangles, the worst first: by a flip or slides, otherwise by a collapse, a split, or
// a vertex put onto a curve. Elsewhere vertices are removed before and added at the end, so that
// their count stays.
#include "remesh/placement/placement.h"

#include <algorithm>
#include <compare>
#include <functional>
#include <limits>
#include <queue>

#include "agvd/core/progress.h"
#include "remesh/placement/crossing_guard.h"
#include "remesh/placement/distance_guard.h"
#include "remesh/placement/shape_steps.h"

namespace remesh {
namespace {

using detail::EditedMesh;
using detail::Mobility;
using detail::ShapeEdit;
using detail::ShapeGain;
using detail::ShapeSteps;

// What a change elsewhere, for the count, is worth: see ShapeGain.
constexpr double worth_elsewhere = 4e-4;

// The changes that may stay: those that neither add intersections nor leave the surface.
class EditGuard {
public:
    EditGuard(const EditedMesh& mesh, const Surface& surface, std::span<const Index> faces)
        : mesh_(mesh), crossings_(mesh), distances_(mesh, surface, faces) {}

    [[nodiscard]] bool accepts(const EditedMesh::Mark& mark, double worth) {
        const std::vector<Index> changed = mesh_.changed_since(mark);
        return distances_.accepts(changed, worth) && crossings_.accepts(changed);
    }
    // Also takes over the changes; they must not be taken back later.
    [[nodiscard]] bool accept(const EditedMesh::Mark& mark, double worth) {
        if (!accepts(mark, worth)) return false;
        take_over();
        return true;
    }
    void open_budget() { distances_.open_budget(); }
    // After accepts(), of the same changes.
    void take_over() {
        distances_.take_over();
        crossings_.take_over();
    }

private:
    const EditedMesh& mesh_;
    detail::CrossingGuard crossings_;
    detail::DistanceGuard distances_;
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
    // Splits long edges until the count is 0.
    // \return false if that fails. Cost: O(log #edges) and a trial for each edge and each change.
    bool balance() {
        for (const double least : {wanted_, 0.0}) {
            edges_ = {};
            if (count_ > 0) {
                for (const Index f : mesh_.faces()) push_edges(f);
            }
            while (count_ > 0 && split_one(least)) {
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
                    worst = std::min(worst, detail::shape_quality(at[0], at[1], at[2]));
                }
            }
        }
        return worst;
    }
    // Splits the longest edge whose triangles keep a quality.
    bool split_one(double least) {
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
            if (is_done && steps_.worst_since(before) >= least &&
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

// Triangles below these qualities are repaired, one after the other: the worst triangles first have
// all the vertices that can be spared. Angles of 21.3, 29.1, 32.5 and 36.6 degrees count as .425,
// .57, .63 and .7. The last time distance may be spent on the worst that are left.
constexpr std::array goals{0.425, 0.57, 0.63, 0.7, 0.7};
// A later goal is given up where more triangles than this share are bad: it would cost much, for
// little.
constexpr double most_bad = 0.15;
// Budgets for each initially bad triangle: where all are bad, work would not end.
constexpr std::size_t edits_for_each = 3, slides_for_each = 200;
// This many bad triangles get the whole budget; each further one gets fewer slides. Organic meshes
// have at most some 20 bad triangles, thin walls over a thousand.
constexpr std::size_t paid_in_full = 64, slides_for_others = 25;
// Edits of twelve tried for one triangle. With three the lips of a tube keep angles of 15 degrees.
constexpr std::size_t most_trials = 4;
// Of the slides, to add what vertices are left over.
constexpr std::size_t share_of_balance = 8;
constexpr int most_rounds_of_repair = 6;

class ShapeRepair {
public:
    // \param num_faces  of the surface.
    // \param is_settled  by face: 1 for bad triangles that no edit helps, until one beside them
    //                    changes. A later goal that is higher does not help them either.
    ShapeRepair(EditedMesh& mesh, EditGuard& guard, Index num_faces, double goal,
                std::vector<std::uint8_t>& is_settled, Ticker& ticker)
        : mesh_(mesh),
          guard_(guard),
          is_settled_(is_settled),
          steps_(mesh, num_faces, goal, ticker),
          spare_(mesh, steps_, guard, goal, ticker) {}

    [[nodiscard]] double share_of_bad() const {
        return static_cast<double>(steps_.bad_faces().size()) / mesh_.num_faces();
    }
    // A vertex is removed elsewhere before a split adds one; what is left over is added at the end.
    // \return false if the count is not kept.
    bool run() {
        const std::size_t num_bad = steps_.bad_faces().size();
        // Where most triangles are bad, as on spikes, the repair gains nothing.
        const std::size_t num_good = mesh_.num_faces() - num_bad;
        const std::size_t num_more_good = num_good - std::min(num_good, num_bad);
        const std::size_t num_paid = std::min(num_bad, std::max(num_more_good, paid_in_full));
        const std::size_t num_full = std::min(num_paid, paid_in_full);
        const std::size_t num_slides =
            slides_for_each * num_full + slides_for_others * (num_paid - num_full);
        edits_left_ = edits_for_each * num_paid;
        steps_.allow_slides(num_slides);
        work();
        steps_.allow_slides(num_slides / share_of_balance);
        const EditedMesh::Mark before = mesh_.mark();
        const bool is_kept = spare_.balance();
        reopen_since(before);
        return is_kept;
    }

private:
    void work() {
        is_settled_.resize(mesh_.num_faces(), 0);
        for (int round = 0; round < most_rounds_of_repair; ++round) {
            bool is_done = true;
            for (const auto& [quality, f] : steps_.bad_faces()) {
                if (is_settled_[f] != 0 || !steps_.is_bad(f)) continue;
                is_done = false;
                repair(f);
            }
            if (is_done) return;
        }
    }

    void repair(Index f) {
        is_settled_[f] = 1;
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.improve(f)) {
            steps_.relax(before);
            if (!guard_.accept(before, steps_.gain_since(before).worth)) mesh_.take_back(before);
        }
        if (steps_.is_bad(f)) try_edits(f);
        reopen_since(before);
    }
    void reopen_since(const EditedMesh::Mark& mark) {
        is_settled_.resize(mesh_.num_faces(), 0);
        for (const Index changed : mesh_.changed_since(mark)) {
            is_settled_[changed] = 0;
            if (!mesh_.face(changed).is_there) continue;
            for (const Index v : mesh_.face(changed).corner) {
                for (const Index f : mesh_.faces_at(v)) is_settled_[f] = 0;
            }
        }
    }

    // The edits that gain most before the triangles around are relaxed, the best one first.
    [[nodiscard]] std::vector<ShapeEdit> edits_at(Index f) {
        std::vector<std::pair<double, ShapeEdit>> all;
        for (Index k = 0; k < 3; ++k) {
            for (const auto kind : {ShapeEdit::Kind::ToSecond, ShapeEdit::Kind::ToFirst,
                                    ShapeEdit::Kind::Split, ShapeEdit::Kind::Press}) {
                const ShapeEdit edit{f, k, kind};
                const EditedMesh::Mark before = mesh_.mark();
                if (steps_.edit(edit)) all.emplace_back(steps_.gain_since(before).score, edit);
                mesh_.take_back(before);
            }
        }
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.first > b.first; });
        std::vector<ShapeEdit> edits;
        for (const auto& [gain, edit] : std::span(all).first(std::min(all.size(), most_trials))) {
            edits.push_back(edit);
        }
        return edits;
    }

    // Applies the best edit. A vertex goes elsewhere before one is added.
    void try_edits(Index f) {
        if (edits_left_ == 0) return;
        --edits_left_;
        ShapeEdit best;
        double most = 0;
        for (const ShapeEdit& edit : edits_at(f)) {
            const EditedMesh::Mark before = mesh_.mark();
            const double score = apply(edit);
            mesh_.take_back(before);
            if (!(score > most)) continue;
            most = score;
            best = edit;
        }
        if (!(most > 0) || (best.change() < 0 && spare_.count() == 0 && !spare_.collapse_one())) {
            return;
        }
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.is_bad(f) && apply(best) > 0) {
            guard_.take_over();
            spare_.add(best.change());
        } else {
            mesh_.take_back(before);
        }
    }
    // \return the score of the edit if the guards accept it, otherwise 0.
    [[nodiscard]] double apply(const ShapeEdit& edit) {
        const EditedMesh::Mark before = mesh_.mark();
        if (!steps_.edit(edit)) return 0;
        steps_.relax(before);
        const ShapeGain gain = steps_.gain_since(before);
        return gain.score > 0 && guard_.accepts(before, gain.worth) ? gain.score : 0;
    }

    EditedMesh& mesh_;
    EditGuard& guard_;
    std::vector<std::uint8_t>& is_settled_;
    ShapeSteps steps_;
    SpareVertices spare_;
    std::size_t edits_left_ = 0;
};

}  // namespace

std::vector<Index> repair_shape(const detail::MeshCurves& curves,
                                std::span<const Mobility> mobility, PlacedMesh& mesh,
                                const Progress& progress, std::span<const Index> faces) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> numbers;
    EditedMesh edited(curves, mesh, mobility);
    // Most meshes have bad faces, but the guards cost more than a look.
    const auto is_good = [&](Index f) { return edited.face(f).quality >= goals.back(); };
    if (std::ranges::all_of(edited.faces(), is_good)) return numbers;
    EditGuard guard(edited, curves.whole(), faces);
    const EditedMesh::Mark start = edited.mark();
    std::vector<std::uint8_t> is_settled;
    for (std::size_t i = 0; i < goals.size(); ++i) {
        const EditedMesh::Mark before = edited.mark();
        ShapeRepair repair(edited, guard, curves.surface().num_faces(), goals[i], is_settled,
                           ticker);
        if (i + 1 == goals.size()) {
            guard.open_budget();
            is_settled.clear();
        }
        if (i > 0 && repair.share_of_bad() > most_bad) break;
        if (!repair.run()) {
            edited.take_back(before);
            break;  // The guards know the state that was taken back.
        }
    }
    if (edited.mark().faces > start.faces) mesh = edited.result(numbers);
    return numbers;
}

}  // namespace remesh
