// The bytes are streams one after the other; the description holds their names and lengths. Streams
// of one kind lie together, so that deflate finds the statistics of each.
#include "page/page_mesh.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "page/packed_mesh.h"
#include "remesh/meshfile/packed.h"

namespace page {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;

class Streams {
public:
    void add(const char* name, const std::string& bytes) {
        lengths_.push_back({name, bytes.size()});
        bytes_ += bytes;
    }
    [[nodiscard]] const Json& lengths() const { return lengths_; }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    Json lengths_ = Json::array();
    std::string bytes_;
};

std::uint32_t zigzag(std::int64_t number) {
    return static_cast<std::uint32_t>(number < 0 ? -2 * number - 1 : 2 * number);
}

// In 256 steps from the least to the largest.
// \param order  the caller's vertices in the order of the page.
Json add_values(const VertexValues& values, const std::vector<Index>& order, Streams& streams) {
    double low = agvd::infinity, high = -agvd::infinity;
    for (const Index v : order) {
        low = std::min(low, values.values[v]);
        high = std::max(high, values.values[v]);
    }
    std::string bytes;
    for (const Index v : order) {
        double share = high > low ? (values.values[v] - low) / (high - low) : 0;
        if (values.has_growing_steps) share = std::sqrt(share);
        bytes += static_cast<char>(std::lround(255 * share));
    }
    streams.add(values.key.c_str(), bytes);
    return {{"key", values.key},
            {"low", low},
            {"high", high},
            {"has_growing_steps", values.has_growing_steps}};
}

// Labels are numbered from 0 in the order of the page.
void add_labels(const FaceLabels& labels, const std::vector<Index>& order, Json& description,
                Streams& streams) {
    if (labels.labels.empty()) return;
    std::vector<double> all(labels.labels);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    std::string bytes;
    for (const Index f : order) {
        const auto at = std::lower_bound(all.begin(), all.end(), labels.labels[f]);
        append_number(static_cast<std::uint32_t>(at - all.begin()), bytes);
    }
    streams.add("labels", bytes);
    description["labels"] = {
        {"name", labels.name}, {"count", all.size()}, {"has_none", labels.has_none}};
}

// Pairs of vertices of the page, ascending: steps of the first, then the second less the first.
void add_creases(const PageMesh& mesh, const std::vector<Index>& order, Streams& streams) {
    std::vector<Index> number(mesh.mesh.positions.size(), no_index);
    for (Index i = 0; i < order.size(); ++i) number[order[i]] = i;
    std::vector<std::array<Index, 2>> edges;
    for (const auto& [a, b] : mesh.creases) {
        edges.push_back({std::min(number[a], number[b]), std::max(number[a], number[b])});
    }
    std::sort(edges.begin(), edges.end());
    std::string bytes;
    Index last = 0;
    for (const auto& [low, high] : edges) {
        append_number(low - std::exchange(last, low), bytes);
        append_number(high - low, bytes);
    }
    streams.add("creases", bytes);
}

// A wider grid than that of the vertices, for what lies on the surface.
struct Grid {
    Vec3 low;
    double step;  // 0: all points are one.
};

// Steps from point to point.
void add_points(const char* name, const std::vector<Vec3>& points, const Grid& grid,
                Streams& streams) {
    std::string steps;
    std::array<std::int64_t, 3> last{};
    for (const Vec3& point : points) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const std::int64_t now = grid.step > 0
                                         ? std::llround((point[at] - grid.low[at]) / grid.step)
                                         : std::int64_t{0};
            append_number(zigzag(now - std::exchange(last[k], now)), steps);
        }
    }
    streams.add(name, steps);
}

void add_lines(const std::string& name, const Polylines& lines, const Grid& grid,
               Streams& streams) {
    if (lines.lengths.empty()) return;
    std::string lengths;
    for (const Index length : lines.lengths) append_number(length, lengths);
    streams.add((name + "_lengths").c_str(), lengths);
    add_points((name + "_steps").c_str(), lines.points, grid, streams);
}

}  // namespace

MeshBlock to_block(const PageMesh& mesh) {
    const PackedMesh packed = pack_mesh(mesh.mesh);
    MeshBlock block;
    Json& description = block.description;
    description["name"] = mesh.name;
    description["vertices"] = packed.vertices.size();
    description["faces"] = packed.faces.size();
    if (mesh.thinned_from > 0) description["thinned_from"] = mesh.thinned_from;
    description["low"] = point_json(packed.low);
    description["step"] = packed.step;
    Streams streams;
    streams.add("codes", packed.codes);
    streams.add("corners", packed.corners);
    streams.add("offsets", packed.offsets);
    add_creases(mesh, packed.vertices, streams);
    description["values"] = Json::array();
    for (const VertexValues& values : mesh.values) {
        description["values"].push_back(add_values(values, packed.vertices, streams));
    }
    add_labels(mesh.labels, packed.faces, description, streams);
    const Grid grid{packed.low, 16 * packed.step};
    description["line_step"] = grid.step;
    add_lines("cell", mesh.cells, grid, streams);
    add_lines("isoline", mesh.isolines, grid, streams);
    add_points("site_steps", mesh.sites, grid, streams);
    add_lines("site_line", mesh.site_lines, grid, streams);
    description["streams"] = streams.lengths();
    description["gzip"] = remesh::knows_gzip();
    block.base64 =
        to_base64(remesh::knows_gzip() ? remesh::pack_gzip(streams.bytes(), {}) : streams.bytes());
    return block;
}

}  // namespace page
