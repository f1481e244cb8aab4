//! \file
//! Materials in the terms of glTF, and their colours in those of 3MF. Private to the readers and
//! writers.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "remesh/meshfile/mesh_attributes.h"

namespace remesh {

//! The JSON; bytes that are no UTF-8 are replaced, so that none is refused.
template <typename Json>
std::string text_of(const Json& value) {
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

//! Likewise.
[[nodiscard]] std::string as_utf8(const std::string& name);

//! \param colors  sRGB by name, as #RRGGBB or #RRGGBBAA; others are left out.
[[nodiscard]] Materials materials_of_colors(const std::map<std::string, std::string>& colors);

//! Their base colours by name, as #RRGGBBAA.
[[nodiscard]] std::map<std::string, std::string> colors_of(const Materials& materials);

}  // namespace remesh
