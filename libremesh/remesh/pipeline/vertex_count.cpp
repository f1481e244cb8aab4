#include <algorithm>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/dual/reduce_vertices.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/dual_mesh.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/edited_mesh.h"

namespace remesh::detail {
namespace {

// Edges this much shorter than the longest one are not divided in the same round.
constexpr double length_ratio = 1.4;

// Keeps the edges along curves that are still there.
void reduce(const MeshView& surface, Index count, DualMesh& dual, const Progress& progress) {
    PlacedMesh& mesh = dual.mesh;
    std::vector<Vec3> positions;
    for (Index v = 0; v < mesh.points.size(); ++v) positions.push_back(mesh.position(surface, v));
    (void)reduce_vertices(positions, mesh.triangles, count, dual.is_last, progress);
    const std::vector<Index> left =
        drop_unused(static_cast<Index>(mesh.points.size()), mesh.triangles);
    mesh.points = take(mesh.points, left);
    mesh.offsets = take(mesh.offsets, left);
    dual.site = take(dual.site, left);
    dual.is_last = take(dual.is_last, left);
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles);
    std::vector<DirectedEdge> hard = rim_of(mesh.triangles);
    for (const auto& [from, to] : mesh.hard) {
        const Index a = rank_of(left, from), b = rank_of(left, to);
        if (a == left.size() || b == left.size() || left[a] != from || left[b] != to) continue;
        if (std::ranges::binary_search(sides, edge_key(a, b), {}, &EdgeSide::ends)) {
            hard.emplace_back(a, b);
        }
    }
    mesh.hard = std::move(hard);
}

// Adds vertices in the middle of the longest edges off the curves.
void divide_edges(const Domain& domain, Index count, DualMesh& dual) {
    const MeshCurves curves = domain.curves();
    EditedMesh edited(curves, dual.mesh, find_mobility(domain, curves, dual.mesh));
    auto num_vertices = static_cast<Index>(dual.mesh.points.size());
    for (bool is_changed = true; is_changed && num_vertices < count;) {
        is_changed = false;
        std::vector<std::pair<double, Index>> edges;  // Minus the length, half-edge.
        for (Index h = 0; h < 3 * edited.num_faces(); ++h) {
            const EditedMesh::Face& face = edited.face(h / 3);
            const Index a = face.corner[h % 3], b = face.corner[(h + 1) % 3];
            if (!face.is_there || face.is_hard(h % 3) || a > b) continue;
            edges.emplace_back(-(edited.at(a) - edited.at(b)).norm(), h);
        }
        if (edges.empty()) return;
        std::ranges::sort(edges);
        std::vector<bool> has_changed(edited.num_faces(), false);
        for (const auto& [length, h] : edges) {
            if (num_vertices == count || (is_changed && length > edges[0].first / length_ratio))
                break;
            if (has_changed[h / 3]) continue;
            const Index added = edited.split(h / 3, h % 3);
            if (added == no_index) continue;
            for (const Index f : edited.faces_at(added)) {
                if (f < has_changed.size()) has_changed[f] = true;
            }
            is_changed = true;
            ++num_vertices;
        }
    }
    std::vector<Index> numbers;
    dual.mesh = edited.result(numbers);
    dual.site.resize(numbers.empty() ? 0 : numbers.back() + 1, no_index);
    dual.is_last.resize(dual.site.size(), 0);
    dual.site = take(dual.site, numbers);
    dual.is_last = take(dual.is_last, numbers);
}

}  // namespace

void set_vertex_count(const Domain& domain, Index count, bool may_add, DualMesh& dual,
                      const StageContext& context) {
    const auto num_vertices = static_cast<Index>(dual.mesh.points.size());
    if (num_vertices == count || (num_vertices < count && !may_add)) return;
    const StageClock clock(Stage::Dual, context.result);
    if (num_vertices > count) {
        reduce(domain.whole->mesh.view(), count, dual, progress_of(Stage::Dual, context.options));
    } else {
        divide_edges(domain, count, dual);
    }
}

}  // namespace remesh::detail
