//! \file
//! Relays on their way from the runs of sites to their faces, and their sorting by face.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/propagate.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/beam.h"
#include "agvd/propagation/window/window.h"

namespace agvd {

//! The weight is the length of a real path.
[[nodiscard]] inline Relay to_relay(const Window& window, Index site, Index half_edge) {
    return {window.x,     window.y, window.weight + window.error, window.begin, window.end,
            SiteId(site), half_edge};
}

//! See is_parallel().
[[nodiscard]] inline Relay to_relay(const Beam& beam, Index site) {
    return {beam.x, -infinity, beam.weight, beam.begin, beam.end, SiteId(site), beam.half_edge};
}

//! Relays in the order in which they came, apart for each range of faces: small enough that what is
//! kept of its faces stays in the cache, and that ranges can be taken side by side.
class RelayLogs {
public:
    static constexpr Index faces_of_a_range = 1 << 15;

    RelayLogs() = default;  // For none.
    explicit RelayLogs(Index num_faces) : ranges_(num_faces / faces_of_a_range + 1) {}

    void add(const Relay& relay) {
        Blocks& blocks = ranges_[relay.half_edge / (3 * faces_of_a_range)];
        if (blocks.empty() || blocks.back().size() == block_size) {
            blocks.emplace_back().reserve(block_size);
        }
        blocks.back().push_back(relay);
    }
    void shrink_to_fit() {
        for (Blocks& blocks : ranges_) {
            if (!blocks.empty()) blocks.back().shrink_to_fit();
        }
    }
    //! Puts those of the same faces behind what is there.
    void append(RelayLogs&& other) {
        for (std::size_t r = 0; r < ranges_.size(); ++r) {
            std::move(other.ranges_[r].begin(), other.ranges_[r].end(),
                      std::back_inserter(ranges_[r]));
        }
    }

    [[nodiscard]] Index num_ranges() const { return static_cast<Index>(ranges_.size()); }
    //! The relays of a range, block after block; to be given back one by one.
    [[nodiscard]] std::span<std::vector<Relay>> blocks(Index range) { return ranges_[range]; }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = 0;
        for (const Blocks& blocks : ranges_) {
            for (const auto& block : blocks) sum += block.capacity() * sizeof(Relay);
        }
        return sum;
    }

private:
    static constexpr std::size_t block_size = 256;
    using Blocks = std::vector<std::vector<Relay>>;  // Never copied as they become more.

    std::vector<Blocks> ranges_;
};

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

// Where sites lie, and the distances that they start with (empty: 0).
struct StartingSites {
    const SitePlacement& placement;
    std::span<const double> starts;
};

// Whether the tail is the image of a relay: a site or pseudo-source, or no window reached it.
inline bool is_source(const Surface& surface, std::span<const double> starts,
                      const Propagation& result, Index half_edge) {
    const Index v = surface.tail(half_edge);
    const std::vector<Index>& unseen = result.vertices_off_windows;
    if (!unseen.empty() && std::binary_search(unseen.begin(), unseen.end(), v)) return true;
    if (!result.vertex_site[v].is_valid()) return false;
    const double from_site =
        result.vertex_distance[v] - start_of(starts, result.vertex_site[v].value());
    return surface.can_be_pseudo_source[v] != 0 ||
           from_site <= near_vertex * surface.length_of(half_edge);
}

// Calls each(relay) for the relays that start in a face: those of its placed sites and regions, and
// of its corners that are sites or pseudo-sources, with the distances of `result`.
template <typename Each>
void for_each_inner_relay(const Surface& surface, const StartingSites& sites,
                          const Propagation& result, Index face, const Each& each) {
    for (const PlacedSite& site : sites.placement.in_face(face)) {
        const Vec2 p = position_in_frame(surface, site.point, 3 * face);
        each(Relay{p.x(), p.y(), start_of(sites.starts, site.site), 0, surface.length_of(3 * face),
                   SiteId(site.site), 3 * face});
    }
    for (const PlacedRegion& region : sites.placement.regions_of(face)) {
        each(region_relay(surface, region, start_of(sites.starts, region.site)));
    }
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        if (!is_source(surface, sites.starts, result, h)) continue;
        const Index v = surface.tail(h);
        each(Relay{0, 0, result.vertex_distance[v], 0, surface.length_of(h), result.vertex_site[v],
                   h});
    }
}

// Calls each(relay) for a block, and load(face) some entries ahead: seldom in the cache.
template <typename Load, typename Each>
void for_each_relay(const std::vector<Relay>& block, const Load& load, const Each& each) {
    constexpr std::size_t ahead = 12;
    for (std::size_t i = 0; i < block.size(); ++i) {
        if (i + ahead < block.size()) load(Surface::face(block[i + ahead].half_edge));
        each(block[i]);
    }
}

// Two passes over ranges of faces, in parallel: the first counts the mixed faces and relays of each
// range, the second writes them behind those of the ranges before.
class MixedFaceWriter {
public:
    MixedFaceWriter(const Surface& surface, const StartingSites& sites, RelayLogs logs,
                    std::span<const Index> relay_faces, Propagation& result)
        : surface_(surface), sites_(sites), logs_(std::move(logs)), result_(result) {
        for (const Index f : relay_faces) faces_[f].site = FaceRelays::several;
    }

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
            for (const PlacedSite& p : sites_.placement.in_face(f)) face.add_site(p.site);
            for (const PlacedRegion& r : sites_.placement.regions_of(f)) face.add_site(r.site);
            if (face.site != FaceRelays::several) continue;
            for_each_inner_relay(surface_, sites_, result_, f, [&](const Relay&) { ++face.count; });
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
            for_each_inner_relay(surface_, sites_, result_, f, [&](const Relay& relay) {
                result_.relays[faces_[f].count++] = relay;
            });
        }
    }

    const Surface& surface_;
    StartingSites sites_;
    RelayLogs logs_;
    Propagation& result_;
    std::vector<FaceRelays> faces_ = std::vector<FaceRelays>(surface_.num_faces());
    // By range, and one more.
    std::vector<Begin> begins_ = std::vector<Begin>(logs_.num_ranges() + 1);
};

//! Writes the mixed faces and their relays into `result`, whose vertices are final. A face is mixed
//! if its windows, corners and sites belong to more than one site.
//! \param relay_faces  faces that count as mixed.
//! \param logs  the windows of every face that may be mixed; consumed. Their order stays.
//! Cost: O(#F + relays).
inline void write_mixed_faces(const Surface& surface, const StartingSites& sites, RelayLogs logs,
                              std::span<const Index> relay_faces, int num_threads, Poller& poller,
                              Propagation& result) {
    MixedFaceWriter(surface, sites, std::move(logs), relay_faces, result).run(num_threads, poller);
}

}  // namespace agvd
