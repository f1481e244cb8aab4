#include "render/network_lines.h"

#include <array>

#include "remesh/clean/clean_input.h"
#include "remesh/curves/find_creases.h"
#include "remesh/curves/select_creases.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/sites/network_plan.h"
#include "remesh/sites/prepared_surface.h"

namespace render {
namespace {

using agvd::Index;

const std::array<Color, 7> colors{Color{0.80F, 0.02F, 0.02F}, Color{0.00F, 0.20F, 0.75F},
                                  Color{0.00F, 0.38F, 0.08F}, Color{0.70F, 0.00F, 0.55F},
                                  Color{0.90F, 0.30F, 0.00F}, Color{0.00F, 0.35F, 0.45F},
                                  Color{0.25F, 0.08F, 0.55F}};

}  // namespace

NetworkLines network_lines(const std::string& path, Index num_vertices) {
    const agvd::TriangleMesh mesh = remesh::read_mesh(path).mesh;
    const remesh::CleanResult clean = remesh::clean_input(mesh.view());
    const agvd::Surface surface = agvd::build_surface(clean.mesh.view());
    const double spacing = remesh::mean_spacing(surface, num_vertices);
    std::vector<std::uint8_t> is_crease = remesh::find_creases(surface, {.spacing = spacing});
    remesh::select_creases(surface, spacing, {}, num_vertices, {}, 0, {}, is_crease);
    const remesh::NetworkPlan plan =
        remesh::plan_network(surface, std::move(is_crease), num_vertices);
    NetworkLines result;
    for (const remesh::Curve& curve : plan.network.curves) {
        NetworkLines::Line& line = result.lines.emplace_back();
        line.color = colors[(result.lines.size() - 1) % colors.size()];
        for (std::size_t i = 0; i <= curve.num_edges(); ++i) {
            line.points.push_back(surface.mesh.positions[curve.vertex(surface, i)]);
        }
    }
    for (const Index v : plan.network.nodes) result.nodes.push_back(surface.mesh.positions[v]);
    return result;
}

}  // namespace render
