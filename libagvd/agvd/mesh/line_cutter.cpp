#include "agvd/mesh/line_cutter.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/union_find.h"
#include "agvd/mesh/surface_points.h"

namespace agvd {
namespace {

// Shares of corners that differ by less are those of one point.
constexpr double same_place = 1e-12;

double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

}  // namespace

LineCutter::LineCutter(const Surface& surface, Ticker ticker)
    : surface_(surface), ticker_(ticker), on_edge_(surface.num_edges()) {
    result_.mesh.positions = surface_.mesh.positions;
    for (Index v = 0; v < surface_.num_vertices(); ++v) {
        const bool has_face = surface_.outgoing[v] != no_index;
        result_.points.push_back(has_face ? point_at(surface_, v) : SurfacePoint{});
    }
}

CutFaces LineCutter::run(const EachPolygon& each_polygon) {
    if (each_polygon) each_polygon_ = &each_polygon;
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const FacePiece& a, const FacePiece& b) { return a.face < b.face; });
    for (auto& points : on_edge_) std::sort(points.begin(), points.end());
    const std::span<const FacePiece> pieces = pieces_;
    std::size_t end = 0;
    for (Index f = 0; f < surface_.num_faces(); ++f) {
        const std::size_t begin = end;
        while (end < pieces.size() && pieces[end].face == f) ++end;
        ticker_.tick(1 + end - begin);
        cut_face(f, pieces.subspan(begin, end - begin));
    }
    return std::move(result_);
}

Index LineCutter::vertex_at(const SurfacePoint& point) {
    if (const auto vertex = vertex_of(surface_, point)) return *vertex;
    if (const auto h = half_edge_of(point)) {
        const Index edge = surface_.edge[*h];
        const bool forward = surface_.edge_half[edge] == *h;
        const double at = point.barycentric[forward ? Surface::next(*h) % 3 : *h % 3];
        for (const auto& [other, vertex] : on_edge_[edge]) {
            if (std::abs(other - at) <= same_place) return vertex;
        }
        on_edge_[edge].emplace_back(at, add_vertex(point));
        return on_edge_[edge].back().second;
    }
    std::vector<Index>& inside = inside_[point.face.value()];
    for (const Index vertex : inside) {
        const auto& b = result_.points[vertex].barycentric;
        if (std::abs(b[1] - point.barycentric[1]) <= same_place &&
            std::abs(b[2] - point.barycentric[2]) <= same_place) {
            return vertex;
        }
    }
    inside.push_back(add_vertex(point));
    return inside.back();
}

Index LineCutter::add_vertex(const SurfacePoint& point) {
    result_.points.push_back(point);
    result_.mesh.positions.push_back(position(surface_.mesh.view(), point));
    return static_cast<Index>(result_.points.size()) - 1;
}

void LineCutter::cut_face(Index face, std::span<const FacePiece> pieces) {
    points_.clear();
    links_.clear();
    add_sides(face);
    num_on_sides_ = static_cast<Index>(points_.size());
    if (num_on_sides_ == 3 && pieces.empty()) {
        add_triangles(face, {0, 1, 2});
        return;
    }
    for (const FacePiece& piece : pieces) {
        const Ends ends{local(face, piece.ends.first), local(face, piece.ends.second)};
        const Ends back{ends.second, ends.first};
        const bool is_side = std::find(links_.begin(), links_.end(), ends) != links_.end() ||
                             std::find(links_.begin(), links_.end(), back) != links_.end();
        if (!is_side) links_.push_back(ends);
    }
    connect();
    trace(face);
}

// Corners and the points on sides, counter-clockwise, and the links between them.
void LineCutter::add_sides(Index face) {
    constexpr std::array<std::array<double, 2>, 3> corners{{{0, 0}, {1, 0}, {0, 1}}};
    for (std::size_t k = 0; k < 3; ++k) {
        const Index h = 3 * face + static_cast<Index>(k);
        const Vec2 from(corners[k][0], corners[k][1]);
        const Vec2 to(corners[(k + 1) % 3][0], corners[(k + 1) % 3][1]);
        points_.push_back({surface_.tail(h), from});
        const auto& inner = on_edge_[surface_.edge[h]];
        const bool forward = surface_.edge_half[surface_.edge[h]] == h;
        for (std::size_t i = 0; i < inner.size(); ++i) {
            const auto& [at, vertex] = inner[forward ? i : inner.size() - 1 - i];
            const double share = forward ? at : 1 - at;
            points_.push_back({vertex, from + share * (to - from)});
        }
    }
    const auto count = static_cast<Index>(points_.size());
    for (Index i = 0; i < count; ++i) links_.emplace_back(i, i + 1 == count ? 0 : i + 1);
}

// The number of a vertex in the face, which is added if it lies inside.
Index LineCutter::local(Index face, Index vertex) {
    for (Index i = 0; i < points_.size(); ++i) {
        if (points_[i].vertex == vertex) return i;
    }
    const SurfacePoint at =
        seen_from(surface_, result_.points[vertex], face).value_or(result_.points[vertex]);
    points_.push_back({vertex, {at.barycentric[1], at.barycentric[2]}});
    return static_cast<Index>(points_.size()) - 1;
}

