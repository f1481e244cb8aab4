// An L-shaped bracket (80 x 70 x 60): a plate with four bolt holes and a slot, a wall with a bored
// boss and four bolt holes, a fillet between them. Ten through holes. Plane faces are triangulated
// polygons with holes (planar.h); round ones are strips between loops.

#include <algorithm>
#include <map>

#include "make_data/data_files.h"
#include "make_data/formula.h"
#include "make_data/planar.h"

namespace make_data {

using agvd::Index;
using agvd::Triangle;
using agvd::TriangleMesh;
using agvd::Vec2;
using agvd::Vec3;

namespace {

using Loop = std::vector<Vec3>;

// A point of a plane across an axis; u and v are the two axes that follow it cyclically.
Vec3 on_plane(int axis, double level, double u, double v) {
    Vec3 p;
    p[axis] = level;
    p[(axis + 1) % 3] = six_decimals(u);
    p[(axis + 2) % 3] = six_decimals(v);
    return p;
}

Loop rectangle(int axis, double level, const Vec2& low, const Vec2& high) {
    return {on_plane(axis, level, low.x(), low.y()), on_plane(axis, level, high.x(), low.y()),
            on_plane(axis, level, high.x(), high.y()), on_plane(axis, level, low.x(), high.y())};
}

// Two half circles, `stretch` apart along v; a circle if that is 0. Counter-clockwise.
Loop slot(int axis, double level, const Vec2& center, double radius, int count,
          double stretch = 0) {
    Loop loop;
    const auto add = [&](int i, double side) {
        const Vec2 p = center + radius * unit_circle(static_cast<double>(i) / count) +
                       Vec2(0, side * stretch / 2);
        loop.push_back(on_plane(axis, level, p.x(), p.y()));
    };
    for (int i = 0; i < count; ++i) {
        if (stretch > 0 && i == count / 2) add(i, 1);
        if (stretch > 0 && i == 0) add(i, -1);
        add(i, 2 * i < count ? 1 : -1);
    }
    return loop;
}

double doubled_area(const std::vector<Vec2>& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
        sum += a.x() * b.y() - a.y() * b.x();
    }
    return sum;
}

// Which way a piece of the surface looks.
enum class Side { Positive, Negative };  // along the plane's axis
enum class Wall { Outside, Hole };

class Builder {
public:
    // A plane face: its outline, then its holes.
    void add_plane(int axis, Side side, const std::vector<Loop>& loops) {
        std::vector<std::vector<Vec2>> flat;
        std::vector<Index> vertices;
        for (Loop loop : loops) {
            const auto flatten = [&] {
                std::vector<Vec2> points;
                for (const Vec3& p : loop) {
                    points.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
                }
                return points;
            };
            const bool is_outline = flat.empty();
            if ((doubled_area(flatten()) > 0) != is_outline) std::reverse(loop.begin(), loop.end());
            flat.push_back(flatten());
            for (const Vec3& p : loop) vertices.push_back(vertex(p));
        }
        for (const auto& [a, b, c] : triangulate(flat)) {
            const bool is_positive = side == Side::Positive;
            mesh.triangles.push_back(
                {vertices[a], vertices[is_positive ? b : c], vertices[is_positive ? c : b]});
        }
    }

    // Between two loops of equal length, counter-clockwise about the axis, the second one above
    // (or around a hole: inside) the first.
    void add_strip(Wall wall, const Loop& low, const Loop& high) {
        for (std::size_t i = 0; i < low.size(); ++i) {
            const std::size_t j = (i + 1) % low.size();
            if (wall == Wall::Outside) {
                add_quad(low[i], low[j], high[j], high[i]);
            } else {
                add_quad(low[j], low[i], high[i], high[j]);
            }
        }
    }
    void add_quad(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
        const Index a = vertex(p), b = vertex(q), c = vertex(r), d = vertex(s);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
    }

    TriangleMesh mesh;

private:
    Index vertex(const Vec3& p) {
        const auto [it, is_new] =
            index_.try_emplace({p.x(), p.y(), p.z()}, static_cast<Index>(mesh.positions.size()));
        if (is_new) mesh.positions.push_back(p);
        return it->second;
    }

