#include "remesh/meshfile/lines_file.h"

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {
namespace {

// As they are written.
struct WrittenLines {
    std::vector<Vec3> points;  // None twice for the two ends of a closed line.
    std::vector<std::vector<Index>> lines;
    std::vector<Attribute> of_points, of_lines;  // Of lines also their number.
};

Attribute taken(const Attribute& attribute, const std::vector<Index>& chosen) {
    Attribute result{.name = attribute.name, .type = attribute.type};
    for (const Index i : chosen) result.values.push_back(attribute.values[i]);
    return result;
}

WrittenLines to_write(const Lines& given) {
    WrittenLines out;
    std::vector<Index> points, lines;
    for (Index line = 0; line + 1 < given.offsets.size(); ++line) {
        const Index begin = given.offsets[line], end = given.offsets[line + 1];
        if (begin == end) continue;
        lines.push_back(line);
        const auto first = static_cast<Index>(points.size());
        std::vector<Index>& corners = out.lines.emplace_back();
        for (Index p = begin; p < end; ++p) {
            const bool closes =
                p + 1 == end && p > begin + 2 && given.points[p] == given.points[begin];
            corners.push_back(closes ? first : static_cast<Index>(points.size()));
            if (!closes) points.push_back(p);
        }
    }
    for (const Index p : points) out.points.push_back(given.points[p]);
    for (const Attribute& one : given.of_points) out.of_points.push_back(taken(one, points));
    out.of_lines.push_back({.name = "line", .type = NumberType::Int32});
    out.of_lines[0].values.assign(lines.begin(), lines.end());
    for (const Attribute& one : given.of_lines) out.of_lines.push_back(taken(one, lines));
    return out;
}

void add_values(VtpWriter& writer, const char* section, const std::vector<Attribute>& attributes,
                std::size_t count, Ticker& ticker) {
    writer.begin_section(section);
    for (const VtkOutputArray& array : arrays_of(attributes)) {
        const bool is_whole = array.type == NumberType::Int32;
        std::string& bytes = writer.begin_array(array.name, is_whole ? "Int32" : "Float64", 1);
        append_values(array, count, std::endian::little, ticker, bytes);
        writer.end_array();
    }
    writer.end_section();
}

std::string format_vtp_lines(const WrittenLines& lines, Ticker ticker) {
    VtpWriter writer;
    add_values(writer, "PointData", lines.of_points, lines.points.size(), ticker);
    add_values(writer, "CellData", lines.of_lines, lines.lines.size(), ticker);
    writer.add_points(lines.points, ticker);
    writer.add_cells("Lines", lines.lines.size(), ticker,
                     [&](std::size_t line) { return lines.lines[line]; });
    return std::move(writer).finish();
}

std::string format_obj_lines(const WrittenLines& lines, Ticker ticker) {
    std::string bytes;
    for (const Vec3& point : lines.points) {
        ticker.tick(4);
        append_line(bytes, "v ", point);
    }
    for (std::size_t line = 0; line < lines.lines.size(); ++line) {
        ticker.tick(lines.lines[line].size());
        bytes += '#';
        for (const Attribute& attribute : lines.of_lines) {
            bytes += ' ' + attribute.name + ' ';
            append_shortest(bytes, attribute.values[line]);
        }
        std::vector<Index> corners = lines.lines[line];
        for (Index& corner : corners) ++corner;  // OBJ counts from 1.
        append_line(bytes, "\nl ", corners);
    }
    return bytes;
}

std::string properties(const std::vector<Attribute>& attributes) {
    std::string text;
    for (const Attribute& attribute : attributes) {
        text += attribute.type == NumberType::Int32 ? "property int " : "property double ";
        text += attribute.name + '\n';
    }
    return text;
}

void append_row(std::string& bytes, const std::vector<Attribute>& attributes, std::size_t row) {
    for (const Attribute& attribute : attributes) {
        append_number(bytes, attribute.type, attribute.values[row]);
    }
}

// Each piece is a face of two vertices: readers such as meshio know no other elements, nor binary
// faces with values.
std::string format_ply_lines(const WrittenLines& lines, Ticker ticker) {
    std::size_t num_pieces = 0;
    for (const auto& corners : lines.lines) num_pieces += corners.size() - 1;
    std::string bytes =
        joined("ply\nformat binary_little_endian 1.0\nelement vertex ", lines.points.size(),
               "\nproperty double x\nproperty double y\nproperty double z\n",
               properties(lines.of_points), properties(lines.of_lines), "element face ", num_pieces,
               "\nproperty list uchar int vertex_indices\nend_header\n");
    std::size_t line = 0;
    for (Index p = 0; p < lines.points.size(); ++p) {
        ticker.tick();
        while (line + 1 < lines.lines.size() && lines.lines[line + 1].front() <= p) ++line;
        append_all(bytes, lines.points[p].x(), lines.points[p].y(), lines.points[p].z());
        append_row(bytes, lines.of_points, p);
        append_row(bytes, lines.of_lines, line);
    }
    for (const auto& corners : lines.lines) {
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            ticker.tick();
            append_all(bytes, std::uint8_t{2}, corners[i], corners[i + 1]);
        }
    }
    return bytes;
}

struct LinesFormat {
    std::string_view extension;
    std::string (*format)(const WrittenLines&, Ticker);
};
constexpr LinesFormat lines_formats[] = {
    {".vtp", format_vtp_lines}, {".obj", format_obj_lines}, {".ply", format_ply_lines}};

const LinesFormat& require_lines_format(const std::filesystem::path& path) {
    return require_format(lines_formats, path, ".vtp, .obj or .ply");
}

}  // namespace

std::string format_lines(const std::filesystem::path& path, const Lines& lines,
                         const Progress& progress) {
    Poller poller(progress);
    const Ticker ticker(poller);
    std::string bytes = require_lines_format(path).format(to_write(lines), ticker);
    return is_compressed({path}) ? pack_gzip(bytes, ticker) : bytes;
}

void check_lines_extension(const std::filesystem::path& path) {
    static_cast<void>(require_lines_format(path));
}

}  // namespace remesh
