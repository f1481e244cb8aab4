#include "remesh/clean/carry_edges.h"

#include <algorithm>
#include <map>
#include <string>

#include "agvd/core/error.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/clean/carry_sites.h"

namespace remesh {
namespace {

// A face of an edge, and the edge's middle as a point of this face.
struct EdgeMiddle {
    double area = -1;
    SurfacePoint middle;
};

double area_of(const MeshView& mesh, const Triangle& t) {
    const auto& p = mesh.positions;
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm();
}

}  // namespace

std::vector<std::uint8_t> carry_edges(std::span<const std::array<Index, 2>> edges,
                                      const MeshView& mesh, const CleanedView& clean,
                                      const Surface& surface) {
    std::vector<std::uint8_t> is_carried(surface.num_edges(), 0);
    std::map<std::pair<Index, Index>, EdgeMiddle> middle_of;
    for (const auto& [u, v] : edges) middle_of[std::minmax(u, v)];
    // Of the faces at an edge the largest counts, and of equal ones the first: cleaning removes
    // faces without area, and of duplicate faces all but the first.
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        const Triangle& t = mesh.triangles[f];
        for (std::size_t k = 0; k < 3; ++k) {
            const auto found = middle_of.find(std::minmax(t[k], t[(k + 1) % 3]));
            if (found == middle_of.end()) continue;
            const double area = area_of(mesh, t);
            if (!(area > found->second.area)) continue;
            SurfacePoint middle{FaceId(f), {0, 0, 0}};
            middle.barycentric[k] = middle.barycentric[(k + 1) % 3] = 0.5;
            found->second = {area, middle};
        }
    }
    std::vector<SurfacePoint> middles;
    for (const auto& [ends, face] : middle_of) {
        if (face.area < 0) {
            throw InvalidInput("the feature edge between vertices " + std::to_string(ends.first) +
                               " and " + std::to_string(ends.second) +
                               " is no edge of the mesh; name the two ends of an edge, "
                               "counted from 0");
        }
        if (face.area > 0) middles.push_back(face.middle);
    }
    for (const SurfacePoint& middle : to_cleaned(middles, mesh, clean)) {
        const auto half_edge = half_edge_of(middle);
        if (half_edge) is_carried[surface.edge[*half_edge]] = 1;
    }
    return is_carried;
}

std::vector<std::uint8_t> find_label_borders(std::span<const Index> face_labels,
                                             std::span<const Index> face_origin,
                                             const Surface& surface) {
    const auto label = [&](Index h) { return face_labels[face_origin[Surface::face(h)]]; };
    std::vector<std::uint8_t> is_border(surface.num_edges(), 0);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        if (twin != no_index && label(h) != label(twin)) is_border[e] = 1;
    }
    return is_border;
}

}  // namespace remesh
