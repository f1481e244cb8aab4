#include "agvd/mesh/scale.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "agvd/core/error.h"

namespace agvd {

namespace {

// Bits of the coordinates that the shape of a mesh needs, beyond its distance from the origin.
constexpr int least_bits = 10;

struct Box {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;

    [[nodiscard]] bool is_empty() const { return low.x() > high.x(); }
    // Halves are subtracted, since the difference may overflow.
    [[nodiscard]] double longest_side() const {
        constexpr double most = std::numeric_limits<double>::max();
        return std::min(most, 2 * (high / 2 - low / 2).maxCoeff());
    }
};

Box box_of(const MeshView& mesh) {
    Box box;
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            if (v >= mesh.positions.size() || !mesh.positions[v].allFinite()) continue;
            box.low = box.low.cwiseMin(mesh.positions[v]);
            box.high = box.high.cwiseMax(mesh.positions[v]);
        }
    }
    return box;
}

}  // namespace

double extent(const MeshView& mesh) {
    const Box box = box_of(mesh);
    return box.is_empty() ? 0 : box.longest_side();
}

bool is_in_scale(double extent) {
    return extent == 0 ||
           (extent >= std::ldexp(1.0, -max_scale) && extent <= std::ldexp(1.0, max_scale));
}

void check_scale(const MeshView& mesh) {
    const double side = extent(mesh);
    if (is_in_scale(side)) return;
    std::ostringstream text;
    text << "the mesh is " << side << " long; scale it to a length between "
         << std::ldexp(1.0, -max_scale) << " and " << std::ldexp(1.0, max_scale);
    throw InvalidInput(text.str());
}

void check_digits(const MeshView& mesh) {
    const Box box = box_of(mesh);
    if (box.is_empty() || box.longest_side() == 0) return;
    const double farthest = std::max(box.high.maxCoeff(), -box.low.minCoeff());
    constexpr int most_lost = std::numeric_limits<double>::digits - least_bits;
    if (box.longest_side() >= std::ldexp(farthest, -most_lost)) return;
    std::ostringstream text;
    text << "the mesh is " << box.longest_side() << " long, but lies " << farthest
         << " from the origin: its coordinates have no digits left for its shape; move it to the "
            "origin before it is saved";
    throw InvalidInput(text.str());
}

TriangleMesh scaled(const MeshView& mesh, int exponent) {
    TriangleMesh result{{mesh.positions.begin(), mesh.positions.end()},
                        {mesh.triangles.begin(), mesh.triangles.end()}};
    for (Vec3& p : result.positions) {
        p = p.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    }
    return result;
}

}  // namespace agvd
