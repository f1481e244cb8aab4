// Propagates over Steiner points, uniform ones or, for a given error, inserted ones.
//
// For a given error each round compares the vertices with the exact distances of the window engine,
// and doubles the points on the edges of the faces that the paths of bad vertices cross; if one
// does not improve, of all faces that a path of its exact length can cross.
#include "agvd/propagation/engines.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "agvd/core/number_text.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/propagation/steiner/steiner_front.h"

namespace agvd {
namespace {

// The number of points on each edge. It grows on marked edges.
class SteinerInsertion {
public:
    // \param points  on every edge at first.
    SteinerInsertion(const Surface& surface, int points)
        : surface_(surface),
          points_(surface.num_edges(), static_cast<std::uint16_t>(points)),
          is_marked_(surface.num_edges(), false),
          visited_for_(surface.num_faces(), no_index) {}

    // #E
    [[nodiscard]] const std::vector<std::uint16_t>& points() const { return points_; }

    // Marks the edges of the faces that the path to a vertex crosses, and the edges at the
    // vertices that it passes. The front has run and kept all nodes.
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

    // The same for all faces that a path of the vertex's distance (#V) can cross.
    void mark_between(std::span<const double> distance, Index vertex) {
        std::vector<Index> waiting{Surface::face(surface_.outgoing[vertex])};
        visited_for_[waiting[0]] = vertex;
        while (!waiting.empty()) {
            const Index face = waiting.back();
            waiting.pop_back();
            if (!may_be_crossed(face, distance, vertex)) continue;
            mark_face(face);
            for (Index h = 3 * face; h < 3 * face + 3; ++h) {
                const Index twin = surface_.twin[h];
                if (twin == no_index || visited_for_[Surface::face(twin)] == vertex) continue;
                visited_for_[Surface::face(twin)] = vertex;
                waiting.push_back(Surface::face(twin));
            }
        }
    }

    // Halves the spacing on the marked edges; false if there was no room.
    [[nodiscard]] bool insert() {
        bool has_room = false;
        for (Index e = 0; e < points_.size(); ++e) {
            if (!is_marked_[e] || points_[e] == max_steiner_points) continue;
            points_[e] =
                static_cast<std::uint16_t>(std::min(2 * points_[e] + 1, max_steiner_points));
            has_room = true;
        }
        is_marked_.assign(is_marked_.size(), false);
        visited_for_.assign(visited_for_.size(), no_index);
        return has_room;
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
        for_each_outgoing(surface_, vertex, [&](Index h) {
            is_marked_[surface_.edge[h]] = true;
            is_marked_[surface_.edge[Surface::previous(h)]] = true;  // The last one on a boundary.
        });
    }
    // A point x of the path has d(x) + |x - vertex| <= d(vertex), and a corner of its face is
    // nearer to x than `reach` times the longest side. Distances in space do not exceed those on
    // the surface.
    [[nodiscard]] bool may_be_crossed(Index face, std::span<const double> distance,
                                      Index vertex) const {
        constexpr double reach =
            0.58;  // 1 / sqrt(3), rounded up: an equilateral triangle's middle.
        const std::vector<Vec3>& positions = surface_.mesh.positions;
        double least = infinity;
        double longest = 0;
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Index corner = surface_.tail(h);
            const double in_space =
                surface_.has_own_lengths ? 0 : (positions[corner] - positions[vertex]).norm();
            least = std::min(least, distance[corner] + in_space);
            longest = std::max(longest, surface_.length_of(h));
        }
        return least <= distance[vertex] + 2 * reach * longest;
    }

    const Surface& surface_;
    std::vector<std::uint16_t> points_;  // #E
    std::vector<bool> is_marked_;        // #E
    std::vector<Index> visited_for_;     // #F: the last vertex whose paths were sought in the face.
};

// Distances are sums of some thousand lengths in double.
constexpr double bound_rounding = 1e-12;

constexpr int max_rounds = 20;

// Relative errors of the vertices in a round and in the round before.
struct VertexErrors {
    std::vector<double> now, before;  // #V
    Index worst = 0;

    explicit VertexErrors(Index num_vertices) : now(num_vertices, infinity), before(now) {}

