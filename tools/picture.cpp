#include "picture.h"

#include "render/diagram_picture.h"
#include "render/mesh_picture.h"

namespace cli {

void require_pictures() {}

std::string picture_of(const agvd::MeshView& original, const agvd::MeshView& result) {
    return render::picture_of_pair(original, result);
}

void check_picture(const std::filesystem::path& path) {
    if (path.extension() == ".png" || path.extension() == ".svg") return;
    throw agvd::IoError(path.string() + ": pictures are .png or .svg; choose one of these names");
}

std::string picture_of_diagram(const std::filesystem::path& path, const page::DiagramPage& page,
                               const agvd::CutCells& cells, const std::array<double, 3>& view) {
    const render::DiagramDrawing drawing{.cells = cells,
                                         .bisectors = page.bisectors,
                                         .isolines = page.isolines,
                                         .sites = page.sites,
                                         .site_lines = page.site_lines,
                                         .degrees = view};
    return path.extension() == ".svg" ? render::svg_of(drawing) : render::png_of(drawing);
}

}  // namespace cli
