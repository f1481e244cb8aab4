//! \file
//! The parts of a page that are the same for all meshes: built of tools/viewer by node.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "page/embed.h"

namespace page {

//! The page before and after its data. Empty: this build has no viewer.
struct Viewer {
    std::string_view head;
    std::string_view tail;
};
[[nodiscard]] Viewer viewer();

//! The file of a page.
//! \param data    what scripts read as JSON.
//! \param blocks  ids of elements, and the base64 in them.
//! \pre require_viewer() does not throw.
[[nodiscard]] std::string fill_viewer(
    const Json& data, const std::vector<std::pair<std::string, std::string>>& blocks);

//! Call before the long work. \param option  such as "--html".
//! \throw agvd::InvalidOption  this build has no viewer; says what is missing and how to get it.
void require_viewer(const char* option);

}  // namespace page
