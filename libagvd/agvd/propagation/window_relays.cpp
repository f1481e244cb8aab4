#include "agvd/propagation/window_relays.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/propagation/window_rays.h"

namespace agvd {
namespace {

constexpr Index grain = 4096;

// A tail that is a site, or nearly, or turns paths, is itself the image of what comes by it.
bool is_source(const Surface& surface, const Propagation& result, Index half_edge) {
    const Index v = surface.tail(half_edge);
    return result.vertex_site[v].is_valid() &
           ((surface.can_turn[v] != 0) |
            (result.vertex_distance[v] <= beside_vertex * surface.length_of(half_edge)));
}

// Calls each(relay, place of its face). The places are seldom in the cache, so that each one is
// loaded ahead.
template <typename Place, typename Load, typename Each>
void for_each_relay(const std::vector<Relay>& log, std::vector<Place>& places, const Load& load,
                    const Each& each) {
    constexpr std::size_t ahead = 12;
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (i + ahead < log.size()) load(places[Surface::face(log[i + ahead].half_edge)]);
        each(log[i], places[Surface::face(log[i].half_edge)]);
    }
}

}  // namespace

Index count_inner_relays(const Surface& surface, std::span<const PlacedSite> placed,
                         const Propagation& result, Index face) {
    auto count = static_cast<Index>(placed.size());
    for (Index h = 3 * face; h < 3 * face + 3; ++h) count += is_source(surface, result, h) ? 1 : 0;
    return count;
}

void write_inner_relays(const Surface& surface, std::span<const PlacedSite> placed,
                        const Propagation& result, Index face, Relay* out) {
    for (const PlacedSite& site : placed) {
        const Vec2 p = position_in_frame(surface, site.point, 3 * face);
        *out++ = {p.x(), p.y(), 0, 0, surface.length_of(3 * face), SiteId(site.site), 3 * face};
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!is_source(surface, result, h)) continue;
        const Index v = surface.tail(h);
        *out++ = {0, 0, result.vertex_distance[v], 0, surface.length_of(h), result.vertex_site[v],
                  h};
    }
}

void write_relays(const Surface& surface, const SitePlacement& placement,
                  std::vector<std::vector<Relay>> logs, int num_threads, Propagation& result) {
    const Index num_faces = surface.num_faces();
    std::vector<FaceRelays> faces(num_faces);
    for (const auto& log : logs) {
        for_each_relay(
            log, faces, [](const FaceRelays& face) { __builtin_prefetch(&face, 1); },
            [](const Relay& r, FaceRelays& face) {
                ++face.count;
                face.add_site(r.site.value());
            });
    }
    std::vector<Index> next(num_faces);  // Where the next relay of a face goes.
    Index total = 0;
    for (Index f = 0; f < num_faces; ++f) {
        FaceRelays& face = faces[f];
        for (const Index v : surface.mesh.triangles[f]) {
            face.add_site(result.vertex_site[v].value());
        }
        const auto placed = placement.in_face(f);
        for (const PlacedSite& p : placed) face.add_site(p.site);
        if (face.site != FaceRelays::several) {
            next[f] = no_index;
            continue;
        }
        next[f] = total;
        result.mixed_faces.push_back(f);
        const Index begin = total;
        total += face.count + count_inner_relays(surface, placed, result, f);
        result.relay_ranges.push_back({begin, total});
    }
    result.relays.resize(total);
    for (auto& log : logs) {
        for_each_relay(
            log, next,
            [&](Index place) {
                if (place != no_index) __builtin_prefetch(&result.relays[place], 1);
            },
            [&](const Relay& r, Index& place) {
                if (place != no_index) result.relays[place++] = r;
            });
        std::vector<Relay>().swap(log);
    }
    const auto num_mixed = static_cast<Index>(result.mixed_faces.size());
    parallel_chunks(num_mixed, grain, num_threads, [&](Index, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            const Index f = result.mixed_faces[i];
            write_inner_relays(surface, placement.in_face(f), result, f,
                               result.relays.data() + next[f]);
        }
    });
}

}  // namespace agvd
