#include "agvd/update/moving_sites.h"

#include <algorithm>
#include <limits>
#include <string>

#include "agvd/propagation/option_checks.h"
#include "agvd/propagation/window_engine.h"
#include "agvd/update/face_patches.h"
#include "agvd/update/vertex_readers.h"

namespace agvd {

class MovingSites::State {
public:
    State(const Surface& surface, const SurfaceLayout& layout, std::vector<SurfacePoint> sites,
          const PropagationOptions& options)
        : surface_(surface),
          corners_(layout.corners()),
          num_threads_(options.num_threads),
          max_error_(options.max_error.value_or(default_max_error)),
          sites_(surface, layout, options.num_threads),
          placement_(surface, {}),
          store_(surface.num_faces()) {
        readers_.at.resize(surface.num_vertices());
        readers_.is_listed.assign(surface.num_vertices(), 0);
        patches_.place.assign(surface.num_faces(), no_index);
        result_.vertex_site.assign(surface.num_vertices(), SiteId());
        result_.vertex_distance.assign(surface.num_vertices(),
                                       std::numeric_limits<double>::infinity());
        update({.moved = {}, .removed = {}, .added = std::move(sites)});
    }

    void update(const SiteChanges& changes) {
        sites_.change(changes);
        runs_.runs.resize(sites_.count());
        if (!changes.removed.empty()) renumber_result();
        if (sites_.has_placed() || !placement_.is_empty()) placement_ = {surface_, sites()};
        const MovingInput input{surface_, corners_, sites_, placement_, max_error_, num_threads_};
        const std::vector<Index> dirty = find_dirty(sites_, readers_);
        num_propagated_ = static_cast<Index>(std::count_if(
            dirty.begin(), dirty.end(), [&](Index site) { return !sites_.owns_nothing(site); }));
        run_again(input, dirty, runs_);

        std::vector<Index> vertices = take_changes(runs_, dirty, sites_, readers_);
        std::erase_if(vertices,
                      [&](Index v) { return !settle_vertex(sites_, v, readers_, result_); });
        list_patches(input, runs_, dirty, vertices, patches_);
        replace_relays(input, runs_, patches_, store_, result_);
        tell_totals();
    }

    [[nodiscard]] const std::vector<SurfacePoint>& sites() const { return sites_.points(); }
    [[nodiscard]] const Propagation& propagation() const { return result_; }
    [[nodiscard]] Index num_propagated() const { return num_propagated_; }
    [[nodiscard]] const std::vector<Index>& changed_faces() const { return patches_.changed_faces; }

private:
    void renumber_result() {
        const std::vector<SiteId>& new_ranks = sites_.new_ranks();
        for (SiteId& site : result_.vertex_site) {
            if (site.is_valid()) site = new_ranks[site.value()];
        }
        store_.renumber_sites(new_ranks, result_);
    }

    void tell_totals() {
        result_.certified_error = 0;
        result_.num_nodes = 0;
        for (const SiteRun& run : runs_.runs) {
            result_.certified_error = std::max(result_.certified_error, run.error);
            result_.num_nodes += run.num_windows;
        }
    }

    const Surface& surface_;
    const Corners& corners_;
    int num_threads_;
    double max_error_;
    NumberedSites sites_;
    SiteRuns runs_;
    VertexReaders readers_;
    SitePlacement placement_;
    FacePatches patches_;
    RelayStore store_;
    Propagation result_;
    Index num_propagated_ = 0;
};

MovingSites::MovingSites(const Surface& surface, const SurfaceLayout& layout,
                         std::vector<SurfacePoint> sites, const PropagationOptions& options) {
    if (options.engine != Engine::Window) {
        throw InvalidOption(std::string("moving sites do not work with the ") +
                            engine_name(options.engine) + " engine; use the window engine");
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
