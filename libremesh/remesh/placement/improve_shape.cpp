// Vertices of bad triangles try steps along the surface, the worst first; one is kept if it gains
// more quality than it costs to leave the planes of the cell ([garland1997]).
#include "remesh/placement/placement.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/groups.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/walk.h"
#include "remesh/placement/shape_quality.h"
#include "remesh/sites/cell_measures.h"
#include "remesh/sites/size_field.h"

namespace remesh {
namespace {

// Triangles below detail::low_quality are improved first; then those below this, without
// plane_cost: better angles at the same distance.
constexpr double poor_quality = 0.66;
// Quality that a move must gain if it leaves the planes of the cell by the mean length of the edges
// around the vertex; at other distances in proportion to the square.
constexpr double plane_cost = 30;
constexpr int most_rounds = 8;
// A fixed side shorter than short_side mean edges (or target lengths) makes its triangle slim: its
// quality is divided by slim_quality, as vertices would crowd around it.
constexpr double short_side = 0.25;
constexpr double slim_quality = 0.3;
// Least gain in quality of a move.
constexpr double least_gain = 1e-4;
// Most faces that all walks cross, per face of the surface and vertex of the mesh. Around long
// spikes they circle; elsewhere they cross at most 2 a face or 370 a vertex.
constexpr std::size_t most_crossings_per_face = 20;
constexpr std::size_t most_crossings_per_vertex = 600;

class Improvement {
public:
    Improvement(const Surface& input, std::span<const detail::CellPlanes> planes,
                const SizeField* sizes, std::span<const std::uint8_t> stays, Poller& poller,
                PlacedMesh& mesh)
        : surface_(input),
          ticker_(poller),
          mesh_(mesh),
          around_(triangles_by_vertex(mesh.triangles, mesh.points.size())),
          at_(mesh.points.size()),
          facing_(mesh.points.size()),
          planes_(planes),
          most_crossings_(most_crossings_per_face * input.num_faces() +
                          most_crossings_per_vertex * mesh.points.size()) {
        for (Index v = 0; v < at_.size(); ++v) {
            locate(v);
            stays_.push_back(
                is_on_boundary(surface_, mesh.points[v]) || (!stays.empty() && stays[v] != 0) ? 1
                                                                                              : 0);
        }
        find_slim(sizes);
    }

    void run() {
        work_below(detail::low_quality, plane_cost);
        work_below(poor_quality, 0);
    }

private:
    void work_below(double least_quality, double cost) {
        plane_cost_ = cost;
        may_improve_.assign(at_.size(), 1);
        for (int round = 0; round < most_rounds; ++round) {
            std::vector<std::pair<double, Index>> bad;
            for (Index i = 0; i < mesh_.triangles.size(); ++i) {
                ticker_.tick();
                const double q = quality_of(i);
                if (q >= least_quality) continue;
                for (const Index v : mesh_.triangles[i]) bad.emplace_back(q, v);
            }
            std::sort(bad.begin(), bad.end());
            bool is_better = false;
            for (const auto& [q, v] : bad) {
                if (may_improve_[v] == 0) continue;
                if (num_crossings_ > most_crossings_) return;
                may_improve_[v] = 0;
                if (!improve(v)) continue;
                is_better = true;
                for (const Index i : around_.of(v)) {
                    for (const Index other : mesh_.triangles[i]) may_improve_[other] = 1;
                }
            }
            if (!is_better) return;
        }
    }

    // Marks triangles on a short side between two fixed vertices.
    void find_slim(const SizeField* sizes) {
        double sum = 0;
        for (const auto& [a, b, c] : mesh_.triangles) {
            sum += (at_[b] - at_[a]).norm() + (at_[c] - at_[b]).norm() + (at_[a] - at_[c]).norm();
        }
        const double mean = sum / (3 * static_cast<double>(mesh_.triangles.size()));
        for (const Triangle& t : mesh_.triangles) {
            bool is_slim = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index a = t[k], b = t[(k + 1) % 3];
                const double usual = sizes != nullptr ? sizes->at(mesh_.points[a]) : mean;
                const bool is_short = (at_[b] - at_[a]).norm() < short_side * usual;
                is_slim = is_slim || (is_short && stays_[a] != 0 && stays_[b] != 0);
            }
            is_slim_.push_back(is_slim ? 1 : 0);
        }
    }

    // Quality of a triangle, raised if it is slim.
    [[nodiscard]] double quality_of(Index i) const {
        const auto& [a, b, c] = mesh_.triangles[i];
        const double q = detail::shape_quality(at_[a], at_[b], at_[c]);
        return is_slim_[i] != 0 ? std::min(1.0, q / slim_quality) : q;
    }

    void locate(Index v) {
        facing_[v] = detail::facing_at(surface_, mesh_.points[v]);
        at_[v] = mesh_.position(surface_.mesh.view(), v);
    }

