// The field gets a base of its own, cut along all creases that were found: attempts with fewer
// creases cut the surface in other ways, but its faces stay.
#include "remesh/pipeline/sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "agvd/core/progress.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/sample_count.h"
#include "remesh/pipeline/thin_lengths.h"
#include "remesh/sites/target_lengths.h"

namespace remesh::detail {
namespace {

// Longest edge of the base, and shortest at vertices without curvature, in spacings.
constexpr double longest_edge = 0.85, shortest_edge = 0.15;
constexpr double most_splits_per_site = 16;
constexpr double cells_per_site = 4;
// With a mean edge given, the number of samples is found in so many rounds.
constexpr int edge_length_tries = 2;

// The value at each vertex of the base.
// \param value_of  of a vertex of the cleaned mesh.
template <typename ValueOf>
std::vector<double> carry_values(const ValueOf& value_of, std::span<const Index> original,
                                 const IntrinsicTriangulation& base) {
    const Surface& input = base.input();
    std::vector<double> values;
    for (Index v = 0; v < input.num_vertices(); ++v) values.push_back(value_of(original[v]));
    for (Index v = input.num_vertices(); v < base.surface().num_vertices(); ++v) {
        const SurfacePoint& place = base.added_point(v);
        const Triangle& t = input.mesh.triangles[place.face.value()];
        double value = 0;
        for (std::size_t k = 0; k < 3; ++k) value += place.barycentric[k] * values[t[k]];
        values.push_back(value);
    }
    return values;
}

// The least value of the faces around each vertex of the base.
// \param value_of  of a face of the base's input.
template <typename ValueOf>
std::vector<double> least_of_faces(const ValueOf& value_of, const IntrinsicTriangulation& base) {
    const Surface& input = base.input();
    std::vector<double> values(base.surface().num_vertices(),
                               std::numeric_limits<double>::infinity());
    for (Index f = 0; f < input.num_faces(); ++f) {
        for (const Index v : input.mesh.triangles[f]) values[v] = std::min(values[v], value_of(f));
    }
    for (Index v = input.num_vertices(); v < values.size(); ++v) {
        for_each_view(input, base.added_point(v), [&](const SurfacePoint& view) {
            values[v] = std::min(values[v], value_of(view.face.value()));
        });
    }
    return values;
}

// #V: the mean length of the locked edges at each vertex; 0: there are none. Empty: nowhere.
std::vector<double> locked_lengths(const CleanedInput& cleaned) {
    const Surface& surface = cleaned.surface;
    if (cleaned.locked.is_edge.empty()) return {};
    std::vector<double> result(surface.num_vertices(), 0);
    std::vector<std::pair<Index, double>> at_vertex;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (!cleaned.locked.has_edge(e)) continue;
        const Index h = surface.edge_half[e];
        at_vertex.emplace_back(surface.tail(h), surface.length[e]);
        at_vertex.emplace_back(surface.head(h), surface.length[e]);
    }
    std::sort(at_vertex.begin(), at_vertex.end());
    for (std::size_t first = 0, last = 0; first < at_vertex.size(); first = last) {
        const Index v = at_vertex[first].first;
        double sum = 0;
        for (; last < at_vertex.size() && at_vertex[last].first == v; ++last) {
            sum += at_vertex[last].second;
        }
        result[v] = sum / static_cast<double>(last - first);
    }
    return result;
}

// The same limits, and the lengths of locked edges as well.
std::vector<double> limit_at_locked(const Surface& surface, std::span<const double> limits,
                                    std::span<const double> locked, int num_threads) {
    std::vector<double> result(limits.begin(), limits.end());
    if (locked.empty()) return result;
    if (result.empty()) {
        const MeshBox box = box_of(surface.mesh.view(), num_threads);
        result.assign(surface.num_vertices(), (box.high - box.low).norm());
    }
    for (std::size_t v = 0; v < locked.size(); ++v) {
        if (locked[v] > 0) result[v] = std::min(result[v], locked[v]);
    }
    return result;
}

// The lengths of locked edges on the base. Vertices that it added inside faces have none.
std::vector<double> carry_locked(std::span<const double> locked, std::span<const Index> original,
                                 const IntrinsicTriangulation& base) {
    if (locked.empty()) return {};
    std::vector<double> result = carry_values([&](Index v) { return locked[v]; }, original, base);
    for (Index v = base.input().num_vertices(); v < result.size(); ++v) {
        if (!is_on_boundary(base.input(), base.added_point(v))) result[v] = 0;
    }
    return result;
}

// The number of vertices of a mesh that follows the lengths. Vertices of locked edges on the
// boundary count half in the area, and what is locked needs a least number.
Index count_for(const SizeField& field, const CleanedInput& cleaned, double spacing) {
    const double inside = field.area() * 2 / std::numbers::sqrt3;
    if (cleaned.locked.empty()) return to_count(inside);
    return std::max(to_count(inside + num_locked_on_boundary(cleaned) / 2.0),
                    least_samples(cleaned, spacing));
}

// The mean over the vertices of a mesh that follows these lengths.
double mean_length(const Surface& surface, std::span<const double> length) {
    double lengths = 0, vertices = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const double area = face_area(surface, f);
        for (const Index v : surface.mesh.triangles[f]) {
            lengths += area / length[v];
            vertices += area / (length[v] * length[v]);
        }
    }
    return lengths / vertices;
}

}  // namespace

