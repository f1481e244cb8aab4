#include "page/diagram_page.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "page/face_figures.h"
#include "page/thin_mesh.h"
#include "page/viewer.h"

namespace page {
namespace {

using agvd::Index;
using agvd::SiteId;

constexpr double no_cell = -1;

// Faces of which all corners lie in one cell.
FaceLabels cells_of_faces(const agvd::MeshView& mesh, const agvd::Diagram& diagram) {
    FaceLabels cells{.name = "cell", .labels = {}};
    for (const agvd::Triangle& triangle : mesh.triangles) {
        const SiteId site = diagram.nearest_site[triangle[0]];
        const bool is_one = site.is_valid() &&
                            std::all_of(triangle.begin(), triangle.end(),
                                        [&](Index v) { return diagram.nearest_site[v] == site; });
        cells.labels.push_back(is_one ? site.value() : no_cell);
        cells.has_none = cells.has_none || !is_one;
    }
    return cells;
}

// Where no site reaches, the largest distance counts.
VertexValues distances_of(const agvd::Diagram& diagram) {
    VertexValues values{.key = "nearest", .values = diagram.nearest_distance};
    double most = 0;
    for (const double d : values.values) {
        if (std::isfinite(d)) most = std::max(most, d);
    }
    for (double& d : values.values) {
        if (!std::isfinite(d)) d = most;
    }
    return values;
}

Json figures_of(const agvd::Diagram& diagram) {
    double most = 0;
    std::size_t unreached = 0;
    for (const double d : diagram.nearest_distance) {
        if (std::isfinite(d))
            most = std::max(most, d);
        else
            ++unreached;
    }
    const auto& areas = diagram.cell_area;
    std::size_t empty = 0, no_discs = 0;
    double least = agvd::infinity;
    for (std::size_t s = 0; s < areas.size(); ++s) {
        if (areas[s] == 0) {
            ++empty;
        } else {
            least = std::min(least, areas[s]);
            no_discs += diagram.cell_euler[s] == 1 ? 0U : 1U;
        }
    }
    const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
    const std::size_t cells = areas.size() - empty;
    return {{"sites", diagram.num_sites},
            {"empty_cells", empty},
            {"cells_that_are_no_discs", no_discs},
            {"voronoi_vertices", diagram.vertices.size()},
            {"voronoi_edges", diagram.edges.size()},
            {"unreached_vertices", unreached},
            {"largest_distance_mesh_units", most},
            {"area_square_mesh_units", area},
            {"mean_cell_area_square_mesh_units", cells > 0 ? area / static_cast<double>(cells) : 0},
            {"least_cell_area_square_mesh_units", cells > 0 ? least : 0},
            {"largest_cell_area_square_mesh_units",
             areas.empty() ? 0 : *std::max_element(areas.begin(), areas.end())}};
}

Json histograms_of(const agvd::Diagram& diagram) {
    const auto& areas = diagram.cell_area;
    const double mean =
        std::accumulate(areas.begin(), areas.end(), 0.0) / static_cast<double>(areas.size());
    std::vector<double> shares, neighbours;
    const agvd::Cells cells = agvd::build_cells(diagram);
    for (Index s = 0; s < diagram.num_sites; ++s) {
        if (areas[s] == 0) continue;
        shares.push_back(areas[s] / mean);
        neighbours.push_back(cells.neighbour_offsets[std::size_t{s} + 1] -
                             cells.neighbour_offsets[s]);
    }
    return {{"area", to_json(histogram_of(shares, 0, 0.1, 30))},
            {"neighbours", to_json(histogram_of(neighbours, 0, 1, 13))}};
}

}  // namespace

std::string format_page(const DiagramPage& page, const agvd::Diagram& diagram,
                        const agvd::Progress& progress) {
    const auto thin = thinned(page.mesh, page.num_threads, agvd::within(progress, 0, 0.5));
    PageMesh drawn{.name = page.name,
                   .mesh = thin ? thin->view() : page.mesh,
                   .cells = page.bisectors,
                   .isolines = page.isolines,
                   .sites = page.sites,
                   .site_lines = page.site_lines};
    if (thin) {
        drawn.thinned_from = page.mesh.triangles.size();
    } else {
        drawn.values.push_back(distances_of(diagram));
        drawn.labels = cells_of_faces(page.mesh, diagram);
    }
    const MeshBlock block = to_block(drawn);
    agvd::poll(progress, 0.9);
    Json data;
    data["version"] = page.version;
    data["command"] = page.command;
    data["original"] = block.description;
    data["diagram"] = {{"figures", figures_of(diagram)},
                       {"histograms", histograms_of(diagram)},
                       {"engine", page.engine},
                       {"certified_error", page.certified_error},
                       {"isoline_step", page.isoline_step},
                       {"warnings", page.warnings}};
    return fill_viewer(data, {{"original-mesh", block.base64}});
}

}  // namespace page
