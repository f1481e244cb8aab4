#include "remesh/quality/feature_coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "remesh/quality/edge_dihedrals.h"
#include "remesh/quality/segment_grid.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using detail::EdgeDihedral;
using detail::SegmentGrid;

constexpr double degree = std::numbers::pi / 180;
constexpr double sharp = 40 * degree;
constexpr double blunt = 25 * degree;
constexpr double corner_turn = 45 * degree;

// In diagonals.
constexpr double near = 1e-3, very_near = 2e-4, near_corner = 5e-4;
constexpr double thin_original = 1e-6, thin_result = 1e-9;

constexpr double num_points = 20'000;

enum class Boundary { Counts, DoesNot };

// A mesh without copies, and its edges.
struct Edges {
    TriangleMesh mesh;
    std::vector<EdgeDihedral> all;

    [[nodiscard]] std::vector<EdgeDihedral> above(double angle, Boundary boundary) const {
        std::vector<EdgeDihedral> edges;
        std::copy_if(all.begin(), all.end(), std::back_inserter(edges), [&](const auto& e) {
            return e.num_faces == 1 ? boundary == Boundary::Counts : e.angle > angle;
        });
        return edges;
    }
    [[nodiscard]] std::vector<SegmentGrid::Segment> segments(
        const std::vector<EdgeDihedral>& edges) const {
        std::vector<SegmentGrid::Segment> result;
        for (const EdgeDihedral& e : edges) {
            result.emplace_back(mesh.positions[e.ends[0]], mesh.positions[e.ends[1]]);
        }
        return result;
    }
};

struct Box {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();

    [[nodiscard]] double diagonal() const { return (high - low).norm(); }
};

Box box_of(const TriangleMesh& mesh) {
    if (mesh.positions.empty()) return {};
    Box box{mesh.positions[0], mesh.positions[0]};
    for (const Vec3& p : mesh.positions) {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    return box;
}

double length_of(const std::vector<SegmentGrid::Segment>& segments) {
    double sum = 0;
    for (const auto& [a, b] : segments) sum += (b - a).norm();
    return sum;
}

// The parts of segments inside a box: what is far from all that is asked about needs no cells.
std::vector<SegmentGrid::Segment> inside(std::vector<SegmentGrid::Segment> segments,
                                         const Box& box) {
    std::size_t count = 0;
    for (const auto& [a, b] : segments) {
        double from = 0, to = 1;
        for (int k = 0; k < 3; ++k) {
            const double step = b[k] - a[k];
            const double x = (box.low[k] - a[k]) / step, y = (box.high[k] - a[k]) / step;
            if (step != 0) {
                from = std::max(from, std::min(x, y));
                to = std::min(to, std::max(x, y));
            } else if (a[k] < box.low[k] || a[k] > box.high[k]) {
                to = -1;
            }
        }
        if (from <= to)
            segments[count++] = SegmentGrid::Segment(a + from * (b - a), a + to * (b - a));
    }
    segments.resize(count);
    return segments;
}

// Shares of the segments' length that lie within two distances of the grid's segments.
struct Shares {
    double near = 0;
    double very_near = 0;
};

Shares shares_near(const std::vector<SegmentGrid::Segment>& segments, const SegmentGrid& grid,
                   double diagonal, agvd::Ticker& ticker) {
    const double total = length_of(segments);
    Shares lengths;
    for (const auto& [a, b] : segments) {
        const double length = (b - a).norm();
        const auto count =
            std::max(Index{1}, static_cast<Index>(std::lround(num_points * length / total)));
        Index num_near = 0, num_very_near = 0;
        for (Index i = 0; i < count; ++i) {
            ticker.tick(16);
            const double distance = grid.distance(a + ((i + 0.5) / count) * (b - a));
            if (distance <= near * diagonal) ++num_near;
            if (distance <= very_near * diagonal) ++num_very_near;
        }
        lengths.near += length * (static_cast<double>(num_near) / count);
        lengths.very_near += length * (static_cast<double>(num_very_near) / count);
    }
    return {lengths.near / total, lengths.very_near / total};
}

std::vector<Vec3> corners_of(const Edges& edges) {
    const auto& p = edges.mesh.positions;
    std::vector<std::pair<Index, Index>> ends;  // (vertex, neighbour).
    for (const EdgeDihedral& e : edges.above(sharp, Boundary::Counts)) {
        ends.emplace_back(e.ends[0], e.ends[1]);
        ends.emplace_back(e.ends[1], e.ends[0]);
    }
    std::sort(ends.begin(), ends.end());
    std::vector<Vec3> corners;
    for (std::size_t i = 0, j = 0; i < ends.size(); i = j) {
        while (j < ends.size() && ends[j].first == ends[i].first) ++j;
        const Vec3& here = p[ends[i].first];
        bool is_corner = j - i > 2;
        if (j - i == 2) {
            const Vec3 in = here - p[ends[i].second], out = p[ends[i + 1].second] - here;
            is_corner = std::atan2(in.cross(out).norm(), in.dot(out)) > corner_turn;
        }
        if (is_corner) corners.push_back(here);
    }
    return corners;
}

// How near the original's corners are vertices of the result.
Index count_kept(const std::vector<Vec3>& corners, const TriangleMesh& result, double reach,
                 agvd::Ticker& ticker) {
    std::vector<SegmentGrid::Segment> vertices;
    for (const Vec3& p : result.positions) vertices.emplace_back(p, p);
    const SegmentGrid grid(std::move(vertices), reach, ticker);
    return static_cast<Index>(std::count_if(corners.begin(), corners.end(), [&](const Vec3& p) {
        return std::isfinite(grid.distance(p));
    }));
}

}  // namespace

