#include "page/page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "agvd/core/parallel.h"
#include "agvd/mesh/closest_point.h"
#include "page/curve_edges.h"
#include "page/face_figures.h"
#include "page/thin_mesh.h"
#include "page/viewer.h"

namespace page {
namespace {

using agvd::Index;
using agvd::Vec3;
using agvd::within;

constexpr std::size_t num_worst_faces = 10;
constexpr Index distance_grain = 512;  // Vertices in a chunk of queries.

Json to_json(const Histograms& histograms) {
    return {{"angle", to_json(histograms.angle)},
            {"quality", to_json(histograms.quality)},
            {"edge", to_json(histograms.edge)},
            {"valence", to_json(histograms.valence)}};
}

// Full precision: the viewer's own figures come from rounded positions.
Json worst_of(const agvd::MeshView& mesh) {
    Json list = Json::array();
    for (const Index f : worst_faces(mesh, num_worst_faces)) {
        const std::array<Vec3, 3> corners = agvd::corners_of(mesh, f);
        const remesh::FaceShape shape = remesh::measure_face(corners);
        Json points = Json::array();
        for (const Vec3& corner : corners) points.push_back(point_json(corner));
        list.push_back({{"face", f},
                        {"quality", shape.quality},
                        {"min_angle_deg", shape.smallest_angle() * 180 / std::numbers::pi},
                        {"corners", points}});
    }
    return list;
}

// What differs from run to run, or with the number of threads, is left out.
Json settings_of(const std::string& report) {
    if (report.empty()) return {};
    Json all = Json::parse(report);
    for (const char* key : {"stage_seconds", "total_s", "propagation_bytes"}) all.erase(key);
    all["options"].erase("threads");
    return all;
}

Json farthest_of(const std::optional<remesh::SurfaceDistance>& distance) {
    if (!distance) return {};
    return {{"from_original", point_json(distance->from_original.farthest)},
            {"from_result", point_json(distance->from_result.farthest)}};
}

// For each vertex of one mesh the distance to the other.
VertexValues distances(const agvd::MeshView& from, const agvd::ClosestPointTree& to,
                       int num_threads, const agvd::Progress& progress) {
    VertexValues distance{"distance", std::vector<double>(from.positions.size()), true};
    agvd::Poller poller(progress);
    agvd::parallel_each(
        static_cast<Index>(from.positions.size()), distance_grain, num_threads,
        [&](Index v) { distance.values[v] = std::sqrt(to.query(from.positions[v]).distance_sq); },
        poller);
    return distance;
}

// A mesh of the page, and what it refers to.
struct Drawn {
    std::optional<agvd::TriangleMesh> thin;
    PageMesh mesh;
};

Drawn draw(const Page& page, const agvd::MeshView& mesh, const agvd::MeshView& other,
           const agvd::Progress& progress) {
    const int num_threads = page.options.num_threads;
    Drawn drawn{.thin = thinned(mesh, num_threads, within(progress, 0, 0.5)), .mesh = {}};
    drawn.mesh.mesh = drawn.thin ? drawn.thin->view() : mesh;
    if (drawn.thin) drawn.mesh.thinned_from = mesh.triangles.size();
    const agvd::ClosestPointTree tree(other, within(progress, 0.5, 0.6));
    VertexValues distance =
        distances(drawn.mesh.mesh, tree, num_threads, within(progress, 0.6, 0.9));
    // Squares of huge coordinates overflow.
    const bool is_known = std::all_of(distance.values.begin(), distance.values.end(),
                                      [](double d) { return std::isfinite(d); });
    if (is_known) drawn.mesh.values.push_back(std::move(distance));
    drawn.mesh.creases = crease_edges(drawn.mesh.mesh, page.options, page.result.positions.size());
    agvd::poll(progress, 1);
    return drawn;
}

}  // namespace

std::string format_page(const Page& page, const agvd::Progress& progress) {
    Drawn original = draw(page, page.original, page.result, within(progress, 0, 0.4));
    Drawn result = draw(page, page.result, page.original, within(progress, 0.4, 0.8));
    original.mesh.name = page.original_name;
    result.mesh.name = page.result_name;
    original.mesh.cells = page.cells;
    const auto add = [](const std::vector<VertexValues>& more, PageMesh& mesh) {
        mesh.values.insert(mesh.values.end(), more.begin(), more.end());
    };
    if (!original.thin) {
        original.mesh.labels = page.original_labels;
        add(page.original_colors, original.mesh);
    }
    if (!result.thin) {
        result.mesh.labels = page.result_labels;
        add(page.result_colors, result.mesh);
        if (!page.targets.empty()) result.mesh.values.push_back({"target", page.targets});
    }
    const MeshBlock of_original = to_block(original.mesh), of_result = to_block(result.mesh);
    agvd::poll(progress, 0.9);
    Json data;
    data["version"] = page.version;
    data["command"] = page.command;
    data["original"] = of_original.description;
    data["result"] = of_result.description;
    data["evaluation"] = Json::parse(remesh::to_json(page.evaluation));
    data["farthest"] = farthest_of(page.evaluation.distance);
    data["histograms"] = {{"original", to_json(histograms_of(page.original, {}))},
                          {"result", to_json(histograms_of(page.result, page.targets))}};
    data["worst"] = worst_of(page.result);
    data["run"] = settings_of(page.report);
    return fill_viewer(data,
                       {{"original-mesh", of_original.base64}, {"result-mesh", of_result.base64}});
}

}  // namespace page
