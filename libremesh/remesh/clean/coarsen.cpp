// Works in rounds. In each, every vertex picks its cheapest edge; then vertices go in the order of
// cost. A vertex takes part in one collapse of a round at most. So the faces around it are those
// found at the start of the round; only their other corners may have other names.
#include "remesh/clean/coarsen.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include "agvd/core/bucket_sort.h"
#include "agvd/core/groups.h"
#include "agvd/core/parallel.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface_points.h"

namespace remesh {
namespace {

constexpr Index chunk_size = 1024;
constexpr std::uint8_t boundary_mark = 0x80;  // Added to the mark of an edge.
constexpr double least_cosine = 0.2588;       // A face turns by 75 degrees at most in one step.
// Of a face that is made: height over longest edge.
constexpr double least_height = 0.05;
// Of the cost: squared lengths of edges with this factor. It decides where the surface is flat.
constexpr double length_share = 1e-6;
// Vertices with more faces stay: their collapses cost more than they save.
constexpr std::size_t most_faces = 24;
// Tenths of the vertices that can go: those with the lowest costs go in one round.
constexpr std::size_t round_tenths = 9;
// Rounds end when a smaller share of the vertices goes.
constexpr double least_share = 0.01;

// Weighted sum of squared distances from planes.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    double x = 0, y = 0, z = 0, constant = 0;
    double area = 0;

    // \param normal  of length 1.
    void add(const Vec3& normal, const Vec3& point, double weight) {
        const double offset = -normal.dot(point);
        const Vec3 n = weight * normal;
        xx += n.x() * normal.x();
        xy += n.x() * normal.y();
        xz += n.x() * normal.z();
        yy += n.y() * normal.y();
        yz += n.y() * normal.z();
        zz += n.z() * normal.z();
        x += n.x() * offset;
        y += n.y() * offset;
        z += n.z() * offset;
        constant += weight * offset * offset;
    }
    Quadric& operator+=(const Quadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        x += q.x, y += q.y, z += q.z, constant += q.constant, area += q.area;
        return *this;
    }
    [[nodiscard]] double at(const Vec3& p) const {
        const double sum = p.x() * (xx * p.x() + 2 * (xy * p.y() + xz * p.z() + x)) +
                           p.y() * (yy * p.y() + 2 * (yz * p.z() + y)) +
                           p.z() * (zz * p.z() + 2 * z) + constant;
        return std::max(sum, 0.0);
    }
};

struct Choice {
    float cost;
    Index vertex, target;
};

// A face at a vertex: the other corners, counter-clockwise, and the half-edges at the vertex.
struct Wing {
    Index next, last;
    Index out, in;
};

Vec3 middle_of(const MeshBox& box) { return (box.low + box.high) / 2; }

class Coarsener {
public:
    Coarsener(const Surface& surface, std::span<const std::uint8_t> mark,
              std::span<const std::uint8_t> stays, const CoarsenOptions& options)
        : surface_(surface),
          stays_(stays),
          options_(options),
          poller_(options.progress),
          triangles_(surface.mesh.triangles),
          name_(surface.num_vertices()),
          is_used_(surface.num_vertices(), 0),
          middle_(middle_of(box_of(surface.mesh.view(), options.num_threads))) {
        std::iota(name_.begin(), name_.end(), Index{0});
        mark_.reserve(surface.twin.size());
        for (Index h = 0; h < surface.twin.size(); ++h) {
            const std::uint8_t own = mark.empty() ? 0 : mark[surface.edge[h]];
            mark_.push_back(surface.twin[h] == no_index ? own | boundary_mark : own);
        }
        find_quadrics();
    }

    CoarseMesh run() {
        while (triangles_.size() > options_.num_faces) {
            poller_.poll();
            const auto before = static_cast<double>(triangles_.size());
            do_round();
            if (before - static_cast<double>(triangles_.size()) < least_share * before) break;
        }
        return result();
    }

private:
    [[nodiscard]] const Vec3& at(Index v) const { return surface_.mesh.positions[v]; }

    void find_quadrics() {
        quadrics_.resize(surface_.num_vertices());
        const auto find = [&](Index v) {
            Quadric& q = quadrics_[v];
            for_each_outgoing(surface_, v, [&](Index h) {
                const Vec3& p = at(v);
                const Vec3 twice =
                    (at(surface_.head(h)) - p).cross(at(surface_.tail(Surface::previous(h))) - p);
                const double norm = twice.norm();
                const Vec3 normal = twice / norm;
                const double area = norm / 2;
                q.add(normal, p - middle_, area);
                q.area += area;
                // Across an edge of a curve: the plane through it.
                for (const Index g : {h, Surface::previous(h)}) {
                    if (mark_[g] == 0) continue;
                    const Vec3 along = at(surface_.head(g)) - at(surface_.tail(g));
                    q.add(normal.cross(along).normalized(), p - middle_, along.squaredNorm());
                }
            });
        };
        parallel_each(surface_.num_vertices(), chunk_size, options_.num_threads, find, poller_);
    }

