// STL, ascii and binary. The format has no shared vertices: corners at exactly equal positions
// become one. Normals and attributes are skipped (format: 3D Systems, StereoLithography Interface
// Specification, 1989). The names of several solids are labels of faces, "solid"; written with
// these, the file is ascii.

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "agvd/core/groups.h"
#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/point_welder.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

constexpr std::size_t header_size = 84;  // 80 free bytes and the count.
constexpr std::size_t record_size = 50;  // Normal, three corners, two bytes of attributes.

constexpr const char* solid_label = "solid";

bool equals_keyword(std::string_view word, std::string_view keyword) {
    return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                      [](char a, char b) { return a == b || (a | 0x20) == b; });
}

// Many binary files begin with "solid", so the size decides. If it does not fit, the file is
// damaged, and a zero byte marks it as binary.
bool is_binary(const std::string& bytes) {
    if (bytes.size() >= header_size &&
        bytes.size() - header_size == record_size * load<std::uint32_t>(&bytes[80])) {
        return true;
    }
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    const std::size_t mark = bytes.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : first;  // Of UTF-8.
    const std::string_view begin = std::string_view(bytes).substr(mark, 5);
    return (!equals_keyword(begin, "solid") && !begin.starts_with('#')) ||
           bytes.find('\0') != std::string::npos;
}

MeshFile finish(PolygonSoup soup, PointWelder welder, std::size_t num_corners) {
    soup.positions = std::move(welder.points());
    const std::size_t welded = num_corners - soup.positions.size();
    MeshFile result = std::move(soup).finish();
    result.welded_vertices = static_cast<Index>(welded);
    return result;
}

// Some programs never fill the count in. \return a warning; empty: the count stands.
std::string judge_count(const SourceFile& file, std::uint64_t announced, std::uint64_t held) {
    const bool is_whole = (file.bytes.size() - header_size) % record_size == 0;
    if (announced > 0 || held == 0 || !is_whole) return {};
    const std::string text =
        "the header announces 0 triangles, the file holds " + std::to_string(held);
    if (!file.is_lenient) {
        file.fail_malformed(80, text,
                            "; export the file again, or read those that it holds (remesh and agvd "
                            "diagram: --lenient)");
    }
    return file.place(80) + text + ", which are read";
}

MeshFile read_binary(const SourceFile& file) {
    const std::string& bytes = file.bytes;
    if (bytes.size() < header_size) {
        file.fail_damaged(bytes.size(),
                          "the file is too short for STL (a binary file has a header of 84 bytes, "
                          "an ascii file begins with 'solid')");
    }
    const std::uint64_t announced = load<std::uint32_t>(&bytes[80]);
    const std::uint64_t held = (bytes.size() - header_size) / record_size;
    if (held < announced) {
        file.fail_malformed(bytes.size(), "the file ends after ", held, " of ", announced,
                            " triangles; it is truncated: export the file again");
    }
    const std::string warning = judge_count(file, announced, held);
    const std::uint64_t count = warning.empty() ? announced : held;
    PolygonSoup soup(file, 0);
    soup.reserve(0, count);
    PointWelder welder;
    for (std::uint64_t f = 0; f < count; ++f) {
        for (std::size_t k = 1; k <= 3; ++k) {
            const std::size_t offset = header_size + f * record_size + 12 * k;
            const char* const corner = &bytes[offset];
            const Vec3 p(load<float>(corner), load<float>(corner + 4), load<float>(corner + 8));
            if (!p.allFinite()) {
                file.fail_unusable(
                    offset, "triangle ", f,
                    " has a coordinate that is not finite; correct or delete the triangle");
            }
            soup.add_corner(welder.index_of(p), offset);
        }
        soup.end_polygon();
    }
    const std::size_t end = header_size + count * record_size;
    MeshFile result = finish(std::move(soup), std::move(welder), 3 * count);
    add_warning(result, warning);
    add_warning(result, file.judge_rest(end, "triangles", count, held - count));
    return result;
}

// Goes to the next word, on whatever line: facets and loops need no lines of their own. Lines that
// begin with # are comments. \return false at the end of the file.
bool find_next(TextScanner& scan) {
    while (scan.find_word()) {
        if (!scan.take("#")) return true;
        scan.skip_line();
    }
    return false;
}

void find_keyword(TextScanner& scan) {
    if (find_next(scan)) return;
    scan.fail_malformed(
        "the file ends without 'endsolid'; it is truncated: export the file again, or add that "
        "line if nothing is missing");
}

void expect(TextScanner& scan, const SourceFile& file, const char* keyword) {
    find_keyword(scan);
    const std::size_t start = scan.offset();
    const std::string_view word = scan.word();
    if (equals_keyword(word, keyword)) return;
    file.fail_malformed(start, "expected '", keyword, "', found ", in_quotes(word),
                        "; correct the line, or export the file again");
}

