// A model part of 3MF (format: 3MF Consortium, "3D Manufacturing Format: Core Specification" 1.3,
// "Materials and Properties Extension" 1.2, "Production Extension" 1.1).
#include "remesh/meshfile/model_3mf.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "remesh/meshfile/text_scanner.h"
#include "remesh/meshfile/xml_reader.h"

namespace remesh {
namespace {

constexpr std::string_view core_space = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
constexpr std::string_view material_space =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
constexpr std::string_view production_space =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
constexpr std::string_view xml_blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
    text.remove_prefix(std::min(text.find_first_not_of(xml_blanks), text.size()));
    return text.substr(0, text.find_last_not_of(xml_blanks) + 1);
}

class ModelParser3mf : public XmlVisitor {
public:
    explicit ModelParser3mf(const SourceFile& part) : part_(part) {}

    void declare(std::string_view prefix, std::string_view uri) override {
        spaces_[std::string(prefix)] = uri;
    }

    bool begin(const XmlTag& tag) override {
        const std::size_t depth = depth_++;
        if (depth == 0) {
            read_root(tag);
        } else if (tag.space == core_space) {
            read_core(tag, depth);
        } else if (tag.space == material_space) {
            read_material(tag, depth);
        } else if (tag.name == "beamlattice") {
            model_.has_lattice = true;
        }
        return true;
    }

    void end(std::size_t /*at*/, std::size_t /*behind*/) override {
        --depth_;
        if (depth_ == object_depth_) object_ = nullptr;
        if (depth_ == group_depth_) group_ = nullptr;
    }

    Model3mf finish() && { return std::move(model_); }

private:
    // Materials or colours: these names of the model.
    struct Group {
        std::size_t first = 0, count = 0;
        bool is_color = false;
    };

    [[noreturn]] void fail(const XmlTag& tag, const std::string& text) const {
        part_.fail_malformed(tag.begin, text + "; export the file again");
    }

    void read_root(const XmlTag& tag) {
        if (tag.name != "model" || tag.space != core_space) {
            fail(tag, "the part begins with the element " + in_quotes(tag.name) +
                          ", which is no model of 3MF");
        }
        model_.unit = tag.find("unit").value_or(model_.unit);
        constexpr std::array units = {"micron", "millimeter", "centimeter",
                                      "inch",   "foot",       "meter"};
        if (std::find(units.begin(), units.end(), model_.unit) == units.end()) {
            fail(tag, "the unit " + in_quotes(model_.unit) + " is none of 3MF");
        }
        // Extensions without which the model means something else.
        constexpr std::array known = {
            core_space, material_space, production_space,
            std::string_view("http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07")};
        std::string_view prefixes = tag.find("requiredextensions").value_or("");
        while (!(prefixes = trimmed(prefixes)).empty()) {
            const std::size_t size = std::min(prefixes.find_first_of(xml_blanks), prefixes.size());
            const std::string prefix(prefixes.substr(0, size));
            const auto found = spaces_.find(prefix);
            const std::string uri = found == spaces_.end() ? prefix : found->second;
            if (std::find(known.begin(), known.end(), uri) == known.end()) {
                part_.fail_malformed(tag.begin, "the model needs the extension '" + uri +
                                                    "', which is not supported; export it without");
            }
            prefixes.remove_prefix(size);
        }
    }

    void read_core(const XmlTag& tag, std::size_t depth) {
        if (tag.name == "vertex") {
            read_vertex(tag);
        } else if (tag.name == "triangle") {
            read_triangle(tag);
        } else if (tag.name == "object") {
            read_object(tag, depth);
        } else if (tag.name == "component") {
            open_object(tag).components.push_back(placement(tag));
        } else if (tag.name == "item") {
            model_.items.push_back(placement(tag));
        } else if (tag.name == "basematerials") {
            open_group(tag, depth, false);
        } else if (tag.name == "base") {
            add_material(tag, "name", "displaycolor");
        }
    }

    void read_material(const XmlTag& tag, std::size_t depth) {
        if (tag.name == "colorgroup") {
            open_group(tag, depth, true);
        } else if (tag.name == "color") {
            add_material(tag, "color", "color");
        }
    }

    void read_object(const XmlTag& tag, std::size_t depth) {
        if (object_ != nullptr) fail(tag, "there is an object inside of another");
        const std::uint64_t id = required_number(tag, "id");
        const auto [entry, is_new] = model_.objects.try_emplace(id);
        if (!is_new) fail(tag, "there are two objects with the id " + std::to_string(id));
        object_ = &entry->second;
        object_depth_ = depth;
        const std::string_view type = tag.find("type").value_or("model");
        object_->is_surface = type == "model" || type == "surface";
        object_->name = tag.find("name").value_or("");
        if (object_->name.empty()) object_->name = "object_" + std::to_string(id);
        object_group_ = number(tag, "pid");
        object_property_ = number(tag, "pindex");
    }

