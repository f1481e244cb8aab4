// Cells are those of random points, by labels of the vertices. On a small patch the normal is a
// linear function of the position, whose singular values are the principal curvatures: so variances
// of normals and positions are in the ratio of their mean square.
#include "remesh/sizing/curvature.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "agvd/core/edge_key.h"
#include "agvd/core/poller.h"
#include "agvd/mesh/uniform_points.h"
#include "agvd/propagation/distance_bounds.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Vec3;

// Any value works.
constexpr std::uint64_t cell_seed = 0x5eed;

// Integrals over a part of the surface. Positions count from the cell's own point, so that
// differences of squares keep their digits.
struct PatchSums {
    double area = 0, squares = 0;  // Squares of the distances from the point.
    Vec3 normal = Vec3::Zero(), position = Vec3::Zero();

    void add(const agvd::SurfacePiece& piece, const Vec3& origin, double share) {
        const double weight = share * piece.vector.norm();
        const Vec3 at = piece.position - origin;
        area += weight;
        squares += weight * at.squaredNorm();
        normal += share * piece.vector;
        position += weight * at;
    }
    // \param offset  from this part's point to the other's.
    void add(const PatchSums& other, const Vec3& offset) {
        area += other.area;
        squares +=
            other.squares + 2 * offset.dot(other.position) + other.area * offset.squaredNorm();
        normal += other.normal;
        position += other.position + other.area * offset;
    }

    [[nodiscard]] double curvature() const {
        if (!(area > 0)) return 0;
        const double of_normals = 1 - (normal / area).squaredNorm();
        const double of_positions = squares / area - (position / area).squaredNorm();
        return of_positions > 0 ? std::sqrt(std::max(of_normals, 0.0) / of_positions) : 0;
    }
};

// Keys of the pairs of cells that share an edge between their vertices, both ways, sorted.
std::vector<std::uint64_t> adjacent_cells(const agvd::Surface& surface,
                                          const std::vector<Index>& cell, agvd::Ticker& ticker) {
    std::vector<std::uint64_t> pairs;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        ticker.tick();
        const Index h = surface.edge_half[e];
        const Index a = cell[surface.tail(h)], b = cell[surface.head(h)];
        if (a == b || a == no_index || b == no_index) continue;
        pairs.push_back((std::uint64_t{a} << 32) | b);
        pairs.push_back((std::uint64_t{b} << 32) | a);
    }
    agvd::sort_ticked(pairs, ticker, std::less<>());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace

std::vector<double> patch_curvature(const agvd::IntrinsicTriangulation& base,
                                    const agvd::FacePieces& pieces,
                                    const agvd::SurfaceLayout& layout, Index num_cells,
                                    int num_threads, const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    const agvd::Surface& surface = base.surface();
    const std::vector<agvd::SurfacePoint> points =
        agvd::uniform_points(base.input(), num_cells, cell_seed);
    const std::vector<Index> cell =
        agvd::distance_bounds(surface, layout, base.to_intrinsic(points), num_threads, progress)
            .site;
    std::vector<Vec3> origin;
    origin.reserve(points.size());
    for (const agvd::SurfacePoint& point : points) {
        origin.push_back(agvd::position(base.input().mesh.view(), point));
    }
    std::vector<PatchSums> own(points.size());
    for (Index f = 0; f < surface.num_faces(); ++f) {
        ticker.tick();
        pieces.for_each(f, [&](const agvd::SurfacePiece& piece) {
            for (const Index v : surface.mesh.triangles[f]) {
                if (cell[v] != no_index) own[cell[v]].add(piece, origin[cell[v]], 1.0 / 3);
            }
        });
    }
    std::vector<PatchSums> patches = own;
    for (const std::uint64_t pair : adjacent_cells(surface, cell, ticker)) {
        const auto to = static_cast<Index>(pair >> 32), from = static_cast<Index>(pair);
        patches[to].add(own[from], origin[from] - origin[to]);
    }
    std::vector<double> result;
    result.reserve(cell.size());
    for (const Index c : cell) result.push_back(c == no_index ? 0 : patches[c].curvature());
    return result;
}

}  // namespace remesh