    void update(const std::vector<double>& exact, const std::vector<SteinerNode>& vertices) {
        now.swap(before);
        worst = 0;
        for (Index v = 0; v < exact.size(); ++v) {
            const bool is_measured = exact[v] > 0 && exact[v] < infinity;
            now[v] = bound_rounding;
            if (is_measured) now[v] += std::max(vertices[v].distance / exact[v] - 1, 0.0);
            if (now[v] > now[worst]) worst = v;
        }
    }
    // More points along the path have reduced the error only a little.
    [[nodiscard]] bool is_stuck(Index v) const {
        constexpr double share = 0.9;
        return now[v] > share * before[v];
    }
};

// Errors fall with the square of the spacing at most, unless points happen to lie well.
bool is_in_reach(double error, double max_error, Index most_points) {
    constexpr double luck = 10;
    const double finer = (most_points + 1.0) / (max_steiner_points + 1.0);
    return error * finer * finer <= luck * max_error;
}

[[noreturn]] void refuse(double max_error, const VertexErrors& errors, int rounds,
                         const SteinerCounts& counts, Index num_edges, const char* reason) {
    throw ConstraintUnmet(
        "the Steiner engine cannot keep a maximal error of " + number_text(max_error) +
        ": after round " + std::to_string(rounds) + ", with up to " +
        std::to_string(counts.most()) + " Steiner points on an edge (" +
        std::to_string(counts.total() / num_edges) + " on average), the distance of vertex " +
        std::to_string(errors.worst) + " is off by " + number_text(errors.now[errors.worst]) +
        ", and " + reason + "; allow a larger error, or use the window engine");
}

// Puts together what retires.
class Collector {
public:
    [[nodiscard]] RetirementSink sink() {
        return [this](RetiredFaces&& retired, Poller&) { add(retired); };
    }

    // Of a front all of whose faces have retired.
    [[nodiscard]] Propagation result(const SteinerFront& front) {
        std::ranges::sort(mixed_faces_, {}, [](const auto& mixed) { return mixed.first; });
        Propagation result;
        result.relays.reserve(relays_.size());
        result.mixed_faces.reserve(mixed_faces_.size());
        result.relay_ranges.reserve(mixed_faces_.size());
        for (const auto& [face, range] : mixed_faces_) {
            const auto begin = static_cast<Index>(result.relays.size());
            result.mixed_faces.push_back(face);
            result.relay_ranges.push_back({begin, begin + range.end - range.begin});
            result.relays.insert(result.relays.end(), relays_.begin() + range.begin,
                                 relays_.begin() + range.end);
        }
        const std::vector<SteinerNode>& vertices = front.vertices();
        result.vertex_site.reserve(vertices.size());
        result.vertex_distance.reserve(vertices.size());
        for (const SteinerNode& node : vertices) {
            result.vertex_site.push_back(SiteId(node.site));
            result.vertex_distance.push_back(node.distance);
        }
        const std::size_t collected =
            relays_.capacity() * sizeof(Relay) + mixed_faces_.capacity() * sizeof(mixed_faces_[0]);
        const std::size_t own = result.relays.capacity() * sizeof(Relay) +
                                result.mixed_faces.capacity() * sizeof(Index) +
                                result.relay_ranges.capacity() * sizeof(RelayRange) +
                                vertices.size() * (sizeof(SiteId) + sizeof(double));
        result.peak_bytes =
            collected + std::max(front.peak_bytes(), front.bytes_without_points() + own);
        result.num_nodes = front.num_pops();
        return result;
    }

private:
    void add(const RetiredFaces& retired) {
        const auto first = static_cast<Index>(relays_.size());
        for (std::size_t i = 0; i < retired.mixed_faces.size(); ++i) {
            const auto [begin, end] = retired.relay_ranges[i];
            mixed_faces_.push_back({retired.mixed_faces[i], {first + begin, first + end}});
        }
        relays_.insert(relays_.end(), retired.relays.begin(), retired.relays.end());
    }

