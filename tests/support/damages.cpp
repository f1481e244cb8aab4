// Each kind draws how much it does, over several magnitudes, and where: at faces one by one, or
// everywhere in a ball.
#include "support/damages.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "support/dirty_shapes.h"
#include "support/shapes.h"

namespace damages {

namespace {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec3;

Index num_faces(const TriangleMesh& mesh) { return static_cast<Index>(mesh.triangles.size()); }

Index any_vertex(const TriangleMesh& mesh, Dice& dice) {
    return dice.count(0, static_cast<Index>(mesh.positions.size()) - 1);
}

Index any_face(const TriangleMesh& mesh, Dice& dice) { return dice.count(0, num_faces(mesh) - 1); }

Index add_vertex(TriangleMesh& mesh, const Vec3& position) {
    mesh.positions.push_back(position);
    return static_cast<Index>(mesh.positions.size() - 1);
}

// Diagonal of the bounding box of what the faces use; 1 if that is a point.
double size_of(const TriangleMesh& mesh) {
    Eigen::AlignedBox3d box;
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) box.extend(mesh.positions[v]);
    }
    // Without squares, which may overflow.
    const double longest = box.sizes().maxCoeff();
    return longest > 0 ? longest * (box.sizes() / longest).norm() : 1;
}

// Of a typical face.
double edge_length(const TriangleMesh& mesh) {
    return size_of(mesh) / std::sqrt(static_cast<double>(num_faces(mesh)));
}

Vec3 any_direction(Dice& dice) {
    Vec3 direction = Vec3::Zero();
    while (direction.squaredNorm() < 1e-3) {
        for (int k = 0; k < 3; ++k) direction[k] = dice.number(-1, 1);
    }
    return direction.normalized();
}

// Per vertex the sum of the normals of its faces, of length 1 or 0.
std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
    const double scale = 1 / size_of(mesh);
    std::vector<Vec3> normals(mesh.positions.size(), Vec3::Zero());
    for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 u = scale * (mesh.positions[b] - mesh.positions[a]);
        const Vec3 v = scale * (mesh.positions[c] - mesh.positions[a]);
        for (const Index i : {a, b, c}) normals[i] += u.cross(v);
    }
    for (Vec3& normal : normals) normal.normalize();
    return normals;
}

// Faces by themselves: each with the same chance, from one face to the share `most` of all.
std::vector<bool> single_faces(const TriangleMesh& mesh, double most, Dice& dice) {
    const double chance = dice.magnitude(std::min(1.0 / num_faces(mesh), most / 2), most);
    std::vector<bool> chosen(mesh.triangles.size(), false);
    for (std::size_t f = 0; f < chosen.size(); ++f) chosen[f] = dice.number(0, 1) < chance;
    chosen[any_face(mesh, dice)] = true;
    return chosen;
}

// Faces with a corner in one of a few balls.
std::vector<bool> patches(const TriangleMesh& mesh, Dice& dice) {
    std::vector<bool> chosen(mesh.triangles.size(), false);
    const double size = size_of(mesh);
    for (Index left = dice.count(1, 6); left > 0; --left) {
        const Vec3 center = mesh.positions[mesh.triangles[any_face(mesh, dice)][0]];
        const double radius = dice.magnitude(1e-3, 0.3);
        for (std::size_t f = 0; f < chosen.size(); ++f) {
            for (const Index v : mesh.triangles[f]) {
                if (((mesh.positions[v] - center) / size).norm() <= radius) chosen[f] = true;
            }
        }
    }
    return chosen;
}

std::vector<bool> some_faces(const TriangleMesh& mesh, double most, Dice& dice) {
    return dice.one_in(2) ? single_faces(mesh, most, dice) : patches(mesh, dice);
}

TriangleMesh holes(TriangleMesh mesh, Dice& dice) {
    const std::vector<bool> chosen = some_faces(mesh, 0.3, dice);
    std::vector<Triangle> kept;
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        if (!chosen[f]) kept.push_back(mesh.triangles[f]);
    }
    if (!kept.empty()) mesh.triangles = std::move(kept);
    return mesh;
}

