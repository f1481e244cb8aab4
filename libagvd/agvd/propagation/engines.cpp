#include "agvd/propagation/engines.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/steiner/steiner_nodes.h"

namespace agvd {
namespace {

void check_steiner_options(const Surface& surface, std::size_t num_points,
                           const PropagationOptions& options) {
    if (options.steiner_points < 0 || options.steiner_points > max_steiner_points) {
        throw InvalidOption("the number of Steiner points per edge is " +
                            std::to_string(options.steiner_points) + "; use 0 to " +
                            std::to_string(max_steiner_points));
    }
    if (!(options.lambda > 0)) {
        throw InvalidOption("lambda is " + std::to_string(options.lambda) +
                            "; use a number above 0");
    }
    if (options.max_error && !options.shapes.empty()) {
        throw InvalidOption(
            "the Steiner engine certifies no error for lines and regions, which it takes for "
            "points; use the window engine or leave the maximal error out");
    }
    if (options.max_error && *options.max_error == 0) {
        throw InvalidOption(
            "the Steiner engine cannot be exact; use the window engine or an error above 0");
    }
    if (!NodeNumbers::suffice(surface, static_cast<Index>(options.steiner_points),
                              num_points + options.shapes.size())) {
        throw InvalidOption(
            "this mesh with " + std::to_string(options.steiner_points) +
            " Steiner points per edge needs more than 2^32 nodes; use fewer Steiner points");
    }
    if (!options.relay_faces.empty() || options.max_distance < infinity) {
        throw InvalidOption(
            "the Steiner engine keeps relays in mixed faces only, and goes everywhere; use the "
            "window engine for relay_faces and max_distance");
    }
}

void check_options(const Surface& surface, std::size_t num_points,
                   const PropagationOptions& options) {
    if (options.max_error && !(*options.max_error >= 0 && *options.max_error < 1)) {
        throw InvalidOption("the maximal error is " + std::to_string(*options.max_error) +
                            "; use a number from 0 (exact) to below 1");
    }
    if (!(options.max_distance >= 0)) {
        throw InvalidOption("the maximal distance is " + std::to_string(options.max_distance) +
                            "; use a number of 0 or more");
    }
    const std::vector<Index>& faces = options.relay_faces;
    if (!std::is_sorted(faces.begin(), faces.end()) ||
        (!faces.empty() && faces.back() >= surface.num_faces())) {
        throw InvalidOption(
            "relay_faces are not ascending faces of the mesh; sort them, and use "
            "numbers below " +
            std::to_string(surface.num_faces()));
    }
    if (options.engine == Engine::Steiner) check_steiner_options(surface, num_points, options);
}

// Sites are numbered over the points and the shapes.
void check_numbers(const SitePoints& points, std::size_t num_points,
                   const std::vector<SiteShape>& shapes) {
    if (points.site.empty() && shapes.empty()) return;
    std::vector<Index> sites;
    for (Index i = 0; i < num_points; ++i) sites.push_back(points.site_of(i));
    for (const SiteShape& shape : shapes) sites.push_back(shape.site);
    std::sort(sites.begin(), sites.end());
    Index next = 0;
    for (const Index site : sites) {
        if (site > next) {
            throw InvalidSites("site " + std::to_string(next) + " has no point, but site " +
                               std::to_string(sites.back()) +
                               " has; number the sites from 0 without gaps");
        }
        next = site + 1;
    }
}

void check_points(const SitePoints& points, std::size_t num_points) {
    for (const std::size_t size : {points.site.size(), points.start.size()}) {
        if (size == 0 || size == num_points) continue;
        throw InvalidOption("there are " + std::to_string(num_points) + " points, and " +
                            std::to_string(size) +
                            " sites or starts of them; give one for each point, or none");
    }
    for (std::size_t i = 0; i < points.start.size(); ++i) {
        if (points.start[i] >= 0 && points.start[i] < infinity) continue;
        throw InvalidSites("point " + std::to_string(i) + " starts at the distance " +
                           number_text(points.start[i]) +
                           "; use a number of 0 or more: adding one number to all starts changes "
                           "no cell");
    }
}

// The points that are propagated: of those at one place the one with the least start, then of the
// lowest site. In the order of their sites, so that ties between points are those between sites.
// None on a shape that starts no later: that is as near there, and owns the place.
std::vector<Index> points_that_count(const Surface& surface, std::span<const SurfacePoint> points,
                                     const PropagationOptions& options) {
    const SitePoints& roles = options.points;
    std::vector<Index> order;
    if (!options.shapes.empty()) {
        order = points_off_shapes(surface, points, roles.start, options.shapes);
    } else if (roles.site.empty() && roles.start.empty()) {
        return distinct_points(surface, points);
    } else {
        order.resize(points.size());
        std::iota(order.begin(), order.end(), Index{0});
    }
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return std::tuple(start_of(roles.start, a), roles.site_of(a), a) <
               std::tuple(start_of(roles.start, b), roles.site_of(b), b);
    });
    std::vector<Index> kept = take(order, distinct_points(surface, take(points, order)));
    std::sort(kept.begin(), kept.end(), [&](Index a, Index b) {
        return std::pair(roles.site_of(a), a) < std::pair(roles.site_of(b), b);
    });
    return kept;
}

