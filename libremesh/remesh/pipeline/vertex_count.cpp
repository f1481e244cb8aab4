#include "remesh/pipeline/vertex_count.h"

#include <algorithm>

#include "remesh/dual/reduce_vertices.h"

namespace remesh::detail {
namespace {

// Removes these vertices and renumbers the others in their order.
void compact(std::span<const Index> gone, ValidDual& dual) {
    std::vector<Index> number(dual.mesh.points.size(), 0);
    for (const Index v : gone) number[v] = no_index;
    Index num_left = 0;
    for (Index v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        dual.mesh.points[num_left] = dual.mesh.points[v];
        dual.site[num_left] = dual.site[v];
        number[v] = num_left++;
    }
    dual.mesh.points.resize(num_left);
    dual.site.resize(num_left);
    for (Triangle& t : dual.mesh.triangles) {
        for (Index& v : t) v = number[v];
    }
}

}  // namespace

Index target_count(const Domain& domain, const PlacedSites& placed, const Diagram& diagram,
                   const StageContext& context) {
    const auto& [options, result] = context;
    const Index num_other_copies = placed.num_other_copies(domain);
    if (!options.sites) return options.num_samples + num_other_copies;
    const auto num_copies = static_cast<Index>(placed.curves.sites.size());
    const auto area = diagram.cell_area.begin();
    const auto num_owning =
        std::count_if(area + num_copies, area + static_cast<Index>(placed.sites.size()),
                      [](double cell) { return cell > 0; });
    const Index target = num_copies + static_cast<Index>(num_owning);
    result.sites_dropped = static_cast<Index>(options.sites->size()) - (target - num_other_copies);
    return target;
}

Index reduce_to(Index target, std::span<const Vec3> positions, std::span<const std::uint8_t> keep,
                ValidDual& dual, const StageContext& context) {
    const StageClock clock(Stage::Dual, context.result);
    const std::vector<Index> gone = reduce_vertices(positions, dual.mesh.triangles, target, keep,
                                                    progress_of(Stage::Dual, context.options));
    compact(gone, dual);
    return static_cast<Index>(gone.size());
}

}  // namespace remesh::detail
