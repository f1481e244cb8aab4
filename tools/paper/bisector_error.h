//! \file
//! Error of bisectors: |dA - dB| where a diagram says that its cells A and B meet.
#pragma once

#include <span>

#include "agvd/diagram/diagram.h"

namespace agvd {

//! A point of a bisector and the two sites that it is said to be equally far from.
struct BisectorSample {
    SurfacePoint point;  //!< On the surface.
    SiteId left;         //!< One site.
    SiteId right;        //!< The other one.
    double distance;  //!< From both, as the diagram has it; between two points of the bisector the
                      //!< larger of theirs.
};

//! The points of the Voronoi edges' polylines and the middles between them, in their order.
[[nodiscard]] std::vector<BisectorSample> bisector_samples(const Surface& surface,
                                                           const Diagram& diagram);

//! |dA - dB| over the mean cell radius.
struct BisectorError {
    double mean = 0;       //!< Over the points measured.
    double p95 = 0;        //!< 95th percentile.
    double max = 0;        //!< Over the points measured.
    Index num_points = 0;  //!< Points measured.
};

//! \param errors  in any order; may be empty.
[[nodiscard]] BisectorError summarize(std::vector<double> errors);

//! sqrt(area / (pi t)): the radius of a disc of the cells' mean area.
[[nodiscard]] double mean_cell_radius(const Surface& surface, std::size_t num_sites);

}  // namespace agvd
