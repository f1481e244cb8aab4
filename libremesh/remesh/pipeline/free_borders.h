//! \file
//! Takes the trace of tiles away.
#pragma once

#include "remesh/pipeline/domain.h"
#include "remesh/pipeline/improvable_mesh.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {

//! Vertices within so many edges of a border, and the surface within so many spacings of them,
//! are what free_borders() and improve_in_places() need there.
inline constexpr Index rings_of_strips = 10;
inline constexpr double reach_of_strips = 2;

//! Vertices of a mesh at which tiles meet.
struct TileBorders {
    std::vector<Index> vertices;  //!< Ascending.
    std::vector<Index> nodes;     //!< Of these the ones at which more than two meet.
};

//! Relaxes the vertices near borders, which are free now, on their triangles, and fits them to the
//! surface again. Those on curves stay, as do the topology and the number of triangles.
//! Cost: that of base, labels and fit for the surface within some rings of the borders.
void free_borders(const CurvedSurface& curved, const TileBorders& borders, PlacedMesh& mesh,
                  const StageContext& context);

}  // namespace remesh::detail
