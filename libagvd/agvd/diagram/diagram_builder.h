//! \file
//! The stages of a diagram, and what they keep for the next one.
#pragma once

#include <optional>

#include "agvd/diagram/cuts.h"
#include "agvd/diagram/islands.h"
#include "agvd/diagram/join.h"
#include "agvd/diagram/touched_parts.h"

namespace agvd {

//! Builds a diagram, and then what a change touches of it, again and again.
class DiagramBuilder {
public:
    //! \param surface  outlives this.
    DiagramBuilder(const Surface& surface, DiagramOptions options);

    //! Makes `diagram` that of these sites, byte for byte as a new builder would.
    //! \param changed_faces  those whose relays, or the distances of whose corners, are others than
    //!                       in the last call. Not read in the first one.
    //! \param diagram        as the last call left it.
    //! \throw Cancelled  `diagram` is as it was; the next call begins anew.
    void build(std::span<const SurfacePoint> sites, const Propagation& propagation,
               std::span<const Index> changed_faces, Diagram& diagram);

    //! Between two calls, where sites are removed.
    void renumber(const Renumbering& renumbering);

private:
    // What one call leaves to the next.
    struct Kept {
        explicit Kept(const Surface& surface) : arcs(surface), joiner(surface), tally(surface) {}

        EdgeLabels labels;
        ArcStore arcs;
        ArcJoiner joiner;
        CellTally tally;
        CellSet displaced;                // Sites whose place belongs to another cell.
        CellSet in_doubt;                 // May have parts that do not hang together, still.
        bool is_renumbered = false;       // Since the last call.
        std::vector<OldLabel> absorbed;   // Labels that islands had, one after the other.
        std::vector<Index> mended_faces;  // Around those.
    };
    class Run;

    const Surface& surface_;
    DiagramOptions options_;
    std::optional<Kept> kept_;
};

}  // namespace agvd
