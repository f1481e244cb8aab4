//! \file
//! What comes after cleaning, once: from the network of curves to a mesh that is checked.
#pragma once

#include "remesh/pipeline/cleaned_input.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

struct DistanceBound;
struct FoundCurves;
struct InputCrossings;
struct KeptCurves;

//! What mesh_with_curves() tells besides its result.
struct MadeMesh {
    bool has_mesh = false;
    Index num_needed = 0;  //!< Without a mesh: so many vertices may suffice.
    //! On the cleaned surface, where parts are narrower than the spacing: see PlacedSites.
    std::vector<SurfacePoint> narrow_points = {};
    std::vector<SurfacePoint> crossing_corners = {};  //!< See BuiltMesh.
};

//! Where the vertices of a mesh come from.
enum class Vertices {
    Sites,
    Surface  //!< They are some of the surface's, and no collapse that leads there adds an
             //!< intersection.
};

//! Runs all stages from the network of curves on, and sets what they give in the result of the
//! context. Checks that the mesh has the topology of the input, and the vertex count that was asked
//! for.
//! \param kept      of the curves found. Seams go where they would take vertices from creases.
//! \param sizes     target lengths; null: all equal.
//! \param bound     a distance that the mesh is to keep; null: none. If that is proved, it is told
//!                  in result.sizing.
//! \param of_input  of the cleaned input; searched if the result intersects itself.
[[nodiscard]] MadeMesh mesh_with_curves(const CleanedInput& cleaned, const FoundCurves& found,
                                        const KeptCurves& kept, const SizeField* sizes,
                                        const DistanceBound* bound, InputCrossings& of_input,
                                        const StageContext& context,
                                        Vertices vertices = Vertices::Sites);

//! The mean distance of the sites that the options ask for, mesh units.
[[nodiscard]] inline double spacing_for(const CleanedInput& cleaned, const RemeshOptions& options) {
    return mean_spacing(cleaned.surface,
                        options.sites ? options.sites->size() : options.num_samples);
}

}  // namespace remesh::detail
