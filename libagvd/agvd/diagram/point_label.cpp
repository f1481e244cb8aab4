#include "agvd/diagram/point_label.h"

#include <algorithm>

#include "agvd/propagation/site_placement.h"

namespace agvd {

PointLabel PointLabels::operator()(const SurfacePoint& point) {
    const Index face = point.face.value();
    const auto& mixed = propagation_.mixed_faces;
    const auto found = std::lower_bound(mixed.begin(), mixed.end(), face);
    if (found == mixed.end() || *found != face) {
        return {propagation_.vertex_site[surface_.mesh.triangles[face][0]], {}};
    }
    const auto i = static_cast<Index>(found - mixed.begin());
    planar_.clear();
    append_planar(surface_, relays_of(propagation_, i), Motion{}, planar_);
    const Nearest label = nearest(planar_, position_in_frame(surface_, point, 3 * face));
    return {SiteId(label.site), label.distance};
}

}  // namespace agvd
