#include "agvd/mesh/scale.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "agvd/core/parallel.h"

namespace agvd {

namespace {

// Bits of the coordinates that the shape of a mesh needs, beyond its distance from the origin.
constexpr int least_bits = 10;
// Scans have vertices beyond this where a program wrote memory that it had not set. With a higher
// bound a run on few faces may take very long.
constexpr double most_spread = 1e10;
// Around a longer tube of needles, thousands of paths are equally long up to rounding.
constexpr double least_width = 3e-11;

}  // namespace

// Halves, as the difference may overflow.
double MeshBox::longest_side() const {
    constexpr double most = std::numeric_limits<double>::max();
    return is_empty() ? 0 : std::min(most, 2 * (high / 2 - low / 2).maxCoeff());
}

MeshBox box_of(const MeshView& mesh, int num_threads) {
    // Faces may name vertices all over the memory: their bytes fit into the cache, positions may
    // not.
    std::vector<std::uint8_t> is_used(mesh.positions.size(), 0);
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            if (v < is_used.size()) is_used[v] = 1;
        }
    }
    const auto num_vertices = static_cast<Index>(mesh.positions.size());
    std::vector<MeshBox> boxes(num_chunks(num_vertices, pass_grain));
    const auto measure = [&](Index chunk, Index begin, Index end) {
        for (Index v = begin; v < end; ++v) {
            if (is_used[v] == 0 || !mesh.positions[v].allFinite()) continue;
            boxes[chunk].add(mesh.positions[v]);
        }
    };
    parallel_chunks(num_vertices, pass_grain, num_threads, measure);
    MeshBox whole;
    for (const MeshBox& box : boxes) whole.add(box);
    return whole;
}

bool is_in_scale(double longest_side) {
    return longest_side == 0 || (longest_side >= std::ldexp(1.0, -max_scale) &&
                                 longest_side <= std::ldexp(1.0, max_scale));
}

void check_scale(const MeshBox& box) {
    const double side = box.longest_side();
    if (is_in_scale(side)) return;
    throw InvalidInput("the mesh is " + number_text(side) + " long; scale it to a length between " +
                       number_text(std::ldexp(1.0, -max_scale)) + " and " +
                       number_text(std::ldexp(1.0, max_scale)));
}

void check_digits(const MeshBox& box) {
    if (box.longest_side() == 0) return;
    const double farthest = std::max(box.high.maxCoeff(), -box.low.minCoeff());
    constexpr int most_lost = std::numeric_limits<double>::digits - least_bits;
    if (box.longest_side() >= std::ldexp(farthest, -most_lost)) return;
    throw InvalidInput(
        "the mesh is " + number_text(box.longest_side()) + " long, but lies " +
        number_text(farthest) +
        " from the origin, so that its coordinates have too few digits for its shape; move it to "
        "the origin before you save it");
}

void check_spread(const MeshView& mesh, const MeshBox& box) {
    // Some of the vertices tell where most of them are.
    constexpr std::size_t most_looked_at = 1000, fewest_looked_at = 8;
    std::vector<Vec3> some;
    const std::size_t stride = mesh.positions.size() / most_looked_at + 1;
    for (std::size_t v = 0; v < mesh.positions.size(); v += stride) {
        if (mesh.positions[v].allFinite()) some.push_back(mesh.positions[v]);
    }
    if (some.size() < fewest_looked_at) return;
    Vec3 middle;
    std::vector<double> sorted(some.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(some.begin(), some.end(), sorted.begin(),
                       [&](const Vec3& p) { return p[axis]; });
        std::sort(sorted.begin(), sorted.end());
        middle[axis] = sorted[sorted.size() / 2];
    }
    const auto distance = [&](const Vec3& p) { return (p - middle).lpNorm<Eigen::Infinity>(); };
    std::transform(some.begin(), some.end(), sorted.begin(), distance);
    std::sort(sorted.begin(), sorted.end());
    const double most = sorted[sorted.size() * 3 / 4];
    if (!(box.longest_side() > most_spread * most) || most == 0) return;
    std::size_t farthest = mesh.triangles.front()[0];
    for (const Triangle& t : mesh.triangles) {
        for (const Index v : t) {
            if (distance(mesh.positions[v]) > distance(mesh.positions[farthest])) farthest = v;
        }
    }
    throw InvalidInput(
        "vertex " + std::to_string(farthest) + " is " +
        number_text(distance(mesh.positions[farthest]) / most) +
        " times as far from the middle of the mesh as three quarters of its vertices; correct its "
        "coordinates, or remove its faces");
}

void check_width(const MeshView& mesh, Ticker& ticker) {
    double area = 0, area_of_needles = 0;
    std::size_t longest_needle = 0;
    double longest = 0;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        const auto& [a, b, c] = mesh.triangles[f];
        const Vec3 u = mesh.positions[b] - mesh.positions[a];
        const Vec3 v = mesh.positions[c] - mesh.positions[a];
        const double doubled = u.cross(v).norm();
        const double length = std::max({u.norm(), v.norm(), (u - v).norm()});
        area += doubled / 2;
        if (!(doubled < least_width * length * length)) continue;
        area_of_needles += doubled / 2;
        if (length <= longest) continue;
        longest = length;
        longest_needle = f;
    }
    if (!(area_of_needles > area / 2)) return;
    throw InvalidInput("most of the surface consists of needles, such as face " +
                       std::to_string(longest_needle) + ", which is narrower than " +
                       number_text(least_width) +
                       " of its length; correct the coordinates of its corners, or remove such "
                       "faces");
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
