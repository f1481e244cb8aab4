#include "support/line_sites.h"

#include <algorithm>

#include "agvd/mesh/closest_point.h"
#include "support/dice.h"
#include "support/shapes.h"

namespace line_sites {

using namespace agvd;

Surface uneven_square(Index n, std::uint64_t seed) {
    TriangleMesh mesh = shapes::grid(n);
    Dice dice(seed);
    for (Vec3& p : mesh.positions) {
        const double x = dice.number(-0.2, 0.2) / n, y = dice.number(-0.2, 0.2) / n;
        if (p.x() > 0 && p.x() < 1 && p.y() > 0 && p.y() < 1) p += Vec3(x, y, 0);
    }
    return build_surface(mesh.view());
}

SiteShape random_line(const Surface& surface, Index num_edges, std::uint64_t seed) {
    Dice dice(seed);
    SiteShape line;
    auto at = static_cast<Index>(dice.number(0, 1) * surface.num_vertices());
    while (line.edges.size() < num_edges) {
        std::vector<Index> around;
        for_each_edge_at(surface, at, [&](Index h, Index) { around.push_back(surface.edge[h]); });
        if (around.empty()) {
            at = (at + 1) % surface.num_vertices();
            continue;
        }
        const Index edge = around[static_cast<std::size_t>(dice.number(0, 1) *
                                                           static_cast<double>(around.size()))];
        line.edges.push_back(edge);
        at = other_end(surface, edge, at);
    }
    return line;
}

SiteShape random_region(const Surface& surface, Index num_faces, std::uint64_t seed) {
    Dice dice(seed);
    SiteShape region;
    auto face = static_cast<Index>(dice.number(0, 1) * surface.num_faces());
    while (region.faces.size() < num_faces) {
        region.faces.push_back(face);
        const Index twin = surface.twin[3 * face + static_cast<Index>(dice.number(0, 3))];
        if (twin != no_index) face = Surface::face(twin);
    }
    return region;
}

std::vector<PropagationOptions> kinds_of_sites(const Surface& surface) {
    constexpr Index num_points = 60;
    SitePoints groups, starts;
    for (Index i = 0; i < num_points; ++i) {
        groups.site.push_back((7 * i + 3) % 20);
        starts.start.push_back(0.01 * static_cast<double>(i % 17));
    }
    SitePoints both = groups;
    both.start = starts.start;
    const auto shapes = numbered(
        {random_line(surface, 9, 2), random_region(surface, 6, 5), random_line(surface, 5, 9)},
        num_points);
    return {{.points = groups}, {.points = starts}, {.points = both}, {.shapes = shapes}};
}

double in_plane(const Surface& surface, const SiteShape& shape, const Vec3& p) {
    const auto& at = surface.mesh.positions;
    double least = infinity;
    for (const Index edge : shape.edges) {
        const Index h = surface.edge_half[edge];
        least = std::min(least, distance_to_segment(p, at[surface.tail(h)], at[surface.head(h)]));
    }
    for (const Index face : shape.faces) {
        int inside = 0;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Vec3 &a = at[surface.tail(h)], &b = at[surface.head(h)];
            least = std::min(least, distance_to_segment(p, a, b));
            inside += (b - a).cross(p - a).z() >= 0 ? 1 : 0;
        }
        if (inside == 3) least = 0;
    }
    return least;
}

std::vector<SiteShape> numbered(std::vector<SiteShape> shapes, Index first) {
    for (SiteShape& shape : shapes) shape.site = first++;
    return shapes;
}

}  // namespace line_sites
