// The programs of tools/examples as processes, against what is known of the shapes that they run
// on.
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <sstream>

#include "agvd/agvd.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

using agvd::Index;
using agvd::Vec3;
using Line = std::vector<Vec3>;

constexpr double pi = std::numbers::pi;

class Examples : public Scratch {
protected:
    // What the example prints.
    static std::string example(const std::string& name, const std::vector<std::string>& arguments) {
        const auto outcome = run((std::string(EXAMPLES) + "/example-" + name).c_str(), arguments);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    }
    [[nodiscard]] std::string shape(const std::string& name) const {
        example("shapes", {name, at(name + ".obj")});
        return at(name + ".obj");
    }
    // The lines of an OBJ file.
    [[nodiscard]] std::vector<Line> lines(const std::string& name) const {
        std::istringstream file(bytes(name));
        std::vector<Vec3> points;
        std::vector<Line> lines;
        for (std::string text; std::getline(file, text);) {
            std::istringstream in(text);
            std::string word;
            in >> word;
            if (word == "v") {
                Vec3& p = points.emplace_back();
                in >> p.x() >> p.y() >> p.z();
            } else if (word == "l") {
                lines.emplace_back();
                for (std::size_t i = 0; in >> i;) lines.back().push_back(points.at(i - 1));
            }
        }
        return lines;
    }
};

// All numbers of a text.
std::vector<double> numbers_in(const std::string& text) {
    std::vector<double> numbers;
    std::string digits;
    for (const char c : text + ' ') {
        if (std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-') {
            digits += c;
        } else {
            if (digits.find_first_of("0123456789") != std::string::npos) {
                numbers.push_back(std::stod(digits));
            }
            digits.clear();
        }
    }
    return numbers;
}

double area_of(const agvd::MeshView& mesh, Index face) {
    return agvd::doubled_normal(mesh.positions, mesh.triangles[face]).norm() / 2;
}

double distance_from(const std::vector<Line>& lines, const Vec3& point) {
    double distance = agvd::infinity;
    for (const Line& line : lines) {
        for (std::size_t i = 1; i < line.size(); ++i) {
            distance = std::min(distance, agvd::distance_to_segment(point, line[i - 1], line[i]));
        }
    }
    return distance;
}

// --- Balanced cells -----------------------------------------------------------------------------

TEST_F(Examples, BalancedCellsHaveTheSameAreaWithinOnePerCent) {
    int num_cells = 0;
    for (const auto& [name, count] :
         {std::pair{"shell.obj", 12}, {"part.off", 20}, {"ring.obj", 10}}) {
        SCOPED_TRACE(name);
        const std::string in = std::string(AGVD_DATA_DIR) + '/' + name;
        const std::string out =
            example("balance", {in, std::to_string(count), at("cells.ply"), at("sites.txt")});
        // The areas of the written cells.
        const remesh::MeshFile cells =
            remesh::read_mesh(at("cells.ply"), remesh::ReadOptions{.with_attributes = true});
        const auto& label = remesh::find_attribute(cells.attributes.of_faces, "site")->values;
        std::map<double, double> areas;
        for (Index f = 0; f < label.size(); ++f) areas[label[f]] += area_of(cells.mesh, f);
        ASSERT_EQ(areas.size(), count);
        const agvd::TriangleMesh mesh = remesh::read_mesh(in).mesh;
        double whole = 0;
        for (Index f = 0; f < mesh.triangles.size(); ++f) whole += area_of(mesh, f);
        const std::vector<double> printed = numbers_in(out);
        for (const auto& [site, area] : areas) {
            ++num_cells;
            EXPECT_NEAR(area, whole / count, .01 * whole / count);
            EXPECT_NEAR(area, printed.at(2 * static_cast<std::size_t>(site) + 1), 1e-6 * whole);
        }
        // They are those of the written sites and starts.
        const remesh::SitesFile sites = remesh::read_sites(at("sites.txt"), mesh.view());
        const agvd::ClosestPointTree tree(mesh);
        std::vector<agvd::SurfacePoint> middles;
        for (Index f = 0; f < label.size(); ++f) {
            const auto [a, b, c] = agvd::corners_of(cells.mesh, f);
            middles.push_back(tree.query((a + b + c) / 3).point);
        }
        const auto nearest = agvd::find_distances(agvd::build_surface(mesh), sites.sites, middles,
                                                  {.points = sites.points, .max_error = 0});
        double wrong = 0;
        for (Index f = 0; f < label.size(); ++f) {
            if (nearest.point_site[f].value() != label[f]) wrong += area_of(cells.mesh, f);
        }
        EXPECT_LT(wrong, 1e-3 * whole);
    }
    EXPECT_EQ(num_cells, 42);
}

