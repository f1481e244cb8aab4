#include "drawn_diagram.h"

#include "based_diagram.h"
#include "remesh/dual/build_dual.h"

namespace cli {
namespace {

using agvd::Index;

// Values of the surface's vertices for those of the caller.
template <typename Value>
std::vector<Value> carry(const std::vector<Index>& places, const std::vector<Value>& values,
                         Value none) {
    std::vector<Value> result;
    result.reserve(places.size());
    for (const Index place : places) {
        result.push_back(place == agvd::no_index ? none : values[place]);
    }
    return result;
}

Polylines draw(const agvd::Diagram& diagram, const agvd::MeshView& mesh) {
    Polylines lines;
    lines.offsets.push_back(0);
    const auto add = [&](Index point) {
        lines.points.push_back(agvd::position(mesh, diagram.points[point]));
        lines.distances.push_back(diagram.point_distance[point]);
    };
    for (std::size_t e = 0; e < diagram.edges.size(); ++e) {
        const Index begin = diagram.edge_points[e], end = diagram.edge_points[e + 1];
        for (Index point = begin; point < end; ++point) add(point);
        if (diagram.edges[e].tail == agvd::no_index && begin < end) add(begin);
        lines.offsets.push_back(static_cast<Index>(lines.points.size()));
    }
    return lines;
}

DrawnArcs draw_arcs(const agvd::Surface& surface, const agvd::Diagram& diagram,
                    const Polylines& lines) {
    DrawnArcs drawn;
    if (diagram.edge_arcs.empty()) return drawn;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        for (Index a = diagram.edge_arcs[e]; a < diagram.edge_arcs[e + 1]; ++a) {
            const agvd::BisectorArc& arc = diagram.arcs[a];
            const Index begin = lines.offsets[e] + arc.first_point - diagram.edge_points[e];
            const auto count = static_cast<Index>(points_of_arc(diagram, e, a).size());
            drawn.lines.push_back(e);
            drawn.spans.push_back({begin, begin + count});
            drawn.kinds.push_back(arc.kind);
            const auto foci = foci_in_space(surface, arc);
            for (std::size_t k = 0; k < 2; ++k) {
                drawn.foci[k].push_back(foci[k]);
                drawn.weights[k].push_back(arc.weight[k]);
            }
        }
    }
    return drawn;
}

// The points on the surface; the options get the rest.
std::vector<agvd::SurfacePoint> place_sites(const GivenSurface& given, const DrawnSites& sites,
                                            agvd::PropagationOptions& options) {
    agvd::SurfaceSites placed = given.to_surface(sites.points, options.points, sites.shapes);
    options.points = std::move(placed.roles);
    options.shapes = std::move(placed.shapes);
    return std::move(placed.points);
}

}  // namespace

GivenSurface given_surface(const agvd::MeshView& mesh, const SurfaceOptions& as_surface,
                           int num_threads, const agvd::Progress& progress) {
    const remesh::CleanOptions cleaning{
        .keep_slits = as_surface.keep_slits, .num_threads = num_threads, .progress = progress};
    if (as_surface.side_lengths.empty()) return {mesh, cleaning, as_surface.barriers};
    return {mesh, as_surface.side_lengths, cleaning};
}

DrawnDiagram draw_diagram(const agvd::MeshView& mesh, const DrawnSites& given_sites,
                          const agvd::PropagationOptions& given_options,
                          const SurfaceOptions& as_surface, const StageProgress& progress_of,
                          std::optional<double> chord, const DiagramReader& read) {
    const GivenSurface given =
        given_surface(mesh, as_surface, given_options.num_threads, progress_of("clean"));
    const agvd::Surface& surface = given.surface();
    agvd::PropagationOptions options = given_options;
    const std::vector<agvd::SurfacePoint> sites = place_sites(given, given_sites, options);
    BasedDiagram based = based_diagram(surface, sites, options, progress_of, chord);
    DrawnDiagram drawn;
    drawn.diagram = std::move(based.diagram);
    drawn.certified_error = based.certified_error;
    if (read) read(surface, sites, drawn.diagram, options);
    drawn.cells = agvd::build_cells(drawn.diagram);
    drawn.dual = remesh::build_dual(drawn.diagram);
    drawn.lines = draw(drawn.diagram, surface.mesh.view());
    drawn.arcs = draw_arcs(surface, drawn.diagram, drawn.lines);
    for (const agvd::SurfacePoint& site : std::span(sites).first(given_sites.points.size())) {
        drawn.site_positions.push_back(agvd::position(surface.mesh.view(), site));
    }
    const std::vector<Index> places = given.vertices_of_least(drawn.diagram.nearest_distance);
    drawn.labels = carry(places, drawn.diagram.nearest_site, agvd::SiteId());
    drawn.distances = carry(places, drawn.diagram.nearest_distance, agvd::infinity);
    return drawn;
}

agvd::CutCells cut_cells(const agvd::MeshView& mesh, const DrawnSites& sites,
                         agvd::PropagationOptions options, const SurfaceOptions& as_surface,
                         const StageProgress& progress_of) {
    const GivenSurface given =
        given_surface(mesh, as_surface, options.num_threads, progress_of("clean"));
    const std::vector<agvd::SurfacePoint> points = place_sites(given, sites, options);
    const agvd::Diagram diagram =
        based_diagram(given.surface(), points, options, progress_of).diagram;
    agvd::CutCells cells = agvd::cut_cells(given.surface(), diagram, progress_of("diagram"));
    for (Index& face : cells.face_origin) face = given.face_of(face);
    return cells;
}

std::vector<double> vertex_distances(const agvd::MeshView& mesh, const DrawnSites& given_sites,
                                     agvd::PropagationOptions options,
                                     const SurfaceOptions& as_surface,
                                     const StageProgress& progress_of) {
    const GivenSurface given =
        given_surface(mesh, as_surface, options.num_threads, progress_of("clean"));
    const std::vector<agvd::SurfacePoint> sites = place_sites(given, given_sites, options);
    const auto of_given = [&](const std::vector<double>& distances) {
        return carry(given.vertices_of_least(distances), distances, agvd::infinity);
    };
    if (!options.shapes.empty()) {  // They consist of edges and faces of the surface.
        options.progress = progress_of("propagate");
        return of_given(agvd::propagate(given.surface(), sites, options).vertex_distance);
    }
    const agvd::IntrinsicTriangulation base =
        base_for(given.surface(), sites.size(), progress_of("clean"));
    options.progress = progress_of("propagate");
    const agvd::Propagation propagation =
        agvd::propagate(base.surface(), base.to_intrinsic(sites), options);
    // The base's vertices begin with those of the surface.
    return of_given(propagation.vertex_distance);
}

}  // namespace cli
