//! \file
//! Is it a manifold, and of which topology?
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/connectivity.h"

namespace agvd {

//! One connected piece.
struct ComponentTopology {
    Index faces = 0;         //!< #F of it.
    int euler = 0;           //!< V - E + F.
    int boundary_loops = 0;  //!< Closed chains of edges with one face.
    int genus = 0;    //!< (2 - euler - boundary_loops) / 2; meaningful on an oriented manifold.
    double area = 0;  //!< Square mesh units.
    //! Whether genus and boundary loops are equal.
    [[nodiscard]] bool same_type(const ComponentTopology& other) const {
        return genus == other.genus && boundary_loops == other.boundary_loops;
    }
};

//! Of a whole mesh.
struct Topology {
    bool is_manifold = false;  //!< Every edge has 1 or 2 faces, every vertex one umbrella, no
                               //!< duplicate and no degenerate (repeated corner) face.
    bool is_oriented = false;  //!< The two faces of every inner edge traverse it oppositely.
    std::vector<ComponentTopology> components;  //!< Connected through edges; by lowest face.
    std::vector<Index> face_component;          //!< #F: index into components.

    [[nodiscard]] int genus() const;           //!< Sum over the components.
    [[nodiscard]] int boundary_loops() const;  //!< Sum over the components.
};

//! Works on any indices in range, manifold or not. Cost: O(n log n).
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] Topology analyze_topology(const MeshView& mesh, const Progress& progress = {});

//! The same for a mesh with known connectivity; is_manifold and is_oriented are true.
//!
//! \param connectivity  find_connectivity(mesh), of which no two faces may have the same
//!                      corners, as in what clean_input returns.
//! \param num_threads   >= 0; 0: all cores. The result is the same for any number.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] Topology analyze_topology(const MeshView& mesh, const Connectivity& connectivity,
                                        int num_threads = 0, const Progress& progress = {});

//! Same number of components of each (genus, boundary loops) type.
[[nodiscard]] bool same_topology(const Topology& a, const Topology& b);

}  // namespace agvd
