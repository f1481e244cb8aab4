#include "page/viewer.h"

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

std::string fill_viewer(const Json& data,
                        const std::vector<std::pair<std::string, std::string>>& blocks) {
    std::string html(viewer().head);
    const auto add = [&](const std::string& id, const std::string& content) {
        html += R"(<script type="application/octet-stream" id=")" + id + "\">" + content +
                "</script>\n";
    };
    add("page-data", to_script(data));
    for (const auto& [id, base64] : blocks) add(id, base64);
    return html += viewer().tail;
}

}  // namespace page
