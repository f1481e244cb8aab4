// Inserts a vertex into a face, and removes vertices that have become simple: inner ones with three
// faces, boundary ones with two or with one. Each operation updates corners, twins, edges, lengths
// and charts of the few faces that it touches. What is removed leaves gaps in the arrays.
#include "agvd/intrinsic/vertex_operations.h"

#include <algorithm>
#include <cmath>

#include "agvd/intrinsic/face_operations.h"
#include "agvd/intrinsic/face_sides.h"

namespace agvd::detail {
namespace {

// Twice the area by Heron's formula, in Kahan's order of operations; 0 where there is no triangle.
double doubled_area(double a, double b, double c) {
    if (a < b) std::swap(a, b);
    if (b < c) std::swap(b, c);
    if (a < b) std::swap(a, b);
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return product > 0 ? std::sqrt(product) / 2 : 0;
}

// \return the number of the first one.
Index add_faces(Surface& surface, Index count) {
    const Index first = surface.num_faces();
    surface.mesh.triangles.resize(first + count);
    surface.twin.resize(surface.twin.size() + 3 * count, no_index);
    surface.edge.resize(surface.edge.size() + 3 * count, no_index);
    surface.apex.resize(surface.apex.size() + 3 * count);
    return first;
}

}  // namespace

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
    const Vec2 place = where[1] * corner[1] + where[2] * corner[2];

    forget_outgoing(surface, std::span(&face, 1));
    const Index added = add_faces(surface, 2);
    const std::array<Index, 3> faces{face, added, added + 1};
    move_sides<3>(surface, sides, {3 * faces[0], 3 * faces[1], 3 * faces[2]});
    const double least = least_length * longest_side(surface, face);
    for (Index k = 0; k < 3; ++k) {
        surface.mesh.triangles[faces[k]] = {corners[k], corners[(k + 1) % 3], vertex};
        const Index spoke = surface.num_edges();  // From corner k + 1.
        surface.length.push_back(std::max((place - corner[(k + 1) % 3]).norm(), least));
        surface.edge_half.push_back(no_index);
        surface.edge[3 * faces[(k + 1) % 3] + 2] = spoke;
        join(surface, 3 * faces[k] + 1, 3 * faces[(k + 1) % 3] + 2, spoke);
    }
    for (Index k = 0; k < 3; ++k) {
        const FaceChart part{
            {whole.side[k], place - corner[(k + 1) % 3], corner[k] - place},
            {whole.turn[k], Vec2(1, 0), Vec2(1, 0)},
        };
        if (k == 0) {
            charts.of(face) = part;
        } else {
            charts.add(faces[k], part);
        }
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
