// Patches are the cells of random points by labels of the vertices. A patch holds the sums of least
// squares over its pieces; sums of neighbours are added. Notation: x position, n normal, both with
// the area as weight.
#include "remesh/sizing/curvature.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "agvd/core/edge_key.h"
#include "agvd/core/poller.h"
#include "agvd/mesh/uniform_points.h"
#include "agvd/propagation/distance_bounds.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;
using Mat3 = Eigen::Matrix3d;

// Any value works.
constexpr std::uint64_t patch_seed = 0x5eed;
// Added to the variance of the positions, as a share of it: where a patch is flat, its normals say
// nothing about the change across it.
constexpr double least_variance = 0.02;

// By size, of a symmetric matrix; by the trigonometric formula.
double largest_eigenvalue(const Mat3& matrix) {
    const double mean = matrix.trace() / 3;
    const Mat3 rest = matrix - mean * Mat3::Identity();
    const double size = std::sqrt(rest.squaredNorm() / 6);
    if (!(size > 0)) return std::abs(mean);
    const double angle = std::acos(std::clamp((rest / size).determinant() / 2, -1.0, 1.0)) / 3;
    const double most = mean + 2 * size * std::cos(angle);
    const double least = mean + 2 * size * std::cos(angle + 2 * std::numbers::pi / 3);
    return std::max(std::abs(most), std::abs(least));
}

// Positions count from an origin near the patch.
struct PatchSums {
    double area = 0;
    Vec3 x = Vec3::Zero(), n = Vec3::Zero();
    Mat3 xx = Mat3::Zero(), nx = Mat3::Zero();

    void add(const agvd::SurfacePiece& piece, const Vec3& origin, double share) {
        const double weight = share * piece.vector.norm();
        const Vec3 at = piece.position - origin;
        area += weight;
        x += weight * at;
        n += share * piece.vector;
        xx += weight * at * at.transpose();
        nx += share * piece.vector * at.transpose();
    }
    // The sums of another patch, whose origin is at `offset` from this one.
    void add(const PatchSums& other, const Vec3& offset) {
        area += other.area;
        x += other.x + other.area * offset;
        n += other.n;
        xx += other.xx + other.x * offset.transpose() + offset * other.x.transpose() +
              other.area * offset * offset.transpose();
        nx += other.nx + other.n * offset.transpose();
    }

    [[nodiscard]] double curvature() const {
        if (!(area > 0)) return 0;
        Mat3 variance = xx / area - x * x.transpose() / (area * area);
        const Mat3 together = nx / area - n * x.transpose() / (area * area);
        const double spread = variance.trace();
        if (!(spread > 0)) return 0;
        variance += least_variance * spread * Mat3::Identity();
        const Mat3 change = together * variance.inverse();
        return largest_eigenvalue((change + change.transpose()) / 2);
    }
};

// Pairs of patches that share an edge between their vertices, both ways, sorted.
std::vector<std::uint64_t> adjacent_pairs(const agvd::Surface& surface,
                                          const std::vector<Index>& label, agvd::Ticker& ticker) {
    std::vector<std::uint64_t> pairs;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        ticker.tick();
        const Index a = label[surface.tail(h)], b = label[surface.head(h)];
        if (a == b || a == no_index || b == no_index) continue;
        pairs.push_back((std::uint64_t{a} << 32) | b);
        pairs.push_back((std::uint64_t{b} << 32) | a);
    }
    agvd::sort_ticked(pairs, ticker, std::less<>());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace

std::vector<double> largest_curvature(const agvd::IntrinsicTriangulation& base,
                                      const agvd::FacePieces& pieces,
                                      const agvd::SurfaceLayout& layout, Index num_patches,
                                      int num_threads, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    const agvd::Surface& surface = base.surface();
    const std::vector<agvd::SurfacePoint> seeds =
        agvd::uniform_points(base.input(), num_patches, patch_seed);
    const std::vector<Index> label =
        agvd::distance_bounds(surface, layout, base.to_intrinsic(seeds), num_threads, progress)
            .site;
    std::vector<Vec3> origin;
    for (const agvd::SurfacePoint& seed : seeds) {
        origin.push_back(agvd::position(base.input().mesh.view(), seed));
    }
    std::vector<PatchSums> own(num_patches);
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        const agvd::Triangle& t = surface.mesh.triangles[f];
        pieces.for_each(f, [&](const agvd::SurfacePiece& piece) {
            for (const Index v : t) {
                const Index patch = label[v];
                if (patch != no_index) own[patch].add(piece, origin[patch], 1.0 / 3);
            }
        });
    }
    std::vector<PatchSums> sums = own;
    for (const std::uint64_t pair : adjacent_pairs(surface, label, ticker)) {
        const auto to = static_cast<Index>(pair >> 32), from = static_cast<Index>(pair);
        sums[to].add(own[from], origin[from] - origin[to]);
    }
    std::vector<double> of_patch;
    for (const PatchSums& patch : sums) of_patch.push_back(patch.curvature());
    std::vector<double> result;
    result.reserve(label.size());
    for (const Index patch : label) result.push_back(patch == no_index ? 0 : of_patch[patch]);
    return result;
}

}  // namespace remesh
