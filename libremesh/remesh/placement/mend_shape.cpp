// Mends bad triangles, the worst first: by a flip or slides, otherwise by the best collapse or
// split. Collapses leave spare vertices, splits need some. At the end the count is balanced: spare
// vertices split long edges, missing ones are collapsed where triangles are good.
#include "remesh/placement/mend_shape.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "agvd/core/poller.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/placement/slide_steps.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Triangle;
using agvd::Vec3;
using detail::EditedMesh;
using detail::Mobility;

struct Goal {
    double quality;  // Triangles below it are mended.
    // Least quality of triangles, before and after, where a vertex is removed to balance the count.
    double elsewhere;
};
// Met one after the other: the worst triangles first have all the vertices that can be spared. As
// qualities, angles of 21.3 and 29.1 degrees count as .425 and .57.
constexpr std::array goals{Goal{0.425, 0.6}, Goal{0.57, 0.63}};
// Least gain of a step, and of a trial of several steps.
constexpr double least_step_gain = 1e-3, least_trial_gain = 0.02;
// At most one of so many vertices may be missing: a surface that is thinner than the spacing
// everywhere has no place to take them from.
constexpr agvd::Index most_moved = 8;
// Budgets for each initially bad triangle: where all are bad, work would not end. Lips use half of
// them.
constexpr std::size_t edits_for_each = 3, slides_for_each = 200;
// This many bad triangles get the whole budget; each further one gets fewer slides. Organic meshes
// have at most some 20 bad triangles. Thin walls have over a thousand, which took 40 s on a mesh of
// 4418 faces.
constexpr std::size_t paid_in_full = 64, slides_for_others = 25;
// A slide takes some 16 steps of at most an edge's length. Where its walks cross more edges of the
// surface than these would on faces of even size, or more than the least number, it counts as
// several slides. At spikes walks run around for ever: without this a mesh of 13 faces took 14 s.
constexpr double steps_of_slide = 16;
constexpr std::size_t least_crossings = 100;
// A slide ends when it counts as so many more.
constexpr std::size_t most_more = 20;
constexpr int most_mend_rounds = 6, most_sweeps = 3;

class Mender {
public:
    // \param num_faces  of the surface.
    Mender(EditedMesh& mesh, Index num_faces, const Goal& goal, agvd::Ticker& ticker)
        : mesh_(mesh),
          ticker_(ticker),
          goal_(goal),
          crossings_of_slide_(std::max(
              least_crossings,
              static_cast<std::size_t>(steps_of_slide * std::sqrt(static_cast<double>(num_faces) /
                                                                  mesh.num_vertices())))),
          least_spare_(-static_cast<int>(mesh.num_vertices() / most_moved)) {}

    // First balances the count at the end, when the number of missing vertices is known: it is
    // below the number of splits. If that fails, starts again and removes a vertex after each
    // split.
    //
    // \return whether the mesh has changed; it does not if the count cannot be kept.
    bool run() {
        const EditedMesh::Mark start = mesh_.mark();
        const std::size_t num_bad = bad_faces().size();
        // Where nearly all triangles are bad, as on spikes, mending gains nothing. Without this
        // limit a mesh of 3492 faces took 80 s.
        const std::size_t num_paid =
            std::min(num_bad, std::max(mesh_.num_faces() - num_bad, paid_in_full));
        const std::size_t num_full = std::min(num_paid, paid_in_full);
        const std::size_t num_slides =
            slides_for_each * num_full + slides_for_others * (num_paid - num_full);
        for (const bool pays_at_once : {false, true}) {
            pays_at_once_ = pays_at_once;
            has_collapses_ = false;
            collapses_.clear();
            num_spare_ = 0;
            edits_left_ = edits_for_each * num_paid;
            slides_left_ = num_slides;
            elsewhere_ = pays_at_once ? goal_.quality + least_trial_gain : goal_.elsewhere;
            const bool is_changed = work();
            slides_left_ = num_slides;
            if (num_spare_ < 0) prune();
            while (num_spare_ > 0 && take_spare()) {
            }
            while (num_spare_ < 0 && give_spare()) {
            }
            if (num_spare_ == 0) return is_changed;
            mesh_.take_back(start);
        }
        return false;
    }

private:
    bool work() {
        bool is_changed = false;
        for (int round = 0; round < most_mend_rounds; ++round) {
            bool is_better = false;
            for (const auto& [quality, f] : bad_faces()) {
                if (!is_bad(f)) continue;
                is_better = mend(f) || is_better;
            }
            if (!is_better) break;
            is_changed = true;
        }
        return is_changed;
    }

