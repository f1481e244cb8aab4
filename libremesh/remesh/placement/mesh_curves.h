//! \file
//! Where the vertices of a mesh lie on a network of curves.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "agvd/mesh/closest_point.h"
#include "remesh/curves/curve_network.h"
#include "remesh/curves/walk.h"

namespace remesh::detail {

//! A vertex on a curve, at a node, or neither.
struct CurvePlace {
    Index curve = no_index;  //!< Not of a node.
    double along = 0;        //!< Mesh units; taken modulo the length on closed curves.
    Index node = no_index;

    [[nodiscard]] bool is_free() const { return curve == no_index && node == no_index; }
};

//! A network and the surface cut along it. Refers to both.
class MeshCurves {
public:
    //! \param whole  the surface of the network.
    //! \param cut    the same faces, cut along the network.
    MeshCurves(const Surface& whole, const Surface& cut, const CurveNetwork& network)
        : whole_(whole), cut_(cut), network_(network) {
        for (Index c = 0; c < network.curves.size(); ++c) {
            const Curve& curve = network.curves[c];
            for (const CurveSide& side : curve.sides) {
                for (Index i = 0; i < side.half_edges.size(); ++i) {
                    edges_.push_back({side.half_edges[i], c, i, side.runs_along});
                }
            }
            if (!curve.is_closed()) ends_.push_back({curve.begin, curve.end, c});
        }
        std::ranges::sort(edges_, {}, &Edge::half_edge);
    }

    [[nodiscard]] const Surface& surface() const { return cut_; }
    [[nodiscard]] const Surface& whole() const { return whole_; }
    //! Whether the surface may have several normals there.
    [[nodiscard]] bool is_sharp(const CurvePlace& place) const {
        return place.node != no_index ||
               (place.curve != no_index && network_.curves[place.curve].sides.size() > 1);
    }

    //! \param point  of the cut surface.
    [[nodiscard]] CurvePlace place_of(const SurfacePoint& point) const {
        const auto& b = point.barycentric;
        const Index face = point.face.value();
        for (Index k = 0; k < 3; ++k) {
            if (b[(k + 1) % 3] != 0 || b[(k + 2) % 3] != 0) continue;
            const Index node = node_at(network_, whole_.tail(3 * face + k));
            if (node != no_index) return {no_index, 0, node};
        }
        const std::optional<Index> h = boundary_half_edge(cut_, point);
        if (!h) return {};
        const auto edge = std::lower_bound(
            edges_.begin(), edges_.end(), *h,
            [](const Edge& e, Index half_edge) { return e.half_edge < half_edge; });
        if (edge == edges_.end() || edge->half_edge != *h) return {};
        const Curve& curve = network_.curves[edge->curve];
        // At a vertex the half-edge leaves it, maybe in another face.
        const double share = Surface::face(*h) == face ? b[(*h % 3 + 1) % 3] : 0;
        const double begin = curve.up_to[edge->index], end = curve.up_to[edge->index + 1];
        const double t = edge->runs_along ? share : 1 - share;
        return {edge->curve, begin + t * (end - begin), no_index};
    }

    //! The curve of an edge of the mesh along the network; no_index: none.
    [[nodiscard]] Index curve_between(const CurvePlace& a, const CurvePlace& b) const {
        if (a.curve != no_index) return a.curve;
        if (b.curve != no_index) return b.curve;
        for (const auto& [begin, end, curve] : ends_) {
            if (std::minmax(begin, end) == std::minmax(a.node, b.node)) return curve;
        }
        return no_index;
    }

    //! Whether an edge of the mesh between two places, free or not, can run along a curve with
    //! several sides.
    [[nodiscard]] bool are_on_crease(const CurvePlace& a, const CurvePlace& b) const {
        const auto is_on = [&](const CurvePlace& place, Index curve) {
            const Curve& c = network_.curves[curve];
            return place.node != no_index ? place.node == c.begin || place.node == c.end
                                          : place.curve == curve;
        };
        const auto is_crease = [&](Index curve) {
            return network_.curves[curve].sides.size() > 1 && is_on(a, curve) && is_on(b, curve);
        };
        if (a.curve != no_index) return is_crease(a.curve);
        if (b.curve != no_index) return is_crease(b.curve);
        return std::ranges::any_of(ends_, [&](const Ends& e) { return is_crease(e.curve); });
    }

    //! Positions of the ends of an edge on its curve. On a closed curve one may be beyond its
    //! length, so that the edge lies between them.
    [[nodiscard]] std::pair<double, double> interval(Index curve, const CurvePlace& a,
                                                     const CurvePlace& b) const {
        const Curve& c = network_.curves[curve];
        double from = along_of(c, curve, a, b.along), to = along_of(c, curve, b, a.along);
        if (c.is_closed() && std::abs(to - from) > c.length() / 2) {
            (from < to ? from : to) += c.length();
        }
        return {from, to};
    }
    [[nodiscard]] SurfacePoint point(Index curve, double along) const {
        return point_on_curve(network_.curves[curve], along);
    }
    //! The place after a step along the curve; none if it would leave it.
    [[nodiscard]] std::optional<CurvePlace> moved(const CurvePlace& from, const Vec3& step) const {
        const Curve& curve = network_.curves[from.curve];
        double along = from.along + step.dot(tangent_of_curve(whole_, curve, from.along));
        if (curve.is_closed()) {
            along -= curve.length() * std::floor(along / curve.length());
        } else if (!(along > 0 && along < curve.length())) {
            return std::nullopt;
        }
        return CurvePlace{from.curve, along, no_index};
    }
    //! The largest distance of the curve between two positions from the segment (a, b).
    [[nodiscard]] double bend(Index curve, std::pair<double, double> interval, const Vec3& a,
                              const Vec3& b) const {
        const Curve& c = network_.curves[curve];
        const auto [low, high] = std::minmax(interval.first, interval.second);
        double most = 0;
        const auto count = c.num_edges();
        auto i = static_cast<std::size_t>(std::upper_bound(c.up_to.begin(), c.up_to.end(), low) -
                                          c.up_to.begin());
        // On a closed curve the interval may go on in a second turn.
        for (const double turn : {0.0, c.length()}) {
            for (; i <= count && c.up_to[i] + turn < high; ++i) {
                const Vec3& vertex = whole_.mesh.positions[c.vertex(whole_, i)];
                most = std::max(most, distance_to_segment(vertex, a, b));
            }
            if (i <= count || !c.is_closed()) break;
            i = 1;
        }
        return most;
    }

private:
    struct Edge {
        Index half_edge, curve, index;
        bool runs_along;
    };
    struct Ends {
        Index begin, end, curve;
    };

    static double along_of(const Curve& curve, Index number, const CurvePlace& place,
                           double other) {
        if (place.curve == number) return place.along;
        if (curve.begin == curve.end) return other < curve.length() / 2 ? 0 : curve.length();
        return place.node == curve.begin ? 0 : curve.length();
    }

    const Surface &whole_, &cut_;
    const CurveNetwork& network_;
    std::vector<Edge> edges_;  // By half-edge.
    std::vector<Ends> ends_;
};

}  // namespace remesh::detail
