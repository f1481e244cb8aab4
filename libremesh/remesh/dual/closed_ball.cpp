// Four passes: cells, cells at the boundary, pairs, triples ([edelsbrunner1997]). Each violation
// names points at which new sites help.
#include "remesh/dual/closed_ball.h"

#include <algorithm>

#include "agvd/diagram/diagram.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

// Relative to the distance from the sites. Voronoi vertices are Newton solutions with errors of
// about 1e-12, or more where bisectors meet at a small angle.
constexpr double relative_length = 1e-8;

bool is_inner_vertex(const Diagram& diagram, Index vertex) {
    for (Index i = diagram.vertex_offsets[vertex]; i < diagram.vertex_offsets[vertex + 1]; ++i) {
        if (!diagram.vertex_sites[i].is_valid()) return false;
    }
    return true;
}

class ClosedBallCheck {
public:
    ClosedBallCheck(const Surface& surface, const Diagram& diagram, Ticker ticker)
        : surface_(surface),
          diagram_(diagram),
          ticker_(ticker),
          cells_(build_cells(diagram, ticker)),
          is_degenerate_(find_degenerate_edges(surface, diagram, ticker)) {}

    std::vector<ClosedBallViolation> run() {
        check_discs();
        check_boundary();
        check_pairs();
        check_triples();
        return std::move(found_);
    }

private:
    void report(SiteId site, SiteId other, SiteReason reason, std::vector<SurfacePoint> remedies) {
        found_.push_back({site, other, reason, std::move(remedies), false});
    }

    // The point of an edge farthest from its sites.
    [[nodiscard]] Index farthest_point(Index edge) const {
        Index best = diagram_.edge_points[edge];
        for (Index i = best; i < diagram_.edge_points[edge + 1]; ++i) {
            if (diagram_.point_distance[i] > diagram_.point_distance[best]) best = i;
        }
        return best;
    }

    // The middle one of the edge's points, which is away from both ends.
    [[nodiscard]] const SurfacePoint& middle_point(Index edge) const {
        const Index begin = diagram_.edge_points[edge];
        return diagram_.points[begin + (diagram_.edge_points[edge + 1] - begin) / 2];
    }

    void check_discs() {
        for (Index s = 0; s < diagram_.num_sites; ++s) {
            ticker_.tick();
            const Index first = cells_.cell_loops[s];
            const Index num_loops = cells_.cell_loops[s + 1] - first;
            const bool is_empty =
                num_loops == 0 && diagram_.cell_euler[s] == 0 && !(diagram_.cell_area[s] > 0);
            if (is_empty || (num_loops == 1 && diagram_.cell_euler[s] == 1)) continue;
            if (num_loops == 0) {
                report(SiteId(s), {}, SiteReason::WholeComponent, {farthest_vertex(SiteId(s))});
            } else {
                report(SiteId(s), {}, SiteReason::NoDisc, {farthest_on_loops(s)});
            }
        }
    }