// --- Ripley's K ---------------------------------------------------------------------------------

// Uniform on the unit sphere.
Vec3 random_direction(std::mt19937_64& random) {
    const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
    const double z = 2 * unit() - 1, turn = 2 * pi * unit(), radius = std::sqrt(1 - z * z);
    return {radius * std::cos(turn), radius * std::sin(turn), z};
}

constexpr int num_points = 400;

double cap(double r) { return 2 * pi * (1 - std::cos(r)); }

// Of K for uniform points on the unit sphere: pairs are within r with the share p of the cap's
// area, any two pairs independently, even with a point in common.
double deviation(double r) {
    const double p = cap(r) / (4 * pi), num_pairs = num_points * (num_points - 1) / 2.0;
    return 4 * pi * std::sqrt(p * (1 - p) / num_pairs);
}

class Ripley : public Examples {
protected:
    struct Row {
        double r, k, uniform;
    };
    // For r = .1, .2, ..., .5.
    [[nodiscard]] std::vector<Row> rows_of(const std::vector<Vec3>& points) const {
        std::ostringstream text;
        text.precision(12);
        for (const Vec3& p : points) {
            text << "p " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
        }
        const std::vector<double> numbers = numbers_in(
            example("ripley", {shape("sphere"), put("points.txt", text.str()), ".1", "5"}));
        std::vector<Row> rows;
        for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
            rows.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
        }
        EXPECT_EQ(rows.size(), 5U);
        return rows;
    }
};

TEST_F(Ripley, UniformPointsHaveTheAreaOfACap) {
    int num_rows = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<Vec3> points(num_points);
        for (Vec3& p : points) p = random_direction(random);
        for (const auto& [r, k, uniform] : rows_of(points)) {
            ++num_rows;
            // The mesh has .2 % less area than the sphere.
            EXPECT_NEAR(k, cap(r), 4 * deviation(r) + .002 * cap(r)) << r;
            EXPECT_NEAR(uniform, cap(r), .01 * cap(r)) << r;
        }
    }
    EXPECT_EQ(num_rows, 15);
}

TEST_F(Ripley, ClustersHaveMoreAndEvenPointsHaveLess) {
    std::mt19937_64 random(1);
    std::vector<Vec3> clustered, even;
    for (int parent = 0; parent < num_points / 10; ++parent) {
        const Vec3 centre = random_direction(random);
        for (int i = 0; i < 10; ++i) {
            clustered.push_back((centre + .1 * random_direction(random)).normalized());
        }
    }
    for (int i = 0; i < num_points; ++i) {  // Fibonacci's spiral.
        const double z = 1 - (2 * i + 1.0) / num_points, turn = i * pi * (3 - std::sqrt(5));
        const double radius = std::sqrt(1 - z * z);
        even.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
    }
    const auto of_clusters = rows_of(clustered), of_even = rows_of(even);
    for (const std::size_t i : {0U, 1U, 2U}) {
        const double r = of_clusters.at(i).r;
        EXPECT_GT(of_clusters[i].k, cap(r) + 10 * deviation(r)) << r;
    }
    EXPECT_LT(of_even.at(0).k, cap(.1) - 10 * deviation(.1));
}

// --- Medial axis --------------------------------------------------------------------------------

// Of a rectangle with squares of size h at its boundary: to the corners, but for the cells of the
// corners' sites.
std::vector<Line> axis_of_rectangle(double width, double height, double h) {
    const double a = h / 2, b = height / 2;
    const Vec3 left(b, b, 0), right(width - b, b, 0);
    return {{left, right},
            {{a, a, 0}, left},
            {{a, height - a, 0}, left},
            {{width - a, a, 0}, right},
            {{width - a, height - a, 0}, right}};
}

// The larger of both ways, by points of each that are at most `step` apart.
double distance_between(const std::vector<Line>& a, const std::vector<Line>& b, double step) {
    const auto farthest = [step](const std::vector<Line>& from, const std::vector<Line>& to) {
        double distance = 0;
        for (const Line& line : from) {
            for (std::size_t i = 1; i < line.size(); ++i) {
                const Vec3 along = line[i] - line[i - 1];
                const int parts = 1 + static_cast<int>(along.norm() / step);
                for (int k = 0; k <= parts; ++k) {
                    distance =
                        std::max(distance, distance_from(to, line[i - 1] + along * k / parts));
                }
            }
        }
        return distance;
    };
    return std::max(farthest(a, b), farthest(b, a));
}

