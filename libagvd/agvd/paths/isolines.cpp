// Arcs are made face by face. Those of neighbours end at the same points of an edge up to rounding
// (or up to the errors of the distances), so that the ends on an edge follow one another in pairs:
// one that leaves a face and one that comes into the other, the nearest first.
#include "agvd/paths/isolines.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>

#include "agvd/core/parallel.h"
#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/face_isolines.h"

namespace agvd {
namespace {

constexpr Index faces_of_a_chunk = 256;
// A share of the level: nearer to the distance of a vertex it is raised by twice that.
constexpr double beside_vertex = 1e-10;
constexpr double most_levels = 1e6;

struct FreeLevel {
    double distance;
    Index index;  // As asked for.
};

// An arc of the surface; it is number `place` of its face and level, as `next` counts.
struct SurfaceArc {
    Index level, face, place;
    FaceArc arc;
};

// An end of an arc on an edge.
struct LineEnd {
    Index level, edge;
    double at;  // From the tail of the edge's half-edge.
    Index arc;
    bool is_begin;

    [[nodiscard]] auto key() const { return std::tie(level, edge, at, arc, is_begin); }
};

// Ascending, none at the distance of a vertex.
std::vector<FreeLevel> free_levels(const Propagation& propagation, std::span<const double> levels) {
    std::vector<double> distances = propagation.vertex_distance;
    std::sort(distances.begin(), distances.end());
    std::vector<FreeLevel> result;
    for (Index i = 0; i < levels.size(); ++i) {
        double level = levels[i];
        if (!(level > 0 && level < infinity)) {
            throw InvalidOption("level " + std::to_string(i) + " is " + std::to_string(level) +
                                "; use a finite number above 0");
        }
        for (int raised = 0; raised < 4; ++raised) {
            const auto from = level * (1 - beside_vertex), to = level * (1 + beside_vertex);
            const auto near = std::lower_bound(distances.begin(), distances.end(), from);
            if (near == distances.end() || *near > to) break;
            level = levels[i] * (1 + 2 * (raised + 1) * beside_vertex);
        }
        result.push_back({level, i});
    }
    std::sort(result.begin(), result.end(), [](const FreeLevel& a, const FreeLevel& b) {
        return std::tie(a.distance, a.index) < std::tie(b.distance, b.index);
    });
    return result;
}

std::span<const FreeLevel> levels_that_may_cross(const Surface& surface,
                                                 const Propagation& propagation,
                                                 std::span<const FreeLevel> ascending, Index face) {
    double low = infinity, high = 0, longest = 0;
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const double distance = propagation.vertex_distance[surface.tail(h)];
        low = std::min(low, distance);
        high = std::max(high, distance);
        longest = std::max(longest, surface.length_of(h));
    }
    // No point of a face lies farther from the nearest corner.
    const double reach = longest / std::sqrt(3.0);
    const auto is_lower = [](const FreeLevel& level, double distance) {
        return level.distance < distance;
    };
    const auto begin = std::lower_bound(ascending.begin(), ascending.end(), low - reach, is_lower);
    const auto end = std::lower_bound(begin, ascending.end(), high + reach, is_lower);
    return {begin, end};
}

class IsolineBuilder {
public:
    IsolineBuilder(const Surface& surface, const Propagation& propagation,
                   std::vector<FreeLevel> levels, const IsolineOptions& options)
        : surface_(surface),
          propagation_(propagation),
          levels_(std::move(levels)),
          options_(options),
          poller_(options.progress) {}

    Isolines run() {
        arcs_ = parallel_collect<SurfaceArc>(
            surface_.num_faces(), faces_of_a_chunk, options_.num_threads,
            [&](Index face, std::vector<SurfaceArc>& arcs) { append_arcs(face, arcs); }, poller_);
        if (const auto face = first_without_relays()) {
            throw InvalidInput("face " + std::to_string(*face) +
                               " has no relays, but a level may cross it; propagate with "
                               "relay_faces = all_faces(surface)");
        }
        join_faces();
        chain();
        return std::move(result_);
    }

private:
    [[nodiscard]] std::span<const FreeLevel> levels_in(Index face) const {
        return levels_that_may_cross(surface_, propagation_, levels_, face);
    }
    [[nodiscard]] std::optional<Index> first_without_relays() const {
        Index next = 0;  // Of the mixed faces.
        const auto& mixed = propagation_.mixed_faces;
        for (Index face = 0; face < surface_.num_faces(); ++face) {
            if (next < mixed.size() && mixed[next] == face) {
                ++next;
            } else if (!levels_in(face).empty()) {
                return face;
            }
        }
        return std::nullopt;
    }

