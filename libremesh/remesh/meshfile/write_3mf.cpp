// Writes 3MF: a package with an object for each label `object` (or else `group`) of the faces, in
// the unit of the input, and their materials with their colours. Coordinates have the fewest digits
// that read back as the same number.

#include <algorithm>
#include <numeric>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/packed.h"

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

constexpr const char* default_unit = "millimeter";
constexpr const char* default_color = "#FFFFFFFF";

// For the value of an attribute of XML.
std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : as_utf8(one_line(text))) {
        const bool is_plain = c != '<' && c != '&' && c != '"';
        result += is_plain ? std::string(1, c) : "&#" + std::to_string(int{c}) + ';';
    }
    return result + '"';
}

const Attribute* find_labels(const std::vector<Attribute>& attributes, const char* name) {
    const Attribute* const found = find_attribute(attributes, name);
    return found != nullptr && !found->names.empty() ? found : nullptr;
}

std::size_t label_of(const Attribute& labels, Index face) {
    return static_cast<std::size_t>(labels.values[face]);
}

// What becomes an object of the file.
struct Part {
    std::string name;
    std::vector<Index> vertices, faces;  // Of the mesh.
};

// The whole mesh with all its vertices, or the faces of each label.
std::vector<Part> parts_of(const MeshView& mesh, const Attribute* labels) {
    if (labels == nullptr) {
        Part all{{},
                 std::vector<Index>(mesh.positions.size()),
                 std::vector<Index>(mesh.triangles.size())};
        std::iota(all.vertices.begin(), all.vertices.end(), Index{0});
        std::iota(all.faces.begin(), all.faces.end(), Index{0});
        return {all};
    }
    std::vector<Part> parts(labels->names.size());
    for (std::size_t i = 0; i < parts.size(); ++i) parts[i].name = labels->names[i];
    for (Index f = 0; f < mesh.triangles.size(); ++f) {
        parts[label_of(*labels, f)].faces.push_back(f);
    }
    std::erase_if(parts, [](const Part& part) { return part.faces.empty(); });
    std::vector<std::size_t> last_part(mesh.positions.size(), parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
        for (const Index f : parts[i].faces) {
            for (const Index v : mesh.triangles[f]) {
                if (std::exchange(last_part[v], i) != i) parts[i].vertices.push_back(v);
            }
        }
        std::sort(parts[i].vertices.begin(), parts[i].vertices.end());
    }
    return parts;
}

// An element that begins with attributes that are numbers; it is not ended.
template <typename Row>
void append_begin(std::string& text, const char* name, const char* const (&attributes)[3],
                  const Row& row) {
    text += '<';
    text += name;
    auto number = std::begin(row);
    for (const char* attribute : attributes) {
        text.append(" ").append(attribute).append("=\"");
        append_shortest(text, *number++);
        text += '"';
    }
}

// One for each label, in their order.
void append_materials(std::string& text, const Attribute& labels, const Materials& materials) {
    const std::map<std::string, std::string> colors = colors_of(materials);
    text += "<basematerials id=\"1\">\n";
    for (const std::string& name : labels.names) {
        const auto color = colors.find(as_utf8(name));
        text += "<base name=" + quoted(name.empty() ? "none" : name) + " displaycolor=\"" +
                (color == colors.end() ? default_color : color->second) + "\"/>\n";
    }
    text += "</basematerials>\n";
}

// \param number_of  for each vertex of the mesh, of any content.
void append_object(std::string& text, const MeshView& mesh, const Part& part, const std::string& id,
                   const Attribute* materials, std::vector<Index>& number_of, Ticker& ticker) {
    text += "<object id=\"" + id + "\" type=\"model\"";
    if (!part.name.empty()) text += " name=" + quoted(part.name);
    const auto material = [&](Index f) { return std::to_string(label_of(*materials, f)); };
    const bool has_material = materials != nullptr && !part.faces.empty();
    // That of the first face; others that differ have their own.
    const std::string common = has_material ? material(part.faces[0]) : "";
    if (has_material) text += " pid=\"1\" pindex=\"" + common + '"';
    text += ">\n<mesh>\n<vertices>\n";
    for (Index i = 0; i < part.vertices.size(); ++i) {
        ticker.tick(4);
        number_of[part.vertices[i]] = i;
        append_begin(text, "vertex", {"x", "y", "z"}, mesh.positions[part.vertices[i]]);
        text += "/>\n";
    }
    text += "</vertices>\n<triangles>\n";
    for (const Index f : part.faces) {
        ticker.tick(4);
        Triangle corners = mesh.triangles[f];
        for (Index& v : corners) v = number_of[v];
        append_begin(text, "triangle", {"v1", "v2", "v3"}, corners);
        if (has_material && material(f) != common) {
            text += " pid=\"1\" p1=\"" + material(f) + '"';
        }
        text += "/>\n";
    }
    text += "</triangles>\n</mesh>\n</object>\n";
}

}  // namespace

bool holds_3mf(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    if (kind == ElementKind::Vertex || attribute.names.empty()) return false;
    return attribute.name == "material" || attribute.name == "object" ||
           (attribute.name == "group" && find_attribute(all.of_faces, "object") == nullptr);
}

std::string format_3mf(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const Attribute* labels = find_labels(attributes.of_faces, "object");
    if (labels == nullptr) labels = find_labels(attributes.of_faces, "group");
    const Attribute* const materials = find_labels(attributes.of_faces, "material");
    std::string model =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model unit=\"" +
        (attributes.unit.empty() ? default_unit : attributes.unit) +
        "\" xml:lang=\"en-US\" "
        "xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\">\n<resources>\n";
    if (materials != nullptr) append_materials(model, *materials, attributes.materials);
    std::string items;
    std::vector<Index> number_of(mesh.positions.size());
    std::size_t id = materials == nullptr ? 1 : 2;
    for (const Part& part : parts_of(mesh, labels)) {
        const std::string number = std::to_string(id++);
        append_object(model, mesh, part, number, materials, number_of, ticker);
        items += "<item objectid=\"" + number + "\"/>\n";
    }
    model += "</resources>\n<build>\n" + items + "</build>\n</model>\n";
    return pack_zip({{"[Content_Types].xml", content_types},
                     {"_rels/.rels", relations},
                     {"3D/3dmodel.model", std::move(model)}},
                    ticker);
}

}  // namespace remesh
