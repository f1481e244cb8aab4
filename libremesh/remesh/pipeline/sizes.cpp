// The field gets a base of its own, cut along all creases that were found: runs with fewer
// creases cut the surface in other ways, but its faces stay.
#include "remesh/pipeline/sizes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/sample_count.h"
#include "remesh/pipeline/stage_context.h"
#include "remesh/sites/narrow_lengths.h"
#include "remesh/sites/target_lengths.h"

namespace remesh::detail {
namespace {

// Longest edge of the base, and shortest at vertices without curvature, in spacings.
constexpr double longest_edge = 0.85, shortest_edge = 0.15;
constexpr double most_splits_per_site = 16;
constexpr double cells_per_site = 4;
// With a mean edge given, the number of samples is found in so many rounds.
constexpr int edge_length_tries = 2;

// A point lies on an edge if its third barycentric coordinate is no more.
constexpr double on_edge = 1e-6;

// The base refers to the surface, which is cut.
struct CutBase {
    CutBase(CutSurface given, const IntrinsicOptions& options)
        : cut(std::move(given)), base(cut.surface(), options) {}

    CutSurface cut;
    IntrinsicTriangulation base;
};

// What target lengths are found on.
struct FieldBase {
    std::shared_ptr<const IntrinsicTriangulation> base;
    std::vector<Index> original;  // #V of the base's input: a vertex of the cleaned surface.
    std::vector<std::pair<Index, Index>> joined;  // Copies of a vertex.
};

// \param drops_vertices  whether it has no close vertices where there is no curvature.
FieldBase make_base(const CleanedInput& cleaned, const FoundCurves& found, double spacing,
                    double num_sites, bool drops_vertices, const RemeshOptions& options) {
    std::vector<std::uint8_t> is_crease = found.is_crease;
    is_crease.resize(cleaned.surface.num_edges(), 0);  // Empty: there are none.
    CutSurface cut =
        cut_surface(cleaned.surface, edges_to_cut(found.junctions, std::move(is_crease)),
                    options.num_threads, cleaned_progress(options));
    FieldBase made;
    for (Index v = cut.num_original; v < cut.original.size(); ++v) {
        made.joined.emplace_back(cut.original[v], v);
    }
    made.original = cut.original;
    const auto on_cut = std::make_shared<const CutBase>(
        std::move(cut),
        IntrinsicOptions{
            .max_length = longest_edge * spacing,
            .min_length = drops_vertices ? shortest_edge * spacing : 0,
            .most_splits = static_cast<Index>(std::min(
                most_splits_per_site * (num_sites + 1) + cleaned.surface.num_vertices(), 1e9)),
            .num_threads = options.num_threads,
            .progress = cleaned_progress(options)});
    made.base = {on_cut, &on_cut->base};
    return made;
}

// The value at each vertex of the base.
// \param of_vertex  #V of the cleaned mesh.
std::vector<double> carry_values(std::span<const double> of_vertex, const FieldBase& on) {
    const Surface& input = on.base->input();
    std::vector<double> values;
    for (const Index v : on.original) values.push_back(of_vertex[v]);
    for (Index v = input.num_vertices(); v < on.base->surface().num_vertices(); ++v) {
        const SurfacePoint& point = on.base->added_point(v);
        const Triangle& t = input.mesh.triangles[point.face.value()];
        double value = 0;
        for (std::size_t k = 0; k < 3; ++k) value += point.barycentric[k] * values[t[k]];
        values.push_back(value);
    }
    return values;
}

// The least length of the faces around each vertex of the base.
std::vector<double> least_of_faces(const CleanedInput& cleaned, const FaceLengths& lengths,
                                   const IntrinsicTriangulation& base) {
    const Surface& input = base.input();
    std::vector<double> values(base.surface().num_vertices(), infinity);
    const auto look_at = [&](Index v, Index face) {
        values[v] = std::min(values[v], face_length(cleaned, lengths, face));
    };
    for (Index f = 0; f < input.num_faces(); ++f) {
        for (const Index v : input.mesh.triangles[f]) look_at(v, f);
    }
    for (Index v = input.num_vertices(); v < values.size(); ++v) {
        for_each_view(input, base.added_point(v),
                      [&](const SurfacePoint& view) { look_at(v, view.face.value()); });
    }
    return values;
}

// #V of the base: curvatures, lengths or densities, whichever the sizing asks for.
std::vector<double> values_for(const Sizing& sizing, const CleanedInput& cleaned,
                               const FieldBase& on, double num_sites, Ticker& ticker) {
    if (sizing.is_adaptive()) {
        return patch_curvature(*on.base, cells_per_site * num_sites, ticker);
    }
    if (sizing.is_even()) return std::vector<double>(on.base->surface().num_vertices(), 1);
    if (const auto* lengths = std::get_if<FaceLengths>(&sizing.edges)) {
        return least_of_faces(cleaned, *lengths, *on.base);
    }
    const auto* densities = std::get_if<VertexDensities>(&sizing.edges);
    const std::vector<double>& given =
        densities != nullptr ? densities->values : std::get<VertexLengths>(sizing.edges).values;
    if (cleaned.vertex_origin.empty()) return carry_values(given, on);
    std::vector<double> of_vertex;
    for (const Index v : cleaned.vertex_origin) of_vertex.push_back(given[v]);
    return carry_values(of_vertex, on);
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

// #V of the base: no target is longer. Empty: there is no limit.
// \param locked  #V of the cleaned mesh, or empty.
std::vector<double> most_lengths_on(const FieldBase& on, const Surface& surface,
                                    std::span<const double> locked, int num_threads) {
    if (locked.empty()) return {};
    const MeshBox box = box_of(surface.mesh.view(), num_threads);
    const double longest = (box.high - box.low).norm();
    std::vector<double> most;
    for (const double length : locked) most.push_back(length > 0 ? length : longest);
    return carry_values(most, on);
}

// Lowers bounds at the corners of the base's faces, or the ends of its edges, that have points, and
// at the vertices in their radius.
// \param most  #V of the base, or empty: there are no bounds.
void limit_at_points(const FieldBase& on, std::span<const SizedPoint> points, Ticker& ticker,
                     std::vector<double>& most) {
    if (points.empty()) return;
    const Surface& surface = on.base->surface();
    most.resize(surface.num_vertices(), infinity);
    std::map<std::pair<double, double>, std::vector<double>> distances;  // By length and radius.
    for (const SizedPoint& point : points) {
        const SurfacePoint at = on.base->to_intrinsic(point.at);
        const auto lower = [&](std::vector<double>& values, double value) {
            for (std::size_t k = 0; k < 3; ++k) {
                double& here = values[surface.mesh.triangles[at.face.value()][k]];
                if (at.barycentric[k] > on_edge) here = std::min(here, value);
            }
        };
        lower(most, point.length);
        if (!(point.radius > 0)) continue;
        std::vector<double>& distance = distances[{point.length, point.radius}];
        distance.resize(surface.num_vertices(), infinity);
        lower(distance, std::numeric_limits<double>::min());
    }
    for (auto& [place, distance] : distances) {
        limit_growth(surface, on.joined, 1, Paths::Lines, distance, ticker);
        for (Index v = 0; v < most.size(); ++v) {
            if (distance[v] <= place.second) most[v] = std::min(most[v], place.first);
        }
    }
}

// The lengths of locked edges on the base. Vertices that it added inside faces have none.
std::vector<double> least_lengths_on(const FieldBase& on, std::span<const double> locked) {
    if (locked.empty()) return {};
    std::vector<double> least = carry_values(locked, on);
    const Surface& input = on.base->input();
    for (Index v = input.num_vertices(); v < least.size(); ++v) {
        if (!is_on_boundary(input, on.base->added_point(v))) least[v] = 0;
    }
    return least;
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

double mean_edge(const MeshView& mesh) {
    const std::vector<EdgeSide> sides = sorted_edge_sides(mesh.triangles);
    double sum = 0, num_edges = 0;
    agvd::for_each_edge(sides, [&](std::span<const EdgeSide> edge) {
        sum += (mesh.positions[edge[0].high()] - mesh.positions[edge[0].low()]).norm();
        ++num_edges;
    });
    return num_edges == 0 ? 0 : sum / num_edges;
}

}  // namespace

RunSizes find_sizes(const CleanedInput& cleaned, const FoundCurves& found, double spacing,
                    std::span<const SurfacePoint> narrow_points,
                    std::span<const SizedPoint> short_points, const StageContext& context) {
    const auto& [options, result] = context;
    Sizing sizing = options.sizing;
    const bool has_limits = !found.strips.empty() || !short_points.empty();
    if (sizing.is_even() && narrow_points.empty() && !has_limits) {
        return {nullptr, options.num_samples};
    }
    const StageClock clock(Stage::Clean, result);
    const Progress progress = cleaned_progress(options);
    Poller poller(progress);
    Ticker ticker(poller);
    const double num_sites =
        options.sites ? static_cast<double>(options.sites->size()) : options.num_samples;
    const bool drops_vertices = sizing.is_adaptive() || !narrow_points.empty() || has_limits;
    const FieldBase on = make_base(cleaned, found, spacing, num_sites, drops_vertices, options);
    const std::vector<double> values = values_for(sizing, cleaned, on, num_sites, ticker);
    const std::vector<double> locked = locked_lengths(cleaned);
    const std::vector<double> least = least_lengths_on(on, locked);
    std::vector<double> most = most_lengths_on(on, cleaned.surface, locked, options.num_threads);
    limit_at_points(on, found.strips, ticker, most);
    limit_at_points(on, short_points, ticker, most);
    if (!found.strips.empty()) {
        sizing.gradation = std::max(sizing.gradation, gradation_for(strip_slope));
    }
    const bool gives_count =
        !options.sites && (std::holds_alternative<CountOfLengths>(sizing.count) ||
                           std::holds_alternative<MaxError>(sizing.count));
    const auto* mean = options.sites ? nullptr : std::get_if<MeanEdge>(&sizing.count);
    const Surface& surface = on.base->surface();
    double area = gives_count ? 0 : num_sites * std::numbers::sqrt3 / 2;
    const auto find_targets = [&] {
        return target_lengths(surface, values, most, on.joined, sizing, area, ticker, least);
    };
    std::vector<double> targets = find_targets();
    if (!narrow_points.empty()) {
        most.resize(targets.size(), infinity);
        const std::vector<double> narrow =
            narrow_lengths(*on.base, narrow_points, on.joined, targets, num_sites,
                           portable::log(sizing.gradation), ticker);
        for (std::size_t v = 0; v < most.size(); ++v) most[v] = std::min(most[v], narrow[v]);
        targets = find_targets();
    }
    for (int i = 0; i < edge_length_tries && mean != nullptr; ++i) {
        const double ratio = mean_length(surface, targets) / mean->length;
        area *= ratio * ratio;
        targets = find_targets();
    }
    RunSizes sizes{std::make_unique<const SizeField>(on.base, std::move(targets)),
                   options.num_samples};
    if (gives_count || mean != nullptr) {
        sizes.num_samples = count_for_area(sizes.field->area(), cleaned, spacing);
    }
    return sizes;
}

SizingResult measure_edges(const MeshView& mesh, std::span<const SurfacePoint> sites,
                           Index num_samples, const SizeField* sizes) {
    SizingResult result{.num_samples = num_samples, .mean_edge = mean_edge(mesh)};
    if (sizes == nullptr) return result;
    std::vector<double> target = lengths_at(sizes, sites);
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
    result.targets = std::move(target);
    return result;
}

}  // namespace remesh::detail
