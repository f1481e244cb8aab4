//! \file
//! The number of vertices of the dual, and how it is reached.
#pragma once

#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/valid_dual.h"

namespace remesh::detail {

//! The number of vertices that the dual is to have, copies on curves included: as many as were
//! asked for, or one for each given site that owns a part of the surface. Counts the other given
//! sites.
//! \param diagram  of the first round.
[[nodiscard]] Index target_count(const Domain& domain, const PlacedSites& placed,
                                 const Diagram& diagram, const StageContext& context);

//! Removes vertices until `target` are left or the topology allows no further removal.
//!
//! \param positions  #V of the dual.
//! \param keep       #V of the dual: 1 for vertices that are removed last.
//! \return how many were removed. Cost: that of reduce_vertices.
Index reduce_to(Index target, std::span<const Vec3> positions, std::span<const std::uint8_t> keep,
                ValidDual& dual, const StageContext& context);

}  // namespace remesh::detail
