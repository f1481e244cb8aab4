//! \file
//! A mesh in few bytes, for pages: positions on a grid, faces in an order in which most of them
//! need a byte that says little. tools/viewer/src/packed_mesh.ts reads it.
#pragma once

#include <string>
#include <vector>

#include "agvd/mesh/mesh.h"

namespace page {

//! Steps of the grid along the diagonal of the mesh: a point is off by at most 3.4e-6 of it.
inline constexpr double grid_steps = 1 << 18;

//! The order of elements is that in which they were reached. Vertices in no face are left out.
//!
//! Faces are added across open edges (gates), oldest first. A gate a -> b is an edge that the next
//! face runs along; it knows the corner `o` of the face beyond. For each gate there is a code:
//! no face, or the third corner x. Each face opens gates for its two other edges (x -> b, a -> x),
//! but for those that close the last gate that starts at b, or ends at a.
struct PackedMesh {
    std::vector<agvd::Index> vertices;  //!< The caller's, in the new order.
    std::vector<agvd::Index> faces;     //!< The caller's, in the new order, with corners rotated.
    agvd::Vec3 low{0, 0, 0};            //!< Of the grid.
    double step = 0;                    //!< Of the grid; 0: all points are one.
    std::string codes;                  //!< A FaceCode for each gate.
    std::string corners;                //!< Vertices that codes do not tell; see append_number.
    //! Steps from the guess a + b - o to each vertex, for the first of a face without a gate from
    //! the vertex before. Zigzag numbers of 24 bits: #V low bytes of x, of y, of z, then the middle
    //! bytes, then the high ones.
    std::string offsets;
};

//! How a face goes on from a gate a -> b.
enum class FaceCode : char {
    None,    //!< There is no other face.
    New,     //!< The third corner is a new vertex.
    Next,    //!< It is the end of the last gate that starts at b.
    Before,  //!< It is the start of the last gate that ends at a.
    Other,   //!< It is in `corners`.
    Alone    //!< No gate is left: all three corners are in `corners`.
};

//! \param mesh  finite positions, indices in range. Cost: O(n).
[[nodiscard]] PackedMesh pack_mesh(const agvd::MeshView& mesh);

//! Appends a number of seven bits to a byte, lowest first; the eighth bit: there are more.
void append_number(std::uint32_t number, std::string& bytes);

}  // namespace page
