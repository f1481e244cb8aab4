#include "agvd/propagation/moving_sites.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/propagation/arc_graph.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window_engine.h"
#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_relays.h"

namespace agvd {
namespace {

// What one site has propagated.
struct SiteRun {
    struct Vertex {
        Index vertex;
        double distance;  // Infinity where only the bound was asked for.
    };
    struct HalfEdge {
        Index half_edge;
        Index first, count;  // In relays.
    };
    SurfacePoint point;
    bool is_removed = false;
    std::vector<Vertex> vertices = {};      // Ascending.
    std::vector<HalfEdge> half_edges = {};  // Ascending.
    std::vector<Relay> relays = {};         // In the order in which the run came to its half-edges.
    double error = 0;
    std::size_t num_windows = 0;

    [[nodiscard]] double distance(Index vertex) const {
        const auto found =
            std::lower_bound(vertices.begin(), vertices.end(), vertex,
                             [](const Vertex& v, Index wanted) { return v.vertex < wanted; });
        return found->distance;
    }
};

SiteRun propagated(WindowFront& front, const SurfacePoint& point, std::span<const float> bounds) {
    front.run(point, bounds, default_work_cap);
    SiteRun run{point};
    run.error = front.relative_error();
    run.num_windows = front.num_windows();
    front.for_each_bound([&](Index vertex) {
        run.vertices.push_back({vertex, std::numeric_limits<double>::infinity()});
    });
    std::sort(run.vertices.begin(), run.vertices.end(),
              [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    front.for_each_vertex([&](const WindowFront::ReachedVertex& v) {
        const auto found = std::lower_bound(
            run.vertices.begin(), run.vertices.end(), v.vertex,
            [](const auto& reached, Index wanted) { return reached.vertex < wanted; });
        found->distance = v.distance;
    });
    front.for_each_half_edge([&](Index half_edge, std::span<const Window> windows) {
        run.half_edges.push_back(
            {half_edge, static_cast<Index>(run.relays.size()), static_cast<Index>(windows.size())});
        for (const Window& w : windows) run.relays.push_back(to_relay(w, no_index, half_edge));
    });
    std::sort(run.half_edges.begin(), run.half_edges.end(),
              [](const auto& a, const auto& b) { return a.half_edge < b.half_edge; });
    return run;
}

bool is_same_relay(const Relay& a, const Relay& b) {
    return a.x == b.x && a.y == b.y && a.weight == b.weight && a.begin == b.begin && a.end == b.end;
}

// Calls each(key, was, is) for the keys of two ascending lists that only one has, or that both have
// with different contents.
template <typename Entry, typename IsSame, typename Each>
void for_each_difference(const std::vector<Entry>& before, const std::vector<Entry>& now,
                         Index Entry::*key, const IsSame& is_same, const Each& each) {
    auto b = before.begin();
    auto n = now.begin();
    while (b != before.end() || n != now.end()) {
        if (n == now.end() || (b != before.end() && (*b).*key < (*n).*key)) {
            each((*b++).*key, true, false);
        } else if (b == before.end() || (*n).*key < (*b).*key) {
            each((*n++).*key, false, true);
        } else {
            if (!is_same(*b, *n)) each((*n).*key, true, true);
            ++b;
            ++n;
        }
    }
}

void keep_unique(std::vector<Index>& indices) {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

}  // namespace

// Sites are known here by numbers that never change; those of the caller are their ranks among the
// sites that are left.
class MovingSites::State {
public:
    State(const Surface& surface, const SurfaceLayout& layout, std::vector<SurfacePoint> sites,
          const PropagationOptions& options)
        : surface_(surface),
          corners_(layout.corners()),
          num_threads_(options.num_threads),
          max_error_(options.max_error.value_or(default_max_error)),
          search_(surface, layout.arcs(), corners_.mean_length(), options.num_threads),
          bounds_(surface.num_vertices(), std::numeric_limits<float>::infinity()),
          readers_(surface.num_vertices()),
          place_(surface.num_faces(), no_index) {
        result_.vertex_site.assign(surface.num_vertices(), SiteId());
        result_.vertex_distance.assign(surface.num_vertices(),
                                       std::numeric_limits<double>::infinity());
        result_.relay_offsets = {0};
        (void)search_.take_changes();
        update({.moved = {}, .removed = {}, .added = std::move(sites)});
    }

    void update(const SiteChanges& changes) {
        std::vector<SurfacePoint> sites = changed_sites(changes);
        SitePlacement placement(surface_, sites);

        std::vector<Index> dirty = change_search(changes);  // Sites, by number.
        const bool is_renumbered = !changes.removed.empty();
        renumber();
        sites_ = std::move(sites);
        for (const Index v : search_.take_changes()) {
            if (bounds_[v] == search_.distance(v)) continue;
            bounds_[v] = search_.distance(v);
            dirty.insert(dirty.end(), readers_[v].begin(), readers_[v].end());
        }
        keep_unique(dirty);

        std::vector<SiteRun> before;
        for (const Index site : dirty) {
            SiteRun& run = runs_[site];
            before.push_back(std::exchange(run, {run.point, run.is_removed}));
        }
        propagate(dirty);
        num_propagated_ = static_cast<Index>(std::count_if(
            dirty.begin(), dirty.end(), [&](Index site) { return !runs_[site].is_removed; }));

        std::vector<Index> vertices;
        std::vector<Index> faces = std::move(site_faces_);
        for (std::size_t i = 0; i < dirty.size(); ++i) {
            compare(before[i], dirty[i], vertices, faces);
        }
        keep_unique(vertices);
        if (is_renumbered) renumber_result();
        std::erase_if(vertices, [&](Index v) { return !settle_vertex(v); });
        add_faces_around(vertices, faces);
        keep_unique(faces);
        placement_ = std::move(placement);
        replace_faces(faces);
        changed_faces_ = std::move(faces);
        tell_totals();
    }

    [[nodiscard]] const std::vector<SurfacePoint>& sites() const { return sites_; }
    [[nodiscard]] const Propagation& propagation() const { return result_; }
    [[nodiscard]] Index num_propagated() const { return num_propagated_; }
    [[nodiscard]] const std::vector<Index>& changed_faces() const { return changed_faces_; }

private:
    [[nodiscard]] std::vector<SurfacePoint> changed_sites(const SiteChanges& changes) const {
        const auto count = static_cast<Index>(sites_.size());
        std::vector<bool> is_named(count, false);
        const auto name = [&](Index site) {
            if (site >= count || is_named[site]) {
                throw InvalidInput("site " + std::to_string(site) +
                                   (site >= count ? " does not exist; there are " +
                                                        std::to_string(count) + " sites"
                                                  : " is changed twice; name it once"));
            }
            is_named[site] = true;
        };
        std::vector<SurfacePoint> sites = sites_;
        for (const auto& [site, point] : changes.moved) {
            name(site);
            sites[site] = point;
        }
        for (const Index site : changes.removed) name(site);
        std::vector<bool> is_removed(count, false);
        for (const Index site : changes.removed) is_removed[site] = true;
        std::vector<SurfacePoint> result;
        for (Index s = 0; s < count; ++s) {
            if (!is_removed[s]) result.push_back(sites[s]);
        }
        result.insert(result.end(), changes.added.begin(), changes.added.end());
        check_sites(surface_, result);
        return result;
    }

    // Brings the bounds up to date. \return the numbers of the sites that changed.
    std::vector<Index> change_search(const SiteChanges& changes) {
        std::vector<Index> changed;
        for (const auto& [site, point] : changes.moved) changed.push_back(numbers_[site]);
        for (const Index site : changes.removed) changed.push_back(numbers_[site]);
        site_faces_.clear();
        std::vector<bool> is_changed(runs_.size(), false);
        for (const Index site : changed) {
            is_changed[site] = true;
            add_faces_of(runs_[site].point);
        }
        search_.remove(is_changed);
        for (const auto& [site, point] : changes.moved) {
            runs_[numbers_[site]].point = point;
            add_faces_of(point);
        }
        for (const Index site : changes.removed) runs_[numbers_[site]].is_removed = true;
        for (const SurfacePoint& point : changes.added) {
            changed.push_back(static_cast<Index>(runs_.size()));
            add_faces_of(point);
            runs_.push_back({point});
        }
        for (Index n = 0; n < runs_.size(); ++n) {  // Some may have been hidden behind others.
            if (!runs_[n].is_removed) search_.add(runs_[n].point, n);
        }
        search_.run();
        return changed;
    }

    void renumber() {
        numbers_.clear();
        ranks_.assign(runs_.size(), no_index);
        for (Index n = 0; n < runs_.size(); ++n) {
            if (runs_[n].is_removed) continue;
            ranks_[n] = static_cast<Index>(numbers_.size());
            numbers_.push_back(n);
        }
    }

    // Ranks stay in order, so that a table of the old ones is enough.
    void renumber_result() {
        std::vector<SiteId> new_rank;
        for (Index n = 0; n < old_ranks_.size(); ++n) {
            if (old_ranks_[n] != no_index) new_rank.push_back(SiteId(ranks_[n]));
        }
        for (SiteId& site : result_.vertex_site) {
            if (site.is_valid()) site = new_rank[site.value()];
        }
        for (Relay& relay : result_.relays) relay.site = new_rank[relay.site.value()];
    }

    void propagate(std::span<const Index> sites) {
        constexpr Index grain = 4;
        std::mutex mutex;
        parallel_chunks(static_cast<Index>(sites.size()), grain, num_threads_,
                        [&](Index, Index begin, Index end) {
                            std::unique_ptr<WindowFront> front;
                            {
                                const std::scoped_lock lock(mutex);
                                if (!fronts_.empty()) {
                                    front = std::move(fronts_.back());
                                    fronts_.pop_back();
                                }
                            }
                            if (!front) {
                                front =
                                    std::make_unique<WindowFront>(surface_, corners_, max_error_);
                            }
                            for (Index i = begin; i < end; ++i) {
                                SiteRun& run = runs_[sites[i]];
                                if (run.is_removed) continue;
                                run = propagated(*front, run.point, bounds_);
                            }
                            const std::scoped_lock lock(mutex);
                            fronts_.push_back(std::move(front));
                        });
    }

    // Lists where a site's run is not what it was.
    void compare(const SiteRun& before, Index site, std::vector<Index>& vertices,
                 std::vector<Index>& faces) {
        const SiteRun& now = runs_[site];
        const auto is_same_vertex = [](const SiteRun::Vertex& a, const SiteRun::Vertex& b) {
            return a.distance == b.distance;
        };
        for_each_difference(before.vertices, now.vertices, &SiteRun::Vertex::vertex, is_same_vertex,
                            [&](Index v, bool was, bool is) {
                                if (was && !is) std::erase(readers_[v], site);
                                if (is && !was) readers_[v].push_back(site);
                                vertices.push_back(v);
                            });
        const auto is_same_half_edge = [&](const SiteRun::HalfEdge& a, const SiteRun::HalfEdge& b) {
            const auto of_a = before.relays.begin() + a.first;
            const auto of_b = now.relays.begin() + b.first;
            return std::equal(of_a, of_a + a.count, of_b, of_b + b.count, is_same_relay);
        };
        for_each_difference(
            before.half_edges, now.half_edges, &SiteRun::HalfEdge::half_edge, is_same_half_edge,
            [&](Index half_edge, bool, bool) { faces.push_back(Surface::face(half_edge)); });
    }

    // In the order in which propagate() takes sites in.
    [[nodiscard]] bool comes_before(Index a, Index b) const {
        const FaceId face = runs_[a].point.face;
        const FaceId other = runs_[b].point.face;
        return face < other || (face == other && a < b);
    }

    // False if nothing changes.
    [[nodiscard]] bool settle_vertex(Index v) {
        std::vector<Index>& readers = readers_[v];
        std::sort(readers.begin(), readers.end(),
                  [&](Index a, Index b) { return comes_before(a, b); });
        double best = std::numeric_limits<double>::infinity();
        Index best_site = no_index;
        for (const Index site : readers) {
            const double distance = runs_[site].distance(v);
            if (!(distance < std::numeric_limits<double>::infinity())) continue;
            if (!is_nearer(distance, ranks_[site], best, best_site)) continue;
            best = distance;
            best_site = ranks_[site];
        }
        const SiteId site(best_site);
        if (result_.vertex_distance[v] == best && result_.vertex_site[v] == site) return false;
        result_.vertex_distance[v] = best;
        result_.vertex_site[v] = site;
        return true;
    }

    void add_faces_around(std::span<const Index> vertices, std::vector<Index>& faces) const {
        for (const Index v : vertices) {
            const Index first = surface_.outgoing[v];
            for (Index h = first; h != no_index;) {
                faces.push_back(Surface::face(h));
                h = corners_.twin(Surface::previous(h));
                if (h == first) break;
            }
        }
    }

    void add_faces_of(const SurfacePoint& point) {
        site_faces_.push_back(point.face.value());
        const auto half_edge = half_edge_of(point);
        if (half_edge && corners_.twin(*half_edge) != no_index) {
            site_faces_.push_back(Surface::face(corners_.twin(*half_edge)));
        }
    }

    // Windows of one site through one half-edge of a face.
    struct Visit {
        Index place;  // Of the face, among those asked for.
        Index site;
        Index first, count;  // Of its relays.
    };

    // Those to given faces, face by face, site by site in the order of propagate(), and of each
    // site in the order of its run. `ends` gets where the visits to each face end.
    [[nodiscard]] std::vector<Visit> find_visits(std::span<const Index> faces,
                                                 std::vector<Index>& ends) {
        std::vector<Index> sites;
        std::vector<std::uint8_t> is_listed(runs_.size(), 0);
        for (Index i = 0; i < faces.size(); ++i) {
            place_[faces[i]] = i;
            for (const Index v : surface_.mesh.triangles[faces[i]]) {
                for (const Index site : readers_[v]) {
                    if (std::exchange(is_listed[site], 1) == 0) sites.push_back(site);
                }
            }
        }
        std::sort(sites.begin(), sites.end(), [&](Index a, Index b) { return comes_before(a, b); });
        std::vector<Visit> by_site;
        ends.assign(faces.size(), 0);
        for (const Index site : sites) {
            for (const SiteRun::HalfEdge& h : runs_[site].half_edges) {
                const Index place = place_[Surface::face(h.half_edge)];
                if (place == no_index || h.count == 0) continue;
                by_site.push_back({place, site, h.first, h.count});
                ++ends[place];
                // Half-edges of one face follow each other: at most three.
                for (std::size_t i = by_site.size() - 1;
                     i > 0 && by_site[i - 1].place == place && by_site[i - 1].site == site &&
                     by_site[i - 1].first > by_site[i].first;
                     --i) {
                    std::swap(by_site[i - 1], by_site[i]);
                }
            }
        }
        std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), Index{0});
        std::vector<Visit> visits(by_site.size());
        for (const Visit& visit : by_site) visits[ends[visit.place]++] = visit;
        for (const Index face : faces) place_[face] = no_index;
        return visits;
    }

    // Adds the relays of a face if it is mixed; else false.
    [[nodiscard]] bool collect(Index face, std::span<const Visit> visits,
                               std::vector<Relay>& out) const {
        FaceRelays all;
        for (const Visit& visit : visits) all.add_site(visit.site);
        for (const Index v : surface_.mesh.triangles[face]) {
            const SiteId site = result_.vertex_site[v];
            if (site.is_valid()) all.add_site(numbers_[site.value()]);
        }
        const auto placed = placement_.in_face(face);
        for (const PlacedSite& p : placed) all.add_site(numbers_[p.site]);
        if (all.site != FaceRelays::several) return false;
        for (const Visit& visit : visits) {
            const auto first = runs_[visit.site].relays.begin() + visit.first;
            out.insert(out.end(), first, first + visit.count);
            for (std::size_t i = out.size() - visit.count; i < out.size(); ++i) {
                out[i].site = SiteId(ranks_[visit.site]);
            }
        }
        const std::size_t windows = out.size();
        out.resize(windows + count_inner_relays(surface_, placed, result_, face));
        write_inner_relays(surface_, placed, result_, face, out.data() + windows);
        return true;
    }

    // Ascending faces get new relays; the others keep theirs.
    void replace_faces(std::span<const Index> faces) {
        constexpr Index grain = 256;
        struct Chunk {
            std::vector<Relay> relays;
            std::vector<Index> mixed_faces;
            std::vector<Index> ends;
        };
        const auto count = static_cast<Index>(faces.size());
        std::vector<Index> ends;
        const std::vector<Visit> visits = find_visits(faces, ends);
        std::vector<Chunk> chunks(num_chunks(count, grain));
        parallel_chunks(count, grain, num_threads_, [&](Index chunk, Index begin, Index end) {
            for (Index i = begin; i < end; ++i) {
                Chunk& out = chunks[chunk];
                const Index first = i == 0 ? 0 : ends[i - 1];
                const auto visits_here = std::span(visits).subspan(first, ends[i] - first);
                if (!collect(faces[i], visits_here, out.relays)) continue;
                out.mixed_faces.push_back(faces[i]);
                out.ends.push_back(static_cast<Index>(out.relays.size()));
            }
        });

        Propagation& old = result_;
        spare_.mixed_faces.clear();
        spare_.relay_offsets.clear();
        spare_.relays.clear();
        spare_.relays.reserve(old.relays.size());
        const auto add = [&](Index face, std::span<const Relay> relays) {
            spare_.mixed_faces.push_back(face);
            spare_.relay_offsets.push_back(static_cast<Index>(spare_.relays.size()));
            spare_.relays.insert(spare_.relays.end(), relays.begin(), relays.end());
        };
        Index kept = 0;
        const auto keep_before = [&](Index face) {
            const auto first = old.mixed_faces.begin() + kept;
            const auto last = std::lower_bound(first, old.mixed_faces.end(), face);
            const auto end = kept + static_cast<Index>(last - first);
            const Index begin_of_relays = old.relay_offsets[kept];
            // Modulo 2^32, so that it may go up or down.
            const Index shift = static_cast<Index>(spare_.relays.size()) - begin_of_relays;
            spare_.mixed_faces.insert(spare_.mixed_faces.end(), first, last);
            for (Index i = kept; i < end; ++i) {
                spare_.relay_offsets.push_back(old.relay_offsets[i] + shift);
            }
            spare_.relays.insert(spare_.relays.end(), old.relays.begin() + begin_of_relays,
                                 old.relays.begin() + old.relay_offsets[end]);
            kept = end;
        };
        std::size_t replaced = 0;
        const auto drop_before = [&](Index face) {
            for (; replaced < faces.size() && faces[replaced] < face; ++replaced) {
                keep_before(faces[replaced]);
                if (kept < old.mixed_faces.size() && old.mixed_faces[kept] == faces[replaced]) {
                    ++kept;
                }
            }
        };
        for (const Chunk& chunk : chunks) {
            Index begin = 0;
            for (std::size_t i = 0; i < chunk.ends.size(); ++i) {
                drop_before(chunk.mixed_faces[i] + 1);
                add(chunk.mixed_faces[i],
                    std::span(chunk.relays).subspan(begin, chunk.ends[i] - begin));
                begin = chunk.ends[i];
            }
        }
        drop_before(no_index);
        keep_before(no_index);
        spare_.relay_offsets.push_back(static_cast<Index>(spare_.relays.size()));
        std::swap(old.mixed_faces, spare_.mixed_faces);
        std::swap(old.relay_offsets, spare_.relay_offsets);
        std::swap(old.relays, spare_.relays);
    }

    void tell_totals() {
        old_ranks_ = ranks_;
        result_.certified_error = 0;
        result_.num_nodes = 0;
        for (const SiteRun& run : runs_) {
            result_.certified_error = std::max(result_.certified_error, run.error);
            result_.num_nodes += run.num_windows;
        }
    }

    const Surface& surface_;
    const Corners& corners_;
    int num_threads_;
    double max_error_;
    BoundsSearch search_;
    std::vector<float> bounds_;                // #V
    std::vector<std::vector<Index>> readers_;  // #V: the sites whose runs came to a vertex.
    std::vector<SiteRun> runs_;                // By number.
    std::vector<Index> numbers_;               // By rank.
    std::vector<Index> ranks_, old_ranks_;     // By number; no_index: removed.
    std::vector<SurfacePoint> sites_;          // By rank.
    std::vector<Index> site_faces_;            // Where changed sites were and are.
    SitePlacement placement_;
    std::vector<Index> place_;  // #F: no_index but during a search for visits.
    std::vector<std::unique_ptr<WindowFront>> fronts_;
    Propagation result_;
    Propagation spare_;  // Its relays are memory for the next ones.
    Index num_propagated_ = 0;
    std::vector<Index> changed_faces_;
};

MovingSites::MovingSites(const Surface& surface, const SurfaceLayout& layout,
                         std::vector<SurfacePoint> sites, const PropagationOptions& options) {
    if (options.engine != Engine::Window) {
        throw InvalidOption(std::string("moving sites need the window engine, not the ") +
                            engine_name(options.engine) + " engine");
    }
    check_options(surface, options);
    state_ = std::make_unique<State>(surface, layout, std::move(sites), options);
}
MovingSites::MovingSites(MovingSites&&) noexcept = default;
MovingSites& MovingSites::operator=(MovingSites&&) noexcept = default;
MovingSites::~MovingSites() = default;

void MovingSites::update(const SiteChanges& changes) { state_->update(changes); }
const std::vector<SurfacePoint>& MovingSites::sites() const { return state_->sites(); }
const Propagation& MovingSites::propagation() const { return state_->propagation(); }
Index MovingSites::num_propagated() const { return state_->num_propagated(); }
const std::vector<Index>& MovingSites::changed_faces() const { return state_->changed_faces(); }

}  // namespace agvd