    Object3mf& open_object(const XmlTag& tag) const {
        if (object_ == nullptr)
            fail(tag, "the element " + in_quotes(tag.name) + " is in no object");
        return *object_;
    }

    void read_vertex(const XmlTag& tag) {
        Object3mf& object = open_object(tag);
        Vec3 p;
        constexpr std::array names = {"x", "y", "z"};
        for (int k = 0; k < 3; ++k) p[k] = coordinate(tag, names[static_cast<std::size_t>(k)]);
        if (!p.allFinite()) {
            part_.fail_unusable(tag.begin, "vertex " + std::to_string(object.vertices.size()) +
                                               " of object " + in_quotes(object.name) +
                                               " has a coordinate that is not finite; correct or "
                                               "delete the vertex");
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
                part_.fail_unusable(tag.begin, "a triangle of object " + in_quotes(object.name) +
                                                   " names vertex " + std::to_string(vertex) +
                                                   ", but the object has only " +
                                                   std::to_string(object.vertices.size()) +
                                                   " vertices, counted from 0; correct the "
                                                   "triangle, or export the file again");
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
            model_.has_texture = true;
            return 0;
        }
        const Group& names = found->second;
        if (*property >= names.count) {
            fail(tag, "a triangle has property " + std::to_string(*property) + " of group " +
                          std::to_string(*group) + ", which has only " +
                          std::to_string(names.count));
        }
        for (const char* other : {"p2", "p3"}) {
            if (names.is_color && number(tag, other).value_or(*property) != *property) {
                model_.has_gradients = true;
            }
        }
        return static_cast<Index>(names.first + *property);
    }

    void open_group(const XmlTag& tag, std::size_t depth, bool is_color) {
        group_ = &groups_[required_number(tag, "id")];
        group_depth_ = depth;
        *group_ = {.first = model_.names.size(), .count = 0, .is_color = is_color};
    }

    void add_material(const XmlTag& tag, const char* name, const char* color) {
        if (group_ == nullptr) return;
        ++group_->count;
        model_.names.emplace_back(tag.find(name).value_or(""));
        model_.colors.emplace_back(tag.find(color).value_or(""));
    }

    [[nodiscard]] Placement3mf placement(const XmlTag& tag) const {
        Placement3mf result{
            .part = std::string(trimmed(tag.find("path", production_space).value_or(""))),
            .object = required_number(tag, "objectid"),
            .tag = tag.begin};
        const auto text = tag.find("transform");
        if (!text) return result;
        result.is_moved = true;
        // Rows of four by three: the last one is the translation.
        std::string_view left = *text;
        for (int i = 0; i < 12; ++i) {
            left = trimmed(left);
            const std::size_t size = std::min(left.find_first_of(xml_blanks), left.size());
            const auto value = as_number(left.substr(0, size));
            if (!value || !std::isfinite(*value)) break;
            result.transform.matrix()(i % 3, i / 3) = *value;
            left.remove_prefix(size);
            if (i == 11 && trimmed(left).empty()) return result;
        }
        fail(tag, "the transform " + in_quotes(*text) + " has not twelve finite numbers");
    }

    [[nodiscard]] std::optional<std::uint64_t> number(const XmlTag& tag, const char* name) const {
        const auto found = tag.find(name);
        if (!found) return std::nullopt;
        const std::string_view text = trimmed(*found);
        std::uint64_t value = 0;
        const char* const end = text.data() + text.size();
        const auto [last, error] = std::from_chars(text.data(), end, value);
        if (error == std::errc{} && last == end) return value;
        fail(tag, std::string(name) + " of " + in_quotes(tag.name) + " is " + in_quotes(text) +
                      " and no whole number from 0");
    }

    [[nodiscard]] std::uint64_t required_number(const XmlTag& tag, const char* name) const {
        const auto value = number(tag, name);
        if (!value) fail(tag, "the element " + in_quotes(tag.name) + " has no " + name);
        return *value;
    }

    [[nodiscard]] double coordinate(const XmlTag& tag, const char* name) const {
        const std::string_view text = trimmed(tag.find(name).value_or(""));
        const auto value = as_number(text);
        if (!value) {
            fail(tag, std::string(name) + " of a vertex is " + in_quotes(text) + " and no number");
        }
        return *value;
    }

    static constexpr std::size_t no_depth = SIZE_MAX;

    const SourceFile& part_;
    Model3mf model_;
    std::map<std::string, std::string> spaces_;  // By prefix.
    std::map<std::uint64_t, Group> groups_;      // By id.
    std::size_t depth_ = 0;
    Object3mf* object_ = nullptr;  // That is open.
    Group* group_ = nullptr;
    std::size_t object_depth_ = no_depth, group_depth_ = no_depth;
    std::optional<std::uint64_t> object_group_, object_property_;
};

}  // namespace

Model3mf parse_3mf_model(const SourceFile& part) {
    ModelParser3mf parser(part);
    read_xml(part, parser);
    return std::move(parser).finish();
}

}  // namespace remesh
