//! \file
//! Which sites came to which vertices, and which of them is the nearest.
#pragma once

#include "agvd/update/site_runs.h"

namespace agvd {

//! A site, by number, and what its run gives at a vertex whose bound it has read.
struct Reader {
    Index site;
    double distance;  //!< Infinity where it is not reached within its bound.
};

struct VertexReaders {
    std::vector<std::vector<Reader>> at;  //!< #V.
    std::vector<std::uint8_t> is_listed;  //!< #V: 0 but while vertices are listed.
};

//! The sites that changed and those that have read a bound that is another now, in the order of
//! propagate().
[[nodiscard]] std::vector<Index> find_dirty(const NumberedSites& sites,
                                            const VertexReaders& readers);

//! Takes over what the last run_again() changed.
//! \param sites  those that ran.
//! \return the vertices to be settled, once each: those that any of these sites changed, and those
//!         that may have to take their bound.
[[nodiscard]] std::vector<Index> take_changes(const SiteRuns& runs, std::span<const Index> sites,
                                              const NumberedSites& numbered,
                                              VertexReaders& readers);

//! Gives a vertex its nearest site and distance in `result`, by rank.
//! \return false if nothing changes.
[[nodiscard]] bool settle_vertex(const NumberedSites& sites, Index vertex, VertexReaders& readers,
                                 Propagation& result);

}  // namespace agvd
