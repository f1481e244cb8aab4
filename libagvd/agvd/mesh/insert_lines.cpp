// Segments of lines in a face are divided where they meet others, and those along an edge at the
// vertices on it; then the faces are cut along them (line_cutter.h).
#include "agvd/mesh/cut_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/mesh/line_cutter.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// As shares of corners, and of segments: what is nearer lies on a line or at an end.
constexpr double touching = 1e-12;

// A vertex at a share of the way along a segment or an edge.
using VertexAt = std::pair<double, Index>;

struct LineSegment {
    Index line;
    Index face;
    std::array<Index, 2> vertices;
    std::array<Vec2, 2> ends;          // The shares of corners 1 and 2 of the face.
    Index edge = no_index;             // Along which it runs.
    std::vector<VertexAt> meets = {};  // Between the ends.
};

class LineInserter {
public:
    LineInserter(const Surface& surface, Ticker ticker)
        : surface_(surface), ticker_(ticker), cutter_(surface, ticker) {}

    MeshWithLines run(std::span<const std::vector<SurfacePoint>> lines) {
        for (Index line = 0; line < lines.size(); ++line) {
            check_sites(surface_, lines[line]);
            for (std::size_t i = 0; i + 1 < lines[line].size(); ++i) {
                add_segment(line, i, lines[line][i], lines[line][i + 1]);
            }
        }
        divide_where_they_meet();
        MeshWithLines result;
        result.chains.resize(lines.size());
        for (LineSegment& segment : segments_) put(segment, result.chains[segment.line]);
        result.cut = cutter_.run();
        return result;
    }

private:
    void add_segment(Index line, std::size_t number, const SurfacePoint& from,
                     const SurfacePoint& to) {
        ticker_.tick(16);
        const Index face = common_faces(surface_, from, to).first;
        const std::array<Index, 2> vertices{place(from), place(to)};
        if (vertices[0] == vertices[1]) return;
        if (face == no_index) {
            throw InvalidInput("points " + std::to_string(number) + " and " +
                               std::to_string(number + 1) + " of line " + std::to_string(line) +
                               " share no face; add the points where the line crosses edges");
        }
        LineSegment segment{line, face, vertices, {}};
        std::array<SurfacePoint, 2> seen{*seen_from(surface_, from, face),
                                         *seen_from(surface_, to, face)};
        for (std::size_t k = 0; k < 2; ++k) {
            segment.ends[k] = {seen[k].barycentric[1], seen[k].barycentric[2]};
        }
        for (Index k = 0; k < 3; ++k) {  // Opposite to corner k lies half-edge k + 1.
            if (seen[0].barycentric[k] == 0 && seen[1].barycentric[k] == 0) {
                segment.edge = surface_.edge[3 * face + (k + 1) % 3];
            }
        }
        segments_.push_back(std::move(segment));
    }

    // The vertex at a point. Those on edges are noted.
    Index place(const SurfacePoint& point) {
        const Index vertex = cutter_.vertex_at(point);
        if (vertex_of(surface_, point)) return vertex;
        if (const auto h = half_edge_of(point)) {
            const Index edge = surface_.edge[*h];
            const bool forward = surface_.edge_half[edge] == *h;
            const Index head = forward ? Surface::next(*h) : *h;
            on_edge_[edge].emplace_back(point.barycentric[head % 3], vertex);
        }
        return vertex;
    }