    std::vector<std::pair<Index, RelayRange>> mixed_faces_;  // In the order of retirement.
    std::vector<Relay> relays_;
};

Propagation propagate_steiner_within(const Surface& surface, std::span<const SurfacePoint> sites,
                                     const PropagationOptions& options) {
    const double max_error = options.max_error.value();
    double done = 0.1;
    PropagationOptions exactly = options;
    exactly.max_error = 0;
    exactly.progress = within(options.progress, 0, done);
    SurfaceLayout layout(surface, options.num_threads, within(options.progress, 0, 0));
    Propagation exact = propagate_windows(surface, std::move(layout), sites, exactly);
    const std::size_t bytes_of_exact = exact.peak_bytes;
    std::vector<Relay>().swap(exact.relays);

    VertexErrors errors(surface.num_vertices());
    SteinerInsertion insertion(surface, options.steiner_points);
    const std::size_t own_bytes =
        insertion.bytes() + 2 * errors.now.capacity() * sizeof(double) +
        surface.num_vertices() * (sizeof(exact.vertex_distance[0]) + sizeof(exact.vertex_site[0]));
    for (int round = 1;; ++round) {
        const SteinerCounts counts(insertion.points());
        SteinerFront front(surface, sites, {}, options.points.start, counts);
        const double next = done + (1 - done) / 3;
        Collector collector;
        const Progress progress = within(options.progress, done, next);
        Poller poller(progress);
        front.run(infinity, collector.sink(), poller);
        done = next;

        errors.update(exact.vertex_distance, front.vertices());
        const double worst = errors.now[errors.worst];
        if (worst <= max_error) {
            front.retire_all(collector.sink(), poller);
            Propagation result = collector.result(front);
            result.certified_error = worst;
            result.peak_bytes = std::max(bytes_of_exact, result.peak_bytes + own_bytes);
            poll(options.progress, 1);
            return result;
        }
        for (Index v = 0; v < surface.num_vertices(); ++v) {
            if (errors.now[v] <= max_error) continue;
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
        } else if (!NodeNumbers::suffice(surface, SteinerCounts(insertion.points()).most(),
                                         sites.size())) {
            reason = "more points need more than 2^32 nodes";
        }
        if (reason) refuse(max_error, errors, round, counts, surface.num_edges(), reason);
    }
}

struct NumberedPoints {
    std::vector<SurfacePoint> points;
    std::vector<Index> site;
};

// A line is its vertices and the Steiner points on its edges; a region those of all its faces.
NumberedPoints with_shapes(const Surface& surface, std::span<const SurfacePoint> sites,
                           const PropagationOptions& options) {
    NumberedPoints all{{sites.begin(), sites.end()}, std::vector<Index>(sites.size())};
    std::iota(all.site.begin(), all.site.end(), Index{0});
    const double step = 1.0 / (options.steiner_points + 1);
    auto number = static_cast<Index>(sites.size());
    for (const SiteShape& shape : options.shapes) {
        std::vector<Index> edges = shape.edges;
        for (const Index face : shape.faces) {
            for (Index h = 3 * face; h < 3 * face + 3; ++h) edges.push_back(surface.edge[h]);
        }
        for (const Index edge : distinct(std::move(edges))) {
            for (int i = 0; i <= options.steiner_points + 1; ++i) {
                all.points.push_back(point_on(surface.edge_half[edge], std::min(i * step, 1.0)));
            }
        }
        all.site.resize(all.points.size(), number++);
    }
    return all;
}

// As many points on each edge.
// \param read  read(front) is called when all faces have retired.
template <typename Read>
void run_uniform(const Surface& surface, std::span<const SurfacePoint> sites,
                 const PropagationOptions& options, const RetirementSink& sink, const Read& read) {
    const auto m = static_cast<std::uint16_t>(options.steiner_points);
    const SteinerCounts counts(std::vector<std::uint16_t>(surface.num_edges(), m));
    const NumberedPoints all = with_shapes(surface, sites, options);
    SteinerFront front(surface, all.points, all.site, options.points.start, counts);
    front.add_regions(options.shapes, static_cast<Index>(sites.size()));
    Poller poller(options.progress);
    front.run(std::max(1.0, options.lambda * surface.num_faces()), sink, poller);
    front.retire_all(sink, poller);
    read(front);
}

}  // namespace

void retire_steiner(const Surface& surface, std::span<const SurfacePoint> sites,
                    const PropagationOptions& options, const RetirementSink& sink) {
    run_uniform(surface, sites, options, sink, [](const SteinerFront&) {});
}

Propagation propagate_steiner(const Surface& surface, std::span<const SurfacePoint> sites,
                              const PropagationOptions& options) {
    if (options.max_error) return propagate_steiner_within(surface, sites, options);
    Collector collector;
    Propagation result;
    run_uniform(surface, sites, options, collector.sink(),
                [&](const SteinerFront& front) { result = collector.result(front); });
    return result;
}

}  // namespace agvd
