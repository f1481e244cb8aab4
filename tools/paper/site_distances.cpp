// A shortest path of length d stays within d of its ends in space. So a search over the faces that
// near finds it, and a distance that is found proves itself once it is no more than the radius.
#include "paper/site_distances.h"

#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/paths/distances.h"
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

// \param radius  a guess of the largest distance.
std::vector<double> search(const Surface& surface, const SurfacePoint& site,
                           std::span<const SurfacePoint> asked, double radius, Poller& poller) {
    const Progress progress = poller.progress();
    std::vector<SurfacePoint> points{site};
    points.insert(points.end(), asked.begin(), asked.end());
    // Enough for the site's own face.
    radius = std::max(radius, surface.length_of(3 * site.face.value()));
    while (true) {
        poller.poll();
        const Patch patch = cut_patch(surface, site, radius, points, Ticker(poller));
        const std::vector<double> all = distances_from(patch.mesh, patch.vertex[0], progress);
        std::vector<double> distance;
        double farthest = 0;
        for (const Index vertex : std::span(patch.vertex).subspan(1)) {
            distance.push_back(vertex == no_index ? infinity : all[vertex]);
            farthest = std::max(farthest, distance.back());
        }
        if (farthest <= radius || patch.is_whole) return distance;
        radius = farthest < infinity ? farthest : 2 * radius;
    }
}

// The same from a shape.
std::vector<double> search(const Surface& surface, SiteShape shape,
                           std::span<const SurfacePoint> points, double radius, Poller& poller) {
    shape.site = 0;
    for (const double reach : {radius, infinity}) {
        std::vector<double> found = find_distances(surface, {}, points,
                                                   {.shapes = {shape},
                                                    .max_distance = reach,
                                                    .max_error = 0,
                                                    .num_threads = 1,
                                                    .progress = poller.progress()})
                                        .point_distance;
        const bool are_all = std::find(found.begin(), found.end(), infinity) == found.end();
        if (are_all || reach == infinity) return found;
    }
    return {};
}

}  // namespace

std::vector<double> site_distances(const Surface& surface, std::span<const SurfacePoint> sites,
                                   std::span<const SiteShape> shapes,
                                   std::span<const SiteDistanceQuery> queries, int num_threads,
                                   const Progress& progress) {
    Poller poller(progress);
    const std::size_t num_sources = sites.size() + shapes.size();
    std::vector<std::vector<Index>> of_site(num_sources);
    for (Index q = 0; q < queries.size(); ++q) of_site[queries[q].site.value()].push_back(q);
    std::vector<double> distance(queries.size());
    const auto search_from = [&](Index, Index s, Index) {
        // A guess from a sampled curve falls short of it by the height of a chord.
        constexpr double slack = 1.02;
        const bool is_point = s < sites.size();
        const std::size_t most = is_point ? most_points : of_site[s].size();
        for (std::size_t begin = 0; begin < of_site[s].size(); begin += most) {
            const std::size_t count = std::min(most, of_site[s].size() - begin);
            const std::span part = std::span(of_site[s]).subspan(begin, count);
            std::vector<SurfacePoint> points;
            double radius = 0;
            for (const Index q : part) {
                points.push_back(queries[q].point);
                radius = std::max(radius, slack * queries[q].guess);
            }
            const std::vector<double> found =
                is_point ? search(surface, sites[s], points, radius, poller)
                         : search(surface, shapes[s - sites.size()], points, radius, poller);
            for (std::size_t i = 0; i < count; ++i) distance[part[i]] = found[i];
        }
    };
    parallel_chunks(static_cast<Index>(num_sources), 1, num_threads, search_from, poller);
    return distance;
}

}  // namespace agvd
