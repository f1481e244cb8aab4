#include "agvd/propagation/option_checks.h"

#include <string>

#include "agvd/core/error.h"
#include "agvd/propagation/steiner/steiner_points.h"

namespace agvd {
namespace {

void check_steiner_options(const Surface& surface, const PropagationOptions& options) {
    if (options.steiner_points < 0 || options.steiner_points > max_steiner_points) {
        throw InvalidOption("the number of Steiner points per edge is " +
                            std::to_string(options.steiner_points) + "; use 0 to " +
                            std::to_string(max_steiner_points));
    }
    if (!(options.lambda > 0)) {
        throw InvalidOption("lambda is " + std::to_string(options.lambda) +
                            "; use a number above 0");
    }
    if (options.max_error && *options.max_error == 0) {
        throw InvalidOption(
            "the Steiner engine cannot be exact; use the window engine or an error above 0");
    }
    if (!NodeNumbers::suffice(surface, static_cast<Index>(options.steiner_points))) {
        throw InvalidOption(
            "this mesh with " + std::to_string(options.steiner_points) +
            " Steiner points per edge needs more than 2^32 nodes; use fewer Steiner points");
    }
}

}  // namespace

void check_options(const Surface& surface, const PropagationOptions& options) {
    if (options.max_error && !(*options.max_error >= 0 && *options.max_error < 1)) {
        throw InvalidOption("the maximal error is " + std::to_string(*options.max_error) +
                            "; use a number from 0 (exact) to below 1");
    }
    if (options.engine == Engine::Steiner) check_steiner_options(surface, options);
    if (options.engine == Engine::Vertex && options.max_error) {
        throw InvalidOption(
            "the vertex engine has no error bound; leave out max_error, or use the window or "
            "the Steiner engine");
    }
}

}  // namespace agvd
