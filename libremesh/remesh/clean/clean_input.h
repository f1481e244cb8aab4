//! \file
//! Turns any triangle soup into oriented 2-manifold pieces and counts the repairs.
//! Held by CleanInputProperty.RandomSoupsBecomeManifoldOrAreRefused in tests/remesh/clean.
#pragma once

#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/surface.h"
#include "remesh/names.h"

namespace remesh {

//! How many elements each step of the repair touched.
struct CleanCounts {
    Index divided_edges = 0;     //!< Boundary edges divided at vertices that lay on them.
    Index welded_vertices = 0;   //!< Merged into another vertex at the same position.
    Index degenerate_faces = 0;  //!< Dropped: repeated corner, or no area.
    Index absorbed_faces = 0;    //!< Without area, removed by an edge flip: no hole is left.
    Index duplicate_faces = 0;   //!< Dropped: same three corners as an earlier face.
    //! Kept: same three corners as an earlier face, but oriented the other way; two bodies touch.
    Index touching_faces = 0;
    Index flipped_faces = 0;      //!< Turned over for a consistent orientation.
    Index split_edges = 0;        //!< Edges of more than two faces, cut apart.
    Index split_vertices = 0;     //!< Copies made where faces at a vertex are not one fan.
    Index filled_holes = 0;       //!< Boundary loops closed: CleanOptions::fill_holes.
    Index isolated_vertices = 0;  //!< Dropped: in no face, or only in dropped ones.

    //! Whether all counts are equal.
    [[nodiscard]] bool operator==(const CleanCounts&) const = default;
};

//! A mesh after cleaning, and where its elements come from.
struct CleanResult {
    TriangleMesh mesh;  //!< What build_surface accepts.
    //! #V: the input vertex each vertex came from. Edges between the same two origins were one
    //! edge: find_junctions.
    std::vector<Index> vertex_origin;
    //! #F: the input face in which each face lies (it may be part of it, or have its corners in
    //! another order).
    std::vector<Index> face_origin;
    //! #V of the input, if welding moved vertices (else empty): its positions with those that were
    //! welded at one position.
    std::vector<Vec3> welded_positions;
    CleanCounts counts = {};  //!< What was repaired.
    //! Of the longest slit that was welded, in mesh units. A slit is a chain of boundary edges
    //! whose two sides coincide; it begins at a vertex that both have.
    double slit_length = 0;
    //! Vertices of the boundary beside edges of the boundary that they do not divide, as they are
    //! too far: within loose_share of the mesh's longest side. 0 with keep_slits.
    Index loose_vertices = 0;
    //! find_connectivity(mesh) if nothing had to be repaired; otherwise empty.
    Connectivity connectivity = {};
};

//! See CleanResult::loose_vertices.
inline constexpr double loose_share = 1e-3;

//! `{}` gives the defaults.
struct CleanOptions {
    //! Leaves boundary edges at one position open, such as the two sides of a slit.
    bool keep_slits = false;
    //! Mesh units, >= 0: boundary vertices within this distance, and within less than half of each
    //! edge there, are one position, so that the boundary edges between two positions become one.
    //! Not with keep_slits.
    double weld = 0;
    //! Boundary loops of at most so many edges are closed; 0: none. A loop stays open where no
    //! triangles of an area are found that keep the mesh manifold.
    Index fill_holes = 0;
    int num_threads = 0;     //!< >= 0; 0: all cores. The result is the same for any number.
    Progress progress = {};  //!< Polled during the call; see poll.
};

//! A cleaned mesh and the origins of its faces, for functions that carry points and edges over.
//! Refers to arrays that the caller owns, such as those of a CleanResult.
struct CleanedView {
    MeshView mesh;                           //!< What build_surface accepts.
    std::span<const Index> face_origin;      //!< See CleanResult; empty: nothing was changed.
    std::span<const Vec3> welded_positions;  //!< See CleanResult.

    //! Of a result, which must outlive this.
    CleanedView(const CleanResult& clean)
        : mesh(clean.mesh.view()),
          face_origin(clean.face_origin),
          welded_positions(clean.welded_positions) {}
    //! Of arrays, which must outlive this; welding moved nothing.
    CleanedView(const MeshView& cleaned, std::span<const Index> origin)
        : mesh(cleaned), face_origin(origin) {}

    //! The mesh that was cleaned, with its welded positions if there are any.
    //! \param given  what clean_input() got.
    [[nodiscard]] MeshView welded(const MeshView& given) const {
        if (welded_positions.empty()) return given;
        return {welded_positions, given.triangles};
    }
};

//! Repairs in this order, without moving anything but what 1. says:
//! 1. Edges of zero length collapse: those no longer than the last bit of the mesh's longest side.
//!    Vertices of the boundary on boundary edges divide these where both sides then have a common
//!    edge. Boundary edges between the same two positions are welded: cracks and soups close, while
//!    parts that touch at a point, and closed parts that touch anywhere, stay apart. Positions are
//!    one position if they are equal, or differ by a millionth of the mesh's longest side at most
//!    and by a hundredth of each edge there; the first one stays. Not with keep_slits, but for the
//!    collapses. CleanOptions::weld widens this.
//! 2. Faces with a repeated corner and duplicate faces (the first stays) are dropped; so are
//!    patches that lie on others within such a millionth, whatever their vertices and diagonals. Of
//!    duplicates of opposite orientation two stay where they are the walls of bodies that touch:
//!    where most edges at the rim of such faces have two faces of each body; and none where they
//!    are a flap, without vertices inside, on a body that is closed without it. Faces lower than a
//!    hundredth of their longest side that hang on edges which have two other faces are dropped.
//! 3. Faces connected through edges of two faces are oriented alike. Consistent pieces are not
//!    turned. Otherwise a clear majority (3/4) wins; without one, closed pieces are turned outward,
//!    and open ones follow the larger part.
//! 4. At an edge of more than two faces the pairs that make the flattest sheets (among equals,
//!    convex ones) stay together; the others are cut off. Where faces of opposite orientation lie
//!    on each other, those of one body stay together.
//! 5. A face without area in double (its corners on one line) is absorbed: its longest edge is
//!    flipped, so that the neighbour is split at the third corner. Where no neighbour can take it,
//!    it is dropped.
//! 6. Vertices with more than one fan of faces are copied for each fan; isolated ones are dropped.
//! 7. Holes are filled if the options ask for it; a new face has the origin of one beside it.
//!
//! An input without these defects comes back unchanged, bit for bit and in the same order. Kept
//! vertices and faces keep their order; copies of vertices come last.
//! \throw InvalidInput  an index is out of range, a coordinate is not finite, the mesh is out
//!        of scale (see check_scale) or too far from the origin, a piece is not orientable
//!        (each names the element), or no face is left.
//! \throw InvalidOption  weld is negative, not finite, or given with keep_slits; there is a hole to fill, and the
//!        build is without CGAL.
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(n log n); O(n) if there is no defect.
[[nodiscard]] CleanResult clean_input(const MeshView& mesh, const CleanOptions& options = {});

}  // namespace remesh
