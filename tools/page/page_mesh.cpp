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
    description["labels"] = {{"name", labels.name}, {"count", all.size()}};
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

// Lengths, then steps from point to point on a wider grid than that of the mesh.
void add_cells(const Polylines& lines, Json& description, Streams& streams) {
    if (lines.lengths.empty()) return;
    const Vec3 low = [&] {
        const auto& of = description["low"];
        return Vec3(of[0].get<double>(), of[1].get<double>(), of[2].get<double>());
    }();
    const double step = 16 * description["step"].get<double>();
    std::string lengths, steps;
    for (const Index length : lines.lengths) append_number(length, lengths);
    std::array<std::int64_t, 3> last{};
    for (const Vec3& point : lines.points) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const std::int64_t now =
                step > 0 ? std::llround((point[at] - low[at]) / step) : std::int64_t{0};
            append_number(zigzag(now - std::exchange(last[k], now)), steps);
        }
    }
    description["cell_step"] = step;
    streams.add("cell_lengths", lengths);
    streams.add("cell_steps", steps);
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
    add_cells(mesh.cells, description, streams);
    description["streams"] = streams.lengths();
    description["gzip"] = remesh::knows_gzip();
    block.base64 =
        to_base64(remesh::knows_gzip() ? remesh::pack_gzip(streams.bytes(), {}) : streams.bytes());
    return block;
}

}  // namespace page
