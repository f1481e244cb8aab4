#include "remesh/pipeline/tile_mesher.h"

#include <utility>

#include "remesh/pipeline/build_mesh.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/place_sites.h"
#include "remesh/pipeline/placed_dual.h"
#include "remesh/placement/mesh_curves.h"

namespace remesh::detail {
namespace {

// In both directions.
std::vector<DirectedEdge> edges_on_creases(const MeshCurves& curves, const PlacedMesh& mesh) {
    std::vector<CurvePlace> place;
    place.reserve(mesh.points.size());
    for (const SurfacePoint& point : mesh.points) place.push_back(curves.place_of(point));
    std::vector<DirectedEdge> edges;
    for (const Triangle& t : mesh.triangles) {
        for (Index k = 0; k < 3; ++k) {
            const Index from = t[k], to = t[(k + 1) % 3];
            if (!place[from].is_free() && !place[to].is_free() &&
                curves.are_on_crease(place[from], place[to])) {
                edges.emplace_back(from, to);
            }
        }
    }
    return edges;
}

}  // namespace

void lock_sites(TileInput& tile) {
    for (Index v = 0; v < tile.border_site.size(); ++v) {
        if (tile.border_site[v] != no_index) tile.cleaned.locked.vertices.push_back(v);
    }
}

std::optional<MeshedTile> mesh_tile(const TileInput& tile, const StageContext& context) {
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
    const std::optional<PlacedDual> placed = place_mesh(domain, sites, built, context);
    if (!placed) return std::nullopt;
    MeshedTile made{joined_mesh(*placed), {}, {}, sites.narrow_points};
    made.border_site.assign(made.joined.mesh.points.size(), no_index);
    const CurveNetwork& network = domain.plan->network.network;
    const JoinedPatches& patches = *placed->patches;
    for (Index v = 0; v < patches.group.size(); ++v) {
        if (patches.group[v] >= sites.curves.num_nodes()) continue;
        made.border_site[patches.glued.vertex[v]] =
            tile.border_site[network.nodes[patches.group[v]]];
    }
    if (tile.is_improved) improve_in_places(domain, made.joined, context);
    made.creases =
        edges_on_creases(MeshCurves(*domain.whole, domain.cut(), network), made.joined.mesh);
    return made;
}

}  // namespace remesh::detail
