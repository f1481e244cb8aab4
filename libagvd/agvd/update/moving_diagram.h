//! \file
//! A diagram that follows sites as they are added, removed and moved.
#pragma once

#include <memory>

#include "agvd/diagram/diagram.h"
#include "agvd/update/moving_sites.h"

namespace agvd {

//! Propagates, labels, traces and joins again only what a change touches. Propagation and diagram
//! have the bytes of a fresh run. Not for use by two threads at once.
class MovingDiagram {
public:
    //! \param surface, layout  outlive this; SurfaceLayout(surface).
    //! \param propagation     engine must be Window; its progress is not called.
    //! \throw as propagate() and build_diagram().
    //! Space: that of MovingSites, and four to eight times that of the diagram.
    MovingDiagram(const Surface& surface, const SurfaceLayout& layout,
                  std::vector<SurfacePoint> sites, const PropagationOptions& propagation = {},
                  const DiagramOptions& options = {});
    //! Moves; the other one may only be destroyed or assigned to.
    MovingDiagram(MovingDiagram&&) noexcept;
    //! Likewise.
    MovingDiagram& operator=(MovingDiagram&&) noexcept;
    ~MovingDiagram();

    //! \throw InvalidInput  as MovingSites::update(); nothing has changed then.
    //! \throw Cancelled     the diagram is that of before, the sites are the new ones; the next
    //!                      update makes up for it.
    //! Cost: that of the parts touched, copying the points of the other Voronoi edges, and O(#F)
    //! quick passes.
    void update(const SiteChanges& changes);

    //! The sites and their distances.
    [[nodiscard]] const MovingSites& sites() const;
    //! As build_diagram() would make it.
    [[nodiscard]] const Diagram& diagram() const;

private:
    class State;
    std::unique_ptr<State> state_;
};

}  // namespace agvd
