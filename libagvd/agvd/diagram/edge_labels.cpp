#include "agvd/diagram/edge_labels.h"

namespace agvd {

void EdgeLabels::renumber(const Renumbering& renumbering) {
    for (Index& site : point_site) renumbering.apply(site);
    for (Crossing& crossing : crossings) {
        renumbering.apply(crossing.site_before);
        renumbering.apply(crossing.site_after);
    }
    for (InnerPoint& point : inner_points) renumbering.apply(point.site);
}

}  // namespace agvd
