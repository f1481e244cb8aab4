#include "remesh/sites/prepared_surface.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/sites/size_field.h"

namespace remesh {
namespace {

// Longest edge in spacings. Relaxation finds neighbours by the labels of vertices, and Steiner
// points of longer edges do not resolve cells. Shorter ones cost more than they gain.
constexpr double longest_edge = 0.85;
// In spacings: vertices without curvature that are closer are removed, which saves time under
// needles. This is half the edge length of regular grids that resolve cells: those do not change.
constexpr double shortest_edge = 0.15;
// Most splits, for each site and each vertex. Regular refinement takes 4 for each site. Without a
// limit, surfaces thinner than the spacing would get vertices in proportion to their length.
constexpr double splits_per_site = 16, splits_per_vertex = 1;
// The spacing of sites whose neighbours are 1 apart: the root of the area of a cell.
constexpr double spacing_of_edge = 0.9306;  // Root of sqrt(3) / 2.
// Share of a cell that one piece stands for, in a face of the base that holds needles.
constexpr double piece_share = 1.0 / 16;

// Of the time: what the base takes, and what is done when its layout begins.
constexpr double base_share = 0.75, layout_begin = 0.95;

Index most_splits(const Surface& input, double spacing) {
    const double num_sites = surface_area(input) / (spacing * spacing);
    const double most =
        splits_per_site * (num_sites + 1) + splits_per_vertex * input.num_vertices();
    return static_cast<Index>(std::min(most, 1e9));
}

IntrinsicOptions options_for(const Surface& input, double spacing, const SizeField* sizes,
                             int num_threads, const Progress& progress) {
    IntrinsicOptions options{.max_length = longest_edge * spacing,
                             .min_length = std::isfinite(spacing) ? shortest_edge * spacing : 0,
                             .most_splits = most_splits(input, spacing),
                             .unit_at = length_function(sizes),
                             .num_threads = num_threads,
                             .progress = within(progress, 0, base_share)};
    if (sizes != nullptr) {
        options.max_length = longest_edge * spacing_of_edge;
        options.min_length = shortest_edge * spacing_of_edge * sizes->least();
    }
    return options;
}

}  // namespace

PreparedSurface::PreparedSurface(const Surface& input, double spacing, int num_threads,
                                 const Progress& progress, const SizeField* sizes)
    : base(input, options_for(input, spacing, sizes, num_threads, progress)),
      piece_area(piece_share * spacing * spacing),
      pieces(std::in_place, base, piece_area, num_threads,
             within(progress, base_share, base_share)),
      layout(base.surface(), num_threads, within(progress, layout_begin, layout_begin)) {}

void PreparedSurface::find_pieces(int num_threads, const Progress& progress) {
    if (!pieces) pieces.emplace(base, piece_area, num_threads, progress);
}

double mean_spacing(const Surface& surface, std::size_t num_sites) {
    const double area = surface_area(surface);
    return std::sqrt(area / static_cast<double>(std::max<std::size_t>(num_sites, 1)));
}

}  // namespace remesh
