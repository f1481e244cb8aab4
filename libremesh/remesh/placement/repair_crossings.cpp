// Parts faces that intersect, one pair after the other: by the edit that leaves fewest pairs, a
// flip, a collapse, or a split with the new vertex on the surface. A split may leave some more: the
// surface does not intersect itself, so small enough faces do not either. Vertices are removed
// elsewhere before they are added here.
#include "remesh/placement/placement.h"

#include <algorithm>
#include <deque>
#include <tuple>

#include "remesh/placement/spare_vertices.h"

namespace remesh {
namespace {

using detail::EditedMesh;
using detail::EditGuard;
using detail::Mobility;
using detail::ShapeSteps;
using detail::SpareVertices;

// Triangles below this quality are improved beside an edit, by so many slides.
constexpr double wanted_quality = 0.57;
constexpr std::size_t slides_beside = 12;
// No triangle of an edit gets worse than this, unless it was: an angle of 10 degrees.
constexpr double least_quality_left = 0.2;
// Edits in all, and vertices added for each pair of faces and those that come of it.
constexpr std::size_t most_edits = 200;
constexpr int most_added = 8;
// By how many pairs a split may leave more.
constexpr int most_growth_of_split = 2;
// Edits of two faces that are tried with the triangles around improved.
constexpr std::size_t most_edits_tried = 4;
// In mean edge lengths: shorter edges are not divided.
constexpr double least_edge = 0.1;
// What a pair less is worth: see ShapeGain.
constexpr double worth_of_pair = 0.1;

struct Edit {
    enum class Kind : std::uint8_t { Flip, ToSecond, ToFirst, Split };

    Index face = no_index, k = 0;
    Kind kind = Kind::Flip;

    // Of the number of vertices to spare.
    [[nodiscard]] int change() const {
        return kind == Kind::Flip ? 0 : kind == Kind::Split ? -1 : 1;
    }
    // Of the number of pairs.
    [[nodiscard]] std::size_t most_growth() const {
        return kind == Kind::Split ? most_growth_of_split : 0;
    }
};

class PairRepair {
public:
    PairRepair(EditedMesh& mesh, const Surface& surface, Ticker& ticker)
        : mesh_(mesh),
          guard_(mesh, surface, {}),
          steps_(mesh, surface.num_faces(), wanted_quality, ticker),
          spare_(mesh, steps_, guard_, wanted_quality, ticker) {}

    // \return false if the number of vertices is not kept.
    bool run(std::span<const std::pair<Index, Index>> pairs) {
        for (const auto& [f, g] : pairs) {
            for (const Index face : {f, g}) part(face);
        }
        return spare_.balance();
    }

private:
    // Edits a face, and those that edits change, until none intersects another.
    void part(Index face) {
        int added_left = most_added;
        std::deque<Index> open{face};
        while (!open.empty() && edits_left_ > 0) {
            const Index f = open.front();
            open.pop_front();
            const Index g = mesh_.face(f).is_there ? guard_.face_through(f) : no_index;
            if (g == no_index || !is_open(f, g)) continue;
            --edits_left_;
            const EditedMesh::Mark before = mesh_.mark();
            const int change = edit_best(f, g, added_left > 0);
            if (change == no_edit) {
                in_vain_.push_back(std::minmax(f, g));
                continue;
            }
            if (change < 0) --added_left;
            open.push_front(f);
            for (const Index changed : mesh_.changed_since(before)) {
                open.push_back(changed);
                std::erase_if(in_vain_, [&](const auto& pair) {
                    return pair.first == changed || pair.second == changed;
                });
            }
        }
    }
    // Whether no edit of the two has been tried since one of them changed.
    [[nodiscard]] bool is_open(Index f, Index g) const {
        return std::ranges::find(in_vain_, std::pair<Index, Index>(std::minmax(f, g))) ==
               in_vain_.end();
    }

