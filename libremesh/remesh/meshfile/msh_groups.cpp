#include "remesh/meshfile/msh_groups.h"

#include <algorithm>

namespace remesh {
namespace {

// Names are kept of groups below, as value i of a label is called names[i].
constexpr double max_named_group = 1 << 16;

}  // namespace

void MshGroups::add_to(MeshAttributes& attributes, std::int64_t dimension,
                       std::vector<double> groups) {
    Attribute& labels = attributes.of_faces.emplace_back(
        Attribute{.name = msh_group_name, .type = NumberType::Int32, .values = std::move(groups)});
    const auto begin = names_.lower_bound({dimension, 1});
    const auto end = names_.lower_bound({dimension + 1, 0});
    if (begin == end) return;
    const double highest = std::max(static_cast<double>(std::prev(end)->first.second),
                                    std::ranges::max(labels.values));
    if (highest >= max_named_group) {
        attributes.declined.push_back(
            {"names of physical groups", "a group has a number above 65535"});
        return;
    }
    labels.names.resize(static_cast<std::size_t>(highest) + 1);
    for (auto name = begin; name != end; ++name) {
        labels.names[static_cast<std::size_t>(name->first.second)] = name->second;
    }
    for (const double group : labels.values) {
        const auto number = static_cast<std::size_t>(group);
        if (number > 0 && labels.names[number].empty()) {
            labels.names[number] = std::to_string(number);
        }
    }
}

std::string MshGroups::warning() const {
    if (!has_several_) return {};
    return file_.path.string() +
           ": some entities are in several physical groups: the first one counts";
}

}  // namespace remesh
