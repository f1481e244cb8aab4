#include "agvd/propagation/steiner_refinement.h"

#include <cmath>
#include <sstream>

#include "agvd/propagation/steiner_front.h"
#include "agvd/propagation/window_engine.h"

namespace agvd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Distances are sums of some thousand lengths in double.
constexpr double rounding = 1e-12;

constexpr int max_rounds = 20;

// Numbers of points per edge that grow along paths.
class PointPlan {
public:
    PointPlan(const Surface& surface, int points)
        : surface_(surface),
          points_(surface.num_edges(), static_cast<std::uint16_t>(points)),
          is_marked_(surface.num_edges(), false),
          visited_for_(surface.num_faces(), no_index) {}

    [[nodiscard]] const std::vector<std::uint16_t>& points() const { return points_; }

    // The edges of the faces that the path to a vertex crosses, and of the vertices it passes.
    void mark_path(const SteinerFront& front, Index vertex) {
        Index h = surface_.outgoing[vertex];
        Index j = 0;
        for (bool is_end = true;; is_end = false) {
            const SteinerNode& node = front.node(h, j);
            if (j == 0 && !is_end) mark_around(surface_.tail(h));
            if (node.from == no_index) return;
            mark_face(Surface::face(node.from));
            if (node.parent_slot == FaceRing::site_slot) return;
            h = FaceRing::half_edge(node.from, node.parent_slot);
            j = FaceRing::number_of(node.parent_slot);
        }
    }

    // The edges of all faces that a path of this length from `site` to a vertex can cross: a point
    // x of it has |x - site| + |x - vertex| <= length, and a corner of its face is nearer to x than
    // reach times the longest side.
    void mark_between(const SurfacePoint& site, Index vertex, double length) {
        constexpr double reach =
            0.58;  // 1 / sqrt(3), rounded up: an equilateral triangle's middle.
        const std::vector<Vec3>& positions = surface_.mesh.positions;
        const Vec3 start = position(surface_.mesh.view(), site);
        const auto may_be_crossed = [&](Index face) {
            double least = infinity;
            double longest = 0;
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const Vec3& p = positions[surface_.tail(h)];
                least = std::min(least, (p - start).norm() + (p - positions[vertex]).norm());
                longest = std::max(longest, surface_.length_of(h));
            }
            return least <= length + 2 * reach * longest;
        };
        std::vector<Index> waiting{Surface::face(surface_.outgoing[vertex])};
        visited_for_[waiting[0]] = vertex;
        while (!waiting.empty()) {
            const Index face = waiting.back();
            waiting.pop_back();
            if (!may_be_crossed(face)) continue;
            mark_face(face);
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const Index twin = surface_.twin[h];
                if (twin == no_index || visited_for_[Surface::face(twin)] == vertex) continue;
                visited_for_[Surface::face(twin)] = vertex;
                waiting.push_back(Surface::face(twin));
            }
        }
    }

    // Halves the spacing on the marked edges, as far as there is room; false if there is none.
    bool grow() {
        bool has_grown = false;
        for (Index e = 0; e < points_.size(); ++e) {
            if (!is_marked_[e] || points_[e] == max_steiner_points) continue;
            points_[e] =
                static_cast<std::uint16_t>(std::min(2 * points_[e] + 1, max_steiner_points));
            has_grown = true;
        }
        is_marked_.assign(is_marked_.size(), false);
        visited_for_.assign(visited_for_.size(), no_index);
        return has_grown;
    }

    [[nodiscard]] std::size_t bytes() const {
        return points_.capacity() * sizeof(points_[0]) + is_marked_.capacity() / 8 +
               visited_for_.capacity() * sizeof(Index);
    }

private:
    void mark_face(Index face) {
        for (Index h = 3 * face; h < 3 * face + 3; ++h) is_marked_[surface_.edge[h]] = true;
    }

    void mark_around(Index vertex) {
        Index h = surface_.outgoing[vertex];
        do {
            const Index previous = Surface::previous(h);
            is_marked_[surface_.edge[h]] = true;
            is_marked_[surface_.edge[previous]] = true;  // The last one on a boundary.
            h = surface_.twin[previous];
        } while (h != no_index && h != surface_.outgoing[vertex]);
    }

    const Surface& surface_;
    std::vector<std::uint16_t> points_;  // #E
    std::vector<bool> is_marked_;        // #E
    std::vector<Index> visited_for_;     // #F: the last vertex whose paths were looked for here.
};

// Relative errors of the vertices in a round, and in the one before.
class VertexErrors {
public:
    explicit VertexErrors(Index num_vertices) : error_(num_vertices, infinity), before_(error_) {}

