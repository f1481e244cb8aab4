#include "remesh/meshfile/lines_file.h"

#include <numeric>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/packed.h"
#include "remesh/meshfile/vtk_output.h"

namespace remesh {
namespace {

std::size_t num_lines(const Lines& lines) { return lines.offsets.size() - 1; }

// The points of a line, counted from `first`.
std::vector<Index> points_of(const Lines& lines, std::size_t line, Index first) {
    std::vector<Index> points(lines.offsets[line + 1] - lines.offsets[line]);
    std::iota(points.begin(), points.end(), first + lines.offsets[line]);
    return points;
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

std::string format_vtp_lines(const Lines& lines, Ticker ticker) {
    VtpWriter writer;
    add_values(writer, "PointData", lines.of_points, lines.points.size(), ticker);
    add_values(writer, "CellData", lines.of_lines, num_lines(lines), ticker);
    writer.add_points(lines.points, ticker);
    writer.add_cells("Lines", num_lines(lines), ticker,
                     [&](std::size_t line) { return points_of(lines, line, 0); });
    return std::move(writer).finish();
}

std::string format_obj_lines(const Lines& lines, Ticker ticker) {
    std::string bytes;
    for (const Vec3& point : lines.points) {
        ticker.tick(4);
        append_line(bytes, "v ", point);
    }
    for (std::size_t line = 0; line < num_lines(lines); ++line) {
        const std::vector<Index> points = points_of(lines, line, 1);
        ticker.tick(points.size());
        if (points.empty()) continue;
        if (!lines.of_lines.empty()) bytes += '#';
        for (const Attribute& attribute : lines.of_lines) {
            bytes += ' ' + attribute.name + ' ';
            append_shortest(bytes, attribute.values[line]);
        }
        if (!lines.of_lines.empty()) bytes += '\n';
        append_line(bytes, "l ", points);
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

std::string format_ply_lines(const Lines& lines, Ticker ticker) {
    std::size_t num_edges = 0;
    for (std::size_t line = 0; line < num_lines(lines); ++line) {
        const Index count = lines.offsets[line + 1] - lines.offsets[line];
        num_edges += count > 0 ? count - 1 : 0;
    }
    std::string bytes =
        joined("ply\nformat binary_little_endian 1.0\nelement vertex ", lines.points.size(),
               "\nproperty double x\nproperty double y\nproperty double z\n",
               properties(lines.of_points), "element edge ", num_edges,
               "\nproperty int vertex1\nproperty int vertex2\nproperty int line\n",
               properties(lines.of_lines), "end_header\n");
    for (std::size_t p = 0; p < lines.points.size(); ++p) {
        ticker.tick();
        append_all(bytes, lines.points[p].x(), lines.points[p].y(), lines.points[p].z());
        append_row(bytes, lines.of_points, p);
    }
    for (std::size_t line = 0; line < num_lines(lines); ++line) {
        for (Index p = lines.offsets[line]; p + 1 < lines.offsets[line + 1]; ++p) {
            ticker.tick();
            append_all(bytes, p, p + 1, static_cast<Index>(line));
            append_row(bytes, lines.of_lines, line);
        }
    }
    return bytes;
}

struct LinesFormat {
    std::string_view extension;
    std::string (*format)(const Lines&, Ticker);
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
    std::string bytes = require_lines_format(path).format(lines, ticker);
    return is_compressed({path}) ? pack_gzip(bytes, ticker) : bytes;
}

void check_lines_extension(const std::filesystem::path& path) {
    static_cast<void>(require_lines_format(path));
}

}  // namespace remesh
