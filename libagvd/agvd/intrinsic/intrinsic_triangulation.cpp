// Builds the base in the order of docs/algorithm/intrinsic.md: raise degenerate
// faces, remove flat vertices, flip to Delaunay ([bobenko2007], [fisher2007]), split long edges,
// longest first. FaceHistory records every change and maps points and segments both ways.
#include "agvd/intrinsic/intrinsic_triangulation.h"

#include <algorithm>
#include <queue>
#include <string>
#include <utility>

#include "agvd/intrinsic/delaunay_queue.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

using detail::DelaunayQueue;
using detail::EdgeSplit;
using detail::FaceCharts;
using detail::FaceHistory;
using detail::Way;

// The most flips for each edge: far more than needles take.
constexpr std::size_t most_flips = 1000;
// What is done, as a share of the time, before the flips and before the splits.
constexpr double share_of_removal = 0.75, share_of_flips = 0.9;
// Ticks of a split.
constexpr std::size_t split_work = 16;

void check_options(const IntrinsicOptions& options) {
    if (!(options.max_length > 0)) {
        throw InvalidOption("max_length is " + std::to_string(options.max_length) +
                            "; use a number above 0");
    }
    if (!(options.min_length >= 0)) {
        throw InvalidOption("min_length is " + std::to_string(options.min_length) +
                            "; use 0 or more");
    }
}

// Splits edges, longest first, and flips after each split.
class Refinement {
public:
    Refinement(Surface& surface, FaceCharts& charts, FaceHistory& history, DelaunayQueue& flips,
               const IntrinsicOptions& options, Ticker& ticker)
        : surface_(surface),
          charts_(charts),
          history_(history),
          flips_(flips),
          options_(options),
          ticker_(ticker) {
        if (!options.unit_at) return;
        unit_.assign(surface.num_vertices(), 1);
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            ticker_.tick();
            if (surface.outgoing[v] == no_index) continue;
            unit_[v] = options.unit_at(*history.carry(Way::Backward, point_at(surface, v)));
        }
    }

    // Appends the new vertices, on the input. False if flips ended early.
    bool run(std::vector<SurfacePoint>& added) {
        while (find_long_edges()) {
            while (!queue_.empty()) {
                const auto [length, key] = queue_.top();
                queue_.pop();
                ticker_.tick(split_work);
                const Index edge = ~key;
                if (measure(edge) != length) continue;
                if (added.size() >= options_.most_splits) return true;
                split(edge, added);
                if (!flips_.flip_all(most_flips * surface_.num_edges())) return false;
                for (const Index e : touched_) push(e);
            }
        }
        return true;
    }

private:
    // Long edges that flips have made farther away are found by the next search.
    bool find_long_edges() {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            ticker_.tick();
            if (surface_.edge_half[e] != no_index) push(e);
        }
        return !queue_.empty();
    }
    void push(Index edge) {
        const double length = measure(edge);
        if (length > options_.max_length) queue_.emplace(length, ~edge);
    }
    [[nodiscard]] double measure(Index edge) const {
        if (unit_.empty()) return surface_.length[edge];
        const Index h = surface_.edge_half[edge];
        return 2 * surface_.length[edge] / (unit_[surface_.tail(h)] + unit_[surface_.head(h)]);
    }

    void split(Index edge, std::vector<SurfacePoint>& added) {
        const Index h = surface_.edge_half[edge];
        added.push_back(*history_.carry(Way::Backward, point_on(h, 0.5)));
        if (options_.unit_at) unit_.push_back(options_.unit_at(added.back()));
        const Index vertex = detail::add_vertex(surface_);  // Its position is set at the end.
        const EdgeSplit made = detail::split_edge(surface_, charts_, h, 0.5, vertex);
        touched_.clear();
        for (const EdgeSplit::Side& side : made.side) {
            if (side.half_edge == no_index) continue;
            history_.add_split(side.half_edge, side.new_face);
            for (const Index face : {Surface::face(side.half_edge), side.new_face}) {
                for (Index k = 3 * face; k < 3 * face + 3; ++k) {
                    flips_.push(surface_.edge[k]);
                    touched_.push_back(surface_.edge[k]);
                }
            }
        }
    }

    Surface& surface_;
    FaceCharts& charts_;
    FaceHistory& history_;
    DelaunayQueue& flips_;
    const IntrinsicOptions& options_;
    Ticker& ticker_;
    std::vector<double> unit_;  // #V, or empty: IntrinsicOptions::unit_at.
    std::priority_queue<std::pair<double, Index>> queue_;  // Length, and the edge's complement.
    std::vector<Index> touched_;
};

// Frees the spare memory of arrays that have grown with each split: a fifth of the surface.
void shrink(Surface& s) {
    const auto shrink_all = [](auto&... arrays) { (arrays.shrink_to_fit(), ...); };
    shrink_all(s.mesh.positions, s.mesh.triangles, s.twin, s.edge, s.edge_half, s.length, s.apex,
               s.outgoing, s.can_be_pseudo_source);
}