TriangleMesh flips(TriangleMesh mesh, Dice& dice) {
    const std::vector<bool> chosen = some_faces(mesh, 1, dice);
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        if (chosen[f]) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
    }
    return mesh;
}

// All or some faces again: the same ones, or with vertices of their own, there or a little aside.
TriangleMesh duplicates(TriangleMesh mesh, Dice& dice) {
    const std::vector<bool> chosen =
        dice.one_in(2) ? std::vector<bool>(mesh.triangles.size(), true) : patches(mesh, dice);
    const bool has_own_vertices = dice.one_in(2);
    const Vec3 shift =
        dice.one_in(2) ? Vec3(Vec3::Zero())
                       : Vec3(dice.magnitude(1e-14, 1e-2) * size_of(mesh) * any_direction(dice));
    const auto count = static_cast<Index>(mesh.positions.size());
    if (has_own_vertices) {
        for (Index v = 0; v < count; ++v) add_vertex(mesh, mesh.positions[v] + shift);
    }
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        if (!chosen[f]) continue;
        Triangle copy = mesh.triangles[f];
        if (has_own_vertices) {
            for (Index& v : copy) v += count;
        }
        mesh.triangles.push_back(copy);
    }
    return mesh;
}

// A second side, turned over, at a small distance; half of them grow together in places.
TriangleMesh walls(TriangleMesh mesh, Dice& dice) {
    const double size = size_of(mesh), offset = dice.magnitude(1e-9, 3e-2) * size;
    const std::vector<Vec3> normals = vertex_normals(mesh);
    std::vector<bool> is_merged(mesh.positions.size(), false);
    if (dice.one_in(2)) {
        const std::vector<bool> merged = patches(mesh, dice);
        for (std::size_t f = 0; f < merged.size(); ++f) {
            if (!merged[f]) continue;
            for (const Index v : mesh.triangles[f]) is_merged[v] = true;
        }
    }
    std::vector<Index> other_side(mesh.positions.size());
    for (Index v = 0; v < other_side.size(); ++v) {
        other_side[v] =
            is_merged[v] ? v : add_vertex(mesh, mesh.positions[v] - offset * normals[v]);
    }
    for (Index f = 0, end = num_faces(mesh); f < end; ++f) {
        const auto [a, b, c] = mesh.triangles[f];
        mesh.triangles.push_back({other_side[a], other_side[c], other_side[b]});
    }
    return mesh;
}

// Corners apart, some moved so little that welding may or may not find them.
TriangleMesh soup(const TriangleMesh& mesh, Dice& dice) {
    TriangleMesh apart = shapes::unweld(mesh);
    if (dice.one_in(3)) return apart;
    const double amount = dice.magnitude(1e-16, 1e-3) * size_of(mesh);
    const double chance = dice.magnitude(1e-3, 1);
    for (Vec3& p : apart.positions) {
        if (dice.number(0, 1) < chance) p += amount * any_direction(dice);
    }
    return apart;
}

TriangleMesh noise(const TriangleMesh& mesh, Dice& dice) {
    const double amount = dice.magnitude(1e-6, 2) * edge_length(mesh);
    return shapes::jitter(mesh, amount, dice.count(0, 1'000'000));
}

// A vertex of some faces moved onto the opposite edge but for a share of its height.
TriangleMesh slivers(TriangleMesh mesh, Dice& dice) {
    const std::vector<bool> chosen = some_faces(mesh, 0.5, dice);
    const double most = dice.magnitude(1e-12, 1e-3);
    for (std::size_t f = 0; f < chosen.size(); ++f) {
        if (!chosen[f]) continue;
        const auto [a, b, c] = mesh.triangles[f];
        const double along = dice.number(0, 1);
        const Vec3 foot = (1 - along) * mesh.positions[b] + along * mesh.positions[c];
        const double height = dice.magnitude(1e-12, 2 * most);
        mesh.positions[a] = foot + height * (mesh.positions[a] - foot);
    }
    return mesh;
}

