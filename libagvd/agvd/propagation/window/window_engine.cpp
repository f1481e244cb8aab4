// Runs the windows ([mitchell1987]) of one site after the other, each only as far as the bounds
// allow, and collects distances and relays. Sites run in batches of parallel tasks. A task uses the
// memory of a worker and hands its results over; they are taken in a fixed order, so that bytes do
// not depend on threads.
//
// Windows are kept as relays in the faces near a change of label in the bounds. Where a site
// reaches a face that the bounds give to another site, its windows are strays: the other site runs
// once more to keep its windows there (docs/algorithm.md, "Window engine").
#include "agvd/propagation/window/window_engine.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/propagation/arc_graph.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window/border_faces.h"
#include "agvd/propagation/window/mixed_faces.h"
#include "agvd/propagation/window/window_front.h"
#include "agvd/propagation/window/window_relays.h"

namespace agvd {
namespace {

// Sites run in batches. The results of a batch are taken in, and progress is told, before the next
// batch starts.
constexpr Index most_batches = 8;
constexpr Index least_batch = 64;
constexpr Index tasks_of_a_batch = 32;

// The results of the sites of one task.
struct TaskResult {
    struct Reached {
        double distance;
        Index vertex;
        Index site;
    };
    std::vector<Reached> vertices;
    std::vector<Relay> strays;  // Relays in faces that the bounds give to another site.
    RelayLogs relays;           // Relays in faces near borders.
    std::size_t num_windows = 0;
    double error = 0;

    void add_strays(std::span<const Window> windows, Index site, Index half_edge) {
        for (const Window& w : windows) strays.push_back(to_relay(w, site, half_edge));
    }
    // Keeps the relays, which hand_over() empties.
    void clear() {
        vertices.clear();
        strays.clear();
        num_windows = 0;
        error = 0;
    }
    [[nodiscard]] std::size_t bytes() const {
        return vertices.capacity() * sizeof(Reached) + strays.capacity() * sizeof(Relay);
    }
};

// The memory of a task. Tasks use it one after the other, since it is as large as the index arrays
// of the mesh.
struct Worker {
    WindowFront front;
    TaskResult result;  // It grows here, and is copied without spare room.
};

// The workers that no task holds.
class WorkerPool {
public:
    WorkerPool(const Surface& surface, const Corners& corners, double max_error, Poller& poller)
        : surface_(surface), corners_(corners), max_error_(max_error), poller_(poller) {}

    std::unique_ptr<Worker> take() {
        const std::scoped_lock lock(mutex_);
        if (free_.empty()) {
            auto worker = std::make_unique<Worker>(
                Worker{WindowFront(surface_, corners_, max_error_, Ticker(poller_)), {}});
            worker->result.relays = RelayLogs(surface_.num_faces());
            return worker;
        }
        auto worker = std::move(free_.back());
        free_.pop_back();
        return worker;
    }
    void give_back(std::unique_ptr<Worker> worker) {
        const std::scoped_lock lock(mutex_);
        free_.push_back(std::move(worker));
    }
    [[nodiscard]] std::size_t bytes() const {
        std::size_t sum = 0;
        for (const auto& worker : free_) {
            sum += worker->front.bytes() + worker->result.bytes();
        }
        return sum;
    }

private:
    const Surface& surface_;
    const Corners& corners_;
    double max_error_;
    Poller& poller_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Worker>> free_;
};

class WindowEngine {
public:
    WindowEngine(const Surface& surface, std::shared_ptr<const Corners> corners,
                 DistanceBounds bounds, std::span<const SurfacePoint> sites,
                 const PropagationOptions& options, Index work_cap)
        : surface_(surface),
          corners_(std::move(corners)),
          sites_(sites),
          options_(options),
          max_error_(options.max_error.value_or(default_max_error)),
          work_cap_(work_cap),
          placement_(surface, sites),
          borders_(faces_near_borders(surface, *corners_, bounds)),
          bounds_(std::move(bounds.distance)),
          labels_(std::move(bounds.site)),
          logs_(surface.num_faces()) {}

