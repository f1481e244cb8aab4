// The subcommand `distance` of the program `agvd` as a process.
#include <cmath>
#include <sstream>

#include "remesh/meshfile/mesh_file.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class AgvdDistance : public Scratch {
protected:
    [[nodiscard]] static process::Outcome distance(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "distance");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
    [[nodiscard]] std::vector<double> column(const std::string& name, std::size_t index) const {
        const remesh::MeshFile file =
            remesh::read_mesh(at(name), remesh::ReadOptions{.with_attributes = true});
        return file.attributes.of_vertices.at(index).values;
    }
    const agvd::TriangleMesh square_ = shapes::grid(7);
    const std::string in_ = put("in.off", square_);
    const std::string sites_ = put("s", "p .1 .2 0\np .9 .9 0\n");
};

TEST_F(AgvdDistance, OfVerticesIsAPropertyOfTheMesh) {
    for (const bool has_radius : {false, true}) {
        std::vector<std::string> arguments{in_, "--sites", sites_, "-o", at("d.ply"), "-q"};
        if (has_radius) arguments.insert(arguments.end(), {"--radius", ".4"});
        const auto outcome = distance(arguments);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const std::vector<double> sites = column("d.ply", 0), distances = column("d.ply", 1);
        for (std::size_t v = 0; v < square_.positions.size(); ++v) {
            const double a = (square_.positions[v] - agvd::Vec3(.1, .2, 0)).norm();
            const double b = (square_.positions[v] - agvd::Vec3(.9, .9, 0)).norm();
            if (has_radius && std::min(a, b) > .4) {
                EXPECT_EQ(sites[v], -1);
                EXPECT_TRUE(std::isinf(distances[v]));
            } else {
                EXPECT_EQ(sites[v], a < b ? 0 : 1);
                EXPECT_NEAR(distances[v], std::min(a, b), 1e-14);
            }
        }
    }
}