    void update(const std::vector<double>& exact, const std::vector<SteinerNode>& vertices) {
        error_.swap(before_);
        worst_ = 0;
        for (Index v = 0; v < exact.size(); ++v) {
            const bool is_measured = exact[v] > 0 && exact[v] < infinity;
            error_[v] = rounding;
            if (is_measured) error_[v] += std::max(vertices[v].distance / exact[v] - 1, 0.0);
            if (error_[v] > error_[worst_]) worst_ = v;
        }
    }

    [[nodiscard]] double operator[](Index v) const { return error_[v]; }
    [[nodiscard]] Index worst() const { return worst_; }
    // More points along its path were of little use.
    [[nodiscard]] bool is_stuck(Index v) const {
        constexpr double share = 0.9;
        return error_[v] > share * before_[v];
    }
    [[nodiscard]] std::size_t bytes() const { return 2 * error_.capacity() * sizeof(double); }

private:
    std::vector<double> error_;   // #V
    std::vector<double> before_;  // #V
    Index worst_ = 0;
};

// Errors fall with the square of the spacing at most, but for luck with where points lie.
bool is_in_reach(double error, double max_error, Index most_points) {
    constexpr double luck = 10;
    const double finer = (most_points + 1.0) / (max_steiner_points + 1.0);
    return error * finer * finer <= luck * max_error;
}

[[noreturn]] void refuse(double max_error, const VertexErrors& errors, int rounds,
                         const SteinerCounts& counts, Index num_edges, const char* reason) {
    std::ostringstream text;
    text << "the Steiner engine cannot meet a maximal error of " << max_error
         << " here: after round " << rounds << ", with up to " << counts.most()
         << " Steiner points on an edge (" << counts.total(num_edges) / num_edges
         << " on average), the distance of vertex " << errors.worst() << " is off by "
         << errors[errors.worst()] << ", and " << reason
         << "; allow a larger error, or use the window engine";
    throw ConstraintUnmet(text.str());
}

// Progress of a part of the work.
Progress within(const Progress& progress, double begin, double end) {
    if (!progress) return {};
    return [&progress, begin, end](double x) { return progress(begin + x * (end - begin)); };
}

}  // namespace

Propagation propagate_steiner_within(const Surface& surface, std::span<const SurfacePoint> sites,
                                     const PropagationOptions& options) {
    const double max_error = options.max_error.value();
    double done = 0.1;
    PropagationOptions exactly = options;
    exactly.max_error = 0;
    exactly.progress = within(options.progress, 0, done);
    Propagation exact = propagate_windows(surface, sites, exactly);
    const std::size_t bytes_of_exact = exact.peak_bytes;
    std::vector<Relay>().swap(exact.relays);

    VertexErrors errors(surface.num_vertices());
    PointPlan plan(surface, options.steiner_points);
    const std::size_t own_bytes =
        plan.bytes() + errors.bytes() +
        surface.num_vertices() * (sizeof(exact.vertex_distance[0]) + sizeof(exact.vertex_site[0]));
    for (int round = 1;; ++round) {
        const SteinerCounts counts(plan.points());
        SteinerFront front(surface, sites, counts);
        const double next = done + (1 - done) / 3;
        front.run(infinity, within(options.progress, done, next));
        done = next;

        errors.update(exact.vertex_distance, front.vertices());
        const double worst = errors[errors.worst()];
        if (worst <= max_error) {
            Propagation result = front.finish();
            result.certified_error = worst;
            result.peak_bytes = std::max(bytes_of_exact, result.peak_bytes + own_bytes);
            poll(options.progress, 1);
            return result;
        }
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            if (errors[v] <= max_error) continue;
            plan.mark_path(front, v);
            // Another site's path, or one over other faces, may be the shortest.
            if (errors.is_stuck(v)) {
                const SurfacePoint& site = sites[exact.vertex_site[v].value()];
                plan.mark_between(site, v, exact.vertex_distance[v]);
            }
        }
        const char* reason = nullptr;
        if (round == max_rounds) {
            reason = "more rounds are not tried";
        } else if (!is_in_reach(worst, max_error, counts.most())) {
            reason = "1000 points, the most there may be, would not do";
        } else if (!plan.grow()) {
            reason = "the edges along its path hold 1000 points, the most there may be";
        } else if (!NodeNumbers::suffice(surface, SteinerCounts(plan.points()).most())) {
            reason = "more points would need more than 2^32 nodes";
        }
        if (reason) refuse(max_error, errors, round, counts, surface.num_edges(), reason);
    }
}

}  // namespace agvd