    void append_arcs(Index face, std::vector<SurfaceArc>& arcs) {
        const std::span<const FreeLevel> levels = levels_in(face);
        if (levels.empty()) return;
        poller_.poll();
        const std::optional<Index> mixed = mixed_index_of(propagation_, face);
        if (!mixed) return;
        std::vector<PlanarRelay> relays;
        for (const Relay& relay : relays_of(propagation_, *mixed)) {
            relays.push_back(to_planar(relay, to_face_frame(surface_, relay.half_edge)));
        }
        std::vector<FaceArc> found;
        for (const FreeLevel& level : levels) {
            found.clear();
            append_face_arcs(face_corners(surface_, face), relays, level.distance,
                             propagation_.certified_error > 0, found);
            for (Index i = 0; i < found.size(); ++i) {
                arcs.push_back({level.index, face, i, found[i]});
            }
        }
    }

    // Lets each arc that ends on an edge be followed by one of the face across.
    void join_faces() {
        const auto num_arcs = static_cast<Index>(arcs_.size());
        next_.assign(num_arcs, no_index);
        is_entered_.assign(num_arcs, false);
        for (Index i = 0; i < num_arcs; ++i) {
            const SurfaceArc& here = arcs_[i];
            if (here.arc.next != no_index) follow(i, i - here.place + here.arc.next);
        }
        std::vector<LineEnd> ends = ends_on_edges();
        poller_.poll();
        std::sort(ends.begin(), ends.end(),
                  [](const LineEnd& a, const LineEnd& b) { return a.key() < b.key(); });
        Ticker ticker(poller_);
        for (std::size_t begin = 0; begin < ends.size();) {
            ticker.tick(4);
            std::size_t end = begin + 1;
            while (end < ends.size() && ends[end].level == ends[begin].level &&
                   ends[end].edge == ends[begin].edge) {
                ++end;
            }
            join_ends(std::span(ends).subspan(begin, end - begin));
            begin = end;
        }
    }
    void follow(Index arc, Index by) {
        next_[arc] = by;
        is_entered_[by] = true;
    }
    [[nodiscard]] std::vector<LineEnd> ends_on_edges() const {
        std::vector<LineEnd> ends;
        for (Index i = 0; i < arcs_.size(); ++i) {
            const SurfaceArc& here = arcs_[i];
            const auto add = [&](const FaceArcEnd& end, bool is_begin) {
                const Index h = 3 * here.face + end.side;
                if (surface_.twin[h] == no_index) return;
                const Motion frame = to_face_frame(surface_, h);
                const double at = (end.at - frame.origin).dot(frame.axis);
                const Index edge = surface_.edge[h];
                const bool is_forward = surface_.edge_half[edge] == h;
                ends.push_back(
                    {here.level, edge, is_forward ? at : surface_.length[edge] - at, i, is_begin});
            };
            if (next_[i] == no_index) add(here.arc.end, false);
            if (!is_entered_[i]) add(here.arc.begin, true);
        }
        return ends;
    }
    // Of one edge and level, in their order along the edge.
    void join_ends(std::span<LineEnd> ends) {
        std::vector<LineEnd> left(ends.begin(), ends.end());
        while (left.size() > 1) {
            std::size_t best = left.size();
            for (std::size_t i = 0; i + 1 < left.size(); ++i) {
                if (left[i].is_begin == left[i + 1].is_begin) continue;
                if (best == left.size() ||
                    left[i + 1].at - left[i].at < left[best + 1].at - left[best].at) {
                    best = i;
                }
            }
            if (best == left.size()) return;
            const LineEnd &a = left[best], &b = left[best + 1];
            follow(a.is_begin ? b.arc : a.arc, a.is_begin ? a.arc : b.arc);
            const auto first = left.begin() + static_cast<std::ptrdiff_t>(best);
            left.erase(first, first + 2);
        }
    }

