// Corners of faces are laid out in one plane from their charts, which pass rotations on and never
// compute them from a short side (docs/algorithm/intrinsic.md, "Charts"). Flips: [bobenko2007].
#include "agvd/intrinsic/operations.h"

#include "agvd/core/parallel.h"

namespace agvd::detail {
namespace {

double longest_side(const Surface& surface, Index face) {
    return std::max({surface.length_of(3 * face), surface.length_of(3 * face + 1),
                     surface.length_of(3 * face + 2)});
}

// The height of a face over an edge. It is at most the longest side: over an edge as short as the
// rounding of the longest side, rounding may have made the area too large.
double height_over(double length, double doubled_area, double longest) {
    return std::min(doubled_area / length, longest);
}

// An edge of a face, as other faces see it.
struct Side {
    Index half_edge;
    Index twin;
    Index edge;
};

Side side_of(const Surface& surface, Index half_edge) {
    return {half_edge, surface.twin[half_edge], surface.edge[half_edge]};
}

// Gives sides their new half-edges. If a side is the twin of another one, both have moved.
template <std::size_t N>
void move_sides(Surface& surface, const std::array<Side, N>& sides,
                const std::array<Index, N>& targets) {
    for (std::size_t i = 0; i < N; ++i) {
        Index twin = sides[i].twin;
        for (std::size_t k = 0; k < N; ++k) {
            if (twin != no_index && sides[k].half_edge == twin) {
                twin = targets[k];
                break;
            }
        }
        join(surface, targets[i], twin, sides[i].edge);
    }
}

// Adds elements that get their contents later; returns the first one.
Index add_faces(Surface& surface, Index count) {
    const Index first = surface.num_faces();
    surface.mesh.triangles.resize(first + count);
    surface.twin.resize(surface.twin.size() + 3 * count, no_index);
    surface.edge.resize(surface.edge.size() + 3 * count, no_index);
    surface.apex.resize(surface.apex.size() + 3 * count);
    return first;
}
Index add_edge(Surface& surface, double length) {
    surface.length.push_back(length);
    surface.edge_half.push_back(no_index);
    return surface.num_edges() - 1;
}

// Cuts a face from a point of one of its sides to the apex. `at`: the share of the side before the
// point. The parts of the side get no twins; corners may be left without an outgoing half-edge.
std::array<Index, 2> cut_face(Surface& surface, FaceCharts& charts, Index half_edge, double at,
                              Index middle, Index near_edge, Index far_edge) {
    const Index face = Surface::face(half_edge);
    const Index next = Surface::next(half_edge), previous = Surface::previous(half_edge);
    const Index a = surface.tail(half_edge), b = surface.tail(next), c = surface.tail(previous);
    const std::array sides{side_of(surface, next), side_of(surface, previous)};
    const FaceChart whole = charts.of(face);
    const std::size_t k = half_edge % 3, k_next = next % 3, k_previous = previous % 3;
    const Vec2 near = at * whole.side[k];
    const Vec2 cut = -whole.side[k_previous] - near;  // From the new vertex to the apex.
    const FaceChart near_chart{{near, cut, whole.side[k_previous]},
                               {whole.turn[k], Vec2(1, 0), whole.turn[k_previous]}};
    const FaceChart far_chart{{(1 - at) * whole.side[k], whole.side[k_next], -cut},
                              {whole.turn[k], whole.turn[k_next], Vec2(1, 0)}};

    forget_outgoing(surface, std::span(&face, 1));
    const Index added = add_faces(surface, 1);
    surface.mesh.triangles[face] = {a, middle, c};
    surface.mesh.triangles[added] = {middle, b, c};
    move_sides<2>(surface, sides, {3 * added + 1, 3 * face + 2});
    const Index cut_edge =
        add_edge(surface, std::max(cut.norm(), least_length * whole.side[k_previous].norm()));
    surface.edge[3 * added + 2] = cut_edge;
    join(surface, 3 * face + 1, 3 * added + 2, cut_edge);
    join(surface, 3 * face, no_index, near_edge);
    join(surface, 3 * added, no_index, far_edge);
    charts.set(face, near_chart);
    charts.set(added, far_chart);
    set_apexes(surface, face, near_chart);
    set_apexes(surface, added, far_chart);
    return {3 * face, 3 * added};
}

// Twice the area by Heron's formula, in Kahan's order of operations; 0 where there is no triangle.
double doubled_area(double a, double b, double c) {
    if (a < b) std::swap(a, b);
    if (b < c) std::swap(b, c);
    if (a < b) std::swap(a, b);
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return product > 0 ? std::sqrt(product) / 2 : 0;
}

}  // namespace

void set_apexes(Surface& surface, Index face, const FaceChart& chart) {
    const double longest = longest_side(surface, face);
    const double doubled_area =
        std::max(-cross(chart.side[0], chart.side[2]), least_doubled_area * longest * longest);
    for (std::size_t k = 0; k < 3; ++k) {
        const double length = std::max(chart.side[k].norm(), least_length * longest);
        surface.apex[3 * face + k] = {-chart.side[k].dot(chart.side[(k + 2) % 3]) / length,
                                      height_over(length, doubled_area, longest)};
    }
}

void join(Surface& surface, Index half_edge, Index twin, Index edge) {
    surface.twin[half_edge] = twin;
    surface.edge[half_edge] = edge;
    if (twin != no_index) surface.twin[twin] = half_edge;
    surface.edge_half[edge] = std::min(half_edge, twin);
}

void renew_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            Index& outgoing = surface.outgoing[surface.tail(h)];
            if (surface.twin[h] == no_index || outgoing == no_index) outgoing = h;
        }
    }
}