std::optional<FeatureCoverage> feature_coverage(const agvd::MeshView& original,
                                                const agvd::MeshView& result,
                                                const agvd::Progress& progress) {
    agvd::Poller poller(progress);
    agvd::Ticker ticker(poller);
    Edges before{detail::without_copies(original, ticker), {}};
    Box box = box_of(before.mesh);
    const double diagonal = box.diagonal();
    before.all = detail::edge_dihedrals(before.mesh.view(), thin_original * diagonal, ticker);
    const auto before_sharp = before.segments(before.above(sharp, Boundary::DoesNot));
    const std::vector<Vec3> corners = corners_of(before);
    if (before_sharp.empty() && corners.empty()) return std::nullopt;
    Edges after{detail::without_copies(result, ticker), {}};
    after.all = detail::edge_dihedrals(after.mesh.view(), thin_result * diagonal, ticker);
    const auto after_sharp = after.segments(after.above(sharp, Boundary::DoesNot));
    FeatureCoverage coverage{.length = length_of(before_sharp),
                             .result_length = length_of(after_sharp),
                             .corners = static_cast<Index>(corners.size()),
                             .diagonal = diagonal};
    const double reach = near * diagonal;
    if (!before_sharp.empty()) {
        box.low.array() -= 2 * reach;
        box.high.array() += 2 * reach;
        const SegmentGrid grid(inside(after.segments(after.above(blunt, Boundary::DoesNot)), box),
                               reach, ticker);
        const Shares shares = shares_near(before_sharp, grid, diagonal, ticker);
        coverage.covered = shares.near;
        coverage.covered_closely = shares.very_near;
    }
    if (!after_sharp.empty()) {
        const SegmentGrid grid(before.segments(before.above(blunt, Boundary::Counts)), reach,
                               ticker);
        coverage.false_share = 1 - shares_near(after_sharp, grid, diagonal, ticker).near;
    }
    coverage.corners_kept = count_kept(corners, after.mesh, near_corner * diagonal, ticker);
    return coverage;
}

}  // namespace remesh
