// Bounds: a search along arcs that lets each vertex take k labels, in ascending order. Then the
// windows of each point, line and region, as in the window engine, but with the k-th bound in place
// of the first.
#include <algorithm>
#include <memory>
#include <mutex>
#include <queue>
#include <string>
#include <tuple>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface_points.h"
#include "agvd/paths/distances.h"
#include "agvd/propagation/engines.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/window/window_front.h"

namespace agvd {
namespace {

constexpr Index sources_of_a_task = 4;
constexpr Index tasks_of_a_round = 64;

// A path from a site to a vertex.
struct KLabel {
    float distance;
    Index site, vertex;

    [[nodiscard]] auto key() const { return std::tie(distance, site, vertex); }
    bool operator>(const KLabel& other) const { return key() > other.key(); }
};

// #V x k, ascending in each row: lengths of paths from different sites; infinity and no_index where
// there are fewer.
struct KBounds {
    Index k;
    std::vector<float> distance;
    std::vector<Index> site;

    //! Takes a path in, if the site has no shorter one and is one of the k nearest.
    bool take(const KLabel& label) {
        const std::size_t row = std::size_t{label.vertex} * k;
        Index at = 0;  // The place of the site, or the last one.
        while (at + 1 < k && site[row + at] != label.site && site[row + at] != no_index) ++at;
        if (site[row + at] != label.site) at = k - 1;
        if (!is_before(label, row + at)) return false;
        for (; at > 0 && is_before(label, row + at - 1); --at) {
            distance[row + at] = distance[row + at - 1];
            site[row + at] = site[row + at - 1];
        }
        distance[row + at] = label.distance;
        site[row + at] = label.site;
        return true;
    }
    //! Whether the path is still the one that its site has there.
    [[nodiscard]] bool holds(const KLabel& label) const {
        const std::size_t row = std::size_t{label.vertex} * k;
        for (std::size_t i = row; i < row + k; ++i) {
            if (site[i] == label.site) return distance[i] == label.distance;
        }
        return false;
    }

private:
    [[nodiscard]] bool is_before(const KLabel& label, std::size_t place) const {
        return std::tie(label.distance, label.site) < std::tie(distance[place], site[place]);
    }
};

// What the paths of the sites begin at: points, and shapes behind them.
struct Sources {
    std::span<const SurfacePoint> points;
    const SitePoints& roles;
    const std::vector<SiteShape>& shapes;
    std::vector<ShapeSource> of_shapes;

    [[nodiscard]] Index size() const { return static_cast<Index>(points.size() + shapes.size()); }
    [[nodiscard]] Index site_of(Index source) const {
        return source < points.size() ? roles.site_of(source) : shapes[source - points.size()].site;
    }
};

KBounds k_bounds(const Surface& surface, const ArcGraph& graph, const Sources& sources, Index k,
                 Ticker ticker) {
    constexpr float farthest = std::numeric_limits<float>::infinity();
    const std::size_t size = std::size_t{surface.num_vertices()} * k;
    KBounds bounds{k, std::vector<float>(size, farthest), std::vector<Index>(size, no_index)};
    std::priority_queue<KLabel, std::vector<KLabel>, std::greater<>> queue;
    const auto reach = [&](const KLabel& label) {
        if (bounds.take(label)) queue.push(label);
    };
    const auto begin = [&](double distance, Index source, Index vertex) {
        reach({rounded_up(distance * (1 + 1e-6)), sources.site_of(source), vertex});
    };
    const auto num_points = static_cast<Index>(sources.points.size());
    for (Index i = 0; i < num_points; ++i) {
        const double start = start_of(sources.roles.start, i);
        for_each_view(surface, sources.points[i], [&](const SurfacePoint& view) {
            for (Index h = 3 * view.face.value(); h < 3 * view.face.value() + 3; ++h) {
                begin(start + face_distance(surface, view, point_on(h, 0)), i, surface.tail(h));
            }
        });
    }
    for (Index i = 0; i < sources.of_shapes.size(); ++i) {
        const ShapeSource& source = sources.of_shapes[i];
        for (const Index vertex : source.vertices) begin(source.start, num_points + i, vertex);
    }
    while (!queue.empty()) {
        ticker.tick(4);
        const KLabel label = queue.top();
        queue.pop();
        if (!bounds.holds(label)) continue;
        for (Index a = graph.offsets[label.vertex]; a < graph.ends[label.vertex]; ++a) {
            const auto& [head, length] = graph.arcs[a];
            reach({std::nextafter(label.distance + length, farthest), label.site, head});
        }
    }
    return bounds;
}

// What the windows of some sites reach.
struct KReached {
    double distance;
    Index vertex, site;
};
struct KTask {
    std::vector<KReached> reached;
    double error = 0;
};

class KNearestSearch {
public:
    KNearestSearch(const Surface& surface, std::span<const SurfacePoint> points, Index k,
                   const KNearestOptions& options)
        : surface_(surface),
          sources_{points, options.points, options.shapes, sources_of(surface, options.shapes)},
          options_(options),
          poller_(options.progress) {
        result_.k = k;
    }