TEST_F(Examples, MedialAxisOfARectangle) {
    const auto printed = numbers_in(example("medial", {shape("rectangle"), at("axis.obj")}));
    const auto axis = axis_of_rectangle(2, 1, 1 / 40.0);
    EXPECT_LT(distance_between(lines("axis.obj"), axis, .01), 1e-9);
    EXPECT_NEAR(printed.at(0), 1 + 2 * std::sqrt(2) * (1 - 1 / 40.0), 1e-6);
    // From sites .5 above and .5 below, and half a square aside.
    EXPECT_NEAR(printed.at(1), std::hypot(.5, .0125), 1e-6);
    // Sites on both sides of a corner, two vertices apart, are neighbours as well.
    const auto shorter = numbers_in(example("medial", {at("rectangle.obj"), at("axis.obj"), "3"}));
    EXPECT_NEAR(shorter.at(0), 1 + 2 * std::sqrt(2) * (1 - 3 / 40.0), 1e-6);
}

TEST_F(Examples, MedialAxisOfAnEllipse) {
    const auto printed = numbers_in(example("medial", {shape("ellipse"), at("axis.obj")}));
    const double end = 2 - 1.0 / 2;  // a - b^2 / a.
    EXPECT_LT(distance_between(lines("axis.obj"), {{{-end, 0, 0}, {end, 0, 0}}}, .01), 1e-3);
    EXPECT_NEAR(printed.at(0), 2 * end, 2e-3);
    EXPECT_NEAR(printed.at(1), 1, 1e-3);
}

// A rectangle of faces on a prism, which unrolls onto the plane.
TEST_F(Examples, MedialAxisOfARegionOnABentSurface) {
    constexpr Index columns = 60, rows = 40;
    const double side = 2 * std::sin(pi / columns);
    agvd::TriangleMesh mesh = shapes::tube(columns, rows);
    for (Vec3& p : mesh.positions) p.z() *= rows * side / 2;  // Squares.
    // Columns 10 to 49, rows 10 to 29.
    remesh::Attribute region{.name = "region", .type = remesh::NumberType::UInt8};
    for (const agvd::Triangle& t : mesh.triangles) {
        region.values.push_back(std::all_of(t.begin(), t.end(), [](Index v) {
            const Index column = v / (rows + 1), row = v % (rows + 1);
            return column >= 10 && column <= 50 && row >= 10 && row <= 30;
        }));
    }
    ASSERT_EQ(std::accumulate(region.values.begin(), region.values.end(), 0.0), 2 * 40 * 20);
    put("prism.ply", remesh::format_mesh(std::filesystem::path("prism.ply"), mesh.view(),
                                         {.of_faces = {region}}));
    example("medial", {at("prism.ply"), at("axis.obj"), "1", "region"});
    // From the lower corner of the region: whole sides, and the way on the last one.
    const auto unrolled = [&](const Vec3& p) {
        const double turn = std::atan2(p.y(), p.x()), sector = 2 * pi / columns;
        const double column = std::floor((turn < 0 ? turn + 2 * pi : turn) / sector + 1e-9);
        const Vec3 from(std::cos(column * sector), std::sin(column * sector), p.z());
        return Vec3((column - 10) * side + (p - from).norm(), p.z() - 10 * side, 0);
    };
    std::vector<Line> axis = lines("axis.obj");
    for (Line& line : axis) std::transform(line.begin(), line.end(), line.begin(), unrolled);
    EXPECT_LT(distance_between(axis, axis_of_rectangle(40 * side, 20 * side, side), side / 5),
              1e-7);
}

// --- Skeleton -----------------------------------------------------------------------------------

TEST_F(Examples, SkeletonOfABentTubeIsItsAxis) {
    std::string root;
    for (int i = 0; i < 32; ++i) root += "v " + std::to_string(i) + '\n';  // The rim of one end.
    const auto printed = numbers_in(
        example("skeleton", {shape("tube"), put("root.txt", root), "1", at("skeleton.obj")}));
    const auto skeleton = lines("skeleton.obj");
    // The axis is 20 pi / 3 = 20.9 long; the last rings end at the other rim.
    EXPECT_GE(printed.at(0), 18);
    EXPECT_EQ(printed.at(1), printed[0] - 1);
    EXPECT_EQ(skeleton.size(), printed[1]);
    double last = 0;
    for (const Line& line : skeleton) {
        for (const Vec3& p : line) {
            EXPECT_LT(std::hypot(std::hypot(p.x(), p.y()) - 20, p.z()), .02) << p.transpose();
        }
        // Each ring is joined to the one before.
        const auto along = [](const Vec3& p) { return 20 * std::atan2(p.y(), p.x()); };
        EXPECT_NEAR(along(line.at(1)) - along(line.at(0)), 1, .1);
        EXPECT_GT(along(line[1]), last);
        last = along(line[1]);
    }
}