    Propagation run() {
        {
            WorkerPool workers(surface_, *corners_, max_error_, poller_);
            result_.vertex_distance.assign(surface_.num_vertices(),
                                           std::numeric_limits<double>::infinity());
            result_.vertex_site.assign(surface_.num_vertices(), SiteId());
            result_.certified_error = 0;
            propagate_all(workers);
            take_bounds();
            propagate_again(workers);
            result_.peak_bytes = corners_->bytes() + workers.bytes() +
                                 bounds_.capacity() * sizeof(float) +
                                 labels_.capacity() * sizeof(Index) + common_bytes();
        }
        corners_.reset();
        std::vector<float>().swap(bounds_);
        std::vector<std::uint8_t>().swap(borders_);
        std::vector<Index>().swap(labels_);
        const std::size_t log_bytes = common_bytes();
        write_mixed_faces(surface_, placement_, std::move(logs_), options_.num_threads, poller_,
                          result_);
        result_.peak_bytes =
            std::max(result_.peak_bytes, log_bytes + result_.relays.capacity() * sizeof(Relay) +
                                             result_.mixed_faces.capacity() * 3 * sizeof(Index));
        poller_.tell(1);
        return std::move(result_);
    }

private:
    [[nodiscard]] std::size_t common_bytes() const {
        std::size_t sum = result_.vertex_distance.capacity() * sizeof(double) +
                          result_.vertex_site.capacity() * sizeof(SiteId) + borders_.capacity();
        return sum + logs_.bytes();
    }

    // The order in which sites run, and in which their relays are stored for a face: by the faces
    // of the sites. Consecutive faces are neighbours on most meshes, so that caches hold what is
    // needed.
    [[nodiscard]] bool comes_before(Index a, Index b) const {
        return std::tie(sites_[a].face, a) < std::tie(sites_[b].face, b);
    }
    void sort_by_face(std::vector<Index>& sites) const {
        std::sort(sites.begin(), sites.end(), [&](Index a, Index b) { return comes_before(a, b); });
    }

    void propagate_all(WorkerPool& workers) {
        std::vector<Index> order(sites_.size());
        std::iota(order.begin(), order.end(), Index{0});
        sort_by_face(order);
        const auto count = static_cast<Index>(order.size());
        const Index batch = std::max(count / most_batches, least_batch);
        for (Index first = 0; first < count; first += batch) {
            const auto tasks = run_tasks(
                std::span(order).subspan(first, std::min(batch, count - first)), workers,
                [&](Index site, Index face) { return is_collected(site, face); },
                [&](Index site, const WindowFront& front, TaskResult& task) {
                    collect(site, front, task);
                });
            for (const TaskResult& task : tasks) {
                take_vertices(task);
                poller_.poll();
            }
            poller_.tell(static_cast<double>(first + 1) / (count + 1));
        }
    }

    // A copy without spare room.
    [[nodiscard]] static TaskResult hand_over(TaskResult& grown) {
        RelayLogs relays = grown.relays.hand_over();
        TaskResult result = grown;
        result.relays = std::move(relays);
        return result;
    }

    // Runs sites in tasks of equal size, and keeps their relays. `collect` gets the windows of the
    // faces with keeps(site, face).
    template <typename Keeps, typename Collect>
    std::vector<TaskResult> run_tasks(std::span<const Index> order, WorkerPool& workers,
                                      const Keeps& keeps, const Collect& collect) {
        const auto count = static_cast<Index>(order.size());
        const Index grain = std::max(count / tasks_of_a_batch, Index{1});
        std::vector<TaskResult> tasks(num_chunks(count, grain));
        const auto body = [&](Index chunk, Index begin, Index end) {
            auto worker = workers.take();
            worker->result.clear();
            for (Index i = begin; i < end; ++i) {
                WindowFront& front = worker->front;
                TaskResult& result = worker->result;
                front.run(sites_[order[i]], bounds_, work_cap_,
                          [&](Index face) { return keeps(order[i], face); });
                result.num_windows += front.num_windows();
                result.error = std::max(result.error, front.relative_error());
                collect(order[i], front, result);
            }
            tasks[chunk] = hand_over(worker->result);
            workers.give_back(std::move(worker));
        };
        parallel_chunks(count, grain, options_.num_threads, body, poller_);
        for (TaskResult& task : tasks) {
            poller_.poll();
            result_.num_nodes += task.num_windows;
            result_.certified_error = std::max(result_.certified_error, task.error);
            logs_.append(std::move(task.relays));
            strays_.insert(strays_.end(), task.strays.begin(), task.strays.end());
        }
        return tasks;
    }

    [[nodiscard]] bool is_collected(Index site, Index face) const {
        return borders_[face] != 0 || label_of(face) != site;
    }

    void collect(Index site, const WindowFront& front, TaskResult& task) {
        front.for_each_vertex([&](const WindowFront::ReachedVertex& v) {
            task.vertices.push_back({v.distance, v.vertex, site});
        });
        front.for_each_half_edge([&](Index half_edge, std::span<const Window> windows) {
            const Index face = Surface::face(half_edge);
            if (borders_[face] != 0) {
                for (const Window& w : windows) task.relays.add(to_relay(w, site, half_edge));
            } else if (label_of(face) != site) {
                task.add_strays(windows, site, half_edge);
            }
        });
    }

    // The site of a face away from borders.
    [[nodiscard]] Index label_of(Index face) const {
        return labels_[surface_.mesh.triangles[face][0]];
    }

