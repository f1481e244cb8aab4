// Shells that cross or touch are united two by two, in rounds, so that none is looked at often.
// What lies inside is gone then: also the shells of cavities, and what is in them.
#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <cmath>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/mesh/topology.h"
#include "remesh/quality/evaluate.h"
#include "remesh/wrap/cgal_mesh.h"
#include "remesh/wrap/wrap.h"

namespace remesh::detail {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Solid = CgalMesh;

// By the third power of its size: a shell with less is a sheet with two sides.
constexpr double least_volume = 1e-9;
// The cavities of the first union are gone after the second one.
constexpr int most_rounds = 3;

// The components of a mesh.
std::vector<TriangleMesh> shells_of(const TriangleMesh& mesh, const Topology& topology) {
    std::vector<TriangleMesh> shells(topology.components.size());
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        shells[topology.face_component[f]].triangles.push_back(mesh.triangles[f]);
    }
    for (TriangleMesh& shell : shells) {
        const auto num_vertices = static_cast<Index>(mesh.positions.size());
        shell.positions = take(mesh.positions, drop_unused(num_vertices, shell.triangles));
    }
    return shells;
}

Solid to_solid(const TriangleMesh& shell, bool is_inside_out) {
    Solid solid;
    for (const Vec3& p : shell.positions) solid.add_vertex({p.x(), p.y(), p.z()});
    for (const auto& [a, b, c] : shell.triangles) {
        const Solid::Vertex_index u(a), v(b), w(c);
        is_inside_out ? solid.add_face(u, w, v) : solid.add_face(u, v, w);
    }
    return solid;
}

// \return nothing if the union is no surface, or rounding has made faces cross.
std::optional<Solid> unite(Solid& a, Solid& b) {
    try {
        Solid both;
        const bool is_united = pmp::corefine_and_compute_union(
            a, b, both, CGAL::parameters::throw_on_self_intersection(true));
        if (is_united && CGAL::is_valid_polygon_mesh(both) && CGAL::is_closed(both)) return both;
    } catch (const pmp::Corefinement::Self_intersection_exception&) {
    }
    return std::nullopt;
}

std::optional<Solid> unite_all(std::vector<Solid> solids, Poller& poller) {
    for (; solids.size() > 1; solids.resize((solids.size() + 1) / 2)) {
        for (std::size_t i = 0; i < solids.size(); i += 2) {
            poller.poll();
            if (i + 1 == solids.size()) {
                solids[i / 2] = std::move(solids[i]);
                continue;
            }
            std::optional<Solid> both = unite(solids[i], solids[i + 1]);
            if (!both) return std::nullopt;
            solids[i / 2] = *std::move(both);
        }
    }
    return std::move(solids.front());
}

}  // namespace

std::optional<TriangleMesh> unite_solids(const TriangleMesh& mesh, int num_threads,
                                         const Progress& progress) {
    Poller poller(progress);
    TriangleMesh united = mesh;
    for (int round = 0; round < most_rounds; ++round) {
        const Topology topology = analyze_topology(united.view(), progress);
        if (!topology.is_manifold || !topology.is_oriented || topology.boundary_loops() > 0) {
            return std::nullopt;
        }
        const std::vector<double> volumes = body_volumes(united.view(), topology);
        const auto is_cavity = [](double volume) { return volume < 0; };
        if (round > 0 && std::ranges::none_of(volumes, is_cavity)) {
            const auto pairs = find_self_intersections(united, num_threads, progress);
            return pairs && pairs->empty() ? std::optional(united) : std::nullopt;
        }
        const std::vector<TriangleMesh> shells = shells_of(united, topology);
        std::vector<Solid> solids;
        for (std::size_t i = 0; i < shells.size(); ++i) {
            const double size = box_of(shells[i].view()).longest_side();
            if (!(std::abs(volumes[i]) > least_volume * size * size * size)) return std::nullopt;
            solids.push_back(to_solid(shells[i], is_cavity(volumes[i])));
        }
        std::optional<Solid> all = unite_all(std::move(solids), poller);
        if (!all) return std::nullopt;
        all->collect_garbage();
        united = to_triangle_mesh(*all);
    }
    return std::nullopt;
}

}  // namespace remesh::detail
