//! \file
//! Steps that improve the triangles of an edited mesh, and what they gain. Private to
//! repair_shape().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

//! An edit of the edge from corner k of a face to the next: it is collapsed to its second end, or
//! to its first one, or split at the foot of the third corner; or it lies on a curve and that
//! corner goes to the foot.
struct ShapeEdit {
    enum class Kind : std::uint8_t { ToSecond, ToFirst, Split, Press };

    Index face = no_index, k = 0;
    Kind kind = Kind::ToSecond;

    //! Of the number of vertices that it leaves to spare.
    [[nodiscard]] int change() const {
        return kind == Kind::Split ? -1 : kind == Kind::Press ? 0 : 1;
    }
};

//! The gain of the triangles touched since a mark.
struct ShapeGain {
    double worst = 0;  //!< Of the worst one, counted up to the wanted quality.
    //! By how much the sum of harm_of() has fallen, or that of the worst one: an edit may add
    //! faces.
    double worth = 0;
    //! Above 0 if the triangles are better in the order of their quality, up to the wanted one: the
    //! worst first, and the next ones where that has hardly changed. A chain of equal triangles
    //! gets better one by one that way, and two slivers may become one. With bounds no more
    //! triangles may exceed them than before.
    double score = 0;
};

//! What a triangle of some quality is worth to be rid of: much if it is bad, nothing if it is good
//! enough.
[[nodiscard]] inline double harm_of(double quality) {
    constexpr double enough = 0.75;  // An angle of 39.8 degrees.
    const double missing = std::max(enough - quality, 0.0);
    return missing * missing * missing;
}

//! Improves triangles below a wanted quality by flips and slides, and keeps a budget of slides.
class ShapeSteps {
public:
    //! \param mesh, ticker  outlive this.
    //! \param num_faces     of the surface: small faces make slides long.
    //! \param wanted        triangles below this shape_quality() are bad.
    ShapeSteps(EditedMesh& mesh, Index num_faces, double wanted, Ticker& ticker)
        : mesh_(mesh),
          ticker_(ticker),
          wanted_(wanted),
          crossings_of_slide_(std::max(
              least_crossings,
              static_cast<std::size_t>(steps_of_slide * std::sqrt(static_cast<double>(num_faces) /
                                                                  mesh.num_vertices())))) {}

    //! From now on at most so many slides are done. Initially none.
    void allow_slides(std::size_t count) { slides_left_ = count; }

    //! Whether a face is there, below the wanted quality, and has a vertex that may move.
    [[nodiscard]] bool is_bad(Index f) const {
        const EditedMesh::Face& face = mesh_.face(f);
        return face.is_there && mesh_.shape_of(f) < wanted_ &&
               std::any_of(face.corner.begin(), face.corner.end(),
                           [&](Index v) { return mesh_.mobility(v) != Mobility::Fixed; });
    }
    //! The bad faces with their qualities, the worst first.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_faces() const {
        return bad_among(mesh_.faces());
    }
    [[nodiscard]] ShapeGain gain_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        ShapeGain gain;
        now_.clear();
        for (const double quality : before_) gain.worth += harm(quality);
        for (const Index f : changed_) now_.push_back(mesh_.face(f).quality);
        for (const double quality : now_) gain.worth -= harm(quality);
        const auto sort = [&](std::vector<double>& qualities, std::size_t count) {
            for (double& quality : qualities) quality = std::min(quality, wanted_);
            qualities.resize(count, wanted_);
            std::sort(qualities.begin(), qualities.end());
        };
        const std::size_t count = std::max({before_.size(), now_.size(), std::size_t{1}});
        sort(before_, count);
        sort(now_, count);
        gain.worth = std::max(gain.worth, harm(before_[0]) - harm(now_[0]));
        gain.worst = now_[0] - before_[0];
        const auto num_bad = [&](std::span<const double> sorted) {
            return std::ranges::lower_bound(sorted, wanted_) - sorted.begin();
        };
        if (mesh_.has_bounds() && num_bad(now_) > num_bad(before_)) return gain;
        for (std::size_t rank = 0; rank < count; ++rank) {
            const double change = now_[rank] - before_[rank];
            if (std::abs(change) < least_gain()) continue;
            gain.score =
                now_[0] < wanted_ ? change / static_cast<double>(1 + rank) : all_good + gain.worth;
            break;
        }
        return gain;
    }
    //! The lowest quality of the triangles touched since.
    [[nodiscard]] double worst_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        double worst = 1;
        for (const Index f : changed_) worst = std::min(worst, mesh_.face(f).quality);
        return worst;
    }

    //! Whether none of the triangles touched since is below a quality, or the worst one before.
    [[nodiscard]] bool keeps_quality(const EditedMesh::Mark& mark, double least) {
        mesh_.changed_since(mark, changed_, before_);
        for (const double quality : before_) least = std::min(least, quality);
        return std::ranges::all_of(changed_,
                                   [&](Index f) { return mesh_.face(f).quality >= least; });
    }

    //! Takes a step that makes the worst triangle it touches better.
    //! \return false if there is none.
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
    //! Improves the bad triangles among those touched since, as long as that helps.
    void relax(const EditedMesh::Mark& mark) {
        for (int sweep = 0; sweep < most_sweeps; ++sweep) {
            mesh_.changed_since(mark, changed_, before_);
            bool is_better = false;
            for (const auto& [quality, f] : bad_among(changed_)) {
                if (is_bad(f)) is_better = improve(f) || is_better;
            }
            if (!is_better) return;
        }
    }
    //! \return false if the edge cannot be edited; the mesh has not changed then.
    bool edit(const ShapeEdit& edit) {
        const Triangle& t = mesh_.face(edit.face).corner;
        const Index a = t[edit.k], b = t[(edit.k + 1) % 3];
        if (edit.kind == ShapeEdit::Kind::ToSecond) return mesh_.collapse(a, b);
        if (edit.kind == ShapeEdit::Kind::ToFirst) return mesh_.collapse(b, a);
        const Index apex = t[(edit.k + 2) % 3];
        const Vec3 along = mesh_.at(b) - mesh_.at(a);
        if (!(along.squaredNorm() > 0)) return false;
        const double foot = along.dot(mesh_.at(apex) - mesh_.at(a)) / along.squaredNorm();
        if (edit.kind == ShapeEdit::Kind::Split) {
            return mesh_.split(edit.face, edit.k, foot) != no_index;
        }
        if (!mesh_.face(edit.face).is_hard(edit.k)) return false;
        const EditedMesh::Mark before = mesh_.mark();
        const Index added = mesh_.split(edit.face, edit.k, foot);
        if (added != no_index && mesh_.collapse(apex, added)) return true;
        mesh_.take_back(before);
        return false;
    }
    //! Moves a vertex towards the mean of its neighbours if no triangle around it gets worse.
    bool move_to_mean(Index v) { return mesh_.move(v, ways_of(v).to_mean, 0); }

