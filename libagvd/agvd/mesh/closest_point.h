//! \file
//! Nearest point of a mesh, by a tree of bounding boxes: of equally near ones that in the lowest
//! face. Held by ClosestPointTree in tests/agvd/mesh.
#pragma once

#include "agvd/core/progress.h"
#include "agvd/mesh/mesh.h"

namespace agvd {

//! The point of a mesh that is nearest to another point.
struct ClosestPoint {
    SurfacePoint point;  //!< A barycentric coordinate of exactly 0 means on the edge, two a vertex.
    Vec3 position;       //!< The same in space.
    double distance_sq = 0;  //!< From the query to `position`.
};

//! Nearest point of one triangle, which may be degenerate; `face` is only passed on. Two triangles
//! give the same bits for a point on a common edge or vertex.
[[nodiscard]] ClosestPoint closest_point_on_triangle(const std::array<Vec3, 3>& corners,
                                                     FaceId face, const Vec3& query);

//! Squared distance of a point from a segment, whose ends may be the same point.
[[nodiscard]] double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b);

//! For many queries on one mesh. It keeps a copy of the corners, and no reference to the mesh. It
//! takes 130 bytes per face.
class ClosestPointTree {
public:
    //! \param mesh  any triangles, degenerate and non-manifold ones too; finite, indices in range.
    //! \throw InvalidInput  there is no face.
    //! Cost: O(n log n).
    //! \throw Cancelled     the progress callback returned false.
    explicit ClosestPointTree(const MeshView& mesh, const Progress& progress = {});

    //! The nearest point; of equally near points the one in the lowest face. Any thread may call
    //! this.
    //! Cost: O(log n) near the surface.
    [[nodiscard]] ClosestPoint query(const Vec3& point) const;
    //! The same, quicker for a point near that of the last query.
    //! \param hint  0 at first; set for the next query of this tree.
    [[nodiscard]] ClosestPoint query(const Vec3& point, Index& hint) const;
    //! Whether a point of the mesh is so near, or nearer. Any thread may call this.
    //! Cost: less than that of query(), as the first such point ends it.
    //! \param distance  mesh units, >= 0.
    [[nodiscard]] bool is_within(const Vec3& point, double distance) const;
    //! Whether a test holds for the corners of a triangle. Any thread may call this.
    //! \param reaches  bool(const Vec3& low, const Vec3& high): whether it may hold in that box.
    //! \param test     bool(const std::array<Vec3, 3>&); the first that holds ends the search.
    template <typename Reaches, typename Test>
    [[nodiscard]] bool any_triangle(const Reaches& reaches, const Test& test) const;

    //! The lower corner of a box around all triangles, a little wider than they are.
    [[nodiscard]] const Vec3& low() const { return nodes_.front().low; }
    //! Its upper corner.
    [[nodiscard]] const Vec3& high() const { return nodes_.front().high; }

private:
    struct Node {
        Index begin, end;  // Slots of the triangles below.
        Index right = 0;   // Second child (the first follows its parent); 0 for a leaf.
        Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // Box.
    };
    void build(const std::vector<Vec3>& centers, std::vector<Index>& faces, Index begin, Index end,
               Ticker& ticker);
    struct Found {
        ClosestPoint nearest;
        Index slot = 0;
    };
    void take_nearer(Index slot, const Vec3& point, Found& best) const;
    void search(const Vec3& point, double most_sq, double enough_sq, Found& best) const;

    std::vector<std::array<Vec3, 3>> corners_;  // Per slot, in leaf order.
    std::vector<FaceId> face_;                  // Per slot.
    std::vector<Node> nodes_;                   // Depth first.
};

template <typename Reaches, typename Test>
bool ClosestPointTree::any_triangle(const Reaches& reaches, const Test& test) const {
    std::array<Index, 64> stack;  // One per level; halving keeps it below 32.
    std::size_t waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
        const Index self = stack[--waiting];
        const Node& node = nodes_[self];
        if (!reaches(node.low, node.high)) continue;
        if (node.right == 0) {
            for (Index slot = node.begin; slot < node.end; ++slot) {
                if (test(corners_[slot])) return true;
            }
            continue;
        }
        stack[waiting++] = node.right;
        stack[waiting++] = self + 1;
    }
    return false;
}

}  // namespace agvd
