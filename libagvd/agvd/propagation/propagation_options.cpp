#include "agvd/propagation/propagation_options.h"

namespace agvd {

const char* engine_name(Engine engine) {
    switch (engine) {
        case Engine::Window:
            return "window";
        case Engine::Steiner:
            return "steiner";
        case Engine::Vertex:
            return "vertex";
    }
    return "unknown";
}

}  // namespace agvd
