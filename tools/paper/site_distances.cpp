// A shortest path of length d stays within d of its ends in space. So a search over the faces that
// near finds it, and a distance that is found proves itself once it is no more than the radius.
#include "paper/site_distances.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/propagation/propagate.h"
#include "paper/patch.h"

namespace agvd {
namespace {

// Of one search: windows, and their memory, grow with the vertices, worst in long slivers.
constexpr std::size_t most_points = 200;

// Exact distances of the patch's vertices from one of them.
std::vector<double> distances_from(const TriangleMesh& mesh, Index vertex,
                                   const Progress& progress) {
    const Surface surface = build_surface(mesh.view(), 1, progress);
    const IntrinsicTriangulation base(surface, {.num_threads = 1, .progress = progress});
    SurfacePoint site{FaceId(Surface::face(surface.outgoing[vertex])), {0, 0, 0}};
    site.barycentric[surface.outgoing[vertex] % 3] = 1;
    site = base.to_intrinsic(site);
    return propagate(
               base.surface(), {&site, 1},
               {.engine = Engine::Window, .max_error = 0, .num_threads = 1, .progress = progress})
        .vertex_distance;
}

// \param points  the site itself, then what is asked for.
std::vector<double> search(const Surface& surface, std::span<const SurfacePoint> points,
                           double radius, Poller& poller) {
    const Progress progress = poller.progress();
    // Enough for the site's own face.
    radius = std::max(radius, surface.length_of(3 * points[0].face.value()));
    while (true) {
        poller.poll();
        const Patch patch = cut_patch(surface, points[0], radius, points, Ticker(poller));
        const std::vector<double> all = distances_from(patch.mesh, patch.vertex[0], progress);
        std::vector<double> distance;
        double farthest = 0;
        for (const Index vertex : patch.vertex) {
            distance.push_back(vertex == no_index ? infinity : all[vertex]);
            farthest = std::max(farthest, distance.back());
        }
        if (farthest <= radius || patch.is_whole) return distance;
        radius = farthest < infinity ? farthest : 2 * radius;
    }
}

}  // namespace

std::vector<double> site_distances(const Surface& surface, std::span<const SurfacePoint> sites,
                                   std::span<const SiteDistanceQuery> queries, int num_threads,
                                   const Progress& progress) {
    Poller poller(progress);
    std::vector<std::vector<Index>> of_site(sites.size());
    for (Index q = 0; q < queries.size(); ++q) of_site[queries[q].site.value()].push_back(q);
    std::vector<double> distance(queries.size());
    const auto search_from = [&](Index, Index s, Index) {
        // A guess from a sampled curve falls short of it by the height of a chord.
        constexpr double slack = 1.02;
        for (std::size_t begin = 0; begin < of_site[s].size(); begin += most_points) {
            const std::size_t count = std::min(most_points, of_site[s].size() - begin);
            const std::span part = std::span(of_site[s]).subspan(begin, count);
            std::vector<SurfacePoint> points{sites[s]};
            double radius = 0;
            for (const Index q : part) {
                points.push_back(queries[q].point);
                radius = std::max(radius, slack * queries[q].guess);
            }
            const std::vector<double> found = search(surface, points, radius, poller);
            for (std::size_t i = 0; i < count; ++i) distance[part[i]] = found[i + 1];
        }
    };
    parallel_chunks(static_cast<Index>(sites.size()), 1, num_threads, search_from, poller);
    return distance;
}

}  // namespace agvd
