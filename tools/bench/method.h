//! \file
//! The methods of propagation that are compared.
#pragma once

#include <string>
#include <vector>

#include "agvd/propagation/propagate.h"

namespace bench {

//! How a diagram comes from distances.
enum class Drawing {
    OnMesh,       //!< All on the triangles of the mesh.
    OnBase,       //!< On the intrinsic base that the programs use (based_diagram.h).
    VertexLabels  //!< Labels of vertices alone, joined by straight segments
                  //!< (paper/vertex_labels.h).
};

struct Method {
    std::string name;  //!< Short, for the table: "window 1e-03", "steiner m=8".
    agvd::PropagationOptions options;
    Drawing drawing = Drawing::OnMesh;
};

//! The options to vary; each engine uses those that it has.
struct MethodLists {
    std::vector<agvd::Engine> engines;
    std::vector<double> max_errors;   //!< Window engine.
    std::vector<int> steiner_points;  //!< Steiner engine, with each of the lambdas.
    std::vector<double> lambdas;
};

[[nodiscard]] std::vector<Method> methods(const MethodLists& lists);

//! The same on the intrinsic base; their names end in "base".
[[nodiscard]] std::vector<Method> on_base(std::vector<Method> methods);

}  // namespace bench
