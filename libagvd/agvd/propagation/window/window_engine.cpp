// Runs the windows ([mitchell1987]) of each site as far as the bounds allow, in batches of
// parallel tasks, whose results are taken in a fixed order. Windows are kept as relays in the
// faces near a change of label in the bounds. Where a site reaches a face of another one by the
// bounds, that one runs once more (docs/algorithm/windows.md).
#include "agvd/propagation/engines.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <numeric>
#include <tuple>
#include <utility>

#include "agvd/core/parallel.h"
#include "agvd/mesh/surface.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/shape_source.h"
#include "agvd/propagation/window/mixed_faces.h"
#include "agvd/propagation/window/window_front.h"

namespace agvd {
namespace {

// Windows of a second site may come to a face if its bound exceeds that of the nearest site by at
// most this share. That is as much as bounds exceed distances. With less, more sites run twice.
constexpr double bound_excess = 0.08;

// The exact border may lie this far from the border of the bounds, as a share of the distance from
// the site. Where that is less than two rings of faces, nothing is widened.
constexpr double shift = 0.2;

using Marks = std::vector<std::uint8_t>;

// #V. 1: at a change of label, 2: next to one.
Marks mark_two_rings(const Surface& surface, const DistanceBounds& bounds) {
    Marks marks(surface.num_vertices(), 0);
    const auto mark = [&](const Triangle& triangle, int bits) {
        for (const Index v : triangle) marks[v] = static_cast<std::uint8_t>(marks[v] | bits);
    };
    for (const Triangle& t : surface.mesh.triangles) {
        const auto &a = bounds.site[t[0]], &b = bounds.site[t[1]], &c = bounds.site[t[2]];
        mark(t, ((a != b) | (b != c)) ? 1 : 0);
    }
    for (const Triangle& t : surface.mesh.triangles) {
        mark(t, ((marks[t[0]] | marks[t[1]] | marks[t[2]]) & 1) << 1);
    }
    return marks;
}

// Widens the marks where two rings are too few, in cells of many faces: as far as a path from the
// other side of the border may be nearly as short as the bound.
void widen(const Surface& surface, const Corners& corners, const DistanceBounds& bounds,
           Marks& marks) {
    const double two_rings = 2 * corners.mean_length();
    std::vector<float> across(marks.size(), std::numeric_limits<float>::infinity());
    std::vector<Index> front;
    const auto reach = [&](Index vertex, float distance) {
        if (!(distance < across[vertex])) return;
        across[vertex] = distance;
        if (!(distance <= (1 + bound_excess) * bounds.distance[vertex])) return;
        marks[vertex] = static_cast<std::uint8_t>(marks[vertex] | 2);
        front.push_back(vertex);
    };
    // On one side of the border; rings of other vertices find what the boundary hides.
    const auto reach_neighbours = [&](Index v, float distance, bool is_own_side) {
        for_each_outgoing(surface, v, [&](Index h) {
            const Index neighbour = corners.head(h);
            if ((bounds.site[neighbour] == bounds.site[v]) != is_own_side) return;
            reach(neighbour, distance + static_cast<float>(corners.length(h)));
        });
    };
    for (Index v = 0; v < surface.num_vertices(); ++v) {
        if ((marks[v] & 1) == 0 || !(shift * bounds.distance[v] > two_rings)) continue;
        reach_neighbours(v, bounds.distance[v], false);
    }
    for (std::size_t i = 0; i < front.size(); ++i) {
        reach_neighbours(front[i], across[front[i]], true);
    }
}

// 1 for the faces where windows of several sites are expected: within two rings of a change of
// label, or where a path from across the change is nearly as short as the bound.
Marks faces_near_borders(const Surface& surface, const Corners& corners,
                         const DistanceBounds& bounds) {
    Marks marks = mark_two_rings(surface, bounds);
    widen(surface, corners, bounds, marks);
    Marks faces;
    faces.reserve(surface.num_faces());
    for (const auto& [a, b, c] : surface.mesh.triangles) {
        faces.push_back((marks[a] | marks[b] | marks[c]) != 0 ? 1 : 0);
    }
    return faces;
}

// Between batches results are taken in and progress is told.
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
};

class WindowEngine {
public:
    WindowEngine(const Surface& surface, std::shared_ptr<const Corners> corners,
                 DistanceBounds bounds, std::span<const SurfacePoint> sites,
                 std::span<const ShapeSource> shapes, const PropagationOptions& options,
                 Index work_cap)
        : surface_(surface),
          corners_(std::move(corners)),
          sites_(sites),
          shapes_(shapes),
          options_(options),
          work_cap_(work_cap),
          bounds_(std::move(bounds)) {
        placement_.add_regions(options.shapes, static_cast<Index>(sites.size()));
        for (const Index face : options.relay_faces) borders_[face] = 1;
    }

