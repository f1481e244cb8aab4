//! \file
//! Meshes of CGAL: every model of its concept FaceListGraph, such as Surface_mesh and Polyhedron_3.
//! Includes nothing of CGAL. Held by FaceGraph in tests/remesh/meshfile.
#pragma once

#include <type_traits>
#include <unordered_map>
#include <utility>

#include "remesh/meshfile/mesh_file.h"

namespace remesh {
namespace detail {

//! The first element of the pair of iterators that CGAL calls a range.
template <typename Range>
using ElementOf = std::remove_cvref_t<decltype(*std::declval<Range>().begin())>;
template <typename Graph>
using VertexOf = ElementOf<decltype(vertices(std::declval<const Graph&>()))>;
template <typename Graph>
using FaceOf = ElementOf<decltype(faces(std::declval<const Graph&>()))>;

template <typename Number>
[[nodiscard]] double as_double(const Number& number) {
    if constexpr (requires { static_cast<double>(number); }) {
        return static_cast<double>(number);
    } else {
        return to_double(number);
    }
}

}  // namespace detail

//! A mesh that came from a graph, and the origin of each of its elements.
template <typename Graph>
struct FromFaceGraph {
    TriangleMesh mesh;                              //!< Polygons are cut into triangles.
    std::vector<detail::VertexOf<Graph>> vertices;  //!< #V: the vertex of the graph.
    std::vector<detail::FaceOf<Graph>> faces;  //!< #F: the face of the graph; polygons are cut.

    //! Every function of an MeshView takes it. The view must not outlive it.
    operator MeshView() const { return mesh; }
};

//! Copies vertices and faces in their order. Isolated vertices stay. Polygons are cut into
//! triangles as those of files are. Exact coordinates are rounded to doubles.
//! \param points  a property map of points that have x(), y() and z(): `mesh.points()` of a
//!                Surface_mesh, `get(CGAL::vertex_point, mesh)` of any.
//! Cost: O(n).
template <typename Graph, typename PointMap>
[[nodiscard]] FromFaceGraph<Graph> from_face_graph(const Graph& graph, const PointMap& points) {
    FromFaceGraph<Graph> result;
    std::unordered_map<detail::VertexOf<Graph>, Index> index;
    for (const auto v : vertices(graph)) {
        const auto& p = get(points, v);
        index.emplace(v, static_cast<Index>(result.vertices.size()));
        result.vertices.push_back(v);
        result.mesh.positions.emplace_back(detail::as_double(p.x()), detail::as_double(p.y()),
                                           detail::as_double(p.z()));
    }
    std::vector<Index> polygon;
    Ticker ticker;
    for (const auto f : faces(graph)) {
        polygon.clear();
        const auto first = halfedge(f, graph);
        auto h = first;
        do {
            polygon.push_back(index.at(target(h, graph)));
            h = next(h, graph);
        } while (h != first);
        append_triangles(polygon, result.mesh.positions, ticker, result.mesh.triangles);
        result.faces.resize(result.mesh.triangles.size(), f);
    }
    return result;
}

}  // namespace remesh
