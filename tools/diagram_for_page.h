//! \file
//! What a page shows of a diagram besides its figures.
#pragma once

#include <functional>
#include <vector>

#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"
#include "page/diagram_page.h"

namespace cli {

//! A page with sites, bisectors and lines of equal distance. Without version, command, name and
//! warnings. One more propagation.
//! \param propagating  as for the diagram. \param certified_error  of the diagram's distances.
//! \param progress_of  a callback for each stage, by its name.
//! \throw agvd::Cancelled
[[nodiscard]] page::DiagramPage diagram_for_page(
    const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites,
    const agvd::Diagram& diagram, agvd::PropagationOptions propagating, double certified_error,
    const std::function<agvd::Progress(const char*)>& progress_of);

}  // namespace cli
