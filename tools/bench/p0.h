//! \file
//! P0: one multi-source Dijkstra sweep over the mesh edges, the unit of all costs.
#pragma once

#include <span>

#include "agvd/mesh/mesh.h"
#include "agvd/mesh/surface.h"

namespace bench {

//! The vertices and edges of a surface; lengths in float, for half the bandwidth.
struct EdgeGraph {
    struct Arc {
        agvd::Index head;
        float length;
    };
    std::vector<agvd::Index> offsets;  //!< #V + 1 offsets into arcs.
    std::vector<Arc> arcs;             //!< 2 #E.
};

[[nodiscard]] EdgeGraph edge_graph(const agvd::Surface& surface);

//! Distance along edges and nearest source of each vertex.
struct Sweep {
    std::vector<double> distance;    //!< #V; infinity where no source reaches.
    std::vector<agvd::Index> label;  //!< #V: index into the sources; no_index where none reaches.
};

//! Dijkstra's algorithm with an indexed 4-ary heap. Reuses the memory of `result`.
void sweep(const EdgeGraph& graph, std::span<const agvd::Index> sources, Sweep& result);

struct SweepSeconds {
    double quickest, median;
};

//! Repeats the sweep from the same sites, to time other work relative to it.
class P0 {
public:
    //! A site starts at its nearest corner.
    P0(const agvd::Surface& surface, std::span<const agvd::SurfacePoint> sites);

    //! Seconds of a few sweeps, on one core.
    [[nodiscard]] SweepSeconds seconds();

private:
    EdgeGraph graph_;
    std::vector<agvd::Index> sources_;
    Sweep sweep_;
};

}  // namespace bench