private:
    // Of a step and of an edit. Where bounds count, the last bit may keep them.
    [[nodiscard]] double least_step_gain() const { return mesh_.has_bounds() ? 1e-7 : 1e-3; }
    [[nodiscard]] double least_gain() const { return mesh_.has_bounds() ? 1e-7 : 0.02; }
    // A bound that is exceeded is as bad as an angle of 14 degrees.
    [[nodiscard]] double harm(double quality) const {
        constexpr double harm_of_breach = 0.1;
        if (!mesh_.has_bounds()) return harm_of(quality);
        return quality < low_quality ? harm_of_breach + harm_of(quality)
                                     : harm_of(ShapeMeasure::shape_within_bounds(quality));
    }
    // The least score of edits that leave no bad triangle.
    static constexpr double all_good = 100;
    // A slide takes some 16 steps of an edge's length at most; where its walks cross more edges
    // than usual, as around spikes, it counts as several.
    static constexpr double steps_of_slide = 16;
    static constexpr std::size_t least_crossings = 100;
    // A slide ends when it counts as so many more.
    static constexpr std::size_t most_more = 20;
    static constexpr int most_sweeps = 3;

    // Directions in which a vertex may go, and the mean length of the edges around it.
    struct Ways {
        std::vector<Vec3> steps;  // Unit.
        Vec3 to_mean = Vec3::Zero();
        double length = 0;
    };

    // The bad ones of some faces, the worst first.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_among(
        std::span<const Index> faces) const {
        std::vector<std::pair<double, Index>> bad;
        for (const Index f : faces) {
            if (is_bad(f)) bad.emplace_back(mesh_.face(f).quality, f);
        }
        std::sort(bad.begin(), bad.end());
        return bad;
    }
    [[nodiscard]] Ways ways_of(Index v) const {
        Ways ways;
        Vec3 normal = Vec3::Zero();
        const bool is_free = mesh_.mobility(v) == Mobility::Free;
        double count = 0;
        for (const Index f : mesh_.faces_at(v)) {
            const EditedMesh::Face& face = mesh_.face(f);
            normal += mesh_.normal_of(f);
            for (Index k = 0; k < 3; ++k) {
                const Index from = face.corner[k], to = face.corner[(k + 1) % 3];
                if (from != v && to != v) continue;
                const Vec3 way = mesh_.at(from == v ? to : from) - mesh_.at(v);
                ways.to_mean += way;
                ways.length += way.norm();
                ++count;
                if (!is_free && face.is_hard(k) && way.norm() > 0) {
                    ways.steps.push_back(way.normalized());
                }
            }
        }
        if (!(count > 0) || !(normal.norm() > 0)) return ways;
        ways.to_mean /= count;
        ways.length /= count;
        if (!is_free) return ways;
        add_directions(normal, ways.steps);
        return ways;
    }
    bool try_flip(Index f, Index k) {
        const EditedMesh::Mark before = mesh_.mark();
        if (!mesh_.flip(f, k)) return false;
        if (gain_since(before).worst > least_step_gain()) return true;
        mesh_.take_back(before);
        return false;
    }
    bool slide(Index v) {
        if (mesh_.mobility(v) >= Mobility::Node || slides_left_ == 0) return false;
        --slides_left_;
        const Ways ways = ways_of(v);
        if (ways.steps.empty()) return false;
        const std::size_t start = mesh_.num_crossings();
        const auto num_more = [&] { return (mesh_.num_crossings() - start) / crossings_of_slide_; };
        const auto move = [&](const Vec3& step) {
            if (num_more() >= most_more) return false;
            const std::size_t before = mesh_.num_crossings();
            const bool helps = mesh_.move(v, step, least_step_gain());
            ticker_.tick(mesh_.faces_at(v).size() + mesh_.num_crossings() - before);
            return helps;
        };
        const bool moves_to_mean = move(ways.to_mean);
        const bool takes_steps = try_steps(ways.steps, ways.length, move);
        slides_left_ -= std::min(slides_left_, num_more());
        return moves_to_mean || takes_steps;
    }

    EditedMesh& mesh_;
    Ticker& ticker_;
    const double wanted_;
    const std::size_t crossings_of_slide_;
    std::size_t slides_left_ = 0;
    std::vector<Index> changed_;        // Scratch.
    std::vector<double> before_, now_;  // Scratch.
};

}  // namespace remesh::detail
