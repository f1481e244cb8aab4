// Curves are taken in by falling weight; their points go into a grid, in which the points of the
// following curves find those that are too close. How close is too close is chosen: the closer
// curves may be, the more vertices their strips take, and the fewer are left for all else. Lengths
// are in spacings of the place unless stated.
#include "remesh/curves/select_creases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "agvd/core/union_find.h"
#include "agvd/mesh/point_grid.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"
#include "remesh/curves/crease_chains.h"
#include "remesh/curves/walk.h"

namespace remesh {
namespace {

// Curves closer than this are too close: triangles between them would have angles below 20 degrees.
constexpr double reach = 0.35;
// Points of an edge are as far from each other.
constexpr double sample_step = reach / 3;
// Share of an edge's points.
constexpr double most_close = 0.25;
// Around a common vertex curves may be close.
constexpr double around_node = 1.2;
// Along one curve, points farther from each other count as two curves.
constexpr double apart_along = 2.4;
// Edges on both sides of a strip are as long as so many of its widths. Angles are about 30 degrees
// if the sites of the sides alternate, and 18 degrees at worst.
constexpr double lengths_per_width = 3;
// Depths from `reach` on, each so many times the next, down to the least.
constexpr double depth_ratio = 1.25, least_depth = 0.11;
// Share of the vertices that strips may take.
constexpr double most_of_sites = 0.35;
// The squared distance has to fall to this share to keep strips, which cost angles, too.
constexpr double least_gain = 0.75;
// Root mean square distance of a mesh from a surface that is curved with a radius of one spacing.
constexpr double smooth_distance = 0.075;
// The squared distance of one spacing of a crease that is left out, by that of its depth: the
// distance falls linearly over about a third of a spacing on both sides.
constexpr double crease_distance = 0.1;
// The length of even edges, squared: a spacing squared is the area of a vertex.
constexpr double even_squared = 2 / std::numbers::sqrt3;
constexpr double least_spur = 1.5;
constexpr double least_island = 3;
constexpr double least_closed = 4;
// As share of the spacing: see find_creases.
constexpr double narrow = 1e-3;

struct PointOnCurve {
    Vec3 at;
    double spacing = 0;  // Mesh units: of the sites there.
    Index curve = no_index;
    double along = 0;  // Mesh units.
};

// The spacing of the sites, in mesh units: the mean, or less where edges are to be shorter. Where
// they are to be longer strips make them shorter.
class Spacing {
public:
    // \param length_at  see select_creases.
    Spacing(const Surface& surface, double mean, const UnitAt& length_at) : mean_(mean) {
        if (!length_at) return;
        const double even = std::sqrt(even_squared);
        for (Index e = 0; e < surface.num_edges(); ++e) {
            const SurfacePoint middle = point_on(surface.edge_half[e], 0.5);
            share_.push_back(std::min(length_at(middle) / (even * mean), 1.0));
        }
    }

    [[nodiscard]] double mean() const { return mean_; }
    // By the mean.
    [[nodiscard]] double share(Index edge) const { return share_.empty() ? 1 : share_[edge]; }
    [[nodiscard]] double at(Index edge) const { return share(edge) * mean_; }
    // A squared distance, integrated over an area: from units of the place to those of the mean.
    [[nodiscard]] double to_mean(Index edge, double integral) const {
        const double square = share(edge) * share(edge);
        return square * square * integral;
    }

private:
    double mean_;
    std::vector<double> share_;  // #E; empty: 1.
};

class Selection {
public:
    // \param depth  curves are too close if the step between them is lower: a crease that turns by
    //               90 degrees if it is closer, and by less if it is closer than `reach`, too.
    Selection(const Surface& surface, const Spacing& spacing, double depth,
              std::span<const std::uint8_t> is_fixed, const std::vector<double>& angles,
              Poller& poller, detail::CreaseSet& set)
        : surface_(surface),
          spacing_(spacing),
          depth_(depth),
          is_fixed_(is_fixed),
          angles_(angles),
          ticker_(poller),
          set_(set),
          chains_(detail::chains_of(set, poller)),
          grid_(box_of(surface.mesh.view()).low, 2.1 * reach * spacing.mean(), count_points()),
          left_out_(surface.num_edges(), reach) {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            if (surface_.twin[h] != no_index) continue;
            sample(h, 0, [&](const PointOnCurve& p, double) { add(p); });
        }
    }