void forget_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface.outgoing[surface.tail(h)] == h)
                surface.outgoing[surface.tail(h)] = no_index;
        }
    }
}

Index add_vertex(Surface& surface) {
    surface.mesh.positions.push_back(Vec3::Zero());
    surface.outgoing.push_back(no_index);
    surface.can_be_pseudo_source.push_back(0);
    return surface.num_vertices() - 1;
}

void raise_degenerate_faces(Surface& surface, int num_threads, Poller& poller) {
    const auto raise = [&](Index f) {
        const double longest = longest_side(surface, f);
        const double least = least_doubled_area * longest * longest;
        if (surface.length_of(3 * f) * surface.apex[3 * f].y() >= least) return;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            surface.apex[h].y() = height_over(surface.length_of(h), least, longest);
        }
    };
    parallel_each(surface.num_faces(), pass_grain, num_threads, raise, poller);
}

Quad quad_at(const Surface& surface, Index half_edge) {
    const double length = surface.length_of(half_edge);
    const Vec2& beyond = surface.apex[surface.twin[half_edge]];
    return {{length, 0}, surface.apex[half_edge], {length - beyond.x(), -beyond.y()}};
}

Quad quad_at(const Surface& surface, FaceCharts& charts, Index half_edge) {
    const Index twin = surface.twin[half_edge];
    const Vec2 beyond = charts.of(Surface::face(twin)).side[Surface::next(twin) % 3];
    const FaceChart& chart = charts.of(Surface::face(half_edge));
    return {chart.side[half_edge % 3], -chart.side[Surface::previous(half_edge) % 3],
            turned_by(beyond, chart.turn[half_edge % 3])};
}

void flip(Surface& surface, FaceCharts& charts, Index half_edge, const Quad& quad) {
    const Index twin = surface.twin[half_edge];
    const Index f = Surface::face(half_edge), g = Surface::face(twin);
    const Index a = surface.tail(half_edge), b = surface.tail(twin);
    const Index c = surface.tail(Surface::previous(half_edge));
    const Index d = surface.tail(Surface::previous(twin));
    const Index edge = surface.edge[half_edge];
    const std::array sides{side_of(surface, Surface::next(twin)),            // a d
                           side_of(surface, Surface::previous(twin)),        // d b
                           side_of(surface, Surface::next(half_edge)),       // b c
                           side_of(surface, Surface::previous(half_edge))};  // c a
    const Vec2 turn = charts.of(f).turn[half_edge % 3];
    // Both new faces get the directions of the first one; turns across change between the two only.
    std::array<Vec2, 4> turns;
    for (std::size_t i = 0; i < 4; ++i) {
        const Index h = sides[i].half_edge;
        turns[i] = charts.of(Surface::face(h)).turn[h % 3];
        if (Surface::face(h) == g) turns[i] = turned_by(turns[i], turn);
        if (sides[i].twin != no_index && Surface::face(sides[i].twin) == g) {
            turns[i] = turned_by(turns[i], conjugate(turn));
        }
        turns[i].normalize();
    }
    const std::array changed{f, g};
    forget_outgoing(surface, changed);
    surface.mesh.triangles[f] = {a, d, c};
    surface.mesh.triangles[g] = {d, b, c};
    move_sides<4>(surface, sides, {3 * f, 3 * g, 3 * g + 1, 3 * f + 2});
    surface.edge[3 * g + 2] = edge;
    join(surface, 3 * f + 1, 3 * g + 2, edge);
    const Vec2 diagonal = quad.apex - quad.across;
    surface.length[edge] = diagonal.norm();
    charts.set(f, {{quad.across, diagonal, -quad.apex}, {turns[0], Vec2(1, 0), turns[3]}});
    charts.set(g, {{quad.head - quad.across, quad.apex - quad.head, -diagonal},
                   {turns[1], turns[2], Vec2(1, 0)}});
    charts.share_turns(f);
    charts.share_turns(g);
    set_apexes(surface, f, charts.of(f));
    set_apexes(surface, g, charts.of(g));
    renew_outgoing(surface, changed);
}

