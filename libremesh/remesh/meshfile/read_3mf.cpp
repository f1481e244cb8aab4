// 3MF: the surfaces of all items of the build, each where its transforms put it. Materials and
// objects are labels of the faces. Coordinates are those of the file, whatever its unit, which is
// kept (format: 3MF Consortium, "3D Manufacturing Format: Core Specification" 1.3, "Materials and
// Properties Extension" 1.2, "Production Extension" 1.1).

#include <algorithm>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_scanner.h"
#include "remesh/meshfile/xml_reader.h"

namespace remesh {
namespace {

// An object placed somewhere: an item of the build, or a component of another object.
struct Placement3mf {
    std::string part;  // That holds the object; empty: the one where this stands.
    std::uint64_t object = 0;
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    std::size_t tag = 0;  // In the text of the part.
};

struct Object3mf {
    std::string name;
    bool is_surface = true;  // Else it supports others while they are printed, or the like.
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;    // Their corners are in range.
    std::vector<Index> materials = {};  // By triangle, with attributes: of Model3mf::materials.
    std::vector<Placement3mf> components = {};
};

// Its name, and its colour as in the file: #RRGGBB or #RRGGBBAA.
using Material3mf = std::pair<std::string, std::string>;

// A model part of the file, before its objects are put together.
struct Model3mf {
    std::map<std::uint64_t, Object3mf> objects;
    std::vector<Placement3mf> items;
    std::string unit = "millimeter";
    std::vector<Material3mf> materials = {{}};  // The first: none.
};

// What the parts have and is not read.
struct Skipped3mf {
    bool lattice = false;    // Beams.
    bool texture = false;    // Properties of triangles.
    bool gradients = false;  // Triangles whose corners have different colours.
};

constexpr std::string_view core_space = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
                           material_space =
                               "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
                           production_space =
                               "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
                           sets_space =
                               "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
                           model_relation =
                               "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
constexpr std::string_view xml_blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(xml_blanks), text.size()));
    return text.substr(0, text.find_last_not_of(xml_blanks) + 1);
}

// Takes the next word from the front of a text; empty: there is none.
std::string_view next_word(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find_first_of(xml_blanks));
    text.remove_prefix(word.size());
    return word;
}

class ModelParser3mf : public XmlVisitor {
public:
    ModelParser3mf(const SourceFile& part, Skipped3mf& skipped) : part_(part), skipped_(skipped) {}

    void declare(std::string_view prefix, std::string_view uri) override {
        spaces_[std::string(prefix)] = uri;
    }

    bool begin(const XmlTag& tag) override {
        if (tag.depth == 0) {
            read_root(tag);
        } else if (tag.space == core_space) {
            read_core(tag);
        } else if (tag.space == material_space) {
            if (tag.name == "colorgroup") open_group(tag, true);
            if (tag.name == "color") add_material(tag, "color", "color");
        } else if (tag.name == "beamlattice") {
            skipped_.lattice = true;
        }
        return true;
    }

    void end(std::size_t depth, std::size_t /*at*/, std::size_t /*behind*/) override {
        if (depth == object_depth_) object_ = nullptr;
        if (depth == group_depth_) group_ = nullptr;
    }

    Model3mf finish() && { return std::move(model_); }

private:
    // Materials or colours: these of the model.
    struct Group {
        std::size_t first = 0, count = 0;
        bool is_color = false;
    };

    template <typename... Parts>
    [[noreturn]] void fail(const XmlTag& tag, Parts... parts) const {
        part_.fail_damaged(tag.begin, parts...);
    }

    void read_root(const XmlTag& tag) {
        if (tag.name != "model" || tag.space != core_space) {
            fail(tag, "the part begins with the element ", in_quotes(tag.name),
                 ", which is not a model of 3MF");
        }
        model_.unit = tag.find("unit").value_or(model_.unit);
        constexpr std::array units = {"micron", "millimeter", "centimeter",
                                      "inch",   "foot",       "meter"};
        if (std::find(units.begin(), units.end(), model_.unit) == units.end()) {
            fail(tag, "the unit ", in_quotes(model_.unit), " is none of 3MF");
        }
        // Extensions without which the model means something else.
        constexpr std::array known = {core_space, material_space, production_space, sets_space};
        std::string_view prefixes = tag.find("requiredextensions").value_or("");
        for (std::string_view word; !(word = next_word(prefixes)).empty();) {
            const std::string prefix(word);
            const auto found = spaces_.find(prefix);
            const std::string uri = found == spaces_.end() ? prefix : found->second;
            if (std::find(known.begin(), known.end(), uri) == known.end()) {
                part_.fail_malformed(tag.begin, "the model needs the extension '", uri,
                                     "', which is not supported; export it without");
            }
        }
    }

