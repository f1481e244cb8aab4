// The edges of a mesh that are creases, to be drawn.
#include "calls.h"
#include "feature_rule.h"
#include "mesh_message.h"
#include "options.h"
#include "page/curve_edges.h"
#include "run.h"

namespace npm {

Answer call_creases(const Request& request) {
    Options given(request.json()["options"]);
    remesh::RemeshOptions options{.num_threads = 1};
    set_feature_rule(given, options);
    const agvd::MeshView mesh = view_of(request);
    const auto count = given.count("n", mesh.positions.size());
    given.require_known();
    Run run({{"clean", 1}});
    options.cleaning.progress = run.of("clean");
    Answer answer;
    answer.add<agvd::Index>(
        "creases",
        page::crease_edges(mesh, options,
                           static_cast<std::size_t>(count.value_or(options.num_samples))));
    return answer;
}

}  // namespace npm
