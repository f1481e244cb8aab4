//! \file
//! Texts and bytes as parts of an HTML page, such that nothing in them can end the part.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "agvd/core/types.h"

namespace page {

//! Keeps the keys in the order in which they were set.
using Json = nlohmann::ordered_json;

//! JSON for the inside of a script element: ASCII alone, and `<`, `>` and `&` are escaped, so that
//! neither `</script>` nor `<!--` can occur. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string to_script(const Json& json);

//! Its three coordinates.
[[nodiscard]] inline Json point_json(const agvd::Vec3& point) {
    return {point.x(), point.y(), point.z()};
}

//! Base64 of RFC 4648 with padding.
[[nodiscard]] std::string to_base64(std::string_view bytes);

//! A command line that a POSIX shell splits into these words again.
[[nodiscard]] std::string to_shell(int argc, const char* const* argv, std::string_view program);

}  // namespace page