    void read_core(const XmlTag& tag) {
        if (tag.name == "vertex") {
            read_vertex(tag);
        } else if (tag.name == "triangle") {
            read_triangle(tag);
        } else if (tag.name == "object") {
            read_object(tag);
        } else if (tag.name == "component") {
            open_object(tag).components.push_back(placement(tag));
        } else if (tag.name == "item") {
            model_.items.push_back(placement(tag));
        } else if (tag.name == "basematerials") {
            open_group(tag, false);
        } else if (tag.name == "base") {
            add_material(tag, "name", "displaycolor");
        }
    }

    void read_object(const XmlTag& tag) {
        if (object_ != nullptr) fail(tag, "there is an object inside of another");
        const std::uint64_t id = required_number(tag, "id");
        const auto [entry, is_new] = model_.objects.try_emplace(id);
        if (!is_new) fail(tag, "there are two objects with the id ", id);
        object_ = &entry->second;
        object_depth_ = tag.depth;
        const std::string_view type = tag.find("type").value_or("model");
        object_->is_surface = type == "model" || type == "surface";
        object_->name = tag.find("name").value_or("");
        if (object_->name.empty()) object_->name = "object_" + std::to_string(id);
        object_group_ = number(tag, "pid");
        object_property_ = number(tag, "pindex");
    }

    Object3mf& open_object(const XmlTag& tag) const {
        if (object_ == nullptr) fail(tag, "the element ", in_quotes(tag.name), " is in no object");
        return *object_;
    }

    void read_vertex(const XmlTag& tag) {
        Object3mf& object = open_object(tag);
        Vec3 p;
        constexpr std::array names = {"x", "y", "z"};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string_view text = trimmed(tag.find(names[k]).value_or(""));
            const auto value = as_number(text);
            if (!value) fail(tag, names[k], " of a vertex is ", in_quotes(text), " and no number");
            p.data()[k] = *value;
        }
        if (!p.allFinite()) {
            part_.fail_unusable(
                tag.begin, "vertex ", object.vertices.size(), " of object ", in_quotes(object.name),
                " has a coordinate that is not finite; correct or delete the vertex");
        }
        object.vertices.push_back(p);
    }

    // Vertices come before the triangles.
    void read_triangle(const XmlTag& tag) {
        Object3mf& object = open_object(tag);
        Triangle corners;
        constexpr std::array names = {"v1", "v2", "v3"};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t vertex = required_number(tag, names[k]);
            if (vertex >= object.vertices.size()) {
                part_.fail_unusable(
                    tag.begin, "a triangle of object ", in_quotes(object.name), " names vertex ",
                    vertex, ", but the object has only ", object.vertices.size(),
                    " vertices, counted from 0; correct the triangle, or export the file again");
            }
            corners[k] = static_cast<Index>(vertex);
        }
        object.triangles.push_back(corners);
        if (part_.with_attributes) object.materials.push_back(material(tag));
    }

    // Of a triangle: its own one, or that of the object.
    Index material(const XmlTag& tag) {
        const auto own = number(tag, "p1");
        const auto property = own ? own : object_property_;
        auto group = number(tag, "pid");
        if (!group) group = object_group_;
        if (!group || !property) return 0;
        const auto found = groups_.find(*group);
        if (found == groups_.end()) {
            skipped_.texture = true;
            return 0;
        }
        const Group& names = found->second;
        if (*property >= names.count) {
            fail(tag, "a triangle has property ", *property, " of group ", *group,
                 ", which has only ", names.count);
        }
        for (const char* other : {"p2", "p3"}) {
            if (names.is_color && number(tag, other).value_or(*property) != *property) {
                skipped_.gradients = true;
            }
        }
        return static_cast<Index>(names.first + *property);
    }

    void open_group(const XmlTag& tag, bool is_color) {
        group_ = &groups_[required_number(tag, "id")];
        group_depth_ = tag.depth;
        *group_ = {.first = model_.materials.size(), .count = 0, .is_color = is_color};
    }

    void add_material(const XmlTag& tag, const char* name, const char* color) {
        if (group_ == nullptr) return;
        ++group_->count;
        model_.materials.emplace_back(tag.find(name).value_or(""), tag.find(color).value_or(""));
    }

    [[nodiscard]] Placement3mf placement(const XmlTag& tag) const {
        Placement3mf result{
            .part = std::string(trimmed(tag.find("path", production_space).value_or(""))),
            .object = required_number(tag, "objectid"),
            .tag = tag.begin};
        const auto text = tag.find("transform");
        if (!text) return result;
        // Rows of four by three: the last one is the translation.
        std::string_view left = *text;
        for (int i = 0; i < 12; ++i) {
            const auto value = as_number(next_word(left));
            if (!value || !std::isfinite(*value)) break;
            result.transform.matrix()(i % 3, i / 3) = *value;
            if (i == 11 && trimmed(left).empty()) return result;
        }
        fail(tag, "the transform ", in_quotes(*text), " has not twelve finite numbers");
    }

    [[nodiscard]] std::optional<std::uint64_t> number(const XmlTag& tag, const char* name) const {
        const auto found = tag.find(name);
        if (!found) return std::nullopt;
        const std::string_view text = trimmed(*found);
        if (const auto value = as_whole<std::uint64_t>(text)) return value;
        fail(tag, name, " of ", in_quotes(tag.name), " is ", in_quotes(text),
             " and no whole number from 0");
    }

    [[nodiscard]] std::uint64_t required_number(const XmlTag& tag, const char* name) const {
        const auto value = number(tag, name);
        if (!value) fail(tag, "the element ", in_quotes(tag.name), " has no ", name);
        return *value;
    }

    static constexpr std::size_t no_depth = SIZE_MAX;

    const SourceFile& part_;
    Skipped3mf& skipped_;
    Model3mf model_;
    std::map<std::string, std::string> spaces_;  // By prefix.
    std::map<std::uint64_t, Group> groups_;      // By id.
    Object3mf* object_ = nullptr;                // Whose element is open.
    Group* group_ = nullptr;
    std::size_t object_depth_ = no_depth, group_depth_ = no_depth;
    std::optional<std::uint64_t> object_group_, object_property_;
};