    // Lines are chains of arcs: by level, open ones first.
    void chain() {
        std::vector<bool> is_taken(arcs_.size(), false);
        std::vector<Index> order(arcs_.size());
        for (Index i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
            return std::tuple(arcs_[a].level, is_entered_[a]) <
                   std::tuple(arcs_[b].level, is_entered_[b]);
        });
        Ticker ticker(poller_);
        for (const Index first : order) {
            ticker.tick(4);
            if (is_taken[first]) continue;
            result_.lines.push_back({arcs_[first].level, is_entered_[first]});
            for (Index i = first; i != no_index && !is_taken[i]; i = next_[i]) {
                is_taken[i] = true;
                const auto& [level, face, place, arc] = arcs_[i];
                result_.arcs.push_back({FaceId(face), SiteId(arc.site), arc.centre, arc.radius,
                                        arc.begin.at, arc.end.at});
            }
            result_.line_arcs.push_back(static_cast<Index>(result_.arcs.size()));
        }
    }

    const Surface& surface_;
    const Propagation& propagation_;
    std::vector<FreeLevel> levels_;
    const IsolineOptions& options_;
    Poller poller_;
    std::vector<SurfaceArc> arcs_;
    std::vector<Index> next_;       // #arcs: the arc that follows; no_index: none.
    std::vector<bool> is_entered_;  // #arcs: it follows another one.
    Isolines result_;
};

// Appends points of the arc up to `end`, exclusive.
void append_points_of_arc(const Surface& surface, const IsolineArc& arc, const Vec2& begin,
                          const Vec2& end, double tolerance, std::vector<SurfacePoint>& points) {
    const Vec2 middle = (begin + end) / 2 - arc.centre;
    const double height = middle.norm();
    // Rounding of a long radius must not split for ever.
    const bool is_split =
        arc.radius < infinity && arc.radius - height > std::max(tolerance, 1e-14 * arc.radius);
    if (!is_split) {
        points.push_back(to_surface(surface, arc.face.value(), begin));
        return;
    }
    const Vec2 top = arc.centre + middle * (arc.radius / height);
    append_points_of_arc(surface, arc, begin, top, tolerance, points);
    append_points_of_arc(surface, arc, top, end, tolerance, points);
}

}  // namespace

Isolines build_isolines(const Surface& surface, const Propagation& propagation,
                        std::span<const double> levels, const IsolineOptions& options) {
    check_num_threads(options.num_threads);
    return IsolineBuilder(surface, propagation, free_levels(propagation, levels), options).run();
}

std::vector<Index> faces_at_levels(const Surface& surface, const Propagation& propagation,
                                   std::span<const double> levels) {
    const std::vector<FreeLevel> ascending = free_levels(propagation, levels);
    std::vector<Index> faces;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        if (!levels_that_may_cross(surface, propagation, ascending, f).empty()) faces.push_back(f);
    }
    return faces;
}

std::vector<double> levels_every(const Propagation& propagation, double step) {
    double farthest = 0;
    for (const double distance : propagation.vertex_distance) {
        if (distance < infinity) farthest = std::max(farthest, distance);
    }
    if (!(step > 0 && step < infinity && farthest / step <= most_levels)) {
        throw InvalidOption("the step of the levels is " + std::to_string(step) +
                            " for distances up to " + std::to_string(farthest) +
                            "; use a larger number, above 0");
    }
    std::vector<double> levels;
    for (Index i = 1; i * step <= farthest; ++i) levels.push_back(i * step);
    return levels;
}

DrawnIsolines draw_isolines(const Surface& surface, const Isolines& isolines, double tolerance) {
    if (!(tolerance > 0)) {
        throw InvalidOption("the tolerance of isolines is " + std::to_string(tolerance) +
                            "; use a number above 0");
    }
    DrawnIsolines drawn;
    for (std::size_t line = 0; line < isolines.lines.size(); ++line) {
        const auto first = isolines.line_arcs[line], end = isolines.line_arcs[line + 1];
        const std::size_t first_point = drawn.points.size();
        for (Index i = first; i < end; ++i) {
            const IsolineArc& arc = isolines.arcs[i];
            append_points_of_arc(surface, arc, arc.begin, arc.end, tolerance, drawn.points);
        }
        const IsolineArc& last = isolines.arcs[end - 1];
        drawn.points.push_back(isolines.lines[line].is_closed
                                   ? drawn.points[first_point]
                                   : to_surface(surface, last.face.value(), last.end));
        drawn.offsets.push_back(static_cast<Index>(drawn.points.size()));
    }
    return drawn;
}

}  // namespace agvd