TriangleMesh scales(TriangleMesh mesh, Dice& dice) {
    Vec3 factors = Vec3::Constant(dice.magnitude(1e-30, 1e30));
    if (dice.one_in(2)) {
        factors.setOnes();
        factors[dice.count(0, 2)] = dice.one_in(4) ? 0 : dice.magnitude(1e-12, 0.1);
    }
    for (Vec3& p : mesh.positions) p = p.cwiseProduct(factors);
    return mesh;
}

TriangleMesh spikes(TriangleMesh mesh, Dice& dice) {
    const double size = size_of(mesh);
    for (Index left = dice.count(1, 5); left > 0; --left) {
        const Index v = mesh.triangles[any_face(mesh, dice)][dice.count(0, 2)];
        mesh.positions[v] += dice.magnitude(10, 1e4) * size * any_direction(dice);
    }
    return mesh;
}

// Tiny components on the surface, beside it or far away.
TriangleMesh specks(TriangleMesh mesh, Dice& dice) {
    const double size = size_of(mesh);
    const double distance = dice.one_in(3) ? 0 : dice.magnitude(1e-6, 1e3);
    for (Index left = dice.count(1, 60); left > 0; --left) {
        TriangleMesh speck = dice.one_in(2) ? shapes::tetrahedron() : shapes::icosahedron();
        const double radius = dice.magnitude(1e-10, 1e-2) * size;
        const Vec3 center =
            mesh.positions[any_vertex(mesh, dice)] + distance * size * any_direction(dice);
        const auto first = static_cast<Index>(mesh.positions.size());
        for (const Vec3& p : speck.positions) add_vertex(mesh, center + radius * p);
        for (Triangle t : speck.triangles) {
            for (Index& v : t) v += first;
            mesh.triangles.push_back(t);
        }
    }
    return mesh;
}

// Faces through existing edges, and vertices that are one.
TriangleMesh sheets(TriangleMesh mesh, Dice& dice) {
    const double length = edge_length(mesh);
    const Index most = std::max<Index>(2, num_faces(mesh) / 20);
    const auto times = static_cast<Index>(dice.magnitude(1, most));
    for (Index i = 0; i < times; ++i) {
        const Triangle t = mesh.triangles[any_face(mesh, dice)];
        if (dice.one_in(2)) {
            const double height = dice.magnitude(0.1, 10) * length;
            const Index tip = add_vertex(mesh, mesh.positions[t[0]] + height * any_direction(dice));
            mesh.triangles.push_back({t[0], t[1], tip});
        } else {
            mesh.triangles[any_face(mesh, dice)][dice.count(0, 2)] = t[0];
        }
    }
    return mesh;
}

constexpr std::array names{"holes",   "flips",  "duplicates", "walls",  "soup",  "noise",
                           "slivers", "scales", "spikes",     "specks", "sheets"};

}  // namespace

std::span<const char* const> kinds() { return names; }

TriangleMesh apply(std::string_view kind, TriangleMesh mesh, Dice& dice) {
    if (kind == "holes") return holes(std::move(mesh), dice);
    if (kind == "flips") return flips(std::move(mesh), dice);
    if (kind == "duplicates") return duplicates(std::move(mesh), dice);
    if (kind == "walls") return walls(std::move(mesh), dice);
    if (kind == "soup") return soup(mesh, dice);
    if (kind == "noise") return noise(mesh, dice);
    if (kind == "slivers") return slivers(std::move(mesh), dice);
    if (kind == "scales") return scales(std::move(mesh), dice);
    if (kind == "spikes") return spikes(std::move(mesh), dice);
    if (kind == "specks") return specks(std::move(mesh), dice);
    if (kind == "sheets") return sheets(std::move(mesh), dice);
    throw std::invalid_argument("no damage of this kind: " + std::string(kind));
}

}  // namespace damages