    std::map<std::array<double, 3>, Index> index_;
};

constexpr double depth = 60;  // of the bracket along z
constexpr int bend = 12;      // segments of fillet and round

// The L in the plane z = level, counter-clockwise, from the bottom's far end.
Loop profile(double level) {
    Loop loop{on_plane(2, level, 80, 0), on_plane(2, level, 80, 10)};
    for (int i = 0; i <= bend; ++i) {
        const Vec2 p = Vec2(18, 18) + 8 * unit_circle(0.75 - 0.25 * i / bend);
        loop.push_back(on_plane(2, level, p.x(), p.y()));
    }
    loop.push_back(on_plane(2, level, 10, 70));
    loop.push_back(on_plane(2, level, 0, 70));
    for (int i = 0; i <= bend; ++i) {
        const Vec2 p = Vec2(12, 12) + 12 * unit_circle(0.5 + 0.25 * i / bend);
        loop.push_back(on_plane(2, level, p.x(), p.y()));
    }
    return loop;
}

// Holes through the plate, in a plane y = level; u is z and v is x.
std::vector<Loop> plate_holes(double level) {
    std::vector<Loop> holes;
    for (const double z : {12.0, 48.0}) {
        for (const double x : {32.0, 68.0}) holes.push_back(slot(1, level, {z, x}, 4, 48));
    }
    holes.push_back(slot(1, level, {30, 50}, 6, 48, 20));
    return holes;
}

// Bolt holes through the wall, in a plane x = level; u is y and v is z.
std::vector<Loop> wall_holes(double level) {
    std::vector<Loop> holes;
    for (const double y : {26.0, 61.0}) {
        for (const double z : {9.0, 51.0}) holes.push_back(slot(0, level, {y, z}, 3.5, 48));
    }
    return holes;
}

Loop bore(double level, double radius) { return slot(0, level, {43.5, 30}, radius, 96); }

}  // namespace

TriangleMesh part() {
    Builder builder;
    builder.add_plane(2, Side::Positive, {profile(depth)});
    builder.add_plane(2, Side::Negative, {profile(0)});

    const Loop front = profile(depth), back = profile(0);
    for (std::size_t i = 0; i < back.size(); ++i) {
        const std::size_t j = (i + 1) % back.size();
        const double length = (back[j] - back[i]).norm();
        // The four long sides have holes and come below.
        if (length < 20) builder.add_quad(back[i], back[j], front[j], front[i]);
    }

    const auto add_with_holes = [&](int axis, Side side, const Loop& outline,
                                    const std::vector<Loop>& holes, const std::vector<Loop>& more) {
        std::vector<Loop> loops{outline};
        loops.insert(loops.end(), holes.begin(), holes.end());
        loops.insert(loops.end(), more.begin(), more.end());
        builder.add_plane(axis, side, loops);
    };
    add_with_holes(1, Side::Positive, rectangle(1, 10, {0, 18}, {depth, 80}), plate_holes(10), {});
    add_with_holes(1, Side::Negative, rectangle(1, 0, {0, 12}, {depth, 80}), plate_holes(0), {});
    add_with_holes(0, Side::Positive, rectangle(0, 10, {18, 0}, {70, depth}), wall_holes(10),
                   {bore(10, 19)});
    add_with_holes(0, Side::Negative, rectangle(0, 0, {12, 0}, {70, depth}), wall_holes(0),
                   {bore(0, 14)});

    const auto add_hole_strips = [&](const std::vector<Loop>& low, const std::vector<Loop>& high) {
        for (std::size_t i = 0; i < low.size(); ++i) builder.add_strip(Wall::Hole, low[i], high[i]);
    };
    add_hole_strips(plate_holes(0), plate_holes(10));
    add_hole_strips(wall_holes(0), wall_holes(10));
    // The boss: its side, its rim, and the bore through it and the wall.
    builder.add_strip(Wall::Outside, bore(10, 19), bore(18, 19));
    builder.add_strip(Wall::Outside, bore(18, 19), bore(18, 14));
    builder.add_strip(Wall::Hole, bore(0, 14), bore(18, 14));
    return std::move(builder.mesh);
}

}  // namespace make_data