    // The heaviest chain first. A chain weighs more by what was taken in at its ends: of two
    // networks side by side one is taken as a whole.
    void run() {
        std::vector<double> weight(chains_.size(), 0);
        std::vector<std::vector<Index>> at(surface_.num_vertices());
        std::priority_queue<std::pair<double, Index>> queue;
        for (Index c = 0; c < chains_.size(); ++c) {
            for (const Index e : chains_[c].edges) {
                weight[c] += is_fixed(e) ? infinity : surface_.length[e] * angles_[e];
            }
            for (const Index v : chains_[c].ends) at[v].push_back(c);
            queue.emplace(weight[c], c);
        }
        std::vector<bool> is_done(chains_.size(), false);
        while (!queue.empty()) {
            const auto [key, c] = queue.top();
            queue.pop();
            if (is_done[c] || key != weight[c]) continue;
            is_done[c] = true;
            const double taken = take_in(c);
            for (const Index v : chains_[c].ends) {
                for (const Index other : at[v]) {
                    if (is_done[other] || !(taken > 0)) continue;
                    weight[other] += taken;
                    queue.emplace(weight[other], other);
                }
            }
        }
    }

    // Lets all curves stay.
    // \return the points of those that are close to others.
    std::vector<SizedPoint> find_strips() {
        const auto for_each_point = [&](const auto& visit) {
            for (Index c = 0; c < chains_.size(); ++c) {
                for_each_side(c, [&](Index h, double before) { sample(h, before, visit(h), c); });
            }
        };
        for_each_point([&](Index) { return [&](const PointOnCurve& p, double) { add(p); }; });
        std::vector<SizedPoint> strips;
        for_each_point([&](Index h) {
            return [&, h](const PointOnCurve& p, double t) {
                const double spacing = spacing_.at(surface_.edge[h]);
                const double width = nearest(p, h, t, reach * spacing);
                const double length = lengths_per_width * std::max(width, least_depth * spacing);
                if (width >= reach * spacing || length >= spacing) return;
                strips.push_back({point_on(h, t), length});
                strips.push_back({point_on(surface_.twin[h], 1 - t), length});
                num_vertices_ += num_added(width / spacing, length / spacing) *
                                 surface_.length_of(h) / (num_parts(h) * spacing);
            };
        });
        return strips;
    }
    // How many vertices the strips found take in addition.
    [[nodiscard]] double num_vertices() const { return num_vertices_; }

    // The squared distance, integrated over the area, that the creases of another set cost which
    // are not in this one.
    [[nodiscard]] double distance_without(const detail::CreaseSet& all) const {
        double sum = 0;
        for (Index e = all.next(0); e < surface_.num_edges(); e = all.next(e + 1)) {
            if (set_.has(e)) continue;
            const double depth = left_out_[e] * turn(e);
            sum += spacing_.to_mean(
                e, crease_distance * surface_.length[e] / spacing_.at(e) * depth * depth);
        }
        return sum;
    }

private:
    // At least as many as are added.
    [[nodiscard]] std::size_t count_points() const {
        double length = 0;
        std::size_t edges = 0;
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const bool is_boundary = surface_.twin[surface_.edge_half[e]] == no_index;
            if (!is_boundary && !set_.has(e)) continue;
            length += surface_.length[e] / spacing_.share(e);
            ++edges;
        }
        return edges + static_cast<std::size_t>(length / (sample_step * spacing_.mean())) + 1;
    }
    [[nodiscard]] bool is_fixed(Index edge) const {
        return !is_fixed_.empty() && is_fixed_[edge] != 0;
    }

