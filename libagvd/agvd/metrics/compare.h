//! \file
//! How far a diagram is from the exact one.
#pragma once

#include "agvd/diagram/diagram.h"

namespace agvd {

//! Scale-free error of an approximate diagram (DESIGN: |dA - dB| at points of the bisectors, over the
//! mean cell radius sqrt(area / (pi t))).
struct DiagramError {
    double wrong_label_area = 0;       //!< Share of the surface's area with a wrong label.
    double mean_bisector_error = 0;    //!< Mean of |dA - dB| over the mean cell radius.
    double p95_bisector_error = 0;     //!< 95th percentile of the same.
    double max_bisector_error = 0;
    double min_relative_distance = 0;  //!< Lowest (ours - exact) / exact at the vertices; never
                                       //!< below rounding, since distances are of real paths.
    double mean_relative_distance = 0; //!< Mean of the same.
    Index bisector_points = 0;         //!< Points measured.
};

}  // namespace agvd
