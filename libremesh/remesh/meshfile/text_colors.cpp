#include "remesh/meshfile/text_colors.h"

#include <limits>
#include <utility>

namespace remesh {
namespace {

constexpr std::array part_names = {"red", "green", "blue", "alpha"};

}  // namespace

void TextColors::take(std::size_t index, std::span<const double> numbers) {
    if (numbers.empty()) return;
    const std::size_t num_parts = parts_[0].empty() ? numbers.size() : parts_[3].empty() ? 3 : 4;
    is_broken_ = is_broken_ || parts_[0].size() != index || numbers.size() != num_parts ||
                 num_parts < 3 || num_parts > 4;
    if (is_broken_) return;
    for (std::size_t k = 0; k < num_parts; ++k) parts_[k].push_back(numbers[k]);
}

void TextColors::finish(std::size_t num_elements, ElementKind kind, MeshAttributes& attributes) && {
    if (parts_[0].empty() && !is_broken_) return;
    bool is_intensity = true, is_byte = true;
    for (const std::vector<double>& part : parts_) {
        for (const double value : part) {
            is_intensity = is_intensity && value >= 0 && value <= 1;
            is_byte = is_byte && is_value_of(NumberType::UInt8, value);
        }
    }
    const bool is_vertex = kind == ElementKind::Vertex;
    if (is_broken_ || parts_[0].size() != num_elements || (!is_intensity && !is_byte)) {
        attributes.declined.push_back(
            {is_vertex ? "vertex colours" : "face colours",
             "not all elements have three or four numbers, from 0 to 1 or whole ones to 255"});
        return;
    }
    auto& target = is_vertex ? attributes.of_vertices : attributes.of_faces;
    for (std::size_t k = 0; k < parts_.size(); ++k) {
        if (parts_[k].empty()) continue;
        target.push_back({.name = part_names[k],
                          .type = is_intensity ? NumberType::Float64 : NumberType::UInt8,
                          .values = std::move(parts_[k]),
                          .is_intensity = is_intensity});
    }
}

std::vector<const Attribute*> colors_of(const std::vector<Attribute>& attributes) {
    std::vector<const Attribute*> colors;
    for (const char* name : part_names) {
        const Attribute* const part = find_attribute(attributes, name);
        if (part != nullptr) {
            colors.push_back(part);
        } else if (colors.size() < 3) {
            return {};
        }
    }
    return colors;
}

double intensity(const Attribute& part, std::size_t element) {
    const double value = part.values[element];
    if (part.type == NumberType::UInt8) return value / std::numeric_limits<std::uint8_t>::max();
    if (part.type == NumberType::UInt16) return value / std::numeric_limits<std::uint16_t>::max();
    return value;
}

}  // namespace remesh
