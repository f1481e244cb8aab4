#include "agvd/propagation/surface_layout.h"

#include "agvd/propagation/arc_graph.h"

namespace agvd {

SurfaceLayout::SurfaceLayout(const Surface& surface, int num_threads, const Progress& progress)
    : corners_(std::make_shared<const Corners>(surface, num_threads, progress)),
      arcs_(std::make_unique<ArcGraph>(surface, *corners_, num_threads, progress)) {}

SurfaceLayout::SurfaceLayout(SurfaceLayout&&) noexcept = default;
SurfaceLayout& SurfaceLayout::operator=(SurfaceLayout&&) noexcept = default;
SurfaceLayout::~SurfaceLayout() = default;

std::size_t SurfaceLayout::bytes() const { return corners_->bytes() + arcs_->bytes(); }

}  // namespace agvd