// Of an octopus with eight arms.
TEST_F(Examples, SkeletonIsATree) {
    const auto printed =
        numbers_in(example("skeleton", {std::string(AGVD_DATA_DIR) + "/organic.ply",
                                        put("root.txt", "v 0\n"), ".1", at("skeleton.obj")}));
    const auto skeleton = lines("skeleton.obj");
    std::map<std::array<double, 3>, int> ends;
    for (const Line& line : skeleton) {
        for (const Vec3& p : line) ++ends[{p.x(), p.y(), p.z()}];
    }
    EXPECT_EQ(ends.size(), skeleton.size() + 1);  // One component without a circle.
    EXPECT_EQ(printed.at(0), ends.size());
    EXPECT_GE(std::count_if(ends.begin(), ends.end(), [](const auto& e) { return e.second == 1; }),
              8);
}

// --- Detour -------------------------------------------------------------------------------------

TEST_F(Examples, DetourRoundASlit) {
    std::string slit;  // From (.2, .5) to (1.8, .5).
    for (int c = 8; c < 72; ++c) {
        slit += std::to_string(20 * 81 + c) + ' ' + std::to_string(20 * 81 + c + 1) + '\n';
    }
    const std::string out =
        example("detour", {shape("rectangle"), put("slit.txt", slit),
                           put("points.txt", "p 1 .25 0\np 1 .75 0\n"), at("paths.obj")});
    const auto printed = numbers_in(out);
    EXPECT_NEAR(printed.at(1), 2 * std::hypot(.8, .25), 1e-7);
    EXPECT_NEAR(printed.at(2), .5, 1e-7);
    EXPECT_NE(out.find(", locally shortest"), std::string::npos) << out;
    // Straight to one end of the slit, and straight on.
    const auto path = lines("paths.obj").at(0);
    const Vec3 left(.2, .5, 0), right(1.8, .5, 0);
    const Vec3& end = distance_from({path}, left) < 1e-9 ? left : right;
    for (const Vec3& p : path) {
        EXPECT_LT(distance_from({{{1, .25, 0}, end, {1, .75, 0}}}, p), 1e-9) << p.transpose();
    }
}

// A wall on a prism from its lower rim up; unrolled, the way over its top is two straight pieces.
TEST_F(Examples, DetourOnAPrism) {
    constexpr int columns = 24, rows = 20;  // Rows are .1 high.
    const double side = 2 * std::sin(pi / columns);
    const auto vertex = [](int column, int row) {
        return std::to_string((column + columns) % columns * (rows + 1) + row);
    };
    std::string wall;
    for (int row = 0; row < 16; ++row) wall += vertex(0, row) + ' ' + vertex(0, row + 1) + '\n';
    // One column left of it and three columns right of it; and far up, where the wall is not.
    const std::string points = "v " + vertex(-1, 10) + "\nv " + vertex(3, 12) + "\nv " +
                               vertex(-2, 19) + "\nv " + vertex(2, 18) + '\n';
    const std::string out =
        example("detour", {put("prism.obj", shapes::tube(columns, rows)), put("wall.txt", wall),
                           put("points.txt", points), at("paths.obj")});
    const auto printed = numbers_in(out);
    const double over = std::hypot(side, .6) + std::hypot(3 * side, .4);
    const double between = std::hypot(4 * side, .2), free = std::hypot(4 * side, .1);
    ASSERT_LT(over, 20 * side);  // Not round the back.
    EXPECT_NEAR(printed.at(1), over, 1e-7);
    EXPECT_NEAR(printed.at(2), between, 1e-7);
    EXPECT_NEAR(printed.at(4), free, 1e-7);
    EXPECT_NEAR(printed.at(5), free, 1e-7);
    EXPECT_EQ(out.find("not locally"), std::string::npos) << out;
    EXPECT_EQ(lines("paths.obj").size(), 2U);
}

// --- Usage and errors ---------------------------------------------------------------------------

TEST_F(Examples, TellTheirUsageAndWhatIsWrong) {
    int num_programs = 0;
    for (const std::string name : {"balance", "detour", "medial", "ripley", "shapes", "skeleton"}) {
        SCOPED_TRACE(name);
        ++num_programs;
        const std::string program = std::string(EXAMPLES) + "/example-" + name;
        const auto help = run(program.c_str(), {"--help"}), none = run(program.c_str(), {});
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_NE(help.out.find("usage: example-" + name), std::string::npos) << help.out;
        EXPECT_EQ(none.exit_code, 2);
        EXPECT_EQ(none.err, help.out);
        std::vector<std::string> arguments(name == "medial" || name == "shapes" ? 2 : 4,
                                           at("missing"));
        const auto failed = run(program.c_str(), arguments);
        EXPECT_EQ(failed.exit_code, 1);
        EXPECT_NE(failed.err.find("missing"), std::string::npos) << failed.err;
    }
    EXPECT_EQ(num_programs, 6);
}

}  // namespace
