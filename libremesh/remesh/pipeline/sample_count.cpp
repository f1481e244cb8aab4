#include "remesh/pipeline/sample_count.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "agvd/core/types.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/network_plan.h"
#include "remesh/sites/prepared_surface.h"
#include "remesh/sites/shares.h"

namespace remesh::detail {
namespace {

constexpr double most_samples = 8e8;
// The mean edge of a relaxed result over that of equilateral triangles, and without relaxation.
constexpr double relaxed_excess = 1.003, unrelaxed_excess = 1.025;
// Largest relative error of the mean edge that is not corrected, and largest correction.
constexpr double near_enough = 0.008, most_correction = 1.5;
// The longest edges of a relaxed result over the mean, but for some that are divided.
constexpr double longest_over_mean = 1.3;

// The boundary, but for locked edges, and the number of these.
struct BoundarySize {
    double length = 0;
    Index locked_edges = 0;
};

BoundarySize measure_boundary(const CleanedInput& cleaned) {
    const Surface& surface = cleaned.surface;
    BoundarySize size;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        if (surface.twin[h] != no_index) continue;
        if (cleaned.locked.has_edge(surface.edge[h])) {
            ++size.locked_edges;
        } else {
            size.length += surface.length_of(h);
        }
    }
    return size;
}

// Vertices of a mesh of equilateral triangles.
double vertices_for_edge(double edge, const CleanedInput& cleaned) {
    const BoundarySize boundary = measure_boundary(cleaned);
    return 2 / std::numbers::sqrt3 * surface_area(cleaned.surface) / (edge * edge) +
           boundary.length / (2 * edge) + boundary.locked_edges / 2.0;
}

double euler_characteristic(const CleanedInput& cleaned) {
    double euler = 0;
    for (const ComponentTopology& c : cleaned.topology.components) {
        euler += 2 - 2 * c.genus - c.boundary_loops;
    }
    return euler;
}

// By Euler's formula F = 2 (V - X) - B, where B edges of the boundary are as long as the others, or
// locked.
double vertices_for_faces(double faces, const CleanedInput& cleaned) {
    const double area = surface_area(cleaned.surface);
    const BoundarySize boundary = measure_boundary(cleaned);
    const double edge = std::sqrt(4 / std::numbers::sqrt3 * area / faces);
    return (faces + boundary.length / edge + boundary.locked_edges) / 2 +
           euler_characteristic(cleaned);
}

// The integral of the density over the faces of the input.
double vertices_for_targets(const CleanedInput& cleaned, const Sizing& sizing) {
    const auto* at_vertices = std::get_if<VertexLengths>(&sizing.edges);
    const auto target = [&](Index v) {
        return at_vertices->values[cleaned.vertex_origin.empty() ? v : cleaned.vertex_origin[v]];
    };
    double sum = 0;
    for (Index f = 0; f < cleaned.surface.num_faces(); ++f) {
        const auto& [a, b, c] = cleaned.surface.mesh.triangles[f];
        const double length = at_vertices != nullptr
                                  ? (target(a) + target(b) + target(c)) / 3
                                  : face_length(cleaned, std::get<FaceLengths>(sizing.edges), f);
        sum += face_area(cleaned.surface, f) / (length * length);
    }
    return 2 / std::numbers::sqrt3 * sum;
}

double excess_of(const RemeshOptions& options) {
    return options.relax_steps > 0 ? relaxed_excess : unrelaxed_excess;
}

// The nearest number of samples, at least 1; one too many for any number above the most.
Index nearest_count(double vertices) {
    return static_cast<Index>(std::max(1.0, std::round(std::min(most_samples + 1, vertices))));
}

Index to_count(double vertices) {
    const Index count = nearest_count(vertices);
    check_count(count);
    return count;
}

// What topology and what is locked need; 1 if nothing is locked.
Index least_samples(const CleanedInput& cleaned, double spacing) {
    if (cleaned.locked.empty()) return 1;
    return std::max(minimum_samples(cleaned.topology),
                    fewest_network_vertices(cleaned.surface,
                                            std::vector<std::uint8_t>(cleaned.surface.num_edges()),
                                            spacing, {}, cleaned.locked));
}

// As the sizing asks for it, whatever is locked.
Index count_by_sizing(const CleanedInput& cleaned, const RemeshOptions& options) {
    const Sizing& sizing = options.sizing;
    if (const auto* mean = std::get_if<MeanEdge>(&sizing.count)) {
        return to_count(vertices_for_edge(mean->length / excess_of(options), cleaned));
    }
    if (const auto* faces = std::get_if<NumFaces>(&sizing.count)) {
        return to_count(vertices_for_faces(faces->number, cleaned));
    }
    if (std::holds_alternative<CountOfLengths>(sizing.count)) {
        return to_count(vertices_for_targets(cleaned, sizing));
    }
    return options.num_samples;
}

}  // namespace

