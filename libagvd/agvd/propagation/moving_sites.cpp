#include "agvd/propagation/moving_sites.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/distinct_points.h"
#include "agvd/propagation/arc_graph.h"
#include "agvd/propagation/distance_bounds.h"
#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/relay_store.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/site_run.h"
#include "agvd/propagation/window_engine.h"
#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_relays.h"

namespace agvd {
namespace {

// A site, by number, and what its run gives at a vertex that it has read.
struct Reader {
    Index site;
    double distance;
};

// All that a site that ran again gives to a face: relays of its chunk.
struct Patch {
    Index face;
    Index site;
    Index chunk;
    Index first, count;
};

struct Source {
    SurfacePoint point;
    PlaceOnSurface place;
    bool is_removed = false;
    bool is_repeat = false;  // Lies where an earlier one does, and so owns nothing.

    [[nodiscard]] bool is_silent() const { return is_removed || is_repeat; }
};

// Of the sites of one task, one after the other.
struct ChunkChanges {
    struct End {
        Index vertices, faces;
    };
    RunChanges changes;
    std::vector<End> ends;
};

// What some faces are to have.
struct CollectedFaces {
    struct Face {
        Index begin;
        Index num_windows, count;
        bool is_mixed;
    };
    std::vector<Face> faces;
    std::vector<Relay> relays;
};

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
          starting_at_(surface.num_vertices()),
          readers_(surface.num_vertices()),
          is_listed_(surface.num_vertices(), 0),
          placement_(surface, {}),
          place_(surface.num_faces(), no_index),
          store_(surface.num_faces()) {
        result_.vertex_site.assign(surface.num_vertices(), SiteId());
        result_.vertex_distance.assign(surface.num_vertices(),
                                       std::numeric_limits<double>::infinity());
        (void)search_.take_changes();
        update({.moved = {}, .removed = {}, .added = std::move(sites)});
    }

