//! \file
//! Connectivity and intrinsic geometry of an oriented 2-manifold triangle mesh: what is no such
//! mesh is refused, with the first faulty element. Held by Surface and Connectivity in
//! tests/agvd/mesh.
//!
//! Half-edge h = 3 f + k runs from corner k to corner k + 1 of face f, so next, previous and face
//! are arithmetic. Everything else is one flat array per quantity.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"

namespace agvd {

//! Twins and one-rings of a mesh.
struct Connectivity {
    std::vector<Index> twin;  //!< #H: the half-edge across; no_index on the boundary.
    //! #V: a half-edge that leaves the vertex; on the boundary the one without twin, from which
    //! `previous` and `twin` walk through the whole one-ring. no_index for an isolated vertex.
    std::vector<Index> outgoing;
};

//! No result if a face repeats a corner, an edge has more than two faces or two that run the same
//! way, or the faces around a vertex are not one fan.
//!
//! \param mesh  indices in range; positions are not read.
//! \throw Cancelled  the progress callback returned false.
//! Cost: O(n); 32 bytes per side of a face beyond the result.
[[nodiscard]] std::optional<Connectivity> find_connectivity(const MeshView& mesh,
                                                            const Progress& progress = {});

//! The frame of half-edge h: its tail at (0, 0), its head at (length, 0), its face above (y > 0).
struct Surface {
    TriangleMesh mesh;             //!< The faces, and the positions of the vertices.
    std::vector<Index> twin;       //!< #H: the half-edge across; no_index on the boundary.
    std::vector<Index> edge;       //!< #H: its undirected edge.
    std::vector<Index> edge_half;  //!< #E: the edge's half-edge with the lower index.
    std::vector<double> length;    //!< #E, mesh units.
    std::vector<Vec2> apex;        //!< #H: the opposite corner in the half-edge's frame.
    std::vector<Index> outgoing;   //!< #V: as Connectivity has it.
    //! #V: 1 where a shortest path may bend (a pseudo-source): cone angle above 2 pi, on the
    //! boundary above pi. The excess must pass 1e-9, so that flat vertices are not taken for
    //! saddles.
    std::vector<std::uint8_t> can_be_pseudo_source;
    //! The lengths were given: positions are for drawing, and distances between them say nothing.
    bool has_own_lengths = false;

    //! #V.
    [[nodiscard]] Index num_vertices() const { return static_cast<Index>(mesh.positions.size()); }
    //! #F.
    [[nodiscard]] Index num_faces() const { return static_cast<Index>(mesh.triangles.size()); }
    //! #E.
    [[nodiscard]] Index num_edges() const { return static_cast<Index>(edge_half.size()); }