void check_count(Index count) {
    if (count <= most_samples) return;
    throw InvalidOption("the lengths asked for need more than " +
                        std::to_string(static_cast<Index>(most_samples)) +
                        " vertices; use longer ones, or a larger distance");
}

double most_mean_edge(const ShapeBounds& bounds) { return bounds.longest_edge / longest_over_mean; }

Index count_for_area(double area, const CleanedInput& cleaned, double spacing) {
    // Vertices of locked edges on the boundary count half in the area.
    const double vertices =
        area * 2 / std::numbers::sqrt3 + measure_boundary(cleaned).locked_edges / 2.0;
    return std::max(nearest_count(vertices), least_samples(cleaned, spacing));
}

Index sample_count(const CleanedInput& cleaned, const RemeshOptions& options) {
    const bool is_given =
        !gives_num_samples(options.sizing) && !(options.bounds.longest_edge < infinity);
    if (options.sites || is_given) return options.num_samples;
    Index count = count_by_sizing(cleaned, options);
    if (options.bounds.longest_edge < infinity) {
        count = std::max(count, to_count(vertices_for_edge(
                                    most_mean_edge(options.bounds) / excess_of(options), cleaned)));
    }
    return std::max(count, least_samples(cleaned, mean_spacing(cleaned.surface, count)));
}

// The inverse of vertices_for_edge().
double edge_length_for(Index count, const CleanedInput& cleaned, const RemeshOptions& options) {
    const BoundarySize boundary = measure_boundary(cleaned);
    const double area = 2 / std::numbers::sqrt3 * surface_area(cleaned.surface);
    const double inner = std::max(1.0, count - boundary.locked_edges / 2.0);
    const double half = boundary.length / 4;
    return excess_of(options) * (half + std::sqrt(half * half + inner * area)) / inner;
}

// The inverse of vertices_for_faces(), for the root of the number.
Index faces_for(Index count, const CleanedInput& cleaned) {
    const BoundarySize boundary = measure_boundary(cleaned);
    const double area = 4 / std::numbers::sqrt3 * surface_area(cleaned.surface);
    const double rest = 2 * (count - euler_characteristic(cleaned)) - boundary.locked_edges;
    const double half = boundary.length / std::sqrt(area) / 2;
    const double root = std::sqrt(half * half + std::max(rest, 1.0)) - half;
    return static_cast<Index>(std::ceil(root * root));
}

std::optional<double> corrected_edge_length(double mean_edge, const RemeshOptions& options) {
    const auto* wanted = std::get_if<MeanEdge>(&options.sizing.count);
    if (options.sites || wanted == nullptr || !(mean_edge > 0)) return std::nullopt;
    const double ratio = wanted->length / mean_edge;
    if (std::abs(ratio - 1) < near_enough) return std::nullopt;
    return wanted->length * std::clamp(ratio, 1 / most_correction, most_correction);
}

}  // namespace remesh::detail