    // The edits of the edges of two faces that leave fewest pairs before the triangles around are
    // improved.
    [[nodiscard]] std::vector<Edit> edits_at(Index f, Index g, bool may_add) {
        std::vector<std::tuple<int, double, Edit>> all;  // More pairs, minus the quality.
        for (const Index face : {f, g}) {
            for (Index k = 0; k < 3; ++k) {
                for (const auto kind : {Edit::Kind::Flip, Edit::Kind::ToSecond, Edit::Kind::ToFirst,
                                        Edit::Kind::Split}) {
                    const Edit edit{face, k, kind};
                    if (kind == Edit::Kind::Split && !may_add) continue;
                    const EditedMesh::Mark before = mesh_.mark();
                    if (do_edit(edit) && guard_.adds_few_pairs(before, edit.most_growth())) {
                        all.emplace_back(guard_.growth(), -steps_.worst_since(before), edit);
                    }
                    mesh_.take_back(before);
                }
            }
        }
        std::ranges::stable_sort(all, {}, [](const auto& entry) {
            return std::pair(std::get<0>(entry), std::get<1>(entry));
        });
        std::vector<Edit> edits;
        for (const auto& [growth, quality, edit] :
             std::span(all).first(std::min(all.size(), most_edits_tried))) {
            edits.push_back(edit);
        }
        return edits;
    }

    // \return what it changes in the number of vertices to spare; no_edit: there is none.
    int edit_best(Index f, Index g, bool may_add) {
        Edit best;
        int least = most_growth_of_split + 1;
        double best_quality = -1;
        for (const Edit& edit : edits_at(f, g, may_add)) {
            const EditedMesh::Mark before = mesh_.mark();
            const bool is_done = apply(edit);
            const int growth = guard_.growth();
            const double quality = is_done ? steps_.worst_since(before) : 0;
            mesh_.take_back(before);
            if (!is_done || (growth >= 0 && edit.kind != Edit::Kind::Split)) continue;
            if (growth < least || (growth == least && quality > best_quality)) {
                least = growth;
                best_quality = quality;
                best = edit;
            }
        }
        if (best.face == no_index) return no_edit;
        if (best.change() < 0 && spare_.count() == 0 && !spare_.collapse_one()) return no_edit;
        const EditedMesh::Mark before = mesh_.mark();
        // The collapse elsewhere may have changed these faces.
        if (!mesh_.face(best.face).is_there || !apply(best)) {
            mesh_.take_back(before);
            return no_edit;
        }
        guard_.take_over();
        spare_.add(best.change());
        return best.change();
    }

    // \return false if the edit cannot be, or may not stay.
    bool apply(const Edit& edit) {
        const EditedMesh::Mark before = mesh_.mark();
        if (!do_edit(edit)) return false;
        steps_.allow_slides(slides_beside);
        steps_.relax(before);
        if (!steps_.keeps_quality(before, least_quality_left)) return false;
        return guard_.accepts(before, worth_of_pair, edit.most_growth());
    }
    bool do_edit(const Edit& edit) {
        const Triangle& t = mesh_.face(edit.face).corner;
        const Index a = t[edit.k], b = t[(edit.k + 1) % 3];
        switch (edit.kind) {
            case Edit::Kind::Flip:
                return mesh_.flip(edit.face, edit.k);
            case Edit::Kind::ToSecond:
                return mesh_.collapse(a, b);
            case Edit::Kind::ToFirst:
                return mesh_.collapse(b, a);
            case Edit::Kind::Split:
                break;
        }
        if ((mesh_.at(a) - mesh_.at(b)).norm() < 2 * least_edge * mesh_.mean_length()) return false;
        const Index added = mesh_.split(edit.face, edit.k);
        return added != no_index && mesh_.put_offset(added, Vec3::Zero());
    }

    static constexpr int no_edit = 2;

    EditedMesh& mesh_;
    EditGuard guard_;
    ShapeSteps steps_;
    SpareVertices spare_;
    std::size_t edits_left_ = most_edits;
    std::vector<std::pair<Index, Index>> in_vain_;  // Pairs that no edit parts.
};

}  // namespace

std::vector<Index> repair_crossings(const detail::MeshCurves& curves,
                                    std::span<const Mobility> mobility,
                                    std::span<const std::pair<Index, Index>> pairs,
                                    PlacedMesh& mesh, const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> numbers;
    EditedMesh edited(curves, mesh, mobility);
    const EditedMesh::Mark start = edited.mark();
    if (!PairRepair(edited, curves.whole(), ticker).run(pairs)) return numbers;
    if (edited.mark().faces > start.faces) mesh = edited.result(numbers);
    return numbers;
}

}  // namespace remesh
