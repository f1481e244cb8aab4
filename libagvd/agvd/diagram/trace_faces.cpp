// Tries three ways on each triangle: one straight arc; the face's own relays; the relays that are
// the nearest on its edges, which always give a result. The others count only if their arcs fit the
// labels on the edges and each other. What a triangle adds to areas follows from Green's theorem.
#include <algorithm>

#include "agvd/core/parallel.h"
#include "agvd/diagram/apollonius.h"
#include "agvd/diagram/gather_relays.h"
#include "agvd/diagram/stages.h"

namespace agvd {
namespace {

// One side of a triangle.
struct TriangleSide {
    Vec2 from, to;
    Index to_point;
    Block row;
    bool forward;    // Whether the crossings of the row run from `from` to `to`.
    bool is_across;  // Not the half-edge of which the crossings are.
};

// Sums up what one triangle adds to cells: the elements of `parts` from `first` on.
struct TriangleParts {
    std::vector<CellPart>& parts;
    std::size_t first;

    void add(Index site, int pieces, double area) {
        for (std::size_t i = first; i < parts.size(); ++i) {
            CellPart& part = parts[i];
            if (part.site != site) continue;
            part.pieces += pieces;
            part.area += area;
            return;
        }
        parts.push_back({site, pieces, area});
    }
};

// Appends the label changes on a side, and adds what the side contributes to areas.
// \param site  of its first point. Becomes that of its last one.
void follow_side(const EdgeLabels& labels, const TriangleSide& side, Index& site,
                 std::vector<Breakpoint>& breakpoints, TriangleParts parts) {
    Vec2 last = side.from;
    for (Index j = 0; j < side.row.count; ++j) {
        const Index crossing = side.row.begin + (side.forward ? j : side.row.count - 1 - j);
        const Crossing& c = labels.crossings[crossing];
        const double at = side.forward ? c.at : 1 - c.at;
        const Vec2 p = (1 - at) * side.from + at * side.to;
        parts.add(site, 0, cross(last, p) / 2);
        site = side.forward ? c.site_after : c.site_before;
        const bool is_last = j + 1 == side.row.count;
        const Index interval =
            is_last ? side.to_point : labels.node_after(side.forward ? crossing : crossing - 1);
        breakpoints.push_back(
            {p, c.distance, NodeId::of_crossing(crossing), site, interval, side.is_across});
        last = p;
    }
    parts.add(site, 0, cross(last, side.to) / 2);
}

Vec2 position_of(const Arcs& arcs, std::span<const Breakpoint> breakpoints, NodeId node,
                 bool is_across) {
    if (node.is_voronoi_vertex()) return arcs.voronoi_vertices[node.voronoi_vertex()].position;
    const auto is_it = [&](const Breakpoint& breakpoint) {
        return breakpoint.node == node && breakpoint.is_across == is_across;
    };
    return std::find_if(breakpoints.begin(), breakpoints.end(), is_it)->position;
}

// Adds what the arcs of the triangle contribute: to the areas, and to the number of pieces.
// \param since  where the triangle's arcs and connections begin.
void count_arcs(const Arcs& arcs, std::span<const Breakpoint> breakpoints, const Arcs::Mark& since,
                TriangleParts parts) {
    for (const Breakpoint& breakpoint : breakpoints) parts.add(breakpoint.site_after, 1, 0);
    for (std::size_t i = since.connections; i < arcs.connections.size(); ++i) {
        parts.add(arcs.connections[i].site, -1, 0);
    }
    for (std::size_t i = since.arcs; i < arcs.arcs.size(); ++i) {
        const Arc& arc = arcs.arcs[i];
        const Vec2 head = position_of(arcs, breakpoints, arc.head, arc.head_is_across);
        Vec2 last = position_of(arcs, breakpoints, arc.tail, arc.tail_is_across);
        double doubled = 0;
        for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
            doubled += cross(last, arcs.points[j]);
            last = arcs.points[j];
        }
        doubled += cross(last, head);
        parts.add(arc.left, 0, doubled / 2);
        parts.add(arc.right, 0, -doubled / 2);
    }
}

// Traces faces one after the other. One for each thread.
class FaceTracer {
public:
    FaceTracer(const StageInput& input, const EdgeLabels& labels, Arcs& out)
        : in_(input), labels_(labels), out_(out) {}

