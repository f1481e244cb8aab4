// Writes 3MF: a package with one object in millimetres, coordinates with the fewest digits that
// read back as the same number. 3MF has no place for attributes but colours and materials, which
// are not written.

#include "remesh/io/formats.h"
#include "remesh/io/text_format.h"
#include "remesh/io/zip_archive.h"

namespace remesh {
namespace {

constexpr const char* content_types =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Types xmlns=\"http://schemas.openxmlformats.org/package/2006/content-types\">\n"
    "<Default Extension=\"rels\" "
    "ContentType=\"application/vnd.openxmlformats-package.relationships+xml\"/>\n"
    "<Default Extension=\"model\" "
    "ContentType=\"application/vnd.ms-package.3dmanufacturing-3dmodel+xml\"/>\n</Types>\n";

constexpr const char* relations =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\">\n"
    "<Relationship Id=\"model\" Target=\"/3D/3dmodel.model\" "
    "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/>\n</Relationships>\n";

constexpr const char* model_begin =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<model unit=\"millimeter\" xml:lang=\"en-US\" "
    "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n"
    "<resources>\n<object id=\"1\" type=\"model\">\n<mesh>\n<vertices>\n";

constexpr const char* model_end =
    "</triangles>\n</mesh>\n</object>\n</resources>\n<build>\n<item objectid=\"1\"/>\n</build>\n"
    "</model>\n";

// An element whose attributes are numbers.
template <typename Row>
void append_element(std::string& text, const char* name, const char* const (&attributes)[3],
                    const Row& row) {
    text += '<';
    text += name;
    auto number = std::begin(row);
    for (const char* attribute : attributes) {
        text.append(" ").append(attribute).append("=\"");
        append_shortest(text, *number++);
        text += '"';
    }
    text += "/>\n";
}

}  // namespace

std::string format_3mf(const agvd::MeshView& mesh, const MeshAttributes& /*attributes*/,
                       agvd::Ticker ticker) {
    std::string model = model_begin;
    for (const agvd::Vec3& p : mesh.positions) {
        ticker.tick(4);
        append_element(model, "vertex", {"x", "y", "z"}, p);
    }
    model += "</vertices>\n<triangles>\n";
    for (const agvd::Triangle& t : mesh.triangles) {
        ticker.tick(4);
        append_element(model, "triangle", {"v1", "v2", "v3"}, t);
    }
    model += model_end;
    ZipWriter zip;
    zip.add("[Content_Types].xml", content_types, ticker);
    zip.add("_rels/.rels", relations, ticker);
    zip.add("3D/3dmodel.model", model, ticker);
    return std::move(zip).finish();
}

}  // namespace remesh
