//! \file
//! A diagram that was built on an intrinsic triangulation, drawn on the faces of the input.
#pragma once

#include "agvd/diagram/diagram.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"

namespace agvd {

//! The same complex with all points on base.input(): Voronoi edges get a point where they cross an
//! edge of the input, so that consecutive points share a face of it as before. The distances of
//! these points are interpolated. Labels are those of the input's vertices.
//! \param diagram  of base.surface().
//! \throw Cancelled  the progress callback returned false.
//! Cost: that of mapping each segment.
[[nodiscard]] Diagram diagram_on_input(const IntrinsicTriangulation& base, Diagram diagram,
                                       const Progress& progress = {});

}  // namespace agvd