    // The lowest quality around a vertex; 1 less for triangles that point against the surface.
    [[nodiscard]] double worst_around(Index v) {
        ticker_.tick(around_.of(v).size());
        double worst = 1;
        for (const Index i : around_.of(v)) {
            const auto& [a, b, c] = mesh_.triangles[i];
            const Vec3 normal = (at_[b] - at_[a]).cross(at_[c] - at_[a]);
            const bool is_turned = !(normal.dot(facing_[a] + facing_[b] + facing_[c]) > 0);
            worst = std::min(worst, quality_of(i) - (is_turned ? 1 : 0));
        }
        return worst;
    }

    // Takes a step if it helps.
    // \param length  mean length of the edges around the vertex.
    bool try_step(Index v, const Vec3& step, double length, double& worst) {
        const SurfacePoint before = mesh_.points[v];
        const Vec3 at_before = at_[v];
        const detail::Walk walk = detail::walk_straight(surface_, before, step);
        num_crossings_ += static_cast<std::size_t>(walk.num_crossings);
        ticker_.tick(static_cast<std::size_t>(walk.num_crossings));
        mesh_.points[v] = walk.end;
        locate(v);
        const double now = worst_around(v);
        const double area = planes_[v].spread.trace();
        const double leaves =
            area > 0 ? planes_[v].growth(at_before, at_[v] - at_before) / (area * length * length)
                     : 0;
        if (now > worst + least_gain + plane_cost_ * std::max(leaves, 0.0)) {
            worst = now;
            return true;
        }
        mesh_.points[v] = before;
        locate(v);
        return false;
    }

    bool improve(Index v) {
        if (stays_[v] != 0) return false;
        Vec3 normal = Vec3::Zero(), mean = Vec3::Zero();
        double length = 0;
        const std::span<const Index> around = around_.of(v);
        for (const Index i : around) {
            const auto& [a, b, c] = mesh_.triangles[i];
            normal += (at_[b] - at_[a]).cross(at_[c] - at_[a]);
            mean += at_[a] + at_[b] + at_[c] - at_[v];
            for (const Index other : {a, b, c}) length += (at_[other] - at_[v]).norm();
        }
        const double num_others = 2.0 * static_cast<double>(around.size());
        mean /= num_others;
        length /= num_others;
        if (!(normal.norm() > 0)) return false;
        directions_.clear();
        detail::add_directions(normal, directions_);

        double worst = worst_around(v);
        const bool moves_to_mean = try_step(v, mean - at_[v], length, worst);
        const bool takes_steps = detail::try_steps(directions_, length, [&](const Vec3& step) {
            return try_step(v, step, length, worst);
        });
        return moves_to_mean || takes_steps;
    }

    const Surface& surface_;
    Ticker ticker_;
    PlacedMesh& mesh_;
    Groups around_;                               // #V: the triangles there.
    std::vector<Vec3> directions_;                // Of the vertex at hand.
    std::vector<Vec3> at_, facing_;               // #V: positions, and normals of the surface.
    std::span<const detail::CellPlanes> planes_;  // #V
    std::vector<std::uint8_t> stays_;             // #V
    std::vector<std::uint8_t> is_slim_;           // By triangle: see short_side.
    double plane_cost_ = 0;
    std::size_t num_crossings_ = 0;  // Of all walks so far.
    std::size_t most_crossings_;
    // #V: 0 if the last try changed nothing, nor moved a neighbour since.
    std::vector<std::uint8_t> may_improve_;
};

}  // namespace

std::vector<detail::CellPlanes> planes_of_cells(const PreparedSurface& surface,
                                                std::span<const Index> nearest_vertex,
                                                Index num_vertices, int num_threads,
                                                const Progress& progress) {
    Poller poller(progress);
    std::vector<detail::CellPlanes> planes(num_vertices);
    const Surface& base = surface.base.surface();
    const detail::FaceParts parts(base, nearest_vertex, num_threads);
    const auto add_part = [&](Index part, Index, Index) {
        Ticker ticker(poller);
        parts.for_each_face(part, [&](Index f) {
            ticker.tick();
            surface.pieces->for_each(f, [&](const SurfacePiece& piece) {
                const double area = piece.vector.norm() / 3;
                if (!(area > 0)) return;
                for (const Index corner : base.mesh.triangles[f]) {
                    const Index v = nearest_vertex[corner];
                    if (!parts.has(part, v)) continue;
                    planes[v].add(piece.vector / 3, area, piece.position);
                }
            });
        });
    };
    parallel_chunks(parts.count(), 1, num_threads, add_part, poller);
    return planes;
}

void improve_shape(const Surface& input, std::span<const detail::CellPlanes> planes,
                   PlacedMesh& mesh, const Progress& progress, const SizeField* sizes,
                   std::span<const std::uint8_t> stays) {
    Poller poller(progress);
    Improvement(input, planes, sizes, stays, poller, mesh).run();
}

}  // namespace remesh
