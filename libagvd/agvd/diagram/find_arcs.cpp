// Tries three ways on each triangle, the quickest first: one straight arc; the face's own relays;
// the relays that are the nearest on the triangle's edges. A way counts only if its arcs fit the
// labels on the edges and each other; otherwise what it wrote is taken back. The last way always
// gives a result.
#include "agvd/diagram/find_arcs.h"

#include <algorithm>

#include "agvd/diagram/apollonius.h"
#include "agvd/diagram/inside_relays.h"
#include "agvd/diagram/straight_arc.h"
#include "agvd/diagram/triangle_boundary.h"

namespace agvd {
namespace {

// Traces faces one after the other. One for each thread.
class FaceTracer {
public:
    FaceTracer(const StageInput& input, const EdgeLabels& labels, FaceArcs& out)
        : surface_(input.surface),
          propagation_(input.propagation),
          labels_(labels),
          inside_relays_(input.surface, input.propagation, labels),
          chord_tolerance_(input.chord_tolerance),
          solver_(input.chord_tolerance, out.local),
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

    // Whether the arcs of the last face depend on its own relays only.
    [[nodiscard]] bool is_local() const { return !has_all_relays_; }

private:
    void begin_face(Index mixed_index) {
        mixed_index_ = mixed_index;
        face_ = propagation_.mixed_faces[mixed_index];
        corners_ = face_corners(surface_, face_);
        has_own_relays_ = has_all_relays_ = false;
    }

    [[nodiscard]] TriangleSide mesh_side(Index h, const Vec2& from, const Vec2& to) const {
        const Index edge = surface_.edge[h];
        const bool forward = surface_.edge_half[edge] == h;
        return {from, to, surface_.head(h), labels_.edge_rows[edge], forward, !forward};
    }

    [[nodiscard]] TriangleSide cut_side(const CutTriangle& triangle, std::size_t k,
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

    // \param site  of its first corner.
    void trace_triangle(const std::array<Vec2, 3>& corners, Index site) {
        const TriangleParts parts{out_.parts, out_.parts.size()};
        collect_breakpoints(labels_, sides_, site, boundary_, parts);
        if (boundary_.breakpoints.empty()) {
            if (site != no_index) out_.parts.push_back({site, 1, area_of(corners)});
            return;
        }
        boundary_parts_.assign(out_.parts.begin() + static_cast<std::ptrdiff_t>(parts.first),
                               out_.parts.end());
        const LocalDiagram::Mark before = out_.local.mark();
        const bool is_plain = !has_all_relays_ && solve_by_one_arc(corners);
        if (!is_plain) {
            collect_sites();
            if (has_all_relays_ || !solve_by_own_relays(corners)) solve_by_all_relays(corners);
        }
        count_arcs(boundary_, out_.local, before, parts);
        // Arcs that lie on each other, or on a side, escape a search for crossings, but turn a
        // piece inside out.
        if (!is_plain && has_inverted_part(parts, corners)) {
            solver_.redraw_straight(boundary_.breakpoints);
            out_.parts.resize(parts.first);
            out_.parts.insert(out_.parts.end(), boundary_parts_.begin(), boundary_parts_.end());
            count_arcs(boundary_, out_.local, before, parts);
        }
        name_nodes(boundary_, before.arcs, out_.local);
    }

    [[nodiscard]] static double area_of(const std::array<Vec2, 3>& corners) {
        return cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
    }

    [[nodiscard]] static bool has_inverted_part(const TriangleParts& parts,
                                                const std::array<Vec2, 3>& corners) {
        constexpr double rounding = 1e-13;
        const double size = longest_side(corners);
        return std::any_of(
            parts.parts.begin() + static_cast<std::ptrdiff_t>(parts.first), parts.parts.end(),
            [&](const FaceArcs::CellPart& part) { return part.area < -rounding * size * size; });
    }

    // Suffices for most faces.
    [[nodiscard]] bool solve_by_one_arc(const std::array<Vec2, 3>& corners) {
        if (boundary_.breakpoints.size() != 2) return false;
        const Breakpoint& from = boundary_.breakpoints[0];
        const Breakpoint& to = boundary_.breakpoints[1];
        if (!joins_straight(relays_of(propagation_, mixed_index_), corners_, from, to,
                            {largest_disagreement * longest_side(corners), chord_tolerance_})) {
            return false;
        }
        const auto num_points = static_cast<Index>(out_.local.points.size());
        out_.local.arcs.push_back(
            {face_, from.node, to.node, to.site_after, from.site_after, num_points, 0});
        return true;
    }

    void collect_sites() {
        sites_.clear();
        for (const Breakpoint& breakpoint : boundary_.breakpoints) {
            if (std::find(sites_.begin(), sites_.end(), breakpoint.site_after) == sites_.end()) {
                sites_.push_back(breakpoint.site_after);
            }
        }
    }

    [[nodiscard]] bool solve_by_own_relays(const std::array<Vec2, 3>& corners) {
        if (!has_own_relays_) inside_relays_.gather_own(mixed_index_, own_relays_);
        has_own_relays_ = true;
        solver_.set_relays(own_relays_, sites_);
        return solver_.try_solve(face_, corners, boundary_.breakpoints);
    }

    void solve_by_all_relays(const std::array<Vec2, 3>& corners) {
        if (!has_all_relays_) inside_relays_.gather_all(mixed_index_, all_relays_);
        has_all_relays_ = true;
        solver_.set_relays(all_relays_, sites_);
        solver_.solve(face_, corners, boundary_.breakpoints);
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

    // The triangle at hand.
    std::array<TriangleSide, 3> sides_;
    TriangleBoundary boundary_;
    std::vector<FaceArcs::CellPart> boundary_parts_;  // What the boundary alone contributes.
    std::vector<Index> sites_;                        // On the boundary.
};

}  // namespace

void find_arcs(const StageInput& input, const EdgeLabels& labels, std::span<const Index> mixed,
               FaceArcs& out) {
    out.clear();
    FaceTracer tracer(input, labels, out);
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
            out.is_local.push_back(0);  // Its cuts depend on others.
        } else {
            tracer.trace(i);
            out.is_local.push_back(tracer.is_local() ? 1 : 0);
        }
    }
}

}  // namespace agvd
