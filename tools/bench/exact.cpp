#include "bench/exact.h"

#include <limits>

#include "bench/workload.h"
#include "paper/oracle.h"

namespace bench {

using agvd::Index;

ExactRun run_exact(const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites) {
    std::vector<Index> vertices;
    std::vector<agvd::SurfacePoint> targets;
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if (surface.outgoing[v] == agvd::no_index) continue;
        vertices.push_back(v);
        targets.push_back(point_at(surface, v));
    }
    agvd::NearestSites nearest;
    ExactRun run;
    run.taken = time([&] { nearest = agvd::exact_nearest_sites(surface, sites, targets, 1); });
    run.vertex_distance.assign(surface.num_vertices(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        run.vertex_distance[vertices[i]] = nearest.distance[i];
    }
    return run;
}

}  // namespace bench
