//! \file
//! The wavefront of the Steiner engine.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/propagation/propagation_options.h"
#include "agvd/propagation/relays.h"
#include "agvd/propagation/site_placement.h"
#include "agvd/propagation/steiner/front_queue.h"
#include "agvd/propagation/steiner/steiner_pool.h"
#include "agvd/propagation/steiner/steiner_retirement.h"

namespace agvd {

//! One propagation over given Steiner points: run(), then finish(). A node stores the face that its
//! path came through and its parent, the previous node on the boundary of that face. Between the
//! two calls the nodes of faces that have not retired can be read.
class SteinerFront {
public:
    //! \param counts  outlives the front, as the other arguments do; NodeNumbers must suffice for
    //! it.
    SteinerFront(const Surface& surface, std::span<const SurfacePoint> sites,
                 const SteinerCounts& counts);

    //! Settles all nodes.
    //! \param retirement_interval  pops from one retirement to the next, > 0; infinity keeps all
    //!                             nodes.
    //! \throw Cancelled
    void run(double retirement_interval, const Progress& progress);
    //! Retires the faces that are left. Afterwards no point can be read.
    [[nodiscard]] Propagation finish();

    [[nodiscard]] const std::vector<SteinerNode>& vertices() const { return vertices_; }
    //! Node j of a half-edge: 0 is its tail, the others are its points, counted from the tail. A
    //! face on one side of the half-edge has not retired.
    [[nodiscard]] const SteinerNode& node(Index half_edge, Index j) const;

private:
    [[nodiscard]] bool refill();
    void relax(SteinerNode& node, Index id, double distance, Index site, Index from, Index slot);
    void relax_vertex(Index from, double distance, Index site, Index slot);
    void relax_points(Index from, Index begin, Index end, const Vec2& tail, const Vec2& along,
                      const Vec2& source, double base, Index site, Index slot);
    void relax_side(Index from, const Vec2& tail, const Vec2& along, const Vec2& source,
                    double base, Index site, Index slot);
    void start(Index s);
    void serve_face(Index face, Index site, const SurfacePoint& point);
    void serve_one_ring(Index vertex);
    void serve_onward(Index edge, Index point);
    [[nodiscard]] Vec2 slot_position(const SteinerNode& node, const Vec2& here) const;
    [[nodiscard]] Vec2 parent_spacing(const SteinerNode& node) const;

    const Surface& surface_;
    std::span<const SurfacePoint> sites_;
    const SteinerCounts& counts_;
    SitePlacement placement_;
    NodeNumbers numbers_;
    std::vector<SteinerNode> vertices_;
    SteinerPool pool_;
    FrontQueue queue_;
    SteinerRetirement retirement_;
    Ticker ticker_;  // Of run().
    std::size_t num_pops_ = 0;
};

}  // namespace agvd