RunSizes find_sizes(const CleanedInput& cleaned, const FoundCurves& found, double spacing,
                    std::span<const double> most_lengths, std::span<const SurfacePoint> thin_places,
                    const StageContext& context) {
    const auto& [options, result] = context;
    const Sizing& sizing = options.sizing;
    if (sizing.is_even() && thin_places.empty()) return {nullptr, options.num_samples};
    const StageClock clock(Stage::Clean, result);
    const Progress all = progress_of(Stage::Clean, options);
    const Progress progress = within(all, cleaned_fraction, cleaned_fraction);
    Poller poller(progress);
    Ticker ticker(poller);
    std::vector<std::uint8_t> is_crease = found.is_crease;
    is_crease.resize(cleaned.surface.num_edges(), 0);  // Empty: there are none.
    CutSurface cut =
        cut_surface(cleaned.surface, edges_to_cut(found.junctions, std::move(is_crease)),
                    options.num_threads, progress);
    const double num_sites =
        options.sites ? static_cast<double>(options.sites->size()) : options.num_samples;
    const auto base = std::make_shared<const IntrinsicTriangulation>(
        std::move(cut.surface),
        IntrinsicOptions{
            .max_length = longest_edge * spacing,
            .min_length =
                sizing.is_adaptive() || !thin_places.empty() ? shortest_edge * spacing : 0,
            .most_splits = static_cast<Index>(std::min(
                most_splits_per_site * (num_sites + 1) + cleaned.surface.num_vertices(), 1e9)),
            .num_threads = options.num_threads,
            .progress = progress});
    std::vector<double> values;
    if (sizing.is_adaptive()) {
        values = patch_curvature(
            *base, static_cast<Index>(std::clamp(cells_per_site * num_sites, 1.0, 1e9)), ticker);
    } else if (sizing.is_even()) {
        values.assign(base->surface().num_vertices(), 1);
    } else if (const auto* lengths = std::get_if<FaceLengths>(&sizing.edges)) {
        values = least_of_faces([&](Index f) { return face_length(cleaned, *lengths, f); }, *base);
    } else {
        const auto* densities = std::get_if<VertexDensities>(&sizing.edges);
        const std::vector<double>& given =
            densities != nullptr ? densities->values : std::get<VertexLengths>(sizing.edges).values;
        const auto value_of = [&](Index v) {
            return given[cleaned.vertex_origin.empty() ? v : cleaned.vertex_origin[v]];
        };
        values = carry_values(value_of, cut.original, *base);
    }
    std::vector<std::pair<Index, Index>> joined;
    for (Index v = cut.num_original; v < cut.original.size(); ++v) {
        joined.emplace_back(cut.original[v], v);
    }
    std::vector<double> most;
    const std::vector<double> locked = locked_lengths(cleaned);
    const std::vector<double> least = carry_locked(locked, cut.original, *base);
    const std::vector<double> limits =
        limit_at_locked(cleaned.surface, most_lengths, locked, options.num_threads);
    if (!limits.empty()) {
        most = carry_values([&](Index v) { return limits[v]; }, cut.original, *base);
    }
    if (!thin_places.empty()) {
        most = thin_lengths(*base, thin_places, joined, spacing, num_sites, ticker);
    }
    const bool gives_count =
        !options.sites && (std::holds_alternative<CountOfLengths>(sizing.count) ||
                           std::holds_alternative<MaxError>(sizing.count));
    const auto* mean_edge = options.sites ? nullptr : std::get_if<MeanEdge>(&sizing.count);
    double area = gives_count ? 0 : num_sites * std::numbers::sqrt3 / 2;
    std::vector<double> targets =
        target_lengths(base->surface(), values, most, joined, sizing, area, ticker, least);
    for (int i = 0; i < edge_length_tries && mean_edge != nullptr; ++i) {
        const double ratio = mean_length(base->surface(), targets) / mean_edge->length;
        area *= ratio * ratio;
        targets =
            target_lengths(base->surface(), values, most, joined, sizing, area, ticker, least);
    }
    RunSizes sizes{nullptr, options.num_samples};
    sizes.field = std::make_unique<const SizeField>(base, std::move(targets));
    if (gives_count || mean_edge != nullptr) {
        sizes.num_samples = count_for(*sizes.field, cleaned, spacing);
    }
    return sizes;
}

SizingResult measure_edges(const MeshView& mesh, std::span<const SurfacePoint> sites,
                           Index num_samples, const SizeField* sizes) {
    SizingResult result{.num_samples = num_samples, .mean_edge = mean_edge(mesh)};
    if (sizes == nullptr) return result;
    const std::vector<double> target = lengths_at(sizes, sites);
    std::vector<double> ratios;  // Each inner edge twice.
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = t[k], b = t[(k + 1) % 3];
            const double length = (mesh.positions[a] - mesh.positions[b]).norm();
            ratios.push_back(2 * length / (target[a] + target[b]));
        }
    }
    std::sort(ratios.begin(), ratios.end());
    const auto percentile = [&](std::size_t percent) {
        return ratios[(ratios.size() - 1) * percent / 100];
    };
    const auto [least, largest] = std::minmax_element(target.begin(), target.end());
    result.least_target = *least;
    result.largest_target = *largest;
    result.low_ratio = percentile(5);
    result.high_ratio = percentile(95);
    return result;
}

}  // namespace remesh::detail
