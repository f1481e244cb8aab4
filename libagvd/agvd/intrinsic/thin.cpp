// Thins one component to given points ([liu2023]): makes it a surface of its own, cuts edges until
// it is simplicial, inserts the points as vertices, and removes all other vertices. A vertex of the
// result is named by the point that it is, or by its place on the whole surface if it had to stay.
#include "agvd/intrinsic/thin.h"

#include <algorithm>

#include "agvd/intrinsic/face_history.h"
#include "agvd/intrinsic/face_operations.h"
#include "agvd/intrinsic/insert_points.h"
#include "agvd/intrinsic/simplicial.h"
#include "agvd/intrinsic/vertex_removal.h"

namespace agvd {
namespace {

using detail::FaceCharts;
using detail::FaceHistory;

// A component as a surface of its own, and the positions of its vertices on the whole surface.
struct Part {
    Surface surface;
    std::vector<SurfacePoint> place;  // By vertex.
};

Index rank_of(const std::vector<Index>& ascending, Index value) {
    return static_cast<Index>(std::lower_bound(ascending.begin(), ascending.end(), value) -
                              ascending.begin());
}

std::vector<Index> distinct(std::vector<Index> values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

Part part_of(const Surface& whole, std::span<const Index> faces) {
    const std::vector<Index> face_list(faces.begin(), faces.end());
    std::vector<Index> vertices, edges;
    for (const Index f : faces) {
        for (Index k = 0; k < 3; ++k) {
            vertices.push_back(whole.mesh.triangles[f][k]);
            edges.push_back(whole.edge[3 * f + k]);
        }
    }
    vertices = distinct(std::move(vertices));
    edges = distinct(std::move(edges));
    const auto moved = [&](Index half_edge) {
        if (half_edge == no_index) return no_index;
        return 3 * rank_of(face_list, Surface::face(half_edge)) + half_edge % 3;
    };

    Part part;
    Surface& s = part.surface;
    part.place.resize(vertices.size());
    for (const Index f : faces) {
        Triangle t = whole.mesh.triangles[f];
        for (Index k = 0; k < 3; ++k) {
            t[k] = rank_of(vertices, t[k]);
            SurfacePoint corner{FaceId(f), {0, 0, 0}};
            corner.barycentric[k] = 1;
            part.place[t[k]] = corner;
            s.twin.push_back(moved(whole.twin[3 * f + k]));
            s.edge.push_back(rank_of(edges, whole.edge[3 * f + k]));
            s.apex.push_back(whole.apex[3 * f + k]);
        }
        s.mesh.triangles.push_back(t);
    }
    for (const Index v : vertices) {
        s.mesh.positions.push_back(whole.mesh.positions[v]);
        s.outgoing.push_back(moved(whole.outgoing[v]));
        s.can_be_pseudo_source.push_back(whole.can_be_pseudo_source[v]);
    }
    for (const Index e : edges) {
        s.edge_half.push_back(moved(whole.edge_half[e]));
        s.length.push_back(whole.length[e]);
    }
    return part;
}

// Cuts edges at their middles until the complex is simplicial.
FaceHistory make_simplicial(Part& part, FaceCharts& charts, std::span<const Index> faces) {
    Surface& s = part.surface;
    FaceHistory history(s.num_faces());
    for (std::vector<Index> edges; !(edges = detail::edges_to_cut(s)).empty();) {
        for (const Index e : edges) {
            const Index h = s.edge_half[e];
            SurfacePoint middle{FaceId(Surface::face(h)), {0, 0, 0}};
            middle.barycentric[h % 3] = middle.barycentric[Surface::next(h) % 3] = 0.5;
            middle = history.backward(middle);
            middle.face = FaceId(faces[middle.face.value()]);
            part.place.push_back(middle);
            const Index vertex = s.num_vertices();
            s.mesh.positions.push_back(Vec3::Zero());
            s.outgoing.push_back(no_index);
            s.can_be_pseudo_source.push_back(0);
            for (const detail::EdgeSplit::Side& side :
                 detail::split_edge(s, charts, h, 0.5, vertex).side) {
                if (side.half_edge != no_index) history.add_split(side.half_edge, side.new_face);
            }
        }
    }
    return history;
}

}  // namespace

ThinnedMesh thin(const Surface& surface, std::span<const Index> faces,
                 std::span<const SurfacePoint> points) {
    Part part = part_of(surface, faces);
    Surface& s = part.surface;
    Poller never;
    (void)detail::raise_degenerate_faces(s, 1, never);
    FaceCharts charts(s);
    const FaceHistory history = make_simplicial(part, charts, faces);
    std::vector<SurfacePoint> local(points.begin(), points.end());
    for (SurfacePoint& point : local) {
        const auto it = std::lower_bound(faces.begin(), faces.end(), point.face.value());
        point.face = FaceId(static_cast<Index>(it - faces.begin()));
        point = history.forward(point);
    }
    const std::vector<Index> vertex = detail::insert_points(s, charts, local);
    for (Index i = 0; i < vertex.size(); ++i) {
        part.place.resize(s.num_vertices());
        part.place[vertex[i]] = points[i];
    }
    for (Index v = 0; v < s.num_vertices(); ++v) {
        s.mesh.positions[v] = position(surface.mesh.view(), part.place[v]);
    }

    std::vector<Index> number(s.num_vertices(), no_index);
    for (Index i = 0; i < vertex.size(); ++i) number[vertex[i]] = i;
    ThinnedMesh result;
    result.flips = detail::remove_vertices(s, charts, number);
    for (Index v = 0; v < s.num_vertices(); ++v) {
        if (number[v] != no_index || s.outgoing[v] == no_index) continue;
        number[v] = static_cast<Index>(points.size() + result.extra.size());
        result.extra.push_back(part.place[v]);
    }
    for (const Triangle& t : s.mesh.triangles) {
        if (t[0] != no_index)
            result.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return result;
}

}  // namespace agvd
