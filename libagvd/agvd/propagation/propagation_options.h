//! \file
//! The three engines of propagation and their options.
#pragma once

#include <cstdint>
#include <optional>

#include "agvd/core/progress.h"

namespace agvd {

//! The algorithm that carries distances over the faces. All return the same Propagation.
enum class Engine : std::uint8_t {
    Window,   //!< Exact windows, merged as far as max_error allows: our AGVD.
    Steiner,  //!< Steiner points on the edges, [meng2023] Algorithm 1: the paper's AGVD.
    Vertex,   //!< One image of a site per vertex: coarse and quick.
};

//! Lower-case name of an engine, for command lines and reports.
[[nodiscard]] const char* engine_name(Engine engine);

//! `{}` gives the defaults.
struct PropagationOptions {
    Engine engine = Engine::Window;  //!< How distances are computed.
    //! Relative distance error, in [0, 1); 0: exact in double. Certified: see
    //! Propagation::certified_error. Unset: the window engine takes default_max_error, the Steiner
    //! engine certifies nothing. If set, the Steiner engine inserts points where they are needed
    //! until the bound holds at every vertex, up to 1000 on an edge; it cannot be exact, and 0 is
    //! an error. For the vertex engine it must be unset.
    std::optional<double> max_error = {};
    //! Steiner engine, m: Steiner points on each edge, in [0, 1000]; the first ones with max_error.
    int steiner_points = 8;
    //! Steiner engine: triangles are retired every lambda * #F pops, > 0. With max_error they all
    //! stay until the end.
    double lambda = 1;
    int num_threads = 0;     //!< >= 0; 0: all cores. The same bytes for any number.
    Progress progress = {};  //!< Polled during the call; see agvd::poll.
};

//! max_error of the window engine where none is asked for.
inline constexpr double default_max_error = 1e-4;

}  // namespace agvd
