//! \file
//! Diagrams and distances in the terms of the caller's mesh: of the Python module and the npm
//! package.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "agvd/diagram/cut_cells.h"
#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "given_surface.h"

namespace cli {

//! A callback for each stage, by its name.
using StageProgress = std::function<agvd::Progress(const char*)>;

//! The edges of a diagram as polylines in space: closed ones end with their first point.
struct Polylines {
    std::vector<agvd::Vec3> points;
    std::vector<double> distances;     //!< Of each point from its sites.
    std::vector<agvd::Index> offsets;  //!< #edges + 1.
};

//! The arcs of a diagram. Arc i is the points [spans[i][0], spans[i][1]) of the polyline lines[i].
struct DrawnArcs {
    std::vector<agvd::Index> lines;
    std::vector<std::array<agvd::Index, 2>> spans;  //!< Of Polylines::points.
    std::vector<agvd::ArcKind> kinds;
    std::array<std::vector<agvd::Vec3>, 2> foci;  //!< On the left and right, in space.
    std::array<std::vector<double>, 2> weights;   //!< On the left and right.
};

//! What a diagram is computed to: on the surface, and for the caller's vertices.
struct DrawnDiagram {
    agvd::Diagram diagram;
    double certified_error = 0;
    agvd::Cells cells;
    std::vector<agvd::Triangle> dual;
    Polylines lines;
    DrawnArcs arcs;  //!< Empty without a chord.
    std::vector<agvd::Vec3> site_positions;
    //! #V: the nearest site; invalid where none reaches.
    std::vector<agvd::SiteId> labels;
    std::vector<double> distances;  //!< #V: infinity where no site reaches.
};

//! How the caller's mesh becomes a surface.
struct SurfaceOptions {
    bool keep_slits = false;  //!< As in remesh::CleanOptions.
    //! Pairs of the caller's vertices: edges that no path crosses.
    std::vector<std::array<agvd::Index, 2>> barriers = {};
    //! #F x 3: lengths in place of positions, of the side from corner k of a face to corner k + 1;
    //! empty: none. The mesh is not cleaned then, and has no barriers.
    std::vector<double> side_lengths = {};
};

//! \param progress  of the whole.
//! \throw as GivenSurface.
[[nodiscard]] GivenSurface given_surface(const agvd::MeshView& mesh,
                                         const SurfaceOptions& as_surface, int num_threads,
                                         const agvd::Progress& progress);

//! Sites on the caller's mesh.
struct DrawnSites {
    std::vector<agvd::SurfacePoint> points = {};
    std::vector<remesh::GivenShape> shapes = {};  //!< Lines and regions.
};

//! read(cleaned mesh, its sites, its diagram, what was propagated)
using DiagramReader = std::function<void(const agvd::Surface&, std::span<const agvd::SurfacePoint>,
                                         const agvd::Diagram&, const agvd::PropagationOptions&)>;

//! \param options  their progress and their shapes are ignored.
//! \param chord    as in agvd::DiagramOptions.
//! \param read     called with the diagram on the cleaned mesh, if not empty.
//! \throw as remesh::clean_input, remesh::to_cleaned, remesh::carry_edges, remesh::carry_shapes and
//!        agvd::propagate.
[[nodiscard]] DrawnDiagram draw_diagram(const agvd::MeshView& mesh, const DrawnSites& sites,
                                        const agvd::PropagationOptions& options,
                                        const SurfaceOptions& as_surface,
                                        const StageProgress& progress_of,
                                        std::optional<double> chord = {},
                                        const DiagramReader& read = {});

//! The mesh cut along the bisectors. Parameters and errors as above.
//! \return its face_origin names the caller's faces.
[[nodiscard]] agvd::CutCells cut_cells(const agvd::MeshView& mesh, const DrawnSites& sites,
                                       agvd::PropagationOptions options,
                                       const SurfaceOptions& as_surface,
                                       const StageProgress& progress_of);

//! #V: the distance of each of the caller's vertices from the nearest site; infinity where none
//! reaches. Parameters and errors as above.
[[nodiscard]] std::vector<double> vertex_distances(const agvd::MeshView& mesh,
                                                   const DrawnSites& sites,
                                                   agvd::PropagationOptions options,
                                                   const SurfaceOptions& as_surface,
                                                   const StageProgress& progress_of);

}  // namespace cli
