//! \file
//! The stages of remesh() in their order: a whole run, and one attempt.
#pragma once

#include "remesh/pipeline/cleaned_input.h"
#include "remesh/sites/prepared_surface.h"

namespace remesh::detail {

class WorkLimit;
struct FoundCurves;
struct KeptCurves;

//! \param options  checked.
//! \throw what remesh() throws.
[[nodiscard]] RemeshResult run_stages(const InputMesh& input, const RemeshOptions& options);

//! What an attempt tells besides its result.
struct AttemptEnd {
    std::vector<SurfacePoint> narrow_points;  //!< Where cells wrapped around narrow parts.
    std::vector<Vec3> crossing_corners;       //!< See BuiltMesh.
};

//! Runs all stages after cleaning, with some of the curves, and sets what they give in the result
//! of the context. Checks that the mesh has the topology of the input, which the stages imply, and
//! the vertex count that was asked for.
//! \param sizes  target lengths; null: all equal.
//! \param work   counts the attempt.
//! \throw TooFewSamples, NetworkFailed   `cleaned` is unchanged then.
//! \throw std::logic_error  there is no plan, and the topology differs: a bug.
AttemptEnd run_attempt(CleanedInput& cleaned, const FoundCurves& found, const KeptCurves& kept,
                       const SizeField* sizes, WorkLimit& work, const StageContext& context);

//! The mean distance of the sites that the options ask for, mesh units.
[[nodiscard]] inline double spacing_for(const CleanedInput& cleaned, const RemeshOptions& options) {
    return mean_spacing(cleaned.surface,
                        options.sites ? options.sites->size() : options.num_samples);
}

}  // namespace remesh::detail
