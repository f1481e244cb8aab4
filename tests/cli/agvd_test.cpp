// The program `agvd` as a process.
#include <cmath>
#include <nlohmann/json.hpp>

#include "agvd/diagram/diagram.h"
#include "remesh/meshfile/diagram_file.h"
#include "remesh/meshfile/mesh_file.h"
#include "support/dirty_shapes.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace {

class AgvdDiagram : public Scratch {
protected:
    [[nodiscard]] static process::Outcome diagram(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "diagram");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
};

TEST_F(AgvdDiagram, WritesEveryOutputAskedFor) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = diagram({in, "-n", "20", "-o", at("d.vtp"), "-o", at("d.obj"), "-o",
                                  at("d.ply"), "-o", at("d.agvd")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(bytes("d.vtp").find("site_left"), std::string::npos);
    EXPECT_NE(bytes("d.obj").find("\nl "), std::string::npos);
    for (const char* name : {"d.ply", "d.vtp"}) {
        EXPECT_EQ(remesh::read_mesh(at(name)).mesh.triangles, shapes::sphere(3).triangles) << name;
    }
    EXPECT_EQ(remesh::read_diagram(at("d.agvd")).sites.size(), 20u);
}

TEST_F(AgvdDiagram, WritesArcsWithAChord) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome = diagram({in, "-n", "20", "--max-error", "0", "--chord", "1e-3", "-o",
                                  at("d.agvd"), "-o", at("d.vtp"), "-q"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const agvd::Diagram drawn = remesh::read_diagram(at("d.agvd")).diagram;
    EXPECT_EQ(drawn.edge_arcs.size(), drawn.edges.size() + 1);
    for (const agvd::BisectorArc& arc : drawn.arcs) {
        if (arc.kind == agvd::ArcKind::Chord) continue;
        const agvd::Vec2 p = agvd::point_on_arc(arc, 0.5);
        EXPECT_NEAR((p - arc.focus[0]).norm() + arc.weight[0],
                    (p - arc.focus[1]).norm() + arc.weight[1], 1e-13);
    }
    EXPECT_NE(bytes("d.vtp").find("Name=\"focus_left\""), std::string::npos);
    const auto wrong = diagram({in, "-n", "20", "--chord", "0", "-o", at("d.vtp")});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("the chord is 0; use a number above 0"), std::string::npos)
        << wrong.err;
}

// A diagram needs no topology: the cell of a single site is the whole surface.
TEST_F(AgvdDiagram, OneAndTwoSitesDoOnAnySurface) {
    const std::string torus = put("torus.off", shapes::torus(16, 12));
    agvd::TriangleMesh apart = shapes::grid(2);
    for (agvd::Vec3& p : apart.positions) p.x() += 3;
    const std::string two_grids = put("grids.off", shapes::join(shapes::grid(2), apart));
    for (const std::string& in : {torus, two_grids}) {
        for (const std::size_t n : {1u, 2u}) {
            const auto outcome = diagram({in, "-n", std::to_string(n), "-o", at("d.agvd"), "-q"});
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            const remesh::DiagramFile file = remesh::read_diagram(at("d.agvd"));
            EXPECT_EQ(file.sites.size(), n);
            EXPECT_EQ(agvd::build_cells(file.diagram).neighbours.empty(),
                      n == 1 || in == two_grids);
        }
    }
}

// The site is a quarter below the middle of the slit, the other vertex a quarter above it.
TEST_F(AgvdDiagram, ASlitIsWeldedWithAWarningOrLeftOpen) {
    const std::string in = put("in.off", shapes::slit_grid(8, 2, 6));
    const auto distance_across = [&](std::vector<std::string> options, std::string& err) {
        const std::string sites = put("s", "p .5 .25 0\n");
        options.insert(options.begin(), {in, "-q", "--sites", sites, "-o", at("d.ply")});
        err = diagram(options).err;
        const remesh::MeshFile file =
            remesh::read_mesh(at("d.ply"), remesh::ReadOptions{.with_attributes = true});
        return file.attributes.of_vertices.at(1).values.at(4 * 9 + 6);
    };
    std::string err;
    EXPECT_NEAR(distance_across({}, err), 0.5, 1e-4);
    EXPECT_EQ(err, "") << "shorter than the spacing of one site, 1";
    EXPECT_NEAR(distance_across({"--keep-slits"}, err), std::sqrt(0.5), 1e-4);
    EXPECT_EQ(err, "");
    const auto outcome = diagram({in, "-q", "-n", "20", "-o", at("d.ply")});
    EXPECT_NE(outcome.err.find("a slit of length 0.5 "), std::string::npos) << outcome.err;
}

// A line along a side and a point: the border is a parabola.
TEST_F(AgvdDiagram, SitesMayBeLines) {
    const agvd::TriangleMesh square = shapes::grid(10);
    std::string line = "l";
    for (std::size_t v = 0; v < square.positions.size(); ++v) {
        if (square.positions[v].y() == 0) line += ' ' + std::to_string(v);
    }
    const std::string in = put("in.off", square);
    const std::string sites = put("s", "p .5 .5 0\n" + line + "\n");
    const auto outcome = diagram({in, "--sites", sites, "-q", "-o", at("d.obj"), "-o", at("d.vtp"),
                                  "--cells", at("cells.ply")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const remesh::MeshFile cells =
        remesh::read_mesh(at("cells.ply"), remesh::ReadOptions{.with_attributes = true});
    double area = 0;
    for (std::size_t f = 0; f < cells.mesh.triangles.size(); ++f) {
        if (cells.attributes.of_faces.at(0).values.at(f) != 1) continue;
        const agvd::Triangle& t = cells.mesh.triangles[f];
        const auto& p = cells.mesh.positions;
        area += (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]).norm() / 2;
    }
    EXPECT_NEAR(area, 1.0 / 3, 5e-4);  // Of chords.
}

// Sites 0 and 2 are one, and site 1 starts so late that its border passes at x = .6.
TEST_F(AgvdDiagram, SitesMayHaveSeveralPointsAndStarts) {
    const std::string in = put("in.off", shapes::grid(10));
    const std::string sites = put("s",
                                  "p .5 .5 0 site 0\np .9 .5 0 site 1 start .2\n"
                                  "p .1 .5 0 site 0\np .55 .5 0 site 2 start .3\n");
    for (const char* engine : {"window", "steiner"}) {
        const auto outcome = diagram({in, "--sites", sites, "--engine", engine, "-q", "-o",
                                      at("d.agvd"), "-o", at("d.ply")});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("a site owns nothing, as others are nearer everywhere: 2"),
                  std::string::npos)
            << outcome.err;
        const remesh::DiagramFile file = remesh::read_diagram(at("d.agvd"));
        EXPECT_EQ(file.sites.size(), 4u);
        EXPECT_EQ(file.diagram.num_sites, 3u);
        EXPECT_NEAR(file.diagram.cell_area[0] + file.diagram.cell_area[1], 1, 1e-12);
        EXPECT_EQ(file.diagram.cell_area[2], 0);
        for (std::size_t v = 0; v < file.mesh.positions.size(); ++v) {
            const auto from = [&](double x) {
                return (file.mesh.positions[v] - agvd::Vec3(x, .5, 0)).norm();
            };
            const double own = std::min(from(.1), from(.5)), other = from(.9) + .2;
            EXPECT_NEAR(file.diagram.nearest_distance[v], std::min(own, other), 1e-2) << v;
            if (std::abs(own - other) < 1e-2) continue;
            EXPECT_EQ(file.diagram.nearest_site[v].value(), own < other ? 0u : 1u) << v;
        }
        const auto compared =
            run(AGVD_PROGRAM, {"compare", at("d.agvd"), "exact", "--report", "-", "-q"});
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        const auto report = nlohmann::json::parse(compared.out);
        EXPECT_LT(report.at("wrong_label_percent").get<double>(), 1) << compared.out;
        EXPECT_LT(report.at("bisector_error_a").at("max").get<double>(), 0.05) << compared.out;
    }
    const std::string plain = put("plain", "p .5 .5 0\n");
    EXPECT_EQ(diagram({in, "--sites", plain, "-q", "-o", at("plain.agvd")}).exit_code, 0);
    EXPECT_EQ(run(AGVD_PROGRAM, {"compare", at("d.agvd"), at("plain.agvd")}).exit_code, 4);
}

TEST_F(AgvdDiagram, CellsAreFacesOfACutMesh) {
    const std::string in = put("in.off", shapes::sphere(3));
    const auto outcome =
        diagram({in, "-n", "20", "-o", at("d.agvd"), "--cells", at("cut.ply"), "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const remesh::DiagramFile file = remesh::read_diagram(at("d.agvd"));
    const remesh::MeshFile cut =
        remesh::read_mesh(at("cut.ply"), remesh::ReadOptions{.with_attributes = true});
    const std::vector<double>& sites = cut.attributes.of_faces.at(0).values;
    ASSERT_EQ(sites.size(), cut.mesh.triangles.size());
    std::vector<double> area(20, 0);
    for (std::size_t f = 0; f < sites.size(); ++f) {
        area.at(static_cast<std::size_t>(sites[f])) +=
            agvd::doubled_normal(cut.mesh.positions, cut.mesh.triangles[f]).norm() / 2;
    }
    for (std::size_t s = 0; s < 20; ++s) EXPECT_NEAR(area[s], file.diagram.cell_area[s], 1e-11);
    EXPECT_EQ(diagram({in, "-n", "3", "-o", at("e.ply"), "--cells", at("e.obj")}).exit_code, 3);
    EXPECT_EQ(diagram({in, "-n", "3", "-o", at("e.ply"), "--cells", at("e.ply")}).exit_code, 2);
    EXPECT_EQ(num_files(), 3u);
}

// Two squares and a degenerate face, which cleaning drops; the vertices' value is x + 2 y.
TEST_F(AgvdDiagram, CellsHaveTheValuesOfTheInput) {
    const std::string in = put("in.ply",
                               "ply\nformat ascii 1.0\nelement vertex 7\nproperty double x\n"
                               "property double y\nproperty double z\nproperty double value\n"
                               "element face 3\nproperty list uchar int vertex_indices\n"
                               "property int part\nproperty int site\nend_header\n"
                               "0 0 0 0\n1 0 0 1\n2 0 0 2\n0 1 0 2\n1 1 0 3\n2 1 0 4\n3 0 0 0\n"
                               "3 0 1 1 9 8\n4 0 1 4 3 5 8\n4 1 2 5 4 6 8\n");
    const std::string sites = put("s", "p .5 .2 0\np 1.4 .9 0\np 1.7 .3 0\n");
    ASSERT_EQ(diagram({in, "--sites", sites, "--cells", at("cut.ply"), "-q"}).exit_code, 0);
    const remesh::MeshFile cut =
        remesh::read_mesh(at("cut.ply"), remesh::ReadOptions{.with_attributes = true});
    ASSERT_EQ(cut.attributes.of_vertices.size(), 1u);
    EXPECT_GT(cut.mesh.positions.size(), 7u);
    for (std::size_t v = 0; v < cut.mesh.positions.size(); ++v) {
        const agvd::Vec3& p = cut.mesh.positions[v];
        EXPECT_NEAR(cut.attributes.of_vertices[0].values[v], p.x() + 2 * p.y(), 1e-12) << v;
    }
    ASSERT_EQ(cut.attributes.of_faces.size(), 2u);
    EXPECT_EQ(cut.attributes.of_faces[0].name, "site");
    EXPECT_EQ(cut.attributes.of_faces[1].name, "part");
    for (std::size_t f = 0; f < cut.mesh.triangles.size(); ++f) {
        const agvd::Triangle& t = cut.mesh.triangles[f];
        const auto& p = cut.mesh.positions;
        const double x = (p[t[0]].x() + p[t[1]].x() + p[t[2]].x()) / 3;
        EXPECT_EQ(cut.attributes.of_faces[1].values[f], x < 1 ? 5 : 6) << f;
        EXPECT_LT(cut.attributes.of_faces[0].values[f], 3) << f;
    }
}

TEST_F(AgvdDiagram, SitesMayLieInDirtyMeshes) {
    // Face 0 is degenerate and dropped in cleaning; sites keep the numbers of the file. One end of
    // it is a corner of the square, the other is nowhere on the surface.
    const std::string in =
        put("in.off", "OFF\n5 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n5 5 0\n3 0 0 4\n3 0 1 2\n3 0 2 3\n");
    EXPECT_EQ(
        diagram({in, "--sites", put("s", "f 0 1 0 0\nf 1 0 1 0\nf 2 0 0 1\n"), "-o", at("d.ply")})
            .exit_code,
        0);
    EXPECT_EQ(diagram({in, "--sites", put("s", "f 0 0 0 1\n"), "-o", at("d.ply")}).exit_code, 4);
}

TEST_F(AgvdDiagram, AComponentWithoutASiteIsToldAndWritten) {
    const std::string in =
        put("in.off", shapes::join(shapes::sphere(1), shapes::moved(shapes::sphere(1), {3, 0, 0})));
    const auto outcome = diagram({in, "--sites", put("s", "v 0\n"), "-q", "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("42 vertices"), std::string::npos) << outcome.err;
    EXPECT_EQ(remesh::read_mesh(at("d.ply")).mesh.positions.size(), 84u);
}

TEST_F(AgvdDiagram, TellsTheEngineAndWhatItCertifies) {
    const std::string in = put("in.off", shapes::sphere(2));
    const auto outcome = diagram({in, "-n", "20", "--engine", "steiner", "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("steiner engine, error unknown"), std::string::npos) << outcome.err;
}

TEST_F(AgvdDiagram, StopsAboveTheMemoryLimitAndNamesTheStage) {
    const std::string in = put("in.off", shapes::sphere(2));
    put("out.ply", "old");
    const auto outcome =
        run(AGVD_PROGRAM, {"diagram", in, "-n", "5", "-o", at("out.ply"), "--memory-limit", "1M"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("stage: read"), std::string::npos) << outcome.err;
    EXPECT_EQ(bytes("out.ply"), "old");
    EXPECT_EQ(num_files(), 2u);
}

TEST_F(AgvdDiagram, ExitCodes) {
    const std::string in = put("in.off", shapes::sphere(1));
    EXPECT_EQ(run(AGVD_PROGRAM, {}).exit_code, 2);
    EXPECT_EQ(run(AGVD_PROGRAM, {"--help"}).exit_code, 0);
    EXPECT_EQ(diagram({"--help"}).exit_code, 0);
    EXPECT_EQ(diagram({in}).exit_code, 2);
    EXPECT_EQ(diagram({in, "-n", "5", "-o", at("d.ply"), "-o", at("./d.ply")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "-n", "0", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--engine", "magic", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--max-error", "1", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "--engine=steiner", "--max-error=0", "-o", at("d.vtp")}).exit_code, 2);
    EXPECT_EQ(diagram({in, "-o", at("d.stl")}).exit_code, 3);
    EXPECT_EQ(diagram({in, "-o", at("no/d.vtp")}).exit_code, 3);
    EXPECT_EQ(diagram({at("missing.off"), "-o", at("d.vtp")}).exit_code, 3);
    EXPECT_EQ(diagram({in, "--sites", at("missing"), "-o", at("d.vtp")}).exit_code, 3);
}

TEST_F(AgvdDiagram, RepeatedSitesAreToldAndSitesFarFromTheMeshRefused) {
    const std::string in = put("in.off", shapes::sphere(2));
    const std::string sites = put("sites.txt", "v 0\nv 3\nv 0\n");
    const auto outcome = diagram({in, "-q", "--sites", sites, "-o", at("d.ply")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("sites.txt: line 3: the site lies exactly"), std::string::npos)
        << outcome.err;
    put("sites.txt", "v 0\np 0 0 9\n");
    EXPECT_EQ(diagram({in, "--sites", sites, "-o", at("far.ply")}).exit_code, 4);
    EXPECT_EQ(num_files(), 3u);
}

TEST_F(AgvdDiagram, AFaultySiteIsNamedWithItsFile) {
    // The last face has no area and lies apart from the others.
    const std::string in = put("in.off",
                               "OFF\n7 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n5 0 0\n6 0 0\n7 0 0\n"
                               "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n3 4 5 6\n");
    const std::string sites = put("sites.txt", "v 0\nf 4 .2 .3 .5\n");
    const auto outcome = diagram({in, "--sites", sites, "-o", at("d.vtp")});
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("sites.txt: site 1 lies on face 4"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(num_files(), 2u);
}

class AgvdCompare : public AgvdDiagram {
protected:
    [[nodiscard]] static process::Outcome compare(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "compare");
        return run(AGVD_PROGRAM, std::move(arguments));
    }
    // A diagram of the mesh, as a file.
    [[nodiscard]] std::string diagram_file(const std::string& name, const std::string& mesh,
                                           std::vector<std::string> options) const {
        options.insert(options.begin(), {mesh, "-q", "-o", at(name)});
        const auto outcome = diagram(std::move(options));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return at(name);
    }
    [[nodiscard]] static nlohmann::json figures(const std::string& a, const std::string& b) {
        const auto outcome = compare({a, b, "--report", "-", "-q"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        return nlohmann::json::parse(outcome.out);
    }

    std::string mesh_ = put("in.off", shapes::jitter(shapes::sphere(3), 0.01, 3));
};

TEST_F(AgvdCompare, JudgesADiagramByAnotherAndByTheExactOne) {
    const std::string coarse =
        diagram_file("coarse.agvd", mesh_, {"-n", "12", "--engine=steiner", "--steiner-points=0"});
    const std::string exact = diagram_file("exact.agvd", mesh_, {"-n", "12", "--max-error", "0"});
    const auto by_file = figures(coarse, exact);
    EXPECT_EQ(by_file["sites"], 12);
    EXPECT_EQ(by_file["frechet"]["matched_loops"], 12);
    EXPECT_GT(by_file["frechet"]["sum_mesh_units"], 0);
    EXPECT_GT(by_file["frechet"]["delta"], 0);
    EXPECT_LT(by_file["frechet"]["delta"], 1);
    EXPECT_GT(by_file["bisector_error_a"]["mean"],
              10 * by_file["bisector_error_b"]["mean"].get<double>());
    auto by_exact = figures(coarse, "exact");
    EXPECT_EQ(by_exact["b"], "exact");
    by_exact["b"] = exact;
    EXPECT_EQ(by_exact, by_file);
    const auto none = figures(exact, "exact");
    EXPECT_EQ(none["frechet"]["sum_mesh_units"], 0);
    EXPECT_EQ(none["wrong_label_percent"], 0);
    EXPECT_LT(none["hausdorff_mesh_units"], 1e-12);
}

// A line along a side, a region in a corner of the unit square, and a site of two points.
TEST_F(AgvdCompare, SitesMayBeLinesAndRegions) {
    const agvd::TriangleMesh square = shapes::grid(10);
    std::string line = "l";
    for (std::size_t v = 0; v < square.positions.size(); ++v) {
        if (square.positions[v].y() == 0) line += ' ' + std::to_string(v);
    }
    const std::string in = put("square.off", square);
    const std::string points = "p .5 .5 0 site 0\np .2 .7 0 site 0 start .05\n";
    const std::string sites = put("s", points + line + " site 1 start .02\nr 198 199 site 2\n");
    const std::string exact = diagram_file("exact.agvd", in, {"--sites", sites, "--max-error=0"});
    const auto none = figures(exact, "exact");
    EXPECT_EQ(none["sites"], 3);
    EXPECT_EQ(none["frechet"]["sum_mesh_units"], 0);
    EXPECT_EQ(none["wrong_label_percent"], 0);
    EXPECT_LT(none["bisector_error_a"]["max"], 5e-3);  // Of chords.
    EXPECT_GT(none["bisector_error_a"]["points"], 100);
    for (const char* engine : {"--engine=window", "--engine=steiner"}) {
        const auto found =
            figures(diagram_file("a.agvd", in, {"--sites", sites, "--force", engine}), exact);
        EXPECT_EQ(found["frechet"]["unmatched_loops"], 0) << engine;
        EXPECT_LT(found["bisector_error_a"]["max"], 0.05) << engine;
        EXPECT_LT(found["wrong_label_percent"], 1) << engine;
    }
    const std::string other = put("other", points + line + " site 1 start .02\nr 198 site 2\n");
    const auto outcome = compare({exact, diagram_file("b.agvd", in, {"--sites", other})});
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_NE(outcome.err.find("different lines or regions"), std::string::npos) << outcome.err;
}

TEST_F(AgvdCompare, PrintsATableOrWritesAFile) {
    const std::string a = diagram_file("a.agvd", mesh_, {"-n", "5"});
    const auto outcome = compare({a, "exact", "--json", at("out.json")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const char* word : {"Frechet sum", "delta", "Hausdorff", "|dA - dB|", "5 sites"}) {
        EXPECT_NE(outcome.out.find(word), std::string::npos) << word << " in\n" << outcome.out;
    }
    EXPECT_EQ(nlohmann::json::parse(bytes("out.json"))["program"], "agvd compare");
    const auto quick = compare({a, "exact", "-q", "--points", "0"});
    EXPECT_EQ(quick.exit_code, 0) << quick.err;
    EXPECT_NE(quick.out.find("not measured"), std::string::npos) << quick.out;
}

TEST_F(AgvdCompare, OtherMeshesAndSitesAreRefused) {
    const std::string a = diagram_file("a.agvd", mesh_, {"-n", "5"});
    const std::string other_mesh =
        diagram_file("b.agvd", put("other.off", shapes::sphere(3)), {"-n", "5"});
    const std::string more_sites = diagram_file("c.agvd", mesh_, {"-n", "6"});
    const std::string other_sites = diagram_file("d.agvd", mesh_, {"-n", "5", "--seed", "2"});
    const auto expect_refused = [&](const std::string& b, const char* why) {
        const auto outcome = compare({a, b});
        EXPECT_EQ(outcome.exit_code, 4);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    };
    expect_refused(other_mesh, "different meshes");
    expect_refused(more_sites, "different sites (5 and 6");
    expect_refused(other_sites, "different sites (5 and 5");
    // The sites of one are the first of the other.
    const std::string two = diagram_file("e.agvd", mesh_, {"--sites", put("s", "v 0\nv 7\n")});
    const std::string three =
        diagram_file("f.agvd", mesh_, {"--sites", put("s", "v 0\nv 7\nv 20\n")});
    for (const auto& [first, second] : {std::pair(two, three), {three, two}}) {
        const auto outcome = compare({first, second});
        EXPECT_EQ(outcome.exit_code, 4);
        EXPECT_NE(outcome.err.find("first differ at site 2"), std::string::npos) << outcome.err;
    }
}

TEST_F(AgvdCompare, ExitCodes) {
    const std::string a = diagram_file("a.agvd", mesh_, {"-n", "5"});
    EXPECT_EQ(compare({"--help"}).exit_code, 0);
    EXPECT_EQ(compare({a}).exit_code, 2);
    EXPECT_EQ(compare({a, "exact", "--spacing", "0"}).exit_code, 2);
    EXPECT_EQ(compare({a, "exact", "--samples", "0"}).exit_code, 2);
    EXPECT_EQ(compare({at("missing.agvd"), "exact"}).exit_code, 3);
    EXPECT_EQ(compare({a, at("missing.agvd")}).exit_code, 3);
    EXPECT_EQ(compare({a, "exact", "--report", at("no/out.json")}).exit_code, 3);
    // A mesh without a diagram, and what is no PLY at all.
    const auto outcome = compare({put("mesh.ply", shapes::sphere(1)), "exact"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.err.find("agvd diagram"), std::string::npos) << outcome.err;
    EXPECT_EQ(compare({mesh_, "exact"}).exit_code, 3);
    // An input is never overwritten.
    const std::string before = bytes("a.agvd");
    EXPECT_EQ(compare({a, "exact", "--json", a}).exit_code, 2);
    EXPECT_EQ(bytes("a.agvd"), before);
}

}  // namespace