EdgeSplit split_edge(Surface& surface, FaceCharts& charts, Index half_edge, double at,
                     Index middle) {
    EdgeSplit result;
    (void)charts.of(Surface::face(half_edge));  // The chart is made while the edge has its length.
    if (surface.twin[half_edge] != no_index) {
        (void)charts.of(Surface::face(surface.twin[half_edge]));
    }
    const Index near_edge = surface.edge[half_edge];
    const Index far_edge = result.new_edge =
        add_edge(surface, std::max(1 - at, least_length) * surface.length[near_edge]);
    surface.length[near_edge] *= std::max(at, least_length);

    Index twin = surface.twin[half_edge];
    const Index face = Surface::face(half_edge);
    result.side[0] = {half_edge, surface.num_faces()};
    if (twin != no_index) {
        surface.twin[twin] = no_index;
        if (twin == Surface::next(half_edge)) {  // A face glued to itself: the cut moves the twin.
            twin = 3 * surface.num_faces() + 1;
        } else if (twin == Surface::previous(half_edge)) {
            twin = 3 * face + 2;
        }
    }
    auto halves = cut_face(surface, charts, half_edge, at, middle, near_edge, far_edge);
    std::array<Index, 4> changed{face, result.side[0].new_face, face, face};
    if (twin != no_index) {
        result.side[1] = {twin, surface.num_faces()};
        changed[2] = Surface::face(twin);
        changed[3] = result.side[1].new_face;
        const std::array others =
            cut_face(surface, charts, twin, 1 - at, middle, far_edge, near_edge);
        for (Index& half : halves) {  // The second cut moves the halves if it meets the same face.
            if (half == Surface::next(twin)) {
                half = 3 * changed[3] + 1;
            } else if (half == Surface::previous(twin)) {
                half = 3 * changed[2] + 2;
            }
        }
        join(surface, halves[0], others[1], near_edge);
        join(surface, halves[1], others[0], far_edge);
    }
    renew_outgoing(surface, changed);
    return result;
}

void bury(Surface& surface, Index face) {
    surface.mesh.triangles[face] = {no_index, no_index, no_index};
    for (Index h = 3 * face; h < 3 * face + 3; ++h) surface.twin[h] = no_index;
}

void renew_face(Surface& surface, FaceCharts& charts, Index face) {
    const double longest = longest_side(surface, face);
    const std::array<double, 3> side{surface.length_of(3 * face), surface.length_of(3 * face + 1),
                                     surface.length_of(3 * face + 2)};
    const double area =
        std::max(doubled_area(side[0], side[1], side[2]), least_doubled_area * longest * longest);
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = side[k], back = side[(k + 2) % 3], beyond = side[(k + 1) % 3];
        surface.apex[3 * face + k] = {
            (along + (back - beyond) * ((back + beyond) / along)) / 2,
            area / along,
        };
    }
    charts.renew(face);
}