    Propagation run() {
        result_.vertex_distance.assign(surface_.num_vertices(), infinity);
        result_.vertex_site.assign(surface_.num_vertices(), SiteId());
        result_.certified_error = 0;
        propagate_all();
        take_bounds();
        propagate_again();
        result_.peak_bytes = corners_->bytes() + bounds_.distance.capacity() * sizeof(float) +
                             bounds_.site.capacity() * sizeof(Index) + common_bytes();
        for (const auto& front : free_fronts_) result_.peak_bytes += front->bytes();
        free_fronts_.clear();
        corners_.reset();
        bounds_ = {};
        Marks().swap(borders_);
        const std::size_t log_bytes = common_bytes();
        write_mixed_faces(surface_, {placement_, options_.points.start}, std::move(logs_),
                          options_.relay_faces, options_.num_threads, poller_, result_);
        result_.peak_bytes =
            std::max(result_.peak_bytes, log_bytes + result_.relays.capacity() * sizeof(Relay) +
                                             result_.mixed_faces.capacity() * 3 * sizeof(Index));
        poller_.tell(1);
        return std::move(result_);
    }

private:
    [[nodiscard]] std::size_t common_bytes() const {
        return result_.vertex_distance.capacity() * sizeof(double) +
               result_.vertex_site.capacity() * sizeof(SiteId) + borders_.capacity() +
               logs_.bytes();
    }

    // The order in which sites run and their relays are stored: neighbours share the cache.
    [[nodiscard]] bool comes_before(Index a, Index b) const {
        return std::pair(face_of(a), a) < std::pair(face_of(b), b);
    }
    // A face where a site begins.
    [[nodiscard]] FaceId face_of(Index site) const {
        if (site < sites_.size()) return sites_[site].face;
        const ShapeSource& shape = shapes_[site - sites_.size()];
        return FaceId(shape.sides.empty() ? 0 : Surface::face(shape.sides.front()));
    }
    void sort_by_face(std::vector<Index>& sites) const {
        std::sort(sites.begin(), sites.end(), [&](Index a, Index b) { return comes_before(a, b); });
    }

    void propagate_all() {
        std::vector<Index> order(sites_.size() + shapes_.size());
        std::iota(order.begin(), order.end(), Index{0});
        sort_by_face(order);
        const auto count = static_cast<Index>(order.size());
        const Index batch = std::max(count / most_batches, least_batch);
        for (Index first = 0; first < count; first += batch) {
            const auto tasks =
                run_tasks(std::span(order).subspan(first, std::min(batch, count - first)),
                          [&](Index site, Index face) {
                              return borders_[face] != 0 || label_of(face) != site;
                          });
            for (const TaskResult& task : tasks) {
                take_vertices(task);
                poller_.poll();
            }
            poller_.tell(static_cast<double>(first + 1) / (count + 1));
        }
    }

