// How far positions move where a format stores them in single precision, as STL does. Coordinates
// far from the origin, such as those of maps, lose the digits that tell their vertices apart.
#include "remesh/meshfile/mesh_file.h"

#include <algorithm>

#include "agvd/mesh/scale.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/point_welder.h"

namespace remesh {
namespace {

template <typename... Parts>
[[noreturn]] void refuse(const std::filesystem::path& path, Parts... parts) {
    throw InvalidInput(joined(path.string(), ": cannot be written: ", parts...));
}

void check(const std::filesystem::path& path, const MeshFormat& format, const MeshView& mesh) {
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (!mesh.positions[v].allFinite()) {
            refuse(path, "vertex ", v,
                   " has a coordinate that is not finite; correct or delete the vertex");
        }
        if ((mesh.positions[v].array().abs() > format.largest).any()) {
            refuse(
                path, "vertex ", v,
                " is too large for single precision, in which this format stores it; write .ply, "
                ".obj or .off");
        }
    }
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const Index highest = std::ranges::max(mesh.triangles[f]);
        if (highest < mesh.positions.size()) continue;
        refuse(path, "face ", f, " names vertex ", index_text(highest), ", but the mesh has only ",
               mesh.positions.size(), " vertices, counted from 0; correct or delete the face");
    }
}

void check(const std::filesystem::path& path, const std::vector<Attribute>& attributes,
           std::size_t count) {
    for (const Attribute& attribute : attributes) {
        if (attribute.values.size() != count) {
            refuse(path, "attribute ", attribute.name, " has ", attribute.values.size(),
                   " values instead of ", count, "; give one for each element");
        }
        const auto num_names = static_cast<double>(attribute.names.size());
        const auto has_name = [&](double value) { return value >= 0 && value < num_names; };
        if (num_names > 0 && !std::ranges::all_of(attribute.values, has_name)) {
            refuse(path, "attribute ", attribute.name, " has a value without a name; add the name");
        }
    }
}

// Names and types.
std::vector<Attribute> without_values(const std::vector<Attribute>& attributes) {
    std::vector<Attribute> empty;
    empty.reserve(attributes.size());
    for (const Attribute& one : attributes) empty.push_back({.name = one.name, .type = one.type});
    return empty;
}

constexpr double share_of_edge = 0.05;
constexpr double share_of_diagonal = 1e-6;

// Number by number and not in line: otherwise g++ 12 drops both conversions at -O3.
[[gnu::noinline]] Vec3 rounded(const Vec3& p) {
    Vec3 q;
    for (int k = 0; k < 3; ++k) q[k] = static_cast<float>(p[k]);
    return q;
}

void measure_shifts(const MeshView& mesh, Ticker& ticker, RoundingLoss& loss) {
    MeshBox box;
    PointWelder before, after;
    for (const Vec3& p : mesh.positions) {
        ticker.tick(4);
        const Vec3 q = rounded(p);
        loss.largest_shift = std::max(loss.largest_shift, (q - p).norm());
        box.add(p);
        before.index_of(p);
        after.index_of(q);
    }
    loss.diagonal = (box.high - box.low).norm();
    loss.middle = box.low + (box.high - box.low) / 2;
    loss.merged = static_cast<Index>(before.points().size() - after.points().size());
}

double shortest_edge(const MeshView& mesh, Ticker& ticker) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const Triangle& triangle : mesh.triangles) {
        ticker.tick();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& p = mesh.positions[triangle[k]];
            const double length = (mesh.positions[triangle[(k + 1) % 3]] - p).norm();
            if (length > 0) shortest = std::min(shortest, length);
        }
    }
    return shortest < std::numeric_limits<double>::infinity() ? shortest : 0;
}

std::string short_number(double value) { return number_text(value, 3); }

}  // namespace

std::string format_mesh(const MeshPath& path, const MeshView& mesh,
                        const MeshAttributes& attributes, const Progress& progress) {
    Poller poller(progress);
    const MeshFormat& format = require_format(path);
    check(path.path, format, mesh);
    check(path.path, attributes.of_vertices, mesh.positions.size());
    check(path.path, attributes.of_faces, mesh.triangles.size());
    if (const TextureCoordinates& texture = attributes.texture;
        !texture.empty() && texture.corners.size() != mesh.triangles.size()) {
        refuse(path.path, "there are texture coordinates for ", texture.corners.size(),
               " faces instead of ", mesh.triangles.size(), "; give three for each");
    }
    std::string bytes = format.format(mesh, attributes, Ticker(poller));
    return is_compressed(path) ? pack_gzip(bytes, Ticker(poller)) : bytes;
}

