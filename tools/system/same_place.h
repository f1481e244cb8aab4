//! \file
//! Whether paths name one file.
#pragma once

#include <filesystem>
#include <string>

namespace cli {

//! Equal for paths of one file, which need not exist yet.
[[nodiscard]] std::string place_of(const std::filesystem::path& path);

}  // namespace cli
