// Wavefront OBJ: vertices (v, also with colours), texture coordinates of corners (vt), faces (f),
// materials, groups and objects; other statements and the normals of corners are skipped. Vertices
// are never split (format: Wavefront, Advanced Visualizer Manual, appendix B1).

#include <algorithm>
#include <numeric>
#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

// Statements that give labels to the faces behind them, and the attributes that these become.
struct LabelStatement {
    std::string_view keyword;
    const char* attribute;
};
constexpr std::array label_statements = {LabelStatement{"usemtl", "material"},
                                         LabelStatement{"g", "group"},
                                         LabelStatement{"o", "object"}};

// A name may have several words. A backslash at its end would join the line with the next one when
// it is written.
std::string name_on(TextScanner& scan) {
    std::string name = scan.words();
    while (name.ends_with('\\') || name.ends_with(' ')) name.pop_back();
    return name;
}

// Colours, labels and texture coordinates.
class ObjAttributes {
public:
    // \param is_wanted  false: everything is skipped.
    explicit ObjAttributes(bool is_wanted) : is_wanted_(is_wanted) {}

    // The words behind a vertex's coordinates: three are a colour, one is a weight.
    void take_color(std::size_t vertex, TextScanner& scan) {
        if (is_wanted_) {
            const TextScanner::Numbers numbers = scan.numbers(4);
            if (numbers.is_broken) colors_.spoil();
            const std::span color = std::span(numbers.values).first(numbers.count);
            if (color.size() > 1) colors_.take(vertex, color);
        }
        while (scan.has_word()) scan.word();  // Over joined lines too.
    }

    // The coordinates behind vt: a second one may be missing, a third one does not count.
    void take_texture(TextScanner& scan, SoupTexture& texture) const {
        // Joined lines are skipped, wanted or not.
        const TextScanner::Numbers numbers = scan.numbers(2);
        if (!is_wanted_) return;
        texture.name = "vt";
        texture.is_broken = texture.is_broken || numbers.is_broken;
        texture.add(numbers.values[0], numbers.values[1]);
    }

    // Any other statement than v, vt and f.
    // \param num_polygons  before it.
    void take(std::string_view statement, std::size_t num_polygons, TextScanner& scan) {
        if (!is_wanted_) return;
        has_normals_ = has_normals_ || statement == "vn";
        if (statement == "mtllib") material_files_.push_back(name_on(scan));
        for (std::size_t i = 0; i < label_statements.size(); ++i) {
            if (statement != label_statements[i].keyword) continue;
            if (labels_[i].num_labels() == 0 && num_polygons > 0) labels_[i].begin_unnamed();
            labels_[i].extend(current_[i], num_polygons);
            current_[i] = labels_[i].number_of(name_on(scan));
        }
    }

    [[nodiscard]] bool is_wanted() const { return is_wanted_; }

    // All attributes; those of faces have a value for each polygon.
    MeshAttributes finish(std::size_t num_vertices, std::size_t num_polygons) && {
        MeshAttributes attributes;
        attributes.material_files = std::move(material_files_);
        if (has_normals_) attributes.normals = NumberType::Float32;
        std::move(colors_).finish(num_vertices, ElementKind::Vertex, attributes);
        for (std::size_t i = 0; i < label_statements.size(); ++i) {
            if (labels_[i].num_labels() == 0) continue;
            labels_[i].extend(current_[i], num_polygons);
            attributes.of_faces.push_back(
                std::move(labels_[i]).finish(label_statements[i].attribute));
        }
        return attributes;
    }

private:
    bool is_wanted_;
    bool has_normals_ = false;
    TextColors colors_;
    std::array<FaceLabels, label_statements.size()> labels_;
    std::array<std::size_t, label_statements.size()> current_{};
    std::vector<std::string> material_files_;
};

