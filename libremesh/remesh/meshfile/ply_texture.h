//! \file
//! Texture coordinates of a PLY file: a pair of numbers of each vertex, or a list of each face with
//! a pair for each corner, as MeshLab writes it. Private to the reader.
#pragma once

#include <array>

#include "remesh/meshfile/ply_values.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {

//! The two numbers of an element that are texture coordinates; null: it has none. One name of a
//! pair alone is an ordinary property.
[[nodiscard]] inline std::array<const PlyProperty*, 2> texture_pair(const PlyElement& element) {
    constexpr std::array<std::array<const char*, 2>, 4> names = {
        {{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}}};
    const auto is_real = [](const PlyProperty* property) {
        return property != nullptr && !property->size_type && !is_integer(property->type);
    };
    for (const auto& [u, v] : names) {
        const std::array pair = {element.find(u), element.find(v)};
        if (is_real(pair[0]) && is_real(pair[1])) return pair;
    }
    return {nullptr, nullptr};
}

//! The list of an element's corners that are texture coordinates, or nullptr.
[[nodiscard]] inline const PlyProperty* texture_list(const PlyElement& element) {
    const PlyProperty* const list = element.find(TextureCoordinates::name);
    return list != nullptr && list->size_type && !is_integer(list->type) ? list : nullptr;
}

//! Reads the list of one face. It may stand before the corners, so it is given to them afterwards.
template <typename Values>
[[nodiscard]] std::vector<double> read_texture_list(Values& values, const PlyProperty& list,
                                                    const SourceFile& file, SoupTexture& texture) {
    std::vector<double> numbers;
    for (std::int64_t k = read_length(values, list, file); k > 0; --k) {
        const std::optional<double> number = values.attribute(list.type);
        texture.is_broken = texture.is_broken || !number;
        numbers.push_back(number.value_or(0));
    }
    return numbers;
}

//! Gives the last corners so far their coordinates; an empty list is none.
inline void set_texture(std::span<const double> numbers, std::size_t num_corners,
                        PolygonSoup& soup) {
    SoupTexture& texture = soup.texture;
    if (numbers.empty()) return;
    if (numbers.size() != 2 * num_corners) {
        texture.is_broken = true;
        return;
    }
    for (std::size_t k = 0; k < num_corners; ++k) {
        texture.add(numbers[2 * k], numbers[2 * k + 1]);
        texture.set_corner(soup.num_corners() - num_corners + k + 1,
                           static_cast<Index>(texture.values.size() - 1));
    }
}

}  // namespace remesh
