// Gmsh's .msh as text of version 2.2, which is what most solvers read; those that know 4.1 read it
// as well. Labels are physical groups (format: Gmsh's reference manual, "Legacy formats").

#include <algorithm>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/materials.h"
#include "remesh/meshfile/msh_groups.h"
#include "remesh/meshfile/numbers.h"

namespace remesh {
namespace {

constexpr std::int32_t msh_triangle = 2;

// Groups are numbered from 1: a label 0 that has a name makes all of them one more.
class GroupNumbers {
public:
    explicit GroupNumbers(const Attribute* labels)
        : labels_(labels),
          is_shifted_(labels != nullptr && !labels->names.empty() && !labels->names[0].empty()) {}

    // 0: the face is in no group.
    [[nodiscard]] std::int64_t of(std::size_t face) const {
        if (labels_ == nullptr) return 0;
        const double group = labels_->values[face] + (is_shifted_ ? 1 : 0);
        return group >= 1 && is_value_of(NumberType::Int32, group)
                   ? static_cast<std::int64_t>(group)
                   : 0;
    }

    // Without quotes. Empty: it has none but its number.
    [[nodiscard]] std::string name_of(std::int64_t group) const {
        const auto label = static_cast<std::size_t>(group - (is_shifted_ ? 1 : 0));
        if (labels_ == nullptr || group == 0 || label >= labels_->names.size()) return {};
        std::string name = one_line(labels_->names[label]);
        std::ranges::replace(name, '"', '\'');
        return name == std::to_string(group) ? "" : name;
    }

private:
    const Attribute* labels_;
    bool is_shifted_;
};

std::string format_names(const GroupNumbers& numbers, const std::vector<std::int64_t>& groups) {
    std::string lines;
    std::size_t count = 0;
    for (const std::int64_t group : groups) {
        const std::string name = numbers.name_of(group);
        if (name.empty()) continue;
        lines += joined("2 ", group, " \"", name, "\"\n");
        ++count;
    }
    if (count == 0) return {};
    return joined("$PhysicalNames\n", count, "\n", lines, "$EndPhysicalNames\n");
}

}  // namespace

bool msh_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    const Attribute* const labels = labels_to_write(all.of_faces, msh_group_name);
    return kind == ElementKind::Face && labels != nullptr && labels->name == attribute.name;
}

std::string format_msh(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const GroupNumbers numbers(labels_to_write(attributes.of_faces, msh_group_name));
    std::vector<std::int64_t> groups;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick();
        if (groups.empty() || groups.back() != numbers.of(f)) groups.push_back(numbers.of(f));
    }
    groups = distinct(std::move(groups));
    std::string bytes = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + format_names(numbers, groups) +
                        joined("$Nodes\n", mesh.positions.size(), "\n");
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        bytes += std::to_string(v + 1);
        append_line(bytes, " ", mesh.positions[v]);
    }
    bytes += joined("$EndNodes\n$Elements\n", mesh.triangles.size(), "\n");
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick(2);
        const auto& [a, b, c] = mesh.triangles[f];
        const std::int64_t group = numbers.of(f);
        // An entity of the geometry has faces of one group only.
        const auto entity = std::ranges::lower_bound(groups, group) - groups.begin() + 1;
        append_line(bytes, "",
                    std::array<std::int64_t, 8>{static_cast<std::int64_t>(f) + 1, msh_triangle, 2,
                                                group, entity, a + 1ll, b + 1ll, c + 1ll});
    }
    return bytes + "$EndElements\n";
}

}  // namespace remesh
