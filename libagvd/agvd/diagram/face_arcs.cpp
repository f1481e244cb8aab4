#include "agvd/diagram/face_arcs.h"

#include <algorithm>
#include <cmath>

namespace agvd {
namespace {

// A label change on a side of a triangle, seen along the side.
struct SideCrossing {
    double at;
    double distance;
    Index node;
    Index site_before, site_after;
    Index interval_before, interval_after;
};

struct Side {
    Index from, to;  // Points of the face's local triangulation, from < to.
    std::vector<SideCrossing> crossings;
};

// Images nearer to an edge (share of its length) lie on it.
constexpr double on_edge = 1e-12;

class FaceTracer {
public:
    FaceTracer(const Surface& surface, const Propagation& propagation,
               const SitePlacement& placement, const EdgeLabels& labels,
               std::span<const BarredSite> barred, double chord_tolerance, FaceArcs& out)
        : surface_(surface),
          propagation_(propagation),
          placement_(placement),
          labels_(labels),
          barred_(barred),
          chord_tolerance_(chord_tolerance),
          out_(out) {}

    void trace(Index mixed_index) {
        face_ = propagation_.mixed_faces[mixed_index];
        gather_corners();
        gather_relays(mixed_index);
        triangulate_at_sites();
        const std::size_t first_part = out_.parts.size();
        const std::size_t first_piece = out_.local.pieces.size();
        const std::size_t first_arc = out_.local.arcs.size();
        if (triangles_.size() > 1) cut_inside(mixed_index);
        for (const Triangle& triangle : triangles_) solve(triangle);
        for (std::size_t i = first_piece; i < out_.local.pieces.size(); ++i) {
            const auto& [site, change] = out_.local.pieces[i];
            out_.parts.push_back({site, change, 0});
        }
        add_areas(first_arc);
        merge_parts(first_part);
        out_.arc_face.resize(out_.local.arcs.size(), face_);
        out_.branch_face.resize(out_.local.branches.size(), face_);
        out_.inner_face.resize(out_.inner.size(), face_);
    }

private:
    void gather_corners() {
        const auto corners = face_corners(surface_, face_);
        points_.assign(corners.begin(), corners.end());
        point_site_.clear();
        point_name_.clear();
        for (const Index v : surface_.mesh.triangles[face_]) {
            point_site_.push_back(labels_.vertex_site[v]);
            point_name_.push_back(vertex_name(v));
        }
        sides_.clear();
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * face_ + k;
            const Index edge = surface_.edge[h];
            const bool forward = surface_.edge_half[edge] == h;
            // Sides run from the lower to the higher corner, so 2 -> 0 is turned.
            const bool along = forward == (k != 2);
            Side& side = sides_.emplace_back();
            side.from = k == 2 ? 0 : k;
            side.to = k == 2 ? 2 : k + 1;
            const auto crossings = labels_.on_edge(edge);
            const Index first = crossings.empty()
                                    ? 0
                                    : static_cast<Index>(&crossings[0] - labels_.crossings.data());
            Index interval = vertex_name(surface_.tail(surface_.edge_half[edge]));
            for (Index i = 0; i < crossings.size(); ++i) {
                const Crossing& c = crossings[i];
                const Index before = interval;
                interval = i + 1 < crossings.size()
                               ? IntervalName::make(IntervalName::Crossing, first + i)
                               : vertex_name(surface_.head(surface_.edge_half[edge]));
                side.crossings.push_back(
                    {c.at, c.distance, first + i, c.site_before, c.site_after, before, interval});
            }
            if (!along) turn(side);
        }
    }

    static Index vertex_name(Index vertex) {
        return IntervalName::make(IntervalName::Vertex, vertex);
    }

    static void turn(Side& side) {
        std::reverse(side.crossings.begin(), side.crossings.end());
        for (SideCrossing& c : side.crossings) {
            c.at = 1 - c.at;
            std::swap(c.site_before, c.site_after);
            std::swap(c.interval_before, c.interval_after);
        }
    }

    // What lies in the face itself, what the edges hand on, the corners, and the label changes on
    // the edges, which pin the arcs to the points where they enter.
    void gather_relays(Index mixed_index) {
        relays_.clear();
        for (const Relay& relay : relays_of(propagation_, mixed_index)) {
            const bool is_inside = relay.y >= 0;
            if (is_inside || labels_.edge_index[surface_.edge[relay.half_edge]] == no_index) {
                append_planar(surface_, {&relay, 1}, {}, relays_);
            }
        }
        for (Index h = 3 * face_; h < 3 * face_ + 3; ++h) append_edge_relays(h);
        for (std::size_t k = 0; k < 3; ++k) {
            const Index v = surface_.mesh.triangles[face_][k];
            relays_.push_back(
                point_relay(points_[k], labels_.vertex_distance[v], labels_.vertex_site[v]));
        }
        for (const Side& side : sides_) {
            for (const SideCrossing& c : side.crossings) {
                const Vec2 p = position_on(side, c);
                relays_.push_back(point_relay(p, c.distance, c.site_before));
                relays_.push_back(point_relay(p, c.distance, c.site_after));
            }
        }
        std::stable_sort(relays_.begin(), relays_.end(),
                         [](const auto& a, const auto& b) { return a.site < b.site; });
    }

