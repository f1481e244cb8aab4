#include "agvd/update/moving_sites.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <numeric>
#include <string>

#include "agvd/core/parallel.h"
#include "agvd/mesh/one_ring.h"
#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/window_engine.h"
#include "agvd/propagation/window_front.h"
#include "agvd/propagation/window_relays.h"
#include "agvd/update/numbered_sites.h"
#include "agvd/update/relay_store.h"
#include "agvd/update/site_run.h"

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

// Sites are known here by the numbers of NumberedSites.
class MovingSites::State {
public:
    State(const Surface& surface, const SurfaceLayout& layout, std::vector<SurfacePoint> sites,
          const PropagationOptions& options)
        : surface_(surface),
          corners_(layout.corners()),
          num_threads_(options.num_threads),
          max_error_(options.max_error.value_or(default_max_error)),
          sites_(surface, layout, options.num_threads),
          readers_(surface.num_vertices()),
          is_listed_(surface.num_vertices(), 0),
          placement_(surface, {}),
          place_(surface.num_faces(), no_index),
          store_(surface.num_faces()) {
        result_.vertex_site.assign(surface.num_vertices(), SiteId());
        result_.vertex_distance.assign(surface.num_vertices(),
                                       std::numeric_limits<double>::infinity());
        update({.moved = {}, .removed = {}, .added = std::move(sites)});
    }

    void update(const SiteChanges& changes) {
        sites_.change(changes);
        runs_.resize(sites_.count());
        if (!changes.removed.empty()) renumber_result();
        if (sites_.has_placed() || !placement_.is_empty()) placement_ = {surface_, sites()};
        const std::vector<Index> dirty = find_dirty();
        num_propagated_ = static_cast<Index>(std::count_if(
            dirty.begin(), dirty.end(), [&](Index site) { return !sites_.owns_nothing(site); }));
        propagate(dirty);

        take_changes(dirty);
        list_bounded_vertices();
        std::erase_if(vertices_, [&](Index v) { return !settle_vertex(v); });
        list_faces();
        sort_patches();
        replace_faces();
        tell_totals();
    }

    [[nodiscard]] const std::vector<SurfacePoint>& sites() const { return sites_.points(); }
    [[nodiscard]] const Propagation& propagation() const { return result_; }
    [[nodiscard]] Index num_propagated() const { return num_propagated_; }
    [[nodiscard]] const std::vector<Index>& changed_faces() const { return changed_faces_; }

private:
    // Those that changed and those that have read a bound that is another now, in the order of
    // propagate().
    [[nodiscard]] std::vector<Index> find_dirty() const {
        std::vector<std::uint8_t> is_dirty = sites_.is_changed();
        std::vector<Index> dirty;
        for (Index site = 0; site < is_dirty.size(); ++site) {
            if (is_dirty[site] != 0) dirty.push_back(site);
        }
        for (const Index v : sites_.changed_bounds()) {
            for (const Reader& reader : readers_[v]) {
                if (std::exchange(is_dirty[reader.site], 1) == 0) dirty.push_back(reader.site);
            }
        }
        std::sort(dirty.begin(), dirty.end(),
                  [&](Index a, Index b) { return sites_.comes_before(a, b); });
        return dirty;
    }

    void renumber_result() {
        const std::vector<SiteId>& new_ranks = sites_.new_ranks();
        for (SiteId& site : result_.vertex_site) {
            if (site.is_valid()) site = new_ranks[site.value()];
        }
        store_.renumber_sites(new_ranks, result_);
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
                if (sites_.owns_nothing(site)) {
                    forget_run(runs_[site], out.changes);
                } else {
                    front->run(sites_.point(site), sites_.bounds(), default_work_cap);
                    replace_run(*front, sites_.is_changed()[site] != 0, runs_[site], out.changes);
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

    // Those that may have to take their bound.
    void list_bounded_vertices() {
        for (const Index v : vertices_) is_listed_[v] = 1;
        for (const Index v : sites_.changed_bounds()) {
            const bool is_reached =
                std::any_of(readers_[v].begin(), readers_[v].end(), [](const Reader& r) {
                    return r.distance < std::numeric_limits<double>::infinity();
                });
            if (!is_reached && std::exchange(is_listed_[v], 1) == 0) vertices_.push_back(v);
        }
        for (const Index v : vertices_) is_listed_[v] = 0;
    }

    // Keeps the list ascending.
    void set_off_windows(Index v, bool is_off) {
        std::vector<Index>& list = result_.vertices_off_windows;
        const auto place = std::lower_bound(list.begin(), list.end(), v);
        const bool was_off = place != list.end() && *place == v;
        if (was_off && !is_off) list.erase(place);
        if (is_off && !was_off) list.insert(place, v);
    }

    // False if nothing changes.
    [[nodiscard]] bool settle_vertex(Index v) {
        std::vector<Reader>& readers = readers_[v];
        std::sort(readers.begin(), readers.end(), [&](const Reader& a, const Reader& b) {
            return sites_.comes_before(a.site, b.site);
        });
        double best = std::numeric_limits<double>::infinity();
        Index best_site = no_index;
        for (const auto& [number, distance] : readers) {
            if (!(distance < std::numeric_limits<double>::infinity())) continue;
            if (!is_nearer(distance, sites_.rank(number), best, best_site)) continue;
            best = distance;
            best_site = sites_.rank(number);
        }
        const Index bounding = sites_.site_of_bound(v);
        const bool is_off = best_site == no_index && bounding != no_index;
        if (is_off) {
            best = sites_.bounds()[v];
            best_site = sites_.rank(bounding);
        }
        set_off_windows(v, is_off);
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
        for (const Index face : sites_.changed_faces()) add(face);
        for (const Patch& patch : patches_) add(patch.face);
        for (const Index v : vertices_) {
            for_each_outgoing(surface_, v, [&](Index h) { add(Surface::face(h)); });
        }
        std::sort(changed_faces_.begin(), changed_faces_.end());
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
                   sites_.rank(patch->site));
            ++patch;
        };
        const std::size_t begin = out.relays.size();
        std::span<const Relay> old = store_.windows(result_, face);
        while (!old.empty()) {
            const SiteId site = old.front().site;
            std::size_t count = 1;
            while (count < old.size() && old[count].site == site) ++count;
            if (site.is_valid()) {  // Else it was removed.
                const Index number = sites_.number(site.value());
                const auto is_patched =
                    std::any_of(patches.begin(), patches.end(),
                                [&](const Patch& p) { return p.site == number; });
                if (!is_patched) {
                    while (patch != patches.end() && sites_.comes_before(patch->site, number)) {
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
                __builtin_prefetch(&surface_.can_be_pseudo_source[v]);
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
    NumberedSites sites_;
    std::vector<std::vector<Reader>> readers_;  // #V: the sites whose runs came to a vertex.
    std::vector<SiteRun> runs_;                 // By number.
    std::vector<std::uint8_t> is_listed_;       // #V: 0 but while vertices are listed.
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
