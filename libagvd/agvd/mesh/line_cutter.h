//! \file
//! Faces cut along straight pieces of lines: the part of it that knows no diagram.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "agvd/core/progress.h"
#include "agvd/mesh/cut_surface.h"
#include "agvd/mesh/surface.h"

namespace agvd {

//! Points of a face or an edge that are apart by rounding only become one vertex. In each face,
//! sides and pieces of lines are a plane graph in barycentric coordinates; its faces are polygons,
//! which are cut into triangles ear by ear. What belongs together is known by numbers of vertices,
//! never by coordinates.
class LineCutter {
public:
    //! Gets the face and the vertices of each polygon, and how many triangles it is cut into.
    using EachPolygon =
        std::function<void(Index face, std::span<const Index> vertices, Index num_triangles)>;

    //! The surface outlives this.
    LineCutter(const Surface& surface, Ticker ticker);

    //! The vertex at a point of the surface, which is made if there is none.
    Index vertex_at(const SurfacePoint& point);
    //! A straight piece between two different vertices of one face. Two pieces do not cross.
    void add_piece(Index face, Index from, Index to) { pieces_.push_back({face, {from, to}}); }

    //! Cuts all faces along the pieces that were added. To be called once.
    //! Cost: O(n log n), and O(k^3) in a face with k points on its edges and inside.
    [[nodiscard]] CutFaces run(const EachPolygon& each_polygon = {});

private:
    using Ends = std::pair<Index, Index>;  // Vertices; or numbers in a polygon.

    // A piece of a line in a face.
    struct FacePiece {
        Index face;
        Ends ends;
    };
    // A vertex of the result in one face.
    struct LocalPoint {
        Index vertex;
        Vec2 at;  // The shares of corners 1 and 2.
    };

    Index add_vertex(const SurfacePoint& point);
    void cut_face(Index face, std::span<const FacePiece> pieces);
    void add_sides(Index face);
    [[nodiscard]] Index local(Index face, Index vertex);
    [[nodiscard]] bool do_cross(const Ends& s, const Ends& t) const;
    void connect();
    void trace(Index face);
    [[nodiscard]] double quality(Index face, const std::vector<Index>& polygon,
                                 std::size_t i) const;
    void add_triangles(Index face, std::vector<Index> polygon);

    const Surface& surface_;
    Ticker ticker_;
    CutFaces result_;
    const EachPolygon* each_polygon_ = nullptr;
    std::map<Index, std::vector<Index>> inside_;                  // By face: the vertices in it.
    std::vector<std::vector<std::pair<double, Index>>> on_edge_;  // #E: share and vertex.
    std::vector<FacePiece> pieces_;

    // The face at hand.
    std::vector<LocalPoint> points_;  // On its sides first, counter-clockwise; then inside.
    std::vector<Ends> links_;
    Index num_on_sides_ = 0;
};

}  // namespace agvd
