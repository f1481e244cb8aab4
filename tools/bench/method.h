//! \file
//! The methods of propagation that are compared.
#pragma once

#include <string>
#include <vector>

#include "agvd/propagation/propagate.h"

namespace bench {

struct Method {
    std::string name;  //!< Short, for the table: "window 1e-03", "steiner m=8".
    agvd::PropagationOptions options;
    //! Only labels of vertices are used, joined by straight segments (paper/vertex_labels.h).
    bool by_vertex_labels = false;
};

//! The options to vary; each engine uses those that it has.
struct MethodLists {
    std::vector<agvd::Engine> engines;
    std::vector<double> max_errors;   //!< Window engine.
    std::vector<int> steiner_points;  //!< Steiner engine, with each of the lambdas.
    std::vector<double> lambdas;
};

[[nodiscard]] std::vector<Method> methods(const MethodLists& lists);

}  // namespace bench
