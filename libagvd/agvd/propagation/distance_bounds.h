//! \file
//! Quick labels of the vertices: each distance is that of a path, rounded up, so that no exact
//! distance, as rounded, exceeds it.
//! Held by DistanceBoundsOn.NoArcShortensAPath in tests/agvd/propagation.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/propagation/propagate.h"

namespace agvd {

//! For each vertex a path to some site.
struct DistanceBounds {
    std::vector<float> distance;  //!< #V; infinity where no site reaches.
    std::vector<Index> site;  //!< #V: the site whose path it is; no_index where no site reaches.
};

//! Shortest paths along the arcs of a graph. Lengths are rounded up, so that no rounded exact
//! distance exceeds its bound. The result is unique: it depends neither on the order in which
//! threads lower bounds nor on the order in which sites are added.
class BoundsSearch {
public:
    //! \param surface, layout  outlive the search; SurfaceLayout(surface).
    //! \param num_steps        of a slab; a matter of speed only. 0: as suits the mesh's size.
    BoundsSearch(const Surface& surface, const SurfaceLayout& layout, int num_threads,
                 Index num_steps = 0);

    //! Adds a site. The next run() follows its paths.
    //! \param start  its distance from itself, >= 0.
    void add(const SurfacePoint& point, Index site, double start = 0);
    //! Adds a line or a region as a site, or as a part of one.
    void add(const SiteShape& shape, Index site);
    //! Cost: about that of one Dijkstra sweep over the edges where something is new.
    //! \throw Cancelled  the search is of no use any more.
    void run(const Progress& progress = {});

    //! Infinity where no site reaches.
    [[nodiscard]] float distance(Index vertex) const;
    //! The site of the bound; no_index where no site reaches.
    [[nodiscard]] Index site(Index vertex) const;

private:
    // The memory and the results of one task.
    struct Chunk {
        //! A vertex that waits for its turn.
        struct Waiting {
            std::uint64_t key;  //!< Stale if the vertex has another one.
            Index vertex;       //!< Of the mesh.
        };
        std::vector<std::vector<Waiting>> steps;
        std::vector<Index> beyond;  // Vertices lowered in later slabs.
    };

    [[nodiscard]] Index steps_to(float distance) const;
    void queue(Index vertex);
    void reach(Index vertex, Index site, double distance);
    template <bool is_shared>
    void search_slab(std::span<const Index> starts, Chunk& chunk, Ticker ticker);

    const Surface& surface_;
    const ArcGraph& graph_;
    int num_threads_;
    Index num_steps_;  // Of a slab.
    float per_step_;
    std::vector<std::uint64_t> keys_;  // #V: distance and site.
    std::vector<Index> queued_in_;     // #V: the slab in which a vertex waits.
    std::vector<std::vector<Index>> slabs_;
    Index current_ = 0;
};

//! The bounds of given sites. Parameters as above.
//! \param starts  of the sites; empty: 0.
//! \param shapes  sites behind those that are points.
[[nodiscard]] DistanceBounds distance_bounds(const Surface& surface, const SurfaceLayout& layout,
                                             std::span<const SurfacePoint> sites, int num_threads,
                                             const Progress& progress = {},
                                             std::span<const double> starts = {},
                                             std::span<const SiteShape> shapes = {});

}  // namespace agvd
