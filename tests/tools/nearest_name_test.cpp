#include "nearest_name.h"

#include <gtest/gtest.h>

namespace {

TEST(NearestName, IsTheOneOfLeastEditDistance) {
    const std::string names[] = {"--edge-length", "--seed", "--max-edge", "--sites", "--site"};
    EXPECT_EQ(cli::nearest_name("--edgelength", names), "--edge-length");
    EXPECT_EQ(cli::nearest_name("--edge_lenght", names), "--edge-length");
    EXPECT_EQ(cli::nearest_name("-edge-length", names), "--edge-length");
    EXPECT_EQ(cli::nearest_name("--maxedge", names), "--max-edge");
    EXPECT_EQ(cli::nearest_name("--sitse", names), "--site") << "one letter less, not two replaced";
    EXPECT_EQ(cli::nearest_name("--sitez", names), "--sites") << "the first of two";
}

TEST(NearestName, IsOneThatBeginsSo) {
    const std::string names[] = {"--seed", "--edge-length"};
    EXPECT_EQ(cli::nearest_name("--edge", names), "--edge-length");
    EXPECT_EQ(cli::nearest_name("--e", names), "") << "too short to tell";
}

TEST(NearestName, IsNoneIfAllAreFar) {
    const std::string names[] = {"--seed", "--edge-length"};
    EXPECT_EQ(cli::nearest_name("--colour", names), "");
    EXPECT_EQ(cli::nearest_name("--seed", {}), "");
}

}  // namespace
