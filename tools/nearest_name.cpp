#include "nearest_name.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace cli {
namespace {

// Letters to insert, remove or replace: Levenshtein's distance, a row of its table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (const char letter : a) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (letter == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_name(std::string_view unknown, std::span<const std::string> names) {
    constexpr std::size_t least_beginning = 5;  // With two dashes.
    std::string nearest;
    std::size_t least = unknown.size() / 3 + 1;
    for (const std::string& name : names) {
        const bool begins = unknown.size() >= least_beginning && name.starts_with(unknown);
        const std::size_t distance = begins ? 1 : edit_distance(unknown, name);
        if (distance >= least) continue;
        least = distance;
        nearest = name;
    }
    return nearest;
}

}  // namespace cli