    // Removes boundary vertices whose worst triangle lies between goal_.quality and elsewhere_, if
    // all triangles keep goal_.quality.
    void prune() {
        for (Index v = 0; v < mesh_.num_vertices() && num_spare_ < 0; ++v) {
            if (mesh_.mobility(v) != Mobility::Boundary || mesh_.faces_at(v).empty()) continue;
            const double worst = mesh_.worst_at(v);
            if (worst < goal_.quality || worst >= elsewhere_) continue;
            for (const Index into : mesh_.hard_neighbours(v)) {
                if (into == no_index) continue;
                const EditedMesh::Mark before = mesh_.mark();
                if (mesh_.collapse(v, into)) {
                    relax(before);
                    if (worst_since(before) >= goal_.quality) {
                        ++num_spare_;
                        break;
                    }
                }
                mesh_.take_back(before);
            }
        }
    }

    struct Trial {
        Index face = no_index, k = 0;
        bool is_split = false, is_reversed = false;
    };

    [[nodiscard]] bool is_bad(Index f) const {
        const EditedMesh::Face& face = mesh_.face(f);
        // A well-shaped face that points against the surface is none.
        const double shape = face.quality < 0 ? face.quality + 1 : face.quality;
        return face.is_there && shape < goal_.quality &&
               std::any_of(face.corner.begin(), face.corner.end(),
                           [&](Index v) { return mesh_.mobility(v) != Mobility::Fixed; });
    }

