#include "agvd/intrinsic/face_operations.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace agvd::detail {
namespace {

// Of the sine of the sum of the opposite angles, and of lengths: closer than that to a circle, the
// shorter diagonal is taken.
constexpr double on_circle = 1e-9;
// Of the quad's shares: with less the quad has no corner there.
constexpr double least_share = 1e-13;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

double longest_side(const Surface& surface, Index face) {
    return std::max({surface.length_of(3 * face), surface.length_of(3 * face + 1),
                     surface.length_of(3 * face + 2)});
}

// Sets the three apexes of a face from its corners in the plane, counter-clockwise.
void set_apexes(Surface& surface, Index face, const std::array<Vec2, 3>& corner) {
    const double longest = longest_side(surface, face);
    const double doubled_area = std::max(cross(corner[1] - corner[0], corner[2] - corner[0]),
                                         least_doubled_area * longest * longest);
    for (Index k = 0; k < 3; ++k) {
        const double length = surface.length_of(3 * face + k);
        const Vec2& tail = corner[k];
        const Vec2 along = corner[(k + 1) % 3] - tail;
        const Vec2 up = corner[(k + 2) % 3] - tail;
        surface.apex[3 * face + k] = {along.dot(up) / length, doubled_area / length};
    }
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

void join(Surface& surface, Index half_edge, Index twin, Index edge) {
    surface.twin[half_edge] = twin;
    surface.edge[half_edge] = edge;
    if (twin != no_index) surface.twin[twin] = half_edge;
    surface.edge_half[edge] = std::min(half_edge, twin);
}

// Gives sides their new half-edges. A side may be the twin of another one: then both have moved.
template <std::size_t N>
void move_sides(Surface& surface, const std::array<Side, N>& sides,
                const std::array<Index, N>& places) {
    for (std::size_t i = 0; i < N; ++i) {
        Index twin = sides[i].twin;
        for (std::size_t k = 0; k < N; ++k) {
            if (twin != no_index && sides[k].half_edge == twin) {
                twin = places[k];
                break;
            }
        }
        join(surface, places[i], twin, sides[i].edge);
    }
}

// Gives vertices an outgoing half-edge that have none; on the boundary the one without twin.
void renew_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            Index& outgoing = surface.outgoing[surface.tail(h)];
            if (surface.twin[h] == no_index || outgoing == no_index) outgoing = h;
        }
    }
}

// Vertices whose outgoing half-edge lies in one of the faces, which are about to change, have none.
void forget_outgoing(Surface& surface, std::span<const Index> faces) {
    for (const Index face : faces) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            if (surface.outgoing[surface.tail(h)] == h) surface.outgoing[surface.tail(h)] = no_index;
        }
    }
}

// Cuts a face at the middle of one of its sides, whose halves stay without twins. Corners of the
// face may stay without an outgoing half-edge.
// \return the half-edges from the tail to the middle and from there to the head.
std::array<Index, 2> cut_face(Surface& surface, Index half_edge, Index middle, Index near_edge,
                              Index far_edge) {
    const Index face = Surface::face(half_edge);
    const auto added = surface.num_faces();
    const Index next = Surface::next(half_edge), previous = Surface::previous(half_edge);
    const Index a = surface.tail(half_edge), b = surface.tail(next), c = surface.tail(previous);
    const std::array sides{side_of(surface, next), side_of(surface, previous)};
    const double length = surface.length[near_edge];  // Of half the side.
    const Vec2 apex = surface.apex[half_edge];

    forget_outgoing(surface, std::span(&face, 1));
    surface.mesh.triangles[face] = {a, middle, c};
    surface.mesh.triangles.push_back({middle, b, c});
    surface.twin.resize(surface.twin.size() + 3, no_index);
    surface.edge.resize(surface.edge.size() + 3, no_index);
    surface.apex.resize(surface.apex.size() + 3);
    move_sides(surface, sides, {3 * added + 1, 3 * face + 2});
    const Index cut = surface.num_edges();
    surface.length.push_back((apex - Vec2(length, 0)).norm());
    surface.edge_half.push_back(no_index);
    join(surface, 3 * face + 1, 3 * added + 2, cut);
    surface.edge[3 * added + 2] = cut;
    join(surface, 3 * face, no_index, near_edge);
    join(surface, 3 * added, no_index, far_edge);
    set_apexes(surface, face, {Vec2(0, 0), Vec2(length, 0), apex});
    set_apexes(surface, added, {Vec2(length, 0), Vec2(2 * length, 0), apex});
    return {3 * face, 3 * added};
}

}  // namespace

