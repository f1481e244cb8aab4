//! \file
//! Steps that improve the triangles of an edited mesh, and what they gain. Private to
//! repair_shape().
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "remesh/placement/edited_mesh.h"
#include "remesh/placement/shape_quality.h"

namespace remesh::detail {

//! An edit of the edge from corner k of a face to the next: it is collapsed to its second end, or
//! to its first one, or split; or it lies on a curve and the third corner goes there, between both.
struct ShapeEdit {
    enum class Kind : std::uint8_t { ToSecond, ToFirst, Split, Press };

    Index face = no_index, k = 0;
    Kind kind = Kind::ToSecond;

    //! Of the number of vertices that it leaves to spare.
    [[nodiscard]] int change() const {
        return kind == Kind::Split ? -1 : kind == Kind::Press ? 0 : 1;
    }
};

//! The gain of the triangles touched since a mark, each counted up to the wanted quality.
struct ShapeGain {
    double worst = 0, sum = 0;
    bool is_all = false;  //!< All have the wanted quality.
    double worth = 0;     //!< By how much the sum of harm_of() has fallen.
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
        // A well-shaped face that points against the surface is none.
        const double shape = face.quality < 0 ? face.quality + 1 : face.quality;
        return face.is_there && shape < wanted_ &&
               std::any_of(face.corner.begin(), face.corner.end(),
                           [&](Index v) { return mesh_.mobility(v) != Mobility::Fixed; });
    }
    //! The bad faces with their qualities, the worst first.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_faces() const {
        std::vector<Index> all(mesh_.num_faces());
        std::iota(all.begin(), all.end(), Index{0});
        return bad_among(all);
    }
    //! The same of those that have a corner in common with one of some faces.
    [[nodiscard]] std::vector<std::pair<double, Index>> bad_around(
        std::span<const Index> faces) const {
        std::vector<Index> around;
        for (const Index f : faces) {
            for (const Index v : mesh_.face(f).corner) {
                around.insert(around.end(), mesh_.faces_at(v).begin(), mesh_.faces_at(v).end());
            }
        }
        return bad_among(distinct(std::move(around)));
    }
    [[nodiscard]] ShapeGain gain_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        ShapeGain gain;
        double worst_before = wanted_, worst_now = wanted_;
        for (const double quality : before_) {
            gain.sum += std::max(wanted_ - quality, 0.0);
            gain.worth += harm_of(quality);
            worst_before = std::min(worst_before, quality);
        }
        for (const Index f : changed_) {
            gain.sum -= std::max(wanted_ - mesh_.face(f).quality, 0.0);
            gain.worth -= harm_of(mesh_.face(f).quality);
            worst_now = std::min(worst_now, mesh_.face(f).quality);
        }
        gain.worst = worst_now - worst_before;
        gain.is_all = worst_now >= wanted_;
        return gain;
    }
    //! The lowest quality of the triangles touched since.
    [[nodiscard]] double worst_since(const EditedMesh::Mark& mark) {
        mesh_.changed_since(mark, changed_, before_);
        double worst = 1;
        for (const Index f : changed_) worst = std::min(worst, mesh_.face(f).quality);
        return worst;
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
        if (edit.kind == ShapeEdit::Kind::Split) return mesh_.split(edit.face, edit.k) != no_index;
        const Index apex = t[(edit.k + 2) % 3];
        if (!mesh_.face(edit.face).is_hard(edit.k) || mesh_.mobility(apex) != Mobility::Free) {
            return false;
        }
        const EditedMesh::Mark before = mesh_.mark();
        const Index added = mesh_.split(edit.face, edit.k);
        if (added != no_index && mesh_.collapse(apex, added)) return true;
        mesh_.take_back(before);
        return false;
    }
    //! Moves a vertex towards the mean of its neighbours if no triangle around it gets worse.
    bool move_to_mean(Index v) { return mesh_.move(v, ways_of(v).to_mean, 0); }

private:
    static constexpr double least_step_gain = 1e-3;
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
            const auto& [a, b, c] = face.corner;
            normal += (mesh_.at(b) - mesh_.at(a)).cross(mesh_.at(c) - mesh_.at(a));
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
        if (gain_since(before).worst > least_step_gain) return true;
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
            const bool helps = mesh_.move(v, step, least_step_gain);
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
    std::vector<Index> changed_;  // Scratch.
    std::vector<double> before_;  // Scratch.
};

}  // namespace remesh::detail
