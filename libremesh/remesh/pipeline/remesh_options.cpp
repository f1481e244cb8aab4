#include "remesh/pipeline/remesh.h"

#include <array>

namespace remesh {
namespace {

// The name of the value of an enum, whose names are given in order.
template <typename Enum, std::size_t n>
const char* name_of(Enum value, const std::array<const char*, n>& names) {
    const auto i = static_cast<std::size_t>(value);
    return i < n ? names[i] : "unknown";
}

}  // namespace

const char* features_name(Features features) {
    return name_of(features, std::array{"auto", "angle", "off"});
}

const char* stage_name(Stage stage) {
    return name_of(stage, std::array{"clean", "sample", "relax", "propagate", "diagram", "dual",
                                     "delaunay", "place", "check"});
}

}  // namespace remesh