// The file counts from 1, or with negative numbers back from the last vertex so far. What follows
// (/vt, //vn, /vt/vn) must look like that.
// \return the vertex from 0, and what follows it: vt, /vn or vt/vn.
std::pair<std::int64_t, std::string_view> read_corner(TextScanner& scan, const SourceFile& file,
                                                      std::size_t num_vertices) {
    std::string_view rest;
    const std::size_t start = scan.offset();
    const std::int64_t number = scan.integer("a corner (v, v/vt, v//vn or v/vt/vn)", '/');
    const std::size_t slash = scan.offset();
    if (scan.take("/")) {
        rest = scan.rest_of_word();
        if (rest.find_first_not_of("0123456789-/") != std::string_view::npos) {
            file.fail_malformed(slash,
                                "expected texture and normal numbers after a corner's '/'; correct "
                                "the line, or export the file again");
        }
    }
    const auto count = static_cast<std::int64_t>(num_vertices);
    if (number == 0 || number < -count) {
        file.fail_unusable(
            start, "a face names vertex ", number,
            (number == 0 ? ", but OBJ counts vertices from 1"
                         : ", but only " + std::to_string(count) + " vertices come before it"),
            "; correct the face, or export the file again");
    }
    return {number > 0 ? number - 1 : count + number, rest};
}

// Flat drawings have two coordinates: 2 or 3, as the vertex that comes next has.
int count_coordinates(TextScanner& scan) {
    const std::size_t start = scan.offset();
    int count = 0;
    while (count < 3 && !scan.word().empty()) ++count;
    scan.go_to(start);
    return std::max(count, 2);
}

// The texture coordinates of the last corner so far. Those that do not exist are found at the end.
void take_coordinates(std::string_view rest, PolygonSoup& soup) {
    rest = rest.substr(0, rest.find('/'));
    if (rest.empty()) return;
    std::int64_t number = as_whole<std::int64_t>(rest).value_or(0);
    SoupTexture& texture = soup.texture;
    if (number < 0) number += static_cast<std::int64_t>(texture.values.size()) + 1;
    if (number < 1 || number > no_index) {
        texture.is_broken = true;
        return;
    }
    texture.set_corner(soup.num_corners(), static_cast<Index>(number - 1));
}

// The named labels of a statement; null: there are none.
const Attribute* labels_of(const LabelStatement& statement, const MeshAttributes& attributes) {
    const Attribute* const labels = find_attribute(attributes.of_faces, statement.attribute);
    return labels == nullptr || labels->names.empty() ? nullptr : labels;
}

std::size_t label_of(const Attribute& labels, Index face) {
    return static_cast<std::size_t>(labels.values[face]);
}

// Faces of one object, group and material follow each other; those that come first stay first.
std::vector<Index> order_by_labels(const MeshAttributes& attributes, Index num_faces) {
    std::vector<Index> order(num_faces);
    std::iota(order.begin(), order.end(), Index{0});
    for (const LabelStatement& statement : label_statements) {
        const Attribute* const labels = labels_of(statement, attributes);
        if (labels == nullptr) continue;
        std::vector<Index> first(labels->names.size(), num_faces);  // Face of each label.
        for (Index f = num_faces; f-- > 0;) first[label_of(*labels, f)] = f;
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
            return first[label_of(*labels, a)] < first[label_of(*labels, b)];
        });
    }
    return order;
}

// Statements for the labels that differ from those of the face before: object, group, material.
// \param before  no_index: the face is the first one.
void append_labels(std::string& bytes, const MeshAttributes& attributes, Index face, Index before) {
    for (std::size_t i = label_statements.size(); i-- > 0;) {
        const Attribute* const labels = labels_of(label_statements[i], attributes);
        if (labels == nullptr) continue;
        const std::size_t at = label_of(*labels, face);
        const std::string& label = labels->names[at];
        if (before == no_index ? label.empty() : at == label_of(*labels, before)) continue;
        bytes.append(label_statements[i].keyword).append(" ");
        bytes.append(label.empty() ? "none" : label) += '\n';
    }
}