// Passes over words that some programs write behind a keyword, up to the next keyword on the line.
void skip_words(TextScanner& scan, std::initializer_list<std::string_view> keywords) {
    while (scan.has_word()) {
        const std::size_t start = scan.offset();
        const std::string_view word = scan.word();
        if (std::ranges::none_of(keywords, [&](auto k) { return equals_keyword(word, k); }))
            continue;
        return scan.go_to(start);
    }
}

// The loop of a facet whose first word has been read; returns its corners.
std::vector<Vec3> read_facet(TextScanner& scan, const SourceFile& file) {
    expect(scan, file, "normal");
    for (int k = 0; k < 3; ++k) {
        find_keyword(scan);
        scan.word();  // Often NaN, and recomputed anyway.
    }
    expect(scan, file, "outer");
    expect(scan, file, "loop");
    std::vector<Vec3> corners;
    while (true) {
        find_keyword(scan);
        if (scan.take("endloop") || scan.take("ENDLOOP")) break;
        expect(scan, file, "vertex");
        corners.push_back(scan.point());
    }
    skip_words(scan, {"endfacet"});
    expect(scan, file, "endfacet");
    skip_words(scan, {"facet", "endsolid"});
    return corners;
}

MeshFile read_ascii(const SourceFile& file) {
    TextScanner scan(file, 0, {});
    PolygonSoup soup(file, 0);
    PointWelder welder;
    std::size_t num_corners = 0, num_solids = 0;
    FaceLabels names;
    while (find_next(scan)) {
        expect(scan, file, "solid");
        const std::size_t name = names.number_of(one_line(scan.words()));
        ++num_solids;
        find_keyword(scan);
        while (!scan.take("endsolid") && !scan.take("ENDSOLID")) {
            const std::size_t start = scan.offset();
            expect(scan, file, "facet");
            for (const Vec3& p : read_facet(scan, file)) {
                soup.add_corner(welder.index_of(p), start);
                ++num_corners;
            }
            soup.end_polygon();
            find_keyword(scan);
        }
        scan.skip_line();
        names.extend(name, soup.num_polygons());
    }
    MeshFile result = finish(std::move(soup), std::move(welder), num_corners);
    if (!file.with_attributes || num_solids < 2 || !names.has_names()) return result;
    MeshAttributes attributes;
    attributes.of_faces.push_back(std::move(names).finish(solid_label));
    attach(std::move(attributes), result);
    return result;
}

}  // namespace

MeshFile read_stl(SourceFile file) {
    const std::size_t first = std::min(file.bytes.find_first_not_of(" \t\r\n"), file.bytes.size());
    for (const char* const page : {"<!doctype html", "<html"}) {
        if (equals_keyword(std::string_view(file.bytes).substr(first, std::strlen(page)), page)) {
            file.fail_damaged(0, "the file is an HTML page, not STL; download the mesh itself");
        }
    }
    file.is_binary = is_binary(file.bytes);
    return file.is_binary ? read_binary(file) : read_ascii(file);
}

bool stl_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes&) {
    return kind == ElementKind::Face && attribute.name == solid_label && !attribute.names.empty();
}

namespace {

// A solid for each label that faces have.
std::string format_named(const MeshView& mesh, const Attribute& labels, Ticker& ticker) {
    const Groups faces(labels.names.size(), [&](const auto& add) {
        for (Index f = 0; f < labels.values.size(); ++f) {
            add(static_cast<Index>(labels.values[f]), f);
        }
    });
    std::string bytes;
    for (Index label = 0; label < labels.names.size(); ++label) {
        if (faces.of(label).empty()) continue;
        const std::string name = one_line(labels.names[label]);
        bytes += "solid " + name + '\n';
        for (const Index f : faces.of(label)) {
            ticker.tick(16);
            const Triangle& t = mesh.triangles[f];
            const Vec3 normal = doubled_normal(mesh.positions, t).stableNormalized();
            append_line(bytes, "facet normal ", normal.cast<float>().eval());
            bytes += "outer loop\n";
            for (const Index v : t) {
                append_line(bytes, "vertex ", mesh.positions[v].cast<float>().eval());
            }
            bytes += "endloop\nendfacet\n";
        }
        bytes += "endsolid " + name + '\n';
    }
    return bytes;
}

}  // namespace

std::string format_stl(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const Attribute* const labels = find_attribute(attributes.of_faces, solid_label);
    if (labels != nullptr && !labels->names.empty()) return format_named(mesh, *labels, ticker);
    std::string bytes = "binary STL";
    bytes.resize(80, ' ');
    append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
    const auto append_vector = [&](const Vec3& v) {
        for (const double x : v) append(bytes, static_cast<float>(x));
    };
    for (const Triangle& t : mesh.triangles) {
        ticker.tick();
        append_vector(doubled_normal(mesh.positions, t).stableNormalized());
        for (const Index v : t) append_vector(mesh.positions[v]);
        append(bytes, std::uint16_t{0});
    }
    return bytes;
}

}  // namespace remesh