    // Runs sites in tasks of equal size, and keeps their relays in the faces with keeps(site,
    // face).
    template <typename Keeps>
    std::vector<TaskResult> run_tasks(std::span<const Index> order, const Keeps& keeps) {
        const auto count = static_cast<Index>(order.size());
        const Index grain = std::max(count / tasks_of_a_batch, Index{1});
        std::vector<TaskResult> tasks(num_chunks(count, grain));
        const auto body = [&](Index chunk, Index begin, Index end) {
            auto front = take_front();
            TaskResult result;
            result.relays = RelayLogs(surface_.num_faces());
            for (Index i = begin; i < end; ++i) {
                const auto keeps_face = [&](Index face) { return keeps(order[i], face); };
                if (order[i] < sites_.size()) {
                    run_front(*front, sites_[order[i]], bounds_.distance, work_cap_, keeps_face,
                              start_of(options_.points.start, order[i]));
                } else {
                    run_front(*front, shapes_[order[i] - sites_.size()], bounds_.distance,
                              work_cap_, keeps_face);
                }
                collect(order[i], *front, keeps_face, result);
            }
            result.vertices.shrink_to_fit();
            result.strays.shrink_to_fit();
            result.relays.shrink_to_fit();
            tasks[chunk] = std::move(result);
            const std::scoped_lock lock(mutex_);
            free_fronts_.push_back(std::move(front));
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

    // A front that no task holds: it is as large as the index arrays of the mesh.
    std::unique_ptr<WindowFront> take_front() {
        const std::scoped_lock lock(mutex_);
        if (free_fronts_.empty()) {
            return std::make_unique<WindowFront>(surface_, *corners_, max_error_, Ticker(poller_));
        }
        auto front = std::move(free_fronts_.back());
        free_fronts_.pop_back();
        return front;
    }

    template <typename Keeps>
    void collect(Index site, const WindowFront& front, const Keeps& keeps, TaskResult& task) const {
        task.num_windows += front.num_served;
        task.error = std::max(task.error, front.relative_error);
        front.for_each_vertex([&](Index vertex, double distance) {
            task.vertices.push_back({distance, vertex, site});
        });
        const auto add = [&](const Relay& relay) {
            if (borders_[Surface::face(relay.half_edge)] != 0) {
                task.relays.add(relay);
            } else {
                task.strays.push_back(relay);
            }
        };
        front.for_each_half_edge([&](Index half_edge, std::span<const Window> windows) {
            if (!keeps(Surface::face(half_edge))) return;
            for (const Window& w : windows) add(to_relay(w, site, half_edge));
        });
        front.for_each_beam([&](const Beam& beam) { add(to_relay(beam, site)); });
    }

    // The site of a face away from borders.
    [[nodiscard]] Index label_of(Index face) const {
        return bounds_.site[surface_.mesh.triangles[face][0]];
    }

    // Tasks are taken in a fixed order, on which ties depend.
    void take_vertices(const TaskResult& task) {
        for (const auto& [distance, vertex, site] : task.vertices) {
            double& best = result_.vertex_distance[vertex];
            SiteId& best_site = result_.vertex_site[vertex];
            if (distance > options_.max_distance) continue;
            if (!is_nearer(distance, site, best, best_site.value())) continue;
            best = distance;
            best_site = SiteId(site);
        }
    }

    // Vertices that no window reached get their bounds, lengths of real paths: no window is
    // shorter.
    void take_bounds() {
        for (Index v = 0; v < surface_.num_vertices(); ++v) {
            if (result_.vertex_site[v].is_valid() || bounds_.site[v] == no_index) continue;
            if (bounds_.distance[v] > options_.max_distance) continue;
            result_.vertex_distance[v] = bounds_.distance[v];
            result_.vertex_site[v] = SiteId(bounds_.site[v]);
            result_.vertices_off_windows.push_back(v);
        }
    }

    // Some faces away from the borders of the bounds belong to several sites. The relays that other
    // sites have there are kept as strays; the sites that own the faces run once more.
    void propagate_again() {
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
        (void)run_tasks(
            again, [&](Index site, Index face) { return is_late[face] && label_of(face) == site; });
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
        const auto is_it = [&](const auto& placed) { return placed.site == site; };
        return std::ranges::all_of(placement_.in_face(face), is_it) &&
               std::ranges::all_of(placement_.regions_of(face), is_it);
    }

    const Surface& surface_;
    std::shared_ptr<const Corners> corners_;
    std::span<const SurfacePoint> sites_;
    std::span<const ShapeSource> shapes_;  // Sites behind the points.
    const PropagationOptions& options_;
    Index work_cap_;
    DistanceBounds bounds_;
    Poller poller_{options_.progress};
    double max_error_ = options_.max_error.value_or(default_max_error);
    SitePlacement placement_{surface_, sites_};
    // #F: 1 where all windows are kept: near borders, and in relay_faces.
    Marks borders_ = faces_near_borders(surface_, *corners_, bounds_);
    std::vector<Relay> strays_;  // As in TaskResult; then all relays of late faces; then none.
    RelayLogs logs_{surface_.num_faces()};
    std::mutex mutex_;
    std::vector<std::unique_ptr<WindowFront>> free_fronts_;
    Propagation result_;
};

// The corners without ways across lines and into regions at distance 0: no path crosses them.
std::shared_ptr<const Corners> corners_around(const Surface& surface,
                                              std::shared_ptr<const Corners> corners,
                                              std::span<const ShapeSource> shapes) {
    std::vector<Index> cut;
    for (const ShapeSource& shape : shapes) {
        if (shape.start > 0) continue;
        for (const Index h : shape.sides) {
            cut.push_back(h);
            if (surface.twin[h] != no_index) cut.push_back(surface.twin[h]);
        }
    }
    if (cut.empty()) return corners;
    return std::make_shared<Corners>(corners->cut_along(cut));
}

// Windows end at caps. What the bounds name beyond them is no site.
void cap(DistanceBounds& bounds, std::span<const float> caps, float max_distance) {
    for (Index v = 0; v < bounds.distance.size(); ++v) {
        const float most = caps.empty() ? max_distance : std::min(caps[v], max_distance);
        if (!(most < bounds.distance[v])) continue;
        bounds.distance[v] = most;
        bounds.site[v] = no_index;
    }
}

}  // namespace

Propagation propagate_windows(const Surface& surface, SurfaceLayout layout,
                              std::span<const SurfacePoint> sites,
                              const PropagationOptions& options, Index work_cap,
                              std::span<const float> caps) {
    poll(options.progress, 0);
    std::vector<ShapeSource> shapes = sources_of(surface, options.shapes);
    leave_own(surface, options.shapes, shapes);
    DistanceBounds bounds =
        distance_bounds(surface, layout, sites, options.num_threads, within(options.progress, 0, 0),
                        options.points.start, options.shapes);
    if (!caps.empty() || options.max_distance < infinity) {
        // Larger than any rounding of a distance.
        cap(bounds, caps, rounded_up(options.max_distance * (1 + 1e-6)));
    }
    auto corners = SurfaceLayout(std::move(layout)).corners();  // Frees the arcs.
    corners = corners_around(surface, std::move(corners), shapes);
    return WindowEngine(surface, std::move(corners), std::move(bounds), sites, shapes, options,
                        work_cap)
        .run();
}

}  // namespace agvd