void insert_in_face(Surface& surface, FaceCharts& charts, Index face,
                    const std::array<double, 3>& where, Index vertex) {
    const FaceChart whole = charts.of(face);
    const Triangle corners = surface.mesh.triangles[face];
    const std::array sides{side_of(surface, 3 * face), side_of(surface, 3 * face + 1),
                           side_of(surface, 3 * face + 2)};
    const std::array<Vec2, 3> corner{Vec2(0, 0), whole.side[0], -whole.side[2]};
    const Vec2 point = where[1] * corner[1] + where[2] * corner[2];

    forget_outgoing(surface, std::span(&face, 1));
    const Index added = add_faces(surface, 2);
    const std::array<Index, 3> faces{face, added, added + 1};
    move_sides<3>(surface, sides, {3 * faces[0], 3 * faces[1], 3 * faces[2]});
    const double least = least_length * longest_side(surface, face);
    for (Index k = 0; k < 3; ++k) {
        surface.mesh.triangles[faces[k]] = {corners[k], corners[(k + 1) % 3], vertex};
        const Index spoke =  // From corner k + 1.
            add_edge(surface, std::max((point - corner[(k + 1) % 3]).norm(), least));
        surface.edge[3 * faces[(k + 1) % 3] + 2] = spoke;
        join(surface, 3 * faces[k] + 1, 3 * faces[(k + 1) % 3] + 2, spoke);
    }
    for (Index k = 0; k < 3; ++k) {
        charts.set(faces[k], {{whole.side[k], point - corner[(k + 1) % 3], corner[k] - point},
                              {whole.turn[k], Vec2(1, 0), Vec2(1, 0)}});
    }
    for (const Index f : faces) set_apexes(surface, f, charts.of(f));
    renew_outgoing(surface, faces);
}

void remove_from_face(Surface& surface, FaceCharts& charts, Index half_edge) {
    std::array<Side, 3> sides;
    std::array<Index, 3> faces;
    Triangle corners;
    for (std::size_t k = 0; k < 3; ++k) {
        faces[k] = Surface::face(half_edge);
        sides[k] = side_of(surface, Surface::next(half_edge));
        corners[k] = surface.tail(sides[k].half_edge);
        surface.edge_half[surface.edge[half_edge]] = no_index;
        half_edge = surface.twin[Surface::previous(half_edge)];
    }
    forget_outgoing(surface, faces);
    bury(surface, faces[1]);
    bury(surface, faces[2]);
    surface.mesh.triangles[faces[0]] = corners;
    move_sides<3>(surface, sides, {3 * faces[0], 3 * faces[0] + 1, 3 * faces[0] + 2});
    renew_outgoing(surface, std::span(faces.data(), 1));
    renew_face(surface, charts, faces[0]);
}

void remove_from_boundary(Surface& surface, FaceCharts& charts, Index half_edge, double length) {
    const Index spoke = surface.twin[Surface::previous(half_edge)];
    const std::array faces{Surface::face(half_edge), Surface::face(spoke)};
    const Index kept = surface.edge[half_edge];
    const std::array sides{side_of(surface, Surface::next(half_edge)),
                           side_of(surface, Surface::next(spoke))};
    const Triangle corners{surface.head(half_edge), surface.head(spoke),
                           surface.tail(Surface::previous(spoke))};
    surface.edge_half[surface.edge[spoke]] = no_index;
    surface.edge_half[surface.edge[Surface::previous(spoke)]] = no_index;
    forget_outgoing(surface, faces);
    bury(surface, faces[1]);
    const Index face = faces[0];
    surface.mesh.triangles[face] = corners;
    move_sides<2>(surface, sides, {3 * face, 3 * face + 1});
    join(surface, 3 * face + 2, no_index, kept);
    surface.length[kept] = length;
    renew_outgoing(surface, std::span(faces.data(), 1));
    renew_face(surface, charts, face);
}

void remove_ear(Surface& surface, Index half_edge) {
    const Index face = Surface::face(half_edge);
    const Index inside = surface.twin[Surface::next(half_edge)];
    const Index edge = surface.edge[inside];
    surface.edge_half[surface.edge[half_edge]] = no_index;
    surface.edge_half[surface.edge[Surface::previous(half_edge)]] = no_index;
    forget_outgoing(surface, std::span(&face, 1));
    bury(surface, face);
    join(surface, inside, no_index, edge);
    const Index near = Surface::face(inside);
    renew_outgoing(surface, std::span(&near, 1));
}

}  // namespace agvd::detail