    // The sine of the angle by which the surface turns, at most a right one: Bhaskara's formula,
    // which is the same on all machines.
    [[nodiscard]] double turn(Index edge) const {
        constexpr double pi = std::numbers::pi;
        const double angle = std::min(angles_[edge], pi / 2), product = angle * (pi - angle);
        return 16 * product / (5 * pi * pi - 4 * product);
    }

    // Of one side of a strip, for each spacing of its length: its row of vertices instead of half
    // the strip's, and the rows where lengths grow again.
    [[nodiscard]] static double num_added(double width, double length) {
        const double shorter = std::sqrt(even_squared) - length;
        return 0.5 / length - width / 2 + shorter * shorter / (strip_slope * length);
    }

    [[nodiscard]] int num_parts(Index h) const {
        return std::max(1,
                        static_cast<int>(std::ceil(surface_.length_of(h) /
                                                   (sample_step * spacing_.at(surface_.edge[h])))));
    }

    // Points at the middles of equal parts of an edge, from the tail of h on.
    template <typename Visit>
    void sample(Index h, double before, const Visit& visit, Index curve = no_index) {
        const Vec3 &a = surface_.mesh.positions[surface_.tail(h)],
                   &b = surface_.mesh.positions[surface_.head(h)];
        const double length = surface_.length_of(h);
        const double spacing = spacing_.at(surface_.edge[h]);
        const int parts = num_parts(h);
        ticker_.tick(static_cast<std::size_t>(parts));
        for (int i = 0; i < parts; ++i) {
            const double t = (i + 0.5) / parts;
            visit(PointOnCurve{a + t * (b - a), spacing, curve, before + t * length}, t);
        }
    }

    void add(const PointOnCurve& point) {
        grid_.add(point.at, static_cast<Index>(points_.size()));
        points_.push_back(point);
    }

    // Whether both points lie around a vertex where the chain and the curve of the other meet.
    [[nodiscard]] bool is_at_node(const PointOnCurve& p, const PointOnCurve& other) const {
        for (const Index v : chains_[p.curve].ends) {
            if (other.curve == no_index) {
                if (!surface_.is_boundary_vertex(v)) continue;
            } else if (v != chains_[other.curve].ends[0] && v != chains_[other.curve].ends[1]) {
                continue;
            }
            const Vec3& node = surface_.mesh.positions[v];
            if ((p.at - node).norm() < around_node * p.spacing &&
                (other.at - node).norm() < around_node * p.spacing) {
                return true;
            }
        }
        return false;
    }

    // Whether two points of one curve are near to each other along it, too.
    [[nodiscard]] bool is_same_part(const PointOnCurve& p, const PointOnCurve& other) const {
        double along = std::abs(p.along - other.along);
        const detail::CreaseChain& chain = chains_[p.curve];
        if (chain.ends[0] == chain.ends[1]) along = std::min(along, chain.length - along);
        return along <= apart_along * p.spacing;
    }

    // Whether the straightest way along the surface from a point of a half-edge leads to another
    // point: the two may also lie on both sides of a thin wall.
    [[nodiscard]] bool leads_to(Index h, double share, const Vec3& from, const Vec3& to) const {
        const Vec3 way = to - from;
        for (const Index side : {h, surface_.twin[h]}) {
            if (side == no_index) continue;
            const auto& p = surface_.mesh.positions;
            const Vec3 axis = (p[surface_.head(side)] - p[surface_.tail(side)]).normalized();
            const Vec3 apex = p[surface_.tail(Surface::previous(side))] - p[surface_.tail(side)];
            const Vec3 inward = (apex - axis.dot(apex) * axis).normalized();
            const Vec3 in_plane = axis.dot(way) * axis + inward.dot(way) * inward;
            if (!(inward.dot(way) > 0) || !(in_plane.norm() > 0)) continue;
            const SurfacePoint start = point_on(side, side == h ? share : 1 - share);
            const SurfacePoint end =
                detail::walk_straight(surface_, start, in_plane * (way.norm() / in_plane.norm()))
                    .end;
            if ((position(surface_.mesh.view(), end) - to).norm() < 0.5 * way.norm()) return true;
        }
        return false;
    }

