//! \file
//! Which cell of a diagram holds a point, by the diagram's curves alone. Private to the metrics.
#pragma once

#include "agvd/diagram/diagram.h"

namespace agvd {

//! Keeps references. Any thread may ask.
class CellLocator {
public:
    //! Cost: O(#F + #points of the diagram).
    CellLocator(const Surface& surface, const Diagram& diagram);

    //! The cell of a point in the interior of a face and off the curves; invalid where no site
    //! reaches. Cost: O(k), k = pieces of curves in the face, squared at worst.
    [[nodiscard]] SiteId operator()(const SurfacePoint& point) const;

private:
    // A piece of a bisector, in the affine frame of its face: corner 0 at (0, 0), corners 1 and 2
    // at (1, 0) and (0, 1).
    struct Piece {
        Vec2 from, to;
        SiteId left, right;
    };
    const Surface& surface_;
    const Diagram& diagram_;
    std::vector<Index> offsets_;  // #F + 1, into pieces_.
    std::vector<Piece> pieces_;
};

}  // namespace agvd
