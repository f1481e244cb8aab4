#include "option_names.h"

#include <gtest/gtest.h>

namespace {

TEST(OptionNames, TakeThePlaceOfTheLibrarysNames) {
    EXPECT_EQ(cli::with_option_names("use a smaller drop_components"),
              "use a smaller --drop-components");
    EXPECT_EQ(cli::with_option_names("min_edge, max_edge; max_edge"),
              "--min-edge, --max-edge; --max-edge");
    EXPECT_EQ(cli::with_option_names("max_error"), "--max-error");
}

TEST(OptionNames, OtherTextStaysAsItIs) {
    for (const char* text :
         {"", "in/max_error.off: my_max_error", "max_errors '\xc3\xa9'", "an edge, a length"}) {
        EXPECT_EQ(cli::with_option_names(text), text);
    }
}

}  // namespace
