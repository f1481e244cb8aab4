//! \file
//! Texts of the libraries and of the program in the words of JavaScript's callers.
#pragma once

#include <string>
#include <vector>

namespace npm {

[[nodiscard]] std::string in_terms_of_javascript(const std::string& text);
[[nodiscard]] std::vector<std::string> in_terms_of_javascript(std::vector<std::string> texts);

}  // namespace npm
