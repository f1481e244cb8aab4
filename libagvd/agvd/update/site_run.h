//! \file
//! What one site has propagated, and how a new run of it differs.
#pragma once

#include <span>
#include <vector>

#include "agvd/propagation/relays.h"

namespace agvd {

class WindowFront;

//! Vertices and half-edges stand in the order in which the run came to them.
struct SiteRun {
    //! A vertex whose bound mattered.
    struct Vertex {
        Index vertex;
        double distance;  //!< Infinity where it was not reached within its bound.
    };
    struct HalfEdge {
        Index half_edge;
        Index first, count;  //!< In relays; count > 0.
    };
    std::vector<Vertex> vertices;
    std::vector<HalfEdge> half_edges;
    std::vector<Relay> relays;  //!< Of no site.
    double error = 0;
    std::size_t num_windows = 0;
};

//! What is to be mended where a run is replaced.
struct RunChanges {
    struct Vertex {
        Index vertex;
        double distance;  //!< As above.
        bool is_read;     //!< Its bound matters still.
    };
    //! All that the site gives to a face.
    struct Face {
        Index face;
        Index first, count;  //!< In relays; in the order of the run.
    };
    std::vector<Vertex> vertices;
    std::vector<Face> faces;  //!< Maybe some that are as they were.
    std::vector<Relay> relays;

    void clear() {
        vertices.clear();
        faces.clear();
        relays.clear();
    }
};

//! Replaces a run by the last one of a front, and appends where they differ.
//!
//! \param is_other_place  the site has moved. All of its run counts as changed, since its place in
//!        the order of the sites may have changed, too.
void replace_run(const WindowFront& front, bool is_other_place, SiteRun& run, RunChanges& changes);

//! Replaces a run by none.
void forget_run(SiteRun& run, RunChanges& changes);

}  // namespace agvd
