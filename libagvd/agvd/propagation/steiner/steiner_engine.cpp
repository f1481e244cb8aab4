#include "agvd/propagation/steiner/steiner_engine.h"

#include <algorithm>

#include "agvd/propagation/steiner/steiner_front.h"
#include "agvd/propagation/steiner/steiner_refinement.h"

namespace agvd {

Propagation propagate_steiner(const Surface& surface, std::span<const SurfacePoint> sites,
                              const PropagationOptions& options) {
    if (options.max_error) return propagate_steiner_within(surface, sites, options);
    const SteinerCounts counts(static_cast<Index>(options.steiner_points));
    SteinerFront front(surface, sites, counts);
    front.run(std::max(1.0, options.lambda * surface.num_faces()), options.progress);
    return front.finish();
}

}  // namespace agvd
