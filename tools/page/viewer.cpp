#include "page/viewer.h"

#include <string>

#include "agvd/core/error.h"

namespace page {

void require_viewer(const char* option) {
    if (!viewer().head.empty()) return;
    throw agvd::InvalidOption(
        std::string(option) +
        " needs the viewer of pages, and this program was built without it, as node and npm were "
        "not found or could not fetch its parts; install them (Debian: apt-get install nodejs "
        "npm), configure with cmake -DAGVD_WITH_VIEWER=ON and build again. --report and --picture "
        "work without");
}

}  // namespace page
