#include "agvd/propagation/window/window_relays.h"

#include <algorithm>

#include "agvd/propagation/window/window_rays.h"

namespace agvd {
namespace {

// Whether the tail of a half-edge is the image of a relay: a site lies on it or beside it, paths
// may bend at it, or no window reached it.
bool is_source(const Surface& surface, const Propagation& result, Index half_edge) {
    const Index v = surface.tail(half_edge);
    const std::vector<Index>& unseen = result.vertices_off_windows;
    if (!unseen.empty() && std::binary_search(unseen.begin(), unseen.end(), v)) return true;
    return result.vertex_site[v].is_valid() &
           ((surface.can_be_pseudo_source[v] != 0) |
            (result.vertex_distance[v] <= near_vertex * surface.length_of(half_edge)));
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

}  // namespace agvd
