#include "agvd/intrinsic/vertex_ring.h"

#include <algorithm>

#include "agvd/intrinsic/face_sides.h"
#include "agvd/intrinsic/vertex_operations.h"
#include "agvd/mesh/one_ring.h"

namespace agvd::detail {
namespace {

// The sides of the ring across from the vertex, and the turns of what lies beyond each into the
// chart of the ring's first face.
template <std::size_t N>
struct Rim {
    std::array<Side, N> side;
    std::array<Vec2, N> along;
    std::array<Vec2, N> turn;
};

template <std::size_t N>
Rim<N> rim_of(const Surface& surface, FaceCharts& charts, const VertexRing& ring) {
    Rim<N> rim;
    for (std::size_t i = 0; i < N; ++i) {
        const Index h = Surface::next(ring.half_edge[i]);
        const FaceChart& chart = charts.of(Surface::face(h));
        rim.side[i] = side_of(surface, h);
        rim.along[i] = turned_by(chart.side[h % 3], ring.turn[i]);
        rim.turn[i] = turned_by(chart.turn[h % 3], ring.turn[i]);
        for (std::size_t k = 0; k < N; ++k) {  // What lies beyond may be of the ring.
            if (rim.side[i].twin == Surface::next(ring.half_edge[k])) {
                rim.turn[i] = turned_by(rim.turn[i], conjugate(ring.turn[k]));
            }
        }
        rim.turn[i].normalize();
    }
    return rim;
}

void forget_edge(Surface& surface, Index half_edge) {
    surface.edge_half[surface.edge[half_edge]] = no_index;
}

void set_chart(Surface& surface, FaceCharts& charts, Index face, const FaceChart& chart) {
    charts.of(face) = chart;
    charts.share_turns(face);
    set_apexes(surface, face, charts.of(face));
}

MergedFace merge_three(Surface& surface, FaceCharts& charts, const VertexRing& ring) {
    const Rim<3> rim = rim_of<3>(surface, charts, ring);
    std::array<Index, 3> faces;
    MergedFace made;
    Triangle corners;
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        faces[k] = Surface::face(ring.half_edge[k]);
        made.half_edge[k] = rim.side[k].half_edge;
        made.shares[k] = std::max(cross(ring.spoke[(k + 1) % 3], ring.spoke[(k + 2) % 3]), 0.0);
        corners[k] = surface.head(ring.half_edge[k]);
        sum += made.shares[k];
    }
    for (double& share : made.shares) share /= sum;
    made.face = faces[0];
    for (const Index h : ring.half_edge) forget_edge(surface, h);
    forget_outgoing(surface, faces);
    for (const Index f : faces) bury(surface, f);
    surface.mesh.triangles[made.face] = corners;
    move_sides<3>(surface, rim.side, {3 * made.face, 3 * made.face + 1, 3 * made.face + 2});
    renew_outgoing(surface, std::span(faces.data(), 1));
    charts.forget(faces[1]);
    charts.forget(faces[2]);
    set_chart(surface, charts, made.face, {rim.along, rim.turn});
    return made;
}

std::array<MergedFace, 2> merge_straight(Surface& surface, FaceCharts& charts,
                                         const VertexRing& ring) {
    const Rim<4> rim = rim_of<4>(surface, charts, ring);
    const Index a = Surface::face(ring.half_edge[0]), b = Surface::face(ring.half_edge[2]);
    const Index n0 = surface.head(ring.half_edge[0]), n1 = surface.head(ring.half_edge[1]);
    const Index n2 = surface.head(ring.half_edge[2]), n3 = surface.head(ring.half_edge[3]);
    const double near = ring.spoke[0].norm(), far = ring.spoke[2].norm();
    const double share = far / (near + far);  // Of the first spoke's end.
    const std::array<MergedFace, 2> made{
        {{a, {rim.side[0].half_edge, rim.side[1].half_edge, no_index}, {share, 0, 1 - share}},
         {b, {rim.side[2].half_edge, rim.side[3].half_edge, no_index}, {1 - share, 0, share}}}};
    const Index line = surface.edge[ring.half_edge[0]];
    std::array<Index, 4> faces;
    for (std::size_t i = 0; i < 4; ++i) faces[i] = Surface::face(ring.half_edge[i]);
    for (const Index h : ring.half_edge) forget_edge(surface, h);
    forget_outgoing(surface, faces);
    for (const Index f : faces) bury(surface, f);
    surface.mesh.triangles[a] = {n0, n1, n2};
    surface.mesh.triangles[b] = {n2, n3, n0};
    surface.length[line] = near + far;
    move_sides<4>(surface, rim.side, {3 * a, 3 * a + 1, 3 * b, 3 * b + 1});
    surface.edge[3 * a + 2] = surface.edge[3 * b + 2] = line;
    join(surface, 3 * a + 2, 3 * b + 2, line);
    renew_outgoing(surface, std::array{a, b});
    charts.forget(faces[1]);
    charts.forget(faces[3]);
    const Vec2 across = ring.spoke[0] - ring.spoke[2];
    const Vec2 none(1, 0);
    set_chart(surface, charts, a,
              {{rim.along[0], rim.along[1], across}, {rim.turn[0], rim.turn[1], none}});
    set_chart(surface, charts, b,
              {{rim.along[2], rim.along[3], -across}, {rim.turn[2], rim.turn[3], none}});
    return made;
}

}  // namespace

void lay_ring(const Surface& surface, FaceCharts& charts, Index vertex, VertexRing& ring) {
    ring.half_edge.clear();
    ring.spoke.clear();
    ring.turn.clear();
    ring.is_simple = true;
    Vec2 turn(1, 0);
    for_each_outgoing(surface, vertex, [&](Index h) {
        const FaceChart& chart = charts.of(Surface::face(h));
        for (const Index other : ring.half_edge) {
            ring.is_simple = ring.is_simple && Surface::face(other) != Surface::face(h);
        }
        ring.is_simple = ring.is_simple && surface.head(h) != vertex;
        ring.half_edge.push_back(h);
        ring.spoke.push_back(turned_by(chart.side[h % 3], turn));
        ring.turn.push_back(turn);
        turn = turned_by(chart.turn[Surface::previous(h) % 3], turn).normalized();
    });
}

void rotate_ring(VertexRing& ring) {
    const Vec2 back = conjugate(ring.turn[1]);
    for (Vec2& turn : ring.turn) turn = turned_by(turn, back);
    for (Vec2& spoke : ring.spoke) spoke = turned_by(spoke, back);
    std::rotate(ring.half_edge.begin(), ring.half_edge.begin() + 1, ring.half_edge.end());
    std::rotate(ring.spoke.begin(), ring.spoke.begin() + 1, ring.spoke.end());
    std::rotate(ring.turn.begin(), ring.turn.begin() + 1, ring.turn.end());
}

std::array<MergedFace, 2> merge_ring(Surface& surface, FaceCharts& charts, const VertexRing& ring) {
    if (ring.half_edge.size() == 3) return {merge_three(surface, charts, ring), {}};
    return merge_straight(surface, charts, ring);
}

}  // namespace agvd::detail
