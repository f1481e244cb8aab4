// Geodesic Voronoi diagrams and distances.
#include <utility>

#include "calls.h"
#include "choices.h"
#include "drawn_diagram.h"
#include "mesh_message.h"
#include "options.h"
#include "run.h"
#include "sites.h"

namespace npm {
namespace {

using agvd::Index;

// What both calls are asked for with.
struct Query {
    agvd::PropagationOptions propagation;
    bool keep_slits = false;
};

Query query_of(const Request& request) {
    Options options(request.json()["options"]);
    Query query;
    query.propagation.max_error = options.number("maxError");
    query.propagation.num_threads = 1;
    query.keep_slits = options.flag("keepSlits");
    options.require_known();
    return query;
}

std::vector<std::int32_t> numbers_of(const std::vector<agvd::SiteId>& sites) {
    std::vector<std::int32_t> numbers;
    for (const agvd::SiteId site : sites) {
        numbers.push_back(site.is_valid() ? static_cast<std::int32_t>(site.value()) : -1);
    }
    return numbers;
}

}  // namespace

Answer call_voronoi(const Request& request) {
    const Query query = query_of(request);
    const agvd::MeshView mesh = view_of(request);
    Run run({{"sample", 1}, {"clean", 1}, {"propagate", 4}, {"diagram", 3}, {"dual", 1}});
    const auto sites = sites_of(request, "sites", mesh, run);
    cli::DrawnDiagram drawn =
        cli::draw_diagram(mesh, {sites}, query.propagation, {query.keep_slits, {}},
                          [&](const char* stage) { return run.of(stage); });
    std::vector<agvd::SiteId> sides;
    for (const agvd::VoronoiEdge& edge : drawn.diagram.edges) {
        sides.push_back(edge.left);
        sides.push_back(edge.right);
    }
    Answer answer;
    answer.json["certifiedError"] = drawn.certified_error;
    answer.add<std::int32_t>("labels", numbers_of(drawn.labels));
    answer.add<double>("distances", std::move(drawn.distances));
    answer.add<double>("sitePositions", std::move(drawn.site_positions));
    answer.add<double>("cellArea", std::move(drawn.diagram.cell_area));
    answer.add<std::int32_t>("cellEuler", std::move(drawn.diagram.cell_euler));
    answer.add<Index>("neighbourOffsets", std::move(drawn.cells.neighbour_offsets));
    answer.add<std::int32_t>("neighbours", numbers_of(drawn.cells.neighbours));
    answer.add<double>("points", std::move(drawn.lines.points));
    answer.add<double>("pointDistances", std::move(drawn.lines.distances));
    answer.add<Index>("lineOffsets", std::move(drawn.lines.offsets));
    answer.add<std::int32_t>("lineSites", numbers_of(sides));
    answer.add<Index>("dual", std::move(drawn.dual));
    return answer;
}

Answer call_distances(const Request& request) {
    const Query query = query_of(request);
    const agvd::MeshView mesh = view_of(request);
    Run run({{"sample", 1}, {"clean", 1}, {"propagate", 4}});
    const auto sites = sites_of(request, "sites", mesh, run);
    Answer answer;
    answer.add<double>(
        "distances", cli::vertex_distances(mesh, {sites}, query.propagation, {query.keep_slits, {}},
                                           [&](const char* stage) { return run.of(stage); }));
    return answer;
}

}  // namespace npm