    [[nodiscard]] SurfacePoint farthest_vertex(SiteId site) {
        Index best = no_index;
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            ticker_.tick();
            if (diagram_.nearest_site[v] != site || surface_.outgoing[v] == no_index) continue;
            if (best == no_index ||
                diagram_.nearest_distance[v] > diagram_.nearest_distance[best]) {
                best = v;
            }
        }
        return point_at(surface_, best == no_index ? 0 : best);
    }

    // A cell that is not a disc surrounds a hole, a handle or other cells. Its front meets itself
    // where it is farthest from the site: at the farthest point of its loops.
    [[nodiscard]] SurfacePoint farthest_on_loops(Index site) const {
        Index best = no_index;
        const Index begin = cells_.loop_edges[cells_.cell_loops[site]];
        const Index end = cells_.loop_edges[cells_.cell_loops[site + 1]];
        for (Index i = begin; i < end; ++i) {
            const Index point = farthest_point(cells_.edges[i].edge);
            if (best == no_index ||
                diagram_.point_distance[point] > diagram_.point_distance[best]) {
                best = point;
            }
        }
        return diagram_.points[best];
    }

    void check_boundary() {
        std::vector<Index> arcs(diagram_.num_sites, 0);
        for (Index e = 0; e < diagram_.edges.size(); ++e) {
            const VoronoiEdge& edge = diagram_.edges[e];
            if (edge.right.is_valid()) {
                if (edge.tail != no_index && !is_inner_vertex(diagram_, edge.tail) &&
                    !is_inner_vertex(diagram_, edge.head)) {
                    // The sites go to the ends: a new site between them would meet both sides too,
                    // and so would the next.
                    report(edge.left, edge.right, SiteReason::BoundaryAtBothEnds,
                           {diagram_.vertices[edge.tail], diagram_.vertices[edge.head]});
                    found_.back().is_at_boundary = true;
                }
            } else if (++arcs[edge.left.value()] > 1) {
                report(edge.left, {}, SiteReason::BoundaryTwice, {middle_point(e)});
                found_.back().is_at_boundary = true;
            }
        }
    }

    // Reports all arcs between two cells but the longest.
    void check_pairs() {
        struct Shared {
            SiteId a, b;
            double length;
            Index edge;
        };
        std::vector<Shared> arcs;
        for (Index e = 0; e < diagram_.edges.size(); ++e) {
            const VoronoiEdge& edge = diagram_.edges[e];
            ticker_.tick(1 + diagram_.edge_points[e + 1] - diagram_.edge_points[e]);
            if (!edge.right.is_valid() || is_degenerate_[e]) continue;
            if (edge.tail == no_index) {
                report(edge.left, edge.right, SiteReason::ClosedCurve,
                       {diagram_.points[farthest_point(e)]});
            }
            arcs.push_back({std::min(edge.left, edge.right), std::max(edge.left, edge.right),
                            curve_length(surface_, diagram_, e), e});
        }
        sort_ticked(arcs, ticker_, [](const Shared& x, const Shared& y) {
            if (x.a != y.a) return x.a < y.a;
            if (x.b != y.b) return x.b < y.b;
            return x.length != y.length ? x.length > y.length : x.edge < y.edge;
        });
        for (std::size_t i = 1; i < arcs.size(); ++i) {
            if (arcs[i].a != arcs[i - 1].a || arcs[i].b != arcs[i - 1].b) continue;
            report(arcs[i].a, arcs[i].b, SiteReason::SeveralArcs, {middle_point(arcs[i].edge)});
        }
    }

    void check_triples() {
        struct Corner {
            std::array<Index, 3> sites;
            Index vertex;
        };
        std::vector<Corner> corners;
        for (Index v = 0; v < diagram_.vertices.size(); ++v) {
            ticker_.tick();
            const Index begin = diagram_.vertex_offsets[v];
            if (diagram_.vertex_offsets[v + 1] - begin != 3 || !is_inner_vertex(diagram_, v))
                continue;
            if (is_degenerate_[diagram_.vertex_ends[begin].edge] ||
                is_degenerate_[diagram_.vertex_ends[begin + 1].edge] ||
                is_degenerate_[diagram_.vertex_ends[begin + 2].edge]) {
                continue;
            }
            Corner corner{
                {diagram_.vertex_sites[begin].value(), diagram_.vertex_sites[begin + 1].value(),
                 diagram_.vertex_sites[begin + 2].value()},
                v};
            std::sort(corner.sites.begin(), corner.sites.end());
            corners.push_back(corner);
        }
        sort_ticked(corners, ticker_, [&](const Corner& x, const Corner& y) {
            if (x.sites != y.sites) return x.sites < y.sites;
            return diagram_.vertex_distance[x.vertex] < diagram_.vertex_distance[y.vertex];
        });
        for (std::size_t i = 1; i < corners.size(); ++i) {
            if (corners[i].sites != corners[i - 1].sites) continue;
            report(SiteId(corners[i].sites[0]), SiteId(corners[i].sites[1]),
                   SiteReason::SameThirdCell, {diagram_.vertices[corners[i].vertex]});
        }
    }

    const Surface& surface_;
    const Diagram& diagram_;
    Ticker ticker_;
    Cells cells_;
    std::vector<bool> is_degenerate_;
    std::vector<ClosedBallViolation> found_;
};

}  // namespace

std::vector<ClosedBallViolation> find_closed_ball_violations(const Surface& surface,
                                                             const Diagram& diagram,
                                                             const Progress& progress) {
    Poller poller(progress);
    return ClosedBallCheck(surface, diagram, Ticker(poller)).run();
}

std::vector<bool> find_degenerate_edges(const Surface& surface, const Diagram& diagram,
                                        Ticker ticker) {
    std::vector<bool> result(diagram.edges.size(), false);
    for (Index e = 0; e < diagram.edges.size(); ++e) {
        const VoronoiEdge& edge = diagram.edges[e];
        ticker.tick(1 + diagram.edge_points[e + 1] - diagram.edge_points[e]);
        if (edge.tail == no_index || edge.tail == edge.head || !edge.right.is_valid()) continue;
        if (!is_inner_vertex(diagram, edge.tail) || !is_inner_vertex(diagram, edge.head)) continue;
        result[e] = curve_length(surface, diagram, e) <=
                    relative_length * diagram.vertex_distance[edge.tail];
    }
    return result;
}

}  // namespace remesh
