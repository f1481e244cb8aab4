#include "remesh/features/curve_network.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "agvd/mesh/one_ring.h"

namespace remesh {
namespace {

using agvd::Index;
using agvd::no_index;
using agvd::Surface;
using agvd::SurfacePoint;
using agvd::Vec3;

constexpr double least_turn = std::numbers::pi / 4;
// In spacings: how far a corner's chords reach, and how near no second corner lies.
constexpr double corner_reach = 0.5;

double turn(const Vec3& before, const Vec3& here, const Vec3& after) {
    const Vec3 in = here - before, out = after - here;
    return std::atan2(in.cross(out).norm(), in.dot(out));
}

class NetworkFinder {
public:
    NetworkFinder(const Surface& surface, std::span<const std::uint8_t> is_crease)
        : surface_(surface),
          is_outside_(surface.num_edges(), 1),
          degree_(surface.num_vertices(), 0) {
        for (Index e = 0; e < surface.num_edges(); ++e) {
            if (!is_boundary(e) && is_crease[e] == 0) continue;
            is_outside_[e] = 0;
            ++degree_[surface.tail(surface.edge_half[e])];
            ++degree_[surface.head(surface.edge_half[e])];
        }
    }

    // \param is_node  #V: 1 where curves end, besides where they must.
    CurveNetwork run(std::span<const std::uint8_t> is_node) {
        CurveNetwork network;
        node_.assign(surface_.num_vertices(), no_index);
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (degree_[v] == 0 || (is_node[v] == 0 && degree_[v] == 2)) {
                continue;
            }
            node_[v] = static_cast<Index>(network.nodes.size());
            network.nodes.push_back(v);
        }
        std::vector<std::uint8_t> is_done = is_outside_;
        for (const Index v : network.nodes) {
            for_each_edge(v, [&](Index e) {
                if (is_done[e] == 0) network.curves.push_back(follow(e, v, is_done));
            });
        }
        for (Index e = 0; e < surface_.num_edges(); ++e) {
            if (is_done[e] != 0) continue;
            network.curves.push_back(follow(e, surface_.tail(surface_.edge_half[e]), is_done));
        }
        return network;
    }

private:
    [[nodiscard]] bool is_boundary(Index e) const {
        return surface_.twin[surface_.edge_half[e]] == no_index;
    }
    [[nodiscard]] Index other_end(Index e, Index v) const {
        const Index h = surface_.edge_half[e];
        return surface_.tail(h) == v ? surface_.head(h) : surface_.tail(h);
    }

    // The network's edges around a vertex.
    template <typename Each>
    void for_each_edge(Index v, const Each& each) const {
        agvd::for_each_outgoing(surface_, v, [&](Index h) {
            if (is_outside_[surface_.edge[h]] == 0) each(surface_.edge[h]);
            const Index last = Surface::previous(h);
            if (surface_.twin[last] == no_index) each(surface_.edge[last]);
        });
    }

    // From a vertex to the next node, or once around.
    Curve follow(Index edge, Index from, std::vector<std::uint8_t>& is_done) const {
        Curve curve;
        curve.begin = node_[from];
        curve.up_to.push_back(0);
        for (Index at = from; edge != no_index;) {
            is_done[edge] = 1;
            const Index h = surface_.edge_half[edge];
            const Index twin = surface_.twin[h];
            const std::size_t side = surface_.tail(h) == at ? 0 : 1;
            curve.half_edges[side].push_back(h);
            if (twin != no_index) curve.half_edges[1 - side].push_back(twin);
            curve.up_to.push_back(curve.up_to.back() + surface_.length[edge]);
            at = other_end(edge, at);
            curve.end = node_[at];
            edge = no_index;
            if (curve.end != no_index) break;
            for_each_edge(at, [&](Index e) {
                if (is_done[e] == 0) edge = e;
            });
        }
        return curve;
    }

    const Surface& surface_;
    std::vector<std::uint8_t> is_outside_;  // #E: 0 for the network's edges.
    std::vector<std::uint8_t> degree_;      // #V: edges of the network.
    std::vector<Index> node_;               // #V
};

// Any side will do where the surface is whole.
Index vertex_of(const Surface& surface, const Curve& curve, std::size_t i) {
    return curve.vertex(surface, i, curve.has(Side::Left) ? Side::Left : Side::Right);
}

// The edge that holds a place of the curve, and the share of it before the place.
std::pair<std::size_t, double> find_place(const Curve& curve, double along) {
    const double length = curve.length();
    along = curve.is_closed() ? along - std::floor(along / length) * length
                              : std::clamp(along, 0.0, length);
    const auto& up_to = curve.up_to;
    const auto after = std::upper_bound(up_to.begin() + 1, up_to.end() - 1, along);
    const auto i = static_cast<std::size_t>(after - up_to.begin()) - 1;
    return {i, std::clamp((along - up_to[i]) / (up_to[i + 1] - up_to[i]), 0.0, 1.0)};
}

// A curve's course in space.
class Course {
public:
    Course(const Surface& surface, const Curve& curve) : curve_(curve) {
        for (std::size_t i = 0; i <= curve.num_edges(); ++i) {
            at_.push_back(surface.mesh.positions[vertex_of(surface, curve, i)]);
        }
    }

