#include "binding/python_terms.h"

#include <utility>

#include "terms.h"

namespace python {
namespace {

// What differs by more than hyphens; longer ones first.
constexpr cli::Term terms[] = {
    {"more or fewer --samples", "another n"},
    {"more --samples", "a larger n"},
    {"fewer --samples", "a smaller n"},
    {"--samples", "n"},
    {"--boundary free", "boundary='free'"},
    {"--relax 0", "relax=0"},
    {"--delaunay extrinsic", "delaunay='extrinsic'"},
    {"--delaunay off", "delaunay='off'"},
    {"--keep-labels", "face_labels"},
    {"num_samples", "n"},
    {"NumFaces", "faces"},
    {"MeanEdge", "edge_length"},
    {"MaxDistance", "max_distance"},
    {"num_threads", "threads"},
    {"is_adaptive", "adaptive"},
    {"VertexLengths", "sizing"},
    {"FaceLengths", "face_sizing"},
    {"VertexDensities", "density"},
    {"relax_steps", "relax"},
    {"samples_per_tile", "tile"},
    {"feature_angle", "features"},
    {"texture_seams", "uv"},
};

}  // namespace

std::string in_terms_of_python(std::string text) {
    return cli::in_terms(std::move(text), terms, cli::NameStyle::Snake);
}

}  // namespace python
