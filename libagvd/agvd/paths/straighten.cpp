// Each round unfolds the strip into a plane and finds the shortest path inside it by a funnel
// ([lee1984]). At bends with an angle below pi on the other side, the strip is rerouted around that
// side ([xin2007]). Rounds end when there is no such bend or the path gets no shorter.
#include <algorithm>
#include <cassert>
#include <numbers>

#include "agvd/core/portable_math.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_strip.h"

namespace agvd {

namespace {

// Radians. If the angle on one side of a vertex is below pi by less than this, passing the vertex
// there saves less than rounding: the square of this.
constexpr double angle_tolerance = 1e-7;
// Rounds besides one for each crossing at the start, of which no path took more than half.
constexpr std::size_t more_rounds = 500;
// Most crossings that all rounds together look at, for each crossing at the start and besides.
// Where a path winds around a spike of needles, each of thousands of rounds looks at thousands.
constexpr std::size_t looks_for_each = 400, more_looks = 200'000;
// Most rounds in a row that do not shorten the path, as rounding may hide what they save.
constexpr int max_stalled_rounds = 5;
// Relative error of a path's length.
constexpr double rounding = 1e-12;

// Above 0: c lies on the left of the line from a to b.
double side_of(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

// Sine of an angle: rounding must not hide that a path goes through a vertex.
constexpr double collinear = 1e-12;

// Clearly on the left of the line from a to b, seen from a.
bool is_left_of(const Vec2& a, const Vec2& b, const Vec2& c) {
    const double side = side_of(a, b, c);
    return side > 0 &&
           side * side > collinear * collinear * (b - a).squaredNorm() * (c - a).squaredNorm();
}

class Straightener {
public:
    Straightener(const Surface& surface, FaceStrip strip, Ticker ticker)
        : surface_(surface), strip_(std::move(strip)), ticker_(ticker) {}

    // Replaces the strip by that of a locally shortest path, which is never longer.
    GeodesicPath run() {
        double least = infinity;
        const std::size_t max_rounds = strip_.crossed.size() + more_rounds;
        const std::size_t max_looks = looks_for_each * strip_.crossed.size() + more_looks;
        std::size_t looks = 0;
        int stalled_rounds = 0;
        for (std::size_t round = 0;
             round < max_rounds && looks < max_looks && stalled_rounds <= max_stalled_rounds;
             ++round) {
            ticker_.tick(1 + strip_.crossed.size());
            looks += strip_.crossed.size();
            trim(surface_, strip_);
            const double length = find_shortest();
            const bool is_rerouted = reroute();
            if (!is_rerouted && length <= least * (1 + rounding)) {
                return traced(length, true);
            }
            if (length < least) {
                least = length;
                best_ = strip_;
                stalled_rounds = 0;
            } else {
                ++stalled_rounds;
            }
            if (!is_rerouted) break;
            strip_.crossed.swap(crossed_);
        }
        strip_ = best_;
        return traced(find_shortest(), false);
    }

private:
    // A vertex of the unfolded strip (or the source, or the target).
    struct Node {
        Vec2 position;
        Index parent;  // The node before it on the shortest path from the source.
        Index first;   // The first of the crossings of which it is an end;
        Index last;    // the last one.
        bool is_left;
    };
    // Ends of a crossed edge in the plane of the unfolded strip.
    struct Ends {
        Vec2 left, right;
    };

    // The points of the shortest path in the strip.
    [[nodiscard]] GeodesicPath traced(double length, bool is_locally_shortest) const {
        const std::vector<Index>& crossed = strip_.crossed;
        GeodesicPath path{{strip_.source}, {strip_.source.face}, length, is_locally_shortest};
        // Enters the face across a half-edge at a point of it: 0 at its tail, 1 at its head.
        const auto enter = [&](Index half_edge, double along) {
            const Index inside = surface_.twin[half_edge];
            SurfacePoint& point = path.points.emplace_back();
            point = {FaceId(Surface::face(inside)), {0, 0, 0}};
            point.barycentric[inside % 3] = along;
            point.barycentric[(inside + 1) % 3] = 1 - along;
            path.faces.push_back(point.face);
        };
        Index next = 0;
        for (std::size_t i = 1; i < path_.size(); ++i) {
            const Node& from = nodes_[path_[i - 1]];
            const Node& to = nodes_[path_[i]];
            for (; next < to.first; ++next) {
                const double left =
                    std::max(side_of(from.position, to.position, ends_[next].left), 0.0);
                const double right =
                    std::max(-side_of(from.position, to.position, ends_[next].right), 0.0);
                enter(crossed[next], left + right > 0 ? right / (left + right) : 0.5);
            }
            if (i + 1 == path_.size()) break;
            enter(crossed[to.last], to.is_left ? 1 : 0);
            next = std::max(next, to.last + 1);
        }
        path.points.push_back(strip_.target);
        return path;
    }

    // The length of the shortest path inside the strip; sets path_ to its nodes.
    [[nodiscard]] double find_shortest() {
        path_.clear();
        if (strip_.crossed.empty()) {
            const Index h = 3 * strip_.source.face.value();
            nodes_ = {{position_in_frame(surface_, strip_.source, h), no_index, 0, 0, false},
                      {position_in_frame(surface_, strip_.target, h), 0, 0, 0, false}};
        } else {
            unfold();
            const auto num_nodes = static_cast<Index>(nodes_.size());
            funnel_.resize(2 * num_nodes);
            begin_ = num_nodes - 1;
            apex_ = num_nodes;
            end_ = num_nodes + 2;
            funnel_[begin_] = 1;
            funnel_[apex_] = 0;
            funnel_[apex_ + 1] = 2;
            for (Index node = 3; node < num_nodes; ++node) add_to_funnel(node);
        }
        return collect_path();
    }

    // Unfolds the faces into one plane, one after the other.
    void unfold() {
        const std::vector<Index>& crossed = strip_.crossed;
        const auto num_crossed = static_cast<Index>(crossed.size());
        nodes_.clear();
        ends_.clear();
        Index h = crossed[0];
        ends_.push_back({{surface_.length_of(h), 0}, {0, 0}});
        nodes_.push_back({position_in_frame(surface_, strip_.source, h), no_index, 0, 0, false});
        nodes_.push_back({ends_[0].left, 0, 0, 0, true});
        nodes_.push_back({ends_[0].right, 0, 0, 0, false});
        Index left = 1, right = 2;
        for (Index k = 1; k < num_crossed; ++k) {
            const Index inside = surface_.twin[h];
            Ends ends = ends_.back();
            const Vec2 apex = apex_of(inside, ends.left, ends.right);
            h = crossed[k];
            const bool is_left = h == Surface::next(inside);
            assert(is_left || h == Surface::previous(inside));
            nodes_[is_left ? left : right].last = k - 1;
            (is_left ? left : right) = static_cast<Index>(nodes_.size());
            (is_left ? ends.left : ends.right) = apex;
            nodes_.push_back({apex, no_index, k, 0, is_left});
            ends_.push_back(ends);
        }
        nodes_[left].last = nodes_[right].last = num_crossed - 1;
        const Index inside = surface_.twin[h];
        const Vec2 target = position_in_frame(surface_, strip_.target, inside);
        const Ends& ends = ends_.back();
        const Vec2 along = (ends.right - ends.left) / surface_.length_of(inside);
        nodes_.push_back({ends.left + target.x() * along + target.y() * Vec2(-along.y(), along.x()),
                          no_index, num_crossed, num_crossed, false});
    }

    // Nodes past which the new end sees are removed from its chain. A vertex on the straight line
    // counts as a bend: its other side may be narrower than pi.
    void add_to_funnel(Index node) {
        const Vec2& point = nodes_[node].position;
        const auto at = [&](Index i) -> const Vec2& { return nodes_[funnel_[i]].position; };
        if (nodes_[node].is_left) {
            for (; begin_ + 1 < end_; ++begin_) {
                if (begin_ < apex_) {
                    if (!is_left_of(at(begin_ + 1), point, at(begin_))) break;
                } else {
                    if (is_left_of(at(begin_), at(begin_ + 1), point)) break;
                    ++apex_;
                }
            }
            nodes_[node].parent = funnel_[begin_];
            funnel_[--begin_] = node;
            return;
        }
        for (; begin_ + 1 < end_; --end_) {
            const Index last = end_ - 1;
            if (last > apex_) {
                if (!is_left_of(at(last - 1), at(last), point)) break;
            } else {
                if (is_left_of(at(last), point, at(last - 1))) break;
                --apex_;
            }
        }
        nodes_[node].parent = funnel_[end_ - 1];
        funnel_[end_++] = node;
    }

    [[nodiscard]] double collect_path() {
        double length = 0;
        Index node = static_cast<Index>(nodes_.size()) - 1;
        path_.push_back(node);
        while (node != 0) {
            const Index parent = nodes_[node].parent;
            length += (nodes_[node].position - nodes_[parent].position).norm();
            path_.push_back(parent);
            node = parent;
        }
        std::reverse(path_.begin(), path_.end());
        return length;
    }

    // Reroutes the strip around all bends with less than pi on the other side. Each detour shortens
    // the path close to its vertex, so detours do not interfere.
    [[nodiscard]] bool reroute() {
        const std::vector<Index>& crossed = strip_.crossed;
        crossed_.clear();
        Index next = 0;
        bool is_changed = false;
        for (Index i = 1; i + 1 < path_.size(); ++i) {
            const Detour detour = find_detour(i);
            if (!detour.is_shorter) continue;
            is_changed = true;
            const Index first = nodes_[path_[i]].first;
            while (next < first) cross(surface_, crossed[next++], crossed_);
            // Both detours cross an edge between two bends.
            while (next > first) cross(surface_, surface_.twin[crossed[--next]], crossed_);
            for (const Index h : detour_) cross(surface_, h, crossed_);
            next = detour.last + 1;
        }
        if (!is_changed) return false;
        for (; next < crossed.size(); ++next) cross(surface_, crossed[next], crossed_);
        return true;
    }

    struct Detour {
        bool is_shorter;
        Index last;  // The last crossing that it replaces.
    };
    [[nodiscard]] Detour find_detour(Index bend) {
        const std::vector<Index>& crossed = strip_.crossed;
        const Node& node = nodes_[path_[bend]];
        detour_.clear();
        const Index in = crossed[node.first];
        const Index out = surface_.twin[crossed[node.last]];
        // A strip that turns all the way around the vertex, back to the same corner and not only to
        // the same face, is never shortest: the turn is cut out.
        const Index around = node.is_left ? Surface::next(in) : Surface::previous(in);
        for (Index k = node.first; k <= node.last; ++k) {
            if (surface_.twin[crossed[k]] == around) return {true, k};
        }
        // Angles at the vertex on the other side: clockwise for a vertex on the left.
        double angle = 0;
        const auto add_corner = [&](const Vec2& corner) {  // (cos, sin) times any length.
            angle += portable::atan2(std::max(corner.y(), 0.0), corner.x());
        };
        const auto add = [&](const Vec2& from, const Vec2& to) {
            const Vec2 a = from - node.position, b = to - node.position;
            add_corner({a.dot(b), node.is_left ? cross(b, a) : cross(a, b)});
        };
        const Ends& first = ends_[node.first];
        const Ends& last = ends_[node.last];
        add(nodes_[path_[bend - 1]].position, apex_of(in, first.right, first.left));
        add(apex_of(out, last.left, last.right), nodes_[path_[bend + 1]].position);
        const Index goal = node.is_left ? Surface::previous(out) : Surface::next(out);
        Index h = node.is_left ? Surface::next(in) : Surface::previous(in);
        while (angle < std::numbers::pi - angle_tolerance) {
            const Index inside = surface_.twin[h];
            if (inside == no_index) break;
            detour_.push_back(h);
            if (inside == goal) return {true, node.last};
            h = node.is_left ? Surface::next(inside) : Surface::previous(inside);
            add_corner(surface_.apex[node.is_left ? h : inside]);
        }
        return {false, node.last};
    }

    [[nodiscard]] Vec2 apex_of(Index half_edge, const Vec2& tail, const Vec2& head) const {
        const Vec2 along = (head - tail) / surface_.length_of(half_edge);
        const Vec2 apex = surface_.apex[half_edge];
        return tail + apex.x() * along + apex.y() * Vec2(-along.y(), along.x());
    }

    const Surface& surface_;
    FaceStrip strip_;
    Ticker ticker_;
    std::vector<Node> nodes_;    // The source, both ends of the first crossing, one for each more;
                                 // then the target.
    std::vector<Ends> ends_;     // Of each crossing.
    std::vector<Index> funnel_;  // Left end, ..., apex, ..., right end: [begin_, end_).
    Index begin_ = 0, end_ = 0, apex_ = 0;
    std::vector<Index> path_;     // Nodes from the source to the target.
    std::vector<Index> detour_;   // Crossings on the other side of a bend.
    std::vector<Index> crossed_;  // Of the next round.
    FaceStrip best_;              // Of the shortest path so far.
};

}  // namespace

GeodesicPath straighten(const Surface& surface, FaceStrip strip, Ticker ticker) {
    return Straightener(surface, std::move(strip), ticker).run();
}

}  // namespace agvd
