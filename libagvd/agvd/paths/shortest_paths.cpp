// A path between two points is the path to a site: `to`. Let U be the length of any path between
// them. Where a point p lies on a shortest path, its distance from `to` is at most U - |p from|,
// and the distance in space is at least as short as that on the surface: such caps end windows.
#include "agvd/paths/geodesic_path.h"

#include <algorithm>
#include <map>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/relay_trace.h"
#include "agvd/propagation/engines.h"

namespace agvd {
namespace {

constexpr Index paths_of_a_chunk = 8;
// More than the rounding of lengths and caps.
constexpr double cap_slack = 1e-6;

void check_max_error(double max_error) {
    if (max_error >= 0 && max_error < 1) return;
    throw InvalidOption("the maximal error is " + std::to_string(max_error) +
                        "; use a number from 0 (exact) to below 1");
}

// A point to which some pairs lead.
struct Star {
    SurfacePoint to;
    std::vector<Index> pairs;
};

// Ordered by the first of their pairs.
std::vector<Star> stars_of(const Surface& surface, std::span<const PointPair> pairs) {
    std::map<SurfaceKey, Index> star_of;
    std::vector<Star> stars;
    for (Index i = 0; i < pairs.size(); ++i) {
        const auto [found, is_new] =
            star_of.try_emplace(key_of(surface, pairs[i].to), static_cast<Index>(stars.size()));
        if (is_new) stars.push_back({pairs[i].to, {}});
        stars[found->second].pairs.push_back(i);
    }
    return stars;
}

GeodesicPath path_of_pair(const Surface& surface, const PointPair& pair, Index index,
                          const Progress& progress) {
    try {
        return path_between(surface, pair.from, pair.to, progress);
    } catch (const InvalidInput&) {
        throw InvalidInput("no path: the points of pair " + std::to_string(index) +
                           " lie on different components; leave the pair out");
    }
}

// #V: where a vertex is farther from the star, no shortest path of its pairs leads past it.
class Caps {
public:
    explicit Caps(const Surface& surface) : surface_(surface), caps_(surface.num_vertices(), 0) {}

    void add(const SurfacePoint& from, double length, Ticker& ticker) {
        // A face need not lie in space, but its corners do.
        Index corner = 3 * from.face.value();
        for (const Index h : {corner + 1, corner + 2}) {
            if (distance(from, h) < distance(from, corner)) corner = h;
        }
        const Vec3& place = surface_.mesh.positions[surface_.tail(corner)];
        const double most = (length + distance(from, corner)) * (1 + cap_slack);
        for (Index v = 0; v < caps_.size(); ++v) {
            ticker.tick();
            const double cap = most - (surface_.mesh.positions[v] - place).norm();
            if (cap > 0) caps_[v] = std::max(caps_[v], rounded_up(cap));
        }
    }
    [[nodiscard]] std::span<const float> get() const { return caps_; }

private:
    // From the tail of a half-edge of the point's face.
    [[nodiscard]] double distance(const SurfacePoint& point, Index half_edge) const {
        return face_distance(surface_, point, point_on(half_edge, 0));
    }

    const Surface& surface_;
    std::vector<float> caps_;
};

}  // namespace

std::vector<SitePath> paths_to_sites(const Surface& surface, std::span<const SurfacePoint> sites,
                                     const Propagation& propagation,
                                     std::span<const SurfacePoint> points,
                                     const ShortestPathOptions& options) {
    check_sites(surface, points);
    check_num_threads(options.num_threads);
    Poller poller(options.progress);
    const Progress polling = poller.progress();
    const SiteEnds ends(surface, sites, propagation);
    const TracedField field{surface, propagation, ends};
    std::vector<SitePath> paths(points.size());
    parallel_each(
        static_cast<Index>(points.size()), paths_of_a_chunk, options.num_threads,
        [&](Index i) { paths[i] = path_to_ends(field, points[i], polling); }, poller);
    return paths;
}

std::vector<GeodesicPath> shortest_paths(const Surface& surface, std::span<const PointPair> pairs,
                                         const ShortestPathOptions& options) {
    check_max_error(options.max_error);
    for (const PointPair& pair : pairs) check_sites(surface, std::array{pair.from, pair.to});
    Poller poller(options.progress);
    const Progress polling = poller.progress();
    Ticker ticker(poller);
    const SurfaceLayout layout(surface, options.num_threads, polling);
    std::vector<GeodesicPath> paths(pairs.size());
    Index num_done = 0;
    for (const Star& star : stars_of(surface, pairs)) {
        Caps caps(surface);
        std::vector<SurfacePoint> from;
        for (const Index i : star.pairs) {
            paths[i] = path_of_pair(surface, pairs[i], i, polling);
            caps.add(pairs[i].from, paths[i].length, ticker);
            from.push_back(pairs[i].from);
        }
        const PropagationOptions propagating{.max_error = options.max_error,
                                             .relay_faces = all_faces(surface),
                                             .num_threads = options.num_threads,
                                             .progress = polling};
        const std::array site{star.to};
        const Propagation propagation =
            propagate_windows(surface, layout, site, propagating, default_work_cap, caps.get());
        const auto found =
            paths_to_sites(surface, site, propagation, from,
                           {.num_threads = options.num_threads, .progress = polling});
        for (std::size_t k = 0; k < found.size(); ++k) {
            GeodesicPath& path = paths[star.pairs[k]];
            if (found[k].site.is_valid() && found[k].path.length < path.length) {
                path = found[k].path;
            }
        }
        num_done += static_cast<Index>(star.pairs.size());
        poller.tell(static_cast<double>(num_done) / static_cast<double>(pairs.size()));
    }
    return paths;
}

}  // namespace agvd
