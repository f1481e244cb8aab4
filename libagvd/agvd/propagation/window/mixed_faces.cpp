// Sorts logged windows by face in two passes over ranges of faces, both in parallel: the first
// counts the mixed faces and relays of each range, the second writes them behind those of the
// ranges before. Only faces with relays, corners or sites of more than one site are written.
#include "agvd/propagation/window/mixed_faces.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// The number of relays that came into a face, and their site.
struct FaceRelays {
    static constexpr Index several = no_index - 1;

    Index count = 0;
    Index site = no_index;  // May be `several`.

    // There are no branches, since they could not be predicted.
    void add_site(Index other) {
        const Index both = ((other == no_index) | (other == site)) ? site : several;
        site = site == no_index ? other : both;
    }
};

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

// Calls each(relay) for the relays that start in a face: those of its placed sites, and of its
// corners that are sites or pseudo-sources, with the distances of `result`.
template <typename Each>
void for_each_inner_relay(const Surface& surface, std::span<const PlacedSite> placed,
                          const Propagation& result, Index face, const Each& each) {
    for (const PlacedSite& site : placed) {
        const Vec2 p = position_in_frame(surface, site.point, 3 * face);
        each(Relay{p.x(), p.y(), 0, 0, surface.length_of(3 * face), SiteId(site.site), 3 * face});
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!is_source(surface, result, h)) continue;
        const Index v = surface.tail(h);
        each(Relay{0, 0, result.vertex_distance[v], 0, surface.length_of(h), result.vertex_site[v],
                   h});
    }
}

// Calls each(relay) for the relays of a block. Calls load(face) for the faces of relays a few
// entries ahead, which are seldom in the cache.
template <typename Load, typename Each>
void for_each_relay(const std::vector<Relay>& block, const Load& load, const Each& each) {
    constexpr std::size_t ahead = 12;
    for (std::size_t i = 0; i < block.size(); ++i) {
        if (i + ahead < block.size()) load(Surface::face(block[i + ahead].half_edge));
        each(block[i]);
    }
}

// All loops run over the ranges of the logs, in parallel.
class MixedFaceWriter {
public:
    MixedFaceWriter(const Surface& surface, const SitePlacement& placement, RelayLogs logs,
                    Propagation& result)
        : surface_(surface),
          placement_(placement),
          logs_(std::move(logs)),
          result_(result),
          faces_(surface.num_faces()),
          begins_(logs_.num_ranges() + 1) {}

    void run(int num_threads, Poller& poller) {
        const Index num_ranges = logs_.num_ranges();
        poller.poll();
        parallel_chunks(
            num_ranges, 1, num_threads,
            [&](Index range, Index, Index) { count(range, Ticker(poller)); }, poller);
        for (Index range = 0; range < num_ranges; ++range) {
            begins_[range + 1].face += begins_[range].face;
            begins_[range + 1].relay += begins_[range].relay;
        }
        result_.mixed_faces.resize(begins_.back().face);
        result_.relay_ranges.resize(begins_.back().face);
        poller.poll();
        result_.relays.reserve(begins_.back().relay);
        while (result_.relays.size() < begins_.back().relay) {  // New pages take long.
            constexpr std::size_t step = 1 << 17;
            result_.relays.resize(
                std::min<std::size_t>(begins_.back().relay, result_.relays.size() + step));
            poller.poll();
        }
        parallel_chunks(
            num_ranges, 1, num_threads,
            [&](Index range, Index, Index) { write(range, Ticker(poller)); }, poller);
    }

private:
    // Where a range begins in the result. At first each entry holds the counts of the range before.
    struct Begin {
        Index face = 0;  // Among the mixed ones.
        Index relay = 0;
    };

    [[nodiscard]] Index end_of(Index range) const {
        return std::min((range + 1) * RelayLogs::faces_of_a_range, surface_.num_faces());
    }

    void count(Index range, Ticker ticker) {
        for (const std::vector<Relay>& block : logs_.blocks(range)) {
            ticker.tick(block.size());
            for_each_relay(
                block, [&](Index face) { __builtin_prefetch(&faces_[face], 1); },
                [&](const Relay& relay) {
                    FaceRelays& face = faces_[Surface::face(relay.half_edge)];
                    ++face.count;
                    face.add_site(relay.site.value());
                });
        }
        Begin& own = begins_[range + 1];
        for (Index f = range * RelayLogs::faces_of_a_range; f < end_of(range); ++f) {
            ticker.tick();
            FaceRelays& face = faces_[f];
            for (const Index v : surface_.mesh.triangles[f]) {
                face.add_site(result_.vertex_site[v].value());
            }
            const auto placed = placement_.in_face(f);
            for (const PlacedSite& p : placed) face.add_site(p.site);
            if (face.site != FaceRelays::several) continue;
            for_each_inner_relay(surface_, placed, result_, f, [&](const Relay&) { ++face.count; });
            ++own.face;
            own.relay += face.count;
        }
    }

    void write(Index range, Ticker ticker) {
        const Index first = begins_[range].face;
        Index end = first;
        Index relays_end = begins_[range].relay;
        for (Index f = range * RelayLogs::faces_of_a_range; f < end_of(range); ++f) {
            FaceRelays& face = faces_[f];
            if (face.site != FaceRelays::several) continue;
            const Index begin = relays_end;
            relays_end += face.count;
            face.count = begin;  // From here on the index of its next relay.
            result_.mixed_faces[end] = f;
            result_.relay_ranges[end++] = {begin, relays_end};
        }
        for (std::vector<Relay>& block : logs_.blocks(range)) {
            ticker.tick(block.size());
            for_each_relay(
                block,
                [&](Index face) {
                    if (faces_[face].site != FaceRelays::several) return;
                    __builtin_prefetch(&result_.relays[faces_[face].count], 1);
                },
                [&](const Relay& relay) {
                    FaceRelays& face = faces_[Surface::face(relay.half_edge)];
                    if (face.site == FaceRelays::several) result_.relays[face.count++] = relay;
                });
            std::vector<Relay>().swap(block);
        }
        for (Index i = first; i < end; ++i) {
            ticker.tick();
            const Index f = result_.mixed_faces[i];
            for_each_inner_relay(
                surface_, placement_.in_face(f), result_, f,
                [&](const Relay& relay) { result_.relays[faces_[f].count++] = relay; });
        }
    }

    const Surface& surface_;
    const SitePlacement& placement_;
    RelayLogs logs_;
    Propagation& result_;
    std::vector<FaceRelays> faces_;
    std::vector<Begin> begins_;  // By range, and one more.
};

}  // namespace

void write_mixed_faces(const Surface& surface, const SitePlacement& placement, RelayLogs logs,
                       int num_threads, Poller& poller, Propagation& result) {
    MixedFaceWriter(surface, placement, std::move(logs), result).run(num_threads, poller);
}

}  // namespace agvd
