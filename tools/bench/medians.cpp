#include "bench/medians.h"

#include <algorithm>
#include <vector>

#include "bench/timing.h"

namespace bench {
namespace {

using Json = nlohmann::ordered_json;

bool same_group(const Json& a, const Json& b) {
    return a.at("sites") == b.at("sites") && a.at("method") == b.at("method") &&
           a.at("threads") == b.at("threads");
}

Json median_row(const std::vector<Json>& group) {
    Json row = group.front();
    row["mesh"] = "median";
    for (auto& [key, value] : row.items()) {
        std::vector<double> values;
        for (const Json& member : group) {
            if (member.contains(key) && member[key].is_number()) values.push_back(member[key]);
        }
        if (!values.empty()) value = median(values);
    }
    return row;
}

}  // namespace

Json medians(const Json& rows) {
    std::vector<std::vector<Json>> groups;
    for (const Json& row : rows) {
        auto group = std::find_if(groups.begin(), groups.end(),
                                  [&](const auto& g) { return same_group(g.front(), row); });
        if (group == groups.end()) group = groups.insert(groups.end(), std::vector<Json>{});
        group->push_back(row);
    }
    Json result = Json::array();
    for (const auto& group : groups) {
        if (group.size() > 1) result.push_back(median_row(group));
    }
    return result;
}

}  // namespace bench
