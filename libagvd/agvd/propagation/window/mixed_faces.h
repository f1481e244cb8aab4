//! \file
//! Relays on their way from the runs of sites to their faces, and their sorting by face.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/propagation/propagate.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/window.h"

namespace agvd {

//! The weight is the length of a real path.
[[nodiscard]] inline Relay to_relay(const Window& window, Index site, Index half_edge) {
    return {window.x,     window.y, window.weight + window.error, window.begin, window.end,
            SiteId(site), half_edge};
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

//! Writes the mixed faces and their relays into `result`, whose vertices are final. A face is mixed
//! if its windows, its corners and the sites inside it belong to more than one site.
//!
//! \param logs  the windows of every face that may be mixed; consumed. Relays of a face keep their
//! order.
//! Cost: O(#F + relays).
void write_mixed_faces(const Surface& surface, const SitePlacement& placement, RelayLogs logs,
                       int num_threads, Poller& poller, Propagation& result);

}  // namespace agvd
