#include "option_names.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cli {
namespace {

using Names = std::pair<std::string_view, std::string_view>;

// Those that texts of errors name and a command line can cause.
constexpr std::array names{Names{"VertexDensities", "--density"},
                           Names{"VertexLengths", "--sizing"},
                           Names{"drop_components", "--drop-components"},
                           Names{"longest_edge", "--longest-edge"},
                           Names{"max_angle", "--max-angle"},
                           Names{"max_edge", "--max-edge"},
                           Names{"max_error", "--max-error"},
                           Names{"min_angle", "--min-angle"},
                           Names{"min_edge", "--min-edge"},
                           Names{"num_samples", "--samples"}};

}  // namespace

std::string with_option_names(std::string_view text) {
    constexpr std::string_view between = " ,;";  // Parts of a file's name are no words.
    std::string result;
    while (!text.empty()) {
        const std::size_t size = std::max<std::size_t>(1, text.find_first_of(between));
        const std::string_view word = text.substr(0, size);
        const auto* const found = std::find_if(
            names.begin(), names.end(), [&](const Names& known) { return known.first == word; });
        result += found == names.end() ? word : found->second;
        text.remove_prefix(word.size());
    }
    return result;
}

}  // namespace cli
