// Each round solves linear least squares for the moves x of the vertices: distances of samples from
// the planes of their triangles, A (h - sum_k b_k n.x_k)^2; of vertices and middles from the
// surface; and the cost of moves along the mesh. A: area of a sample; n: normal of its triangle; h:
// distance from the plane along n; b_k: barycentric coordinates of the nearest point.
#include "remesh/placement/placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agvd/core/groups.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/closest_point.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/placement/nearest_in_cells.h"

namespace remesh {
namespace {

using Mat3 = Eigen::Matrix3d;
using Field = std::vector<Vec3>;

constexpr int num_rounds = 3;
// Weight of a move along the mesh, relative to the same move at right angles to all triangles.
constexpr double along_cost = 0.12;
// The same of a move along the normal: keeps vertices without samples in place.
constexpr double across_cost = 1e-3;
// Longest move of a round, and longest pull towards equilateral triangles, in square roots of the
// cell's area.
constexpr double longest_vertex_move = 0.15;
constexpr double longest_pull = 0.2;
// Weights of the distances of vertices and middles from the surface, relative to those of the
// surface from the mesh: vertices stay near where planes meet far off.
constexpr double vertex_weight = 0.25;
constexpr double middle_weight = 0.25;
// If the nearest point of the triangles is farther than the plane by this factor, the mesh ends
// before the surface does.
constexpr double overhang = 1.05;
// Least cosine between the normals of a triangle before and after a round.
constexpr double least_normal_cosine = 0.3;
constexpr int most_guard_rounds = 10;
// With so many vertices of the surface for each vertex of the mesh, no other samples are taken.
constexpr std::size_t enough_vertices = 12;
// Least barycentric coordinate of points over the middle of a triangle.
constexpr double inner_share = 0.05;
// Conjugate gradients end when the residual has fallen to this share.
constexpr double residual_share = 1e-3;
constexpr int most_iterations = 40;
constexpr std::size_t samples_per_block = std::size_t{1} << 15;  // 2 MB: fits into a cache.
constexpr Index rows_per_task = 256;                             // Samples or triangles.

// The distance of a point of the surface from its triangle.
struct Gap {
    std::array<double, 3> barycentric{};  // Of the triangle's nearest point.
    double from_plane = 0;
    double from_end = 0;            // If the triangle ends before the surface does; otherwise 0.
    Vec3 direction = Vec3::Zero();  // From that end to the point, of length 1.
};

// Sums of least squares over the samples nearest to one triangle.
struct TriangleSums {
    std::array<double, 3> squares{};   // b_k b_k
    std::array<double, 3> products{};  // b_k b_(k + 1)
    std::array<double, 3> gaps{};      // b_k times the distance from the plane.
};

// Least squares of the distance of a triangle's middle from the surface.
struct MiddleSum {
    Vec3 direction = Vec3::Zero();  // To the surface, of length 1; zero: there is none.
    double weight = 0;              // For each pair of corners.
};

double dot(const Field& a, const Field& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
}

class Fit {
public:
    Fit(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
        std::vector<CellSample> samples, PlacedMesh& mesh, double least_way,
        std::span<const std::uint8_t> stays, int num_threads, Poller& poller)
        : surface_(base.input()),
          least_way_(least_way),
          num_threads_(num_threads),
          poller_(poller),
          ticker_(poller),
          mesh_(mesh),
          around_(triangles_by_vertex(mesh.triangles, mesh.points.size())),
          ground_(base, nearest_vertex, num_vertices()),
          samples_(std::move(samples)) {
        for (Index v = 0; v < num_vertices(); ++v) {
            at_.push_back(mesh.position(surface_.mesh.view(), v));
            const bool is_marked = !stays.empty() && stays[v] != 0;
            stays_.push_back(is_marked || is_on_boundary(surface_, mesh.points[v]) ? 1 : 0);
        }
    }

    void run() {
        for (int round = 0; round < num_rounds; ++round) {
            measure();
            hold_shapes();
            add_distances_of_surface();
            add_distances_of_mesh();
            move(solve());
        }
        for (Index v = 0; v < num_vertices(); ++v) {
            mesh_.offsets[v] = at_[v] - position(surface_.mesh.view(), mesh_.points[v]);
        }
    }

private:
    [[nodiscard]] Index num_vertices() const { return static_cast<Index>(mesh_.points.size()); }

    void measure() {
        normal_.resize(mesh_.triangles.size());
        area_.assign(at_.size(), 0);
        facing_.assign(at_.size(), Vec3::Zero());
        for (Index i = 0; i < mesh_.triangles.size(); ++i) {
            ticker_.tick();
            normal_[i] = doubled_normal(at_, mesh_.triangles[i]);
            for (const Index v : mesh_.triangles[i]) {
                area_[v] += normal_[i].norm() / 6;
                facing_[v] += normal_[i];
            }
            normal_[i].normalize();
        }
        for (Vec3& normal : facing_) normal.normalize();
    }

