// propagate() and build_diagram() with sites anywhere on a small cleaned mesh, or on its intrinsic
// triangulation.
#include "agvd/diagram/diagram.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "agvd/core/error.h"
#include "agvd/intrinsic/intrinsic_triangulation.h"
#include "agvd/mesh/scale.h"
#include "agvd/propagation/propagate.h"
#include "remesh/clean/clean_input.h"
#include "small_mesh.h"
#include "support/checks.h"

using namespace agvd;

namespace {

PropagationOptions propagation_options(fuzz::Bytes& bytes) {
    PropagationOptions options{.num_threads = 1};
    options.engine = bytes.pick({Engine::Window, Engine::Window, Engine::Steiner});
    const double max_error = bytes.pick({1e-4, 0.0, 1e-2, 0.5});
    if (options.engine == Engine::Window) options.max_error = max_error;
    options.steiner_points = static_cast<int>(bytes.below(9));
    options.lambda = bytes.pick({1.0, 0.1, 100.0});
    return options;
}

// Beyond this the coordinates of a face have no digits left for its short sides, and the diagram
// need only end.
bool has_digits(const Surface& surface) {
    constexpr double most_ratio = 1e12;
    double shortest = infinity, longest = 0;
    for (Index h = 0; h < 3 * surface.num_faces(); ++h) {
        shortest = std::min(shortest, surface.length_of(h));
        longest = std::max(longest, surface.length_of(h));
    }
    return longest <= most_ratio * shortest;
}

void check_diagram(const Surface& surface, std::span<const SurfacePoint> sites,
                   const PropagationOptions& options) {
    const Propagation propagation = propagate(surface, sites, options);
    const Diagram diagram = build_diagram(surface, sites, propagation, {.num_threads = 1});
    if (has_digits(surface)) checks::expect_valid_complex(surface, diagram);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    testing::InitGoogleTest(argc, *argv);
    testing::GTEST_FLAG(throw_on_failure) = true;  // Ends the program: nobody catches it.
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const PropagationOptions options = propagation_options(bytes);
    const bool is_intrinsic = bytes.flip();
    const double pieces = bytes.pick({0.0, 2.0, 5.0});
    Surface surface;
    try {
        surface = build_surface(
            remesh::clean_input(fuzz::small_mesh(bytes).view(), {.num_threads = 1}).mesh.view());
    } catch (const InvalidInput&) {
        return 0;
    }
    std::vector<SurfacePoint> sites;
    do {
        sites.push_back(fuzz::point_on(bytes, surface.num_faces()));
    } while (sites.size() < 40 && !bytes.is_empty());
    if (!is_intrinsic) {
        check_diagram(surface, sites, options);
        return 0;
    }
    IntrinsicOptions flips{.most_splits = 200, .num_threads = 1};
    if (pieces > 0) flips.max_length = box_of(surface.mesh.view()).longest_side() / pieces;
    const IntrinsicTriangulation base(surface, flips);
    check_diagram(base.surface(), base.to_intrinsic(sites), options);
    return 0;
}