Index raise_flat_faces(Surface& surface) {
    Index raised = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const double longest = longest_side(surface, f);
        const double least = least_doubled_area * longest * longest;
        if (surface.length_of(3 * f) * surface.apex[3 * f].y() >= least) continue;
        ++raised;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            surface.apex[h].y() = least / surface.length_of(h);
        }
    }
    return raised;
}

Quad::Quad(const Surface& surface, Index half_edge)
    : length(surface.length_of(half_edge)),
      apex(surface.apex[half_edge]),
      across(length - surface.apex[surface.twin[half_edge]].x(),
             -surface.apex[surface.twin[half_edge]].y()) {}

// The angles opposite to the edge sum to more than pi.
bool Quad::should_flip() const {
    const Vec2 head(length, 0);
    const double cos_apex = (-apex).dot(head - apex), sin_apex = length * apex.y();
    const double cos_across = (-across).dot(head - across), sin_across = -length * across.y();
    const double scale = apex.norm() * (head - apex).norm() * across.norm() * (head - across).norm();
    const double sine = cos_apex * sin_across + sin_apex * cos_across;
    if (std::abs(sine) > on_circle * scale) return sine < 0;
    return length > (1 + on_circle) * flipped_length();
}

// Head and tail are computed alike, so that a flip means the same from both sides.
QuadShares Quad::shares() const {
    const double share = across.y() / apex.y();
    return {((length - across.x()) - share * (length - apex.x())) / length,
            (across.x() - share * apex.x()) / length, share};
}

bool Quad::is_convex() const {
    const QuadShares share = shares();
    const double sum = std::abs(share.tail) + std::abs(share.head) - share.apex;
    return std::isfinite(sum) && share.tail > least_share * sum && share.head > least_share * sum;
}

void flip(Surface& surface, Index half_edge, const Quad& quad) {
    const Index twin = surface.twin[half_edge];
    const Index f = Surface::face(half_edge), g = Surface::face(twin);
    const Index a = surface.tail(half_edge), b = surface.tail(twin);
    const Index c = surface.tail(Surface::previous(half_edge));
    const Index d = surface.tail(Surface::previous(twin));
    const Index edge = surface.edge[half_edge];
    const std::array sides{side_of(surface, Surface::next(twin)),      // a d
                           side_of(surface, Surface::previous(twin)),  // d b
                           side_of(surface, Surface::next(half_edge)),  // b c
                           side_of(surface, Surface::previous(half_edge))};  // c a
    const std::array changed{f, g};
    forget_outgoing(surface, changed);
    surface.mesh.triangles[f] = {a, d, c};
    surface.mesh.triangles[g] = {d, b, c};
    move_sides(surface, sides, {3 * f, 3 * g, 3 * g + 1, 3 * f + 2});
    surface.edge[3 * g + 2] = edge;
    join(surface, 3 * f + 1, 3 * g + 2, edge);
    surface.length[edge] = quad.flipped_length();
    set_apexes(surface, f, {Vec2(0, 0), quad.across, quad.apex});
    set_apexes(surface, g, {quad.across, Vec2(quad.length, 0), quad.apex});
    renew_outgoing(surface, changed);
}

EdgeSplit split_edge(Surface& surface, Index half_edge, Index middle) {
    EdgeSplit result;
    const Index near_edge = surface.edge[half_edge];
    const Index far_edge = result.new_edge = surface.num_edges();
    surface.length[near_edge] /= 2;
    surface.length.push_back(surface.length[near_edge]);
    surface.edge_half.push_back(no_index);

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
    auto halves = cut_face(surface, half_edge, middle, near_edge, far_edge);
    std::array<Index, 4> changed{face, result.side[0].new_face, face, face};
    if (twin != no_index) {
        result.side[1] = {twin, surface.num_faces()};
        changed[2] = Surface::face(twin);
        changed[3] = result.side[1].new_face;
        const std::array others = cut_face(surface, twin, middle, far_edge, near_edge);
        for (Index& half : halves) {  // The second cut moves them where it meets the same face.
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

}  // namespace agvd::detail