    [[nodiscard]] std::vector<std::pair<double, Index>> bad_faces() const {
        std::vector<std::pair<double, Index>> bad;
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            if (is_bad(f)) bad.emplace_back(mesh_.face(f).quality, f);
        }
        std::sort(bad.begin(), bad.end());
        return bad;
    }

    bool mend(Index f) {
        const EditedMesh::Mark before = mesh_.mark();
        if (improve(f)) {
            relax(before);
            if (!is_bad(f)) return true;
        }
        const bool is_better = mesh_.mark().faces > before.faces;
        return try_edits(f) || is_better;
    }

    // Takes a step that makes the worst triangle it touches better.
    bool improve(Index f) {
        ticker_.tick(200);
        for (Index k = 0; k < 3; ++k) {
            if (try_flip(f, k)) return true;
        }
        const Triangle corners = mesh_.face(f).corner;
        bool is_better = false;
        for (const Index v : corners) is_better = slide(v) || is_better;
        return is_better;
    }

    bool try_flip(Index f, Index k) {
        const EditedMesh::Mark before = mesh_.mark();
        if (!mesh_.flip(f, k)) return false;
        if (gain_since(before).worst > least_step_gain) return true;
        mesh_.take_back(before);
        return false;
    }

    // The gain of the triangles touched since, each counted up to goal_.quality.
    struct Gain {
        double worst = 0, sum = 0;
        bool is_all = false;  // All have goal_.quality.
    };

    [[nodiscard]] Gain gain_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        Gain gain;
        double worst_before = goal_.quality, worst_now = goal_.quality;
        for (const double quality : before_) {
            gain.sum += std::max(goal_.quality - quality, 0.0);
            worst_before = std::min(worst_before, quality);
        }
        for (const Index f : changed_) {
            gain.sum -= std::max(goal_.quality - mesh_.face(f).quality, 0.0);
            worst_now = std::min(worst_now, mesh_.face(f).quality);
        }
        gain.worst = worst_now - worst_before;
        gain.is_all = worst_now >= goal_.quality;
        return gain;
    }

    // The score of a trial; 0: no gain. Collapses that mend all triangles come first, since they
    // leave a spare vertex; then splits. Splits count by their sum, since in a chain of equal
    // triangles no worst one improves alone. Other collapses count by the worst triangle: they
    // remove faces, which distorts the sum.
    [[nodiscard]] static double score_of(const Gain& gain, bool is_split) {
        if (gain.worst < 0 || gain.sum < least_trial_gain) return 0;
        if (is_split) return 1 + gain.sum;
        if (gain.is_all) return 100 + gain.sum;
        return gain.worst < least_trial_gain ? 0 : gain.worst;
    }

    // The lowest quality of the triangles touched since.
    [[nodiscard]] double worst_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        double worst = 1;
        for (const Index f : changed_) worst = std::min(worst, mesh_.face(f).quality);
        return worst;
    }

    // Directions in which a vertex may go, and the mean length of the edges around it.
    struct Ways {
        std::vector<Vec3> steps;  // Unit.
        Vec3 to_mean = Vec3::Zero();
        double length = 0;
    };

    [[nodiscard]] Ways ways_of(Index v) const {
        Ways ways;
        Vec3 normal = Vec3::Zero();
        const bool is_free = mesh_.mobility(v) == Mobility::Free;
        double count = 0;
        for (const Index f : mesh_.faces_at(v)) {
            const EditedMesh::Face& face = mesh_.face(f);
            const auto& [a, b, c] = face.corner;
            normal += (mesh_.at(b) - mesh_.at(a)).cross(mesh_.at(c) - mesh_.at(a));
            for (Index k = 0; k < 3; ++k) {
                const Index from = face.corner[k], to = face.corner[(k + 1) % 3];
                if (from != v && to != v) continue;
                const Vec3 way = mesh_.at(from == v ? to : from) - mesh_.at(v);
                ways.to_mean += way;
                ways.length += way.norm();
                ++count;
                if (!is_free && (face.hard >> k & 1U) != 0 && way.norm() > 0) {
                    ways.steps.push_back(way.normalized());
                }
            }
        }
        if (!(count > 0) || !(normal.norm() > 0)) return ways;
        ways.to_mean /= count;
        ways.length /= count;
        if (!is_free) return ways;
        detail::add_directions(normal, ways.steps);
        return ways;
    }

    bool slide(Index v) {
        if (mesh_.mobility(v) == Mobility::Fixed || slides_left_ == 0) return false;
        --slides_left_;
        const Ways ways = ways_of(v);
        if (ways.steps.empty()) return false;
        const std::size_t start = mesh_.num_crossings();
        const auto num_more = [&] { return (mesh_.num_crossings() - start) / crossings_of_slide_; };
        const auto move = [&](const Vec3& step) {
            if (num_more() >= most_more) return false;
            const std::size_t before = mesh_.num_crossings();
            const bool helps = mesh_.move(v, step, least_step_gain);
            ticker_.tick(mesh_.faces_at(v).size() + mesh_.num_crossings() - before);
            return helps;
        };
        const bool moves_to_mean = move(ways.to_mean);
        const bool takes_steps = detail::try_steps(ways.steps, ways.length, move);
        slides_left_ -= std::min(slides_left_, num_more());
        return moves_to_mean || takes_steps;
    }

    // Improves the bad triangles among those touched, as long as that helps.
    void relax(const EditedMesh::Mark& mark) {
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            mesh_.changed_since(mark, changed_, before_);
            std::vector<std::pair<double, Index>> bad;
            for (const Index f : changed_) {
                if (is_bad(f)) bad.emplace_back(mesh_.face(f).quality, f);
            }
            std::sort(bad.begin(), bad.end());
            bool is_better = false;
            for (const auto& [quality, f] : bad) {
                if (is_bad(f)) is_better = improve(f) || is_better;
            }
            if (!is_better) return;
        }
    }

    // Collapses first, the shortest edge first; then splits, the longest first.
    [[nodiscard]] std::array<Trial, 9> trials_at(Index f) const {
        const Triangle& t = mesh_.face(f).corner;
        std::array<std::pair<double, Index>, 3> edges;
        for (Index k = 0; k < 3; ++k) {
            edges[k] = {(mesh_.at(t[k]) - mesh_.at(t[(k + 1) % 3])).norm(), k};
        }
        std::sort(edges.begin(), edges.end());
        std::array<Trial, 9> trials;
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
        Trial best;
        double most = 0;
        for (const Trial& trial : trials_at(f)) {
            const EditedMesh::Mark before = mesh_.mark();
            const bool is_done = edit(trial);
            const Gain gain = is_done ? gain_since(before) : Gain{};
            mesh_.take_back(before);
            const double score = is_done ? score_of(gain, trial.is_split) : 0;
            if (!(score > most)) continue;
            most = score;
            best = trial;
            if (gain.is_all) break;
        }
        if (best.face == no_index || (best.is_split && num_spare_ <= least_spare_)) return false;
        const EditedMesh::Mark before = mesh_.mark();
        (void)edit(best);
        if (!best.is_split) {
            ++num_spare_;
            return true;
        }
        --num_spare_;
        if (!pays_at_once_ || num_spare_ >= 0 || give_spare()) return true;
        ++num_spare_;
        mesh_.take_back(before);
        return false;
    }

    bool edit(const Trial& trial) {
        const EditedMesh::Mark before = mesh_.mark();
        const Triangle& t = mesh_.face(trial.face).corner;
        const Index a = t[trial.k], b = t[(trial.k + 1) % 3];
        if (trial.is_split) {
            if (mesh_.split(trial.face, trial.k) == no_index) return false;
        } else if (!mesh_.collapse(trial.is_reversed ? b : a, trial.is_reversed ? a : b)) {
            return false;
        }
        relax(before);
        return true;
    }

    // Removes a vertex where triangles stay good.
    bool give_spare() {
        if (!has_collapses_) list_collapses();
        while (!collapses_.empty()) {
            const auto [quality, gone, into] = collapses_.back();
            collapses_.pop_back();
            if (mesh_.faces_at(gone).empty() || mesh_.faces_at(into).empty()) continue;
            const EditedMesh::Mark before = mesh_.mark();
            if (mesh_.worst_at(gone) >= elsewhere_ && mesh_.collapse(gone, into)) {
                (void)mesh_.move(into, ways_of(into).to_mean, 0);
                relax(before);
                if (worst_since(before) >= elsewhere_) {
                    ++num_spare_;
                    return true;
                }
            }
            mesh_.take_back(before);
        }
        return false;
    }

    struct Candidate {
        double quality;
        Index gone, into;
        [[nodiscard]] bool operator<(const Candidate& other) const {
            return std::tie(quality, gone, into) < std::tie(other.quality, other.gone, other.into);
        }
    };

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
                if (quality >= goal_.quality) collapses_.push_back({quality, a, b});
            }
        }
        std::sort(collapses_.begin(), collapses_.end());
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
    bool take_spare() {
        std::vector<std::pair<double, std::pair<Index, Index>>> longest;
        for (Index f = 0; f < mesh_.num_faces(); ++f) {
            const EditedMesh::Face& face = mesh_.face(f);
            if (!face.is_there) continue;
            for (Index k = 0; k < 3; ++k) {
                const Index a = face.corner[k], b = face.corner[(k + 1) % 3];
                if (a < b) {
                    longest.push_back({-(mesh_.at(a) - mesh_.at(b)).squaredNorm(), {f, k}});
                }
            }
        }
        std::sort(longest.begin(), longest.end());
        for (const auto& [length, edge] : longest) {
            const EditedMesh::Mark before = mesh_.mark();
            if (edit({edge.first, edge.second, true, false}) &&
                worst_since(before) >= goal_.quality) {
                --num_spare_;
                return true;
            }
            mesh_.take_back(before);
        }
        return false;
    }

    EditedMesh& mesh_;
    agvd::Ticker& ticker_;
    const Goal goal_;
    const std::size_t crossings_of_slide_;
    const int least_spare_;
    bool pays_at_once_ = false;
    int num_spare_ = 0;  // Vertices removed and not yet added elsewhere; below 0: to be removed.
    bool has_collapses_ = false;
    std::vector<Candidate> collapses_;  // The best one last.
    double elsewhere_ = 0;              // Least quality where vertices are removed.
    std::size_t edits_left_ = 0, slides_left_ = 0;
    std::vector<Index> changed_;  // Scratch.
    std::vector<double> before_;  // Scratch.
};

}  // namespace

namespace {

// Whether a goal finds a triangle to mend: cheaper to tell without an EditedMesh.
bool has_bad_triangle(const agvd::Surface& surface, std::span<const Mobility> mobility,
                      const PlacedMesh& mesh, agvd::Ticker& ticker) {
    const agvd::MeshView view = surface.mesh.view();
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

std::vector<Index> mend_shape(const agvd::Surface& surface, std::span<const Mobility> mobility,
                              std::span<const DirectedEdge> hard, PlacedMesh& mesh,
                              const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
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
