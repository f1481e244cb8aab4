//! \file
//! Sites that come, go and move: known by numbers that never change, with the bounds from them.
#pragma once

#include <span>
#include <vector>

#include "agvd/mesh/distinct_points.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/surface_layout.h"
#include "agvd/propagation/window_engine.h"
#include "agvd/update/site_changes.h"

namespace agvd {

//! The caller's indices are the ranks of the numbers among the sites that are left.
class NumberedSites {
public:
    //! \param surface, layout  outlive this; SurfaceLayout(surface).
    NumberedSites(const Surface& surface, const SurfaceLayout& layout, int num_threads);

    //! \throw InvalidInput  as MovingSites::update(); nothing has changed then.
    void change(const SiteChanges& changes);

    //! By rank.
    [[nodiscard]] const std::vector<SurfacePoint>& points() const { return points_; }
    [[nodiscard]] Index number(Index rank) const { return numbers_[rank]; }
    //! Not all of them lie at vertices.
    [[nodiscard]] bool has_placed() const { return num_placed_ > 0; }

    //! Numbers given so far, those of removed sites among them.
    [[nodiscard]] Index count() const { return static_cast<Index>(sources_.size()); }
    [[nodiscard]] const SurfacePoint& point(Index number) const { return sources_[number].point; }
    //! no_index: removed.
    [[nodiscard]] Index rank(Index number) const { return ranks_[number]; }
    //! Owns nothing: it is removed, or lies where an earlier one does.
    [[nodiscard]] bool owns_nothing(Index number) const {
        return sources_[number].is_removed || sources_[number].is_repeat;
    }
    //! In the order in which propagate() takes sites in.
    [[nodiscard]] bool comes_before(Index number, Index other) const {
        return runs_before(point(number).face, number, point(other).face, other);
    }

    //! #V: upper bounds for the distance from the nearest site.
    [[nodiscard]] std::span<const float> bounds() const { return bounds_; }

    //! By number: whose path a bound is; no_index: none.
    [[nodiscard]] Index site_of_bound(Index vertex) const { return search_.site(vertex); }

    // What the last change did.

    //! By number: 1 for the sites that came, went, moved, or began or ceased to own nothing.
    [[nodiscard]] const std::vector<std::uint8_t>& is_changed() const { return is_changed_; }
    //! The faces in which these lay and lie, in any order.
    [[nodiscard]] const std::vector<Index>& changed_faces() const { return changed_faces_; }
    //! The vertices that have another bound, in any order.
    [[nodiscard]] const std::vector<Index>& changed_bounds() const { return changed_bounds_; }
    //! By rank before the change; invalid: removed.
    [[nodiscard]] const std::vector<SiteId>& new_ranks() const { return new_ranks_; }

private:
    struct Source {
        SurfacePoint point;
        PlaceOnSurface place;
        bool is_removed = false;
        bool is_repeat = false;
    };

    [[nodiscard]] std::vector<SurfacePoint> changed_points(const SiteChanges& changes) const;
    [[nodiscard]] bool is_placed(Index number) const {
        return sources_[number].place.element >= surface_.num_vertices();
    }
    void take_out(Index number);
    void put_in(Index number, const SurfacePoint& point);
    void find_repeats(std::vector<Index>& numbers);
    void add_faces_of(const SurfacePoint& point);
    void take_bounds();
    void renumber();

    const Surface& surface_;
    BoundsSearch search_;
    std::vector<float> bounds_;
    std::vector<std::vector<Index>> starting_at_;  // #V: the sites whose paths start at a vertex.
    std::vector<Source> sources_;                  // By number.
    std::vector<Index> ranks_;                     // By number.
    std::vector<Index> numbers_;                   // By rank, as the next one.
    std::vector<SurfacePoint> points_;
    Index num_placed_ = 0;
    std::vector<Index> starts_;  // Of the sites that change, before and after.
    std::vector<std::uint8_t> is_changed_;
    std::vector<Index> changed_faces_;
    std::vector<Index> changed_bounds_;
    std::vector<SiteId> new_ranks_;
};

}  // namespace agvd
