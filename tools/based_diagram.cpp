#include "based_diagram.h"

#include <algorithm>
#include <utility>

#include "agvd/diagram/diagram.h"
#include "agvd/propagation/propagate.h"
#include "remesh/sites/prepared_surface.h"

namespace cli {
namespace {

// The base of a small input may have this many vertices.
constexpr agvd::Index few_vertices = 10'000;

// Longest edge of the base, a quarter of the sites' spacing: points on longer edges lie too far
// apart for the Steiner engine, and long arcs in one face are drawn less accurately. It is longer
// if the base would have many more vertices than the input, or than few_vertices.
double longest_edge(const agvd::Surface& surface, std::size_t num_sites) {
    const agvd::Index num_vertices = std::max(surface.num_vertices(), few_vertices);
    return std::max(remesh::mean_spacing(surface, num_sites) / 4,
                    2 * remesh::mean_spacing(surface, num_vertices));
}

// Limits the splits on thin surfaces, which otherwise grow with their length.
agvd::Index most_splits(const agvd::Surface& surface) {
    return 4 * std::max(surface.num_vertices(), few_vertices);
}

// Without a base: lines run along edges of the surface.
BasedDiagram plain_diagram(const agvd::Surface& surface,
                           const std::vector<agvd::SurfacePoint>& sites,
                           agvd::PropagationOptions options,
                           const std::function<agvd::Progress(const char*)>& progress_of,
                           std::optional<double> chord) {
    options.progress = progress_of("propagate");
    agvd::TracedDiagram traced = agvd::trace_diagram(
        surface, sites, options,
        {.chord = chord, .num_threads = options.num_threads, .progress = progress_of("diagram")});
    return {std::move(traced.diagram), traced.certified_error};
}

}  // namespace

agvd::IntrinsicTriangulation base_for(const agvd::Surface& surface, std::size_t num_sites,
                                      const agvd::Progress& progress) {
    return agvd::IntrinsicTriangulation(surface, {.max_length = longest_edge(surface, num_sites),
                                                  .most_splits = most_splits(surface),
                                                  .progress = progress});
}

BasedDiagram based_diagram(const agvd::Surface& surface,
                           const std::vector<agvd::SurfacePoint>& sites,
                           agvd::PropagationOptions options,
                           const std::function<agvd::Progress(const char*)>& progress_of,
                           std::optional<double> chord) {
    if (!options.shapes.empty()) return plain_diagram(surface, sites, options, progress_of, chord);
    const agvd::IntrinsicTriangulation base = base_for(surface, sites.size(), progress_of("clean"));
    const std::vector<agvd::SurfacePoint> on_base = base.to_intrinsic(sites);
    options.progress = progress_of("propagate");
    const agvd::Progress drawing = progress_of("diagram");
    agvd::DiagramOptions drawn{
        .chord = chord, .num_threads = options.num_threads, .progress = drawing};
    // Where they cross edges of the input arcs are on the bisectors, chords are not.
    if (options.max_error == 0.0 && !chord) drawn.chord = longest_edge(surface, sites.size()) / 100;
    agvd::TracedDiagram traced = agvd::trace_diagram(base.surface(), on_base, options, drawn);
    agvd::Diagram diagram = agvd::diagram_on_input(base, std::move(traced.diagram), drawing);
    if (!chord) diagram.arcs = {};
    if (!chord) diagram.edge_arcs = {};
    return {std::move(diagram), traced.certified_error};
}

}  // namespace cli
