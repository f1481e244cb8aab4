// How far positions move where a format stores them in single precision, as STL does. Coordinates
// far from the origin, such as those of maps, lose the digits that tell their vertices apart.

#include <algorithm>
#include <cstdio>
#include <limits>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/point_welder.h"
#include "remesh/meshfile/write_mesh.h"

namespace remesh {
namespace {

constexpr double share_of_edge = 0.05;
constexpr double share_of_diagonal = 1e-6;

// Number by number: g++ 12 drops both conversions from p.cast<float>().cast<double>() at -O3.
Vec3 rounded(const Vec3& p) {
    Vec3 q;
    for (int k = 0; k < 3; ++k) q[k] = static_cast<float>(p[k]);
    return q;
}

void measure_shifts(const MeshView& mesh, Ticker& ticker, RoundingLoss& loss) {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
    PointWelder before, after;
    for (const Vec3& p : mesh.positions) {
        ticker.tick(4);
        const Vec3 q = rounded(p);
        loss.largest_shift = std::max(loss.largest_shift, (q - p).norm());
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        before.index_of(p);
        after.index_of(q);
    }
    loss.diagonal = (high - low).norm();
    loss.middle = low + (high - low) / 2;
    loss.merged = static_cast<Index>(before.points().size() - after.points().size());
}

double shortest_edge(const MeshView& mesh, Ticker& ticker) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : mesh.triangles) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[triangle[k]];
            const double length = (mesh.positions[triangle[(k + 1) % 3]] - p).norm();
            if (length > 0) shortest = std::min(shortest, length);
        }
    }
    return shortest < std::numeric_limits<double>::infinity() ? shortest : 0;
}

// Three digits.
std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

bool RoundingLoss::matters() const {
    return merged > 0 || largest_shift > share_of_edge * shortest_edge ||
           largest_shift > share_of_diagonal * diagonal;
}

RoundingLoss rounding_loss(const MeshPath& path, const MeshView& mesh, const Progress& progress) {
    RoundingLoss loss;
    if (!require_format(path).is_single() || mesh.positions.empty()) return loss;
    Poller poller(progress);
    Ticker ticker(poller);
    measure_shifts(mesh, ticker, loss);
    loss.shortest_edge = shortest_edge(mesh, ticker);
    return loss;
}

std::string describe(const RoundingLoss& loss, const MeshPath& path) {
    if (loss.largest_shift == 0 || !loss.matters()) return {};
    const auto percent_of = [&](double length) {
        return short_number(100 * loss.largest_shift / length) + " %";
    };
    std::string text = path.path.string() + ": " + require_format(path).name +
                       " stores coordinates in single precision: vertices move by up to " +
                       short_number(loss.largest_shift) + ", " + percent_of(loss.diagonal) +
                       " of the diagonal";
    if (loss.shortest_edge > 0) {
        text += " and " + percent_of(loss.shortest_edge) + " of the shortest edge";
    }
    if (loss.merged > 0) text += ", and " + std::to_string(loss.merged) + " fall onto others";
    const Vec3& m = loss.middle;
    return text +
           "; write .ply, .obj or .off, or move the mesh to the origin first (its middle is at " +
           short_number(m.x()) + " " + short_number(m.y()) + " " + short_number(m.z()) + ")";
}

}  // namespace remesh
