#include "feature_rule.h"

namespace npm {

void set_feature_rule(Options& given, remesh::RemeshOptions& options) {
    const Json* const rule = given.find("features");
    if (rule != nullptr && rule->is_number()) {
        options.features = remesh::Features::Angle;
        options.feature_angle = *given.number("features");
    } else if (const auto name = given.text("features"); name && *name != "auto") {
        if (*name != "off") {
            throw agvd::InvalidOption("features is '" + *name +
                                      "'; use 'auto', 'off' or an angle in degrees");
        }
        options.features = remesh::Features::Off;
    }
}

}  // namespace npm
