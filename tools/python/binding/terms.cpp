#include "binding/terms.h"

#include <string_view>

namespace python {
namespace {

struct Term {
    std::string_view given, python;
};

// What differs by more than hyphens; longer ones first.
constexpr Term terms[] = {
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
    {"num_faces", "faces"},
    {"num_threads", "threads"},
    {"is_adaptive", "adaptive"},
    {"target_lengths", "sizing"},
    {"face_lengths", "face_sizing"},
    {"densities", "density"},
    {"relax_steps", "relax"},
    {"samples_per_tile", "tile"},
    {"feature_angle", "features"},
    {"texture_seams", "uv"},
};

bool is_of_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
}

bool begins_word(std::string_view text, std::size_t at) {
    return at == 0 || !is_of_word(text[at - 1]);
}

void replace_words(std::string& text, const Term& term) {
    const auto [given, python] = term;
    for (std::size_t at = text.find(given); at != std::string::npos; at = text.find(given, at)) {
        const std::size_t end = at + given.size();
        // A full stop may end the sentence.
        if (begins_word(text, at) &&
            (end == text.size() || text[end] == '.' || !is_of_word(text[end]))) {
            text.replace(at, given.size(), python);
        }
        ++at;
    }
}

}  // namespace

std::string in_terms_of_python(std::string text) {
    for (const Term& term : terms) replace_words(text, term);
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) {
        if (!begins_word(text, at)) continue;
        text.erase(at, 2);
        for (; at < text.size() && is_of_word(text[at]); ++at) {
            if (text[at] == '-') text[at] = '_';
        }
    }
    return text;
}

}  // namespace python
