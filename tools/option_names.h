//! \file
//! Names of the libraries' options in texts become those of the command line.
#pragma once

#include <string>
#include <string_view>

namespace cli {

//! "use a smaller drop_components" becomes "use a smaller --drop-components".
[[nodiscard]] std::string with_option_names(std::string_view text);

}  // namespace cli