    // The nearest point on the triangles around the sample's vertex. A sample over the middle of
    // its triangle keeps it: moves in a round are small.
    [[nodiscard]] ClosestPoint find_nearest(CellSample& sample) const {
        ClosestPoint nearest;
        nearest.distance_sq = infinity;
        if (sample.triangle != no_index) {
            nearest = closest(sample.triangle, sample.position);
            const std::array<double, 3>& b = nearest.point.barycentric;
            if (std::min({b[0], b[1], b[2]}) > inner_share) return nearest;
        }
        for (const Index i : around_.of(sample.vertex)) {
            if (i == sample.triangle) continue;
            const ClosestPoint other = closest(i, sample.position);
            if (other.distance_sq >= nearest.distance_sq) continue;
            nearest = other;
            sample.triangle = i;
        }
        return nearest;
    }
    [[nodiscard]] ClosestPoint closest(Index triangle, const Vec3& position) const {
        const auto& [a, b, c] = mesh_.triangles[triangle];
        return closest_point_on_triangle({at_[a], at_[b], at_[c]}, FaceId(triangle), position);
    }

    // The position of the vertex that makes its triangle equilateral.
    [[nodiscard]] Vec3 even_apex(Index triangle, Index v) const {
        const Triangle& t = mesh_.triangles[triangle];
        const std::size_t k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
        const Vec3& a = at_[t[(k + 1) % 3]];
        const Vec3& b = at_[t[(k + 2) % 3]];
        return (a + b) / 2 + std::sqrt(0.75) * normal_[triangle].cross(b - a);
    }

    // Adds the cost of moves along the mesh: lowest at the mean of the positions that make the
    // triangles equilateral.
    void hold_shapes() {
        diagonal_.resize(at_.size());
        right_.resize(at_.size());
        for (Index v = 0; v < num_vertices(); ++v) {
            ticker_.tick(2);
            const Vec3& n = facing_[v];
            const Mat3 across = n * n.transpose();
            const Mat3 along = Mat3::Identity() - across;
            diagonal_[v] = area_[v] * (along_cost * along + across_cost * across);
            Vec3 pull = Vec3::Zero();
            for (const Index i : around_.of(v)) pull += even_apex(i, v) - at_[v];
            pull = along * pull / static_cast<double>(around_.of(v).size());
            const double most = longest_pull * std::sqrt(area_[v]);
            if (pull.norm() > most) pull *= most / pull.norm();
            right_[v] = along_cost * area_[v] * pull;
        }
    }

    // Measures gaps in parallel, block by block, and sums them in the order of the samples, so that
    // sums do not depend on the threads.
    void add_distances_of_surface() {
        sums_.assign(mesh_.triangles.size(), {});
        std::vector<Gap> gaps(std::min(samples_.size(), samples_per_block));
        for (std::size_t first = 0; first < samples_.size(); first += samples_per_block) {
            const auto block =
                std::span(samples_).subspan(first, std::min(samples_.size() - first, gaps.size()));
            const auto measure_one = [&](Index i) { gaps[i] = measure_gap(block[i]); };
            parallel_each(static_cast<Index>(block.size()), rows_per_task, num_threads_,
                          measure_one, poller_);
            poller_.poll();
            for (std::size_t i = 0; i < block.size(); ++i) add_gap(block[i], gaps[i]);
        }
        for (Index i = 0; i < mesh_.triangles.size(); ++i) {
            const Mat3 plane = normal_[i] * normal_[i].transpose();
            for (std::size_t k = 0; k < 3; ++k) {
                const Index v = mesh_.triangles[i][k];
                diagonal_[v] += sums_[i].squares[k] * plane;
                right_[v] += sums_[i].gaps[k] * normal_[i];
            }
        }
    }
    [[nodiscard]] Gap measure_gap(CellSample& sample) const {
        const ClosestPoint nearest = find_nearest(sample);
        if (sample.triangle == no_index) return {};
        const Index i = sample.triangle;
        Gap gap{nearest.point.barycentric,
                normal_[i].dot(sample.position - at_[mesh_.triangles[i][0]]), 0, Vec3::Zero()};
        const double distance = std::sqrt(nearest.distance_sq);
        if (distance > std::max(overhang * std::abs(gap.from_plane), least_way_)) {
            gap.from_end = distance;
            gap.direction = (sample.position - nearest.position) / distance;
        }
        return gap;
    }
    void add_gap(const CellSample& sample, const Gap& gap) {
        if (sample.triangle == no_index) return;
        TriangleSums& sums = sums_[sample.triangle];
        for (std::size_t k = 0; k < 3; ++k) {
            const double weight = sample.area * gap.barycentric[k];
            if (gap.from_end > 0) {
                // Draws each corner towards the sample by itself: an upper bound of the square of
                // their sum.
                const Index v = mesh_.triangles[sample.triangle][k];
                diagonal_[v] += weight * gap.direction * gap.direction.transpose();
                right_[v] += weight * gap.from_end * gap.direction;
                continue;
            }
            sums.squares[k] += weight * gap.barycentric[k];
            sums.products[k] += weight * gap.barycentric[(k + 1) % 3];
            sums.gaps[k] += weight * gap.from_plane;
        }
    }