// Leaves out the mixed faces whose relays and corners are of one site, unless they are asked for.
// \param lists    Propagation, or RetiredFaces.
// \param site_of  site_of(vertex), of corners of these faces.
template <typename Lists, typename SiteOf>
void drop_faces_of_one_site(const Surface& surface, std::span<const Index> asked_for,
                            const SiteOf& site_of, Lists& lists) {
    std::vector<Relay> relays;
    Index kept = 0;
    for (Index i = 0; i < lists.mixed_faces.size(); ++i) {
        const Index face = lists.mixed_faces[i];
        const auto [first, last] = lists.relay_ranges[i];
        const auto own = std::span(lists.relays).subspan(first, last - first);
        const auto& corners = surface.mesh.triangles[face];
        const SiteId site = site_of(corners[0]);
        const bool is_mixed =
            std::any_of(corners.begin(), corners.end(),
                        [&](Index v) { return site_of(v) != site; }) ||
            std::any_of(own.begin(), own.end(), [&](const Relay& r) { return r.site != site; });
        if (!is_mixed && !std::binary_search(asked_for.begin(), asked_for.end(), face)) continue;
        const auto begin = static_cast<Index>(relays.size());
        relays.insert(relays.end(), own.begin(), own.end());
        lists.mixed_faces[kept] = face;
        lists.relay_ranges[kept++] = {begin, static_cast<Index>(relays.size())};
    }
    lists.mixed_faces.resize(kept);
    lists.relay_ranges.resize(kept);
    lists.relays = std::move(relays);
}

// Whether points are sites.
bool are_plain(const PropagationOptions& options) {
    return options.points == SitePoints{} && options.shapes.empty();
}

// The points that the engines propagate, and the sites that these stand for. A point that lies on
// another one owns nothing, but its windows would run as far as those of the other.
class DistinctPoints {
public:
    // Checks the arguments of propagate().
    DistinctPoints(const Surface& surface, std::span<const SurfacePoint> sites,
                   const PropagationOptions& options)
        : given_(options), own_(options) {
        const SitePoints& roles = options.points;
        check_options(surface, sites.size(), options);
        check_generators(surface, sites, roles, options.shapes);
        kept_ = points_that_count(surface, sites, options);
        points_ = take(sites, kept_);
        are_all_ = are_plain(options) && kept_.size() == sites.size();
        own_.points = {};
        std::vector<double>& starts = own_.points.start;
        for (const Index point : kept_) starts.push_back(start_of(roles.start, point));
        for (const SiteShape& shape : options.shapes) starts.push_back(shape.start);
        const auto is_zero = [](double start) { return start == 0; };
        if (std::all_of(starts.begin(), starts.end(), is_zero)) starts.clear();
    }

    [[nodiscard]] std::span<const SurfacePoint> points() const { return points_; }
    // For an engine, which numbers the points, and the shapes behind them.
    [[nodiscard]] const PropagationOptions& options() const { return own_; }
    // The numbers are those of the sites.
    [[nodiscard]] bool are_all() const { return are_all_; }
    // Several of these may be one site.
    [[nodiscard]] bool are_grouped() const {
        return !given_.points.site.empty() || !given_.shapes.empty();
    }