// Whether two links cross inside both.
bool LineCutter::do_cross(const Ends& s, const Ends& t) const {
    if (s.first == t.first || s.first == t.second || s.second == t.first || s.second == t.second) {
        return false;
    }
    const auto at = [&](Index i) { return points_[i].at; };
    const auto divides = [&](const Ends& line, const Ends& other) {
        return (turn(at(line.first), at(line.second), at(other.first)) < 0) !=
               (turn(at(line.first), at(line.second), at(other.second)) < 0);
    };
    return divides(s, t) && divides(t, s);
}

// Curves that reach no side are linked to what is around them by the shortest way.
void LineCutter::connect() {
    const auto count = static_cast<Index>(points_.size());
    UnionFind sets(count);
    for (const auto& [a, b] : links_) sets.unite(a, b);
    while (true) {
        Ends best{no_index, no_index};
        double least = infinity;
        for (Index a = num_on_sides_; a < count; ++a) {
            if (sets.root(a) == sets.root(0)) continue;
            for (Index b = 0; b < count; ++b) {
                if (sets.root(b) != sets.root(0)) continue;
                const double length = (points_[a].at - points_[b].at).squaredNorm();
                const Ends link{a, b};
                if (!(length < least) ||
                    std::any_of(links_.begin(), links_.end(),
                                [&](const Ends& other) { return do_cross(link, other); })) {
                    continue;
                }
                least = length;
                best = link;
            }
        }
        if (best.first == no_index) return;
        links_.push_back(best);
        sets.unite(best.first, best.second);
    }
}

// Follows links with their face on the left. The walk around the outside is left out.
void LineCutter::trace(Index face) {
    const auto count = static_cast<Index>(points_.size());
    std::vector<std::vector<Index>> around(count);  // Counter-clockwise neighbours.
    for (const auto& [a, b] : links_) {
        around[a].push_back(b);
        around[b].push_back(a);
    }
    for (Index i = 0; i < count; ++i) {
        const Vec2 centre = points_[i].at;
        const auto is_upper = [&](const Vec2& d) { return d.y() > 0 || (d.y() == 0 && d.x() > 0); };
        std::sort(around[i].begin(), around[i].end(), [&](Index a, Index b) {
            const Vec2 p = points_[a].at - centre, q = points_[b].at - centre;
            if (is_upper(p) != is_upper(q)) return is_upper(p);
            const double sine = cross(p, q);
            return sine != 0 ? sine > 0 : a < b;
        });
    }
    std::vector<Ends> seen;
    for (Index i = 0; i < num_on_sides_; ++i) {  // Outside.
        seen.emplace_back(i + 1 == num_on_sides_ ? 0 : i + 1, i);
    }
    for (const auto& [a, b] : links_) {
        for (const Ends& start : {Ends{a, b}, Ends{b, a}}) {
            std::vector<Index> polygon;
            Ends link = start;
            while (std::find(seen.begin(), seen.end(), link) == seen.end()) {
                seen.push_back(link);
                polygon.push_back(link.first);
                const std::vector<Index>& next = around[link.second];
                const auto back = std::find(next.begin(), next.end(), link.first);
                link = {link.second, back == next.begin() ? next.back() : *(back - 1)};
            }
            if (polygon.size() >= 3) add_triangles(face, std::move(polygon));
        }
    }
}

// Quality of an ear: its area over the squares of its sides, in the face's own plane; none if
// it turns clockwise, or if another point lies in it.
double LineCutter::quality(Index face, const std::vector<Index>& polygon, std::size_t i) const {
    constexpr double rounding = 1e-13;
    const std::size_t n = polygon.size();
    const std::array corners{polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n]};
    const Vec2 a = points_[corners[0]].at, b = points_[corners[1]].at, c = points_[corners[2]].at;
    const double area = turn(a, b, c);
    if (!(area > 0)) return -1;
    for (const Index other : polygon) {
        if (std::find(corners.begin(), corners.end(), other) != corners.end()) continue;
        const Vec2 p = points_[other].at;
        if (turn(a, b, p) > -rounding && turn(b, c, p) > -rounding && turn(c, a, p) > -rounding) {
            return 0;
        }
    }
    const auto in_plane = [&](const Vec2& p) {
        return Vec2(p.y() * surface_.apex[3 * face] +
                    Vec2(p.x() * surface_.length_of(3 * face), 0));
    };
    const Vec2 pa = in_plane(a), pb = in_plane(b), pc = in_plane(c);
    return turn(pa, pb, pc) /
           ((pb - pa).squaredNorm() + (pc - pb).squaredNorm() + (pa - pc).squaredNorm());
}

void LineCutter::add_triangles(Index face, std::vector<Index> polygon) {
    if (each_polygon_ != nullptr) {
        std::vector<Index> vertices;
        vertices.reserve(polygon.size());
        for (const Index i : polygon) vertices.push_back(points_[i].vertex);
        (*each_polygon_)(face, vertices, static_cast<Index>(polygon.size()) - 2);
    }
    while (polygon.size() >= 3) {
        std::size_t best = 1;  // Of a triangle: in the order of its corners.
        double most = -infinity;
        for (std::size_t i = 0; polygon.size() > 3 && i < polygon.size(); ++i) {
            const double here = quality(face, polygon, i);
            if (here > most) {
                most = here;
                best = i;
            }
        }
        const std::size_t n = polygon.size();
        result_.mesh.triangles.push_back({points_[polygon[(best + n - 1) % n]].vertex,
                                          points_[polygon[best]].vertex,
                                          points_[polygon[(best + 1) % n]].vertex});
        result_.face_origin.push_back(face);
        polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
    }
}

}  // namespace agvd
