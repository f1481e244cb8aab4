// Mends bad triangles, the worst first: by a flip or slides, otherwise by the best collapse or
// split. Collapses leave spare vertices, splits need some. At the end the count is balanced: spare
// vertices split long edges, missing ones are collapsed where triangles are good.
#include "remesh/placement/mend_shape.h"

#include <algorithm>

#include "agvd/core/progress.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/placement/spare_vertices.h"

namespace remesh {
namespace {

using detail::EditedMesh;
using detail::Mobility;
using detail::ShapeEdit;
using detail::ShapeGain;

struct Goal {
    double quality;  // Triangles below it are mended.
    // Least quality of triangles, before and after, where a vertex is removed to balance the count.
    double elsewhere;
};
// Met one after the other: the worst triangles first have all the vertices that can be spared. As
// qualities, angles of 21.3 and 29.1 degrees count as .425 and .57.
constexpr std::array goals{Goal{0.425, 0.6}, Goal{0.57, 0.63}};
// Least gain of an edit.
constexpr double least_trial_gain = 0.02;
// At most one of so many vertices may be missing: a surface that is thinner than the spacing
// everywhere has no place to take them from.
constexpr Index most_moved = 8;
// Budgets for each initially bad triangle: where all are bad, work would not end. Lips use half of
// them.
constexpr std::size_t edits_for_each = 3, slides_for_each = 200;
// This many bad triangles get the whole budget; each further one gets fewer slides. Organic meshes
// have at most some 20 bad triangles. Thin walls have over a thousand, which took 40 s on a mesh of
// 4418 faces.
constexpr std::size_t paid_in_full = 64, slides_for_others = 25;
constexpr int most_mend_rounds = 6;

class Mender {
public:
    // \param num_faces  of the surface.
    Mender(EditedMesh& mesh, Index num_faces, const Goal& goal, Ticker& ticker)
        : mesh_(mesh),
          goal_(goal),
          steps_(mesh, num_faces, goal.quality, ticker),
          spare_(mesh, steps_, goal.quality, ticker),
          least_spare_(-static_cast<int>(mesh.num_vertices() / most_moved)) {}

    // First balances the count at the end, when the number of missing vertices is known: it is
    // below the number of splits. If that fails, starts again and removes a vertex after each
    // split.
    //
    // \return whether the mesh has changed; it does not if the count cannot be kept.
    bool run() {
        const EditedMesh::Mark start = mesh_.mark();
        const std::size_t num_bad = steps_.bad_faces().size();
        // Where most triangles are bad, as on spikes, mending gains nothing. Without this limit a
        // mesh of 3492 faces took 80 s.
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
        for (int round = 0; round < most_mend_rounds; ++round) {
            bool is_better = false;
            for (const auto& [quality, f] : steps_.bad_faces()) {
                if (!steps_.is_bad(f)) continue;
                is_better = mend(f) || is_better;
            }
            if (!is_better) break;
            is_changed = true;
        }
        return is_changed;
    }

    bool mend(Index f) {
        const EditedMesh::Mark before = mesh_.mark();
        if (steps_.improve(f)) {
            steps_.relax(before);
            if (!steps_.is_bad(f)) return true;
        }
        const bool is_better = mesh_.mark().faces > before.faces;
        return try_edits(f) || is_better;
    }

    // The score of a trial; 0: no gain. Collapses that mend all triangles come first, since they
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

    // Applies the first collapse or split that mends all it touches, otherwise the best one.
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
    detail::ShapeSteps steps_;
    detail::SpareVertices spare_;
    const int least_spare_;
    bool pays_at_once_ = false;
    std::size_t edits_left_ = 0;
};

// Whether a goal finds a triangle to mend: cheaper to tell without an EditedMesh.
bool has_bad_triangle(const Surface& surface, std::span<const Mobility> mobility,
                      const PlacedMesh& mesh, Ticker& ticker) {
    const MeshView view = surface.mesh.view();
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        ticker.tick();
        const auto& [a, b, c] = t;
        return detail::shape_quality(mesh.position(view, a), mesh.position(view, b),
                                     mesh.position(view, c)) < goals.back().quality &&
               std::any_of(t.begin(), t.end(),
                           [&](Index v) { return mobility[v] != Mobility::Fixed; });
    });
}

}  // namespace

std::vector<Index> mend_shape(const Surface& surface, std::span<const Mobility> mobility,
                              std::span<const DirectedEdge> hard, PlacedMesh& mesh,
                              const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<Index> numbers;
    if (!has_bad_triangle(surface, mobility, mesh, ticker)) return numbers;
    EditedMesh edited(surface, mesh, mobility, hard);
    bool is_changed = false;
    for (const Goal& goal : goals) {
        is_changed = Mender(edited, surface.num_faces(), goal, ticker).run() || is_changed;
    }
    if (is_changed) mesh = edited.result(numbers);
    return numbers;
}

}  // namespace remesh
