#include "remesh/pipeline/crossings.h"

#include <algorithm>
#include <utility>

#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/placement/placement.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/quality/evaluate.h"

namespace remesh::detail {
namespace {

// Most rounds that move vertices back onto the surface.
constexpr int max_unfits = 4;

using Corners = std::array<Vec3, 3>;

Vec3 normal_of(const Corners& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

// The part of a triangle in the plane of another; empty if there is none or if it is all of it.
std::vector<Vec3> segment_in_plane(const Corners& t, const Corners& plane) {
    const Vec3 normal = normal_of(plane);
    std::array<double, 3> height{};
    for (std::size_t i = 0; i < 3; ++i) height[i] = normal.dot(t[i] - plane[0]);
    std::vector<Vec3> ends;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (height[i] == 0) ends.push_back(t[i]);
        if ((height[i] < 0 && height[j] > 0) || (height[i] > 0 && height[j] < 0)) {
            ends.emplace_back(t[i] + height[i] / (height[i] - height[j]) * (t[j] - t[i]));
        }
    }
    if (ends.size() == 1) ends.push_back(ends[0]);
    if (ends.size() != 2) ends.clear();
    return ends;
}

std::optional<FacePairs> find_in(const MeshView& mesh, const RemeshOptions& options) {
    return find_self_intersections(mesh, options.num_threads, progress_of(Stage::Check, options));
}

// Moves a vertex and all its copies back onto the surface.
void unfit(Index v, PlacedMesh& mesh) {
    mesh.offsets[v].setZero();
    for (Index other = 0; other < mesh.place.size(); ++other) {
        if (mesh.place[other] == mesh.place[v]) mesh.offsets[other].setZero();
    }
}

// The triangles with the first vertex at its position in place of each vertex.
std::vector<Triangle> join_positions(const MeshView& mesh) {
    Ticker none;
    return rename_vertices(mesh.triangles, first_at_position(mesh.positions, none));
}

// As it is searched: sheets share vertices where they meet, and so do parts at locked positions.
// Some vertices may be in no triangle.
TriangleMesh welded_mesh(const CurvedSurface& curved, const PlacedMesh& mesh) {
    TriangleMesh whole = whole_mesh(*curved.whole, mesh);
    if (!mesh.place.empty()) whole.triangles = rename_vertices(whole.triangles, mesh.place);
    if (curved.has_locked()) whole.triangles = join_positions(whole);
    return whole;
}

}  // namespace

FacePairs find_folds(const MeshView& mesh) {
    FacePairs folds;
    for_each_edge(sorted_edge_sides(mesh.triangles), [&](std::span<const EdgeSide> edge) {
        if (edge.size() != 2) return;
        const Index f = edge[0].half_edge / 3, g = edge[1].half_edge / 3;
        if (is_fold(normal_of(corners_of(mesh, f)), normal_of(corners_of(mesh, g)))) {
            folds.push_back(std::minmax(f, g));
        }
    });
    return folds;
}

Corners crossing_triangle(const Corners& a, const Corners& b) {
    std::vector<Vec3> of_a = segment_in_plane(a, b), of_b = segment_in_plane(b, a);
    if (of_a.empty()) std::swap(of_a, of_b);
    // In one plane, or apart by rounding.
    if (of_a.empty()) return normal_of(a).norm() < normal_of(b).norm() ? a : b;
    const bool is_b_shorter =
        !of_b.empty() && (of_b[1] - of_b[0]).norm() < (of_a[1] - of_a[0]).norm();
    const std::vector<Vec3>& ends = is_b_shorter ? of_b : of_a;
    return {ends[0], ends[1], ends[1]};
}

TriangleMesh crossing_triangles(const MeshView& mesh, const FacePairs& pairs) {
    TriangleMesh triangles;
    for (const auto& [f, g] : pairs) {
        const auto first = static_cast<Index>(triangles.positions.size());
        const Corners triangle = crossing_triangle(corners_of(mesh, f), corners_of(mesh, g));
        triangles.positions.insert(triangles.positions.end(), triangle.begin(), triangle.end());
        triangles.triangles.push_back({first, first + 1, first + 2});
    }
    return triangles;
}

FacePairs pairs_elsewhere(const ClosestPointTree& triangles, const MeshView& mesh,
                          const FacePairs& pairs) {
    FacePairs elsewhere;
    for (const auto& [f, g] : pairs) {
        const Corners a = corners_of(mesh, f), b = corners_of(mesh, g);
        const Corners triangle = crossing_triangle(a, b);
        const double reach = std::max(longest_edge_of(a), longest_edge_of(b));
        const Vec3 middle = (triangle[0] + triangle[1]) / 2;
        if (!triangles.is_within(middle, reach)) elsewhere.emplace_back(f, g);
    }
    return elsewhere;
}

std::optional<FacePairs> CrossingFinder::find(const PlacedMesh& mesh) {
    const StageClock clock(Stage::Check, context_.result);
    poll(progress_of(Stage::Check, context_.options), 0);
    const TriangleMesh whole = welded_mesh(curved_, mesh);
    std::optional<FacePairs> all = find_in(whole, context_.options);
    if (all) add_folds(whole, *all);
    if (all && !all->empty()) {
        if (!of_input_.is_searched || of_input_.is_welded != curved_.has_junctions()) {
            find_in_input();
        }
        context_.result.input_self_intersections = of_input_.num_pairs;
    }
    return all;
}

CrossingFaces CrossingFinder::tell_added(const PlacedMesh& mesh, FacePairs all) {
    const StageClock clock(Stage::Check, context_.result);
    CrossingFaces found{std::move(all), {}};
    if (found.all.size() <= context_.result.input_self_intersections) return found;
    const auto& triangles = of_input_.triangles;
    found.added =
        triangles ? pairs_elsewhere(*triangles, welded_mesh(curved_, mesh), found.all) : found.all;
    return found;
}

void CrossingFinder::add_folds(const MeshView& mesh, FacePairs& pairs) {
    FacePairs folds = find_folds(mesh);
    if (folds.empty()) return;
    if (!std::exchange(of_input_.are_folds_searched, true)) {
        const MeshView input = curved_.cleaned->mesh.view();
        const FacePairs of_input = find_folds(input);
        if (!of_input.empty()) of_input_.folds.emplace(crossing_triangles(input, of_input));
    }
    if (of_input_.folds) folds = pairs_elsewhere(*of_input_.folds, mesh, folds);
    pairs.insert(pairs.end(), folds.begin(), folds.end());
}

void CrossingFinder::find_in_input() {
    const bool is_coarse = curved_.cleaned != curved_.whole;
    const TriangleMesh& input = curved_.cleaned->mesh;
    std::vector<Triangle> welded;
    if (curved_.has_locked() || (is_coarse && curved_.has_junctions())) {
        welded = join_positions(input);
    } else if (curved_.has_junctions()) {
        welded = rename_vertices(input.triangles, first_copies(curved_.plan->network.junctions,
                                                               curved_.whole->num_vertices()));
    }
    const MeshView mesh{input.positions, welded.empty() ? input.triangles : welded};
    const FacePairs pairs = find_in(mesh, context_.options).value();
    of_input_.is_searched = true;
    of_input_.is_welded = curved_.has_junctions();
    of_input_.num_pairs = static_cast<Index>(pairs.size());
    of_input_.triangles.reset();
    if (!pairs.empty()) {
        of_input_.triangles.emplace(crossing_triangles(mesh, pairs),
                                    progress_of(Stage::Check, context_.options));
    }
}

std::optional<CrossingFaces> unfit_crossings(CrossingFinder& finder, PlacedMesh& mesh,
                                             RemeshResult& result) {
    std::optional<FacePairs> crossings = finder.find(mesh);
    result.unfitted_vertices = 0;
    for (int round = 0; round < max_unfits && crossings && !crossings->empty(); ++round) {
        bool is_changed = false;
        for_each_corner(*crossings, mesh.triangles, [&](Index v) {
            if (mesh.offsets[v].isZero(0)) return;
            unfit(v, mesh);
            ++result.unfitted_vertices;
            is_changed = true;
        });
        if (!is_changed) break;
        crossings = finder.find(mesh);
    }
    if (!crossings) return std::nullopt;
    return finder.tell_added(mesh, *std::move(crossings));
}

std::optional<Index> count_crossings_at(const MeshView& mesh,
                                        std::span<const std::uint8_t> is_marked, int num_threads,
                                        const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    MeshBox marked;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        if (is_marked[f] == 0) continue;
        for (const Vec3& corner : corners_of(mesh, f)) marked.add(corner);
    }
    std::vector<Index> faces;
    std::vector<Triangle> near;
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        MeshBox box;
        for (const Vec3& corner : corners_of(mesh, f)) box.add(corner);
        if (!box.meets(marked)) continue;
        faces.push_back(f);
        near.push_back(mesh.triangles[f]);
    }
    const auto pairs = find_self_intersections({mesh.positions, near}, num_threads, progress);
    if (!pairs) return std::nullopt;
    return static_cast<Index>(std::count_if(pairs->begin(), pairs->end(), [&](const auto& pair) {
        return is_marked[faces[pair.first]] != 0 || is_marked[faces[pair.second]] != 0;
    }));
}

}  // namespace remesh::detail
