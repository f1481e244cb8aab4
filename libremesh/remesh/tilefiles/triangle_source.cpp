#include "remesh/tilefiles/triangle_source.h"

#include <optional>

#include "remesh/meshfile/ply_values.h"
#include "remesh/tilefiles/mapped_file.h"

namespace remesh {
namespace {

constexpr std::size_t most_header = 1 << 20;
constexpr std::size_t stl_header = 84, stl_record = 50;  // Bytes; the record begins with a normal.

}  // namespace

struct TriangleSource::File {
    explicit File(const std::filesystem::path& name) : path(name), map(name) {
        if (map.size() >= 3 && std::string_view(map.begin(), 3) == "ply") {
            open_ply();
        } else {
            open_stl();
        }
        at = first_face;
    }

    void open_ply() {
        SourceFile head{.path = path,
                        .bytes = std::string(map.begin(), std::min(map.size(), most_header))};
        const PlyHeader header = read_ply_header(head);
        if (!header.byte_order) {
            head.fail_malformed(0,
                                "the file is ascii; tiles are cut from binary files: convert it");
        }
        order = *header.byte_order;
        std::size_t offset = header.size;
        for (const PlyElement& element : header.elements) {
            if (element.name == "face") {
                faces = element;
                corners = &require_corners(faces, head);
                break;
            }
            std::size_t stride = 0;
            for (const PlyProperty& property : element.properties) {
                if (property.size_type) {
                    head.fail_malformed(0, "element ", element.name,
                                        " has a list; write the vertices without lists");
                }
                if (element.name == "vertex") {
                    for (int k = 0; k < 3; ++k) {
                        if (property.name.size() == 1 && property.name[0] == "xyz"[k]) {
                            coordinates[k] = {stride, property.type};
                        }
                    }
                }
                stride += size_of(property.type);
            }
            if (element.name == "vertex") {
                first_vertex = offset;
                vertex_size = stride;
                num_vertices = element.count;
            }
            if (stride > 0 && element.count > (map.size() - offset) / stride) fail_truncated();
            offset += element.count * stride;
        }
        if (corners == nullptr || vertex_size == 0 || !coordinates[0] || !coordinates[1] ||
            !coordinates[2]) {
            head.fail_malformed(
                0, "it has no vertices with x, y, z before its faces; export it again");
        }
        num_faces = faces.count;
        first_face = offset;
    }

    void open_stl() {
        if (map.size() < stl_header) fail_format();
        num_faces = load<std::uint32_t>(map.begin() + 80);
        if ((map.size() - stl_header) / stl_record != num_faces) fail_format();
        first_face = stl_header;
    }

    [[noreturn]] void fail_format() const {
        throw IoError(joined(path.string(),
                             ": is neither binary PLY nor binary STL; convert it, for example by "
                             "python3 -c \"import remesh; remesh.write('out.ply', remesh.read('",
                             path.string(), "'))\""));
    }
    [[noreturn]] void fail_truncated() const {
        throw IoError(joined(path.string(), ": the file is truncated; export it again"));
    }
    [[noreturn]] void fail_face(const char* what) const {
        throw InvalidInput(joined(path.string(), ": face ", next_face, " ", what));
    }

    // The next bytes.
    const char* take(std::size_t size) {
        if (map.size() - at < size) fail_truncated();
        at += size;
        return map.begin() + at - size;
    }

    std::int64_t take_integer(PlyType type) {
        return with_type(type, [&]<typename Stored>(Stored) {
            return static_cast<std::int64_t>(load<Stored>(take(sizeof(Stored)), order));
        });
    }

    [[nodiscard]] Vec3 vertex(std::int64_t index) const {
        if (index < 0 || static_cast<std::uint64_t>(index) >= num_vertices) {
            fail_face("has a vertex that the file does not have; export it again");
        }
        const char* const start =
            map.begin() + first_vertex + static_cast<std::size_t>(index) * vertex_size;
        Vec3 position;
        for (int k = 0; k < 3; ++k) {
            position[k] = load_number(start + coordinates[k]->offset, coordinates[k]->type, order);
        }
        return position;
    }

    void read_face(std::array<Vec3, 3>& triangle) {
        if (corners == nullptr) {
            const char* const record = take(stl_record);
            for (std::size_t k = 0; k < 3; ++k) {
                for (int d = 0; d < 3; ++d) {
                    triangle[k][d] = load<float>(record + 12 * (k + 1) + 4 * d);
                }
            }
        } else {
            for (const PlyProperty& property : faces.properties) {
                const std::int64_t length =
                    property.size_type ? take_integer(*property.size_type) : 1;
                if (&property != corners) {
                    if (length < 0) fail_face("has a list of negative length; export it again");
                    (void)take(static_cast<std::size_t>(length) * size_of(property.type));
                    continue;
                }
                if (length != 3) fail_face("is no triangle; divide all faces into triangles");
                for (Vec3& corner : triangle) corner = vertex(take_integer(property.type));
            }
        }
        for (const Vec3& corner : triangle) {
            if (!corner.allFinite()) {
                fail_face("has a coordinate that is not finite; correct or delete it");
            }
        }
    }

    struct Coordinate {
        std::size_t offset;
        PlyType type;
    };

    std::filesystem::path path;
    MappedFile map;
    std::endian order = std::endian::little;
    PlyElement faces;                      // Of a PLY.
    const PlyProperty* corners = nullptr;  // Of `faces`; null: an STL.
    std::array<std::optional<Coordinate>, 3> coordinates;
    std::size_t first_vertex = 0, vertex_size = 0, first_face = 0;
    std::uint64_t num_vertices = 0, num_faces = 0;
    std::size_t at = 0;
    std::uint64_t next_face = 0;
};

TriangleSource::TriangleSource(const std::filesystem::path& path)
    : file_(std::make_unique<File>(path)) {}

TriangleSource::~TriangleSource() = default;

std::uint64_t TriangleSource::num_faces() const { return file_->num_faces; }

std::uint64_t TriangleSource::num_bytes() const { return file_->map.size(); }

void TriangleSource::rewind() {
    file_->at = file_->first_face;
    file_->next_face = 0;
}

bool TriangleSource::next(std::array<Vec3, 3>& corners) {
    if (file_->next_face == file_->num_faces) return false;
    file_->read_face(corners);
    ++file_->next_face;
    return true;
}

}  // namespace remesh
