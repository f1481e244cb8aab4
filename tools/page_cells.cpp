#include "page_cells.h"

#include <span>

#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/scale.h"
#include "based_diagram.h"
#include "remesh/clean/carry.h"

namespace cli {
namespace {

using agvd::Index;

// A line may be off by this share of the diagonal: a fifth of a pixel where all of it is seen.
constexpr double line_tolerance = 1e-4;

// Appends the points between two of a line that it needs (Ramer 1972, Douglas and Peucker 1973).
void append_needed(std::span<const agvd::Vec3> line, double tolerance,
                   std::vector<agvd::Vec3>& to) {
    double most = 0;
    std::size_t farthest = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        const double distance_sq = agvd::distance_to_segment(line[i], line.front(), line.back());
        if (distance_sq <= most) continue;
        most = distance_sq;
        farthest = i;
    }
    if (!(most > tolerance * tolerance)) return;
    append_needed(line.first(farthest + 1), tolerance, to);
    to.push_back(line[farthest]);
    append_needed(line.subspan(farthest), tolerance, to);
}

}  // namespace

page::Polylines lines_for_page(const agvd::MeshView& mesh, const agvd::Diagram& diagram) {
    const agvd::MeshBox box = agvd::box_of(mesh);
    const double tolerance = line_tolerance * (box.high - box.low).norm();
    page::Polylines lines;
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const agvd::VoronoiEdge& edge = diagram.edges[e];
        if (!edge.right.is_valid()) continue;
        const Index begin = diagram.edge_points[e], end = diagram.edge_points[std::size_t{e} + 1];
        if (begin == end) continue;
        std::vector<agvd::Vec3> line;
        for (Index i = begin; i < end; ++i) {
            line.push_back(agvd::position(mesh, diagram.points[i]));
        }
        if (edge.tail == agvd::no_index) line.push_back(line.front());  // Closed.
        const std::size_t num_before = lines.points.size();
        lines.points.push_back(line.front());
        append_needed(line, tolerance, lines.points);
        lines.points.push_back(line.back());
        lines.lengths.push_back(static_cast<Index>(lines.points.size() - num_before));
    }
    return lines;
}

page::Polylines cells_for_page(const agvd::MeshView& input,
                               const std::vector<agvd::SurfacePoint>& sites,
                               const remesh::RemeshOptions& options,
                               const std::function<agvd::Progress(const char*)>& progress_of) {
    remesh::CleanOptions cleaning = options.cleaning;
    cleaning.num_threads = options.num_threads;
    cleaning.progress = progress_of("clean");
    const remesh::CleanResult clean = remesh::clean_input(input, cleaning);
    const agvd::Surface surface =
        agvd::build_surface(clean.mesh.view(), options.num_threads, progress_of("clean"));
    try {
        const std::vector<agvd::SurfacePoint> on_surface = remesh::to_cleaned(sites, input, clean);
        return lines_for_page(
            clean.mesh.view(),
            based_diagram(surface, on_surface,
                          options.propagation.for_propagation(options.num_threads, {}), progress_of)
                .diagram);
    } catch (const agvd::InvalidInput&) {
        return {};
    }
}

}  // namespace cli
