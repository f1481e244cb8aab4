//! \file
//! As many vertices as were asked for.
#pragma once

#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/valid_dual.h"

namespace remesh::detail {

//! How many vertices the dual is to have, copies on curves included: as many as were asked for, or
//! as there are given sites that own a part of the surface. Counts the other given sites.
//! \param diagram  the first one.
[[nodiscard]] agvd::Index target_count(const Domain& domain, const PlacedSites& placed,
                                       const agvd::Diagram& diagram, const StageContext& context);

//! Takes vertices away until `target` are left or the topology lets none go.
//!
//! \param positions  #V of the dual.
//! \param keep       #V of the dual: 1 for vertices that go last.
//! \return how many went. Cost: that of reduce_vertices.
agvd::Index reduce_to(agvd::Index target, std::span<const agvd::Vec3> positions,
                      std::span<const std::uint8_t> keep, ValidDual& dual,
                      const StageContext& context);

}  // namespace remesh::detail
