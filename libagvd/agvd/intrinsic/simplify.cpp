// Makes the component a surface of its own, cuts edges until it is simplicial, inserts the points
// as vertices, and removes all others ([liu2023]).
#include "agvd/intrinsic/simplify.h"

#include <algorithm>

#include "agvd/intrinsic/simplify_steps.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

using detail::FaceCharts;
using detail::FaceHistory;
using detail::Way;

// A component as a surface of its own, and the positions of its vertices on the whole surface.
struct Part {
    Surface surface;
    std::vector<SurfacePoint> point;  // By vertex.
};

// Cuts edges at their middles until the complex is simplicial.
FaceHistory make_simplicial(Part& part, FaceCharts& charts, std::span<const Index> faces) {
    Surface& s = part.surface;
    FaceHistory history(s.num_faces());
    for (std::vector<Index> edges; !(edges = detail::edges_to_cut(s)).empty();) {
        for (const Index e : edges) {
            const Index h = s.edge_half[e];
            SurfacePoint middle = *history.carry(Way::Backward, point_on(h, 0.5));
            middle.face = FaceId(faces[middle.face.value()]);
            part.point.push_back(middle);
            const Index vertex = detail::add_vertex(s);
            for (const detail::EdgeSplit::Side& side :
                 detail::split_edge(s, charts, h, 0.5, vertex).side) {
                if (side.half_edge != no_index) history.add_split(side.half_edge, side.new_face);
            }
        }
    }
    return history;
}

}  // namespace

SimplifiedMesh simplify(const Surface& surface, std::span<const Index> faces,
                        std::span<const SurfacePoint> points) {
    Part part{surface_of_part(surface, faces, {}), {}};
    Surface& s = part.surface;
    part.point.resize(s.num_vertices());
    for (Index h = 0; h < s.twin.size(); ++h) {
        part.point[s.tail(h)] = point_on(3 * faces[h / 3] + h % 3, 0);
    }
    Poller never;
    detail::raise_degenerate_faces(s, 1, never);
    FaceCharts charts(s);
    const FaceHistory history = make_simplicial(part, charts, faces);
    std::vector<SurfacePoint> local(points.begin(), points.end());
    for (SurfacePoint& point : local) {
        point.face = FaceId(rank_of(faces, point.face.value()));
        point = *history.carry(Way::Forward, point);
    }
    const std::vector<Index> vertex = detail::insert_points(s, charts, local);
    for (Index i = 0; i < vertex.size(); ++i) {
        part.point.resize(s.num_vertices());
        part.point[vertex[i]] = points[i];
    }
    for (Index v = 0; v < s.num_vertices(); ++v) {
        s.mesh.positions[v] = position(surface.mesh, part.point[v]);
    }

    std::vector<Index> number(s.num_vertices(), no_index);
    for (Index i = 0; i < vertex.size(); ++i) number[vertex[i]] = i;
    detail::remove_vertices(s, charts, number);
    SimplifiedMesh result;
    for (Index v = 0; v < s.num_vertices(); ++v) {
        if (number[v] != no_index || s.outgoing[v] == no_index) continue;
        number[v] = static_cast<Index>(points.size() + result.extra.size());
        result.extra.push_back(part.point[v]);
    }
    for (const Triangle& t : s.mesh.triangles) {
        if (t[0] == no_index) continue;
        result.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return result;
}

}  // namespace agvd

namespace agvd::detail {
namespace {

// A key that equal edges or faces share. Of equal ones, that with the lowest number comes first.
template <typename Key>
void append_repeated(std::vector<std::pair<Key, Index>>& things, std::vector<Index>& repeated) {
    std::sort(things.begin(), things.end());
    for (std::size_t i = 1; i < things.size(); ++i) {
        if (things[i].first == things[i - 1].first) repeated.push_back(things[i].second);
    }
}

}  // namespace

bool has_edge(const Surface& surface, Index a, Index b) {
    Index at_a = surface.outgoing[a], at_b = surface.outgoing[b];
    // Passes one face. The other corners of a face are neighbours.
    const auto meets = [&](Index& h, Index other) {
        const Index back = Surface::previous(h);
        if (surface.head(h) == other || surface.tail(back) == other) return true;
        h = surface.twin[back];
        return false;
    };
    while (at_a != no_index && at_b != no_index) {
        if (meets(at_a, b) || meets(at_b, a)) return true;
        if (at_a == surface.outgoing[a] || at_b == surface.outgoing[b]) return false;
    }
    return false;
}

std::vector<Index> edges_to_cut(const Surface& surface) {
    std::vector<Index> found;
    std::vector<std::pair<std::array<Index, 2>, Index>> edges;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        const Index a = surface.tail(h), b = surface.head(h);
        if (a == b) {
            found.push_back(e);
        } else {
            edges.push_back({{std::min(a, b), std::max(a, b)}, e});
        }
    }
    append_repeated(edges, found);
    std::sort(found.begin(), found.end());
    if (!found.empty()) return found;
    std::vector<std::pair<Triangle, Index>> faces;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        Triangle corners = surface.mesh.triangles[f];
        std::sort(corners.begin(), corners.end());
        faces.emplace_back(corners, surface.edge[3 * f]);
    }
    append_repeated(faces, found);
    return distinct(std::move(found));
}

}  // namespace agvd::detail
