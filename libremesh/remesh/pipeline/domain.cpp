#include "remesh/pipeline/domain.h"

#include <algorithm>
#include <utility>

#include "agvd/core/error.h"
#include "agvd/core/number_text.h"
#include "remesh/pipeline/cleaned_input.h"
#include "remesh/pipeline/stage_context.h"

namespace remesh::detail {
namespace {

// For a base that is not Delaunay, since flips reached their limit: rounding tilts edges around
// parts that are 10^12 times as long as wide, and each flip repairs little of that. Later stages
// would take long on it, and the result would be far off.
[[noreturn]] void refuse_narrow_parts(const Surface& surface, const CleanedInput& cleaned) {
    Index narrowest = 0;
    double most = 0;
    for (Index h = 0; h < surface.twin.size(); ++h) {
        const double narrow = surface.length_of(h) / surface.apex[h].y();
        if (narrow <= most) continue;
        most = narrow;
        narrowest = Surface::face(h);
    }
    const Index face = cleaned.face_origin.empty() ? narrowest : cleaned.face_origin[narrowest];
    throw InvalidInput(
        "face " + std::to_string(face) + " is " +
        number_text(most, 1, std::chars_format::scientific) +
        " times as long as high, and coordinates in double have too few digits for distances on "
        "such parts; remove this part, and others like it, or make them wider");
}

}  // namespace

Domain prepare_domain(const CleanedInput& cleaned, CurvedSurface curved,
                      const StageContext& context) {
    const auto& [options, result] = context;
    const StageClock clock(Stage::Clean, result);
    const Progress progress = within(progress_of(Stage::Clean, options), cleaned_fraction, 1);
    PreparedSurface prepared(curved.cut(), curved.spacing, options.num_threads, progress,
                             curved.sizes);
    Domain domain{std::move(curved), std::move(prepared)};
    if (!domain.prepared.base.counts().is_delaunay) refuse_narrow_parts(*domain.whole, cleaned);
    result.refined_faces = domain.base().num_faces();
    return domain;
}

}  // namespace remesh::detail
