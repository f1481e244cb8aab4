//! \file
//! Drops small components of the input.
#pragma once

#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"

namespace remesh {

//! Drops every component with less than this share of the surface's area, and the vertices that
//! only it uses.
//! \param least_share  in [0, 1].
//! \param topology  of clean.mesh.
//! \return the number of components dropped.
//! \throw InvalidOption  none would be left.
[[nodiscard]] Index drop_components(CleanResult& clean, const Topology& topology,
                                    double least_share);

}  // namespace remesh
