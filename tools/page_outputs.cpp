#include "page_outputs.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "mesh_paths.h"
#include "page/viewer.h"
#include "picture.h"
#include "remesh/meshfile/materials.h"

namespace cli {

void add_page_options(CLI::App& app, PageArguments& arguments) {
    add_file(app, "--html", arguments.html,
             "Write a page that shows original and result side by side, with all figures: one "
             "file for any browser, which needs no network")
        ->type_name("FILE");
    add_file(app, "--picture", arguments.picture,
             "Write a picture of original and result beside each other, as PNG")
        ->type_name("FILE");
}

bool wants_pages(const PageArguments& arguments) {
    return !arguments.html.empty() || !arguments.picture.empty();
}

void check_page_option(const char* option, const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    if (std::string_view(option) == "--html" && !extension.empty() && extension != ".html" &&
        extension != ".htm") {
        throw agvd::InvalidOption(path.string() + ": " + option +
                                  " writes a page of HTML; name it .html, which a browser prints "
                                  "as PDF");
    }
    if (path != "-") return;
    throw agvd::InvalidOption(std::string(option) +
                              " does not write to the standard output; name a file");
}

void check_page_options(const PageArguments& arguments) {
    check_page_option("--html", arguments.html);
    check_page_option("--picture", arguments.picture);
    if (!arguments.html.empty()) page::require_viewer("--html");
    if (!arguments.picture.empty()) require_pictures();
}

page::FaceLabels labels_for_page(const remesh::MeshAttributes& attributes) {
    for (const remesh::Attribute& attribute : attributes.of_faces) {
        if (!remesh::is_label(attribute)) continue;
        return {attribute.name, attribute.values};
    }
    return {};
}

std::vector<page::VertexValues> colors_for_page(const remesh::MeshAttributes& attributes) {
    constexpr double most = 255;
    std::vector<page::VertexValues> colors;
    for (const remesh::Attribute* const part : remesh::colors_of(attributes.of_vertices)) {
        if (part->name == "alpha") continue;
        colors.push_back({.key = part->name, .values = {}});
        for (std::size_t v = 0; v < part->values.size(); ++v) {
            const double value = most * remesh::intensity(*part, v);
            colors.back().values.push_back(value > 0 ? std::min(value, most) : 0);  // Not NaN.
        }
    }
    return colors;
}

std::vector<remesh::FileContent> make_pages(const PageArguments& arguments, page::Page page,
                                            const agvd::Progress& progress) {
    std::vector<remesh::FileContent> files;
    if (!arguments.html.empty()) {
        page.version = REMESH_VERSION;
        page.command = arguments.command;
        files.push_back({arguments.html, page::format_page(page, progress)});
    }
    if (!arguments.picture.empty()) {
        files.push_back({arguments.picture, picture_of(page.original, page.result)});
    }
    return files;
}

}  // namespace cli
