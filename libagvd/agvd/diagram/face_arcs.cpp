#include "agvd/diagram/face_arcs.h"

#include <algorithm>

#include "agvd/diagram/straight_arc.h"

namespace agvd {
namespace {

// One side of a triangle.
struct Side {
    Vec2 from, to;
    Index to_point;
    Block row;
    bool forward;    // Whether the crossings of the row run from `from` to `to`.
    bool is_across;  // Not the half-edge of which the crossings are.
};

class FaceTracer {
public:
    FaceTracer(const Surface& surface, const Propagation& propagation, const RelayGroups& groups,
               const EdgeLabels& labels, double chord_tolerance, FaceArcs& out)
        : surface_(surface),
          propagation_(propagation),
          labels_(labels),
          inside_relays_(surface, propagation, groups, labels),
          chord_tolerance_(chord_tolerance),
          solver_(chord_tolerance, out.local),
          out_(out) {}

    void trace(Index mixed_index) {
        begin_face(mixed_index);
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face_ + k;
            sides_[k] = mesh_side(h, corners_[k], corners_[(k + 1) % 3]);
        }
        trace_triangle(corners_, labels_.point_site[surface_.tail(3 * face_)]);
    }

    void trace_cut(const CutFace& cut) {
        begin_face(labels_.mixed_index[cut.face]);
        for (const CutTriangle& triangle : labels_.cut_triangles[cut.triangles]) {
            std::array<Vec2, 3> corners;
            for (std::size_t k = 0; k < 3; ++k) {
                corners[k] = position_of(labels_, corners_, triangle.points[k]);
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

    // Whether the last face asked no relays of others.
    [[nodiscard]] bool is_local() const { return !has_all_relays_; }

private:
    void begin_face(Index mixed_index) {
        mixed_index_ = mixed_index;
        face_ = propagation_.mixed_faces[mixed_index];
        corners_ = face_corners(surface_, face_);
        has_own_relays_ = has_all_relays_ = false;
    }

    [[nodiscard]] Side mesh_side(Index h, const Vec2& from, const Vec2& to) const {
        const Index edge = surface_.edge[h];
        const bool forward = surface_.edge_half[edge] == h;
        return {from, to, surface_.head(h), labels_.edge_rows[edge], forward, !forward};
    }

    [[nodiscard]] Side cut_side(const CutTriangle& triangle, std::size_t k,
                                const std::array<Vec2, 3>& corners) const {
        const Cut& cut = labels_.cuts[triangle.sides[k].cut()];
        const std::size_t next = (k + 1) % 3;
        return {corners[k],
                corners[next],
                triangle.points[next].point,
                cut.row,
                cut.from.point == triangle.points[k].point,
                false};
    }

    // `site`: that of its first corner.
    void trace_triangle(const std::array<Vec2, 3>& corners, Index site) {
        first_part_ = out_.parts.size();
        collect_breakpoints(site);
        if (breakpoints_.empty()) {
            if (site != no_index) out_.parts.push_back({site, 1, area_of(corners)});
            return;
        }
        boundary_parts_.assign(out_.parts.begin() + static_cast<std::ptrdiff_t>(first_part_),
                               out_.parts.end());
        const FaceArcs::Mark before = out_.mark();
        const bool is_plain = !has_all_relays_ && solve_by_one_arc(corners);
        if (!is_plain) {
            collect_sites();
            if (has_all_relays_ || !solve_by_own_relays(corners)) solve_by_all_relays(corners);
        }
        count_parts(before);
        // Arcs that lie on each other, or on a side, escape a search for crossings, but turn a
        // piece inside out.
        if (!is_plain && has_inverted_part(corners)) {
            solver_.redraw_straight(breakpoints_);
            out_.parts.resize(first_part_);
            out_.parts.insert(out_.parts.end(), boundary_parts_.begin(), boundary_parts_.end());
            count_parts(before);
        }
        name_nodes(before);
    }

    // Until here a breakpoint's node is its place in the row: a face that is glued to itself meets
    // one crossing at two breakpoints.
    void name_nodes(const FaceArcs::Mark& before) {
        for (std::size_t i = before.arcs; i < out_.local.arcs.size(); ++i) {
            LocalArc& arc = out_.local.arcs[i];
            for (const bool at_tail : {true, false}) {
                NodeId& node = at_tail ? arc.tail : arc.head;
                if (node.is_voronoi_vertex()) continue;
                const auto& [crossing, is_across] = nodes_[node.crossing()];
                (at_tail ? arc.tail_is_across : arc.head_is_across) = is_across;
                node = NodeId::of_crossing(crossing);
            }
        }
    }

    // What the triangle's arcs, all from a mark on, add to the cells.
    void count_parts(const FaceArcs::Mark& before) {
        for (const Breakpoint& breakpoint : breakpoints_) count(breakpoint.site_after, 1, 0);
        for (std::size_t i = before.connections; i < out_.local.connections.size(); ++i) {
            count(out_.local.connections[i].site, -1, 0);
        }
        for (Index i = before.arcs; i < out_.local.arcs.size(); ++i) add_area_beside(i);
    }

    [[nodiscard]] bool has_inverted_part(const std::array<Vec2, 3>& corners) const {
        constexpr double rounding = 1e-13;
        const double size = longest_side(corners);
        const auto first = out_.parts.begin() + static_cast<std::ptrdiff_t>(first_part_);
        return std::any_of(first, out_.parts.end(), [&](const FaceArcs::CellPart& part) {
            return part.area < -rounding * size * size;
        });
    }

    static double area_of(const std::array<Vec2, 3>& corners) {
        return cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
    }

    // Also adds what the boundary contributes to the areas, by Green's theorem.
    void collect_breakpoints(Index site) {
        breakpoints_.clear();
        nodes_.clear();
        for (const Side& side : sides_) {
            Vec2 last = side.from;
            for (Index j = 0; j < side.row.count; ++j) {
                const Index node = side.row.begin + (side.forward ? j : side.row.count - 1 - j);
                const Crossing& c = labels_.crossings[node];
                const double at = side.forward ? c.at : 1 - c.at;
                const Vec2 p = (1 - at) * side.from + at * side.to;
                count(site, 0, cross(last, p) / 2);
                site = side.forward ? c.site_after : c.site_before;
                const bool is_last = j + 1 == side.row.count;
                const IntervalId interval =
                    is_last ? IntervalId::to_point(side.to_point)
                            : IntervalId::after_crossing(side.forward ? node : node - 1);
                const auto place = static_cast<Index>(breakpoints_.size());
                breakpoints_.push_back({p, c.distance, NodeId::of_crossing(place), site, interval});
                nodes_.push_back({node, side.is_across});
                last = p;
            }
            // Without a breakpoint the area is that of the triangle.
            if (!breakpoints_.empty() || has_crossings_after(side)) {
                count(site, 0, cross(last, side.to) / 2);
            }
        }
    }

    [[nodiscard]] bool has_crossings_after(const Side& side) const {
        for (const Side* s = &side + 1; s < sides_.data() + 3; ++s) {
            if (s->row.count > 0) return true;
        }
        return false;
    }

    // As most faces are.
    [[nodiscard]] bool solve_by_one_arc(const std::array<Vec2, 3>& corners) {
        if (breakpoints_.size() != 2) return false;
        const Breakpoint& from = breakpoints_[0];
        const Breakpoint& to = breakpoints_[1];
        if (!joins_straight(relays_of(propagation_, mixed_index_), corners_, from, to,
                            largest_disagreement * longest_side(corners), chord_tolerance_)) {
            return false;
        }
        const auto num_points = static_cast<Index>(out_.local.points.size());
        out_.local.arcs.push_back(
            {face_, from.node, to.node, to.site_after, from.site_after, num_points, 0});
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
        if (!has_own_relays_) inside_relays_.gather_own(mixed_index_, own_relays_);
        has_own_relays_ = true;
        solver_.set_relays(own_relays_, sites_);
        return solver_.try_solve(face_, corners, breakpoints_);
    }

    void solve_by_all_relays(const std::array<Vec2, 3>& corners) {
        if (!has_all_relays_) inside_relays_.gather_all(mixed_index_, all_relays_);
        has_all_relays_ = true;
        solver_.set_relays(all_relays_, sites_);
        solver_.solve(face_, corners, breakpoints_);
    }

    void add_area_beside(Index i) {
        const LocalArc& arc = out_.local.arcs[i];
        const Vec2 head = node_position(arc.head);
        Vec2 last = node_position(arc.tail);
        double doubled = 0;
        for (Index j = arc.first_point; j < arc.first_point + arc.num_points; ++j) {
            doubled += cross(last, out_.local.points[j]);
            last = out_.local.points[j];
        }
        doubled += cross(last, head);
        count(arc.left, 0, doubled / 2);
        count(arc.right, 0, -doubled / 2);
    }

    [[nodiscard]] Vec2 node_position(NodeId node) const {
        if (node.is_voronoi_vertex()) {
            return out_.local.voronoi_vertices[node.voronoi_vertex()].position;
        }
        return breakpoints_[node.crossing()].position;
    }

    void count(Index site, int pieces, double area) {
        for (std::size_t i = first_part_; i < out_.parts.size(); ++i) {
            FaceArcs::CellPart& part = out_.parts[i];
            if (part.site != site) continue;
            part.pieces += pieces;
            part.area += area;
            return;
        }
        out_.parts.push_back({site, pieces, area});
    }

    const Surface& surface_;
    const Propagation& propagation_;
    const EdgeLabels& labels_;
    InsideRelays inside_relays_;
    double chord_tolerance_;
    TriangleSolver solver_;
    FaceArcs& out_;

    // The face at hand.
    Index mixed_index_ = 0;
    Index face_ = 0;
    std::array<Vec2, 3> corners_;
    bool has_own_relays_ = false, has_all_relays_ = false;
    std::vector<PlanarRelay> own_relays_, all_relays_;
    std::array<Side, 3> sides_;  // Of the triangle at hand.
    std::size_t first_part_ = 0;
    std::vector<FaceArcs::CellPart> boundary_parts_;  // What the boundary alone contributes.
    std::vector<Index> sites_;
    std::vector<Breakpoint> breakpoints_;
    struct Node {
        Index crossing;
        bool is_across;
    };
    std::vector<Node> nodes_;  // By breakpoint.
};

}  // namespace

void find_arcs(const StageInput& input, const RelayGroups& groups, const EdgeLabels& labels,
               std::span<const Index> mixed, FaceArcs& out) {
    out.clear();
    FaceTracer tracer(input.surface, input.propagation, groups, labels, input.chord_tolerance, out);
    Ticker ticker(input.poller);
    const auto comes_before = [](const CutFace& cut, Index face) { return cut.face < face; };
    auto cut = labels.cut_faces.begin();
    for (const Index i : mixed) {
        out.faces.push_back(out.mark());
        ticker.tick(1 + relays_of(input.propagation, i).size());
        const Index face = input.propagation.mixed_faces[i];
        cut = std::lower_bound(cut, labels.cut_faces.end(), face, comes_before);
        if (cut != labels.cut_faces.end() && cut->face == face) {
            tracer.trace_cut(*cut);
            out.is_local.push_back(0);  // Nor was it cut by its own alone.
        } else {
            tracer.trace(i);
            out.is_local.push_back(tracer.is_local() ? 1 : 0);
        }
    }
}

}  // namespace agvd