// Appends the lines vt. \return for each corner the number of its coordinates, from 1; 0: it has
// none.
std::vector<std::size_t> append_texture(std::string& bytes, const TextureCoordinates& texture,
                                        Ticker& ticker) {
    std::map<std::pair<double, double>, std::size_t> known;
    std::vector<std::size_t> numbers;
    for (const CornerCoordinates& corners : texture.corners) {
        ticker.tick(4);
        for (const Vec2& p : corners) {
            if (!is_whole(corners)) {
                numbers.push_back(0);
                continue;
            }
            const auto [entry, is_new] = known.try_emplace({p.x(), p.y()}, known.size() + 1);
            numbers.push_back(entry->second);
            if (is_new && texture.type == NumberType::Float32) {
                append_line(bytes, "vt ", p.cast<float>().eval());
            } else if (is_new) {
                append_line(bytes, "vt ", p);
            }
        }
    }
    return numbers;
}

// \param texture  see append_texture; empty: there is none.
void append_face(std::string& bytes, const Triangle& triangle, std::size_t face, bool has_normals,
                 const std::vector<std::size_t>& texture) {
    bytes += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
        const std::string number = std::to_string(triangle[k] + 1ull);
        const std::size_t coordinates = texture.empty() ? 0 : texture[3 * face + k];
        bytes.append(" ").append(number);
        if (coordinates > 0) bytes.append("/").append(std::to_string(coordinates));
        if (has_normals) bytes.append(coordinates > 0 ? "/" : "//").append(number);
    }
    bytes += '\n';
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): all readers have this type.
MeshFile read_obj(SourceFile file) {
    TextScanner scan(file, 0, {.comment = '#', .continues = true});
    PolygonSoup soup(file, 1);
    ObjAttributes attributes(file.with_attributes);
    int num_coordinates = 3;
    while (scan.find_word()) {
        soup.ticker.tick();
        const std::string_view statement = scan.word();
        if (statement == "v") {
            if (soup.positions.empty()) num_coordinates = count_coordinates(scan);
            soup.positions.push_back(scan.point(num_coordinates));
            if (num_coordinates == 2 && scan.has_word()) {
                scan.fail_expecting("the end of the line, as vertices before have two coordinates");
            }
            if (scan.has_word()) attributes.take_color(soup.positions.size() - 1, scan);
        } else if (statement == "vt") {
            attributes.take_texture(scan, soup.texture);
        } else if (statement == "f") {
            while (scan.has_word()) {
                const std::size_t start = scan.offset();
                const auto [vertex, rest] = read_corner(scan, file, soup.positions.size());
                soup.add_corner(vertex, start);
                if (attributes.is_wanted()) take_coordinates(rest, soup);
            }
            soup.end_polygon();
        } else {
            attributes.take(statement, soup.num_polygons(), scan);
        }
        scan.skip_line();
    }
    const std::size_t num_polygons = soup.num_polygons();
    MeshFile result = std::move(soup).finish();
    attach(std::move(attributes).finish(result.mesh.positions.size(), num_polygons), result);
    if (num_coordinates == 2) {
        add_warning(result, file.path.string(),
                    ": the vertices have two coordinates; z = 0 is taken");
    }
    return result;
}

bool obj_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    if (kind == ElementKind::Vertex) {
        return is_color(attribute.name) && attribute.name != "alpha" &&
               !colors_of(all.of_vertices).empty();
    }
    return !attribute.names.empty() &&
           std::ranges::find(label_statements, attribute.name, &LabelStatement::attribute) !=
               label_statements.end();
}

std::string format_obj(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    std::string bytes;
    for (const std::string& file : attributes.material_files) bytes += "mtllib " + file + '\n';
    const std::vector<const Attribute*> colors = colors_of(attributes.of_vertices);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        append_line(bytes, "v ", mesh.positions[v]);
        if (colors.empty()) continue;
        append_to_line(bytes, std::span<const float>(intensities(colors, v)).first(3));
    }
    if (attributes.normals) {
        for (const Vec3& normal : vertex_normals(mesh)) {
            ticker.tick(4);
            append_line(bytes, "vn ", normal.cast<float>().eval());
        }
    }
    const auto texture = append_texture(bytes, attributes.texture, ticker);
    Index before = no_index;
    for (const Index f : order_by_labels(attributes, static_cast<Index>(mesh.triangles.size()))) {
        ticker.tick();
        append_labels(bytes, attributes, f, std::exchange(before, f));
        append_face(bytes, mesh.triangles[f], f, attributes.normals.has_value(), texture);
    }
    return bytes;
}

}  // namespace remesh
