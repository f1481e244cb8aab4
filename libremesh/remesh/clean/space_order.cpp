#include "remesh/clean/space_order.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

#include "agvd/core/bucket_sort.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"

namespace remesh::detail {
namespace {

constexpr int bits = 16;  // Of each coordinate.

// Puts two zeros before each bit.
std::uint64_t spread(std::uint64_t number) {
    std::uint64_t result = 0;
    for (int bit = 0; bit < bits; ++bit) result |= (number >> bit & 1) << (3 * bit);
    return result;
}

// The mean difference of the numbers of a face's corners.
double mean_apart(const std::vector<Triangle>& triangles, Ticker& ticker) {
    double sum = 0;
    for_each_ticked(triangles, ticker, [&](const Triangle& t) {
        const auto [least, most] = std::minmax({t[0], t[1], t[2]});
        sum += most - least;
    });
    return sum / static_cast<double>(triangles.size());
}

// By their lowest corners.
std::vector<Index> order_of_faces(const std::vector<Triangle>& triangles, Index num_vertices,
                                  Ticker ticker) {
    std::vector<std::pair<Index, Index>> faces;  // (lowest corner, face)
    faces.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        faces.emplace_back(std::min({t[0], t[1], t[2]}), static_cast<Index>(faces.size()));
    }
    faces = sort_in_buckets(
        faces, num_vertices, [](const auto& face) { return face.first; }, std::less<>(), ticker);
    std::vector<Index> order;
    order.reserve(faces.size());
    for (const auto& [corner, face] : faces) order.push_back(face);
    return order;
}

}  // namespace

std::vector<Index> order_in_space(std::span<const Vec3> points, Ticker ticker) {
    MeshBox box;
    for (const Vec3& point : points) box.add(point);
    const double side = points.empty() ? 0 : (box.high - box.low).maxCoeff();
    const double scale = side > 0 ? ((1 << bits) - 1) / side : 0;
    std::vector<std::pair<std::uint64_t, Index>> codes;
    codes.reserve(points.size());
    for_each_ticked(points, ticker, [&](const Vec3& point) {
        const Vec3 at = scale * (point - box.low);
        const auto along = [&](int axis) { return spread(static_cast<std::uint64_t>(at[axis])); };
        codes.emplace_back(along(0) | along(1) << 1 | along(2) << 2,
                           static_cast<Index>(codes.size()));
    });
    sort_ticked(codes, ticker, std::less<>());
    std::vector<Index> order;
    order.reserve(codes.size());
    for (const auto& [code, i] : codes) order.push_back(i);
    return order;
}

bool order_in_space(CleanResult& clean, Ticker ticker, double most_apart) {
    TriangleMesh& mesh = clean.mesh;
    if (mean_apart(mesh.triangles, ticker) <= most_apart) return false;
    const std::vector<Index> vertices = order_in_space(mesh.positions, ticker);
    mesh.positions = take(mesh.positions, vertices);
    mesh.triangles = rename_vertices(mesh.triangles, places_in(vertices));
    const std::vector<Index> faces =
        order_of_faces(mesh.triangles, static_cast<Index>(vertices.size()), ticker);
    mesh.triangles = take(mesh.triangles, faces);
    clean.vertex_origin = take(clean.vertex_origin, vertices);
    clean.face_origin = take(clean.face_origin, faces);
    if (clean.connectivity.twin.empty()) return true;
    const std::vector<Index> new_face = places_in(faces);
    const auto renamed = [&](Index h) {
        return h == no_index ? no_index : 3 * new_face[h / 3] + h % 3;
    };
    const Connectivity before = std::move(clean.connectivity);
    clean.connectivity = {};
    clean.connectivity.twin.reserve(before.twin.size());
    for_each_ticked(faces, ticker, [&](Index f) {
        for (Index k = 0; k < 3; ++k) {
            clean.connectivity.twin.push_back(renamed(before.twin[3 * f + k]));
        }
    });
    for (const Index v : vertices)
        clean.connectivity.outgoing.push_back(renamed(before.outgoing[v]));
    return true;
}

}  // namespace remesh::detail
