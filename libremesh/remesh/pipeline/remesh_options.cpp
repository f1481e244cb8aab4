#include "remesh/pipeline/remesh_options.h"

namespace remesh {

const char* features_name(Features features) {
    switch (features) {
        case Features::Auto:
            return "auto";
        case Features::Angle:
            return "angle";
        case Features::Off:
            return "off";
    }
    return "unknown";
}

const char* stage_name(Stage stage) {
    switch (stage) {
        case Stage::Clean:
            return "clean";
        case Stage::Sample:
            return "sample";
        case Stage::Relax:
            return "relax";
        case Stage::Propagate:
            return "propagate";
        case Stage::Diagram:
            return "diagram";
        case Stage::Dual:
            return "dual";
        case Stage::Delaunay:
            return "delaunay";
        case Stage::Place:
            return "place";
        case Stage::Check:
            return "check";
    }
    return "unknown";
}

}  // namespace remesh