    void append_edge_relays(Index h) {
        const Index edge = surface_.edge[h];
        if (labels_.edge_index[edge] == no_index) return;
        const double length = surface_.length[edge];
        const bool forward = surface_.edge_half[edge] == h;
        const Motion to = to_face_frame(surface_, h);
        for (const EdgeRelay& won : labels_.relays_on(labels_.edge_index[edge])) {
            Vec2 image = forward ? won.image : Vec2(length - won.image.x(), -won.image.y());
            const bool is_on_edge = std::abs(image.y()) <= on_edge * length;
            if (image.y() > 0 && !is_on_edge) continue;  // Comes from this face.
            const Vec2 begin(forward ? won.begin : length - won.end, 0);
            const Vec2 end(forward ? won.end : length - won.begin, 0);
            relays_.push_back({to(image), to(begin), to(end), won.weight,
                               won.weight + (begin - image).norm(),
                               won.weight + (end - image).norm(), won.site, is_on_edge});
        }
    }

    [[nodiscard]] Vec2 position_on(const Side& side, const SideCrossing& c) const {
        return points_[side.from] + c.at * (points_[side.to] - points_[side.from]);
    }

    // Splits the triangle that holds each inner site in three.
    void triangulate_at_sites() {
        triangles_.assign(1, {0, 1, 2});
        for (const PlacedSite& placed : placement_.in_face(face_)) {
            if (half_edge_of(placed.point)) continue;  // On an edge: its cell is on the boundary.
            const Vec2 p = position_in_frame(surface_, placed.point, 3 * face_);
            if (nearest(relays_, p).site != placed.site) continue;  // Owns nothing.
            const std::size_t holder = find_triangle(p);
            const Triangle old = triangles_[holder];
            const auto n = static_cast<Index>(points_.size());
            points_.push_back(p);
            point_site_.push_back(placed.site);
            point_name_.push_back(IntervalName::make(IntervalName::Site, placed.site));
            triangles_[holder] = {old[0], old[1], n};
            triangles_.push_back({old[1], old[2], n});
            triangles_.push_back({old[2], old[0], n});
        }
    }

