// Curves are taken in by falling weight; their points go into a grid, in which the points of the
// following curves find those that are too close. Lengths are in spacings unless stated.
#include "remesh/curves/select_creases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "agvd/mesh/point_grid.h"
#include "agvd/mesh/scale.h"
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
constexpr double least_spur = 1.5;
constexpr double least_island = 3;
constexpr double least_closed = 4;
// As share of the spacing: see find_creases.
constexpr double narrow = 1e-3;

struct PointOnCurve {
    Vec3 at;
    Index curve = no_index;
    double along = 0;  // Mesh units.
};

class Selection {
public:
    Selection(const Surface& surface, double spacing, std::span<const std::uint8_t> is_fixed,
              const std::vector<double>& angles, Poller& poller, detail::CreaseSet& set)
        : surface_(surface),
          spacing_(spacing),
          is_fixed_(is_fixed),
          angles_(angles),
          ticker_(poller),
          set_(set),
          chains_(detail::chains_of(set, poller)),
          grid_(box_of(surface.mesh.view()).low, 2.1 * reach * spacing, count_points()) {}

    void run() {
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const Index h = surface_.edge_half[e];
            if (surface_.twin[h] != no_index) continue;
            sample(h, 0, [&](const PointOnCurve& p, double) { add(p); });
        }
        take_all();
    }

private:
    // At least as many as are added.
    [[nodiscard]] std::size_t count_points() const {
        double length = 0;
        std::size_t edges = 0;
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            const bool is_boundary = surface_.twin[surface_.edge_half[e]] == no_index;
            if (!is_boundary && !set_.has(e)) continue;
            length += surface_.length[e];
            ++edges;
        }
        return edges + static_cast<std::size_t>(length / (sample_step * spacing_)) + 1;
    }
    [[nodiscard]] bool is_fixed(Index edge) const {
        return !is_fixed_.empty() && is_fixed_[edge] != 0;
    }

    // The heaviest chain first. A chain weighs more by what was taken in at its ends: of two
    // networks side by side one is taken as a whole.
    void take_all() {
        std::vector<double> weight(chains_.size(), 0);
        std::vector<std::vector<Index>> at(surface_.num_vertices());
        std::priority_queue<std::pair<double, Index>> queue;
        for (Index c = 0; c < chains_.size(); ++c) {
            for (const Index e : chains_[c].edges) {
                weight[c] += is_fixed(e) ? std::numeric_limits<double>::infinity()
                                         : surface_.length[e] * angles_[e];
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

    // Points at the middles of equal parts of an edge, from the tail of h on.
    template <typename Visit>
    void sample(Index h, double before, const Visit& visit, Index curve = no_index) {
        const Vec3 &a = surface_.mesh.positions[surface_.tail(h)],
                   &b = surface_.mesh.positions[surface_.head(h)];
        const double length = surface_.length_of(h);
        const auto parts =
            std::max(1, static_cast<int>(std::ceil(length / (sample_step * spacing_))));
        ticker_.tick(static_cast<std::size_t>(parts));
        for (int i = 0; i < parts; ++i) {
            const double t = (i + 0.5) / parts;
            visit(PointOnCurve{a + t * (b - a), curve, before + t * length}, t);
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
            if ((p.at - node).norm() < around_node * spacing_ &&
                (other.at - node).norm() < around_node * spacing_) {
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
        return along <= apart_along * spacing_;
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
            SurfacePoint start{FaceId(Surface::face(side)), {0, 0, 0}};
            start.barycentric[side % 3] = side == h ? 1 - share : share;
            start.barycentric[(side % 3 + 1) % 3] = side == h ? share : 1 - share;
            const SurfacePoint end =
                detail::walk_straight(surface_, start, in_plane * (way.norm() / in_plane.norm()))
                    .end;
            if ((position(surface_.mesh.view(), end) - to).norm() < 0.5 * way.norm()) return true;
        }
        return false;
    }

    // Whether a point of a half-edge is too close to what was taken in.
    [[nodiscard]] bool is_close(const PointOnCurve& p, Index h, double share) const {
        bool is_found = false;
        grid_.visit_near(p.at, reach * spacing_, [&](Index i) {
            const PointOnCurve& other = points_[i];
            if (is_found || (p.at - other.at).norm() >= reach * spacing_) return;
            const bool may_be =
                other.curve == p.curve ? is_same_part(p, other) : is_at_node(p, other);
            is_found = !may_be && leads_to(h, share, p.at, other.at);
        });
        return is_found;
    }

    // Takes in a chain but for its edges that are too close to what was taken in.
    // \return the weight of the edges that stay.
    double take_in(Index c) {
        const detail::CreaseChain& chain = chains_[c];
        Index at = chain.ends[0];
        double taken = 0, before = 0;
        for (const Index e : chain.edges) {
            Index h = surface_.edge_half[e];
            if (surface_.tail(h) != at && surface_.head(h) != at) at = surface_.tail(h);
            const bool is_along = surface_.tail(h) == at;
            if (!is_along) h = surface_.twin[h];
            std::vector<PointOnCurve> points;
            std::size_t close = 0;
            sample(
                h, before,
                [&](const PointOnCurve& p, double t) {
                    points.push_back(p);
                    if (!is_fixed(e) && is_close(p, h, t)) ++close;
                },
                c);
            before += surface_.length[e];
            at = surface_.head(h);
            if (static_cast<double>(close) > most_close * static_cast<double>(points.size())) {
                set_.remove(e);
            } else {
                for (const PointOnCurve& p : points) add(p);
                taken += surface_.length[e] * angles_[e];
            }
        }
        return taken;
    }

    const Surface& surface_;
    const double spacing_;
    const std::span<const std::uint8_t> is_fixed_;
    const std::vector<double>& angles_;
    Ticker ticker_;
    detail::CreaseSet& set_;
    const std::vector<detail::CreaseChain> chains_;
    PointGrid grid_;
    std::vector<PointOnCurve> points_;  // Of what was taken in; boundary: without a curve.
};

}  // namespace

void select_creases(const Surface& surface, double spacing, std::span<const std::uint8_t> is_fixed,
                    int num_threads, const Progress& progress,
                    std::vector<std::uint8_t>& is_crease) {
    Poller poller(progress);
    detail::CreaseSet set(surface);
    for (Index e = 0; e < surface.num_edges(); ++e) {
        if (is_crease[e] != 0 && surface.twin[surface.edge_half[e]] != no_index) set.add(e);
    }
    if (set.next(0) == surface.num_edges()) return;
    const std::vector<double> angles =
        detail::edge_angles(surface, narrow * spacing, num_threads, poller);
    Selection(surface, spacing, is_fixed, angles, poller, set).run();
    const std::vector<double> ones(surface.num_edges(), 1);
    detail::prune(set, ones,
                  {.least_spur = least_spur * spacing,
                   .least_island = least_island * spacing,
                   .least_network = 0,
                   .short_chain = spacing,
                   .least_density = 0},
                  poller);
    for (const detail::CreaseChain& chain : detail::chains_of(set, poller)) {
        if (chain.ends[0] != chain.ends[1] || set.degree(chain.ends[0]) != 2) continue;
        if (chain.length >= least_closed * spacing) continue;
        for (const Index e : chain.edges) set.remove(e);
    }
    is_crease = set.take_flags();
    for (Index e = 0; e < is_fixed.size(); ++e) is_crease[e] |= is_fixed[e];
}

}  // namespace remesh