// A component of components of ... may make any number of a few bytes.
constexpr std::size_t most_placements = 1 << 16;

// Finds the name of the part that is the model.
class RelationsParser : public XmlVisitor {
public:
    bool begin(const XmlTag& tag) override {
        const bool is_model = tag.name == "Relationship" && tag.find("Type") == model_relation;
        if (is_model) target = tag.find("Target").value_or("");
        return !is_model;
    }

    std::string target;
};

// As in the ZIP file, where names do not begin with '/'.
std::string part_name(const std::string& path) {
    return path.substr(std::min(path.find_first_not_of('/'), path.size()));
}

class Reader3mf {
public:
    explicit Reader3mf(SourceFile& file) : file_(file), zip_(file), soup_(file, 0) {}

    MeshFile read() {
        const std::string root = find_root();
        const Part& part = load(root);
        if (part.model.items.empty()) {
            part.source.fail_malformed(part.source.bytes.size(),
                                       "the model has no item to build; export it with one");
        }
        for (const Placement3mf& item : part.model.items) {
            place(item, part, Eigen::Affine3d::Identity());
            place_components();
        }
        MeshFile result = std::move(soup_).finish();
        if (file_.with_attributes) attach(finish_attributes(), result);
        result.attributes.unit = part.model.unit;
        const std::string begin = file_.path.string() + ": ";
        if (num_others_ > 0) {
            add_warning(result, begin, num_others_,
                        " objects that are not surfaces of the model (such as supports) are passed "
                        "over");
        }
        if (skipped_.lattice) add_warning(result, begin, "beams of lattices are skipped");
        return result;
    }

private:
    struct Part {
        SourceFile source;
        Model3mf model;
    };
    // An object whose components are being placed.
    struct Open {
        const Part* part;
        const Object3mf* object;
        Eigen::Affine3d transform;
        std::size_t next = 0;  // Of its components.
    };

    std::string find_root() const {
        const SourceFile relations = zip_.read("_rels/.rels");
        RelationsParser parser;
        read_xml(relations, parser);
        if (!parser.target.empty()) return part_name(parser.target);
        relations.fail_malformed(
            relations.bytes.size(),
            "no part is called the model; this is not a 3MF file: check its extension");
    }

    const Part& load(const std::string& name) {
        const auto [entry, is_new] = parts_.try_emplace(in_lower_case(name));
        Part& part = entry->second;
        if (is_new) {
            part.source = zip_.read(name);
            ModelParser3mf parser(part.source, skipped_);
            read_xml(part.source, parser);
            part.model = std::move(parser).finish();
        }
        return part;
    }

