//! \file
//! Is a mesh a manifold, and of which topology? Components are numbered by their lowest faces.
//! Held by Topology and Components in tests/agvd/mesh.
#pragma once

#include "agvd/mesh/surface.h"

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
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] Topology analyze_topology(const MeshView& mesh, const Connectivity& connectivity,
                                        const Progress& progress = {});

//! Same number of components of each (genus, boundary loops) type.
[[nodiscard]] bool same_topology(const Topology& a, const Topology& b);

//! Which faces are connected through edges.
struct FaceLabels {
    std::vector<Index> of_face;  //!< #F: numbers from 0, by lowest face.
    Index count = 0;             //!< Of components.
};

//! \param twin  as Surface has it.
//! Cost: O(#F).
[[nodiscard]] FaceLabels label_components(std::span<const Index> twin, Ticker ticker = {});

//! A connected component of a surface, with the data that sampling needs.
struct Component {
    std::vector<Index> faces;        //!< Ascending.
    std::vector<double> area_up_to;  //!< Per face of `faces`: total area up to and with it.
    int euler = 0;                   //!< V - E + F.
    int boundary_loops = 0;          //!< As ComponentTopology has it.

    //! Square mesh units.
    [[nodiscard]] double area() const { return area_up_to.back(); }
    //! As ComponentTopology has it.
    [[nodiscard]] int genus() const { return (2 - euler - boundary_loops) / 2; }
};

//! Sorted by lowest face. Cost: O(n).
//! \throw Cancelled  the progress callback returned false.
[[nodiscard]] std::vector<Component> find_components(const Surface& surface,
                                                     const Progress& progress = {});

}  // namespace agvd
