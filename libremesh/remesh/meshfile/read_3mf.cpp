// 3MF: the surfaces of all items of the build, each where its transforms put it. Materials and
// objects are labels of the faces. Coordinates are those of the file, whatever its unit, which is
// kept.

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "agvd/core/error.h"
#include "remesh/meshfile/face_labels.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/gltf_materials.h"
#include "remesh/meshfile/gzip.h"
#include "remesh/meshfile/model_3mf.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/xml_reader.h"
#include "remesh/meshfile/zip_archive.h"

namespace remesh {
namespace {

constexpr const char* relations_part = "_rels/.rels";
constexpr std::string_view model_relation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
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
    void end(std::size_t /*at*/, std::size_t /*behind*/) override {}

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
            place({.placement = &item, .part = &part}, Eigen::Affine3d::Identity(), false);
            place_components();
        }
        MeshFile result = std::move(soup_).finish();
        if (file_.with_attributes) attach(finish_attributes(), result);
        result.attributes.unit = part.model.unit;
        add_warnings(result);
        return result;
    }

private:
    struct Part {
        SourceFile source;
        Model3mf model;
    };
    // Where a placement stands.
    struct Place {
        const Placement3mf* placement;
        const Part* part;
    };
    // An object whose components are being placed.
    struct Open {
        const Part* part;
        const Object3mf* object;
        Eigen::Affine3d transform;
        bool is_moved;
        std::size_t next = 0;  // Of its components.
    };

    std::string find_root() const {
        const SourceFile relations = zip_.read(relations_part);
        RelationsParser parser;
        read_xml(relations, parser);
        if (!parser.target.empty()) return part_name(parser.target);
        relations.fail_malformed(relations.bytes.size(),
                                 "no part is called the model; this is no 3MF file: check its "
                                 "extension");
    }

    const Part& load(const std::string& name) {
        std::unique_ptr<Part>& part = parts_[in_lower_case(name)];
        if (part == nullptr) {
            SourceFile source = zip_.read(name);
            Model3mf model = parse_3mf_model(source);
            part = std::make_unique<Part>(Part{std::move(source), std::move(model)});
            has_lattice_ = has_lattice_ || part->model.has_lattice;
            has_texture_ = has_texture_ || part->model.has_texture;
            has_gradients_ = has_gradients_ || part->model.has_gradients;
        }
        return *part;
    }

    // Adds the object's mesh, and opens it if it has components.
    void place(const Place& at, const Eigen::Affine3d& parent, bool is_parent_moved) {
        const Placement3mf& placement = *at.placement;
        const SourceFile& source = at.part->source;
        if (++num_placements_ > most_placements) {
            source.fail_malformed(placement.tag, "the model places more than " +
                                                     std::to_string(most_placements) +
                                                     " objects; export fewer of them");
        }
        soup_.ticker.tick(16);
        const Part& part = placement.part.empty() ? *at.part : load(part_name(placement.part));
        const auto found = part.model.objects.find(placement.object);
        if (found == part.model.objects.end()) {
            source.fail_malformed(placement.tag, "there is no object with the id " +
                                                     std::to_string(placement.object) +
                                                     "; export the file again");
        }
        const Object3mf& object = found->second;
        if (!object.is_surface) {
            ++num_others_;
            return;
        }
        if (open_objects_.contains(&object)) {
            source.fail_malformed(placement.tag, "object " + in_quotes(object.name) +
                                                     " is a component of itself; export the file "
                                                     "again");
        }
        const bool is_moved = placement.is_moved || is_parent_moved;
        const Eigen::Affine3d transform =
            placement.is_moved ? Eigen::Affine3d(parent * placement.transform) : parent;
        add_mesh(part.model, object, transform, is_moved);
        if (object.components.empty()) return;
        open_objects_.insert(&object);
        open_.push_back({&part, &object, transform, is_moved});
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
            place({.placement = &component, .part = last.part}, transform, last.is_moved);
        }
    }

    void add_mesh(const Model3mf& model, const Object3mf& object, const Eigen::Affine3d& transform,
                  bool is_moved) {
        const std::size_t first = soup_.positions.size();
        if (first + object.vertices.size() >= no_index) {
            throw InvalidInput(file_.path.string() +
                               ": the objects have more than 2^32 - 2 vertices; split the "
                               "file into parts");
        }
        for (const Vec3& p : object.vertices) {
            soup_.ticker.tick(2);
            const Vec3 moved = is_moved ? Vec3(transform * p) : p;
            if (!moved.allFinite()) {
                file_.fail_unusable(0, "a transform moves a vertex of object " +
                                           in_quotes(object.name) +
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
            if (material != last) label = label_of(model, material);
            last = material;
            materials_.add(label, 1);
        }
    }

    // Materials of one name and different colours are different ones.
    std::size_t label_of(const Model3mf& model, Index material) {
        const std::pair key(model.names[material], model.colors[material]);
        const auto [entry, is_new] = material_label_.try_emplace(key, 0);
        if (!is_new) return entry->second;
        std::string name = key.first.empty() ? key.second : key.first;
        if (!name.empty()) name = unique_name(name, material_names_);
        if (!key.second.empty()) colors_[name] = key.second;
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
        if (has_texture_) {
            attributes.declined.push_back(
                {"properties of triangles",
                 "only materials and colours are carried over, no texture or mixture"});
        }
        if (has_gradients_) {
            attributes.declined.push_back(
                {"colours of corners", "a triangle gets that of its first corner"});
        }
        return attributes;
    }

    void add_warnings(MeshFile& result) const {
        const std::string begin = file_.path.string() + ": ";
        if (num_others_ > 0) {
            add_warning(begin + std::to_string(num_others_) +
                            " objects that are no surfaces of the model (such as supports) are "
                            "passed over",
                        result);
        }
        if (has_lattice_) add_warning(begin + "beams of lattices are passed over", result);
    }

    SourceFile& file_;
    ZipArchive zip_;
    PolygonSoup soup_;
    std::map<std::string, std::unique_ptr<Part>> parts_;  // By name in lower case.
    std::vector<Open> open_;
    std::set<const Object3mf*> open_objects_;
    std::size_t num_placements_ = 0, num_others_ = 0;
    bool has_lattice_ = false, has_texture_ = false, has_gradients_ = false;
    FaceLabels materials_, objects_;
    std::set<std::string> material_names_, object_names_;
    std::map<std::pair<std::string, std::string>, std::size_t> material_label_;  // By name, colour.
    std::map<std::string, std::string> colors_;                                  // By name.
};

}  // namespace

MeshFile read_3mf(SourceFile file) {
    if (!knows_gzip() || !knows_xml()) {
        file.fail_malformed(0, std::string("this program was built without ") +
                                   (knows_xml() ? "zlib" : "expat") +
                                   ", which 3MF needs; convert the file to .ply");
    }
    return Reader3mf(file).read();
}

}  // namespace remesh
