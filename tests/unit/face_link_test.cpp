#include "agvd/intrinsic/face_link.h"

#include <gtest/gtest.h>

using namespace agvd;
using agvd::detail::FaceLink;

TEST(FaceLink, KnowsItsKindPlaceAndSlot) {
    EXPECT_TRUE(FaceLink().is_none());
    EXPECT_FALSE(FaceLink().is_merge());
    for (const Index place : {0U, 1U, 77U, (1U << 30) - 1}) {
        for (const Index slot : {0U, 1U}) {
            const FaceLink link = FaceLink::operation(place, slot);
            EXPECT_FALSE(link.is_none() || link.is_merge());
            EXPECT_EQ(link.place(), place);
            EXPECT_EQ(link.slot(), slot);
        }
    }
    for (const Index place : {0U, 1U, 77U, (1U << 29) - 1}) {
        for (const Index slot : {0U, 1U, 2U}) {
            const FaceLink link = FaceLink::merge(place, slot);
            EXPECT_TRUE(link.is_merge() && !link.is_none());
            EXPECT_EQ(link.place(), place);
            EXPECT_EQ(link.slot(), slot);
        }
    }
}
