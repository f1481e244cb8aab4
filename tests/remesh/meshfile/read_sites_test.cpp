#include "remesh/meshfile/diagram_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "agvd/core/error.h"
#include "support/shapes.h"

using agvd::SurfacePoint;
using agvd::Vec3;
using remesh::read_sites;

namespace {

// A file of the given text, named after the running test.
class ReadSites : public testing::Test {
protected:
    void SetUp() override {
        path_ =
            std::filesystem::path(testing::TempDir()) /
            (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".sites");
    }
    void TearDown() override { std::filesystem::remove(path_); }

    std::vector<SurfacePoint> read(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_sites(path_, mesh_.view()).sites;
    }
    agvd::SitePoints read_roles(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_sites(path_, mesh_.view()).points;
    }
    template <typename Error>
    void expect_error(const std::string& text, const std::string& part) {
        try {
            (void)read(text);
            FAIL() << "no error for: " << text;
        } catch (const Error& error) {
            const std::string what = error.what();
            EXPECT_NE(what.find(part), std::string::npos) << what;
            EXPECT_NE(what.find(path_.string()), std::string::npos) << what;
        }
    }

    agvd::TriangleMesh mesh_ = shapes::grid(2);  // 9 vertices, 8 faces.
    std::filesystem::path path_;
};

}  // namespace

TEST_F(ReadSites, ReadsTheThreeKindsInOrder) {
    const auto sites =
        read("# first sites\n\nv 4\r\n\tf 7 0.5 0.25 .25  # inside\np 0.3 +0.1 .4\nv 8");
    ASSERT_EQ(sites.size(), 4u);
    const auto at = [&](std::size_t i) { return agvd::position(mesh_.view(), sites[i]); };
    EXPECT_EQ(at(0), Vec3(0.5, 0.5, 0));
    EXPECT_EQ(sites[0].face, agvd::FaceId(0));
    EXPECT_EQ(sites[0].barycentric, (std::array{0.0, 0.0, 1.0}));
    EXPECT_EQ(sites[1].face, agvd::FaceId(7));
    EXPECT_EQ(sites[1].barycentric, (std::array{0.5, 0.25, 0.25}));
    EXPECT_LT((at(2) - Vec3(0.3, 0.1, 0)).norm(), 1e-15);
    EXPECT_EQ(at(3), Vec3(1, 1, 0));
}

TEST_F(ReadSites, ScalesBarycentricCoordinatesThatAlmostSumToOne) {
    const auto sites = read("f 0 0.3333333 0.3333333 0.3333333\nf 0 1 -0 0");
    EXPECT_NEAR(sites[0].barycentric[0] + sites[0].barycentric[1] + sites[0].barycentric[2], 1,
                1e-15);
    EXPECT_EQ(sites[1].barycentric[0], 1);
}

TEST_F(ReadSites, PointsMayBelongToSitesAndStartAtDistances) {
    EXPECT_TRUE(read_roles("v 0\nv 1 start 0\n") == agvd::SitePoints{});
    const agvd::SitePoints both =
        read_roles("v 0 site 1\np 1 1 0 start .25 site 0 # far\nv 1 site 1");
    EXPECT_EQ(both.site, (std::vector<agvd::Index>{1, 0, 1}));
    EXPECT_EQ(both.start, (std::vector<double>{0, 0.25, 0}));
    expect_error<agvd::IoError>("v 0 site 0\nv 1\n", "line 2: only some lines say");
    expect_error<agvd::IoError>("v 0\nv 1 site 0\n", "line 2: only some lines say");
    expect_error<agvd::IoError>("v 0 site -1\n", "there is no site -1");
    expect_error<agvd::IoError>("v 0 start x\n", "expected a distance");
    expect_error<agvd::InvalidInput>("v 0 start -1\n", "line 1: the site starts");
    expect_error<agvd::InvalidInput>("v 0 start inf\n", "line 1: the site starts");
    expect_error<agvd::InvalidInput>("v 0 site 0\nv 1 site 2\n", "no point belongs to site 1");
}

// Faces of the file: a quad, which became the triangles 0 and 1, and a triangle.
TEST_F(ReadSites, FacesAreThoseOfTheFile) {
    const agvd::TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                                  {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}}};
    const std::vector<agvd::Index> polygons{0, 0, 1};
    const auto read_all = [&](const std::string& text) {
        std::ofstream(path_) << text;
        return read_sites(path_, mesh.view(), {}, remesh::Repeats::Told, polygons);
    };
    const remesh::SitesFile file =
        read_all("f 1 .5 .25 .25 site 0\nf 0 .5 .25 .25 3 0 2 site 1\nr 0 site 2\n");
    EXPECT_EQ(file.sites[0], (agvd::SurfacePoint{agvd::FaceId(2), {.5, .25, .25}}));
    EXPECT_EQ(file.sites[1], (agvd::SurfacePoint{agvd::FaceId(1), {.25, .25, .5}}));
    EXPECT_EQ(file.shapes[0].faces, (std::vector<agvd::Index>{0, 1}));
    for (const char* text : {"f 0 .5 .25 .25\n", "f 0 .5 .25 .25 0 1 3\n", "f 2 1 0 0\n"}) {
        EXPECT_THROW((void)read_all(text), agvd::InvalidInput) << text;
    }
}

