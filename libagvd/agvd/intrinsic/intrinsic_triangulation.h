//! \file
//! A better triangulation of the same surface, the base under propagation, diagram and labels:
//! distances on the surface stay. Held by IntrinsicTriangulation and FacePieces in
//! tests/agvd/intrinsic.
#pragma once

#include <functional>
#include <memory>

#include "agvd/mesh/surface.h"

namespace agvd {
namespace detail {
class FaceHistory;
}

//! Lengths in mesh units. `{}` flips only.
struct IntrinsicOptions {
    //! Longer edges are split at their middles until none is left, > 0.
    double max_length = std::numeric_limits<double>::infinity();
    //! Inner vertices that have a shorter edge, >= 0, are removed if their angles sum to 2 pi
    //! within 1e-12: the surface is the same without them.
    double min_length = 0;
    //! At most so many edges are split, the longest first: surfaces thinner than max_length would
    //! get any number of vertices.
    Index most_splits = no_index;
    //! The unit of max_length at a point of the input, > 0; empty: 1 everywhere. An edge is
    //! measured in the mean of its ends; called once for each vertex.
    std::function<double(const SurfacePoint& on_input)> unit_at = {};
    int num_threads = 0;     //!< >= 0; 0: all cores. The result is the same for any number.
    Progress progress = {};  //!< Tells the fraction 0 until it is done.
};

//! What was done to the input's triangulation.
struct IntrinsicCounts {
    Index splits = 0;         //!< Edges split: vertices added.
    Index removed = 0;        //!< Vertices without curvature that were removed: they have no faces.
    bool is_delaunay = true;  //!< False: flips ended before the condition held everywhere.
};

//! A convex part of a face of the input.
struct InputPart {
    SurfacePoint centroid;  //!< Of the part, on the input.
    double share = 0;       //!< Of the face's area.
};

//! The input's surface and vertices, other edges. An edge of the input with two triangles beside it
//! that fail the Delaunay condition is replaced by the other diagonal of these, unfolded into one
//! plane ([bobenko2007], [fisher2007], [sharp2019]): distances on the surface do not change, and
//! there are no needles. What is computed on it depends on the surface, not on the triangles of the
//! input.
//!
//! The result is a Surface in the plane of each face: its lengths and apexes are true, its corners
//! lie where the mesh says, but in space its faces do not lie on the surface. It is a
//! Delta-complex: an edge may join a vertex to itself, two faces may share two edges, a face may be
//! its own neighbour. Faces that nothing has changed keep number and corners.
//!
//! Immutable; threads may share it. Movable, not copyable.
class IntrinsicTriangulation {
public:
    //! \param input  build_surface(); outlives this.
    //! \throw InvalidOption  an option is out of range.
    //! \throw Cancelled      the progress callback returned false.
    //! Cost: a pass over the edges and O(log n) for each flip. The number of flips has no useful
    //! bound in theory; in practice it is some ten for each needle.
    explicit IntrinsicTriangulation(const Surface& input, const IntrinsicOptions& options = {});
    //! The input would not outlive this.
    explicit IntrinsicTriangulation(Surface&& input, const IntrinsicOptions& options = {}) = delete;
    //! Moves; the other one may only be destroyed or assigned to.
    IntrinsicTriangulation(IntrinsicTriangulation&&) noexcept;
    //! Moves; the other one may only be destroyed or assigned to.
    IntrinsicTriangulation& operator=(IntrinsicTriangulation&&) noexcept;
    ~IntrinsicTriangulation();

    //! The surface that was given.
    [[nodiscard]] const Surface& input() const { return *input_; }
    //! Vertices of the input first, then added ones, at their points of the input.
    [[nodiscard]] const Surface& surface() const { return surface_; }
    //! What was done.
    [[nodiscard]] const IntrinsicCounts& counts() const { return counts_; }

