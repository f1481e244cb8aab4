//! \file
//! The relays of a face: of the windows that came into it, and of the sites and corners in it.
#pragma once

#include "agvd/propagation/relays.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/window.h"

namespace agvd {

//! The weight is the length of a real path.
[[nodiscard]] inline Relay to_relay(const Window& window, Index site, Index half_edge) {
    return {window.x,     window.y, window.weight + window.error, window.begin, window.end,
            SiteId(site), half_edge};
}

//! The number of relays that came into a face, and their site.
struct FaceRelays {
    static constexpr Index several = no_index - 1;

    Index count = 0;
    Index site = no_index;  //!< May be `several`.

    // There are no branches, since they could not be predicted.
    void add_site(Index other) {
        const Index both = ((other == no_index) | (other == site)) ? site : several;
        site = site == no_index ? other : both;
    }
};

//! Relays that start in a face: its placed sites, and its corners that are sites or pseudo-sources,
//! with the distances of `result`.
[[nodiscard]] Index count_inner_relays(const Surface& surface, std::span<const PlacedSite> placed,
                                       const Propagation& result, Index face);
//! \param out  room for as many as count_inner_relays says.
void write_inner_relays(const Surface& surface, std::span<const PlacedSite> placed,
                        const Propagation& result, Index face, Relay* out);

}  // namespace agvd
