// On a small patch the normal is linear in the position: variances of normals and positions are in
// the ratio of the mean square of the principal curvatures.
#include <algorithm>
#include <cmath>
#include <functional>

#include "agvd/core/types.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/sites/target_lengths.h"

namespace remesh {
namespace {

// Of the random numbers: no value is better than another.
constexpr std::uint64_t cell_seed = 0x5eed;
// Pieces of a face that is larger than this share of a cell.
constexpr double piece_of_cell = 0.25;
constexpr int most_rows = 64;

// Integrals over a part of the surface. Positions count from a point of the cell, so that
// differences of squares keep their digits.
struct PatchSums {
    double area = 0, squares = 0;  // Squares of the distances from the point.
    Vec3 normal = Vec3::Zero(), position = Vec3::Zero();

    void add(const Vec3& vector, double weight, const Vec3& at) {
        area += weight;
        squares += weight * at.squaredNorm();
        normal += vector;
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

// The corner of the base nearest to a point, roughly.
Index nearest_corner(const IntrinsicTriangulation& base, const SurfacePoint& on_input) {
    const SurfacePoint point = base.to_intrinsic(on_input);
    const auto& b = point.barycentric;
    const auto k = static_cast<std::size_t>(std::max_element(b.begin(), b.end()) - b.begin());
    return base.surface().mesh.triangles[point.face.value()][k];
}

struct CurvatureCells {
    const IntrinsicTriangulation& base;
    Index num_cells;
    Ticker& ticker;
    const Surface& surface = base.surface();
    double piece_area = piece_of_cell * surface_area(surface) / num_cells;
    std::vector<Index> cell = std::vector<Index>(surface.num_vertices(), no_index);  // #V
    std::vector<Index> start = {};  // By cell: its vertex.
    std::vector<Vec3> origin = {};  // By cell: where that lies.

    std::vector<double> run() {
        spread_points();
        spread();
        std::vector<PatchSums> own(origin.size());
        for (Index f = 0; f < base.input().num_faces(); ++f) add_face(f, own);
        std::vector<PatchSums> patches = own;
        for (const std::uint64_t pair : adjacent_cells()) {
            const auto to = static_cast<Index>(pair >> 32), from = static_cast<Index>(pair);
            patches[to].add(own[from], origin[from] - origin[to]);
        }
        std::vector<double> result;
        result.reserve(cell.size());
        for (const Index c : cell) result.push_back(c == no_index ? 0 : patches[c].curvature());
        return result;
    }

    // The vertices around which the cells lie.
    void spread_points() {
        for (const SurfacePoint& point : uniform_points(base.input(), num_cells, cell_seed)) {
            ticker.tick();
            const Index v = nearest_corner(base, point);
            if (cell[v] != no_index) continue;
            cell[v] = static_cast<Index>(origin.size());
            origin.push_back(surface.mesh.positions[v]);
            start.push_back(v);
        }
    }

    // Gives each vertex the cell that is nearest along edges.
    void spread() {
        std::vector<double> distance(cell.size(), infinity);
        for (const Index v : start) distance[v] = 0;
        visit_in_rounds(surface.num_vertices(), start, [&](Index v, const auto& wait) {
            ticker.tick(4);
            for_each_edge_at(surface, v, [&](Index h, Index other) {
                const double reached = distance[v] + surface.length_of(h);
                if (!(reached < distance[other])) return;
                distance[other] = reached;
                cell[other] = cell[v];
                wait(other);
            });
        });
    }

    void add_face(Index f, std::vector<PatchSums>& sums) {
        ticker.tick();
        const Surface& input = base.input();
        const Triangle& t = input.mesh.triangles[f];
        const auto& p = input.mesh.positions;
        const Vec3 vector = doubled_normal(p, t) / 2;
        const double area = vector.norm();
        const auto add = [&](Index vertex, double share, const Vec3& at) {
            const Index c = cell[vertex];
            if (c != no_index) sums[c].add(share * vector, share * area, at - origin[c]);
        };
        const double rows = std::ceil(std::sqrt(area / piece_area));
        if (rows <= 1) {
            const Vec3 middle = (p[t[0]] + p[t[1]] + p[t[2]]) / 3;
            for (const Index v : t) add(v, 1.0 / 3, middle);
            return;
        }
        // Small triangles between the lines of a grid: upright ones and those upside down.
        const int n = static_cast<int>(std::min<double>(rows, most_rows));
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < 2 * (n - i) - 1; ++j) {
                ticker.tick();
                const double third = (j % 2 + 1) / 3.0;
                const int column = j / 2;
                const double b1 = (i + third) / n, b2 = (column + third) / n;
                const SurfacePoint point{FaceId(f), {1 - b1 - b2, b1, b2}};
                add(nearest_corner(base, point), 1.0 / (n * n), position(input.mesh.view(), point));
            }
        }
    }

    // Keys of the pairs of cells that share an edge between their vertices, both ways, sorted.
    [[nodiscard]] std::vector<std::uint64_t> adjacent_cells() {
        std::vector<std::uint64_t> pairs;
        for (Index e = 0; e < surface.num_edges(); ++e) {
            ticker.tick();
            const Index h = surface.edge_half[e];
            const Index a = cell[surface.tail(h)], b = cell[surface.head(h)];
            if (a == b || a == no_index || b == no_index) continue;
            pairs.push_back((std::uint64_t{a} << 32) | b);
            pairs.push_back((std::uint64_t{b} << 32) | a);
        }
        sort_ticked(pairs, ticker, std::less<>());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }
};

}  // namespace

std::vector<double> patch_curvature(const IntrinsicTriangulation& base, double num_cells,
                                    Ticker& ticker) {
    return CurvatureCells{base, static_cast<Index>(std::clamp(num_cells, 1.0, 1e9)), ticker}.run();
}

}  // namespace remesh