    // Tasks are taken in a fixed order, on which ties depend.
    void take_vertices(const TaskResult& task) {
        for (const auto& [distance, vertex, site] : task.vertices) {
            double& best = result_.vertex_distance[vertex];
            SiteId& best_site = result_.vertex_site[vertex];
            if (!is_nearer(distance, site, best, best_site.value())) continue;
            best = distance;
            best_site = SiteId(site);
        }
    }

    // Vertices that no window reached get their bounds. Bounds are lengths of real paths, too. No
    // window came because it would have been longer.
    void take_bounds() {
        for (Index v = 0; v < bounds_.size(); ++v) {
            if (result_.vertex_site[v].is_valid() || labels_[v] == no_index) continue;
            result_.vertex_distance[v] = bounds_[v];
            result_.vertex_site[v] = SiteId(labels_[v]);
            result_.vertices_off_windows.push_back(v);
        }
    }

    // Some faces away from the borders of the bounds belong to several sites. The relays that other
    // sites have there are kept as strays; the sites that own the faces run once more.
    void propagate_again(WorkerPool& workers) {
        std::vector<bool> is_late(surface_.num_faces(), false);
        poller_.poll();
        for (const Relay& stray : strays_) is_late[Surface::face(stray.half_edge)] = true;
        std::vector<Index> again;
        for (Index face = 0; face < surface_.num_faces(); ++face) {
            if (borders_[face] != 0) continue;  // There are no strays here.
            if (!has_one_site(face)) is_late[face] = true;
            if (is_late[face] && label_of(face) != no_index) again.push_back(label_of(face));
        }
        sort_by_face(again);
        again.erase(std::unique(again.begin(), again.end()), again.end());
        poller_.poll();
        const auto num_strays = static_cast<std::ptrdiff_t>(strays_.size());
        const auto keeps = [&](Index site, Index face) {
            return is_late[face] && label_of(face) == site;
        };
        (void)run_tasks(
            again, workers, keeps, [&](Index site, const WindowFront& front, TaskResult& task) {
                front.for_each_half_edge([&](Index half_edge, std::span<const Window> windows) {
                    if (!keeps(site, Surface::face(half_edge))) return;
                    task.add_strays(windows, site, half_edge);
                });
            });
        std::inplace_merge(strays_.begin(), strays_.begin() + num_strays, strays_.end(),
                           [&](const Relay& a, const Relay& b) {
                               return comes_before(a.site.value(), b.site.value());
                           });
        for (const Relay& stray : strays_) logs_.add(stray);
        std::vector<Relay>().swap(strays_);
    }

    [[nodiscard]] bool has_one_site(Index face) const {
        const Index site = label_of(face);
        for (const Index v : surface_.mesh.triangles[face]) {
            if (result_.vertex_site[v].value() != site) return false;
        }
        const auto placed = placement_.in_face(face);
        return std::all_of(placed.begin(), placed.end(),
                           [&](const PlacedSite& p) { return p.site == site; });
    }

    const Surface& surface_;
    std::shared_ptr<const Corners> corners_;
    std::span<const SurfacePoint> sites_;
    const PropagationOptions& options_;
    Poller poller_{options_.progress};
    double max_error_;
    Index work_cap_;
    SitePlacement placement_;
    std::vector<std::uint8_t> borders_;  // #F: 1 where all windows are kept.
    std::vector<float> bounds_;          // #V, of the nearest site.
    std::vector<Index> labels_;          // #V: the sites of the bounds.
    std::vector<Relay> strays_;  // As in TaskResult; then all relays of late faces; then none.
    RelayLogs logs_;
    Propagation result_;
};

}  // namespace

Propagation propagate_windows(const Surface& surface, std::shared_ptr<const Corners> corners,
                              DistanceBounds bounds, std::span<const SurfacePoint> sites,
                              const PropagationOptions& options, Index work_cap) {
    return WindowEngine(surface, std::move(corners), std::move(bounds), sites, options, work_cap)
        .run();
}

Propagation propagate_windows(const Surface& surface, std::span<const SurfacePoint> sites,
                              const PropagationOptions& options) {
    poll(options.progress, 0);
    const Progress begin = within(options.progress, 0, 0);
    auto corners = std::make_shared<const Corners>(surface, options.num_threads, begin);
    const auto find_bounds = [&] {  // Frees the arcs before windows are made.
        const ArcGraph arcs(surface, *corners, options.num_threads, begin);
        return distance_bounds(surface, arcs, corners->mean_length(), sites, options.num_threads,
                               begin);
    };
    DistanceBounds bounds = find_bounds();
    return propagate_windows(surface, std::move(corners), std::move(bounds), sites, options);
}

}  // namespace agvd
