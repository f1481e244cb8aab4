//! \file
//! Nodes and kinds of elements of Gmsh's .msh files. Private to their reader.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>

#include "remesh/meshfile/polygon_soup.h"

namespace remesh {

//! A kind of elements. The first nodes of curved ones are their corners.
struct MshType {
    std::uint8_t number;
    std::uint8_t dimension;
    std::uint8_t num_corners;
    std::uint8_t num_nodes;
    VolumeCell cell = {};
};
inline constexpr MshType msh_types[] = {{15, 0, 1, 1},
                                        {1, 1, 2, 2},
                                        {8, 1, 2, 3},
                                        {26, 1, 2, 4},
                                        {27, 1, 2, 5},
                                        {28, 1, 2, 6},
                                        {2, 2, 3, 3},
                                        {9, 2, 3, 6},
                                        {20, 2, 3, 9},
                                        {21, 2, 3, 10},
                                        {22, 2, 3, 12},
                                        {23, 2, 3, 15},
                                        {24, 2, 3, 15},
                                        {25, 2, 3, 21},
                                        {3, 2, 4, 4},
                                        {16, 2, 4, 8},
                                        {10, 2, 4, 9},
                                        {36, 2, 4, 16},
                                        {37, 2, 4, 25},
                                        {38, 2, 4, 36},
                                        {4, 3, 4, 4, VolumeCell::Tetrahedron},
                                        {11, 3, 4, 10, VolumeCell::Tetrahedron},
                                        {29, 3, 4, 20, VolumeCell::Tetrahedron},
                                        {30, 3, 4, 35, VolumeCell::Tetrahedron},
                                        {31, 3, 4, 56, VolumeCell::Tetrahedron},
                                        {5, 3, 8, 8, VolumeCell::Hexahedron},
                                        {17, 3, 8, 20, VolumeCell::Hexahedron},
                                        {12, 3, 8, 27, VolumeCell::Hexahedron},
                                        {92, 3, 8, 64, VolumeCell::Hexahedron},
                                        {93, 3, 8, 125, VolumeCell::Hexahedron},
                                        {6, 3, 6, 6, VolumeCell::Wedge},
                                        {18, 3, 6, 15, VolumeCell::Wedge},
                                        {13, 3, 6, 18, VolumeCell::Wedge},
                                        {7, 3, 5, 5, VolumeCell::Pyramid},
                                        {19, 3, 5, 13, VolumeCell::Pyramid},
                                        {14, 3, 5, 14, VolumeCell::Pyramid}};

//! Vertices or faces by the numbers that a file gives them, which may have gaps and any order.
class MshTags {
public:
    void add(std::uint64_t tag) { tags_.emplace_back(tag, tags_.size()); }

    //! To be called when all are added.
    //! \return a number that several of them have.
    std::optional<std::uint64_t> sort() {
        if (!std::is_sorted(tags_.begin(), tags_.end())) std::sort(tags_.begin(), tags_.end());
        for (std::size_t i = 1; i < tags_.size(); ++i) {
            if (tags_[i].first == tags_[i - 1].first) return tags_[i].first;
        }
        return {};
    }

    [[nodiscard]] std::size_t size() const { return tags_.size(); }

    //! Its place in the order in which they were added.
    [[nodiscard]] std::optional<std::size_t> find(std::uint64_t tag) const {
        if (tag - 1 < tags_.size() && tags_[tag - 1].first == tag) return tags_[tag - 1].second;
        const auto found =
            std::lower_bound(tags_.begin(), tags_.end(), std::pair(tag, std::size_t{0}));
        if (found == tags_.end() || found->first != tag) return {};
        return found->second;
    }

private:
    std::vector<std::pair<std::uint64_t, std::size_t>> tags_;
};

}  // namespace remesh
