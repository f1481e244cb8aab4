#include <agvd/agvd.h>

#include <cmath>
#include <cstdio>

int main() {
    const std::vector<agvd::Vec3> positions{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const std::vector<agvd::Triangle> triangles{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    const agvd::Surface surface = agvd::build_surface({positions, triangles});
    std::vector<agvd::SurfacePoint> sites;  // A face and barycentric coordinates each.
    for (agvd::Index v = 0; v < surface.num_vertices(); ++v) {
        sites.push_back(agvd::point_at(surface, v));
    }
    // Nearest site and distance of every vertex, in vertex_site and vertex_distance.
    const agvd::Propagation propagation = agvd::propagate(surface, sites);
    const agvd::Diagram diagram = agvd::build_diagram(surface, sites, propagation);
    double length = 0;  // Of the borders between cells.
    for (agvd::Index edge = 0; edge < diagram.edges.size(); ++edge) {
        length += agvd::curve_length(surface, diagram, edge);
        const auto& [left, right, tail, head] = diagram.edges[edge];
        std::printf("between cells %u and %u:", left.value(), right.value());
        for (agvd::Index i = diagram.edge_points[edge]; i < diagram.edge_points[edge + 1]; ++i) {
            const agvd::Vec3 p = agvd::position(surface.mesh.view(), diagram.points[i]);
            std::printf(" (%g, %g, %g)", p.x(), p.y(), p.z());
        }
        std::printf("\n");
    }
    // Three borders in each face, from its middle to the middles of its edges.
    return std::abs(length - 12 * std::sqrt(2.0 / 3)) < 1e-3 ? 0 : 1;
}