    void add_distances_of_mesh() {
        ways_.resize(std::max(at_.size(), mesh_.triangles.size()));
        find_ways(num_vertices(),
                  [&](Index v) { return way_to_surface(at_[v], std::span(&v, 1)); });
        for (Index v = 0; v < num_vertices(); ++v) {
            const Vec3& way = ways_[v];
            if (!(way.norm() > least_way_)) continue;
            const Vec3 direction = way.normalized();
            diagonal_[v] += vertex_weight * area_[v] * direction * direction.transpose();
            right_[v] += vertex_weight * area_[v] * way;
        }
        const auto num_triangles = static_cast<Index>(mesh_.triangles.size());
        find_ways(num_triangles, [&](Index i) {
            const auto& [a, b, c] = mesh_.triangles[i];
            return way_to_surface((at_[a] + at_[b] + at_[c]) / 3, mesh_.triangles[i]);
        });
        middle_.assign(num_triangles, {});
        for (Index i = 0; i < num_triangles; ++i) {
            const Vec3& way = ways_[i];
            if (!(way.norm() > least_way_)) continue;
            const double area = doubled_normal(at_, mesh_.triangles[i]).norm() / 2;
            MiddleSum& sum = middle_[i];
            sum = {way.normalized(), middle_weight * area / 9};
            const Mat3 block = sum.weight * sum.direction * sum.direction.transpose();
            for (const Index v : mesh_.triangles[i]) {
                diagonal_[v] += block;
                right_[v] += 3 * sum.weight * way;
            }
        }
    }
    template <typename Way>
    void find_ways(Index count, const Way& way) {
        const auto find = [&](Index i) { ways_[i] = way(i); };
        parallel_each(count, rows_per_task, num_threads_, find, poller_);
    }
    // From a point of the mesh to the surface in these cells; zero if they have no vertex.
    [[nodiscard]] Vec3 way_to_surface(const Vec3& point, std::span<const Index> cells) const {
        const ClosestPoint nearest = ground_.query(point, cells);
        if (!std::isfinite(nearest.distance_sq)) return Vec3::Zero();
        return nearest.position - point;
    }

    void multiply(const Field& x, Field& result) {
        for (std::size_t v = 0; v < x.size(); ++v) result[v] = diagonal_[v] * x[v];
        for (Index i = 0; i < mesh_.triangles.size(); ++i) {
            ticker_.tick();
            const Triangle& t = mesh_.triangles[i];
            const std::array<double, 3> up{normal_[i].dot(x[t[0]]), normal_[i].dot(x[t[1]]),
                                           normal_[i].dot(x[t[2]])};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t next = (k + 1) % 3, previous = (k + 2) % 3;
                result[t[k]] +=
                    (sums_[i].products[k] * up[next] + sums_[i].products[previous] * up[previous]) *
                    normal_[i];
            }
            const auto& [direction, weight] = middle_[i];
            const std::array<double, 3> out{direction.dot(x[t[0]]), direction.dot(x[t[1]]),
                                            direction.dot(x[t[2]])};
            for (std::size_t k = 0; k < 3; ++k) {
                result[t[k]] += weight * (out[(k + 1) % 3] + out[(k + 2) % 3]) * direction;
            }
        }
        hold(result);
    }
    void hold(Field& x) const {
        for (std::size_t v = 0; v < x.size(); ++v) {
            if (stays_[v] != 0) x[v].setZero();
        }
    }

