#include "render/diagram_picture.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "render/mesh_picture.h"

namespace render {
namespace {

using agvd::Index;
using agvd::Vec3;

constexpr int width = 1200, height = 900;
const Color unreached_color{0.42F, 0.42F, 0.42F};

// How a kind of lines is drawn. Widths in pixels.
struct Pen {
    Color color;
    const char* name;  // Of the color, in SVG.
    double width;
};
Pen dark(double pixels) { return {{0.010F, 0.014F, 0.022F}, "#1c2028", pixels}; }
Pen white(double pixels) { return {{1, 1, 1}, "#fff", pixels}; }
const Pen bisector_pen = dark(2);
const Pen isoline_pen{{0.6F, 0.6F, 0.6F}, "#cbcbcb", 1};
const Pen rim_pen = white(8), site_pen = dark(5.5);
const Pen line_rim_pen = white(6), line_pen = dark(3.5);
// Lines lie on the surface but for rounding. In pixels.
constexpr double bias = 0.05;

// Hues a golden angle apart, in two lightnesses: neighbours differ. The same as on pages.
Color cell_color(agvd::SiteId site) {
    if (!site.is_valid()) return unreached_color;
    const double hue = std::fmod(site.value() * 137.508 + 20, 360);
    const double lightness = site.value() % 2 == 0 ? 0.62 : 0.5;
    const double amount = 0.48 * std::min(lightness, 1 - lightness);
    const auto channel = [&](double n) {
        const double k = std::fmod(n + hue / 30, 12);
        const double encoded = lightness - amount * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
        return static_cast<float>(std::pow(encoded, 2.2));
    };
    return {channel(0), channel(8), channel(4)};
}

// The cells.
Canvas canvas_of(const DiagramDrawing& drawing, const View& view) {
    Canvas canvas(width, height);
    const auto color = [&](Index face, bool) { return cell_color(drawing.cells.face_site[face]); };
    draw_mesh(drawing.cells.mesh.view(), view, color, false, canvas);
    canvas.shade_hollows(0.05 * std::min(width, height));
    return canvas;
}

View view_of(const DiagramDrawing& drawing) {
    return {drawing.cells.mesh.view(), drawing.degrees, width, height};
}

// Calls each(a, b) for the segments of all lines, in pixels.
template <typename Each>
void for_each_segment(const page::Polylines& lines, const View& view, const Each& each) {
    std::size_t first = 0;
    for (const Index length : lines.lengths) {
        for (std::size_t i = first + 1; i < first + length; ++i) {
            each(view.to_pixels(lines.points[i - 1]), view.to_pixels(lines.points[i]));
        }
        first += length;
    }
}

// Path data of the visible parts of segments, judged at every pixel.
class VisiblePath {
public:
    VisiblePath(const Canvas& canvas, std::ostream& out) : canvas_(canvas), out_(out) {}

    void add(const Vec3& a, const Vec3& b) {
        const int steps = std::max(1, static_cast<int>(std::ceil((b - a).head<2>().norm())));
        const auto at = [&](int i) -> Vec3 {
            return a + (b - a) * (static_cast<double>(i) / steps);
        };
        for (int i = 0; i < steps; ++i) {
            int end = i;
            while (end < steps && canvas_.is_visible(at(end), bias) &&
                   canvas_.is_visible(at(end + 1), bias)) {
                ++end;
            }
            if (end == i) continue;
            if (at(i) != end_) write('M', at(i));
            write('L', at(end));
            end_ = at(end);
            i = end - 1;
        }
    }

private:
    void write(char letter, const Vec3& p) { out_ << letter << p.x() << ' ' << p.y(); }

    const Canvas& canvas_;
    std::ostream& out_;
    Vec3 end_ = Vec3::Constant(agvd::infinity);  // Of what is written.
};

}  // namespace

std::string png_of(const DiagramDrawing& drawing) {
    const View view = view_of(drawing);
    Canvas canvas = canvas_of(drawing, view);
    const auto draw_lines = [&](const page::Polylines& lines, const Pen& pen) {
        for_each_segment(lines, view, [&](const Vec3& a, const Vec3& b) {
            canvas.draw_line(a, b, pen.color, pen.width, bias);
        });
    };
    draw_lines(drawing.isolines, isoline_pen);
    draw_lines(drawing.bisectors, bisector_pen);
    draw_lines(drawing.site_lines, line_rim_pen);
    draw_lines(drawing.site_lines, line_pen);
    for (const Pen& pen : {rim_pen, site_pen}) {
        for (const Vec3& site : drawing.sites) {
            const Vec3 at = view.to_pixels(site);
            canvas.draw_line(at, at, pen.color, pen.width, bias);
        }
    }
    return canvas.png();
}

std::string svg_of(const DiagramDrawing& drawing) {
    const View view = view_of(drawing);
    const Canvas canvas = canvas_of(drawing, view);
    std::ostringstream out;
    out.setf(std::ios::fixed);
    out.precision(2);
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
        << "\" viewBox=\"0 0 " << width << ' ' << height << "\">\n<image width=\"" << width
        << "\" height=\"" << height << "\" href=\"data:image/png;base64,"
        << page::to_base64(canvas.png()) << "\"/>\n";
    const auto write_lines = [&](const char* id, const page::Polylines& lines, const Pen& pen) {
        out << "<path id=\"" << id << "\" fill=\"none\" stroke-linecap=\"round\" stroke=\""
            << pen.name << "\" stroke-width=\"" << pen.width << "\" d=\"";
        VisiblePath path(canvas, out);
        for_each_segment(lines, view, [&](const Vec3& a, const Vec3& b) { path.add(a, b); });
        out << "\"/>\n";
    };
    write_lines("isolines", drawing.isolines, isoline_pen);
    write_lines("bisectors", drawing.bisectors, bisector_pen);
    write_lines("site_line_rims", drawing.site_lines, line_rim_pen);
    write_lines("site_lines", drawing.site_lines, line_pen);
    out << "<g id=\"sites\" fill=\"" << site_pen.name << "\" stroke=\"" << rim_pen.name
        << "\" stroke-width=\"" << (rim_pen.width - site_pen.width) / 2 << "\">\n";
    for (const Vec3& site : drawing.sites) {
        const Vec3 at = view.to_pixels(site);
        if (!canvas.is_visible(at, bias)) continue;
        out << "<circle cx=\"" << at.x() << "\" cy=\"" << at.y() << "\" r=\""
            << (rim_pen.width + site_pen.width) / 4 << "\"/>\n";
    }
    out << "</g>\n</svg>\n";
    return out.str();
}

}  // namespace render