    // The lesser of the turn at an inner vertex and that of the chords.
    [[nodiscard]] double sharpness(std::size_t i, double reach) const {
        const std::size_t num_edges = curve_.num_edges();
        const std::size_t before = i == 0 ? num_edges - 1 : i - 1;
        const double here_turn = turn(at_[before], at_[i], at_[i + 1]);
        if (here_turn < least_turn) return 0;
        reach = std::min(reach, curve_.length() / 3);
        const double along = curve_.up_to[i];
        return std::min(here_turn, turn(position(along - reach), at_[i], position(along + reach)));
    }

private:
    [[nodiscard]] Vec3 position(double along) const {
        const auto [i, share] = find_place(curve_, along);
        return (1 - share) * at_[i] + share * at_[i + 1];
    }

    const Curve& curve_;
    std::vector<Vec3> at_;  // By vertex.
};

}  // namespace

CurveNetwork find_network(const Surface& surface, std::span<const std::uint8_t> is_crease,
                          double spacing) {
    NetworkFinder finder(surface, is_crease);
    std::vector<std::uint8_t> is_corner(surface.num_vertices(), 0);
    const CurveNetwork smooth = finder.run(is_corner);
    for (const Curve& curve : smooth.curves) {
        for (const std::size_t i : corners_of_curve(surface, curve, spacing)) {
            is_corner[vertex_of(surface, curve, i)] = 1;
        }
    }
    return finder.run(is_corner);
}

Curve curve_of_loop(const Surface& surface, std::vector<Index> loop) {
    Curve curve;
    curve.up_to.reserve(loop.size() + 1);
    curve.up_to.push_back(0);
    for (const Index h : loop) curve.up_to.push_back(curve.up_to.back() + surface.length_of(h));
    curve.half_edges[0] = std::move(loop);
    return curve;
}

std::vector<std::size_t> corners_of_curve(const Surface& surface, const Curve& curve,
                                          double spacing) {
    const double reach = corner_reach * spacing;
    const Course course(surface, curve);
    std::vector<std::pair<double, std::size_t>> candidates;  // (minus sharpness, vertex)
    for (std::size_t i = curve.is_closed() ? 0 : 1; i < curve.num_edges(); ++i) {
        const double sharp = course.sharpness(i, reach);
        if (sharp >= least_turn) candidates.emplace_back(-sharp, i);
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<std::size_t> corners;
    const auto is_free = [&](double at) {
        if (!curve.is_closed() && std::min(at, curve.length() - at) < reach) return false;
        return std::none_of(corners.begin(), corners.end(), [&](std::size_t corner) {
            const double apart = std::abs(at - curve.up_to[corner]);
            const double around = curve.is_closed() ? curve.length() - apart : apart;
            return std::min(apart, around) < reach;
        });
    };
    for (const auto& [sharp, i] : candidates) {
        if (is_free(curve.up_to[i])) corners.push_back(i);
    }
    std::sort(corners.begin(), corners.end());
    return corners;
}

Index Curve::vertex(const Surface& surface, std::size_t i, Side side) const {
    const bool is_last = i == num_edges();
    const Index h = on(side)[is_last ? i - 1 : i];
    return is_last == (side == Side::Right) ? surface.tail(h) : surface.head(h);
}

SurfacePoint point_on_curve(const Curve& curve, double along, Side side) {
    auto [i, share] = find_place(curve, along);
    if (side == Side::Right) share = 1 - share;
    const Index h = curve.on(side)[i];
    SurfacePoint point{agvd::FaceId(Surface::face(h)), {0, 0, 0}};
    point.barycentric[h % 3] = 1 - share;
    point.barycentric[Surface::next(h) % 3] = share;
    return point;
}

Vec3 tangent_of_curve(const Surface& surface, const Curve& curve, double along) {
    const std::size_t i = find_place(curve, along).first;
    const auto& p = surface.mesh.positions;
    const bool has_left = curve.has(Side::Left);
    const Index h = curve.on(has_left ? Side::Left : Side::Right)[i];
    const Vec3 way = p[surface.head(h)] - p[surface.tail(h)];
    return (has_left ? way : Vec3(-way)).normalized();
}

}  // namespace remesh