    //! Whether a face is not one of the input's.
    [[nodiscard]] bool is_changed(Index face) const;
    //! The point of the input at which an added vertex lies.
    //! \param vertex  >= input().num_vertices().
    [[nodiscard]] const SurfacePoint& added_point(Index vertex) const {
        return added_[vertex - input_->num_vertices()];
    }

    //! The same point of the surface. Errors are a few roundings of the faces' size; points of
    //! faces that nothing has changed come back as they are. On edges that both have, and on
    //! vertices, coordinates that are 0 stay exactly 0. Cost: some 20 ns for each operation that
    //! concerned the face there: none to hundreds.
    [[nodiscard]] SurfacePoint to_intrinsic(const SurfacePoint& on_input) const;
    //! The reverse, at the same cost.
    [[nodiscard]] SurfacePoint to_input(const SurfacePoint& on_base) const;
    //! The same for many points.
    [[nodiscard]] std::vector<SurfacePoint> to_intrinsic(
        std::span<const SurfacePoint> on_input) const;
    //! The same for many points.
    [[nodiscard]] std::vector<SurfacePoint> to_input(std::span<const SurfacePoint> on_base) const;

    //! A straight segment in one face of this, as a polyline on the input: two points for each face
    //! crossed, both as points of that face; the second lies where the first of the next does.
    //! \param begin, end  of one face.
    //! \param parts  appended to.
    void to_input(const SurfacePoint& begin, const SurfacePoint& end,
                  std::vector<SurfacePoint>& parts) const;

    //! The convex parts of the input's faces that make up a face of this; none if that would take
    //! long, as with hundreds of needles. Cost: some 50 ns for each operation and part, 64 at most.
    [[nodiscard]] std::vector<InputPart> parts_of(Index face) const;

private:
    void change_faces(const IntrinsicOptions& options, Poller& poller, Ticker& ticker);

    const Surface* input_;
    Surface surface_;
    IntrinsicCounts counts_;
    std::vector<SurfacePoint> added_;  // On the input.
    std::unique_ptr<detail::FaceHistory> history_;
};

//! A part of the input's surface, treated as flat.
struct SurfacePiece {
    Vec3 position;  //!< A point of it.
    Vec3 vector;    //!< Its normal; its length is the area.
};

//! A face of the input is one piece. So is a changed face whose sides are as long in space as on
//! the surface, since it is flat. Other changed faces are bent in space: their pieces are the parts
//! of the input's faces in them, or, where these are too many, evenly spread points with equal
//! shares of the area and the normals of the input. Immutable; threads may share it.
class FacePieces {
public:
    //! \param base        outlives this.
    //! \param piece_area  the area of a piece where a face holds many needles, > 0; such a face has
    //! at most 16 pieces.
    //! Cost: a map to the input for each piece of a changed face; 48 bytes.
    //! \param num_threads  >= 0; 0: all cores. The result is the same for any number.
    //! \throw Cancelled  the progress callback returned false.
    FacePieces(const IntrinsicTriangulation& base, double piece_area, int num_threads = 0,
               const Progress& progress = {});

    //! Calls each(SurfacePiece) for the pieces of a face of base.surface().
    template <typename Each>
    void for_each(Index face, const Each& each) const {
        if (face + 1 >= end_.size() || end_[face] == end_[face + 1]) {
            each(whole(input_, face));
            return;
        }
        for (Index i = end_[face]; i < end_[face + 1]; ++i) each(pieces_[i]);
    }

    //! At least the number of pieces of all faces together.
    [[nodiscard]] std::size_t num_pieces_at_most() const { return num_faces_ + pieces_.size(); }

private:
    [[nodiscard]] static SurfacePiece whole(const Surface& surface, Index face);

    const Surface& input_;
    std::size_t num_faces_;
    std::vector<Index> end_;  // #F + 1, if any face is changed: pieces_ up to and without a face's.
    std::vector<SurfacePiece> pieces_;  // Of changed faces.
};

}  // namespace agvd
