// render-mesh: a picture of a mesh. The view turns the mesh about its axes and
// fits it into the picture in perspective. Faces are shaded by their normals, back faces are blue;
// lines of an OBJ file or the network of creases can be drawn on top.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cli.h"
#include "remesh/meshfile/atomic_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "render/mesh_picture.h"
#include "render/network_lines.h"
#include "system/process.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using render::Color;
using render::View;

const Color plain_color{0.62F, 0.62F, 0.60F};  // Under lines in colour.
const Color overlay_color{0.02F, 0.05F, 0.16F};
const Color inside_color{1, 1, 1};

struct Options {
    std::string mesh, picture, overlay, inside, network, size = "1200x900";
    agvd::Index num_vertices = 2000;
    std::array<double, 3> view = render::default_degrees;
    double line_width = 1.6;
    bool is_wire = false;
};

struct Lines {
    std::vector<Vec3> points;
    std::vector<std::pair<std::size_t, std::size_t>> segments;
};

// The `v` and `l` lines of an OBJ file.
Lines read_lines(const std::string& path) {
    std::ifstream file(path);
    if (!file) throw agvd::IoError(path + ": cannot be read; check its name and permissions");
    Lines lines;
    std::string text, word;
    while (std::getline(file, text)) {
        std::istringstream in(text);
        in >> word;
        if (word == "v") {
            Vec3 p;
            if (in >> p.x() >> p.y() >> p.z()) lines.points.push_back(p);
        } else if (word == "l") {
            std::size_t from = 0, to = 0;
            for (in >> from; in >> to; from = to) lines.segments.emplace_back(from - 1, to - 1);
        }
        word.clear();
    }
    for (const auto& [from, to] : lines.segments) {
        if (std::max(from, to) >= lines.points.size()) {
            throw agvd::IoError(path + ": an `l` line names vertex " +
                                std::to_string(std::max(from, to) + 1) +
                                ", but the file has only " + std::to_string(lines.points.size()) +
                                " vertices, counted from 1; correct the line");
        }
    }
    return lines;
}

void draw_network(const Options& options, const View& view, render::Canvas& canvas) {
    const render::NetworkLines network =
        render::network_lines(options.network, options.num_vertices);
    const double width = 2 * options.line_width;
    for (const auto& [points, color] : network.lines) {
        for (std::size_t i = 0; i + 1 < points.size(); ++i) {
            canvas.draw_line(view.to_pixels(points[i]), view.to_pixels(points[i + 1]), color, width,
                             width);
        }
    }
    for (const Vec3& node : network.nodes) {
        const Vec3 at = view.to_pixels(node);
        canvas.draw_line(at, at, overlay_color, 2.2 * width, 2 * width);
    }
}

void draw(const Options& options) {
    int width = 0, height = 0;
    if (char x = 0; !(std::istringstream(options.size) >> width >> x >> height) || x != 'x' ||
                    std::min(width, height) < 1 || std::max(width, height) > 10000) {
        throw agvd::InvalidOption("--size is " + options.size +
                                  "; use a size such as 1200x900, each number from 1 to 10000");
    }
    const TriangleMesh mesh = remesh::read_mesh(options.mesh).mesh;
    const View view(mesh.view(), options.view, width, height);
    render::Canvas canvas(width, height);
    const Color& front = options.network.empty() ? render::front_color : plain_color;
    render::draw_mesh(mesh.view(), view, front, options.is_wire, canvas);
    canvas.shade_hollows(0.05 * std::min(width, height));
    const auto draw_lines = [&](const std::string& path, const Color& color, double bias) {
        if (path.empty()) return;
        const Lines lines = read_lines(path);
        for (const auto& [from, to] : lines.segments) {
            canvas.draw_line(view.to_pixels(lines.points[from]), view.to_pixels(lines.points[to]),
                             color, options.line_width, bias);
        }
    };
    draw_lines(options.overlay, overlay_color, 2 * options.line_width);
    draw_lines(options.inside, inside_color, agvd::infinity);
    if (!options.network.empty()) draw_network(options, view, canvas);
    remesh::write_file_atomically(options.picture, canvas.png());
}

}  // namespace

int main(int argc, char** argv) {
    cli::begin_process(argc, argv);
    Options options;
    CLI::App app{"Draws a mesh; back faces are blue.", "render-mesh"};
    app.add_option("MESH", options.mesh, "Mesh to draw: .ply, .obj, .off or .stl")->required();
    app.add_option("PICTURE", options.picture, "PNG to write")->required();
    app.add_option("--size", options.size, "Size of the picture in pixels: WIDTHxHEIGHT")
        ->capture_default_str();
    app.add_option("--view", options.view, "Turns about x, y and z in degrees; y first")
        ->delimiter(',')
        ->type_name("X,Y,Z")
        ->default_str("15,-30,0");
    app.add_flag("--wire", options.is_wire, "Draw the edges");
    app.add_option("--overlay", options.overlay, "OBJ whose `l` lines are drawn on the surface");
    app.add_option("--inside", options.inside,
                   "OBJ whose `l` lines are drawn in white, also behind the surface");
    app.add_option(
        "--network", options.network,
        "Mesh whose creases are drawn in colours as `remesh` keeps them, with dots at corners");
    app.add_option("--vertices", options.num_vertices,
                   "Number of vertices of that run; the creases depend on it")
        ->check(CLI::Range(300, 1000000))
        ->capture_default_str();
    app.add_option("--line-width", options.line_width,
                   "Width of the lines of the overlay, in pixels")
        ->check(CLI::Range(0.1, 50.0))
        ->capture_default_str();
    return cli::run(app, argc, argv, [&] { draw(options); });
}
