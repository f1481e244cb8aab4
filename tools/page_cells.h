//! \file
//! The cells that a result is the dual of, as lines for a page.
#pragma once

#include <functional>
#include <vector>

#include "agvd/diagram/diagram.h"
#include "page/page_mesh.h"
#include "remesh/pipeline/remesh.h"

namespace cli {

//! The edges of a diagram without arcs of the boundary, and without points that their course does
//! not need.
[[nodiscard]] page::Polylines lines_for_page(const agvd::MeshView& mesh,
                                             const agvd::Diagram& diagram);

//! The edges of the diagram of a result's sites, on its input. One more propagation.
//! \param progress_of  a callback for each stage, by its name.
//! \return nothing if a site does not lie on the repaired input.
//! \throw agvd::Cancelled
[[nodiscard]] page::Polylines cells_for_page(
    const agvd::MeshView& input, const std::vector<agvd::SurfacePoint>& sites,
    const remesh::RemeshOptions& options,
    const std::function<agvd::Progress(const char*)>& progress_of);

}  // namespace cli
