#include "diagram_for_page.h"

#include <algorithm>
#include <cmath>

#include "agvd/mesh/scale.h"
#include "agvd/paths/isolines.h"
#include "agvd/propagation/shape_source.h"
#include "page_cells.h"

namespace cli {
namespace {

using agvd::Index;

// Lines of equal distance, at most.
constexpr double most_levels = 12;
// Largest distance of a line from its arcs, as a share of the diagonal.
constexpr double isoline_tolerance = 1e-4;

// 1, 2 or 5 times a power of ten. \param distance  above 0.
double step_for(double distance) {
    const double least = distance / most_levels;
    const double power = std::pow(10, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= least) return factor * power;
    }
    return 10 * power;
}

double largest_distance(const std::vector<double>& distances) {
    double most = 0;
    for (const double d : distances) {
        if (std::isfinite(d)) most = std::max(most, d);
    }
    return most;
}

// The edges of lines and of the rims of regions.
page::Polylines lines_of(const agvd::Surface& surface, const std::vector<agvd::SiteShape>& shapes) {
    std::vector<Index> edges;
    for (const agvd::ShapeSource& source : agvd::sources_of(surface, shapes)) {
        for (const Index side : source.sides) edges.push_back(surface.edge[side]);
    }
    page::Polylines lines;
    for (const Index edge : agvd::distinct(std::move(edges))) {
        const Index h = surface.edge_half[edge];
        lines.points.push_back(surface.mesh.positions[surface.tail(h)]);
        lines.points.push_back(surface.mesh.positions[surface.head(h)]);
        lines.lengths.push_back(2);
    }
    return lines;
}

page::Polylines isolines_every(double step, const agvd::Surface& surface,
                               const agvd::Propagation& propagation, int num_threads,
                               const agvd::Progress& progress) {
    const agvd::MeshView mesh = surface.mesh.view();
    const agvd::MeshBox box = agvd::box_of(mesh);
    const agvd::Isolines isolines =
        agvd::build_isolines(surface, propagation, agvd::levels_every(propagation, step),
                             {.num_threads = num_threads, .progress = progress});
    const agvd::DrawnIsolines drawn =
        agvd::draw_isolines(surface, isolines, isoline_tolerance * (box.high - box.low).norm());
    page::Polylines lines;
    for (const agvd::SurfacePoint& point : drawn.points) {
        lines.points.push_back(agvd::position(mesh, point));
    }
    for (std::size_t l = 0; l + 1 < drawn.offsets.size(); ++l) {
        lines.lengths.push_back(drawn.offsets[l + 1] - drawn.offsets[l]);
    }
    return lines;
}

}  // namespace

page::DiagramPage diagram_for_page(const agvd::Surface& surface,
                                   const std::vector<agvd::SurfacePoint>& sites,
                                   const agvd::Diagram& diagram,
                                   agvd::PropagationOptions propagating, double certified_error,
                                   const std::function<agvd::Progress(const char*)>& progress_of) {
    page::DiagramPage page{.engine = agvd::engine_name(propagating.engine),
                           .mesh = surface.mesh.view(),
                           .bisectors = lines_for_page(surface.mesh.view(), diagram),
                           .certified_error = certified_error,
                           .num_threads = propagating.num_threads};
    for (const agvd::SurfacePoint& site : sites) {
        page.sites.push_back(agvd::position(page.mesh, site));
    }
    page.site_lines = lines_of(surface, propagating.shapes);
    const double most = largest_distance(diagram.nearest_distance);
    if (most == 0) return page;
    page.isoline_step = step_for(most);
    propagating.relay_faces = agvd::all_faces(surface);
    propagating.progress = progress_of("propagate");
    const agvd::Propagation propagation = agvd::propagate(surface, sites, propagating);
    page.isolines = isolines_every(page.isoline_step, surface, propagation, propagating.num_threads,
                                   progress_of("isolines"));
    return page;
}

}  // namespace cli