std::vector<std::string> remove_unwritable(const MeshPath& path, MeshAttributes& attributes) {
    const MeshFormat& format = require_format(path);
    if (!format.has_normals) attributes.normals.reset();
    const MeshAttributes all{.of_vertices = without_values(attributes.of_vertices),
                             .of_faces = without_values(attributes.of_faces)};
    std::vector<std::string> removed;
    const auto keep_writable = [&](std::vector<Attribute>& some, ElementKind kind) {
        std::erase_if(some, [&](const Attribute& attribute) {
            if (format.holds(attribute, kind, all)) return false;
            removed.push_back((kind == ElementKind::Vertex ? "vertex " : "face ") + attribute.name);
            return true;
        });
    };
    keep_writable(attributes.of_vertices, ElementKind::Vertex);
    keep_writable(attributes.of_faces, ElementKind::Face);
    TextureCoordinates& texture = attributes.texture;
    const bool holds_texture = format.texture == TexturePlace::Corners ||
                               (format.texture == TexturePlace::Vertices && texture.seams.empty());
    if (!texture.empty() && !holds_texture) {
        removed.push_back(std::string("corner ") + TextureCoordinates::name);
        texture = {};
    }
    Materials& materials = attributes.materials;
    if (!materials.empty() && format.materials == MaterialPlace::Nothing) {
        removed.emplace_back("material colours and images");
        materials = {};
    } else if (!materials.images.empty() && format.materials == MaterialPlace::Colors) {
        removed.emplace_back("material images");
        materials.images.clear();
    }
    return removed;
}

std::string describe_unit(const MeshPath& path, const std::string& unit) {
    const MeshFormat& format = require_format(path);
    const std::string of_format = format.unit == nullptr ? "" : format.unit;
    const bool is_common = unit == "meter" || unit == "millimeter";
    if (unit.empty() ||
        (format.unit == nullptr ? is_common : of_format.empty() || unit == of_format))
        return {};
    return "the unit of the input is the " + unit + ", ." + format.name + " files " +
           (of_format.empty() ? "have none" : "count in " + of_format + "s") +
           ": numbers stay as they are; scale the mesh where it is used, or write .3mf, which "
           "keeps "
           "the unit";
}

void write_mesh(const std::filesystem::path& path, const MeshView& mesh, const Progress& progress) {
    write_file_atomically(path, format_mesh(path, mesh, {}, progress), progress);
}

bool is_known_mesh_format(const MeshPath& path) { return find_format(path) != nullptr; }

std::string mesh_format(const MeshPath& path) { return require_format(path).name; }

bool RoundingLoss::matters() const {
    return merged > 0 || largest_shift > share_of_edge * shortest_edge ||
           largest_shift > share_of_diagonal * diagonal;
}

RoundingLoss rounding_loss(const MeshPath& path, const MeshView& mesh, const Progress& progress) {
    RoundingLoss loss;
    if (!require_format(path).is_single() || mesh.positions.empty()) return loss;
    Poller poller(progress);
    Ticker ticker(poller);
    measure_shifts(mesh, ticker, loss);
    loss.shortest_edge = shortest_edge(mesh, ticker);
    return loss;
}

std::string describe(const RoundingLoss& loss, const MeshPath& path) {
    if (loss.largest_shift == 0 || !loss.matters()) return {};
    const auto percent_of = [&](double length) {
        return short_number(100 * loss.largest_shift / length) + " %";
    };
    std::string text = path.path.string() + ": " + require_format(path).name +
                       " stores coordinates in single precision: vertices move by up to " +
                       short_number(loss.largest_shift) + ", " + percent_of(loss.diagonal) +
                       " of the diagonal";
    if (loss.shortest_edge > 0) {
        text += " and " + percent_of(loss.shortest_edge) + " of the shortest edge";
    }
    if (loss.merged > 0) text += ", and " + std::to_string(loss.merged) + " fall onto others";
    return text +
           "; write .ply, .obj or .off, or move the mesh to the origin first (its middle is at " +
           place_text(loss.middle, loss.diagonal) + ")";
}

}  // namespace remesh
