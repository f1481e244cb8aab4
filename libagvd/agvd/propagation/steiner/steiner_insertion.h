//! \file
//! Where the Steiner engine inserts points.
#pragma once

#include <vector>

#include "agvd/propagation/steiner/steiner_front.h"

namespace agvd {

//! The number of points on each edge. It grows on marked edges.
class SteinerInsertion {
public:
    //! \param points  on every edge at first.
    SteinerInsertion(const Surface& surface, int points);

    //! #E
    [[nodiscard]] const std::vector<std::uint16_t>& points() const { return points_; }

    //! Marks the edges of the faces that the path to a vertex crosses, and the edges at the
    //! vertices that it passes.
    //! \param front  a front that has run and kept all nodes.
    void mark_path(const SteinerFront& front, Index vertex);

    //! Marks the edges of all faces that a shortest path from a site to a vertex can cross.
    //! \param distance  #V: from the nearest site.
    void mark_between(std::span<const double> distance, Index vertex);

    //! Halves the spacing on the marked edges, as far as there is room, and removes the marks.
    //! False if there was no room.
    [[nodiscard]] bool insert();

    [[nodiscard]] std::size_t bytes() const {
        return points_.capacity() * sizeof(points_[0]) + is_marked_.capacity() / 8 +
               visited_for_.capacity() * sizeof(Index);
    }

private:
    void mark_face(Index face);
    void mark_around(Index vertex);
    [[nodiscard]] bool may_be_crossed(Index face, std::span<const double> distance,
                                      Index vertex) const;

    const Surface& surface_;
    std::vector<std::uint16_t> points_;  // #E
    std::vector<bool> is_marked_;        // #E
    std::vector<Index> visited_for_;     // #F: the last vertex whose paths were sought in the face.
};

}  // namespace agvd
