// A change takes sites out of the search for bounds, mends the gaps, and puts sites in. Then it
// finds the sites that lie where another one does, and the bounds that are others now. Callers know
// sites by rank, which changes with every removal; numbers stay, so that stored relays need no
// renaming.
#include "agvd/update/numbered_sites.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/check_sites.h"
#include "agvd/mesh/point_faces.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {

NumberedSites::NumberedSites(const Surface& surface, const SurfaceLayout& layout, int num_threads)
    : surface_(surface),
      search_(surface, layout, num_threads),
      bounds_(surface.num_vertices(), std::numeric_limits<float>::infinity()),
      starting_at_(surface.num_vertices()) {
    (void)search_.take_changes();
}

void NumberedSites::change(const SiteChanges& changes) {
    std::vector<SurfacePoint> points = changed_points(changes);
    starts_.clear();
    changed_faces_.clear();
    is_changed_.assign(sources_.size(), 0);
    for (const auto& [rank, point] : changes.moved) take_out(numbers_[rank]);
    for (const Index rank : changes.removed) {
        take_out(numbers_[rank]);
        sources_[numbers_[rank]].is_removed = true;
    }
    for (const Index v : search_.remove(is_changed_)) {
        for (const Index number : starting_at_[v]) search_.add(sources_[number].point, number);
    }
    for (const auto& [rank, point] : changes.moved) put_in(numbers_[rank], point);
    for (const SurfacePoint& point : changes.added) {
        sources_.emplace_back();
        is_changed_.push_back(1);
        put_in(count() - 1, point);
    }
    for (const Index v : starts_) find_repeats(starting_at_[v]);
    take_bounds();
    points_ = std::move(points);
    renumber();
}

std::vector<SurfacePoint> NumberedSites::changed_points(const SiteChanges& changes) const {
    const auto count = static_cast<Index>(points_.size());
    std::vector<bool> is_named(count, false);
    const auto name = [&](Index site) {
        if (site >= count || is_named[site]) {
            throw InvalidInput("site " + std::to_string(site) +
                               (site >= count ? " does not exist; use one of the " +
                                                    std::to_string(count) + " sites, counted from 0"
                                              : " is changed twice; name it once"));
        }
        is_named[site] = true;
    };
    std::vector<SurfacePoint> points = points_;
    for (const auto& [site, point] : changes.moved) {
        name(site);
        points[site] = point;
    }
    for (const Index site : changes.removed) name(site);
    std::vector<bool> is_removed(count, false);
    for (const Index site : changes.removed) is_removed[site] = true;
    std::vector<SurfacePoint> result;
    for (Index s = 0; s < count; ++s) {
        if (!is_removed[s]) result.push_back(points[s]);
    }
    result.insert(result.end(), changes.added.begin(), changes.added.end());
    check_sites(surface_, result);
    return result;
}

void NumberedSites::take_out(Index number) {
    const SurfacePoint& point = sources_[number].point;
    is_changed_[number] = 1;
    num_placed_ -= is_placed(number) ? 1 : 0;
    add_faces_of(point);
    for (const Index v : search_.starts_of(point)) {
        std::erase(starting_at_[v], number);
        starts_.push_back(v);
    }
}

void NumberedSites::put_in(Index number, const SurfacePoint& point) {
    sources_[number].point = point;
    sources_[number].place = place_of(surface_, point);
    num_placed_ += is_placed(number) ? 1 : 0;
    add_faces_of(point);
    for (const Index v : search_.starts_of(point)) {
        std::vector<Index>& here = starting_at_[v];  // An edge names its ends twice.
        if (here.empty() || here.back() != number) here.push_back(number);
        starts_.push_back(v);
    }
    search_.add(point, number);
}

// Among sites that start at one vertex; those that lie on one another do.
void NumberedSites::find_repeats(std::vector<Index>& numbers) {
    std::sort(numbers.begin(), numbers.end(), [&](Index a, Index b) {
        return std::pair(sources_[a].place, a) < std::pair(sources_[b].place, b);
    });
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        Source& source = sources_[numbers[i]];
        const bool is_repeat = i > 0 && sources_[numbers[i - 1]].place == source.place;
        if (std::exchange(source.is_repeat, is_repeat) == is_repeat) continue;
        is_changed_[numbers[i]] = 1;
        add_faces_of(source.point);
    }
}

void NumberedSites::add_faces_of(const SurfacePoint& point) {
    changed_faces_.push_back(point.face.value());
    const auto half_edge = half_edge_of(point);
    if (half_edge && surface_.twin[*half_edge] != no_index) {
        changed_faces_.push_back(Surface::face(surface_.twin[*half_edge]));
    }
}

void NumberedSites::take_bounds() {
    search_.run();
    changed_bounds_.clear();
    for (const Index v : search_.take_changes()) {
        if (bounds_[v] == search_.distance(v)) continue;
        bounds_[v] = search_.distance(v);
        changed_bounds_.push_back(v);
    }
}

void NumberedSites::renumber() {
    new_ranks_.assign(numbers_.size(), SiteId());
    const std::vector<Index> old_numbers = std::exchange(numbers_, {});
    ranks_.assign(sources_.size(), no_index);
    for (Index n = 0; n < sources_.size(); ++n) {
        if (sources_[n].is_removed) continue;
        ranks_[n] = static_cast<Index>(numbers_.size());
        numbers_.push_back(n);
    }
    for (Index rank = 0; rank < old_numbers.size(); ++rank) {
        const Index now = ranks_[old_numbers[rank]];
        if (now != no_index) new_ranks_[rank] = SiteId(now);
    }
}

}  // namespace agvd
