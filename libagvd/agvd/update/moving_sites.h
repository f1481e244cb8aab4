//! \file
//! Propagation that follows sites as they are added, removed and moved.
#pragma once

#include <memory>
#include <span>

#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"
#include "agvd/propagation/surface_layout.h"
#include "agvd/update/site_changes.h"

namespace agvd {

//! Keeps what each site has propagated, and repeats only what a change touches: the sites that
//! changed and those whose bounds did. The result is that of propagate() with Engine::Window on the
//! sites at hand, byte for byte face by face (but for peak_bytes and num_nodes; relays have gaps
//! between). Not for use by two threads at once.
class MovingSites {
public:
    //! \param surface, layout  outlive this; SurfaceLayout(surface).
    //! \param options          engine must be Window; its progress is not called.
    //! \throw as propagate().
    //! Space: all windows of all sites, 48 bytes each, and up to twice as much for relays.
    MovingSites(const Surface& surface, const SurfaceLayout& layout,
                std::vector<SurfacePoint> sites, const PropagationOptions& options = {});
    //! Moves; the other one may only be destroyed or assigned to.
    MovingSites(MovingSites&&) noexcept;
    //! Likewise.
    MovingSites& operator=(MovingSites&&) noexcept;
    ~MovingSites();

    //! \throw InvalidInput  an index is out of range or named twice, or a point is off its face;
    //!                      nothing has changed then.
    //! Cost: that of the sites that propagate again, and O(#V + #mixed) for quick passes; at times
    //! a pass over the relays.
    void update(const SiteChanges& changes);

    //! As they are after the last change.
    [[nodiscard]] const std::vector<SurfacePoint>& sites() const;
    //! As propagate() would make it.
    [[nodiscard]] const Propagation& propagation() const;
    //! Sites that the last change (or the constructor) propagated.
    [[nodiscard]] Index num_propagated() const;
    //! Ascending: all faces that the last change gave other relays, or corners with other
    //! distances, listed or not, and maybe more. Renumbering is no change.
    [[nodiscard]] const std::vector<Index>& changed_faces() const;

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace agvd
