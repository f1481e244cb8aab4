// PLY, ascii and both binaries: the coordinates of element "vertex", the corners of element "face";
// every other property and element is passed over (format: Greg Turk, "The PLY Polygon File
// Format", 1994).

#include <algorithm>
#include <array>
#include <utility>

#include "remesh/io/byte_order.h"
#include "remesh/io/formats.h"
#include "remesh/io/ply_header.h"
#include "remesh/io/polygon_soup.h"
#include "remesh/io/text_scanner.h"

namespace remesh {
namespace {

std::string name_of(const PlyElement& element, std::uint64_t index) {
    return element.name + " " + std::to_string(index) + " of " + std::to_string(element.count);
}

// The two encodings offer the same: begin, values one after the other, end; so the readers of
// elements below are written once.
class AsciiValues {
public:
    AsciiValues(const SourceFile& file, const PlyHeader& header) : scan_(file, header.size, {}) {}

    void begin(const PlyElement& element, std::uint64_t index) {
        if (scan_.find_word()) return;
        scan_.fail_malformed("the file ends before " + name_of(element, index) +
                             "; it is truncated: export it again");
    }
    double real(PlyType) { return scan_.number("a number"); }
    std::int64_t integer(PlyType) { return scan_.integer("a whole number"); }
    void skip(PlyType, std::int64_t count) {
        for (; count > 0; --count) {
            if (scan_.word().empty()) scan_.fail_expecting("a number");
        }
    }
    void end() {
        if (scan_.has_word()) {
            scan_.fail_malformed(
                "more values on the line than the header announces; write one "
                "element on each line");
        }
    }
    [[nodiscard]] std::size_t offset() const { return scan_.offset(); }

private:
    TextScanner scan_;
};

class BinaryValues {
public:
    BinaryValues(const SourceFile& file, const PlyHeader& header)
        : file_(file), at_(header.size), order_(*header.byte_order) {}

    void begin(const PlyElement& element, std::uint64_t index) {
        element_ = &element;
        index_ = index;
    }
    double real(PlyType type) { return next<double>(type); }
    std::int64_t integer(PlyType type) { return next<std::int64_t>(type); }
    void skip(PlyType type, std::int64_t count) {
        constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
        // A length has 32 bits at most: the product cannot overflow.
        take(sizes[static_cast<std::size_t>(type)] * static_cast<std::size_t>(count));
    }
    void end() {}
    [[nodiscard]] std::size_t offset() const { return at_; }

private:
    const char* take(std::size_t size) {
        if (file_.bytes.size() - at_ < size) {
            file_.fail_malformed(file_.bytes.size(), "the file ends within " +
                                                         name_of(*element_, index_) +
                                                         "; it is truncated: export it again");
        }
        at_ += size;
        return file_.bytes.data() + at_ - size;
    }

    template <typename Result>
    Result next(PlyType type) {
        const auto get = [&]<typename Stored>(Stored) {
            return static_cast<Result>(load<Stored>(take(sizeof(Stored)), order_));
        };
        switch (type) {
            case PlyType::Int8:
                return get(std::int8_t{});
            case PlyType::UInt8:
                return get(std::uint8_t{});
            case PlyType::Int16:
                return get(std::int16_t{});
            case PlyType::UInt16:
                return get(std::uint16_t{});
            case PlyType::Int32:
                return get(std::int32_t{});
            case PlyType::UInt32:
                return get(std::uint32_t{});
            case PlyType::Float32:
                return get(float{});
            case PlyType::Float64:
                break;
        }
        return get(double{});
    }

