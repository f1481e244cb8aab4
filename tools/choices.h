//! \file
//! The choices of the libraries by name, as on the command line: of the Python module and the npm
//! package.
#pragma once

#include "agvd/propagation/propagate.h"
#include "choose.h"
#include "remesh/sites/sites.h"

namespace cli {

[[nodiscard]] inline remesh::Init init_of(const std::string& name) {
    using remesh::Init;
    return choose<Init>("init", name, {Init::BlueNoise, Init::Farthest, Init::Random},
                        remesh::init_name);
}

[[nodiscard]] inline const char* boundary_name(remesh::Boundary boundary) {
    return boundary == remesh::Boundary::Keep ? "keep" : "free";
}

[[nodiscard]] inline remesh::Boundary boundary_of(const std::string& name) {
    using remesh::Boundary;
    return choose<Boundary>("boundary", name, {Boundary::Keep, Boundary::Free}, boundary_name);
}

[[nodiscard]] inline agvd::Engine engine_of(const std::string& name) {
    using agvd::Engine;
    return choose<Engine>("engine", name, {Engine::Window, Engine::Steiner}, agvd::engine_name);
}

}  // namespace cli
