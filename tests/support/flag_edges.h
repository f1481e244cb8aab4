//! \file
//! Edges of a surface, chosen by their position.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/curves/find_creases.h"

//! \param is  gets the positions of both ends.
//! \return #E: 1 where it says yes.
template <typename Is>
[[nodiscard]] std::vector<std::uint8_t> flag_edges(const agvd::Surface& surface, const Is& is) {
    std::vector<std::uint8_t> flags;
    for (const agvd::Index h : surface.edge_half) {
        const auto& p = surface.mesh.positions;
        flags.push_back(is(p[surface.tail(h)], p[surface.head(h)]) ? 1 : 0);
    }
    return flags;
}

//! \return #E: 1 for edges inside the surface whose faces differ by more than 40 degrees.
[[nodiscard]] inline std::vector<std::uint8_t> flag_sharp_edges(const agvd::Surface& surface) {
    return remesh::find_creases(surface, {.spacing = 1, .is_automatic = false});
}