// For faces with more operations, evenly spread points are used.
constexpr Index most_steps_back = 16, most_part_steps = 64;

// Area, as a share of the face, and centroid, from the triangles at the first corner.
InputPart measure(const detail::FacePolygon& polygon) {
    const auto& corner = polygon.corner;
    InputPart part{{FaceId(polygon.face), {0, 0, 0}}, 0};
    for (Index i = 2; i < polygon.num_corners; ++i) {
        const double share = (corner[i - 1][1] - corner[0][1]) * (corner[i][2] - corner[0][2]) -
                             (corner[i - 1][2] - corner[0][2]) * (corner[i][1] - corner[0][1]);
        part.share += share;
        for (std::size_t k = 0; k < 3; ++k) {
            part.centroid.barycentric[k] +=
                share * (corner[0][k] + corner[i - 1][k] + corner[i][k]) / 3;
        }
    }
    for (double& b : part.centroid.barycentric) b = part.share > 0 ? b / part.share : 1.0 / 3;
    return part;
}

}  // namespace

IntrinsicTriangulation::IntrinsicTriangulation(const Surface& input,
                                               const IntrinsicOptions& options)
    : input_(&input), surface_(input), history_(std::make_unique<FaceHistory>(input.num_faces())) {
    check_options(options);
    Poller poller(options.progress);
    Ticker ticker(poller);
    ticker.poll();
    detail::raise_degenerate_faces(surface_, options.num_threads, poller);
    change_faces(options, poller, ticker);
    if (counts_.removed > 0) detail::compact_faces(surface_, *history_);
    history_->shrink();
    shrink(surface_);
    added_.shrink_to_fit();
    counts_.splits = static_cast<Index>(added_.size());
    for (Index i = 0; i < added_.size(); ++i) {
        surface_.mesh.positions[input_->num_vertices() + i] = position(input_->mesh, added_[i]);
    }
}

void IntrinsicTriangulation::change_faces(const IntrinsicOptions& options, Poller& poller,
                                          Ticker& ticker) {
    FaceCharts charts(surface_);
    if (options.min_length > 0) {
        counts_.removed = detail::remove_flat_vertices(
            surface_, charts, *history_, options.min_length, options.num_threads, poller);
    }
    poller.tell(share_of_removal);
    DelaunayQueue flips(surface_, charts, history_.get(), &ticker);
    flips.push_all(options.num_threads, poller);
    counts_.is_delaunay = flips.flip_all(most_flips * surface_.num_edges());
    poller.tell(share_of_flips);
    Refinement refinement(surface_, charts, *history_, flips, options, ticker);
    counts_.is_delaunay = refinement.run(added_) && counts_.is_delaunay;
}

IntrinsicTriangulation::IntrinsicTriangulation(IntrinsicTriangulation&&) noexcept = default;
IntrinsicTriangulation& IntrinsicTriangulation::operator=(IntrinsicTriangulation&&) noexcept =
    default;
IntrinsicTriangulation::~IntrinsicTriangulation() = default;

bool IntrinsicTriangulation::is_changed(Index face) const { return history_->is_changed(face); }

SurfacePoint IntrinsicTriangulation::to_intrinsic(const SurfacePoint& on_input) const {
    return *history_->carry(Way::Forward, on_input);
}

SurfacePoint IntrinsicTriangulation::to_input(const SurfacePoint& on_base) const {
    return *history_->carry(Way::Backward, on_base);
}

std::vector<SurfacePoint> IntrinsicTriangulation::to_intrinsic(
    std::span<const SurfacePoint> on_input) const {
    std::vector<SurfacePoint> points(on_input.begin(), on_input.end());
    for (SurfacePoint& point : points) point = to_intrinsic(point);
    return points;
}

std::vector<SurfacePoint> IntrinsicTriangulation::to_input(
    std::span<const SurfacePoint> on_base) const {
    std::vector<SurfacePoint> points(on_base.begin(), on_base.end());
    for (SurfacePoint& point : points) point = to_input(point);
    return points;
}

void IntrinsicTriangulation::to_input(const SurfacePoint& begin, const SurfacePoint& end,
                                      std::vector<SurfacePoint>& parts) const {
    history_->carry_back(begin, end, parts);
}

std::vector<InputPart> IntrinsicTriangulation::parts_of(Index face) const {
    constexpr double third = 1.0 / 3;
    const SurfacePoint middle{FaceId(face), {third, third, third}};
    std::vector<detail::FacePolygon> polygons;
    if (!history_->carry(Way::Backward, middle, most_steps_back) ||
        !history_->parts_of(face, most_part_steps, polygons)) {
        return {};
    }
    std::vector<InputPart> parts;
    for (const detail::FacePolygon& polygon : polygons) {
        const InputPart part = measure(polygon);
        if (part.share > 0) parts.push_back(part);
    }
    return parts;
}

}  // namespace agvd