    void trace(Index mixed_index) {
        begin_face(mixed_index);
        is_shaped_later_ = in_.chord && propagation_.certified_error < infinity;
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face_ + k;
            sides_[k] = mesh_side(h, corners_[k], corners_[(k + 1) % 3]);
        }
        trace_triangle(corners_, labels_.point_site[surface_.tail(3 * face_)]);
    }

    void trace_cut(Index mixed_index, std::span<const CutTriangle> triangles) {
        begin_face(mixed_index);
        is_shaped_later_ = false;
        for (const CutTriangle& triangle : triangles) {
            std::array<Vec2, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = labels_.position_of(triangle.points[k], corners_);
            }
            for (std::size_t k = 0; k < 3; ++k) {
                sides_[k] = triangle.sides[k].is_cut()
                                ? cut_side(triangle, k, corners)
                                : mesh_side(triangle.sides[k].half_edge(), corners[k],
                                            corners[(k + 1) % 3]);
            }
            trace_triangle(corners, labels_.point_site[triangle.points[0].point]);
        }
    }

private:
    void begin_face(Index mixed_index) {
        mixed_index_ = mixed_index;
        face_ = propagation_.mixed_faces[mixed_index];
        corners_ = face_corners(surface_, face_);
        has_own_relays_ = has_all_relays_ = false;
    }

    [[nodiscard]] TriangleSide mesh_side(Index h, const Vec2& from, const Vec2& to) const {
        const auto [row, forward] = row_along(surface_, labels_, h);
        return {from, to, surface_.head(h), row, forward, !forward};
    }

    [[nodiscard]] TriangleSide cut_side(const CutTriangle& triangle, std::size_t k,
                                        const std::array<Vec2, 3>& corners) const {
        const auto [row, forward] = row_along(surface_, labels_, triangle, k);
        const std::size_t next = (k + 1) % 3;
        return {corners[k], corners[next], triangle.points[next].point, row, forward, false};
    }

    // \param site  of its first corner.
    void trace_triangle(const std::array<Vec2, 3>& corners, Index site) {
        if (std::all_of(sides_.begin(), sides_.end(),
                        [](const TriangleSide& side) { return side.row.count == 0; })) {
            const double area = cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
            if (site != no_index) out_.parts.push_back({site, 1, area});
            return;
        }
        const TriangleParts parts{out_.parts, out_.parts.size()};
        breakpoints_.clear();
        for (const TriangleSide& side : sides_) {
            follow_side(labels_, side, site, breakpoints_, parts);
        }
        boundary_parts_.assign(out_.parts.begin() + static_cast<std::ptrdiff_t>(parts.first),
                               out_.parts.end());
        const Arcs::Mark before = out_.mark();
        const bool is_plain = !has_all_relays_ && solve_by_one_arc(corners);
        if (!is_plain) {
            collect_sites();
            if (has_all_relays_ || !solve_by_own_relays(corners)) solve_by_all_relays(corners);
        }
        count_arcs(out_, breakpoints_, before, parts);
        // Arcs on each other, or on a side, do not cross, but turn a piece inside out.
        if (!is_plain && has_inverted_part(parts, corners)) {
            solver_.redraw_straight(breakpoints_);
            out_.parts.resize(parts.first);
            out_.parts.insert(out_.parts.end(), boundary_parts_.begin(), boundary_parts_.end());
            count_arcs(out_, breakpoints_, before, parts);
        }
    }

    [[nodiscard]] static bool has_inverted_part(const TriangleParts& parts,
                                                const std::array<Vec2, 3>& corners) {
        constexpr double rounding = 1e-13;
        const double size = longest_side(corners);
        return std::any_of(
            parts.parts.begin() + static_cast<std::ptrdiff_t>(parts.first), parts.parts.end(),
            [&](const CellPart& part) { return part.area < -rounding * size * size; });
    }

    // Suffices for most faces.
    [[nodiscard]] bool solve_by_one_arc(const std::array<Vec2, 3>& corners) {
        if (breakpoints_.size() != 2) return false;
        const Breakpoint& from = breakpoints_[0];
        const Breakpoint& to = breakpoints_[1];
        if (!is_shaped_later_ &&
            !joins_straight(relays_of(propagation_, mixed_index_), corners_, from, to,
                            largest_disagreement * longest_side(corners), in_.chord_tolerance)) {
            return false;
        }
        const auto num_points = size_of(out_.points);
        out_.arcs.push_back({face_, from.node, to.node, to.site_after, from.site_after, num_points,
                             0, from.is_across, to.is_across});
        return true;
    }

    void collect_sites() {
        sites_.clear();
        for (const Breakpoint& breakpoint : breakpoints_) {
            if (std::find(sites_.begin(), sites_.end(), breakpoint.site_after) == sites_.end()) {
                sites_.push_back(breakpoint.site_after);
            }
        }
    }

    [[nodiscard]] bool solve_by_own_relays(const std::array<Vec2, 3>& corners) {
        if (!has_own_relays_) gatherer_.gather_own(mixed_index_, own_relays_);
        has_own_relays_ = true;
        solver_.set_relays(own_relays_, sites_);
        return solver_.try_solve(face_, corners, breakpoints_);
    }

    void solve_by_all_relays(const std::array<Vec2, 3>& corners) {
        if (!has_all_relays_) gatherer_.gather_all(mixed_index_, all_relays_);
        has_all_relays_ = true;
        solver_.set_relays(all_relays_, sites_);
        solver_.solve(face_, corners, breakpoints_);
    }

    const StageInput& in_;
    const Surface& surface_ = in_.surface;
    const Propagation& propagation_ = in_.propagation;
    const EdgeLabels& labels_;
    Arcs& out_;
    RelayGatherer gatherer_{surface_, propagation_, labels_};
    TriangleSolver solver_{in_.chord_tolerance, out_};

    // The face at hand.
    std::array<Vec2, 3> corners_;
    std::vector<PlanarRelay> own_relays_, all_relays_;
    Index mixed_index_ = 0;
    Index face_ = 0;
    bool has_own_relays_ = false, has_all_relays_ = false;
    bool is_shaped_later_ = false;  // One arc is drawn by shape_arcs(), so it needs no points.

    // The triangle at hand.
    std::array<TriangleSide, 3> sides_;
    std::vector<Breakpoint> breakpoints_;
    std::vector<CellPart> boundary_parts_;  // What the boundary alone contributes.
    std::vector<Index> sites_;              // On the boundary.
};

