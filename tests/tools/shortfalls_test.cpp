// What the program and the Python module warn of, from results that are filled by hand.
#include "shortfalls.h"

#include <gtest/gtest.h>

#include "agvd/core/error.h"

namespace {

using remesh::RemeshResult;
using Warnings = std::vector<std::string>;

std::string refusal_of(const RemeshResult& result) {
    try {
        static_cast<void>(cli::shortfalls_of(result, {}, true));
    } catch (const agvd::ConstraintUnmet& error) {
        return error.what();
    }
    return "";
}

TEST(Shortfalls, AResultThatHasAllIsNeitherWarnedOfNorRefused) {
    EXPECT_EQ(cli::shortfalls_of({}, {}, true), Warnings());
}

TEST(Shortfalls, CrossingsAreWarnedOfAndRefusedIfStrict) {
    RemeshResult result;
    result.self_intersections = 3;
    EXPECT_EQ(cli::shortfalls_of(result, {}, false),
              Warnings{"the result has 3 pairs of intersecting faces, the input has 0; use more "
                       "--samples"});
    EXPECT_NE(refusal_of(result).find("3 pairs"), std::string::npos) << refusal_of(result);
    result.new_self_intersections = 2;
    result.crossing_near = {1, 2.5, -3};
    EXPECT_EQ(cli::shortfalls_of(result, {}, false),
              Warnings{"the result has 3 pairs of intersecting faces, the input has 0, one near 1 "
                       "2.5 -3; use more --samples"});
    result.input_self_intersections = 1;
    EXPECT_EQ(cli::shortfalls_of(result, {}, false),
              Warnings{"the result has 3 pairs of intersecting faces, the input has 1; 2 are not "
                       "where the input intersects itself, one near 1 2.5 -3: for these use more "
                       "--samples, for the others repair the input, or use --wrap"});
    result.input_self_intersections = 3;
    EXPECT_EQ(cli::shortfalls_of(result, {}, true), Warnings());
}

// A piece of 10 m of a map.
TEST(Shortfalls, PlacesFarFromTheOriginHaveTheirDigits) {
    RemeshResult result;
    result.mesh.positions.resize(4);
    result.input_topology.components = {{.area = 4}};
    result.verdict.diagonal = 10;
    result.verdict.largest_distance = 2.5;
    result.verdict.farthest = {500123.25, 5400012.5, 3};
    result.self_intersections = 3;
    result.new_self_intersections = 3;
    result.crossing_near = {500124.75, 5400013, 3};
    const Warnings warnings = cli::shortfalls_of(result, {}, false);
    ASSERT_EQ(warnings.size(), 2U);
    EXPECT_NE(warnings[0].find("at 500123.25 5400012.5 3,"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("near 500124.75 5400013 3;"), std::string::npos) << warnings[1];
}

TEST(Shortfalls, WhereLengthsAreGivenShorterOnesAreTheAdvice) {
    RemeshResult result;
    result.self_intersections = 3;
    for (const remesh::Sizing& sizing : {remesh::Sizing{.count = remesh::MeanEdge{1}},
                                         remesh::Sizing{.count = remesh::CountOfLengths{}}}) {
        EXPECT_EQ(cli::shortfalls_of(result, {.sizing = sizing}, false),
                  Warnings{"the result has 3 pairs of intersecting faces, the input has 0; use "
                           "shorter edges"});
    }
}

TEST(Shortfalls, FacesWithoutAreaAreWarnedOfAndRefusedIfStrict) {
    RemeshResult result;
    result.verdict.faces_without_area = 1;
    const Warnings warnings = cli::shortfalls_of(result, {}, false);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("has 1 face without area"), std::string::npos) << warnings[0];
    EXPECT_NE(refusal_of(result).find("1 face without area"), std::string::npos);
}

TEST(Shortfalls, ARefusalNamesTheSamplesThatWouldDoForAll) {
    RemeshResult result;
    result.verdict.thin_walls = 2;
    EXPECT_EQ(refusal_of(result),
              "the result is too coarse for some walls; use more --samples, or leave out --strict");
    result.verdict.samples_for_walls = 700;
    result.features.dropped_length = 1;
    result.features.samples_for_all = 5400;
    EXPECT_EQ(refusal_of(result),
              "the result is too coarse for some creases, walls; use more --samples (about 5400 "
              "would do), or leave out --strict");
    EXPECT_EQ(cli::shortfalls_of(result, {}, false), Warnings());
}

// Four vertices on an area of 4 are a unit apart.
TEST(Shortfalls, ASlitLongerThanTheSpacingIsWarnedOf) {
    RemeshResult result;
    result.mesh.positions.resize(4);
    result.input_topology.components = {{.area = 1}, {.area = 3}};
    result.welded_slit_length = 1.25;
    EXPECT_EQ(
        cli::shortfalls_of(result, {}, false),
        Warnings{"a slit of length 1.25 in mesh units was welded, as its two sides lie at one "
                 "place; use --keep-slits to leave it open, unless it is a seam of a texture"});
    result.welded_slit_length = 0.9;
    EXPECT_EQ(cli::shortfalls_of(result, {}, false), Warnings());
}

// Four vertices on an area of 4, too.
TEST(Shortfalls, APartThatIsFartherThanTwoSpacingsIsWarnedOfAndRefusedIfStrict) {
    RemeshResult result;
    result.mesh.positions.resize(4);
    result.input_topology.components = {{.area = 4}};
    result.verdict.largest_distance = 2.5;
    result.verdict.farthest = {1, 2, 3};
    EXPECT_EQ(cli::shortfalls_of(result, {}, false),
              Warnings{"the result is 2.5 away from the input at 1 2 3, farther than two distances "
                       "of neighbouring vertices; use more --samples"});
    EXPECT_NE(refusal_of(result).find("2.5 away"), std::string::npos);
    result.verdict.largest_distance = 1.9;
    EXPECT_EQ(cli::shortfalls_of(result, {}, true), Warnings());
}

TEST(Shortfalls, ABodyThatIsInsideOutIsWarnedOf) {
    RemeshResult result;
    result.verdict.bodies = {.closed = 3, .inside_out = 1};
    const Warnings warnings = cli::shortfalls_of(result, {}, true);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_NE(warnings[0].find("1 closed body is inside out"), std::string::npos) << warnings[0];
}

// The two sides of a seam of a texture are not told as a slit.
TEST(Shortfalls, ASlitInATextureIsASeam) {
    RemeshResult result;
    result.mesh.positions.resize(4);
    result.input_topology.components = {{.area = 4}};
    result.welded_slit_length = 1.25;
    EXPECT_EQ(cli::shortfalls_of(result, {.texture_seams = {{0, 1}}}, false), Warnings());
}

TEST(Shortfalls, BoundsOfEdgesAndLostSeamsAndJunctionsAreWarnedOf) {
    RemeshResult result;
    result.sizing = {.num_samples = 50, .least_target = 1, .largest_target = 4};
    result.features.seam_length = 3;
    result.features.dropped_seam_length = 1;
    result.junctions.apart_edges = 2;
    remesh::RemeshOptions options;
    options.junctions = remesh::Junctions::Keep;
    options.sizing.min_edge = 2;
    options.sizing.max_edge = 3;
    const Warnings warnings = cli::shortfalls_of(result, options, false);
    ASSERT_EQ(warnings.size(), 4U);
    EXPECT_NE(warnings[0].find("2 non-manifold edges"), std::string::npos) << warnings[0];
    EXPECT_NE(warnings[1].find("25 % of the seams"), std::string::npos) << warnings[1];
    EXPECT_NE(warnings[2].find("few for --max-edge"), std::string::npos) << warnings[2];
    EXPECT_NE(warnings[3].find("many for --min-edge"), std::string::npos) << warnings[3];
}

}  // namespace
