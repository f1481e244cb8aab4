// render-mesh: a picture of a mesh, for documentation. The view turns the mesh about its axes and
// fits it into the picture in perspective. Faces are shaded by their normals, back faces are blue;
// lines of an OBJ file or the network of creases can be drawn on top.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cli.h"
#include "remesh/meshfile/mesh_file.h"
#include "render/canvas.h"
#include "render/network_lines.h"

namespace {

using agvd::Index;
using agvd::TriangleMesh;
using agvd::Vec3;
using render::Color;

const Color front_color{0.84F, 0.40F, 0.24F};
const Color back_color{0.06F, 0.13F, 0.55F};
const Color plain_color{0.62F, 0.62F, 0.60F};  // Under lines in colour.
const Color overlay_color{0.02F, 0.05F, 0.16F};

struct Options {
    std::string mesh, picture, overlay, network, size = "1200x900";
    agvd::Index num_vertices = 2000;
    std::vector<double> view{15, -30, 0};
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

// Turned about y, then x, then z (degrees); seen from a few radii away; fitted to the picture.
class View {
public:
    View(const TriangleMesh& mesh, const std::vector<double>& degrees, int width, int height) {
        const auto turn = [&](std::size_t k, const Vec3& axis) {
            return Eigen::AngleAxisd(degrees[k] * std::numbers::pi / 180, axis);
        };
        rotation_ = turn(2, Vec3::UnitZ()) * turn(0, Vec3::UnitX()) * turn(1, Vec3::UnitY());
        Eigen::AlignedBox3d box, screen;
        for (const Vec3& p : mesh.positions) box.extend(p);
        center_ = box.center();
        distance_ = 3.5 * box.diagonal().norm();
        for (const Vec3& p : mesh.positions) screen.extend(project(p));
        const Vec3 extent = screen.sizes();
        scale_ = 0.94 * std::min(width / extent.x(), height / extent.y());
        shift_ = Vec3(width, height, 0) / 2 -
                 scale_ * Vec3(screen.center().x(), -screen.center().y(), 0);
    }

    // The perspective is a projective map, so planes stay planes and depth stays linear in x, y.
    [[nodiscard]] Vec3 project(const Vec3& point) const {
        Vec3 p = rotation_ * (point - center_);
        p /= 1 - p.z() / distance_;
        return p;
    }
    [[nodiscard]] Vec3 to_pixels(const Vec3& point) const {
        const Vec3 p = project(point);
        return scale_ * Vec3(p.x(), -p.y(), p.z()) + shift_;
    }
    [[nodiscard]] Vec3 turn(const Vec3& direction) const { return rotation_ * direction; }

private:
    Eigen::Matrix3d rotation_;
    Vec3 center_, shift_ = Vec3::Zero();
    double distance_ = 1, scale_ = 1;
};

// A warm light from above on the left, a cool one from the right, and ambient light from above.
Color shade(const Vec3& normal, const Color& surface) {
    const Vec3 key = Vec3(-0.45, 0.7, 0.75).normalized();
    const Vec3 fill = Vec3(0.9, 0.1, 0.35).normalized();
    const auto lit = [&](const Vec3& light) {
        return static_cast<float>(std::max(0.0, normal.dot(light)));
    };
    const auto sky = static_cast<float>(0.5 + 0.5 * normal.y());
    const Vec3 half = (key + Vec3::UnitZ()).normalized();
    const float gloss = 0.16F * static_cast<float>(std::pow(std::max(0.0, normal.dot(half)), 40));
    const Color light = Color(1.0F, 0.96F, 0.88F) * 0.78F * lit(key) +
                        Color(0.70F, 0.82F, 1.0F) * 0.26F * lit(fill) +
                        Color(0.80F, 0.88F, 1.0F) * (0.10F + 0.16F * sky);
    return surface.cwiseProduct(light) + Color::Constant(gloss);
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
    const View view(mesh, options.view, width, height);
    render::Canvas canvas(width, height);
    for (const agvd::Triangle& t : mesh.triangles) {
        const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
        const std::array corners{view.to_pixels(a), view.to_pixels(b), view.to_pixels(c)};
        const Vec3 screen_normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        const bool is_front = screen_normal.z() < 0;  // y points down
        Vec3 normal = view.turn((b - a).cross(c - a)).normalized();
        if (!is_front) normal = -normal;
        // Lines fade where triangles are only a few pixels large: otherwise lines would cover them.
        const double pixels = std::sqrt(std::abs(screen_normal.z()));
        const double opacity = options.is_wire ? 0.75 * std::clamp(pixels / 10, 0.1, 1.0) : 0.0;
        const Color& front = options.network.empty() ? front_color : plain_color;
        canvas.draw_triangle(corners, shade(normal, is_front ? front : back_color),
                             static_cast<float>(opacity));
    }
    canvas.shade_hollows(0.05 * std::min(width, height));
    if (!options.overlay.empty()) {
        const Lines lines = read_lines(options.overlay);
        for (const auto& [from, to] : lines.segments) {
            canvas.draw_line(view.to_pixels(lines.points[from]), view.to_pixels(lines.points[to]),
                             overlay_color, options.line_width, 2 * options.line_width);
        }
    }
    if (!options.network.empty()) draw_network(options, view, canvas);
    canvas.write_png(options.picture);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app{"Draws a mesh; back faces are blue.", "render-mesh"};
    app.add_option("MESH", options.mesh, "Mesh to draw: .ply, .obj, .off or .stl")->required();
    app.add_option("PICTURE", options.picture, "PNG to write")->required();
    app.add_option("--size", options.size, "Size of the picture in pixels: WIDTHxHEIGHT")
        ->capture_default_str();
    app.add_option("--view", options.view, "Turns about x, y and z in degrees; y first")
        ->expected(3)
        ->delimiter(',')
        ->type_name("X,Y,Z")
        ->default_str("15,-30,0");
    app.add_flag("--wire", options.is_wire, "Draw the edges");
    app.add_option("--overlay", options.overlay, "OBJ whose `l` lines are drawn on the surface");
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