    //! The face of a half-edge.
    [[nodiscard]] static constexpr Index face(Index half_edge) { return half_edge / 3; }
    //! The one that starts at its head, in the same face.
    [[nodiscard]] static constexpr Index next(Index half_edge) { return next_half_edge(half_edge); }
    //! The one that ends at its tail, in the same face.
    [[nodiscard]] static constexpr Index previous(Index half_edge) {
        return previous_half_edge(half_edge);
    }
    //! The vertex where it starts.
    [[nodiscard]] Index tail(Index half_edge) const {
        return mesh.triangles[half_edge / 3][half_edge % 3];
    }
    //! The vertex where it ends.
    [[nodiscard]] Index head(Index half_edge) const { return tail(next(half_edge)); }
    //! Mesh units.
    [[nodiscard]] double length_of(Index half_edge) const { return length[edge[half_edge]]; }
    //! The distance between the positions of the ends: the half-edge's length for a face in space.
    [[nodiscard]] double length_in_space(Index half_edge) const {
        return (mesh.positions[head(half_edge)] - mesh.positions[tail(half_edge)]).norm();
    }
    //! The apex from the positions. Not finite if the half-edge has length 0.
    [[nodiscard]] Vec2 apex_in_space(Index half_edge) const;
    //! False for isolated vertices.
    [[nodiscard]] bool is_boundary_vertex(Index vertex) const {
        return outgoing[vertex] != no_index && twin[outgoing[vertex]] == no_index;
    }
};

inline Vec2 Surface::apex_in_space(Index half_edge) const {
    const Vec3& origin = mesh.positions[tail(half_edge)];
    const Vec3 along = mesh.positions[head(half_edge)] - origin;
    const Vec3 up = mesh.positions[tail(previous(half_edge))] - origin;
    const double norm = along.norm();
    return {along.dot(up) / norm, along.cross(up).norm() / norm};
}

//! Builds connectivity and lengths; copies the mesh.
//!
//! \throw InvalidInput  an index is out of range, a coordinate is not finite, the mesh is out of
//!        scale (see check_scale), a face is degenerate (repeated corner or zero area in double),
//!        two faces are inconsistently oriented, or an edge or vertex is not manifold; the text
//!        names the element. remesh::clean_input repairs all of these.
//! \throw Cancelled     the progress callback returned false.
//! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
//! Cost: O(n).
[[nodiscard]] Surface build_surface(const MeshView& mesh, int num_threads = 0,
                                    const Progress& progress = {});

//! The same for a mesh whose connectivity is known; nothing is copied.
//!
//! \param connectivity  find_connectivity(mesh).
//! \param num_threads   >= 0; 0: all cores. The result is the same for any number.
//! \throw InvalidInput  a face has no area; the text names the first.
//! \throw Cancelled     the progress callback returned false.
//! Cost: O(n).
[[nodiscard]] Surface build_surface(TriangleMesh mesh, Connectivity connectivity, int num_threads,
                                    const Progress& progress = {});

//! The same by lengths in place of positions, which then are for drawing only.
//!
//! Where the lengths of a face are those between its positions, bit for bit, its shape is taken
//! from these, so that a mesh given by its own lengths gives the same bits as without.
//! \param side_length  #F x 3, mesh units: of the side from corner k of a face to corner k + 1. Both
//!                     sides of an edge must agree within 1e-12 of it.
//! \throw InvalidInput  as above, but positions need only be finite; a length is not finite or not
//!        above 0, two sides of an edge differ, or three sides make no triangle with an area.
[[nodiscard]] Surface build_surface(const MeshView& mesh, std::span<const double> side_length,
                                    int num_threads = 0, const Progress& progress = {});
//! \param connectivity  find_connectivity(mesh).
[[nodiscard]] Surface build_surface(TriangleMesh mesh, Connectivity connectivity,
                                    std::span<const double> side_length, int num_threads,
                                    const Progress& progress);

//! The place of a value in ascending ones.
[[nodiscard]] inline Index rank_of(std::span<const Index> ascending, Index value) {
    return static_cast<Index>(std::lower_bound(ascending.begin(), ascending.end(), value) -
                              ascending.begin());
}

//! Components of a surface as a surface of their own; vertices, edges and faces keep their order.
//! \param faces  ascending: all those of the components.
//! Cost: O(n log n).
[[nodiscard]] Surface surface_of_part(const Surface& whole, std::span<const Index> faces,
                                      Ticker ticker);

//! Boundary loops: each a cycle of half-edges without twin, head of one = tail of the next, in the
//! direction that has the surface on the left; loops ordered by their lowest half-edge.
[[nodiscard]] std::vector<std::vector<Index>> boundary_loops(const Surface& surface);
//! The same for a mesh with connectivity.
[[nodiscard]] std::vector<std::vector<Index>> boundary_loops(std::span<const Triangle> triangles,
                                                             std::span<const Index> twin,
                                                             std::span<const Index> outgoing,
                                                             Ticker ticker);

//! Calls each(half_edge) for the half-edges from a vertex, one for each face around it,
//! counter-clockwise; none if the vertex has no face.
template <typename Each>
void for_each_outgoing(const Surface& surface, Index vertex, const Each& each) {
    const Index first = surface.outgoing[vertex];
    for (Index h = first; h != no_index;) {
        each(h);
        h = surface.twin[Surface::previous(h)];
        if (h == first) break;
    }
}

//! Calls each(half_edge, other) for the edges at a vertex, counter-clockwise: a half-edge of the
//! edge, and the vertex at its other end.
template <typename Each>
void for_each_edge_at(const Surface& surface, Index vertex, const Each& each) {
    for_each_outgoing(surface, vertex, [&](Index h) {
        each(h, surface.head(h));
        const Index last = Surface::previous(h);  // No half-edge leaves along it.
        if (surface.twin[last] == no_index) each(last, surface.tail(last));
    });
}

//! The end of an edge that is not `vertex`.
[[nodiscard]] inline Index other_end(const Surface& surface, Index edge, Index vertex) {
    const Index h = surface.edge_half[edge];
    return surface.tail(h) == vertex ? surface.head(h) : surface.tail(h);
}

//! In square mesh units.
[[nodiscard]] inline double face_area(const Surface& surface, Index face) {
    const Index h = 3 * face;
    return surface.length_of(h) * surface.apex[h].y() / 2;
}

//! The area of all faces, summed in their order. Cost: O(#F).
[[nodiscard]] inline double surface_area(const Surface& surface) {
    double area = 0;
    for (Index f = 0; f < surface.num_faces(); ++f) area += face_area(surface, f);
    return area;
}

//! The vertex as a point of one of its faces. It must have one.
[[nodiscard]] SurfacePoint point_at(const Surface& surface, Index vertex);

}  // namespace agvd
