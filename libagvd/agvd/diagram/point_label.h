//! \file
//! What a propagation says at any point of the surface.
#pragma once

#include <optional>
#include <vector>

#include "agvd/diagram/face_relays.h"
#include "agvd/mesh/mesh.h"

namespace agvd {

struct PointLabel {
    SiteId site;                     //!< Nearest site; invalid where none reaches.
    std::optional<double> distance;  //!< Through the relays; unknown in faces of one label.
};

//! Answers by the relays of the point's face, or by its one label. Keeps references.
class PointLabels {
public:
    PointLabels(const Surface& surface, const Propagation& propagation)
        : surface_(surface), propagation_(propagation) {}

    [[nodiscard]] PointLabel operator()(const SurfacePoint& point);

private:
    const Surface& surface_;
    const Propagation& propagation_;
    std::vector<PlanarRelay> planar_;  // Of the last point's face; kept for its memory.
};

}  // namespace agvd
