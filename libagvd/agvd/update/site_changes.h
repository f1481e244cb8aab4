//! \file
//! A change of a list of sites.
#pragma once

#include <utility>
#include <vector>

#include "agvd/mesh/surface_point.h"

namespace agvd {

//! What happens to a list of sites, in this order. Indices are those before the change.
struct SiteChanges {
    std::vector<std::pair<Index, SurfacePoint>> moved;  //!< Sites and their new places.
    std::vector<Index> removed;                         //!< Those behind move up.
    std::vector<SurfacePoint> added;                    //!< At the end.
};

}  // namespace agvd