TEST_F(ReadSites, LinesAndRegionsAreSites) {
    const auto read_all = [&](const std::string& text) {
        (void)read(text);
        return read_sites(path_, mesh_.view());
    };
    const remesh::SitesFile file = read_all("l 0 1 2 # a line\nv 8\nr 6 7\n");
    ASSERT_EQ(file.shapes.size(), 2u);
    using Edges = std::vector<std::array<agvd::Index, 2>>;
    EXPECT_EQ(file.shapes[0].edges, (Edges{{0, 1}, {1, 2}}));
    EXPECT_EQ(file.shapes[0].site, 0u);
    EXPECT_EQ(file.shapes[1].faces, (std::vector<agvd::Index>{6, 7}));
    EXPECT_EQ(file.shapes[1].site, 2u);
    EXPECT_EQ(file.sites.size(), 1u);
    EXPECT_EQ(file.points.site, (std::vector<agvd::Index>{1}));
    const remesh::SitesFile one = read_all("r 3 site 0\nl 0 1 site 0\nv 8 site 1 start 2\n");
    EXPECT_EQ(one.shapes[1].site, 0u);
    EXPECT_EQ(one.points.start, (std::vector<double>{2}));
    expect_error<agvd::IoError>("l 1\n", "a line has two vertices");
    expect_error<agvd::IoError>("r\n", "a region has one face");
    EXPECT_EQ(read_all("l 0 1 start 2\nr 3 start .5\n").shapes[0].start, 2);
    EXPECT_EQ(read_all("l 0 1 start 2\nr 3 start .5\n").shapes[1].start, 0.5);
    expect_error<agvd::InvalidInput>("l 0 1 start -1\n", "line 1: the site starts");
    expect_error<agvd::IoError>("l 0 1 site 0\nv 1\n", "only some lines say");
    expect_error<agvd::InvalidInput>("l 0 1 site 1\n", "no point belongs to site 0");
    expect_error<agvd::InvalidInput>("l 0 9\n", "vertex 9");
    expect_error<agvd::InvalidInput>("r 8\n", "face 8");
}

TEST_F(ReadSites, NamesFileAndLineOfASyntaxError) {
    expect_error<agvd::IoError>("v 1\nw 2\n", "line 2: a site begins with v, f, p, l or r");
    expect_error<agvd::IoError>("\n\nvertex 2\n", "line 3: a site begins with v, f, p, l or r");
    expect_error<agvd::IoError>("v 1 2\n", "expected the end of the line");
    expect_error<agvd::IoError>("v\nv 1\n", "line 1: expected a vertex index");
    expect_error<agvd::IoError>("f 1 0.5 0.5\n", "expected a barycentric coordinate");
    expect_error<agvd::IoError>("p 1 2\n", "expected a coordinate");
    expect_error<agvd::IoError>("v 1.5\n", "expected a vertex index");
    expect_error<agvd::IoError>("p 1 2 3x\n", "expected a coordinate");
    expect_error<agvd::IoError>("# nothing\n\n", "no site");
    expect_error<agvd::IoError>("", "empty");
}

TEST_F(ReadSites, NamesLineAndElementThatDoNotFitTheMesh) {
    expect_error<agvd::InvalidInput>("\nv 9\n", "line 2: the site names vertex 9");
    expect_error<agvd::InvalidInput>("v -1\n", "vertex -1");
    expect_error<agvd::InvalidInput>("v 99999999999999999999999\n", "too large");
    expect_error<agvd::InvalidInput>("f 8 1 0 0\n", "face 8");
    expect_error<agvd::InvalidInput>("f 0 1.5 -0.5 0\n", "negative");
    expect_error<agvd::InvalidInput>("f 0 0.3 0.3 0.3\n", "sum to 1");
    expect_error<agvd::InvalidInput>("f 0 0.5 0.5 0.00001\n", "sum to 1");
    expect_error<agvd::InvalidInput>("f 0 0.5 0.49999 0\n", "sum to 1");
    expect_error<agvd::InvalidInput>("f 0 nan 0 1\n", "sum to 1");
    expect_error<agvd::InvalidInput>("p 1 2 nan\n", "not finite");
    mesh_.positions.emplace_back(7, 7, 7);
    expect_error<agvd::InvalidInput>("v 9\n", "is in no face");
}

// Four sites on a unit square are half a unit apart.
TEST_F(ReadSites, PointsFarOffTheMeshAreRefusedAndNearOnesTold) {
    const std::string three = "v 0\nv 2\np 1 1 0.004\n";
    expect_error<agvd::InvalidInput>(three + "p .5 .5 -.51", "line 4: the point is 0.51 off");
    expect_error<agvd::InvalidInput>("p .5 .5 7\n" + three, "spacing, 0.5");
    expect_error<agvd::InvalidInput>("p 3 .5 0\np .5 .5 2", "line 1: the point is 2 off");
    (void)read(three + "p .5 .5 -.4");
    const auto told = read_sites(path_, mesh_.view()).warnings;
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("line 4: the point is 0.4 off the mesh"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("the farthest of 1 such point"), std::string::npos) << told[0];
    (void)read(three + "p .5 .5 1e-7");
    EXPECT_TRUE(read_sites(path_, mesh_.view()).warnings.empty());
}

// Whichever faces and kinds of line give the point.
TEST_F(ReadSites, RepeatedSitesAreTold) {
    (void)read("v 4\nv 0\nf 0 0 0 1\np .5 .5 0\nf 0 .2 .3 .5\nf 0 .3 .2 .5\nv 8\n");
    const auto told = read_sites(path_, mesh_.view()).warnings;
    ASSERT_EQ(told.size(), 1u);
    EXPECT_NE(told[0].find("line 3: the site lies exactly where"), std::string::npos) << told[0];
    EXPECT_NE(told[0].find("the first of 2 such sites"), std::string::npos) << told[0];
}

TEST_F(ReadSites, RefusesAMissingFileAndAFolder) {
    EXPECT_THROW((void)read_sites(path_, mesh_.view()), agvd::IoError);
    EXPECT_THROW((void)read_sites(testing::TempDir(), mesh_.view()), agvd::IoError);
}
