// A vertex takes the nearest site over the relays of the faces around it.
#include "agvd/core/parallel.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// A path through the relays of one face that is shorter than what the engine found.
struct ShorterPath {
    Index vertex;
    Index site;
    double distance;
};

// Appends the paths to corners that are not fixed.
void find_shorter_paths(const Surface& surface, const Propagation& propagation,
                        std::span<const std::uint8_t> is_fixed, Index mixed_index,
                        std::vector<ShorterPath>& out) {
    const Index face = propagation.mixed_faces[mixed_index];
    const Triangle& corners = surface.mesh.triangles[face];
    if ((is_fixed[corners[0]] & is_fixed[corners[1]] & is_fixed[corners[2]]) != 0) return;
    // No path through a relay is shorter than the straight line, which excludes most relays without
    // a square root. A gain of less than this share changes no label.
    constexpr double least_gain = 1e-9;
    std::array<double, 3> limits;
    for (std::size_t k = 0; k < 3; ++k) {
        limits[k] = (1 - least_gain) * propagation.vertex_distance[corners[k]];
    }
    for (const Relay& relay : relays_of(propagation, mixed_index)) {
        const Index h = relay.half_edge;
        const Index k = h - 3 * face;
        const double length = surface.length_of(h);
        const Vec2& apex = surface.apex[h];
        const auto may_gain = [&](Index corner, double dx, double dy) {
            const double limit = limits[corner] - relay.weight;
            return limit > 0 && dx * dx + dy * dy < limit * limit;
        };
        const Index at_head = k == 2 ? 0 : k + 1;
        const Index at_apex = k == 0 ? 2 : k - 1;
        if (!may_gain(k, relay.x, relay.y) && !may_gain(at_head, relay.x - length, relay.y) &&
            !may_gain(at_apex, relay.x - apex.x(), relay.y - apex.y())) {
            continue;
        }
        const CornerDistances to = corner_distances(relay, length, apex);
        const auto offer = [&](Index corner, double distance) {
            const Index v = corners[corner];
            if (distance >= limits[corner] || is_fixed[v] != 0) return;
            out.push_back({v, relay.site.value(), distance});
        };
        offer(k, to.tail);
        offer(at_head, to.head);
        offer(at_apex, to.apex);
    }
}

// By vertex: 1 for those of an unlisted face, which lies in one cell.
std::vector<std::uint8_t> fixed_vertices(const Surface& surface, const EdgeLabels& labels) {
    std::vector<std::uint8_t> is_fixed(surface.num_vertices(), 0);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (labels.mixed_index[f] != no_index) continue;
        for (const Index v : surface.mesh.triangles[f]) is_fixed[v] = 1;
    }
    return is_fixed;
}

}  // namespace

void label_vertices(const StageInput& input, EdgeLabels& labels) {
    const Surface& surface = input.surface;
    const Propagation& propagation = input.propagation;
    const auto count = static_cast<Index>(propagation.mixed_faces.size());
    labels.mixed_index.assign(surface.num_faces(), no_index);
    for (Index i = 0; i < count; ++i) labels.mixed_index[propagation.mixed_faces[i]] = i;
    labels.vertex_distance = propagation.vertex_distance;
    labels.point_site.reserve(surface.num_vertices());
    for (const SiteId site : propagation.vertex_site) labels.point_site.push_back(site.value());

    const std::vector<std::uint8_t> is_fixed = fixed_vertices(surface, labels);
    constexpr Index grain = 512;
    std::vector<std::vector<ShorterPath>> found(num_chunks(count, grain));
    const auto find = [&](Index chunk, Index begin, Index end) {
        for (Index i = begin; i < end; ++i) {
            find_shorter_paths(surface, propagation, is_fixed, i, found[chunk]);
        }
    };
    parallel_chunks(count, grain, input.num_threads, find, input.poller);
    for (const auto& paths : found) {
        for (const ShorterPath& path : paths) {
            double& distance = labels.vertex_distance[path.vertex];
            Index& site = labels.point_site[path.vertex];
            if (!is_nearer(path.distance, path.site, distance, site)) continue;
            distance = path.distance;
            site = path.site;
        }
    }
}

}  // namespace agvd