    // The distance from a point of a half-edge to what was taken in, or a bound if that is less.
    [[nodiscard]] double nearest(const PointOnCurve& p, Index h, double share, double bound) const {
        grid_.visit_near(p.at, bound, [&](Index i) {
            const PointOnCurve& other = points_[i];
            const double distance = (p.at - other.at).norm();
            if (distance >= bound) return;
            const bool may_be =
                other.curve == p.curve ? is_same_part(p, other) : is_at_node(p, other);
            if (!may_be && leads_to(h, share, p.at, other.at)) bound = distance;
        });
        return bound;
    }

    // Calls visit(half-edge, length before it) for the edges of a chain in their order.
    template <typename Visit>
    void for_each_side(Index c, const Visit& visit) const {
        const detail::CreaseChain& chain = chains_[c];
        Index at = chain.ends[0];
        double before = 0;
        for (const Index e : chain.edges) {
            Index h = surface_.edge_half[e];
            if (surface_.tail(h) != at && surface_.head(h) != at) at = surface_.tail(h);
            if (surface_.tail(h) != at) h = surface_.twin[h];
            visit(h, before);
            before += surface_.length[e];
            at = surface_.head(h);
        }
    }

    // Takes in a chain but for its edges that are too close to what was taken in.
    // \return the weight of the edges that stay.
    double take_in(Index c) {
        double taken = 0;
        for_each_side(c, [&](Index h, double before) {
            const Index e = surface_.edge[h];
            const double bound =
                std::clamp(depth_ / std::max(turn(e), depth_), depth_, reach) * spacing_.at(e);
            std::vector<PointOnCurve> points;
            double num_close = 0, sum = 0;
            const auto look_at = [&](const PointOnCurve& p, double t) {
                points.push_back(p);
                const double distance = is_fixed(e) ? bound : nearest(p, h, t, bound);
                if (distance >= bound) return;
                ++num_close;
                sum += distance / spacing_.at(e);
            };
            sample(h, before, look_at, c);
            if (num_close > most_close * static_cast<double>(points.size())) {
                set_.remove(e);
                left_out_[e] = sum / num_close;
            } else {
                for (const PointOnCurve& p : points) add(p);
                taken += surface_.length[e] * angles_[e];
            }
        });
        return taken;
    }

    const Surface& surface_;
    const Spacing& spacing_;
    const double depth_;
    const std::span<const std::uint8_t> is_fixed_;
    const std::vector<double>& angles_;
    Ticker ticker_;
    detail::CreaseSet& set_;
    const std::vector<detail::CreaseChain> chains_;
    PointGrid grid_;
    std::vector<PointOnCurve> points_;  // Of what was taken in; boundary: without a curve.
    std::vector<double> left_out_;      // #E: how far from what was taken in; reach: unknown.
    double num_vertices_ = 0;
};

// Drops what dangles, and closed chains of a few spacings.
void drop_short(const Spacing& spacing, detail::CreaseSet& set, Poller& poller) {
    const Surface& surface = set.surface();
    std::vector<double> weights;  // Lengths times these are in mean spacings.
    for (Index e = 0; e < surface.num_edges(); ++e) weights.push_back(1 / spacing.share(e));
    detail::prune(set, weights,
                  {.least_spur = least_spur * spacing.mean(),
                   .least_island = least_island * spacing.mean(),
                   .least_network = 0,
                   .short_chain = spacing.mean(),
                   .least_density = 0},
                  poller);
    for (const detail::CreaseChain& chain : detail::chains_of(set, poller)) {
        if (chain.ends[0] != chain.ends[1] || set.degree(chain.ends[0]) != 2) continue;
        double length = 0;
        for (const Index e : chain.edges) length += weights[e] * surface.length[e];
        if (length >= least_closed * spacing.mean()) continue;
        for (const Index e : chain.edges) set.remove(e);
    }
}

