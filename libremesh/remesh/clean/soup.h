//! \file
//! The mesh under repair, its half-edges grouped by edge, and the passes of clean_input over them.
//!
//! Half-edges are those of Surface. A twin array holds the half-edge across, or no_index: which of
//! the faces at a non-manifold edge or vertex belong to one sheet.
#pragma once

#include <limits>
#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/any_mesh.h"
#include "agvd/mesh/scale.h"
#include "agvd/mesh/surface.h"
#include "agvd/mesh/topology.h"
#include "remesh/clean/clean_input.h"

namespace remesh::detail {

//! What becomes the result.
struct Soup : CleanResult {
    Ticker ticker = {};  //!< Of clean_input(): every pass ticks it.

    [[nodiscard]] Index num_half_edges() const {
        return static_cast<Index>(3 * mesh.triangles.size());
    }
    [[nodiscard]] Index tail(Index h) const { return mesh.triangles[h / 3][h % 3]; }
    [[nodiscard]] Index head(Index h) const { return tail(Surface::next(h)); }
    [[nodiscard]] Index apex(Index h) const { return tail(Surface::previous(h)); }
    //! Whether it runs from the lower to the higher vertex. Two faces of an edge are oriented alike
    //! if their half-edges differ in this.
    [[nodiscard]] bool runs_up(Index h) const { return tail(h) < head(h); }
};

//! \throw InvalidInput  the mesh has too many faces, a coordinate that is not finite, or an
//!        index out of range.
void check_elements(const MeshView& mesh, Ticker ticker = {});

//! Which vertices are at one position.
struct CommonPositions {
    std::vector<Index> first;   //!< #V: see find_common_positions.
    std::vector<double> reach;  //!< #V: `share` of the shortest edge at a first vertex.
    double limit = 0;           //!< Of all reaches, mesh units.
    double share = 0;
};

//! For each wanted vertex the first one at its position; no_index for the others.
//!
//! Positions are one if they are equal, or differ by a millionth of the mesh's longest side at most
//! and by a hundredth of each edge there: files with six or seven digits leave such gaps. Vertices
//! with less than an eighth of the usual reach must be equal, as they would crowd the grid.
//! \param is_wanted  #V: vertices of the boundary.
//! \param tolerance  above 0: the limits are this length, if that is more, and half of each edge.
//! Cost: O(#F + #wanted).
[[nodiscard]] CommonPositions find_common_positions(const MeshView& mesh,
                                                    const std::vector<bool>& is_wanted,
                                                    Ticker& ticker, double tolerance = 0);

//! A vertex on an edge of the boundary, no nearer to its ends.
struct Division {
    Index half_edge = 0;  //!< Of the edge.
    double share = 0;     //!< Of its length, before the vertex.
    Index vertex = 0;     //!< The first one at its position.

    [[nodiscard]] auto operator<=>(const Division&) const = default;
};

//! Vertices of the boundary on edges of the boundary (as near as common positions are), where a
//! piece of the edge that they end has the ends of another such piece, or edge.
//! \param open  half-edges of edges with one face.
//! \return ascending. Cost: O(n log n).
[[nodiscard]] std::vector<Division> find_divisions(const MeshView& mesh,
                                                   std::span<const Index> open, double tolerance,
                                                   Ticker& ticker);

//! Edges that are no longer have zero length: the last bit of the mesh's longest side.
[[nodiscard]] inline double zero_length(const MeshBox& box) {
    return std::numeric_limits<double>::epsilon() * box.longest_side();
}

//! Removes the marked faces and returns their number.
//! \param twin  is updated; null: there is none yet.
Index drop_faces(Soup& soup, const std::vector<bool>& is_dead, std::vector<Index>* twin = nullptr);

// The passes, in the order in which they run. Those that return bool tell whether they changed a
// triangle, so that sides must be sorted again.

//! Divides the edges of find_divisions, and their faces.
bool divide_edges(Soup& soup, std::span<const EdgeSide> sides, double tolerance);
//! Boundary edges between the same two positions (find_common_positions) become one edge.
//! \param tolerance  see find_common_positions.
bool weld_cracks(Soup& soup, std::span<const EdgeSide> sides, double tolerance);
//! Edges of zero length (see zero_length) become one vertex, the first of their ends.
bool collapse_zero_edges(Soup& soup, double zero_length);
bool drop_repeated_corners(Soup& soup);
//! Of faces with the same corners one stays, two of opposite orientation where bodies
//! touch, or none: a flap on a body that is closed without it.
bool drop_duplicates(Soup& soup, std::span<const EdgeSide> sides);
//! Drops patches of slivers on the boundary that hang on edges which have two faces without them:
//! they are no sheets.
bool drop_slivers(Soup& soup, std::span<const EdgeSide> sides);
//! \throw InvalidInput  a component is not orientable.
bool orient_faces(Soup& soup, std::span<const EdgeSide> sides);
//! The twins. At an edge of more than two faces the flattest pairs stay together, the rest is cut.
//! Where faces of opposite orientation lie on each other, those of one body stay together.
[[nodiscard]] std::vector<Index> pair_sheets(Soup& soup, std::span<const EdgeSide> sides);
//! Twice the least of the areas computed from the three corners of a face. build_surface
//! rejects faces for which it is 0 or not finite.
[[nodiscard]] double smallest_doubled_area(std::span<const Vec3> positions, const Triangle& face);
//! Faces without area are absorbed by their neighbours, or dropped.
//! \throw InvalidInput  a face is so large that its area overflows.
void remove_degenerate_faces(Soup& soup, std::vector<Index>& twin);
//! Gives every fan of faces a vertex of its own, until vertex indices alone give the twins.
void split_vertices(Soup& soup, std::vector<Index>& twin);
void drop_isolated_vertices(Soup& soup);
//! Closes boundary loops of at most `most_edges` edges. A new face has the origin of one beside it.
//! \throw InvalidOption  there is such a loop, and the build is without CGAL.
void fill_holes(Soup& soup, Index most_edges);

//! Triangulates a hole as CGAL's triangulate_hole_polyline does: the largest dihedral angle, then
//! the area, is as small as it can be.
//! \param rim     the corners, in the order of the triangles to make.
//! \param beyond  the third corner of the face at each side of the rim; as many.
//! \return indices into rim; no triangles if none were found; unset in a build without CGAL.
//! Cost: O(n^2) where the Delaunay triangulation of the rim has a solution; otherwise O(n^3).
[[nodiscard]] std::optional<std::vector<Triangle>> triangulate_hole(std::span<const Vec3> rim,
                                                                    std::span<const Vec3> beyond);

//! Drops every component with less than this share of the surface's area, and the vertices that
//! only it uses.
//! \param least_share  in [0, 1].
//! \param topology  of clean.mesh.
//! \return the number of components dropped.
//! \throw InvalidOption  none would be left.
[[nodiscard]] Index drop_components(CleanResult& clean, const Topology& topology,
                                    double least_share);

}  // namespace remesh::detail
