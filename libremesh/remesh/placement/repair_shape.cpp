// Repairs bad triangles, the worst first: by a flip or slides, otherwise by a collapse, a split, or
// a vertex put onto a curve. Elsewhere vertices are removed before and added at the end, so that
// their count stays.
#include "remesh/placement/placement.h"

#include <algorithm>

#include "remesh/placement/spare_vertices.h"

namespace remesh {
namespace {

using detail::EditedMesh;
using detail::EditGuard;
using detail::Mobility;
using detail::ShapeEdit;
using detail::ShapeGain;
using detail::ShapeSteps;
using detail::SpareVertices;

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
// With bounds: passes over the triangles that exceed them. A last pass repairs the triangles around
// that got narrow.
constexpr int most_passes = 4;
constexpr double narrow_within_bounds = detail::ShapeMeasure::within_bounds(goals[1]);

class ShapeRepair {
public:
    // \param num_faces  of the surface.
    // \param is_settled  by face: 1 for bad triangles that no edit helps, until one beside them
    //                    changes. A later goal that is higher does not help them either.
    // \param may_add     vertices need not be removed elsewhere.
    ShapeRepair(EditedMesh& mesh, EditGuard& guard, Index num_faces, double goal,
                std::vector<std::uint8_t>& is_settled, Ticker& ticker, bool may_add = false)
        : may_add_(may_add),
          mesh_(mesh),
          guard_(guard),
          is_settled_(is_settled),
          steps_(mesh, num_faces, goal, ticker),
          // Within bounds triangles elsewhere must not get narrow.
          spare_(mesh, steps_, guard,
                 mesh.has_bounds() ? std::max(goal, narrow_within_bounds) : goal, ticker) {}

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
            const ShapeGain gain = steps_.gain_since(before);
            const bool is_gain = gain.score > 0 || !mesh_.has_bounds();
            if (!is_gain || !guard_.accept(before, gain.worth)) mesh_.take_back(before);
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
        const bool is_free = best.change() >= 0 || spare_.count() > 0;
        if (!(most > 0) || !(is_free || may_add_ || spare_.collapse_one())) return;
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.is_bad(f) && apply(best) > 0) {
            guard_.take_over();
            if (is_free || !may_add_) spare_.add(best.change());
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

    const bool may_add_;
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

std::vector<Index> keep_bounds(const detail::MeshCurves& curves, std::span<const Mobility> mobility,
                               const ShapeBounds& bounds, double most_share, PlacedMesh& mesh,
                               const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> numbers;
    EditedMesh edited(curves, mesh, mobility, detail::ShapeMeasure(bounds));
    const auto num_beyond = [&] {
        return std::ranges::count_if(
            edited.faces(), [&](Index f) { return edited.shape_of(f) < detail::low_quality; });
    };
    const auto at_start = static_cast<double>(num_beyond());
    if (at_start == 0 || at_start > most_share * edited.num_faces()) return numbers;
    const EditedMesh::Mark start = edited.mark();
    EditGuard guard(edited, curves.whole(), {});
    guard.open_budget();
    // The guards know a state that is taken back: nothing can be done after that.
    bool is_over = false;
    const auto run = [&](double goal, std::vector<std::uint8_t> is_settled) {
        const EditedMesh::Mark before = edited.mark();
        ShapeRepair repair(edited, guard, curves.surface().num_faces(), goal, is_settled, ticker,
                           bounds.longest_edge < infinity);
        is_over = !repair.run();
        if (is_over) edited.take_back(before);
        return edited.mark().faces > before.faces;
    };
    for (int pass = 0; pass < most_passes && num_beyond() > 0; ++pass) {
        if (!run(detail::low_quality, {})) break;
    }
    if (!is_over && edited.mark().faces > start.faces) {
        std::vector<std::uint8_t> is_settled(edited.num_faces(), 1);
        for (const Index f : edited.changed_since(start)) is_settled[f] = 0;
        (void)run(narrow_within_bounds, std::move(is_settled));
    }
    if (edited.mark().faces > start.faces) mesh = edited.result(numbers);
    return numbers;
}

}  // namespace remesh
