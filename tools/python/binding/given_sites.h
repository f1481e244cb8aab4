//! \file
//! Sites of all kinds and surfaces, as the Python part of the package gives them.
#pragma once

#include "binding/arrays.h"
#include "drawn_diagram.h"

namespace python {

//! Sites on the caller's mesh, and what the points stand for. Opaque to Python.
struct GivenSites {
    cli::DrawnSites on_mesh;
    agvd::SitePoints roles;

    //! What they are on a surface.
    //! \throw as GivenSurface::to_surface.
    [[nodiscard]] agvd::SurfaceSites on(const cli::GivenSurface& given) const {
        return given.to_surface(on_mesh.points, roles, on_mesh.shapes);
    }
    //! Propagation with relays in some faces.
    //! \throw as agvd::propagate.
    [[nodiscard]] static agvd::Propagation propagate_on(const agvd::Surface& surface,
                                                        const agvd::SurfaceSites& sites,
                                                        std::vector<agvd::Index> relay_faces,
                                                        double max_error, int num_threads,
                                                        const agvd::Progress& progress) {
        return agvd::propagate(surface, sites.points,
                               {.points = sites.roles,
                                .shapes = sites.shapes,
                                .max_error = max_error,
                                .relay_faces = std::move(relay_faces),
                                .num_threads = num_threads,
                                .progress = progress});
    }
};

}  // namespace python
