//! \file
//! Command-line options of `remesh` that say how many vertices the result has, and where.
#pragma once

#include "arguments.h"
#include "remesh/sizing/sizing.h"

namespace cli {

struct SizingArguments {
    remesh::Sizing sizing;                           //!< What needs no mesh.
    std::optional<Amount> edge, min_edge, max_edge;  //!< Mesh units, or percent of the diagonal.
    //! Vertices of IN whose property gives target lengths or densities: there is no reader yet.
};

//! Adds --adaptive, --faces, --edge-length, --min-edge, --max-edge and --gradation, after
//! --samples and --sites.
void add_sizing_options(CLI::App& app, SizingArguments& arguments);

//! The options for a mesh. Cost: O(#F) for the diagonal.
[[nodiscard]] remesh::Sizing sizing_for(const SizingArguments& arguments,
                                        const agvd::MeshView& mesh);

}  // namespace cli
