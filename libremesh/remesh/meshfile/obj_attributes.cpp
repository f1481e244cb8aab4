#include "remesh/meshfile/obj_attributes.h"

#include <utility>

namespace remesh {
namespace {

// A name may have several words. A backslash at its end would join the line with the next one when
// it is written.
std::string name_on(TextScanner& scan) {
    std::string name = scan.words();
    while (name.ends_with('\\') || name.ends_with(' ')) name.pop_back();
    return name;
}

}  // namespace

void ObjAttributes::take_color(std::size_t vertex, TextScanner& scan) {
    std::array<double, 4> numbers{};
    std::size_t count = 0;
    while (scan.has_word()) {  // Over joined lines too.
        if (!is_wanted_ || count == numbers.size()) {
            scan.word();
            continue;
        }
        const std::optional<double> number = scan.number_or_other("a number");
        if (!number) colors_.spoil();
        numbers[count++] = number.value_or(0);
    }
    if (count > 1) colors_.take(vertex, std::span(numbers).first(count));
}

void ObjAttributes::take_texture(TextScanner& scan, SoupTexture& texture) const {
    std::array<double, 2> numbers{};
    bool is_broken = false;
    for (double& number : numbers) {
        if (!scan.has_word()) break;  // Joined lines are passed over, wanted or not.
        const std::optional<double> read = scan.number_or_other("a number");
        is_broken = is_broken || !read;
        number = read.value_or(0);
    }
    if (!is_wanted_) return;
    texture.name = "vt";
    texture.is_broken = texture.is_broken || is_broken;
    texture.add(numbers[0], numbers[1]);
}

void ObjAttributes::take(std::string_view statement, std::size_t num_polygons, TextScanner& scan) {
    if (!is_wanted_) return;
    has_normals_ = has_normals_ || statement == "vn";
    if (statement == "mtllib") material_files_.push_back(name_on(scan));
    for (Labels& labels : labels_) {
        if (statement == labels.statement) labels.begin(name_on(scan), num_polygons);
    }
}

void ObjAttributes::Labels::begin(const std::string& label, std::size_t num_polygons) {
    if (names.empty() && num_polygons > 0) names.emplace_back();  // Of the polygons before.
    values.resize(num_polygons, static_cast<double>(current));
    const auto [found, is_new] = number.try_emplace(label, names.size());
    if (is_new) names.push_back(label);
    current = found->second;
}

MeshAttributes ObjAttributes::finish(std::size_t num_vertices, std::size_t num_polygons) && {
    MeshAttributes attributes;
    attributes.material_files = std::move(material_files_);
    if (has_normals_) attributes.normals = NumberType::Float32;
    std::move(colors_).finish(num_vertices, ElementKind::Vertex, attributes);
    for (Labels& labels : labels_) {
        if (labels.names.empty()) continue;
        labels.values.resize(num_polygons, static_cast<double>(labels.current));
        attributes.of_faces.push_back({.name = labels.name,
                                       .type = NumberType::Int32,
                                       .values = std::move(labels.values),
                                       .names = std::move(labels.names)});
    }
    return attributes;
}

}  // namespace remesh