TEST_F(AgvdDistance, CountsFromTheStartsOfPoints) {
    const std::string sites = put("late", "p .1 .2 0\np .9 .9 0 start .3\n");
    const auto outcome = distance({in_, "--sites", sites, "-o", at("d.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> found = column("d.ply", 0), distances = column("d.ply", 1);
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        const double a = (square_.positions[v] - agvd::Vec3(.1, .2, 0)).norm();
        const double b = (square_.positions[v] - agvd::Vec3(.9, .9, 0)).norm() + .3;
        EXPECT_EQ(found[v], a < b ? 0 : 1);
        EXPECT_NEAR(distances[v], std::min(a, b), 1e-14);
    }
    EXPECT_EQ(distance({in_, "--sites", sites_, "--targets", sites, "-o", at("t.csv")}).exit_code,
              4);
}

// The lowest row of vertices, and the face at the corner opposite.
TEST_F(AgvdDistance, SitesMayBeLinesAndRegions) {
    std::string row = "l";
    agvd::Index corner = 0;
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        if (square_.positions[v].y() == 0) row += ' ' + std::to_string(v);
    }
    for (std::size_t f = 0; f < square_.triangles.size(); ++f) {
        const agvd::Triangle& t = square_.triangles[f];
        for (const agvd::Index v : t) {
            if (square_.positions[v] == agvd::Vec3(1, 1, 0)) corner = static_cast<agvd::Index>(f);
        }
    }
    const std::string sites = put("shapes", row + "\nr " + std::to_string(corner) + "\n");
    const auto outcome = distance({in_, "--sites", sites, "-o", at("d.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> found = column("d.ply", 0), distances = column("d.ply", 1);
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        const double y = square_.positions[v].y();
        if (found[v] == 0) {
            EXPECT_NEAR(distances[v], y, 1e-14);
        } else {
            EXPECT_LE(distances[v], y);
        }
    }
    for (const agvd::Index v : square_.triangles[corner]) EXPECT_EQ(distances[v], 0);
    // Of both sites at each vertex, the nearer one is that of above.
    ASSERT_EQ(
        distance({in_, "--sites", sites, "--nearest", "2", "-o", at("k.ply"), "-q"}).exit_code, 0);
    EXPECT_EQ(column("k.ply", 1), distances);
    const std::vector<double> second = column("k.ply", 2), farther = column("k.ply", 3);
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        EXPECT_EQ(second[v], 1 - found[v]);
        if (second[v] == 0) {
            EXPECT_NEAR(farther[v], square_.positions[v].y(), 1e-14);
        }
    }
    EXPECT_EQ(distance({in_, "--sites", put("gap", "l 0 60\n"), "-o", at("k.ply")}).exit_code, 4);
}

// The positions are those of the square, drawn twice as wide.
TEST_F(AgvdDistance, LengthsMayStandForPositions) {
    agvd::TriangleMesh wide = square_;
    for (agvd::Vec3& p : wide.positions) p.x() *= 2;
    const std::string in = put("wide.off", wide);
    std::ostringstream edges;
    edges.precision(17);
    for (const agvd::Triangle& t : square_.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const agvd::Index a = t[k], b = t[(k + 1) % 3];
            edges << a << ' ' << b << ' ' << (square_.positions[a] - square_.positions[b]).norm()
                  << '\n';
        }
    }
    const std::string lengths = put("lengths", edges.str()), sites = put("v", "v 9\nv 50\n");
    const auto outcome =
        distance({in, "--sites", sites, "--edge-lengths", lengths, "-o", at("d.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> distances = column("d.ply", 1);
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        const double a = (square_.positions[v] - square_.positions[9]).norm();
        const double b = (square_.positions[v] - square_.positions[50]).norm();
        EXPECT_NEAR(distances[v], std::min(a, b), 1e-12);
    }
    // By its own lengths the mesh gives the same bytes.
    ASSERT_EQ(distance({in_, "--sites", sites, "-o", at("own.ply"), "-q"}).exit_code, 0);
    const std::string before = bytes("own.ply");
    ASSERT_EQ(distance({in_, "--sites", sites, "--edge-lengths", lengths, "-o", at("own.ply"),
                        "--force", "-q"})
                  .exit_code,
              0);
    EXPECT_EQ(bytes("own.ply"), before);
    for (const char* output : {"c.ply", "c.vtp"}) {
        EXPECT_EQ(run(AGVD_PROGRAM, {"diagram", in, "--sites", sites, "--edge-lengths", lengths,
                                     "-o", at(output), "-q"})
                      .exit_code,
                  0);
    }
    const auto refused = [&](const std::string& name, std::vector<std::string> options) {
        options.insert(options.begin(), {in, "--edge-lengths", name, "-q", "-o", at("no.ply")});
        return distance(std::move(options)).exit_code;
    };
    EXPECT_EQ(refused(lengths, {"-n", "3"}), 2);
    EXPECT_EQ(refused(lengths, {"--sites", sites, "--barriers", sites}), 2);
    EXPECT_EQ(refused(put("few", "0 1 .1\n"), {"--sites", sites}), 4);
    EXPECT_EQ(refused(put("more", edges.str() + "0 30 1\n"), {"--sites", sites}), 4);
    EXPECT_EQ(refused(put("two", edges.str() + "0 1 7\n"), {"--sites", sites}), 4);
    EXPECT_EQ(refused(put("bad", "0 1\n"), {"--sites", sites}), 3);
    EXPECT_EQ(run(AGVD_PROGRAM,
                  {"diagram", in, "--sites", sites, "--edge-lengths", lengths, "-o", at("c.agvd")})
                  .exit_code,
              2);
}

// The open plane has .5.
TEST_F(AgvdDistance, NoPathCrossesABarrier) {
    agvd::TriangleMesh mesh = shapes::grid(40);
    for (agvd::Vec3& p : mesh.positions) p *= 2;
    const std::string in = put("large.off", mesh);
    std::string edges = "# from (.2, 1) to (1.8, 1)\n";
    for (int column = 4; column < 36; ++column) {
        edges +=
            std::to_string(41 * column + 20) + ' ' + std::to_string(41 * (column + 1) + 20) + '\n';
    }
    const std::string barriers = put("slit", edges), sites = put("site", "p 1 .75 0\n");
    const auto outcome = distance({in, "--sites", sites, "--barriers", barriers, "--targets",
                                   put("t", "p 1 1.25 0\n"), "-o", at("t.csv"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(bytes("t.csv").find("0,1.67630546"), std::string::npos) << bytes("t.csv");
    ASSERT_EQ(
        distance({in, "--sites", sites, "--barriers", barriers, "-o", at("d.ply"), "-q"}).exit_code,
        0);
    EXPECT_EQ(column("d.ply", 1).size(), mesh.positions.size());
    EXPECT_NEAR(column("d.ply", 1)[41 * 20 + 25], 1.67630546, 1e-8);
    for (const char* engine : {"window", "steiner"}) {
        const auto diagram =
            run(AGVD_PROGRAM, {"diagram", in, "--sites", sites, "--barriers", barriers, "--engine",
                               engine, "-o", at("c.ply"), "-o", at("c.agvd"), "-q"});
        ASSERT_EQ(diagram.exit_code, 0) << diagram.err;
        EXPECT_NEAR(column("c.ply", 1)[41 * 20 + 25], 1.67630546, 1e-2);
        EXPECT_EQ(run(AGVD_PROGRAM, {"compare", at("c.agvd"), "exact", "-q"}).exit_code, 0);
    }
    const auto on_it =
        distance({in, "--sites", put("on", "v 840\n"), "--barriers", barriers, "--targets",
                  put("both", "p 1 1.1 0\np 1 .9 0\n"), "-o", at("t.csv")});
    ASSERT_EQ(on_it.exit_code, 0) << on_it.err;
    EXPECT_NE(on_it.err.find("sites on barriers count on both sides"), std::string::npos);
    EXPECT_NE(bytes("t.csv").find("\n0,0.1000000000000"), std::string::npos) << bytes("t.csv");
    EXPECT_NE(bytes("t.csv").find("\n0,0.0999999999999"), std::string::npos) << bytes("t.csv");
    const auto wrong = distance(
        {in, "--sites", sites, "--barriers", put("wrong", "0 100\n"), "-o", at("no.ply"), "-q"});
    EXPECT_EQ(wrong.exit_code, 4);
    EXPECT_NE(wrong.err.find("wrong"), std::string::npos) << wrong.err;
    EXPECT_EQ(
        distance({in, "--sites", sites, "--barriers", at("none"), "-o", at("no.ply")}).exit_code,
        3);
}

// Vertex 1 is in no face, 3 is at the place of 0, and the last face has no area.
TEST_F(AgvdDistance, KeepsTheNumbersOfTheInput) {
    const std::string in =
        put("in.off",
            agvd::TriangleMesh{
                {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, 0, 0}},
                {{0, 2, 4}, {3, 4, 5}, {0, 3, 6}}});
    ASSERT_EQ(distance({in, "--sites", put("s", "v 2\n"), "-o", at("d.ply"), "-q"}).exit_code, 0);
    const double inf = agvd::infinity;
    EXPECT_EQ(column("d.ply", 0), (std::vector<double>{0, -1, 0, 0, 0, 0, -1}));
    EXPECT_EQ(column("d.ply", 1), (std::vector<double>{1, inf, 0, 1, std::sqrt(2), 2, inf}));
}

TEST_F(AgvdDistance, OfTargetsIsATable) {
    const auto outcome =
        distance({in_, "--sites", sites_, "--targets", put("t", "p .5 .3 0\np .8 .7 0\nv 0\n"),
                  "--radius", ".3", "-o", at("t.csv"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    std::istringstream table(bytes("t.csv"));
    std::string line;
    ASSERT_TRUE(std::getline(table, line));
    EXPECT_EQ(line, "site,distance");
    ASSERT_TRUE(std::getline(table, line));
    EXPECT_EQ(line, "-1,inf");
    for (const char* site : {"1,", "0,"}) {
        ASSERT_TRUE(std::getline(table, line));
        EXPECT_EQ(line.substr(0, 2), site);
        EXPECT_NEAR(std::stod(line.substr(2)), std::hypot(.1, .2), 1e-14);
    }
    EXPECT_FALSE(std::getline(table, line));
}

TEST_F(AgvdDistance, OfTheNearestSitesIsRanked) {
    const auto outcome =
        distance({in_, "--sites", sites_, "--nearest", "2", "-o", at("d.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::vector<double> first = column("d.ply", 0), second = column("d.ply", 2);
    const std::vector<double> near = column("d.ply", 1), far = column("d.ply", 3);
    for (std::size_t v = 0; v < square_.positions.size(); ++v) {
        const double a = (square_.positions[v] - agvd::Vec3(.1, .2, 0)).norm();
        const double b = (square_.positions[v] - agvd::Vec3(.9, .9, 0)).norm();
        EXPECT_EQ(first[v], a < b ? 0 : 1);
        EXPECT_EQ(second[v], a < b ? 1 : 0);
        EXPECT_NEAR(near[v], std::min(a, b), 1e-14);
        EXPECT_NEAR(far[v], std::max(a, b), 1e-14);
    }
}

TEST_F(AgvdDistance, RefusesWhatItCannotDoAndWritesNothing) {
    struct Case {
        std::vector<std::string> arguments;
        int exit_code;
        std::string text;
    };
    const std::string out = at("d.ply"), table = at("d.csv");
    const std::vector<Case> cases{
        {{in_, "--sites", sites_, "-o", table}, 3, ".ply, .vtp or .vtk"},
        {{in_, "--sites", sites_, "-o", at("d.off")}, 3, ".ply, .vtp or .vtk"},
        {{in_, "--sites", sites_, "--targets", sites_, "-o", out}, 3, ".csv"},
        {{in_, "--sites", sites_, "--radius", "0", "-o", out}, 2, "above 0"},
        {{in_, "--sites", sites_, "--nearest", "0", "-o", out}, 2, "above 0"},
        {{in_, "--sites", sites_, "--nearest", "2", "--radius", "1", "-o", out}, 2, "--radius"},
        {{in_, "--sites", sites_, "--targets", at("none"), "-o", table}, 3, "none"},
        {{in_, "--sites", sites_, "--targets", put("x", "v 999\n"), "-o", table}, 4, "999"},
    };
    for (const Case& c : cases) {
        const auto outcome = distance(c.arguments);
        EXPECT_EQ(outcome.exit_code, c.exit_code) << outcome.err;
        EXPECT_NE(outcome.err.find(c.text), std::string::npos) << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(out));
        EXPECT_FALSE(std::filesystem::exists(table));
    }
}

}  // namespace
