#include "bench/torus.h"

#include <cmath>
#include <numbers>
#include <string>

#include "agvd/core/error.h"

namespace bench {

using agvd::Index;

agvd::TriangleMesh bumpy_torus(Index max_faces) {
    const auto k = static_cast<Index>(std::sqrt(max_faces / 4.0));
    if (k < 3) {
        throw agvd::InvalidOption("a torus cannot have " + std::to_string(max_faces) +
                                  " faces; use 36 or more");
    }
    agvd::TriangleMesh mesh;
    mesh.positions.reserve(2 * k * k);
    mesh.triangles.reserve(4 * k * k);
    constexpr double tube = 0.4, bump = 0.1;
    const auto vertex = [k](Index i, Index j) { return i % (2 * k) * k + j % k; };
    for (Index i = 0; i < 2 * k; ++i) {
        const double u = std::numbers::pi * i / k;
        for (Index j = 0; j < k; ++j) {
            const double v = 2 * std::numbers::pi * j / k;
            const double radius = tube * (1 + bump * std::sin(9 * u) * std::sin(5 * v));
            const double reach = 1 + radius * std::cos(v);
            mesh.positions.emplace_back(reach * std::cos(u), reach * std::sin(u),
                                        radius * std::sin(v));
            const Index here = vertex(i, j), across = vertex(i + 1, j + 1);
            mesh.triangles.push_back({here, vertex(i + 1, j), across});
            mesh.triangles.push_back({here, across, vertex(i, j + 1)});
        }
    }
    return mesh;
}

}  // namespace bench
