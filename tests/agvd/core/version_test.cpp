#include "agvd/core/version.h"

#include <gtest/gtest.h>

#include <string>

namespace agvd {
namespace {

TEST(Version, HeadersLibraryAndPackageAgree) {
    const auto joined = std::to_string(version_major) + "." + std::to_string(version_minor) + "." +
                        std::to_string(version_patch);
    EXPECT_EQ(version, joined);
    EXPECT_STREQ(library_version(), version);
    EXPECT_STREQ(PROJECT_VERSION, version);
}

}  // namespace
}  // namespace agvd
