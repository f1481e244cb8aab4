//! \file
//! The parts of a page that are the same for all meshes: built of tools/viewer by node.
#pragma once

#include <string_view>

namespace page {

//! The page before and after its data. Empty: this build has no viewer.
struct Viewer {
    std::string_view head;
    std::string_view tail;
};
[[nodiscard]] Viewer viewer();

//! Call before the long work. \param option  such as "--html".
//! \throw agvd::InvalidOption  this build has no viewer; says what is missing and how to get it.
void require_viewer(const char* option);

}  // namespace page