    // Adds the object's mesh, and opens it if it has components.
    // \param home  the part where the placement stands.
    void place(const Placement3mf& placement, const Part& home, const Eigen::Affine3d& parent) {
        const SourceFile& source = home.source;
        if (++num_placements_ > most_placements) {
            source.fail_malformed(placement.tag, "the model places more than ", most_placements,
                                  " objects; export fewer of them");
        }
        soup_.ticker.tick(16);
        const Part& part = placement.part.empty() ? home : load(part_name(placement.part));
        const auto found = part.model.objects.find(placement.object);
        if (found == part.model.objects.end()) {
            source.fail_damaged(placement.tag, "there is no object with the id ", placement.object);
        }
        const Object3mf& object = found->second;
        if (!object.is_surface) {
            ++num_others_;
            return;
        }
        if (open_objects_.contains(&object)) {
            source.fail_damaged(placement.tag, "object ", in_quotes(object.name),
                                " is a component of itself");
        }
        const Eigen::Affine3d transform = parent * placement.transform;
        add_mesh(part.model, object, transform);
        if (object.components.empty()) return;
        open_objects_.insert(&object);
        open_.push_back({&part, &object, transform});
    }

    void place_components() {
        while (!open_.empty()) {
            Open& last = open_.back();
            if (last.next == last.object->components.size()) {
                open_objects_.erase(last.object);
                open_.pop_back();
                continue;
            }
            const Placement3mf& component = last.object->components[last.next++];
            const Eigen::Affine3d transform = last.transform;  // Opening another moves `last`.
            place(component, *last.part, transform);
        }
    }

    void add_mesh(const Model3mf& model, const Object3mf& object,
                  const Eigen::Affine3d& transform) {
        // Otherwise all numbers stay as they are, -0 too.
        const bool is_moved = transform.matrix() != Eigen::Matrix4d::Identity();
        const std::size_t first = soup_.positions.size();
        if (first + object.vertices.size() >= no_index) {
            throw InvalidInput(joined(
                file_.path.string(),
                ": the objects have more than 2^32 - 2 vertices; split the file into parts"));
        }
        for (const Vec3& p : object.vertices) {
            soup_.ticker.tick(2);
            const Vec3 moved = is_moved ? Vec3(transform * p) : p;
            if (!moved.allFinite()) {
                file_.fail_unusable(0, "a transform moves a vertex of object ",
                                    in_quotes(object.name),
                                    " beyond double precision; correct the transform");
            }
            soup_.positions.push_back(moved);
        }
        const bool is_turned = is_moved && transform.linear().determinant() < 0;
        for (const auto& [a, b, c] : object.triangles) {
            for (const Index v : {a, is_turned ? c : b, is_turned ? b : c}) {
                soup_.add_corner(static_cast<std::int64_t>(first + v), 0);
            }
            soup_.end_polygon();
        }
        if (object.triangles.empty() || !file_.with_attributes) return;
        objects_.add(objects_.number_of(unique_name(object.name, object_names_)),
                     object.triangles.size());
        Index last = no_index;
        std::size_t label = 0;
        for (const Index material : object.materials) {
            soup_.ticker.tick();
            if (material != last) label = label_of(model.materials[material]);
            last = material;
            materials_.add(label, 1);
        }
    }

    // Materials of one name and different colours are different ones.
    std::size_t label_of(const Material3mf& material) {
        const auto [entry, is_new] = material_label_.try_emplace(material, 0);
        if (!is_new) return entry->second;
        const auto& [own_name, color] = material;
        std::string name = own_name.empty() ? color : own_name;
        if (!name.empty()) name = unique_name(name, material_names_);
        if (!color.empty()) colors_[name] = color;
        return entry->second = materials_.number_of(name);
    }

    MeshAttributes finish_attributes() {
        MeshAttributes attributes;
        if (materials_.has_names()) {
            attributes.materials = materials_of_colors(colors_);
            attributes.of_faces.push_back(std::move(materials_).finish("material"));
        }
        if (objects_.num_labels() > 1) {
            attributes.of_faces.push_back(std::move(objects_).finish("object"));
        }
        if (skipped_.texture) {
            attributes.declined.push_back(
                {"properties of triangles",
                 "only materials and colours are carried over, no texture or mixture"});
        }
        if (skipped_.gradients) {
            attributes.declined.push_back(
                {"colours of corners", "a triangle gets that of its first corner"});
        }
        return attributes;
    }

    SourceFile& file_;
    ZipArchive zip_;
    PolygonSoup soup_;
    std::map<std::string, Part> parts_;  // By name in lower case.
    std::vector<Open> open_;
    std::set<const Object3mf*> open_objects_;
    std::size_t num_placements_ = 0, num_others_ = 0;
    Skipped3mf skipped_;
    FaceLabels materials_, objects_;
    std::set<std::string> material_names_, object_names_;
    std::map<Material3mf, std::size_t> material_label_;
    std::map<std::string, std::string> colors_;  // By name.
};

}  // namespace

MeshFile read_3mf(SourceFile file) {
    if (!knows_gzip()) {
        file.fail_malformed(
            0, "this program was built without zlib, which 3MF needs; convert the file to .ply");
    }
    return Reader3mf(file).read();
}

}  // namespace remesh
