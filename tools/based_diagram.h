//! \file
//! Diagrams by way of an intrinsic base, whose edges are short for the spacing of the sites.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"

namespace cli {

//! The base of a surface for so many sites.
[[nodiscard]] agvd::IntrinsicTriangulation base_for(const agvd::Surface& surface,
                                                    std::size_t num_sites,
                                                    const agvd::Progress& progress);

struct BasedDiagram {
    agvd::Diagram diagram;  //!< On the surface.
    double certified_error = 0;
};

//! With shapes there is no base, as they consist of edges and faces of the surface.
//! \param options      for the propagation; all steps use its num_threads. Its progress is ignored.
//! \param progress_of  a callback for each stage, by its name.
//! \param chord        as in agvd::DiagramOptions.
//! \throw as agvd::propagate.
[[nodiscard]] BasedDiagram based_diagram(
    const agvd::Surface& surface, const std::vector<agvd::SurfacePoint>& sites,
    agvd::PropagationOptions options, const std::function<agvd::Progress(const char*)>& progress_of,
    std::optional<double> chord = {});

}  // namespace cli