    KNearest run() {
        const SurfaceLayout layout(surface_, options_.num_threads, poller_.progress());
        corners_ = layout.corners();
        const KBounds bounds =
            k_bounds(surface_, layout.arcs(), sources_, result_.k, Ticker(poller_));
        const Index k = result_.k, num_vertices = surface_.num_vertices();
        result_.site.assign(bounds.site.size(), SiteId());
        result_.distance.assign(bounds.site.size(), infinity);
        last_.resize(num_vertices);
        for (Index v = 0; v < num_vertices; ++v) {
            last_[v] = bounds.distance[std::size_t{v} * k + k - 1];
        }
        run_sources();
        for (Index v = 0; v < num_vertices; ++v) add_missing(v, bounds);
        poller_.tell(1);
        return std::move(result_);
    }

private:
    // In rounds of tasks, whose results are taken in the order of the sources.
    void run_sources() {
        const Index count = sources_.size();
        constexpr Index round = sources_of_a_task * tasks_of_a_round;
        for (Index first = 0; first < count; first += round) {
            const Index here = std::min(round, count - first);
            std::vector<KTask> tasks(num_chunks(here, sources_of_a_task));
            const auto body = [&](Index chunk, Index begin, Index end) {
                auto front = take_front();
                for (Index i = begin; i < end; ++i) run_source(first + i, *front, tasks[chunk]);
                const std::scoped_lock lock(mutex_);
                free_fronts_.push_back(std::move(front));
            };
            parallel_chunks(here, sources_of_a_task, options_.num_threads, body, poller_);
            for (const KTask& task : tasks) {
                result_.certified_error = std::max(result_.certified_error, task.error);
                for (const KReached& r : task.reached) insert(r);
                poller_.poll();
            }
            poller_.tell(static_cast<double>(first + here) / (count + 1));
        }
    }
    void run_source(Index source, WindowFront& front, KTask& task) const {
        const auto keeps_none = [](Index) { return false; };
        if (source < sources_.points.size()) {
            run_front(front, sources_.points[source], last_, default_work_cap, keeps_none,
                      start_of(sources_.roles.start, source));
        } else {
            run_front(front, sources_.of_shapes[source - sources_.points.size()], last_,
                      default_work_cap, keeps_none);
        }
        task.error = std::max(task.error, front.relative_error);
        front.for_each_vertex([&](Index vertex, double distance) {
            task.reached.push_back({distance, vertex, sources_.site_of(source)});
        });
    }
    std::unique_ptr<WindowFront> take_front() {
        const std::scoped_lock lock(mutex_);
        if (free_fronts_.empty()) {
            return std::make_unique<WindowFront>(surface_, *corners_, options_.max_error,
                                                 Ticker(poller_));
        }
        auto front = std::move(free_fronts_.back());
        free_fronts_.pop_back();
        return front;
    }

    // Keeps the k nearest of a row; each site comes once.
    void insert(const KReached& reached) {
        const std::size_t row = std::size_t{reached.vertex} * result_.k;
        const auto begin_of = [&](auto& values) {
            return values.begin() + static_cast<std::ptrdiff_t>(row);
        };
        const auto sites = begin_of(result_.site);
        // The place that is given up: that of the same site, or the last one.
        const Index own =
            static_cast<Index>(std::find(sites, sites + result_.k, SiteId(reached.site)) - sites);
        if (own < result_.k && !(reached.distance < result_.distance[row + own])) return;
        const Index last = std::min(own, result_.k - 1);
        Index at = own;
        while (at > 0 && is_nearer(reached.distance, reached.site, result_.distance[row + at - 1],
                                   result_.site[row + at - 1].value())) {
            --at;
        }
        if (at == result_.k) return;
        const auto shift = [&](auto& values, const auto& value) {
            const auto begin = begin_of(values);
            std::rotate(begin + at, begin + last, begin + last + 1);
            values[row + at] = value;
        };
        shift(result_.distance, reached.distance);
        shift(result_.site, SiteId(reached.site));
    }
    // Sites whose windows left a gap at a vertex: their bounds are lengths of real paths.
    void add_missing(Index vertex, const KBounds& bounds) {
        const std::size_t row = std::size_t{vertex} * result_.k;
        const auto begin = result_.site.begin() + static_cast<std::ptrdiff_t>(row);
        for (Index i = 0; i < result_.k && bounds.site[row + i] != no_index; ++i) {
            const SiteId site(bounds.site[row + i]);
            if (std::find(begin, begin + result_.k, site) != begin + result_.k) continue;
            insert({bounds.distance[row + i], vertex, site.value()});
        }
    }

    const Surface& surface_;
    Sources sources_;
    const KNearestOptions& options_;
    Poller poller_;
    std::shared_ptr<const Corners> corners_;
    std::vector<float> last_;  // #V: bound of the k-th distance.
    std::mutex mutex_;
    std::vector<std::unique_ptr<WindowFront>> free_fronts_;
    KNearest result_;
};

}  // namespace

KNearest k_nearest_sites(const Surface& surface, std::span<const SurfacePoint> sites, Index k,
                         const KNearestOptions& options) {
    if (k == 0) throw InvalidOption("k is 0; ask for 1 or more nearest sites");
    if (!(options.max_error >= 0 && options.max_error < 1)) {
        throw InvalidOption("the maximal error is " + std::to_string(options.max_error) +
                            "; use a number from 0 (exact) to below 1");
    }
    check_num_threads(options.num_threads);
    check_generators(surface, sites, options.points, options.shapes);
    return KNearestSearch(surface, sites, k, options).run();
}

}  // namespace agvd