// #F: half the width of the flat part of the surface that a face lies in, mesh units: its area by
// the length of the edges around it that bend. However it is triangulated, the width is the same.
std::vector<double> half_widths(const Surface& surface, const detail::CreaseSet& creases,
                                std::span<const double> angles) {
    constexpr double flat = 1e-4;  // Radians: files with single precision have such angles.
    UnionFind parts(surface.num_faces());
    const auto is_inside = [&](Index e) {
        const Index h = surface.edge_half[e];
        return surface.twin[h] != no_index && !creases.has(e);
    };
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e];
        if (!is_inside(e) || angles[e] > flat) continue;
        parts.unite(Surface::face(h), Surface::face(surface.twin[h]));
    }
    std::vector<double> area(surface.num_faces(), 0), length = area;
    for (Index f = 0; f < surface.num_faces(); ++f) area[parts.root(f)] += face_area(surface, f);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (!is_inside(e) || angles[e] <= flat) continue;
        const Index h = surface.edge_half[e];
        for (const Index side : {h, surface.twin[h]}) {
            length[parts.root(Surface::face(side))] += surface.length[e];
        }
    }
    std::vector<double> widths;
    for (Index f = 0; f < surface.num_faces(); ++f) {
        const Index part = parts.root(f);
        widths.push_back(length[part] > 0 ? area[part] / length[part] : 0);
    }
    return widths;
}

// The squared distance of a mesh of even edges, integrated over the area between creases. Bends
// much narrower than a spacing count as if they turned by a right angle: meshes do without them.
double smooth_distance_of(const Surface& surface, const Spacing& spacings,
                          const detail::CreaseSet& creases, std::span<const double> angles) {
    const std::vector<double> half_width = half_widths(surface, creases, angles);
    double sum = 0;
    for (Index e = 0; e < surface.num_edges(); ++e) {
        const Index h = surface.edge_half[e], twin = surface.twin[h];
        if (twin == no_index || creases.has(e)) continue;
        const double spacing = spacings.at(e);
        const double wide = half_width[Surface::face(h)] + half_width[Surface::face(twin)];
        if (!(wide > 0)) continue;
        const double across = std::min(wide / spacing, 1.0);
        sum += spacings.to_mean(e, surface.length[e] / spacing * angles[e] *
                                       std::min(angles[e] / across, std::numbers::pi / 2));
    }
    return smooth_distance * smooth_distance * sum;
}

}  // namespace

std::vector<SizedPoint> select_creases(const Surface& surface, double mean_spacing,
                                       const UnitAt& length_at, double num_sites,
                                       std::span<const std::uint8_t> is_fixed, int num_threads,
                                       const Progress& progress,
                                       std::vector<std::uint8_t>& is_crease) {
    Poller poller(progress);
    detail::CreaseSet all(surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (is_crease[e] != 0 && surface.twin[surface.edge_half[e]] != no_index) all.add(e);
    }
    if (all.next(0) == surface.num_edges()) return {};
    const Spacing spacing(surface, mean_spacing, length_at);
    const std::vector<double> angles =
        detail::edge_angles(surface, narrow * mean_spacing, num_threads, poller);
    const double smooth = smooth_distance_of(surface, spacing, all, angles);
    detail::CreaseSet best(surface);
    std::vector<SizedPoint> strips;
    double least = infinity;
    for (double depth = reach; depth > least_depth; depth /= depth_ratio) {
        detail::CreaseSet set = all;
        Selection selection(surface, spacing, depth, is_fixed, angles, poller, set);
        selection.run();
        drop_short(spacing, set, poller);
        const double lost = selection.distance_without(all);
        if (depth == reach) {
            best = set;
            least = least_gain * (lost + smooth);
            if (num_sites == 0 || smooth >= least) break;
            continue;
        }
        Selection kept(surface, spacing, depth, is_fixed, angles, poller, set);
        std::vector<SizedPoint> points = kept.find_strips();
        const double rest = 1 - kept.num_vertices() / num_sites;
        const double distance = lost + smooth / (rest * rest);
        if (rest < 1 - most_of_sites || distance >= least) continue;
        least = distance;
        best = std::move(set);
        strips = std::move(points);
    }
    is_crease = best.take_flags();
    for (Index e = 0; e < is_fixed.size(); ++e) is_crease[e] |= is_fixed[e];
    return strips;
}

}  // namespace remesh
