// Looks at the first intervals of all curves at each node: those much longer than the shortest are
// divided.
#include "remesh/curves/curve_sites.h"

#include <algorithm>
#include <cmath>

#include "agvd/core/portable_math.h"
#include "agvd/mesh/closest_point.h"

namespace remesh {
namespace {

constexpr double most_growth = 8;

// A curve's first interval at one of its ends.
struct CurveEnd {
    Index curve = no_index;
    Index node = no_index, next = no_index;  // Nodes at its ends; next: no_index if not a node.
    bool is_begin = true;                    // The interval is at Curve::begin.
    double length = 0;
    Vec3 at, next_at;
};

bool is_much_longer(const CurveEnd& end, const CurveEnd& other) {
    return end.length > most_growth * other.length;
}

// Places that divide a way in geometric progression, with a ratio of at most most_growth. The first
// is `before` times the ratio; the last, which is not returned, is `way`.
std::vector<double> growing_positions(double before, double way) {
    int num_steps = 1;
    for (double most = most_growth; most < way / before; most *= most_growth) ++num_steps;
    const double growth = portable::pow(way / before, 1. / num_steps);
    std::vector<double> positions;
    double position = before;
    for (int i = 1; i < num_steps; ++i) {
        position *= growth;
        positions.push_back(position);
    }
    return positions;
}

class CornerGuard {
public:
    CornerGuard(const Surface& surface, const CurveNetwork& network,
                std::vector<std::vector<double>>& along)
        : surface_(surface), network_(network), along_(along), at_node_(network.nodes.size()) {
        for (Index c = 0; c < network.curves.size(); ++c) {
            if (network.curves[c].is_closed()) continue;
            for (const bool is_begin : {true, false}) {
                const CurveEnd end = end_of(c, is_begin);
                at_node_[end.node].push_back(end);
            }
        }
    }

    void run() {
        for (const std::vector<CurveEnd>& ends : at_node_) {
            const auto shortest = std::ranges::min_element(ends, {}, &CurveEnd::length);
            if (shortest == ends.end() || ends_strip(ends, *shortest)) continue;
            for (const CurveEnd& end : ends) {
                if (network_.curves[end.curve].is_locked) continue;
                if (is_much_longer(end, *shortest)) divide(end, shortest->length);
            }
        }
    }

private:
    [[nodiscard]] Vec3 at(Index c, double along) const {
        return position(surface_.mesh.view(), point_on_curve(network_.curves[c], along));
    }

    [[nodiscard]] CurveEnd end_of(Index c, bool is_begin) const {
        const Curve& curve = network_.curves[c];
        CurveEnd end;
        end.curve = c;
        end.node = is_begin ? curve.begin : curve.end;
        end.is_begin = is_begin;
        const double from = is_begin ? 0 : curve.length();
        double to = curve.length() - from;
        if (along_[c].empty()) {
            end.next = is_begin ? curve.end : curve.begin;
        } else {
            to = is_begin ? along_[c].front() : along_[c].back();
        }
        end.length = std::abs(to - from);
        end.at = at(c, from);
        end.next_at = at(c, to);
        return end;
    }

    // Whether long intervals from both ends of the shortest one run side by side.
    [[nodiscard]] bool ends_strip(const std::vector<CurveEnd>& ends,
                                  const CurveEnd& shortest) const {
        return std::any_of(ends.begin(), ends.end(), [&](const CurveEnd& end) {
            return is_much_longer(end, shortest) && runs_side_by_side(end, shortest);
        });
    }
    [[nodiscard]] bool runs_side_by_side(const CurveEnd& end, const CurveEnd& shortest) const {
        if (shortest.next == no_index) return false;
        const auto& others = at_node_[shortest.next];
        return std::any_of(others.begin(), others.end(), [&](const CurveEnd& other) {
            if (!is_much_longer(other, shortest) || other.curve == end.curve) return false;
            const double apart = std::min(distance_to_segment(end.next_at, other.at, other.next_at),
                                          distance_to_segment(other.next_at, end.at, end.next_at));
            return most_growth * apart < std::min(end.length, other.length);
        });
    }

    void divide(const CurveEnd& end, double before) {
        std::vector<double>& positions = along_[end.curve];
        // A single interval is divided from both ends, each up to its middle.
        const double way = (end.next != no_index ? 0.5 : 1) * end.length;
        const double length = network_.curves[end.curve].length();
        for (const double position : growing_positions(before, way)) {
            positions.push_back(end.is_begin ? position : length - position);
        }
        std::sort(positions.begin(), positions.end());
    }

    const Surface& surface_;
    const CurveNetwork& network_;
    std::vector<std::vector<double>>& along_;
    std::vector<std::vector<CurveEnd>> at_node_;
};

}  // namespace

void guard_corners(const Surface& surface, const CurveNetwork& network,
                   std::vector<std::vector<double>>& along) {
    CornerGuard(surface, network, along).run();
}

}  // namespace remesh