    // Calls each(wing) for the faces at a vertex that are left, under the names of this round.
    template <typename Each>
    void for_each_wing(Index v, const Each& each) const {
        for (const Index f : around_->of(v)) {
            const Triangle& t = triangles_[f];
            const Index k = t[0] == v ? 0 : t[1] == v ? 1 : 2;
            const Index a = name_[t[(k + 1) % 3]], b = name_[t[(k + 2) % 3]];
            if (a == b || a == v || b == v) continue;
            each(Wing{a, b, 3 * f + k, 3 * f + (k + 2) % 3});
        }
    }

    // Whether the faces around v keep their side and shape when it goes to w.
    [[nodiscard]] bool fits(std::span<const Wing> wings, Index v, Index w) const {
        const Vec3 &p = at(v), &q = at(w);
        const double longest = options_.longest_edge * options_.longest_edge;
        for (const Wing& wing : wings) {
            if (wing.next == w || wing.last == w) continue;
            const Vec3 &a = at(wing.next), &b = at(wing.last);
            const Vec3 before = (a - p).cross(b - p), after = (a - q).cross(b - q);
            const double least = before.squaredNorm(), area = after.squaredNorm();
            const double dot = before.dot(after);
            if (dot <= 0 || dot * dot < least_cosine * least_cosine * least * area) return false;
            const double most =
                std::max({(a - q).squaredNorm(), (b - q).squaredNorm(), (b - a).squaredNorm()});
            if (most > longest) return false;
            if (area < least_height * least_height * most * most) {
                const double old =
                    std::max({(a - p).squaredNorm(), (b - p).squaredNorm(), (b - a).squaredNorm()});
                if (area * old * old < least * most * most) return false;
            }
        }
        return true;
    }

    // Where a vertex may go. A curve that has other than two edges at it, or of two kinds, ends.
    [[nodiscard]] bool find_targets(std::span<const Wing> wings,
                                    std::vector<Index>& targets) const {
        targets.clear();
        std::uint8_t mark = 0;
        bool is_end = false;
        const auto add = [&](Index w, std::uint8_t of_edge) {
            if (!targets.empty() && of_edge != mark) is_end = true;
            mark = of_edge;
            targets.push_back(w);
        };
        for (const Wing& wing : wings) {
            if (mark_[wing.out] != 0) add(wing.next, mark_[wing.out]);
            if ((mark_[wing.in] & boundary_mark) != 0) add(wing.last, mark_[wing.in]);
        }
        if (!targets.empty()) return !is_end && targets.size() == 2;
        for (const Wing& wing : wings) targets.push_back(wing.next);
        return true;
    }

    [[nodiscard]] double cost(Index v, Index w) const {
        const Quadric& q = quadrics_[v];
        return q.at(at(w) - middle_) + length_share * q.area * (at(w) - at(v)).squaredNorm();
    }

    // The cheapest way to go; its target is no_index if there is none.
    // \param wings, targets  scratch.
    [[nodiscard]] Choice choose(Index v, std::vector<Wing>& wings,
                                std::vector<Index>& targets) const {
        Choice none{0, v, no_index};
        if ((!stays_.empty() && stays_[v] != 0) || around_->of(v).size() > most_faces) return none;
        wings.clear();
        for_each_wing(v, [&](const Wing& wing) { wings.push_back(wing); });
        if (!find_targets(wings, targets)) return none;
        std::array<std::pair<double, Index>, most_faces> costs;
        std::size_t count = 0;
        const double most = options_.most_distance * options_.most_distance * quadrics_[v].area;
        for (const Index w : targets) {
            if (quadrics_[v].at(at(w) - middle_) <= most) costs[count++] = {cost(v, w), w};
        }
        std::sort(costs.begin(), costs.begin() + count);
        for (std::size_t i = 0; i < count; ++i) {
            const Index w = costs[i].second;
            if (fits(wings, v, w)) return {static_cast<float>(costs[i].first), v, w};
        }
        return none;
    }

    void do_round() {
        around_.emplace(triangles_by_vertex(triangles_, name_.size()));
        std::fill(is_used_.begin(), is_used_.end(), 0);
        std::vector<Choice> choices(name_.size());
        const auto find = [&](Index, Index begin, Index end) {
            std::vector<Wing> wings;
            std::vector<Index> targets;
            for (Index v = begin; v < end; ++v) {
                choices[v] =
                    around_->of(v).empty() ? Choice{0, v, no_index} : choose(v, wings, targets);
            }
        };
        parallel_chunks(static_cast<Index>(name_.size()), chunk_size, options_.num_threads, find,
                        poller_);
        std::erase_if(choices, [](const Choice& c) { return c.target == no_index; });
        constexpr int mantissa = 16;  // Bits left out of the number of a bucket.
        choices = sort_in_buckets(
            choices, Index{1} << (32 - mantissa),
            [](const Choice& c) { return std::bit_cast<std::uint32_t>(c.cost) >> mantissa; },
            [](const Choice& a, const Choice& b) {
                return a.cost != b.cost ? a.cost < b.cost : a.vertex < b.vertex;
            },
            Ticker(poller_));
        const std::size_t needed = (triangles_.size() - options_.num_faces + 1) / 2;
        const std::size_t most = (choices.size() * round_tenths + 9) / 10;
        std::size_t removed = 0;
        Ticker ticker(poller_);
        for (std::size_t i = 0; i < most && removed < needed; ++i) {
            ticker.tick();
            if (collapse(choices[i].vertex, choices[i].target)) ++removed;
        }
        rename();
    }

