// Surfaces with few coarse faces, such as tubes of three sides, cones and doubled triangles, whose
// intrinsic Delaunay triangulation has loops, repeated edges and self-glued faces. Needles are made
// by splitting coarse faces at points near a side and flipping edges within them, which leaves the
// surface as it is.
#include "support/delta_shapes.h"

#include <array>
#include <map>
#include <numbers>

#include "support/dice.h"
#include "support/shapes.h"

namespace delta_shapes {
namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr std::array names{"plane_needles",    "finer_needles",     "prism_tube", "delta_cone",
                           "doubled_triangle", "delta_tetrahedron", "spike",      "delta_strip"};

// Where each face lies: flips stay within one of the coarse ones.
struct Pieces {
    TriangleMesh mesh;
    std::vector<Index> plane;  // By face.
};

Vec3 normal_of(const TriangleMesh& mesh, const Triangle& t) {
    const auto& p = mesh.positions;
    return (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

// Splits a face into three, at a point near a side.
void split_face(Pieces& pieces, Index face, double beside, Dice& dice) {
    const Triangle t = pieces.mesh.triangles[face];
    const Index k = dice.count(0, 2);
    const Index a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    const double along = dice.number(0.2, 0.8);
    auto& p = pieces.mesh.positions;
    const Vec3 middle = (1 - along) * p[a] + along * p[b];
    const auto m = static_cast<Index>(p.size());
    p.emplace_back(middle + beside * (p[c] - middle));
    pieces.mesh.triangles[face] = {a, b, m};
    for (const Triangle& added : {Triangle{b, c, m}, Triangle{c, a, m}}) {
        pieces.mesh.triangles.push_back(added);
        pieces.plane.push_back(pieces.plane[face]);
    }
}

// Flips edges if both new faces are oriented like the old ones and the new edge does not exist yet.
void flip_some(Pieces& pieces, Index count, Dice& dice) {
    auto& faces = pieces.mesh.triangles;
    const auto num_faces = static_cast<Index>(faces.size());
    std::map<std::pair<Index, Index>, Index> half_edge;
    for (Index h = 0; h < 3 * num_faces; ++h) {
        half_edge[{faces[h / 3][h % 3], faces[h / 3][(h + 1) % 3]}] = h;
    }
    for (Index i = 0; i < count; ++i) {
        const Index h = dice.count(0, 3 * num_faces - 1);
        const Triangle f = faces[h / 3];
        const Index a = f[h % 3], b = f[(h + 1) % 3], c = f[(h + 2) % 3];
        const auto twin = half_edge.find({b, a});
        if (twin == half_edge.end()) continue;
        const Index g = twin->second / 3;
        if (pieces.plane[g] != pieces.plane[h / 3]) continue;
        const Index d = faces[g][(twin->second + 2) % 3];
        if (half_edge.contains({c, d}) || half_edge.contains({d, c})) continue;
        const Vec3 normal = normal_of(pieces.mesh, f) + normal_of(pieces.mesh, faces[g]);
        const Triangle first{a, d, c}, second{d, b, c};
        const double least = 1e-7 * normal.squaredNorm();
        if (normal_of(pieces.mesh, first).dot(normal) < least ||
            normal_of(pieces.mesh, second).dot(normal) < least) {
            continue;
        }
        half_edge.erase({a, b});
        half_edge.erase({b, a});
        faces[h / 3] = first;
        faces[g] = second;
        for (const Index face : {h / 3, g}) {
            for (Index k = 0; k < 3; ++k) {
                half_edge[{faces[face][k], faces[face][(k + 1) % 3]}] = 3 * face + k;
            }
        }
    }
}

TriangleMesh needles(const TriangleMesh& coarse, double aspect, Dice& dice) {
    Pieces pieces{coarse, {}};
    for (Index f = 0; f < coarse.triangles.size(); ++f) pieces.plane.push_back(f);
    const Index count = dice.count(3, 20);
    for (Index i = 0; i < count; ++i) {
        const auto num_faces = static_cast<Index>(pieces.mesh.triangles.size());
        const Index face = dice.count(0, num_faces - 1);
        if (normal_of(pieces.mesh, pieces.mesh.triangles[face]).norm() < 0.02) continue;
        split_face(pieces, face, aspect * dice.number(1, 3), dice);
    }
    flip_some(pieces, 50, dice);
    return pieces.mesh;
}

// A ring of points around the z axis.
void add_ring(TriangleMesh& mesh, Index sides, double radius, double z, Dice& dice) {
    for (Index k = 0; k < sides; ++k) {
        const double angle = 2 * std::numbers::pi * (k + dice.number(-0.2, 0.2)) / sides;
        mesh.positions.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
}

TriangleMesh prism_tube(Dice& dice) {
    TriangleMesh mesh;
    add_ring(mesh, 3, 1, 0, dice);
    add_ring(mesh, 3, dice.number(0.3, 1), dice.magnitude(0.1, 20), dice);
    for (Index k = 0; k < 3; ++k) {
        const Index next = (k + 1) % 3;
        mesh.triangles.push_back({k, next, 3 + next});
        mesh.triangles.push_back({k, 3 + next, 3 + k});
    }
    return mesh;
}

TriangleMesh cone(Index sides, double height, bool is_closed, Dice& dice) {
    TriangleMesh mesh;
    add_ring(mesh, sides, 1, 0, dice);
    mesh.positions.emplace_back(0.1, -0.05, height);
    if (is_closed) mesh.positions.emplace_back(0.03, 0.1, -0.3 * height);
    for (Index k = 0; k < sides; ++k) {
        const Index next = (k + 1) % sides;
        mesh.triangles.push_back({k, next, sides});
        if (is_closed) mesh.triangles.push_back({next, k, sides + 1});
    }
    return mesh;
}

TriangleMesh doubled_triangle(Dice& dice) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {dice.number(-1, 2), dice.magnitude(0.01, 2), 0}};
    mesh.triangles = {{0, 1, 2}, {1, 0, 2}};
    return mesh;
}

TriangleMesh tetrahedron(Dice& dice) {
    TriangleMesh mesh = shapes::tetrahedron();
    for (Vec3& p : mesh.positions) {
        p += Vec3(dice.number(-0.6, 0.6), dice.number(-0.6, 0.6), dice.number(-0.6, 0.6));
    }
    const double stretch = dice.magnitude(0.1, 30);
    for (Vec3& p : mesh.positions) p.z() *= stretch;
    return mesh;
}

// A long plane strip of long triangles.
TriangleMesh strip(Dice& dice) {
    TriangleMesh mesh;
    const Index count = dice.count(4, 30);
    for (Index i = 0; i < count; ++i) {
        const double width = i % 2 == 0 ? 0 : dice.magnitude(0.01, 1);
        mesh.positions.emplace_back(i * dice.number(0.9, 1.1), width, dice.number(0, 0.1));
    }
    for (Index i = 0; i + 2 < count; ++i) {
        mesh.triangles.push_back(i % 2 == 0 ? Triangle{i, i + 2, i + 1}
                                            : Triangle{i, i + 1, i + 2});
    }
    return mesh;
}

}  // namespace

std::span<const char* const> families() { return names; }

TriangleMesh make(std::string_view family, std::uint64_t seed) {
    Dice dice(seed + 1000 * family.size());
    const auto coarse = [&]() -> TriangleMesh {
        switch (dice.count(0, 2)) {
            case 0:
                return shapes::cube();
            case 1:
                return shapes::icosahedron();
            default:
                return shapes::grid(2);
        }
    };
    if (family == "plane_needles") return needles(coarse(), 1e-3, dice);
    if (family == "finer_needles") return needles(coarse(), 1e-6, dice);
    if (family == "prism_tube") return prism_tube(dice);
    if (family == "delta_cone")
        return cone(dice.count(3, 60), dice.magnitude(0.1, 30), false, dice);
    if (family == "spike") return cone(dice.count(3, 8), dice.magnitude(2, 50), true, dice);
    if (family == "doubled_triangle") return doubled_triangle(dice);
    if (family == "delta_tetrahedron") return tetrahedron(dice);
    return strip(dice);
}

}  // namespace delta_shapes
