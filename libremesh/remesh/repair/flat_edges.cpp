#include "remesh/repair/flat_edges.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "agvd/core/poller.h"
#include "remesh/dual/flippable_mesh.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;

constexpr double flatness = 1e-6;  // Of the length allowed: how far a flip may move the surface.
constexpr double rounding = 1e-9;  // Of the sine of two angles.
constexpr Index most_flips = 64;   // Per edge; Lawson's flips may take as many as there are edges.

bool has_long_edge(const TriangleMesh& mesh, const agvd::Triangle& t, double max_length) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 side = mesh.positions[t[k]] - mesh.positions[t[(k + 1) % 3]];
        if (side.squaredNorm() > max_length * max_length) return true;
    }
    return false;
}

// Two triangles a b c and b a d, and what they would be: a d c and d b c.
struct Quad {
    Vec3 a, b, c, d;

    // Lawson: the angles at c and d sum to pi at most. On a circle, as the fans of round caps have
    // it, the shorter diagonal is better.
    [[nodiscard]] bool is_delaunay() const {
        const double cos_c = (a - c).dot(b - c), sin_c = (a - c).cross(b - c).norm();
        const double cos_d = (a - d).dot(b - d), sin_d = (a - d).cross(b - d).norm();
        const double lengths = (a - c).norm() * (b - c).norm() * (a - d).norm() * (b - d).norm();
        const double sine = cos_c * sin_d + sin_c * cos_d;
        if (std::abs(sine) > rounding * lengths) return sine > 0;
        return (a - b).norm() <= (1 + rounding) * (c - d).norm();
    }
    // The diagonals meet, up to `gap`.
    [[nodiscard]] bool is_flat(double gap) const {
        const Vec3 normal = (b - a).cross(d - c);
        return std::abs((c - a).dot(normal)) <= gap * normal.norm();
    }
    [[nodiscard]] bool is_convex() const {
        const Vec3 normal = (b - a).cross(c - a) + (a - b).cross(d - b);
        return (d - a).cross(c - a).dot(normal) > 0 && (b - d).cross(c - d).dot(normal) > 0;
    }
};

}  // namespace

Index flip_flat_edges(TriangleMesh& mesh, double max_length, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    std::vector<Index> long_triangles;
    for (Index t = 0; t < mesh.triangles.size(); ++t) {
        ticker.tick();
        if (has_long_edge(mesh, mesh.triangles[t], max_length)) long_triangles.push_back(t);
    }
    if (long_triangles.empty()) return 0;

    FlippableMesh flippable(mesh.triangles, ticker);
    std::vector<bool> waits(flippable.num_edges(), false);
    for (const Index t : long_triangles) {
        for (Index h = 3 * t; h < 3 * t + 3; ++h) waits[flippable.edge(h)] = true;
    }
    std::vector<Index> waiting;
    for (Index edge = flippable.num_edges(); edge-- > 0;) {
        if (waits[edge]) waiting.push_back(edge);
    }
    Index num_flips = 0;
    while (!waiting.empty() && num_flips / most_flips < flippable.num_edges()) {
        ticker.tick(4);
        const Index edge = waiting.back();
        waiting.pop_back();
        waits[edge] = false;
        if (!flippable.can_flip(edge)) continue;
        const auto [h, g] = flippable.sides(edge);
        const agvd::Triangle& first = flippable.triangles()[h / 3];
        const agvd::Triangle& second = flippable.triangles()[g / 3];
        if (!has_long_edge(mesh, first, max_length) && !has_long_edge(mesh, second, max_length)) {
            continue;
        }
        const auto at = [&](Index half_edge) { return mesh.positions[flippable.tail(half_edge)]; };
        const Quad quad{at(h), at(g), at(FlippableMesh::previous(h)),
                        at(FlippableMesh::previous(g))};
        if (quad.is_delaunay() || !quad.is_flat(flatness * max_length) || !quad.is_convex()) {
            continue;
        }
        for (const Index half_edge : {h, g}) {
            for (const Index rim :
                 {FlippableMesh::next(half_edge), FlippableMesh::previous(half_edge)}) {
                const Index neighbour = flippable.edge(rim);
                if (waits[neighbour]) continue;
                waits[neighbour] = true;
                waiting.push_back(neighbour);
            }
        }
        flippable.flip(edge);
        ++num_flips;
    }
    mesh.triangles = flippable.triangles();
    return num_flips;
}

}  // namespace remesh
