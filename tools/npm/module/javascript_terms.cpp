#include "javascript_terms.h"

#include "terms.h"

namespace npm {
namespace {

// What differs by more than the style of names; longer ones first.
constexpr cli::Term terms[] = {
    {"(remesh and agvd diagram: --lenient)", "(lenient: true)"},
    {"(remesh: --from for an input, --to for the output)", "(format)"},
    {"more or fewer --samples", "another n"},
    {"more --samples", "a larger n"},
    {"fewer --samples", "a smaller n"},
    {"--samples", "n"},
    {"--boundary free", "boundary: 'free'"},
    {"--relax 0", "relax: 0"},
    {"--delaunay extrinsic", "delaunay: 'extrinsic'"},
    {"--delaunay off", "delaunay: 'off'"},
    {"--keep-labels", "faceLabels"},
    {"num_samples", "n"},
    {"NumFaces", "faces"},
    {"MeanEdge", "edgeLength"},
    {"MaxDistance", "maxDistance"},
    {"is_adaptive", "adaptive"},
    {"VertexLengths", "sizing"},
    {"FaceLengths", "faceSizing"},
    {"VertexDensities", "density"},
    {"relax_steps", "relax"},
    {"feature_angle", "features"},
    {"feature_edges", "featureEdges"},
    {"face_labels", "faceLabels"},
    {"texture_seams", "uv"},
    {"max_error", "maxError"},
    {"drop_components", "dropComponents"},
    {"fill_holes", "fillHoles"},
    {"lock_boundary", "lockBoundary"},
    {"min_edge", "minEdge"},
    {"max_edge", "maxEdge"},
    {"min_angle", "minAngle"},
    {"max_angle", "maxAngle"},
    {"longest_edge", "longestEdge"},
};

}  // namespace

std::string in_terms_of_javascript(const std::string& text) {
    return cli::in_terms(text, terms, cli::NameStyle::Camel);
}

std::vector<std::string> in_terms_of_javascript(std::vector<std::string> texts) {
    for (std::string& text : texts) text = in_terms_of_javascript(text);
    return texts;
}

}  // namespace npm
