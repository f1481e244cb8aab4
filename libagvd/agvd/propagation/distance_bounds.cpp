#include "agvd/propagation/distance_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "agvd/core/parallel.h"
#include "agvd/propagation/site_placement.h"

namespace agvd {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
// Each step is rounded up by more than all roundings of the exact distance.
constexpr float round_up = 1 + 0x1p-20F;

// Length of the straight line across each edge between the apexes of its faces; infinity where it
// misses the edge.
std::vector<float> flip_lengths(const Surface& surface, int num_threads) {
    std::vector<float> result(surface.num_edges());
    parallel_chunks(surface.num_edges(), 4096, num_threads, [&](Index, Index begin, Index end) {
        for (Index e = begin; e < end; ++e) {
            const Index h = surface.edge_half[e];
            const Index twin = surface.twin[h];
            result[e] = infinity;
            if (twin == no_index) continue;
            const double length = surface.length[e];
            const Vec2& above = surface.apex[h];
            const Vec2 below(length - surface.apex[twin].x(), -surface.apex[twin].y());
            const double crossed = above.x() * -below.y() + below.x() * above.y();
            if (crossed < 0 || crossed > length * (above.y() - below.y())) continue;
            result[e] = static_cast<float>((above - below).norm()) * round_up;
        }
    });
    return result;
}

}  // namespace

DistanceBounds distance_bounds(const Surface& surface, std::span<const SurfacePoint> sites,
                               int num_threads) {
    DistanceBounds bounds;
    bounds.distance.assign(surface.num_vertices(), infinity);
    bounds.site.assign(surface.num_vertices(), no_index);
    const std::vector<float> flips = flip_lengths(surface, num_threads);
    double sum = 0;
    for (const double l : surface.length) sum += l;
    const double width = std::max(0.5 * sum / surface.num_edges(), sum * 0x1p-22);
    const auto per_bucket = static_cast<float>(1 / width);
    std::vector<std::vector<Index>> buckets(1);
    std::vector<Index> queued(surface.num_vertices(), no_index);
    Index current = 0;
    const auto relax = [&](Index v, float d, Index site) {
        if (d > bounds.distance[v] || (d == bounds.distance[v] && site >= bounds.site[v])) return;
        bounds.distance[v] = d;
        bounds.site[v] = site;
        const auto place = std::max(static_cast<Index>(std::min(d * per_bucket, 0x1p22F)), current);
        if (queued[v] <= place) return;
        queued[v] = place;
        if (place >= buckets.size()) buckets.resize(place + 1);
        buckets[place].push_back(v);
    };
    for (Index s = 0; s < sites.size(); ++s) {
        const auto from_face = [&](const SurfacePoint& point) {
            for (Index k = 0; k < 3; ++k) {
                const Index h = 3 * point.face.value() + k;
                const Vec2 p = position_in_frame(surface, point, h);
                relax(surface.tail(h), static_cast<float>(p.norm()) * round_up, s);
            }
        };
        if (const auto vertex = vertex_of(surface, sites[s])) {
            relax(*vertex, 0, s);
            continue;
        }
        from_face(sites[s]);
        const auto half_edge = half_edge_of(sites[s]);
        if (half_edge && surface.twin[*half_edge] != no_index) {
            from_face(across_edge(surface, sites[s], *half_edge));
        }
    }
    for (; current < buckets.size(); ++current) {
        while (!buckets[current].empty()) {
            const Index v = buckets[current].back();
            buckets[current].pop_back();
            if (queued[v] != current) continue;
            queued[v] = no_index;
            const float d = bounds.distance[v];
            const Index site = bounds.site[v];
            Index h = surface.outgoing[v];
            while (true) {
                const Index opposite = Surface::next(h);
                relax(surface.tail(opposite),
                      d + static_cast<float>(surface.length_of(h)) * round_up, site);
                const float flip = flips[surface.edge[opposite]];
                if (flip < infinity) {
                    const Index across = surface.twin[opposite];
                    relax(surface.tail(Surface::previous(across)), d + flip, site);
                }
                const Index back = Surface::previous(h);
                h = surface.twin[back];
                if (h == no_index) {
                    relax(surface.tail(back),
                          d + static_cast<float>(surface.length_of(back)) * round_up, site);
                    break;
                }
                if (h == surface.outgoing[v]) break;
            }
        }
        buckets[current] = {};
    }
    return bounds;
}

}  // namespace agvd
