#include "agvd/mesh/patch.h"

#include <algorithm>
#include <numeric>
#include <unordered_set>

#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Sets the vertices of a patch whose twins are known.
void number_vertices(const Surface& whole, Ticker& ticker, Patch& patch) {
    Surface& part = patch.surface;
    part.mesh.triangles.assign(patch.faces.size(), {no_index, no_index, no_index});
    for (Index h = 0; h < part.twin.size(); ++h) {
        ticker.tick();
        if (part.tail(h) != no_index) continue;
        // Clockwise to the boundary, or all around.
        Index first = h;
        while (part.twin[first] != no_index) {
            first = Surface::next(part.twin[first]);
            if (first == h) break;
        }
        const Index vertex = static_cast<Index>(patch.vertices.size());
        const Index origin = whole.tail(3 * patch.faces[Surface::face(h)] + h % 3);
        patch.vertices.push_back(origin);
        part.mesh.positions.push_back(whole.mesh.positions[origin]);
        part.can_be_pseudo_source.push_back(whole.can_be_pseudo_source[origin]);
        part.outgoing.push_back(first);
        for_each_outgoing(part, vertex, [&](Index out) {
            part.mesh.triangles[Surface::face(out)][out % 3] = vertex;
        });
    }
}

std::vector<Index> all_of(const Surface& surface) {
    std::vector<Index> faces(surface.num_faces());
    std::iota(faces.begin(), faces.end(), Index{0});
    return faces;
}

double longest_edge(const Surface& surface, Index face) {
    return std::max({surface.length_of(3 * face), surface.length_of(3 * face + 1),
                     surface.length_of(3 * face + 2)});
}

// Appends the faces around one site.
void append_faces_around(const Surface& surface, const SurfacePoint& site, double radius,
                         Ticker& ticker, std::vector<Index>& faces) {
    const Index start = site.face.value();
    const Vec3 centre = surface.mesh.positions[surface.tail(3 * start)];
    // A face need not lie in space, but its corners do: they are no nearer along the surface.
    const double most = radius + face_distance(surface, site, point_on(3 * start, 0));
    const auto is_near = [&](Index face) {
        const auto& corners = surface.mesh.triangles[face];
        const double room = most + longest_edge(surface, face);
        return std::any_of(corners.begin(), corners.end(), [&](Index v) {
            return (surface.mesh.positions[v] - centre).norm() <= room * (1 + 1e-9);
        });
    };
    std::unordered_set<Index> seen{start};
    std::vector<Index> open{start};
    while (!open.empty()) {
        ticker.tick(16);
        const Index face = open.back();
        open.pop_back();
        faces.push_back(face);
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface.twin[h] == no_index) continue;
            const Index next = Surface::face(surface.twin[h]);
            if (!seen.contains(next) && is_near(next)) {
                seen.insert(next);
                open.push_back(next);
            }
        }
    }
}

}  // namespace

Patch patch_of(const Surface& whole, std::vector<Index> faces, Ticker ticker) {
    Patch patch;
    patch.faces = std::move(faces);
    Surface& part = patch.surface;
    const auto moved = [&](Index half_edge) {
        if (half_edge == no_index) return no_index;
        const Index face = Surface::face(half_edge), rank = rank_of(patch.faces, face);
        if (rank == patch.faces.size() || patch.faces[rank] != face) return no_index;
        return 3 * rank + half_edge % 3;
    };
    for (const Index f : patch.faces) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            ticker.tick(2);
            part.twin.push_back(moved(whole.twin[h]));
            part.apex.push_back(whole.apex[h]);
            const auto here = static_cast<Index>(part.edge.size());
            if (part.twin[here] < here) {
                part.edge.push_back(part.edge[part.twin[here]]);
                continue;
            }
            part.edge.push_back(static_cast<Index>(part.length.size()));
            part.edge_half.push_back(here);
            part.length.push_back(whole.length_of(h));
        }
    }
    number_vertices(whole, ticker, patch);
    return patch;
}

std::vector<Index> faces_within(const Surface& surface, std::span<const SurfacePoint> sites,
                                double radius, Ticker ticker) {
    std::vector<Index> faces;
    for (const SurfacePoint& site : sites) {
        append_faces_around(surface, site, radius, ticker, faces);
        // Balls that overlap are not worth going through for each site.
        if (faces.size() > 2 * std::size_t{surface.num_faces()}) return all_of(surface);
    }
    return distinct(std::move(faces));
}

}  // namespace agvd