    [[nodiscard]] std::size_t find_triangle(const Vec2& p) const {
        std::size_t best = 0;
        double best_margin = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            double margin = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec2& a = points_[triangles_[i][k]];
                const Vec2& b = points_[triangles_[i][(k + 1) % 3]];
                margin = std::min(margin, cross(b - a, p - a));
            }
            if (margin > best_margin) {
                best_margin = margin;
                best = i;
            }
        }
        return best;
    }

    // Labels the cuts between the triangles.
    void cut_inside(Index mixed_index) {
        for (const Triangle& t : triangles_) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Index from = std::min(t[k], t[(k + 1) % 3]);
                const Index to = std::max(t[k], t[(k + 1) % 3]);
                if (find_side(from, to) == nullptr) add_cut(mixed_index, from, to);
            }
        }
        for (std::size_t i = 3; i < points_.size(); ++i)
            out_.parts.push_back({point_site_[i], 1, 0});
    }

    // What is barred may still own an end.
    void choose_cut_relays(Index mixed_index, Index site_from, Index site_to) {
        cut_relays_.clear();
        for (const PlanarRelay& relay : relays_) {
            const BarredSite key{mixed_index, relay.site};
            if (relay.site == site_from || relay.site == site_to ||
                !std::binary_search(barred_.begin(), barred_.end(), key)) {
                cut_relays_.push_back(relay);
            }
        }
    }

    void add_cut(Index mixed_index, Index from, Index to) {
        choose_cut_relays(mixed_index, point_site_[from], point_site_[to]);
        label_envelope(cut_relays_, points_[from], points_[to], point_site_[from], point_site_[to],
                       scratch_, intervals_);
        Side side{from, to, {}};
        Index interval = point_name_[from];
        if (intervals_.size() == 1) out_.local.connected.emplace_back(interval, point_name_[to]);
        for (std::size_t i = 0; i < intervals_.size(); ++i) {
            out_.parts.push_back({intervals_[i].site, -1, 0});
            if (i + 1 == intervals_.size()) break;
            const auto inner = static_cast<Index>(out_.inner.size());
            const Index before = interval;
            interval = i + 2 < intervals_.size() ? IntervalName::make(IntervalName::Inner, inner)
                                                 : point_name_[to];
            SideCrossing c{intervals_[i].end,
                           0,
                           FaceArcs::inner_base + inner,
                           intervals_[i].site,
                           intervals_[i + 1].site,
                           before,
                           interval};
            const Vec2 p = points_[from] + c.at * (points_[to] - points_[from]);
            c.distance = std::max(reach_from(relays_, c.site_before, p).distance,
                                  reach_from(relays_, c.site_after, p).distance);
            out_.inner.push_back(
                {p, c.distance, i + 2 < intervals_.size() ? c.site_after : no_index});
            side.crossings.push_back(c);
        }
        sides_.push_back(std::move(side));
    }

    [[nodiscard]] const Side* find_side(Index from, Index to) const {
        for (const Side& side : sides_) {
            if (side.from == from && side.to == to) return &side;
        }
        return nullptr;
    }

    void solve(const Triangle& triangle) {
        joints_.clear();
        for (std::size_t k = 0; k < 3; ++k) {
            const Index a = triangle[k];
            const Index b = triangle[(k + 1) % 3];
            const Side& side = *find_side(std::min(a, b), std::max(a, b));
            if (a < b) {
                for (const SideCrossing& c : side.crossings) {
                    joints_.push_back(
                        {position_on(side, c), c.node, c.site_after, c.interval_after});
                }
            } else {
                for (auto c = side.crossings.rbegin(); c != side.crossings.rend(); ++c) {
                    joints_.push_back(
                        {position_on(side, *c), c->node, c->site_before, c->interval_before});
                }
            }
        }
        if (joints_.empty()) {
            out_.parts.push_back({point_site_[triangle[0]], 1, 0});
            return;
        }
        const std::array<Vec2, 3> corners{points_[triangle[0]], points_[triangle[1]],
                                          points_[triangle[2]]};
        solve_triangle(relays_, corners, joints_, FaceArcs::branch_base, chord_tolerance_,
                       out_.local);
    }

    // Green's theorem over the labelled boundary and the arcs.
    void add_areas(std::size_t first_arc) {
        const auto add = [&](Index site, double area) { out_.parts.push_back({site, 0, area}); };
        for (Index k = 0; k < 3; ++k) {
            const Side& side = sides_[k];
            const double sign = k == 2 ? -1 : 1;  // Side 2 runs clockwise.
            Vec2 last = points_[side.from];
            Index site = point_site_[side.from];
            for (const SideCrossing& c : side.crossings) {
                const Vec2 p = position_on(side, c);
                add(site, sign * cross(last, p) / 2);
                last = p;
                site = c.site_after;
            }
            add(site, sign * cross(last, points_[side.to]) / 2);
        }
        for (std::size_t i = first_arc; i < out_.local.arcs.size(); ++i) {
            const LocalArc& arc = out_.local.arcs[i];
            Vec2 last = node_position(arc.tail);
            double doubled = 0;
            for (Index j = 0; j < arc.num_points; ++j) {
                const Vec2& p = out_.local.points[arc.first_point + j];
                doubled += cross(last, p);
                last = p;
            }
            doubled += cross(last, node_position(arc.head));
            add(arc.left, doubled / 2);
            add(arc.right, -doubled / 2);
        }
    }

    [[nodiscard]] Vec2 node_position(Index node) const {
        if (node >= FaceArcs::branch_base) {
            return out_.local.branches[node - FaceArcs::branch_base].position;
        }
        if (node >= FaceArcs::inner_base) return out_.inner[node - FaceArcs::inner_base].position;
        for (const Side& side : sides_) {
            for (const SideCrossing& c : side.crossings) {
                if (c.node == node) return position_on(side, c);
            }
        }
        return Vec2::Zero();  // Not reached: every node of the face's arcs is one of these.
    }

    void merge_parts(std::size_t first) {
        const auto begin = out_.parts.begin() + static_cast<std::ptrdiff_t>(first);
        std::stable_sort(begin, out_.parts.end(),
                         [](const auto& a, const auto& b) { return a.site < b.site; });
        std::size_t kept = first;
        for (std::size_t i = first; i < out_.parts.size(); ++i) {
            if (kept > first && out_.parts[kept - 1].site == out_.parts[i].site) {
                out_.parts[kept - 1].euler += out_.parts[i].euler;
                out_.parts[kept - 1].area += out_.parts[i].area;
            } else {
                out_.parts[kept++] = out_.parts[i];
            }
        }
        out_.parts.resize(kept);
    }

    const Surface& surface_;
    const Propagation& propagation_;
    const SitePlacement& placement_;
    const EdgeLabels& labels_;
    std::span<const BarredSite> barred_;
    double chord_tolerance_;
    FaceArcs& out_;

    // The face at hand.
    Index face_ = 0;
    std::vector<Vec2> points_;  // Corners, then inner sites.
    std::vector<Index> point_site_;
    std::vector<Index> point_name_;  // As an interval.
    std::vector<Triangle> triangles_;
    std::vector<Side> sides_;  // The face's three, then the cuts.
    std::vector<PlanarRelay> relays_;
    std::vector<PlanarRelay> cut_relays_;
    std::vector<Joint> joints_;
    std::vector<LabelInterval> intervals_;
    EnvelopeScratch scratch_;
};

}  // namespace

FaceArcs trace_faces(const Surface& surface, const Propagation& propagation,
                     const SitePlacement& placement, const EdgeLabels& labels,
                     std::span<const BarredSite> barred, double chord_tolerance, Index begin,
                     Index end) {
    FaceArcs result;
    FaceTracer tracer(surface, propagation, placement, labels, barred, chord_tolerance, result);
    for (Index i = begin; i < end; ++i) tracer.trace(i);
    return result;
}

}  // namespace agvd
