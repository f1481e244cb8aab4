#include "remesh/pipeline/tile_mesher.h"

#include <utility>

#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"

namespace remesh::detail {
void lock_sites(TileInput& tile) {
    for (Index v = 0; v < tile.border_site.size(); ++v) {
        if (tile.border_site[v] != no_index) tile.cleaned.locked.vertices.push_back(v);
    }
}

std::optional<TileMesh> mesh_tile(const TileInput& tile, const StageContext& context) {
    const Surface& surface = tile.cleaned.surface;
    const KeptCurves curves{
        .has_junctions = false, .has_seams = false, .is_crease = tile.is_crease};
    CurvedSurface curved{
        .plan = plan_curves(tile.cleaned, {}, curves, tile.spacing, nullptr, context),
        .whole = &surface,
        .cleaned = &surface,
        .spacing = tile.spacing};
    if (curved.plan->network.sites_for_boundary > 0) return std::nullopt;
    Domain domain = prepare_domain(tile.cleaned, std::move(curved), context);
    const PlacedSites sites = place_sites(domain, context);
    BuiltMesh built;
    if (!place_mesh(domain, sites, built, context)) return std::nullopt;
    TileMesh made{std::move(built.mesh), {}, sites.narrow_points};
    const CurveNetwork& network = domain.plan->network.network;
    const std::vector<Index> group = groups_of_copies(sites.curves);
    for (const Index site : built.site) {
        const bool is_node = site < group.size() && group[site] < sites.curves.num_nodes();
        made.border_site.push_back(is_node ? tile.border_site[network.nodes[group[site]]]
                                           : no_index);
    }
    if (tile.is_improved) improve_in_places(domain, {}, made.mesh, context);
    return made;
}

}  // namespace remesh::detail