constexpr Index faces_per_task = 128;

// Replaces `out` by the arcs of these faces.
void find_arcs(const StageInput& input, const EdgeLabels& labels, std::span<const Index> positions,
               Arcs& out) {
    out.go_back({});
    out.faces.clear();
    FaceTracer tracer(input, labels, out);
    Ticker ticker(input.poller);
    for (const Index i : positions) {
        const Arcs::Mark begin = out.mark();
        ticker.tick(1 + relays_of(input.propagation, i).size());
        const auto triangles = cut_triangles_of(labels, input.propagation.mixed_faces[i]);
        if (triangles.empty()) {
            tracer.trace(i);
        } else {
            tracer.trace_cut(i, triangles);
        }
        out.faces.push_back(out.since(begin));
    }
}

}  // namespace

void trace_faces(const StageInput& input, std::span<const Index> positions, DiagramParts& parts) {
    // Some chunks at a time, so that arcs are stored while they are in the cache.
    constexpr Index most = 64 * faces_per_task;
    std::vector<Arcs> chunks(num_chunks(most, faces_per_task));
    for (std::size_t begin = 0; begin < positions.size(); begin += most) {
        const auto some =
            positions.subspan(begin, std::min<std::size_t>(most, positions.size() - begin));
        const auto count = static_cast<Index>(some.size());
        const auto trace_chunk = [&](Index chunk, Index first, Index last) {
            find_arcs(input, parts.labels, some.subspan(first, last - first), chunks[chunk]);
        };
        parallel_chunks(count, faces_per_task, input.num_threads, trace_chunk, input.poller);
        input.poller.poll();
        for (Index i = 0; i < num_chunks(count, faces_per_task); ++i) {
            parts.arcs.append(
                chunks[i], some.subspan(std::size_t{i} * faces_per_task, chunks[i].faces.size()));
        }
        if (begin == 0 && some.size() < positions.size()) {
            parts.arcs.reserve_for(static_cast<double>(positions.size()) / most);
        }
    }
}

}  // namespace agvd
