// The unit cube under five triangulations. All have the same surface, so that differences in time
// and result come from the shape of the triangles alone: right triangles, needles of two aspects,
// random flips, and faces without area.
#include "bench/coplanar_boxes.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "agvd/core/random.h"
#include "agvd/core/types.h"

namespace bench {
namespace {

using namespace agvd;

constexpr Index squares = 41;          // Along an edge of the regular box.
constexpr Index points_around = 5000;  // Of a box of needles.
constexpr Index num_random_flips = 400'000;

TriangleMesh regular_box() {
    TriangleMesh mesh;
    std::map<std::array<Index, 3>, Index> number;
    const auto vertex = [&](const std::array<Index, 3>& at) {
        const auto [found, is_new] = number.try_emplace(at, static_cast<Index>(number.size()));
        if (is_new) mesh.positions.push_back(Vec3(at[0], at[1], at[2]) / squares);
        return found->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool is_far : {false, true}) {
            for (Index i = 0; i < squares; ++i) {
                for (Index j = 0; j < squares; ++j) {
                    const auto at = [&](Index u, Index v) {
                        std::array<Index, 3> p{};
                        p[axis] = is_far ? squares : 0;
                        p[(axis + 1) % 3] = i + u;
                        p[(axis + 2) % 3] = j + v;
                        return vertex(p);
                    };
                    const Index a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (is_far) {
                        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
                    } else {
                        mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
                    }
                }
            }
        }
    }
    return mesh;
}

// A point of the unit square's boundary; corners at 0, 1, 2, 3.
Vec3 on_square(double along, double height) {
    const double rest = along - std::floor(along);
    switch (static_cast<int>(along) % 4) {
        case 0:
            return {rest, 0, height};
        case 1:
            return {1, rest, height};
        case 2:
            return {1 - rest, 1, height};
        default:
            return {0, 1 - rest, height};
    }
}

// Needles from the bottom to the top between points around it, and across both squares.
// \param along  ascending, 0, 1, 2 and 3 among them.
TriangleMesh needle_box(const std::vector<double>& along) {
    TriangleMesh mesh;
    const auto n = static_cast<Index>(along.size());
    for (const double height : {0.0, 1.0}) {
        for (const double a : along) mesh.positions.push_back(on_square(a, height));
    }
    for (Index i = 0; i < n; ++i) {
        const Index j = (i + 1) % n;
        mesh.triangles.insert(mesh.triangles.end(), {{i, j, n + j}, {i, n + j, n + i}});
    }
    const auto half =
        static_cast<Index>(std::lower_bound(along.begin(), along.end(), 2.0) - along.begin());
    // A zigzag between the two ways from corner 0 to corner 2. Three points of one side are
    // avoided.
    Index left = 0, right = n - 1;
    while (left + 1 < half || right > half + 1) {
        const bool goes_left =
            left == 0 ||
            (left + 1 < half && (right == half + 1 || along[left + 1] <= 4 - along[right - 1]));
        const Index a = left, b = right;
        const Index c = goes_left ? ++left : --right;
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {n + a, n + c, n + b}});
    }
    mesh.triangles.insert(mesh.triangles.end(),
                          {{left, right, half}, {n + left, n + half, n + right}});
    return mesh;
}

std::vector<double> evenly_around() {
    std::vector<double> along;
    for (Index i = 0; i < points_around; ++i) along.push_back(4.0 * i / points_around);
    return along;
}

// Bundles of points 1e-6 apart.
std::vector<double> bundles_around() {
    constexpr Index bundle = 100;
    std::vector<double> along;
    for (Index i = 0; i < points_around; ++i) {
        along.push_back(4.0 * (i / bundle) / (points_around / bundle) + 1e-6 * (i % bundle));
    }
    for (const double corner : {1.0, 2.0, 3.0}) along.push_back(corner);
    std::sort(along.begin(), along.end());
    along.erase(std::unique(along.begin(), along.end()), along.end());
    return along;
}

// Flips between coplanar triangles with a convex quad, as they come.
TriangleMesh randomly_flipped(TriangleMesh mesh) {
    std::map<std::pair<Index, Index>, Index> half_edge;
    const auto tail = [&](Index h) { return mesh.triangles[h / 3][h % 3]; };
    const auto enter = [&](Index f) {
        for (Index h = 3 * f; h < 3 * f + 3; ++h) half_edge[{tail(h), tail(next_half_edge(h))}] = h;
    };
    for (Index f = 0; f < mesh.triangles.size(); ++f) enter(f);
    const auto& p = mesh.positions;
    const auto normal = [&](Index a, Index b, Index c) { return (p[b] - p[a]).cross(p[c] - p[a]); };
    for (Index i = 0; i < num_random_flips; ++i) {
        const auto h = static_cast<Index>(random_unit(1, 0, i) *
                                          static_cast<double>(3 * mesh.triangles.size()));
        const Index a = tail(h), b = tail(next_half_edge(h)), c = tail(previous_half_edge(h));
        const Index g = half_edge.at({b, a});
        const Index d = tail(previous_half_edge(g));
        const Vec3 whole = normal(a, b, c).normalized();
        constexpr double least = 1e-9;  // Of the unit square: neither degenerate nor bent.
        if (normal(b, a, d).normalized().dot(whole) < 1 - least) continue;
        if (normal(a, d, c).dot(whole) < least || normal(d, b, c).dot(whole) < least) continue;
        if (half_edge.contains({c, d}) || half_edge.contains({d, c})) continue;
        half_edge.erase({a, b});
        half_edge.erase({b, a});
        mesh.triangles[h / 3] = {a, d, c};
        mesh.triangles[g / 3] = {d, b, c};
        enter(h / 3);
        enter(g / 3);
    }
    return mesh;
}

// Every tenth face gets the middle of its first side, its neighbour does not: between the two lies
// a face without area.
TriangleMesh with_degenerate_faces(TriangleMesh mesh) {
    const auto num_faces = static_cast<Index>(mesh.triangles.size());
    for (Index f = 0; f < num_faces; f += 10) {
        const auto [a, b, c] = mesh.triangles[f];
        const auto middle = static_cast<Index>(mesh.positions.size());
        mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
        mesh.triangles[f] = {a, middle, c};
        mesh.triangles.insert(mesh.triangles.end(), {{middle, b, c}, {a, b, middle}});
    }
    return mesh;
}

}  // namespace

std::vector<NamedMesh> coplanar_boxes() {
    const TriangleMesh regular = regular_box();
    return {{"right triangles", regular},
            {"needles, 1e-3", needle_box(evenly_around())},
            {"needles, 1e-6", needle_box(bundles_around())},
            {"random flips", randomly_flipped(regular)},
            {"faces without area", with_degenerate_faces(regular)}};
}

}  // namespace bench
