//! \file
//! Nearest points of a mesh on the sheet that a point belongs to.
#pragma once

#include <cstdint>
#include <vector>

#include "agvd/core/groups.h"
#include "agvd/core/progress.h"
#include "agvd/mesh/closest_point.h"
#include "remesh/meshfile/read_mesh.h"

namespace remesh::detail {

//! Searches the part of the mesh that lies in the ball around a point and is connected, within the
//! ball, with a given start. So the other side of a thin wall is never found, however near it is.
//! Works on any triangles: vertices at equal positions count as one, and edges may have any number
//! of faces.
class NearestOnSheet {
public:
    //! Faces that a search has seen. Searches on one thread share it, so that it is allocated once.
    class Seen {
    public:
        void clear() {
            ++round_;
            count_ = 0;
        }
        //! False if it was there before.
        bool insert(Index face);

    private:
        struct Slot {
            Index face = no_index;
            std::uint64_t round = 0;  // Taken in this round; otherwise free.
        };
        void grow();

        std::vector<Slot> slots_ = std::vector<Slot>(64);  // Open addressing, 2^k slots.
        std::uint64_t round_ = 1;
        std::size_t count_ = 0;
    };

    //! \param mesh  outlives this; finite, indices in range. Cost: O(n).
    NearestOnSheet(const MeshView& mesh, Ticker ticker);

    //! The point of the sheet that is nearest to `point`. It is `start` itself, bit for bit, if
    //! `point` lies there up to rounding.
    //! Cost: that of the faces in the ball around `point` that reaches to `start`.
    [[nodiscard]] ClosestPoint query(const Vec3& point, const SurfacePoint& start,
                                     Seen& seen) const;

    //! Whether two faces are connected within a ball.
    //! Cost: that of the faces in the ball.
    [[nodiscard]] bool are_connected(const Vec3& center, double radius, Index a, Index b,
                                     Seen& seen) const;

    //! The same mesh where faces that do not agree at an edge are not neighbours.
    //! \param agree  outlives the copy.
    [[nodiscard]] NearestOnSheet cut_at_seams(const CornerAgreement& agree) const {
        NearestOnSheet cut = *this;
        cut.agree_ = &agree;
        return cut;
    }

    [[nodiscard]] const MeshView& mesh() const { return mesh_; }

private:
    [[nodiscard]] ClosestPoint closest(Index face, const Vec3& point) const;
    [[nodiscard]] std::size_t corner_at(Index face, Index point) const;
    template <typename Visit>
    void for_each_neighbor(Index face, std::size_t k, const Visit& visit) const;
    template <typename Visit>
    void flood(const Vec3& point, double reach, Index start, Seen& seen, const Visit& visit) const;

    MeshView mesh_;
    std::vector<Triangle> points_;  // #F: for each corner the first vertex at its position.
    Groups faces_;                  // At each such vertex.
    double rounding_ = 0;           // Lengths up to this are rounding.
    const CornerAgreement* agree_ = nullptr;  // Null: seams do not count.
};

}  // namespace remesh::detail