    const SourceFile& file_;
    std::size_t at_;
    std::endian order_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};

template <typename Values>
std::int64_t read_length(Values& values, const PlyProperty& list, const SourceFile& file) {
    const std::size_t start = values.offset();
    const std::int64_t length = values.integer(*list.size_type);
    if (length < 0) file.fail_malformed(start, "a list of negative length; export the mesh again");
    return length;
}

template <typename Values>
void skip_property(Values& values, const PlyProperty& property, const SourceFile& file) {
    values.skip(property.type, property.size_type ? read_length(values, property, file) : 1);
}

template <typename Values>
void read_vertices(Values& values, const PlyElement& element, const SourceFile& file,
                   PolygonSoup& soup) {
    const std::array axes = {element.find("x"), element.find("y"), element.find("z")};
    for (const PlyProperty* axis : axes) {
        if (axis == nullptr || axis->size_type) {
            file.fail_malformed(
                0, "element vertex needs the numbers x, y and z; export the mesh again");
        }
    }
    for (std::uint64_t v = 0; v < element.count; ++v) {
        values.begin(element, v);
        const std::size_t start = values.offset();
        agvd::Vec3 p;
        for (const PlyProperty& property : element.properties) {
            const auto axis = std::find(axes.begin(), axes.end(), &property) - axes.begin();
            if (axis < 3) {
                p[axis] = values.real(property.type);
            } else {
                skip_property(values, property, file);
            }
        }
        if (!p.allFinite()) {
            file.fail_unusable(start, name_of(element, v) +
                                          " has a coordinate that is not finite (NaN or infinite); "
                                          "repair or remove it");
        }
        values.end();
        soup.positions.push_back(p);
    }
}

template <typename Values>
void read_faces(Values& values, const PlyElement& element, const SourceFile& file,
                PolygonSoup& soup) {
    const PlyProperty* corners = element.find("vertex_indices");
    if (corners == nullptr) corners = element.find("vertex_index");
    if (corners == nullptr || !corners->size_type || corners->type == PlyType::Float32 ||
        corners->type == PlyType::Float64) {
        file.fail_malformed(0,
                            "element face needs a list of whole numbers named vertex_indices; "
                            "export the mesh again");
    }
    for (std::uint64_t f = 0; f < element.count; ++f) {
        values.begin(element, f);
        for (const PlyProperty& property : element.properties) {
            if (&property != corners) {
                skip_property(values, property, file);
                continue;
            }
            for (std::int64_t k = read_length(values, property, file); k > 0; --k) {
                const std::size_t start = values.offset();
                soup.add_corner(values.integer(property.type), start);
            }
            soup.end_polygon();
        }
        values.end();
    }
}

template <typename Values>
MeshFile read_body(Values values, const PlyHeader& header, const SourceFile& file) {
    PolygonSoup soup(file, 0);
    bool has_vertices = false, has_faces = false;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex" && !std::exchange(has_vertices, true)) {
            soup.reserve(element.count, 0);
            read_vertices(values, element, file, soup);
        } else if (element.name == "face" && !std::exchange(has_faces, true)) {
            soup.reserve(0, element.count);
            read_faces(values, element, file, soup);
        } else if (element.name == "tristrips") {
            file.fail_malformed(0,
                                "triangle strips are not supported; export the mesh with a list of "
                                "faces");
        } else if (!element.properties.empty()) {
            for (std::uint64_t i = 0; i < element.count; ++i) {
                values.begin(element, i);
                for (const PlyProperty& p : element.properties) skip_property(values, p, file);
                values.end();
            }
        }
    }
    return std::move(soup).finish();
}

}  // namespace

MeshFile read_ply(SourceFile file) {
    const PlyHeader header = read_ply_header(file);
    if (!header.byte_order) return read_body(AsciiValues(file, header), header, file);
    file.is_binary = true;
    return read_body(BinaryValues(file, header), header, file);
}

std::string format_ply(const agvd::MeshView& mesh) {
    // "int" is what every reader knows; it does for all but the largest meshes.
    const char* const index_type = mesh.positions.size() <= INT32_MAX ? "int" : "uint";
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                        std::to_string(mesh.positions.size()) +
                        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                        std::to_string(mesh.triangles.size()) + "\nproperty list uchar " +
                        index_type + " vertex_indices\nend_header\n";
    for (const agvd::Vec3& p : mesh.positions) {
        for (const double x : p) append(bytes, x);
    }
    for (const agvd::Triangle& triangle : mesh.triangles) {
        append(bytes, std::uint8_t{3});
        for (const agvd::Index v : triangle) append(bytes, v);
    }
    return bytes;
}

}  // namespace remesh
