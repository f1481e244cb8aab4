//! \file
//! The caller's mesh, cleaned, as a surface: of the Python module and the npm package.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"
#include "remesh/meshfile/diagram_file.h"

namespace cli {

//! Lines and regions of a mesh on the surface of the cleaned one. Parameters and errors as those of
//! remesh::carry_shapes.
[[nodiscard]] std::vector<agvd::SiteShape> carry_shapes(std::span<const remesh::GivenShape> shapes,
                                                        const agvd::MeshView& mesh,
                                                        const remesh::CleanedView& clean,
                                                        const agvd::Surface& surface);

//! For each vertex of a mesh the vertex of its surface at its place: of several the one with the
//! least value. no_index: it is in no face of the surface.
//! \param clean    of the mesh; without face_origin the surface is that of the mesh itself.
//! \param surface  of clean.mesh; it may have been cut along edges.
//! \param value    by vertex of the surface.
[[nodiscard]] std::vector<agvd::Index> vertices_of_least(const agvd::MeshView& mesh,
                                                         const remesh::CleanedView& clean,
                                                         const agvd::Surface& surface,
                                                         std::span<const double> value);

//! What all stages but remesh() work on. Points are carried between the caller's faces and those of
//! the surface.
class GivenSurface {
public:
    //! \param mesh      outlives this.
    //! \param barriers  edges of the mesh along which the surface is cut.
    //! \param cleaning  its progress is that of this whole.
    //! \throw as remesh::clean_input and remesh::carry_edges.
    GivenSurface(const agvd::MeshView& mesh, const remesh::CleanOptions& cleaning,
                 std::span<const std::array<agvd::Index, 2>> barriers = {});
    //! By lengths, without cleaning: the same vertices and faces.
    //! \param side_length  as agvd::build_surface takes it.
    //! \param running      its threads and its progress.
    //! \throw as agvd::build_surface.
    GivenSurface(const agvd::MeshView& mesh, std::span<const double> side_length,
                 const remesh::CleanOptions& running);

    [[nodiscard]] const agvd::Surface& surface() const { return surface_; }
    [[nodiscard]] std::vector<agvd::SurfacePoint> to_surface(
        const std::vector<agvd::SurfacePoint>& points) const;
    //! Those on barriers count on all sides. \throw as remesh::carry_shapes.
    [[nodiscard]] agvd::SurfaceSites to_surface(
        const std::vector<agvd::SurfacePoint>& points, const agvd::SitePoints& roles,
        const std::vector<remesh::GivenShape>& shapes) const;
    [[nodiscard]] std::vector<agvd::SurfacePoint> to_given(
        const std::vector<agvd::SurfacePoint>& points) const;

    //! The caller's face that a face of the surface is, or is a part of.
    [[nodiscard]] agvd::Index face_of(agvd::Index face) const {
        return clean_.face_origin.empty() ? face : clean_.face_origin[face];
    }

    //! Of the caller's vertices: see above.
    [[nodiscard]] std::vector<agvd::Index> vertices_of_least(std::span<const double> value) const {
        return cli::vertices_of_least(mesh_, clean_, surface_, value);
    }

private:
    agvd::MeshView mesh_;
    remesh::CleanResult clean_;
    agvd::Surface surface_;
    std::optional<agvd::Surface> whole_;  // Without barriers, if there are any.
};

}  // namespace cli
