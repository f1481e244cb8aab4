#include "remesh/pipeline/place_vertices.h"

#include <utility>

#include "remesh/placement/placement.h"

namespace remesh::detail {
namespace {

// As a share of the spacing: lengths up to this are rounding.
constexpr double rounding = 1e-10;

// #V of the base: the vertex of the dual in whose cell each lies; no_index: none.
std::vector<Index> nearest_vertices(const ValidDual& dual) {
    std::vector<Index> vertex(dual.diagram.num_sites, no_index);
    for (Index v = 0; v < dual.site.size(); ++v) {
        if (dual.site[v] != no_index) vertex[dual.site[v]] = v;
    }
    std::vector<Index> nearest;
    nearest.reserve(dual.diagram.nearest_site.size());
    for (const SiteId site : dual.diagram.nearest_site) {
        nearest.push_back(site.is_valid() ? vertex[site.value()] : no_index);
    }
    return nearest;
}

// #V of the dual: 1 for vertices at nodes of the network.
std::vector<std::uint8_t> find_nodes(const CurveSites& curves, const ValidDual& dual) {
    std::vector<std::uint8_t> is_node;
    for (const Index site : dual.site) {
        is_node.push_back(site < curves.first_copy[curves.num_nodes()] ? 1 : 0);
    }
    return is_node;
}

void fit_on_curves(const Domain& domain, const CurveSites& curves, const JoinedPatches& patches,
                   Boundary boundary, PlacedMesh& placed) {
    const std::vector<Vec3> offsets =
        fit_curves(*domain.whole, domain.plan->network.network, curves, boundary);
    for (Index v = 0; v < patches.group.size(); ++v) {
        if (patches.group[v] < offsets.size()) placed.offsets[v] = offsets[patches.group[v]];
    }
}

}  // namespace

PlacedMesh place_vertices(Domain& domain, const CurveSites& curves, const ValidDual& dual,
                          std::vector<SurfacePoint> places, const JoinedPatches* patches,
                          const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Place, result);
    const Progress progress = progress_of(Stage::Place, options);
    poll(progress, 0);
    PlacedMesh placed{std::move(places), {}, dual.mesh.triangles};
    placed.offsets.assign(placed.points.size(), Vec3::Zero());
    const std::vector<Index> nearest = nearest_vertices(dual);
    // Those inside faces of the surface are locked; all others are on its boundary.
    std::vector<std::uint8_t> stays;
    if (domain.plan) stays = find_nodes(curves, dual);
    const bool is_fitted = options.fit.value_or(is_relaxed(options));
    // The pieces are large: they are freed before the fit.
    std::vector<CellSample> samples;
    std::vector<CellPlanes> planes;
    if (is_fitted || is_relaxed(options)) {
        const Progress start = within(progress, 0, 0);
        const auto num_vertices = static_cast<Index>(placed.points.size());
        PreparedSurface& prepared = domain.prepared;
        prepared.find_pieces(options.num_threads, start);
        if (is_relaxed(options)) {
            planes = planes_of_cells(prepared, nearest, num_vertices, options.num_threads, start);
        }
        if (is_fitted) samples = sample_cells(prepared, nearest, num_vertices, start);
        prepared.pieces.reset();
    }
    if (is_fitted) {
        if (patches != nullptr) {
            fit_on_curves(domain, curves, *patches, options.boundary, placed);
        }
        fit_vertices(domain.prepared.base, nearest, std::move(samples), placed, options.num_threads,
                     within(progress, 0, 0), domain.plan ? rounding * domain.spacing : 0, stays);
    }
    if (is_relaxed(options)) {
        improve_shape(domain.prepared.input(), planes, placed, within(progress, 0.5, 0.5),
                      domain.sizes, stays);
    }
    poll(progress, 1);
    return placed;
}

}  // namespace remesh::detail