    // From a number to its site.
    void rename(SiteId& site) const {
        if (!site.is_valid()) return;
        const Index i = site.value();
        site = SiteId(i < kept_.size() ? given_.points.site_of(kept_[i])
                                       : given_.shapes[i - kept_.size()].site);
    }

private:
    const PropagationOptions& given_;
    PropagationOptions own_;
    std::vector<Index> kept_;
    std::vector<SurfacePoint> points_;
    bool are_all_ = false;
};

// `run_windows` is the window engine.
template <typename Run>
Propagation propagate_distinct(const Surface& surface, std::span<const SurfacePoint> sites,
                               const PropagationOptions& options, const Run& run_windows) {
    const DistinctPoints distinct(surface, sites, options);
    Propagation result = options.engine == Engine::Steiner
                             ? propagate_steiner(surface, distinct.points(), distinct.options())
                             : run_windows(distinct.points(), distinct.options());
    if (distinct.are_all()) return result;
    for (SiteId& site : result.vertex_site) distinct.rename(site);
    for (Relay& relay : result.relays) distinct.rename(relay.site);
    if (distinct.are_grouped()) {
        const auto site_of = [&](Index v) { return result.vertex_site[v]; };
        drop_faces_of_one_site(surface, options.relay_faces, site_of, result);
    }
    result.shapes = options.shapes;
    result.site_of_point = sites_of_points(options, sites.size());
    result.start_of_point = options.points.start;
    return result;
}

}  // namespace

void check_generators(const Surface& surface, std::span<const SurfacePoint> sites,
                      const SitePoints& roles, const std::vector<SiteShape>& shapes) {
    check_sites(surface, sites);
    check_points(roles, sites.size());
    check_shapes(surface, shapes);
    check_numbers(roles, sites.size(), shapes);
}

std::vector<Index> all_faces(const Surface& surface) {
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), Index{0});
    return faces;
}

std::optional<Index> mixed_index_of(const Propagation& propagation, Index face) {
    const auto& mixed = propagation.mixed_faces;
    const auto found = std::lower_bound(mixed.begin(), mixed.end(), face);
    if (found == mixed.end() || *found != face) return std::nullopt;
    return static_cast<Index>(found - mixed.begin());
}

const char* engine_name(Engine engine) { return engine == Engine::Steiner ? "steiner" : "window"; }

Propagation propagate(const Surface& surface, std::span<const SurfacePoint> sites,
                      const PropagationOptions& options) {
    return propagate_distinct(
        surface, sites, options,
        [&](std::span<const SurfacePoint> points, const PropagationOptions& own) {
            SurfaceLayout layout(surface, options.num_threads, within(options.progress, 0, 0));
            return propagate_windows(surface, std::move(layout), points, own);
        });
}

Propagation propagate(const Surface& surface, SurfaceLayout layout,
                      std::span<const SurfacePoint> sites, const PropagationOptions& options) {
    return propagate_distinct(
        surface, sites, options,
        [&](std::span<const SurfacePoint> points, const PropagationOptions& own) {
            return propagate_windows(surface, std::move(layout), points, own);
        });
}

std::vector<Index> sites_of_points(const PropagationOptions& options, std::size_t num_points) {
    if (are_plain(options)) return {};
    std::vector<Index> sites;
    sites.reserve(num_points);
    for (Index i = 0; i < num_points; ++i) sites.push_back(options.points.site_of(i));
    return sites;
}

void propagate_retiring(const Surface& surface, std::span<const SurfacePoint> sites,
                        const PropagationOptions& options, const RetirementSink& sink) {
    const DistinctPoints distinct(surface, sites, options);
    if (distinct.are_all()) return retire_steiner(surface, sites, options, sink);
    const auto rename = [&](RetiredFaces&& retired, Poller& poller) {
        for (Relay& relay : retired.relays) distinct.rename(relay.site);
        retired.label = [&distinct, number = std::move(retired.label)](Index v) {
            VertexLabel label = number(v);
            distinct.rename(label.site);
            return label;
        };
        if (distinct.are_grouped()) {
            const auto site_of = [&](Index v) { return retired.label(v).site; };
            drop_faces_of_one_site(surface, {}, site_of, retired);
        }
        sink(std::move(retired), poller);
    };
    retire_steiner(surface, distinct.points(), distinct.options(), rename);
}

}  // namespace agvd
