#include <algorithm>
#include <string>
#include <utility>

#include "agvd/core/number_text.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/crossings.h"
#include "remesh/pipeline/region.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// The rim and other vertices of the region, numbered as in it. Vertices outside stay anyway.
std::vector<Index> locked_vertices(const Region& region, const std::vector<Index>& locked) {
    std::vector<Index> result;
    for (const RimVertex& rim : region.rim) result.push_back(rim.vertex);
    for (const Index v : locked) {
        if (v >= region.number.size()) {
            throw InvalidInput("vertex " + index_text(v) + " is locked, but the mesh has only " +
                               std::to_string(region.number.size()) +
                               " vertices, counted from 0; name one of these");
        }
        if (region.number[v] != no_index) result.push_back(region.number[v]);
    }
    return result;
}

using Edges = std::vector<std::array<Index, 2>>;

// The edges of the region among edges of the mesh, numbered as in it.
// \param what  they are, for an error.
Edges edges_inside(const MeshView& mesh, const Region& region, const Edges& edges,
                   const std::string& what) {
    if (edges.empty()) return {};
    const std::vector<EdgeSide> inside = sorted_edge_sides(region.mesh.triangles);
    const std::vector<EdgeSide> all = sorted_edge_sides(mesh.triangles);
    Edges result;
    for (const auto& [a, b] : edges) {
        if (!has_sides(all, edge_key(a, b))) {
            throw InvalidInput("the " + what + " edge between vertices " + index_text(a) + " and " +
                               index_text(b) +
                               " is not an edge of the mesh; name the two ends of an edge, counted "
                               "from 0");
        }
        const Index i = region.number[a], j = region.number[b];
        if (has_sides(inside, edge_key(i, j))) result.push_back({i, j});
    }
    return result;
}

// Target lengths let edges grow from those of the rim. Where all are to be equally long, they are
// given: the mean of all edges would count those near the rim, too.
Sizing sizing_of_region(const Sizing& given, const Region& region) {
    Sizing sizing = given;
    if (auto* lengths = std::get_if<VertexLengths>(&sizing.edges)) {
        lengths->values = take(lengths->values, region.vertices);
    } else if (auto* of_faces = std::get_if<FaceLengths>(&sizing.edges)) {
        of_faces->values = take(of_faces->values, region.faces);
    } else if (auto* densities = std::get_if<VertexDensities>(&sizing.edges)) {
        densities->values = take(densities->values, region.vertices);
    }
    if (!given.is_even() || std::holds_alternative<MaxDistance>(given.count)) return sizing;
    const auto* mean = std::get_if<MeanEdge>(&given.count);
    sizing.edges = VertexLengths{
        std::vector<double>(region.vertices.size(), mean != nullptr ? mean->length : 1)};
    if (mean != nullptr) sizing.count = CountOfLengths{};
    return sizing;
}

RemeshOptions options_of_region(const MeshView& mesh, const RemeshOptions& given,
                                const Region& region) {
    const auto inside = [&](const Edges& edges, const char* what) {
        return edges_inside(mesh, region, edges, what);
    };
    RemeshOptions options = given;
    options.region.clear();
    options.locked = locked_vertices(region, given.locked);
    options.locked_edges = inside(given.locked_edges, "locked");
    options.locked_edges.insert(options.locked_edges.end(), region.rim_edges.begin(),
                                region.rim_edges.end());
    options.feature_edges = inside(given.feature_edges, "feature");
    options.texture_seams = inside(given.texture_seams, "rim");
    if (!given.face_labels.empty()) options.face_labels = take(given.face_labels, region.faces);
    if (!region.rim_edges.empty()) options.sizing = sizing_of_region(given.sizing, region);
    return options;
}

// For each kept vertex a corner of a kept face; then those of the region's own vertices.
std::vector<SurfacePoint> sites_of(const Region& region, const GluedRegion& glued,
                                   const std::vector<SurfacePoint>& remeshed) {
    std::vector<SurfacePoint> sites(glued.mesh.positions.size());
    for (Index v = 0; v < remeshed.size(); ++v) {
        SurfacePoint& site = sites[glued.vertex[v]];
        site = remeshed[v];
        site.face = FaceId(region.faces[site.face.value()]);
    }
    for (Index i = 0; i < region.kept.size(); ++i) {
        for (Index k = 0; k < 3; ++k) {
            sites[glued.mesh.triangles[i][k]] = point_on(3 * region.kept[i] + k, 0);
        }
    }
    return sites;
}

// Replaces the numbers for the region alone: now faces that stay count as well.
void count_crossings(const MeshView& mesh, const Region& region, const RemeshOptions& options,
                     RemeshResult& result) {
    const StageClock clock(Stage::Check, result);
    const Progress last = progress_at(Stage::Check, options, 1);
    std::vector<std::uint8_t> is_new(result.mesh.triangles.size(), 1);
    std::fill_n(is_new.begin(), region.kept.size(), 0);
    result.self_intersections =
        count_crossings_at(result.mesh.view(), is_new, options.num_threads, last);
    result.input_self_intersections = result.new_self_intersections = 0;
    if (result.self_intersections.value_or(0) == 0) return;
    std::vector<std::uint8_t> is_inside(mesh.triangles.size(), 0);
    for (const Index f : region.faces) is_inside[f] = 1;
    result.input_self_intersections =
        *count_crossings_at(mesh, is_inside, options.num_threads, last);
    const Index pairs = *result.self_intersections;
    result.new_self_intersections = pairs - std::min(pairs, result.input_self_intersections);
}

}  // namespace

RemeshResult remesh_region(const MeshView& mesh, const RemeshOptions& options) {
    const Region region = cut_region(mesh, options.region, cleaning_of(options));
    RemeshResult result = remesh(region.mesh, options_of_region(mesh, options, region));
    const Progress last = progress_at(Stage::Check, options, 1);
    Poller last_poller(last);
    Ticker last_ticker(last_poller);
    GluedRegion glued = glue_region(mesh, region, result.mesh, last_ticker);
    result.sites = sites_of(region, glued, result.sites);
    result.mesh = std::move(glued.mesh);
    result.verdict.bodies =
        count_bodies(result.mesh, analyze_topology(result.mesh.view(), last), last_ticker);
    result.sizing.targets.clear();
    for (ForcedFace& forced : result.forced) {
        forced.face += static_cast<Index>(region.kept.size());
    }
    result.kept = {std::move(glued.kept_vertices), region.kept,
                   static_cast<Index>(region.rim_edges.size())};
    count_crossings(mesh, region, options, result);
    return result;
}

}  // namespace remesh::detail
