// For a build without libpng.
#include "agvd/core/error.h"
#include "picture.h"

namespace cli {

void require_pictures() {
    throw agvd::InvalidOption(
        "--picture needs libpng, and this program was built without it; install it (Debian: "
        "libpng-dev) and build again");
}

std::string picture_of(const agvd::MeshView&, const agvd::MeshView&) { return {}; }

void check_picture(const std::filesystem::path&) { require_pictures(); }

std::string picture_of_diagram(const std::filesystem::path&, const page::DiagramPage&,
                               const agvd::CutCells&, const std::array<double, 3>&) {
    return {};
}

}  // namespace cli