    void update(const SiteChanges& changes) {
        std::vector<SurfacePoint> sites = changed_sites(changes);

        change_search(changes);
        sites_ = std::move(sites);
        renumber();
        if (!changes.removed.empty()) renumber_result();
        if (num_placed_ > 0 || !placement_.is_empty()) placement_ = {surface_, sites_};
        const std::vector<Index> dirty = find_dirty();
        num_propagated_ = static_cast<Index>(std::count_if(
            dirty.begin(), dirty.end(), [&](Index site) { return !sources_[site].is_silent(); }));
        propagate(dirty);

        take_changes(dirty);
        std::erase_if(vertices_, [&](Index v) { return !settle_vertex(v); });
        list_faces();
        sort_patches();
        replace_faces();
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

    [[nodiscard]] bool is_placed(Index site) const {  // Not at a vertex.
        return sources_[site].place.element >= surface_.num_vertices();
    }

    // Brings the search for bounds up to date, and marks the sites that changed.
    void change_search(const SiteChanges& changes) {
        site_faces_.clear();
        is_changed_.assign(sources_.size(), 0);
        std::vector<Index> starts;  // Of the sites that changed, before and after.
        const auto take_out = [&](Index site) {
            is_changed_[site] = 1;
            num_placed_ -= is_placed(site) ? 1 : 0;
            add_faces_of(sources_[site].point);
            for (const Index v : search_.starts_of(sources_[site].point)) {
                std::erase(starting_at_[v], site);
                starts.push_back(v);
            }
        };
        const auto put_in = [&](Index site, const SurfacePoint& point) {
            sources_[site].point = point;
            sources_[site].place = place_of(surface_, point);
            num_placed_ += is_placed(site) ? 1 : 0;
            add_faces_of(point);
            for (const Index v : search_.starts_of(point)) {
                std::vector<Index>& sites = starting_at_[v];  // An edge names its ends twice.
                if (sites.empty() || sites.back() != site) sites.push_back(site);
                starts.push_back(v);
            }
            search_.add(point, site);
        };
        for (const auto& [site, point] : changes.moved) take_out(numbers_[site]);
        for (const Index site : changes.removed) {
            take_out(numbers_[site]);
            sources_[numbers_[site]].is_removed = true;
        }
        for (const Index v : search_.remove(is_changed_)) {
            for (const Index site : starting_at_[v]) search_.add(sources_[site].point, site);
        }
        for (const auto& [site, point] : changes.moved) put_in(numbers_[site], point);
        for (const SurfacePoint& point : changes.added) {
            const auto site = static_cast<Index>(sources_.size());
            sources_.emplace_back();
            runs_.emplace_back();
            is_changed_.push_back(1);
            put_in(site, point);
        }
        for (const Index v : starts) find_repeats(starting_at_[v]);
        search_.run();
    }

    // Among sites that start at one vertex; those that lie on one another do.
    void find_repeats(std::vector<Index>& sites) {
        std::sort(sites.begin(), sites.end(), [&](Index a, Index b) {
            return std::pair(sources_[a].place, a) < std::pair(sources_[b].place, b);
        });
        for (std::size_t i = 0; i < sites.size(); ++i) {
            Source& source = sources_[sites[i]];
            const bool is_repeat = i > 0 && sources_[sites[i - 1]].place == source.place;
            if (std::exchange(source.is_repeat, is_repeat) == is_repeat) continue;
            is_changed_[sites[i]] = 1;
            add_faces_of(source.point);
        }
    }

    // Those that changed and those that have read a bound that is another now, in the order of
    // propagate().
    [[nodiscard]] std::vector<Index> find_dirty() {
        std::vector<Index> dirty;
        for (Index site = 0; site < is_changed_.size(); ++site) {
            if (is_changed_[site] != 0) dirty.push_back(site);
        }
        std::vector<std::uint8_t> is_dirty = is_changed_;
        for (const Index v : search_.take_changes()) {
            if (bounds_[v] == search_.distance(v)) continue;
            bounds_[v] = search_.distance(v);
            for (const Reader& reader : readers_[v]) {
                if (std::exchange(is_dirty[reader.site], 1) == 0) dirty.push_back(reader.site);
            }
        }
        std::sort(dirty.begin(), dirty.end(), [&](Index a, Index b) { return comes_before(a, b); });
        return dirty;
    }

    void renumber() {
        numbers_.clear();
        ranks_.assign(sources_.size(), no_index);
        for (Index n = 0; n < sources_.size(); ++n) {
            if (sources_[n].is_removed) continue;
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
        store_.renumber_sites(new_rank, result_);
    }

    void propagate(std::span<const Index> sites) {
        std::mutex mutex;
        const auto count = static_cast<Index>(sites.size());
        changes_.resize(num_chunks(count, grain));
        parallel_chunks(count, grain, num_threads_, [&](Index chunk, Index begin, Index end) {
            std::unique_ptr<WindowFront> front;
            {
                const std::scoped_lock lock(mutex);
                if (!fronts_.empty()) {
                    front = std::move(fronts_.back());
                    fronts_.pop_back();
                }
            }
            if (!front) front = std::make_unique<WindowFront>(surface_, corners_, max_error_);
            ChunkChanges& out = changes_[chunk];
            out.changes.clear();
            out.ends.clear();
            for (Index i = begin; i < end; ++i) {
                const Index site = sites[i];
                if (sources_[site].is_silent()) {
                    forget_run(runs_[site], out.changes);
                } else {
                    front->run(sources_[site].point, bounds_, default_work_cap);
                    replace_run(*front, is_changed_[site] != 0, runs_[site], out.changes);
                }
                out.ends.push_back({static_cast<Index>(out.changes.vertices.size()),
                                    static_cast<Index>(out.changes.faces.size())});
            }
            const std::scoped_lock lock(mutex);
            fronts_.push_back(std::move(front));
        });
    }

    // Lists the vertices to be settled anew, once each, and the patches, site after site.
    void take_changes(std::span<const Index> sites) {
        vertices_.clear();
        patches_.clear();
        for (Index i = 0; i < sites.size(); ++i) {
            const Index site = sites[i];
            const ChunkChanges& chunk = changes_[i / grain];
            const auto begin = i % grain == 0 ? ChunkChanges::End{0, 0} : chunk.ends[i % grain - 1];
            const auto end = chunk.ends[i % grain];
            for (Index k = begin.vertices; k < end.vertices; ++k) {
                const RunChanges::Vertex& change = chunk.changes.vertices[k];
                take_vertex(site, change);
                if (std::exchange(is_listed_[change.vertex], 1) == 0) {
                    vertices_.push_back(change.vertex);
                }
            }
            for (Index k = begin.faces; k < end.faces; ++k) {
                const RunChanges::Face& change = chunk.changes.faces[k];
                patches_.push_back({change.face, site, i / grain, change.first, change.count});
            }
        }
        for (const Index v : vertices_) is_listed_[v] = 0;
    }

    void take_vertex(Index site, const RunChanges::Vertex& change) {
        std::vector<Reader>& readers = readers_[change.vertex];
        const auto reader = std::find_if(readers.begin(), readers.end(),
                                         [&](const Reader& r) { return r.site == site; });
        if (reader == readers.end()) {
            readers.push_back({site, change.distance});
        } else if (change.is_read) {
            reader->distance = change.distance;
        } else {
            readers.erase(reader);
        }
    }

    // In the order in which propagate() takes sites in.
    [[nodiscard]] bool comes_before(Index a, Index b) const {
        const FaceId face = sources_[a].point.face;
        const FaceId other = sources_[b].point.face;
        return face < other || (face == other && a < b);
    }

    // False if nothing changes.
    [[nodiscard]] bool settle_vertex(Index v) {
        std::vector<Reader>& readers = readers_[v];
        std::sort(readers.begin(), readers.end(),
                  [&](const Reader& a, const Reader& b) { return comes_before(a.site, b.site); });
        double best = std::numeric_limits<double>::infinity();
        Index best_site = no_index;
        for (const auto& [number, distance] : readers) {
            if (!(distance < std::numeric_limits<double>::infinity())) continue;
            if (!is_nearer(distance, ranks_[number], best, best_site)) continue;
            best = distance;
            best_site = ranks_[number];
        }
        const SiteId site(best_site);
        if (result_.vertex_distance[v] == best && result_.vertex_site[v] == site) return false;
        result_.vertex_distance[v] = best;
        result_.vertex_site[v] = site;
        return true;
    }

    // Those with patches, around settled vertices and of sites that changed.
    void list_faces() {
        changed_faces_.clear();
        const auto add = [&](Index face) {
            if (std::exchange(place_[face], 0) == no_index) changed_faces_.push_back(face);
        };
        for (const Index face : site_faces_) add(face);
        for (const Patch& patch : patches_) add(patch.face);
        for (const Index v : vertices_) {
            const Index first = surface_.outgoing[v];
            for (Index h = first; h != no_index;) {
                add(Surface::face(h));
                h = corners_.twin(Surface::previous(h));
                if (h == first) break;
            }
        }
        std::sort(changed_faces_.begin(), changed_faces_.end());
    }

    void add_faces_of(const SurfacePoint& point) {
        site_faces_.push_back(point.face.value());
        const auto half_edge = half_edge_of(point);
        if (half_edge && corners_.twin(*half_edge) != no_index) {
            site_faces_.push_back(Surface::face(corners_.twin(*half_edge)));
        }
    }

    // By face; those to one face keep their order.
    void sort_patches() {
        for (Index i = 0; i < changed_faces_.size(); ++i) place_[changed_faces_[i]] = i;
        patch_ends_.assign(changed_faces_.size(), 0);
        for (const Patch& patch : patches_) ++patch_ends_[place_[patch.face]];
        std::exclusive_scan(patch_ends_.begin(), patch_ends_.end(), patch_ends_.begin(), Index{0});
        sorted_patches_.resize(patches_.size());
        for (const Patch& patch : patches_) {
            sorted_patches_[patch_ends_[place_[patch.face]]++] = patch;
        }
        for (const Index face : changed_faces_) place_[face] = no_index;
    }

    [[nodiscard]] std::span<const Patch> patches_to(Index changed) const {
        const Index first = changed == 0 ? 0 : patch_ends_[changed - 1];
        return std::span(sorted_patches_).subspan(first, patch_ends_[changed] - first);
    }

    // Appends the relays that a face has now.
    void collect(Index face, std::span<const Patch> patches, CollectedFaces& out) const {
        FaceRelays all;
        const auto append = [&](std::span<const Relay> relays, Index rank) {
            if (relays.empty()) return;
            all.add_site(rank);
            for (const Relay& relay : relays) out.relays.push_back(relay);
            const auto first = out.relays.end() - static_cast<std::ptrdiff_t>(relays.size());
            std::for_each(first, out.relays.end(), [&](Relay& r) { r.site = SiteId(rank); });
        };
        auto patch = patches.begin();
        const auto append_patch = [&] {
            append(std::span(changes_[patch->chunk].changes.relays)
                       .subspan(patch->first, patch->count),
                   ranks_[patch->site]);
            ++patch;
        };
        const std::size_t begin = out.relays.size();
        std::span<const Relay> old = store_.windows(result_, face);
        while (!old.empty()) {
            const SiteId site = old.front().site;
            std::size_t count = 1;
            while (count < old.size() && old[count].site == site) ++count;
            if (site.is_valid()) {  // Else it was removed.
                const Index number = numbers_[site.value()];
                const auto is_patched =
                    std::any_of(patches.begin(), patches.end(),
                                [&](const Patch& p) { return p.site == number; });
                if (!is_patched) {
                    while (patch != patches.end() && comes_before(patch->site, number)) {
                        append_patch();
                    }
                    append(old.first(count), site.value());
                }
            }
            old = old.subspan(count);
        }
        while (patch != patches.end()) append_patch();
        const auto num_windows = static_cast<Index>(out.relays.size() - begin);

        for (const Index v : surface_.mesh.triangles[face]) {
            all.add_site(result_.vertex_site[v].value());
        }
        const auto placed = placement_.in_face(face);
        for (const PlacedSite& p : placed) all.add_site(p.site);
        const bool is_mixed = all.site == FaceRelays::several;
        if (is_mixed) {
            const std::size_t windows_end = out.relays.size();
            out.relays.resize(windows_end + count_inner_relays(surface_, placed, result_, face));
            write_inner_relays(surface_, placed, result_, face, out.relays.data() + windows_end);
        }
        out.faces.push_back({static_cast<Index>(begin), num_windows,
                             static_cast<Index>(out.relays.size() - begin), is_mixed});
    }

    // What collect() reads of a face, in two steps.
    [[gnu::always_inline]] void prefetch(Index far, Index near) const {
        if (far != no_index) {
            store_.prefetch_place(far);
            __builtin_prefetch(&surface_.mesh.triangles[far]);
        }
        if (near != no_index) {
            store_.prefetch_relays(result_, near);
            for (const Index v : surface_.mesh.triangles[near]) {
                __builtin_prefetch(&result_.vertex_site[v]);
                __builtin_prefetch(&result_.vertex_distance[v]);
                __builtin_prefetch(&surface_.can_turn[v]);
            }
        }
    }

    void replace_faces() {
        constexpr Index grain_of_faces = 256;
        const auto count = static_cast<Index>(changed_faces_.size());
        collected_.resize(num_chunks(count, grain_of_faces));
        parallel_chunks(count, grain_of_faces, num_threads_,
                        [&](Index chunk, Index begin, Index end) {
                            CollectedFaces& out = collected_[chunk];
                            out.faces.clear();
                            out.relays.clear();
                            for (Index i = begin; i < end; ++i) {
                                prefetch(i + 6 < end ? changed_faces_[i + 6] : no_index,
                                         i + 3 < end ? changed_faces_[i + 3] : no_index);
                                collect(changed_faces_[i], patches_to(i), out);
                            }
                        });
        for (Index i = 0; i < count; ++i) {
            const CollectedFaces& chunk = collected_[i / grain_of_faces];
            const auto& [begin, num_windows, size, is_mixed] = chunk.faces[i % grain_of_faces];
            store_.replace(changed_faces_[i], std::span(chunk.relays).subspan(begin, size),
                           num_windows, is_mixed, result_);
        }
        store_.list_mixed_faces(changed_faces_, result_);
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

    static constexpr Index grain = 4;  // Sites that one task propagates.

    const Surface& surface_;
    const Corners& corners_;
    int num_threads_;
    double max_error_;
    BoundsSearch search_;
    std::vector<float> bounds_;                    // #V
    std::vector<std::vector<Index>> starting_at_;  // #V: the sites whose paths start at a vertex.
    std::vector<std::vector<Reader>> readers_;     // #V: the sites whose runs came to a vertex.
    std::vector<Source> sources_;                  // By number, as the next two.
    std::vector<SiteRun> runs_;
    std::vector<std::uint8_t> is_changed_;  // By the last change itself.
    std::vector<Index> numbers_;            // By rank.
    std::vector<Index> ranks_, old_ranks_;  // By number; no_index: removed.
    std::vector<SurfacePoint> sites_;       // By rank.
    std::vector<Index> site_faces_;         // Where changed sites were and are.
    std::vector<std::uint8_t> is_listed_;   // #V: 0 but while vertices are listed.
    Index num_placed_ = 0;                  // Sites that do not lie at vertices.
    SitePlacement placement_;
    std::vector<Index> place_;  // #F: no_index but while faces are listed.
    std::vector<std::unique_ptr<WindowFront>> fronts_;
    std::vector<ChunkChanges> changes_;
    std::vector<Index> vertices_;  // To be settled.
    std::vector<Patch> patches_, sorted_patches_;
    std::vector<Index> patch_ends_;  // By changed face.
    std::vector<CollectedFaces> collected_;
    RelayStore store_;
    Propagation result_;
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