    bool collapse(Index v, Index w) {
        if (is_used_[v] != 0 || is_used_[w] != 0) return false;
        wings_.clear();
        for_each_wing(v, [&](const Wing& wing) { wings_.push_back(wing); });
        if (!keeps_topology(w) || !fits(wings_, v, w)) return false;
        for (const Wing& wing : wings_) {
            // The face goes. The face beyond its edge at v takes over the mark of its edge at w.
            if (wing.next == w) {
                hand_on(mark_[third_half_edge(wing)], wing.last, true);
            } else if (wing.last == w) {
                hand_on(mark_[third_half_edge(wing)], wing.next, false);
            }
        }
        name_[v] = w;
        is_used_[v] = is_used_[w] = 1;
        quadrics_[w] += quadrics_[v];
        return true;
    }

    // The half-edge opposite to the vertex.
    [[nodiscard]] static Index third_half_edge(const Wing& wing) { return Surface::next(wing.out); }

    // Marks the edge from v to x in the face that stays.
    // \param leaves  whether it leaves v there.
    void hand_on(std::uint8_t mark, Index x, bool leaves) {
        if (mark == 0) return;
        for (const Wing& wing : wings_) {
            if (leaves && wing.next == x) mark_[wing.out] |= mark;
            if (!leaves && wing.last == x) mark_[wing.in] |= mark;
        }
    }

    // The link condition.
    [[nodiscard]] bool keeps_topology(Index w) {
        ring_.clear();
        Index num_faces = 0;
        for (const Wing& wing : wings_) {
            if (wing.next == w || wing.last == w) ++num_faces;
            ring_.push_back(wing.next);
            if ((mark_[wing.in] & boundary_mark) != 0) ring_.push_back(wing.last);
            // An edge of a curve must not come to lie on another edge.
            if (wing.next == w && mark_[wing.in] != 0) return false;
            if (wing.last == w && mark_[wing.out] != 0) return false;
        }
        if (num_faces == 0) return false;
        Index num_common = 0, valence = 0;
        bool is_boundary = false;
        for_each_wing(w, [&](const Wing& wing) {
            const auto count = [&](Index x) {
                ++valence;
                if (std::find(ring_.begin(), ring_.end(), x) != ring_.end()) ++num_common;
            };
            count(wing.next);
            if ((mark_[wing.in] & boundary_mark) != 0) {
                count(wing.last);
                is_boundary = true;
            }
        });
        if (num_common != num_faces) return false;
        // A tetrahedron, or a single face.
        return is_boundary ? valence > 2 : valence > 3 || ring_.size() > 3;
    }

    void rename() {
        std::size_t count = 0;
        for (Index f = 0; f < triangles_.size(); ++f) {
            Triangle t = triangles_[f];
            for (Index& v : t) v = name_[v];
            if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
            for (Index k = 0; k < 3; ++k) mark_[3 * count + k] = mark_[3 * f + k];
            triangles_[count++] = t;
        }
        triangles_.resize(count);
        mark_.resize(3 * count);
    }

    [[nodiscard]] CoarseMesh result() {
        CoarseMesh coarse;
        coarse.vertex_origin = drop_unused(surface_.num_vertices(), triangles_);
        coarse.mesh = {take(surface_.mesh.positions, coarse.vertex_origin), std::move(triangles_)};
        for (std::uint8_t& mark : mark_) mark &= ~boundary_mark;
        coarse.mark = std::move(mark_);
        return coarse;
    }

    const Surface& surface_;
    const std::span<const std::uint8_t> stays_;
    const CoarsenOptions& options_;
    Poller poller_;
    std::vector<Triangle> triangles_;  // Not collapsed so far.
    std::vector<std::uint8_t> mark_;   // #H of these.
    std::vector<Index> name_;          // #V: the vertex that it was collapsed into in this round.
    std::vector<std::uint8_t> is_used_;
    const Vec3 middle_;
    std::vector<Quadric> quadrics_;
    std::optional<Groups> around_;  // The faces at each vertex, at the start of the round.
    std::vector<Wing> wings_;       // Of the vertex that goes.
    std::vector<Index> ring_;       // The vertices around it.
};

}  // namespace

CoarseMesh coarsen(const Surface& surface, std::span<const std::uint8_t> mark,
                   std::span<const std::uint8_t> stays, const CoarsenOptions& options) {
    return Coarsener(surface, mark, stays, options).run();
}

}  // namespace remesh