    // Conjugate gradients with the diagonal blocks as preconditioner.
    [[nodiscard]] Field solve() {
        std::vector<Mat3> inverse(at_.size());
        for (std::size_t v = 0; v < at_.size(); ++v) {
            ticker_.tick();
            inverse[v] = diagonal_[v].inverse();
            if (!inverse[v].allFinite()) inverse[v].setZero();
        }
        const auto precondition = [&](const Field& r, Field& z) {
            for (std::size_t v = 0; v < r.size(); ++v) z[v] = inverse[v] * r[v];
        };
        Field x(at_.size(), Vec3::Zero()), residual = right_, z(at_.size()), product(at_.size());
        hold(residual);
        precondition(residual, z);
        Field direction = z;
        double now = dot(residual, z);
        const double enough = residual_share * residual_share * now;
        for (int i = 0; i < most_iterations && now > enough; ++i) {
            multiply(direction, product);
            const double curvature = dot(direction, product);
            if (!(curvature > 0)) break;
            for (std::size_t v = 0; v < x.size(); ++v) {
                x[v] += now / curvature * direction[v];
                residual[v] -= now / curvature * product[v];
            }
            precondition(residual, z);
            const double next = dot(residual, z);
            for (std::size_t v = 0; v < x.size(); ++v) {
                direction[v] = z[v] + next / now * direction[v];
            }
            now = next;
        }
        return x;
    }

    // Applies the moves, except those of triangles that would turn over.
    void move(const Field& moves) {
        const Field before = at_;
        for (std::size_t v = 0; v < at_.size(); ++v) {
            const double most = longest_vertex_move * std::sqrt(area_[v]);
            const double length = moves[v].norm();
            if (std::isfinite(length)) at_[v] += std::min(1.0, most / length) * moves[v];
        }
        for (int round = 0; round < most_guard_rounds; ++round) {
            bool is_done = true;
            for (Index i = 0; i < mesh_.triangles.size(); ++i) {
                ticker_.tick();
                const Vec3 normal = doubled_normal(at_, mesh_.triangles[i]);
                if (normal.dot(normal_[i]) > least_normal_cosine * normal.norm()) continue;
                for (const Index v : mesh_.triangles[i]) {
                    if (at_[v] == before[v]) continue;
                    at_[v] = before[v];
                    is_done = false;
                }
            }
            if (is_done) return;
        }
        at_ = before;
    }

    const Surface& surface_;
    double least_way_;
    int num_threads_;
    Poller& poller_;
    Ticker ticker_;
    PlacedMesh& mesh_;
    Groups around_;  // #V: the triangles there.
    detail::NearestInCells ground_;
    std::vector<CellSample> samples_;
    Field at_;                         // #V
    std::vector<std::uint8_t> stays_;  // #V
    std::vector<double> area_;         // #V: a third of the triangles around.
    Field normal_;                     // #triangles, of length 1.
    Field facing_;                     // #V: normals of the mesh, of length 1.
    std::vector<TriangleSums> sums_;   // #triangles
    std::vector<MiddleSum> middle_;    // #triangles
    std::vector<Vec3> ways_;           // #V or #triangles: to the surface.
    std::vector<Mat3> diagonal_;       // #V: the diagonal blocks of the equations.
    Field right_;                      // #V: their right sides.
};

}  // namespace

std::vector<CellSample> sample_cells(const PreparedSurface& surface,
                                     std::span<const Index> nearest_vertex, Index num_vertices,
                                     const Progress& progress) {
    Poller poller(progress);
    Ticker ticker(poller);
    const Surface& base = surface.base.surface();
    const auto& p = base.mesh.positions;
    const bool is_dense = p.size() >= enough_vertices * num_vertices;
    std::vector<CellSample> samples;
    samples.reserve(p.size() + (is_dense ? 0 : surface.pieces->num_pieces_at_most()));
    std::vector<double> area(p.size(), 0);
    for (Index f = 0; f < base.num_faces(); ++f) {
        ticker.tick();
        const Triangle& t = base.mesh.triangles[f];
        const double whole = face_area(base, f);
        // Points inside faces stand for three quarters of the area: exact for quadratic functions.
        for (const Index v : t) area[v] += is_dense ? whole / 3 : whole / 12;
        if (is_dense || nearest_vertex[t[0]] == no_index) continue;
        surface.pieces->for_each(f, [&](const SurfacePiece& piece) {
            samples.push_back({piece.position, piece.vector.norm() * 3 / 4, nearest_vertex[t[0]]});
        });
    }
    for (Index v = 0; v < p.size(); ++v) {
        ticker.tick();
        if (nearest_vertex[v] != no_index) samples.push_back({p[v], area[v], nearest_vertex[v]});
    }
    return samples;
}

void fit_vertices(const IntrinsicTriangulation& base, std::span<const Index> nearest_vertex,
                  std::vector<CellSample> samples, PlacedMesh& mesh, int num_threads,
                  const Progress& progress, double least_way, std::span<const std::uint8_t> stays) {
    Poller poller(progress);
    mesh.offsets.resize(mesh.points.size(), Vec3::Zero());
    Fit(base, nearest_vertex, std::move(samples), mesh, least_way, stays, num_threads, poller)
        .run();
}

}  // namespace remesh
