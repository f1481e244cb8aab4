// The tree finds what a look at every relay finds.
#include "agvd/diagram/relay_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/dice.h"

using namespace agvd;

TEST(RelayTree, FindsAllThatAreNearAndNoImageThatIsFar) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Dice dice(seed);
        std::vector<PlanarRelay> relays;
        const Index count = dice.count(0, 300);
        for (Index i = 0; i < count; ++i) {
            const double weight = dice.one_in(2) ? 0 : dice.number(0, 1);
            PlanarRelay relay = point_relay({dice.number(0, 1), dice.number(-1, 1)}, weight, i / 2);
            if (relay.image.y() < 0) {
                relay.begin = {dice.number(0, 0.5), 0};
                relay.end = {dice.number(0.5, 1), 0};
                relay.at_begin = weight + (relay.begin - relay.image).norm();
                relay.at_end = weight + (relay.end - relay.image).norm();
                relay.sees_all = false;
            }
            relays.push_back(relay);
        }
        RelayTree tree;
        tree.build(relays);
        std::vector<Index> found{7};
        for (int i = 0; i < 20; ++i) {
            const Vec2 p(dice.number(0, 1), dice.number(0, 1));
            const double radius = dice.number(0, 1);
            tree.find_near(p, radius, found);
            EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
            for (Index r = 0; r < count; ++r) {
                const bool is_found = std::find(found.begin(), found.end(), r) != found.end();
                EXPECT_TRUE(is_found || reach(relays[r], p).distance > radius);
                const double straight = relays[r].weight + (p - relays[r].image).norm();
                EXPECT_EQ(is_found, straight <= radius);
            }
        }
    }
}
