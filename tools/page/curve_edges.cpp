// Creases are found on the repaired mesh, whose vertices have other numbers. Its points are those
// of the mesh, so edges are told by the points of their ends.
#include "page/curve_edges.h"

#include <algorithm>
#include <set>

#include "agvd/core/random.h"
#include "agvd/mesh/any_mesh.h"
#include "remesh/clean/clean_input.h"
#include "remesh/curves/find_creases.h"
#include "remesh/sites/prepared_surface.h"

namespace page {
namespace {

using agvd::Index;
using agvd::Vec3;

using Key = std::array<double, 6>;

Key key_of(const Vec3& a, const Vec3& b) {
    const std::array<double, 3> p{a.x(), a.y(), a.z()}, q{b.x(), b.y(), b.z()};
    const auto& [low, high] = std::minmax(p, q);
    return {low[0], low[1], low[2], high[0], high[1], high[2]};
}

std::set<Key> crease_keys(const agvd::MeshView& mesh, const remesh::RemeshOptions& options,
                          std::size_t num_vertices) {
    remesh::CleanOptions cleaning = options.cleaning;
    cleaning.num_threads = options.num_threads;
    const remesh::CleanResult clean = remesh::clean_input(mesh, cleaning);
    const agvd::Surface surface = agvd::build_surface(clean.mesh.view(), options.num_threads);
    remesh::CreaseOptions rule{.spacing = remesh::mean_spacing(surface, num_vertices),
                               .is_automatic = options.features != remesh::Features::Angle,
                               .num_threads = options.num_threads};
    if (!rule.is_automatic) rule.angle = options.feature_angle;
    const std::vector<std::uint8_t> is_crease = remesh::find_creases(surface, rule);
    std::set<Key> keys;
    for (Index h = 0; h < surface.edge.size(); ++h) {
        if (is_crease[surface.edge[h]] == 0) continue;
        const auto& triangle = surface.mesh.triangles[h / 3];
        keys.insert(key_of(surface.mesh.positions[triangle[h % 3]],
                           surface.mesh.positions[triangle[(h + 1) % 3]]));
    }
    return keys;
}

}  // namespace

std::vector<std::array<Index, 2>> crease_edges(const agvd::MeshView& mesh,
                                               const remesh::RemeshOptions& options,
                                               std::size_t num_vertices) {
    if (options.features == remesh::Features::Off) return {};
    std::set<Key> keys;
    try {
        keys = crease_keys(mesh, options, num_vertices);
    } catch (const agvd::InvalidInput&) {
        return {};
    }
    std::vector<std::array<Index, 2>> edges;
    agvd::for_each_edge(agvd::sorted_edge_sides(mesh.triangles), [&](const auto& sides) {
        const Index low = sides[0].low(), high = sides[0].high();
        if (keys.contains(key_of(mesh.positions[low], mesh.positions[high]))) {
            edges.push_back({low, high});
        }
    });
    return edges;
}

}  // namespace page
