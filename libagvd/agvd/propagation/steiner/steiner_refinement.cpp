// Inserts Steiner points until the distances of all vertices are within an error
// (docs/algorithm.md, "Propagation"). Each round propagates, compares the vertices with the exact
// distances of the window engine, and doubles the points on the edges of the faces that the paths
// of bad vertices cross. If a vertex does not improve, all faces that a path of its exact length
// can cross get more points. After the last round, or when the error is out of reach, it throws.
#include "agvd/propagation/steiner/steiner_refinement.h"

#include <cmath>
#include <sstream>

#include "agvd/propagation/steiner/steiner_insertion.h"
#include "agvd/propagation/window/window_engine.h"

namespace agvd {
namespace {

// Distances are sums of some thousand lengths in double.
constexpr double distance_rounding = 1e-12;

constexpr int max_rounds = 20;

// Relative errors of the vertices in a round and in the round before.
class VertexErrors {
public:
    explicit VertexErrors(Index num_vertices) : error_(num_vertices, infinity), before_(error_) {}

    void update(const std::vector<double>& exact, const std::vector<SteinerNode>& vertices) {
        error_.swap(before_);
        worst_ = 0;
        for (Index v = 0; v < exact.size(); ++v) {
            const bool is_measured = exact[v] > 0 && exact[v] < infinity;
            error_[v] = distance_rounding;
            if (is_measured) error_[v] += std::max(vertices[v].distance / exact[v] - 1, 0.0);
            if (error_[v] > error_[worst_]) worst_ = v;
        }
    }

    [[nodiscard]] double operator[](Index v) const { return error_[v]; }
    [[nodiscard]] Index worst() const { return worst_; }
    // More points along the path have reduced the error only a little.
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

// Errors fall with the square of the spacing at most, unless points happen to lie well.
bool is_in_reach(double error, double max_error, Index most_points) {
    constexpr double luck = 10;
    const double finer = (most_points + 1.0) / (max_steiner_points + 1.0);
    return error * finer * finer <= luck * max_error;
}

[[noreturn]] void refuse(double max_error, const VertexErrors& errors, int rounds,
                         const SteinerCounts& counts, Index num_edges, const char* reason) {
    std::ostringstream text;
    text << "the Steiner engine cannot keep a maximal error of " << max_error << ": after round "
         << rounds << ", with up to " << counts.most() << " Steiner points on an edge ("
         << counts.total(num_edges) / num_edges << " on average), the distance of vertex "
         << errors.worst() << " is off by " << errors[errors.worst()] << ", and " << reason
         << "; allow a larger error, or use the window engine";
    throw ConstraintUnmet(text.str());
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
    SteinerInsertion insertion(surface, options.steiner_points);
    const std::size_t own_bytes =
        insertion.bytes() + errors.bytes() +
        surface.num_vertices() * (sizeof(exact.vertex_distance[0]) + sizeof(exact.vertex_site[0]));
    for (int round = 1;; ++round) {
        const SteinerCounts counts(insertion.points());
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
            insertion.mark_path(front, v);
            // Another site's path, or one over other faces, may be the shortest.
            if (errors.is_stuck(v)) insertion.mark_between(exact.vertex_distance, v);
        }
        const char* reason = nullptr;
        if (round == max_rounds) {
            reason = "that is the last round";
        } else if (!is_in_reach(worst, max_error, counts.most())) {
            reason = "1000 points on each edge, the most that are allowed, would not suffice";
        } else if (!insertion.insert()) {
            reason = "the edges along its path have 1000 points, the most that are allowed";
        } else if (!NodeNumbers::suffice(surface, SteinerCounts(insertion.points()).most())) {
            reason = "more points need more than 2^32 nodes";
        }
        if (reason) refuse(max_error, errors, round, counts, surface.num_edges(), reason);
    }
}

}  // namespace agvd