    // Segments inside one face.
    void divide_where_they_meet() {
        std::vector<Index> order;
        for (Index i = 0; i < segments_.size(); ++i) {
            if (segments_[i].edge == no_index) order.push_back(i);
        }
        std::stable_sort(order.begin(), order.end(),
                         [&](Index a, Index b) { return segments_[a].face < segments_[b].face; });
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t j = i + 1; j < order.size(); ++j) {
                if (segments_[order[j]].face != segments_[order[i]].face) break;
                ticker_.tick();
                meet(segments_[order[i]], segments_[order[j]]);
            }
        }
    }

    void meet(LineSegment& a, LineSegment& b) {
        for (std::size_t k = 0; k < 2; ++k) {
            touch(a, b.ends[k], b.vertices[k]);
            touch(b, a.ends[k], a.vertices[k]);
        }
        for (const Index v : a.vertices) {
            if (v == b.vertices[0] || v == b.vertices[1]) return;
        }
        const Vec2 along = a.ends[1] - a.ends[0], other = b.ends[1] - b.ends[0];
        const double sine = cross(along, other);
        if (!(std::abs(sine) > touching * along.norm() * other.norm())) return;
        const Vec2 between = b.ends[0] - a.ends[0];
        const double at_a = cross(between, other) / sine, at_b = cross(between, along) / sine;
        const auto is_inside = [](double at) { return at > touching && at < 1 - touching; };
        if (!is_inside(at_a) || !is_inside(at_b)) return;
        const Vec2 p = a.ends[0] + at_a * along;
        if (has_vertex_at(a, at_a) && has_vertex_at(b, at_b)) return;  // An end that touches.
        const Index vertex = cutter_.vertex_at({FaceId(a.face), {1 - p.x() - p.y(), p.x(), p.y()}});
        a.meets.emplace_back(at_a, vertex);
        b.meets.emplace_back(at_b, vertex);
    }

    static bool has_vertex_at(const LineSegment& segment, double at) {
        return std::any_of(segment.meets.begin(), segment.meets.end(), [&](const VertexAt& met) {
            return std::abs(met.first - at) <= 2 * touching;
        });
    }

    // Divides a segment at the end of another one that lies on it.
    static void touch(LineSegment& segment, const Vec2& p, Index vertex) {
        if (vertex == segment.vertices[0] || vertex == segment.vertices[1]) return;
        const Vec2 along = segment.ends[1] - segment.ends[0];
        const Vec2 to = p - segment.ends[0];
        const double at = to.dot(along) / along.squaredNorm();
        if (!(at > touching && at < 1 - touching)) return;
        if (!(std::abs(cross(along, to)) <= touching * along.norm())) return;
        segment.meets.emplace_back(at, vertex);
    }

    // Adds the pieces of a segment to the cuts, and its vertices to a chain.
    void put(LineSegment& segment, std::vector<Index>& chain) {
        if (segment.edge != no_index) find_vertices_along(segment);
        std::sort(segment.meets.begin(), segment.meets.end());
        if (chain.empty()) chain.push_back(segment.vertices[0]);
        Index last = segment.vertices[0];
        segment.meets.emplace_back(1, segment.vertices[1]);
        for (const auto& [at, vertex] : segment.meets) {
            if (vertex == last) continue;
            if (segment.edge == no_index) cutter_.add_piece(segment.face, last, vertex);
            chain.push_back(vertex);
            last = vertex;
        }
    }

    // Those of all lines between the ends of a segment along an edge.
    void find_vertices_along(LineSegment& segment) const {
        const auto found = on_edge_.find(segment.edge);
        if (found == on_edge_.end()) return;
        const Index h = surface_.edge_half[segment.edge];
        const auto share_of = [&](Index vertex) {
            if (vertex == surface_.tail(h)) return 0.0;
            for (const auto& [share, other] : found->second) {
                if (other == vertex) return share;
            }
            return 1.0;
        };
        const double from = share_of(segment.vertices[0]), to = share_of(segment.vertices[1]);
        for (const auto& [share, vertex] : found->second) {
            const double at = (share - from) / (to - from);
            if (at > 0 && at < 1) segment.meets.emplace_back(at, vertex);
        }
    }

    const Surface& surface_;
    Ticker ticker_;
    LineCutter cutter_;
    std::vector<LineSegment> segments_;
    std::map<Index, std::vector<VertexAt>> on_edge_;  // By edge: along its edge_half.
};

}  // namespace

MeshWithLines insert_lines(const Surface& surface, std::span<const std::vector<SurfacePoint>> lines,
                           const Progress& progress) {
    Poller poller(progress);
    return LineInserter(surface, Ticker(poller)).run(lines);
}

std::vector<Index> edges_along(const Surface& surface, std::span<const Index> chain) {
    std::vector<Index> edges;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        Index found = no_index;
        if (chain[i] < surface.num_vertices()) {
            for_each_edge_at(surface, chain[i], [&](Index h, Index other) {
                if (other == chain[i + 1]) found = surface.edge[h];
            });
        }
        if (found == no_index) {
            throw InvalidInput("no edge joins vertices " + std::to_string(chain[i]) + " and " +
                               std::to_string(chain[i + 1]) + "; name vertices along edges");
        }
        edges.push_back(found);
    }
    return edges;
}

}  // namespace agvd
