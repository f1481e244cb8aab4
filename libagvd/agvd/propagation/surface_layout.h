//! \file
//! What propagation computes from the surface alone: made once, used with any sites.
#pragma once

#include <memory>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"

namespace agvd {

struct ArcGraph;
class Corners;

//! For callers that propagate on one surface several times. It takes about 160 bytes per face,
//! beyond the surface. It is immutable, so that threads may share it.
class SurfaceLayout {
public:
    //! \param num_threads  >= 0; 0: all cores.
    //! Cost: O(#H), about that of one Dijkstra sweep over the edges.
    //! \throw Cancelled  the progress callback returned false.
    explicit SurfaceLayout(const Surface& surface, int num_threads = 0,
                           const Progress& progress = {});
    //! Moves; the other one may only be destroyed or assigned to.
    SurfaceLayout(SurfaceLayout&&) noexcept;
    //! Likewise.
    SurfaceLayout& operator=(SurfaceLayout&&) noexcept;
    ~SurfaceLayout();

    //! The corners of the faces, for the engines.
    [[nodiscard]] const Corners& corners() const { return *corners_; }
    //! Shared ownership, for users that outlive the layout.
    [[nodiscard]] std::shared_ptr<const Corners> shared_corners() const { return corners_; }
    //! Edges and lines across them, for upper bounds.
    [[nodiscard]] const ArcGraph& arcs() const { return *arcs_; }
    //! Memory held.
    [[nodiscard]] std::size_t bytes() const;

private:
    std::shared_ptr<const Corners> corners_;
    std::unique_ptr<ArcGraph> arcs_;
};

}  // namespace agvd
