//! \file
//! Voronoi diagrams out of propagated distances: the same bytes for any number of threads.
//! Held by Diagram.SameBytesForAnyThreadCountAndLambda in tests/agvd/diagram.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {

//! `{}` gives the defaults.
struct DiagramOptions {
    double chord_tolerance = 0.01;  //!< Arcs are sampled to this share of their chord's length.
    int num_threads = 0;            //!< >= 0; 0: all cores. Same bytes for any number.
    Progress progress = {};         //!< Polled during the call; see agvd::poll.
};

//! Builds local Apollonius diagrams in the mixed faces and joins them ([meng2023] Sec. 4.2, 5.3).
//!
//! Cost: O(k) per mixed face and label change, k = relays of the face. Re-entrant.
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    const Propagation& propagation,
                                    const DiagramOptions& options = {});

//! The same for a propagation that is not needed any more. Its relays are freed before the diagram
//! is drawn: they take more than a third of the memory then.
[[nodiscard]] Diagram build_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                                    Propagation&& propagation, const DiagramOptions& options = {});

//! The same complex with all points on base.input(): Voronoi edges get a point where they cross an
//! edge of the input, so that consecutive points share a face of it as before. The distances of
//! these points are interpolated. Labels are those of the input's vertices.
//! \param diagram  of base.surface().
//! \throw Cancelled  the progress callback returned false.
//! Cost: that of mapping each segment.
[[nodiscard]] Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                                       const Progress& progress = {});

}  // namespace agvd
