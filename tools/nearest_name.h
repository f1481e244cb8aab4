//! \file
//! What somebody meant who wrote a name that does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace cli {

//! The name with the least edit distance, if a third of the letters of `unknown` differ at most, or
//! if it begins with `unknown`; otherwise an empty text. Of equally near names the first.
[[nodiscard]] std::string nearest_name(std::string_view unknown,
                                       std::span<const std::string> names);

}  // namespace cli
